//! Facets that keep a scan from a symmetry that all its others have: noise divides a facet, or hides the edge between two.

use super::even::{Match, mirrored};
use brillianteer_math::{Plane, Pose};
use glam::DQuat;
use std::f64::consts::TAU;

/// The most facets that keep a stone from its symmetry, as a part of all, and besides.
const FEW: f64 = 0.02;
const FEW_ALWAYS: usize = 2;

/// The most turns that are tried.
const MOST_TURNS: u32 = 12;

/// Returns the number of facets by which a stone with +z along its axis lacks a symmetry; `None` where it lacks none, or more than a
/// few.
pub(super) fn lacking(planes: &[Plane]) -> Option<usize> {
    let list = Match::loose(planes);
    let lacking = |map: &dyn Fn(&Plane) -> Plane| {
        let mut images: Vec<usize> = planes.iter().filter_map(|plane| list.find(&map(plane))).collect();
        images.sort_unstable();
        images.dedup();
        planes.len() - images.len()
    };
    let turned = (2..=MOST_TURNS).map(|turns| {
        let turn = Pose::turned(DQuat::from_rotation_z(TAU / f64::from(turns)));
        lacking(&|plane: &Plane| plane.placed(&turn))
    });
    let azimuth = |plane: &Plane| plane.normal.y.atan2(plane.normal.x);
    let leans = |plane: &&Plane| plane.normal.z.abs() < 0.99;
    let first = planes.iter().find(leans)?;
    let beside = planes.iter().filter(leans).filter(|plane| (plane.normal.z - first.normal.z).abs() < 0.05);
    let mirrors = beside.map(|plane| {
        let mirror = (azimuth(first) + azimuth(plane)) / 2.0;
        lacking(&|plane: &Plane| mirrored(plane, mirror))
    });
    // A mirror between a facet and a strip of it carries the one to the other, and lacks nothing.
    let least = turned.chain(mirrors).filter(|lacks| *lacks > 0).min()?;
    (least <= FEW_ALWAYS + (FEW * planes.len() as f64) as usize).then_some(least)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_facet_without_images_is_what_a_stone_lacks_and_an_even_or_a_quite_uneven_stone_lacks_none() {
        let side = |turn: f64, slope: f64| Plane::from_slope(slope, turn, 1.0);
        let mut planes: Vec<Plane> =
            (0..8).flat_map(|k| [0.6, 2.4].map(|slope| side(TAU / 8.0 * f64::from(k), slope))).collect();
        assert_eq!(lacking(&planes), None);
        // Off every mirror of the others.
        planes.push(side(0.2, 0.61));
        assert_eq!(lacking(&planes), Some(1));
        planes.pop();
        planes.push(side(0.01, 0.61));
        assert_eq!(lacking(&planes), Some(1), "a strip of a facet");
        let uneven: Vec<Plane> =
            (0..16).map(|k| side(f64::from(k * k) * 0.37, 0.3 + 0.15 * f64::from(k))).collect();
        assert_eq!(lacking(&uneven), None);
    }
}
