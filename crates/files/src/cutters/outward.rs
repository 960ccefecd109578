//! Prepares designs for cutters' files: as tiers, with their outlines, and with messages about what such files cannot hold.

use super::{Gear, TierPiece, fourteen_digits, gathered, named_once};
use brillianteer_cut::{
    Cut, DEFAULT_DIAMETER_MM, Design, Indexed, MaterialRef, Tier, TierZone, Tiers, tier_stem,
};
use brillianteer_math::{Basis, Plane, Polytope, Symmetry};
use brillianteer_optics::line;
use brillianteer_scene::{Specimen, SpecimenError};
use glam::DVec3;
use std::borrow::Cow;

/// The gears that are tried for a design without one, the commonest first.
const GEARS: [i32; 9] = [96, 80, 72, 64, 120, 84, 88, 77, 100];

/// The least distance between the origin and an axis of symmetry at which a stone is moved to the axis, as a part of how far its
/// corners reach from the origin.
const BESIDE_AXIS: f64 = 1e-6;

/// The plane of a facet and its corners, counter-clockwise seen from outside; no corners where it does not reach the stone.
pub(in super::super) type FacetOutline = (Plane, Vec<DVec3>);

/// Returns a design as tiers, with names where a meet may name them. A design that is not cut by tiers gets the first gear on whose teeth its facets lie, else the
/// commonest.
pub(in super::super) fn tiers_of<'a>(specimen: &'a Specimen, lost: &mut Vec<String>) -> Cow<'a, Tiers> {
    let design = &specimen.design;
    if let Cut::Tiers(tiers) = &design.cut {
        return if tiers.has_named_meets() {
            Cow::Owned(tiers.with_names_in_meets())
        } else {
            Cow::Borrowed(tiers)
        };
    }
    let brilliant = design.cut.brilliant().is_some();
    if brilliant {
        lost.push("the format cannot hold the proportions, only the facets that follow from them".to_owned());
    }
    let facets = around_the_origin(specimen, lost);
    let of_gear = |&teeth: &i32| indexed(&facets, Gear { teeth, offset: 0.0 });
    let is_whole = |tiers: &Tiers| {
        tiers.tiers.iter().flat_map(|tier| &tier.facets).all(|facet| facet.index.fract() == 0.0)
    };
    let mut tiers = GEARS.iter().map(of_gear).find(is_whole).unwrap_or_else(|| of_gear(&GEARS[0]));
    // A round brilliant whose girdle facets are no multiple of 8 is eightfold all the same.
    let found = Symmetry::of(facets.iter().map(|(_, plane)| *plane), &Basis::FACE_UP, DVec3::Z);
    (tiers.symmetry, tiers.mirror) =
        if brilliant { (8, true) } else { (found.turns, found.mirror.is_some()) };
    tiers.headers = std::iter::once(&design.name).chain(&design.source).cloned().collect();
    Cow::Owned(tiers)
}

/// Lists the facets of a stone as tiers, with the first gear on whose teeth they lie, else the commonest; `None` for a body
/// that is not a stone between planes.
///
/// The tiers stand in the order in which cutters work, pavilion, girdle, crown and table, and have cutters' names: P1, G1,
/// C1, T, and K for the culet.
pub fn as_tiers(specimen: &Specimen) -> Option<Tiers> {
    specimen.stone().ok()?;
    let mut tiers = tiers_of(specimen, &mut vec![]).into_owned();
    let order = |tier: &Tier| match tier.zone() {
        TierZone::Pavilion => 0,
        TierZone::Culet => 1,
        TierZone::Girdle => 2,
        TierZone::Crown => 3,
        TierZone::Table => 4,
    };
    tiers.tiers.sort_by_key(order);
    let gear = f64::from(tiers.gear.abs());
    let tooth = |facet: &Indexed| facet.index.rem_euclid(gear);
    for tier in &mut tiers.tiers {
        tier.facets.sort_by(|a, b| tooth(a).total_cmp(&tooth(b)));
    }
    tiers.tiers.iter_mut().for_each(|tier| tier.rename(""));
    Some(tiers.with_names())
}

/// The reason why a body cannot be cut by tiers.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoTiers {
    /// A solid that is no convex stone between planes, for the given reason.
    #[error(
        "tiers are planes that cut a convex stone, and {0}; `convert` writes its shape as .stl or .glb, and `info` lists its \
         proportions"
    )]
    NotConvex(String),
    /// The tiers make no stone.
    #[error("cut by tiers: {0}")]
    Stone(#[from] SpecimenError),
}

/// Returns the stone cut by tiers: unchanged where its design has tiers, else with the tiers of [`as_tiers`] and the
/// meets that its geometry shows. No facet moves by more than rounding, except that a whole stone may be moved to the axis of its
/// symmetry.
///
/// # Errors
/// Fails where the body is no convex stone between planes, or where its tiers make none.
pub fn in_tiers(specimen: &Specimen) -> Result<Cow<'_, Specimen>, NoTiers> {
    if matches!(specimen.design.cut, Cut::Tiers(_)) {
        return Ok(Cow::Borrowed(specimen));
    }
    let why = || NoTiers::NotConvex(specimen.why_not_convex().unwrap_or_default());
    let tiers = as_tiers(specimen).ok_or_else(why)?;
    let cut = Cut::Tiers(tiers.with_own_meets());
    Ok(Cow::Owned(specimen.remade(Design { cut, ..specimen.design.clone() })?))
}

