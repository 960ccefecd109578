//! The sources of the usual range of each number.
//!
//! "Published" means a page or a table that was read; GemCad's library and other designs of cutters count as
//! published too. A range that is only near a published one says so. "Ours" means that no source publishes the range;
//! the reason for it follows.

use crate::{Family, Proportion};
use brillianteer_base::Unit;

const GIRDLE: &str = "ours: from a very thin girdle to a thick one; no source gives percents";
const CULET: &str = "ours: from a point to a culet that shows through the table";
const ROWS: &str = "all that is possible; the trade cuts two or three";
const STEP: &str = "ours: from rows that can just be distinguished to the steepest that look stepped";
const STARS: &str = "ours, around the 45 to 55 of round brilliants";
const HALVES: &str = "ours, around the 70 to 85 of round brilliants";
const MAINS: &str = "all that is possible; the trade cuts two a quarter";
const BULGE: &str = "ours: from sides that are just bulged to a pillow, as in the trade's pictures";
const FULLNESS: &str = "ours: flatter and fuller than an arc, as in the trade's pictures";
const EMERALD_SLOPE: &str = "wider than published for emerald cuts (diamondcuttersintl.com: 43.3 to 46.8)";
const EMERALD_CROWN: &str = "wider than published for emerald cuts (diamondcuttersintl.com: 32 to 35)";
const EMERALD_TABLE: &str = "published for emerald cuts: 55 to 75 (gemmology.dev), from 50 on";

impl Family {
    /// Returns the source of the usual range of one of the family's numbers; `None` where it is not stated, as for the round
    /// brilliant and for shapes of glass.
    pub fn range_source(&self, row: &Proportion) -> Option<&'static str> {
        self.net?;
        own(self.key, row.key).or_else(|| common(self.key, row))
    }
}

/// Returns the source of a range that several families have in common.
fn common(family: &str, row: &Proportion) -> Option<&'static str> {
    match row.key {
        "girdle_thickness" => Some(GIRDLE),
        "culet" => Some(CULET),
        "crown_rows" | "pavilion_rows" => Some(ROWS),
        "crown_step" | "pavilion_step" => Some(STEP),
        "star_length" => Some(STARS),
        "lower_half_length" => Some(HALVES),
        "bulge" => Some(BULGE),
        "fullness" => Some(FULLNESS),
        "corner_radius" => Some("ours: from small corners to soft ones, as in the trade's pictures"),
        "keel" => Some("ours: from steeper ends to flatter ones than the sides"),
        _ if row.unit == Unit::Count && row.key.starts_with("mains_per_") => Some(MAINS),
        _ => step_cut(family, row.key),
    }
}

/// Returns the source of a range that step cuts have in common.
fn step_cut(family: &str, key: &str) -> Option<&'static str> {
    let is_step = ["emerald", "asscher", "baguette", "tapered_baguette", "kite", "hexagon"].contains(&family);
    let source = match key {
        "table" => EMERALD_TABLE,
        "crown_angle" => EMERALD_CROWN,
        "pavilion_angle" => EMERALD_SLOPE,
        _ => return None,
    };
    is_step.then_some(source)
}

