//! Packs the places and weights of a map for a page, in fewer bytes than PNG and with the numbers of its tiles.
//!
//! Each number is predicted, and what remains is small nearly everywhere. The first band of a place is predicted from the
//! pixel to the left. The last is predicted from the first, and those between from the two bands around them: the
//! place moves along a straight line as the wavelength changes, as long as the path stays the same. [`Step`] says which
//! bands. The remainders are written as one byte each, those that do not fit as 255 and two bytes at the end. These bytes,
//! three in each pixel, are a PNG, which browsers inflate before the page counts as loaded. `page.html` undoes this.

use super::tiles;
use brillianteer_picture::{MapBand, RefractionMap};
use png::{ColorType, Compression, Encoder, EncodingError, Filter};
use std::io;

/// Places farther apart than this, in steps of the tiles, are of different paths. The page has the same number.
const SAME_PATH: i32 = 300;

/// The number of parts into which the way between two bands is divided, for the place of a third.
const PARTS: i32 = 1024;

/// Places nearer than this, in steps, do not show how the way is divided.
const CLOSE: i32 = 8;

/// The remainder that stands for two bytes at the end.
const ESCAPE: u8 = 255;

/// The prediction of one band.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Step {
    band: usize,
    /// The bands that it is predicted from: none, one twice, or two.
    from: Option<[usize; 2]>,
    /// The part of the way from the first to the second at which the band lies, in parts of 1024.
    part: i32,
}

/// The numbers of a band as tiles hold them: u and v in steps of 1/4064, and the weight in parts of 255.
type Planes = [Vec<i32>; 3];

/// The data by which a page unpacks a band.
pub(super) struct PackedBand {
    /// The bytes of a PNG file whose pixels are the remainders of the prediction.
    pub png: Vec<u8>,
    /// The number of the band, the numbers of those it is predicted from, or -1, and the part of the way between them in
    /// parts of 1024.
    pub step: [i32; 4],
}

/// Packs the bands of a map, in an order in which each comes after those it is predicted from. A map of one band has no
/// weights of its own.
///
/// # Errors
/// Fails where the map lacks pixels.
pub(super) fn packed(map: &RefractionMap) -> Result<Vec<PackedBand>, EncodingError> {
    let [width, height] = map.size.map(|side| side as usize);
    let is_whole = |band: &MapBand| band.places.len() == width * height;
    if map.bands.is_empty() || width * height == 0 || !map.bands.iter().all(is_whole) {
        return Err(io::Error::other("the map lacks pixels").into());
    }
    let count = if map.bands.len() > 1 { 3 } else { 2 };
    let asked: Vec<Planes> = map.bands.iter().map(planes).collect();
    let mut found: Vec<Planes> = asked.clone();
    let pack = |step: Step| {
        let step = Step { part: step.from.map_or(0, |from| part(&asked, step.band, from)), ..step };
        let bytes = remainders(&mut found, step, &map.bands[step.band], (count, width));
        let [a, b] = step.from.map_or([-1; 2], |from| from.map(|band| band as i32));
        Ok(PackedBand { png: as_png(bytes, map.size[0])?, step: [step.band as i32, a, b, step.part] })
    };
    order(&map.bands).into_iter().map(pack).collect()
}

/// Returns the remainders of a band's prediction. A pixel that shows nothing may have any place, so its place becomes
/// the predicted one, which costs least.
fn remainders(found: &mut [Planes], step: Step, band: &MapBand, (count, width): (usize, usize)) -> Vec<u8> {
    let (mut low, mut high) = (vec![], vec![]);
    for plane in 0..count {
        for (k, place) in band.places.iter().enumerate() {
            let guess = predicted(found, step, plane, k, width);
            if plane < 2 && place.weight <= 0.0 {
                found[step.band][plane][k] = guess;
            }
            let rest = found[step.band][plane][k] - guess;
            let folded = if rest < 0 { -2 * rest - 1 } else { 2 * rest };
            match u8::try_from(folded) {
                Ok(byte) if byte != ESCAPE => low.push(byte),
                _ => {
                    low.push(ESCAPE);
                    high.extend((folded as u16).to_le_bytes());
                }
            }
        }
    }
    low.extend(high);
    low
}

