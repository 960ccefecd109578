// One chain of bounces, the twin of crates/trace/src/ray.rs. Light that leaves the stone goes to `depart` and from
// there to `leave`, which scope.wgsl or light.wgsl defines. The functions `entry`, `next_facet`, `facet_normal`,
// `turned_normal` and `polished`, and the constant `IS_CURVED`, describe the surface. Everything here is in the frame of
// the body, whose unit lengths and absorption have; pose.wgsl converts to it and back.
//
// Imports: Body, Medium, ray, optics, basis.

@group(0) @binding(4) var<uniform> bodies: array<Body, MOST_BODIES>;
@group(0) @binding(5) var<storage, read> media: array<vec4f>;

// The least gap before a plane, so that one that rounding has put behind the point is met immediately; also the
// least divisor of a step.
const LEAST_GAP: f32 = 1e-30;
const FAR: f32 = 1e30;
// The greatest component of a fan or a shift. A larger fan would cover more than the whole sphere, and a larger shift
// more than the solid, and each bounce may multiply them.
const WIDEST_FAN: f32 = 1e4;

// The stone that is being traced, and its medium at the present wavelength.
var<private> body: Body;
var<private> medium: Medium;
// The number of loop turns of the ray so far, where turns are counted. With too many, the ray's light is unresolved.
var<private> turns: u32;

// The facet that a ray meets, and the distance to it. A negative distance means that there is none.
struct Meeting {
    facet: u32,
    distance: f32,
}

// The part of a ray's light that did not leave the stone, and the number of its bounces.
struct Rest {
    absorbed: f32,
    unresolved: f32,
    bounces: u32,
}

// Returns the medium that four numbers describe.
fn medium_of(numbers: vec4f) -> Medium {
    return Medium(numbers.x, numbers.y, numbers.z, numbers.w);
}

// Returns the share of light that is left after a path through the medium.
fn transmittance(path: f32) -> f32 {
    return 0.5 * (exp(-medium.absorption_o * path) + exp(-medium.absorption_e * path));
}

// Returns whether the ray has taken too many loop turns.
fn is_spent() -> bool {
    return turns > frame.most_turns;
}

// Light outside the body that is about to enter it or has just left it. `light` is the light without absorption,
// whose axis s is `s`, and `left` is the share that absorption has left. `path` and `bounce` are the length
// of its path and the number of bounces inside so far.
struct Inbound {
    met: Meeting,
    ray: Ray,
    light: Coherency,
    s: vec3f,
    left: f32,
    path: f32,
    bounce: u32,
}

// The polarisation of light outside: its coherency matrix at any weight, whose axis s is `s`. A zero vector `s` stands
// for light that is not polarised.
struct Polarisation {
    light: Coherency,
    s: vec3f,
}

// Returns the polarisation of light that is not polarised.
fn no_polarisation() -> Polarisation {
    return Polarisation(Coherency(), vec3f(0.0));
}

// Returns light of this weight that meets the body at `met`.
fn inbound_of(ray: Ray, met: Meeting, weight: f32, polarisation: Polarisation) -> Inbound {
    if dot(polarisation.s, polarisation.s) > 0.0 {
        let light = times(polarisation.light, weight / weight_of(polarisation.light));
        return Inbound(met, ray, light, polarisation.s, 1.0, 0.0, 0u);
    }
    // Light that is not polarised is the same along all axes perpendicular to its ray.
    return Inbound(met, ray, of_weight(weight), orthonormal_pair(ray.direction)[1], 1.0, 0.0, 0u);
}

// Returns a vector, scaled down so that no component exceeds WIDEST_FAN.
fn limited(v: vec3f) -> vec3f {
    let size = abs(v);
    return v * min(WIDEST_FAN / max(max(size.x, size.y), max(size.z, LEAST_GAP)), 1.0);
}

