//! The fading of light on its way through a coloured stone: the law of Beer and Lambert, per wavelength.
//!
//! Coefficients are Napierian (base e) and per millimetre of stone: T = exp(-a l) (J. H. Lambert 1760, A. Beer 1852).
//! Decadic absorbance, which some sources print, must first be divided by 0.4343.

use super::dispersion::VISIBLE_NM;
use super::real::Real;
use super::strata::basis;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// The largest coefficient that is accepted, per mm: metals reach 1e5.
pub const MOST_PER_MM: f64 = 1e6;

/// Returns the share of the intensity that is left after a path, for the absorption coefficients of two polarisations, per
/// unit of the path: the mean of both, each of which is half of the light.
#[inline(always)]
pub fn transmittance<N: Real>([o, e]: [N; 2], path: N) -> N {
    path.constant(0.5) * ((-o * path).exp() + (-e * path).exp())
}

/// An absorption spectrum: straight lines between samples, and constant outside them. Without samples the stone is
/// clear; with one sample it is grey.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(try_from = "Vec<(f64, f64)>", into = "Vec<(f64, f64)>")]
pub struct Absorption {
    /// (nm, per mm); wavelengths strictly increasing, all finite and > 0; coefficients 0 to [`MOST_PER_MM`].
    samples: Vec<(f64, f64)>,
}

/// The reason why an absorption spectrum is refused. Samples are counted from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum AbsorptionError {
    /// The wavelength of the sample is not a positive number.
    #[error("absorption sample {sample} has a wavelength of {nm} nm: give a positive number")]
    Wavelength {
        /// The number of the sample.
        sample: usize,
        /// The wavelength given, in nm.
        nm: f64,
    },
    /// The coefficient is not a number from 0 to [`MOST_PER_MM`].
    #[error("absorption sample {sample} ({nm} nm) has a coefficient of {per_mm} per mm: give 0 to 1e6")]
    Coefficient {
        /// The number of the sample.
        sample: usize,
        /// Its wavelength in nm.
        nm: f64,
        /// The coefficient given, per mm.
        per_mm: f64,
    },
    /// The wavelength of the sample does not exceed that of the sample before.
    #[error(
        "absorption sample {sample} ({nm} nm) follows one at {previous} nm: list wavelengths in increasing \
         order, each once"
    )]
    Order {
        /// The number of the sample.
        sample: usize,
        /// Its wavelength in nm.
        nm: f64,
        /// The wavelength before it in nm.
        previous: f64,
    },
}

/// The least share of light that is left at any wavelength by a spectrum made of a colour.
const LEAST_LEFT: f64 = 1e-4;

impl TryFrom<Vec<(f64, f64)>> for Absorption {
    type Error = AbsorptionError;

    fn try_from(samples: Vec<(f64, f64)>) -> Result<Self, AbsorptionError> {
        Self::new(samples)
    }
}

impl From<Absorption> for Vec<(f64, f64)> {
    fn from(absorption: Absorption) -> Self {
        absorption.samples
    }
}

impl Absorption {
    /// Makes a spectrum that runs through these samples: (wavelength in nm, coefficient per mm).
    ///
    /// # Errors
    /// The error names the first sample whose wavelength is not positive, whose coefficient is not from 0 to
    /// [`MOST_PER_MM`], or whose wavelength does not exceed that of the sample before.
    pub fn new(samples: Vec<(f64, f64)>) -> Result<Self, AbsorptionError> {
        let mut previous = 0.0;
        for (&(nm, per_mm), sample) in samples.iter().zip(1..) {
            if !(nm.is_finite() && nm > 0.0) {
                return Err(AbsorptionError::Wavelength { sample, nm });
            }
            if !(0.0..=MOST_PER_MM).contains(&per_mm) {
                return Err(AbsorptionError::Coefficient { sample, nm, per_mm });
            }
            if nm <= previous {
                return Err(AbsorptionError::Order { sample, nm, previous });
            }
            previous = nm;
        }
        Ok(Self { samples })
    }

    /// Makes the spectrum of a stone that absorbs nothing.
    pub const fn clear() -> Self {
        Self { samples: Vec::new() }
    }

