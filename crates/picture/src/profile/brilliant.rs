//! The profile of a round brilliant: its angles, its culet, and the lengths of stars and lower halves.
//!
//! Star and lower half are measured in plan. They lie 22.5 degrees from the drawing's plane, where the projection
//! shortens the part and the whole alike.

use super::super::drawing::{Align, DIMENSION};
use super::{BESIDE, Dimensions, Drawing, GAP, LINE, Overflow, Span, degrees, percent};
use brillianteer_cut::{Derived, RoundBrilliant};
use brillianteer_math::Basis;
use brillianteer_scene::Stone;
use glam::{DVec2, DVec3};
use std::f64::consts::FRAC_PI_8;
use svg::Document;

/// Radius of an angle's arc, in units of the drawing.
const ARC: f64 = 64.0;
/// Radius of a narrow angle's arc, in units of the drawing.
const NARROW_ARC: f64 = 110.0;
/// Angle below which an angle counts as narrow, in degrees.
const NARROW: f64 = 20.0;
/// Angle below which there is no room for the number inside the angle, in degrees.
const TOO_NARROW: f64 = 11.0;

/// The view in which the bezels at azimuth 0 and 180 degrees are edge on, so that crown and pavilion angle have their
/// true size.
pub const BRILLIANT_BASIS: Basis = Basis { right: DVec3::X, up: DVec3::Z, toward: DVec3::NEG_Y };

/// Draws the profile of a round brilliant.
pub(super) fn draw(stone: &Stone, title: &str, given: &RoundBrilliant, derived: &Derived) -> Document {
    let dimensions = Dimensions::of_brilliant(given, derived);
    let mut drawing = Drawing::new(stone, dimensions, BRILLIANT_BASIS);
    drawing.star(given, derived);
    drawing.table(2.0);
    drawing.heights();
    drawing.angles(given, derived);
    drawing.culet();
    drawing.lower_half(given, derived);
    drawing.width("girdle diameter", 3.0);
    let angles = [
        ("Star", derived.star_angle),
        ("upper half", derived.upper_half_angle),
        ("lower half", derived.lower_half_angle),
    ];
    let angles = angles.map(|(name, angle)| format!("{name} {}", degrees(angle))).join(" · ");
    let remarks = [
        format!("{angles} · lower half, seen from the side, {}", percent(derived.lower_half_length_vertical)),
        "Star and lower half in plan: of the way from the table's edge to the girdle, and from the girdle to the \
         centre."
            .to_owned(),
    ];
    let subtitle = "profile · percent of the girdle diameter, degrees from the girdle plane";
    drawing.sheet.document(title, subtitle, &remarks)
}

/// Returns the ends of a star, at the table and below it, on the right of the profile, in radii.
pub fn star_ends(given: &RoundBrilliant, derived: &Derived) -> [DVec2; 2] {
    let cos = FRAC_PI_8.cos();
    let edge = given.table / 100.0 * cos;
    let tip = edge + given.star_length / 100.0 * (1.0 - edge);
    let tip_height = derived.crown_angle.to_radians().tan() * (1.0 - tip * cos);
    [DVec2::new(edge * cos, derived.crown_height / 50.0), DVec2::new(tip * cos, tip_height)]
}

/// Returns the ends of a lower half, at the culet or its point and at the girdle, on the right of the profile, in
/// radii.
pub fn lower_half_ends(given: &RoundBrilliant, derived: &Derived) -> [DVec2; 2] {
    let cos = FRAC_PI_8.cos();
    let tip = (1.0 - derived.lower_half_length / 100.0) * cos;
    let girdle = -given.girdle_thickness / 50.0;
    let tip_height = girdle - derived.pavilion_angle.to_radians().tan() * (1.0 - tip * cos);
    let lowest = (derived.crown_height - derived.total_depth) / 50.0;
    [DVec2::new(tip, tip_height.max(lowest)), DVec2::new(cos, girdle)]
}

