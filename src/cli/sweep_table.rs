//! The table that `sweep` writes: row by row as CSV or JSON lines, or as Parquet in the end.

use super::console::{json_line, print};
use super::sweep_parquet::ParquetTable;
use brillianteer_base::{ByName, Failure};
use brillianteer_files::{WholeFile, check_writable};
use brillianteer_measure::{Interval, MeasureName};
use brillianteer_render::SweptStone;
use serde::Serialize;
use std::collections::VecDeque;
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// One row of a sweep's table, in the order of its columns.
pub struct SweepRow<'a> {
    pub file: &'a str,
    /// The value of each axis.
    pub point: &'a [String],
    /// The carats, each measure with its error, and the unresolved part of the light; `None` where there is no
    /// number.
    pub numbers: Vec<Option<f64>>,
    pub error: &'a str,
}

impl<'a> SweepRow<'a> {
    fn of(
        (file, point): (&'a str, &'a [String]),
        measures: &[MeasureName],
        (stone, error): (Option<&SweptStone>, &'a str),
    ) -> Self {
        let of = |name: &MeasureName| stone.and_then(|stone| name.of(&stone.measures));
        let parts = |interval: Interval| [interval.middle(), interval.error()];
        let intervals =
            measures.iter().flat_map(|name| of(name).map_or([None; 2], |interval| parts(interval).map(Some)));
        let carats = stone.and_then(|stone| stone.carats);
        let unresolved = stone.map(|stone| stone.measures.unresolved);
        let numbers = std::iter::once(carats).chain(intervals).chain([unresolved]).collect();
        Self { file, point, numbers, error }
    }
}

/// The table of a sweep in its format.
pub enum SweepTable {
    /// Its rows are written at once, so that a sweep that was stopped can go on.
    ByRow(RowTable),
    /// Its file appears in the end.
    Parquet(Box<ParquetTable>),
}

impl SweepTable {
    /// Opens the file of a table, or standard output where there is none. The axes named by `is_text` hold names, not numbers.
    pub fn open(
        columns: Vec<String>,
        axes: &[bool],
        (out, is_json, resume): (Option<&Path>, bool, bool),
    ) -> Result<Self, Failure> {
        let Some(path) = out.filter(|path| path.extension().is_some_and(|ending| ending == "parquet")) else {
            return RowTable::open(columns, (out, is_json, resume)).map(Self::ByRow);
        };
        if resume {
            let text = format!("--out {}: only .csv and .jsonl can be resumed", path.display());
            return Err(Failure::Usage(text));
        }
        let last = columns.len() - 1;
        let is_text =
            |place: usize| place == 0 || place == last || axes.get(place - 1).is_some_and(|is_text| *is_text);
        Ok(Self::Parquet(Box::new(ParquetTable::begin(path, &columns, is_text)?)))
    }

    /// Returns the number of rows that the file held already and that need not be taken again. The last row with
    /// measures and those after it are taken again: they must be the same, or the file belongs to another sweep.
    pub fn kept(&self) -> usize {
        match self {
            Self::ByRow(table) => table.kept - table.checked.len(),
            Self::Parquet(_) => 0,
        }
    }

    /// Writes the row of a point.
    pub fn write(
        &mut self,
        place: (&str, &[String]),
        measures: &[MeasureName],
        found: (Option<&SweptStone>, &str),
    ) -> Result<(), Failure> {
        let row = SweepRow::of(place, measures, found);
        match self {
            Self::ByRow(table) => table.write(&row),
            Self::Parquet(table) => table.push(&row),
        }
    }

    /// Moves the file to its place, where the format still needs that.
    pub fn finish(self) -> Result<(), Failure> {
        match self {
            Self::ByRow(_) => Ok(()),
            Self::Parquet(table) => table.finish(),
        }
    }
}

/// The rows of a table, as they are written.
pub struct RowTable {
    columns: Vec<String>,
    is_json: bool,
    /// The file; `None` for standard output.
    file: Option<RowFile>,
    /// The number of rows that the file held already.
    kept: usize,
    /// The last of these rows, from the last row with measures on, until they have been taken again.
    checked: VecDeque<String>,
}

impl RowTable {
    /// Opens the file of a table, or standard output where there is none.
    fn open(
        columns: Vec<String>,
        (out, is_json, resume): (Option<&Path>, bool, bool),
    ) -> Result<Self, Failure> {
        let Some(path) = out else {
            let table = Self { columns, is_json, file: None, kept: 0, checked: VecDeque::new() };
            if !is_json {
                print(csv_line(&table.columns).trim_end_matches('\n'))?;
            }
            return Ok(table);
        };
        let is_json = match path.extension().and_then(|ending| ending.to_str()) {
            Some("csv") => false,
            Some("jsonl") => true,
            _ => {
                let text =
                    format!("--out {}: give a name that ends in .csv, .jsonl or .parquet", path.display());
                return Err(Failure::Usage(text));
            }
        };
        let head = if is_json { String::new() } else { csv_line(&columns) };
        let mut table = Self { columns, is_json, file: None, kept: 0, checked: VecDeque::new() };
        // The error is the one that other commands have where nothing can be written.
        table.file = Some(if resume && path.exists() {
            check_writable(path)?;
            let refused = |error: std::io::Error| Failure::Output(format!("{}: {error}", path.display()));
            table.taken_up(path, head).map_err(refused)?
        } else {
            RowFile::begin(path, head)?
        });
        Ok(table)
    }

