//! Numbers in text that people and their programs wrote: with the decimal comma of a country, the signs of a printed
//! manual, or the digits of a wide script.

use brillianteer_base::Fault;
use std::borrow::Cow;

/// The kind of a token: a number in one of its spellings, or a word.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Token {
    /// A number with a decimal point, or without one.
    Number(f64),
    /// Digits, one comma and digits: a number with a decimal comma, or two numbers.
    WithComma(f64),
    /// Digits with commas and points in another order, such as two points.
    Broken,
    /// Text that is not meant as a number.
    Word,
}

/// Returns the character of ASCII that a character of a number stands for; `None` for one that is not seen.
fn plain(c: char) -> Option<char> {
    match c {
        // The minus sign, hyphens and dashes of printed text, and the hyphen that shows only at the end of a line.
        '\u{2010}'..='\u{2015}'
        | '\u{2212}'
        | '\u{2796}'
        | '\u{fe58}'
        | '\u{fe63}'
        | '\u{ff0d}'
        | '\u{ad}' => Some('-'),
        '\u{ff0b}' => Some('+'),
        '\u{ff0e}' => Some('.'),
        '\u{ff0c}' | '\u{66b}' => Some(','),
        '\u{ff10}'..='\u{ff19}' => char::from_digit(u32::from(c) - 0xff10, 10),
        '\u{660}'..='\u{669}' => char::from_digit(u32::from(c) - 0x660, 10),
        '\u{6f0}'..='\u{6f9}' => char::from_digit(u32::from(c) - 0x6f0, 10),
        '\u{200b}'..='\u{200f}' | '\u{2060}' | '\u{feff}' => None,
        c => Some(c),
    }
}

/// Returns a token with the characters of ASCII that its characters stand for, so that it can be read as a number.
pub(super) fn in_ascii(text: &str) -> Cow<'_, str> {
    if text.is_ascii() { Cow::Borrowed(text) } else { text.chars().filter_map(plain).collect() }
}

impl Token {
    pub fn of(text: &str) -> Self {
        let text = in_ascii(text);
        let text = text.strip_suffix(['°', 'º']).unwrap_or(&text);
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

/// The most characters of a token that a message quotes.
const QUOTED: usize = 40;

/// A reader of the numbers of a file, which counts those with a decimal comma for one warning about all of them.
#[derive(Debug, Default)]
pub(super) struct NumberReader {
    /// The first number with a comma, and its line.
    first: Option<(String, usize)>,
    count: usize,
}

impl NumberReader {
    /// Reads the number of a line's token, also with a decimal comma; `None` where it is no number. It may be infinite or
    /// NaN.
    ///
    /// # Errors
    /// Fails where the token is meant as a number and has no clear value; the error has the line.
    pub fn read(&mut self, text: &str, line: usize) -> Result<Option<f64>, Fault> {
        match Token::of(text) {
            Token::Number(number) => Ok(Some(number)),
            Token::WithComma(number) => {
                self.first.get_or_insert_with(|| (text.to_owned(), line));
                self.count += 1;
                Ok(Some(number))
            }
            Token::Broken => {
                let problem = format!(
                    "'{text:.QUOTED$}' is not a number; write a decimal point, and blanks between numbers"
                );
                Err(Fault::line(line, problem))
            }
            Token::Word => Ok(None),
        }
    }

    /// Returns the warning about decimal commas, if there were any.
    pub fn warning(&self) -> Option<String> {
        let (first, line) = self.first.as_ref()?;
        let number = in_ascii(first).replace(',', ".");
        let others = match self.count - 1 {
            0 => String::new(),
            1 => ", and so is one more number".to_owned(),
            others => format!(", and so are {others} more numbers"),
        };
        Some(format!(
            "line {line}: '{first}' has a decimal comma and is read as {number}{others}; write decimal points"
        ))
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
        for word in ["", ",", "..", "P1,2", "1-2", "x", "n", "−", "–n", "١x"] {
            assert_eq!(Token::of(word), Token::Word, "{word}");
        }
    }

    #[test]
    fn numbers_are_read_with_the_signs_and_digits_of_print_and_of_wide_scripts() {
        for minus in "-−–—‒‐‑―﹣－\u{ad}".chars() {
            assert_eq!(Token::of(&format!("{minus}41.5")), Token::Number(-41.5), "{minus:?}");
        }
        for text in ["４１．５", "41.5°", "＋41.5", "\u{200e}41.5", "41.5\u{200b}"] {
            assert_eq!(Token::of(text), Token::Number(41.5), "{text}");
        }
        for text in ["４１，５", "٤١٫٥", "۴۱٫۵"] {
            assert_eq!(Token::of(text), Token::WithComma(41.5), "{text}");
        }
    }
    #[test]
    fn one_warning_speaks_of_all_decimal_commas() {
        let warning = |tokens: &[&str]| {
            let mut numbers = NumberReader::default();
            let mut read = |text: &&str| numbers.read(text, 3).unwrap();
            assert!(tokens.iter().all(|text| read(text).is_some()), "{tokens:?}");
            numbers.warning().unwrap_or_default()
        };
        assert_eq!(warning(&["1.5", "2"]), "");
        for (tokens, others) in [
            (&["0", "４１，５"][..], ""),
            (&["４１，５", "1,5"], ", and so is one more number"),
            (&["４１，５", "1,5", "-2,25"], ", and so are 2 more numbers"),
        ] {
            let start = "line 3: '４１，５' has a decimal comma and is read as 41.5";
            assert_eq!(warning(tokens), format!("{start}{others}; write decimal points"));
        }
        let mut numbers = NumberReader::default();
        let broken = numbers.read("1,2,3", 7).unwrap_err();
        assert_eq!((broken.line, broken.problem.contains("'1,2,3' is not a number")), (Some(7), true));
        assert_eq!((numbers.read("word", 7).unwrap(), numbers.warning()), (None, None));
    }
}
