//! Why a tier cannot be cut to corners that were picked.

use super::super::tiers::TierZone;
use super::fault::MeetFault;

/// Why a tier cannot be cut to a corner, or led through several.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CornerFault {
    /// The corner lies on the other side of the girdle than the tier.
    #[error(
        "the corner is on the {}, and a {} tier that is cut to it would take the girdle away",
        across(*.zone),
        .zone.name()
    )]
    Across {
        /// The zone of the tier.
        zone: TierZone,
    },
    /// No corner lies farther out in the direction of the tier, so that the tier would cut nothing.
    #[error("the tier only touches the stone at this corner and cuts nothing there")]
    Touches,
    /// The corner, or the plane through several corners, lies on the other side of the origin than the tier's facets.
    #[error("no facet of the tier faces the stone from that side")]
    Behind,
    /// The corners lie in one place or on one line.
    #[error("the corners lie on one line and give no angle; choose one beside the line")]
    OneLine,
    /// At the angle that the corners give, the tier would lie on the other side of the girdle.
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
        /// The number of corners that give the angle, 2 or 3.
        count: usize,
    },
    /// No names of tiers describe the corner.
    #[error("no names of tiers lead this tier to {}", corner(*.number))]
    NoName {
        /// The number of the corner among several that were picked, from 1; 0 where one alone was picked.
        number: usize,
    },
    /// The names that describe the corner in the finished stone describe another one at the time when the tier is cut.
    #[error(
        "when the tier is cut, the same names lead it to another corner; move it later, or cut it to another corner"
    )]
    CutAtOtherPlace,
    /// The tier has no facets, so that nothing can be cut.
    #[error("the tier has no facets")]
    NoFacets,
    /// The points of the meet give the tier no setting, for the reason that is held.
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
