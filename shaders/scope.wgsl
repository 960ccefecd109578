// What a camera in a scope records of each pixel, and the strongest exits: energy by band.

@group(0) @binding(2) var<storage, read_write> seen: array<Seen>;

var<private> sum: Seen;
var<private> strongest_weight: f32;
var<private> strongest_band: u32;

// How many of the borders lie below the direction: the sines of the bands' elevations, rising.
fn band_of(direction: vec3f) -> u32 {
    let up = dot(direction, frame.zenith.xyz);
    let above = vec4u(select(vec4f(0.0), vec4f(1.0), vec4f(up) >= frame.borders_low))
        + vec4u(select(vec4f(0.0), vec4f(1.0), vec4f(up) >= frame.borders_high));
    return above.x + above.y + above.z + above.w;
}

fn marked(band: u32, first: u32) -> vec4f {
    return select(vec4f(0.0), vec4f(1.0), vec4u(band) == vec4u(0u, 1u, 2u, 3u) + first);
}

fn leave(direction: vec3f, weight: f32, is_surface: bool) {
    let band = band_of(direction);
    if is_surface {
        sum.surface[0] += marked(band, 0u) * weight;
        sum.surface[1] += marked(band, 4u) * weight;
        return;
    }
    sum.transmitted[0] += marked(band, 0u) * weight;
    sum.transmitted[1] += marked(band, 4u) * weight;
    if weight > strongest_weight {
        strongest_weight = weight;
        strongest_band = band;
    }
}

// A point outside the stone on the ray through a point of the image plane, and the ray's direction.
fn camera_ray(p: vec2f) -> array<vec3f, 2> {
    let at = frame.right.xyz * p.x + frame.up.xyz * p.y;
    var direction = -frame.toward.xyz;
    var from_eye = FAR;
    if frame.toward.w > 0.0 {
        let ray = at - frame.toward.xyz * frame.toward.w;
        from_eye = length(ray);
        direction = ray / from_eye;
    }
    return array<vec3f, 2>(at - direction * min(from_eye, 2.0 * frame.right.w + length(at)), direction);
}

@compute @workgroup_size(8, 8)
fn scope(@builtin(global_invocation_id) id: vec3u) {
    let size = frame.film.x;
    let pixel = vec2u(id.x, frame.film.y + id.y);
    if pixel.x >= size || id.y >= frame.film.z {
        return;
    }
    sum = Seen();
    strongest_weight = 0.0;
    strongest_band = NONE;
    // The ray stands in one cell of the pixel's grid.
    let grid = frame.film.w;
    let turn = frame.turn.x;
    let step = (vec2f(f32(turn % grid), f32(turn / grid)) + frame.limits.zw) / f32(grid);
    let centred = vec2f(pixel) + step - 0.5 * f32(size);
    let ray = camera_ray(vec2f(centred.x, -centred.y) * (2.0 * frame.limits.y / f32(size)));
    let rest = follow(ray[0], ray[1], frame.zenith.w, frame.up.w);
    if rest.hit {
        sum.rest = vec4f(rest.absorbed, rest.unresolved, 1.0, 0.0);
        sum.strongest[0] = marked(strongest_band, 0u);
        sum.strongest[1] = marked(strongest_band, 4u);
        if strongest_band == NONE || rest.unresolved > strongest_weight {
            sum.rest.w = 1.0;
        }
    }
    let share = 1.0 / f32(grid * grid);
    let at = id.y * size + id.x;
    var before = seen[at];
    if turn == 0u {
        before = Seen();
    }
    for (var i = 0u; i < 2u; i++) {
        before.transmitted[i] += sum.transmitted[i] * share;
        before.surface[i] += sum.surface[i] * share;
        before.strongest[i] += sum.strongest[i] * share;
    }
    before.rest += sum.rest * share;
    seen[at] = before;
}
