//! Scales one side of a stone along its axis: tan(new angle) = factor · tan(old angle) for all facets of the crown, or of the
//! pavilion, about the girdle's edge.
//!
//! That is a stretch of the side, so every point in which its facets meet is kept, the plan view stays, and the
//! girdle keeps its outline and its thickness. Source: the tangent ratio of R. Long and N. Steele, *Facet Design*,
//! vol. 1.

use super::facet_zones::EXACT;
use super::{Cut, Design, DesignError, Meet, Outline, Tier, Tiers};
use brillianteer_math::{Plane, Polytope, PolytopeError};
use glam::DVec3;
use std::fmt;

/// The range of factors of tangents.
pub(super) const FACTORS: std::ops::RangeInclusive<f64> = 0.1..=10.0;

/// The flattest and the steepest angle that a leaning facet may have afterwards, degrees from the girdle plane.
pub(super) const ANGLES_DEG: std::ops::RangeInclusive<f64> = 0.5..=89.5;

/// Angles that differ by less than this, degrees, differ by rounding.
const STILL_DEG: f64 = 1e-9;

/// The crown or the pavilion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ScaledSide {
    /// The facets that face up.
    Crown,
    /// The facets that face down.
    Pavilion,
}

impl ScaledSide {
    /// The sides, the upper one first.
    pub const ALL: [Self; 2] = [Self::Crown, Self::Pavilion];

    /// Returns the sign of the heights of normals on this side.
    fn sign(self) -> f64 {
        match self {
            Self::Crown => 1.0,
            Self::Pavilion => -1.0,
        }
    }

    /// Returns the height of the girdle's edge on this side.
    fn level(self, outline: &Outline) -> f64 {
        match self {
            Self::Crown => outline.girdle_top,
            Self::Pavilion => outline.girdle_bottom,
        }
    }

    /// Returns whether a facet of this normal belongs to the side; an upright one belongs to the girdle.
    fn has(self, normal: DVec3) -> bool {
        normal.z.abs() >= EXACT && normal.z.signum() == self.sign()
    }
}

impl fmt::Display for ScaledSide {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Crown => "crown",
            Self::Pavilion => "pavilion",
        })
    }
}

/// The reason why a side of a design cannot be scaled.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ScaleError {
    /// The design is at fault.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// The cut is a family, a mesh or a glass shape, so it lists neither tiers nor planes.
    #[error(
        "only a design of tiers or a list of planes has sides to scale; vary the proportions of another, such as crown_angle"
    )]
    NotScalable,
    /// The planes of the design enclose nothing.
    #[error("{0}")]
    Solid(String),
    /// The factor of the tangents lies outside 0.1 to 10.
    #[error("the factor {value} must be from {} to {}", FACTORS.start(), FACTORS.end())]
    Factor {
        /// The factor as given.
        value: f64,
    },
    /// A tier would become too flat or too steep.
    #[error(
        "tier '{tier}' would go from {before:.2} to {after:.2} degrees; from {} to {} are possible",
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
    /// The plane of a tier would leave the design's origin outside the stone.
    #[error(
        "tier '{tier}' would pass the design's origin, and its distance would be below 0; give a smaller change"
    )]
    Origin {
        /// The tier's name.
        tier: String,
    },
}

impl Cut {
    /// Returns whether [`scaled`] can scale the sides of the cut: it is a design of tiers or a list of planes.
    pub fn has_scalable_sides(&self) -> bool {
        matches!(self, Self::Tiers(_) | Self::Planes(_))
    }

    /// Returns the name of the first leaning tier of a side, whose slope [`Self::tangent_of_side`] uses; `None` for a
    /// cut that is no design of tiers, and where the side has no such tier.
    pub fn tier_of_side(&self, side: ScaledSide) -> Option<String> {
        let Self::Tiers(tiers) = self else { return None };
        let leans = |tier: &&Tier| leaning(side, tiers.plane(tier, 0.0).normal).is_some();
        tiers.tiers.iter().find(leans).map(|tier| tier.name().to_owned())
    }

