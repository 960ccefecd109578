//! Options of the commands that take pictures under light. All take [`PictureOptions`]: stones, light and picture. `render`
//! and `spin` also take [`FinishOptions`]: tracing and finish.

use super::choice::{MOVEMENTS, TRACERS, one_of};
use super::options::{OptionError, number};
use super::specimen_options::SpecimenOptions;
use brillianteer_base::{Failure, NumberRow};
use brillianteer_picture::Overlay;
use brillianteer_render::Wanted;
use brillianteer_scene::{
    BACKGROUND_DISTANCE, BOUNCES, BackgroundRef, EXPOSURE, GLOW, HEAD, LIGHT_TURN, Look, Movement, STRENGTH,
    Smoothing, Tone, WAVELENGTHS,
};
use clap::Args;
use std::path::Path;

/// The largest side of a picture under light, in pixels.
pub const MOST_PIXELS: u32 = 8192;

/// Stones, light and picture.
#[derive(Debug, Clone, Args)]
pub struct PictureOptions {
    /// A light's name, a light file or an HDR panorama (.hdr, .exr); see `lights` [default: the scene's, or studio]
    #[arg(long, value_name = "LIGHT")]
    pub light: Option<String>,
    /// Turn the light about its axis, a world about its vertical, by DEGREES
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, value_parser = number)]
    pub turn: f64,
    /// Let the light's axis point up in the picture, so that its horizon lies level behind the stones, and not to the eye;
    /// worlds stand upright in any case
    #[arg(long)]
    pub upright: bool,
    /// Half angle of the observer's head, which blocks light, in DEGREES [default: the scene's, or the light's; in a scope none, for measures
    /// the usual one]
    #[arg(long, value_name = "DEGREES", value_parser = number)]
    pub head: Option<f64>,
    /// Pixels: a number for a square, or WIDTHxHEIGHT
    #[arg(long, value_name = "PIXELS", default_value = "1024", value_parser = film_size)]
    pub size: [u32; 2],
    /// Wavelengths of each sample, 1 to 64 [default: the scene's, or 16]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub wavelengths: Option<u32>,
    /// Samples of each pixel, each at its own wavelengths and, by rays, at its own place in the pixel [default: 4 by exact
    /// beams, 64 by rays]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=65536))]
    pub samples: Option<u32>,
    /// Treat the light as unpolarised at every surface
    #[arg(long)]
    pub unpolarised: bool,
    /// Show all colours as under daylight, instead of as an eye that has adapted to the light sees them
    #[arg(long)]
    pub unadapted: bool,
    /// Brighten the picture by STOPS
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, value_parser = number)]
    pub exposure: f64,
    /// Tone curve: linear, neutral or filmic [default: the scene's, or neutral]
    #[arg(long, value_name = "CURVE")]
    pub tone: Option<Tone>,
    /// The background: transparent, a colour (white, #20262e), two from top to bottom (#404850-#101215), `light` for the
    /// light itself, a world (sunset, room, city), a pattern (page, grid, checks, stripes, dots, slit), or a
    /// photograph's file; by default the scene's, or #33373d-#0e0f11
    #[arg(long, value_name = "WHAT")]
    pub background: Option<String>,
    /// The distance of the world, pattern or photograph behind the stones, in girdle radii, up to 10 m [default: the
    /// scene's, or 3]
    #[arg(long, value_name = "DISTANCE", value_parser = number)]
    pub photo_distance: Option<f64>,
    /// Show bodies SECONDS after they have begun to move, 0 to 100000: as in the editor, copies of one design tumble, and plates also
    /// wave
    #[arg(long, value_name = "SECONDS", value_parser = number)]
    pub moment: Option<f64>,
    /// How plates move by that moment: both tumble and wave, or one of these [default: the scene's, or both]
    #[arg(long, value_parser = one_of(&MOVEMENTS), value_name = "HOW", requires = "moment")]
    pub movement: Option<Movement>,
    #[command(flatten)]
    pub specimen: SpecimenOptions,
}

