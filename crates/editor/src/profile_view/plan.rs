//! Decides which dimensions a profile of a given size shows, and where.

use super::sheet::{About, BESIDE, GAP, Label, ProfileSheet, SheetLine, Weight};
use super::sight::ProfileProjection;
use brillianteer_cut::{Cut, ProfileHandle};
use brillianteer_picture::profile::{
    Dimensions, Span,
    brilliant::{lower_half_ends, star_ends},
    percent, spread,
};
use egui::epaint::MarginF32;
use egui::{Align2, Pos2, Rect, Vec2, pos2, vec2};
use glam::DVec2;

/// Distance from the stone to the first dimension line, and from one to the next, in points.
const LEVEL: f32 = 22.0;
/// Space between the drawing and the edge of its rectangle, in points.
const EDGE: f32 = 6.0;
/// The longest text of a height. Room is kept for it, so that nothing moves when digits come and go.
const LONGEST: &str = "pavilion 88.88 %";
/// Largest radius of an angle's arc, in points, and as a part of the facet's line.
const ARC: f32 = 52.0;
const ARC_PART: f32 = 0.5;
/// Number of straight pieces in which an arc is drawn.
const ARC_STEPS: u32 = 24;

/// The labels that the drawing has room for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum LabelDetail {
    None,
    /// Table, total depth and angles, without their names.
    Numbers,
    /// The numbers, all heights and the culet, with their names.
    Named,
    /// The numbers of `Named`, and star and lower half.
    Whole,
}

impl LabelDetail {
    /// Returns the detail that can be read in a rectangle of this size, in points.
    pub fn of(size: Vec2) -> Self {
        match size.x.min(1.25 * size.y) {
            ..160.0 => Self::None,
            160.0..260.0 => Self::Numbers,
            260.0..380.0 => Self::Named,
            _ => Self::Whole,
        }
    }

    /// Returns the white space that dimensions of this detail need. `measure` returns the size of a text, in points.
    pub fn margins(self, measure: &dyn Fn(&str) -> Vec2) -> MarginF32 {
        let text = measure(LONGEST);
        let across = |levels: f32| EDGE + levels * LEVEL + text.y / 2.0;
        match self {
            Self::None => MarginF32::same(EDGE),
            Self::Numbers => {
                MarginF32 { left: across(1.0), right: 2.0 * EDGE, top: across(1.0), bottom: 2.0 * EDGE }
            }
            Self::Named | Self::Whole => {
                let levels = if self == Self::Whole { 2.0 } else { 1.0 };
                let right = EDGE + LEVEL + BESIDE + text.x;
                MarginF32 { left: across(1.0), right, top: across(levels), bottom: across(levels) }
            }
        }
    }
}

/// The values of a stone that are written on the drawing.
#[derive(Debug, Clone, Copy)]
pub struct ProfileSubject<'a> {
    /// The dimensions that every stone has.
    pub dimensions: &'a Dimensions,
    /// The cut, where it is one of possible proportions.
    pub cut: Option<&'a Cut>,
}

/// Lays out the dimensions of a drawing on a sheet.
pub struct Planner<'a, 'b> {
    subject: ProfileSubject<'a>,
    sight: &'a ProfileProjection,
    detail: LabelDetail,
    sheet: ProfileSheet<'b>,
}

impl<'a, 'b> Planner<'a, 'b> {
    /// Lays out the dimensions for which there is room, the most important first, and returns their lines and numbers.
    pub fn plan(
        subject: ProfileSubject<'a>,
        sight: &'a ProfileProjection,
        detail: LabelDetail,
        sheet: ProfileSheet<'b>,
    ) -> (Vec<SheetLine>, Vec<Label>) {
        let mut planner = Self { subject, sight, detail, sheet };
        if detail > LabelDetail::None {
            planner.table();
            planner.total();
            planner.angles();
        }
        if detail > LabelDetail::Numbers {
            planner.heights();
            planner.culet();
        }
        if detail == LabelDetail::Whole {
            planner.star_and_lower_half();
        }
        planner.sheet.finish()
    }

