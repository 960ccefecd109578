//! The report that compares several stones, a column each.

use super::figures::{bounded, designed, is_listed, measured};
use super::stone::ReportedStone;
use super::tilts::{TiltCurves, tilt_plot};
use super::{ReportOrigin, provenance};
use brillianteer_base::Failure;
use brillianteer_math::fixed;
use brillianteer_measure::{Interval, MeasureName, measure_words};
use brillianteer_picture::{FigureRow, Report, ReportCell, ReportFigure, ReportPart, ReportTable, TextFlow};
use brillianteer_scene::DomeLight;
use std::cmp::Ordering;

/// The greatest height of pictures in scopes, as a part of the width of the text.
const PICTURES: f64 = 0.2;
/// The greatest height of drawings, and of plots.
const DRAWINGS: f64 = 0.5;
const PLOTS: f64 = 0.36;

/// Puts the comparison of stones together.
pub(super) fn report(stones: &[ReportedStone], origin: &ReportOrigin) -> Result<Report, Failure> {
    let heading = |text: &str| ReportPart::Heading(text.to_owned());
    let mut parts = pictures(stones);
    parts.push(heading("What the stones are"));
    parts.push(ReportPart::Table(facts(stones)));
    let light = light(stones);
    if !light.rows.is_empty() {
        parts.push(heading("Light, in percent of the face; the best is marked where no interval reaches it"));
        parts.push(ReportPart::Table(light));
        parts.extend(without_measures(stones).map(ReportPart::Text));
    }
    for (name, of) in [
        ("Proportions of the designs", designed as fn(&ReportedStone) -> Vec<[String; 2]>),
        ("Measured on the stones, in percent of diameter or width", measured),
    ] {
        let table = pairs(stones, of);
        if !table.rows.is_empty() {
            parts.extend([heading(name), ReportPart::Table(table)]);
        }
    }
    parts.extend(plots(stones)?);
    parts.extend(drawings(stones));
    let of = |stone: &ReportedStone| [format!("geometry of {}", stone.name()), stone.fingerprint.clone()];
    let names: Vec<&str> = stones.iter().map(ReportedStone::name).collect();
    Ok(Report {
        title: format!("{} cuts compared", stones.len()),
        subtitle: names.join(" · "),
        facts: vec![],
        parts,
        provenance: provenance(stones.iter().map(of).collect(), origin),
        mark: origin.date.clone().unwrap_or_default(),
    })
}

/// Returns a row for each kind of picture, with the stones that have it as columns.
fn pictures(stones: &[ReportedStone]) -> Vec<ReportPart> {
    let mut kinds: Vec<&str> = vec![];
    for picture in stones.iter().flat_map(|stone| &stone.pictures) {
        if !kinds.contains(&picture.name) {
            kinds.push(picture.name);
        }
    }
    let row = |kind: &str| {
        let of = |stone: &ReportedStone| {
            let picture = stone.pictures.iter().find(|picture| picture.name == kind)?;
            let caption = format!("{}: {kind}", stone.name());
            Some(ReportFigure { caption, drawing: picture.drawing.clone() })
        };
        let figures = stones.iter().filter_map(of).collect();
        ReportPart::Figures(FigureRow { figures, most_height: PICTURES })
    };
    kinds.into_iter().map(row).collect()
}

/// Returns a table with a column of numbers for each stone.
fn columns(stones: &[ReportedStone]) -> ReportTable {
    let heads = stones.iter().map(|stone| (stone.name(), TextFlow::Numbers));
    ReportTable::new(&std::iter::once(("", TextFlow::Words)).chain(heads).collect::<Vec<_>>())
}

fn facts(stones: &[ReportedStone]) -> ReportTable {
    pairs(stones, |stone| stone.facts())
}

