//! The map of a measure as it is drawn: colours with their scale, lines of equal value, the published range, and the place of the
//! design, which a click or a drag moves.

use super::map_lines::{MapLinesOf, map_lines};
use crate::arrows;
use crate::theme;
use brillianteer_cut::Design;
use brillianteer_measure::measure_words;
use brillianteer_paper::plot::{levels, map_colour};
use brillianteer_render::{SweepError, SweptStone};
use brillianteer_session::model::{
    action::{Actions, Edit},
    growing_sweep::FoundSweep,
    measure_map::{MapAxis, MapOptions, MeasureMap, STEPS, STRIDES, point},
};
use egui::epaint::Mesh;
use egui::{
    Align2, Color32, FontId, Modifiers, Painter, Pos2, Rect, Response, Role, Sense, Shape, Stroke,
    StrokeKind, TextStyle, Ui, WidgetInfo, pos2, vec2,
};
use std::ops::Range;

/// The room for numbers and names left of the map, above it, right of it with the scale, and below it, points.
const MARGINS: [f32; 4] = [58.0, 8.0, 76.0, 40.0];
/// The room that is left below the map for the text, points.
const TEXT: f32 = 56.0;
/// The least side of the map, points.
const LEAST: f32 = 160.0;
/// The width of the scale and its gap to the map, points.
const SCALE: [f32; 2] = [14.0, 10.0];
/// The colour of the frame around the published range, which the scale of colours lacks.
const PUBLISHED: Color32 = Color32::from_rgb(255, 190, 225);

/// The length of an arm of the cross, points.
const CROSS: f32 = 9.0;

/// The answer at the place under the pointer.
pub struct MapReading<'a> {
    /// The values of the axes at the nearest place that has an answer.
    pub at: [f64; 2],
    /// The result there; `None` where there is no answer yet.
    pub found: Option<&'a Result<SweptStone, SweepError>>,
}

/// The data of a map to be drawn.
pub struct MapPlot<'a> {
    options: &'a MapOptions,
    design: &'a Design,
    found: Option<&'a FoundSweep>,
    /// True where the points belong to the present design.
    is_present: bool,
    /// The least and the greatest value of all answered points; `None` where there is none.
    range: Option<Range<f64>>,
    /// The place in [`STRIDES`] of the finest grid that is whole.
    whole: Option<usize>,
}

impl<'a> MapPlot<'a> {
    /// Makes the plot of a map.
    pub fn new(map: &'a MeasureMap, options: &'a MapOptions, design: &'a Design) -> Self {
        let found = map.sweep.found();
        let mut plot =
            Self { options, design, found, is_present: map.sweep.is_present(), range: None, whole: None };
        let values = || (0..=STEPS).flat_map(|x| (0..=STEPS).map(move |y| (x, y)));
        let ends = values().filter_map(|(x, y)| plot.value(x, y));
        let ends = ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
        plot.range = (ends[0] <= ends[1]).then(|| ends[0]..ends[1].max(ends[0] + 1e-6));
        let is_whole = |stride: usize| {
            (0..=STEPS).step_by(stride).all(|x| {
                (0..=STEPS)
                    .step_by(stride)
                    .all(|y| found.is_some_and(|found| found.at(point(x, y)).is_some()))
            })
        };
        plot.whole = (0..STRIDES.len()).rev().find(|&level| is_whole(STRIDES[level]));
        plot
    }

    /// Returns the middle of the measure's interval at a place, percent; `None` where it has no answer or no bound.
    fn value(&self, x: usize, y: usize) -> Option<f64> {
        let stone = self.found?.at(point(x, y))?.as_ref().ok()?;
        let middle = self.options.measure.of(&stone.measures)?.middle();
        middle.is_finite().then_some(100.0 * middle)
    }

