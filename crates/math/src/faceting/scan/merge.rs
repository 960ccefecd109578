//! Joins facets that one plane fits as well as two.

use super::patches::ScanCorners;
use super::points::{PlaneEstimate, PointSums};
use super::rounding::bending;
use crate::Polytope;

/// Two facets are one where the sum of squared distances from a common plane exceeds that from two planes by less than
/// this many variances of the noise, and by 3 ln n for n corners (the three numbers of a plane, by the criterion of
/// G. Schwarz, 1978). The corners were divided where two planes fit best, so the excess is more than that of a random
/// division, whose 99.9 % quantile is 16.
const EXCESS: f64 = 16.0;

/// Planes whose normals make a smaller cosine are never one.
const FACING: f64 = 0.5;

/// Returns the number of facets that were joined to others; the sums of these are moved to the others.
pub(super) fn join(
    solid: &Polytope,
    sums: &mut [PointSums],
    fits: &mut [Option<PlaneEstimate>],
    variances: &[f64],
    corners: &ScanCorners,
) -> usize {
    let mut pairs = vec![];
    for (i, facet) in solid.facets().iter().enumerate() {
        for &j in facet.neighbours.iter().filter(|&&j| j as usize > i) {
            let j = j as usize;
            let (Some(a), Some(b)) = (&fits[i], &fits[j]) else { continue };
            if a.plane.normal.dot(b.plane.normal) < FACING {
                continue;
            }
            let Some(both) = sums[i].with(&sums[j]).fit(corners.inside) else { continue };
            let count = both.count as f64;
            let variance = (variances[i] * a.count as f64 + variances[j] * b.count as f64) / count;
            let excess = (both.squares - a.squares - b.squares - bending(corners.steps, &both)) / variance
                - 3.0 * count.ln();
            if excess < EXCESS {
                pairs.push((excess, i, j));
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut touched = vec![false; fits.len()];
    let mut joined = 0;
    for (_, i, j) in pairs {
        if touched[i] || touched[j] {
            continue;
        }
        (touched[i], touched[j]) = (true, true);
        sums[i] = sums[i].with(&sums[j]);
        (fits[i], fits[j]) = (sums[i].fit(corners.inside), None);
        joined += 1;
    }
    joined
}
