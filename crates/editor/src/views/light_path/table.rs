//! The steps of a path as rows of figures.

use super::Reading;
use brillianteer_math::fixed;
use brillianteer_trace::ray::{Leaving, Step};
use egui::{
    Align, Align2, Color32, FontId, Rect, Response, ScrollArea, Sense, StrokeKind, TextStyle, Ui, WidgetInfo,
    accesskit::Role, pos2, vec2,
};

/// Number of columns.
const COLUMNS: usize = 9;

/// A column: its heading, an explanation, and the side to which its cells are aligned.
struct Column {
    heading: &'static str,
    meaning: &'static str,
    align: Align,
}

const fn column(heading: &'static str, meaning: &'static str, align: Align) -> Column {
    Column { heading, meaning, align }
}

const HEADINGS: [Column; COLUMNS] = [
    column(
        "step",
        "The facets in the order in which the light meets them, numbered as in the drawing",
        Align::Max,
    ),
    column("facet", "The facet that the light meets", Align::Min),
    column("angle", "Angle of incidence, between the light and the facet's normal", Align::Max),
    column("critical", "Critical angle: beyond it all light is reflected", Align::Max),
    column(
        "leaves",
        "Share of the light that leaves here; \"total\" where all light is reflected",
        Align::Max,
    ),
    column("elev.", "Elevation of the light that leaves, above the scope's plane", Align::Max),
    column("azim.", "Azimuth of the light that leaves, around the scope's axis", Align::Max),
    column("zone", "Zone of the scope that the light reaches when it leaves", Align::Min),
    column("goes on", "Share of the light that goes on inside the stone", Align::Max),
];

/// The index of the column that has a swatch of the zone's colour before its text.
const ZONE: usize = 7;

/// Least and largest space between columns, in points.
const GAPS: (f32, f32) = (7.0, 18.0);

/// Smallest type size, in points. Where the columns do not fit at this size, they scroll.
const LEAST_TYPE: f32 = 10.0;

/// Room for the scroll bar, in points.
const BAR: f32 = 8.0;

/// Number of characters above which a facet's name is cut short.
const LONGEST_NAME: usize = 20;

/// The texts of the table.
pub(super) struct PathTable {
    rows: Vec<Row>,
    summary: String,
}

struct Row {
    cells: [String; COLUMNS],
    /// The colour of the zone that the light goes to; `None` where no light leaves for good.
    zone: Option<Color32>,
    /// The row in words, for screen readers.
    spoken: String,
}

/// The type of the table, and the widths of its columns in that type.
struct Columns {
    font: FontId,
    widths: [f32; COLUMNS],
    gap: f32,
}

impl PathTable {
    pub fn new(reading: &Reading) -> Self {
        let steps = &reading.path.steps;
        let rows = (1..).zip(steps).map(|(number, step)| row(reading, number, step)).collect();
        let left: f64 = steps.iter().filter_map(|step| step.leaving).map(|leaving| leaving.share).sum();
        let rest = reading.path.rest;
        let summary = format!(
            "{} leaves, {} is absorbed, {} not followed",
            percent(left),
            percent(rest.absorbed),
            percent(rest.unresolved)
        );
        Self { rows, summary }
    }

    /// Returns the width of the table at the usual type size, in points.
    pub fn width(&self, ui: &Ui) -> f32 {
        Columns::new(ui, self, TextStyle::Body.resolve(ui.style())).width() + BAR
    }

    /// Shows the table over all the available room and returns the step under the pointer. A click on a step puts it into
    /// `kept`, a second click takes it out.
    pub fn show(&self, ui: &mut Ui, kept: &mut Option<usize>) -> Option<usize> {
        ui.label(&self.summary);
        let columns = Columns::fitting(ui, self, ui.available_width() - BAR);
        let width = columns.width() + BAR;
        let shown = ScrollArea::horizontal().auto_shrink(false).show(ui, |ui| {
            ui.set_width(width.max(ui.available_width()));
            ui.spacing_mut().item_spacing.y = 0.0;
            columns.headings(ui);
            self.body(ui, &columns, kept)
        });
        shown.inner
    }

