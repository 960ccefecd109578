//! The motion of a stone in an animation, frame by frame.

use brillianteer_math::fixed;
use brillianteer_scene::{Lean, View, Viewpoint};
use clap::ValueEnum;
use glam::DQuat;

/// The decimal steps per degree that frames keep, so that a still picture can be made with the printed numbers.
const DIGITS: f64 = 1e6;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum StoneMotion {
    /// Turn about its own axis, while eye and light stay; --tilt or --eye-tilt shows more of its side
    Turn,
    /// Rock to and fro toward --azimuth
    Rock,
    /// Wobble: the table leans toward one azimuth after the other, all around
    Wobble,
}

/// The position of the stone in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpinPose {
    /// The viewpoint of a stone that is not turned.
    pub viewpoint: Viewpoint,
    /// The turn of the stone about its axis, degrees.
    pub turned_deg: f64,
    motion: StoneMotion,
}

/// A motion that comes back to its beginning after the last frame.
#[derive(Debug, Clone, Copy)]
pub struct SpinMotion {
    pub motion: StoneMotion,
    /// The viewpoint in which the stone rests.
    pub rest: Viewpoint,
    /// The greatest angle by which the stone rocks or wobbles, degrees.
    pub swing_deg: f64,
    /// The number of frames.
    pub frames: u32,
}

impl SpinMotion {
    /// Returns the position of the stone in each frame. A rocking stone begins at rest.
    pub fn poses(&self) -> Vec<SpinPose> {
        (0..self.frames).map(|number| self.pose(number)).collect()
    }

    fn pose(&self, number: u32) -> SpinPose {
        let part = f64::from(number) / f64::from(self.frames);
        let rounded = |degrees: f64| (degrees * DIGITS).round() / DIGITS + 0.0;
        let (mut viewpoint, mut turned_deg) = (self.rest, 0.0);
        match self.motion {
            StoneMotion::Turn => turned_deg = 360.0 * part,
            StoneMotion::Rock => {
                let phase = std::f64::consts::TAU * part;
                viewpoint.tilt_deg = rounded(self.rest.tilt_deg + self.swing_deg * phase.sin());
            }
            StoneMotion::Wobble => {
                viewpoint.tilt_deg = self.swing_deg;
                viewpoint.azimuth_deg = rounded(self.rest.azimuth_deg + 360.0 * part);
            }
        }
        SpinPose { viewpoint, turned_deg, motion: self.motion }
    }

    /// Describes the motion, for the texts of animations.
    pub fn description(&self) -> String {
        let (frames, swing) = (self.frames, self.swing_deg);
        let how = match self.motion {
            StoneMotion::Turn => format!("turning about its axis, {}", self.rest.description()),
            StoneMotion::Rock => {
                let azimuth = self.rest.azimuth_deg;
                format!("rocking {swing} degrees to and fro toward {azimuth}, {}", self.rest.description())
            }
            StoneMotion::Wobble => format!("leaning {swing} degrees toward all azimuths in turn"),
        };
        format!("{how}, {frames} frames")
    }
}

impl SpinPose {
    /// Returns the view of the frame.
    pub fn view(&self) -> View {
        self.viewpoint.view().of_turned(DQuat::from_rotation_z(self.turned_deg.to_radians()))
    }

    /// Describes the position of the stone, to a tenth of a degree.
    pub fn words(&self) -> String {
        let Viewpoint { lean, tilt_deg, azimuth_deg, .. } = self.viewpoint;
        let tenths = |degrees: f64| (degrees * 10.0).round() / 10.0 + 0.0;
        let (tilt, azimuth) = (tenths(tilt_deg), tenths(azimuth_deg));
        let leaning = match lean {
            Lean::Stone => format!("tilted {}° toward {azimuth}°", fixed(tilt, 1)),
            Lean::Eye => format!("eye moved {}° toward {azimuth}°", fixed(tilt, 1)),
        };
        match self.motion {
            StoneMotion::Turn if tilt_deg == 0.0 => format!("turned {:.1}°", self.turned_deg),
            StoneMotion::Turn => format!("turned {:.1}°, {leaning}", self.turned_deg),
            StoneMotion::Rock | StoneMotion::Wobble => leaning,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(motion: StoneMotion, tilt_deg: f64, frames: u32) -> SpinMotion {
        let rest = Viewpoint { tilt_deg, azimuth_deg: 22.5, ..Viewpoint::default() };
        SpinMotion { motion, rest, swing_deg: 30.0, frames }
    }

    #[test]
    fn a_rocking_stone_begins_at_rest_reaches_both_ends_and_comes_back_without_a_jump() {
        let poses = motion(StoneMotion::Rock, 5.0, 48).poses();
        let tilts: Vec<f64> = poses.iter().map(|pose| pose.viewpoint.tilt_deg).collect();
        assert_eq!((tilts[0], tilts[12], tilts[24], tilts[36]), (5.0, 35.0, 5.0, -25.0));
        // No step is longer than the first, also from the last frame to the first.
        let steps = (0..48).map(|k| (tilts[(k + 1) % 48] - tilts[k]).abs());
        let most = tilts[1] - tilts[0];
        assert!(steps.into_iter().all(|step| step <= most + 1e-5), "{tilts:?}");
        assert!(poses.iter().all(|pose| pose.turned_deg == 0.0 && pose.viewpoint.azimuth_deg == 22.5));
    }

    #[test]
    fn turns_and_wobbles_go_once_around_in_even_steps() {
        let turn = motion(StoneMotion::Turn, 10.0, 8).poses();
        assert!(turn.iter().map(|pose| pose.turned_deg).eq((0..8).map(|k| 45.0 * f64::from(k))));
        assert!(turn.iter().all(|pose| pose.viewpoint == turn[0].viewpoint));
        let wobble = motion(StoneMotion::Wobble, 0.0, 4).poses();
        let azimuths = wobble.iter().map(|pose| pose.viewpoint.azimuth_deg);
        assert!(azimuths.eq([22.5, 112.5, 202.5, 292.5]));
        assert!(wobble.iter().all(|pose| pose.viewpoint.tilt_deg == 30.0));
    }

    #[test]
    fn words_say_how_the_stone_stands() {
        let words = |m, tilt, k: usize| motion(m, tilt, 48).poses()[k].words();
        assert_eq!(words(StoneMotion::Rock, 0.0, 0), "tilted 0.0° toward 22.5°");
        assert_eq!(words(StoneMotion::Rock, 0.0, 25), "tilted -3.9° toward 22.5°");
        assert_eq!(words(StoneMotion::Turn, 0.0, 6), "turned 45.0°");
        assert_eq!(words(StoneMotion::Turn, 9.0, 6), "turned 45.0°, tilted 9.0° toward 22.5°");
        assert_eq!(words(StoneMotion::Wobble, 0.0, 24), "tilted 30.0° toward 202.5°");
        let text = motion(StoneMotion::Rock, 0.0, 48).description();
        assert_eq!(text, "rocking 30 degrees to and fro toward 22.5, table side, 48 frames");
    }
}
