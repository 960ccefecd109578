// Flat facets: what trace.wgsl needs to trace them, in the world's frame.

const IS_CURVED: bool = false;

fn facet_normal(facet: u32, point: vec3f) -> vec3f {
    return plane_of(facet).xyz;
}

fn turned_normal(point: vec3f, by: vec3f) -> vec3f {
    return vec3f(0.0);
}

fn unit() -> f32 {
    return 1.0;
}

fn outward(ray: Ray) -> Ray {
    return ray;
}

// Returns unpolarised light of this weight that meets the body at `met`.
fn arriving(ray: Ray, met: Meeting, weight: f32) -> Inbound {
    return inbound_of(ray, vec3f(0.0), met, weight);
}

fn again(origin: vec3f, direction: vec3f) -> Meeting {
    return entry(origin, direction);
}
