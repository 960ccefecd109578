//! Named materials: the refraction and the absorption of each, and the source of the numbers.
//!
//! To add a material, add an entry with source, range of validity and density, a test of its printed values, and a
//! row in docs/optics.md; a coloured gem also needs its bands in `gems/table.rs`. Glasses by index and Abbe number
//! are rows of `glasses.rs`.

use super::absorption::Absorption;
use super::colour::LUMINANCE;
use super::dispersion::{Dispersion, DispersionError};
use super::illuminant::Illuminant;
use super::strata::{Stratum, strata};
use super::{gems, glasses};
use brillianteer_base::slips;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::sync::LazyLock;

/// The material of a stone: its optical properties and its density.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// The name that the trade gives it; unique among [`materials`].
    pub name: String,
    /// A description in one line: the kind of material, and the properties that are left out.
    pub description: String,
    /// The index by wavelength.
    pub dispersion: Dispersion,
    /// The absorption of the ordinary and of the extraordinary polarisation in a uniaxial stone; in others, the same twice.
    ///
    /// Over a path, unpolarised light keeps the mean of the two transmittances, not the transmittance of the mean
    /// coefficient.
    pub absorption: [Absorption; 2],
    /// The author of the measurement, and the place where it is printed.
    pub source: String,
    /// The first and the last wavelength in nm of the range that the source covers; beyond it the formula is
    /// extrapolated. `None` where the source states no range.
    pub valid_nm: Option<(f64, f64)>,
    /// The density in g/cm³; `None` where it is not known.
    pub density: Option<f64>,
    /// True where the colour is chosen to look like the gem's and is not measured.
    pub colour_is_illustrative: bool,
}

/// The strata by which the colour of daylight after a path is computed: narrow enough for the narrowest bands.
static DAYLIGHT: LazyLock<Vec<Stratum>> = LazyLock::new(|| strata(64, &Illuminant::D65, true));

impl Material {
    /// Makes a clear stone with one index for all wavelengths.
    ///
    /// # Errors
    /// Fails for an index that is not a finite number of at least 1.
    pub fn from_index(name: &str, index: f64) -> Result<Self, DispersionError> {
        let dispersion = Dispersion::Constant(index).checked()?;
        let source = "a single index, given by the user";
        Ok(Self::clear(name, "One index for all wavelengths.", dispersion, source, None))
    }

    /// Returns the material's name and the index at which it is seen, for titles. A material of which only the index is known has
    /// no other name, so that its index alone is named.
    pub fn with_index(&self, index: f64) -> String {
        match self.dispersion {
            Dispersion::Constant(_) if self.name.starts_with("index ") => format!("index {index:.4}"),
            _ => format!("{}, index {index:.4}", self.name),
        }
    }

    /// Makes a clear glass with an index n_d and an Abbe number V_d.
    ///
    /// # Errors
    /// Fails for numbers that give no index somewhere in visible light.
    pub fn from_abbe(name: &str, n_d: f64, v_d: f64) -> Result<Self, DispersionError> {
        let dispersion = Dispersion::Abbe { n_d, v_d }.checked()?;
        let source = "an index and an Abbe number, given by the user";
        Ok(Self::clear(name, "A glass of two numbers.", dispersion, source, None))
    }

    /// Returns the index at a wavelength in nm; panics as [`Dispersion::index`] does.
    pub fn index(&self, wavelength_nm: f64) -> f64 {
        self.dispersion.index(wavelength_nm)
    }

    /// Returns the colour, linear sRGB, of daylight after a path inside the material in mm; white is (1, 1, 1).
    /// Components may be negative where the colour is beyond sRGB.
    pub fn colour_after(&self, mm: f64) -> DVec3 {
        let light = |stratum: &Stratum| {
            let nm = stratum.at(0.5);
            let left = |absorption: &Absorption| (-absorption.coefficient(nm) * mm).exp();
            stratum.response[0] * (0.5 * (left(&self.absorption[0]) + left(&self.absorption[1])))
        };
        DAYLIGHT.iter().map(light).sum()
    }

