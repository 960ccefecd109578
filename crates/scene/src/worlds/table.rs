//! Tables of radiance that would take too long to compute for every pixel.

use super::noise::whole;
use glam::DVec3;
use std::sync::atomic::{AtomicU64, Ordering};

/// A ring of values by azimuth, or a map by azimuth and elevation, interpolated between its entries.
///
/// An entry is computed when it is first looked up. Threads that need the same entry at the same time all compute it
/// and store the same bits, so no thread ever waits for another: worlds are looked up by tasks of the thread pool, where
/// a thread that waits could be handed a task that needs what it is computing.
pub(super) struct DirectionTable {
    across: usize,
    down: usize,
    /// Returns the value at a place from 0 to 1 each way.
    entry: Box<dyn Fn(f64, f64) -> DVec3 + Send + Sync>,
    /// The bits of the values that are known; [`UNKNOWN`] stands for the others.
    known: Vec<[AtomicU64; 3]>,
}

/// The bits of a NaN, which no radiance is.
const UNKNOWN: u64 = u64::MAX;

impl DirectionTable {
    /// Returns a table, at first without values, of `across` by `down` entries, whose value is `entry` of the entry's
    /// place from 0 to 1. Across, the table is a ring.
    pub(super) fn new(
        [across, down]: [usize; 2],
        entry: impl Fn(f64, f64) -> DVec3 + Send + Sync + 'static,
    ) -> Self {
        let unknown = || [(); 3].map(|()| AtomicU64::new(UNKNOWN));
        let known = std::iter::repeat_with(unknown).take(across * down).collect();
        Self { across, down, entry: Box::new(entry), known }
    }

    /// Returns an entry, and computes it first where no thread has done so yet.
    fn entry(&self, k: usize) -> DVec3 {
        // Each component is whole by itself, and every thread would store the same, so no order of memory is needed.
        let bits = self.known[k].each_ref().map(|part| part.load(Ordering::Relaxed));
        if !bits.contains(&UNKNOWN) {
            return DVec3::from_array(bits.map(f64::from_bits));
        }
        self.computed(k)
    }

    #[cold]
    fn computed(&self, k: usize) -> DVec3 {
        let (x, y) = (k % self.across, k / self.across);
        let (x, y) = ((x as f64 + 0.5) / self.across as f64, y as f64 / (self.down - 1).max(1) as f64);
        let value = (self.entry)(x, y);
        for (part, value) in self.known[k].iter().zip(value.to_array()) {
            part.store(value.to_bits(), Ordering::Relaxed);
        }
        value
    }

    /// Returns the value at a place from 0 to 1, between the four entries around it.
    pub(super) fn at(&self, x: f64, y: f64) -> DVec3 {
        let u = (x - whole(x) as f64) * self.across as f64 - 0.5;
        let v = y.clamp(0.0, 1.0) * (self.down - 1) as f64;
        let (i, j) = (whole(u), (v as usize).min(self.down - 1));
        let (fu, fv) = (u - i as f64, v - j as f64);
        // Beyond half an entry at either end, the other end continues the ring.
        let left = if i < 0 { self.across - 1 } else { (i as usize).min(self.across - 1) };
        let right = if left + 1 < self.across { left + 1 } else { 0 };
        let row = |j: usize| {
            let of = |i: usize| self.entry(j * self.across + i);
            of(left) * (1.0 - fu) + of(right) * fu
        };
        row(j) * (1.0 - fv) + row((j + 1).min(self.down - 1)) * fv
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::prelude::*;
    use std::sync::Arc;
    use std::sync::atomic::AtomicUsize;

    #[test]
    fn a_table_computes_only_what_is_looked_up_and_remembers_it() {
        let calls = Arc::new(AtomicUsize::new(0));
        let counted = Arc::clone(&calls);
        let table = DirectionTable::new([8, 4], move |x, y| {
            counted.fetch_add(1, Ordering::Relaxed);
            DVec3::new(x, y, 0.0)
        });
        assert_eq!(calls.load(Ordering::Relaxed), 0);
        let first = table.at(0.3, 0.5);
        assert!((first - DVec3::new(0.3, 0.5, 0.0)).length() < 1e-12, "{first}");
        assert_eq!((table.at(0.3, 0.5), calls.load(Ordering::Relaxed)), (first, 4));
    }

    /// An entry whose own work is divided among the pool, looked up by tasks of that pool: a table that kept a lock
    /// while it computes would wait for itself.
    #[test]
    fn tasks_of_a_pool_may_look_up_entries_whose_computation_waits_for_that_pool() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(16).build().unwrap();
        let entry = |x: f64, _| DVec3::splat((0..64).into_par_iter().map(|k| x + f64::from(k)).sum());
        let tables: Vec<DirectionTable> = (0..20).map(|_| DirectionTable::new([64, 1], entry)).collect();
        let sum: f64 = pool.install(|| {
            let lookups = (0..tables.len() * 640).into_par_iter();
            lookups.map(|k| tables[k / 640].at((k % 640) as f64 / 640.0, 0.0).x).sum()
        });
        assert!(sum.is_finite() && sum > 0.0);
    }
}
