//! `families`: lists the families of cuts, or prints the numbers of one with their ranges.

use super::console::{print, print_json};
use brillianteer_base::{Failure, Unit, nearest};
use brillianteer_cut::{Bound, BoundAt, FAMILIES, Family, Proportion};
use brillianteer_files::cut_file;
use brillianteer_files::library::CUTS;
use brillianteer_paper::table::{Column, Table};
use clap::Args;
use serde::Serialize;
use std::fmt::Write;

#[derive(Debug, Args)]
pub struct Families {
    /// Print the numbers of this family: key, unit, range, meaning
    key: Option<String>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Families {
    pub fn run(&self) -> Result<(), Failure> {
        match &self.key {
            None => self.all(),
            Some(key) => {
                let family = Family::of_key(&key.replace('-', "_")).ok_or_else(|| unknown(key))?;
                if self.json { print_json(&FamilyNumbers::of(family)) } else { print(&page(family)) }
            }
        }
    }

    fn all(&self) -> Result<(), Failure> {
        let mut rows = vec![];
        for family in FAMILIES {
            rows.push((family, cuts(family)?));
        }
        if self.json {
            let entry =
                |(family, cuts): (&Family, _)| FamilyCuts { key: family.key, name: family.name, cuts };
            return print_json(&rows.into_iter().map(entry).collect::<Vec<_>>());
        }
        let mut table = Table::new([Column::left("", 18), Column::left("", 20), Column::text("")]);
        for (family, cuts) in rows {
            table.row([family.key.into(), family.name.into(), cuts.join(", ").into()]);
        }
        print(&table.to_string())
    }
}

fn unknown(key: &str) -> Failure {
    let known = FAMILIES.map(|family| family.key);
    let meant = nearest(key, &known).map_or(";".to_owned(), |name| format!("; did you mean '{name}'?"));
    Failure::Usage(format!("no family '{key}'{meant} known: {}", known.join(", ")))
}

/// Returns the names of a family's cuts that come with the program.
fn cuts(family: &Family) -> Result<Vec<&'static str>, Failure> {
    let mut names = vec![];
    for (name, text) in CUTS {
        if cut_file::parse(text, name)?.cut.family().is_some_and(|own| own.key == family.key) {
            names.push(name);
        }
    }
    Ok(names)
}

/// Returns a family's numbers as text.
fn page(family: &'static Family) -> String {
    let mut text = format!("{}, [{}] in cut files", family.name, family.key);
    for row in family.proportions {
        let [least, most] = row.usual;
        let _ = write!(text, "\n\n{} ({})\n    {}", row.key, unit(row), row.meaning);
        if !row.can_be_set() {
            text.push_str("\n    follows from the others");
            continue;
        }
        let source = family.range_source(row).map_or(String::new(), |source| format!(" ({source})"));
        let _ = write!(text, "\n    usual: {least} to {most}{source}\n    possible: {}", possible(row));
        let _ = write!(text, "\n    first cut: {}", value(family, row));
        let beside = match (row.default, row.pair) {
            (Some(default), _) => format!("; without the key: {default}"),
            _ if !row.moves.is_empty() => format!("; may stand in the place of {}", row.moves.join(", ")),
            (None, Some(other)) => format!("; or {other}"),
            (None, None) => String::new(),
        };
        text += &beside;
    }
    text
}

/// A family, and the names of its cuts that come with the program.
#[derive(Serialize)]
struct FamilyCuts {
    key: &'static str,
    name: &'static str,
    cuts: Vec<&'static str>,
}

/// A family, and its numbers.
#[derive(Serialize)]
struct FamilyNumbers {
    key: &'static str,
    name: &'static str,
    numbers: Vec<FamilyNumber>,
}

/// A number of a family. Bounds that depend on other numbers have a reason and no value.
#[derive(Serialize)]
struct FamilyNumber {
    key: &'static str,
    name: &'static str,
    unit: String,
    meaning: &'static str,
    can_be_set: bool,
    /// The usual range.
    usual: [f64; 2],
    /// The source of the usual range, where one is known.
    source: Option<&'static str>,
    least: Option<f64>,
    /// False where the number must be greater than `least`.
    least_inclusive: Option<bool>,
    least_reason: Option<&'static str>,
    most: Option<f64>,
    /// False where the number must be less than `most`.
    most_inclusive: Option<bool>,
    most_reason: Option<&'static str>,
    /// The value in the cut with which the family begins.
    first: f64,
    default: Option<f64>,
    /// The keys of the numbers in whose place a file may state this one.
    in_the_place_of: Vec<&'static str>,
}

impl FamilyNumbers {
    fn of(family: &'static Family) -> Self {
        let number = |row: &'static Proportion| FamilyNumber {
            key: row.key,
            name: row.name,
            unit: unit(row),
            meaning: row.meaning,
            can_be_set: row.can_be_set(),
            usual: row.usual,
            source: family.range_source(row),
            least: fixed(row.least),
            least_inclusive: row.least.map(|bound| bound.inclusive),
            least_reason: row.least.map(|bound| bound.reason),
            most: fixed(row.most),
            most_inclusive: row.most.map(|bound| bound.inclusive),
            most_reason: row.most.map(|bound| bound.reason),
            first: value(family, row),
            default: row.default,
            in_the_place_of: row.pair.as_slice().iter().chain(row.moves).copied().collect(),
        };
        Self { key: family.key, name: family.name, numbers: family.proportions.iter().map(number).collect() }
    }
}

/// Returns the value of a bound that depends on no other number.
fn fixed(bound: Option<Bound>) -> Option<f64> {
    match bound?.at {
        BoundAt::Fixed(at) => Some(at),
        _ => None,
    }
}

/// Returns the value of the family's first cut. Derived numbers have more digits than a reader needs.
fn value(family: &Family, row: &Proportion) -> f64 {
    rounded((row.get)(&family.first))
}

fn unit(row: &Proportion) -> String {
    match row.unit {
        Unit::Count => "whole number".to_owned(),
        _ => row.hint(),
    }
}

/// Returns the possible range in words.
fn possible(row: &Proportion) -> String {
    let ends = [end(["from", "above"], row.least), end(["to", "below"], row.most)];
    let ends: Vec<String> = ends.into_iter().flatten().collect();
    if ends.is_empty() { "as the other numbers allow".to_owned() } else { ends.join(", ") }
}

/// Returns a number with the digits that a reader needs.
fn rounded(number: f64) -> f64 {
    (1e4 * number).round() / 1e4
}

/// Returns a bound with the reason for it; `words` name one that is itself possible, and one that is not.
fn end(words: [&str; 2], bound: Option<Bound>) -> Option<String> {
    let Bound { at, inclusive, reason } = bound?;
    let word = if inclusive { words[0] } else { words[1] };
    Some(match at {
        BoundAt::Fixed(at) => format!("{word} {} ({reason})", rounded(at)),
        BoundAt::Of(_) => format!("{word} a limit that depends on other keys ({reason})"),
    })
}
