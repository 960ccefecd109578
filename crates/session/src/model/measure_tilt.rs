//! A measure against the tilt of the stone, toward several azimuths.

use super::growing_sweep::{GrowingSweep, sweep_of, takes};
use crate::studio::SweepOrder;
use brillianteer_measure::{Interval, MeasureName};
use brillianteer_render::{SweepAxis, SweepKey, SweepValue};
use brillianteer_scene::Specimen;
use std::sync::Arc;

/// The azimuths that are offered, degrees in the stone's frame.
pub const AZIMUTHS: [f64; 5] = [0.0, 22.5, 45.0, 67.5, 90.0];

/// The greatest tilt to either side, degrees.
pub const MOST_TILT: f64 = 45.0;

/// The number of steps of the tilt from one side to the other.
const STEPS: usize = 24;

/// The distances of the tilts that are measured first, then between them, and so on, in steps.
const STRIDES: [usize; 3] = [4, 2, 1];

/// The part of the light that may stay unresolved. It is larger than for the map, because a tilted stone has no
/// symmetry that shortens the work.
const UNRESOLVED: f64 = 0.02;

/// The choices of the plot against tilt.
#[derive(Debug, Clone, PartialEq)]
pub struct TiltOptions {
    /// The measure; `None` for the zones of the ASET.
    pub measure: Option<MeasureName>,
    /// The [`AZIMUTHS`] that have a curve, each by a flag.
    pub azimuths: [bool; AZIMUTHS.len()],
}

impl Default for TiltOptions {
    fn default() -> Self {
        Self { measure: None, azimuths: [true, false, true, false, false] }
    }
}

impl TiltOptions {
    /// Returns the azimuths that have a curve, degrees.
    pub fn chosen(&self) -> Vec<f64> {
        AZIMUTHS
            .into_iter()
            .zip(self.azimuths)
            .filter(|(_, is_on)| *is_on)
            .map(|(azimuth, _)| azimuth)
            .collect()
    }
}

/// A curve: tilts in degrees, rising, with the interval of the measure at each.
pub type TiltCurve = Vec<(f64, Interval)>;

/// A measure against tilt.
#[derive(Debug, Clone, Default)]
pub struct MeasureTilt {
    /// The choices of the plot.
    pub options: TiltOptions,
    /// The measures at all tilts.
    pub sweep: GrowingSweep,
    /// The stone and the azimuths that the plot followed last.
    looked: Option<(Arc<Specimen>, Vec<f64>)>,
}

impl MeasureTilt {
    /// Follows the stone and the choices, and orders another sweep where one of them has changed. `numbers` counts
    /// sweeps.
    pub fn follow(&mut self, specimen: &Arc<Specimen>, numbers: &mut u64) {
        let azimuths = self.options.chosen();
        let Some(measure) = self.options.measure.filter(|_| !azimuths.is_empty() && specimen.stone().is_ok())
        else {
            self.looked = None;
            self.sweep.want(None);
            return;
        };
        let has_all = self.sweep.wanted().is_some_and(|order| takes(&order.sweep, measure));
        let is_same =
            |(stone, before): &(Arc<Specimen>, Vec<f64>)| Arc::ptr_eq(stone, specimen) && *before == azimuths;
        if has_all && self.looked.as_ref().is_some_and(is_same) {
            return;
        }
        *numbers += 1;
        self.sweep.want(Some(order(specimen, &azimuths, measure, *numbers)));
        self.looked = Some((Arc::clone(specimen), azimuths));
    }

    /// Returns the curves as far as their points have been answered, each with its azimuth in degrees; none where
    /// zones are plotted.
    pub fn curves(&self) -> Vec<(f64, TiltCurve)> {
        let (Some(measure), Some(found)) = (self.options.measure, self.sweep.found()) else { return vec![] };
        let [azimuths, tilts] = &found.order.sweep.axes[..] else { return vec![] };
        let number = |value: &SweepValue| match value {
            SweepValue::Number(number) => Some(*number),
            SweepValue::Name(_) => None,
        };
        let curve = |row: usize| {
            let at = |(place, value): (usize, &SweepValue)| {
                let stone = found.at(row * tilts.values.len() + place)?.as_ref().ok()?;
                Some((number(value)?, measure.of(&stone.measures).filter(|found| found.most.is_finite())?))
            };
            tilts.values.iter().enumerate().filter_map(at).collect()
        };
        let named =
            azimuths.values.iter().enumerate().filter_map(|(row, azimuth)| Some((row, number(azimuth)?)));
        named.map(|(row, azimuth)| (azimuth, curve(row))).collect()
    }
}

