//! Designs of GemCad in its binary form, `.gem`: planes and outlines, little-endian, in a frame whose y is the
//! negative of ours. The format is published nowhere; docs/formats.md collects what is known of it.
//!
//! Reading trusts the planes and skips the outlines; writing makes the outlines anew.

use super::cutters::{self, Gear, TierPiece, WarningList};
use super::design_file::ImportedDesign;
use super::text::check_size;
use brillianteer_base::Fault;
use brillianteer_cut::{MAX_PLANES, Tiers};
use brillianteer_math::Plane;
use cursor::Cursor;
use glam::DVec3;

mod cursor;
mod write;

#[cfg(test)]
mod tests;

pub use write::write;

/// The size of the largest file that is read, in bytes.
pub const MAX_BYTES: usize = 64 << 20;

/// The number that follows the last facet, in place of a coordinate.
const END: f64 = -99999.0;

/// The number that follows the index of refraction; its meaning is unknown.
const UNKNOWN: u32 = 0x7fff;

/// The distance that the block from which GemCad cuts reaches along each axis. Where the facets do not reach the axis
/// within the block, its faces bound the stone that a file stores.
const BLANK: f64 = 17.0 / 15.0;

/// Coordinates this near to the block's faces lie on them: stored corners are off by less.
const ON_BLANK: f64 = 1e-9;

/// The number of lines at the top of a design, and of lines at its end.
const LINES: usize = 4;

/// A facet of the file.
struct Raw<'a> {
    /// The byte offset at which the facet begins.
    at: usize,
    /// The facet's plane in the file's frame, with a unit normal.
    plane: Plane,
    tier: i32,
    /// The facet's name, a tab, and its instructions.
    label: &'a [u8],
    /// True where the facet's outline ends at the block from which GemCad cuts.
    on_blank: bool,
}

/// Reads a design of GemCad; `label` is the path of the file, which names a design that does not name itself.
///
/// # Errors
/// Fails where the file is no such design; the error has the offset at fault where there is one.
pub fn read(bytes: &[u8], label: &str) -> Result<ImportedDesign, Fault> {
    check_size(bytes.len(), MAX_BYTES as u64)?;
    let mut warnings = WarningList::default();
    let mut cursor = Cursor::new(bytes);
    let raw = raw_facets(&mut cursor)?;
    let (mut tiers, index) = trailer(&mut cursor, &mut warnings)?;
    tiers.tiers = cutters::gathered(pieces(&raw, &tiers, &mut warnings));
    cutters::finish_as_said(&mut tiers, &mut warnings);
    let material = cutters::material(index.1, &cursor::place(index.0), &mut warnings);
    let name = cutters::title(&tiers.headers, label);
    cutters::brought(name, material, tiers, warnings)
}

/// Returns whether a file is such a design: facets down to the mark at their end.
pub fn looks_like(bytes: &[u8]) -> bool {
    bytes.len() <= MAX_BYTES && raw_facets(&mut Cursor::new(bytes)).is_ok_and(|facets| !facets.is_empty())
}

/// Reads facets down to the mark at their end.
fn raw_facets<'a>(cursor: &mut Cursor<'a>) -> Result<Vec<Raw<'a>>, Fault> {
    let mut facets = Vec::new();
    loop {
        let at = cursor.at();
        let x = cursor.f64("a facet")?;
        if x == END {
            return Ok(facets);
        }
        if facets.len() == MAX_PLANES {
            let problem = format!("there are more than {MAX_PLANES} facets, the most that a design can have");
            return Err(cursor::fault(at, problem));
        }
        facets.push(raw_facet(cursor, at, x)?);
    }
}

fn raw_facet<'a>(cursor: &mut Cursor<'a>, at: usize, x: f64) -> Result<Raw<'a>, Fault> {
    let p = DVec3::new(x, cursor.f64("a facet")?, cursor.f64("a facet")?);
    let plane = Plane::new(p, 1.0).normalized().ok_or_else(|| {
        let problem = format!(
            "{p} is not a facet's normal divided by its distance; three finite numbers that are not all 0 are \
                expected, or the file is not a .gem file"
        );
        cursor::fault(at, problem)
    })?;
    let tier = cursor.i32("a facet")?;
    let label = cursor.text("a facet's name")?;
    let on_blank = outline(cursor)?;
    Ok(Raw { at, plane, tier, label, on_blank })
}

