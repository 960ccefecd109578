//! Decides the direction and the size of a mesh's stone: by the user's options, by the file's own statement, or by
//! its shape.

use super::file::{MeshFormat, Stands, Statement};
use super::size::MeshSize;
use crate::mesh_options::{MeshOptions, MeshUnit};
use brillianteer_base::Fault;
use brillianteer_cut::MaterialRef;
use brillianteer_cut::from_mesh::Up;
use brillianteer_math::{Pose, Surface};
use glam::DVec3;

/// A direction this near to an axis (length of the difference) goes by the axis's name.
const ON_AXIS: f64 = 1e-4;

/// Sizes that differ by less than this part count as the same.
const SAME_SIZE: f64 = 2e-3;

/// Notes and warnings on how a mesh was understood.
#[derive(Debug, Default)]
pub(super) struct MeshRemarks {
    pub notes: Vec<String>,
    pub warnings: Vec<String>,
    /// True where the table may face another way than the direction that was taken.
    pub is_doubtful: bool,
    /// True where notes say how else the mesh may be read.
    pub has_other_reading: bool,
}

/// The known direction and size of a stone before its shape is examined.
#[derive(Debug)]
pub(super) struct MeshPlace {
    given: Up,
    format: MeshFormat,
    unit: MeshUnit,
    statement: Option<Statement>,
    /// Girdle radii per unit of the file; `None` where they are unknown.
    pub scale: Option<f64>,
    /// The girdle diameter in mm; `None` where the file states none, or where its unit is given instead.
    pub diameter_mm: Option<f64>,
    /// The stone's material; `None` where the file names none.
    pub material: Option<MaterialRef>,
}

impl MeshPlace {
    /// Starts from a file's format. A direction up and a unit that a person gives count above all else.
    pub fn of(format: MeshFormat, options: &MeshOptions, statement: Option<Statement>) -> Self {
        let given = match options.up {
            Up::Found => Up::FoundBy(usual_up(format)),
            other => other,
        };
        Self { given, format, unit: options.unit, statement, scale: None, diameter_mm: None, material: None }
    }

    /// Returns the girdle diameter, mm, of a stone whose girdle has so many radii per unit of the file, with a note where the
    /// size was assumed.
    ///
    /// # Errors
    /// Fails where the given unit leads to a diameter that no stone may have.
    pub fn diameter_mm(&self, scale: f64, remarks: &mut MeshRemarks) -> Result<f64, Fault> {
        if let Some(known) = self.diameter_mm {
            return Ok(known);
        }
        let MeshSize { diameter_mm, note } = MeshSize::of(2.0 / scale, self.unit, self.format)?;
        remarks.notes.extend(note);
        Ok(diameter_mm)
    }

    /// Returns which way is up in the file's surface: the direction of the file's statement where that fits the
    /// shape. `directions` are those in which the table may face.
    pub fn up(
        &mut self,
        surface: &Surface,
        directions: impl Fn() -> Vec<DVec3>,
        remarks: &mut MeshRemarks,
    ) -> Up {
        let Some(statement) = self.statement.take() else { return self.given };
        let stands = statement.of_solid(surface, std::iter::once_with(directions).flatten());
        if stands == Stands::Otherwise {
            remarks.warnings.push(format!(
                "the file says that {} is up and that the stone is {} mm across, but its shape has changed since \
                    that was written; both are ignored",
                axis(statement.up),
                statement.diameter_mm
            ));
            return self.given;
        }
        let is_size_kept = !matches!(self.unit, MeshUnit::Millimetres(_));
        self.diameter_mm = Some(statement.diameter_mm).filter(|_| is_size_kept);
        self.scale = Some(match stands {
            Stands::Moved { scale, .. } => scale,
            _ => statement.scale(),
        });
        self.material.clone_from(&statement.material);
        match (self.given, stands) {
            (Up::FoundBy(_), Stands::AsStated) => {
                Up::Posed(Pose { scale: statement.scale(), ..Pose::turned(statement.turn()) })
            }
            (Up::FoundBy(_), Stands::Moved { up, scale }) => {
                remarks.warnings.extend(changes(&statement, up, scale, is_size_kept));
                Up::Known(up)
            }
            (given, Stands::Moved { up, scale }) => {
                remarks.warnings.extend(changes(&statement, up, scale, is_size_kept));
                given
            }
            (given, _) => given,
        }
    }
}

/// Describes the changes to a stone since its file was written, where they are more than a shift. Where the size is not kept
/// anyway, a change of the scale is none.
fn changes(statement: &Statement, up: DVec3, scale: f64, is_size_kept: bool) -> Option<String> {
    let turned = (up - statement.up).length() > ON_AXIS;
    let factor = statement.scale() / scale;
    let scaled = is_size_kept && (factor - 1.0).abs() > SAME_SIZE;
    let by = format!("its corners have been scaled by {factor:.4} since");
    let to = format!("its corners have been turned since, so that its table faces {}", axis(up));
    let (said, size) = (axis(statement.up), statement.diameter_mm);
    match (turned, scaled) {
        (true, true) => Some(format!(
            "the file says that {said} is up and that the stone is {size} mm across, but {to}, and {by}; {size} mm \
                is kept"
        )),
        (true, false) => Some(format!("the file says that {said} is up, but {to}")),
        (false, true) => {
            Some(format!("the file says that the stone is {size} mm across, but {by}; {size} mm is kept"))
        }
        (false, false) => None,
    }
}

/// Returns the note on a direction that was found, where another is nearly as likely.
pub(super) fn doubtful(up: DVec3, other: DVec3) -> String {
    format!(
        "its shape does not show clearly which way its table faces: {} was chosen, and {} is nearly as likely",
        axis(up),
        axis(other)
    )
}

/// Returns a direction in the form in which it can be given.
fn axis(direction: DVec3) -> String {
    let named = [("x", DVec3::X), ("y", DVec3::Y), ("z", DVec3::Z)];
    let is = |(name, axis): &(&str, DVec3)| {
        if (direction - *axis).length() < ON_AXIS {
            Some((*name).to_owned())
        } else if (direction + *axis).length() < ON_AXIS {
            Some(format!("-{name}"))
        } else {
            None
        }
    };
    named.iter().find_map(is).unwrap_or_else(|| {
        // Rounded first, so that a tiny negative number does not become -0.
        let [x, y, z] = direction.to_array().map(|x| (x * 1e4).round() / 1e4 + 0.0);
        format!("{x},{y},{z}")
    })
}

/// Returns the direction that is up in files of a format: y by the standard of glTF. The other formats state no direction,
/// and stones are usually modelled with z up.
pub(super) fn usual_up(format: MeshFormat) -> DVec3 {
    if matches!(format, MeshFormat::Glb | MeshFormat::Gltf) { DVec3::Y } else { DVec3::Z }
}

/// Returns the axes of a file, each in both directions.
pub(super) fn axes() -> [DVec3; 6] {
    [DVec3::Z, DVec3::Y, DVec3::X, DVec3::NEG_Z, DVec3::NEG_Y, DVec3::NEG_X]
}
