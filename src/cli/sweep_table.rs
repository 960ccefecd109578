//! The table that `sweep` writes: row by row as CSV or JSON lines, or as Parquet in the end.

use super::console::print;
use super::sweep_parquet::ParquetTable;
use crate::io::{Failure, check_writable};
use crate::measure::{Interval, MeasureName};
use crate::render::SweptStone;
use serde_json::{Map, Value, json};
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
    file: Option<(PathBuf, File)>,
    /// The number of rows that the file held already.
    kept: usize,
    /// The last of these rows, from the last row with measures on, until they have been taken again.
    checked: VecDeque<String>,
    /// The end of the rows in a file that is resumed. The bytes after it are an unfinished row, which is dropped
    /// before the next row is written.
    end: Option<u64>,
}

impl RowTable {
    /// Opens the file of a table, or standard output where there is none, and writes the names of the columns.
    fn open(
        columns: Vec<String>,
        (out, is_json, resume): (Option<&Path>, bool, bool),
    ) -> Result<Self, Failure> {
        let Some(path) = out else {
            let mut table =
                Self { columns, is_json, file: None, kept: 0, checked: VecDeque::new(), end: None };
            table.write_columns()?;
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
        // This creates missing folders, and its error is the one that other commands have where nothing can be
        // written.
        check_writable(path)?;
        let refused = |error: std::io::Error| Failure::Output(format!("{}: {error}", path.display()));
        let is_resumed = resume && path.exists();
        let mut options = OpenOptions::new();
        let file = options.read(true).write(true).create(true).truncate(!is_resumed).open(path);
        let file = file.map_err(refused)?;
        let mut table = Self {
            columns,
            is_json,
            file: Some((path.to_owned(), file)),
            kept: 0,
            checked: VecDeque::new(),
            end: None,
        };
        if is_resumed {
            table.take_up().map_err(refused)?
        } else {
            table.write_columns()?
        }
        Ok(table)
    }

    /// Counts the rows of a file that is resumed, up to the last whole one.
    fn take_up(&mut self) -> std::io::Result<()> {
        let Some((_, file)) = &mut self.file else { return Ok(()) };
        let (mut end, mut lines, mut header) = (0, 0_usize, String::new());
        let mut checked = VecDeque::new();
        let mut reader = BufReader::new(&*file);
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
        self.end = Some(end);
        if lines == 0 {
            return self.write_columns().map_err(std::io::Error::other);
        }
        if !self.is_json && header != csv_line(&self.columns) {
            return Err(std::io::Error::other("its columns are of another sweep; give another --out"));
        }
        self.kept = lines - usize::from(!self.is_json);
        self.checked = checked;
        Ok(())
    }

    fn write_columns(&mut self) -> Result<(), Failure> {
        if self.is_json { Ok(()) } else { self.put(&csv_line(&self.columns)) }
    }

    fn write(&mut self, row: &SweepRow) -> Result<(), Failure> {
        let SweepRow { file, point, numbers, error } = row;
        let line = if self.is_json {
            let texts = std::iter::once(*file).chain(point.iter().map(String::as_str));
            let texts =
                texts.map(|text| text.parse::<f64>().map_or_else(|_| json!(text), |number| json!(number)));
            let values = texts.chain(numbers.iter().map(|number| json!(number))).chain([json!(error)]);
            let mut row: Map<String, Value> = self.columns.iter().cloned().zip(values).collect();
            row.insert("file".into(), json!(file));
            format!("{}\n", Value::Object(row))
        } else {
            let texts = std::iter::once((*file).to_owned()).chain(point.iter().cloned());
            let number = |number: &Option<f64>| number.map_or(String::new(), |number| format!("{number:.7}"));
            let numbers = numbers.iter().map(number);
            let row: Vec<String> = texts.chain(numbers).chain([(*error).to_owned()]).collect();
            csv_line(&row)
        };
        match self.checked.pop_front() {
            None => self.put(&line),
            Some(last) if last == line => Ok(()),
            Some(_) => Err(another_sweep(self.file.as_ref().map_or(Path::new("-"), |(path, _)| path))),
        }
    }

    fn put(&mut self, line: &str) -> Result<(), Failure> {
        match &mut self.file {
            None => print(line.trim_end_matches('\n')),
            Some((path, file)) => {
                let dropped = self.end.take().map_or(Ok(()), |end| {
                    file.set_len(end)?;
                    file.seek(SeekFrom::Start(end)).map(drop)
                });
                let written = dropped.and_then(|()| file.write_all(line.as_bytes()));
                written.map_err(|error| Failure::Output(format!("{}: {error}", path.display())))
            }
        }
    }
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
