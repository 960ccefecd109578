//! Work on many items of which only a few are under way at once, so that the memory that each takes is bounded for any number
//! of threads.

use rayon::prelude::*;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Works on items on all cores, with no more than `most` of them under way at once, and returns what `work` gives for each.
///
/// Each of `most` tasks takes one item after the other. No thread waits for another: a lock would hang the thread pool, since a
/// thread that waits for its own pieces of work may be handed the next item.
pub fn at_once<T: Sync, R: Send + Sync>(most: usize, items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let done: Vec<OnceLock<R>> = items.iter().map(|_| OnceLock::new()).collect();
    let take = |_| {
        // Each item is taken once.
        let turn = || items.iter().zip(&done).nth(next.fetch_add(1, Ordering::Relaxed));
        while let Some((item, place)) = turn() {
            let _ = place.set(work(item));
        }
    };
    (0..most.clamp(1, items.len().max(1))).into_par_iter().for_each(take);
    done.into_iter().filter_map(OnceLock::into_inner).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_items_are_worked_on_in_their_order_and_few_at_once() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(16).build().unwrap();
        for most in [0, 1, 3, 100] {
            let (now, peak) = (AtomicUsize::new(0), AtomicUsize::new(0));
            let items: Vec<usize> = (0..40).collect();
            let work = |item: &usize| {
                peak.fetch_max(now.fetch_add(1, Ordering::SeqCst) + 1, Ordering::SeqCst);
                // Pieces of an item, which other threads take, while this one may be handed anything.
                let pieces = (0..2000_usize).into_par_iter().filter(|k| k % 2 == 0).count();
                now.fetch_sub(1, Ordering::SeqCst);
                item * 2 + pieces - 1000
            };
            let found = pool.install(|| at_once(most, &items, work));
            assert_eq!(found, items.iter().map(|item| 2 * item).collect::<Vec<_>>());
            assert!(peak.into_inner() <= most.max(1), "{most}");
        }
        assert!(at_once(4, &[] as &[u8], |item| *item).is_empty());
    }
}
