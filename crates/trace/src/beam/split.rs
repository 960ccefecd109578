//! Finds the facets that a beam lands on next, and the part of its outline that lands on each facet.

use super::whole::{Candidate, FacetNeighbours};
use crate::facet_guess::FacetGuess;
use brillianteer_math::{Affine, Polytope, centroid};
use glam::{DVec2, DVec3};

/// The cosine between a beam and a facet's normal up to which the beam counts as parallel to the facet and cannot
/// land on it.
pub(super) const GRAZING: f64 = 1e-12;

/// Distances that differ by less than this part of their terms count as equal; it is some hundred roundings.
pub(super) const SAME: f64 = 2e-14;

/// The part of a beam's outline that may land on no facet found; slivers are smaller. Where more is missing, all
/// facets are tried.
pub(super) const MISSED: f64 = 1e-10;

/// The number that stands for no facet.
pub(super) const NO_FACET: u32 = u32::MAX;

/// A beam on its way from a facet: the start of the ray of each image point, and the one direction of all its rays.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ray {
    /// The start of the ray at the image's origin, and its changes along the image's axes.
    pub origin: [DVec3; 3],
    /// The unit direction.
    pub direction: DVec3,
}

impl Ray {
    /// Returns the start of the ray of image point `p`.
    pub fn start(&self, p: DVec2) -> DVec3 {
        let [o, u, v] = self.origin;
        o + u * p.x + v * p.y
    }

    /// Returns the points that the rays reach after these distances, in the form of `origin`.
    pub fn advanced(&self, distance: Affine) -> [DVec3; 3] {
        let [o, u, v] = self.origin;
        let d = self.direction;
        [o + d * distance.constant, u + d * distance.gradient.x, v + d * distance.gradient.y]
    }
}

/// The outline of a beam that is split.
#[derive(Default)]
pub(super) struct BeamOutline {
    corners: Vec<DVec2>,
    twice_area: f64,
    centre: DVec2,
}

impl BeamOutline {
    /// Replaces the outline by these corners, and computes its area and centre.
    pub fn load(&mut self, corners: &[DVec2]) {
        self.corners.clear();
        self.corners.extend_from_slice(corners);
        (self.twice_area, self.centre) = (twice_area(corners), centroid(corners));
    }
}

/// The part of one beam that lands on one facet.
pub(super) struct Landing<'a> {
    pub facet: u32,
    /// The outward unit normal of the facet.
    pub normal: DVec3,
    /// The distance from the beam's start to the facet, over the image.
    pub distance: Affine,
    pub outline: &'a [DVec2],
    pub twice_area: f64,
    /// True where the outline is that of the whole beam.
    pub is_whole: bool,
}

/// The facets of one polytope, prepared for searches.
pub(super) struct Facets<'a> {
    pub polytope: &'a Polytope,
    pub guess: FacetGuess,
    pub around: FacetNeighbours,
    /// Half the extent of the largest image of the stone.
    pub extent: f64,
}

impl<'a> Facets<'a> {
    pub fn new(polytope: &'a Polytope) -> Self {
        let extent = polytope.vertices().iter().map(|v| v.length()).fold(0.0, f64::max);
        let (guess, around) = (FacetGuess::new(polytope.planes()), FacetNeighbours::new(polytope));
        Self { polytope, guess, around, extent }
    }
}

/// The corners of an outline while it is cut, with the facet beyond each edge.
#[derive(Default)]
struct Corners {
    at: Vec<DVec2>,
    /// The facet beyond the edge that begins at each corner.
    beyond: Vec<u32>,
}

impl Corners {
    fn clear(&mut self) {
        self.at.clear();
        self.beyond.clear();
    }

    fn push(&mut self, at: DVec2, beyond: u32) {
        self.at.push(at);
        self.beyond.push(beyond);
    }
}

