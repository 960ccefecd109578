//! The ring of index numbers around a plan: a tick for every tooth of the gear, and the numbers of the teeth at which
//! the facets in sight are cut, as far as they have room; the quarters of the gear always have a number.

use super::super::drawing::{Align, Frame, Ink, Sheet, Type, overlap, text_frame, text_width};
use super::blocks::index_text;
use brillianteer_cut::Tiers;
use glam::DVec2;

/// Distance from the circle that holds the stone to the ring.
const GAP: f64 = 7.0;
/// Length of the tick of a tooth.
const TICK: f64 = 4.0;
/// Length of the tick of a tooth with a number.
const LONG_TICK: f64 = 9.0;
/// Distance from that circle to the nearest edge of a number.
const NUMBERS: f64 = GAP + LONG_TICK + 3.0;
/// Size of the numbers.
const SIZE: f64 = 14.0;
/// Space between two numbers.
const APART: f64 = 2.5;
/// The most ticks around; of a gear with more teeth, only every second, third, ... has one.
const MOST_TICKS: u32 = 144;
/// The most numbers that are tried.
const MOST_NUMBERS: usize = 1000;
/// Distance from the circle that holds the stone to the outer edge of the numbers.
pub(super) const OUTER: f64 = NUMBERS + 19.0;
/// Distance from the circle that holds the stone to the ends of leaders.
pub(super) const LEADERS: f64 = OUTER + 8.0;

/// A ring around one plan.
pub(super) struct IndexRing<'a> {
    /// The gear.
    pub tiers: &'a Tiers,
    /// The middle of the plan on the sheet.
    pub middle: DVec2,
    /// The radius of the circle that holds the stone.
    pub radius: f64,
    /// The least and the greatest x that a number may reach.
    pub sides: [f64; 2],
    /// True where the plan shows the stone from below, turned over about its y axis.
    pub from_below: bool,
}

impl IndexRing<'_> {
    /// Returns the direction on the sheet in which facets at an index face.
    fn toward(&self, index: f64) -> DVec2 {
        let turn = (index - self.tiers.offset) / f64::from(self.tiers.gear) * std::f64::consts::TAU;
        let (sin, cos) = turn.sin_cos();
        // Without an offset, index 0 lies at -y, which is the bottom of both plans.
        DVec2::new(if self.from_below { -sin } else { sin }, cos)
    }

    /// Draws the ring. Returns the boxes of its numbers. `used` are the indices of the facets in sight, above 0.
    pub fn draw(&self, sheet: &mut Sheet, used: &[f64]) -> Vec<Frame> {
        let teeth = self.tiers.gear.unsigned_abs();
        let step = teeth.div_ceil(MOST_TICKS).max(1);
        let tick = |index: f64, length: f64| {
            let toward = self.toward(index);
            let at = |r: f64| self.middle + toward * (self.radius + r);
            (at(GAP), at(GAP + length))
        };
        let ticks: Vec<_> = (0..teeth).step_by(step as usize).map(|k| tick(f64::from(k), TICK)).collect();
        sheet.quiet_lines(&ticks, "index", 0.6);
        let (numbers, long): (Vec<_>, Vec<_>) =
            self.numbers(used).into_iter().map(|number| (number, tick(number.0, LONG_TICK))).unzip();
        sheet.quiet_lines(&long, "index", 1.1);
        let written = numbers.into_iter().map(|(index, at, is_used)| {
            let colour = if is_used { Ink::Main } else { Ink::Quiet };
            let text = index_text(index);
            sheet.plain_text(Type { size: SIZE, colour }, Align::Middle, at, &text);
            text_frame(SIZE, Align::Middle, at, &text)
        });
        written.collect()
    }

    /// Returns the numbers that have room: index, place, and whether a facet in sight is cut there.
    fn numbers(&self, used: &[f64]) -> Vec<(f64, DVec2, bool)> {
        let teeth = f64::from(self.tiers.gear.unsigned_abs());
        let quarters = [4.0, 1.0, 2.0, 3.0].map(|k| teeth * k / 4.0);
        let quarters = quarters.into_iter().filter(|index| index.fract() == 0.0);
        let is_used = |index: f64| used.iter().any(|other| (other - index).abs() < 1e-6);
        let all = quarters.chain(used.iter().copied().take(MOST_NUMBERS));
        let mut placed: Vec<(f64, DVec2, bool)> = vec![];
        let mut frames: Vec<Frame> = vec![];
        for index in all {
            let at = self.number_at(index);
            let mut frame = text_frame(SIZE, Align::Middle, at, &index_text(index));
            (frame.low.x, frame.high.x) = (frame.low.x - APART, frame.high.x + APART);
            let is_inside = frame.low.x >= self.sides[0] && frame.high.x <= self.sides[1];
            if is_inside && !frames.iter().any(|other| overlap(other, &frame)) {
                frames.push(frame);
                placed.push((index, at, is_used(index)));
            }
        }
        placed
    }

    /// Returns the place of an index's number; the box of the text decides its distance from the ring.
    fn number_at(&self, index: f64) -> DVec2 {
        let half = DVec2::new(text_width(&index_text(index), SIZE), 0.8 * SIZE) / 2.0;
        let toward = self.toward(index);
        self.middle + toward * (self.radius + NUMBERS + half.dot(toward.abs()))
    }
}
