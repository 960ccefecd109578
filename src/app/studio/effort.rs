//! How well pictures are traced: roughly while the hand moves, then better and better.

/// How many times larger pixels are for single rays in double precision while the hand moves, beyond those of packets:
/// pictures in a scope, refraction maps and panes of glass should not take the time of the render beside them.
const SINGLE_RAYS_COARSER: f64 = 2.0;

/// How well a picture is traced, and with it how much it costs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// The share of the light that may stay unresolved.
    pub unresolved: f64,
    /// How fine the picture is.
    pub grain: Grain,
    /// How fine it is where rays on the processor trace it.
    pub grain_of_rays: Grain,
    /// How a render grows clearer; `None` for a rough picture.
    pub refinement: Option<Refinement>,
}

/// How fine a picture is, in space and in wavelengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grain {
    /// How many times larger than the film's pixels the picture's pixels are; 1 is full size.
    pub coarser: f64,
    /// The number of bands of wavelengths of a render, at most.
    pub bands: u32,
}

/// How a render grows clearer while nothing moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Refinement {
    /// The number of passes.
    pub samples: u32,
    /// The number of passes of which nothing is shown, because the picture in sight is as good.
    pub after: u32,
    /// The share of a render's light that may stay unresolved.
    pub unresolved: f64,
}

/// How well a fair picture is traced, the second of the grades: at full size, with one pass and eight bands.
pub(super) const FAIR: Effort = Effort {
    refinement: Some(Refinement { samples: 1, after: 0, unresolved: 1e-2 }),
    ..Effort::rough(5e-3, Grain { coarser: 1.0, bands: 8 })
};

/// How a fine render grows clearer on the processor.
pub(super) const FINE_RENDER: Refinement = Refinement { samples: 4, after: 0, unresolved: 2e-3 };

/// A fine picture by the processor. An export differs from it in the number of passes alone.
pub const FINE: Effort =
    Effort { refinement: Some(FINE_RENDER), ..Effort::rough(1e-3, Grain { coarser: 1.0, bands: u32::MAX }) };

/// A fine picture by a graphics card.
pub(super) const FINE_BY_CARD: Effort =
    Effort { refinement: Some(Refinement { samples: 64, ..FINE_RENDER }), ..FINE };

/// A render by rays on the processor that is sharpened when all else is done, until there is a newer order.
pub(super) const SHARP: Effort = Effort {
    refinement: Some(Refinement { samples: 64, after: FINE_RENDER.samples, ..FINE_RENDER }),
    ..FINE
};

/// A render by rays on its way from rough to fair, with pixels twice as large.
pub(super) const HALFWAY: Effort =
    Effort::rough(FAIR.unresolved, Grain { coarser: 2.0, bands: FAIR.grain.bands });

impl Effort {
    /// Makes the effort of a rough picture.
    pub const fn rough(unresolved: f64, grain: Grain) -> Self {
        Self { unresolved, grain, grain_of_rays: grain, refinement: None }
    }

    /// Returns how many times larger than the film's pixels those of a picture are that single rays on the processor trace.
    pub fn coarser_by_single_rays(&self) -> f64 {
        self.grain_of_rays.coarser * if self.is_refined() { 1.0 } else { SINGLE_RAYS_COARSER }
    }

    /// Returns the effort of a picture that rays on the processor trace.
    pub fn by_rays(self) -> Self {
        Self { grain: self.grain_of_rays, ..self }
    }

    /// Returns whether the picture is more than a rough one.
    pub fn is_refined(&self) -> bool {
        self.refinement.is_some()
    }

    /// Returns the largest number of beams that are followed: light that is caught inside the stone takes many beams for
    /// little energy, and memory is limited.
    pub fn most_beams(&self) -> usize {
        ((600.0 / self.unresolved) as usize).max(30_000)
    }
}
