//! `spin`: writes an animation of stones that turn, rock or wobble, under light or in a scope, and its numbered frames.

use super::console::{say, written};
use super::options::{ViewOptions, number};
use super::picture_options::{FinishOptions, PictureOptions};
use super::progress::WorkProgress;
use super::specimen::{note_no_fire, stem};
use super::spin_motion::{SpinMotion, SpinPose, StoneMotion};
use super::spin_panel::{CurveSettings, LEAST_PLOTTED, ONLY_TILTS, SpinCurves, SpinPanel};
use super::spin_pictures::{LitPictures, ScopeSetup, SpinPictures};
use brillianteer_base::Failure;
use brillianteer_files::{check_writable, is_standard};
use brillianteer_measure::{MEASURES_HEAD_DEG, MeasureName};
use brillianteer_paper::export::LEAST_CAPTIONED;
use brillianteer_paper::plot::COLOURS_OF_CURVES;
use brillianteer_paper::{AnimationFormat, Frames, write_animation, write_rgba_png};
use brillianteer_scene::Viewpoint;
use clap::Args;
use std::path::PathBuf;

/// The options that apply only to pictures under light.
const OF_LIGHT: [&str; 18] = [
    "light",
    "turn",
    "upright",
    "wavelengths",
    "samples",
    "unadapted",
    "exposure",
    "tone",
    "background",
    "photo_distance",
    "moment",
    "movement",
    "no_jitter",
    "strength",
    "bounces",
    "glow",
    "smoothing",
    "overlay",
];

#[derive(Debug, Args)]
pub struct Spin {
    /// A design, a mesh, a scene file, or the name of a cut or scene that comes with the program
    file: PathBuf,
    /// File (.png, .gif or .mp4) or folder to write to; into a folder go the animation NAME-spin.png, and its frames in
    /// NAME-spin/
    #[arg(short, long, default_value = "out")]
    out: PathBuf,
    /// The motion of the stone
    #[arg(long, value_enum, default_value_t = StoneMotion::Turn)]
    motion: StoneMotion,
    /// Frames of one round
    #[arg(long, value_name = "N", default_value_t = 48, value_parser = clap::value_parser!(u32).range(2..=3600))]
    frames: u32,
    /// Seconds of one round
    #[arg(long, value_name = "SECONDS", default_value_t = 4.0, value_parser = number)]
    seconds: f64,
    /// The greatest angle by which the stone rocks or wobbles
    #[arg(long, value_name = "DEGREES", default_value_t = 15.0, value_parser = number)]
    swing: f64,
    /// Show one stone in a scope instead of under light: a scope's name (see `scopes`) or its file
    #[arg(long, value_name = "SCOPE", conflicts_with_all = OF_LIGHT)]
    scope: Option<PathBuf>,
    /// Draw how a measure changes with the tilt of a rocking stone, or with the azimuth of a wobbling one, under the pictures,
    /// with a mark at the present one; measures are named as for `sweep`; may be repeated
    #[arg(long = "of", value_name = "MEASURE")]
    measures: Vec<MeasureName>,
    /// Write a caption under the pictures: their content, and the position of the stone
    #[arg(long)]
    caption: bool,
    #[command(flatten)]
    view: ViewOptions,
    #[command(flatten)]
    picture: PictureOptions,
    #[command(flatten)]
    finish: FinishOptions,
    /// What the options add to the default names of files.
    #[arg(skip)]
    pub told_apart: String,
}

/// The output of an animation: its file, and the folder of its frames.
struct SpinOutput {
    path: PathBuf,
    /// The folder of the frames; `None` where no frames are written.
    stills: Option<PathBuf>,
}

impl Spin {
    pub fn run(&self) -> Result<(), Failure> {
        let asked = self.view.viewpoint()?;
        // Faults of the command line are reported before anything is loaded.
        let format = self.format()?;
        let delay_ms = self.delay_ms(format)?;
        self.check_swing()?;
        self.check_panel()?;
        let options = (&self.picture, &self.finish);
        match &self.scope {
            None => {
                let pictures = LitPictures::load(options, &self.file, asked)?;
                let motion = self.motion(pictures.rest());
                let poses = motion.poses();
                let pictures = pictures.fitting(&poses)?;
                self.write((&pictures, ""), (&motion, &poses), (asked, format, delay_ms))
            }
            Some(scope) => {
                let setup = ScopeSetup::load(options, &self.file, scope)?;
                let motion = self.motion(asked);
                let poses = motion.poses();
                let pictures = setup.pictures(&motion, &poses)?;
                self.write((&pictures, setup.name()), (&motion, &poses), (asked, format, delay_ms))
            }
        }
    }

