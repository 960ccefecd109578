//! The report on one stone.

use super::stone::ReportedStone;
use super::tilts::{TiltCurves, tilt_plot};
use super::{ReportOrigin, figures, provenance};
use brillianteer_base::Failure;
use brillianteer_cut::Cut;
use brillianteer_measure::MeasureName;
use brillianteer_picture::{FigureRow, Report, ReportFigure, ReportPart, ReportTable};
use brillianteer_scene::DomeLight;

/// The greatest height of the pictures in scopes, as a part of the width of the text.
const PICTURES: f64 = 0.24;
/// The greatest height of profile and facet diagram, and of plots.
const DRAWINGS: f64 = 0.5;
const PLOTS: f64 = 0.36;

/// Puts the report on a stone together.
pub(super) fn report(stone: &ReportedStone, origin: &ReportOrigin) -> Result<Report, Failure> {
    let design = &stone.viewing.specimen.design;
    let heading = |text: &str| ReportPart::Heading(text.to_owned());
    let row = |drawings: &[super::pictures::NamedDrawing], most_height: f64| {
        let figure = |of: &super::pictures::NamedDrawing| ReportFigure {
            caption: of.name.to_owned(),
            drawing: of.drawing.clone(),
        };
        ReportPart::Figures(FigureRow { figures: drawings.iter().map(figure).collect(), most_height })
    };
    let mut parts = vec![row(&stone.pictures, PICTURES)];
    if !stone.drawings.is_empty() {
        parts.push(row(&stone.drawings, DRAWINGS));
    }
    for (name, pairs) in [
        ("Proportions of the design", figures::designed(stone)),
        ("Measured on the stone, in percent of its diameter or width", figures::measured(stone)),
    ] {
        if !pairs.is_empty() {
            parts.extend([heading(name), ReportPart::Table(ReportTable::of_pairs(pairs, 3))]);
        }
    }
    if matches!(stone.viewing.specimen.design.cut, Cut::RoundBrilliant(_)) {
        let text = "Crown, girdle and pavilion of the design are taken at the mains, where the girdle is thickest; those measured \
            are taken between the girdle's edges, beyond which a tenth of its corners lie.";
        parts.push(ReportPart::Text(text.to_owned()));
    }
    let (table, how) = figures::light(stone);
    parts.extend([heading("Light, in percent of the face"), ReportPart::Table(table), ReportPart::Text(how)]);
    if let Some(tilts) = &stone.tilts {
        parts.push(heading("Light against tilt; the width of a curve is its bound"));
        parts.extend(plots(tilts)?);
    }
    if let Some(table) = figures::tiers(stone) {
        let name = "Facets: the mean of each tier and the spread within it";
        parts.extend([heading(name), ReportPart::Table(table)]);
    }
    if let Some(table) = figures::deviations(stone) {
        let name = "Optical symmetry: deviations of facets from their class";
        parts.extend([heading(name), ReportPart::Table(table)]);
    }
    if let Some(table) = figures::hearts_and_arrows(stone) {
        parts.extend([heading("Hearts and arrows, octant by octant"), ReportPart::Table(table)]);
    }
    let fingerprint = ["geometry, SHA-256".to_owned(), stone.fingerprint.clone()];
    Ok(Report {
        title: design.name.clone(),
        subtitle: design.source.clone().unwrap_or_default(),
        facts: stone.facts(),
        parts,
        provenance: provenance(vec![fingerprint], origin),
        mark: origin.date.clone().unwrap_or_default(),
    })
}

/// Draws two plots against tilt: returned and lost light, and the play of light.
fn plots(tilts: &TiltCurves) -> Result<Vec<ReportPart>, Failure> {
    let of = |list: &[(MeasureName, &str)]| -> Vec<(&TiltCurves, MeasureName, String)> {
        list.iter().map(|&(measure, name)| (tilts, measure, name.to_owned())).collect()
    };
    let brightness = of(&[
        (MeasureName::Return(DomeLight::of(0.0)), "return, even light"),
        (MeasureName::Return(DomeLight::of(1.0)), "return, by cosine"),
        (MeasureName::Leakage, "leakage"),
        (MeasureName::Windowing, "windowing"),
    ]);
    let play = of(&[
        (MeasureName::Obstruction, "obstruction"),
        (MeasureName::Extinction, "extinction"),
        (MeasureName::Fire, "fire"),
    ]);
    let mut parts = vec![];
    for (title, wanted) in [("Brightness", brightness), ("Obstruction and fire", play)] {
        if let Some(drawing) = tilt_plot("", &wanted)? {
            let figures = vec![ReportFigure { caption: title.to_owned(), drawing }];
            parts.push(ReportPart::Figures(FigureRow { figures, most_height: PLOTS }));
        }
    }
    Ok(parts)
}
