//! Tests that volumes, meshes and shadows agree.

use super::{ImplicitSurface, chance, forms};
use crate::TriangleMesh;
use crate::{SmoothSolid, SolidRef};
use glam::DVec3;
use std::f64::consts::PI;

/// Returns the box along the axes that holds a shape.
fn bounds(field: ImplicitSurface) -> (DVec3, DVec3) {
    SolidRef::from(&SmoothSolid::new(field)).bounds()
}

#[test]
fn meshes_are_closed_and_as_near_as_they_say() {
    for field in forms() {
        for fineness in [0, 1, 2, 5] {
            let (surface, deviation) = (field.surface(fineness), field.deviation(fineness));
            assert!(surface.vertices.iter().all(|&v| field.value(v).abs() < 1e-12), "{field:?}");
            assert_eq!(
                (surface.groups.len(), surface.names.len()),
                (surface.triangles.len(), field.facets().len())
            );
            for t in 0..surface.triangles.len() {
                let [a, b, c] = surface.corners(t);
                let worst = [(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, (a + b + c) / 3.0]
                    .map(|p| field.value(p).abs())
                    .into_iter()
                    .fold(0.0, f64::max);
                assert!(worst <= deviation + 1e-12, "{field:?} {fineness}: {worst} {deviation}");
            }
            let volume = surface.volume();
            let room = surface.area() * deviation + 1e-12;
            assert!(
                (volume - field.volume()).abs() <= room,
                "{field:?} {fineness}: {volume} {}",
                field.volume()
            );
            let (low, high) = bounds(field);
            let (least, most) = surface.bounds();
            assert!((low - least).max_element() < 1e-12 && (most - high).max_element() < 1e-12);
            assert!(surface.vertices.iter().all(|v| v.length() < field.reach() + 1e-12), "{field:?}");
            TriangleMesh::new(surface).unwrap_or_else(|e| panic!("{field:?} {fineness}: {e}"));
        }
        let fine = field.surface(if field.is_convex() { 60 } else { 6 });
        assert!((fine.volume() / field.volume() - 1.0).abs() < 3e-3, "{field:?}");
    }
}

#[test]
fn the_volume_is_the_share_of_points_within() {
    let mut chance = chance(9);
    for field in forms() {
        let (low, high) = bounds(field);
        let count = 200_000;
        let within = (0..count).filter(|_| {
            let part = chance.point() / 2.0 + 0.5;
            field.value(low + (high - low) * part) < 0.0
        });
        let share = within.count() as f64 / f64::from(count);
        let expected = field.volume() / (high - low).element_product();
        let sigma = (expected * (1.0 - expected).max(0.0) / f64::from(count)).sqrt();
        assert!((share - expected).abs() <= 4.5 * sigma + 1e-12, "{field:?} {share} {expected}");
    }
}

#[test]
fn the_mean_shadow_is_a_quarter_of_the_surface_and_each_is_that_of_the_mesh() {
    let mut chance = chance(10);
    for field in forms().into_iter().filter(|field| field.is_convex()) {
        let mesh = field.surface(40);
        for _ in 0..20 {
            let d = chance.direction();
            let seen: f64 = (0..mesh.triangles.len()).map(|t| mesh.area_vector(t).dot(d).max(0.0)).sum();
            let area = field.silhouette_area(d).unwrap();
            assert!((seen / area - 1.0).abs() < 1e-3, "{field:?} {d} {seen} {area}");
        }
        // The directions are spread evenly over the sphere (Fibonacci's lattice).
        let count = 4000;
        let golden = PI * (5.0_f64.sqrt() - 1.0);
        let direction = |i: i32| {
            let z = (2.0 * f64::from(i) + 1.0) / f64::from(count) - 1.0;
            glam::DVec2::from_angle(golden * f64::from(i)).extend(0.0) * (1.0 - z * z).sqrt() + DVec3::Z * z
        };
        let sum: f64 = (0..count).map(|i| field.silhouette_area(direction(i)).unwrap()).sum();
        let quarter = mesh.area() / 4.0;
        assert!((sum / f64::from(count) / quarter - 1.0).abs() < 1e-3, "{field:?}");
    }
}