    /// Opens a file that is resumed, and counts its rows up to the last whole one.
    fn taken_up(&mut self, path: &Path, head: String) -> std::io::Result<RowFile> {
        let file = OpenOptions::new().read(true).write(true).open(path)?;
        let (mut end, mut lines, mut header) = (0, 0_usize, String::new());
        let mut checked = VecDeque::new();
        let mut reader = BufReader::new(&file);
        loop {
            let mut line = String::new();
            let length = reader.read_line(&mut line)?;
            if length == 0 || !line.ends_with('\n') {
                break;
            }
            if lines == 0 {
                header.clone_from(&line);
            }
            end += length as u64;
            lines += 1;
            if self.is_json || lines > 1 {
                if has_measures(&line, self.is_json) {
                    checked.clear();
                }
                checked.push_back(line);
            }
        }
        if lines > 0 && header != head && !self.is_json {
            return Err(std::io::Error::other("its columns are of another sweep; give another --out"));
        }
        self.kept = lines.saturating_sub(usize::from(!self.is_json));
        self.checked = checked;
        let head = if lines == 0 { head } else { String::new() };
        Ok(RowFile { path: path.to_owned(), head, rows: Rows::InPlace(file), end })
    }

    fn write(&mut self, row: &SweepRow) -> Result<(), Failure> {
        let line = self.line(row)?;
        match self.checked.pop_front() {
            None => match &mut self.file {
                None => print(line.trim_end_matches('\n')),
                Some(file) => file.put(&line),
            },
            Some(last) if last == line => Ok(()),
            Some(_) => Err(another_sweep(self.file.as_ref().map_or(Path::new("-"), |file| &file.path))),
        }
    }

    /// Returns the line of a row.
    fn line(&self, row: &SweepRow) -> Result<String, Failure> {
        let SweepRow { file, point, numbers, error } = row;
        if self.is_json {
            let point = point.iter().map(|text| match text.parse() {
                Ok(number) => RowValue::Number(Some(number)),
                Err(_) => RowValue::Text(text),
            });
            let numbers = numbers.iter().copied().map(RowValue::Number);
            let values = std::iter::once(RowValue::Text(file)).chain(point).chain(numbers);
            let columns = self.columns.iter().map(String::as_str);
            let row: ByName<RowValue> = columns.zip(values.chain([RowValue::Text(error)])).collect();
            return Ok(json_line(&row)? + "\n");
        }
        let texts = std::iter::once((*file).to_owned()).chain(point.iter().cloned());
        let number = |number: &Option<f64>| number.map_or(String::new(), |number| format!("{number:.7}"));
        let numbers = numbers.iter().map(number);
        let row: Vec<String> = texts.chain(numbers).chain([(*error).to_owned()]).collect();
        Ok(csv_line(&row))
    }
}

/// The value of a column in a row as JSON.
#[derive(Serialize)]
#[serde(untagged)]
enum RowValue<'a> {
    Text(&'a str),
    /// A number; `None` where there is none.
    Number(Option<f64>),
}

/// A file that takes rows one after the other. It appears, and replaces a file of its name, with its first row; it holds whole
/// rows at any time, also where a row could not be written.
struct RowFile {
    path: PathBuf,
    /// The names of the columns, which are written before the first row.
    head: String,
    rows: Rows,
    /// The end of the last whole row. What a file that is resumed holds after it is dropped before the next row is written.
    end: u64,
}

/// The place of a file's rows.
enum Rows {
    /// A file that takes the place of the path with its first row.
    Begun(Box<WholeFile>),
    InPlace(File),
    /// There is no file any more, since its first row could not be written.
    Nowhere,
}

impl RowFile {
    fn begin(path: &Path, head: String) -> Result<Self, Failure> {
        let rows = Rows::Begun(Box::new(WholeFile::begin(path)?));
        Ok(Self { path: path.to_owned(), head, rows, end: 0 })
    }

    fn put(&mut self, line: &str) -> Result<(), Failure> {
        let text = std::mem::take(&mut self.head) + line;
        let refused = |error: std::io::Error| Failure::Output(format!("{}: {error}", self.path.display()));
        match std::mem::replace(&mut self.rows, Rows::Nowhere) {
            Rows::Begun(mut begun) => {
                begun.write_all(text.as_bytes()).map_err(refused)?;
                self.rows = begun.finish_open()?.map_or(Rows::Nowhere, Rows::InPlace);
            }
            Rows::InPlace(mut file) => {
                let written = add(&mut file, self.end, &text);
                if written.is_err() {
                    // Rows that are whole can be resumed.
                    let _ = file.set_len(self.end);
                }
                self.rows = Rows::InPlace(file);
                written.map_err(refused)?;
            }
            Rows::Nowhere => {}
        }
        self.end += text.len() as u64;
        Ok(())
    }
}

/// Writes text at a place of a file, in which nothing follows.
fn add(file: &mut File, at: u64, text: &str) -> std::io::Result<()> {
    // A pipe has no length and no places.
    if file.metadata()?.is_file() {
        file.set_len(at)?;
        file.seek(SeekFrom::Start(at))?;
    }
    file.write_all(text.as_bytes())
}

/// Returns whether a row has measures: its last column, the error, is empty.
fn has_measures(row: &str, is_json: bool) -> bool {
    row.trim_end().ends_with(if is_json { "\"error\":\"\"}" } else { "," })
}

/// Returns the line of a row, with its line break.
fn csv_line(fields: &[String]) -> String {
    let mut writer = csv::Writer::from_writer(vec![]);
    // Writing to memory cannot fail.
    let _ = writer.write_record(fields);
    String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
}

/// Returns the error of a file whose rows belong to another sweep.
pub fn another_sweep(path: &Path) -> Failure {
    Failure::Usage(format!(
        "{}: its rows are of another sweep, or were made with other options; give another --out, or leave --resume out to replace it",
        path.display()
    ))
}
