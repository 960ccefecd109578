//! Builds a [`Polytope`] by cutting a box with one half-space after the other (`draft`).
//!
//! A draft classifies each corner only once. Where up to sixteen planes of a brilliant meet, the result is therefore
//! one corner and not a cluster.

use super::draft::{Draft, DraftCut, DraftFace, directed_edges};
use super::{Facet, Plane, Polytope};
use glam::DVec3;
use std::collections::HashMap;
use std::ops::RangeInclusive;

/// Two planes count as one when their unit normals and offsets differ by less than this, with offsets relative to the
/// largest: a hundredth of the last digit in cutters' files.
const COINCIDENT: f64 = 1e-7;

/// A corner as near as this to a plane, relative to the box, lies on it: far above rounding (1e-15), far below any
/// edge that a file with nine digits can describe.
const ON_PLANE: f64 = 1e-10;

/// The half side of the first box, in largest offsets. The box grows eightfold while the solid touches it.
const FIRST_BOX: f64 = 4.0;

/// The greatest half side of the box, in largest offsets. A solid that still touches such a box counts as unbounded.
const LAST_BOX: f64 = 1e6;

/// Facets whose area is below this part of the surface are only rounding. It is some thousand roundings squared, and
/// far below any intended facet.
const SLIVER: f64 = 1e-13;

/// The range of the largest offset that is accepted, so that volumes neither overflow nor vanish.
const SCALES: RangeInclusive<f64> = 1e-60..=1e60;

/// The reason why half-spaces enclose no solid. Planes are numbered as given, from 0; messages count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", self.message(|plane| format!("plane {}", plane + 1)))]
pub enum PolytopeError {
    /// Fewer planes are given than the four that a solid needs.
    TooFew {
        /// The number of planes given.
        given: usize,
    },
    /// A number of the plane is NaN or infinite.
    NotFinite {
        /// The plane, counted from 0.
        plane: usize,
    },
    /// The plane is so far off, or all planes are so near, that areas and volumes cannot be computed.
    OutOfScale {
        /// The plane that is farthest off, counted from 0.
        plane: usize,
    },
    /// The normal of the plane is the zero vector and has no direction.
    ZeroNormal {
        /// The plane, counted from 0.
        plane: usize,
    },
    /// The planes enclose an infinite solid.
    Unbounded {
        /// The planes whose facets are infinite.
        planes: Vec<usize>,
    },
    /// No point, or no volume, lies inside all half-spaces.
    Empty {
        /// Some planes that contradict one another even without the rest.
        planes: Vec<usize>,
    },
    /// Planes run so nearly through one point or line that no closed outline could be made.
    Degenerate {
        /// The plane at which the outline did not close.
        plane: usize,
    },
}

impl PolytopeError {
    /// Returns the error in words; `name` gives the name of each plane.
    pub fn message(&self, name: impl Fn(usize) -> String) -> String {
        const MOST: usize = 8;
        let all = |planes: &[usize]| {
            let shown = planes.iter().take(MOST).map(|&p| name(p)).collect::<Vec<_>>().join(", ");
            let more = planes.len().saturating_sub(MOST);
            if more > 0 { format!("{shown} and {more} more") } else { shown }
        };
        match self {
            Self::TooFew { given } => format!("{given} planes cannot enclose a solid; give at least 4"),
            Self::NotFinite { plane } => {
                format!(
                    "{} has no finite distance from the origin; give it a finite normal and offset",
                    name(*plane)
                )
            }
            Self::OutOfScale { plane } => {
                let (least, most) = (SCALES.start(), SCALES.end());
                format!(
                    "{} is the farthest plane, and its distance is not from {least:e} to {most:e}; rescale the stone",
                    name(*plane)
                )
            }
            Self::ZeroNormal { plane } => {
                format!("{} has the zero vector as its normal; give it a direction", name(*plane))
            }
            Self::Unbounded { planes } => {
                let open = all(planes);
                format!("the stone is not closed: it runs to infinity at {open}; add the missing facets")
            }
            Self::Empty { planes } => {
                let blamed = all(planes);
                format!("nothing is left between {blamed}; move one of them outward or turn its normal round")
            }
            Self::Degenerate { plane } => {
                format!(
                    "{} meets its neighbours too nearly to be resolved; move it by more than 1e-7",
                    name(*plane)
                )
            }
        }
    }
}

