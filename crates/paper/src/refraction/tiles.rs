//! Codes places in eight bits: blue chooses one of 16 by 16 tiles, red and green run through it.
//!
//! With bytes R, G, B of 0 to 255,
//!
//! ```text
//! u = (16 R / 255 + 16 (B >> 4)) / 255,   v = (16 G / 255 + 16 (B & 15)) / 255.
//! ```
//!
//! A tile is 16/255 wide, and R = 255 of one is R = 0 of the next. A step is 16 / 255² = 1/4064, so that rounding is off
//! by 1/8128 at most. All codes mean something: in the last tiles those above 239 lie beyond the border, up to 256/255, and
//! are not written. In numbers of 0 to 1 the formula is u = (16 r + 16 floor(16 b)) / 255 and v = (16 g + 16 mod(255 b,
//! 16)) / 255, which has two traps: b = 1 gives a seventeenth column (`B >> 4` is 15), and where 255 b comes out as
//! 31.999998, `mod` is 16 too large. Round to bytes first.

use brillianteer_picture::SourcePlace;
use glam::DVec2;

/// The number of tiles each way.
const TILES: f64 = 16.0;

/// The largest byte.
const BYTE: f64 = 255.0;

/// Returns the code of a place; a place beyond the borders is moved to them.
pub(super) fn code(at: DVec2) -> [u8; 3] {
    let (column, red) = split(at.x);
    let (row, green) = split(at.y);
    [red, green, column << 4 | row]
}

/// Returns the code of a map's pixel: black where no light comes from behind, which the weight shows.
pub fn code_of(place: &SourcePlace) -> [u8; 3] {
    if place.weight > 0.0 { code(DVec2::new(f64::from(place.u), f64::from(place.v))) } else { [0; 3] }
}

/// Returns the place of a code. Codes beyond the border stand for the border.
pub(super) fn place([red, green, blue]: [u8; 3]) -> DVec2 {
    let part = |fine: u8, tile: u8| (f64::from(fine) / BYTE + f64::from(tile)) * TILES / BYTE;
    DVec2::new(part(red, blue >> 4), part(green, blue & 15)).min(DVec2::ONE)
}

/// Splits one coordinate into its tile and the fine part.
fn split(at: f64) -> (u8, u8) {
    // NaN counts as 0.
    let tiles = if at > 0.0 { at.min(1.0) * BYTE / TILES } else { 0.0 };
    let tile = tiles.floor().min(TILES - 1.0);
    (tile as u8, ((tiles - tile) * BYTE).round() as u8)
}
