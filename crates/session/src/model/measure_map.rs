//! The map of a measure over two proportions of the design, or the angles of two of its tiers.
//!
//! The map belongs to all designs that differ from one another along its axes alone: it stays while the design moves on it, and
//! begins anew when anything else of the stone changes.

use super::growing_sweep::{GrowingSweep, sweep_of, takes};
use super::impossible::by_name;
use crate::studio::SweepOrder;
use brillianteer_base::Unit;
use brillianteer_cut::{Cut, Design, MaterialRef, Proportion, ScaledSide};
use brillianteer_math::Plane;
use brillianteer_measure::{MeasureName, MeasureSettings};
use brillianteer_render::{Sweep, SweepAxis, SweepError, SweepKey, SweepValue};
use std::sync::Arc;

/// The number of steps along each axis of the finest grid.
pub const STEPS: usize = 64;

/// The distances of the places of each grid in steps of the finest, coarse grids first.
pub const STRIDES: [usize; 5] = [16, 8, 4, 2, 1];

/// The part of the light that may stay unresolved at each place.
const UNRESOLVED: f64 = 0.01;

/// The range in which the angle of a tier first varies to either side, degrees.
const AROUND_TIER: f64 = 4.0;

/// The least and the greatest angle of a tier on a map, degrees.
const TIER_ANGLES: [f64; 2] = [0.5, 89.5];

/// The range in which a side is first scaled, percent of its height.
const SCALES: [f64; 2] = [80.0, 125.0];

/// Lengths and angles that differ by less than this are equal: meets are solved anew on each way to a place.
const SAME: f64 = 1e-7;

/// The proportions for whose pairs GIA publishes ranges of the grade EX that hold alone.
const GRADED: [&str; 3] = ["table", "crown_angle", "pavilion_angle"];

/// An axis of the map: the number that varies, and its range.
#[derive(Debug, Clone, PartialEq)]
pub struct MapAxis {
    /// The proportion or the tier.
    pub key: SweepKey,
    /// Its name on the screen.
    pub name: String,
    /// The unit behind its values.
    pub unit: &'static str,
    /// The values at the left or lower end and at the other end; the first is the lesser.
    pub ends: [f64; 2],
    /// The number that 100 % stands for in a side's scale: the tangent of its first leaning facet in the cut of which
    /// the axis was made. 1 for other numbers.
    whole: f64,
}

impl MapAxis {
    /// Returns the axes that a cut offers, in the order of its table or its tiers.
    pub fn all(cut: &Cut) -> Vec<Self> {
        let rows = cut.proportions().iter().filter(|row| row.can_be_set() && row.unit != Unit::Count);
        let row = |row: &Proportion| Self {
            key: SweepKey::Proportion(row.key.to_owned()),
            name: row.name.to_owned(),
            unit: row.unit.suffix(),
            ends: row.usual,
            whole: 1.0,
        };
        let [least, most] = TIER_ANGLES;
        let settings = cut.settings();
        let is_slanted = |angle: f64| (least..=most).contains(&angle.abs());
        let tiers = settings.iter().filter(|tier| is_slanted(tier.angle));
        let tier = |tier: &brillianteer_cut::MachineSetting| Self {
            key: SweepKey::Tier(tier.name.clone()),
            name: format!("Angle of {}", tier.name),
            unit: "°",
            ends: [tier.angle.abs() - AROUND_TIER, tier.angle.abs() + AROUND_TIER]
                .map(|angle| angle.clamp(least, most)),
            whole: 1.0,
        };
        let scales = ScaledSide::ALL.into_iter().filter(|_| cut.has_scalable_sides());
        let scale = |side: ScaledSide| {
            let (key, name) = (SweepKey::Scale(side), format!("Scale of the {side}"));
            Some(Self { key, name, unit: " %", ends: SCALES, whole: cut.tangent_of_side(side)? })
        };
        rows.map(row).chain(tiers.map(tier)).chain(scales.filter_map(scale)).collect()
    }

