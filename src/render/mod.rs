//! Floor 5: pictures out of the tracers. Who traces a picture is decided by [`plan`](plan()) alone; how many rows are held at
//! once, and how the passes of a picture are added up, by [`light`](light()).

mod card;
mod light;
mod plan;

pub use card::CardUse;
pub use light::{LightQuality, RenderError, grow, light, usual_passes};
pub use plan::{Demands, Plan, Unfit, Wanted, plan};
