//! Takes the points of a sweep, many at a time and within the memory of one.

use super::renderer::RenderError;
use super::sweep::{Sweep, SweepError, SweptStone};
use brillianteer_base::{Stopped, Watch, at_once};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The number of points that are measured before they are handed out.
const AT_ONCE: usize = 64;

/// The parts of the memory of beams of which one belongs to each point, and the number of points that are measured at once.
/// All points are measured with the smallest part first. Those whose light needs more beams are measured again with a greater
/// part and fewer at a time. So no point depends on the number of cores, and all of them together need little more memory than
/// one.
const PARTS: [usize; 3] = [16, 4, 1];

impl Sweep {
    /// Measures the points of these numbers on all cores, and hands them out in the given order.
    ///
    /// # Errors
    /// Fails with [`Stopped`] when `watch` asks to stop, or an error of `each`, each turned into `E`.
    pub fn run<E: From<Stopped>>(
        &self,
        points: impl IntoIterator<Item = usize>,
        watch: Watch,
        each: impl FnMut(usize, Result<SweptStone, SweepError>) -> Result<(), E>,
    ) -> Result<(), E> {
        self.run_in(1, points, watch, each)
    }

    /// As [`run`](Self::run), but no point takes more than one part of so many of the memory of beams, and so of the time that
    /// goes with it; the intervals of a point that needs more are as wide as what is left.
    ///
    /// # Errors
    /// Those of [`run`](Self::run).
    pub fn run_in<E: From<Stopped>>(
        &self,
        fewest_parts: usize,
        points: impl IntoIterator<Item = usize>,
        watch: Watch,
        mut each: impl FnMut(usize, Result<SweptStone, SweepError>) -> Result<(), E>,
    ) -> Result<(), E> {
        let parts: Vec<usize> =
            PARTS.into_iter().filter(|parts| *parts >= fewest_parts.min(PARTS[0])).collect();
        let points: Vec<usize> = points.into_iter().collect();
        let (all, done) = (points.len().max(1) as f64, AtomicUsize::new(0));
        let watch = |_: f64| watch(done.load(Ordering::Relaxed) as f64 / all);
        for some in points.chunks(AT_ONCE) {
            for (&point, found) in some.iter().zip(self.measured(some, &parts, &done, &watch)) {
                match found {
                    Err(SweepError::Render(RenderError::Stopped(stopped))) => return Err(stopped.into()),
                    found => each(point, found)?,
                }
            }
        }
        Ok(())
    }

    /// Measures some points, and counts those that are done.
    fn measured(
        &self,
        points: &[usize],
        each_parts: &[usize],
        done: &AtomicUsize,
        watch: Watch,
    ) -> Vec<Result<SweptStone, SweepError>> {
        let last = each_parts.last().copied();
        let measured = |point: usize, parts: usize| {
            let found = self.point(point, parts, watch);
            if Some(parts) == last || !needs_more(&found) {
                done.fetch_add(1, Ordering::Relaxed);
            }
            found
        };
        let Some((first, more)) = each_parts.split_first() else { return vec![] };
        let mut found = at_once(*first, points, |&point| measured(point, *first));
        for parts in more {
            let again: Vec<usize> = (0..points.len()).filter(|&place| needs_more(&found[place])).collect();
            let anew = at_once(*parts, &again, |&place| measured(points[place], *parts));
            again.into_iter().zip(anew).for_each(|(place, anew)| found[place] = anew);
        }
        found
    }
}

/// Returns whether the memory ended the tracing of a point early.
fn needs_more(found: &Result<SweptStone, SweepError>) -> bool {
    found.as_ref().is_ok_and(|stone| stone.measures.is_cut_short)
}
