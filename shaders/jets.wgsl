// The functions of glass shapes (implicit surfaces) and their derivatives, in the shape's own frame and in units of
// its reach: the twin of crates/math/src/implicit/jet.rs, profile.rs, body.rs and wave.rs. Of the second
// derivatives, only the product with one displacement is computed.
//
// Imports: ImplicitSurface.

// The least divisor, which is smaller than any radius that a shape is meant to have.
const LEAST_RADIUS: f32 = 1e-6;
const TURN: f32 = 6.2831853;

// A function near a point: its value, its gradient, and the change of the gradient when the point moves by a given
// displacement.
struct Jet {
    value: f32,
    gradient: vec3f,
    change: vec3f,
}

fn plane_jet(value: f32, normal: vec3f) -> Jet {
    return Jet(value, normal, vec3f(0.0));
}

// Returns the distance from an axis or a point. `away` leads from it to the present point, and `by` is the component
// of the displacement perpendicular to the axis.
fn radial(away: vec3f, by: vec3f) -> Jet {
    let value = max(length(away), LEAST_RADIUS);
    let gradient = away / value;
    return Jet(value, gradient, (by - gradient * dot(gradient, by)) / value);
}

// Returns the signed distance from the part that two solids share, from their signed distances along perpendicular
// directions. Where the edge between them is `sharp`, only faces count. It is the twin of `Jet::and`.
fn shared_by(a: Jet, b: Jet, by: vec3f, sharp: bool) -> Jet {
    if sharp || min(a.value, b.value) <= 0.0 {
        if a.value > b.value {
            return a;
        }
        return b;
    }
    let value = max(length(vec2f(a.value, b.value)), LEAST_RADIUS);
    let gradient = (a.gradient * a.value + b.gradient * b.value) / value;
    let sum = a.gradient * dot(a.gradient, by) + b.gradient * dot(b.gradient, by) + a.change * a.value
        + b.change * b.value - gradient * dot(gradient, by);
    return Jet(value, gradient, sum / value);
}

fn sign_of(x: f32) -> f32 {
    return select(-1.0, 1.0, x >= 0.0);
}

fn rectangle_jet(shape: ImplicitSurface, p: vec3f, by: vec3f, sharp: bool) -> Jet {
    let x = plane_jet(abs(p.x) - shape.corner.x, vec3f(sign_of(p.x), 0.0, 0.0));
    let y = plane_jet(abs(p.y) - shape.corner.y, vec3f(0.0, sign_of(p.y), 0.0));
    var jet = shared_by(x, y, by, sharp && shape.round == 0.0);
    jet.value -= shape.round;
    return jet;
}

fn triangle_jet(shape: ImplicitSurface, p: vec3f, by: vec3f, sharp: bool) -> Jet {
    let side = sign_of(p.y);
    let folded = vec2f(abs(p.y), p.z);
    let from_corner = folded - shape.corner;
    let up = dot(from_corner, vec2f(-shape.flank_normal.y, shape.flank_normal.x));
    // Beyond a flank's end the nearest point is a corner; elsewhere it lies on a side.
    let is_above = up > shape.flank_length;
    if !sharp && (is_above || (up < 0.0 && from_corner.x > 0.0)) {
        let away = select(from_corner, folded - vec2f(0.0, shape.round), is_above);
        return radial(vec3f(0.0, side * away.x, away.y), vec3f(0.0, by.yz));
    }
    let base = plane_jet(-from_corner.y, vec3f(0.0, 0.0, -1.0));
    let flank = plane_jet(dot(shape.flank_normal, from_corner), vec3f(0.0, side * shape.flank_normal.x, shape.flank_normal.y));
    if base.value > flank.value {
        return base;
    }
    return flank;
}

// Returns the jet of the body's function for a point on the surface or on the way to it. It is the twin of
// `RoundedBody::jet`.
fn body_jet(shape: ImplicitSurface, p: vec3f, by: vec3f) -> Jet {
    let sharp = shape.edge == 0.0;
    var outline: Jet;
    var end: Jet;
    if shape.is_triangle == 1u {
        outline = triangle_jet(shape, p, by, sharp);
        end = plane_jet(abs(p.x) - shape.half, vec3f(sign_of(p.x), 0.0, 0.0));
    } else {
        outline = rectangle_jet(shape, p, by, sharp);
        end = plane_jet(abs(p.z) - shape.half, vec3f(0.0, 0.0, sign_of(p.z)));
    }
    var jet = shared_by(outline, end, by, sharp);
    jet.value -= shape.edge;
    return jet;
}

