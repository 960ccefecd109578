//! The menu bar, the status line at the bottom, and the keys.

use crate::app::dialogs::{Dialog, Then};
use crate::app::editor::Editor;
use crate::app::model::command::{Command, MENUS, Menu};
use crate::app::model::compare::Compared;
use crate::app::model::opening::Opening;
use crate::app::model::preset::{Known, PRESETS};
use crate::app::model::workspace::PaneLayout;
use crate::app::studio::Which;
use crate::app::tasks::files::Purpose;
use crate::io::{cut_file, library};
use egui::{
    Align, Button, Context, Event, Key, Modifiers, Panel, PanelState, Popup, RichText, ThemePreference, Ui,
    ViewportCommand,
};
use std::path::PathBuf;

/// Draws the menu bar.
pub fn bar(editor: &mut Editor, ui: &mut Ui) {
    Panel::top("menus").show(ui, |ui| {
        egui::MenuBar::new().ui(ui, |ui| {
            for menu in &MENUS {
                let shown =
                    ui.menu_button(menu.title, |ui| within_window(ui, |ui| entries(editor, ui, menu)));
                let is_asked = |key| ui.input_mut(|i| i.consume_key(Modifiers::ALT, key));
                if editor.dialog.is_none() && menu.key().is_some_and(is_asked) {
                    // The focus lets the arrow keys go on from the opened menu.
                    shown.response.request_focus();
                    Popup::toggle_id(ui.ctx(), Popup::default_response_id(&shown.response));
                }
            }
            ui.separator();
            ui.with_layout(egui::Layout::right_to_left(Align::Center), |ui| {
                themes(ui);
                ui.with_layout(egui::Layout::left_to_right(Align::Center), |ui| title(editor, ui));
            });
        });
    });
}

/// Draws the title of the document, shortened where the window is narrow.
fn title(editor: &Editor, ui: &mut Ui) {
    let mark = "not saved";
    let room = if editor.document.is_changed() { 80.0 } else { 0.0 };
    ui.scope(|ui| {
        ui.set_max_width((ui.available_width() - room).max(0.0));
        ui.add(egui::Label::new(RichText::new(editor.document.title()).strong()).truncate());
    });
    if room > 0.0 {
        ui.label(RichText::new(mark).weak());
    }
}

/// The space that menus leave free below the bar and above the lower edge of the window, points.
const AROUND_MENU: f32 = 56.0;

/// Draws the contents of a menu, which scroll where the window is lower than they are.
fn within_window(ui: &mut Ui, contents: impl FnOnce(&mut Ui)) {
    let height = ui.ctx().content_rect().height() - AROUND_MENU;
    // Without this, a menu would be no higher than egui's areas are by default.
    ui.set_max_height(height);
    egui::ScrollArea::vertical().max_height(height).show(ui, contents);
}

