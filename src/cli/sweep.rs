//! `sweep`: writes the measures of designs over a grid of their proportions, angles, materials and views.

use super::console::{say, written, written_beside};
use super::measure_taking::MeasureTaking;
use super::options::{pupil_diameter, rock_angle};
use super::progress::WorkProgress;
use super::specimen::stem;
use super::sweep_plot::SweepPlot;
use super::sweep_table::{SweepTable, another_sweep};
use brillianteer_base::{Failure, Watch};
use brillianteer_files::design_file::DesignFormat;
use brillianteer_files::library;
use brillianteer_measure::{MeasureName, PatternSettings, ROCK_DEG, pupil_deg};
use brillianteer_render::{Sweep, SweepAxis, SweepError, SweepKey, SweepValue, SweptStone};
use brillianteer_scene::Specimen;
use clap::Args;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// The most values of one axis, and points of one design.
const MOST_VALUES: usize = 100_000;
const MOST_POINTS: usize = 10_000_000;

/// The measures that are listed where none are chosen.
const USUAL: [&str; 8] =
    ["return-even", "return-cos2", "leakage", "windowing", "obstruction", "extinction", "contrast", "fire"];

#[derive(Debug, Args)]
pub struct SweepArguments {
    /// Designs, meshes, names of cuts that come with the program, or folders of designs
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// What varies, and its values: crown_angle=30:38:0.5 (from, to, step), crown_angle=33,34.5 or
    /// material=diamond,ruby. The key is that of a proportion; tier: (its angle) or distance: and the name of a tier;
    /// crown_scale or pavilion_scale (percent of a side's height); index, material, tilt or azimuth. May be repeated;
    /// the last varies quickest
    #[arg(long, value_name = "KEY=VALUES")]
    over: Vec<AxisArgument>,
    /// A measure to list: return-even, return-cos2@15, return-even+glare, leakage, windowing, obstruction, extinction, contrast,
    /// fire, absorbed, eye-contrast, patch-size, crushed-ice, fire-seen, bow-tie, fish-eye, scintillation or scintillation-size; may be
    /// repeated [default: eight of them]
    #[arg(long = "of", value_name = "MEASURE")]
    measures: Vec<MeasureName>,
    /// The file to write: .csv or .jsonl, row by row, or .parquet in the end [default: CSV on standard output]
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Continue the file of --out, where the same command was stopped
    #[arg(long, requires = "out")]
    resume: bool,
    /// Draw the measures over one axis as curves with their bounds, or one measure over two axes as a map, as .svg, .png or .pdf; without
    /// --out and --json no table is printed
    #[arg(long, value_name = "FILE", conflicts_with = "resume")]
    plot: Option<PathBuf>,
    /// Print JSON lines to standard output
    #[arg(long, conflicts_with = "out")]
    json: bool,
    /// The diameter in mm of the pupil over which colours must spread to count as fire [default: 3.3]
    #[arg(long, value_name = "MM", value_parser = pupil_diameter)]
    pupil: Option<f64>,
    /// The angle by which the stone rocks for scintillation
    #[arg(long, value_name = "DEGREES", default_value_t = ROCK_DEG, value_parser = rock_angle)]
    rock: f64,
    #[command(flatten)]
    taking: MeasureTaking,
}

/// An axis as it is written on the command line.
#[derive(Debug, Clone)]
struct AxisArgument(SweepAxis);

/// The reason why a text is no axis.
#[derive(Debug, thiserror::Error)]
enum AxisError {
    #[error("give what varies and its values, as in crown_angle=30:38:0.5")]
    NoValues,
    #[error("'{0}' is no range: give from, to and a step that leads there, as in 30:38:0.5")]
    Range(String),
    #[error("'{0}' has more than {MOST_VALUES} values; take a larger step")]
    TooMany(String),
}

impl FromStr for AxisArgument {
    type Err = AxisError;

