//! A stone, the viewpoint from which it is seen, and how its light is traced.

use super::event::{Event, Reporter};
use brillianteer_base::Failure;
use brillianteer_math::rounded;
use brillianteer_picture::Scoped;
use brillianteer_render::{FiguresProduct, Job, Partial, Product, Quality, Renderer, Unfit, Wanted};
use brillianteer_scene::{Film, Glare, Medium, Scene, Side, Specimen, Stone, View, Viewpoint};
use brillianteer_trace::ray::Camera;
use brillianteer_trace::{beam, ray};
use glam::DQuat;
use std::sync::Arc;

/// The greatest part of the light that may stay unresolved without a warning, where no bound was requested.
const UNASKED: f64 = 1e-3;

/// A stone with its view and the settings by which it is traced.
#[derive(Clone, Copy)]
pub struct Viewing<'a> {
    /// The stone.
    pub specimen: &'a Specimen,
    /// The stone's file, as figures, warnings and errors name it.
    pub file: &'a str,
    /// The viewpoint; pictures that are made for one side of the stone replace its side.
    pub viewpoint: Viewpoint,
    /// The turn of the stone about its axis, away from the frame of its cut, in degrees. Names and texts give azimuths in
    /// the frame of the cut.
    pub turned_deg: f64,
    /// The stone's medium, at one wavelength.
    pub medium: Medium,
    /// The wavelength in nm; `None` where the request gave the index instead.
    pub wavelength_nm: Option<f64>,
    /// The half angle of the observer's head, in degrees, from 0 to 89. Scopes with a hole for the eye have an angle
    /// of their own.
    pub head_deg: f64,
    /// The part of the light that may stay unresolved, between 0 and 1; `None` for the usual bound.
    pub unresolved: Option<f64>,
    /// The standard error to which figures estimate what exact beams have left; `None` where they estimate nothing.
    pub standard_error: Option<f64>,
    /// True where reflection and refraction take the polarisation of the light into account.
    pub polarised: bool,
    /// Included where glare is shown. With `None`, pictures leave it out and figures list it beside the rest.
    pub glare: Option<Glare>,
    /// The tracer to use, or the choice of the quickest.
    pub tracer: Wanted,
}

impl Viewing<'_> {
    /// Returns the same viewing of the given side, where a picture is made for one side.
    pub fn facing(self, side: Option<Side>) -> Self {
        Self { viewpoint: self.viewpoint.facing(side), ..self }
    }

    /// Returns the view of the turned stone.
    pub(crate) fn view(&self) -> View {
        self.viewpoint.view().of_turned(DQuat::from_rotation_z(self.turned_deg.to_radians()))
    }

    /// Returns the part of the names of a picture's files that describes the view, without the side where the picture
    /// has a side of its own.
    pub(super) fn suffix(&self, own: Option<Side>) -> String {
        self.described().facing(own.map(|_| Side::Table)).suffix()
    }

    /// Returns the material or index and the polarisation, in words for captions.
    pub(super) fn light_in_words(&self) -> String {
        let material = &self.specimen.material;
        let light = match self.wavelength_nm {
            Some(nm) => format!("{} at {nm} nm", material.with_index(self.medium.index)),
            None => format!("index {}", rounded(self.medium.index, 4)),
        };
        let colour = if material.colour_is_illustrative { ", colour illustrative" } else { "" };
        format!("{light}{colour}, {}", self.polarisation())
    }

    /// Returns the stone, the picture's name, the view and the index, in words for the texts in files.
    pub(super) fn seen_in_words(&self, name: &str) -> String {
        let (design, view) = (&self.specimen.design.name, self.described().description());
        format!("{design}: {name}; {view}; index {}, {}", self.medium.index, self.polarisation())
    }

    fn polarisation(&self) -> &'static str {
        if self.polarised { "polarised" } else { "unpolarised" }
    }

    /// Returns the viewpoint for texts, with the azimuth in the frame of the cut.
    pub(super) fn described(&self) -> Viewpoint {
        if self.turned_deg == 0.0 {
            return self.viewpoint;
        }
        let azimuth_deg = (self.viewpoint.azimuth_deg - self.turned_deg).rem_euclid(360.0);
        let is_upright = self.viewpoint.tilt_deg == 0.0;
        Viewpoint { azimuth_deg: if is_upright { 0.0 } else { azimuth_deg }, ..self.viewpoint }
    }

    /// Returns a square film of `size` pixels along each side that holds the stone in this view, with some air around
    /// it.
    pub(crate) fn film(&self, size: u32) -> Film {
        let solid = self.specimen.solid();
        Film::reaching(Camera::new(&self.view(), solid).reach(solid).unwrap_or(1.0), size)
    }

    /// Returns a job of this stone in this view, with `usual` as the bound where none was requested.
    pub(crate) fn job(&self, film: Film, product: Product, usual: f64) -> Job {
        let (tracer, beams, rays) = (self.tracer, self.beams(usual), self.rays(usual));
        let quality = Quality { tracer, beams, standard_error: None, rays, samples: None };
        let view = self.view();
        Job { scene: Arc::new(Scene::alone(self.specimen)), view, film, product, quality }
    }

    /// Refuses a view from which the wanted tracer cannot trace the stone, and returns whether exact beams trace it.
    ///
    /// # Errors
    /// Fails with [`Unfit::Eye`] where the eye is not in front of the whole stone; others where exact beams would
    /// have to trace a perspective or a body that is not convex.
    pub fn plans_beams(&self, renderer: &Renderer) -> Result<bool, Unfit> {
        let figures = FiguresProduct { scope: Scoped::aset().scope, medium: self.medium };
        let job = self.job(Film::NONE, Product::Figures(figures), UNASKED);
        Ok(renderer.plan(&job)?.backend.is_beams())
    }

    /// Returns the result of [`plans_beams`](Self::plans_beams), or an error that names the file.
    ///
    /// # Errors
    /// Fails with [`Failure::Input`] where the eye is not in front of the whole stone, [`Failure::Usage`] where exact
    /// beams do not fit.
    pub fn check(&self, renderer: &Renderer) -> Result<bool, Failure> {
        self.plans_beams(renderer).map_err(|why| why.failure(self.file))
    }

    /// Returns the convex stone, for outputs that only convex stones have.
    ///
    /// # Errors
    /// Fails with [`Failure::Usage`] where the body is not a convex stone.
    pub(crate) fn stone(&self) -> Result<&Stone, Failure> {
        self.specimen.stone().map_err(|e| Failure::Usage(format!("{}: {e}", self.file)))
    }

    /// Returns the options of beams, with `usual` as the bound where none was requested.
    pub(super) fn beams(&self, usual: f64) -> beam::BeamOptions {
        let unresolved = self.unresolved.unwrap_or(usual);
        beam::BeamOptions { unresolved, polarised: self.polarised, ..beam::BeamOptions::default() }
    }

    /// Returns the options of rays: a ray ends when no more of its weight than the bound is left.
    pub(super) fn rays(&self, usual: f64) -> ray::RayOptions {
        let least_weight = self.unresolved.unwrap_or(usual);
        ray::RayOptions { least_weight, polarised: self.polarised, ..ray::RayOptions::default() }
    }

    /// Warns where beams left more of the light unresolved than the requested bound or, where none was requested, more than
    /// may stay unresolved without a warning. `aim` is the bound that the beams were followed to.
    pub(super) fn warn_of_open(
        &self,
        (open, count): (f64, usize),
        aim: f64,
        tell: Reporter,
    ) -> Result<(), Failure> {
        if open <= self.unresolved.unwrap_or(aim.max(UNASKED)) {
            return Ok(());
        }
        let (file, whose) = (self.file, if self.unresolved.is_some() { "asked for" } else { "aimed at" });
        tell(Event::Warning(&format!(
            "{file}: {} % of the light is unresolved, more than the {} % {whose}: after {count} beams it is still \
                being reflected inside, and every figure may be too low by that much",
            percent_text(open),
            percent_text(aim)
        )))
    }
}

