// What a camera sees of stones under light: colour, over a band of wavelengths after the other.

@group(0) @binding(2) var<storage, read_write> lit: array<Lit>;
@group(0) @binding(10) var<uniform> responses: array<Response, MOST_WAVELENGTHS>;

// A ray on its way from one stone to the next.
struct Waiting {
    ray: Ray,
    weight: f32,
    // The stone it left.
    left: u32,
}

var<private> sum: Lit;
var<private> response: Response;
var<private> present: u32;
var<private> waiting: array<Waiting, MOST_WAITING>;
var<private> count: u32;

fn see(ray: Ray, weight: f32) {
    let light = radiance(ray) * weight;
    sum.colour += response.key * light.x + response.red * light.y + response.green * light.z + response.blue * light.w;
}

// Whether a ray comes so near to a stone other than the one that it left that it may meet it.
fn may_meet(ray: Ray, left: u32) -> bool {
    for (var k = 0u; k < frame.counts.x; k++) {
        let away = bodies[k].middle.xyz - ray.origin;
        let along = dot(away, ray.direction);
        let radius = bodies[k].middle.w;
        if k != left && along > -radius && dot(away, away) - along * along < radius * radius {
            return true;
        }
    }
    return false;
}

fn leave(ray: Ray, weight: f32, is_surface: bool) {
    if frame.counts.x > 1u && may_meet(ray, present) {
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

// Follows a ray to the nearest stone, or to the light.
fn go(next: Waiting, wavelength: u32) {
    var nearest = Meeting(0u, -1.0);
    for (var k = 0u; k < frame.counts.x; k++) {
        if k == next.left {
            continue;
        }
        body = bodies[k];
        let met = entry(next.ray.origin, next.ray.direction);
        if met.distance > 0.0 && (nearest.distance < 0.0 || met.distance < nearest.distance) {
            nearest = met;
            present = k;
        }
    }
    if nearest.distance >= 0.0 {
        body = bodies[present];
        medium = media[present * frame.counts.y + wavelength];
        let rest = follow(next.ray, nearest, next.weight);
        sum.rest += vec4f(rest.unresolved, rest.absorbed, f32(rest.bounces), 0.0);
    } else if next.left != NONE {
        see(next.ray, next.weight);
    }
}

@compute @workgroup_size(8, 8)
fn light(@builtin(global_invocation_id) id: vec3u) {
    // The stage holds some rows of the film, and this dispatch sees some of those.
    let row = frame.film.z + id.y;
    let pixel = vec2u(id.x, frame.turn.y + row);
    if id.x >= frame.film.x || id.y >= frame.film.w {
        return;
    }
    sum = Lit();
    let start = pixel_ray(pixel, frame.limits.zw);
    let eye = Ray(start[0], start[1], vec3f(0.0));
    var hit = false;
    for (var w = frame.turn.z; w < frame.turn.w; w++) {
        response = responses[w];
        waiting[0] = Waiting(eye, 1.0, NONE);
        count = 1u;
        present = NONE;
        while count > 0u {
            count -= 1u;
            go(waiting[count], w);
        }
        hit = present != NONE;
        if !hit && surround.backdrop.x > 0.0 {
            see(eye, 1.0);
        }
    }
    if hit || surround.backdrop.x > 0.0 {
        sum.colour.w = f32(frame.turn.w - frame.turn.z);
    }
    let at = row * frame.film.x + id.x;
    var before = Lit();
    if frame.turn.x > 0u {
        before = lit[at];
    }
    before.colour += sum.colour;
    before.rest += sum.rest;
    lit[at] = before;
}
