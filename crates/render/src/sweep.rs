//! Sweeps: the measures of a design over a grid of its proportions, angles, materials and views.

use super::job::{Job, MeasuresProduct, Product, Quality};
use super::renderer::{RenderError, Renderer, TakenMeasures};
use super::sweep_key::{PERCENT_OF_SIDE, SweepKey};
use super::{Card, Wanted};
use brillianteer_base::Watch;
use brillianteer_cut::{
    Cut, Design, DesignError, MachineSetting, MaterialError, MaterialRef, MeetError, Proportion, ScaleError,
    scaled,
};
use brillianteer_measure::{Bounds, LightMeasures, MeasureName, MeasureSettings};
use brillianteer_optics::{DispersionError, INDICES, Material, line};
use brillianteer_scene::{Film, Medium, Scene, Specimen, SpecimenError, Viewpoint};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::sync::Arc;

/// The relative difference up to which a distance counts as the one that was set.
const SAME_DISTANCE: f64 = 1e-9;

/// A value at a place of an axis.
#[derive(Debug, Clone, PartialEq)]
pub enum SweepValue {
    /// A number, in the unit of the axis.
    Number(f64),
    /// The name of a material.
    Name(String),
}

impl fmt::Display for SweepValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            // Steps of a range are sums, so numbers are rounded to the digits that people mean.
            Self::Number(number) => write!(f, "{}", (number * 1e9).round() / 1e9 + 0.0),
            Self::Name(name) => f.write_str(name),
        }
    }
}

/// An axis of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepAxis {
    /// The number or name that varies.
    pub key: SweepKey,
    /// Its values.
    pub values: Vec<SweepValue>,
}

impl SweepAxis {
    /// Returns the values of all axes at a point of their grid. The last axis varies quickest; no axis may be empty.
    pub fn values_at(axes: &[Self], point: usize) -> Vec<&SweepValue> {
        let mut rest = point;
        let value = |axis: &'_ Self| {
            let place = rest % axis.values.len();
            rest /= axis.values.len();
            place
        };
        let mut places: Vec<usize> = axes.iter().rev().map(value).collect();
        places.reverse();
        axes.iter().zip(places).map(|(axis, place)| &axis.values[place]).collect()
    }
}

/// The measures of a design at all points of a grid.
#[derive(Debug, Clone)]
pub struct Sweep {
    /// The design that is varied.
    pub design: Design,
    /// The view, where no axis varies it.
    pub viewpoint: Viewpoint,
    /// The axes; the last varies quickest. Without an axis there is one point, the design as it is.
    pub axes: Vec<SweepAxis>,
    /// The light, head and eye of the measures. The indices of colours are the material's at Fraunhofer B and G.
    pub settings: MeasureSettings,
    /// The wavelength at which the material's index is taken, nm.
    pub wavelength_nm: f64,
    /// The part of the light that may stay unresolved.
    pub unresolved: f64,
    /// True where polarisation is followed.
    pub polarised: bool,
}

/// The result of a sweep at one point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SweptStone {
    /// The measures of the light.
    pub measures: LightMeasures,
    /// The weight in carats; `None` where the material's density is not known.
    pub carats: Option<f64>,
    /// Warnings about the stone and its measures, such as a facet that no longer touches it, each in a sentence.
    pub warnings: Vec<String>,
}

impl SweptStone {
    pub(super) fn of(measures: LightMeasures, settings: &MeasureSettings, specimen: Specimen) -> Self {
        let carats = specimen.carats();
        let mut warnings = specimen.warnings;
        warnings.extend(measures.cut_short(MeasureName::all(settings)));
        Self { measures, carats, warnings }
    }
}

