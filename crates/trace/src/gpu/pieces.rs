//! Divides the work of a strip of pixels into dispatches.
//!
//! The tiles of a dispatch come from everywhere in the strip, so that one over the stone is no heavier than one
//! before it over the background. Each wavelength is summed alone and in order, so a picture is the same to the bit
//! however its work is divided.

use std::ops::Range;

/// The number of tiles that occupy any card fully. A dispatch that may take more work takes more wavelengths only
/// beyond that number.
const FULL: u64 = 4096;

/// The work of one dispatch: some tiles of pixels, in some bands of wavelengths each.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Piece {
    pub tiles: Range<u32>,
    pub bands: Range<u32>,
}

/// The work that is left of a strip. Each tile gets its bands in ascending order, however the work is divided.
pub(super) struct Pieces {
    waiting: Vec<Piece>,
    bands_at_once: u32,
}

impl Pieces {
    /// Returns all work of a strip, for dispatches of at most `bands_at_once` bands.
    pub fn new(tiles: u32, bands: u32, bands_at_once: u32) -> Self {
        Self {
            waiting: vec![Piece { tiles: 0..tiles, bands: 0..bands }],
            bands_at_once: bands_at_once.max(1),
        }
    }

    /// Takes the next piece. Its size is at most `most`, counted in tiles times bands, but at least 1. `None` when
    /// all work is done.
    pub fn next(&mut self, most: f64) -> Option<Piece> {
        let Piece { tiles, bands } = self.waiting.pop().filter(|all| all.size() > 0)?;
        let (most, all) = ((most as u64).max(1), u64::from(tiles.end - tiles.start));
        let widest = u64::from((bands.end - bands.start).min(self.bands_at_once));
        let wide = (most / all.min(FULL)).clamp(1, widest);
        let wide = even(u64::from(bands.end - bands.start), wide);
        let many = even(all, (most / u64::from(wide)).clamp(1, all));
        let (tile, band) = (tiles.start + many, bands.start + wide);
        if tile < tiles.end {
            self.waiting.push(Piece { tiles: tile..tiles.end, bands: bands.clone() });
        }
        if band < bands.end {
            self.waiting.push(Piece { tiles: tiles.start..tile, bands: band..bands.end });
        }
        Some(Piece { tiles: tiles.start..tile, bands: bands.start..band })
    }
}

impl Piece {
    /// Returns the number of its tiles times that of its bands.
    pub fn size(&self) -> u64 {
        u64::from(self.tiles.end - self.tiles.start) * u64::from(self.bands.end - self.bands.start)
    }
}

/// Returns the size of a part where `all` is divided into as few parts of at most `most` as possible, all about equal.
fn even(all: u64, most: u64) -> u32 {
    all.div_ceil(all.div_ceil(most)) as u32
}

/// Returns a number that shares no divisor with `count` and is about 0.618 of it, where the product of both fits into
/// 32 bits. Its multiples, modulo `count`, are all numbers below `count`, and successive ones are spread evenly. So
/// each dispatch takes tiles from everywhere in the strip and is about as heavy as the one before.
pub(super) fn stride(count: u32) -> u32 {
    let most = f64::from(u32::MAX) / f64::from(count.max(1));
    let golden = (0.618_034 * f64::from(count)).min(most) as u32;
    (1..=golden).rev().find(|&step| divisor(step, count) == 1).unwrap_or(1)
}

/// Returns the greatest common divisor.
fn divisor(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn pieces_are_all_the_work_once_with_bands_in_rising_order(
            (tiles, bands) in (1_u32..60, 1_u32..40),
            at_once in 1_u32..17,
            limits in prop::collection::vec(0.0..500.0_f64, 1..20),
        ) {
            let mut pieces = Pieces::new(tiles, bands, at_once);
            let mut next = vec![0; tiles as usize];
            for &most in limits.iter().cycle() {
                let Some(piece) = pieces.next(most) else { break };
                prop_assert!(piece.size() as f64 <= most.max(1.0) && piece.size() > 0);
                prop_assert!(piece.bands.end - piece.bands.start <= at_once);
                for tile in piece.tiles {
                    prop_assert_eq!(next[tile as usize], piece.bands.start);
                    next[tile as usize] = piece.bands.end;
                }
            }
            prop_assert!(next.iter().all(|&band| band == bands));
        }

        #[test]
        fn strides_reach_every_tile(count in 1_u32..5000) {
            let step = stride(count);
            let mut reached: Vec<u32> = (0..count).map(|k| k * step % count).collect();
            reached.sort_unstable();
            prop_assert!(reached.into_iter().eq(0..count));
        }

        #[test]
        fn strides_do_not_overflow(count in 1_u32..u32::MAX) {
            let step = stride(count);
            prop_assert!(divisor(step, count) == 1 && (count - 1).checked_mul(step).is_some());
        }
    }

    #[test]
    fn a_sixteenth_of_the_tiles_is_a_fair_sample_of_the_strip() {
        let count = 32 * 32;
        let taken: Vec<u32> = (0..count / 16).map(|k| k * stride(count) % count).collect();
        for quarter in 0..4 {
            let own = taken.iter().filter(|&&tile| tile / (count / 4) == quarter).count();
            assert!((15..=17).contains(&own), "{own} of 64 in quarter {quarter}");
        }
    }

    #[test]
    fn a_small_limit_takes_fewer_bands_before_fewer_tiles_than_fill_a_card() {
        let piece = Pieces::new(20_000, 16, 16).next(40_000.0).unwrap();
        assert_eq!((piece.tiles.end, piece.bands.end), (5000, 8));
        let piece = Pieces::new(20_000, 16, 16).next(1000.0).unwrap();
        assert_eq!((piece.tiles.end, piece.bands.end), (1000, 1));
    }
}
