//! The wireframe: edges of stones, drawn as thin even lines.

use super::{Code, lay_over};
use brillianteer_math::{Edge, Plane, PosedSolid};
use brillianteer_scene::Instance;
use brillianteer_trace::ray::SceneProbe;
use brillianteer_trace::sampling::LitScene;
use glam::{DMat2, DVec2, DVec3};

/// Width of a line, in pixels.
const WIDTH: f64 = 1.2;

/// Width of the shade around a line, in pixels. The shade sets the line apart from a background that is as bright.
const SHADE_WIDTH: f64 = 3.0;

/// Distance from a line within which pixels change, in pixels: half the width, and half a pixel for the soft edge.
const REACH: f64 = SHADE_WIDTH / 2.0 + 0.5;

/// Colours of a line and of its shade: a blue that light in stones seldom has, and white for places where it has.
const COLOURS: [Code; 2] = [[0, 96, 255], [255, 255, 255]];

/// The parts that a line and its shade hide, for visible edges and for hidden ones.
const SHARES: [[f32; 2]; 2] = [[1.0, 0.5], [0.45, 0.2]];

/// An edge of a stone in the picture.
struct Wire {
    /// The edge's ends, in pixels from the upper left.
    ends: [DVec2; 2],
    /// The factors by which things are larger at the edge's ends than in the image plane through the origin.
    sizes: [f64; 2],
    /// The edge's ends in the world.
    points: [DVec3; 2],
    stone: usize,
    /// True where a facet at the edge faces the eye.
    is_front: bool,
}

/// The edges of all stones in a picture.
pub(super) struct Wires(Vec<Wire>);

impl Wires {
    pub fn new(lit_scene: &LitScene, sight: &SceneProbe) -> Self {
        let of_stone =
            |(stone, instance): (usize, &Instance)| wires(lit_scene, sight, stone, instance.solid());
        Self(lit_scene.scene.instances.iter().enumerate().flat_map(of_stone).collect())
    }

    /// Draws all lines near the middle of row `y` over that row.
    pub fn draw(&self, sight: &SceneProbe, y: usize, row: &mut [u8]) {
        let (pixels, _) = row.as_chunks_mut();
        // For each pixel, the distance from the nearest visible line, and from the nearest hidden one.
        let mut nearest = vec![[f64::INFINITY; 2]; pixels.len()];
        for wire in &self.0 {
            wire.mark(sight, y as f64 + 0.5, &mut nearest);
        }
        for (pixel, [front, behind]) in pixels.iter_mut().zip(nearest) {
            lay_line(pixel, behind, SHARES[1]);
            lay_line(pixel, front, SHARES[0]);
        }
    }
}

fn wires(lit_scene: &LitScene, sight: &SceneProbe, stone: usize, solid: PosedSolid) -> Vec<Wire> {
    let pixels = lit_scene.film.pixels_from_image(DMat2::IDENTITY);
    let wire = |edge: Edge| {
        let [a, b] = edge.ends.map(|p| sight.camera.project(p));
        let (a, b) = (a?, b?);
        let ends = [a.0, b.0].map(|p| pixels.transform_point2(p));
        let faces = |n: &DVec3| sight.camera.sees(&Plane::new(*n, n.dot(edge.ends[0])));
        let is_front = edge.normals.iter().any(faces);
        Some(Wire { ends, sizes: [a.1, b.1], points: edge.ends, stone, is_front })
    };
    solid.solid.edges().iter().filter_map(|edge| wire(edge.placed(&solid.pose))).collect()
}

impl Wire {
    /// Records the distance of the line from each pixel of the row whose middle is at height `y`.
    fn mark(&self, sight: &SceneProbe, y: f64, nearest: &mut [[f64; 2]]) {
        let [a, b] = self.ends;
        let Some((from, to)) = columns(self.ends, y, nearest.len()) else { return };
        let along = b - a;
        let scale = 1.0 / along.length_squared().max(f64::MIN_POSITIVE);
        for (x, place) in (from..to).zip(&mut nearest[from..to]) {
            let at = DVec2::new(x as f64 + 0.5, y);
            let part = ((at - a).dot(along) * scale).clamp(0.0, 1.0);
            let distance = at.distance(a + along * part);
            if distance < REACH {
                let is_seen = self.is_front && !self.is_hidden(sight, part);
                let place = &mut place[usize::from(!is_seen)];
                *place = place.min(distance);
            }
        }
    }

