//! Follows a few beams, and all beams into which they split, as long as these are strong enough.

use super::split::{BeamOutline, Facets, Landing, Ray, Splitter};
use super::tree::{BeamExit, BeamLoss, BeamNode, Beams, NO_EXIT, NewBeams, TreeSize};
use crate::coherency::{Coherency, s_axis};
use brillianteer_math::{Affine, integral_of_decay};
use brillianteer_optics::{fresnel, reflect, refract};
use brillianteer_scene::Medium;
use glam::{DVec2, DVec3};

/// Outlines with less than this share of the silhouette's area come from rounding and are dropped.
pub(super) const SLIVER: f64 = 1e-15;

/// The number of beams after which a piece of work leaves the rest for the next round. Usual pieces have some hundred; but
/// light that total reflection keeps inside splits more and more often.
const MOST_OF_A_PIECE: usize = 4096;

/// The range of corners of an outline that does not exist.
const NOWHERE: (u32, u32) = (u32::MAX, 0);

/// A beam that is still to be followed from its last facet on. Fronts that wait are boxed, because there are many.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Front<F = Box<Flight>> {
    pub node: u32,
    pub bounces: u32,
    /// Weight times area times the share that absorption has left.
    pub energy: f64,
    pub flight: F,
}

/// The light that goes on from a facet.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Flight {
    pub ray: Ray,
    /// Weight and polarisation, without absorption.
    pub light: Coherency,
    /// The axis s of `light`: a unit vector perpendicular to the ray.
    pub s: DVec3,
    /// The integral over the outline of the share that absorption has left.
    pub left: f64,
}

impl Front<Flight> {
    fn boxed(self) -> Front {
        Front { node: self.node, bounces: self.bounces, energy: self.energy, flight: Box::new(self.flight) }
    }
}

impl Front {
    fn unboxed(&self) -> Front<Flight> {
        Front { node: self.node, bounces: self.bounces, energy: self.energy, flight: *self.flight }
    }
}

/// The beams that one piece of work has found. Their nodes are numbered from the end of the existing tree.
#[derive(Default)]
pub(super) struct Growth {
    pub beams: NewBeams,
    /// The beams that are too weak to be followed.
    pub left: Vec<Front>,
    /// The energy lost in slivers.
    pub dropped: f64,
}

impl Growth {
    /// Removes everything, for the next piece of work.
    fn clear(&mut self) {
        self.beams.clear();
        self.left.clear();
        self.dropped = 0.0;
    }
}

/// Follows beams piece by piece.
pub(super) struct Follower<'a> {
    splitter: Splitter<'a>,
    /// The beams that the last piece of work has found.
    pub growth: Growth,
    /// The outline of the beam that is split, and its range among all corners.
    outline: BeamOutline,
    outline_at: (u32, u32),
    stack: Vec<Front<Flight>>,
}

impl<'a> Follower<'a> {
    pub fn new(facets: &'a Facets<'a>) -> Self {
        let splitter = Splitter::new(facets);
        Self {
            splitter,
            growth: Growth::default(),
            outline: BeamOutline::default(),
            outline_at: NOWHERE,
            stack: vec![],
        }
    }

    /// Follows these fronts, and every beam into which they split, while `strong` accepts the energy and the number
    /// of bounces. A piece that grows too large leaves the rest among those that were not followed, however strong they
    /// are.
    pub fn follow(&mut self, before: &Beams, fronts: &[Front], strong: impl Fn(f64, u32) -> bool) {
        self.growth.clear();
        self.outline_at = NOWHERE;
        self.stack.extend(fronts.iter().rev().map(Front::unboxed));
        while let Some(front) = self.stack.pop() {
            self.step(before, &front, &strong);
            if self.growth.beams.nodes.len() > MOST_OF_A_PIECE {
                self.growth.left.extend(self.stack.drain(..).map(Front::boxed));
            }
        }
    }