    fn body(&self, ui: &mut Ui, columns: &Columns, kept: &mut Option<usize>) -> Option<usize> {
        let height = columns.height();
        let mut hovered = None;
        ScrollArea::vertical().auto_shrink(false).show_rows(ui, height, self.rows.len(), |ui, range| {
            for k in range {
                let response = columns.row(ui, &self.rows[k], k, *kept == Some(k));
                if response.clicked() {
                    *kept = if *kept == Some(k) { None } else { Some(k) };
                }
                hovered = if response.hovered() { Some(k) } else { hovered };
            }
        });
        hovered
    }
}

impl Columns {
    fn new(ui: &Ui, table: &PathTable, font: FontId) -> Self {
        let wide =
            |text: &str| ui.painter().layout_no_wrap(text.to_owned(), font.clone(), Color32::WHITE).size().x;
        let widths = std::array::from_fn(|c| {
            let cells = table.rows.iter().map(|row| wide(&row.cells[c])).fold(0.0, f32::max);
            wide(HEADINGS[c].heading).max(cells + if c == ZONE { swatch(font.size) } else { 0.0 }).ceil()
        });
        Self { font, widths, gap: GAPS.0 }
    }

    /// Returns columns that fill a width, in type as large as fits but no larger than usual.
    fn fitting(ui: &Ui, table: &PathTable, width: f32) -> Self {
        let usual = TextStyle::Body.resolve(ui.style());
        let columns = Self::new(ui, table, usual.clone());
        let part = (width / columns.width()).min(1.0);
        // The size is rounded down to half a point.
        let size = ((usual.size * part * 2.0).floor() / 2.0).max(LEAST_TYPE.min(usual.size));
        let mut columns = if part < 1.0 { Self::new(ui, table, FontId { size, ..usual }) } else { columns };
        let spare = (width - columns.width()) / (COLUMNS - 1) as f32;
        columns.gap = (GAPS.0 + spare).clamp(GAPS.0, GAPS.1);
        columns
    }

    fn width(&self) -> f32 {
        self.widths.iter().sum::<f32>() + self.gap * (COLUMNS - 1) as f32
    }

    fn height(&self) -> f32 {
        (self.font.size * 1.5).ceil()
    }

    /// Returns the rectangles of the columns in a row.
    fn places(&self, row: Rect) -> [Rect; COLUMNS] {
        let mut left = row.left();
        self.widths.map(|width| {
            let place = Rect::from_min_max(pos2(left, row.top()), pos2(left + width, row.bottom()));
            left = place.right() + self.gap;
            place
        })
    }

    fn headings(&self, ui: &mut Ui) {
        let (row, _) = ui.allocate_exact_size(vec2(self.width(), self.height()), Sense::hover());
        for (place, column) in self.places(row).into_iter().zip(&HEADINGS) {
            self.text(ui, place, column.align, column.heading, ui.visuals().weak_text_color());
            let response = ui.interact(
                place.expand2(vec2(self.gap / 2.0, 0.0)),
                ui.scope_id().with(column.heading),
                Sense::hover(),
            );
            response.widget_info(|| WidgetInfo::labeled(Role::ColumnHeader, true, column.meaning));
            response.on_hover_text(column.meaning);
        }
    }

    fn row(&self, ui: &mut Ui, row: &Row, k: usize, is_kept: bool) -> Response {
        let (rect, response) =
            ui.allocate_exact_size(vec2(ui.available_width(), self.height()), Sense::click());
        response.widget_info(|| WidgetInfo::selected(Role::Row, true, is_kept, &row.spoken));
        let visuals = ui.visuals();
        let is_lit = is_kept || response.hovered();
        if is_lit {
            ui.painter().rect_filled(rect, 2.0, visuals.selection.bg_fill);
        } else if k % 2 == 1 {
            ui.painter().rect_filled(rect, 0.0, visuals.faint_bg_color);
        }
        if response.has_focus() {
            ui.painter().rect_stroke(rect, 2.0, visuals.selection.stroke, StrokeKind::Inside);
        }
        let colour = if is_lit { visuals.selection.stroke.color } else { visuals.text_color() };
        for (c, mut place) in self.places(rect).into_iter().enumerate() {
            if c == ZONE
                && let Some(zone) = row.zone
            {
                self.swatch(ui, place, zone);
                place.min.x += swatch(self.font.size);
            }
            self.text(ui, place, HEADINGS[c].align, &row.cells[c], colour);
        }
        response
    }

