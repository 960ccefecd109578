//! The pictures and drawings that a view can show.
//!
//! To add one, add a row; those that exports offer stand first, and `EXPORTED` counts them. The compiler asks for its name in
//! `Shows::picture`, for what it depends on in `Shot::subject` (`studio/order.rs`), and, of one that is no picture in a scope, how it
//! is taken (`studio/take.rs`, with its job in `studio/jobs.rs`). What it is say also `is_seen`, `needs_facets`, `takes_perspective`,
//! `takes_overlay` and `has_copies`, for which the compiler does not ask. `crates/editor/src/views` draws what is not traced
//! (`pane.rs`), and legends (`scene_view.rs`).

use crate::described::described;
use brillianteer_picture::{Picture, PictureName, Scoped};
use brillianteer_scene::Side;
use serde::{Deserialize, Serialize};

described! {
/// The picture in a view. Its key is that of its [`PictureName`] where it has one.
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
    Contrast: "contrast", "Contrast map",
        "How much brighter or darker each place is than the whole face, as finely as an eye resolves the stone at 25 cm, under \
         an even sky with the observer's head. Gold is brighter, grey as bright, blue darker.";
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
    pub const EXPORTED: &'static [Self] = Self::ALL.split_at(10).0;

    /// Returns the name of the picture that exports and the command line make of it; `None` where they make none.
    pub fn picture(self) -> Option<PictureName> {
        match self {
            Self::Aset => Some(PictureName::Aset),
            Self::AsetWhite => Some(PictureName::AsetWhite),
            Self::Aset40 => Some(PictureName::Aset40),
            Self::IdealScope => Some(PictureName::IdealScope),
            Self::Hearts => Some(PictureName::Hearts),
            Self::Arrows => Some(PictureName::Arrows),
            Self::Contrast => Some(PictureName::Contrast),
            Self::Profile => Some(PictureName::Profile),
            Self::Diagram => Some(PictureName::Diagram),
            Self::Render | Self::Refraction | Self::LiquidGlass | Self::TracedPane => None,
        }
    }

    /// Returns how the picture is made.
    pub fn kind(self) -> ShowsKind {
        match (self, self.picture().map(PictureName::picture)) {
            (_, Some(picture)) => ShowsKind::Picture(picture),
            (Self::Refraction, None) => ShowsKind::Refraction,
            (Self::LiquidGlass, None) => ShowsKind::LiquidGlass,
            (Self::TracedPane, None) => ShowsKind::TracedPane,
            (_, None) => ShowsKind::Render,
        }
    }

    /// Returns the scope that the stone is seen in, if any.
    pub fn scoped(self) -> Option<Scoped> {
        self.picture().and_then(PictureName::scoped)
    }

    /// Returns whether the picture is one of stones with flat facets alone.
    pub fn needs_facets(self) -> bool {
        matches!(self, Self::Contrast | Self::Profile | Self::Diagram)
    }

    /// Returns whether the stone can be seen from nearby; a contrast map is of parallel rays.
    pub fn takes_perspective(self) -> bool {
        self.is_seen() && self != Self::Contrast
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

/// How a picture is made.
#[derive(Debug, Clone, PartialEq)]
pub enum ShowsKind {
    /// Stones under light.
    Render,
    /// A picture that exports make as well.
    Picture(Picture),
    /// A background, looked up in a refraction map.
    Refraction,
    /// A pane that formulas draw.
    LiquidGlass,
    /// A pane that is traced.
    TracedPane,
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
        let named = |s: &Shows| s.picture().is_none_or(|name| name.key() == s.key());
        assert!(Shows::ALL.iter().all(named));
        let renders = Shows::ALL.into_iter().filter(|s| s.kind() == ShowsKind::Render);
        assert_eq!(renders.collect::<Vec<_>>(), [Shows::Render]);
    }
}
