// The colour that a camera sees of stones and metal under light, one band of wavelengths after the other. `Chances` and
// all functions of metal are in metal.wgsl, or in no_metal.wgsl where there is none.
//
// Imports: Response, RadiancePixel, environment, trace, pose, camera, tiles.

@group(0) @binding(2) var<storage, read_write> lit: array<RadiancePixel>;
@group(0) @binding(10) var<uniform> responses: array<Response, MOST_WAVELENGTHS + 1u>;

// The body that a ray meets first, and the place. A stone has its number, metal has its number plus MOST_BODIES, and
// no body is NONE.
struct First {
    body: u32,
    met: Meeting,
}

// The body that a ray has just left, numbered as in `First`, and the triangle where the body is metal.
struct Left {
    body: u32,
    triangle: u32,
}

// A ray on its way to a body.
struct Waiting {
    ray: Ray,
    weight: f32,
    polarisation: Polarisation,
    first: First,
    chances: Chances,
    // The side of the square of directions that the ray represents; 0 for one direction.
    spread: f32,
}

var<private> sum: RadiancePixel;
var<private> response: Response;
var<private> present: u32;
// The random numbers of the light that enters the present body, and the number of rays that have left the body so
// far.
var<private> chances: Chances;
var<private> exits: u32;
// The spread of the light that enters the present body.
var<private> spread_before: f32;
var<private> waiting: array<Waiting, MOST_WAITING>;
var<private> count: u32;
// The ray from the eye, as it would go on without any stone.
var<private> straight: Ray;

// Returns the ray along which light is looked up. It is the twin of `SamplePass::mixed` in
// crates/trace/src/sampling.rs.
fn mixed(ray: Ray) -> Ray {
    let strength = frame.strength;
    if strength >= 1.0 || dot(ray.direction, straight.direction) <= 0.0 {
        return ray;
    }
    let ahead = dot(ray.origin - straight.origin, straight.direction);
    let beside = straight.origin + straight.direction * ahead;
    let moved = straight.shift + straight.fan * ahead;
    let between = mix(straight.direction, ray.direction, strength);
    let length = length(between);
    let fan = mix(straight.fan, ray.fan, strength) / length;
    return Ray(mix(beside, ray.origin, strength), between / length, fan, mix(moved, ray.shift, strength));
}

// Adds the light of the environment that arrives along a ray, which may represent a square of directions with the
// side `spread`.
fn see(leaving: Ray, weight: f32, spread: f32, is_mirrored: bool) {
    // Only refracted light is mixed with the straight ray.
    var ray = leaving;
    if !is_mirrored {
        ray = mixed(leaving);
    }
    let light = radiance(ray, spread) * weight;
    let colour = response.key * light.x + response.red * light.y + response.green * light.z + response.blue * light.w;
    sum.colour += colour.xyz;
}

// Returns whether a ray runs through a ball.
fn is_near(middle: vec3f, radius: f32, ray: Ray) -> bool {
    let away = middle - ray.origin;
    let along = dot(away, ray.direction);
    return along > -radius && dot(away, away) - along * along < radius * radius;
}

// Returns whether there are bodies that a ray may meet after it has left one.
fn has_others() -> bool {
    return frame.stone_count > 1u || frame.metal_count > 0u;
}

// Returns the first hit of a ray. The body that is traced stays the present one.
fn first_body(ray: Ray, left: Left) -> First {
    let own = body;
    var first = First(NONE, Meeting(0u, -1.0));
    if COUNTS_TURNS {
        turns += frame.stone_count;
    }
    for (var k = 0u; k < frame.stone_count; k++) {
        if k == left.body || !is_near(bodies[k].middle, bodies[k].radius, ray) {
            continue;
        }
        body = bodies[k];
        let met = meet(ray.origin, ray.direction);
        if met.distance > 0.0 && (first.body == NONE || met.distance < first.met.distance) {
            first = First(k, met);
        }
    }
    first = with_metal(first, ray, left);
    body = own;
    return first;
}

