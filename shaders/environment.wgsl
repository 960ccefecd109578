// The environment around the stones, the twin of crates/trace/src/environment.rs. Light is radiance in four
// channels: of the key illuminant's spectrum, and of red, green and blue.
//
// Imports: Environment, Lamp, ray, angles.

@group(0) @binding(6) var<uniform> environment: Environment;
@group(0) @binding(7) var<uniform> lamps: array<Lamp, MOST_LAMPS>;
@group(0) @binding(8) var sky: texture_2d<f32>;
@group(0) @binding(9) var photo: texture_2d<f32>;

const STILL: f32 = 1e-14;
const ALONG: f32 = 1e-6;
// The least height above the backplate, which prevents divisions by 0.
const LEAST_HEIGHT: f32 = 1e-20;

// Returns the place of a direction in the octahedral map, 0 to 1.
fn octahedral(d: vec3f) -> vec2f {
    let flat = d.xy / (abs(d.x) + abs(d.y) + abs(d.z));
    let folded = (1.0 - abs(flat.yx)) * select(vec2f(-1.0), vec2f(1.0), flat >= vec2f(0.0));
    return 0.5 + 0.5 * select(folded, flat, d.z >= 0.0);
}

// Returns a texel of the map. Beyond the map's edge, it is the texel that lies next to that edge on the sphere.
fn sky_texel(at: vec2i, level: i32, size: i32) -> vec4f {
    var p = at;
    if p.x < 0 || p.x >= size {
        p = vec2i(select(-1 - p.x, 2 * size - 1 - p.x, p.x >= size), size - 1 - p.y);
    }
    if p.y < 0 || p.y >= size {
        p = vec2i(size - 1 - p.x, select(-1 - p.y, 2 * size - 1 - p.y, p.y >= size));
    }
    return textureLoad(sky, p, level);
}

// Interpolates one level of the map.
fn sky_level(at: vec2f, level: i32) -> vec4f {
    let size = i32(environment.map_side) >> u32(level);
    let p = at * f32(size) - 0.5;
    let base = vec2i(floor(p));
    let part = p - floor(p);
    let low = mix(sky_texel(base, level, size), sky_texel(base + vec2i(1, 0), level, size), part.x);
    let high = mix(sky_texel(base + vec2i(0, 1), level, size), sky_texel(base + vec2i(1, 1), level, size), part.x);
    return mix(low, high, part.y);
}

// Returns the map's light from a direction, averaged over an angle in radians.
fn sky_at(direction: vec3f, angle: f32) -> vec4f {
    let texels = angle * environment.map_side / TEXEL_ANGLE;
    let level = clamp(log2(max(texels, 1.0)), 0.0, environment.last_level);
    let at = octahedral(direction);
    let fine = i32(floor(level));
    let whole = sky_level(at, fine);
    if level - f32(fine) <= 0.0 {
        return whole;
    }
    return mix(whole, sky_level(at, fine + 1), level - f32(fine));
}

// Returns the share of a fan of directions that lies inside a lamp's disc. The fan reaches from half its length
// before the ray's direction to half after it.
fn share_inside(from_middle: vec3f, fan: vec3f, chord_squared: f32) -> f32 {
    let a = dot(fan, fan);
    if a < STILL {
        return select(0.0, 1.0, dot(from_middle, from_middle) < chord_squared);
    }
    // The share is computed from the nearest point, because b² - ac has no digits in f32 where curved surfaces make
    // fans of many radians.
    let nearest = -dot(from_middle, fan) / a;
    let apart = from_middle + fan * nearest;
    let inside = chord_squared - dot(apart, apart);
    if inside <= 0.0 {
        return 0.0;
    }
    let half = sqrt(inside / a);
    return max(min(nearest + half, 0.5) - max(nearest - half, -0.5), 0.0);
}

// Returns the area that a chord cuts off a circle of this radius. `half` is half the chord, and `along` the distance
// of the chord from the circle's middle, negative where most of the disc is cut off.
fn segment(radius: f32, along: f32, half: f32) -> f32 {
    let angle = atan2(half, along);
    // The difference below has no digits where the angle is small.
    let narrow = angle * angle * angle * (2.0 / 3.0) * (1.0 - 0.2 * angle * angle);
    return radius * radius * select(angle - sin(angle) * cos(angle), narrow, angle < 0.1);
}

