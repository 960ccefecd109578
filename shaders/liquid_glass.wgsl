// Panes of liquid glass: the twin of crates/picture/src/liquid_glass, whose functions have the same names and
// describe them. The tests are in crates/picture/src/liquid_glass/on_card.rs.
//
// Imports: PaneData.

@group(0) @binding(0) var<uniform> pane: PaneData;
@group(0) @binding(1) var<storage, read> background: array<vec4f>;
@group(0) @binding(2) var<storage, read_write> drawn: array<vec4f>;

// The least slope of the field by which a distance is divided.
const FLAT = 1e-9;

// The standard deviation of the frost at full intensity and roughness.
const BLUR = 0.003;

// The displacement of red, green and blue by dispersion, in units of its strength.
const PARTS = vec3f(1.1, 0.0, -0.9);

struct PaneField {
    value: f32,
    slope: vec2f,
}

struct DomePoint {
    distance: f32,
    radial: vec2f,
    normal: vec3f,
}

// Returns the ramps along x and y, and their slopes.
fn ramp(at: vec2f) -> vec4f {
    let half = pane.half;
    let level = pane.level;
    let round = pane.round;
    let part = abs(at) / half;
    let rim = max(abs(at) - level, vec2f(0.0)) / (half - level);
    let value = round * part * part + (1.0 - round) * rim * rim * rim;
    let slope = 2.0 * round * part / half + 3.0 * (1.0 - round) * rim * rim / (half - level);
    return vec4f(value, select(slope, -slope, at < vec2f(0.0)));
}

fn field(at: vec2f) -> PaneField {
    let ramps = ramp(at);
    let corner = pane.corner;
    let slope = ramps.zw * (1.0 - corner * ramps.yx);
    return PaneField(ramps.x + ramps.y - corner * ramps.x * ramps.y, slope);
}

fn outline_distance(at: vec2f) -> f32 {
    let here = field(at);
    let beside = abs(at) - pane.half;
    return max((here.value - 1.0) / max(length(here.slope), FLAT), max(beside.x, beside.y));
}

fn dome(at: vec2f) -> DomePoint {
    let half = pane.half;
    let here = field(clamp(at, -half, half));
    let value = clamp(here.value, 0.0, 1.0);
    let normal = vec3f(here.slope * (0.5 * min(half.x, half.y)), sqrt(1.0 - value));
    let long = length(normal);
    let far = length(at);
    return DomePoint(
        sqrt(value),
        select(vec2f(0.0), at / max(far, FLAT), far > 0.0),
        select(vec3f(0.0, 0.0, 1.0), normal / max(long, FLAT), long > 0.0),
    );
}

fn falloff(distance: f32) -> f32 {
    return smoothstep(0.0, 0.8, distance) * (1.0 - smoothstep(0.95, 1.0, distance));
}

fn refraction(top: DomePoint) -> vec2f {
    let shift = top.normal.xy * 0.015 + top.radial * (top.distance * 0.008);
    return shift * (falloff(top.distance) * pane.refraction);
}

fn depth(top: DomePoint) -> vec2f {
    let thickness = pane.thickness;
    return (top.normal.xy * (thickness * 0.1) + vec2f(0.0, thickness * 0.05)) * (1.0 - 0.3 * top.distance);
}

fn dispersion(top: DomePoint) -> vec2f {
    return top.radial * (top.distance * 0.003 * pane.dispersion);
}

