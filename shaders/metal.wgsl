// Bodies of metal beside the stones. This is the twin of crates/trace/src/ray/metal_tracer.rs, of its use in
// crates/trace/src/ray/scene_tracer.rs, of crates/trace/src/ray/lobe_luck.rs, and of the sieve in
// crates/trace/src/ray/roulette.rs.
//
// Imports: Body, random, microfacets, basis, bvh, light.

@group(0) @binding(13) var<uniform> metals: array<Body, MOST_METALS>;
@group(0) @binding(14) var<uniform> roughnesses: array<vec4f, MOST_ROUGHNESS_ROWS>;

// The most reflections by metal along a ray's path.
const MOST_REFLECTIONS: u32 = 256u;
// The distance from its start within which light that metal has reflected does not meet the same body, as a part of
// the body's reach; it is some thirty roundings.
const AWAY: f32 = 2e-6;
// The lift of mirror images below the surface, as in metal_tracer.rs.
const LIFT = vec2f(0.9, 0.01);
// The least sine at which light leaves the true surface, and the parts of a solid angle, as in metal_tracer.rs.
const LEAST_SINE: f32 = 1e-6;
const PARTS: f32 = 32.0;
// The widest side of the square of directions that a ray represents: the root of 4 pi / PARTS.
const WIDEST: f32 = 0.626657;
// The longest step of a hit, and the widest fan, as in metal_tracer.rs.
const LONGEST_STEP: f32 = 4.0;
const WIDEST_BEND: f32 = 0.3;
// The squared length below which a vector has no direction.
const SHORT: f32 = 1e-36;
// The steps of the random numbers, as in lobe_luck.rs.
const STEP_X = vec2u(0x5f1d36f1u, 0xa54ff53au);
const STEP_Y = vec2u(0x2425cfa0u, 0x7311c281u);
const STEP_Z = vec2u(0xa3d0a666u, 0xca91d722u);
const SALT = vec2u(0x6c6c7563u, 0x6d657461u);
// The first number of a roulette that is drawn at random.
const EVEN: u32 = 4u;

// The state of the random numbers: the seeds for the directions that rough metal draws and for the roulette, the
// number of the ray in its pixel, by which the roulette draws, and the number of reflections by metal so far.
struct Chances {
    luck: vec2u,
    roulette: vec2u,
    number: vec2u,
    reflections: u32,
}

// The sum of the weak weights since the last of them that passed the sieve.
var<private> level: f32;

fn chances_of_pixel(pixel: vec2u, wavelength: u32) -> Chances {
    let seed = mixed_bits(vec2u(pixel.y, pixel.x));
    let number = sum64(wide_product(frame.pass_number, frame.wavelength_count), vec2u(wavelength, 0u));
    return Chances(mixed_bits(seed ^ SALT), seed, number, 0u);
}

fn chances_beyond(own: Chances, exit: u32) -> Chances {
    let by = mixed_bits(vec2u(exit, 0u));
    return Chances(mixed_bits(own.luck ^ by), mixed_bits(own.roulette ^ by), own.number, own.reflections);
}

fn is_reflected(own: Chances) -> bool {
    return own.reflections > 0u;
}

// Begins the sieve of the light that leaves one body.
fn begin_sieve(own: Chances) {
    let seed = mixed_bits(own.roulette ^ mixed_bits(vec2u(0u)));
    let bits = mixed_bits(mixed_bits(sum64(seed, vec2u(EVEN, 0u))) ^ mixed_bits(own.number));
    level = unit_of_bits(bits) * frame.by_chance;
}

// Returns the weight with which light of this weight goes on to another body; 0 where chance ends it.
fn sieved(weight: f32) -> f32 {
    if weight > frame.by_chance {
        return weight;
    }
    level += weight;
    if level < frame.by_chance {
        return 0.0;
    }
    level -= frame.by_chance;
    return frame.by_chance;
}

// Returns one of the three numbers from 0 to below 1 by which metal draws a direction.
fn drawn(own: Chances, k: u32, step: vec2u) -> f32 {
    let bits = mixed_bits(sum64(own.luck, vec2u(k, 0u)));
    let number = vec2u(frame.pass_number, 0u);
    if own.reflections > 0u {
        return unit_of_bits(mixed_bits(bits ^ mixed_bits(number)));
    }
    return unit_of_bits(sum64(bits, product64(step, number)));
}

