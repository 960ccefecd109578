//! The writer of all text tables: columns with a head, a width in letters, an alignment and decimals.

use brillianteer_math::fixed;
use std::borrow::Cow;
use std::fmt;

/// The width of the names in a table of names and values.
const NAMES: usize = 28;

/// A column of a table.
#[derive(Debug, Clone)]
pub struct Column {
    head: Cow<'static, str>,
    /// The number of spaces before the column.
    gap: usize,
    /// The least number of signs; a longer cell moves all that follows it.
    width: usize,
    is_right: bool,
    /// The number of decimals of numbers.
    digits: usize,
}

impl Column {
    /// Makes a column whose cells begin at the left.
    pub fn left(head: impl Into<Cow<'static, str>>, width: usize) -> Self {
        Self { head: head.into(), gap: 0, width, is_right: false, digits: 0 }
    }

    /// Makes a column whose cells end at the right.
    pub fn right(head: impl Into<Cow<'static, str>>, width: usize) -> Self {
        Self { is_right: true, ..Self::left(head, width) }
    }

    /// Makes a last column of text as long as it is.
    pub fn text(head: impl Into<Cow<'static, str>>) -> Self {
        Self::left(head, 0)
    }

    /// Puts so many spaces before the column.
    pub fn after(self, gap: usize) -> Self {
        Self { gap, ..self }
    }

    /// Gives numbers so many decimals.
    pub fn digits(self, digits: usize) -> Self {
        Self { digits, ..self }
    }

    /// Writes a cell with the spaces around it.
    fn write(&self, cell: &TableCell, line: &mut String) {
        let text: Cow<'_, str> = match cell {
            TableCell::Text(text) => text.as_str().into(),
            TableCell::Number(number) => fixed(*number, self.digits).into(),
        };
        let spaces = |count: usize| std::iter::repeat_n(' ', count);
        let rest = self.width.saturating_sub(text.chars().count());
        line.extend(spaces(self.gap + if self.is_right { rest } else { 0 }));
        line.push_str(&text);
        line.extend(spaces(if self.is_right { 0 } else { rest }));
    }
}

/// The content of a cell.
#[derive(Debug, Clone, PartialEq)]
pub enum TableCell {
    /// A text.
    Text(String),
    /// A number, which gets the decimals of its column.
    Number(f64),
}

impl From<String> for TableCell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<&str> for TableCell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<usize> for TableCell {
    fn from(count: usize) -> Self {
        Self::Text(count.to_string())
    }
}

impl From<f64> for TableCell {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<Option<f64>> for TableCell {
    /// A number that is not there is a dash.
    fn from(number: Option<f64>) -> Self {
        number.map_or_else(|| "-".into(), Self::Number)
    }
}

/// A table of text, which is displayed without a line break at its end. No line ends with spaces.
#[derive(Debug)]
pub struct Table {
    indent: usize,
    columns: Vec<Column>,
    lines: Vec<String>,
}

impl Table {
    /// Begins a table without heads.
    pub fn new(columns: impl Into<Vec<Column>>) -> Self {
        Self { indent: 0, columns: columns.into(), lines: vec![] }
    }

    /// Begins a table with a line of heads.
    pub fn headed(columns: impl Into<Vec<Column>>) -> Self {
        Self::new(columns).with_heads()
    }

    /// Begins a table of names and values, two spaces from the left.
    pub fn of_pairs() -> Self {
        Self::new([Column::left("", NAMES), Column::text("")]).indented(2)
    }

    /// Puts so many spaces before each line that the table has and before each row that is added later; lines of text that are
    /// added later stay as they are.
    pub fn indented(mut self, indent: usize) -> Self {
        self.indent = indent;
        self.lines.iter_mut().for_each(|line| line.insert_str(0, &" ".repeat(indent)));
        self
    }

    /// Adds a line of the heads.
    pub fn with_heads(mut self) -> Self {
        let heads: Vec<TableCell> = self.columns.iter().map(|column| column.head.as_ref().into()).collect();
        self.row(heads);
        self
    }

    /// Adds a row, which may have fewer cells than there are columns.
    pub fn row(&mut self, cells: impl IntoIterator<Item = TableCell>) {
        let mut line = " ".repeat(self.indent);
        self.columns.iter().zip(cells).for_each(|(column, cell)| column.write(&cell, &mut line));
        self.line(&line);
    }

    /// Adds a row of a table of names and values.
    pub fn pair(&mut self, name: &str, value: impl Into<TableCell>) {
        self.row([name.into(), value.into()]);
    }

    /// Adds a line of text, as it is.
    pub fn line(&mut self, text: &str) {
        self.lines.push(text.trim_end_matches(' ').to_owned());
    }

    /// Returns whether there is no line.
    pub fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.lines.join("\n"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_stand_in_their_columns_and_no_line_ends_with_spaces() {
        let columns =
            [Column::left("name", 6), Column::right("µm", 7).digits(2), Column::text("note").after(2)];
        let mut table = Table::headed(columns).indented(1);
        table.row(["a".into(), 1.0.into(), "first".into()]);
        table.line("Group");
        table.row(["longer".into(), (-1e-9).into(), "".into()]);
        table.row(["too long".into(), None.into()]);
        let lines =
            [" name       µm  note", " a        1.00  first", "Group", " longer   0.00", " too long      -"];
        assert_eq!(table.to_string(), lines.join("\n"));
    }
}
