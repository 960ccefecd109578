//! The choice of a tracer: exact beams, or point rays on the processor or on a graphics card.

use super::ray::Camera;
use crate::math::NotConvex;
use crate::scene::{Medium, Projection, Scope, Specimen, View};

/// What traces point rays: the processor or a graphics card.
#[derive(Clone, Copy)]
pub enum RayTracer<'a> {
    /// The processor, in f64.
    Rays,
    /// A graphics card, in f32.
    #[cfg(feature = "gpu")]
    Card(&'a super::gpu::Gpu),
    /// A graphics card; this variant cannot be built, as this build knows no cards.
    #[cfg(not(feature = "gpu"))]
    Card(std::convert::Infallible, std::marker::PhantomData<&'a ()>),
}

/// The ways to trace light through a stone.
#[derive(Clone, Copy)]
pub enum Tracer<'a> {
    /// Exact beams, for parallel rays and convex stones.
    Beams,
    /// Point rays, for everything.
    Rays(RayTracer<'a>),
}

/// What a tracer looks at: a stone, the view, and the light.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// The stone.
    pub specimen: &'a Specimen,
    /// The stone's medium, at one wavelength.
    pub medium: Medium,
    /// The view; its eye is in front of the whole stone.
    pub view: &'a View,
    /// The structured light.
    pub scope: &'a Scope,
}

/// Why a tracer cannot show a stone from a view.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CannotTrace {
    /// The eye of a perspective is beside or inside the stone.
    #[error("the eye of the perspective is not in front of the whole stone; move it farther off")]
    Eye,
    /// Exact beams need parallel rays.
    #[error("exact beams are for parallel rays: trace a perspective by rays")]
    Perspective,
    /// Exact beams need flat facets and a convex stone.
    #[error(transparent)]
    NotConvex(#[from] NotConvex),
}

impl RayTracer<'_> {
    /// Returns the short name that figures use: `ray` or `gpu`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rays => "ray",
            #[cfg(feature = "gpu")]
            Self::Card(_) => "gpu",
        }
    }

    /// Whether this is a real graphics card, and not one in software.
    pub fn is_quick(self) -> bool {
        match self {
            Self::Rays => false,
            #[cfg(feature = "gpu")]
            Self::Card(gpu) => !gpu.is_software(),
        }
    }

    /// Returns a description in words.
    pub fn description(self) -> String {
        match self {
            Self::Rays => "point rays".into(),
            #[cfg(feature = "gpu")]
            Self::Card(gpu) => format!("point rays in f32 on {}", gpu.name()),
        }
    }
}

impl Tracer<'_> {
    /// Returns exact beams where they apply, and otherwise point rays on the processor.
    pub fn best(specimen: &Specimen, view: &View) -> Self {
        let is_for_beams = view.projection == Projection::Orthographic && specimen.stone().is_ok();
        if is_for_beams { Self::Beams } else { Self::Rays(RayTracer::Rays) }
    }

    /// Returns the short name that figures use: `beam`, `ray` or `gpu`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Beams => "beam",
            Self::Rays(sampler) => sampler.name(),
        }
    }

    /// Returns a description in words.
    pub fn description(self) -> String {
        match self {
            Self::Beams => "exact beams".into(),
            Self::Rays(sampler) => sampler.description(),
        }
    }

    /// Checks that it can trace this stone from this view.
    ///
    /// # Errors
    /// [`CannotTrace`], whose text says what to do instead.
    pub fn check(self, specimen: &Specimen, view: &View) -> Result<(), CannotTrace> {
        let solid = specimen.solid();
        if Camera::new(view, solid).reach(solid).is_none() {
            return Err(CannotTrace::Eye);
        }
        if matches!(self, Self::Beams) {
            if view.projection != Projection::Orthographic {
                return Err(CannotTrace::Perspective);
            }
            specimen.stone()?;
        }
        Ok(())
    }
}
