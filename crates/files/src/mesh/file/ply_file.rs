//! Reads PLY, text and binary, by ply-rs-bw. Text is brought into the crate's form line by line.

use super::limits::{self, MAX_VERTICES};
use super::lines::Lines;
use super::number::number as read_number;
use super::parsed_mesh::ParsedMesh;
use super::ply_header::HeaderLines;
use super::ply_rows::PlyRows;
use super::polygons::Polygons;
use super::statement::Statement;
use crate::encoding::with_line_feeds;
use crate::numbers::NumberReader;
use brillianteer_base::Fault;
use glam::DVec3;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyDef, PropertyType,
};
use std::cell::{Cell, RefCell};
use std::io::{BufRead, ErrorKind};
use std::rc::Rc;

/// The size of the longest header that is read, in bytes: hundreds of comments.
const MAX_HEADER: usize = 1 << 20;

/// The line that ends a header.
const END: &[u8] = b"end_header";

/// The names of the list of a face's or a strip's corners.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// The most bytes behind the last row of a binary file that are taken for its end.
const END_OF_FILE: usize = 8;

/// The used values of a row of a file: the position of a corner, or the corners of a face or a strip.
#[derive(Default)]
struct Row {
    at: DVec3,
    corners: Vec<i64>,
}

impl PropertyAccess for Row {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        let place = match name {
            "x" => &mut self.at.x,
            "y" => &mut self.at.y,
            "z" => &mut self.at.z,
            name if CORNERS.contains(&name) => return self.set_corners(value),
            _ => return PropertyAccessResult::Ignored,
        };
        match number(&value) {
            Some(number) => *place = number,
            None => return PropertyAccessResult::UnsupportedType,
        }
        PropertyAccessResult::Set
    }
}