// Returns the hit of a ray on a body of metal, and makes that body the present one. `left` is the triangle of it that
// the ray has just left, or NONE.
fn metal_met(metal: u32, ray: Ray, left: u32) -> Meeting {
    body = metals[metal];
    let after = select(AWAY * mesh_range().reach, 0.0, left == NONE);
    let met = nearest_triangle(unplace(ray.origin), own_vector(ray.direction), 0.0, left, after);
    return Meeting(met.facet, met.distance * unit());
}

// Returns the first hit of a ray on metal, or `stone` where that is nearer.
fn with_metal(stone: First, ray: Ray, left: Left) -> First {
    var first = stone;
    turns += frame.metal_count;
    for (var k = 0u; k < frame.metal_count; k++) {
        if !is_near(metals[k].middle, metals[k].radius, ray) {
            continue;
        }
        let met = metal_met(k, ray, select(NONE, left.triangle, left.body == MOST_BODIES + k));
        if met.distance >= 0.0 && (first.body == NONE || met.distance <= first.met.distance) {
            first = First(MOST_BODIES + k, met);
        }
    }
    return first;
}

// Returns whether a ray meets metal before this distance.
fn meets_metal(ray: Ray, before: f32) -> bool {
    var found = false;
    turns += frame.metal_count;
    for (var k = 0u; k < frame.metal_count; k++) {
        if !found && is_near(metals[k].middle, metals[k].radius, ray) {
            let distance = metal_met(k, ray, NONE).distance;
            found = distance >= 0.0 && distance < before;
        }
    }
    return found;
}

// Returns the side of the square of directions that a ray represents after two rough surfaces. It is the twin of
// `wider` in metal_tracer.rs.
fn wider(own: f32, before: f32) -> f32 {
    return min(sqrt(own * own + before * before), WIDEST);
}

// Returns a vector scaled to length 1, or `otherwise` where it has no direction.
fn normal_or(v: vec3f, otherwise: vec3f) -> vec3f {
    let square = dot(v, v);
    return select(otherwise, v * inverseSqrt(max(square, SHORT)), square > SHORT);
}

// Returns the smooth normal, turned so that the mirror image leaves the true surface. It is the twin of `bent` in
// metal_tracer.rs.
fn bent(shading: vec3f, flat: vec3f, out: vec3f) -> vec3f {
    let image = shading * (2.0 * dot(shading, out)) - out;
    let lacking = min(LIFT.x * dot(flat, out), LIFT.y) - dot(image, flat);
    if lacking <= 0.0 {
        return shading;
    }
    return normal_or(out + normal_or(image + flat * lacking, flat), flat);
}

// Returns a direction, mirrored to the outside of the true surface where needed. It is the twin of `above` in
// metal_tracer.rs.
fn above(direction: vec3f, flat: vec3f) -> vec3f {
    let sine = dot(direction, flat);
    if sine >= LEAST_SINE {
        return direction;
    }
    return normal_or(direction + flat * (max(abs(sine), LEAST_SINE) - sine), flat);
}

// Returns the normals at a point of a triangle of the present body, in the world: that of the triangle, and the one
// by which light is reflected.
fn normals_at(triangle: u32, place: vec3f) -> array<vec3f, 2> {
    let t = triangles[triangle];
    let corner = triangles[triangle + mesh_range().normals];
    let flat = triangle_normal(t);
    let point = unplace(place);
    let a = t.a - point;
    let b = t.b - point;
    let c = t.c - point;
    // These are the areas of the three parts around the point, each opposite its corner.
    let shares = max(vec3f(dot(cross(b, c), flat), dot(cross(c, a), flat), dot(cross(a, b), flat)), vec3f(0.0));
    let shading = corner.a * shares.x + corner.b * shares.y + corner.c * shares.z;
    return array<vec3f, 2>(world_vector(flat), world_vector(normal_or(shading, flat)));
}

