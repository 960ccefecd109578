//! A ring as a few numbers, and its parts: plain data.

use brillianteer_math::{Pose, ShadedSurface};
use serde::{Deserialize, Serialize};

/// The style of a ring.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RingStyle {
    /// A band of metal without stones.
    Band,
    /// A solitaire: one stone in four prongs.
    FourProng,
    /// A solitaire: one stone in six prongs.
    SixProng,
    /// One stone in four prongs, with a circle of small stones around it.
    Halo,
    /// A band with small stones all around.
    Eternity,
}

impl RingStyle {
    /// The styles by name.
    pub const NAMES: [(&str, Self); 5] = [
        ("band", Self::Band),
        ("four-prong", Self::FourProng),
        ("six-prong", Self::SixProng),
        ("halo", Self::Halo),
        ("eternity", Self::Eternity),
    ];

    /// Returns the style's name.
    pub fn name(self) -> &'static str {
        Self::NAMES.into_iter().find(|(_, style)| *style == self).map_or("", |(name, _)| name)
    }

    /// Returns the number of prongs that hold the main stone; 0 where the style has none.
    pub fn prongs(self) -> usize {
        match self {
            Self::Band | Self::Eternity => 0,
            Self::FourProng | Self::Halo => 4,
            Self::SixProng => 6,
        }
    }

    /// Returns whether the style holds small stones.
    pub fn has_small(self) -> bool {
        matches!(self, Self::Halo | Self::Eternity)
    }
}

/// The shape of the band's outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OuterShape {
    /// Half an ellipse.
    D,
    /// Flat, with edges that are a little rounded.
    Flat,
}

impl OuterShape {
    /// The shapes by name.
    pub const NAMES: [(&str, Self); 2] = [("d", Self::D), ("flat", Self::Flat)];

    /// Returns the shape's name.
    pub fn name(self) -> &'static str {
        Self::NAMES.into_iter().find(|(_, shape)| *shape == self).map_or("", |(name, _)| name)
    }
}

/// A ring as numbers; `RING_NUMBERS` (in this folder) has their ranges, docs/formats.md their meanings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ring {
    /// The style.
    pub style: RingStyle,
    /// The shape of the band's outside.
    pub outside: OuterShape,
    /// The diameter of the finger's hole, in mm.
    pub inner_diameter_mm: f64,
    /// The width of the band opposite the head, in mm.
    pub width_mm: f64,
    /// The thickness of the band in its middle, in mm.
    pub thickness_mm: f64,
    /// The rise of the inside toward the edges, in mm.
    pub comfort_mm: f64,
    /// The width of the band at the head, as a part of `width_mm`.
    pub taper: f64,
    /// The diameter of a prong at the girdle, in mm.
    pub prong_diameter_mm: f64,
    /// The depth of the prongs' notches, as a part of their diameter.
    pub notch: f64,
    /// The length of a prong's middle over the crown, in mm.
    pub grip_mm: f64,
    /// The height of the stone's lowest point above the metal under it, in mm.
    pub culet_gap_mm: f64,
    /// The diameter of rails, in mm.
    pub rail_diameter_mm: f64,
    /// The girdle diameter of small stones, in mm.
    pub small_diameter_mm: f64,
    /// The least gap between girdles, in mm.
    pub small_gap_mm: f64,
}

impl Default for Ring {
    fn default() -> Self {
        Self {
            style: RingStyle::SixProng,
            outside: OuterShape::D,
            inner_diameter_mm: 17.3,
            width_mm: 2.2,
            thickness_mm: 1.7,
            comfort_mm: 0.3,
            taper: 0.85,
            prong_diameter_mm: 0.85,
            notch: 0.4,
            grip_mm: 0.25,
            culet_gap_mm: 0.25,
            rail_diameter_mm: 0.6,
            small_diameter_mm: 1.5,
            small_gap_mm: 0.12,
        }
    }
}

/// A piece of metal. Pieces of one ring reach into one another; each is closed.
#[derive(Debug, Clone, PartialEq)]
pub struct MetalPart {
    /// The jeweller's name of the part.
    pub name: &'static str,
    /// Its surface, in mm.
    pub surface: ShadedSurface,
}

/// The kind of stone in a seat.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum SeatKind {
    /// The main stone, which prongs hold in the middle of the head.
    Main,
    /// A small stone, around the main stone or along the band.
    Small,
}

/// The place of a stone in a ring.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RingSeat {
    /// The kind of its stone.
    pub kind: SeatKind,
    /// The pose that carries the stone from its frame (girdle radius 1, +z out of the table) into the ring's, in mm.
    pub pose: Pose,
}

/// A ring without its stones, with their places.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mounting {
    /// The metal.
    pub metal: Vec<MetalPart>,
    /// The places of the stones.
    pub seats: Vec<RingSeat>,
    /// The height of the main stone's lowest point above the finger, in mm.
    pub culet_height_mm: Option<f64>,
    /// The gap between the girdles of neighbouring small stones, in mm.
    pub small_gap_mm: Option<f64>,
}

impl Ring {
    /// Returns the name of the ring's body of metal.
    pub fn label(&self) -> String {
        format!("{} ring", self.style.name())
    }

    /// Returns the radius of the finger's hole, in mm.
    pub(super) fn hole(&self) -> f64 {
        0.5 * self.inner_diameter_mm
    }

    /// Returns the radius of the band's outside in its middle, in mm.
    pub(super) fn outer(&self) -> f64 {
        self.hole() + self.thickness_mm
    }
}

impl Mounting {
    /// Returns all metal as one surface.
    pub fn surface(&self) -> ShadedSurface {
        let mut all = ShadedSurface::default();
        for MetalPart { surface, .. } in &self.metal {
            let first = all.points.len() as u32;
            all.points.extend(&surface.points);
            all.normals.extend(&surface.normals);
            all.corners.extend(surface.corners.iter().map(|corners| corners.map(|k| k + first)));
        }
        all
    }
}
