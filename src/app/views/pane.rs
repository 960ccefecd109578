//! One view: what it shows, and what pointer and keys do to it.

use crate::app::editor::Editor;
use crate::app::liquid;
use crate::app::model::eye::Eye;
use crate::app::shows::Shows;
use crate::app::studio::{Grade, Shot, Which};
use crate::app::theme;
use crate::app::views::copies;
use crate::app::views::gallery::Shown;
use crate::app::views::modes;
use crate::app::views::probe::ProbeHit;
use crate::app::views::refraction_view;
use crate::app::views::view_menu;
use crate::cut::Cut;
use crate::math::SolidRef;
use crate::scene::{ASET_CONE, Backing, Film, Glare, Scope, Side, Specimen, View};
use crate::trace::ray::Camera;
use egui::{
    Align, Color32, ComboBox, EventFilter, Key, Modifiers, PointerButton, Rect, Response, RichText, Role,
    Sense, Stroke, StrokeKind, Ui, UiBuilder, WidgetInfo, pos2, vec2,
};
use glam::{DMat2, DVec2, DVec3};
use std::sync::Arc;

/// The height of the row over a picture, points.
const HEAD: f32 = 28.0;

/// The width of the choice of what a view shows, where the view is narrow, points.
const LEAST_CHOICE: f32 = 64.0;
/// The width of that choice where the view is not narrow, points.
const CHOICE: f32 = 120.0;

/// The room for the button at the end of the row over a picture, points.
const ENLARGE: f32 = 76.0;

/// How far an arrow key tilts the stone, alone and with Shift, radians.
const STEP: (f64, f64) = (0.017_453_292_519_943_295, 0.087_266_462_599_716_48);

/// How far Alt and an arrow key move the picture, girdle radii of a stone that fits its view.
const ASIDE: f64 = 0.1;

/// The logarithm of the zoom for each point that the wheel scrolls by.
const WHEEL: f64 = 0.004;

/// Draws a view; returns the size of its picture in pixels.
pub fn show(editor: &mut Editor, ui: &mut Ui, pane: usize, rect: Rect) -> [u32; 2] {
    let (head, body) = rect.split_top_bottom_at_y(rect.top() + HEAD);
    let mut top =
        ui.new_child(UiBuilder::new().max_rect(head).layout(egui::Layout::left_to_right(Align::Center)));
    header(editor, &mut top, pane);
    let size = [body.width(), body.height()].map(|n| (n * ui.pixels_per_point()).round().max(1.0) as u32);
    match editor.model.workspace.panes[pane].shows {
        Shows::Profile => profile(editor, ui, pane, body),
        Shows::Diagram => drawing(editor, ui, pane, body),
        shows if shows.is_pane() => liquid::show(editor, ui, (pane, shows), body, size),
        shows => scene(editor, ui, (pane, shows), body, size),
    }
    let edge = ui.visuals().widgets.noninteractive.bg_stroke;
    ui.painter().rect_stroke(body, 4.0, edge, StrokeKind::Inside);
    size
}

