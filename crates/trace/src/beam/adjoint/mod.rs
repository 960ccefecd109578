//! The exact derivatives of a sum over beams by the planes of the stone and by its index, followed back along the
//! beams.
//!
//! A sum over beams depends on their weights, on the directions of their exits and on the areas of their outlines.
//! Each of these is a smooth function of the planes that the beam has met, as long as it meets the same planes. Areas
//! change only where their edges move. An edge is the line f(x) = 0 on which the point that the beam has reached on
//! one facet lies on the plane of a neighbour. Moving the edge changes the area by |edge| / |∇f| times the change of
//! f in the edge's middle. So no corner is differentiated, and meets of many facets do no harm. One pass from the
//! last beams to the first finds all derivatives of one sum (reverse accumulation: A. Griewank and A. Walther,
//! Evaluating Derivatives, 2nd ed., 2008, chapter 3).

mod copies;
mod fan;
mod pass;
mod step;

use super::tree::Beams;
use brillianteer_base::{Stopped, Watch};
use brillianteer_math::Polytope;
use glam::DVec3;
use pass::ReversePass;

/// The number of beams after which a pass over beams calls its watch again: far below a millisecond of work.
const WATCHED: u32 = 1024;

/// The derivatives of a sum by the results of each beam, from which [`Beams::derivatives`] starts. Each list has one
/// entry for each beam.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamPartials {
    /// The derivative by the energy of the beam's exit, which is its weight times the area of its outline.
    pub energy: Vec<f64>,
    /// The derivative by the area of the beam's outline while all energies stay.
    pub area: Vec<f64>,
    /// The derivative by the direction of the beam's exit.
    pub exit: Vec<DVec3>,
    /// The derivative by the energy absorbed on the beam's last way, [`Beam::absorbed`](super::Beam::absorbed).
    pub absorbed: Vec<f64>,
}

impl BeamPartials {
    /// Returns the derivatives of a sum that depends on none of this many beams.
    pub fn none(count: usize) -> Self {
        Self {
            energy: vec![0.0; count],
            area: vec![0.0; count],
            exit: vec![DVec3::ZERO; count],
            absorbed: vec![0.0; count],
        }
    }
}

/// The derivatives of a number by the planes of a stone and by its index.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneDerivatives {
    /// For each facet, the derivative by its unit normal; only the component perpendicular to the normal has a
    /// meaning.
    pub normals: Vec<DVec3>,
    /// For each facet, the derivative by its offset, in girdle radii.
    pub offsets: Vec<f64>,
    /// The derivative by the refractive index.
    pub index: f64,
}

impl PlaneDerivatives {
    /// Returns the derivatives of a number that depends on none of this many facets.
    pub(super) fn none(facets: usize) -> Self {
        Self { normals: vec![DVec3::ZERO; facets], offsets: vec![0.0; facets], index: 0.0 }
    }

    /// Adds the derivatives of another number by the same planes.
    pub fn add(&mut self, other: &Self) {
        for (own, by) in self.normals.iter_mut().zip(&other.normals) {
            *own += *by;
        }
        for (own, by) in self.offsets.iter_mut().zip(&other.offsets) {
            *own += by;
        }
        self.index += other.index;
    }

    /// Returns the change of the number when each facet's normal and offset change by these amounts, in the order of
    /// the facets.
    pub fn along(&self, changes: impl IntoIterator<Item = (DVec3, f64)>) -> f64 {
        let own = self.normals.iter().zip(&self.offsets);
        own.zip(changes).map(|((n, o), (by_n, by_o))| n.dot(by_n) + o * by_o).sum()
    }
}

