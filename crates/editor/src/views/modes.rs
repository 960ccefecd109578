//! Modes of a view: settings that make its picture differ from the plain one. The head of the view names each mode; a
//! click there ends it.

use super::pane_context::PaneContext;
use crate::menus::menu_button;
use brillianteer_scene::USUAL_BOUNCES;
use brillianteer_session::model::{
    Model,
    action::{Action, ViewAction},
    command::Command,
    eye::Eye,
    workspace::Pane,
};
use brillianteer_session::shows::Shows;
use egui::{Button, RichText, TextStyle, Ui};
use std::path::Path;

/// A mode that is on in a view.
#[derive(Debug)]
pub struct Mode {
    /// The name, a word or two.
    name: String,
    /// The effect of the mode on the picture, in a sentence.
    meaning: &'static str,
    /// The action that switches the mode off.
    end: Action,
}

fn mode(name: impl Into<String>, meaning: &'static str, end: impl Into<Action>) -> Mode {
    Mode { name: name.into(), meaning, end: end.into() }
}

impl Mode {
    /// Returns the modes that are on in a view.
    pub fn of(model: &Model, pane: usize) -> Vec<Self> {
        let workspace = &model.workspace;
        let Pane { shows, own, .. } = workspace.panes[pane];
        if !shows.is_seen() {
            return vec![];
        }
        let (eye, scope) = (*workspace.eye(pane), shows.scoped());
        let overlay =
            workspace.overlay.clone().filter(|_| shows.takes_overlay() && workspace.overlay().is_some());
        let of_view = [
            own.map(|_| {
                let meaning = "This view has a tilt and a zoom of its own.";
                mode("unlinked", meaning, ViewAction::Link(pane, true))
            }),
            workspace.is_near(pane).then(|| {
                let meaning = "The stone is seen from nearby, not along parallel rays.";
                mode("perspective", meaning, ViewAction::EndPerspective(pane))
            }),
            eye.eye_leans.then(|| {
                let meaning = "A drag tilts the eye, while stone and light stay.";
                mode("eye tilts", meaning, ViewAction::Eye(pane, Eye { eye_leans: false, ..eye }))
            }),
            overlay.map(|name| {
                mode(name, "This overlay is drawn over all pictures.", ViewAction::Overlay(None))
            }),
            (workspace.strongest && scope.is_some()).then(|| {
                let meaning = "Scopes show only the zone of each point's strongest light.";
                mode("strongest exits", meaning, Command::Strongest)
            }),
            (workspace.glare && !workspace.strongest && scope.is_some()).then(|| {
                let meaning =
                    "Scopes also show the light that the outer surface reflects, as a camera records it.";
                mode("with glare", meaning, Command::Glare)
            }),
        ];
        of_view.into_iter().flatten().chain(Self::of_settings(model, shows)).collect()
    }

    /// Returns the modes of the settings of pictures that are on where a view shows this.
    fn of_settings(model: &Model, shows: Shows) -> impl Iterator<Item = Self> {
        let settings = &model.document.work.settings;
        let head = settings.look.head_of_scopes();
        let scope_takes_head = shows.scoped().is_some_and(|scope| scope.takes_head);
        let takes_head = shows_light(shows) || scope_takes_head || shows == Shows::Contrast;
        let shows_background = shows_light(shows);
        let strength = if shows_background { settings.strength() } else { 1.0 };
        let bounces = if shows == Shows::Render { settings.look.bounces } else { USUAL_BOUNCES };
        let missing = settings.look.missing_background().filter(|_| shows_background);
        let of_settings = [
            (head > 0.0 && takes_head).then(|| {
                let meaning = "The observer's head blocks light, here and in the figures.";
                mode(format!("head {head:.1}°"), meaning, model.look_with(|look| look.head = None))
            }),
            missing.map(|path| missing_background(model, path)),
            (bounces < USUAL_BOUNCES).then(|| {
                let meaning =
                    "Light is followed through no more bounces than this; the rest of the light is dark.";
                mode(
                    format!("bounces ≤ {bounces}"),
                    meaning,
                    model.look_with(|look| look.bounces = USUAL_BOUNCES),
                )
            }),
            (strength < 1.0).then(|| {
                let meaning =
                    "Below 1, the refracted ray is mixed with the straight ray, which is not physics.";
                mode(format!("strength {strength:.3}"), meaning, model.look_with(|look| look.strength = 1.0))
            }),
        ];
        of_settings.into_iter().flatten()
    }
}

/// Returns whether a view shows the stone under light.
fn shows_light(shows: Shows) -> bool {
    matches!(shows, Shows::Render | Shows::Refraction)
}

/// Returns the mode of views whose background is this file, when it cannot be read.
fn missing_background(model: &Model, path: &Path) -> Mode {
    let meaning = "The file of the background cannot be read, so nothing is behind the stone, and the strength of \
                   refraction is 1.";
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    mode(format!("{name} is missing"), meaning, model.look_with(|look| look.background = None))
}

/// Draws the names of a view's modes in a row; a menu at its end holds those that `width` points have no room for.
pub fn show(cx: &mut PaneContext, ui: &mut Ui, width: f32) {
    let modes = Mode::of(cx.model, cx.pane);
    let names: Vec<String> = modes.iter().map(|mode| format!("{} ×", mode.name)).collect();
    let gap = ui.spacing().item_spacing.x;
    let widths: Vec<f32> = names.iter().map(|name| button_width(ui, name) + gap).collect();
    let more = button_width(ui, &rest_label(modes.len())) + gap;
    let shown =
        if widths.iter().sum::<f32>() <= width { modes.len() } else { fitting(&widths, width - more) };
    let mut ended = None;
    let chips = || names.iter().zip(&modes).enumerate();
    for (k, (name, mode)) in chips().take(shown) {
        if chip(ui, name, mode) {
            ended = Some(k);
        }
    }
    if shown < modes.len() {
        let rest = RichText::new(rest_label(modes.len() - shown)).small();
        let menu = menu_button(ui, rest, |ui| {
            for (k, (name, mode)) in chips().skip(shown) {
                if chip(ui, name, mode) {
                    ended = Some(k);
                    ui.close();
                }
            }
        });
        let hidden: Vec<&str> = modes[shown..].iter().map(|mode| mode.name.as_str()).collect();
        menu.response.on_hover_text(format!("Also on in this view: {}.", hidden.join(", ")));
    }
    if let Some(mode) = ended.and_then(|k| modes.into_iter().nth(k)) {
        cx.actions.push(ViewAction::EndStep);
        cx.actions.push(mode.end);
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
    ui.add(button).on_hover_text(format!("{} Click to switch it off.", mode.meaning)).clicked()
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
