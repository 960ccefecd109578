//! Glasses, plastics and water, given by index and Abbe number, and a few glasses that do not exist.

use super::{Dispersion, Material};

/// The source of the real materials: numbers at the d line as the trade and the makers quote them (for BK7, SF10 and
/// SF11, the data sheets of SCHOTT).
const QUOTED: &str = "index and Abbe number as quoted at the d line";

/// The source of the invented glasses, which are stranger than any real glass.
const INVENTED: &str = "invented, for its looks";

/// The real materials: name, n_d, V_d and, where it is known, the density in g/cm³.
const REAL: [(&str, f64, f64, Option<f64>); 8] = [
    ("water", 1.333, 55.7, Some(0.998)),
    ("fused silica", 1.458, 67.7, Some(2.20)),
    ("PMMA", 1.491, 58.0, Some(1.18)),
    ("BK7", 1.517, 64.2, Some(2.51)),
    ("polycarbonate", 1.586, 30.0, Some(1.20)),
    ("lead crystal", 1.600, 32.0, None),
    ("SF10", 1.728, 28.4, Some(4.28)),
    ("SF11", 1.785, 25.4, Some(4.74)),
];

/// The invented glasses: name, n_d and V_d. They have more dispersion than any real glass.
const STRANGE: [(&str, f64, f64); 4] = [
    ("rainbow glass", 1.55, 8.0),
    ("fire crystal", 2.2, 12.0),
    ("unobtanium", 3.2, 4.0),
    ("rainbow soap", 1.272, 2.0),
];

/// Returns all materials of both tables, the real ones first.
pub(super) fn glasses() -> Vec<Material> {
    let law = |n_d, v_d| Dispersion::Abbe { n_d, v_d };
    let real = REAL.iter().map(|&(name, n_d, v_d, density)| {
        let glass = Material::clear(name, "Isotropic; colourless.", law(n_d, v_d), QUOTED, None);
        density.map_or(glass.clone(), |density| glass.weighing(density))
    });
    let strange = STRANGE.iter().map(|&(name, n_d, v_d)| {
        Material::clear(name, "There is no such glass; colourless.", law(n_d, v_d), INVENTED, None)
    });
    real.chain(strange).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{line, material};
    use super::*;

    #[test]
    fn each_has_the_index_and_the_abbe_number_that_it_is_known_by() {
        let all = REAL.iter().map(|&(name, n_d, v_d, _)| (name, n_d, v_d)).chain(STRANGE);
        for (name, n_d, v_d) in all {
            let law = &material(name).unwrap().dispersion;
            // The law passes through n_d at 587.56 nm. It has the Abbe number as exactly as its rounded constants allow.
            assert!((law.index(line::HELIUM_D) - n_d).abs() < 2e-4 * (n_d - 1.0) * 64.0 / v_d, "{name}");
            let abbe = law.abbe_number().unwrap();
            assert!((abbe / v_d - 1.0).abs() < 2e-2 || v_d < 10.0, "{name}: {abbe}");
        }
    }
}
