//! Illuminants: the CIE's spectra of the lights under which people look at things, and their whites.
//!
//! Source: CIE 15:2004, §3 and tables T.1, T.2. The components of daylight are D. B. Judd, D. L. MacAdam and
//! G. Wyszecki's (J. Opt. Soc. Am. 54, 1031, 1964).

use super::observer::{OBSERVER_NM, sampled, seen};
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::{fmt, ops::RangeInclusive, str::FromStr};

/// The correlated colour temperatures of daylight for which the CIE gives a spectrum, in kelvin.
pub const DAYLIGHT_KELVIN: RangeInclusive<f64> = 4000.0..=25000.0;

/// The temperature of D65 in kelvin. It was 6500 K when c2 was taken as 0.014380 m K (CIE 15:2004, note 5).
const D65_KELVIN: f64 = 6500.0 * 1.4388 / 1.4380;

/// A light, given by its relative spectrum. Its name is `D65`, `A`, `E` or `5000 K`, in files as in text.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Illuminant {
    /// Noon daylight, whose white is sRGB's.
    D65,
    /// A tungsten lamp of 2856 K.
    A,
    /// The same power at every wavelength.
    E,
    /// Daylight of a correlated colour temperature in kelvin; D50 is 5002.78 K.
    ///
    /// The temperature is within [`DAYLIGHT_KELVIN`], which parsing and deserialising check.
    Daylight(f64),
}

/// The reason why a text does not name an illuminant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum IlluminantError {
    /// The text is neither a name nor a temperature.
    #[error(
        "no illuminant is called '{text}': give D65, A, E, or daylight of 4000 to 25000 kelvin as 5000 K"
    )]
    Unknown {
        /// The text given.
        text: String,
    },
    /// The CIE gives no spectrum for daylight of this temperature.
    #[error("daylight of {kelvin} K has no spectrum: give 4000 to 25000 K, or D65, A or E")]
    Temperature {
        /// The temperature given, in kelvin.
        kelvin: f64,
    },
}

/// The wavelength in nm at which the components of daylight begin; they end at 830 nm.
const DAYLIGHT_FROM_NM: f64 = 300.0;

/// The step between two samples of the components, in nm.
const DAYLIGHT_STEP_NM: f64 = 10.0;

/// S0, the mean daylight.
const S0: [f64; 54] = [
    0.04, 6.0, 29.6, 55.3, 57.3, 61.8, 61.5, 68.8, 63.4, 65.8, 94.8, 104.8, 105.9, 96.8, 113.9, 125.6, 125.5,
    121.3, 121.3, 113.5, 113.1, 110.8, 106.5, 108.8, 105.3, 104.4, 100.0, 96.0, 95.1, 89.1, 90.5, 90.3, 88.4,
    84.0, 85.1, 81.9, 82.6, 84.9, 81.3, 71.9, 74.3, 76.4, 63.3, 71.7, 77.0, 65.2, 47.7, 68.6, 65.0, 66.0,
    61.0, 53.3, 58.9, 61.9,
];

/// S1, the variation from blue to yellow.
const S1: [f64; 54] = [
    0.02, 4.5, 22.4, 42.0, 40.6, 41.6, 38.0, 42.4, 38.5, 35.0, 43.4, 46.3, 43.9, 37.1, 36.7, 35.9, 32.6,
    27.9, 24.3, 20.1, 16.2, 13.2, 8.6, 6.1, 4.2, 1.9, 0.0, -1.6, -3.5, -3.5, -5.8, -7.2, -8.6, -9.5, -10.9,
    -10.7, -12.0, -14.0, -13.6, -12.0, -13.3, -12.9, -10.6, -11.6, -12.2, -10.2, -7.8, -11.2, -10.4, -10.6,
    -9.7, -8.3, -9.3, -9.8,
];

/// S2, the variation from pink to green.
const S2: [f64; 54] = [
    0.0, 2.0, 4.0, 8.5, 7.8, 6.7, 5.3, 6.1, 3.0, 1.2, -1.1, -0.5, -0.7, -1.2, -2.6, -2.9, -2.8, -2.6, -2.6,
    -1.8, -1.5, -1.3, -1.2, -1.0, -0.5, -0.3, 0.0, 0.2, 0.5, 2.1, 3.2, 4.1, 4.7, 5.1, 6.7, 7.3, 8.6, 9.8,
    10.2, 8.3, 9.6, 8.5, 7.0, 7.6, 8.0, 6.7, 5.2, 7.4, 6.8, 7.0, 6.4, 5.5, 6.1, 6.5,
];

