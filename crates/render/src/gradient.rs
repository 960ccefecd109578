//! Gradients: the derivatives of a design's measures by its proportions, the angles of its tiers and its index.

use super::sweep::{Sweep, SweepError, SweptStone, VariedDesign, with_numbers};
use super::sweep_key::SweepKey;
use brillianteer_base::{ByName, Unit, Watch};
use brillianteer_cut::{Cut, Design, ScaleError, ScaledSide, SideSlope};
use brillianteer_math::{Facet, Plane};
use brillianteer_measure::{Interval, MeasureDerivatives, MeasureName};
use brillianteer_scene::{Specimen, SpecimenError, Stone};
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// The change of an angle in degrees or of a part in percent by which the derivative of the planes is found. With
/// differences of fourth order, it is then right to about 1e-11.
const STEP: f64 = 0.01;

/// The least angle of a tier, in degrees, that can be changed without crossing 0. A table that was measured may lean
/// by less.
pub const LEAST_TIER_DEG: f64 = 2.0 * STEP;

/// The same change of ratios, which are near 1.
const RATIO_STEP: f64 = 1e-4;

/// Two derivatives of the planes, one from each side of a value, count as one where they differ by no more than this part of
/// the greatest. Rounding and the step make less than a hundredth of it.
const KINK: f64 = 1e-5;

/// Derivatives of planes that differ by no more than this, per unit of a number, differ by rounding.
const ROUNDING: f64 = 1e-9;

/// The derivatives of one measure by some numbers of a design.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MeasureGradient {
    /// The measure.
    pub name: MeasureName,
    /// Its value for the traced light: the least one, except for contrast, whose bounds lie on both sides of it.
    pub value: f64,
    /// The derivative by each number, per its unit, in the order of the keys. At a kink of the planes it is the mean of
    /// both sides.
    pub per: Vec<f64>,
    /// For each number at whose value the planes have a kink, the derivatives below the value and above it.
    pub sides: Vec<Option<[f64; 2]>>,
}

/// The derivatives of the planes of a stone's facets by some numbers of its design.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneChanges {
    /// The derivatives by each number; `None` for the index, which changes no plane.
    of_keys: Vec<Option<KeyChanges>>,
}

/// The derivative of each facet's normal and offset by a number, per its unit.
#[derive(Debug, Clone, PartialEq)]
struct KeyChanges {
    /// The derivatives at the value; at a kink, the means of both sides.
    middle: Vec<(DVec3, f64)>,
    /// The derivatives below the value and above it, where the planes have a kink there.
    sides: Option<[Vec<(DVec3, f64)>; 2]>,
}

/// A stone's measures, with the derivatives of some of them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GradedStone {
    /// The measures and the weight.
    pub stone: SweptStone,
    /// The derivatives of the measures that were requested, in that order.
    pub gradients: Vec<MeasureGradient>,
}

/// A measure and its derivatives, by the names of the numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MeasureSlopes {
    /// The measure with its bound; `None` where the stone has no such measure.
    pub value: Option<Interval>,
    /// The derivative by each number, per its unit, in the light that was followed.
    pub per: ByName<MeasureSlope>,
}

/// The derivative of a measure by a number, per the number's unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum MeasureSlope {
    /// The derivative at the value.
    Smooth(f64),
    /// The derivatives on both sides of a value at which the stone's planes have a kink.
    Kink {
        /// The derivative below the value.
        below: f64,
        /// The derivative above the value.
        above: f64,
    },
}

impl GradedStone {
    /// Returns the measures and their derivatives by name; `keys` are those by which they were taken.
    pub fn by_name(&self, keys: &[SweepKey]) -> ByName<MeasureSlopes> {
        let slopes = |each: &MeasureGradient| {
            let slope = |place: usize| match each.sides[place] {
                Some([below, above]) => MeasureSlope::Kink { below, above },
                None => MeasureSlope::Smooth(each.per[place]),
            };
            let per = keys.iter().enumerate().map(|(place, key)| (key.to_string(), slope(place))).collect();
            MeasureSlopes { value: each.name.of(&self.stone.measures), per }
        };
        self.gradients.iter().map(|each| (each.name.to_string(), slopes(each))).collect()
    }
}

/// The planes of a stone by the names of its facets.
type NamedPlanes = HashMap<String, (DVec3, f64)>;

impl PlaneChanges {
    /// Returns the derivatives of the normal and the offset of each facet by a number, whose place among the keys is
    /// `place`; `None` for the index, which changes no plane. At a kink they are the means of both sides.
    pub fn of_key(&self, place: usize) -> Option<&[(DVec3, f64)]> {
        Some(&self.of_keys.get(place)?.as_ref()?.middle)
    }
}

