//! Compares the sheets of real cutters' designs with the texts of their files, which a reader of the test's own takes apart.
//! The designs are not part of the project; where they are missing the test says so and passes.
#![cfg(feature = "interchange")]

use brillianteer::cut::{Cut, Tiers};
use brillianteer::io::{cutting_sheet::cutting_sheet, design_file};
use brillianteer::picture::{BlockKind, CuttingSheet, PaperSize, SheetRow, sheet_pages};
use brillianteer::scene::Specimen;
use std::collections::BTreeSet;
use std::path::Path;

const LIBRARY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/asc/library");

/// Designs of many kinds: two ovals, emerald, baguette, pear, marquise, heart, Portuguese, briolette, barion, and one with a
/// preform.
const DESIGNS: [&str; 11] = [
    "PC02003", "PC02093A", "PC04002", "PC12001", "PC05042", "PC03005", "PC01028A", "PC01386", "PC01601",
    "PC01697", "PC04039",
];

/// A tier as the text of a file gives it: angle, distance, indices, name, instruction.
#[derive(Debug, Clone, PartialEq)]
struct TextTier {
    angle: f64,
    distance: f64,
    indices: Vec<f64>,
    name: String,
    instruction: String,
}

/// Reads the gear and the facets of a GemCad text file, as they are written.
fn text_tiers(text: &str) -> (f64, Vec<TextTier>) {
    let mut records: Vec<String> = vec![];
    for line in text.lines() {
        match records.last_mut() {
            Some(record) if line.starts_with(' ') => record.push_str(line),
            _ => records.push(line.to_owned()),
        }
    }
    let gear = records.iter().find(|record| record.starts_with("g ")).unwrap();
    let gear: f64 = gear.split_whitespace().nth(1).unwrap().parse().unwrap();
    let facets = records.iter().filter(|record| record.starts_with("a "));
    (gear, facets.map(|record| text_tier(record)).collect())
}

fn text_tier(record: &str) -> TextTier {
    let mut words = record.split_whitespace().skip(1);
    let mut number = || words.next().unwrap().parse::<f64>().unwrap();
    let (angle, distance) = (number(), number());
    let mut tier =
        TextTier { angle, distance, indices: vec![], name: String::new(), instruction: String::new() };
    while let Some(word) = words.next() {
        match word {
            "n" => {
                let name = words.next().unwrap_or_default();
                if tier.name.is_empty() {
                    tier.name = name.to_owned();
                }
            }
            "G" => tier.instruction = words.by_ref().collect::<Vec<_>>().join(" "),
            index => tier.indices.extend(index.parse::<f64>().ok()),
        }
    }
    tier
}

/// Returns the row that a sheet must have for a tier of a file, in words: name, angle, indices, instruction. The
/// sheet chooses the name of a tier without one. A tier without an instruction gets a meet, or its depth in widths of
/// the stone.
fn expected(gear: f64, tier: &TextTier, row: &SheetRow, width: f64) -> String {
    let flat = tier.angle == 0.0;
    let mut indices: Vec<f64> = if flat { vec![] } else { tier.indices.clone() };
    indices.sort_by(|a, b| (a % gear).total_cmp(&(b % gear)));
    let text = |index: &f64| if *index == 0.0 { gear } else { *index }.to_string();
    let indices: Vec<String> = indices.iter().map(text).collect();
    let depth = format!("{:.4} W", tier.distance.abs() / width);
    let is_met = !row.instruction.contains("epth");
    let said = match (tier.instruction.as_str(), flat, tier.angle.is_sign_negative()) {
        ("", ..) if is_met => row.instruction.clone(),
        ("", true, false) => format!("Table, depth {depth}"),
        ("", true, true) => format!("Culet, depth {depth}"),
        ("", ..) => format!("Depth {depth}"),
        (said, ..) => said.to_owned(),
    };
    let name = if tier.name.is_empty() { &row.name } else { &tier.name };
    format!("{name} {:.2} {} {said}", tier.angle.abs(), indices.join("-"))
}

fn line(row: &SheetRow) -> String {
    format!("{} {:.2} {} {}", row.name, row.angle_deg, row.indices_text(), row.instruction)
}