    /// Returns the path inside the material, in mm, after which half of daylight's luminance is left, at most 1e9;
    /// `None` where the material is clear, or where it always leaves more than half of the light.
    pub fn half_length(&self) -> Option<f64> {
        let shares = DVec3::from_array(LUMINANCE.map(f64::from));
        let is_dim = |mm: f64| self.colour_after(mm).dot(shares) < 0.5;
        if self.absorption.iter().all(Absorption::is_clear) || !is_dim(1e9) {
            return None;
        }
        let (mut low, mut high) = (-9.0_f64, 9.0_f64);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if is_dim(10.0_f64.powf(middle)) { high = middle } else { low = middle }
        }
        Some(10.0_f64.powf(high))
    }

    /// Returns whether the range that the source states contains this wavelength; `false` where the source states no
    /// range.
    pub fn is_valid_at(&self, wavelength_nm: f64) -> bool {
        self.valid_nm.is_some_and(|(first, last)| (first..=last).contains(&wavelength_nm))
    }

    /// Makes a material that absorbs nothing.
    pub(super) fn clear(
        name: &str,
        text: &str,
        dispersion: Dispersion,
        source: &str,
        valid_nm: Option<(f64, f64)>,
    ) -> Self {
        let (name, description, source) = (name.to_owned(), text.to_owned(), source.to_owned());
        Self {
            name,
            description,
            dispersion,
            absorption: Default::default(),
            source,
            valid_nm,
            density: None,
            colour_is_illustrative: false,
        }
    }

    /// Returns the same material with this density in g/cm³.
    pub(super) fn weighing(self, density: f64) -> Self {
        Self { density: Some(density), ..self }
    }
}

/// The error where no material has the name that was looked up.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct UnknownMaterial {
    /// The name that was looked up.
    pub name: String,
    /// The materials of the kind that the name means, such as the garnets.
    pub of_kind: Vec<&'static str>,
    /// Names with a similar spelling, the nearest first; an empty list where there are materials of the kind.
    pub near: Vec<&'static str>,
}

impl fmt::Display for UnknownMaterial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "unknown material '{}'; ", self.name)?;
        if !self.of_kind.is_empty() {
            write!(f, "of that kind there are '{}'; ", self.of_kind.join("', '"))?;
        }
        if !self.near.is_empty() {
            write!(f, "did you mean '{}'? ", self.near.join("' or '"))?;
        }
        let known: Vec<&str> = materials().iter().map(|m| m.name.as_str()).collect();
        write!(f, "known: {}", known.join(", "))
    }
}

/// Finds the material with this name; case, spaces, hyphens and underscores do not matter.
///
/// # Errors
/// Fails with [`UnknownMaterial`], which holds similar names.
pub fn material(name: &str) -> Result<&'static Material, UnknownMaterial> {
    let key = key(name);
    materials().iter().find(|m| self::key(&m.name) == key).ok_or_else(|| unknown(name))
}

/// Returns all materials that have a name: diamond first, then the others with a published law, all colourless; then those
/// from trade tables and the coloured gems; then glasses.
pub fn materials() -> &'static [Material] {
    static MATERIALS: LazyLock<Vec<Material>> = LazyLock::new(|| {
        let colourless = [published(), ordinary_rays()].concat();
        let gems = gems::gems(&colourless);
        [colourless, gems, glasses::glasses()].concat()
    });
    &MATERIALS
}

/// Returns the isotropic stones whose dispersion is published; their densities are those of trade tables.
fn published() -> Vec<Material> {
    vec![
        Material::clear(
            "diamond",
            "Isotropic; colourless.",
            sellmeier(&[(0.3306, 0.1750), (4.3356, 0.1060)]),
            "F. Peter, Z. Phys. 15, 358 (1923)",
            Some((226.0, 760.0)),
        )
        .weighing(3.52),
        Material::clear(
            "spinel",
            "Isotropic; magnesium aluminate, colourless.",
            sellmeier(&[(1.8938, 0.09942), (3.0755, 15.826)]),
            "W. J. Tropf and M. E. Thomas, Handbook of Optical Constants of Solids II, 881 (1991); \
             fit in Handbook of Optics, 3rd ed., vol. 4 (2009)",
            Some((350.0, 5500.0)),
        )
        .weighing(3.60),
        Material::clear(
            "cubic zirconia",
            "Isotropic; stabilised with yttria, colourless.",
            sellmeier(&[(1.347091, 0.062543), (2.117788, 0.166739), (9.452943, 24.320570)]),
            "D. L. Wood and K. Nassau, Appl. Opt. 21, 2978 (1982)",
            Some((361.0, 5135.0)),
        )
        .weighing(5.80),
        Material::clear(
            "strontium titanate",
            "Isotropic; sold as fabulite, colourless.",
            sellmeier(&[(3.042143, 0.1475902), (1.170065, 0.2953086), (30.83326, 33.18606)]),
            "W. L. Bond, J. Appl. Phys. 36, 1674 (1965); \
             fit by M. J. Dodge, Handbook of Laser Science and Technology IV (1986)",
            Some((430.0, 3800.0)),
        )
        .weighing(5.13),
        Material::clear(
            "YAG",
            "Isotropic; yttrium aluminium garnet, colourless.",
            rational(1.0, &[(2.28200, 0.01185), (3.27644, 282.734)], &[], 0.0),
            "D. E. Zelmon, D. L. Small and R. Page, Appl. Opt. 37, 4933 (1998)",
            Some((400.0, 5000.0)),
        )
        .weighing(4.55),
    ]
}

