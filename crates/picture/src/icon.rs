//! The program's icon: a stone from above, each facet shaded by its angle to a light.

use super::drawing::{DrawnAspect, between, hex, page};
use brillianteer_math::{Basis, Facet};
use brillianteer_scene::Stone;
use glam::{DVec2, DVec3};
use svg::Document;
use svg::node::element::{Group, Polygon};

/// Side of the drawing.
const SIDE: f64 = 256.0;
/// Radius of the stone in the drawing.
const RADIUS: f64 = 122.0;

/// Darkest and brightest shade of facets, in sRGB codes.
const SHADES: [[u8; 3]; 2] = [[14, 44, 92], [206, 232, 255]];
/// Colour of the lines between facets, in sRGB codes.
const LINE: [u8; 3] = [240, 248, 255];

/// Width of the lines.
const LINE_WIDTH: f64 = 3.0;

/// Direction toward the light; not a unit vector.
const LIGHT: DVec3 = DVec3::new(-0.8, 1.0, 0.9);

/// The change of a facet's shade, as a part of the range of shades, for a change of 1 in the cosine toward the light.
const CONTRAST: f64 = 1.6;

/// Draws the facets of a stone that are seen from above, without a background.
pub fn icon(stone: &Stone) -> Document {
    let reach = stone.polytope.vertices().iter().map(|v| v.truncate().length()).fold(0.0, f64::max);
    let place = DVec2::splat(SIDE / 2.0);
    let aspect = DrawnAspect { basis: Basis::FACE_UP, centre: DVec2::ZERO, scale: RADIUS / reach, place };
    let seen = stone.polytope.facets().iter().filter(|facet| aspect.shows(facet));
    let line = hex(LINE);
    let group =
        Group::new().set("stroke", line).set("stroke-width", LINE_WIDTH).set("stroke-linejoin", "round");
    let group = seen.fold(group, |group, facet| group.add(face(stone, facet, &aspect)));
    page(DVec2::splat(SIDE)).add(group)
}

fn face(stone: &Stone, facet: &Facet, aspect: &DrawnAspect) -> Polygon {
    let corners = aspect.outline(stone, facet);
    let points = corners.iter().map(|p| format!("{:.2},{:.2}", p.x, p.y)).collect::<Vec<_>>().join(" ");
    let lit = facet.plane.normal.dot(LIGHT) / LIGHT.length();
    // The table, square to the eye, gets the middle shade.
    let part = (0.5 + CONTRAST * (lit - LIGHT.z / LIGHT.length())).clamp(0.0, 1.0);
    Polygon::new().set("points", points).set("fill", between(SHADES, part))
}
