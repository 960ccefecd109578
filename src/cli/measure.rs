//! `measure`: prints the figures of one view.

use super::batch::each_file;
use super::console::{json, print};
use super::mesh_options::MeshArguments;
use super::options::{LightOptions, ViewOptions, scoped};
use super::progress::WorkProgress;
use crate::io::Failure;
use crate::io::export::{FigureReport, measure};
use crate::picture::Scoped;
use crate::render::{Card, Renderer};
use crate::scene::Glare;
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct Measure {
    /// Designs or meshes, or names of cuts that come with the program
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Print JSON: one object, or for several files one object a line
    #[arg(long)]
    json: bool,
    /// The scope whose zones are measured: a scope's name (see `scopes`), or a scope file [default: aset]
    #[arg(long, value_name = "SCOPE")]
    scope: Option<PathBuf>,
    /// Print how long it took, which differs from run to run
    #[arg(long)]
    timing: bool,
    #[command(flatten)]
    view: ViewOptions,
    #[command(flatten)]
    light: LightOptions,
    #[command(flatten)]
    mesh: MeshArguments,
}

impl Measure {
    pub fn run(&self) -> Result<(), Failure> {
        let scoped = self.scope.as_deref().map_or_else(|| Ok(Scoped::aset()), scoped)?;
        each_file(&self.files, |file| {
            let specimen = self.light.specimen(file, self.mesh.options())?;
            let mut renderer = Renderer::new(Card::Machine);
            let viewing = self.light.viewing(&specimen, &self.view, &renderer)?;
            let report = {
                let progress = WorkProgress::new(&format!("measuring {}", specimen.path));
                measure(&viewing, &scoped, &mut renderer, &progress.watch(), &|event| progress.report(event))?
            };
            if self.json {
                let value = report.json(self.timing);
                return print(&if self.files.len() > 1 { value.to_string() } else { json(&value) });
            }
            print(&table(&report, self.timing))
        })
    }
}

/// Formats the figures as a table, in percent of the silhouette.
fn table(report: &FigureReport, timing: bool) -> String {
    let FigureReport { viewing, measured, .. } = report;
    let (f, scope) = (&measured.figures, &measured.scope);
    let has_glare = viewing.glare != Some(Glare::LeftOut);
    let mut text = format!(
        "{}: {}, {}, index {:.4}, {}, in {}\n\n",
        viewing.file,
        viewing.specimen.design.name,
        viewing.specimen.material.name,
        viewing.medium.index,
        viewing.viewpoint.description(),
        scope.name,
    );
    let mut line = |name: &str, [glare, rest @ ..]: [String; 3]| {
        let columns = Some(glare).filter(|_| has_glare).into_iter().chain(rest);
        let columns: String = columns.map(|column| format!("{column:>12}")).collect();
        let _ = writeln!(text, "{name:<12}{columns}");
    };
    line("% of face", ["glare", "transmitted", "strongest"].map(String::from));
    let mut row = |name: &str, values: [f64; 3]| line(name, values.map(|v| format!("{:.3}", 100.0 * v)));
    for (i, band) in scope.bands.iter().enumerate().rev() {
        row(&band.name, [f.surface[i], f.transmitted[i], f.strongest_exit_area[i]]);
    }
    row("undecided", [0.0, 0.0, f.strongest_exit_undecided]);
    let sum = |zones: &[f64]| zones.iter().sum::<f64>();
    row(
        "sum",
        [sum(&f.surface), sum(&f.transmitted), sum(&f.strongest_exit_area) + f.strongest_exit_undecided],
    );
    let (returned, glare) = (measured.light_return(), measured.glare_return());
    let glare = match has_glare {
        true => format!("with glare {:.3} %", 100.0 * (returned + glare)),
        false => format!("glare of {:.3} % is left out", 100.0 * measured.glare()),
    };
    let _ = write!(
        text,
        "\nlight return {:.3} %, {glare}, absorbed {:.3} %, unresolved {:.3} %{}\n{} by {} {}",
        100.0 * returned,
        100.0 * f.absorbed,
        100.0 * f.unresolved,
        match report.backend.is_beams() {
            true => " (the most by which any light is too low)".to_string(),
            false => format!(", standard error {:.3} %", 100.0 * f.standard_error),
        },
        if viewing.polarised { "polarised," } else { "unpolarised," },
        f.beams,
        report.backend.description(),
    );
    if timing {
        let _ = write!(text, " in {:.3} s", report.seconds);
    }
    text
}
