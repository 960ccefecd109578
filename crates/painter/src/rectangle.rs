//! Draws rectangles with sides along the axes: plain ones, letters copied pixel by pixel, and stretched pictures.

use super::Canvas;
use super::area::Area;
use super::blend::{Pixel, WHOLE, alpha, lay, mixed, over, pixel, product};
use super::pieces::PaintCorner;
use super::texture::Texture;

/// Distance from a pixel's centre within which a texture may be read as though at the centre, in pixels of the texture.
const SLACK: f32 = 1.0 / 64.0;

/// Draws the part of a rectangle that lies in an area.
pub fn draw(canvas: &mut Canvas, [a, b]: &[PaintCorner; 2], texture: &Texture, area: Area) {
    let area = Area::between(a.at, b.at).cut(area);
    if area.is_empty() {
        return;
    }
    if a.uv == b.uv {
        let colour = product(a.colour, texture.at(a.uv[0], a.uv[1]));
        return (area.top..area.bottom).for_each(|y| lay(colour, canvas.row(y, area)));
    }
    let across = Line::along(a, b, 0, texture, area.left..area.right);
    let down = Line::along(a, b, 1, texture, area.top..area.bottom);
    let fill = Fill { texture, tint: a.colour, is_opaque: texture.is_opaque && alpha(a.colour) == 255 };
    match (across.whole(texture.size[0]), down.whole(texture.size[1])) {
        (Some(x), Some(y)) => fill.copy(canvas, area, x, y),
        _ => fill.stretch(canvas, area, &across, &down),
    }
}

/// The places along one axis at which a texture is read, one for each pixel of the image.
struct Line {
    /// For each pixel of the image: the texture's pixel before its place, the one after it, and the weight of the
    /// latter, 0 to [`WHOLE`].
    places: Vec<[u32; 3]>,
    /// The first place, and the step from one place to the next, in pixels of the texture.
    start: f32,
    step: f32,
}

impl Line {
    fn along(
        a: &PaintCorner,
        b: &PaintCorner,
        axis: usize,
        texture: &Texture,
        pixels: std::ops::Range<i32>,
    ) -> Self {
        let size = texture.size[axis];
        let step = (b.uv[axis] - a.uv[axis]) * size as f32 / (b.at[axis] - a.at[axis]);
        let start = a.uv[axis] * size as f32 + (pixels.start as f32 + 0.5 - a.at[axis]) * step;
        let place = |k: i32| {
            let at = start + (k - pixels.start) as f32 * step;
            if texture.is_nearest() {
                let at = texture.wrapped(at.floor() as i32, size) as u32;
                return [at, at, 0];
            }
            let before = (at - 0.5).floor();
            let weight = ((at - 0.5 - before) * WHOLE as f32 + 0.5) as u32;
            let before = before as i32;
            let wrapped = |place: i32| texture.wrapped(place, size) as u32;
            [wrapped(before), wrapped(before.saturating_add(1)), weight]
        };
        Self { places: pixels.clone().map(place).collect(), start, step }
    }

    /// Returns the texture's first pixel, if each pixel of the image falls on one of the texture's.
    fn whole(&self, size: usize) -> Option<usize> {
        let count = self.places.len();
        let off =
            (self.start - 0.5 - (self.start - 0.5).round()).abs() + (self.step - 1.0).abs() * count as f32;
        let begin = (self.start - 0.5).round();
        let is_inside = begin >= 0.0 && begin as usize + count <= size;
        (off < SLACK && is_inside).then_some(begin as usize)
    }
}

/// The filling of a rectangle: a texture, and the colour by which it is multiplied.
struct Fill<'a> {
    texture: &'a Texture,
    tint: Pixel,
    is_opaque: bool,
}

impl Fill<'_> {
    /// Lays the texture over an area pixel by pixel, from column `x` and row `y` of the texture on.
    fn copy(&self, canvas: &mut Canvas, area: Area, x: usize, y: usize) {
        let count = area.size()[0] as usize;
        for (k, row) in (area.top..area.bottom).enumerate() {
            let front = self.texture.row(y + k, x, count).iter().map(|&colour| pixel(colour));
            self.lay(front, canvas.row(row, area));
        }
    }

    /// Lays a row of the texture's pixels over a row of the image.
    #[inline(always)]
    fn lay(&self, front: impl Iterator<Item = Pixel>, back: &mut [Pixel]) {
        if self.is_opaque && self.tint == Pixel::MAX {
            return back.iter_mut().zip(front).for_each(|(back, front)| *back = front);
        }
        for (back, front) in back.iter_mut().zip(front) {
            // Most of a letter's rectangle is empty.
            if front != 0 {
                *back = over(product(self.tint, front), *back);
            }
        }
    }

    /// Lays the texture over an area, interpolated: first between the two rows beside each row, then between two columns.
    fn stretch(&self, canvas: &mut Canvas, area: Area, across: &Line, down: &Line) {
        let columns = across.places.iter().flat_map(|&[a, b, _]| [a as usize, b as usize]);
        let (Some(least), Some(most)) = (columns.clone().min(), columns.max()) else { return };
        let count = most - least + 1;
        let mut line: Vec<Pixel> = vec![0; count];
        for (&[above, below, weight], row) in down.places.iter().zip(area.top..) {
            let [above, below] = [above, below].map(|y| self.texture.row(y as usize, least, count));
            for (into, (&a, &b)) in line.iter_mut().zip(above.iter().zip(below)) {
                *into = mixed(pixel(a), pixel(b), weight);
            }
            let read = |column: u32| line[column as usize - least];
            let between = |&[a, b, weight]: &[u32; 3]| mixed(read(a), read(b), weight);
            self.lay(across.places.iter().map(between), canvas.row(row, area));
        }
    }
}
