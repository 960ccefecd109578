//! The number of the format that cut files and scene files are written in, which their key `format` gives.

use super::toml_text::TomlText;
use brillianteer_base::Fault;

/// The number of the format that this program reads and writes.
pub const FORMAT: i64 = 1;

/// Checks the key `format`. It is read before all else, since another format may have other keys.
pub(super) fn check_format(toml: &TomlText) -> Result<(), Fault> {
    let Some(value) = toml.get("format") else {
        let problem = format!("format: the key is missing; begin the file with `format = {FORMAT}`");
        return Err(Fault::line(1, problem));
    };
    let number = value.get_ref().as_integer().map(|n| i64::from_str_radix(n.as_str(), n.radix()));
    let problem = match number {
        Some(Ok(FORMAT)) => return Ok(()),
        Some(Ok(other)) => format!("format: {other} is not known here, only {FORMAT}; update the program"),
        _ => format!("format: a whole number is expected, `format = {FORMAT}`"),
    };
    Err(Fault::line(toml.line(value), problem))
}
