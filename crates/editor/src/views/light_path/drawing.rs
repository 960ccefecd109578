//! Draws the stone as a wireframe, and the path of one ray through it.

use super::Reading;
use brillianteer_math::{Basis, Edge};
use brillianteer_trace::ray::{Leaving, Path, Step};
use egui::{Align2, Color32, FontId, Mesh, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Vec2, Visuals};
use glam::{DVec2, DVec3};

/// The largest number of edges that are all drawn. Of a solid with more, only sharp edges and those of the silhouette are
/// drawn.
const MOST_EDGES: usize = 3000;

/// Two facets meet in a sharp edge where the cosine between their normals is below this.
const TRUE_EDGE: f64 = 0.8;

/// Lengths of the lines outside the stone, in parts of the stone's reach: of the light that enters, and of light that
/// leaves.
const OUTSIDE: [f64; 2] = [0.5, 0.36];

/// Free space around the drawing for arrowheads and numbers, in points.
const MARGIN: f32 = 14.0;

/// Opacity of the edges: of those that the eye sees, and of those on the far side.
const EDGES: [f32; 2] = [0.6, 0.2];

/// Opacity of a facet's tint: of a facet that the light meets, and of the facet of the highlighted step.
const TINTS: [f32; 2] = [0.10, 0.4];

/// Half the opening angle of an arrowhead, in radians.
const HEAD_ANGLE: f32 = 0.42;

/// Type size of the steps' numbers, in points.
const NUMBER: f32 = 11.0;

/// Distances from a point at which its number may stand, in points, in the order in which they are tried.
const ASIDE: [f32; 3] = [12.0, 20.0, 30.0];

/// Number of directions from a point in which its number may stand.
const PLACES: u8 = 8;

/// The share of the ray's light below which a step gets no tint and no number, and its line keeps no other numbers away.
pub(super) const FAINT: f64 = 0.05;

/// A parallel projection of the stone onto a painter.
struct Canvas<'a> {
    painter: &'a Painter,
    visuals: &'a Visuals,
    eye: Basis,
    centre: DVec3,
    reach: f64,
    scale: f64,
}

/// A straight stretch of the path, and the share of the ray's light that travels along it.
struct Stretch {
    ends: [DVec3; 2],
    share: f64,
}

/// Draws the path from the direction of `eye`, with the step `lit` highlighted, and a frame where the drawing has the
/// keyboard focus.
pub(super) fn paint(
    painter: &Painter,
    visuals: &Visuals,
    (eye, is_focused): (Basis, bool),
    reading: &Reading,
    lit: Option<usize>,
) {
    let canvas = Canvas::new(painter, visuals, eye, reading);
    let inside = stretches(reading.path, canvas.reach);
    canvas.facets(reading, &inside, lit);
    canvas.edges(reading);
    // Strong light is drawn over weak light, and the highlighted step over everything.
    let weak_first = || (0..inside.len()).rev().filter(|k| Some(*k) != lit).chain(lit);
    weak_first().for_each(|k| canvas.stretch(&inside[k], Some(k) == lit));
    weak_first().for_each(|k| canvas.leaving(reading, k, lit));
    canvas.numbers(&inside, lit);
    if is_focused {
        let frame = painter.clip_rect().shrink(1.0);
        painter.rect_stroke(frame, 2.0, visuals.selection.stroke, StrokeKind::Inside);
    }
}

/// Returns the stretch of light that leads to each step.
fn stretches(path: &Path, reach: f64) -> Vec<Stretch> {
    let mut from =
        path.steps.first().map_or(path.origin, |first| first.point - path.direction * (reach * OUTSIDE[0]));
    let mut share = 1.0;
    let to_step = |step: &Step| {
        let stretch = Stretch { ends: [from, step.point], share };
        (from, share) = (step.point, step.onward);
        stretch
    };
    path.steps.iter().map(to_step).collect()
}