/// The reason why a point of a sweep has no measures.
#[derive(Debug, thiserror::Error)]
pub enum SweepError {
    /// The design does not make a stone there.
    #[error(transparent)]
    Specimen(#[from] SpecimenError),
    /// The material has no index at the wavelength.
    #[error(transparent)]
    Dispersion(#[from] DispersionError),
    /// The light cannot be traced.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// Two axes vary the same number.
    #[error("{key} is given twice; give all its values at once")]
    Twice {
        /// The key.
        key: String,
    },
    /// Two proportions, one of which moves the other.
    #[error("{key} is reached by changing {moved}, so that they cannot both vary; give one of them")]
    Moved {
        /// The key of the one.
        key: String,
        /// The key of the one that it moves.
        moved: String,
    },
    /// The cut has no proportion of this key, or one that only follows from others.
    #[error("{key}: the design has no such proportion to set; {known}")]
    NoProportion {
        /// The key as given.
        key: String,
        /// The keys of the cut, in words.
        known: String,
    },
    /// The cut has no tier of this name.
    #[error("{key}: the design has no such tier; {known}")]
    NoTier {
        /// The key as given.
        key: String,
        /// The tiers of the cut, in words.
        known: String,
    },
    /// A number where a name is needed, or a name where a number is.
    #[error("{key}: '{value}' is no {expected}")]
    Value {
        /// The key of the axis.
        key: String,
        /// The value as given.
        value: String,
        /// The kind of value that is expected.
        expected: &'static str,
    },
    /// The library has no such material.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// A stone whose light has no derivatives, because it is not convex and between planes, for the given reason.
    #[error(
        "derivatives of light are those of convex stones between planes, and {0}; change the numbers in the cut file, and \
         compare the designs by `measure`"
    )]
    NotConvex(String),
    /// A number has no derivatives; the text says which, and what to give instead.
    #[error("{0}")]
    NoDerivative(String),
    /// A facet that is not there on both sides of the design.
    #[error(
        "{key}: the facet '{facet}' appears or vanishes at this value, where nothing has a derivative; change it a little"
    )]
    FacetComes {
        /// The facet's name.
        facet: String,
        /// The number that is changed.
        key: String,
    },
    /// The distance of a tier that has a meet.
    #[error("{key}: the tier's meet gives its distance; vary an angle, or take the meet away")]
    GivenByMeet {
        /// The key as given.
        key: String,
    },
    /// A meet that cannot be followed with the angle of a tier.
    #[error(transparent)]
    Meet(#[from] MeetError),
    /// A side that cannot be scaled.
    #[error("{key}: {error}")]
    Scale {
        /// The key as given.
        key: String,
        /// The reason.
        error: ScaleError,
    },
}

impl SweepError {
    /// Returns whether the design is at fault, whatever is varied and measured.
    pub fn is_of_design(&self) -> bool {
        matches!(self, Self::NotConvex(_) | Self::Specimen(_) | Self::FacetComes { .. })
    }
}

/// A stone at one point of a sweep, before it is measured.
#[derive(Clone)]
pub(super) struct VariedDesign {
    pub design: Design,
    viewpoint: Viewpoint,
    index: Option<f64>,
    /// True where a tier has been moved, so that meets have to be followed.
    moved: bool,
    /// The keys of distances that were set, and the distances.
    distances: Vec<(SweepKey, f64)>,
}

impl Sweep {
    /// Returns the number of points.
    pub fn count(&self) -> usize {
        self.axes.iter().map(|axis| axis.values.len()).product()
    }

    /// Returns the values of all axes at a point, whose number is below [`count`](Self::count).
    pub fn values(&self, point: usize) -> Vec<&SweepValue> {
        SweepAxis::values_at(&self.axes, point)
    }

    /// Checks that the design has the number of every axis, and that the values are of its kind.
    ///
    /// # Errors
    /// Fails with a [`SweepError`] that names the axis. Points whose stone cannot be made are no errors of the sweep.
    pub fn check(&self) -> Result<(), SweepError> {
        for (place, axis) in self.axes.iter().enumerate() {
            if self.axes[..place].iter().any(|before| before.key == axis.key) {
                return Err(SweepError::Twice { key: axis.key.to_string() });
            }
        }
        let mut varied = self.start();
        varied.check_moved(&self.axes.iter().map(|axis| &axis.key).collect::<Vec<_>>())?;
        let each = self.axes.iter().flat_map(|axis| axis.values.iter().map(|value| (&axis.key, value)));
        for (key, value) in each {
            match key {
                // Scales that were set one after the other would multiply.
                SweepKey::Scale(_) => varied.factor(key, value).map(drop)?,
                _ => varied.set(key, value)?,
            }
        }
        Ok(())
    }

