//! The menu bar, the status line at the bottom, and the keys.

use super::panels::row_focus;
use super::scrolled::scrolled;
use super::setup::PaintedBy;
use super::shortcuts::{letter, shortcuts};
use brillianteer_files::library::SCENES;
use brillianteer_session::model::{
    Model,
    action::{Action, Actions, FileAction},
    command::{Command, MENUS, Menu},
    dialog::Then,
    preset::{Known, PRESETS},
    session::{HeldKeys, Session},
};
use egui::{
    Align, Button, Context, Event, InnerResponse, Key, Modifiers, Panel, Popup, Response, RichText,
    ThemePreference, Ui, WidgetText,
};

/// Draws the menu bar.
pub fn bar(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    Panel::top("menus").show(ui, |ui| {
        egui::MenuBar::new().ui(ui, |ui| {
            for menu in &MENUS {
                let shown = menu_button(ui, menu.title, |ui| entries(model, actions, ui, menu));
                let is_pressed = |key| ui.input_mut(|i| i.consume_key(Modifiers::ALT, key));
                if model.session.dialog.is_none() && letter(menu).is_some_and(is_pressed) {
                    // The focus lets the arrow keys go on from the opened menu.
                    shown.response.request_focus();
                    Popup::toggle_id(ui.ctx(), Popup::default_response_id(&shown.response));
                }
            }
            ui.separator();
            ui.with_layout(egui::Layout::right_to_left(Align::Center), |ui| {
                themes(ui);
                ui.with_layout(egui::Layout::left_to_right(Align::Center), |ui| title(model, ui));
            });
        });
    });
}

/// Draws the title of the document, shortened where the window is narrow.
fn title(model: &Model, ui: &mut Ui) {
    let mark = "not saved";
    let room = if model.document.is_changed() { 80.0 } else { 0.0 };
    ui.scope(|ui| {
        ui.set_max_width((ui.available_width() - room).max(0.0));
        ui.add(egui::Label::new(RichText::new(model.document.title()).strong()).truncate());
    });
    if room > 0.0 {
        ui.label(RichText::new(mark).weak());
    }
}

/// The space that menus leave free below the bar and above the lower edge of the window, points.
const AROUND_MENU: f32 = 56.0;

/// Draws the button of a menu or of a menu in a menu.
pub fn menu_button<R>(
    ui: &mut Ui,
    title: impl Into<WidgetText>,
    contents: impl FnOnce(&mut Ui) -> R,
) -> InnerResponse<Option<R>> {
    ui.menu_button(title.into(), |ui| within_window(ui, contents))
}

/// Draws the contents of a menu, which scroll where the window is lower than they are.
pub fn within_window<R>(ui: &mut Ui, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let height = ui.ctx().content_rect().height() - AROUND_MENU;
    // Without this, a menu would be no higher than egui's areas are by default.
    ui.set_max_height(height);
    scrolled(ui, "menu", height, contents)
}

fn entries(model: &Model, actions: &mut Actions, ui: &mut Ui, menu: &Menu) {
    for (k, group) in menu.groups.iter().enumerate() {
        if k > 0 {
            ui.separator();
        }
        group.iter().for_each(|&command| entry(model, actions, ui, command));
        if menu.title == "File" && k == 0 {
            opened_before(model, actions, ui);
            scenes_of_glass(actions, ui);
            scenes_of_gems(actions, ui);
        }
    }
}

/// Draws the choice of the theme: light, dark, or that of the system.
fn themes(ui: &mut Ui) {
    let ctx = ui.ctx().clone();
    let now = ctx.options(|o| o.theme_preference);
    let all = [
        (ThemePreference::System, "System"),
        (ThemePreference::Dark, "Dark"),
        (ThemePreference::Light, "Light"),
    ];
    let name = all.iter().find(|(theme, _)| *theme == now).map_or("Theme", |(_, name)| name);
    menu_button(ui, format!("Theme: {name}"), |ui| {
        for (theme, name) in all {
            if ui.selectable_label(now == theme, name).clicked() {
                ctx.set_theme(theme);
                ui.close();
            }
        }
    });
}

/// Draws a menu entry that carries out a command.
pub fn entry(model: &Model, actions: &mut Actions, ui: &mut Ui, command: Command) {
    let keys = shortcuts(command).next().map_or(String::new(), |s| ui.ctx().format_shortcut(&s));
    let button = Button::new(command.name()).shortcut_text(keys).selected(model.is_chosen(command));
    let entry = ui.add_enabled(model.is_possible(command), button).on_hover_text(command.meaning());
    choose(actions, ui, &entry, command);
}

/// Adds the action of a menu's entry and closes the menu, where the entry was clicked.
pub fn choose(actions: &mut Actions, ui: &Ui, entry: &Response, action: impl Into<Action>) {
    if entry.clicked() {
        actions.push(action);
        ui.close();
    }
}

