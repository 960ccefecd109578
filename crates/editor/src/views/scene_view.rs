//! The view of a stone under light: its pictures, and its input by pointer and keys.

use super::pane_context::{PaneContext, focus};
use super::pane_view::PaneView;
use super::view_menu::attend;
use super::{copies, eye_hand, refraction_view, tier_hand, tier_picking};
use crate::theme::FOUND;
use brillianteer_cut::Cut;
use brillianteer_picture::{Scoped, contrast_legend};
use brillianteer_scene::Scope;
use brillianteer_session::model::{action::ViewAction, audit::finding_facets};
use brillianteer_session::shows::Shows;
use brillianteer_session::studio::Which;
use egui::{
    Align2, Color32, FontId, Rect, Response, Role, Sense, Stroke, StrokeKind, TextStyle, Ui, WidgetInfo, vec2,
};

/// Draws the view; `size` is that of its picture in pixels.
pub fn show(cx: &mut PaneContext, ui: &Ui, body: Rect, size: [u32; 2]) {
    let (model, shows) = (cx.model, cx.shows);
    let response = ui.interact(body, ui.scope_id().with("picture"), Sense::click_and_drag());
    let name = format!("{} picture", shows.name());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &name));
    let (eye, view) = (cx.eye(), model.view(cx.pane));
    let fit = model.fit(shows, &view);
    let (film, scale) = (eye.film(size, &fit), ui.pixels_per_point());
    let sight = PaneView { view, film, middle: fit.middle, body, scale };
    pictures(cx, ui, &sight);
    let moves_background = shows == Shows::Refraction && refraction_view::is_held(ui);
    if shows == Shows::Refraction {
        refraction_view::moved(cx, ui, &response);
    }
    if let Some(overlay) = model.workspace.overlay().filter(|_| shows.takes_overlay()) {
        legend(ui, body, &overlay.legend());
    } else if shows == Shows::Contrast {
        legend(ui, body, &contrast_legend());
    }
    ui.painter().rect_stroke(body, 4.0, focus(ui, &response), StrokeKind::Inside);
    cx.tools.attention.is_picture_focused |= response.has_focus();
    let is_alone = !shows.has_copies() || model.is_alone();
    let holds_tier = is_alone && tier_hand::held(cx, ui, &response, &sight);
    if !holds_tier && !copies::carried(cx, ui, &response, &sight) {
        let moved = eye_hand::moved(eye, ui, &response, &sight, moves_background);
        cx.actions.push_changed(&eye, moved, |eye| ViewAction::Eye(cx.pane, eye));
    }
    attend(cx, &response, response.hovered() || response.has_focus());
    if is_alone {
        selected(cx, ui, &sight);
        found(cx, ui, &sight);
    }
    if is_alone && tier_picking::picked(cx, ui, &response, &sight) {
        return;
    }
    clicked(cx, ui, is_alone, &response, &sight);
    if is_alone {
        select(cx, &response, &sight);
    }
    if is_alone { hover(cx, ui, &response, &sight) } else { copies::hover(cx, ui, &response, &sight) }
}

/// Follows the clicked ray, unless the click becomes a double click, and marks the followed ray.
fn clicked(cx: &mut PaneContext, ui: &Ui, is_alone: bool, response: &Response, sight: &PaneView) {
    if response.double_clicked() {
        cx.tools.following.unclick();
    } else if response.clicked() && is_alone {
        // A click by a key takes the middle of the view.
        let at = sight.image(response.interact_pointer_pos().unwrap_or(sight.body.center()));
        let specimen = cx.model.document.specimen();
        // A click on a facet selects its row where the table of tiers is open, unless a ray is followed already.
        let is_for_table = cx.model.shows_tiers() && !cx.model.session.followed.is_open;
        if !is_for_table && cx.tools.probe.of(specimen).is_on(&sight.view, at) {
            cx.tools.following.click(cx.pane, at, sight.body, ui.ctx());
        }
    }
    let followed = cx.model.session.followed;
    if let Some((_, at)) = followed.at.filter(|(pane, _)| followed.is_open && *pane == cx.pane) {
        sight.mark(ui, at);
    }
}

/// Outlines the facets of the tier that is selected in the table of tiers.
fn selected(cx: &PaneContext, ui: &Ui, sight: &PaneView) {
    let model = cx.model;
    let Cut::Tiers(tiers) = &model.document.work.design.cut else { return };
    let specimen = model.document.specimen();
    let Ok(stone) = specimen.stone() else { return };
    if !model.shows_tiers() {
        return;
    }
    let tier_of = |facet: usize| tiers.tier_of_plane(stone.polytope.facets()[facet].source);
    for facet in (0..stone.polytope.facets().len()).filter(|facet| tier_of(*facet).is_some()) {
        if tier_of(facet) == model.session.tier {
            sight.outline(ui, specimen.solid(), facet as u32, |corner| corner);
        }
    }
}

