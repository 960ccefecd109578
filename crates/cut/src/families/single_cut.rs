//! The single cut, or eight cut: an octagonal table, eight mains above and eight below, on a round girdle. It has no
//! stars and no halves.
//!
//! The trade counts 17 facets, or 18 with a culet (visualdictionaryonline.com). No numbers are published for it. The
//! ranges are those of round brilliants, with the larger tables and flatter crowns of small stones as an estimate.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family::{Family, Proportion};
use super::super::family_cut::FamilyCut;
use super::rows;
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_8, PI, TAU};

const TABLE: usize = 0;
const CROWN: usize = 1;
const PAVILION: usize = 2;
const GIRDLE: usize = 3;
const CULET: usize = 4;

/// The number of mains around the table, and of those below.
const MAINS: u32 = 8;

/// The number of upright facets of the girdle: eight for each main, so that corners lie where mains meet.
const UPRIGHT: u32 = 64;

/// The family of the single cut.
pub static SINGLE_CUT: Family = Family {
    key: "single_cut",
    name: "Single cut",
    first: FamilyCut::first(&SINGLE_CUT, &[60.0, 33.0, 40.5, 2.0, 0.0]),
    net: Some(net),
    depth: Some(depth),
    proportions: &[
        Proportion {
            meaning: "The width of the flat facet on top, from corner to opposite corner.",
            ..rows::table::<TABLE>([40.0, 70.0])
        },
        Proportion {
            meaning: "The angle between the eight facets around the table and the girdle plane.",
            ..rows::slope::<CROWN>("crown_angle", "Crown angle", [25.0, 42.0])
        },
        Proportion {
            meaning: "The angle between the eight facets of the pavilion and the girdle plane.",
            ..rows::slope::<PAVILION>("pavilion_angle", "Pavilion angle", [38.0, 44.0])
        },
        Proportion {
            meaning: "The girdle's thickness in the middle of a main, where it is least; it is greatest between two mains.",
            ..rows::girdle_thickness::<GIRDLE>()
        },
        rows::culet::<CULET>(),
        rows::total_depth([50.0, 68.0], &["pavilion_angle"]),
    ],
};

fn depth(cut: &FamilyCut) -> f64 {
    let [crown, pavilion] = [CROWN, PAVILION].map(|place| cut[place].to_radians().tan());
    (1.0 - side(cut)) * crown + cut[GIRDLE] / 50.0 + pavilion * (1.0 - cut[CULET] / 100.0)
}

/// Returns the distance of the table's sides from the axis. Its corners lie between the mains.
fn side(cut: &FamilyCut) -> f64 {
    cut[TABLE] / 100.0 * FRAC_PI_8.cos()
}

fn net(cut: &FamilyCut) -> Result<FacetNet, NoRoom> {
    let [crown, pavilion] = [CROWN, PAVILION].map(|place| cut[place].to_radians().tan());
    let thickness = cut[GIRDLE] / 50.0;
    let around = |count: u32, from: f64| {
        (0..count).map(move |number| DVec2::from_angle((f64::from(number) + from) * TAU / f64::from(count)))
    };
    let mut net = FacetNet::default();
    net.plane("table", DVec3::Z, DVec3::Z * (1.0 - side(cut)) * crown);
    for out in around(MAINS, 0.0) {
        net.plane("bezel", (out * crown).extend(1.0), out.extend(0.0));
    }
    if thickness > 0.0 {
        // Two upright facets meet in a corner wherever two mains meet. The corners lie on the circle by which a round
        // stone is measured.
        let apart = (PI / f64::from(UPRIGHT)).cos();
        around(UPRIGHT, 0.5).for_each(|out| net.plane("girdle", out.extend(0.0), (out * apart).extend(0.0)));
    }
    for out in around(MAINS, 0.0) {
        net.plane("main", (out * pavilion).extend(-1.0), out.extend(-thickness));
    }
    if cut[CULET] > 0.0 {
        let depth = thickness + pavilion * (1.0 - cut[CULET] / 100.0);
        net.plane("culet", DVec3::NEG_Z, DVec3::NEG_Z * depth);
    }
    Ok(net)
}
