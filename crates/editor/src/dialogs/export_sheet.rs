//! The cutter's sheet in the export dialog.

use crate::panels::rows::spoken;
use brillianteer_paper::cutting_sheet::SheetFormat;
use brillianteer_picture::PaperSize;
use brillianteer_session::model::export_sheet::SheetChoice;
use egui::{ComboBox, Ui};

/// The width of the choices, points.
const CHOICES: f32 = 84.0;

/// Draws the choices of the cutter's sheet: whether one is written, its format and paper. `can_have` says whether the
/// stone can have one.
pub fn sheet_row(sheet: &mut SheetChoice, can_have: bool, ui: &mut Ui) {
    let meaning = "Writes the sheet that a faceter works from: the stone from above and below with the indices round it, \
        the ratios, and every tier in the order in which it is cut. A cut by proportions is turned into tiers for it.";
    let refused =
        "A sheet is for a convex stone between planes: tiers cut no cleft of a heart and no curved glass.";
    ui.horizontal(|ui| {
        ui.add_enabled_ui(can_have, |ui| {
            ui.checkbox(&mut sheet.is_wanted, "Cutter's sheet")
                .on_hover_text(meaning)
                .on_disabled_hover_text(refused);
        });
        ui.add_enabled_ui(can_have && sheet.is_wanted, |ui| {
            choice(ui, "Format of the sheet", &mut sheet.format, SheetFormat::ALL.map(|of| (of, of.name())));
            choice(ui, "Paper of the sheet", &mut sheet.paper, PaperSize::ALL.map(|of| (of, of.name())));
            let meaning = "Gives the indices of a gear that counts clockwise. The stone is the same.";
            ui.checkbox(&mut sheet.left_handed, "Left-handed gear").on_hover_text(meaning);
        });
    });
}

fn choice<T: Copy + PartialEq, const N: usize>(
    ui: &mut Ui,
    name: &str,
    chosen: &mut T,
    all: [(T, &'static str); N],
) {
    let shown = all.iter().find(|(of, _)| of == chosen).map_or("", |(_, name)| name);
    let combo = ComboBox::from_id_salt(name).width(CHOICES).selected_text(shown);
    let shown = combo.show_ui(ui, |ui| {
        for (of, name) in all {
            ui.selectable_value(chosen, of, name);
        }
    });
    spoken(&shown.response, name);
}