    fn at(&self, x: f64, z: f64) -> Pos2 {
        self.sight.at(DVec2::new(x, z))
    }

    /// Returns the proportion that a part of the profile changes.
    fn row(&self, part: ProfileHandle) -> About {
        self.subject.cut?.handled_by(part)
    }

    fn named(&self, name: &str, value: f64) -> String {
        let value = percent(value);
        if self.detail == LabelDetail::Numbers { value } else { format!("{name} {value}") }
    }

    /// Returns the screen height of a dimension line: `level` counts lines above the stone or, negative, below it.
    fn level(&self, level: f32) -> f32 {
        let Span { from, to, .. } = self.subject.dimensions.total;
        self.at(0.0, if level > 0.0 { from } else { to }).y - level * LEVEL
    }

    fn table(&mut self) {
        let Some(table) = self.subject.dimensions.table else { return };
        let ends = [table.from, table.to].map(|x| self.at(x, self.subject.dimensions.total.from));
        // The dimension of the star stands below that of the table.
        let has_star = self.subject.cut.is_some_and(|cut| cut.brilliant().is_some());
        let level = if self.detail == LabelDetail::Whole && has_star { 2.0 } else { 1.0 };
        let about = self.row(ProfileHandle::TableEdge);
        self.sheet.across(self.level(level), ends, &self.named("table", table.percent), about);
    }

    /// Adds the total depth on the left. Its number stands in the line and is read from the right.
    fn total(&mut self) {
        let Dimensions { total, width, .. } = *self.subject.dimensions;
        let x = self.at(width.from, 0.0).x - LEVEL;
        let [a, b] = [total.from, total.to].map(|z| pos2(x, self.at(0.0, z).y));
        let texts = [self.named("total depth", total.percent), percent(total.percent)];
        let placed = texts.iter().find_map(|text| {
            let fits = self.sheet.size(text).x + 2.0 * GAP < b.y - a.y;
            fits.then(|| self.sheet.write_upright(text, a.lerp(b, 0.5), None)).flatten()
        });
        if placed.is_none() {
            return;
        }
        self.lead(&[total.from, total.to], x, -1.0);
        self.sheet.dimension([a, b], None);
        self.sheet.keep_clear(Rect::from_two_pos(a, b).expand(2.0));
    }

    /// Adds lines from the stone at these heights to a dimension at `x`, which is left (`side` -1) or right (1) of the
    /// stone.
    fn lead(&mut self, heights: &[f64], x: f32, side: f32) {
        for (k, &z) in heights.iter().enumerate() {
            if !heights[..k].contains(&z) {
                let y = self.at(0.0, z).y;
                let start = pos2(self.sheet.reach(y, side) + GAP * side, y);
                self.sheet.line(vec![start, pos2(x + GAP * side, y)], Weight::Extension, None);
            }
        }
    }

    /// Adds crown, girdle and pavilion in one line on the right.
    fn heights(&mut self) {
        let Dimensions { total, crown, girdle, pavilion, width, .. } = *self.subject.dimensions;
        let parts = [
            ("crown", crown, ProfileHandle::TableLine),
            ("girdle", girdle, ProfileHandle::GirdleUpper),
            ("pavilion", pavilion, ProfileHandle::PavilionTip),
        ];
        let parts: Vec<_> =
            parts.into_iter().filter_map(|(name, span, part)| Some((name, span?, part))).collect();
        if parts.iter().all(|(_, span, _)| span.length() >= total.length()) {
            return;
        }
        let x = self.at(width.to, 0.0).x + LEVEL;
        let ends: Vec<f64> = parts.iter().flat_map(|(_, span, _)| [span.from, span.to]).collect();
        self.lead(&ends, x, 1.0);
        let middles = parts.iter().map(|(_, s, _)| f64::from(self.at(0.0, (s.from + s.to) / 2.0).y));
        let line = self.sheet.size(LONGEST).y + 1.0;
        let middles = spread(middles.collect(), f64::from(self.level(1.0)), f64::from(line));
        for ((name, span, part), y) in parts.into_iter().zip(middles) {
            let about = self.row(part);
            let ends = [span.from, span.to].map(|z| pos2(x, self.at(0.0, z).y));
            self.sheet.dimension(ends, about);
            let text = self.named(name, span.percent);
            self.sheet.write(&text, Align2::LEFT_CENTER, pos2(x + BESIDE, y as f32), about);
        }
    }

