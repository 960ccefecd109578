//! Makes places from a picture of the template that another renderer made, and detects changes to it on the way.

use super::codes::Codes;
use super::mending::{self, MendedPixels};
use super::{Template, tiles};
use brillianteer_base::Fault;
use brillianteer_optics::{encoded_from_linear, linear_from_encoded};
use brillianteer_picture::SourcePlace;
use glam::DVec2;
use std::collections::HashMap;

/// The weight below which a pixel of the gradient is empty: its place would be rounding alone.
const LEAST: f32 = 1.0 / 512.0;

/// The part of all pixels from which on a code that they share is that of a background. A map shows no place so
/// often.
const SHARED: f64 = 0.02;

/// The number of triples of pixels below which their straightness is not judged.
const FEWEST: usize = 32;

/// The part of triples across tiles that runs straight in any map. Photographs have less than a thousandth.
const STRAIGHT: f64 = 0.01;

/// The part of neighbouring triples of a gradient that runs straight in any map. Photographs have less.
const RUNS: f64 = 0.05;

/// The number of pixels from which on a gradient shows more than one place; grey pictures have fewer.
const MANY: usize = 256;

/// The factor by which places run straighter without a tone curve, from which on the curve is taken for the cause.
const STRAIGHTER: f64 = 1.5;

/// The part of pixels whose red or green is more than their blue from which on a picture is no gradient's.
const BEYOND: f64 = 0.1;

/// The places of one picture, and remarks about it.
pub(super) struct ForeignPlaces {
    pub places: Vec<SourcePlace>,
    /// True where the weights state the light that the glass has lost.
    pub has_weights: bool,
    pub notes: Vec<String>,
    pub warnings: Vec<String>,
}

/// The pixels of a picture that show the template.
struct Seen {
    width: usize,
    /// The colours, not premultiplied; `None` where a pixel does not show the template.
    colours: Vec<Option<[f32; 3]>>,
    /// The alpha of each pixel.
    alpha: Vec<f32>,
    notes: Vec<String>,
}

/// Returns the bytes of a colour of 0 to 1.
pub(super) fn bytes(colour: &[f32; 3]) -> [u8; 3] {
    // NaN becomes 0.
    colour.map(|part| (part.clamp(0.0, 1.0) * 255.0).round() as u8)
}

/// Returns the places of a foreign picture. Without a `template` 8 bits mean tiles, and more mean the gradient.
///
/// # Errors
/// Fails where the picture shows no part of the template, or where its numbers are no places.
pub(super) fn places(codes: &Codes, template: Option<Template>) -> Result<ForeignPlaces, Fault> {
    let template = template.unwrap_or(if codes.bits == 8 { Template::Tiles } else { Template::Gradient });
    let seen = Seen::of(codes);
    if seen.colours.iter().all(Option::is_none) {
        return Err(
            "nothing of the template is seen in it: it is empty, or of one colour; render it again".into()
        );
    }
    match template {
        Template::Tiles => of_tiles(seen),
        Template::Gradient => of_gradient(seen),
    }
}

impl Seen {
    fn of(codes: &Codes) -> Self {
        let values = codes.bands.first().map_or(&[][..], Vec::as_slice);
        let alpha: Vec<f32> = match &codes.alpha {
            Some(alpha) => {
                alpha.iter().map(|a| if a.is_finite() { a.clamp(0.0, 1.0) } else { 0.0 }).collect()
            }
            None => vec![1.0; values.len()],
        };
        let colour = |(value, &alpha): (&[f32; 3], &f32)| {
            let is_number = value.iter().all(|part| part.is_finite());
            let share = if codes.is_exr { alpha } else { 1.0 };
            let colour = value.map(|part| part / share);
            // Renderers leave black where a ray met nothing.
            (is_number && alpha > 0.5 / 255.0 && colour.iter().any(|&part| part > 0.5 / 65_535.0))
                .then_some(colour)
        };
        let colours: Vec<_> = values.iter().zip(&alpha).map(colour).collect();
        let mut seen = Self { width: codes.size[0] as usize, colours, alpha, notes: vec![] };
        seen.leave_out_the_background();
        seen
    }

