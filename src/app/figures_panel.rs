//! The panel of figures: where the light comes from, by exact beams or by rays, and how that changes when the stone is tilted.

use super::editor::{Editor, Measured};
use super::studio::{Grade, Tilts, Which};
use super::{pane_rows, theme};
use crate::measure::Figures;
use crate::scene::{ASET_CONE, Backing, Scope};
use egui::{Align, Color32, Layout, Panel, Rect, RichText, ScrollArea, Sense, Ui, pos2, vec2};
use egui_plot::{GridInput, GridMark, HoverPosition, Line, Plot, PlotPoint, PlotPoints};

/// A zone as a row shows it: what it is called here, its band in the scope, and what it means.
const ZONES: [(&str, &str, &str); 5] = [
    ("Red", "red", "Light from 45° to 75° above the horizon: the brightest that rooms have."),
    ("Green", "green", "Light from the horizon to 45°: walls and windows."),
    ("Blue", "blue", "Light from straight above, which an observer's head blocks: it makes the contrast."),
    ("Head", "head", "Light that the observer's head shuts out."),
    ("Leakage", "below", "Light from behind the stone: what the pavilion lets out. A dark spot or a window."),
];

/// Draws the panel.
pub fn show(editor: &mut Editor, ui: &mut Ui) {
    Panel::right("figures").resizable(true).default_size(280.0).size_range(250.0..=420.0).show(ui, |ui| {
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            pane_rows::show(editor, ui);
            ui.add_space(8.0);
            ui.label(RichText::new("Figures").heading()).on_hover_text(
                "What becomes of the light of the linked view in the common ASET, in percent of the stone's outline, at \
                 sodium's 589.3 nm. Each may be too low by what is unresolved; by rays, as of meshes and glass, there is the \
                 error of sampling as well.",
            );
            how(editor, ui);
            if let Some(measured) = editor.figures.get(&Which::Present) {
                let other = editor.compared.as_ref().and_then(|_| editor.figures.get(&Which::Other));
                let is_asked = editor.asked.figures.iter().any(|(_, ask)| *ask == measured.ask);
                table(ui, measured, other, editor.desk.by_area);
                let state = if is_asked && measured.grade == Grade::Fine { "final" } else { "becoming finer…" };
                let sampled = measured.figures.standard_error;
                let error = format!("{state}; by rays, standard error {:.2} %", 100.0 * sampled);
                let state = if sampled > 0.0 { error.as_str() } else { state };
                ui.label(RichText::new(state).weak().small());
            }
            ui.add_space(8.0);
            ui.label(RichText::new("Against tilt").heading()).on_hover_text(
                "The same figures while the stone leans toward the azimuth of the linked views, -30° to 30°.",
            );
            if let Some((ask, tilts)) = &editor.tilts {
                ui.label(RichText::new("in the colours of the zones above").weak().small());
                ui.add_enabled_ui(editor.asked.tilts.as_ref() == Some(ask), |ui| plot(ui, ask.head, tilts));
            } else {
                ui.label(RichText::new("comes when all else is done").weak());
            }
        });
    });
}

fn how(editor: &mut Editor, ui: &mut Ui) {
    ui.horizontal(|ui| {
        ui.selectable_value(&mut editor.desk.by_area, false, "Energy")
            .on_hover_text("How much of the light comes from each zone, all exits of each point together.");
        ui.selectable_value(&mut editor.desk.by_area, true, "Area").on_hover_text(
            "The part of the stone whose strongest light comes from each zone, as most ASET scores count.",
        );
    });
    let tilt = editor.desk.eye.tilt().to_degrees();
    let azimuth = (editor.desk.eye.view(None).azimuth - editor.desk.eye.turn).to_degrees().rem_euclid(360.0);
    let what = if editor.desk.eye.eye_leans { "eye" } else { "stone" };
    let view = if tilt == 0.0 {
        "face up".to_owned()
    } else {
        format!("{what} tilted {tilt:.1}° toward {azimuth:.0}°")
    };
    ui.label(RichText::new(format!("Table side, {view}")).weak());
}

