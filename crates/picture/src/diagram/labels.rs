//! Places the labels of a view's tiers: inside a facet where there is room, otherwise outside, with a leader (a line) to
//! a facet.

use super::super::drawing::{
    Align, Frame, LeaderRoom, Sheet, Type, degrees, room_for, text_frame, text_width,
};
use super::{INDEX, NAME, SLOPE, Tier, View};
use brillianteer_math::centroid;
use brillianteer_scene::Stone;
use glam::DVec2;

/// Places whose merits differ by less than this count as equally good, as mirror images do up to rounding; the first one
/// stays.
const EVEN: f64 = 1e-6;

/// Angles at which leaders end, in degrees from the x axis in each quarter of a view.
const SLOTS: [f64; 3] = [74.0, 56.0, 40.0];
/// The most tiers without room for their labels for which leaders may be long: a few long leaders are still easy to read.
const FEW: usize = 6;
/// The length by which a leader may exceed one from the view's middle while there are few, in units of the drawing.
const MORE_OF_FEW: f64 = 4.0;
/// The greatest length of a leader where there are many, in units of the drawing.
const LONGEST_OF_MANY: f64 = 120.0;
/// The most tiers left for which leaders are drawn. With more, the few leaders that find room would not help the
/// reader.
const MOST_LED: usize = 200;
/// Gap between a leader's end and its label.
const BESIDE: f64 = 5.0;

/// Distance from one line of a label to the next.
const LINE: f64 = 15.0;
/// Height of a label's figures.
const FIGURES: f64 = 11.0;
/// Space kept clear between a label and the edges of its facet.
const CLEARANCE: f64 = 2.5;

/// A text of a label; its offset is from the label's middle.
struct Piece {
    kind: Type,
    align: Align,
    offset: DVec2,
    text: String,
}

/// A tier's label, or a short form of it.
struct Label {
    pieces: Vec<Piece>,
    size: DVec2,
    /// True where the label is turned by a right angle, to be read from the right.
    upright: bool,
}

impl Label {
    /// Returns a label with the name above the slope, both aligned the same way at the label's place.
    fn stacked(tier: &Tier, align: Align) -> Self {
        let rows = [(NAME, tier.name.clone(), -LINE / 2.0), (SLOPE, degrees(tier.slope_degrees), LINE / 2.0)];
        let width = rows.iter().map(|(kind, text, _)| text_width(text, kind.size)).fold(0.0, f64::max);
        let piece = |(kind, text, y): (Type, String, f64)| Piece { kind, align, offset: DVec2::Y * y, text };
        let size = DVec2::new(width, LINE + FIGURES);
        Self { pieces: rows.map(piece).into(), size, upright: false }
    }

    /// Returns a label with name and slope in one line, from left to right or upward.
    fn in_line(tier: &Tier, upright: bool) -> Self {
        let (name, slope) = (format!("{} ", tier.name), degrees(tier.slope_degrees));
        let width = text_width(&name, NAME.size) + text_width(&slope, SLOPE.size);
        let along = if upright { DVec2::NEG_Y } else { DVec2::X } * width / 2.0;
        let pieces = vec![
            Piece { kind: NAME, align: Align::Start, offset: -along, text: name },
            Piece { kind: SLOPE, align: Align::End, offset: along, text: slope },
        ];
        let size = if upright { DVec2::new(FIGURES, width) } else { DVec2::new(width, FIGURES) };
        Self { pieces, size, upright }
    }

    fn short(kind: Type, text: String, upright: bool) -> Self {
        let width = text_width(&text, kind.size);
        let size = if upright { DVec2::new(FIGURES, width) } else { DVec2::new(width, FIGURES) };
        Self { pieces: vec![Piece { kind, align: Align::Middle, offset: DVec2::ZERO, text }], size, upright }
    }

    /// Returns the box that the label fills around this middle.
    fn frame(&self, middle: DVec2) -> Frame {
        Frame { low: middle - self.size / 2.0, high: middle + self.size / 2.0 }
    }

    fn write(&self, sheet: &mut Sheet, at: DVec2) {
        for Piece { kind, align, offset, text } in &self.pieces {
            if self.upright {
                sheet.upright_text(*kind, *align, at + *offset, text);
            } else {
                sheet.plain_text(*kind, *align, at + *offset, text);
            }
        }
    }
}

/// The places in a view that are still free for labels.
pub(super) struct Labels<'a> {
    view: &'a View,
    stone: &'a Stone,
    /// Ends of leaders that are not yet taken.
    slots: Vec<DVec2>,
    /// The lines and boxes that leaders keep clear of: the index's numbers, labels and other leaders.
    room: LeaderRoom,
}

/// A line from a facet to a place for its label, with its cost: the lower, the better.
#[derive(Clone, Copy)]
struct Leader {
    cost: f64,
    from: DVec2,
    slot: usize,
}