    /// Returns the tangent of the slope of the first leaning facet of a side, which scaling multiplies by its factor; `None` where
    /// the cut lists no such facet.
    pub fn tangent_of_side(&self, side: ScaledSide) -> Option<f64> {
        match self {
            Self::Tiers(tiers) => {
                tiers.tiers.iter().find_map(|tier| leaning(side, tiers.plane(tier, 0.0).normal))
            }
            Self::Planes(planes) => {
                planes.iter().find_map(|(_, plane)| leaning(side, plane.normalized()?.normal))
            }
            _ => None,
        }
    }
}

/// Returns the tangent of the slope of a facet of a side; `None` for level facets and those of other sides.
fn leaning(side: ScaledSide, normal: DVec3) -> Option<f64> {
    let run = normal.truncate().length();
    (side.has(normal) && run >= EXACT).then(|| run / normal.z.abs())
}

/// Returns the cut of a design with one side scaled along the axis by a factor, 0.1 to 10.
///
/// # Errors
/// Fails for a cut without tiers or planes, for planes that enclose nothing, and where angles leave the possible
/// range.
pub fn scaled(design: &Design, side: ScaledSide, factor: f64) -> Result<Cut, ScaleError> {
    if !design.cut.has_scalable_sides() {
        return Err(ScaleError::NotScalable);
    }
    if !FACTORS.contains(&factor) {
        return Err(ScaleError::Factor { value: factor });
    }
    let facets = design.facets()?;
    let outline = Outline::of(&solid(design, &facets)?);
    let change = AngleChange::scale(side, &outline, factor);
    match &design.cut {
        Cut::Tiers(tiers) => Ok(Cut::Tiers(changed_tiers(tiers, &change)?)),
        Cut::Planes(planes) => {
            let names = planes.iter().map(|(name, _)| name.clone());
            Ok(Cut::Planes(changed_planes(names.zip(facets.iter().map(|(_, plane)| *plane)), &change)?))
        }
        _ => Err(ScaleError::NotScalable),
    }
}

/// The derivatives of planes with unit normals by the scale of one side of their stone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SideSlope {
    side: ScaledSide,
    /// The height about which the side is scaled.
    level: f64,
}

impl SideSlope {
    /// Returns the derivatives of the planes of a stone by the factor of one side, before it is scaled.
    pub fn of(side: ScaledSide, stone: &Polytope) -> Self {
        Self { side, level: side.level(&Outline::of(stone)) }
    }

    /// Returns the derivatives of a plane's normal and offset by the factor, at a factor of 1.
    ///
    /// With the slope θ, tan θ grows as the factor does, so that dθ = sin θ cos θ; the line in which the plane
    /// crosses the level does not move.
    pub fn of_plane(&self, plane: &Plane) -> (DVec3, f64) {
        let (across, rise) = (plane.normal.truncate(), plane.normal.z);
        let run = across.length();
        if !self.side.has(plane.normal) {
            return (DVec3::ZERO, 0.0);
        }
        if run < EXACT {
            return (DVec3::ZERO, plane.offset - self.level * rise);
        }
        let turn = run * rise.abs();
        let radius = (plane.offset - rise * self.level) / run;
        let normal = (across / run * rise.abs()).extend(-self.side.sign() * run);
        (normal * turn, (radius * rise.abs() - self.side.sign() * run * self.level) * turn)
    }
}

/// The change of the angles of one side.
#[derive(Clone, Copy)]
pub(super) struct AngleChange {
    /// The side that changes.
    pub side: ScaledSide,
    /// The height about which the side is stretched or its facets are turned.
    pub level: f64,
    /// The factor of the depth of level facets, and of all tangents where `shift` is `None`.
    pub factor: f64,
    /// The angle that is added, radians.
    pub shift: Option<f64>,
}

impl AngleChange {
    /// Makes the change that scales a side of a stone of this outline.
    pub fn scale(side: ScaledSide, outline: &Outline, factor: f64) -> Self {
        Self { side, level: side.level(outline), factor, shift: None }
    }

