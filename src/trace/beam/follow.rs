//! Follows a few beams, and all that they split into, as long as they are strong enough.

use super::coherency::Coherency;
use super::split::{Facets, Landing, Ray, Splitter};
use super::tree::{BeamBlock, BeamNode, Beams};
use crate::math::{Affine, integral_of_decay};
use crate::optics::{fresnel, reflect, refract};
use crate::scene::Medium;
use glam::{DVec2, DVec3};

/// Outlines with less than this share of the silhouette's area come from rounding and are dropped.
pub(super) const SLIVER: f64 = 1e-15;

/// The sine of the angle between a beam and a facet's normal below which there is no plane of incidence, and none is needed.
const SQUARE_ON: f64 = 1e-9;

/// A beam that is still to be followed from its last facet on. Those that wait are kept in boxes, as they are many.
#[derive(Debug, Clone, Copy)]
pub(in crate::trace) struct Front<F = Box<Flight>> {
    pub node: u32,
    pub bounces: u32,
    /// Weight times area times the share that absorption has left.
    pub energy: f64,
    pub flight: F,
}

/// How a beam goes on from a facet.
#[derive(Debug, Clone, Copy)]
pub(in crate::trace) struct Flight {
    pub ray: Ray,
    /// Weight and polarisation, without absorption.
    pub light: Coherency,
    /// The axis s of `light`: a unit vector perpendicular to the ray.
    pub s: DVec3,
}

impl<F> Front<F> {
    /// Returns the same front with its flight kept in another way.
    fn kept<G>(self, how: impl FnOnce(F) -> G) -> Front<G> {
        let Self { node, bounces, energy, flight } = self;
        Front { node, bounces, energy, flight: how(flight) }
    }
}

/// The beams that one piece of work has found. Its nodes are numbered on from the end of the existing tree.
#[derive(Default)]
pub(super) struct Growth {
    pub beams: BeamBlock,
    /// Beams too weak to be followed.
    pub left: Vec<Front>,
    /// Energy lost in slivers.
    pub dropped: f64,
}

impl Growth {
    /// Empties it for the next piece of work.
    fn clear(&mut self) {
        self.beams.nodes.clear();
        self.beams.corners.clear();
        self.left.clear();
        self.dropped = 0.0;
    }
}

/// Returns the unit axis perpendicular to a ray and a facet's normal, or `otherwise` where the ray is square to the facet.
pub(super) fn s_axis(direction: DVec3, normal: DVec3, otherwise: DVec3) -> DVec3 {
    let s = direction.cross(normal);
    let length = s.length();
    if length > SQUARE_ON { s / length } else { otherwise }
}

/// Follows beams piece by piece.
pub(super) struct Follower<'a> {
    splitter: Splitter<'a>,
    /// What the last piece has found.
    pub growth: Growth,
    /// The outline of the beam being split.
    outline: Vec<DVec2>,
    stack: Vec<Front<Flight>>,
}

impl<'a> Follower<'a> {
    pub fn new(facets: &'a Facets<'a>) -> Self {
        let splitter = Splitter::new(facets);
        Self { splitter, growth: Growth::default(), outline: vec![], stack: vec![] }
    }

    /// Follows these fronts, and every beam that they split into, while the energy and the number of bounces are `strong`.
    pub fn follow(&mut self, before: &Beams, fronts: &[Front], strong: impl Fn(f64, u32) -> bool) {
        self.growth.clear();
        self.stack.extend(fronts.iter().rev().map(|front| front.clone().kept(|flight| *flight)));
        while let Some(front) = self.stack.pop() {
            self.step(before, &front, &strong);
        }
    }

    /// Splits one beam among the facets that it lands on.
    fn step(&mut self, before: &Beams, front: &Front<Flight>, strong: &impl Fn(f64, u32) -> bool) {
        let Self { splitter, growth, outline, stack } = self;
        outline.clear();
        let base = before.len();
        let (parent, block) = match (front.node as usize).checked_sub(base) {
            None => before.node_in_block(front.node),
            Some(own) => (&growth.beams.nodes[own], &growth.beams),
        };
        outline.extend(block.outline(parent));
        let path = parent.path;
        let sliver = SLIVER * before.silhouette_area;
        let missed = splitter.split(&front.flight.ray, outline, |landing| {
            let area = landing.twice_area / 2.0;
            if area <= sliver {
                growth.dropped += front.flight.light.weight() * area.max(0.0);
                return;
            }
            let id = (base + growth.beams.nodes.len()) as u32;
            let start = growth.beams.corners.len() as u32;
            growth.beams.corners.extend_from_slice(landing.outline);
            let (node, onward) = land(front, path, &landing, area, before, (id, start), &growth.beams.corners);
            growth.beams.nodes.push(node);
            if strong(onward.energy, onward.bounces) {
                stack.push(onward);
            } else if onward.energy > 0.0 {
                growth.left.push(onward.kept(Box::new));
            }
        });
        growth.dropped += front.flight.light.weight() * missed;
    }
}

/// Splits a beam's light at the facet on which it has landed: returns the node, with the light that leaves, and the front
/// that goes on.
#[inline]
fn land(
    front: &Front<Flight>,
    path_before: Affine,
    landing: &Landing,
    area: f64,
    beams: &Beams,
    (id, start): (u32, u32),
    corners: &[DVec2],
) -> (BeamNode, Front<Flight>) {
    let Flight { ray, light: arriving_light, s: s_before } = &front.flight;
    let (direction, normal) = (ray.direction, landing.normal);
    let index = beams.medium.index;
    let cos_i = direction.dot(normal);
    let surface = fresnel(cos_i, index);
    let s = s_axis(direction, normal, *s_before);
    let p_before = direction.cross(*s_before);
    let arriving = arriving_light.turned(s_before.dot(s), p_before.dot(s));
    let (reflected, weight) = arriving.split(&surface);
    let light = if beams.polarised { reflected } else { reflected.unpolarised() };
    let exit = surface.cos_t.map_or(DVec3::ZERO, |cos_t| refract(direction, -normal, index, (cos_i, cos_t)));
    let path = path_before + landing.distance;
    let own = &corners[start as usize..];
    let (before, after) = attenuated(own, path_before, path, &beams.medium, area);
    let node = BeamNode {
        parent: front.node,
        facet: landing.facet,
        corners: (start, own.len() as u32),
        area,
        exit,
        weight,
        onward: light.weight(),
        path,
        transmittance: after / area,
        absorbed: arriving_light.weight() * (before - after),
        open: false,
    };
    let origin = ray.advanced(landing.distance);
    let ray = Ray { origin, direction: reflect(direction, -normal, cos_i) };
    let energy = light.weight() * after;
    let onward = Front { node: id, bounces: front.bounces + 1, energy, flight: Flight { ray, light, s } };
    (node, onward)
}

/// Integrates the transmittance over the outline, after each of two paths; both are the area where nothing absorbs.
fn attenuated(outline: &[DVec2], before: Affine, after: Affine, medium: &Medium, area: f64) -> (f64, f64) {
    if medium.is_clear() {
        return (area, area);
    }
    let left = |path: Affine| {
        let [o, e] = medium.absorption.map(|a| integral_of_decay(outline, path * a));
        0.5 * (o + e)
    };
    (left(before), left(after))
}
