//! The appraisal of a design by a goal, and the reasons why there is none.

use super::goal::{GoalFault, GoalMaterial};
use brillianteer_math::rounded;
use brillianteer_measure::{Interval, MeasureName};
use brillianteer_render::SweepError;
use brillianteer_scene::SpecimenError;

/// The reason why a design cannot be appraised, or a search cannot begin.
#[derive(Debug, thiserror::Error)]
pub enum SearchError {
    /// The goal is at fault.
    #[error(transparent)]
    Goal(#[from] GoalFault),
    /// The design has no numbers to change.
    #[error(
        "the design has no numbers to vary: it is a mesh, or each number breaks a meet when it changes alone; of tiers or a list of \
         planes vary crown_scale or pavilion_scale, which moves all facets of a side together"
    )]
    NoNumbers,
    /// A key that is no number of the design.
    #[error(
        "vary: {0} is no number of a design; give the key of a proportion, tier: or distance: and the name of a tier, crown_scale or \
         pavilion_scale"
    )]
    NotOfDesign(String),
    /// The design from before the search lies outside a range.
    #[error(
        "vary: {key}: the design has {}, which is not from {} to {}; widen the range",
        rounded(*.start, 6),
        rounded(*.least, 6),
        rounded(*.most, 6)
    )]
    StartOutside {
        /// The number.
        key: String,
        /// Its value in the design.
        start: f64,
        /// The least value of the range.
        least: f64,
        /// The greatest value of the range.
        most: f64,
    },
    /// A measure that the design does not have, such as a fish eye without a table.
    #[error("measure: the design has no {0}; leave it out of the goal")]
    NotMeasured(String),
    /// A limit of a figure that the design does not have.
    #[error("limit: {name}: there is no such figure; the design has {known}")]
    NoLimit {
        /// The given name.
        name: String,
        /// The known names, in words.
        known: String,
    },
    /// The design makes no stone.
    #[error(transparent)]
    Specimen(#[from] SpecimenError),
    /// The design makes no convex stone between planes, for the given reason.
    #[error(
        "a search follows the light of convex stones between planes exactly, and {0}; change the numbers in the cut file, and \
         compare the designs by `measure`"
    )]
    NotConvex(String),
    /// The design cannot be set or measured.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// Facets vanish, or the girdle gets other facets.
    #[error("the stone no longer has all its facets")]
    Vanished,
    /// Facets that met in a point no longer do.
    #[error("the facets {0} no longer meet in a point")]
    Broken(String),
    /// The caller's watch has stopped the work.
    #[error("stopped")]
    Stopped,
}

impl SearchError {
    /// Returns whether the design is at fault, whatever the goal.
    pub fn is_of_design(&self) -> bool {
        match self {
            Self::NotConvex(_) | Self::Specimen(_) => true,
            Self::Sweep(error) => error.is_of_design(),
            _ => false,
        }
    }
}

/// A measure of a goal in one material and view.
#[derive(Debug, Clone, PartialEq)]
pub struct GoalValue {
    /// The measure.
    pub of: MeasureName,
    /// The material; `None` for the design's own.
    pub material: Option<GoalMaterial>,
    /// The tilt, degrees.
    pub tilt_deg: f64,
    /// The azimuth of the tilt, degrees.
    pub azimuth_deg: f64,
    /// The share of the measure's weight that the value has.
    pub weight: f64,
    /// The value.
    pub value: Interval,
}

/// The measures of a design by a goal, and their weighted sum.
#[derive(Debug, Clone, PartialEq)]
pub struct Appraisal {
    /// The sum of the weighted measures.
    pub total: Interval,
    /// The measures.
    pub values: Vec<GoalValue>,
    /// The name of each limit on the geometry, and its figure.
    pub figures: Vec<(String, f64)>,
    /// The margin by which each limit is kept; below 0 where it is not.
    pub(super) slacks: Vec<f64>,
    /// The changes of the total and of each slack over the whole range of each number.
    pub(super) slopes: Option<Slopes>,
}

/// A limit counts as kept where it is missed by no more than this.
const KEPT: f64 = 1e-9;

impl Appraisal {
    /// Returns whether the design keeps all limits of the goal.
    pub fn keeps_limits(&self) -> bool {
        self.slacks.iter().all(|slack| *slack >= -KEPT)
    }
}

/// The changes of an appraisal over the whole range of each number.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Slopes {
    pub total: Vec<f64>,
    pub slacks: Vec<Vec<f64>>,
}