/// Returns the end of the line for the light that leaves at a step; `None` where no light leaves.
fn end_of(step: &Step, reach: f64) -> Option<DVec3> {
    step.leaving.map(|leaving| step.point + leaving.direction * leaving.again.unwrap_or(reach * OUTSIDE[1]))
}

impl<'a> Canvas<'a> {
    /// Makes a canvas with room for the stone and all its light, for any azimuth of the eye at its present elevation.
    fn new(painter: &'a Painter, visuals: &'a Visuals, eye: Basis, reading: &Reading) -> Self {
        let corners = reading.body.solid().vertices();
        let low = corners.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = corners.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let centre = (low + high) / 2.0;
        let reach = corners.iter().map(|v| v.distance(centre)).fold(0.0, f64::max);
        let entering = stretches(reading.path, reach).into_iter().take(1).map(|stretch| stretch.ends[0]);
        let leaving = reading.path.steps.iter().filter_map(|step| end_of(step, reach));
        let shown = corners.iter().copied().chain(entering).chain(leaving);
        // The greatest extent, sideways and upward on the screen, while everything turns around the stone's axis.
        let extent = shown.fold(DVec2::splat(f64::MIN_POSITIVE), |extent, v| {
            let (out, height) = ((v - centre).truncate().length(), (v - centre).z);
            extent.max(DVec2::new(out, out * eye.toward.z.abs() + (height * eye.up.z).abs()))
        });
        let room = painter.clip_rect().size() / 2.0 - Vec2::splat(MARGIN);
        let scale = (DVec2::new(room.x.into(), room.y.into()) / extent).min_element().max(1.0);
        Self { painter, visuals, eye, centre, reach, scale }
    }

    fn at(&self, v: DVec3) -> Pos2 {
        let p = self.eye.project(v - self.centre) * self.scale;
        self.painter.clip_rect().center() + Vec2::new(p.x as f32, -p.y as f32)
    }

    /// Tints the facets that the light meets.
    fn facets(&self, reading: &Reading, inside: &[Stretch], lit: Option<usize>) {
        let steps = &reading.path.steps;
        let lit = lit.map(|k| steps[k].facet);
        let mut met: Vec<u32> = steps
            .iter()
            .zip(inside)
            .filter(|(_, to)| to.share >= FAINT)
            .map(|(s, _)| s.facet)
            .chain(lit)
            .collect();
        met.sort_unstable();
        met.dedup();
        for facet in met {
            let tint = self.visuals.hyperlink_color.gamma_multiply(TINTS[usize::from(lit == Some(facet))]);
            // Each facet is one mesh: separate triangles would show seams.
            let mut cover = Mesh::default();
            for corner in reading.body.solid().triangles_of(facet).into_iter().flatten() {
                cover.indices.push(cover.vertices.len() as u32);
                cover.colored_vertex(self.at(corner), tint);
            }
            self.painter.add(Shape::mesh(cover));
        }
    }

    /// Draws the edges, those on the far side first.
    fn edges(&self, reading: &Reading) {
        let solid = reading.body.solid();
        let faces = |normal: &DVec3| normal.dot(self.eye.toward) > 0.0;
        let mut edges = solid.edges();
        if edges.len() > MOST_EDGES {
            // Only sharp edges and those of the silhouette are drawn: all others would hide the path.
            let is_drawn = |e: &Edge| {
                let [a, b] = e.normals;
                a.dot(b) < TRUE_EDGE || faces(&a) != faces(&b)
            };
            edges.retain(is_drawn);
        }
        for front in [false, true] {
            let colour = self.visuals.text_color().gamma_multiply(EDGES[usize::from(!front)]);
            for Edge { ends, .. } in edges.iter().filter(|edge| edge.normals.iter().any(faces) == front) {
                self.painter.line_segment(ends.map(|v| self.at(v)), Stroke::new(1.0, colour));
            }
        }
    }

