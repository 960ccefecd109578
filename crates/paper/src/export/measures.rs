//! The measures of a view's light, and the object in which programs read them.

use super::event::{Event, Reporter};
use super::figures::SeenFrom;
use super::viewing::{Viewing, note};
use brillianteer_base::{ByName, Failure, Watch};
use brillianteer_measure::{
    Interval, LightMeasures, MeasureName, MeasureSettings, PatternSettings, SampledNumber, head_of_measures,
    hemisphere_return,
};
use brillianteer_optics::line;
use brillianteer_render::{MeasuresProduct, Product, Renderer};
use brillianteer_scene::{DomeLight, Film};
use serde::{Deserialize, Serialize};

/// The default part of the light that may stay unresolved in measures.
const UNRESOLVED: f64 = 1e-3;

/// The measures of a view's light and the way of measuring, by name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ViewMeasures {
    /// The stone's file.
    pub file: String,
    /// The name of the design.
    pub name: String,
    /// The measures, each as an interval: parts of the silhouette's light or area, unless [`LightMeasures`] says otherwise.
    pub measures: ByName<Interval>,
    /// The weighted light return, a part of what a white sheet in the stone's place returns; `None` where it was not taken.
    pub wlr: Option<SampledNumber>,
    /// The mean angle between colours, degrees; `None` where no light comes from above.
    pub spread_deg: Option<f64>,
    /// The part of the light that was not followed to its end.
    pub unresolved: f64,
    /// True where the memory for beams ended the work early.
    pub cut_short: bool,
    /// The name of the material.
    pub material: String,
    /// The refractive index that was traced.
    pub index: f64,
    /// The indices at Fraunhofer B and G, between which colours spread.
    pub indices_of_colours: [f64; 2],
    /// The wavelength of index and absorption, nm; `None` where the request gave the index instead.
    pub wavelength_nm: Option<f64>,
    /// The half angle of the head in obstruction, extinction and contrast, degrees.
    pub head_deg: f64,
    /// The angle over which colours must spread before an eye sees them apart, degrees.
    pub blur_deg: f64,
    /// The diameter of the stone, mm, by which its pattern is seen.
    pub diameter_mm: Option<f64>,
    /// The length on the stone that the eye resolves, mm.
    pub eye_resolves_mm: Option<f64>,
    /// The angle by which the stone rocks, degrees; `None` where scintillation was not taken.
    pub rock_deg: Option<f64>,
    /// True where polarisation was followed.
    pub polarised: bool,
    /// The viewpoint.
    pub view: SeenFrom,
    /// True where the stone is frosted: the measures are those of the polished stone.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub as_polished: bool,
}

/// Measures of light, with the stone and settings that they belong to.
pub struct MeasureReport<'a> {
    /// The stone with its view and tracer.
    pub viewing: Viewing<'a>,
    /// The light, head and eye of the measures.
    pub settings: MeasureSettings,
    /// The measures.
    pub measures: LightMeasures,
    /// The weighted light return of the stone seen from all around, where [`weigh_return`](Self::weigh_return) has taken it.
    pub weighted_return: Option<SampledNumber>,
}

/// The power of the cosine by which the weighted light return counts the angle from the axis.
const WEIGHTED_POWER: f64 = 2.0;

/// The rays on each lattice for the weighted light return, by which its standard error is usually below 0.1 %.
const WEIGHTED_RAYS: u32 = 50_000;

impl Viewing<'_> {
    /// Returns the settings of measures of this stone under these domes, or the usual ones where there are none. The head is
    /// that of the viewing, if it has one.
    pub fn measure_settings(&self, domes: &[DomeLight]) -> MeasureSettings {
        let material = &self.specimen.material;
        // Where the request gives an index instead of the material's, it holds at all wavelengths.
        let index = |nm: f64| self.wavelength_nm.and_then(|_| material.dispersion.try_index(nm).ok());
        let indices =
            [line::FRAUNHOFER_B, line::FRAUNHOFER_G].map(|nm| index(nm).unwrap_or(self.medium.index));
        let pattern = Some(PatternSettings::usual(self.specimen.unit_mm()));
        let usual = MeasureSettings {
            head_deg: head_of_measures(self.head_deg),
            pattern,
            ..MeasureSettings::usual(indices)
        };
        if domes.is_empty() { usual } else { MeasureSettings { domes: domes.to_vec(), ..usual } }
    }
}

