//! Draws the stone itself, seen from the side.

use super::ink::ProfileInks;
use super::sight::ProfileProjection;
use crate::polygons::{closed_line, fill};
use crate::theme::FOUND;
use brillianteer_math::{Basis, Facet, hull};
use brillianteer_picture::DrawnMarks;
use brillianteer_scene::Stone;
use egui::{Color32, Mesh, Painter, Pos2, Shape, Stroke};

/// A facet is edge on where the cosine between its normal and the direction to the eye is at most this, which is the
/// rounding of a unit normal.
const EDGE_ON: f64 = 1e-9;
/// Widths of lines, in points.
const OUTLINE: f32 = 1.8;
const EDGE: f32 = 0.9;
const GIRDLE: f32 = 0.5;
/// The widths of the outlines of marked facets, in front of and behind the stone, and the radius of the ring around a
/// marked corner, points.
const MARK: f32 = 2.0;
const MARK_BEHIND: f32 = 1.0;
const RING: f32 = 5.0;

/// The stone as it is seen from one side.
pub struct ProfileBody<'a> {
    stone: &'a Stone,
    basis: Basis,
    sight: &'a ProfileProjection,
}

impl<'a> ProfileBody<'a> {
    /// Makes the view of a stone; `basis` says how the stone lies in the profile's plane.
    pub fn new(stone: &'a Stone, basis: Basis, sight: &'a ProfileProjection) -> Self {
        Self { stone, basis, sight }
    }

    /// Returns the corners of the stone's outline on the screen, in order.
    pub fn outline(&self) -> Vec<Pos2> {
        let corners = self.stone.polytope.vertices().iter().map(|&v| self.basis.project(v));
        hull(corners.collect()).into_iter().map(|p| self.sight.at(p)).collect()
    }

    /// Paints the facets, the visible edges and the outline.
    pub fn paint(&self, painter: &Painter, inks: &ProfileInks, outline: &[Pos2]) {
        let corners: Vec<Pos2> =
            self.stone.polytope.vertices().iter().map(|&v| self.sight.at(self.basis.project(v))).collect();
        painter.add(self.faces(&corners, inks));
        painter.extend(self.edges(&corners, inks));
        painter.extend(closed_line(outline, Stroke::new(OUTLINE, inks.outline)));
    }

    /// Outlines marked facets, those that face away by a thinner line, and rings marked corners.
    pub fn mark(&self, painter: &Painter, marks: &DrawnMarks) {
        let place = |corner| self.sight.at(self.basis.project(corner));
        for facet in marks.facets.iter().filter_map(|place| self.stone.polytope.facets().get(*place)) {
            let corners: Vec<Pos2> = self.stone.polytope.corners(facet).map(place).collect();
            let width = if self.shows(facet) { MARK } else { MARK_BEHIND };
            painter.extend(closed_line(&corners, Stroke::new(width, FOUND)));
        }
        for &corner in &marks.corners {
            painter.circle_stroke(place(corner), RING, Stroke::new(MARK, FOUND));
        }
    }

    /// Returns the facets as triangles. Lines cover their bare borders.
    fn faces(&self, corners: &[Pos2], inks: &ProfileInks) -> Mesh {
        let mut mesh = Mesh::default();
        for facet in self.stone.polytope.facets().iter().filter(|facet| self.shows(facet)) {
            fill(&mut mesh, facet.outline.iter().map(|&v| corners[v as usize]), self.shade(facet, inks));
        }
        mesh
    }

    /// Returns each visible edge once, without those of the outline.
    fn edges(&self, corners: &[Pos2], inks: &ProfileInks) -> Vec<Shape> {
        let facets = self.stone.polytope.facets();
        let mut edges = vec![];
        for (id, facet) in facets.iter().enumerate().filter(|(_, facet)| self.shows(facet)) {
            for (k, &other) in facet.neighbours.iter().enumerate().filter(|&(_, &other)| other > id as u32) {
                let beyond = &facets[other as usize];
                if self.shows(beyond) {
                    let end = facet.outline[(k + 1) % facet.outline.len()];
                    let ends = [facet.outline[k], end].map(|v| corners[v as usize]);
                    edges.push(Shape::line_segment(ends, stroke(facet, beyond, inks)));
                }
            }
        }
        edges
    }

    fn shows(&self, facet: &Facet) -> bool {
        facet.plane.normal.dot(self.basis.toward) > EDGE_ON
    }

    fn shade(&self, facet: &Facet, inks: &ProfileInks) -> Color32 {
        let facing = facet.plane.normal.dot(self.basis.toward).clamp(0.0, 1.0);
        inks.faces[1].lerp_to_gamma(inks.faces[0], facing as f32)
    }
}

fn stroke(facet: &Facet, beyond: &Facet, inks: &ProfileInks) -> Stroke {
    let upright = |facet: &Facet| facet.plane.normal.z.abs() < EDGE_ON;
    if upright(facet) && upright(beyond) {
        Stroke::new(GIRDLE, inks.girdle)
    } else {
        Stroke::new(EDGE, inks.edge)
    }
}