impl Dimensions {
    /// Returns the dimensions of a round brilliant as given and derived, in percent of the girdle diameter.
    pub fn of_brilliant(given: &RoundBrilliant, derived: &Derived) -> Self {
        let (crown, girdle) = (derived.crown_height / 50.0, given.girdle_thickness / 50.0);
        let lowest = crown - derived.total_depth / 50.0;
        let (table, culet) = (given.table / 100.0, given.culet / 100.0);
        Self {
            width: Span::new(-1.0, 1.0, 100.0),
            culet: Span::new(-culet, culet, given.culet),
            total: Span::new(crown, lowest, derived.total_depth),
            table: Some(Span::new(-table, table, given.table)),
            crown: Some(Span::new(crown, 0.0, derived.crown_height)),
            girdle: Some(Span::new(0.0, -girdle, given.girdle_thickness)),
            pavilion: Some(Span::new(-girdle, lowest, derived.pavilion_depth)),
        }
    }
}

/// The dimensions that only a round brilliant has.
impl Drawing<'_> {
    /// Draws the star's length in plan, above the right half of the crown.
    fn star(&mut self, given: &RoundBrilliant, derived: &Derived) {
        let ends = star_ends(given, derived).map(|end| self.at(end.x, end.y));
        let text = format!("star {}", percent(given.star_length));
        self.across(self.level(1.0), ends, Overflow::Right, &text);
    }

    /// Draws the lower half's length in plan, below the right half of the pavilion.
    fn lower_half(&mut self, given: &RoundBrilliant, derived: &Derived) {
        let ends = lower_half_ends(given, derived).map(|end| self.at(end.x, end.y));
        let text = format!("lower half {}", percent(derived.lower_half_length));
        self.across(self.level(-2.0), ends, Overflow::Left, &text);
    }

    fn culet(&mut self) {
        let Dimensions { culet, total: Span { to: bottom, .. }, .. } = self.dimensions;
        let text = format!("culet {}", percent(culet.percent));
        let y = self.level(-1.0);
        if culet.to * self.aspect.scale > 1.0 {
            let ends = [culet.from, culet.to].map(|x| self.at(x, bottom));
            return self.across(y, ends, Overflow::Left, &text);
        }
        let tip = self.at(0.0, bottom) + DVec2::Y * GAP;
        let knee = DVec2::new(tip.x - BESIDE, y);
        self.sheet.stroke(knee, tip);
        if let Some(toward) = (tip - knee).try_normalize() {
            self.sheet.arrow_head(tip, toward);
        }
        self.sheet.text(DIMENSION, Align::End, knee - DVec2::X * GAP, &text);
    }

    /// Draws the crown angle at the table's corner and the pavilion angle at the culet, both outside the stone on the
    /// left.
    fn angles(&mut self, given: &RoundBrilliant, derived: &Derived) {
        let girdle = -given.girdle_thickness / 50.0;
        let table = self.at(-given.table / 100.0, self.dimensions.total.from);
        self.angle(table, self.at(-1.0, 0.0), derived.crown_angle);
        let culet = self.at(-given.culet / 100.0, self.dimensions.total.to);
        self.angle(culet, self.at(-1.0, girdle), derived.pavilion_angle);
    }

    /// Draws the angle at `vertex`, in degrees, between the level line to the left and the line to `end`.
    fn angle(&mut self, vertex: DVec2, end: DVec2, angle: f64) {
        let radius = if angle < NARROW { NARROW_ARC } else { ARC };
        let down = (end.y - vertex.y).signum();
        let arm = DVec2::new(-angle.to_radians().cos(), down * angle.to_radians().sin());
        self.sheet.extension(vertex - DVec2::X * GAP, vertex - DVec2::X * (radius + 2.0 * GAP));
        if (end - vertex).length() < radius + GAP {
            self.sheet.extension(end + arm * GAP, vertex + arm * (radius + 2.0 * GAP));
        }
        self.sheet.arc(vertex, vertex - DVec2::X * radius, vertex + arm * radius);
        let half = (angle / 2.0).to_radians();
        let text_at = if angle < TOO_NARROW {
            // The angle is too narrow for text between its lines.
            vertex + DVec2::new(-radius - 2.0 * GAP, -down * LINE / 2.0)
        } else {
            vertex + DVec2::new(-half.cos(), down * half.sin()) * (radius + BESIDE)
        };
        self.sheet.text(DIMENSION, Align::End, text_at, &degrees(angle));
    }
}

