//! The content of a cutter's sheet, as plain data.

use super::blocks::{SheetBlock, SheetRow, blocks, cleaned, is_between_teeth, tiers_of_planes};
use brillianteer_cut::{Cut, MaterialRef, SheetFigures, Tiers};
use brillianteer_optics::{critical_angle, line};
use brillianteer_scene::{Specimen, Stone};
use serde::Serialize;

/// The note about a design whose facets leave the stone open.
const OPEN: &str = "The facets of the design leave the stone open; the block that it is cut from closes it.";

/// The content of a cutter's sheet about a design.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CuttingSheet {
    /// The name of the design.
    pub title: String,
    /// The designer, the dates and the source, a line each, as the design gives them.
    pub lines: Vec<String>,
    /// The index of refraction in sodium light for which the angles were designed.
    pub refractive_index: f64,
    /// The name of the material; `None` where the design gives an index alone.
    pub material: Option<String>,
    /// The number of times that the design repeats around its axis.
    pub symmetry: u32,
    /// True where each repeat is its own mirror image.
    pub mirror: bool,
    /// The teeth of the index gear.
    pub gear: u32,
    /// True where the teeth count clockwise, seen from above the table.
    pub clockwise: bool,
    /// The ratios and counts, measured on the stone.
    pub figures: SheetFigures,
    /// The critical angle in degrees; `None` for an index of 1 or less.
    pub critical_angle_deg: Option<f64>,
    /// The names of the pavilion's tiers below the critical angle, through which light from above leaks.
    pub below_critical: Vec<String>,
    /// The tiers in the order in which they are cut: preform, pavilion, crown.
    pub blocks: Vec<SheetBlock>,
    /// True where facets of the stone are frosted.
    pub is_frosted: bool,
    /// The names of the tiers with an index between two teeth of the gear.
    pub between_teeth: Vec<String>,
    /// Further statements of the design, and remarks on its unusual properties.
    pub notes: Vec<String>,
    /// The stone that the tiers make.
    #[serde(skip)]
    pub(super) stone: Stone,
    /// The design as tiers, with the gear that the sheet is for.
    #[serde(skip)]
    pub(super) tiers: Tiers,
    /// The number of the tier of each facet of the stone; `None` for faces of the block.
    #[serde(skip)]
    pub(super) tier_of_facet: Vec<Option<usize>>,
}

impl CuttingSheet {
    /// Describes a stone whose planes are the facets of `tiers`, in their order.
    ///
    /// With `left_handed`, indices of a gear that counts counter-clockwise are those of a gear that counts clockwise; the
    /// stone stays the same.
    pub fn new(specimen: &Specimen, stone: &Stone, tiers: &Tiers, left_handed: bool) -> Self {
        let tiers = if left_handed { counted_clockwise(tiers) } else { tiers.clone() };
        let design = &specimen.design;
        let refractive_index = specimen.material.index(line::SODIUM_D);
        let critical_angle_deg = critical_angle(refractive_index).map(f64::to_degrees);
        let blocks = blocks(&tiers, &stone.polytope, critical_angle_deg.unwrap_or(0.0));
        let below = blocks.iter().flat_map(|block| &block.tiers).filter(|row| row.below_critical);
        let of_plane = tiers_of_planes(&tiers);
        let facets = stone.polytope.facets().iter();
        let tier_of_facet: Vec<Option<usize>> =
            facets.map(|facet| of_plane.get(facet.source).copied()).collect();
        Self {
            title: cleaned(&design.name),
            lines: lines(specimen, &tiers),
            refractive_index,
            material: match &design.material {
                MaterialRef::Index(_) => None,
                _ => Some(cleaned(&specimen.material.name)),
            },
            symmetry: tiers.symmetry,
            mirror: tiers.mirror,
            gear: tiers.gear.unsigned_abs(),
            clockwise: tiers.gear < 0,
            figures: SheetFigures::of(&stone.polytope, stone.names()),
            critical_angle_deg,
            below_critical: below.map(|row| row.name.clone()).collect(),
            is_frosted: stone.polytope.is_frosted(),
            between_teeth: between_teeth(&blocks),
            notes: notes(specimen, &tiers, tier_of_facet.contains(&None)),
            stone: stone.clone(),
            tier_of_facet,
            blocks,
            tiers,
        }
    }
}

/// Returns the names of the rows with an index that is printed with decimals.
fn between_teeth(blocks: &[SheetBlock]) -> Vec<String> {
    let rows = blocks.iter().flat_map(|block| &block.tiers);
    let is_between = |row: &&SheetRow| row.indices.iter().any(|&index| is_between_teeth(index));
    rows.filter(is_between).map(|row| row.name.clone()).collect()
}

/// Returns the same design on a gear that counts clockwise, seen from above.
fn counted_clockwise(tiers: &Tiers) -> Tiers {
    let mut tiers = tiers.clone();
    if tiers.gear > 0 {
        tiers.gear = -tiers.gear;
        let facets = tiers.tiers.iter_mut().flat_map(|tier| &mut tier.facets);
        facets.for_each(|facet| facet.index = 2.0 * tiers.offset - facet.index);
    }
    tiers
}

/// Returns the lines under the title: the design's own, without the title, and its source.
fn lines(specimen: &Specimen, tiers: &Tiers) -> Vec<String> {
    let design = &specimen.design;
    let own = match design.cut {
        Cut::Tiers(_) => tiers.headers.as_slice(),
        _ => &[],
    };
    let source = design.source.iter().map(|source| format!("Source: {source}"));
    // A design that the program turned into tiers has its source among its own lines too.
    let own = own.iter().filter(|&line| design.source.as_ref() != Some(line));
    let all = own.cloned().chain(source).map(|line| cleaned(&line));
    let title = cleaned(&design.name);
    let mut lines: Vec<String> = vec![];
    let is_said = |line: &String| line.contains(char::is_alphanumeric) && *line != title;
    for line in all.filter(is_said) {
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    lines
}

/// Returns the notes of a design; `open` says that the block closes its stone.
fn notes(specimen: &Specimen, tiers: &Tiers, open: bool) -> Vec<String> {
    let uncut = tiers.tiers.iter().filter(|tier| !tier.is_cut).count();
    let uncut = match uncut {
        0 => None,
        1 => Some("One tier of the design is not cut and is left out.".to_owned()),
        _ => Some(format!("{uncut} tiers of the design are not cut and are left out.")),
    };
    let own = specimen.design.notes.iter().chain(&tiers.footers);
    let all = own.cloned().chain(open.then(|| OPEN.to_owned())).chain(uncut);
    all.map(|note| cleaned(&note)).filter(|note| !note.is_empty()).collect()
}
