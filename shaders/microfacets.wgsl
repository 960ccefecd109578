// Rough metal: the twin of crates/optics/src/microfacets.rs and of `metal_reflectance` in
// crates/optics/src/metal.rs, which name the sources. crates/trace/src/gpu/parity/metal.rs runs both on the same
// numbers. Directions are in a frame whose z axis is the surface's normal, and point away from the surface.
//
// `roughnesses` holds the tables of surfaces, each of ROUGHNESS_ROWS rows. The first row holds the width of the law
// of slopes and the mean loss of one reflection. The other rows are the steps of the table of `Roughness::once`: the
// loss of one reflection at both ends of the step and in its mean, and the even light that is lost in all steps
// before. The file that imports this one has `roughnesses`, and `turns`, which counts the turns of loops.
//
// Imports: Finish, angles.

// The greatest solid angle that a direction represents: the whole sphere.
const WHOLE: f32 = 12.566371;

// Light that a rough surface has reflected: the direction from which it comes, the factor by which it counts (0 where
// it is lost), and the reciprocal of the density with which the direction was drawn, in steradians.
struct Scattered {
    direction: vec3f,
    weight: f32,
    solid_angle: f32,
}

// Returns the square root of a complex number, of both roots the one with a real part of at least 0.
fn complex_root(z: vec2f) -> vec2f {
    let size = sqrt(0.5 * (length(z) + abs(z.x)));
    let other = 0.5 * z.y / max(size, 1e-20);
    return select(vec2f(abs(other), select(-size, size, z.y >= 0.0)), vec2f(size, other), z.x >= 0.0);
}

// Returns the share of unpolarised light that a metal of this complex index reflects.
fn unpolarised_reflectance(cos_given: f32, index: vec2f) -> f32 {
    let cos_i = clamp(cos_given, 0.0, 1.0);
    let square = vec2f((index.x - index.y) * (index.x + index.y), 2.0 * index.x * index.y);
    let inner = complex_root(square - vec2f(1.0 - cos_i * cos_i, 0.0));
    let of_s = vec2f(cos_i, 0.0);
    let of_p = square * cos_i;
    let s = dot(of_s - inner, of_s - inner) / dot(of_s + inner, of_s + inner);
    let p = dot(of_p - inner, of_p - inner) / dot(of_p + inner, of_p + inner);
    return 0.5 * (s + p);
}

// Returns the share of light that one reflection toward a cosine loses: 1 - `Roughness::once`.
fn lost_once(surface: u32, cos: f32) -> f32 {
    let at = sqrt(clamp(cos, 0.0, 1.0)) * f32(ROUGHNESS_ROWS - 1u);
    let step = min(u32(at), ROUGHNESS_ROWS - 2u);
    let row = roughnesses[surface + 1u + step];
    return mix(row.x, row.y, at - f32(step));
}

fn square_cos(step: f32) -> f32 {
    let part = step / f32(ROUGHNESS_ROWS - 1u);
    return part * part * part * part;
}

// Returns the density of normals with the tangential components and the cosine of `normal`.
fn slopes(alpha: f32, normal: vec3f) -> f32 {
    // The square of the sine is used, so that narrow distributions keep their digits.
    let fall = dot(normal.xy, normal.xy) + alpha * alpha * normal.z * normal.z;
    return alpha * alpha * FRAC_1_PI / (fall * fall);
}

fn hidden(alpha: f32, cos: f32) -> f32 {
    let square = max(cos * cos, 1e-16);
    return 0.5 * (sqrt(1.0 + alpha * alpha * (1.0 - square) / square) - 1.0);
}

fn visible_normal(alpha: f32, out: vec3f, luck: vec2f) -> vec3f {
    let stretched = normalize(vec3f(alpha * out.xy, out.z));
    let flat = dot(stretched.xy, stretched.xy);
    var across = vec3f(1.0, 0.0, 0.0);
    if flat > 0.0 {
        across = vec3f(-stretched.y, stretched.x, 0.0) * inverseSqrt(flat);
    }
    let up = cross(stretched, across);
    let x = sqrt(luck.x) * cos(TAU * luck.y);
    let seen = 0.5 * (1.0 + stretched.z);
    let y = (1.0 - seen) * sqrt(max(1.0 - x * x, 0.0)) + seen * (sqrt(luck.x) * sin(TAU * luck.y));
    let normal = across * x + up * y + stretched * sqrt(max(1.0 - x * x - y * y, 0.0));
    return normalize(vec3f(alpha * normal.xy, max(normal.z, 1e-9)));
}

// Returns a direction of light that has met several mirrors, and the exact density divided by that of the table.
fn several_times(surface: u32, luck: vec2f) -> vec4f {
    let wanted = luck.x * roughnesses[surface].y;
    // The search ends at the last step before which at most the wanted light is lost.
    var low = 0u;
    var high = ROUGHNESS_ROWS - 1u;
    while high - low > 1u {
        turns += 1u;
        let middle = (low + high) / 2u;
        if roughnesses[surface + 1u + middle].w <= wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    let row = roughnesses[surface + 1u + low];
    let least = square_cos(f32(low));
    let most = square_cos(f32(low) + 1.0);
    let part = clamp((wanted - row.w) / max(row.z * (most - least), 1e-30), 0.0, 1.0);
    let cos_o = sqrt(clamp(mix(least, most, part), 1e-12, 1.0));
    let sin_o = sqrt(max(1.0 - cos_o * cos_o, 0.0));
    let exact = lost_once(surface, cos_o) / max(row.z, 1e-30);
    return vec4f(sin_o * cos(TAU * luck.y), sin_o * sin(TAU * luck.y), cos_o, exact);
}

// Returns the finish that four numbers describe.
fn finish_of(numbers: vec4f) -> Finish {
    return Finish(numbers.xy, numbers.z, numbers.w);
}

// Draws, by three numbers from 0 to below 1, a direction from which light comes that is reflected to `out`.
fn sample_metal(finish: Finish, out: vec3f, luck: vec3f) -> Scattered {
    let surface = u32(finish.surface) * ROUGHNESS_ROWS;
    let alpha = roughnesses[surface].x;
    if alpha == 0.0 {
        return Scattered(vec3f(-out.xy, out.z), unpolarised_reflectance(out.z, finish.index), 0.0);
    }
    let lost = lost_once(surface, out.z);
    if luck.z >= 1.0 - lost {
        let found = several_times(surface, luck.xy);
        let even = lost_once(surface, found.z) / max(roughnesses[surface].y, 1e-30);
        let density = lost * even * found.z * FRAC_1_PI / max(found.w, 1e-30);
        return Scattered(found.xyz, finish.again * found.w, min(1.0 / max(density, 1e-30), WHOLE));
    }
    let middle = visible_normal(alpha, out, luck.xy);
    let cos_i = dot(out, middle);
    let direction = middle * (2.0 * cos_i) - out;
    if direction.z <= 0.0 {
        return Scattered(direction, 0.0, 0.0);
    }
    let own = 1.0 + hidden(alpha, out.z);
    let other = hidden(alpha, direction.z);
    let weight = unpolarised_reflectance(cos_i, finish.index) * own / ((own + other) * (1.0 - lost));
    let density = (1.0 - lost) * slopes(alpha, middle) / (4.0 * out.z * own);
    return Scattered(direction, weight, min(1.0 / max(density, 1e-30), WHOLE));
}
