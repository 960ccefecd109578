//! Gradients: the derivatives of a design's measures by its proportions, the angles of its tiers and its index.

use super::sweep::{Sweep, SweepError, SweptStone, VariedDesign, with_numbers};
use super::sweep_key::SweepKey;
use crate::cut::{Cut, Design, ScaleError, ScaledSide, SideSlope, Unit};
use crate::math::{Facet, Plane};
use crate::measure::{MeasureDerivatives, MeasureName};
use crate::scene::{Specimen, SpecimenError, Stone};
use crate::trace::Watch;
use glam::DVec3;
use std::collections::HashMap;

/// The change of an angle in degrees or of a part in percent by which the derivative of the planes is found. With
/// differences of fourth order, it is then right to about 1e-11.
const STEP: f64 = 0.01;

/// The least angle of a tier, in degrees, that can be changed without crossing 0. A table that was measured may lean
/// by less.
pub const LEAST_TIER_DEG: f64 = 2.0 * STEP;

/// The same change of ratios, which are near 1.
const RATIO_STEP: f64 = 1e-4;

/// The derivatives of one measure by some numbers of a design.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasureGradient {
    /// The measure.
    pub name: MeasureName,
    /// Its value for the traced light: the least one, except for contrast, whose bounds lie on both sides of it.
    pub value: f64,
    /// The derivative by each number, per its unit, in the order of the keys.
    pub per: Vec<f64>,
}

/// The derivatives of the planes of a stone's facets by some numbers of its design.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneChanges {
    /// For each number, the derivative of each facet's normal and offset, per its unit; `None` for the index, which
    /// changes no plane.
    of_keys: Vec<Option<Vec<(DVec3, f64)>>>,
}

/// A stone's measures, with the derivatives of some of them.
#[derive(Debug, Clone, PartialEq)]
pub struct GradedStone {
    /// The measures and the weight.
    pub stone: SweptStone,
    /// The derivatives of the measures that were requested, in that order.
    pub gradients: Vec<MeasureGradient>,
}

/// The planes of a stone by the names of its facets.
type NamedPlanes = HashMap<String, (DVec3, f64)>;

impl PlaneChanges {
    /// Returns the derivatives of the normal and the offset of each facet by a number, whose place among the keys is
    /// `place`; `None` for the index, which changes no plane.
    pub fn of_key(&self, place: usize) -> Option<&[(DVec3, f64)]> {
        self.of_keys.get(place)?.as_deref()
    }
}

impl Sweep {
    /// Returns the measures of the design itself, which belongs to no point of the axes, and their derivatives by its
    /// numbers.
    ///
    /// The derivatives of the light are exact ([`MeasureName::derivatives`]), and so are those of the planes by the
    /// scale of a side. The derivatives of the planes by other numbers are central differences of fourth order.
    ///
    /// # Errors
    /// Fails with a [`SweepError`] for a number that the design does not have, a measure without derivatives, or a stone
    /// that cannot be made or traced.
    pub fn gradient(
        &self,
        keys: &[SweepKey],
        names: &[MeasureName],
        watch: Watch,
    ) -> Result<GradedStone, SweepError> {
        self.graded(&self.plane_changes(keys)?, names, watch)
    }

    /// Measures the design itself, which belongs to no point of the axes, and returns the derivatives of some
    /// measures for changes of the planes.
    ///
    /// # Errors
    /// Fails with a [`SweepError`] for a measure without derivatives, or a stone that cannot be made or traced.
    pub fn graded(
        &self,
        changes: &PlaneChanges,
        names: &[MeasureName],
        watch: Watch,
    ) -> Result<GradedStone, SweepError> {
        let (taken, specimen) = self.taken(self.start(), names.to_vec(), watch)?;
        let of_name = |(name, found): (&MeasureName, Option<MeasureDerivatives>)| {
            let found = found.ok_or_else(|| {
                SweepError::NoDerivative(format!(
                    "{name} has no derivatives; give a return, leakage, windowing, obstruction, fire, absorbed, \
                     extinction or contrast"
                ))
            })?;
            let by_key = |changes: &Option<Vec<(DVec3, f64)>>| match changes {
                Some(changes) => found.derivatives.along(changes.iter().copied()),
                None => found.derivatives.index,
            };
            let per = changes.of_keys.iter().map(by_key).collect();
            Ok(MeasureGradient { name: *name, value: found.value, per })
        };
        let gradients: Result<_, SweepError> = names.iter().zip(taken.derivatives).map(of_name).collect();
        Ok(GradedStone { stone: SweptStone::of(taken.measures, specimen), gradients: gradients? })
    }

    /// Returns the derivatives of the planes of the design itself, which belongs to no point of the axes, by some
    /// numbers.
    ///
    /// # Errors
    /// Fails with a [`SweepError`] for a number that the design does not have, or a facet that is not there on both
    /// sides of the design.
    pub fn plane_changes(&self, keys: &[SweepKey]) -> Result<PlaneChanges, SweepError> {
        let start = self.start();
        let specimen = Specimen::new(self.design.clone())?;
        let why = "only convex stones between planes have derivatives of their light, and this is none";
        let stone = specimen.stone().map_err(|_| SweepError::NoDerivative(why.to_owned()))?;
        let facets: Vec<String> =
            (0..stone.polytope.facets().len() as u32).map(|facet| stone.name(facet).into_owned()).collect();
        let of_key = |key: &SweepKey| match key {
            SweepKey::Scale(side) => self.changes_by_scale(*side, stone).map(Some),
            key => self.changes_by(&start, key, &facets),
        };
        Ok(PlaneChanges { of_keys: keys.iter().map(of_key).collect::<Result<_, _>>()? })
    }

