//! Tests of the colour of each gem, as the CIE's observer sees it with a black body's light as white.

use super::super::colour::encoded_from_linear;
use super::super::line;
use super::super::material::{Material, material, materials};
use super::*;

/// About how far light travels in a stone of 6.5 mm, in mm.
const PATH_MM: f64 = 14.0;
/// The XYZ of D65's white.
const WHITE: [f64; 3] = [0.95047, 1.0, 1.08883];
/// The temperature in kelvin of the black body that stands in for D65.
const KELVINS: f64 = 6504.0;

/// Returns the colour-matching functions of the 1931 observer, fitted by C. Wyman, P.-P. Sloan and P. Shirley, JCGT 2(2)
/// (2013).
fn observer(nm: f64) -> [f64; 3] {
    let lobe = |middle: f64, below: f64, above: f64| {
        let x = (nm - middle) / if nm < middle { below } else { above };
        (-0.5 * x * x).exp()
    };
    [
        0.362 * lobe(442.0, 16.0, 26.7) + 1.056 * lobe(599.8, 37.9, 31.0) - 0.065 * lobe(501.1, 20.4, 26.2),
        0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
        1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8),
    ]
}

fn black_body(nm: f64) -> f64 {
    const HC_OVER_K_NM: f64 = 1.438776877e7;
    nm.powi(-5) / (HC_OVER_K_NM / (nm * KELVINS)).exp_m1()
}

/// Returns X, Y and Z of transmitted light, each as a part of its value before.
fn parts(transmittance: impl Fn(f64) -> f64) -> [f64; 3] {
    let wavelengths = (360..=830).step_by(5).map(f64::from);
    let (mut light, mut white) = ([0.0; 3], [0.0; 3]);
    for nm in wavelengths {
        for (axis, seen) in observer(nm).into_iter().enumerate() {
            white[axis] += seen * black_body(nm);
            light[axis] += seen * black_body(nm) * transmittance(nm);
        }
    }
    std::array::from_fn(|axis| light[axis] / white[axis])
}

/// Returns the hue in degrees and the saturation in sRGB, and the luminance, of white light after a path of `mm`.
fn colour(gem: &Material, mm: f64) -> (f64, f64, f64) {
    let passed = |nm: f64, axis: usize| (-gem.absorption[axis].coefficient(nm) * mm).exp();
    let parts = parts(|nm| 0.5 * (passed(nm, 0) + passed(nm, 1)));
    let [x, y, z] = std::array::from_fn(|axis| parts[axis] * WHITE[axis]);
    let linear = [
        3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
        -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
        0.0556434 * x - 0.2040259 * y + 1.0572252 * z,
    ];
    let [r, g, b] = linear.map(|c: f64| encoded_from_linear(c.clamp(0.0, 1.0)));
    let (most, least) = (r.max(g).max(b), r.min(g).min(b));
    let span = most - least;
    let sextants = match most {
        _ if span == 0.0 => 0.0,
        m if m == r => (g - b) / span,
        m if m == g => (b - r) / span + 2.0,
        _ => (r - g) / span + 4.0,
    };
    ((60.0 * sextants).rem_euclid(360.0), span / most, y)
}

/// Returns the angle between two hues, the short way round, in degrees.
fn between(a: f64, b: f64) -> f64 {
    ((b - a + 180.0).rem_euclid(360.0) - 180.0).abs()
}

/// The expected colour of every coloured gem after 14 mm: the middle of its hues and how far they may go to either side, in
/// degrees; the least saturation; the least and the greatest luminance.
const SEEN: [(&str, f64, f64, f64, f64, f64); 19] = [
    ("pyrope", 357.0, 12.0, 0.6, 0.015, 0.09),
    ("almandine", 346.0, 12.0, 0.5, 0.03, 0.15),
    ("rhodolite", 332.0, 12.0, 0.35, 0.12, 0.3),
    ("spessartine", 30.0, 8.0, 0.9, 0.2, 0.45),
    ("tsavorite", 140.0, 12.0, 0.8, 0.1, 0.3),
    ("hessonite", 30.0, 10.0, 0.8, 0.15, 0.35),
    ("demantoid", 97.0, 15.0, 0.6, 0.3, 0.55),
    ("ruby", 352.0, 10.0, 0.8, 0.03, 0.2),
    ("blue sapphire", 243.0, 12.0, 0.8, 0.015, 0.12),
    ("red spinel", 345.0, 10.0, 0.8, 0.04, 0.2),
    ("yellow diamond", 55.0, 6.0, 0.5, 0.75, 0.95),
    ("amethyst", 278.0, 10.0, 0.45, 0.1, 0.35),
    ("citrine", 46.0, 8.0, 0.7, 0.5, 0.8),
    ("emerald", 150.0, 12.0, 0.7, 0.1, 0.35),
    ("aquamarine", 192.0, 10.0, 0.15, 0.6, 0.9),
    ("green tourmaline", 155.0, 15.0, 0.7, 0.05, 0.25),
    ("pink tourmaline", 334.0, 10.0, 0.35, 0.2, 0.4),
    ("peridot", 77.0, 10.0, 0.45, 0.55, 0.85),
    ("blue topaz", 200.0, 10.0, 0.3, 0.45, 0.75),
];