// Returns the share of a disc of directions that lies inside a lamp's disc. The disc has the area of a square with
// this side.
fn share_of_disc(from_middle: vec3f, side: f32, chord_squared: f32) -> f32 {
    let own = side * sqrt(FRAC_1_PI);
    let lamp = sqrt(chord_squared);
    let apart = length(from_middle);
    if apart >= own + lamp {
        return 0.0;
    }
    let small = min(own, lamp);
    let large = max(own, lamp);
    var overlap = small * small / FRAC_1_PI;
    if apart > large - small {
        // This is half the line through both crossings, by Heron's formula.
        let heron = (apart + own + lamp) * (own + lamp - apart) * (apart + large - small) * (apart - large + small);
        let half = 0.5 * sqrt(max(heron, 0.0)) / apart;
        let beyond = (apart * apart + (large - small) * (large + small)) / (2.0 * apart);
        overlap = segment(large, beyond, half) + segment(small, apart - beyond, half);
    }
    return min(overlap / (side * side), 1.0);
}

// The most look-ups along a stretch of the backplate.
const MOST_TAPS: f32 = 8.0;

// Returns the number of pixels across and down of a level of the backplate. They are computed, because Mesa's
// software driver (22.3) returns 0 for all levels but the first.
fn photo_size(level: i32) -> vec2u {
    return max(textureDimensions(photo) >> vec2u(u32(level)), vec2u(1u));
}

// Interpolates one level of the backplate at a place in its pixels.
fn photo_level(at: vec2f, level: i32) -> vec3f {
    let base = floor(at);
    let part = at - base;
    let last = vec2i(photo_size(level)) - 1;
    let low = clamp(vec2i(base), vec2i(0), last);
    let high = clamp(vec2i(base) + 1, vec2i(0), last);
    let above = mix(textureLoad(photo, low, level), textureLoad(photo, vec2i(high.x, low.y), level), part.x);
    let below = mix(textureLoad(photo, vec2i(low.x, high.y), level), textureLoad(photo, high, level), part.x);
    return mix(above, below, part.y).xyz;
}

// Returns a ray whose fan alone covers, to first order, the same stretch of the backplate's plane as its fan and its
// shift together. `height` is the ray's height above the plane.
fn fanned_onto_plane(ray: Ray, height: f32) -> Ray {
    let along = ray.shift * -dot(ray.direction, frame.toward) + ray.direction * dot(ray.shift, frame.toward);
    return Ray(ray.origin, ray.direction, ray.fan + along / max(height, LEAST_HEIGHT), vec3f(0.0));
}

// Returns the speed at which a ray approaches the backplate's plane, at a part of its fan from its middle.
fn photo_speed(ray: Ray, part: f32) -> f32 {
    return -dot(ray.direction + ray.fan * part, frame.toward);
}

// Returns the place, in the backplate's pixels from the middle of the first, that a ray meets at a part of its fan.
// `height` is the ray's height above the plane.
fn photo_place(ray: Ray, height: f32, part: f32) -> vec2f {
    let p = ray.origin + (ray.direction + ray.fan * part) * (height / max(photo_speed(ray, part), ALONG));
    let size = vec2f(textureDimensions(photo));
    let on = vec2f(dot(p, frame.right), -dot(p, frame.up)) / environment.backplate_width + 0.5;
    // `on` is in units of the picture's width along both axes.
    return vec2f(on.x, (on.y - 0.5) * size.x / size.y + 0.5) * size - 0.5;
}

// Returns the part of a fan, 0 to 1, that corresponds to a part of its line across the picture.
fn photo_passed(along: f32, speeds: vec2f) -> f32 {
    let near = along * speeds.x;
    return near / (near + (1.0 - along) * speeds.y);
}

