//! The light that exact beams leave, followed by single rays from the places where the beams end.
//!
//! Each open beam is a polygon of the image with rays of one direction. A ray starts at a random point of a random polygon
//! and is followed as a chain of bounces. At each bounce its expected energy leaves, so a ray says where all of its light
//! goes. The polygons stand in the order of the tree, in which neighbours have most of their way in common: samples from
//! successive pieces of that order differ little, and so does their mean from the true one.

use super::beam::{Beams, Front, GrownBeams};
use super::ray::{PathLight, RayOptions, StoneTracer};
use crate::math::{Polytope, point_in_polygon};
use glam::{DVec2, DVec3};

/// The share of a ray's light below which the ray goes on by chance alone, by Russian roulette.
const ROULETTE: f64 = 0.15;

/// The share of the rays that are spread over the light. The others are spread over the area whose strongest exit is
/// undecided, of which little light may be left.
const BY_LIGHT: f64 = 0.8;

/// The light that exact beams have left, ready to be sampled.
pub struct Tail<'a> {
    beams: &'a Beams,
    tracer: StoneTracer,
    sources: Vec<TailSource>,
    /// The part of the silhouette's light that was left.
    light: f64,
    /// The part of the silhouette's area whose strongest exit is undecided.
    undecided: f64,
}

/// The end of one beam, from which rays go on.
struct TailSource {
    front: Front,
    /// Where its part of all places ends, 0 to 1.
    until: f64,
    /// Its part of the places, above 0.
    density: f64,
    /// Its part of the silhouette's light, and of the area that is undecided.
    light: f64,
    undecided: f64,
    /// Weight of the strongest exit so far, and its direction.
    strongest: (f64, Option<DVec3>),
}

/// What one ray says of the light that was left.
#[derive(Debug, Clone, Copy)]
pub struct TailRay {
    /// The part of all light that the ray stands for, as a part of the silhouette's light. All shares of the ray are to be
    /// multiplied by it.
    pub light: f64,
    /// The part of the silhouette's undecided area that the ray stands for.
    pub area: f64,
    /// The share of the ray's light that is absorbed.
    pub absorbed: f64,
    /// The share of the ray's light that was not followed to its end.
    pub unresolved: f64,
    /// The direction of the strongest exit seen through the ray's point; `None` where light that was not followed may
    /// outshine it, or none has left.
    pub strongest: Option<DVec3>,
}

impl<'a> Tail<'a> {
    /// Prepares what beams in this stone have left; `None` where nothing is left.
    pub fn new(polytope: &Polytope, grown: &'a GrownBeams) -> Option<Self> {
        let beams = &grown.beams;
        let share = f64::from(beams.symmetry.order()) / beams.silhouette_area;
        let best = beams.strongest_so_far();
        let source = |front: &Front| {
            let (beam, best) = (beams.get(front.node), &best[front.node as usize]);
            TailSource {
                front: *front,
                until: 0.0,
                density: 0.0,
                light: front.energy * share,
                undecided: if best.is_decided { 0.0 } else { beam.area * share },
                strongest: (best.weight, best.exit.map(|id| beams.get(id).exit)),
            }
        };
        let mut sources: Vec<TailSource> = grown.open.iter().map(source).collect();
        // Neighbours in the tree have most of their way in common.
        sources.sort_unstable_by_key(|source| source.front.node);
        let sum = |part: fn(&TailSource) -> f64| sources.iter().map(part).sum::<f64>();
        let (light, undecided) = (sum(|s| s.light), sum(|s| s.undecided));
        if light <= 0.0 {
            return None;
        }
        let by_light = if undecided > 0.0 { BY_LIGHT } else { 1.0 };
        let mut until = 0.0;
        for source in &mut sources {
            let of_area = if undecided > 0.0 { source.undecided / undecided } else { 0.0 };
            source.density = by_light * source.light / light + (1.0 - by_light) * of_area;
            until += source.density;
            source.until = until;
        }
        let options = RayOptions { polarised: beams.polarised, ..RayOptions::default() };
        let tracer = StoneTracer::new(polytope, beams.medium, options);
        Some(Self { beams, tracer, sources, light, undecided })
    }

    /// Returns the part of the silhouette's light that was left.
    pub fn light(&self) -> f64 {
        self.light
    }

    /// Returns the part of the silhouette's area whose strongest exit is undecided.
    pub fn undecided(&self) -> f64 {
        self.undecided
    }

    /// Follows one ray, and calls `leave` for each exit with its direction and its share of the ray's light.
    ///
    /// `place` says among all beams where the ray starts, `spot` where in the outline of its beam, and `luck` how long it is
    /// followed; all are from 0 to below 1. Where they are spread evenly, the mean of the light of all rays is the light that
    /// was left.
    pub fn follow(&self, place: f64, spot: DVec2, luck: f64, mut leave: impl FnMut(DVec3, f64)) -> TailRay {
        let k = self.sources.partition_point(|source| source.until <= place).min(self.sources.len() - 1);
        let source = &self.sources[k];
        let front = &source.front;
        let beam = self.beams.get(front.node);
        let point = point_in_polygon(beam.outline, beam.area, spot);
        let path = beam.path.at(point);
        // The light of the ray is 1 in the mean over the outline.
        let light = self.light_of(front, beam.onward);
        let [o, u, v] = front.ray.origin;
        let ray = (o + u * point.x + v * point.y, front.ray.direction);
        let (mut strongest, mut exit) = source.strongest;
        let mut before = light.weight() * self.beams.medium.transmittance(path);
        let mut absorbed = 0.0;
        let end = self.tracer.follow_inside(ray, (light, path), luck * ROULETTE, |met| {
            // The ray comes here with a chance of before / ROULETTE, so all that happens here counts for more.
            let scale = (ROULETTE / before).max(1.0);
            let left = met.leaving.as_ref().map_or(0.0, |leaving| leaving.weight);
            absorbed += (before - left - met.onward) * scale;
            before = met.onward;
            if let Some(leaving) = met.leaving {
                leave(leaving.direction, left * scale);
                if left * beam.onward > strongest {
                    (strongest, exit) = (left * beam.onward, Some(leaving.direction));
                }
            }
        });
        let is_caught = before > luck * ROULETTE;
        TailRay {
            light: source.light / source.density,
            area: source.undecided / source.density,
            absorbed,
            unresolved: if is_caught { before * (ROULETTE / before).max(1.0) } else { 0.0 },
            strongest: exit.filter(|_| end.unresolved * beam.onward <= strongest),
        }
    }

    /// Returns the light of a front, scaled so that `onward`, its weight with absorption, becomes 1.
    fn light_of(&self, front: &Front, onward: f64) -> PathLight {
        let scale = 1.0 / onward;
        if !self.beams.polarised {
            return PathLight::Unpolarised(front.light.weight() * scale);
        }
        let fields = front.light.fields().map(|parts| parts.map(|part| part * scale.sqrt()));
        PathLight::of_fields(fields, [front.s, front.ray.direction.cross(front.s)])
    }
}