/// Returns the uniaxial stones by their ordinary ray, which obeys Snell's law; their densities are those of trade tables.
/// The extraordinary ray, and with it doubling, is not traced yet.
fn ordinary_rays() -> Vec<Material> {
    vec![
        Material::clear(
            "sapphire",
            "Uniaxial corundum; ordinary ray only, without double refraction; colourless.",
            sellmeier(&[(1.4313493, 0.0726631), (0.65054713, 0.1193242), (5.3414021, 18.028251)]),
            "I. H. Malitson and M. J. Dodge, J. Opt. Soc. Am. 62, 1405 (1972); \
             fit by M. J. Dodge, Handbook of Laser Science and Technology IV (1986)",
            Some((200.0, 5000.0)),
        )
        .weighing(4.00),
        Material::clear(
            "quartz",
            "Uniaxial; ordinary ray only, without double refraction; colourless.",
            rational(1.28604141, &[(1.07044083, 0.0100585997), (1.10202242, 100.0)], &[], 0.0),
            "G. Ghosh, Opt. Commun. 163, 95 (1999)",
            Some((198.0, 2053.1)),
        )
        .weighing(2.65),
        Material::clear(
            "moissanite",
            "Uniaxial 6H silicon carbide; ordinary ray only, without double refraction; colourless.",
            rational(6.57232, &[], &[(0.1401, 0.03178)], -0.02153),
            "S. Wang et al., Laser Photonics Rev. 7, 831 (2013)",
            Some((435.8, 2325.0)),
        )
        .weighing(3.22),
        Material::clear(
            "rutile",
            "Uniaxial titanium dioxide; ordinary ray only, without double refraction; colourless.",
            rational(5.913, &[], &[(0.2441, 0.0803)], 0.0),
            "J. R. Devore, J. Opt. Soc. Am. 41, 416 (1951)",
            Some((430.0, 1530.0)),
        )
        .weighing(4.25),
    ]
}

fn sellmeier(terms: &[(f64, f64)]) -> Dispersion {
    Dispersion::Sellmeier { constant: 1.0, terms: terms.to_vec() }
}

fn rational(constant: f64, terms: &[(f64, f64)], poles: &[(f64, f64)], slope: f64) -> Dispersion {
    Dispersion::Rational { constant, terms: terms.to_vec(), poles: poles.to_vec(), slope }
}

/// Returns a name in lower case, without spaces, hyphens and underscores.
fn key(name: &str) -> String {
    name.chars().filter(|c| !matches!(c, ' ' | '-' | '_')).flat_map(char::to_lowercase).collect()
}

/// Returns the materials of the kind that the last word of a name means, in singular or plural: those with that word in their
/// name, or else in what their description calls them before it tells of their index and colour.
fn of_kind(name: &str) -> Vec<&'static str> {
    let words = |text: &str| -> Vec<String> {
        text.split(|c: char| !c.is_alphanumeric())
            .filter(|word| !word.is_empty())
            .map(str::to_lowercase)
            .collect()
    };
    let Some(kind) = words(name).pop() else { return vec![] };
    let kind = kind.strip_suffix('s').filter(|kind| !kind.is_empty()).unwrap_or(&kind).to_owned();
    let is_of = |text: &str| words(text).iter().any(|word| *word == kind || *word == format!("{kind}s"));
    let named = materials().iter().filter(|material| is_of(&material.name));
    let described = materials().iter().filter(|material| {
        let what = material.description.split([';', '.']).next().unwrap_or_default();
        !is_of(&material.name) && is_of(what)
    });
    named.chain(described).map(|material| material.name.as_str()).collect()
}

