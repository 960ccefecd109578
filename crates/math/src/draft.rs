//! A solid that is being made: a box from which half-spaces are cut one after the other.
//!
//! Every corner is classified once as above, on or below the cutting plane, and every facet follows that
//! classification. So the outlines stay closed, whatever the rounding.

use super::Plane;
use glam::DVec3;
use std::collections::HashMap;

/// The result of a cut.
pub enum DraftCut {
    /// The plane leaves the whole solid on its inner side.
    Missed,
    /// A part of the solid was cut off.
    Done,
    /// The cut would leave nothing; the solid stays as it was.
    Emptied {
        /// Planes that leave nothing together, even without the others.
        certificate: Vec<usize>,
    },
    /// The new facet has no closed outline. The solid is then broken and must be made anew.
    Unclosed,
}

/// A face of a [`Draft`].
#[derive(Debug, Clone)]
pub struct DraftFace {
    /// The number of the plane that cut it.
    pub source: usize,
    /// The corners, as places in [`Draft::vertices`], counter-clockwise seen from outside.
    pub outline: Vec<u32>,
}

/// A solid that is being made. Faces whose source is the number that was given to [`cube`](Self::cube), or one of the
/// next five, are the sides of the box.
#[derive(Debug, Clone)]
pub struct Draft {
    /// The corners, including places that are no longer corners.
    pub vertices: Vec<DVec3>,
    /// The faces, in the order in which they were cut.
    pub faces: Vec<DraftFace>,
}

impl Draft {
    /// Makes a cube around the origin, whose sides have the sources `first_source` and the next five.
    pub fn cube(half: f64, first_source: usize) -> Self {
        let corner = |i: u32| {
            DVec3::from_array([i & 1, i >> 1 & 1, i >> 2 & 1].map(|b| if b == 0 { -half } else { half }))
        };
        let outlines = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let face = |(i, o): (usize, [u32; 4])| DraftFace { source: first_source + i, outline: o.to_vec() };
        Self {
            vertices: (0..8).map(corner).collect(),
            faces: outlines.into_iter().enumerate().map(face).collect(),
        }
    }

    /// Cuts off the part outside a plane. Corners within the tolerance lie on the plane.
    pub fn cut(&mut self, source: usize, plane: &Plane, tolerance: f64) -> DraftCut {
        let height: Vec<f64> = self.vertices.iter().map(|&v| plane.distance(v)).collect();
        let live = || self.faces.iter().flat_map(|f| f.outline.iter().map(|&v| v as usize));
        if live().all(|v| height[v] <= tolerance) {
            return DraftCut::Missed;
        }
        if live().all(|v| height[v] >= -tolerance) {
            return DraftCut::Emptied { certificate: self.certificate(source, &height) };
        }
        let on_before = |v: u32| (v as usize) < height.len() && height[v as usize].abs() <= tolerance;
        let first_new = height.len() as u32;
        let mut split: HashMap<(u32, u32), u32> = HashMap::new();
        let vertices = &mut self.vertices;
        let mut edges: Vec<(u32, u32)> = Vec::new();
        self.faces.retain_mut(|face| {
            let mut above = false;
            let mut below = false;
            let mut on = 0;
            for &v in &face.outline {
                let h = height[v as usize];
                above |= h > tolerance;
                below |= h < -tolerance;
                on += usize::from(h.abs() <= tolerance);
            }
            if !below {
                return false;
            }
            if above {
                face.outline = trim(&face.outline, &height, tolerance, vertices, &mut split);
            }
            if above || on >= 2 {
                let next = face.outline.iter().cycle().skip(1);
                let rim = |v: u32| v >= first_new || on_before(v);
                edges.extend(
                    face.outline.iter().zip(next).map(|(&a, &b)| (a, b)).filter(|&(a, b)| rim(a) && rim(b)),
                );
            }
            true
        });
        match close(&edges) {
            Some(outline) => {
                self.faces.push(DraftFace { source, outline });
                DraftCut::Done
            }
            None => DraftCut::Unclosed,
        }
    }

    /// Returns planes that leave nothing together: the new plane, and those that meet at the corner that is least far
    /// above it. By the duality of linear programming these planes are a proof.
    fn certificate(&self, source: usize, height: &[f64]) -> Vec<usize> {
        let live = self.faces.iter().flat_map(|f| f.outline.iter().copied());
        let lowest = live.min_by(|&a, &b| height[a as usize].total_cmp(&height[b as usize]));
        let meets = |f: &&DraftFace| lowest.is_some_and(|v| f.outline.contains(&v));
        let mut planes: Vec<usize> = self.faces.iter().filter(meets).map(|f| f.source).collect();
        planes.push(source);
        planes.sort_unstable();
        planes
    }
}

/// Returns the edges of an outline, in the direction of the outline.
pub(super) fn directed_edges(outline: &[u32]) -> impl Iterator<Item = (u32, u32)> {
    outline.iter().copied().zip(outline.iter().copied().cycle().skip(1))
}

/// Returns the part of an outline that is not above the plane, with a new corner wherever an edge crosses the plane.
fn trim(
    outline: &[u32],
    height: &[f64],
    tolerance: f64,
    vertices: &mut Vec<DVec3>,
    split: &mut HashMap<(u32, u32), u32>,
) -> Vec<u32> {
    let mut kept = Vec::with_capacity(outline.len() + 1);
    for (a, b) in directed_edges(outline) {
        let (at_a, at_b) = (height[a as usize], height[b as usize]);
        if at_a <= tolerance {
            kept.push(a);
        }
        let crosses = (at_a > tolerance && at_b < -tolerance) || (at_a < -tolerance && at_b > tolerance);
        if crosses {
            // The other facet at the edge runs along it in the opposite direction; one corner serves both.
            let (low, high) = (a.min(b), a.max(b));
            let corner = *split.entry((low, high)).or_insert_with(|| {
                let (p, q) = (vertices[low as usize], vertices[high as usize]);
                let (at_p, at_q) = (height[low as usize], height[high as usize]);
                vertices.push(p + (q - p) * (at_p / (at_p - at_q)));
                vertices.len() as u32 - 1
            });
            kept.push(corner);
        }
    }
    kept
}

/// Returns the outline of the new facet: the edges in the plane that belong to one facet only, in the opposite direction.
///
/// `None` where these edges do not form one closed ring of three or more.
fn close(edges: &[(u32, u32)]) -> Option<Vec<u32>> {
    let present: std::collections::HashSet<(u32, u32)> = edges.iter().copied().collect();
    let rim = edges.iter().filter(|&&(a, b)| !present.contains(&(b, a)));
    let mut next: HashMap<u32, u32> = HashMap::new();
    let mut start = None;
    for &(a, b) in rim {
        start.get_or_insert(b);
        if next.insert(b, a).is_some() {
            return None;
        }
    }
    let start = start?;
    let mut outline = vec![start];
    let mut at = *next.get(&start)?;
    while at != start && outline.len() < next.len() {
        outline.push(at);
        at = *next.get(&at)?;
    }
    (at == start && outline.len() == next.len() && outline.len() >= 3).then_some(outline)
}
