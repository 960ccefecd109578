//! Prongs, beads and struts: round rods along a way, with a seat cut where a stone lies.

use super::gem::MountedStone;
use super::path::around;
use super::skin::skin;
use brillianteer_math::ShadedSurface;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// A cross-section of a rod: its place, its directions and its thickness.
#[derive(Debug, Clone, Copy)]
pub(super) struct Station {
    /// The place, in mm.
    pub at: DVec3,
    /// The unit direction of the rod.
    pub along: DVec3,
    /// The unit direction away from the stone, square to `along`.
    pub out: DVec3,
    /// The radius, in mm.
    pub radius: f64,
    /// The greatest reach of the section toward the stone, in mm: where the rod bends, its inner side must not fold.
    pub inward: f64,
}

/// The angles from `out` between which the free side of a rod may end, radians.
const FREE: [f64; 2] = [1.05, 2.6];

/// The number of halvings in the search for the end of the free side.
const HALVINGS: usize = 40;

/// Makes a rod with a flat foot and a round tip, from which the seats of stones are cut.
///
/// Every place of the rod's middle must lie outside all stones.
pub(super) fn rod(stations: &[Station], stones: &[MountedStone]) -> ShadedSurface {
    let mut stations = stations.to_vec();
    let Some(&last) = stations.last() else { return ShadedSurface::default() };
    let steps = around(last.radius) / 4;
    for k in 1..=steps {
        let (sin, cos) = (FRAC_PI_2 * k as f64 / steps as f64).sin_cos();
        // The tip itself is one point.
        let radius = if k == steps { 0.0 } else { last.radius * cos };
        stations.push(Station { at: last.at + last.along * (last.radius * sin), radius, ..last });
    }
    let widest = stations.iter().map(|station| station.radius).fold(0.0, f64::max);
    let middle = stations[stations.len() / 2].at;
    let reach = stations.iter().map(|station| station.at.distance(middle)).fold(0.0, f64::max) + widest;
    let near: Vec<&MountedStone> = stones.iter().filter(|stone| stone.is_near(middle, reach)).collect();
    // An even number on the seat, so that one point lies straight toward the stone, where its corner may be.
    let counts = [around(widest), around(widest) / 4 * 2 + 2];
    let rows: Vec<Vec<DVec3>> = stations.iter().map(|station| section(station, &near, counts)).collect();
    skin(&rows, false)
}

/// Returns the outline of a rod's section: first its free side, from one end to the other, then the side toward the stones.
fn section(station: &Station, stones: &[&MountedStone], [free, seated]: [usize; 2]) -> Vec<DVec3> {
    let side = station.along.cross(station.out);
    let way = |angle: f64| station.out * angle.cos() + side * angle.sin();
    let reach = |angle: f64| {
        let fold = if angle.cos() < 0.0 { station.inward / -angle.cos() } else { f64::INFINITY };
        let free = stones.iter().map(|stone| stone.free_way(station.at, way(angle)));
        free.fold(station.radius.min(fold), f64::min)
    };
    let is_cut = |angle: f64| reach(angle) < station.radius * (1.0 - 1e-9);
    let end = |sign: f64| {
        let [mut low, mut high] = FREE;
        if is_cut(sign * low) || !is_cut(sign * high) {
            return if is_cut(sign * low) { low } else { high };
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if is_cut(sign * middle) { high = middle } else { low = middle }
        }
        low
    };
    let (left, right) = (end(1.0), end(-1.0));
    let on_free = (0..free).map(|k| -right + (left + right) * k as f64 / free as f64);
    let toward = 2.0 * PI - left - right;
    let on_seat = (0..seated).map(|k| left + toward * k as f64 / seated as f64);
    on_free.chain(on_seat).map(|angle| station.at + way(angle) * reach(angle)).collect()
}