impl Illuminant {
    /// Returns the relative spectral power at a wavelength > 0, 100 at 560 nm. Daylight has no power outside 300 to
    /// 830 nm.
    pub fn power(&self, nm: f64) -> f64 {
        match *self {
            Self::D65 => daylight(D65_KELVIN, nm),
            Self::A => tungsten(nm),
            Self::E => 100.0,
            Self::Daylight(kelvin) => daylight(kelvin, nm),
        }
    }

    /// Returns XYZ of a white surface in this light, with Y = 1.
    pub fn white(&self) -> DVec3 {
        let xyz = seen(*OBSERVER_NM.start(), *OBSERVER_NM.end(), |nm| self.power(nm));
        xyz / xyz.y
    }
}

/// Returns the power of illuminant A: Planck's law at 2848 K with c2 = 1.435e7 nm K, as it was first defined; with
/// today's c2 this is 2856 K.
fn tungsten(nm: f64) -> f64 {
    let planck = |nm: f64| nm.powi(-5) / (1.435e7 / (2848.0 * nm)).exp_m1();
    100.0 * planck(nm) / planck(560.0)
}

/// Returns the power of daylight, S0 + M1 S1 + M2 S2.
fn daylight(kelvin: f64, nm: f64) -> f64 {
    let (m1, m2) = shares(daylight_xy(kelvin));
    let [s0, s1, s2] = [&S0, &S1, &S2].map(|table| sampled(table, DAYLIGHT_FROM_NM, DAYLIGHT_STEP_NM, nm));
    s0 + m1 * s1 + m2 * s2
}

/// Returns M1 and M2 of a chromaticity, to 3 decimals as CIE 15:2004, note 5, prescribes.
fn shares((x, y): (f64, f64)) -> (f64, f64) {
    let divisor = 0.0241 + 0.2562 * x - 0.7341 * y;
    let rounded = |share: f64| (1e3 * share / divisor).round() / 1e3;
    (rounded(-1.3515 - 1.7703 * x + 5.9114 * y), rounded(0.0300 - 31.4424 * x + 30.0717 * y))
}

/// Returns the chromaticity (x, y) of daylight.
fn daylight_xy(kelvin: f64) -> (f64, f64) {
    let [c3, c2, c1, c0] = if kelvin <= 7000.0 {
        [-4.6070e9, 2.9678e6, 0.09911e3, 0.244063]
    } else {
        [-2.0064e9, 1.9018e6, 0.24748e3, 0.237040]
    };
    let x = ((c3 / kelvin + c2) / kelvin + c1) / kelvin + c0;
    (x, (-3.000 * x + 2.870) * x - 0.275)
}

impl FromStr for Illuminant {
    type Err = IlluminantError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let name = text.trim().to_ascii_uppercase();
        match name.as_str() {
            "D65" => return Ok(Self::D65),
            "A" => return Ok(Self::A),
            "E" => return Ok(Self::E),
            _ => {}
        }
        let kelvin = name.strip_suffix('K').and_then(|number| number.trim_end().parse::<f64>().ok());
        let kelvin = kelvin.ok_or_else(|| IlluminantError::Unknown { text: text.to_owned() })?;
        if DAYLIGHT_KELVIN.contains(&kelvin) {
            return Ok(Self::Daylight(kelvin));
        }
        Err(IlluminantError::Temperature { kelvin })
    }
}

impl fmt::Display for Illuminant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::D65 => f.write_str("D65"),
            Self::A => f.write_str("A"),
            Self::E => f.write_str("E"),
            Self::Daylight(kelvin) => write!(f, "{kelvin} K"),
        }
    }
}

impl TryFrom<String> for Illuminant {
    type Error = IlluminantError;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        text.parse()
    }
}

