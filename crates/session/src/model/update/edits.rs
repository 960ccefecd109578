//! Edits: changes of the work.

use super::companions::{self, MovedStone};
use super::scene_ring;
use crate::model::Model;
use crate::model::action::Edit;
use crate::model::extent;
use brillianteer_cut::{Cut, Design, ScaledSide, SolvedTiers, TierChange, TierOutcome, scaled};
use brillianteer_files::as_tiers;
use brillianteer_scene::{Copies, Pose};
use glam::DVec3;
use std::sync::Arc;

/// Changes the work and builds the resulting stone.
pub fn edit(model: &mut Model, edit: Edit) {
    // A pick ends with its edit, and any other edit may have reordered the tiers.
    model.session.picking = None;
    let before_mm = model.document.work.design.diameter_mm;
    let work = &mut model.document.work;
    match edit {
        Edit::Name(name) => work.design.rename(name),
        Edit::Cut(cut) => work.design.cut = cut,
        Edit::Proportion(key, cut) => {
            work.design.cut = cut;
            model.session.edited = Some(key);
        }
        Edit::Along(to) => move_along(model, to),
        Edit::Tier { place, angle, distance } => {
            keep_tiers_in_place(model, |cut| cut.set(place, angle, distance));
        }
        Edit::Tiers(change) => change_tiers(model, change),
        Edit::NextMeet { place, is_deeper } => next_meet(model, place, is_deeper),
        Edit::AddTier(after) => add_tier(model, after),
        Edit::Scale { side, percent, of } => scale(model, side, 0.01 * percent, *of),
        Edit::IntoTiers => {
            let tiers = as_tiers(model.document.specimen()).map(|tiers| tiers.with_own_meets());
            keep_tiers_in_place(model, |cut| tiers.into_iter().for_each(|tiers| *cut = Cut::Tiers(tiers)));
            model.session.meet_faults.clear();
        }
        Edit::Material(material) => work.design.material = material,
        Edit::Fitted(design) => {
            let Design { cut, material, notes, .. } = *design;
            (work.design.material, work.design.notes) = (material, notes);
            keep_tiers_in_place(model, |old| *old = cut);
            note_meet_faults(model);
        }
        Edit::Diameter(mm) => work.design.diameter_mm = mm,
        Edit::Look(look) => work.settings.look = *look,
        Edit::Liquid(liquid) => work.settings.liquid = *liquid,
        Edit::ResetLight => {
            let first = model.document.first_settings().look.clone();
            model.document.work.settings.look.reset_light(&first);
        }
        Edit::LayOut(count) => lay_out(model, count),
        Edit::Movement(movement) => work.copies.movement = movement,
        Edit::Finish { bodies, metal, roughness } => {
            let metals = &mut work.companions.metals;
            for (_, body) in metals.iter_mut().enumerate().filter(|(number, _)| bodies.contains(number)) {
                (body.metal, body.roughness) = (metal, roughness);
            }
        }
        Edit::Ring(ring) => scene_ring::set(model, *ring),
        Edit::Copy(copy, pose) => {
            companions::move_to(&mut model.document, MovedStone::Copy(copy), pose);
        }
        Edit::Companion(number, pose) => {
            companions::move_to(&mut model.document, MovedStone::Companion(number), pose);
        }
        Edit::TakeUp(number) => return companions::take_up(model, number),
    }
    companions::stay_in_place(&mut model.document.work, before_mm);
    model.document.update();
}

/// Changes the cut. A wider stone gets a greater diameter, so that all other tiers keep their distances in mm.
fn keep_tiers_in_place(model: &mut Model, change: impl FnOnce(&mut Cut)) {
    let unit = model.document.specimen().frame.scale;
    let design = &mut model.document.work.design;
    change(&mut design.cut);
    if let Some(now) = extent::unit(design) {
        design.diameter_mm *= unit / now;
    }
}