/// Writes bytes as the pixels of a picture of a width.
fn as_png(mut bytes: Vec<u8>, width: u32) -> Result<Vec<u8>, EncodingError> {
    let row = 3 * width as usize;
    bytes.resize(bytes.len().next_multiple_of(row), 0);
    let mut out = vec![];
    let mut encoder = Encoder::new(&mut out, width, (bytes.len() / row) as u32);
    encoder.set_color(ColorType::Rgb);
    encoder.set_compression(Compression::High);
    // The remainders have no similarity with their neighbours.
    encoder.set_filter(Filter::NoFilter);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&bytes)?;
    writer.finish()?;
    Ok(out)
}

fn planes(band: &MapBand) -> Planes {
    let code = |fine: u8, tile: u8| i32::from(fine) + 255 * i32::from(tile);
    let codes: Vec<[u8; 3]> = band.places.iter().map(tiles::code_of).collect();
    [
        codes.iter().map(|&[red, _, blue]| code(red, blue >> 4)).collect(),
        codes.iter().map(|&[_, green, blue]| code(green, blue & 15)).collect(),
        band.places.iter().map(|place| (place.weight.clamp(0.0, 1.0) * 255.0).round() as i32).collect(),
    ]
}

/// Returns the bands in the order in which they are packed, each after those that it is predicted from.
fn order(bands: &[MapBand]) -> Vec<Step> {
    // Several places of a pixel are bands one after the other, with the same wavelength.
    let places = bands.iter().take_while(|band| band.nm == bands[0].nm).count();
    let mut steps = vec![];
    for place in 0..places {
        let strand: Vec<usize> = (place..bands.len()).step_by(places).collect();
        let last = strand.len() - 1;
        steps.push(Step { band: strand[0], from: None, part: 0 });
        if last > 0 {
            steps.push(Step { band: strand[last], from: Some([strand[0]; 2]), part: 0 });
        }
        let mut ranges = std::collections::VecDeque::from([(0, last)]);
        while let Some((low, high)) = ranges.pop_front() {
            if high - low > 1 {
                let middle = usize::midpoint(low, high);
                steps.push(Step { band: strand[middle], from: Some([strand[low], strand[high]]), part: 0 });
                ranges.extend([(low, middle), (middle, high)]);
            }
        }
    }
    steps
}

/// Returns the part of the way between two bands at which another lies: the one that fits the places of the same path
/// best.
fn part(planes: &[Planes], band: usize, [a, b]: [usize; 2]) -> i32 {
    let (mut along, mut all) = (0_i64, 0_i64);
    for ((a, b), own) in planes[a].iter().zip(&planes[b]).zip(&planes[band]).take(2) {
        for ((&a, &b), &own) in a.iter().zip(b).zip(own) {
            let way = b - a;
            let is_between = (a.min(b) - CLOSE..=a.max(b) + CLOSE).contains(&own);
            if (CLOSE..SAME_PATH).contains(&way.abs()) && is_between {
                along += i64::from(own - a) * i64::from(way);
                all += i64::from(way) * i64::from(way);
            }
        }
    }
    (along * i64::from(PARTS) / all.max(1)).clamp(0, i64::from(PARTS)) as i32
}

