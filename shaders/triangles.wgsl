// Intersection of rays with solids of triangles, by bvh.wgsl. This is the twin of crates/trace/src/ray/facets.rs.
//
// Imports: bvh, flat, branching.

// The farthest that rounding may put a ray's start beyond the triangle that the ray is about to meet, as a part of
// the solid's reach from its origin; it is some ten roundings.
const BEHIND: f32 = 1e-6;

fn plane_of(facet: u32) -> vec4f {
    let t = triangles[facet];
    let normal = triangle_normal(t);
    return vec4f(normal, dot(normal, t.a));
}

fn entry(origin: vec3f, direction: vec3f) -> Meeting {
    return of_solid(origin, direction, -1.0);
}

fn next_facet(point: vec3f, direction: vec3f) -> Meeting {
    return of_solid(point, direction, 1.0);
}

// Returns the first triangle of the present body that a ray runs into (side -1) or out of (side 1).
fn of_solid(origin: vec3f, direction: vec3f, side: f32) -> Meeting {
    return nearest_triangle(origin, direction, side, NONE, -BEHIND * mesh_range().reach);
}
