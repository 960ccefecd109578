//! Scintillation: the change of the brightness of the face as the stone rocks, and the size of the patches that
//! change.

use super::exit_sight::brightness;
use super::eye_grid::EyeGrid;
use super::interval::Interval;
use super::pattern_settings::PatternSettings;
use brillianteer_base::{Stopped, Watch};
use brillianteer_scene::View;
use brillianteer_trace::beam::Beams;
use glam::{DQuat, DVec2};
use serde::{Deserialize, Serialize};

/// The number of directions into which the stone rocks, evenly around it.
///
/// A wave of 1 to 11 periods around the stone averages to 0 over twelve directions, so their mean is that over all
/// directions up to the 12th wave for stones of 1, 2, 3, 4 or 6 repeats, and up to the 24th for those of 8. Four or
/// eight directions would be equivalent for a brilliant, whose facets repeat every 45 degrees.
const DIRECTIONS: u32 = 12;

/// The part of the face's mean brightness by which a place must change to count as changing.
const CHANGES: f64 = 0.5;

/// The change of the face as the stone rocks, under an even dome with the observer's head.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Scintillation {
    /// The mean change of the brightness of a place, up or down, as a part of the face's mean brightness. `most` is infinite where
    /// the mean may be 0.
    pub change: Interval,
    /// The mean diameter of the patches that change by more than half the mean brightness, weighted by area, as a part of the face's
    /// diameter. Diameters are those of circles of the same area.
    pub size: Interval,
}

/// Returns the views of a stone that has rocked by an angle, degrees, into each direction, while eye and light stay.
pub fn rocked_views(view: &View, rock_deg: f64) -> Vec<View> {
    let basis = view.basis();
    let rocked = |direction: &DVec2| {
        // The axis lies in the image, and is given in the frame before the turn.
        let axis = view.turn * basis.lift(*direction);
        View {
            turn: DQuat::from_axis_angle(axis.normalize_or(glam::DVec3::X), rock_deg.to_radians())
                * view.turn,
            ..*view
        }
    };
    directions().map(|direction| rocked(&direction)).collect()
}

/// Returns the directions of the axes in the image, about which the stone rocks.
fn directions() -> impl Iterator<Item = DVec2> {
    (0..DIRECTIONS).map(|k| DVec2::from_angle(std::f64::consts::TAU * f64::from(k) / f64::from(DIRECTIONS)))
}

impl Scintillation {
    /// Compares the beams of a view with those of the same stone in [`rocked_views`], which are asked for one after the other,
    /// so that no more than one of them needs to be kept. `watch` is called with the part of the views that is done.
    ///
    /// # Errors
    /// Fails with the first error of `rocked`, or where `watch` asks to stop.
    pub fn of<E: From<Stopped>>(
        beams: &Beams,
        rocked: impl IntoIterator<Item = Result<Beams, E>>,
        head_deg: f64,
        pattern: &PatternSettings,
        watch: Watch,
    ) -> Result<Self, E> {
        let grid = |beams: &Beams, views: u32| {
            let done = f64::from(views) / f64::from(DIRECTIONS);
            EyeGrid::of(beams, &brightness(beams, head_deg), pattern.resolves(), &|_| watch(done))
        };
        let start = grid(beams, 0)?;
        let mean = start.mean();
        let compared = (1..).zip(rocked).map(|(views, beams)| {
            let changes = Changes::of(&start, grid(&beams?, views)?);
            Ok((changes.mean(mean), changes.size(mean)))
        });
        let each: Vec<(Interval, Interval)> = compared.collect::<Result<_, E>>()?;
        let n = each.len().max(1) as f64;
        let average = |pick: fn(&(Interval, Interval)) -> Interval| {
            let sum = |end: fn(Interval) -> f64| each.iter().map(|of| end(pick(of))).sum::<f64>() / n;
            Interval { least: sum(|of| of.least), most: sum(|of| of.most) }
        };
        Ok(Self { change: average(|of| of.0), size: average(|of| of.1) })
    }
}

