//! `measure`: prints the figures of one view.

use super::batch::{each_file, print_json_of};
use super::console::{OfFile, print, say};
use super::estimate_list::{NotedEstimate, estimated, table_of_estimate};
use super::hearts_list::{table_of_hearts, table_of_spread};
use super::options::{LightOptions, ViewOptions, pupil_diameter, rock_angle, scoped};
use super::progress::WorkProgress;
use super::specimen::LoadedSpecimen;
use super::specimen_options::SpecimenOptions;
use brillianteer_base::Failure;
use brillianteer_math::signed;
use brillianteer_measure::{
    ClassDeviations, ErringDeviation, FaceUpSize, PatternSettings, facet_deviations, pupil_deg,
};
use brillianteer_paper::export::{
    FigureReport, MeasureReport, Reporter, Viewing, hearts, light_measures, measure,
};
use brillianteer_paper::table::{Column, Table, TableCell};
use brillianteer_picture::Scoped;
use brillianteer_render::{Card, Renderer};
use brillianteer_scene::{DomeLight, Glare};
use clap::Args;
use serde::Serialize;
use std::fmt::Write;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct Measure {
    /// Designs or meshes, or names of cuts that come with the program
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Print JSON: one object, or for several files one object a line
    #[arg(long)]
    json: bool,
    /// List measures of the cut instead of zones: the return of domes, leakage, windowing, obstruction, extinction, contrast, fire,
    /// and the pattern that an eye sees on a stone of this size, each as far as it is certain
    #[arg(long, conflicts_with_all = ["scope", "no_glare", "timing"])]
    measures: bool,
    /// List instead how far the facets of an eightfold round brilliant deviate from their classes in azimuth and slope, in degrees,
    /// and which facet deviates most
    #[arg(long, conflicts_with_all = ["scope", "no_glare", "timing", "measures"])]
    deviations: bool,
    /// Measure instead the hearts and arrows of a round brilliant on exact beams, octant by octant: areas, lengths, widths, clefts,
    /// gaps to the V's, and how far they depart from eightfold symmetry
    #[arg(long, conflicts_with_all = ["scope", "no_glare", "timing", "measures", "deviations", "side", "tilt", "eye_tilt", "azimuth",
        "perspective", "tracer", "head"])]
    hearts: bool,
    /// Print instead how large a stone looks from above for its weight: its face, and its spread and weight ratio beside a
    /// reference brilliant
    #[arg(long, conflicts_with_all = ["scope", "no_glare", "timing", "measures", "deviations", "hearts", "side", "tilt", "eye_tilt",
        "azimuth", "perspective", "tracer", "head"])]
    spread: bool,
    /// Print instead a class of the cut of a round brilliant of diamond, estimated after the ranges that GIA publishes and a fit of our
    /// own. It is not a grade
    #[arg(long, conflicts_with_all = ["scope", "no_glare", "timing", "measures", "deviations", "hearts", "spread", "side", "tilt",
        "eye_tilt", "azimuth", "perspective", "tracer", "head"])]
    estimate: bool,
    /// A dome whose return --measures lists: even, cos, cos2 or cos with another power, and if you like a head's half angle, as in
    /// cos2@15; may be repeated. Without it: even, cos, cos2 and even@15
    #[arg(long = "dome", value_name = "DOME", requires = "measures")]
    domes: Vec<DomeLight>,
    /// List scintillation among the measures as well: what changes as the stone rocks by so many degrees, such as 3
    #[arg(long, value_name = "DEGREES", requires = "measures", value_parser = rock_angle)]
    rock: Option<f64>,
    /// List the weighted light return among the measures as well (after Hemphill, Reinitz and others, 1998): it is seen from all around
    /// and sampled, so it has a standard error instead of a bound
    #[arg(long, requires = "measures")]
    wlr: bool,
    /// The diameter in mm of the pupil over which colours must spread to count as fire among the measures [default: 3.3]
    #[arg(long, value_name = "MM", requires = "measures", value_parser = pupil_diameter)]
    pupil: Option<f64>,
    /// The scope whose zones are measured: a scope's name (see `scopes`), or a scope file [default: aset]
    #[arg(long, value_name = "SCOPE")]
    scope: Option<PathBuf>,
    /// Print how long it took, which differs from run to run
    #[arg(long)]
    timing: bool,
    #[command(flatten)]
    view: ViewOptions,
    #[command(flatten)]
    light: LightOptions,
    /// An option of `export`. It is declared here so that an error can point to that command.
    #[arg(long, hide = true)]
    glare: bool,
    #[command(flatten)]
    specimen: SpecimenOptions,
}

