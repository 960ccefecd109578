//! Rows of small stones: each in a collet of its own, with two beads between neighbours that hold both.

use super::gem::{CLEARANCE_MM, MountedStone, SetStone};
use super::head::upright;
use super::rod::{Station, rod};
use super::skin::rounded;
use super::turned::turned;
use super::{MetalPart, Mounting, Ring, RingError, RingSeat, SeatKind};
use crate::MOST_STONES;
use brillianteer_math::Pose;
use glam::{DQuat, DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// The thickness of a collet's wall, as a part of the gap between girdles: neighbouring walls overlap, but do not
/// reach the neighbour's stone.
const WALL: f64 = 0.75;

/// The greatest thickness of a collet's wall, in mm.
const THICKEST_MM: f64 = 0.35;

/// The radius of a bead, and the distance of its middle from the stones' girdles, as parts of a stone's radius.
const BEAD: f64 = 0.3;
const BEAD_APART: f64 = 0.14;

/// The sizes of a small stone, in mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct SmallSizes {
    /// The radius of the girdle's circle.
    pub radius: f64,
    /// The height of the girdle's lower edge; the upper is at 0.
    pub girdle: f64,
    /// The height of the lowest point.
    pub low: f64,
}

/// Returns the sizes of a small stone.
///
/// # Errors
/// Fails where the stone's axis does not run through it.
pub(super) fn sizes(stone: &SetStone) -> Result<SmallSizes, RingError> {
    let corners = stone.shape.vertices().iter().map(|&corner| corner * 0.5 * stone.diameter_mm);
    let radius = corners.clone().map(|corner| corner.truncate().length()).fold(0.0, f64::max);
    let at_girdle = corners.filter(|corner| corner.truncate().length() > 0.98 * radius);
    let girdle = at_girdle.map(|corner| corner.z).fold(0.0, f64::min);
    let section = stone.section(0.0);
    if section.len() < 3 || section.iter().all(|at| at.x > 1e-9) {
        return Err(RingError::OffAxis { key: "small_stone" });
    }
    Ok(SmallSizes { radius, girdle, low: stone.heights()[0] })
}

/// Checks the number of small stones.
pub(super) fn check_count(count: usize) -> Result<(), RingError> {
    let most = MOST_STONES - 1;
    if count > most { Err(RingError::TooMany { count, most }) } else { Ok(()) }
}

/// The circle of the stones of an eternity band.
struct BandCircle {
    /// The radius of the circle, in mm.
    around: f64,
    /// The radius at which neighbours are nearest, in mm.
    nearest: f64,
    /// The number of stones.
    count: usize,
}

fn band_circle(ring: &Ring, sizes: SmallSizes) -> Result<BandCircle, RingError> {
    let around = ring.outer() + ring.culet_gap_mm - sizes.low;
    // Neighbours lean apart, so their girdles are nearest at the lower edge.
    let nearest = around + sizes.girdle;
    let half = (sizes.radius + 0.5 * ring.small_gap_mm) / nearest;
    let count = (PI / half.atan()).floor() as usize;
    check_count(count)?;
    Ok(BandCircle { around, nearest, count })
}

/// Returns the number of the small stones of an eternity band.
pub(super) fn eternity_count(ring: &Ring, small: &SetStone) -> Result<usize, RingError> {
    Ok(band_circle(ring, sizes(small)?)?.count)
}

/// Makes an eternity band: small stones all around the band; returns them in their places.
pub(super) fn eternity(
    ring: &Ring,
    small: &SetStone,
    mounting: &mut Mounting,
) -> Result<Vec<MountedStone>, RingError> {
    let sizes = sizes(small)?;
    let BandCircle { around, nearest, count } = band_circle(ring, sizes)?;
    let gap = 2.0 * (nearest * (PI / count as f64).tan() - sizes.radius) * (PI / count as f64).cos();
    mounting.small_gap_mm = Some(gap);
    let turns: Vec<f64> = (0..count).map(|k| TAU * k as f64 / count as f64).collect();
    let pose = |&turn: &f64| {
        let turn = DQuat::from_rotation_y(turn);
        upright(turn * (DVec3::Z * around), turn)
    };
    let poses: Vec<Pose> = turns.iter().map(pose).collect();
    let stones = seats(small, &poses, mounting);
    // The collet goes down into the band.
    let low = sizes.low - ring.culet_gap_mm - 0.4 * ring.thickness_mm;
    collets(small, sizes, &poses, gap, low, mounting);
    let between = TAU * 0.5 / count as f64;
    for turn in turns {
        let turn = DQuat::from_rotation_y(turn + between);
        let middle = turn * (DVec3::Z * around / between.cos());
        beads(sizes, gap, (middle, turn * DVec3::Z, DVec3::Y), &stones, mounting);
    }
    Ok(stones)
}

