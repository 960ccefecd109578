//! The blocks of a cutter's sheet: tiers in the order in which they are cut.

use brillianteer_cut::{Tier, TierZone, Tiers, with_finish};
use brillianteer_math::Polytope;
use serde::{Serialize, Serializer};
use std::collections::{BTreeMap, BTreeSet};

/// A block of a cutter's sheet, in the order in which the stone is cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum BlockKind {
    /// Pavilion and girdle tiers of which nothing is left on the finished stone, and tiers that are named PF.
    Preform,
    /// Pavilion, culet and girdle.
    Pavilion,
    /// Crown and table.
    Crown,
}

impl BlockKind {
    /// The blocks in the order of the sheet.
    pub const ALL: [Self; 3] = [Self::Preform, Self::Pavilion, Self::Crown];

    /// Returns the heading of the block.
    pub fn name(self) -> &'static str {
        match self {
            Self::Preform => "PREFORM",
            Self::Pavilion => "PAVILION",
            Self::Crown => "CROWN",
        }
    }
}

impl Serialize for BlockKind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

/// The tiers of one block, in the order in which they are cut.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SheetBlock {
    /// The kind of the block.
    pub name: BlockKind,
    /// The tiers.
    pub tiers: Vec<SheetRow>,
}

/// A line of a cutter's sheet: one setting of the machine.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SheetRow {
    /// The name of the tier and of its facets in the drawings and in the instructions of other tiers.
    pub name: String,
    /// The angle from the girdle plane, degrees, 0 to 180.
    pub angle_deg: f64,
    /// The indices, rising, above 0 and up to the number of teeth; the tooth 0 is the last one, and comes first. None for
    /// table and culet, which have no direction.
    pub indices: Vec<f64>,
    /// The cutter's instruction; "Table" or "Culet" where a flat tier has none.
    pub instruction: String,
    /// True for a leaning tier of the pavilion below the critical angle of the material.
    pub below_critical: bool,
    /// The number of the tier in the design, from 0.
    #[serde(skip)]
    pub tier: usize,
    /// The part of the stone where the tier lies.
    #[serde(skip)]
    pub zone: TierZone,
}

impl SheetRow {
    /// Returns the indices as they are printed, joined by dashes.
    pub fn indices_text(&self) -> String {
        self.indices.iter().map(|&index| index_text(index)).collect::<Vec<_>>().join("-")
    }
}

/// Writes an index with up to three decimals.
pub(super) fn index_text(index: f64) -> String {
    format!("{}", rounded(index))
}

/// Returns whether an index is printed with decimals, because it lies between two teeth.
pub(super) fn is_between_teeth(index: f64) -> bool {
    rounded(index).fract() != 0.0
}

fn rounded(index: f64) -> f64 {
    (index * 1000.0).round() / 1000.0
}

/// Returns an index above 0 and up to the number of teeth.
fn on_gear(index: f64, teeth: f64) -> f64 {
    let index = (index.rem_euclid(teeth) * 1e6).round() / 1e6;
    if index <= 0.0 { teeth } else { index }
}

/// Returns text on one line, without control characters.
pub(super) fn cleaned(text: &str) -> String {
    let spaced = |c: char| if c.is_control() { ' ' } else { c };
    text.chars().map(spaced).collect::<String>().split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Returns the tiers that are cut, as blocks without those that are empty. `critical_deg` is the critical angle, 0 where
/// there is none; `solid` is the stone whose planes are the facets of `tiers` in their order.
pub(super) fn blocks(tiers: &Tiers, solid: &Polytope, critical_deg: f64) -> Vec<SheetBlock> {
    let (names, left) = (tiers.names(), left_on(tiers, solid));
    let mut blocks: BTreeMap<BlockKind, Vec<SheetRow>> = BTreeMap::new();
    for (number, tier) in tiers.tiers.iter().enumerate().filter(|(_, tier)| tier.is_cut) {
        let (zone, name) = (tier.zone(), names[number].clone());
        let kind = match zone {
            TierZone::Table | TierZone::Crown => BlockKind::Crown,
            _ if !left.contains(&number) || name.to_lowercase().starts_with("pf") => BlockKind::Preform,
            TierZone::Girdle | TierZone::Pavilion | TierZone::Culet => BlockKind::Pavilion,
        };
        let is_leaning = kind == BlockKind::Pavilion && zone == TierZone::Pavilion;
        let row = SheetRow {
            name,
            angle_deg: tier.angle.abs(),
            indices: indices(tiers, tier),
            instruction: instruction(tier),
            below_critical: is_leaning && tier.angle.abs() < critical_deg,
            tier: number,
            zone,
        };
        blocks.entry(kind).or_default().push(row);
    }
    blocks.into_iter().map(|(name, tiers)| SheetBlock { name, tiers }).collect()
}

fn indices(tiers: &Tiers, tier: &Tier) -> Vec<f64> {
    if matches!(tier.zone(), TierZone::Table | TierZone::Culet) {
        return vec![];
    }
    let teeth = f64::from(tiers.gear.unsigned_abs());
    let mut indices: Vec<f64> = tier.facets.iter().map(|facet| on_gear(facet.index, teeth)).collect();
    // The last tooth is the zero of the gear, so it comes first.
    indices.sort_by(|a, b| (a % teeth).total_cmp(&(b % teeth)));
    indices
}

fn instruction(tier: &Tier) -> String {
    match (cleaned(&with_finish(tier.instruction(), tier.frosting)), tier.zone()) {
        (said, TierZone::Table) if said.is_empty() => "Table".to_owned(),
        (said, TierZone::Culet) if said.is_empty() => "Culet".to_owned(),
        (said, _) => said,
    }
}

/// Returns the numbers of the tiers that have a facet on the stone, or one that coincides with such a facet.
fn left_on(tiers: &Tiers, solid: &Polytope) -> BTreeSet<usize> {
    let of_plane = tiers_of_planes(tiers);
    let kept = solid.facets().iter().map(|facet| facet.source);
    let kept: BTreeSet<usize> = kept.collect();
    let merged = solid.merged().iter().filter(|(_, into)| kept.contains(into)).map(|(dropped, _)| *dropped);
    kept.iter().copied().chain(merged).filter_map(|plane| of_plane.get(plane).copied()).collect()
}

/// Returns the number of the tier of every facet that is cut, in their order.
pub(super) fn tiers_of_planes(tiers: &Tiers) -> Vec<usize> {
    let cut = tiers.tiers.iter().enumerate().filter(|(_, tier)| tier.is_cut);
    cut.flat_map(|(number, tier)| std::iter::repeat_n(number, tier.facets.len())).collect()
}
