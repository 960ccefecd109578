//! Places the names of tiers in a view: in every facet that has room at the largest type that one of the tier's facets
//! takes, otherwise outside with a leader to one facet. A tier for which neither has room is named by the list alone.

use super::super::drawing::{Align, Frame, Ink, LeaderRoom, Sheet, Type, room_for, text_frame, text_width};
use brillianteer_math::centroid;
use glam::DVec2;

/// The sizes of names in facets, from the largest; the last is 5 points in print.
const SIZES: [f64; 5] = [17.0, 15.0, 13.0, 11.5, 10.0];
/// Size of names outside.
const OUTSIDE: f64 = 14.0;
/// Height of a name's letters, in type sizes.
const LETTERS: f64 = 0.86;
/// Space kept around a name in a facet, in type sizes.
const CLEARANCE: f64 = 0.14;
/// Gap between a leader's end and its name.
const BESIDE: f64 = 4.0;
/// Leaders whose costs differ by less than this are equally good, as mirror images are; the first one stays.
const EVEN: f64 = 1e-6;
/// The most tiers left for which leaders are drawn.
const MOST_LED: usize = 40;
/// The most tiers without room for their names for which leaders may have any length: of all, or of those for which
/// shorter leaders find no room.
const FEW: usize = 5;
/// The greatest length of a leader where there are many.
const LONGEST_OF_MANY: f64 = 110.0;
/// The most facets of a tier that are tried for a leader.
const MOST_TRIED: usize = 64;

/// A tier in a view.
pub(super) struct SeenTier {
    /// The tier's name.
    pub name: String,
    /// True where its name may stand outside, at the end of a leader.
    pub is_led: bool,
    /// The outlines of its facets in sight, on the sheet.
    pub outlines: Vec<Vec<DVec2>>,
}

/// The places for names.
pub(super) struct Places {
    /// The lines and boxes that leaders keep clear of.
    pub room: LeaderRoom,
    /// The ends that leaders may have.
    pub slots: Vec<DVec2>,
    /// The box that no name leaves.
    pub bounds: Frame,
}

/// Writes the names of all tiers for which there is room.
pub(super) fn write_names(sheet: &mut Sheet, mut places: Places, tiers: &[SeenTier]) {
    let mut rest: Vec<&SeenTier> = vec![];
    for tier in tiers.iter().filter(|tier| !tier.outlines.is_empty()) {
        if !write_inside(sheet, &mut places, tier) && tier.is_led {
            rest.push(tier);
        }
    }
    rest.truncate(MOST_LED);
    // A few long leaders are easy to read, many are not.
    let mut longest = if rest.len() <= FEW { f64::INFINITY } else { LONGEST_OF_MANY };
    loop {
        while let Some((leader, k)) = best_leader(&places, &rest, longest) {
            write_outside(sheet, &mut places, rest.remove(k), leader);
        }
        if longest.is_infinite() || rest.len() > FEW {
            return;
        }
        longest = f64::INFINITY;
    }
}

/// Writes a name into every facet of the tier with room for it. Returns whether there is one.
fn write_inside(sheet: &mut Sheet, places: &mut Places, tier: &SeenTier) -> bool {
    for (size, upright) in SIZES.into_iter().flat_map(|size| [(size, false), (size, true)]) {
        let level = DVec2::new(text_width(&tier.name, size), LETTERS * size);
        let extent = if upright { DVec2::new(level.y, level.x) } else { level };
        let middle = |corners: &Vec<DVec2>| room_for(corners, extent, CLEARANCE * size);
        let middles: Vec<DVec2> = tier.outlines.iter().filter_map(middle).map(|(_, middle)| middle).collect();
        let kind = Type { size, colour: Ink::Main };
        for &at in &middles {
            if upright {
                sheet.upright_text(kind, Align::Middle, at, &tier.name)
            } else {
                sheet.plain_text(kind, Align::Middle, at, &tier.name)
            }
            let half = extent / 2.0;
            places.room.taken.push(Frame { low: at - half, high: at + half });
        }
        if !middles.is_empty() {
            return true;
        }
    }
    false
}

/// A line from a facet to a place for its name, with its cost.
#[derive(Clone, Copy)]
struct NameLeader {
    cost: f64,
    from: DVec2,
    slot: usize,
}

/// Returns the leader of least cost, and the place of its tier in `tiers`.
fn best_leader(places: &Places, tiers: &[&SeenTier], longest: f64) -> Option<(NameLeader, usize)> {
    let mut best: Option<(NameLeader, usize)> = None;
    for (k, tier) in tiers.iter().enumerate() {
        for from in tier.outlines.iter().take(MOST_TRIED).map(|corners| centroid(corners)) {
            for (slot, &to) in places.slots.iter().enumerate() {
                // No leader costs less than its length.
                let least = best.map_or(longest, |(leader, _)| longest.min(leader.cost));
                if from.distance(to) > least {
                    continue;
                }
                let label = places.frame(&tier.name, to);
                let Some(cost) = places.room.cost(from, to, &label).filter(|_| places.holds(&label)) else {
                    continue;
                };
                if best.is_none_or(|(leader, _)| cost < leader.cost - EVEN) {
                    best = Some((NameLeader { cost, from, slot }, k));
                }
            }
        }
    }
    best
}

fn write_outside(sheet: &mut Sheet, places: &mut Places, tier: &SeenTier, leader: NameLeader) {
    let to = places.slots.remove(leader.slot);
    sheet.stroke(leader.from, to);
    sheet.dot(leader.from);
    places.room.leaders.push((leader.from, to));
    places.room.taken.push(places.frame(&tier.name, to));
    let (align, at) = places.beside(to);
    sheet.plain_text(Type { size: OUTSIDE, colour: Ink::Main }, align, at, &tier.name);
}

impl Places {
    /// Returns the alignment of a name at the end of a leader, and the place where it begins or ends.
    fn beside(&self, to: DVec2) -> (Align, DVec2) {
        if to.x < self.room.middle.x {
            (Align::End, to - DVec2::X * BESIDE)
        } else {
            (Align::Start, to + DVec2::X * BESIDE)
        }
    }

    /// Returns the box that a name at the end of a leader fills.
    fn frame(&self, name: &str, to: DVec2) -> Frame {
        let (align, at) = self.beside(to);
        text_frame(OUTSIDE, align, at, name)
    }

    fn holds(&self, label: &Frame) -> bool {
        label.low.cmpge(self.bounds.low).all() && label.high.cmple(self.bounds.high).all()
    }
}