pub(super) fn build(planes: &[Plane]) -> Result<Polytope, PolytopeError> {
    let unit = validate(planes)?;
    let (all, merged) = merge(&unit);
    let mut kept = all.clone();
    let mut whole = None;
    let scale = unit.iter().map(|p| p.offset.abs()).fold(0.0, f64::max);
    let scale = if scale > 0.0 { scale } else { 1.0 };
    let mut half = FIRST_BOX * scale;
    loop {
        let error = match cut_box(&unit, &kept, half) {
            Ok(draft) => match draft.unbounded(planes.len()) {
                None => {
                    let solid = draft.finish(&unit, &all, merged.clone())?;
                    let slivers = slivers(&solid);
                    if slivers.is_empty() {
                        return Ok(solid);
                    }
                    kept.retain(|plane| !slivers.contains(plane));
                    whole = Some(solid);
                    continue;
                }
                Some(open) => PolytopeError::Unbounded { planes: open },
            },
            // The box itself may be the reason why nothing was left; a larger box shows whether it was.
            Err(PolytopeError::Empty { planes: blamed }) => {
                if blamed.iter().all(|&p| p < planes.len()) {
                    return Err(PolytopeError::Empty { planes: blamed });
                }
                PolytopeError::Empty { planes: blamed.into_iter().filter(|&p| p < planes.len()).collect() }
            }
            Err(other) => return whole.ok_or(other),
        };
        if let Some(solid) = whole {
            // The solid does not close without its slivers, so they belong to it.
            return Ok(solid);
        }
        half *= 8.0;
        if half > LAST_BOX * scale {
            return Err(error);
        }
    }
}

/// Returns the planes of facets that are only rounding. Such planes run through an edge or a corner of the solid that
/// the others enclose.
fn slivers(solid: &Polytope) -> Vec<usize> {
    let least = SLIVER * solid.surface_area();
    let is_sliver = |facet: &&Facet| solid.facet_area(facet) < least;
    solid.facets().iter().filter(is_sliver).map(|facet| facet.source).collect()
}

fn validate(planes: &[Plane]) -> Result<Vec<Plane>, PolytopeError> {
    let check = |(plane, p): (usize, &Plane)| match p.normalized() {
        Some(unit) => Ok(unit),
        None if p.normal == DVec3::ZERO => Err(PolytopeError::ZeroNormal { plane }),
        None => Err(PolytopeError::NotFinite { plane }),
    };
    let unit = planes.iter().enumerate().map(check).collect::<Result<Vec<_>, _>>()?;
    if unit.len() < 4 {
        return Err(PolytopeError::TooFew { given: unit.len() });
    }
    let far = unit.iter().map(|p| p.offset.abs()).enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
    match far {
        Some((plane, offset)) if offset != 0.0 && !SCALES.contains(&offset) => {
            Err(PolytopeError::OutOfScale { plane })
        }
        _ => Ok(unit),
    }
}

/// Divides the planes into those that cut, and (dropped, kept) pairs of planes that coincide.
///
/// The planes are sorted along one axis, so that only planes near one another are compared.
fn merge(planes: &[Plane]) -> (Vec<usize>, Vec<(usize, usize)>) {
    let scale = planes.iter().map(|p| p.offset.abs()).fold(0.0, f64::max);
    let near = |a: &Plane, b: &Plane| {
        (a.normal - b.normal).length() < COINCIDENT && (a.offset - b.offset).abs() <= COINCIDENT * scale
    };
    let mut order: Vec<usize> = (0..planes.len()).collect();
    order.sort_by(|&a, &b| planes[a].normal.x.total_cmp(&planes[b].normal.x).then(a.cmp(&b)));
    let mut twin: Vec<Option<usize>> = vec![None; planes.len()];
    for (at, &i) in order.iter().enumerate() {
        let next =
            order[at + 1..].iter().take_while(|&&j| planes[j].normal.x - planes[i].normal.x < COINCIDENT);
        for &j in next {
            if near(&planes[i], &planes[j]) {
                let (first, later) = (i.min(j), i.max(j));
                twin[later] = Some(twin[later].map_or(first, |t| t.min(first)));
            }
        }
    }
    // Each plane of a chain of near planes is merged into the first member of the chain.
    let root = |mut i: usize| {
        while let Some(first) = twin[i] {
            i = first;
        }
        i
    };
    let kept = (0..planes.len()).filter(|&i| twin[i].is_none()).collect();
    let merged = (0..planes.len()).filter(|&i| twin[i].is_some()).map(|i| (i, root(i))).collect();
    (kept, merged)
}

