//! All meets of a design that are known, each with its origin and with what follows from it.

use super::meet::Meet;
use super::solve::{SolvedTiers, TierOutcome};
use crate::Tiers;
use serde::{Deserialize, Serialize};

/// A design with all its known meets.
#[derive(Debug, Clone)]
pub struct KnownMeets {
    /// The design as it is given.
    pub design: Tiers,
    /// The design with all known meets, and with the names by which they call its tiers.
    pub met: Tiers,
    /// The same design where its meets are followed.
    pub solved: SolvedTiers,
    /// The tiers of the design, in their order.
    pub tiers: Vec<TierMeet>,
}

/// The meet of a tier, and what follows from it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TierMeet {
    /// The number of the tier, from 1.
    pub tier: usize,
    /// The name by which meets and lists call the tier.
    pub name: String,
    /// The cutter's instructions; empty where there are none.
    pub instructions: String,
    /// The meet in plain words; `None` where none is known.
    pub meet: Option<String>,
    /// The origin of the meet.
    pub source: MeetSource,
    /// The number of corners, at different depths, that fit the names of the meet; above 1 where these are ambiguous, 0 where
    /// the meet names none.
    pub choices: usize,
    /// The outcome where the meet is followed.
    pub outcome: MeetOutcome,
    /// The reason why the meet cannot be followed, where it cannot.
    pub error: Option<String>,
    /// The angle from the girdle plane where the meet is followed, degrees; below 0 in the pavilion.
    pub angle: f64,
    /// The distance from the origin as the design gives it, in its own unit.
    pub distance: f64,
    /// The distance where the meet is followed, in the same unit.
    pub solved: f64,
}

/// The origin of a meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MeetSource {
    /// The file gives the meet.
    File,
    /// The instruction of the tier states it.
    Stated,
    /// The geometry shows it.
    Found,
    /// No meet is known.
    #[serde(rename = "")]
    Unknown,
}

/// The outcome for a tier whose meet is followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MeetOutcome {
    /// [`TierOutcome::Kept`].
    Kept,
    /// [`TierOutcome::Sets`].
    Sets,
    /// [`TierOutcome::Solved`].
    Solved,
    /// [`TierOutcome::Failed`].
    Failed,
}

impl MeetSource {
    /// Returns the origin as lists name it; empty where no meet is known.
    pub fn name(self) -> &'static str {
        match self {
            Self::File => "file",
            Self::Stated => "stated",
            Self::Found => "found",
            Self::Unknown => "",
        }
    }
}

impl KnownMeets {
    /// Takes the meets that the design gives, that instructions state, and that the geometry shows, in this order, and names
    /// the tiers.
    pub fn of(design: Tiers) -> Self {
        let stated = design.with_stated_meets().with_names_in_meets();
        let (met, solved) = stated.with_found_meets_followed();
        let has = |tiers: &Tiers, place: usize| tiers.tiers[place].meet.is_some();
        let source = |place| {
            if has(&design, place) {
                MeetSource::File
            } else if has(&stated, place) {
                MeetSource::Stated
            } else if has(&met, place) {
                MeetSource::Found
            } else {
                MeetSource::Unknown
            }
        };
        let names = met.names();
        let tier = |(place, name): (usize, String)| {
            let (outcome, error) = match &solved.outcomes[place] {
                TierOutcome::Kept => (MeetOutcome::Kept, None),
                TierOutcome::Sets => (MeetOutcome::Sets, None),
                TierOutcome::Solved => (MeetOutcome::Solved, None),
                TierOutcome::Failed(error) => (MeetOutcome::Failed, Some(error.fault.to_string())),
            };
            TierMeet {
                tier: place + 1,
                name,
                instructions: design.tiers[place].instructions.clone(),
                meet: met.tiers[place].meet.as_ref().map(Meet::to_string),
                source: source(place),
                choices: solved.choices[place],
                outcome,
                error,
                angle: solved.tiers.tiers[place].angle,
                distance: design.tiers[place].distance,
                solved: solved.tiers.tiers[place].distance,
            }
        };
        let tiers = names.into_iter().enumerate().map(tier).collect();
        Self { tiers, design, met, solved }
    }
}

impl TierMeet {
    /// Returns the distance by which the tier moves when its meet is followed, in the design's own unit.
    pub fn difference(&self) -> f64 {
        self.solved - self.distance
    }
}
