//! Turns triangles so that all of them run counter-clockwise seen from outside.

use super::SurfaceError;
use crate::edges::{Edges, NONE};
use crate::{Surface, bounds};
use glam::DVec3;
use std::collections::VecDeque;
use std::f64::consts::PI;

/// The greatest number of points of a shell that are tested for lying within another shell.
const SAMPLES: usize = 24;

/// The least mean winding number of a shell around points within it. Around a point on a flat wall it is a half; the
/// difference allows for walls that are bent there.
const ON_WALL: f64 = 0.6;

/// The greatest number of shells that are tested for lying within one another: enough for a stone's inclusions, not
/// for a heap of stones.
const MOST_NESTED: usize = 64;

/// A connected shell of a surface.
pub(super) struct Shell {
    /// Its triangles, by their places in the surface.
    pub triangles: Vec<u32>,
    /// The innermost shell that it lies within, by its place among the shells.
    pub within: Option<usize>,
    /// True where most of its triangles ran clockwise, seen from outside, before they were turned.
    pub was_inward: bool,
}

/// Turns triangles that disagree with their neighbours or with the outside. Returns the number of triangles turned and the
/// shells.
pub(super) fn outward(surface: &mut Surface, edges: &Edges) -> Result<(usize, Vec<Shell>), SurfaceError> {
    let before = surface.clone();
    let shells = align(surface, edges)?;
    let (low, high) = surface.bounds();
    let apex = (low + high) / 2.0;
    let holders: Vec<Vec<usize>> = (0..shells.len()).map(|own| holders(surface, &shells, own)).collect();
    let mut found = vec![];
    for (shell, own) in shells.iter().zip(&holders) {
        let places = || shell.iter().map(|&t| t as usize);
        let is_cavity = own.len() % 2 == 1;
        if surface.volume_of(places(), apex).is_sign_negative() != is_cavity {
            shell.iter().for_each(|&t| surface.triangles[t as usize].swap(1, 2));
        }
        // The innermost of the shells around it lies in most of them itself. One that lies in as many as it does is the same
        // shell but for rounding.
        let around = own.iter().copied().filter(|&other| holders[other].len() < own.len());
        let within = around.max_by_key(|&other| holders[other].len());
        let was_inward = before.volume_of(places(), apex).is_sign_negative();
        found.push(Shell { triangles: shell.clone(), within, was_inward });
    }
    let turned = surface.triangles.iter().zip(&before.triangles).filter(|(now, then)| now != then).count();
    Ok((turned, found))
}

/// Makes neighbouring triangles run in the same sense. Returns the triangles of each connected shell.
fn align(surface: &mut Surface, edges: &Edges) -> Result<Vec<Vec<u32>>, SurfaceError> {
    let mut seen = vec![false; surface.triangles.len()];
    let mut shells = vec![];
    for start in 0..seen.len() {
        if !std::mem::replace(&mut seen[start], true) {
            shells.push(flood(surface, edges, start, &mut seen)?);
        }
    }
    Ok(shells)
}

fn flood(
    surface: &mut Surface,
    edges: &Edges,
    start: usize,
    seen: &mut [bool],
) -> Result<Vec<u32>, SurfaceError> {
    let mut shell = vec![];
    let mut queue = VecDeque::from([start]);
    while let Some(t) = queue.pop_front() {
        shell.push(t as u32);
        let corners = surface.triangles[t];
        for &next in edges.neighbours[t].iter().filter(|&&n| n != NONE) {
            let next = next as usize;
            let Some([a, b]) = shared_same_way(&corners, &surface.triangles[next]) else {
                if !std::mem::replace(&mut seen[next], true) {
                    queue.push_back(next);
                }
                continue;
            };
            if std::mem::replace(&mut seen[next], true) {
                let edge = [a, b].map(|v| surface.vertices[v as usize]);
                return Err(SurfaceError::OneSided { edge });
            }
            surface.triangles[next].swap(1, 2);
            queue.push_back(next);
        }
    }
    Ok(shell)
}

/// Returns an edge along which two triangles run in the same direction; neighbours that agree have none.
fn shared_same_way(one: &[u32; 3], other: &[u32; 3]) -> Option<[u32; 2]> {
    let run = |t: &[u32; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    run(one).into_iter().find(|edge| run(other).contains(edge))
}

/// Returns the shells that a shell lies within. Where there are many shells, none is sought.
fn holders(surface: &Surface, shells: &[Vec<u32>], own: usize) -> Vec<usize> {
    if shells.len() == 1 || shells.len() > MOST_NESTED {
        return vec![];
    }
    let bounds = |shell: &[u32]| bounds(shell.iter().flat_map(|&t| surface.corners(t as usize)));
    let shell = &shells[own];
    let (low, high) = bounds(shell);
    let step = shell.len().div_ceil(SAMPLES);
    let samples: Vec<DVec3> = shell.iter().step_by(step).map(|&t| surface.corners(t as usize)[0]).collect();
    let holds = |other: &usize| {
        let (least, most) = bounds(&shells[*other]);
        let fits = *other != own && least.cmple(low).all() && most.cmpge(high).all();
        fits && is_within(surface, &shells[*other], &samples)
    };
    (0..shells.len()).filter(holds).collect()
}

/// Returns whether a shell contains all these points of another shell, which may touch its wall.
///
/// A closed shell winds once around a point inside it, half around a point on its wall, and not around a point
/// outside, whatever the sense of its triangles. A shell that touches another from outside, or overlaps it, has
/// points around which the other does not wind.
fn is_within(surface: &Surface, shell: &[u32], points: &[DVec3]) -> bool {
    let winds = |point: &DVec3| {
        let angle = |&t: &u32| solid_angle(surface.corners(t as usize).map(|v| v - *point));
        (shell.iter().map(angle).sum::<f64>() / (4.0 * PI)).abs()
    };
    let winds: Vec<f64> = points.iter().map(winds).collect();
    let mean = winds.iter().sum::<f64>() / winds.len() as f64;
    winds.iter().all(|winds| *winds > ON_WALL / 2.0) && mean > ON_WALL
}

/// Returns the solid angle of a triangle seen from the origin, below 0 seen from behind (A. van Oosterom and J. Strackee,
/// The Solid Angle of a Plane Triangle, IEEE Trans. Biomed. Eng. 30, 1983).
fn solid_angle([a, b, c]: [DVec3; 3]) -> f64 {
    let [x, y, z] = [a.length(), b.length(), c.length()];
    let below = x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
    2.0 * a.dot(b.cross(c)).atan2(below)
}
