//! Laws of dispersion: the refractive index as a function of the wavelength, in the forms in which such laws are
//! published.
//!
//! Every law is written with the wavelength L in micrometres, as its source prints it. Every function takes nanometres.

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::ops::RangeInclusive;

/// The range of wavelengths in nm within which every law must give an index and must have no resonance: the range of
/// the tables of the CIE 1931 observer, beyond which the eye sees nothing.
pub const VISIBLE_NM: RangeInclusive<f64> = 360.0..=830.0;

/// The refractive indices that a material may have: from that of air to somewhat more than that of any clear solid.
pub const INDICES: RangeInclusive<f64> = 1.0..=6.0;

/// [`INDICES`] in words, for errors.
pub const INDICES_IN_WORDS: &str = "1 (air) to 6";

/// The spectral lines by which gemmology and optics name wavelengths, in nm (in air).
pub mod line {
    /// Sodium D, the mean of the doublet, at which a gem's index is quoted.
    pub const SODIUM_D: f64 = 589.3;
    /// Fraunhofer B, the red end of a gem's dispersion.
    pub const FRAUNHOFER_B: f64 = 686.7;
    /// Fraunhofer G, the violet end of a gem's dispersion.
    pub const FRAUNHOFER_G: f64 = 430.8;
    /// Hydrogen C, the red end of an Abbe number.
    pub const HYDROGEN_C: f64 = 656.3;
    /// Hydrogen F, the blue end of an Abbe number.
    pub const HYDROGEN_F: f64 = 486.1;
    /// Helium d, at which the index that goes with an Abbe number is quoted.
    pub const HELIUM_D: f64 = 587.6;
}

/// A law of dispersion: the refractive index as a function of the wavelength.
///
/// A law made by hand should come from a trusted source. [`Dispersion::checked`] tests any law; deserialising does so
/// too.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields, remote = "Self")]
pub enum Dispersion {
    /// The same index at every wavelength.
    Constant(f64),
    /// Sellmeier's law, n² = A + Σ B L² / (L² - C²), with C *unsquared* as printed, in um (W. Sellmeier, 1871).
    Sellmeier {
        /// A, 1 where the source prints none.
        #[serde(default = "one")]
        constant: f64,
        /// The (B, C) pairs; C in um.
        #[serde(deserialize_with = "pairs")]
        terms: Vec<(f64, f64)>,
    },
    /// A rational law, n² = A + Σ B L² / (L² - C) + Σ P / (L² - Q) + D L², for sources that print C already squared, in um².
    Rational {
        /// A, 1 where the source prints none.
        #[serde(default = "one")]
        constant: f64,
        /// The (B, C) pairs; C in um².
        #[serde(default, deserialize_with = "pairs")]
        terms: Vec<(f64, f64)>,
        /// The (P, Q) pairs, both in um².
        #[serde(default, deserialize_with = "pairs")]
        poles: Vec<(f64, f64)>,
        /// D, per um².
        #[serde(default)]
        slope: f64,
    },
    /// Cauchy's law, n = A + B / L² (A.-L. Cauchy, 1836).
    Cauchy {
        /// A, the index at long wavelengths.
        a: f64,
        /// B, in um².
        b: f64,
    },
    /// The law of glTF's KHR_materials_dispersion (Khronos 2024), n = max(n_d + (n_d - 1) / V_d · (0.523655 / L² - 1.5168),
    /// 1).
    Abbe {
        /// The index at the helium d line.
        n_d: f64,
        /// The Abbe number, > 0; the extension stores 20 / V_d.
        v_d: f64,
    },
}

/// The reason why a law of dispersion is refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DispersionError {
    /// The law gives no real index of at least 1 at a wavelength.
    #[error(
        "the dispersion gives no refractive index of 1 or more at {nm} nm (n² = {n_squared}): check its \
         coefficients, which belong to wavelengths in micrometres"
    )]
    NoIndex {
        /// The wavelength in nm.
        nm: f64,
        /// The square of the index that the formula gives.
        n_squared: f64,
    },
    /// The wavelength is not a positive number.
    #[error("a wavelength of {nm} nm: give a positive number")]
    Wavelength {
        /// The wavelength given, in nm.
        nm: f64,
    },
    /// A term of the law is infinite at a wavelength of visible light.
    #[error(
        "the dispersion has a resonance at {nm:.1} nm, in visible light (360 to 830 nm): check whether its \
         source prints C squared (use `rational`) or not (use `sellmeier`)"
    )]
    Resonance {
        /// The wavelength of the resonance in nm.
        nm: f64,
    },
    /// The Abbe number is not above 0.
    #[error("an Abbe number of {v_d}: give a number above 0")]
    AbbeNumber {
        /// The number given.
        v_d: f64,
    },
}

