//! How far renders are refined while nothing moves.

/// How well a render that grows clearer is traced.
pub struct Refinement {
    /// The bands of wavelengths of each pass, at most.
    pub bands: u32,
    /// The number of passes.
    pub samples: u32,
    /// The number of passes of which nothing is shown, because the picture in sight is as good.
    pub after: u32,
    /// The share of the light that may stay unresolved.
    pub unresolved: f64,
}

/// A fair render.
pub(super) const FAIR_RENDER: Refinement = Refinement { bands: 8, samples: 1, after: 0, unresolved: 1e-2 };

/// A fine render on the processor. An export differs from it in the number of passes alone.
pub const FINE_RENDER: Refinement = Refinement { bands: u32::MAX, samples: 4, after: 0, unresolved: 2e-3 };

/// A fine render on a graphics card.
pub(super) const FINE_BY_CARD: Refinement = Refinement { samples: 64, ..FINE_RENDER };

/// A render by rays on the processor that is sharpened when all else is done, until there is a newer order.
pub(super) const SHARP: Refinement = Refinement { samples: 64, after: FINE_RENDER.samples, ..FINE_RENDER };
