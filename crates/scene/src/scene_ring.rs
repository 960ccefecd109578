//! A ring of the program's own making among companions: its numbers, and what its metal was made of.

use super::{Ring, RingError, RingSeat, SeatKind, SetStone, Specimen};
use brillianteer_math::{NotConvex, ShadedMesh, ShadedSurfaceError};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A ring among companions. Its metal follows its numbers and stones some time after these have changed.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct SceneRing {
    /// The numbers that the ring should have.
    pub ring: Ring,
    /// The numbers and stones of which the present metal was made; a copy that was kept in a file has forgotten them, so that
    /// its metal is made anew.
    #[serde(skip)]
    pub made_of: RingPlan,
    /// The seats of the present metal, in the ring's own frame, in mm.
    pub seats: Arc<[RingSeat]>,
    /// The number of the ring's body among the companions' bodies of metal.
    pub metal: usize,
}

/// All that the metal of a ring depends on.
#[derive(Debug, Clone, Default)]
pub struct RingPlan {
    /// The ring's numbers.
    pub ring: Ring,
    /// The stone in the main seat, with the diameter of its design; `None` where the style has no such seat.
    pub stone: Option<Arc<Specimen>>,
    /// One of the small stones, all of the diameter `small_diameter_mm`; `None` where the style has none.
    pub small_stone: Option<Arc<Specimen>>,
}

/// The metal of a ring, and the places of its stones.
#[derive(Debug, Clone)]
pub struct RingMetal {
    /// The surface, in the ring's own frame, in mm.
    pub mesh: Arc<ShadedMesh>,
    /// The seats, in the ring's own frame, in mm.
    pub seats: Arc<[RingSeat]>,
}

/// A reason why a ring cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RingPlanError {
    /// A number is out of its range, or parts do not fit.
    #[error(transparent)]
    Ring(#[from] RingError),
    /// A stone has no planes that prongs could hold.
    #[error("{key}: {error}")]
    Stone {
        /// The key under which a scene file names the stone.
        key: &'static str,
        /// The reason why the stone has no planes.
        error: NotConvex,
    },
    /// The triangles of the metal cannot be traced.
    #[error(transparent)]
    Surface(#[from] ShadedSurfaceError),
}

impl PartialEq for SceneRing {
    /// The seats follow from the plan.
    fn eq(&self, other: &Self) -> bool {
        (&self.ring, &self.made_of, self.metal) == (&other.ring, &other.made_of, other.metal)
    }
}

impl PartialEq for RingPlan {
    /// Stones are compared by what metal depends on: their cut and their size.
    fn eq(&self, other: &Self) -> bool {
        let is_same = |pair: (&Specimen, &Specimen)| {
            let (a, b) = (&pair.0.design, &pair.1.design);
            a.diameter_mm == b.diameter_mm && (Arc::ptr_eq(&pair.0.body, &pair.1.body) || a.cut == b.cut)
        };
        let are_same = |a: &Option<Arc<Specimen>>, b: &Option<Arc<Specimen>>| match (a, b) {
            (Some(a), Some(b)) => is_same((a, b)),
            (None, None) => true,
            _ => false,
        };
        self.ring == other.ring
            && are_same(&self.stone, &other.stone)
            && are_same(&self.small_stone, &other.small_stone)
    }
}

impl RingPlan {
    /// Makes the metal and the seats.
    ///
    /// # Errors
    /// Fails where a stone has no planes or the numbers make no ring with these stones.
    pub fn made(&self) -> Result<RingMetal, RingPlanError> {
        let (stone, small) = (set("stone", &self.stone)?, set("small_stone", &self.small_stone)?);
        let mounting = self.ring.mounting(stone.as_ref(), small.as_ref())?;
        let mesh = Arc::new(ShadedMesh::new(mounting.surface())?);
        Ok(RingMetal { mesh, seats: mounting.seats.into() })
    }

    /// Returns the stone in seats of a kind.
    pub fn stone_of(&self, kind: SeatKind) -> Option<&Arc<Specimen>> {
        match kind {
            SeatKind::Main => self.stone.as_ref(),
            SeatKind::Small => self.small_stone.as_ref(),
        }
    }
}

/// Returns a stone in the form in which rings take it.
fn set<'a>(
    key: &'static str,
    stone: &'a Option<Arc<Specimen>>,
) -> Result<Option<SetStone<'a>>, RingPlanError> {
    let of = |specimen: &'a Arc<Specimen>| {
        let shape = &specimen.stone().map_err(|error| RingPlanError::Stone { key, error })?.polytope;
        Ok(SetStone { shape, diameter_mm: specimen.design.diameter_mm })
    };
    stone.as_ref().map(of).transpose()
}