impl From<Illuminant> for String {
    fn from(illuminant: Illuminant) -> Self {
        illuminant.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// D50, whose 5000 K is converted to today's c2 as the 6500 K of D65 is.
    const D50: Illuminant = Illuminant::Daylight(5000.0 * 1.4388 / 1.4380);

    fn assert_prints(light: Illuminant, rows: &[(f64, f64)], within: f64) {
        for &(nm, printed) in rows {
            assert!((light.power(nm) - printed).abs() < within, "{light} at {nm}: {}", light.power(nm));
        }
    }

    #[test]
    fn spectra_have_the_printed_values() {
        let d65 = [
            (300.0, 0.0341),
            (380.0, 49.9755),
            (400.0, 82.7549),
            (435.0, 95.7736),
            (460.0, 117.812),
            (500.0, 109.354),
            (560.0, 100.0),
            (600.0, 90.0062),
            (700.0, 71.6091),
            (830.0, 60.3125),
        ];
        assert_prints(Illuminant::D65, &d65, 6e-4);
        assert_prints(D50, &[(400.0, 49.308), (450.0, 87.247), (500.0, 95.724)], 1e-3);
        assert_prints(D50, &[(560.0, 100.0), (600.0, 97.688), (650.0, 95.667), (700.0, 91.604)], 1e-3);
        assert_prints(Illuminant::A, &[(380.0, 9.79510), (560.0, 100.0), (700.0, 198.261)], 6e-4);
        assert_prints(Illuminant::E, &[(360.0, 100.0), (560.0, 100.0)], 1e-15);
    }

    #[test]
    fn whites_have_the_printed_chromaticities() {
        for (light, x, y) in [
            (Illuminant::D65, 0.31272, 0.32903),
            (D50, 0.34567, 0.35851),
            (Illuminant::A, 0.44757, 0.40745),
            (Illuminant::E, 1.0 / 3.0, 1.0 / 3.0),
        ] {
            let white = light.white();
            let sum = white.element_sum();
            assert_eq!(white.y, 1.0);
            assert!(
                (white.x / sum - x).abs() < 6e-5 && (1.0 / sum - y).abs() < 6e-5,
                "{light}: {}",
                white / sum
            );
        }
    }

    #[test]
    fn the_two_pieces_of_daylight_meet() {
        let (below, above) = (daylight_xy(7000.0), daylight_xy(7000.1));
        assert!((below.0 - above.0).abs() < 5e-6 && (below.1 - above.1).abs() < 5e-6);
        // The white of D75 is printed as .29902 and .31485.
        let (x, y) = daylight_xy(7500.0 * 1.4388 / 1.4380);
        assert!((x - 0.29902).abs() < 5e-5 && (y - 0.31485).abs() < 2e-4, "{x} {y}");
    }

    #[test]
    fn daylight_turns_bluer_as_its_temperature_rises() {
        let blue = |kelvin: u32| Illuminant::Daylight(f64::from(kelvin)).white().z;
        let whites: Vec<f64> = (4000..=25000).step_by(250).map(blue).collect();
        assert!(whites.windows(2).all(|pair| pair[0] < pair[1]));
    }

    #[test]
    fn every_power_in_visible_light_is_positive() {
        for light in ["D65", "A", "E", "4000K", "5000K", "7000K", "7001K", "25000K"] {
            let light: Illuminant = light.parse().unwrap();
            assert!((360..=830).all(|nm| light.power(f64::from(nm)) > 0.0), "{light}");
            assert!((light.power(560.0) - 100.0).abs() < 1e-12);
        }
    }

    #[test]
    fn names_are_read_as_they_are_written() {
        for (text, light) in [
            ("D65", Illuminant::D65),
            (" d65 ", Illuminant::D65),
            ("a", Illuminant::A),
            ("E", Illuminant::E),
            ("5000K", Illuminant::Daylight(5000.0)),
            ("5000 k", Illuminant::Daylight(5000.0)),
            ("6504.5 K", Illuminant::Daylight(6504.5)),
        ] {
            assert_eq!(text.parse(), Ok(light));
            assert_eq!(light.to_string().parse(), Ok(light));
            let json = serde_json::to_string(&light).unwrap();
            assert_eq!(json, format!("\"{light}\""));
            assert_eq!(serde_json::from_str::<Illuminant>(&json).unwrap(), light);
        }
        assert_eq!(Illuminant::Daylight(5000.0).to_string(), "5000 K");
    }

    #[test]
    fn what_is_no_illuminant_is_told_what_is() {
        for text in ["", "K", "B", "5000", "D", "five K", "65D"] {
            let error = text.parse::<Illuminant>().expect_err("no illuminant").to_string();
            assert!(error.contains(&format!("'{text}'")) && error.contains("D65, A, E"), "{error}");
        }
        for text in ["3999.9 K", "25001K", "-5000 K", "NaN K", "inf K"] {
            let error = text.parse::<Illuminant>().expect_err("no daylight").to_string();
            assert!(error.starts_with("daylight of") && error.contains("4000 to 25000 K"), "{error}");
        }
        assert!(serde_json::from_str::<Illuminant>("\"100 K\"").is_err());
    }
}
