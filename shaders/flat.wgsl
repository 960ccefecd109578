// The surface functions that trace.wgsl needs, for flat facets. The file that imports this one has `plane_of` and
// `entry`.
//
// Imports: trace.

const IS_CURVED: bool = false;

fn facet_normal(facet: u32, point: vec3f) -> vec3f {
    return plane_of(facet).xyz;
}

fn turned_normal(point: vec3f, by: vec3f) -> vec3f {
    return vec3f(0.0);
}

fn polished(point: vec3f) -> vec3f {
    return point;
}

fn again(origin: vec3f, direction: vec3f) -> Meeting {
    return entry(origin, direction);
}
