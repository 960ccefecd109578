//! The list of a stone's class, estimated after what GIA publishes.

use super::specimen::LoadedSpecimen;
use brillianteer_base::Failure;
use brillianteer_base::Unit;
use brillianteer_cut::ClassEstimate;
use brillianteer_math::fixed;
use brillianteer_measure::brilliant_proportions;
use serde_json::{Value, json};
use std::fmt::Write;

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

/// Returns an estimate as docs/formats.md describes it.
pub fn estimate_json(path: &str, estimate: &ClassEstimate) -> Value {
    json!({ "file": path, "estimate_after_gia": estimate, "note": NOTE.replace('\n', " ") })
}

/// Formats an estimate as a table.
pub fn table_of_estimate(path: &str, estimate: &ClassEstimate) -> String {
    let mut text = format!(
        "{path}: estimate after GIA's published ranges, not a grade\n\n{:<28}{:>10}{:>10}{:>7}\n",
        "", "measured", "rounded", "class"
    );
    for limit in &estimate.limits {
        let unit = match limit.unit {
            _ if limit.measured.is_none() => "",
            Unit::Degrees => ", °",
            _ => ", %",
        };
        let name = format!("{}{unit}", limit.name);
        let shown =
            |value: Option<f64>, digits: usize| value.map_or_else(String::new, |value| fixed(value, digits));
        let (measured, rounded) = (shown(limit.measured, 2), shown(limit.rounded, 1));
        let _ = writeln!(text, "{name:<28}{measured:>10}{rounded:>10}{:>7}", limit.class);
    }
    let _ = writeln!(text, "\n{:<48}{:>7}", "estimate: the worst of these", estimate.class);
    for other in &estimate.nearby {
        let name = other.name.to_lowercase();
        let _ = writeln!(
            text,
            "{:<48}{:>7}",
            format!("with the {name} rounded to {:.1} instead", other.rounded),
            other.class
        );
    }
    text + "\n" + NOTE
}
