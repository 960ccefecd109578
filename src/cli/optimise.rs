//! `optimise`: finds a better design by a goal, and prints which measures rose and which fell.

use super::comments;
use super::console::{OfFile, print, print_json, say, written_beside};
use super::optimise_text::text;
use super::options::number;
use super::plot_file::PlotFile;
use super::progress::{WorkProgress, finish_on_signals, is_asked_to_finish};
use super::specimen::{lacks_fire, no_fire, note_namesakes, note_no_fire};
use super::specimen_options::SpecimenOptions;
use brillianteer_base::{Failure, unwatched};
use brillianteer_cut::Design;
use brillianteer_files::check_writable;
use brillianteer_files::design_file::{self, DesignFormat};
use brillianteer_measure::{MeasureName, NoMeasure};
use brillianteer_paper::goal_file;
use brillianteer_paper::plot::{PLOT_SIZE, PlotAxis, PlotCurve, curves};
use brillianteer_render::SweepKey;
use brillianteer_scene::Specimen;
use brillianteer_search::{
    DesignSearch, Goal, GoalMeasure, OtherMeasure, SearchError, SearchOptions, SearchOutcome, SearchSummary,
};
use clap::Args;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::str::FromStr;
use std::time::Instant;

#[derive(Debug, Args)]
pub struct OptimiseArguments {
    /// A design, or the name of a cut that comes with the program
    file: PathBuf,
    /// A goal file; see docs/formats.md
    #[arg(long, value_name = "FILE")]
    goal: Option<PathBuf>,
    /// A measure to raise, face up, with a weight if not 1, as in return-cos2 or fire=0.5; may be repeated
    #[arg(long, value_name = "MEASURE[=WEIGHT]")]
    raise: Vec<WeightedMeasure>,
    /// A measure to lower, in the same way
    #[arg(long, value_name = "MEASURE[=WEIGHT]")]
    lower: Vec<WeightedMeasure>,
    /// A number that may change, and its range, as in crown_angle=30:38, tier:P1=40:44 or pavilion_scale=90:110 (percent of its height); may
    /// be repeated [default: the goal file's, or else all that the design gives but for its outline and girdle]
    #[arg(long, value_name = "KEY=FROM:TO")]
    vary: Vec<VariedRange>,
    /// Let angles end on multiples of this, as a machine's scale has them, such as 0.1 [default: any angle]
    #[arg(long, value_name = "DEGREES", value_parser = number)]
    angle_step: Option<f64>,
    #[command(flatten)]
    specimen: SpecimenOptions,
    /// The file to write the design to; its ending names the format
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Draw how the best grew, as .svg, .png or .pdf
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Stop after this time with the best so far, as Ctrl-C does
    #[arg(long, value_name = "SECONDS", value_parser = number)]
    seconds: Option<f64>,
    /// Follow the beams near the best until no more than this part of the light is unresolved
    #[arg(long, value_name = "PART", default_value_t = SearchOptions::default().unresolved, value_parser = number)]
    unresolved: f64,
    /// The number of designs that are scattered over all ranges first [default: as many as the numbers need]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    scatter: Option<u32>,
    /// The number of the scattered designs from which the search climbs
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=1000))]
    climbs: u32,
    /// The seed of the scatter: another number scatters other designs
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u32,
    /// Let an audit of the result find more than one of the given design, as the key new_findings of a goal file does. Otherwise small
    /// facets, short edges, the girdle's thickness and the estimated class are limited too
    #[arg(long)]
    new_findings: bool,
    /// Treat the light as unpolarised at every surface
    #[arg(long)]
    unpolarised: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// A measure with its weight as it is written on the command line.
#[derive(Debug, Clone)]
struct WeightedMeasure(MeasureName, f64);

/// The reason why a text is no part of a goal.
#[derive(Debug, thiserror::Error)]
enum GoalArgumentError {
    #[error("'{0}': give a weight above 0, as in fire=0.5")]
    Weight(String),
    #[error(transparent)]
    Measure(#[from] NoMeasure),
    #[error("'{0}': give a number and its range, as in crown_angle=30:38")]
    Range(String),
}

impl FromStr for WeightedMeasure {
    type Err = GoalArgumentError;

    fn from_str(text: &str) -> Result<Self, GoalArgumentError> {
        let (name, weight) = text.rsplit_once('=').unwrap_or((text, "1"));
        let weight = weight.trim().parse::<f64>().ok().filter(|weight| *weight > 0.0 && weight.is_finite());
        let weight = weight.ok_or_else(|| GoalArgumentError::Weight(text.to_owned()))?;
        Ok(Self(name.trim().parse()?, weight))
    }
}

/// A number with its range as it is written on the command line.
#[derive(Debug, Clone)]
struct VariedRange(String, [f64; 2]);

impl FromStr for VariedRange {
    type Err = GoalArgumentError;

