//! Draws triangles. Their colours and places in a texture change evenly from corner to corner.

use super::Canvas;
use super::area::{Area, first};
use super::blend::{Pixel, lay, over, product};
use super::pieces::PaintCorner;
use super::texture::Texture;

/// Draws the part of a triangle that lies in an area: all pixels whose centres lie inside. Each such pixel along an edge
/// that two triangles share belongs to exactly one of them.
pub fn draw(canvas: &mut Canvas, corners: &[PaintCorner; 3], texture: &Texture, area: Area) {
    let mut sorted = *corners;
    sorted.sort_by(|a, b| a.at[1].total_cmp(&b.at[1]));
    let [a, b, c] = sorted;
    let [long, upper, lower] = [(a, c), (a, b), (b, c)].map(|(from, to)| Edge::new(&from, &to));
    let rows = first(a.at[1]).max(area.top)..first(c.at[1]).min(area.bottom);
    let is_one_place = a.uv == b.uv && b.uv == c.uv;
    let is_one_colour = a.colour == b.colour && b.colour == c.colour;
    let texel = texture.at(a.uv[0], a.uv[1]);
    let colours = Plane::new(&sorted, |c| c.colour.to_le_bytes().map(f32::from));
    let places = Plane::new(&sorted, |c| [c.uv[0], c.uv[1], 0.0, 0.0]);
    for y in rows {
        let middle = y as f32 + 0.5;
        let short = if middle < b.at[1] { &upper } else { &lower };
        let (p, q) = (long.at(middle), short.at(middle));
        let (left, right) = (first(p.min(q)).max(area.left), first(p.max(q)).min(area.right));
        if left >= right {
            continue;
        }
        let row = canvas.row(y, Area { left, right, top: y, bottom: y + 1 });
        let mut tints = colours.walk(left, middle);
        if is_one_place && is_one_colour {
            lay(product(a.colour, texel), row);
        } else if is_one_place {
            row.iter_mut().for_each(|back| *back = over(product(bytes(tints.next()), texel), *back));
        } else {
            let mut places = places.walk(left, middle);
            for back in row {
                let [u, v, ..] = places.next();
                *back = over(product(bytes(tints.next()), texture.at(u, v)), *back);
            }
        }
    }
}

/// An edge, from its upper end to its lower one.
struct Edge {
    from: [f32; 2],
    /// Columns per row.
    slope: f32,
}

impl Edge {
    fn new(from: &PaintCorner, to: &PaintCorner) -> Self {
        Self { from: from.at, slope: (to.at[0] - from.at[0]) / (to.at[1] - from.at[1]) }
    }

    /// Returns the edge's column at the height `y`.
    #[inline(always)]
    fn at(&self, y: f32) -> f32 {
        self.from[0] + (y - self.from[1]) * self.slope
    }
}

/// Four numbers that change evenly over the image.
struct Plane {
    at: [f32; 2],
    value: [f32; 4],
    across: [f32; 4],
    down: [f32; 4],
    least: [f32; 4],
    most: [f32; 4],
}

impl Plane {
    /// Returns the plane through the numbers that `of` gives for three corners.
    fn new([a, b, c]: &[PaintCorner; 3], of: impl Fn(&PaintCorner) -> [f32; 4]) -> Self {
        let (u, v) = (apart(a, b), apart(a, c));
        let doubled = u[0] * v[1] - u[1] * v[0];
        let [p, q, r] = [of(a), of(b), of(c)];
        let each = |f: &dyn Fn(usize) -> f32| std::array::from_fn(f);
        Self {
            at: a.at,
            value: p,
            across: each(&|k| ((q[k] - p[k]) * v[1] - (r[k] - p[k]) * u[1]) / doubled),
            down: each(&|k| ((r[k] - p[k]) * u[0] - (q[k] - p[k]) * v[0]) / doubled),
            least: each(&|k| p[k].min(q[k]).min(r[k])),
            most: each(&|k| p[k].max(q[k]).max(r[k])),
        }
    }

    /// Starts a walk along a row, at the centre of a column.
    #[inline(always)]
    fn walk(&self, column: i32, y: f32) -> Walk<'_> {
        let (x, y) = (column as f32 + 0.5 - self.at[0], y - self.at[1]);
        let next = std::array::from_fn(|k| self.value[k] + x * self.across[k] + y * self.down[k]);
        Walk { plane: self, next }
    }
}

fn apart(a: &PaintCorner, b: &PaintCorner) -> [f32; 2] {
    [b.at[0] - a.at[0], b.at[1] - a.at[1]]
}

/// The numbers of a plane, pixel by pixel along a row.
struct Walk<'a> {
    plane: &'a Plane,
    next: [f32; 4],
}

impl Walk<'_> {
    /// Returns the numbers of the next pixel. They are kept between those of the corners, because a sliver is too thin to
    /// determine its plane.
    #[inline(always)]
    fn next(&mut self) -> [f32; 4] {
        let Plane { least, most, across, .. } = self.plane;
        let here = std::array::from_fn(|k| self.next[k].max(least[k]).min(most[k]));
        self.next = std::array::from_fn(|k| self.next[k] + across[k]);
        here
    }
}

/// Returns the nearest colour in bytes.
#[inline(always)]
fn bytes(of: [f32; 4]) -> Pixel {
    u32::from_le_bytes(of.map(|c| (c + 0.5) as u8))
}