    fn motion(&self, rest: Viewpoint) -> SpinMotion {
        SpinMotion { motion: self.motion, rest, swing_deg: self.swing, frames: self.frames }
    }

    /// Writes the animation, and its frames where a folder is given. `scope` is the scope's name.
    fn write(
        &self,
        (pictures, scope): (&dyn SpinPictures, &str),
        (motion, poses): (&SpinMotion, &[SpinPose]),
        (asked, format, delay_ms): (Viewpoint, AnimationFormat, u16),
    ) -> Result<(), Failure> {
        let transparent = pictures.is_transparent();
        if transparent && format == AnimationFormat::Mp4 {
            return Err(Failure::Usage(
                "--background transparent: MP4 has no cover; give a .png or a .gif".into(),
            ));
        }
        let curves = self.curves(pictures, (motion, poses))?;
        let [width, height] = self.picture.size;
        let panel = SpinPanel::new((pictures, width), poses, self.caption, curves)?;
        let size = (width, height + panel.height());
        let output = self.output(format, &asked, scope);
        check_writable(&output.path)?;
        let (count, exact) = (self.frames, pictures.exact_colours());
        let animation = Frames { count, size, delay_ms, transparent, exact };
        let title = pictures.title();
        let description = format!("{title}, {}; {}", motion.description(), pictures.description());
        let bar = WorkProgress::new(&format!("{title}: spin"));
        let mut moves = false;
        write_animation((&output.path, format), &animation, &description, |file| -> Result<(), Failure> {
            let mut first: Option<Vec<u8>> = None;
            for (number, pose) in poses.iter().enumerate() {
                let done = |part: f64| bar.watch()((number as f64 + part) / poses.len() as f64);
                let mut taken = pictures.take(number, pose, &done)?;
                let same = first.get_or_insert_with(|| taken.rgba.clone()) == &taken.rgba;
                moves |= !same;
                panel.add(pose, &mut taken.rgba)?;
                if let Some(folder) = &output.stills {
                    let still = folder.join(format!("{:04}.png", number + 1));
                    write_rgba_png(&still, &taken.rgba, size, &taken.description)?;
                }
                file.push(&taken.rgba)?;
            }
            Ok(())
        })?;
        drop(bar);
        if !moves {
            let why = match self.motion {
                StoneMotion::Turn => " because of the symmetry of the stone; give another number",
                StoneMotion::Rock | StoneMotion::Wobble => "; give more --frames or a larger --swing",
            };
            say(&format!("note: all {} frames look the same{why}", self.frames));
        }
        written(&output.path)
    }

    /// Takes the measures whose curves are drawn; `None` where the options name none.
    fn curves(
        &self,
        pictures: &dyn SpinPictures,
        motion: (&SpinMotion, &[SpinPose]),
    ) -> Result<Option<SpinCurves>, Failure> {
        if self.measures.is_empty() {
            return Ok(None);
        }
        let Some(design) = pictures.design()? else {
            return Err(Failure::Usage("--of: measures are of one stone, and this is a scene".into()));
        };
        if let Ok(material) = design.material.material() {
            note_no_fire(&material, self.measures.iter().copied(), "by --material");
        }
        let settings = CurveSettings {
            measures: &self.measures,
            head_deg: self.picture.head.unwrap_or(MEASURES_HEAD_DEG),
            polarised: !self.picture.unpolarised,
        };
        let bar = WorkProgress::new(&format!("{}: measures", pictures.title()));
        SpinCurves::of(design, settings, motion, &bar.watch()).map(Some)
    }

    /// Says whether `--out` is a single file, and not a folder.
    fn is_file(&self) -> bool {
        AnimationFormat::of_name(&self.out).is_some() && !self.out.is_dir()
    }

