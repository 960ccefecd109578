//! The key `material`: a name, an index, or a table of the file's own.

use serde::{Deserialize, Serialize};

use super::values::{Numbers, OneOf, Pairs, TomlTable};
use brillianteer_base::Fault;
use brillianteer_cut::{MaterialError, MaterialRef};
use brillianteer_optics::{Absorption, AbsorptionError, Dispersion, Material};

/// The wavelength, in nm, of the one sample of an absorption that is the same at every wavelength.
const GREY_NM: f64 = 550.0;

/// The value of `material`: `material = "diamond"`, `material = 2.42` or `[material]`.
pub(crate) type MaterialForm = OneOf<TomlTable<TableForm>>;

/// The table `[material]`.
#[derive(Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(crate) struct TableForm {
    #[serde(default = "nameless")]
    name: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    description: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    source: String,
    index: Option<f64>,
    sellmeier: Option<Pairs>,
    cauchy: Option<Numbers<2>>,
    abbe: Option<Numbers<2>>,
    absorption: Option<OneOf<Pairs>>,
    /// The absorption of the extraordinary polarisation, where it differs.
    absorption_e: Option<OneOf<Pairs>>,
    valid_nm: Option<Numbers<2>>,
    density: Option<f64>,
    /// True where the colour was chosen for its looks, and not measured.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    illustrative: bool,
    /// A law that has no key of its own, in the form of [`Dispersion`].
    dispersion: Option<Dispersion>,
}

fn nameless() -> String {
    "custom".to_owned()
}

/// Returns the path of the key whose value a material's check refuses.
pub(crate) fn path_of(error: &MaterialError, material: &MaterialRef) -> String {
    match material {
        MaterialRef::Custom(_) => format!("material/{}", error.key()),
        MaterialRef::Name(_) | MaterialRef::Index(_) => "material".to_owned(),
    }
}

impl MaterialForm {
    /// Returns the form in which a material is written.
    pub fn of(material: &MaterialRef) -> Self {
        match material {
            MaterialRef::Name(name) => Self::Text(name.clone()),
            MaterialRef::Index(index) => Self::Number(*index),
            MaterialRef::Custom(material) => Self::Rest(TomlTable(TableForm::of(material))),
        }
    }

    /// Returns the material that the form describes, not yet checked.
    pub fn material(self) -> Result<MaterialRef, Fault> {
        match self {
            Self::Text(name) => Ok(MaterialRef::Name(name)),
            Self::Number(index) => Ok(MaterialRef::Index(index)),
            Self::Rest(TomlTable(form)) => {
                form.material().map(|material| MaterialRef::Custom(Box::new(material)))
            }
        }
    }
}

impl TableForm {
    fn of(material: &Material) -> Self {
        let Material { name, description, dispersion, absorption, source, valid_nm, density, .. } =
            material.clone();
        let illustrative = material.colour_is_illustrative;
        let valid_nm = valid_nm.map(|range| Numbers(range.into()));
        let mut form = Self { name, description, source, valid_nm, density, illustrative, ..Self::default() };
        match dispersion {
            Dispersion::Constant(n) => form.index = Some(n),
            Dispersion::Sellmeier { constant: 1.0, terms } if !terms.is_empty() => {
                form.sellmeier = Some(Pairs(terms));
            }
            Dispersion::Cauchy { a, b } => form.cauchy = Some(Numbers([a, b])),
            Dispersion::Abbe { n_d, v_d } => form.abbe = Some(Numbers([n_d, v_d])),
            law @ (Dispersion::Sellmeier { .. } | Dispersion::Rational { .. }) => form.dispersion = Some(law),
        }
        let [ordinary, extraordinary] = absorption;
        form.absorption = (ordinary != Absorption::clear()).then(|| absorption_form(&ordinary));
        form.absorption_e = (extraordinary != ordinary).then(|| absorption_form(&extraordinary));
        form
    }

    fn material(self) -> Result<Material, Fault> {
        let sellmeier = |Pairs(terms)| Dispersion::Sellmeier { constant: 1.0, terms };
        let given = [
            ("index", self.index.map(Dispersion::Constant)),
            ("sellmeier", self.sellmeier.map(sellmeier)),
            ("cauchy", self.cauchy.map(|Numbers([a, b])| Dispersion::Cauchy { a, b })),
            ("abbe", self.abbe.map(|Numbers([n_d, v_d])| Dispersion::Abbe { n_d, v_d })),
            ("dispersion", self.dispersion),
        ];
        let mut given = given.into_iter().filter_map(|(key, law)| Some((key, law?)));
        let Some((first, dispersion)) = given.next() else {
            let message = "material: one of index, sellmeier, cauchy, abbe or dispersion is missing";
            return Err(Fault::key("material", message));
        };
        if let Some((second, _)) = given.next() {
            let message = format!("material.{second}: give {first} or {second}, not both");
            return Err(Fault::key(format!("material/{second}"), message));
        }
        let read = |key, form: Option<_>| form.map(|form| absorption(key, form)).transpose();
        let ordinary = read("absorption", self.absorption)?.unwrap_or_default();
        let extraordinary = read("absorption_e", self.absorption_e)?.unwrap_or_else(|| ordinary.clone());
        Ok(Material {
            name: self.name,
            description: self.description,
            dispersion,
            absorption: [ordinary, extraordinary],
            source: self.source,
            valid_nm: self.valid_nm.map(|range| range.0.into()),
            density: self.density,
            colour_is_illustrative: self.illustrative,
        })
    }
}

/// Returns the form in which an absorption is written. A clear stone is the number 0, since a list cannot be empty.
fn absorption_form(absorption: &Absorption) -> OneOf<Pairs> {
    match absorption.samples() {
        [] => OneOf::Number(0.0),
        [(GREY_NM, per_mm)] if *per_mm != 0.0 => OneOf::Number(*per_mm),
        samples => OneOf::Rest(Pairs(samples.to_vec())),
    }
}

fn absorption(key: &str, form: OneOf<Pairs>) -> Result<Absorption, Fault> {
    let samples = match form {
        OneOf::Number(0.0) => vec![],
        OneOf::Number(per_mm) => vec![(GREY_NM, per_mm)],
        OneOf::Rest(Pairs(samples)) => samples,
        OneOf::Text(_) => {
            let message =
                format!("material.{key}: a number per mm or a list of [nm, per mm] is expected, not text");
            return Err(Fault::key(format!("material/{key}"), message));
        }
    };
    Absorption::new(samples).map_err(|error| {
        let (AbsorptionError::Wavelength { sample, .. }
        | AbsorptionError::Coefficient { sample, .. }
        | AbsorptionError::Order { sample, .. }) = error;
        Fault::key(format!("material/{key}/{}", sample - 1), format!("material.{key}: {error}"))
    })
}