fn header(editor: &mut Editor, ui: &mut Ui, pane: usize) {
    let shows = editor.model.workspace.panes[pane].shows;
    let title = format!("View {}", pane + 1);
    let taken = ENLARGE + modes::least_width(editor, ui, pane);
    let width = (ui.available_width() - taken).clamp(LEAST_CHOICE, CHOICE);
    let combo = ComboBox::from_id_salt(("shows", pane)).selected_text(shows.name()).width(width);
    let combo = combo.height(420.0).truncate();
    let mut chosen = shows;
    let shown = combo.show_ui(ui, |ui| {
        for other in Shows::ALL {
            ui.selectable_value(&mut chosen, other, other.name()).on_hover_text(other.meaning());
        }
    });
    editor.model.workspace.show(pane, chosen);
    shown
        .response
        .on_hover_text(shows.meaning())
        .widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, format!("{title}: {}", shows.name())));
    if let Some(compared) = editor.model.session.compared.as_ref().filter(|_| shows.is_seen()) {
        let other = editor.model.session.keys.other;
        ui.label(RichText::new(if other { compared.name.as_str() } else { "present" }).weak());
    }
    if editor.model.document.shows_last_possible() && !shows.is_pane() {
        last_possible(editor, ui);
    }
    modes::show(editor, ui, pane, ui.available_width() - ENLARGE);
    ui.with_layout(egui::Layout::right_to_left(Align::Center), |ui| {
        let large = editor.model.workspace.large == Some(pane);
        let name = if large { "All views" } else { "Enlarge" };
        if editor.model.workspace.layout.panes() > 1
            && ui
                .small_button(name)
                .on_hover_text(format!("{title}: alone, or among the others; a double click does the same."))
                .clicked()
        {
            enlarge(editor, pane);
        }
        if shows == Shows::Refraction {
            refraction_view::choices(&mut editor.model.session.flowing[pane], ui);
        }
        let is_linked = editor.model.workspace.panes[pane].own.is_none();
        // A view that is not linked says so among its modes.
        if shows.is_seen() && is_linked && has_room(ui, 80.0) {
            let mut linked = true;
            if ui
                .checkbox(&mut linked, "Linked")
                .on_hover_text("Tilts and zooms together with all other linked views.")
                .changed()
            {
                let eye = editor.model.workspace.eye;
                editor.model.workspace.panes[pane].own = Some(eye);
            }
        }
        if (shows.is_seen() || shows == Shows::TracedPane) && has_room(ui, 64.0) {
            state(editor, ui, pane);
        }
    });
}

/// Whether a row has more than so many points left.
pub fn has_room(ui: &Ui, points: f32) -> bool {
    ui.available_width() > points
}

/// Draws how good the picture is, in a word or two.
fn state(editor: &Editor, ui: &mut Ui, pane: usize) {
    let Some(shown) = editor.shown((pane, Which::Present)) else { return };
    let Shown { grade, taken, shot, .. } = shown;
    let (text, meaning) = match (grade, taken.unresolved) {
        (Grade::Fine, Some(part)) => {
            let percent = 100.0 * part;
            (format!("± {percent:.2} %"), format!("{percent:.3} % of the light is not followed to its end."))
        }
        (Grade::Fine, None) => {
            (String::new(), "How much of the light is not followed to its end is not known.".into())
        }
        _ => ("…".to_owned(), "Becoming finer.".to_owned()),
    };
    if let Some((reading, meaning)) = reading(shot).filter(|_| has_room(ui, 150.0)) {
        ui.label(RichText::new(reading).weak().small()).on_hover_text(meaning);
    }
    ui.label(RichText::new(text).weak().small()).on_hover_text(format!("By {}. {meaning}", taken.tracer));
}

/// Returns what a picture in a scope shows of the light where no mode says so, in two words and in a sentence.
fn reading(shot: &Shot) -> Option<(&'static str, &'static str)> {
    shot.shows.scoped()?;
    (!shot.strongest && shot.glare == Glare::LeftOut).then_some((
        "without glare",
        "All light that has been inside the stone; what the outer surface reflects is left out.",
    ))
}

/// Draws a note that the design makes no stone, and that the view shows the last one that it made.
fn last_possible(editor: &Editor, ui: &mut Ui) {
    let why = editor.model.document.fault().map(ToString::to_string).unwrap_or_default();
    let text = RichText::new("last possible stone").color(theme::bad(ui.visuals())).small();
    ui.label(text).on_hover_text(format!("The design makes no stone, so this is the one before. {why}"));
}

pub fn enlarge(editor: &mut Editor, pane: usize) {
    let large = &mut editor.model.workspace.large;
    *large = if *large == Some(pane) { None } else { Some(pane) };
}

