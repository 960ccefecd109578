//! Gives the planes of a stone the symmetry that they have except for noise: each plane becomes the mean of all its
//! images.
//!
//! A stone that is uneven by more than its noise keeps its planes. The standard errors of a scan's planes decide (`likeness`).
//! A model has few corners, whose noise is not known. There the corners must not lie much farther from the evened stone than
//! from the one that was found.

use super::evening::Evening;
use super::likeness::Found;
use super::outline::LEAST_UPRIGHT;
use brillianteer_math::faceting::{Face, Faceted, MODELLED, PlaneError, deviation};
use brillianteer_math::{Facet, Plane, Polytope, Pose, Symmetry};
use glam::{DQuat, DVec3};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// The most turns that are tried: except for girdle facets, no gem has more of any kind.
const MOST_TURNS: u32 = 24;

/// Two planes may be images of each other where their normals differ by less than this (2.9 degrees), and their offsets by
/// less than this part of the largest. Noise causes far less, and facets differ by far more.
const LOOSE: f64 = 0.05;

/// The factor by which the corners of a model may lie farther from the evened stone than from the one that was found, or the
/// number of tolerances if that is more. Each facet of the found stone could follow the noise of its own few corners.
const EVEN: f64 = 5.0;

/// The factor by which the corners of a model may lie farther from the planes of the evened stone than from those that were found, root
/// mean square for each degree of freedom, where these are enough to know.
const AS_NEAR: f64 = 1.5;

/// The least number of degrees of freedom, beyond three for each plane, from which the noise of a model's corners is known.
const LEAST_FREEDOM: usize = 30;

/// The tolerance of planes whose corners deviate by no more than rounding, as a part of the size.
const EXACT: f64 = 2e-6;

/// The weight of differences in slope between girdle facets, which are thin, so that their slope is mostly noise.
const THIN: f64 = 0.25;

/// Normals that differ by less are the same except for rounding.
const ROUNDED: f64 = 1e-12;

/// The most facets of a stone that is evened, since all of them are compared with all.
const MOST_FACETS: usize = 1_000;

/// The planes among which images are sought.
pub(super) struct Match<'a> {
    planes: &'a [Plane],
    size: f64,
}

impl<'a> Match<'a> {
    pub fn loose(planes: &'a [Plane]) -> Self {
        Self { planes, size: planes.iter().map(|p| p.offset.abs()).fold(f64::MIN_POSITIVE, f64::max) }
    }

    /// Returns the place of the plane that is nearest to a given one, if it is near enough to be the same.
    pub fn find(&self, image: &Plane) -> Option<usize> {
        let upright = |p: &Plane| p.normal.z.abs() < LEAST_UPRIGHT;
        let off = |p: &Plane| {
            let mut apart = p.normal - image.normal;
            if upright(p) && upright(image) {
                apart.z *= THIN;
            }
            apart.length().max((p.offset - image.offset).abs() / self.size)
        };
        let near = self.planes.iter().map(off).enumerate().filter(|(_, d)| *d < LOOSE);
        near.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i)
    }

    /// Returns, for each plane, the place of the plane that the map carries it to; `None` unless that is a permutation.
    fn permutation(&self, map: impl Fn(&Plane) -> Plane) -> Option<Vec<usize>> {
        let mut taken = vec![false; self.planes.len()];
        let image = |p| self.find(&map(p)).filter(|&i| !std::mem::replace(&mut taken[i], true));
        self.planes.iter().map(image).collect()
    }
}

/// Returns the centroid of a solid's volume.
pub(super) fn centroid(polytope: &Polytope) -> DVec3 {
    let apex = polytope.vertices()[0];
    let (mut content, mut moment) = (0.0, DVec3::ZERO);
    for facet in polytope.facets() {
        let corners: Vec<DVec3> = polytope.corners(facet).map(|c| c - apex).collect();
        for w in corners[1..].windows(2) {
            let cone = corners[0].dot(w[0].cross(w[1]));
            content += cone;
            moment += cone * (corners[0] + w[0] + w[1]) / 4.0;
        }
    }
    apex + moment / content
}