    /// Returns the design at a point, whose number is below [`count`](Self::count). It is not checked whether the
    /// design makes a stone.
    ///
    /// # Errors
    /// Fails with a [`SweepError`] where the design lacks the number of an axis, or where a meet cannot be followed.
    pub fn design_at(&self, point: usize) -> Result<Design, SweepError> {
        Ok(self.varied(point)?.design)
    }

    /// Measures one point with one part of the memory of beams, of as many parts as there may be such points at a time.
    ///
    /// # Errors
    /// Fails with a [`SweepError`] where there is no stone, no index there, or a stone that exact beams do not trace.
    pub fn point(&self, point: usize, parts: usize, watch: Watch) -> Result<SweptStone, SweepError> {
        let (taken, specimen) = self.taken(self.varied(point)?, (vec![], parts), watch)?;
        Ok(SweptStone::of(taken.measures, &self.settings, specimen))
    }

    /// Takes the measures of a varied design, with the derivatives of some and one part of so many of the memory of beams; returns
    /// them with its stone.
    pub(super) fn taken(
        &self,
        varied: VariedDesign,
        (derivatives, parts): (Vec<MeasureName>, usize),
        watch: Watch,
    ) -> Result<(TakenMeasures, Specimen), SweepError> {
        let VariedDesign { design, viewpoint, index, .. } = varied;
        let specimen = Specimen::new(design)?;
        let (medium, indices) = self.optics(&specimen.material, index, specimen.unit_mm())?;
        let settings = MeasureSettings { indices, ..self.settings.clone() }.at_size(specimen.unit_mm());
        let bounds = Bounds { polarised: self.polarised, ..Bounds::exact(self.unresolved) };
        let mut quality = Quality::of_figures(&bounds, Wanted::Quickest);
        quality.beams = quality.beams.with_part_of_memory(parts);
        let job = Job {
            scene: Arc::new(Scene::alone(&specimen)),
            view: viewpoint.view(),
            film: Film::NONE,
            product: Product::Measures(MeasuresProduct { settings, medium, derivatives }),
            quality,
        };
        let rendered = Renderer::new(Card::None).run(&job, watch, &mut |_| Ok::<_, RenderError>(()))?;
        Ok((rendered.measures()?, specimen))
    }

    /// Returns the design and the view at a point.
    fn varied(&self, point: usize) -> Result<VariedDesign, SweepError> {
        let values: Vec<_> = self.axes.iter().map(|axis| &axis.key).zip(self.values(point)).collect();
        self.start().set_all(&values)
    }

    pub(super) fn start(&self) -> VariedDesign {
        VariedDesign::new(self.design.clone(), self.viewpoint)
    }

    /// Returns the medium, and the indices of its colours.
    fn optics(
        &self,
        material: &Material,
        index: Option<f64>,
        unit_mm: f64,
    ) -> Result<(Medium, [f64; 2]), SweepError> {
        let absorption = Medium::absorption_of(material, self.wavelength_nm, unit_mm);
        let of = |nm: f64| index.map_or_else(|| material.dispersion.try_index(nm), Ok);
        let medium = Medium { index: of(self.wavelength_nm)?, absorption, spread: 0.0 };
        Ok((medium, [of(line::FRAUNHOFER_B)?, of(line::FRAUNHOFER_G)?]))
    }
}

impl VariedDesign {
    fn new(design: Design, viewpoint: Viewpoint) -> Self {
        Self { design, viewpoint, index: None, moved: false, distances: vec![] }
    }