// Returns a vector, which is scaled down on curved bodies so that no component exceeds WIDEST_FAN.
fn tamed(v: vec3f) -> vec3f {
    if !IS_CURVED {
        return v;
    }
    return limited(v);
}

// Returns the displacement along the surface of the point where a ray meets it, when the ray there moves by `by`.
fn along_surface(by: vec3f, direction: vec3f, normal: vec3f) -> vec3f {
    let speed = dot(normal, direction);
    let divisor = select(min(speed, -LEAST_COS), max(speed, LEAST_COS), speed > 0.0);
    return limited(by - direction * (dot(normal, by) / divisor));
}

// Returns the distance to a plane toward which a ray inside runs.
fn distance_to(plane: vec4f, point: vec3f, direction: vec3f) -> f32 {
    return max(plane.w - dot(plane.xyz, point), 0.0) / max(dot(plane.xyz, direction), LEAST_GAP);
}

// Follows light through the body, from the facet where it enters until too little is left or the bounces are used up.
fn passage(inbound: Inbound) -> Rest {
    let ray = inbound.ray;
    let is_polarised = frame.is_polarised == 1u;
    var point = ray.origin + ray.direction * inbound.met.distance;
    var normal = facet_normal(inbound.met.facet, point);
    var shift = along_surface(ray.shift + ray.fan * inbound.met.distance, ray.direction, normal);
    var of_normal = turned_normal(point, shift);
    let outside = -dot(ray.direction, normal);
    let surface = fresnel(outside, 1.0 / medium.index);
    var s = s_axis(ray.direction, normal, inbound.s);
    var light = inbound.light;
    if is_polarised {
        light = turned_to(light, s, inbound.s, ray.direction);
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
    let turned_back = tamed(reflected_change(ray.direction, normal, ray.fan, of_normal));
    let back = Ray(point, reflect_ray(ray.direction, normal, outside), turned_back, shift);
    depart(Inbound(Meeting(NONE, 0.0), back, glare, s, left, path, rest.bounces));
    let of_eta = -medium.spread / (medium.index * medium.index);
    var direction = refract_ray(ray.direction, normal, 1.0 / medium.index, outside, surface.cos_t);
    let eta = 1.0 / medium.index;
    var fan =
        tamed(refracted_change(ray.direction, normal, eta, outside, surface.cos_t, ray.fan, of_normal, of_eta));
    while weight_of(light) * left > frame.least_weight && rest.bounces < frame.most_bounces {
        let next = next_facet(point, direction);
        // Rounding has let the ray slip out of the body.
        if next.distance < 0.0 {
            break;
        }
        point += direction * next.distance;
        path += next.distance;
        normal = facet_normal(next.facet, point);
        let cos_i = dot(direction, normal);
        shift = along_surface(shift + fan * next.distance, direction, normal);
        of_normal = turned_normal(point, shift);
        let after = transmittance(path);
        rest.absorbed += weight_of(light) * (left - after);
        left = after;
        let f = fresnel(cos_i, medium.index);
        if is_polarised {
            let across = s_axis(direction, normal, s);
            light = turned_to(light, across, s, direction);
            s = across;
        }
        rest.bounces += 1u;
        if f.cos_t > 0.0 {
            let onward = refract_ray(direction, -normal, medium.index, cos_i, f.cos_t);
            let fanned =
                refracted_change(direction, -normal, medium.index, cos_i, f.cos_t, fan, -of_normal, medium.spread);
            var gone = transmitted(light, f);
            if !is_polarised {
                gone = unpolarised(gone);
            }
            let out = Ray(point, onward, tamed(fanned), shift);
            depart(Inbound(Meeting(NONE, 0.0), out, gone, s, left, path, rest.bounces));
        }
        light = reflected(light, f);
        if !is_polarised {
            light = unpolarised(light);
        }
        fan = tamed(reflected_change(direction, normal, fan, of_normal));
        direction = reflect_ray(direction, -normal, cos_i);
    }
    rest.unresolved = weight_of(light) * left;
    return rest;
}
