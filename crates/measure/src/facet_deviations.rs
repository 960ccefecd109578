//! The deviations of the facets of an eightfold round brilliant from their class, in azimuth and slope.
//!
//! The classes are found from the geometry alone, so that a scan without names is measured like a design. The definitions are in
//! docs/optics.md, "Facet deviations".

use brillianteer_cut::from_mesh::FacetError;
use brillianteer_cut::{FacetZones, TierZone};
use brillianteer_math::{Facet, Plane, span};
use brillianteer_scene::Stone;
use serde::Serialize;
use std::f64::consts::{FRAC_PI_4, PI};

/// The slope in degrees below which the flattest facet of a measured stone may be the table or the culet, though it leans by
/// more than the other facets do.
const LEANING_TABLE_DEG: f64 = 5.0;

/// A facet of a measured stone whose normal leans less than this from the girdle plane (sine of 6°) is part of the girdle, as
/// in facets that are found on a mesh.
const UPRIGHT: f64 = 0.104_528_463;

/// The number of octants.
pub(super) const OCTANTS: usize = 8;

/// A facet that deviates from its class.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FacetDeviation {
    /// The facet's name.
    pub facet: String,
    /// Its value less the median of its class, degrees.
    pub by_deg: f64,
    /// The facets whose mean value is the median: one, or two of an even number.
    #[serde(skip)]
    pub median_of: Vec<String>,
}

impl FacetDeviation {
    /// Returns the standard error of the deviation from those of the facets' own values; `None` where one is not known.
    ///
    /// The errors of facets are independent of one another, and the median moves with the facets in the middle alone. This holds where
    /// facets deviate by several errors, so that noise does not change their order. Of facets that deviate by noise alone, the one
    /// that deviates most is the one that noise has moved most: its deviation is off by up to twice as much. Derived.
    pub fn standard_error(&self, of: impl Fn(&str) -> Option<f64>) -> Option<f64> {
        let share = 1.0 / self.median_of.len().max(1) as f64;
        let is_middle = self.median_of.contains(&self.facet);
        let own = of(&self.facet)? * if is_middle { 1.0 - share } else { 1.0 };
        let others = self.median_of.iter().filter(|name| **name != self.facet);
        others.map(|name| of(name)).try_fold(own, |sum, error| Some(sum.hypot(share * error?)))
    }
}

/// A facet that deviates from its class, with the standard error of its deviation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ErringDeviation {
    /// The facet and its deviation.
    #[serde(flatten)]
    pub deviation: FacetDeviation,
    /// The standard error of the deviation, degrees; `None` where those of the facets are not known.
    pub error_deg: Option<f64>,
}

/// The deviations of one class of facets.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ClassDeviations<D = FacetDeviation> {
    /// The class: `star`, `bezel`, `upper half`, `lower half` or `main`.
    pub class: &'static str,
    /// The greatest azimuth deviation less the least, degrees.
    pub azimuth_spread_deg: f64,
    /// The facet whose azimuth deviates most.
    pub worst_azimuth: D,
    /// The greatest slope less the least, degrees.
    pub slope_spread_deg: f64,
    /// The facet whose slope deviates most.
    pub worst_slope: D,
}

impl ClassDeviations {
    /// Returns the deviations with their standard errors, which follow from those of the facets that were found in a scan.
    pub fn with_errors(&self, errors: &[FacetError]) -> ClassDeviations<ErringDeviation> {
        let of = |facet: &str| errors.iter().find(|error| error.facet == facet);
        let erring = |deviation: &FacetDeviation, error: &dyn Fn(&str) -> Option<f64>| ErringDeviation {
            deviation: deviation.clone(),
            error_deg: deviation.standard_error(error),
        };
        ClassDeviations {
            class: self.class,
            azimuth_spread_deg: self.azimuth_spread_deg,
            worst_azimuth: erring(&self.worst_azimuth, &|facet| of(facet)?.azimuth_deg),
            slope_spread_deg: self.slope_spread_deg,
            worst_slope: erring(&self.worst_slope, &|facet| Some(of(facet)?.slope_deg)),
        }
    }
}

