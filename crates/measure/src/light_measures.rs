//! Measures: numbers for the light of a cut, each as the interval in which it certainly lies.
//!
//! They are sums over the exact beams of one view. Light that the beams leave unresolved widens the intervals;
//! nothing is sampled.
//! Their formulas are in docs/optics.md, "Measures".

use super::exit_sight::{ExitSight, brightness, seen_apart};
use super::eye_grid::{EyeCell, rms_contrast};
use super::face_patterns::PatternMeasures;
use super::interval::Interval;
use super::measure_name::MeasureName;
use super::pattern_settings::PatternSettings;
use super::scintillation::Scintillation;
use brillianteer_base::{Stopped, Watch, go_on};
use brillianteer_math::Polytope;
use brillianteer_scene::DomeLight;
use brillianteer_trace::beam::{Beam, Beams};
use serde::{Deserialize, Serialize};

/// The angle in degrees that an eye's pupil of 3.3 mm fills at 250 mm. Colours that spread over less enter the eye
/// together.
pub const PUPIL_DEG: f64 = 0.76;

/// Returns the angle in degrees that a pupil of this diameter, mm, fills at 250 mm.
pub fn pupil_deg(diameter_mm: f64) -> f64 {
    2.0 * (diameter_mm / 500.0).atan().to_degrees()
}

/// The half angle in degrees of the observer's head that the measures of obstruction, extinction and contrast assume: that of
/// the ASET's blue cone.
pub const MEASURES_HEAD_DEG: f64 = 15.0;

/// Returns the half angle of the head of measures, degrees, where scopes have this one: the same, or the usual one for 0.
pub fn head_of_measures(of_scopes_deg: f64) -> f64 {
    if of_scopes_deg > 0.0 { of_scopes_deg } else { MEASURES_HEAD_DEG }
}

/// The light, head and eye by which the measures are taken.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MeasureSettings {
    /// The domes whose light is weighed.
    pub domes: Vec<DomeLight>,
    /// The half angle of the observer's head for obstruction, extinction and contrast, degrees, 0 to 89.
    pub head_deg: f64,
    /// The angle in degrees, above 0, over which colours must spread before an eye sees them apart.
    pub blur_deg: f64,
    /// The refractive indices at the red and at the violet end of the light whose spread is measured.
    pub indices: [f64; 2],
    /// The size of the stone and the resolution of the eye; `None` leaves out the measures of the pattern.
    #[serde(default)]
    pub pattern: Option<PatternSettings>,
}

impl MeasureSettings {
    /// Returns whether the indices differ, so that light is dispersed.
    pub fn has_dispersion(&self) -> bool {
        self.indices[0] != self.indices[1]
    }

    /// Returns the usual settings for a material with these indices at the red and the violet end.
    pub fn usual(indices: [f64; 2]) -> Self {
        let with_head = DomeLight { power: 0.0, head_deg: MEASURES_HEAD_DEG };
        Self {
            domes: [DomeLight::of(0.0), DomeLight::of(1.0), DomeLight::of(2.0), with_head].into(),
            head_deg: MEASURES_HEAD_DEG,
            blur_deg: PUPIL_DEG,
            indices,
            pattern: None,
        }
    }

    /// Returns the same settings for a stone of this girdle radius, mm.
    pub fn at_size(mut self, unit_mm: f64) -> Self {
        if let Some(pattern) = &mut self.pattern {
            pattern.unit_mm = unit_mm;
        }
        self
    }
}

/// The light of a dome that reaches the eye, as a part of the light that a white sheet in the stone's place would
/// send under an even dome.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DomeReturn {
    /// The dome.
    pub dome: DomeLight,
    /// Light that has been inside the stone.
    pub inside: Interval,
    /// Light that the outer surface reflects; it is exact.
    pub glare: f64,
}

impl DomeReturn {
    /// Returns all light of the dome that reaches the eye.
    pub fn with_glare(&self) -> Interval {
        self.inside + self.glare
    }
}

