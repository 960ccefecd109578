//! The drawings of a cutter's sheet: the two plans with their rings of index numbers, and the profiles of end and side.

use super::super::drawing::{Align, DrawnAspect, Frame, Ink, LeaderRoom, Sheet, Type, text_width};
use super::cutting_sheet::CuttingSheet;
use super::index_ring::{IndexRing, LEADERS, OUTER};
use super::naming::{Places, SeenTier, write_names};
use brillianteer_cut::TierZone;
use brillianteer_math::{Basis, Facet, span};
use brillianteer_scene::Stone;
use glam::{DVec2, DVec3};

/// Type of the captions of plans and profiles.
const CAPTION: Type = Type { size: 15.0, colour: Ink::Main };
/// Type of the letters at dimension lines.
const LETTER: Type = Type { size: 15.0, colour: Ink::Main };
/// Distance from a profile to its dimension line.
const DIMENSION_BELOW: f64 = 20.0;
/// Height of the caption above a drawing.
const CAPTION_HEIGHT: f64 = 24.0;
/// Distance from a profile to the ends of leaders.
const PROFILE_LEADERS: f64 = 20.0;

/// A plan or profile, and the box of the sheet that it must not leave.
pub(super) struct SheetView<'a> {
    pub data: &'a CuttingSheet,
    pub stone: &'a Stone,
    pub bounds: Frame,
}

/// Returns half the height that a plan of this radius takes below its caption.
pub(super) fn plan_half_height(radius: f64) -> f64 {
    radius + OUTER + 6.0
}

/// Returns the radius of the circle about the middle of the stone's extents that holds it, in girdle radii.
fn bounding_radius(stone: &Stone) -> f64 {
    let (low, high) = stone.polytope.bounds();
    let middle = ((low + high) / 2.0).truncate();
    stone.polytope.vertices().iter().map(|v| v.truncate().distance(middle)).fold(0.0, f64::max)
}

