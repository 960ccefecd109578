//! The tiers of any cut that lists its facets. Each tier has one angle and one distance, which can be set.

use super::names::unique;
use super::{Cut, TierZone, tier_stem};
use brillianteer_math::{Plane, grouped};
use std::collections::HashMap;
use std::collections::HashSet;

/// A tier with the numbers that are set on a faceting machine. Where its facets differ, the numbers are their means.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineSetting {
    /// The name of its facets, without their numbers; of several tiers with one name the second has `#2` behind it, and so on.
    pub name: String,
    /// The number of facets.
    pub facets: usize,
    /// The angle from the girdle plane, degrees; below 0 for facets that face down.
    pub angle: f64,
    /// The distance from the origin, in the design's own unit.
    pub distance: f64,
}

impl Cut {
    /// Returns the tiers in the order in which they are listed; none for a cut that is shaped by proportions, or a mesh.
    ///
    /// No two have the same name: where a design has several tiers of one name, as `2` in crown and pavilion, the second is `2#2`.
    pub fn settings(&self) -> Vec<MachineSetting> {
        let mut settings = self.settings_as_named();
        let mut names: HashSet<String> = settings.iter().map(|setting| setting.name.clone()).collect();
        let mut seen: HashSet<String> = HashSet::new();
        for setting in &mut settings {
            if seen.insert(setting.name.clone()) {
                continue;
            }
            let mut numbered = (2..).map(|number: usize| format!("{}#{number}", setting.name));
            if let Some(name) = numbered.find(|name| names.insert(name.clone())) {
                setting.name = name;
            }
        }
        settings
    }

    /// Returns the names of the further tiers that a design calls by the same name as the first, which bears it in
    /// [`settings`](Self::settings): of `2` it is `2#2`, and so on. Empty for a name of one tier, or of none.
    pub fn namesakes(&self, name: &str) -> Vec<String> {
        let own = self.settings_as_named().into_iter().map(|setting| setting.name);
        let called = self.settings().into_iter().map(|setting| setting.name);
        own.zip(called)
            .filter(|(own, called)| own == name && called != name)
            .map(|(_, called)| called)
            .collect()
    }

    /// Returns the name of its tier in [`settings`](Self::settings) for each facet, by the facet's name; none for a cut that has no
    /// settings.
    pub(super) fn tiers_of_facets(&self) -> HashMap<String, String> {
        let settings = self.settings();
        match self {
            Self::RoundBrilliant(_) | Self::Family(_) | Self::Mesh(_) | Self::Glass(_) => HashMap::new(),
            Self::Tiers(design) => {
                let tiers = settings.iter().flat_map(|tier| std::iter::repeat_n(&tier.name, tier.facets));
                design
                    .facets()
                    .into_iter()
                    .zip(tiers)
                    .map(|((facet, _), tier)| (facet, tier.clone()))
                    .collect()
            }
            Self::Planes(planes) => {
                let names = unique(planes.iter().map(|(name, _)| name.as_str()));
                let named = groups(planes).into_iter().zip(settings);
                named
                    .flat_map(|(group, tier)| group.into_iter().map(move |k| (k, tier.name.clone())))
                    .map(|(k, tier)| (names[k].clone(), tier))
                    .collect()
            }
        }
    }

    fn settings_as_named(&self) -> Vec<MachineSetting> {
        match self {
            Self::RoundBrilliant(_) | Self::Family(_) | Self::Mesh(_) | Self::Glass(_) => vec![],
            Self::Tiers(design) => {
                let named = design.names().into_iter().zip(&design.tiers).filter(|(_, tier)| tier.is_cut);
                let setting = |(name, tier): (String, &super::Tier)| MachineSetting {
                    name,
                    facets: tier.facets.len(),
                    angle: tier.angle,
                    distance: tier.distance,
                };
                named.map(setting).collect()
            }
            Self::Planes(planes) => groups(planes).iter().map(|group| mean(planes, group)).collect(),
        }
    }

    /// Sets angle and distance of the tier at a place of [`settings`](Self::settings).
    ///
    /// Facets that differ are all turned by the same angle and moved by the same distance. A place past the last tier
    /// changes nothing.
    pub fn set(&mut self, place: usize, angle: f64, distance: f64) {
        match self {
            Self::RoundBrilliant(_) | Self::Family(_) | Self::Mesh(_) | Self::Glass(_) => {}
            Self::Tiers(design) => {
                if let Some(tier) = design.tiers.iter_mut().filter(|tier| tier.is_cut).nth(place) {
                    (tier.angle, tier.distance) = (angle, distance);
                }
            }
            Self::Planes(planes) => {
                let Some(group) = groups(planes).into_iter().nth(place) else { return };
                let before = mean(planes, &group);
                for k in group {
                    let plane = &mut planes[k].1;
                    *plane = turned(plane, angle.abs() - before.angle.abs(), distance - before.distance);
                }
            }
        }
    }
}

/// Groups the planes whose names differ only by a number and that face the same way. Each group lists their places.
fn groups(planes: &[(String, Plane)]) -> Vec<Vec<usize>> {
    let key = |k: usize| (tier_stem(&planes[k].0), faces(&planes[k].1));
    grouped(0..planes.len(), |&a, &b| key(a) == key(b))
}

