//! Meets: the statements of cutters' instructions about the place of a tier's facets.

use serde::{Deserialize, Serialize};
use std::fmt;

/// The word that stands for any girdle facet in the names of a corner.
pub const ANY_GIRDLE: &str = "girdle";

/// The rule that gives the facets of a tier their place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Meet {
    /// The cutter chooses the distance, so the tier's own distance stands.
    Given(GivenSize),
    /// The centre-point angle method (CAM), with an angle from the girdle plane in degrees. An upright facet goes to
    /// the place where a facet below it, cut at this angle to the temporary centre point, would meet it on the level
    /// girdle line.
    CentreAngle(f64),
    /// The facets pass through one to three points. One point gives the distance; two give the angle too, at the
    /// given index; three give the index too.
    Points(Vec<MeetPoint>),
}

/// The size that a cutter chooses by the distance of a tier.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GivenSize {
    /// The size of the stone, its length or width, or that of a facet.
    Size,
    /// The thickness of the girdle.
    GirdleThickness,
    /// The depth of a new centre point, which cuts an older one away.
    CentrePoint,
}

/// A point through which a facet passes, on the stone as it is cut so far.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MeetPoint {
    /// The point where the axis leaves the stone on the side of the tier.
    Centre {
        /// True where later tiers will cut the point away.
        temporary: bool,
    },
    /// The outline of the stone at the height of its girdle line on the side of the tier.
    LevelGirdle,
    /// A corner of the girdle on the side of the tier.
    GirdlePoint,
    /// The corner where facets of these tiers meet. A name that is given twice means two facets of its tier, and the
    /// name `girdle` means any upright facet. Where several corners fit, a facet goes to the first that it reaches as
    /// it is cut deeper.
    Corner(Vec<String>),
    /// One of several corners that fit the same names: a facet reaches it after others.
    LaterCorner {
        /// The names, as in [`Corner`](Self::Corner).
        names: Vec<String>,
        /// The corner's number, from 1, in the order in which a facet reaches the corners as it is cut deeper.
        /// Corners at one depth count once.
        reached: usize,
    },
}

impl Meet {
    /// Returns the names of tiers in the meet.
    pub fn names(&self) -> impl Iterator<Item = &String> {
        let points = match self {
            Self::Points(points) => points.as_slice(),
            _ => &[],
        };
        points.iter().filter_map(MeetPoint::named).flat_map(|(names, _)| names)
    }

    /// Returns the names of tiers in the meet, so that they can be changed.
    pub fn names_mut(&mut self) -> impl Iterator<Item = &mut String> {
        let points = match self {
            Self::Points(points) => points.as_mut_slice(),
            _ => &mut [],
        };
        points.iter_mut().flat_map(|point| match point {
            MeetPoint::Corner(names) | MeetPoint::LaterCorner { names, .. } => names.as_mut_slice(),
            _ => &mut [],
        })
    }

    /// Returns the meet at the first of the points alone, which gives the distance and keeps the angle; `None` for a
    /// meet that names no point.
    pub fn first_point(&self) -> Option<Self> {
        match self {
            Self::Points(points) => Some(Self::Points(points.iter().take(1).cloned().collect())),
            Self::Given(_) | Self::CentreAngle(_) => None,
        }
    }
}

impl MeetPoint {
    /// Returns the names of a corner, and its number among the corners that fit them; `None` for a point of another
    /// kind.
    pub fn named(&self) -> Option<(&[String], usize)> {
        match self {
            Self::Corner(names) => Some((names, 1)),
            Self::LaterCorner { names, reached } => Some((names, *reached)),
            _ => None,
        }
    }

    /// The points that are written in fixed words, with these words.
    pub const IN_WORDS: [(&str, Self); 4] = [
        ("centre point", Self::Centre { temporary: false }),
        ("temporary centre point", Self::Centre { temporary: true }),
        ("level girdle", Self::LevelGirdle),
        ("girdle point", Self::GirdlePoint),
    ];
}

impl GivenSize {
    /// The sizes, with the words for them.
    pub const IN_WORDS: [(&str, Self); 3] = [
        ("size", Self::Size),
        ("girdle thickness", Self::GirdleThickness),
        ("new centre point", Self::CentrePoint),
    ];
}

impl fmt::Display for MeetPoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Centre { temporary: false } => f.write_str("Cut to centre point"),
            Self::Centre { temporary: true } => f.write_str("Cut to temporary centre point"),
            Self::LevelGirdle => f.write_str("Level girdle"),
            Self::GirdlePoint => f.write_str("Meet girdle point"),
            Self::Corner(names) => write!(f, "Meet {}", names.join("-")),
            Self::LaterCorner { names, reached } => {
                write!(f, "Meet {} (reached as number {reached})", names.join("-"))
            }
        }
    }
}

/// Writes the meet as a cutter's instruction.
impl fmt::Display for Meet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Given(GivenSize::Size) => f.write_str("Set size"),
            Self::Given(GivenSize::GirdleThickness) => f.write_str("Set girdle thickness"),
            Self::Given(GivenSize::CentrePoint) => f.write_str("New centre point below old"),
            Self::CentreAngle(angle) => write!(f, "CAM {angle}°"),
            Self::Points(points) => {
                for (place, point) in points.iter().enumerate() {
                    write!(f, "{}{point}", if place == 0 { "" } else { "; " })?;
                }
                Ok(())
            }
        }
    }
}
