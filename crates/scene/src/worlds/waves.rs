//! Water with waves: octaves of smooth noise. Waves wider than the footprint of a line of sight are drawn as shapes;
//! the finer ones add to the spread of slopes.

use super::noise::{noise, ramp};
use glam::{DMat2, DVec2, DVec3};

/// The seed of the first octave's noise.
const SEED: u32 = 60;

/// Water with `N` octaves of waves, seen from a height above it.
pub(super) struct Waves<const N: usize> {
    /// Height of the eye above the water in metres; it sets the apparent distance between waves.
    pub eye: f64,
    /// The length of the finest waves in metres.
    pub finest: f64,
    /// The factor from one length to the next.
    pub coarser: f64,
    /// The slope of each octave.
    pub slopes: [f64; N],
    /// The turn of each octave, and its stretch along the crests.
    pub swells: [DMat2; N],
    /// The spread of slopes that no footprint resolves.
    pub calm: f64,
    /// The footprint, as a part of their length, from which on waves are not drawn as shapes.
    pub hidden_from: f64,
    /// The greatest ratio of length to width of a footprint on the water.
    pub longest: f64,
}

/// The point of the water on a line of sight.
pub(super) struct WaterPoint {
    /// The distance to it in metres.
    pub distance: f64,
    /// The slope of the waves that are drawn as shapes.
    pub slope: DVec2,
    /// The variance of the slopes of the finer waves, along the view and across it.
    pub hidden: f64,
    /// The cosine between the line of sight and the normal, 0 where the water faces away.
    pub facing: f64,
    /// The direction in which the line of sight is reflected, of length 1.
    pub mirrored: DVec3,
}

/// Returns for each of `N` octaves the matrix from a place to its waves: octave k is turned by `first + k * step`, in radians.
/// Then `wind` turns it into the wind's axes, and there the second coordinate is multiplied by `drawn_out`: at 0.5, crests
/// along it are twice as long.
pub(super) fn swells<const N: usize>(wind: DMat2, drawn_out: f64, (first, step): (f64, f64)) -> [DMat2; N] {
    let drawn_out = DMat2::from_diagonal(DVec2::new(1.0, drawn_out));
    std::array::from_fn(|k| drawn_out * wind * DMat2::from_angle(step * k as f64 + first))
}

impl<const N: usize> Waves<N> {
    /// Returns the point of the water in a unit direction that looks down; the footprint is in radians.
    pub fn met(&self, d: DVec3, footprint: f64) -> WaterPoint {
        let down = (-d.z).max(0.25 * footprint).max(1e-4);
        let distance = self.eye / down;
        let along = footprint * distance * (1.0 / down).min(self.longest).sqrt();
        let (slope, hidden) = self.slope(d.truncate() * distance, along);
        let normal = DVec3::new(-slope.x, -slope.y, 1.0) / (1.0 + slope.length_squared()).sqrt();
        let facing = normal.dot(-d).max(0.0);
        WaterPoint { distance, slope, hidden, facing, mirrored: d + 2.0 * facing * normal }
    }

    /// Returns the slope at a point of the water, and the variance of the slopes that are finer than a length.
    fn slope(&self, p: DVec2, along: f64) -> (DVec2, f64) {
        let (mut slope, mut hidden, mut length) = (DVec2::ZERO, self.calm * self.calm, self.finest);
        for (k, (strength, swell)) in self.slopes.into_iter().zip(&self.swells).enumerate() {
            let seen = 1.0 - ramp(0.35, self.hidden_from, along / length);
            if seen > 0.0 {
                let (_, g) = noise(*swell * p / (0.5 * length), SEED + k as u32);
                slope += swell.transpose() * g * (1.5 * strength * seen);
            }
            hidden += strength * strength * (1.0 - seen * seen);
            length *= self.coarser;
        }
        (slope, hidden)
    }
}
