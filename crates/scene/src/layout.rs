//! Layouts of stones beside one another: in a row, a ring or a parcel. Each stone counts as the circle that holds it seen
//! from its table.
//!
//! All lengths are in one unit, any; the origin is in the middle of all stones. The same radii always give the same places.

use glam::DVec2;
use std::f64::consts::{PI, TAU};

/// The way in which stones are laid out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// Along x, in the order of the stones.
    Row,
    /// Around a circle, counter-clockwise from +x, with equal angles left free between neighbours.
    Ring,
    /// As densely as possible, with the largest stone in the middle; the others follow one after another.
    Parcel,
}

/// The number of halvings in the search for the ring's radius: until rounding.
const HALVINGS: u32 = 60;

/// Circles may come nearer than requested by this part of their distance: rounding.
const ROUNDING: f64 = 1e-9;

/// The greatest angle by which a stone of a parcel is turned about its axis, degrees to either side.
const MOST_TURNED: f64 = 22.5;

impl Layout {
    /// The layouts by name.
    pub const NAMES: [(&str, Self); 3] = [("row", Self::Row), ("ring", Self::Ring), ("parcel", Self::Parcel)];

    /// Returns the middles of circles of these radii, with at least `gap` between any two.
    pub fn places(self, radii: &[f64], gap: f64) -> Vec<DVec2> {
        match self {
            _ if radii.len() < 2 => vec![DVec2::ZERO; radii.len()],
            Self::Row => row(radii, gap),
            Self::Ring => ring(radii, gap),
            Self::Parcel => parcel(radii, gap),
        }
    }

    /// Returns the angle in degrees by which the stone of a number is turned about its axis: in a parcel an angle of its
    /// own, else 0.
    pub fn turn(self, number: usize) -> f64 {
        match self {
            Self::Row | Self::Ring => 0.0,
            Self::Parcel => MOST_TURNED * (2.0 * scattered(number as u64) - 1.0),
        }
    }
}

