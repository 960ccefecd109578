//! Puts facets into the order of the trade, tier by tier, and gives them the names that follow from their places.

use super::super::names;
use super::azimuth_classes;
use super::outline::LEAST_UPRIGHT;
use brillianteer_math::{Plane, grouped};
use std::f64::consts::TAU;

/// The slopes of one tier's facets differ by less than this, radians, or by the effect of noise.
const SAME_SLOPE: f64 = 2e-3;

/// The offsets of one tier's facets differ by less than this, girdle radii, or by the effect of noise.
const SAME_OFFSET: f64 = 2e-3;

/// The number of tolerances by which noise turns (radians) and shifts (girdle radii) the facets of one tier apart. Noise of
/// one tolerance turns a facet that is a tenth of a radius wide by ten tolerances.
const NOISE: f64 = 10.0;

/// The additional noise of tiers that were cut unevenly: facets of a tier may differ by 0.1, 0.7 or 1.3 degrees.
const WIDER: [f64; 3] = [0.0, 1e-3, 2e-3];

/// A facet that leans less than this (sine) is level: the table or the culet.
const LEVEL: f64 = 0.02;

/// Azimuths that lie less than this below 0 count as 0, radians.
const BEFORE_ZERO: f64 = 0.01;

/// The facets of one slope and offset, given by their places in the list of planes, in the order of their azimuths.
type Tier = Vec<usize>;

/// Returns every facet with a name of its own: the given names where there are any, else the trade's. `noise` is in girdle
/// radii.
pub(super) fn named(
    planes: &[Plane],
    table: Option<usize>,
    given: Option<Vec<String>>,
    noise: f64,
) -> Vec<(String, Plane)> {
    let (crown, girdle, pavilion) = tiered(planes, table, noise);
    let (above, below) = titles(planes, &crown, &pavilion);
    let mut found: Vec<(String, usize)> = table.map(|t| ("table".to_owned(), t)).into_iter().collect();
    for (title, tier) in above.into_iter().chain([("girdle".to_owned(), &girdle)]).chain(below) {
        found.extend(tier.iter().map(|&i| (title.clone(), i)));
    }
    // A name that repeats is that of an object in the file, not of a facet.
    let different =
        |names: &Vec<String>| names.iter().collect::<std::collections::BTreeSet<_>>().len() == names.len();
    let own = given.filter(|names| different(names) && names.iter().all(|name| names::is_printable(name)));
    let name =
        |title: &String, place: usize| own.as_ref().map_or(title.clone(), |names| names[place].clone());
    let titles: Vec<String> = found.iter().map(|(title, place)| name(title, *place)).collect();
    let unique = names::unique(titles.iter().map(String::as_str));
    unique.into_iter().zip(&found).map(|(name, (_, place))| (name, planes[*place])).collect()
}

/// Returns the tiers as [`parts`] does. Where the facets of a round brilliant are so unevenly cut that its tiers fall apart, tiers
/// may be wider.
fn tiered(planes: &[Plane], table: Option<usize>, noise: f64) -> (Vec<Tier>, Tier, Vec<Tier>) {
    let found = WIDER.map(|wider| parts(planes, table, noise + wider));
    let is_known = |(crown, _, pavilion): &(Vec<Tier>, Tier, Vec<Tier>)| {
        let below: Vec<&Tier> = pavilion.iter().filter(|tier| !is_culet(planes, tier)).collect();
        is_brilliant(planes, crown, &below)
    };
    let place = found.iter().position(is_known).unwrap_or(0);
    let [narrow, wide, widest] = found;
    [narrow, wide, widest].into_iter().nth(place).unwrap_or_default()
}

/// Returns the tiers of the crown from the girdle up, the girdle, and the tiers of the pavilion from the girdle down.
fn parts(planes: &[Plane], table: Option<usize>, noise: f64) -> (Vec<Tier>, Tier, Vec<Tier>) {
    let rest = |test: &dyn Fn(f64) -> bool| -> Vec<usize> {
        (0..planes.len()).filter(|&i| Some(i) != table && test(planes[i].normal.z)).collect()
    };
    let crown = tiers(planes, rest(&|z| z >= LEAST_UPRIGHT), noise);
    let pavilion = tiers(planes, rest(&|z| z <= -LEAST_UPRIGHT), noise);
    let mut girdle = rest(&|z| z.abs() < LEAST_UPRIGHT);
    by_azimuth(planes, &mut girdle);
    (crown, girdle, pavilion)
}