#[test]
fn light_through_a_stone_of_common_size_has_the_colour_of_the_gem() {
    for (name, middle, reach, saturated, least, most) in SEEN {
        let (hue, saturation, luminance) = colour(material(name).unwrap(), PATH_MM);
        assert!(between(hue, middle) <= reach, "{name}: a hue of {hue:.1}, not {middle} ± {reach}");
        assert!(saturation >= saturated, "{name}: a saturation of {saturation:.2}");
        assert!((least..=most).contains(&luminance), "{name}: a luminance of {luminance:.4}");
    }
}

#[test]
fn every_coloured_gem_is_looked_at() {
    let coloured = materials().iter().filter(|m| !m.absorption.iter().all(Absorption::is_clear));
    let mut names: Vec<&str> = coloured.map(|m| m.name.as_str()).collect();
    let mut seen = SEEN.map(|(name, ..)| name);
    names.sort_unstable();
    seen.sort_unstable();
    assert_eq!(names, seen);
}

#[test]
fn small_stones_are_paler_and_large_ones_darker_and_more_saturated_but_of_a_like_hue() {
    for (name, ..) in SEEN {
        let [small, common, large] = [5.0, PATH_MM, 30.0].map(|mm| colour(material(name).unwrap(), mm));
        assert!(small.2 > common.2 && common.2 > large.2 && large.2 > 0.002, "{name}");
        assert!(small.1 <= common.1 && common.1 <= large.1, "{name}: {} {} {}", small.1, common.1, large.1);
        for hue in [small.0, large.0] {
            assert!(between(hue, common.0) < 30.0, "{name}: {hue:.1} after {:.1}", common.0);
        }
    }
}

#[test]
fn a_colourless_stone_leaves_white_light_white() {
    let (_, saturation, luminance) = colour(material("grossular").unwrap(), 30.0);
    assert!(saturation < 1e-3 && luminance == 1.0, "{saturation} {luminance}");
}

#[test]
fn only_uniaxial_gems_differ_by_polarisation() {
    for (name, ..) in SEEN {
        let Material { absorption: [o, e], description, .. } = material(name).unwrap();
        assert!(o == e || description.starts_with("Uniaxial"), "{name}");
    }
    let ratio = |name: &str, nm: f64| {
        let [o, e] = &material(name).unwrap().absorption;
        o.coefficient(nm) / e.coefficient(nm)
    };
    assert!(ratio("ruby", 555.0) > 1.5 && ratio("green tourmaline", 550.0) > 2.5);
    assert!(ratio("blue sapphire", 580.0) > 1.0 && ratio("blue sapphire", 700.0) < 1.0);
    assert!(ratio("aquamarine", 600.0) < 1.0);
}

#[test]
fn a_band_is_half_as_high_half_its_width_from_its_centre() {
    let band = AbsorptionBand { nm: 500.0, width: 2000.0, height: [0.3, 0.1] };
    for (nm, part) in [(500.0, 1.0), (1e7 / 21000.0, 0.5), (1e7 / 19000.0, 0.5)] {
        assert!((band.per_mm(nm, 0) - 0.3 * part).abs() < 1e-12);
        assert!((band.per_mm(nm, 1) - 0.1 * part).abs() < 1e-12);
    }
}

#[test]
fn gems_bend_light_as_their_hosts_do_or_by_the_two_numbers_they_were_made_from() {
    for (gem, host) in
        [("ruby", "sapphire"), ("citrine", "quartz"), ("red spinel", "spinel"), ("yellow diamond", "diamond")]
    {
        let (gem, host) = (material(gem).unwrap(), material(host).unwrap());
        assert!(gem.dispersion == host.dispersion && gem.valid_nm == host.valid_nm);
        assert!(gem.source.contains(&host.source) && gem.source.contains("from memory, not yet checked"));
    }
    for (name, n_d, b_g) in [
        ("pyrope", 1.728, 0.022),
        ("almandine", 1.795, 0.025),
        ("spessartine", 1.805, 0.027),
        ("grossular", 1.7465, 0.028),
        ("demantoid", 1.885, 0.057),
        ("emerald", 1.5835, 0.014),
        ("peridot", 1.675, 0.020),
        ("zircon", 1.9545, 0.039),
    ] {
        let gem = material(name).unwrap();
        assert!((gem.index(line::SODIUM_D) - n_d).abs() < 1e-12);
        assert!((gem.dispersion.dispersion_b_g() - b_g).abs() < 1e-12);
        assert!(gem.source.contains("from memory, not yet checked"));
    }
}
