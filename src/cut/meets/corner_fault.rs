//! Why a tier cannot be cut to corners that were picked.

use super::super::tiers::TierZone;
use super::fault::MeetFault;

/// Why a tier cannot be cut to a corner, or led through several.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CornerFault {
    /// A corner across the girdle.
    #[error(
        "the corner is on the {}, and a {} tier that is cut to it would take the girdle away",
        across(*.zone),
        .zone.name()
    )]
    Across {
        /// The zone of the tier.
        zone: TierZone,
    },
    /// A corner farther out than any other, seen from the tier.
    #[error("the tier only touches the stone at this corner and cuts nothing there")]
    Touches,
    /// A corner, or a plane through several, on the other side of the origin.
    #[error("no facet of the tier faces the stone from that side")]
    Behind,
    /// Corners in one place or on one line.
    #[error("the corners lie on one line and give no angle; choose one beside the line")]
    OneLine,
    /// An angle at which the tier would face the other way.
    #[error(
        "the {} corners give an angle of {angle:.2}° on the {}, and a {} tier does not go there",
        if *.count == 2 { "two" } else { "three" },
        across(*.zone),
        .zone.name()
    )]
    OtherSide {
        /// The angle from the girdle plane, degrees.
        angle: f64,
        /// The zone of the tier.
        zone: TierZone,
        /// How many corners give it.
        count: usize,
    },
    /// A corner that no names of tiers mean.
    #[error("no names of tiers lead this tier to {}", corner(*.number))]
    NoName {
        /// The number of the corner among those that were picked, from 1.
        number: usize,
    },
    /// Names that mean other corners while the tier is cut.
    #[error(
        "when the tier is cut, the same names lead it to another corner; move it later, or cut it to another corner"
    )]
    CutAtOtherPlace,
    /// A tier without facets.
    #[error("the tier has no facets")]
    NoFacets,
    /// Points of a meet that give the tier no setting.
    #[error("{0}")]
    Meet(MeetFault),
}

impl From<MeetFault> for CornerFault {
    fn from(fault: MeetFault) -> Self {
        match fault {
            MeetFault::OneLine => Self::OneLine,
            MeetFault::BeyondAxis => Self::Behind,
            other => Self::Meet(other),
        }
    }
}

/// Returns the name of the part of the stone across the girdle from a zone.
fn across(zone: TierZone) -> &'static str {
    match zone {
        TierZone::Crown | TierZone::Table => TierZone::Pavilion.name(),
        TierZone::Pavilion | TierZone::Culet => TierZone::Crown.name(),
        TierZone::Girdle => "crown or pavilion",
    }
}

fn corner(number: usize) -> &'static str {
    ["the corner", "the first corner", "the second corner", "the third corner"]
        .get(number)
        .copied()
        .unwrap_or("the corner")
}
