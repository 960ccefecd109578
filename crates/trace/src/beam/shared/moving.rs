//! Splits a beam that several wavelengths share, whose outline moves with the wavelength.
//!
//! Light of all wavelengths that entered by one facet differs only in its slant. It meets one facet before another
//! where a function is positive that is affine in the image's coordinates and, after scaling by a positive factor,
//! affine in the slant (see [`MovingSplitter::cut`]). So corners move nearly evenly with the slant, and each corner
//! has its drift. The error of this is where corners pass one another toward the ends of a group of wavelengths; the
//! area of these places is found when the beam is cut.

use super::super::split::{Facets, GRAZING, MISSED, NO_FACET, Ray, SAME};
use super::super::whole::Candidate;
use super::slanted_light::SlantedLight;
use brillianteer_math::Affine;
use glam::{DVec2, DVec3};

/// The most lengths of an edge by which a corner on it may drift within a group of wavelengths.
const FARTHEST: f64 = 4.0;

/// A corner of an outline, at the middle slant of a group of wavelengths, and its change per slant.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct MovingCorner {
    /// The place of the corner in the image.
    pub at: DVec2,
    /// The change of that place per slant.
    pub drift: DVec2,
}

impl MovingCorner {
    /// Returns the place of the corner after a change of the slant.
    pub fn after(&self, change: f64) -> DVec2 {
        self.at + self.drift * change
    }
}

/// A beam on its way, at the middle slant of a group of wavelengths.
#[derive(Clone, Copy)]
pub(super) struct MovingBeam<'a> {
    pub light: &'a SlantedLight,
    pub slant: f64,
    /// The greatest difference of the group's slants from the middle one, to both sides.
    pub reach: f64,
    /// The depth at which the light last met a facet.
    pub depth: Affine,
    pub outline: &'a [MovingCorner],
}

/// The part of a beam that lands on one facet.
#[derive(Debug, Clone, Copy)]
pub(super) struct MovingCell {
    pub facet: u32,
    /// The outward unit normal of the facet.
    pub normal: DVec3,
    /// The depth at which the light meets the facet, at the middle slant, over the image.
    pub depth: Affine,
    /// The first corner among [`MovingSplitter::corners`], and the one after the last.
    pub corners: (usize, usize),
    pub twice_area: f64,
    /// True where the outline is that of the whole beam.
    pub is_whole: bool,
}

/// The corners of an outline while it is cut, with the facet beyond each edge.
#[derive(Default)]
struct Cut {
    corners: Vec<MovingCorner>,
    /// The facet beyond the edge that begins at each corner.
    beyond: Vec<u32>,
}

impl Cut {
    fn clear(&mut self) {
        self.corners.clear();
        self.beyond.clear();
    }

    fn push(&mut self, corner: MovingCorner, beyond: u32) {
        self.corners.push(corner);
        self.beyond.push(beyond);
    }
}

/// Splits moving beams among the facets of one polytope, and holds the work space that this needs.
pub(super) struct MovingSplitter<'a> {
    facets: &'a Facets<'a>,
    /// For each facet, the depth at which the light meets its plane at the middle slant, over the image.
    depth: Vec<Affine>,
    /// For each facet, the relative change of the speed toward its plane per slant.
    rate: Vec<f64>,
    /// For each facet, the number of the beam for which `depth` and `rate` were last computed.
    known: Vec<u32>,
    /// For each facet, the number of the beam for which it was last put into the queue.
    visited: Vec<u32>,
    /// The number of the current beam.
    beam: u32,
    queue: Vec<u32>,
    outline: Cut,
    spare: Cut,
    /// The value of a cutting line at each corner, and its change per slant.
    values: Vec<(f64, f64)>,
    /// The outline at one slant.
    still: Vec<DVec2>,
    /// The parts of the last beam.
    pub cells: Vec<MovingCell>,
    /// The corners of these parts.
    pub corners: Vec<MovingCorner>,
}