impl Sweep {
    /// Returns the measures of the design itself, which belongs to no point of the axes, and their derivatives by its
    /// numbers.
    ///
    /// The derivatives of the light are exact ([`MeasureName::derivatives`]), and so are those of the planes by the
    /// scale of a side. The derivatives of the planes by other numbers are central differences of fourth order. Where the
    /// planes have a kink, as those of an Asscher at a length to width of 1, where its keel turns, there is a derivative for each
    /// side of the value as well; a kink nearer than twice the step of the differences counts as one at the value. Kinks of the
    /// light itself are not looked for.
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
        self.graded(&self.plane_changes(keys)?, (names, 1), watch)
    }

    /// Measures the design itself, which belongs to no point of the axes, and returns the derivatives of some
    /// measures for changes of the planes. It takes one part of so many of the memory of beams.
    ///
    /// # Errors
    /// Fails with a [`SweepError`] for a measure without derivatives, or a stone that cannot be made or traced.
    pub fn graded(
        &self,
        changes: &PlaneChanges,
        (names, parts): (&[MeasureName], usize),
        watch: Watch,
    ) -> Result<GradedStone, SweepError> {
        let (taken, specimen) = self.taken(self.start(), (names.to_vec(), parts), watch)?;
        let of_name = |(name, found): (&MeasureName, Option<MeasureDerivatives>)| {
            let found = found.ok_or_else(|| {
                SweepError::NoDerivative(format!(
                    "{name} has no derivatives; give a return, leakage, windowing, obstruction, fire, absorbed, \
                     extinction or contrast"
                ))
            })?;
            let along = |changes: &[(DVec3, f64)]| found.derivatives.along(changes.iter().copied());
            let by_key = |changes: &Option<KeyChanges>| {
                changes.as_ref().map_or(found.derivatives.index, |changes| along(&changes.middle))
            };
            let by_sides = |changes: &Option<KeyChanges>| {
                let sides = changes.as_ref()?.sides.as_ref()?;
                Some(sides.each_ref().map(|side| along(side)))
            };
            let per = changes.of_keys.iter().map(by_key).collect();
            let sides = changes.of_keys.iter().map(by_sides).collect();
            Ok(MeasureGradient { name: *name, value: found.value, per, sides })
        };
        let gradients: Result<_, SweepError> = names.iter().zip(taken.derivatives).map(of_name).collect();
        Ok(GradedStone {
            stone: SweptStone::of(taken.measures, &self.settings, specimen),
            gradients: gradients?,
        })
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
        let why = || specimen.why_not_convex().unwrap_or_default();
        let stone = specimen.stone().map_err(|_| SweepError::NotConvex(why()))?;
        let smooth = |middle| Some(KeyChanges { middle, sides: None });
        let of_key = |key: &SweepKey| match key {
            SweepKey::Scale(side) => self.changes_by_scale(*side, stone).map(smooth),
            key => self.changes_by(&start, key, stone),
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
        stone: &Stone,
    ) -> Result<Option<KeyChanges>, SweepError> {
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
        let beside = [at(-2.0 * step)?, at(-step)?, at(step)?, at(2.0 * step)?];
        let mut changes = vec![];
        for (place, facet) in (0..).zip(stone.polytope.facets()) {
            let name = stone.name(place);
            let [a, b, c, d] = beside.each_ref().map(|planes| planes.get(&*name).copied());
            let (Some(a), Some(b), Some(c), Some(d)) = (a, b, c, d) else {
                return Err(SweepError::FacetComes { facet: name.into_owned(), key: key.to_string() });
            };
            let own = (facet.plane.normal, facet.plane.offset);
            changes.push(PlaneSlopes::of([a, b, own, c, d], step));
        }
        Ok(Some(KeyChanges::of(&changes)))
    }
}

/// The derivative of a plane by a number: at its value, below it and above it.
struct PlaneSlopes {
    middle: (DVec3, f64),
    sides: [(DVec3, f64); 2],
}

impl PlaneSlopes {
    /// Takes the derivatives from the planes at two steps below the value, one step below, the value, one step above and
    /// two: a central difference of fourth order, and one of second order on each side.
    fn of([a, b, own, c, d]: [(DVec3, f64); 5], step: f64) -> Self {
        let sum = |terms: [(f64, (DVec3, f64)); 3], per: f64| {
            let normal = terms.iter().map(|(factor, plane)| *factor * plane.0).sum::<DVec3>();
            let offset = terms.iter().map(|(factor, plane)| factor * plane.1).sum::<f64>();
            (normal / per, offset / per)
        };
        let per = 12.0 * step;
        let middle = (((c.0 - b.0) * 8.0 - (d.0 - a.0)) / per, ((c.1 - b.1) * 8.0 - (d.1 - a.1)) / per);
        let below = sum([(3.0, own), (-4.0, b), (1.0, a)], 2.0 * step);
        let above = sum([(-3.0, own), (4.0, c), (-1.0, d)], 2.0 * step);
        Self { middle, sides: [below, above] }
    }
}

impl KeyChanges {
    /// Takes the derivatives of all facets. They have sides where those of any facet differ there.
    fn of(changes: &[PlaneSlopes]) -> Self {
        let size = |(normal, offset): (DVec3, f64)| normal.length().max(offset.abs());
        let greatest = changes.iter().flat_map(|each| each.sides).map(size).fold(0.0, f64::max);
        let apart = |PlaneSlopes { sides: [below, above], .. }: &PlaneSlopes| {
            size((above.0 - below.0, above.1 - below.1))
        };
        let is_kink = changes.iter().any(|each| apart(each) > (KINK * greatest).max(ROUNDING));
        let side = |place: usize| changes.iter().map(|each| each.sides[place]).collect();
        Self {
            middle: changes.iter().map(|each| each.middle).collect(),
            sides: is_kink.then(|| [0, 1].map(side)),
        }
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
