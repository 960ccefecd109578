//! A stone, from where it is seen, and how its light is traced.

use super::event::{Event, Reporter};
use crate::io::Failure;
use crate::picture::Scoped;
use crate::scene::{Glare, Medium, Side, Specimen, Stone, Viewpoint};
use crate::trace::{CannotTrace, Tracer, beam, ray};

/// Where no bound was asked for, this part of the light may stay unresolved without a word.
const UNASKED: f64 = 1e-3;

/// How a stone is looked at.
#[derive(Clone, Copy)]
pub struct Viewing<'a> {
    /// The stone.
    pub specimen: &'a Specimen,
    /// What figures, warnings and errors call it: its file.
    pub file: &'a str,
    /// From where; pictures that are made for one side have their own.
    pub viewpoint: Viewpoint,
    /// By how much the stone is turned about its axis from how its cut has it, degrees: names and texts give azimuths in
    /// the cut's own frame.
    pub turned_deg: f64,
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
    /// Whether glare is shown; where nothing is said, pictures leave it out and figures list it beside the rest.
    pub glare: Option<Glare>,
    /// What traces the light.
    pub tracer: Tracer<'a>,
}

impl Viewing<'_> {
    /// The same of another side, where a picture is made for one.
    pub fn facing(self, side: Option<Side>) -> Self {
        Self { viewpoint: self.viewpoint.facing(side), ..self }
    }

    /// What the names of a picture's files say of the view: not its side, where the picture has one of its own.
    pub(super) fn suffix(&self, scoped: &Scoped) -> String {
        self.described().facing(scoped.side.map(|_| Side::Table)).suffix()
    }

    /// From where, with the azimuth in the frame of the cut.
    pub(super) fn described(&self) -> Viewpoint {
        if self.turned_deg == 0.0 {
            return self.viewpoint;
        }
        let azimuth_deg = (self.viewpoint.azimuth_deg - self.turned_deg).rem_euclid(360.0);
        let is_upright = self.viewpoint.tilt_deg == 0.0;
        Viewpoint { azimuth_deg: if is_upright { 0.0 } else { azimuth_deg }, ..self.viewpoint }
    }

    /// Whether the tracer can see the stone from there.
    ///
    /// # Errors
    /// [`Failure::Input`] where the eye is not in front of the whole stone, [`Failure::Usage`] where exact beams are
    /// to trace a perspective, or what is not convex.
    pub fn check(&self) -> Result<(), Failure> {
        let can = self.tracer.check(self.specimen, &self.viewpoint.view());
        can.map_err(|why| self.cannot(why))
    }

    /// What to answer where the tracer cannot see the stone.
    pub(super) fn cannot(&self, why: CannotTrace) -> Failure {
        match why {
            CannotTrace::Eye => Failure::Input(format!("{}: {why}", self.file)),
            CannotTrace::Perspective => Failure::Usage(why.to_string()),
            CannotTrace::NotConvex(why) => Failure::Usage(format!("{}: {why}", self.file)),
        }
    }

    /// The stone, for what only convex ones have.
    ///
    /// # Errors
    /// [`Failure::Usage`] where it is none.
    pub(super) fn stone(&self) -> Result<&Stone, Failure> {
        self.specimen.stone().map_err(|e| Failure::Usage(format!("{}: {e}", self.file)))
    }

    /// For beams, with the bound that is usual.
    pub(super) fn beams(&self, usual: f64) -> beam::BeamOptions {
        let unresolved = self.unresolved.unwrap_or(usual);
        beam::BeamOptions { unresolved, polarised: self.polarised, ..beam::BeamOptions::default() }
    }

    /// For rays: a ray is given up when no more than the bound is left of it.
    pub(super) fn rays(&self, usual: f64) -> ray::RayOptions {
        let least_weight = self.unresolved.unwrap_or(usual);
        ray::RayOptions { least_weight, polarised: self.polarised, ..ray::RayOptions::default() }
    }

    /// Warns where beams left more of the light unresolved than they were to: than was asked for or, where nothing was,
    /// more than would be shown without a word. `aim` is the bound that they were followed to.
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
             reflected to and fro inside, and every figure may be too low by that much",
            percent_text(open),
            percent_text(aim)
        )))
    }
}

/// A part in percent, to four digits.
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
        let design = crate::io::cut_file::parse(crate::io::library::cut("tolkowsky").unwrap(), "x").unwrap();
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
            polarised: true,
            glare: None,
            tracer: Tracer::Beams,
        };
        let said = |unresolved, open, aim| {
            let said = std::cell::RefCell::new(String::new());
            let tell = |told: Event| {
                if let Event::Warning(text) = told {
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
        // What is not asked for is told only where it could be seen.
        assert_eq!((said(None, 5e-4, 1.5e-4), said(Some(1e-3), 1e-3, 1e-3)), (String::new(), String::new()));
    }

    #[test]
    fn percents_are_told_to_four_digits_however_small() {
        let parts = [0.016_679_87, 1.5e-4, 1e-9, 0.5, 0.001];
        assert_eq!(parts.map(percent_text), ["1.668", "0.015", "0.0000001", "50", "0.1"]);
    }
}
