//! The page of text: four columns. A picture shows the two in the middle with headline and picture; the others
//! continue beside it.

use super::{INK, PATTERN_SIDE, rectangle};
use std::fmt::Write as _;
use std::iter::Peekable;
use svg::Document;
use svg::node::element::{Circle, Definitions, LinearGradient, Path, Stop, Text};

/// The text of the page, which describes the view through glass.
const WORDS: &str = "Light that enters glass is bent toward the normal, blue more than red, and bent back where it leaves. \
    Between parallel faces both cancel and the page only shifts; at a rounded rim they do not, and letters are drawn out, \
    turned over and given coloured edges. How far they move depends on how far behind the glass the page lies: laid against \
    it they are read as they are, a hand's breadth away they swim. What is dark here is ink, what is bright the lamp behind \
    you, sent back by the paper. ";

/// The left edges of the columns, their width, and the page's margins above and below.
const COLUMNS: [u32; 4] = [34, 538, 1042, 1546];
const WIDTH: u32 = 470;
const MARGIN: u32 = 40;

/// The size and the leading of the text.
const SIZE: u32 = 31;
const LEADING: u32 = 43;

const PAPER: &str = "#fdfbf7";
const RED: &str = "#b4142c";
const BLUE: &str = "#12488f";
const GREY: &str = "#55524c";