/// Tracing and finish of a picture; refraction maps do not use these options.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Tracing and finish")]
pub struct FinishOptions {
    /// Take the middle wavelength of each band alone in every sample, instead of another share of the band each time
    #[arg(long)]
    pub no_jitter: bool,
    /// Mix each refracted ray with the straight ray: 1 is physics, 0 the straight ray alone. Below 1 the picture is traced
    /// by rays [default: the scene's, or 1]
    #[arg(long, value_name = "PART", value_parser = number)]
    pub strength: Option<f64>,
    /// Follow light through at most N bounces inside a stone, 1 to 64, to see what each adds; the rest of the light
    /// is dark. Below 64 the picture is traced by rays [default: the scene's, or 64]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub bounces: Option<u32>,
    /// The tracer of the light; beams are for one convex stone without a photograph behind
    #[arg(long, value_parser = one_of(&TRACERS), default_value = "auto")]
    pub tracer: Wanted,
    /// Part of the light of sparkles that is spread as glow, 0 to 1 [default: the scene's, or 0.16]
    #[arg(long, visible_alias = "bloom", value_name = "PART", value_parser = number)]
    pub glow: Option<f64>,
    /// Smooth edges beyond what samples do: `none`; `fxaa`, in the finished picture, for few samples; or `temporal`, as the
    /// editor does while anything moves: samples, and the frames of `spin`, are blended one after the other, the newest by
    /// half, or by PART with temporal:PART
    #[arg(long, value_name = "HOW", default_value_t = Smoothing::None)]
    pub smoothing: Smoothing,
    /// Overlays to draw over the stones, separated by commas: wireframe, facets, bounces, unresolved, total (how
    /// often light is totally reflected before the first light leaves)
    #[arg(long, value_name = "WHAT", value_delimiter = ',')]
    pub overlay: Vec<Overlay>,
}

impl Default for FinishOptions {
    /// Returns rays on the processor at the scene's strength, without glow and overlays.
    fn default() -> Self {
        Self {
            no_jitter: false,
            strength: None,
            bounces: None,
            tracer: Wanted::Rays,
            glow: Some(0.0),
            smoothing: Smoothing::None,
            overlay: vec![],
        }
    }
}

/// Returns the value of the option `--key` if it is from `least` to `most`, and a usage error otherwise.
pub fn within(key: &str, value: f64, [least, most]: [f64; 2]) -> Result<f64, Failure> {
    if (least..=most).contains(&value) {
        return Ok(value);
    }
    Err(Failure::Usage(format!("--{key} {value}: give {least} to {most}")))
}

/// Returns the value of the option `--key` if the number of this row may have it, and a usage error otherwise.
pub fn allowed<T>(key: &str, value: f64, row: &NumberRow<T>) -> Result<f64, Failure> {
    if row.allows(value) {
        return Ok(value);
    }
    Err(Failure::Usage(format!("--{key} {value}: give {}", row.hint())))
}

impl PictureOptions {
    /// Returns what a picture of a scene is made with: what these options say, and `own`, the scene's, for all else. The turn of
    /// the light and the exposure are added to the scene's. `unit_mm` is the scene's girdle radius.
    ///
    /// # Errors
    /// Fails where a number is out of its range, or where there is no such background.
    pub fn look(&self, finish: &FinishOptions, own: &Look, unit_mm: f64) -> Result<Look, Failure> {
        let mut look = own.clone();
        let count = |count: Option<u32>| count.map(f64::from);
        for (key, row, value) in [
            ("turn", &LIGHT_TURN, Some(self.turn)),
            ("head", &HEAD, self.head),
            ("exposure", &EXPOSURE, Some(self.exposure)),
            ("wavelengths", &WAVELENGTHS, count(self.wavelengths)),
            ("glow", &GLOW, finish.glow),
            ("bounces", &BOUNCES, count(finish.bounces)),
            ("strength", &STRENGTH, finish.strength),
        ] {
            let Some(value) = value else { continue };
            (row.set)(&mut look, allowed(key, value, row)?);
        }
        look.light_turn += own.light_turn;
        look.exposure += own.exposure;
        if let Some(radii) = self.photo_distance {
            let [_, most_mm] = BACKGROUND_DISTANCE.range;
            let most = (most_mm / unit_mm).floor();
            if !(0.0..=most).contains(&radii) {
                let message =
                    format!("--photo-distance {radii}: give 0 to {most} girdle radii, {most_mm} mm here");
                return Err(Failure::Usage(message));
            }
            look.background_mm = Some(radii * unit_mm);
        }
        if let Some(light) = &self.light {
            look.light.clone_from(light);
        }
        look.light_upright |= self.upright;
        look.tone = self.tone.unwrap_or(look.tone);
        look.smoothing = finish.smoothing;
        if let Some(background) = &self.background {
            look.background = Some(BackgroundRef::read(background, Path::new(""))?);
        }
        Ok(look)
    }
}

/// Parses a picture's size in pixels: one number for a square, or WIDTHxHEIGHT.
pub fn film_size(text: &str) -> Result<[u32; 2], OptionError> {
    let side = |text: &str| match text.trim().parse() {
        Ok(side) if (16..=MOST_PIXELS).contains(&side) => Ok(side),
        _ => Err(OptionError::FilmSize(MOST_PIXELS)),
    };
    match text.split_once(['x', 'X']) {
        Some((width, height)) => Ok([side(width)?, side(height)?]),
        None => side(text).map(|side| [side; 2]),
    }
}
