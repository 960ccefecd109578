//! The pictures that the program knows by name.
//!
//! To add a picture, add a variant and a row of `PictureName`; one that is no scope is a variant of `Picture` too, and the
//! compiler asks for its arms in `crates/paper/src/export.rs` and `export/pictures.rs`; look there and in `src/cli/export.rs` also at
//! each `Picture::Scoped` that is compared. `PictureName::ALL` lists it only if it stands there. The editor shows it by
//! a row of `crates/session/src/shows.rs` with the same key. A scope of one's own needs no code: it is a file.

use brillianteer_scene::{ASET_CONE, Backing, Scope, Side, VIEWER_CONES_DEG};

/// A picture of a stone.
#[derive(Debug, Clone, PartialEq)]
pub enum Picture {
    /// The stone's light in a scope.
    Scoped(Scoped),
    /// The contrast map: how much brighter or darker than the whole face each square is that an eye resolves.
    Contrast,
    /// The profile: the side view with its dimensions.
    Profile,
    /// The facet diagram: crown and pavilion with their tiers.
    Diagram,
}

/// A scope, and the side of the stone that it is for.
#[derive(Debug, Clone, PartialEq)]
pub struct Scoped {
    /// The scope's structured light.
    pub scope: Scope,
    /// The side that the scope is made for; `None` for either.
    pub side: Option<Side>,
    /// True where an observer's head may be added. Scopes with a hole for the eye have their own.
    pub takes_head: bool,
}

/// Half angle of the Ideal-Scope's hole, in degrees. It is the widest of the 10 to 15 that are described, and the
/// narrowest at which ideal cuts have the whole dark arrows of graders' pictures (docs/optics.md, "Ideal-Scope's hole").
const IDEAL_SCOPE_HOLE: f64 = 15.0;

/// Half angle of the head's cone for an observer who is closer, in degrees.
const CLOSE_CONE: f64 = 40.0;

impl Scoped {
    /// Returns the common ASET; unless another scope is chosen, figures use its zones.
    pub fn aset() -> Self {
        Self { scope: Scope::aset(ASET_CONE, Backing::Black), side: None, takes_head: true }
    }

    /// Returns the Ideal-Scope.
    pub fn ideal_scope() -> Self {
        Self { scope: Scope::ideal_scope(IDEAL_SCOPE_HOLE), side: None, takes_head: false }
    }

    /// Returns the viewer of hearts, which looks at the pavilion.
    pub fn hearts() -> Self {
        Self::viewer("hearts", [226, 0, 40], Side::Culet)
    }

    /// Returns the viewer of arrows, which looks at the table.
    pub fn arrows() -> Self {
        Self::viewer("arrows", [0, 72, 186], Side::Table)
    }

    fn viewer(name: &str, colour: [u8; 3], side: Side) -> Self {
        let (camera, ring) = VIEWER_CONES_DEG;
        let scope = Scope::hearts_and_arrows(name, camera, ring, colour);
        Self { scope, side: Some(side), takes_head: false }
    }

    fn aset_of(cone_deg: f64, backing: Backing) -> Self {
        Self { scope: Scope::aset(cone_deg, backing), ..Self::aset() }
    }

    /// Returns the scope with an observer's head of this half angle, in degrees, if it takes one.
    pub fn with_head(&self, half_angle: f64) -> Scope {
        self.scope.clone().with_head(if self.takes_head { half_angle } else { 0.0 })
    }
}

/// The pictures that have a name, in the order in which they are drawn and listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PictureName {
    /// The common ASET.
    Aset,
    /// The common ASET, lit from behind.
    AsetWhite,
    /// The ASET for an observer who is closer.
    Aset40,
    /// The ASET for an observer who is closer, lit from behind.
    Aset40White,
    /// The Ideal-Scope.
    IdealScope,
    /// The viewer of hearts.
    Hearts,
    /// The viewer of arrows.
    Arrows,
    /// The contrast map.
    Contrast,
    /// The profile.
    Profile,
    /// The facet diagram.
    Diagram,
}

impl PictureName {
    /// All names.
    pub const ALL: [Self; 10] = [
        Self::Aset,
        Self::AsetWhite,
        Self::Aset40,
        Self::Aset40White,
        Self::IdealScope,
        Self::Hearts,
        Self::Arrows,
        Self::Contrast,
        Self::Profile,
        Self::Diagram,
    ];

    /// Returns the name as users write it, and as it stands in the names of files.
    pub fn key(self) -> &'static str {
        match self {
            Self::Aset => "aset",
            Self::AsetWhite => "aset-white",
            Self::Aset40 => "aset-40",
            Self::Aset40White => "aset-40-white",
            Self::IdealScope => "ideal-scope",
            Self::Hearts => "hearts",
            Self::Arrows => "arrows",
            Self::Contrast => "contrast",
            Self::Profile => "profile",
            Self::Diagram => "diagram",
        }
    }

    /// Returns the name that users write so; `None` if there is none.
    pub fn of_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|name| name.key() == key)
    }

    /// Returns the picture of this name.
    pub fn picture(self) -> Picture {
        Picture::Scoped(match self {
            Self::Aset => Scoped::aset(),
            Self::AsetWhite => Scoped::aset_of(ASET_CONE, Backing::White),
            Self::Aset40 => Scoped::aset_of(CLOSE_CONE, Backing::Black),
            Self::Aset40White => Scoped::aset_of(CLOSE_CONE, Backing::White),
            Self::IdealScope => Scoped::ideal_scope(),
            Self::Hearts => Scoped::hearts(),
            Self::Arrows => Scoped::arrows(),
            Self::Contrast => return Picture::Contrast,
            Self::Profile => return Picture::Profile,
            Self::Diagram => return Picture::Diagram,
        })
    }

    /// Returns the scope of this name; `None` where the picture is not one in a scope.
    pub fn scoped(self) -> Option<Scoped> {
        match self.picture() {
            Picture::Scoped(scoped) => Some(scoped),
            Picture::Contrast | Picture::Profile | Picture::Diagram => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_has_its_picture_and_every_scope_its_name() {
        for name in PictureName::ALL {
            assert_eq!(PictureName::of_key(name.key()), Some(name));
            if let Some(scoped) = name.scoped() {
                assert_eq!((scoped.scope.name.as_str(), scoped.scope.validate()), (name.key(), Ok(())));
            }
        }
        assert_eq!(PictureName::of_key("asset"), None);
    }
}