/// Groups facets into tiers of similar slope and offset, the steepest first. Those that noise alone joins are told apart by their classes of
/// azimuth.
fn tiers(planes: &[Plane], mut places: Vec<usize>, noise: f64) -> Vec<Tier> {
    let level = |i: usize| planes[i].normal.z.abs().min(1.0).acos();
    let offset = |i: usize| planes[i].offset;
    places.sort_by(|&a, &b| {
        level(b).total_cmp(&level(a)).then(offset(b).total_cmp(&offset(a))).then(a.cmp(&b))
    });
    let (slope, shift) = (SAME_SLOPE + NOISE * noise, SAME_OFFSET + NOISE * noise);
    let same = |&first: &usize, &place: &usize| {
        (level(first) - level(place)).abs() < slope && (offset(first) - offset(place)).abs() < shift
    };
    let joined: Vec<Tier> = grouped(places, same);
    let apart = |tier: Tier| azimuth_classes::divided(planes, &tier, [SAME_SLOPE, SAME_OFFSET]);
    let mut tiers: Vec<Tier> = joined.into_iter().flat_map(apart).collect();
    tiers.iter_mut().for_each(|tier| by_azimuth(planes, tier));
    tiers
}

fn azimuth(plane: &Plane) -> f64 {
    (plane.normal.y.atan2(plane.normal.x) + BEFORE_ZERO).rem_euclid(TAU)
}

fn by_azimuth(planes: &[Plane], places: &mut [usize]) {
    places.sort_by(|&a, &b| azimuth(&planes[a]).total_cmp(&azimuth(&planes[b])).then(a.cmp(&b)));
}

/// A tier and its name.
type Titled<'a> = (String, &'a Tier);

/// Returns the names of the tiers above and below the girdle, in the order in which they are listed.
fn titles<'a>(
    planes: &[Plane],
    crown: &'a [Tier],
    pavilion: &'a [Tier],
) -> (Vec<Titled<'a>>, Vec<Titled<'a>>) {
    let (culets, below): (Vec<&Tier>, Vec<&Tier>) = pavilion.iter().partition(|tier| is_culet(planes, tier));
    let (above, mut titled): (Vec<Titled<'a>>, Vec<Titled<'a>>) = if is_brilliant(planes, crown, &below) {
        let titled = |(name, tier): (&str, &'a Tier)| (name.to_owned(), tier);
        let above = ["bezel", "star", "upper_half"].into_iter().zip([&crown[1], &crown[2], &crown[0]]);
        let under = ["lower_half", "main"].into_iter().zip(below);
        (above.map(titled).collect(), under.map(titled).collect())
    } else {
        let above = crown.iter().enumerate().map(|(i, tier)| (format!("crown {}", letters(i)), tier));
        let under = below.iter().enumerate().map(|(i, tier)| (format!("pavilion {}", i + 1), *tier));
        (above.collect(), under.collect())
    };
    titled.extend(culets.into_iter().map(|tier| ("culet".to_owned(), tier)));
    (above, titled)
}

/// Returns whether a tier below the girdle is a culet.
fn is_culet(planes: &[Plane], tier: &Tier) -> bool {
    tier.len() == 1 && planes[tier[0]].normal.truncate().length() < LEVEL
}

/// Returns the letters of a number: A, B, ... Z, AA, AB, ...
fn letters(number: usize) -> String {
    let last = char::from(b'A' + (number % 26) as u8);
    if number < 26 { last.to_string() } else { format!("{}{last}", letters(number / 26 - 1)) }
}

/// Returns whether the tiers are those of a round brilliant.
///
/// A round brilliant has tiers of 16, 8 and 8 facets above the girdle and of 16 and 8 below it, with the stars
/// between the bezels and the mains below the bezels.
fn is_brilliant(planes: &[Plane], crown: &[Tier], below: &[&Tier]) -> bool {
    let ([upper, bezel, star], [lower, main]) = (crown, below) else { return false };
    let first = |tier: &Tier| azimuth(&planes[tier[0]]) - BEFORE_ZERO;
    let eighth = TAU / 8.0;
    let is = |tier: &Tier, count: usize, part: f64| {
        tier.len() == count && (first(tier) - part * eighth).abs() < 0.1 * eighth
    };
    is(upper, 16, 0.25) && is(bezel, 8, 0.0) && is(star, 8, 0.5) && is(lower, 16, 0.25) && is(main, 8, 0.0)
}
