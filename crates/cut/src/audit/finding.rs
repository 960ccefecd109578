//! A finding of an audit: its kind, place and size, and the threshold that it crosses.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The kind of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FindingKind {
    /// Two corners that nearly meet, without an edge that a split meet would be reported for.
    NearMiss,
    /// A short edge between two corners of three facets each, where the designer may have meant four facets to meet
    /// in a point.
    SplitMeet,
    /// A facet that is small beside the facets of its zone.
    SmallFacet,
    /// A facet whose least width is very small.
    ThinFacet,
    /// A tier of the pavilion that lies flatter than the critical angle.
    BelowCritical,
    /// Corners of the girdle's upper or lower edge that lie at different heights.
    UnevenGirdle,
    /// Girdle facets that depart from the symmetry of the others.
    Outline,
    /// Facets of crown or pavilion that depart from the symmetry of the others.
    Symmetry,
    /// A symmetry that the file states and most facets do not keep.
    StatedSymmetry,
    /// Planes of the design that never touch the stone.
    UnusedPlane,
}

impl FindingKind {
    /// All kinds, in the order in which an audit lists them.
    pub const ALL: [Self; 10] = [
        Self::NearMiss,
        Self::SplitMeet,
        Self::SmallFacet,
        Self::ThinFacet,
        Self::BelowCritical,
        Self::UnevenGirdle,
        Self::Outline,
        Self::Symmetry,
        Self::StatedSymmetry,
        Self::UnusedPlane,
    ];

    /// Returns the name of the kind, as people read it.
    pub fn name(self) -> &'static str {
        match self {
            Self::NearMiss => "near miss",
            Self::SplitMeet => "split meet",
            Self::SmallFacet => "small facet",
            Self::ThinFacet => "thin facet",
            Self::BelowCritical => "below the critical angle",
            Self::UnevenGirdle => "uneven girdle",
            Self::Outline => "outline off its symmetry",
            Self::Symmetry => "facets off their symmetry",
            Self::StatedSymmetry => "stated symmetry not found",
            Self::UnusedPlane => "unused planes",
        }
    }

    /// Returns the key of the kind, by which programs know it.
    pub fn key(self) -> &'static str {
        match self {
            Self::NearMiss => "near_miss",
            Self::SplitMeet => "split_meet",
            Self::SmallFacet => "small_facet",
            Self::ThinFacet => "thin_facet",
            Self::BelowCritical => "below_critical",
            Self::UnevenGirdle => "uneven_girdle",
            Self::Outline => "outline",
            Self::Symmetry => "symmetry",
            Self::StatedSymmetry => "stated_symmetry",
            Self::UnusedPlane => "unused_plane",
        }
    }

    /// Returns the possible meaning of a finding of this kind, in a sentence.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::NearMiss => "Two corners lie so near to each other that they may be meant to be one.",
            Self::SplitMeet => {
                "A short edge joins two corners of three facets; four facets may be meant to meet."
            }
            Self::SmallFacet => "The facet is small beside the others of its zone; it may be left over.",
            Self::ThinFacet => "The facet is so narrow that it may be a cut that went a little too deep.",
            Self::BelowCritical => {
                "Light that enters through the table at right angles leaks through these facets."
            }
            Self::UnevenGirdle => {
                "The girdle's edge does not run level from meet to meet; it may be meant to."
            }
            Self::Outline => "These girdle facets lie where the symmetry of the others puts none.",
            Self::Symmetry => "These facets lie where the symmetry of the others puts none.",
            Self::StatedSymmetry => "Most facets do not keep the symmetry that the file states.",
            Self::UnusedPlane => "These planes lie wholly outside the stone; they may be cut too shallow.",
        }
    }

    /// Returns whether the places of such findings are corners of the stone; otherwise they are the middles of
    /// facets.
    pub fn is_about_corners(self) -> bool {
        matches!(self, Self::NearMiss | Self::SplitMeet | Self::UnevenGirdle)
    }
}

impl fmt::Display for FindingKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Finding {
    /// Returns the size with its unit, as people read it.
    pub fn size_text(&self) -> String {
        self.unit.text(self.size)
    }

    /// Returns the threshold with its unit and the side on which findings lie, as people read it; `None` where any size
    /// counts.
    pub fn limit_text(&self) -> Option<String> {
        let side = match self.kind {
            FindingKind::UnevenGirdle | FindingKind::Outline | FindingKind::Symmetry => "above ",
            FindingKind::UnusedPlane => return None,
            // The name of this kind already says that its sizes lie below.
            FindingKind::BelowCritical => "",
            _ => "below ",
        };
        Some(format!("{side}{}", self.unit.text(self.threshold)))
    }
}

/// The unit of a finding's size and threshold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FindingUnit {
    /// Percent of the stone's width W, the shorter side of its outline.
    PercentOfWidth,
    /// Percent of the median area of the facets of the same zone.
    PercentOfMedianArea,
    /// Percent of the facets of crown and pavilion.
    PercentOfFacets,
    /// Degrees from the girdle plane.
    Degrees,
    /// A number of planes.
    Planes,
}

impl FindingUnit {
    /// Returns a value in this unit, as people read it.
    fn text(self, value: f64) -> String {
        match self {
            Self::Degrees => format!("{value:.2}{self}"),
            Self::Planes => format!("{value} {self}"),
            _ => format!("{value:.2} {self}"),
        }
    }
}

impl fmt::Display for FindingUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::PercentOfWidth => "% of W",
            Self::PercentOfMedianArea => "% of the zone's median area",
            Self::PercentOfFacets => "% of the facets",
            Self::Degrees => "°",
            Self::Planes => "planes",
        })
    }
}

/// A place of a stone that may not be what its designer meant: a candidate, no verdict.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The kind.
    pub kind: FindingKind,
    /// The places, in the frame of the stone that was audited. Empty where the finding has no place, as for planes that never
    /// touch the stone.
    pub points: Vec<DVec3>,
    /// The names of the facets, or of the planes, that the finding is about.
    pub facets: Vec<String>,
    /// The size of the finding, in `unit`.
    pub size: f64,
    /// The threshold that the size crosses, in the same unit.
    pub threshold: f64,
    /// The unit of size and threshold.
    pub unit: FindingUnit,
}