    fn from_str(text: &str) -> Result<Self, AxisError> {
        // Names of tiers may hold an equals sign; values never do.
        let (key, list) = text.rsplit_once('=').ok_or(AxisError::NoValues)?;
        let key = SweepKey::of(key.trim());
        let mut values = vec![];
        for part in list.split(',').map(str::trim) {
            if part.is_empty() {
                return Err(AxisError::NoValues);
            }
            match (part.parse::<f64>(), part.contains(':')) {
                (Ok(number), _) => values.push(SweepValue::Number(number)),
                (Err(_), true) => values.extend(range(part)?.into_iter().map(SweepValue::Number)),
                (Err(_), false) => values.push(SweepValue::Name(part.to_owned())),
            }
        }
        Ok(Self(SweepAxis { key, values }))
    }
}

/// Returns the values of a range such as 30:38:0.5, both ends included.
fn range(text: &str) -> Result<Vec<f64>, AxisError> {
    let fault = || AxisError::Range(text.to_owned());
    let numbers: Result<Vec<f64>, _> = text.split(':').map(|part| part.trim().parse()).collect();
    let &[from, to, step] = numbers.map_err(|_| fault())?.as_slice() else { return Err(fault()) };
    let steps = (to - from) / step;
    if !steps.is_finite() || steps < 0.0 {
        return Err(fault());
    }
    if steps >= MOST_VALUES as f64 {
        return Err(AxisError::TooMany(text.to_owned()));
    }
    // A range whose last step misses its end only by rounding includes the end.
    let count = (steps + 1e-9).floor() as usize + 1;
    Ok((0..count).map(|k| from + k as f64 * step).collect())
}

/// The outputs of a sweep: its table and its plot, and the counts for the messages at the end.
struct SweepOutputs<'a> {
    measures: &'a [MeasureName],
    /// The number of files.
    files: usize,
    table: Option<SweepTable>,
    plot: Option<SweepPlot<'a>>,
    /// The number of points without measures.
    failed: usize,
    /// The number of files that make no sweep.
    failed_files: usize,
    /// The reason why the first of these points has no measures.
    first_reason: Option<String>,
    /// The number of points with a warning that the given design does not have, and the warning of the first.
    odd: usize,
    first_odd: Option<String>,
}

impl SweepArguments {
    pub fn run(&self) -> Result<(), Failure> {
        self.check()?;
        let (files, measures) = (expanded(&self.files)?, self.measures());
        // A fault of the first design, which is often the only one, is reported before a file is begun or replaced.
        let first = files.first().map(|file| self.sweep(file, &measures));
        let mut loaded = match first {
            Some(Err(failure)) if files.len() == 1 => return Err(failure),
            first => first,
        };
        let mut outputs =
            self.outputs(&files, loaded.as_ref().and_then(|sweep| sweep.as_ref().ok()), &measures)?;
        let points = self.points();
        let kept = outputs.table.as_ref().map_or(0, SweepTable::kept);
        let progress = WorkProgress::new(&sweeping(&files));
        let left = (files.len() * points).saturating_sub(kept).max(1) as f64;
        for (number, file) in files.iter().enumerate().skip(kept / points) {
            let sweep = loaded.take().filter(|_| number == 0).unwrap_or_else(|| self.sweep(file, &measures));
            let from = kept.saturating_sub(number * points);
            let (before, these) = ((number * points + from - kept) as f64, (points - from) as f64);
            let watch = |done: f64| progress.watch()((before + done * these) / left);
            self.sweep_file(file, (sweep, from..points), &watch, &mut outputs)?;
        }
        drop(progress);
        // A plot that cannot be drawn must not lose a row of the table.
        if let Some(table) = outputs.table.take() {
            table.finish()?;
            self.out.iter().try_for_each(|out| written(out))?;
        }
        match &outputs.plot {
            Some(plot) if outputs.failed < files.len() * points => {
                written_beside(self.json, plot.write(&stem(&files[0]))?)?;
            }
            _ => {}
        }
        outputs.end(files.len() * points)
    }

    fn check(&self) -> Result<(), Failure> {
        self.taking.check()?;
        if self.points() > MOST_POINTS {
            let text = format!("{} points are more than {MOST_POINTS}; take larger steps", self.points());
            return Err(Failure::Usage(text));
        }
        Ok(())
    }

    /// Returns the number of points of one design.
    fn points(&self) -> usize {
        self.over.iter().fold(1, |count: usize, axis| count.saturating_mul(axis.0.values.len()))
    }

