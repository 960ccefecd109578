//! Modes of a view: what makes its picture differ from the plain one. The head of the view names each mode; a click there
//! ends it.

use super::pane_context::PaneContext;
use crate::app::model::Model;
use crate::app::model::action::{Action, Edit, ViewAction};
use crate::app::model::eye::Eye;
use crate::app::shows::Shows;
use egui::{Button, RichText, TextStyle, Ui};

/// A mode that is on in a view.
#[derive(Debug, Clone, PartialEq)]
pub enum Mode {
    /// The view has an eye of its own.
    Unlinked,
    /// The stone is seen from nearby.
    Perspective,
    /// The eye tilts over a still stone.
    EyeTilts,
    /// Something is drawn over the picture; holds the name of the overlay.
    Overlay(String),
    /// A scope shows the strongest exit of each point alone.
    Strongest,
    /// The observer's head shuts out light; holds its half angle, degrees.
    Head(f64),
    /// Scopes hold the light that the outer surface reflects.
    Glare,
    /// Refraction is followed part of the way, 0 to 1, which is not physics.
    Strength(f64),
}

impl Mode {
    /// Returns the modes that are on in a view.
    pub fn of(model: &Model, pane: usize) -> Vec<Self> {
        let desk = &model.workspace;
        let shows = desk.panes[pane].shows;
        if !shows.is_seen() {
            return vec![];
        }
        let scope = shows.scoped();
        let is_scoped = scope.is_some();
        let takes_head = scope.is_some_and(|scope| scope.takes_head);
        let head = model.document.work.head;
        let strength = if shows == Shows::Render { desk.strength() } else { 1.0 };
        let overlay = desk.overlay.clone().filter(|_| shows.takes_overlay() && desk.overlay().is_some());
        [
            desk.panes[pane].own.map(|_| Self::Unlinked),
            desk.panes[pane].is_near.then_some(Self::Perspective),
            desk.eye(pane).eye_leans.then_some(Self::EyeTilts),
            overlay.map(Self::Overlay),
            (desk.strongest && is_scoped).then_some(Self::Strongest),
            (head > 0.0 && takes_head).then_some(Self::Head(head)),
            (desk.glare && !desk.strongest && is_scoped).then_some(Self::Glare),
            (strength < 1.0).then_some(Self::Strength(strength)),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// Returns the name of the mode, in a word or two.
    pub fn name(&self) -> String {
        match self {
            Self::Unlinked => "unlinked".to_owned(),
            Self::Perspective => "perspective".to_owned(),
            Self::EyeTilts => "eye tilts".to_owned(),
            Self::Overlay(name) => name.clone(),
            Self::Strongest => "strongest exits".to_owned(),
            Self::Head(degrees) => format!("head {degrees:.1}°"),
            Self::Glare => "with glare".to_owned(),
            Self::Strength(strength) => format!("strength {strength:.3}"),
        }
    }

    /// Describes in a sentence what the mode does to the picture.
    fn meaning(&self) -> &'static str {
        match self {
            Self::Unlinked => "This view has a tilt and a zoom of its own.",
            Self::Perspective => "The stone is seen from nearby, not along parallel rays.",
            Self::EyeTilts => "The eye moves over a still stone and light; else the stone tilts.",
            Self::Overlay(_) => "Something is drawn over all pictures.",
            Self::Strongest => "Scopes show the zone of each point's strongest light alone.",
            Self::Head(_) => "The observer's head shuts out light, here and in the figures.",
            Self::Glare => "Scopes show what the outer surface reflects as well, as a camera records it.",
            Self::Strength(_) => {
                "Strength below 1: a mixture of the refracted and the straight ray, for its looks, and no physics."
            }
        }
    }

    /// Returns what switches the mode off in its view.
    fn end(&self, cx: &PaneContext) -> Action {
        let pane = cx.pane;
        let change = match self {
            Self::Unlinked => ViewAction::Link(pane, true),
            Self::Perspective => ViewAction::EndPerspective(pane),
            Self::EyeTilts => ViewAction::Eye(pane, Eye { eye_leans: false, ..cx.eye() }),
            Self::Overlay(_) => ViewAction::Overlay(None),
            Self::Strongest => ViewAction::Strongest(false),
            Self::Head(_) => return Edit::Head(0.0).into(),
            Self::Glare => ViewAction::Glare(false),
            Self::Strength(_) => ViewAction::Strength(1.0),
        };
        change.into()
    }
}

/// Draws the names of a view's modes in a row; a menu at its end holds those that `width` points have no room for.
pub fn show(cx: &mut PaneContext, ui: &mut Ui, width: f32) {
    let modes = Mode::of(cx.model, cx.pane);
    let names: Vec<String> = modes.iter().map(|mode| format!("{} ×", mode.name())).collect();
    let gap = ui.spacing().item_spacing.x;
    let widths: Vec<f32> = names.iter().map(|name| button_width(ui, name) + gap).collect();
    let more = button_width(ui, &rest_label(modes.len())) + gap;
    let shown = match widths.iter().sum::<f32>() <= width {
        true => modes.len(),
        false => fitting(&widths, width - more),
    };
    let mut ended = None;
    for (mode, name) in modes.iter().zip(&names).take(shown) {
        if chip(ui, name, mode) {
            ended = Some(mode);
        }
    }
    if shown < modes.len() {
        let menu = ui.menu_button(RichText::new(rest_label(modes.len() - shown)).small(), |ui| {
            for (mode, name) in modes.iter().zip(&names).skip(shown) {
                if chip(ui, name, mode) {
                    ended = Some(mode);
                    ui.close();
                }
            }
        });
        let hidden: Vec<String> = modes[shown..].iter().map(Mode::name).collect();
        menu.response.on_hover_text(format!("Also on in this view: {}.", hidden.join(", ")));
    }
    if let Some(mode) = ended {
        cx.push(ViewAction::EndStep);
        cx.push(mode.end(cx));
    }
}

/// Returns the least width that the modes of a view need, points: that of the menu that holds them, or 0 where none is on.
pub fn least_width(cx: &PaneContext, ui: &Ui) -> f32 {
    let count = Mode::of(cx.model, cx.pane).len();
    if count == 0 { 0.0 } else { button_width(ui, &rest_label(count)) + ui.spacing().item_spacing.x }
}

/// Returns the name of the menu that holds the modes without room.
fn rest_label(count: usize) -> String {
    format!("+{count}")
}

fn chip(ui: &mut Ui, name: &str, mode: &Mode) -> bool {
    let button = Button::new(RichText::new(name).small()).selected(true);
    ui.add(button).on_hover_text(format!("{} Click to end it.", mode.meaning())).clicked()
}

fn button_width(ui: &Ui, text: &str) -> f32 {
    let font = TextStyle::Small.resolve(ui.style());
    let text = ui.painter().layout_no_wrap(text.to_owned(), font, ui.visuals().text_color()).size().x;
    text + 2.0 * ui.spacing().button_padding.x
}

/// Returns how many of these widths, from the first on, fit into `width`.
fn fitting(widths: &[f32], width: f32) -> usize {
    let ends = widths.iter().scan(0.0, |end, width| {
        *end += width;
        Some(*end)
    });
    ends.take_while(|end| *end <= width).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_fit_as_there_is_room_for() {
        let widths = [50.0, 40.0, 30.0];
        let counts = [-1.0, 49.0, 50.0, 95.0, 120.0, 500.0].map(|width| fitting(&widths, width));
        assert_eq!(counts, [0, 0, 1, 2, 3, 3]);
    }
}
