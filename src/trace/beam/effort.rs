//! How far it pays to follow beams where rays estimate what they leave.

/// The time that a ray takes in a stone until too little of it is left, in the times that a beam takes.
const BEAMS_A_RAY: f64 = 9.0;

/// The standard deviation, as a share of the light that is left, of what a ray says about one zone, within one stratum.
const SPREAD: f64 = 0.45;

/// The fewest beams from which the next step is foreseen.
const FEWEST: usize = 400;

/// Weighs more beams against rays that estimate the light which the beams leave.
///
/// N rays estimate a part t of all light to a standard error of about `SPREAD` t / √N. So all of the work is that of n beams
/// and of N = (`SPREAD` t / standard error)² rays. Each step of the beams multiplies n and t by factors that change little
/// from step to step; the beams go on while the next step makes the sum smaller.
pub(super) struct BeamEffort {
    standard_error: f64,
    /// The number of beams and the part of the light left, after the step before.
    before: Option<(f64, f64)>,
}

impl BeamEffort {
    /// Makes the effort that reaches a standard error, which is a part of all light.
    pub fn to(standard_error: f64) -> Self {
        Self { standard_error, before: None }
    }

    /// Whether no more beams are worth their time, now that there are so many and this part of the light is left.
    pub fn suffices(&mut self, beams: usize, left: f64) -> bool {
        let now = (beams as f64, left);
        let Some((n, t)) = self.before.replace(now) else { return false };
        let next = (now.0 * now.0 / n, now.1 * now.1 / t);
        beams > FEWEST && self.cost(next) >= self.cost(now)
    }

    fn cost(&self, (beams, left): (f64, f64)) -> f64 {
        beams + BEAMS_A_RAY * (SPREAD * left / self.standard_error).powi(2)
    }
}
