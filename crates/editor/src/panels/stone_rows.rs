//! Rows for the material, size and weight of the stone.

use crate::panels::material_rows;
use crate::panels::rows::{ChoiceRow, NOT_KNOWN, NUMBER, Number, UNKNOWN, named, number_row, skip_control};
use brillianteer_cut::{Cut, Design, MaterialRef, Size};
use brillianteer_math::rounded;
use brillianteer_optics::{Material, line, materials};
use brillianteer_session::model::{
    Model,
    action::{Actions, Edit},
    extent::Extent,
};
use egui::{RichText, Ui};
use std::ops::RangeInclusive;

/// The range of lengths that a stone may have, mm.
const LENGTHS_MM: RangeInclusive<f64> = 0.1..=1000.0;

/// The range of weights that can be typed, carats; the diameter that follows has limits of its own.
const CARATS: RangeInclusive<f64> = 1e-6..=1e9;

/// The range of densities that can be typed, g/cm³: the same that cut files take.
const DENSITIES: RangeInclusive<f64> = 0.1..=30.0;

/// Draws the rows.
pub fn show(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let specimen = model.document.specimen();
    let design = &model.document.work.design;
    let first = model.document.saved();
    let chosen = material(design, first, &specimen.material, ui);
    let is_unknown = specimen.material.density.is_none();
    let typed = (is_own(&design.material) || is_unknown).then(|| density(&specimen.material, ui)).flatten();
    chosen.or(typed).into_iter().for_each(|material| actions.push(Edit::Material(material)));
    let across = size((design, first), model.document.extent(), ui);
    let weighed = weight((design, first), specimen.solid().volume(), &specimen.material, ui);
    across.or(weighed).into_iter().for_each(|mm| actions.push(Edit::Diameter(mm)));
}

/// Returns whether the material is the user's own, and not one of the library.
fn is_own(material: &MaterialRef) -> bool {
    !matches!(material, MaterialRef::Name(_))
}

/// The note about a material whose colour is not measured.
const ILLUSTRATIVE: &str = "\nIts colour is illustrative: it was chosen to look like the gem's, not measured. \
    Absorption follows from it.";

/// Draws a row in which a material of the library is chosen; returns the chosen one if it differs from the present
/// one.
pub fn material_choice(
    ui: &mut Ui,
    (row, meaning): (&str, &str),
    now: &MaterialRef,
    first: Option<&MaterialRef>,
) -> Option<MaterialRef> {
    let mut chosen = None;
    let (name, usual) = (material_name(now), first.map(material_name));
    let row = ChoiceRow::new(row, meaning, &name);
    let row = match &usual {
        Some(usual) => row.by_default(usual),
        None => row,
    };
    let is_reset = row.show(ui, |ui| {
        let mut all: Vec<_> = materials().iter().collect();
        all.sort_by_key(|m| m.name.as_str());
        for material in all {
            let is_present = name == material.name;
            let colour = if material.colour_is_illustrative { ILLUSTRATIVE } else { "" };
            let about =
                format!("{}\nindex {:.4}{colour}", material.description, material.index(line::SODIUM_D));
            let entry = if material.colour_is_illustrative {
                format!("{}   (illustrative colour)", material.name)
            } else {
                material.name.clone()
            };
            if ui.selectable_label(is_present, entry).on_hover_text(about).clicked() && !is_present {
                chosen = Some(MaterialRef::Name(material.name.clone()));
            }
        }
    });
    if is_reset { first.filter(|first| *first != now).cloned() } else { chosen }
}

/// Returns the name of a material in its row.
fn material_name(material: &MaterialRef) -> String {
    match material {
        MaterialRef::Name(name) => name.clone(),
        MaterialRef::Index(index) => format!("index {}", rounded(*index, 4)),
        MaterialRef::Custom(material) => material.name.clone(),
    }
}

