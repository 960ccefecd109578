//! The plot that `sweep` draws: curves over one axis, a map over two, or a family of curves: one for each azimuth or material.

use super::plot_file::PlotFile;
use brillianteer_base::Failure;
use brillianteer_cut::Cut;
use brillianteer_measure::{Interval, MeasureName};
use brillianteer_paper::plot::{
    COLOURS_OF_CURVES, PLOT_SIZE, PlotAxis, PlotCurve, PlotError, PlotPanel, curves, heat_map, panels,
};
use brillianteer_render::{SweepAxis, SweepKey, SweepValue, SweptStone};
use std::path::Path;

/// A plot that collects the points of a sweep.
pub struct SweepPlot<'a> {
    file: PlotFile,
    shape: PlotShape,
    measures: &'a [MeasureName],
    /// The measures of each point; empty where the point has no stone.
    points: Vec<Vec<Option<Interval>>>,
}

/// The shape of a sweep's plot.
enum PlotShape {
    /// Measures over the only axis.
    Curves(PlotAxis),
    /// One measure as a map: the first axis runs across, the second up.
    Map([PlotAxis; 2]),
    /// One curve for each value of one axis over the other, in one panel for each measure.
    Family {
        axis: PlotAxis,
        /// The key of the number that varies from curve to curve.
        key: &'static str,
        /// The names of the curves.
        members: Vec<String>,
        /// True where the axis of the curves is the first of the two, which varies slowest.
        is_first: bool,
    },
}

impl PlotShape {
    /// Chooses the plot for this number of measures over these axes.
    fn of(cut: &Cut, axes: &[SweepAxis], measures: usize) -> Result<Self, &'static str> {
        match axes {
            [axis] => Ok(Self::Curves(plotted(axis, cut)?)),
            [first, second] => {
                for (is_first, family, along) in [(true, first, second), (false, second, first)] {
                    if let Some(members) = members(family, along) {
                        let key = if family.key == SweepKey::Azimuth { "azimuth" } else { "material" };
                        return Ok(Self::Family { axis: plotted(along, cut)?, key, members, is_first });
                    }
                }
                match measures {
                    1 => Ok(Self::Map([plotted(first, cut)?, plotted(second, cut)?])),
                    _ => Err("a map over two axes shows one measure; choose it by --of"),
                }
            }
            _ => Err("plots are over one --over or two"),
        }
    }
}

/// Returns the names of curves, one for each azimuth of a tilt or for each material; `None` where a map shows more.
fn members(family: &SweepAxis, along: &SweepAxis) -> Option<Vec<String>> {
    let unit = match family.key {
        SweepKey::Azimuth if along.key == SweepKey::Tilt => "°",
        SweepKey::Material => "",
        _ => return None,
    };
    let is_told_apart = (1..=COLOURS_OF_CURVES).contains(&family.values.len());
    is_told_apart.then(|| family.values.iter().map(|value| format!("{value}{unit}")).collect())
}

/// Returns the axis of a plot for that of a sweep.
fn plotted(axis: &SweepAxis, cut: &Cut) -> Result<PlotAxis, &'static str> {
    let number = |value: &SweepValue| match value {
        SweepValue::Number(number) => Some(*number),
        SweepValue::Name(_) => None,
    };
    let values = axis.values.iter().map(number).collect::<Option<Vec<f64>>>();
    let values =
        values.ok_or("axes of a plot are numbers, but for up to seven materials over another axis")?;
    Ok(PlotAxis { label: label(&axis.key, cut), values })
}

impl<'a> SweepPlot<'a> {
    /// Begins the plot of a cut over one or two axes.
    ///
    /// # Errors
    /// Fails with [`Failure::Usage`] for another ending than svg, png or pdf, for other axes, and for several
    /// measures on a map.
    pub fn new(
        path: &Path,
        (cut, axes): (&Cut, &[SweepAxis]),
        measures: &'a [MeasureName],
    ) -> Result<Self, Failure> {
        let refused = |what: &str| Failure::Usage(format!("--plot {}: {what}", path.display()));
        let file = PlotFile::new(path)?;
        let shape = PlotShape::of(cut, axes, measures.len()).map_err(refused)?;
        let drawn = match &shape {
            PlotShape::Curves(axis) | PlotShape::Family { axis, .. } => std::slice::from_ref(axis),
            PlotShape::Map(axes) => axes.as_slice(),
        };
        for axis in drawn {
            axis.check().map_err(|error| Failure::Usage(format!("--plot: {error}")))?;
        }
        Ok(Self { file, shape, measures, points: vec![] })
    }

