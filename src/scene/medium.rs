//! What a stone is made of, at one wavelength.

/// A clear or absorbing isotropic medium at one wavelength, surrounded by air of index 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medium {
    /// Refractive index, at least 1.
    pub index: f64,
    /// Naperian absorption coefficient per girdle radius: intensity falls as exp(-absorption · path).
    pub absorption: f64,
}

impl Medium {
    /// A medium that absorbs nothing.
    pub const fn clear(index: f64) -> Self {
        Self { index, absorption: 0.0 }
    }

    /// The share of the intensity that is left after a path of this length, in girdle radii.
    pub fn transmittance(&self, path: f64) -> f64 {
        (-self.absorption * path).exp()
    }
}
