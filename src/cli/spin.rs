//! `spin`: a stone that turns, rocks or wobbles, as numbered pictures and as one that moves.

use super::options::ViewOptions;
use super::picturing::{PictureOptions, Studio};
use super::progress::Progress;
use super::specimen::stem;
use super::{Failure, print};
use crate::io::{Frames, write_apng, write_rgba_png};
use crate::picture::Background;
use crate::scene::{Lean, View};
use clap::{Args, ValueEnum};
use std::f64::consts::TAU;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct Spin {
    /// A cut file, a scene file, or the name of a cut or scene that comes with the program
    file: PathBuf,
    /// Folder to write to: NAME-spin.png, which moves, and its frames in NAME-spin/
    #[arg(long, default_value = "out")]
    out: PathBuf,
    /// How it moves
    #[arg(long, value_enum, default_value_t = Motion::Turn)]
    motion: Motion,
    /// Frames of one round
    #[arg(long, value_name = "N", default_value_t = 48, value_parser = clap::value_parser!(u32).range(2..=3600))]
    frames: u32,
    /// Seconds of one round
    #[arg(long, value_name = "SECONDS", default_value_t = 4.0)]
    seconds: f64,
    /// How far it rocks or wobbles
    #[arg(long, value_name = "DEGREES", default_value_t = 15.0)]
    swing: f64,
    #[command(flatten)]
    view: ViewOptions,
    #[command(flatten)]
    picture: PictureOptions,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Motion {
    /// About its own axis, under eye and light that stay; face up unless --eye-tilt moves the eye
    Turn,
    /// To and fro toward --azimuth
    Rock,
    /// Its table leans round
    Wobble,
}

impl Spin {
    pub fn run(&self) -> Result<(), Failure> {
        if !(0.02..=3600.0).contains(&self.seconds) {
            return Err(Failure::Usage(format!("--seconds {}: give 0.02 to 3600", self.seconds)));
        }
        if !(0.0..=90.0).contains(&self.swing) {
            return Err(Failure::Usage(format!("--swing {}: give 0 to 90 degrees", self.swing)));
        }
        let first = self.view.view(None)?;
        let studio = Studio::load(&self.picture, &self.file, &first)?;
        studio.view(&self.view)?;
        let views: Vec<(View, f64)> = (0..self.frames).map(|k| self.frame(&first, k)).collect();
        // The stones keep their size: that at which they fit in every frame.
        let mut pixels = views.iter().map(|(view, _)| studio.pixel(view));
        let pixel = pixels.try_fold(0.0_f64, |most, pixel| pixel.map(|p| most.max(p)))?;
        let name = format!("{}-spin", stem(&self.file));
        let folder = self.out.join(&name);
        let path = self.out.join(format!("{name}.png"));
        let [width, height] = self.picture.size;
        let frames = Frames {
            count: self.frames,
            size: (width, height),
            delay_ms: (1000.0 * self.seconds / f64::from(self.frames)).round().clamp(1.0, 65_535.0) as u16,
            transparent: studio.develop.background == Background::Transparent,
        };
        let told = format!("{}, {} frames", studio.assembly.name, self.frames);
        let bar = Progress::new(&format!("{}: spin", studio.assembly.name));
        write_apng(&path, frames, &told, |animation| -> Result<(), Failure> {
            for (number, (view, turn)) in views.iter().enumerate() {
                let done = |part: f64| bar.watch()((number as f64 + part) / views.len() as f64);
                let taken = studio.take(view, (pixel, *turn), &done)?;
                let rgba = studio.developed(view, (pixel, *turn), &taken.picture, &done)?;
                let still = folder.join(format!("{:04}.png", number + 1));
                write_rgba_png(&still, &rgba, (width, height), &taken.told)?;
                animation.push(&rgba)?;
            }
            Ok(())
        })?;
        drop(bar);
        print(&path.display().to_string())
    }

    /// The view of a frame, and by how many degrees the light is turned in it.
    fn frame(&self, first: &View, number: u32) -> (View, f64) {
        let part = f64::from(number) / f64::from(self.frames);
        match self.motion {
            // Eye and light go round the stone together, the other way.
            Motion::Turn => {
                let azimuth = first.azimuth - TAU * part;
                (View { lean: Lean::Eye, azimuth, ..*first }, -360.0 * part)
            }
            Motion::Rock => {
                let tilt = first.tilt + self.swing.to_radians() * (TAU * part).sin();
                (View { tilt, ..*first }, 0.0)
            }
            Motion::Wobble => {
                let azimuth = first.azimuth + TAU * part;
                (View { lean: Lean::Stone, tilt: self.swing.to_radians(), azimuth, ..*first }, 0.0)
            }
        }
    }
}