/// Returns the values of all stones by name, in the order in which the names first occur.
fn pairs(stones: &[ReportedStone], of: fn(&ReportedStone) -> Vec<[String; 2]>) -> ReportTable {
    let all: Vec<Vec<[String; 2]>> = stones.iter().map(of).collect();
    let mut names: Vec<&String> = vec![];
    for [name, _] in all.iter().flatten() {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let mut table = columns(stones);
    for name in names {
        let value = |pairs: &Vec<[String; 2]>| {
            let found = pairs.iter().find(|[known, _]| known == name);
            found.map_or("–".to_owned(), |[_, value]| value.clone()).into()
        };
        table.rows.push(std::iter::once(name.as_str().into()).chain(all.iter().map(value)).collect());
    }
    table
}

/// Describes which stones have no measures, and why; `None` where all have some.
fn without_measures(stones: &[ReportedStone]) -> Option<String> {
    let names: Vec<&str> =
        stones.iter().filter(|stone| stone.measures().is_empty()).map(ReportedStone::name).collect();
    (!names.is_empty()).then(|| {
        let (names, have) = (names.join(", "), if names.len() == 1 { "has" } else { "have" });
        format!(
            "{names} {have} no such measures, which are of exact beams in convex stones between planes. A report on one such stone \
             alone gives its zones by single rays."
        )
    })
}

/// Returns the measures of all stones; stones whose light was sampled have none.
fn light(stones: &[ReportedStone]) -> ReportTable {
    let mut table = columns(stones);
    let names = stones.iter().map(ReportedStone::measures).max_by_key(Vec::len).unwrap_or_default();
    for name in names.into_iter().filter(|name| is_listed(*name)) {
        let found: Vec<Option<Interval>> = stones.iter().map(|stone| stone.interval(name)).collect();
        let best = name.better().and_then(|better| best(&found, better));
        let cell = |(k, found): (usize, &Option<Interval>)| {
            let text = found.map_or("–".to_owned(), |found| bounded(found).join(" ").trim_end().to_owned());
            ReportCell { text, is_marked: best == Some(k) }
        };
        let values = found.iter().enumerate().map(cell);
        table.rows.push(std::iter::once(measure_words::name(name).into()).chain(values).collect());
    }
    table
}

/// Returns the place of the best interval where it overlaps no other and its advantage shows at two decimals.
fn best(found: &[Option<Interval>], better: Ordering) -> Option<usize> {
    let known: Vec<(usize, Interval)> =
        found.iter().enumerate().filter_map(|(k, found)| Some((k, (*found)?))).collect();
    let is_beyond = |a: Interval, b: Interval| match better {
        Ordering::Less => a.most < b.least,
        _ => a.least > b.most,
    };
    let shown = |of: Interval| fixed(100.0 * of.middle(), 2);
    let is_best = |&&(k, a): &&(usize, Interval)| {
        let mut others = known.iter().filter(|(other, _)| *other != k);
        others.all(|&(_, b)| is_beyond(a, b) && shown(a) != shown(b))
    };
    (known.len() > 1).then(|| known.iter().find(is_best).map(|(k, _)| *k)).flatten()
}

/// Draws a few measures against tilt, all stones in one plot.
fn plots(stones: &[ReportedStone]) -> Result<Vec<ReportPart>, Failure> {
    let mut parts = vec![];
    for (measure, title) in [
        (MeasureName::Return(DomeLight::of(1.0)), "Return of light by cosine, in percent"),
        (MeasureName::Leakage, "Leakage, in percent of the face"),
        (MeasureName::Fire, "Fire, in percent of the face"),
    ] {
        let wanted: Vec<(&TiltCurves, MeasureName, String)> = stones
            .iter()
            .filter_map(|stone| Some((stone.tilts.as_ref()?, measure, stone.name().to_owned())))
            .collect();
        if let Some(drawing) = tilt_plot("", &wanted)? {
            if parts.is_empty() {
                let text = "Light against tilt; the width of a curve is its bound";
                parts.push(ReportPart::Heading(text.to_owned()));
            }
            let figures = vec![ReportFigure { caption: title.to_owned(), drawing }];
            parts.push(ReportPart::Figures(FigureRow { figures, most_height: PLOTS }));
        }
    }
    Ok(parts)
}

/// Returns profile and facet diagram of each stone, a row each.
fn drawings(stones: &[ReportedStone]) -> Vec<ReportPart> {
    let row = |stone: &ReportedStone| {
        let figure = |of: &super::pictures::NamedDrawing| ReportFigure {
            caption: format!("{}: {}", stone.name(), of.name),
            drawing: of.drawing.clone(),
        };
        let figures = stone.drawings.iter().map(figure).collect();
        ReportPart::Figures(FigureRow { figures, most_height: DRAWINGS })
    };
    let rows: Vec<ReportPart> = stones.iter().filter(|stone| !stone.drawings.is_empty()).map(row).collect();
    let heading = (!rows.is_empty()).then(|| ReportPart::Heading("Profiles and facet diagrams".to_owned()));
    heading.into_iter().chain(rows).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_is_marked_only_where_its_interval_meets_no_other() {
        let of = |least: f64, most: f64| Some(Interval { least, most });
        let (high, middle, low) = (of(0.8, 0.81), of(0.7, 0.75), of(0.5, 0.6));
        assert_eq!(best(&[middle, high, low], Ordering::Greater), Some(1));
        assert_eq!(best(&[middle, high, low], Ordering::Less), Some(2));
        assert_eq!(best(&[middle, of(0.74, 0.81), low], Ordering::Greater), None);
        assert_eq!(best(&[middle, None, low], Ordering::Greater), Some(0));
        assert_eq!(best(&[None, high], Ordering::Greater), None, "one stone is not compared");
        assert_eq!(best(&[of(0.5, 0.5), of(0.500_001, 0.500_001)], Ordering::Greater), None);
    }
}
