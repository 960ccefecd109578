//! Compares the sheets of real cutters' designs with the texts of their files, which a reader of the test's own takes apart.
//! The designs are not part of the project; where they are missing the test says so and passes.

use brillianteer::io::cutting_sheet::cutting_sheet;
use brillianteer::io::design_file;
use brillianteer::picture::{CuttingSheet, PaperSize, sheet_pages};
use brillianteer::scene::Specimen;
use std::path::Path;

const LIBRARY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/asc/library");

/// Designs of many kinds: two ovals, emerald, baguette, pear, marquise, heart, Portuguese, briolette, barion, and one with a
/// preform.
const DESIGNS: [&str; 11] = [
    "PC02003", "PC02093A", "PC04002", "PC12001", "PC05042", "PC03005", "PC01028A", "PC01386", "PC01601",
    "PC01697", "PC04039",
];

/// A tier as the text of a file gives it: angle, indices, name, instruction.
#[derive(Debug, Clone, PartialEq)]
struct TextTier {
    angle: f64,
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
    let (settings, said) = record.split_once(" G ").unwrap_or((record, ""));
    let mut words = settings.split_whitespace().skip(1);
    let angle = words.next().unwrap().parse().unwrap();
    let mut tier = TextTier {
        angle,
        indices: vec![],
        name: String::new(),
        instruction: said.split_whitespace().collect::<Vec<_>>().join(" "),
    };
    words.next();
    while let Some(word) = words.next() {
        if word == "n" {
            let name = words.next().unwrap_or_default();
            if tier.name.is_empty() {
                tier.name = name.to_owned();
            }
        } else if let Ok(index) = word.parse() {
            tier.indices.push(index);
        }
    }
    tier
}

/// Returns what a sheet must say of the tiers of a file, in words: name, angle, indices, instruction.
fn expected(gear: f64, tier: &TextTier) -> String {
    let flat = tier.angle == 0.0;
    let mut indices: Vec<f64> = if flat { vec![] } else { tier.indices.clone() };
    indices.sort_by(|a, b| (a % gear).total_cmp(&(b % gear)));
    let text = |index: &f64| if *index == 0.0 { gear } else { *index }.to_string();
    let indices: Vec<String> = indices.iter().map(text).collect();
    let said = if flat && tier.instruction.is_empty() { "Table" } else { &tier.instruction };
    format!("{} {:.2} {} {said}", tier.name, tier.angle.abs(), indices.join("-"))
}

fn lines(sheet: &CuttingSheet) -> Vec<String> {
    let rows = sheet.blocks.iter().flat_map(|block| &block.tiers);
    rows.map(|row| format!("{} {:.2} {} {}", row.name, row.angle_deg, row.indices_text(), row.instruction))
        .collect()
}

#[test]
fn sheets_of_real_designs_say_what_their_files_say() {
    if !Path::new(LIBRARY).is_dir() {
        return println!("SKIPPED: {LIBRARY} is not there, so no sheet is compared with a real file");
    }
    let mut compared = 0;
    for name in DESIGNS {
        let path = Path::new(LIBRARY).join(format!("{name}.ASC"));
        let bytes = std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        // These files have no letters beyond Latin-1.
        let text: String = bytes.iter().map(|&byte| char::from(byte)).collect();
        let (gear, tiers) = text_tiers(&text);
        let specimen = Specimen::new(design_file::read(&path).unwrap().design).unwrap();
        let sheet = cutting_sheet(&specimen, false).unwrap();
        let mut wanted: Vec<String> = tiers.iter().map(|tier| expected(gear, tier)).collect();
        let mut said = lines(&sheet);
        // The sheet puts the crown last, files have it where they please; within a block the order is the file's.
        let order = |is_up: bool| -> Vec<String> {
            let tiers =
                tiers.iter().filter(|tier| (tier.angle.is_sign_positive() && tier.angle < 90.0) == is_up);
            tiers.map(|tier| expected(gear, tier)).collect()
        };
        let in_blocks: Vec<String> = order(false).into_iter().chain(order(true)).collect();
        if sheet.blocks.len() == 2 {
            assert_eq!(said, in_blocks, "{name}");
        }
        wanted.sort();
        said.sort();
        assert_eq!(said, wanted, "{name}");
        assert!(!sheet_pages(&sheet, specimen.stone().unwrap(), PaperSize::A4).is_empty());
        compared += wanted.len();
        // A number that is off by a digit would be seen.
        let mut off = tiers[0].clone();
        off.angle += 0.01;
        assert!(!said.contains(&expected(gear, &off)), "{name}");
    }
    println!("{} designs, {compared} tiers agree", DESIGNS.len());
    assert!(compared > 100);
}