/// Draws the rows of the material; returns the one that was chosen.
fn material(design: &Design, first: &Design, known: &Material, ui: &mut Ui) -> Option<MaterialRef> {
    let meaning = "The material of the stone. It sets refraction, dispersion and colour.";
    let chosen = material_choice(ui, ("Material", meaning), &design.material, Some(&first.material));
    if known.colour_is_illustrative {
        ui.label(RichText::new("illustrative colour").weak().small())
            .on_hover_text(ILLUSTRATIVE.trim_start());
    }
    let changed = material_rows::show((design, first), known, ui);
    chosen.or(changed)
}

/// Draws the row for the density: a material of the library has its own, and setting another makes it a custom material,
/// which is returned.
fn density(known: &Material, ui: &mut Ui) -> Option<MaterialRef> {
    let mut density = known.density.unwrap_or(NOT_KNOWN);
    let meaning = "The density of the material, from which the weight follows. A material given by an index alone has none; \
            type it here.";
    let number = Number { decimals: 3, speed: 0.01, range: DENSITIES, unit: " g/cm³", default: None };
    number_row(ui, ("Density", meaning), number, &mut density);
    let is_set = density.is_finite() && known.density != Some(density);
    is_set.then(|| MaterialRef::Custom(Box::new(Material { density: Some(density), ..known.clone() })))
}

/// Draws the diameter of a round stone, or length and width of any other; setting one scales the whole stone. Returns the
/// diameter that was set, mm.
fn size((design, first): (&Design, &Design), extent: Extent, ui: &mut Ui) -> Option<f64> {
    let mut diameter = design.diameter_mm;
    let number = |first_mm| {
        let default = Some(first_mm);
        Number { decimals: 3, speed: 0.01, range: LENGTHS_MM, unit: " mm", default }
    };
    if extent.is_round {
        let meaning = "The diameter of the girdle. A larger coloured stone is darker.";
        number_row(ui, ("Diameter", meaning), number(first.diameter_mm), &mut diameter);
        return (diameter != design.diameter_mm).then_some(diameter);
    }
    // The names without a unit belong to the dimensions of glass shapes, which are in percent.
    let names = match design.cut {
        Cut::Glass(_) => ["Length in mm", "Width in mm"],
        _ => ["Length", "Width"],
    };
    for (name, side, across) in [(names[0], "longer", extent.length), (names[1], "shorter", extent.width)] {
        let meaning =
            format!("The {side} side of the stone, seen from above. A change scales the whole stone.");
        let before = 0.5 * design.diameter_mm * across;
        let mut mm = before;
        number_row(ui, (name, &meaning), number(0.5 * first.diameter_mm * across), &mut mm);
        if mm != before {
            diameter = 2.0 * mm / across;
        }
    }
    (diameter != design.diameter_mm).then_some(diameter)
}

/// Draws the weight; returns the diameter of the stone of the weight that was set, mm.
fn weight((design, first): (&Design, &Design), volume: f64, material: &Material, ui: &mut Ui) -> Option<f64> {
    let meaning =
        "The weight, by the stone's volume and its material's density. A change scales the whole stone.";
    let of = |design: &Design| material.carats(volume * (0.5 * design.diameter_mm).powi(3));
    let known = of(design);
    let Some(mut carats) = known else {
        ui.horizontal(|ui| {
            named(ui, "Weight", meaning);
            skip_control(ui, 0.0);
            let reason = "The density is unknown; type it above.";
            ui.add_sized([NUMBER, ui.spacing().interact_size.y], egui::Label::new(UNKNOWN))
                .on_hover_text(reason);
        });
        return None;
    };
    let before = carats;
    let number = Number { decimals: 3, speed: 0.01, range: CARATS, unit: " ct", default: of(first) };
    number_row(ui, ("Weight", meaning), number, &mut carats);
    let is_set = carats != before;
    is_set.then(|| Size::Carats(carats).diameter_mm(volume, material).ok()).flatten()
}
