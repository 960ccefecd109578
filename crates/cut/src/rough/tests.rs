//! Tests of stones in rough.

use super::*;
use crate::round_brilliant::MODERN;
use brillianteer_math::TriangleMesh;
use brillianteer_optics::material;
use glam::DVec3;
use proptest::prelude::*;
use std::sync::Arc;

fn brilliant() -> Polytope {
    let planes: Vec<Plane> = MODERN.facets().unwrap().into_iter().map(|(_, plane)| plane).collect();
    Polytope::from_planes(&planes).unwrap()
}

/// Returns a block of this length, width and depth, turned about its axis, with sides that count as its girdle.
fn block(sides: [f64; 3], turn: f64) -> Polytope {
    let [x, y] = [0.0, FRAC_PI_2].map(|angle| DVec2::from_angle(angle + turn).extend(0.0));
    let axes = [(x, sides[0]), (y, sides[1]), (DVec3::Z, sides[2])];
    let planes =
        axes.into_iter().flat_map(|(axis, side)| [axis, -axis].map(|normal| Plane::new(normal, side / 2.0)));
    Polytope::from_planes(&planes.collect::<Vec<_>>()).unwrap()
}

fn fits(text: &str) -> Rough {
    text.parse().unwrap()
}

#[test]
fn a_block_fills_rough_of_its_own_shape_however_it_lies_in_its_frame() {
    for turn in [0.0, 0.3, 1.2, 2.5] {
        let found = Finished::from_rough(&block([4.0, 2.0, 1.0], turn), &fits("12x6x3"), None).unwrap();
        assert!((found.yield_of(216.0) - 1.0).abs() < 1e-9, "{turn}: {found:?}");
        let off = found.size_mm.iter().zip([12.0, 6.0, 3.0]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-9, "{found:?}");
    }
    // Lying across the rough it is turned by a quarter.
    let across = Finished::from_rough(&block([2.0, 4.0, 1.0], 0.0), &fits("12x6x3"), None).unwrap();
    assert!((across.turn_deg.abs() - 90.0).abs() < 1e-9 && (across.volume_mm3 - 216.0).abs() < 1e-6);
}

#[test]
fn a_long_stone_lies_askew_in_square_rough() {
    // A needle of 10 by 0.1: its plan fits a square of 1 best along the diagonal, 2 / (10 + 0.1) / √2.
    let found = Finished::from_rough(&block([10.0, 0.1, 0.1], 0.0), &fits("10x10x10"), None).unwrap();
    let along = 10.0 * 2f64.sqrt() / 10.1;
    assert!((found.volume_mm3.cbrt() / 0.1f64.cbrt() - along).abs() < 1e-9, "{found:?}");
    assert!((found.turn_deg.abs() - 45.0).abs() < 1e-9);
    // Its own size is that of the needle, and not of the square that it lies across.
    let [length, width, _] = found.own_size_mm;
    assert!((length / width - 100.0).abs() < 1e-9 && (found.size_mm[0] - 10.0).abs() < 1e-9, "{found:?}");
}

#[test]
fn the_depth_that_is_left_is_what_the_girdle_can_take() {
    let (stone, deep) = (brilliant(), fits("6.5x6.5x6"));
    let found = Finished::from_rough(&stone, &deep, None).unwrap();
    assert_eq!(found.limit, FitLimit::Footprint);
    assert!((found.diameter_mm - 6.5).abs() < 0.01 && found.turn_deg == 0.0, "{found:?}");
    assert!(found.depth_left_mm > 1.0);
    let girdle = found.girdle_mm.unwrap() + found.depth_left_mm;
    let thick = Finished::from_rough(&stone, &deep, Some(girdle)).unwrap();
    assert!((thick.size_mm[2] - 6.0).abs() < 1e-9 && thick.depth_left_mm < 1e-9, "{thick:?}");
    assert!((thick.diameter_mm - found.diameter_mm).abs() < 1e-9);
    // The girdle adds a slab of the outline's area.
    let slab = stone.silhouette_area(DVec3::Z) * (found.diameter_mm / 2.0).powi(2) * found.depth_left_mm;
    assert!((thick.volume_mm3 - found.volume_mm3 - slab).abs() < 1e-6, "{thick:?} {slab}");
    let shallow = Finished::from_rough(&stone, &fits("9x9x3"), None).unwrap();
    assert!(shallow.limit == FitLimit::Depth && shallow.depth_left_mm == 0.0 && shallow.turn_deg == 0.0);
}

#[test]
fn a_weight_gives_the_stone_that_weighs_it_with_any_girdle() {
    let (stone, diamond) = (brilliant(), material("diamond").unwrap());
    for girdle in [None, Some(0.1), Some(0.6)] {
        let found = Finished::of_size(&stone, Size::Carats(1.5), diamond, girdle).unwrap();
        assert!((diamond.carats(found.volume_mm3).unwrap() - 1.5).abs() < 1e-5, "{found:?}");
        assert!(girdle.is_none_or(|mm| (found.girdle_mm.unwrap() - mm).abs() < 1e-9));
    }
    let plain = Finished::of_size(&stone, Size::Carats(1.0), diamond, None).unwrap();
    let size = Size::Carats(1.0).diameter_mm(stone.volume(), diamond).unwrap();
    assert!((plain.diameter_mm - size).abs() < 1e-9 && plain.limit == FitLimit::Weight);
}

