// Intersection of rays with convex stones of many planes. Planes of similar normals and offsets form a cluster, and a
// cluster is searched only where its bound shows that it may hold the wanted facet.
//
// Imports: Cluster, leaving, flat, convex.

@group(0) @binding(1) var<storage, read> planes: array<vec4f>;
@group(0) @binding(3) var<storage, read> clusters: array<Cluster>;

fn plane_of(facet: u32) -> vec4f {
    return planes[facet];
}

// Returns an upper bound of n·point - w over the planes of a cluster: where it is 0 or less, the point is inside all of
// them.
fn height_at_most(cluster: Cluster, point: vec3f) -> f32 {
    return dot(cluster.normal, point) - cluster.offset + cluster.offset_spread + cluster.normal_spread * length(point);
}

// Returns the point where a ray enters the body, as `entry` in planes.wgsl does. A cluster is skipped where the point
// reached so far is certainly inside all its planes, because it can then neither move the entry farther nor show that
// the ray misses.
fn entry(origin: vec3f, direction: vec3f) -> Meeting {
    let range = plane_range();
    var into = 0.0;
    var facet = range.first;
    for (var b = range.first_cluster; b < range.end_cluster; b++) {
        let cluster = clusters[b];
        if height_at_most(cluster, origin + direction * into) <= 0.0 {
            continue;
        }
        let first = cluster.first;
        for (var k = first; k < first + cluster.count; k++) {
            let plane = planes[k];
            let speed = dot(plane.xyz, direction);
            let gap = plane.w - dot(plane.xyz, origin);
            if speed < 0.0 && gap < into * speed {
                into = gap / speed;
                facet = k;
            }
        }
    }
    let point = origin + direction * into;
    for (var b = range.first_cluster; b < range.end_cluster; b++) {
        let cluster = clusters[b];
        if height_at_most(cluster, point) <= 0.0 {
            continue;
        }
        let first = cluster.first;
        for (var k = first; k < first + cluster.count; k++) {
            let plane = planes[k];
            if dot(plane.xyz, direction) >= 0.0 && dot(plane.xyz, point) > plane.w {
                return Meeting(facet, -1.0);
            }
        }
    }
    return Meeting(facet, select(-1.0, into, into > 0.0));
}

// Returns the facet by which a ray leaves the body, as `next_facet` in planes.wgsl does. A cluster is skipped where
// none of its planes can be nearer than the nearest so far.
fn next_facet(point: vec3f, direction: vec3f) -> Meeting {
    let range = plane_range();
    var best = Leaving(0.0, 1.0, range.first);
    let reach = length(point);
    for (var b = range.first_cluster; b < range.end_cluster; b++) {
        let cluster = clusters[b];
        let speed_at_most = dot(cluster.normal, direction) + cluster.normal_spread;
        let gap_at_least =
            max(cluster.offset - dot(cluster.normal, point) - cluster.offset_spread - cluster.normal_spread * reach, LEAST_GAP);
        if speed_at_most * best.gap <= best.speed * gap_at_least {
            continue;
        }
        let first = cluster.first;
        best = nearer(best, first, first + cluster.count, point, direction);
    }
    return Meeting(best.facet, distance_to(planes[best.facet], point, direction));
}
