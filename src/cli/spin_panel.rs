//! The panel under the pictures of an animation: a caption, and curves of measures against the tilt or the azimuth.

use super::console::say;
use super::measure_taking::{UNRESOLVED, settings_of};
use super::spin_motion::{SpinMotion, SpinPose, StoneMotion};
use super::spin_pictures::SpinPictures;
use super::sweep_plot::UNIT;
use brillianteer_base::{Failure, Watch};
use brillianteer_cut::Design;
use brillianteer_measure::{Interval, MeasureName, PatternSettings, ROCK_DEG};
use brillianteer_optics::line;
use brillianteer_paper::export::caption_pixels;
use brillianteer_paper::plot::{PlotAxis, PlotCurve, marked_curves};
use brillianteer_paper::{rasterize, with_cover};
use brillianteer_render::{Sweep, SweepAxis, SweepKey, SweepValue};
use brillianteer_scene::Lean;

/// The least width of pictures with curves, in pixels.
pub const LEAST_PLOTTED: u32 = 320;

/// The reason why a stone that turns has no curves.
pub const ONLY_TILTS: &str = "curves are over the tilt of --motion rock or the azimuth of --motion wobble";

/// The least width of a plot in units of its drawing; on narrower pictures it is drawn smaller.
const PLOT_WIDTH: u32 = 640;

/// The height of a plot as a part of its width.
const PLOT_SHAPE: f64 = 0.45;

/// The longest steps of tilts and of azimuths from one place of a curve to the next, degrees.
const MOST_TILT_STEP: f64 = 2.0;
const MOST_AZIMUTH_STEP: f64 = 10.0;

/// The settings of curves, besides the design and the motion.
#[derive(Debug, Clone, Copy)]
pub struct CurveSettings<'a> {
    pub measures: &'a [MeasureName],
    /// The half angle of the head that hides light in obstruction, extinction and contrast, degrees.
    pub head_deg: f64,
    pub polarised: bool,
}

/// The axis along which a motion varies the view.
struct SpinAxis {
    key: SweepKey,
    plotted: PlotAxis,
    /// Returns the place of a pose on the axis.
    of: fn(&SpinPose) -> f64,
}

/// Measures at each tilt or azimuth of a motion.
pub struct SpinCurves {
    axis: SpinAxis,
    /// For each measure its name, and its value at each place of the axis; `None` where it was not measured.
    curves: Vec<(String, Vec<Option<Interval>>)>,
}

impl SpinCurves {
    /// Measures a design at each tilt of a rocking stone, or at each azimuth of a wobbling one.
    ///
    /// # Errors
    /// Fails with [`Failure::Usage`] where the stone turns, or where there is one tilt only; [`Failure::Input`] where
    /// nothing can be measured; [`Failure::Stopped`].
    pub fn of(
        design: Design,
        settings: CurveSettings,
        (motion, poses): (&SpinMotion, &[SpinPose]),
        watch: Watch,
    ) -> Result<Self, Failure> {
        let axis = axis(motion, poses)?;
        let measures = settings.measures;
        let mut of = settings_of(measures, settings.head_deg);
        of.pattern = PatternSettings::needed_by(measures, 0.5 * design.diameter_mm, ROCK_DEG);
        let values = axis.plotted.values.iter().map(|&value| SweepValue::Number(value)).collect();
        let viewpoint = poses.first().map_or(motion.rest, |pose| pose.viewpoint);
        let sweep = Sweep {
            design,
            viewpoint,
            axes: vec![SweepAxis { key: axis.key.clone(), values }],
            settings: of,
            wavelength_nm: line::SODIUM_D,
            unresolved: UNRESOLVED,
            polarised: settings.polarised,
        };
        let mut curves: Vec<_> = measures.iter().map(|name| (name.to_string(), vec![])).collect();
        let mut fault = None;
        sweep.run(0..sweep.count(), watch, |_, found| {
            for ((_, values), name) in curves.iter_mut().zip(measures) {
                values.push(found.as_ref().ok().and_then(|stone| name.of(&stone.measures)));
            }
            fault = found.err().or(fault.take());
            Ok::<_, Failure>(())
        })?;
        let is_empty = curves.iter().all(|(_, values)| values.iter().all(Option::is_none));
        match fault {
            Some(error) if is_empty => Err(Failure::Input(format!("--of: nothing can be measured: {error}"))),
            Some(error) => {
                say(&format!("note: --of: some places cannot be measured: {error}"));
                Ok(Self { axis, curves })
            }
            None => Ok(Self { axis, curves }),
        }
    }