// Returns the light of the backplate along a ray; a is the part of the ray's fan that meets the backplate. It is the
// twin of `Backplate::at` and of `Mipmap::along`.
fn photo_at(arriving: Ray) -> vec4f {
    let height = dot(arriving.origin, frame.toward) + environment.backplate_distance;
    let ray = fanned_onto_plane(arriving, height);
    let low = photo_speed(ray, -0.5);
    let high = photo_speed(ray, 0.5);
    if max(low, high) <= ALONG || height <= 0.0 || environment.backplate_width <= 0.0 {
        return vec4f(0.0);
    }
    let first = -0.5 + select((ALONG - low) / (high - low), 0.0, low > ALONG);
    let last = 0.5 - select((ALONG - high) / (low - high), 0.0, high > ALONG);
    let start = photo_place(ray, height, first);
    let way = photo_place(ray, height, last) - start;
    let end = vec2f(textureDimensions(photo)) - 0.5;
    var enters = 0.0;
    var leaves = 1.0;
    for (var axis = 0; axis < 2; axis++) {
        if way[axis] == 0.0 {
            if start[axis] < -0.5 || start[axis] > end[axis] {
                return vec4f(0.0);
            }
        } else {
            let a = (-0.5 - start[axis]) / way[axis];
            let b = (end[axis] - start[axis]) / way[axis];
            enters = max(enters, min(a, b));
            leaves = min(leaves, max(a, b));
        }
    }
    if !(enters <= leaves) {
        return vec4f(0.0);
    }
    let speeds = vec2f(photo_speed(ray, first), photo_speed(ray, last));
    // The ends of the line are taken exactly, because rounding must not make a whole fan smaller.
    let begin = select(mix(first, last, photo_passed(enters, speeds)), first, enters <= 0.0);
    let finish = select(mix(first, last, photo_passed(leaves, speeds)), last, leaves >= 1.0);
    let length = length(way) * (leaves - enters);
    let level = clamp(ceil(log2(max(length, 1e-6) / MOST_TAPS)), 0.0, f32(textureNumLevels(photo)) - 1.0);
    let taps = clamp(ceil(length / exp2(level)), 1.0, MOST_TAPS);
    let scale = vec2f(photo_size(i32(level))) / vec2f(textureDimensions(photo));
    var sum = vec3f(0.0);
    for (var k = 0.0; k < taps; k += 1.0) {
        let at = photo_place(ray, height, mix(begin, finish, (k + 0.5) / taps));
        sum += photo_level((at + 0.5) * scale - 0.5, i32(level));
    }
    let share = select(finish - begin, 1.0, all(way == vec2f(0.0)));
    return vec4f(sum * (share / taps), share);
}

// Returns the light that arrives along a ray from outside the stones, averaged over its fan or over a square of
// directions with the side `spread`, whichever is wider. It is the twin of `Environment::radiance_around`.
fn radiance(ray: Ray, spread: f32) -> vec4f {
    let photographed = photo_at(ray);
    let seen = vec4f(0.0, photographed.xyz);
    if photographed.w >= 1.0 {
        return seen;
    }
    return seen + beyond(ray, spread) * (1.0 - photographed.w);
}

// Returns the light that arrives along a ray from the light alone, in the shadow of the observer's head.
fn beyond(ray: Ray, spread: f32) -> vec4f {
    let fanned = length(ray.fan);
    let d = vec3f(
        dot(environment.right, ray.direction),
        dot(environment.up, ray.direction),
        dot(environment.zenith, ray.direction),
    );
    let fan = vec3f(
        dot(environment.right, ray.fan),
        dot(environment.up, ray.fan),
        dot(environment.zenith, ray.fan),
    );
    var sum = sky_at(d, max(fanned, spread));
    for (var k = 0u; k < environment.lamp_count; k++) {
        let lamp = lamps[k];
        let away = d - lamp.toward;
        if spread > fanned {
            sum += lamp.radiance * share_of_disc(away, spread, lamp.chord_squared);
        } else {
            sum += lamp.radiance * share_inside(away, fan, lamp.chord_squared);
        }
    }
    // The observer's head, where there is one, hides the light behind it; the edge of its shadow is as wide as the
    // fan.
    if environment.cos_head > 1.0 {
        return sum;
    }
    let width = max(fanned, environment.head_edge);
    let clear = (environment.cos_head - dot(ray.direction, frame.toward)) / width + 0.5;
    return sum * clamp(clear, 0.0, 1.0);
}
