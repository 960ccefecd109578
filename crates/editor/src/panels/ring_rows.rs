//! Rows for the numbers of a scene's ring.

use crate::panels::rows::{ChoiceRow, Row, wrong};
use brillianteer_scene::{OuterShape, RING_NUMBERS, Ring, RingNumber, RingStyle};
use brillianteer_session::model::{
    Model,
    action::{Actions, Edit},
};
use egui::{CollapsingHeader, Ui};

/// How the panel shows a number of a ring.
struct Shown {
    key: &'static str,
    name: &'static str,
    meaning: &'static str,
}

/// The numbers of a ring, in the order of the panel.
const NUMBERS: [Shown; RING_NUMBERS.len()] = [
    Shown { key: "inner_diameter_mm", name: "Inner diameter", meaning: "The diameter of the finger's hole." },
    Shown {
        key: "width_mm",
        name: "Band width",
        meaning: "The width of the band along the finger, opposite the head.",
    },
    Shown {
        key: "thickness_mm",
        name: "Band thickness",
        meaning: "The thickness of the band in its middle.",
    },
    Shown {
        key: "comfort_mm",
        name: "Comfort",
        meaning: "The height by which the inside of the band rises from its middle to its edges.",
    },
    Shown {
        key: "taper",
        name: "Taper",
        meaning: "The width of the band at the head, as a part of its width.",
    },
    Shown {
        key: "prong_diameter_mm",
        name: "Prong diameter",
        meaning: "The diameter of a prong at the girdle; its tip is thinner.",
    },
    Shown {
        key: "notch",
        name: "Notch",
        meaning: "The depth of the notch in which the girdle sits, as a part of the prong's diameter.",
    },
    Shown {
        key: "grip_mm",
        name: "Grip",
        meaning: "The length by which the middle of a prong reaches over the crown from the girdle.",
    },
    Shown {
        key: "culet_gap_mm",
        name: "Culet gap",
        meaning: "The height of the stone's lowest point above the metal under it.",
    },
    Shown {
        key: "rail_diameter_mm",
        name: "Rail diameter",
        meaning: "The diameter of the rails between the prongs and under a halo.",
    },
    Shown {
        key: "small_diameter_mm",
        name: "Small stones",
        meaning: "The girdle diameter of the small stones. As many are set as fit.",
    },
    Shown {
        key: "small_gap_mm",
        name: "Small gap",
        meaning: "The least gap between the girdles of small stones, and between these and the main stone.",
    },
];

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
    for Shown { key, name, meaning } in NUMBERS {
        let number = RING_NUMBERS.iter().find(|number| number.key == key && (number.matters)(style));
        let Some(RingNumber { range: [least, most], unit, get, set, .. }) = number else { continue };
        let unit = if unit.is_empty() { "" } else { " mm" };
        let before = get(ring);
        let mut now = before;
        let row = Row::new(name, meaning, *least..=*most);
        Row { step: 0.01, speed: 0.01, unit, default: Some(get(first)), ..row }.show(ui, &mut now);
        if now != before {
            set(ring, now);
        }
    }
}

/// Returns the reason why a ring cannot be made, with the names of the rows in place of the keys of scene files.
fn by_name(why: &str) -> String {
    // Keys that are also plain words are replaced only where they begin the reason.
    let first = NUMBERS.iter().find(|shown| why.starts_with(&format!("{}:", shown.key)));
    let named = first.map_or_else(|| why.to_owned(), |shown| why.replacen(shown.key, shown.name, 1));
    let keys = NUMBERS.iter().filter(|shown| shown.key.contains('_'));
    keys.fold(named, |text, shown| text.replace(shown.key, &shown.name.to_lowercase()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_number_of_a_ring_has_a_row() {
        let keys = NUMBERS.map(|shown| shown.key);
        assert_eq!(keys, RING_NUMBERS.map(|number| number.key));
    }

    #[test]
    fn a_reason_names_rows_in_place_of_keys() {
        let why = "notch: the notch is too deep; lower it or raise prong_diameter_mm";
        assert_eq!(by_name(why), "Notch: the notch is too deep; lower it or raise prong diameter");
    }
}
