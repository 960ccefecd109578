//! The effort of tracing: rough while the user moves something, then finer in steps.

/// The factor by which pixels of single rays in double precision are larger than those of packets while the user
/// moves something: pictures in a scope, refraction maps and panes of glass should not take as long as the render
/// beside them.
const SINGLE_RAYS_COARSER: f64 = 2.0;

/// The accuracy of a picture, which decides how long it takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// The share of the light that may stay unresolved.
    pub unresolved: f64,
    /// The pixels and bands of the picture.
    pub grain: Grain,
    /// The pixels and bands where rays on the processor trace the picture.
    pub grain_of_rays: Grain,
    /// The passes by which a render is refined; `None` for a rough picture.
    pub refinement: Option<Refinement>,
}

/// The resolution of a picture in space and in wavelengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grain {
    /// The factor by which the picture's pixels are larger than those of the film; 1 is full size.
    pub coarser: f64,
    /// The number of bands of wavelengths of a render, at most.
    pub bands: u32,
}

/// The passes by which a render is refined while nothing moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Refinement {
    /// The number of passes.
    pub samples: u32,
    /// The number of first passes that are not shown, because the picture in sight is as good.
    pub after: u32,
    /// The share of a render's light that may stay unresolved.
    pub unresolved: f64,
}

/// The effort of a fair picture, the second of the grades: full size, one pass and eight bands.
pub(super) const FAIR: Effort = Effort {
    refinement: Some(Refinement { samples: 1, after: 0, unresolved: 1e-2 }),
    ..Effort::rough(5e-3, Grain { coarser: 1.0, bands: 8 })
};

/// The passes of a fine render on the processor.
pub(super) const FINE_RENDER: Refinement = Refinement { samples: 4, after: 0, unresolved: 2e-3 };

/// The effort of a fine picture by the processor. An export differs from it only in the number of passes.
pub const FINE: Effort =
    Effort { refinement: Some(FINE_RENDER), ..Effort::rough(1e-3, Grain { coarser: 1.0, bands: u32::MAX }) };

/// The effort of a fine picture by a graphics card.
pub(super) const FINE_BY_CARD: Effort =
    Effort { refinement: Some(Refinement { samples: 64, ..FINE_RENDER }), ..FINE };

/// The effort that sharpens a render by rays on the processor when all other work is done, until there is a newer
/// order.
pub(super) const SHARP: Effort = Effort {
    refinement: Some(Refinement { samples: 64, after: FINE_RENDER.samples, ..FINE_RENDER }),
    ..FINE
};

/// The effort of a render by rays between rough and fair, with pixels twice as large as the film's.
pub(super) const HALFWAY: Effort =
    Effort::rough(FAIR.unresolved, Grain { coarser: 2.0, bands: FAIR.grain.bands });

impl Effort {
    /// Makes the effort of a rough picture.
    pub const fn rough(unresolved: f64, grain: Grain) -> Self {
        Self { unresolved, grain, grain_of_rays: grain, refinement: None }
    }

    /// Returns the factor by which pixels are larger than the film's where single rays on the processor trace the
    /// picture.
    pub fn coarser_by_single_rays(&self) -> f64 {
        self.grain_of_rays.coarser * if self.is_refined() { 1.0 } else { SINGLE_RAYS_COARSER }
    }

    /// Returns the effort of a picture that rays on the processor trace.
    pub fn by_rays(self) -> Self {
        Self { grain: self.grain_of_rays, ..self }
    }

    /// Returns whether the picture is refined, and not rough.
    pub fn is_refined(&self) -> bool {
        self.refinement.is_some()
    }

    /// Returns the largest number of beams that are followed: light that is caught inside the stone takes many beams for
    /// little energy, and memory is limited.
    pub fn most_beams(&self) -> usize {
        ((600.0 / self.unresolved) as usize).max(30_000)
    }
}