    /// Returns the format of the animation.
    fn format(&self) -> Result<AnimationFormat, Failure> {
        const OTHERS: [&str; 17] = [
            "apng", "jpg", "jpeg", "webp", "avif", "tif", "tiff", "bmp", "hdr", "svg", "exr", "webm", "mkv",
            "mov", "avi", "m4v", "ogv",
        ];
        let refused = |text: String| Err(Failure::Usage(format!("--out{text}")));
        if is_standard(&self.out) {
            return refused(" -: give a file or a folder".into());
        }
        let ending = self.out.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        if let Some(ending) = ending.filter(|e| OTHERS.contains(&e.as_str()) && !self.out.is_dir()) {
            return refused(format!(": .{ending} is not written; give a .png, a .gif, an .mp4 or a folder"));
        }
        let format = AnimationFormat::of_name(&self.out).filter(|_| self.is_file());
        let format = format.unwrap_or(AnimationFormat::Apng);
        if !format.is_built_in() {
            return refused(format!(
                ": this program was built without .{}; give a .png or a .gif, or build it with `--features video`",
                format.ending()
            ));
        }
        Ok(format)
    }

    /// Returns the output of the animation. In a folder its name is that of the stone with the viewpoint's suffix and
    /// the scope.
    fn output(&self, format: AnimationFormat, asked: &Viewpoint, scope: &str) -> SpinOutput {
        if self.is_file() {
            return SpinOutput { path: self.out.clone(), stills: None };
        }
        let scope = if scope.is_empty() { String::new() } else { format!("-{scope}") };
        let name = format!("{}{}{}{scope}-spin", stem(&self.file), self.told_apart, asked.suffix());
        let path = self.out.join(format!("{name}.{}", format.ending()));
        SpinOutput { path, stills: Some(self.out.join(name)) }
    }

    /// Returns the time that each frame is shown, in milliseconds.
    fn delay_ms(&self, format: AnimationFormat) -> Result<u16, Failure> {
        let delay = (1000.0 * self.seconds / f64::from(self.frames)).round();
        let [least, most] = format.delays_ms();
        if (f64::from(least)..=f64::from(most)).contains(&delay) {
            return Ok(delay as u16);
        }
        let (seconds, frames) = (self.seconds, self.frames);
        let message =
            format!("--seconds {seconds}: {frames} frames of {delay} ms; each may take {least} to {most} ms");
        Err(Failure::Usage(message))
    }

    fn check_swing(&self) -> Result<(), Failure> {
        let tilt = if self.view.eye_tilt == 0.0 { self.view.tilt } else { self.view.eye_tilt };
        match self.motion {
            StoneMotion::Wobble if tilt != 0.0 => Err(Failure::Usage(
                "--motion wobble: --swing is the tilt; leave out --tilt and --eye-tilt".into(),
            )),
            StoneMotion::Rock | StoneMotion::Wobble if !(0.0..=90.0 - tilt.abs()).contains(&self.swing) => {
                Err(Failure::Usage(format!(
                    "--swing {}: with the tilt it must be from 0 to 90 degrees",
                    self.swing
                )))
            }
            _ => Ok(()),
        }
    }

    /// Refuses options that cannot be drawn under the pictures: more curves than can be told apart, curves of a
    /// motion that does not tilt, and a plot or caption that needs wider pictures.
    fn check_panel(&self) -> Result<(), Failure> {
        let refused = |what: &str| Err(Failure::Usage(format!("--of: {what}")));
        if self.measures.len() > COLOURS_OF_CURVES {
            return refused(&format!("a plot tells {COLOURS_OF_CURVES} measures apart; give fewer"));
        }
        let takes_measures = !self.measures.is_empty();
        if takes_measures && self.motion == StoneMotion::Turn {
            return refused(ONLY_TILTS);
        }
        if takes_measures && self.view.perspective.is_some() {
            return refused("measures need parallel rays; leave out --perspective");
        }
        let width = self.picture.size[0];
        let too_narrow = |option: &str, least: u32| {
            Err(Failure::Usage(format!("--size: {width} pixels across: {option} needs {least}")))
        };
        if !self.measures.is_empty() && width < LEAST_PLOTTED {
            too_narrow("--of", LEAST_PLOTTED)
        } else if self.caption && width < LEAST_CAPTIONED {
            too_narrow("--caption", LEAST_CAPTIONED)
        } else {
            Ok(())
        }
    }
}
