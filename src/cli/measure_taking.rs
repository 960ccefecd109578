//! Takes the measures of a design, for the commands that vary it.

use super::options::{ViewOptions, checked_head, number};
use super::specimen::{note_namesakes, note_no_fire};
use super::specimen_options::SpecimenOptions;
use brillianteer_base::Failure;
use brillianteer_measure::{MEASURES_HEAD_DEG, MeasureName, MeasureSettings};
use brillianteer_optics::line;
use brillianteer_render::{Sweep, SweepAxis, SweepKey};
use clap::Args;
use std::path::Path;

/// The default part of the light that may stay unresolved at each point.
pub const UNRESOLVED: f64 = 2e-3;

#[derive(Debug, Args)]
pub struct MeasureTaking {
    /// The half angle of the head that hides light in obstruction, extinction and contrast
    #[arg(long, value_name = "DEGREES", default_value_t = MEASURES_HEAD_DEG, value_parser = number)]
    head: f64,
    /// Follow the beams until no more than this part of the light is unresolved
    #[arg(long, value_name = "PART", default_value_t = UNRESOLVED, value_parser = number)]
    unresolved: f64,
    /// Treat the light as unpolarised at every surface
    #[arg(long)]
    unpolarised: bool,
    #[command(flatten)]
    view: ViewOptions,
    #[command(flatten)]
    specimen: SpecimenOptions,
}

impl MeasureTaking {
    /// Refuses numbers out of their ranges.
    pub fn check(&self) -> Result<(), Failure> {
        let refused = |text: String| Err(Failure::Usage(text));
        if !(self.unresolved > 0.0 && self.unresolved < 1.0) {
            return refused(format!("--unresolved {}: give a part between 0 and 1", self.unresolved));
        }
        checked_head(self.head).map(drop)
    }

    /// Loads a design, and returns its sweep over these axes, with these measures.
    pub fn sweep(
        &self,
        file: &Path,
        axes: Vec<SweepAxis>,
        measures: &[MeasureName],
    ) -> Result<Sweep, Failure> {
        let specimen = self.specimen.load(file)?;
        let is_varied = axes.iter().any(|axis| axis.key == SweepKey::Material);
        note_namesakes(&specimen.path, &specimen.design.cut, axes.iter().map(|axis| &axis.key));
        note_no_fire(&specimen.material, measures.iter().copied().filter(|_| !is_varied), "by --material");
        Ok(Sweep {
            design: specimen.design.clone(),
            viewpoint: self.view.viewpoint()?,
            axes,
            settings: settings_of(measures, self.head),
            wavelength_nm: line::SODIUM_D,
            unresolved: self.unresolved,
            polarised: !self.unpolarised,
        })
    }
}

/// Returns the settings by which these measures of a design are taken, under a head of this half angle, degrees. The
/// indices of colours are left open, as each point of a sweep has those of its material.
pub fn settings_of(measures: &[MeasureName], head_deg: f64) -> MeasureSettings {
    let mut domes = vec![];
    for dome in measures.iter().filter_map(|name| name.dome()) {
        if !domes.contains(&dome) {
            domes.push(dome);
        }
    }
    MeasureSettings { domes, head_deg, ..MeasureSettings::usual([1.0; 2]) }
}
