//! The names of measures.
//!
//! To add a measure, compute it as an `Interval` from the beams, as a field of `LightMeasures`, of
//! `PatternMeasures` where it depends on the stone's size and on what the eye resolves, or of `Scintillation`. Add
//! a variant here with its place in `OTHERS` and in the text of `NoMeasure`, and what the compiler then asks for.
//! Its law goes into tests/library/measures.rs, its formula into docs/optics.md, its key into docs/formats.md. A
//! search climbs without slopes where a measure has no derivatives. A measure that is sampled has no interval, and
//! no name here.

use super::interval::Interval;
use super::light_measures::{LightMeasures, MeasureSettings};
use super::pattern_settings::PatternSettings;
use brillianteer_scene::DomeLight;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

/// The name of one of the [`LightMeasures`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum MeasureName {
    /// Light of a dome that has been inside the stone.
    Return(DomeLight),
    /// All light of a dome that reaches the eye, with the glare of the outer surface.
    ReturnWithGlare(DomeLight),
    /// [`LightMeasures::leakage`].
    Leakage,
    /// [`LightMeasures::windowing`].
    Windowing,
    /// [`LightMeasures::obstruction`].
    Obstruction,
    /// [`LightMeasures::extinction`].
    Extinction,
    /// [`LightMeasures::contrast`].
    Contrast,
    /// [`LightMeasures::fire`].
    Fire,
    /// [`LightMeasures::absorbed`].
    Absorbed,
    /// [`PatternMeasures::eye_contrast`](super::PatternMeasures::eye_contrast).
    EyeContrast,
    /// [`PatternMeasures::patch_size`](super::PatternMeasures::patch_size).
    PatchSize,
    /// [`PatternMeasures::crushed_ice`](super::PatternMeasures::crushed_ice).
    CrushedIce,
    /// [`PatternMeasures::fire_seen`](super::PatternMeasures::fire_seen).
    FireSeen,
    /// [`PatternMeasures::bow_tie`](super::PatternMeasures::bow_tie).
    BowTie,
    /// [`PatternMeasures::fish_eye`](super::PatternMeasures::fish_eye).
    FishEye,
    /// [`Scintillation::change`](super::Scintillation::change).
    Scintillation,
    /// [`Scintillation::size`](super::Scintillation::size).
    ScintillationSize,
}

/// The settings that a measure needs besides light and head.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum MeasureNeeds {
    /// No other setting.
    Light,
    /// The stone's size and the eye's resolution ([`MeasureSettings::pattern`]).
    Pattern,
    /// The stone after it has rocked as well ([`PatternSettings::rock_deg`](super::PatternSettings::rock_deg)).
    Rocking,
}

/// The reason why a text names no measure.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "'{0}' is no measure: give leakage, windowing, obstruction, extinction, contrast, fire, absorbed, eye-contrast, \
     patch-size, crushed-ice, fire-seen, bow-tie, fish-eye, scintillation, scintillation-size, or the return of a dome: \
     return-even, return-cos, return-cos2, with a head as in return-even@15, with glare as in return-cos2+glare{hint}",
    hint = hint(.0)
)]
pub struct NoMeasure(pub String);

/// Returns a hint about the weighted light return, which people may look for among these measures.
fn hint(text: &str) -> &'static str {
    match text {
        "wlr" => {
            "; wlr is sampled and has no bound, so it is listed only among the measures of a single view"
        }
        _ => "",
    }
}

/// The beginning of the names of all returns.
const RETURN: &str = "return-";

/// The end of the names of returns with glare.
const WITH_GLARE: &str = "+glare";

impl MeasureName {
    /// Returns which of two values of this measure is the better one: `Greater` where more is better; `None` where it
    /// is a matter of taste, as with contrast and the size of patches.
    pub fn better(self) -> Option<Ordering> {
        match self {
            Self::Return(_) | Self::ReturnWithGlare(_) | Self::Fire | Self::FireSeen => {
                Some(Ordering::Greater)
            }
            Self::Leakage
            | Self::Windowing
            | Self::Obstruction
            | Self::Extinction
            | Self::BowTie
            | Self::FishEye => Some(Ordering::Less),
            Self::Contrast
            | Self::Absorbed
            | Self::EyeContrast
            | Self::PatchSize
            | Self::CrushedIce
            | Self::Scintillation
            | Self::ScintillationSize => None,
        }
    }

