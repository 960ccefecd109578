//! `measure`: the figures of one view.

use super::mesh_options::MeshArguments;
use super::options::{LightOptions, ViewOptions};
use super::progress::Progress;
use super::specimen::Specimen;
use super::{Failure, each_file, json, print};
use crate::io::export::{Measured, measure};
use crate::scene::Band;
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct Measure {
    /// Designs or meshes, or names of cuts that come with the program
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Print JSON: one object, or for several files one a line
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    view: ViewOptions,
    #[command(flatten)]
    light: LightOptions,
    #[command(flatten)]
    mesh: MeshArguments,
}

impl Measure {
    pub fn run(&self) -> Result<(), Failure> {
        each_file(&self.files, |file| {
            let specimen = Specimen::load(file, self.mesh.options())?;
            let viewing = self.light.viewing(&specimen, &self.view)?;
            let measured = {
                let progress = Progress::new(&format!("measuring {}", specimen.path));
                measure(&viewing, &progress.watch(), &|told| progress.tell(told))?
            };
            if self.json {
                let value = measured.json();
                return print(&if self.files.len() > 1 { value.to_string() } else { json(&value) });
            }
            print(&table(&measured))
        })
    }
}

/// A table for people, in percent of the silhouette.
fn table(measured: &Measured) -> String {
    let Measured { viewing, figures: f, .. } = measured;
    let mut text = format!(
        "{}: {}, index {:.4}, {}\n\n{:<12}{:>12}{:>12}{:>12}\n",
        viewing.file,
        viewing.specimen.design.name,
        viewing.medium.index,
        viewing.viewpoint.told(),
        "% of face",
        "glare",
        "transmitted",
        "strongest"
    );
    let mut line = |name: &str, values: [f64; 3]| {
        let [a, b, c] = values.map(|v| 100.0 * v);
        let _ = writeln!(text, "{name:<12}{a:>12.3}{b:>12.3}{c:>12.3}");
    };
    for (i, band) in measured.scope.bands.iter().enumerate().rev() {
        line(&band.name, [f.surface[i], f.transmitted[i], f.strongest_exit_area[i]]);
    }
    line("undecided", [0.0, 0.0, f.strongest_exit_undecided]);
    let sum = |zones: &[f64]| zones.iter().sum::<f64>();
    line(
        "sum",
        [sum(&f.surface), sum(&f.transmitted), sum(&f.strongest_exit_area) + f.strongest_exit_undecided],
    );
    let lit = |(i, band): &(usize, &Band)| *i > 0 && band.name != "head";
    let bands = measured.scope.bands.iter().enumerate().filter(lit);
    let returned: f64 = bands.map(|(i, _)| f.surface[i] + f.transmitted[i]).sum();
    let _ = write!(
        text,
        "\nlight from above the horizon {:.3} %, absorbed {:.3} %, unresolved {:.3} %{}\n{} by {} {} in {:.3} s",
        100.0 * returned,
        100.0 * f.absorbed,
        100.0 * f.unresolved,
        match measured.sampler {
            None => " (the most by which any light is too low)".to_string(),
            Some(_) => format!(", standard error {:.3} %", 100.0 * f.standard_error),
        },
        if viewing.polarised { "polarised," } else { "unpolarised," },
        f.beams,
        measured.sampler.map_or_else(|| "exact beams".into(), |s| s.told()),
        measured.seconds,
    );
    text
}
