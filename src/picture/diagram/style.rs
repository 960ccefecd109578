//! How a facet diagram is laid out: as a whole sheet, or for a small place on a screen.

use super::super::drawing::Inks;
use super::{LIST_LINE, NAME, View, tiers};
use crate::math::Basis;
use crate::scene::Stone;
use glam::DVec2;

/// Space between the two views of a sheet, and of a small diagram.
const APART: [f64; 2] = [40.0, 12.0];

/// Paper round a small diagram.
const SMALL_MARGIN: f64 = 10.0;

/// Lines of a list; further tiers are only counted.
const MOST_LINES: usize = 40;

/// The radius of the stone on a sheet, and the least in a small diagram, units of the drawing.
const RADIUS: f64 = 174.0;
const LEAST_RADIUS: f64 = 54.0;

/// From one radius that is tried to the next.
const STEP: f64 = 4.0;

/// The least height of names, points: smaller ones are hard to read.
const LEAST_TYPE: f64 = 9.5;

/// Height of a sheet's heading and of its paper above and below, and of what stands between views and list.
const SHEET_EXTRA: f64 = 230.0;
const SMALL_EXTRA: f64 = 112.0;

/// How a facet diagram is drawn. Type has the same size in all: where there is less room, the stone is drawn smaller
/// beside it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiagramStyle {
    /// Its colours.
    pub inks: Inks,
    /// Radius of the circle that holds the stone, units of the drawing.
    pub(super) radius: f64,
    /// Whether it has a heading, an index of azimuths and all columns of the list.
    pub(super) is_sheet: bool,
    /// Lines of the list; further tiers are only counted, and with none there is no list.
    pub(super) most_lines: usize,
    /// Whether the views stand one below the other, without lists.
    pub(super) is_stacked: bool,
}

impl DiagramStyle {
    /// The whole sheet, dark on white, as it is exported.
    pub const SHEET: Self =
        Self { inks: Inks::PAPER, radius: RADIUS, is_sheet: true, most_lines: MOST_LINES, is_stacked: false };

    /// The whole sheet in other colours.
    pub fn sheet(inks: Inks) -> Self {
        Self { inks, ..Self::SHEET }
    }

    /// The style in which names are large enough to be read where the diagram is shown so many points wide and high: the
    /// whole sheet if it can be, else a diagram without heading and index, at last without the list, its views side by side
    /// or one below the other. Where none is, the one whose names are largest.
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

    /// Height of names in points, where the list has so many lines.
    fn type_points(&self, lines: usize, points: [f64; 2]) -> f64 {
        let list = if self.most_lines == 0 { 0.0 } else { LIST_LINE * (lines as f64 + 0.8) };
        let extra = if self.is_sheet { SHEET_EXTRA } else { SMALL_EXTRA };
        let size = match self.is_stacked {
            true => [2.0 * self.half_room(), 4.0 * self.half_height()],
            false => [2.0 * (self.half_apart() + self.half_room()), 2.0 * self.leaders() + list + extra],
        };
        NAME.size * (points[0] / size[0]).min(points[1] / size[1])
    }

    /// Where the middle of a view stands: the crown's to the left of the pavilion's, or above it.
    pub(super) fn place(&self, is_crown: bool) -> DVec2 {
        let side = if is_crown { -1.0 } else { 1.0 };
        match self.is_stacked {
            true => DVec2::new(0.0, side * self.half_height()),
            false => DVec2::new(side * self.half_apart(), 0.0),
        }
    }

    /// Half the height that a view without a list takes, its name included.
    fn half_height(&self) -> f64 {
        self.leaders() + 26.0
    }

    /// Half the room that each of the two views has.
    pub(super) fn half_room(&self) -> f64 {
        self.radius + 48.0
    }

    /// Half the distance between the middles of the two views.
    fn half_apart(&self) -> f64 {
        self.half_room() + APART[usize::from(!self.is_sheet)] / 2.0
    }

    /// Radius at which leaders end.
    pub(super) fn leaders(&self) -> f64 {
        self.radius + if self.is_sheet { 38.0 } else { 16.0 }
    }

    /// How far above the middle of a view its name stands.
    pub(super) fn name_above(&self) -> f64 {
        self.leaders() + if self.is_sheet { 32.0 } else { 26.0 }
    }

    /// How far below the middle of a view the list begins.
    pub(super) fn list_below(&self) -> f64 {
        self.leaders() + if self.is_sheet { 46.0 } else { 34.0 }
    }

    /// Paper all round where there is no heading.
    pub(super) fn margin(&self) -> f64 {
        SMALL_MARGIN
    }
}
