//! Takes one of the solids of a mesh, and says which others there are.

use crate::io::file_error::Fault;
use crate::io::mesh_options::MeshPart;
use crate::math::Surface;
use crate::math::mending::{Mended, OpenPiece, SolidPart};
use glam::DVec3;

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

/// The solid that is read.
pub(super) struct ChosenPart {
    pub surface: Surface,
    /// Notes on the other solids.
    pub notes: Vec<String>,
    /// How each of the first solids is called, in order; empty where there is one.
    pub parts: Vec<String>,
}

impl ChosenPart {
    /// Takes a solid. Where none is asked for and the file states that it `is_stated` as a whole, that whole is taken.
    ///
    /// # Errors
    /// Fails where there is no such solid; the error lists those that there are.
    pub fn of(mended: &Mended, asked: &MeshPart, is_stated: bool) -> Result<Self, Fault> {
        let parts = &mended.parts;
        let labels: Vec<String> = parts.iter().enumerate().map(|(place, part)| label(place, part)).collect();
        let chosen = match asked {
            MeshPart::All => None,
            MeshPart::Found if is_stated => None,
            MeshPart::Found => largest(mended),
            MeshPart::Number(number) => {
                let place = number.checked_sub(1).filter(|place| *place < parts.len());
                Some(place.ok_or_else(|| missing(&number.to_string(), &labels))?)
            }
            MeshPart::Named(name) => Some(named(name, parts, &labels)?),
        };
        let own = chosen.map(|place| &parts[place]);
        let is_whole = own.is_none_or(|part| part.triangles() == mended.surface.triangles.len());
        let surface = match own {
            Some(part) if !is_whole => mended.part(part),
            _ => mended.surface.clone(),
        };
        let several = (parts.len() > 1).then(|| {
            let read =
                chosen.map_or("all are read as one".to_owned(), |place| format!("{} is read", place + 1));
            let kind = if parts.iter().any(|part| part.within.is_some()) {
                "bodies are in the file, one inside another"
            } else {
                "separate bodies are in the file"
            };
            format!("{} {kind}: {}; {read}", parts.len(), listed(&labels, "; "))
        });
        let hollow = own.filter(|part| part.cavities() > 0).map(|part| match part.cavities() {
            1 => "it is hollow: a shell inside it faces inward".to_owned(),
            count => format!("it is hollow: {count} shells inside it face inward"),
        });
        let notes = several.into_iter().chain(hollow).collect();
        let listed = if parts.len() > 1 { labels.into_iter().take(MOST_LISTED).collect() } else { vec![] };
        Ok(Self { surface, notes, parts: listed })
    }
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
fn named(name: &str, parts: &[SolidPart], labels: &[String]) -> Result<usize, Fault> {
    let is = |part: &SolidPart| part.name.to_lowercase() == name.trim().to_lowercase();
    let found: Vec<usize> = (0..parts.len()).filter(|&place| is(&parts[place])).collect();
    match found[..] {
        [] => Err(missing(&format!("`{name:.60}`"), labels)),
        [place] => Ok(place),
        _ => Err(Fault::whole(format!(
            "{} bodies are called `{name:.60}`; choose one by its number: {}",
            found.len(),
            listed(labels, "; ")
        ))),
    }
}

fn missing(asked: &str, labels: &[String]) -> Fault {
    Fault::whole(format!("there is no body {asked} in the file, which has {}", listed(labels, "; ")))
}

/// Returns how a message calls a solid: by its number, its name and what is around it.
fn label(place: usize, part: &SolidPart) -> String {
    let name = if part.name.is_empty() { String::new() } else { format!(" `{:.60}`", part.name) };
    let within = part.within.map(|around| format!(", inside {}", around + 1)).unwrap_or_default();
    format!("{}{name} ({}{within})", place + 1, counted(part.triangles()))
}

fn counted(triangles: usize) -> String {
    if triangles == 1 { "1 triangle".to_owned() } else { format!("{triangles} triangles") }
}

/// Joins labels, up to a number of them.
fn listed(labels: &[String], joint: &str) -> String {
    let more = labels.len().saturating_sub(MOST_NAMED);
    let more = if more > 0 { format!("{joint}and {more} more") } else { String::new() };
    labels[..labels.len().min(MOST_NAMED)].join(joint) + &more
}

/// Returns the warning about pieces that were left out because they are open.
pub(super) fn left_open(pieces: &[OpenPiece]) -> Option<String> {
    let name = |piece: &OpenPiece| match piece.name.as_str() {
        "" => format!("a part without a name ({})", counted(piece.triangles)),
        name => format!("`{name:.60}` ({})", counted(piece.triangles)),
    };
    let names: Vec<String> = pieces.iter().map(name).collect();
    match pieces.len() {
        0 => None,
        1 => Some(format!("{} is no closed surface and is left out", names[0])),
        count => {
            Some(format!("{count} parts are no closed surfaces and are left out: {}", listed(&names, "; ")))
        }
    }
}

#[cfg(test)]
mod tests;
