//! Takes egui's meshes apart into rectangles and triangles, measured in pixels.

use super::area::Area;
use super::blend::{Pixel, pixel};
use egui::TextureId;
use egui::epaint::{ClippedPrimitive, Mesh, Primitive, Vertex};

/// A corner of a triangle or rectangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaintCorner {
    /// The place of the corner in the image, in pixels from the top left.
    pub at: [f32; 2],
    /// The place of the corner in the texture, 0 to 1 across and down.
    pub uv: [f32; 2],
    /// The colour by which the texture is multiplied.
    pub colour: Pixel,
}

/// A shape that is drawn as a whole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PaintShape {
    /// A rectangle of one colour with its sides along the axes, by its top left and bottom right corners.
    Rectangle([PaintCorner; 2]),
    /// A triangle, its corners in any order.
    Triangle([PaintCorner; 3]),
}

/// A shape with its texture and the area in which it is seen.
#[derive(Debug, Clone, Copy)]
pub struct PaintPiece {
    pub shape: PaintShape,
    /// The texture that fills the shape.
    pub texture: TextureId,
    /// The area in which the shape can be seen: its bounding box within its clip rectangle.
    pub bounds: Area,
    /// A hash of the shape, its clip and the texture's name, but not of the texture's content.
    pub hash: u64,
}

/// Fills `into` with the pieces that can be seen in an image of this size, from back to front.
pub fn pieces(
    size: [usize; 2],
    pixels_per_point: f32,
    primitives: &[ClippedPrimitive],
    into: &mut Vec<PaintPiece>,
) {
    into.clear();
    for ClippedPrimitive { clip_rect, primitive } in primitives {
        // A callback draws on a graphics card; this program uses none.
        let Primitive::Mesh(mesh) = primitive else { continue };
        let edge = |points: f32| (points * pixels_per_point).round() as i32;
        let (least, most) = (clip_rect.min, clip_rect.max);
        let clip =
            Area { left: edge(least.x), top: edge(least.y), right: edge(most.x), bottom: edge(most.y) };
        let clip = clip.cut(Area::of(size));
        if !clip.is_empty() {
            of_mesh(mesh, pixels_per_point, clip, into);
        }
    }
}

fn of_mesh(mesh: &Mesh, pixels_per_point: f32, clip: Area, into: &mut Vec<PaintPiece>) {
    let corner = |index: u32| {
        let Vertex { pos, uv, color } = *mesh.vertices.get(index as usize)?;
        let at = [pos.x * pixels_per_point, pos.y * pixels_per_point];
        let is_number = at.iter().chain(&[uv.x, uv.y]).all(|n| n.is_finite());
        is_number.then_some(PaintCorner { at, uv: [uv.x, uv.y], colour: pixel(color) })
    };
    let seed = start(clip, mesh.texture_id);
    let mut rest = mesh.indices.as_slice();
    while let [a, b, c, after @ ..] = rest {
        rest = after;
        let (Some(p), Some(q), Some(r)) = (corner(*a), corner(*b), corner(*c)) else { continue };
        let mut shape = PaintShape::Triangle([p, q, r]);
        if let [d, e, f, beyond @ ..] = after
            && let Some(around) = in_turn([*a, *b, *c], [*d, *e, *f])
            && let [Some(p), Some(q), Some(r), Some(s)] = around.map(corner)
            && let Some(corners) = rectangle([p, q, r, s])
        {
            rest = beyond;
            shape = PaintShape::Rectangle(corners);
        }
        let bounds = shape.bounds().cut(clip);
        if !bounds.is_empty() {
            into.push(PaintPiece { shape, texture: mesh.texture_id, bounds, hash: hashed(seed, &shape) });
        }
    }
}

/// Returns the corners of two triangles that share an edge, in order around the quadrilateral that they form.
fn in_turn([a, b, c]: [u32; 3], [d, e, f]: [u32; 3]) -> Option<[u32; 4]> {
    // Egui writes rectangles in the first order and fills outlines in the second, as fans.
    if (d, e) == (c, b) {
        return Some([a, b, f, c]);
    }
    ((d, e) == (a, c)).then_some([a, b, c, f])
}

/// Returns the top left and bottom right corners of a quadrilateral, if it is a rectangle of one colour whose sides and
/// whose texture lie along the axes.
fn rectangle([a, b, c, d]: [PaintCorner; 4]) -> Option<[PaintCorner; 2]> {
    let is_plain = [b, c, d].iter().all(|other| other.colour == a.colour);
    let is_upright =
        |p: PaintCorner, q: PaintCorner, axis: usize| p.at[axis] == q.at[axis] && p.uv[axis] == q.uv[axis];
    let lies = is_upright(a, b, 1) && is_upright(b, c, 0) && is_upright(c, d, 1) && is_upright(d, a, 0);
    let stands = is_upright(a, b, 0) && is_upright(b, c, 1) && is_upright(c, d, 0) && is_upright(d, a, 1);
    if !is_plain || !(lies || stands) {
        return None;
    }
    let (mut least, mut most) = (a, c);
    for axis in 0..2 {
        if least.at[axis] > most.at[axis] {
            std::mem::swap(&mut least.at[axis], &mut most.at[axis]);
            std::mem::swap(&mut least.uv[axis], &mut most.uv[axis]);
        }
    }
    Some([least, most])
}

impl PaintShape {
    /// Returns the corners; of a rectangle, the two that are stored.
    fn corners(&self) -> &[PaintCorner] {
        match self {
            Self::Rectangle(corners) => corners,
            Self::Triangle(corners) => corners,
        }
    }

