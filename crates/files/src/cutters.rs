//! Parts that the readers and writers of gem cutters' files share: planes as settings of a faceting machine, facets
//! gathered into tiers, and warnings about designs with contradictory or missing statements.
//!
//! Numbers that are computed from planes are rounded to the digits that the cutter wrote, so that a design that is
//! written and read again has the same numbers.

use super::design_file::ImportedDesign;
use brillianteer_base::Fault;
use brillianteer_cut::{
    Cut, DEFAULT_DIAMETER_MM, Design, FinishNote, Indexed, MaterialRef, Tier, Tiers, is_printable,
};
use glam::DVec3;
use std::f64::consts::TAU;
use std::path::Path;

mod outward;
#[cfg(test)]
pub(super) mod sample;

pub(super) use outward::{FacetOutline, outlines, refractive_index, tiers_of, untold};
pub use outward::{NoTiers, as_tiers, in_tiers};

/// Two facets of one tier are cut at one setting if their angles (degrees) and their distances (relative) differ by
/// no more than this. A number this near to one that a cutter would write is taken for that one. The value is above
/// the noise of stored planes (1e-13) and far below the accuracy of machines (1e-3).
const SAME_SETTING: f64 = 1e-9;

/// Angles are rounded to this many steps per degree: millionths, which cutters' programs print.
const ANGLE_STEPS: f64 = 1e6;

/// Other angles and indices are rounded to this many steps per unit: eleven decimals, more than a stored plane's noise
/// leaves, less than 1e-12 in radians.
const KEPT: f64 = 1e11;

/// A plane runs through the origin if its distance is below this part of the farthest plane's: far below the accuracy
/// of 8 decimals.
const THROUGH_ORIGIN: f64 = 1e-15;

/// The index of refraction in place of an impossible one: gem cutters' default.
const USUAL_INDEX: f64 = 1.54;

/// The gear in place of an impossible one: the commonest.
const USUAL_GEAR: i32 = 96;

/// The most warnings that are reported about one file.
const MOST_WARNINGS: usize = 100;

/// The setting of the faceting machine at which a facet is cut; units as in [`Tier`] and [`Indexed`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FacetSetting {
    pub angle: f64,
    pub distance: f64,
    pub index: f64,
}

/// The index gear to which the indices of settings refer; units as in [`Tiers`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Gear {
    pub teeth: i32,
    pub offset: f64,
}

/// A facet that is to be gathered into a tier.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TierPiece {
    /// A number for the facet's tier in its file; facets of different tiers are never gathered.
    pub tier: usize,
    pub setting: FacetSetting,
    pub name: String,
    pub instructions: String,
    pub is_cut: bool,
    /// The frosting, as in [`Tier`].
    pub frosting: f64,
}

/// Warnings about one file; those beyond a number that people read are only counted.
#[derive(Debug, Default)]
pub(super) struct WarningList {
    texts: Vec<String>,
    more: usize,
}

impl WarningList {
    /// Adds a warning, whose text is made only if there is room for it.
    pub fn warn(&mut self, text: impl FnOnce() -> String) {
        if self.texts.len() < MOST_WARNINGS {
            self.texts.push(text());
        } else {
            self.more += 1;
        }
    }

    pub fn texts(mut self) -> Vec<String> {
        if self.more > 0 {
            self.texts.push(format!("{} more warnings of this kind are left out", self.more));
        }
        self.texts
    }
}

impl Default for Gear {
    /// Returns the gear of a file that states none, or an impossible one.
    fn default() -> Self {
        Self { teeth: USUAL_GEAR, offset: 0.0 }
    }
}

impl Gear {
    /// Returns the gear that a file gives, or the usual gear and a warning, which `at` begins.
    pub fn given(teeth: i32, offset: f64, at: &str, warnings: &mut WarningList) -> Self {
        let given = Self { teeth, offset };
        match given.tiers().check() {
            Ok(()) => given,
            Err((_, fault)) => {
                warnings
                    .warn(|| format!("{at}{fault}; the facets are given by a gear of {USUAL_GEAR} teeth"));
                Self::default()
            }
        }
    }