impl Dispersion {
    /// Makes Cauchy's law from the two numbers that gem tables print: the index at the sodium D line and the dispersion.
    ///
    /// The dispersion is B-G = n(G) - n(B). Then B = (B-G) / 3.2676 and A = n_D - 2.8796 B.
    pub fn cauchy_from(n_d: f64, b_minus_g: f64) -> Self {
        let b = b_minus_g / (per_um2(line::FRAUNHOFER_G) - per_um2(line::FRAUNHOFER_B));
        Self::Cauchy { a: n_d - b * per_um2(line::SODIUM_D), b }
    }

    /// Returns the index at a wavelength in nm.
    ///
    /// # Panics
    /// Panics where [`Dispersion::try_index`] returns an error. For a [`Dispersion::checked`] law it never does so in
    /// visible light.
    pub fn index(&self, wavelength_nm: f64) -> f64 {
        self.try_index(wavelength_nm).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Returns the index at a wavelength in nm, at least 1.
    ///
    /// # Errors
    /// Fails where the law gives no index that is real, finite and at least 1.
    pub fn try_index(&self, wavelength_nm: f64) -> Result<f64, DispersionError> {
        if !(wavelength_nm > 0.0 && wavelength_nm.is_finite()) {
            return Err(DispersionError::Wavelength { nm: wavelength_nm });
        }
        let n_squared = self.n_squared(wavelength_nm);
        if n_squared.is_finite() && n_squared >= 1.0 {
            return Ok(n_squared.sqrt());
        }
        Err(DispersionError::NoIndex { nm: wavelength_nm, n_squared })
    }

    /// Returns the law itself, if it gives an index throughout visible light.
    ///
    /// # Errors
    /// The error names a resonance in visible light, a wavelength there without an index, or an Abbe number that is
    /// not above 0.
    pub fn checked(self) -> Result<Self, DispersionError> {
        if let Self::Abbe { v_d, .. } = self
            && !(v_d > 0.0 && v_d.is_finite())
        {
            return Err(DispersionError::AbbeNumber { v_d });
        }
        // The scan below could step over a narrow resonance, so resonances are computed exactly.
        if let Some(nm) = self.resonances_nm().into_iter().find(|nm| VISIBLE_NM.contains(nm)) {
            return Err(DispersionError::Resonance { nm });
        }
        let steps = (VISIBLE_NM.end() - VISIBLE_NM.start()) as u32;
        (0..=steps).try_for_each(|step| self.try_index(VISIBLE_NM.start() + f64::from(step)).map(drop))?;
        Ok(self)
    }

    /// Returns the dispersion n(430.8 nm) - n(686.7 nm), which gem tables print. Panics as [`Dispersion::index`]
    /// does.
    pub fn dispersion_b_g(&self) -> f64 {
        self.index(line::FRAUNHOFER_G) - self.index(line::FRAUNHOFER_B)
    }

    /// Returns the Abbe number V_d = (n_d - 1) / (n_F - n_C); `None` without dispersion. Panics as [`Dispersion::index`]
    /// does.
    pub fn abbe_number(&self) -> Option<f64> {
        let spread = self.index(line::HYDROGEN_F) - self.index(line::HYDROGEN_C);
        (spread != 0.0).then(|| (self.index(line::HELIUM_D) - 1.0) / spread)
    }

    /// Returns the square of the index. A negative index gives a negative square, so that the law is refused.
    fn n_squared(&self, nm: f64) -> f64 {
        let l2 = 1.0 / per_um2(nm);
        let signed_square = |n: f64| n * n.abs();
        match self {
            Self::Constant(n) => signed_square(*n),
            Self::Sellmeier { constant, terms } => {
                constant + terms.iter().map(|(b, c)| b * l2 / (l2 - c * c)).sum::<f64>()
            }
            Self::Rational { constant, terms, poles, slope } => {
                let terms: f64 = terms.iter().map(|(b, c)| b * l2 / (l2 - c)).sum();
                let poles: f64 = poles.iter().map(|(p, q)| p / (l2 - q)).sum();
                constant + terms + poles + slope * l2
            }
            Self::Cauchy { a, b } => signed_square(a + b / l2),
            Self::Abbe { n_d, v_d } => {
                let n = n_d + (n_d - 1.0) / v_d * (0.523655 / l2 - 1.5168);
                // `f64::max` would turn a NaN into 1.
                if n < 1.0 { 1.0 } else { signed_square(n) }
            }
        }
    }

    /// Returns the wavelengths in nm at which a term is infinite.
    fn resonances_nm(&self) -> Vec<f64> {
        let squares: Vec<f64> = match self {
            Self::Sellmeier { terms, .. } => terms.iter().map(|(_, c)| c * c).collect(),
            Self::Rational { terms, poles, .. } => terms.iter().chain(poles).map(|(_, c)| *c).collect(),
            Self::Constant(_) | Self::Cauchy { .. } | Self::Abbe { .. } => Vec::new(),
        };
        squares.into_iter().filter(|c| *c > 0.0).map(|c| 1e3 * c.sqrt()).collect()
    }
}

// `remote = "Self"` makes the derived functions inherent functions of the type, so that the two trait implementations
// below can add the check.
impl Serialize for Dispersion {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Self::serialize(self, serializer)
    }
}

