//! The pictures and drawings that a view can show.
//!
//! To add one, add a row. A picture in a scope needs nothing else, because its key is that of a `Picture::Scoped`.
//! Any other needs an arm in `ShotTracer::take` (`studio/take.rs`), a job in `studio/jobs.rs`, and a line in
//! `PartialEq for Shot` (`studio/order.rs`) for each new setting; one that is not traced is drawn in
//! `views/pane.rs` or looked up in `tasks/lookup.rs`. Those that exports offer stand first; `EXPORTED` counts them.
//! Say in `is_seen`, `takes_overlay`, `has_copies` and `is_pane` what it is: the compiler does not ask.

use crate::described::described;
use brillianteer_picture::{Picture, Scoped, named};
use brillianteer_scene::Side;
use serde::{Deserialize, Serialize};

described! {
/// The picture in a view. Its key is the one of [`named`] where the picture is exported.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Shows by key {
    Render: "render", "Render", "The stone as it looks under the chosen light, with its dispersion.";
    Aset: "aset", "ASET",
        "Angular Spectrum Evaluation Tool. Green is light from near the horizon, red is light from higher \
         up, blue is the cone of 30° that the observer's head blocks, and black leaks out behind.";
    AsetWhite: "aset-white", "ASET white", "ASET lit from behind: leakage is white.";
    Aset40: "aset-40", "ASET 40", "ASET with a blue cone of 40°, for an observer who is closer.";
    IdealScope: "ideal-scope", "Ideal-Scope",
        "Red is returned light, black is the observer's own shadow, and white leaks out behind.";
    Hearts: "hearts", "Hearts",
        "The hearts viewer, face down. Eight equal hearts need symmetric pavilion facets.";
    Arrows: "arrows", "Arrows", "The arrows viewer, face up: eight arrows from the pavilion mains.";
    Profile: "profile", "Profile",
        "The stone from the side with its proportions; drag its edges to change them.";
    Diagram: "diagram", "Facet diagram",
        "Crown and pavilion facets by tier, with their slopes, as cutters print them.";
    Refraction: "refraction", "Refraction map",
        "A background that moves behind the stone. A map of where the light comes from is traced once and \
         then looked up. Drag the background to \
         move it; drag with Ctrl to tilt the stone.";
    LiquidGlass: "liquid-glass", "Liquid glass",
        "A pane in front of the background as screens draw it, by formulas and without rays. Drag the pane \
         to move it.";
    TracedPane: "liquid-glass-traced", "Liquid glass, traced",
        "The same pane as real glass with the same outline, thickness, index and dispersion, traced ray by \
         ray.";
}
}

impl Shows {
    /// The variants that are exported as pictures of the stone.
    ///
    /// Refraction maps are exported as maps; panes of liquid glass are no pictures of the stone.
    pub const EXPORTED: &'static [Self] = Self::ALL.split_at(9).0;

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

    /// Returns whether the picture shows all copies in motion; else it shows the design alone, at rest.
    pub fn has_copies(self) -> bool {
        matches!(self, Self::Render | Self::Refraction)
    }

    /// Returns whether the picture shows the stone under light, from a side that can be chosen.
    pub fn is_seen(self) -> bool {
        !matches!(self, Self::Profile | Self::Diagram) && !self.is_pane()
    }

    /// Returns whether the picture is a pane of liquid glass, without the stone.
    pub fn is_pane(self) -> bool {
        matches!(self, Self::LiquidGlass | Self::TracedPane)
    }

    /// Returns whether the picture is chosen for a background, and says little of another document's stone.
    pub fn is_of_background(self) -> bool {
        self.is_pane() || self == Self::Refraction
    }

    /// Returns whether an overlay can be drawn over the picture.
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
