//! The figures of a stone in a scope, with the scope, index and tracer that they belong to.

use super::figures::Figures;
use brillianteer_base::ByName;
use brillianteer_scene::Scope;
use serde::{Deserialize, Serialize};

/// The default part of the light that may stay unresolved where nothing is estimated. It takes a few hundredths of a
/// second face up, and some seconds for a tilted stone.
pub const UNRESOLVED: f64 = 1.5e-4;

/// The default standard error of figures whose rest is estimated.
pub const STANDARD_ERROR: f64 = 1e-4;

/// The default number of rays along each side of one lattice, for figures by rays.
pub const LATTICE: u32 = 256;

/// The limits to which light is followed, and the number of rays.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// The part of the light that may stay unresolved, above 0 and below 1. Beams are followed until no more than this
    /// part of all light is unresolved, a ray until no more than this part of its own light is left. `None` is
    /// [`UNRESOLVED`]; but where the rest of beams is estimated, they are then followed as far as the estimate needs.
    pub unresolved: Option<f64>,
    /// The standard error, a part of the silhouette's light, to which rays estimate in each zone the light that beams have
    /// left; above 0. `None` where nothing is estimated. Figures by rays alone do not use it.
    pub standard_error: Option<f64>,
    /// True where polarisation is followed; without it, every surface gets unpolarised light.
    pub polarised: bool,
    /// Rays along each side of a lattice, 1 to 16,384. Beams do not use it.
    pub lattice: u32,
}

impl Default for Bounds {
    fn default() -> Self {
        let standard_error = Some(STANDARD_ERROR);
        Self { unresolved: None, standard_error, polarised: true, lattice: LATTICE }
    }
}

impl Bounds {
    /// Returns the bounds of figures of which nothing is estimated.
    pub fn exact(unresolved: f64) -> Self {
        Self { unresolved: Some(unresolved), standard_error: None, ..Self::default() }
    }

    /// Returns the part of its light that a ray may leave unresolved: little beside the standard error.
    pub fn left_by_rays(&self) -> f64 {
        self.unresolved.unwrap_or(self.standard_error.map_or(UNRESOLVED, |error| error.max(UNRESOLVED)))
    }

    /// Returns the part of the light that beams may leave unresolved: all of it where only an estimate was requested.
    pub fn left_by_beams(&self) -> f64 {
        self.unresolved.unwrap_or(if self.standard_error.is_some() { 1.0 } else { UNRESOLVED })
    }
}

/// The figures of a stone under a scope, with the scope, index and tracer that they belong to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// The shares of the light, by the bands of `scope`.
    pub figures: Figures,
    /// The scope, with the observer's head if there is one.
    pub scope: Scope,
    /// The refractive index that was traced.
    pub index: f64,
    /// The tracer's short name: `beam`, `ray` or `gpu`.
    pub tracer: String,
    /// See [`light_return`](Self::light_return).
    light_return: f64,
    /// See [`light_return_error`](Self::light_return_error).
    light_return_error: Option<f64>,
    /// See [`glare_return`](Self::glare_return).
    glare_return: f64,
}

/// A zone of a scope, whose numbers are parts of the silhouette.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Zone {
    /// Light of this zone that the outer surface reflects.
    pub glare: f64,
    /// Light of this zone that has been inside the stone.
    pub transmitted: f64,
    /// The part of the silhouette whose strongest light from inside comes from this zone.
    pub strongest_exit_area: f64,
}

/// The light of a stone in shares of the silhouette, by the names of zones.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LightShares {
    /// The refractive index that was traced.
    pub index: f64,
    /// [`Measured::light_return`].
    pub light_return: f64,
    /// [`Measured::glare_return`].
    pub glare_return: f64,
    /// [`Measured::leakage`].
    pub leakage: f64,
    /// Light that has been inside the stone, by the zone that it comes from, in the order of the scope.
    pub transmitted: ByName<f64>,
    /// The part of the light that is absorbed inside the stone.
    pub absorbed: f64,
    /// [`Measured::error`].
    pub error: f64,
}

/// Sums up the light of a stone by the bands of a scope. `figures` traces it by a scope whose bands end at the horizon, so
/// that light from above and from below are counted apart.
///
/// # Errors
/// The errors of `figures`.
pub fn measured<E>(
    scope: &Scope,
    index: f64,
    tracer: &str,
    figures: impl FnOnce(&Scope) -> Result<Figures, E>,
) -> Result<Measured, E> {
    let (split, below) = scope.clone().with_horizon();
    let mut figures = figures(&split)?;
    let light_return = figures.light_return(&split);
    let light_return_error = figures.estimate.as_ref().map(|e| e.standard_error_of(split.shining()));
    let glare_return = figures.glare_return(&split);
    if let Some(below) = below {
        figures.join(below);
    }
    Ok(Measured {
        figures,
        scope: scope.clone(),
        index,
        tracer: tracer.to_owned(),
        light_return,
        light_return_error,
        glare_return,
    })
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

    /// Returns the shares of the light by the names of zones.
    pub fn shares(&self) -> LightShares {
        let names = self.scope.bands.iter().map(|band| band.name.clone());
        LightShares {
            index: self.index,
            light_return: self.light_return,
            glare_return: self.glare_return,
            leakage: self.leakage(),
            transmitted: names.zip(self.figures.transmitted.iter().copied()).collect(),
            absorbed: self.figures.absorbed,
            error: self.error(),
        }
    }

    /// Returns the error of a share of light.
    ///
    /// With beams alone, a share may be too low by this much and is never too high. With an estimate of the light
    /// that beams leave, it is twice the largest standard error; a share is then certainly no lower than without its
    /// estimated part, and no higher than that by more than [`Figures::unresolved`]. With rays, it is the light that
    /// they leave and twice the standard error.
    pub fn error(&self) -> f64 {
        let absorbed = self.figures.estimate.as_ref().map_or(0.0, |estimate| estimate.absorbed_error);
        let share = self.figures.standard_error.max(self.light_return_error.unwrap_or(0.0)).max(absorbed);
        self.figures.uncertain() + 2.0 * share
    }

    /// Returns the standard error of [`light_return`](Self::light_return), where a part of it is estimated.
    pub fn light_return_error(&self) -> Option<f64> {
        self.light_return_error
    }
}