/// The reason why a stone has no eightfold classes.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NotEightfold {
    /// The crown or the pavilion has another number of facets.
    #[error(
        "the {part} has {found} facets between {between}, but that of an eightfold round brilliant has {wanted}; \
         facet deviations, classes, hearts and arrows are of round brilliants alone"
    )]
    Facets {
        /// `crown` or `pavilion`.
        part: &'static str,
        /// The borders of the part, in words.
        between: &'static str,
        /// The number of facets.
        found: usize,
        /// The number of facets in a round brilliant.
        wanted: usize,
    },
    /// The facets that should be one class do not lie one in each octant, or two in each for halves.
    #[error(
        "the facets that should be the class '{class}' by their slope do not lie evenly in eight octants; facet deviations, \
         classes, hearts and arrows are of eightfold round brilliants alone"
    )]
    Uneven {
        /// The class.
        class: &'static str,
    },
}

/// Returns the deviations of all classes, from the table to the culet.
///
/// # Errors
/// Fails with [`NotEightfold`] where the stone is no round brilliant of eight mains.
pub fn facet_deviations(stone: &Stone) -> Result<Vec<ClassDeviations>, NotEightfold> {
    let FacetClasses { crown, pavilion, .. } = FacetClasses::of(stone)?;
    let (star, rest) = crown.split_at(OCTANTS);
    let (bezel, upper) = rest.split_at(OCTANTS);
    let (main, lower) = pavilion.split_at(OCTANTS);
    Ok(vec![
        deviations("star", star, phase(star))?,
        deviations("bezel", bezel, phase(bezel))?,
        deviations("upper half", upper, phase(bezel))?,
        deviations("lower half", lower, phase(main))?,
        deviations("main", main, phase(main))?,
    ])
}

/// The mains of an eightfold stone, one in each octant.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Mains {
    /// The names of the mains, counter-clockwise by octant.
    pub names: [String; OCTANTS],
    /// The azimuth of the middle of the first octant, radians, from -π/8 to π/8. Each main's azimuth, less its octant's number
    /// times 45°, deviates from it; their median does not.
    pub azimuth: f64,
    /// The numbers of the facets that are the table.
    pub table: Vec<usize>,
}

impl Mains {
    /// Finds the mains of a stone.
    ///
    /// # Errors
    /// Fails with [`NotEightfold`] where the stone is no round brilliant of eight mains.
    pub fn of(stone: &Stone) -> Result<Self, NotEightfold> {
        let FacetClasses { table, pavilion, .. } = FacetClasses::of(stone)?;
        let mains = &pavilion[..OCTANTS];
        let phase = phase(mains);
        let mut names: [String; OCTANTS] = Default::default();
        for (main, &(octant, within)) in mains.iter().zip(&placed(mains, phase)) {
            if within.abs() >= FRAC_PI_4 / 4.0 || !names[octant].is_empty() {
                return Err(NotEightfold::Uneven { class: "main" });
            }
            names[octant].clone_from(&main.name);
        }
        let within = placed(mains, phase).into_iter().map(|(_, within)| within).collect();
        Ok(Self { names, azimuth: phase + median(within), table })
    }
}

/// The facets between table and girdle and between girdle and culet, the flattest first.
pub(super) struct FacetClasses {
    /// The numbers of the level facets on top, which are the table.
    pub table: Vec<usize>,
    /// The stars, the bezels and the upper halves.
    pub crown: Vec<LeaningFacet>,
    /// The mains and the lower halves.
    pub pavilion: Vec<LeaningFacet>,
}

impl FacetClasses {
    /// Finds the facets of a stone that has as many as a round brilliant of eight mains.
    pub fn of(stone: &Stone) -> Result<Self, NotEightfold> {
        let zones = FacetZones::of(&stone.polytope);
        let ((table, crown), (_, pavilion)) = (side(stone, &zones, true), side(stone, &zones, false));
        let counted = |part, between, found: usize, wanted| {
            if found == wanted { Ok(()) } else { Err(NotEightfold::Facets { part, between, found, wanted }) }
        };
        counted("crown", "girdle and table", crown.len(), 4 * OCTANTS)?;
        counted("pavilion", "girdle and culet", pavilion.len(), 3 * OCTANTS)?;
        Ok(Self { table, crown, pavilion })
    }
}