    /// Returns the design with its meets followed where a tier was moved.
    fn followed(mut self) -> Result<Self, SweepError> {
        if let (true, Cut::Tiers(tiers)) = (self.moved, &mut self.design.cut) {
            let solved = tiers.solved();
            let failed = solved.errors().next().cloned();
            match failed {
                Some(error) => return Err(error.into()),
                None => *tiers = solved.tiers,
            }
        }
        let is_kept = |(key, distance): &&(SweepKey, f64)| match key {
            SweepKey::Distance(name) => distance_of(&self.design.cut, name)
                .is_some_and(|now| (now - distance).abs() <= SAME_DISTANCE * distance.abs().max(1.0)),
            _ => true,
        };
        match self.distances.iter().find(|set| !is_kept(set)) {
            Some((key, _)) => Err(SweepError::GivenByMeet { key: key.to_string() }),
            None => Ok(self),
        }
    }

    /// Sets all numbers, and follows the meets. Sides are scaled first, so that angles and distances end at the given
    /// values. Numbers that move other proportions come last, for the same reason.
    fn set_all(mut self, numbers: &[(&SweepKey, &SweepValue)]) -> Result<Self, SweepError> {
        let mut numbers = numbers.to_vec();
        self.check_moved(&numbers.iter().map(|(key, _)| *key).collect::<Vec<_>>())?;
        numbers.sort_by_key(|(key, _)| match key {
            SweepKey::Scale(_) => 0,
            _ if self.mover(key).is_some() => 2,
            _ => 1,
        });
        for (key, value) in numbers {
            let before = self.mover(key).map(|row| (row, self.design.cut.clone()));
            self.set(key, value)?;
            if let (Some((row, before)), SweepValue::Number(value)) = (before, value) {
                row.reached(&before, *value)
                    .map_err(|fault| SpecimenError::from(DesignError::from(fault)))?;
            }
        }
        self.followed()
    }

    /// Checks that no two of some keys are those of a proportion and of another that it moves.
    fn check_moved(&self, keys: &[&SweepKey]) -> Result<(), SweepError> {
        for key in keys {
            if let Some(moved) = keys.iter().find(|other| self.does_move(key, other)) {
                return Err(SweepError::Moved { key: key.to_string(), moved: moved.to_string() });
            }
        }
        Ok(())
    }

    /// Returns the proportion of a key that moves others.
    fn mover(&self, key: &SweepKey) -> Option<&'static Proportion> {
        let SweepKey::Proportion(key) = key else { return None };
        self.design.cut.proportion(key).filter(|row| !row.moves.is_empty())
    }

    /// Whether a proportion moves another one.
    fn does_move(&self, key: &SweepKey, other: &SweepKey) -> bool {
        let SweepKey::Proportion(other) = other else { return false };
        let other = self.design.cut.proportion(other);
        self.mover(key).zip(other).is_some_and(|(mover, other)| mover.does_move(other))
    }

    /// Returns the factor by which a side is to be scaled.
    fn factor(&self, key: &SweepKey, value: &SweepValue) -> Result<f64, SweepError> {
        let refused = |error| SweepError::Scale { key: key.to_string(), error };
        match value {
            _ if !self.design.cut.has_scalable_sides() => Err(refused(ScaleError::NotScalable)),
            SweepValue::Number(percent) if PERCENT_OF_SIDE.contains(percent) => Ok(percent / 100.0),
            value => Err(SweepError::Value {
                key: key.to_string(),
                value: value.to_string(),
                expected: "percentage from 10 to 1000",
            }),
        }
    }

    fn set(&mut self, key: &SweepKey, value: &SweepValue) -> Result<(), SweepError> {
        let wrong = |expected| SweepError::Value { key: key.to_string(), value: value.to_string(), expected };
        let number = match value {
            SweepValue::Number(number) if number.is_finite() => Ok(*number),
            _ => Err(wrong("number")),
        };
        match key {
            SweepKey::Material => {
                self.design.material = match value {
                    SweepValue::Name(name) => MaterialRef::Name(name.clone()),
                    SweepValue::Number(index) => MaterialRef::Index(*index),
                };
                self.design.material.material().map(drop)?;
            }
            SweepKey::Index => self.index = Some(number?).filter(|n| INDICES.contains(n)),
            SweepKey::Tilt => self.viewpoint.tilt_deg = number?,
            SweepKey::Azimuth => self.viewpoint.azimuth_deg = number?,
            SweepKey::Proportion(key) => set_proportion(&mut self.design.cut, key, number?)?,
            SweepKey::Scale(side) => {
                let factor = self.factor(key, value)?;
                // Meets need not be followed: a stretch keeps them.
                self.design.cut = scaled(&self.design, *side, factor)
                    .map_err(|error| SweepError::Scale { key: key.to_string(), error })?;
            }
            SweepKey::Tier(name) => {
                let cut = &mut self.design.cut;
                let (place, before) = tier_of(cut, key, name)?;
                cut.set(place, number?.copysign(before.angle), before.distance);
                self.moved = true;
            }
            SweepKey::Distance(name) => {
                let cut = &mut self.design.cut;
                let (place, before) = tier_of(cut, key, name)?;
                let distance = number?;
                cut.set(place, before.angle, distance);
                self.moved = true;
                self.distances.push((key.clone(), distance));
            }
        }
        if *key == SweepKey::Index && self.index.is_none() {
            return Err(wrong("index from 1 (air) to 6"));
        }
        if *key == SweepKey::Tilt && !(-90.0..=90.0).contains(&self.viewpoint.tilt_deg) {
            return Err(wrong("tilt from -90 to 90 degrees"));
        }
        Ok(())
    }
}

