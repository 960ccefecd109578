//! `material`: a name, an index, or a table of the file's own.

use std::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::Fault;
use super::form::Numbers;
use crate::cut::{Absorption, Dispersion, MaterialRef, MaterialTable};

/// `material = "diamond"`, `material = 2.42` or `[material]`.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum MaterialForm {
    Name(String),
    Index(f64),
    Table(Box<TableForm>),
}

/// `[material]`
#[derive(Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(super) struct TableForm {
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    index: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sellmeier: Option<Vec<Numbers<2>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cauchy: Option<Numbers<2>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    abbe: Option<Numbers<2>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    absorption: Option<AbsorptionForm>,
}

/// `absorption = 0.1` or `absorption = [[400, 0.2], [700, 0.1]]`.
#[derive(Serialize)]
#[serde(untagged)]
enum AbsorptionForm {
    Uniform(f64),
    Spectrum(Vec<Numbers<2>>),
}

impl MaterialForm {
    /// The form that a material is written in.
    pub fn of(material: &MaterialRef) -> Self {
        match material {
            MaterialRef::Name(name) => Self::Name(name.clone()),
            MaterialRef::Index(index) => Self::Index(*index),
            MaterialRef::Custom(table) => Self::Table(Box::new(TableForm::of(table))),
        }
    }

    /// The material that the form describes; its numbers are yet to be checked.
    pub fn material(self) -> Result<MaterialRef, Fault> {
        match self {
            Self::Name(name) => Ok(MaterialRef::Name(name)),
            Self::Index(index) => Ok(MaterialRef::Index(index)),
            Self::Table(form) => form.material().map(MaterialRef::Custom),
        }
    }
}

impl TableForm {
    fn of(table: &MaterialTable) -> Self {
        let mut form = Self { name: table.name.clone(), ..Self::default() };
        match &table.dispersion {
            Dispersion::Index(index) => form.index = Some(*index),
            Dispersion::Sellmeier(pairs) => form.sellmeier = Some(numbers(pairs)),
            Dispersion::Cauchy(pair) => form.cauchy = Some(Numbers(*pair)),
            Dispersion::Abbe(pair) => form.abbe = Some(Numbers(*pair)),
        }
        form.absorption = table.absorption.as_ref().map(|absorption| match absorption {
            Absorption::Uniform(per_mm) => AbsorptionForm::Uniform(*per_mm),
            Absorption::Spectrum(pairs) => AbsorptionForm::Spectrum(numbers(pairs)),
        });
        form
    }

    fn material(self) -> Result<MaterialTable, Fault> {
        let given = [
            self.index.map(|index| ("index", Dispersion::Index(index))),
            self.sellmeier.map(|list| ("sellmeier", Dispersion::Sellmeier(pairs(list)))),
            self.cauchy.map(|pair| ("cauchy", Dispersion::Cauchy(pair.0))),
            self.abbe.map(|pair| ("abbe", Dispersion::Abbe(pair.0))),
        ];
        let mut given = given.into_iter().flatten();
        let Some((first, dispersion)) = given.next() else {
            return Err(Fault::at("material", "material: one of index, sellmeier, cauchy or abbe is missing"));
        };
        if let Some((second, _)) = given.next() {
            return Err(Fault::at(
                format!("material/{second}"),
                format!("material.{second}: give {first} or {second}, not both"),
            ));
        }
        let absorption = self.absorption.map(|form| match form {
            AbsorptionForm::Uniform(per_mm) => Absorption::Uniform(per_mm),
            AbsorptionForm::Spectrum(list) => Absorption::Spectrum(pairs(list)),
        });
        Ok(MaterialTable { name: self.name, dispersion, absorption })
    }
}

fn numbers(pairs: &[[f64; 2]]) -> Vec<Numbers<2>> {
    pairs.iter().map(|pair| Numbers(*pair)).collect()
}

fn pairs(list: Vec<Numbers<2>>) -> Vec<[f64; 2]> {
    list.into_iter().map(|pair| pair.0).collect()
}

/// By hand, for an error that says what was expected and where, which serde's untagged enums cannot.
impl<'de> Deserialize<'de> for MaterialForm {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Form;
        impl<'de> Visitor<'de> for Form {
            type Value = MaterialForm;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("text, a number or a table")
            }

            fn visit_str<E>(self, name: &str) -> Result<MaterialForm, E> {
                Ok(MaterialForm::Name(name.to_owned()))
            }

            fn visit_f64<E>(self, index: f64) -> Result<MaterialForm, E> {
                Ok(MaterialForm::Index(index))
            }

            fn visit_i64<E>(self, index: i64) -> Result<MaterialForm, E> {
                Ok(MaterialForm::Index(index as f64))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MaterialForm, A::Error> {
                let table = TableForm::deserialize(MapAccessDeserializer::new(map))?;
                Ok(MaterialForm::Table(Box::new(table)))
            }
        }
        deserializer.deserialize_any(Form)
    }
}

/// By hand for the same reason.
impl<'de> Deserialize<'de> for AbsorptionForm {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Form;
        impl<'de> Visitor<'de> for Form {
            type Value = AbsorptionForm;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number per mm or a list of [nm, per mm]")
            }

            fn visit_f64<E>(self, per_mm: f64) -> Result<AbsorptionForm, E> {
                Ok(AbsorptionForm::Uniform(per_mm))
            }

            fn visit_i64<E>(self, per_mm: i64) -> Result<AbsorptionForm, E> {
                Ok(AbsorptionForm::Uniform(per_mm as f64))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<AbsorptionForm, A::Error> {
                let mut pairs = Vec::new();
                while let Some(pair) = list.next_element()? {
                    pairs.push(pair);
                }
                Ok(AbsorptionForm::Spectrum(pairs))
            }
        }
        deserializer.deserialize_any(Form)
    }
}
