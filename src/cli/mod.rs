//! The command line. Each command has a file of its own.
//!
//! `options` holds the options that several commands share, `specimen` loads the stone of a command, `batch` runs a
//! command on several files, `names` resolves the names of cuts and scenes, and `console` prints.

mod audit_list;
mod batch;
mod bench;
mod choice;
mod comments;
mod console;
mod convert;
mod default_name;
#[cfg(test)]
mod documents;
mod estimate_list;
mod export;
mod families;
mod gradient;
mod hearts_list;
mod info;
mod liquid_glass;
mod lists;
mod map_files;
mod measure;
mod measure_taking;
mod meets;
mod mesh_options;
mod optimise;
mod optimise_text;
mod options;
mod picture_options;
mod picturing;
mod plot_file;
mod progress;
mod progress_lines;
mod refraction_import;
mod refraction_map;
mod render;
mod report;
mod retarget;
mod rough_yield;
mod sheet;
mod shell;
mod specimen;
mod specimen_options;
mod spin;
mod spin_motion;
mod spin_panel;
mod spin_pictures;
mod sweep;
mod sweep_parquet;
mod sweep_plot;
mod sweep_table;
mod without_window;

use brillianteer_base::Failure;
use brillianteer_files::built_design::hint;
use brillianteer_files::mesh_options::MeshOptions;
use brillianteer_files::{is_standard, library, report_made_folders};
use clap::error::ErrorKind;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use console::say;
use mesh_options::MeshArguments;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Returns the exit code of the program for a failure.
fn code(failure: &Failure) -> u8 {
    match failure {
        Failure::Input(_) => 1,
        Failure::Usage(_) => 2,
        Failure::Output(_) | Failure::NoWindow(_) => 3,
        Failure::Stopped => 130,
    }
}

/// Exact light in gemstone cuts: ASET, Ideal-Scope, hearts and arrows, with an error bound on every figure.
#[derive(Debug, Parser)]
#[command(name = "brillianteer", version, after_help = EXIT_CODES, override_usage = USAGE)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
}

/// A function that opens the editor, on a file if one is given, and waits until it is closed. A mesh is read with the given
/// options.
///
/// # Errors
/// Fails with [`Failure::NoWindow`] where the window cannot be opened, [`Failure::Output`] where it is lost later.
pub type EditorOpener = fn(Option<PathBuf>, MeshOptions) -> Result<(), Failure>;

const USAGE: &str = "brillianteer [FILE]\n       brillianteer COMMAND";

const EXIT_CODES: &str = "Exit codes: 0 done, 1 an input is at fault, 2 the command line is, 3 an output could not be \
    written, no window opened or it was lost, 130 stopped by Ctrl-C, 143 by SIGTERM. Without a command and without a screen, the main \
    pictures and figures are written to the folder out. Commands other than the editor take - as FILE for \
    standard input.";

/// The hint after an error about options or files that the editor does not take.
const EDITOR_TAKES: &str = "the editor takes one FILE and no options but --up, --as, --unit and --part, which are for meshes; \
    `brillianteer export`, `render`, `measure` and `info` take several files, and a material, a view and a light";

#[derive(Debug, Subcommand)]
enum Command {
    /// Open the editor, as the program does without a command; without a screen this fails
    Edit {
        /// A design to open, or the name of one that comes with the program
        file: Option<PathBuf>,
        #[command(flatten)]
        mesh: MeshArguments,
    },
    /// Draw a stone in every scope, with its profile, facet diagram and figures
    Export(export::ExportArguments),
    /// Show what stones look like under light: fire, colour, sparkle
    Render(render::Render),
    /// Show a stone turning, rocking or wobbling under light or in a scope, with its measures, as animated PNG, GIF or MP4
    Spin(spin::Spin),
    /// Map where the light behind each pixel comes from, for pages that look up a moving background by the map
    RefractionMap(refraction_map::RefractionMaps),
    /// Write the gradient that another renderer shows through its glass, to make a refraction map
    RefractionTemplate(refraction_import::RefractionTemplate),
    /// Take a picture that another renderer made of the template as a refraction map: page, files and look-up
    RefractionImport(refraction_import::RefractionImport),
    /// Draw a pane of liquid glass over a background as screens do, and trace the same pane beside it
    LiquidGlass(liquid_glass::LiquidGlass),
    /// Measure the light of one view: its share from each zone, with the error
    Measure(measure::Measure),
    /// Write the measures of designs over a grid of proportions, angles, materials and views
    Sweep(sweep::SweepArguments),
    /// Print how measures change with a design's proportions, the angles of its tiers and its index: exact derivatives of the light
    Gradient(gradient::GradientArguments),
    /// Find a better design by a goal: measures to raise or lower, numbers that may change, and limits
    Optimise(optimise::OptimiseArguments),
    /// Show a stone's geometry, proportions and weight, or the stones of a scene
    Info(info::Info),
    /// Write a report on a design, or a comparison of several, as PDF or as a web page: pictures, drawings, measures with bounds
    Report(report::ReportArguments),
    /// Write the sheet that a gem cutter works from: plans, profiles, and every tier in cutting order
    Sheet(sheet::SheetArguments),
    /// Fit a design to another material by a stated rule, and measure the light of both
    Retarget(retarget::RetargetArguments),
    /// Show the size, weight and yield of the stone that a piece of rough gives, or a weight needs
    Yield(rough_yield::RoughYield),
    /// Write a stone's design in another format, or the stones and metal of a scene as a mesh
    Convert(convert::Convert),
    /// Time the tracers on the same pictures
    Bench(bench::BenchArguments),
    /// List the materials known by name
    Materials(lists::List),
    /// List the cuts that come with the program, or print one as a cut file to start from
    Cuts(lists::Cuts),
    /// List the families of cuts, or print the numbers of one with their ranges and meanings
    Families(families::Families),
    /// List the scenes that come with the program, or print one as a file to start from
    Scenes(lists::Scenes),
    /// List the scopes, or print one as a file to start from
    Scopes(lists::Scopes),
    /// List the lights, or print one as a file to start from
    Lights(lists::Lights),
    /// Print a script that completes the program's commands and options in a shell
    Completions(shell::Completions),
    /// Print the manual page of the program, or of one of its commands
    Man(shell::Manual),
}

