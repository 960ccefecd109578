//! One stone of a report, with its pictures and measures.

use super::fingerprint::fingerprint;
use super::pictures::{NamedDrawing, drawings, pictures};
use super::tilts::TiltCurves;
use crate::export::{
    Event, FigureReport, HeartsReport, MeasureReport, Reporter, Viewing, WorkShares, hearts, light_measures,
    measure,
};
use brillianteer_base::{Failure, Watch};
use brillianteer_cut::{Cut, Outline};
use brillianteer_math::{Basis, Symmetry};
use brillianteer_measure::{Interval, MeasureName, facet_deviations};
use brillianteer_picture::Scoped;
use brillianteer_render::Renderer;
use glam::DVec3;

/// The number of alike parts from which on a stone is measured to the finer bound of unresolved light, and both bounds.
const ALIKE_PARTS: u32 = 4;
const UNRESOLVED: [f64; 2] = [1e-3, 5e-3];

/// The rough durations of the steps: pictures, measures, curves over tilt, hearts and arrows.
const SHARES: [f64; 4] = [3.0, 1.0, 4.0, 2.0];

/// A stone with its pictures and measures.
pub(super) struct ReportedStone<'a> {
    pub viewing: Viewing<'a>,
    pub fingerprint: String,
    pub pictures: Vec<NamedDrawing>,
    /// Profile and facet diagram; none of a solid that is no convex stone.
    pub drawings: Vec<NamedDrawing>,
    pub light: ReportedLight<'a>,
    /// The measures against tilt; `None` where exact beams do not trace the stone.
    pub tilts: Option<TiltCurves>,
    /// Hearts and arrows of a round brilliant.
    pub hearts: Option<HeartsReport<'a>>,
}

