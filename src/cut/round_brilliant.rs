//! The round brilliant as people write it: percent of the girdle diameter, degrees from the girdle plane.
//!
//! Eight bezels, eight stars, sixteen upper and lower halves, eight mains, after GIA's way of measuring: table and
//! star length are radial, the lower-half length radial too unless the vertical one is asked for.

use serde::Serialize;

/// The proportions of a round brilliant as given; everything else follows from them.
///
/// Serialises under the keys of a cut file's `[round_brilliant]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RoundBrilliant {
    /// Table, corner to opposite corner. Percent of the girdle diameter, 5 to 92.39.
    pub table: f64,
    /// The crown, by the angle of its bezels or by its height.
    #[serde(flatten)]
    pub crown: Crown,
    /// The pavilion, by the angle of its mains or by its depth.
    #[serde(flatten)]
    pub pavilion: Pavilion,
    /// How far the stars reach from the table's edge to the girdle, seen from above. Percent of that way, below 100;
    /// its lower limit depends on the table.
    pub star_length: f64,
    /// How far the lower halves reach from the girdle to the centre.
    #[serde(flatten)]
    pub lower_half: LowerHalf,
    /// Girdle thickness at the bezels, where it is greatest. Percent of the girdle diameter; 0 is a knife edge all
    /// round, without girdle facets.
    pub girdle_thickness: f64,
    /// Number of girdle facets, any whole number from 16 to 128.
    ///
    /// Multiples of 8 keep the eightfold mirror symmetry whole, so tracers have a sixteenth of the work; multiples of
    /// 16 also put a girdle corner under each star tip; multiples of 32 one at each valley, and 16 itself gives a
    /// straight girdle edge.
    pub girdle_facets: u32,
    /// Culet, flat to opposite flat. Percent of the girdle diameter, 0 (a point) to below 100.
    pub culet: f64,
}

/// What a crown is given by.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub enum Crown {
    /// Angle of the bezels from the girdle plane, degrees.
    #[serde(rename = "crown_angle")]
    Angle(f64),
    /// From the girdle's upper edge to the table, percent of the girdle diameter.
    #[serde(rename = "crown_height")]
    Height(f64),
}

/// What a pavilion is given by.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub enum Pavilion {
    /// Angle of the mains from the girdle plane, degrees.
    #[serde(rename = "pavilion_angle")]
    Angle(f64),
    /// From the girdle's lower edge to the culet (so less with a larger culet), percent of the girdle diameter.
    #[serde(rename = "pavilion_depth")]
    Depth(f64),
}

/// What the length of the lower halves is given by.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub enum LowerHalf {
    /// Seen along the axis: percent of the way from the girdle to the centre (GIA).
    #[serde(rename = "lower_half_length")]
    Radial(f64),
    /// Seen from the side: percent of the depth from the girdle to where the mains meet (some laboratories).
    #[serde(rename = "lower_half_length_vertical")]
    Vertical(f64),
}

/// Tolkowsky's of 1919 as `cuts/tolkowsky.toml` has it, which the tests bend.
#[cfg(test)]
pub(crate) const TOLKOWSKY: RoundBrilliant = RoundBrilliant {
    table: 53.0,
    crown: Crown::Angle(34.5),
    pavilion: Pavilion::Angle(40.75),
    star_length: 50.0,
    lower_half: LowerHalf::Radial(75.0),
    girdle_thickness: 3.0,
    girdle_facets: 96,
    culet: 0.0,
};

/// A modern ideal cut, which the tests bend.
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