/// The measures of one view. Each is a part of the silhouette's light or area, unless it says otherwise.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LightMeasures {
    /// The return of each dome, in the order of the settings.
    pub domes: Vec<DomeReturn>,
    /// Light from below the horizon that has been inside the stone.
    pub leakage: Interval,
    /// Light from below the horizon that crosses the stone without being reflected inside: one sees through the stone.
    pub windowing: Interval,
    /// Light that comes through the stone from within the observer's head.
    pub obstruction: Interval,
    /// The part of the silhouette's area whose strongest exit meets the head or comes from below the horizon.
    pub extinction: Interval,
    /// The standard deviation of the brightness over the face, divided by its mean (E. Peli, 1990, "rms contrast"), under an
    /// even dome with the head, without glare. `most` is infinite where the mean may be 0.
    pub contrast: Interval,
    /// Light from above the horizon that has been inside, each exit multiplied by the part of its colours that an eye sees apart:
    /// 1 - blur / fan, at least 0.
    pub fire: Interval,
    /// The mean angle in degrees over which the colours of light from above spread, weighted by that light; `None` where
    /// there is no such light. Exits at which one colour is totally reflected are left out. It is of the light that was
    /// followed, and has no bound of its own.
    pub spread_deg: Option<f64>,
    /// Light that is absorbed inside the stone.
    pub absorbed: Interval,
    /// The measures of the pattern on the face, where the settings want them.
    pub pattern: Option<PatternMeasures>,
    /// The change of the face as the stone rocks. It needs beams of other views, so [`of`](Self::of) leaves it out.
    pub scintillation: Option<Scintillation>,
    /// The part of the light that was not followed to its end.
    pub unresolved: f64,
    /// True where a limit of beams or of memory ended the work before as little light was unresolved as requested, in this
    /// view or as the stone rocks. All intervals hold the light that was left.
    pub is_cut_short: bool,
}

impl LightMeasures {
    /// Takes the measures of exact beams. `polytope` must be the stone that was traced. Of millions of beams this takes
    /// seconds.
    ///
    /// # Errors
    /// Fails where `watch` asks to stop.
    pub fn of(
        beams: &Beams,
        polytope: &Polytope,
        settings: &MeasureSettings,
        watch: Watch,
    ) -> Result<Self, Stopped> {
        go_on(watch, 0.0)?;
        let fans = beams.fans(polytope, settings.indices);
        go_on(watch, 0.1)?;
        let share = f64::from(beams.symmetry.order()) / beams.silhouette_area;
        let mut sums = ExitSums::new(settings.domes.len());
        for beam in beams.iter() {
            sums.absorbed += beam.absorbed * share;
            let energy = beam.weight * beam.area * share;
            if energy > 0.0 {
                let sight = ExitSight::of(&beam, beams, settings.head_deg);
                sums.add_domes((&beam, energy), beams, &settings.domes);
                if !beam.is_surface() {
                    sums.add((energy, fans[beam.id as usize]), &sight, settings.blur_deg);
                    let crosses = beam.parent.is_some_and(|parent| beams.get(parent).is_surface());
                    sums.windowing += if crosses && sight == ExitSight::Below { energy } else { 0.0 };
                }
            }
            // Light that has entered and was not followed at all may cross the stone without a reflection.
            let waits = if beam.is_surface() && beam.open { beam.onward * beam.area * share } else { 0.0 };
            sums.waiting += waits;
        }
        let unresolved = beams.unresolved();
        go_on(watch, 0.2)?;
        let extinction = extinction(beams, settings.head_deg);
        go_on(watch, 0.3)?;
        let contrast = contrast(beams, settings.head_deg);
        let absorbed = if beams.medium.is_clear() { 0.0 } else { unresolved };
        let absorbed = Interval::from(sums.absorbed, absorbed);
        let rest = |done: f64| watch(0.4 + 0.6 * done);
        let pattern = settings
            .pattern
            .as_ref()
            .map(|pattern| PatternMeasures::of(beams, polytope, &fans, (settings, pattern), &rest))
            .transpose()?;
        let is_cut_short = beams.is_cut_short;
        Ok(LightMeasures {
            pattern,
            is_cut_short,
            ..sums.finish(settings, unresolved, [extinction, contrast, absorbed])
        })
    }

    /// Returns a sentence that says how much light was left where a limit of beams or of memory ended the work early, and which
    /// of some measures is therefore the least certain; `None` where the work was done.
    pub fn cut_short(&self, names: impl IntoIterator<Item = MeasureName>) -> Option<String> {
        if !self.is_cut_short {
            return None;
        }
        let error = |name: MeasureName| Some((name, name.of(self)?.error()));
        let widest = names.into_iter().filter_map(error).max_by(|a, b| a.1.total_cmp(&b.1));
        let widest = widest.map_or(String::new(), |(name, error)| {
            let error = if error.is_finite() {
                format!("± {:.3} %", 100.0 * error)
            } else {
                "without an upper end".to_owned()
            };
            format!("; the widest interval is that of {name}, {error}")
        });
        Some(format!(
            "the light takes more beams than memory is set aside for: {:.3} % of it was left, which every interval holds{widest}",
            100.0 * self.unresolved
        ))
    }
}

