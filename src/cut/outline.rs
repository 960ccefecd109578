//! What a stone measures, whatever its cut: length, width, where its girdle lies, its depths and its table.

use crate::math::{Facet, Polytope};
use glam::DVec3;
use serde::Serialize;

/// A facet whose normal leans less than this from the girdle plane (sine) is part of the girdle: what a cutter's file of
/// six digits leaves of upright.
const UPRIGHT: f64 = 1e-5;

/// A facet whose normal leans less than this from the axis (sine) is a table or a culet.
pub(super) const LEVEL: f64 = 1e-5;

/// Where among the corners of the girdle's facets, from below and from above, its edges are taken to lie: a few corners
/// reach far in a wavy girdle and say little of it. Depths published for GemCad's designs are taken at a tenth too, yet
/// of the corners of triangles into which facets fall by chance; so one design in a hundred, whose tenth corner lies where
/// its girdle steps, comes out otherwise.
const EDGE: f64 = 0.1;

/// Corners of a facet nearer to one another than this, widths of the stone, are one: where more than three facets meet,
/// the last digit of a cutter's file splits their corner.
const SAME_CORNER: f64 = 1e-7;

/// What a stone measures. Lengths in the unit of the stone, from the side and from above as it lies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Outline {
    /// The larger of its extents along x and y.
    pub length: f64,
    /// The smaller.
    pub width: f64,
    /// z of the girdle's lower edge.
    pub girdle_bottom: f64,
    /// z of its upper edge.
    pub girdle_top: f64,
    /// z of the lowest point.
    pub bottom: f64,
    /// z of the highest point.
    pub top: f64,
    /// Extents of the table along x and y; 0 without one.
    pub table: [f64; 2],
}

impl Outline {
    /// Measures a stone.
    pub fn of(stone: &Polytope) -> Self {
        let (low, high) = stone.bounds();
        let across = high - low;
        let width = across.x.min(across.y);
        let (girdle_bottom, girdle_top) = girdle(stone, SAME_CORNER * width);
        Self {
            length: across.x.max(across.y),
            width,
            girdle_bottom,
            girdle_top,
            bottom: low.z,
            top: high.z,
            table: table(stone),
        }
    }

    /// Depth from the girdle to the lowest point.
    pub fn pavilion_depth(&self) -> f64 {
        self.girdle_bottom - self.bottom
    }

    /// Height from the girdle to the highest point.
    pub fn crown_height(&self) -> f64 {
        self.top - self.girdle_top
    }
}

/// Whether a facet stands upright: part of the girdle.
pub fn is_girdle(facet: &Facet) -> bool {
    facet.plane.normal.z.abs() < UPRIGHT
}

/// Whether a facet lies flat on top: the table.
pub fn is_table(facet: &Facet) -> bool {
    facet.plane.normal.z > 0.0 && facet.plane.normal.truncate().length() < LEVEL
}

fn table(stone: &Polytope) -> [f64; 2] {
    let Some(facet) = stone.facets().iter().find(|facet| is_table(facet)) else { return [0.0; 2] };
    let corners = || stone.corners(facet);
    let low = corners().fold(DVec3::INFINITY, DVec3::min);
    let high = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
    [high.x - low.x, high.y - low.y]
}

/// z of the girdle's edges, the lower first. Corners nearer than this are one.
fn girdle(stone: &Polytope, nearest: f64) -> (f64, f64) {
    let upright = stone.facets().iter().filter(|facet| is_girdle(facet));
    let mut levels: Vec<f64> = upright.flat_map(|facet| corner_levels(stone, facet, nearest)).collect();
    if levels.is_empty() {
        levels = knife_edge(stone);
    }
    levels.sort_by(f64::total_cmp);
    let aside = (EDGE * levels.len() as f64).ceil() as usize;
    match levels.len().checked_sub(aside + 1) {
        Some(last) => (levels[aside.min(last)], levels[last.max(aside)]),
        // Nothing faces both up and down in a solid without an edge between them, which no closed solid is.
        None => (0.0, 0.0),
    }
}