impl<'a> MovingSplitter<'a> {
    pub fn new(facets: &'a Facets<'a>) -> Self {
        let n = facets.polytope.facets().len();
        Self {
            facets,
            depth: vec![Affine::default(); n],
            rate: vec![0.0; n],
            known: vec![0; n],
            visited: vec![0; n],
            beam: 0,
            queue: vec![],
            outline: Cut::default(),
            spare: Cut::default(),
            values: vec![],
            still: vec![],
            cells: vec![],
            corners: vec![],
        }
    }

    /// Leaves in `cells` the parts of a beam that land on each facet at the middle slant. Returns the area where, at
    /// the other slants of the group, the drifted parts differ from the true ones.
    pub fn split(&mut self, beam: &MovingBeam) -> f64 {
        self.beam += 1;
        self.cells.clear();
        self.corners.clear();
        let way = beam.light.way(beam.slant);
        let centre = beam.outline.iter().map(|c| c.at).sum::<DVec2>() / beam.outline.len().max(1) as f64;
        let guess = self.facets.guess.ahead_of(beam.light.start(centre) + way * beam.depth.at(centre), way);
        if self.is_whole(beam, way, guess) {
            self.corners.extend_from_slice(beam.outline);
            let whole = twice_area(&self.corners);
            self.keep(guess, 0, whole, true);
            return 0.0;
        }
        let Some(first) = self.first(beam, way, centre, guess) else { return 0.0 };
        self.queue.clear();
        self.queue.push(first);
        self.visited[first as usize] = self.beam;
        let whole = twice_area(beam.outline);
        let (mut covered, mut astray) = self.flood(beam, way);
        if covered < whole * (1.0 - MISSED) {
            let rest = (0..self.visited.len() as u32).filter(|&k| self.visited[k as usize] != self.beam);
            self.queue.extend(rest);
            self.visited.fill(self.beam);
            let more = self.flood(beam, way);
            (covered, astray) = (covered + more.0, astray + more.1);
        }
        debug_assert!(covered.is_finite());
        astray
    }

    /// Returns whether the beam lands on one facet as a whole, at both ends of its group.
    fn is_whole(&mut self, beam: &MovingBeam, way: DVec3, facet: u32) -> bool {
        if !self.is_ahead(beam.light, way, facet) {
            return false;
        }
        let (depth, rate) = (self.depth[facet as usize], self.rate[facet as usize]);
        let ends = [-beam.reach, beam.reach];
        let ends = if beam.reach > 0.0 { &ends[..] } else { &ends[..1] };
        ends.iter().all(|&end| {
            let speed = 1.0 + rate * end;
            self.still.clear();
            self.still.extend(beam.outline.iter().map(|c| c.after(end)));
            let outline = self.still.as_slice();
            let centre = outline.iter().sum::<DVec2>() / outline.len().max(1) as f64;
            let ray = Ray { origin: beam.light.origin, direction: beam.light.way(beam.slant + end) };
            let (distance, extent) = (depth * (1.0 / speed), self.facets.extent);
            let candidate = Candidate { ray: &ray, outline, centre, facet, distance, extent };
            speed > 0.0 && self.facets.around.hold(candidate)
        })
    }

    /// Adds a part of the beam whose corners, from `start` on, are the last of `corners`.
    fn keep(&mut self, facet: u32, start: usize, twice_area: f64, is_whole: bool) {
        let normal = self.facets.polytope.facets()[facet as usize].plane.normal;
        let (depth, corners) = (self.depth[facet as usize], (start, self.corners.len()));
        self.cells.push(MovingCell { facet, normal, depth, corners, twice_area, is_whole });
    }

