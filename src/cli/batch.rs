//! Runs a command on several files, one after the other.

use super::console::{STANDARD_OUTPUT, print_json, print_json_line, say};
use super::specimen::stem;
use brillianteer_base::Failure;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Returns an error if two input files would give their outputs the same names.
pub fn distinct(files: &[PathBuf]) -> Result<(), Failure> {
    for (k, file) in files.iter().enumerate() {
        let name = stem(file);
        if let Some(other) = files[..k].iter().find(|other| stem(other) == name) {
            let (a, b) = (other.display(), file.display());
            let message = format!(
                "{a} and {b}: both would be written as '{name}-...'; write to different --out folders"
            );
            return Err(Failure::Usage(message));
        }
    }
    Ok(())
}

/// Calls `work` for each file. Of several files, one that fails is reported and skipped: its error goes to standard error,
/// and with `is_json` an object with the keys `file` and `error` to standard output, in its turn.
///
/// # Errors
/// Of several files, fails in the end with the kind of the first failure and the number and names of the files that failed.
/// Fails at once where the work was stopped, where standard output cannot be written, or where two files in a row fail for
/// the same words, which are then about the options.
pub fn each_file(
    files: &[PathBuf],
    is_json: bool,
    mut work: impl FnMut(&Path) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let mut failed: Vec<(&PathBuf, Failure)> = Vec::new();
    let mut last: Option<Failure> = None;
    for file in files {
        let Err(failure) = work(file) else {
            last = None;
            continue;
        };
        if files.len() == 1 || last.as_ref() == Some(&failure) || ends_all(&failure) {
            return Err(failure);
        }
        last = Some(failure.clone());
        report_failure(file, &failure, is_json)?;
        failed.push((file, failure));
    }
    of_several(&failed, files.len())
}

/// Reports the failure of one file of several.
pub fn report_failure(file: &Path, failure: &Failure, is_json: bool) -> Result<(), Failure> {
    let (name, message) = (file.display().to_string(), failure.to_string());
    let named = if message.starts_with(&name) { message.clone() } else { format!("{name}: {message}") };
    say(&format!("error: {named}"));
    if is_json { print_json_line(&FailedFile { file: name, error: message }) } else { Ok(()) }
}

/// The object in the place of the result of a file that failed.
#[derive(Serialize)]
struct FailedFile {
    file: String,
    error: String,
}

/// Prints the result of one of these files as JSON: indented where it is the only one, else on a line of its own.
pub fn print_json_of(files: &[PathBuf], result: &impl Serialize) -> Result<(), Failure> {
    if files.len() > 1 { print_json_line(result) } else { print_json(result) }
}

/// Returns whether no further file can be worked on after a failure.
pub fn ends_all(failure: &Failure) -> bool {
    match failure {
        Failure::Input(_) | Failure::Usage(_) => false,
        Failure::Output(message) => message.starts_with(STANDARD_OUTPUT),
        Failure::NoWindow(_) | Failure::Stopped => true,
    }
}

/// Returns the failure of all of these files together, of the kind of the first; `Ok` where there is none.
pub fn of_several(failed: &[(&PathBuf, Failure)], of: usize) -> Result<(), Failure> {
    let Some((_, first)) = failed.first() else { return Ok(()) };
    let names: Vec<String> = failed.iter().map(|(file, _)| file.display().to_string()).collect();
    let text = format!("{} of {of} files failed: {}", failed.len(), names.join(", "));
    Err(match first {
        Failure::Usage(_) => Failure::Usage(text),
        Failure::Output(_) => Failure::Output(text),
        _ => Failure::Input(text),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(failures: &[Option<Failure>]) -> (usize, Result<(), Failure>) {
        let files: Vec<PathBuf> = (0..failures.len()).map(|k| format!("{k}.asc").into()).collect();
        let (mut left, mut tried) = (failures.iter(), 0);
        let done = each_file(&files, false, |_| {
            tried += 1;
            left.next().cloned().flatten().map_or(Ok(()), Err)
        });
        (tried, done)
    }

    #[test]
    fn a_file_that_fails_in_any_way_of_its_own_does_not_end_the_others() {
        let failures = [
            Some(Failure::Usage("no beams".into())),
            None,
            Some(Failure::Input("no stone".into())),
            Some(Failure::Output("no room".into())),
            None,
        ];
        let (tried, done) = run(&failures);
        assert_eq!(tried, 5);
        assert_eq!(done, Err(Failure::Usage("3 of 5 files failed: 0.asc, 2.asc, 3.asc".into())));
    }

    #[test]
    fn what_holds_for_all_files_ends_the_work() {
        for (first, tried) in [
            (Failure::Stopped, 1),
            (Failure::Output("standard output: full".into()), 1),
            (Failure::Usage("the same for each".into()), 2),
        ] {
            let failures = [Some(first.clone()), Some(first.clone()), None];
            assert_eq!(run(&failures), (tried, Err(first)));
        }
        // The same words after a file that is done are about that file.
        let same = Failure::Usage("the same for two".into());
        let (tried, done) = run(&[Some(same.clone()), None, Some(same), None]);
        assert_eq!((tried, done), (4, Err(Failure::Usage("2 of 4 files failed: 0.asc, 2.asc".into()))));
        // One file alone fails in its own words.
        let alone = Failure::Input("no stone".into());
        assert_eq!(run(&[Some(alone.clone())]), (1, Err(alone)));
    }
}