/// Changes the list of tiers and follows all meets; records which of them could not be followed.
fn change_tiers(model: &mut Model, change: TierChange) {
    let Cut::Tiers(tiers) = &model.document.work.design.cut else { return };
    let SolvedTiers { tiers, outcomes, .. } = tiers.changed(change);
    model.session.meet_faults = faults(outcomes);
    keep_tiers_in_place(model, |cut| *cut = Cut::Tiers(tiers));
}

/// Cuts a tier to the next corner that it reaches, deeper or farther out, or reports that no meet leads to one.
fn next_meet(model: &mut Model, place: usize, is_deeper: bool) {
    let Cut::Tiers(tiers) = &model.document.work.design.cut else { return };
    match tiers.next_meet(place, is_deeper) {
        Some(meet) => change_tiers(model, TierChange::Meet(place, Some(meet))),
        None => {
            let way = if is_deeper { "deeper" } else { "farther out" };
            model.session.notes.say(&format!("No meet leads this tier to a corner that is {way}."));
        }
    }
}

/// Moves the design to a place of the map, or reports why it stays.
fn move_along(model: &mut Model, to: [f64; 2]) {
    let Model { document, session, .. } = model;
    match session.map.moved(&document.work.design, to) {
        Ok(cut) => {
            document.work.design.cut = cut;
            note_meet_faults(model);
        }
        Err(why) => session.notes.say(&format!("The design stays: {why}.")),
    }
}

/// Scales a side of a cut, or reports why the design stays. Meets stay as they are, because a stretch keeps them.
fn scale(model: &mut Model, side: ScaledSide, factor: f64, of: Cut) {
    let design = &mut model.document.work.design;
    match scaled(&Design { cut: of, ..design.clone() }, side, factor) {
        Ok(cut) => design.cut = cut,
        Err(why) => model.session.notes.say(&format!("The design stays: {why}.")),
    }
}

/// Returns for each tier why its meet could not be followed, if it could not.
fn faults(outcomes: Vec<TierOutcome>) -> Vec<Option<String>> {
    let fault = |outcome| match outcome {
        TierOutcome::Failed(error) => Some(error.fault.to_string()),
        _ => None,
    };
    outcomes.into_iter().map(fault).collect()
}

/// Records which meets of the present design cannot be followed, after a change by something else than its list of
/// tiers.
pub fn note_meet_faults(model: &mut Model) {
    model.session.meet_faults = match &model.document.work.design.cut {
        Cut::Tiers(tiers) => faults(tiers.solved().outcomes),
        _ => vec![],
    };
}

/// Adds a tier after the one at a place, or after the last, and selects it. The new tier has the indices of the other
/// and just touches the stone, so that it cuts nothing until it is moved.
fn add_tier(model: &mut Model, after: Option<usize>) {
    let Cut::Tiers(tiers) = &model.document.work.design.cut else { return };
    let place = after.map_or(tiers.tiers.len(), |place| (place + 1).min(tiers.tiers.len()));
    let tier = tiers.beside_stone(place);
    edit(model, Edit::Tiers(TierChange::Insert(place, tier)));
    model.session.tier = Some(place);
}

/// Lays out `count` copies anew, each with its former turn.
fn lay_out(model: &mut Model, count: usize) {
    model.session.layings += 1;
    let specimen = Arc::clone(model.document.specimen());
    let (solid, copies) = (specimen.solid(), &mut model.document.work.copies);
    let turn = |k: usize| copies.poses.get(k).map_or(Pose::STILL.turn, |pose| pose.turn);
    let corners: Vec<DVec3> = (0..count)
        .flat_map(|k| solid.vertices().iter().map(move |c| (k, *c)))
        .map(|(k, c)| turn(k) * c)
        .collect();
    let mut laid = Copies::scattered(count, &corners, model.session.layings);
    laid.poses.iter_mut().enumerate().for_each(|(k, pose)| pose.turn = turn(k));
    *copies = Copies { movement: copies.movement, ..laid };
}
