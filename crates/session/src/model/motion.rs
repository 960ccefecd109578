//! The motion of time in renders: copies tumble and plates wave. Figures and scopes are of the design at rest.

use brillianteer_scene::{Copies, Movement, Pose, Specimen};
use std::sync::Arc;

/// The time that renders show.
#[derive(Debug, Clone, Copy, Default)]
pub struct Motion {
    /// True while time goes on.
    pub is_on: bool,
    /// The time since rest, seconds.
    pub seconds: f64,
}

/// The plates that wave, as they were shown last.
#[derive(Debug, Clone, Default)]
pub struct WaveCache {
    /// Each plate at rest, the time in seconds, and the plate with its wave in its phase at that time.
    waved: Vec<(Arc<Specimen>, f64, Arc<Specimen>)>,
}

/// The number of plates that are kept: the present one, and the one that it is compared with.
const PLATES: usize = 2;

impl Motion {
    /// Returns a motion that has stopped `seconds` after rest.
    pub fn at(seconds: f64) -> Self {
        Self { seconds, ..Self::default() }
    }

    /// Stops time and goes back to rest.
    pub fn rest(&mut self) {
        (self.is_on, self.seconds) = (false, 0.0);
    }

    /// Returns whether the stone tumbles now.
    pub fn tumbles(&self, specimen: &Specimen, copies: &Copies) -> bool {
        self.seconds > 0.0 && copies.movement.tumbles(&specimen.design.cut)
    }

    /// Returns the stone in its present phase, and the present poses of its copies.
    pub fn now(
        &self,
        cache: &mut WaveCache,
        specimen: &Arc<Specimen>,
        copies: &Copies,
    ) -> (Arc<Specimen>, Vec<Pose>) {
        let tumbling = self.tumbles(specimen, copies).then_some(self.seconds);
        let waves = self.seconds > 0.0 && copies.movement.waves(&specimen.design.cut);
        let specimen = if waves { cache.of(specimen, self.seconds) } else { Arc::clone(specimen) };
        let poses = copies.poses(specimen.solid().vertices(), tumbling);
        (specimen, poses)
    }
}

impl WaveCache {
    /// Returns the plate with the phase of its wave `seconds` after rest.
    fn of(&mut self, specimen: &Arc<Specimen>, seconds: f64) -> Arc<Specimen> {
        if let Some((.., now)) =
            self.waved.iter().find(|(of, at, _)| Arc::ptr_eq(of, specimen) && *at == seconds)
        {
            return Arc::clone(now);
        }
        let mut design = specimen.design.clone();
        if let Some(cut) = Movement::Wave.waved(&design.cut, seconds) {
            design.cut = cut;
        }
        // A plate that can be made at rest can be made in any phase.
        let now = specimen.remade(design).map_or_else(|_| Arc::clone(specimen), Arc::new);
        if self.waved.len() == PLATES {
            self.waved.remove(0);
        }
        self.waved.push((Arc::clone(specimen), seconds, Arc::clone(&now)));
        now
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::document::Document;
    use brillianteer_cut::{Cut, Glass};

    #[test]
    fn a_plate_waves_and_tumbles_as_its_copies_say_and_anything_else_tumbles() {
        let mut moving = Motion::at(0.7);
        let cache = &mut WaveCache::default();
        let of = |name| Arc::clone(Document::of_library(name).unwrap().specimen());
        let (plate, cube) = (of("plate"), of("cube"));
        let copies = Copies { movement: Movement::Wave, ..Copies::default() };
        let (waved, poses) = moving.now(cache, &plate, &copies);
        let Cut::Glass(Glass::Plate(now)) = waved.design.cut else { panic!() };
        assert!((now.phase - 1.4_f64.to_degrees()).abs() < 1e-9 && poses == [Pose::STILL]);
        assert!(Arc::ptr_eq(&waved, &moving.now(cache, &plate, &copies).0), "made once");
        let is_turned = |poses: &[Pose]| poses[0].turn.angle_between(glam::DQuat::IDENTITY) > 0.3;
        let (both, poses) = moving.now(cache, &plate, &Copies::default());
        assert!(Arc::ptr_eq(&both, &waved) && is_turned(&poses));
        let tumble = Copies { movement: Movement::Tumble, ..Copies::default() };
        let (still, poses) = moving.now(cache, &plate, &tumble);
        assert!(Arc::ptr_eq(&still, &plate) && is_turned(&poses));
        let (still, poses) = moving.now(cache, &cube, &copies);
        assert!(Arc::ptr_eq(&still, &cube) && is_turned(&poses));
        moving.rest();
        assert_eq!(moving.now(cache, &cube, &copies).1, [Pose::STILL]);
        assert!(Arc::ptr_eq(&moving.now(cache, &plate, &copies).0, &plate));
    }
}
