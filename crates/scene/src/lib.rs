//! Stones, the viewpoint, and the light. Data only.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

mod background;
mod background_ref;
mod body;
mod body_data;
mod companions;
mod copies;
mod dome_light;
mod film;
mod instance;
mod layout;
mod light;
mod lights;
mod look;
mod medium;
mod metal_instance;
mod mipmap;
mod mounting;
mod movement;
mod overlap;
mod panorama;
mod pattern;
mod scene_ring;
mod scope;
mod smoothing;
mod specimen;
mod stone;
mod tone;
mod view;
mod viewpoint;
mod worlds;

pub use background::{Background, UnknownColour};
pub use background_ref::BackgroundRef;
pub use body::Body;
pub use brillianteer_math::Pose;
pub use companions::{Companion, Companions};
pub use copies::{Copies, MOST_COPIES};
pub use dome_light::{DomeLight, NoDome};
pub use film::Film;
pub use instance::{Instance, MOST_STONES, Scene};
pub use layout::{Layout, scattered};
pub use light::{
    Dome, HEADS_DEG, Lamp, LampField, Light, LightError, MOST_LAMPS, PanoramaRef, SoftBox, toward,
};
pub use lights::{LIGHTS, light};
pub use look::{
    BACKGROUND_DISTANCE, BOUNCES, EXPOSURE, GLOW, HEAD, LIGHT_TURN, LOOK_NUMBERS, Look, STRENGTH,
    USUAL_BOUNCES, USUAL_DISTANCE, USUAL_GLOW, USUAL_LIGHT, WAVELENGTHS,
};
pub use medium::Medium;
pub use metal_instance::{MetalInstance, POLISHED};
pub use mipmap::Mipmap;
pub use mounting::{
    ALLOYS, Alloy, MetalPart, Mounting, OuterShape, RING_NUMBERS, Ring, RingError, RingNumber, RingSeat,
    RingStyle, SeatKind, SetStone,
};
pub use movement::{Movement, UnknownMovement, has_wave};
pub use overlap::overlapping;
pub use panorama::{Panorama, PanoramaError};
pub use pattern::{PATTERN_SPAN, Pattern};
pub use scene_ring::{RingMetal, RingPlan, RingPlanError, SceneRing};
pub use scope::{
    ASET_CONE, Backing, Band, Glare, MOST_BANDS, Scope, ScopeError, VIEWER_CONES_DEG, elevation_deg,
};
pub use smoothing::{Smoothing, SmoothingError};
pub use specimen::{Specimen, SpecimenError};
pub use stone::Stone;
pub use tone::{Tone, UnknownTone};
pub use view::{Lean, Projection, Side, View};
pub use viewpoint::Viewpoint;
pub use worlds::World;

// Files that tests of several crates share.
#[cfg(test)]
#[path = "../../../tests/common/solids.rs"]
mod solids;