/// Planes about a middle, with +z along the axis, and the symmetry that was given to them.
pub(super) struct Even {
    pub planes: Vec<Plane>,
    /// The rotation from the frame of the planes that were found.
    pub turn: DQuat,
    /// The shift after the rotation.
    pub shift: DVec3,
    pub turns: u32,
    /// The azimuth of a mirror plane, radians; `None` without one.
    pub mirror: Option<f64>,
}

impl Even {
    /// Returns the symmetry as it is after a further turn about the axis.
    pub fn symmetry(&self, turn: DQuat) -> Symmetry {
        let across = |azimuth: f64| turn * DVec3::new(azimuth.cos(), azimuth.sin(), 0.0);
        let azimuth = |v: DVec3| v.y.atan2(v.x).rem_euclid(PI);
        Symmetry { turns: self.turns, mirror: self.mirror.map(|m| azimuth(across(m))) }
    }

    fn mapped(&self, quarter: Option<f64>, turn: u32) -> impl Fn(&Plane) -> Plane + use<> {
        let rotation = DQuat::from_rotation_z(TAU * f64::from(turn) / f64::from(self.turns));
        move |plane| quarter.map_or(*plane, |m| mirrored(plane, m)).placed(&Pose::turned(rotation))
    }
}

/// Returns the plane mirrored in the upright plane of an azimuth.
pub(super) fn mirrored(plane: &Plane, azimuth: f64) -> Plane {
    let (sin, cos) = (2.0 * azimuth).sin_cos();
    let n = plane.normal;
    Plane::new(DVec3::new(cos * n.x + sin * n.y, sin * n.x - cos * n.y, n.z), plane.offset)
}

/// The facets that were found, moved so that a chosen middle is the origin.
pub(super) struct FacetParts {
    pub planes: Vec<Plane>,
    pub areas: Vec<f64>,
    /// The mean of each facet's corners, about the middle.
    middles: Vec<DVec3>,
    /// The corners of the surface.
    corners: Vec<DVec3>,
    /// The greatest distance that the corners may have from an evened stone. `None` where the planes stay as found: those of a surface
    /// with too many corners for a model ([`MODELLED`]), whose noise is not known and whose tolerance is above [`EXACT`].
    limit: Option<f64>,
    /// The standard errors of the planes of a scan.
    errors: Option<Vec<PlaneError>>,
    /// The corners that lie on each plane within its tolerance.
    on: Vec<Vec<u32>>,
    /// The least distance from their planes that is taken for the noise of corners.
    rounding: f64,
}

impl FacetParts {
    /// Returns the facets about a point.
    pub fn about(found: &Faceted, middle: DVec3) -> Self {
        let about = |plane: &Plane| Plane::new(plane.normal, -plane.distance(middle));
        let solid = &found.polytope;
        let errors =
            found.faces.iter().map(|f| Some(f.error?.placed(&Pose { at: -middle, ..Pose::STILL }))).collect();
        let is_modelled = found.surface.vertices.len() <= MODELLED * found.faces.len()
            || found.tolerance <= EXACT * found.surface.size();
        let centre = |f: &Facet| solid.corners(f).sum::<DVec3>() / f.outline.len() as f64 - middle;
        let on = |f: &Face| {
            let lies = |v: &DVec3| f.plane.distance(*v).abs() <= found.tolerance;
            (0..).zip(&found.surface.vertices).filter(|(_, v)| lies(v)).map(|(v, _)| v).collect()
        };
        let is_compared =
            found.surface.vertices.len() <= MODELLED * found.faces.len() && found.faces.len() <= MOST_FACETS;
        Self {
            on: if is_compared { found.faces.par_iter().map(on).collect() } else { vec![] },
            rounding: EXACT * found.surface.size(),
            planes: found.faces.iter().map(|f| about(&f.plane)).collect(),
            // The areas of the solid's facets, not of the triangles, as noise puts some triangles to a neighbouring facet.
            areas: solid.facets().iter().map(|f| solid.facet_area(f)).collect(),
            middles: solid.facets().iter().map(centre).collect(),
            corners: found.surface.vertices.iter().map(|&v| v - middle).collect(),
            limit: is_modelled.then_some(EVEN * found.deviation.max(found.tolerance)),
            errors,
        }
    }
}

