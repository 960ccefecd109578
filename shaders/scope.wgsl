// Records, for each pixel of a picture in a scope, the energy by band and the bands of the strongest exits.
//
// Imports: Bands, ScopePixel, trace, pose, camera, tiles.

@group(0) @binding(2) var<storage, read_write> seen: array<ScopePixel>;
@group(0) @binding(6) var<uniform> bands: Bands;

var<private> sum: ScopePixel;
var<private> strongest_weight: f32;
var<private> strongest_band: u32;

// Returns the band of a direction: the number of borders at or below it. Borders are the sines of the bands'
// elevations, in ascending order.
fn band_of(direction: vec3f) -> u32 {
    let up = dot(direction, bands.zenith.xyz);
    let above = vec4u(select(vec4f(0.0), vec4f(1.0), vec4f(up) >= bands.borders_low))
        + vec4u(select(vec4f(0.0), vec4f(1.0), vec4f(up) >= bands.borders_high));
    return above.x + above.y + above.z + above.w;
}

// Returns 1 in a band's place among the four from `first`, 0 elsewhere.
fn marked(band: u32, first: u32) -> vec4f {
    return select(vec4f(0.0), vec4f(1.0), vec4u(band) == vec4u(0u, 1u, 2u, 3u) + first);
}

// Adds light that leaves the stone to its band.
fn leave(ray: Ray, weight: f32, polarisation: Polarisation, is_surface: bool) {
    let band = band_of(ray.direction);
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

// Returns whether light that has left the stone meets another one: never, because a scope holds one stone alone.
fn is_taken(ray: Ray, distance: f32) -> bool {
    return false;
}

@compute @workgroup_size(8, 8)
fn scope(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) id: vec3u) {
    let place = strip_pixel(group, id.xy);
    if place.x >= frame.size.x || place.y >= frame.row_count {
        return;
    }
    sum = ScopePixel();
    strongest_weight = 0.0;
    strongest_band = NONE;
    body = bodies[0];
    medium = medium_of(media[0]);
    // A dispatch traces the ray in one cell of the pixel's grid.
    let grid = frame.grid;
    let turn = frame.cell;
    let cell = vec2f(f32(turn % grid), f32(turn / grid));
    let ray = pixel_ray(vec2u(place.x, frame.first_row + place.y), (cell + frame.place) / f32(grid));
    let entered = meet(ray.origin, ray.direction);
    if entered.distance >= 0.0 {
        let rest = follow(ray, entered, 1.0, no_polarisation());
        sum.absorbed = rest.absorbed;
        sum.unresolved = rest.unresolved;
        sum.hit = 1.0;
        sum.strongest[0] = marked(strongest_band, 0u);
        sum.strongest[1] = marked(strongest_band, 4u);
        if strongest_band == NONE || rest.unresolved > strongest_weight {
            sum.undecided = 1.0;
        }
    }
    let share = 1.0 / f32(grid * grid);
    let at = place.y * frame.size.x + place.x;
    var before = seen[at];
    if turn == 0u {
        before = ScopePixel();
    }
    for (var i = 0u; i < 2u; i++) {
        before.transmitted[i] += sum.transmitted[i] * share;
        before.surface[i] += sum.surface[i] * share;
        before.strongest[i] += sum.strongest[i] * share;
    }
    before.absorbed += sum.absorbed * share;
    before.unresolved += sum.unresolved * share;
    before.hit += sum.hit * share;
    before.undecided += sum.undecided * share;
    seen[at] = before;
}