#[cfg(test)]
mod tests {
    use crate::profile;
    use brillianteer_cut::{Crown, LowerHalf, Pavilion, RoundBrilliant, TOLKOWSKY};
    use brillianteer_scene::Stone;

    fn svg(given: &RoundBrilliant) -> String {
        let stone = Stone::new(&given.facets().unwrap()).unwrap();
        profile(&stone, "Test", Some(given)).to_string()
    }

    /// Returns the numbers written between `before` and `after`.
    fn written(svg: &str, before: &str, after: &str) -> Vec<f64> {
        let lines = svg.lines().filter_map(|line| line.strip_prefix(before)?.strip_suffix(after));
        lines.filter_map(|number| number.parse().ok()).collect()
    }

    #[test]
    fn a_tolkowsky_shows_the_numbers_of_the_worked_table() {
        let svg = svg(&TOLKOWSKY);
        for text in [
            "table 53 %",
            "star 50 %",
            "crown 16.15 %",
            "girdle 3 %",
            "pavilion 43.08 %",
            "total depth 62.23 %",
            "lower half 75 %",
            "culet 0 %",
            "girdle diameter 100 %",
            "34.5°",
            "40.75°",
        ] {
            assert_eq!(svg.lines().filter(|line| *line == text).count(), 1, "{text}");
        }
        assert!(svg.contains("Star 23.07° · upper half 40.58° · lower half 42.01°"));
    }

    #[test]
    fn what_is_written_is_what_is_given_and_derived_to_two_decimals() {
        let others = RoundBrilliant {
            crown: Crown::Height(13.377),
            pavilion: Pavilion::Depth(39.123),
            lower_half: LowerHalf::Vertical(81.234),
            table: 61.555,
            star_length: 44.449,
            culet: 1.25,
            ..TOLKOWSKY
        };
        let steep =
            RoundBrilliant { crown: Crown::Angle(63.21), pavilion: Pavilion::Angle(12.345), ..others };
        for given in [TOLKOWSKY, others, steep] {
            let (svg, derived) = (svg(&given), given.derived().unwrap());
            for (name, expected) in [
                ("table", given.table),
                ("star", given.star_length),
                ("crown", derived.crown_height),
                ("girdle", given.girdle_thickness),
                ("pavilion", derived.pavilion_depth),
                ("total depth", derived.total_depth),
                ("lower half", derived.lower_half_length),
                ("culet", given.culet),
                ("girdle diameter", 100.0),
            ] {
                let found = written(&svg, &format!("{name} "), " %");
                assert!(found.len() == 1 && (found[0] - expected).abs() < 0.005 + 1e-9, "{name}: {found:?}");
            }
            let angles = written(&svg, "", "°");
            assert_eq!(angles.len(), 2);
            assert!((angles[0] - derived.crown_angle).abs() < 0.005 + 1e-9, "{angles:?}");
            assert!((angles[1] - derived.pavilion_angle).abs() < 0.005 + 1e-9, "{angles:?}");
        }
    }

    #[test]
    fn impossible_proportions_are_measured_instead_and_told_so() {
        let stone = Stone::new(&TOLKOWSKY.facets().unwrap()).unwrap();
        let impossible = RoundBrilliant { table: 100.0, ..TOLKOWSKY };
        let svg = profile(&stone, "Test", Some(&impossible)).to_string();
        assert!(svg.contains("measured on the planes"));
    }
}
