//! The row over the picture of a view: the choice of the picture, the modes that are on, and the state of the
//! picture.

use super::gallery::Shown;
use super::pane_context::{PaneContext, has_room};
use super::{modes, refraction_view};
use crate::theme;
use brillianteer_scene::Glare;
use brillianteer_session::model::action::ViewAction;
use brillianteer_session::shows::Shows;
use brillianteer_session::studio::{Grade, Shot, Which};
use egui::{Align, ComboBox, Layout, RichText, Role, Ui, WidgetInfo};

/// The width of the choice of the picture where the view is narrow, points.
const LEAST_CHOICE: f32 = 64.0;
/// The width of that choice where the view is not narrow, points.
const CHOICE: f32 = 120.0;

/// The room for the button at the end of the row, points.
const ENLARGE: f32 = 76.0;

/// Draws the row.
pub fn show(cx: &mut PaneContext, ui: &mut Ui) {
    choice(cx, ui);
    let (document, session) = (&cx.model.document, &cx.model.session);
    if let Some(compared) = session.compared.as_ref().filter(|_| cx.shows.is_seen()) {
        let name = if session.keys.other { compared.name.as_str() } else { "present" };
        ui.label(RichText::new(name).weak());
    }
    if document.shows_last_possible() && !cx.shows.is_pane() {
        let why = document.fault().map(ToString::to_string).unwrap_or_default();
        let text = RichText::new("last possible stone").color(theme::bad(ui.visuals())).small();
        ui.label(text)
            .on_hover_text(format!("The design is impossible, so this is the last possible stone. {why}"));
    }
    modes::show(cx, ui, ui.available_width() - ENLARGE);
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| from_right(cx, ui));
}

/// Draws the choice of the picture or drawing in the view.
fn choice(cx: &mut PaneContext, ui: &mut Ui) {
    let (shows, pane) = (cx.shows, cx.pane);
    let taken = ENLARGE + modes::least_width(cx, ui);
    let width = (ui.available_width() - taken).clamp(LEAST_CHOICE, CHOICE);
    let combo = ComboBox::from_id_salt(("shows", pane)).selected_text(shows.name()).width(width);
    let mut chosen = shows;
    let shown = combo.height(420.0).truncate().show_ui(ui, |ui| {
        for other in Shows::ALL {
            ui.selectable_value(&mut chosen, other, other.name()).on_hover_text(other.meaning());
        }
    });
    cx.actions.push_changed(&shows, chosen, |shows| ViewAction::Show(pane, shows));
    let name = format!("View {}: {}", pane + 1, shows.name());
    let response = shown.response.on_hover_text(shows.meaning());
    response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, &name));
}

/// Draws the end of the row, from the right.
fn from_right(cx: &mut PaneContext, ui: &mut Ui) {
    let (shows, pane, workspace) = (cx.shows, cx.pane, &cx.model.workspace);
    if workspace.layout.panes() > 1 {
        let name = if workspace.large == Some(pane) { "All views" } else { "Enlarge" };
        let meaning =
            format!("Shows view {} alone, or all views again; a double click does the same.", pane + 1);
        cx.actions.push_if(ui.small_button(name).on_hover_text(meaning).clicked(), ViewAction::Enlarge(pane));
    }
    if shows == Shows::Refraction {
        refraction_view::choices(&mut cx.flowing, ui);
    }
    // The modes of a view say where it is not linked.
    if shows.is_seen() && workspace.panes[pane].own.is_none() && has_room(ui, 80.0) {
        let linked = ui.checkbox(&mut true, "Linked");
        if linked.on_hover_text("Tilts and zooms together with all other linked views.").changed() {
            cx.actions.push(ViewAction::Link(pane, false));
        }
    }
    if (shows.is_seen() || shows == Shows::TracedPane) && has_room(ui, 64.0) {
        state(cx, ui);
    }
}

/// Draws the state of the picture, in a word or two.
fn state(cx: &PaneContext, ui: &mut Ui) {
    let Some(shown) = cx.shown(Which::Present) else { return };
    let Shown { grade, taken, shot, .. } = shown;
    let (text, meaning) = match (grade, taken.unresolved) {
        (Grade::Fine, Some(part)) => {
            let percent = 100.0 * part;
            (format!("± {percent:.2} %"), format!("{percent:.3} % of the light was not followed to its end."))
        }
        (Grade::Fine, None) => {
            (String::new(), "It is unknown how much of the light was not followed to its end.".into())
        }
        _ => ("…".to_owned(), "Becoming finer.".to_owned()),
    };
    if let Some((reading, meaning)) = reading(shot).filter(|_| has_room(ui, 150.0)) {
        ui.label(RichText::new(reading).weak().small()).on_hover_text(meaning);
    }
    ui.label(RichText::new(text).weak().small())
        .on_hover_text(format!("Computed by {}. {meaning}", taken.tracer));
}

/// Returns, in two words and in a sentence, that a picture in a scope leaves out glare; `None` where it does not.
fn reading(shot: &Shot) -> Option<(&'static str, &'static str)> {
    shot.shows.scoped()?;
    (!shot.strongest && shot.glare == Glare::LeftOut).then_some((
        "without glare",
        "Shows all light that has been inside the stone, without the light that the outer surface reflects.",
    ))
}
