//! Colours and spacing of the window, light and dark.

use crate::glyphs;
use brillianteer_picture::Inks;
use brillianteer_session::studio::Paper;
use egui::{Color32, Context, CornerRadius, FontId, Stroke, Style, TextStyle, Theme, Visuals, vec2};

/// The colour of a finding of the audit: bright on any picture, and different from that of a selected tier.
pub const FOUND: Color32 = Color32::from_rgb(255, 176, 40);

/// Returns the colour that marks a chosen or active item.
pub fn accent(visuals: &Visuals) -> Color32 {
    if visuals.dark_mode { Color32::from_rgb(96, 165, 230) } else { Color32::from_rgb(26, 102, 184) }
}

/// Returns the colour of a range that is good.
pub fn good(visuals: &Visuals) -> Color32 {
    if visuals.dark_mode { Color32::from_rgb(92, 176, 116) } else { Color32::from_rgb(38, 132, 66) }
}

/// Returns the colour of warnings.
pub fn caution(visuals: &Visuals) -> Color32 {
    if visuals.dark_mode { Color32::from_rgb(226, 178, 84) } else { Color32::from_rgb(140, 92, 0) }
}

/// Returns the colour of errors, and of nothing else.
pub fn bad(visuals: &Visuals) -> Color32 {
    if visuals.dark_mode { Color32::from_rgb(240, 128, 112) } else { Color32::from_rgb(176, 42, 30) }
}

/// Returns the colour of a zone of the ASET, as bars show it.
pub fn zone(name: &str, visuals: &Visuals) -> Color32 {
    match name {
        "red" => Color32::from_rgb(214, 62, 52),
        "green" => Color32::from_rgb(64, 164, 72),
        "blue" => Color32::from_rgb(60, 108, 214),
        _ => visuals.weak_text_color(),
    }
}

/// Returns the colours and scale of drawings: on light or dark paper, to match the window.
pub fn paper(ctx: &Context) -> Paper {
    let is_dark = ctx.global_style().visuals.dark_mode;
    let inks = if is_dark { Inks::DARK } else { Inks::PAPER };
    Paper { inks, pixels_per_point: Some(ctx.pixels_per_point()) }
}

/// Sets up both themes.
pub fn apply(ctx: &Context) {
    for theme in [Theme::Dark, Theme::Light] {
        ctx.style_mut_of(theme, |style| styled(style, theme));
    }
    ctx.add_glyph_rasterizer(glyphs::signs());
    ctx.add_font_provider(glyphs::fonts_of_system());
    // Typing in a field ends with a press elsewhere, be it a drag or a click.
    ctx.options_mut(|o| o.input_options.surrender_focus_on = egui::SurrenderFocusOn::Presses);
}

fn styled(style: &mut Style, theme: Theme) {
    style.spacing.item_spacing = vec2(8.0, 6.0);
    style.spacing.button_padding = vec2(8.0, 3.0);
    style.spacing.interact_size.y = 22.0;
    style.spacing.slider_rail_height = 4.0;
    for (kind, size) in [
        (TextStyle::Body, 13.5),
        (TextStyle::Button, 13.5),
        (TextStyle::Small, 11.5),
        (TextStyle::Heading, 16.0),
    ] {
        style.text_styles.insert(kind, FontId::proportional(size));
    }
    let visuals = &mut style.visuals;
    let grey = Color32::from_gray;
    if theme == Theme::Dark {
        visuals.panel_fill = Color32::from_rgb(27, 28, 31);
        visuals.window_fill = Color32::from_rgb(33, 34, 38);
        visuals.extreme_bg_color = Color32::from_rgb(18, 19, 21);
        visuals.override_text_color = Some(grey(222));
        visuals.weak_text_color = Some(grey(158));
    } else {
        visuals.panel_fill = Color32::from_rgb(245, 245, 247);
        visuals.window_fill = Color32::from_rgb(252, 252, 253);
        visuals.override_text_color = Some(grey(28));
        visuals.weak_text_color = Some(grey(92));
    }
    visuals.selection.bg_fill = accent(visuals).gamma_multiply(0.45);
    visuals.selection.stroke = Stroke::new(1.0, if visuals.dark_mode { grey(245) } else { grey(10) });
    for widget in [
        &mut visuals.widgets.inactive,
        &mut visuals.widgets.hovered,
        &mut visuals.widgets.active,
        &mut visuals.widgets.open,
    ] {
        widget.corner_radius = CornerRadius::same(5);
    }
}
