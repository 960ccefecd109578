//! What a stone is made of, at one wavelength.

use crate::optics::Material;

/// A clear or absorbing medium at one wavelength, surrounded by air of index 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medium {
    /// Refractive index, at least 1.
    pub index: f64,
    /// Naperian absorption coefficients per girdle radius of the two polarisations that a uniaxial stone lets through;
    /// equal in others. Light of each falls as exp(-absorption · path).
    pub absorption: [f64; 2],
    /// How much the index changes over the wavelengths that are taken for one; 0 for a single wavelength.
    pub spread: f64,
}

impl Medium {
    /// A medium that absorbs nothing.
    pub const fn clear(index: f64) -> Self {
        Self::grey(index, 0.0)
    }

    /// A medium that absorbs both polarisations alike.
    pub const fn grey(index: f64, absorption: f64) -> Self {
        Self { index, absorption: [absorption; 2], spread: 0.0 }
    }

    /// A material over a band of wavelengths, taken for the one at `nm`; the world's unit is `unit_mm` mm.
    pub fn of(material: &Material, (from_nm, nm, to_nm): (f64, f64, f64), unit_mm: f64) -> Self {
        Self {
            index: material.index(nm),
            absorption: Self::absorption_of(material, nm, unit_mm),
            spread: material.index(to_nm) - material.index(from_nm),
        }
    }

    /// What a material absorbs at a wavelength, per unit of `unit_mm` mm.
    pub fn absorption_of(material: &Material, nm: f64, unit_mm: f64) -> [f64; 2] {
        material.absorption.each_ref().map(|a| a.coefficient(nm) * unit_mm)
    }

    /// Whether it absorbs nothing.
    pub fn is_clear(&self) -> bool {
        self.absorption == [0.0; 2]
    }

    /// The share of the intensity that is left after a path of this length from the surface, in girdle radii: the mean
    /// of the two polarisations', half the light each.
    pub fn transmittance(&self, path: f64) -> f64 {
        let [o, e] = self.absorption.map(|a| (-a * path).exp());
        0.5 * (o + e)
    }
}
