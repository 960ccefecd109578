//! What a view can show.

use crate::picture::{Picture, Scoped, named};
use crate::scene::Side;
use serde::{Deserialize, Serialize};

/// The picture in a view.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Shows {
    /// The stone under a light.
    Render,
    /// ASET of a 30 degree cone, leakage dark.
    Aset,
    /// ASET of a 30 degree cone, lit from behind.
    AsetWhite,
    /// ASET of a 40 degree cone.
    Aset40,
    /// The Ideal-Scope: a red reflector, white from behind.
    IdealScope,
    /// The hearts, through the pavilion.
    Hearts,
    /// The arrows, through the table.
    Arrows,
    /// The stone from the side, with handles that change it.
    Profile,
    /// The diagram of facets and tiers.
    Diagram,
    /// A background that moves, refracted by a map of the stone.
    Refraction,
    /// A pane of liquid glass, as screens draw it.
    LiquidGlass,
    /// The same pane of liquid glass, traced.
    TracedPane,
}

impl Shows {
    /// All variants, in menu order.
    pub const ALL: [Self; 12] = [
        Self::Render,
        Self::Aset,
        Self::AsetWhite,
        Self::Aset40,
        Self::IdealScope,
        Self::Hearts,
        Self::Arrows,
        Self::Profile,
        Self::Diagram,
        Self::Refraction,
        Self::LiquidGlass,
        Self::TracedPane,
    ];

    /// The variants that are exported as pictures of the stone.
    ///
    /// Refraction maps are exported as maps; panes of liquid glass are no pictures of the stone.
    pub const EXPORTED: &'static [Self] = Self::ALL.split_at(9).0;

    /// Returns the name in menus.
    pub fn name(self) -> &'static str {
        match self {
            Self::Render => "Render",
            Self::Aset => "ASET",
            Self::AsetWhite => "ASET white",
            Self::Aset40 => "ASET 40",
            Self::IdealScope => "Ideal-Scope",
            Self::Hearts => "Hearts",
            Self::Arrows => "Arrows",
            Self::Profile => "Profile",
            Self::Diagram => "Facet diagram",
            Self::Refraction => "Refraction map",
            Self::LiquidGlass => "Liquid glass",
            Self::TracedPane => "Liquid glass, traced",
        }
    }

    /// Describes the picture in a sentence.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Render => "The stone as it looks under the chosen light, with its dispersion.",
            Self::Aset => {
                "Angular Spectrum Evaluation Tool. Green is light from near the horizon, red is light from higher \
                    up, blue is the cone of 30° that the observer's head blocks, and black leaks out behind."
            }
            Self::AsetWhite => "ASET lit from behind: leakage is white.",
            Self::Aset40 => "ASET with a blue cone of 40°, for an observer who is closer.",
            Self::IdealScope => {
                "Red is returned light, black is the observer's own shadow, and white leaks out behind."
            }
            Self::Hearts => {
                "The hearts viewer, face down. Eight equal hearts need symmetric pavilion facets."
            }
            Self::Arrows => "The arrows viewer, face up: eight arrows from the pavilion mains.",
            Self::Profile => "The stone from the side with its proportions; drag its edges to change them.",
            Self::Diagram => "Crown and pavilion facets by tier, with their slopes, as cutters print them.",
            Self::Refraction => {
                "A background that moves behind the stone. A map of where the light comes from is traced once and \
                    then looked up; it always refracts fully, whatever the strength of renders. Drag the background \
                    to move it; drag with Ctrl to tilt the stone."
            }
            Self::LiquidGlass => {
                "A pane in front of the background as screens draw it, by formulas and without rays. Drag the pane \
                    to move it."
            }
            Self::TracedPane => {
                "The same pane as real glass with the same outline, thickness, index and dispersion, traced ray by \
                    ray."
            }
        }
    }

    /// Returns the name in files and on the command line.
    pub fn key(self) -> &'static str {
        match self {
            Self::Render => "render",
            Self::Aset => "aset",
            Self::AsetWhite => "aset-white",
            Self::Aset40 => "aset-40",
            Self::IdealScope => "ideal-scope",
            Self::Hearts => "hearts",
            Self::Arrows => "arrows",
            Self::Profile => "profile",
            Self::Diagram => "diagram",
            Self::Refraction => "refraction",
            Self::LiquidGlass => "liquid-glass",
            Self::TracedPane => "liquid-glass-traced",
        }
    }

    /// Returns the scope that the stone is seen in, if any.
    pub fn scoped(self) -> Option<Scoped> {
        match named(self.key()) {
            Some(Picture::Scoped(scoped)) => Some(scoped),
            _ => None,
        }
    }

    /// Returns the side that the picture is made for; `None` for either side.
    pub fn side(self) -> Option<Side> {
        self.scoped().and_then(|s| s.side)
    }

    /// Whether the picture shows all copies, as they move; else it shows the design alone, at rest.
    pub fn has_company(self) -> bool {
        matches!(self, Self::Render | Self::Refraction)
    }

    /// Whether the picture shows the stone by light, from a side that can be chosen.
    pub fn is_seen(self) -> bool {
        !matches!(self, Self::Profile | Self::Diagram) && !self.is_pane()
    }

    /// Whether the picture is a pane of liquid glass, and shows nothing of the stone.
    pub fn is_pane(self) -> bool {
        matches!(self, Self::LiquidGlass | Self::TracedPane)
    }

    /// Whether an overlay can be drawn over the picture.
    pub fn takes_overlay(self) -> bool {
        self.is_seen() && self != Self::Refraction
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scope_is_found() {
        let scopes = Shows::ALL.into_iter().filter(|s| s.scoped().is_some());
        assert_eq!(scopes.count(), 6);
        assert_eq!(Shows::EXPORTED.last(), Some(&Shows::Diagram));
        assert_eq!(Shows::Hearts.side(), Some(Side::Culet));
        assert!(Shows::ALL.into_iter().all(|s| s.meaning().ends_with('.')));
    }
}