// Returns the change of the shading normal of a triangle of the present body along a step in its plane, in the world. It
// is the twin of `change_of_normal` in crates/math/src/shaded_mesh.rs.
fn change_of_normal(triangle: u32, place: vec3f, world_step: vec3f) -> vec3f {
    let t = triangles[triangle];
    let corner = triangles[triangle + mesh_range().normals];
    let flat = triangle_normal(t);
    let point = unplace(place);
    let step = own_vector(world_step) / unit();
    let a = t.a - point;
    let b = t.b - point;
    let c = t.c - point;
    let shares = max(vec3f(dot(cross(b, c), flat), dot(cross(c, a), flat), dot(cross(a, b), flat)), vec3f(0.0));
    let changes =
        vec3f(dot(cross(step, b - c), flat), dot(cross(step, c - a), flat), dot(cross(step, a - b), flat));
    let here = corner.a * shares.x + corner.b * shares.y + corner.c * shares.z;
    let along = corner.a * changes.x + corner.b * changes.y + corner.c * changes.z;
    let square = dot(here, here);
    if square <= SHORT {
        return vec3f(0.0);
    }
    return world_vector((along - here * (dot(along, here) / square)) * inverseSqrt(square));
}

// Returns a vector, shortened to `most` where it is longer.
fn at_most(v: vec3f, most: f32) -> vec3f {
    let length = length(v);
    return select(v, v * (most / max(length, SHORT)), length > most);
}

// Returns the step in the plane with the normal `flat` by which the hit moves where the ray's origin is shifted. It is
// the twin of `step_along` in metal_tracer.rs.
fn step_along(shift: vec3f, direction: vec3f, flat: vec3f) -> vec3f {
    let slope = dot(direction, flat);
    if slope == 0.0 {
        return vec3f(0.0);
    }
    return at_most(shift - direction * (dot(shift, flat) / slope), LONGEST_STEP * length(shift));
}

// Returns the fan of a ray that a mirror reflects. It is the twin of `mirrored_fan` in metal_tracer.rs.
fn mirrored_fan(fan: vec3f, direction: vec3f, middle: vec3f, all_turn: vec3f) -> vec3f {
    let turn = all_turn - middle * dot(middle, all_turn);
    let along = middle * (dot(fan, middle) + dot(direction, turn)) + turn * dot(direction, middle);
    return at_most(fan - along * 2.0, max(WIDEST_BEND, length(fan)));
}

// Reflects light at the body of metal that it meets first, and hands the reflected light on.
fn reflect_by_metal(next: Waiting, wavelength: u32) {
    let own = next.chances;
    if own.reflections >= MOST_REFLECTIONS {
        sum.unresolved += next.weight;
        return;
    }
    body = metals[next.first.body - MOST_BODIES];
    let hit = next.first.met;
    let place = next.ray.origin + next.ray.direction * hit.distance;
    let normals = normals_at(hit.facet, place);
    let out = -next.ray.direction;
    let side = select(1.0, -1.0, dot(normals[0], out) < 0.0);
    let flat = normals[0] * side;
    let up = bent(normals[1] * side, flat, out);
    let across = orthonormal_pair(up);
    let right = across[0];
    let ahead = across[1];
    let seen = normalize(vec3f(dot(right, out), dot(ahead, out), max(dot(up, out), LEAST_SINE)));
    let place_of_finish = (frame.stone_count + mesh_range().finish) * frame.wavelength_count + wavelength;
    let finish = finish_of(media[place_of_finish]);
    let luck = vec3f(drawn(own, 0u, STEP_X), drawn(own, 1u, STEP_Y), drawn(own, 2u, STEP_Z));
    let found = sample_metal(finish, seen, luck);
    sum.absorbed += next.weight * (1.0 - found.weight);
    if found.weight <= 0.0 {
        return;
    }
    let toward = above(right * found.direction.x + ahead * found.direction.y + up * found.direction.z, flat);
    let middle = normal_or(toward + out, up);
    let shift = next.ray.shift + next.ray.fan * hit.distance;
    let step = step_along(shift, next.ray.direction, flat);
    let turn = change_of_normal(hit.facet, place, step) * side;
    let ray = Ray(place, toward, mirrored_fan(next.ray.fan, next.ray.direction, middle, turn), shift);
    let by = mixed_bits(vec2u(1u, 0u));
    let later =
        Chances(mixed_bits(own.luck ^ SALT), mixed_bits(own.roulette ^ by), own.number, own.reflections + 1u);
    let left = Left(next.first.body, hit.facet);
    let spread = wider(sqrt(found.solid_angle / PARTS), next.spread);
    // Metal is taken to leave light unpolarised.
    onward(ray, next.weight * found.weight, no_polarisation(), spread, left, later);
}
