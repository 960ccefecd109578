//! Explains proportions that no stone can have: at the row that was edited, in that row's terms and by the panel's names.

use crate::value_grid::ValueGrid;
use brillianteer_base::Unit;
use brillianteer_cut::{Cut, DesignError, Limit, Proportion, ProportionError};
use brillianteer_scene::SpecimenError;

/// A message about a fault, and the row that shows it.
pub struct RowMessage {
    /// The row that shows the message.
    pub row: &'static Proportion,
    /// The message.
    pub text: String,
}

/// Describes why a design makes no stone, with the names that the panel shows.
pub fn by_name(fault: &SpecimenError) -> String {
    match fault {
        SpecimenError::Design(DesignError::Proportion(fault)) => fault.by_name(),
        other => other.to_string(),
    }
}

/// Explains which proportion is wrong where a cut makes no stone.
///
/// `last` is the last possible cut of the same family, `edited` is the key of the row that was edited last.
pub fn explain(given: &Cut, last: &Cut, edited: Option<&str>, fault: &ProportionError) -> RowMessage {
    let heals = |row: &&'static Proportion| {
        row.can_be_set() && (row.get)(given) != (row.get)(last) && makes_stone(given, row, (row.get)(last))
    };
    let edited = edited.and_then(|key| given.proportion(key));
    let at = edited.filter(heals).or_else(|| Some(fault.row()).filter(heals));
    if let Some(row) = at.or_else(|| given.proportions().iter().find(heals)) {
        return RowMessage { row, text: in_its_terms(given, last, row, fault) };
    }
    // No single row makes a stone when it alone is set back.
    let text = format!("{} More than one proportion is outside its limits.", message(fault));
    RowMessage { row: edited.unwrap_or(fault.row()), text }
}

/// Returns whether the proportions make a stone once one of them is set to `value`.
fn makes_stone(given: &Cut, row: &Proportion, value: f64) -> bool {
    let mut changed = given.clone();
    row.set(&mut changed, value);
    changed.check().is_ok()
}

fn in_its_terms(given: &Cut, last: &Cut, row: &'static Proportion, fault: &ProportionError) -> String {
    let (value, possible) = ((row.get)(given), (row.get)(last));
    let limit = limit(given, row, (possible, value));
    let side = if value > possible { "most" } else { "least" };
    let [value, limit] = [value, limit].map(|value| row.written(value));
    let reason = match fault.limit() {
        Some(crossed) if crossed.row == row => {
            format!("The limit is {}, {}.", row.written(crossed.limit), crossed.clause())
        }
        _ => message(fault),
    };
    format!(
        "{}: {value} is impossible. With the other proportions as they are, it can be at {side} {limit}. {reason}",
        row.name
    )
}

/// Returns the value nearest to an impossible one that makes a stone, to two decimals; a whole number for counts.
fn limit(given: &Cut, row: &Proportion, (possible, value): (f64, f64)) -> f64 {
    let grid = if row.unit == Unit::Count { ValueGrid::WHOLE } else { ValueGrid::FINE };
    let mut from = given.clone();
    row.set(&mut from, possible);
    (row.get)(&grid.toward(row, &from, value))
}

/// Describes a fault in the panel's words.
fn message(fault: &ProportionError) -> String {
    let row = fault.row();
    match fault.limit() {
        None => format!("{}: this is not a finite number.", row.name),
        Some(crossed @ Limit { value, limit, .. }) => {
            let [value, bound] = [*value, *limit].map(|value| row.written(value));
            format!("{} would be {value}; the limit is {bound}, {}.", row.name, crossed.clause())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_cut::{FAMILIES, Family};

    fn brilliant() -> &'static Family {
        Family::of_key("round_brilliant").unwrap()
    }

    /// Returns the first cut of a family with one proportion set to a value.
    fn with(family: &Family, key: &str, value: f64) -> Cut {
        let mut given = family.first.clone();
        family.proportion(key).unwrap().set(&mut given, value);
        given
    }

    fn text(given: &Cut, edited: &str) -> RowMessage {
        explain(given, &brilliant().first, Some(edited), &given.check().unwrap_err())
    }

    #[test]
    fn the_row_that_was_edited_says_how_far_it_can_go() {
        let given = with(brilliant(), "crown_angle", 89.0);
        let said = text(&given, "crown_angle");
        assert_eq!(said.row.key, "crown_angle");
        assert!(said.text.starts_with("Crown angle: 89° is impossible."), "{}", said.text);
        assert!(
            said.text.contains("it can be at most 84.")
                && said.text.contains("The limit is 84.71°, above which the total depth is more than 300 %"),
            "{}",
            said.text
        );
        // The same stone, but with the height as the row that was edited.
        let said = text(&given, "crown_height");
        assert!(
            said.row.key == "crown_height" && said.text.contains("Crown height: 1346.31 %"),
            "{}",
            said.text
        );
    }

    #[test]
    fn what_is_told_as_the_limit_makes_a_stone_and_the_next_step_does_not() {
        let mut checked = 0;
        for family in FAMILIES {
            for row in family.settable().filter(|row| row.unit != Unit::Count) {
                for value in [-40.0, 0.0, 96.0, 150.0, 1e7] {
                    let given = with(family, row.key, value);
                    if given.check().is_ok() {
                        continue;
                    }
                    let from = ((row.get)(&family.first), (row.get)(&given));
                    let limit = limit(&given, row, from);
                    assert!(makes_stone(&given, row, limit), "{row:?} {value}: {limit}");
                    let next = limit + 0.02_f64.copysign(from.1 - from.0);
                    assert!(!makes_stone(&given, row, next), "{row:?} {value}: {limit}");
                    checked += 1;
                }
            }
        }
        assert!(checked > 40, "{checked}");
    }

    #[test]
    fn messages_call_a_proportion_as_the_panel_does() {
        for family in FAMILIES {
            for row in family.settable() {
                let given = with(family, row.key, f64::NAN);
                let Err(fault) = given.check() else { continue };
                let (on_panel, in_files) = (fault.by_name(), fault.to_string());
                assert!(on_panel.starts_with(&format!("{}: ", fault.row().name)), "{on_panel}");
                assert!(in_files.starts_with(&format!("{}: ", fault.row().key)), "{in_files}");
                assert!(!explain(&given, &family.first, Some(row.key), &fault).text.contains('_'));
            }
        }
    }

    #[test]
    fn an_innocent_row_that_is_edited_later_is_not_blamed() {
        let [table, culet] = ["table", "culet"].map(|key| brilliant().proportion(key).unwrap());
        let mut given = with(brilliant(), "crown_angle", 89.0);
        table.set(&mut given, 55.0);
        assert_eq!(text(&given, "table").row.key, "crown_angle");
        culet.set(&mut given, 120.0);
        let said = text(&given, "culet");
        assert!(said.row.key == "culet" && said.text.contains("More than one"), "{}", said.text);
        // Of two that are too steep, the one that makes the stone deepest.
        let mut deep = with(brilliant(), "crown_angle", 89.0);
        brilliant().proportion("pavilion_angle").unwrap().set(&mut deep, 89.0);
        let fault = deep.check().unwrap_err();
        assert_eq!(explain(&deep, &brilliant().first, None, &fault).row.key, "pavilion_angle");
    }
}
