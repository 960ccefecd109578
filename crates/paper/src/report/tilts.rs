//! The measures of a stone against tilt, with the bounds between which they certainly lie.

use crate::export::Viewing;
use crate::plot::{PlotAxis, PlotCurve, PlotError, curves};
use brillianteer_base::{Failure, Watch};
use brillianteer_measure::{LightMeasures, MeasureName, MeasureSettings};
use brillianteer_optics::line;
use brillianteer_picture::EmbeddedDrawing;
use brillianteer_render::{Sweep, SweepAxis, SweepKey, SweepValue};
use brillianteer_scene::Viewpoint;

/// The greatest tilt to either side, degrees, and the step from one tilt to the next.
const MOST_TILT: i32 = 30;
const STEP: i32 = 5;

/// The part of the light that may stay unresolved at each tilt: of a stone with several alike parts, and of any other. It
/// shows as the width of the curves.
const UNRESOLVED: [f64; 2] = [1e-2, 2e-2];

/// The parts of the memory of beams of which one belongs to each tilt, so that even a stone that keeps its light for long has
/// its curves in seconds.
const PARTS_OF_MEMORY: usize = 4;

/// The size of the plots, in units of their drawing.
const SIZE: (u32, u32) = (1000, 400);

/// The measures of a stone at each tilt.
pub(super) struct TiltCurves {
    /// The tilts, degrees.
    tilts: Vec<f64>,
    /// The measures at each tilt; `None` where the light could not be traced.
    points: Vec<Option<LightMeasures>>,
}

impl TiltCurves {
    /// Tilts a stone, its table toward the azimuth 0, and takes its measures.
    pub fn of(viewing: &Viewing, has_alike_parts: bool, watch: Watch) -> Result<Self, Failure> {
        let tilts: Vec<f64> = (-MOST_TILT / STEP..=MOST_TILT / STEP).map(|k| f64::from(k * STEP)).collect();
        let settings = MeasureSettings { pattern: None, ..viewing.measure_settings(&[]) };
        let values = tilts.iter().map(|&tilt| SweepValue::Number(tilt)).collect();
        let sweep = Sweep {
            design: viewing.specimen.design.clone(),
            viewpoint: Viewpoint::default(),
            axes: vec![SweepAxis { key: SweepKey::Tilt, values }],
            settings,
            wavelength_nm: viewing.wavelength_nm.unwrap_or(line::SODIUM_D),
            unresolved: UNRESOLVED[usize::from(!has_alike_parts)],
            polarised: viewing.polarised,
        };
        let mut points = vec![];
        sweep.run_in(PARTS_OF_MEMORY, 0..sweep.count(), watch, |_, found| {
            points.push(found.ok().map(|stone| stone.measures));
            Ok::<_, Failure>(())
        })?;
        Ok(Self { tilts, points })
    }

    /// Returns the curve of one measure, in percent.
    fn curve(&self, measure: MeasureName, name: String) -> PlotCurve {
        let percent = |point: &Option<LightMeasures>| {
            let found = measure.of(point.as_ref()?)?;
            found.most.is_finite().then(|| [found.least, found.most].map(|part| 100.0 * part))
        };
        PlotCurve { name, bands: self.points.iter().map(percent).collect() }
    }
}

/// Draws curves against tilt under a title: for each, the stone's tilts, a measure and its name in the key. Returns
/// `None` where there is nothing to draw.
pub(super) fn tilt_plot(
    title: &str,
    wanted: &[(&TiltCurves, MeasureName, String)],
) -> Result<Option<EmbeddedDrawing>, Failure> {
    let Some((first, ..)) = wanted.first() else { return Ok(None) };
    let axis = PlotAxis { label: "tilt toward azimuth 0, degrees".to_owned(), values: first.tilts.clone() };
    let drawn: Vec<PlotCurve> =
        wanted.iter().map(|(tilts, measure, name)| tilts.curve(*measure, name.clone())).collect();
    match curves((title, SIZE), &axis, "%", &drawn) {
        Ok(svg) => Ok(EmbeddedDrawing::of(&svg)),
        Err(PlotError::Nothing) => Ok(None),
        Err(error) => Err(Failure::Output(format!("{title}: {error}"))),
    }
}
