//! Measures in words: their names on screen and paper, their meanings, and their values.

use super::{Interval, MeasureName, MeasureSettings, PatternSettings, ROCK_DEG};
use brillianteer_scene::DomeLight;

/// Returns the measures that can be chosen: the usual ones and those of the pattern that an eye sees, also while the
/// stone rocks.
pub fn all() -> Vec<MeasureName> {
    let pattern = PatternSettings { rock_deg: Some(ROCK_DEG), ..PatternSettings::usual(1.0) };
    MeasureName::all(&MeasureSettings { pattern: Some(pattern), ..MeasureSettings::usual([1.0; 2]) })
}

/// Returns the name of a measure.
pub fn name(measure: MeasureName) -> String {
    match measure {
        MeasureName::Return(dome) => format!("Return, {}", dome_name(dome)),
        MeasureName::ReturnWithGlare(dome) => format!("Return with glare, {}", dome_name(dome)),
        MeasureName::Leakage => "Leakage".to_owned(),
        MeasureName::Windowing => "Windowing".to_owned(),
        MeasureName::Obstruction => "Obstruction".to_owned(),
        MeasureName::Extinction => "Extinction".to_owned(),
        MeasureName::Contrast => "Contrast".to_owned(),
        MeasureName::Fire => "Fire".to_owned(),
        MeasureName::Absorbed => "Absorbed".to_owned(),
        MeasureName::EyeContrast => "Contrast for the eye".to_owned(),
        MeasureName::PatchSize => "Size of patches".to_owned(),
        MeasureName::CrushedIce => "Crushed ice".to_owned(),
        MeasureName::FireSeen => "Fire that is seen".to_owned(),
        MeasureName::BowTie => "Bow tie".to_owned(),
        MeasureName::FishEye => "Fish eye".to_owned(),
        MeasureName::Scintillation => "Scintillation".to_owned(),
        MeasureName::ScintillationSize => "Size of scintillation".to_owned(),
    }
}

fn dome_name(dome: DomeLight) -> String {
    let light = match dome.power {
        0.0 => "even light".to_owned(),
        1.0 => "light by cosine".to_owned(),
        2.0 => "light by cosine²".to_owned(),
        3.0 => "light by cosine³".to_owned(),
        power => format!("light by cosine to the power {power}"),
    };
    match dome.head_deg {
        0.0 => light,
        head => format!("{light}, head {head}°"),
    }
}

/// Returns the meaning of a measure, in whole sentences.
pub fn meaning(measure: MeasureName) -> &'static str {
    match measure {
        MeasureName::Return(_) => {
            "The light of a dome above that comes back through the stone, in percent of what a white sheet in its place \
             would send under an even dome."
        }
        MeasureName::ReturnWithGlare(_) => {
            "The light of a dome above that comes back, with the glare of the outer surface, in percent of what a white sheet \
             would send under an even dome."
        }
        MeasureName::Leakage => "The light that comes from below the horizon, in percent of the face.",
        MeasureName::Windowing => {
            "The light from below that crosses the stone without being reflected inside, in percent of the face."
        }
        MeasureName::Obstruction => {
            "The light that comes from the observer's head of 15°, in percent of the face."
        }
        MeasureName::Extinction => {
            "The part of the face whose strongest light comes from the head or from below the horizon."
        }
        MeasureName::Contrast => {
            "How much the brightness varies over the face: its standard deviation in percent of its mean."
        }
        MeasureName::Fire => "The light from above whose colours an eye sees apart, in percent of the face.",
        MeasureName::Absorbed => "The light that is absorbed inside the stone, in percent of the face.",
        MeasureName::EyeContrast => {
            "How much the brightness varies between places that an eye resolves: its standard deviation in percent of its mean."
        }
        MeasureName::PatchSize => {
            "The mean diameter of bright and dark patches, in percent of the face's diameter."
        }
        MeasureName::CrushedIce => {
            "The part of the face in virtual facets that are too small for an eye to see their shape."
        }
        MeasureName::FireSeen => {
            "The fire of virtual facets that are large enough for an eye to resolve, in percent of the face."
        }
        MeasureName::BowTie => "The obstruction toward the short axis less that toward the long axis.",
        MeasureName::FishEye => {
            "The part of the table through which the girdle is seen, reflected in the pavilion."
        }
        MeasureName::Scintillation => {
            "How much the brightness of a place changes as the stone rocks, in percent of the mean brightness."
        }
        MeasureName::ScintillationSize => {
            "The mean diameter of the patches that change as the stone rocks, in percent of the face's diameter."
        }
    }
}

/// Writes a value with the interval in which it certainly lies.
pub fn value(found: Interval) -> String {
    let [least, most] = [found.least, found.most].map(|part| 100.0 * part);
    if most.is_finite() {
        format!("{:.2} % (certainly {least:.2} to {most:.2} %)", 100.0 * found.middle())
    } else {
        format!("at least {least:.2} %")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_measures_have_one_name() {
        let mut names: Vec<String> = all().into_iter().map(name).collect();
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!((names.len(), count), (23, 23));
    }

    #[test]
    fn a_value_has_its_interval_or_its_lower_end() {
        assert_eq!(value(Interval { least: 0.5, most: 0.51 }), "50.50 % (certainly 50.00 to 51.00 %)");
        assert_eq!(value(Interval { least: 0.5, most: f64::INFINITY }), "at least 50.00 %");
    }
}