/// Sets a proportion; of a pair, it becomes the one that the cut fixes.
fn set_proportion(cut: &mut Cut, key: &str, value: f64) -> Result<(), SweepError> {
    let Some(row) = cut.proportion(key).filter(|row| row.can_be_set()) else {
        let keys: Vec<&str> =
            cut.family().into_iter().flat_map(|f| f.settable()).map(|row| row.key).collect();
        let known = if keys.is_empty() {
            "it is not shaped by proportions: vary its tiers, as in tier:P1".to_owned()
        } else {
            format!("it has {}", keys.join(", "))
        };
        return Err(SweepError::NoProportion { key: key.to_owned(), known });
    };
    row.give(cut, value);
    Ok(())
}

/// Returns the place and the setting of a tier.
fn tier_of(cut: &Cut, key: &SweepKey, name: &str) -> Result<(usize, MachineSetting), SweepError> {
    let settings = cut.settings();
    if let Some(place) = settings.iter().position(|setting| setting.name == name) {
        return Ok((place, settings[place].clone()));
    }
    let names: Vec<&str> = settings.iter().map(|setting| setting.name.as_str()).collect();
    let known = if names.is_empty() {
        "it has no tiers: vary its proportions".to_owned()
    } else {
        format!("it has {}", names.join(", "))
    };
    Err(SweepError::NoTier { key: key.to_string(), known })
}

/// Returns the distance of a tier.
fn distance_of(cut: &Cut, name: &str) -> Option<f64> {
    cut.settings().iter().find(|setting| setting.name == name).map(|setting| setting.distance)
}

/// Returns a design with some of its numbers set, and its meets followed.
///
/// # Errors
/// Fails with a [`SweepError`] where the design lacks a number, or where a meet cannot be followed. It is not checked
/// whether the design makes a stone.
pub fn with_numbers<'a>(
    design: &Design,
    numbers: impl IntoIterator<Item = (&'a SweepKey, f64)>,
) -> Result<Design, SweepError> {
    let numbers: Vec<_> =
        numbers.into_iter().map(|(key, number)| (key, SweepValue::Number(number))).collect();
    let numbers: Vec<_> = numbers.iter().map(|(key, value)| (*key, value)).collect();
    Ok(VariedDesign::new(design.clone(), Viewpoint::default()).set_all(&numbers)?.design)
}
