// What a camera sees of stones under light: colour, over a band of wavelengths after the other.

@group(0) @binding(2) var<storage, read_write> lit: array<RadiancePixel>;
@group(0) @binding(10) var<uniform> responses: array<Response, MOST_WAVELENGTHS>;

// A ray on its way from one stone to the next.
struct Waiting {
    ray: Ray,
    weight: f32,
    // The stone it left.
    left: u32,
}

var<private> sum: RadiancePixel;
var<private> response: Response;
var<private> present: u32;
var<private> waiting: array<Waiting, MOST_WAITING>;
var<private> count: u32;
// The ray from the eye.
var<private> straight: Ray;

// The ray on which light is looked up: the twin of `mixed` in src/trace/sitting.rs.
fn mixed(ray: Ray) -> Ray {
    let strength = frame.strength.x;
    if strength >= 1.0 || dot(ray.direction, straight.direction) <= 0.0 {
        return ray;
    }
    let beside = straight.origin + straight.direction * dot(ray.origin - straight.origin, straight.direction);
    let between = mix(straight.direction, ray.direction, strength);
    let length = length(between);
    return Ray(mix(beside, ray.origin, strength), between / length, ray.sweep * (strength / length));
}

fn see(leaving: Ray, weight: f32) {
    let ray = mixed(leaving);
    // It stands for its band's middle.
    let middle = Ray(ray.origin, ray.direction + ray.sweep * frame.limits.y, ray.sweep);
    let light = radiance(middle) * weight;
    sum.colour += response.key * light.x + response.red * light.y + response.green * light.z + response.blue * light.w;
}

// Whether a ray runs through the ball around a stone.
fn is_near(stone: u32, ray: Ray) -> bool {
    let away = bodies[stone].middle.xyz - ray.origin;
    let along = dot(away, ray.direction);
    let radius = bodies[stone].middle.w;
    return along > -radius && dot(away, away) - along * along < radius * radius;
}

// Whether a ray meets a stone other than the one that it left before this distance.
fn meets_any(ray: Ray, left: u32, before: f32) -> bool {
    let own = body;
    var found = false;
    for (var k = 0u; k < frame.counts.x; k++) {
        if !found && k != left && is_near(k, ray) {
            body = bodies[k];
            let distance = entry(ray.origin, ray.direction).distance;
            found = distance > 0.0 && distance < before;
        }
    }
    body = own;
    return found;
}

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

// Whether light that has left the present stone meets another before that distance.
fn is_taken(ray: Ray, distance: f32) -> bool {
    return frame.counts.x > 1u && meets_any(ray, present, distance);
}

// The stone that a ray meets first; it becomes the present one. A negative distance where there is none.
fn nearest(ray: Ray, left: u32) -> Meeting {
    var first = Meeting(0u, -1.0);
    for (var k = 0u; k < frame.counts.x; k++) {
        if k == left || !is_near(k, ray) {
            continue;
        }
        body = bodies[k];
        let met = entry(ray.origin, ray.direction);
        if met.distance > 0.0 && (first.distance < 0.0 || met.distance < first.distance) {
            first = met;
            present = k;
        }
    }
    return first;
}

// Follows a ray through the stone that it meets, or to the light.
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
fn light(@builtin(global_invocation_id) id: vec3u) {
    // The stage holds some rows of the film, and this dispatch sees some of those.
    let row = frame.film.z + id.y;
    let pixel = vec2u(id.x, frame.turn.y + row);
    if id.x >= frame.film.x || id.y >= frame.film.w {
        return;
    }
    sum = RadiancePixel();
    let start = pixel_ray(pixel, frame.limits.zw);
    straight = Ray(start[0], start[1], vec3f(0.0));
    let eye = Waiting(straight, 1.0, NONE);
    // Where it meets the first stone is the same for all wavelengths.
    let met = nearest(eye.ray, NONE);
    let first = present;
    if met.distance >= 0.0 || environment.backdrop.x > 0.0 {
        for (var w = frame.turn.z; w < frame.turn.w; w++) {
            response = responses[w];
            present = first;
            go(eye, met, w);
            while count > 0u {
                count -= 1u;
                let next = waiting[count];
                go(next, nearest(next.ray, next.left), w);
            }
        }
        sum.colour.w = f32(frame.turn.w - frame.turn.z);
    }
    let at = row * frame.film.x + id.x;
    var before = RadiancePixel();
    if frame.turn.x > 0u {
        before = lit[at];
    }
    before.colour += sum.colour;
    before.rest += sum.rest;
    lit[at] = before;
}