    /// Adds the crown angle at the table's corner and the pavilion angle at the culet's, on the left.
    fn angles(&mut self) {
        let Dimensions { width, total, table, girdle, culet, .. } = *self.subject.dimensions;
        let (Some(table), Some(girdle)) = (table, girdle) else { return };
        let end = |height: f64| self.at(width.from, height);
        let crown = [self.at(table.from, total.from), end(girdle.from)];
        let pavilion = [self.at(culet.from, total.to), end(girdle.to)];
        self.angle(crown, ProfileHandle::CrownSlope);
        self.angle(pavilion, ProfileHandle::PavilionSlope);
    }

    /// Adds the angle at `vertex` between the level line to the left and the line to `end`, where it is a proportion.
    fn angle(&mut self, [vertex, end]: [Pos2; 2], part: ProfileHandle) {
        let Some((cut, row)) = self.subject.cut.zip(self.row(part)) else { return };
        let degrees = (row.get)(cut);
        let turn = degrees.to_radians() as f32 * (end.y - vertex.y).signum();
        let arm = |part: f32| vec2(-(part * turn).cos(), (part * turn).sin());
        let text = row.written(degrees);
        let about = Some(row);
        let largest = ARC.min(ARC_PART * (end - vertex).length());
        let within = [1.0, 0.7, 0.45].map(|part| (part * largest, arm(0.5) * (part * largest + BESIDE)));
        // Where the wedge is too narrow, the number goes to the other side of the level line, or beside the arc.
        let over = |off: f32, gap: f32| {
            (largest, -vec2(off, turn.signum() * (self.sheet.size(&text).y / 2.0 + gap)))
        };
        let beyond = [over(largest + BESIDE, 2.0), over(BESIDE, 2.0), over(BESIDE + 2.0, BESIDE + 2.0)];
        let mut places = within.into_iter().chain(beyond);
        let placed = places
            .find(|&(_, off)| self.sheet.write(&text, Align2::RIGHT_CENTER, vertex + off, about).is_some());
        if let Some((radius, _)) = placed {
            let arc = (0..=ARC_STEPS).map(|k| vertex + arm(k as f32 / ARC_STEPS as f32) * radius);
            self.sheet.line(arc.collect(), Weight::Dimension, about);
            let level = vec![vertex - vec2(GAP, 0.0), vertex - vec2(radius + GAP, 0.0)];
            self.sheet.line(level, Weight::Extension, None);
        }
    }

    fn culet(&mut self) {
        let Dimensions { total, culet, .. } = *self.subject.dimensions;
        let Some(row) = self.row(ProfileHandle::CuletEdge).filter(|_| culet.percent > 0.0) else { return };
        let ends = [culet.from, culet.to].map(|x| self.at(x, total.to));
        let text = self.named("culet", culet.percent);
        self.sheet.across(self.level(-1.0), ends, &text, Some(row));
    }

    /// Adds the lengths of star and lower half of a round brilliant in plan, on the right of crown and pavilion.
    fn star_and_lower_half(&mut self) {
        let Some(given) = self.subject.cut.and_then(Cut::brilliant) else { return };
        let Ok(derived) = &given.derived() else { return };
        let star = star_ends(given, derived).map(|end| self.at(end.x, end.y));
        self.sheet.across(self.level(1.0), star, &self.named("star", given.star_length), None);
        let level = if given.culet > 0.0 { -2.0 } else { -1.0 };
        let lower = lower_half_ends(given, derived).map(|end| self.at(end.x, end.y));
        let text = self.named("lower half", derived.lower_half_length);
        self.sheet.across(self.level(level), lower, &text, None);
    }
}