/// Returns a number from 0 to below 1 that looks random (Steele et al., SplitMix64, OOPSLA 2014).
pub fn scattered(number: u64) -> f64 {
    let z = (number + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

fn row(radii: &[f64], gap: f64) -> Vec<DVec2> {
    let length = 2.0 * radii.iter().sum::<f64>() + gap * (radii.len() - 1) as f64;
    let mut end = -0.5 * length;
    let place = |r: &f64| {
        let middle = end + r;
        end = middle + r + gap;
        DVec2::new(middle, 0.0)
    };
    radii.iter().map(place).collect()
}

/// Lays circles on the smallest circle, found to rounding, on which no two come too near.
fn ring(radii: &[f64], gap: f64) -> Vec<DVec2> {
    let fits = |radius| around(radii, gap, radius).filter(|places| are_apart(radii, gap, places));
    let mut low = 0.0;
    let mut high = radii.iter().sum::<f64>() + gap;
    let mut found = fits(high);
    while found.is_none() {
        (low, high) = (high, 2.0 * high);
        found = fits(high);
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        match fits(middle) {
            Some(places) => (high, found) = (middle, Some(places)),
            None => low = middle,
        }
    }
    found.unwrap_or_default()
}

/// Lays circles on a circle of this radius, with the same spare angle between all neighbours; `None` where it is too small
/// for all.
fn around(radii: &[f64], gap: f64, radius: f64) -> Option<Vec<DVec2>> {
    let count = radii.len();
    let chord = |k: usize| radii[k] + radii[(k + 1) % count] + gap;
    let touching = |k| 2.0 * (0.5 * chord(k) / radius).min(1.0).asin();
    let spare = (TAU - (0..count).map(touching).sum::<f64>()) / count as f64;
    let mut angle = 0.0;
    let place = |k| {
        let at = DVec2::from_angle(angle) * radius;
        angle += touching(k) + spare;
        at
    };
    // Two stones opposite each other may have a spare angle that is below 0 by rounding.
    (spare > -ROUNDING * PI).then(|| (0..count).map(place).collect())
}

fn are_apart(radii: &[f64], gap: f64, places: &[DVec2]) -> bool {
    let pair =
        |i: usize, j: usize| places[i].distance(places[j]) >= (radii[i] + radii[j] + gap) * (1.0 - ROUNDING);
    (0..radii.len()).all(|i| (0..i).all(|j| pair(i, j)))
}

/// Lays the largest circle first, then each where it is nearest to the first while it touches two others.
fn parcel(radii: &[f64], gap: f64) -> Vec<DVec2> {
    let mut order: Vec<usize> = (0..radii.len()).collect();
    order.sort_by(|&a, &b| radii[b].total_cmp(&radii[a]));
    let mut laid: Vec<(DVec2, f64)> = Vec::with_capacity(radii.len());
    for &k in &order {
        laid.push((next(&laid, radii[k], gap), radii[k]));
    }
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    laid.iter().for_each(|&(at, r)| (low, high) = (low.min(at - r), high.max(at + r)));
    let mut places = vec![DVec2::ZERO; radii.len()];
    order.iter().zip(&laid).for_each(|(&k, (at, _))| places[k] = at - 0.5 * (low + high));
    places
}

/// Returns the place of the next circle of a parcel.
fn next(laid: &[(DVec2, f64)], radius: f64, gap: f64) -> DVec2 {
    let [(first, _), ..] = laid else { return DVec2::ZERO };
    let mut best = *first + DVec2::X * (laid[0].1 + radius + gap);
    let mut nearest = if laid.len() == 1 { best.length() } else { f64::INFINITY };
    let is_free = |at: DVec2| {
        laid.iter().all(|&(other, r)| at.distance(other) >= (r + radius + gap) * (1.0 - ROUNDING))
    };
    for i in 0..laid.len() {
        for at in (0..i).flat_map(|j| touching(laid[i], laid[j], radius + gap)).flatten() {
            if at.length() < nearest * (1.0 - ROUNDING) && is_free(at) {
                (best, nearest) = (at, at.length());
            }
        }
    }
    best
}

/// Returns the two middles of a circle that touches two others; `reach` is its radius plus the gap.
fn touching(a: (DVec2, f64), b: (DVec2, f64), reach: f64) -> [Option<DVec2>; 2] {
    let (from_a, from_b) = (a.1 + reach, b.1 + reach);
    let (apart, distance) = (b.0 - a.0, b.0.distance(a.0));
    let along = (distance * distance + from_a * from_a - from_b * from_b) / (2.0 * distance);
    let aside = from_a * from_a - along * along;
    if distance > from_a + from_b || aside < 0.0 {
        return [None; 2];
    }
    let unit = apart / distance;
    [1.0, -1.0].map(|side| Some(a.0 + unit * along + unit.perp() * (side * aside.sqrt())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn least_gap(radii: &[f64], places: &[DVec2]) -> f64 {
        let pairs = (0..radii.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let gap = |(i, j): (usize, usize)| places[i].distance(places[j]) - radii[i] - radii[j];
        pairs.map(gap).fold(f64::INFINITY, f64::min)
    }

    fn bounds(radii: &[f64], places: &[DVec2]) -> (DVec2, DVec2) {
        let around = places.iter().zip(radii);
        around.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), (at, r)| {
            (low.min(at - *r), high.max(at + *r))
        })
    }

    #[test]
    fn a_row_lies_along_x_around_the_origin_each_a_gap_from_the_next() {
        let places = Layout::Row.places(&[1.0, 2.0, 0.5], 0.5);
        assert_eq!(places, [-3.0, 0.5, 3.5].map(|x| DVec2::new(x, 0.0)));
    }

    #[test]
    fn equal_stones_of_a_ring_touch_but_for_the_gap_at_equal_angles() {
        let places = Layout::Ring.places(&[1.0; 8], 0.4);
        let radius = 1.2 / (PI / 8.0).sin();
        for (k, at) in places.iter().enumerate() {
            assert!((at.length() - radius).abs() < 1e-8);
            assert!(at.distance(DVec2::from_angle(k as f64 * PI / 4.0) * radius) < 1e-7);
        }
        assert!(Layout::Ring.places(&[1.0, 3.0], 1.0)[0].distance(DVec2::new(2.5, 0.0)) < 1e-7);
    }

    #[test]
    fn seven_equal_stones_make_a_flower() {
        let places = Layout::Parcel.places(&[1.0; 7], 0.2);
        let mut from_first: Vec<f64> = places.iter().map(|p| p.distance(places[0])).collect();
        from_first.sort_by(f64::total_cmp);
        assert!(from_first[0] == 0.0 && from_first[1..].iter().all(|d| (d - 2.2).abs() < 1e-9));
    }

    #[test]
    fn stones_of_a_parcel_are_turned_each_its_own_way_and_others_not_at_all() {
        let turns: Vec<f64> = (0..256).map(|k| Layout::Parcel.turn(k)).collect();
        assert!(turns.iter().all(|t| t.abs() <= MOST_TURNED));
        assert!(turns.iter().sum::<f64>().abs() / 256.0 < 2.0 && turns[0] != turns[1]);
        assert_eq!((Layout::Row.turn(3), Layout::Ring.turn(3)), (0.0, 0.0));
    }

    proptest! {
        #[test]
        fn no_two_stones_come_nearer_than_the_gap_and_all_lie_around_the_origin(
            radii in prop::collection::vec(prop_oneof![0.05..20.0, 1.0..1.2], 0..24),
            gap in prop_oneof![Just(0.0), 0.0..3.0],
        ) {
            for (name, layout) in Layout::NAMES {
                let places = layout.places(&radii, gap);
                prop_assert_eq!(&places, &layout.places(&radii, gap));
                prop_assert_eq!(places.len(), radii.len());
                prop_assert!(least_gap(&radii, &places) >= gap - 1e-6, "{}", name);
                if layout != Layout::Ring && !radii.is_empty() {
                    let (low, high) = bounds(&radii, &places);
                    prop_assert!((low + high).length() < 1e-9 * (high - low).length() + 1e-12, "{}", name);
                }
                let from = places.first().map_or(0.0, |p| p.length());
                prop_assert!(layout != Layout::Ring || places.iter().all(|p| (p.length() - from).abs() < 1e-9));
            }
        }
    }
}
