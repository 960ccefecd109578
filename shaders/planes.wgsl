// What light meets: a convex stone's planes, n·x <= w, found one after the other. `polytope.wgsl` is the same for many.

@group(0) @binding(1) var<uniform> planes: array<vec4f, MOST_PLANES>;

fn plane_of(facet: u32) -> vec4f {
    return planes[facet];
}

// The facet by which a ray leaves from a point inside: that of the greatest ratio of speed toward a plane to the gap
// before it, compared without dividing.
fn next_facet(point: vec3f, direction: vec3f) -> u32 {
    var best = vec2f(0.0, 1.0);
    var facet = 0u;
    for (var k = 0u; k < frame.counts.x; k++) {
        let plane = planes[k];
        let speed = dot(plane.xyz, direction);
        let gap = max(plane.w - dot(plane.xyz, point), LEAST_GAP);
        if speed * best.y > best.x * gap {
            best = vec2f(speed, gap);
            facet = k;
        }
    }
    return facet;
}
