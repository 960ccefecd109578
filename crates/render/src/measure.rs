//! Measures a design: from the design to its figures in one call.

use super::card::Card;
use super::check::{HEADS, LATTICES, OutOfRange, demand, demand_count, demand_error, is_head, positive};
use super::job::{FiguresProduct, Job, Product, Quality};
use super::plan::Wanted;
use super::renderer::{RenderError, Renderer};
use brillianteer_base::unwatched;
use brillianteer_cut::Design;
use brillianteer_measure::{Bounds, Measured};
use brillianteer_optics::{DispersionError, INDICES, INDICES_IN_WORDS, line};
use brillianteer_scene::{
    ASET_CONE, Backing, Film, Medium, Projection, Scene, Scope, ScopeError, Specimen, SpecimenError,
    Viewpoint,
};
use std::sync::Arc;

/// The options by which a design is measured.
#[derive(Clone)]
pub struct MeasureOptions {
    /// The direction from which the stone is seen; face up by default.
    pub viewpoint: Viewpoint,
    /// The scope: the structured light whose bands are the zones of the figures. The common ASET by default.
    pub scope: Scope,
    /// Half angle of an observer's head in front of the scope, in degrees. The head sends no light; 0, the default,
    /// means no head.
    pub head_deg: f64,
    /// The wavelength in nm at which the material's index and absorption are taken; 589.3 by default.
    pub wavelength_nm: f64,
    /// A refractive index to use instead of the material's.
    pub index: Option<f64>,
    /// The limits to which light is followed, and the number of rays.
    pub bounds: Bounds,
    /// The tracer; by default exact beams where they apply, and otherwise rays.
    pub tracer: Wanted,
    /// The graphics card that rays may run on; none by default.
    pub card: Card,
}

impl Default for MeasureOptions {
    fn default() -> Self {
        Self {
            viewpoint: Viewpoint::default(),
            scope: Scope::aset(ASET_CONE, Backing::Black),
            head_deg: 0.0,
            wavelength_nm: line::SODIUM_D,
            index: None,
            bounds: Bounds::default(),
            tracer: Wanted::Quickest,
            card: Card::None,
        }
    }
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
    /// An option of [`MeasureOptions`] or [`Bounds`] is out of its range.
    #[error(transparent)]
    Option(#[from] OutOfRange),
    /// The light cannot be traced.
    #[error(transparent)]
    Render(#[from] RenderError),
}

/// Measures a design: builds its stone, traces its light and sums it up by the zones of a scope.
///
/// # Errors
/// Fails with a [`MeasureError`] where the design makes no stone, an option is out of its range, or the tracer does not
/// apply or fails.
pub fn measure(design: &Design, options: &MeasureOptions) -> Result<Measured, MeasureError> {
    options.check()?;
    let specimen = Specimen::new(design.clone())?;
    let material = &specimen.material;
    let index = options.index.map_or_else(|| material.dispersion.try_index(options.wavelength_nm), Ok)?;
    demand(INDICES.contains(&index), "index", index, INDICES_IN_WORDS)?;
    let absorption = Medium::absorption_of(material, options.wavelength_nm, specimen.unit_mm());
    let medium = Medium { index, absorption, spread: 0.0 };
    let job = Job {
        scene: Arc::new(Scene::alone(&specimen)),
        view: options.viewpoint.view(),
        film: Film::NONE,
        product: Product::Figures(FiguresProduct { scope: options.scope_with_head(), medium }),
        quality: Quality::of_figures(&options.bounds, options.tracer),
    };
    let rendered =
        Renderer::new(options.card.clone()).run(&job, &unwatched, &mut |_| Ok::<_, RenderError>(()))?;
    Ok(rendered.figures()?)
}

impl MeasureOptions {
    fn scope_with_head(&self) -> Scope {
        self.scope.clone().with_head(self.head_deg)
    }

    /// Checks that the scope is valid and every number in its range.
    fn check(&self) -> Result<(), MeasureError> {
        let (view, Bounds { standard_error, lattice, .. }) = (&self.viewpoint, self.bounds);
        let (head, nm) = (self.head_deg, self.wavelength_nm);
        demand(is_head(head), "head_deg", head, HEADS)?;
        self.scope_with_head().validate()?;
        demand(nm > 0.0, "wavelength_nm", nm, "a wavelength above 0 nm")?;
        let is_tilt = (-90.0..=90.0).contains(&view.tilt_deg);
        demand(is_tilt, "tilt_deg", view.tilt_deg, "-90 to 90 degrees")?;
        demand(view.azimuth_deg.is_finite(), "azimuth_deg", view.azimuth_deg, "a finite angle")?;
        if let Projection::Perspective { distance } = view.projection {
            positive("distance", distance)?;
        }
        let is_part = |part: f64| part > 0.0 && part < 1.0;
        let unresolved = |part| demand(is_part(part), "unresolved", part, "a part between 0 and 1");
        self.bounds.unresolved.map_or(Ok(()), unresolved)?;
        standard_error.map_or(Ok(()), |error| demand_error("standard_error", error))?;
        demand_count("lattice", lattice, &LATTICES)?;
        Ok(())
    }
}
