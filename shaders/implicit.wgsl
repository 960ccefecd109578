// Intersection of rays with glass shapes (implicit surfaces). In its frame, each shape reaches 1 from the origin.
// This is the twin of crates/math/src/implicit/roots.rs and of crates/trace/src/ray/facets.rs.
//
// Imports: ImplicitSurface, jets, trace.

@group(0) @binding(1) var<uniform> fields: array<ImplicitSurface, MOST_BODIES>;

const IS_CURVED: bool = true;
// A point counts as on the surface if the function is at most this, which is some roundings.
const ROUNDING: f32 = 5e-7;
// The most steps to a root. Where more are needed, the ray only touches the shape.
const MOST_STEPS: u32 = 200u;
// The search is near a root where the bound is at most this part of the depth at its start.
const NEAR: f32 = 0.5;
// From starts that are less deep than this, the steps go on to the last digits.
const FINE: f32 = 1e-3;
// The least step of a ray outside; a smaller one would be lost to rounding.
const LEAST_STEP: f32 = 1e-7;

// Returns the present body's implicit surface, whose number among all shapes is the first of the body's range.
fn present_field() -> ImplicitSurface {
    return fields[body.range.x];
}

// Returns a point near the surface, moved onto it.
fn polished(point: vec3f) -> vec3f {
    let jet = jet_at(present_field(), point, vec3f(0.0));
    return point - jet.gradient * (jet.value / max(dot(jet.gradient, jet.gradient), LEAST_RADIUS));
}

fn facet_normal(facet: u32, point: vec3f) -> vec3f {
    return normal_of(jet_at(present_field(), point, vec3f(0.0)));
}

fn turned_normal(point: vec3f, by: vec3f) -> vec3f {
    return tamed(bend(present_field(), point, by));
}

fn entry(origin: vec3f, direction: vec3f) -> Meeting {
    return Meeting(0u, way_in(present_field(), origin, direction));
}

// Returns the place where light that leaves the body enters it again. Only a shape with a wave is not convex.
fn again(origin: vec3f, direction: vec3f) -> Meeting {
    let shape = present_field();
    if !has_wave(shape) {
        return Meeting(0u, -1.0);
    }
    return Meeting(0u, way_in(shape, origin, direction));
}

fn next_facet(point: vec3f, direction: vec3f) -> Meeting {
    return Meeting(0u, way_out(present_field(), point, direction));
}

// Removes the wave's shear from a point and a direction. The line through them becomes a curve around the unsheared
// body; the result is the curve's point and its tangent there.
fn tangent(shape: ImplicitSurface, p: vec3f, v: vec3f) -> array<vec3f, 2> {
    if !has_wave(shape) {
        return array<vec3f, 2>(p, v);
    }
    let wave = wave_at(shape, p);
    return array<vec3f, 2>(
        p - vec3f(0.0, 0.0, wave.height),
        v - vec3f(0.0, 0.0, dot(wave.rise, v.xy)),
    );
}

// Returns the distance at which a ray enters the shape; negative where it misses.
fn way_in(shape: ImplicitSurface, o: vec3f, v: vec3f) -> f32 {
    let nearest = -dot(o, v);
    let closest = o + v * nearest;
    if dot(closest, closest) > 1.0 || nearest < -1.0 {
        return -1.0;
    }
    // The steps start near the shape, so that a long way to it costs no digits.
    let start = max(nearest - 1.0, 0.0);
    let from_start = o + v * start;
    let beyond = nearest + 1.0 - start;
    let bend_at_most = most_bend(shape, v);
    var t = 0.0;
    for (var k = 0u; k < MOST_STEPS; k++) {
        turns += 1u;
        let on = tangent(shape, from_start + v * t, v);
        let at = along(shape, on[0], on[1]);
        let value = max(at.x, 0.0);
        let slope = at.y;
        // The step is the root of the bound, value + slope s - bend s²/2.
        let root = sqrt(slope * slope + 2.0 * bend_at_most * value);
        if slope < 0.0 {
            let step = 2.0 * value / max(root - slope, LEAST_GAP);
            if value <= ROUNDING {
                return start + t + min(step, ROUNDING);
            }
            t += max(step, LEAST_STEP);
        } else {
            t += max((slope + root) / max(bend_at_most, LEAST_GAP), LEAST_STEP);
        }
        if t > beyond {
            return -1.0;
        }
    }
    return -1.0;
}

// Returns the distance at which a ray from inside leaves the shape; negative where rounding has let the ray slip out or the
// steps are used up.
fn way_out(shape: ImplicitSurface, p: vec3f, v: vec3f) -> f32 {
    let bend_at_most = most_bend(shape, v);
    var t = 0.0;
    for (var k = 0u; k < MOST_STEPS && !is_spent(); k++) {
        let on = tangent(shape, p + v * t, v);
        let at = along(shape, on[0], on[1]);
        if at.x >= -ROUNDING && at.y >= 0.0 {
            return t;
        }
        let step = far_step(shape, on[0], on[1], at, bend_at_most);
        if step.y < 0.0 {
            return -1.0;
        }
        t += max(step.x, 0.0);
        if bend_at_most == 0.0 {
            return t;
        }
    }
    return -1.0;
}

// Returns a step along the line from `p` in direction `on` that does not pass the far surface. At `p`, the body's
// function has the value `at.x` and the slope `at.y`. The ray's curve lies off the line by at most `bend_at_most`
// s²/2 up or down; the step is at most the far root of the function of the point moved by this away from the middle.
// A straight line is followed to the surface itself. The second number is negative where there is no root.
fn far_step(shape: ImplicitSurface, p: vec3f, on: vec3f, at: vec2f, bend_at_most: f32) -> vec2f {
    // A start that rounding has put outside counts as on the surface. Otherwise a ray that enters at grazing
    // incidence would miss.
    let level = max(at.x, 0.0);
    let depth = max(-at.x, 0.0);
    let squared = dot(on, on);
    let beyond = shape.body_reach / sqrt(squared) - dot(p, on) / squared;
    // Beyond this, the displacement alone puts every point outside the body. The function is convex, so its root is
    // no farther than the root of its tangent.
    var s = min(beyond, sqrt(2.0 * (shape.half + shape.edge) / max(bend_at_most, LEAST_GAP)));
    if at.y > 0.0 {
        s = min(s, depth / at.y);
    }
    for (var k = 0u; k < MOST_STEPS; k++) {
        turns += 1u;
        let at_s = p + on * s;
        let off = vec3f(0.0, 0.0, bend_at_most * sign_of(at_s.z) * s);
        let there = along(shape, at_s + off * (0.5 * s), on + off);
        let value = there.x - level;
        if there.y <= 0.0 {
            return vec2f(s, select(-1.0, 1.0, value <= ROUNDING));
        }
        if bend_at_most > 0.0 && depth > FINE && value < NEAR * depth {
            return vec2f(s * depth / (depth + value), 1.0);
        }
        // Along a straight line, the root is the surface itself, and one more step adds digits.
        let is_there = value <= ROUNDING;
        if !is_there || bend_at_most == 0.0 {
            s -= max(value, 0.0) / there.y;
        }
        if is_there {
            return vec2f(s, 1.0);
        }
    }
    return vec2f(s, -1.0);
}
