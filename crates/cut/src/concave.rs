//! Concave facets: finds them in the texts of cutters' files.
//!
//! Concave facets are ground with a mandrel after the flat ones. No cutters' format that the program reads has a
//! field for their shape, so a design whose texts name them is made of its flat facets, with a warning.

use super::frosting::words;
use super::tiers::Tiers;

/// The most characters of a text that a message quotes.
const QUOTED: usize = 60;

/// Words that cancel the next word.
const NOT: [&str; 4] = ["no", "non", "not", "without"];

/// Returns whether a text names concave facets, or the mandrel that cuts them.
fn names_concave(text: &str) -> bool {
    let words: Vec<String> = words(text).collect();
    let is_denied = |at: usize| at > 0 && NOT.contains(&words[at - 1].as_str());
    words
        .iter()
        .enumerate()
        .any(|(at, word)| (word.starts_with("concav") || word.starts_with("mandrel")) && !is_denied(at))
}

impl Tiers {
    /// Returns a warning where instructions, headers or footers name concave facets; `None` where no text does.
    pub fn concave_warning(&self) -> Option<String> {
        let cut = (1..).zip(self.names()).zip(&self.tiers).filter(|(_, tier)| tier.is_cut);
        let named = cut
            .filter(|(_, tier)| names_concave(&tier.instructions))
            .map(|((number, name), tier)| format!("tier {number} ({name}) '{}'", quoted(&tier.instructions)));
        let texts = self.headers.iter().chain(&self.footers).filter(|text| names_concave(text));
        let places: Vec<String> = named.chain(texts.map(|text| format!("'{}'", quoted(text)))).collect();
        let (first, others) = places.split_first()?;
        let more = if others.is_empty() { String::new() } else { format!(" and {} more", others.len()) };
        Some(format!(
            "concave facets are named, whose shape the file does not hold: {first}{more}; they are flat here, so pictures, measures \
             of light and the weight are those of the stone before they are ground"
        ))
    }
}

/// Returns the beginning of a text, as long as fits into a message.
fn quoted(text: &str) -> String {
    text.trim().chars().take(QUOTED).collect()
}

#[cfg(test)]
mod tests {
    use super::super::tiers::{Indexed, Tier};
    use super::*;

    fn design(instructions: &str, header: &str, footer: &str) -> Tiers {
        let tier = Tier {
            angle: -42.0,
            distance: 1.0,
            instructions: instructions.to_owned(),
            meet: None,
            is_cut: true,
            frosting: 0.0,
            facets: vec![Indexed { index: 0.0, name: "P1".to_owned() }],
        };
        let lines = |text: &str| vec![text.to_owned()];
        Tiers {
            gear: 96,
            tiers: vec![tier],
            headers: lines(header),
            footers: lines(footer),
            ..Tiers::default()
        }
    }

    #[test]
    fn instructions_headers_and_footers_that_name_concave_facets_are_warned_of() {
        for (texts, place) in [
            (["concave, 17mm mandrel", "", ""], "tier 1 (P1) 'concave, 17mm mandrel'"),
            (["", "Oval, CONCAVE crown", ""], "'Oval, CONCAVE crown'"),
            (["", "", "Use a 12 mm mandrel."], "'Use a 12 mm mandrel.'"),
            (["Concaved", "", "Concave facets last"], "tier 1 (P1) 'Concaved' and 1 more"),
        ] {
            let warning = design(texts[0], texts[1], texts[2]).concave_warning().unwrap();
            assert!(warning.contains(place) && warning.contains("flat here, so pictures"), "{warning}");
        }
    }

    #[test]
    fn other_texts_and_tiers_that_are_not_cut_are_not_warned_of() {
        for text in ["Meet P1-G1", "No concave facets", "non-concave version", "convex", ""] {
            assert_eq!(design(text, text, text).concave_warning(), None, "{text}");
        }
        let mut muted = design("concave, 17mm mandrel", "", "");
        muted.tiers[0].is_cut = false;
        assert_eq!(muted.concave_warning(), None);
    }
}
