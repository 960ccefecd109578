// One chain of bounces: the twin of src/trace/ray.rs. What leaves the stone goes to `depart` and from there to `leave`, which
// the reading defines; what the stone is made of comes from `entry`, `next_facet` and `plane_of`.

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

// Light outside on its way into the body: along `s` and direction × s, without what has been absorbed, and the part that has
// not been; length of its way and bounces inside so far.
struct Inbound {
    met: Meeting,
    ray: Ray,
    light: vec4f,
    s: vec3f,
    left: f32,
    path: f32,
    bounce: u32,
}

// Light of this weight, of all polarisations alike, that meets the body.
fn arriving(ray: Ray, met: Meeting, weight: f32) -> Inbound {
    let s = s_axis(ray.direction, plane_of(met.facet).xyz, frame.right.xyz);
    return Inbound(met, ray, vec4f(vec2f(0.5 * weight), 0.0, 0.0), s, 1.0, 0.0, 0u);
}

// How far it is to a plane that a ray inside runs toward.
fn distance_to(plane: vec4f, point: vec3f, direction: vec3f) -> f32 {
    return max(plane.w - dot(plane.xyz, point), 0.0) / max(dot(plane.xyz, direction), LEAST_GAP);
}

// The way of light through the body, from the facet where it enters until too little is left.
fn passage(inbound: Inbound) -> Rest {
    let ray = inbound.ray;
    let is_polarised = frame.counts.w == 1u;
    var normal = plane_of(inbound.met.facet).xyz;
    var point = ray.origin + ray.direction * inbound.met.distance;
    let outside = -dot(ray.direction, normal);
    let surface = fresnel(outside, 1.0 / medium.index);
    var s = s_axis(ray.direction, normal, inbound.s);
    var light = inbound.light;
    if is_polarised {
        light = turned(light, dot(inbound.s, s), dot(cross(ray.direction, inbound.s), s));
    }
    var left = inbound.left;
    var path = inbound.path;
    var rest = Rest(0.0, 0.0, inbound.bounce);
    var glare = reflected(light, surface);
    light = transmitted(light, surface);
    if !is_polarised {
        glare = unpolarised(glare);
        light = unpolarised(light);
    }
    let back = Ray(point, reflect_ray(ray.direction, normal, outside), mirrored(ray.sweep, normal));
    depart(back, glare, s, left, path, rest.bounces);
    let of_eta = -medium.spread / (medium.index * medium.index);
    var direction = refract_ray(ray.direction, normal, 1.0 / medium.index, outside, surface.cos_t);
    var sweep = refracted_change(ray.direction, normal, 1.0 / medium.index, outside, surface.cos_t, ray.sweep, of_eta);
    while (light.x + light.y) * left > frame.limits.x && rest.bounces < frame.counts.z {
        let next = next_facet(point, direction);
        // Rounding has let it slip out.
        if next.distance < 0.0 {
            break;
        }
        normal = plane_of(next.facet).xyz;
        let cos_i = dot(direction, normal);
        point += direction * next.distance;
        path += next.distance;
        let after = transmittance(path);
        rest.absorbed += (light.x + light.y) * (left - after);
        left = after;
        let f = fresnel(cos_i, medium.index);
        if is_polarised {
            let across = s_axis(direction, normal, s);
            light = turned(light, dot(s, across), dot(cross(direction, s), across));
            s = across;
        }
        rest.bounces += 1u;
        if f.cos_t > 0.0 {
            let onward = refract_ray(direction, -normal, medium.index, cos_i, f.cos_t);
            let swept = refracted_change(direction, -normal, medium.index, cos_i, f.cos_t, sweep, medium.spread);
            var gone = transmitted(light, f);
            if !is_polarised {
                gone = unpolarised(gone);
            }
            depart(Ray(point, onward, swept), gone, s, left, path, rest.bounces);
        }
        light = reflected(light, f);
        if !is_polarised {
            light = unpolarised(light);
        }
        direction = reflect_ray(direction, -normal, cos_i);
        sweep = mirrored(sweep, normal);
    }
    rest.unresolved = (light.x + light.y) * left;
    return rest;
}
