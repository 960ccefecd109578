// Intersection of rays with triangles in boxes within boxes: the twin of crates/math/src/bvh.rs.
//
// Imports: Triangle, BvhNode, Body, trace.

@group(0) @binding(11) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(12) var<storage, read> nodes: array<BvhNode>;

// Boxes are enlarged by this part of the sum of the solid's reach and the distance of the ray's start from the
// origin; it is some thirty roundings.
const BOX_SLACK: f32 = 4e-6;
// The least absolute component of a direction that is divided by; smaller ones are replaced by it.
const STILLEST: f32 = 1e-20;

// The boxes that wait to be opened in the present search, and the distances to them. They are kept once for all searches,
// because compilers copy a search to each place that calls it.
var<private> pending: array<vec2f, MOST_LEVELS>;

// The place of the present body's triangles: its first box, the triangles' reach from the frame's origin, the number of
// triangles between a triangle and its smooth normals, and, for metal, the number of its finish.
struct MeshRange {
    root: u32,
    reach: f32,
    normals: u32,
    finish: u32,
}

fn mesh_range() -> MeshRange {
    return MeshRange(body.range.x, bitcast<f32>(body.range.y), body.range.z, body.range.w);
}

// Returns the normal of a triangle's facet.
fn triangle_normal(t: Triangle) -> vec3f {
    return vec3f(t.normal_x, t.normal_y, t.normal_z);
}

// Permutes a vector's axes so that the longest component of a direction becomes z. Where that component is negative,
// x and y are swapped too, so that nothing is mirrored.
fn turned_axes(v: vec3f, longest: u32, is_down: bool) -> vec3f {
    var p = v;
    if longest == 0u {
        p = v.yzx;
    } else if longest == 1u {
        p = v.zxy;
    }
    return select(p, p.yxz, is_down);
}

// Returns the distance at which a ray enters a box, 0 for a start inside; negative where the ray does not enter it
// before `far`. `per` is the reciprocal of the direction.
fn enters(node: BvhNode, origin: vec3f, per: vec3f, slack: f32, far: f32) -> f32 {
    let is_up = per >= vec3f(0.0);
    let near = (select(node.high + slack, node.low - slack, is_up) - origin) * per;
    let beyond = (select(node.low - slack, node.high + slack, is_up) - origin) * per;
    let into = max(max(near.x, near.y), max(near.z, 0.0));
    let out = min(min(beyond.x, beyond.y), min(beyond.z, far));
    return select(-1.0, into, into <= out);
}

// Returns the first triangle of the present body that a ray runs into (side -1), out of (side 1), or meets from
// either side (0). The distance is negative where there is none. The triangle `left`, and triangles that are not
// farther away than `after`, are ignored. The test is that of Woop, Benthin and Wald, as in `Sheared::meets`.
fn nearest_triangle(origin: vec3f, direction: vec3f, side: f32, left: u32, after: f32) -> Meeting {
    let size = abs(direction);
    var longest = select(0u, 1u, size.y >= size.x);
    if size.z >= size.x && size.z >= size.y {
        longest = 2u;
    }
    let straight = turned_axes(direction, longest, false);
    let is_down = straight.z < 0.0;
    let d = turned_axes(direction, longest, is_down);
    let shear = vec3f(d.x / d.z, d.y / d.z, 1.0 / d.z);
    let range = mesh_range();
    let slack = BOX_SLACK * (range.reach + length(origin));
    let clamped = select(select(vec3f(-STILLEST), vec3f(STILLEST), direction >= vec3f(0.0)), direction, size > vec3f(STILLEST));
    let per = 1.0 / clamped;
    var best = Meeting(NONE, FAR);
    var waiting = 0u;
    var at = range.root;
    var is_open = enters(nodes[at], origin, per, slack, FAR) >= 0.0;
    while is_open && !is_spent() {
        turns += 1u;
        let node = nodes[at];
        let count = node.count;
        var goes_on = false;
        if count > 0u {
            let first = node.start;
            for (var k = first; k < first + count; k++) {
                turns += 1u;
                let t = triangles[k];
                if k == left || (side != 0.0 && dot(triangle_normal(t), direction) * side <= 0.0) {
                    continue;
                }
                let a0 = turned_axes(t.a - origin, longest, is_down);
                let b0 = turned_axes(t.b - origin, longest, is_down);
                let c0 = turned_axes(t.c - origin, longest, is_down);
                let a = a0.xy - shear.xy * a0.z;
                let b = b0.xy - shear.xy * b0.z;
                let c = c0.xy - shear.xy * c0.z;
                let areas = vec3f(c.x * b.y - c.y * b.x, a.x * c.y - a.y * c.x, b.x * a.y - b.y * a.x);
                let sum = areas.x + areas.y + areas.z;
                if (any(areas < vec3f(0.0)) && any(areas > vec3f(0.0))) || sum == 0.0 {
                    continue;
                }
                let distance = dot(areas, vec3f(a0.z, b0.z, c0.z)) * shear.z / sum;
                if distance > after && distance < best.distance {
                    best = Meeting(k, distance);
                }
            }
        } else {
            let left = at + 1u;
            let right = at + node.start;
            let to_left = enters(nodes[left], origin, per, slack, best.distance);
            let to_right = enters(nodes[right], origin, per, slack, best.distance);
            goes_on = to_left >= 0.0 || to_right >= 0.0;
            let is_right_first = to_right >= 0.0 && (to_left < 0.0 || to_right < to_left);
            at = select(left, right, is_right_first);
            if to_left >= 0.0 && to_right >= 0.0 {
                pending[waiting] = select(vec2f(f32(right), to_right), vec2f(f32(left), to_left), is_right_first);
                waiting += 1u;
            }
        }
        if !goes_on {
            is_open = false;
            while waiting > 0u && !is_open {
                turns += 1u;
                waiting -= 1u;
                if pending[waiting].y <= best.distance {
                    at = u32(pending[waiting].x);
                    is_open = true;
                }
            }
        }
    }
    return Meeting(best.facet, select(-1.0, max(best.distance, 0.0), best.facet != NONE));
}
