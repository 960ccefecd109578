//! Rows for the optical properties of a material of one's own: index, dispersion and colour.

use crate::panels::rows::{Number, Row, colour_row, number_row};
use brillianteer_cut::{Cut, Design, MaterialRef};
use brillianteer_optics::{Absorption, Dispersion, Material, line};
use egui::{CollapsingHeader, Id, Ui, UiBuilder};
use std::ops::RangeInclusive;

/// The range of refractive indices, of stones and of glasses known and invented.
const INDICES: RangeInclusive<f64> = 1.0..=3.5;

/// The range of Abbe numbers, of glasses known and invented.
const ABBE_NUMBERS: RangeInclusive<f64> = 1.0..=90.0;

/// The range of dispersions B - G: that of strontium titanate is 0.19.
const DISPERSIONS: RangeInclusive<f64> = 0.0..=0.3;

/// The range of lengths in which half the light is lost, mm.
const HALF_LENGTHS: RangeInclusive<f64> = 0.01..=1e4;

/// Draws the rows of the first of two designs, for gems folded up at first; the second has the defaults. Returns the material; returns the material that a change of one makes.
pub fn show(designs: (&Design, &Design), known: &Material, ui: &mut Ui) -> Option<MaterialRef> {
    let changed = match designs.0.cut {
        Cut::Glass(_) => rows(designs, known, ui),
        _ => {
            let folded = CollapsingHeader::new("Index and colour").show(ui, |ui| rows(designs, known, ui));
            folded.header_response.on_hover_text("Change what the material does to light.");
            folded.body_returned.flatten()
        }
    };
    changed.map(|material| MaterialRef::Custom(Box::new(material)))
}

fn rows((design, first): (&Design, &Design), known: &Material, ui: &mut Ui) -> Option<Material> {
    let first = first.material.material().ok();
    let first = first.as_ref();
    let is_own = matches!(design.material, MaterialRef::Custom(_));
    // Another index makes another substance, which keeps a density only where the user had set it.
    let refracting = refraction(known, first, ui).map(|material| Material {
        density: is_own.then_some(known.density).flatten(),
        absorption: known.absorption.clone(),
        colour_is_illustrative: known.colour_is_illustrative,
        ..material
    });
    let coloured = colour((design, first), known, ui).map(|absorption| Material {
        name: if is_own { known.name.clone() } else { format!("{}, of a chosen colour", known.name) },
        absorption,
        colour_is_illustrative: true,
        ..known.clone()
    });
    refracting.or(coloured)
}

/// Draws the rows for the index, the Abbe number and the dispersion B - G; returns the clear material that a change of one
/// makes.
fn refraction(known: &Material, first: Option<&Material>, ui: &mut Ui) -> Option<Material> {
    let law = &known.dispersion;
    let index = known.index(line::HELIUM_D);
    let (abbe, spread) = (law.abbe_number().unwrap_or(f64::INFINITY), law.dispersion_b_g());
    let (mut n, mut v, mut b_g) = (index, abbe, spread);
    let meaning = "Refractive index n_d, at helium's yellow line of 587.6 nm.";
    let default = first.map(|first| first.index(line::HELIUM_D));
    Row { decimals: 3, speed: 0.01, default, ..Row::new("Index", meaning, INDICES) }.show(ui, &mut n);
    let meaning =
        "V_d. A smaller number makes a wider rainbow, and inf makes none. No real glass is below 20.";
    let limits = *ABBE_NUMBERS.start()..=f64::INFINITY;
    let row = Row::new("Abbe number", meaning, ABBE_NUMBERS);
    let default = first.map(|first| first.dispersion.abbe_number().unwrap_or(f64::INFINITY));
    Row { limits, decimals: 1, speed: 0.1, default, ..row }.show(ui, &mut v);
    let meaning = "Dispersion as gemmologists give it: the index at the B line (686.7 nm) less than at the G line \
        (430.8 nm). Diamond has 0.044.";
    let row = Row::new("Dispersion B-G", meaning, DISPERSIONS);
    let default = first.map(|first| first.dispersion.dispersion_b_g());
    Row { decimals: 4, speed: 0.0005, default, ..row }.show(ui, &mut b_g);
    if b_g != spread {
        let named = format!("index {n:.3}, dispersion {b_g:.4}");
        let law = Dispersion::cauchy_from(n, b_g).checked().ok()?;
        return Some(Material { dispersion: law, ..Material::from_index(&named, n).ok()? });
    }
    if (n, v) == (index, abbe) {
        return None;
    }
    if let Some(first) = first.filter(|first| is_back(first, n, v)) {
        return Some(first.clone());
    }
    let material = if v.is_finite() {
        Material::from_abbe(&format!("index {n:.3}, Abbe number {v:.1}"), n, v)
    } else {
        Material::from_index(&format!("index {n:.3}"), n)
    };
    material.ok()
}

/// The part of an Abbe number by which it may differ from that of the same glass, because it is read off a curve.
const SAME_GLASS: f64 = 1e-3;

/// Returns whether an index and an Abbe number are those of a material, of which one was set back by a double click.
fn is_back(first: &Material, n: f64, v: f64) -> bool {
    let own = [first.index(line::HELIUM_D), first.dispersion.abbe_number().unwrap_or(f64::INFINITY)];
    let is_near = |(a, b): (f64, f64)| a == b || (a - b).abs() <= SAME_GLASS * b.abs();
    let pairs = [(n, own[0]), (v, own[1])];
    pairs.into_iter().any(|(a, b)| a == b) && pairs.into_iter().all(is_near)
}

/// Draws the rows for the colour and for how strong it is; returns the absorption that a change of one makes.
fn colour(
    (design, first): (&Design, Option<&Material>),
    known: &Material,
    ui: &mut Ui,
) -> Option<[Absorption; 2]> {
    let path = design.diameter_mm;
    let meaning =
        "The colour of daylight after a path inside as long as the stone is wide. White is a clear stone.";
    let shown = known.colour_after(path).to_array();
    // The picker has an identity of its own, so that it stays open when a first colour makes other rows appear.
    let apart = UiBuilder::new().scope_id(Id::unique("body colour"));
    let usual = first.map(|first| first.colour_after(path).to_array());
    let row = ("Body colour", meaning);
    let picked = ui.scope_builder(apart, |ui| colour_row(ui, row, shown, usual)).inner;
    if let Some(linear) = picked {
        let absorption = Absorption::of_colour(linear.into(), path).ok()?;
        return Some([absorption.clone(), absorption]);
    }
    let half = known.half_length()?;
    let mut mm = half;
    let meaning =
        "The path inside after which half of daylight is left. A shorter one makes a deeper colour.";
    let default = first.and_then(Material::half_length);
    let number = Number { decimals: 2, speed: 0.05, range: HALF_LENGTHS, unit: " mm", default };
    number_row(ui, ("Half-light path", meaning), number, &mut mm);
    let scaled = || known.absorption.each_ref().map(|absorption| absorption.scaled(half / mm));
    (mm != half).then(scaled)
}
