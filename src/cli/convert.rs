//! `convert`: writes a stone's design in another format.

use super::console::say;
use super::mesh_options::MeshArguments;
use super::specimen::LoadedSpecimen;
use crate::io::Failure;
use crate::io::design_file::{self, DesignFormat};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct Convert {
    /// A file of a design or a mesh, or the name of a cut that comes with the program
    input: PathBuf,
    /// The file to write; its ending names the format: .toml, .asc, .gem, .gcs, .obj, .stl, .ply or .glb. `-` is standard output
    /// and needs --format
    output: PathBuf,
    /// The format to write, whatever the ending
    #[arg(long, value_enum)]
    format: Option<DesignFormat>,
    #[command(flatten)]
    mesh: MeshArguments,
}

impl Convert {
    pub fn run(&self) -> Result<(), Failure> {
        let format = self.format.or_else(|| DesignFormat::of_name(&self.output)).ok_or_else(|| {
            let endings: Vec<String> =
                DesignFormat::ALL.iter().map(|format| format!(".{}", format.ending())).collect();
            let output = self.output.display();
            Failure::Usage(format!(
                "{output}: the ending names no format; give one of {}, or --format",
                endings.join(", ")
            ))
        })?;
        let specimen = LoadedSpecimen::load(&self.input, self.mesh.options())?;
        let lost = design_file::write(&specimen, format, &self.output)?;
        for what in lost {
            say(&format!("note: {}: {what}", self.output.display()));
        }
        Ok(())
    }
}
