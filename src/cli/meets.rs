//! The meets of a design and their origins, for `info --meets` and `convert --meets`.

use super::console::say;
use brillianteer_cut::{Cut, Meet, SolvedTiers, TierOutcome, Tiers};
use brillianteer_files::as_tiers;
use brillianteer_math::fixed;
use brillianteer_scene::Specimen;
use serde_json::{Value, json};
use std::borrow::Cow;
use std::fmt::Write;

/// The largest change of a distance, in the design's unit, that causes no note: the last digit of most files.
const NOTED: f64 = 1e-5;

/// The largest change of an angle, degrees, that causes no note.
const NOTED_DEG: f64 = 1e-3;

/// A design with all its known meets.
pub struct KnownMeets<'a> {
    design: Cow<'a, Tiers>,
    /// The origin of each tier's meet; empty where the tier has none.
    sources: Vec<&'static str>,
    /// The design with all meets, and with the names by which they call its tiers.
    met: Tiers,
    /// The names of the tiers.
    names: Vec<String>,
    solved: SolvedTiers,
}

impl<'a> KnownMeets<'a> {
    /// Takes the meets that the file gives, that instructions state, and that the geometry shows, in this order, and names the
    /// tiers. A stone that is not cut by tiers is turned into tiers first; `None` for a body that is no convex stone between planes.
    pub fn of(specimen: &'a Specimen) -> Option<Self> {
        let design = match &specimen.design.cut {
            Cut::Tiers(tiers) => Cow::Borrowed(tiers),
            _ => Cow::Owned(as_tiers(specimen)?),
        };
        let stated = design.with_stated_meets().with_names_in_meets();
        let (met, solved) = stated.with_found_meets_followed();
        let has = |tiers: &Tiers, place: usize| tiers.tiers[place].meet.is_some();
        let source = |place| match () {
            () if has(&design, place) => "file",
            () if has(&stated, place) => "stated",
            () if has(&met, place) => "found",
            () => "",
        };
        let sources = (0..design.tiers.len()).map(source).collect();
        Some(Self { design, sources, names: met.names(), met, solved })
    }

    /// Returns whether the stone was turned into tiers.
    fn is_turned(&self) -> bool {
        matches!(self.design, Cow::Owned(_))
    }

    /// Says that the stone was turned into tiers, how many have a meet, and which have indices between teeth; nothing for a
    /// stone that tiers cut.
    pub fn say_turned(&self, path: &str) {
        if !self.is_turned() {
            return;
        }
        let (all, met) =
            (self.sources.len(), self.sources.iter().filter(|source| !source.is_empty()).count());
        say(&format!(
            "note: {path}: turned into {all} tiers; {met} have a meet, the others keep their distance"
        ));
        let between = self.met.between_teeth();
        if !between.is_empty() {
            let (gear, names) = (self.design.gear.abs(), between.join(", "));
            say(&format!("note: {path}: indices lie between the teeth of the gear of {gear}: {names}"));
        }
    }

    /// Returns the solved design with its meets, each also as an instruction where there was none, or one that states another. Prints a note for each tier
    /// that moves, and a warning for each meet that cannot be followed.
    pub fn followed(self, path: &str) -> Tiers {
        for (place, (before, after)) in self.design.tiers.iter().zip(&self.solved.tiers.tiers).enumerate() {
            let called = self.called(place);
            if self.difference(place).abs() > NOTED {
                let (before, after) = (before.distance, after.distance);
                say(&format!("note: {path}: {called}: the distance {before} becomes {after:.7}"));
            }
            if (before.angle - after.angle).abs() > NOTED_DEG {
                let (before, after) = (before.angle, after.angle);
                say(&format!("note: {path}: {called}: the angle {before} becomes {after:.4} degrees"));
            }
        }
        self.solved.errors().for_each(|error| say(&format!("warning: {path}: {error}")));
        self.solved.tiers.with_words_of_meets()
    }

    fn called(&self, place: usize) -> String {
        format!("tier {} '{}'", place + 1, self.names[place])
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
                "name": self.names[place],
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

    /// Describes in two sentences the origins of the meets, and the agreement of the design's distances with them.
    fn summary(&self) -> String {
        let count = self.sources.len();
        let from = [
            ("file", "given by the file"),
            ("stated", "stated by instructions"),
            ("found", "found in the geometry"),
            ("", "not known"),
        ]
        .map(|(source, how)| (self.sources.iter().filter(|own| **own == source).count(), how));
        let from =
            from.iter().filter(|(number, _)| *number > 0).map(|(number, how)| format!("{number} {how}"));
        let moved = (0..count).filter(|&place| self.solved.outcomes[place] == TierOutcome::Solved);
        let farthest = moved
            .map(|place| (self.difference(place).abs(), place))
            .filter(|(by, _)| *by > NOTED)
            .max_by(|a, b| a.0.total_cmp(&b.0));
        let followed = match farthest {
            Some((by, place)) => format!("{} moves farthest, by {by:.6}", self.called(place)),
            None => format!("no tier moves by more than {NOTED}"),
        };
        let failed = match self.solved.errors().count() {
            0 => String::new(),
            1 => "; one meet cannot be followed".to_owned(),
            failed => format!("; {failed} meets cannot be followed"),
        };
        let from = from.collect::<Vec<_>>().join(", ");
        format!("  meets of {count} tiers: {from}\n  where they are followed, {followed}{failed}")
    }

    /// Returns the distance by which a tier moves when all meets are followed.
    fn difference(&self, place: usize) -> f64 {
        self.solved.tiers.tiers[place].distance - self.design.tiers[place].distance
    }

    /// Returns the summary, a table of the tiers, and the reasons why meets cannot be followed.
    pub fn table(&self) -> String {
        let mut text = self.summary();
        let _ = write!(
            text,
            "\n\n  {:<14}{:>12}{:>12}{:>13}  {:<8}meet",
            "tier", "distance", "solved", "difference", "source"
        );
        for (place, tier) in self.design.tiers.iter().enumerate() {
            let name = &self.names[place];
            let meet = self.met.tiers[place].meet.as_ref().map_or_else(|| "-".to_owned(), Meet::to_string);
            let solved = self.solved.tiers.tiers[place].distance;
            let (solved, difference) = match &self.solved.outcomes[place] {
                TierOutcome::Solved => (fixed(solved, 6), fixed(self.difference(place), 6)),
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
                "\n  {name:<14}{:>12}{solved:>12}{difference:>13}  {source:<8}{meet}{ambiguous}",
                fixed(tier.distance, 6)
            );
        }
        for error in self.solved.errors() {
            let _ = write!(text, "\n  {error}");
        }
        text
    }
}
