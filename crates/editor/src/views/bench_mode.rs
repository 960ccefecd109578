//! Bench mode: one step of the cutting at a time, large enough to be read from the machine.

use crate::polygons;
use brillianteer_cut::{Cut, TierZone, Tiers};
use brillianteer_math::{Plane, Polytope};
use brillianteer_session::model::{
    Model,
    action::{Actions, ViewAction},
    cutting::{CuttingProgress, CuttingStep, steps},
};
use egui::{
    Button, CentralPanel, Color32, DragValue, Key, Mesh, Pos2, Rect, RichText, ScrollArea, Sense, Stroke, Ui,
    WidgetInfo, pos2, vec2,
};

/// The size of the angle, points.
const ANGLE: f32 = 72.0;
/// The sizes of the other large texts, points.
const LARGE: [f32; 2] = [30.0, 20.0];
/// The size of an index's button, points.
const CHIP: egui::Vec2 = vec2(86.0, 46.0);
/// The colour of indices that have been cut.
const DONE: Color32 = Color32::from_rgb(60, 140, 80);

/// Draws the step in sight in the place of the views.
pub fn show(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let Cut::Tiers(tiers) = &model.document.work.design.cut else { return };
    let all = steps(tiers);
    let before = &model.workspace.cutting;
    let mut now = before.clone();
    now.step = now.step.min(all.len().saturating_sub(1));
    CentralPanel::default().show(ui, |ui| {
        ui.horizontal_wrapped(|ui| controls(&mut now, (model, tiers), all.len(), ui));
        ui.separator();
        let Some(step) = all.get(now.step) else {
            ui.label("No tier of this design is cut.");
            return;
        };
        let side = (ui.available_width() * 0.42).min(ui.available_height());
        ui.horizontal_top(|ui| {
            let (rect, response) = ui.allocate_exact_size(vec2(side, side), Sense::hover());
            let name = format!("The stone at {}", step.name);
            response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, &name));
            plan(tiers, (step, &now, &model.document.work.design.name), rect, ui);
            ui.add_space(16.0);
            ui.vertical(|ui| page(&mut now, (model, tiers, step), all.len(), ui));
        });
    });
    let turned = |key: Key| !ui.ctx().text_edit_focused() && ui.input(|i| i.key_pressed(key));
    if turned(Key::ArrowRight) {
        now.step = (now.step + 1).min(all.len().saturating_sub(1));
    }
    if turned(Key::ArrowLeft) {
        now.step = now.step.saturating_sub(1);
    }
    if now != *before {
        actions.push(ViewAction::Cutting(now));
    }
}

/// Draws the controls that all steps share.
fn controls(now: &mut CuttingProgress, (model, tiers): (&Model, &Tiers), count: usize, ui: &mut Ui) {
    let design = &model.document.work.design.name;
    now.is_open &= !ui.button("Leave bench mode").on_hover_text("Goes back to the views.").clicked();
    let earlier = ui.add_enabled(now.step > 0, Button::new("Previous step"));
    let later = ui.add_enabled(now.step + 1 < count, Button::new("Next step"));
    if earlier.on_hover_text("Also with the left arrow key.").clicked() {
        now.step -= 1;
    }
    if later.on_hover_text("Also with the right arrow key.").clicked() {
        now.step += 1;
    }
    ui.separator();
    let label = ui.label("Cheater");
    let field = DragValue::new(&mut now.cheater).speed(0.01).max_decimals(2).suffix(" teeth");
    ui.add(field).labelled_by(label.id).on_hover_text(
        "The correction that your machine needs on every index. The indices below include it.",
    );
    ui.checkbox(&mut now.is_left_handed, "Left-handed gear")
        .on_hover_text("For a gear that counts the other way round: index 24 of 96 becomes 72.");
    ui.label(RichText::new(format!("{} index", tiers.gear.abs())).weak());
    if ui.button("Start again").on_hover_text("Takes all marks of this design back.").clicked() {
        now.forget(design);
    }
}

