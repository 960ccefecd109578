//! Rows for what the stone is made of, how large it is and what it weighs.

use crate::app::editor::Editor;
use crate::app::model::extent::Extent;
use crate::app::panels::company_rows;
use crate::app::panels::rows::{
    NOT_KNOWN, NUMBER, Number, UNKNOWN, field_width, named, number_row, skip_control,
};
use crate::cut::{Cut, Design, MaterialRef, Size};
use crate::optics::{Material, line, materials};
use egui::{ComboBox, RichText, Ui};
use std::ops::RangeInclusive;
use std::sync::Arc;

/// The range of lengths that a stone may have, mm.
const LENGTHS_MM: RangeInclusive<f64> = 0.1..=1000.0;

/// The range of weights that can be typed, carats; the diameter that follows has limits of its own.
const CARATS: RangeInclusive<f64> = 1e-6..=1e9;

/// The range of densities that can be typed, g/cm³: the same that cut files take.
const DENSITIES: RangeInclusive<f64> = 0.1..=30.0;

/// Draws the rows, and sets what the user changes.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    let specimen = Arc::clone(editor.document.specimen());
    let extent = editor.framing.extent(&specimen);
    let design = &mut editor.document.work.design;
    material(design, &specimen.material, ui);
    if is_own(&design.material) || specimen.material.density.is_none() {
        density(design, &specimen.material, ui);
    }
    size(design, extent, ui);
    weight(design, specimen.solid().volume(), &specimen.material, ui);
}

/// Whether the material is not one of the library's.
fn is_own(material: &MaterialRef) -> bool {
    !matches!(material, MaterialRef::Name(_))
}

/// The note about a material whose colour is not measured.
const ILLUSTRATIVE: &str = "\nIts colour is illustrative: chosen to look like the gem's, and not measured. What the stone \
    absorbs follows from it.";

fn material(design: &mut Design, known: &Material, ui: &mut Ui) {
    ui.horizontal(|ui| {
        let meaning = "What the stone is made of: it sets refraction, dispersion and colour.";
        let label = named(ui, "Material", meaning);
        let name = match &design.material {
            MaterialRef::Name(name) => name.clone(),
            MaterialRef::Index(index) => format!("index {index}"),
            MaterialRef::Custom(material) => material.name.clone(),
        };
        let combo = ComboBox::from_id_salt("material").selected_text(&name).width(field_width(ui));
        let combo = combo.truncate().height(420.0).show_ui(ui, |ui| {
            let mut all: Vec<_> = materials().iter().collect();
            all.sort_by_key(|m| m.name.as_str());
            for material in all {
                let chosen = name == material.name;
                let colour = if material.colour_is_illustrative { ILLUSTRATIVE } else { "" };
                let about =
                    format!("{}\nindex {:.4}{colour}", material.description, material.index(line::SODIUM_D));
                let entry = if material.colour_is_illustrative {
                    format!("{}   (illustrative colour)", material.name)
                } else {
                    material.name.clone()
                };
                if ui.selectable_label(chosen, entry).on_hover_text(about).clicked() && !chosen {
                    design.material = MaterialRef::Name(material.name.clone());
                }
            }
        });
        combo.response.labelled_by(label.id);
    });
    if known.colour_is_illustrative {
        ui.label(RichText::new("illustrative colour").weak().small())
            .on_hover_text(ILLUSTRATIVE.trim_start());
    }
    if matches!(design.cut, Cut::Glass(_)) {
        company_rows::two_numbers(&mut design.material, known, ui);
    }
}

/// Draws the row for the density: a material of the library has its own, and setting another makes it a custom material.
fn density(design: &mut Design, known: &Material, ui: &mut Ui) {
    let mut density = known.density.unwrap_or(NOT_KNOWN);
    let meaning =
        "What the stone's weight follows from. An index alone says nothing of it: type the density here.";
    let number = Number { decimals: 3, speed: 0.01, range: DENSITIES, unit: " g/cm³" };
    number_row(ui, ("Density", meaning), number, &mut density);
    if density.is_finite() && known.density != Some(density) {
        let own = Material { density: Some(density), ..known.clone() };
        design.material = MaterialRef::Custom(Box::new(own));
    }
}

/// Draws the diameter of a round stone, or length and width of any other; setting one scales the whole stone.
fn size(design: &mut Design, extent: Extent, ui: &mut Ui) {
    let number = || Number { decimals: 3, speed: 0.01, range: LENGTHS_MM, unit: " mm" };
    if extent.is_round {
        let meaning = "Of the girdle. A larger stone of colour is darker.";
        return number_row(ui, ("Diameter", meaning), number(), &mut design.diameter_mm);
    }
    // The bare names belong to the dimensions of glass shapes, which are in percent.
    let names = match design.cut {
        Cut::Glass(_) => ["Length in mm", "Width in mm"],
        _ => ["Length", "Width"],
    };
    let rows = [
        (
            names[0],
            "The greater side of the stone from above. The whole stone is scaled by it.",
            extent.length,
        ),
        (
            names[1],
            "The smaller side of the stone from above. The whole stone is scaled by it.",
            extent.width,
        ),
    ];
    for (name, meaning, across) in rows {
        let before = 0.5 * design.diameter_mm * across;
        let mut mm = before;
        number_row(ui, (name, meaning), number(), &mut mm);
        if mm != before {
            design.diameter_mm = 2.0 * mm / across;
        }
    }
}

fn weight(design: &mut Design, volume: f64, material: &Material, ui: &mut Ui) {
    let meaning = "From the stone's volume and its material's density. Setting it scales the whole stone.";
    let known = material.carats(volume * (0.5 * design.diameter_mm).powi(3));
    let Some(mut carats) = known else {
        ui.horizontal(|ui| {
            named(ui, "Weight", meaning);
            skip_control(ui, 0.0);
            let reason = "The density is not known: type it above.";
            ui.add_sized([NUMBER, ui.spacing().interact_size.y], egui::Label::new(UNKNOWN))
                .on_hover_text(reason);
        });
        return;
    };
    let before = carats;
    let number = Number { decimals: 3, speed: 0.01, range: CARATS, unit: " ct" };
    number_row(ui, ("Weight", meaning), number, &mut carats);
    if let (true, Ok(diameter)) = (carats != before, Size::Carats(carats).diameter_mm(volume, material)) {
        design.diameter_mm = diameter;
    }
}
