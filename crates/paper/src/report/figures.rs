//! The tables of a report.

use super::stone::{ReportedLight, ReportedStone};
use crate::export::FigureReport;
use brillianteer_cut::{Cut, ProportionReport, Spread};
use brillianteer_math::{fixed, signed};
use brillianteer_measure::{
    EightfoldPattern, FaceUpSize, Interval, MeasureName, OctantUnit, facet_deviations, measure_words,
};
use brillianteer_picture::{ReportTable, TextFlow};

/// Deviations and departures below this are printed as 0, and then no facet or octant is named as the worst.
const NOT_SHOWN: f64 = 5e-4;

/// Formats a part in percent with the greatest error.
pub(super) fn bounded(found: Interval) -> [String; 2] {
    if !found.most.is_finite() {
        return [format!("at least {}", fixed(100.0 * found.least, 2)), String::new()];
    }
    // Bounds are rounded up.
    // The sum with 0 leaves no minus before zero.
    let error = (1e4 * found.error() - 1e-6).ceil().max(0.0) / 100.0 + 0.0;
    [fixed(100.0 * found.middle(), 2), format!("± {error:.2}")]
}

/// Returns the proportions of the cut's family: those that the design gives, and those that follow.
pub(super) fn designed(stone: &ReportedStone) -> Vec<[String; 2]> {
    let cut = &stone.viewing.specimen.design.cut;
    let rows = cut.proportions().iter().map(|row| (row, (row.get)(cut)));
    rows.filter(|(_, value)| value.is_finite())
        .map(|(row, value)| [row.name.to_owned(), row.written(value)])
        .collect()
}

/// Returns the proportions that are measured on a convex stone; none of another solid.
pub(super) fn measured(stone: &ReportedStone) -> Vec<[String; 2]> {
    let specimen = stone.viewing.specimen;
    let Ok(convex) = specimen.stone() else { return vec![] };
    let report = ProportionReport::of(&convex.polytope, convex.names());
    let size = FaceUpSize::of(&convex.polytope, specimen.unit_mm(), specimen.carats());
    let percent = |value: f64| format!("{} %", fixed(value, 2));
    let [width, length] = report.table;
    let along = &report.along_axes;
    let ratios =
        [along.pavilion_to_width, along.girdle_to_width, along.crown_to_width, along.height_to_width];
    let ratios = ratios.map(|ratio| fixed(ratio, 3)).join(", ");
    let is_by_tiers = matches!(specimen.design.cut, Cut::Tiers(_));
    let pairs = [
        ("Outline, length to width", Some(fixed(report.length_to_width, 4))),
        ("Table, corner to corner", Some(percent(report.table_corners))),
        ("Table, width", Some(percent(width))),
        ("Table, length", Some(percent(length))),
        ("Crown height", Some(percent(report.crown_height))),
        ("Girdle thickness", Some(percent(report.girdle_thickness))),
        ("Pavilion depth", Some(percent(report.pavilion_depth))),
        ("Total depth", Some(percent(report.total_depth))),
        ("P/W, G/W, C/W, H/W", is_by_tiers.then_some(ratios)),
        ("Area from above", Some(format!("{} mm²", fixed(size.face_mm2, 2)))),
        ("Area to weight", size.mm2_per_carat.map(|area| format!("{} mm²/ct", fixed(area, 2)))),
        ("Spread", Some(format!("{} %", signed(size.spread_percent, 2)))),
        ("Weight ratio", size.weight_ratio.map(|ratio| fixed(ratio, 3))),
    ];
    pairs.into_iter().filter_map(|(name, value)| Some([name.to_owned(), value?])).collect()
}

