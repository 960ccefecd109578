//! The weight of stones in carats. A carat is 0.2 g, which is the weight of 200 mm³ at 1 g/cm³.

use super::Material;

/// The milligrams in a carat; 1 g/cm³ is 1 mg/mm³.
pub const MG_PER_CARAT: f64 = 200.0;

impl Material {
    /// Returns the weight of this volume in carats; `None` where the density is not known.
    pub fn carats(&self, volume_mm3: f64) -> Option<f64> {
        self.density.map(|density| density * volume_mm3 / MG_PER_CARAT)
    }

    /// Returns the volume of this weight in mm³; `None` where the density is not known.
    pub fn volume_mm3(&self, carats: f64) -> Option<f64> {
        self.density.map(|density| carats * MG_PER_CARAT / density)
    }
}

#[cfg(test)]
mod tests {
    use crate::{Dispersion, Material, material, materials};

    #[test]
    fn every_gem_has_a_density_and_a_colour_changes_nothing_about_it() {
        for m in materials() {
            // Glasses are lighter than gems, or their density is not known.
            let is_glass = matches!(m.dispersion, Dispersion::Abbe { .. });
            assert!(m.density.map_or(is_glass, |d| is_glass || (2.6..=6.0).contains(&d)), "{}", m.name);
        }
        for (gem, host) in [("ruby", "sapphire"), ("amethyst", "quartz"), ("yellow diamond", "diamond")] {
            assert_eq!(material(gem).unwrap().density, material(host).unwrap().density);
        }
        assert_eq!(Material::from_index("glass", 1.5).unwrap().carats(1.0), None);
    }

    #[test]
    fn a_carat_is_a_fifth_of_a_gram() {
        let diamond = material("diamond").unwrap();
        assert!((diamond.carats(1000.0).unwrap() - 3.52 / 0.2).abs() < 1e-12);
        assert!((diamond.volume_mm3(1.0).unwrap() - 56.818181818).abs() < 1e-8);
    }
}
