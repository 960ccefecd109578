//! The patterns that may hang behind stones, by name.

/// The width of a pattern behind a picture, in widths of the picture: the stones also bend light in from beside it.
pub const PATTERN_SPAN: f64 = 2.0;

/// A background that the program draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pattern {
    /// A page of text with pictures.
    Page,
    /// Fine lines, of one colour across and of another down.
    Grid,
    /// Black squares, as on a chessboard.
    Checks,
    /// Black and white stripes that run across.
    Stripes,
    /// Black discs in rows.
    Dots,
    /// A white line across a dark field, as in a spectroscope.
    Slit,
}

impl Pattern {
    /// The patterns with their names.
    pub const NAMES: [(&str, Self); 6] = [
        ("page", Self::Page),
        ("grid", Self::Grid),
        ("checks", Self::Checks),
        ("stripes", Self::Stripes),
        ("dots", Self::Dots),
        ("slit", Self::Slit),
    ];

    /// Returns the pattern of this name; upper and lower case are the same.
    pub fn named(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, pattern)| *pattern)
    }

    /// Returns the pattern's name.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, pattern)| *pattern == self).map_or("", |(name, _)| name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_found_by_their_names() {
        for (name, pattern) in Pattern::NAMES {
            assert_eq!((Pattern::named(&name.to_uppercase()), pattern.name()), (Some(pattern), name));
        }
        assert_eq!(Pattern::named("pages"), None);
    }
}
