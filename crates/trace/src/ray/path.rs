//! The path of one ray through a stone, facet by facet.

use super::facets::SolidFacets;
use super::light::PathLight;
use super::{Exit, Loss, MeetingRay, StoneTracer};
use crate::DispersedRay;
use brillianteer_optics::critical_angle;
use glam::DVec3;

/// A facet that a ray meets on its path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// The facet, by its index in the solid.
    pub facet: u32,
    /// The point where the ray meets the facet.
    pub point: DVec3,
    /// The number of this bounce inside, from 1; 0 where the ray enters.
    pub bounce: u32,
    /// The length of the path inside the stone up to this facet, in girdle radii.
    pub path: f64,
    /// The angle between the ray and the facet's normal, 0 to 90 degrees. It is measured in the air where the ray
    /// enters, and inside the stone after that.
    pub incidence: f64,
    /// The angle of incidence beyond which reflection is total, in degrees; `None` where reflection is never total,
    /// as for light that enters.
    pub critical: Option<f64>,
    /// The light that leaves: the glare where the ray enters, and refracted light after that. `None` where reflection
    /// is total.
    pub leaving: Option<Leaving>,
    /// The share of the ray's light that goes on inside.
    pub onward: f64,
}

/// Light that leaves a stone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leaving {
    /// The share of the ray's light that leaves here.
    pub share: f64,
    /// The direction in which the light travels, of length 1.
    pub direction: DVec3,
    /// The distance at which the light enters the solid again, if it does. The path ends where the light leaves; the
    /// light goes on.
    pub again: Option<f64>,
}

/// The path of a ray through a stone. The shares of all light that leaves along it and of its `rest` add up to 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    /// A point of the ray before the ray meets the stone.
    pub origin: DVec3,
    /// The ray's unit direction there.
    pub direction: DVec3,
    /// The facets in the order in which they are met, the first where the ray enters.
    pub steps: Vec<Step>,
    /// The light that was absorbed, or not followed any farther.
    pub rest: Loss,
}

/// A facet that the tracer's loop reaches, and the light before and after it.
pub(crate) struct SurfaceEvent<'a> {
    pub facet: u32,
    pub point: DVec3,
    /// The facet's unit outward normal at the point.
    pub normal: DVec3,
    pub path: f64,
    /// The share that has not been absorbed.
    pub left: f64,
    pub bounce: u32,
    /// The unit direction in which the light arrives.
    pub arriving: DVec3,
    /// The light that arrives, without absorption.
    pub light: &'a PathLight,
    /// The light that leaves; `None` where reflection is total.
    pub leaving: Option<ExitLight>,
    /// The weight that goes on inside.
    pub onward: f64,
}

/// The light that leaves at a surface event. Its fields are those of [`Exit`].
pub(crate) struct ExitLight {
    pub direction: DVec3,
    pub fan: DVec3,
    /// The displacement of the point over the range that the ray represents.
    pub shift: DVec3,
    pub weight: f64,
    pub spread: f64,
}

impl SurfaceEvent<'_> {
    /// Returns the light that leaves a stone of this index, without absorption; `None` where reflection is total.
    pub fn onward_outside(&self, index: f64) -> Option<PathLight> {
        self.leaving.as_ref()?;
        let enters = self.arriving.dot(self.normal) < 0.0;
        let split = self.light.split(self.arriving, self.normal, if enters { 1.0 / index } else { index });
        Some(if enters { split.reflected } else { split.passed })
    }

    #[inline]
    pub fn exit(&self) -> Option<Exit> {
        let &Self { facet, point, path, bounce, .. } = self;
        let &ExitLight { direction, fan, shift, weight, spread } = self.leaving.as_ref()?;
        Some(Exit { facet, point, path, direction, fan, shift, weight, bounce, surface: bounce == 0, spread })
    }
}

impl StoneTracer {
    /// Returns the path of a ray from a point outside, as far as [`follow`](Self::follow) follows it; `None` where
    /// the ray misses the stone. For a solid that is not convex the result is the first passage: light that leaves
    /// and enters again is reported and not followed.
    pub fn path(&self, origin: DVec3, direction: DVec3) -> Option<Path> {
        let met = self.meet(origin, direction)?;
        let mut steps = vec![];
        let start = self.start(&MeetingRay::from_eye(met, DispersedRay::new(origin, direction)));
        let least = self.options.least_weight;
        let tell = |meeting: SurfaceEvent| steps.push(self.step(&meeting));
        let rest = match &self.shape {
            SolidFacets::Planes(planes) => self.passage(&**planes, start, least, tell)?,
            SolidFacets::Triangles(triangles) => self.passage(triangles, start, least, tell)?,
            SolidFacets::Smooth(smooth) => self.passage(smooth, start, least, tell)?,
            SolidFacets::Wavy(wavy) => self.passage(wavy, start, least, tell)?,
        };
        Some(Path { origin, direction, steps, rest })
    }

