//! Intervals that certainly hold a number.

use serde::{Deserialize, Deserializer, Serialize};
use std::ops::Add;

/// An interval in which a number certainly lies. JSON has no infinity: an end without bound is written and read as null.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// The least possible value.
    #[serde(deserialize_with = "unbounded_below")]
    pub least: f64,
    /// The greatest possible value.
    #[serde(deserialize_with = "unbounded_above")]
    pub most: f64,
}

fn unbounded_below<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::<f64>::deserialize(deserializer)?.unwrap_or(f64::NEG_INFINITY))
}

fn unbounded_above<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::<f64>::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
}

impl Interval {
    /// Makes the interval of a number that is too low by at most `open`.
    pub fn from(least: f64, open: f64) -> Self {
        Self { least, most: least + open }
    }

    /// Returns the middle of the interval.
    pub fn middle(self) -> f64 {
        f64::midpoint(self.least, self.most)
    }

    /// Returns the greatest error of the middle.
    pub fn error(self) -> f64 {
        (self.most - self.least) / 2.0
    }
}

impl Add<f64> for Interval {
    type Output = Self;

    fn add(self, more: f64) -> Self {
        Self { least: self.least + more, most: self.most + more }
    }
}
