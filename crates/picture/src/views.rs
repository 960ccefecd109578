//! The pictures that the program knows by name.
//!
//! To add a picture of exports, add a variant of `Picture` and a row to `PICTURES`. The compiler asks for most arms
//! in `crates/paper/src/export.rs`, `crates/paper/src/export/pictures.rs` and `src/cli/lists.rs`; look also at each
//! `Picture::Scoped` in `export.rs`. The editor shows a picture by a row of `crates/session/src/shows.rs` with the same key. A
//! scope of one's own needs no code: it is a file.

use brillianteer_scene::{ASET_CONE, Backing, Scope, Side, VIEWER_CONES_DEG};

/// A picture that has a name.
#[derive(Debug, Clone, PartialEq)]
pub enum Picture {
    /// The stone's light in a scope.
    Scoped(Scoped),
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

impl Scoped {
    /// Returns the common ASET; unless another scope is chosen, figures use its zones.
    pub fn aset() -> Self {
        Self { scope: Scope::aset(ASET_CONE, Backing::Black), side: None, takes_head: true }
    }

    /// Returns the scope with an observer's head of this half angle, in degrees, if it takes one.
    pub fn with_head(&self, half_angle: f64) -> Scope {
        self.scope.clone().with_head(if self.takes_head { half_angle } else { 0.0 })
    }
}

/// A picture's name, and the function that makes the picture.
type NamedPicture = (&'static str, fn(&str) -> Picture);

/// The pictures by name, in the order in which they are drawn.
const PICTURES: [NamedPicture; 9] = [
    ("aset", |_| Picture::Scoped(Scoped::aset())),
    ("aset-white", |_| scoped(Scope::aset(ASET_CONE, Backing::White), None, true)),
    ("aset-40", |_| scoped(Scope::aset(40.0, Backing::Black), None, true)),
    ("aset-40-white", |_| scoped(Scope::aset(40.0, Backing::White), None, true)),
    ("ideal-scope", |_| scoped(Scope::ideal_scope(IDEAL_SCOPE_HOLE), None, false)),
    ("hearts", |name| scoped(viewer(name, [226, 0, 40]), Some(Side::Culet), false)),
    ("arrows", |name| scoped(viewer(name, [0, 72, 186]), Some(Side::Table), false)),
    ("profile", |_| Picture::Profile),
    ("diagram", |_| Picture::Diagram),
];

fn scoped(scope: Scope, side: Option<Side>, takes_head: bool) -> Picture {
    Picture::Scoped(Scoped { scope, side, takes_head })
}

fn viewer(name: &str, colour: [u8; 3]) -> Scope {
    let (camera, ring) = VIEWER_CONES_DEG;
    Scope::hearts_and_arrows(name, camera, ring, colour)
}

/// Returns all names, in the order in which the pictures are drawn.
pub fn names() -> [&'static str; 9] {
    PICTURES.map(|(name, _)| name)
}

/// Returns the picture of this name; `None` if no picture has it.
pub fn named(name: &str) -> Option<Picture> {
    PICTURES.iter().find(|(known, _)| *known == name).map(|(name, picture)| picture(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_has_its_picture_and_every_scope_its_name() {
        for name in names() {
            match named(name) {
                Some(Picture::Scoped(s)) => {
                    assert_eq!(s.scope.name, name);
                    assert_eq!(s.scope.validate(), Ok(()), "{name}");
                }
                other => assert!(other.is_some() && (name == "profile" || name == "diagram"), "{name}"),
            }
        }
        assert_eq!(named("asset"), None);
    }
}
