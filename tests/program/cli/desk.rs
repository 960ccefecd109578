//! A folder in which tests run the program, and readers of the program's output.

use brillianteer::optics::linear_from_encoded;
use exr::prelude::{AnyChannel, FlatSamples, read_first_flat_layer_from_file};
use glam::DVec3;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A temporary folder with the fixtures, in which commands are run.
pub struct Desk(tempfile::TempDir);

impl Desk {
    pub fn new() -> Self {
        let desk = Self(tempfile::tempdir().unwrap());
        let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures");
        for (folder, least) in [("", 2), ("bad", 10)] {
            std::fs::create_dir_all(desk.at(folder)).unwrap();
            let found = files(&fixtures.join(folder));
            assert!(found.len() >= least, "fixtures are missing");
            found.iter().for_each(|(name, text)| desk.write(&format!("{folder}/{name}"), text));
        }
        desk
    }

    pub fn at(&self, path: impl AsRef<Path>) -> PathBuf {
        self.0.path().join(path)
    }

    pub fn write(&self, path: &str, text: impl AsRef<[u8]>) {
        std::fs::write(self.at(path.trim_start_matches('/')), text).unwrap();
    }

    pub fn read(&self, path: &str) -> String {
        std::fs::read_to_string(self.at(path)).unwrap()
    }

    pub fn command(&self, line: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_brillianteer"));
        command.current_dir(self.at("")).args(line.split_whitespace()).stdin(Stdio::null());
        // The variable is missing under cron and in containers too. Drivers used to complain about that on the program's
        // standard error.
        command.env_remove("XDG_RUNTIME_DIR");
        command
    }

    /// Runs a command and returns its exit code, its standard output and its standard error.
    pub fn run(&self, line: &str) -> (i32, String, String) {
        outcome(line, &self.command(line).output().unwrap())
    }

    /// Runs a command that must succeed and returns its standard output. Standard error may hold only notes on illustrative
    /// colours and on sizes that files do not state, the names of files that are written beside JSON, and that a graphics card which
    /// was asked for is software.
    pub fn done(&self, line: &str) -> String {
        let (code, printed, stderr) = self.run(line);
        let is_software = |l: &str| {
            line.contains("--tracer gpu") && l.contains("is no graphics card: it computes in software")
        };
        let is_usual = |l: &str| {
            l.starts_with("note: the colour of ")
                || l.contains(": the file states no size; ")
                || (line.contains("--json") && l.starts_with("wrote "))
        };
        let is_quiet = stderr.lines().all(|l| is_usual(l) || is_software(l));
        assert!(code == 0 && is_quiet, "{line}: code {code}: {stderr}");
        printed
    }

    pub fn json(&self, line: &str) -> Value {
        serde_json::from_str(&self.done(line)).unwrap()
    }

    /// Runs a command that must fail with this exit code and returns its standard error.
    pub fn refused(&self, line: &str, expected: i32) -> String {
        let (code, _, stderr) = self.run(line);
        assert_eq!(code, expected, "{line}: {stderr}");
        stderr
    }
}

/// Returns the exit code, standard output and standard error of a command, which must not have panicked. Lines of progress,
/// which depend on how busy the machine is, are left out, and so are notes of folders that were made, which have a test of their
/// own.
pub fn outcome(line: &str, output: &Output) -> (i32, String, String) {
    let [printed, stderr] = [&output.stdout, &output.stderr].map(|b| String::from_utf8(b.clone()).unwrap());
    let is_kept =
        |line: &&str| !line.contains(" % done") && !line.ends_with(" was missing and has been made\n");
    let stderr: String = stderr.split_inclusive('\n').filter(is_kept).collect();
    let code = output.status.code().unwrap();
    assert!(code != 101 && !stderr.contains("panicked"), "{line}: a panic: {stderr}");
    (code, printed, stderr)
}

/// Returns the contents of the files of a folder, by name.
pub fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let paths = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).filter(|p| p.is_file());
    paths.map(|p| (p.file_name().unwrap().to_str().unwrap().into(), std::fs::read(&p).unwrap())).collect()
}

/// Returns the number at a path such as surface/green.
pub fn at(value: &Value, path: &str) -> f64 {
    value.pointer(&format!("/{path}")).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path} in {value}"))
}

pub fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap()
}

pub fn sum(zones: &Value) -> f64 {
    zones.as_object().unwrap().values().filter_map(Value::as_f64).sum()
}

pub fn energy(figures: &Value) -> f64 {
    sum(&figures["surface"])
        + sum(&figures["transmitted"])
        + at(figures, "absorbed")
        + at(figures, "unresolved")
}

pub fn point(value: &Value) -> DVec3 {
    DVec3::from_slice(&list(value).iter().filter_map(Value::as_f64).collect::<Vec<_>>())
}

/// The corners of a facet of `info --json`.
pub fn corners(info: &Value, facet: &Value) -> Vec<DVec3> {
    list(&facet["corners"]).iter().map(|c| point(&info["vertices"][c.as_u64().unwrap() as usize])).collect()
}

pub fn near(found: f64, expected: f64, within: f64, what: &str) {
    assert!((found - expected).abs() <= within, "{what}: {found}, not {expected}");
}

/// Splits a text such as "crown_angle 34.5, culet 0" into names and numbers.
pub fn pairs(text: &str) -> impl Iterator<Item = (&str, f64)> {
    text.split(", ").map(|pair| pair.split_once(' ').unwrap()).map(|(k, v)| (k, v.parse().unwrap()))
}

/// A PNG's size, its pixels in linear light, and its description.
pub fn png(path: &Path) -> ((u32, u32), Vec<DVec3>, String) {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let size = reader.next_frame(&mut bytes).map(|f| (f.width, f.height)).unwrap();
    let linear =
        |p: &[u8]| DVec3::from_array([0, 1, 2].map(|i| linear_from_encoded(f64::from(p[i]) / 255.0)));
    let described = reader.info().utf8_text.iter().find(|t| t.keyword == "Description").unwrap();
    (size, bytes.chunks_exact(3).map(linear).collect(), described.get_text().unwrap())
}

pub fn exr(path: &Path) -> BTreeMap<String, Vec<f64>> {
    let layer = read_first_flat_layer_from_file(path).unwrap().layer_data;
    let channel = |c: AnyChannel<FlatSamples>| {
        (c.name.to_string(), c.sample_data.values_as_f32().map(f64::from).collect())
    };
    layer.channel_data.list.into_iter().map(channel).collect()
}
