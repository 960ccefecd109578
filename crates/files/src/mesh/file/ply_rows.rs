//! Checks the rows of a PLY in text against its header, so that errors can say which row is at fault, and how.

use brillianteer_base::Fault;
use ply_rs_bw::ply::{ElementDef, Header, PropertyType, ScalarType};

/// The most characters of a word that a message quotes.
const QUOTED: usize = 40;

/// A counter of the rows of a text.
pub(super) struct PlyRows<'h> {
    elements: Vec<&'h ElementDef>,
    /// The element that the next row belongs to, and the number of its rows so far.
    element: usize,
    row: usize,
    /// The line of the first row that is longer than announced, and the number of such rows.
    long: Option<(usize, usize)>,
    /// The number of lines behind the last row.
    behind: usize,
}

impl<'h> PlyRows<'h> {
    pub fn of(header: &'h Header) -> Self {
        let elements = header.elements.iter().map(|(_, element)| element).collect();
        Self { elements, element: 0, row: 0, long: None, behind: 0 }
    }

    /// Returns the element of the next row; `None` behind the last.
    fn current(&mut self) -> Option<&'h ElementDef> {
        while self.elements.get(self.element).is_some_and(|element| self.row >= element.count) {
            self.element += 1;
            self.row = 0;
        }
        self.elements.get(self.element).copied()
    }

    /// Returns whether all announced rows have been read.
    pub fn are_over(&mut self) -> bool {
        self.current().is_none()
    }

    /// Leaves out a line behind the last row. Blank ones and the zeros or the mark with which some systems end texts do not
    /// count.
    pub fn leave_out(&mut self, line: &[u8]) {
        let is_blank = |byte: &u8| byte.is_ascii_whitespace() || byte.is_ascii_control();
        self.behind += usize::from(!line.iter().all(is_blank));
    }

    /// Checks the next row, which is not blank, and returns the words of it that are announced.
    pub fn check<'w>(&mut self, words: &'w [&'w str], line: usize) -> Result<&'w [&'w str], Fault> {
        let Some(element) = self.current() else { return Ok(words) };
        self.row += 1;
        let (mut rest, mut wanted) = (words, 0);
        let in_row = |problem: String| {
            Fault::line(line, format!("row {} of element `{}`: {problem}", self.row, element.name))
        };
        for (name, property) in &element.properties {
            let (count, of) = match &property.data_type {
                PropertyType::Scalar(of) => (1, of),
                PropertyType::List(_, of) => {
                    wanted += 1;
                    let Some((length, later)) = rest.split_first() else {
                        return Err(in_row(format!("the length of the list `{name}` is missing")));
                    };
                    rest = later;
                    let number = length.parse::<f64>().ok().filter(|n| n.fract() == 0.0 && *n >= 0.0);
                    let number = number.ok_or_else(|| {
                        let what = "is not the length of a list; a whole number, 0 or more, is expected";
                        in_row(format!("`{length:.QUOTED$}` {what}"))
                    })?;
                    (number as usize, of)
                }
            };
            wanted = count.saturating_add(wanted);
            let Some((own, later)) = rest.split_at_checked(count) else {
                let problem = format!("it has {} numbers, and {wanted} or more are announced", words.len());
                return Err(in_row(problem));
            };
            if let Some(word) = own.iter().find(|word| !fits(word, of)) {
                return Err(in_row(format!(
                    "`{word:.QUOTED$}` is no number of the type of `{name}`, {}",
                    named(of)
                )));
            }
            rest = later;
        }
        if !rest.is_empty() {
            self.long.get_or_insert((line, 0)).1 += 1;
        }
        Ok(&words[..words.len() - rest.len()])
    }

    /// Returns the fault of a text that has ended before its last row; `None` where it is complete.
    pub fn cut_off(&mut self) -> Option<Fault> {
        let element = self.current()?;
        let (name, count, there) = (&element.name, element.count, self.row);
        Some(Fault::whole(format!(
            "{count} rows of element `{name}` are announced, and {there} are there: the file has been cut off, or its \
             header is wrong"
        )))
    }

    /// Returns warnings about what is left out.
    pub fn warnings(&self) -> impl Iterator<Item = String> {
        let long = self.long.map(|(line, count)| {
            format!(
                "line {line}: {count} rows have more numbers than the header announces, which are left out"
            )
        });
        let behind =
            (self.behind > 0).then(|| format!("{} lines behind the last row are left out", self.behind));
        long.into_iter().chain(behind)
    }
}

/// Returns whether a word is a number of a type.
fn fits(word: &str, of: &ScalarType) -> bool {
    let is_within = |least: i64, most: i64| {
        word.trim_start_matches('+').parse().is_ok_and(|number| (least..=most).contains(&number))
    };
    match of {
        ScalarType::Char => is_within(i8::MIN.into(), i8::MAX.into()),
        ScalarType::UChar => is_within(0, u8::MAX.into()),
        ScalarType::Short => is_within(i16::MIN.into(), i16::MAX.into()),
        ScalarType::UShort => is_within(0, u16::MAX.into()),
        ScalarType::Int => is_within(i32::MIN.into(), i32::MAX.into()),
        ScalarType::UInt => is_within(0, u32::MAX.into()),
        ScalarType::Float | ScalarType::Double => word.parse::<f64>().is_ok(),
    }
}

fn named(of: &ScalarType) -> &'static str {
    match of {
        ScalarType::Char => "char",
        ScalarType::UChar => "uchar",
        ScalarType::Short => "short",
        ScalarType::UShort => "ushort",
        ScalarType::Int => "int",
        ScalarType::UInt => "uint",
        ScalarType::Float => "float",
        ScalarType::Double => "double",
    }
}