    fn from_str(text: &str) -> Result<Self, GoalArgumentError> {
        let fault = || GoalArgumentError::Range(text.to_owned());
        // Names of tiers may hold an equals sign; ranges never do.
        let (key, range) = text.rsplit_once('=').ok_or_else(fault)?;
        let (from, to) = range.split_once(':').ok_or_else(fault)?;
        match (from.trim().parse(), to.trim().parse()) {
            (Ok(from), Ok(to)) if from < to => Ok(Self(key.trim().to_owned(), [from, to])),
            _ => Err(fault()),
        }
    }
}

/// Prints which numbers the search leaves as they are.
fn note_held(path: &str, search: &DesignSearch) {
    let keys: Vec<String> = search.objective().held().iter().map(|held| held.key.to_string()).collect();
    let (are, they) = if keys.len() == 1 { ("is", "it") } else { ("are", "they") };
    if !keys.is_empty() {
        let all = keys.join(", ");
        say(&format!(
            "note: {path}: {all} {are} held: no meet that is known would be kept if {they} changed"
        ));
    }
}

impl OptimiseArguments {
    pub fn run(&self) -> Result<(), Failure> {
        let goal = self.goal()?;
        let format = self.format()?;
        let plot = self.plot.as_deref().map(PlotFile::new).transpose()?;
        self.out.iter().chain(&self.plot).try_for_each(|path| check_writable(path))?;
        self.out.iter().try_for_each(|out| comments::keep(&self.file, out, "give another name"))?;
        let specimen = self.specimen.load(&self.file)?;
        let path = specimen.path.clone();
        let refused = |error: SearchError| match error {
            SearchError::Stopped => Failure::Stopped,
            error if error.is_of_design() => Failure::Input(format!("{path}: {error}")),
            error => Failure::Usage(format!("{path}: {error}")),
        };
        let search =
            DesignSearch::new(&specimen.design, &goal, self.options(), &brillianteer_base::unwatched);
        let search = search.map_err(refused)?;
        if self.goal.is_none() && self.raise.is_empty() && self.lower.is_empty() {
            say(
                "note: no goal is given, so return-cos2=0.5, return-cos2@10=0.5 and fire=1 are raised, and neither return-cos2@10 nor \
                 fire may fall; --raise names another",
            );
        }
        let own = goal.measure.iter().filter(|measure| measure.material.is_none() && measure.weight != 0.0);
        let where_to = "by --material, or by the key material of a measure in a goal file";
        let weighted = || goal.measure.iter().filter(|measure| measure.weight != 0.0);
        let is_dark =
            |measure: &GoalMeasure| measure.material.is_none() && lacks_fire(&specimen.material, measure.of);
        if weighted().next().is_some() && weighted().all(is_dark) {
            let why = no_fire(&specimen.material, where_to);
            return Err(Failure::Usage(format!("{path}: nothing to search for: {why}")));
        }
        note_no_fire(&specimen.material, own.map(|measure| measure.of), where_to);
        note_namesakes(
            &path,
            &specimen.design.cut,
            &goal.vary.keys().map(|key| SweepKey::of(key)).collect::<Vec<_>>(),
        );
        note_held(&path, &search);
        let outcome = self.searched(&search, &path).map_err(refused)?;
        if outcome.was_stopped {
            say("note: the search was stopped early; the best design was not measured again more finely");
        }
        if !outcome.keeps_limits {
            say(&format!(
                "warning: {path}: no design was found that keeps all limits; the design stays as it is"
            ));
        }
        // The design is written first, so that a later failure cannot lose it, and the result is printed even where
        // the file cannot be written.
        let kept = self.write(format, renamed(&outcome, search.objective().design()));
        let others = OtherMeasure::all(&search, &outcome, &unwatched).map_err(refused)?;
        let result = || SearchSummary::of(&search, &outcome, &others);
        if self.json {
            print_json(&OfFile { file: &path, result: result() })?
        } else {
            print(&text(&goal, &search, &outcome, &others))?
        }
        kept?;
        self.draw(plot.as_ref(), &specimen.design.name, &outcome)?;
        self.out.iter().try_for_each(|out| written_beside(self.json, out))
    }

    /// Draws how the best grew.
    fn draw(&self, plot: Option<&PlotFile>, name: &str, outcome: &SearchOutcome) -> Result<(), Failure> {
        let Some(plot) = plot else { return Ok(()) };
        if outcome.curve.is_empty() || outcome.appraised == 0 {
            say("note: no plot is drawn, because no design was found that keeps all limits");
            return Ok(());
        }
        let title = format!("{name}: the best of the designs so far");
        let svg = progress_svg(&title, outcome).map_err(|error| plot.failed(&error))?;
        plot.write(&svg, &title)?;
        written_beside(self.json, plot.path())
    }