    fn swatch(&self, ui: &Ui, place: Rect, colour: Color32) {
        let side = 0.65 * self.font.size;
        let square = Rect::from_min_size(pos2(place.left(), place.center().y - side / 2.0), vec2(side, side));
        ui.painter().rect_filled(square.expand(1.0), 2.0, ui.visuals().weak_text_color());
        ui.painter().rect_filled(square, 1.0, colour);
    }

    fn text(&self, ui: &Ui, place: Rect, align: Align, text: &str, colour: Color32) {
        let (anchor, at) = match align {
            Align::Max => (Align2::RIGHT_CENTER, place.right_center()),
            _ => (Align2::LEFT_CENTER, place.left_center()),
        };
        ui.painter().text(at, anchor, text, self.font.clone(), colour);
    }
}

/// Returns the width of a swatch and the space after it at a type size, in points.
fn swatch(size: f32) -> f32 {
    1.0 * size
}

fn row(reading: &Reading, number: usize, step: &Step) -> Row {
    let name = reading.body.name(step.facet);
    let angle = degrees(step.incidence);
    let critical = step.critical.map(degrees);
    let [leaves, elevation, azimuth, zone] = match step.leaving {
        None => ["total".to_owned(), String::new(), String::new(), String::new()],
        Some(leaving) => where_to(reading, leaving),
    };
    let goes = match step.leaving {
        None => "all reflected".to_owned(),
        Some(_) => format!("{leaves} leaves to {zone}, elevation {elevation}, azimuth {azimuth}"),
    };
    let limit = critical.as_ref().map_or(String::new(), |critical| format!(", critical angle {critical}"));
    let onward = percent(step.onward);
    let spoken = format!("Step {number}: {name}, incidence {angle}{limit}, {goes}, {onward} goes on");
    let critical = critical.unwrap_or_else(|| NONE.to_owned());
    let cells =
        [number.to_string(), shortened(&name), angle, critical, leaves, elevation, azimuth, zone, onward];
    let outside = step.leaving.filter(|leaving| leaving.again.is_none());
    Row { cells, zone: outside.map(|leaving| reading.colour(leaving.direction)), spoken }
}

/// The text in place of a number that does not exist.
const NONE: &str = "–";

/// The text in place of a zone for light that enters the stone again.
const AGAIN: &str = "stone again";

/// Returns the share, elevation, azimuth and zone of light that leaves, as texts.
fn where_to(reading: &Reading, Leaving { share, direction, again }: Leaving) -> [String; 4] {
    let azimuth = reading.azimuth(direction).map(|a| format!("{}°", a.round() % 360.0));
    [
        percent(share),
        degrees(reading.elevation(direction)),
        azimuth.unwrap_or_else(|| NONE.to_owned()),
        again.map_or_else(|| reading.band(direction).name.clone(), |_| AGAIN.to_owned()),
    ]
}

/// Writes an angle to a tenth of a degree, as cutters' gauges show it.
fn degrees(angle: f64) -> String {
    format!("{}°", fixed(angle, 1)).replace('-', "−")
}

fn percent(share: f64) -> String {
    match share {
        s if s > 0.0 && s < 0.0005 => "<0.1 %".to_owned(),
        s => format!("{:.1} %", 100.0 * s),
    }
}

/// Returns a name, cut short where it is too long for its column.
fn shortened(name: &str) -> String {
    if name.chars().count() <= LONGEST_NAME {
        return name.to_owned();
    }
    let start: String = name.chars().take(LONGEST_NAME - 1).collect();
    format!("{}…", start.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_the_digits_that_mean_something() {
        assert_eq!([0.04, -0.04, -41.26, 89.96].map(degrees), ["0.0°", "0.0°", "−41.3°", "90.0°"]);
        let shares = [0.0, 0.0004, 0.0005, 0.17181, 1.0].map(percent);
        assert_eq!(shares, ["0.0 %", "<0.1 %", "0.1 %", "17.2 %", "100.0 %"]);
    }

    #[test]
    fn a_long_name_is_cut_short() {
        assert_eq!(shortened("lower_half 16"), "lower_half 16");
        assert_eq!(shortened("äußere untere Hälftenfacette"), "äußere untere Hälft…");
    }
}
