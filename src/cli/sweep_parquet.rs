//! The table of a sweep as an Apache Parquet file, which appears once all rows are in it.

use super::sweep_table::SweepRow;
use brillianteer_base::Failure;
use brillianteer_files::WholeFile;
use parquet::basic::{LogicalType, Repetition, Type as PhysicalType};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The number of rows that are written together.
const GROUP: usize = 1 << 16;

/// The values of one column that wait to be written.
enum Column {
    Texts(Vec<ByteArray>),
    /// The numbers of the rows that have one, and for each row 1 where it has a number and 0 where it has none.
    Numbers(Vec<f64>, Vec<i16>),
}

impl Column {
    /// Returns the type of the column in the file.
    fn described(&self, name: &str) -> Result<Type, ParquetError> {
        let (kind, logical, repetition) = match self {
            Self::Texts(_) => (PhysicalType::BYTE_ARRAY, Some(LogicalType::String), Repetition::REQUIRED),
            Self::Numbers(..) => (PhysicalType::DOUBLE, None, Repetition::OPTIONAL),
        };
        let column = Type::primitive_type_builder(name, kind);
        column.with_logical_type(logical).with_repetition(repetition).build()
    }

    fn push_text(&mut self, text: &str) {
        match self {
            Self::Texts(texts) => texts.push(text.into()),
            Self::Numbers(..) => self.push_number(text.parse().ok()),
        }
    }

    fn push_number(&mut self, number: Option<f64>) {
        if let Self::Numbers(numbers, are_there) = self {
            numbers.extend(number);
            are_there.push(i16::from(number.is_some()));
        }
    }
}

/// A Parquet file that is being written.
pub struct ParquetTable {
    path: PathBuf,
    writer: SerializedFileWriter<WholeFile>,
    columns: Vec<Column>,
    waiting: usize,
}

impl ParquetTable {
    /// Begins a file with these columns; all hold numbers except for those that `is_text` names.
    pub fn begin(path: &Path, columns: &[String], is_text: impl Fn(usize) -> bool) -> Result<Self, Failure> {
        let empty =
            |place| if is_text(place) { Column::Texts(vec![]) } else { Column::Numbers(vec![], vec![]) };
        let kinds: Vec<Column> = (0..columns.len()).map(empty).collect();
        let begun = || {
            let fields = kinds.iter().zip(columns).map(|(kind, name)| kind.described(name).map(Arc::new));
            let fields = fields.collect::<Result<_, _>>()?;
            let schema = Type::group_type_builder("sweep").with_fields(fields).build()?;
            let file = WholeFile::begin(path).map_err(|error| ParquetError::External(Box::new(error)))?;
            SerializedFileWriter::new(file, Arc::new(schema), Arc::new(WriterProperties::builder().build()))
        };
        let writer = begun().map_err(|error| refused(path, &error))?;
        Ok(Self { path: path.to_owned(), writer, columns: kinds, waiting: 0 })
    }

    pub fn push(&mut self, row: &SweepRow) -> Result<(), Failure> {
        let (texts, numbers) = (1 + row.point.len(), row.numbers.len());
        let before = std::iter::once(row.file).chain(row.point.iter().map(String::as_str));
        self.columns.iter_mut().zip(before).for_each(|(column, text)| column.push_text(text));
        let measured = self.columns[texts..].iter_mut().zip(&row.numbers);
        measured.for_each(|(column, number)| column.push_number(*number));
        self.columns[texts + numbers].push_text(row.error);
        self.waiting += 1;
        if self.waiting == GROUP { self.write_group() } else { Ok(()) }
    }

    /// Writes the rows that wait.
    fn write_group(&mut self) -> Result<(), Failure> {
        self.waiting = 0;
        let columns = &mut self.columns;
        let writer = &mut self.writer;
        let written = || {
            let mut group = writer.next_row_group()?;
            for column in columns {
                let Some(mut place) = group.next_column()? else { break };
                match column {
                    Column::Texts(texts) => {
                        place.typed::<ByteArrayType>().write_batch(texts, None, None)?;
                        texts.clear();
                    }
                    Column::Numbers(numbers, are_there) => {
                        place.typed::<DoubleType>().write_batch(numbers, Some(are_there), None)?;
                        numbers.clear();
                        are_there.clear();
                    }
                }
                place.close()?;
            }
            group.close().map(drop)
        };
        written().map_err(|error| refused(&self.path, &error))
    }

    /// Moves the finished file to its place.
    pub fn finish(mut self) -> Result<(), Failure> {
        if self.waiting > 0 {
            self.write_group()?;
        }
        let file = self.writer.into_inner().map_err(|error| refused(&self.path, &error))?;
        Ok(file.finish()?)
    }
}

fn refused(path: &Path, error: &ParquetError) -> Failure {
    Failure::Output(format!("{}: {error}", path.display()))
}
