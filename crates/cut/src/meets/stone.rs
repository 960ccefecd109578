//! The stone as it is cut so far: its corners, its girdle lines, and the points where its axis leaves it.

use brillianteer_math::{Draft, DraftCut, Plane};
use glam::DVec3;
use std::cell::OnceCell;

/// The half side of the block from which the stone is cut, in lengths of the largest distance. A point on the surface
/// of the block is no corner of the stone.
const BLOCK_HALF: f64 = 20.0;

/// The distance from the axis, in lengths of the largest distance, beyond which a section of the stone is one of the
/// block.
pub(super) const FARTHEST: f64 = 10.0;

/// The largest distance, relative to the block, of a corner that counts as on a plane; see `math::polytope_build`.
const ON_PLANE: f64 = 1e-10;

/// The largest distance between corners that are one corner to a cutter, in lengths of the largest distance. The
/// cutter sees no edge between them. Files whose distances were found by hand have such edges.
const SAME_CORNER: f64 = 1e-3;

/// The largest difference between heights that count as one, in lengths of the largest distance.
const SAME_HEIGHT: f64 = 1e-4;

/// A corner of the stone so far.
#[derive(Debug, Clone)]
pub(super) struct StoneCorner {
    pub at: DVec3,
    /// The places of the planes that meet here or within [`SAME_CORNER`]; those that meet here come first.
    pub planes: Vec<usize>,
}

/// A plane that was cut.
#[derive(Debug, Clone, Copy)]
pub(super) struct CutPlane {
    pub plane: Plane,
    /// The place of its tier, from 0.
    pub tier: usize,
}

/// The side of the girdle, or of a girdle line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum StoneSide {
    Above,
    Below,
}

impl StoneSide {
    /// Returns the side to which a direction leans; `None` where it is level.
    pub fn of(normal: DVec3) -> Option<Self> {
        match normal.z {
            0.0 => None,
            z if z > 0.0 => Some(Self::Above),
            _ => Some(Self::Below),
        }
    }

    fn sign(self) -> f64 {
        if self == Self::Above { 1.0 } else { -1.0 }
    }
}

/// The stone as it is cut so far.
#[derive(Debug, Clone)]
pub(super) struct PartStone {
    /// The largest distance, the measure of all tolerances.
    scale: f64,
    draft: Draft,
    planes: Vec<CutPlane>,
    /// The corners and the edges, once they are needed.
    found: OnceCell<Found>,
}

/// The corners and the edges of the stone so far.
#[derive(Debug, Clone)]
struct Found {
    corners: Vec<StoneCorner>,
    edges: Vec<PartEdge>,
}

/// An edge of the stone so far.
#[derive(Debug, Clone, Copy)]
struct PartEdge {
    ends: [DVec3; 2],
    /// The planes on both sides; `None` stands for a face of the block.
    planes: [Option<usize>; 2],
}

impl PartStone {
    pub fn new(scale: f64, most: usize) -> Self {
        let draft = Draft::cube(BLOCK_HALF * scale, most);
        Self { scale, draft, planes: Vec::with_capacity(most), found: OnceCell::new() }
    }

    pub fn scale(&self) -> f64 {
        self.scale
    }

    pub fn corners(&self) -> &[StoneCorner] {
        &self.found().corners
    }

    /// Returns all planes that were cut, in the order of the cuts.
    pub fn planes(&self) -> &[CutPlane] {
        &self.planes
    }

    pub fn plane(&self, place: usize) -> &CutPlane {
        &self.planes[place]
    }

    /// Cuts the facets of a tier. A facet that would leave nothing of the stone is left out.
    pub fn cut(&mut self, tier: usize, planes: impl Iterator<Item = Plane>) {
        for plane in planes {
            self.planes.push(CutPlane { plane, tier });
            let place = self.planes.len() - 1;
            let tolerance = ON_PLANE * BLOCK_HALF * self.scale;
            if matches!(self.draft.cut(place, &plane, tolerance), DraftCut::Unclosed) {
                self.cut_anew();
            }
        }
        self.found = OnceCell::new();
    }

    /// Cuts all planes from a new block with a smaller tolerance, which may close a surface that a larger one could
    /// not. A plane that gives no closed surface at any tolerance is left out.
    fn cut_anew(&mut self) {
        let block = || Draft::cube(BLOCK_HALF * self.scale, self.planes.capacity());
        for finer in [1e-2, 1e-4] {
            let tolerance = finer * ON_PLANE * BLOCK_HALF * self.scale;
            let mut draft = block();
            let mut planes = self.planes.iter().enumerate();
            if planes
                .all(|(place, cut)| !matches!(draft.cut(place, &cut.plane, tolerance), DraftCut::Unclosed))
            {
                self.draft = draft;
                return;
            }
        }
        let mut draft = block();
        for (place, cut) in self.planes.iter().enumerate() {
            let before = draft.clone();
            if matches!(draft.cut(place, &cut.plane, ON_PLANE * BLOCK_HALF * self.scale), DraftCut::Unclosed)
            {
                draft = before;
            }
        }
        self.draft = draft;
    }

    /// Returns the corners and the edges. They are computed when a meet first needs them, because most tiers need
    /// none.
    fn found(&self) -> &Found {
        self.found.get_or_init(|| {
            let touching = self.touching();
            Found { edges: self.edges(&touching), corners: self.joined_corners(touching) }
        })
    }

    /// Returns, for each corner of the draft, the sources of the faces that touch it.
    fn touching(&self) -> Vec<Vec<usize>> {
        let mut touching: Vec<Vec<usize>> = vec![vec![]; self.draft.vertices.len()];
        for face in &self.draft.faces {
            face.outline.iter().for_each(|&corner| touching[corner as usize].push(face.source));
        }
        touching
    }

