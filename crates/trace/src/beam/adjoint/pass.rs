//! The pass over all beams, from the last to the first, that gathers the derivatives of one sum.

use super::super::tree::{BeamNode, Beams, NO_EXIT, ROOT};
use super::WATCHED;
use super::step::{BeamState, LandingStep, StateAdjoint};
use super::{BeamPartials, PlaneDerivatives};
use brillianteer_base::{Stopped, Watch, go_on};
use brillianteer_math::{Affine, Moments, Polytope, moments_along_edge, moments_of_decay};
use glam::{DVec2, DVec3};

/// Lines of an image that are nearer than this to one another count as one; the unit is the girdle radius.
const SAME_LINE: f64 = 1e-9;

/// The number that stands for an edge that does not move.
const FIXED: u32 = u32::MAX;

/// The line that contains an edge of an outline: the line on which the point that the beam `level` reaches lies on
/// the plane of `facet`.
#[derive(Debug, Clone, Copy)]
struct EdgeLine {
    /// A beam's id, or [`FIXED`] for the border of a domain of the symmetry.
    level: u32,
    facet: u32,
}

/// One pass over the beams of a tree, from the last to the first.
pub(super) struct ReversePass<'a> {
    beams: &'a Beams,
    polytope: &'a Polytope,
    states: Vec<BeamState>,
    adjoints: Vec<StateAdjoint>,
    /// For each corner of the beams, the line of the edge that begins there.
    lines: Vec<EdgeLine>,
    /// For the first corner of each outline, the derivative by the outline's area.
    areas: Vec<f64>,
    /// For each corner of the beams in a stone that absorbs, the derivative by the movement of the edge that begins
    /// there, spread along the edge, in addition to `areas`; empty in a clear stone.
    edges: Vec<Moments>,
    found: PlaneDerivatives,
}

