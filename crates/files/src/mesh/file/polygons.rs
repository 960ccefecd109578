//! Gathers the polygons of a file as triangles.

use brillianteer_math::{Surface, polygon_triangles};
use glam::DVec3;
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

/// A surface to which polygons are added.
#[derive(Default)]
pub(super) struct Polygons {
    pub surface: Surface,
    /// The number of polygons of fewer than three corners, which are left out.
    pub short: usize,
    /// For the corners of each polygon of more than three, in any order, the corner at which it began.
    begun: HashMap<u64, u64>,
}

impl Polygons {
    /// Starts with corners and no polygon, in one group with a name.
    pub fn of(vertices: Vec<DVec3>, name: String) -> Self {
        let surface = Surface { names: vec![name], ..Surface::new(vertices, vec![]) };
        Self { surface, ..Self::default() }
    }

    /// Adds a polygon to the last group. All its corners must exist. A copy of an earlier polygon, in either sense, is
    /// divided into the same triangles, so that it can be recognised as a copy.
    pub fn add(&mut self, corners: &[u32]) {
        let group = self.surface.names.len().saturating_sub(1) as u32;
        if corners.len() < 3 {
            self.short += 1;
            return;
        }
        if let Ok(triangle) = corners.try_into() {
            self.surface.triangles.push(triangle);
            self.surface.groups.push(group);
            return;
        }
        let mut corners = corners.to_vec();
        self.rotate(&mut corners);
        let at: Vec<DVec3> = corners.iter().map(|&corner| self.surface.vertices[corner as usize]).collect();
        let triangles = polygon_triangles(&at);
        self.surface.groups.extend(triangles.iter().map(|_| group));
        self.surface.triangles.extend(triangles.into_iter().map(|t| t.map(|place| corners[place])));
    }

    /// Rotates a polygon so that it begins where the earlier one with the same corners does, if there is one.
    fn rotate(&mut self, corners: &mut [u32]) {
        let place = |corner: &u32| {
            let mut hasher = DefaultHasher::new();
            // Adding 0 turns -0 into 0, which compares equal to it.
            let at = self.surface.vertices[*corner as usize] + DVec3::ZERO;
            at.to_array().map(f64::to_bits).hash(&mut hasher);
            hasher.finish()
        };
        let places: Vec<u64> = corners.iter().map(place).collect();
        let mut sorted = places.clone();
        sorted.sort_unstable();
        let mut hasher = DefaultHasher::new();
        sorted.hash(&mut hasher);
        let first = *self.begun.entry(hasher.finish()).or_insert(places[0]);
        corners.rotate_left(places.iter().position(|&place| place == first).unwrap_or_default());
    }

    /// Returns a warning about the polygons that were left out, which the file calls by `word`.
    pub fn warning(&self, word: &str) -> Option<String> {
        (self.short > 0).then(|| format!("{} {word} of fewer than three corners are left out", self.short))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_of_a_polygon_makes_copies_of_its_triangles() {
        let flat = [(0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0), (-1.0, 3.0), (0.0, 2.0)];
        let vertices: Vec<DVec3> = flat.iter().map(|&(x, y)| DVec3::new(x, y, 0.5)).collect();
        let mut polygons = Polygons::of([vertices.clone(), vertices].concat(), String::new());
        polygons.add(&[0, 1, 2, 3, 4, 5]);
        polygons.add(&[9, 8, 7, 6, 11, 10]);
        polygons.add(&[0, 1]);
        let sorted = |t: &[u32; 3]| {
            let mut t = t.map(|corner| corner % 6);
            t.sort_unstable();
            t
        };
        let mut all: Vec<[u32; 3]> = polygons.surface.triangles.iter().map(sorted).collect();
        all.sort_unstable();
        assert_eq!((all.len(), polygons.short), (8, 1));
        assert!(all.as_chunks::<2>().0.iter().all(|[a, b]| a == b), "{all:?}");
    }
}
