//! The table of proportions: every family of cuts describes its numbers by rows, one for each proportion.
//!
//! The panel, the profile, cut files, `info`, help, errors and warnings read names, keys, units, ranges and meanings from
//! here and nowhere else. The folder `families` says how to add one.

use super::Cut;
use super::family_cut::{MakeNet, TotalDepth};
use brillianteer_base::Unit;
use std::fmt;

/// A family of cuts, shaped by proportions.
pub struct Family {
    /// The key of the family's table in a cut file.
    pub key: &'static str,
    /// The name of the family in the editor.
    pub name: &'static str,
    /// The rows of the table: first the proportions that shape the cut, then those that only follow from them.
    pub proportions: &'static [Proportion],
    /// A usual cut of the family, from which one is read or designed.
    pub first: Cut,
    /// The function that makes the facets of a [`FamilyCut`](super::FamilyCut); `None` for families with a type of their own.
    pub net: Option<MakeNet>,
    /// The function that says how deep a [`FamilyCut`](super::FamilyCut) is; `None` for families with a type of their own.
    pub depth: Option<TotalDepth>,
}

impl Family {
    /// Returns the proportions that shape the cut, without those that only follow from them.
    pub fn editable(&'static self) -> impl Iterator<Item = &'static Proportion> {
        self.proportions.iter().filter(|row| row.give.is_some())
    }

    /// Returns the proportions that can be set: those that shape the cut, and those that move some of them.
    pub fn settable(&'static self) -> impl Iterator<Item = &'static Proportion> {
        self.proportions.iter().filter(|row| row.can_be_set())
    }

    /// Returns the proportion that has this key.
    pub fn proportion(&self, key: &str) -> Option<&'static Proportion> {
        self.proportions.iter().find(|row| row.key == key)
    }
}

/// A row of the table: everything about one proportion of a family.
pub struct Proportion {
    /// The key in cut files and JSON.
    pub key: &'static str,
    /// The name that people read.
    pub name: &'static str,
    /// The unit.
    pub unit: Unit,
    /// The quantity of which the number is a part or from which it is measured, as in "percent of the girdle
    /// diameter".
    pub of: &'static str,
    /// The meaning, in a sentence or two.
    pub meaning: &'static str,
    /// The least and the greatest usual value, between which its slider runs; for a count, the possible range.
    pub usual: [f64; 2],
    /// The step of the slider; 0 for none.
    pub step: f64,
    /// The change for each point by which the number is dragged.
    pub speed: f64,
    /// The lower end of the possible range; `None` where the proportion has none of its own.
    pub least: Option<Bound>,
    /// The upper end of the possible range; `None` where the proportion has none of its own.
    pub most: Option<Bound>,
    /// GIA's range for the grade Excellent of round brilliants of diamond (GIA, 2006), where there is one.
    pub excellent: Option<[f64; 2]>,
    /// The value where a file gives none; `None` where a file must give one.
    pub default: Option<f64>,
    /// The word that stands for a number of 0 or less, where there is one.
    pub nothing: Option<&'static str>,
    /// The parts of the profile that are pulled to change the proportion.
    pub handles: &'static [ProfileHandle],
    /// Returns the value, given or derived; NaN for a cut of another family.
    pub get: fn(&Cut) -> f64,
    /// Gives the value: of a pair, this proportion is the given one afterwards. `None` where it only follows from others.
    pub give: Option<fn(&mut Cut, f64)>,
    /// Returns whether a cut gives this proportion, so that it does not follow from others.
    pub is_given: fn(&Cut) -> bool,
    /// The key of the other proportion of a pair: one of both is given, and the other follows.
    pub pair: Option<&'static str>,
    /// The keys of the given numbers that change when this one, which follows from them, is set: all by the same factor, angles
    /// by that of their tangents. Empty where the number cannot be set, or is given itself.
    pub moves: &'static [&'static str],
}

/// An end of the possible range.
#[derive(Clone, Copy)]
pub struct Bound {
    /// The bound itself.
    pub at: BoundAt,
    /// True where the bound itself is possible.
    pub inclusive: bool,
    /// The event at the bound, as a clause for a message.
    pub reason: &'static str,
}

/// The place of a bound.
#[derive(Clone, Copy)]
pub enum BoundAt {
    /// The same value for all cuts of the family.
    Fixed(f64),
    /// A value that depends on the cut's other proportions.
    Of(fn(&Cut) -> f64),
}

