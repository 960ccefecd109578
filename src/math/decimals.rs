//! Numbers as texts.

/// Formats a number with so many decimals, without zeros at its end and without the sign of a number that is rounded to 0.
pub fn rounded(number: f64, decimals: usize) -> String {
    let text = format!("{number:.decimals$}");
    let text = if decimals > 0 { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
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
}
