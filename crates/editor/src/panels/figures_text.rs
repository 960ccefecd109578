//! Figures in words: the stone and view that they describe, and all of them as text and as tables for the clipboard.

use crate::panels::figure_lines::{Counting, FigureLine, energy, lines, zones};
use brillianteer_math::{fixed, signed};
use brillianteer_paper::table::{Column, Table};
use brillianteer_scene::Glare;
use brillianteer_session::model::{Model, eye::Eye, figures::ShownFigures};
use brillianteer_session::studio::{Grade, Tilts, Which};
use std::fmt::Write as _;

/// Returns the figures of the design compared with.
pub fn other(model: &Model) -> Option<&ShownFigures> {
    model.session.compared.as_ref().and_then(|_| model.session.measured.figures.get(&Which::Other))
}

/// Returns whether figures are final, and their error where they are sampled, in words.
pub fn state(model: &Model, measured: &ShownFigures) -> String {
    let is_ordered = model.session.ordered.figures.iter().any(|(_, order)| *order == measured.order);
    let state = match is_ordered && measured.grade == Grade::Fine {
        true if model.document.shows_last_possible() => "figures of the last possible stone",
        true => "final",
        false => "becoming finer…",
    };
    let glare = model.workspace.glare().description();
    let error = match measured.figures.standard_error {
        0.0 => return format!("{state}; {glare}"),
        error => format!("standard error {:.2} %", 100.0 * error),
    };
    match measured.figures.estimate {
        Some(_) => format!("{state}; {error}; {glare}"),
        None => format!("{state}; by rays, {error}; {glare}"),
    }
}

/// Returns the direction from which the stone is seen for the figures, in words.
pub fn view(eye: &Eye) -> String {
    let tilt = eye.tilt().to_degrees();
    let azimuth = (eye.view(None).azimuth - eye.turn).to_degrees().rem_euclid(360.0);
    let what = if eye.eye_leans { "eye" } else { "stone" };
    if tilt == 0.0 {
        "Table side, face up".to_owned()
    } else {
        format!("Table side, {what} tilted {}° toward {}°", fixed(tilt, 1), fixed(azimuth, 0))
    }
}

/// Returns the figures that the panel shows, as text or as a table; `None` before there are any.
pub fn shown(model: &Model, as_table: bool) -> Option<String> {
    let measured = model.session.measured.figures.get(&Which::Present)?;
    let (other, counting) = (other(model), Counting::of(&model.workspace));
    let by = if counting.by_area { "area of strongest exits" } else { "energy" };
    let about = FiguresSubject {
        design: &model.document.work.design.name,
        view: &view(&model.workspace.eye),
        state: &format!("ASET, {by}; {}", state(model, measured)),
        other: other.and(model.session.compared.as_ref()).map(|compared| compared.name.as_str()),
    };
    let lines = |by_area| lines(measured, other, Counting { by_area, ..counting });
    Some(if as_table {
        csv(&about, &lines(false), &lines(true))
    } else {
        text(&about, &lines(counting.by_area))
    })
}

/// The subject of a text of figures, in words.
struct FiguresSubject<'a> {
    design: &'a str,
    /// The direction from which the design is seen.
    view: &'a str,
    /// The way in which the figures are counted, and whether they are final.
    state: &'a str,
    /// The name of the design compared with, if any.
    other: Option<&'a str>,
}

/// Returns the figures of the panel as text: a line about their subject, then a line for each.
fn text(about: &FiguresSubject, lines: &[FigureLine]) -> String {
    let FiguresSubject { design, view, state, other } = about;
    let mut text = format!("{design}: {view}; {state}\n");
    if let Some(other) = other {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "in brackets the difference from {other}");
    }
    let mut table = Table::new([
        Column::left("", 14),
        Column::right("", 8).digits(3),
        Column::text("").after(1),
        Column::text("").after(1),
    ]);
    for line in lines {
        let difference = match (line.other, line.difference()) {
            (None, _) => String::new(),
            (Some(_), Some(difference)) => format!("({})", signed(100.0 * difference, 3)),
            (Some(_), None) => "(…)".to_owned(),
        };
        table.row([line.figure.name.into(), (100.0 * line.share).into(), "%".into(), difference.into()]);
    }
    format!("{text}{table}\n")
}

