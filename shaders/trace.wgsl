// One chain of bounces: the twin of src/trace/ray.rs. What leaves the stone goes to `leave`, which the reading defines;
// what the stone is made of comes from `next_facet` and `plane_of`.

const LEAST_GAP: f32 = 1e-30;
const FAR: f32 = 1e30;

struct Meeting {
    facet: u32,
    distance: f32,
}

// The facet by which a ray from a point outside enters, and the distance to it; a negative distance where it misses.
fn entry(origin: vec3f, direction: vec3f) -> Meeting {
    var into = 0.0;
    var out = FAR;
    var facet = 0u;
    for (var k = 0u; k < frame.counts.x; k++) {
        let plane = plane_of(k);
        let speed = dot(plane.xyz, direction);
        let gap = plane.w - dot(plane.xyz, origin);
        if speed < 0.0 {
            let distance = gap / speed;
            if distance > into {
                into = distance;
                facet = k;
            }
        } else if speed > 0.0 {
            out = min(out, gap / speed);
        } else if gap < 0.0 {
            out = -1.0;
        }
    }
    return Meeting(facet, select(-1.0, into, into > 0.0 && into < out));
}

// What of a ray did not leave the stone.
struct Rest {
    hit: bool,
    absorbed: f32,
    unresolved: f32,
    bounces: u32,
}

fn follow(origin: vec3f, toward: vec3f, index: f32, absorption: f32) -> Rest {
    let entered = entry(origin, toward);
    if entered.distance < 0.0 {
        return Rest(false, 0.0, 0.0, 0u);
    }
    var normal = plane_of(entered.facet).xyz;
    var point = origin + toward * entered.distance;
    let outside = -dot(toward, normal);
    let surface = fresnel(outside, 1.0 / index);
    let glare = reflectances(surface);
    leave(reflect_ray(toward, normal, outside), 0.5 * (glare.x + glare.y), true);
    var direction = refract_ray(toward, normal, 1.0 / index, outside, surface.cos_t);
    var light = vec4f(0.5 - 0.5 * glare, 0.0, 0.0);
    let is_polarised = frame.counts.w == 1u;
    if !is_polarised {
        light = unpolarised(light);
    }
    var s = s_axis(direction, normal, frame.right.xyz);
    var left = 1.0;
    var rest = Rest(true, 0.0, 0.0, 0u);
    while (light.x + light.y) * left > frame.limits.x && rest.bounces < frame.counts.z {
        let facet = next_facet(point, direction);
        let plane = plane_of(facet);
        normal = plane.xyz;
        let cos_i = dot(direction, normal);
        let distance = max(plane.w - dot(normal, point), 0.0) / max(cos_i, LEAST_GAP);
        point += direction * distance;
        let after = left * exp(-absorption * distance);
        rest.absorbed += (light.x + light.y) * (left - after);
        left = after;
        let f = fresnel(cos_i, index);
        if is_polarised {
            let across = s_axis(direction, normal, s);
            light = turned(light, dot(s, across), dot(cross(direction, s), across));
            s = across;
        }
        if f.cos_t > 0.0 {
            leave(refract_ray(direction, -normal, index, cos_i, f.cos_t), passed(light, f) * left, false);
        }
        light = reflected(light, f);
        if !is_polarised {
            light = unpolarised(light);
        }
        direction = reflect_ray(direction, -normal, cos_i);
        rest.bounces += 1u;
    }
    rest.unresolved = (light.x + light.y) * left;
    return rest;
}
