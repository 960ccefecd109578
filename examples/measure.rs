//! Measures a design: `cargo run --release --example measure [FILE]`, a cut file or by default Tolkowsky's brilliant.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use brillianteer::io::cut_file;
use brillianteer::render::MeasureOptions;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args().nth(1).unwrap_or_else(|| "cuts/tolkowsky.toml".into());
    let design = cut_file::read(&file)?;
    let measured = brillianteer::measure(&design, &MeasureOptions::default())?;
    println!("{}: light return {:.2} %", design.name, 100.0 * measured.light_return());
    for band in measured.scope.bands.iter().skip(1) {
        let zone = measured.zone(&band.name).ok_or("no such zone")?;
        println!("  {:<8}{:>6.2} % of the light", band.name, 100.0 * zone.transmitted);
    }
    println!("  leakage {:>6.2} %, glare {:.2} %", 100.0 * measured.leakage(), 100.0 * measured.glare());
    println!("  each too low by {:.3} % at most", 100.0 * measured.error());
    Ok(())
}