    /// Treats a colour that very many pixels share, to the bit, as that of a background.
    fn leave_out_the_background(&mut self) {
        let mut counts: HashMap<[u32; 3], usize> = HashMap::new();
        for colour in self.colours.iter().flatten() {
            *counts.entry(colour.map(f32::to_bits)).or_default() += 1;
        }
        let most = counts.into_iter().max_by_key(|&(bits, count)| (count, bits));
        let Some((bits, count)) = most else { return };
        if (count as f64) < SHARED * self.colours.len() as f64 || count < 64 {
            return;
        }
        self.colours
            .iter_mut()
            .filter(|c| c.is_some_and(|c| c.map(f32::to_bits) == bits))
            .for_each(|c| *c = None);
        let [red, green, blue] = bytes(&bits.map(f32::from_bits));
        self.notes.push(format!(
            "{count} pixels have the one colour #{red:02x}{green:02x}{blue:02x} and count as empty"
        ));
    }
}

fn of_tiles(seen: Seen) -> Result<ForeignPlaces, Fault> {
    let straight =
        Straight { step: 1, tolerance: 8.0 * 16.0 / 255.0 / 255.0, least: 0.0, across_tiles: true };
    let decoded = |curve: fn(f64) -> f64| -> Vec<Option<(DVec2, u8)>> {
        let code = |colour: [f32; 3]| bytes(&colour.map(|part| curve(f64::from(part)) as f32));
        let place = |colour: [f32; 3]| (tiles::place(code(colour)), code(colour)[2]);
        seen.colours.iter().map(|colour| colour.map(place)).collect()
    };
    let share = |curve| {
        let (found, all) = straight.count(&decoded(curve), seen.width);
        if all < FEWEST { 1.0 } else { found as f64 / all as f64 }
    };
    let own = share(|part| part);
    if own < 1.0
        && share(linear_from_encoded).max(share(encoded_from_linear)) > STRAIGHT.max(STRAIGHTER * own)
    {
        return Err("a tone curve has changed its numbers, which destroys tiles: read the template as Non-Color (Raw) data \
                    and render with the view transform Raw, or use the gradient of 16 bits"
            .into());
    }
    if own < STRAIGHT {
        return Err("this is no map in tiles: its places run nowhere straight from tile to tile. Render the tiled template \
                    unlit, unfiltered and by the view transform Raw, or name the gradient as its template if it is that one"
            .into());
    }
    let mut codes: Vec<_> = seen.colours.iter().map(|colour| colour.as_ref().map(bytes)).collect();
    let mut at: Vec<DVec2> = codes.iter().map(|code| code.map_or(DVec2::ZERO, tiles::place)).collect();
    let MendedPixels { borders, edges } = mending::mend(&mut codes, &mut at, seen.width);
    let mut warnings = vec![];
    if borders > 0 {
        warnings.push(format!(
            "it is antialiased: {borders} pixels on borders of tiles were mended by their neighbours, and {edges} on \
             edges took the place of a neighbour. Render one sample through the middle of each pixel, without filter"
        ));
    }
    let place = |((code, at), &alpha): ((&Option<[u8; 3]>, &DVec2), &f32)| {
        let weight = if code.is_some() { alpha } else { 0.0 };
        SourcePlace { u: at.x as f32, v: at.y as f32, weight }
    };
    let places = codes.iter().zip(&at).zip(&seen.alpha).map(place).collect();
    Ok(ForeignPlaces { places, has_weights: false, notes: seen.notes, warnings })
}