    /// Splits one beam among the facets that it lands on.
    fn step(&mut self, before: &Beams, front: &Front<Flight>, strong: &impl Fn(f64, u32) -> bool) {
        let Self { splitter, growth, outline, outline_at, stack } = self;
        let base = before.size();
        let beams = &mut growth.beams;
        let parent = match front.node.checked_sub(base.nodes) {
            None => before.nodes[front.node],
            Some(own) => beams.nodes[own as usize],
        };
        // Most beams land as a whole, and the next front is then the beam that has just landed.
        if *outline_at != parent.corners {
            let (start, all) = match parent.corners.0.checked_sub(base.corners) {
                None => (parent.corners.0 as usize, &before.corners),
                Some(own) => (own as usize, &beams.corners),
            };
            outline.load(&all[start..start + parent.corners.1 as usize]);
            *outline_at = parent.corners;
        }
        let sliver = SLIVER * before.silhouette_area;
        let missed = splitter.split(&front.flight.ray, outline, |landing| {
            let area = landing.twice_area / 2.0;
            if area <= sliver {
                growth.dropped += front.flight.light.weight() * area.max(0.0);
                return;
            }
            let landed = land(front, parent.path, &landing, before);
            let node = beams.add((front.node, parent.corners), &landing, &landed, base);
            let (energy, bounces) = (landed.light.weight() * landed.left, front.bounces + 1);
            if strong(energy, bounces) {
                stack.push(Front {
                    node,
                    bounces,
                    energy,
                    flight: landed.flight(&front.flight.ray, &landing),
                });
            } else if energy > 0.0 {
                let flight = Box::new(landed.flight(&front.flight.ray, &landing));
                growth.left.push(Front { node, bounces, energy, flight });
            }
        });
        growth.dropped += front.flight.light.weight() * missed;
    }
}

impl NewBeams {
    /// Adds the part of a beam that has landed on a facet; returns the id of the new beam. `of` is the beam's id and
    /// its range of corners.
    fn add(&mut self, of: (u32, (u32, u32)), landing: &Landing, landed: &Landed, base: TreeSize) -> u32 {
        let (parent, mut corners) = of;
        if !landing.is_whole {
            corners = (base.corners + self.corners.len() as u32, landing.outline.len() as u32);
            self.corners.extend_from_slice(landing.outline);
        }
        let exit = landed.exit.map_or(NO_EXIT, |_| base.exits + self.exits.len() as u32);
        self.exits.extend(landed.exit);
        self.losses.extend(landed.loss);
        let id = base.nodes + self.nodes.len() as u32;
        self.nodes.push(BeamNode {
            parent,
            facet: landing.facet,
            corners,
            area: landing.twice_area / 2.0,
            onward: landed.light.weight(),
            path: landed.path,
            exit,
            open: false,
        });
        id
    }
}

/// The result of a beam's landing on a facet.
struct Landed {
    path: Affine,
    exit: Option<BeamExit>,
    /// The light absorbed on the way; `None` where nothing absorbs.
    loss: Option<BeamLoss>,
    /// The light that goes on, its axis s, and the integral of the share that absorption leaves; see [`Flight`].
    light: Coherency,
    s: DVec3,
    left: f64,
    /// The cosine of the angle of incidence.
    cos_i: f64,
}

impl Landed {
    /// Returns the light that goes on from this landing of a ray.
    #[inline(always)]
    fn flight(&self, ray: &Ray, landing: &Landing) -> Flight {
        let origin = ray.advanced(landing.distance);
        let direction = reflect(ray.direction, -landing.normal, self.cos_i);
        Flight { ray: Ray { origin, direction }, light: self.light, s: self.s, left: self.left }
    }
}

/// Splits a beam's light at the facet on which it has landed.
#[inline(always)]
fn land(front: &Front<Flight>, path_before: Affine, landing: &Landing, beams: &Beams) -> Landed {
    let Flight { ray, light: arriving, s: s_before, .. } = &front.flight;
    let (direction, normal) = (ray.direction, landing.normal);
    let index = beams.medium.index;
    let cos_i = direction.dot(normal);
    let surface = fresnel(cos_i, index);
    let s = s_axis(direction, normal, *s_before);
    let (reflected, weight) = arriving.turned_to(s, *s_before, direction).split(&surface);
    let light = if beams.polarised { reflected } else { reflected.unpolarised() };
    let exit = surface.cos_t().map(|cos_t| {
        let direction = refract(direction, -normal, index, (cos_i, cos_t));
        BeamExit { direction, weight }
    });
    let path = path_before + landing.distance;
    let area = landing.twice_area / 2.0;
    let (left, loss) = if beams.medium.is_clear() {
        (area, None)
    } else {
        let left = |path| attenuated(landing.outline, path, &beams.medium);
        let before = if landing.is_whole { front.flight.left } else { left(path_before) };
        let after = left(path);
        let absorbed = arriving.weight() * (before - after);
        (after, Some(BeamLoss { transmittance: after / area, absorbed }))
    };
    Landed { path, exit, loss, light, s, left, cos_i }
}

/// Integrates over the outline the share that absorption leaves after a path.
pub(super) fn attenuated(outline: &[DVec2], path: Affine, medium: &Medium) -> f64 {
    let [o, e] = medium.absorption;
    let left = |absorption| integral_of_decay(outline, path * absorption);
    if o == e { left(o) } else { 0.5 * (left(o) + left(e)) }
}