fn unknown(name: &str) -> UnknownMaterial {
    let (asked, of_kind) = (key(name), of_kind(name));
    if !of_kind.is_empty() {
        return UnknownMaterial { name: name.to_owned(), of_kind, near: vec![] };
    }
    let near = materials().iter().filter_map(|m| Some((slips(&asked, &key(&m.name))?, m.name.as_str())));
    let mut near: Vec<(usize, &str)> = near.collect();
    near.sort_by_key(|&(slips, _)| slips);
    UnknownMaterial { name: name.to_owned(), of_kind, near: near.into_iter().map(|(_, name)| name).collect() }
}

#[cfg(test)]
mod tests {
    use super::super::dispersion::{VISIBLE_NM, line};
    use super::*;

    fn assert_prints(what: &str, value: f64, printed: f64, digits: i32) {
        assert!(
            (value - printed).abs() <= 0.5 * 10_f64.powi(-digits),
            "{what}: {value}, printed as {printed}"
        );
    }

    #[test]
    fn published_laws_give_the_printed_index_and_dispersion() {
        for (name, n_d, b_g, c_f) in [
            ("diamond", 2.41726, 0.04444, 0.02564),
            ("sapphire", 1.76808, 0.01811, 0.01063),
            ("spinel", 1.71610, 0.02019, 0.01181),
            ("cubic zirconia", 2.15846, 0.06040, 0.03456),
        ] {
            let law = &material(name).unwrap().dispersion;
            assert_prints(name, law.index(line::SODIUM_D), n_d, 5);
            assert_prints(name, law.dispersion_b_g(), b_g, 5);
            assert_prints(name, law.index(line::HYDROGEN_F) - law.index(line::HYDROGEN_C), c_f, 5);
        }
    }

    #[test]
    fn strontium_titanate_gives_the_printed_index_and_dispersion() {
        let law = &material("strontium titanate").unwrap().dispersion;
        assert_prints("n_D", law.index(line::SODIUM_D), 2.40799, 5);
        assert_prints("B-G", law.dispersion_b_g(), 0.2096, 4);
        assert_prints("C-F", law.index(line::HYDROGEN_F) - law.index(line::HYDROGEN_C), 0.1109, 4);
    }

    #[test]
    fn laws_of_other_forms_give_the_printed_index() {
        for (name, n_d) in
            [("YAG", 1.83265), ("quartz", 1.54421), ("moissanite", 2.64743), ("rutile", 2.61291)]
        {
            assert_prints(name, material(name).unwrap().index(line::SODIUM_D), n_d, 5);
        }
        assert_prints("YAG, B-G", material("YAG").unwrap().dispersion.dispersion_b_g(), 0.02721, 5);
    }

    #[test]
    fn every_material_has_an_index_that_falls_with_wavelength_throughout_visible_light() {
        assert_eq!(materials().len(), 42);
        for m in materials() {
            assert_eq!(m.dispersion.clone().checked().as_ref(), Ok(&m.dispersion), "{}", m.name);
            let indices: Vec<f64> = (360..=830).map(|nm| m.index(nm.into())).collect();
            assert!(indices.is_sorted_by(|a, b| a > b), "{}", m.name);
            assert!(!m.source.is_empty() && !m.description.is_empty());
            let clear = m.absorption.iter().all(Absorption::is_clear);
            assert_eq!(clear, m.description.contains("colourless"), "{}", m.name);
        }
        assert_eq!((*VISIBLE_NM.start(), *VISIBLE_NM.end()), (360.0, 830.0));
    }

    #[test]
    fn uniaxial_stones_say_that_they_are_the_ordinary_ray() {
        for name in ["sapphire", "quartz", "moissanite", "rutile"] {
            assert!(material(name).unwrap().description.contains("ordinary ray only"));
        }
        for m in materials().iter().filter(|m| m.description.starts_with("Uniaxial")) {
            assert!(m.description.contains("without double refraction"), "{}", m.name);
        }
        assert!(materials().iter().filter(|m| m.description.starts_with("Uniaxial")).count() == 13);
    }

