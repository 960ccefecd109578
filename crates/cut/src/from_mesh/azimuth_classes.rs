//! Tells tiers apart that noise has joined: those of nearly one slope whose azimuths make classes of their own.
//!
//! Facets that a rotation carries onto one another are a class: the eight mains of a brilliant, or the eight lower halves to the left
//! of a main. The mean slope and the mean offset of a class are known better than those of one facet, so that classes differ where
//! single facets do not.

use brillianteer_math::{Plane, grouped};
use std::f64::consts::TAU;

/// The most turns that are tried.
const MOST_TURNS: usize = 24;

/// Facets of a class lie within this of their places, radians (3 degrees): noise and uneven cutting turn them by a degree. The facets of
/// two classes of a tier of 24 turns lie 7.5 degrees apart.
const PLACE: f64 = 0.052;

/// Classes are two tiers where their means differ by more than this many of the difference's standard errors, and by more than facets of
/// one tier do. By Student's distribution with [`FREEDOM`] degrees of freedom, the slopes of two classes of one tier differ by as much once
/// in a thousand, and so do their offsets.
const CERTAIN: f64 = 4.0;

/// The fewest facets beyond the number of classes: from fewer, the spread within classes is known too badly to tell classes apart.
const FREEDOM: usize = 16;

/// The slope (radians) and the offset (girdle radii) of a facet, or their means.
type Figures = [f64; 2];

/// A class, with its means.
struct Class {
    places: Vec<usize>,
    mean: Figures,
}

/// Divides the facets of nearly one slope, given by their places, into tiers by their classes of azimuth, the steepest first. Means that
/// differ by less than `same` are one.
pub(super) fn divided(planes: &[Plane], tier: &[usize], same: Figures) -> Vec<Vec<usize>> {
    let Some(classes) = classes(planes, tier) else { return vec![tier.to_vec()] };
    let spread = spread(planes, &classes, tier.len());
    let are_one = |a: &Class, b: &Class| {
        let counts = 1.0 / a.places.len() as f64 + 1.0 / b.places.len() as f64;
        (0..2).all(|k| (a.mean[k] - b.mean[k]).abs() <= same[k].max(CERTAIN * spread[k] * counts.sqrt()))
    };
    let tiers = grouped(classes, are_one);
    tiers.into_iter().map(|classes| classes.into_iter().flat_map(|class| class.places).collect()).collect()
}

fn figures(plane: &Plane) -> Figures {
    [plane.normal.z.abs().min(1.0).acos(), plane.offset]
}

fn mean(planes: &[Plane], places: &[usize]) -> Figures {
    [0, 1].map(|k| places.iter().map(|&p| figures(&planes[p])[k]).sum::<f64>() / places.len() as f64)
}

/// Returns the standard deviations of slope and offset within classes.
fn spread(planes: &[Plane], classes: &[Class], count: usize) -> Figures {
    let freedom = (count - classes.len()) as f64;
    [0, 1].map(|k| {
        let of = |class: &Class| {
            class.places.iter().map(|&p| (figures(&planes[p])[k] - class.mean[k]).powi(2)).sum::<f64>()
        };
        (classes.iter().map(of).sum::<f64>() / freedom).sqrt()
    })
}

/// Returns the classes of the largest number of turns that carry several classes onto themselves, the steepest first; `None` where no turn
/// does, or where the spread within classes is not known well.
fn classes(planes: &[Plane], tier: &[usize]) -> Option<Vec<Class>> {
    let turns = (2..=MOST_TURNS).rev().filter(|turns| tier.len().is_multiple_of(*turns));
    let mut orbits = turns.filter_map(|turns| orbits(planes, tier, turns));
    let places = orbits.find(|places| places.len() > 1)?;
    if tier.len() < places.len() + FREEDOM {
        return None;
    }
    let class = |places: Vec<usize>| Class { mean: mean(planes, &places), places };
    let mut classes: Vec<Class> = places.into_iter().map(class).collect();
    classes.sort_by(|a, b| b.mean[0].total_cmp(&a.mean[0]).then(a.places.cmp(&b.places)));
    Some(classes)
}

