//! Fits a design to another material by a stated rule.
//!
//! Inside a stone the directions of reflected light follow from the facets' angles alone; the index decides which
//! reflections are total. So both rules move the pavilion, whose margin over the critical angle changes with the
//! material, and leave the crown, which light crosses at steep angles, far from that limit. The tangent ratio is that
//! of R. Long and N. Steele, *Facet Design*, vol. 1: tan(new angle) = factor · tan(old angle) for all tiers of one
//! side, which keeps the plan view. It is a stretch of that side along the axis, so it keeps every meet.

use super::facet_zones::EXACT;
use super::side_scale::{
    ANGLES_DEG, AngleChange, FACTORS, ScaleError, ScaledSide, changed_planes, changed_tiers, in_block, solid,
};
use super::{
    Crown, Cut, Design, DesignError, MaterialRef, Meet, Outline, Pavilion, RoundBrilliant, TierOutcome,
    Tiers, tier_stem,
};
use brillianteer_math::{Plane, Polytope, grouped};
use brillianteer_optics::{critical_angle, line};
use serde::{Deserialize, Serialize};

/// A vertex nearer to the lowest one than this, in units of the stone's depth, is at the culet.
const AT_CULET: f64 = 1e-6;

/// Planes nearer to one another than this, in their normals and in parts of their distance, differ only by rounding.
const ROUNDING: f64 = 1e-12;

/// A meet agrees with the old numbers where its distance differs from them by no more than this, in lengths of the
/// largest distance.
const BORNE_OUT: f64 = 1e-4;

/// The note about tiers that were turned about the girdle.
const TURNED: &str = "every pavilion tier turns by the same angle about the girdle's lower edge; meets of tiers with \
                      different angles open by a little, which an audit of the stone lists";

/// The note about tiers that were turned and whose meets were solved anew.
const MET_ANEW: &str =
    "every pavilion tier turns by the same angle, and its distance is solved anew from its meet";

/// The rule by which a design is fitted to another material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RetargetRule {
    /// Every tier of the pavilion turns by the difference of the critical angles, each about the line in which it
    /// crosses the height of the girdle's lower edge. Meets of tiers that had different angles open by a little.
    /// Tiers of a cutter's design then move to the points that they met before, where that leaves the stone with no
    /// facet less and fewer corners.
    CriticalAngle,
    /// The tangents of all pavilion angles are multiplied by a factor, 0.1 to 10. Without one, the main tier, the flattest of
    /// those that reach the lowest point, keeps its margin over the critical angle.
    PavilionRatio(Option<f64>),
    /// The tangents of all crown angles are multiplied by this factor, 0.1 to 10.
    CrownRatio(f64),
}

/// A tier before and after a design was fitted to another material.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RetargetedTier {
    /// The name that the facets share.
    pub name: String,
    /// The number of facets.
    pub facets: usize,
    /// The angle of the first facet from the girdle plane before, degrees; below 0 where it faces down.
    pub before_deg: f64,
    /// The angle afterwards, degrees.
    pub after_deg: f64,
}

/// A design that was fitted to another material.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Retargeted {
    /// The new design.
    pub design: Design,
    /// The critical angles of the old and the new material in sodium light, degrees.
    pub critical_deg: [f64; 2],
    /// The name of the main tier, the flattest of the pavilion tiers that reach the lowest point.
    pub main: String,
    /// The factor of the tangents; for a shift of angles, that of the main tier.
    pub factor: f64,
    /// The tiers that changed.
    pub tiers: Vec<RetargetedTier>,
    /// Notes for the user on the method, in sentences.
    pub notes: Vec<String>,
}

/// The reason why a design cannot be fitted to another material.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RetargetError {
    /// The design is at fault, before or afterwards.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// A body that is not convex and between planes, so that no tier has an angle to change.
    #[error(
        "only convex stones between planes have tiers whose angles can follow a material; a heart is a mesh that is not \
         convex, and a glass shape is curved: change the angles in the cut file, and compare its measures in both materials"
    )]
    NotConvex,
    /// The planes enclose nothing, the factor is out of range, or a plane would pass the design's origin.
    #[error(transparent)]
    Scale(ScaleError),
    /// A material without total reflection.
    #[error("{material} has no critical angle at 589.3 nm; give a material with an index above 1")]
    NoCriticalAngle {
        /// The material's name.
        material: String,
    },
    /// A stone without leaning facets that face down.
    #[error("the stone has no pavilion facets whose angles could follow the material")]
    NoPavilion,
    /// A tier that would become too flat or too steep.
    #[error(
        "tier '{tier}' would go from {before:.2} to {after:.2} degrees; from {} to {} are possible: try the tangent ratio, or a \
         material nearer to the old one",
        ANGLES_DEG.start(),
        ANGLES_DEG.end()
    )]
    Angle {
        /// The tier's name.
        tier: String,
        /// Its angle before, degrees.
        before: f64,
        /// Its angle afterwards, degrees.
        after: f64,
    },
}

