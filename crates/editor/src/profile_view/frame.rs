//! Lays out and paints one frame of the profile: the stone, its dimensions and its handles.

use super::body::ProfileBody;
use super::grips::{Grip, grips};
use super::handle::Handle;
use super::ink::ProfileInks;
use super::plan::{LabelDetail, Planner, ProfileSubject};
use super::sheet::{About, Label, ProfileSheet, SheetLine, Weight};
use super::sight::{ProfileBox, ProfileProjection, room};
use brillianteer_cut::Cut;
use brillianteer_math::Basis;
use brillianteer_picture::DrawnMarks;
use brillianteer_picture::profile::{Dimensions, across_the_width, brilliant::BRILLIANT_BASIS};
use brillianteer_scene::Stone;
use egui::epaint::TextShape;
use egui::{Color32, FontId, Id, Painter, Pos2, Rect, Response, Shape, Stroke, TextStyle, Ui, Vec2};
use std::f32::consts::FRAC_PI_2;

/// Widths of dimension lines and of the extension lines that lead to them, in points.
const DIMENSION: f32 = 1.0;
const EXTENSION: f32 = 0.7;
/// The type size of the numbers, as a part of the size of the window's text.
const TYPE: f32 = 0.92;

/// A stone with the dimensions of its profile.
pub struct MeasuredProfile<'a> {
    stone: &'a Stone,
    basis: Basis,
    /// The dimensions of the profile.
    pub dimensions: Dimensions,
    /// The cut, if it is one of possible proportions.
    pub cut: Option<Cut>,
}

impl<'a> MeasuredProfile<'a> {
    /// Measures a stone: a round brilliant by its proportions if they are possible, any other stone by its planes.
    pub fn new(stone: &'a Stone, cut: &Cut) -> Self {
        let cut = (cut.family().is_some() && cut.check().is_ok()).then(|| cut.clone());
        let brilliant = cut.as_ref().and_then(Cut::brilliant);
        let (basis, dimensions) = match brilliant.and_then(|given| Some((given, given.derived().ok()?))) {
            Some((given, derived)) => (BRILLIANT_BASIS, Dimensions::of_brilliant(given, &derived)),
            None => {
                let basis = across_the_width(stone);
                (basis, Dimensions::measured(stone, &basis))
            }
        };
        Self { stone, basis, dimensions, cut }
    }
}

/// A handle on the screen, and the response of egui to it.
pub struct Offered {
    pub grip: Grip,
    /// The response of egui to pointer and keyboard at the handle.
    pub response: Response,
}

impl Offered {
    /// Returns whether the pointer is over the handle or drags it.
    pub fn is_pointed_at(&self) -> bool {
        self.grip.reach > 0.0 && (self.response.hovered() || self.response.dragged())
    }
}

/// The content and the layout of one frame.
pub struct ProfileFrame<'a> {
    /// The identity of the drawing.
    pub id: Id,
    /// The projection from the profile to the screen.
    pub sight: ProfileProjection,
    /// The stone in the frame, with its dimensions.
    pub measured: &'a MeasuredProfile<'a>,
    rect: Rect,
    detail: LabelDetail,
    inks: ProfileInks,
    font: FontId,
}

impl<'a> ProfileFrame<'a> {
    /// Makes a frame that shows the part `extent` of a stone's profile within `rect`, with as many labels as can be read
    /// there.
    pub fn new(ui: &Ui, id: Id, rect: Rect, measured: &'a MeasuredProfile<'a>, extent: ProfileBox) -> Self {
        let body = TextStyle::Body.resolve(ui.style());
        let font = FontId::new(TYPE * body.size, body.family);
        let detail = LabelDetail::of(rect.size());
        let margins = detail.margins(&|text| size_of(ui.painter(), &font, text));
        let sight = ProfileProjection::fitting(extent, room(rect, margins));
        Self { id, sight, measured, rect, detail, inks: ProfileInks::of(ui.visuals()), font }
    }

    /// Offers the handles to pointer and keyboard. Only cuts of a family with handles have any.
    pub fn offer(&self, ui: &Ui) -> Vec<Offered> {
        let MeasuredProfile { cut, dimensions, .. } = self.measured;
        let all = cut.iter().flat_map(|cut| grips(cut, dimensions, &self.sight));
        all.map(|grip| Offered { response: grip.offer(ui, self.id), grip }).collect()
    }