    fn stretch(&self, stretch: &Stretch, is_lit: bool) {
        let strength = strength(stretch.share);
        let (colour, opacity, more) = if is_lit {
            (self.visuals.strong_text_color(), 1.0, 1.2)
        } else {
            (self.visuals.warn_fg_color, 0.12 + 0.88 * strength, 0.0)
        };
        let width = 0.8 + 2.4 * strength + more;
        let stroke = Stroke::new(width, colour.gamma_multiply(opacity));
        let [from, to] = stretch.ends.map(|v| self.at(v));
        self.painter.line_segment([from, to], stroke);
        let way = to - from;
        if way.length() > 4.0 * head(width) {
            self.head(from + 0.55 * way, way, stroke);
        }
    }

    /// Draws the light that leaves at a step, in the colour of the zone that it goes to.
    fn leaving(&self, reading: &Reading, k: usize, lit: Option<usize>) {
        let step = &reading.path.steps[k];
        let (Some(leaving), Some(end)) = (step.leaving, end_of(step, self.reach)) else { return };
        let strength = if lit == Some(k) { 1.0 } else { strength(leaving.share) };
        let (from, to) = (self.at(step.point), self.at(end));
        let width = 1.2 + 1.6 * strength;
        let opacity = 0.15 + 0.85 * strength;
        let rim = self.visuals.text_color().gamma_multiply(0.6 * opacity);
        // The rim keeps the line visible where the scope's colour is that of the background.
        for stroke in [
            Stroke::new(width + 1.6, rim),
            Stroke::new(width, self.colour(reading, &leaving).gamma_multiply(opacity)),
        ] {
            self.painter.line_segment([from, to], stroke);
            self.head(to, to - from, stroke);
        }
    }

    /// Returns the colour of the zone that the light goes to. Light that enters the stone again goes to no zone yet and gets
    /// the colour of the path.
    fn colour(&self, reading: &Reading, leaving: &Leaving) -> Color32 {
        match leaving.again {
            None => reading.colour(leaving.direction),
            Some(_) => self.visuals.warn_fg_color,
        }
    }

    /// Draws an arrowhead whose point is at `tip`.
    fn head(&self, tip: Pos2, way: Vec2, stroke: Stroke) {
        let length = way.length();
        if length < 1.0 {
            return;
        }
        let back = -way / length * head(stroke.width).min(length);
        for angle in [HEAD_ANGLE, -HEAD_ANGLE] {
            let (sin, cos) = angle.sin_cos();
            let turned = Vec2::new(cos * back.x - sin * back.y, sin * back.x + cos * back.y);
            self.painter.line_segment([tip, tip + turned], stroke);
        }
    }

    /// Writes the numbers of the steps beside their facets, that of the highlighted step first. A number that finds no room
    /// is left out.
    fn numbers(&self, inside: &[Stretch], lit: Option<usize>) {
        let within = self.painter.clip_rect();
        let is_seen = |k: &usize| inside[*k].share >= FAINT;
        let seen = (0..inside.len()).filter(is_seen);
        let lines: Vec<_> = seen.clone().map(|k| inside[k].ends.map(|v| self.at(v))).collect();
        let mut taken: Vec<Rect> = vec![];
        for k in lit.into_iter().chain(seen.filter(|k| Some(*k) != lit)) {
            let colour = self.visuals.strong_text_color();
            let text = self.painter.layout_no_wrap((k + 1).to_string(), FontId::proportional(NUMBER), colour);
            let at = self.at(inside[k].ends[1]);
            let places = places(at, at - within.center(), text.size() + Vec2::splat(3.0));
            let Some(rect) = free(places.filter(|rect| within.contains_rect(*rect)), &taken, &lines) else {
                continue;
            };
            taken.push(rect);
            let fill = if lit == Some(k) { self.visuals.selection.bg_fill } else { self.visuals.panel_fill };
            self.painter.rect_filled(rect, 3.0, fill.gamma_multiply(0.85));
            self.painter.galley(
                Align2::CENTER_CENTER.anchor_size(rect.center(), text.size()).min,
                text,
                colour,
            );
        }
    }
}

