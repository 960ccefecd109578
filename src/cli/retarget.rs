//! `retarget`: fits a design to another material, and measures the light of both.

use super::comments;
use super::console::{json, print, say, written};
use super::options::{checked_wavelength, extrapolation, number};
use super::specimen::{asked_material, note_colour};
use super::specimen_options::SizeOptions;
use brillianteer_base::Failure;
use brillianteer_cut::{Design, RetargetError, RetargetRule, Retargeted, ScaleError, retarget};
use brillianteer_files::design_file::{self, DesignFormat};
use brillianteer_math::fixed;
use brillianteer_measure::Measured;
use brillianteer_optics::line;
use brillianteer_render::{MeasureError, MeasureOptions, measure};
use brillianteer_scene::Specimen;
use clap::{Args, ValueEnum};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct RetargetArguments {
    /// A design, or the name of a cut that comes with the program
    file: PathBuf,
    /// The new material: its name, or an index
    #[arg(long, value_name = "MATERIAL")]
    material: String,
    /// The rule by which the angles change
    #[arg(long, value_enum)]
    rule: Rule,
    /// The factor of the tangents [default: the main tier keeps its margin over the critical angle]
    #[arg(long, value_name = "FACTOR", value_parser = number)]
    factor: Option<f64>,
    /// The side whose tangents are multiplied; the crown needs --factor
    #[arg(long, value_enum, default_value_t = RetargetSide::Pavilion)]
    side: RetargetSide,
    /// The file to write the new design to; its ending names the format
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Measure no light
    #[arg(long)]
    no_light: bool,
    /// Measure the light at this wavelength in nm; stones of a strong colour let little of other colours pass
    #[arg(
        long, value_name = "NM", default_value_t = line::SODIUM_D, value_parser = number,
        conflicts_with = "no_light"
    )]
    wavelength: f64,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    sized: SizeOptions,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Rule {
    /// Turn each pavilion tier by the difference of the critical angles; the crown stays
    CriticalAngle,
    /// Multiply the tangents of one side's angles by one factor, which keeps every meet
    TangentRatio,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum RetargetSide {
    Pavilion,
    Crown,
}

/// The light of one stone, with the words that say which stone it is.
struct MeasuredStone {
    label: String,
    measured: Measured,
    carats: Option<f64>,
}

impl RetargetArguments {
    fn rule(&self) -> Result<RetargetRule, Failure> {
        match (self.rule, self.side, self.factor) {
            (Rule::CriticalAngle, RetargetSide::Pavilion, None) => Ok(RetargetRule::CriticalAngle),
            (Rule::CriticalAngle, ..) => {
                Err(Failure::Usage("--factor and --side crown are for --rule tangent-ratio".into()))
            }
            (_, RetargetSide::Pavilion, factor) => Ok(RetargetRule::PavilionRatio(factor)),
            (_, RetargetSide::Crown, Some(factor)) => Ok(RetargetRule::CrownRatio(factor)),
            (_, RetargetSide::Crown, None) => Err(Failure::Usage(
                "--side crown: no rule gives the crown's factor; give it by --factor, such as 0.95".into(),
            )),
        }
    }

    pub fn run(&self) -> Result<(), Failure> {
        let rule = self.rule()?;
        let format = self.out.as_deref().map(|path| {
            DesignFormat::of_name(path).filter(|format| format.holds_designs()).ok_or_else(|| {
                Failure::Usage(format!(
                    "{}: give a name that ends in .toml, .asc, .gem or .gcs",
                    path.display()
                ))
            })
        });
        let format = format.transpose()?;
        self.out.iter().try_for_each(|out| comments::keep(&self.file, out, "give another name"))?;
        let specimen = self.sized.load(&self.file)?;
        let path = specimen.path.clone();
        let (material, _) = asked_material(&self.material)?;
        let found = retarget(&specimen.design, material, rule).map_err(|error| match error {
            RetargetError::Scale(ScaleError::Factor { .. }) | RetargetError::NoCriticalAngle { .. } => {
                Failure::Usage(format!("{path}: {error}"))
            }
            error => Failure::Input(format!("{path}: {error}")),
        })?;
        let made = Specimen::new(found.design.clone())
            .map_err(|error| Failure::Input(format!("{path}: fitted to the material, {error}")))?;
        // Warnings that the old design has as well were printed when it was read.
        let unusual = made.unusual.iter().filter(|warning| !specimen.unusual.contains(warning));
        let odd = made.warnings.iter().filter(|warning| !specimen.warnings.contains(warning));
        for warning in unusual.map(ToString::to_string).chain(odd.cloned()) {
            say(&format!("warning: {path}, fitted: {warning}"));
        }
        let light = if self.no_light { vec![] } else { self.light(&specimen, &made)? };
        let text = match self.json {
            true => json(&self.value(&path, (&specimen, &made), &found, &light)),
            false => self.table(&path, (&specimen, &made), &found, &light),
        };
        print(&text)?;
        if let (Some(out), Some(format)) = (&self.out, format) {
            let lost = design_file::write(&made, format, out)?;
            lost.iter().for_each(|what| say(&format!("note: {}: {what}", out.display())));
            if !self.json {
                written(out)?;
            }
        }
        Ok(())
    }

    /// Measures the old design in its old and in the new material, and the new design.
    fn light(&self, old: &Specimen, new: &Specimen) -> Result<Vec<MeasuredStone>, Failure> {
        let wavelength_nm = checked_wavelength(self.wavelength)?;
        let options = MeasureOptions { wavelength_nm, ..MeasureOptions::default() };
        for material in [&old.material, &new.material] {
            note_colour(material);
            if let Some(warning) = extrapolation(material, wavelength_nm) {
                say(&format!("warning: {warning}"));
            }
        }
        let same_angles = Design { material: new.design.material.clone(), ..old.design.clone() };
        let (of_old, of_new) = (&old.material.name, &new.material.name);
        let volume = |specimen: &Specimen| specimen.solid().volume() * specimen.unit_mm().powi(3);
        let stone = |label: String, design: &Design, carats| -> Result<MeasuredStone, Failure> {
            let measured = measure(design, &options).map_err(|error| match error {
                MeasureError::Render(error) => error.into(),
                error => Failure::Input(format!("{label}: {error}")),
            })?;
            Ok(MeasuredStone { label, measured, carats })
        };
        Ok(vec![
            stone(format!("as it was, {of_old}"), &old.design, old.carats())?,
            stone(format!("as it was, {of_new}"), &same_angles, new.material.carats(volume(old)))?,
            stone(format!("fitted, {of_new}"), &new.design, new.carats())?,
        ])
    }

    fn value(
        &self,
        path: &str,
        (old, new): (&Specimen, &Specimen),
        found: &Retargeted,
        light: &[MeasuredStone],
    ) -> Value {
        let stones = light.iter().map(|stone| {
            let MeasuredStone { label, measured, carats } = stone;
            let bands = measured.scope.bands.iter().zip(&measured.figures.transmitted);
            let zones: serde_json::Map<String, Value> =
                bands.map(|(band, light)| (band.name.clone(), json!(light))).collect();
            json!({
                "stone": label,
                "index": measured.index,
                "light_return": measured.light_return(),
                "glare_return": measured.glare_return(),
                "leakage": measured.leakage(),
                "transmitted": zones,
                "absorbed": measured.figures.absorbed,
                "error": measured.error(),
                "carats": carats,
            })
        });
        json!({
            "file": path,
            "name": found.design.name,
            "from": old.material.name,
            "to": new.material.name,
            "critical_deg": found.critical_deg,
            "main": found.main,
            "factor": found.factor,
            "tiers": found.tiers,
            "notes": found.notes,
            "wavelength_nm": (!light.is_empty()).then_some(self.wavelength),
            "light": stones.collect::<Vec<_>>(),
        })
    }

    fn table(
        &self,
        path: &str,
        (old, new): (&Specimen, &Specimen),
        found: &Retargeted,
        light: &[MeasuredStone],
    ) -> String {
        let [from, to] = found.critical_deg;
        let mut text =
            format!("{path}: {}, {} to {}\n", found.design.name, old.material.name, new.material.name);
        let _ = writeln!(text, "  {:<28}{from:.2} to {to:.2} deg", "critical angle");
        let _ = writeln!(text, "  {:<28}{}", "main tier", found.main);
        let _ = writeln!(text, "  {:<28}{:.4}", "its tangent ratio", found.factor);
        for note in &found.notes {
            let _ = writeln!(text, "  note: {note}");
        }
        let _ = write!(
            text,
            "\n  {:<18}{:>7}{:>11}{:>11}{:>10}",
            "tier", "facets", "from deg", "to deg", "margin"
        );
        for tier in &found.tiers {
            let margin = match tier.after_deg < 0.0 {
                true => fixed(-tier.after_deg - to, 2),
                false => String::new(),
            };
            let (name, facets, before, after) = (&tier.name, tier.facets, tier.before_deg, tier.after_deg);
            let _ = write!(text, "\n  {name:<18}{facets:>7}{before:>11.2}{after:>11.2}{margin:>10}");
        }
        if light.is_empty() {
            return text;
        }
        let _ = write!(text, "\n\n  light at {} nm, face up", self.wavelength);
        let _ = write!(text, "\n  {:<18}", "% of face");
        for stone in light {
            let _ = write!(text, "  {:>26}", stone.label);
        }
        let mut row = |name: &str, of: &dyn Fn(&MeasuredStone) -> String| {
            let columns: String = light.iter().map(|stone| format!("  {:>26}", of(stone))).collect();
            let _ = write!(text, "\n  {name:<18}{columns}");
        };
        let percent = |part: f64| format!("{:.2}", 100.0 * part);
        row("light return", &|stone| percent(stone.measured.light_return()));
        row("with glare", &|stone| percent(stone.measured.light_return() + stone.measured.glare_return()));
        let bands = &light[0].measured.scope.bands;
        for (place, band) in bands.iter().enumerate().rev() {
            row(&band.name, &|stone| percent(stone.measured.figures.transmitted[place]));
        }
        row("absorbed", &|stone| percent(stone.measured.figures.absorbed));
        row("error", &|stone| percent(stone.measured.error()));
        row("weight, ct", &|stone| stone.carats.map_or("not known".into(), |carats| format!("{carats:.3}")));
        if let Some(unknown) = [&old.material, &new.material].into_iter().find(|of| of.density.is_none()) {
            let _ = write!(
                text,
                "\n\n  no weight: no density is known of {}; a material by name has one, such as quartz",
                unknown.name
            );
        }
        text
    }
}
