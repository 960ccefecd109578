//! Metals of jewellery: their complex refractive indices, and the share of light that their surfaces reflect.
//!
//! The indices were measured at room temperature. They are interpolated linearly between the wavelengths of a table,
//! and are constant beyond its ends.
//!
//! | metal | source | accuracy |
//! |---|---|---|
//! | gold, silver | P. B. Johnson and R. W. Christy, *Phys. Rev. B* 6, 4370 (1972), doi:10.1103/PhysRevB.6.4370 | the authors give ±0.02 to ±0.09 for n and ±0.01 to ±0.06 for k in the visible (not checked against the print) |
//! | rhodium | J. H. Weaver, C. G. Olson and D. W. Lynch, *Phys. Rev. B* 15, 4115 (1977), doi:10.1103/PhysRevB.15.4115, as numbers in E. D. Palik (ed.), *Handbook of Optical Constants of Solids* (1985) | two decimals are printed |
//! | platinum | A. D. Rakić et al., *Appl. Opt.* 37, 5271 (1998), doi:10.1364/AO.37.005271: the Brendel-Bormann model, fitted to the data of several authors | the samples differ more than the fit: by several percent of the reflectance |
//!
//! All numbers were taken from M. N. Polyanskiy's refractiveindex.info database, which is in the public domain (CC0).
//! Alloys for jewellery (18 carat gold, 950 platinum, sterling silver) look a little paler than the pure metals here.

use super::colour::LinearRgb;
use super::illuminant::Illuminant;
use super::observer::{OBSERVER_NM, SRGB_FROM_XYZ, seen};
use num_complex::Complex64;
use serde::{Deserialize, Serialize};

/// A metal of which mountings are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Metal {
    /// Pure gold.
    Gold,
    /// Platinum.
    Platinum,
    /// Silver, not tarnished.
    Silver,
    /// Rhodium, with which white gold is plated.
    Rhodium,
}

/// A row of a table: the wavelength in nm, n and k.
type Row = [f64; 3];

impl Metal {
    /// The metals by name.
    pub const NAMES: [(&str, Self); 4] = [
        ("gold", Self::Gold),
        ("platinum", Self::Platinum),
        ("silver", Self::Silver),
        ("rhodium", Self::Rhodium),
    ];

    /// Returns the metal's name.
    pub fn name(self) -> &'static str {
        Self::NAMES.into_iter().find(|(_, metal)| *metal == self).map_or("metal", |(name, _)| name)
    }

    /// Returns the complex index n + ik at a wavelength in nm.
    pub fn index(self, nm: f64) -> Complex64 {
        let rows = self.rows();
        let above = rows.partition_point(|row| row[0] <= nm).clamp(1, rows.len() - 1);
        let (low, high) = (rows[above - 1], rows[above]);
        let part = ((nm - low[0]) / (high[0] - low[0])).clamp(0.0, 1.0);
        let between = |column: usize| low[column] + (high[column] - low[column]) * part;
        Complex64::new(between(1), between(2))
    }

    /// Returns the colour of light of D65 that the metal's polished surface reflects straight back, where white is (1, 1, 1).
    /// Components are within 0..=1: those that no screen shows are the nearest that it does.
    pub fn colour(self) -> LinearRgb {
        let power = |nm: f64| Illuminant::D65.power(nm);
        let reflected = |nm: f64| power(nm) * metal_reflectance(1.0, self.index(nm))[0];
        let (low, high) = OBSERVER_NM.into_inner();
        let white = seen(low, high, power).y;
        (SRGB_FROM_XYZ * (seen(low, high, reflected) / white)).clamp(LinearRgb::ZERO, LinearRgb::ONE)
    }

    fn rows(self) -> &'static [Row] {
        match self {
            Self::Gold => &GOLD,
            Self::Platinum => &PLATINUM,
            Self::Silver => &SILVER,
            Self::Rhodium => &RHODIUM,
        }
    }
}

