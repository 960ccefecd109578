//! The fingerprint of a stone's geometry: the same for the same stone, whatever file it comes from.

use brillianteer_math::{Facet, Polytope, TriangleMesh};
use brillianteer_scene::Body;
use glam::DVec3;
use sha2::{Digest, Sha256};
use std::fmt::Write;

/// Slopes and azimuths are rounded to this, degrees. A crown angle that differs by 0.01° makes another stone.
const ANGLE_STEP_DEG: f64 = 0.005;

/// Distances of planes from the stone's lowest height on the axis are rounded to this, girdle radii: more than the
/// loss of files with six digits.
const DISTANCE_STEP: f64 = 2e-4;

/// Frosting, which is from 0 to 1, is rounded to this.
const FROSTING_STEP: f64 = 0.01;

/// Corners of triangles are rounded to this, girdle radii.
const CORNER_STEP: f64 = 1e-5;

/// Returns the SHA-256 of a body's geometry in its canonical form, as 64 hexadecimal digits. Names, material and size are no
/// part of it. docs/formats.md, "Reports", describes the form.
pub fn fingerprint(body: &Body) -> String {
    let text = match body {
        Body::Stone(stone) => planes(&stone.polytope),
        Body::Mesh(mesh) => triangles(mesh),
        // Its dimensions are the given numbers, which no file rounds.
        Body::Glass(_) => serde_json::to_string(body).unwrap_or_default(),
    };
    let digest = Sha256::digest(text.as_bytes());
    digest.iter().fold(String::with_capacity(64), |mut hex, byte| {
        // Writing to a string cannot fail.
        let _ = write!(hex, "{byte:02x}");
        hex
    })
}

/// Returns the number of steps in a value.
fn steps(value: f64, step: f64) -> i64 {
    (value / step).round() as i64
}

fn planes(polytope: &Polytope) -> String {
    // Formats place the origin at different heights: by the girdle's edge, or by its valleys.
    let lowest = polytope.bounds().0.z;
    let mut lines: Vec<String> = polytope.facets().iter().map(|facet| plane(facet, lowest)).collect();
    lines.sort();
    format!("planes 1\n{}\n", lines.join("\n"))
}

fn plane(facet: &Facet, lowest: f64) -> String {
    let normal = facet.plane.normal;
    let full_turn = steps(360.0, ANGLE_STEP_DEG);
    // The arc tangent is exact to rounding for level facets as well, where the arc cosine is not.
    let slope = steps(normal.truncate().length().atan2(normal.z).to_degrees(), ANGLE_STEP_DEG);
    let azimuth = match slope {
        // Rounding alone decides the azimuth of a level facet.
        0 => 0,
        _ if slope == full_turn / 2 => 0,
        _ => steps(normal.truncate().to_angle().to_degrees(), ANGLE_STEP_DEG).rem_euclid(full_turn),
    };
    let distance = steps(facet.plane.offset - lowest * normal.z, DISTANCE_STEP);
    let frosting = steps(facet.frosting, FROSTING_STEP);
    format!("{slope} {azimuth} {distance} {frosting}")
}

fn triangles(mesh: &TriangleMesh) -> String {
    let surface = mesh.surface();
    let corner = |corner: u32| {
        let at: DVec3 = surface.vertices[corner as usize];
        at.to_array().map(|coordinate| steps(coordinate, CORNER_STEP))
    };
    let triangle = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(corner);
        // Of the three rotations of the corners that keep their sense, the least is taken.
        [[a, b, c], [b, c, a], [c, a, b]].into_iter().min().unwrap_or_default()
    };
    let mut triangles: Vec<[[i64; 3]; 3]> = surface.triangles.iter().map(triangle).collect();
    triangles.sort_unstable();
    let mut text = "triangles 1\n".to_owned();
    for triangle in triangles {
        let numbers: Vec<String> = triangle.iter().flatten().map(i64::to_string).collect();
        let _ = writeln!(text, "{}", numbers.join(" "));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_cut::{Crown, RoundBrilliant, TOLKOWSKY};
    use brillianteer_files::{asc, cut_file, library};
    use brillianteer_math::Plane;
    use brillianteer_scene::{Specimen, Stone};
    use std::sync::Arc;

    fn of(facets: &[(String, Plane)]) -> String {
        fingerprint(&Body::Stone(Stone::new(facets).unwrap()))
    }

    #[test]
    fn neither_the_order_of_the_planes_nor_their_names_change_it_and_a_hundredth_of_a_degree_does() {
        let facets = TOLKOWSKY.facets().unwrap();
        let known = of(&facets);
        assert_eq!(known.len(), 64);
        assert!(known.bytes().all(|digit| digit.is_ascii_hexdigit()));
        let turned = facets.iter().rev().map(|(name, plane)| (format!("{name} x"), *plane));
        assert_eq!(of(&turned.collect::<Vec<_>>()), known);
        let Crown::Angle(angle) = TOLKOWSKY.crown else { panic!("a crown angle is given") };
        for by in [-0.01, 0.01] {
            let other = RoundBrilliant { crown: Crown::Angle(angle + by), ..TOLKOWSKY };
            assert_ne!(of(&other.facets().unwrap()), known, "{by}");
        }
    }

    #[test]
    fn a_cut_has_the_same_one_when_it_is_read_back_from_a_cutters_file() {
        for name in ["tolkowsky", "modern-ideal"] {
            let design = cut_file::parse(library::cut(name).unwrap(), name).unwrap();
            let specimen = Specimen::new(design).unwrap();
            let written = asc::write(&specimen).bytes;
            let again = Specimen::new(asc::read(&written, name).unwrap().design).unwrap();
            assert_eq!(fingerprint(&again.body), fingerprint(&specimen.body), "{name}");
        }
    }

    #[test]
    fn the_order_of_triangles_and_of_their_corners_does_not_change_it_and_their_place_does() {
        let stone = Stone::new(&TOLKOWSKY.facets().unwrap()).unwrap();
        let surface = TriangleMesh::of_polytope(&stone.polytope).surface().clone();
        let of = |surface: brillianteer_math::Surface| {
            fingerprint(&Body::Mesh(Arc::new(TriangleMesh::new(surface).unwrap())))
        };
        let mut other = surface.clone();
        other.triangles.reverse();
        other.triangles.iter_mut().for_each(|[a, b, c]| (*a, *b, *c) = (*b, *c, *a));
        other.groups.reverse();
        let known = of(surface.clone());
        assert_eq!(of(other), known);
        let mut moved = surface;
        moved.vertices.iter_mut().for_each(|corner| corner.z += 1e-4);
        assert_ne!(of(moved), known);
        assert_ne!(fingerprint(&Body::Stone(stone)), known);
    }
}