    #[test]
    fn a_source_vouches_only_for_the_wavelengths_it_measured() {
        let moissanite = material("moissanite").unwrap();
        assert!(moissanite.is_valid_at(line::SODIUM_D) && !moissanite.is_valid_at(line::FRAUNHOFER_G));
        assert!(!material("pyrope").unwrap().is_valid_at(line::SODIUM_D));
    }

    #[test]
    fn the_gltf_law_of_diamond_stays_close_to_peters() {
        let khronos = Dispersion::Abbe { n_d: 2.418, v_d: 55.0 };
        let diamond = material("diamond").unwrap();
        for nm in 400..=700 {
            assert!((khronos.index(nm.into()) - diamond.index(nm.into())).abs() < 0.002, "at {nm} nm");
        }
    }

    #[test]
    fn names_are_found_whatever_their_case_and_spacing() {
        for spelling in ["cubic zirconia", "Cubic-Zirconia", "CUBIC_ZIRCONIA", " cubic  zirconia "] {
            assert_eq!(material(spelling).unwrap().name, "cubic zirconia");
        }
        assert_eq!(material("yag").unwrap().name, "YAG");
        let mut keys: Vec<String> = materials().iter().map(|m| key(&m.name)).collect();
        keys.sort();
        assert!(keys.is_sorted_by(|a, b| a < b), "two materials answer to one name");
    }

    #[test]
    fn an_unknown_name_is_answered_with_those_near_it() {
        let error = material("diamon").unwrap_err();
        assert_eq!(error.near, ["diamond"]);
        let text = error.to_string();
        assert!(
            text.starts_with("unknown material 'diamon'; did you mean 'diamond'? known: diamond, spinel,"),
            "{text}"
        );
        assert_eq!(material("Saphire").unwrap_err().near, ["sapphire"]);
        let stranger = material("kryptonite").unwrap_err();
        assert!(stranger.near.is_empty() && stranger.to_string().contains("'kryptonite'; known: diamond"));
        assert!(material("").unwrap_err().near.is_empty());
    }

    #[test]
    fn the_name_of_a_kind_is_answered_with_its_materials() {
        for (asked, expected) in [
            (
                "garnet",
                &[
                    "pyrope",
                    "almandine",
                    "rhodolite",
                    "spessartine",
                    "grossular",
                    "tsavorite",
                    "hessonite",
                    "demantoid",
                ][..],
            ),
            ("red garnets", &["pyrope", "almandine"]),
            ("Topaz", &["blue topaz"]),
            ("tourmaline", &["green tourmaline", "pink tourmaline"]),
            ("pale quartz", &["quartz", "amethyst", "citrine"]),
            ("beryl", &["emerald", "aquamarine"]),
            ("corundum", &["sapphire", "ruby", "blue sapphire"]),
            ("olivine", &["peridot"]),
        ] {
            let error = material(asked).unwrap_err();
            let text = error.to_string();
            assert!(expected.iter().all(|name| error.of_kind.contains(name)), "{asked}: {:?}", error.of_kind);
            assert!(text.contains(&format!("of that kind there are '{}'", error.of_kind[0])), "{text}");
            assert!(error.near.is_empty() && !error.of_kind.contains(&"diamond"), "{asked}: {error:?}");
        }
        assert!(material("quarz").unwrap_err().of_kind.is_empty(), "a slip is no kind");
        assert_eq!(material("quarz").unwrap_err().near, ["quartz"]);
    }

    #[test]
    fn a_material_that_is_called_by_its_index_is_titled_by_one_index() {
        let bare = Material::from_index("index 1.54", 1.54).unwrap();
        assert_eq!(bare.with_index(1.54), "index 1.5400");
        let glass = Material::from_index("glass", 1.5).unwrap();
        assert_eq!(glass.with_index(1.6), "glass, index 1.6000");
    }

    #[test]
    fn a_bare_index_makes_a_material_or_says_why_not() {
        assert_eq!(Material::from_index("glass", 1.5).unwrap().index(500.0), 1.5);
        assert!(Material::from_index("vapour", 0.5).is_err());
    }
}
