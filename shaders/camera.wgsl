// Where the rays of a picture begin: the twin of src/trace/ray/camera.rs.

// A point outside all stones on the ray through a point of the image plane, and the ray's direction.
fn camera_ray(p: vec2f) -> array<vec3f, 2> {
    let at = frame.right.xyz * p.x + frame.up.xyz * p.y;
    var direction = -frame.toward.xyz;
    var from_eye = FAR;
    if frame.toward.w > 0.0 {
        let ray = at - frame.toward.xyz * frame.toward.w;
        from_eye = length(ray);
        direction = ray / from_eye;
    }
    return array<vec3f, 2>(at - direction * min(from_eye, 2.0 * frame.right.w + length(at)), direction);
}

// The ray of a pixel that stands at `step`, 0 to 1, in it.
fn pixel_ray(pixel: vec2u, step: vec2f) -> array<vec3f, 2> {
    let centred = vec2f(pixel) + step - 0.5 * vec2f(frame.film.xy);
    return camera_ray(vec2f(centred.x, -centred.y) * frame.up.w);
}
