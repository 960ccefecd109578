//! The list of a stone's class, estimated after what GIA publishes.

use super::specimen::LoadedSpecimen;
use brillianteer_base::{Failure, Unit};
use brillianteer_cut::ClassEstimate;
use brillianteer_measure::brilliant_proportions;
use brillianteer_paper::table::{Column, Table, TableCell};
use serde::Serialize;

/// The note below every estimate.
const NOTE: &str = "An estimate after the ranges that GIA publishes for single proportions of round brilliants of diamond, and after our own\n\
    fit for crown, pavilion and table together. It is not a grade, and no laboratory has seen the stone. Not judged: culet, the\n\
    girdle's thinnest place, polish, symmetry, painting, total depth and weight ratio, each of which can only lower the class.";

/// Estimates the class of a stone.
///
/// # Errors
/// Fails with [`Failure::Usage`] where the material is not diamond, [`Failure::Input`] where the stone is no round
/// brilliant.
pub fn estimated(specimen: &LoadedSpecimen) -> Result<ClassEstimate, Failure> {
    let material = &specimen.material.name;
    if !material.eq_ignore_ascii_case("diamond") {
        let why = format!(
            "GIA's ranges are for colourless diamond, so nothing is estimated of {material}; --material diamond estimates the \
             class of the same cut in diamond"
        );
        return Err(Failure::Usage(format!("{}: {why}", specimen.path)));
    }
    let stone = specimen.convex_stone("classes are estimated of round brilliants, which are convex")?;
    let proportions =
        brilliant_proportions(stone).map_err(|why| Failure::Input(format!("{}: {why}", specimen.path)))?;
    Ok(ClassEstimate::after_gia(&proportions))
}

/// An estimate, with the note that belongs to every estimate.
#[derive(Serialize)]
pub struct NotedEstimate {
    estimate_after_gia: ClassEstimate,
    /// The nature of the estimate, and the properties that it does not judge.
    note: String,
}

impl NotedEstimate {
    /// Adds the note to an estimate.
    pub fn of(estimate: ClassEstimate) -> Self {
        Self { estimate_after_gia: estimate, note: NOTE.replace('\n', " ") }
    }
}

/// Formats an estimate as tables.
pub fn table_of_estimate(path: &str, estimate: &ClassEstimate) -> String {
    let mut limits = Table::headed([
        Column::left("", 28),
        Column::right("measured", 10).digits(2),
        Column::right("rounded", 10).digits(1),
        Column::right("class", 7),
    ]);
    for limit in &estimate.limits {
        let unit = match limit.unit {
            _ if limit.measured.is_none() => "",
            Unit::Degrees => ", °",
            _ => ", %",
        };
        let number = |value: Option<f64>| value.map_or("".into(), TableCell::Number);
        let (name, class) = (format!("{}{unit}", limit.name), limit.class.to_string());
        limits.row([name.into(), number(limit.measured), number(limit.rounded), class.into()]);
    }
    let mut classes = Table::new([Column::left("", 48), Column::right("", 7)]);
    classes.pair("estimate: the worst of these", estimate.class.to_string());
    for other in &estimate.nearby {
        let name = other.name.to_lowercase();
        let how = format!("with the {name} rounded to {:.1} instead", other.rounded);
        classes.pair(&how, other.class.to_string());
    }
    format!("{path}: estimate after GIA's published ranges, not a grade\n\n{limits}\n\n{classes}\n\n{NOTE}")
}