    /// Returns the goal of the file and of the options.
    fn goal(&self) -> Result<Goal, Failure> {
        let mut goal = match &self.goal {
            Some(path) => goal_file::read(path)?,
            None => Goal::of([]),
        };
        let raised = self.raise.iter().map(|WeightedMeasure(of, weight)| GoalMeasure::new(*of, *weight));
        let lowered = self.lower.iter().map(|WeightedMeasure(of, weight)| GoalMeasure::new(*of, -*weight));
        goal.measure.extend(raised.chain(lowered));
        goal.vary.extend(self.vary.iter().map(|VariedRange(key, range)| (key.clone(), *range)));
        if goal.measure.is_empty() {
            let Goal { name, measure, .. } = Goal::usual();
            goal = Goal { name, measure, ..goal };
        }
        goal.new_findings |= self.new_findings;
        if self.angle_step.is_some_and(|step| !(1e-3..=10.0).contains(&step)) {
            return Err(Failure::Usage("--angle-step: give 0.001 to 10 degrees".to_owned()));
        }
        if !(self.unresolved > 0.0 && self.unresolved < 1.0) {
            return Err(Failure::Usage(format!(
                "--unresolved {}: give a part between 0 and 1",
                self.unresolved
            )));
        }
        goal.check().map_err(|fault| Failure::Usage(fault.to_string()))?;
        Ok(goal)
    }

    fn format(&self) -> Result<Option<DesignFormat>, Failure> {
        let of = |path: &PathBuf| {
            DesignFormat::of_name(path).filter(|format| format.holds_designs()).ok_or_else(|| {
                let what = "give a name that ends in .toml, .asc, .gem or .gcs";
                Failure::Usage(format!("{}: {what}", path.display()))
            })
        };
        self.out.as_ref().map(of).transpose()
    }

    fn options(&self) -> SearchOptions {
        SearchOptions {
            unresolved: self.unresolved,
            scattered: self.scatter.map(|count| count as usize),
            climbs: self.climbs as usize,
            seed: self.seed.into(),
            polarised: !self.unpolarised,
            angle_step_deg: self.angle_step,
            ..SearchOptions::default()
        }
    }

    /// Searches under a progress bar, until the end, the time or a signal.
    fn searched(&self, search: &DesignSearch, path: &str) -> Result<SearchOutcome, SearchError> {
        let begun = Instant::now();
        finish_on_signals();
        let progress = WorkProgress::new(&format!("improving {path}"));
        let show = progress.watch();
        let watch = |part: f64| {
            let is_over = self.seconds.is_some_and(|seconds| begun.elapsed().as_secs_f64() > seconds);
            if is_over || is_asked_to_finish() { ControlFlow::Break(()) } else { show(part) }
        };
        search.run(&watch, &|_| {})
    }

    fn write(&self, format: Option<DesignFormat>, design: Design) -> Result<(), Failure> {
        let (Some(out), Some(format)) = (&self.out, format) else { return Ok(()) };
        let made = Specimen::new(design).map_err(|error| Failure::Output(error.to_string()))?;
        let lost = design_file::write(&made, format, out)?;
        lost.iter().for_each(|what| say(&format!("note: {}: {what}", out.display())));
        Ok(())
    }
}

/// Returns the found design under a name of its own: the source and the notes of the given design do not apply to it.
fn renamed(outcome: &SearchOutcome, given: &Design) -> Design {
    let mut design = outcome.design.clone();
    if design != *given {
        design.rename(format!("{}, improved", given.name));
        (design.source, design.notes) = (None, None);
    }
    design
}

/// Draws the total of the best against the number of designs that were appraised.
fn progress_svg(title: &str, outcome: &SearchOutcome) -> Result<String, brillianteer_paper::plot::PlotError> {
    let mut places = vec![];
    let mut bands = vec![];
    for point in &outcome.curve {
        let at = point.appraised as f64;
        // Threads may report two designs for the same number of appraisals; the better one counts.
        if places.last() == Some(&at) {
            places.pop();
            bands.pop();
        }
        // Between two finds the best total stays as it is.
        if let (Some(before), true) =
            (bands.last().copied(), places.last().is_some_and(|last| at - last > 1.0))
        {
            places.push(at - 0.5);
            bands.push(before);
        }
        places.push(at);
        bands.push(Some([point.total; 2]));
    }
    if let Some(last) = bands.last().copied() {
        let end = outcome.appraised as f64;
        if places.last().is_some_and(|place| *place < end) {
            places.push(end);
            bands.push(last);
        }
    }
    let axis = PlotAxis { label: "designs appraised".to_owned(), values: places };
    curves((title, PLOT_SIZE), &axis, "goal", &[PlotCurve { name: "best so far".to_owned(), bands }])
}
