//! Options that several commands share: the viewpoint, and the settings by which light is traced.

use super::choice::{TRACERS, one_of};
use super::picture_options::allowed;
use super::specimen::{LoadedSpecimen, note_colour};
use brillianteer_base::{Failure, nearest};
use brillianteer_files::scope_file;
use brillianteer_measure::STANDARD_ERROR;
use brillianteer_optics::{INDICES, INDICES_IN_WORDS, Material, line};
use brillianteer_paper::export::Viewing;
use brillianteer_picture::{PictureName, Scoped};
use brillianteer_render::{Renderer, Unfit, Wanted};
use brillianteer_scene::{Glare, HEAD, Lean, Medium, Projection, Side, Viewpoint};
use clap::{Args, ValueEnum};
use std::path::Path;

/// The reason why the text of an option cannot be read.
#[derive(Debug, Clone, thiserror::Error)]
pub enum OptionError {
    /// The text is not a number.
    #[error("a number is expected, such as 15 or 0.5")]
    Number,
    /// The text is not the angle by which a stone rocks.
    #[error("give an angle above 0 and up to 45 degrees")]
    RockAngle,
    /// The text is not the diameter of a pupil.
    #[error("give a diameter above 0 and up to 50 mm")]
    Pupil,
    /// The text is not the size of a picture, whose sides have at most so many pixels.
    #[error("give 16 to {0} pixels, or WIDTHxHEIGHT such as 1600x900")]
    FilmSize(u32),
}

/// Parses a number on the command line.
pub fn number(text: &str) -> Result<f64, OptionError> {
    text.trim().parse().map_err(|_| OptionError::Number)
}

/// Parses the angle in degrees by which a stone rocks.
pub fn rock_angle(text: &str) -> Result<f64, OptionError> {
    let angle = number(text)?;
    if angle > 0.0 && angle <= 45.0 { Ok(angle) } else { Err(OptionError::RockAngle) }
}

/// Parses the diameter of an eye's pupil, mm.
pub fn pupil_diameter(text: &str) -> Result<f64, OptionError> {
    let diameter = number(text)?;
    if diameter > 0.0 && diameter <= 50.0 { Ok(diameter) } else { Err(OptionError::Pupil) }
}

/// Returns the error of a job that the chosen tracer cannot do, with the options that help.
pub fn unfit(why: &Unfit, file: &str) -> Failure {
    let options = match why {
        Unfit::Perspective => "--tracer ray, or no --perspective",
        Unfit::NotAlone | Unfit::Metal | Unfit::Frosted => "--tracer ray",
        Unfit::Mixture => "--tracer ray, or --strength 1",
        Unfit::FewBounces => "--tracer ray, or --bounces 64",
        Unfit::Job(_)
        | Unfit::Eye
        | Unfit::NoStone
        | Unfit::NotConvex(_)
        | Unfit::OnlyBeams
        | Unfit::ManyPaths => {
            return why.failure(file);
        }
    };
    Failure::Usage(format!("{why} ({options})"))
}

/// The viewpoint from which the stone is seen.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "View")]
pub struct ViewOptions {
    /// The side of the stone that faces the eye (hearts and arrows have their own)
    #[arg(long, value_enum, default_value_t = SideName::Table)]
    pub side: SideName,
    /// Tilt the stone by DEGREES under a fixed eye and scope, its table leaning toward --azimuth
    #[arg(
        long,
        value_name = "DEGREES",
        default_value_t = 0.0,
        value_parser = number,
        conflicts_with = "eye_tilt"
    )]
    pub tilt: f64,
    /// Move the eye by DEGREES toward --azimuth; the light stays with the stone
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, value_parser = number)]
    pub eye_tilt: f64,
    /// The azimuth of a tilt, in the stone's frame (0 is the middle of bezel 1)
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, value_parser = number)]
    pub azimuth: f64,
    /// See the stone in perspective from DISTANCE, in girdle radii (traced by rays: without a graphics card a large picture takes minutes)
    #[arg(long, value_name = "DISTANCE", value_parser = number)]
    pub perspective: Option<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum SideName {
    Table,
    Culet,
}

