// Intersection of rays with convex stones: their planes, n·x <= w, are tried one after the other. `clusters.wgsl` does the
// same for stones of many planes.
//
// Imports: leaving, flat, convex.

@group(0) @binding(1) var<uniform> planes: array<vec4f, MOST_PLANES>;

fn plane_of(facet: u32) -> vec4f {
    return planes[facet];
}

// Counts the loop turns of one search, in shaders that count turns.
fn count_planes() {
    if COUNTS_TURNS {
        let range = plane_range();
        turns += (frame.plane_sixteenths * (range.end - range.first)) / 16u;
    }
}

// Returns the facet by which a ray from a point outside enters the present body, and the distance to it; the distance is
// negative where the ray misses.
fn entry(origin: vec3f, direction: vec3f) -> Meeting {
    var into = 0.0;
    var out = FAR;
    var facet = 0u;
    count_planes();
    let range = plane_range();
    for (var k = range.first; k < range.end; k++) {
        let plane = planes[k];
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

// Returns the facet by which a ray leaves from a point inside, and the distance to it.
fn next_facet(point: vec3f, direction: vec3f) -> Meeting {
    let range = plane_range();
    let start = Leaving(0.0, 1.0, range.first);
    count_planes();
    let facet = nearer(start, range.first, range.end, point, direction).facet;
    return Meeting(facet, distance_to(planes[facet], point, direction));
}
