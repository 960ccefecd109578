//! Floor 4: figures. They say how much light comes from where, each with its error.
//!
//! [`measure`](crate::measure()) takes a design to its figures in one call.

mod energy_derivatives;
mod estimated;
mod facet_deviations;
mod figures;
mod hemisphere;
mod light_measures;
mod measure_name;
mod measured;
mod sampled;

pub use energy_derivatives::EnergyDerivatives;
pub use estimated::{Estimate, by_beams_and_rays};
pub use facet_deviations::{ClassDeviations, FacetDeviation, NotEightfold, facet_deviations};
pub use figures::{Figures, Zones, by_beams, by_summed_beams};
pub use hemisphere::{SampledNumber, hemisphere_return};
pub use light_measures::{
    DomeReturn, Interval, LightMeasures, MEASURES_HEAD_DEG, MeasureSettings, PUPIL_DEG,
};
pub use measure_name::{MeasureName, NoMeasure};
pub use measured::{Bounds, LATTICE, Measured, STANDARD_ERROR, UNRESOLVED, Zone, measured};
#[cfg(feature = "gpu")]
pub use sampled::by_gpu;
pub use sampled::by_rays;