    /// Paints everything, with the lines and numbers of the active handle in the accent colour. Returns the numbers for
    /// which there was room.
    pub fn paint(
        &self,
        ui: &Ui,
        offered: &[Offered],
        active: Option<Handle>,
        marks: &DrawnMarks,
    ) -> Vec<Label> {
        let painter = ui.painter_at(self.rect);
        let body = ProfileBody::new(self.measured.stone, self.measured.basis, &self.sight);
        let outline = body.outline();
        let (lines, labels) = self.plan(&painter, &outline, offered);
        let active = active.map(|handle| handle.row);
        lines.into_iter().for_each(|line| self.draw(&painter, line, active));
        body.paint(&painter, &self.inks, &outline);
        body.mark(&painter, marks);
        labels.iter().for_each(|label| self.write(&painter, label, active));
        self.paint_grips(ui, &painter, offered);
        labels
    }

    fn plan(&self, painter: &Painter, outline: &[Pos2], offered: &[Offered]) -> (Vec<SheetLine>, Vec<Label>) {
        let measure = |text: &str| size_of(painter, &self.font, text);
        let mut sheet = ProfileSheet::new(self.rect.shrink(2.0), outline, &measure);
        offered.iter().filter(|o| o.grip.reach > 0.0).for_each(|o| sheet.keep_clear(o.grip.square()));
        let MeasuredProfile { cut, dimensions, .. } = self.measured;
        let subject = ProfileSubject { dimensions, cut: cut.as_ref() };
        Planner::plan(subject, &self.sight, self.detail, sheet)
    }

    fn draw(&self, painter: &Painter, line: SheetLine, active: About) {
        let (colour, width) = match line.weight {
            Weight::Dimension => (self.inks.dimension, DIMENSION),
            Weight::Extension => (self.inks.extension, EXTENSION),
        };
        let is_active = active.is_some() && line.about == active;
        let colour = if is_active { self.inks.accent } else { colour };
        painter.add(Shape::line(line.points, Stroke::new(width, colour)));
    }

    fn write(&self, painter: &Painter, label: &Label, active: About) {
        let colour = self.colour(label.about, active);
        let galley = painter.layout_no_wrap(label.text.clone(), self.font.clone(), colour);
        if label.upright {
            let text = TextShape::new(label.frame.left_bottom(), galley, colour).with_angle(-FRAC_PI_2);
            painter.add(text);
        } else {
            painter.galley(label.frame.min, galley, colour);
        }
    }

    /// Returns the colour of a number: the accent colour for that of the active handle, a quiet one where it follows from
    /// another.
    fn colour(&self, about: About, active: About) -> Color32 {
        let follows = self.measured.cut.as_ref().zip(about).is_some_and(|(cut, row)| !(row.is_given)(cut));
        match about {
            Some(_) if about == active => self.inks.accent,
            _ if follows => self.inks.quiet,
            _ => self.inks.number,
        }
    }

    fn paint_grips(&self, ui: &Ui, painter: &Painter, offered: &[Offered]) {
        let near = ui.rect_contains_pointer(self.rect) || offered.iter().any(|o| o.response.has_focus());
        let near = ui.ctx().animate_bool_responsive(self.id.with("near"), near);
        let mut painter = painter.clone();
        // A drawing too small for numbers shows no handles until the pointer or the keyboard focus comes.
        painter.set_opacity(if self.detail == LabelDetail::None { near } else { 1.0 });
        for o in offered {
            let Offered { grip, response } = o;
            let pointed_at =
                ui.ctx().animate_bool_responsive(response.id.with("pointed at"), o.is_pointed_at());
            if grip.reach > 0.0 || response.has_focus() {
                grip.paint(&painter, &self.inks, [near, pointed_at], response.has_focus());
            }
        }
    }

    /// Reports the present values of the handles to screen readers.
    pub fn show_values(&self, ui: &Ui, offered: &[Offered], now: &Cut) {
        for Offered { grip, response } in offered.iter().filter(|o| !o.grip.mirrored) {
            grip.show_value(ui, response, (grip.handle.row.get)(now));
        }
    }
}

fn size_of(painter: &Painter, font: &FontId, text: &str) -> Vec2 {
    painter.layout_no_wrap(text.to_owned(), font.clone(), Color32::PLACEHOLDER).size()
}