    /// Returns the value of the axis's number in a cut; `None` where the cut lacks the number.
    pub fn value(&self, cut: &Cut) -> Option<f64> {
        let value = match &self.key {
            SweepKey::Proportion(key) => (cut.proportion(key)?.get)(cut),
            SweepKey::Tier(name) => cut.settings().iter().find(|tier| tier.name == *name)?.angle.abs(),
            SweepKey::Scale(side) => 100.0 * cut.tangent_of_side(*side)? / self.whole,
            _ => return None,
        };
        value.is_finite().then_some(value)
    }

    /// Returns the value at a place of the finest grid.
    pub fn at(&self, place: usize) -> f64 {
        let part = place as f64 / STEPS as f64;
        self.ends[0] * (1.0 - part) + self.ends[1] * part
    }

    /// Writes a value with its unit.
    pub fn written(&self, value: f64) -> String {
        format!("{}{}", (100.0 * value).round() / 100.0 + 0.0, self.unit)
    }

    /// Returns whether one of the two numbers follows from the other, so that they make no map.
    pub fn is_paired(&self, other: &Self, cut: &Cut) -> bool {
        let row = |axis: &Self| match &axis.key {
            SweepKey::Proportion(key) => cut.proportion(key),
            _ => None,
        };
        let is_one = row(self).zip(row(other)).is_some_and(|(one, other)| {
            one.pair == Some(other.key) || one.does_move(other) || other.does_move(one)
        });
        let is_scaled = |side: ScaledSide, tier: &String| cut.tier_of_side(side).as_ref() == Some(tier);
        self.key == other.key
            || is_one
            || match (&self.key, &other.key) {
                // The angle of this tier follows from the scale of its side.
                (SweepKey::Scale(side), SweepKey::Tier(tier)) => is_scaled(*side, tier),
                (SweepKey::Tier(tier), SweepKey::Scale(side)) => is_scaled(*side, tier),
                _ => false,
            }
    }

    /// Returns the axis of a sweep of a cut. A sweep counts scales from the cut that it varies.
    fn sweep_axis(&self, values: Vec<f64>, cut: &Cut) -> SweepAxis {
        let unit = match self.key {
            SweepKey::Scale(_) => self.value(cut).map_or(1.0, |percent| 100.0 / percent),
            _ => 1.0,
        };
        let values = values.into_iter().map(|value| SweepValue::Number(unit * value)).collect();
        SweepAxis { key: self.key.clone(), values }
    }
}

/// The choices of the map.
#[derive(Debug, Clone, PartialEq)]
pub struct MapOptions {
    /// The measure whose values are coloured.
    pub measure: MeasureName,
    /// The axes of the map, across and up.
    pub axes: [MapAxis; 2],
}

impl MapOptions {
    /// Returns the first choice for a cut; `None` where it offers no two axes.
    fn of(cut: &Cut, measure: MeasureName) -> Option<Self> {
        let all = MapAxis::all(cut);
        let of_key = |key: &str| all.iter().find(|axis| axis.key == SweepKey::of(key));
        let across = of_key("pavilion_angle").or_else(|| all.first())?;
        let up = of_key("crown_angle").filter(|axis| !across.is_paired(axis, cut));
        let up = up.or_else(|| all.iter().find(|axis| !across.is_paired(axis, cut)))?;
        Some(Self { measure, axes: [across.clone(), up.clone()] })
    }

    /// Returns the ranges that GIA publishes for the grade EX, across and up; `None` where one is not known: they are for the
    /// round brilliant of diamond.
    pub fn published_range(&self, design: &Design) -> Option<[[f64; 2]; 2]> {
        let is_diamond =
            matches!(&design.material, MaterialRef::Name(name) if name.eq_ignore_ascii_case("diamond"));
        let is_graded = is_diamond && matches!(design.cut, Cut::RoundBrilliant(_));
        let range = |axis: &MapAxis| match &axis.key {
            SweepKey::Proportion(key) if is_graded && GRADED.contains(&key.as_str()) => {
                design.cut.proportion(key)?.excellent
            }
            _ => None,
        };
        Some([range(&self.axes[0])?, range(&self.axes[1])?])
    }
}

