//! The known name that somebody may have meant.

/// Returns the known name that is most like an unknown one, if a few slips of typing make the one from the other.
pub fn nearest<'k>(asked: &str, known: &[&'k str]) -> Option<&'k str> {
    known
        .iter()
        .copied()
        .filter_map(|name| Some((slips(asked, name)?, name)))
        .min_by_key(|(slips, _)| *slips)
        .map(|(_, name)| name)
}

/// Returns the number of slips of typing that make one name of another: letters that are missing, added, wrong or swapped. `None`
/// if there are so many that it is another word.
pub fn slips(asked: &str, name: &str) -> Option<usize> {
    // Two slips in five letters are still slips.
    let letters = asked.chars().count();
    let most = (2 * letters / 5).min(3);
    // Names of very different lengths are not compared, since the asked one may be as long as a file.
    let is_alike = name.chars().count().abs_diff(letters) <= most;
    is_alike.then(|| strsim::damerau_levenshtein(asked, name)).filter(|slips| *slips <= most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_is_one_that_a_few_slips_make_of_what_was_asked() {
        let known = ["row", "ring", "parcel", "round_brilliant"];
        let pairs = [("rig", Some("ring")), ("raw", Some("row")), ("prcael", Some("parcel"))];
        for (asked, near) in pairs.into_iter().chain([
            ("round_brlint", Some("round_brilliant")),
            ("rings", Some("ring")),
            ("pin", None),
            ("ro", None),
            ("rain", None),
        ]) {
            assert_eq!(nearest(asked, &known), near, "{asked}");
        }
        assert_eq!((nearest("round", &known), nearest("", &known), nearest("row", &[])), (None, None, None));
    }
}