/// Parses a command line.
///
/// The value of every option may be a negative number, so that the option itself refuses one that it cannot take, and the
/// message names the option and its range.
fn parsed(words: &[OsString]) -> Result<Arguments, clap::Error> {
    let may_be_negative = |arg: clap::Arg| {
        if arg.get_action().takes_values() && !arg.is_positional() {
            arg.allow_negative_numbers(true)
        } else {
            arg
        }
    };
    let mut line = Arguments::command().mut_subcommands(|command| command.mut_args(may_be_negative));
    let matches = line.try_get_matches_from_mut(words)?;
    let mut arguments = Arguments::from_arg_matches(&matches).map_err(|error| error.format(&mut line))?;
    if let (Some(command), Some((name, given))) = (&mut arguments.command, matches.subcommand())
        && let (Some(told_apart), Some(options)) = (command.told_apart(), line.find_subcommand(name))
    {
        *told_apart = default_name::told_apart(options, given);
    }
    Ok(arguments)
}

/// Runs the program with the arguments of the process and returns its exit code.
///
/// `editor` opens the editor; it is `None` in a program built without one.
pub fn main(editor: Option<EditorOpener>) -> ExitCode {
    let typed: Vec<OsString> = std::env::args_os().collect();
    let given = spelt_out(typed.clone());
    let arguments = match parsed(&given) {
        Ok(arguments) => arguments,
        Err(error) => {
            // A failure to print help or an error is ignored; clap's own `exit` would panic over it.
            let _ = error.print();
            let meant = given.get(1).filter(|_| error.kind() == ErrorKind::InvalidSubcommand);
            if let Some(hint) = meant.map(|name| hint(Path::new(name))).filter(|hint| !hint.is_empty()) {
                say(hint.trim_start_matches("; "));
            }
            let is_edit = given.get(1).is_some_and(|command| command == "edit");
            if is_edit && error.kind() == ErrorKind::UnknownArgument {
                say(EDITOR_TAKES);
            }
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    // A user who types `edit`, or gives options of it, wants the editor, and no files in its place. An inserted `edit` with
    // one file makes three arguments.
    let is_named = (typed.len() == given.len() && given.len() > 1) || given.len() > 3;
    let command = arguments.command.unwrap_or(Command::Edit { file: None, mesh: MeshArguments::default() });
    // The editor may be writing an export as well. Its autosaved work stays on disk for the next start.
    progress::end_on_signals();
    let result = match command {
        // The folders of the editor's own files are of no interest.
        Command::Edit { file, mesh } => edit(editor, file, mesh.options(), is_named),
        command => {
            report_made_folders(console::made_folder);
            command.run()
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            say(&format!("error: {failure}"));
            ExitCode::from(code(&failure))
        }
    }
}

/// Opens the editor. Where no window opens, it writes the stone's pictures and figures to files instead, unless the user
/// named the command.
fn edit(
    editor: Option<EditorOpener>,
    file: Option<PathBuf>,
    mesh: MeshOptions,
    is_named: bool,
) -> Result<(), Failure> {
    if let Some(file) = file.as_ref().filter(|f| !f.is_file() && !library::contains(&f.to_string_lossy())) {
        let why = if file.is_dir() {
            "this is a directory; a file is expected".to_owned()
        } else if is_standard(file) {
            "the editor reads no standard input; give a file".to_owned()
        } else {
            format!("there is no such file{}", hint(file))
        };
        return Err(Failure::Input(format!("{}: {why}", file.display())));
    }
    let opened = match editor {
        Some(open) => open(file.clone(), mesh),
        None => Err(Failure::NoWindow("this program was built without its window".into())),
    };
    match opened {
        Err(Failure::NoWindow(why)) if !is_named => without_window::write(file, &why, run_line),
        Err(Failure::NoWindow(why)) => Err(Failure::NoWindow(format!(
            "{why}; `brillianteer export` and `brillianteer render` write files without it"
        ))),
        done => done,
    }
}

impl Command {
    /// Returns the place for what the options add to the default names of files, of a command that has such names.
    fn told_apart(&mut self) -> Option<&mut String> {
        match self {
            Self::Export(export) => Some(&mut export.told_apart),
            Self::Render(render) => Some(&mut render.told_apart),
            Self::Spin(spin) => Some(&mut spin.told_apart),
            Self::RefractionMap(maps) => Some(&mut maps.told_apart),
            Self::RefractionImport(import) => Some(&mut import.told_apart),
            Self::LiquidGlass(glass) => Some(&mut glass.told_apart),
            Self::Sheet(sheet) => Some(&mut sheet.told_apart),
            _ => None,
        }
    }

    /// Runs the command. `edit` always fails here, because no editor is passed on.
    fn run(self) -> Result<(), Failure> {
        match self {
            Self::Edit { file, mesh } => edit(None, file, mesh.options(), true),
            Self::Export(export) => export.run(),
            Self::Render(render) => render.run(),
            Self::Spin(spin) => spin.run(),
            Self::RefractionMap(maps) => maps.run(),
            Self::RefractionTemplate(template) => template.run(),
            Self::RefractionImport(import) => import.run(),
            Self::LiquidGlass(glass) => glass.run(),
            Self::Measure(measure) => measure.run(),
            Self::Sweep(sweep) => sweep.run(),
            Self::Gradient(gradient) => gradient.run(),
            Self::Optimise(optimise) => optimise.run(),
            Self::Info(info) => info.run(),
            Self::Report(report) => report.run(),
            Self::Sheet(sheet) => sheet.run(),
            Self::Retarget(retarget) => retarget.run(),
            Self::Yield(rough) => rough.run(),
            Self::Convert(convert) => convert.run(),
            Self::Bench(bench) => bench.run(),
            Self::Materials(list) => list.materials(),
            Self::Cuts(cuts) => cuts.run(),
            Self::Families(families) => families.run(),
            Self::Scenes(scenes) => scenes.run(),
            Self::Scopes(scopes) => scopes.run(),
            Self::Lights(lights) => lights.run(),
            Self::Completions(completions) => completions.run(Arguments::command()),
            Self::Man(manual) => manual.run(Arguments::command()),
        }
    }
}

/// Runs a command line as if the user had typed it.
fn run_line(words: Vec<OsString>) -> Result<(), Failure> {
    let arguments = parsed(&words).map_err(|e| Failure::Usage(e.to_string()))?;
    arguments.command.map_or(Ok(()), Command::run)
}

/// Inserts the command `edit` where the first argument looks like a file or names a cut or scene, and is not a command.
fn spelt_out(mut arguments: Vec<OsString>) -> Vec<OsString> {
    if let Some(first) = arguments.get(1)
        && !Arguments::command().get_subcommands().any(|command| command.get_name() == first)
        && first != "help"
        && (Path::new(first).components().count() > 1
            || Path::new(first).extension().is_some()
            || Path::new(first).exists()
            || library::contains(&first.to_string_lossy()))
        && !first.to_string_lossy().starts_with('-')
    {
        arguments.insert(1, "edit".into());
    }
    arguments
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lost_window_is_reported_and_no_files_take_its_place() {
        let lost: EditorOpener = |_, _| Err(Failure::Output("the window was lost".to_owned()));
        let failure = edit(Some(lost), None, MeshOptions::default(), false).unwrap_err();
        assert_eq!((failure.to_string().as_str(), code(&failure)), ("the window was lost", 3));
    }

    #[test]
    fn a_file_alone_is_for_the_editor() {
        let words = |text: &str| text.split(' ').map(OsString::from).collect::<Vec<_>>();
        let file = env!("CARGO_MANIFEST_DIR").to_owned() + "/cuts/tolkowsky.toml";
        for only in [file.as_str(), "tolkowsky"] {
            let arguments = parsed(&spelt_out(words(&format!("b {only}")))).unwrap();
            assert!(
                matches!(arguments.command, Some(Command::Edit { file: Some(f), .. }) if f == Path::new(only))
            );
        }
        for behind in ["tolkowsky --material ruby", "a.stl --up y", "a.obj b.obj", "tests"] {
            assert_eq!(spelt_out(words(&format!("b {behind}"))), words(&format!("b edit {behind}")));
        }
        for other in ["b", "b cuts", "b polish", "b help", "b info tolkowsky", "b --help"] {
            assert_eq!(spelt_out(words(other)), words(other));
        }
    }
}