impl Measure {
    pub fn run(&self) -> Result<(), Failure> {
        if self.glare {
            return Err(Failure::Usage(
                "--glare is an option of `export`, whose pictures hold no glare without it; `measure` lists glare \
                 beside the rest, unless --no-glare is given"
                    .into(),
            ));
        }
        let scoped = self.scope.as_deref().map_or_else(|| Ok(Scoped::aset()), scoped)?;
        each_file(&self.files, self.json, |file| {
            let specimen = self.specimen.load(file)?;
            if self.deviations {
                return self.list_deviations(&specimen);
            }
            if self.spread {
                return self.list_spread(&specimen);
            }
            if self.estimate {
                return self.list_estimate(&specimen);
            }
            let mut renderer = Renderer::new(Card::Machine);
            let viewing = self.light.viewing(&specimen, &self.view, &renderer)?;
            if self.hearts {
                return self.list_hearts(&viewing);
            }
            if self.measures {
                return self.list(&viewing, &mut renderer);
            }
            let report = {
                let progress = WorkProgress::new(&format!("measuring {}", specimen.path));
                measure(&viewing, &scoped, &mut renderer, &progress.watch(), &|event| progress.report(event))?
            };
            if self.light.exact && !report.backend.is_beams() {
                say(
                    "note: --exact is about exact beams; these figures are sampled by rays, with a standard error",
                );
            }
            if self.json {
                return print_json_of(&self.files, &report.figures(self.timing));
            }
            print(&table(&report, self.timing))
        })
    }
}

impl Measure {
    /// Prints the measures of a stone as a table or as JSON.
    fn list(&self, viewing: &Viewing, renderer: &mut Renderer) -> Result<(), Failure> {
        let report = {
            let progress = WorkProgress::new(&format!("measuring {}", viewing.file));
            let mut settings = viewing.measure_settings(&self.domes);
            settings.blur_deg = self.pupil.map_or(settings.blur_deg, pupil_deg);
            settings.pattern = settings.pattern.map(|of| PatternSettings { rock_deg: self.rock, ..of });
            let watch = progress.watch();
            let tell: Reporter = &|event| progress.report(event);
            let mut report = light_measures(viewing, settings, renderer, &watch, tell)?;
            if self.wlr {
                report.weigh_return();
            }
            report
        };
        if self.json {
            return print_json_of(&self.files, &report.measures());
        }
        print(&list_of_measures(&report))
    }
}

impl Measure {
    /// Prints the deviations of a stone's facets as a table or as JSON.
    fn list_deviations(&self, specimen: &LoadedSpecimen) -> Result<(), Failure> {
        let refused = |why: &dyn std::fmt::Display| Failure::Input(format!("{}: {why}", specimen.path));
        let stone = specimen.convex_stone("deviations are measured of round brilliants, which are convex")?;
        let classes = facet_deviations(stone).map_err(|why| refused(&why))?;
        let deviations: Vec<_> = classes.iter().map(|class| class.with_errors(&specimen.errors)).collect();
        if self.json {
            let result = FoundDeviations { deviations };
            return print_json_of(&self.files, &OfFile { file: &specimen.path, result });
        }
        print(&table_of_deviations(specimen, &deviations))
    }
}

impl Measure {
    /// Prints a stone's hearts and arrows as tables or as JSON.
    fn list_hearts(&self, viewing: &Viewing) -> Result<(), Failure> {
        let report = {
            let progress = WorkProgress::new(&format!("measuring {}", viewing.file));
            hearts(viewing, &progress.watch())?
        };
        if self.json {
            return print_json_of(&self.files, &report.figures());
        }
        print(&table_of_hearts(&report))
    }

    /// Prints a stone's spread as a table or as JSON.
    fn list_spread(&self, specimen: &LoadedSpecimen) -> Result<(), Failure> {
        let stone = specimen.convex_stone("spread is measured of convex stones between planes")?;
        let size = FaceUpSize::of(&stone.polytope, specimen.unit_mm(), specimen.carats());
        if self.json {
            let result = FoundSpread { material: &specimen.material.name, spread: size };
            return print_json_of(&self.files, &OfFile { file: &specimen.path, result });
        }
        print(&table_of_spread(&specimen.path, &size))
    }
}

