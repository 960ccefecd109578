//! The geometry of a stone, and the stones of a scene, as plain data that programs read.

mod scene;
mod stone;

pub use scene::{MetalInfo, PlacedStone, RingInfo, SceneInfo};
pub use stone::{
    BodyInfo, FacetInfo, FacetUncertainty, FacetedInfo, GivenNumber, MeshInfo, StoneInfo, TierCount,
};
