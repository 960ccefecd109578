//! Intervals that certainly hold a number.

use serde::{Deserialize, Serialize};
use std::ops::Add;

/// An interval in which a number certainly lies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// The least possible value.
    pub least: f64,
    /// The greatest possible value.
    pub most: f64,
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