fn of_gradient(seen: Seen) -> Result<ForeignPlaces, Fault> {
    let decoded = |curve: fn(f64) -> f64| -> Vec<Option<(DVec2, u8)>> {
        let place = |colour: [f32; 3]| {
            let [red, green, blue] = colour.map(|part| curve(f64::from(part)));
            (colour[2] > LEAST).then(|| (DVec2::new(red, green) / blue, 0))
        };
        seen.colours.iter().map(|colour| colour.and_then(place)).collect()
    };
    let at = decoded(|part| part);
    let shown = at.iter().flatten().count();
    let beyond = at.iter().flatten().filter(|(at, _)| at.max_element() > 1.01).count();
    // A picture without blue shows no template either.
    let dark = seen.colours.iter().flatten().count() - shown;
    if (beyond + dark) as f64 > BEYOND * (shown + dark) as f64 {
        return Err(format!(
            "this is no map of the gradient: red or green is more than blue in {} of {} pixels. Render the gradient \
             unlit and by the view transform Raw, or name the tiles as its template if it is made of them",
            beyond + dark,
            shown + dark
        )
        .into());
    }
    let near = Straight { step: 1, tolerance: 1.2e-3, least: 1e-4, across_tiles: false };
    let (found, all) = near.count(&at, seen.width);
    let is_flat = all < FEWEST && shown > MANY;
    if is_flat || (all >= FEWEST && (found as f64) < RUNS * all as f64) {
        return Err("this is no map of the gradient: its places run nowhere straight. Render the gradient unlit and by the \
                    view transform Raw, or name the tiles as its template if it is made of them"
            .into());
    }
    let mut warnings = vec![];
    if beyond > 0 {
        warnings.push(format!("{beyond} pixels lie beyond the template's border and are moved to it"));
    }
    let straight = Straight {
        step: (seen.width / 16).max(1),
        tolerance: 1.5e-4,
        least: 1.0 / 256.0,
        across_tiles: false,
    };
    let count = |curve| straight.count(&decoded(curve), seen.width).0;
    let undone = count(linear_from_encoded).max(count(encoded_from_linear));
    if undone > FEWEST && undone as f64 > STRAIGHTER * count(|part| part) as f64 {
        warnings.push(
            "a tone curve seems to have changed its numbers, so that places are shifted: read the template as Non-Color \
             (Raw) data and render with the view transform Raw"
                .into(),
        );
    }
    let place = |k: usize| {
        let (Some((at, _)), Some([_, _, blue])) = (at[k], seen.colours[k]) else {
            return SourcePlace::default();
        };
        let at = at.clamp(DVec2::ZERO, DVec2::ONE).as_vec2();
        SourcePlace { u: at.x, v: at.y, weight: (blue * seen.alpha[k]).clamp(0.0, 1.0) }
    };
    let places = (0..at.len()).map(place).collect();
    Ok(ForeignPlaces { places, has_weights: true, notes: seen.notes, warnings })
}

/// The condition by which three places in a row run straight.
struct Straight {
    /// The distance between the pixels.
    step: usize,
    /// The most by which the middle place, doubled, differs from the sum of the others.
    tolerance: f64,
    /// The least distance between the first and the last place.
    least: f64,
    /// True where only triples count that lie in more than one tile.
    across_tiles: bool,
}

impl Straight {
    /// Returns how many triples run straight, and how many there are, across and down.
    fn count(&self, places: &[Option<(DVec2, u8)>], width: usize) -> (usize, usize) {
        let (mut found, mut all) = (0, 0);
        for k in 0..places.len() {
            let across = (k % width + 2 * self.step < width).then_some(self.step);
            for step in across.into_iter().chain([self.step * width]) {
                let triple = [k, k + step, k + 2 * step].map(|k| places.get(k).copied().flatten());
                let [Some((a, first)), Some((b, middle)), Some((c, last))] = triple else { continue };
                let is_one_tile = first == middle && middle == last;
                if (self.across_tiles && is_one_tile) || (c - a).abs().max_element() < self.least {
                    continue;
                }
                all += 1;
                found += usize::from((a + c - 2.0 * b).abs().max_element() <= self.tolerance);
            }
        }
        (found, all)
    }
}
