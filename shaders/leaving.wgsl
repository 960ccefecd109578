// Finds the plane that a ray inside a convex body meets first. It is the plane with the greatest ratio of the speed
// toward it to the gap before it; ratios are compared without a division.
//
// Imports: Body, trace.

// The present body's planes, and its clusters: the first of each, and the one after the last.
struct PlaneRange {
    first: u32,
    end: u32,
    first_cluster: u32,
    end_cluster: u32,
}

fn plane_range() -> PlaneRange {
    return PlaneRange(body.range.x, body.range.y, body.range.z, body.range.w);
}

// The nearest plane so far, the ray's speed toward it, and the gap before it.
struct Leaving {
    speed: f32,
    gap: f32,
    facet: u32,
}

// Returns the nearest among the nearest plane so far and the planes from `first` to before `end`.
fn nearer(so_far: Leaving, first: u32, end: u32, point: vec3f, direction: vec3f) -> Leaving {
    var best = so_far;
    for (var k = first; k < end; k++) {
        let plane = planes[k];
        let speed = dot(plane.xyz, direction);
        let gap = max(plane.w - dot(plane.xyz, point), LEAST_GAP);
        if speed * best.gap > best.speed * gap {
            best = Leaving(speed, gap, k);
        }
    }
    return best;
}