    /// Adds the parts that land on the facets in the queue and on their neighbours. Returns twice their area, and the area
    /// that goes astray at the ends of the group.
    fn flood(&mut self, beam: &MovingBeam, way: DVec3) -> (f64, f64) {
        let (mut covered, mut all_astray) = (0.0, 0.0);
        while let Some(facet) = self.queue.pop() {
            if !self.is_ahead(beam.light, way, facet) {
                continue;
            }
            let Some(astray) = self.cell(beam, way, facet) else { continue };
            for &beyond in &self.outline.beyond {
                if beyond != NO_FACET && self.visited[beyond as usize] != self.beam {
                    self.visited[beyond as usize] = self.beam;
                    self.queue.push(beyond);
                }
            }
            let start = self.corners.len();
            self.corners.extend_from_slice(&self.outline.corners);
            let part = twice_area(&self.outline.corners);
            (covered, all_astray) = (covered + part, all_astray + astray);
            self.keep(facet, start, part, false);
        }
        (covered, all_astray)
    }

    /// Leaves in `self.outline` the part of the outline whose rays meet `facet` before its neighbours, and returns
    /// the area that goes astray; `None` where there is no such part.
    fn cell(&mut self, beam: &MovingBeam, way: DVec3, facet: u32) -> Option<f64> {
        self.outline.clear();
        self.outline.corners.extend_from_slice(beam.outline);
        self.outline.beyond.resize(beam.outline.len(), NO_FACET);
        let polytope = self.facets.polytope;
        let (here, own) = (self.depth[facet as usize], self.rate[facet as usize]);
        let mut astray = 0.0;
        for &neighbour in &polytope.facets()[facet as usize].neighbours {
            if !self.is_ahead(beam.light, way, neighbour) {
                continue;
            }
            let (there, other) = (self.depth[neighbour as usize], self.rate[neighbour as usize]);
            let tolerance = SAME * (here.magnitude(self.facets.extent) + there.magnitude(self.facets.extent));
            // The depths are here / (1 + own · change) and there / (1 + other · change), where both divisors are
            // positive.
            let change = there * own - here * other;
            astray += self.cut((there - here, change), tolerance, neighbour, beam.reach)?;
        }
        Some(astray)
    }

    /// Computes the depth of a facet's plane, once for each beam; returns false where the light does not run toward
    /// the plane.
    #[inline]
    fn is_ahead(&mut self, light: &SlantedLight, way: DVec3, facet: u32) -> bool {
        let k = facet as usize;
        if self.known[k] != self.beam {
            self.known[k] = self.beam;
            let plane = &self.facets.polytope.facets()[k].plane;
            let speed = plane.normal.dot(way);
            let per = if speed > GRAZING { 1.0 / speed } else { f64::INFINITY };
            let [o, u, v] = light.origin.map(|o| plane.normal.dot(o));
            self.depth[k] = Affine::new((plane.offset - o) * per, DVec2::new(-u * per, -v * per));
            self.rate[k] = plane.normal.dot(light.along) * per;
        }
        self.depth[k].constant.is_finite()
    }

    /// Returns the facet that the ray of image point `p` meets. The search walks from `at` to ever nearer neighbours.
    fn first(&mut self, beam: &MovingBeam, way: DVec3, p: DVec2, mut at: u32) -> Option<u32> {
        if !self.is_ahead(beam.light, way, at) {
            at = (0..self.known.len() as u32).find(|&k| self.is_ahead(beam.light, way, k))?;
        }
        let polytope = self.facets.polytope;
        loop {
            let mut nearest = self.depth[at as usize].at(p);
            let mut next = at;
            for &k in &polytope.facets()[at as usize].neighbours {
                if self.is_ahead(beam.light, way, k) && self.depth[k as usize].at(p) < nearest {
                    nearest = self.depth[k as usize].at(p);
                    next = k;
                }
            }
            if next == at {
                return Some(at);
            }
            at = next;
        }
    }