#[cfg(test)]
mod tests {
    use super::super::body::ProfileBody;
    use super::super::sight::{ProfileBox, room};
    use super::*;
    use crate::random;
    use brillianteer_cut::{Crown, RoundBrilliant, TOLKOWSKY};
    use brillianteer_picture::profile::brilliant::BRILLIANT_BASIS;
    use brillianteer_scene::Stone;
    use proptest::prelude::*;

    fn measure(text: &str) -> Vec2 {
        vec2(6.2 * text.chars().count() as f32, 14.0)
    }

    /// Returns the labels of a brilliant in a rectangle of this size.
    fn labels(given: &RoundBrilliant, size: Vec2) -> Vec<Label> {
        let derived = given.derived().unwrap();
        let dimensions = Dimensions::of_brilliant(given, &derived);
        let (rect, detail) = (Rect::from_min_size(Pos2::ZERO, size), LabelDetail::of(size));
        let sight =
            ProfileProjection::fitting(ProfileBox::of(&dimensions), room(rect, detail.margins(&measure)));
        let stone = Stone::new(&given.facets().unwrap()).unwrap();
        let outline = ProfileBody::new(&stone, BRILLIANT_BASIS, &sight).outline();
        let subject = ProfileSubject { dimensions: &dimensions, cut: Some(&Cut::RoundBrilliant(*given)) };
        Planner::plan(subject, &sight, detail, ProfileSheet::new(rect, &outline, &measure)).1
    }

    fn texts(given: &RoundBrilliant, size: Vec2) -> Vec<String> {
        let mut texts: Vec<_> = labels(given, size).into_iter().map(|label| label.text).collect();
        texts.sort();
        texts
    }

    #[test]
    fn a_large_drawing_bears_every_dimension_and_smaller_ones_less() {
        let given = RoundBrilliant { culet: 2.0, ..TOLKOWSKY };
        let all = [
            "34.5°",
            "40.75°",
            "crown 16.15 %",
            "culet 2 %",
            "girdle 3 %",
            "lower half 75 %",
            "pavilion 42.22 %",
            "star 50 %",
            "table 53 %",
            "total depth 61.37 %",
        ];
        assert_eq!(texts(&given, vec2(900.0, 600.0)), all);
        assert_eq!(texts(&given, vec2(420.0, 360.0)), all);
        assert_eq!(texts(&given, vec2(240.0, 200.0)), ["34.5°", "40.75°", "53 %", "61.37 %"]);
        assert_eq!(texts(&given, vec2(140.0, 120.0)), [""; 0]);
    }

    #[test]
    fn a_point_has_no_culet_to_measure() {
        assert!(!texts(&TOLKOWSKY, vec2(900.0, 600.0)).iter().any(|text| text.contains("culet")));
    }

    #[test]
    fn angles_of_shallow_and_steep_stones_are_written_too() {
        for (crown, table) in [(8.0, 80.0), (12.0, 80.0), (20.0, 60.0), (50.0, 50.0), (60.0, 30.0)] {
            let given = RoundBrilliant { crown: Crown::Angle(crown), table, ..TOLKOWSKY };
            for size in [vec2(900.0, 600.0), vec2(420.0, 360.0), vec2(300.0, 260.0), vec2(240.0, 200.0)] {
                assert!(texts(&given, size).contains(&format!("{crown}°")), "{crown} {size}");
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn no_number_overlaps_another_or_is_cut_off(
            given in random::proportions(), width in 100.0_f32..1000.0, height in 80.0_f32..800.0,
        ) {
            let labels = labels(&given, vec2(width, height));
            let rect = Rect::from_min_size(Pos2::ZERO, vec2(width, height));
            for (k, label) in labels.iter().enumerate() {
                prop_assert!(rect.contains_rect(label.frame), "{label:?}");
                prop_assert!(!labels[..k].iter().any(|other| other.frame.intersects(label.frame)), "{label:?}");
            }
        }
    }
}
