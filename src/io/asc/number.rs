//! Numbers of a GemCad text file. The format has decimal points; some programs write the decimal comma of their country.

/// The kind of a token: a number in one of its spellings, or a word.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::io) enum Token {
    /// A number as the format has it.
    Number(f64),
    /// Digits, one comma and digits: a number with a decimal comma, or two numbers.
    WithComma(f64),
    /// Digits with commas and points in another order, such as two points.
    Broken,
    /// Text that is not meant as a number.
    Word,
}

impl Token {
    pub fn of(text: &str) -> Self {
        if let Ok(number) = text.parse() {
            return Self::Number(number);
        }
        let is_numeric = |c: char| c.is_ascii_digit() || matches!(c, ',' | '.' | '+' | '-');
        if !((text.contains(',') || text.matches('.').count() > 1)
            && text.contains(|c: char| c.is_ascii_digit())
            && text.chars().all(is_numeric))
        {
            return Self::Word;
        }
        let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
        let is_whole = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
        let has_one = digits.split_once(',').is_some_and(|(whole, part)| is_whole(whole) && is_whole(part));
        let number = text.replacen(',', ".", 1).parse().ok().filter(|_| has_one);
        number.map_or(Self::Broken, Self::WithComma)
    }

    /// Returns the value of a number, also with a decimal comma; `None` for any other token.
    pub fn number(self) -> Option<f64> {
        match self {
            Self::Number(number) | Self::WithComma(number) => Some(number),
            Self::Broken | Self::Word => None,
        }
    }

    /// Returns whether the token has the shape of a number, even if its value cannot be read.
    pub fn is_numeric(self) -> bool {
        self != Self::Word
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_comma_between_digits_is_a_decimal_comma_and_nothing_else_is() {
        assert_eq!(Token::of("-41.5"), Token::Number(-41.5));
        assert_eq!(Token::of("-41,5"), Token::WithComma(-41.5));
        assert_eq!(Token::of("0,65000"), Token::WithComma(0.65));
        for broken in ["41,5,2", "41.5,0.65", ",5", "41,", "--1,5", "1,-5", "1.234,5", "-42.5.0", "1.2.3"] {
            assert_eq!(Token::of(broken), Token::Broken, "{broken}");
        }
        for word in ["", ",", "..", "P1,2", "1-2", "x", "n"] {
            assert_eq!(Token::of(word), Token::Word, "{word}");
        }
    }
}