    /// Opens the table, unless the options name only a plot, and begins the plot.
    fn outputs<'a>(
        &self,
        files: &[PathBuf],
        sweep: Option<&Sweep>,
        measures: &'a [MeasureName],
    ) -> Result<SweepOutputs<'a>, Failure> {
        let plot = match (&self.plot, sweep, files) {
            (None, ..) => None,
            (Some(path), Some(sweep), [_]) => {
                Some(SweepPlot::new(path, (&sweep.design.cut, &sweep.axes), measures)?)
            }
            (Some(_), ..) => return Err(Failure::Usage("--plot is of one design; give one".into())),
        };
        let is_wanted = plot.is_none() || self.out.is_some() || self.json;
        let table = is_wanted.then(|| self.table(files, measures)).transpose()?;
        Ok(SweepOutputs {
            measures,
            files: files.len(),
            table,
            plot,
            failed: 0,
            failed_files: 0,
            first_reason: None,
            odd: 0,
            first_odd: None,
        })
    }

    fn measures(&self) -> Vec<MeasureName> {
        if self.measures.is_empty() {
            USUAL.iter().filter_map(|name| name.parse().ok()).collect()
        } else {
            self.measures.clone()
        }
    }

    fn table(&self, files: &[PathBuf], measures: &[MeasureName]) -> Result<SweepTable, Failure> {
        let axes = self.over.iter().map(|axis| axis.0.key.to_string());
        let of_measures = measures.iter().flat_map(|name| [name.to_string(), format!("{name}_error")]);
        let before = ["file".to_owned()].into_iter().chain(axes).chain(["carats".to_owned()]);
        let columns = before.chain(of_measures).chain(["unresolved", "error"].map(String::from)).collect();
        let is_name = |value: &SweepValue| matches!(value, SweepValue::Name(_));
        let axes: Vec<bool> = self.over.iter().map(|axis| axis.0.values.iter().any(is_name)).collect();
        let table = SweepTable::open(columns, &axes, (self.out.as_deref(), self.json, self.resume))?;
        if table.kept() >= files.len() * self.points() {
            return Err(another_sweep(self.out.as_deref().unwrap_or(Path::new("-"))));
        }
        Ok(table)
    }

    /// Returns the values of a point for its row.
    fn labels(&self, point: usize) -> Vec<String> {
        let axes: Vec<SweepAxis> = self.over.iter().map(|axis| axis.0.clone()).collect();
        SweepAxis::values_at(&axes, point).into_iter().map(ToString::to_string).collect()
    }

    /// Measures points of one file. Of several files, one with an error has it in the rows of its points.
    fn sweep_file(
        &self,
        file: &Path,
        (sweep, points): (Result<Sweep, Failure>, Range<usize>),
        watch: Watch,
        outputs: &mut SweepOutputs,
    ) -> Result<(), Failure> {
        let name = file.display().to_string();
        let sweep = match sweep {
            Ok(sweep) => sweep,
            Err(Failure::Input(message) | Failure::Usage(message)) if outputs.files > 1 => {
                say(&format!("error: {message}"));
                outputs.failed_files += 1;
                return points
                    .into_iter()
                    .try_for_each(|point| outputs.put(&name, &self.labels(point), (None, &message)));
            }
            Err(failure) => return Err(failure),
        };
        let usual = Specimen::new(sweep.design.clone()).map(|given| given.warnings).unwrap_or_default();
        sweep.run(points, watch, |point, found| {
            let warnings = found.iter().flat_map(|stone| &stone.warnings);
            if let Some(odd) = warnings.into_iter().find(|warning| !usual.contains(warning)) {
                outputs.odd += 1;
                outputs.first_odd.get_or_insert_with(|| format!("{}: {odd}", self.labels(point).join(", ")));
            }
            let error = found.as_ref().err().map_or(String::new(), SweepError::to_string);
            outputs.put(&name, &self.labels(point), (found.as_ref().ok(), &error))
        })
    }

    fn sweep(&self, file: &Path, measures: &[MeasureName]) -> Result<Sweep, Failure> {
        let axes = self.over.iter().map(|axis| axis.0.clone()).collect();
        let mut sweep = self.taking.sweep(file, axes, measures)?;
        let unit_mm = 0.5 * sweep.design.diameter_mm;
        sweep.settings.pattern = PatternSettings::needed_by(measures, unit_mm, self.rock);
        sweep.settings.blur_deg = self.pupil.map_or(sweep.settings.blur_deg, pupil_deg);
        sweep.check().map_err(|error| Failure::Usage(format!("{}: {error}", file.display())))?;
        Ok(sweep)
    }
}

