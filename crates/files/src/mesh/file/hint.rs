//! Reads the material that a glTF file states, and finds the material of the stone.
//!
//! KHR_materials_ior gives the index, KHR_materials_dispersion 20 over the Abbe number, KHR_materials_volume the
//! colour that white light has after a distance. Three colours are not a spectrum: each is taken for the
//! transmittance at one wavelength, with straight lines between them.

use brillianteer_cut::{MaterialError, MaterialRef};
use brillianteer_optics::{Absorption, Dispersion, MOST_PER_MM, Material, line};

/// The wavelengths in nm that stand for red, green and blue: about the middle of the range that each primary of sRGB
/// excites.
const CHANNEL_NM: [f64; 3] = [610.0, 550.0, 465.0];

/// The index of a file that has a volume but no index: KHR_materials_ior's own default.
const DEFAULT_IOR: f64 = 1.5;

/// The number that KHR_materials_dispersion divides by the Abbe number.
const DISPERSION: f64 = 20.0;

/// Numbers that differ by no more than this count as the same: a hundred roundings of f32.
const SAME: f64 = 1e-5;

/// The least share of light that a colour lets through: black has no finite absorption.
const BLACK: f64 = 1e-6;

/// A material as glTF describes it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MaterialHint {
    /// The material's name.
    pub name: Option<String>,
    /// The refractive index at the helium d line.
    pub ior: Option<f64>,
    /// 20 over the Abbe number; 0 for no dispersion.
    pub dispersion: Option<f64>,
    /// The share of red, green and blue, linear, that is left after a distance in the file's unit (metres by its standard).
    pub attenuation: Option<([f64; 3], f64)>,
    /// True where the file states that light passes through the material.
    pub transmits: bool,
}

impl MaterialHint {
    /// Describes a material in the terms of glTF, for a file of so many mm per unit. Its colour is that of light
    /// after the distance at which the most absorbed channel has fallen to 1/e, so that eight bits and other programs
    /// show it.
    pub fn of(material: &Material, mm_per_unit: f64) -> Self {
        let [n_c, n_d, n_f] =
            [line::HYDROGEN_C, line::HELIUM_D, line::HYDROGEN_F].map(|nm| material.index(nm));
        let (n_d, dispersion) = match material.dispersion {
            Dispersion::Abbe { n_d, v_d } => (n_d, DISPERSION / v_d),
            _ => (n_d, DISPERSION * (n_f - n_c) / (n_d - 1.0)),
        };
        let mean = |nm: f64| material.absorption.iter().map(|a| a.coefficient(nm)).sum::<f64>() / 2.0;
        let most = CHANNEL_NM.map(mean).into_iter().fold(0.0, f64::max);
        let left = |nm: f64| {
            // Unpolarised light keeps the mean of the two transmittances.
            let part = |a: &Absorption| (-a.coefficient(nm) / most).exp();
            material.absorption.iter().map(part).sum::<f64>() / 2.0
        };
        let distance = 1.0 / (most * mm_per_unit);
        Self {
            name: Some(material.name.clone()),
            ior: Some(n_d),
            dispersion: Some(dispersion).filter(|value| value.is_finite() && *value > 0.0),
            attenuation: distance.is_finite().then(|| (CHANNEL_NM.map(left), distance)),
            transmits: true,
        }
    }

    /// Returns whether this is the description that the program writes of a material, in a file of so many mm per
    /// unit.
    pub fn is_of(&self, material: &MaterialRef, mm_per_unit: f64) -> bool {
        let Ok(material) = material.material() else { return false };
        let written = Self::of(&material, mm_per_unit);
        let near = |a: Option<f64>, b: Option<f64>| match (a, b) {
            (Some(a), Some(b)) => (a - b).abs() <= SAME * b.abs().max(1.0),
            (a, b) => a.unwrap_or(0.0).abs() <= SAME && b.unwrap_or(0.0).abs() <= SAME,
        };
        let distances = (self.attenuation, written.attenuation);
        let attenuated = match distances {
            (Some((a, one)), Some((b, other))) => {
                // The absorption per unit is compared, because both may give the colour for different distances.
                let per_unit = |share: f64, distance: f64| -share.clamp(BLACK, 1.0).ln() / distance;
                let [a, b] = [a.map(|share| per_unit(share, one)), b.map(|share| per_unit(share, other))];
                let most = b.into_iter().fold(0.0, f64::max);
                (0..3).all(|k| (a[k] - b[k]).abs() <= SAME * most)
            }
            (a, b) => a.is_none() && b.is_none(),
        };
        near(self.ior, written.ior) && near(self.dispersion, written.dispersion) && attenuated
    }

