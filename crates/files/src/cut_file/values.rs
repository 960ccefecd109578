//! The kinds of value in a cut file that serde does not read strictly enough.

use std::fmt;
use std::marker::PhantomData;

use brillianteer_base::Fault;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

/// A value that only a table of keys can give; serde's own structs accept a list of values as well.
#[derive(Serialize)]
#[serde(transparent)]
pub(crate) struct TomlTable<T>(pub T);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for TomlTable<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Keys<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Keys<T> {
            type Value = TomlTable<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a table of keys")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<TomlTable<T>, A::Error> {
                T::deserialize(MapAccessDeserializer::new(map)).map(TomlTable)
            }
        }
        deserializer.deserialize_map(Keys(PhantomData))
    }
}

/// A text, a number, or the list or table that `T` takes.
///
/// Its deserialiser is written by hand, so that an error says what was expected and where, which serde's untagged
/// enums cannot.
#[derive(Serialize)]
#[serde(untagged)]
pub(crate) enum OneOf<T> {
    Text(String),
    Number(f64),
    Rest(T),
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for OneOf<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Forms<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Forms<T> {
            type Value = OneOf<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("another form")
            }

            fn visit_str<E>(self, text: &str) -> Result<OneOf<T>, E> {
                Ok(OneOf::Text(text.to_owned()))
            }

            fn visit_f64<E>(self, number: f64) -> Result<OneOf<T>, E> {
                Ok(OneOf::Number(number))
            }

            fn visit_i64<E>(self, number: i64) -> Result<OneOf<T>, E> {
                Ok(OneOf::Number(number as f64))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<OneOf<T>, A::Error> {
                T::deserialize(MapAccessDeserializer::new(map)).map(OneOf::Rest)
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<OneOf<T>, A::Error> {
                T::deserialize(SeqAccessDeserializer::new(list)).map(OneOf::Rest)
            }
        }
        deserializer.deserialize_any(Forms(PhantomData))
    }
}

/// A list of exactly `N` numbers; serde's own arrays accept more.
#[derive(Clone, Copy, Serialize, Deserialize)]
#[serde(try_from = "Vec<f64>", into = "Vec<f64>")]
pub(crate) struct Numbers<const N: usize>(pub [f64; N]);

impl<const N: usize> TryFrom<Vec<f64>> for Numbers<N> {
    type Error = Fault;

    fn try_from(list: Vec<f64>) -> Result<Self, Fault> {
        let wrong = |list: Vec<f64>| format!("invalid length {}, expected a list of {N} numbers", list.len());
        Ok(Self(list.try_into().map_err(wrong)?))
    }
}

impl<const N: usize> From<Numbers<N>> for Vec<f64> {
    fn from(numbers: Numbers<N>) -> Self {
        numbers.0.to_vec()
    }
}

/// A list of at least one pair of numbers.
#[derive(Clone, Serialize, Deserialize)]
#[serde(try_from = "Vec<Numbers<2>>")]
pub(crate) struct Pairs(pub Vec<(f64, f64)>);

impl TryFrom<Vec<Numbers<2>>> for Pairs {
    type Error = Fault;

    fn try_from(list: Vec<Numbers<2>>) -> Result<Self, Fault> {
        if list.is_empty() {
            return Err("the list is empty, expected at least one pair".into());
        }
        Ok(Self(list.into_iter().map(|pair| pair.0.into()).collect()))
    }
}