/// Skips an outline, and returns whether it ends at the block from which GemCad cuts.
fn outline(cursor: &mut Cursor<'_>) -> Result<bool, Fault> {
    let mut on_blank = false;
    loop {
        let at = cursor.at();
        match cursor.i32("a facet's outline")? {
            0 => return Ok(on_blank),
            1 => {
                for _ in 0..3 {
                    on_blank |= (cursor.f64("a facet's outline")?.abs() - BLANK).abs() < ON_BLANK;
                }
            }
            other => {
                let problem = format!(
                    "{other} stands where 1 (a corner follows) or 0 (the facet ends) is expected; the file is \
                        damaged or is not a .gem file"
                );
                return Err(cursor::fault(at, problem));
            }
        }
    }
}

/// Reads all that follows the facets; returns a design without tiers, and the refractive index with its offset.
fn trailer(cursor: &mut Cursor<'_>, warnings: &mut WarningList) -> Result<(Tiers, (usize, f64)), Fault> {
    const WHAT: &str = "the symmetry, gear and index that follow the facets";
    let at = cursor.at();
    let (symmetry, mirror, teeth) = (cursor.i32(WHAT)?, cursor.i32(WHAT)?, cursor.i32(WHAT)?);
    let index = (cursor.at(), cursor.f64(WHAT)?);
    let unknown = cursor.i32(WHAT)? as u32;
    if unknown != UNKNOWN {
        let at = cursor::place(cursor.at() - 4);
        warnings.warn(|| format!("{at}{unknown:#x} stands where {UNKNOWN:#x} is expected; it is not kept"));
    }
    let offset = cursor.f64(WHAT)?;
    let place = cursor::place(at);
    let mut tiers = Gear::given(teeth, offset, &place, warnings).tiers();
    tiers.symmetry = cutters::symmetry(symmetry, &place, warnings);
    tiers.mirror = mirror != 0;
    [tiers.headers, tiers.footers] = lines(cursor, warnings);
    rest(cursor, warnings);
    Ok((tiers, index))
}

/// Reads the lines at the top and at the end. Missing lines give a warning, since the stone is whole without them.
fn lines(cursor: &mut Cursor<'_>, warnings: &mut WarningList) -> [Vec<String>; 2] {
    let mut all = Vec::new();
    for _ in 0..2 * LINES {
        match cursor.text("the headers and footers") {
            Ok(text) => all.push(cursor::decoded(text)),
            Err(fault) => {
                warnings.warn(|| fault.to_string());
                break;
            }
        }
    }
    let footers = all.split_off(all.len().min(LINES));
    [all, footers].map(cutters::up_to_the_last)
}

/// Warns of bytes that follow the design.
fn rest(cursor: &mut Cursor<'_>, warnings: &mut WarningList) {
    let (at, left) = (cursor::place(cursor.at()), cursor.left());
    if left == 0 {
        return;
    }
    match cursor.text("") {
        Ok(b"preform") => warnings.warn(|| format!("{at}the preform that follows the stone is not read")),
        _ => warnings.warn(|| format!("{at}the {left} bytes after the design are not read")),
    }
}

/// Converts facets to settings of the gear of `tiers`.
fn pieces(raw: &[Raw<'_>], tiers: &Tiers, warnings: &mut WarningList) -> Vec<TierPiece> {
    let gear = Gear { teeth: tiers.gear, offset: tiers.offset };
    let farthest = raw.iter().map(|facet| facet.plane.offset).fold(0.0, f64::max);
    let piece = |raw: &Raw<'_>| {
        let label = cursor::decoded(raw.label);
        let (name, instructions) = label.split_once('\t').unwrap_or((&label, ""));
        let distance = cutters::rid_of_noise(raw.plane.offset, farthest);
        if distance == 0.0 {
            let at = cursor::place(raw.at);
            warnings
                .warn(|| format!("{at}facet '{name}' runs through the origin; its distance is taken as 0"));
        }
        let normal = raw.plane.normal * DVec3::new(1.0, -1.0, 1.0);
        TierPiece {
            tier: raw.tier as u32 as usize,
            setting: gear.setting(normal, distance),
            name: name.to_owned(),
            instructions: instructions.to_owned(),
            is_cut: true,
            frosting: 0.0,
        }
    };
    let pieces = raw.iter().map(piece).collect();
    warn_of_blank(raw, warnings);
    pieces
}

fn warn_of_blank(raw: &[Raw<'_>], warnings: &mut WarningList) {
    let on_blank = || raw.iter().filter(|facet| facet.on_blank);
    if let Some(first) = on_blank().next() {
        let (at, count) = (cursor::place(first.at), on_blank().count());
        warnings.warn(|| {
            format!(
                "{at}{count} facets end at the block that GemCad cuts from, {BLANK:.4} from the middle; here facets \
                 alone bound the stone, and it may reach farther"
            )
        });
    }
}