// Returns whether light that has left the present stone meets another body before this distance.
fn is_taken(ray: Ray, distance: f32) -> bool {
    if !has_others() {
        return false;
    }
    let own = body;
    var found = false;
    for (var k = 0u; k < frame.stone_count; k++) {
        if !found && k != present && is_near(bodies[k].middle, bodies[k].radius, ray) {
            body = bodies[k];
            let met = meet(ray.origin, ray.direction).distance;
            found = met > 0.0 && met < distance;
        }
    }
    found = found || meets_metal(ray, distance);
    body = own;
    return found;
}

// Handles light that leaves the present stone.
fn leave(ray: Ray, weight: f32, polarisation: Polarisation, is_surface: bool) {
    exits += 1u;
    onward(ray, weight, polarisation, spread_before, Left(present, NONE), chances_beyond(chances, exits));
}

// Handles light that has left a body. Light that meets another body waits to be followed, and all other light is
// looked up. `spread` is the side of the square of directions that the ray represents.
fn onward(ray: Ray, weight: f32, polarisation: Polarisation, spread: f32, left: Left, own: Chances) {
    if has_others() {
        let first = first_body(ray, left);
        if first.body != NONE || is_spent() {
            let kept = sieved(weight);
            if count < MOST_WAITING && kept > frame.least_weight {
                waiting[count] = Waiting(ray, kept, polarisation, first, own, spread);
                count += 1u;
            } else {
                sum.unresolved += kept;
            }
            return;
        }
    }
    see(ray, weight, spread, is_reflected(own));
}

// Follows a ray through the stone that it meets first, or reflects it at metal. Where it meets nothing, the
// environment is looked up.
fn go(next: Waiting, wavelength: u32) {
    if is_spent() {
        sum.unresolved += next.weight;
        return;
    }
    if next.first.body == NONE {
        see(next.ray, next.weight, 0.0, false);
        return;
    }
    chances = next.chances;
    spread_before = next.spread;
    exits = 0u;
    begin_sieve(chances);
    if next.first.body >= MOST_BODIES {
        reflect_by_metal(next, wavelength);
        return;
    }
    present = next.first.body;
    body = bodies[present];
    medium = medium_of(media[present * frame.wavelength_count + wavelength]);
    let rest = follow(next.ray, next.first.met, next.weight, next.polarisation);
    sum.unresolved += rest.unresolved;
    sum.absorbed += rest.absorbed;
}

@compute @workgroup_size(8, 8)
fn light(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) id: vec3u) {
    let place = strip_pixel(group, id.xy);
    if place.x >= frame.size.x || place.y >= frame.row_count {
        return;
    }
    let pixel = vec2u(place.x, frame.first_row + place.y);
    straight = pixel_ray(pixel, frame.place);
    // The ray meets the first body at the same point in all wavelengths.
    let first = first_body(straight, Left(NONE, NONE));
    let is_beside = first.body == NONE;
    if is_beside && environment.backdrop.x <= 0.0 {
        return;
    }
    let turns_before = turns;
    let at = place.y * frame.size.x + place.x;
    // Each wavelength is summed separately, so that the sum does not depend on the number of wavelengths in a
    // dispatch.
    var total = lit[at];
    for (var w = frame.first_wavelength; w < frame.end_wavelength; w++) {
        // Light that meets no body is the same at all wavelengths, so it is looked up once for all of them.
        if is_beside && w > 0u {
            break;
        }
        sum = RadiancePixel();
        turns = turns_before;
        response = responses[select(w, frame.wavelength_count, is_beside)];
        var next = Waiting(straight, 1.0, no_polarisation(), first, chances_of_pixel(pixel, w), 0.0);
        // `go` is called at one place for all light, because compilers inline it with everything it calls, which
        // takes some of them long.
        loop {
            go(next, w);
            if count == 0u {
                break;
            }
            count -= 1u;
            next = waiting[count];
        }
        total.colour += sum.colour;
        total.cover += select(1.0, f32(frame.wavelength_count), is_beside);
        total.unresolved += sum.unresolved;
        total.absorbed += sum.absorbed;
    }
    lit[at] = total;
}