impl Row {
    fn set_corners(&mut self, value: Property) -> PropertyAccessResult {
        // A number that is not whole becomes one that no corner has.
        let whole = |x: f64| if x.fract() == 0.0 { x as i64 } else { i64::MIN };
        self.corners = match value {
            Property::ListChar(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUChar(list) => list.into_iter().map(i64::from).collect(),
            Property::ListShort(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUShort(list) => list.into_iter().map(i64::from).collect(),
            Property::ListInt(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUInt(list) => list.into_iter().map(i64::from).collect(),
            Property::ListFloat(list) => list.into_iter().map(|x| whole(x.into())).collect(),
            Property::ListDouble(list) => list.into_iter().map(whole).collect(),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

fn number(value: &Property) -> Option<f64> {
    Some(match value {
        Property::Char(n) => f64::from(*n),
        Property::UChar(n) => f64::from(*n),
        Property::Short(n) => f64::from(*n),
        Property::UShort(n) => f64::from(*n),
        Property::Int(n) => f64::from(*n),
        Property::UInt(n) => f64::from(*n),
        Property::Float(n) => f64::from(*n),
        Property::Double(n) => *n,
        _ => return None,
    })
}

pub(super) fn read(bytes: &[u8]) -> Result<ParsedMesh, Fault> {
    let end = header_end(bytes).ok_or("the header has no end; a line `end_header` is expected")?;
    let head = with_line_feeds(&bytes[..end]);
    let parser = Parser::<Row>::new();
    let (header, above) = header(&parser, &head)?;
    check(&header)?;
    let (rows, warnings) = match header.encoding {
        Encoding::Ascii => text_rows(&parser, &header, &with_line_feeds(&bytes[end..]), above)?,
        _ => binary_rows(&parser, &header, &bytes[end..])?,
    };
    let mut polygons = Polygons::default();
    for (name, rows) in rows {
        match name {
            "vertex" => polygons = Polygons::of(rows.into_iter().map(|row| row.at).collect(), String::new()),
            "face" => faces(&rows, &mut polygons)?,
            _ => strips(&rows, &mut polygons)?,
        }
    }
    let said = header.comments.iter().find(|comment| Statement::is_meant(comment)).cloned();
    let warnings = polygons.warning("faces").into_iter().chain(warnings).collect();
    Ok(ParsedMesh { surface: polygons.surface, warnings, said, ..ParsedMesh::default() })
}

/// Returns the place behind the line that ends the header.
fn header_end(bytes: &[u8]) -> Option<usize> {
    let beginning = &bytes[..bytes.len().min(MAX_HEADER)];
    let is_line = |at: usize| {
        let before = beginning[..at].iter().rfind(|byte| !matches!(byte, b' ' | b'\t'));
        let behind = beginning[at + END.len()..].iter().find(|byte| !matches!(byte, b' ' | b'\t'));
        matches!(before, Some(b'\n' | b'\r')) && matches!(behind, None | Some(b'\n' | b'\r'))
    };
    let at = beginning.windows(END.len()).enumerate().find(|(at, word)| *word == END && is_line(*at))?.0;
    let mut end = at + END.len();
    while matches!(bytes.get(end), Some(b' ' | b'\t')) {
        end += 1;
    }
    // Behind a carriage return, a binary file may begin with the byte of a line feed; its first line shows which it is.
    let is_pair =
        bytes.iter().position(|byte| *byte == b'\r').is_some_and(|at| bytes.get(at + 1) == Some(&b'\n'));
    Some((end + if bytes.get(end) == Some(&b'\r') && is_pair { 2 } else { 1 }).min(bytes.len()))
}

/// Reads a header, and returns the number of its lines with it.
fn header(parser: &Parser<Row>, head: &[u8]) -> Result<(Header, usize), Fault> {
    let line = Rc::new(Cell::new(0));
    let mut lines = HeaderLines::default();
    let number = line.clone();
    let change = |text: &[u8], out: &mut Vec<u8>| lines.hand_on(text, number.get(), out);
    let read = parser.read_header(&mut Reader::new(Lines::new(head, line.clone(), change)));
    if let Some(fault) = lines.fault {
        return Err(fault);
    }
    let unread =
        |_| Fault::line(line.get(), "the header cannot be read from here on; save the file again as PLY");
    Ok((read.map_err(unread)?, head.split(|b| *b == b'\n').count() - 1))
}

/// The rows of the elements that are read.
type Found<'h> = Vec<(&'h str, Vec<Row>)>;

/// Reads the rows of all elements in their order, and returns those of corners, faces and strips, the corners first.
fn rows<'h, R: BufRead>(
    parser: &Parser<Row>,
    header: &'h Header,
    reader: &mut Reader<R>,
) -> Result<Found<'h>, Unread> {
    let mut all: Found<'_> = vec![];
    for (name, element) in &header.elements {
        let rows = parser
            .read_payload_for_element(reader, element, header)
            .map_err(|error| Unread::of(name, element.count, &error))?;
        if matches!(name.as_str(), "vertex" | "face" | "tristrips") {
            all.push((name, rows));
        }
    }
    all.sort_by_key(|(name, _)| *name != "vertex");
    Ok(all)
}

/// Reads the rows of a binary file, and a warning about bytes behind them.
fn binary_rows<'h>(
    parser: &Parser<Row>,
    header: &'h Header,
    mut bytes: &[u8],
) -> Result<(Found<'h>, Vec<String>), Fault> {
    let found = rows(parser, header, &mut Reader::new(&mut bytes)).map_err(|unread| unread.fault)?;
    let left = bytes.len();
    let warning = (left > END_OF_FILE).then(|| format!("{left} bytes behind the last row are left out"));
    Ok((found, warning.into_iter().collect()))
}

/// Reads the rows of a text, whose header has `above` lines, and warnings about its numbers and rows.
fn text_rows<'h>(
    parser: &Parser<Row>,
    header: &'h Header,
    text: &[u8],
    above: usize,
) -> Result<(Found<'h>, Vec<String>), Fault> {
    let line = Rc::new(Cell::new(0));
    let state = RefCell::new((NumberReader::default(), PlyRows::of(header), None::<Fault>));
    let change = |text: &[u8], out: &mut Vec<u8>| {
        let (numbers, rows, broken) = &mut *state.borrow_mut();
        let number = above + line.get();
        if rows.are_over() {
            return rows.leave_out(text);
        }
        let tidied = tidy(&String::from_utf8_lossy(text), numbers, number);
        let checked = tidied.and_then(|text| {
            let words: Vec<&str> = text.split_whitespace().collect();
            // Blank lines are left out.
            let words = if words.is_empty() { &words } else { rows.check(&words, number)? };
            Ok(words.join(" "))
        });
        match checked {
            Ok(text) if text.is_empty() => {}
            Ok(text) => out.extend((text + "\n").bytes()),
            Err(fault) => drop(broken.get_or_insert(fault)),
        }
    };
    let mut reader = Reader::new(Lines::new(text, line.clone(), change));
    let found = rows(parser, header, &mut reader);
    if found.is_ok() {
        // The lines behind the last row are counted.
        let _ = std::io::copy(reader.get_mut(), &mut std::io::sink());
    }
    drop(reader);
    let (numbers, mut rows, broken) = state.into_inner();
    if let Some(fault) = broken {
        return Err(fault);
    }
    let in_line = |Unread { is_cut_off, fault }| match rows.cut_off().filter(|_| is_cut_off) {
        Some(cut_off) => cut_off,
        None => Fault { line: Some(above + line.get()), ..fault },
    };
    let found = found.map_err(in_line)?;
    Ok((found, numbers.warning().into_iter().chain(rows.warnings()).collect()))
}

/// Brings a row of a text into the form that the crate takes, whose numbers have digits on both sides of a decimal point and
/// are finite.
fn tidy(row: &str, numbers: &mut NumberReader, line: usize) -> Result<String, Fault> {
    let is_plain = |word: &str| {
        let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
        let is_known = |c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.' | 'e' | 'E');
        digit(word.trim_start_matches(['-', '+']).chars().next())
            && digit(word.chars().last())
            && word.chars().all(is_known)
            && !word.contains(".e")
    };
    let mut tidied = String::with_capacity(row.len());
    for word in row.split_whitespace() {
        if is_plain(word) {
            tidied += word;
        } else {
            let number = read_number(numbers, word, line)?;
            // Too large for any number: the position is then not finite, as the file says.
            tidied += &if number.is_finite() { format!("{number}") } else { "9e999".to_owned() };
        }
        tidied.push(' ');
    }
    Ok(tidied)
}

/// Checks that the counts in a header are of a sane size, before anything is read by them, and that it has corners and
/// faces.
fn check(header: &Header) -> Result<(), Fault> {
    for (name, element) in &header.elements {
        if element.count > MAX_VERTICES || element.properties.is_empty() && element.count > 0 {
            let message = format!(
                "{} rows of {} properties are announced; at most {MAX_VERTICES} rows of one or more are expected",
                element.count,
                element.properties.len()
            );
            return Err(Fault::part(format!("element {name}"), message));
        }
    }
    let expected = |name: &str, element: &str| {
        Err(Fault::part("header", format!("`{name}` of element `{element}` is expected")))
    };
    let has = |element: Option<&ElementDef>, names: &[&str]| {
        element.is_some_and(|e| names.iter().any(|name| e.properties.contains_key(*name)))
    };
    let element = |name: &str| header.elements.get(name);
    if let Some(axis) = ["x", "y", "z"].iter().find(|axis| !has(element("vertex"), &[axis])) {
        return expected(axis, "vertex");
    }
    let is_list = |property: &PropertyDef| matches!(property.data_type, PropertyType::List(..));
    for (name, element) in &header.elements {
        let (wanted, kind, list): (&[&str], _, _) = match name.as_str() {
            "vertex" => (&["x", "y", "z"], "a number", false),
            "face" | "tristrips" => (&CORNERS, "a list of numbers", true),
            _ => continue,
        };
        let is_wrong = |name: &&&str| element.properties.get(**name).is_some_and(|p| is_list(p) != list);
        if let Some(property) = wanted.iter().find(is_wrong) {
            let message =
                format!("`{property}` of element `{name}` must be {kind}; save the file again as PLY");
            return Err(Fault::part("header", message));
        }
    }
    let parts = ["face", "tristrips"].map(element);
    if parts.iter().flatten().all(|part| part.count == 0) {
        return Err("this is a cloud of points without faces; save a closed surface of faces".into());
    }
    if parts.iter().any(|part| has(*part, &CORNERS)) { Ok(()) } else { expected(CORNERS[0], "face") }
}

fn faces(rows: &[Row], polygons: &mut Polygons) -> Result<(), Fault> {
    for (number, row) in (1..).zip(rows) {
        let corners = corners(&row.corners, polygons).map_err(|fault| part("face", number, &fault))?;
        polygons.add(&corners);
        limits::count(0, polygons.surface.triangles.len())?;
    }
    Ok(())
}

/// Adds strips of triangles, each of which takes its first two corners from the one before. -1 begins a new strip.
fn strips(rows: &[Row], polygons: &mut Polygons) -> Result<(), Fault> {
    for (number, row) in (1..).zip(rows) {
        for strip in row.corners.split(|corner| *corner == -1) {
            let corners = corners(strip, polygons).map_err(|fault| part("strip", number, &fault))?;
            for (place, window) in corners.windows(3).enumerate() {
                let (a, b) = if place % 2 == 0 { (0, 1) } else { (1, 0) };
                polygons.add(&[window[a], window[b], window[2]]);
            }
            limits::count(0, polygons.surface.triangles.len())?;
        }
    }
    Ok(())
}

/// Returns the corners of a face or a strip, all of which exist.
fn corners(numbers: &[i64], polygons: &Polygons) -> Result<Vec<u32>, String> {
    let known = polygons.surface.vertices.len();
    let corner = |&number: &i64| match u32::try_from(number) {
        Ok(corner) if (corner as usize) < known => Ok(corner),
        Ok(_) => Err(format!("it refers to corner {number}, counted from 0, and there are {known}")),
        Err(_) if number == i64::MIN => {
            Err("it refers to a corner by a number that is not whole; whole numbers are expected".to_owned())
        }
        Err(_) => Err(format!("it refers to corner {number}; a number from 0 is expected")),
    };
    numbers.iter().map(corner).collect()
}

fn part(what: &str, number: usize, problem: &str) -> Fault {
    Fault::part(format!("{what} {number}"), problem)
}

/// The rows of an element that the crate cannot read.
struct Unread {
    /// True where the file ends too soon.
    is_cut_off: bool,
    fault: Fault,
}

impl Unread {
    fn of(name: &str, count: usize, error: &ParseError) -> Self {
        let is_cut_off = error.kind() == ErrorKind::UnexpectedEof;
        let problem = if is_cut_off {
            format!("the file ends before its {count} rows: it has been cut off, or its header is wrong")
        } else {
            format!(
                "its {count} rows are not of the types that the header announces; save the file again as PLY"
            )
        };
        Self { is_cut_off, fault: Fault::part(format!("element {name}"), problem) }
    }
}