/// Returns the planes with their axis upright, evened where the noise allows it. The axis may follow the symmetry, unless
/// it is fixed.
pub(super) fn evened(parts: &FacetParts, axis: DVec3, is_fixed: bool, evening: Evening) -> Even {
    let FacetParts { planes, areas, .. } = parts;
    let plain = upright(planes, axis);
    if planes.len() > MOST_FACETS || evening == Evening::AsFound {
        return plain;
    }
    let tried = (1..=MOST_TURNS).rev().flat_map(|turns| {
        let axis = if is_fixed { axis } else { refined(planes, areas, axis, turns) };
        let plain = Even { turns, ..upright(planes, axis) };
        let mirror = best_mirror(&plain, areas);
        [(turns, axis, mirror), (turns, axis, None)]
    });
    let wanted = tried.filter(|(turns, _, mirror)| *turns > 1 || mirror.is_some());
    let start = wanted.map(|(turns, axis, mirror)| Even { turns, mirror, ..upright(planes, axis) });
    let mut fitting = start.filter_map(|start| {
        let images = Images::of(&start)?;
        match &parts.errors {
            Some(errors) => parts.likely(errors, &start, &images, is_fixed),
            None => parts.near(&start, &images),
        }
    });
    fitting.next().unwrap_or(plain)
}

impl FacetParts {
    /// Returns the even stone of a scan, with facets of the girdle upright if that is likely, where it is as likely as the
    /// stone that was found.
    fn likely(&self, errors: &[PlaneError], start: &Even, images: &Images, is_fixed: bool) -> Option<Even> {
        let size = self.corners.iter().map(|corner| corner.length()).fold(0.0, f64::max);
        let found = Found { planes: &self.planes, errors, size };
        let square = |even: Even| {
            let square = squared(&even, &self.middles);
            // Each orbit of facets loses its slope.
            let is_turned = |f: usize| (even.planes[f].normal - square.planes[f].normal).length() > ROUNDED;
            let orbits = images.orbits(is_turned);
            (averaged(&square, images).unwrap_or(even), orbits)
        };
        let upright = found.likely(start, images, is_fixed, square);
        upright.or_else(|| found.likely(start, images, is_fixed, |even| (even, 0)))
    }

    /// Returns whether a model's corners lie nearly as close to the planes of an even stone as to those that were found, on average.
    fn is_as_near(&self, even: &[Plane], images: &Images) -> bool {
        let count: usize = self.on.iter().map(Vec::len).sum();
        let numbers = 3 * self.planes.len();
        if count < numbers + LEAST_FREEDOM {
            return true;
        }
        let squares = |planes: &[Plane]| -> f64 {
            let of = |(plane, on): (&Plane, &Vec<u32>)| -> f64 {
                on.iter().map(|&v| plane.distance(self.corners[v as usize]).powi(2)).sum()
            };
            planes.iter().zip(&self.on).map(of).sum()
        };
        let noise = (squares(&self.planes) / (count - numbers) as f64).max(self.rounding.powi(2));
        let fewer = numbers.saturating_sub(images.constraints());
        squares(even) / (count - fewer) as f64 <= AS_NEAR * AS_NEAR * noise
    }

