//! Numbers of a file that are read and written by their rows.

use brillianteer_base::{NumberRow, Unit};
use serde::{Deserialize, Serialize, Serializer};
use std::collections::BTreeMap;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer, Error};

/// The numbers that a table of a file states, with their keys, in the order of their rows.
#[derive(Default)]
pub(super) struct StatedNumbers(Vec<(&'static str, StatedNumber)>);

/// A number as a file states it: whole where it is a count.
#[derive(Serialize)]
#[serde(untagged)]
enum StatedNumber {
    Count(i64),
    Any(f64),
}

impl Serialize for StatedNumbers {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(key, number)| (key, number)))
    }
}

impl StatedNumbers {
    /// Returns the numbers of `rows` that `of` has and that `is_stated`.
    pub fn of<T: 'static>(
        rows: impl Iterator<Item = &'static NumberRow<T>>,
        of: &T,
        is_stated: impl Fn(&NumberRow<T>) -> bool,
    ) -> Self {
        let number = |row: &'static NumberRow<T>| {
            let value = (row.get)(of)?;
            let whole = row.unit == Unit::Count;
            Some((row.key, if whole { StatedNumber::Count(value as i64) } else { StatedNumber::Any(value) }))
        };
        Self(rows.filter(|row| is_stated(row)).filter_map(number).collect())
    }
}

/// Takes numbers out of the table of a whole file, or out of its table of the name `within`, by the keys of their rows.
///
/// # Errors
/// Fails where a value is no number.
pub(super) fn taken<T: 'static>(
    file: &mut DeTable<'_>,
    within: Option<&'static str>,
    rows: impl Iterator<Item = &'static NumberRow<T>>,
) -> Result<BTreeMap<String, f64>, Error> {
    let mut numbers = DeTable::new();
    let Some(name) = within else {
        numbers.extend(rows.filter_map(|row| file.remove_entry(row.key)));
        return BTreeMap::deserialize(Deserializer::from(Spanned::new(0..0, numbers)));
    };
    let Some((key, mut value)) = file.remove_entry(name) else { return Ok(BTreeMap::new()) };
    if let DeValue::Table(table) = value.get_mut() {
        numbers.extend(rows.filter_map(|row| table.remove_entry(row.key)));
    }
    let mut whole = DeTable::new();
    whole.insert(key.clone(), Spanned::new(value.span(), DeValue::Table(numbers)));
    file.insert(key, value);
    let read =
        BTreeMap::<String, BTreeMap<String, f64>>::deserialize(Deserializer::from(Spanned::new(0..0, whole)));
    Ok(read?.remove(name).unwrap_or_default())
}