impl ViewOptions {
    /// Returns the viewpoint that the options describe.
    ///
    /// # Errors
    /// Fails where a tilt, azimuth or distance is out of its range.
    pub fn viewpoint(&self) -> Result<Viewpoint, Failure> {
        let side = if self.side == SideName::Table { Side::Table } else { Side::Culet };
        let (lean, tilt_deg) =
            if self.eye_tilt == 0.0 { (Lean::Stone, self.tilt) } else { (Lean::Eye, self.eye_tilt) };
        if !(-90.0..=90.0).contains(&tilt_deg) {
            return Err(Failure::Usage(format!(
                "a tilt of {tilt_deg} degrees is not from -90 to 90; use --side to turn over"
            )));
        }
        if !self.azimuth.is_finite() {
            return Err(Failure::Usage(format!("an azimuth of {} is not a finite angle", self.azimuth)));
        }
        let projection = match self.perspective {
            None => Projection::Orthographic,
            Some(distance) if distance > 1.0 && distance.is_finite() => Projection::Perspective { distance },
            Some(d) => {
                return Err(Failure::Usage(format!(
                    "--perspective {d}: give a distance above 1 girdle radius"
                )));
            }
        };
        Ok(Viewpoint { side, lean, tilt_deg, azimuth_deg: self.azimuth, projection })
    }
}

/// The settings by which light is traced.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Light")]
pub struct LightOptions {
    /// Leave glare, the light that the stone's outer surface reflects, out of figures, which otherwise list it beside the
    /// rest
    #[arg(long)]
    pub no_glare: bool,
    /// Use this refractive index instead of the material's
    #[arg(long, value_name = "N", conflicts_with = "wavelength", value_parser = number)]
    pub index: Option<f64>,
    /// Take the material's index and absorption at this wavelength in nm [default: 589.3, sodium's D line]
    #[arg(long, value_name = "NM", value_parser = number)]
    pub wavelength: Option<f64>,
    /// Block the light within DEGREES of the scope's axis, as the observer's head does (not in Ideal-Scope, hearts
    /// and arrows, which have their own hole for the eye; measures and contrast maps have 15 degrees at 0)
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, value_parser = number)]
    pub head: f64,
    /// Follow the beams until no more than this part of the light is unresolved, and estimate nothing in figures [default:
    /// 0.001 for pictures, 0.00015 for figures with --exact]
    #[arg(long, value_name = "PART", value_parser = number)]
    pub unresolved: Option<f64>,
    /// Estimate nothing in figures by exact beams: follow the beams until little light is unresolved. Otherwise rays estimate
    /// where the light goes that fewer beams leave
    #[arg(long)]
    pub exact: bool,
    /// Treat the light as unpolarised at every surface, to compare with programs that do so
    #[arg(long)]
    pub unpolarised: bool,
    /// The tracer of the light
    #[arg(long, value_parser = one_of(&TRACERS), default_value = "auto")]
    pub tracer: Wanted,
}

/// Returns the scope of this name that comes with the program, or reads a scope file. A file goes before a name.
pub fn scoped(given: &Path) -> Result<Scoped, Failure> {
    let name = given.to_string_lossy();
    let known = PictureName::of_key(&name).and_then(PictureName::scoped);
    if let Some(scoped) = known.filter(|_| !given.is_file()) {
        return Ok(scoped);
    }
    let is_name = !given.exists() && given.components().count() == 1 && given.extension().is_none();
    if is_name {
        let scopes = PictureName::ALL.into_iter().filter(|name| name.scoped().is_some());
        let known: Vec<&str> = scopes.map(PictureName::key).collect();
        let meant = nearest(&name.to_lowercase(), &known);
        let meant = meant.map_or(String::new(), |near| format!("; did you mean '{near}'?"));
        return Err(Failure::Usage(format!(
            "--scope {name}: give the file of a scope, or one of {}{meant}",
            known.join(", ")
        )));
    }
    let scope = scope_file::read(given)?;
    Ok(Scoped { scope, side: None, takes_head: true })
}

