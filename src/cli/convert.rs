//! `convert`: writes a stone's design in another format, or the bodies of a scene as a mesh.

use super::choice::{DESIGN_FORMATS, one_of};
use super::comments;
use super::console::{say, written};
use super::meets::MeetList;
use super::specimen::LoadedSpecimen;
use super::specimen_options::SpecimenOptions;
use brillianteer_base::Failure;
use brillianteer_cut::{Cut, Design};
use brillianteer_files::assembly::Assembly;
use brillianteer_files::bodies_scene::BodiesScene;
use brillianteer_files::design_file::{self, DesignFormat};
use brillianteer_files::{WriteError, is_standard, scene_file, scene_mesh, write};
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub struct Convert {
    /// A file of a design, a mesh or a scene, or the name of a cut or a scene that comes with the program. Of a scene its stones and
    /// its metal are written where they lie, as .obj, .stl, .ply or .glb
    input: PathBuf,
    /// The file to write; its ending names the format: .toml, .asc, .gem, .gcs, .obj, .stl, .ply or .glb. `-` is standard output
    /// and needs --format
    output: PathBuf,
    /// The format to write, whatever the ending
    #[arg(long, value_parser = one_of(&DESIGN_FORMATS))]
    format: Option<DesignFormat>,
    /// Follow the meets of tiers: keep those that the file gives, that its instructions state and that the geometry shows, and
    /// move each tier to the distance that follows. A cut by proportions is turned into tiers first, named P1, G1, C1, T
    #[arg(long)]
    meets: bool,
    /// Write a scene of all bodies of a mesh instead, each where it lies in the file
    #[arg(long, conflicts_with_all = ["stone", "form", "part", "as_found", "meets", "format"])]
    scene: bool,
    /// Write over the file that is read even if its comments are lost
    #[arg(long)]
    drop_comments: bool,
    #[command(flatten)]
    specimen: SpecimenOptions,
}

impl Convert {
    pub fn run(&self) -> Result<(), Failure> {
        if self.scene {
            return self.write_scene();
        }
        let format = self.format.or_else(|| DesignFormat::of_name(&self.output)).ok_or_else(|| {
            let endings: Vec<String> =
                DesignFormat::ALL.iter().map(|format| format!(".{}", format.ending())).collect();
            let output = self.output.display();
            Failure::Usage(format!(
                "{output}: the ending names no format; give one of {}, or --format",
                endings.join(", ")
            ))
        })?;
        comments::keep_mesh(&self.input, &self.output)?;
        if !self.drop_comments {
            comments::keep(&self.input, &self.output, "give another name, or --drop-comments")?;
        }
        let lost = match self.scene_of_input()? {
            Some(scene) => scene_mesh::write(&scene, format, &self.output)?,
            None => {
                let specimen = self.specimen.load(&self.input)?;
                let specimen = if self.meets { followed(specimen)? } else { specimen };
                design_file::write(&specimen, format, &self.output)?
            }
        };
        for what in lost {
            say(&format!("note: {}: {what}", self.output.display()));
        }
        written(&self.output)
    }
}

impl Convert {
    /// Returns the scene that is read; `None` where the input is a stone, or has to be one.
    fn scene_of_input(&self) -> Result<Option<Assembly>, Failure> {
        if self.meets { Ok(None) } else { self.specimen.load_scene(&self.input) }
    }

    fn write_scene(&self) -> Result<(), Failure> {
        let output = self.output.display();
        let is_toml = DesignFormat::of_name(&self.output) == Some(DesignFormat::Toml);
        if !is_toml && !is_standard(&self.output) {
            return Err(Failure::Usage(format!(
                "{output}: --scene writes a scene file; give a name that ends in .toml"
            )));
        }
        let folder = self.output.parent().unwrap_or(Path::new(""));
        let BodiesScene { scene, warnings } = self.specimen.scene_of_bodies(&self.input, folder)?;
        let path = self.input.display();
        warnings.iter().for_each(|warning| say(&format!("warning: {path}: {warning}")));
        let text = scene_file::write(&scene);
        write(&self.output, |file| {
            file.write_all(text.as_bytes()).map_err(|e| WriteError::io(&self.output, e))
        })?;
        written(&self.output)
    }
}

/// Returns the stone with its tiers at the distances that follow from their meets.
fn followed(specimen: LoadedSpecimen) -> Result<LoadedSpecimen, Failure> {
    let LoadedSpecimen { path, made, errors, bodies, remarks } = specimen;
    let Some(meets) = MeetList::of(&made) else {
        let why = made.why_not_convex().unwrap_or_default();
        return Err(Failure::Input(format!(
            "{path}: --meets follows the meets of tiers, which cut convex stones between planes, and {why}; leave the option out"
        )));
    };
    meets.say_turned(&path);
    let cut = Cut::Tiers(meets.followed(&path));
    let design = made.design.clone();
    let made = made.remade(Design { cut, ..design });
    match made {
        Ok(made) => Ok(LoadedSpecimen { path, made, errors, bodies, remarks }),
        Err(error) => Err(Failure::Input(format!("{path}: with its meets: {error}"))),
    }
}
