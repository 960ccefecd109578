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

/// The least bound that [`at_most`] writes.
const LEAST_BOUND: f64 = 1e-6;

/// Formats the size of a bound or an error as a plain decimal with two significant digits, rounded up; one below a millionth as a
/// millionth, and one that is no number as `unknown`.
pub fn at_most(bound: f64) -> String {
    if !bound.is_finite() {
        return "unknown".to_owned();
    }
    let size = bound.abs().max(LEAST_BOUND);
    // Behind the second digit; rounding must not raise a number of two digits.
    let decimals = (1.0 - size.log10().floor()).max(0.0);
    let step = 10f64.powf(decimals);
    rounded((size * step * (1.0 - 1e-12)).ceil() / step, decimals as usize)
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
    fn a_bound_is_a_plain_decimal_that_is_never_too_small() {
        let bounds = [0.0012, 0.00121, 2.8e-3, 9.97e-4, 0.35, 1.0, 17.2, 8.6e-9, 0.0];
        assert_eq!(
            bounds.map(at_most),
            ["0.0012", "0.0013", "0.0028", "0.001", "0.35", "1", "18", "0.000001", "0.000001"]
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
