//! Measures a design: from the design to its figures in one call.

use super::figures::{Figures, by_beams};
use super::sampled::by_rays;
use crate::cut::Design;
use crate::optics::{DispersionError, line};
use crate::scene::{ASET_CONE, Backing, Medium, Scope, ScopeError, Specimen, SpecimenError, Viewpoint};
use crate::trace::{CannotTrace, Stopped, Subject, Tracer, Watch, beam, ray, unwatched};

/// The default for the part of the light that may stay unresolved. Face up it takes a few hundredths of a second, tilted
/// some seconds.
pub const UNRESOLVED: f64 = 1.5e-4;

/// The default number of rays along each side of one lattice, for figures by rays.
pub const LATTICE: u32 = 256;

/// The range of refractive indices that can be traced.
const INDICES: std::ops::RangeInclusive<f64> = 1.0..=5.0;

/// The options by which a design is measured.
#[derive(Clone)]
pub struct MeasureOptions<'a> {
    /// The direction from which the stone is seen; face up by default.
    pub viewpoint: Viewpoint,
    /// The scope: the structured light whose bands are the zones of the figures. The common ASET by default.
    pub scope: Scope,
    /// Half angle of an observer's head in front of the scope, in degrees. The head sends no light; 0, the default,
    /// means no head.
    pub head_deg: f64,
    /// Wavelength in nm at which the material's index and absorption are taken; 589.3 by default.
    pub wavelength_nm: f64,
    /// A refractive index to use instead of the material's.
    pub index: Option<f64>,
    /// How far light is followed, and with how many rays.
    pub bounds: Bounds,
    /// The tracer. `None`, the default, takes exact beams where they apply and otherwise rays on the processor.
    pub tracer: Option<Tracer<'a>>,
}

impl Default for MeasureOptions<'_> {
    fn default() -> Self {
        Self {
            viewpoint: Viewpoint::default(),
            scope: Scope::aset(ASET_CONE, Backing::Black),
            head_deg: 0.0,
            wavelength_nm: line::SODIUM_D,
            index: None,
            bounds: Bounds::default(),
            tracer: None,
        }
    }
}

/// How far light is followed, and with how many rays.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// The part of the light that may stay unresolved, above 0 and below 1. Beams are followed until no more than this
    /// part of all light is unresolved, a ray until no more than this part of its own light is left.
    pub unresolved: f64,
    /// Whether polarisation is followed; without it, every surface sees unpolarised light.
    pub polarised: bool,
    /// Rays along each side of a lattice, 1 to 16,384. Beams do not use it.
    pub lattice: u32,
}

impl Default for Bounds {
    fn default() -> Self {
        Self { unresolved: UNRESOLVED, polarised: true, lattice: LATTICE }
    }
}

/// The figures of a stone under a scope, with the scope, index and tracer that they belong to.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// The shares of the light, by the bands of `scope`.
    pub figures: Figures,
    /// The scope, with the observer's head if there is one.
    pub scope: Scope,
    /// The refractive index that was traced.
    pub index: f64,
    /// The tracer's short name: `beam`, `ray` or `gpu`.
    pub tracer: &'static str,
    light_return: f64,
    glare_return: f64,
}

/// One zone of a scope, as parts of the silhouette.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Zone {
    /// Light of this zone that the outer surface reflects.
    pub glare: f64,
    /// Light of this zone that has been inside the stone.
    pub transmitted: f64,
    /// The part of the silhouette whose strongest light from inside comes from this zone.
    pub strongest_exit_area: f64,
}