fn profile(editor: &mut Editor, ui: &mut Ui, pane: usize, body: Rect) {
    let specimen = Arc::clone(editor.model.document.specimen());
    let brilliant = match &mut editor.model.document.work.design.cut {
        Cut::RoundBrilliant(brilliant) => Some(brilliant),
        Cut::Tiers(_) | Cut::Planes(_) | Cut::Mesh(_) | Cut::Glass(_) => None,
    };
    ui.painter().rect_filled(body, 4.0, ui.visuals().extreme_bg_color);
    let under = ui.interact(body, ui.scope_id().with("profile"), Sense::click());
    under.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Profile view"));
    match specimen.stone() {
        Ok(stone) => drop(editor.profiles[pane].show(ui, body, stone, brilliant)),
        Err(_) => absent(ui, body, "A profile"),
    }
    view_menu::attach(editor, &under, pane);
    if under.double_clicked() {
        enlarge(editor, pane);
    }
    if under.contains_pointer() {
        editor.model.session.hovered = pane;
    }
}

fn drawing(editor: &mut Editor, ui: &mut Ui, pane: usize, body: Rect) {
    let response = ui.interact(body, ui.scope_id().with("drawing"), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Facet diagram"));
    let [red, green, blue] = editor.paper.inks.paper;
    ui.painter().rect_filled(body, 4.0, Color32::from_rgb(red, green, blue));
    if editor.model.document.specimen().stone().is_err() {
        absent(ui, body, "A diagram");
    } else if let Some(shown) = editor.gallery.traced.get(&(pane, Which::Present)) {
        let [w, h] = shown.taken.image.size.map(|n| n as f32);
        let scale = (body.width() / w).min(body.height() / h);
        let rect = Rect::from_center_size(body.center(), vec2(w, h) * scale);
        image(ui, shown, rect);
    }
    view_menu::attach(editor, &response, pane);
    if response.double_clicked() {
        enlarge(editor, pane);
    }
    if response.hovered() {
        editor.model.session.hovered = pane;
    }
}

/// Draws a text in the place of a drawing that only convex stones have.
fn absent(ui: &Ui, body: Rect, what: &str) {
    ui.painter().rect_filled(body, 4.0, ui.visuals().extreme_bg_color);
    let text = format!("{what} is drawn of convex stones between planes only.");
    let colour = ui.visuals().weak_text_color();
    ui.painter().text(
        body.center(),
        egui::Align2::CENTER_CENTER,
        text,
        egui::FontId::proportional(14.0),
        colour,
    );
}

fn image(ui: &Ui, shown: &Shown, rect: Rect) {
    let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    ui.painter().image(shown.texture.id(), rect, uv, Color32::WHITE);
}

/// How a pane looks at the stone now, and where its picture lies in the window.
pub(crate) struct PaneView {
    pub view: View,
    pub film: Film,
    /// The middle of what the view is fitted to, girdle radii from the origin.
    middle: DVec2,
    side: Side,
    pub body: Rect,
    scale: f32,
}

impl PaneView {
    /// Returns the point of the film, in its pixels, under a point of the window.
    pub fn pixel(&self, at: egui::Pos2) -> DVec2 {
        let at = (at - self.body.min) * self.scale;
        DVec2::new(f64::from(at.x), f64::from(at.y))
    }

    /// Returns the point of the window over a point of the film.
    pub fn point(&self, pixel: DVec2) -> egui::Pos2 {
        self.body.min + vec2(pixel.x as f32, pixel.y as f32) / self.scale
    }

    /// Returns where a picture that was taken on another film lies in the window.
    fn place(&self, other: &Film) -> Rect {
        let map = self.film.pixels_from_image(DMat2::IDENTITY);
        let corner = |x, y| self.point(map.transform_point2(other.image_from_pixels(DVec2::new(x, y))));
        let [w, h] = other.size.map(f64::from);
        Rect::from_two_pos(corner(0.0, 0.0), corner(w, h))
    }
}

fn scene(editor: &mut Editor, ui: &mut Ui, (pane, shows): (usize, Shows), body: Rect, size: [u32; 2]) {
    let response = ui.interact(body, ui.scope_id().with("picture"), Sense::click_and_drag());
    let name = format!("{} picture", shows.name());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &name));
    let eye = *editor.model.workspace.eye(pane);
    let view = editor.model.workspace.view(pane);
    let scale = ui.pixels_per_point();
    let fit = editor.model.fit(shows, eye.turn, &view);
    let sight =
        PaneView { view, film: eye.film(size, &fit), middle: fit.middle, side: view.side, body, scale };
    pictures(editor, ui, pane, &sight);
    let moves = shows == Shows::Refraction && refraction_view::is_held(ui);
    if shows == Shows::Refraction {
        refraction_view::show(editor, ui, pane, &response);
    }
    if let Some(overlay) = editor.model.workspace.overlay().filter(|_| shows.takes_overlay()) {
        legend(ui, body, &overlay.legend());
    }
    ui.painter().rect_stroke(body, 4.0, focus(ui, &response), StrokeKind::Inside);
    if response.has_focus() {
        editor.is_picture_focused = true;
    }
    if !copies::carried(editor, ui, pane, &response, &sight) {
        moved(editor.model.workspace.eye_mut(pane), ui, &response, (&sight, moves));
    }
    view_menu::attach(editor, &response, pane);
    let is_alone = !shows.has_company() || editor.model.is_alone();
    clicked(editor, ui, (pane, is_alone), &response, &sight);
    if response.hovered() || response.has_focus() {
        editor.model.session.hovered = pane;
    }
    if is_alone {
        hover(editor, ui, (shows, eye.turn), &response, &sight);
    } else {
        copies::hover(editor, ui, pane, &response, &sight);
    }
}

