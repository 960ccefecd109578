//! What `render` and `spin` share: stones, light and camera, and taking a picture of them.

use super::Failure;
use super::assembly::Assembly;
use super::lighting::Lighting;
use super::options::ViewOptions;
use super::sampler::Sampler;
use crate::io::panorama;
use crate::optics::strata;
use crate::picture::spectral::{Remainder, expose};
use crate::picture::{Background, Bloom, ByBeams, Develop, Linear, Overlay, Tone, develop, lay};
use crate::scene::{Panorama, Projection, View};
use crate::trace::ray::{self, ByRays, Camera};
use crate::trace::sitting::Sitting;
use crate::trace::surround::{Behind, Surround};
use crate::trace::{Watch, beam};
use clap::{Args, ValueEnum};
use glam::{DQuat, DVec2};
use std::path::Path;

/// The largest side of a picture under light: it is held in memory.
pub const MOST_PIXELS: u32 = 8192;

/// Air around the stones, as a part of half the picture.
const MARGIN: f64 = 0.06;

/// What exact beams leave unresolved, and below which weight rays are given up.
const UNRESOLVED: f64 = 2e-3;
const LEAST_WEIGHT: f64 = 5e-4;

/// Beams of one wavelength: without symmetry 2e-3 would take many times as long as what else there is to do.
const MOST_BEAMS: usize = 100_000;

/// Bounces that rays are followed for.
const MOST_BOUNCES: u32 = 64;

/// Looks that a picture is made of when not told: rays need many for smooth edges, beams only for the wavelengths.
const LOOKS_OF_BEAMS: u32 = 4;
const LOOKS_OF_RAYS: u32 = 64;

/// How far behind the stones a photograph stands when not told, in girdle radii.
const PHOTO_DISTANCE: f64 = 3.0;

/// Stones, light and picture.
#[derive(Debug, Clone, Args)]
pub struct PictureOptions {
    /// A light's name, a light file or an HDR panorama (.hdr, .exr); see `lights` [default: the scene's, or studio]
    #[arg(long, value_name = "LIGHT")]
    light: Option<String>,
    /// Turn the light about its axis by DEGREES
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, allow_negative_numbers = true)]
    turn: f64,
    /// Half angle of the observer's head, which keeps out light, in DEGREES [default: the light's]
    #[arg(long, value_name = "DEGREES")]
    head: Option<f64>,
    /// A material's name, or an index, instead of the file's
    #[arg(long, value_name = "MATERIAL")]
    material: Option<String>,
    /// The stone's size, such as 6.5mm or 1.2ct, instead of the file's
    #[arg(long, value_name = "SIZE")]
    stone: Option<crate::cut::Size>,
    /// Pixels: a number for a square, or WIDTHxHEIGHT
    #[arg(long, value_name = "PIXELS", default_value = "1024", value_parser = film_size)]
    pub size: [u32; 2],
    /// Wavelengths side by side, 1 to 64
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=64))]
    wavelengths: u32,
    /// Looks that the picture is made of, each at other wavelengths and places in the pixel [default: 4 by exact beams,
    /// 64 by rays]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=65536))]
    samples: Option<u32>,
    /// What traces the light
    #[arg(long, value_enum, default_value_t = TracerName::Auto)]
    tracer: TracerName,
    /// Let every surface see unpolarised light
    #[arg(long)]
    unpolarised: bool,
    /// See all colours as under daylight, instead of an eye that is used to the light
    #[arg(long)]
    unadapted: bool,
    /// Brighter by STOPS
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, allow_negative_numbers = true)]
    exposure: f64,
    /// Tone curve: linear, neutral or filmic
    #[arg(long, value_name = "CURVE", default_value = "neutral")]
    tone: Tone,
    /// Part of the brightest light that is spread as glow and sparkle, 0 to 1
    #[arg(long, value_name = "PART", default_value_t = Bloom::default().strength)]
    bloom: f64,
    /// What lies behind: transparent, a colour (white, #20262e), two from top to bottom (#404850-#101215), `light` for
    /// what shines, or a photograph's file
    #[arg(long, value_name = "WHAT", default_value = "#33373d-#0e0f11")]
    background: String,
    /// What to draw over the stones, separated by commas: wireframe, facets, bounces, unresolved, total (how often light is
    /// totally reflected before some leaves)
    #[arg(long, value_name = "WHAT", value_delimiter = ',')]
    overlay: Vec<Overlay>,
    /// How far behind the stones the photograph stands, in girdle radii
    #[arg(long, value_name = "DISTANCE", default_value_t = PHOTO_DISTANCE)]
    photo_distance: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum TracerName {
    /// A graphics card where there is one; else exact beams where they apply, and rays where they do not
    Auto,
    /// Exact beams, in f64: one stone, parallel rays, no photograph
    Beam,
    /// Point rays on the processor, in f64
    Ray,
    /// Point rays on a graphics card, in f32
    Gpu,
}

