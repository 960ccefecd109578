//! Numbers as texts. Every number that people read is written by one of these functions, so that none prints as -0.

/// Returns a number as people write it, with an exponent instead of hundreds of digits.
pub fn as_written(number: f64) -> String {
    // Of 0, the sign says nothing.
    let (number, size) = (number + 0.0, number.abs());
    if number == 0.0 || (1e-4..1e7).contains(&size) { format!("{number}") } else { format!("{number:e}") }
}

/// Formats a number with so many decimals, without zeros at its end and without the sign of a number that is rounded to 0.
pub fn rounded(number: f64, decimals: usize) -> String {
    let text = fixed(number, decimals);
    let text = if decimals > 0 { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    text.to_owned()
}

/// Formats a number with this many decimals, without the sign of a number that is rounded to 0.
pub fn fixed(number: f64, decimals: usize) -> String {
    without_sign_of_zero(format!("{number:.decimals$}"))
}

/// Formats a difference with this many decimals and its sign; one that is rounded to 0 has none.
pub fn signed(difference: f64, decimals: usize) -> String {
    without_sign_of_zero(format!("{difference:+.decimals$}"))
}

/// Returns the text of a number without its sign where all its digits are 0.
fn without_sign_of_zero(text: String) -> String {
    let is_zero = text.bytes().all(|byte| matches!(byte, b'+' | b'-' | b'0' | b'.'));
    if is_zero { text.trim_start_matches(['+', '-']).to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_no_zeros_at_their_end_and_no_digits_beyond_the_decimals() {
        let texts = [(15.600000000000001, 4), (80.0, 4), (-1e-9, 4), (100.0, 0), (0.00005, 4)];
        assert_eq!(
            texts.map(|(number, decimals)| rounded(number, decimals)),
            ["15.6", "80", "0", "100", "0.0001"]
        );
    }

    #[test]
    fn a_number_that_is_rounded_to_zero_has_no_sign() {
        let numbers = [-1e-9, -0.0, 0.0, 4e-5, -0.0001, 2.0, f64::INFINITY];
        assert_eq!(
            numbers.map(|number| fixed(number, 4)),
            ["0.0000", "0.0000", "0.0000", "0.0000", "-0.0001", "2.0000", "inf"]
        );
        assert_eq!(
            numbers.map(|number| signed(number, 4)),
            ["0.0000", "0.0000", "0.0000", "0.0000", "-0.0001", "+2.0000", "+inf"]
        );
        assert_eq!([fixed(-0.4, 0), signed(-0.4, 0), rounded(-0.4, 0)], ["0", "0", "0"]);
    }
}
