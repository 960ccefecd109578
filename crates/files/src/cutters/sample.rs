//! A design that uses everything that both `.gem` and `.gcs` can hold, for their tests.

use brillianteer_cut::{Cut, DEFAULT_DIAMETER_MM, Design, Indexed, MaterialRef, Tier, Tiers};
use brillianteer_math::Pose;
use brillianteer_scene::Specimen;
use std::collections::BTreeMap;

fn tier(angle: f64, distance: f64, indices: &[f64], name: &str, instructions: &str) -> Tier {
    let mut facets: Vec<Indexed> =
        indices.iter().map(|&index| Indexed { index, name: String::new() }).collect();
    facets[0].name = name.to_owned();
    Tier {
        angle,
        distance,
        instructions: instructions.to_owned(),
        meet: None,
        is_cut: true,
        frosting: 0.0,
        facets,
    }
}

/// Returns a box with bevels, some at indices between two teeth. It reaches 1 across, and as far below z = 0 as above.
pub(in super::super) fn design() -> Design {
    let around = [24.0, 48.0, 72.0, 96.0];
    let tiers = Tiers {
        gear: -96,
        offset: 48.5,
        symmetry: 4,
        mirror: true,
        headers: ["Büchse & <Deckel>", "A. \"Nonymous\"", "", "third"].map(str::to_owned).to_vec(),
        footers: vec!["the end".to_owned(), "– really".to_owned()],
        remarks: BTreeMap::new(),
        tiers: vec![
            tier(-90.0, 1.0, &around.map(|index| index - 23.5), "G1", "Level 'girdle'"),
            tier(-41.234567, 1.0, &around.map(|index| index - 23.5), "P1", ""),
            tier(33.3, 0.95, &[12.25, 36.25, 60.25, 84.25], "", "Meet & greet"),
            tier(-33.3, 1.05, &[12.25, 36.25], "odd", ""),
            tier(0.0, 0.6, &[96.0], "T", "Polish"),
            tier(-0.0, 0.6, &[96.0], "C", ""),
        ],
    };
    Design {
        name: tiers.headers[0].clone(),
        source: None,
        notes: None,
        material: MaterialRef::Index(1.7654321),
        diameter_mm: DEFAULT_DIAMETER_MM,
        cut: Cut::Tiers(tiers),
    }
}

/// Builds the specimen of a design.
pub(in super::super) fn specimen(design: Design) -> Specimen {
    Specimen::new(design).unwrap()
}

/// Returns the tiers of a design, for a test to alter.
pub(in super::super) fn tiers(design: &mut Design) -> &mut Tiers {
    let Cut::Tiers(tiers) = &mut design.cut else { panic!("it is cut by tiers") };
    tiers
}

/// Returns stones that are not cut by tiers: a brilliant, and planes that do not lie around the origin.
pub(in super::super) fn others() -> [Specimen; 2] {
    let brilliant = Design { cut: Cut::RoundBrilliant(brillianteer_cut::TOLKOWSKY), ..design() };
    let solid = specimen(brilliant.clone())
        .stone()
        .unwrap()
        .polytope
        .reframed(&Pose { at: glam::DVec3::X * 5.0, ..Pose::STILL });
    let planes = solid.planes().enumerate().map(|(k, plane)| (format!("f {k}"), plane)).collect();
    let aside = Design { cut: Cut::Planes(planes), source: Some("a book".to_owned()), ..design() };
    [brilliant, aside].map(specimen)
}
