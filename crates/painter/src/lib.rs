//! Paints the window on the processor, where there is no graphics card: turns egui's triangles into an image in memory.
//!
//! Only what differs from the last image is painted: `damage` finds the areas, by a hash of all pieces that are seen in
//! each tile of the image. The image is that of egui's painter for graphics cards, except for rounding; the tests say how
//! much rounding may change.
//!
//! Other painters on the processor were no match: egui_software_backend 0.0.3 paints everything anew when one mesh
//! changes, a whole panel with each number; dream-soft-render 1.0 has no linear filter and at most 1280 × 720
//! pixels.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

mod area;
mod blend;
mod damage;
mod pieces;
mod rectangle;
mod texture;
mod triangle;

#[cfg(test)]
mod tests;

pub use area::Area;
pub use blend::Pixel;

use blend::pixel;
use damage::Tiles;
use egui::epaint::ClippedPrimitive;
use egui::{Color32, TexturesDelta};
use pieces::{PaintPiece, PaintShape, pieces};
use texture::Textures;

/// The colour behind everything. The window's panels cover it completely.
const BEHIND: Color32 = Color32::BLACK;

/// An image in memory.
#[derive(Default)]
pub struct Canvas {
    size: [usize; 2],
    pixels: Vec<Pixel>,
}

impl Canvas {
    /// The number of columns and rows.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Returns all pixels, row by row.
    pub fn pixels(&self) -> &[Pixel] {
        &self.pixels
    }

    /// Returns the part of row `y` that lies in an area. The area must lie in the image.
    #[inline(always)]
    fn row(&mut self, y: i32, area: Area) -> &mut [Pixel] {
        let start = y as usize * self.size[0];
        &mut self.pixels[start + area.left as usize..start + area.right as usize]
    }

    /// Returns the rows of an area. The area must lie in the image.
    pub fn rows(&self, area: Area) -> impl Iterator<Item = &[Pixel]> {
        (area.top..area.bottom).map(move |y| {
            let start = y as usize * self.size[0];
            &self.pixels[start + area.left as usize..start + area.right as usize]
        })
    }
}

/// Paints one image after the other, and keeps the last one, so that only changes are painted.
#[derive(Default)]
pub struct Painter {
    canvas: Canvas,
    textures: Textures,
    tiles: Tiles,
    pieces: Vec<PaintPiece>,
}

impl Painter {
    /// Takes over changed textures, and forgets those that are freed, without painting.
    pub fn take_textures(&mut self, delta: &mut TexturesDelta) {
        self.textures.set(delta);
        self.textures.free(delta);
    }

    /// Paints egui's primitives into an image of `size` pixels and returns the areas that have changed since the last image.
    /// The areas do not overlap. The changes of textures are moved out of `delta`, which is empty afterwards.
    pub fn paint(
        &mut self,
        size: [usize; 2],
        pixels_per_point: f32,
        primitives: &[ClippedPrimitive],
        delta: &mut TexturesDelta,
    ) -> Vec<Area> {
        let patches = self.textures.set(delta);
        if self.canvas.size != size {
            self.canvas = Canvas { size, pixels: vec![pixel(BEHIND); size[0] * size[1]] };
        }
        pieces(size, pixels_per_point, primitives, &mut self.pieces);
        let areas = self.tiles.changed(size, &self.pieces, &self.textures, &patches);
        areas.iter().for_each(|&area| self.draw(area));
        self.textures.free(delta);
        areas
    }

    /// Returns the last image.
    pub fn canvas(&self) -> &Canvas {
        &self.canvas
    }

    fn draw(&mut self, area: Area) {
        let Self { canvas, textures, pieces, .. } = self;
        (area.top..area.bottom).for_each(|y| canvas.row(y, area).fill(pixel(BEHIND)));
        for piece in pieces {
            let seen = piece.bounds.cut(area);
            if seen.is_empty() {
                continue;
            }
            let Some(texture) = textures.get(piece.texture) else { continue };
            match &piece.shape {
                PaintShape::Rectangle(corners) => rectangle::draw(canvas, corners, texture, seen),
                PaintShape::Triangle(corners) => triangle::draw(canvas, corners, texture, seen),
            }
        }
    }
}