    fn step(&self, meeting: &SurfaceEvent) -> Step {
        let &SurfaceEvent { facet, point, path, bounce, arriving, ref leaving, onward, .. } = meeting;
        let normal = self.shape.normal(facet as usize, point);
        let critical = if bounce > 0 { critical_angle(self.medium.index) } else { None };
        Step {
            facet,
            point,
            bounce,
            path,
            // The angle is computed from sine and cosine, because an arc cosine alone has few digits near the normal.
            incidence: arriving.cross(normal).length().atan2(arriving.dot(normal).abs()).to_degrees(),
            critical: critical.map(f64::to_degrees),
            leaving: leaving.as_ref().map(|l| Leaving {
                share: l.weight,
                direction: l.direction,
                again: self.shape.again(facet as usize, point, l.direction),
            }),
            onward,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::proportions;
    use crate::ray::{Camera, RayOptions};
    use brillianteer_math::{Plane, Polytope};
    use brillianteer_scene::{Medium, View};
    use glam::DVec2;
    use proptest::prelude::*;

    const CLEAR: Medium = Medium::clear(2.4175);

    /// Returns the names of all laws that a path through a solid breaks.
    fn faults(path: &Path, planes: &[Plane], index: f64) -> Vec<&'static str> {
        let all = path.steps.iter().map(|step| step.leaving.map_or(0.0, |l| l.share)).sum::<f64>();
        let off_balance = (all + path.rest.absorbed + path.rest.unresolved - 1.0).abs() > 1e-9;
        let mut faults = if off_balance { vec!["balance"] } else { vec![] };
        for (k, step) in path.steps.iter().enumerate() {
            let before = k.checked_sub(1).map(|k| &path.steps[k]);
            let from = before.map_or(path.origin, |b| b.point);
            faults.extend(faults_of(step, before, from, &planes[step.facet as usize], index));
        }
        faults
    }

    fn faults_of(
        step: &Step,
        before: Option<&Step>,
        from: DVec3,
        plane: &Plane,
        index: f64,
    ) -> impl Iterator<Item = &'static str> {
        let (way, sine) = (step.point - from, step.incidence.to_radians().sin());
        let across = plane.normal.cross(way).length() - sine * way.length();
        let bent =
            |l: Leaving| plane.normal.cross(l.direction).length() - sine * before.map_or(1.0, |_| index);
        let length = before.map_or(0.0, |b| b.path + way.length());
        let given = before.map_or(1.0, |b| b.onward);
        let kept = step.onward + step.leaving.map_or(0.0, |l| l.share);
        let is_beyond = |slack: f64| step.critical.is_some_and(|c| step.incidence > c + slack);
        let is_inside = step.leaving.is_none_or(|l| l.direction.dot(plane.normal) <= 0.0);
        let checks = [
            ("plane", plane.distance(step.point).abs() > 1e-12),
            ("incidence", across.abs() > 1e-9),
            ("length", (step.path - length).abs() > 1e-12),
            (
                "total",
                step.leaving.is_some() && is_beyond(1e-9) || step.leaving.is_none() && !is_beyond(-1e-9),
            ),
            (
                "bent",
                step.leaving.is_some_and(|l| bent(l).abs() > 1e-9) || step.leaving.is_some() && is_inside,
            ),
            ("gain", kept > given + 1e-12),
        ];
        checks.into_iter().filter(|(_, wrong)| *wrong).map(|(name, _)| name)
    }

    fn tracer(polytope: &Polytope, medium: Medium, polarised: bool) -> StoneTracer {
        StoneTracer::new(polytope, medium, RayOptions { polarised, ..RayOptions::default() })
    }

    /// Returns the ray through a point of a view's image.
    fn ray(polytope: &Polytope, tilt: f64, (x, y): (f64, f64)) -> (DVec3, DVec3) {
        Camera::new(&View { tilt, ..View::default() }, polytope).ray(DVec2::new(x, y))
    }

    fn media() -> impl Strategy<Value = Medium> {
        let absorption = prop_oneof![Just([0.0; 2]), Just([0.3, 0.9])];
        (1.0..2.9_f64, absorption)
            .prop_map(|(index, absorption)| Medium { absorption, ..Medium::clear(index) })
    }