/// Puts small stones into their seats.
pub(super) fn seats(small: &SetStone, poses: &[Pose], mounting: &mut Mounting) -> Vec<MountedStone> {
    let sit = |at: &Pose| {
        let pose = small.pose(at.at, at.turn);
        mounting.seats.push(RingSeat { kind: SeatKind::Small, pose });
        MountedStone::new(small, &pose)
    };
    poses.iter().map(sit).collect()
}

/// Makes a collet for each small stone: a turned cup whose inside follows the pavilion, down to the height `low`.
pub(super) fn collets(
    small: &SetStone,
    sizes: SmallSizes,
    poses: &[Pose],
    gap: f64,
    low: f64,
    mounting: &mut Mounting,
) {
    let wall = (WALL * gap).min(THICKEST_MM);
    let radius = sizes.radius;
    let bottom = low.min(sizes.low - 0.1);
    // A cone through the girdle and the widest part of the pavilion leaves the whole pavilion inside.
    let lower = small.shape.vertices().iter().map(|&corner| corner * 0.5 * small.diameter_mm);
    let slope = |corner: DVec3| {
        let inward = radius - corner.truncate().length();
        if inward > 1e-9 { (sizes.girdle - corner.z) / inward } else { 0.0 }
    };
    let steepest = lower.filter(|corner| corner.z < sizes.girdle).map(slope).fold(0.2, f64::max);
    let seat = radius + CLEARANCE_MM;
    let hole = 0.35 * radius;
    let ledge = sizes.girdle - CLEARANCE_MM * 2.0;
    let cup_low = (ledge - steepest * (seat - hole)).max(bottom + 0.05);
    let line = rounded(&[
        (DVec2::new(hole, bottom), 0.0),
        (DVec2::new(0.8 * (radius + wall), bottom), 0.0),
        (DVec2::new(radius + wall, sizes.girdle - 0.5 * radius), 0.3),
        (DVec2::new(radius + wall, 0.25 * sizes.girdle), 0.4 * wall),
        (DVec2::new(seat, 0.25 * sizes.girdle), 0.3 * wall),
        (DVec2::new(seat, ledge), 0.0),
        (DVec2::new(hole, cup_low), 0.0),
    ]);
    let cup = turned(&line);
    let placed = poses.iter().map(|pose| MetalPart { name: "collet", surface: cup.placed(pose) });
    mounting.metal.extend(placed);
}

/// Makes the two beads between two neighbours: `middle` lies between their girdles, `up` points as their tables do on
/// average, and `aside` square to the row.
pub(super) fn beads(
    sizes: SmallSizes,
    gap: f64,
    (middle, up, aside): (DVec3, DVec3, DVec3),
    stones: &[MountedStone],
    mounting: &mut Mounting,
) {
    let radius = BEAD * sizes.radius;
    let half = sizes.radius + 0.5 * gap;
    let from_stones = sizes.radius + BEAD_APART * sizes.radius;
    let apart = (from_stones * from_stones - half * half).max(0.0).sqrt().max(0.3 * sizes.radius);
    for side in [1.0, -1.0] {
        let foot = middle + aside * (side * apart);
        let top = 0.1 * sizes.radius;
        let heights = [0.6 * sizes.low, 0.3 * sizes.low, 2.0 * sizes.girdle, sizes.girdle, 0.0, top];
        let station = |&height: &f64| Station {
            at: foot + up * height,
            along: up,
            out: aside * side,
            radius,
            inward: f64::INFINITY,
        };
        let mut stations: Vec<Station> = heights.iter().map(station).collect();
        stations.dedup_by(|a, b| a.at.distance(b.at) < 1e-6);
        mounting.metal.push(MetalPart { name: "bead", surface: rod(&stations, stones) });
    }
}