/// Returns the numbers of the level facets of one side of a stone, and its leaning facets, the flattest first.
fn side(stone: &Stone, zones: &FacetZones, is_up: bool) -> (Vec<usize>, Vec<LeaningFacet>) {
    let is_girdle =
        |facet: &Facet| zones.is_girdle(facet) || zones.is_measured() && facet.plane.normal.z.abs() < UPRIGHT;
    let facets = stone.polytope.facets().iter().enumerate();
    let of_side = facets.filter(|(_, facet)| (facet.plane.normal.z > 0.0) == is_up && !is_girdle(facet));
    let is_level = |facet: &Facet| matches!(zones.zone(facet), TierZone::Table | TierZone::Culet);
    let (level, leaning): (Vec<_>, Vec<_>) = of_side.partition(|(_, facet)| is_level(facet));
    let mut level: Vec<usize> = level.into_iter().map(|(number, _)| number).collect();
    let mut leaning: Vec<LeaningFacet> =
        leaning.into_iter().map(|(number, facet)| LeaningFacet::of(&facet.plane, number, stone)).collect();
    leaning.sort_by(|a, b| a.slope_deg.total_cmp(&b.slope_deg));
    let is_leaning_table = zones.is_measured() && level.is_empty();
    if is_leaning_table && leaning.first().is_some_and(|facet| facet.slope_deg < LEANING_TABLE_DEG) {
        level.push(leaning.remove(0).number);
    }
    (level, leaning)
}

/// A facet of crown or pavilion.
pub(super) struct LeaningFacet {
    /// Its number in the stone.
    pub number: usize,
    name: String,
    /// Radians.
    azimuth: f64,
    /// Degrees from the girdle plane.
    pub slope_deg: f64,
}

impl LeaningFacet {
    /// Returns the facet of this plane and number.
    fn of(plane: &Plane, number: usize, stone: &Stone) -> Self {
        let (normal, across) = (plane.normal, plane.normal.truncate());
        let slope_deg = across.length().atan2(normal.z.abs()).to_degrees();
        Self { number, name: stone.name(number as u32).into_owned(), azimuth: across.to_angle(), slope_deg }
    }
}

/// Returns the azimuth, modulo an octant, around which the facets of a class lie.
fn phase(class: &[LeaningFacet]) -> f64 {
    let eightfold = class.iter().map(|facet| glam::DVec2::from_angle(OCTANTS as f64 * facet.azimuth));
    eightfold.sum::<glam::DVec2>().to_angle() / OCTANTS as f64
}

/// Returns each facet's octant and its azimuth from the middle of it, radians, for octants centred on `phase`.
fn placed(facets: &[LeaningFacet], phase: f64) -> Vec<(usize, f64)> {
    let place = |facet: &LeaningFacet| {
        let turns = (facet.azimuth - phase) / FRAC_PI_4;
        let octant = turns.round();
        ((octant as i64).rem_euclid(OCTANTS as i64) as usize, (turns - octant) * FRAC_PI_4)
    };
    facets.iter().map(place).collect()
}

