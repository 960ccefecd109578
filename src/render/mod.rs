//! Floor 5: makes pictures with the tracers. [`plan`](plan()) alone decides which tracer traces a picture;
//! [`light`](light()) decides how many rows are held at once and how the passes of a picture are added up.

mod card;
mod light;
mod plan;

pub use card::CardUse;
pub use light::{LightQuality, RenderError, grow, light, usual_passes};
pub use plan::{Demands, Plan, Unfit, Wanted, plan};