/// Splits beams among the facets of one polytope, and holds the work space that this needs.
pub(super) struct Splitter<'a> {
    facets: &'a Facets<'a>,
    /// For each facet, the distance to its plane, over the image.
    distance: Vec<Affine>,
    /// For each facet, the number of the beam for which `distance` was last computed.
    known: Vec<u32>,
    /// For each facet, the number of the beam for which it was last put into the queue.
    visited: Vec<u32>,
    /// The number of the current beam.
    beam: u32,
    queue: Vec<u32>,
    outline: Corners,
    spare: Corners,
    values: Vec<f64>,
}

impl<'a> Splitter<'a> {
    pub fn new(facets: &'a Facets<'a>) -> Self {
        let n = facets.polytope.facets().len();
        Self {
            facets,
            distance: vec![Affine::default(); n],
            known: vec![0; n],
            visited: vec![0; n],
            beam: 0,
            queue: vec![],
            outline: Corners::default(),
            spare: Corners::default(),
            values: vec![],
        }
    }

    /// Calls `land` for each facet that the beam with this outline lands on.
    ///
    /// The landings make up the outline except for slivers, whose area is returned. The search goes from neighbour to
    /// neighbour; if it has missed any facet, all facets are tried.
    pub fn split(&mut self, ray: &Ray, outline: &BeamOutline, mut land: impl FnMut(Landing)) -> f64 {
        self.beam += 1;
        let &BeamOutline { corners: ref outline, twice_area: whole, centre } = outline;
        let guess = self.facets.guess.ahead_of(ray.start(centre), ray.direction);
        if self.is_ahead(ray, guess) {
            let distance = self.distance[guess as usize];
            let extent = self.facets.extent;
            if self.facets.around.hold(Candidate { ray, outline, centre, facet: guess, distance, extent }) {
                land(Landing { is_whole: true, ..self.landing(guess, outline, whole) });
                return 0.0;
            }
        }
        let Some(first) = self.first(ray, centre, guess) else { return whole / 2.0 };
        self.queue.clear();
        self.queue.push(first);
        self.visited[first as usize] = self.beam;
        let mut covered = self.flood(ray, outline, &mut land);
        if covered < whole * (1.0 - MISSED) {
            self.queue
                .extend((0..self.visited.len() as u32).filter(|&k| self.visited[k as usize] != self.beam));
            self.visited.fill(self.beam);
            covered += self.flood(ray, outline, &mut land);
        }
        (whole - covered).max(0.0) / 2.0
    }

