//! The figures of a stone's hearts and arrows, and the object in which programs read them.

use super::viewing::Viewing;
use brillianteer_base::{Failure, Watch};
use brillianteer_measure::{
    ClassDeviations, HeartsAndArrows, HeartsError, facet_deviations, hearts_and_arrows,
};
use brillianteer_scene::VIEWER_CONES_DEG;
use serde::Serialize;

/// The default part of the light that may stay unresolved in hearts and arrows.
const UNRESOLVED: f64 = 1e-3;

/// The hearts and arrows of a stone and the way of measuring, by name.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ViewHearts {
    /// The stone's file.
    pub file: String,
    /// The name of the design.
    pub name: String,
    /// The figures of the patterns.
    pub hearts_and_arrows: HeartsAndArrows,
    /// The deviations of the facets that make the patterns.
    pub deviations: Vec<ClassDeviations>,
    /// The name of the material.
    pub material: String,
    /// The refractive index that was traced.
    pub index: f64,
    /// The wavelength of the index, nm; `None` where the request gave the index instead.
    pub wavelength_nm: Option<f64>,
    /// True where polarisation was followed.
    pub polarised: bool,
}

/// Hearts and arrows, with the stone that they belong to.
pub struct HeartsReport<'a> {
    /// The stone and its light. The view is the patterns' own.
    pub viewing: Viewing<'a>,
    /// The figures of the patterns.
    pub patterns: HeartsAndArrows,
    /// The deviations of the facets that make the patterns.
    pub deviations: Vec<ClassDeviations>,
}

/// Measures the hearts and arrows of a stone in the program's viewer.
///
/// # Errors
/// Fails with [`Failure::Input`] where the stone is no convex brilliant of eight mains, or [`Failure::Stopped`] when
/// `watch` asks to stop.
pub fn hearts<'a>(viewing: &Viewing<'a>, watch: Watch) -> Result<HeartsReport<'a>, Failure> {
    let refused = |why: &dyn std::fmt::Display| Failure::Input(format!("{}: {why}", viewing.file));
    let not_convex = viewing.specimen.why_not_convex().unwrap_or_default();
    let not_convex =
        format!("hearts and arrows are measured of round brilliants, which are convex, and {not_convex}");
    let stone = viewing.specimen.stone().map_err(|_| refused(&not_convex))?;
    let deviations = facet_deviations(stone).map_err(|why| refused(&why))?;
    let beams = viewing.beams(UNRESOLVED);
    let patterns = hearts_and_arrows(stone, viewing.medium, VIEWER_CONES_DEG, &beams, watch);
    let patterns = patterns.map_err(|why| match why {
        HeartsError::Stopped(stopped) => stopped.into(),
        HeartsError::NotEightfold(why) => refused(&why),
    })?;
    Ok(HeartsReport { viewing: *viewing, patterns, deviations })
}

impl HeartsReport<'_> {
    /// Returns the figures and the way of measuring by name.
    pub fn figures(&self) -> ViewHearts {
        let viewing = &self.viewing;
        ViewHearts {
            file: viewing.file.to_owned(),
            name: viewing.specimen.design.name.clone(),
            hearts_and_arrows: self.patterns.clone(),
            deviations: self.deviations.clone(),
            material: viewing.specimen.material.name.clone(),
            index: viewing.medium.index,
            wavelength_nm: viewing.wavelength_nm,
            polarised: viewing.polarised,
        }
    }
}