/// Follows the ray that is clicked, shows the view alone after a double click, and marks the ray that is followed.
fn clicked(
    editor: &mut Editor,
    ui: &Ui,
    (pane, is_alone): (usize, bool),
    response: &Response,
    sight: &PaneView,
) {
    if response.double_clicked() {
        editor.following.unclick();
        enlarge(editor, pane);
    } else if response.clicked() && is_alone {
        // A click by a key means the middle of the view.
        let at = response.interact_pointer_pos().unwrap_or(sight.body.center());
        let at = sight.film.image_from_pixels(sight.pixel(at));
        let specimen = editor.stones.posed(&editor.model, editor.model.workspace.eye(pane).turn);
        if editor.probe.of(&specimen).is_on(&sight.view, at) {
            editor.following.click(pane, at, sight.body, ui.ctx());
        }
    }
    let followed = editor
        .model
        .session
        .followed
        .at
        .filter(|(other, _)| editor.model.session.followed.is_open && *other == pane);
    if let Some((_, at)) = followed {
        let at = sight.point(sight.film.pixels_from_image(DMat2::IDENTITY).transform_point2(at));
        let painter = ui.painter().with_clip_rect(sight.body);
        painter.circle_stroke(at, 5.0, Stroke::new(3.0, Color32::from_black_alpha(160)));
        painter.circle_stroke(at, 5.0, Stroke::new(1.5, Color32::WHITE));
    }
}

pub fn focus(ui: &Ui, response: &Response) -> Stroke {
    if response.has_focus() { ui.visuals().selection.stroke } else { Stroke::NONE }
}