/// Predicts a number from those that were packed before. The page does the same.
fn predicted(planes: &[Planes], step: Step, plane: usize, k: usize, width: usize) -> i32 {
    let Some([a, b]) = step.from else {
        let before = if !k.is_multiple_of(width) { k.checked_sub(1) } else { k.checked_sub(width) };
        return before.map_or(0, |k| planes[step.band][plane][k]);
    };
    let way = |plane: usize| planes[b][plane][k] - planes[a][plane][k];
    let is_one_path = way(0).abs() < SAME_PATH && way(1).abs() < SAME_PATH;
    // A shift to the right rounds down, in Rust as in JavaScript.
    let moved = if is_one_path { (step.part * way(plane) + PARTS / 2) >> 10 } else { 0 };
    planes[a][plane][k] + moved
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_picture::{Linear, SourcePlace};
    use glam::DMat3;

    /// Unpacks a map as the page does.
    fn unpacked(packed: &[PackedBand], pixels: usize, width: usize) -> Vec<Planes> {
        let count = if packed.len() > 1 { 3 } else { 2 };
        let mut planes = vec![[0; 3].map(|zero| vec![zero; pixels]); packed.len()];
        for PackedBand { png, step: [band, a, b, part] } in packed {
            let mut reader = png::Decoder::new(io::Cursor::new(png)).read_info().unwrap();
            let mut raw = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut raw).unwrap();
            let mut escaped = raw[count * pixels..].as_chunks().0.iter();
            let mut low = raw.iter();
            let from = (*a >= 0).then_some([*a as usize, *b as usize]);
            let step = Step { band: *band as usize, from, part: *part };
            for plane in 0..count {
                for k in 0..pixels {
                    let folded = match *low.next().unwrap() {
                        ESCAPE => i32::from(u16::from_le_bytes(*escaped.next().unwrap())),
                        byte => i32::from(byte),
                    };
                    let rest = if folded % 2 == 1 { -(folded + 1) / 2 } else { folded / 2 };
                    planes[step.band][plane][k] = predicted(&planes, step, plane, k, width) + rest;
                }
            }
        }
        planes
    }

    #[test]
    fn what_is_packed_comes_back_to_the_step() {
        for (bands, places) in [(1, 1), (2, 1), (5, 1), (8, 1), (3, 2), (1, 4)] {
            let band = |number: usize| {
                let place = |k: usize| {
                    let part = |step: f64| ((k + number / places) as f64 * step).fract() as f32;
                    let weight = if k % 7 == 3 { 0.0 } else { part(0.569_840) };
                    SourcePlace { u: part(0.618_034), v: [part(0.754_877), 1.0, 0.0][k % 3], weight }
                };
                let nm = 400.0 + (number / places) as f64;
                MapBand { nm, response: DMat3::IDENTITY, places: (0..31 * 17).map(place).collect() }
            };
            let bands: Vec<MapBand> = (0..bands * places).map(band).collect();
            let map = RefractionMap { size: [31, 17], bands, diffuse: Linear::new(31, 17) };
            let packed = packed(&map).unwrap();
            let mut steps: Vec<i32> = packed.iter().map(|band| band.step[0]).collect();
            steps.sort_unstable();
            assert_eq!(steps, (0..map.bands.len() as i32).collect::<Vec<_>>());
            for (band, found) in map.bands.iter().zip(unpacked(&packed, 31 * 17, 31)) {
                let wanted = planes(band);
                for k in (0..31 * 17).filter(|&k| band.places[k].weight > 0.0) {
                    assert_eq!([found[0][k], found[1][k]], [wanted[0][k], wanted[1][k]]);
                }
                assert!(map.bands.len() == 1 || found[2] == wanted[2]);
            }
        }
    }

    #[test]
    fn bands_between_two_others_cost_a_fraction_of_their_tiles() {
        let band = |number: u32| {
            let nm = 400.0 + f64::from(number);
            // Straight lines on many small facets, which the wavelength shifts.
            let place = |k: u32| {
                let mixed = (k / 4).wrapping_mul(2_654_435_761);
                let facet = f64::from((mixed ^ (mixed >> 15)).wrapping_mul(2_246_822_519) >> 16) / 131_072.0;
                let shift = f64::from(number * number) * 2e-4 * (1.0 + facet);
                let at = facet + f64::from(k % 120) / 400.0 + shift;
                SourcePlace { u: at as f32, v: (at * 0.7) as f32, weight: 0.5 }
            };
            MapBand { nm, response: DMat3::IDENTITY, places: (0..120 * 90).map(place).collect() }
        };
        let map = RefractionMap {
            size: [120, 90],
            bands: (0..5).map(band).collect(),
            diffuse: Linear::new(120, 90),
        };
        let alone = RefractionMap { bands: vec![band(2)], ..map.clone() };
        let own = packed(&alone).unwrap()[0].png.len();
        let all = packed(&map).unwrap();
        let found = all.iter().find(|band| band.step[0] == 2).unwrap();
        assert_eq!(found.step[1..3], [0, 4]);
        assert!(2 * found.png.len() < own, "{} bytes between two bands, {own} alone", found.png.len());
        assert!(packed(&RefractionMap { size: [121, 90], ..map }).is_err());
    }
}
