//! Decides how far beams are followed where rays estimate the light that the beams leave.

/// The time that a ray takes in a stone until too little of its light is left, as a multiple of the time that a beam
/// takes.
const BEAMS_A_RAY: f64 = 9.0;

/// The standard deviation of one ray's estimate for one zone, within one stratum, as a share of the light that is
/// left.
const SPREAD: f64 = 0.45;

/// The fewest beams from which the cost of the next step is predicted.
const FEWEST: usize = 400;

/// Compares the cost of more beams with that of the rays that estimate the light which beams leave.
///
/// N rays estimate a part t of all light with a standard error of about `SPREAD` t / √N. So the whole work is that of
/// n beams and of N = (`SPREAD` t / standard error)² rays. Each step of the beams multiplies n and t by factors that
/// change little from step to step; the beams go on while the next step reduces the sum.
pub(super) struct BeamEffort {
    standard_error: f64,
    /// The number of beams and the part of the light left after the last step.
    before: Option<(f64, f64)>,
}

impl BeamEffort {
    /// Returns the effort for a standard error, which is a part of all light.
    pub fn to(standard_error: f64) -> Self {
        Self { standard_error, before: None }
    }

    /// Records the number of beams and the part of the light that is left, and returns whether more beams would cost
    /// more time than they save.
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