    /// Returns a design of this gear without tiers.
    pub fn tiers(self) -> Tiers {
        Tiers { gear: self.teeth, offset: self.offset, symmetry: 1, ..Tiers::default() }
    }

    /// Returns the setting at which the plane with this unit normal is cut. The sign of `normal.z`, even of zero, separates
    /// crown from pavilion.
    pub fn setting(self, normal: DVec3, distance: f64) -> FacetSetting {
        let across = normal.x.hypot(normal.y);
        let slope = as_written(across.atan2(normal.z.abs()).to_degrees(), ANGLE_STEPS);
        let teeth = f64::from(self.teeth).abs();
        let index = match slope {
            // A flat facet has no azimuth; cutters set the machine to its last tooth.
            0.0 => teeth,
            _ => self.index(normal.x.atan2(-normal.y)),
        };
        FacetSetting { angle: slope.copysign(normal.z), distance: fourteen_digits(distance), index }
    }

    /// Returns the index, above 0 and up to the number of teeth, of a facet whose azimuth is given in radians from
    /// -y.
    fn index(self, azimuth: f64) -> f64 {
        let teeth = f64::from(self.teeth);
        let index = (self.offset + teeth * azimuth / TAU).rem_euclid(teeth.abs());
        match as_written(index, 1.0) {
            0.0 => teeth.abs(),
            index => index,
        }
    }
}

/// Returns the number that the cutter probably wrote: rounded to `steps` per unit where that is very near, else
/// rounded to the digits above the noise.
fn as_written(value: f64, steps: f64) -> f64 {
    let on_step = (value * steps).round() / steps;
    if (on_step - value).abs() < SAME_SETTING { on_step } else { (value * KEPT).round() / KEPT }
}

fn fourteen_digits(length: f64) -> f64 {
    format!("{length:.13e}").parse().unwrap_or(length)
}

/// Returns a distance, or 0 where the plane runs through the origin.
pub(super) fn rid_of_noise(distance: f64, farthest: f64) -> f64 {
    if distance <= farthest * THROUGH_ORIGIN { 0.0 } else { distance }
}

/// Returns a distance above 0 whose inverse can be written; the opposite of [`rid_of_noise`].
pub(super) fn off_the_origin(distance: f64, farthest: f64) -> f64 {
    let farthest = if farthest > 0.0 { farthest } else { 1.0 };
    distance.max(farthest * THROUGH_ORIGIN / 100.0)
}

/// Gathers facets into tiers: facets in a row that are cut alike, and are not kept apart by instructions of their own.
pub(super) fn gathered(pieces: impl IntoIterator<Item = TierPiece>) -> Vec<Tier> {
    let mut tiers: Vec<Tier> = Vec::new();
    let mut last = None;
    for piece in pieces {
        let same = last == Some(piece.tier);
        last = Some(piece.tier);
        match tiers.last_mut().filter(|tier| same && piece.belongs_to(tier)) {
            Some(tier) => piece.join(tier),
            None => tiers.push(piece.alone()),
        }
    }
    tiers
}

impl TierPiece {
    fn belongs_to(&self, tier: &Tier) -> bool {
        let said = [&self.instructions, &tier.instructions];
        self.is_cut_as(&FacetSetting { angle: tier.angle, distance: tier.distance, index: 0.0 })
            && self.is_cut == tier.is_cut
            && self.frosting == tier.frosting
            && (said[0] == said[1] || said.iter().any(|text| text.is_empty()))
    }

    /// Returns whether the facet is cut at the angle and the distance of another setting.
    fn is_cut_as(&self, other: &FacetSetting) -> bool {
        let FacetSetting { angle, distance, .. } = self.setting;
        (angle - other.angle).abs() <= SAME_SETTING
            && angle.is_sign_negative() == other.angle.is_sign_negative()
            && (distance - other.distance).abs() <= SAME_SETTING * other.distance
    }