/// Returns the figures as comma-separated values (RFC 4180). The cell is empty where a figure has no value for a way
/// of counting.
fn csv(about: &FiguresSubject, energies: &[FigureLine], areas: &[FigureLine]) -> String {
    let mut table = String::from("design,view,figure,energy_percent,area_percent");
    if about.other.is_some() {
        table.push_str(",compared_energy_percent,compared_area_percent");
    }
    table.push_str("\r\n");
    let only_areas =
        areas.iter().filter(|line| !energies.iter().any(|other| other.figure.name == line.figure.name));
    for FigureLine { figure, .. } in energies.iter().chain(only_areas) {
        let [energy, area] =
            [energies, areas].map(|lines| lines.iter().find(|line| line.figure.name == figure.name));
        let percent =
            |share: Option<f64>| share.map_or_else(String::new, |share| format!("{:.4}", 100.0 * share));
        let mut cells = vec![quoted(about.design), quoted(about.view), quoted(figure.name)];
        cells.extend([energy, area].map(|line| percent(line.map(|line| line.share))));
        if about.other.is_some() {
            cells.extend([energy, area].map(|line| percent(line.and_then(|line| line.other))));
        }
        table.push_str(&cells.join(","));
        table.push_str("\r\n");
    }
    table
}

/// Returns the figures against tilt as comma-separated values: degrees, then percent of each zone.
pub fn tilts(head: f64, glare: Glare, tilts: &Tilts) -> String {
    let zones = zones(head);
    let heads = zones.iter().map(|(zone, _)| format!("{}_percent", zone.name.to_lowercase()));
    let mut table = format!("tilt_degrees,{}\r\n", heads.collect::<Vec<_>>().join(","));
    for (tilt, figures) in tilts {
        let cells = zones.iter().map(|(_, band)| format!("{:.4}", 100.0 * energy(figures, *band, glare)));
        let _ = write!(table, "{tilt},{}\r\n", cells.collect::<Vec<_>>().join(","));
    }
    table
}

/// Returns a cell of the table, in quotes where it needs them.
fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::panels::figure_lines::{TOTALS, ZONES};
    use brillianteer_base::unwatched;
    use brillianteer_measure::by_beams;
    use brillianteer_scene::{ASET_CONE, Backing, Scope, View};
    use brillianteer_trace::beam;

    fn line(name: &str, share: f64, other: Option<f64>) -> FigureLine {
        let figure = ZONES.iter().chain(&TOTALS).find(|figure| figure.name == name).unwrap();
        FigureLine { figure, share, other, error: 0.0 }
    }

    #[test]
    fn a_table_has_a_cell_for_every_way_of_counting() {
        let about = FiguresSubject { design: "a, \"b\"", view: "face up", state: "final", other: None };
        let (energies, areas) =
            ([line("Red", 0.5, None), line("Glare", 0.01, None)], [line("Red", 0.25, None)]);
        let expected = "design,view,figure,energy_percent,area_percent\r\n\
            \"a, \"\"b\"\"\",face up,Red,50.0000,25.0000\r\n\
            \"a, \"\"b\"\"\",face up,Glare,1.0000,\r\n";
        assert_eq!(csv(&about, &energies, &areas), expected);
    }

    #[test]
    fn tilts_are_a_table_of_the_zones() {
        let document = brillianteer_session::model::document::Document::first().unwrap();
        let specimen = document.specimen();
        let scope = Scope::aset(ASET_CONE, Backing::Black);
        let options = beam::BeamOptions { unresolved: 0.05, ..beam::BeamOptions::default() };
        let (view, medium) = (View::default(), specimen.medium(589.3));
        let stone = specimen.stone().unwrap();
        let beams = beam::trace(&stone.polytope, medium, &view, &options, &unwatched).unwrap();
        let figures = by_beams(&beams, &scope);
        let table = tilts(0.0, Glare::Included, &vec![(-30.0, figures.clone()), (0.0, figures.clone())]);
        let lines: Vec<&str> = table.lines().collect();
        assert_eq!(lines[0], "tilt_degrees,red_percent,green_percent,blue_percent,leakage_percent");
        let numbers: Vec<f64> = lines[1].split(',').map(|cell| cell.parse().unwrap()).collect();
        let red = scope.bands.iter().position(|band| band.name == "red").unwrap();
        assert!(lines.len() == 3 && numbers[0] == -30.0 && numbers.len() == 5);
        assert!(
            (numbers[1] - 100.0 * energy(&figures, red, Glare::Included)).abs() < 1e-4 && numbers[1] > 10.0
        );
    }

    #[test]
    fn a_text_tells_the_difference_from_what_is_compared_with() {
        let about = FiguresSubject { design: "a", view: "face up", state: "energy, final", other: Some("b") };
        let copied = text(&about, &[line("Red", 0.5, Some(0.375))]);
        assert_eq!(
            copied,
            "a: face up; energy, final\nin brackets the difference from b\nRed             50.000 % (+12.500)\n"
        );
    }
}