impl SweepOutputs<'_> {
    /// Puts a point into the table and the plot.
    fn put(
        &mut self,
        file: &str,
        point: &[String],
        found: (Option<&SweptStone>, &str),
    ) -> Result<(), Failure> {
        if found.0.is_none() {
            self.failed += 1;
            self.first_reason.get_or_insert_with(|| found.1.to_owned());
        }
        if let Some(plot) = &mut self.plot {
            plot.take_in(found.0);
        }
        match &mut self.table {
            Some(table) => table.write((file, point), self.measures, found),
            None => Ok(()),
        }
    }
}

impl SweepOutputs<'_> {
    /// Prints how many of all points have no measures.
    ///
    /// # Errors
    /// Fails with [`Failure::Input`] where no point has measures, or where a file makes no sweep.
    fn end(&self, all: usize) -> Result<(), Failure> {
        let Self { failed, failed_files, files, .. } = *self;
        let reason = self.first_reason.as_deref().unwrap_or_default();
        if let Some(first) = &self.first_odd {
            say(&format!("warning: at {} of {all} points the stone is odd; the first, {first}", self.odd));
        }
        if failed == 0 {
            return Ok(());
        }
        if failed == all {
            return Err(Failure::Input(format!("no point has measures; the first: {reason}")));
        }
        say(&format!("note: {failed} of {all} points have no measures; the first: {reason}"));
        match failed_files {
            0 => Ok(()),
            _ => Err(Failure::Input(format!("{failed_files} of {files} designs could not be measured"))),
        }
    }
}

/// Returns the name of a sweep over these files for its progress bar.
fn sweeping(files: &[PathBuf]) -> String {
    match files {
        [file] => format!("sweeping {}", file.display()),
        several => format!("sweeping {} designs", several.len()),
    }
}

/// Returns the files, with those of each folder in its place, sorted by name. The name of a cut that comes with the program
/// stands for that cut, as in all commands, even where a folder has the same name.
fn expanded(given: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut files = vec![];
    for path in given {
        if !path.is_dir() || library::cut(&path.display().to_string()).is_some() {
            files.push(path.clone());
            continue;
        }
        let refused = |error: std::io::Error| Failure::Input(format!("{}: {error}", path.display()));
        let mut inside = vec![];
        for entry in std::fs::read_dir(path).map_err(refused)? {
            let file = entry.map_err(refused)?.path();
            if file.is_file() && DesignFormat::of_name(&file).is_some() {
                inside.push(file);
            }
        }
        if inside.is_empty() {
            return Err(Failure::Input(format!("{}: the folder holds no design", path.display())));
        }
        inside.sort();
        files.extend(inside);
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<String> {
        let AxisArgument(axis) = text.parse().unwrap();
        axis.values.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn axes_are_lists_and_ranges_with_both_ends() {
        assert_eq!(values("crown_angle=30:31:0.25"), ["30", "30.25", "30.5", "30.75", "31"]);
        assert_eq!(values("tilt=-1:1:1, 5").len(), 4);
        assert_eq!(values("pavilion_angle=40:41:0.1").len(), 11);
        assert_eq!(values("pavilion_angle=40:41:0.1")[3], "40.3");
        assert_eq!(values("material=diamond,ruby,2.0"), ["diamond", "ruby", "2"]);
        assert_eq!(values("tier:P=1=41:40:-0.5"), ["41", "40.5", "40"]);
        for text in
            ["", "crown", "crown=", "crown=1,,2", "crown=30:38", "crown=30:38:0", "crown=30:38:-1", "a=1:x:2"]
        {
            assert!(text.parse::<AxisArgument>().is_err(), "{text}");
        }
        assert!(matches!("a=0:1:1e-9".parse::<AxisArgument>(), Err(AxisError::TooMany(_))));
        assert!("a=nan:1:1".parse::<AxisArgument>().is_err());
    }
}
