//! The halo: a circle of small stones around the main stone, on a rail that struts join to the prongs.

use super::gem::{MountedStone, SetStone};
use super::head::{self, Prongs, apart, upright};
use super::rod::{Station, rod};
use super::row::{SmallSizes, beads, check_count, collets, seats, sizes};
use super::turned::{turned, wire};
use super::{MetalPart, Mounting, Ring, RingError};
use crate::MOST_STONES;
use brillianteer_math::Pose;
use glam::{DQuat, DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// The distance of the small stones' girdles below the main stone's, as a part of their radius.
const LOWER: f64 = 0.25;

/// The least gap between a prong and a small stone, in mm.
const FREE_MM: f64 = 0.02;

/// The gap between small stones and the rail under them, in mm.
const BELOW_MM: f64 = 0.05;

/// The circle of a halo.
struct Circle {
    count: usize,
    radius: f64,
    /// The gap between neighbours, in mm.
    gap: f64,
    /// The gap between a small stone and the main stone, in mm.
    inner: f64,
}

/// Makes head and halo; returns all stones in their places.
pub(super) fn halo(
    ring: &Ring,
    stone: &SetStone,
    small: &SetStone,
    mounting: &mut Mounting,
) -> Result<Vec<MountedStone>, RingError> {
    let prongs = head::prongs(ring, stone)?;
    let sizes = sizes(small)?;
    let circle = circle(ring, stone, sizes)?;
    mounting.small_gap_mm = Some(circle.gap);
    let mut stones = vec![head::seat(ring, stone, &prongs, mounting)];
    let height = prongs.lift - LOWER * sizes.radius;
    let azimuth = |k: f64| TAU * k / circle.count as f64;
    let pose = |k: usize| {
        let turn = DQuat::from_rotation_z(azimuth(k as f64 + 0.5));
        upright(turn * (DVec3::X * circle.radius) + DVec3::Z * height, turn)
    };
    let poses: Vec<Pose> = (0..circle.count).map(pose).collect();
    stones.extend(seats(small, &poses, mounting));
    head::metal(ring, &prongs, &stones, mounting);
    // The collets go down into the rail, which stays below their stones.
    let wire = 0.5 * ring.rail_diameter_mm;
    let under = sizes.low - BELOW_MM - wire;
    let low = under + 0.3 * wire;
    collets(small, sizes, &poses, circle.gap.min(circle.inner), low, mounting);
    for k in 0..circle.count {
        let outward = DVec2::from_angle(azimuth(k as f64)).extend(0.0);
        let middle = outward * (circle.radius * (PI / circle.count as f64).cos()) + DVec3::Z * height;
        beads(sizes, circle.gap, (middle, DVec3::Z, outward), &stones, mounting);
    }
    carry(ring, &prongs, &circle, height + under, &stones, mounting);
    Ok(stones)
}

/// Returns the number of the small stones of a halo.
pub(super) fn halo_count(ring: &Ring, stone: &SetStone, small: &SetStone) -> Result<usize, RingError> {
    Ok(circle(ring, stone, sizes(small)?)?.count)
}

/// Returns the circle of small stones that leaves the main stone's girdle and its prongs free and has the narrowest gaps. The
/// prongs stand in the gaps between small stones, whose number is a multiple of theirs.
fn circle(ring: &Ring, stone: &SetStone, sizes: SmallSizes) -> Result<Circle, RingError> {
    let corners = stone.shape.vertices().iter();
    let girdle = corners.map(|v| v.truncate().length()).fold(0.0, f64::max) * 0.5 * stone.diameter_mm;
    let prongs = ring.style.prongs();
    let (at, thick) = (girdle + apart(ring), 0.5 * ring.prong_diameter_mm);
    let half = sizes.radius + 0.5 * ring.small_gap_mm;
    let beside = girdle + sizes.radius + ring.small_gap_mm;
    // The distance of a small stone from the prong beside it.
    let needed = sizes.radius + thick + FREE_MM;
    let of = |count: usize| {
        let (sin, cos) = (PI / count as f64).sin_cos();
        let across = at * sin;
        let behind = at * cos + (needed * needed - across * across).max(0.0).sqrt();
        let radius = (half / sin).max(beside).max(behind);
        Circle {
            count,
            radius,
            gap: 2.0 * (radius * sin - sizes.radius),
            inner: radius - sizes.radius - girdle,
        }
    };
    // Beyond this number the circle only grows, or holds more stones than a scene may.
    let most = ((PI * (beside + thick) / half) as usize).min(MOST_STONES) + 2 * prongs;
    let circles = (1..=most / prongs).map(|k| of(k * prongs));
    let best = circles.min_by(|a, b| (a.gap + a.inner).total_cmp(&(b.gap + b.inner)));
    let best = best.ok_or(RingError::NoSmallStone { style: ring.style })?;
    check_count(best.count)?;
    Ok(best)
}

/// Makes the rail under the halo, and a strut from each prong to it.
fn carry(
    ring: &Ring,
    prongs: &Prongs,
    circle: &Circle,
    height: f64,
    stones: &[MountedStone],
    mounting: &mut Mounting,
) {
    let radius = 0.5 * ring.rail_diameter_mm;
    let line = wire(DVec2::new(circle.radius, height), radius);
    mounting.metal.push(MetalPart { name: "halo rail", surface: turned(&line) });
    for prong in &prongs.prongs {
        // The strut leaves the prong's leg below the rail.
        let leg: Vec<DVec2> = prong.way.iter().filter(|at| !at.is_beside).map(|at| at.at).collect();
        let outward = DVec2::from_angle(prong.azimuth).extend(0.0);
        let world = |at: DVec2| outward * at.x + DVec3::Z * at.y;
        let below = |at: &&DVec2| at.y + prongs.lift < height - radius;
        let Some(from) = leg.iter().rev().find(below).or(leg.first()) else { continue };
        let from = world(*from + DVec2::Y * prongs.lift);
        let to = world(DVec2::new(circle.radius, height));
        let along = (to - from).normalize_or_zero();
        let out = along.cross(outward.cross(DVec3::Z)).normalize_or_zero();
        let station = |part: f64| Station {
            at: from.lerp(to, part),
            along,
            out,
            radius: 0.8 * radius,
            inward: f64::INFINITY,
        };
        let stations: Vec<Station> = [0.0, 0.25, 0.5, 0.75, 1.0].map(station).to_vec();
        mounting.metal.push(MetalPart { name: "strut", surface: rod(&stations, stones) });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_math::{Plane, Polytope};

    #[test]
    fn a_halo_holds_as_many_stones_as_a_scene_may() {
        let sides = DVec3::AXES.into_iter().flat_map(|axis| [Plane::new(axis, 1.0), Plane::new(-axis, 1.0)]);
        let shape = Polytope::from_planes(&sides.collect::<Vec<_>>()).unwrap();
        let ring = Ring { style: super::super::RingStyle::Halo, ..Ring::default() };
        let small = sizes(&SetStone { shape: &shape, diameter_mm: ring.small_diameter_mm }).unwrap();
        let (mut most, mut refused) = (0, 0);
        for k in 0..2000 {
            let stone = SetStone { shape: &shape, diameter_mm: 5.0 + 0.2 * f64::from(k) };
            match circle(&ring, &stone, small) {
                Ok(circle) => most = circle.count.max(most),
                Err(error) => {
                    assert!(matches!(error, RingError::TooMany { .. }), "{error}");
                    refused += 1;
                }
            }
        }
        // The number of small stones is a multiple of that of the prongs; one place is the main stone's.
        let possible = (MOST_STONES - 1) / ring.style.prongs() * ring.style.prongs();
        assert_eq!(most, possible);
        assert!(refused > 100, "{refused}");
    }
}
