//! What the formats of gem cutters have in common: what a design is called and made of, and what they cannot hold.

use super::cut_file::CutFileError;
use super::design_file::Brought;
use crate::cut::{Cut, DEFAULT_DIAMETER_MM, Design, Indexed, MaterialRef, Tier, Tiers, is_printable};
use crate::math::{Basis, Plane, Symmetry};
use crate::optics::line;
use crate::scene::Specimen;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;
use std::path::Path;

/// The index of refraction that is taken where a file names none: that of quartz, which most designs are for.
const USUAL_INDEX: f64 = 1.54;

/// The design that a cutter's file tells of.
///
/// # Errors
/// Where its numbers make no sense.
pub(super) fn brought(
    mut tiers: Tiers,
    ri: Option<f64>,
    mut warnings: Vec<String>,
    label: &str,
) -> Result<Brought, CutFileError> {
    let material = ri.map(MaterialRef::Index).filter(|material| material.check().is_ok());
    if material.is_none() {
        let given = ri.map_or_else(
            || "no index of refraction is named".to_owned(),
            |ri| format!("the index of refraction {ri} is none from 1 to 5"),
        );
        warnings.push(format!("{given}; {USUAL_INDEX} is taken"));
    }
    if title(&tiers).is_none() {
        // What is called nothing is called as its file.
        let stem = Path::new(label).file_stem().map(|stem| stem.to_string_lossy().into_owned());
        tiers.headers.insert(0, stem.filter(|stem| is_printable(stem)).unwrap_or_else(|| "stone".to_owned()));
    }
    let design = Design {
        name: title(&tiers).unwrap_or_default().to_owned(),
        source: None,
        notes: None,
        material: material.unwrap_or(MaterialRef::Index(USUAL_INDEX)),
        diameter_mm: DEFAULT_DIAMETER_MM,
        cut: Cut::Tiers(tiers),
    };
    match design.check() {
        Ok(()) => Ok(Brought { design, warnings }),
        Err(error) => Err(CutFileError { path: label.to_owned(), line: None, message: error.to_string() }),
    }
}

/// What a design is called: its first header that can be shown.
fn title(tiers: &Tiers) -> Option<&str> {
    tiers.headers.iter().map(|header| header.trim()).find(|header| is_printable(header))
}

/// A design on its way into a cutter's file.
pub(super) struct Texts {
    /// Its tiers; of a design that has none, made from its planes.
    pub tiers: Tiers,
    /// Its index of refraction for yellow light.
    pub ri: f64,
    /// What the file cannot hold.
    pub lost: Vec<String>,
}

impl Texts {
    /// The design of a stone.
    pub fn of(specimen: &Specimen) -> Self {
        let design = &specimen.design;
        let mut tiers = match &design.cut {
            Cut::Tiers(tiers) => tiers.clone(),
            Cut::RoundBrilliant(_) | Cut::Planes(_) => of_planes(specimen),
        };
        if title(&tiers) != Some(&design.name) {
            tiers.headers.insert(0, design.name.clone());
        }
        let mut lost = vec![];
        let mut lose = |is_lost: bool, what: &str| lost.extend(is_lost.then(|| what.to_owned()));
        lose(design.source.is_some(), "its source");
        lose(design.notes.is_some(), "its notes");
        lose(design.diameter_mm != DEFAULT_DIAMETER_MM, "its size in mm");
        let is_index = matches!(design.material, MaterialRef::Index(_));
        lose(!is_index, "its material but for the index of refraction");
        lose(design.cut.brilliant().is_some(), "its proportions but for the facets that they make");
        let ri = match &design.material {
            MaterialRef::Index(index) => *index,
            MaterialRef::Name(_) | MaterialRef::Custom(_) => specimen.medium(line::SODIUM_D).index,
        };
        Self { tiers, ri, lost }
    }

    fn lose(&mut self, what: String) {
        if !self.lost.contains(&what) {
            self.lost.push(what);
        }
    }

