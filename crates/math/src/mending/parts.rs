//! Tells apart the solids that a closed surface bounds.

use super::orient::Shell;
use super::{FLAT, Mended};
use crate::Surface;
use std::collections::{BTreeMap, HashMap};

/// A connected solid of a closed surface: its outer shell, and the shells of the cavities in it.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidPart {
    /// The name of the groups that most of its triangles have; may be empty.
    pub name: String,
    /// The volume within the outer shell, in the cube of the surface's unit.
    pub volume: f64,
    /// The solid that it lies inside, by its place among the parts, where one solid lies inside another.
    pub within: Option<usize>,
    /// The triangles of each shell, by their places in the surface: first the outer shell, then the cavities.
    shells: Vec<Vec<u32>>,
}

impl SolidPart {
    /// Returns the number of triangles.
    pub fn triangles(&self) -> usize {
        self.shells.iter().map(Vec::len).sum()
    }

    /// Returns the triangles, by their places in the surface.
    pub fn places(&self) -> impl Iterator<Item = usize> {
        self.shells.iter().flatten().map(|&t| t as usize)
    }

    /// Returns the number of cavities.
    pub fn cavities(&self) -> usize {
        self.shells.len() - 1
    }
}

impl Mended {
    /// Returns the closed surface of one part, turned outward.
    pub fn part(&self, part: &SolidPart) -> Surface {
        let mut own = taken(&self.surface, part.places());
        let (low, high) = own.bounds();
        let mut from = 0;
        for (place, shell) in part.shells.iter().enumerate() {
            let places = from..from + shell.len();
            let is_cavity = place > 0;
            if own.volume_of(places.clone(), (low + high) / 2.0).is_sign_negative() != is_cavity {
                own.triangles[places].iter_mut().for_each(|t| t.swap(1, 2));
            }
            from += shell.len();
        }
        own
    }
}

/// Returns the surface of some triangles, with their corners alone.
pub(super) fn taken(surface: &Surface, places: impl Iterator<Item = usize>) -> Surface {
    let mut own = Surface { names: surface.names.clone(), ..Surface::default() };
    let mut number = HashMap::new();
    for place in places {
        let triangle = surface.triangles[place].map(|corner| {
            *number.entry(corner).or_insert_with(|| {
                own.vertices.push(surface.vertices[corner as usize]);
                own.vertices.len() as u32 - 1
            })
        });
        own.triangles.push(triangle);
        own.groups.push(surface.groups[place]);
    }
    own
}

/// Returns the solids that shells bound.
///
/// A shell within another one bounds a cavity where it faced the other way than the outermost shell around it. Otherwise
/// it bounds a solid inside another.
pub(super) fn parts(surface: &Surface, shells: &[Shell]) -> Vec<SolidPart> {
    let (low, high) = surface.bounds();
    let size = surface.size();
    let volume = |shell: &Shell| {
        let places = || shell.triangles.iter().map(|&t| t as usize);
        let volume = surface.volume_of(places(), (low + high) / 2.0).abs();
        let area: f64 = places().map(|t| surface.area_vector(t).length()).sum();
        (volume > FLAT * area * size).then_some(volume)
    };
    let outermost = |mut shell: usize| {
        while let Some(around) = shells[shell].within {
            shell = around;
        }
        shell
    };
    let is_cavity = |shell: usize| shells[shell].was_inward != shells[outermost(shell)].was_inward;
    let mut number = BTreeMap::new();
    let mut parts = vec![];
    for (place, shell) in shells.iter().enumerate().filter(|(place, _)| !is_cavity(*place)) {
        let Some(volume) = volume(shell) else { continue };
        number.insert(place, parts.len());
        let name = name(surface, &shell.triangles);
        parts.push(SolidPart { name, volume, within: None, shells: vec![shell.triangles.clone()] });
    }
    for (place, shell) in shells.iter().enumerate() {
        // The nearest solid around a shell; the cavities between do not count.
        let mut around = shell.within;
        while let Some(cavity) = around.filter(|around| !number.contains_key(around)) {
            around = shells[cavity].within;
        }
        let solid = around.and_then(|around| number.get(&around).copied());
        match (number.get(&place), solid) {
            (Some(&own), solid) => parts[own].within = solid,
            (None, Some(solid)) if is_cavity(place) => parts[solid].shells.push(shell.triangles.clone()),
            _ => {}
        }
    }
    parts
}

/// Returns the name that most of these triangles have by their groups, if more than half of them have it.
pub(super) fn name(surface: &Surface, triangles: &[u32]) -> String {
    let mut counts = BTreeMap::<&str, usize>::new();
    for &t in triangles {
        let name = surface.names.get(surface.groups[t as usize] as usize).map_or("", |name| name.trim());
        *counts.entry(name).or_default() += 1;
    }
    let most = counts.into_iter().filter(|(name, _)| !name.is_empty()).max_by_key(|(_, count)| *count);
    most.filter(|(_, count)| 2 * count > triangles.len()).map(|(name, _)| name.to_owned()).unwrap_or_default()
}
