//! How a sum over beams changes with the planes of the stone and with its index: exact derivatives, followed back along the
//! beams.
//!
//! A sum over beams depends on their weights, on the directions of their exits and on the areas of their outlines. Each of
//! these is a smooth function of the planes that the beam has met, as long as it meets the same ones. Areas change only
//! where their edges move: an edge is the line on which the point that the beam has reached on one facet lies on the plane
//! of a neighbour, f(x) = 0, and moving it changes the area by |edge| / |∇f| times the change of f in the edge's middle. So no
//! corner is differentiated, and meets of many facets do no harm. All derivatives of one sum are found in one pass from
//! the last beams to the first (reverse accumulation: A. Griewank and A. Walther, Evaluating Derivatives, 2nd ed., 2008,
//! chapter 3).

use super::adjoint_step::{BeamState, LandingStep, StateAdjoint};
use super::tree::{BeamNode, Beams, NO_EXIT, ROOT};
use crate::math::{Affine, Polytope};
use glam::{DVec2, DVec3};

/// Lines of an image nearer than this to one another count as one; lengths are in girdle radii.
const SAME_LINE: f64 = 1e-9;

/// The number that stands for an edge that does not move.
const FIXED: u32 = u32::MAX;

/// How a sum over beams changes with each beam, which is what [`Beams::derivatives`] starts from. All lists have one entry
/// for each beam.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamPartials {
    /// The change per weight of the beam's exit.
    pub weight: Vec<f64>,
    /// The change per area of the beam's outline.
    pub area: Vec<f64>,
    /// The change per direction of the beam's exit.
    pub exit: Vec<DVec3>,
}

impl BeamPartials {
    /// Makes the partial derivatives of a sum that does not depend on any of this many beams.
    pub fn none(count: usize) -> Self {
        Self { weight: vec![0.0; count], area: vec![0.0; count], exit: vec![DVec3::ZERO; count] }
    }
}

/// How a number changes with the planes of a stone and with its index.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneDerivatives {
    /// For each facet of the polytope, the change per unit normal; only its part square to the normal means anything.
    pub normals: Vec<DVec3>,
    /// For each facet, the change per offset, in girdle radii.
    pub offsets: Vec<f64>,
    /// The change per refractive index.
    pub index: f64,
}

impl PlaneDerivatives {
    /// Returns the change when each facet's normal and offset change by these amounts, in the order of the facets.
    pub fn along(&self, changes: impl IntoIterator<Item = (DVec3, f64)>) -> f64 {
        let own = self.normals.iter().zip(&self.offsets);
        own.zip(changes).map(|((n, o), (by_n, by_o))| n.dot(by_n) + o * by_o).sum()
    }
}

/// The line that an edge of an outline lies on: where the point that the beam `level` reaches lies on the plane of `facet`.
#[derive(Debug, Clone, Copy)]
struct EdgeLine {
    /// A beam's id, or [`FIXED`] for the border of a domain of the symmetry.
    level: u32,
    facet: u32,
}

impl Beams {
    /// Returns how a sum over these beams changes with the planes of all facets of `polytope`, which must be the one that was
    /// traced, and with the index.
    ///
    /// They are the derivatives of the sum over the stored domain of the symmetry, of the beams that were followed, each
    /// between its borders: where a beam begins or ceases to leave the stone, or its exit crosses a border of the light, sums
    /// have kinks or jumps, which no derivative shows. Where the planes change and keep the symmetry, the whole picture's
    /// sum changes by this times the symmetry's order. `None` where the stone absorbs light.
    pub fn derivatives(&self, polytope: &Polytope, partials: &BeamPartials) -> Option<PlaneDerivatives> {
        if !self.medium.is_clear() {
            return None;
        }
        let mut pass = ReversePass::new(self, polytope);
        for id in (0..self.len() as u32).rev() {
            pass.step(id, partials);
        }
        Some(pass.found)
    }
}