/// Returns the tiers of a convex stone with the spread of their facets; `None` of another solid.
pub(super) fn tiers(stone: &ReportedStone) -> Option<ReportTable> {
    let convex = stone.viewing.specimen.stone().ok()?;
    let report =
        ProportionReport::of_cut(&stone.viewing.specimen.design.cut, &convex.polytope, convex.names());
    let range = |spread: Spread, digits: usize| {
        let [least, most] = [spread.least, spread.most].map(|value| fixed(value, digits));
        if least == most { "–".to_owned() } else { format!("{least} to {most}") }
    };
    let words = TextFlow::Words;
    let numbers = TextFlow::Numbers;
    let mut table = ReportTable::new(&[
        ("tier", words),
        ("zone", words),
        ("facets", numbers),
        ("slope, degrees", numbers),
        ("from least to greatest", numbers),
        ("distance, radii", numbers),
        ("from least to greatest", numbers),
    ]);
    for tier in &report.tiers {
        let (slope, distance) = (tier.slope_deg, tier.distance);
        let cells = [
            tier.name.replace('_', " "),
            tier.zone.name().to_owned(),
            tier.facets.to_string(),
            fixed(slope.mean, 2),
            range(slope, 2),
            fixed(distance.mean, 4),
            range(distance, 4),
        ];
        table.rows.push(cells.map(Into::into).to_vec());
    }
    Some(table)
}

/// Returns the light of a stone as a table, and a line about how it was measured.
pub(super) fn light(stone: &ReportedStone) -> (ReportTable, String) {
    let report = match &stone.light {
        ReportedLight::Figures(report) => return sampled(report),
        ReportedLight::Measures(report) => report,
    };
    let mut table = ReportTable::new(&[
        ("measure", TextFlow::Words),
        ("%", TextFlow::Numbers),
        ("at most", TextFlow::Numbers),
        ("what it counts", TextFlow::Sentences),
    ]);
    let mut last = "";
    for (name, found) in report.by_name().filter(|(name, _)| is_listed(*name)) {
        let [value, error] = bounded(found);
        // Returns of all domes share one meaning.
        let meaning = measure_words::meaning(name);
        let said = if meaning == last { "" } else { meaning };
        last = meaning;
        let cells = [measure_words::name(name), value, error, said.to_owned()];
        table.rows.push(cells.map(Into::into).to_vec());
    }
    let settings = &report.settings;
    let mut how = format!(
        "The stone is seen from above its table. Every number is the middle of an interval in which it certainly lies: exact beams \
         are followed until at most {} % of the light is left. The head has a half angle of {}°.",
        fixed(100.0 * report.measures.unresolved, 2),
        settings.head_deg,
    );
    if settings.indices[0] == settings.indices[1] {
        how += " The material is known by its index alone, so it has no fire.";
    } else if let Some(spread) = report.measures.spread_deg {
        how += &format!(" Colours spread by {}° on average.", fixed(spread, 2));
    }
    if let Some(pattern) = settings.pattern {
        how += &format!(" The eye resolves {:.3} mm on the stone.", pattern.resolves_mm);
    }
    (table, how)
}

/// Returns whether a report lists a measure: returns with glare differ from those without it by the same number under
/// all cuts.
pub(super) fn is_listed(name: MeasureName) -> bool {
    !matches!(name, MeasureName::ReturnWithGlare(_))
}

/// Returns the figures of a stone that rays traced.
fn sampled(report: &FigureReport) -> (ReportTable, String) {
    let measured = &report.measured;
    let figures = &measured.figures;
    let mut table = ReportTable::new(&[("light", TextFlow::Words), ("% of the face", TextFlow::Numbers)]);
    let mut row = |name: String, part: f64| table.rows.push(vec![name.into(), fixed(100.0 * part, 2).into()]);
    row("return, without glare".to_owned(), measured.light_return());
    row("glare".to_owned(), measured.glare());
    for (band, part) in measured.scope.bands.iter().zip(&figures.transmitted).rev() {
        row(format!("from {}", band.name), *part);
    }
    row("absorbed".to_owned(), figures.absorbed);
    let how = format!(
        "The solid is not a convex stone between planes, so {} sampled its light in the zones of the ASET: the standard error of \
         the return is {} %, and {} % of the light was not followed to its end. Measures with bounds, curves against tilt, profile \
         and facet diagram are those of convex stones.",
        report.backend.description(),
        fixed(100.0 * figures.standard_error, 2),
        fixed(100.0 * figures.unresolved, 2),
    );
    (table, how)
}

