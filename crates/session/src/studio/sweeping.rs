//! Sweeps in the studio: measures over a grid, which are answered a few points at a time.
//!
//! A newer order interrupts a sweep. Where the order contains the same sweep, the sweep goes on after the last
//! answered points: so a sweep waits while the user drags, and no point is measured twice.

use super::order::{Answer, Order, SweepOrder};
use super::worker::Worker;
use brillianteer_base::{Stopped, Watch};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The least number of points that are answered at once: few enough to show progress.
const AT_ONCE: usize = 32;

/// The number of points that are answered at once for each thread, so that none waits long for the last point.
const A_THREAD: usize = 4;

/// The number of sweeps whose progress is remembered.
const REMEMBERED: usize = 8;

/// The number of answered points of each sweep, by the number of the sweep.
#[derive(Default)]
pub(super) struct SweptSoFar(BTreeMap<u64, usize>);

impl SweptSoFar {
    fn of(&self, number: u64) -> usize {
        self.0.get(&number).copied().unwrap_or(0)
    }

    /// Records the number of answered points; forgets the oldest sweeps where there are many.
    fn note(&mut self, number: u64, answered: usize) {
        self.0.insert(number, answered);
        while self.0.len() > REMEMBERED {
            self.0.pop_first();
        }
    }
}

impl Worker {
    /// Measures the points of all sweeps of an order that have not been answered yet, up to a number of points that `until`
    /// returns for each.
    pub(super) fn sweeps(
        &mut self,
        order: &Order,
        until: impl Fn(&SweepOrder) -> usize,
        watch: Watch,
    ) -> Result<(), Stopped> {
        let at_once = AT_ONCE.max(A_THREAD * rayon::current_num_threads());
        for ask in &order.sweeps {
            let end = until(ask).min(ask.points.len());
            let mut answered = self.swept.of(ask.number);
            while answered < end {
                self.count();
                let part = &ask.points[answered..(answered + at_once).min(end)];
                let mut found = Vec::with_capacity(part.len());
                ask.sweep.run::<Stopped>(part.iter().copied(), watch, |point, result| {
                    found.push((point, Arc::new(result)));
                    Ok(())
                })?;
                answered += part.len();
                self.swept.note(ask.number, answered);
                self.answer(Answer::Swept(ask.number, found));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oldest_sweeps_are_forgotten() {
        let mut swept = SweptSoFar::default();
        (0..20).for_each(|number| swept.note(number, 5));
        assert_eq!([0, 11, 12, 19].map(|number| swept.of(number)), [0, 0, 5, 5]);
    }
}
