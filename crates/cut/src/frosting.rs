//! Frosted facets: the degree of frosting, and its wording in cutters' texts.
//!
//! No cutters' text format has a field for the finish of a facet; cutters write it into the instructions of a tier
//! ("Leave frosted"). Only wordings that plainly mean the tier's own facets are read: see [`FinishNote`]. They are
//! those of real files, which docs/formats.md lists.

use std::borrow::Cow;

/// The frosting of a facet for which a file states no number: the one that Gem Cut Studio writes.
pub const USUAL_FROSTING: f64 = 0.5;

/// The range of the frosting of facets: 0 polished, 1 as rough as possible.
pub const FROSTINGS: std::ops::RangeInclusive<f64> = 0.0..=1.0;

/// The words beside the finish in a clause that speaks of all facets of its tier.
const PLAIN: &[&str] = &[
    "a",
    "all",
    "also",
    "are",
    "at",
    "bands",
    "be",
    "cone",
    "cut",
    "facet",
    "facets",
    "finish",
    "for",
    "grit",
    "is",
    "it",
    "keep",
    "lap",
    "leave",
    "left",
    "long",
    "on",
    "remain",
    "remains",
    "rim",
    "short",
    "stationary",
    "step",
    "the",
    "these",
    "this",
    "tier",
    "to",
    "with",
];

/// The statement of a text about the finish of the facets of its tier.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FinishNote {
    /// No statement.
    Unsaid,
    /// All facets of the tier have this frosting, 0 for polished.
    Frosting(f64),
    /// Some facets are frosted, but not plainly those of the tier.
    Unclear,
}

impl FinishNote {
    /// Reads the instructions of a tier. Of several plain clauses the last one counts.
    pub fn of(instructions: &str) -> Self {
        let clauses = instructions.split_inclusive([';', ',', ':', '(', ')', '!', '\n', '.']);
        let mut clause = String::new();
        let mut found = Self::Unsaid;
        for part in clauses {
            clause.push_str(part);
            // The point of a number ends no clause; a blank follows a point that does.
            let ends_in_point = clause.ends_with('.');
            let rest = &instructions[part.as_ptr() as usize - instructions.as_ptr() as usize + part.len()..];
            if ends_in_point && rest.starts_with(|c: char| !c.is_whitespace()) {
                continue;
            }
            found = found.then(Self::of_clause(&clause));
            clause.clear();
        }
        found.then(Self::of_clause(&clause))
    }

    /// Returns whether a text that belongs to no tier, such as a header, names a frosted finish.
    pub fn is_named_in(text: &str) -> bool {
        words(text).any(|word| is_frosted(&word))
    }

    fn then(self, next: Self) -> Self {
        match (self, next) {
            (_, Self::Frosting(_)) | (Self::Unsaid, _) => next,
            _ => self,
        }
    }

    fn of_clause(clause: &str) -> Self {
        let words: Vec<String> = words(clause).collect();
        if let [only] = words.as_slice()
            && matches!(only.as_str(), "polish" | "polished")
        {
            return Self::Frosting(0.0);
        }
        let Some(at) = words.iter().position(|word| is_frosted(word)) else { return Self::Unsaid };
        let amount = words.get(at + 1).and_then(|word| word.parse().ok()).filter(|n| FROSTINGS.contains(n));
        let is_plain = |word: &String| {
            PLAIN.contains(&word.as_str())
                || is_frosted(word)
                || word.parse::<f64>().is_ok_and(|n| n >= 100.0)
        };
        let others = words.iter().enumerate().filter(|(k, _)| amount.is_none() || *k != at + 1);
        if others.map(|(_, word)| word).all(is_plain) {
            Self::Frosting(amount.unwrap_or(USUAL_FROSTING))
        } else {
            Self::Unclear
        }
    }
}

/// Returns the instructions of a tier with this frosting, with words that state it where they do not yet.
pub fn with_finish(instructions: Cow<'_, str>, frosting: f64) -> Cow<'_, str> {
    let said = match FinishNote::of(&instructions) {
        FinishNote::Frosting(said) => said,
        FinishNote::Unsaid | FinishNote::Unclear => 0.0,
    };
    if said == frosting {
        return instructions;
    }
    let finish = match frosting {
        0.0 => "Polished".to_owned(),
        USUAL_FROSTING => "Frosted".to_owned(),
        other => format!("Frosted {other}"),
    };
    let before = instructions.trim_end().trim_end_matches('.');
    Cow::Owned(if before.is_empty() { finish } else { format!("{before}. {finish}") })
}

/// Returns the words of a text in small letters, without signs around them.
pub(super) fn words(text: &str) -> impl Iterator<Item = String> {
    let bare = |word: &str| word.trim_matches(|c: char| !c.is_alphanumeric()).to_lowercase();
    text.split(|c: char| c.is_whitespace() || c == '-').map(bare).filter(|word| !word.is_empty())
}

fn is_frosted(word: &str) -> bool {
    // Old programs cut long lines, so "unpolished" may end early.
    matches!(word, "frost" | "frosted") || word.starts_with("unpolish")
}

#[cfg(test)]
mod tests {
    use super::*;
    use FinishNote::{Frosting, Unclear, Unsaid};
    use proptest::prelude::*;

    #[test]
    fn wordings_of_real_files_are_read_where_they_mean_their_tier() {
        for (text, expected) in [
            ("Frosted", Frosting(0.5)),
            ("Frost on stationary lap", Frosting(0.5)),
            ("Meet girdle, leave frosted", Frosting(0.5)),
            ("Meet e, b, 4. Frosted", Frosting(0.5)),
            ("MP 4,4 & 5,6, etc. Left frosted", Frosting(0.5)),
            ("Facets remain frosted. ", Frosting(0.5)),
            ("Unpolished.  Leave 1200 grit finish.", Frosting(0.5)),
            ("Unpolished long bands", Frosting(0.5)),
            ("Cut by eye to simulate laces. Unpolishe", Frosting(0.5)),
            ("Meet A-C-B.  Leave frosted", Frosting(0.5)),
            ("Frosted 0.25. Meet a", Frosting(0.25)),
            ("Leave frosted. Polished", Frosting(0.0)),
            ("Polish", Frosting(0.0)),
            ("Meet b, a. Leave remaining facets frosted", Unclear),
            ("Polish, but leave ouline of frosted F,G,H", Frosting(0.0)),
            ("Alternate facets unpolished", Unclear),
            ("Etching around star unpolished.", Unclear),
            ("Meet at girdle", Unsaid),
            ("", Unsaid),
        ] {
            assert_eq!(FinishNote::of(text), expected, "{text}");
        }
        assert!(FinishNote::is_named_in("PC 04.080 Frosted Rectangle"));
        assert!(!FinishNote::is_named_in("A polished defrosting"));
    }

    proptest! {
        #[test]
        fn any_finish_is_read_as_it_is_written(
            text in "(Meet a-b|Leave frosted|Frosted 0.3|Polish|[ -~]{0,30})[.;, ]{0,2}",
            frosting in prop_oneof![Just(0.0), Just(0.5), 0.0..=1.0_f64],
        ) {
            let written = with_finish(Cow::Borrowed(&text), frosting);
            let read = match FinishNote::of(&written) {
                Frosting(read) => read,
                Unsaid | Unclear => 0.0,
            };
            prop_assert_eq!(read, frosting, "{}", written);
            prop_assert_eq!(with_finish(written.clone(), frosting), written);
        }
    }
}
