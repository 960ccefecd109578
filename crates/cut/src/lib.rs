//! Cuts as numbers: the round brilliant in closed form, families of cuts, cutters' tiers with their meets,
//! plane lists, meshes, glass shapes, material and size.
//!
//! Numbers in files are percent of the girdle diameter and degrees. Planes come out in the stone's frame: +z out of the
//! table, z = 0 at the crown-side girdle, girdle radius 1. Impossible numbers are errors that name their limit; unusual ones
//! are warnings.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

pub mod audit;
mod beyond_gear;
mod class_estimate;
mod concave;
mod derive;
mod design;
mod design_data;
mod facet_net;
mod facet_zones;
mod facets;
mod families;
mod family;
mod family_body;
mod family_cut;
pub mod from_mesh;
mod frosting;
mod girdle_at_mains;
mod glass;
mod glass_solid;
mod glass_table;
mod limits;
mod material;
pub mod meets;
mod mesh_shape;
mod moved_numbers;
mod names;
mod outline;
mod proportion_error;
mod proportions;
mod published_ranges;
mod report;
mod retarget;
mod rough;
mod round_brilliant;
mod round_brilliant_table;
mod setting;
mod shape;
mod sheet_figures;
mod side_scale;
mod size;
mod tier_change;
mod tiers;
mod warning;

pub use audit::{
    Audit, AuditSubject, CountedAudit, Finding, FindingKind, FindingUnit, NEAR_MISS, SMALL_FACET,
    SmallestParts,
};
pub use beyond_gear::BeyondGear;
pub use class_estimate::{BrilliantProportions, ClassEstimate, ClassLimit, CutClass, NearbyClass};
pub use design::{DEFAULT_DIAMETER_MM, DIAMETERS_MM, Design, DesignError, MAX_PLANES, PlaneFault};
pub use facet_net::NoRoom;
pub use facet_zones::FacetZones;
pub use families::{BY_TIERS, FAMILIES, GROUPS};
pub use family::{Bound, BoundAt, Family, ProfileHandle, Proportion};
pub use family_body::FamilySolid;
pub use family_cut::FamilyCut;
pub use frosting::{FROSTINGS, FinishNote, USUAL_FROSTING, with_finish};
pub use glass::{Glass, Plate, Sides};
pub use material::{MaterialError, MaterialRef};
pub use meets::{
    CornerFault, GivenSize, KnownMeets, Meet, MeetError, MeetFault, MeetOutcome, MeetPoint, MeetSource,
    SolvedTiers, TierCorner, TierMeet, TierOutcome,
};
pub use mesh_shape::MeshShape;
pub use names::{is_printable, tier_stem};
pub use outline::{AlongAxes, Outline, round_diameter};
pub use proportion_error::{Limit, ProportionError};
pub use proportions::Derived;
pub use published_ranges::{PUBLISHED_RANGES, PublishedRange};
pub use report::{MeshHeights, ProportionReport, Spread, TierReport};
pub use retarget::{RetargetError, RetargetRule, Retargeted, RetargetedTier, retarget};
pub use rough::{Finished, FitLimit, Rough, RoughError, YieldReport};
pub use round_brilliant::{Crown, LowerHalf, Pavilion, RoundBrilliant, TOLKOWSKY};
pub use round_brilliant_table::least_star_length;
pub use setting::MachineSetting;
pub use shape::Cut;
pub use sheet_figures::SheetFigures;
pub use side_scale::{ScaleError, ScaledSide, SideSlope, scaled};
pub use size::{Size, SizeError};
pub use tier_change::{TierChange, read_indices};
pub use tiers::{Indexed, Tier, TierFault, TierZone, Tiers};
pub use warning::Warning;

// Files that tests of several crates share name this crate.
#[cfg(test)]
extern crate self as brillianteer_cut;
#[cfg(test)]
#[path = "../../../tests/common/proportions.rs"]
mod random;
#[cfg(test)]
#[path = "../../../tests/common/solids.rs"]
mod solids;