impl LightOptions {
    /// Returns the view and tracing of a specimen: its viewpoint, medium, observer and tracer, without glare in
    /// pictures.
    pub fn viewing<'a>(
        &self,
        specimen: &'a LoadedSpecimen,
        view: &ViewOptions,
        renderer: &Renderer,
    ) -> Result<Viewing<'a>, Failure> {
        let viewpoint = view.viewpoint()?;
        note_colour(&specimen.material);
        let viewing = Viewing {
            specimen,
            file: &specimen.path,
            viewpoint,
            turned_deg: 0.0,
            medium: self.medium(specimen)?,
            wavelength_nm: self.index.is_none().then(|| self.wavelength()),
            head_deg: self.head()?,
            unresolved: self.unresolved()?,
            standard_error: (!self.exact && self.unresolved.is_none()).then_some(STANDARD_ERROR),
            polarised: !self.unpolarised,
            glare: self.no_glare.then_some(Glare::LeftOut),
            tracer: self.tracer,
        };
        Self::check(&viewing, specimen, renderer)?;
        Ok(viewing)
    }

    /// Refuses a view that the chosen tracer cannot trace, and says what to do instead.
    fn check(viewing: &Viewing, specimen: &LoadedSpecimen, renderer: &Renderer) -> Result<(), Failure> {
        match viewing.plans_beams(renderer) {
            // The error of an eye that sees nothing comes later, from each picture, because it depends on the side
            // that the picture shows.
            Err(Unfit::Eye) | Ok(_) => Ok(()),
            Err(why) => Err(unfit(&why, &specimen.path)),
        }
    }

    /// Returns the chosen wavelength, in nm.
    fn wavelength(&self) -> f64 {
        self.wavelength.unwrap_or(line::SODIUM_D)
    }

    /// Returns the stone's medium at the chosen wavelength. Warns outside the range in which the material was measured.
    fn medium(&self, specimen: &LoadedSpecimen) -> Result<Medium, Failure> {
        let wavelength = checked_wavelength(self.wavelength())?;
        let material = &specimen.material;
        let index = match self.index {
            Some(index) => index,
            None => material.dispersion.try_index(wavelength).map_err(|error| {
                match (self.wavelength, material.valid_nm) {
                    (Some(nm), Some((first, last))) if !material.is_valid_at(nm) => Failure::Usage(format!(
                        "--wavelength {nm}: {} was measured from {first} to {last} nm and has no index there",
                        material.name
                    )),
                    _ => Failure::Input(format!("{}: {}: {error}", specimen.path, material.name)),
                }
            })?,
        };
        if !INDICES.contains(&index) {
            return Err(Failure::Usage(format!("an index of {index} is not from {INDICES_IN_WORDS}")));
        }
        if let Some(warning) = extrapolation(material, wavelength).filter(|_| self.index.is_none()) {
            specimen.say(&warning);
        }
        let radius_mm = specimen.design.diameter_mm / 2.0;
        Ok(Medium { index, absorption: Medium::absorption_of(material, wavelength, radius_mm), spread: 0.0 })
    }

    /// Returns the half angle of the observer's head, in degrees, if heads may have it.
    fn head(&self) -> Result<f64, Failure> {
        checked_head(self.head)
    }

    /// Returns the part of the light that may stay unresolved, if it is between 0 and 1.
    fn unresolved(&self) -> Result<Option<f64>, Failure> {
        match self.unresolved {
            Some(part) if !(part > 0.0 && part < 1.0) => Err(Failure::Usage(format!(
                "--unresolved {part}: give a part of the light between 0 and 1, such as 0.001"
            ))),
            part => Ok(part),
        }
    }
}

/// Returns a wavelength in nm, if it is that of light.
pub fn checked_wavelength(nm: f64) -> Result<f64, Failure> {
    if (100.0..=100_000.0).contains(&nm) {
        Ok(nm)
    } else {
        Err(Failure::Usage(format!("a wavelength of {nm} nm is not light; give 100 to 100000 nm")))
    }
}

/// Returns a warning for a wavelength, in nm, outside the range in which a material was measured; `None` inside it.
pub fn extrapolation(material: &Material, nm: f64) -> Option<String> {
    let (first, last) = material.valid_nm.filter(|_| !material.is_valid_at(nm))?;
    let range = format!("{} was measured from {first} to {last} nm", material.name);
    Some(format!("{range}; its index at {nm} nm is extrapolated"))
}

/// Returns the half angle of an observer's head, in degrees.
///
/// # Errors
/// Fails where it is out of the range of heads.
pub fn checked_head(degrees: f64) -> Result<f64, Failure> {
    allowed("head", degrees, &HEAD)
}
