// The colour that a camera sees of stones under light, one band of wavelengths after the other.

@group(0) @binding(2) var<storage, read_write> lit: array<RadiancePixel>;
@group(0) @binding(10) var<uniform> responses: array<Response, MOST_WAVELENGTHS + 1u>;

// A ray on its way from one stone to another.
struct Waiting {
    ray: Ray,
    weight: f32,
    // The index of the stone that it left.
    left: u32,
}

var<private> sum: RadiancePixel;
var<private> response: Response;
var<private> present: u32;
var<private> waiting: array<Waiting, MOST_WAITING>;
var<private> count: u32;
// The ray from the eye, which the light would follow without any stone.
var<private> straight: Ray;

// Returns the ray on which light is looked up: the twin of `SamplePass::mixed` in src/trace/sampling.rs.
fn mixed(ray: Ray) -> Ray {
    let strength = frame.sample.x;
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

// Adds the light of the environment that arrives along a ray.
fn see(leaving: Ray, weight: f32) {
    let light = radiance(mixed(leaving)) * weight;
    sum.colour += response.key * light.x + response.red * light.y + response.green * light.z + response.blue * light.w;
}

// Whether a ray runs through the ball around a stone.
fn is_near(stone: u32, ray: Ray) -> bool {
    let away = bodies[stone].middle.xyz - ray.origin;
    let along = dot(away, ray.direction);
    let radius = bodies[stone].middle.w;
    return along > -radius && dot(away, away) - along * along < radius * radius;
}

// Whether a ray meets a stone other than `left`, from which it comes, before this distance.
fn meets_any(ray: Ray, left: u32, before: f32) -> bool {
    let own = body;
    var found = false;
    for (var k = 0u; k < frame.counts.x; k++) {
        if !found && k != left && is_near(k, ray) {
            body = bodies[k];
            let distance = meet(ray.origin, ray.direction).distance;
            found = distance > 0.0 && distance < before;
        }
    }
    body = own;
    return found;
}

// Handles light that leaves the present stone: toward another stone it waits to be followed, else it is looked up.
fn leave(ray: Ray, weight: f32, is_surface: bool) {
    if frame.counts.x > 1u && (meets_any(ray, present, FAR) || is_spent()) {
        if count < MOST_WAITING && weight > frame.limits.x {
            waiting[count] = Waiting(ray, weight, present);
            count += 1u;
        } else {
            sum.rest.x += weight;
        }
        return;
    }
    see(ray, weight);
}

// Whether light that has left the present stone meets another before this distance.
fn is_taken(ray: Ray, distance: f32) -> bool {
    return frame.counts.x > 1u && meets_any(ray, present, distance);
}

// Returns where a ray meets the first stone, other than `left`, and makes that stone the present one. The distance is
// negative where it meets none.
fn nearest(ray: Ray, left: u32) -> Meeting {
    var first = Meeting(0u, -1.0);
    for (var k = 0u; k < frame.counts.x; k++) {
        if k == left || !is_near(k, ray) {
            continue;
        }
        body = bodies[k];
        let met = meet(ray.origin, ray.direction);
        if met.distance > 0.0 && (first.distance < 0.0 || met.distance < first.distance) {
            first = met;
            present = k;
        }
    }
    return first;
}

// Follows a ray through the present stone, which it meets at `met`, or looks up the environment where it meets none.
fn go(next: Waiting, met: Meeting, wavelength: u32) {
    if is_spent() {
        sum.rest.x += next.weight;
        return;
    }
    if met.distance < 0.0 {
        see(next.ray, next.weight);
        return;
    }
    body = bodies[present];
    medium = media[present * frame.counts.y + wavelength];
    let rest = follow(next.ray, met, next.weight);
    sum.rest += vec4f(rest.unresolved, rest.absorbed, 0.0, 0.0);
}

@compute @workgroup_size(8, 8)
fn light(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) id: vec3u) {
    let place = strip_pixel(group, id.xy);
    if place.x >= frame.film.x || place.y >= frame.film.w {
        return;
    }
    straight = pixel_ray(vec2u(place.x, frame.film.z + place.y), frame.limits.zw);
    let eye = Waiting(straight, 1.0, NONE);
    // The ray meets the first stone at the same point in all wavelengths.
    let met = nearest(eye.ray, NONE);
    let first = present;
    if met.distance < 0.0 && environment.backdrop.x <= 0.0 {
        return;
    }
    let turns_before = turns;
    let at = place.y * frame.film.x + place.x;
    // Each wavelength is added up alone: so the sum does not depend on how many a dispatch takes.
    var total = lit[at];
    for (var w = frame.turn.z; w < frame.turn.w; w++) {
        // Light that meets no stone is the same at all wavelengths: it is looked up once, for all of them together.
        let is_beside = met.distance < 0.0;
        if is_beside && w > 0u {
            break;
        }
        sum = RadiancePixel();
        turns = turns_before;
        response = responses[select(w, frame.counts.y, is_beside)];
        present = first;
        var next = eye;
        var entered = met;
        // One call of `go` for all light: compilers put all that it calls in its place, which takes some of them long.
        loop {
            go(next, entered, w);
            if count == 0u {
                break;
            }
            count -= 1u;
            next = waiting[count];
            entered = nearest(next.ray, next.left);
        }
        total.colour += vec4f(sum.colour.xyz, select(1.0, f32(frame.counts.y), is_beside));
        total.rest += sum.rest;
    }
    lit[at] = total;
}