    /// Draws the map, and moves the design where the user points. Returns the answer under the pointer.
    pub fn show(&self, actions: &mut Actions, ui: &mut Ui) -> Option<MapReading<'a>> {
        let [left, top, right, bottom] = MARGINS;
        let width = ui.available_width().max(LEAST + left + right);
        let height = (ui.available_height() - TEXT).max(LEAST + top + bottom);
        let (whole, response) = ui.allocate_exact_size(vec2(width, height), Sense::click_and_drag());
        let map = Rect::from_min_max(whole.min + vec2(left, top), whole.max - vec2(right, bottom));
        let sight = MapSight { map, axes: &self.options.axes };
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, self.spoken()));
        let painter = ui.painter().with_clip_rect(map.expand(1.0).intersect(ui.clip_rect()));
        painter.rect_filled(map, 0.0, ui.visuals().extreme_bg_color);
        self.cells(ui, &painter, &sight);
        if self.is_present {
            self.lines_of_equal_value(&painter, &sight);
        } else {
            painter.rect_filled(map, 0.0, ui.visuals().window_fill.gamma_multiply(0.6));
        }
        self.published(ui, &painter, &sight);
        self.cross(&painter, &sight);
        frame(ui, &sight, &response);
        self.scale(ui, &sight);
        self.act(actions, ui, &response, &sight);
        let at = response
            .hover_pos()
            .or_else(|| response.interact_pointer_pos())
            .filter(|at| map.contains(*at))?;
        Some(self.reading(sight.part(at)))
    }

    /// Returns the name of the map for screen readers: the measure and both axes.
    fn spoken(&self) -> String {
        let [across, up] = &self.options.axes;
        let measure = measure_words::name(self.options.measure);
        format!("Map: {measure} over {} and {}", across.name, up.name)
    }

    /// Draws the answered places as cells, coarse ones first, so that finer ones cover them.
    fn cells(&self, ui: &Ui, painter: &Painter, sight: &MapSight) {
        let Some(found) = self.found else { return };
        let (mut colours, mut hatches) = (Mesh::default(), vec![]);
        let empty = ui.visuals().extreme_bg_color;
        let hatch = Stroke::new(1.0, ui.visuals().weak_text_color().gamma_multiply(0.6));
        for (level, stride) in STRIDES.into_iter().enumerate().skip(self.whole.unwrap_or(0)) {
            let is_drawn = |x: usize, y: usize| {
                let is_coarser = x.is_multiple_of(2 * stride) && y.is_multiple_of(2 * stride);
                // Cells of the level before are drawn again, smaller, where all their neighbours have answers.
                Some(level) == self.whole || level == 0 || !is_coarser
            };
            for x in (0..=STEPS).step_by(stride) {
                for y in (0..=STEPS).step_by(stride).filter(|&y| is_drawn(x, y)) {
                    if found.at(point(x, y)).is_none() {
                        continue;
                    }
                    let cell = sight.cell([x, y], stride);
                    match (self.value(x, y), &self.range) {
                        (Some(value), Some(range)) => {
                            let [red, green, blue] = map_colour(value, range);
                            colours.add_colored_rect(cell, Color32::from_rgb(red, green, blue));
                        }
                        _ => {
                            colours.add_colored_rect(cell, empty);
                            hatches.push(Shape::line_segment([cell.left_bottom(), cell.right_top()], hatch));
                        }
                    }
                }
            }
        }
        painter.add(Shape::mesh(colours));
        painter.extend(hatches);
    }

    /// Draws the lines of equal value of the finest grid that is whole and has a value everywhere.
    fn lines_of_equal_value(&self, painter: &Painter, sight: &MapSight) {
        let (Some(level), Some(range), Some(found)) = (self.whole, &self.range, self.found) else { return };
        let of = MapLinesOf {
            number: found.order.number,
            answered: found.answered,
            measure: self.options.measure,
        };
        let all = map_lines(painter.ctx(), of, || {
            let places: Vec<usize> = (0..=STEPS).step_by(STRIDES[level]).collect();
            let rows = places.iter().flat_map(|&y| places.iter().map(move |&x| (x, y)));
            rows.map(|(x, y)| self.value(x, y))
                .collect::<Option<Vec<f64>>>()
                .map(|values| (values, range.clone()))
        });
        for line in all.iter() {
            let line = line.iter().map(|part| sight.place(*part)).collect();
            painter.add(Shape::line(line, Stroke::new(1.0, Color32::from_white_alpha(110))));
        }
    }

    /// Frames the range that GIA publishes for the grade EX.
    fn published(&self, ui: &Ui, painter: &Painter, sight: &MapSight) {
        let Some([across, up]) = self.options.published_range(self.design) else { return };
        let corner = |end: usize| sight.place(sight.parts([across[end], up[end]]));
        let range = Rect::from_two_pos(corner(0), corner(1));
        for (width, colour) in [(4.0, Color32::from_black_alpha(170)), (2.0, PUBLISHED)] {
            painter.rect_stroke(range, 0.0, Stroke::new(width, colour), StrokeKind::Middle);
        }
        let at = range.left_top() + vec2(4.0, 2.0);
        let text = painter.layout_no_wrap("EX (GIA), estimate".to_owned(), small(ui), Color32::WHITE);
        painter.rect_filled(
            Rect::from_min_size(at, text.size()).expand(2.0),
            2.0,
            Color32::from_black_alpha(150),
        );
        painter.galley(at, text, Color32::WHITE);
    }

    /// Marks the place of the design.
    fn cross(&self, painter: &Painter, sight: &MapSight) {
        let Some(values) = self.here() else { return };
        let at = sight.place(sight.parts(values));
        for (width, colour) in [(4.0, Color32::from_black_alpha(190)), (1.8, Color32::WHITE)] {
            let stroke = Stroke::new(width, colour);
            painter.line_segment([at - vec2(CROSS, 0.0), at + vec2(CROSS, 0.0)], stroke);
            painter.line_segment([at - vec2(0.0, CROSS), at + vec2(0.0, CROSS)], stroke);
        }
    }

    /// Returns the values of the design on both axes.
    fn here(&self) -> Option<[f64; 2]> {
        let [across, up] = &self.options.axes;
        Some([across.value(&self.design.cut)?, up.value(&self.design.cut)?])
    }

    /// Draws the scale of colours with its numbers.
    fn scale(&self, ui: &Ui, sight: &MapSight) {
        let Some(range) = &self.range else { return };
        let [width, gap] = SCALE;
        let bar = Rect::from_min_size(
            pos2(sight.map.right() + gap, sight.map.top()),
            vec2(width, sight.map.height()),
        );
        let y = |value: f64| {
            bar.bottom() - bar.height() * ((value - range.start) / (range.end - range.start)) as f32
        };
        let mut colours = Mesh::default();
        const BANDS: u32 = 64;
        for band in 0..BANDS {
            let value = |k: u32| range.start + (range.end - range.start) * f64::from(k) / f64::from(BANDS);
            let [red, green, blue] = map_colour(f64::midpoint(value(band), value(band + 1)), range);
            let cell = Rect::from_x_y_ranges(bar.x_range(), y(value(band + 1))..=y(value(band)));
            colours.add_colored_rect(cell, Color32::from_rgb(red, green, blue));
        }
        ui.painter().add(Shape::mesh(colours));
        for level in levels(range) {
            let at = pos2(bar.right() + 4.0, y(level));
            ui.painter().text(
                at,
                Align2::LEFT_CENTER,
                format!("{} %", short(level)),
                small(ui),
                ui.visuals().text_color(),
            );
        }
    }

    /// Moves the design to the place that the user clicks, drags to or reaches by arrow keys.
    fn act(&self, actions: &mut Actions, ui: &Ui, response: &Response, sight: &MapSight) {
        if response.clicked() || response.dragged() {
            response.request_focus();
            if let Some(at) = response.interact_pointer_pos() {
                let to = sight.values(sight.part(at));
                actions.push_if(self.here() != Some(to), Edit::Along(to));
            }
        }
        if response.has_focus() {
            arrows::keep(ui, response.id);
            let steps = arrows::way(ui, Modifiers::NONE);
            if let Some(here) = self.here().filter(|_| steps != glam::DVec2::ZERO) {
                let step = |axis: &MapAxis| (axis.ends[1] - axis.ends[0]) / STEPS as f64;
                let [across, up] = &self.options.axes;
                let to = [here[0] + steps.x * step(across), here[1] + steps.y * step(up)];
                actions.push(Edit::Along(to.map(rounded)));
            }
        }
    }

    /// Returns the answer of the finest grid at the place nearest to these parts of the map's sides.
    fn reading(&self, part: [f64; 2]) -> MapReading<'a> {
        let place = |stride: usize| {
            part.map(|part| ((part * (STEPS / stride) as f64).round() as usize * stride).min(STEPS))
        };
        let known = STRIDES.into_iter().rev().find_map(|stride| {
            let [x, y] = place(stride);
            Some(([x, y], self.found?.at(point(x, y))?))
        });
        let [across, up] = &self.options.axes;
        match known.filter(|_| self.is_present) {
            Some(([x, y], found)) => MapReading { at: [across.at(x), up.at(y)], found: Some(found) },
            None => {
                let [x, y] = place(1);
                MapReading { at: [across.at(x), up.at(y)], found: None }
            }
        }
    }
}

