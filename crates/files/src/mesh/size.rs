//! Decides the size of a mesh's stone in mm, where the file makes no statement about it.
//!
//! glTF is in metres by its standard. No other format states a unit; printers, scanners and most programs that make
//! stones write millimetres.

use super::file::MeshFormat;
use crate::mesh_options::{METRE, MeshUnit};
use brillianteer_base::Fault;
use brillianteer_cut::{DEFAULT_DIAMETER_MM, DIAMETERS_MM};
use std::ops::RangeInclusive;

/// The diameters in mm that a cut stone plausibly has. Models for pictures often have other sizes: 1000 in any unit, or 1 in
/// metres.
const PLAUSIBLE: RangeInclusive<f64> = 1.0..=60.0;

/// Diameters are rounded to a whole number of these parts of a mm, because f32 holds seven digits.
const PARTS: f64 = 1e6;

/// The size of a mesh's stone, and how it was found.
#[derive(Debug, PartialEq)]
pub(super) struct MeshSize {
    /// The girdle diameter, mm.
    pub diameter_mm: f64,
    /// The note on what was assumed; `None` where the size is known.
    pub note: Option<String>,
}

impl MeshSize {
    /// Returns the size of a stone that is so many units of its file across.
    ///
    /// # Errors
    /// Fails where the unit is given and leads to a diameter that no stone may have.
    pub fn of(across: f64, unit: MeshUnit, format: MeshFormat) -> Result<Self, Fault> {
        let in_mm = |mm_per_unit: f64| (PARTS * across * mm_per_unit).round() / PARTS;
        if let MeshUnit::Millimetres(mm_per_unit) = unit {
            let diameter_mm = in_mm(mm_per_unit);
            return if DIAMETERS_MM.contains(&diameter_mm) {
                Ok(Self { diameter_mm, note: None })
            } else {
                Err(Fault::whole(format!(
                    "with a unit of {mm_per_unit} mm the stone is {diameter_mm} mm across, where {} to {} mm are \
                     possible; give another unit",
                    DIAMETERS_MM.start(),
                    DIAMETERS_MM.end()
                )))
            };
        }
        let is_metric = matches!(format, MeshFormat::Glb | MeshFormat::Gltf);
        let diameter_mm = in_mm(if is_metric { METRE } else { 1.0 });
        let is_plausible = PLAUSIBLE.contains(&diameter_mm);
        let note = match (is_plausible, is_metric) {
            (true, true) => None,
            (true, false) => Some(format!(
                "the file states no unit; it is taken to be in mm, so that the stone is {diameter_mm} mm across"
            )),
            (false, true) => Some(implausible(across, "m")),
            (false, false) => Some(implausible(across, "mm")),
        };
        let diameter_mm = if is_plausible { diameter_mm } else { DEFAULT_DIAMETER_MM };
        Ok(Self { diameter_mm, note: note.filter(|_| unit == MeshUnit::Found) })
    }
}

/// Returns the note on a file in which the stone has no plausible size.
fn implausible(across: f64, unit: &str) -> String {
    format!(
        "the size of the stone is not known: {across:.4} {unit} across, as in the file, is no size of a stone, so that it is \
         taken to be {DEFAULT_DIAMETER_MM} mm across"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size(across: f64, unit: MeshUnit, format: MeshFormat) -> (f64, Option<String>) {
        let MeshSize { diameter_mm, note } = MeshSize::of(across, unit, format).unwrap();
        (diameter_mm, note)
    }

    #[test]
    fn gltf_is_in_metres_and_every_other_format_in_millimetres_with_a_note() {
        assert_eq!(size(0.008, MeshUnit::Found, MeshFormat::Glb), (8.0, None));
        for format in [MeshFormat::Obj, MeshFormat::StlBinary, MeshFormat::StlText, MeshFormat::Ply] {
            let (diameter_mm, note) = size(8.000_000_2, MeshUnit::Found, format);
            assert_eq!(diameter_mm, 8.0);
            assert!(note.unwrap().ends_with("the stone is 8 mm across"));
        }
    }

    #[test]
    fn what_is_no_size_of_a_stone_is_assumed_and_told() {
        for (across, format) in [
            (2.0, MeshFormat::Glb),
            (8.0, MeshFormat::Gltf),
            (0.4, MeshFormat::Obj),
            (400.0, MeshFormat::Ply),
            (1e300, MeshFormat::StlText),
            (1e-300, MeshFormat::StlText),
        ] {
            let (diameter_mm, note) = size(across, MeshUnit::Found, format);
            assert_eq!(diameter_mm, DEFAULT_DIAMETER_MM);
            assert!(note.unwrap().contains("is taken to be 6.5 mm across"));
        }
    }

    #[test]
    fn a_unit_that_is_given_counts_above_all_and_must_lead_to_a_size() {
        let inch = MeshUnit::Millimetres(25.4);
        assert_eq!(size(0.25, inch, MeshFormat::Obj), (6.35, None));
        assert_eq!(size(0.25, inch, MeshFormat::Glb), (6.35, None));
        // A unit that is given may make a stone larger than cut stones usually are.
        assert_eq!(size(10.0, inch, MeshFormat::Obj), (254.0, None));
        let error = MeshSize::of(8.0, MeshUnit::Millimetres(METRE), MeshFormat::Obj).unwrap_err().to_string();
        assert!(error.contains("8000 mm across, where 0.1 to 1000 mm are possible"), "{error}");
    }

    #[test]
    fn where_the_size_is_given_elsewhere_nothing_is_said_of_it() {
        assert_eq!(size(8.0, MeshUnit::Unneeded, MeshFormat::Obj), (8.0, None));
        assert_eq!(size(8.0, MeshUnit::Unneeded, MeshFormat::Glb), (DEFAULT_DIAMETER_MM, None));
    }
}
