//! The tables of families of cuts, such as `[round_brilliant]`, read and written by the rows of each family.

use super::Fault;
use crate::cut::{Cut, FAMILIES, Family, Proportion, Unit};
use serde::de::{DeserializeSeed, Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use toml::Spanned;
use toml::de::DeTable;

/// A family's table in a file: its numbers, in the order of the file.
pub(super) struct FamilyForm {
    pub family: &'static Family,
    given: Vec<(&'static Proportion, f64)>,
}

impl FamilyForm {
    /// Takes the tables of families out of the table of a whole file, and reads them.
    pub fn take_all(file: &mut DeTable<'_>) -> Result<Vec<Self>, Fault> {
        let mut tables = DeTable::new();
        tables.extend(FAMILIES.into_iter().filter_map(|family| file.remove_entry(family.key)));
        let tables = Spanned::new(0..0, tables);
        FamilyTables.deserialize(toml::de::Deserializer::from(tables)).map_err(Fault::form)
    }

    /// Returns the cut that the table describes. Its numbers may be out of range, but for those of counts.
    pub fn cut(&self) -> Result<Cut, Fault> {
        let family = self.family;
        let mut cut = family.first.clone();
        for row in family.proportions {
            let value = match (self.value(row), row.default) {
                (None, Some(value)) => value,
                (Some(value), _) => value,
                (None, None) => {
                    self.check_left_out(row)?;
                    continue;
                }
            };
            let at_fault = |message: String| Fault::at(format!("{}/{}", family.key, row.key), message);
            let other = row.pair.as_ref().and_then(|pair| family.proportion(pair.other));
            if let Some(other) =
                other.filter(|other| is_before(family, other, row) && self.value(other).is_some())
            {
                return Err(at_fault(format!("{}: give {} or {}, not both", row.key, other.key, row.key)));
            }
            if row.unit == Unit::Count {
                row.check_fixed(value).map_err(|error| at_fault(error.to_string()))?;
            }
            row.give.into_iter().for_each(|give| give(&mut cut, value));
        }
        Ok(cut)
    }

    fn value(&self, row: &Proportion) -> Option<f64> {
        self.given.iter().find(|(other, _)| *other == row).map(|(_, value)| *value)
    }

    /// Checks that a proportion which the file leaves out may be left out.
    fn check_left_out(&self, row: &Proportion) -> Result<(), Fault> {
        let (table, key) = (self.family.key, row.key);
        let missing = match &row.pair {
            _ if row.give.is_none() => return Ok(()),
            None => format!("the key `{key}` is missing ({})", row.hint()),
            Some(pair) => match self.family.proportion(pair.other) {
                Some(other) if self.value(other).is_some() => return Ok(()),
                _ => format!("{key} or {} is missing; give one", pair.other),
            },
        };
        Err(Fault::at(table, format!("{table}: {missing}")))
    }
}

fn is_before(family: &Family, row: &Proportion, other: &Proportion) -> bool {
    family.proportions.iter().find(|&found| found == row || found == other) == Some(row)
}

/// Reads a table whose keys are those of families.
struct FamilyTables;

impl<'de> DeserializeSeed<'de> for FamilyTables {
    type Value = Vec<FamilyForm>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Vec<FamilyForm>, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for FamilyTables {
    type Value = Vec<FamilyForm>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table of keys")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Vec<FamilyForm>, A::Error> {
        let mut found = vec![];
        while let Some(key) = map.next_key::<String>()? {
            let family = Family::of_key(&key).ok_or_else(|| A::Error::custom("this is no family"))?;
            found.push(map.next_value_seed(FamilyTable(family))?);
        }
        Ok(found)
    }
}

/// Reads the table of one family.
#[derive(Clone, Copy)]
struct FamilyTable(&'static Family);

impl<'de> DeserializeSeed<'de> for FamilyTable {
    type Value = FamilyForm;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<FamilyForm, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for FamilyTable {
    type Value = FamilyForm;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table of keys")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<FamilyForm, A::Error> {
        let mut given = vec![];
        while let Some(row) = map.next_key_seed(RowKey(self.0))? {
            let value = match row.unit {
                Unit::Count => map.next_value::<i64>()? as f64,
                Unit::Percent | Unit::Degrees => map.next_value()?,
            };
            given.push((row, value));
        }
        Ok(FamilyForm { family: self.0, given })
    }
}

/// Reads a key of a family's table.
struct RowKey(&'static Family);

impl<'de> DeserializeSeed<'de> for RowKey {
    type Value = &'static Proportion;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<&'static Proportion, D::Error> {
        let key = String::deserialize(deserializer)?;
        self.0.proportion(&key).filter(|row| row.give.is_some()).ok_or_else(|| {
            let rows = self.0.proportions.iter().filter(|row| row.give.is_some());
            let known: Vec<String> = rows.map(|row| format!("`{}`", row.key)).collect();
            D::Error::custom(format!("unknown field `{key}`, expected one of {}", known.join(", ")))
        })
    }
}

/// The numbers of a cut, as its family's table is written.
pub(super) struct WrittenFamily<'a>(pub &'a Cut);

impl Serialize for WrittenFamily<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.given().map(|(row, value)| (row.key, WrittenNumber(row.unit, value))))
    }
}

struct WrittenNumber(Unit, f64);

impl Serialize for WrittenNumber {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            Unit::Count => serializer.serialize_i64(self.1 as i64),
            Unit::Percent | Unit::Degrees => serializer.serialize_f64(self.1),
        }
    }
}