/// What traces a picture.
#[derive(Clone, Copy)]
enum Tracer {
    Beams,
    Rays(Sampler),
}

/// Everything that a picture is taken of, loaded once.
pub struct Studio<'a> {
    options: &'a PictureOptions,
    pub assembly: Assembly,
    lighting: Lighting,
    photo: Option<Panorama>,
    backdrop: bool,
    pub develop: Develop,
    tracer: Tracer,
}

/// A picture, and how it was made.
pub struct Taken {
    pub picture: Linear,
    pub told: String,
}

fn film_size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| match text.trim().parse() {
        Ok(side) if (16..=MOST_PIXELS).contains(&side) => Ok(side),
        _ => Err(format!("give 16 to {MOST_PIXELS} pixels, or WIDTHxHEIGHT such as 1600x900")),
    };
    match text.split_once(['x', 'X']) {
        Some((width, height)) => Ok([side(width)?, side(height)?]),
        None => side(text).map(|side| [side; 2]),
    }
}

fn within(key: &str, value: f64, least: f64, most: f64) -> Result<f64, Failure> {
    if (least..=most).contains(&value) {
        return Ok(value);
    }
    Err(Failure::Usage(format!("--{key} {value}: give {least} to {most}")))
}

impl<'a> Studio<'a> {
    /// Loads stones, light and background, and chooses the tracer for a view.
    pub fn load(options: &'a PictureOptions, file: &Path, view: &View) -> Result<Self, Failure> {
        let assembly = Assembly::load(file, options.material.as_deref(), options.stone)?;
        let own = assembly.light.as_ref().map(|light| light.display().to_string());
        let light = options.light.as_ref().or(own.as_ref());
        let mut lighting = Lighting::load(light.map_or("studio", String::as_str), None)?;
        if let Some(head) = options.head {
            lighting.light.head = within("head", head, 0.0, 89.0)?;
        }
        within("turn", options.turn, -1e6, 1e6)?;
        within("photo-distance", options.photo_distance, 0.0, 1e6)?;
        let bloom = Bloom { strength: within("bloom", options.bloom, 0.0, 1.0)?, ..Bloom::default() };
        let mut develop = Develop {
            exposure: within("exposure", options.exposure, -40.0, 40.0)?,
            tone: options.tone,
            bloom: (bloom.strength > 0.0).then_some(bloom),
            ..Develop::default()
        };
        let backdrop = options.background == "light";
        let mut photo = None;
        if !backdrop {
            match options.background.parse::<Background>() {
                Ok(background) => develop.background = background,
                Err(_) if Path::new(&options.background).exists() => {
                    let reading =
                        panorama::read_photo(Path::new(&options.background)).map_err(Failure::Input)?;
                    reading.warnings.iter().for_each(|w| super::say(&format!("warning: {w}")));
                    photo = Some(reading.panorama);
                }
                Err(why) => return Err(Failure::Usage(format!("{why}, `light`, or a photograph's file"))),
            }
        }
        let mut studio =
            Self { options, assembly, lighting, photo, backdrop, develop, tracer: Tracer::Beams };
        studio.tracer = studio.chosen(view)?;
        Ok(studio)
    }

