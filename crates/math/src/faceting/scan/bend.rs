//! How far the corners of a facet bend off its plane by more than noise.

use super::Fitted;
use super::patches::ScanCorners;
use super::points::PlaneEstimate;
use super::rounding::bending;
use crate::faceting::deviation::outermost;
use crate::{Plane, Polytope, outer};
use glam::{DMat3, DVec3};
use rayon::prelude::*;

/// The fewest corners that tell a bend from noise.
const LEAST: usize = 12;

/// The numbers of a surface of second order besides those of a plane.
pub(super) const FORMS: f64 = 3.0;

/// Facets are bent where surfaces of second order lower their squared distances, in variances of the noise, by more than noise
/// explains: by three each, by so many times the root of their number (five standard deviations of χ²), and by so many besides. For one facet
/// that is the 99.99 % quantile.
const BENT: f64 = 12.0;
const BENT_ONE: f64 = 6.0;

/// Neighbours whose normals make a greater cosine (14°) are bent together: where the facets between them are hidden, each has a part.
const NEARLY_ONE: f64 = 0.97;

/// The part of a facet's corners, and the number besides, that may lie off it by more than noise.
const OFF: f64 = 0.1;
const OFF_ALWAYS: usize = 3;

/// Neighbours that lean little from each other are bent together where their corners bend outward by more than this many standard
/// deviations of the noise, on average: hidden facets bend outward only, and noise as much inward.
const OUTWARD: f64 = 6.0;

/// A surface of second order that replaces a facet's plane.
pub(super) struct Bend {
    /// By how much the sum of the squared distances falls.
    pub fall: f64,
    /// The outward bend that is the same in all directions, with the standard deviation of one corner's noise; positive where the
    /// middle of the facet lies outside of the plane.
    outward: f64,
}

/// Returns the surface of second order that fits a facet's corners best; `None` for too few corners.
pub(super) fn bend(corners: &ScanCorners, of: &[u32], fit: &PlaneEstimate) -> Option<Bend> {
    if of.len() < LEAST {
        return None;
    }
    let scale = fit.moments.map(|moment| (moment / of.len() as f64).sqrt());
    // What is left of x², xy and y² when a plane's part is taken out, up to the places' skewness.
    let forms = |[x, y]: [f64; 2]| DVec3::new(x * x - 1.0, x * y, y * y - 1.0);
    let (mut matrix, mut right) = (DMat3::ZERO, DVec3::ZERO);
    for &v in of {
        let at = corners.at[v as usize];
        let from = at - fit.middle;
        let form = forms([0, 1].map(|k| from.dot(fit.axes[k]) / scale[k]));
        matrix += outer(form, form);
        right += form * fit.plane.distance(at);
    }
    let fall = right.dot(matrix.inverse() * right);
    let round = DVec3::new(1.0, 0.0, 1.0);
    let outward = -round.dot(right) / round.dot(matrix * round).sqrt();
    (fall.is_finite() && outward.is_finite()).then_some(Bend { fall, outward })
}

/// Returns for each facet of a solid whether its corners bend by more than noise, alone or together with those of neighbours that
/// lean little from it, or lie off it, so that it may be several facets. `inflation` is that of the noise's variance by its correlation.
pub(super) fn are_bent(corners: &ScanCorners, fitted: &Fitted, inflation: f64) -> Vec<bool> {
    let Fitted { polytope, members, fits } = fitted;
    let bend_of = |(of, fit): (&Vec<u32>, &PlaneEstimate)| {
        let bend = bend(corners, of, fit)?;
        let rounding = bending(corners.steps, fit);
        let fall = (bend.fall - rounding).max(0.0);
        let freedom = of.len() as f64 - 3.0 - FORMS;
        // The mean of the ratio of two variances (F) is above 1 where the second has few degrees of freedom.
        let mean = freedom / (freedom - 2.0);
        let variance = inflation * (fit.squares - bend.fall).max(f64::MIN_POSITIVE) / freedom;
        let outward = bend.outward / variance.sqrt().hypot(rounding.sqrt());
        Some(Bend { fall: fall / variance / mean, outward })
    };
    let bends: Vec<Option<Bend>> = members.of.par_iter().zip(fits).map(bend_of).collect();
    let off = off(corners, fitted);
    let mut are_bent = vec![false; fits.len()];
    for group in groups(polytope) {
        let are_off = |of: &[usize]| {
            let [off, on] =
                [of.iter().map(|&f| off[f]).sum::<usize>(), of.iter().map(|&f| members.of[f].len()).sum()];
            off > OFF_ALWAYS + (OFF * on as f64) as usize
        };
        let is_bent = |of: &[usize]| {
            let known: Vec<&Bend> = of.iter().filter_map(|&f| bends[f].as_ref()).collect();
            let count = known.len() as f64;
            let [fall, outward] =
                known.iter().fold([0.0, 0.0], |[fall, outward], b| [fall + b.fall, outward + b.outward]);
            fall > FORMS * count + BENT * count.sqrt() + BENT_ONE
                || (count > 1.0 && outward > OUTWARD * count.sqrt())
        };
        let together = is_bent(&group) || are_off(&group);
        group.iter().for_each(|&f| are_bent[f] = together || is_bent(&[f]) || are_off(&[f]));
    }
    are_bent
}

/// Returns for each facet how many of the corners that lie nearest to it lie off it.
fn off(corners: &ScanCorners, fitted: &Fitted) -> Vec<usize> {
    let planes: Vec<Plane> = fitted.polytope.planes().collect();
    let mut off = vec![0; planes.len()];
    for (at, _) in corners.at.iter().zip(&fitted.members.explained).filter(|(_, known)| !**known) {
        off[outermost(&planes, *at).0] += 1;
    }
    off
}

/// Returns the facets in groups of neighbours that lean little from each other.
fn groups(solid: &Polytope) -> Vec<Vec<usize>> {
    let facets = solid.facets();
    let mut is_known = vec![false; facets.len()];
    let mut groups = vec![];
    for first in 0..facets.len() {
        if std::mem::replace(&mut is_known[first], true) {
            continue;
        }
        let (mut group, mut at) = (vec![first], 0);
        while at < group.len() {
            let facet = &facets[group[at]];
            at += 1;
            for n in facet.neighbours.iter().map(|&n| n as usize) {
                let leans_little = facet.plane.normal.dot(facets[n].plane.normal) > NEARLY_ONE;
                if leans_little && !std::mem::replace(&mut is_known[n], true) {
                    group.push(n);
                }
            }
        }
        groups.push(group);
    }
    groups
}