/// The reasons why a design cannot be measured.
#[derive(Debug, thiserror::Error)]
pub enum MeasureError {
    /// The design does not make a stone.
    #[error(transparent)]
    Specimen(#[from] SpecimenError),
    /// The scope is not valid.
    #[error(transparent)]
    Scope(#[from] ScopeError),
    /// The material has no index at this wavelength.
    #[error(transparent)]
    Dispersion(#[from] DispersionError),
    /// An option is out of its range. The message gives its name, its value and its range.
    #[error("{option} is {value}; give {range}")]
    Option {
        /// The option's name in [`MeasureOptions`] or [`Bounds`].
        option: &'static str,
        /// The value that was given.
        value: f64,
        /// The range that is allowed, in words.
        range: &'static str,
    },
    /// The tracer does not apply to this stone or view.
    #[error(transparent)]
    CannotTrace(#[from] CannotTrace),
    /// The graphics card failed; the processor can do the same work.
    #[cfg(feature = "gpu")]
    #[error(transparent)]
    Card(#[from] crate::trace::gpu::GpuError),
    /// The watch stopped the work.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// Measures a design: builds its stone, traces its light and sums it up by the zones of a scope.
///
/// # Errors
/// Any [`MeasureError`]: the design makes no stone, an option is out of its range, or the tracer does not apply or
/// fails.
pub fn measure(design: &Design, options: &MeasureOptions) -> Result<Measured, MeasureError> {
    options.check()?;
    let specimen = Specimen::new(design.clone())?;
    let material = &specimen.material;
    let index = options.index.map_or_else(|| material.dispersion.try_index(options.wavelength_nm), Ok)?;
    let absorption = Medium::absorption_of(material, options.wavelength_nm, specimen.unit_mm());
    let medium = Medium { index, absorption, spread: 0.0 };
    let view = options.viewpoint.view();
    let scope = options.scope.clone().with_head(options.head_deg);
    let tracer = options.tracer.unwrap_or_else(|| Tracer::best(&specimen, &view));
    let subject = Subject { specimen: &specimen, medium, view: &view, scope: &scope };
    measure_subject(subject, tracer, &options.bounds, &unwatched)
}

/// Measures a stone that is built already. `watch` receives the part that is done and may stop the work.
///
/// # Errors
/// [`MeasureError::Option`] where the medium's index or a bound is out of its range, [`MeasureError::CannotTrace`] where
/// the tracer does not apply, [`MeasureError::Stopped`], and an error of the graphics card where that fails.
pub fn measure_subject(
    subject: Subject,
    tracer: Tracer,
    bounds: &Bounds,
    watch: Watch,
) -> Result<Measured, MeasureError> {
    let Bounds { unresolved, lattice, .. } = *bounds;
    let index = subject.medium.index;
    first_wrong(&[
        ("index", index, INDICES.contains(&index), "1 (air) to 5"),
        ("unresolved", unresolved, unresolved > 0.0 && unresolved < 1.0, "a part between 0 and 1"),
        ("lattice", f64::from(lattice), (1..=16_384).contains(&lattice), "1 to 16,384"),
    ])?;
    tracer.check(subject.specimen, subject.view)?;
    let (split, below) = subject.scope.clone().with_horizon();
    let mut figures = traced(Subject { scope: &split, ..subject }, tracer, bounds, watch)?;
    let light_return = figures.light_return(&split);
    let glare_return = figures.glare_return(&split);
    if let Some(below) = below {
        figures.join(below);
    }
    let scope = subject.scope.clone();
    Ok(Measured { figures, scope, index, tracer: tracer.name(), light_return, glare_return })
}

fn traced(subject: Subject, tracer: Tracer, bounds: &Bounds, watch: Watch) -> Result<Figures, MeasureError> {
    let Subject { specimen, medium, view, scope } = subject;
    let &Bounds { unresolved, polarised, lattice } = bounds;
    let options = ray::RayOptions { least_weight: unresolved, polarised, ..ray::RayOptions::default() };
    match tracer {
        Tracer::Beams => {
            let polytope = &specimen.stone().map_err(CannotTrace::from)?.polytope;
            let options = beam::BeamOptions { unresolved, polarised, ..beam::BeamOptions::default() };
            Ok(by_beams(&beam::trace(polytope, medium, view, &options, watch)?, scope))
        }
        Tracer::Rays(crate::trace::RayTracer::Rays) => {
            Ok(by_rays(specimen.solid(), medium, view, scope, (options, lattice), watch)?)
        }
        #[cfg(feature = "gpu")]
        Tracer::Rays(crate::trace::RayTracer::Card(gpu)) => {
            super::by_gpu(gpu, specimen.solid(), medium, view, scope, (options, lattice), watch)
        }
    }
}

/// An option's name and value, whether the value is in its range, and the range in words.
type Check = (&'static str, f64, bool, &'static str);

/// Returns an error for the first option that is out of its range.
fn first_wrong(checks: &[Check]) -> Result<(), MeasureError> {
    match checks.iter().find(|(.., is_right, _)| !is_right) {
        Some(&(option, value, _, range)) => Err(MeasureError::Option { option, value, range }),
        None => Ok(()),
    }
}

impl MeasureOptions<'_> {
    /// Checks that the scope is valid and every number in its range.
    fn check(&self) -> Result<(), MeasureError> {
        self.scope.validate()?;
        let view = &self.viewpoint;
        let checks = [
            ("head_deg", self.head_deg, (0.0..90.0).contains(&self.head_deg), "0 to below 90 degrees"),
            ("wavelength_nm", self.wavelength_nm, self.wavelength_nm > 0.0, "a wavelength above 0 nm"),
            ("tilt_deg", view.tilt_deg, (-90.0..=90.0).contains(&view.tilt_deg), "-90 to 90 degrees"),
            ("azimuth_deg", view.azimuth_deg, view.azimuth_deg.is_finite(), "a finite angle"),
        ];
        first_wrong(&checks)
    }
}

impl Measured {
    /// Returns the light return, as a part of the silhouette: light that has been inside the stone and comes from
    /// shining bands above the horizon.
    ///
    /// Glare is not part of it. A black band, such as an observer's head, sends no light.
    pub fn light_return(&self) -> f64 {
        self.light_return
    }

    /// Returns the glare from shining bands above the horizon. Together with [`light_return`](Self::light_return) it is
    /// all the light from above that reaches the eye.
    pub fn glare_return(&self) -> f64 {
        self.glare_return
    }

    /// Returns all the light that the outer surface reflects, whatever its zone.
    pub fn glare(&self) -> f64 {
        self.figures.surface.iter().sum()
    }

    /// Returns the light that has been inside the stone and comes from the scope's lowest band. In all scopes that come
    /// with the program that is the light that leaks in from behind.
    pub fn leakage(&self) -> f64 {
        self.figures.transmitted.first().copied().unwrap_or(0.0)
    }

    /// Returns the zone of this name; `None` where the scope has no such band.
    pub fn zone(&self, name: &str) -> Option<Zone> {
        let k = self.scope.bands.iter().position(|band| band.name == name)?;
        let Figures { surface, transmitted, strongest_exit_area, .. } = &self.figures;
        Some(Zone {
            glare: surface[k],
            transmitted: transmitted[k],
            strongest_exit_area: strongest_exit_area[k],
        })
    }

    /// Returns how far off a share of light may be.
    ///
    /// With beams, a share may be too low by this much and is never too high. With rays, twice the standard error of
    /// sampling is included, which acts in both directions.
    pub fn error(&self) -> f64 {
        self.figures.unresolved + 2.0 * self.figures.standard_error
    }
}
