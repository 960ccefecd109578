//! Explains proportions that no stone can have: at the row that was edited, and in that row's terms.

use crate::app::panels::proportions::{PROPORTIONS, Proportion};
use crate::cut::{Limit, ProportionError, RoundBrilliant, Unit};

/// The number of halvings that find a limit: more than a number has digits.
const HALVINGS: u32 = 80;

/// A message about a fault, and the row that shows it.
pub struct RowMessage {
    /// The key of the row.
    pub key: &'static str,
    /// The message.
    pub text: String,
}

/// Explains what is wrong with proportions that make no stone.
///
/// `last` are the proportions of the last stone, `edited` is the key of the row that was edited last.
pub fn explain(
    given: &RoundBrilliant,
    last: &RoundBrilliant,
    edited: Option<&str>,
    fault: &ProportionError,
) -> RowMessage {
    let heals = |p: &&Proportion| (p.get)(given) != (p.get)(last) && makes_stone(given, p, (p.get)(last));
    let row = |key: &str| PROPORTIONS.iter().find(|p| p.key == key);
    let at = edited.and_then(row).filter(heals).or_else(|| row(fault.key()).filter(heals));
    if let Some(proportion) = at.or_else(|| PROPORTIONS.iter().find(heals)) {
        return RowMessage { key: proportion.key, text: in_its_terms(given, last, proportion, fault) };
    }
    // No row alone, when set back, makes a stone.
    let at = edited.and_then(row).or_else(|| row(fault.key())).unwrap_or(&PROPORTIONS[0]);
    RowMessage {
        key: at.key,
        text: format!("{} More than one proportion is out of its limits.", message(fault)),
    }
}

/// Whether the proportions make a stone once one of them is set to `value`.
fn makes_stone(given: &RoundBrilliant, proportion: &Proportion, value: f64) -> bool {
    let mut changed = *given;
    (proportion.set)(&mut changed, value);
    changed.derived().is_ok()
}

fn in_its_terms(
    given: &RoundBrilliant,
    last: &RoundBrilliant,
    proportion: &Proportion,
    fault: &ProportionError,
) -> String {
    let (value, possible) = ((proportion.get)(given), (proportion.get)(last));
    let limit = limit(given, proportion, (possible, value));
    let side = if value > possible { "most" } else { "least" };
    let (name, unit) = (proportion.name, proportion.unit);
    let value = number(value, unit);
    let limit = format!("{limit}{unit}");
    let reason = match fault.limit() {
        Some(Limit { key, limit, unit, reason, .. }) if *key == proportion.key => {
            format!("The limit is {}, {reason}.", number(*limit, *unit))
        }
        _ => message(fault),
    };
    format!(
        "{name}: {value} makes no stone. With the other proportions as they are, it can be at {side} {limit}. {reason}"
    )
}

/// Returns the value nearest to an impossible one that makes a stone, to two decimals; a whole number for counts.
fn limit(given: &RoundBrilliant, proportion: &Proportion, (possible, value): (f64, f64)) -> f64 {
    let far = if value.is_finite() { value } else { 1e9_f64.copysign(value - possible) };
    let (mut inside, mut outside) = (possible, far);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (inside + outside);
        if makes_stone(given, proportion, middle) { inside = middle } else { outside = middle }
    }
    let parts = if proportion.unit == Unit::Count { 1.0 } else { 100.0 };
    let rounded = if far > possible { (inside * parts).floor() } else { (inside * parts).ceil() } / parts;
    // Where the rounded value makes no stone, the exact limit is returned.
    if makes_stone(given, proportion, rounded) { rounded } else { inside }
}

/// Describes a fault in the panel's words.
fn message(fault: &ProportionError) -> String {
    let key = fault.key();
    let name = PROPORTIONS.iter().find(|p| p.key == key).map_or("Total depth", |p| p.name);
    match fault.limit() {
        None => format!("{name}: there is no such number."),
        Some(limit) => {
            let (value, bound) = (number(limit.value, limit.unit), number(limit.limit, limit.unit));
            format!("{name} would be {value}; the limit is {bound}, {}.", limit.reason)
        }
    }
}

/// Writes a number with its unit, to two decimals; the text is short, however large the number is.
fn number(value: f64, unit: Unit) -> String {
    let rounded = (value * 100.0).round() / 100.0;
    if value.abs() < 1e6 { format!("{rounded}{unit}") } else { format!("{value:.1e}{unit}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::TOLKOWSKY;

    /// Returns a brilliant with one proportion set to a value.
    fn with(key: &str, value: f64) -> RoundBrilliant {
        let mut given = TOLKOWSKY;
        (PROPORTIONS.iter().find(|p| p.key == key).unwrap().set)(&mut given, value);
        given
    }

    fn text(given: &RoundBrilliant, edited: &str) -> RowMessage {
        explain(given, &TOLKOWSKY, Some(edited), &given.derived().unwrap_err())
    }

    #[test]
    fn the_row_that_was_edited_says_how_far_it_can_go() {
        let said = text(&with("crown_angle", 89.0), "crown_angle");
        assert_eq!(said.key, "crown_angle");
        assert!(said.text.starts_with("Crown angle: 89° makes no stone."), "{}", said.text);
        assert!(
            said.text.contains("it can be at most 84.") && said.text.contains("Total depth would be 1392.4")
        );
        // The same stone, but with the height as the row that was edited.
        let said = text(&with("crown_angle", 89.0), "crown_height");
        assert!(said.key == "crown_height" && said.text.contains("Crown height: 1346.31 %"), "{}", said.text);
    }

    #[test]
    fn what_is_told_as_the_limit_makes_a_stone_and_the_next_step_does_not() {
        for proportion in PROPORTIONS.iter().filter(|p| p.unit != Unit::Count) {
            for value in [-40.0, 0.0, 96.0, 150.0, 1e7] {
                let given = with(proportion.key, value);
                if given.derived().is_ok() {
                    continue;
                }
                let from = ((proportion.get)(&TOLKOWSKY), (proportion.get)(&given));
                let limit = limit(&given, proportion, from);
                assert!(makes_stone(&given, proportion, limit), "{} {value}: {limit}", proportion.key);
                let next = limit + 0.02_f64.copysign(from.1 - from.0);
                assert!(!makes_stone(&given, proportion, next), "{} {value}: {limit}", proportion.key);
            }
        }
    }

    #[test]
    fn an_innocent_row_that_is_edited_later_is_not_blamed() {
        let mut given = with("crown_angle", 89.0);
        given.table = 55.0;
        assert_eq!(text(&given, "table").key, "crown_angle");
        given.culet = 120.0;
        let said = text(&given, "culet");
        assert!(said.key == "culet" && said.text.contains("More than one"), "{}", said.text);
    }
}
