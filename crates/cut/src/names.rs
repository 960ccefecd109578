//! Names of facets: no two alike, even where a file repeats names.

use std::collections::HashMap;

/// Returns one name per facet, all different.
///
/// A name that occurs once stays. One that repeats is numbered from 1 in order ("star 1", "star 2"); numbers are
/// skipped where another facet has that very name.
pub(super) fn unique<'a>(names: impl Iterator<Item = &'a str> + Clone) -> Vec<String> {
    let mut occurrences: HashMap<&str, usize> = HashMap::new();
    for name in names.clone() {
        *occurrences.entry(name).or_default() += 1;
    }
    let alone = |name: &str| occurrences.get(name) == Some(&1);
    let mut last: HashMap<&str, usize> = HashMap::new();
    let name_one = |name: &'a str| {
        while !alone(name) {
            let number = last.entry(name).or_default();
            *number += 1;
            let numbered = format!("{name} {number}");
            if !alone(&numbered) {
                return numbered;
            }
        }
        name.to_owned()
    };
    names.map(name_one).collect()
}

/// Returns the name of a tier, given the name of one of its facets: the name without its number.
pub fn tier_stem(name: &str) -> &str {
    match name.rsplit_once(' ') {
        Some((stem, number)) if number.chars().all(|c| c.is_ascii_digit()) => stem,
        _ => name,
    }
}

/// The longest name, in characters, so that it fits on a line.
const LONGEST: usize = 200;

/// Returns whether a name can be shown anywhere: it is not blank, not too long, and without control characters, which
/// XML cannot hold.
pub fn is_printable(name: &str) -> bool {
    !name.trim().is_empty()
        && name.chars().count() <= LONGEST
        && !name.contains(|c: char| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}'))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn named(names: &[&str]) -> Vec<String> {
        unique(names.iter().copied())
    }

    #[test]
    fn a_repeated_name_is_numbered_and_a_single_one_stays() {
        let names = named(&["table", "star", "star", "culet", "star"]);
        assert_eq!(names, ["table", "star 1", "star 2", "culet", "star 3"]);
    }

    #[test]
    fn a_number_that_is_taken_is_passed_over() {
        assert_eq!(named(&["star", "star 1", "star"]), ["star 2", "star 1", "star 3"]);
        let nested = named(&["a", "a 1", "a", "a 1"]);
        assert_eq!(nested, ["a 1", "a 1 1", "a 2", "a 1 2"]);
    }

    #[test]
    fn blanks_and_control_characters_are_no_names() {
        assert!(is_printable("Étoile 3"));
        assert!(is_printable(&"É".repeat(LONGEST)) && !is_printable(&"e".repeat(LONGEST + 1)));
        assert!(!["", "  ", "a\u{1}", "a\nb", "\u{ffff}"].iter().any(|name| is_printable(name)));
    }

    proptest! {
        #[test]
        fn all_names_differ(names in prop::collection::vec("[ab]( [12]){0,2}", 0..40)) {
            let unique = unique(names.iter().map(String::as_str));
            let different: std::collections::HashSet<_> = unique.iter().collect();
            prop_assert_eq!(different.len(), names.len());
        }
    }
}