    /// Makes a smooth spectrum of a stone that gives daylight this colour, linear sRGB, after a path of `mm`
    /// millimetres.
    ///
    /// The share of light that is left is the mixture of the spectra of red, green and blue ([`basis`]) that looks
    /// like the colour. Colour components are clamped to 0 to 1, and at every wavelength at least a ten-thousandth of
    /// the light is left.
    ///
    /// # Errors
    /// Fails with [`AbsorptionError`] for a path that is not longer than 0, or so short that a coefficient exceeds
    /// [`MOST_PER_MM`].
    pub fn of_colour(colour: DVec3, mm: f64) -> Result<Self, AbsorptionError> {
        let colour = colour.clamp(DVec3::ZERO, DVec3::ONE);
        if colour == DVec3::ONE {
            return Ok(Self::clear());
        }
        let (first, last) = (*VISIBLE_NM.start() as u32, *VISIBLE_NM.end() as u32);
        let sample = |nm: u32| {
            let left = colour.dot(basis(f64::from(nm))).clamp(LEAST_LEFT, 1.0);
            (f64::from(nm), -left.ln() / mm)
        };
        Self::new((first..=last).step_by(5).map(sample).collect())
    }

    /// Returns this spectrum with all coefficients multiplied by `factor`, which is at least 0, and limited to
    /// [`MOST_PER_MM`].
    pub fn scaled(&self, factor: f64) -> Self {
        let scaled = |&(nm, per_mm): &(f64, f64)| (nm, (per_mm * factor).clamp(0.0, MOST_PER_MM));
        Self { samples: self.samples.iter().map(scaled).collect() }
    }

    /// Returns whether the stone absorbs nothing at any wavelength, so that a tracer may leave absorption out.
    pub fn is_clear(&self) -> bool {
        self.samples.iter().all(|&(_, per_mm)| per_mm == 0.0)
    }

    /// Returns the samples: (wavelength in nm, coefficient per mm).
    pub fn samples(&self) -> &[(f64, f64)] {
        &self.samples
    }

    /// Returns the absorption coefficient at a wavelength, per mm, >= 0.
    pub fn coefficient(&self, wavelength_nm: f64) -> f64 {
        let above = self.samples.partition_point(|&(nm, _)| nm <= wavelength_nm);
        let (before, after) = self.samples.split_at(above);
        match (before.last(), after.first()) {
            (Some(&(nm0, a0)), Some(&(nm1, a1))) => a0 + (a1 - a0) * (wavelength_nm - nm0) / (nm1 - nm0),
            (Some(&(_, level)), None) | (None, Some(&(_, level))) => level,
            (None, None) => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spectrum() -> Absorption {
        Absorption::new(vec![(400.0, 0.1), (500.0, 0.3), (700.0, 0.0)]).expect("a good spectrum")
    }

    #[test]
    fn samples_are_joined_by_straight_lines() {
        for (nm, expected) in
            [(400.0, 0.1), (450.0, 0.2), (500.0, 0.3), (550.0, 0.225), (600.0, 0.15), (700.0, 0.0)]
        {
            assert!((spectrum().coefficient(nm) - expected).abs() < 1e-15, "at {nm} nm");
        }
    }

    #[test]
    fn a_spectrum_is_level_beyond_its_ends() {
        assert_eq!(spectrum().coefficient(360.0), 0.1);
        assert_eq!(spectrum().coefficient(830.0), 0.0);
    }

    #[test]
    fn no_sample_is_clear_and_one_is_grey() {
        assert_eq!(Absorption::clear().coefficient(550.0), 0.0);
        let grey = Absorption::new(vec![(550.0, 0.2)]).expect("one sample will do");
        assert_eq!([360.0, 550.0, 830.0].map(|nm| grey.coefficient(nm)), [0.2; 3]);
        assert!(Absorption::default().is_clear() && !grey.is_clear() && !spectrum().is_clear());
    }

    #[test]
    fn a_bad_sample_is_named() {
        let fault = |samples: &[(f64, f64)]| Absorption::new(samples.to_vec()).expect_err("bad").to_string();
        assert!(
            fault(&[(400.0, 0.1), (500.0, -0.1)])
                .starts_with("absorption sample 2 (500 nm) has a coefficient of -0.1")
        );
        assert!(fault(&[(400.0, f64::NAN)]).contains("sample 1"));
        assert!(fault(&[(400.0, f64::INFINITY)]).contains("inf per mm"));
        assert!(fault(&[(0.0, 0.1)]).contains("wavelength of 0 nm"));
        assert!(fault(&[(f64::NAN, 0.1)]).contains("wavelength of NaN nm"));
        assert!(fault(&[(500.0, 0.1), (500.0, 0.2)]).contains("sample 2 (500 nm) follows one at 500 nm"));
        assert!(fault(&[(400.0, 0.1), (500.0, 0.1), (450.0, 0.2)]).contains("sample 3"));
    }
}
