// One chain of bounces: the twin of src/trace/ray.rs. What leaves the stone goes to `leave`, which the reading defines;
// what the stone is made of comes from `entry`, `next_facet` and `plane_of`.

const LEAST_GAP: f32 = 1e-30;
const FAR: f32 = 1e30;

// The stone that is traced, and what it is made of.
var<private> body: Body;
var<private> medium: Medium;

struct Meeting {
    facet: u32,
    distance: f32,
}

// A ray, and how far its direction moves over the wavelengths that it stands for.
struct Ray {
    origin: vec3f,
    direction: vec3f,
    sweep: vec3f,
}

// What of a ray did not leave the stone.
struct Rest {
    absorbed: f32,
    unresolved: f32,
    bounces: u32,
}

fn transmittance(path: f32) -> f32 {
    return 0.5 * (exp(-medium.absorption_o * path) + exp(-medium.absorption_e * path));
}

// Follows a ray that enters the body at a facet, of light of this weight.
fn follow(ray: Ray, entered: Meeting, weight: f32) -> Rest {
    var normal = plane_of(entered.facet).xyz;
    var point = ray.origin + ray.direction * entered.distance;
    let outside = -dot(ray.direction, normal);
    let surface = fresnel(outside, 1.0 / medium.index);
    let glare = reflectances(surface);
    leave(
        Ray(point, reflect_ray(ray.direction, normal, outside), mirrored(ray.sweep, normal)),
        weight * 0.5 * (glare.x + glare.y),
        true,
    );
    let of_eta = -medium.spread / (medium.index * medium.index);
    var direction = refract_ray(ray.direction, normal, 1.0 / medium.index, outside, surface.cos_t);
    var sweep = refracted_change(ray.direction, normal, 1.0 / medium.index, outside, surface.cos_t, ray.sweep, of_eta);
    var light = vec4f((0.5 - 0.5 * glare) * weight, 0.0, 0.0);
    let is_polarised = frame.counts.w == 1u;
    if !is_polarised {
        light = unpolarised(light);
    }
    var s = s_axis(direction, normal, frame.right.xyz);
    var left = 1.0;
    var path = 0.0;
    var rest = Rest(0.0, 0.0, 0u);
    while (light.x + light.y) * left > frame.limits.x && rest.bounces < frame.counts.z {
        let facet = next_facet(point, direction);
        let plane = plane_of(facet);
        normal = plane.xyz;
        let cos_i = dot(direction, normal);
        let distance = max(plane.w - dot(normal, point), 0.0) / max(cos_i, LEAST_GAP);
        point += direction * distance;
        path += distance;
        let after = transmittance(path);
        rest.absorbed += (light.x + light.y) * (left - after);
        left = after;
        let f = fresnel(cos_i, medium.index);
        if is_polarised {
            let across = s_axis(direction, normal, s);
            light = turned(light, dot(s, across), dot(cross(direction, s), across));
            s = across;
        }
        if f.cos_t > 0.0 {
            let onward = refract_ray(direction, -normal, medium.index, cos_i, f.cos_t);
            let swept = refracted_change(direction, -normal, medium.index, cos_i, f.cos_t, sweep, medium.spread);
            leave(Ray(point, onward, swept), passed(light, f) * left, false);
        }
        light = reflected(light, f);
        if !is_polarised {
            light = unpolarised(light);
        }
        direction = reflect_ray(direction, -normal, cos_i);
        sweep = mirrored(sweep, normal);
        rest.bounces += 1u;
    }
    rest.unresolved = (light.x + light.y) * left;
    return rest;
}
