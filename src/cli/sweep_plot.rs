//! The plot that `sweep` draws: curves over one axis, or a map over two.

use super::plot_file::PlotFile;
use crate::cut::Cut;
use crate::io::Failure;
use crate::io::plot::{PLOT_SIZE, PlotAxis, PlotCurve, PlotError, curves, heat_map};
use crate::measure::{Interval, MeasureName};
use crate::render::{SweepAxis, SweepKey, SweepValue, SweptStone};
use std::path::Path;

/// A plot, as its numbers come in.
pub struct SweepPlot<'a> {
    file: PlotFile,
    axes: Vec<PlotAxis>,
    measures: &'a [MeasureName],
    /// For each point, its measures; none where there is no stone.
    points: Vec<Vec<Option<Interval>>>,
}

impl<'a> SweepPlot<'a> {
    /// Begins the plot of a cut over one or two axes of numbers.
    ///
    /// # Errors
    /// [`Failure::Usage`]: another ending than svg, png or pdf, other axes, or several measures over two axes.
    pub fn new(
        path: &Path,
        (cut, axes): (&Cut, &[SweepAxis]),
        measures: &'a [MeasureName],
    ) -> Result<Self, Failure> {
        let refused = |what: &str| Err(Failure::Usage(format!("--plot {}: {what}", path.display())));
        let file = PlotFile::new(path)?;
        match (axes.len(), measures.len()) {
            (1, _) | (2, 1) => {}
            (2, _) => return refused("a map over two axes shows one measure; choose it by --of"),
            _ => return refused("plots are over one --over or two"),
        }
        let mut plotted = vec![];
        for axis in axes {
            let number = |value: &SweepValue| match value {
                SweepValue::Number(number) => Some(*number),
                SweepValue::Name(_) => None,
            };
            let Some(values) = axis.values.iter().map(number).collect::<Option<Vec<f64>>>() else {
                return refused("axes of a plot are numbers");
            };
            let axis = PlotAxis { label: label(&axis.key, cut), values };
            axis.check().map_err(|error| Failure::Usage(format!("--plot: {error}")))?;
            plotted.push(axis);
        }
        Ok(Self { file, axes: plotted, measures, points: vec![] })
    }

    /// Takes in the next point.
    pub fn take_in(&mut self, stone: Option<&SweptStone>) {
        let of = |name: &MeasureName| stone.and_then(|stone| name.of(&stone.measures));
        self.points.push(self.measures.iter().map(of).collect());
    }

    /// Draws the plot and writes it.
    pub fn write(&self, title: &str) -> Result<(), Failure> {
        let text = self.svg(title).map_err(|error| self.file.failed(&error))?;
        self.file.write(&text, title)
    }

    fn svg(&self, title: &str) -> Result<String, PlotError> {
        let percent = |interval: Interval| [interval.least, interval.most].map(|part| 100.0 * part);
        match (self.axes.as_slice(), self.measures) {
            // The last axis varies quickest: it runs up, so points come in columns.
            ([x, y], [measure]) => {
                let at =
                    |i: usize, j: usize| self.points.get(i * y.values.len() + j)?.first().copied().flatten();
                let rows = (0..y.values.len()).flat_map(|j| (0..x.values.len()).map(move |i| at(i, j)));
                let values: Vec<Option<f64>> = rows.map(|value| Some(100.0 * value?.middle())).collect();
                heat_map(&format!("{title}: {measure}"), (x, y), "% of face", &values)
            }
            (axes, measures) => {
                let curve = |(k, name): (usize, &MeasureName)| PlotCurve {
                    name: name.to_string(),
                    bands: self.points.iter().map(|point| point[k].map(percent)).collect(),
                };
                let all: Vec<PlotCurve> = measures.iter().enumerate().map(curve).collect();
                curves((title, PLOT_SIZE), &axes[0], "% of face", &all)
            }
        }
    }
}

/// Returns what stands beside the axis of a number of a cut.
pub fn label(key: &SweepKey, cut: &Cut) -> String {
    match key {
        SweepKey::Proportion(key) => match cut.proportion(key) {
            Some(row) if row.unit.name().is_empty() => row.name.to_owned(),
            Some(row) => format!("{}, {}", row.name, row.unit.name()),
            None => key.clone(),
        },
        SweepKey::Tier(name) => format!("angle of {name}, degrees"),
        SweepKey::Index => "refractive index".to_owned(),
        SweepKey::Material => "material".to_owned(),
        SweepKey::Tilt => "tilt, degrees".to_owned(),
        SweepKey::Azimuth => "azimuth, degrees".to_owned(),
    }
}
