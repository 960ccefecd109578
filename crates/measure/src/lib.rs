//! Figures. They state the shares of the light by its origin, each with its error.
//!
//! `measure()` of the crate `render` takes a design to its figures in one call.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

mod bow_tie;
mod brilliant_proportions;
mod contrast_map;
mod derivatives;
mod estimated;
mod exit_sight;
mod eye_grid;
mod face_patterns;
mod face_up_size;
mod facet_deviations;
mod figures;
mod hearts_and_arrows;
mod hemisphere;
mod interval;
mod light_measures;
mod measure_name;
pub mod measure_words;
mod measured;
mod octant_pattern;
mod pattern_settings;
mod sampled;
mod scintillation;
mod virtual_facets;

pub use brilliant_proportions::brilliant_proportions;
pub use contrast_map::{ContrastMap, SquareContrast};
pub use derivatives::MeasureDerivatives;
pub use estimated::{Estimate, by_beams_and_rays};
pub use face_patterns::PatternMeasures;
pub use face_up_size::FaceUpSize;
pub use facet_deviations::{
    ClassDeviations, ErringDeviation, FacetDeviation, NotEightfold, facet_deviations,
};
pub use figures::{Figures, Zones, by_beams, by_summed_beams};
pub use hearts_and_arrows::{
    EightfoldPattern, HeartsAndArrows, HeartsError, OctantDeparture, OctantFigure, OctantUnit,
    hearts_and_arrows,
};
pub use hemisphere::{SampledNumber, hemisphere_return};
pub use interval::Interval;
pub use light_measures::{
    DomeReturn, LightMeasures, MEASURES_HEAD_DEG, MeasureSettings, PUPIL_DEG, head_of_measures, pupil_deg,
};
pub use measure_name::{MeasureName, MeasureNeeds, NoMeasure};
pub use measured::{Bounds, LATTICE, LightShares, Measured, STANDARD_ERROR, UNRESOLVED, Zone, measured};
pub use pattern_settings::{EYE_RESOLVES_MM, PatternSettings, ROCK_DEG, SHAPE_IS_SEEN};
#[cfg(feature = "gpu")]
pub use sampled::by_gpu;
pub use sampled::by_rays;
pub use scintillation::{Scintillation, rocked_views};
