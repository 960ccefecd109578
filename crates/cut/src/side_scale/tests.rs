//! Laws of scaling: it is a stretch of one side about the girdle's edge, and its slopes are those of differences.

use super::*;
use crate::round_brilliant::MODERN;
use crate::{FAMILIES, Indexed, MaterialRef, Tier};

fn design(cut: Cut) -> Design {
    Design {
        name: "test".to_owned(),
        source: None,
        notes: None,
        material: MaterialRef::Index(1.76),
        diameter_mm: 6.5,
        cut,
    }
}

/// Returns the planes of a brilliant, whose girdle is wavy, and of some other cuts of the program, as lists.
fn lists_of_planes() -> Vec<Design> {
    let brilliant = Cut::Planes(design(Cut::RoundBrilliant(MODERN)).facets().unwrap());
    let others = FAMILIES.iter().filter_map(|family| design(family.first.clone()).facets().ok());
    let convex = others.filter(|facets| solid_of(facets).is_some()).take(6).map(Cut::Planes);
    std::iter::once(brilliant).chain(convex).map(design).collect()
}

/// Returns a cutter's design whose origin lies above the middle of its girdle: a square of four pavilion mains under four
/// breaks, a crown, girdle and table.
pub(crate) fn square_of_tiers() -> Tiers {
    let tier = |angle: f64, distance: f64, first: f64, name: &str| {
        let facets = (0..4).map(|k| Indexed { index: first + 24.0 * f64::from(k), name: name.to_owned() });
        Tier {
            angle,
            distance,
            instructions: String::new(),
            meet: None,
            is_cut: true,
            frosting: 0.0,
            facets: facets.collect(),
        }
    };
    let table =
        Tier { facets: vec![Indexed { index: 0.0, name: "T".to_owned() }], ..tier(0.0, 0.4, 0.0, "T") };
    let all = vec![
        tier(-42.0, 0.70, 0.0, "P1"),
        tier(-55.0, 0.84, 0.0, "P2"),
        tier(-90.0, 1.0, 0.0, "G"),
        tier(-90.0, 1.2, 12.0, "G2"),
        tier(-44.0, 0.80, 12.0, "P3"),
        tier(35.0, 0.75, 0.0, "C"),
        table,
    ];
    Tiers { gear: 96, symmetry: 4, mirror: true, tiers: all, ..Tiers::default() }
}

fn tiers() -> Design {
    design(Cut::Tiers(square_of_tiers()))
}

fn solid_of(facets: &[(String, Plane)]) -> Option<Polytope> {
    Polytope::from_planes(&facets.iter().map(|(_, plane)| *plane).collect::<Vec<_>>()).ok()
}

fn stone(design: &Design) -> Polytope {
    solid_of(&design.facets().unwrap()).unwrap()
}

fn after(design: &Design, side: ScaledSide, factor: f64) -> Design {
    Design { cut: scaled(design, side, factor).unwrap(), ..design.clone() }
}

#[test]
fn a_scaled_side_is_a_stretch_about_the_girdle_and_the_girdle_keeps_its_thickness() {
    let designs: Vec<Design> = lists_of_planes().into_iter().chain([tiers()]).collect();
    assert!(designs.len() > 5);
    for (number, design) in designs.iter().enumerate() {
        let before = stone(design);
        let outline = Outline::of(&before);
        for side in ScaledSide::ALL {
            for factor in [0.9, 1.13] {
                let stretched = stone(&after(design, side, factor));
                assert_eq!(before.facets().len(), stretched.facets().len());
                for (a, b) in before.facets().iter().zip(stretched.facets()) {
                    assert_eq!(a.outline.len(), b.outline.len(), "{number}: a facet has other corners");
                    let level = side.level(&outline);
                    for corner in before.corners(a) {
                        // A corner of an upright facet belongs to the side whose facets meet there.
                        let moved = corner.truncate().extend(level + factor * (corner.z - level));
                        let off = |from: DVec3| {
                            stretched.corners(b).map(|to| to.distance(from)).fold(f64::INFINITY, f64::min)
                        };
                        let off =
                            if side.has(a.plane.normal) { off(moved) } else { off(moved).min(off(corner)) };
                        assert!(off < 1e-9, "{number} {side} {factor}: {corner} is off by {off}");
                    }
                }
                let now = Outline::of(&stretched);
                let kept = [now.girdle_top - outline.girdle_top, now.girdle_bottom - outline.girdle_bottom];
                assert!(kept.iter().all(|by| by.abs() < 1e-12), "{number} {side}: {kept:?}");
                let [was, is] = [&outline, &now].map(|of| match side {
                    ScaledSide::Crown => of.crown_height(),
                    ScaledSide::Pavilion => of.pavilion_depth(),
                });
                assert!((is - factor * was).abs() < 1e-12, "{number} {side}: {was} {is}");
            }
        }
    }
}