/// Returns the facets in classes of one facet for each turn; `None` where some turn leaves a class without a facet.
fn orbits(planes: &[Plane], tier: &[usize], turns: usize) -> Option<Vec<Vec<usize>>> {
    let turn = TAU / turns as f64;
    let azimuth = |place: usize| planes[place].normal.y.atan2(planes[place].normal.x).rem_euclid(TAU);
    let mut left = tier.to_vec();
    left.sort_by(|&a, &b| azimuth(a).total_cmp(&azimuth(b)).then(a.cmp(&b)));
    let mut orbits = vec![];
    while !left.is_empty() {
        let first = azimuth(left[0]);
        let off = |place: usize, k: usize| {
            let apart = azimuth(place) - first - k as f64 * turn;
            (apart + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0
        };
        let mut orbit = vec![];
        for k in 0..turns {
            let near = |a: &usize, b: &usize| off(left[*a], k).abs().total_cmp(&off(left[*b], k).abs());
            let at = (0..left.len()).min_by(near).filter(|&at| off(left[at], k).abs() < PLACE)?;
            orbit.push(left.remove(at));
        }
        orbits.push(orbit);
    }
    Some(orbits)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAME: Figures = [2e-3, 2e-3];

    fn facet(slope_deg: f64, azimuth_deg: f64, offset: f64) -> Plane {
        Plane::from_slope(slope_deg.to_radians(), azimuth_deg.to_radians(), offset)
    }

    /// Mains and lower halves of a brilliant whose slopes scatter by more than half of what lies between them.
    fn pavilion(lower_deg: f64, depth: f64) -> Vec<Plane> {
        let scatter = |k: usize| 0.4 * (12.9898 * (k * k) as f64 + 4.1 * k as f64).sin();
        let main = |k: usize| facet(139.25 + scatter(k), 45.0 * k as f64 + scatter(k + 3), 0.698);
        let lower = |k: usize| {
            let side = if k.is_multiple_of(2) { 11.25 } else { 33.75 };
            facet(180.0 - lower_deg + scatter(k + 1), 45.0 * (k / 2) as f64 + side, depth)
        };
        (0..8).map(main).chain((0..16).map(lower)).collect()
    }

    #[test]
    fn mains_and_lower_halves_of_near_slopes_are_two_tiers_and_those_of_one_slope_are_one() {
        let all: Vec<usize> = (0..24).collect();
        let found = divided(&pavilion(42.0, 0.701), &all, SAME);
        let counts: Vec<usize> = found.iter().map(Vec::len).collect();
        assert!(counts == [16, 8] && found[1].iter().all(|place| *place < 8), "{found:?}");
        assert_eq!(divided(&pavilion(40.75, 0.698), &all, SAME).len(), 1);
        // Classes that are evenly spaced together.
        let even = |slope_deg: f64, start: f64| {
            (0..12).map(move |k| facet(slope_deg + 0.05 * f64::from(k % 3), start + 30.0 * f64::from(k), 0.7))
        };
        let planes: Vec<Plane> = even(139.2, 0.0).chain(even(138.2, 15.0)).collect();
        assert_eq!(divided(&planes, &all, SAME).len(), 2);
        // One slope at two depths.
        assert_eq!(divided(&pavilion(40.75, 0.71), &all, SAME).len(), 2);
    }

    #[test]
    fn facets_without_a_rotation_stay_one_tier() {
        let planes: Vec<Plane> = [0.0, 31.0, 95.0, 140.0, 200.0]
            .map(|azimuth| facet(40.0 + azimuth / 400.0, azimuth, 0.7))
            .to_vec();
        assert_eq!(divided(&planes, &[0, 1, 2, 3, 4], SAME), [vec![0, 1, 2, 3, 4]]);
    }
}
