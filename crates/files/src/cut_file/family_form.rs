//! The tables of families of cuts, such as `[round_brilliant]`, read and written by the rows of each family.

use super::values::TomlTable;
use crate::toml_text::meant;
use brillianteer_base::{Fault, Unit};
use brillianteer_cut::{Cut, FAMILIES, Family, Proportion, ProportionError};
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;
use toml::de::{DeTable, Deserializer, Error};

/// A family's table in a file: its numbers, by their keys.
pub(super) struct FamilyForm {
    pub family: &'static Family,
    given: BTreeMap<String, f64>,
}

impl FamilyForm {
    /// Takes the tables of families out of the table of a whole file, and reads them.
    pub fn take_all(file: &mut DeTable<'_>) -> Result<Vec<Self>, Error> {
        let mut tables = DeTable::new();
        tables.extend(FAMILIES.into_iter().filter_map(|family| file.remove_entry(family.key)));
        let read = BTreeMap::deserialize(Deserializer::from(Spanned::new(0..0, tables)));
        let mut read: BTreeMap<String, TomlTable<BTreeMap<String, f64>>> = read?;
        let form =
            |family: &'static Family| read.remove(family.key).map(|TomlTable(given)| Self { family, given });
        Ok(FAMILIES.into_iter().filter_map(form).collect())
    }

    /// Returns the cut that the table describes. Its numbers may be out of range, except for counts.
    pub fn cut(&self) -> Result<Cut, Fault> {
        self.check_keys()?;
        let mut cut = self.family.first.clone();
        for row in self.family.editable() {
            let (key, table) = (row.key, self.family.key);
            let missing = |what: String| Err(Fault::key(table, format!("{table}: {what}")));
            let twice = |other: &str| {
                let message = format!("{other}: give {key} or {other}, not both");
                Err(Fault::key(format!("{table}/{other}"), message))
            };
            let other = row.pair.unwrap_or_default();
            if let Some((mover, _)) = self.movers().find(|(mover, _)| mover.does_move(row)) {
                if self.given.contains_key(key) {
                    let (mover_key, place) = (mover.key, Self::place_of(mover));
                    let message = if place.contains(' ') {
                        format!(
                            "{mover_key}: it stands in the place of {place}; leave out {key}, or give {place} without {mover_key}"
                        )
                    } else {
                        format!("{mover_key}: give {key} or {mover_key}, not both")
                    };
                    return Err(Fault::key(format!("{table}/{}", mover.key), message));
                }
                continue;
            }
            match (self.given.get(key), self.given.get(other), row.default) {
                (Some(_), Some(_), _) => return twice(other),
                (Some(value), ..) => self.give(&mut cut, row, *value)?,
                (None, None, Some(value)) => self.give(&mut cut, row, value)?,
                (None, Some(_), _) => {}
                _ if row.pair.is_some() => return missing(format!("{key} or {other} is missing; give one")),
                _ => {
                    let instead = self.instead_of(row).map(|text| format!("; {text}")).unwrap_or_default();
                    return missing(format!("the key `{key}` is missing ({}){instead}", row.hint()));
                }
            }
        }
        for (mover, value) in self.movers() {
            let fault = |error: ProportionError| {
                Fault::key(format!("{}/{}", self.family.key, mover.key), error.to_string())
            };
            cut = mover.reached(&cut, value).map_err(fault)?;
        }
        Ok(cut)
    }

    /// Returns the numbers that stand in the file in the place of those that they move.
    fn movers(&self) -> impl Iterator<Item = (&'static Proportion, f64)> + '_ {
        let movers = self.family.settable().filter(|row| !row.moves.is_empty());
        movers.filter_map(|row| Some((row, *self.given.get(row.key)?)))
    }

    /// Returns the keys of the numbers that a number moves, in words.
    fn place_of(mover: &Proportion) -> String {
        mover.moves.join(" and ")
    }

    /// Says what may stand in the file in the place of a number and of those that change with it; `None` where nothing does, or
    /// where the number is the only one.
    fn instead_of(&self, row: &'static Proportion) -> Option<String> {
        let mut settable = self.family.settable().filter(|mover| !mover.moves.is_empty());
        let mover = settable.find(|mover| mover.does_move(row))?;
        let place = Self::place_of(mover);
        place.contains(' ').then(|| format!("give {place}, or {} in their place", mover.key))
    }

    fn give(&self, cut: &mut Cut, row: &'static Proportion, value: f64) -> Result<(), Fault> {
        let (table, key) = (self.family.key, row.key);
        let fault = |message: String| Fault::key(format!("{table}/{key}"), message);
        if row.unit == Unit::Count {
            if value.fract() != 0.0 {
                let hint = row.hint();
                return Err(fault(format!(
                    "{table}.{key}: invalid type: number `{value}`, expected a whole number ({hint})"
                )));
            }
            row.check_fixed(value).map_err(|error| fault(error.to_string()))?;
        }
        row.give(cut, value);
        Ok(())
    }

    fn check_keys(&self) -> Result<(), Fault> {
        let known: Vec<&str> = self.family.settable().map(|row| row.key).collect();
        let Some(key) = self.given.keys().find(|key| !known.contains(&key.as_str())) else { return Ok(()) };
        let (table, list) = (self.family.key, known.join("`, `"));
        let message = format!("{table}: unknown key `{key}`, known here are `{list}`{}", meant(key, &known));
        Err(Fault::key(format!("{table}/{key}"), message))
    }
}

/// Returns the table of a family as a file has it, for a cut of that family.
pub(super) fn written(family: &Family, cut: &Cut) -> String {
    let number = |(row, value): (&Proportion, f64)| {
        let value = match row.unit {
            Unit::Count => toml::Value::from(value as i64),
            _ => toml::Value::from(value),
        };
        format!("{} = {value}\n", row.key)
    };
    format!("\n[{}]\n{}", family.key, cut.given().map(number).collect::<String>())
}
