//! Takes one of the solids of a mesh, and says which others there are.

use crate::mesh_options::MeshPart;
use brillianteer_base::Fault;
use brillianteer_math::mending::{Mended, OpenPiece, SolidPart};
use brillianteer_math::{Surface, bounds};
use glam::DVec3;
use std::fmt::{self, Display, Formatter};

/// The number of sides of a box. A solid of no more is furniture, where there is another.
const BOX: usize = 6;

/// The least length of the difference between the normals of two sides.
const APART: f64 = 1e-3;

/// A solid is larger than another if its volume is more than this many times the other's: copies of one mesh differ by
/// rounding.
const LARGER: f64 = 1.0 + 1e-6;

/// The most solids that a list of them holds.
const MOST_LISTED: usize = 256;

/// The most solids and pieces that a message names.
const MOST_NAMED: usize = 8;

/// A body of a mesh that has several.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshBody {
    /// The number, from 1, by which it can be chosen; `None` for a piece that is no closed surface, which is left out.
    pub number: Option<usize>,
    /// The name in the file; may be empty.
    pub name: String,
    /// The number of its triangles.
    pub triangles: usize,
    /// Its lengths along the file's x, y and z, in the file's unit.
    pub extent: DVec3,
    /// The number of the body that it lies inside, if there is one.
    pub within: Option<usize>,
    /// True where the design was made of it.
    pub is_read: bool,
}

impl MeshBody {
    /// Returns whether one of the bodies may be chosen.
    pub fn leave_a_choice(bodies: &[Self]) -> bool {
        bodies.iter().filter(|body| body.number.is_some()).count() > 1
    }

    /// Describes the solid at a place among the parts, the one that is `chosen`, or each where all are.
    fn of(surface: &Surface, place: usize, part: &SolidPart, chosen: Option<usize>) -> Self {
        let corners = part.places().flat_map(|t| surface.triangles[t]);
        let (low, high) = bounds(corners.map(|corner| surface.vertices[corner as usize]));
        Self {
            number: Some(place + 1),
            name: part.name.clone(),
            triangles: part.triangles(),
            extent: high - low,
            within: part.within.map(|around| around + 1),
            is_read: chosen.is_none_or(|chosen| chosen == place),
        }
    }

    fn open(piece: OpenPiece) -> Self {
        let OpenPiece { name, triangles, extent } = piece;
        Self { number: None, name, triangles, extent, within: None, is_read: false }
    }
}

impl Display for MeshBody {
    /// Writes how messages call the body: by its number, its name and what is around it.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let count = counted(self.triangles);
        let within = self.within.map(|around| format!(", inside {around}")).unwrap_or_default();
        match (self.number, self.name.as_str()) {
            (Some(number), "") => write!(f, "{number} ({count}{within})"),
            (Some(number), name) => write!(f, "{number} `{name:.60}` ({count}{within})"),
            (None, "") => write!(f, "a part without a name ({count})"),
            (None, name) => write!(f, "`{name:.60}` ({count})"),
        }
    }
}

/// The solid that is read.
pub(super) struct ChosenPart {
    pub surface: Surface,
    /// Notes on the other solids.
    pub notes: Vec<String>,
    /// The warning about pieces that were left out because they are open.
    pub warning: Option<String>,
    /// The first of the solids, and behind them of the open pieces; empty where there is one in all.
    pub bodies: Vec<MeshBody>,
}

impl ChosenPart {
    /// Takes a solid. Where none is asked for and the file states that it `is_stated` as a whole, that whole is taken.
    ///
    /// # Errors
    /// Fails where there is no such solid; the error lists those that there are.
    pub fn of(
        mended: &Mended,
        open: Vec<OpenPiece>,
        asked: &MeshPart,
        is_stated: bool,
    ) -> Result<Self, Fault> {
        let parts = &mended.parts;
        let chosen = match asked {
            MeshPart::All => None,
            MeshPart::Found if is_stated => None,
            MeshPart::Found => largest(mended),
            MeshPart::Number(number) => {
                let place = number.checked_sub(1).filter(|place| *place < parts.len());
                Some(place.ok_or_else(|| missing(&number.to_string(), mended))?)
            }
            MeshPart::Named(name) => Some(named(name, mended)?),
        };
        let own = chosen.map(|place| &parts[place]);
        let is_whole = own.is_none_or(|part| part.triangles() == mended.surface.triangles.len());
        let surface = match own {
            Some(part) if !is_whole => mended.part(part),
            _ => mended.surface.clone(),
        };
        let hollow = own.filter(|part| part.cavities() > 0).map(|part| match part.cavities() {
            1 => "it is hollow: a shell inside it faces inward".to_owned(),
            count => format!("it is hollow: {count} shells inside it face inward"),
        });
        let notes = several(mended, chosen).into_iter().chain(hollow).collect();
        let closed = bodies(mended, chosen);
        let is_one = closed.len() + open.len() < 2;
        let open: Vec<MeshBody> = open.into_iter().map(MeshBody::open).collect();
        let warning = left_open(&open);
        let all = closed.into_iter().chain(open).take(if is_one { 0 } else { MOST_LISTED });
        Ok(Self { surface, notes, warning, bodies: all.collect() })
    }
}