/// Sources of ranges: the families (an empty list stands for all), the keys of the numbers (likewise), and the
/// source. The first row that fits counts.
const OWN: &[(&[&str], &[&str], &str)] = &[
    (&["rose", "briolette"], &["total_depth"], "ours: the depths that follow from usual heights and lengths"),
    (&["oval"], &["total_depth"], "published: 56 to 70 (gemmology.dev)"),
    (&["marquise", "pear"], &["total_depth"], "wider than published (diamondcuttersintl.com: 56 to 61)"),
    (
        &["heart"],
        &["total_depth"],
        "wider than published for pear and marquise (diamondcuttersintl.com: 56 to 61)",
    ),
    (&["cushion", "modified_cushion"], &["total_depth"], "published: 58 to 72 (gemmology.dev)"),
    (&["emerald"], &["total_depth"], "published: 58 to 72 (gemmology.dev)"),
    (&["princess"], &["total_depth"], "published: 65 to 80 (brilliancelab)"),
    (&[], &["total_depth"], "ours: around that of the first cut"),
    (
        &["single_cut"],
        &["table", "crown_angle", "pavilion_angle"],
        "ours: round brilliants, with the larger tables and flatter crowns of small stones; no source gives numbers",
    ),
    (
        &["portuguese"],
        &["facets", "crown_rows", "pavilion_rows"],
        "all that is possible; PC 01.028A has 16 facets in 5 and 6 rows",
    ),
    (&["portuguese"], &["table"], "wider than PC 01.028A, B and C (.45)"),
    (
        &["portuguese"],
        &["crown_angle", "pavilion_angle"],
        "wider than PC 01.028A (52 at the girdle, 40 at the culet)",
    ),
    (&["portuguese"], &["rosette"], "ours: the range that leaves room for all rows"),
    (&["rose"], &["sides"], "all that is possible; the trade counts triangles in threes"),
    (&["rose"], &["rows"], "all that is possible: pyramid and Dutch rose"),
    (&["rose"], &["height"], "around PC 45.063 (32) and the half that is quoted from memory"),
    (&["rose"], &["star", "star_angle"], "wider than PC 45.063"),
    (
        &["briolette"],
        &["facets", "upper_rows", "lower_rows"],
        "all that is possible; PC 01.386 has 16 facets in 4 and 5 rows",
    ),
    (&["briolette"], &[], "ours: the shapes of earrings"),
    (&["oval"], &["length_to_width"], "wider than published (yourjewel.com: 1.30 to 1.65)"),
    (&["oval"], &["fullness"], "ours: from the ellipse to fuller shoulders"),
    (&["oval"], &["table"], "published: 50 to 68 (gemmology.dev)"),
    (&["oval"], &["crown_angle"], "wider than published (gemmology.dev: 30 to 38)"),
    (&["oval"], &["pavilion_angle"], "wider than published (gemmology.dev: 38 to 44)"),
    (
        &["marquise"],
        &["length_to_width"],
        "wider than published (yourjewel.com: 1.80 to 2.20; GemCad's library: 1.61 to 2.67)",
    ),
    (
        &["pear"],
        &["length_to_width"],
        "wider than published (yourjewel.com: 1.50 to 1.75; GemCad's library: 1.23 to 1.72)",
    ),
    (
        &["pear", "marquise", "heart"],
        &["table"],
        "wider than published (diamondcuttersintl.com: 53 to 60, given for pear and marquise)",
    ),
    (
        &["pear", "marquise", "heart"],
        &["crown_angle"],
        "wider than published (diamondcuttersintl.com: 32 to 35, given for pear and marquise)",
    ),
    (
        &["pear", "marquise", "heart"],
        &["pavilion_angle"],
        "wider than published (diamondcuttersintl.com: 39.25 to 40.75, given for pear and marquise)",
    ),
    (&["pear"], &["head"], "ours: flatter and fuller than half a circle, as in the trade's pictures"),
    (&["pear", "heart"], &["middle"], "ours: where the culet looks centred"),
    (&["heart"], &["length_to_width"], "published: 0.90 to 1.10 (yourjewel.com)"),
    (&["heart"], &["cleft", "lobe_height"], "ours, as in the trade's pictures"),
    (&["heart"], &["star_length"], "ours: shorter than of other cuts, for the room at the cleft"),
    (&["heart"], &["mains_per_half"], "all that is possible; the trade cuts four or five"),
    (
        &["cushion", "modified_cushion"],
        &["length_to_width"],
        "around what is quoted from memory: square to 1.05, long to 1.30",
    ),
    (
        &["cushion", "modified_cushion"],
        &["table"],
        "around published ones (gemmology.dev: 55 to 75; GemCad's library: 45 to 62)",
    ),
    (&["cushion", "modified_cushion"], &["crown_angle"], "wider than published (gemmology.dev: 33 to 38)"),
    (&["cushion"], &["pavilion_angle"], "wider than published (gemmology.dev: 38 to 44)"),
    (
        &["modified_cushion"],
        &["upper_angle", "lower_angle"],
        "ours: depths of about 61 to 68 (gemmology.dev); no source gives angles of rows",
    ),
    (&["modified_cushion"], &["tip_depth"], "ours: the range that leaves room for all rows"),
    (&["modified_cushion"], &["rows"], "published: 2 to 4 (caratwire.com)"),
    (&["trillion"], &["table"], "within GemCad's library (30 to 59), and as of other brilliants"),
    (
        &["trillion"],
        &["crown_angle", "pavilion_angle"],
        "ours, around round brilliants; published are depths of the pavilion (GemCad's library: 38 to 51)",
    ),
    (&["emerald"], &["length_to_width"], "wider than published (amorejewelry.com: 1.40 to 1.70)"),
    (&["emerald"], &["corner"], "ours, as in the trade's pictures"),
    (&["asscher"], &["length_to_width"], "published: 1 (amorejewelry.com), up to what still looks square"),
    (&["asscher"], &["corner"], "ours: \"wide\" is published (amorejewelry.com), up to a regular octagon"),
    (&["asscher"], &["table"], "ours: \"small\" is published (amorejewelry.com)"),
    (&["asscher"], &["crown_angle"], "ours: \"high\" is published (amorejewelry.com)"),
    (&["baguette", "tapered_baguette"], &["length_to_width"], "around PC 12.001 (2.0)"),
    (&["tapered_baguette"], &["narrow_end"], "ours, as in the trade's pictures"),
    (&["kite"], &["length_to_width", "shoulder"], "ours, from a lozenge to a long kite"),
    (
        &["hexagon"],
        &["length_to_width", "point_angle"],
        "ours, around the regular hexagon (1.155, 120 degrees)",
    ),
    (&["princess"], &["length_to_width"], "ours: from the square to the stones that are sold as rectangular"),
    (&["princess"], &["corner"], "ours: bevels that keep a corner from chipping"),
    (&["princess"], &["table"], "published: 60 to 80 (brilliancelab)"),
    (
        &["princess"],
        &["main_1_angle", "main_2_angle"],
        "ours: crowns 8 to 15 percent high; no source gives the angles",
    ),
    (&["princess"], &["star_azimuth"], "around published ones (B. Harding on the AGS's model: 6)"),
    (&["princess", "radiant"], &["chevrons"], "published: 2 to 4 (briangavindiamonds.com, caratwire.com)"),
    (&["princess"], &["pavilion_depth"], "ours: total depths of 65 to 80 (brilliancelab)"),
    (
        &["princess", "radiant"],
        &["chevron_step", "shoulder"],
        "ours: the range that leaves room for all rows",
    ),
    (&["radiant"], &["length_to_width"], "published: 1.0 to 1.5, the range of weight tables (Gemwest)"),
    (&["radiant"], &["table"], "around GemCad's library (54 to 69)"),
    (
        &["radiant"],
        &["crown_rows"],
        "all that is possible; a brilliant or a step crown is published (caratwire.com)",
    ),
    (&["radiant"], &["crown_angle"], "around PC 04.039 (37)"),
    (&["radiant"], &["pavilion_depth"], "around GemCad's library (51 to 78), for diamond"),
    (
        &["radiant"],
        &["corner", "star_azimuth", "corner_step", "crown_step"],
        "ours, as in the trade's pictures",
    ),
    (&["barion"], &["corner"], "ours: those of square emerald cuts"),
    (
        &["barion", "cushion_barion"],
        &["length_to_width"],
        "ours: from the square to where the cone is still nearly round",
    ),
    (
        &["oval_barion"],
        &["length_to_width"],
        "ours: around PC 02.094 (1.40); shorter ones leave the moons no room",
    ),
    (&["oval_barion"], &["half_moon_angle"], "around PC 02.094 (58 to 71)"),
    (
        &["barion", "cushion_barion", "oval_barion"],
        &["table"],
        "ours: those of emerald cuts and cutters' barions (.55)",
    ),
    (&["barion", "cushion_barion", "oval_barion"], &["crown_angle"], "ours: those of emerald cuts"),
    (
        &["barion", "cushion_barion"],
        &["half_moon_angle"],
        "ours: from flat half-moons to nearly upright ones",
    ),
    (
        &["barion", "cushion_barion", "oval_barion"],
        &["pavilion_angle", "lower_half_length"],
        "ours: those of round brilliants",
    ),
];

/// Returns the source of a range of one family.
fn own(family: &str, key: &str) -> Option<&'static str> {
    let fits = |named: &[&str], name| named.is_empty() || named.contains(&name);
    let row = OWN.iter().find(|(families, keys, _)| fits(families, family) && fits(keys, key));
    row.map(|(_, _, source)| *source)
}