    /// Returns the changed plane of a facet of this side; `None` for other facets, and the angles before and after, in
    /// degrees, where the new one is not possible.
    fn plane(&self, plane: &Plane) -> Result<Option<Plane>, [f64; 2]> {
        let across = plane.normal.truncate();
        let (run, rise) = (across.length(), plane.normal.z);
        if !self.side.has(plane.normal) {
            return Ok(None);
        }
        if run < EXACT {
            let height = plane.offset / rise;
            let moved = self.level + self.factor * (height - self.level);
            return Ok(Some(Plane::new(plane.normal, moved * rise)));
        }
        let before = run.atan2(rise.abs());
        let after = match self.shift {
            Some(shift) => before + shift,
            None => (self.factor * before.tan()).atan(),
        };
        let [before_deg, after_deg] = [before, after].map(f64::to_degrees);
        // A facet that is beyond the range may stay where it is, or move back toward the range.
        let is_farther = (after_deg < *ANGLES_DEG.start() && after_deg < before_deg - STILL_DEG)
            || (after_deg > *ANGLES_DEG.end() && after_deg > before_deg + STILL_DEG);
        if is_farther {
            return Err([before_deg, after_deg]);
        }
        // The line in which the plane crosses the level does not move.
        let radius = (plane.offset - rise * self.level) / run;
        let (sin, cos) = after.sin_cos();
        let normal = (across / run * sin).extend(self.side.sign() * cos);
        Ok(Some(Plane::new(normal, radius * sin + self.side.sign() * cos * self.level)))
    }

    /// Returns a meet after the change. The angle of a centre point is one of the pavilion.
    fn meet(&self, meet: &Meet) -> Meet {
        match meet {
            Meet::CentreAngle(degrees) if self.side == ScaledSide::Pavilion && self.shift.is_none() => {
                Meet::CentreAngle((self.factor * degrees.to_radians().tan()).atan().to_degrees())
            }
            meet => meet.clone(),
        }
    }
}

/// Returns the solid of a design in its own unit.
pub(super) fn solid(design: &Design, facets: &[(String, Plane)]) -> Result<Polytope, ScaleError> {
    let planes: Vec<Plane> = facets.iter().map(|(_, plane)| *plane).collect();
    let solid = match design.cut {
        Cut::Tiers(_) => in_block(&planes),
        _ => Polytope::from_planes(&planes),
    };
    solid.map_err(|error| {
        ScaleError::Solid(error.message(|place| match facets.get(place) {
            Some((name, _)) => format!("'{name}'"),
            None => "the block".to_owned(),
        }))
    })
}

/// Returns the solid between the planes of a cutter's design. One that they leave open is closed by the block that it is cut
/// from.
pub(super) fn in_block(planes: &[Plane]) -> Result<Polytope, PolytopeError> {
    match Polytope::from_planes(planes) {
        Err(PolytopeError::Unbounded { .. }) => {
            let block = Tiers::block().map(|(_, plane)| plane);
            Polytope::from_planes(&planes.iter().copied().chain(block).collect::<Vec<_>>())
        }
        solid => solid,
    }
}

/// Returns a cutter's design after a change of one side.
pub(super) fn changed_tiers(tiers: &Tiers, change: &AngleChange) -> Result<Tiers, ScaleError> {
    let mut changed = tiers.clone();
    for (name, tier) in tiers.names().into_iter().zip(&mut changed.tiers) {
        let plane = tiers.plane(tier, 0.0);
        let refused = |[before, after]: [f64; 2]| ScaleError::Angle { tier: name.clone(), before, after };
        let plane = change.plane(&plane).map_err(refused)?;
        tier.meet = tier.meet.as_ref().map(|meet| change.meet(meet));
        let Some(plane) = plane else { continue };
        if plane.offset < 0.0 {
            return Err(ScaleError::Origin { tier: name });
        }
        if tier.angle != 0.0 {
            let angle = plane.normal.truncate().length().atan2(plane.normal.z.abs()).to_degrees();
            // A file may state a facet that faces down as one above 0 and beyond 90 degrees.
            tier.angle = angle.copysign(plane.normal.z);
        }
        tier.distance = plane.offset.copysign(tier.distance);
    }
    Ok(changed)
}

/// Returns a list of planes after a change of one side.
pub(super) fn changed_planes(
    planes: impl Iterator<Item = (String, Plane)>,
    change: &AngleChange,
) -> Result<Vec<(String, Plane)>, ScaleError> {
    let changed = |(name, plane): (String, Plane)| match change.plane(&plane) {
        Ok(changed) => Ok((name, changed.unwrap_or(plane))),
        Err([before, after]) => Err(ScaleError::Angle { tier: name, before, after }),
    };
    planes.map(changed).collect()
}

#[cfg(test)]
pub(super) mod tests;
