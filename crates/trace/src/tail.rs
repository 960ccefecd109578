//! Follows the light that exact beams leave by single rays from the places where the beams end.
//!
//! Each open beam is a polygon of the image whose rays have one direction. A ray starts at a random point of a random
//! polygon and is followed as a chain of bounces. At each bounce its expected energy leaves, so one ray shows where
//! all of its light goes. The polygons are sorted as in the tree, where neighbours share most of their paths. So
//! samples from successive pieces of this order differ little, and their mean is close to the true one.
//! successive pieces of that order differ little, and so does their mean from the true one.

use super::beam::{Beams, Flight, Front, SummedBeams};
use super::ray::{ChainRoulette, PathLight, RayOptions, StoneTracer};
use brillianteer_math::{Polytope, point_in_polygon};
use brillianteer_scene::Scope;
use glam::{DVec2, DVec3};

/// The share of a ray's light below which the ray goes on only by chance (Russian roulette).
pub(super) const ROULETTE: f64 = 0.15;

/// The share of the rays that are spread in proportion to the light. The others are spread over the area whose
/// strongest exit is undecided, which may have little light left.
const BY_LIGHT: f64 = 0.8;

/// The least light that a beam must have left, as a part of the silhouette's light, for rays to start from it. The
/// reciprocal of a far smaller number would be infinite.
const LEAST_LIGHT: f64 = 1e-30;

/// The least light, in all beams together, that is worth an estimate; less is below the rounding of figures.
const LEAST: f64 = 1e-15;

/// The light that exact beams have left, ready to be sampled.
pub struct Tail<'a> {
    beams: &'a Beams,
    scope: &'a Scope,
    tracer: StoneTracer,
    sources: Vec<TailSource<'a>>,
    /// The part of the silhouette's light that the beams have left.
    light: f64,
    /// The part of the silhouette's area whose strongest exit is undecided.
    undecided: f64,
}

/// The end of one beam, from which rays start.
struct TailSource<'a> {
    front: &'a Front,
    /// The end of the beam's interval of places, 0 to 1.
    until: f64,
    /// The length of that interval, above 0.
    density: f64,
    /// The beam's part of the silhouette's light; `undecided` is its part of the area that is undecided.
    light: f64,
    undecided: f64,
    /// The weight of the strongest exit so far, and its band.
    strongest: (f64, Option<usize>),
}

/// Light of a ray that leaves the stone.
#[derive(Debug, Clone, Copy)]
pub struct TailExit {
    /// The unit direction in which the light leaves.
    pub direction: DVec3,
    /// The band of the scope from which the light comes.
    pub band: usize,
    /// The share of the ray's light that leaves here.
    pub share: f64,
}

/// The light of one ray, as a sample of all light that was left.
#[derive(Debug, Clone, Copy)]
pub struct TailRay {
    /// The light that the ray represents, as a part of the silhouette's light. All shares of the ray are parts of it.
    pub light: f64,
    /// The part of the silhouette's undecided area that the ray represents.
    pub area: f64,
    /// The share of the ray's light that is absorbed.
    pub absorbed: f64,
    /// The share of the ray's light that was not followed to its end.
    pub unresolved: f64,
    /// The band of the strongest exit that is seen through the ray's point; `None` where light that was not followed
    /// may be stronger, or where no light has left.
    pub strongest: Option<usize>,
}

impl<'a> Tail<'a> {
    /// Prepares the light that beams have left in this stone; `None` where nothing is left.
    pub fn new(polytope: &Polytope, summed: &'a SummedBeams) -> Option<Self> {
        let beams = &summed.open;
        let share = f64::from(beams.symmetry.order()) / beams.silhouette_area;
        let source = |front: &'a Front| {
            let (beam, best) = (beams.get(front.node), &summed.standings[front.node as usize].strongest);
            TailSource {
                front,
                until: 0.0,
                density: 0.0,
                light: front.energy * share,
                undecided: if best.is_decided { 0.0 } else { beam.area * share },
                strongest: (best.weight, best.exit.map(|band| band as usize)),
            }
        };
        let mut sources: Vec<TailSource<'a>> =
            summed.fronts.iter().map(source).filter(|s| s.light > LEAST_LIGHT).collect();
        // Neighbours in the tree share most of their paths.
        sources.sort_by_key(|source| source.front.node);
        let sum = |part: fn(&TailSource) -> f64| sources.iter().map(part).sum::<f64>();
        let (light, undecided) = (sum(|s| s.light), sum(|s| s.undecided));
        if light <= LEAST {
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
        Some(Self { beams, scope: &summed.scope, tracer, sources, light, undecided })
    }