fn cut_box(planes: &[Plane], kept: &[usize], half: f64) -> Result<Draft, PolytopeError> {
    // The solid may close at a smaller tolerance though it did not at a larger one.
    let mut failed = 0;
    for tolerance in [ON_PLANE, ON_PLANE * 1e-2, ON_PLANE * 1e-4] {
        match cut_with(planes, kept, half, tolerance * half) {
            Err(PolytopeError::Degenerate { plane }) => failed = plane,
            result => return result,
        }
    }
    Err(PolytopeError::Degenerate { plane: failed })
}

fn cut_with(planes: &[Plane], kept: &[usize], half: f64, tolerance: f64) -> Result<Draft, PolytopeError> {
    let mut draft = Draft::cube(half, planes.len());
    for &k in kept {
        match draft.cut(k, &planes[k], tolerance) {
            DraftCut::Missed | DraftCut::Done => {}
            DraftCut::Emptied { certificate } => return Err(PolytopeError::Empty { planes: certificate }),
            DraftCut::Unclosed => return Err(PolytopeError::Degenerate { plane: k }),
        }
    }
    Ok(draft)
}

impl Draft {
    /// Returns the given planes whose facets touch the box; `None` where no part of the box is left.
    fn unbounded(&self, given: usize) -> Option<Vec<usize>> {
        let boxed = self.faces.iter().filter(|f| f.source >= given);
        let far: Vec<u32> = boxed.flat_map(|f| f.outline.iter().copied()).collect();
        let touches = |f: &&DraftFace| f.source < given && f.outline.iter().any(|v| far.contains(v));
        let mut open: Vec<usize> = self.faces.iter().filter(touches).map(|f| f.source).collect();
        open.sort_unstable();
        (!far.is_empty()).then_some(open)
    }

    fn finish(
        mut self,
        planes: &[Plane],
        kept: &[usize],
        merged: Vec<(usize, usize)>,
    ) -> Result<Polytope, PolytopeError> {
        self.faces.sort_by_key(|f| f.source);
        let mut number: HashMap<u32, u32> = HashMap::new();
        let mut vertices = Vec::new();
        for v in self.faces.iter_mut().flat_map(|f| &mut f.outline) {
            let old = *v;
            *v = *number.entry(old).or_insert_with(|| {
                vertices.push(self.vertices[old as usize]);
                vertices.len() as u32 - 1
            });
        }
        let mut across: HashMap<(u32, u32), u32> = HashMap::new();
        for (i, face) in self.faces.iter().enumerate() {
            across.extend(directed_edges(&face.outline).map(|edge| (edge, i as u32)));
        }
        let mut facets = Vec::with_capacity(self.faces.len());
        for face in self.faces {
            let neighbours: Option<Vec<u32>> =
                directed_edges(&face.outline).map(|(a, b)| across.get(&(b, a)).copied()).collect();
            let Some(neighbours) = neighbours else {
                return Err(PolytopeError::Degenerate { plane: face.source });
            };
            facets.push(Facet {
                plane: planes[face.source],
                outline: face.outline,
                neighbours,
                source: face.source,
                frosting: 0.0,
            });
        }
        let redundant = kept.iter().copied().filter(|k| facets.iter().all(|f| f.source != *k)).collect();
        let polytope = Polytope { facets, vertices, redundant, merged };
        let euler = polytope.vertices.len() + polytope.facets.len() == polytope.edge_count() + 2;
        if euler { Ok(polytope) } else { Err(PolytopeError::Degenerate { plane: kept[kept.len() - 1] }) }
    }
}