impl<'a> ReversePass<'a> {
    /// Prepares the pass; `watch` sees its own part of the work, 0 to 1.
    ///
    /// # Errors
    /// Fails where `watch` asks to stop.
    pub fn new(beams: &'a Beams, polytope: &'a Polytope, watch: Watch) -> Result<Self, Stopped> {
        let corners = beams.corners.len();
        let mut pass = Self {
            beams,
            polytope,
            states: Vec::with_capacity(beams.len()),
            adjoints: vec![StateAdjoint::default(); beams.len()],
            lines: vec![EdgeLine { level: FIXED, facet: 0 }; corners],
            areas: vec![0.0; corners],
            edges: if beams.medium.is_clear() { vec![] } else { vec![Moments::default(); corners] },
            found: PlaneDerivatives::none(polytope.facets().len()),
        };
        for id in 0..beams.len() as u32 {
            if id.is_multiple_of(WATCHED) {
                go_on(watch, f64::from(id) / beams.len() as f64)?;
            }
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
        Ok(pass)
    }

    /// Follows the changes of a sum back to the planes and to the index.
    ///
    /// # Errors
    /// Fails where `watch` asks to stop.
    pub fn run(mut self, partials: &BeamPartials, watch: Watch) -> Result<PlaneDerivatives, Stopped> {
        let count = self.beams.len();
        for id in (0..count as u32).rev() {
            if id.is_multiple_of(WATCHED) {
                go_on(watch, 1.0 - f64::from(id) / count as f64)?;
            }
            self.step(id, partials);
        }
        Ok(self.found)
    }

    /// Returns whether a beam has an outline of its own.
    fn is_cut_here(&self, node: &BeamNode) -> bool {
        node.parent == ROOT || self.beams.nodes[node.parent].corners != node.corners
    }

    /// Finds the line of each edge of a beam's outline. It is a line of the outline from which this one was cut, or
    /// one beyond which the beam meets a neighbour of its facet.
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
            // Where lines of both kinds fit, the splitting has left the former edge in place.
            let own = before.iter().map(|(line, at)| (off(line) - SAME_LINE, at));
            let nearest = own.chain(cuts.iter().map(|(line, at)| (off(line), at)));
            if let Some((_, &line)) = nearest.min_by(|a, b| a.0.total_cmp(&b.0)) {
                self.lines[node.corners.0 as usize + k] = line;
            }
        }
    }

    /// Returns the depth inside the plane of `facet` of the points that a beam reaches, over the image.
    fn inside(&self, id: u32, facet: u32) -> Affine {
        let plane = &self.polytope.facets()[facet as usize].plane;
        let [o, u, v] = self.states[id as usize].origin;
        Affine::new(
            plane.offset - plane.normal.dot(o),
            DVec2::new(-plane.normal.dot(u), -plane.normal.dot(v)),
        )
    }

    /// Follows the derivatives of one beam back to its parent.
    fn step(&mut self, id: u32, partials: &BeamPartials) {
        let beams = self.beams;
        let (node, k) = (&beams.nodes[id], id as usize);
        self.areas[node.corners.0 as usize] += partials.area[k];
        let per_weight = if beams.medium.is_clear() {
            let weight = beams.get(id).weight;
            self.areas[node.corners.0 as usize] += partials.energy[k] * weight;
            partials.energy[k] * node.area
        } else {
            self.absorb(id, partials)
        };
        if self.is_cut_here(node) {
            self.move_edges(node);
        }
        let facet = node.facet as usize;
        let plane = self.polytope.facets()[facet].plane;
        let leaving = if node.exit == NO_EXIT { (0.0, DVec3::ZERO) } else { (per_weight, partials.exit[k]) };
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

    /// Adds the derivatives by the light that leaves a beam and by the light that is absorbed on its last way. Both
    /// are integrals over the outline of light that falls along the path. Returns the derivative by the weight of the
    /// exit without absorption.
    fn absorb(&mut self, id: u32, partials: &BeamPartials) -> f64 {
        let beams = self.beams;
        let (node, k) = (&beams.nodes[id], id as usize);
        let weight = if node.exit == NO_EXIT { 0.0 } else { beams.exits[node.exit].weight };
        let absorbed = if node.parent == ROOT { 0.0 } else { partials.absorbed[k] };
        let arriving = if node.parent == ROOT { 0.0 } else { beams.nodes[node.parent].onward };
        // The light left after the path, and the light left before the last way, each times its derivative.
        let (after, before) = (partials.energy[k] * weight - absorbed * arriving, absorbed * arriving);
        let left = self.spread(node, node.path, after);
        self.adjoints[k].add_path(left.per_path);
        if absorbed != 0.0 {
            let path = beams.nodes[node.parent].path;
            let left_before = self.spread(node, path, before);
            let parent = &mut self.adjoints[node.parent as usize];
            parent.add_path(left_before.per_path);
            parent.add_weight(absorbed * (left_before.sum - left.sum));
        }
        partials.energy[k] * left.sum
    }

    /// Integrates over an outline the share that absorption leaves after a path, and adds the derivatives by the
    /// movement of its edges, times `per`.
    fn spread(&mut self, node: &BeamNode, path: Affine, per: f64) -> LeftLight {
        let beams = self.beams;
        let outline = beams.outline(node);
        let mut left = LeftLight { sum: 0.0, per_path: Moments::default() };
        // Half of the light has each of the stone's two polarisations.
        for absorption in beams.medium.absorption {
            let fall = path * absorption;
            let inside = moments_of_decay(outline, fall) * 0.5;
            left.sum += inside.sum;
            left.per_path = left.per_path + inside * (-absorption * per);
            if per == 0.0 {
                continue;
            }
            for k in 0..outline.len() {
                let along = moments_along_edge(outline[k], outline[(k + 1) % outline.len()], fall);
                let edge = &mut self.edges[node.corners.0 as usize + k];
                *edge = *edge + along * (0.5 * per);
            }
        }
        left
    }

    /// Turns the derivatives by an outline into derivatives by the planes and beams that place its edges.
    fn move_edges(&mut self, node: &BeamNode) {
        let outline = self.beams.outline(node);
        let per_area = self.areas[node.corners.0 as usize];
        for k in 0..outline.len() {
            let corner = node.corners.0 as usize + k;
            let EdgeLine { level, facet } = self.lines[corner];
            if level == FIXED {
                continue;
            }
            let (a, b) = (outline[k], outline[(k + 1) % outline.len()]);
            let even = per_area * a.distance(b);
            let even = Moments { sum: even, first: (a + b) / 2.0 * even };
            let along = self.edges.get(corner).map_or(even, |&uneven| even + uneven);
            if along != Moments::default() {
                self.move_edge((level, facet), along);
            }
        }
    }

    /// Turns the derivative by one edge, spread along it, into derivatives by the plane and the beam that place it.
    fn move_edge(&mut self, (level, facet): (u32, u32), along: Moments) {
        let slope = self.inside(level, facet).gradient.length();
        let Moments { sum, first } = along * (1.0 / slope);
        if !(sum.is_finite() && first.is_finite()) {
            return;
        }
        let normal = self.polytope.facets()[facet as usize].plane.normal;
        let [o, u, v] = self.states[level as usize].origin;
        self.found.offsets[facet as usize] += sum;
        self.found.normals[facet as usize] -= o * sum + u * first.x + v * first.y;
        let at = &mut self.adjoints[level as usize].origin;
        at[0] -= normal * sum;
        at[1] -= normal * first.x;
        at[2] -= normal * first.y;
    }
}

/// The share of a light of weight 1 that absorption leaves, integrated over an outline.
struct LeftLight {
    sum: f64,
    /// The derivative by the length of the path at each point.
    per_path: Moments,
}