/// Returns the deviations of one class, whose octants are centred on `phase`.
fn deviations(
    class: &'static str,
    facets: &[LeaningFacet],
    phase: f64,
) -> Result<ClassDeviations, NotEightfold> {
    let placed = placed(facets, phase);
    let is_half = facets.len() > OCTANTS;
    // The halves to the left and to the right of a main have their own means.
    let side = |within: f64| usize::from(is_half && within > 0.0);
    let mut filled = [[0u32; OCTANTS]; 2];
    for &(octant, within) in &placed {
        filled[side(within)][octant] += 1;
    }
    let near = placed.iter().all(|(_, within)| is_half || within.abs() < PI / 16.0);
    if !near || filled.iter().take(1 + usize::from(is_half)).flatten().any(|&count| count != 1) {
        return Err(NotEightfold::Uneven { class });
    }
    let means = [0, 1].map(|of| {
        median(placed.iter().map(|placed| placed.1).filter(|&within| side(within) == of).collect())
    });
    let turned: Vec<f64> =
        placed.iter().map(|(_, within)| (within - means[side(*within)]).to_degrees()).collect();
    let slope = median(facets.iter().map(|facet| facet.slope_deg).collect());
    let leant: Vec<f64> = facets.iter().map(|facet| facet.slope_deg - slope).collect();
    let spread = |values: &[f64]| {
        let (least, most) = span(values.iter().copied());
        most - least
    };
    let sides: Vec<usize> = placed.iter().map(|(_, within)| side(*within)).collect();
    let worst = |values: &[f64], sides: &[usize]| {
        let worst = (0..values.len()).max_by(|&a, &b| values[a].abs().total_cmp(&values[b].abs()));
        let Some(worst) = worst else {
            return FacetDeviation { facet: String::new(), by_deg: 0.0, median_of: vec![] };
        };
        let mut alike: Vec<usize> = (0..values.len()).filter(|&k| sides[k] == sides[worst]).collect();
        alike.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
        let middle = &alike[(alike.len() - 1) / 2..=alike.len() / 2];
        FacetDeviation {
            facet: facets[worst].name.clone(),
            by_deg: values[worst],
            median_of: middle.iter().map(|&k| facets[k].name.clone()).collect(),
        }
    };
    Ok(ClassDeviations {
        class,
        azimuth_spread_deg: spread(&turned),
        worst_azimuth: worst(&turned, &sides),
        slope_spread_deg: spread(&leant),
        worst_slope: worst(&leant, &vec![0; leant.len()]),
    })
}

