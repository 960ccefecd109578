// What light meets: a convex stone of many planes. Planes that look much the same way stand in bunches, and a bunch is
// opened only where its bound says that it may hold the facet sought.

@group(0) @binding(1) var<storage, read> planes: array<vec4f>;
@group(0) @binding(3) var<storage, read> bunches: array<Bunch>;

fn plane_of(facet: u32) -> vec4f {
    return planes[facet];
}

fn next_facet(point: vec3f, direction: vec3f) -> u32 {
    var best = vec2f(0.0, 1.0);
    var facet = 0u;
    let reach = length(point);
    for (var b = 0u; b < frame.counts.y; b++) {
        let bunch = bunches[b];
        let speed_at_most = dot(bunch.middle.xyz, direction) + bunch.spread.x;
        let gap_at_least =
            max(bunch.middle.w - dot(bunch.middle.xyz, point) - bunch.spread.y - bunch.spread.x * reach, LEAST_GAP);
        if speed_at_most * best.y <= best.x * gap_at_least {
            continue;
        }
        let first = u32(bunch.spread.z);
        for (var k = first; k < first + u32(bunch.spread.w); k++) {
            let plane = planes[k];
            let speed = dot(plane.xyz, direction);
            let gap = max(plane.w - dot(plane.xyz, point), LEAST_GAP);
            if speed * best.y > best.x * gap {
                best = vec2f(speed, gap);
                facet = k;
            }
        }
    }
    return facet;
}