    /// Returns the part of the silhouette's light that was left.
    pub fn light(&self) -> f64 {
        self.light
    }

    /// Returns the part of the silhouette's area whose strongest exit is undecided.
    pub fn undecided(&self) -> f64 {
        self.undecided
    }

    /// Returns the most light and the most undecided area that one ray can represent, as parts of the silhouette.
    pub fn most_of_a_ray(&self) -> [f64; 2] {
        [self.light / BY_LIGHT, self.undecided / (1.0 - BY_LIGHT)]
    }

    /// Follows one ray, and calls `leave` for each exit.
    ///
    /// `place` chooses the beam from which the ray starts, `spot` the place in the beam's outline, and `luck` how
    /// long the ray is followed; all are from 0 to below 1. Where they are spread evenly, the mean of the light of
    /// all rays is the light that was left.
    pub fn follow(&self, place: f64, spot: DVec2, luck: f64, mut leave: impl FnMut(TailExit)) -> TailRay {
        let k = self.sources.partition_point(|source| source.until <= place).min(self.sources.len() - 1);
        let source = &self.sources[k];
        let front = source.front;
        let beam = self.beams.get(front.node);
        let point = point_in_polygon(beam.outline, beam.area, spot);
        let path = beam.path.at(point);
        // The mean of the ray's light over the outline is 1.
        let light = self.light_of(&front.flight, beam.onward);
        let ray = (front.flight.ray.start(point), front.flight.ray.direction);
        let (mut strongest, mut exit) = source.strongest;
        let mut chances = ChainRoulette::new(ROULETTE, luck, &light, self.beams.medium.transmittance(path));
        let end = self.tracer.follow_inside(ray, (light, path), chances.end.least, |met| {
            let factor = chances.meet(met.light, met.left, met.onward);
            let Some(leaving) = met.leaving else { return };
            let band = self.scope.band(leaving.direction, self.beams.zenith);
            leave(TailExit { direction: leaving.direction, band, share: leaving.weight * factor });
            if leaving.weight * beam.onward > strongest {
                (strongest, exit) = (leaving.weight * beam.onward, Some(band));
            }
        });
        let loss = chances.loss(end.bounces);
        TailRay {
            light: source.light / source.density,
            area: source.undecided / source.density,
            absorbed: loss.absorbed,
            unresolved: loss.unresolved,
            strongest: exit.filter(|_| end.unresolved * beam.onward <= strongest),
        }
    }

