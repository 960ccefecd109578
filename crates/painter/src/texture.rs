//! The textures: pictures that fill rectangles and triangles.

use super::blend::{Pixel, WHOLE, mixed, pixel};
use egui::epaint::{ImageData, ImageDelta};
use egui::{Color32, ColorImage, TextureFilter, TextureId, TextureOptions, TextureWrapMode, TexturesDelta};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A picture in the memory of the processor.
pub struct Texture {
    /// The number of columns and rows.
    pub size: [usize; 2],
    /// The pixels, row by row. They are shared with the code that made the picture, so that nothing is copied.
    image: Arc<ColorImage>,
    /// The filter between pixels and the rule beyond the picture's edge.
    pub options: TextureOptions,
    /// True where all pixels are known to be opaque.
    pub is_opaque: bool,
    /// A number that no other picture has. It changes when the whole picture is replaced.
    pub version: u64,
}

/// A part of a texture that was replaced: the texture, the part's first column and row, and those after its last.
pub type TexturePatch = (TextureId, [f32; 2], [f32; 2]);

/// The textures that egui has made, by their names.
#[derive(Default)]
pub struct Textures {
    all: BTreeMap<TextureId, Texture>,
    versions: u64,
}

impl Textures {
    /// Returns the texture of this name.
    pub fn get(&self, id: TextureId) -> Option<&Texture> {
        self.all.get(&id)
    }

    /// Applies egui's changes to the textures, and returns the parts of textures that were replaced.
    pub fn set(&mut self, delta: &mut TexturesDelta) -> Vec<TexturePatch> {
        let mut patches = vec![];
        for (id, deltas) in delta.set.drain() {
            for delta in deltas {
                patches.extend(self.change(id, delta));
            }
        }
        patches
    }

    /// Drops the textures that are no longer used. Call this after painting, which may use them a last time.
    pub fn free(&mut self, delta: &mut TexturesDelta) {
        for id in delta.free.drain() {
            self.all.remove(&id);
        }
    }

    fn change(&mut self, id: TextureId, delta: ImageDelta) -> Option<TexturePatch> {
        let ImageData::Color(image) = &delta.image;
        let [across, down] = image.size;
        if image.pixels.len() != across * down || image.pixels.is_empty() {
            return None;
        }
        let Some([x, y]) = delta.pos else {
            self.versions += 1;
            let is_opaque = image.pixels.iter().all(|colour| colour.a() == 255);
            let (options, version) = (delta.options, self.versions);
            let texture = Texture { size: image.size, image: Arc::clone(image), options, is_opaque, version };
            self.all.insert(id, texture);
            return None;
        };
        let texture = self.all.get_mut(&id)?;
        texture.options = delta.options;
        // A part that does not fit is ignored; egui sends none.
        if x + across > texture.size[0] || y + down > texture.size[1] {
            return None;
        }
        let into = &mut Arc::make_mut(&mut texture.image).pixels;
        for (row, colours) in image.pixels.chunks_exact(across).enumerate() {
            let start = (y + row) * texture.size[0] + x;
            into[start..start + across].copy_from_slice(colours);
        }
        texture.is_opaque &= image.pixels.iter().all(|colour| colour.a() == 255);
        Some((id, [x as f32, y as f32], [(x + across) as f32, (y + down) as f32]))
    }
}

impl Texture {
    /// Returns `count` pixels of row `y` from column `x` on. They must lie in the picture.
    pub fn row(&self, y: usize, x: usize, count: usize) -> &[Color32] {
        let start = y * self.size[0] + x;
        &self.image.pixels[start..start + count]
    }

    /// Returns whether the picture is read at its nearest pixel, without interpolation.
    pub fn is_nearest(&self) -> bool {
        self.options.magnification == TextureFilter::Nearest
    }

    /// Returns the colour at a place, 0 to 1 across and down.
    pub fn at(&self, u: f32, v: f32) -> Pixel {
        // Egui keeps a white pixel at this place, and fills most of its shapes with it.
        if (u, v) == (0.0, 0.0) && self.options.wrap_mode == TextureWrapMode::ClampToEdge {
            return self.image.pixels.first().map_or(0, |&colour| pixel(colour));
        }
        let (x, y) = (u * self.size[0] as f32, v * self.size[1] as f32);
        if self.is_nearest() {
            return self.texel(x.floor() as i32, y.floor() as i32);
        }
        let (x, y) = (x - 0.5, y - 0.5);
        let (column, row) = (x.floor(), y.floor());
        let weight = |part: f32| (part * WHOLE as f32 + 0.5) as u32;
        let (across, down) = (weight(x - column), weight(y - row));
        let (column, row) = (column as i32, row as i32);
        let line =
            |row: i32| mixed(self.texel(column, row), self.texel(column.saturating_add(1), row), across);
        mixed(line(row), line(row.saturating_add(1)), down)
    }

    /// Returns the pixel of a column and a row, which may lie beyond the edge.
    fn texel(&self, column: i32, row: i32) -> Pixel {
        let (x, y) = (self.wrapped(column, self.size[0]), self.wrapped(row, self.size[1]));
        self.image.pixels.get(y * self.size[0] + x).map_or(0, |&colour| pixel(colour))
    }

    /// Returns the column or row inside the picture that stands for `place`, which may lie beyond the edge.
    pub fn wrapped(&self, place: i32, size: usize) -> usize {
        let size = size.max(1) as i32;
        let inside = match self.options.wrap_mode {
            TextureWrapMode::ClampToEdge => place.clamp(0, size - 1),
            TextureWrapMode::Repeat => place.rem_euclid(size),
            TextureWrapMode::MirroredRepeat => {
                let place = place.rem_euclid(2 * size);
                place.min(2 * size - 1 - place)
            }
        };
        inside as usize
    }
}