    /// Returns the bounding box, in pixels.
    fn bounds(&self) -> Area {
        let (least, most) = around(self.corners().iter().map(|c| c.at));
        Area::between(least, most)
    }

    /// Returns the part of the texture that the shape shows, by its least and its greatest corner.
    pub fn read(&self) -> ([f32; 2], [f32; 2]) {
        around(self.corners().iter().map(|c| c.uv))
    }
}

fn around(points: impl Iterator<Item = [f32; 2]>) -> ([f32; 2], [f32; 2]) {
    points.fold(([f32::MAX; 2], [f32::MIN; 2]), |(least, most), p| {
        ([least[0].min(p[0]), least[1].min(p[1])], [most[0].max(p[0]), most[1].max(p[1])])
    })
}

/// Combines a hash with a number; the order in which numbers are added matters.
#[inline(always)]
pub fn combined(hash: u64, number: u64) -> u64 {
    // The multiplier is 2^64 divided by the golden ratio; it is odd.
    let product = (hash ^ number).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    product ^ (product >> 29)
}

fn start(clip: Area, texture: TextureId) -> u64 {
    let two = |a: i32, b: i32| (u64::from(a as u32) << 32) | u64::from(b as u32);
    let (kind, name) = match texture {
        TextureId::Managed(name) => (1, name),
        TextureId::User(name) => (2, name),
    };
    [two(clip.left, clip.top), two(clip.right, clip.bottom), name].into_iter().fold(kind, combined)
}

fn hashed(seed: u64, shape: &PaintShape) -> u64 {
    let two = |pair: [f32; 2]| (u64::from(pair[0].to_bits()) << 32) | u64::from(pair[1].to_bits());
    let add = |hash: u64, c: &PaintCorner| {
        let hash = combined(combined(hash, two(c.at)), two(c.uv));
        combined(hash, u64::from(c.colour))
    };
    let corners = shape.corners();
    corners.iter().fold(combined(seed, corners.len() as u64), add)
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::epaint::WHITE_UV;
    use egui::{Color32, Rect, pos2};

    fn all(mesh: &Mesh, pixels_per_point: f32) -> Vec<PaintPiece> {
        let clip_rect = Rect::from_min_max(pos2(0.0, 0.0), pos2(50.0, 40.0));
        let primitive = ClippedPrimitive { clip_rect, primitive: Primitive::Mesh(mesh.clone()) };
        let mut found = vec![];
        pieces([100, 100], pixels_per_point, &[primitive], &mut found);
        found
    }

    fn square(turned: bool) -> Mesh {
        let mut mesh = Mesh::default();
        let corners = [pos2(10.0, 4.0), pos2(30.0, 4.0), pos2(30.0, 8.5), pos2(10.0, 8.5)];
        for corner in corners {
            let at = if turned { pos2(corner.x + 0.3 * corner.y, corner.y) } else { corner };
            mesh.vertices.push(Vertex { pos: at, uv: WHITE_UV, color: Color32::RED });
        }
        mesh.indices = vec![0, 1, 2, 0, 2, 3];
        mesh
    }

    #[test]
    fn two_triangles_that_make_a_rectangle_are_one_piece() {
        let mut by_egui = Mesh::default();
        by_egui.add_colored_rect(Rect::from_min_max(pos2(10.0, 4.0), pos2(30.0, 8.5)), Color32::RED);
        for mesh in [by_egui, square(false)] {
            let found = all(&mesh, 2.0);
            assert_eq!(found.len(), 1);
            assert_eq!(found[0].bounds, Area { left: 20, top: 8, right: 60, bottom: 17 });
            assert!(
                matches!(found[0].shape, PaintShape::Rectangle([a, b]) if a.at == [20.0, 8.0] && b.at == [60.0, 17.0])
            );
        }
        assert_eq!(all(&square(true), 1.0).len(), 2);
        let mut coloured = square(false);
        coloured.vertices[1].color = Color32::BLUE;
        assert_eq!(all(&coloured, 1.0).len(), 2, "a gradient is no rectangle of one colour");
    }

    #[test]
    fn what_is_outside_broken_or_no_number_is_left_out() {
        let mut mesh = square(false);
        mesh.vertices.iter_mut().for_each(|v| v.pos.x += 60.0);
        assert!(all(&mesh, 1.0).is_empty(), "it lies beyond the clip");
        let mut mesh = square(false);
        mesh.indices = vec![0, 1, 9, 0, 1];
        assert!(all(&mesh, 1.0).is_empty(), "there is no vertex 9");
        let mut mesh = square(false);
        mesh.vertices[2].pos.y = f32::NAN;
        assert!(all(&mesh, 1.0).is_empty());
    }

    #[test]
    fn everything_that_is_seen_changes_the_mark() {
        let hash = |mesh: &Mesh| all(mesh, 1.0)[0].hash;
        let plain = square(false);
        let change = |change: fn(&mut Mesh)| {
            let mut mesh = square(false);
            change(&mut mesh);
            hash(&mesh)
        };
        assert_eq!(hash(&plain), change(|_| {}));
        let others = [
            change(|m| m.vertices.iter_mut().for_each(|v| v.pos.y += 1.0)),
            change(|m| m.vertices.iter_mut().for_each(|v| v.color = Color32::BLUE)),
            change(|m| m.vertices.iter_mut().for_each(|v| v.uv.x = 0.5)),
            change(|m| m.texture_id = TextureId::Managed(1)),
            change(|m| m.texture_id = TextureId::User(0)),
        ];
        for (k, other) in others.iter().enumerate() {
            assert!(
                *other != hash(&plain) && !others[..k].contains(other),
                "change {k} leaves the hash as it was"
            );
        }
    }
}