fn entries(editor: &mut Editor, ui: &mut Ui, menu: &Menu) {
    for (k, group) in menu.groups.iter().enumerate() {
        if k > 0 {
            ui.separator();
        }
        group.iter().for_each(|&command| entry(editor, ui, command));
        if menu.title == "File" && k == 0 {
            opened_before(editor, ui);
            from_library(editor, ui);
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
    ui.menu_button(format!("Theme: {name}"), |ui| {
        for (theme, name) in all {
            if ui.selectable_label(now == theme, name).clicked() {
                ctx.set_theme(theme);
                ui.close();
            }
        }
    });
}

/// Draws a menu entry that carries out a command.
pub fn entry(editor: &mut Editor, ui: &mut Ui, command: Command) {
    let keys = command.shortcut().map_or(String::new(), |s| ui.ctx().format_shortcut(&s));
    let button = Button::new(command.name()).shortcut_text(keys).selected(editor.is_chosen(command));
    if ui.add_enabled(is_possible(editor, command), button).on_hover_text(command.meaning()).clicked() {
        let ctx = ui.ctx().clone();
        does(editor, command, &ctx);
        ui.close();
    }
}

fn opened_before(editor: &mut Editor, ui: &mut Ui) {
    ui.add_enabled_ui(!editor.desk.recent.is_empty(), |ui| {
        ui.menu_button("Open recent", |ui| {
            let recent: Vec<PathBuf> = editor.desk.recent.clone();
            for path in recent {
                let name = path
                    .file_name()
                    .map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into());
                if ui.button(name).on_hover_text(path.display().to_string()).clicked() {
                    editor.ask_before(Then::open(path));
                    ui.close();
                }
            }
        });
    });
}

fn from_library(editor: &mut Editor, ui: &mut Ui) {
    ui.menu_button("New from", |ui| {
        for (name, text) in library::CUTS {
            let design = cut_file::parse(text, name).ok();
            let title = design.as_ref().map_or(name, |d| d.name.as_str());
            let source = design
                .as_ref()
                .and_then(|d| d.source.as_deref())
                .unwrap_or("A cut that comes with the program.");
            if ui.button(title).on_hover_text(source).clicked() {
                editor.ask_before(Then::Library(name.to_owned()));
                ui.close();
            }
        }
    });
    ui.menu_button("Scene of glass", |ui| {
        for Known { name, title, .. } in PRESETS {
            let about = "A preset of a published demonstration of spectral refraction.";
            if ui.button(title).on_hover_text(about).clicked() {
                editor.ask_before(Then::Preset(name.to_owned()));
                ui.close();
            }
        }
    });
}

fn is_possible(editor: &Editor, command: Command) -> bool {
    let (undo, redo) = editor.document.steps();
    let (back, on) = editor.looks.steps();
    match command {
        Command::ViewBack => back,
        Command::ViewOn => on,
        Command::Undo => undo,
        Command::Redo => redo,
        Command::Save => editor.document.is_changed() || editor.document.path().is_none(),
        Command::LayOut => editor.document.work.company.poses.len() > 1,
        Command::Split | Command::NoCompare => editor.compared.is_some(),
        _ => true,
    }
}

/// Draws the status line at the bottom of the window.
pub fn status(editor: &mut Editor, ui: &mut Ui) {
    Panel::bottom("status").show(ui, |ui| {
        ui.horizontal(|ui| {
            // The state is laid out first, so that a long message is shortened and does not push it out.
            ui.with_layout(egui::Layout::right_to_left(Align::Center), |ui| {
                let opening = editor.opening.last().map(Opening::message);
                let tracing = match (editor.studio.is_idle(), editor.studio.sharpens()) {
                    (false, _) => "tracing…",
                    (true, true) => "sharpening…",
                    (true, false) => "done",
                };
                let state = opening.unwrap_or_else(|| tracing.to_owned());
                ui.label(RichText::new(format!("{state} · {}", editor.studio.device_name())).weak().small())
                    .on_hover_text(format!(
                        "What computes the pictures: the processor, or a graphics card. The window is painted by the {}.",
                        editor.painted_by.name()
                    ));
                let said = editor.notes.said().unwrap_or_default();
                let told = if editor.message.is_empty() { said } else { &editor.message };
                ui.with_layout(egui::Layout::left_to_right(Align::Center), |ui| {
                    ui.add(egui::Label::new(told).truncate());
                });
            });
        });
    });
}

/// Carries out the commands whose keys were pressed.
pub fn keys(editor: &mut Editor, ctx: &Context) {
    if editor.dialog.is_some() {
        return;
    }
    let pressed = |event: &Event| match event {
        Event::Key { key, pressed: true, modifiers, .. } => Some((*key, *modifiers)),
        _ => None,
    };
    // Keys count one by one, in the order in which they arrived: several may arrive within one frame.
    for (key, modifiers) in ctx.input(|i| i.events.iter().filter_map(pressed).collect::<Vec<_>>()) {
        let is_meant =
            |c: &Command| c.shortcuts().any(|s| s.logical_key == key && modifiers.matches_exact(s.modifiers));
        let Some(command) = Command::all().find(is_meant) else { continue };
        if !modifiers.command && ctx.text_edit_focused() {
            continue;
        }
        // Space presses the button that has the focus, and follows a ray in the picture that has it where there are no copies
        // to lay out.
        let is_busy = ctx.memory(|m| m.focused().is_some()) && !editor.is_picture_focused;
        if command == Command::LayOut && (is_busy || !is_possible(editor, command)) {
            continue;
        }
        ctx.input_mut(|i| i.consume_key(modifiers, key));
        if is_possible(editor, command) {
            does(editor, command, ctx);
        }
    }
}

/// Whether the key is held that shows the design compared with in place of the present one.
pub fn is_other_shown(ctx: &Context) -> bool {
    is_down(ctx, Key::C)
}

/// Whether the key is held that shows renders in three bands of wavelengths alone.
pub fn are_three_shown(ctx: &Context) -> bool {
    is_down(ctx, Key::Z)
}

fn is_down(ctx: &Context, key: Key) -> bool {
    !ctx.text_edit_focused() && ctx.input(|i| i.key_down(key) && i.modifiers.is_none())
}

/// Carries out a command.
pub fn does(editor: &mut Editor, command: Command, ctx: &Context) {
    editor.looks.settle();
    let desk = &mut editor.desk;
    match command {
        Command::ViewBack => editor.looks.back(desk),
        Command::ViewOn => editor.looks.on(desk),
        Command::Open => editor.choose(Purpose::Open),
        Command::Save => drop(editor.save()),
        Command::SaveAs => editor.choose(Purpose::SaveAs),
        Command::Export => editor.dialog = Some(Dialog::export(editor)),
        Command::CopyPicture => copy(editor, ctx),
        Command::Quit => editor.ask_before(Then::Close),
        Command::Undo => editor.document.undo(),
        Command::Redo => editor.document.redo(),
        Command::Top | Command::Side | Command::Bottom | Command::Free | Command::Fit => {
            look(editor, command)
        }
        Command::Perspective => {
            let pane = editor.active();
            let pane = &mut editor.desk.panes[pane];
            pane.is_near = pane.shows.is_seen() && !pane.is_near;
        }
        Command::EyeLeans => {
            let eye = eye(editor);
            eye.eye_leans = !eye.eye_leans;
        }
        Command::One => (desk.layout, desk.large) = (PaneLayout::One, None),
        Command::Two => (desk.layout, desk.large) = (PaneLayout::Two, None),
        Command::Four => (desk.layout, desk.large) = (PaneLayout::Four, None),
        Command::Wireframe => desk.toggle_overlay("wireframe"),
        Command::Facets => desk.toggle_overlay("facets"),
        Command::Bounces => desk.toggle_overlay("bounces"),
        Command::Unresolved => desk.toggle_overlay("unresolved"),
        Command::Total => desk.toggle_overlay("total"),
        Command::Strongest => desk.strongest = !desk.strongest,
        Command::Glare => desk.glare = !desk.glare,
        Command::CompareSaved => match Compared::of_saved(&editor.document) {
            Ok(compared) => editor.compared = Some(compared),
            Err(why) => editor.notes.trouble(why),
        },
        Command::CompareFile => editor.choose(Purpose::Compare),
        Command::Split => desk.is_split = !desk.is_split,
        Command::NoCompare => editor.compare_no_more(),
        Command::Play => editor.moving.is_on = !editor.moving.is_on,
        Command::NextBehind => desk.next_behind(),
        Command::Panels => desk.hides_panels = !desk.hides_panels,
        Command::FullScreen => {
            let is_full = ctx.input(|i| i.viewport().fullscreen == Some(true));
            ctx.send_viewport_cmd(ViewportCommand::Fullscreen(!is_full));
        }
        Command::ResetView => {
            desk.reset_view();
            editor.framing.renew(editor.document.specimen());
        }
        Command::ResetLayout => {
            desk.reset_layout();
            // Panels keep the widths that the user gave them until egui forgets these.
            ctx.data_mut(|data| data.remove_by_type::<PanelState>());
        }
        Command::LayOut => editor.lay_out(editor.document.work.company.poses.len()),
        Command::LightPath => editor.following.is_open = !editor.following.is_open,
        Command::Keys => editor.dialog = Some(Dialog::Keys),
        Command::About => editor.dialog = Some(Dialog::About(Box::default())),
    }
}

/// Looks at the present stone from another side, and shows the whole stone.
fn look(editor: &mut Editor, command: Command) {
    editor.framing.renew(editor.document.specimen());
    let eye = eye(editor);
    match command {
        Command::Top => eye.top(),
        Command::Side => eye.side(),
        Command::Bottom => eye.bottom(),
        Command::Free => eye.free(),
        _ => eye.fit(),
    }
}

/// Returns the eye of the view that keys act on.
fn eye(editor: &mut Editor) -> &mut crate::app::model::eye::Eye {
    let pane = editor.active();
    editor.desk.eye_mut(pane)
}

fn copy(editor: &mut Editor, ctx: &Context) {
    let pane = editor.active();
    let which = if is_other_shown(ctx) && editor.compared.is_some() { Which::Other } else { Which::Present };
    let shows = editor.desk.panes[pane].shows;
    match editor.shown((pane, which)).filter(|p| p.shot.shows == shows) {
        Some(picture) => {
            ctx.copy_image(picture.taken.image.clone());
            editor.notes.say(&format!("{} copied", shows.name()));
        }
        None => editor.notes.say("This view holds no picture to copy."),
    }
}
