//! Rows that set how the open mesh is read: as flat facets or as triangles, which way its table faces, how long its unit
//! is, and which of several bodies it is.

use crate::panels::rows::{ChoiceRow, named};
use brillianteer_cut::Cut;
use brillianteer_cut::from_mesh::{Evening, Up};
use brillianteer_files::mesh_options::{MeshForm, MeshOptions, MeshPart, MeshUnit};
use brillianteer_session::model::{
    Model,
    action::{Actions, FileAction},
};
use egui::Ui;
use glam::DVec3;

/// The choice by which the program finds out.
const AUTOMATIC: &str = "Automatic";

const MEANING: &str = "The direction in the mesh file that the table faces. The mesh is read again when you change \
    it.";

const UNIT_MEANING: &str = "The length of one unit of the mesh file, from which the size of the stone follows. Automatic: as \
    the file states; else metres in glTF and mm in other formats. The mesh is read again when you change it.";
const WHICH: &str =
    "The body that is read of a file that has several. The mesh is read again when you change it.";

/// The directions that can be chosen.
const DIRECTIONS: [(&str, Up); 7] = [
    (AUTOMATIC, Up::Found),
    ("+x", Up::Given(DVec3::X)),
    ("−x", Up::Given(DVec3::NEG_X)),
    ("+y", Up::Given(DVec3::Y)),
    ("−y", Up::Given(DVec3::NEG_Y)),
    ("+z", Up::Given(DVec3::Z)),
    ("−z", Up::Given(DVec3::NEG_Z)),
];

/// The forms that the triangles of a mesh can be read as: name, form and meaning.
const FORMS: [(&str, MeshForm, &str); 2] = [
    ("Facets", MeshForm::Faceted, "Reads a convex stone with flat facets, as a cutter makes it."),
    ("Triangles", MeshForm::Triangles, "Keeps the mesh as it is, and traces it by rays."),
];

/// Draws the rows for a design that was read from a mesh; another choice reads the mesh anew.
pub fn show(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let Some(options) = model.mesh_options() else { return };
    form(&model.document.work.design.cut, &options, actions, ui);
    let mut up = options.up;
    ChoiceRow::new("Table faces", MEANING, &direction_name(up)).show(ui, |ui| {
        for (name, direction) in DIRECTIONS {
            ui.selectable_value(&mut up, direction, name);
        }
    });
    actions.push_changed(&options.up, up, |up| FileAction::ReadMesh(MeshOptions { up, ..options.clone() }));
    unit(&options, actions, ui);
    let parts = model.document.work.mesh.as_ref().map_or(&[][..], |mesh| &mesh.parts);
    if !parts.is_empty() {
        part(parts, &options, actions, ui);
    }
    if matches!(model.document.work.design.cut, Cut::Planes(_)) {
        as_found(&options, actions, ui);
    }
}

/// Draws the row of units; the sign is that of the unit, as it is given on the command line.
fn unit(options: &MeshOptions, actions: &mut Actions, ui: &mut Ui) {
    let mut unit = options.unit;
    ChoiceRow::new("Unit", UNIT_MEANING, &unit_name(unit)).show(ui, |ui| {
        ui.selectable_value(&mut unit, MeshUnit::Found, AUTOMATIC);
        for (name, mm) in MeshUnit::NAMED {
            ui.selectable_value(&mut unit, MeshUnit::Millimetres(mm), name);
        }
    });
    actions.push_changed(&options.unit, unit, |unit| {
        FileAction::ReadMesh(MeshOptions { unit, ..options.clone() })
    });
}

fn unit_name(unit: MeshUnit) -> String {
    match unit {
        MeshUnit::Millimetres(_) => unit.to_string(),
        MeshUnit::Found | MeshUnit::Unneeded => AUTOMATIC.to_owned(),
    }
}

/// Draws the row that chooses one of the bodies in the file, or all of them.
fn part(parts: &[String], options: &MeshOptions, actions: &mut Actions, ui: &mut Ui) {
    let mut chosen = options.part.clone();
    let numbered = parts.iter().enumerate().map(|(place, name)| (name.as_str(), MeshPart::Number(place + 1)));
    let all =
        [("Automatic", MeshPart::Found)].into_iter().chain(numbered).chain([("All as one", MeshPart::All)]);
    let all: Vec<(&str, MeshPart)> = all.collect();
    let name = all.iter().find(|(_, part)| *part == chosen).map(|(name, _)| (*name).to_owned());
    let name = name.unwrap_or_else(|| chosen.to_string());
    ChoiceRow::new("Body", WHICH, &name).show(ui, |ui| {
        for (name, part) in all {
            ui.selectable_value(&mut chosen, part, name);
        }
    });
    actions.push_changed(&options.part, chosen, |part| {
        FileAction::ReadMesh(MeshOptions { part, ..options.clone() })
    });
}

/// Draws the row by which facets stay as they were found.
fn as_found(options: &MeshOptions, actions: &mut Actions, ui: &mut Ui) {
    let was = options.evening == Evening::AsFound;
    let mut is = was;
    ui.checkbox(&mut is, "Keep facets as found").on_hover_text(
        "Otherwise a mesh that is symmetric except for its noise becomes exactly symmetric. The mesh is read again when \
         you change it.",
    );
    let evening = if is { Evening::AsFound } else { Evening::WhereLikely };
    actions.push_changed(&was, is, |_| FileAction::ReadMesh(MeshOptions { evening, ..options.clone() }));
}

/// Draws the row of forms; the chosen form is marked, or the form of the cut where none was chosen.
fn form(cut: &Cut, options: &MeshOptions, actions: &mut Actions, ui: &mut Ui) {
    let found = match cut {
        Cut::Planes(_) => MeshForm::Faceted,
        Cut::Mesh(_) => MeshForm::Triangles,
        _ => return,
    };
    let present = if options.form == MeshForm::Found { found } else { options.form };
    ui.horizontal(|ui| {
        named(
            ui,
            "Read as",
            "The form in which the triangles of the file are read. A change reads the mesh again.",
        );
        for (name, form, meaning) in FORMS {
            let is_present = form == present;
            if ui.selectable_label(is_present, name).on_hover_text(meaning).clicked() && !is_present {
                actions.push(FileAction::ReadMesh(MeshOptions { form, ..options.clone() }));
            }
        }
    });
}

fn direction_name(up: Up) -> String {
    let name = DIRECTIONS.iter().find(|(_, direction)| *direction == up).map(|(name, _)| (*name).to_owned());
    name.unwrap_or_else(|| match up {
        Up::Given(DVec3 { x, y, z }) => format!("{x}, {y}, {z}"),
        _ => DIRECTIONS[0].0.to_owned(),
    })
}