    fn edges(&self, touching: &[Vec<usize>]) -> Vec<PartEdge> {
        let given = |source: usize| (source < self.planes.len()).then_some(source);
        let mut edges = vec![];
        for face in &self.draft.faces {
            let next = face.outline.iter().cycle().skip(1);
            for (&a, &b) in face.outline.iter().zip(next).filter(|(a, b)| a < b) {
                let across = touching[a as usize]
                    .iter()
                    .find(|&&other| other != face.source && touching[b as usize].contains(&other));
                let ends = [a, b].map(|corner| self.draft.vertices[corner as usize]);
                let planes = [given(face.source), across.copied().and_then(given)];
                edges.push(PartEdge { ends, planes });
            }
        }
        edges
    }

    /// Returns the corners of the stone; a corner that is several to the draft, and one to a cutter, has the planes
    /// of all of them.
    fn joined_corners(&self, touching: Vec<Vec<usize>>) -> Vec<StoneCorner> {
        let count = self.planes.len();
        let live = touching.into_iter().zip(&self.draft.vertices);
        let is_corner = |planes: &Vec<usize>| !planes.is_empty() && planes.iter().all(|&plane| plane < count);
        let mut corners: Vec<StoneCorner> = live
            .filter(|(planes, _)| is_corner(planes))
            .map(|(planes, &at)| StoneCorner { at, planes })
            .collect();
        corners.sort_by(|a, b| a.at.x.total_cmp(&b.at.x));
        let near = SAME_CORNER * self.scale;
        for place in 0..corners.len() {
            for other in place + 1..corners.len() {
                if corners[other].at.x - corners[place].at.x > near {
                    break;
                }
                if corners[other].at.distance(corners[place].at) <= near {
                    let (first, second) = corners.split_at_mut(other);
                    unite(&mut first[place].planes, &mut second[0].planes);
                }
            }
        }
        corners
    }

    /// Returns the distance from the origin at which the axis leaves the stone on a side; `None` where nothing is cut there.
    pub fn centre(&self, side: StoneSide) -> Option<f64> {
        let leaning = self.planes.iter().filter(|cut| StoneSide::of(cut.plane.normal) == Some(side));
        leaning.map(|cut| cut.plane.offset / cut.plane.normal.z.abs()).min_by(f64::total_cmp)
    }

    /// Returns the height of the girdle line on a side, which consists of the level edges between upright facets and
    /// facets of that side. Of several heights it is the one with the greatest total length of edges; `None` where no
    /// such edge is level.
    pub fn girdle_height(&self, side: StoneSide) -> Option<f64> {
        let normal = |plane: Option<usize>| plane.map(|plane| self.planes[plane].plane.normal);
        let near = SAME_HEIGHT * self.scale;
        let mut lengths: Vec<(f64, f64)> = vec![];
        for edge in &self.found().edges {
            let [Some(a), Some(b)] = edge.planes.map(normal) else { continue };
            let is_beside = |leaning: DVec3| StoneSide::of(leaning) == Some(side);
            let is_girdle = (a.z == 0.0 && is_beside(b)) || (b.z == 0.0 && is_beside(a));
            let [start, end] = edge.ends;
            let length = start.distance(end);
            if !is_girdle || (start.z - end.z).abs() > near || length <= near {
                continue;
            }
            match lengths.iter_mut().find(|(height, _)| (height - start.z).abs() <= near) {
                Some((_, sum)) => *sum += length,
                None => lengths.push((start.z, length)),
            }
        }
        // Rounding must not decide between lines of equal length, so the outermost of them counts.
        let longest = lengths.iter().map(|(_, length)| *length).fold(0.0, f64::max);
        let heights = lengths.iter().filter(|(_, length)| *length >= longest * (1.0 - 1e-3));
        heights.map(|(height, _)| *height).max_by(|a, b| (a * side.sign()).total_cmp(&(b * side.sign())))
    }

    /// Returns the point of the stone's section at a height that lies farthest along a direction; `None` where there is no
    /// section, or where it reaches the block.
    pub fn section_support(&self, height: f64, along: DVec3) -> Option<DVec3> {
        let near = SAME_HEIGHT * self.scale;
        let points = self.found().edges.iter().flat_map(|edge| {
            let [a, b] = edge.ends;
            let crosses = (a.z - height) * (b.z - height) < 0.0;
            let crossing = crosses.then(|| a + (b - a) * ((height - a.z) / (b.z - a.z)));
            let level = |end: DVec3| ((end.z - height).abs() <= near).then_some(end.with_z(height));
            [crossing, level(a), level(b)].into_iter().flatten()
        });
        let farthest = points.max_by(|a, b| along.dot(*a).total_cmp(&along.dot(*b)))?;
        (farthest.truncate().abs().max_element() < FARTHEST * self.scale).then_some(farthest)
    }

    /// Returns the distance of the plane with this normal that touches the stone.
    pub fn support(&self, normal: DVec3) -> f64 {
        let live = self.draft.faces.iter().flat_map(|face| &face.outline);
        let heights = live.map(|&corner| normal.dot(self.draft.vertices[corner as usize]));
        heights.fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Gives both lists the members of both.
fn unite(a: &mut Vec<usize>, b: &mut Vec<usize>) {
    let missing: Vec<usize> = b.iter().copied().filter(|place| !a.contains(place)).collect();
    b.extend(a.iter().copied().filter(|place| !b.contains(place)).collect::<Vec<_>>());
    a.extend(missing);
}
