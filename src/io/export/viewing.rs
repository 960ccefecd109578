//! A stone, from where it is seen, and how its light is traced.

use super::sampler::Sampler;
use super::told::{Tell, Told};
use crate::io::Failure;
use crate::scene::{Medium, Projection, Side, Specimen, Stone, Viewpoint};
use crate::trace::beam::{self, Beams};
use crate::trace::ray::{self, Camera};

/// Where no bound was asked for, this part of the light may stay unresolved without a word.
const UNASKED: f64 = 1e-3;

/// What traces the light.
#[derive(Clone, Copy)]
pub enum Tracer<'a> {
    /// Exact beams, for parallel rays.
    Beams,
    /// Point rays.
    Rays(Sampler<'a>),
}

/// How a stone is looked at.
#[derive(Clone, Copy)]
pub struct Viewing<'a> {
    /// The stone.
    pub specimen: &'a Specimen,
    /// What figures, warnings and errors call it: its file.
    pub file: &'a str,
    /// From where; pictures that are made for one side have their own.
    pub viewpoint: Viewpoint,
    /// What the stone is made of, at one wavelength.
    pub medium: Medium,
    /// That wavelength, nm; none where the index was given instead.
    pub wavelength_nm: Option<f64>,
    /// Half angle of the observer's head, degrees, from 0 to below 90; scopes with a hole for the eye have their own.
    pub head_deg: f64,
    /// The part of the light that may stay unresolved, between 0 and 1; none for what is usual.
    pub unresolved: Option<f64>,
    /// Whether surfaces see how light is polarised.
    pub polarised: bool,
    /// What traces the light.
    pub tracer: Tracer<'a>,
}

impl Viewing<'_> {
    /// The same of another side, where a picture is made for one.
    pub fn facing(self, side: Option<Side>) -> Self {
        Self { viewpoint: self.viewpoint.facing(side), ..self }
    }

    /// Whether the tracer can see the stone from there.
    ///
    /// # Errors
    /// [`Failure::Input`] where the eye is not in front of the whole stone, [`Failure::Usage`] where exact beams are
    /// to trace a perspective, or what is not convex.
    pub fn check(&self) -> Result<(), Failure> {
        let (view, solid) = (self.viewpoint.view(), self.specimen.solid());
        if Camera::new(&view, solid).reach(solid).is_none() {
            let message =
                "the eye of the perspective is not in front of the whole stone; move it farther off";
            return Err(Failure::Input(format!("{}: {message}", self.file)));
        }
        if matches!(self.tracer, Tracer::Beams) && view.projection != Projection::Orthographic {
            return Err(Failure::Usage(
                "exact beams are for parallel rays: trace a perspective by rays".into(),
            ));
        }
        if matches!(self.tracer, Tracer::Beams) {
            self.stone()?;
        }
        Ok(())
    }

    /// The stone, for what only convex ones have.
    ///
    /// # Errors
    /// [`Failure::Usage`] where it is none.
    pub(super) fn stone(&self) -> Result<&Stone, Failure> {
        self.specimen.stone().map_err(|e| Failure::Usage(format!("{}: {e}", self.file)))
    }

    /// For beams, with the bound that is usual.
    pub(super) fn beams(&self, usual: f64) -> beam::Options {
        let unresolved = self.unresolved.unwrap_or(usual);
        beam::Options { unresolved, polarised: self.polarised, ..beam::Options::default() }
    }

    /// For rays: a ray is given up when no more than the bound is left of it.
    pub(super) fn rays(&self, usual: f64) -> ray::Options {
        let least_weight = self.unresolved.unwrap_or(usual);
        ray::Options { least_weight, polarised: self.polarised, ..ray::Options::default() }
    }

    /// Warns where beams could not be followed to the bound that was asked for, or to one that nobody would ask for.
    pub(super) fn warn_of_open(
        &self,
        beams: &Beams,
        options: &beam::Options,
        tell: Tell,
    ) -> Result<(), Failure> {
        let open = beams.unresolved();
        let bound = self.unresolved.unwrap_or(options.unresolved.max(UNASKED));
        if open <= bound {
            return Ok(());
        }
        let (file, count) = (self.file, beams.len());
        tell(Told::Warning(&format!(
            "{file}: {:.3} % of the light is unresolved, not {:.3} %: it is still caught inside after {count} beams",
            100.0 * open,
            100.0 * bound
        )))
    }
}