/// A picture on the page: its colours from the zenith to the horizon, of its hills from far to near, and of its water.
struct Plate {
    name: &'static str,
    sky: [&'static str; 4],
    hills: [&'static str; 2],
    water: [&'static str; 2],
    sun: &'static str,
}

const EVENING: Plate = Plate {
    name: "evening",
    sky: ["#17356e", "#7a4a86", "#e8714f", "#ffc24a"],
    hills: ["#8a4a5e", "#33233f"],
    water: ["#d9784f", "#1b2f5c"],
    sun: "#fff3b8",
};

const MORNING: Plate = Plate {
    name: "morning",
    sky: ["#1479b8", "#55b4d8", "#bfe3dc", "#fff0bf"],
    hills: ["#5f9aa0", "#1d5a4c"],
    water: ["#8fd0cf", "#0d5f7c"],
    sun: "#ffffff",
};

/// Draws the pattern `page` on a square sheet: a headline, columns of text and a picture.
pub(super) fn page(sheet: Document) -> Document {
    let paper = rectangle((0, 0, PATTERN_SIDE, PATTERN_SIDE)).set("fill", PAPER);
    let mut words = WORDS.split_whitespace().cycle().peekable();
    let end = PATTERN_SIDE - MARGIN;
    let [first, second, third, fourth] = COLUMNS;
    let mut sheet = sheet.add(paper);
    // These columns lie around the middle, from where glass bends light in.
    for (x, from, to) in [(first, MARGIN, 900), (first, 1260, end), (second, MARGIN, 470)] {
        sheet = column(sheet, x, [from, to], &mut words);
    }
    sheet = plate(sheet, &MORNING, [first, 920, WIDTH, 310]);
    sheet = column(sheet, third, [MARGIN, 470], &mut words);
    sheet = column(sheet, fourth, [MARGIN, 620], &mut words);
    sheet = plate(sheet, &EVENING, [fourth, 640, WIDTH, 330]);
    sheet = column(sheet, fourth, [1000, end], &mut words);
    // The middle half of the sheet follows.
    let both = third + WIDTH - second;
    sheet = sheet.add(rectangle((second, 506, both, 10)).set("fill", RED));
    sheet = line(sheet, "OPTICS AT HOME", [second, 556], 30, RED, 1);
    sheet = line(sheet, "How Glass Bends Light", [second, 648], 90, INK, 4);
    sheet = line(sheet, "And why it never bends all colours alike", [second, 708], 40, GREY, 1);
    sheet = sheet.add(rectangle((second, 732, both, 2)).set("fill", INK));
    sheet = column(sheet, second, [752, 1130], &mut words);
    sheet = line(sheet, "Blue more than red,", [second, 1198], 52, BLUE, 2);
    sheet = line(sheet, "and bent back again.", [second, 1256], 52, BLUE, 2);
    sheet = spectrum(sheet, [second, 1280, WIDTH, 14]);
    sheet = column(sheet, second, [1312, end], &mut words);
    sheet = plate(sheet, &EVENING, [third, 762, WIDTH, 380]);
    sheet = line(sheet, "The sun in the last of its evening air.", [third, 1176], 24, GREY, 0);
    sheet = column(sheet, third, [1196, 1660], &mut words);
    sheet = plate(sheet, &MORNING, [third, 1690, WIDTH, 300]);
    definitions(sheet)
}

/// Writes lines, broken between words, from one height to another.
fn column<'a>(
    sheet: Document,
    x: u32,
    [from, to]: [u32; 2],
    words: &mut Peekable<impl Iterator<Item = &'a str>>,
) -> Document {
    // Letters are 0.46 of the size wide on average.
    let letters = (WIDTH * 50 / (23 * SIZE)) as usize;
    let lines = (to - from) / LEADING;
    (1..=lines).fold(sheet, |sheet, row| {
        let mut text = String::new();
        while let Some(word) = words.next_if(|word| text.len() + word.len() < letters) {
            // Writing to a string cannot fail.
            let _ = write!(text, "{word} ");
        }
        line(sheet, text.trim_end(), [x, from + row * LEADING - 10], SIZE, INK, 1)
    })
}

/// Writes one line; `weight` is the width of the letters' outline, which makes them bolder.
fn line(sheet: Document, text: &str, [x, y]: [u32; 2], size: u32, colour: &str, weight: u32) -> Document {
    let text = Text::new(text).set("x", x).set("y", y).set("font-family", "Ubuntu").set("font-size", size);
    sheet.add(text.set("fill", colour).set("stroke", colour).set("stroke-width", weight))
}

/// Draws the colours of the spectrum side by side.
fn spectrum(sheet: Document, [x, y, width, height]: [u32; 4]) -> Document {
    sheet.add(rectangle((x, y, width, height)).set("fill", "url(#spectrum)"))
}

/// Draws a picture of a sky, hills and water with the sun in it.
fn plate(sheet: Document, plate: &Plate, [x, y, width, height]: [u32; 4]) -> Document {
    let shore = y + height * 62 / 100;
    let at = |part: u32, whole: u32| x + width * part / whole;
    let sun = [at(66, 100), shore - height * 14 / 100];
    let range = |heights: [u32; 9]| {
        let mut data = format!("M{x},{shore}");
        for (k, top) in (0..).zip(heights) {
            let _ = write!(data, "L{},{}", at(k, 8), shore - height * top / 100);
        }
        Path::new().set("d", data + &format!("L{},{shore}z", x + width))
    };
    let glow = Circle::new().set("cx", sun[0]).set("cy", sun[1]).set("r", height / 12).set("fill", plate.sun);
    let sky = rectangle((x, y, width, shore - y)).set("fill", format!("url(#{}-sky)", plate.name));
    let water =
        rectangle((x, shore, width, y + height - shore)).set("fill", format!("url(#{}-water)", plate.name));
    let sheet = sheet
        .add(sky)
        .add(glow)
        .add(range([14, 20, 13, 17, 9, 6, 3, 8, 12]).set("fill", plate.hills[0]))
        .add(water)
        .add(range([7, 10, 8, 4, 2, 0, 0, 1, 5]).set("fill", plate.hills[1]));
    (0..7).fold(sheet, |sheet, k| {
        let half = height / 30 + k * height / 70;
        let top = shore + 4 + k * (y + height - shore - 8) / 7;
        let glint = rectangle((sun[0] - half, top, 2 * half, 4)).set("fill", plate.sun);
        sheet.add(glint.set("opacity", 0.8 - 0.08 * f64::from(k)))
    })
}

/// Adds the gradients that pictures are filled with.
fn definitions(sheet: Document) -> Document {
    let gradient = |id: String, colours: &[&str], is_down: bool| {
        let end = if is_down { (0, 1) } else { (1, 0) };
        let gradient = LinearGradient::new().set("id", id).set("x1", 0).set("y1", 0);
        let gradient = gradient.set("x2", end.0).set("y2", end.1);
        let last = (colours.len() - 1).max(1) as f64;
        colours.iter().enumerate().fold(gradient, |gradient, (k, colour)| {
            gradient.add(Stop::new().set("offset", k as f64 / last).set("stop-color", *colour))
        })
    };
    let hues = ["#5b1d91", "#2340c8", "#0f9bd6", "#17a84b", "#f2d21b", "#f08019", "#c8141e"];
    let mut all = Definitions::new().add(gradient("spectrum".to_owned(), &hues, false));
    for plate in [&EVENING, &MORNING] {
        all = all.add(gradient(format!("{}-sky", plate.name), &plate.sky, true));
        all = all.add(gradient(format!("{}-water", plate.name), &plate.water, true));
    }
    sheet.add(all)
}
