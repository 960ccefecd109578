//! The options of every command that reads meshes.

use crate::cut::from_mesh::Up;
use crate::io::mesh_options::{MeshForm, MeshOptions};
use clap::{Args, ValueEnum};
use glam::DVec3;

/// How meshes are read. Other designs say both themselves.
#[derive(Debug, Clone, Copy, Default, Args)]
#[command(next_help_heading = "Meshes")]
pub struct MeshArguments {
    /// The direction in which the table of a mesh faces, in its own frame [default: as found]
    #[arg(long, value_name = "AXIS", value_enum, allow_hyphen_values = true)]
    up: Option<Axis>,
    /// What the triangles of a mesh stand for [default: as found]
    #[arg(long = "as", value_name = "FORM", value_enum)]
    form: Option<Form>,
}

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

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Form {
    /// The flat facets of a convex stone, which exact beams, scopes and drawings need
    Faceted,
    /// The triangles themselves, which rays trace
    Triangles,
}

impl MeshArguments {
    /// The options that were given.
    pub fn options(self) -> MeshOptions {
        MeshOptions {
            up: self.up.map_or(Up::Found, Axis::up),
            form: match self.form {
                None => MeshForm::Found,
                Some(Form::Faceted) => MeshForm::Faceted,
                Some(Form::Triangles) => MeshForm::Triangles,
            },
        }
    }
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