    /// Returns a cube whose corners are cut off, and a path in it that meets facets with and without total reflection.
    fn in_a_cube() -> (Vec<Plane>, Path) {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z]
            .into_iter()
            .flat_map(|a| [Plane::new(a, 1.0), Plane::new(-a, 1.0)]);
        let corners = [-1.0, 1.0].map(|x| [-1.0, 1.0].map(|y| [-1.0, 1.0].map(|z| DVec3::new(x, y, z))));
        let corners = corners.into_iter().flatten().flatten().map(|c| Plane::new(c, 2.2));
        let polytope = Polytope::from_planes(&axes.chain(corners).collect::<Vec<_>>()).unwrap();
        let (origin, direction) = ray(&polytope, 0.3, (0.21, 0.34));
        let path = tracer(&polytope, CLEAR, true).path(origin, direction).unwrap();
        (polytope.planes().collect(), path)
    }

    proptest! {
        #[test]
        fn a_path_obeys_the_laws_and_leaves_what_its_ray_does(
            cut in proportions(), medium in media(), polarised in any::<bool>(),
            tilt in -1.5..1.5_f64, x in -0.9..0.9_f64, y in -0.9..0.9_f64,
        ) {
            let planes: Vec<Plane> = cut.facets().unwrap().into_iter().map(|(_, plane)| plane).collect();
            let polytope = Polytope::from_planes(&planes).unwrap();
            let tracer = tracer(&polytope, medium, polarised);
            let (origin, direction) = ray(&polytope, tilt, (x, y));
            let (path, mut exits) = (tracer.path(origin, direction), vec![]);
            let rest = tracer.follow(origin, direction, |e| exits.push((e.facet, e.point, e.bounce, e.weight, e.direction)));
            prop_assert_eq!(path.as_ref().map(|p| p.rest), rest);
            let Some(path) = path else { return Ok(()) };
            let left = path.steps.iter().filter_map(|s| Some((s.facet, s.point, s.bounce, s.leaving?.share, s.leaving?.direction)));
            prop_assert!(left.eq(exits));
            prop_assert_eq!(path.steps.len() as u32, path.rest.bounces + 1);
            let planes: Vec<Plane> = polytope.planes().collect();
            prop_assert_eq!(faults(&path, &planes, medium.index), Vec::<&str>::new());
        }
    }

    #[test]
    fn every_law_notices_what_breaks_it() {
        let (planes, path) = in_a_cube();
        assert_eq!(faults(&path, &planes, CLEAR.index), Vec::<&str>::new());
        let leaves = path.steps.iter().rposition(|s| s.leaving.is_some_and(|l| l.share > 1e-3)).unwrap();
        let total = path.steps.iter().position(|s| s.leaving.is_none()).unwrap();
        let told = |at: usize, spoil: &dyn Fn(&mut Step)| {
            let mut path = path.clone();
            spoil(&mut path.steps[at]);
            faults(&path, &planes, CLEAR.index)
        };
        let lost = Some(Leaving {
            share: 0.0,
            direction: planes[path.steps[total].facet as usize].normal,
            again: None,
        });
        assert!(told(leaves, &|s| s.point += DVec3::splat(1e-9)).contains(&"plane"));
        assert!(told(leaves, &|s| s.incidence += 1e-3).contains(&"incidence"));
        assert!(told(leaves, &|s| s.path += 1e-9).contains(&"length"));
        assert!(told(leaves, &|s| s.onward += 1e-6).contains(&"gain"));
        assert!(told(leaves, &|s| s.leaving = None).contains(&"total"));
        assert!(told(total, &|s| s.leaving = lost).contains(&"total"));
        assert!(told(leaves, &|s| s.leaving.as_mut().unwrap().share *= 1.001).contains(&"balance"));
        assert!(told(leaves, &|s| s.leaving.as_mut().unwrap().direction *= -1.0).contains(&"bent"));
        assert!(!faults(&path, &planes, CLEAR.index + 1e-4).is_empty(), "another index");
    }

    #[test]
    fn a_ray_straight_down_a_slab_goes_to_and_fro_by_the_formula() {
        let slab: Vec<Plane> = [DVec3::X, DVec3::Y, DVec3::Z]
            .into_iter()
            .flat_map(|a| [Plane::new(a, 1.0), Plane::new(-a, 1.0)])
            .collect();
        let polytope = Polytope::from_planes(&slab).unwrap();
        let path = tracer(&polytope, Medium::clear(1.5), true)
            .path(DVec3::new(0.1, 0.2, 5.0), DVec3::NEG_Z)
            .unwrap();
        // ((1.5 - 1) / (1.5 + 1))² = 0.04 is reflected at each surface.
        let shares = [0.04, 0.96 * 0.96, 0.96 * 0.96 * 0.04];
        for (step, share) in path.steps.iter().zip(shares) {
            let leaving = step.leaving.unwrap();
            assert!((leaving.share - share).abs() < 1e-12);
            assert_eq!((step.incidence, leaving.direction.z.abs()), (0.0, 1.0));
        }
        assert_eq!(path.steps.iter().map(|s| s.path).take(3).collect::<Vec<_>>(), [0.0, 2.0, 4.0]);
        assert_eq!(path.steps[0].critical, None);
        assert!((path.steps[1].critical.unwrap() - 41.810_314_895).abs() < 1e-8);
    }

    #[test]
    fn a_ray_beside_the_stone_has_no_path() {
        let (planes, _) = in_a_cube();
        let polytope = Polytope::from_planes(&planes).unwrap();
        assert_eq!(tracer(&polytope, CLEAR, true).path(DVec3::new(1.5, 0.0, 5.0), DVec3::NEG_Z), None);
    }
}
