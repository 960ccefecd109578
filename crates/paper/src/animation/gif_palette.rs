//! The at most 256 colours of a frame of a GIF.
//!
//! color_quant fits them; quantette fits better, but brings 15 crates.

use color_quant::NeuQuant;
use std::cmp::Reverse;
use std::collections::HashMap;

/// The least number of places for fitted colours where a frame has too many colours: the least that the library
/// takes.
const FITTED: usize = 64;

/// The part of a frame that a colour must cover to be kept as it is, where there are too many colours: one in so many pixels.
const COVERED: u64 = 1000;

/// The library looks at every n-th pixel; 1 is all.
const EACH_PIXEL: i32 = 1;

/// The colours of a frame, and the map from each colour of its pixels to one of them.
pub(super) struct GifPalette {
    /// The colours, at most as many as were allowed.
    pub colours: Vec<[u8; 3]>,
    places: HashMap<[u8; 3], u8>,
}

impl GifPalette {
    /// Chooses at most `most` colours, 65 to 256, for these pixels.
    ///
    /// A frame with no more colours than that keeps all of them. Otherwise the colours of `exact` in the frame are
    /// kept, and then the most frequent ones, as long as each covers a thousandth of the frame and 64 places are
    /// left. So where `exact` is empty, a colour that covers at least one part in `most - 64` stays exact. The other
    /// places are fitted to the other colours, each of which becomes the nearest of all.
    pub fn of(pixels: impl Iterator<Item = [u8; 3]>, exact: &[[u8; 3]], most: usize) -> Self {
        let mut counts: HashMap<[u8; 3], u32> = HashMap::new();
        pixels.for_each(|colour| *counts.entry(colour).or_default() += 1);
        let mut found: Vec<([u8; 3], u32)> = counts.into_iter().collect();
        // The order of the colours decides among equally frequent ones, so that the same frame gives the same file.
        found.sort_unstable_by_key(|&(colour, count)| (!exact.contains(&colour), Reverse(count), colour));
        if found.len() <= most {
            return Self::standing_for(found.into_iter().map(|(colour, _)| colour).collect(), &[]);
        }
        let all: u64 = found.iter().map(|(_, count)| u64::from(*count)).sum();
        let is_kept =
            |(colour, count): &&([u8; 3], u32)| exact.contains(colour) || u64::from(*count) * COVERED >= all;
        let kept = found.iter().take(most.saturating_sub(FITTED)).take_while(is_kept).count();
        let rare = found.split_off(kept);
        let mut colours: Vec<[u8; 3]> = found.iter().map(|(colour, _)| *colour).collect();
        colours.extend(fitted(&rare, most.saturating_sub(kept)));
        Self::standing_for(colours, &rare)
    }

    /// Maps each of the rare colours to the nearest of the colours.
    fn standing_for(colours: Vec<[u8; 3]>, rare: &[([u8; 3], u32)]) -> Self {
        let mut places: HashMap<[u8; 3], u8> = HashMap::new();
        for (place, colour) in (0..=u8::MAX).zip(&colours) {
            places.entry(*colour).or_insert(place);
        }
        for (colour, _) in rare {
            let nearest = (0..=u8::MAX).zip(&colours).min_by_key(|(_, other)| distance(*colour, **other));
            places.entry(*colour).or_insert(nearest.map_or(0, |(place, _)| place));
        }
        Self { colours, places }
    }

    /// Returns the place of the colour that stands for the colour of a pixel.
    pub fn place(&self, colour: [u8; 3]) -> u8 {
        self.places.get(&colour).copied().unwrap_or(0)
    }
}

/// Fits this number of colours to rare ones, which are weighted by their frequency.
fn fitted(rare: &[([u8; 3], u32)], count: usize) -> Vec<[u8; 3]> {
    let repeated = |&([r, g, b], count): &([u8; 3], u32)| (0..count).flat_map(move |_| [r, g, b, 255]);
    let pixels: Vec<u8> = rare.iter().flat_map(repeated).collect();
    let map = NeuQuant::new(EACH_PIXEL, count, &pixels).color_map_rgb();
    map.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect()
}

/// Returns the square of the distance of two colours.
fn distance(a: [u8; 3], b: [u8; 3]) -> u32 {
    a.into_iter().zip(b).map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(palette: &GifPalette, colour: [u8; 3]) -> [u8; 3] {
        palette.colours[usize::from(palette.place(colour))]
    }

    /// Returns more colours than a GIF has, the earlier ones more frequent.
    fn many() -> Vec<[u8; 3]> {
        let of = |k: u32| [(k * 37 % 251) as u8, (k * 91 % 241) as u8, (k * 13 % 239) as u8];
        (0..1000).flat_map(|k| std::iter::repeat_n(of(k), 1 + 3000 / (k as usize + 1))).collect()
    }

    #[test]
    fn as_many_colours_as_there_is_room_for_are_exact() {
        let colours: Vec<[u8; 3]> = (0..=255).map(|k| [k, 255 - k, k / 2]).collect();
        let palette = GifPalette::of(colours.iter().copied(), &[], 256);
        assert!(colours.iter().all(|&colour| shown(&palette, colour) == colour));
        assert_eq!(palette.colours.len(), 256);
    }

    #[test]
    fn frequent_colours_and_those_that_must_be_are_exact_and_others_near() {
        let pixels = many();
        let last = *pixels.last().unwrap();
        for (exact, most) in [(vec![], 256), (vec![last, [1, 2, 3]], 255)] {
            let palette = GifPalette::of(pixels.iter().copied(), &exact, most);
            assert!(palette.colours.len() <= most);
            let mut counts: HashMap<[u8; 3], usize> = HashMap::new();
            pixels.iter().for_each(|colour| *counts.entry(*colour).or_default() += 1);
            let often = pixels.len() / (most - FITTED - exact.len());
            let frequent: Vec<_> = counts.iter().filter(|(_, count)| **count >= often).collect();
            assert!(
                frequent.len() > 20
                    && frequent.iter().all(|(colour, _)| shown(&palette, **colour) == **colour)
            );
            let errors = counts.keys().map(|&colour| f64::from(distance(colour, shown(&palette, colour))));
            let mean = errors.sum::<f64>() / counts.len() as f64;
            assert!(mean.sqrt() < 30.0, "{mean}");
            assert!(exact.is_empty() || shown(&palette, last) == last);
        }
    }

    #[test]
    fn the_same_pixels_give_the_same_colours_in_any_order() {
        let mut pixels = many();
        let first = GifPalette::of(pixels.iter().copied(), &[], 256);
        pixels.reverse();
        assert_eq!(first.colours, GifPalette::of(pixels.into_iter(), &[], 256).colours);
        assert!(GifPalette::of([].into_iter(), &[], 256).colours.is_empty());
    }
}
