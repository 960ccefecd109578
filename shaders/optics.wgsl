// Snell's law, Fresnel's formulae and polarisation: the twins of crates/optics/src/snell.rs, fresnel.rs and real.rs, which
// name the sources, and of crates/trace/src/coherency.rs. Functions, fields and constants have the names of their twins,
// but for `reflect_ray` and `refract_ray`, whose own names WGSL has taken, `weight_of`, whose own name variables have, and
// `reflectances`, which is `reflectance_s` and `reflectance_p` at once. crates/trace/src/gpu/parity.rs runs both on the
// same numbers.

// The sine of the angle between a ray and a facet's normal below which the ray counts as perpendicular to the facet.
const SQUARE_ON: f32 = 1e-4;
// The least cosine that a change of a ray is divided by: nearer to 0 f32 has no digits left.
const LEAST_COS: f32 = 1e-4;

fn cos_t_squared(cos_i: f32, eta: f32) -> f32 {
    let normal_part = eta * clamp(cos_i, 0.0, 1.0);
    return (1.0 - eta) * (1.0 + eta) + normal_part * normal_part;
}

fn reflect_ray(d: vec3f, n: vec3f, cos_i: f32) -> vec3f {
    let reflected = d + n * (2.0 * cos_i);
    // One Newton step toward unit length prevents the drift of a chain of bounces.
    return reflected * (1.5 - 0.5 * dot(reflected, reflected));
}

fn refract_ray(d: vec3f, n: vec3f, eta: f32, cos_i: f32, cos_t: f32) -> vec3f {
    return d * eta + n * (eta * cos_i - cos_t);
}

// Returns the change of the reflected direction when the ray's direction changes by `of_d` and the normal by `of_n`.
fn reflected_change(d: vec3f, n: vec3f, of_d: vec3f, of_n: vec3f) -> vec3f {
    return of_d - n * (2.0 * (dot(of_d, n) + dot(d, of_n))) - of_n * (2.0 * dot(d, n));
}

// Returns the change of the refracted direction when the ray's direction changes by `of_d`, the normal by `of_n` and
// eta by `of_eta`; cos_t must be above 0.
fn refracted_change(
    d: vec3f,
    n: vec3f,
    eta: f32,
    cos_i: f32,
    cos_t: f32,
    of_d: vec3f,
    of_n: vec3f,
    of_eta: f32,
) -> vec3f {
    let of_cos_i = -dot(of_d, n) - dot(d, of_n);
    let of_cos_t = eta * (eta * cos_i * of_cos_i - (1.0 - cos_i * cos_i) * of_eta) / max(cos_t, LEAST_COS);
    return d * of_eta + of_d * eta + n * (of_eta * cos_i + eta * of_cos_i - of_cos_t) + of_n * (eta * cos_i - cos_t);
}

// The complex amplitudes of reflection for s and p, and the cosine of the angle of refraction, 0 where reflection is total.
struct Fresnel {
    r_s: vec2f,
    r_p: vec2f,
    cos_t: f32,
}

// Returns the amplitude of total reflection, (a - bi) / (a + bi).
fn total(a: f32, b: f32) -> vec2f {
    let square = a * a + b * b;
    if square == 0.0 {
        return vec2f(-1.0, 0.0);
    }
    return vec2f(a * a - b * b, -2.0 * a * b) / square;
}

fn fresnel(cos_i_given: f32, eta: f32) -> Fresnel {
    let cos_i = clamp(cos_i_given, 0.0, 1.0);
    let squared = cos_t_squared(cos_i, eta);
    if squared > 0.0 {
        let cos_t = sqrt(squared);
        let r_s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
        let r_p = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
        return Fresnel(vec2f(r_s, 0.0), vec2f(r_p, 0.0), cos_t);
    }
    let decay = sqrt(-squared);
    return Fresnel(total(eta * cos_i, decay), total(cos_i, eta * decay), 0.0);
}

// Returns the reflected shares of the power of s- and of p-polarised light.
fn reflectances(f: Fresnel) -> vec2f {
    return select(vec2f(1.0), vec2f(dot(f.r_s, f.r_s), dot(f.r_p, f.r_p)), f.cos_t > 0.0);
}

// The coherency matrix of light along the axes s and direction × s.
struct Coherency {
    ss: f32,
    pp: f32,
    re: f32,
    im: f32,
}

fn weight_of(light: Coherency) -> f32 {
    return light.ss + light.pp;
}

// Returns unpolarised light of this weight.
fn of_weight(weight: f32) -> Coherency {
    return Coherency(0.5 * weight, 0.5 * weight, 0.0, 0.0);
}

fn unpolarised(light: Coherency) -> Coherency {
    return of_weight(weight_of(light));
}

// Returns this share of the light.
fn times(light: Coherency, share: f32) -> Coherency {
    return Coherency(light.ss * share, light.pp * share, light.re * share, light.im * share);
}

// Returns light in axes turned from s toward p by the angle whose cosine is c and whose sine is s.
fn turned(light: Coherency, c: f32, s: f32) -> Coherency {
    let cc = c * c;
    let ss = s * s;
    let cs = c * s;
    return Coherency(
        cc * light.ss + ss * light.pp + 2.0 * cs * light.re,
        ss * light.ss + cc * light.pp - 2.0 * cs * light.re,
        (cc - ss) * light.re + cs * (light.pp - light.ss),
        light.im,
    );
}

// Returns the light of a ray along the axes that belong to `s`, where `before` is its axis s so far.
fn turned_to(light: Coherency, s: vec3f, before: vec3f, direction: vec3f) -> Coherency {
    return turned(light, dot(before, s), dot(cross(direction, before), s));
}

// Returns the light that a surface reflects.
fn reflected(light: Coherency, f: Fresnel) -> Coherency {
    let cross = vec2f(dot(f.r_s, f.r_p), f.r_s.y * f.r_p.x - f.r_s.x * f.r_p.y);
    let r = reflectances(f);
    return Coherency(
        light.ss * r.x,
        light.pp * r.y,
        light.re * cross.x - light.im * cross.y,
        light.re * cross.y + light.im * cross.x,
    );
}

// Returns the light that passes a surface; refraction shifts no phase.
fn transmitted(light: Coherency, f: Fresnel) -> Coherency {
    let t = max(1.0 - reflectances(f), vec2f(0.0));
    let both = sqrt(t.x * t.y);
    return Coherency(light.ss * t.x, light.pp * t.y, light.re * both, light.im * both);
}

// Returns the unit axis perpendicular to a ray and to a facet's normal. Where the ray is perpendicular to the facet,
// the axis is `otherwise`, made perpendicular to the ray.
fn s_axis(direction: vec3f, normal: vec3f, otherwise: vec3f) -> vec3f {
    let s = cross(direction, normal);
    let length_squared = dot(s, s);
    if length_squared > SQUARE_ON * SQUARE_ON {
        return s * inverseSqrt(length_squared);
    }
    // The axis is made perpendicular to this ray, so that the axes do not drift.
    let kept = otherwise - direction * dot(direction, otherwise);
    return kept * inverseSqrt(max(dot(kept, kept), 1e-12));
}