/// z of a facet's corners; corners nearer than this are one.
fn corner_levels(stone: &Polytope, facet: &Facet, nearest: f64) -> Vec<f64> {
    let corners: Vec<DVec3> = stone.corners(facet).collect();
    let next = corners.iter().cycle().skip(1);
    let apart = corners.iter().zip(next).filter(|(corner, next)| corner.distance(**next) >= nearest);
    apart.map(|(corner, _)| corner.z).collect()
}

/// z of the corners where crown and pavilion meet.
fn knife_edge(stone: &Polytope) -> Vec<f64> {
    let faces_up = |facet: &Facet| facet.plane.normal.z > 0.0;
    let mut levels = vec![];
    for facet in stone.facets().iter().filter(|facet| faces_up(facet)) {
        let corners: Vec<DVec3> = stone.corners(facet).collect();
        for (k, &other) in facet.neighbours.iter().enumerate() {
            if !faces_up(&stone.facets()[other as usize]) {
                levels.extend([corners[k].z, corners[(k + 1) % corners.len()].z]);
            }
        }
    }
    levels
}

#[cfg(test)]
mod tests {
    use super::super::round_brilliant::{MODERN, RoundBrilliant};
    use super::*;
    use crate::math::Plane;

    fn stone(given: RoundBrilliant) -> Polytope {
        let planes: Vec<Plane> = given.facets().unwrap().into_iter().map(|(_, plane)| plane).collect();
        Polytope::from_planes(&planes).unwrap()
    }

    #[test]
    fn a_brilliant_measures_what_it_was_made_to() {
        for girdle_facets in [16, 64, 96] {
            let measured = Outline::of(&stone(RoundBrilliant { girdle_facets, ..MODERN }));
            let derived = MODERN.derived().unwrap();
            assert!((measured.table[0] / 2.0 - MODERN.table / 100.0).abs() < 1e-12, "{measured:?}");
            assert!(
                (measured.crown_height() / 2.0 - derived.crown_height / 100.0).abs() < 0.01,
                "{measured:?} {derived:?}"
            );
            assert!((measured.pavilion_depth() / 2.0 - derived.pavilion_depth / 100.0).abs() < 0.01);
            assert!((measured.length - 2.0).abs() < 5e-3 && (measured.width - 2.0).abs() < 5e-3);
            let depth = measured.top - measured.bottom;
            assert!((depth / 2.0 - derived.total_depth / 100.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_corner_that_rounding_splits_counts_once() {
        let box_of = |last: f64| {
            let normals = [
                DVec3::X,
                DVec3::NEG_X,
                DVec3::Y,
                DVec3::NEG_Y,
                DVec3::Z,
                DVec3::NEG_Z,
                DVec3::new(1.0, 0.0, 1.0),
            ];
            let planes =
                normals.map(|normal| Plane::new(normal, if normal.length() > 1.0 { last } else { 1.0 }));
            Polytope::from_planes(&planes.map(|plane| plane.normalized().unwrap())).unwrap()
        };
        let corners = |stone: &Polytope, nearest: f64| {
            let side = stone.facets().iter().find(|facet| facet.plane.normal == DVec3::Y).unwrap();
            corner_levels(stone, side, nearest).len()
        };
        assert_eq!(corners(&box_of(1.5), 1e-7), 5);
        let split = box_of(2.0 - 1e-8);
        assert_eq!((corners(&split, 0.0), corners(&split, 1e-7)), (5, 4));
    }

    #[test]
    fn a_stone_without_a_girdle_is_measured_from_its_knife_edge() {
        let normals = [[1.0, 0.0], [-1.0, 0.0], [0.0, 2.0], [0.0, -2.0]];
        let planes =
            normals.iter().flat_map(|[x, y]| [1.0, -0.5].map(|z| Plane::new(DVec3::new(*x, *y, z), 1.0)));
        let unit: Vec<Plane> = planes.filter_map(|plane| plane.normalized()).collect();
        let measured = Outline::of(&Polytope::from_planes(&unit).unwrap());
        assert!((measured.length - 2.0).abs() < 1e-12 && (measured.width - 1.0).abs() < 1e-12);
        assert!(
            (measured.crown_height() - 1.0).abs() < 1e-12 && (measured.pavilion_depth() - 2.0).abs() < 1e-12
        );
        assert_eq!(measured.table, [0.0; 2]);
    }
}
