//! Decides by the standard errors of a scan's planes whether an even stone is as likely as the one that was found.
//!
//! The squared differences between found and even planes, in standard errors, add up to χ² with as many degrees of freedom as the
//! even stone has fewer numbers. The frame of the even stone (the axis, its place, the mirror) is the one with the least χ².

use super::even::{Even, Images, averaged};
use brillianteer_math::faceting::PlaneError;
use brillianteer_math::{Plane, Pose};
use glam::{DQuat, DVec3};

/// The normal distribution's quantile of the probability with which noise on an even stone is taken for noise: 99.9 %.
const LEVEL: f64 = 3.09;

/// The numbers of a frame: rotations about x, y and z, and shifts along x and y.
const NUMBERS: usize = 5;

/// The factor by which χ² may be larger because the standard errors are not known exactly: they may be 5 % too small.
const KNOWN: f64 = 1.1;

/// The most that one facet may add to χ²: six standard errors. A single facet that is off further is no noise.
const MOST_OF_ONE: f64 = 36.0;

/// The number of steps toward the frame with the least χ². It is nearly quadratic, so that one almost suffices.
const STEPS: usize = 3;

/// The step of differences, as a part of a radian and of the size.
const STEP: f64 = 1e-5;

/// The part of the largest curvature that is added to all, so that numbers that change nothing stay.
const DAMPING: f64 = 1e-9;

/// The planes that were found, with their errors, about the middle.
pub(super) struct Found<'a> {
    pub planes: &'a [Plane],
    pub errors: &'a [PlaneError],
    pub size: f64,
}

impl Found<'_> {
    /// Returns χ² of an even stone.
    fn squares(&self, even: &Even) -> f64 {
        self.each(even).sum()
    }

    /// Returns what each plane adds to χ² of an even stone.
    fn each(&self, even: &Even) -> impl Iterator<Item = f64> {
        let back = |plane: &Plane| {
            let normal = even.turn.inverse() * plane.normal;
            Plane::new(normal, plane.offset - plane.normal.dot(even.shift))
        };
        let each = self.planes.iter().zip(self.errors).zip(&even.planes);
        each.map(move |((found, error), plane)| error.squares(found, &back(plane)))
    }

    /// Returns the even stone in the frame with the least χ², where it is as likely as the found one. `start` holds the found
    /// planes in the first frame; `finish` makes the even stone of the averaged one and returns by how many numbers fewer it
    /// has. A fixed frame stays.
    pub fn likely(
        &self,
        start: &Even,
        images: &Images,
        is_fixed: bool,
        finish: impl Fn(Even) -> (Even, usize),
    ) -> Option<Even> {
        let at = |frame: &[f64; NUMBERS]| Some(finish(averaged(&moved(start, frame, self.size), images)?));
        let squares = |frame: &[f64; NUMBERS]| at(frame).map(|(even, _)| self.squares(&even));
        let mut frame = [0.0; NUMBERS];
        for _ in 0..if is_fixed { 0 } else { STEPS } {
            let next = step(&frame, &squares)?;
            if squares(&next)? >= squares(&frame)? {
                break;
            }
            frame = next;
        }
        let (even, fewer) = at(&frame)?;
        let free = images.constraints() + fewer;
        let frame = if is_fixed { 0 } else { numbers(start, fewer > 0) };
        let free = free.saturating_sub(frame).max(1) as f64;
        // The quantile of χ² (E. B. Wilson and M. M. Hilferty, 1931).
        let part = 2.0 / (9.0 * free);
        let most = free * (1.0 - part + LEVEL * part.sqrt()).powi(3);
        let is_noise = self.squares(&even) <= KNOWN * most && self.each(&even).all(|one| one <= MOST_OF_ONE);
        is_noise.then_some(even)
    }
}

/// Returns the number of a frame's numbers that an even stone's symmetry fixes. A mirror alone may be tilted and shifted along itself,
/// unless upright facets fix the tilt; turns without a mirror have no first azimuth.
fn numbers(even: &Even, has_upright: bool) -> usize {
    match (even.turns, even.mirror) {
        (1, _) => NUMBERS - 2 + usize::from(has_upright),
        (_, None) => NUMBERS - 1,
        _ => NUMBERS,
    }
}

/// Returns the stone in a frame that is turned and shifted.
fn moved(even: &Even, frame: &[f64; NUMBERS], size: f64) -> Even {
    let [x, y, z, right, back] = *frame;
    let turn = DQuat::from_scaled_axis(DVec3::new(x, y, z));
    let pose = Pose { at: size * DVec3::new(right, back, 0.0), ..Pose::turned(turn) };
    Even {
        planes: even.planes.iter().map(|p| p.placed(&pose)).collect(),
        turn: turn * even.turn,
        shift: pose.place(even.shift),
        ..*even
    }
}

/// Returns the frame with the least value of a function that is nearly quadratic (Newton's method, by differences).
#[allow(clippy::needless_range_loop, reason = "a row and its column are filled together")]
fn step(frame: &[f64; NUMBERS], of: &impl Fn(&[f64; NUMBERS]) -> Option<f64>) -> Option<[f64; NUMBERS]> {
    let at = |i: usize, a: f64, j: usize, b: f64| {
        let mut there = *frame;
        there[i] += a * STEP;
        there[j] += b * STEP;
        of(&there)
    };
    let middle = of(frame)?;
    let mut rows = [[0.0; NUMBERS + 1]; NUMBERS];
    for i in 0..NUMBERS {
        let (more, less) = (at(i, 1.0, i, 0.0)?, at(i, -1.0, i, 0.0)?);
        rows[i][i] = more + less - 2.0 * middle;
        rows[i][NUMBERS] = (less - more) / 2.0;
        for j in 0..i {
            let mixed =
                at(i, 1.0, j, 1.0)? - at(i, 1.0, j, -1.0)? - at(i, -1.0, j, 1.0)? + at(i, -1.0, j, -1.0)?;
            (rows[i][j], rows[j][i]) = (mixed / 4.0, mixed / 4.0);
        }
    }
    let most = (0..NUMBERS).map(|i| rows[i][i]).fold(f64::MIN_POSITIVE, f64::max);
    (0..NUMBERS).for_each(|i| rows[i][i] += DAMPING * most);
    let by = brillianteer_math::solved(rows);
    Some(std::array::from_fn(|i| frame[i] + STEP * by[i]))
}
