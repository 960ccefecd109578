//! The pick of the corners that a tier is to pass through: one, two or three, one click after the other.

use glam::DVec3;

/// A pick in progress.
#[derive(Debug, Clone, PartialEq)]
pub struct MeetPick {
    /// The place of the tier.
    pub place: usize,
    /// How many corners are wanted, 1 to 3: one gives the distance, two the angle too, three the index too.
    pub wanted: usize,
    /// The corners that have been picked, in the design's unit: fewer than are wanted.
    pub corners: Vec<DVec3>,
}

impl MeetPick {
    /// Begins a pick of so many corners.
    pub fn new(place: usize, wanted: usize) -> Self {
        Self { place, wanted, corners: vec![] }
    }

    /// Whether one more corner completes the pick.
    pub fn is_last(&self) -> bool {
        self.corners.len() + 1 >= self.wanted
    }

    /// Returns the pick with a corner picked, or taken back where it was picked already.
    pub fn toggled(&self, corner: DVec3) -> Self {
        let mut next = self.clone();
        match next.corners.iter().position(|picked| *picked == corner) {
            Some(place) => drop(next.corners.remove(place)),
            None => next.corners.push(corner),
        }
        next
    }

    /// Returns the pick without the corner that was picked last; `None` where none was, which ends the pick.
    pub fn undone(&self) -> Option<Self> {
        let mut before = self.clone();
        before.corners.pop()?;
        Some(before)
    }

    /// Says what a click does, and how many corners are left.
    pub fn words(&self) -> String {
        let left = self.wanted - self.corners.len().min(self.wanted);
        match (self.wanted, self.corners.len()) {
            (..=1, _) => "Click a corner to cut the tier there; Escape ends this.".to_owned(),
            (2, 0) => "Click two corners: the tier passes through both, and its angle follows; Escape ends this.".to_owned(),
            (_, 0) => "Click three corners: the tier passes through all, and its angle and index follow; Escape ends this."
                .to_owned(),
            (wanted, picked) => format!(
                "{} of {} corners picked, {} to go. Undo, or a click on a picked one, takes it back; Escape ends this.",
                in_words(picked),
                in_words(wanted).to_lowercase(),
                in_words(left).to_lowercase()
            ),
        }
    }
}

fn in_words(count: usize) -> &'static str {
    ["None", "One", "Two", "Three"].get(count).copied().unwrap_or("Several")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_corner_that_is_picked_twice_is_taken_back_and_the_count_is_said() {
        let pick = MeetPick::new(4, 3);
        assert!(pick.words().starts_with("Click three corners") && !pick.is_last());
        let one = pick.toggled(DVec3::X);
        assert!(one.words().starts_with("One of three corners picked, two to go."), "{}", one.words());
        let two = one.toggled(DVec3::Y);
        assert!(two.is_last() && two.words().starts_with("Two of three corners picked, one to go."));
        assert_eq!(two.toggled(DVec3::Y), one);
        assert_eq!(one.toggled(DVec3::X), pick);
    }

    #[test]
    fn undo_takes_back_the_corner_that_was_picked_last_and_then_ends_the_pick() {
        let pick = MeetPick::new(4, 3);
        let two = pick.toggled(DVec3::X).toggled(DVec3::Y);
        assert_eq!(two.undone(), Some(pick.toggled(DVec3::X)));
        assert_eq!(two.undone().and_then(|one| one.undone()), Some(pick.clone()));
        assert_eq!(pick.undone(), None);
    }
}