    /// Returns the exact derivatives of each facet's normal and offset by the height of a side, per percent.
    fn changes_by_scale(&self, side: ScaledSide, stone: &Stone) -> Result<Vec<(DVec3, f64)>, SweepError> {
        if !self.design.cut.has_scalable_sides() {
            let (key, error) = (SweepKey::Scale(side).to_string(), ScaleError::NotScalable);
            return Err(SweepError::Scale { key, error });
        }
        let slope = SideSlope::of(side, &stone.polytope);
        // The block that closes an open design stays as it is.
        let given = self.design.facets().map_err(SpecimenError::from)?.len();
        let change = |facet: &Facet| {
            if facet.source >= given {
                return (DVec3::ZERO, 0.0);
            }
            let (normal, offset) = slope.of_plane(&facet.plane);
            (0.01 * normal, 0.01 * offset)
        };
        Ok(stone.polytope.facets().iter().map(change).collect())
    }

    /// Returns the derivatives of each facet's normal and offset by a number; `None` for the index, which changes no
    /// plane.
    fn changes_by(
        &self,
        start: &VariedDesign,
        key: &SweepKey,
        facets: &[String],
    ) -> Result<Option<Vec<(DVec3, f64)>>, SweepError> {
        if let SweepKey::Tier(name) = key
            && start
                .design
                .cut
                .settings()
                .iter()
                .any(|own| own.name == *name && own.angle.abs() < LEAST_TIER_DEG)
        {
            let why = format!("{key} has no derivatives: the tier lies level, and its angle has no side");
            return Err(SweepError::NoDerivative(why));
        }
        let (value, step) = match key {
            SweepKey::Index => return Ok(None),
            SweepKey::Proportion(name) => proportion(&start.design.cut, name),
            SweepKey::Tier(name) => (tier(&start.design.cut, name), STEP),
            SweepKey::Distance(name) => distance(&start.design.cut, name),
            other => {
                let why = format!(
                    "{other} has no derivatives; give a proportion, a tier, a distance, a scale or index"
                );
                return Err(SweepError::NoDerivative(why));
            }
        };
        let at = |by: f64| named_planes(with_numbers(&self.design, [(key, value + by)])?);
        let [far_below, below, above, far_above] = [at(-2.0 * step)?, at(-step)?, at(step)?, at(2.0 * step)?];
        let change = |name: &String| {
            let of = |planes: &NamedPlanes| planes.get(name).copied();
            let all = (of(&far_below), of(&below), of(&above), of(&far_above));
            let (Some(a), Some(b), Some(c), Some(d)) = all else {
                return Err(SweepError::FacetComes { facet: name.clone(), key: key.to_string() });
            };
            let per = 1.0 / (12.0 * step);
            Ok((((c.0 - b.0) * 8.0 - (d.0 - a.0)) * per, ((c.1 - b.1) * 8.0 - (d.1 - a.1)) * per))
        };
        facets.iter().map(change).collect::<Result<Vec<_>, _>>().map(Some)
    }
}

/// Returns the planes of a design's facets by their names.
fn named_planes(design: Design) -> Result<NamedPlanes, SweepError> {
    let of = |plane: &Plane| (plane.normal, plane.offset);
    // Where the planes follow without the solid that they bound, the solid is not built: that would take longer than
    // all other work.
    if let Cut::RoundBrilliant(_) | Cut::Planes(_) = &design.cut {
        let planes = design.facets().map_err(SpecimenError::from)?;
        return Ok(planes.iter().map(|(name, plane)| (name.clone(), of(plane))).collect());
    }
    let specimen = Specimen::new(design)?;
    let stone = specimen.stone().map_err(|why| SweepError::NoDerivative(why.to_string()))?;
    let planes = (0..).zip(stone.polytope.facets());
    Ok(planes.map(|(k, facet)| (stone.name(k).into_owned(), of(&facet.plane))).collect())
}

/// Returns the value of a proportion, and a step that is small beside it. The step reports the fault where the cut
/// lacks the proportion.
fn proportion(cut: &Cut, key: &str) -> (f64, f64) {
    match cut.proportion(key) {
        Some(row) if row.unit == Unit::Ratio => ((row.get)(cut), RATIO_STEP),
        Some(row) => ((row.get)(cut), STEP),
        None => (0.0, STEP),
    }
}

/// Returns the angle of a tier, degrees above 0; 0 where the tier is missing, which setting its angle then reports.
fn tier(cut: &Cut, name: &str) -> f64 {
    cut.settings().iter().find(|setting| setting.name == name).map_or(0.0, |setting| setting.angle.abs())
}

/// Returns the distance of a tier, and a step that is small beside those of all tiers. The step reports the fault
/// where the tier is missing.
fn distance(cut: &Cut, name: &str) -> (f64, f64) {
    let settings = cut.settings();
    let largest = settings.iter().map(|setting| setting.distance.abs()).fold(0.0, f64::max);
    let own = settings.iter().find(|setting| setting.name == name).map_or(0.0, |setting| setting.distance);
    (own, RATIO_STEP * if largest > 0.0 { largest } else { 1.0 })
}
