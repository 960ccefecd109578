//! The meets of a design and their origins, for `info --meets` and `convert --meets`.

use super::console::say;
use brillianteer_cut::{Cut, KnownMeets, MeetOutcome, MeetSource, TierMeet, Tiers};
use brillianteer_files::as_tiers;
use brillianteer_paper::table::{Column, Table, TableCell};
use brillianteer_scene::Specimen;

/// The largest change of a distance, in the design's unit, that causes no note: the last digit of most files.
const NOTED: f64 = 1e-5;

/// The largest change of an angle, degrees, that causes no note.
const NOTED_DEG: f64 = 1e-3;

/// The meets of a stone that are known.
pub struct MeetList {
    pub known: KnownMeets,
    /// Whether the stone was turned into tiers.
    is_turned: bool,
}

impl MeetList {
    /// Takes the known meets of a stone. One that is not cut by tiers is turned into tiers first; `None` for a body that is no
    /// convex stone between planes.
    pub fn of(specimen: &Specimen) -> Option<Self> {
        let (design, is_turned) = match &specimen.design.cut {
            Cut::Tiers(tiers) => (tiers.clone(), false),
            _ => (as_tiers(specimen)?, true),
        };
        Some(Self { known: KnownMeets::of(design), is_turned })
    }

    /// Says that the stone was turned into tiers, how many have a meet, and which have indices between teeth; nothing for a
    /// stone that tiers cut.
    pub fn say_turned(&self, path: &str) {
        if !self.is_turned {
            return;
        }
        let KnownMeets { tiers, met, design, .. } = &self.known;
        let (all, with_meet) =
            (tiers.len(), tiers.iter().filter(|tier| tier.source != MeetSource::Unknown).count());
        say(&format!(
            "note: {path}: turned into {all} tiers; {with_meet} have a meet, the others keep their distance"
        ));
        let between = met.between_teeth();
        if !between.is_empty() {
            let (gear, names) = (design.gear.abs(), between.join(", "));
            say(&format!("note: {path}: indices lie between the teeth of the gear of {gear}: {names}"));
        }
    }

    /// Returns the solved design with its meets, each also as an instruction where there was none, or one that states another. Prints a note for each tier
    /// that moves, and a warning for each meet that cannot be followed.
    pub fn followed(self, path: &str) -> Tiers {
        for (row, tier) in self.known.tiers.iter().zip(&self.known.design.tiers) {
            let called = called(row);
            if row.difference().abs() > NOTED {
                let (before, after) = (row.distance, row.solved);
                say(&format!("note: {path}: {called}: the distance {before} becomes {after:.7}"));
            }
            if (tier.angle - row.angle).abs() > NOTED_DEG {
                let (before, after) = (tier.angle, row.angle);
                say(&format!("note: {path}: {called}: the angle {before} becomes {after:.4} degrees"));
            }
        }
        self.known.solved.errors().for_each(|error| say(&format!("warning: {path}: {error}")));
        self.known.solved.tiers.with_words_of_meets()
    }

    /// Describes in two sentences the origins of the meets, and the agreement of the design's distances with them.
    fn summary(&self) -> String {
        let tiers = &self.known.tiers;
        let from = [
            (MeetSource::File, "given by the file"),
            (MeetSource::Stated, "stated by instructions"),
            (MeetSource::Found, "found in the geometry"),
            (MeetSource::Unknown, "not known"),
        ]
        .map(|(source, how)| (tiers.iter().filter(|tier| tier.source == source).count(), how));
        let from =
            from.iter().filter(|(number, _)| *number > 0).map(|(number, how)| format!("{number} {how}"));
        let moved = tiers.iter().filter(|tier| tier.outcome == MeetOutcome::Solved);
        let farthest = moved
            .map(|tier| (tier.difference().abs(), tier))
            .filter(|(by, _)| *by > NOTED)
            .max_by(|a, b| a.0.total_cmp(&b.0));
        let followed = match farthest {
            Some((by, tier)) => format!("{} moves farthest, by {by:.6}", called(tier)),
            None => format!("no tier moves by more than {NOTED}"),
        };
        let failed = match self.known.solved.errors().count() {
            0 => String::new(),
            1 => "; one meet cannot be followed".to_owned(),
            failed => format!("; {failed} meets cannot be followed"),
        };
        let from = from.collect::<Vec<_>>().join(", ");
        format!("  meets of {} tiers: {from}\n  where they are followed, {followed}{failed}", tiers.len())
    }

    /// Returns the summary, a table of the tiers, and the reasons why meets cannot be followed.
    pub fn table(&self) -> String {
        let columns = [
            Column::left("tier", 14),
            Column::right("distance", 12).digits(6),
            Column::right("solved", 12).digits(6),
            Column::right("difference", 13).digits(6),
            Column::left("source", 8).after(2),
            Column::text("meet"),
        ];
        let mut table = Table::headed(columns).indented(2);
        self.known.tiers.iter().for_each(|tier| table.row(cells(tier)));
        self.known.solved.errors().for_each(|error| table.line(&format!("  {error}")));
        format!("{}\n\n{table}", self.summary())
    }
}

fn called(tier: &TierMeet) -> String {
    format!("tier {} '{}'", tier.tier, tier.name)
}

/// Returns the cells of a tier in the table.
fn cells(tier: &TierMeet) -> [TableCell; 6] {
    let (solved, difference) = match tier.outcome {
        MeetOutcome::Solved => (tier.solved.into(), tier.difference().into()),
        MeetOutcome::Failed => ("failed".into(), "".into()),
        MeetOutcome::Kept | MeetOutcome::Sets => ("given".into(), "".into()),
    };
    let ambiguous = match tier.choices {
        0 | 1 => String::new(),
        choices => format!(" (ambiguous: {choices} corners fit these names)"),
    };
    let meet = format!("{}{ambiguous}", tier.meet.as_deref().unwrap_or("-"));
    [
        tier.name.as_str().into(),
        tier.distance.into(),
        solved,
        difference,
        tier.source.name().into(),
        meet.into(),
    ]
}