    /// Draws the curves with a mark at a pose; the key gives the values of the measures there.
    fn svg(&self, pose: &SpinPose, title: &str, width: u32) -> Result<String, Failure> {
        let (axis, at) = (&self.axis.plotted, (self.axis.of)(pose));
        let place = axis.values.iter().position(|&value| value == at);
        let curve = |(name, values): &(String, Vec<Option<Interval>>)| {
            let here = place.and_then(|place| values[place]);
            // The figure stands first, because a long name ends at the edge of the picture.
            let here = here.map_or("not measured".to_owned(), |value| in_percent(&value));
            let band = |value: &Option<Interval>| {
                let Interval { least, most } = (*value)?;
                most.is_finite().then_some([100.0 * least, 100.0 * most])
            };
            PlotCurve { name: format!("{here}  {name}"), bands: values.iter().map(band).collect() }
        };
        let curves: Vec<PlotCurve> = self.curves.iter().map(curve).collect();
        let size = (width, (PLOT_SHAPE * f64::from(width)) as u32);
        marked_curves((title, size), (axis, Some(at)), UNIT, &curves)
            .map_err(|error| Failure::Output(format!("--of: {error}")))
    }
}

/// Returns the axis of a motion, and its values: those of the frames, each once and rising, and others between them.
fn axis(motion: &SpinMotion, poses: &[SpinPose]) -> Result<SpinAxis, Failure> {
    let side = motion.rest.side.name();
    let tilt = match motion.rest.lean {
        Lean::Stone => "tilt",
        Lean::Eye => "way of the eye",
    };
    let (key, label, step, of): (_, _, f64, fn(&SpinPose) -> f64) = match motion.motion {
        StoneMotion::Turn => {
            return Err(Failure::Usage(format!("--of: {ONLY_TILTS}")));
        }
        StoneMotion::Rock => {
            let label = format!("{tilt} toward azimuth {}, {side} side, degrees", motion.rest.azimuth_deg);
            (SweepKey::Tilt, label, MOST_TILT_STEP, |pose| pose.viewpoint.tilt_deg)
        }
        StoneMotion::Wobble => {
            let label = format!("azimuth of a {tilt} of {}, {side} side, degrees", motion.swing_deg);
            (SweepKey::Azimuth, label, MOST_AZIMUTH_STEP, |pose| pose.viewpoint.azimuth_deg)
        }
    };
    let mut values: Vec<f64> = poses.iter().map(of).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    if values.len() < 2 {
        return Err(Failure::Usage("--of: all frames show one tilt; give more --frames or a --swing".into()));
    }
    if motion.motion == StoneMotion::Wobble {
        values.push(values[0] + 360.0);
    }
    Ok(SpinAxis { key, plotted: PlotAxis { label, values: filled(&values, step) }, of })
}

/// Returns rising values with others between them, so that no step is longer than `most`.
fn filled(values: &[f64], most: f64) -> Vec<f64> {
    let between = |pair: &[f64]| {
        let (from, parts) = (pair[0], ((pair[1] - pair[0]) / most).ceil().max(1.0));
        let step = (pair[1] - from) / parts;
        (0..parts as usize).map(move |k| from + k as f64 * step).collect::<Vec<_>>()
    };
    values.windows(2).flat_map(between).chain(values.last().copied()).collect()
}

/// Returns a measure in percent, to a tenth, with a bound that holds for the rounded number.
fn in_percent(value: &Interval) -> String {
    let exact = 100.0 * value.middle();
    let told = (10.0 * exact).round() / 10.0;
    let bound = 100.0 * value.error() + (told - exact).abs();
    format!("{told:.1} ± {:.1} %", (10.0 * bound).ceil() / 10.0)
}

/// The panel under each picture, which has the same height under all of them.
pub struct SpinPanel<'a> {
    pictures: &'a dyn SpinPictures,
    is_captioned: bool,
    curves: Option<SpinCurves>,
    width: u32,
    /// The heights of caption and curves, in pixels.
    heights: [u32; 2],
}

