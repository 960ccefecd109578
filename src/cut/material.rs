//! What a cut file says of its material: data only, which `optics` turns into a material.

/// The material of a stone, as written.
#[derive(Debug, Clone, PartialEq)]
pub enum MaterialRef {
    /// A material of the library, by name.
    Name(String),
    /// A refractive index for every wavelength, 1 to 5, without absorption.
    Index(f64),
    /// A material of the file's own.
    Custom(MaterialTable),
}

/// A material of a file's own.
#[derive(Debug, Clone, PartialEq)]
pub struct MaterialTable {
    /// What it is called.
    pub name: Option<String>,
    /// How its index depends on the wavelength.
    pub dispersion: Dispersion,
    /// What it absorbs; nothing if `None`.
    pub absorption: Option<Absorption>,
}

/// How a refractive index depends on the wavelength; L is the vacuum wavelength in micrometres.
#[derive(Debug, Clone, PartialEq)]
pub enum Dispersion {
    /// One index for every wavelength, 1 to 5.
    Index(f64),
    /// Pairs [B, C] of n² - 1 = Σ B L² / (L² - C²), C in micrometres, unsquared.
    Sellmeier(Vec<[f64; 2]>),
    /// [A, B] of n = A + B / L², B in square micrometres.
    Cauchy([f64; 2]),
    /// [n_d, v_d]: the index at 587.6 nm and the Abbe number.
    Abbe([f64; 2]),
}

/// The absorption coefficient, per millimetre of path (natural logarithm).
#[derive(Debug, Clone, PartialEq)]
pub enum Absorption {
    /// The same at every wavelength.
    Uniform(f64),
    /// Pairs [wavelength in nm, coefficient per mm], wavelengths rising.
    Spectrum(Vec<[f64; 2]>),
}

/// What is wrong with a material; each names its key.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum MaterialError {
    /// A blank name, or one with control characters.
    #[error("{key}: a name of printable characters is expected")]
    Name {
        /// The key at fault.
        key: &'static str,
    },
    /// An index that no material has.
    #[error("{key}: the index {value} must be from 1 (vacuum) to 5")]
    Index {
        /// The key at fault.
        key: &'static str,
        /// What was given.
        value: f64,
    },
    /// A nan or an infinity.
    #[error("{key}: {value} is not a finite number")]
    NotFinite {
        /// The key at fault.
        key: &'static str,
        /// What was given.
        value: f64,
    },
    /// A list without entries.
    #[error("{key}: the list is empty; give at least one pair")]
    Empty {
        /// The key at fault.
        key: &'static str,
    },
    /// An Abbe number that is not positive.
    #[error("abbe: the Abbe number {value} must be above 0; it is the second of [n_d, v_d]")]
    Abbe {
        /// What was given.
        value: f64,
    },
    /// A coefficient below zero, which would make light.
    #[error("absorption: {value} per mm is below 0, which would make light")]
    Gain {
        /// What was given.
        value: f64,
    },
    /// A wavelength that is not above the one before it, or not above 0.
    #[error("absorption: the wavelength {value} nm must be above {previous} nm; list wavelengths rising")]
    Wavelength {
        /// What was given.
        value: f64,
        /// The wavelength before it, or 0.
        previous: f64,
    },
}

impl MaterialError {
    /// The key at fault: `material`, or one of the material's own table.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Name { key } | Self::Index { key, .. } | Self::NotFinite { key, .. } | Self::Empty { key } => key,
            Self::Abbe { .. } => "abbe",
            Self::Gain { .. } | Self::Wavelength { .. } => "absorption",
        }
    }
}

impl MaterialRef {
    /// Checks that every number has a meaning; not whether a named material is known, which `optics` tells.
    pub fn check(&self) -> Result<(), MaterialError> {
        match self {
            Self::Name(name) => check_name("material", name),
            Self::Index(value) => check_index("material", *value),
            Self::Custom(table) => table.check(),
        }
    }
}

impl MaterialTable {
    fn check(&self) -> Result<(), MaterialError> {
        if let Some(name) = &self.name {
            check_name("name", name)?;
        }
        self.dispersion.check()?;
        self.absorption.as_ref().map_or(Ok(()), Absorption::check)
    }
}

impl Dispersion {
    fn check(&self) -> Result<(), MaterialError> {
        match self {
            Self::Index(value) => check_index("index", *value),
            Self::Sellmeier(pairs) => check_pairs("sellmeier", pairs),
            Self::Cauchy([a, b]) => check_index("cauchy", *a).and_then(|()| check_finite("cauchy", *b)),
            Self::Abbe([n_d, v_d]) => {
                check_index("abbe", *n_d)?;
                check_finite("abbe", *v_d)?;
                if *v_d > 0.0 { Ok(()) } else { Err(MaterialError::Abbe { value: *v_d }) }
            }
        }
    }
}

