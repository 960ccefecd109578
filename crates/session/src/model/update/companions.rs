//! Moves stones of a scene, and changes which of them is edited.

use crate::model::Model;
use crate::model::document::Document;
use crate::model::work::Work;
use brillianteer_scene::{Companion, Companions, Copies, Instance, Pose, overlapping};
use std::sync::Arc;

/// A stone to be moved, by its number among copies or companions.
#[derive(Clone, Copy)]
pub enum MovedStone {
    /// A copy of the design.
    Copy(usize),
    /// A stone of another design.
    Companion(usize),
}

impl MovedStone {
    /// Returns the pose of the stone; `None` where there is no such stone.
    fn pose(self, work: &mut Work) -> Option<&mut Pose> {
        match self {
            Self::Copy(number) => work.copies.poses.get_mut(number),
            Self::Companion(number) => work.companions.stones.get_mut(number).map(|stone| &mut stone.pose),
        }
    }

    /// Returns whether the stone sits in a ring of the scene.
    fn is_seated(self, document: &Document) -> bool {
        let Work { copies, companions, .. } = &document.work;
        let at_mm = match self {
            Self::Copy(number) => {
                copies.poses.get(number).map(|pose| pose.at * document.specimen().unit_mm())
            }
            Self::Companion(number) => companions.stones.get(number).map(|stone| stone.pose.at),
        };
        at_mm.is_some_and(|at| companions.seat_at(at).is_some())
    }
}

/// Moves a stone to a pose, unless a ring holds it or it would overlap another stone there. Copies without companions always move,
/// because copies that would meet are put into layers behind one another.
pub fn move_to(document: &mut Document, stone: MovedStone, pose: Pose) {
    let has_companions = !document.work.companions.is_empty();
    let was_apart = has_companions && are_apart(document);
    if stone.is_seated(document) {
        return;
    }
    let Some(at) = stone.pose(&mut document.work) else { return };
    let before = std::mem::replace(at, pose);
    if was_apart
        && !are_apart(document)
        && let Some(at) = stone.pose(&mut document.work)
    {
        *at = before;
    }
}

/// Returns whether no two stones of the scene overlap.
pub fn are_apart(document: &Document) -> bool {
    let Work { copies, companions, .. } = &document.work;
    let specimen = document.specimen();
    let own = |pose: &Pose| Instance::of(&specimen.body, specimen.material.clone(), "").moved(pose);
    let companions = companions.in_unit(1.0 / specimen.unit_mm());
    let stones: Vec<Instance> = copies.poses.iter().map(own).chain(companions.instances()).collect();
    overlapping(&stones).is_none()
}

/// Keeps the copies at their places among companions, in mm, after an edit of the design has changed its diameter.
pub fn stay_in_place(work: &mut Work, before_mm: f64) {
    if work.companions.is_empty() || work.design.diameter_mm == before_mm {
        return;
    }
    in_unit(&mut work.copies, before_mm / work.design.diameter_mm);
}

/// Converts the places of copies to another unit, of which `factor` make one of the unit before.
fn in_unit(copies: &mut Copies, factor: f64) {
    copies.poses.iter_mut().for_each(|pose| pose.at *= factor);
}

/// Edits the design of a companion: all stones of its kind become the copies, and the former copies become
/// companions. No stone of the scene moves.
pub fn take_up(model: &mut Model, number: usize) {
    let Model { document, session, .. } = model;
    let Work { design, copies, companions, .. } = &document.work;
    let Some(taken) = companions.stones.get(number).map(|stone| Arc::clone(&stone.specimen)) else { return };
    if document.fault().is_some() {
        return session
            .notes
            .say("This design makes no stone now: mend it, or undo, before you edit another.");
    }
    let own = document.specimen();
    let (own_mm, unit_mm) = (own.unit_mm(), taken.unit_mm());
    // The stone may have been built under the design's former name.
    let own = own.remade(design.clone()).map_or_else(|_| Arc::clone(own), Arc::new);
    let in_mm = Pose { scale: own_mm, ..Pose::STILL };
    let left =
        copies.poses.iter().map(|pose| Companion { specimen: Arc::clone(&own), pose: in_mm.after(pose) });
    let (of_kind, others): (Vec<_>, Vec<_>) =
        companions.stones.iter().cloned().partition(|stone| Arc::ptr_eq(&stone.specimen, &taken));
    let in_unit = Pose { scale: 1.0 / unit_mm, ..Pose::STILL };
    let copies = Copies {
        poses: of_kind.iter().map(|stone| Pose { scale: 1.0, ..in_unit.after(&stone.pose) }).collect(),
        room: None,
        movement: copies.movement,
    };
    let companions = Companions { stones: left.chain(others).collect(), ..companions.clone() };
    document.take_up(taken.design.clone(), copies, companions);
    // Each of these refers to the stone before.
    (session.held, session.tier, session.picking) = (None, None, None);
    session.meet_faults.clear();
    session.framing.follow(document);
}
