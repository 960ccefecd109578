//! The material of a stone in a cut file. [`brillianteer_optics`] describes the materials themselves.

use brillianteer_optics::{
    Dispersion, DispersionError, INDICES, INDICES_IN_WORDS, Material, UnknownMaterial, VISIBLE_NM,
};
use serde::{Deserialize, Serialize};

/// The densities that a material may have, g/cm³: from aerogel to beyond osmium.
const DENSITIES: std::ops::RangeInclusive<f64> = 0.1..=30.0;

/// The material of a stone, as written in a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MaterialRef {
    /// A material of the library, by its name.
    Name(String),
    /// The same refractive index for every wavelength, from [`INDICES`], without absorption.
    Index(f64),
    /// A material that the file itself defines. Its index is in [`INDICES`] throughout visible light.
    Custom(Box<Material>),
}

/// The fault in a material. Each variant names its key.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MaterialError {
    /// A blank name, or one with control characters.
    #[error("{key}: a name of 1 to 200 printable characters is expected")]
    Name {
        /// The key at fault.
        key: &'static str,
    },
    /// A name that is not in the library.
    #[error("material: {0}")]
    Unknown(#[from] UnknownMaterial),
    /// An index outside [`INDICES`].
    #[error("{key}: the index {value} must be from {INDICES_IN_WORDS}")]
    Index {
        /// The key at fault.
        key: &'static str,
        /// The index as given.
        value: f64,
    },
    /// A law that gives an index above those of [`INDICES`] at some wavelength.
    #[error("{key}: the index {value} at {nm} nm must be at most {}; check the coefficients", INDICES.end())]
    IndexAt {
        /// The key at fault.
        key: &'static str,
        /// The index that the law gives.
        value: f64,
        /// The wavelength, nm.
        nm: f64,
    },
    /// A law that gives no index somewhere in visible light.
    #[error("{key}: {fault}")]
    Dispersion {
        /// The key at fault.
        key: &'static str,
        /// The fault of the law.
        fault: DispersionError,
    },
    /// A range of wavelengths whose first wavelength lies above its last, or one of which is NaN.
    #[error("valid_nm: [{first}, {last}] is not a range; give the first wavelength in nm, then the last")]
    Valid {
        /// The first wavelength, nm.
        first: f64,
        /// The last wavelength, nm.
        last: f64,
    },
    /// A density outside 0.1 to 30 g/cm³.
    #[error("density: {value} must be from {} to {} g/cm³", DENSITIES.start(), DENSITIES.end())]
    Density {
        /// The density as given, g/cm³.
        value: f64,
    },
}

impl MaterialError {
    /// Returns the key at fault: `material`, or one of the material's own table.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Name { key }
            | Self::Index { key, .. }
            | Self::IndexAt { key, .. }
            | Self::Dispersion { key, .. } => key,
            Self::Unknown(_) => "material",
            Self::Valid { .. } => "valid_nm",
            Self::Density { .. } => "density",
        }
    }
}

impl MaterialRef {
    /// Checks that the material exists and that its numbers are in their ranges.
    ///
    /// # Errors
    /// The error names the key that is wrong, and says why.
    pub fn check(&self) -> Result<(), MaterialError> {
        self.material().map(drop)
    }

    /// Returns the material: the library's, a clear one named after its index as in "index 2.42", or the file's own.
    ///
    /// # Errors
    /// The error names the key that is wrong, and says why.
    pub fn material(&self) -> Result<Material, MaterialError> {
        match self {
            Self::Name(name) => {
                check_name("material", name)?;
                Ok(brillianteer_optics::material(name)?.clone())
            }
            Self::Index(index) => {
                check_index("material", *index)?;
                Material::from_index(&format!("index {index}"), *index)
                    .map_err(|fault| MaterialError::Dispersion { key: "material", fault })
            }
            Self::Custom(material) => {
                check_name("name", &material.name)?;
                check_law(&material.dispersion)?;
                check_range(material.valid_nm)?;
                check_density(material.density)?;
                Ok(Material::clone(material))
            }
        }
    }
}

fn check_name(key: &'static str, name: &str) -> Result<(), MaterialError> {
    if super::names::is_printable(name) { Ok(()) } else { Err(MaterialError::Name { key }) }
}

fn check_index(key: &'static str, value: f64) -> Result<(), MaterialError> {
    if INDICES.contains(&value) { Ok(()) } else { Err(MaterialError::Index { key, value }) }
}

fn check_range(valid_nm: Option<(f64, f64)>) -> Result<(), MaterialError> {
    match valid_nm {
        Some((first, last)) if first.is_nan() || last.is_nan() || first > last => {
            Err(MaterialError::Valid { first, last })
        }
        _ => Ok(()),
    }
}

fn check_density(density: Option<f64>) -> Result<(), MaterialError> {
    match density.filter(|value| !DENSITIES.contains(value)) {
        Some(value) => Err(MaterialError::Density { value }),
        None => Ok(()),
    }
}