impl Beams {
    /// Returns the derivatives of a sum over these beams by the planes of all facets of `polytope`, which must be the
    /// one that was traced, and by the index.
    ///
    /// They are the derivatives of the sum over the followed beams of the stored domain of the symmetry, each between
    /// its borders. Where a beam begins or ceases to leave the stone, or where its exit crosses a border of the
    /// light, sums have kinks or jumps, which no derivative shows. The sum of the whole picture changes by the symmetry's
    /// order times as much where the planes change and keep the symmetry; [`over_copies`](Self::over_copies) finds the
    /// derivatives by single planes. The coefficients of absorption are
    /// held constant.
    ///
    /// # Errors
    /// Fails where `watch` asks to stop.
    pub fn derivatives(
        &self,
        polytope: &Polytope,
        partials: &BeamPartials,
        watch: Watch,
    ) -> Result<PlaneDerivatives, Stopped> {
        let pass = ReversePass::new(self, polytope, &|done| watch(0.5 * done))?;
        pass.run(partials, &|done| watch(0.5 + 0.5 * done))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{BeamOptions, grow::trace_bounces};
    use super::*;
    use brillianteer_base::unwatched;
    use brillianteer_cut::TOLKOWSKY;
    use brillianteer_math::Plane;
    use brillianteer_scene::{Medium, View};

    const BOUNCES: u32 = 5;

    fn weighed(exit: DVec3) -> f64 {
        exit.z.max(0.0).powi(2) + 0.3 * exit.x
    }

    /// Sums the light that leaves, weighted by a smooth function of direction, and a part of the light that is
    /// absorbed, in one domain of the symmetry.
    fn sum(beams: &Beams) -> f64 {
        beams.iter().map(|beam| beam.weight * beam.area * weighed(beam.exit) + 0.4 * beam.absorbed).sum()
    }

    fn partials(beams: &Beams) -> BeamPartials {
        let mut partials = BeamPartials::none(beams.len());
        partials.absorbed.fill(0.4);
        for (k, beam) in beams.iter().enumerate().filter(|(_, beam)| beam.weight > 0.0) {
            partials.energy[k] = weighed(beam.exit);
            let slope = DVec3::new(0.3, 0.0, 2.0 * beam.exit.z.max(0.0));
            partials.exit[k] = slope * (beam.weight * beam.area);
        }
        partials
    }

    /// Returns the central difference of fourth order of a function at 0.
    fn difference(step: f64, of: impl Fn(f64) -> f64) -> f64 {
        (8.0 * (of(step) - of(-step)) - (of(2.0 * step) - of(-2.0 * step))) / (12.0 * step)
    }

    struct Case {
        absorption: [f64; 2],
        view: View,
        options: BeamOptions,
    }

    impl Case {
        fn medium(&self, index: f64) -> Medium {
            Medium { absorption: self.absorption, ..Medium::clear(index) }
        }

        fn sum(&self, planes: &[Plane], index: f64) -> (f64, Beams, Polytope) {
            let stone = Polytope::from_planes(planes).unwrap();
            let beams = trace_bounces(&stone, self.medium(index), &self.view, &self.options, BOUNCES);
            (sum(&beams), beams, stone)
        }
    }

    #[test]
    fn derivatives_by_every_plane_and_by_the_index_are_those_of_differences() {
        let mut state = 0.5;
        // Numbers spread evenly over -1 to 1 by the golden section.
        let mut some = |by: f64| {
            state = f64::fract(state + 0.618_033_988_749_895);
            by * (2.0 * state - 1.0)
        };
        for (polarised, absorption) in
            [(true, [0.0; 2]), (false, [0.0; 2]), (true, [0.3; 2]), (false, [0.9, 0.2])]
        {
            let options = BeamOptions { symmetry: false, polarised, ..BeamOptions::default() };
            let case =
                Case { absorption, view: View { tilt: 0.13, azimuth: 0.4, ..View::default() }, options };
            // Planes that are slightly off meet by threes, so that each may move alone.
            let planes: Vec<Plane> = TOLKOWSKY
                .facets()
                .unwrap()
                .into_iter()
                .filter(|(name, _)| !name.starts_with("girdle"))
                .map(|(_, plane)| {
                    let off = DVec3::new(some(0.01), some(0.01), some(0.01));
                    let normal = (plane.normal + off).normalize_or_zero();
                    Plane { normal, offset: plane.offset + some(0.01) }
                })
                .collect();
            let (_, beams, stone) = case.sum(&planes, 2.4);
            let found = beams.derivatives(&stone, &partials(&beams), &unwatched).unwrap();
            assert!(beams.len() > 3000, "{}", beams.len());
            let by_index = difference(1e-5, |h| case.sum(&planes, 2.4 + h).0);
            assert!((found.index / by_index - 1.0).abs() < 1e-6, "{} is not {by_index}", found.index);
            for (k, facet) in stone.facets().iter().enumerate().step_by(3) {
                let at =
                    planes.iter().position(|plane| plane.normal.distance(facet.plane.normal) < 1e-9).unwrap();
                let (axis, _) = facet.plane.normal.any_orthonormal_pair();
                let moved = |by_normal: f64, by_offset: f64| {
                    let mut planes = planes.clone();
                    planes[at].normal = facet.plane.normal * by_normal.cos() + axis * by_normal.sin();
                    planes[at].offset += by_offset;
                    case.sum(&planes, 2.4).0
                };
                let turned = difference(1e-6, |h| moved(h, 0.0));
                let shifted = difference(1e-6, |h| moved(0.0, h));
                for (own, other) in [(found.normals[k].dot(axis), turned), (found.offsets[k], shifted)] {
                    assert!(
                        (own - other).abs() < 1e-6 * other.abs().max(1.0),
                        "facet {k}: {own} is not {other}"
                    );
                }
            }
        }
    }
}