/// Draws the picture of the present design, that of the design compared with, or both.
fn pictures(editor: &Editor, ui: &mut Ui, pane: usize, sight: &PaneView) {
    let body = sight.body;
    ui.painter().rect_filled(body, 4.0, ui.visuals().extreme_bg_color);
    let draw = |which, clip: Rect| {
        if let Some(shown) = editor.shown((pane, which)) {
            let ui_clip = ui.painter().with_clip_rect(clip.intersect(ui.clip_rect()));
            let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            ui_clip.image(shown.texture.id(), sight.place(&shown.shot.film), uv, Color32::WHITE);
        }
    };
    match &editor.model.session.compared {
        Some(_) if editor.model.session.keys.other => draw(Which::Other, body),
        Some(compared) if editor.model.workspace.is_split => {
            let (left, right) = body.split_left_right_at_fraction(0.5);
            draw(Which::Present, left);
            draw(Which::Other, right);
            split_marks(ui, body, &compared.name);
        }
        _ => draw(Which::Present, body),
    }
}

/// Draws what the colours of an overlay mean along the lower edge, as many entries as there is room for.
fn legend(ui: &Ui, body: Rect, entries: &[(String, [u8; 3])]) {
    let painter = ui.painter().with_clip_rect(body);
    let font = egui::TextStyle::Small.resolve(ui.style());
    let mut at = body.left_bottom() + vec2(8.0, -22.0);
    for (text, [r, g, b]) in entries {
        let galley = painter.layout_no_wrap(text.clone(), font.clone(), Color32::WHITE);
        let size = galley.size() + vec2(22.0, 4.0);
        if at.x + size.x > body.right() - 6.0 {
            break;
        }
        painter.rect_filled(Rect::from_min_size(at, size), 3.0, Color32::from_black_alpha(170));
        let chip = Rect::from_min_size(at + vec2(4.0, size.y / 2.0 - 5.0), vec2(10.0, 10.0));
        painter.rect_filled(chip, 2.0, Color32::from_rgb(*r, *g, *b));
        painter.galley(at + vec2(18.0, 2.0), galley, Color32::WHITE);
        at.x += size.x + 4.0;
    }
}

fn split_marks(ui: &Ui, body: Rect, other: &str) {
    let painter = ui.painter();
    painter.vline(body.center().x, body.y_range(), Stroke::new(1.5, ui.visuals().text_color()));
    let font = egui::TextStyle::Small.resolve(ui.style());
    for (text, at, align) in [
        ("present", body.left_top() + vec2(8.0, 6.0), egui::Align2::LEFT_TOP),
        (other, body.right_top() + vec2(-8.0, 6.0), egui::Align2::RIGHT_TOP),
    ] {
        let galley = painter.layout_no_wrap(text.to_owned(), font.clone(), Color32::WHITE);
        let rect = align.anchor_size(at, galley.size());
        painter.rect_filled(rect.expand(3.0), 3.0, Color32::from_black_alpha(150));
        painter.galley(rect.min, galley, Color32::WHITE);
    }
}

/// Moves the eye by pointer, wheel and keys; `is_held` says that a drag moves the background instead.
fn moved(eye: &mut Eye, ui: &Ui, response: &Response, (sight, is_held): (&PaneView, bool)) {
    let unit = sight.film.pixel * f64::from(sight.scale);
    let by = response.drag_delta();
    let by = DVec2::new(f64::from(by.x), -f64::from(by.y)) * unit;
    let spins = response.dragged_by(PointerButton::Secondary) || ui.input(|i| i.modifiers.shift);
    if response.dragged_by(PointerButton::Middle) {
        eye.centre -= by;
    } else if spins && response.dragged() {
        eye.spin(sight.side, by.x);
    } else if response.dragged_by(PointerButton::Primary) && !is_held {
        eye.drag(sight.side, by);
    }
    if let Some(at) = response.hover_pos().filter(|_| response.hovered()) {
        let (wheel, pinch) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
        let factor = (f64::from(wheel) * WHEEL).exp() * f64::from(pinch);
        if factor != 1.0 {
            eye.zoom_at(factor, sight.film.image_from_pixels(sight.pixel(at)) - sight.middle);
        }
    }
    if response.has_focus() {
        by_keys(eye, ui, sight.side, response.id);
    }
}