/// Selects the tier whose facet is clicked, where the table of tiers is open.
fn select(cx: &mut PaneContext, response: &Response, sight: &PaneView) {
    let model = cx.model;
    let Cut::Tiers(tiers) = &model.document.work.design.cut else { return };
    let specimen = model.document.specimen();
    let at = response
        .interact_pointer_pos()
        .filter(|_| response.clicked() && model.shows_tiers() && !model.document.shows_last_possible());
    let Some((at, Ok(stone))) = at.map(|at| (at, specimen.stone())) else { return };
    let hit = cx.tools.probe.of(specimen).meet(&sight.view, sight.image(at));
    let tier_of = |facet: usize| tiers.tier_of_plane(stone.polytope.facets()[facet].source);
    if let Some(place) = hit.and_then(|(facet, _)| tier_of(facet)) {
        cx.actions.push(ViewAction::Tier(Some(place)));
    }
}

/// Outlines the facets of the finding that is selected in the audit's list, and marks its corners.
fn found(cx: &PaneContext, ui: &Ui, sight: &PaneView) {
    let audit = &cx.model.session.audit;
    let specimen = cx.model.document.specimen();
    let Some(finding) = audit.selected_finding().filter(|_| cx.model.shows_audit()) else { return };
    let Ok(stone) = specimen.stone() else { return };
    for facet in finding_facets(stone, finding) {
        sight.outline_in(ui, (specimen.solid(), facet as u32), FOUND, |corner| corner);
    }
    if finding.kind.is_about_corners() {
        finding.points.iter().for_each(|corner| sight.mark_corner(ui, *corner, FOUND));
    }
}

/// Draws the picture of the present design, that of the design compared with, or both.
fn pictures(cx: &PaneContext, ui: &Ui, sight: &PaneView) {
    let body = sight.body;
    ui.painter().rect_filled(body, 4.0, ui.visuals().extreme_bg_color);
    let draw = |which, clip: Rect| {
        if let Some(shown) = cx.shown(which) {
            let painter = ui.painter().with_clip_rect(clip.intersect(ui.clip_rect()));
            shown.paint(&painter, sight.place(&shown.shot.film));
        }
    };
    match &cx.model.session.compared {
        Some(_) if cx.model.session.keys.other => draw(Which::Other, body),
        Some(compared) if cx.model.workspace.is_split => {
            let (left, right) = body.split_left_right_at_fraction(0.5);
            draw(Which::Present, left);
            draw(Which::Other, right);
            split_marks(ui, body, &compared.name);
        }
        _ => draw(Which::Present, body),
    }
}

fn small(ui: &Ui) -> FontId {
    TextStyle::Small.resolve(ui.style())
}

/// Draws the meanings of an overlay's colours along the lower edge, as many entries as there is room for.
fn legend(ui: &Ui, body: Rect, entries: &[(String, [u8; 3])]) {
    let painter = ui.painter().with_clip_rect(body);
    let mut at = body.left_bottom() + vec2(8.0, -22.0);
    for (text, [r, g, b]) in entries {
        let galley = painter.layout_no_wrap(text.clone(), small(ui), Color32::WHITE);
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

/// Draws the line between two designs side by side, and names both.
fn split_marks(ui: &Ui, body: Rect, other: &str) {
    let painter = ui.painter();
    painter.vline(body.center().x, body.y_range(), Stroke::new(1.5, ui.visuals().text_color()));
    for (text, at, align) in [
        ("present", body.left_top() + vec2(8.0, 6.0), Align2::LEFT_TOP),
        (other, body.right_top() + vec2(-8.0, 6.0), Align2::RIGHT_TOP),
    ] {
        let galley = painter.layout_no_wrap(text.to_owned(), small(ui), Color32::WHITE);
        let rect = align.anchor_size(at, galley.size());
        painter.rect_filled(rect.expand(3.0), 3.0, Color32::from_black_alpha(150));
        painter.galley(rect.min, galley, Color32::WHITE);
    }
}

/// Returns the scope whose zones a view names.
pub fn zones(shows: Shows, head: f64) -> Scope {
    shows.scoped().unwrap_or_else(Scoped::aset).with_head(head)
}

/// Names the facet and light under the pointer in the status line, and outlines the facet.
fn hover(cx: &mut PaneContext, ui: &Ui, response: &Response, sight: &PaneView) {
    let Some(at) = response.hover_pos().filter(|_| response.hovered() && !response.dragged()) else { return };
    let specimen = cx.model.document.specimen();
    let scope = zones(cx.shows, cx.model.document.work.settings.look.head_of_scopes());
    let found = cx.tools.probe.of(specimen).at(&sight.view, &sight.film, sight.pixel(at), &scope);
    let Some(found) = found else { return };
    sight.outline_face(ui, &specimen.body, found.facet, |corner| corner);
    cx.tools.attention.message = found.message();
    tier_hand::hint(cx, ui, sight, at);
}
