//! Numbers of mesh files in text: as people and their programs write them, and as Fortran does.

use crate::numbers::NumberReader;
use brillianteer_base::Fault;

/// The most characters of a token that a message quotes.
const QUOTED: usize = 40;

/// Reads the number of a line's token. It may be infinite or NaN.
///
/// # Errors
/// Fails where the token is no number; the error says so and has the line.
pub(super) fn number(numbers: &mut NumberReader, text: &str, line: usize) -> Result<f64, Fault> {
    if let Some(number) = numbers.read(text, line)? {
        return Ok(number);
    }
    // Fortran marks the exponent by a D.
    let number = text.replace(['d', 'D'], "e").parse();
    number.map_err(|_| Fault::line(line, format!("'{text:.QUOTED$}' is not a number")))
}
