//! Finds the facets of a scan: a surface of many corners that noise moves off the facets of a convex solid.
//!
//! 1. The noise is estimated from small patches, and patches large enough for this noise grow to regions that share a plane
//!    (`patches`, `growth`);
//! 2. corners are assigned to the facets of the solid between the planes, and the planes are fitted to their corners again,
//!    until nothing changes (`members`, `points`). Facets that one plane fits as well as two are joined (`merge`), and regions
//!    are sought again among corners that lie on no facet, and among triangles that lie deep below the solid (`narrow`). Where
//!    patches lie across edges, because facets have few corners within, regions of triangles begin the search instead (`Start`);
//! 3. the solid counts if it reproduces the surface and what is left is noise (`verdict`);
//! 4. the noise that is left gives the standard errors of the planes (`errors`, `correlation`, `rounding`).

mod bend;
mod correlation;
mod errors;
mod growth;
mod members;
mod merge;
mod narrow;
mod patches;
mod points;
mod rounding;
mod split;
mod verdict;

use super::plane_error::PlaneError;
use super::regions::{NOWHERE, Regions};
use crate::{Plane, Polytope, Surface};
use glam::DVec3;
use growth::grown;
use members::{Members, noises};
use patches::ScanCorners;
use points::PlaneEstimate;

/// The fewest corners of a surface that can be a scan.
pub(super) const FEWEST: usize = 200;

/// A surface of more corners has enough of them within its facets, so that patches begin all facets.
const MANY: usize = 8_000;

/// The noise that is assumed, in multiples of what patches show. Patches show less where the noise of neighbouring corners is
/// correlated, or less in some directions than in others.
const ASSUMED: [f64; 3] = [1.0, 1.7, 3.0];

/// The greatest number of times that corners are assigned anew.
const ROUNDS: usize = 100;

/// Corners at the borders of facets may go back and forth for ever, which changes nothing: after so many rounds without facets
/// lost the planes are settled.
const QUIET: usize = 4;

/// The number of times that regions are sought among corners that lie on no facet.
const SEARCHES: usize = 10;

/// A solid that was found in a scan.
pub(super) struct ScannedSolid {
    pub polytope: Polytope,
    /// The greatest distance of a corner from the solid's surface.
    pub deviation: f64,
    /// The standard deviation of the noise about the facets.
    pub noise: f64,
    /// The standard errors of the facets' planes, in the order of the facets.
    pub errors: Vec<PlaneError>,
    /// Whether each facet may be several that noise hides.
    pub are_bent: Vec<bool>,
}

/// Finds the solid that a scan represents; `None` where the surface is no scan of a convex solid with flat facets, or would need
/// more than `most`. `regions` returns regions of triangles that lie in one plane except for noise, of one tolerance after the other: where
/// facets have no corners within, patches of corners lie across their edges, but their triangles do not.
pub(super) fn scanned(
    surface: &Surface,
    most: usize,
    mut regions: impl Iterator<Item = Regions>,
) -> Option<ScannedSolid> {
    if surface.vertices.len() < FEWEST {
        return None;
    }
    let corners = ScanCorners::of(surface);
    let noise = corners.noise()?;
    let of_patches = |times: &f64| Scan { surface, corners: &corners, noise: times * noise, most }.solid();
    let of_regions = |found: Regions| {
        let start = Start::of(surface, &corners, &found)?;
        Scan { surface, corners: &corners, noise: start.noise, most }.solid_from(start)
    };
    let found = ASSUMED.iter().find_map(of_patches);
    if found.is_some() || surface.vertices.len() > MANY {
        return found;
    }
    regions.find_map(of_regions)
}

/// Returns the standard deviation of a surface's noise, as patches of its corners show it, with that of rounding, which facets square to an
/// axis do not show; `None` where it has too few.
pub(super) fn noise(surface: &Surface) -> Option<f64> {
    let corners = ScanCorners::of(surface);
    Some(corners.noise()?.hypot(rounding::variance(corners.steps, DVec3::ONE).sqrt()))
}

/// A scan, and the noise that is assumed.
struct Scan<'a> {
    surface: &'a Surface,
    corners: &'a ScanCorners<'a>,
    noise: f64,
    /// The most regions that are grown.
    most: usize,
}

/// A solid with its corners and the planes fitted to them, in the order of its facets.
struct Fitted {
    polytope: Polytope,
    members: Members,
    fits: Vec<PlaneEstimate>,
}

/// The planes that a search for facets begins with.
struct Start {
    planes: Vec<Plane>,
    /// The standard deviation of the noise.
    noise: f64,
}