    /// Returns the material that the description means, in a stone of so many mm per unit of the file; `None` where
    /// it states nothing.
    ///
    /// # Errors
    /// Fails where the numbers are impossible for a material.
    pub fn material(&self, mm_per_unit: f64) -> Result<Option<MaterialRef>, MaterialError> {
        let volume = self.transmits || self.attenuation.is_some() || self.dispersion.is_some();
        let Some(ior) = self.ior.or(volume.then_some(DEFAULT_IOR)) else { return Ok(None) };
        let absorption = self.absorption(mm_per_unit);
        let dispersion = match self.dispersion {
            Some(value) if value != 0.0 => Dispersion::Abbe { n_d: ior, v_d: DISPERSION / value },
            _ => Dispersion::Constant(ior),
        };
        let bare = matches!(dispersion, Dispersion::Constant(_)) && absorption.is_clear();
        let named = |name: &&String| brillianteer_cut::is_printable(name);
        let material = if bare {
            MaterialRef::Index(ior)
        } else {
            MaterialRef::Custom(Box::new(Material {
                name: self.name.as_ref().filter(named).map_or("from the mesh", String::as_str).to_owned(),
                description: String::new(),
                dispersion,
                absorption: [absorption.clone(), absorption],
                source: "the mesh's glTF material".to_owned(),
                valid_nm: None,
                density: None,
                colour_is_illustrative: false,
            }))
        };
        material.check().map(|()| Some(material))
    }

    fn absorption(&self, mm_per_unit: f64) -> Absorption {
        let Some((colour, distance)) = self.attenuation else { return Absorption::clear() };
        let per_mm =
            |share: f64| (-share.clamp(BLACK, 1.0).ln() / (distance * mm_per_unit)).clamp(0.0, MOST_PER_MM);
        let coefficients = colour.map(per_mm);
        if coefficients.iter().all(|c| *c == 0.0 || !c.is_finite()) {
            return Absorption::clear();
        }
        let samples = CHANNEL_NM.into_iter().zip(coefficients).rev().collect();
        Absorption::new(samples).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_material_comes_back_from_its_hint() {
        for name in ["diamond", "ruby", "sapphire"] {
            let material = brillianteer_optics::material(name).unwrap();
            let hint = MaterialHint::of(material, 0.5);
            let back = hint.material(0.5).unwrap().unwrap().material().unwrap();
            // The distance that the colour is given for, mm.
            let mm = hint.attenuation.map_or(1.0, |(_, distance)| 0.5 * distance);
            assert!((back.index(line::HELIUM_D) - material.index(line::HELIUM_D)).abs() < 1e-5, "{name}");
            let spread = |m: &Material| m.index(line::HYDROGEN_F) - m.index(line::HYDROGEN_C);
            assert!((spread(&back) / spread(material) - 1.0).abs() < 1e-3, "{name}");
            for nm in CHANNEL_NM {
                let mean = |m: &Material| {
                    -(m.absorption.iter().map(|a| (-a.coefficient(nm) * mm).exp()).sum::<f64>() / 2.0).ln()
                };
                assert!((mean(&back) - mean(material)).abs() < 1e-9, "{name} {nm}");
            }
        }
    }

    #[test]
    fn what_is_not_said_is_not_made_up() {
        assert_eq!(MaterialHint::default().material(1.0), Ok(None));
        let glass = MaterialHint { transmits: true, ..MaterialHint::default() };
        assert_eq!(glass.material(1.0), Ok(Some(MaterialRef::Index(1.5))));
        let bad = MaterialHint { ior: Some(0.0), ..MaterialHint::default() };
        assert!(bad.material(1.0).unwrap_err().to_string().contains("the index 0 must be from 1"));
        let black = MaterialHint { attenuation: Some(([0.0, 0.5, 1.0], 2.0)), ..glass };
        let material = black.material(1000.0).unwrap().unwrap().material().unwrap();
        assert!((material.absorption[0].coefficient(550.0) - 0.5_f64.ln().abs() / 2000.0).abs() < 1e-12);
        assert!(
            material.absorption[0].coefficient(610.0) > 1e-3
                && material.absorption[0].coefficient(465.0) == 0.0
        );
    }
}
