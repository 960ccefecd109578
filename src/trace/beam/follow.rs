//! Follows a few beams, and all that they split into, as long as they are strong enough.

use super::coherency::Coherency;
use super::guess::FacetGuess;
use super::split::{Landing, Ray, Splitter, twice_area};
use super::tree::{BeamNode, Beams};
use crate::math::{Affine, Polytope, integral_of_decay};
use crate::optics::{fresnel, reflect, refract};
use crate::scene::Medium;
use glam::{DVec2, DVec3};

/// Outlines with less than this share of the silhouette's area come from rounding and are dropped.
pub(super) const SLIVER: f64 = 1e-15;

/// The sine of the angle between a beam and a facet's normal below which there is no plane of incidence, and none is needed.
const SQUARE_ON: f64 = 1e-9;

/// A beam that is still to be followed from its last facet on.
#[derive(Debug, Clone, Copy)]
pub(in crate::trace) struct Front {
    pub node: u32,
    pub bounces: u32,
    pub ray: Ray,
    /// Weight and polarisation, without absorption.
    pub light: Coherency,
    /// The axis s of `light`: a unit vector perpendicular to the ray.
    pub s: DVec3,
    /// Weight times area times the share that absorption has left.
    pub energy: f64,
}

/// The beams that one piece of work has found. Its nodes are numbered on from the end of the existing tree.
#[derive(Default)]
pub(super) struct Growth {
    pub nodes: Vec<BeamNode>,
    pub corners: Vec<DVec2>,
    /// Beams too weak to be followed.
    pub left: Vec<Front>,
    /// Energy lost in slivers.
    pub dropped: f64,
}

/// Returns the unit axis perpendicular to a ray and a facet's normal, or `otherwise` where the ray is square to the facet.
pub(super) fn s_axis(direction: DVec3, normal: DVec3, otherwise: DVec3) -> DVec3 {
    let s = direction.cross(normal);
    let length = s.length();
    if length > SQUARE_ON { s / length } else { otherwise }
}

/// Follows beams as one piece of work.
pub(super) struct Follower<'a> {
    splitter: Splitter<'a>,
    before: &'a Beams,
    growth: Growth,
    /// The outline of the beam being split.
    outline: Vec<DVec2>,
}

impl<'a> Follower<'a> {
    pub fn new(polytope: &'a Polytope, guess: &'a FacetGuess, before: &'a Beams) -> Self {
        let splitter = Splitter::new(polytope, guess);
        Self { splitter, before, growth: Growth::default(), outline: vec![] }
    }

    /// Follows these fronts, and every beam that they split into while `strong` accepts it.
    pub fn follow(mut self, fronts: &[Front], strong: impl Fn(&Front) -> bool) -> Growth {
        let mut stack: Vec<Front> = fronts.iter().rev().copied().collect();
        while let Some(front) = stack.pop() {
            self.step(&front, &strong, &mut stack);
        }
        self.growth
    }

    /// Splits one beam among the facets that it lands on.
    fn step(&mut self, front: &Front, strong: &impl Fn(&Front) -> bool, stack: &mut Vec<Front>) {
        let Self { splitter, before, growth, outline } = self;
        outline.clear();
        let base = before.nodes.len();
        let (&parent, all) = match (front.node as usize).checked_sub(base) {
            None => (&before.nodes[front.node as usize], &before.corners),
            Some(own) => (&growth.nodes[own], &growth.corners),
        };
        let start = parent.corners.0 as usize;
        outline.extend(&all[start..start + parent.corners.1 as usize]);
        let sliver = SLIVER * before.silhouette_area;
        let missed = splitter.split(&front.ray, outline, |landing| {
            let area = twice_area(landing.outline.iter().map(|c| c.at)) / 2.0;
            if area <= sliver {
                growth.dropped += front.light.weight() * area.max(0.0);
                return;
            }
            let id = (base + growth.nodes.len()) as u32;
            let start = growth.corners.len() as u32;
            growth.corners.extend(landing.outline.iter().map(|c| c.at));
            let (node, onward) =
                land(front, parent.path, &landing, area, before, (id, start), &growth.corners);
            growth.nodes.push(node);
            if strong(&onward) {
                stack.push(onward);
            } else if onward.energy > 0.0 {
                growth.left.push(onward);
            }
        });
        growth.dropped += front.light.weight() * missed;
    }
}

/// Splits a beam's light at the facet on which it has landed: returns the node, with the light that leaves, and the front
/// that goes on.
#[inline]
fn land(
    front: &Front,
    path_before: Affine,
    landing: &Landing,
    area: f64,
    beams: &Beams,
    (id, start): (u32, u32),
    corners: &[DVec2],
) -> (BeamNode, Front) {
    let (direction, normal) = (front.ray.direction, landing.normal);
    let index = beams.medium.index;
    let cos_i = direction.dot(normal);
    let surface = fresnel(cos_i, index);
    let s = s_axis(direction, normal, front.s);
    let p_before = direction.cross(front.s);
    let arriving = front.light.turned(front.s.dot(s), p_before.dot(s));
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
        absorbed: front.light.weight() * (before - after),
        open: false,
    };
    let origin = front.ray.advanced(landing.distance);
    let ray = Ray { origin, direction: reflect(direction, -normal, cos_i) };
    let energy = light.weight() * after;
    let onward = Front { node: id, bounces: front.bounces + 1, ray, light, s, energy };
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
