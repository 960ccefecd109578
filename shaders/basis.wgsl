// Axes perpendicular to a direction.

// Returns two unit vectors that are perpendicular to a unit vector and to each other. The basis is that of T. Duff et
// al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017, as in `any_orthonormal_pair` of glam.
fn orthonormal_pair(v: vec3f) -> array<vec3f, 2> {
    let sign = select(-1.0, 1.0, v.z >= 0.0);
    let a = -1.0 / (sign + v.z);
    let b = v.x * v.y * a;
    return array<vec3f, 2>(vec3f(1.0 + sign * v.x * v.x * a, sign * b, -sign * v.x), vec3f(b, sign + v.y * v.y * a, -v.y));
}
