//! NumberReader of text formats, with a decimal point, or with the decimal comma that some programs write in some countries.

use crate::io::file_error::Fault;
use crate::io::numbers::Token;

/// The most characters of a token that a message quotes.
const QUOTED: usize = 40;

/// A reader of numbers, which counts those with a decimal comma.
#[derive(Debug, Default)]
pub(super) struct NumberReader {
    /// The first number with a decimal comma, the line where it stands, and how many there are.
    commas: Option<(String, usize, usize)>,
}

impl NumberReader {
    /// Reads the number of a line's token. It may be infinite or NaN.
    ///
    /// # Errors
    /// Fails where the token is no number; the error says so and has the line.
    pub fn read(&mut self, text: &str, line: usize) -> Result<f64, Fault> {
        match Token::of(text) {
            Token::Number(number) => Ok(number),
            Token::WithComma(number) => {
                self.commas.get_or_insert_with(|| (text.to_owned(), line, 0)).2 += 1;
                Ok(number)
            }
            Token::Broken => Err(Fault::line(
                line,
                format!(
                    "'{text:.QUOTED$}' is not a number; write a decimal point, and blanks between numbers"
                ),
            )),
            // Fortran marks the exponent by a D.
            Token::Word => match text.replace(['d', 'D'], "e").parse() {
                Ok(number) => Ok(number),
                Err(_) => Err(Fault::line(line, format!("'{text:.QUOTED$}' is not a number"))),
            },
        }
    }

    /// Returns the warning about decimal commas, if there were any.
    pub fn warning(&self) -> Option<String> {
        let (first, line, count) = self.commas.as_ref()?;
        let number = first.replace(',', ".");
        let others = match count - 1 {
            0 => String::new(),
            1 => ", and so is one more number".to_owned(),
            others => format!(", and so are {others} more numbers"),
        };
        Some(format!(
            "line {line}: '{first}' has a decimal comma and is read as {number}{others}; write decimal points"
        ))
    }
}
