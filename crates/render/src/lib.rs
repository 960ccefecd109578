//! Does jobs. A [`Job`] is plain data: the scene, the view, the film, the product and the quality. A
//! [`Renderer`] makes the product, by the tracer that [`Renderer::plan`] alone chooses.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

mod beam_cache;
mod behind_glass;
mod card;
mod check;
mod contrast;
mod gradient;
mod job;
mod light;
mod measure;
mod plan;
mod renderer;
mod scope;
mod surroundings;
mod sweep;
mod sweep_key;
mod sweep_run;

#[cfg(test)]
mod tests;

pub use card::{Backend, Card, NoCard};
pub use check::{JobError, OutOfRange};
pub use contrast::TakenContrast;
pub use gradient::{GradedStone, LEAST_TIER_DEG, MeasureGradient, MeasureSlope, MeasureSlopes, PlaneChanges};
pub use job::{
    ContrastProduct, FiguresProduct, Job, LightProduct, MapProduct, MeasuresProduct, PaneProduct, Product,
    Quality, Reading, ScopeProduct, Steps, mixture_note,
};
pub use measure::{MeasureError, MeasureOptions, measure};
pub use plan::{CardWorth, Demands, Plan, Unfit, Wanted};
pub use renderer::{EachPart, Output, Partial, RenderError, Rendered, Renderer, TakenMeasures};
pub use surroundings::{HungPicture, Surroundings};
pub use sweep::{Sweep, SweepAxis, SweepError, SweepValue, SweptStone, with_numbers};
pub use sweep_key::SweepKey;