    /// Text on one line.
    pub fn line(&mut self, text: &str) -> String {
        let line: String = text
            .chars()
            .map(|c| if matches!(c, '\n' | '\r' | '\0' | '\u{1a}' | '\u{feff}') { ' ' } else { c })
            .collect();
        if line != text {
            self.lose("breaks of lines within a text".to_owned());
        }
        line
    }

    /// Text as one word.
    pub fn word(&mut self, text: &str) -> String {
        let word: String =
            text.chars().map(|c| if c.is_whitespace() || c.is_control() { '_' } else { c }).collect();
        if word != text {
            self.lose("blanks in names of facets, which become _".to_owned());
        }
        word
    }

    /// Says that tiers which are not cut are left out.
    pub fn uncut(&mut self) {
        let count = self.tiers.tiers.iter().filter(|tier| !tier.is_cut).count();
        if count > 0 {
            self.lose(format!("{count} tiers that are not cut"));
        }
    }

    /// Says that remarks are left out.
    pub fn remarks(&mut self) {
        let keys: Vec<&str> = self.tiers.remarks.iter().map(|(key, _)| key.as_str()).collect();
        if !keys.is_empty() {
            let keys = keys.join(", ");
            self.lose(format!("remarks: {keys}"));
        }
    }
}

/// The teeth of the gear that designs without one are written for: the most common.
const GEAR: i32 = 96;

/// Facets stand in one tier where they agree to this: degrees, and girdle radii. What a file's own digits leave is more.
const ALIKE: f64 = 1e-9;

/// A stone's facets as tiers.
fn of_planes(specimen: &Specimen) -> Tiers {
    let facets = specimen.design.facets().unwrap_or_default();
    let planes = facets.iter().map(|(_, plane)| *plane);
    let symmetry = Symmetry::of(planes, &Basis::FACE_UP, DVec3::Z);
    let mut tiers: Vec<(String, Tier)> = vec![];
    for (name, plane) in facets {
        let (angle, distance, index) = setting(&plane);
        let stem = crate::cut::tier_stem(&name).to_owned();
        let facet = Indexed { index, name: String::new() };
        match tiers.last_mut().filter(|(of, tier)| *of == stem && is_alike(tier, angle, distance)) {
            Some((_, tier)) => tier.facets.push(facet),
            None => {
                let facet = Indexed { name: stem.clone(), ..facet };
                let facets = vec![facet];
                tiers.push((
                    stem,
                    Tier { angle, distance, instructions: String::new(), is_cut: true, facets },
                ));
            }
        }
    }
    let tiers = tiers.into_iter().map(|(_, tier)| tier).collect();
    let (headers, footers, remarks) = (vec![], vec![], vec![]);
    let mirror = symmetry.mirror.is_some();
    Tiers { gear: GEAR, offset: 0.0, symmetry: symmetry.turns, mirror, headers, footers, remarks, tiers }
}

fn is_alike(tier: &Tier, angle: f64, distance: f64) -> bool {
    (tier.angle - angle).abs() < ALIKE
        && tier.angle.is_sign_negative() == angle.is_sign_negative()
        && (tier.distance - distance).abs() < ALIKE
}

/// Angle, distance and index of a plane on [`GEAR`].
fn setting(plane: &Plane) -> (f64, f64, f64) {
    let across: DVec2 = plane.normal.truncate();
    let slope = across.length().atan2(plane.normal.z.abs()).to_degrees();
    let angle = if plane.normal.z < 0.0 || plane.normal.z == 0.0 { -slope } else { slope };
    let turn = across.x.atan2(-across.y) / TAU * f64::from(GEAR);
    let index = if slope == 0.0 { 0.0 } else { turn.rem_euclid(f64::from(GEAR)) };
    (snapped(angle), plane.offset, snapped(index))
}

/// An angle or an index that is meant to have six digits at most, without what computing has added.
fn snapped(value: f64) -> f64 {
    let round = (value * 1e6).round() / 1e6;
    if (value - round).abs() < ALIKE { round } else { value }
}
