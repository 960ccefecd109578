//! Modes of a view: what makes its picture differ from the plain one. The head of the view names each mode; a click there
//! ends it.

use crate::app::editor::Editor;
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
    pub fn of(editor: &Editor, pane: usize) -> Vec<Self> {
        let desk = &editor.model.workspace;
        let shows = desk.panes[pane].shows;
        if !shows.is_seen() {
            return vec![];
        }
        let scope = shows.scoped();
        let is_scoped = scope.is_some();
        let takes_head = scope.is_some_and(|scope| scope.takes_head);
        let head = editor.model.document.work.head;
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

    /// Switches the mode off.
    pub fn end(&self, editor: &mut Editor, pane: usize) {
        let desk = &mut editor.model.workspace;
        match self {
            Self::Unlinked => desk.panes[pane].own = None,
            Self::Perspective => desk.panes[pane].is_near = false,
            Self::EyeTilts => desk.eye_mut(pane).eye_leans = false,
            Self::Overlay(_) => desk.overlay = None,
            Self::Strongest => desk.strongest = false,
            Self::Head(_) => editor.model.document.work.head = 0.0,
            Self::Glare => desk.glare = false,
            Self::Strength(_) => desk.strength = 1.0,
        }
    }
}

/// Draws the names of a view's modes in a row; a menu at its end holds those that `width` points have no room for.
pub fn show(editor: &mut Editor, ui: &mut Ui, pane: usize, width: f32) {
    let modes = Mode::of(editor, pane);
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
        editor.model.session.views.settle();
        mode.end(editor, pane);
    }
}

/// Returns the least width that the modes of a view need, points: that of the menu that holds them, or 0 where none is on.
pub fn least_width(editor: &Editor, ui: &Ui, pane: usize) -> f32 {
    let count = Mode::of(editor, pane).len();
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
