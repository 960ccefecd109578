//! Triangles turned so that all of them run counter-clockwise seen from outside.

use super::edges::{Edges, NONE};
use super::{Surface, SurfaceError};
use glam::DVec3;
use std::collections::VecDeque;

/// The most shells that are looked at for lying within one another: a stone's inclusions, not a heap of stones.
const MOST_NESTED: usize = 64;

/// Turns triangles where their neighbours, or the outside, ask for it; answers how many, and the number of shells.
pub(super) fn outward(surface: &mut Surface, edges: &Edges) -> Result<(usize, usize), SurfaceError> {
    let before = surface.triangles.clone();
    let shells = align(surface, edges)?;
    let (low, high) = surface.bounds();
    let apex = (low + high) / 2.0;
    for shell in &shells {
        let volume = surface.volume_of(shell.iter().map(|&t| t as usize), apex);
        if volume.is_sign_negative() != is_cavity(surface, &shells, shell) {
            shell.iter().for_each(|&t| surface.triangles[t as usize].swap(1, 2));
        }
    }
    let turned = surface.triangles.iter().zip(&before).filter(|(now, then)| now != then).count();
    Ok((turned, shells.len()))
}

/// Makes neighbours run the same way round; answers the triangles of each connected shell.
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

/// The edge that two triangles run along the same way, as neighbours that agree never do.
fn shared_same_way(one: &[u32; 3], other: &[u32; 3]) -> Option<[u32; 2]> {
    let run = |t: &[u32; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    run(one).into_iter().find(|edge| run(other).contains(edge))
}

/// Whether a shell lies within an odd number of the others: its outside is then the inside of the stone.
fn is_cavity(surface: &Surface, shells: &[Vec<u32>], shell: &[u32]) -> bool {
    if shells.len() == 1 || shells.len() > MOST_NESTED {
        return false;
    }
    let from = surface.corners(shell[0] as usize)[0];
    let others = shells.iter().filter(|s| s[0] != shell[0]).flatten();
    others.filter(|&&t| is_crossed(surface.corners(t as usize), from)).count() % 2 == 1
}

/// Whether the ray from a point in a direction that no edge is likely to have crosses a triangle (T. Möller and
/// B. Trumbore 1997).
fn is_crossed([a, b, c]: [DVec3; 3], from: DVec3) -> bool {
    const TOWARD: DVec3 = DVec3::new(0.423_616_5, 0.291_731_8, 0.857_580_4);
    let (e, f) = (b - a, c - a);
    let across = TOWARD.cross(f);
    let part = e.dot(across);
    let along = (from - a).cross(e);
    let (u, v, t) = ((from - a).dot(across) / part, TOWARD.dot(along) / part, f.dot(along) / part);
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0
}