/// Returns the deviations of the facets of a round brilliant from their classes; `None` for any other stone.
pub(super) fn deviations(stone: &ReportedStone) -> Option<ReportTable> {
    let classes = facet_deviations(stone.viewing.specimen.stone().ok()?).ok()?;
    let numbers = TextFlow::Numbers;
    let mut table = ReportTable::new(&[
        ("class", TextFlow::Words),
        ("azimuth, max - min", numbers),
        ("worst facet", numbers),
        ("slope, max - min", numbers),
        ("worst facet", numbers),
    ]);
    for class in classes {
        let worst = |of: &brillianteer_measure::FacetDeviation, spread: f64| {
            if spread < NOT_SHOWN {
                "–".to_owned()
            } else {
                format!("{} {}°", of.facet, signed(of.by_deg, 3))
            }
        };
        let cells = [
            class.class.to_owned(),
            format!("{}°", fixed(class.azimuth_spread_deg, 3)),
            worst(&class.worst_azimuth, class.azimuth_spread_deg),
            format!("{}°", fixed(class.slope_spread_deg, 3)),
            worst(&class.worst_slope, class.slope_spread_deg),
        ];
        table.rows.push(cells.map(Into::into).to_vec());
    }
    Some(table)
}

/// Returns the hearts and arrows of a stone as a table; `None` of a stone that has none.
pub(super) fn hearts_and_arrows(stone: &ReportedStone) -> Option<ReportTable> {
    let patterns = &stone.hearts.as_ref()?.patterns;
    let mut table = ReportTable::new(&[
        ("pattern", TextFlow::Words),
        ("median", TextFlow::Numbers),
        ("max - min", TextFlow::Numbers),
        ("worst octant", TextFlow::Numbers),
    ]);
    for (name, pattern) in [("arrows", &patterns.arrows), ("hearts", &patterns.hearts)] {
        add_pattern(&mut table, name, pattern);
    }
    Some(table)
}

fn add_pattern(table: &mut ReportTable, name: &str, pattern: &EightfoldPattern) {
    for figure in &pattern.figures {
        let unit = match figure.unit {
            OctantUnit::Diameter => "% of the diameter",
            OctantUnit::Face => "% of the face",
            OctantUnit::Degrees => "degrees",
        };
        let number = |value: Option<f64>| value.map_or("–".to_owned(), |value| fixed(value, 3));
        let worst = figure.worst.filter(|_| figure.spread.is_some_and(|spread| spread >= NOT_SHOWN));
        let worst = worst.map_or("–".to_owned(), |worst| {
            format!("{} ({}) {}", worst.octant, pattern.mains[worst.octant - 1], signed(worst.by, 3))
        });
        let label = format!("{name}: {}, {unit}", figure.name);
        table
            .rows
            .push([label, number(figure.median), number(figure.spread), worst].map(Into::into).to_vec());
    }
    let label = format!("{name}: departure from eightfold, % of its area");
    let worst = pattern.worst();
    let worst = if worst.by >= NOT_SHOWN {
        format!("{} ({}) {}", worst.octant, pattern.mains[worst.octant - 1], fixed(worst.by, 3))
    } else {
        "–".to_owned()
    };
    table.rows.push([label, fixed(pattern.departure, 3), String::new(), worst].map(Into::into).to_vec());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_rounded_up_and_nought_has_no_sign() {
        let of = |least: f64, most: f64| bounded(Interval { least, most }).join(" ");
        assert_eq!(of(0.5, 0.5), "50.00 ± 0.00");
        assert_eq!(of(0.0, 0.0), "0.00 ± 0.00");
        assert_eq!(of(-1e-12, 1e-12), "0.00 ± 0.00");
        assert_eq!(of(0.731, 0.731_21), "73.11 ± 0.02");
        assert_eq!(of(0.25, f64::INFINITY), "at least 25.00 ");
        assert_eq!([fixed(-0.001, 2), fixed(-1.006, 2)], ["0.00", "-1.01"]);
    }
}