/// The place of the map on the screen.
struct MapSight<'a> {
    map: Rect,
    axes: &'a [MapAxis; 2],
}

impl MapSight<'_> {
    /// Returns the point at these parts of the way across and up.
    fn place(&self, [x, y]: [f64; 2]) -> Pos2 {
        let Rect { min, max } = self.map;
        pos2(min.x + (max.x - min.x) * x as f32, max.y - (max.y - min.y) * y as f32)
    }

    /// Returns the parts of the way across and up at a point, 0 to 1.
    fn part(&self, at: Pos2) -> [f64; 2] {
        let Rect { min, max } = self.map;
        let part = |from: f32, to: f32, at: f32| f64::from(((at - from) / (to - from)).clamp(0.0, 1.0));
        [part(min.x, max.x, at.x), part(max.y, min.y, at.y)]
    }

    fn parts(&self, values: [f64; 2]) -> [f64; 2] {
        let part = |axis: &MapAxis, value: f64| (value - axis.ends[0]) / (axis.ends[1] - axis.ends[0]);
        [part(&self.axes[0], values[0]), part(&self.axes[1], values[1])]
    }

    /// Returns the values of the axes at parts of the way, to two decimals.
    fn values(&self, parts: [f64; 2]) -> [f64; 2] {
        let value = |axis: &MapAxis, part: f64| rounded(axis.ends[0] + part * (axis.ends[1] - axis.ends[0]));
        [value(&self.axes[0], parts[0]), value(&self.axes[1], parts[1])]
    }

    /// Returns the cell around a place, as far as it lies in the map.
    fn cell(&self, place: [usize; 2], stride: usize) -> Rect {
        let side = |way: f64| {
            place.map(|at| ((at as f64 + way * stride as f64 / 2.0) / STEPS as f64).clamp(0.0, 1.0))
        };
        Rect::from_two_pos(self.place(side(-1.0)), self.place(side(1.0)))
    }
}

