//! The round brilliant in the numbers that people use: percent of the girdle diameter, and degrees from the girdle
//! plane.
//!
//! It has eight bezels, eight stars, sixteen upper and sixteen lower halves, and eight mains. Measures follow GIA: table and
//! star length are radial, and the lower-half length is radial too unless the vertical one is given.

use serde::{Deserialize, Serialize};

/// The proportions of a round brilliant as given. All facets follow from them. Their ranges are in the family's table.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RoundBrilliant {
    /// The table's size from corner to opposite corner, percent of the girdle diameter.
    pub table: f64,
    /// The crown, by the angle of its bezels or by its height.
    pub crown: Crown,
    /// The pavilion, by the angle of its mains or by its depth.
    pub pavilion: Pavilion,
    /// The distance that the stars reach from the table's edge to the girdle, seen from above. Percent of that way.
    pub star_length: f64,
    /// The length of the lower halves from the girdle toward the centre.
    pub lower_half: LowerHalf,
    /// The girdle's thickness at the bezels, where it is greatest, percent of the girdle diameter. 0 is a knife edge all
    /// round, without girdle facets.
    pub girdle_thickness: f64,
    /// The number of girdle facets.
    ///
    /// Multiples of 8 keep the eightfold mirror symmetry whole, so tracers have a sixteenth of the work. Multiples of 16
    /// also put a girdle corner under each star tip. Multiples of 32 put one at each valley, and 16 itself gives a straight
    /// girdle edge.
    pub girdle_facets: u32,
    /// The culet's size from flat to opposite flat, percent of the girdle diameter; 0 is a point.
    pub culet: f64,
}

/// The measure that gives a crown.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Crown {
    /// The angle of the bezels from the girdle plane, degrees.
    Angle(f64),
    /// The height from the girdle's upper edge to the table, percent of the girdle diameter.
    Height(f64),
}

/// The measure that gives a pavilion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Pavilion {
    /// The angle of the mains from the girdle plane, degrees.
    Angle(f64),
    /// The depth from the girdle's lower edge to the culet, percent of the girdle diameter. A larger culet makes it less.
    Depth(f64),
}

/// The measure that gives the length of the lower halves.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LowerHalf {
    /// The length seen along the axis: percent of the way from the girdle to the centre (GIA).
    Radial(f64),
    /// The length seen from the side: percent of the depth from the girdle to the point in which the mains meet (some
    /// laboratories).
    Vertical(f64),
}

/// Tolkowsky's cut of 1919, as in `cuts/tolkowsky.toml`: the first cut of the family.
pub const TOLKOWSKY: RoundBrilliant = RoundBrilliant {
    table: 53.0,
    crown: Crown::Angle(34.5),
    pavilion: Pavilion::Angle(40.75),
    star_length: 50.0,
    lower_half: LowerHalf::Radial(75.0),
    girdle_thickness: 3.0,
    girdle_facets: 96,
    culet: 0.0,
};

/// A modern ideal cut, which tests vary.
#[cfg(test)]
pub(crate) const MODERN: RoundBrilliant = RoundBrilliant {
    table: 56.0,
    crown: Crown::Angle(34.5),
    pavilion: Pavilion::Angle(40.8),
    star_length: 50.0,
    lower_half: LowerHalf::Radial(77.0),
    girdle_thickness: 3.0,
    girdle_facets: 96,
    culet: 0.0,
};