impl<'a> Labels<'a> {
    pub fn new(view: &'a View, stone: &'a Stone) -> Self {
        let quarters = |a: f64| [a, 180.0 - a, 180.0 + a, -a];
        let slots =
            SLOTS.into_iter().flat_map(quarters).map(|a| view.polar(view.style.leaders(), a)).collect();
        let numbers = view.index().into_iter();
        let taken = numbers.map(|(at, text)| text_frame(INDEX.size, Align::Middle, at, &text)).collect();
        let shown = stone.polytope.facets().iter().filter(|facet| view.aspect.shows(facet));
        let corners = shown.flat_map(|facet| view.aspect.outline(stone, facet)).collect();
        let room = LeaderRoom { middle: view.aspect.place, taken, leaders: vec![], corners };
        Self { view, stone, slots, room }
    }

    /// Labels every tier. The label goes inside a facet that is large enough; otherwise outside, with a leader that
    /// crosses nothing; otherwise inside in a shorter form, the name or the number in the list. Slivers appear in the
    /// list alone.
    pub fn write(mut self, sheet: &mut Sheet, tiers: &[&Tier]) {
        let mut rest: Vec<&Tier> = tiers.to_vec();
        rest.retain(|tier| {
            let labels = [
                Label::stacked(tier, Align::Middle),
                Label::in_line(tier, false),
                Label::in_line(tier, true),
            ];
            !labels.iter().any(|label| self.inside(sheet, tier, label))
        });
        // The leader of least cost is drawn first, whichever tier it belongs to.
        let longest =
            if rest.len() <= FEW { self.view.style.leaders() + MORE_OF_FEW } else { LONGEST_OF_MANY };
        while rest.len() <= MOST_LED
            && let Some((leader, k)) = self.best_leader(&rest, longest)
        {
            self.outside(sheet, rest.remove(k), leader);
        }
        for tier in rest {
            let name = |upright| Label::short(NAME, tier.name.clone(), upright);
            let labels = [name(false), name(true), Label::short(INDEX, tier.number.to_string(), false)];
            labels.iter().any(|label| self.inside(sheet, tier, label));
        }
    }

    fn outlines(&self, tier: &Tier) -> impl Iterator<Item = Vec<DVec2>> {
        let facets = self.stone.polytope.facets();
        tier.facets.iter().map(|&id| self.view.aspect.outline(self.stone, &facets[id as usize]))
    }

    /// Writes a label into the tier's facet that has the most room for it. Returns whether one has room.
    fn inside(&mut self, sheet: &mut Sheet, tier: &Tier, label: &Label) -> bool {
        let rooms = self.outlines(tier).filter_map(|corners| room_for(&corners, label.size, CLEARANCE));
        let Some((_, middle)) = rooms.reduce(|a, b| if b.0 > a.0 * (1.0 + EVEN) { b } else { a }) else {
            return false;
        };
        self.room.taken.push(label.frame(middle));
        label.write(sheet, middle);
        true
    }

    /// Returns the leader of least cost, and the place of its tier in `tiers`.
    fn best_leader(&self, tiers: &[&Tier], longest: f64) -> Option<(Leader, usize)> {
        let mut best: Option<(Leader, usize)> = None;
        for (k, tier) in tiers.iter().enumerate() {
            let size = Label::stacked(tier, Align::Start).size;
            for from in self.outlines(tier).map(|corners| centroid(&corners)) {
                for (slot, &to) in self.slots.iter().enumerate() {
                    let Some(cost) = self.cost(from, to, size).filter(|_| from.distance(to) <= longest)
                    else {
                        continue;
                    };
                    if best.is_none_or(|(leader, _)| cost < leader.cost - EVEN) {
                        best = Some((Leader { cost, from, slot }, k));
                    }
                }
            }
        }
        best
    }

    /// Returns the cost of a leader, or `None` where it crosses something or its label, of this size, has no room.
    fn cost(&self, from: DVec2, to: DVec2, size: DVec2) -> Option<f64> {
        if size.x > self.view.style.half_room() - (to.x - self.view.aspect.place.x).abs() - BESIDE {
            return None;
        }
        self.room.cost(from, to, &self.frame_beside(to, size))
    }

    /// Returns the side of the view on which a place lies: -1 for left, 1 for right.
    fn side(&self, to: DVec2) -> f64 {
        (to.x - self.view.aspect.place.x).signum()
    }

    /// Returns the box of a label of this size at the end of a leader.
    fn frame_beside(&self, to: DVec2, size: DVec2) -> Frame {
        let middle = to + DVec2::X * self.side(to) * (BESIDE + size.x / 2.0);
        Frame { low: middle - size / 2.0, high: middle + size / 2.0 }
    }

    fn outside(&mut self, sheet: &mut Sheet, tier: &Tier, leader: Leader) {
        let to = self.slots.remove(leader.slot);
        sheet.stroke(leader.from, to);
        sheet.dot(leader.from);
        self.room.leaders.push((leader.from, to));
        let side = self.side(to);
        let label = Label::stacked(tier, if side > 0.0 { Align::Start } else { Align::End });
        self.room.taken.push(self.frame_beside(to, label.size));
        label.write(sheet, to + DVec2::X * BESIDE * side);
    }
}
