//! The reasons why a ring cannot be made, each with the number at fault and the excess.

use super::RingStyle;
use brillianteer_base::NumberError;

/// The reason why a ring cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RingError {
    /// A number lies outside its range, or is not finite.
    #[error(transparent)]
    OutOfRange(#[from] NumberError),
    /// The style holds a stone that is not given.
    #[error("stone: a ring of style '{}' holds a stone; give its cut", style.name())]
    NoStone {
        /// The style.
        style: RingStyle,
    },
    /// The style holds small stones, whose cut is not given.
    #[error("small_stone: a ring of style '{}' holds small stones; give their cut", style.name())]
    NoSmallStone {
        /// The style.
        style: RingStyle,
    },
    /// A stone is given for which the style has no place.
    #[error("{key}: a ring of style '{}' has no place for it; leave it out", style.name())]
    NoPlace {
        /// The key of the stone.
        key: &'static str,
        /// The style.
        style: RingStyle,
    },
    /// The stone's axis, the line through the origin of its frame along z, does not run through it.
    #[error("{key}: the axis of its frame does not run through the stone; prongs cannot be placed around it")]
    OffAxis {
        /// The key of the stone.
        key: &'static str,
    },
    /// A part is larger than the room that it has.
    #[error("{key}: {what} by {by_mm:.3} mm; {change}")]
    NoRoom {
        /// The key of the number to be changed.
        key: &'static str,
        /// The parts that collide.
        what: &'static str,
        /// The overlap, in mm.
        by_mm: f64,
        /// The number to change, and its direction.
        change: &'static str,
    },
    /// Metal would lie inside a stone.
    #[error("{part} would run into a stone by {by_mm:.3} mm; raise culet_gap_mm or change the diameters")]
    InsideStone {
        /// The part of the ring.
        part: &'static str,
        /// The depth of the metal in the stone, in mm.
        by_mm: f64,
    },
    /// The ring has more stones than a scene can have.
    #[error("small_diameter_mm: {count} small stones are too many, at most {most}; raise it")]
    TooMany {
        /// The number of small stones.
        count: usize,
        /// The most that are possible.
        most: usize,
    },
}

impl RingError {
    /// Returns the key of the number or stone at fault.
    pub fn key(&self) -> &'static str {
        match self {
            Self::OutOfRange(NumberError { key, .. })
            | Self::NoPlace { key, .. }
            | Self::OffAxis { key }
            | Self::NoRoom { key, .. } => key,
            Self::NoStone { .. } => "stone",
            Self::NoSmallStone { .. } => "small_stone",
            Self::InsideStone { .. } => "culet_gap_mm",
            Self::TooMany { .. } => "small_diameter_mm",
        }
    }
}
