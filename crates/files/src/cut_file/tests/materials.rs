//! Tests of materials in a cut file: by name, by index, or as a table, and the faults of such a table.

use super::*;
use brillianteer_optics::{Absorption, Dispersion, Material};

fn material(text: &str) -> Result<MaterialRef, FileError> {
    parse(&with("\"diamond\"", text), "x.toml").map(|design| design.material)
}

/// Returns an unnamed material of a file's own.
pub(super) fn custom(dispersion: Dispersion) -> Material {
    Material {
        name: "custom".to_owned(),
        description: String::new(),
        dispersion,
        absorption: Default::default(),
        source: String::new(),
        valid_nm: None,
        density: None,
        colour_is_illustrative: false,
    }
}

#[test]
fn a_material_is_a_name_an_index_or_a_table() {
    assert_eq!(material("\"Cubic-Zirconia\"").unwrap(), MaterialRef::Name("Cubic-Zirconia".to_owned()));
    assert_eq!(material("2").unwrap(), MaterialRef::Index(2.0));
    let peter = vec![(0.3306, 0.175), (4.3356, 0.106)];
    let devore =
        Dispersion::Rational { constant: 5.913, terms: vec![], poles: vec![(0.2441, 0.0803)], slope: 0.0 };
    for (text, law) in [
        ("{ index = 1.76 }", Dispersion::Constant(1.76)),
        ("{ cauchy = [1.5, 0.004] }", Dispersion::Cauchy { a: 1.5, b: 0.004 }),
        ("{ abbe = [1.76, 72] }", Dispersion::Abbe { n_d: 1.76, v_d: 72.0 }),
        (
            "{ sellmeier = [[0.3306, 0.175], [4.3356, 0.106]] }",
            Dispersion::Sellmeier { constant: 1.0, terms: peter },
        ),
        ("{ dispersion.rational = { constant = 5.913, poles = [[0.2441, 0.0803]] } }", devore),
    ] {
        assert_eq!(material(text).unwrap(), MaterialRef::Custom(Box::new(custom(law))), "{text}");
    }
    let smoke = "name = \"smoke\", description = \"grey\", source = \"by eye\", valid_nm = [400, 700], density = 3, index = 2";
    let violet = vec![(400.0, 0.1), (700.0, 0.0)];
    for (text, ordinary, extraordinary) in [
        ("absorption = 1", vec![(550.0, 1.0)], vec![(550.0, 1.0)]),
        ("absorption = 0.5, absorption_e = 1", vec![(550.0, 0.5)], vec![(550.0, 1.0)]),
        ("absorption = [[400, 0.1], [700, 0]]", violet.clone(), violet.clone()),
        ("absorption = [[400, 0.1], [700, 0]], absorption_e = 0", violet.clone(), vec![]),
        ("absorption_e = [[400, 0.1], [700, 0]]", vec![], violet),
    ] {
        let expected = Material {
            name: "smoke".to_owned(),
            description: "grey".to_owned(),
            dispersion: Dispersion::Constant(2.0),
            absorption: [ordinary, extraordinary].map(|samples| Absorption::new(samples).unwrap()),
            source: "by eye".to_owned(),
            valid_nm: Some((400.0, 700.0)),
            density: Some(3.0),
            colour_is_illustrative: false,
        };
        let read = material(&format!("{{ {smoke}, {text} }}")).unwrap();
        assert_eq!(read, MaterialRef::Custom(Box::new(expected)));
    }
}

#[test]
fn every_known_material_may_be_written_out_in_full() {
    let design = parse(TOLKOWSKY, "x.toml").unwrap();
    for known in brillianteer_optics::materials() {
        let design = Design { material: MaterialRef::Custom(Box::new(known.clone())), ..design.clone() };
        assert_eq!(parse(&write(&design), "x.toml"), Ok(design));
    }
}

#[test]
fn a_material_that_light_cannot_know_is_told_with_its_line() {
    let unknown = parse(&with("diamond", "Saphire"), "x.toml").unwrap_err().to_string();
    let expected =
        "x.toml:4: material: unknown material 'Saphire'; did you mean 'sapphire'? known: diamond, ";
    assert!(unknown.starts_with(expected), "{unknown}");
    let refused = |keys: &str, expected: &str| {
        let table = format!(
            "format = 1\nname = \"x\"\n[material]\n{keys}\n[[plane]]\nnormal = [0, 0, 1]\noffset = 1"
        );
        assert_message(&table, expected);
    };
    refused(
        "index = 2\nabsorption = [\n[400, 0.1],\n[500, -0.1]]",
        "x.toml:7: material.absorption: absorption sample 2 (500 nm) has a coefficient of -0.1 per mm: give 0 to 1e6",
    );
    refused(
        "index = 2\nabsorption = [\n[400, 0.1],\n[500]]",
        "x.toml:5: material.absorption: invalid length 1, expected a list of 2 numbers \
         (a number per mm, or [[nm, per mm], ...])",
    );
    refused(
        "index = 2\nabsorption = -1",
        "x.toml:5: material.absorption: absorption sample 1 (550 nm) has a coefficient of -1 per mm: give 0 to 1e6",
    );
    refused(
        "index = 2\nabsorption = 1\nabsorption_e = [\n[400, 0.1],\n[390, 0.1]]",
        "x.toml:8: material.absorption_e: absorption sample 2 (390 nm) follows one at 400 nm: list wavelengths in \
         increasing order, each once",
    );
    refused(
        "index = 2\nabsorption_e = [[400]]",
        "x.toml:5: material.absorption_e: invalid length 1, expected a list of 2 numbers \
         (of the extraordinary polarisation: a number per mm, or [[nm, per mm], ...])",
    );
    refused(
        "sellmeier = []",
        "x.toml:4: material.sellmeier: the list is empty, expected at least one pair ([[B, C], ...], C in µm)",
    );
    refused(
        "sellmeier = [[1, 0.5]]",
        "x.toml:4: sellmeier: the dispersion has a resonance at 500.0 nm, in visible light (360 to 830 nm): check \
         whether its source prints C squared (use `rational`) or not (use `sellmeier`)",
    );
    refused("abbe = [1.5, -1]", "x.toml:4: abbe: an Abbe number of -1: give a number above 0");
    refused("name = \"\"\nindex = 2", "x.toml:4: name: a name of 1 to 200 printable characters is expected");
    refused(
        "[material.dispersion.rational]\nterms = [[1, 0.25]]",
        "x.toml:4: material.dispersion: the dispersion has a resonance at 500.0 nm, in visible light (360 to 830 nm): \
         check whether its source prints C squared (use `rational`) or not (use `sellmeier`)",
    );
}