impl Start {
    /// Takes the planes of regions of triangles. The noise is that of the corners about the planes; `None` where it is not known.
    fn of(surface: &Surface, corners: &ScanCorners, found: &Regions) -> Option<Self> {
        let mut of = vec![vec![]; found.fits.len()];
        for (&region, t) in found.of.iter().zip(&surface.triangles).filter(|(region, _)| **region != NOWHERE)
        {
            of[region as usize].extend(t);
        }
        of.iter_mut().for_each(|of: &mut Vec<u32>| {
            of.sort_unstable();
            of.dedup();
        });
        let fits: Vec<PlaneEstimate> = of.iter().filter_map(|of| corners.fit(of)).collect();
        let freedom: usize = fits.iter().map(PlaneEstimate::freedom).sum();
        let squares: f64 = fits.iter().map(|fit| fit.squares).sum();
        let noise = (squares / freedom as f64).sqrt();
        (freedom >= verdict::FREEDOM * fits.len() && noise > 0.0)
            .then(|| Self { planes: fits.iter().map(|fit| fit.plane).collect(), noise })
    }
}

impl Scan<'_> {
    /// Begins with patches of corners.
    fn solid(&self) -> Option<ScannedSolid> {
        let first = grown(self.corners, self.noise, &vec![false; self.corners.at.len()], self.most)?;
        self.solid_from(Start { planes: first.iter().map(|fit| fit.plane).collect(), noise: self.noise })
    }

    fn solid_from(&self, start: Start) -> Option<ScannedSolid> {
        let fitted = self.settled(start)?;
        verdict::is_reproduced(self.surface, self.corners, &fitted).then_some(())?;
        let freedom: usize = fitted.fits.iter().map(PlaneEstimate::freedom).sum();
        let squares: f64 = fitted.fits.iter().map(|fit| fit.squares).sum();
        let inflation = correlation::inflation(self.corners, &fitted.members, &fitted.fits);
        Some(ScannedSolid {
            errors: errors::errors(self.corners, &fitted.members, &fitted.fits, inflation),
            are_bent: bend::are_bent(self.corners, &fitted, inflation),
            deviation: fitted.members.deviation,
            noise: (squares / freedom.max(1) as f64).sqrt(),
            polytope: fitted.polytope,
        })
    }

    /// Assigns corners and fits planes until nothing changes.
    fn settled(&self, start: Start) -> Option<Fitted> {
        let mut state =
            State { planes: vec![], noises: vec![], searches: 0, divided: None, quiet: 0, inflation: 1.0 };
        state.add(start.planes.into_iter(), start.noise);
        for _ in 0..ROUNDS {
            let (polytope, own) = between(&state.planes, &state.noises)?;
            let members = Members::of(self.corners, &polytope, &own);
            let (fits, joined) = self.fitted(&polytope, &members, &own, state.inflation);
            if joined > 0 || fits.iter().any(Option::is_none) {
                let kept = fits.into_iter().zip(own).filter_map(|(fit, noise)| Some((fit?.plane, noise)));
                (state.planes, state.noises) = kept.unzip();
                state.quiet = 0;
                continue;
            }
            let fits: Vec<PlaneEstimate> = fits.into_iter().flatten().collect();
            if !state.follow(self.corners, &polytope, &members, &fits) {
                continue;
            }
            if self.is_complete(&mut state, &members, &fits)? {
                // The planes have moved by less than their errors since.
                let last = Polytope::from_planes(&state.planes).ok();
                let polytope = last.filter(|last| last.facets().len() == fits.len()).unwrap_or(polytope);
                return Some(Fitted { polytope, members, fits });
            }
        }
        None
    }

    /// Seeks planes that are missing: those of the parts of facets that two planes fit better, and else those of regions among
    /// the corners that lie on no facet. Returns whether there are none.
    fn is_complete(&self, state: &mut State, members: &Members, fits: &[PlaneEstimate]) -> Option<bool> {
        if state.searches == SEARCHES {
            return Some(true);
        }
        state.searches += 1;
        state.inflation = correlation::inflation(self.corners, members, fits);
        let parts = split::split(self.corners, members, fits, state.inflation);
        // Parts that were joined again at once would be found for ever.
        let is_in_vain = state.divided.replace(fits.len()) == Some(fits.len());
        let found = if is_in_vain || parts.iter().all(Option::is_none) {
            state.divided = None;
            self.unexplained(state, members)?
        } else {
            state.keep(|f| parts[f].is_none());
            parts.into_iter().flatten().flatten().collect::<Vec<_>>()
        };
        // The correlation of the noise is known from the first time on, and with it facets that are one.
        let is_complete = found.is_empty() && state.searches > 1;
        state.add(found.into_iter(), self.noise);
        Some(is_complete)
    }

    /// Returns the planes of regions among the corners that lie on no facet, and else of triangles that lie deep below the solid.
    fn unexplained(&self, state: &State, members: &Members) -> Option<Vec<Plane>> {
        let noise = state.noises.iter().copied().fold(0.0, f64::max).max(self.noise);
        let found: Vec<Plane> =
            grown(self.corners, noise, &members.explained, self.most)?.iter().map(|fit| fit.plane).collect();
        if !found.is_empty() {
            return Some(found);
        }
        let common = state.noises.iter().copied().fold(f64::INFINITY, f64::min);
        let narrow = narrow::planes(self.corners, &members.deep, common);
        (state.planes.len() + narrow.len() <= self.most).then_some(narrow)
    }

    /// Returns the plane of the corners of each facet, `None` for facets without enough corners and for those that were joined
    /// to others, with the number of the latter.
    fn fitted(
        &self,
        polytope: &Polytope,
        members: &Members,
        noises: &[f64],
        inflation: f64,
    ) -> (Vec<Option<PlaneEstimate>>, usize) {
        let mut sums = members.sums(self.corners);
        let inside = self.corners.inside;
        let mut fits: Vec<Option<PlaneEstimate>> = sums.iter().map(|sums| sums.fit(inside)).collect();
        // A plane that lies beneath corners is no facet.
        let near = |f: usize| growth::NEAR * noises[f];
        (0..fits.len()).for_each(|f| fits[f] = fits[f].filter(|fit| self.corners.is_outermost(fit, near(f))));
        let known: Vec<PlaneEstimate> = fits.iter().copied().flatten().collect();
        let mut known = errors::variances(&known, self.corners.least_noise).into_iter();
        let variances: Vec<f64> =
            fits.iter().map(|fit| inflation * fit.and_then(|_| known.next()).unwrap_or_default()).collect();
        let joined = merge::join(polytope, &mut sums, &mut fits, &variances, self.corners);
        (fits, joined)
    }
}

