//! Sweeps the pavilion angle of a brilliant: `cargo run --release --example sweep`.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use brillianteer::cut::{Cut, Pavilion};
use brillianteer::io::{cut_file, library};
use brillianteer::measure::Bounds;
use brillianteer::render::MeasureOptions;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = library::cut("modern-ideal").ok_or("no such cut")?;
    let mut design = cut_file::parse(text, "modern-ideal")?;
    let bounds = Bounds { standard_error: Some(1e-3), ..Bounds::default() };
    let options = MeasureOptions { bounds, ..MeasureOptions::default() };
    println!("pavilion   light return   leakage");
    for step in 0..=8 {
        let angle = 40.0 + 0.25 * f64::from(step);
        if let Cut::RoundBrilliant(brilliant) = &mut design.cut {
            brilliant.pavilion = Pavilion::Angle(angle);
        }
        let measured = brillianteer::measure(&design, &options)?;
        let [light, leakage] = [measured.light_return(), measured.leakage()].map(|part| 100.0 * part);
        println!("{angle:>7.2}°{light:>13.2} %{leakage:>8.2} %");
    }
    Ok(())
}
