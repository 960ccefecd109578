//! Lists of a stone's hearts and arrows, and of its spread.

use brillianteer_math::signed;
use brillianteer_measure::{EightfoldPattern, FaceUpSize, OctantFigure, OctantUnit};
use brillianteer_paper::export::HeartsReport;
use brillianteer_paper::table::{Column, Table, TableCell};
use std::fmt::Write;

/// Departures below this are printed as 0, and then no octant is named as the worst.
const NOT_SHOWN: f64 = 5e-4;

/// Formats hearts and arrows as two tables.
pub fn table_of_hearts(report: &HeartsReport) -> String {
    let HeartsReport { viewing, patterns, deviations } = report;
    let mut text = format!(
        "{}: {}, {}, viewer with a camera of {}° and a ring of {}° from the axis\n",
        viewing.file,
        viewing.specimen.design.name,
        viewing.specimen.material.with_index(viewing.medium.index),
        patterns.camera_deg,
        patterns.ring_deg,
    );
    for (name, pattern) in
        [("arrows, face up", &patterns.arrows), ("hearts, through the pavilion", &patterns.hearts)]
    {
        list(&mut text, name, pattern);
    }
    let _ = write!(text, "\n% D: percent of the diameter; % F: percent of the face, the area of the stone.");
    let facets = deviations.iter().flat_map(|class| {
        let azimuth = (class.azimuth_spread_deg, &class.worst_azimuth, "azimuth");
        [azimuth, (class.slope_spread_deg, &class.worst_slope, "slope")]
    });
    for (_, worst, of) in facets.filter(|(spread, ..)| *spread >= NOT_SHOWN) {
        let _ = write!(text, "\n{}: {of} {}° from its class", worst.facet, signed(worst.by_deg, 3));
    }
    text
}

/// Adds the table of one pattern.
fn list(text: &mut String, name: &'static str, pattern: &EightfoldPattern) {
    let mut table = Table::headed([
        Column::left(name, 32),
        Column::right("median", 9).digits(3),
        Column::right("max-min", 9).digits(3),
        Column::text("worst octant").after(3),
    ]);
    pattern.figures.iter().for_each(|figure| table.row(cells(figure, &pattern.mains)));
    let _ = writeln!(text, "\n{table}");
    let worst = pattern.worst();
    let _ = write!(text, "departure from eightfold: {:.3} % of the pattern's area", pattern.departure);
    if worst.by >= NOT_SHOWN {
        let _ = write!(
            text,
            ", most in octant {} ({}), {:.3} %",
            worst.octant,
            pattern.mains[worst.octant - 1],
            worst.by
        );
    }
    let _ = writeln!(text, "\nthe strongest exit of {:.3} % of the face is not certain", pattern.undecided);
}

/// Returns the cells of one figure.
fn cells(figure: &OctantFigure, mains: &[String; 8]) -> [TableCell; 4] {
    let unit = match figure.unit {
        OctantUnit::Diameter => "% D",
        OctantUnit::Face => "% F",
        OctantUnit::Degrees => "°",
    };
    let name = format!("{}, {unit}", figure.name);
    let (Some(median), Some(spread), Some(worst)) = (figure.median, figure.spread, figure.worst) else {
        return [name.into(), "-".into(), "-".into(), "in no octant".into()];
    };
    let missing: Vec<String> = (1..)
        .zip(&figure.octants)
        .filter(|(_, value)| value.is_none())
        .map(|(k, _)| format!("{k}"))
        .collect();
    let at = match missing.is_empty() {
        false => format!("none in octant {}", missing.join(", ")),
        true if spread < NOT_SHOWN => "-".to_owned(),
        true => format!("{} ({}) {}", worst.octant, mains[worst.octant - 1], signed(worst.by, 3)),
    };
    [name.into(), median.into(), spread.into(), at.into()]
}

/// Formats the spread of a stone.
pub fn table_of_spread(path: &str, size: &FaceUpSize) -> String {
    let mut table = Table::new([Column::left("", 28), Column::right("", 10).digits(3)]);
    table.pair("face, mm²", size.face_mm2);
    table.pair("mean width, mm", size.mean_width_mm);
    table.pair("weight, ct", size.carats);
    table.pair("face for weight, mm²/ct", size.mm2_per_carat);
    table.pair("spread, %", signed(size.spread_percent, 3));
    table.pair("weight ratio", size.weight_ratio.map_or("-".to_owned(), |ratio| format!("{ratio:.4}")));
    format!(
        "{path}: face-up size for weight\n\n\
         {table}\n\n\
         Spread is by how much the face is larger than that of a reference brilliant of the same weight (table 57, crown 34.0°,\n\
         pavilion 40.7°, girdle 2.5 %). The weight ratio, after GIA and only of round stones, is the volume in volumes of that\n\
         brilliant at the same mean width."
    )
}
