//! The faults of a meet.

use super::meet::MeetPoint;

/// The error of a meet that gives its tier no distance.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("tier {tier}{}: {fault}", if .name.is_empty() { String::new() } else { format!(" '{:.40}'", .name) })]
pub struct MeetError {
    /// The number of the tier, from 1.
    pub tier: usize,
    /// The tier's name; empty where it has none.
    pub name: String,
    /// The fault of the meet.
    pub fault: MeetFault,
}

/// A fault of a meet: something that it needs is missing or ambiguous.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeetFault {
    /// A name that no tier has.
    #[error("no tier is called {name}; name a tier of the design")]
    UnknownName {
        /// The name.
        name: String,
    },
    /// The name of tiers, none of which is cut before this tier.
    #[error("{name} is not cut yet; move its tier up, or name another")]
    NotCutYet {
        /// The name.
        name: String,
    },
    /// The facets of the meet do not meet in a point.
    #[error("{} on the stone so far", no_point(.point))]
    NoPoint {
        /// The point that does not exist.
        point: MeetPoint,
    },
    /// The meet names a level girdle before there is a girdle line.
    #[error("no girdle facet meets another facet in a level line so far; give the distance")]
    NoGirdleLine,
    /// The meet names the centre point for an upright facet.
    #[error("an upright facet passes through no centre point; give another meet")]
    Upright,
    /// The meet gives a centre-point angle for a facet that is not upright.
    #[error("a centre-point angle is for girdle facets; give another meet")]
    NotUpright,
    /// The centre-point angle is so flat that the facet lies far outside the stone.
    #[error("CAM {angle}° puts the facet far outside the stone; give a steeper angle")]
    TooFar {
        /// The angle, in degrees.
        angle: f64,
    },
    /// The facets of the tier would need different distances or angles.
    #[error(
        "the facets at {first} and {other} would need distances that differ by {by:.2e}; split the tier, or name other facets"
    )]
    Disagree {
        /// The index of the first facet, in teeth.
        first: f64,
        /// The index of the other facet, in teeth.
        other: f64,
        /// The difference of the distances in the design's unit or, for angles, in degrees.
        by: f64,
    },
    /// The points of the meet are one point or lie on one line.
    #[error("the points lie on one line, so they give no plane; name other facets")]
    OneLine,
    /// The plane would lie on the other side of the origin, where no tier can be.
    #[error("the point lies beyond the axis, so no facet at this angle and index passes through it")]
    BeyondAxis,
}

fn no_point(point: &MeetPoint) -> String {
    match point {
        MeetPoint::LaterCorner { names, reached } => {
            format!("{} meet in fewer than {reached} points that this tier can reach", names.join(", "))
        }
        MeetPoint::Corner(names) => match &names[..] {
            [] => "no facet is named to meet".to_owned(),
            [one] => format!("no corner of {one} can be reached"),
            [before @ .., last] => {
                format!("{} and {last} meet in no point that this tier can reach", before.join(", "))
            }
        },
        MeetPoint::GirdlePoint => "no corner of the girdle can be reached".to_owned(),
        MeetPoint::Centre { .. } => "no facet makes a centre point".to_owned(),
        MeetPoint::LevelGirdle => "there is no girdle line".to_owned(),
    }
}