    /// Returns the even stone of a model, where the model's corners lie nearly as close to it as to the stone that was found.
    fn near(&self, start: &Even, images: &Images) -> Option<Even> {
        let limit = self.limit?;
        let fits = |even: &Even| {
            let back: Vec<Plane> =
                even.planes.iter().map(|p| p.placed(&Pose::turned(even.turn.inverse()))).collect();
            self.is_as_near(&back, images)
                && Polytope::from_planes(&back).is_ok_and(|solid| deviation(&solid, &self.corners) <= limit)
        };
        let even = averaged(start, images)?;
        // Where girdle facets lie at different heights, putting them upright shifts them by different amounts, so they
        // are averaged once more.
        let square = squared(&even, &self.middles);
        let both = [Images::of(&square).and_then(|images| averaged(&square, &images)), Some(even)];
        both.into_iter().flatten().find(fits)
    }
}

/// Returns the planes turned so that the axis is +z.
pub(super) fn upright(planes: &[Plane], axis: DVec3) -> Even {
    let turn = DQuat::from_rotation_arc(axis, DVec3::Z);
    Even {
        planes: planes.iter().map(|p| p.placed(&Pose::turned(turn))).collect(),
        turn,
        shift: DVec3::ZERO,
        turns: 1,
        mirror: None,
    }
}

/// Returns the axis that the whole crown and pavilion have, not the table alone: the normal of the girdle's plane.
///
/// Only a stone with rotational symmetry has such an axis; where `turns` is 1 the given axis is returned.
fn refined(planes: &[Plane], areas: &[f64], axis: DVec3, turns: u32) -> DVec3 {
    if turns == 1 {
        return axis;
    }
    let sum: DVec3 = planes
        .iter()
        .zip(areas)
        .map(|(p, area)| (p.normal.dot(axis), p.normal * *area))
        .filter(|(up, _)| up.abs() > LEAST_UPRIGHT)
        .map(|(up, n)| n * up.signum())
        .sum();
    sum.try_normalize().filter(|found| found.dot(axis) > 1.0 - LOOSE * LOOSE).unwrap_or(axis)
}

/// Returns the azimuth of the mirror that carries the planes onto one another with the least misfit. It is the mean of the
/// azimuths that the pairs of planes give.
fn best_mirror(plain: &Even, areas: &[f64]) -> Option<f64> {
    let azimuth = |p: &Plane| p.normal.y.atan2(p.normal.x);
    let level = |i: &usize| plain.planes[*i].normal.truncate().length() > LOOSE;
    let first = (0..plain.planes.len())
        .filter(level)
        .max_by(|&a, &b| areas[a].total_cmp(&areas[b]).then(b.cmp(&a)))?;
    let same = |p: &&Plane| (p.normal.z - plain.planes[first].normal.z).abs() < LOOSE;
    let list = Match::loose(&plain.planes);
    let tried =
        plain.planes.iter().filter(same).filter(|p| p.normal.truncate().length() > LOOSE).filter_map(|p| {
            let guess = (azimuth(&plain.planes[first]) + azimuth(p)) / 2.0;
            let images = list.permutation(|p| mirrored(p, guess))?;
            // Twice the mirror's azimuth is the sum of a pair's; thin facets, whose azimuths are noise, count little.
            let pair = |((p, i), area): ((&Plane, &usize), &f64)| {
                let (a, b) = (p.normal, plain.planes[*i].normal);
                *area * DVec3::new(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x, 0.0)
            };
            let sum: DVec3 = plain.planes.iter().zip(&images).zip(areas).map(pair).sum();
            let refined = sum.y.atan2(sum.x) / 2.0;
            let gap =
                |(p, i): (&Plane, &usize)| (mirrored(p, refined).normal - plain.planes[*i].normal).length();
            let misfit = plain.planes.iter().zip(&images).map(gap).fold(0.0, f64::max);
            Some((misfit, refined))
        });
    tried.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, mirror)| mirror)
}

/// The places of the planes that each map of a symmetry carries the planes to. The maps are the turns, and the turns after the
/// mirror.
pub(super) struct Images {
    maps: Vec<Map>,
}

/// One map of a symmetry.
struct Map {
    /// The azimuth of the mirror that comes before the turn, radians; `None` without one.
    mirror: Option<f64>,
    turn: u32,
    /// The place of the plane that each plane is carried to.
    images: Vec<usize>,
}

