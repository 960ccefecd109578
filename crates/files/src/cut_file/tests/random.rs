//! Any design reads back as it was written; no text and no damage makes reading panic.

use super::super::{parse, write};
use super::materials::custom;
use crate::random;
use brillianteer_cut::{Cut, Design, MaterialRef};
use brillianteer_math::Plane;
use brillianteer_optics::{Absorption, Dispersion, MOST_PER_MM, Material};
use glam::DVec3;
use proptest::prelude::*;

fn names() -> impl Strategy<Value = String> {
    prop_oneof!["[a-z]{1,8}( [1-9])?", "\\PC*[^\\s\\pC]\\PC*"]
}

/// Numbers of any size whose squares and quotients are still finite.
fn numbers() -> impl Strategy<Value = f64> {
    (-1.0..1.0, -60..60).prop_map(|(number, exponent): (f64, i32)| number * 10_f64.powi(exponent))
}

/// Laws of dispersion that give an index throughout visible light: their resonances lie in the ultraviolet and the infrared.
fn dispersions() -> impl Strategy<Value = Dispersion> {
    let index = || 1.0..=4.0;
    let terms = || prop::collection::vec((0.1..3.0, prop_oneof![0.0..0.25, 2.0..100.0]), 0..4);
    let laws = prop_oneof![
        index().prop_map(Dispersion::Constant),
        (prop_oneof![Just(1.0), index()], terms())
            .prop_map(|(constant, terms)| Dispersion::Sellmeier { constant, terms }),
        (index(), terms(), terms(), -0.1..0.1).prop_map(|(constant, terms, poles, slope)| {
            let poles = poles.into_iter().map(|(p, q)| (0.1 * p, q)).collect();
            Dispersion::Rational { constant, terms, poles, slope }
        }),
        (index(), 0.0..0.1).prop_map(|(a, b)| Dispersion::Cauchy { a, b }),
        (index(), 10.0..1e3).prop_map(|(n_d, v_d)| Dispersion::Abbe { n_d, v_d }),
    ];
    laws.prop_filter("an index of a material", |law| {
        MaterialRef::Custom(Box::new(custom(law.clone()))).check().is_ok()
    })
}

fn absorptions() -> impl Strategy<Value = Absorption> {
    let coefficient = || numbers().prop_map(|n| n.abs().min(MOST_PER_MM));
    prop_oneof![
        coefficient().prop_map(|per_mm| vec![(550.0, per_mm)]),
        prop::collection::btree_map(1_u32..3000, coefficient(), 0..5)
            .prop_map(|bands| bands.into_iter().map(|(nm, per_mm)| (f64::from(nm) / 3.0, per_mm)).collect()),
    ]
    .prop_map(|samples| Absorption::new(samples).unwrap())
}

fn materials() -> impl Strategy<Value = MaterialRef> {
    let range = prop::option::of((1.0..500.0, 500.0..1e9));
    let densities = prop::option::of(0.1..=30.0);
    let texts = (names(), any::<String>(), any::<String>());
    prop_oneof![
        prop::sample::select(brillianteer_optics::materials())
            .prop_map(|known| MaterialRef::Name(known.name)),
        (1.0..=5.0).prop_map(MaterialRef::Index),
        (texts, dispersions(), [absorptions(), absorptions()], any::<bool>(), (range, densities)).prop_map(
            |((name, description, source), dispersion, [o, e], pleochroic, (valid_nm, density))| {
                let absorption = if pleochroic { [o, e] } else { [o.clone(), o] };
                let colour_is_illustrative = pleochroic;
                let material = Material {
                    name,
                    description,
                    dispersion,
                    absorption,
                    source,
                    valid_nm,
                    density,
                    colour_is_illustrative,
                };
                MaterialRef::Custom(Box::new(material))
            }
        ),
    ]
}

fn cuts() -> impl Strategy<Value = Cut> {
    let normal =
        [numbers(), numbers(), numbers()].prop_filter("a direction", |n| n.iter().any(|x| x.abs() > 1e-80));
    let plane = (names(), normal, numbers())
        .prop_map(|(name, normal, offset)| (name, Plane::new(DVec3::from_array(normal), offset)));
    prop_oneof![
        random::proportions().prop_map(Cut::RoundBrilliant),
        prop::collection::vec(plane, 1..20).prop_map(Cut::Planes),
    ]
}

prop_compose! {
    fn designs()(
        name in names(),
        source in prop::option::of(any::<String>()),
        notes in prop::option::of(any::<String>()),
        material in materials(),
        diameter_mm in 0.1..=1000.0,
        cut in cuts(),
    ) -> Design {
        Design { name, source, notes, material, diameter_mm, cut }
    }
}

proptest! {
    #[test]
    fn reading_what_was_written_gives_the_same_design_to_the_last_bit(design in designs()) {
        prop_assert_eq!(design.check(), Ok(()));
        let text = write(&design);
        let read = parse(&text, "x.toml");
        prop_assert_eq!(read.as_ref(), Ok(&design), "{}", text);
        prop_assert_eq!(write(&read.unwrap()), text);
    }

    #[test]
    fn no_text_makes_it_panic(text in any::<String>()) {
        let _ = parse(&text, "x.toml");
        let _ = parse(&format!("format = 1\n{text}"), "x.toml");
    }

    #[test]
    fn no_damage_makes_it_panic(
        design in designs(),
        at in any::<prop::sample::Index>(),
        length in 0_usize..8,
        patch in prop_oneof![any::<String>(), "[-0-9a-z\\[\\]{}=.,\"'\n ]{0,6}"],
    ) {
        let mut text: Vec<char> = write(&design).chars().collect();
        let start = at.index(text.len());
        let end = text.len().min(start + length);
        text.splice(start..end, patch.chars());
        let text: String = text.into_iter().collect();
        if let Err(error) = parse(&text, "x.toml") {
            prop_assert!(error.fault.line.is_none_or(|line| line <= 1 + text.matches('\n').count()));
            prop_assert!(!error.fault.problem.is_empty());
        }
    }
}
