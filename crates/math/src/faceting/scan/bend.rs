//! How far the corners of a facet bend off its plane by more than noise.

use super::patches::ScanCorners;
use super::points::PlaneEstimate;
use super::rounding::bending;
use super::{Fitted, errors};
use crate::faceting::deviation::outermost;
use crate::{Plane, Polytope, eigen, outer};
use glam::{DMat3, DVec3};
use rayon::prelude::*;

/// Forms of second order that differ by less than this part of the greatest difference among a facet's corners are one: of corners along two
/// edges, for example, all have the same place across.
const ONE_FORM: f64 = 1e-3;

/// Facets are bent where surfaces of second order lower their squared distances, in variances of the noise, by more than noise
/// explains: by one for each form, by so many times the root of their number (five standard deviations of χ²), and by so many besides. For
/// one facet that is the 99.99 % quantile.
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
    /// The numbers of the surface besides those of a plane: three, or fewer where the corners lie along few lines.
    pub forms: f64,
    /// The outward bend that is the same in all directions, with the standard deviation of one corner's noise; positive where the
    /// middle of the facet lies outside of the plane.
    outward: f64,
}

/// Returns the surface of second order that fits a facet's corners best; `None` where these do not tell it from a plane.
pub(super) fn bend(corners: &ScanCorners, of: &[u32], fit: &PlaneEstimate) -> Option<Bend> {
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
    let (values, vectors) = eigen(matrix);
    let known = (0..3).filter(|&k| values[k] > ONE_FORM * values[2]);
    let (fall, forms) = known
        .fold((0.0, 0.0), |(fall, forms), k| (fall + vectors[k].dot(right).powi(2) / values[k], forms + 1.0));
    let round = DVec3::new(1.0, 0.0, 1.0);
    let outward = -round.dot(right) / round.dot(matrix * round).sqrt();
    let is_known = fit.freedom() as f64 >= forms && forms > 0.0;
    (is_known && fall.is_finite() && outward.is_finite()).then_some(Bend { fall, forms, outward })
}

/// Returns the plane with the squared distances that a surface of second order leaves, and with as many corners fewer as it has numbers more.
fn unbent(bend: Option<Bend>, fit: &PlaneEstimate) -> PlaneEstimate {
    let Some(Bend { fall, forms, .. }) = bend else { return *fit };
    PlaneEstimate { squares: (fit.squares - fall).max(0.0), count: fit.count - forms as usize, ..*fit }
}

/// Returns for each facet of a solid whether its corners bend by more than noise, alone or together with those of neighbours that
/// lean little from it, or lie off it, so that it may be several facets. `inflation` is that of the noise's variance by its correlation.
pub(super) fn are_bent(corners: &ScanCorners, fitted: &Fitted, inflation: f64) -> Vec<bool> {
    let Fitted { polytope, members, fits } = fitted;
    let unbent: Vec<PlaneEstimate> =
        members.of.par_iter().zip(fits).map(|(of, fit)| unbent(bend(corners, of, fit), fit)).collect();
    let variances = errors::variances(&unbent, corners.least_noise);
    let bend_of = |((of, fit), variance): ((&Vec<u32>, &PlaneEstimate), f64)| {
        let bend = bend(corners, of, fit)?;
        let rounding = bending(corners.steps, fit);
        let fall = (bend.fall - rounding).max(0.0);
        let variance = inflation * variance.max(f64::MIN_POSITIVE);
        let outward = bend.outward / variance.sqrt().hypot(rounding.sqrt());
        Some(Bend { fall: fall / variance, outward, ..bend })
    };
    let bends: Vec<Option<Bend>> = members.of.par_iter().zip(fits).zip(variances).map(bend_of).collect();
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
            let sum = |of: fn(&Bend) -> f64| known.iter().map(|b| of(b)).sum::<f64>();
            let (fall, forms, outward) = (sum(|b| b.fall), sum(|b| b.forms), sum(|b| b.outward));
            fall > forms + BENT * count.sqrt() + BENT_ONE || (count > 1.0 && outward > OUTWARD * count.sqrt())
        };
        let together = is_bent(&group) || are_off(&group);
        group.iter().for_each(|&f| are_bent[f] = together || is_bent(&[f]) || are_off(&[f]));
    }
    over_deep(corners, fitted).for_each(|f| are_bent[f] = true);
    are_bent
}

/// Returns the facets whose triangles lie deep below them: narrow facets may be hidden there.
fn over_deep(corners: &ScanCorners, fitted: &Fitted) -> impl Iterator<Item = usize> {
    let planes: Vec<Plane> = fitted.polytope.planes().collect();
    let middle =
        |t: &u32| corners.triangles[*t as usize].map(|v| corners.at[v as usize]).iter().sum::<DVec3>() / 3.0;
    fitted.members.deep.iter().map(move |t| outermost(&planes, middle(t)).0)
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
