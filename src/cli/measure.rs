//! `measure`: the figures of one view.

use super::options::{LightOptions, Tracer, ViewOptions};
use super::progress::Progress;
use super::sampler::{Sampler, Subject};
use super::specimen::Specimen;
use super::{Failure, each_file, json, print};
use crate::measure::{Figures, by_beams};
use crate::scene::{ASET_CONE, Backing, Band, Medium, Scope, View};
use crate::trace::beam;
use clap::Args;
use serde_json::{Map, Value, json};
use std::fmt::Write;
use std::path::PathBuf;
use std::time::Instant;

/// Where `measure` stops following beams when not told: face up a few hundredths of a second's work, tilted some
/// seconds.
const UNRESOLVED: f64 = 1.5e-4;

/// Rays along each side of one of the lattices that figures by rays are sampled on.
const LATTICE: u32 = 256;

#[derive(Debug, Args)]
pub struct Measure {
    /// Cut files, or names of cuts that come with the program
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Print JSON: one object, or for several files one a line
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    view: ViewOptions,
    #[command(flatten)]
    light: LightOptions,
}

/// Figures with all that says how they came about.
pub struct Measured {
    pub figures: Figures,
    pub scope: Scope,
    pub medium: Medium,
    pub view: View,
    pub sampler: Option<Sampler>,
    pub polarised: bool,
    pub seconds: f64,
}

impl Measure {
    pub fn run(&self) -> Result<(), Failure> {
        each_file(&self.files, |file| {
            let specimen = Specimen::load(file)?;
            let measured = measure(&specimen, &self.view, &self.light)?;
            if self.json {
                let value = measured.json(&specimen, &self.view, &self.light);
                return print(&if self.files.len() > 1 { value.to_string() } else { json(&value) });
            }
            print(&measured.table(&specimen, &self.view))
        })
    }
}

/// Measures a specimen's ASET zones in a view.
pub fn measure(specimen: &Specimen, view: &ViewOptions, light: &LightOptions) -> Result<Measured, Failure> {
    let scope = Scope::aset(ASET_CONE, Backing::Black).with_head(light.head()?);
    let seen = view.view(None)?;
    let medium = light.medium(specimen)?;
    let tracer = light.tracer(&seen, specimen)?;
    let progress = Progress::new(&format!("measuring {}", specimen.path));
    let watch = progress.watch();
    let polytope = &specimen.stone.polytope;
    let start = Instant::now();
    let mut sampler = None;
    let figures = match tracer {
        Tracer::Beams => {
            let options = light.beams(UNRESOLVED)?;
            let beams = beam::trace(polytope, medium, &seen, &options, &watch)?;
            light.warn_of_open(specimen, &beams, &options);
            by_beams(&beams, &scope)
        }
        Tracer::Rays(first) => first.or_rays(|used| {
            sampler = Some(used);
            let look = Subject { specimen, medium, view: &seen, scope: &scope };
            used.figures(look, light.rays(UNRESOLVED)?, LATTICE, &watch)
        })?,
    };
    let seconds = start.elapsed().as_secs_f64();
    Ok(Measured { figures, scope, medium, view: seen, sampler, polarised: !light.unpolarised, seconds })
}

impl Measured {
    /// The object that `measure --json` prints; numbers are fractions of the silhouette.
    pub fn json(&self, specimen: &Specimen, options: &ViewOptions, light: &LightOptions) -> Value {
        let figures = &self.figures;
        let mut strongest = self.zones(&figures.strongest_exit_area);
        strongest.insert("undecided".into(), json!(figures.strongest_exit_undecided));
        let mut value = json!({
            "file": specimen.path,
            "name": specimen.design.name,
            "silhouette_area": figures.silhouette_area,
            "surface": self.zones(&figures.surface),
            "transmitted": self.zones(&figures.transmitted),
            "strongest_exit_area": strongest,
            "absorbed": figures.absorbed,
            "unresolved": figures.unresolved,
            "beams": figures.beams,
            "seconds": self.seconds,
            "index": self.medium.index,
            "wavelength_nm": light.index.is_none().then(|| light.wavelength()),
            "head_deg": light.head,
            "tracer": self.sampler.map_or("beam", |s| s.name()),
            "polarised": self.polarised,
            "view": options.json(&self.view),
        });
        if self.sampler.is_some() {
            value["standard_error"] = json!(figures.standard_error);
        }
        value
    }

    /// Bands by name, those of the ASET always there.
    fn zones(&self, values: &[f64]) -> Map<String, Value> {
        let mut zones: Map<String, Value> = ["green", "red", "blue", "below"]
            .map(|name| (name.to_string(), json!(0.0)))
            .into_iter()
            .collect();
        zones.extend(self.scope.bands.iter().zip(values).map(|(b, v)| (b.name.clone(), json!(v))));
        zones
    }

    /// A table for people, in percent of the silhouette.
    fn table(&self, specimen: &Specimen, view: &ViewOptions) -> String {
        let f = &self.figures;
        let mut text = format!(
            "{}: {}, index {:.4}, {}\n\n{:<12}{:>12}{:>12}{:>12}\n",
            specimen.path,
            specimen.design.name,
            self.medium.index,
            view.told(&self.view),
            "% of face",
            "glare",
            "transmitted",
            "strongest"
        );
        let mut line = |name: &str, values: [f64; 3]| {
            let [a, b, c] = values.map(|v| 100.0 * v);
            let _ = writeln!(text, "{name:<12}{a:>12.3}{b:>12.3}{c:>12.3}");
        };
        for (i, band) in self.scope.bands.iter().enumerate().rev() {
            line(&band.name, [f.surface[i], f.transmitted[i], f.strongest_exit_area[i]]);
        }
        line("undecided", [0.0, 0.0, f.strongest_exit_undecided]);
        let sum = |zones: &[f64]| zones.iter().sum::<f64>();
        line(
            "sum",
            [sum(&f.surface), sum(&f.transmitted), sum(&f.strongest_exit_area) + f.strongest_exit_undecided],
        );
        let lit = |(i, band): &(usize, &Band)| *i > 0 && band.name != "head";
        let bands = self.scope.bands.iter().enumerate().filter(lit);
        let returned: f64 = bands.map(|(i, _)| f.surface[i] + f.transmitted[i]).sum();
        let _ = write!(
            text,
            "\nlight from above the horizon {:.3} %, absorbed {:.3} %, unresolved {:.3} %{}\n{} by {} {} in {:.3} s",
            100.0 * returned,
            100.0 * f.absorbed,
            100.0 * f.unresolved,
            match self.sampler {
                None => " (the most by which any light is too low)".to_string(),
                Some(_) => format!(", standard error {:.3} %", 100.0 * f.standard_error),
            },
            if self.polarised { "polarised," } else { "unpolarised," },
            f.beams,
            self.sampler.map_or_else(|| "exact beams".into(), |s| s.told()),
            self.seconds,
        );
        text
    }
}
