//! Follows a few beams, and all that they split into, as long as they are strong enough.

use super::coherency::Coherency;
use super::split::{Facets, Landing, Ray, Splitter};
use super::tree::{BeamExit, BeamLoss, BeamNode, Beams, NO_EXIT, NewBeams};
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
    /// The integral over the outline of the share that absorption has left.
    pub left: f64,
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
    pub beams: NewBeams,
    /// Beams too weak to be followed.
    pub left: Vec<Front>,
    /// Energy lost in slivers.
    pub dropped: f64,
}

impl Growth {
    /// Empties it for the next piece of work.
    fn clear(&mut self) {
        self.beams.clear();
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
        let base = before.size();
        let beams = &mut growth.beams;
        let parent = match front.node.checked_sub(base.nodes) {
            None => before.nodes[front.node],
            Some(own) => beams.nodes[own as usize],
        };
        let (start, all) = match parent.corners.0.checked_sub(base.corners) {
            None => (parent.corners.0 as usize, &before.corners),
            Some(own) => (own as usize, &beams.corners),
        };
        outline.clear();
        outline.extend_from_slice(&all[start..start + parent.corners.1 as usize]);
        let sliver = SLIVER * before.silhouette_area;
        let missed = splitter.split(&front.flight.ray, outline, |landing| {
            let area = landing.twice_area / 2.0;
            if area <= sliver {
                growth.dropped += front.flight.light.weight() * area.max(0.0);
                return;
            }
            let corners = match landing.is_whole {
                true => parent.corners,
                false => (base.corners + beams.corners.len() as u32, landing.outline.len() as u32),
            };
            if !landing.is_whole {
                beams.corners.extend_from_slice(landing.outline);
            }
            let landed = land(front, parent.path, &landing, before);
            let exit = match landed.exit {
                Some(exit) => {
                    beams.exits.push(exit);
                    base.exits + beams.exits.len() as u32 - 1
                }
                None => NO_EXIT,
            };
            if let Some(loss) = landed.loss {
                beams.losses.push(loss);
            }
            let Landed { flight, path, .. } = landed;
            let (light, onward) = (flight.light.weight(), front.bounces + 1);
            let node = base.nodes + beams.nodes.len() as u32;
            beams.nodes.push(BeamNode {
                parent: front.node,
                facet: landing.facet,
                corners,
                area,
                onward: light,
                path,
                exit,
                open: false,
            });
            let front = Front { node, bounces: onward, energy: light * flight.left, flight };
            if strong(front.energy, front.bounces) {
                stack.push(front);
            } else if front.energy > 0.0 {
                growth.left.push(front.kept(Box::new));
            }
        });
        growth.dropped += front.flight.light.weight() * missed;
    }
}

/// What becomes of a beam's light at the facet on which it lands.
struct Landed {
    path: Affine,
    exit: Option<BeamExit>,
    /// `None` where nothing absorbs.
    loss: Option<BeamLoss>,
    flight: Flight,
}

/// Splits a beam's light at the facet on which it has landed.
#[inline]
fn land(front: &Front<Flight>, path_before: Affine, landing: &Landing, beams: &Beams) -> Landed {
    let Flight { ray, light: arriving, s: s_before, .. } = &front.flight;
    let (direction, normal) = (ray.direction, landing.normal);
    let index = beams.medium.index;
    let cos_i = direction.dot(normal);
    let surface = fresnel(cos_i, index);
    let s = s_axis(direction, normal, *s_before);
    let p_before = direction.cross(*s_before);
    let (reflected, weight) = arriving.turned(s_before.dot(s), p_before.dot(s)).split(&surface);
    let light = if beams.polarised { reflected } else { reflected.unpolarised() };
    let exit = surface.cos_t.map(|cos_t| {
        let direction = refract(direction, -normal, index, (cos_i, cos_t));
        BeamExit { direction, weight }
    });
    let path = path_before + landing.distance;
    let area = landing.twice_area / 2.0;
    let (left, loss) = match beams.medium.is_clear() {
        true => (area, None),
        false => {
            let left = |path| attenuated(landing.outline, path, &beams.medium);
            let before = if landing.is_whole { front.flight.left } else { left(path_before) };
            let after = left(path);
            let absorbed = arriving.weight() * (before - after);
            (after, Some(BeamLoss { transmittance: after / area, absorbed }))
        }
    };
    let origin = ray.advanced(landing.distance);
    let ray = Ray { origin, direction: reflect(direction, -normal, cos_i) };
    Landed { path, exit, loss, flight: Flight { ray, light, s, left } }
}

/// Integrates over the outline the share that absorption leaves after a path.
pub(super) fn attenuated(outline: &[DVec2], path: Affine, medium: &Medium) -> f64 {
    let [o, e] = medium.absorption;
    let left = |absorption| integral_of_decay(outline, path * absorption);
    if o == e { left(o) } else { 0.5 * (left(o) + left(e)) }
}
