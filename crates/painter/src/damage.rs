//! Finds the areas that have to be painted again. The image is divided into tiles, and each tile has a hash of all
//! pieces that are visible in it.

use super::area::Area;
use super::pieces::{PaintPiece, combined};
use super::texture::{Texture, TexturePatch, Textures};

/// Width and height of a tile, in pixels: high enough for a line of letters.
const TILE: [i32; 2] = [64, 32];

/// The tiles of an image, and the hash of each for this image and for the last one.
#[derive(Default)]
pub struct Tiles {
    size: [usize; 2],
    across: usize,
    hashes: Vec<u64>,
    last: Vec<u64>,
}

/// A hash that no tile ever has. It marks a tile of unknown content.
const UNKNOWN: u64 = 0;

impl Tiles {
    /// Returns the areas in which these pieces differ from those of the last call. The areas do not overlap. Where
    /// the image has changed its size, they cover all of it.
    pub fn changed(
        &mut self,
        size: [usize; 2],
        pieces: &[PaintPiece],
        textures: &Textures,
        patches: &[TexturePatch],
    ) -> Vec<Area> {
        let [across, down] = [size[0].div_ceil(TILE[0] as usize), size[1].div_ceil(TILE[1] as usize)];
        if self.size != size {
            *self = Self { size, across, hashes: vec![], last: vec![UNKNOWN; across * down] };
        }
        self.hashes.clear();
        self.hashes.resize(across * down, 1);
        for piece in pieces {
            let texture = textures.get(piece.texture);
            let hash = combined(piece.hash, texture.map_or(0, |t| t.version));
            let is_patched = texture.is_some_and(|texture| reads_one_of(piece, texture, patches));
            self.add(piece.bounds, hash, is_patched);
        }
        let areas = self.differing();
        std::mem::swap(&mut self.hashes, &mut self.last);
        areas
    }

    /// Adds the hash of a piece to all tiles that its area touches.
    fn add(&mut self, area: Area, hash: u64, is_patched: bool) {
        let columns = (area.left / TILE[0]) as usize..=((area.right - 1) / TILE[0]) as usize;
        for row in area.top / TILE[1]..=(area.bottom - 1) / TILE[1] {
            let start = row as usize * self.across;
            for tile in start + columns.start()..=start + columns.end() {
                self.hashes[tile] = combined(self.hashes[tile], hash).max(1);
                if is_patched {
                    self.last[tile] = UNKNOWN;
                }
            }
        }
    }

    /// Returns the tiles whose hash differs from the last one, joined into areas: first along rows, then downward where
    /// areas are equally wide.
    fn differing(&self) -> Vec<Area> {
        let whole = Area::of(self.size);
        let mut areas: Vec<Area> = vec![];
        let rows = self.hashes.chunks(self.across.max(1)).zip(self.last.chunks(self.across.max(1)));
        for (row, (hashes, last)) in rows.enumerate() {
            let differs = |column: usize| hashes.get(column) != last.get(column);
            let mut column = 0;
            while column < hashes.len() {
                let start = column;
                while column < hashes.len() && differs(column) {
                    column += 1;
                }
                if column > start {
                    let (top, bottom) = (row as i32 * TILE[1], (row as i32 + 1) * TILE[1]);
                    let (left, right) = (start as i32 * TILE[0], column as i32 * TILE[0]);
                    let area = Area { left, top, right, bottom }.cut(whole);
                    let is_below =
                        |a: &&mut Area| (a.left, a.right, a.bottom) == (area.left, area.right, top);
                    match areas.iter_mut().find(is_below) {
                        Some(above) => above.bottom = area.bottom,
                        None => areas.push(area),
                    }
                }
                column += 1;
            }
        }
        areas
    }
}

/// Returns whether a piece shows a part of its texture that has been replaced since the last image.
fn reads_one_of(piece: &PaintPiece, texture: &Texture, patches: &[TexturePatch]) -> bool {
    let mut patches = patches.iter().filter(|(id, ..)| *id == piece.texture).peekable();
    if patches.peek().is_none() {
        return false;
    }
    let (least, most) = piece.shape.read();
    // Interpolation reads the neighbouring pixels too.
    let scale = |uv: f32, axis: usize, by: f32| uv * texture.size[axis] as f32 + by;
    patches.any(|(_, first, end)| {
        (0..2).all(|k| scale(least[k], k, -1.0) < end[k] && scale(most[k], k, 1.0) > first[k])
    })
}
