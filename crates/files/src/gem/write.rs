//! Writes a design as `.gem`.

use super::{END, LINES, UNKNOWN};
use crate::cutters::{self, FacetOutline};
use crate::design_file::EncodedDesign;
use brillianteer_cut::{Tier, Tiers, with_finish};
use brillianteer_scene::Specimen;
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// The greatest length of a text that the format can hold, in bytes.
const LONGEST: usize = 255;

/// Encodes texts, and counts their losses.
#[derive(Default)]
struct Texts {
    cut_off: usize,
    replaced: usize,
}

impl Texts {
    /// Adds a text behind its length, in Windows-1252.
    fn put(&mut self, text: &str, bytes: &mut Vec<u8>) {
        let mut encoded: Vec<u8> = text.chars().map(|c| self.encoded(c)).collect();
        self.cut_off += usize::from(encoded.len() > LONGEST);
        encoded.truncate(LONGEST);
        bytes.push(encoded.len() as u8);
        bytes.extend(encoded);
    }

    fn encoded(&mut self, character: char) -> u8 {
        let mut buffer = [0; 4];
        let (bytes, _, unknown) = encoding_rs::WINDOWS_1252.encode(character.encode_utf8(&mut buffer));
        match (unknown, bytes.as_ref()) {
            (false, [byte]) => *byte,
            _ => {
                self.replaced += 1;
                b'?'
            }
        }
    }

    fn add_losses(&self, lost: &mut Vec<String>) {
        if self.cut_off > 0 {
            lost.push(format!("{} texts are cut off at {LONGEST} characters", self.cut_off));
        }
        if self.replaced > 0 {
            lost.push(format!("{} characters are written as '?': the format lacks them", self.replaced));
        }
    }
}

/// Encodes the design of a specimen as `.gem`, with messages about the properties that the format cannot hold.
pub fn write(specimen: &Specimen) -> EncodedDesign {
    let mut lost = Vec::new();
    let tiers = cutters::tiers_of(specimen, &mut lost);
    let first = tiers.headers.iter().take(LINES).find(|line| brillianteer_cut::is_printable(line.trim()));
    cutters::untold(&specimen.design, first, &mut lost);
    left_out(&tiers, &mut lost);
    let index = cutters::refractive_index(specimen, &mut lost);
    let (mut bytes, mut texts) = (Vec::new(), Texts::default());
    put_facets(&tiers, &mut texts, &mut bytes);
    put_trailer(&tiers, index, &mut texts, &mut bytes);
    texts.add_losses(&mut lost);
    EncodedDesign { bytes, lost }
}

/// Adds messages about the properties that the format cannot hold.
fn left_out(tiers: &Tiers, lost: &mut Vec<String>) {
    let mut tell = |count: usize, what: &str| {
        if count > 0 {
            lost.push(format!("{count} {what}"));
        }
    };
    tell(tiers.tiers.iter().filter(|tier| !tier.is_cut).count(), "tiers that are not cut are left out");
    let empty = tiers.tiers.iter().filter(|tier| tier.is_cut && tier.facets.is_empty());
    tell(empty.count(), "tiers without facets are left out");
    tell(tiers.headers.len().saturating_sub(LINES), "lines at the top are left out; there is room for 4");
    tell(tiers.footers.len().saturating_sub(LINES), "lines at the end are left out; there is room for 4");
    tell(tiers.remarks.len(), "remarks are left out");
}

fn put_facets(tiers: &Tiers, texts: &mut Texts, bytes: &mut Vec<u8>) {
    let outlines = cutters::outlines(tiers);
    let farthest = outlines.iter().map(|(plane, _)| plane.offset).fold(0.0, f64::max);
    let mut outlines = outlines.iter();
    let cut = tiers.tiers.iter().filter(|tier| tier.is_cut && !tier.facets.is_empty());
    for (number, tier) in (1i32..).zip(cut) {
        for (place, (facet, outline)) in tier.facets.iter().zip(outlines.by_ref()).enumerate() {
            let p = inverse(tier, outline, farthest);
            p.to_array().iter().for_each(|x| bytes.extend(x.to_le_bytes()));
            bytes.extend(number.to_le_bytes());
            let instructions =
                if place == 0 { with_finish(tier.instruction(), tier.frosting) } else { "".into() };
            texts.replaced += facet.name.matches('\t').count();
            texts.put(&format!("{}\t{instructions}", facet.name.replace('\t', "?")), bytes);
            put_outline(&outline.1, bytes);
        }
    }
    bytes.extend(END.to_le_bytes());
}

/// Returns the normal divided by the distance, in the file's frame.
fn inverse(tier: &Tier, (plane, _): &FacetOutline, farthest: f64) -> DVec3 {
    let DVec3 { x, y, mut z } = plane.normal;
    if z == 0.0 {
        // GemCad separates girdle facets of crown and pavilion by the rounding of a right angle's cosine.
        z = FRAC_PI_2.cos().copysign(tier.angle);
    }
    DVec3::new(x, -y, z) / cutters::off_the_origin(plane.offset, farthest)
}

/// Adds an outline. Its corners run the other way round, since the file's frame is mirrored.
fn put_outline(corners: &[DVec3], bytes: &mut Vec<u8>) {
    for corner in corners.iter().rev() {
        bytes.extend(1i32.to_le_bytes());
        [corner.x, -corner.y, corner.z].iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    }
    bytes.extend(0i32.to_le_bytes());
}

fn put_trailer(tiers: &Tiers, index: f64, texts: &mut Texts, bytes: &mut Vec<u8>) {
    bytes.extend(i32::try_from(tiers.symmetry).unwrap_or(i32::MAX).to_le_bytes());
    bytes.extend(i32::from(tiers.mirror).to_le_bytes());
    bytes.extend(tiers.gear.to_le_bytes());
    bytes.extend(index.to_le_bytes());
    bytes.extend(UNKNOWN.to_le_bytes());
    bytes.extend(tiers.offset.to_le_bytes());
    for lines in [&tiers.headers, &tiers.footers] {
        let padded = lines.iter().map(String::as_str).chain(std::iter::repeat(""));
        padded.take(LINES).for_each(|line| texts.put(line, bytes));
    }
}
