//! The names of measures.

use super::light_measures::{Interval, LightMeasures, MeasureSettings};
use crate::scene::DomeLight;
use std::fmt;
use std::str::FromStr;

/// One of the [`LightMeasures`] by its name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MeasureName {
    /// Light of a dome that has been inside the stone.
    Return(DomeLight),
    /// All light of a dome that reaches the eye.
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
}

/// Why a text names no measure.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "'{0}' is no measure: give leakage, windowing, obstruction, extinction, contrast, fire, absorbed, or the return of a dome: \
     return-even, return-cos, return-cos2, with a head as in return-even@15, with glare as in return-cos2+glare"
)]
pub struct NoMeasure(pub String);

/// What the names of all returns begin with.
const RETURN: &str = "return-";

/// What the names of returns with glare end with.
const WITH_GLARE: &str = "+glare";

impl MeasureName {
    /// The measures that are no returns of domes, by their names.
    const OTHERS: [(&'static str, Self); 7] = [
        ("leakage", Self::Leakage),
        ("windowing", Self::Windowing),
        ("obstruction", Self::Obstruction),
        ("extinction", Self::Extinction),
        ("contrast", Self::Contrast),
        ("fire", Self::Fire),
        ("absorbed", Self::Absorbed),
    ];

    /// Returns all measures that these settings give, in the order in which they are listed.
    pub fn all(settings: &MeasureSettings) -> Vec<Self> {
        let returns =
            settings.domes.iter().flat_map(|&dome| [Self::Return(dome), Self::ReturnWithGlare(dome)]);
        returns.chain(Self::OTHERS.map(|(_, measure)| measure)).collect()
    }

    /// Returns the dome whose return this is; `None` for other measures.
    pub fn dome(self) -> Option<DomeLight> {
        match self {
            Self::Return(dome) | Self::ReturnWithGlare(dome) => Some(dome),
            _ => None,
        }
    }

    /// Returns the measure of this name; `None` where its dome was not measured.
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
        }
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

    #[test]
    fn a_name_is_read_as_it_is_written() {
        let all = MeasureName::all(&MeasureSettings::usual([1.5, 1.6]));
        assert_eq!(all.len(), 15);
        for measure in all {
            assert_eq!(measure.to_string().parse(), Ok(measure));
        }
        for text in ["", "return", "return-", "even", "return-even+Glare", "Fire", "return-cos2@"] {
            assert_eq!(text.parse::<MeasureName>(), Err(NoMeasure(text.into())));
        }
    }
}
