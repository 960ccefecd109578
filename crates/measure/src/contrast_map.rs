//! The map of the contrast that an eye resolves on a face: the measure eye-contrast, square by square.

use super::exit_sight::brightness;
use super::eye_grid::{EyeCell, EyeGrid, rms_contrast};
use super::interval::Interval;
use super::pattern_settings::PatternSettings;
use brillianteer_base::{Stopped, Watch};
use brillianteer_trace::beam::Beams;
use glam::DVec2;
use std::ops::Range;

/// The contrast of each square of a face that an eye resolves, under an even dome with the observer's head.
///
/// The contrast of a square is (b - m) / m, where b is its mean brightness and m that of the
/// face: -1 where it is dark, 0 where it is as bright as the face in the mean. The root of the mean square over the
/// face is the measure eye-contrast (docs/optics.md, "Pattern").
///
/// In a stone that absorbs, the brightness is a mean over each beam's outline, and the bounds are those of it.
#[derive(Debug, Clone, PartialEq)]
pub struct ContrastMap {
    corners: Vec<DVec2>,
    parts: Vec<FacePart>,
    /// The contrast of the whole face: the measure eye-contrast.
    pub whole: Interval,
    /// The side of a square, girdle radii: as large as the eye resolves, or larger in stones of more than 72 mm.
    pub side: f64,
    /// The part of the silhouette's light that was not followed to its end.
    pub unresolved: f64,
}

/// A part of a face, in one facet and one square.
#[derive(Debug, Clone, PartialEq)]
struct FacePart {
    corners: Range<u32>,
    contrast: SquareContrast,
}

/// The contrast of a square of a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SquareContrast {
    /// The contrast of the light that is known.
    pub known: f64,
    /// The contrast with its bounds for the light that was not followed to its end; `most` is infinite where the whole face may be dark.
    pub bounds: Interval,
}

impl SquareContrast {
    fn of(cell: &EyeCell, mean: Interval) -> Self {
        let (bright, ratio) = (cell.brightness(), |b: f64, m: f64| if m > 0.0 { b / m - 1.0 } else { 0.0 });
        let most = if mean.least > 0.0 { ratio(bright.most, mean.least) } else { f64::INFINITY };
        Self {
            known: ratio(cell.light, mean.least),
            bounds: Interval { least: ratio(bright.least, mean.most), most },
        }
    }
}

impl ContrastMap {
    /// Maps the contrast of exact beams, with a head of this half angle, degrees.
    ///
    /// # Errors
    /// Fails where `watch` asks to stop.
    pub fn of(
        beams: &Beams,
        head_deg: f64,
        pattern: &PatternSettings,
        watch: Watch,
    ) -> Result<Self, Stopped> {
        let bright = brightness(beams, head_deg);
        let grid = EyeGrid::of(beams, &bright, pattern.resolves(), watch)?;
        let mean = grid.mean();
        let (mut corners, mut parts): (Vec<DVec2>, Vec<FacePart>) = (vec![], vec![]);
        grid.parts_of_face(beams, watch, |cell, outline| {
            if outline.len() > 2 {
                let from = corners.len() as u32;
                corners.extend(outline);
                let contrast = SquareContrast::of(cell, mean);
                parts.push(FacePart { corners: from..corners.len() as u32, contrast });
            }
        })?;
        let (side, whole) = (grid.side, rms_contrast(grid.cells.into_iter()));
        Ok(Self { corners, parts, whole, side, unresolved: beams.unresolved() })
    }

    /// Returns the parts of the face with their contrasts. Each is a convex polygon of the image, girdle radii, and together they
    /// cover the face once.
    pub fn parts(&self) -> impl Iterator<Item = (&[DVec2], SquareContrast)> {
        let outline = |of: &Range<u32>| &self.corners[of.start as usize..of.end as usize];
        self.parts.iter().map(move |part| (outline(&part.corners), part.contrast))
    }
}