#[test]
fn a_diameter_gives_the_stone_that_has_it_with_any_girdle() {
    let (stone, diamond) = (brilliant(), material("diamond").unwrap());
    let of = |girdle| Finished::of_size(&stone, Size::Millimetres(6.5), diamond, girdle);
    for girdle in [None, Some(0.0), Some(0.4)] {
        let found = of(girdle).unwrap();
        assert!((found.diameter_mm - 6.5).abs() < 1e-9 && found.limit == FitLimit::Diameter, "{found:?}");
        assert!(girdle.is_none_or(|mm| (found.girdle_mm.unwrap() - mm).abs() < 1e-9));
        // The stone of this weight is the same one.
        let carats = diamond.carats(found.volume_mm3).unwrap();
        let by_weight = Finished::of_size(&stone, Size::Carats(carats), diamond, girdle).unwrap();
        assert!((by_weight.diameter_mm - 6.5).abs() < 1e-5, "{by_weight:?}");
    }
    for mm in [-0.1, f64::NAN, f64::INFINITY] {
        assert!(matches!(of(Some(mm)), Err(RoughError::Girdle { .. })), "{mm}");
    }
    let mesh = Arc::new(TriangleMesh::of_polytope(&stone));
    let refused = Finished::of_size(&mesh, Size::Millimetres(6.5), diamond, Some(0.1));
    assert_eq!(refused, Err(RoughError::GirdleOfMesh));
}

#[test]
fn a_mesh_has_the_yield_of_the_planes_around_it_and_keeps_its_girdle() {
    let rough = fits("9x7x6");
    for (stone, turn) in [(brilliant(), 0.0), (block([4.0, 2.0, 1.0], 0.3), -0.3)] {
        let mesh = Arc::new(TriangleMesh::of_polytope(&stone));
        let by_planes = Finished::from_rough(&stone, &rough, None).unwrap();
        let found = Finished::from_rough(&mesh, &rough, None).unwrap();
        let same = Finished { girdle_mm: None, volume_mm3: found.volume_mm3, ..by_planes };
        assert_eq!(found, same);
        assert!((found.volume_mm3 / by_planes.volume_mm3 - 1.0).abs() < 1e-12);
        assert!((found.turn_deg.to_radians() - turn).abs() < 1e-9, "{found:?}");
        let refused = Finished::from_rough(&mesh, &rough, Some(0.1));
        assert_eq!(refused, Err(RoughError::GirdleOfMesh));
    }
}

#[test]
fn a_stone_of_no_size_is_refused() {
    // All but a hundred-thousandth of a millimetre is girdle.
    let refused = Finished::from_rough(&brilliant(), &fits("9x9x7"), Some(6.999_99)).unwrap_err();
    assert!(matches!(refused, RoughError::Diameter { mm } if mm < 1e-3), "{refused}");
}

#[test]
fn what_is_no_rough_or_does_not_fit_says_so() {
    for (text, told) in [
        ("12x9", "'12x9' is no piece of rough; write length, width and depth in mm, as in 12x9x7"),
        ("axbxc", "'axbxc' is no piece of rough"),
        ("12x9x0", "a side of 0 mm must be from 0.1 to 1000 mm"),
        ("12x9xNaN", "a side of NaN mm"),
    ] {
        let error = text.parse::<Rough>().unwrap_err().to_string();
        assert!(error.starts_with(told), "{error}");
    }
    assert_eq!("12 x 9 × 7.5 mm".parse(), Ok(Rough { sides_mm: [12.0, 9.0, 7.5] }));
    let stone = brilliant();
    for mm in [-1.0, 3.0, f64::NAN] {
        let error = Finished::from_rough(&stone, &fits("9x9x3"), Some(mm)).unwrap_err();
        assert!(matches!(error, RoughError::Girdle { .. }), "{error}");
    }
    let of_weight =
        |carats, mm| Finished::of_size(&stone, Size::Carats(carats), material("diamond").unwrap(), Some(mm));
    assert!(matches!(of_weight(1.0, f64::INFINITY), Err(RoughError::GirdleOfWeight { .. })));
    assert!(matches!(of_weight(-1.0, 0.1), Err(RoughError::Size(SizeError::Weight { .. }))));
}

proptest! {
    #[test]
    fn no_turn_that_is_tried_fits_better_than_the_one_that_is_found(
        corners in prop::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64), 3..12),
        sides in (0.5..2.0_f64, 0.5..2.0_f64),
    ) {
        let plan = Plan(hull(corners.into_iter().map(|(x, y)| DVec2::new(x, y)).collect()));
        prop_assume!(plan.0.len() > 2);
        let sides = [sides.0, sides.1];
        let (best, turn) = plan.largest(sides);
        prop_assert!((plan.scale(sides, turn) - best).abs() < 1e-12 * best);
        for k in 0..720 {
            let tried = plan.scale(sides, f64::from(k) * PI / 720.0);
            prop_assert!(tried <= best * (1.0 + 1e-9), "{tried} at {k} is better than {best}");
        }
    }
}
