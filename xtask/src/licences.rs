//! The crates that the program is built of on any platform and with any feature, and the texts of their licences.

use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// The list that the editor shows, from the root of the repository; `tests/library/licences.rs` holds it current.
const LIST: &str = "assets/crates.tsv";

/// The program's package, and the beginning of the names of its own crates.
const OWN: &str = "brillianteer";

/// Crates that state their licence only by a file with its text, which a person has read.
const BY_FILE: [(&str, &str); 2] = [("cobyla", "MIT"), ("slsqp", "MIT")];

/// The beginnings of the names of files with texts of licences, and of folders of them, in small letters.
const TEXTS: [&str; 7] = ["licen", "copying", "copyright", "notice", "unlicense", "ofl", "ufl"];

/// A folder within a crate that may hold such files.
const FONTS: &str = "fonts";

/// A crate that others made.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Crate {
    name: String,
    version: String,
    /// The licence as SPDX writes it.
    licence: String,
    /// The address of the repository or of the home page; empty where the crate states none.
    link: String,
    folder: PathBuf,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Writes the list: a line for each crate, with name, version, licence and link between tabs.
///
/// # Errors
/// Fails where cargo does, or where the list cannot be written.
pub fn write_list() -> Result<(), Box<dyn Error>> {
    let mut list = String::new();
    for Crate { name, version, licence, link, .. } in crates()? {
        writeln!(list, "{name}\t{version}\t{licence}\t{link}")?;
    }
    Ok(std::fs::write(root().join(LIST), list)?)
}

/// Prints all crates, then each text of a licence once, below the names of the crates that come with it.
///
/// # Errors
/// Fails where cargo does, or where a text cannot be read.
pub fn print_texts() -> Result<(), Box<dyn Error>> {
    let mut page = String::new();
    let mut texts: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for own in crates()? {
        let Crate { name, version, licence, link, folder } = &own;
        writeln!(page, "{name} {version}: {licence} {link}")?;
        let files = texts_in(folder)?;
        if files.is_empty() {
            writeln!(page, "    its source has no file with the text of a licence")?;
        }
        for file in files {
            let text = String::from_utf8_lossy(&std::fs::read(&file)?).replace("\r\n", "\n");
            texts.entry(text.trim().to_owned()).or_default().push(format!("{name} {version}"));
        }
    }
    for (text, names) in texts {
        write!(page, "\n{}\n{}\n\n{text}\n", "=".repeat(80), names.join(", "))?;
    }
    Ok(std::io::stdout().write_all(page.as_bytes())?)
}

/// Returns the files with texts of licences in the folder of a crate.
fn texts_in(folder: &Path) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let is_text = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
        TEXTS.iter().any(|begin| name.starts_with(begin))
    };
    let (folders, mut found): (Vec<_>, Vec<_>) =
        inside(folder)?.into_iter().filter(is_text).partition(|path| path.is_dir());
    for folder in folders {
        found.extend(inside(&folder)?.into_iter().filter(|path| path.is_file()));
    }
    let fonts = folder.join(FONTS);
    if fonts.is_dir() {
        found.extend(inside(&fonts)?.into_iter().filter(is_text));
    }
    found.sort();
    Ok(found)
}

/// Returns the paths in a folder.
fn inside(folder: &Path) -> Result<Vec<PathBuf>, std::io::Error> {
    std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect()
}

/// Returns what cargo knows of all packages.
fn metadata() -> Result<Value, Box<dyn Error>> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let answer = std::process::Command::new(cargo)
        .args(["metadata", "--all-features", "--locked", "--format-version", "1"])
        .current_dir(root())
        .output()?;
    match answer.status.success() {
        true => Ok(serde_json::from_slice(&answer.stdout)?),
        false => Err(String::from_utf8_lossy(&answer.stderr).into()),
    }
}

/// Returns the crates that the program needs, without its own and without those of tests.
fn crates() -> Result<BTreeSet<Crate>, Box<dyn Error>> {
    let metadata = metadata()?;
    let items = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let packages: BTreeMap<String, Value> =
        items(&metadata["packages"]).into_iter().map(|package| (text(&package["id"]), package)).collect();
    let needs: BTreeMap<String, Value> = items(&metadata["resolve"]["nodes"])
        .into_iter()
        .map(|mut node| (text(&node["id"]), node["deps"].take()))
        .collect();
    let mut open: Vec<&String> =
        packages.iter().filter(|(_, package)| package["name"] == OWN).map(|(id, _)| id).collect();
    let mut found: BTreeSet<&String> = BTreeSet::new();
    while let Some(id) = open.pop() {
        if !found.insert(id) {
            continue;
        }
        for need in needs.get(id).into_iter().flat_map(items) {
            let is_for_tests = items(&need["dep_kinds"]).iter().all(|kind| kind["kind"] == "dev");
            let known = packages.get_key_value(&text(&need["pkg"])).filter(|_| !is_for_tests);
            open.extend(known.map(|(id, _)| id));
        }
    }
    let found = found.into_iter().filter_map(|id| packages.get(id));
    Ok(found.map(described).filter(|own| !own.name.starts_with(OWN)).collect())
}

/// Returns what a package of cargo says of itself.
fn described(package: &Value) -> Crate {
    let text = |key: &str| package[key].as_str().unwrap_or_default().to_owned();
    let name = text("name");
    let by_file = BY_FILE.iter().find(|(known, _)| *known == name).map(|(_, licence)| (*licence).to_owned());
    let stated = Some(text("license")).filter(|licence| !licence.is_empty());
    let licence = stated.or(by_file).unwrap_or_default();
    let link = ["repository", "homepage"].map(text).into_iter().find(|link| !link.is_empty());
    let folder = Path::new(&text("manifest_path")).parent().map(Path::to_path_buf);
    Crate {
        name,
        version: text("version"),
        // Older crates write a slash for a choice.
        licence: licence.replace('/', " OR ").split_whitespace().collect::<Vec<_>>().join(" "),
        link: link.unwrap_or_default(),
        folder: folder.unwrap_or_default(),
    }
}