    /// Returns whether a stone hides the point at this part of the edge's way through the picture.
    fn is_hidden(&self, sight: &SceneProbe, part: f64) -> bool {
        if sight.tracers.len() < 2 && sight.tracers[0].is_convex() {
            return false;
        }
        sight.is_hidden(self.stone, self.point(part))
    }

    /// Returns the point in the world at this part of the edge's way through the picture. In perspective, the nearer
    /// half of an edge takes up more of that way.
    fn point(&self, part: f64) -> DVec3 {
        let [a, b] = self.sizes;
        self.points[0].lerp(self.points[1], part * b / ((1.0 - part) * a + part * b))
    }
}

/// Returns the range of columns in which a row is near a line between two ends; `None` if there are none.
fn columns([a, b]: [DVec2; 2], y: f64, width: usize) -> Option<(usize, usize)> {
    let (top, bottom) = if a.y < b.y { (a, b) } else { (b, a) };
    if top.y > y + REACH || bottom.y < y - REACH {
        return None;
    }
    let height = bottom.y - top.y;
    let at = |y: f64| ((y - top.y) / height).clamp(0.0, 1.0);
    let (p, q) = if height > 0.0 { (at(y - REACH), at(y + REACH)) } else { (0.0, 1.0) };
    let (p, q) = (top.x + (bottom.x - top.x) * p, top.x + (bottom.x - top.x) * q);
    let (from, to) = (p.min(q) - REACH, p.max(q) + REACH);
    let inside = |x: f64| x.clamp(0.0, width as f64) as usize;
    Some((inside(from.floor()), inside(to.ceil())))
}

/// Lays a line and its shade over a pixel whose middle is this far from the line's.
fn lay_line(pixel: &mut [u8; 4], distance: f64, shares: [f32; 2]) {
    let cover = |width: f64| (width / 2.0 + 0.5 - distance).clamp(0.0, 1.0) as f32;
    for (k, width) in [(1, SHADE_WIDTH), (0, WIDTH)] {
        lay_over(pixel, COLOURS[k], shares[k] * cover(width));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_scene::{Projection, View};
    use brillianteer_trace::ray::Camera;

    #[test]
    fn a_part_of_the_way_through_the_picture_is_told_in_space() {
        let view =
            View { projection: Projection::Perspective { distance: 3.0 }, tilt: 0.4, ..View::default() };
        let camera = Camera::reaching(&view, 1.0);
        let points = [DVec3::new(0.5, -0.2, 0.9), DVec3::new(-0.4, 0.7, -0.6)];
        let [a, b] = points.map(|p| camera.project(p).unwrap());
        let wire = Wire { ends: [a.0, b.0], sizes: [a.1, b.1], points, stone: 0, is_front: true };
        for part in [0.0, 0.1, 0.5, 0.8, 1.0] {
            let seen = camera.project(wire.point(part)).unwrap().0;
            assert!(seen.distance(a.0.lerp(b.0, part)) < 1e-12, "{part}");
        }
    }

    #[test]
    fn the_columns_of_a_row_hold_all_that_is_near_a_line() {
        let spread = |k: u32| DVec2::new(f64::from(k * 37 % 61), f64::from(k * 23 % 47)) - 5.0;
        for k in 0..200 {
            let ends = [spread(k), spread(k * k % 97 + 1)];
            for (x, y) in (0..40).flat_map(|x| (0..40).map(move |y| (x, f64::from(y) + 0.5))) {
                let (at, along) = (DVec2::new(x as f64 + 0.5, y), ends[1] - ends[0]);
                let part = (at - ends[0]).dot(along) / along.length_squared().max(1e-300);
                let is_near = at.distance(ends[0] + along * part.clamp(0.0, 1.0)) < REACH;
                let held = columns(ends, y, 40).is_some_and(|(from, to)| (from..to).contains(&x));
                assert!(held || !is_near, "{ends:?} at {at}");
            }
        }
    }
}