impl<'a> SpinPanel<'a> {
    /// Lays out a panel under pictures of this width.
    pub fn new(
        (pictures, width): (&'a dyn SpinPictures, u32),
        poses: &[SpinPose],
        is_captioned: bool,
        curves: Option<SpinCurves>,
    ) -> Result<Self, Failure> {
        let mut panel = Self { pictures, is_captioned, curves, width, heights: [0, 0] };
        // The position of the stone may need more lines in one caption than in another. All plots are equally high.
        let height = |pose: &&SpinPose| pictures.caption(pose).height(f64::from(width));
        let tallest = poses.iter().max_by(|a, b| height(a).total_cmp(&height(b)));
        if let Some(pose) = tallest {
            panel.heights = [panel.caption(pose)?.0, panel.plot(pose)?.0];
        }
        Ok(panel)
    }

    /// Returns the height of the panel in pixels.
    pub fn height(&self) -> u32 {
        self.heights.iter().sum()
    }

    /// Adds the panel of a pose to the pixels of a picture.
    pub fn add(&self, pose: &SpinPose, rgba: &mut Vec<u8>) -> Result<(), Failure> {
        let parts = [self.caption(pose)?.1, self.plot(pose)?.1];
        for (mut rgb, height) in parts.into_iter().zip(self.heights) {
            // A caption of fewer lines leaves white paper.
            rgb.resize(3 * self.width as usize * height as usize, u8::MAX);
            rgba.extend(with_cover(&rgb));
        }
        Ok(())
    }

    fn caption(&self, pose: &SpinPose) -> Result<(u32, Vec<u8>), Failure> {
        if self.is_captioned {
            caption_pixels(&self.pictures.caption(pose), self.width)
        } else {
            Ok((0, vec![]))
        }
    }

    fn plot(&self, pose: &SpinPose) -> Result<(u32, Vec<u8>), Failure> {
        let Some(curves) = &self.curves else { return Ok((0, vec![])) };
        // The caption already gives the position of the stone.
        let title = if self.is_captioned { String::new() } else { pose.words() };
        let svg = curves.svg(pose, &title, self.width.max(PLOT_WIDTH))?;
        let drawn = rasterize(&svg, self.width).map_err(|error| Failure::Output(error.to_string()))?;
        Ok((drawn.1, drawn.2))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_scene::Viewpoint;

    fn axis_of(motion: StoneMotion, swing_deg: f64, frames: u32) -> Result<PlotAxis, Failure> {
        let motion = SpinMotion { motion, rest: Viewpoint::default(), swing_deg, frames };
        axis(&motion, &motion.poses()).map(|axis| axis.plotted)
    }

    #[test]
    fn curves_have_a_place_for_each_frame_and_no_long_steps() {
        for (motion, frames, most) in
            [(StoneMotion::Rock, 12, 2.0), (StoneMotion::Rock, 300, 2.0), (StoneMotion::Wobble, 7, 10.0)]
        {
            let axis = axis_of(motion, 30.0, frames).unwrap();
            assert!(axis.values.windows(2).all(|pair| pair[0] < pair[1] && pair[1] - pair[0] <= most + 1e-9));
            let moving = SpinMotion { motion, rest: Viewpoint::default(), swing_deg: 30.0, frames };
            for pose in moving.poses() {
                let Viewpoint { tilt_deg, azimuth_deg, .. } = pose.viewpoint;
                let value = if motion == StoneMotion::Rock { tilt_deg } else { azimuth_deg };
                assert!(axis.values.contains(&value), "{value} of {:?}", axis.values);
            }
        }
        let around = axis_of(StoneMotion::Wobble, 5.0, 8).unwrap();
        assert_eq!((around.values[0], around.values.last()), (0.0, Some(&360.0)));
    }

    #[test]
    fn what_does_not_change_has_no_curves() {
        for (motion, swing, frames) in
            [(StoneMotion::Turn, 5.0, 8), (StoneMotion::Rock, 0.0, 8), (StoneMotion::Rock, 5.0, 2)]
        {
            assert!(
                matches!(axis_of(motion, swing, frames), Err(Failure::Usage(_))),
                "{motion:?} {swing} {frames}"
            );
        }
    }

    #[test]
    fn bounds_are_rounded_up() {
        let told =
            [(0.5021, 0.5044), (0.51234, 0.51236)].map(|(least, most)| in_percent(&Interval { least, most }));
        // The first is 50.325 ± 0.115: 0.1 would leave a part of it out. The second is 51.235, and was rounded by 0.035.
        assert_eq!(told, ["50.3 ± 0.2 %", "51.2 ± 0.1 %"]);
    }
}