    fn chosen(&self, view: &View) -> Result<Tracer, Failure> {
        let beams_apply = view.projection == Projection::Orthographic
            && self.assembly.setting.stones.len() == 1
            && self.photo.is_none()
            && !self.backdrop;
        match self.options.tracer {
            TracerName::Beam if !beams_apply => Err(Failure::Usage(
                "exact beams are for one stone, parallel rays and a plain background: use --tracer ray"
                    .into(),
            )),
            TracerName::Beam => Ok(Tracer::Beams),
            TracerName::Ray => Ok(Tracer::Rays(Sampler::Rays)),
            TracerName::Gpu => Ok(Tracer::Rays(Sampler::on_card())),
            TracerName::Auto => Ok(match Sampler::quickest() {
                Sampler::Rays if beams_apply => Tracer::Beams,
                sampler => Tracer::Rays(sampler),
            }),
        }
    }

    /// The view, checked against the stones: the eye must be in front of them.
    pub fn view(&self, options: &ViewOptions) -> Result<View, Failure> {
        let view = options.view(None)?;
        self.pixel(&view).map(|_| view)
    }

    /// The side of a pixel with which the stones fill the picture.
    pub fn pixel(&self, view: &View) -> Result<f64, Failure> {
        let stones = &self.assembly.setting.stones;
        let reach = stones.iter().flat_map(|s| s.polytope.vertices()).map(|v| v.length()).fold(0.0, f64::max);
        let camera = Camera::reaching(view, reach);
        let extent = stones.iter().try_fold(DVec2::ZERO, |all, s| Some(all.max(camera.extent(&s.polytope)?)));
        let Some(extent) = extent else {
            let message = "the eye of --perspective is not in front of all of it; move it farther off";
            return Err(Failure::Input(format!("{}: {message}", self.assembly.path)));
        };
        let size = DVec2::new(f64::from(self.options.size[0]), f64::from(self.options.size[1]));
        Ok((2.0 * extent * (1.0 + MARGIN) / size).max_element())
    }

    /// Takes a picture with pixels of this side; `turn` is what the light is turned further by, degrees.
    pub fn take(&self, view: &View, (pixel, turn): (f64, f64), watch: Watch) -> Result<Taken, Failure> {
        self.sit(view, (pixel, turn), |sitting| match self.tracer {
            Tracer::Beams => self.by_beams(sitting, watch),
            Tracer::Rays(sampler) => sampler.or_rays(|used| self.by_rays(used, sitting, watch)),
        })
    }

    /// A picture in eight bits, with the overlays asked for.
    pub fn developed(
        &self,
        view: &View,
        (pixel, turn): (f64, f64),
        picture: &Linear,
        watch: Watch,
    ) -> Result<Vec<u8>, Failure> {
        let mut rgba = develop(picture, &self.develop);
        for &overlay in &self.options.overlay {
            self.sit(view, (pixel, turn), |sitting| lay(overlay, sitting, &mut rgba, watch))?;
        }
        Ok(rgba)
    }

    /// What lies at a point of the picture, in pixels, in words.
    pub fn probe(&self, view: &View, pixel: f64, at: DVec2) -> String {
        let Some((stone, facet)) = self.sit(view, (pixel, 0.0), |sitting| ray::facet_at(sitting, at.x, at.y))
        else {
            return "nothing".into();
        };
        let placed = &self.assembly.setting.stones[stone];
        let name = placed.names.get(facet as usize).map_or("a facet", String::as_str);
        if self.assembly.setting.stones.len() == 1 {
            return name.into();
        }
        format!("{name} of stone {}, {}, {}", stone + 1, placed.label, placed.material.name)
    }

