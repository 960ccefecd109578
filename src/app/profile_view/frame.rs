//! What one frame shows: the stone, its dimensions, its handles; laid out, then painted.

use super::body::ProfileBody;
use super::grips::{Grip, grips};
use super::handle::Handle;
use super::ink::ProfileInks;
use super::plan::{LabelDetail, Planner, ProfileSubject};
use super::quantity::Quantity;
use super::sheet::{Label, ProfileSheet, SheetLine, Weight};
use super::sight::{ProfileBox, ProfileProjection};
use crate::cut::{Derived, RoundBrilliant};
use crate::math::Basis;
use crate::picture::profile::brilliant::BRILLIANT_BASIS;
use crate::picture::profile::{Dimensions, across_the_width};
use crate::scene::Stone;
use egui::epaint::TextShape;
use egui::{Color32, FontId, Id, Painter, Pos2, Rect, Response, Shape, Stroke, TextStyle, Ui, Vec2};
use std::f32::consts::FRAC_PI_2;

/// Widths of dimension lines and of those that lead to them, points.
const DIMENSION: f32 = 1.0;
const EXTENSION: f32 = 0.7;
/// Size of the numbers, of that of the window's text.
const TYPE: f32 = 0.92;

/// A stone as it is measured.
pub struct MeasuredProfile<'a> {
    stone: &'a Stone,
    basis: Basis,
    dimensions: Dimensions,
    /// A round brilliant, as given and derived.
    pub brilliant: Option<(RoundBrilliant, Derived)>,
}

impl<'a> MeasuredProfile<'a> {
    /// By its proportions if it has some that can be, else on its planes.
    pub fn new(stone: &'a Stone, given: Option<&RoundBrilliant>) -> Self {
        let brilliant = given.and_then(|given| Some((*given, given.derived().ok()?)));
        let (basis, dimensions) = match &brilliant {
            Some((given, derived)) => (BRILLIANT_BASIS, Dimensions::of_brilliant(given, derived)),
            None => {
                let basis = across_the_width(stone);
                (basis, Dimensions::measured(stone, &basis))
            }
        };
        Self { stone, basis, dimensions, brilliant }
    }

    /// The part of the profile that it fills.
    pub fn extent(&self) -> ProfileBox {
        ProfileBox::of(&self.dimensions)
    }
}

/// A handle on the screen, and what is done with it.
pub struct Offered {
    /// The handle.
    pub grip: Grip,
    /// What pointer and keyboard do with it.
    pub response: Response,
}

impl Offered {
    /// Whether the pointer is over it or has it in hand.
    pub fn is_pointed_at(&self) -> bool {
        self.grip.reach > 0.0 && (self.response.hovered() || self.response.dragged())
    }
}

/// What this frame shows, and where.
pub struct Frame<'a> {
    /// The drawing's identity.
    pub id: Id,
    /// From the profile to the screen.
    pub sight: ProfileProjection,
    measured: &'a MeasuredProfile<'a>,
    rect: Rect,
    detail: LabelDetail,
    inks: ProfileInks,
    font: FontId,
}

impl<'a> Frame<'a> {
    /// Shows part of a stone's profile within `rect`, with as much written on it as can be read there.
    pub fn new(ui: &Ui, id: Id, rect: Rect, measured: &'a MeasuredProfile<'a>, extent: ProfileBox) -> Self {
        let body = TextStyle::Body.resolve(ui.style());
        let font = FontId::new(TYPE * body.size, body.family);
        let detail = LabelDetail::of(rect.size());
        let margins = detail.margins(&|text| size_of(ui.painter(), &font, text));
        let sight = ProfileProjection::fitting(extent, margins.within(rect));
        Self { id, sight, measured, rect, detail, inks: ProfileInks::of(ui.visuals()), font }
    }

    /// Offers the handles, if there are any.
    pub fn offer(&self, ui: &Ui) -> Vec<Offered> {
        let all =
            self.measured.brilliant.iter().flat_map(|(given, derived)| grips(given, derived, &self.sight));
        all.map(|grip| Offered { response: grip.offer(ui, self.id), grip }).collect()
    }

    /// Paints everything, what belongs to the active handle in its colour; the numbers that there was room for.
    pub fn paint(&self, ui: &Ui, offered: &[Offered], active: Option<Handle>) -> Vec<Label> {
        let painter = ui.painter_at(self.rect);
        let body = ProfileBody::new(self.measured.stone, self.measured.basis, &self.sight);
        let outline = body.outline();
        let (lines, labels) = self.plan(&painter, &outline, offered);
        let active = active.map(Handle::quantity);
        lines.into_iter().for_each(|line| self.draw(&painter, line, active));
        body.paint(&painter, &self.inks, &outline);
        labels.iter().for_each(|label| self.write(&painter, label, active));
        self.paint_grips(ui, &painter, offered);
        labels
    }

    fn plan(&self, painter: &Painter, outline: &[Pos2], offered: &[Offered]) -> (Vec<SheetLine>, Vec<Label>) {
        let measure = |text: &str| size_of(painter, &self.font, text);
        let mut sheet = ProfileSheet::new(self.rect.shrink(2.0), outline, &measure);
        offered.iter().filter(|o| o.grip.reach > 0.0).for_each(|o| sheet.keep_clear(o.grip.square()));
        let brilliant = self.measured.brilliant.as_ref().map(|(given, derived)| (given, derived));
        let subject = ProfileSubject { dimensions: &self.measured.dimensions, brilliant };
        Planner::plan(subject, &self.sight, self.detail, sheet)
    }

    fn draw(&self, painter: &Painter, line: SheetLine, active: Option<Quantity>) {
        let (colour, width) = match line.weight {
            Weight::Dimension => (self.inks.dimension, DIMENSION),
            Weight::Extension => (self.inks.extension, EXTENSION),
        };
        let is_active = active.is_some() && line.about == active;
        let colour = if is_active { self.inks.accent } else { colour };
        painter.add(Shape::line(line.points, Stroke::new(width, colour)));
    }

    fn write(&self, painter: &Painter, label: &Label, active: Option<Quantity>) {
        let colour = self.colour(label.about, active);
        let galley = painter.layout_no_wrap(label.text.clone(), self.font.clone(), colour);
        if label.upright {
            let text = TextShape::new(label.frame.left_bottom(), galley, colour).with_angle(-FRAC_PI_2);
            painter.add(text);
        } else {
            painter.galley(label.frame.min, galley, colour);
        }
    }

    /// Of a number; those that follow from others are quiet, that of the active handle is not.
    fn colour(&self, about: Option<Quantity>, active: Option<Quantity>) -> Color32 {
        let follows =
            self.measured.brilliant.as_ref().zip(about).is_some_and(|((given, _), q)| q.follows(given));
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
        // A drawing too small for numbers is a picture until the pointer comes.
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

    /// Tells screen readers what the handles are worth now.
    pub fn show_values(&self, ui: &Ui, offered: &[Offered], now: &RoundBrilliant) {
        let Ok(derived) = now.derived() else { return };
        for Offered { grip, response } in offered.iter().filter(|o| !o.grip.mirrored) {
            grip.show_value(ui, response, grip.handle.quantity().of(now, &derived));
        }
    }
}

fn size_of(painter: &Painter, font: &FontId, text: &str) -> Vec2 {
    painter.layout_no_wrap(text.to_owned(), font.clone(), Color32::PLACEHOLDER).size()
}
