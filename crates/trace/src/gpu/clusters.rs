//! Groups planes into clusters, so that a shader need not try all planes of a large stone.

use super::gpu_types::{Cluster, three};
use brillianteer_math::Plane;

/// The most planes in a cluster.
const FULL: usize = 16;

/// Returns the order of the planes, cluster by cluster, and the clusters.
pub(super) fn clusters(planes: &[Plane]) -> (Vec<u32>, Vec<Cluster>) {
    let mut order: Vec<u32> = (0..planes.len() as u32).collect();
    let mut clusters = vec![];
    gather(planes, &mut order, 0, &mut clusters);
    (order, clusters)
}

/// Halves planes at the median of one number until a cluster is small. The number is the coordinate of the normal, or
/// the offset, that spreads most.
fn gather(planes: &[Plane], order: &mut [u32], first: usize, clusters: &mut Vec<Cluster>) {
    let place = |k: u32| {
        let Plane { normal, offset } = planes[k as usize];
        [normal.x, normal.y, normal.z, offset]
    };
    if order.len() <= FULL {
        clusters.push(cluster(planes, order, first));
        return;
    }
    let extent = |axis: usize| {
        let values = || order.iter().map(|&k| place(k)[axis]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    let axis = (0..4).max_by(|&a, &b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
    let middle = order.len() / 2;
    order.select_nth_unstable_by(middle, |&a, &b| place(a)[axis].total_cmp(&place(b)[axis]).then(a.cmp(&b)));
    let (low, high) = order.split_at_mut(middle);
    gather(planes, low, first, clusters);
    gather(planes, high, first + middle, clusters);
}

fn cluster(planes: &[Plane], order: &[u32], first: usize) -> Cluster {
    let own = || order.iter().map(|&k| planes[k as usize]);
    let count = order.len() as f64;
    let normal = own().map(|p| p.normal).sum::<glam::DVec3>() / count;
    let offset = own().map(|p| p.offset).sum::<f64>() / count;
    let spread = own().map(|p| p.normal.distance(normal)).fold(0.0, f64::max);
    let depth = own().map(|p| (p.offset - offset).abs()).fold(0.0, f64::max);
    // Bounds are widened slightly, because they must hold in f32 too.
    let wide = |x: f64| (x * (1.0 + 1e-6) + 1e-6) as f32;
    Cluster {
        normal: three(normal),
        offset: offset as f32,
        normal_spread: wide(spread),
        offset_spread: wide(depth),
        first: first as u32,
        count: order.len() as u32,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn every_plane_is_in_one_cluster_and_within_its_bounds() {
        let planes: Vec<Plane> = (0..777)
            .map(|i| {
                let (z, turn) = (1.0 - 2.0 * (f64::from(i) + 0.5) / 777.0, 2.4 * f64::from(i));
                Plane::from_slope(z.acos(), turn, 1.0 + 0.1 * turn.sin())
            })
            .collect();
        let (order, clusters) = clusters(&planes);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..777));
        let mut next = 0;
        for cluster in &clusters {
            assert_eq!(cluster.first as usize, next);
            next += cluster.count as usize;
            for &k in &order[cluster.first as usize..next] {
                let plane = planes[k as usize];
                let middle = DVec3::from(cluster.normal.map(f64::from));
                assert!(plane.normal.distance(middle) <= f64::from(cluster.normal_spread));
                let off = (plane.offset - f64::from(cluster.offset)).abs();
                assert!(off <= f64::from(cluster.offset_spread));
            }
        }
        assert!(next == 777 && clusters.len() < 120, "{} clusters", clusters.len());
    }
}