impl Measure {
    /// Prints the class of a stone, estimated after GIA, as a table or as JSON.
    fn list_estimate(&self, specimen: &LoadedSpecimen) -> Result<(), Failure> {
        let estimate = estimated(specimen)?;
        if self.json {
            let result = NotedEstimate::of(estimate);
            return print_json_of(&self.files, &OfFile { file: &specimen.path, result });
        }
        print(&table_of_estimate(&specimen.path, &estimate))
    }
}

/// The deviations of a stone's facets.
#[derive(Serialize)]
struct FoundDeviations {
    deviations: Vec<ClassDeviations<ErringDeviation>>,
}

/// The size of a stone for its weight.
#[derive(Serialize)]
struct FoundSpread<'a> {
    /// The name of the material.
    material: &'a str,
    spread: FaceUpSize,
}

/// Formats deviations as a table, in degrees.
fn table_of_deviations(specimen: &LoadedSpecimen, classes: &[ClassDeviations<ErringDeviation>]) -> String {
    let (errors, wide) = if specimen.errors.is_empty() { ("", 24) } else { (" ± its standard error", 34) };
    let mut table = Table::headed([
        Column::left("class", 12),
        Column::right("azimuth", 9).digits(3),
        Column::right("worst", wide),
        Column::right("slope", 9).digits(3),
        Column::right("worst", wide),
    ]);
    let worst = |of: &ErringDeviation, spread: f64| {
        if spread < NOT_SHOWN_DEG {
            "-".to_owned()
        } else {
            let error = of.error_deg.map_or(String::new(), |error| format!(" ± {error:.3}"));
            format!("{} {}{error}", of.deviation.facet, signed(of.deviation.by_deg, 3))
        }
    };
    for each in classes {
        let [azimuth, slope] = [each.azimuth_spread_deg, each.slope_spread_deg];
        let turned = worst(&each.worst_azimuth, azimuth).into();
        let leant = worst(&each.worst_slope, slope).into();
        table.row([each.class.into(), azimuth.into(), turned, slope.into(), leant]);
    }
    format!("{}: deviations in degrees, max - min and the worst facet{errors}\n\n{table}", specimen.path)
}

/// Spreads below this, degrees, are printed as 0, and then no facet is named as the worst.
const NOT_SHOWN_DEG: f64 = 5e-4;

/// Formats measures as a table, in percent of the silhouette.
fn list_of_measures(report: &MeasureReport) -> String {
    let MeasureReport { viewing, settings, measures, weighted_return } = report;
    let mut table = Table::headed([
        Column::left("% of face", 28),
        Column::right("value", 9).digits(3),
        Column::right("± at most", 10).digits(3),
        Column::text("").after(1),
    ]);
    for (name, interval) in report.by_name() {
        // A difference that is 0 except for rounding gets no sign.
        let [value, error] = [interval.middle(), interval.error()].map(|part| (1e11 * part).round() / 1e9);
        table.row([name.to_string().into(), value.into(), error.into()]);
    }
    if let Some(found) = weighted_return {
        let [value, error] = [found.value, found.standard_error].map(|part| TableCell::Number(100.0 * part));
        table.row(["wlr".into(), value, error, "(standard error)".into()]);
    }
    let head = settings.head_deg;
    let mut text = format!(
        "{}: {}, {}, {}\n\n{table}\n",
        viewing.file,
        viewing.specimen.design.name,
        viewing.specimen.material.with_index(viewing.medium.index),
        viewing.viewpoint.description(),
    );
    let _ = write!(
        text,
        "\nThe head of obstruction, extinction and contrast has a half angle of {head}°; contrast is in percent of the mean \
         brightness."
    );
    if weighted_return.is_some() {
        text.push_str(
            "\nThe weighted light return (wlr) is seen from all around, under an even hemisphere and without glare; it is in percent of \
             what a white sheet in place of the stone returns, counted alike.",
        );
    }
    if let Some(spread) = measures.spread_deg {
        let [red, violet] = settings.indices;
        let _ = write!(
            text,
            "\nColours from index {red:.4} to {violet:.4} spread by {spread:.3}° on average; an eye sees those over {}° apart.",
            settings.blur_deg
        );
    }
    if let Some(pattern) = settings.pattern {
        let [size, seen] = [2.0 * pattern.unit_mm, pattern.resolves_mm];
        let _ = write!(
            text,
            "\nPatterns are those of a stone of {size:.2} mm for an eye that resolves {seen:.4} mm; sizes of patches are in percent \
             of the face's diameter."
        );
        if let Some(rock) = pattern.rock_deg {
            let _ = write!(
                text,
                "\nScintillation is in percent of the mean brightness, as the stone rocks by {rock}°."
            );
        }
    }
    let _ = write!(text, "\n{:.3} % of the light was not followed to its end.", 100.0 * measures.unresolved);
    text
}