    /// The measures that are no returns of domes, by their names.
    const OTHERS: [(&'static str, Self); 15] = [
        ("leakage", Self::Leakage),
        ("windowing", Self::Windowing),
        ("obstruction", Self::Obstruction),
        ("extinction", Self::Extinction),
        ("contrast", Self::Contrast),
        ("fire", Self::Fire),
        ("absorbed", Self::Absorbed),
        ("eye-contrast", Self::EyeContrast),
        ("patch-size", Self::PatchSize),
        ("crushed-ice", Self::CrushedIce),
        ("fire-seen", Self::FireSeen),
        ("bow-tie", Self::BowTie),
        ("fish-eye", Self::FishEye),
        ("scintillation", Self::Scintillation),
        ("scintillation-size", Self::ScintillationSize),
    ];

    /// Returns all measures that these settings give, in the order in which they are listed.
    pub fn all(settings: &MeasureSettings) -> Vec<Self> {
        let returns =
            settings.domes.iter().flat_map(|&dome| [Self::Return(dome), Self::ReturnWithGlare(dome)]);
        let known = match &settings.pattern {
            None => MeasureNeeds::Light,
            Some(pattern) if pattern.rock_deg.is_none() => MeasureNeeds::Pattern,
            Some(_) => MeasureNeeds::Rocking,
        };
        returns.chain(Self::OTHERS.map(|(_, measure)| measure)).filter(|name| name.needs() <= known).collect()
    }

    /// Returns the settings that this measure needs.
    pub fn needs(self) -> MeasureNeeds {
        match self {
            Self::EyeContrast
            | Self::PatchSize
            | Self::CrushedIce
            | Self::FireSeen
            | Self::BowTie
            | Self::FishEye => MeasureNeeds::Pattern,
            Self::Scintillation | Self::ScintillationSize => MeasureNeeds::Rocking,
            _ => MeasureNeeds::Light,
        }
    }

    /// Returns the dome whose return this is; `None` for other measures.
    pub fn dome(self) -> Option<DomeLight> {
        match self {
            Self::Return(dome) | Self::ReturnWithGlare(dome) => Some(dome),
            _ => None,
        }
    }

    /// Returns the measure of this name; `None` where it was not taken, or the stone has none: no fish eye without a table.
    pub fn of(self, measures: &LightMeasures) -> Option<Interval> {
        let domes = || measures.domes.iter().find(|each| Some(each.dome) == self.dome());
        match self {
            Self::Return(_) => domes().map(|dome| dome.inside),
            Self::ReturnWithGlare(_) => domes().map(|dome| dome.with_glare()),
            Self::Leakage => Some(measures.leakage),
            Self::Windowing => Some(measures.windowing),
            Self::Obstruction => Some(measures.obstruction),
            Self::Extinction => Some(measures.extinction),
            Self::Contrast => Some(measures.contrast),
            Self::Fire => Some(measures.fire),
            Self::Absorbed => Some(measures.absorbed),
            Self::EyeContrast => measures.pattern.map(|pattern| pattern.eye_contrast),
            Self::PatchSize => measures.pattern.map(|pattern| pattern.patch_size),
            Self::CrushedIce => measures.pattern.map(|pattern| pattern.crushed_ice),
            Self::FireSeen => measures.pattern.map(|pattern| pattern.fire_seen),
            Self::BowTie => measures.pattern.and_then(|pattern| pattern.bow_tie),
            Self::FishEye => measures.pattern.and_then(|pattern| pattern.fish_eye),
            Self::Scintillation => measures.scintillation.map(|found| found.change),
            Self::ScintillationSize => measures.scintillation.map(|found| found.size),
        }
    }
}

impl PatternSettings {
    /// Returns the usual settings for a stone of this girdle radius in mm that rocks by `rock_deg`, as far as these
    /// measures need them; `None` where they need none, because patterns take time.
    pub fn needed_by<'a>(
        measures: impl IntoIterator<Item = &'a MeasureName>,
        unit_mm: f64,
        rock_deg: f64,
    ) -> Option<Self> {
        let needs = measures.into_iter().map(|name| name.needs()).max()?;
        let rock_deg = (needs == MeasureNeeds::Rocking).then_some(rock_deg);
        (needs > MeasureNeeds::Light).then_some(Self { rock_deg, ..Self::usual(unit_mm) })
    }
}

impl fmt::Display for MeasureName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Return(dome) => write!(f, "{RETURN}{dome}"),
            Self::ReturnWithGlare(dome) => write!(f, "{RETURN}{dome}{WITH_GLARE}"),
            other => {
                let name = Self::OTHERS.iter().find(|(_, measure)| measure == other);
                f.write_str(name.map_or("", |(name, _)| name))
            }
        }
    }
}

impl From<MeasureName> for String {
    fn from(name: MeasureName) -> Self {
        name.to_string()
    }
}

impl TryFrom<String> for MeasureName {
    type Error = NoMeasure;

    fn try_from(text: String) -> Result<Self, NoMeasure> {
        text.parse()
    }
}

impl FromStr for MeasureName {
    type Err = NoMeasure;

    fn from_str(text: &str) -> Result<Self, NoMeasure> {
        let fault = |_| NoMeasure(text.to_owned());
        if let Some((_, measure)) = Self::OTHERS.iter().find(|(name, _)| *name == text) {
            return Ok(*measure);
        }
        let dome = text.strip_prefix(RETURN).ok_or(()).map_err(fault)?;
        match dome.strip_suffix(WITH_GLARE) {
            Some(dome) => dome.parse().map(Self::ReturnWithGlare).map_err(|_| fault(())),
            None => dome.parse().map(Self::Return).map_err(|_| fault(())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PatternSettings;

    #[test]
    fn a_name_is_read_as_it_is_written() {
        let mut settings = MeasureSettings::usual([1.5, 1.6]);
        assert_eq!(MeasureName::all(&settings).len(), 15);
        settings.pattern = Some(PatternSettings::usual(3.25));
        assert_eq!(MeasureName::all(&settings).len(), 21);
        settings.pattern = Some(PatternSettings { rock_deg: Some(3.0), ..PatternSettings::usual(3.25) });
        let all = MeasureName::all(&settings);
        assert_eq!(all.len(), 23);
        for measure in all {
            assert_eq!(measure.to_string().parse(), Ok(measure));
        }
        for text in ["", "return", "return-", "even", "return-even+Glare", "Fire", "return-cos2@"] {
            assert_eq!(text.parse::<MeasureName>(), Err(NoMeasure(text.into())));
        }
    }
}