#[test]
fn sheets_of_real_designs_say_what_their_files_say() {
    if !Path::new(LIBRARY).is_dir() {
        return println!("SKIPPED: {LIBRARY} is not there, so no sheet is compared with a real file");
    }
    let (mut compared, mut met) = (0, 0);
    for name in DESIGNS {
        let path = Path::new(LIBRARY).join(format!("{name}.ASC"));
        let bytes = std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        // These files have no letters beyond Latin-1.
        let text: String = bytes.iter().map(|&byte| char::from(byte)).collect();
        let (gear, tiers) = text_tiers(&text);
        let gear = gear.abs();
        let specimen = Specimen::new(design_file::read(&path).unwrap().design).unwrap();
        let sheet = cutting_sheet(&specimen, false).unwrap();
        // The width of the stone in the unit of the file's distances.
        let Cut::Tiers(own) = &specimen.design.cut else { panic!("{name} has no tiers") };
        let unit = own.tiers[0].distance / tiers[0].distance.abs();
        let (low, high) = specimen.stone().unwrap().polytope.bounds();
        let width = (high - low).truncate().min_element() / specimen.frame.scale / unit;
        let mut seen = BTreeSet::new();
        for block in &sheet.blocks {
            assert!(block.tiers.is_sorted_by_key(|row| row.tier), "{name}: not in cutting order");
            for row in &block.tiers {
                let tier = &tiers[row.tier];
                assert_eq!(line(row), expected(gear, tier, row, width), "{name}");
                let is_crown = tier.angle.is_sign_positive() && tier.angle < 90.0;
                assert_eq!(block.name == BlockKind::Crown, is_crown, "{name}: {tier:?}");
                assert!(seen.insert(row.tier), "{name}: {tier:?} stands on the sheet twice");
                // A number that is off by a digit would be seen.
                let off = TextTier { angle: tier.angle + 0.01, ..tier.clone() };
                assert_ne!(line(row), expected(gear, &off, row, width));
            }
        }
        met += meets_of_rows_hold(own, &sheet, &tiers, name);
        assert_eq!(seen.len(), tiers.len(), "{name}: tiers are missing");
        assert!(!sheet_pages(&sheet, PaperSize::A4).is_empty());
        compared += tiers.len();
    }
    println!("{} designs, {compared} tiers agree, {met} of them by a meet that was found", DESIGNS.len());
    assert!(compared > 100 && met > 10);
}

/// Checks that each meet on a sheet, for a tier whose file has no instruction, gives the tier the distance that it has. Returns
/// the number of such meets.
fn meets_of_rows_hold(own: &Tiers, sheet: &CuttingSheet, tiers: &[TextTier], name: &str) -> usize {
    let mut read = own.clone().with_names();
    let rows = sheet.blocks.iter().flat_map(|block| &block.tiers);
    let found: Vec<&SheetRow> = rows.filter(|row| tiers[row.tier].instruction.is_empty()).collect();
    for row in &found {
        read.tiers[row.tier].meet = read.meet_in_words(row.tier, &row.instruction);
    }
    let checked = read.checked_meets();
    let met = found.iter().filter(|row| read.tiers[row.tier].meet.is_some());
    let holds = |row: &&&SheetRow| {
        let [before, after] = [own, &checked.tiers].map(|tiers| tiers.tiers[row.tier].distance.abs());
        assert!((before - after).abs() < 1e-4 * before.max(1.0), "{name}: {row:?}: {before} {after}");
        true
    };
    met.filter(holds).count()
}

/// A design of the library with a ratio that its file prints, and the unit of the last digit printed.
const PRINTED: [(&str, &str, f64, f64); 11] = [
    ("PC01521", "L/W", 1.0, 0.001),
    ("PC02036A", "L/W", 1.5, 0.1),
    ("PC02159", "L/W", 2.0, 0.001),
    ("PC02260", "L/W", 1.2, 0.1),
    ("PC04131", "L/W", 1.2, 0.01),
    ("PC04132", "L/W", 1.25, 0.01),
    ("PC05085", "L/W", 1.594, 0.001),
    ("PC12001", "L/W", 2.0, 0.1),
    ("PC41029", "L/W", 1.0, 0.01),
    ("PC41058", "L/W", 1.818, 0.001),
    ("PC42044", "H/W", 1.039, 0.001),
];

fn sheet_of(name: &str) -> (String, CuttingSheet) {
    let path = Path::new(LIBRARY).join(format!("{name}.ASC"));
    let bytes = std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let specimen = Specimen::new(design_file::read(&path).unwrap().design).unwrap();
    (bytes.iter().map(|&byte| char::from(byte)).collect(), cutting_sheet(&specimen, false).unwrap())
}

fn ratio(sheet: &CuttingSheet, symbol: &str) -> f64 {
    sheet.figures.ratios().into_iter().find(|(own, _)| *own == symbol).unwrap().1
}

#[test]
fn ratios_of_real_sheets_are_those_that_their_files_print() {
    if !Path::new(LIBRARY).is_dir() {
        return println!("SKIPPED: {LIBRARY} is not there, so no ratio is compared with a printed one");
    }
    for (name, symbol, printed, digit) in PRINTED {
        let (text, sheet) = sheet_of(name);
        let decimals = (-digit.log10()).round() as usize;
        let figure = format!("{printed:.decimals$}");
        assert!(text.contains(symbol) && text.contains(&figure), "{name} does not print {symbol} {figure}");
        let found = ratio(&sheet, symbol);
        assert!((found - printed).abs() <= 0.5 * digit + 1e-9, "{name}: {symbol} {found} for {printed}");
    }
}