/// The map of a measure.
#[derive(Debug, Clone, Default)]
pub struct MeasureMap {
    /// The choices; `None` where the design has nothing to vary.
    options: Option<MapOptions>,
    /// The measures at the places of the grid.
    pub sweep: GrowingSweep,
    /// The design that the map followed last.
    looked: Option<Design>,
    /// True where another document has begun since, whose axes have to be chosen anew.
    is_other: bool,
}

impl MeasureMap {
    /// Begins with another document; the choice of the measure stays.
    pub fn begin(&mut self) {
        *self = Self { options: self.options.take(), is_other: true, ..Self::default() };
    }

    /// Returns the choices; `None` where the design has nothing to vary, or the map has not been in sight.
    pub fn options(&self) -> Option<&MapOptions> {
        self.options.as_ref()
    }

    /// Takes new choices. Axes that make no map are ignored; other axes or ends begin another map.
    pub fn choose(&mut self, options: MapOptions) {
        let [across, up] = &options.axes;
        let Some(design) = &self.looked else { return };
        let is_range =
            |axis: &MapAxis| axis.ends.iter().all(|end| end.is_finite()) && axis.ends[0] < axis.ends[1];
        if across.is_paired(up, &design.cut) || !is_range(across) || !is_range(up) {
            return;
        }
        let lacks = self.sweep.wanted().is_some_and(|order| !takes(&order.sweep, options.measure));
        if lacks || self.options.as_ref().is_some_and(|before| before.axes != options.axes) {
            self.looked = None;
            self.sweep.want(None);
        }
        self.options = Some(options);
    }

    /// Follows the design, and orders another sweep where anything but the numbers of the axes has changed. `numbers`
    /// counts sweeps.
    pub fn follow(&mut self, design: &Design, numbers: &mut u64) {
        if self.looked.as_ref() == Some(design) {
            return;
        }
        let all = MapAxis::all(&design.cut);
        let is_offered = |axis: &MapAxis| all.iter().any(|offered| offered.key == axis.key);
        let is_kept = self.options.as_ref().is_some_and(|options| options.axes.iter().all(is_offered));
        if std::mem::take(&mut self.is_other) || !is_kept {
            let measure = self.options.as_ref().map_or_else(first_measure, |options| options.measure);
            self.options = MapOptions::of(&design.cut, measure);
            self.sweep.want(None);
        }
        self.looked = Some(design.clone());
        let Some(options) = &self.options else { return };
        let wanted = self.sweep.wanted().map(|order| &order.sweep);
        let is_known = |sweep: &Arc<Sweep>| {
            takes(sweep, options.measure) && is_along(&options.axes, &sweep.design, design)
        };
        if wanted.is_some_and(is_known) {
            return;
        }
        *numbers += 1;
        self.sweep.want(Some(order(options, design, *numbers)));
    }

    /// Returns the cut of a design that is moved to these values across and up. Of two numbers of which one follows
    /// from the other, the one that the design fixes stays fixed.
    ///
    /// # Errors
    /// Fails where there is no map, or no stone at that place.
    pub fn moved(&self, design: &Design, to: [f64; 2]) -> Result<Cut, MapFault> {
        let options = self.options.as_ref().ok_or(MapFault::Nothing)?;
        let held = options.axes.iter().filter_map(|axis| match &axis.key {
            SweepKey::Proportion(key) => {
                design.cut.proportion(key).filter(|row| !(row.is_given)(&design.cut))
            }
            _ => None,
        });
        let held = held.filter_map(|row| design.cut.proportion(row.pair?));
        let mut moved = at(&options.axes, design, to)?;
        held.for_each(|row| row.hold(&mut moved.cut));
        moved.check().map_err(|fault| SweepError::from(brillianteer_scene::SpecimenError::from(fault)))?;
        Ok(moved.cut)
    }
}