/// Takes the measures of a stone's light.
///
/// # Errors
/// Fails with [`Failure::Input`] where the stone is not convex, [`Failure::Usage`] where exact beams do not fit, an error of `tell`, or [`Failure::Stopped`] when
/// `watch` asks to stop.
pub fn light_measures<'a>(
    viewing: &Viewing<'a>,
    settings: MeasureSettings,
    renderer: &mut Renderer,
    watch: Watch,
    tell: Reporter,
) -> Result<MeasureReport<'a>, Failure> {
    let product = MeasuresProduct { settings: settings.clone(), medium: viewing.medium, derivatives: vec![] };
    let mut job = viewing.job(Film::NONE, Product::Measures(product), UNRESOLVED);
    job.quality.samples = None;
    if let Some(why) = viewing.specimen.why_not_convex() {
        return Err(Failure::Input(format!(
            "{}: measures of light are sums over exact beams in convex stones between planes, and {why}; `measure` without this \
             option lists the zones of the ASET",
            viewing.file
        )));
    }
    renderer.plan(&job).map_err(|why| Failure::Usage(format!("{}: {why}", viewing.file)))?;
    let measures = renderer.run(&job, watch, &mut |part| note(&part, tell))?.measures()?.measures;
    if let Some(why) = measures.cut_short(MeasureName::all(&settings)) {
        tell(Event::Warning(&format!("{}: {why}", viewing.file)))?;
    }
    Ok(MeasureReport { viewing: *viewing, settings, measures, weighted_return: None })
}

impl MeasureReport<'_> {
    /// Takes the weighted light return by sampling. It does not depend on the view.
    pub fn weigh_return(&mut self) {
        let (body, rays) = (&*self.viewing.specimen.body, self.viewing.rays(UNRESOLVED));
        let options = (rays, WEIGHTED_RAYS);
        self.weighted_return =
            Some(hemisphere_return(body.solid(), self.viewing.medium, WEIGHTED_POWER, options));
    }

    /// Returns the measures by name, in the order in which they are listed.
    pub fn by_name(&self) -> impl Iterator<Item = (MeasureName, Interval)> + '_ {
        let all = MeasureName::all(&self.settings).into_iter();
        all.filter_map(|name| Some((name, name.of(&self.measures)?)))
    }

    /// Returns the measures and the way of measuring by name.
    pub fn measures(&self) -> ViewMeasures {
        let Self { viewing, settings, measures, .. } = self;
        let pattern = settings.pattern;
        ViewMeasures {
            file: viewing.file.to_owned(),
            name: viewing.specimen.design.name.clone(),
            measures: self.by_name().map(|(name, of)| (name.to_string(), of)).collect(),
            wlr: self.weighted_return,
            spread_deg: measures.spread_deg,
            unresolved: measures.unresolved,
            cut_short: measures.is_cut_short,
            material: viewing.specimen.material.name.clone(),
            index: viewing.medium.index,
            indices_of_colours: settings.indices,
            wavelength_nm: viewing.wavelength_nm,
            head_deg: settings.head_deg,
            blur_deg: settings.blur_deg,
            diameter_mm: pattern.map(|pattern| 2.0 * pattern.unit_mm),
            eye_resolves_mm: pattern.map(|pattern| pattern.resolves_mm),
            rock_deg: pattern.and_then(|pattern| pattern.rock_deg),
            polarised: viewing.polarised,
            view: SeenFrom::of(&viewing.viewpoint),
            as_polished: viewing.specimen.body.is_frosted(),
        }
    }
}
