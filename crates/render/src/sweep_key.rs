//! The keys of the numbers that a sweep, a gradient or a search varies.

use brillianteer_cut::ScaledSide;
use std::fmt;

/// The number or name that varies along an axis of a sweep.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SweepKey {
    /// A proportion of the cut's family, by its key in cut files and in the unit of its row.
    Proportion(String),
    /// The angle of a tier, by its name: degrees from the girdle plane, above 0 on either side. Meets are followed.
    Tier(String),
    /// The distance of a tier from the origin, by the tier's name, in the design's own unit. A tier whose distance
    /// follows from a meet cannot be set so.
    Distance(String),
    /// The height of a side above or below the girdle, percent of its height in the design, 10 to 1000: all its tiers
    /// move together, so that every meet stays ([`scaled`](brillianteer_cut::scaled)). It is set before angles and
    /// distances of tiers.
    Scale(ScaledSide),
    /// The refractive index, of [`INDICES`](brillianteer_optics::INDICES), the same at all wavelengths.
    Index,
    /// The material, by its name.
    Material,
    /// The tilt of the view, degrees, -90 to 90.
    Tilt,
    /// The azimuth of the tilt, degrees.
    Azimuth,
}

/// The prefixes of the keys of tiers: those of angles, and those of distances.
const TIER: &str = "tier:";
const DISTANCE: &str = "distance:";

/// The heights that a side can be scaled to, percent of its height in the design.
pub(super) const PERCENT_OF_SIDE: std::ops::RangeInclusive<f64> = 10.0..=1000.0;

impl SweepKey {
    /// Returns the key of this name: `index`, `material`, `tilt`, `azimuth`, `crown_scale`, `pavilion_scale`, `tier:` or `distance:`
    /// and the name of a tier, or else a proportion.
    pub fn of(name: &str) -> Self {
        match name {
            "index" => Self::Index,
            "material" => Self::Material,
            "tilt" => Self::Tilt,
            "azimuth" => Self::Azimuth,
            "crown_scale" => Self::Scale(ScaledSide::Crown),
            "pavilion_scale" => Self::Scale(ScaledSide::Pavilion),
            _ => match (name.strip_prefix(TIER), name.strip_prefix(DISTANCE)) {
                (Some(tier), _) => Self::Tier(tier.to_owned()),
                (None, Some(tier)) => Self::Distance(tier.to_owned()),
                (None, None) => Self::Proportion(name.to_owned()),
            },
        }
    }
}

impl fmt::Display for SweepKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Proportion(key) => f.write_str(key),
            Self::Tier(name) => write!(f, "{TIER}{name}"),
            Self::Distance(name) => write!(f, "{DISTANCE}{name}"),
            Self::Scale(side) => write!(f, "{side}_scale"),
            Self::Index => f.write_str("index"),
            Self::Material => f.write_str("material"),
            Self::Tilt => f.write_str("tilt"),
            Self::Azimuth => f.write_str("azimuth"),
        }
    }
}
