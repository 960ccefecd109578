//! Beams that several pictures share.

use brillianteer_base::{Stopped, Watch};
use brillianteer_math::Polytope;
use brillianteer_scene::{Body, Medium, View};
use brillianteer_trace::beam::{self, BeamOptions, Beams};
use std::sync::Arc;

/// The most sets of beams that are kept.
const MOST_KEPT: usize = 6;

/// The most memory of the beams of all sets while others are traced, bytes. The set that was made last may be larger, but
/// then it is kept alone.
const MOST_BYTES: usize = 128 << 20;

/// The memory of the beams of all sets and of the set that is being traced, bytes, if that one takes no more than the largest set
/// that is kept.
const WITH_NEXT_BYTES: usize = 384 << 20;

/// Beams that several pictures share.
#[derive(Default)]
pub struct BeamCache {
    /// The sets of beams, the one that was used last at the end.
    kept: Vec<Kept>,
    /// The number of the present round.
    round: u64,
}

/// A set of beams, with the body, medium, view and options that they belong to, and the round of its last use.
struct Kept {
    body: Arc<Body>,
    medium: Medium,
    view: View,
    options: BeamOptions,
    beams: Arc<Beams>,
    used: u64,
}

impl BeamCache {
    /// Returns the beams of a body that is a polytope; traces them unless they are kept.
    ///
    /// # Errors
    /// Fails with [`Stopped`] when `watch` asks to stop.
    pub fn of(
        &mut self,
        (body, polytope): (&Arc<Body>, &Polytope),
        medium: Medium,
        view: &View,
        options: &BeamOptions,
        watch: Watch,
    ) -> Result<Arc<Beams>, Stopped> {
        if let Some(beams) = self.kept(body, medium, view, options) {
            return Ok(beams);
        }
        // Old sets make room before the new one takes its memory, which is probably about that of the others.
        let largest = self.kept.iter().map(|kept| kept.beams.bytes()).max().unwrap_or(0);
        self.shrink(MOST_KEPT - 1, MOST_BYTES.min(WITH_NEXT_BYTES.saturating_sub(largest)));
        let beams = Arc::new(beam::trace(polytope, medium, view, options, watch)?);
        self.shrink(MOST_KEPT - 1, MOST_BYTES.saturating_sub(beams.bytes()));
        let (body, view, options) = (Arc::clone(body), *view, *options);
        let used = self.round;
        self.kept.push(Kept { body, medium, view, options, beams: Arc::clone(&beams), used });
        Ok(beams)
    }

    /// Returns the beams of a body if they are kept.
    pub fn kept(
        &mut self,
        body: &Arc<Body>,
        medium: Medium,
        view: &View,
        options: &BeamOptions,
    ) -> Option<Arc<Beams>> {
        let is_same = |kept: &Kept| {
            (kept.medium, kept.view, kept.options) == (medium, *view, *options)
                && Arc::ptr_eq(&kept.body, body)
        };
        let place = self.kept.iter().position(is_same)?;
        let kept = Kept { used: self.round, ..self.kept.remove(place) };
        let beams = Arc::clone(&kept.beams);
        self.kept.push(kept);
        Some(beams)
    }

    /// Drops the sets that were not used for the longest time, until there are at most so many sets whose beams take at
    /// most so many bytes.
    fn shrink(&mut self, most_sets: usize, most_bytes: usize) {
        let mut bytes: usize = self.kept.iter().map(|kept| kept.beams.bytes()).sum();
        while self.kept.len() > most_sets || bytes > most_bytes {
            bytes -= self.kept.remove(0).beams.bytes();
        }
    }

    /// Drops all beams.
    pub fn clear(&mut self) {
        self.kept.clear();
    }

    /// Begins a round: beams that were not used in the last one are dropped.
    pub fn begin_round(&mut self) {
        self.kept.retain(|kept| kept.used == self.round);
        self.round += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_base::unwatched;
    use brillianteer_math::Plane;
    use glam::DVec3;

    fn cube() -> Arc<Body> {
        let sides = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|normal| [normal, -normal]);
        let planes: Vec<Plane> = sides.map(|normal| Plane { normal, offset: 0.5 }).collect();
        Arc::new(Polytope::from_planes(&planes).unwrap().into())
    }

    /// Returns the beams of a cube of this index, from the cache.
    fn beams(cache: &mut BeamCache, cube: &Arc<Body>, index: f64) -> Arc<Beams> {
        let polytope = &cube.stone().unwrap().polytope;
        let options = BeamOptions { unresolved: 0.1, ..BeamOptions::default() };
        let medium = Medium::clear(index);
        cache.of((cube, polytope), medium, &View::default(), &options, &unwatched).unwrap()
    }

    /// Returns the indices of the cubes whose beams are kept, the one that was used last at the end.
    fn kept(cache: &BeamCache) -> Vec<f64> {
        cache.kept.iter().map(|kept| kept.medium.index).collect()
    }

    #[test]
    fn the_set_that_was_used_longest_ago_makes_room_for_a_new_one() {
        let (mut cache, cube) = (BeamCache::default(), cube());
        let first = beams(&mut cache, &cube, 1.5);
        for index in [1.6, 1.7, 1.8, 1.9, 2.0] {
            beams(&mut cache, &cube, index);
        }
        assert!(Arc::ptr_eq(&first, &beams(&mut cache, &cube, 1.5)));
        beams(&mut cache, &cube, 2.1);
        assert_eq!(kept(&cache), [1.7, 1.8, 1.9, 2.0, 1.5, 2.1]);
        assert!(Arc::ptr_eq(&first, &beams(&mut cache, &cube, 1.5)));
    }

    #[test]
    fn sets_are_dropped_until_their_beams_fit() {
        let (mut cache, cube) = (BeamCache::default(), cube());
        let bytes = [1.5, 1.6, 1.7].map(|index| beams(&mut cache, &cube, index).bytes());
        cache.shrink(MOST_KEPT, bytes.iter().sum());
        assert_eq!(kept(&cache), [1.5, 1.6, 1.7]);
        cache.shrink(MOST_KEPT, bytes[1] + bytes[2]);
        assert_eq!(kept(&cache), [1.6, 1.7]);
        cache.shrink(MOST_KEPT, 0);
        assert!(kept(&cache).is_empty());
    }
}