impl Bound {
    /// Makes a bound that is itself possible.
    pub const fn at(at: BoundAt, reason: &'static str) -> Option<Self> {
        Some(Self { at, inclusive: true, reason })
    }

    /// Makes a bound that is itself impossible.
    pub const fn before(at: BoundAt, reason: &'static str) -> Option<Self> {
        Some(Self { at, inclusive: false, reason })
    }
}

/// A part of the profile that is pulled to change one proportion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProfileHandle {
    /// The table's corner, on the right.
    TableEdge,
    /// The middle of the table's line.
    TableLine,
    /// The middle of the right bezel.
    CrownSlope,
    /// The girdle's upper edge, on the left.
    GirdleUpper,
    /// The girdle's lower edge, on the right.
    GirdleLower,
    /// The middle of the right main.
    PavilionSlope,
    /// The culet's right corner, or the tip, pulled up and down.
    PavilionTip,
    /// The culet's right corner, or the tip, pulled left and right.
    CuletEdge,
}

impl ProfileHandle {
    /// The handles, from table to culet.
    pub const ALL: [Self; 8] = [
        Self::TableEdge,
        Self::TableLine,
        Self::CrownSlope,
        Self::GirdleUpper,
        Self::GirdleLower,
        Self::PavilionSlope,
        Self::PavilionTip,
        Self::CuletEdge,
    ];
}

impl fmt::Debug for Proportion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key)
    }
}

/// Rows of one table are equal where their keys are.
impl PartialEq for Proportion {
    fn eq(&self, other: &Self) -> bool {
        self.key == other.key
    }
}

impl Proportion {
    /// A row without a meaning, from which tables make theirs: a number in percent that follows from others.
    pub const BLANK: Self = Self {
        key: "",
        name: "",
        unit: Unit::Percent,
        of: "of the girdle diameter",
        meaning: "",
        usual: [0.0, 100.0],
        step: 0.1,
        speed: 0.02,
        least: None,
        most: None,
        excellent: None,
        default: None,
        nothing: None,
        handles: &[],
        get: |_| f64::NAN,
        give: None,
        is_given: |_| true,
        pair: None,
        moves: &[],
    };

    /// Returns whether the number can be set: by itself, or by moving others.
    pub fn can_be_set(&self) -> bool {
        self.give.is_some() || !self.moves.is_empty()
    }

    /// Returns whether this number changes a given one when it is set: that one, or the other of its pair.
    pub fn does_move(&self, given: &Self) -> bool {
        self.moves.iter().any(|key| *key == given.key || given.pair == Some(key))
    }

    /// Sets the value. Of a pair, the one that is given stays so; a count becomes a possible whole number.
    pub fn set(&self, cut: &mut Cut, value: f64) {
        let held = self.pair.filter(|_| !(self.is_given)(cut)).and_then(|key| cut.proportion(key));
        let value = match self.unit {
            Unit::Count => value.round().max(self.usual[0]).min(self.usual[1]),
            _ => value,
        };
        self.give(cut, value);
        held.into_iter().for_each(|other| other.hold(cut));
    }

    /// Makes this proportion of a pair the given one, with its present value.
    pub fn hold(&self, cut: &mut Cut) {
        let value = (self.get)(cut);
        self.give(cut, value);
    }

    /// Gives the value: of a pair, this proportion is the given one afterwards. A number that only follows from others is
    /// reached by those that it [moves](Self::moves), or else stays as it is.
    pub fn give(&self, cut: &mut Cut, value: f64) {
        match self.give {
            Some(give) => give(cut, value),
            None => self.give_by_moving(cut, value),
        }
    }

    /// Writes a value with its unit, to two decimals; the text is short, however large the number is.
    pub fn written(&self, value: f64) -> String {
        let rounded = (value * 100.0).round() / 100.0 + 0.0;
        if value.abs() < 1e6 {
            format!("{rounded}{}", self.unit)
        } else {
            format!("{value:.1e}{}", self.unit)
        }
    }

    /// Returns the meaning of a file's value: its unit and its reference, or the range of a count.
    pub fn hint(&self) -> String {
        match self.unit {
            Unit::Count => format!("{} to {}", self.usual[0], self.usual[1]),
            Unit::Ratio => self.of.to_owned(),
            unit => format!("{} {}", unit.name(), self.of),
        }
    }
}
