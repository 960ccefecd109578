//! Virtual facets as wholes: all parts of the face through which light has met the same facets.
//!
//! Stored beams cover one domain of the picture's symmetry, whose borders cut virtual facets in parts. Parts belong
//! to one virtual facet if they have met the same facets; a part in another copy of the domain has met the images of
//! the facets.

use super::interval::Interval;
use brillianteer_base::{Stopped, Watch, go_on};
use brillianteer_math::random_bits::{GAMMA, mixed};
use brillianteer_math::{Basis, Plane, Polytope};
use brillianteer_trace::beam::Beams;
use glam::{DMat2, DVec3};
use std::collections::HashMap;
use std::f64::consts::FRAC_PI_4;

/// The virtual facets that have a part in the stored domain, by numbers from 0.
pub(super) struct VirtualFacets<'a> {
    beams: &'a Beams,
    /// The number of virtual facets.
    count: usize,
    /// The virtual facet of each beam in the domain itself.
    own: Vec<u32>,
    /// The parts of these virtual facets in the other copies of the domain, each as a beam and a virtual facet.
    others: Vec<(u32, u32)>,
}

impl<'a> VirtualFacets<'a> {
    /// Finds the parts that belong together. `polytope` must be the stone that was traced. Fails where `watch` asks to stop.
    pub fn of(beams: &'a Beams, polytope: &Polytope, watch: Watch) -> Result<Self, Stopped> {
        let copies = beams.symmetry.copies();
        let images: Vec<Vec<u64>> = copies.iter().map(|copy| images(polytope, &beams.view, copy)).collect();
        let mut numbers: HashMap<u64, u32> = HashMap::with_capacity(beams.len());
        let (mut own, mut others) = (Vec::with_capacity(beams.len()), vec![]);
        // The domain itself comes first. One copy after the other takes a fraction of the memory of all at once.
        for (copy, images) in images.iter().enumerate() {
            go_on(watch, copy as f64 / copies.len() as f64)?;
            let hashes = hashed_lists(beams, images);
            if copy == 0 {
                own.extend(hashes.into_iter().map(|hash| {
                    let next = numbers.len() as u32;
                    *numbers.entry(hash).or_insert(next)
                }));
                continue;
            }
            let found = (0..).zip(&hashes).filter_map(|(id, hash)| Some((id, *numbers.get(hash)?)));
            others.extend(found);
        }
        Ok(Self { beams, count: numbers.len(), own, others })
    }

    /// Adds up a number of each beam over the parts of whole virtual facets, and returns for each beam the sum of the virtual facet that
    /// it is a part of.
    fn wholes(&self, of_beam: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.count];
        for (&whole, value) in self.own.iter().zip(of_beam) {
            sums[whole as usize] += value;
        }
        for &(id, whole) in &self.others {
            sums[whole as usize] += of_beam[id as usize];
        }
        self.own.iter().map(|&whole| sums[whole as usize]).collect()
    }

    /// Returns the area of each beam's virtual facet, as an interval, because unfollowed parts may make it larger.
    pub fn areas(&self) -> Vec<Interval> {
        let beams = self.beams;
        let areas = self.wholes(&beams.iter().map(|beam| beam.area).collect::<Vec<_>>());
        let left: Vec<f64> = beams.iter().map(|beam| if beam.open { beam.area } else { 0.0 }).collect();
        let left = self.wholes(&left);
        // A part is missing where a part of any virtual facet on the way to it was not followed.
        let mut missing: Vec<f64> = Vec::with_capacity(areas.len());
        for beam in beams.iter() {
            let above = |parent: u32| missing[parent as usize] + left[parent as usize];
            missing.push(beam.parent.map_or(0.0, above));
        }
        areas.into_iter().zip(missing).map(|(area, missing)| Interval::from(area, missing)).collect()
    }

    /// Returns the part of the face in virtual facets of the strongest exits that are smaller than a circle of this
    /// diameter, girdle radii. Such a facet is where one exit outshines all others.
    pub fn smaller_than(&self, diameter: f64) -> Interval {
        let (beams, limit) = (self.beams, FRAC_PI_4 * diameter * diameter);
        let [mut decided, mut undecided] = [(); 2].map(|()| vec![0.0; beams.len()]);
        let cells = beams.strongest_exits();
        for cell in &cells {
            if let Some(exit) = cell.strongest {
                let sum = if cell.undecided { &mut undecided } else { &mut decided };
                sum[exit as usize] += beams.get(cell.outline).area;
            }
        }
        let [certain, possible] = [&decided, &undecided].map(|areas| self.wholes(areas));
        let share = f64::from(beams.symmetry.order()) / beams.silhouette_area;
        let sum = |is_small: &dyn Fn(usize) -> bool| {
            let small = decided.iter().enumerate().filter(|(k, _)| is_small(*k));
            small.fold(0.0, |sum, (_, area)| sum + area * share)
        };
        let least = sum(&|k| certain[k] + possible[k] < limit);
        let most = sum(&|k| certain[k] < limit) + beams.undecided(&cells);
        Interval { least, most }
    }
}

