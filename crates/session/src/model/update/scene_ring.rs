//! Lets the metal of a scene's ring follow its numbers and its stones.
//!
//! Metal takes up to a second or two to make. So numbers change at once, the metal is made by a task, and once it is there it
//! joins the step of undo that it follows from.

use crate::model::Model;
use crate::model::document::Document;
use crate::model::session::RingMaking;
use crate::model::task::Task;
use crate::model::work::Work;
use brillianteer_base::Failure;
use brillianteer_cut::Design;
use brillianteer_scene::{Companion, Pose, Ring, RingMetal, RingPlan, SeatKind, Specimen};
use std::sync::Arc;

/// Orders metal where that of the ring was made of other numbers or stones than the present ones, unless some is being made
/// or these make no ring. While a search changes the design, the ring stays.
pub fn follow(model: &mut Model, tasks: &mut Vec<Task>) {
    if model.session.search.running().is_some() || model.session.ring.asked.is_some() {
        return;
    }
    let Some(plan) = model.document.ring_plan() else { return };
    let is_made = model.document.work.companions.ring.as_ref().is_some_and(|ring| ring.made_of == plan);
    let refused = &model.session.ring.refused;
    if is_made || refused.as_ref().is_some_and(|(refused, _)| *refused == plan) {
        return;
    }
    model.session.ring = RingMaking { asked: Some(plan.clone()), refused: None };
    tasks.push(Task::MakeRing(model.session.begun, Box::new(plan)));
}

/// Sets the numbers of the ring. Its small stones are made as large as they say.
pub fn set(model: &mut Model, ring: Ring) {
    let Some(before) = model.document.ring_plan() else { return };
    let is_own = |small: &Arc<Specimen>| Arc::ptr_eq(small, model.document.specimen());
    let across = ring.small_diameter_mm;
    let small = before.small_stone.filter(|_| before.ring.small_diameter_mm != across);
    let small = small.map(|small| (is_own(&small), small));
    let Work { design, companions, .. } = &mut model.document.work;
    match small {
        Some((true, _)) => design.diameter_mm = across,
        Some((false, small)) => resize(&mut companions.stones, &small, across),
        None => {}
    }
    if let Some(own) = &mut companions.ring {
        own.ring = ring;
    }
}

/// Gives all stones of a specimen another diameter, in mm, in their places.
fn resize(stones: &mut [Companion], specimen: &Arc<Specimen>, diameter_mm: f64) {
    let design = Design { diameter_mm, ..specimen.design.clone() };
    // A diameter that no stone has makes no ring either, which the panel then says.
    let Ok(made) = specimen.remade(design).map(Arc::new) else { return };
    for stone in stones.iter_mut().filter(|stone| Arc::ptr_eq(&stone.specimen, specimen)) {
        (stone.specimen, stone.pose.scale) = (Arc::clone(&made), made.unit_mm());
    }
}

/// Takes over metal that was made by a plan, or the reason why there is none. An answer that is older than the present
/// numbers is taken too, so that the ring follows a drag; the next one is ordered then.
pub fn take(model: &mut Model, number: u64, made_of: RingPlan, made: Result<RingMetal, Failure>) {
    let Model { document, session, .. } = model;
    if number != session.begun {
        return;
    }
    session.ring.asked = None;
    let Some(wanted) = document.ring_plan().filter(|_| session.search.running().is_none()) else { return };
    let is_made = document.work.companions.ring.as_ref().is_some_and(|ring| ring.made_of == wanted);
    match made {
        // Undo may have brought back numbers whose metal is there.
        Ok(_) if is_made => {}
        Ok(metal) => {
            let is_settled = !document.has_unsettled();
            fit(document, made_of, metal);
            if is_settled {
                document.amend();
            }
        }
        Err(why) => session.ring.refused = Some((made_of, why.to_string())),
    }
}

/// Gives the ring its metal, and its stones their places.
fn fit(document: &mut Document, made_of: RingPlan, RingMetal { mesh, seats }: RingMetal) {
    let specimen = Arc::clone(document.specimen());
    let Work { copies, companions, .. } = &mut document.work;
    let at = copies.poses.first().map_or(glam::DVec3::ZERO, |pose| pose.at * specimen.unit_mm());
    let Some(present) = companions.ring_plan(&specimen, at) else { return };
    let Some(ring) = &mut companions.ring else { return };
    let Some(body) = companions.metals.get_mut(ring.metal) else { return };
    (body.mesh, body.label) = (mesh, made_of.ring.label());
    for kind in [SeatKind::Main, SeatKind::Small] {
        let Some(stone) = present.stone_of(kind) else { continue };
        let own = seats.iter().filter(|seat| seat.kind == kind);
        let poses = own.map(|seat| body.pose.after(&seat.pose));
        if Arc::ptr_eq(stone, &specimen) {
            let unit = specimen.unit_mm();
            copies.poses = poses.map(|pose| Pose { at: pose.at / unit, scale: 1.0, ..pose }).collect();
        } else {
            seat(&mut companions.stones, stone, poses);
        }
    }
    (ring.made_of, ring.seats) = (made_of, seats);
}

/// Replaces the stones of a specimen among companions by such stones in these places, in mm. The others keep their order.
fn seat(stones: &mut Vec<Companion>, specimen: &Arc<Specimen>, poses: impl Iterator<Item = Pose>) {
    let is_of_kind = |stone: &Companion| Arc::ptr_eq(&stone.specimen, specimen);
    let first = stones.iter().position(is_of_kind).unwrap_or(stones.len());
    stones.retain(|stone| !is_of_kind(stone));
    let scale = specimen.unit_mm();
    let seated = poses.map(|pose| Companion { specimen: Arc::clone(specimen), pose: Pose { scale, ..pose } });
    stones.splice(first..first, seated);
}
