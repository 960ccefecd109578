//! Rows for the numbers of a scene's ring.

use crate::panels::rows::{ChoiceRow, Row, wrong};
use brillianteer_scene::{OuterShape, RING_NUMBERS, Ring, RingNumber, RingStyle};
use brillianteer_session::model::{
    Model,
    action::{Actions, Edit},
};
use egui::{CollapsingHeader, Ui};

/// Draws the rows, folded at first; nothing where the scene has no ring that the program made.
pub fn show(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let Some(own) = &model.document.work.companions.ring else { return };
    let mut ring = own.ring.clone();
    let first = model.document.laid().1.ring.as_ref().map_or(&own.ring, |laid| &laid.ring);
    let folded = CollapsingHeader::new("Numbers of the ring").show(ui, |ui| rows(&mut ring, first, ui));
    folded.header_response.on_hover_text("Change the ring. Its metal and the places of its stones follow.");
    if let Some(why) = model.ring_fault() {
        wrong(ui, &format!("The metal stays as it was. {}", by_name(why)));
    }
    actions.push_changed(&own.ring, ring, |ring| Edit::Ring(Box::new(ring)));
}

/// Draws the rows of all numbers on which the metal of the ring's style depends; `first` has their defaults.
fn rows(ring: &mut Ring, first: &Ring, ui: &mut Ui) {
    let holds = |style: RingStyle| (style.prongs() > 0, style.has_small());
    let style = ring.style;
    let meaning = "The style of the ring: those that hold the same kinds of stones can be chosen.";
    let row = ChoiceRow::new("Style", meaning, style.name()).by_default(first.style.name());
    let is_reset = row.show(ui, |ui| {
        for (name, each) in RingStyle::NAMES.into_iter().filter(|(_, each)| holds(*each) == holds(style)) {
            ui.selectable_value(&mut ring.style, each, name);
        }
    });
    if is_reset {
        ring.style = first.style;
    }
    let meaning = "The shape of the band's outside: half an ellipse, or flat with rounded edges.";
    let name = |shape| if shape == OuterShape::D { "half an ellipse" } else { "flat" };
    let row = ChoiceRow::new("Outside", meaning, name(ring.outside)).by_default(name(first.outside));
    let is_reset = row.show(ui, |ui| {
        for (_, each) in OuterShape::NAMES {
            ui.selectable_value(&mut ring.outside, each, name(each));
        }
    });
    if is_reset {
        ring.outside = first.outside;
    }
    for RingNumber { row, .. } in RING_NUMBERS.iter().filter(|number| (number.matters)(style)) {
        let (Some(before), first) = ((row.get)(ring), (row.get)(first)) else { continue };
        let mut now = before;
        Row { speed: 0.01, default: first, ..Row::of(row) }.show(ui, &mut now);
        if now != before {
            (row.set)(ring, now);
        }
    }
}

/// Returns the reason why a ring cannot be made, with the names of the rows in place of the keys of scene files.
fn by_name(why: &str) -> String {
    let rows = || RING_NUMBERS.iter().map(|number| &number.row);
    // Keys that are also plain words are replaced only where they begin the reason.
    let first = rows().find(|row| why.starts_with(&format!("{}:", row.key)));
    let named = first.map_or_else(|| why.to_owned(), |row| why.replacen(row.key, row.name, 1));
    let keys = rows().filter(|row| row.key.contains('_'));
    keys.fold(named, |text, row| text.replace(row.key, &row.name.to_lowercase()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reason_names_rows_in_place_of_keys() {
        let why = "notch: the notch is too deep; lower it or raise prong_diameter_mm";
        assert_eq!(by_name(why), "Notch: the notch is too deep; lower it or raise prong diameter");
    }
}
