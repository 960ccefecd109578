//! Floor 2: what is looked at, from where and under which light. Data only.

mod medium;
mod panorama;
mod scope;
mod stone;
mod view;

pub use medium::Medium;
pub use panorama::Panorama;
pub use scope::{ASET_CONE, Backing, Band, MOST_BANDS, Scope, ScopeError, elevation_deg};
pub use stone::Stone;
pub use view::{Lean, Projection, Side, View};
