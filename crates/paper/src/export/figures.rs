//! The figures of a view, and the object in which programs read them.

use super::event::Reporter;
use super::viewing::{Viewing, note};
use brillianteer_base::{ByName, Failure, Watch};
use brillianteer_measure::{Bounds, Estimate, Measured, UNRESOLVED};
use brillianteer_picture::Scoped;
use brillianteer_render::{Backend, FiguresProduct, Product, Renderer};
use brillianteer_scene::{Film, Glare, Lean, Projection, Viewpoint};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// The figures of a view and the way of measuring, by name. Light and areas are parts of the silhouette, from 0 to 1; the zones
/// are the bands of the scope, the lowest last, and a zone that the observer's head covers is 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ViewFigures {
    /// The stone's file.
    pub file: String,
    /// The name of the design.
    pub name: String,
    /// The name of the scope.
    pub scope: String,
    /// The area of the silhouette by parallel rays, squared girdle radii.
    pub silhouette_area: f64,
    /// Light from inside the stone that comes from shining bands above the horizon.
    pub light_return: f64,
    /// The same with the glare of those bands; `None` where glare is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub light_return_with_glare: Option<f64>,
    /// Glare, by the zone that the outer surface reflects; `None` where glare is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surface: Option<ByName<f64>>,
    /// The glare of all zones, only where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub glare_left_out: Option<f64>,
    /// Light from inside the stone, by the zone that it comes from.
    pub transmitted: ByName<f64>,
    /// The part of the face whose strongest exit lies in the zone, and `undecided`: the part where that is not known.
    pub strongest_exit_area: ByName<f64>,
    /// Light that the material absorbs.
    pub absorbed: f64,
    /// Light that beams or rays did not follow to its end.
    pub unresolved: f64,
    /// The number of beams in one domain of the view's symmetry, or of rays that hit the stone.
    pub beams: usize,
    /// The estimated parts of the figures; `None` where nothing is estimated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub estimated: Option<EstimatedFigures>,
    /// The time for tracing and summing, seconds; `None` where it was not requested, because it differs from run to run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
    /// The name of the material.
    pub material: String,
    /// True where the material's absorption was chosen for its looks and not measured.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub colour_is_illustrative: bool,
    /// The refractive index that was traced.
    pub index: f64,
    /// The wavelength of index and absorption, nm; `None` where the request gave the index instead.
    pub wavelength_nm: Option<f64>,
    /// The half angle of the observer's head, from which no light comes, degrees.
    pub head_deg: f64,
    /// The tracer that was used: `beam`, `ray` or `gpu`.
    pub tracer: String,
    /// True where polarisation was followed.
    pub polarised: bool,
    /// The viewpoint.
    pub view: SeenFrom,
    /// The largest standard error of the light of any zone; `None` for beams.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub standard_error: Option<f64>,
}

/// The parts of figures that are estimated, which the figures contain.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EstimatedFigures {
    /// Estimated light from inside the stone, by zone.
    pub transmitted: ByName<f64>,
    /// The estimated part of the face, by the zone of its strongest exit.
    pub strongest_exit_area: ByName<f64>,
    /// Estimated light that is absorbed.
    pub absorbed: f64,
    /// Light that the estimate does not place either.
    pub unresolved: f64,
    /// The number of rays.
    pub rays: u64,
    /// The standard errors of the estimate.
    pub standard_error: EstimateErrors,
}

/// The standard errors of estimated figures, in parts of the silhouette's light or area.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EstimateErrors {
    /// The standard error of the light return; `None` where the scope has none.
    pub light_return: Option<f64>,
    /// The standard error of the light of each zone.
    pub transmitted: ByName<f64>,
    /// The standard error of the area of each zone's strongest exits.
    pub strongest_exit_area: ByName<f64>,
    /// The standard error of the light that is absorbed.
    pub absorbed: f64,
}

/// A viewpoint by name. All angles are in degrees.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SeenFrom {
    /// The side that faces the eye while nothing is tilted: `table` or `culet`.
    pub side: String,
    /// The tilt of the stone; 0 where the eye is tilted.
    pub tilt: f64,
    /// The tilt of the eye; 0 where the stone is tilted.
    pub eye_tilt: f64,
    /// The azimuth of the tilt.
    pub azimuth: f64,
    /// The projection.
    pub projection: SeenBy,
}

/// A projection by name.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SeenBy {
    /// Parallel rays.
    Orthographic,
    /// An eye at this distance from the origin, girdle radii.
    Perspective(f64),
}

/// Figures, with the stone, scope and tracer that they belong to.
pub struct FigureReport<'a> {
    /// The stone with its view and tracer.
    pub viewing: Viewing<'a>,
    /// The scope, with its zones before an observer's head hides some.
    pub scoped: Scoped,
    /// The figures.
    pub measured: Measured,
    /// The tracer that was used.
    pub backend: Backend,
    /// The duration of the measurement, in seconds.
    pub seconds: f64,
}