/// Reports the notes of a renderer.
pub(crate) fn note(part: &Partial, tell: Reporter) -> Result<(), Failure> {
    match part {
        Partial::Note(text) => tell(Event::Note(text)),
        _ => Ok(()),
    }
}

/// Formats a part in percent, to four significant digits.
fn percent_text(part: f64) -> String {
    let percent = 100.0 * part;
    let digits = 3 - percent.abs().max(1e-12).log10().floor() as i32;
    let scale = 10_f64.powi(digits);
    format!("{}", (percent * scale).round() / scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_warning_names_the_bound_that_was_aimed_at_or_asked_for() {
        let design =
            brillianteer_files::cut_file::parse(brillianteer_files::library::cut("tolkowsky").unwrap(), "x")
                .unwrap();
        let specimen = Specimen::new(design).unwrap();
        let viewing = |unresolved| Viewing {
            specimen: &specimen,
            file: "mine.toml",
            viewpoint: Viewpoint::default(),
            turned_deg: 0.0,
            medium: Medium::clear(2.4),
            wavelength_nm: None,
            head_deg: 0.0,
            unresolved,
            standard_error: None,
            polarised: true,
            glare: None,
            tracer: Wanted::Beams,
        };
        let said = |unresolved, open, aim| {
            let said = std::cell::RefCell::new(String::new());
            let tell = |event: Event| {
                if let Event::Warning(text) = event {
                    *said.borrow_mut() = text.to_owned();
                }
                Ok(())
            };
            viewing(unresolved).warn_of_open((open, 6_000_000), aim, &tell).unwrap();
            said.into_inner()
        };
        let usual = said(None, 0.016_68, 1.5e-4);
        assert!(
            usual
                .starts_with("mine.toml: 1.668 % of the light is unresolved, more than the 0.015 % aimed at")
        );
        let asked = said(Some(1e-4), 0.000_5, 1e-4);
        assert!(
            asked.contains("0.05 % of the light is unresolved, more than the 0.01 % asked for"),
            "{asked}"
        );
        // Without a requested bound there is a warning only where the difference could be seen.
        assert_eq!((said(None, 5e-4, 1.5e-4), said(Some(1e-3), 1e-3, 1e-3)), (String::new(), String::new()));
    }

    #[test]
    fn percents_are_told_to_four_digits_however_small() {
        let parts = [0.016_679_87, 1.5e-4, 1e-9, 0.5, 0.001];
        assert_eq!(parts.map(percent_text), ["1.668", "0.015", "0.0000001", "50", "0.1"]);
    }
}