/// Formats the figures as a table, in percent of the silhouette.
fn table(report: &FigureReport, timing: bool) -> String {
    let FigureReport { viewing, measured, .. } = report;
    let (f, scope) = (&measured.figures, &measured.scope);
    let has_glare = viewing.glare != Some(Glare::LeftOut);
    let mut text = format!(
        "{}: {}, {}, {}, in {}\n\n",
        viewing.file,
        viewing.specimen.design.name,
        viewing.specimen.material.with_index(viewing.medium.index),
        viewing.viewpoint.description(),
        scope.name,
    );
    let errors = f.estimate.as_ref().map(|estimate| [estimate.standard_errors(), estimate.area_errors()]);
    let columns = [
        (true, Column::left("% of face", 12)),
        (has_glare, Column::right("glare", 12)),
        (true, Column::right("transmitted", 12)),
        (errors.is_some(), Column::right("± error", 8)),
        (true, Column::right("strongest", 12)),
        (errors.is_some(), Column::right("± error", 8)),
    ];
    let is_shown = columns.each_ref().map(|(is_shown, _)| *is_shown);
    let columns = columns.into_iter().filter_map(|(is_shown, column)| is_shown.then_some(column.digits(3)));
    let mut table = Table::headed(columns.collect::<Vec<_>>());
    let mut line = |name: &str, values: [f64; 3], errors: Option<[f64; 2]>| {
        let [glare, light, area] = values.map(|part| TableCell::Number(100.0 * part));
        let error =
            |which: usize| errors.map_or("".into(), |errors| TableCell::Number(100.0 * errors[which]));
        let cells = [name.into(), glare, light, error(0), area, error(1)];
        table.row(cells.into_iter().zip(is_shown).filter_map(|(cell, is_shown)| is_shown.then_some(cell)));
    };
    for (i, band) in scope.bands.iter().enumerate().rev() {
        let values = [f.surface[i], f.transmitted[i], f.strongest_exit_area[i]];
        line(&band.name, values, errors.as_ref().map(|[light, area]| [light[i], area[i]]));
    }
    line("undecided", [0.0, 0.0, f.strongest_exit_undecided], None);
    let sum = |zones: &[f64]| zones.iter().sum::<f64>();
    let areas = sum(&f.strongest_exit_area) + f.strongest_exit_undecided;
    line("sum", [sum(&f.surface), sum(&f.transmitted), areas], None);
    let _ = writeln!(text, "{table}");
    sums(report, &mut text);
    if timing {
        let _ = write!(text, " in {:.3} s", report.seconds);
    }
    text
}

/// Writes one number of the light in percent.
fn percent(part: f64) -> String {
    format!("{:.3}", 100.0 * part)
}

/// Writes the sums of all light, their error, and the tracer.
fn sums(report: &FigureReport, text: &mut String) {
    let FigureReport { viewing, measured, .. } = report;
    let f = &measured.figures;
    let of = percent;
    let (returned, glare) = (measured.light_return(), measured.glare_return());
    let glare = if viewing.glare != Some(Glare::LeftOut) {
        format!("with glare {:.3} %", 100.0 * (returned + glare))
    } else {
        format!("glare of {:.3} % is left out", 100.0 * measured.glare())
    };
    let error = measured.light_return_error();
    let error = error.map_or(String::new(), |error| format!(" ± {} % (standard error)", of(error)));
    let (absorbed, open) = (of(f.absorbed), of(f.unresolved));
    let _ = write!(text, "\nlight return {} %{error}, {glare}, absorbed {absorbed} %, ", of(returned));
    let _ = match (&f.estimate, report.backend.is_beams()) {
        (Some(_), _) => write!(text, "estimated {open} % (included; no light can be off by more)"),
        (None, true) => write!(text, "unresolved {open} % (the most by which any light is too low)"),
        (None, false) => write!(text, "unresolved {open} %, standard error {} %", of(f.standard_error)),
    };
    let polarised = if viewing.polarised { "polarised" } else { "unpolarised" };
    let _ = write!(text, "\n{polarised}, {} by {}", f.beams, report.backend.description());
    if let Some(estimate) = &f.estimate {
        let _ = write!(text, " and {} rays for what they left", estimate.rays);
    }
}
