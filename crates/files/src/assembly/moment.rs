//! A scene some time after its bodies have begun to move.

use super::Assembly;
use brillianteer_base::Failure;
use brillianteer_cut::Design;
use brillianteer_scene::{Copies, Instance, Movement, Pose};
use std::sync::Arc;

impl Assembly {
    /// Returns the scene as it is some seconds after its bodies have begun to move, as they do in the editor: copies tumble, and
    /// plates move as `movement` says, or else the scene. The stones may be of one design alone, and nothing may stand beside them.
    ///
    /// # Errors
    /// [`Failure::Input`] where the scene holds anything else, or nothing.
    pub fn at_moment(mut self, seconds: f64, movement: Option<Movement>) -> Result<Self, Failure> {
        let refused = |why: &str| Failure::Input(format!("{}: {why}", self.path));
        let alike = |[a, b]: [&super::StonePlace; 2]| {
            Arc::ptr_eq(&a.specimen, &b.specimen)
                && a.material == b.material
                && a.diameter_mm == b.diameter_mm
        };
        let first = self.places.first().filter(|_| self.scene.metals.is_empty());
        let Some(first) = first.filter(|first| self.places.iter().all(|other| alike([*first, other]))) else {
            return Err(refused(
                "only stones of one design move, without metal beside them, so there is no other moment of it",
            ));
        };
        let (specimen, corners) = (&first.specimen, first.specimen.solid().vertices());
        // Copies are laid out in girdle radii.
        let unit = 0.5 * first.diameter_mm / self.scene.unit_mm;
        let rest = self.scene.instances.iter().map(|stone| Pose {
            at: stone.pose.at / unit,
            scale: 1.0,
            ..stone.pose
        });
        let copies = Copies::at(rest.collect(), corners);
        let (movement, cut) = (movement.unwrap_or(self.movement), &specimen.design.cut);
        let poses = copies.poses(corners, movement.tumbles(cut).then_some(seconds));
        let body = match movement.waved(cut, seconds) {
            Some(cut) => {
                let made = specimen.remade(Design { cut, ..specimen.design.clone() });
                Arc::clone(&made.map_err(|error| refused(&error.to_string()))?.body)
            }
            None => Arc::clone(&specimen.body),
        };
        let moved = |(stone, pose): (Instance, Pose)| Instance {
            body: Arc::clone(&body),
            pose: Pose { at: pose.at * unit, scale: stone.pose.scale, ..pose },
            ..stone
        };
        let instances = std::mem::take(&mut self.scene.instances);
        self.scene.instances = instances.into_iter().zip(poses).map(moved).collect();
        Ok(self)
    }
}