/// Returns the order of all tilts toward all azimuths, coarse steps first.
fn order(specimen: &Specimen, azimuths: &[f64], measure: MeasureName, number: u64) -> SweepOrder {
    let axis = |key, values: &mut dyn Iterator<Item = f64>| SweepAxis {
        key,
        values: values.map(SweepValue::Number).collect(),
    };
    let tilt = |place: usize| place as f64 * (2.0 * MOST_TILT / STEPS as f64) - MOST_TILT;
    let axes = vec![
        axis(SweepKey::Azimuth, &mut azimuths.iter().copied()),
        axis(SweepKey::Tilt, &mut (0..=STEPS).map(tilt)),
    ];
    let sweep = sweep_of(&specimen.design, axes, measure, UNRESOLVED);
    let mut points = Vec::with_capacity(sweep.count());
    for (level, stride) in STRIDES.into_iter().enumerate() {
        let places =
            (0..=STEPS).step_by(stride).filter(|place| level == 0 || !place.is_multiple_of(2 * stride));
        let rows = places.flat_map(|place| (0..azimuths.len()).map(move |row| row * (STEPS + 1) + place));
        points.extend(rows);
    }
    let coarse = azimuths.len() * (STEPS / STRIDES[0] + 1);
    SweepOrder { number, sweep: Arc::new(sweep), points: points.into(), coarse }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::document::Document;
    use brillianteer_base::{Stopped, unwatched};

    #[test]
    fn every_tilt_is_measured_once_and_coarse_ones_first() {
        let document = Document::first().unwrap();
        let order = order(document.specimen(), &[0.0, 45.0], MeasureName::Fire, 1);
        let mut points = order.points.to_vec();
        points.sort_unstable();
        assert_eq!(points, (0..2 * (STEPS + 1)).collect::<Vec<_>>());
        let tilt = |point: usize| match order.sweep.values(point)[1] {
            SweepValue::Number(tilt) => *tilt,
            SweepValue::Name(_) => panic!(),
        };
        let coarse: Vec<f64> =
            order.points[..order.coarse].iter().step_by(2).map(|&point| tilt(point)).collect();
        assert_eq!(coarse, [-45.0, -30.0, -15.0, 0.0, 15.0, 30.0, 45.0]);
    }

    #[test]
    fn a_curve_has_the_measures_of_a_stone_tilted_so() {
        let document = Document::first().unwrap();
        let (mut tilt, mut numbers) = (MeasureTilt::default(), 0);
        tilt.follow(document.specimen(), &mut numbers);
        assert!(tilt.sweep.wanted().is_none() && tilt.curves().is_empty(), "zones are plotted");
        tilt.options.measure = Some(MeasureName::Leakage);
        tilt.follow(document.specimen(), &mut numbers);
        tilt.follow(document.specimen(), &mut numbers);
        assert_eq!(numbers, 1, "the same stone is ordered once");
        let order = tilt.sweep.wanted().unwrap().clone();
        let mut answers = vec![];
        let first = order.points[..order.coarse].iter().copied();
        order
            .sweep
            .run::<Stopped>(first, &unwatched, |point, found| {
                answers.push((point, Arc::new(found)));
                Ok(())
            })
            .unwrap();
        tilt.sweep.take(order.number, &answers);
        let curves = tilt.curves();
        let azimuths: Vec<f64> = curves.iter().map(|(azimuth, _)| *azimuth).collect();
        assert_eq!(azimuths, [0.0, 45.0]);
        let leakage: Vec<Interval> = curves[0].1.iter().map(|(_, found)| *found).collect();
        // A round stone has the same on both sides, and a stone that is tilted far leaks more than one that is face up.
        assert!((leakage[0].middle() - leakage[6].middle()).abs() < 2.0 * UNRESOLVED, "{leakage:?}");
        assert!(leakage[0].least > leakage[3].most, "{leakage:?}");
    }
}