struct ReversePass<'a> {
    beams: &'a Beams,
    polytope: &'a Polytope,
    states: Vec<BeamState>,
    adjoints: Vec<StateAdjoint>,
    /// For each corner of the beams, the line of the edge that begins there.
    lines: Vec<EdgeLine>,
    /// For the first corner of each outline, the change per area.
    areas: Vec<f64>,
    found: PlaneDerivatives,
}

impl<'a> ReversePass<'a> {
    fn new(beams: &'a Beams, polytope: &'a Polytope) -> Self {
        let count = polytope.facets().len();
        let mut pass = Self {
            beams,
            polytope,
            states: Vec::with_capacity(beams.len()),
            adjoints: vec![StateAdjoint::default(); beams.len()],
            lines: vec![EdgeLine { level: FIXED, facet: 0 }; beams.corners.len()],
            areas: vec![0.0; beams.corners.len()],
            found: PlaneDerivatives {
                normals: vec![DVec3::ZERO; count],
                offsets: vec![0.0; count],
                index: 0.0,
            },
        };
        for id in 0..beams.len() as u32 {
            let node = &beams.nodes[id];
            let plane = polytope.facets()[node.facet as usize].plane;
            let state = match node.parent {
                ROOT => BeamState::entered(beams, &plane),
                parent => LandingStep::new(&pass.states[parent as usize], &plane, beams).after,
            };
            pass.states.push(state);
            if pass.is_cut_here(node) {
                pass.find_lines(id);
            }
        }
        pass
    }

    /// Whether a beam has an outline of its own.
    fn is_cut_here(&self, node: &BeamNode) -> bool {
        node.parent == ROOT || self.beams.nodes[node.parent].corners != node.corners
    }

    /// Finds the line of each edge of a beam's outline: one of the outline that it was cut from, or one beyond which a
    /// neighbour of its facet is met.
    fn find_lines(&mut self, id: u32) {
        let node = &self.beams.nodes[id];
        let outline = self.beams.outline(node);
        let before: Vec<(Affine, EdgeLine)> = match node.parent {
            ROOT => {
                let fixed = EdgeLine { level: FIXED, facet: 0 };
                self.beams.symmetry.domain().into_iter().map(|half| (half, fixed)).collect()
            }
            parent => {
                let parent = &self.beams.nodes[parent];
                let (all, first) = (self.beams.outline(parent), parent.corners.0 as usize);
                let through = |k: usize| {
                    let (a, b) = (all[k], all[(k + 1) % all.len()]);
                    let across = (b - a).perp();
                    (Affine::new(-across.dot(a), across), self.lines[first + k])
                };
                (0..all.len()).map(through).collect()
            }
        };
        let neighbours = &self.polytope.facets()[node.facet as usize].neighbours;
        let cuts: Vec<(Affine, EdgeLine)> =
            neighbours.iter().map(|&n| (self.inside(id, n), EdgeLine { level: id, facet: n })).collect();
        for k in 0..outline.len() {
            let (a, b) = (outline[k], outline[(k + 1) % outline.len()]);
            let off = |line: &Affine| {
                let most = line.at(a).abs().max(line.at(b).abs());
                let slope = line.gradient.length();
                if slope > 0.0 { most / slope } else { f64::INFINITY }
            };
            // Where both kinds fit, the splitting has left the former edge in place.
            let own = before.iter().map(|(line, at)| (off(line) - SAME_LINE, at));
            let nearest = own.chain(cuts.iter().map(|(line, at)| (off(line), at)));
            if let Some((_, &line)) = nearest.min_by(|a, b| a.0.total_cmp(&b.0)) {
                self.lines[node.corners.0 as usize + k] = line;
            }
        }
    }

    /// Returns how deep inside the plane of `facet` the points lie that a beam reaches, over the image.
    fn inside(&self, id: u32, facet: u32) -> Affine {
        let plane = &self.polytope.facets()[facet as usize].plane;
        let [o, u, v] = self.states[id as usize].origin;
        Affine::new(
            plane.offset - plane.normal.dot(o),
            DVec2::new(-plane.normal.dot(u), -plane.normal.dot(v)),
        )
    }

