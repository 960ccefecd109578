//! The options by which every command reads the stone of a file: as the file has it, or in another material and size.

use super::console::say;
use super::mesh_options::MeshArguments;
use super::progress::while_reading;
use super::specimen::{LoadedSpecimen, asked_material, note_readings};
use brillianteer_base::Failure;
use brillianteer_cut::{MaterialRef, Size};
use brillianteer_files::assembly::Assembly;
use brillianteer_files::bodies_scene::{BodiesScene, scene_of_bodies};
use clap::Args;
use std::path::Path;

/// The size of a stone, and how meshes are read.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Stone")]
pub struct SizeOptions {
    /// The stone's size, such as 6.5mm or 1.2ct, instead of the file's; of a scene, for every stone
    #[arg(id = "stone", long, value_name = "SIZE", allow_hyphen_values = true)]
    pub size: Option<Size>,
    #[command(flatten)]
    mesh: MeshArguments,
}

impl SizeOptions {
    /// Reads a design, in its own material.
    ///
    /// # Errors
    /// Fails where [`LoadedSpecimen::load`] does, and where the size is none for the stone.
    pub fn load(&self, file: &Path) -> Result<LoadedSpecimen, Failure> {
        LoadedSpecimen::load(file, &self.mesh.sized(self.size))?.made_of(None, self.size)
    }
}

/// The material and the size of a stone, and how meshes are read.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Stone")]
pub struct SpecimenOptions {
    /// A material's name, or an index, instead of the file's; of a scene, for every stone
    #[arg(long, value_name = "MATERIAL")]
    pub material: Option<String>,
    #[command(flatten)]
    pub sized: SizeOptions,
}

impl SpecimenOptions {
    /// Reads a design.
    ///
    /// # Errors
    /// Fails where [`LoadedSpecimen::load`] does, where the material is not known, and where the size is none for the stone.
    pub fn load(&self, file: &Path) -> Result<LoadedSpecimen, Failure> {
        let SizeOptions { size, mesh } = &self.sized;
        LoadedSpecimen::load(file, &mesh.sized(*size))?.made_of(self.material.as_deref(), *size)
    }

    /// Reads a design for work in which only its shape and its material matter.
    ///
    /// # Errors
    /// Fails where [`load`](Self::load) does.
    pub fn load_shape(&self, file: &Path) -> Result<LoadedSpecimen, Failure> {
        let mesh = self.sized.mesh.options().of_any_size();
        LoadedSpecimen::load(file, &mesh)?.made_of(self.material.as_deref(), None)
    }

    /// Loads the stones and the metal of a file or a name, and prints notes and warnings about them.
    ///
    /// # Errors
    /// Fails where [`Assembly::load`] does, and where the material is not known.
    pub fn load_assembly(&self, file: &Path) -> Result<Assembly, Failure> {
        let material = self.named_material()?;
        let SizeOptions { size, mesh } = &self.sized;
        let load = || Assembly::load(file, material.as_ref(), *size, &mesh.sized(*size));
        let assembly = while_reading(file, load)?;
        note_remarks(&assembly);
        Ok(assembly)
    }

    /// Loads a scene as [`load_assembly`](Self::load_assembly) does; `None` where the file or the name is no scene.
    ///
    /// # Errors
    /// Fails where [`load_assembly`](Self::load_assembly) does.
    pub fn load_scene(&self, file: &Path) -> Result<Option<Assembly>, Failure> {
        let material = self.named_material()?;
        let SizeOptions { size, mesh } = &self.sized;
        let load = || Assembly::load_scene(file, material.as_ref(), *size, &mesh.sized(*size));
        let scene = while_reading(file, load)?;
        scene.iter().for_each(note_remarks);
        Ok(scene)
    }

    /// Makes a scene of the bodies of a mesh, to be written into a folder.
    ///
    /// # Errors
    /// Fails where [`scene_of_bodies`] does, and where the material is not known.
    pub fn scene_of_bodies(&self, file: &Path, folder: &Path) -> Result<BodiesScene, Failure> {
        let options = self.sized.mesh.options();
        let material = self.named_material()?;
        Ok(while_reading(file, || scene_of_bodies(file, folder, &options, material.as_ref()))?)
    }

    fn named_material(&self) -> Result<Option<MaterialRef>, Failure> {
        self.material.as_deref().map(|text| asked_material(text).map(|(named, _)| named)).transpose()
    }

    /// Returns the options as command-line words, with numbers in a fixed form.
    pub fn words(&self) -> Vec<String> {
        let SizeOptions { size, mesh } = &self.sized;
        let material = self.material.iter().flat_map(|text| ["--material".to_owned(), text.clone()]);
        let size = size.iter().flat_map(|size| ["--stone".to_owned(), size.to_string().replace(' ', "")]);
        material.chain(size).chain(mesh.words()).collect()
    }
}

/// Prints notes and warnings about the files of stones and metal.
fn note_remarks(assembly: &Assembly) {
    assembly.remarks.iter().for_each(|remark| say(remark));
    assembly.other_readings.iter().for_each(note_readings);
}

#[cfg(test)]
mod tests {
    use super::super::Arguments;
    use clap::CommandFactory;

    /// The options of a stone, of which the editor takes those of meshes alone, and `retarget` makes the material its aim.
    const ALL: [&str; 7] = ["material", "stone", "up", "as", "unit", "part", "as-found"];

    #[test]
    fn every_command_that_reads_a_mesh_has_the_same_options_for_it() {
        let line = Arguments::command();
        let options = |command: &clap::Command| -> Vec<String> {
            command.get_arguments().filter_map(|argument| argument.get_long().map(str::to_owned)).collect()
        };
        let mut count = 0;
        for command in line.get_subcommands() {
            let options = options(command);
            let is_there = |option: &&str| options.iter().any(|own| own == option);
            if !ALL.iter().any(is_there) {
                continue;
            }
            count += 1;
            let wanted = if command.get_name() == "edit" { &ALL[2..] } else { &ALL };
            let missing: Vec<&&str> = wanted.iter().filter(|option| !is_there(option)).collect();
            assert!(missing.is_empty(), "{}: {missing:?}", command.get_name());
        }
        assert!(count > 10, "{count}");
    }
}
