//! Writes the ASET picture of a design: `cargo run --release --example aset_png [FILE [PNG]]`.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use brillianteer::base::unwatched;
use brillianteer::io::{WriteError, cut_file, write_png};
use brillianteer::optics::line;
use brillianteer::picture::{Layer, Palette, paint};
use brillianteer::scene::{ASET_CONE, Backing, Film, Glare, Scope, Specimen, View};
use brillianteer::trace::beam;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut given = std::env::args().skip(1);
    let file = given.next().unwrap_or_else(|| "cuts/modern-ideal.toml".into());
    let to = given.next().map_or_else(|| std::env::temp_dir().join("aset.png"), PathBuf::from);

    let stone = Specimen::new(cut_file::read(&file)?)?;
    let (view, scope) = (View::default(), Scope::aset(ASET_CONE, Backing::Black));
    let options = beam::BeamOptions { unresolved: 1e-3, ..beam::BeamOptions::default() };
    let beams =
        beam::trace(&stone.stone()?.polytope, stone.medium(line::SODIUM_D), &view, &options, &unwatched)?;

    let film = Film::around(stone.solid(), &view.basis(), 512);
    let (layer, palette) = (Layer::energy(&beams, &scope, Glare::LeftOut), Palette::of(&scope));
    write_png(&to, film.size.into(), &stone.design.name, |png| {
        paint(&layer, &film, &unwatched, |rows| -> Result<(), WriteError> {
            let mut pixels = vec![];
            (rows.first..rows.first + rows.count).for_each(|y| palette.encode(rows, 0, y, &mut pixels));
            png.push(&pixels)
        })
    })?;
    println!("{}", to.display());
    Ok(())
}
