//! Progress at the faceting machine: the step in sight, and which of its indices have been cut.

use brillianteer_cut::{TierZone, Tiers};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// The most marks that are kept. Beyond it those of other designs are dropped.
const MOST_MARKS: usize = 4000;

/// The state of bench mode, which is kept between starts.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct CuttingProgress {
    /// True while bench mode is open.
    pub is_open: bool,
    /// The step in sight, counted from 0 among the tiers that are cut.
    pub step: usize,
    /// The machine's own error, which the cheater corrects, in teeth; it is added to each index on the screen.
    pub cheater: f64,
    /// True where the machine's gear counts the other way round.
    pub is_left_handed: bool,
    /// The marks of indices that have been cut. Each holds the design, name and angle, so that a tier loses its marks
    /// when it changes.
    marks: BTreeSet<String>,
}

/// A step at the machine: one tier.
#[derive(Debug, Clone, PartialEq)]
pub struct CuttingStep {
    /// The place of the tier in the design's list.
    pub place: usize,
    /// The name by which the tier is called.
    pub name: String,
    /// The zone of the tier.
    pub zone: TierZone,
    /// The angle that is set at the machine, degrees from the girdle plane, 0 to 90.
    pub angle: f64,
    /// The indices, in teeth of the gear, in the order of the design.
    pub indices: Vec<f64>,
    /// The instructions that the design gives for the step.
    pub instructions: String,
}

/// Returns the steps of a design: the tiers that are cut, in their order.
pub fn steps(tiers: &Tiers) -> Vec<CuttingStep> {
    let named = tiers.names().into_iter().zip(&tiers.tiers).enumerate();
    let cut = named.filter(|(_, (_, tier))| tier.is_cut && !tier.facets.is_empty());
    cut.map(|(place, (name, tier))| CuttingStep {
        place,
        name,
        zone: tier.zone(),
        angle: tier.angle.abs().min(180.0 - tier.angle.abs()),
        indices: tier.facets.iter().map(|facet| facet.index).collect(),
        instructions: tier.instruction().into_owned(),
    })
    .collect()
}

impl CuttingProgress {
    /// Returns the number on the machine's dial for an index, including the cheater; index 0 is the last tooth.
    pub fn dial(&self, gear: i32, index: f64) -> f64 {
        let teeth = f64::from(gear.unsigned_abs());
        let counted = if self.is_left_handed { -index } else { index };
        let tooth = (counted + self.cheater).rem_euclid(teeth);
        // A sum that is a whole turn but for rounding is the last tooth.
        if tooth < 1e-9 || teeth - tooth < 1e-9 { teeth } else { tooth }
    }

    /// Returns whether an index of a step has been cut.
    pub fn is_cut(&self, design: &str, step: &CuttingStep, index: f64) -> bool {
        self.marks.contains(&mark(design, step, index))
    }

    /// Marks an index of a step as cut, or takes the mark back.
    pub fn set(&mut self, design: &str, step: &CuttingStep, index: f64, is_cut: bool) {
        let mark = mark(design, step, index);
        if is_cut {
            self.marks.insert(mark);
        } else {
            self.marks.remove(&mark);
        }
        if self.marks.len() > MOST_MARKS {
            self.marks.retain(|mark| mark.starts_with(&format!("{design}\n")));
        }
    }

    /// Returns how many indices of a step have been cut.
    pub fn count(&self, design: &str, step: &CuttingStep) -> usize {
        step.indices.iter().filter(|index| self.is_cut(design, step, **index)).count()
    }

    /// Forgets all marks of a design.
    pub fn forget(&mut self, design: &str) {
        self.marks.retain(|mark| !mark.starts_with(&format!("{design}\n")));
        self.step = 0;
    }
}

fn mark(design: &str, step: &CuttingStep, index: f64) -> String {
    format!("{design}\n{}\n{:.4}\n{index:.4}", step.name, step.angle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_cut::{Indexed, Tier};

    fn step(angle: f64) -> CuttingStep {
        let facets = [0.0, 24.0].map(|index| Indexed { index, name: String::new() }).to_vec();
        let tier = Tier {
            angle,
            distance: 1.0,
            instructions: "Meet P1".to_owned(),
            meet: None,
            is_cut: true,
            frosting: 0.0,
            facets,
        };
        let muted = Tier { is_cut: false, ..tier.clone() };
        let tiers = Tiers { gear: 96, tiers: vec![muted, tier], ..Tiers::default() };
        let [step] = steps(&tiers).try_into().unwrap();
        step
    }

    #[test]
    fn a_step_is_a_tier_that_is_cut_with_the_angle_of_the_machine() {
        let found = step(-42.5);
        assert_eq!((found.place, found.name.as_str(), found.angle), (1, "P2", 42.5));
        assert_eq!((found.indices, found.instructions.as_str()), (vec![0.0, 24.0], "Meet P1"));
        assert_eq!(step(-137.5).angle, 42.5);
    }

    #[test]
    fn marks_stay_with_their_design_and_end_when_the_angle_changes() {
        let mut progress = CuttingProgress::default();
        progress.set("a", &step(-42.5), 24.0, true);
        assert!(progress.is_cut("a", &step(-42.5), 24.0) && progress.count("a", &step(-42.5)) == 1);
        assert_eq!(progress.count("b", &step(-42.5)) + progress.count("a", &step(-42.6)), 0);
        let text = serde_json::to_string(&progress).unwrap();
        assert_eq!(serde_json::from_str::<CuttingProgress>(&text).unwrap(), progress);
        progress.set("a", &step(-42.5), 24.0, false);
        assert_eq!(progress, CuttingProgress::default());
        progress.set("a", &step(-42.5), 0.0, true);
        progress.forget("a");
        assert_eq!(progress, CuttingProgress::default());
    }

    #[test]
    fn the_dial_counts_with_the_gear_and_adds_the_cheater() {
        let mut progress = CuttingProgress::default();
        assert_eq!([0.0, 24.0, 96.0].map(|index| progress.dial(96, index)), [96.0, 24.0, 96.0]);
        progress.is_left_handed = true;
        assert_eq!([0.0, 24.0].map(|index| progress.dial(96, index)), [96.0, 72.0]);
        progress.cheater = 0.25;
        assert_eq!([0.0, 24.0].map(|index| progress.dial(-96, index)), [0.25, 72.25]);
    }
}