fn pcg(v: u32) -> u32 {
    let state = v * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

fn lattice_value(at: vec2i, seed: u32) -> f32 {
    return f32(pcg(u32(at.x) ^ pcg(u32(at.y) ^ pcg(seed)))) / 4294967295.0;
}

fn octave(at: vec2f, seed: u32) -> f32 {
    let base = vec2i(floor(at));
    let part = at - floor(at);
    let even = part * part * (3.0 - 2.0 * part);
    let high = mix(lattice_value(base, seed), lattice_value(base + vec2i(1, 0), seed), even.x);
    let low = mix(lattice_value(base + vec2i(0, 1), seed), lattice_value(base + vec2i(1, 1), seed), even.x);
    return mix(high, low, even.y);
}

fn roughness(at: vec2f) -> f32 {
    return (0.5 * octave(at * 40.0, 0u) + 0.3 * octave(at * 80.0, 1u) + 0.2 * octave(at * 160.0, 2u)) / 3.0;
}

fn blur(at: vec2f, top: DomePoint) -> f32 {
    return (abs(top.normal.x) + abs(top.normal.y)) * pane.frost * roughness(at) * BLUR;
}

fn brightness(normal: vec3f) -> f32 {
    let diffuse = max(dot(normal, pane.toward), 0.0);
    var shine = max(dot(normal, pane.between), 0.0);
    for (var k = 0u; k < 5u; k += 1u) {
        shine *= shine;
    }
    let rim = 1.0 - normal.z;
    return 0.3 * diffuse + 0.5 * shine + 0.3 * (rim * rim * rim);
}

// Returns the light at a place some pixels beside the middle of a pixel, interpolated between the four pixels around
// the place.
fn around(at: vec2i, by: vec2f) -> vec3f {
    let base = floor(by);
    let part = by - base;
    let last = vec2i(pane.size) - 1;
    let first = clamp(at + vec2i(base), vec2i(0), last);
    let next = clamp(at + vec2i(base) + 1, vec2i(0), last);
    let width = i32(pane.size.x);
    let high = mix(background[first.y * width + first.x].xyz, background[first.y * width + next.x].xyz, part.x);
    let low = mix(background[next.y * width + first.x].xyz, background[next.y * width + next.x].xyz, part.x);
    return mix(high, low, part.y);
}

// Returns the weighted mean of the frost's samples, whose places are in standard deviations.
fn frosted(at: vec2i, by: vec2f, sigma: f32) -> vec3f {
    var five = array<vec3f, 5>(
        vec3f(0.0, 0.0, 1.0 / 3.0),
        vec3f(1.0, 0.0, 1.0 / 6.0),
        vec3f(-1.0, 0.0, 1.0 / 6.0),
        vec3f(0.0, 1.0, 1.0 / 6.0),
        vec3f(0.0, -1.0, 1.0 / 6.0),
    );
    var three = array<vec3f, 3>(
        vec3f(0.0, 0.0, 2.0 / 3.0),
        vec3f(1.0, 0.0, 1.0 / 6.0),
        vec3f(-1.0, 0.0, 1.0 / 6.0),
    );
    if sigma <= 0.0 {
        return around(at, by);
    }
    var sum = vec3f(0.0);
    for (var k = 0u; k < pane.sample_count; k += 1u) {
        var tap = three[min(k, 2u)];
        if pane.sample_count == 5u {
            tap = five[k];
        }
        sum += tap.z * around(at, by + tap.xy * (1.7320508 * sigma));
    }
    return sum;
}

fn colour(at: vec2i, own: vec2f) -> vec3f {
    let top = dome(own);
    let unit = pane.unit;
    let shift = -(refraction(top) + depth(top)) * unit;
    let apart = dispersion(top) * unit;
    let sigma = blur(own, top) * unit;
    var seen = frosted(at, shift, sigma);
    if pane.dispersion > 0.0 {
        seen.x = frosted(at, shift + apart * PARTS.x, sigma).x;
        seen.z = frosted(at, shift + apart * PARTS.z, sigma).z;
    }
    return seen + pane.colour.xyz * brightness(top.normal);
}

@compute @workgroup_size(8, 8)
fn draw(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= pane.size) {
        return;
    }
    let k = id.y * pane.size.x + id.x;
    var pixel = vec4f(0.0);
    if pane.is_over == 1u {
        pixel = vec4f(background[k].xyz, 1.0);
    }
    let own = (vec2f(id.xy) + 0.5 - pane.middle) / pane.unit;
    let cover = clamp(0.5 - outline_distance(own) * pane.unit, 0.0, 1.0);
    if cover > 0.0 && pane.sample_count > 0u {
        pixel += (vec4f(colour(vec2i(id.xy), own), 1.0) - pixel) * cover;
    }
    drawn[k] = pixel;
}