    /// Returns the landing of this outline on a facet whose distance is known.
    fn landing<'b>(&self, facet: u32, outline: &'b [DVec2], twice_area: f64) -> Landing<'b> {
        let distance = self.distance[facet as usize];
        let normal = self.facets.polytope.facets()[facet as usize].plane.normal;
        Landing { facet, normal, distance, outline, twice_area, is_whole: false }
    }

    /// Lands on the facets in the queue and on their neighbours; returns twice the area that has landed.
    fn flood(&mut self, ray: &Ray, outline: &[DVec2], land: &mut impl FnMut(Landing)) -> f64 {
        let mut covered = 0.0;
        while let Some(facet) = self.queue.pop() {
            if !self.is_ahead(ray, facet) || !self.cell(ray, outline, facet) {
                continue;
            }
            for &beyond in &self.outline.beyond {
                if beyond != NO_FACET && self.visited[beyond as usize] != self.beam {
                    self.visited[beyond as usize] = self.beam;
                    self.queue.push(beyond);
                }
            }
            let part = twice_area(&self.outline.at);
            covered += part;
            land(self.landing(facet, &self.outline.at, part));
        }
        covered
    }

    /// Leaves in `self.outline` the part of the outline whose rays meet `facet` before its neighbours; returns false
    /// where there is no such part.
    fn cell(&mut self, ray: &Ray, outline: &[DVec2], facet: u32) -> bool {
        self.outline.clear();
        self.outline.at.extend_from_slice(outline);
        self.outline.beyond.resize(outline.len(), NO_FACET);
        let polytope = self.facets.polytope;
        let here = self.distance[facet as usize];
        for &neighbour in &polytope.facets()[facet as usize].neighbours {
            if !self.is_ahead(ray, neighbour) {
                continue;
            }
            let there = self.distance[neighbour as usize];
            let tolerance = SAME * (here.magnitude(self.facets.extent) + there.magnitude(self.facets.extent));
            if !self.cut(there - here, tolerance, neighbour) {
                return false;
            }
        }
        true
    }

    /// Computes the distance to a facet's plane, once for each beam; returns false where the beam does not run toward
    /// the plane.
    #[inline]
    fn is_ahead(&mut self, ray: &Ray, facet: u32) -> bool {
        let k = facet as usize;
        if self.known[k] != self.beam {
            self.known[k] = self.beam;
            let plane = &self.facets.polytope.facets()[k].plane;
            let speed = plane.normal.dot(ray.direction);
            let per = if speed > GRAZING { 1.0 / speed } else { f64::INFINITY };
            let [o, u, v] = ray.origin.map(|o| plane.normal.dot(o));
            self.distance[k] = Affine::new((plane.offset - o) * per, DVec2::new(-u * per, -v * per));
        }
        self.distance[k].constant.is_finite()
    }

    /// Returns the facet that the ray of image point `p` meets. The search walks from `at` to ever nearer neighbours.
    fn first(&mut self, ray: &Ray, p: DVec2, mut at: u32) -> Option<u32> {
        if !self.is_ahead(ray, at) {
            at = (0..self.known.len() as u32).find(|&k| self.is_ahead(ray, k))?;
        }
        let polytope = self.facets.polytope;
        loop {
            let mut nearest = self.distance[at as usize].at(p);
            let mut next = at;
            for &k in &polytope.facets()[at as usize].neighbours {
                if self.is_ahead(ray, k) && self.distance[k as usize].at(p) < nearest {
                    nearest = self.distance[k as usize].at(p);
                    next = k;
                }
            }
            if next == at {
                return Some(at);
            }
            at = next;
        }
    }

    /// Keeps the part of `self.outline` where `keep` is positive; returns false where it is positive nowhere. Corners within
    /// the tolerance of the line count as on it, so that both sides of a cut agree.
    fn cut(&mut self, keep: Affine, tolerance: f64, beyond: u32) -> bool {
        self.values.clear();
        self.values.extend(self.outline.at.iter().map(|&c| keep.at(c)));
        if !self.values.iter().any(|&v| v > tolerance) {
            return false;
        }
        if self.values.iter().all(|&v| v >= -tolerance) {
            return true;
        }
        let Self { outline, spare, values, .. } = self;
        spare.clear();
        let n = values.len();
        for i in 0..n {
            let j = if i + 1 == n { 0 } else { i + 1 };
            let (a, b) = (outline.at[i], outline.at[j]);
            let beyond_a = outline.beyond[i];
            let (at_a, at_b) = (values[i], values[j]);
            let crossing = || a + (b - a) * (at_a / (at_a - at_b));
            let leaves = at_b < -tolerance;
            if at_a > tolerance {
                spare.push(a, beyond_a);
                if leaves {
                    spare.push(crossing(), beyond);
                }
            } else if at_a >= -tolerance {
                spare.push(a, if leaves { beyond } else { beyond_a });
            } else if at_b > tolerance {
                spare.push(crossing(), beyond_a);
            }
        }
        std::mem::swap(outline, spare);
        true
    }
}

/// Returns twice the area of a counter-clockwise outline.
fn twice_area(corners: &[DVec2]) -> f64 {
    let [first, second, rest @ ..] = corners else { return 0.0 };
    let mut last = *second - *first;
    let mut sum = 0.0;
    for corner in rest {
        let next = *corner - *first;
        sum += last.perp_dot(next);
        last = next;
    }
    sum
}