/// Returns how strongly a share of light is drawn, 0 to 1. Weak light is raised, so that a tenth can be seen beside the
/// whole, and so can a hundredth.
fn strength(share: f64) -> f32 {
    share.clamp(0.0, 1.0).powf(0.4) as f32
}

/// Returns the length of an arrowhead on a line of this width, in points.
fn head(width: f32) -> f32 {
    4.0 + 1.5 * width
}

/// Returns the rectangles in which a number of this size may stand: near ones first and, at each distance, those away from
/// the drawing's middle first.
fn places(at: Pos2, away: Vec2, size: Vec2) -> impl Iterator<Item = Rect> {
    let outward = if away.length() > 1.0 { away.angle() } else { 0.0 };
    let turns = (0..PLACES).map(move |k| {
        // The sides alternate.
        let step = f32::from(k.div_ceil(2)) * std::f32::consts::TAU / f32::from(PLACES);
        outward + if k % 2 == 0 { step } else { -step }
    });
    let around = move |far| turns.clone().map(move |turn| at + Vec2::angled(turn) * far);
    ASIDE.into_iter().flat_map(around).map(move |middle| Rect::from_center_size(middle, size))
}

/// Returns the place that hides the fewest lines among those that overlap nothing in `taken`; the first of several.
fn free(places: impl Iterator<Item = Rect>, taken: &[Rect], lines: &[[Pos2; 2]]) -> Option<Rect> {
    let is_free = |rect: &Rect| taken.iter().all(|other| !other.intersects(*rect));
    let hidden = |rect: &Rect| lines.iter().filter(|line| crosses(*rect, **line)).count();
    places.filter(is_free).min_by_key(hidden)
}

/// Returns whether a line segment passes through a rectangle or close by it.
fn crosses(rect: Rect, [from, to]: [Pos2; 2]) -> bool {
    let (way, middle) = (to - from, rect.center());
    let part = ((middle - from).dot(way) / way.length_sq().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
    (from + way * part).distance(middle) < rect.size().max_elem() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{pos2, vec2};

    #[test]
    fn a_number_stands_beside_its_point_and_apart_from_the_others() {
        let size = vec2(12.0, 10.0);
        let mut taken: Vec<Rect> = vec![];
        // More numbers than there is room for: those that are placed do not overlap.
        for _ in 0..100 {
            taken.extend(free(places(pos2(5.0, 5.0), vec2(1.0, 0.0), size), &taken, &[]));
        }
        assert!((8..=24).contains(&taken.len()), "{}", taken.len());
        for (k, rect) in taken.iter().enumerate() {
            assert!(taken[..k].iter().all(|other| !other.intersects(*rect)));
            assert!(rect.center().distance(pos2(5.0, 5.0)) <= 30.1);
        }
        assert_eq!(taken[0].center(), pos2(17.0, 5.0));
    }

    #[test]
    fn a_number_keeps_off_lines_where_it_can() {
        let beside = |lines: &[[Pos2; 2]]| {
            free(places(Pos2::ZERO, vec2(1.0, 0.0), vec2(10.0, 10.0)), &[], lines).map(|rect| rect.center())
        };
        assert_eq!(beside(&[]), Some(pos2(12.0, 0.0)));
        let line = [Pos2::ZERO, pos2(100.0, 0.0)];
        assert!(beside(&[line]).is_some_and(|at| at.y.abs() > 5.0));
        let all_round: Vec<_> =
            (0..64).map(|k| [Pos2::ZERO, Pos2::ZERO + 100.0 * Vec2::angled(k as f32 / 10.0)]).collect();
        assert!(beside(&all_round).is_some());
    }
}