fn check_law(law: &Dispersion) -> Result<(), MaterialError> {
    let key = match law {
        Dispersion::Constant(_) => "index",
        Dispersion::Sellmeier { constant: 1.0, .. } => "sellmeier",
        Dispersion::Cauchy { .. } => "cauchy",
        Dispersion::Abbe { .. } => "abbe",
        Dispersion::Sellmeier { .. } | Dispersion::Rational { .. } => "dispersion",
    };
    // The index is checked here, because Abbe's law would silently raise an index below 1 to 1.
    if let Dispersion::Constant(index) | Dispersion::Abbe { n_d: index, .. } = law {
        check_index(key, *index)?;
    }
    law.clone().checked().map_err(|fault| MaterialError::Dispersion { key, fault })?;
    let steps = (VISIBLE_NM.end() - VISIBLE_NM.start()) as u32;
    let mut wavelengths = (0..=steps).map(|step| VISIBLE_NM.start() + f64::from(step));
    match wavelengths.find(|nm| law.index(*nm) > *INDICES.end()) {
        Some(nm) => Err(MaterialError::IndexAt { key, value: law.index(nm), nm }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn own(dispersion: Dispersion) -> MaterialRef {
        let glass = Material::from_index("glass", 1.5).unwrap();
        MaterialRef::Custom(Box::new(Material { dispersion, ..glass }))
    }

    fn sellmeier(constant: f64, terms: &[(f64, f64)]) -> Dispersion {
        Dispersion::Sellmeier { constant, terms: terms.to_vec() }
    }

    #[test]
    fn each_form_gives_the_material_it_means() {
        let diamond = brillianteer_optics::material("diamond").unwrap();
        assert_eq!(MaterialRef::Name("Diamond".to_owned()).material().as_ref(), Ok(diamond));
        assert_eq!(MaterialRef::Custom(Box::new(diamond.clone())).material().as_ref(), Ok(diamond));
        let bare = MaterialRef::Index(2.42).material().unwrap();
        assert_eq!((bare.name.as_str(), bare.index(500.0)), ("index 2.42", 2.42));
        assert!(bare.absorption[0].is_clear() && MaterialRef::Index(6.0).check().is_ok());
        for law in [
            Dispersion::Constant(1.0),
            sellmeier(1.0, &[(0.3306, 0.1750), (4.3356, 0.1060)]),
            Dispersion::Cauchy { a: 1.5, b: 0.004 },
            Dispersion::Abbe { n_d: 1.76, v_d: 72.0 },
        ] {
            assert_eq!(own(law.clone()).material().unwrap().dispersion, law);
        }
    }

    #[test]
    fn every_fault_is_told_with_its_key() {
        let glass = |change: fn(&mut Material)| {
            let mut glass = Material::from_index("glass", 1.5).unwrap();
            change(&mut glass);
            MaterialRef::Custom(Box::new(glass))
        };
        let cases = [
            (
                MaterialRef::Name(String::new()),
                "material: a name of 1 to 200 printable characters is expected",
            ),
            (
                MaterialRef::Name("Saphire".to_owned()),
                "material: unknown material 'Saphire'; did you mean 'sapphire'? known: diamond, ",
            ),
            (glass(|m| m.name = " ".to_owned()), "name: a name of 1 to 200 printable characters is expected"),
            (MaterialRef::Index(0.9), "material: the index 0.9 must be from 1 (air) to 6"),
            (MaterialRef::Index(f64::INFINITY), "material: the index inf must be from 1 (air) to 6"),
            (own(Dispersion::Constant(6.1)), "index: the index 6.1 must be from 1 (air) to 6"),
            (own(Dispersion::Constant(f64::NAN)), "index: the index NaN must be from 1 (air) to 6"),
            (
                own(sellmeier(1.0, &[(1.0, 0.5)])),
                "sellmeier: the dispersion has a resonance at 500.0 nm, in visible light",
            ),
            (own(sellmeier(0.5, &[])), "dispersion: the dispersion gives no refractive index of 1 or more"),
            (
                own(Dispersion::Cauchy { a: 5.0, b: 0.1296 + 1e-9 }),
                "cauchy: the index 6.000000007716049 at 360 nm must be at most 6; check the coefficients",
            ),
            (
                own(Dispersion::Cauchy { a: 1.5, b: f64::INFINITY }),
                "cauchy: the dispersion gives no refractive index of 1 or more at 360 nm",
            ),
            (own(Dispersion::Abbe { n_d: 0.9, v_d: 50.0 }), "abbe: the index 0.9 must be from 1 (air) to 6"),
            (
                own(Dispersion::Abbe { n_d: 1.5, v_d: 0.0 }),
                "abbe: an Abbe number of 0: give a number above 0",
            ),
            (
                glass(|m| m.valid_nm = Some((700.0, 400.0))),
                "valid_nm: [700, 400] is not a range; give the first wavelength in nm, then the last",
            ),
            (glass(|m| m.density = Some(0.0)), "density: 0 must be from 0.1 to 30 g/cm³"),
            (glass(|m| m.density = Some(f64::NAN)), "density: NaN must be from 0.1 to 30 g/cm³"),
        ];
        for (material, expected) in cases {
            let error = material.check().unwrap_err();
            assert!(error.to_string().starts_with(expected), "{error}");
            assert!(expected.starts_with(&format!("{}:", error.key())));
        }
        assert_eq!(own(Dispersion::Cauchy { a: 4.0, b: 0.12 }).check(), Ok(()));
    }
}