/// Returns for each beam the hash of the list of facets that it has met, with the images of the facets in a copy of the domain.
fn hashed_lists(beams: &Beams, images: &[u64]) -> Vec<u64> {
    let mut hashes: Vec<u64> = Vec::with_capacity(beams.len());
    for beam in beams.iter() {
        let before = beam.parent.map_or(0, |parent| hashes[parent as usize]);
        hashes.push(mixed((before ^ (images[beam.facet as usize] + 1)).wrapping_mul(GAMMA)));
    }
    hashes
}

/// Returns the number of the facet that a copy of the domain has in the place of each facet.
fn images(polytope: &Polytope, view: &Basis, copy: &DMat2) -> Vec<u64> {
    let facets = polytope.facets();
    if *copy == DMat2::IDENTITY {
        return (0..facets.len() as u64).collect();
    }
    let image = |plane: &Plane| {
        let n = plane.normal;
        view.lift(*copy * view.project(n)) + view.toward * view.toward.dot(n)
    };
    let off = |plane: &Plane, normal: DVec3, offset: f64| {
        plane.normal.distance_squared(normal) + (plane.offset - offset).powi(2)
    };
    let nearest = |plane: &Plane| {
        let normal = image(plane);
        let each = facets.iter().map(|facet| off(&facet.plane, normal, plane.offset));
        each.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(k, _)| k as u64)
    };
    facets.iter().map(|facet| nearest(&facet.plane)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_base::unwatched;
    use brillianteer_cut::TOLKOWSKY;
    use brillianteer_math::Plane;
    use brillianteer_scene::{Medium, View};
    use brillianteer_trace::beam::{BeamOptions, trace};

    fn stone() -> Polytope {
        let planes: Vec<Plane> = TOLKOWSKY.facets().unwrap().into_iter().map(|(_, plane)| plane).collect();
        Polytope::from_planes(&planes).unwrap()
    }

    fn beams(stone: &Polytope, symmetry: bool) -> Beams {
        let options = BeamOptions { unresolved: 0.01, symmetry, ..BeamOptions::default() };
        trace(stone, Medium::clear(2.4175), &View::default(), &options, &unwatched).unwrap()
    }

    #[test]
    fn facets_that_a_domain_cuts_are_as_large_as_without_symmetry() {
        let stone = stone();
        let (with, without) = (beams(&stone, true), beams(&stone, false));
        assert!(with.symmetry.order() == 16 && without.symmetry.order() == 1);
        let whole = |beams: &Beams| {
            let areas = VirtualFacets::of(beams, &stone, &unwatched).unwrap().areas();
            let lists = (0..beams.len() as u32).map(|id| beams.facets(id));
            lists.zip(areas).collect::<HashMap<Vec<u32>, Interval>>()
        };
        let (cut, all) = (whole(&with), whole(&without));
        let mut compared = 0;
        for (list, area) in &cut {
            let Some(other) = all.get(list) else { continue };
            let slack = 1e-9;
            assert!(area.least <= other.most + slack && other.least <= area.most + slack, "{list:?}");
            if area.error() == 0.0 && other.error() == 0.0 {
                assert!((area.least - other.least).abs() < slack, "{list:?}: {area:?}, {other:?}");
                compared += 1;
            }
        }
        assert!(compared > 300, "{compared}");
        // The table is one facet, although its domain is a sixteenth of it.
        let largest = cut.values().map(|area| area.least).fold(0.0, f64::max);
        assert!((largest - 0.9).abs() < 0.2, "{largest}");
    }

    #[test]
    fn every_facet_is_smaller_than_the_face_and_none_than_a_point() {
        let stone = stone();
        let beams = beams(&stone, true);
        let facets = VirtualFacets::of(&beams, &stone, &unwatched).unwrap();
        let undecided = beams.undecided(&beams.strongest_exits());
        let (none, all) = (facets.smaller_than(0.0), facets.smaller_than(4.0));
        assert_eq!(none, Interval::from(0.0, undecided));
        assert!((all.least + undecided - 1.0).abs() < 1e-9 && (all.most - 1.0).abs() < 1e-9, "{all:?}");
        let sizes = [0.02, 0.05, 0.1, 0.2, 0.4].map(|diameter| facets.smaller_than(diameter).middle());
        assert!(sizes.windows(2).all(|pair| pair[0] < pair[1]), "{sizes:?}");
    }
}