/// Returns the facets of a design, moved where tiers have no place for them: where the origin lies outside the stone, or beside
/// an axis about which the stone can be turned more often, as a trillion about the middle of its three sides.
fn around_the_origin(specimen: &Specimen, lost: &mut Vec<String>) -> Vec<(String, Plane)> {
    // The design of a specimen has been checked, so it has facets.
    let mut facets = specimen.design.facets().unwrap_or_default();
    let corners = facets_solid(&facets);
    let middle = corners.iter().sum::<DVec3>() / corners.len().max(1) as f64;
    let reach = corners.iter().map(|corner| corner.length()).fold(0.0, f64::max);
    let beside = middle.with_z(0.0);
    let turns = |shift: DVec3| {
        let planes = facets.iter().map(|(_, plane)| moved_back(plane, shift));
        Symmetry::of(planes, &Basis::FACE_UP, DVec3::Z).turns
    };
    let (shift, why) = if facets.iter().any(|(_, plane)| plane.offset < 0.0) {
        (middle, "cutters measure from a point inside it")
    } else if beside.length() > BESIDE_AXIS * reach && turns(beside) > turns(DVec3::ZERO) {
        (beside, "cutters measure from the axis about which it can be turned")
    } else {
        return facets;
    };
    facets.iter_mut().for_each(|(_, plane)| *plane = moved_back(plane, shift));
    let [x, y, z] = (-shift).to_array();
    lost.push(format!("the stone is moved by ({x:.6}, {y:.6}, {z:.6}), because {why}"));
    facets
}

/// Returns a plane of a stone that is moved so that a point of it comes to the origin.
fn moved_back(plane: &Plane, point: DVec3) -> Plane {
    Plane { offset: plane.offset - plane.normal.dot(point), ..*plane }
}

fn facets_solid(facets: &[(String, Plane)]) -> Vec<DVec3> {
    let planes: Vec<Plane> = facets.iter().map(|(_, plane)| *plane).collect();
    Polytope::from_planes(&planes).map(|solid| solid.vertices().to_vec()).unwrap_or_default()
}

/// Converts named planes to tiers, each of which has its name at its first facet alone.
fn indexed(facets: &[(String, Plane)], gear: Gear) -> Tiers {
    let mut stems: Vec<&str> = vec![];
    let pieces = facets.iter().map(|(name, plane)| {
        let stem = tier_stem(name);
        let number = stems.iter().position(|&other| other == stem).unwrap_or(stems.len());
        if number == stems.len() {
            stems.push(stem);
        }
        let setting = gear.setting(plane.normal, plane.offset.max(0.0));
        TierPiece {
            tier: number,
            setting,
            name: stem.to_owned(),
            instructions: String::new(),
            is_cut: true,
            frosting: 0.0,
        }
    });
    let mut tiers = Tiers { tiers: gathered(together(pieces)), ..gear.tiers() };
    named_once(&mut tiers.tiers);
    tiers
}

/// Moves facets of one name that are cut alike next to each other. Families list their facets around the stone, so that
/// facets of other names or settings lie between them.
fn together(pieces: impl Iterator<Item = TierPiece>) -> impl Iterator<Item = TierPiece> {
    let mut groups: Vec<Vec<TierPiece>> = vec![];
    for piece in pieces {
        let is_alike =
            |group: &&mut Vec<TierPiece>| group[0].tier == piece.tier && piece.is_cut_as(&group[0].setting);
        match groups.iter_mut().find(is_alike) {
            Some(group) => group.push(piece),
            None => groups.push(vec![piece]),
        }
    }
    groups.into_iter().flatten()
}

/// Returns the outlines of the facets that are cut, in their order, in the design's unit.
pub(in super::super) fn outlines(tiers: &Tiers) -> Vec<FacetOutline> {
    let cut = tiers.tiers.iter().filter(|tier| tier.is_cut);
    let planes: Vec<Plane> =
        cut.flat_map(|tier| tier.facets.iter().map(|facet| tiers.plane(tier, facet.index))).collect();
    let mut outlines: Vec<FacetOutline> = planes.iter().map(|plane| (*plane, Vec::new())).collect();
    if let Ok(solid) = Polytope::from_planes(&planes) {
        for facet in solid.facets() {
            outlines[facet.source].1 = solid.corners(facet).collect();
        }
    }
    outlines
}

/// Returns the one index that stands for the material: that of sodium light.
pub(in super::super) fn refractive_index(specimen: &Specimen, lost: &mut Vec<String>) -> f64 {
    if let MaterialRef::Index(index) = specimen.design.material {
        return index;
    }
    let index = fourteen_digits(specimen.material.index(line::SODIUM_D));
    let name = &specimen.material.name;
    lost.push(format!("of the material '{name}' only its index in sodium light is kept, {index:.4}"));
    index
}

/// Adds messages about the parts of a design that no cutters' file can hold. `name` is the name that a reader of the
/// file will give the design, if it comes from the file's lines.
pub(in super::super) fn untold(design: &Design, name: Option<&String>, lost: &mut Vec<String>) {
    if name.is_none_or(|name| name.trim() != design.name) {
        lost.push(format!("the name '{}' is not among the lines at the top", design.name));
    }
    if design.source.is_some() && matches!(design.cut, Cut::Tiers(_)) {
        lost.push("the format cannot hold where the design is published".to_owned());
    }
    if design.notes.is_some() {
        lost.push("the format cannot hold the design's notes".to_owned());
    }
    if design.diameter_mm != DEFAULT_DIAMETER_MM {
        lost.push(format!("the format cannot hold the diameter, {} mm", design.diameter_mm));
    }
}
