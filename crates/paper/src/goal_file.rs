//! Reads and writes goal files: TOML with the measures of a search, the numbers of the design that may change, and
//! the limits.

use brillianteer_base::{Failure, Fault, FileError};
use brillianteer_files::toml_text::TomlText;
use brillianteer_files::{WriteError, text, write as write_whole};
use brillianteer_search::Goal;
use std::path::Path;

/// The size of the largest file that is read, in bytes.
const MAX_BYTES: u64 = 1 << 20;

/// Reads a goal file.
///
/// # Errors
/// Fails where the file cannot be read or is no goal; the error names path and, where possible, the line.
pub fn read(path: &Path) -> Result<Goal, FileError> {
    let goal = text::read(path, MAX_BYTES).and_then(|text| goal(&text));
    goal.map_err(|fault| fault.in_file(path.display()))
}

/// Writes a goal to a file that [`read`] reads as the same goal.
///
/// # Errors
/// Fails where the file cannot be written.
pub fn write(goal: &Goal, path: &Path) -> Result<(), Failure> {
    // The goal's own check refuses infinite numbers, which TOML could hold.
    let text = toml::to_string(goal).map_err(|error| Failure::Output(error.to_string()))?;
    write_whole(path, |file| file.write_all(text.as_bytes()).map_err(|e| WriteError::io(path, e)))?;
    Ok(())
}

fn goal(text: &str) -> Result<Goal, Fault> {
    TomlText::parse(text)?.read(|goal: Goal| {
        goal.check().map_err(|fault| Fault::key(fault.key, fault.problem))?;
        Ok(goal)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_search::GoalMaterial;

    const GOAL: &str = "name = \"bright\"\n[[measure]]\nof = \"return-cos2\"\nmaterial = [\"quartz\", 1.62]\ntilt = 10\n\
        may_lose = 0.01\n[[measure]]\nof = \"windowing\"\nweight = -2\nat_most = 0.1\n[vary]\ncrown_angle = [28, 40]\n\
        \"tier:P 1\" = [40, 43]\n[limit]\ngirdle_to_width = { at_least = 0.02 }\n";

    #[test]
    fn a_goal_is_read_with_all_that_it_says() {
        let goal = goal(GOAL).unwrap();
        assert_eq!(goal.measure.len(), 2);
        assert_eq!(goal.measure[0].weight, 1.0);
        let materials = [GoalMaterial::Name("quartz".into()), GoalMaterial::Index(1.62)];
        assert_eq!(goal.measure[0].material.as_ref().unwrap().all(), materials);
        assert_eq!(goal.measure[0].tilt.as_ref().unwrap().all(), [10.0]);
        assert_eq!(goal.vary["tier:P 1"], [40.0, 43.0]);
        assert_eq!(goal.limit["girdle_to_width"].ends(), (0.02, f64::INFINITY));
    }

    #[test]
    fn a_goal_that_is_written_reads_back_equal() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("goal.toml");
        let goal = goal(GOAL).unwrap();
        write(&goal, &path).unwrap();
        assert_eq!(read(&path).unwrap(), goal);
        assert!(write(&goal, folder.path()).is_err(), "a folder is no file");
    }

    #[test]
    fn what_is_wrong_in_a_goal_is_told_with_its_line() {
        for (from, to, line, words) in [
            ("return-cos2", "brightness", 3, "'brightness' is no measure"),
            ("\"quartz\"", "\"quartzite\"", 4, "quartzite"),
            ("1.62", "0.5", 4, "index"),
            ("tilt = 10", "tilt = 100", 5, "tilt: give -90 to 90 degrees"),
            ("[\"quartz\", 1.62]", "[]", 3, "is empty"),
            ("may_lose = 0.01", "may_lose = -1", 6, "may_lose: give 0 or more"),
            ("weight = -2", "weight = 1e9", 9, "weight: give a number"),
            ("[28, 40]", "[40, 28]", 12, "crown_angle: give the least and then the greatest"),
            ("at_least = 0.02", "", 15, "girdle_to_width: give at_least"),
            ("at_most", "at_mots", 10, "at_mots"),
        ] {
            assert!(GOAL.contains(from), "{from}");
            let fault = goal(&GOAL.replace(from, to)).unwrap_err();
            assert!(fault.line == Some(line) && fault.problem.contains(words), "{to}: {fault:?}");
        }
        let nothing = goal("measure = []").unwrap_err();
        assert!(nothing.problem.contains("at least one [[measure]]"), "{nothing:?}");
    }
}
