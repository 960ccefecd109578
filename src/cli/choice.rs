//! Values of the library that people choose by name on the command line, with what the help says of each.

use brillianteer_files::design_file::DesignFormat;
use brillianteer_files::mesh_options::MeshForm;
use brillianteer_paper::cutting_sheet::SheetFormat;
use brillianteer_paper::export::OutputFormat;
use brillianteer_picture::PaperSize;
use brillianteer_render::Wanted;
use brillianteer_scene::Movement;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

/// A value, its name, and its meaning.
pub type NamedValue<T> = (T, &'static str, &'static str);

/// Returns the parser of an option that takes one of these values by its name.
pub fn one_of<T: Copy + Send + Sync + 'static>(
    choices: &'static [NamedValue<T>],
) -> impl TypedValueParser<Value = T> {
    let listed = choices.iter().map(|(_, name, meaning)| PossibleValue::new(*name).help(*meaning));
    PossibleValuesParser::new(listed).try_map(|given| {
        let chosen = choices.iter().find(|(_, name, _)| *name == given);
        chosen.map(|(value, ..)| *value).ok_or(format!("'{given}' is none of the names"))
    })
}

/// Returns the name of a value; `None` where the command line has none for it.
pub fn name_of<T: PartialEq>(choices: &[NamedValue<T>], value: T) -> Option<&'static str> {
    choices.iter().find(|(known, ..)| *known == value).map(|(_, name, _)| *name)
}

/// The tracer of a request.
pub const TRACERS: [NamedValue<Wanted>; 4] = [
    (
        Wanted::Quickest,
        "auto",
        "The quickest: exact beams; a graphics card for renders and where beams do not apply; else rays",
    ),
    (Wanted::Beams, "beam", "Exact beams, in f64, for parallel rays"),
    (
        Wanted::Rays,
        "ray",
        "Point rays on the processor: in f32 for pictures under light without meshes, in f64 for all else",
    ),
    (Wanted::Card, "gpu", "Point rays on a graphics card, in f32"),
];

/// How plates move.
pub const MOVEMENTS: [NamedValue<Movement>; 3] = [
    (Movement::Both, "both", "Plates tumble as other bodies do, and their waves run"),
    (Movement::Tumble, "tumble", "Plates tumble, and their waves stand still"),
    (Movement::Wave, "wave", "The waves run, and the plates stay in their pose"),
];

/// The forms in which the triangles of a mesh are read, if not as found.
pub const MESH_FORMS: [NamedValue<MeshForm>; 2] = [
    (
        MeshForm::Faceted,
        "faceted",
        "The flat facets of a convex stone, which exact beams, scopes and drawings need",
    ),
    (MeshForm::Triangles, "triangles", "The triangles themselves, which rays trace"),
];

/// The formats of design files.
pub const DESIGN_FORMATS: [NamedValue<DesignFormat>; 8] = [
    (DesignFormat::Toml, "toml", "Cut files of this program"),
    (DesignFormat::Asc, "asc", "GemCad's text files"),
    (DesignFormat::Gem, "gem", "GemCad's binary files"),
    (DesignFormat::Gcs, "gcs", "Gem Cut Studio's files"),
    (DesignFormat::Obj, "obj", "Wavefront's meshes, facets as polygons"),
    (DesignFormat::Stl, "stl", "Binary STL meshes"),
    (DesignFormat::Ply, "ply", "PLY meshes"),
    (DesignFormat::Glb, "glb", "Binary glTF meshes"),
];

/// The formats of cutters' sheets.
pub const SHEET_FORMATS: [NamedValue<SheetFormat>; 3] = [
    (SheetFormat::Pdf, "pdf", "Portable documents, all pages in one file, with text that can be searched"),
    (SheetFormat::Svg, "svg", "Drawings, a file for each page"),
    (SheetFormat::Png, "png", "Pictures of 300 pixels an inch, a file for each page"),
];

/// The sizes of paper.
pub const PAPER_SIZES: [NamedValue<PaperSize>; 2] =
    [(PaperSize::A4, "a4", "210 by 297 mm"), (PaperSize::Letter, "letter", "8½ by 11 inches")];

/// The formats in which a stone is exported.
pub const OUTPUT_FORMATS: [NamedValue<OutputFormat>; 4] = [
    (OutputFormat::Png, "png", "Pictures of energy and of strongest exits, sRGB"),
    (OutputFormat::Svg, "svg", "The virtual facets as polygons"),
    (OutputFormat::Exr, "exr", "Energy of each zone, 32-bit and linear"),
    (OutputFormat::Json, "json", "Figures of the view, as `measure --json` prints them"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_of_the_library_has_one_name_on_the_command_line() {
        // A new value of either asks for its name here.
        let tracer = |value: Wanted| match value {
            Wanted::Quickest => "auto",
            Wanted::Beams => "beam",
            Wanted::Rays => "ray",
            Wanted::Card => "gpu",
        };
        assert!(TRACERS.iter().all(|(value, name, _)| tracer(*value) == *name));
        let form = |value: MeshForm| match value {
            MeshForm::Found => None,
            MeshForm::Faceted => Some("faceted"),
            MeshForm::Triangles => Some("triangles"),
        };
        assert!(MESH_FORMS.iter().all(|(value, name, _)| form(*value) == Some(*name)));
        assert_eq!(MOVEMENTS.map(|(value, name, _)| (name, value)), Movement::NAMES);
        assert_eq!(DESIGN_FORMATS.map(|(value, ..)| value), DesignFormat::ALL);
        assert!(DESIGN_FORMATS.iter().all(|(format, name, _)| format.ending() == *name));
        assert_eq!(SHEET_FORMATS.map(|(value, ..)| value), SheetFormat::ALL);
        assert!(SHEET_FORMATS.iter().all(|(format, name, _)| format.ending() == *name));
        assert_eq!(PAPER_SIZES.map(|(value, ..)| value), PaperSize::ALL);
        assert_eq!(OUTPUT_FORMATS.map(|(value, ..)| value), OutputFormat::ALL);
        assert!(OUTPUT_FORMATS.iter().all(|(format, name, _)| format.ending() == *name));
    }
}