    /// Returns the light of a flight, scaled so that `onward`, its weight with absorption, becomes 1.
    fn light_of(&self, flight: &Flight, onward: f64) -> PathLight {
        let scale = 1.0 / onward;
        if !self.beams.polarised {
            return PathLight::Unpolarised(flight.light.weight() * scale);
        }
        let fields = flight.light.fields().map(|parts| parts.map(|part| part * scale.sqrt()));
        PathLight::of_fields(fields, flight.s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beam::{BeamOptions, SumOptions, sum_up, trace};
    use brillianteer_base::unwatched;
    use brillianteer_cut::TOLKOWSKY;
    use brillianteer_math::{Plane, contains};
    use brillianteer_scene::{ASET_CONE, Backing, Medium, View};

    fn brilliant() -> Polytope {
        let facets = TOLKOWSKY.facets().unwrap();
        let planes: Vec<Plane> = facets.into_iter().map(|(_, plane)| plane).collect();
        Polytope::from_planes(&planes).unwrap()
    }

    fn summed(polytope: &Polytope, medium: Medium, view: &View, options: &BeamOptions) -> SummedBeams {
        let scope = &Scope::aset(ASET_CONE, Backing::Black);
        sum_up(polytope, medium, view, options, SumOptions { scope, standard_error: None }, &unwatched)
            .unwrap()
    }

    /// Returns the exits, each as direction and weight, on the path of light that runs through a point of the image,
    /// and the last beam at that point, which was not split further.
    fn way(beams: &Beams, point: DVec2) -> (Vec<(DVec3, f64)>, u32) {
        let on_the_way: Vec<_> = beams.iter().filter(|beam| contains(beam.outline, point, 0.0)).collect();
        let exits = on_the_way.iter().filter(|beam| !beam.is_surface() && beam.weight > 0.0);
        (exits.map(|beam| (beam.exit, beam.weight)).collect(), on_the_way.last().unwrap().id)
    }

    #[test]
    fn a_ray_goes_on_as_finer_beams_do() {
        let polytope = brilliant();
        let view = View { tilt: 0.31, azimuth: 0.7, ..View::default() };
        for (medium, polarised) in [
            (Medium::clear(2.42), true),
            (Medium::clear(1.77), false),
            (Medium { absorption: [0.1, 0.4], ..Medium::clear(2.0) }, true),
        ] {
            let options = |unresolved| BeamOptions { unresolved, polarised, ..BeamOptions::default() };
            let coarse = trace(&polytope, medium, &view, &options(0.2), &unwatched).unwrap();
            let summed = summed(&polytope, medium, &view, &options(0.2));
            let finer = trace(&polytope, medium, &view, &options(0.02), &unwatched).unwrap();
            let tail = Tail::new(&polytope, &summed).unwrap();
            let (mut compared, mut start) = (0, 0.0);
            for (number, source) in tail.sources.iter().enumerate() {
                let place = f64::midpoint(start, source.until);
                start = source.until;
                if number % 5 != 0 {
                    continue;
                }
                let spot = DVec2::new(0.37, 0.61);
                let beam = summed.open.get(source.front.node);
                let point = point_in_polygon(beam.outline, beam.area, spot);
                let (before, last) = way(&coarse, point);
                assert_eq!(coarse.get(last).outline, beam.outline);
                let mut exits = vec![];
                // Without luck the ray is followed to the end, and light that goes on only by chance counts for more.
                let ray = tail.follow(place, spot, 0.0, |exit| exits.push((exit.direction, exit.share)));
                let (beyond, _) = way(&finer, point);
                let mut left = medium.transmittance(beam.path.at(point)) / beam.transmittance;
                for ((direction, share), (exit, weight)) in exits.iter().zip(&beyond[before.len()..]) {
                    let share = share / (ROULETTE / left).max(1.0);
                    let expected = weight / beam.onward;
                    assert!((*direction - *exit).length() < 1e-9, "{direction} is not {exit}");
                    // Beams use the mean of absorption over their outline, and a ray uses its value at its point.
                    let slack = if medium.is_clear() { 1e-9 } else { 0.2 * expected };
                    assert!((share - expected).abs() < slack, "{share} of the light leaves, not {expected}");
                    left -= share;
                    compared += 1;
                    if !medium.is_clear() {
                        break;
                    }
                }
                assert!(medium.is_clear() || ray.absorbed > 0.0);
            }
            assert!(compared > 30, "only {compared} exits were compared");
        }
    }

    #[test]
    fn all_rays_together_stand_for_the_light_and_the_area_that_were_left() {
        let polytope = brilliant();
        let view = View { tilt: 0.2, ..View::default() };
        let options = BeamOptions { unresolved: 0.1, ..BeamOptions::default() };
        let summed = summed(&polytope, Medium::clear(2.42), &view, &options);
        let tail = Tail::new(&polytope, &summed).unwrap();
        assert!((tail.light() - summed.sums.unresolved).abs() < 1e-9);
        assert!((tail.undecided() - summed.sums.undecided).abs() < 1e-9);
        let rays = 20_000;
        let (mut light, mut area, mut shares) = (0.0, 0.0, 0.0);
        for k in 0..rays {
            let place = (f64::from(k) + 0.5) / f64::from(rays);
            let fraction = |step: f64| (f64::from(k) * step).fract();
            let mut left = 0.0;
            let spot = DVec2::new(fraction(0.754_877_666), fraction(0.569_840_291));
            let ray = tail.follow(place, spot, fraction(0.618_033_989), |exit| left += exit.share);
            light += ray.light / f64::from(rays);
            area += ray.area / f64::from(rays);
            shares += ray.light * (left + ray.absorbed + ray.unresolved) / f64::from(rays);
        }
        assert!((light / tail.light() - 1.0).abs() < 1e-3, "{light} for {}", tail.light());
        assert!((area / tail.undecided() - 1.0).abs() < 1e-2, "{area} for {}", tail.undecided());
        assert!((shares / tail.light() - 1.0).abs() < 3e-3, "{shares} for {}", tail.light());
    }
}
