//! The medium of a stone: its material at one wavelength.

use brillianteer_optics::{Material, transmittance};
use serde::{Deserialize, Serialize};

/// A clear or absorbing medium at one wavelength, surrounded by air of index 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Medium {
    /// The refractive index, at least 1.
    pub index: f64,
    /// Naperian absorption coefficients per unit of the body's frame (the girdle radius) of the two polarisations that a
    /// uniaxial stone lets through; equal in other stones.
    ///
    /// Light of each polarisation falls as exp(-absorption · path).
    pub absorption: [f64; 2],
    /// The change of the index over the wavelengths that this one stands for; 0 for a single wavelength.
    pub spread: f64,
}

impl Medium {
    /// Returns a medium that absorbs nothing.
    pub const fn clear(index: f64) -> Self {
        Self::grey(index, 0.0)
    }

    /// Returns a medium that absorbs both polarisations alike.
    pub const fn grey(index: f64, absorption: f64) -> Self {
        Self { index, absorption: [absorption; 2], spread: 0.0 }
    }

    /// Returns the medium of a material at `nm`, which stands for the wavelengths from `from_nm` to `to_nm`. The unit
    /// of the body's frame is `unit_mm` mm.
    pub fn of(material: &Material, (from_nm, nm, to_nm): (f64, f64, f64), unit_mm: f64) -> Self {
        Self {
            index: material.index(nm),
            absorption: Self::absorption_of(material, nm, unit_mm),
            spread: material.index(to_nm) - material.index(from_nm),
        }
    }

    /// Returns the absorption coefficients of a material at a wavelength, per unit of `unit_mm` mm.
    pub fn absorption_of(material: &Material, nm: f64, unit_mm: f64) -> [f64; 2] {
        material.absorption.each_ref().map(|a| a.coefficient(nm) * unit_mm)
    }

    /// Returns the medium with the index of the first of several media that absorbs, of each polarisation, as little as the clearest of
    /// them; `None` where there are no media.
    pub fn clearest(media: &[Self]) -> Option<Self> {
        let least = |which: usize| media.iter().map(|m| m.absorption[which]).fold(f64::INFINITY, f64::min);
        media.first().map(|first| Self { absorption: [least(0), least(1)], ..*first })
    }

    /// Returns whether the medium absorbs nothing.
    #[inline]
    pub fn is_clear(&self) -> bool {
        self.absorption == [0.0; 2]
    }

    /// Returns the share of the intensity that is left after a path of this length from the surface, in girdle radii. It is
    /// the mean of the two polarisations, each half of the light.
    pub fn transmittance(&self, path: f64) -> f64 {
        transmittance(self.absorption, path)
    }
}