/// Measures a stone by the zones of a scope, seen from the side that the scope is for.
///
/// # Errors
/// The errors of [`Viewing::check`], an error of `tell`, or [`Failure::Stopped`] when `watch` asks to stop.
pub fn measure<'a>(
    viewing: &Viewing<'a>,
    scoped: &Scoped,
    renderer: &mut Renderer,
    watch: Watch,
    tell: Reporter,
) -> Result<FigureReport<'a>, Failure> {
    let viewing = viewing.facing(scoped.side);
    viewing.check(renderer)?;
    let product = FiguresProduct { scope: scoped.with_head(viewing.head_deg), medium: viewing.medium };
    let mut job = viewing.job(Film::NONE, Product::Figures(product), UNRESOLVED);
    let Viewing { unresolved, standard_error, .. } = viewing;
    job.quality.standard_error = standard_error;
    job.quality.beams.unresolved = Bounds { unresolved, standard_error, ..Bounds::default() }.left_by_beams();
    let start = Instant::now();
    let rendered = renderer.run(&job, watch, &mut |part| note(&part, tell))?;
    let seconds = start.elapsed().as_secs_f64();
    let backend = rendered.backend.clone();
    let measured = rendered.figures()?;
    if backend.is_beams() {
        let open = (measured.figures.uncertain(), measured.figures.beams);
        let aim = if measured.figures.estimate.is_some() { UNRESOLVED } else { job.quality.beams.unresolved };
        viewing.warn_of_open(open, aim, tell)?;
    }
    Ok(FigureReport { viewing, scoped: scoped.clone(), measured, backend, seconds })
}

impl FigureReport<'_> {
    /// Returns the figures and the way of measuring by name.
    ///
    /// The time taken is included only if `timing`, so that equal input gives equal files.
    pub fn figures(&self, timing: bool) -> ViewFigures {
        let Self { viewing, measured, .. } = self;
        let (figures, material) = (&measured.figures, &viewing.specimen.material);
        let has_glare = viewing.glare.unwrap_or(Glare::Included) == Glare::Included;
        let mut strongest_exit_area = self.zones(&figures.strongest_exit_area);
        strongest_exit_area.set("undecided", figures.strongest_exit_undecided);
        let with_glare = measured.light_return() + measured.glare_return();
        ViewFigures {
            file: viewing.file.to_owned(),
            name: viewing.specimen.design.name.clone(),
            scope: measured.scope.name.clone(),
            silhouette_area: figures.silhouette_area,
            light_return: measured.light_return(),
            light_return_with_glare: has_glare.then_some(with_glare),
            surface: has_glare.then(|| self.zones(&figures.surface)),
            glare_left_out: (!has_glare).then(|| measured.glare()),
            transmitted: self.zones(&figures.transmitted),
            strongest_exit_area,
            absorbed: figures.absorbed,
            unresolved: figures.unresolved,
            beams: figures.beams,
            estimated: figures.estimate.as_ref().map(|estimate| self.estimated(estimate)),
            seconds: timing.then_some(self.seconds),
            material: material.name.clone(),
            colour_is_illustrative: material.colour_is_illustrative,
            index: viewing.medium.index,
            wavelength_nm: viewing.wavelength_nm,
            head_deg: viewing.head_deg,
            tracer: self.backend.name().to_owned(),
            polarised: viewing.polarised,
            view: SeenFrom::of(&viewing.viewpoint),
            standard_error: (!self.backend.is_beams()).then_some(figures.standard_error),
        }
    }

    /// Returns the parts of the figures that are estimated, and their standard errors.
    fn estimated(&self, estimate: &Estimate) -> EstimatedFigures {
        EstimatedFigures {
            transmitted: self.zones(&estimate.transmitted),
            strongest_exit_area: self.zones(&estimate.strongest_exit_area),
            absorbed: estimate.absorbed,
            unresolved: estimate.unresolved,
            rays: estimate.rays,
            standard_error: EstimateErrors {
                light_return: self.measured.light_return_error(),
                transmitted: self.zones(&estimate.standard_errors()),
                strongest_exit_area: self.zones(&estimate.area_errors()),
                absorbed: estimate.absorbed_error,
            },
        }
    }

    /// Returns the value of each band by name, the lowest band last. Bands that the observer's head hides have the value 0.
    fn zones(&self, values: &[f64]) -> ByName<f64> {
        let bands = &self.scoped.scope.bands;
        let all = bands.iter().skip(1).chain(bands.first()).map(|band| (band.name.clone(), 0.0));
        let seen =
            self.measured.scope.bands.iter().zip(values).map(|(band, value)| (band.name.clone(), *value));
        all.chain(seen).collect()
    }
}

impl SeenFrom {
    /// Describes a viewpoint.
    pub(super) fn of(viewpoint: &Viewpoint) -> Self {
        let tilt = |lean| if viewpoint.lean == lean { viewpoint.tilt_deg } else { 0.0 };
        Self {
            side: viewpoint.side.name().to_owned(),
            tilt: tilt(Lean::Stone),
            eye_tilt: tilt(Lean::Eye),
            azimuth: viewpoint.azimuth_deg,
            projection: match viewpoint.projection {
                Projection::Orthographic => SeenBy::Orthographic,
                Projection::Perspective { distance } => SeenBy::Perspective(distance),
            },
        }
    }
}
