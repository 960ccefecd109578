//! `spin`: writes an animation of stones that turn, rock or wobble, and its numbered frames.

use super::console::{say, written};
use super::options::{ViewOptions, number};
use super::picture_options::{FinishOptions, PictureOptions};
use super::picturing::PictureSetup;
use super::progress::WorkProgress;
use super::specimen::stem;
use crate::io::{Failure, Frames, is_standard, write_apng, write_rgba_png};
use crate::picture::Background;
use crate::scene::View;
use clap::{Args, ValueEnum};
use glam::DQuat;
use std::f64::consts::TAU;
use std::path::PathBuf;
use std::sync::Arc;

#[derive(Debug, Args)]
pub struct Spin {
    /// A design, a mesh, a scene file, or the name of a cut or scene that comes with the program
    file: PathBuf,
    /// Folder to write to: the animation NAME-spin.png, and its frames in NAME-spin/
    #[arg(long, default_value = "out")]
    out: PathBuf,
    /// How the stone moves
    #[arg(long, value_enum, default_value_t = Motion::Turn)]
    motion: Motion,
    /// Frames of one round
    #[arg(long, value_name = "N", default_value_t = 48, value_parser = clap::value_parser!(u32).range(2..=3600))]
    frames: u32,
    /// Seconds of one round
    #[arg(long, value_name = "SECONDS", default_value_t = 4.0, value_parser = number)]
    seconds: f64,
    /// How far the stone rocks or wobbles
    #[arg(long, value_name = "DEGREES", default_value_t = 15.0, value_parser = number)]
    swing: f64,
    #[command(flatten)]
    view: ViewOptions,
    #[command(flatten)]
    picture: PictureOptions,
    #[command(flatten)]
    finish: FinishOptions,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Motion {
    /// About its own axis, while eye and light stay; --tilt or --eye-tilt shows more of its side
    Turn,
    /// To and fro toward --azimuth
    Rock,
    /// Its table leans toward one azimuth after the other, all around
    Wobble,
}

impl Spin {
    pub fn run(&self) -> Result<(), Failure> {
        if self.out.extension().is_some_and(|e| e.eq_ignore_ascii_case("png")) && !self.out.is_dir() {
            return Err(Failure::Usage("--out: give a folder; the frames go there as well".into()));
        }
        if is_standard(&self.out) {
            return Err(Failure::Usage("--out -: several files are written; give a folder".into()));
        }
        let viewpoint = self.view.viewpoint()?;
        let delay_ms = self.delay_ms()?;
        self.check_swing()?;
        let studio = PictureSetup::load((&self.picture, &self.finish), &self.file, viewpoint)?
            .with_what_has_a_distance()?;
        let first = studio.viewpoint.view();
        let stones = Arc::new(studio.assembly.setting.clone());
        let frames: Vec<View> = (0..self.frames).map(|k| self.frame(&first, k)).collect();
        // One size of pixel for all frames: the stones fit in every frame and keep their size.
        let mut pixels = frames.iter().map(|view| studio.pixel(&stones, view));
        let pixel = pixels.try_fold(0.0_f64, |most, pixel| pixel.map(|p| most.max(p)))?;
        let name = format!("{}{}-spin", stem(&self.file), viewpoint.suffix());
        let folder = self.out.join(&name);
        let path = self.out.join(format!("{name}.png"));
        let [width, height] = self.picture.size;
        let animation = Frames {
            count: self.frames,
            size: (width, height),
            delay_ms,
            transparent: studio.develop.background == Background::Transparent,
        };
        let description =
            format!("{}, {} frames; {}", studio.assembly.name, self.frames, studio.description());
        let bar = WorkProgress::new(&format!("{}: spin", studio.assembly.name));
        let mut moves = false;
        write_apng(&path, animation, &description, |animation| -> Result<(), Failure> {
            let mut first: Option<Vec<u8>> = None;
            for (number, view) in frames.iter().enumerate() {
                let done = |part: f64| bar.watch()((number as f64 + part) / frames.len() as f64);
                let job = studio.job(&stones, view, pixel);
                let mut taken = studio.take(&job, &done)?;
                let rgba = studio.finish(&job).pixels(&mut taken.light, &done)?;
                let still = folder.join(format!("{:04}.png", number + 1));
                write_rgba_png(&still, &rgba, (width, height), &taken.description)?;
                animation.push(&rgba)?;
                let same = first.get_or_insert_with(|| rgba.clone()) == &rgba;
                moves |= !same;
            }
            Ok(())
        })?;
        drop(bar);
        if !moves {
            let frames = self.frames;
            say(&format!(
                "note: all {frames} frames look the same because of the symmetry of the stone; give another number"
            ));
        }
        written(&path)
    }

    /// Returns how long each frame is shown, in milliseconds.
    fn delay_ms(&self) -> Result<u16, Failure> {
        let delay = (1000.0 * self.seconds / f64::from(self.frames)).round();
        if (1.0..=f64::from(u16::MAX)).contains(&delay) {
            return Ok(delay as u16);
        }
        let (seconds, frames) = (self.seconds, self.frames);
        let message =
            format!("--seconds {seconds}: {frames} frames of {delay} ms; each may take 1 to 65535 ms");
        Err(Failure::Usage(message))
    }

    fn check_swing(&self) -> Result<(), Failure> {
        let tilt = if self.view.eye_tilt == 0.0 { self.view.tilt } else { self.view.eye_tilt };
        match self.motion {
            Motion::Wobble if tilt != 0.0 => Err(Failure::Usage(
                "--motion wobble: --swing is the tilt; leave out --tilt and --eye-tilt".into(),
            )),
            Motion::Rock | Motion::Wobble if !(0.0..=90.0 - tilt.abs()).contains(&self.swing) => {
                Err(Failure::Usage(format!(
                    "--swing {}: with the tilt it must be from 0 to 90 degrees",
                    self.swing
                )))
            }
            _ => Ok(()),
        }
    }

    /// Returns the view of a frame. Whatever moves, the stones stay as they are.
    fn frame(&self, first: &View, number: u32) -> View {
        let part = TAU * f64::from(number) / f64::from(self.frames);
        let swing = self.swing.to_radians();
        match self.motion {
            Motion::Turn => first.of_turned(DQuat::from_rotation_z(part)),
            Motion::Rock => View { tilt: first.tilt + swing * part.sin(), ..*first },
            Motion::Wobble => View { tilt: swing, azimuth: first.azimuth + part, ..*first },
        }
    }
}
