//! `retarget`: fits a design to another material, and measures the light of both.

use super::comments;
use super::console::{print, print_json, say, written_beside};
use super::options::{checked_wavelength, extrapolation, number};
use super::specimen::{asked_material, note_colour};
use super::specimen_options::SizeOptions;
use brillianteer_base::Failure;
use brillianteer_cut::{
    Design, RetargetError, RetargetRule, Retargeted, RetargetedTier, ScaleError, retarget,
};
use brillianteer_files::design_file::{self, DesignFormat};
use brillianteer_measure::{LightShares, Measured};
use brillianteer_optics::line;
use brillianteer_paper::table::{Column, Table, TableCell};
use brillianteer_render::{MeasureError, MeasureOptions, measure};
use brillianteer_scene::Specimen;
use clap::{Args, ValueEnum};
use serde::Serialize;
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

/// A design that was fitted to another material, and the light of both.
#[derive(Serialize)]
struct RetargetResult<'a> {
    file: &'a str,
    /// The name of the design.
    name: &'a str,
    /// The name of the old material.
    from: &'a str,
    /// The name of the new material.
    to: &'a str,
    /// The critical angles of both in sodium light, degrees.
    critical_deg: [f64; 2],
    /// The name of the main tier.
    main: &'a str,
    /// The factor of the tangents of its angle.
    factor: f64,
    /// The tiers that changed.
    tiers: &'a [RetargetedTier],
    /// Notes on the method, in sentences.
    notes: &'a [String],
    /// The wavelength of the light, nm; `None` where none was measured.
    wavelength_nm: Option<f64>,
    /// The light of the old design in both materials, and of the new one.
    light: Vec<StoneLight<'a>>,
}

/// The light of one stone.
#[derive(Serialize)]
struct StoneLight<'a> {
    /// The words that say which stone it is.
    stone: &'a str,
    #[serde(flatten)]
    shares: LightShares,
    /// The weight; `None` where the material's density is not known.
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
        if self.json {
            print_json(&self.result(&path, (&specimen, &made), &found, &light))?
        } else {
            print(&self.table(&path, (&specimen, &made), &found, &light))?
        }
        if let (Some(out), Some(format)) = (&self.out, format) {
            let lost = design_file::write(&made, format, out)?;
            lost.iter().for_each(|what| say(&format!("note: {}: {what}", out.display())));
            written_beside(self.json, out)?;
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

    fn result<'a>(
        &self,
        path: &'a str,
        (old, new): (&'a Specimen, &'a Specimen),
        found: &'a Retargeted,
        light: &'a [MeasuredStone],
    ) -> RetargetResult<'a> {
        let stone = |stone: &'a MeasuredStone| StoneLight {
            stone: &stone.label,
            shares: stone.measured.shares(),
            carats: stone.carats,
        };
        RetargetResult {
            file: path,
            name: &found.design.name,
            from: &old.material.name,
            to: &new.material.name,
            critical_deg: found.critical_deg,
            main: &found.main,
            factor: found.factor,
            tiers: &found.tiers,
            notes: &found.notes,
            wavelength_nm: (!light.is_empty()).then_some(self.wavelength),
            light: light.iter().map(stone).collect(),
        }
    }

    fn table(
        &self,
        path: &str,
        (old, new): (&Specimen, &Specimen),
        found: &Retargeted,
        light: &[MeasuredStone],
    ) -> String {
        let [from, to] = found.critical_deg;
        let mut lines = Table::of_pairs();
        lines.pair("critical angle", format!("{from:.2} to {to:.2} deg"));
        lines.pair("main tier", found.main.as_str());
        lines.pair("its tangent ratio", format!("{:.4}", found.factor));
        found.notes.iter().for_each(|note| lines.line(&format!("  note: {note}")));
        let tiers = table_of_tiers(&found.tiers, to);
        let (name, old, new) = (&found.design.name, &old.material, &new.material);
        let mut text = format!("{path}: {name}, {} to {}\n{lines}\n\n{tiers}", old.name, new.name);
        if light.is_empty() {
            return text;
        }
        let _ = write!(text, "\n\n  light at {} nm, face up\n{}", self.wavelength, table_of_light(light));
        if let Some(unknown) = [old, new].into_iter().find(|of| of.density.is_none()) {
            let _ = write!(
                text,
                "\n\n  no weight: no density is known of {}; a material by name has one, such as quartz",
                unknown.name
            );
        }
        text
    }
}

/// Returns a table of the tiers that changed; `critical_deg` is the critical angle of the new material.
fn table_of_tiers(tiers: &[RetargetedTier], critical_deg: f64) -> Table {
    let degrees = |head: &'static str, width| Column::right(head, width).digits(2);
    let columns = [
        Column::left("tier", 18),
        Column::right("facets", 7),
        degrees("from deg", 11),
        degrees("to deg", 11),
        degrees("margin", 10),
    ];
    let mut table = Table::headed(columns).indented(2);
    for tier in tiers {
        let margin =
            if tier.after_deg < 0.0 { TableCell::Number(-tier.after_deg - critical_deg) } else { "".into() };
        let (before, after) = (tier.before_deg.into(), tier.after_deg.into());
        table.row([tier.name.as_str().into(), tier.facets.into(), before, after, margin]);
    }
    table
}

/// Returns a table with a column for each stone.
fn table_of_light(light: &[MeasuredStone]) -> Table {
    let of_stone = |stone: &MeasuredStone| Column::right(stone.label.clone(), 26).after(2).digits(2);
    let columns = std::iter::once(Column::left("% of face", 18)).chain(light.iter().map(of_stone));
    let mut table = Table::headed(columns.collect::<Vec<_>>()).indented(2);
    let mut row = |name: &str, of: &dyn Fn(&MeasuredStone) -> TableCell| {
        table.row(std::iter::once(name.into()).chain(light.iter().map(of)));
    };
    let percent = |part: f64| TableCell::Number(100.0 * part);
    row("light return", &|stone| percent(stone.measured.light_return()));
    row("with glare", &|stone| percent(stone.measured.light_return() + stone.measured.glare_return()));
    let bands = light.first().map_or(&[][..], |stone| &stone.measured.scope.bands);
    for (place, band) in bands.iter().enumerate().rev() {
        row(&band.name, &|stone| percent(stone.measured.figures.transmitted[place]));
    }
    row("absorbed", &|stone| percent(stone.measured.figures.absorbed));
    row("error", &|stone| percent(stone.measured.error()));
    row("weight, ct", &|stone| stone.carats.map_or("not known".into(), |ct| format!("{ct:.3}").into()));
    table
}