/// Sums over exits, as parts of the silhouette's light.
struct ExitSums {
    inside: Vec<f64>,
    glare: Vec<f64>,
    below: f64,
    head: f64,
    windowing: f64,
    /// Light that has entered and was not followed.
    waiting: f64,
    fire: f64,
    /// The angles of fans in radians, weighted by light, and the sum of these weights.
    fans: [f64; 2],
    absorbed: f64,
}

impl ExitSums {
    fn new(domes: usize) -> Self {
        Self {
            inside: vec![0.0; domes],
            glare: vec![0.0; domes],
            below: 0.0,
            head: 0.0,
            windowing: 0.0,
            waiting: 0.0,
            fire: 0.0,
            fans: [0.0; 2],
            absorbed: 0.0,
        }
    }

    fn add_domes(&mut self, (beam, energy): (&Beam, f64), beams: &Beams, domes: &[DomeLight]) {
        let sums = if beam.is_surface() { &mut self.glare } else { &mut self.inside };
        for (sum, dome) in sums.iter_mut().zip(domes) {
            *sum += energy * dome.radiance(beam.exit, beams.zenith);
        }
    }

    fn add(&mut self, (energy, fan): (f64, f64), sight: &ExitSight, blur_deg: f64) {
        if *sight == ExitSight::Below {
            self.below += energy;
            return;
        }
        self.head += if *sight == ExitSight::Head { energy } else { 0.0 };
        self.fire += energy * seen_apart(fan, blur_deg);
        if fan < std::f64::consts::PI {
            self.fans[0] += energy * fan;
            self.fans[1] += energy;
        }
    }

    fn finish(
        self,
        settings: &MeasureSettings,
        unresolved: f64,
        [extinction, contrast, absorbed]: [Interval; 3],
    ) -> LightMeasures {
        let open = |least: f64| Interval::from(least, unresolved);
        let light = self.inside.iter().zip(&self.glare);
        let domes = settings.domes.iter().zip(light).map(|(&dome, (&inside, &glare))| DomeReturn {
            dome,
            inside: Interval::from(inside, unresolved * dome.brightest()),
            glare,
        });
        let [angles, weights] = self.fans;
        LightMeasures {
            domes: domes.collect(),
            leakage: open(self.below),
            windowing: Interval::from(self.windowing, self.waiting),
            obstruction: open(self.head),
            extinction,
            contrast,
            // Where the material has no dispersion, unresolved light has no fire either.
            fire: if settings.has_dispersion() { open(self.fire) } else { Interval::from(0.0, 0.0) },
            spread_deg: (weights > 0.0).then(|| (angles / weights).to_degrees()),
            absorbed,
            pattern: None,
            scintillation: None,
            unresolved,
            is_cut_short: false,
        }
    }
}

/// Returns the area whose strongest exit meets the head or comes from below.
fn extinction(beams: &Beams, head_deg: f64) -> Interval {
    let share = f64::from(beams.symmetry.order()) / beams.silhouette_area;
    let cells = beams.strongest_exits();
    let is_dark = |beam: &Beam| ExitSight::of(beam, beams, head_deg) != ExitSight::Dome;
    let dark = cells.iter().filter(|cell| !cell.undecided);
    let dark = dark.filter(|cell| cell.strongest.is_some_and(|exit| is_dark(&beams.get(exit))));
    let area = dark.map(|cell| beams.get(cell.outline).area * share).sum();
    Interval::from(area, beams.undecided(&cells))
}

/// Returns the contrast of the face under an even dome with a head.
///
/// The brightness is the same everywhere in a beam that was not split further, except for the light that is still
/// inside.
fn contrast(beams: &Beams, head_deg: f64) -> Interval {
    let share = f64::from(beams.symmetry.order()) / beams.silhouette_area;
    let bright = brightness(beams, head_deg);
    let part = |id: u32| {
        let beam = beams.get(id);
        EyeCell { area: beam.area * share, light: bright[id as usize], rest: beam.onward }
    };
    rms_contrast(beams.leaves().map(part))
}