/// One number, and where it is shown.
struct Row<'a> {
    name: &'a str,
    meaning: &'a str,
    share: f64,
    other: Option<f64>,
    colour: Color32,
    is_strong: bool,
}

fn table(ui: &mut Ui, measured: &Measured, other: Option<&Measured>, by_area: bool) {
    let zones = |m: &Measured| Zones::of(&m.figures, m.ask.head, by_area);
    let (present, other) = (zones(measured), other.map(zones));
    let pick = |f: &dyn Fn(&Zones) -> f64| (f(&present), other.as_ref().map(f));
    for (name, band, meaning) in ZONES {
        if band == "head" && measured.ask.head == 0.0 {
            continue;
        }
        let (share, other) = pick(&|z| z.band(band));
        let colour = theme::zone(band, ui.visuals());
        row(ui, &Row { name, meaning, share, other, colour, is_strong: false });
    }
    ui.add_space(4.0);
    let weak = ui.visuals().weak_text_color();
    let text = ui.visuals().text_color();
    let rows: [(&str, &str, Pick, bool); 4] = [
        (
            "Light return",
            "Light from above the horizon, glare included: what makes the stone bright.",
            &Zones::returned,
            true,
        ),
        ("Glare", "Light that the outer surface reflects without having been inside.", &|z| z.glare, false),
        ("Absorbed", "Light that the stone's colour takes away.", &|z| z.absorbed, false),
        (
            "Unresolved",
            "Light that was not followed to its end: by it, figures may be too low.",
            &|z| z.unresolved,
            false,
        ),
    ];
    if by_area {
        let meaning = "Where a stronger exit may hide in what is unresolved, or nothing leaves the stone.";
        let (share, other) = pick(&|z| z.unresolved);
        row(ui, &Row { name: "Undecided", meaning, share, other, colour: weak, is_strong: false });
        return;
    }
    for (name, meaning, of, is_strong) in rows {
        let (share, other) = pick(of);
        row(ui, &Row { name, meaning, share, other, colour: if is_strong { text } else { weak }, is_strong });
    }
}

/// Takes a number from what the panel shows.
type Pick<'a> = &'a dyn Fn(&Zones) -> f64;

/// What the panel shows, as shares of the outline.
struct Zones {
    bands: Vec<(String, f64)>,
    glare: f64,
    absorbed: f64,
    unresolved: f64,
    /// From above the horizon, but for what the head shuts out.
    lit: f64,
}

impl Zones {
    fn of(figures: &Figures, head: f64, by_area: bool) -> Self {
        let scope = Scope::aset(ASET_CONE, Backing::Black).with_head(head);
        let energy = |k: usize| figures.surface[k] + figures.transmitted[k];
        let share = |k: usize| if by_area { figures.strongest_exit_area[k] } else { energy(k) };
        let bands = scope.bands.iter().enumerate().map(|(k, b)| (b.name.clone(), share(k))).collect();
        let lit = (1..scope.bands.len()).filter(|&k| scope.bands[k].name != "head").map(energy).sum();
        let unresolved = if by_area { figures.strongest_exit_undecided } else { figures.unresolved };
        Self { bands, glare: figures.surface.iter().sum(), absorbed: figures.absorbed, unresolved, lit }
    }

    fn band(&self, name: &str) -> f64 {
        self.bands.iter().find(|(n, _)| n == name).map_or(0.0, |(_, share)| *share)
    }

    fn returned(&self) -> f64 {
        self.lit
    }
}

