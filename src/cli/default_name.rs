//! The part of a default file name that tells apart what the command line shows otherwise than by default: the material,
//! the light, and whatever else is set.

use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Command};
use std::ffi::OsStr;
use std::path::Path;

/// Options that add nothing to default names: where and as what files are written, what the names say in another way (the
/// view and the pictures), how finely and by what means the same thing is drawn, for how long it moves, and what is written beside
/// it.
const LEFT_OUT: [&str; 30] = [
    "out",
    "format",
    "json",
    "timing",
    "probe",
    "side",
    "tilt",
    "eye_tilt",
    "azimuth",
    "perspective",
    "views",
    "scope",
    "size",
    "caption",
    "mark_audit",
    "wavelengths",
    "samples",
    "no_jitter",
    "tracer",
    "unresolved",
    "exact",
    "frames",
    "seconds",
    "paper",
    "compare",
    "exr",
    "bands",
    "places",
    "coding",
    "diffuse",
];

/// Options whose values name themselves if they are no numbers, so that the option's own name is left out.
const PLAIN: [&str; 4] = ["material", "stone", "light", "background"];

/// Returns what the options of a command that was parsed add to the default names of its files: `-ruby-office-turn-30`
/// for `--material ruby --light office --turn 30`. Empty where all options that a name tells apart have their default values.
pub fn told_apart(command: &Command, matches: &ArgMatches) -> String {
    let options = command.get_arguments().filter(|arg| !arg.is_positional() && !is_left_out(arg));
    options.filter_map(|arg| part(arg, matches)).collect()
}

fn is_left_out(arg: &Arg) -> bool {
    LEFT_OUT.contains(&arg.get_id().as_str())
}

/// Returns the part of one option; `None` where it is not given, or has its default value.
fn part(arg: &Arg, matches: &ArgMatches) -> Option<String> {
    let (id, long) = (arg.get_id().as_str(), arg.get_long()?);
    let is_known = matches.try_contains_id(id).is_ok_and(|contains| contains);
    if !is_known || matches.value_source(id) != Some(ValueSource::CommandLine) {
        return None;
    }
    if !arg.get_action().takes_values() {
        return Some(format!("-{long}"));
    }
    let given: Vec<&OsStr> = matches.get_raw(id)?.collect();
    if arg.get_default_values().iter().eq(given.iter()) {
        return None;
    }
    let values = given.iter().map(|value| format!("-{}", value_part(value)));
    let is_number = |value: &&OsStr| value.to_string_lossy().parse::<f64>().is_ok();
    let is_plain = PLAIN.contains(&id) && !given.iter().any(is_number);
    let name = if is_plain { String::new() } else { format!("-{long}") };
    Some(name + &values.collect::<String>())
}

/// Returns a value as part of a file's name: a number as it is, a file by its name without folder and ending, and of anything
/// else the letters and digits, with a dash for what stands between them.
fn value_part(value: &OsStr) -> String {
    let text = value.to_string_lossy();
    if text.parse::<f64>().is_ok() {
        return text.into_owned();
    }
    let path = Path::new(value);
    let name = path.file_stem().filter(|_| path.is_file()).unwrap_or(value).to_string_lossy();
    let is_between = |c: char| !(c.is_alphanumeric() || "._+".contains(c));
    name.split(is_between).filter(|part| !part.is_empty()).collect::<Vec<_>>().join("-")
}