/// The reason why the design is not moved to a place of the map.
#[derive(Debug, thiserror::Error)]
pub enum MapFault {
    /// There is no map.
    #[error("the design has no two proportions, tiers or sides that a map can vary")]
    Nothing,
    /// There is no stone at the place.
    #[error("no stone there: {}", no_stone(.0))]
    NoStone(#[from] SweepError),
}

/// Returns in the panel's words why there is no stone at a place.
pub fn no_stone(error: &SweepError) -> String {
    match error {
        SweepError::Specimen(fault) => by_name(fault),
        other => other.to_string(),
    }
}

fn first_measure() -> MeasureName {
    let all = MeasureName::all(&MeasureSettings::usual([1.0; 2]));
    all.into_iter().next().unwrap_or(MeasureName::Fire)
}

/// Returns the design at these values of two axes.
fn at(axes: &[MapAxis; 2], design: &Design, to: [f64; 2]) -> Result<Design, SweepError> {
    let axes = axes.iter().zip(to).map(|(axis, value)| axis.sweep_axis(vec![value], &design.cut)).collect();
    sweep_of(design, axes, MeasureName::Fire, UNRESOLVED).design_at(0)
}

/// Returns whether two designs differ along two axes alone.
fn is_along(axes: &[MapAxis; 2], a: &Design, b: &Design) -> bool {
    let value = |axis: &MapAxis| axis.value(&b.cut);
    let (Some(x), Some(y)) = (value(&axes[0]), value(&axes[1])) else { return false };
    match (at(axes, a, [x, y]), at(axes, b, [x, y])) {
        (Ok(a), Ok(b)) => {
            is_same_cut(&a.cut, &b.cut) && a.material == b.material && a.diameter_mm == b.diameter_mm
        }
        _ => false,
    }
}

/// Returns whether two cuts are equal except for the rounding of tiers and planes.
fn is_same_cut(a: &Cut, b: &Cut) -> bool {
    if let (Cut::Planes(one), Cut::Planes(other)) = (a, b) {
        let is_same = |(a, b): (&(String, Plane), &(String, Plane))| {
            a.0 == b.0 && a.1.normal.abs_diff_eq(b.1.normal, SAME) && (a.1.offset - b.1.offset).abs() < SAME
        };
        return one.len() == other.len() && one.iter().zip(other).all(is_same);
    }
    let (Cut::Tiers(one), Cut::Tiers(other)) = (a, b) else { return a == b };
    let mut rounded = other.clone();
    for (tier, exact) in rounded.tiers.iter_mut().zip(&one.tiers) {
        for (number, exact) in [(&mut tier.angle, exact.angle), (&mut tier.distance, exact.distance)] {
            if (*number - exact).abs() < SAME {
                *number = exact;
            }
        }
    }
    rounded == *one
}

/// Returns the order of a map: its whole grid, coarse places first.
fn order(options: &MapOptions, design: &Design, number: u64) -> SweepOrder {
    let places =
        |axis: &MapAxis| axis.sweep_axis((0..=STEPS).map(|place| axis.at(place)).collect(), &design.cut);
    let axes = options.axes.iter().map(places).collect();
    let sweep: Sweep = sweep_of(design, axes, options.measure, UNRESOLVED);
    let mut points = Vec::with_capacity(sweep.count());
    for (level, stride) in STRIDES.into_iter().enumerate() {
        let is_even = |place: usize| place.is_multiple_of(2 * stride);
        let is_known = |x: usize, y: usize| level > 0 && is_even(x) && is_even(y);
        for x in (0..=STEPS).step_by(stride) {
            points.extend((0..=STEPS).step_by(stride).filter(|&y| !is_known(x, y)).map(|y| point(x, y)));
        }
    }
    let side = STEPS / STRIDES[0] + 1;
    SweepOrder { number, sweep: Arc::new(sweep), points: points.into(), coarse: side * side }
}

/// Returns the number of the point at a place of the finest grid, counted across and up.
pub fn point(x: usize, y: usize) -> usize {
    x * (STEPS + 1) + y
}

#[cfg(test)]
mod tests;