fn row(ui: &mut Ui, row: &Row) {
    let percent = 100.0 * row.share;
    let (width, height) = (ui.available_width(), 20.0);
    let (rect, response) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
    let told = format!("{} {percent:.2} %", row.name);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &told));
    response.on_hover_text(row.meaning);
    let bar = Rect::from_min_max(
        pos2(rect.left() + 86.0, rect.top() + 5.0),
        pos2(rect.right() - 66.0, rect.bottom() - 5.0),
    );
    ui.painter().rect_filled(bar, 2.0, ui.visuals().extreme_bg_color);
    let end = bar.left() + bar.width() * row.share.clamp(0.0, 1.0) as f32;
    ui.painter().rect_filled(Rect::from_min_max(bar.min, pos2(end, bar.bottom())), 2.0, row.colour);
    if let Some(other) = row.other {
        let x = bar.left() + bar.width() * other.clamp(0.0, 1.0) as f32;
        ui.painter().vline(x, bar.y_range().expand(3.0), egui::Stroke::new(2.0, ui.visuals().text_color()));
    }
    let text = |ui: &mut Ui, text: String| {
        let text = RichText::new(text);
        ui.label(if row.is_strong { text.strong() } else { text })
    };
    let mut left =
        ui.new_child(egui::UiBuilder::new().max_rect(rect).layout(Layout::left_to_right(Align::Center)));
    text(&mut left, row.name.to_owned());
    let mut right =
        ui.new_child(egui::UiBuilder::new().max_rect(rect).layout(Layout::right_to_left(Align::Center)));
    let number = match row.other {
        None => format!("{percent:.2} %"),
        Some(other) => format!("{percent:.1} ({:+.1})", percent - 100.0 * other),
    };
    text(&mut right, number);
}

/// Marks at the multiples of ten in sight.
fn tens(input: GridInput) -> Vec<GridMark> {
    let (first, last) = (input.bounds.0 / 10.0, input.bounds.1 / 10.0);
    let tens = (first.ceil() as i32)..=(last.floor() as i32);
    // Only marks that are far apart have room for a number on the narrow axis.
    let far = |k: i32| if k % 3 == 0 { 30.0 } else { 10.0 };
    tens.map(|k| GridMark { value: 10.0 * f64::from(k), step_size: far(k) }).collect()
}

/// The zones' light against tilt, in the colours of the bars above.
fn plot(ui: &mut Ui, head: f64, tilts: &Tilts) {
    let scope = Scope::aset(ASET_CONE, Backing::Black).with_head(head);
    let plot = Plot::new("tilts")
        .height(200.0)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .show_x(false)
        .show_y(false);
    let plot = plot.include_y(0.0).include_y(60.0).x_grid_spacer(tens).y_grid_spacer(tens);
    let plot = plot
        .x_axis_formatter(|mark, _| format!("{}°", mark.value))
        .y_axis_formatter(|mark, _| format!("{} %", mark.value));
    let now = |name: &str, point: &PlotPoint| format!("{name}: {:.1} % at {:.0}°", point.y, point.x);
    let plot = plot.label_formatter(move |nearest| match nearest {
        HoverPosition::NearDataPoint { plot_name, position, .. } => Some(now(plot_name, position)),
        HoverPosition::Elsewhere { .. } => None,
    });
    plot.show(ui, |plot| {
        for (name, band, _) in ZONES.into_iter().filter(|(_, band, _)| *band != "head") {
            let Some(k) = scope.bands.iter().position(|b| b.name == band) else { continue };
            let points = tilts.iter().map(|(tilt, f)| [*tilt, 100.0 * energy(f, k)]);
            let colour = theme::zone(band, &plot.ctx().global_style().visuals);
            plot.line(Line::new(name, PlotPoints::from_iter(points)).color(colour).width(1.8));
        }
    });
}

/// The light of a band, whether or not the head is among the scope's bands.
fn energy(figures: &Figures, band: usize) -> f64 {
    let of = |zones: &[f64]| zones.get(band).copied().unwrap_or(0.0);
    of(&figures.surface) + of(&figures.transmitted)
}