    /// Keeps the part of `self.outline` where a function is positive at the middle slant. The function is given with
    /// its change per slant. Returns the area that goes astray, or `None` where the function is positive nowhere.
    /// Corners within the tolerance of the line count as on it, so that both sides of a cut agree.
    fn cut(
        &mut self,
        (keep, change): (Affine, Affine),
        tolerance: f64,
        beyond: u32,
        reach: f64,
    ) -> Option<f64> {
        let Self { outline, spare, values, .. } = self;
        values.clear();
        let value = |c: &MovingCorner| (keep.at(c.at), change.at(c.at) + keep.gradient.dot(c.drift));
        values.extend(outline.corners.iter().map(value));
        if !values.iter().any(|v| v.0 > tolerance) {
            return None;
        }
        let astray = astray(&outline.corners, values, tolerance, reach);
        if values.iter().all(|v| v.0 >= -tolerance) {
            return Some(astray);
        }
        spare.clear();
        let n = values.len();
        for i in 0..n {
            let j = if i + 1 == n { 0 } else { i + 1 };
            let (a, b, beyond_a) = (outline.corners[i], outline.corners[j], outline.beyond[i]);
            let (at_a, at_b) = (values[i].0, values[j].0);
            let crossing = || crossing((a, values[i]), (b, values[j]), reach);
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
        Some(astray)
    }
}

/// Returns the point where a line crosses an edge. The line's function has these values, and changes per slant, at
/// the ends of the edge.
fn crossing(
    (a, (at_a, of_a)): (MovingCorner, (f64, f64)),
    (b, (at_b, of_b)): (MovingCorner, (f64, f64)),
    reach: f64,
) -> MovingCorner {
    let whole = at_a - at_b;
    let (part, edge) = (at_a / whole, b.at - a.at);
    let at = a.at + edge * part;
    if reach <= 0.0 {
        return MovingCorner { at, drift: DVec2::ZERO };
    }
    let most = FARTHEST / reach;
    let change = ((at_a * of_b - at_b * of_a) / (whole * whole)).clamp(-most, most);
    MovingCorner { at, drift: a.drift + (b.drift - a.drift) * part + edge * change }
}

/// Returns the area of an outline that changes sides of a line as the slant goes to either end of the group, at the
/// end where this area is larger. `values` are those of the line's function at the corners, with their changes per
/// slant.
fn astray(corners: &[MovingCorner], values: &[(f64, f64)], tolerance: f64, reach: f64) -> f64 {
    if reach <= 0.0 || values.iter().all(|(at, of)| of.abs() * reach <= at.abs()) {
        return 0.0;
    }
    let n = values.len();
    let at_end = |end: f64| {
        let value = |k: usize| values[k].0 + values[k].1 * end;
        let lost = |i: usize| {
            let (now, then) = (values[i].0, value(i));
            let is_on_line = now.abs() <= tolerance;
            if !is_on_line && (now > 0.0) == (then > 0.0) {
                return 0.0;
            }
            let (before, after) = (if i == 0 { n - 1 } else { i - 1 }, if i + 1 == n { 0 } else { i + 1 });
            let part = |k: usize| {
                let other = value(k);
                ((other > 0.0) != (then > 0.0)).then(|| then / (then - other))
            };
            let parts = (part(before), part(after));
            if is_on_line && parts == (None, None) {
                return 0.0;
            }
            let own = corners[i].after(end);
            let (to, from) = (corners[before].after(end) - own, corners[after].after(end) - own);
            0.5 * to.perp_dot(from).abs() * parts.0.unwrap_or(1.0) * parts.1.unwrap_or(1.0)
        };
        (0..n).map(lost).sum::<f64>()
    };
    at_end(-reach).max(at_end(reach))
}

/// Returns twice the area of a counter-clockwise outline.
pub(super) fn twice_area(corners: &[MovingCorner]) -> f64 {
    let [first, second, rest @ ..] = corners else { return 0.0 };
    let mut last = second.at - first.at;
    let mut sum = 0.0;
    for corner in rest {
        let next = corner.at - first.at;
        sum += last.perp_dot(next);
        last = next;
    }
    sum
}