/// The planes so far, with the standard deviation of the noise about each.
struct State {
    planes: Vec<Plane>,
    noises: Vec<f64>,
    /// The number of times that missing planes were sought.
    searches: usize,
    /// The number of facets when some were last divided; `None` where missing planes were sought otherwise since.
    divided: Option<usize>,
    /// The number of rounds since the last plane was added or lost.
    quiet: usize,
    /// The factor by which the correlation of the noise multiplies the variances of means.
    inflation: f64,
}

impl State {
    fn add(&mut self, planes: impl ExactSizeIterator<Item = Plane>, noise: f64) {
        self.noises.resize(self.planes.len() + planes.len(), noise);
        self.planes.extend(planes);
    }

    /// Keeps the planes of the places for which a test holds.
    fn keep(&mut self, test: impl Fn(usize) -> bool) {
        let mut place = 0..;
        self.planes.retain(|_| place.next().is_some_and(&test));
        let mut place = 0..;
        self.noises.retain(|_| place.next().is_some_and(&test));
    }

    /// Takes over fitted planes, and returns whether they are settled.
    fn follow(
        &mut self,
        corners: &ScanCorners,
        before: &Polytope,
        members: &Members,
        fits: &[PlaneEstimate],
    ) -> bool {
        self.planes = fits.iter().map(|fit| fit.plane).collect();
        self.noises = noises(corners, members, fits);
        self.quiet += 1;
        let before: Vec<Plane> = before.planes().collect();
        let is_settled = self.quiet >= QUIET || is_settled(&before, &self.planes, fits, &self.noises);
        if is_settled {
            self.quiet = 0;
        }
        is_settled
    }
}

/// Returns the solid between planes with the noise about each of its facets; `None` where the planes enclose nothing.
fn between(planes: &[Plane], noises: &[f64]) -> Option<(Polytope, Vec<f64>)> {
    let polytope = Polytope::from_planes(planes).ok()?;
    let noises = polytope.facets().iter().map(|facet| noises[facet.source]).collect();
    Some((polytope, noises))
}

/// Returns whether planes moved by less than a tenth of their standard errors.
fn is_settled(before: &[Plane], after: &[Plane], fits: &[PlaneEstimate], noises: &[f64]) -> bool {
    /// The part of the standard error.
    const STILL: f64 = 0.1;
    let moved = |((before, after), (fit, noise)): ((&Plane, &Plane), (&PlaneEstimate, &f64))| {
        let tilt = (before.normal - after.normal).length();
        let shift = before.distance(fit.middle).abs();
        tilt * fit.moments[0].sqrt() <= STILL * noise && shift * (fit.count as f64).sqrt() <= STILL * noise
    };
    before.iter().zip(after).zip(fits.iter().zip(noises)).all(moved)
}