/// Returns the shares of s- and of p-polarised power that a metal of this complex index (n + ik) reflects into air, for light
/// that meets it at an angle of cosine `cos_i`, 0 to 1.
///
/// These are Born and Wolf's amplitudes (§1.5.2, eq. 21) with a complex index (§14.2); the refracted wave is the one that
/// decays inside.
#[inline]
pub fn metal_reflectance(cos_i: f64, index: Complex64) -> [f64; 2] {
    let cos_i = cos_i.clamp(0.0, 1.0);
    let square = index * index;
    // The index times the cosine of the angle inside the metal; its imaginary part is not negative.
    let inner = (square - (1.0 - cos_i * cos_i)).sqrt();
    let s = (cos_i - inner) / (cos_i + inner);
    let p = (square * cos_i - inner) / (square * cos_i + inner);
    [s.norm_sqr(), p.norm_sqr()]
}

/// The index of gold, by Johnson and Christy 1972.
const GOLD: [Row; 18] = [
    [367.9, 1.48, 1.895],
    [381.5, 1.46, 1.933],
    [397.4, 1.47, 1.952],
    [413.3, 1.46, 1.958],
    [430.5, 1.45, 1.948],
    [450.9, 1.38, 1.914],
    [471.4, 1.31, 1.849],
    [495.9, 1.04, 1.833],
    [520.9, 0.62, 2.081],
    [548.6, 0.43, 2.455],
    [582.1, 0.29, 2.863],
    [616.8, 0.21, 3.272],
    [659.5, 0.14, 3.697],
    [704.5, 0.13, 4.103],
    [756.0, 0.14, 4.542],
    [821.1, 0.16, 5.083],
    [892.0, 0.17, 5.663],
    [984.0, 0.22, 6.350],
];

/// The index of silver, by Johnson and Christy 1972.
const SILVER: [Row; 16] = [
    [367.9, 0.07, 1.657],
    [381.5, 0.05, 1.864],
    [397.4, 0.05, 2.070],
    [413.3, 0.05, 2.275],
    [430.5, 0.04, 2.462],
    [450.9, 0.04, 2.657],
    [471.4, 0.05, 2.869],
    [495.9, 0.05, 3.093],
    [520.9, 0.05, 3.324],
    [548.6, 0.06, 3.586],
    [582.1, 0.05, 3.858],
    [616.8, 0.06, 4.152],
    [659.5, 0.05, 4.483],
    [704.5, 0.04, 4.838],
    [756.0, 0.03, 5.242],
    [821.1, 0.04, 5.727],
];

/// The index of rhodium, by Weaver, Olson and Lynch 1977, in Palik 1985.
const RHODIUM: [Row; 17] = [
    [375.7, 1.20, 3.97],
    [387.5, 1.30, 4.09],
    [400.0, 1.41, 4.20],
    [413.3, 1.53, 4.29],
    [427.5, 1.63, 4.36],
    [459.2, 1.80, 4.49],
    [476.9, 1.85, 4.55],
    [495.9, 1.88, 4.65],
    [516.6, 1.90, 4.78],
    [539.1, 1.94, 4.94],
    [563.6, 2.00, 5.11],
    [590.4, 2.05, 5.30],
    [619.9, 2.12, 5.51],
    [652.6, 2.20, 5.76],
    [688.8, 2.30, 6.02],
    [729.3, 2.42, 6.33],
    [826.6, 2.78, 6.97],
];