    fn join(self, tier: &mut Tier) {
        if tier.instructions.is_empty() {
            tier.instructions = self.instructions;
        }
        tier.facets.push(Indexed { index: self.setting.index, name: self.name });
    }

    fn alone(self) -> Tier {
        let FacetSetting { angle, distance, index } = self.setting;
        let facets = vec![Indexed { index, name: self.name }];
        Tier {
            angle,
            distance,
            instructions: self.instructions,
            meet: None,
            is_cut: self.is_cut,
            frosting: self.frosting,
            facets,
        }
    }
}

/// Takes the finish of each tier from its instructions, as far as they are plain, and warns of unclear ones.
pub(super) fn finish_as_said(tiers: &mut Tiers, warnings: &mut WarningList) {
    for (number, tier) in (1..).zip(&mut tiers.tiers) {
        match FinishNote::of(&tier.instructions) {
            FinishNote::Unsaid => {}
            FinishNote::Frosting(frosting) => tier.frosting = frosting,
            FinishNote::Unclear => warnings.warn(|| {
                format!(
                    "tier {number}: '{:.60}' frosts facets, but not plainly those of this tier; they are taken as polished. \
                     Write 'Frosted' where it means the whole tier",
                    tier.instructions
                )
            }),
        }
    }
    let texts = tiers.headers.iter().chain(&tiers.footers);
    let named = texts.into_iter().find(|text| FinishNote::is_named_in(text));
    if let Some(text) = named.filter(|_| tiers.tiers.iter().all(|tier| tier.frosting == 0.0)) {
        warnings.warn(|| {
            format!(
                "'{:.60}' names frosted facets, which are only read from the instructions of their tiers; all facets are \
                 taken as polished",
                text.trim()
            )
        });
    }
}

/// Removes the names of all facets but the first of each tier, where cutters put the tier's name.
pub(super) fn named_once(tiers: &mut [Tier]) {
    tiers.iter_mut().flat_map(|tier| tier.facets.iter_mut().skip(1)).for_each(|facet| facet.name.clear());
}

/// Returns the name of a design: the first of these lines that is printable, else the name of its file without the
/// ending.
pub(super) fn title<'a>(lines: impl IntoIterator<Item = &'a String>, label: &str) -> String {
    let stem = Path::new(label).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let lines = lines.into_iter().map(|line| line.trim());
    let mut names = lines.chain(stem.as_deref()).filter(|name| is_printable(name));
    names.next().unwrap_or("design").to_owned()
}

/// Returns lines without the empty ones at their end.
pub(super) fn up_to_the_last(mut lines: Vec<String>) -> Vec<String> {
    lines.truncate(lines.iter().rposition(|line| !line.is_empty()).map_or(0, |last| last + 1));
    lines
}

/// Returns a file's symmetry, or 1 and a warning.
pub(super) fn symmetry(given: i32, at: &str, warnings: &mut WarningList) -> u32 {
    match u32::try_from(given) {
        Ok(symmetry @ 1..) => symmetry,
        _ => {
            warnings.warn(|| format!("{at}symmetry: {given} must be 1 or more; 1 is assumed"));
            1
        }
    }
}

/// Returns a file's refractive index as a material, or the usual index and a warning.
pub(super) fn material(index: f64, at: &str, warnings: &mut WarningList) -> MaterialRef {
    let material = MaterialRef::Index(index);
    match material.check() {
        Ok(()) => material,
        Err(fault) => {
            warnings.warn(|| format!("{at}{fault}; {USUAL_INDEX} is assumed"));
            MaterialRef::Index(USUAL_INDEX)
        }
    }
}

