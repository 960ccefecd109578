//! `convert`: a stone's design in another format.

use super::specimen::Specimen;
use super::{Failure, say};
use crate::cut::from_mesh::Up;
use crate::io::design_file::{self, Format};
use clap::{Args, ValueEnum};
use glam::DVec3;
use std::path::PathBuf;

/// An axis of a mesh's frame.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Axis {
    X,
    Y,
    Z,
    #[value(name = "-x")]
    MinusX,
    #[value(name = "-y")]
    MinusY,
    #[value(name = "-z")]
    MinusZ,
}

impl Axis {
    fn up(self) -> Up {
        Up::Given(match self {
            Self::X => DVec3::X,
            Self::Y => DVec3::Y,
            Self::Z => DVec3::Z,
            Self::MinusX => DVec3::NEG_X,
            Self::MinusY => DVec3::NEG_Y,
            Self::MinusZ => DVec3::NEG_Z,
        })
    }
}

#[derive(Debug, Args)]
pub struct Convert {
    /// Which way the table of a mesh faces, in its own frame [default: as found]
    #[arg(long, value_name = "AXIS", value_enum)]
    up: Option<Axis>,
    /// A file of a design or a mesh, or the name of a cut that comes with the program
    input: PathBuf,
    /// The file to write; its ending names the format: .toml, .asc, .gem, .gcs, .obj, .stl or .glb
    output: PathBuf,
}

impl Convert {
    pub fn run(&self) -> Result<(), Failure> {
        let format = Format::of_name(&self.output).ok_or_else(|| {
            let endings: Vec<String> =
                Format::ALL.iter().map(|format| format!(".{}", format.ending())).collect();
            let output = self.output.display();
            Failure::Usage(format!(
                "{output}: the ending names no format; give one of {}",
                endings.join(", ")
            ))
        })?;
        let specimen = match self.up {
            Some(axis) => Specimen::read(&self.input, axis.up())?,
            None => Specimen::load(&self.input)?,
        };
        let lost = design_file::write(&specimen, format, &self.output)?;
        for what in lost {
            say(&format!("note: {}: {what}", self.output.display()));
        }
        Ok(())
    }
}