/// Returns the note on a file of several solids, of which one is chosen, or all.
fn several(mended: &Mended, chosen: Option<usize>) -> Option<String> {
    let parts = &mended.parts;
    let count = parts.len();
    let read = chosen.map_or("all are read as one".to_owned(), |place| format!("{} is read", place + 1));
    let kind = if parts.iter().any(|part| part.within.is_some()) {
        "bodies are in the file, one inside another"
    } else {
        "separate bodies are in the file"
    };
    (count > 1).then(|| format!("{count} {kind}: {}; {read}", listed(&bodies(mended, chosen))))
}

/// Returns the solids of a surface, of which one is chosen, or all.
fn bodies(mended: &Mended, chosen: Option<usize>) -> Vec<MeshBody> {
    let parts = mended.parts.iter().enumerate();
    parts.map(|(place, part)| MeshBody::of(&mended.surface, place, part, chosen)).collect()
}

/// Returns the largest solid that is more than a box, or the largest of all; of equals the first.
fn largest(mended: &Mended) -> Option<usize> {
    let parts = &mended.parts;
    if parts.len() < 2 {
        return (!parts.is_empty()).then_some(0);
    }
    let has_facets: Vec<bool> = parts.iter().map(|part| sides(&mended.surface, part) > BOX).collect();
    let is_better = |one: usize, best: usize| match (has_facets[one], has_facets[best]) {
        (own, other) if own == other => parts[one].volume > LARGER * parts[best].volume,
        (own, _) => own,
    };
    (0..parts.len()).reduce(|best, one| if is_better(one, best) { one } else { best })
}

/// Returns the number of directions that the triangles of a solid face, as far as it is no more than one beyond [`BOX`].
fn sides(surface: &Surface, part: &SolidPart) -> usize {
    let mut found: Vec<DVec3> = vec![];
    for normal in part.places().filter_map(|t| surface.area_vector(t).try_normalize()) {
        if found.len() > BOX {
            break;
        }
        if found.iter().all(|other| other.distance(normal) > APART) {
            found.push(normal);
        }
    }
    found.len()
}

/// Returns the solid of a name, whatever the case of its letters.
fn named(name: &str, mended: &Mended) -> Result<usize, Fault> {
    let parts = &mended.parts;
    let is = |part: &SolidPart| part.name.to_lowercase() == name.trim().to_lowercase();
    let found: Vec<usize> = (0..parts.len()).filter(|&place| is(&parts[place])).collect();
    match found[..] {
        [] => Err(missing(&format!("`{name:.60}`"), mended)),
        [place] => Ok(place),
        _ => Err(Fault::whole(format!(
            "{} bodies are called `{name:.60}`; choose one by its number: {}",
            found.len(),
            listed(&bodies(mended, None))
        ))),
    }
}

fn missing(asked: &str, mended: &Mended) -> Fault {
    let all = listed(&bodies(mended, None));
    Fault::whole(format!("there is no body {asked} in the file, which has {all}"))
}

fn counted(triangles: usize) -> String {
    if triangles == 1 { "1 triangle".to_owned() } else { format!("{triangles} triangles") }
}

/// Joins how messages call bodies, up to a number of them.
fn listed(bodies: &[MeshBody]) -> String {
    let mut named: Vec<String> = bodies.iter().take(MOST_NAMED).map(ToString::to_string).collect();
    let more = bodies.len().saturating_sub(MOST_NAMED);
    named.extend((more > 0).then(|| format!("and {more} more")));
    named.join("; ")
}

/// Returns the warning about pieces that were left out because they are open.
fn left_open(pieces: &[MeshBody]) -> Option<String> {
    match pieces {
        [] => None,
        [piece] => Some(format!("{piece} is no closed surface and is left out")),
        pieces => {
            let count = pieces.len();
            Some(format!("{count} parts are no closed surfaces and are left out: {}", listed(pieces)))
        }
    }
}

#[cfg(test)]
mod tests;
