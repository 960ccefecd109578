//! Gradients: how the measures of a design change with its proportions, the angles of its tiers and its index.

use super::sweep::{Sweep, SweepError, SweptStone, VariedDesign, with_numbers};
use super::sweep_key::SweepKey;
use crate::cut::{Cut, Design, ScaleError, ScaledSide, SideSlope, Unit};
use crate::math::{Facet, Plane};
use crate::measure::{MeasureDerivatives, MeasureName};
use crate::scene::{Specimen, SpecimenError, Stone};
use crate::trace::Watch;
use glam::DVec3;
use std::collections::HashMap;

/// By how much an angle in degrees or a part in percent is changed to find how the planes change with it. With differences of
/// fourth order, the planes' changes are then right to about 1e-11.
const STEP: f64 = 0.01;

/// The least angle of a tier, in degrees, whose changes have a side. A table that was measured may lean by less.
pub const LEAST_TIER_DEG: f64 = 2.0 * STEP;

/// The same for ratios, which are near 1.
const RATIO_STEP: f64 = 1e-4;

/// How one measure changes with some numbers of a design.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasureGradient {
    /// The measure.
    pub name: MeasureName,
    /// Its value of the light that was followed: the least one, but for contrast, whose bounds are about it.
    pub value: f64,
    /// The change per unit of each number, in the order of the keys.
    pub per: Vec<f64>,
}

/// How the planes of a stone's facets change with some numbers of its design.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneChanges {
    /// For each number the change of each facet's normal and offset per unit; `None` of the index, which changes no plane.
    of_keys: Vec<Option<Vec<(DVec3, f64)>>>,
}

/// A stone's measures, with how some of them change.
#[derive(Debug, Clone, PartialEq)]
pub struct GradedStone {
    /// The measures and the weight.
    pub stone: SweptStone,
    /// How the wanted measures change, in the order in which they were wanted.
    pub gradients: Vec<MeasureGradient>,
}

/// The planes of a stone by the names of its facets.
type NamedPlanes = HashMap<String, (DVec3, f64)>;

impl PlaneChanges {
    /// Returns how the normal and the offset of each facet change per unit of a number, which is named by its place among the keys;
    /// `None` for the index, which changes no plane.
    pub fn of_key(&self, place: usize) -> Option<&[(DVec3, f64)]> {
        self.of_keys.get(place)?.as_deref()
    }
}

impl Sweep {
    /// Returns the measures of the design, which stands at no point of the axes, and how they change with numbers of it.
    ///
    /// The derivatives of the light are exact ([`MeasureName::derivatives`]), and so are those of the planes by the scale of a side. How
    /// the planes follow from other numbers is taken from central differences of fourth order of the planes alone.
    ///
    /// # Errors
    /// A [`SweepError`]: a number that the design does not have, a measure without derivatives, or a stone that cannot be
    /// made or traced.
    pub fn gradient(
        &self,
        keys: &[SweepKey],
        names: &[MeasureName],
        watch: Watch,
    ) -> Result<GradedStone, SweepError> {
        self.graded(&self.plane_changes(keys)?, names, watch)
    }

    /// Measures the design, which stands at no point of the axes, and returns how some measures change as the planes change.
    ///
    /// # Errors
    /// A [`SweepError`]: a measure without derivatives, or a stone that cannot be made or traced.
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

    /// Returns how the planes of the design, which stands at no point of the axes, change with some numbers.
    ///
    /// # Errors
    /// A [`SweepError`]: a number that the design does not have, or a facet that is not there on both sides of the design.
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

    /// Returns how each facet's normal and offset change per percent of the height of a side, exactly.
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

    /// Returns how each facet's normal and offset change with a number; `None` for the index, which changes no plane.
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
    // Where the planes are known without the solid that they bound, it is not built: that would take longer than all else.
    if let Cut::RoundBrilliant(_) | Cut::Planes(_) = &design.cut {
        let planes = design.facets().map_err(SpecimenError::from)?;
        return Ok(planes.iter().map(|(name, plane)| (name.clone(), of(plane))).collect());
    }
    let specimen = Specimen::new(design)?;
    let stone = specimen.stone().map_err(|why| SweepError::NoDerivative(why.to_string()))?;
    let planes = (0..).zip(stone.polytope.facets());
    Ok(planes.map(|(k, facet)| (stone.name(k).into_owned(), of(&facet.plane))).collect())
}

/// Returns the value of a proportion, and a step that is small beside it. One that is not there is found by the step.
fn proportion(cut: &Cut, key: &str) -> (f64, f64) {
    match cut.proportion(key) {
        Some(row) if row.unit == Unit::Ratio => ((row.get)(cut), RATIO_STEP),
        Some(row) => ((row.get)(cut), STEP),
        None => (0.0, STEP),
    }
}

/// Returns the angle of a tier, degrees above 0; 0 where there is none, which setting it finds.
fn tier(cut: &Cut, name: &str) -> f64 {
    cut.settings().iter().find(|setting| setting.name == name).map_or(0.0, |setting| setting.angle.abs())
}

/// Returns the distance of a tier, and a step that is small beside those of all tiers. One that is not there is found by the step.
fn distance(cut: &Cut, name: &str) -> (f64, f64) {
    let settings = cut.settings();
    let largest = settings.iter().map(|setting| setting.distance.abs()).fold(0.0, f64::max);
    let own = settings.iter().find(|setting| setting.name == name).map_or(0.0, |setting| setting.distance);
    (own, RATIO_STEP * if largest > 0.0 { largest } else { 1.0 })
}