// Returns value and slope of the body's function along a line.
fn along(shape: ImplicitSurface, p: vec3f, direction: vec3f) -> vec2f {
    let jet = body_jet(shape, p, vec3f(0.0));
    return vec2f(jet.value, dot(jet.gradient, direction));
}

fn has_wave(shape: ImplicitSurface) -> bool {
    return shape.has_wave == 1u;
}

// Returns sines and cosines of angles given in turns, exact to some roundings. Cards guarantee their own functions
// only to 2^-11, but the wave's slope must fit its height. The polynomials are those of S. L. Moshier, Cephes,
// sinf.c.
fn sin_cos(turns_given: vec2f) -> array<vec2f, 2> {
    let part = turns_given - round(turns_given);
    let quarter = round(part * 4.0);
    let x = (part - quarter * 0.25) * TURN;
    let z = x * x;
    let sine = x + x * z * ((-1.9515295891e-4 * z + 8.3321608736e-3) * z - 1.6666654611e-1);
    let cosine =
        1.0 - 0.5 * z + z * z * ((2.443315711809948e-5 * z - 1.388731625493765e-3) * z + 4.166664568298827e-2);
    let is_odd = abs(quarter) == vec2f(1.0);
    let is_half = abs(quarter) == vec2f(2.0);
    let sines = select(sine, cosine * quarter, is_odd);
    let cosines = select(cosine, -sine * quarter, is_odd);
    return array<vec2f, 2>(select(sines, -sine, is_half), select(cosines, -cosine, is_half));
}

// The wave at a point: the slopes of its height along x and y, its height, and its second derivatives, the pure one,
// which is the same along x and along y, and the mixed one.
struct Wave {
    rise: vec2f,
    height: f32,
    bend: vec2f,
}

fn wave_at(shape: ImplicitSurface, p: vec3f) -> Wave {
    let angles = sin_cos(vec2f(p.x - p.y, p.x + p.y) * shape.waves + vec2f(0.0, 2.0 * shape.phase));
    let sines = angles[0];
    let cosines = angles[1];
    let number = TURN * shape.waves;
    let half = 0.5 * shape.amplitude;
    let rise = vec2f(sines.y - sines.x, sines.y + sines.x) * (half * number);
    let bend = vec2f(cosines.y - cosines.x, cosines.y + cosines.x) * (half * number * number);
    return Wave(rise, half * (cosines.x - cosines.y), bend);
}

// Returns an upper bound for the rate of change of the wave's slope along a line of this direction.
fn most_bend(shape: ImplicitSurface, direction: vec3f) -> f32 {
    let number = TURN * shape.waves;
    return shape.amplitude * number * number * dot(direction.xy, direction.xy);
}

// Returns the jet of the shape's function for a point on the surface: that of the body, sheared by the wave as in
// `Wave::shear`.
fn jet_at(shape: ImplicitSurface, p: vec3f, by: vec3f) -> Jet {
    if !has_wave(shape) {
        return body_jet(shape, p, by);
    }
    let wave = wave_at(shape, p);
    let rise = vec3f(wave.rise, 0.0);
    let jet = body_jet(shape, p - vec3f(0.0, 0.0, wave.height), by - vec3f(0.0, 0.0, dot(rise, by)));
    let falling = jet.gradient.z;
    let bent = vec3f(wave.bend.x * by.x + wave.bend.y * by.y, wave.bend.y * by.x + wave.bend.x * by.y, 0.0);
    return Jet(jet.value, jet.gradient - rise * falling, jet.change - rise * jet.change.z - bent * falling);
}

// Returns the unit normal at a jet. It is the twin of `Jet::normal`.
fn normal_of(jet: Jet) -> vec3f {
    return jet.gradient / max(length(jet.gradient), LEAST_RADIUS);
}

// Returns the change of the unit normal over the component of a displacement along the surface. It is the twin of
// `ImplicitSurface::bend`, times the displacement.
fn bend(shape: ImplicitSurface, p: vec3f, by: vec3f) -> vec3f {
    let normal = normal_of(jet_at(shape, p, vec3f(0.0)));
    let jet = jet_at(shape, p, by - normal * dot(normal, by));
    return (jet.change - normal * dot(normal, jet.change)) / max(length(jet.gradient), LEAST_RADIUS);
}