#[test]
fn slopes_of_planes_are_those_of_differences() {
    let designs: Vec<Design> = lists_of_planes().into_iter().chain([tiers()]).collect();
    let step = 1e-3;
    for design in &designs {
        for side in ScaledSide::ALL {
            let slope = SideSlope::of(side, &stone(design));
            let at = |by: f64| after(design, side, 1.0 + by).facets().unwrap();
            let (below, above) = (at(-step), at(step));
            let (far_below, far_above) = (at(-2.0 * step), at(2.0 * step));
            let mut moves = 0;
            for (k, (name, plane)) in design.facets().unwrap().iter().enumerate() {
                let of = |pick: &dyn Fn(&Plane) -> DVec3| {
                    let near = pick(&above[k].1) - pick(&below[k].1);
                    let far = pick(&far_above[k].1) - pick(&far_below[k].1);
                    (8.0 * near - far) / (12.0 * step)
                };
                let (normal, offset) = slope.of_plane(plane);
                let differences = [of(&|plane| plane.normal), of(&|plane| DVec3::X * plane.offset)];
                assert!(normal.distance(differences[0]) < 1e-9, "{name} {side}: {normal} {}", differences[0]);
                assert!((offset - differences[1].x).abs() < 1e-9, "{name} {side}: {offset}");
                moves += usize::from(normal.length() > 0.1 || offset.abs() > 0.1);
            }
            // A rose has nothing below its girdle that could move.
            let outline = Outline::of(&stone(design));
            assert!(moves > 0 || outline.pavilion_depth() < 1e-9, "{side}");
        }
    }
}

#[test]
fn one_scale_after_the_other_multiplies_and_the_reverse_leads_back() {
    let design = tiers();
    for side in ScaledSide::ALL {
        let twice = after(&after(&design, side, 1.1), side, 0.9);
        let once = after(&design, side, 0.99);
        let back = after(&after(&design, side, 1.25), side, 0.8);
        for (one, other) in [(&twice, &once), (&back, &design)] {
            for (a, b) in one.facets().unwrap().iter().zip(&other.facets().unwrap()) {
                assert!(a.1.normal.abs_diff_eq(b.1.normal, 1e-12) && (a.1.offset - b.1.offset).abs() < 1e-12);
            }
        }
        let tangent = |design: &Design| design.cut.tangent_of_side(side).unwrap();
        assert!((tangent(&once) / tangent(&design) - 0.99).abs() < 1e-12);
    }
}

#[test]
fn the_angle_of_a_centre_point_follows_the_pavilion() {
    let mut design = tiers();
    let Cut::Tiers(tiers) = &mut design.cut else { panic!() };
    tiers.tiers[2].meet = Some(Meet::CentreAngle(41.0));
    let angle = |side, factor: f64| {
        let Cut::Tiers(tiers) = scaled(&design, side, factor).unwrap() else { panic!() };
        match tiers.tiers[2].meet {
            Some(Meet::CentreAngle(degrees)) => degrees.to_radians().tan() / 41f64.to_radians().tan(),
            _ => panic!("the meet is gone"),
        }
    };
    assert!((angle(ScaledSide::Pavilion, 1.2) - 1.2).abs() < 1e-12);
    assert!((angle(ScaledSide::Crown, 1.2) - 1.0).abs() < 1e-12);
}

#[test]
fn what_cannot_be_scaled_is_refused() {
    let brilliant = design(Cut::RoundBrilliant(MODERN));
    assert_eq!(scaled(&brilliant, ScaledSide::Crown, 1.1), Err(ScaleError::NotScalable));
    assert_eq!(brilliant.cut.tangent_of_side(ScaledSide::Crown), None);
    for factor in [0.0, -1.0, 0.099, 10.1, f64::NAN, f64::INFINITY] {
        let refused = scaled(&tiers(), ScaledSide::Crown, factor);
        assert!(matches!(refused, Err(ScaleError::Factor { .. })), "{factor}");
    }
    let mut steep = tiers();
    let Cut::Tiers(cut) = &mut steep.cut else { panic!() };
    cut.tiers[1].angle = -88.0;
    let error = scaled(&steep, ScaledSide::Pavilion, 6.0).unwrap_err().to_string();
    assert!(error.contains("'P2' would go from 88.00 to 89.") && error.contains("are possible"), "{error}");
    // A tier that is already too steep does not change.
    let Cut::Tiers(cut) = &mut steep.cut else { panic!() };
    cut.tiers[1].angle = -89.7;
    assert!(
        scaled(&steep, ScaledSide::Pavilion, 1.0).is_ok()
            && scaled(&steep, ScaledSide::Pavilion, 1.01).is_err()
    );
    let open = design(Cut::Planes(vec![("table".to_owned(), Plane::new(DVec3::Z, 1.0))]));
    assert!(matches!(scaled(&open, ScaledSide::Crown, 1.1), Err(ScaleError::Solid(_))));
}
