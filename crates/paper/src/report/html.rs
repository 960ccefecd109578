//! A report as a web page of one file: it contains pictures, drawings and font, and fetches nothing.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use brillianteer_picture::{FigureRow, Report, ReportCell, ReportPart, ReportTable, TextFlow};
use std::fmt::Write;

/// The style of the page, on a screen and in print.
const STYLE: &str = include_str!("page.css");

/// Returns a report as the text of a web page.
pub fn report_html(report: &Report) -> String {
    let mut page = String::new();
    let font = STANDARD.encode(epaint_default_fonts::UBUNTU_LIGHT);
    let title = escaped(&report.title);
    // Writing to a string cannot fail, here and below.
    let _ = write!(
        page,
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"generator\" content=\"Brillianteer {}\">\n<title>{title}</title>\n<style>\n\
         @font-face {{ font-family: Ubuntu; font-weight: 300; src: url(data:font/ttf;base64,{font}) format(\"truetype\"); }}\n\
         {STYLE}</style>\n</head>\n<body>\n<main>\n<p class=\"imprint\"><b>BRILLIANTEER</b> <span>report on the light and the \
         geometry of a cut</span></p>\n<h1>{title}</h1>\n",
        env!("CARGO_PKG_VERSION"),
    );
    if !report.subtitle.is_empty() {
        let _ = writeln!(page, "<p class=\"subtitle\">{}</p>", escaped(&report.subtitle));
    }
    if !report.facts.is_empty() {
        page += &pairs("facts", &report.facts);
    }
    for part in &report.parts {
        let _ = match part {
            ReportPart::Heading(text) => writeln!(page, "<h2>{}</h2>", escaped(text)),
            ReportPart::Text(text) => writeln!(page, "<p>{}</p>", escaped(text)),
            ReportPart::Figures(row) => writeln!(page, "{}", figures(row)),
            ReportPart::Table(table) => writeln!(page, "{}", rows(table)),
        };
    }
    let _ = writeln!(
        page,
        "<footer>\n{}</footer>\n</main>\n</body>\n</html>",
        pairs("provenance", &report.provenance)
    );
    page
}

/// Returns pairs of a label and a value as a list.
fn pairs(class: &str, pairs: &[[String; 2]]) -> String {
    let item = |[label, value]: &[String; 2]| {
        format!("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(label), escaped(value))
    };
    format!("<dl class=\"{class}\">\n{}</dl>\n", pairs.iter().map(item).collect::<String>())
}

fn figures(row: &FigureRow) -> String {
    let mut text = "<div class=\"figures\">\n".to_owned();
    let aspects: f64 = row.figures.iter().map(|figure| figure.drawing.aspect()).sum();
    // Where the height of the pictures is limited, the width that they fill together is limited as well.
    let width = (100.0 * row.most_height * aspects).min(100.0);
    for figure in &row.figures {
        let caption = escaped(&figure.caption);
        let share = width * figure.drawing.aspect() / aspects;
        let _ = writeln!(
            text,
            "<figure style=\"flex: 0 1 calc({share:.2}% - 12px)\">{}<figcaption>{caption}</figcaption></figure>",
            figure.drawing.element(&caption)
        );
    }
    text + "</div>"
}

fn rows(table: &ReportTable) -> String {
    let class = if table.across > 1 { "across" } else { "rows" };
    let mut text = format!("<table class=\"{class}\">\n");
    let of = |flow: TextFlow| match flow {
        TextFlow::Words => "words",
        TextFlow::Numbers => "numbers",
        TextFlow::Sentences => "sentences",
    };
    if table.has_heads() {
        let head = table.columns.iter();
        let head =
            head.map(|column| format!("<th class=\"{}\">{}</th>", of(column.flow), escaped(&column.head)));
        let _ = writeln!(text, "<thead><tr>{}</tr></thead>", head.collect::<String>());
    }
    text += "<tbody>\n";
    for row in &table.rows {
        let cell = |(cell, flow): (&ReportCell, TextFlow)| {
            let content = escaped(&cell.text);
            let content = if cell.is_marked { format!("<strong>{content}</strong>") } else { content };
            format!("<td class=\"{}\">{content}</td>", of(flow))
        };
        let cells = row.iter().zip(table.columns.iter().map(|column| column.flow)).map(cell);
        let _ = writeln!(text, "<tr>{}</tr>", cells.collect::<String>());
    }
    text + "</tbody>\n</table>"
}

/// Escapes text for HTML.
fn escaped(text: &str) -> String {
    let pairs = [("&", "&amp;"), ("<", "&lt;"), (">", "&gt;"), ("\"", "&quot;")];
    pairs.iter().fold(text.to_owned(), |text, (character, entity)| text.replace(character, entity))
}