impl Images {
    /// Finds the images of a stone's planes; `None` where the symmetry does not carry planes onto planes.
    pub fn of(even: &Even) -> Option<Self> {
        let list = Match::loose(&even.planes);
        let mirrors = std::iter::once(None).chain(even.mirror.map(Some));
        let maps = mirrors.flat_map(|mirror| (0..even.turns).map(move |turn| (mirror, turn)));
        let maps = maps.map(|(mirror, turn)| {
            Some(Map { mirror, turn, images: list.permutation(even.mapped(mirror, turn))? })
        });
        Some(Self { maps: maps.collect::<Option<_>>()? })
    }

    /// Returns the number of different facets among those for whose places a test holds, where images of one another count as one.
    fn orbits(&self, test: impl Fn(usize) -> bool) -> usize {
        let planes = self.maps.first().map_or(0, |map| map.images.len());
        let own = |plane: usize| self.maps.iter().filter(|map| map.images[plane] == plane).count();
        let sum: usize = (0..planes).filter(|&plane| test(plane)).map(own).sum();
        (sum as f64 / self.maps.len() as f64).round() as usize
    }

    /// Returns the number of equations that the symmetry sets for the planes' numbers, three for each plane, in a fixed frame.
    pub fn constraints(&self) -> usize {
        let planes = self.maps.first().map_or(0, |map| map.images.len());
        let numbers = |plane: usize| {
            let own = |is_mirror: bool| {
                let maps = self.maps.iter().filter(|map| map.mirror.is_some() == is_mirror);
                maps.filter(|map| map.images[plane] == plane).count()
            };
            // A level facet has its height alone, one across a mirror its slope and distance. Facets that are images of one
            // another share their numbers.
            let all = match (own(false), own(true)) {
                (2.., _) => 1,
                (_, 1..) => 2,
                _ => 3,
            };
            (all * (own(false) + own(true))) as f64 / self.maps.len() as f64
        };
        3 * planes - (0..planes).map(numbers).sum::<f64>().round() as usize
    }
}

/// Returns each plane as the mean of its images, carried back; `None` where a mean has no direction.
pub(super) fn averaged(even: &Even, images: &Images) -> Option<Even> {
    let mut sums = vec![(DVec3::ZERO, 0.0); even.planes.len()];
    for Map { mirror, turn, images } in &images.maps {
        // A mirror followed by a turn is again a mirror, which is its own inverse.
        let back = even.mapped(*mirror, if mirror.is_some() { *turn } else { even.turns - turn });
        for (sum, &image) in sums.iter_mut().zip(images) {
            let plane = back(&even.planes[image]);
            *sum = (sum.0 + plane.normal, sum.1 + plane.offset);
        }
    }
    let count = images.maps.len() as f64;
    let plane = |(normal, offset): &(DVec3, f64)| {
        let unit = Plane::new(*normal, 0.0).normalized()?;
        Some(Plane::new(unit.normal, offset / count))
    };
    let planes = sums.iter().map(plane).collect::<Option<Vec<_>>>()?;
    Some(Even { planes, ..*even })
}

/// Returns the same planes with nearly upright facets exactly upright, and nearly level ones exactly level.
fn squared(even: &Even, middles: &[DVec3]) -> Even {
    let square = |(p, middle): (&Plane, &DVec3)| {
        let n = p.normal;
        let snapped = match (n.z.abs() < LOOSE, n.truncate().length() < LOOSE) {
            (true, _) => DVec3::new(n.x, n.y, 0.0),
            (_, true) => DVec3::Z * n.z.signum(),
            _ => n,
        };
        // Each facet is turned about its middle, which does not move.
        let middle = even.turn * *middle + even.shift;
        let foot = middle - p.distance(middle) * n;
        Plane::new(snapped, snapped.dot(foot)).normalized().unwrap_or(*p)
    };
    Even { planes: even.planes.iter().zip(middles).map(square).collect(), ..*even }
}