fn opened_before(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    ui.add_enabled_ui(!model.workspace.recent.is_empty(), |ui| {
        menu_button(ui, "Open recent", |ui| {
            for path in &model.workspace.recent {
                let name = path
                    .file_name()
                    .map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into());
                let entry = ui.button(name).on_hover_text(path.display().to_string());
                choose(actions, ui, &entry, FileAction::Ask(Then::open(path.clone())));
            }
        });
    });
}

fn scenes_of_glass(actions: &mut Actions, ui: &mut Ui) {
    menu_button(ui, "Scene of glass", |ui| {
        for Known { name, title, .. } in &PRESETS {
            let about = "A preset that recreates a published demonstration of spectral refraction.";
            let entry = ui.button(*title).on_hover_text(about);
            choose(actions, ui, &entry, FileAction::Ask(Then::Preset((*name).to_owned())));
        }
    });
}

/// The scenes of gems and rings that come with the program.
fn scenes_of_gems(actions: &mut Actions, ui: &mut Ui) {
    menu_button(ui, "Scene of gems", |ui| {
        let is_glass = |name: &str| PRESETS.iter().any(|known| known.name == name);
        for (name, _) in SCENES.into_iter().filter(|(name, _)| !is_glass(name)) {
            let about = "Several stones, or a ring with its stones. One design is edited; renders show all.";
            let entry = ui.button(scene_title(name)).on_hover_text(about);
            choose(actions, ui, &entry, FileAction::Ask(Then::Preset(name.to_owned())));
        }
    });
}

/// Returns the title in menus of a scene that comes with the program.
fn scene_title(name: &str) -> String {
    let mut letters = name.chars();
    let first = letters.next().map(|letter| letter.to_ascii_uppercase());
    first.into_iter().chain(letters).map(|letter| if letter == '-' { ' ' } else { letter }).collect()
}

/// Draws the status line at the bottom of the window.
pub fn status(session: &Session, state: &str, (device, painted_by): (&str, PaintedBy), ui: &mut Ui) {
    Panel::bottom("status").show(ui, |ui| {
        ui.horizontal(|ui| {
            // The state is laid out first, so that a long message is shortened and does not push it out.
            ui.with_layout(egui::Layout::right_to_left(Align::Center), |ui| {
                ui.label(RichText::new(format!("{state} · {device}")).weak().small())
                    .on_hover_text(format!(
                        "The device that computes the pictures: the processor or a graphics card. The {} paints the \
                            window.",
                        painted_by.name()
                    ));
                let note = session.notes.said().unwrap_or_default();
                let text = if session.message.is_empty() { note } else { &session.message };
                ui.with_layout(egui::Layout::left_to_right(Align::Center), |ui| {
                    ui.add(egui::Label::new(text).truncate());
                });
            });
        });
    });
}

/// Carries out the commands whose keys were pressed.
pub fn keys(model: &Model, actions: &mut Actions, ctx: &Context, is_picture_focused: bool) {
    if model.session.dialog.is_some() {
        return;
    }
    let pressed = |event: &Event| match event {
        Event::Key { key, pressed: true, modifiers, .. } => Some((*key, *modifiers)),
        _ => None,
    };
    // Keys count one by one, in the order in which they arrived: several may arrive within one frame.
    for (key, modifiers) in ctx.input(|i| i.events.iter().filter_map(pressed).collect::<Vec<_>>()) {
        let is_meant =
            |c: &Command| shortcuts(*c).any(|s| s.logical_key == key && modifiers.matches_exact(s.modifiers));
        let Some(command) = Command::ALL.into_iter().find(is_meant) else { continue };
        if !modifiers.command && !is_function(key) && row_focus::holds_keys(ctx) {
            continue;
        }
        // Space presses the button that has the focus, and follows a ray in the picture that has it where there are no copies
        // to lay out.
        let is_busy = ctx.memory(|m| m.focused().is_some()) && !is_picture_focused;
        if command == Command::LayOut && (is_busy || !model.is_possible(command)) {
            continue;
        }
        ctx.input_mut(|i| i.consume_key(modifiers, key));
        actions.push(command);
    }
}

/// Returns whether a key types nothing, so that it acts wherever the focus is.
fn is_function(key: Key) -> bool {
    key.name().strip_prefix('F').is_some_and(|number| number.parse::<u8>().is_ok())
}

/// Returns the state of the held keys that change what views show.
pub fn held_keys(ctx: &Context) -> HeldKeys {
    HeldKeys { other: is_down(ctx, Key::C), three: is_down(ctx, Key::Z) }
}

fn is_down(ctx: &Context, key: Key) -> bool {
    !row_focus::holds_keys(ctx) && ctx.input(|i| i.key_down(key) && i.modifiers.is_none())
}
