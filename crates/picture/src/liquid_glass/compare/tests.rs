//! Tests of the traced pane, and of its differences from the drawn pane.

use super::*;
use crate::liquid_glass::LightFrom;
use crate::liquid_glass::tests::{apart, even, full, none, pattern};
use brillianteer_base::unwatched;
use brillianteer_optics::line;
use glam::DVec4;
use std::ops::ControlFlow;
use std::sync::Mutex;

/// Compares a pane with the traced one in this light.
fn traced(pane: &GlassPane, background: &Panorama, light: &Light, passes: u32) -> Comparison {
    let bands = Strata::new(4, 1, &Illuminant::D65, true);
    let around = PaneLighting { map: &EnvironmentMap::new(light, None), gap: 0.02, strata: &bands, passes };
    compare(pane, background, &around, &unwatched).unwrap()
}

#[test]
fn the_traced_pane_over_white_in_white_is_white_and_symmetric_over_what_is() {
    let white = even([1.0; 3]);
    let seen = traced(&full(), &white, &Light::white(), 2);
    assert!(apart(&seen.traced, &plain(&white)) < 2e-3);
    let background = pattern(true);
    let Comparison { traced, cost, .. } =
        traced(&GlassPane { light: 0.0, ..full() }, &background, &surroundings(&none()), 1);
    let off = traced.pixels.chunks(72).flat_map(|row| row.iter().zip(row.iter().rev()));
    let off = off.map(|(a, b)| (a[1] - b[1]).abs()).fold(0.0, f32::max);
    assert!(off < 1e-3, "{off}");
    assert!(cost.behind > 0.8 && cost.behind < 0.93, "{cost:?}");
}

#[test]
fn without_refraction_the_traced_pane_is_the_pane() {
    let background = pattern(false);
    for depth in [0.0, 100.0] {
        let bare = GlassPane { depth, ..none() };
        let seen = traced(&bare, &background, &surroundings(&none()), 2);
        // Depth alone makes the traced body a slab of air: air does not move what is seen, though the specification
        // does.
        assert!(seen.cost.traced.greatest < 1e-4 && seen.cost.blind == 0.0, "{:?}", seen.cost);
        let unmoved = approximated(&none(), &background, 2);
        assert!(apart(&seen.traced, &unmoved) < 1e-4);
        assert_eq!(seen.cost.apart.greatest > 0.1, depth > 0.0, "{:?}", seen.cost);
    }
}

#[test]
fn the_traced_pane_stands_where_the_drawn_one_does() {
    let costs = [DVec2::ZERO, DVec2::new(-4.0, 5.0)].map(|by| {
        let pane = GlassPane { corner: full().corner + by, ..full() };
        traced(&pane, &pattern(false), &surroundings(&none()), 1).cost
    });
    let [a, b] = costs.map(|cost| cost.traced);
    assert!((a.mean - b.mean).abs() < 1e-3 && (a.greatest - b.greatest).abs() < 1e-3, "{a:?} {b:?}");
    assert!(a.mean > 0.1 && costs[0].blind < 0.05, "{:?}", costs[0]);
}

#[test]
fn the_light_around_the_traced_pane_comes_from_where_that_of_the_drawn_one_does() {
    let light_from = LightFrom { azimuth: 200.0, height: 35.0 };
    let tint = DVec4::new(0.0, 0.0, 1.0, 0.5);
    let Light { dome, lamp, .. } = surroundings(&GlassPane { light_from, tint, light: 50.0, ..full() });
    assert_eq!((lamp[0].azimuth, lamp[0].elevation), (200.0, 35.0));
    // Half of red and green light is left: code 188.
    assert!(dome[0].colour == Some([188, 188, 255]) && lamp[0].colour == dome[0].colour);
    assert_eq!((surroundings(&full()).lamp[0].colour, dome[0].radiance), (None, 0.15));
}

#[test]
fn strengths_stand_for_the_glass_that_is_told() {
    let full = glass(100.0, 100.0).unwrap();
    assert!((full.index(line::HELIUM_D) - 1.5).abs() < 1e-4);
    assert!((full.dispersion.abbe_number().unwrap() - 55.0).abs() < 0.1);
    let half = glass(50.0, 50.0).unwrap();
    assert!((half.index(line::HELIUM_D) - 1.25).abs() < 1e-4);
    assert!((half.dispersion.abbe_number().unwrap() - 110.0).abs() < 0.2);
    assert_eq!(glass(40.0, 0.0).unwrap().index(400.0), 1.2);
}

#[test]
fn the_cost_tells_glass_from_its_approximation() {
    let Cost { mean_difference, psnr_db, traced: by_glass, apart, fringe, .. } =
        traced(&GlassPane { frost: 0.0, ..full() }, &pattern(false), &surroundings(&full()), 2).cost;
    assert!(mean_difference > 0.01 && (5.0..30.0).contains(&psnr_db), "{mean_difference} {psnr_db}");
    assert!(apart.greatest >= apart.mean && apart.greatest <= by_glass.greatest + 38.0 * 0.04);
    // Dispersion is 0.003 times 2.0 of 38 pixels, times two thirds for the mean over the pane.
    assert!((0.1..0.2).contains(&fringe[0]), "{fringe:?}");
    let nowhere = GlassPane { corner: DVec2::splat(500.0), ..full() };
    let bands = Strata::new(2, 1, &Illuminant::D65, true);
    let around = PaneLighting {
        map: &EnvironmentMap::new(&Light::white(), None),
        gap: 0.02,
        strata: &bands,
        passes: 1,
    };
    assert_eq!(compare(&nowhere, &pattern(false), &around, &unwatched), Err(PaneError::Nowhere));
}

#[test]
fn the_progress_of_a_comparison_runs_once_from_0_to_1() {
    let parts = Mutex::new(vec![]);
    let watch = |part: f64| {
        parts.lock().unwrap().push(part);
        ControlFlow::Continue(())
    };
    let bands = Strata::new(1, 1, &Illuminant::D65, true);
    let map = EnvironmentMap::new(&Light::white(), None);
    let around = PaneLighting { map: &map, gap: 0.02, strata: &bands, passes: 1 };
    compare(&full(), &pattern(false), &around, &watch).unwrap();
    let parts = parts.into_inner().unwrap();
    assert!(parts.is_sorted() && parts[0] == 0.0 && parts.iter().all(|part| *part <= 1.0), "{parts:?}");
    assert!(parts.iter().any(|part| *part > 0.5), "{parts:?}");
}