impl<'de> Deserialize<'de> for Dispersion {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::deserialize(deserializer)?.checked().map_err(serde::de::Error::custom)
    }
}

/// Deserialises lists of exactly two numbers; serde's own tuples accept more.
fn pairs<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<(f64, f64)>, D::Error> {
    let pair = |list: Vec<f64>| match list[..] {
        [first, second] => Ok((first, second)),
        _ => Err(serde::de::Error::custom(format!(
            "a pair of numbers is expected, not a list of {}",
            list.len()
        ))),
    };
    Vec::<Vec<f64>>::deserialize(deserializer)?.into_iter().map(pair).collect()
}

fn one() -> f64 {
    1.0
}

/// Returns 1 / L² with L in um.
fn per_um2(nm: f64) -> f64 {
    1e6 / (nm * nm)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::de::value::{Error, MapAccessDeserializer, MapDeserializer};
    use std::collections::BTreeMap;

    fn assert_prints(what: &str, value: f64, printed: f64, digits: i32) {
        assert!(
            (value - printed).abs() <= 0.5 * 10_f64.powi(-digits),
            "{what}: {value}, printed as {printed}"
        );
    }

    fn read(variant: &str, fields: &[(&str, f64)]) -> Result<Dispersion, Error> {
        let fields: BTreeMap<&str, f64> = fields.iter().copied().collect();
        let map = MapDeserializer::new(std::iter::once((variant, fields)));
        <Dispersion as Deserialize>::deserialize(MapAccessDeserializer::new(map))
    }

    // The laws of ordinary rays are in the table of materials and are tested there.
    #[test]
    fn extraordinary_rays_have_the_indices_their_authors_print() {
        let sapphire = Dispersion::Sellmeier {
            constant: 1.0,
            terms: vec![(1.5039759, 0.0740288), (0.55069141, 0.1216529), (6.5927379, 20.072248)],
        };
        let quartz = Dispersion::Rational {
            constant: 1.28851804,
            terms: vec![(1.09509924, 0.0102101864), (1.15662475, 100.0)],
            poles: vec![],
            slope: 0.0,
        };
        let moissanite = Dispersion::Rational {
            constant: 6.7452,
            terms: vec![],
            poles: vec![(0.15352, 0.03597)],
            slope: -0.02249,
        };
        let rutile = Dispersion::Rational {
            constant: 7.197,
            terms: vec![],
            poles: vec![(0.3322, 0.0843)],
            slope: 0.0,
        };
        for (name, law, n) in [
            ("sapphire e", &sapphire, 1.76000),
            ("quartz e", &quartz, 1.55331),
            ("moissanite e", &moissanite, 2.68897),
            ("rutile e", &rutile, 2.90865),
        ] {
            assert_prints(name, law.index(line::SODIUM_D), n, 5);
            assert_eq!(law.clone().checked().as_ref(), Ok(law));
        }
        assert_prints("sapphire e, B-G", sapphire.dispersion_b_g(), 0.01775, 5);
        let c_f = sapphire.index(line::HYDROGEN_F) - sapphire.index(line::HYDROGEN_C);
        assert_prints("sapphire e, C-F", c_f, 0.01042, 5);
    }

    #[test]
    fn squared_and_unsquared_resonances_are_the_same_law() {
        let terms = [(2.28200, 0.01185), (3.27644, 282.734)];
        let squared =
            Dispersion::Rational { constant: 1.0, terms: terms.to_vec(), poles: vec![], slope: 0.0 };
        let plain =
            Dispersion::Sellmeier { constant: 1.0, terms: terms.map(|(b, c)| (b, c.sqrt())).to_vec() };
        for nm in 360..=830 {
            assert!((squared.index(nm.into()) - plain.index(nm.into())).abs() < 1e-15);
        }
    }

    #[test]
    fn cauchy_from_two_numbers_returns_those_numbers() {
        let topaz = Dispersion::cauchy_from(1.62, 0.014);
        assert!((topaz.index(line::SODIUM_D) - 1.62).abs() < 1e-15);
        assert!((topaz.dispersion_b_g() - 0.014).abs() < 1e-15);
        let Dispersion::Cauchy { a, b } = topaz else { panic!("not Cauchy's law") };
        assert_prints("the divisor of B", 0.014 / b, 3.2676, 4);
        assert_prints("the factor of A", (1.62 - a) / b, 2.8796, 4);
    }

    #[test]
    fn abbe_number_and_index_of_the_gltf_law_are_those_given() {
        // The extension rounds its constants, so the last digit or two may differ.
        let law = Dispersion::Abbe { n_d: 2.418, v_d: 55.0 };
        assert!((law.index(line::HELIUM_D) - 2.418).abs() < 1e-5);
        assert!((law.abbe_number().expect("it disperses") - 55.0).abs() < 0.03);
        assert!((law.index(500.0) - (2.418 + 1.418 / 55.0 * (523655.0 / 250000.0 - 1.5168))).abs() < 1e-15);
    }

    #[test]
    fn the_gltf_law_never_falls_below_one() {
        let law = Dispersion::Abbe { n_d: 1.33, v_d: 0.5 };
        assert_eq!(law.index(830.0), 1.0);
    }

    #[test]
    fn a_constant_index_has_no_dispersion_and_no_abbe_number() {
        assert_eq!(Dispersion::Constant(1.5).dispersion_b_g(), 0.0);
        assert_eq!(Dispersion::Constant(1.5).abbe_number(), None);
    }

    #[test]
    fn wavelengths_without_an_index_are_errors() {
        let rutile = Dispersion::Rational {
            constant: 5.913,
            terms: vec![],
            poles: vec![(0.2441, 0.0803)],
            slope: 0.0,
        };
        assert!(matches!(rutile.try_index(250.0), Err(DispersionError::NoIndex { nm: 250.0, .. })));
        for nm in [0.0, -500.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(rutile.try_index(nm), Err(DispersionError::Wavelength { .. })));
        }
        let at_the_pole = Dispersion::Sellmeier { constant: 1.0, terms: vec![(1.0, 0.5)] };
        assert!(matches!(at_the_pole.try_index(500.0), Err(DispersionError::NoIndex { .. })));
    }

    #[test]
    fn the_door_refuses_laws_that_fail_in_visible_light() {
        use DispersionError::*;
        let pole = Dispersion::Sellmeier { constant: 1.0, terms: vec![(1e-9, 0.5004)] };
        assert!(matches!(pole.checked(), Err(Resonance { nm }) if (nm - 500.4).abs() < 1e-9));
        for v_d in [0.0, -30.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(Dispersion::Abbe { n_d: 1.5, v_d }.checked(), Err(AbbeNumber { .. })));
        }
        for law in [
            Dispersion::Constant(0.9),
            Dispersion::Constant(-1.5),
            Dispersion::Constant(f64::NAN),
            Dispersion::Constant(f64::INFINITY),
            Dispersion::Cauchy { a: -1.5, b: 0.0 },
            Dispersion::Abbe { n_d: f64::NAN, v_d: 50.0 },
        ] {
            assert!(matches!(law.clone().checked(), Err(NoIndex { .. })), "{law:?}");
        }
    }

    #[test]
    fn a_law_read_from_a_file_passes_the_same_door() {
        assert_eq!(read("cauchy", &[("a", 1.5), ("b", 0.004)]), Ok(Dispersion::Cauchy { a: 1.5, b: 0.004 }));
        let error = read("cauchy", &[("a", 0.5), ("b", 0.004)]).expect_err("an index below 1").to_string();
        assert!(error.contains("at 360 nm"), "{error}");
        assert!(read("cauchy", &[("a", 1.5), ("b", 0.004), ("c", 0.0)]).is_err(), "an unknown coefficient");
    }
}
