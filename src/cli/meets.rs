//! What `info --meets` and `convert --meets` have in common: a design with its meets, and where they come from.

use super::console::say;
use crate::cut::{Cut, Meet, SolvedTiers, TierOutcome, Tiers};
use serde_json::{Value, json};
use std::fmt::Write;

/// The largest change of a distance, in the design's unit, that is not worth a note: the last digit of most files.
const NOTED: f64 = 1e-5;

/// A design with all meets that are known of it.
pub struct KnownMeets<'a> {
    design: &'a Tiers,
    /// Where the meet of each tier comes from; empty where it has none.
    sources: Vec<&'static str>,
    met: Tiers,
    solved: SolvedTiers,
}

impl<'a> KnownMeets<'a> {
    /// Takes the meets that the file gives, that instructions state, and that the geometry shows, in this order; `None` for a
    /// design without tiers.
    pub fn of(cut: &'a Cut) -> Option<Self> {
        let Cut::Tiers(design) = cut else { return None };
        let stated = design.with_stated_meets();
        let met = stated.with_found_meets();
        let has = |tiers: &Tiers, place: usize| tiers.tiers[place].meet.is_some();
        let source = |place| match () {
            () if has(design, place) => "file",
            () if has(&stated, place) => "stated",
            () if has(&met, place) => "found",
            () => "",
        };
        let sources = (0..design.tiers.len()).map(source).collect();
        let solved = met.solved();
        Some(Self { design, sources, met, solved })
    }

    /// Returns the solved design with its meets, each also as an instruction where there was none. Prints a note for each tier
    /// that moves, and a warning for each meet that cannot be followed.
    pub fn followed(self, path: &str) -> Tiers {
        for place in 0..self.design.tiers.len() {
            let (before, after) =
                (self.design.tiers[place].distance, self.solved.tiers.tiers[place].distance);
            if (before - after).abs() > NOTED {
                let called = self.called(place);
                say(&format!("note: {path}: {called}: the distance {before} becomes {after:.7}"));
            }
        }
        self.solved.errors().for_each(|error| say(&format!("warning: {path}: {error}")));
        self.solved.tiers
    }

    fn called(&self, place: usize) -> String {
        let tier = &self.design.tiers[place];
        let number = place + 1;
        if tier.name().is_empty() {
            format!("tier {number}")
        } else {
            format!("tier {number} '{}'", tier.name())
        }
    }

    /// Returns one object for each tier.
    pub fn json(&self) -> Value {
        let tier = |place: usize| {
            let (tier, solved) = (&self.design.tiers[place], &self.solved.tiers.tiers[place]);
            let (outcome, error) = match &self.solved.outcomes[place] {
                TierOutcome::Kept => ("kept", None),
                TierOutcome::Sets => ("sets", None),
                TierOutcome::Solved => ("solved", None),
                TierOutcome::Failed(error) => ("failed", Some(error.fault.to_string())),
            };
            json!({
                "tier": place + 1,
                "name": tier.name(),
                "instructions": tier.instructions,
                "meet": self.met.tiers[place].meet.as_ref().map(Meet::to_string),
                "source": self.sources[place],
                "choices": self.solved.choices[place],
                "outcome": outcome,
                "error": error,
                "angle": solved.angle,
                "distance": tier.distance,
                "solved": solved.distance,
            })
        };
        (0..self.design.tiers.len()).map(tier).collect()
    }

    /// Returns the rows of a table, each with a line break before it.
    pub fn table(&self) -> String {
        let mut text = format!(
            "\n\n  {:<14}{:>12}{:>12}{:>13}  {:<8}meet",
            "tier", "distance", "solved", "difference", "source"
        );
        for (place, tier) in self.design.tiers.iter().enumerate() {
            let name = if tier.name().is_empty() { (place + 1).to_string() } else { tier.name().to_owned() };
            let meet = self.met.tiers[place].meet.as_ref().map_or_else(|| "-".to_owned(), Meet::to_string);
            // Rounded first, so that a tiny negative number does not print as -0.000000.
            let solved = self.solved.tiers.tiers[place].distance;
            let (solved, difference) = match &self.solved.outcomes[place] {
                TierOutcome::Solved => (
                    format!("{solved:.6}"),
                    format!("{:.6}", ((solved - tier.distance) * 1e6).round() / 1e6 + 0.0),
                ),
                TierOutcome::Failed(_) => ("failed".to_owned(), String::new()),
                TierOutcome::Kept | TierOutcome::Sets => ("given".to_owned(), String::new()),
            };
            let source = self.sources[place];
            let ambiguous = match self.solved.choices[place] {
                0 | 1 => String::new(),
                choices => format!(" (ambiguous: {choices} corners fit these names)"),
            };
            let _ = write!(
                text,
                "\n  {name:<14}{:>12.6}{solved:>12}{difference:>13}  {source:<8}{meet}{ambiguous}",
                tier.distance
            );
        }
        for error in self.solved.errors() {
            let _ = write!(text, "\n  {error}");
        }
        text
    }
}
