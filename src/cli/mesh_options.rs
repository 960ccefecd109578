//! The options of every command that reads meshes.

use super::choice::{MESH_FORMS, name_of, one_of};
use brillianteer_cut::Size;
use brillianteer_cut::from_mesh::{Evening, Up};
use brillianteer_files::mesh_options::{MeshForm, MeshOptions, MeshPart, MeshUnit};
use clap::Args;
use glam::DVec3;

/// The options by which meshes are read. Other files of designs state the direction and the form themselves.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Meshes")]
pub struct MeshArguments {
    /// The direction in which the table of a mesh faces, in its own frame: x, -x, y, -y, z, -z, or X,Y,Z [default: as found]
    #[arg(long, value_name = "DIRECTION", value_parser = direction, allow_hyphen_values = true)]
    up: Option<Up>,
    /// The form in which the triangles of a mesh are read [default: as found]
    #[arg(long = "as", value_name = "FORM", value_parser = one_of(&MESH_FORMS))]
    form: Option<MeshForm>,
    /// The unit of a mesh: mm, cm, m, in, um, or its length, such as 0.5mm [default: as the file states, m in glTF, else mm]
    #[arg(long, value_name = "UNIT", allow_hyphen_values = true)]
    unit: Option<MeshUnit>,
    /// The solid that is read of a mesh that has several: its number, its name, or all [default: the largest]
    #[arg(long, value_name = "PART", value_parser = part)]
    part: Option<MeshPart>,
    /// Keep the facets of a mesh as they are found. Otherwise a mesh that is symmetric except for its noise becomes a stone that is
    /// exactly symmetric, with a note
    #[arg(long)]
    as_found: bool,
}

impl MeshArguments {
    /// Returns the mesh options, with defaults for those that are not given.
    pub fn options(&self) -> MeshOptions {
        let Self { up, form, unit, part, as_found } = self;
        MeshOptions {
            up: up.unwrap_or_default(),
            form: form.unwrap_or_default(),
            unit: unit.unwrap_or_default(),
            part: part.clone().unwrap_or_default(),
            evening: if *as_found { Evening::AsFound } else { Evening::WhereLikely },
        }
    }

    /// Returns the mesh options for a stone of this size, if it is given.
    pub fn sized(&self, size: Option<Size>) -> MeshOptions {
        self.options().sized(size)
    }

    /// Returns the options as command-line words, with numbers in a fixed form.
    pub fn words(&self) -> Vec<String> {
        let up = self.up.and_then(|up| match up {
            Up::Given(direction) => Some(direction.to_array().map(|part| (part + 0.0).to_string()).join(",")),
            _ => None,
        });
        let form = self.form.and_then(|form| name_of(&MESH_FORMS, form)).map(str::to_owned);
        let words = |option: &str, value: Option<String>| value.map(|value| [option.to_owned(), value]);
        let [unit, part] =
            [self.unit.map(|unit| unit.to_string()), self.part.as_ref().map(MeshPart::to_string)];
        let all = [words("--up", up), words("--as", form), words("--unit", unit), words("--part", part)];
        let as_found = self.as_found.then(|| "--as-found".to_owned());
        all.into_iter().flatten().flatten().chain(as_found).collect()
    }
}

/// Parses the value of `--part`; any text may be a name.
fn part(text: &str) -> Result<MeshPart, String> {
    match MeshPart::from(text) {
        MeshPart::Found => Err("give the number or the name of a body, or all".to_owned()),
        part => Ok(part),
    }
}

/// Parses the value of `--up`: a signed axis, or three numbers separated by commas that are not all 0.
fn direction(text: &str) -> Result<Up, String> {
    let (sign, name) = text.strip_prefix('-').map_or((1.0, text), |name| (-1.0, name));
    if let Some(axis) = ["x", "y", "z"].iter().position(|axis| *axis == name) {
        return Ok(Up::Given(sign * DVec3::AXES[axis]));
    }
    let numbers: Option<Vec<f64>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    let vector = numbers.filter(|numbers| numbers.len() == 3).map(|numbers| DVec3::from_slice(&numbers));
    match vector.filter(|vector| vector.is_finite() && *vector != DVec3::ZERO) {
        Some(vector) => Ok(Up::Given(vector)),
        None => {
            Err("give x, -x, y, -y, z, -z, or three numbers that are not all 0, such as 0,0.6,0.8".to_owned())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Debug, Parser)]
    struct Command {
        #[command(flatten)]
        mesh: MeshArguments,
    }

    fn up(arguments: &[&str]) -> Result<Up, String> {
        let given = std::iter::once(&"b").chain(arguments);
        Command::try_parse_from(given).map(|c| c.mesh.options().up).map_err(|e| e.to_string())
    }

    #[test]
    fn a_direction_is_an_axis_or_three_numbers_and_may_begin_with_a_minus() {
        for (text, expected) in [
            ("z", DVec3::Z),
            ("-z", DVec3::NEG_Z),
            ("-x", DVec3::NEG_X),
            ("0,0.6,-0.8", DVec3::new(0.0, 0.6, -0.8)),
            ("-1, 2,3e-1", DVec3::new(-1.0, 2.0, 0.3)),
        ] {
            assert_eq!(up(&["--up", text]), Ok(Up::Given(expected)), "{text}");
            assert_eq!(up(&[&format!("--up={text}")]), Ok(Up::Given(expected)), "{text}");
        }
        assert_eq!(up(&[]), Ok(Up::Found));
        for bad in ["w", "--z", "1,2", "0,0,0", "1,nan,0", "1,2,3,4", ""] {
            let message = up(&[&format!("--up={bad}")]).unwrap_err();
            assert!(message.contains("give x, -x, y, -y, z, -z, or three numbers"), "{bad}: {message}");
        }
    }

    #[test]
    fn a_part_is_a_number_a_name_or_all() {
        let given = |text: &str| Command::try_parse_from(["b", "--part", text]).map(|c| c.mesh);
        for (text, part) in [
            ("2", MeshPart::Number(2)),
            ("all", MeshPart::All),
            ("Stone 1", MeshPart::Named("Stone 1".into())),
        ] {
            let mesh = given(text).unwrap();
            assert_eq!(mesh.options().part, part);
            assert_eq!(mesh.words(), ["--part", text]);
        }
        assert!(given("").unwrap_err().to_string().contains("the number or the name of a body, or all"));
    }
}