impl Absorption {
    fn check(&self) -> Result<(), MaterialError> {
        match self {
            Self::Uniform(per_mm) => check_coefficient(*per_mm),
            Self::Spectrum(pairs) => {
                check_pairs("absorption", pairs)?;
                pairs.iter().try_fold(0.0, |previous, &[value, per_mm]| {
                    check_coefficient(per_mm)?;
                    if value > previous { Ok(value) } else { Err(MaterialError::Wavelength { value, previous }) }
                })?;
                Ok(())
            }
        }
    }
}

fn check_name(key: &'static str, name: &str) -> Result<(), MaterialError> {
    if super::names::is_printable(name) { Ok(()) } else { Err(MaterialError::Name { key }) }
}

fn check_index(key: &'static str, value: f64) -> Result<(), MaterialError> {
    check_finite(key, value)?;
    if (1.0..=5.0).contains(&value) { Ok(()) } else { Err(MaterialError::Index { key, value }) }
}

fn check_finite(key: &'static str, value: f64) -> Result<(), MaterialError> {
    if value.is_finite() { Ok(()) } else { Err(MaterialError::NotFinite { key, value }) }
}

fn check_pairs(key: &'static str, pairs: &[[f64; 2]]) -> Result<(), MaterialError> {
    if pairs.is_empty() {
        return Err(MaterialError::Empty { key });
    }
    pairs.iter().flatten().try_for_each(|value| check_finite(key, *value))
}

fn check_coefficient(per_mm: f64) -> Result<(), MaterialError> {
    check_finite("absorption", per_mm)?;
    if per_mm >= 0.0 { Ok(()) } else { Err(MaterialError::Gain { value: per_mm }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn own(dispersion: Dispersion) -> MaterialRef {
        MaterialRef::Custom(MaterialTable { name: None, dispersion, absorption: None })
    }

    fn absorbing(absorption: Absorption) -> MaterialRef {
        let dispersion = Dispersion::Index(1.76);
        MaterialRef::Custom(MaterialTable { name: None, dispersion, absorption: Some(absorption) })
    }

    #[test]
    fn every_form_is_taken() {
        let dispersions = [
            Dispersion::Index(1.0),
            Dispersion::Sellmeier(vec![[0.3306, 0.1750], [4.3356, 0.1060]]),
            Dispersion::Cauchy([1.5, 0.004]),
            Dispersion::Abbe([1.76, 72.0]),
        ];
        assert!(dispersions.into_iter().all(|dispersion| own(dispersion).check().is_ok()));
        assert!(absorbing(Absorption::Uniform(0.0)).check().is_ok());
        assert!(absorbing(Absorption::Spectrum(vec![[400.0, 0.1], [700.0, 0.0]])).check().is_ok());
        assert!(MaterialRef::Name("diamond".to_owned()).check().is_ok());
        assert!(MaterialRef::Index(5.0).check().is_ok());
    }

    #[test]
    fn every_fault_is_told_with_its_key() {
        let infinite = f64::INFINITY;
        let named =
            MaterialTable { name: Some(" ".to_owned()), dispersion: Dispersion::Index(2.0), absorption: None };
        let cases = [
            (MaterialRef::Name(String::new()), "material: a name of printable characters is expected"),
            (MaterialRef::Custom(named), "name: a name of printable characters is expected"),
            (MaterialRef::Index(0.9), "material: the index 0.9 must be from 1 (vacuum) to 5"),
            (own(Dispersion::Index(5.1)), "index: the index 5.1 must be from 1 (vacuum) to 5"),
            (own(Dispersion::Index(f64::NAN)), "index: NaN is not a finite number"),
            (own(Dispersion::Sellmeier(vec![])), "sellmeier: the list is empty; give at least one pair"),
            (own(Dispersion::Sellmeier(vec![[1.0, infinite]])), "sellmeier: inf is not a finite number"),
            (own(Dispersion::Cauchy([0.0, 0.0])), "cauchy: the index 0 must be from 1 (vacuum) to 5"),
            (own(Dispersion::Cauchy([1.5, infinite])), "cauchy: inf is not a finite number"),
            (own(Dispersion::Abbe([9.0, 50.0])), "abbe: the index 9 must be from 1 (vacuum) to 5"),
            (
                own(Dispersion::Abbe([1.5, 0.0])),
                "abbe: the Abbe number 0 must be above 0; it is the second of [n_d, v_d]",
            ),
            (absorbing(Absorption::Uniform(-1.0)), "absorption: -1 per mm is below 0, which would make light"),
            (absorbing(Absorption::Spectrum(vec![])), "absorption: the list is empty; give at least one pair"),
            (
                absorbing(Absorption::Spectrum(vec![[500.0, 0.0], [500.0, 0.0]])),
                "absorption: the wavelength 500 nm must be above 500 nm; list wavelengths rising",
            ),
            (
                absorbing(Absorption::Spectrum(vec![[500.0, -0.1]])),
                "absorption: -0.1 per mm is below 0, which would make light",
            ),
        ];
        for (material, expected) in cases {
            let error = material.check().unwrap_err();
            assert_eq!(error.to_string(), expected);
            assert!(expected.starts_with(&format!("{}:", error.key())));
        }
    }
}