    /// Takes in the next point.
    pub fn take_in(&mut self, stone: Option<&SweptStone>) {
        let of = |name: &MeasureName| stone.and_then(|stone| name.of(&stone.measures));
        self.points.push(self.measures.iter().map(of).collect());
    }

    /// Draws the plot and writes it, and returns the path of its file.
    pub fn write(&self, title: &str) -> Result<&Path, Failure> {
        let text = self.svg(title).map_err(|error| self.file.failed(&error))?;
        self.file.write(&text, title)?;
        Ok(self.file.path())
    }

    fn svg(&self, title: &str) -> Result<String, PlotError> {
        let band = |point: usize, measure: usize| {
            let interval = self.points.get(point)?[measure]?;
            Some([interval.least, interval.most].map(|part| 100.0 * part))
        };
        let named = || self.measures.iter().map(MeasureName::to_string).enumerate();
        match &self.shape {
            // The last axis varies quickest: it runs up, so points come in columns.
            PlotShape::Map([x, y]) => {
                let at = |i: usize, j: usize| self.points.get(i * y.values.len() + j)?[0];
                let rows = (0..y.values.len()).flat_map(|j| (0..x.values.len()).map(move |i| at(i, j)));
                let values: Vec<Option<f64>> = rows.map(|value| Some(100.0 * value?.middle())).collect();
                let measure = self.measures[0];
                let error = self.points.iter().filter_map(|of| of[0]).map(|interval| interval.error());
                let most = 100.0 * error.fold(0.0, f64::max);
                // The bound is rounded up, so that it stays a bound.
                let bound = (100.0 * most).ceil() / 100.0;
                heat_map(&format!("{title}: {measure}, each ± {bound:.2} or less"), (x, y), UNIT, &values)
            }
            PlotShape::Curves(axis) => {
                let bands = |k: usize| (0..axis.values.len()).map(|point| band(point, k)).collect();
                let all: Vec<PlotCurve> =
                    named().map(|(k, name)| PlotCurve { name, bands: bands(k) }).collect();
                curves((title, PLOT_SIZE), axis, UNIT, &all)
            }
            PlotShape::Family { axis, key, members, is_first } => {
                let along = axis.values.len();
                let point = |member: usize, place: usize| {
                    if *is_first { member * along + place } else { place * members.len() + member }
                };
                let curve = |k: usize, (member, name): (usize, &String)| PlotCurve {
                    name: name.clone(),
                    bands: (0..along).map(|place| band(point(member, place), k)).collect(),
                };
                let panel = |(k, name): (usize, String)| PlotPanel {
                    name,
                    curves: members.iter().enumerate().map(|member| curve(k, member)).collect(),
                };
                panels(title, axis, (UNIT, key), &named().map(panel).collect::<Vec<_>>())
            }
        }
    }
}

/// The unit of all measures; docs/optics.md says of which quantity each is a percentage.
pub const UNIT: &str = "percent";

/// Returns the label of the axis of a cut's number.
pub fn label(key: &SweepKey, cut: &Cut) -> String {
    match key {
        SweepKey::Proportion(key) => match cut.proportion(key) {
            Some(row) if row.unit.name().is_empty() => row.name.to_owned(),
            Some(row) => format!("{}, {}", row.name, row.unit.name()),
            None => key.clone(),
        },
        SweepKey::Tier(name) => format!("angle of {name}, degrees"),
        SweepKey::Distance(name) => format!("distance of {name}"),
        SweepKey::Scale(side) => format!("scale of the {side}, percent"),
        SweepKey::Index => "refractive index".to_owned(),
        SweepKey::Material => "material".to_owned(),
        SweepKey::Tilt => "tilt, degrees".to_owned(),
        SweepKey::Azimuth => "azimuth, degrees".to_owned(),
    }
}