/// The index of platinum, by Rakić et al. 1998, Brendel-Bormann model.
const PLATINUM: [Row; 14] = [
    [374.70, 1.6643, 2.6963],
    [397.46, 1.7225, 2.8323],
    [421.61, 1.7804, 2.9727],
    [447.22, 1.8390, 3.1204],
    [474.39, 1.9006, 3.2774],
    [503.21, 1.9676, 3.4447],
    [533.78, 2.0427, 3.6219],
    [566.20, 2.1281, 3.8079],
    [600.60, 2.2255, 4.0007],
    [637.09, 2.3354, 4.1979],
    [675.79, 2.4574, 4.3969],
    [716.84, 2.5903, 4.5958],
    [760.39, 2.7317, 4.7932],
    [806.58, 2.8789, 4.9889],
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LUMINANCE, fresnel};

    fn normal(metal: Metal, nm: f64) -> f64 {
        metal_reflectance(1.0, metal.index(nm))[0]
    }

    #[test]
    fn tables_hold_the_visible_range_in_order_and_give_their_own_values() {
        for (name, metal) in Metal::NAMES {
            let rows = metal.rows();
            assert!(rows.windows(2).all(|pair| pair[0][0] < pair[1][0]), "{name}");
            assert!(rows[0][0] <= 380.0 && rows[rows.len() - 1][0] >= 780.0, "{name}");
            for [nm, n, k] in rows {
                assert!((metal.index(*nm) - Complex64::new(*n, *k)).norm() < 1e-12, "{name} {nm}");
            }
            assert_eq!(metal.index(1.0), metal.index(rows[0][0]));
            assert_eq!(metal.name(), name);
        }
        let between = Metal::Gold.index(0.5 * (450.9 + 471.4));
        assert!((between - Complex64::new(1.345, 1.8815)).norm() < 1e-12);
    }

    #[test]
    fn metals_have_the_reflectances_and_colours_that_they_are_known_for() {
        // ((n - 1)² + k²) / ((n + 1)² + k²) with the printed values.
        let plain = |n: f64, k: f64| ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k);
        assert!((normal(Metal::Gold, 582.1) - plain(0.29, 2.863)).abs() < 1e-12);
        // Gold takes blue away, the white metals hardly anything.
        assert!(normal(Metal::Gold, 450.0) < 0.42 && normal(Metal::Gold, 650.0) > 0.95);
        assert!((420..=700).all(|nm| normal(Metal::Silver, f64::from(nm)) > 0.95));
        assert!((0.60..0.70).contains(&normal(Metal::Platinum, 560.0)));
        assert!((0.74..0.80).contains(&normal(Metal::Rhodium, 560.0)));
    }

    #[test]
    fn the_colour_of_a_metal_lies_between_its_least_and_its_greatest_reflectance_and_gold_is_yellow() {
        for (name, metal) in Metal::NAMES {
            let colour = metal.colour();
            let all = (400..=700).map(|nm| normal(metal, f64::from(nm)));
            let (low, high) =
                all.fold((1.0_f64, 0.0_f64), |(low, high), part| (low.min(part), high.max(part)));
            let luminance = colour.dot(glam::DVec3::from_array(LUMINANCE.map(f64::from)));
            assert!((low..=high).contains(&luminance), "{name}: {colour} {low} {high}");
        }
        let gold = Metal::Gold.colour();
        assert!(gold.x > 0.95 && (0.7..0.85).contains(&gold.y) && gold.z < 0.45, "{gold}");
        let silver = Metal::Silver.colour();
        assert!(silver.min_element() > 0.9 && silver.x >= silver.z, "{silver}");
    }

    #[test]
    fn without_absorption_a_metal_is_a_dielectric() {
        for step in 0..=100 {
            let cos_i = f64::from(step) / 100.0;
            let [s, p] = metal_reflectance(cos_i, Complex64::from(1.5));
            let glass = fresnel(cos_i, 1.0 / 1.5);
            assert!((s - glass.reflectance_s()).abs() < 1e-12 && (p - glass.reflectance_p()).abs() < 1e-12);
            // A comparison with another index fails.
            let other = fresnel(cos_i, 1.0 / 1.51).reflectance_s();
            assert!(cos_i == 0.0 || (s - other).abs() > 1e-5);
        }
    }

    #[test]
    fn reflectances_are_shares_and_all_light_is_reflected_at_grazing_incidence() {
        for (_, metal) in Metal::NAMES {
            for nm in [400.0, 500.0, 600.0, 700.0] {
                let all = (0..=1000).map(|step| metal_reflectance(f64::from(step) / 1000.0, metal.index(nm)));
                for [s, p] in all {
                    assert!((0.0..=1.0 + 1e-12).contains(&p) && p <= s + 1e-12 && s <= 1.0 + 1e-12);
                }
                let [s, p] = metal_reflectance(0.0, metal.index(nm));
                assert!((s - 1.0).abs() < 1e-12 && (p - 1.0).abs() < 1e-12);
                let [s, p] = metal_reflectance(1.0, metal.index(nm));
                assert!((s - p).abs() < 1e-12);
            }
        }
    }
}