/// The changes of all cells from one view to another.
struct Changes {
    /// The cells of the other view, whose patches are measured.
    grid: EyeGrid,
    /// The change of the brightness of each cell, up or down.
    of: Vec<Interval>,
    /// The part of each cell that is covered in both views, as a part of the face.
    common: Vec<f64>,
}

impl Changes {
    fn of(start: &EyeGrid, grid: EyeGrid) -> Self {
        let pairs = grid.cells.iter().enumerate().map(|(k, cell)| (grid.same_place(k, start), *cell));
        let common = pairs.clone().map(|(before, after)| before.area.min(after.area)).collect();
        let change = |(before, after): (super::eye_grid::EyeCell, super::eye_grid::EyeCell)| {
            let (a, b) = (before.brightness(), after.brightness());
            let least = (a.least - b.most).max(b.least - a.most).max(0.0);
            Interval { least, most: (a.most - b.least).max(b.most - a.least) }
        };
        let of = pairs.map(change).collect();
        Self { of, common, grid }
    }

    fn mean(&self, brightness: Interval) -> Interval {
        let area: f64 = self.common.iter().sum();
        let sum = |pick: fn(&Interval) -> f64| {
            let each = self.of.iter().zip(&self.common);
            each.map(|(change, area)| pick(change) * area).sum::<f64>()
        };
        let (least, most) = (sum(|of| of.least), sum(|of| of.most));
        let part = |change: f64, brightness: f64, none: f64| match area * brightness {
            whole if whole > 0.0 => change / whole,
            _ if change > 0.0 => f64::INFINITY,
            _ => none,
        };
        Interval { least: part(least, brightness.most, 0.0), most: part(most, brightness.least, 0.0) }
    }

    fn size(&self, brightness: Interval) -> Interval {
        let is_common = |k: usize| self.common[k] > 0.0;
        let certain = |k: usize| is_common(k) && self.of[k].least > CHANGES * brightness.most;
        let possible = |k: usize| is_common(k) && self.of[k].most > CHANGES * brightness.least;
        let area = |is_in: &dyn Fn(usize) -> bool| {
            (0..self.of.len()).filter(|&k| is_in(k)).fold(0.0, |sum, k| sum + self.grid.cells[k].area)
        };
        let [of_certain, of_possible] = [area(&certain), area(&possible)];
        let least = if of_possible > 0.0 { self.grid.sizes(certain) / of_possible } else { 0.0 };
        let most = match of_certain > 0.0 {
            true => (self.grid.sizes(possible) / of_certain).min(1.0),
            false if of_possible > 0.0 => 1.0,
            false => 0.0,
        };
        Interval { least, most }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_scene::Side;

    /// A quantity of a stone that repeats n times around it and is its own mirror image varies as cos(n φ), cos(2n φ)
    /// and so on.
    #[test]
    fn the_mean_over_directions_is_that_over_all_of_them_for_slow_waves() {
        for wave in 1..12 {
            let sum: f64 = directions().map(|direction| (f64::from(wave) * direction.to_angle()).cos()).sum();
            assert!(sum.abs() < 1e-12, "{wave}: {sum}");
        }
    }

    #[test]
    fn a_stone_rocks_by_the_angle_under_eye_and_light_that_stay() {
        for view in [
            View::default(),
            View { tilt: 0.2, azimuth: 0.7, ..View::default() },
            View { side: Side::Culet, turn: DQuat::from_rotation_z(0.3), ..View::default() },
        ] {
            let rocked = rocked_views(&view, 3.0);
            assert_eq!(rocked.len(), 12);
            for (other, direction) in rocked.iter().zip(directions()) {
                let angle = other.basis().toward.angle_between(view.basis().toward).to_degrees();
                assert!((angle - 3.0).abs() < 1e-9, "{angle}");
                let lean = |view: &View| view.basis().toward.dot(view.zenith());
                assert!((lean(other) - lean(&view)).abs() < 1e-12);
                // A point on the axis stays in its place of the image.
                let axis = view.basis().lift(direction);
                assert!(other.basis().project(axis).distance(direction) < 1e-12);
            }
        }
    }
}