    /// Does work with everything in its place.
    fn sit<T>(&self, view: &View, (pixel, turn): (f64, f64), work: impl FnOnce(&Sitting) -> T) -> T {
        let turn = DQuat::from_rotation_z((self.options.turn + turn).to_radians());
        let mut basis = view.light_basis();
        let turned = |x: glam::DVec3| basis.right * x.x + basis.up * x.y + basis.toward * x.z;
        let (right, up) = (turned(turn * glam::DVec3::X), turned(turn * glam::DVec3::Y));
        (basis.right, basis.up) = (right, up);
        let distance = self.options.photo_distance;
        // Wide enough to fill the picture, whatever its shape.
        let behind = self.photo.as_ref().map(|picture| {
            let [across, down] = self.options.size.map(f64::from);
            let shape = f64::from(picture.width) / f64::from(picture.height);
            Behind {
                picture,
                distance,
                width: pixel * across.max(down * shape) * self.nearness(view, distance),
            }
        });
        work(&Sitting {
            setting: &self.assembly.setting,
            surround: Surround {
                sky: &self.lighting.sky,
                basis,
                eye: view.basis(),
                head: self.lighting.light.head.to_radians(),
                behind,
                backdrop: self.backdrop || behind.is_some(),
            },
            view,
            size: self.options.size,
            pixel,
            options: ray::Options {
                polarised: !self.options.unpolarised,
                most_bounces: MOST_BOUNCES,
                least_weight: LEAST_WEIGHT,
            },
        })
    }

    /// How much larger than in the image's plane a photograph must be to fill it from behind.
    fn nearness(&self, view: &View, behind: f64) -> f64 {
        match view.projection {
            Projection::Orthographic => 1.0,
            Projection::Perspective { distance } => (distance + behind) / distance,
        }
    }

    fn by_beams(&self, sitting: &Sitting, watch: Watch) -> Result<Taken, Failure> {
        let samples = self.options.samples.unwrap_or(LOOKS_OF_BEAMS);
        let unresolved = UNRESOLVED;
        let options = beam::Options {
            unresolved,
            polarised: !self.options.unpolarised,
            most_beams: MOST_BEAMS,
            ..beam::Options::default()
        };
        let unfit = || Failure::Usage("exact beams do not apply here: use --tracer ray".into());
        let prepare = |_| ByBeams::new(*sitting, options).ok_or_else(unfit);
        let most_rows = sitting.size[1];
        let taken = expose(sitting, (&self.strata(), samples), most_rows, prepare, watch)?;
        Ok(self.taken(taken, samples, "exact beams"))
    }

    fn by_rays(&self, sampler: Sampler, sitting: &Sitting, watch: Watch) -> Result<Taken, Failure> {
        let (strata, samples) = (self.strata(), self.options.samples.unwrap_or(LOOKS_OF_RAYS));
        let looks = (strata.as_slice(), samples);
        let taken = match sampler {
            Sampler::Rays => {
                let prepare = |rows| Ok::<_, Failure>(ByRays::new(*sitting, rows));
                expose(sitting, looks, sitting.size[1], prepare, watch)?
            }
            #[cfg(feature = "gpu")]
            Sampler::Card(gpu) => {
                use crate::trace::gpu::ByCard;
                let prepare = |rows| Ok::<_, Failure>(ByCard::new(gpu, sitting, rows, strata.len())?);
                expose(sitting, looks, ByCard::most_rows(sitting.size[0]), prepare, watch)?
            }
        };
        Ok(self.taken(taken, samples, &sampler.told()))
    }

    fn strata(&self) -> Vec<crate::optics::Stratum> {
        strata(self.options.wavelengths, &self.lighting.light.spectrum, !self.options.unadapted)
    }

    fn taken(&self, (picture, rest): (Linear, Remainder), samples: u32, tracer: &str) -> Taken {
        let light = &self.lighting.light.name;
        let polarised = if self.options.unpolarised { "unpolarised" } else { "polarised" };
        let told = format!(
            "{}; light {light}; {} wavelengths in {samples} looks, {polarised}; {tracer}, unresolved {:.2e}, absorbed \
             {:.3}",
            self.assembly.name, self.options.wavelengths, rest.unresolved, rest.absorbed
        );
        Taken { picture, told }
    }
}
