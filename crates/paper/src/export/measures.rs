//! The measures of a view's light, and their JSON.

use super::event::{Event, Reporter};
use super::figures::seen_from;
use super::viewing::{Viewing, note};
use brillianteer_base::{Failure, Watch};
use brillianteer_measure::{
    Interval, LightMeasures, MEASURES_HEAD_DEG, MeasureName, MeasureSettings, PatternSettings, SampledNumber,
    hemisphere_return,
};
use brillianteer_optics::line;
use brillianteer_render::{MeasuresProduct, Product, Renderer};
use brillianteer_scene::{DomeLight, Film};
use serde_json::{Map, Value, json};

/// The default part of the light that may stay unresolved in measures.
const UNRESOLVED: f64 = 1e-3;

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
        let head_deg = if self.head_deg > 0.0 { self.head_deg } else { MEASURES_HEAD_DEG };
        let pattern = Some(PatternSettings::usual(self.specimen.unit_mm()));
        let usual = MeasureSettings { head_deg, pattern, ..MeasureSettings::usual(indices) };
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

    /// Returns the measures and the way of measuring, in the form of docs/formats.md.
    pub fn json(&self) -> Value {
        let (viewing, material) = (&self.viewing, &self.viewing.specimen.material);
        let interval = |of: Interval| json!({ "least": of.least, "most": of.most });
        let measures: Map<String, Value> =
            self.by_name().map(|(name, of)| (name.to_string(), interval(of))).collect();
        let mut value = json!({
            "file": viewing.file,
            "name": viewing.specimen.design.name,
            "measures": measures,
            "wlr": self.weighted_return,
            "spread_deg": self.measures.spread_deg,
            "unresolved": self.measures.unresolved,
            "cut_short": self.measures.is_cut_short,
            "material": material.name,
            "index": viewing.medium.index,
            "indices_of_colours": self.settings.indices,
            "wavelength_nm": viewing.wavelength_nm,
            "head_deg": self.settings.head_deg,
            "blur_deg": self.settings.blur_deg,
            "diameter_mm": self.settings.pattern.map(|pattern| 2.0 * pattern.unit_mm),
            "eye_resolves_mm": self.settings.pattern.map(|pattern| pattern.resolves_mm),
            "rock_deg": self.settings.pattern.and_then(|pattern| pattern.rock_deg),
            "polarised": viewing.polarised,
            "view": seen_from(&viewing.viewpoint),
        });
        if viewing.specimen.body.is_frosted() {
            value["as_polished"] = json!(true);
        }
        value
    }
}