impl From<ScaleError> for RetargetError {
    fn from(error: ScaleError) -> Self {
        match error {
            ScaleError::Design(error) => error.into(),
            ScaleError::Angle { tier, before, after } => Self::Angle { tier, before, after },
            error => Self::Scale(error),
        }
    }
}

/// Fits a design to another material.
///
/// The size, the name and all other content of the design stay; a sentence about the change is added to its notes. A
/// round brilliant changes by its proportions: the mains by the rule, and the lower halves as their length demands,
/// which keeps every meet under either rule. Any other cut whose facets follow from numbers becomes a list of planes.
///
/// # Errors
/// Fails for a design without planes or a pavilion, for a material without a critical angle, and where angles leave
/// the possible range.
pub fn retarget(
    design: &Design,
    material: MaterialRef,
    rule: RetargetRule,
) -> Result<Retargeted, RetargetError> {
    let facets = design.facets().map_err(|error| match error {
        DesignError::NotConvex(_) => RetargetError::NotConvex,
        error => error.into(),
    })?;
    let solid = solid(design, &facets)?;
    let critical = [&design.material, &material].map(critical_of);
    let [old, new] = critical;
    let critical = [old?, new?];
    let (main, main_angle) = main_tier(&solid, &facets).ok_or(RetargetError::NoPavilion)?;
    let change = change(rule, &solid, main_angle, critical)?;
    let mut notes = vec![];
    let cut = match &design.cut {
        Cut::RoundBrilliant(brilliant) => {
            notes.push("the proportions change, so that all facets still meet".to_owned());
            Cut::RoundBrilliant(changed_brilliant(brilliant, &change))
        }
        Cut::Tiers(tiers) => {
            let turned = changed_tiers(tiers, &change)?;
            let met = change.shift.and_then(|_| met_anew(tiers, &turned));
            if change.shift.is_some() {
                notes.push(if met.is_some() { MET_ANEW } else { TURNED }.to_owned());
            }
            Cut::Tiers(met.unwrap_or(turned))
        }
        Cut::Planes(planes) => {
            let names = planes.iter().map(|(name, _)| name.clone());
            Cut::Planes(changed_planes(names.zip(facets.iter().map(|(_, plane)| *plane)), &change)?)
        }
        _ => {
            notes.push(
                "the facets become a list of planes, without the proportions they came from".to_owned(),
            );
            Cut::Planes(changed_planes(facets.iter().cloned(), &change)?)
        }
    };
    if change.shift.is_some() && !matches!(cut, Cut::RoundBrilliant(_) | Cut::Tiers(_)) {
        notes.push(TURNED.to_owned());
    }
    if change.side == ScaledSide::Pavilion {
        notes.push("the crown stays as it is".to_owned());
    }
    let mut retargeted = Design { material, cut, ..design.clone() };
    retargeted.notes = Some(noted(design, &retargeted, rule, change.factor));
    retargeted.check()?;
    let tiers = compared(&facets, &retargeted.facets()?);
    let critical_deg = critical.map(f64::to_degrees);
    Ok(Retargeted { design: retargeted, critical_deg, main, factor: change.factor, tiers, notes })
}

/// Returns a material's critical angle in sodium light, radians.
fn critical_of(material: &MaterialRef) -> Result<f64, RetargetError> {
    let material = material.material().map_err(DesignError::from)?;
    let index = material.dispersion.try_index(line::SODIUM_D).ok();
    index.and_then(critical_angle).ok_or(RetargetError::NoCriticalAngle { material: material.name })
}

/// Returns the name and the angle, radians, of the flattest leaning facet that reaches the stone's lowest point.
fn main_tier(solid: &Polytope, facets: &[(String, Plane)]) -> Option<(String, f64)> {
    let (low, high) = solid.bounds();
    let floor = low.z + AT_CULET * (high.z - low.z);
    let angle = |normal: glam::DVec3| normal.truncate().length().atan2(-normal.z);
    let reaching = solid.facets().iter().filter(|facet| {
        let normal = facet.plane.normal;
        let leans = normal.z < -EXACT && normal.truncate().length() >= EXACT;
        leans && solid.corners(facet).any(|corner| corner.z <= floor)
    });
    let main = reaching.min_by(|a, b| angle(a.plane.normal).total_cmp(&angle(b.plane.normal)))?;
    let name = facets.get(main.source).map_or("block", |(name, _)| tier_stem(name));
    Some((name.to_owned(), angle(main.plane.normal)))
}

fn change(
    rule: RetargetRule,
    solid: &Polytope,
    main_angle: f64,
    [old, new]: [f64; 2],
) -> Result<AngleChange, RetargetError> {
    let outline = Outline::of(solid);
    let margin = (main_angle + new - old).tan() / main_angle.tan();
    let (side, factor, shift) = match rule {
        RetargetRule::CriticalAngle => (ScaledSide::Pavilion, margin, Some(new - old)),
        RetargetRule::PavilionRatio(factor) => (ScaledSide::Pavilion, factor.unwrap_or(margin), None),
        RetargetRule::CrownRatio(factor) => (ScaledSide::Crown, factor, None),
    };
    if !FACTORS.contains(&factor) {
        return Err(ScaleError::Factor { value: factor }.into());
    }
    Ok(AngleChange { shift, ..AngleChange::scale(side, &outline, factor) })
}