fn by_keys(eye: &mut Eye, ui: &Ui, side: Side, id: egui::Id) {
    let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|m| m.set_focus_lock_filter(id, arrows));
    let pressed = |modifiers, key| ui.input_mut(|i| i.count_and_consume_key(modifiers, key)) as f64;
    let along = |more, less| pressed(Modifiers::ALT, more) - pressed(Modifiers::ALT, less);
    let aside = DVec2::new(along(Key::ArrowRight, Key::ArrowLeft), along(Key::ArrowUp, Key::ArrowDown));
    eye.centre += aside * (ASIDE / eye.zoom);
    for (modifiers, step) in [(Modifiers::SHIFT, STEP.1), (Modifiers::NONE, STEP.0)] {
        let along = |more, less| pressed(modifiers, more) - pressed(modifiers, less);
        let by = DVec2::new(along(Key::ArrowRight, Key::ArrowLeft), along(Key::ArrowUp, Key::ArrowDown));
        eye.drag(side, by * step);
    }
    let turn = pressed(Modifiers::NONE, Key::Period) - pressed(Modifiers::NONE, Key::Comma);
    eye.spin(side, turn * STEP.1);
    let zoom = pressed(Modifiers::NONE, Key::Plus) + pressed(Modifiers::NONE, Key::Equals)
        - pressed(Modifiers::NONE, Key::Minus);
    eye.zoom_at(1.2_f64.powf(zoom), eye.centre);
}

/// Returns the scope whose zones are named in a view.
pub fn zones(shows: Shows, head: f64) -> Scope {
    let aset = || Scope::aset(ASET_CONE, Backing::Black).with_head(head);
    shows.scoped().map_or_else(aset, |s| if s.takes_head { s.scope.with_head(head) } else { s.scope })
}

/// Names what is under the pointer in the status line, and outlines its facet.
fn hover(editor: &mut Editor, ui: &Ui, (shows, turn): (Shows, f64), response: &Response, sight: &PaneView) {
    if !response.hovered() || response.dragged() {
        return;
    }
    let Some(at) = response.hover_pos() else { return };
    let specimen = editor.stones.posed(&editor.model, turn);
    let scope = zones(shows, editor.model.document.work.head);
    let mut found = editor.probe.of(&specimen).at(&sight.view, &sight.film, sight.pixel(at), &scope);
    if let Some(azimuth) = found.as_mut().and_then(|f| f.azimuth.as_mut()) {
        // The azimuth is that of the cut, whatever the stone's turn in this view.
        *azimuth = (*azimuth - turn.to_degrees()).rem_euclid(360.0);
    }
    editor.model.session.message = found.as_ref().map_or(String::new(), ProbeHit::message);
    if let Some(found) = &found {
        outline(ui, &specimen, found.facet, sight);
    }
}

fn outline(ui: &Ui, specimen: &Specimen, facet: u32, sight: &PaneView) {
    rim(ui, (specimen.solid(), facet), |corner| corner, sight);
}

/// Outlines a facet of a solid that lies where `place` puts its points.
pub(crate) fn rim(
    ui: &Ui,
    (solid, facet): (SolidRef, u32),
    place: impl Fn(DVec3) -> DVec3,
    sight: &PaneView,
) {
    let camera = Camera::reaching(&sight.view, 1.0);
    let map = sight.film.pixels_from_image(DMat2::IDENTITY);
    let painter = ui.painter().with_clip_rect(sight.body);
    let at = |corner| Some(sight.point(map.transform_point2(camera.project(place(corner))?.0)));
    let rim = solid.rim(facet);
    for stroke in
        [Stroke::new(3.0, Color32::from_black_alpha(120)), Stroke::new(1.2, Color32::from_white_alpha(220))]
    {
        for [from, to] in &rim {
            if let (Some(from), Some(to)) = (at(*from), at(*to)) {
                painter.line_segment([from, to], stroke);
            }
        }
    }
}
