//! The part of the image plane that a view takes in, and when it is fitted anew.

use brillianteer_scene::{Film, View};
use brillianteer_trace::ray::Camera;
use glam::{DVec2, DVec3};

/// Stones whose extents agree to this part keep their scale when they are turned about their axis.
const ROUND: f64 = 0.03;

/// A stone that reaches beyond its extents at rest by more than this part is shown smaller, since it would leave the
/// free space around it.
pub(super) const SLACK: f64 = 0.02;

/// A stone is fitted anew once it reaches more than this many times as far as the one that views are fitted to.
pub(super) const OUTGROWN: f64 = 1.04;
/// A stone is fitted anew once it reaches less than this part of the one that views are fitted to.
pub(super) const SHRUNK: f64 = 0.6;

/// A middle nearer to the origin than this part of the extent counts as at the origin: the rest is rounding.
pub(super) const CENTRED: f64 = 1e-9;

/// The part of the image plane that a view without zoom takes in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FramingFit {
    /// Half the extents across and up, girdle radii.
    pub half: DVec2,
    /// The middle in the image plane, girdle radii from the origin.
    pub middle: DVec2,
    /// The distance of the stone's middle from the origin in space, which no view changes, girdle radii.
    aside: f64,
}

impl FramingFit {
    /// Takes in everything within `reach` of the origin across and up, girdle radii.
    pub fn reaching(reach: f64) -> Self {
        Self { half: DVec2::splat(reach), middle: DVec2::ZERO, aside: 0.0 }
    }

    /// Returns the film of `size` pixels that takes in this fit.
    pub fn film(&self, size: [u32; 2]) -> Film {
        Film { centre: self.middle, ..Film::holding(self.half, size) }
    }

    /// Returns the film that the backplate fills: the same in all views of a stone, and large enough to take in each of
    /// them.
    pub fn whole(&self, size: [u32; 2]) -> Film {
        let film = Film::holding(self.half, size);
        Film { pixel: film.pixel * (1.0 + self.aside / self.half.max_element()), ..film }
    }

    /// Fits a view to points of a stone.
    pub(super) fn of(points: &[DVec3], view: &View) -> Self {
        let radius = points.iter().map(|p| p.truncate().length()).fold(0.0, f64::max);
        let turned = || points.iter().map(|&p| view.turn * p);
        let camera = Camera::reaching(view, 1.0);
        let seen = bounds(points.iter().filter_map(|&p| camera.project(p).map(|(at, _)| at.extend(0.0))));
        let above = bounds(turned().map(|p| p.truncate().extend(0.0)));
        let all = bounds(turned());
        let half = |(low, high): (DVec3, DVec3)| ((high - low) / 2.0).truncate();
        let rest = match half(above) {
            rest if radius <= rest.min_element() * (1.0 + ROUND) => DVec2::splat(radius),
            rest => rest,
        };
        let middle = ((seen.0 + seen.1) / 2.0).truncate();
        let is_centred = middle.length() < CENTRED * rest.max_element();
        Self {
            half: rest.max(half(seen) / (1.0 + SLACK)),
            middle: if is_centred { DVec2::ZERO } else { middle },
            aside: ((all.0 + all.1) / 2.0).length(),
        }
    }
}

/// Returns the least and the greatest coordinates of points; of no points, the origin.
pub(super) fn bounds(points: impl Iterator<Item = DVec3>) -> (DVec3, DVec3) {
    points.map(|p| (p, p)).reduce(|(a, b), (p, q)| (a.min(p), b.max(q))).unwrap_or_default()
}