fn changed_brilliant(given: &RoundBrilliant, change: &AngleChange) -> RoundBrilliant {
    let factor = change.factor;
    let angle = |degrees: f64| (factor * degrees.to_radians().tan()).atan().to_degrees();
    let mut changed = *given;
    if change.side == ScaledSide::Crown {
        changed.crown = match given.crown {
            Crown::Angle(degrees) => Crown::Angle(angle(degrees)),
            Crown::Height(percent) => Crown::Height(factor * percent),
        };
    } else {
        changed.pavilion = match given.pavilion {
            Pavilion::Angle(degrees) => Pavilion::Angle(angle(degrees)),
            Pavilion::Depth(percent) => Pavilion::Depth(factor * percent),
        };
    }
    changed
}

/// Returns a design of turned tiers with each of them at the point that it met before; `None` where that does not
/// improve the stone: where a facet is lost, or no meet closes, so that there are as many corners as before.
///
/// A meet that does not agree with the old numbers is not followed, and of several points only the first is, so that
/// the angle stays.
fn met_anew(before: &Tiers, turned: &Tiers) -> Option<Tiers> {
    let met = before.with_stated_meets().with_found_meets();
    let borne = met.checked_meets();
    let largest = before.tiers.iter().map(|tier| tier.distance.abs()).fold(0.0, f64::max);
    let mut design = turned.clone();
    for (place, tier) in design.tiers.iter_mut().enumerate() {
        let (old, checked) = (&before.tiers[place], &borne.tiers.tiers[place]);
        let is_borne_out = borne.outcomes[place] == TierOutcome::Solved
            && (checked.distance - old.distance).abs() <= BORNE_OUT * largest;
        let first = met.tiers[place].meet.as_ref().and_then(Meet::first_point);
        tier.meet = first.filter(|_| is_borne_out && tier.angle != old.angle);
    }
    let mut solved = design.solved().tiers;
    for (tier, old) in solved.tiers.iter_mut().zip(&before.tiers) {
        tier.meet.clone_from(&old.meet);
    }
    let counted = |tiers: &Tiers| {
        let planes: Vec<Plane> = tiers.facets().into_iter().map(|(_, plane)| plane).collect();
        let solid = in_block(&planes).ok()?;
        Some((solid.facets().len(), solid.vertices().len()))
    };
    let ((facets, corners), (left, open)) = (counted(&solved)?, counted(turned)?);
    (facets >= left && corners < open).then_some(solved)
}

/// Returns the notes of the new design: those of the old one, and a sentence about the change.
fn noted(old: &Design, new: &Design, rule: RetargetRule, factor: f64) -> String {
    let called = |design: &Design| design.material.material().map_or_else(|_| "?".to_owned(), |m| m.name);
    let by = match rule {
        RetargetRule::CriticalAngle => "the difference of the critical angles".to_owned(),
        RetargetRule::PavilionRatio(_) => format!("a tangent ratio of {factor:.4} of the pavilion"),
        RetargetRule::CrownRatio(_) => format!("a tangent ratio of {factor:.4} of the crown"),
    };
    let sentence = format!("Fitted from {} to {} by {by}.", called(old), called(new));
    match old.notes.as_deref().map(str::trim).filter(|notes| !notes.is_empty()) {
        Some(notes) => format!("{notes} {sentence}"),
        None => sentence,
    }
}

/// Angles nearer to one another than this, degrees, are those of one tier: meshes and lists of planes are rounded.
const SAME_ANGLE_DEG: f64 = 1e-3;

/// Returns the tiers in which a facet changed by more than rounding. Facets of one name but of different angles are
/// different tiers.
fn compared(before: &[(String, Plane)], after: &[(String, Plane)]) -> Vec<RetargetedTier> {
    let angle = |plane: &Plane| {
        let normal = plane.normal;
        normal.truncate().length().atan2(normal.z.abs()).to_degrees().copysign(normal.z)
    };
    let pairs = before.iter().zip(after);
    let tiers = grouped(pairs, |(a, _), (b, _)| {
        tier_stem(&a.0) == tier_stem(&b.0) && (angle(&a.1) - angle(&b.1)).abs() < SAME_ANGLE_DEG
    });
    let differs = |(a, b): &(&(String, Plane), &(String, Plane))| {
        !a.1.normal.abs_diff_eq(b.1.normal, ROUNDING)
            || (a.1.offset - b.1.offset).abs() > ROUNDING * a.1.offset.abs()
    };
    let changed = tiers.into_iter().filter(|tier| tier.iter().any(differs));
    let reports = changed.map(|tier| {
        let ((name, before), (_, after)) = tier[0];
        RetargetedTier {
            name: tier_stem(name).to_owned(),
            facets: tier.len(),
            before_deg: angle(before),
            after_deg: angle(after),
        }
    });
    reports.collect()
}

#[cfg(test)]
mod tests;