impl SheetView<'_> {
    /// Draws the plan from above or below, at the bottom of its box.
    pub fn plan(&self, sheet: &mut Sheet, basis: Basis, radius: f64) {
        let from_below = basis == Basis::FACE_DOWN;
        let (low, high) = self.stone.polytope.bounds();
        let place = DVec2::new(
            (self.bounds.low.x + self.bounds.high.x) / 2.0,
            self.bounds.low.y + CAPTION_HEIGHT + plan_half_height(radius),
        );
        let centre = basis.project((low + high) / 2.0);
        let aspect = DrawnAspect { basis, centre, scale: radius / bounding_radius(self.stone), place };
        sheet.stone(self.stone, &aspect, |facet| aspect.shows(facet));
        let sides = [self.bounds.low.x, self.bounds.high.x];
        let ring = IndexRing { tiers: &self.data.tiers, middle: place, radius, sides, from_below };
        let mut taken = ring.draw(sheet, &self.used(from_below));
        taken
            .push(self.caption(sheet, if from_below { "PAVILION, from below" } else { "CROWN, from above" }));
        let slot = |k: i32| place + DVec2::from_angle(f64::from(4 * k).to_radians()) * (radius + LEADERS);
        let slots = (0..90).map(slot).collect();
        let led = |zone: TierZone| zone != TierZone::Girdle;
        self.names(sheet, &aspect, (taken, slots), led);
    }

    /// Draws a profile, its table up, at a scale in units per girdle radius; `letter` stands at the dimension line below.
    pub fn profile(&self, sheet: &mut Sheet, basis: Basis, scale: f64, (caption, letter): (&str, &str)) {
        let (low, high) = self.stone.polytope.bounds();
        let vertices = self.stone.polytope.vertices().iter();
        let (left, right) = span(vertices.map(|v| v.dot(basis.right)));
        let half = DVec2::new(right - left, high.z - low.z) / 2.0 * scale;
        let top = self.bounds.low.y + CAPTION_HEIGHT + 8.0;
        let place = DVec2::new((self.bounds.low.x + self.bounds.high.x) / 2.0, top + half.y);
        let centre = DVec2::new((left + right) / 2.0, (low.z + high.z) / 2.0);
        let aspect = DrawnAspect { basis, centre, scale, place };
        sheet.stone(self.stone, &aspect, |facet| aspect.shows(facet));
        let below = place + DVec2::Y * (half.y + DIMENSION_BELOW);
        let taken = vec![self.caption(sheet, caption), self.dimension(sheet, below, half.x, letter)];
        let reach = half.x + PROFILE_LEADERS;
        let count = (2.0 * half.y / 18.0).max(1.0) as usize;
        let height = |k: usize| place.y - half.y + (k as f64 + 0.5) * 2.0 * half.y / count as f64;
        let side = |x: f64| (0..count).map(move |k| DVec2::new(place.x + x, height(k)));
        // Facets of crown and pavilion are named in the plans, where those of the girdle are not in sight.
        let slots = side(reach).chain(side(-reach)).collect();
        self.names(sheet, &aspect, (taken, slots), |zone| zone == TierZone::Girdle);
    }

    fn caption(&self, sheet: &mut Sheet, text: &str) -> Frame {
        let middle = (self.bounds.low.x + self.bounds.high.x) / 2.0;
        sheet.strong_text(CAPTION, Align::Middle, DVec2::new(middle, self.bounds.low.y + 10.0), text)
    }

    /// Draws a dimension line with a letter in its middle. Returns the box that it fills.
    fn dimension(&self, sheet: &mut Sheet, at: DVec2, half: f64, letter: &str) -> Frame {
        let gap = text_width(letter, LETTER.size) / 2.0 + 5.0;
        for side in [DVec2::NEG_X, DVec2::X] {
            sheet.stroke(at + side * gap.min(half), at + side * half);
            sheet.arrow_head(at + side * half, side);
        }
        sheet.plain_text(LETTER, Align::Middle, at, letter);
        Frame { low: at - DVec2::new(half, 9.0), high: at + DVec2::new(half, 9.0) }
    }

    /// Returns the indices of the tiers that a plan shows, in the order in which they are cut.
    fn used(&self, from_below: bool) -> Vec<f64> {
        let rows = self.data.blocks.iter().flat_map(|block| &block.tiers);
        let shown = rows.filter(|row| match row.zone {
            TierZone::Pavilion => from_below,
            TierZone::Crown => !from_below,
            TierZone::Table | TierZone::Girdle | TierZone::Culet => false,
        });
        shown.flat_map(|row| row.indices.iter().copied()).collect()
    }

    /// Writes the names of the tiers; those of the zones for which `led` holds may stand outside, at the end of a leader.
    fn names(
        &self,
        sheet: &mut Sheet,
        aspect: &DrawnAspect,
        (taken, slots): (Vec<Frame>, Vec<DVec2>),
        led: impl Fn(TierZone) -> bool,
    ) {
        let facets = self.stone.polytope.facets();
        let outline = |facet: &Facet| aspect.outline(self.stone, facet);
        let shown = || facets.iter().zip(&self.data.tier_of_facet).filter(|(facet, _)| aspect.shows(facet));
        let corners = shown().flat_map(|(facet, _)| outline(facet)).collect();
        let rows = self.data.blocks.iter().flat_map(|block| &block.tiers);
        let seen = |row: &super::SheetRow| SeenTier {
            name: row.name.clone(),
            is_led: led(row.zone),
            outlines: shown().filter(|(_, tier)| **tier == Some(row.tier)).map(|(f, _)| outline(f)).collect(),
        };
        let tiers: Vec<SeenTier> = rows.map(seen).collect();
        let room = LeaderRoom { middle: aspect.place, taken, leaders: vec![], corners };
        write_names(sheet, Places { room, slots, bounds: self.bounds }, &tiers);
    }
}

/// Returns the profiles of a stone, as views along the axes of its design: the end, across whose width one looks along the
/// length, and the side.
pub(super) fn profiles(stone: &Stone) -> [Basis; 2] {
    let (low, high) = stone.polytope.bounds();
    let extent = high - low;
    let along = |right: DVec3| Basis { right, up: DVec3::Z, toward: right.cross(DVec3::Z) };
    if extent.x <= extent.y { [along(DVec3::X), along(DVec3::Y)] } else { [along(DVec3::Y), along(DVec3::X)] }
}

/// Returns the scale, in units per girdle radius, at which either profile fits into `room`. Captions, dimension lines and leaders
/// stand outside of it.
pub(super) fn profile_scale(stone: &Stone, room: DVec2) -> f64 {
    let (low, high) = stone.polytope.bounds();
    let extent = high - low;
    (room.x / extent.truncate().max_element()).min(room.y / extent.z)
}
