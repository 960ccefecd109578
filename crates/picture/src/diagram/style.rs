//! The layouts of a facet diagram: a whole sheet, or a smaller form for a small place on a screen.

use super::super::drawing::Inks;
use super::{LIST_LINE, NAME, View, tiers};
use brillianteer_math::Basis;
use brillianteer_scene::Stone;
use glam::DVec2;

/// Gap between the two views, on a sheet and in a small diagram.
const APART: [f64; 2] = [40.0, 12.0];

/// Width of the paper around a small diagram.
pub(super) const SMALL_MARGIN: f64 = 10.0;

/// The most lines of a list; further tiers are only counted.
const MOST_LINES: usize = 40;

/// Radius of the stone on a sheet, in units of the drawing.
const RADIUS: f64 = 174.0;
/// The least radius of the stone in a small diagram, in units of the drawing.
const LEAST_RADIUS: f64 = 54.0;

/// Difference between one radius that is tried and the next.
const STEP: f64 = 4.0;

/// The least height of names, in points: smaller ones are hard to read.
const LEAST_TYPE: f64 = 9.5;

/// Height of a sheet's heading, of its paper above and below, and of the text between views and list.
const SHEET_EXTRA: f64 = 230.0;
/// The corresponding height of a small diagram.
const SMALL_EXTRA: f64 = 112.0;

/// The style in which a facet diagram is drawn. Type has the same size in all styles; where there is less room, the
/// stone is drawn smaller beside it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiagramStyle {
    /// The colours.
    pub inks: Inks,
    /// Radius of the circle that holds the stone, in units of the drawing.
    pub(super) radius: f64,
    /// True where the diagram has a heading, an index of azimuths and all columns of the list.
    pub(super) is_sheet: bool,
    /// The most lines of the list; further tiers are only counted. With 0 there is no list.
    pub(super) most_lines: usize,
    /// True where the views stand one above the other, without lists.
    pub(super) is_stacked: bool,
}

impl DiagramStyle {
    /// The style of exports: the whole sheet, dark on white.
    pub const SHEET: Self =
        Self { inks: Inks::PAPER, radius: RADIUS, is_sheet: true, most_lines: MOST_LINES, is_stacked: false };

    /// Returns the style of the whole sheet in other colours.
    pub fn sheet(inks: Inks) -> Self {
        Self { inks, ..Self::SHEET }
    }

    /// Returns the style in which names are legible where the diagram is shown at this width and height in points.
    ///
    /// That is the whole sheet if possible, otherwise a diagram without heading and index, and at last one without
    /// the list, its views side by side or one above the other. If no style is legible, it is the one with the
    /// largest names.
    pub fn fitting(stone: &Stone, inks: Inks, points: [f64; 2]) -> Self {
        let tiers = tiers(stone);
        let lines = |basis| {
            let view = View::new(stone, basis, &Self::SHEET);
            tiers.iter().filter(|tier| view.holds(&stone.polytope.facets()[tier.first()])).count()
        };
        let lines = lines(Basis::FACE_UP).max(lines(Basis::FACE_DOWN)).min(MOST_LINES);
        let sheet = Self::sheet(inks);
        let radii =
            || (0..).map(|k| RADIUS - STEP * f64::from(k)).take_while(|&radius| radius >= LEAST_RADIUS);
        let small = |most_lines, is_stacked| {
            radii().map(move |radius| Self { inks, radius, is_sheet: false, most_lines, is_stacked })
        };
        let all =
            [sheet].into_iter().chain(small(MOST_LINES, false)).chain(small(0, false)).chain(small(0, true));
        let type_points = |style: &Self| style.type_points(lines, points);
        let largest = || all.clone().max_by(|a, b| type_points(a).total_cmp(&type_points(b)));
        all.clone().find(|style| type_points(style) >= LEAST_TYPE).or_else(largest).unwrap_or(sheet)
    }

    /// Returns the height of names in points, where the list has this many lines and the diagram is shown at this size
    /// in points.
    fn type_points(&self, lines: usize, points: [f64; 2]) -> f64 {
        let list = if self.most_lines == 0 { 0.0 } else { LIST_LINE * (lines as f64 + 0.8) };
        let extra = if self.is_sheet { SHEET_EXTRA } else { SMALL_EXTRA };
        let size = if self.is_stacked {
            [2.0 * self.half_room(), 4.0 * self.half_height()]
        } else {
            [2.0 * (self.half_apart() + self.half_room()), 2.0 * self.leaders() + list + extra]
        };
        NAME.size * (points[0] / size[0]).min(points[1] / size[1])
    }

    /// Returns the place of the middle of a view: the crown's to the left of the pavilion's, or above it.
    pub(super) fn place(&self, is_crown: bool) -> DVec2 {
        let side = if is_crown { -1.0 } else { 1.0 };
        if self.is_stacked {
            DVec2::new(0.0, side * self.half_height())
        } else {
            DVec2::new(side * self.half_apart(), 0.0)
        }
    }

    /// Returns half the height that a view without a list takes, its name included.
    fn half_height(&self) -> f64 {
        self.leaders() + 26.0
    }

    /// Returns half the width that each of the two views has.
    pub(super) fn half_room(&self) -> f64 {
        self.radius + 48.0
    }

    /// Returns half the distance between the middles of the two views.
    fn half_apart(&self) -> f64 {
        self.half_room() + APART[usize::from(!self.is_sheet)] / 2.0
    }

    /// Returns the radius at which leaders end.
    pub(super) fn leaders(&self) -> f64 {
        self.radius + if self.is_sheet { 38.0 } else { 16.0 }
    }

    /// Returns the distance of a view's name above its middle.
    pub(super) fn name_above(&self) -> f64 {
        self.leaders() + if self.is_sheet { 32.0 } else { 26.0 }
    }

    /// Returns the distance of the list below the middle of a view.
    pub(super) fn list_below(&self) -> f64 {
        self.leaders() + if self.is_sheet { 46.0 } else { 34.0 }
    }
}
