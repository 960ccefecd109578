//! The stone that a command works on, read and built.

use super::{Failure, say};
use crate::cut::Design;
use crate::io::cut_file::{self, CutFileError};
use crate::optics::Material;
use crate::scene::Stone;
use std::path::Path;

/// A cut file, and the stone that it describes.
#[derive(Debug)]
pub struct Specimen {
    /// As given on the command line.
    pub path: String,
    /// What the file says.
    pub design: Design,
    /// Its solid.
    pub stone: Stone,
    /// What it is made of.
    pub material: Material,
}

impl Specimen {
    /// Reads a cut file, or takes a cut that comes with the program by its name; builds the stone, and warns of what
    /// is odd.
    pub fn load(file: &Path) -> Result<Self, Failure> {
        let name = file.display().to_string();
        match super::lists::built_in(&name).filter(|_| !file.is_file()) {
            Some(text) => Self::parse(&name, text),
            None => Self::read(file),
        }
    }

    /// Reads a cut file.
    pub fn read(file: &Path) -> Result<Self, Failure> {
        let told = |e: CutFileError| Failure::Input(format!("{e}{}", super::lists::hint(file)));
        Self::of(file.display().to_string(), cut_file::read(file).map_err(told)?)
    }

    /// Takes the text of a cut file, which errors call by this path.
    pub fn parse(path: &str, text: &str) -> Result<Self, Failure> {
        let design = cut_file::parse(text, path).map_err(|e| Failure::Input(e.to_string()))?;
        Self::of(path.to_owned(), design)
    }

    fn of(path: String, design: Design) -> Result<Self, Failure> {
        let input = |e: &dyn std::fmt::Display| Failure::Input(format!("{path}: {e}"));
        let facets = design.facets().map_err(|e| input(&e))?;
        let stone = Stone::new(&facets).map_err(|e| input(&e.told(|i| format!("'{}'", facets[i].0))))?;
        let material = design.material.material().map_err(|e| input(&e))?;
        let specimen = Self { path, design, stone, material };
        specimen.warn(&facets)?;
        Ok(specimen)
    }

    /// Its weight in carats; `None` where its material's density is not known.
    pub fn carats(&self) -> Option<f64> {
        let unit_mm = 0.5 * self.design.diameter_mm;
        self.material.carats(self.stone.polytope.volume() * unit_mm.powi(3))
    }

    /// Says that something about it is odd.
    pub fn say(&self, what: &str) {
        say(&format!("warning: {}: {what}", self.path));
    }

    fn warn(&self, facets: &[(String, crate::math::Plane)]) -> Result<(), Failure> {
        let odd = self.design.warnings().map_err(|e| Failure::Input(format!("{}: {e}", self.path)))?;
        odd.iter().for_each(|w| self.say(&w.to_string()));
        let polytope = &self.stone.polytope;
        for &(dropped, kept) in polytope.merged() {
            let (dropped, kept) = (&facets[dropped].0, &facets[kept].0);
            self.say(&format!("facet '{dropped}' lies in the plane of '{kept}' and is one with it"));
        }
        if polytope.planes().any(|p| p.offset < 0.0) {
            self.say(
                "the origin lies outside the stone; pictures are centred there, so move the stone to it",
            );
        }
        let names: Vec<&str> = polytope.redundant().iter().map(|&i| facets[i].0.as_str()).collect();
        if !names.is_empty() {
            self.say(&format!("these facets do not reach the stone: {}", listed(&names)));
        }
        Ok(())
    }
}

/// Names in a row, no more than a line of them.
fn listed(names: &[&str]) -> String {
    const MOST: usize = 8;
    let shown = names.iter().take(MOST).map(|n| format!("'{n}'")).collect::<Vec<_>>().join(", ");
    if names.len() > MOST { format!("{shown} and {} more", names.len() - MOST) } else { shown }
}

/// A file's name without its ending, for the files made of it.
pub fn stem(file: &Path) -> String {
    file.file_stem().map_or_else(|| "stone".into(), |s| s.to_string_lossy().into_owned())
}
