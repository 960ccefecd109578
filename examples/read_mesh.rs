//! Reads a mesh (glTF, OBJ, STL or PLY), finds its facets and reports what they measure:
//! `cargo run --release --example read_mesh [FILE]`. Without a file it writes a mesh of its own and reads that.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use brillianteer::cut::ProportionReport;
use brillianteer::io::{cut_file, design_file};
use brillianteer::measure::Bounds;
use brillianteer::render::MeasureOptions;
use brillianteer::scene::Specimen;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let file = match std::env::args().nth(1) {
        Some(file) => PathBuf::from(file),
        None => {
            let stone = Specimen::new(cut_file::read("cuts/tolkowsky.toml")?)?;
            let file = folder.path().join("tolkowsky.obj");
            design_file::write(&stone, design_file::DesignFormat::Obj, &file)?;
            file
        }
    };
    let read = design_file::read(&file)?;
    read.notes.iter().chain(&read.warnings).for_each(|said| println!("{said}"));
    let specimen = Specimen::new(read.design.clone())?;
    let carats = specimen.carats().map_or("of unknown weight".into(), |carats| format!("{carats:.3} ct"));
    println!("{}: {}, {carats}", read.design.name, specimen.material.name);
    if let Ok(stone) = specimen.stone() {
        let report = ProportionReport::of(&stone.polytope, stone.names());
        println!("table {:.2} %, depth {:.2} %", report.table[0], report.total_depth);
        for tier in &report.tiers {
            println!("  {:<12}{:>4} facets of {:.3}°", tier.name, tier.facets, tier.slope_deg.mean);
        }
    }
    let bounds = Bounds { standard_error: Some(1e-3), ..Bounds::default() };
    let measured =
        brillianteer::measure(&read.design, &MeasureOptions { bounds, ..MeasureOptions::default() })?;
    println!("light return {:.2} %, traced by {}", 100.0 * measured.light_return(), measured.tracer);
    Ok(())
}