/// Draws the border of the map, and numbers and names beside it.
fn frame(ui: &Ui, sight: &MapSight, response: &Response) {
    let (map, painter, font, colour) = (sight.map, ui.painter(), small(ui), ui.visuals().text_color());
    let border = if response.has_focus() {
        Stroke::new(2.0, theme::accent(ui.visuals()))
    } else {
        Stroke::new(1.0, ui.visuals().weak_text_color())
    };
    painter.rect_stroke(map, 0.0, border, StrokeKind::Outside);
    let [across, up] = sight.axes;
    let part = |axis: &MapAxis, value: f64| (value - axis.ends[0]) / (axis.ends[1] - axis.ends[0]);
    for value in levels(&(across.ends[0]..across.ends[1])) {
        let at = sight.place([part(across, value), 0.0]);
        painter.vline(at.x, at.y..=at.y + 4.0, border);
        painter.text(at + vec2(0.0, 5.0), Align2::CENTER_TOP, short(value), font.clone(), colour);
    }
    for value in levels(&(up.ends[0]..up.ends[1])) {
        let at = sight.place([0.0, part(up, value)]);
        painter.hline(at.x - 4.0..=at.x, at.y, border);
        painter.text(at - vec2(6.0, 0.0), Align2::RIGHT_CENTER, short(value), font.clone(), colour);
    }
    let named = |axis: &MapAxis| match axis.unit.trim() {
        "" => axis.name.clone(),
        unit => format!("{}, {unit}", axis.name),
    };
    let below = pos2(map.center().x, map.bottom() + 20.0);
    painter.text(below, Align2::CENTER_TOP, named(across), font.clone(), colour);
    let text = painter.layout_no_wrap(named(up), font, colour);
    let at = pos2(map.left() - MARGINS[0] + 2.0, map.center().y + text.size().x / 2.0);
    painter.add(egui::epaint::TextShape::new(at, text, colour).with_angle(-std::f32::consts::FRAC_PI_2));
}

fn small(ui: &Ui) -> FontId {
    TextStyle::Small.resolve(ui.style())
}

/// Writes a round number without the rounding of sums.
fn short(value: f64) -> String {
    format!("{}", (value * 1e6).round() / 1e6 + 0.0)
}

fn rounded(value: f64) -> f64 {
    (100.0 * value).round() / 100.0
}