/// Returns the median, on which one deviating facet has no effect; 0 for an empty list.
pub(super) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let (half, count) = (values.len() / 2, values.len());
    match count {
        0 => 0.0,
        _ if count % 2 == 1 => values[half],
        _ => f64::midpoint(values[half - 1], values[half]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_cut::TOLKOWSKY;
    use brillianteer_math::random_bits::{GAMMA, mixed, unit};

    fn changed(name: &str, slope_deg: f64, azimuth_deg: f64, turn_deg: f64) -> Vec<ClassDeviations> {
        let turned = |azimuth: f64| azimuth + turn_deg.to_radians();
        let facets = TOLKOWSKY.facets().unwrap().into_iter().map(|(own, plane)| {
            let across = plane.normal.truncate();
            let (slope, azimuth) = (across.length().atan2(plane.normal.z), turned(across.to_angle()));
            let by = |degrees: f64| if own == name { degrees.to_radians() } else { 0.0 };
            let plane = Plane::from_slope(slope + by(slope_deg), azimuth + by(azimuth_deg), plane.offset);
            (own, plane)
        });
        facet_deviations(&Stone::new(&facets.collect::<Vec<_>>()).unwrap()).unwrap()
    }

    #[test]
    fn an_ideal_cut_deviates_by_nothing_however_it_is_turned() {
        for turn in [0.0, 11.0, 22.5, 200.3] {
            for class in changed("", 0.0, 0.0, turn) {
                let most = class.azimuth_spread_deg.max(class.slope_spread_deg);
                assert!(most < 1e-9, "{turn}: {class:?}");
            }
        }
    }

    #[test]
    fn a_facet_that_is_turned_or_leans_is_named_with_its_amount_and_no_other_class_is() {
        for (name, at) in
            [("main 3", 4), ("star 8", 0), ("bezel 5", 1), ("upper_half 2", 2), ("lower_half 16", 3)]
        {
            for by in [0.3, -0.3] {
                let turned = changed(name, 0.0, by, 33.0);
                let leant = changed(name, by, 0.0, 33.0);
                let sign = if at > 2 { -1.0 } else { 1.0 };
                for k in 0..5 {
                    let expected = if k == at { 0.3 } else { 0.0 };
                    assert!((turned[k].azimuth_spread_deg - expected).abs() < 1e-9, "{name}: {turned:?}");
                    assert!((leant[k].slope_spread_deg - expected).abs() < 1e-9, "{name}: {leant:?}");
                }
                assert_eq!(
                    (turned[at].worst_azimuth.facet.as_str(), leant[at].worst_slope.facet.as_str()),
                    (name, name)
                );
                assert!((turned[at].worst_azimuth.by_deg - by).abs() < 1e-9, "{turned:?}");
                assert!((leant[at].worst_slope.by_deg - sign * by).abs() < 1e-9, "{leant:?}");
            }
        }
    }

    /// Returns the deviations of a brilliant whose facets are off by flaws, and by noise besides, of these standard deviations.
    fn noisy(flaw_deg: f64, noise_deg: f64, flaws: u64, seed: u64) -> Vec<ClassDeviations> {
        let normal = |number: u64| {
            let [a, b] = [2 * number, 2 * number + 1].map(|n| unit(mixed(n.wrapping_mul(GAMMA))));
            (-2.0 * (1.0 - a).ln()).sqrt() * (2.0 * PI * b).cos()
        };
        let facets = (0..).zip(TOLKOWSKY.facets().unwrap()).map(|(k, (name, plane))| {
            let across = plane.normal.truncate();
            let off = |part: u64| {
                let place = 1000 * (2 * k + part);
                flaw_deg * normal(place + flaws) + noise_deg * normal(1_000_000 + place + seed)
            };
            let [lean, turn] = [off(0), off(1)].map(f64::to_radians);
            let slope = across.length().atan2(plane.normal.z);
            match plane.normal.z.abs() {
                0.1..0.99 => (name, Plane::from_slope(slope + lean, across.to_angle() + turn, plane.offset)),
                _ => (name, plane),
            }
        });
        facet_deviations(&Stone::new(&facets.collect::<Vec<_>>()).unwrap()).unwrap()
    }

    #[test]
    fn errors_of_deviations_cover_what_noise_adds_to_the_flaws_of_facets() {
        const NOISE_DEG: f64 = 0.002;
        let (mut within, mut squares, mut count) = (0, 0.0, 0);
        for seed in 0..120 {
            let [truth, found] = [0.0, NOISE_DEG].map(|noise| noisy(0.1, noise, seed % 12, seed));
            for (truth, found) in truth.iter().zip(&found) {
                let pairs =
                    [(&truth.worst_azimuth, &found.worst_azimuth), (&truth.worst_slope, &found.worst_slope)];
                for (truth, found) in pairs.into_iter().filter(|(truth, found)| truth.facet == found.facet) {
                    let error = found.standard_error(|_| Some(NOISE_DEG)).unwrap();
                    let off = (found.by_deg - truth.by_deg) / error;
                    within += usize::from(off.abs() < 1.96);
                    squares += off * off;
                    count += 1;
                }
            }
        }
        let (cover, scale) =
            (f64::from(within as u32) / f64::from(count), (squares / f64::from(count)).sqrt());
        assert!(count > 1000 && (cover - 0.95).abs() < 0.02, "{cover} of {count}");
        assert!((scale - 1.0).abs() < 0.07, "{scale}");
    }

    #[test]
    fn a_deviation_from_the_median_has_the_errors_of_the_facets_in_the_middle() {
        let deviation = |of: &[&str]| FacetDeviation {
            facet: "a".to_owned(),
            by_deg: 1.0,
            median_of: of.iter().map(|&name| name.to_owned()).collect(),
        };
        let error = |name: &str| match name {
            "a" => Some(3.0),
            "b" => Some(4.0),
            _ => None,
        };
        assert_eq!(deviation(&["b"]).standard_error(error), Some(5.0));
        assert_eq!(deviation(&["a", "b"]).standard_error(error), Some(2.5));
        assert_eq!(deviation(&["a"]).standard_error(error), Some(0.0));
        assert_eq!(deviation(&["b", "c"]).standard_error(error), None);
    }

    #[test]
    fn a_stone_without_the_facets_of_a_brilliant_is_refused_with_their_number() {
        let facets = TOLKOWSKY.facets().unwrap().into_iter().filter(|(name, _)| name != "star 2");
        let stone = Stone::new(&facets.collect::<Vec<_>>()).unwrap();
        let why = facet_deviations(&stone).unwrap_err();
        assert!(matches!(why, NotEightfold::Facets { part: "crown", found: 31, wanted: 32, .. }), "{why}");
    }
}