/// Draws one step.
fn page(
    now: &mut CuttingProgress,
    (model, tiers, step): (&Model, &Tiers, &CuttingStep),
    count: usize,
    ui: &mut Ui,
) {
    let design = &model.document.work.design.name;
    let done = now.count(design, step);
    ui.label(format!("Step {} of {count} · {}", now.step + 1, step.zone.name()));
    ui.label(RichText::new(&step.name).size(LARGE[0]).strong());
    ui.label(RichText::new(format!("{:.2}°", step.angle)).size(ANGLE).strong());
    if !step.instructions.is_empty() {
        ui.label(RichText::new(&step.instructions).size(LARGE[1]));
    }
    ui.add_space(8.0);
    ui.label(format!("{done} of {} indices are cut", step.indices.len()));
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        ui.horizontal_wrapped(|ui| {
            for &index in &step.indices {
                let is_cut = now.is_cut(design, step, index);
                let dial = now.dial(tiers.gear, index);
                let text = format!("{}", (dial * 100.0).round() / 100.0);
                let mut chip = Button::new(RichText::new(&text).size(LARGE[1])).min_size(CHIP);
                if is_cut {
                    chip = chip.fill(DONE);
                }
                let chip = ui.add(chip);
                chip.widget_info(|| {
                    WidgetInfo::selected(egui::Role::CheckBox, true, is_cut, format!("Index {text}"))
                });
                if chip.clicked() {
                    now.set(design, step, index, !is_cut);
                }
            }
        });
    });
}

/// Draws the stone as it is after this step, from the side that is being cut; the step's facets are filled.
fn plan(tiers: &Tiers, (step, now, design): (&CuttingStep, &CuttingProgress, &str), rect: Rect, ui: &Ui) {
    let cut = tiers.tiers[..=step.place].iter().enumerate().filter(|(_, tier)| tier.is_cut);
    let mut facets: Vec<(Option<f64>, Plane)> = cut
        .flat_map(|(place, tier)| {
            let own = move |index| (place == step.place).then_some(index);
            tier.facets.iter().map(move |facet| (own(facet.index), tiers.plane(tier, facet.index)))
        })
        .collect();
    // A stone that is open on one side yet is closed by a block, which grows with the design.
    let grown = facets.iter().map(|(_, plane)| plane.offset).fold(1.0, f64::max);
    let block = Tiers::block().map(|(_, plane)| Plane { offset: grown * plane.offset, ..plane });
    facets.extend(block.map(|plane| (None, plane)));
    let planes: Vec<Plane> = facets.iter().map(|(_, plane)| *plane).collect();
    let Ok(stone) = Polytope::from_planes(&planes) else { return };
    let is_below = matches!(step.zone, TierZone::Pavilion | TierZone::Culet);
    let side = if is_below { -1.0 } else { 1.0 };
    let (low, high) = stone.bounds();
    let reach = low.truncate().abs().max(high.truncate().abs()).max_element().max(f64::MIN_POSITIVE);
    let scale = 0.47 * f64::from(rect.width().min(rect.height())) / reach;
    // Seen from below, the stone is turned over about its y axis.
    let at = |corner: glam::DVec3| -> Pos2 {
        pos2((side * corner.x * scale) as f32, (-corner.y * scale) as f32) + rect.center().to_vec2()
    };
    let painter = ui.painter().with_clip_rect(rect);
    let line = Stroke::new(1.0, ui.visuals().text_color().gamma_multiply(0.6));
    for facet in stone.facets().iter().filter(|facet| side * facet.plane.normal.z > -1e-9) {
        let corners: Vec<Pos2> = stone.corners(facet).map(at).collect();
        let fill = match facets[facet.source].0 {
            Some(index) if now.is_cut(design, step, index) => DONE,
            Some(_) => ui.visuals().selection.bg_fill,
            None => ui.visuals().faint_bg_color,
        };
        let mut face = Mesh::default();
        polygons::fill(&mut face, corners.iter().copied(), fill);
        painter.add(face);
        painter.extend(polygons::closed_line(&corners, line));
    }
}