/// Returns the design that was read from a file, or an error if the design's check refuses it.
pub(super) fn brought(
    name: String,
    material: MaterialRef,
    tiers: Tiers,
    warnings: WarningList,
) -> Result<ImportedDesign, Fault> {
    let diameter_mm = DEFAULT_DIAMETER_MM;
    let cut = Cut::Tiers(tiers);
    let design = Design { name, source: None, notes: None, material, diameter_mm, cut };
    design.check().map_err(Fault::whole)?;
    Ok(ImportedDesign { warnings: warnings.texts(), ..ImportedDesign::of(design) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_gives_back_the_setting_it_was_cut_at() {
        for (teeth, offset) in [(96, 0.0), (-96, 48.0), (80, 40.0), (-99, 49.5), (77, 0.25)] {
            let gear = Gear { teeth, offset };
            for (angle, index) in [(-41.5, 93.0), (34.0, 96.0), (-90.0, 3.0), (90.0, 12.5), (1.234567, 7.0)] {
                let index: f64 = index;
                let index = if index > f64::from(teeth.abs()) { index - 24.0 } else { index };
                let index = if index > f64::from(teeth.abs()) { 1.0 } else { index };
                let facets = vec![Indexed { index, name: String::new() }];
                let tier = Tier {
                    angle,
                    distance: 0.7,
                    instructions: String::new(),
                    meet: None,
                    is_cut: true,
                    frosting: 0.0,
                    facets,
                };
                let plane = gear.tiers().plane(&tier, index);
                assert_eq!(
                    gear.setting(plane.normal, plane.offset),
                    FacetSetting { angle, distance: 0.7, index }
                );
            }
        }
    }

    #[test]
    fn a_flat_lies_at_the_last_tooth_and_its_sign_tells_which() {
        let gear = Gear { teeth: -96, offset: 48.0 };
        let table = gear.setting(DVec3::new(1e-16, -3e-15, 1.0), 0.4);
        assert_eq!(table, FacetSetting { angle: 0.0, distance: 0.4, index: 96.0 });
        assert!(gear.setting(DVec3::NEG_Z, 0.4).angle.is_sign_negative());
    }

    #[test]
    fn facets_that_differ_are_tiers_of_their_own() {
        let piece = |tier, angle, distance, instructions: &str| TierPiece {
            tier,
            setting: FacetSetting { angle, distance, index: 3.0 },
            name: "A".to_owned(),
            instructions: instructions.to_owned(),
            is_cut: true,
            frosting: 0.0,
        };
        let pieces = [
            piece(1, 41.0, 1.0, ""),
            piece(1, 41.0 + 1e-10, 1.0 - 1e-10, "meet"),
            piece(1, 41.0, 1.0 - 1e-8, "meet"),
            piece(1, 41.0, 1.0 - 1e-8, "level"),
            piece(2, 41.0, 1.0 - 1e-8, "level"),
            piece(2, -41.0, 1.0 - 1e-8, ""),
        ];
        let tiers = gathered(pieces);
        let counts: Vec<usize> = tiers.iter().map(|tier| tier.facets.len()).collect();
        assert_eq!(counts, [2, 1, 1, 1, 1]);
        assert_eq!(tiers[0].instructions, "meet");
    }

    #[test]
    fn a_design_is_called_by_its_first_printable_line_or_its_file() {
        let lines = ["", " \u{7}", " Étoile "].map(str::to_owned);
        assert_eq!(title(&lines, "a/b.gem"), "Étoile");
        assert_eq!(title(&[], "a/b.gem"), "b");
        assert_eq!(title(&[], ""), "design");
    }

    #[test]
    fn warnings_have_an_end() {
        let mut warnings = WarningList::default();
        (0..1000).for_each(|k| warnings.warn(|| format!("{k}")));
        let texts = warnings.texts();
        assert_eq!(texts.len(), MOST_WARNINGS + 1);
        assert_eq!(texts[MOST_WARNINGS], "900 more warnings of this kind are left out");
    }
}