    /// Follows the changes of one beam back to the one that it came from.
    fn step(&mut self, id: u32, partials: &BeamPartials) {
        let beams = self.beams;
        let (node, k) = (&beams.nodes[id], id as usize);
        self.areas[node.corners.0 as usize] += partials.area[k];
        if self.is_cut_here(node) {
            self.move_edges(node);
        }
        let facet = node.facet as usize;
        let plane = self.polytope.facets()[facet].plane;
        let leaving =
            if node.exit == NO_EXIT { (0.0, DVec3::ZERO) } else { (partials.weight[k], partials.exit[k]) };
        let after = self.adjoints[k];
        let (normal, offset, index) = match node.parent {
            ROOT => self.states[k].pull_back_entry(beams, &plane, &after, leaving),
            parent => {
                let step = LandingStep::new(&self.states[parent as usize], &plane, beams);
                let back = step.pull_back(&after, leaving);
                self.adjoints[parent as usize].add(&back.before);
                (back.normal, back.offset, back.index)
            }
        };
        self.found.normals[facet] += normal;
        self.found.offsets[facet] += offset;
        self.found.index += index;
    }

    /// Turns the change per area of an outline into changes of what places its edges.
    fn move_edges(&mut self, node: &BeamNode) {
        let outline = self.beams.outline(node);
        let per_area = self.areas[node.corners.0 as usize];
        if per_area == 0.0 {
            return;
        }
        for k in 0..outline.len() {
            let EdgeLine { level, facet } = self.lines[node.corners.0 as usize + k];
            if level == FIXED {
                continue;
            }
            let (a, b) = (outline[k], outline[(k + 1) % outline.len()]);
            let slope = self.inside(level, facet).gradient.length();
            let by = per_area * a.distance(b) / slope;
            if !by.is_finite() {
                continue;
            }
            let middle = (a + b) / 2.0;
            let normal = self.polytope.facets()[facet as usize].plane.normal;
            let [o, u, v] = self.states[level as usize].origin;
            self.found.offsets[facet as usize] += by;
            self.found.normals[facet as usize] -= (o + u * middle.x + v * middle.y) * by;
            let at = &mut self.adjoints[level as usize].origin;
            at[0] -= normal * by;
            at[1] -= normal * (by * middle.x);
            at[2] -= normal * (by * middle.y);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::BeamOptions;
    use super::super::grow::trace_bounces;
    use super::*;
    use crate::cut::TOLKOWSKY;
    use crate::math::Plane;
    use crate::scene::{Medium, View};

    const BOUNCES: u32 = 5;

    fn weighed(exit: DVec3) -> f64 {
        exit.z.max(0.0).powi(2) + 0.3 * exit.x
    }

    /// Sums what leaves in a smooth light, of one domain of the symmetry.
    fn sum(beams: &Beams) -> f64 {
        beams.iter().map(|beam| beam.weight * beam.area * weighed(beam.exit)).sum()
    }

    fn partials(beams: &Beams) -> BeamPartials {
        let mut partials = BeamPartials::none(beams.len());
        for (k, beam) in beams.iter().enumerate().filter(|(_, beam)| beam.weight > 0.0) {
            partials.weight[k] = beam.area * weighed(beam.exit);
            partials.area[k] = beam.weight * weighed(beam.exit);
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
        view: View,
        options: BeamOptions,
    }

    impl Case {
        fn sum(&self, planes: &[Plane], index: f64) -> (f64, Beams, Polytope) {
            let stone = Polytope::from_planes(planes).unwrap();
            let beams = trace_bounces(&stone, Medium::clear(index), &self.view, &self.options, BOUNCES);
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
        for polarised in [true, false] {
            let options = BeamOptions { symmetry: false, polarised, ..BeamOptions::default() };
            let case = Case { view: View { tilt: 0.13, azimuth: 0.4, ..View::default() }, options };
            // Planes that are off by a little meet by threes, so that each may move alone.
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
            let found = beams.derivatives(&stone, &partials(&beams)).unwrap();
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