/// The light of a stone in numbers.
pub(super) enum ReportedLight<'a> {
    /// Intervals by exact beams.
    Measures(Box<MeasureReport<'a>>),
    /// Figures with a standard error, by rays.
    Figures(Box<FigureReport<'a>>),
}

impl<'a> ReportedStone<'a> {
    /// Takes the pictures and the measures of a stone; `side` is that of the pictures in pixels.
    pub fn examine(
        (viewing, side): (&Viewing<'a>, u32),
        renderer: &mut Renderer,
        watch: Watch,
        tell: Reporter,
    ) -> Result<Self, Failure> {
        let specimen = viewing.specimen;
        let parts = symmetry(viewing).map_or(1, |symmetry| symmetry.order());
        let unresolved = if parts >= ALIKE_PARTS { UNRESOLVED[0] } else { UNRESOLVED[1] };
        let viewing = Viewing { unresolved: Some(viewing.unresolved.unwrap_or(unresolved)), ..*viewing };
        let by_beams = viewing.check(renderer)?;
        let is_round = specimen.stone().is_ok_and(|stone| facet_deviations(stone).is_ok());
        let mut shares = WorkShares::new(watch, SHARES.iter().sum());
        let step = |what: &str| tell(Event::Begun(&format!("{}: {what}", viewing.file)));
        step("pictures")?;
        let pictures = shares.step(SHARES[0], |watch| pictures((&viewing, side), renderer, watch, tell))?;
        step("measures")?;
        let light = shares.step(SHARES[1], |watch| {
            if !by_beams {
                let viewing = Viewing { unresolved: None, ..viewing };
                let figures = measure(&viewing, &Scoped::aset(), renderer, watch, tell)?;
                return Ok(ReportedLight::Figures(Box::new(figures)));
            }
            let settings = viewing.measure_settings(&[]);
            let measures = light_measures(&viewing, settings, renderer, watch, tell)?;
            Ok(ReportedLight::Measures(Box::new(measures)))
        })?;
        renderer.drop_beams();
        step("tilt")?;
        let tilts = shares.step(SHARES[2], |watch| {
            by_beams.then(|| TiltCurves::of(&viewing, parts >= ALIKE_PARTS, watch)).transpose()
        })?;
        let hearts = shares
            .step(SHARES[3], |watch| (by_beams && is_round).then(|| hearts(&viewing, watch)).transpose())?;
        let (fingerprint, drawings) = (fingerprint(&specimen.body), drawings(&viewing));
        Ok(Self { viewing, fingerprint, pictures, drawings, light, tilts, hearts })
    }

    /// Returns the name of the design.
    pub fn name(&self) -> &str {
        &self.viewing.specimen.design.name
    }

    /// Returns a measure; `None` where it was not taken.
    pub fn interval(&self, name: MeasureName) -> Option<Interval> {
        match &self.light {
            ReportedLight::Measures(report) => name.of(&report.measures),
            ReportedLight::Figures(_) => None,
        }
    }

    /// Returns the measures that were taken, in the order in which they are listed.
    pub fn measures(&self) -> Vec<MeasureName> {
        match &self.light {
            ReportedLight::Measures(report) => report.by_name().map(|(name, _)| name).collect(),
            ReportedLight::Figures(_) => vec![],
        }
    }

    /// Returns the known facts of the stone before it is measured.
    pub fn facts(&self) -> Vec<[String; 2]> {
        let specimen = self.viewing.specimen;
        let nm = self.viewing.wavelength_nm.map_or(String::new(), |nm| format!(" at {nm} nm"));
        let facets = match specimen.stone() {
            Ok(stone) => stone.polytope.facets().len().to_string(),
            Err(_) => "not between planes".to_owned(),
        };
        let unknown = || "not known: the material has no density, and one by name has".to_owned();
        let weight = specimen.carats().map_or_else(unknown, |carats| format!("{carats:.3} ct"));
        let fact = |label: &str, value: String| [label.to_owned(), value];
        vec![
            fact("Material", specimen.material.name.clone()),
            fact("Index", format!("{:.4}{nm}", self.viewing.medium.index)),
            fact("Size", self.size()),
            fact("Weight", weight),
            fact(
                "Shape",
                self.viewing.specimen.design.cut.family().map_or("by its facets", |f| f.name).to_owned(),
            ),
            fact("Facets", facets),
            fact("Symmetry", self.symmetry_in_words()),
            fact("Geometry", self.fingerprint[..16].to_owned()),
        ]
    }

    /// Returns the extents of the stone, mm: length, width and depth.
    fn size(&self) -> String {
        let unit = self.viewing.specimen.unit_mm();
        let (low, high) = self.viewing.specimen.solid().bounds();
        let depth = (high.z - low.z) * unit;
        let across = match self.viewing.specimen.stone() {
            Ok(stone) => {
                let outline = Outline::of(&stone.polytope);
                [outline.length, outline.width]
            }
            Err(_) => [(high - low).truncate().max_element(), (high - low).truncate().min_element()],
        };
        let [length, width] = across.map(|side| side * unit);
        format!("{length:.2} × {width:.2} × {depth:.2} mm")
    }

    fn symmetry_in_words(&self) -> String {
        let words = |turns: u32, mirror: bool| match (turns, mirror) {
            (1, false) => "none".to_owned(),
            (1, true) => "mirror-image".to_owned(),
            (turns, false) => format!("{turns}-fold"),
            (turns, true) => format!("{turns}-fold, mirror-image"),
        };
        let exact = symmetry(&self.viewing);
        match (&self.viewing.specimen.design.cut, exact) {
            (Cut::Tiers(tiers), Some(exact))
                if exact.order() == 1 && (tiers.symmetry > 1 || tiers.mirror) =>
            {
                format!("{} by its file", words(tiers.symmetry, tiers.mirror))
            }
            (_, Some(exact)) => words(exact.turns, exact.mirror.is_some()),
            (_, None) => "not known".to_owned(),
        }
    }
}

/// Returns the exact symmetry of a convex stone about its axis; `None` of any other solid.
fn symmetry(viewing: &Viewing) -> Option<Symmetry> {
    let stone = viewing.specimen.stone().ok()?;
    Some(Symmetry::of(stone.polytope.planes(), &Basis::FACE_UP, DVec3::Z))
}