fn faces(plane: &Plane) -> TierZone {
    match plane.normal.z {
        0.0 => TierZone::Girdle,
        z if z > 0.0 => TierZone::Crown,
        _ => TierZone::Pavilion,
    }
}

/// Returns the slope from the girdle plane in degrees, and the distance, of a plane whose normal may have any length.
fn slope(plane: &Plane) -> (f64, f64) {
    let slope = plane.normal.truncate().length().atan2(plane.normal.z.abs()).to_degrees();
    (slope, plane.offset / plane.normal.length())
}

fn mean(planes: &[(String, Plane)], group: &[usize]) -> MachineSetting {
    let count = group.len() as f64;
    let sum =
        group.iter().map(|&k| slope(&planes[k].1)).fold((0.0, 0.0), |sum, s| (sum.0 + s.0, sum.1 + s.1));
    let (name, first) = &planes[group[0]];
    let name = if group.len() > 1 { tier_stem(name) } else { name };
    let sign = if first.normal.z > 0.0 { 1.0 } else { -1.0 };
    MachineSetting {
        name: name.to_owned(),
        facets: group.len(),
        angle: sign * sum.0 / count,
        distance: sum.1 / count,
    }
}

/// Returns a plane that is steeper by some degrees and farther from the origin, with the same azimuth.
fn turned(plane: &Plane, degrees: f64, further: f64) -> Plane {
    let (slope, distance) = slope(plane);
    let across = plane.normal.truncate();
    let azimuth = if across.length() > 0.0 { across.to_angle() } else { 0.0 };
    let slope = (slope + degrees).to_radians();
    let slope = if plane.normal.z > 0.0 { slope } else { std::f64::consts::PI - slope };
    match degrees == 0.0 {
        // Where the plane is not turned, its normal keeps every digit.
        true => Plane::new(plane.normal, plane.offset + further * plane.normal.length()),
        false => Plane::from_slope(slope, azimuth, distance + further),
    }
}

#[cfg(test)]
mod tests {
    use super::super::round_brilliant::MODERN;
    use super::*;

    fn planes() -> Cut {
        Cut::Planes(MODERN.facets().unwrap())
    }

    #[test]
    fn tiers_of_one_name_are_told_apart() {
        use super::super::{Indexed, Tier, Tiers};
        let tier = |name: &str| Tier {
            angle: 40.0,
            distance: 1.0,
            instructions: String::new(),
            meet: None,
            is_cut: true,
            frosting: 0.0,
            facets: vec![Indexed { index: 0.0, name: name.to_owned() }],
        };
        let tiers = ["2", "1", "2", "2#2", "2"].map(tier).to_vec();
        let names: Vec<String> = Cut::Tiers(Tiers { tiers, ..Tiers::default() })
            .settings()
            .into_iter()
            .map(|setting| setting.name)
            .collect();
        // A name that stands for a facet of another tier gives way to a tier's short name.
        assert_eq!(names, ["2", "1", "2#2", "C4", "2#3"]);
        let cut = Cut::Tiers(Tiers { tiers: ["2", "1", "2"].map(tier).to_vec(), ..Tiers::default() });
        assert_eq!(cut.namesakes("2"), ["2#2"]);
        assert!(cut.namesakes("1").is_empty() && cut.namesakes("2#2").is_empty());
    }

    #[test]
    fn tiers_of_planes_are_found_by_name_and_set_together() {
        let mut cut = planes();
        let settings = cut.settings();
        let told: Vec<_> = settings.iter().map(|s| (s.name.as_str(), s.facets)).collect();
        assert_eq!(
            told,
            [
                ("table", 1),
                ("bezel", 8),
                ("star", 8),
                ("upper_half", 16),
                ("girdle", 96),
                ("lower_half", 16),
                ("main", 8)
            ]
        );
        assert!((settings[1].angle - 34.5).abs() < 1e-12 && (settings[6].angle + MODERN_MAIN).abs() < 1e-12);
        cut.set(6, -41.3, settings[6].distance + 0.01);
        let after = cut.settings();
        assert!(
            (after[6].angle + 41.3).abs() < 1e-9
                && (after[6].distance - settings[6].distance - 0.01).abs() < 1e-12
        );
        assert_eq!(after[..6], settings[..6]);
        let Cut::Planes(planes) = &cut else { panic!() };
        let azimuths = planes
            .iter()
            .filter(|(name, _)| name.starts_with("main"))
            .map(|(_, p)| p.normal.truncate().to_angle());
        for (k, azimuth) in azimuths.enumerate() {
            let expected = (k as f64 * 45.0).to_radians();
            assert!(((azimuth - expected + 1e-9).rem_euclid(std::f64::consts::TAU)) < 2e-9, "{k}: {azimuth}");
        }
        cut.set(99, 1.0, 1.0);
        assert_eq!(cut.settings(), after);
    }

    /// The pavilion angle of the modern brilliant, degrees.
    const MODERN_MAIN: f64 = 40.8;

    #[test]
    fn a_tier_that_stands_as_it_did_keeps_every_digit() {
        let mut cut = planes();
        let settings = cut.settings();
        cut.set(3, settings[3].angle, settings[3].distance);
        assert_eq!(cut, planes());
    }
}
