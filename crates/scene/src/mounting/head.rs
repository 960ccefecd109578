//! The head: a base on the band, and prongs that rise from it around the main stone, joined by a rail.

use super::band::narrowed;
use super::gem::{MountedStone, SetStone};
use super::path::{Waypoint, way};
use super::rod::{Station, rod};
use super::skin::rounded;
use super::turned::{turned, wire};
use super::{MetalPart, Mounting, Ring, RingError, RingSeat, SeatKind};
use brillianteer_math::Pose;
use glam::{DQuat, DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// The height of the base above the band's middle, in mm.
const BASE_LIFT_MM: f64 = 0.15;

/// The height of the base's rim, in mm.
const RIM_MM: f64 = 0.5;

/// The radius of the circle on which prongs stand, as a part of the stone's.
const STANCE: f64 = 0.3;

/// The greatest slope of a prong's leg, as the tangent of its angle from upright.
const STEEPEST_LEG: f64 = 0.8;

/// The thickness of a prong's tip, as a part of the prong's.
const TIP: f64 = 0.7;

/// The place from which the rail is sought, from the base (0) to the girdle (1), and the step of the search.
const RAIL_AT: f64 = 0.5;
const RAIL_STEP: f64 = 0.05;

/// The least gap between rails and stones, in mm.
const RAIL_GAP_MM: f64 = 0.05;

/// The least gap between neighbouring prongs at the girdle, in mm.
const PRONG_GAP_MM: f64 = 0.3;

/// A prong: its azimuth around the stone, its way, and the outline of the stone that it grips.
pub(super) struct Prong {
    /// The azimuth about the stone's axis, radians.
    pub azimuth: f64,
    /// The way of its middle, from its foot, in the stone's frame.
    pub way: Vec<Waypoint>,
    /// The stone's half section at the azimuth.
    pub section: Vec<DVec2>,
}

/// The prongs of a head, and its heights.
pub(super) struct Prongs {
    /// The prongs.
    pub prongs: Vec<Prong>,
    /// The height of the stone's origin above the finger's axis, in mm.
    pub lift: f64,
    /// The height of the base's top, in mm.
    pub base: f64,
    /// The radius of the circle on which the prongs stand, in mm.
    pub stance: f64,
}

/// Makes the head of a solitaire; returns the stone in its place.
pub(super) fn head(
    ring: &Ring,
    stone: &SetStone,
    mounting: &mut Mounting,
) -> Result<Vec<MountedStone>, RingError> {
    let prongs = prongs(ring, stone)?;
    let mounted = vec![seat(ring, stone, &prongs, mounting)];
    metal(ring, &prongs, &mounted, mounting);
    Ok(mounted)
}

/// Puts the main stone into its seat.
pub(super) fn seat(ring: &Ring, stone: &SetStone, prongs: &Prongs, mounting: &mut Mounting) -> MountedStone {
    let pose = stone.pose(DVec3::Z * prongs.lift, DQuat::IDENTITY);
    mounting.seats.push(RingSeat { kind: SeatKind::Main, pose });
    mounting.culet_height_mm = Some(prongs.lift + stone.heights()[0] - ring.hole());
    MountedStone::new(stone, &pose)
}

/// Makes base, prongs and rail.
pub(super) fn metal(ring: &Ring, prongs: &Prongs, stones: &[MountedStone], mounting: &mut Mounting) {
    mounting.metal.push(MetalPart { name: "base", surface: turned(&base(ring, prongs)) });
    let radius = 0.5 * ring.prong_diameter_mm;
    for prong in &prongs.prongs {
        let stations: Vec<Station> =
            prong.way.iter().map(|at| station(at, prong, prongs.lift, radius, ring)).collect();
        mounting.metal.push(MetalPart { name: "prong", surface: rod(&stations, stones) });
    }
    if let Some(at) = rail(ring, prongs) {
        let line = wire(at + DVec2::Y * prongs.lift, 0.5 * ring.rail_diameter_mm);
        mounting.metal.push(MetalPart { name: "rail", surface: turned(&line) });
    }
}

/// Returns the distance of a prong's middle from the stone, in mm.
pub(super) fn apart(ring: &Ring) -> f64 {
    (0.5 - ring.notch) * ring.prong_diameter_mm
}

/// Lays out the prongs around a stone.
pub(super) fn prongs(ring: &Ring, stone: &SetStone) -> Result<Prongs, RingError> {
    let count = ring.style.prongs();
    let base = ring.outer() + BASE_LIFT_MM;
    let lift = base + ring.culet_gap_mm - stone.heights()[0];
    let azimuths = (0..count).map(|k| TAU * (k as f64 + 0.5) / count as f64);
    let sections: Vec<(f64, Vec<DVec2>)> =
        azimuths.map(|azimuth| (azimuth, stone.section(azimuth))).collect();
    if sections.iter().any(|(_, section)| section.len() < 3 || section.iter().all(|at| at.x > 1e-9)) {
        return Err(RingError::OffAxis { key: "stone" });
    }
    let radii = sections.iter().map(|(_, section)| section.iter().map(|at| at.x).fold(0.0, f64::max));
    let (least, most) = radii.fold((f64::INFINITY, 0.0_f64), |(l, m), r| (l.min(r), m.max(r)));
    let chord = 2.0 * (least + apart(ring)) * (PI / count as f64).sin();
    let lacking = ring.prong_diameter_mm + PRONG_GAP_MM - chord;
    if lacking > 0.0 {
        return Err(RingError::NoRoom {
            key: "prong_diameter_mm",
            what: "neighbouring prongs come too near to one another",
            by_mm: lacking,
            change: "lower it, or set a larger stone",
        });
    }
    let girdle = |(_, section): &(f64, Vec<DVec2>)| {
        section.iter().copied().max_by(|a, b| a.x.total_cmp(&b.x).then(b.y.total_cmp(&a.y)))
    };
    let leg = |at: DVec2| at.x + apart(ring) - STEEPEST_LEG * (at.y + lift - base);
    let stance = sections.iter().filter_map(girdle).map(leg).fold(STANCE * most, f64::max);
    let stance = stance.min(most + apart(ring));
    let foot = DVec2::new(stance, base - lift);
    let prong = |(azimuth, section): (f64, Vec<DVec2>)| {
        let way = way(&section, foot, apart(ring), ring.grip_mm).ok_or(RingError::NoRoom {
            key: "culet_gap_mm",
            what: "the prongs' feet stand too near to the stone",
            by_mm: apart(ring),
            change: "raise it, or lower prong_diameter_mm",
        })?;
        Ok(Prong { azimuth, way, section })
    };
    let prongs = sections.into_iter().map(prong).collect::<Result<_, RingError>>()?;
    Ok(Prongs { prongs, lift, base, stance })
}

/// Returns the place of a prong's middle in the ring's frame.
pub(super) fn station(way: &Waypoint, prong: &Prong, lift: f64, radius: f64, ring: &Ring) -> Station {
    let outward = DVec2::from_angle(prong.azimuth).extend(0.0);
    let world = |v: DVec2| outward * v.x + DVec3::Z * v.y;
    let thinned = 1.0 - (1.0 - TIP) * way.part * way.part * (3.0 - 2.0 * way.part);
    let inward = if way.is_beside { apart(ring) } else { f64::INFINITY };
    let at = world(way.at) + DVec3::Z * lift;
    Station { at, along: world(way.out.perp()), out: world(way.out), radius: radius * thinned, inward }
}

/// Returns the line of the base, a turned foot that goes down into the band.
fn base(ring: &Ring, prongs: &Prongs) -> Vec<DVec2> {
    let radius = prongs.stance + 0.5 * ring.prong_diameter_mm + 0.05;
    let low = ring.hole() + 0.4 * ring.thickness_mm;
    let narrow = (0.4 * ring.width_mm * narrowed(ring, 0.0)).min(radius);
    rounded(&[
        (DVec2::new(0.0, low), 0.0),
        (DVec2::new(narrow, low), 0.0),
        (DVec2::new(radius, prongs.base - RIM_MM), 0.5),
        (DVec2::new(radius, prongs.base), 0.15),
        (DVec2::new(0.0, prongs.base), 0.0),
    ])
}

/// Returns the place of the rail's wire in the stone's frame, as high below the girdle as the stone leaves room; `None` where
/// it leaves none.
fn rail(ring: &Ring, prongs: &Prongs) -> Option<DVec2> {
    let first = prongs.prongs.first()?;
    let (foot, beside) = (first.way.first()?.at, first.way.iter().find(|at| at.is_beside)?.at);
    let free = 0.5 * ring.rail_diameter_mm + RAIL_GAP_MM;
    let is_free = |at: DVec2| prongs.prongs.iter().all(|prong| distance(&prong.section, at) > free);
    let steps = (RAIL_AT / RAIL_STEP) as usize;
    (2..=steps).rev().map(|k| foot + (beside - foot) * (k as f64 * RAIL_STEP)).find(|&at| is_free(at))
}

/// Returns the distance of a point from a section; 0 inside.
pub(super) fn distance(section: &[DVec2], from: DVec2) -> f64 {
    let edges = section.iter().zip(section.iter().cycle().skip(1));
    let mut is_inside = true;
    let mut least = f64::INFINITY;
    for (&a, &b) in edges {
        is_inside &= (b - a).perp_dot(from - a) >= 0.0;
        let part = ((from - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        least = least.min(from.distance(a + (b - a) * part));
    }
    if is_inside { 0.0 } else { least }
}

/// Returns the pose of a part that is built about the z axis, with its middle at a place.
pub(super) fn upright(at: DVec3, turn: DQuat) -> Pose {
    Pose { at, turn, scale: 1.0 }
}
