//! Spread: the size of a stone as seen from above, for its weight.

use brillianteer_cut::round_diameter;
use brillianteer_math::{Calipers, Polytope, hull};
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// The volume, the area seen from above and the outline's perimeter of a round brilliant with table 57 %, crown 34.0°,
/// pavilion 40.7°, star length 50 %, lower halves 80 %, girdle 2.5 % in 96 facets, and no culet, in girdle radii.
///
/// GIA's weight ratio compares with this stone: I. Reinitz, R. Geurts, A. Gilbertson and T. Rapaport, on the cut
/// grade of round brilliants. The number of girdle facets is our own choice.
const REFERENCE: [f64; 3] = [1.632_614_073_561_201, 3.139_350_203_046_868, 6.282_063_901_781_019];

/// The size of a stone as seen from above, for its weight.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FaceUpSize {
    /// The area of the stone seen from above, mm².
    pub face_mm2: f64,
    /// The mean width of the outline over all directions, mm: for a round stone, its average diameter.
    pub mean_width_mm: f64,
    /// The weight, ct; `None` where the material's density is not known.
    pub carats: Option<f64>,
    /// The area seen from above divided by the weight, mm²/ct.
    pub mm2_per_carat: Option<f64>,
    /// The percentage by which the area seen from above exceeds that of the reference brilliant of the same weight.
    /// It is the same in all sizes and materials.
    pub spread_percent: f64,
    /// The volume divided by that of the reference brilliant of the same mean width: GIA's weight ratio. `None` where the
    /// outline is not round.
    pub weight_ratio: Option<f64>,
}

impl FaceUpSize {
    /// Measures a stone whose unit of length is `unit_mm`, and which weighs `carats`.
    pub fn of(stone: &Polytope, unit_mm: f64, carats: Option<f64>) -> Self {
        let [volume, area, perimeter] = seen_from_above(stone);
        let face_mm2 = area * unit_mm.powi(2);
        let of_weight = |volume: f64, area: f64| area / volume.powf(2.0 / 3.0);
        let of_width = |volume: f64, perimeter: f64| volume / perimeter.powi(3);
        let outline = hull(stone.vertices().iter().map(|corner| corner.truncate()).collect());
        let is_round =
            Calipers::of(&outline).is_some_and(|c| round_diameter(&outline, c.middle, c.width).is_some());
        let [reference, reference_area, reference_perimeter] = REFERENCE;
        Self {
            face_mm2,
            // By Cauchy's formula, the mean width of a convex outline is its perimeter divided by π.
            mean_width_mm: perimeter * unit_mm / PI,
            carats,
            mm2_per_carat: carats.filter(|carats| *carats > 0.0).map(|carats| face_mm2 / carats),
            spread_percent: 100.0 * (of_weight(volume, area) / of_weight(reference, reference_area) - 1.0),
            weight_ratio: is_round
                .then(|| of_width(volume, perimeter) / of_width(reference, reference_perimeter)),
        }
    }
}

/// Returns a stone's volume, its area seen from above and the perimeter of its outline.
fn seen_from_above(stone: &Polytope) -> [f64; 3] {
    let outline = hull(stone.vertices().iter().map(|corner| corner.truncate()).collect());
    let next = outline.iter().cycle().skip(1);
    let perimeter = outline.iter().zip(next).map(|(a, b)| a.distance(*b)).sum();
    [stone.volume(), stone.silhouette_area(DVec3::Z), perimeter]
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_cut::{Crown, LowerHalf, Pavilion, RoundBrilliant};
    use brillianteer_math::Plane;
    use brillianteer_scene::Stone;

    const BRILLIANT: RoundBrilliant = RoundBrilliant {
        table: 57.0,
        crown: Crown::Angle(34.0),
        pavilion: Pavilion::Angle(40.7),
        star_length: 50.0,
        lower_half: LowerHalf::Radial(80.0),
        girdle_thickness: 2.5,
        girdle_facets: 96,
        culet: 0.0,
    };

    fn built(stone: &RoundBrilliant) -> Polytope {
        Stone::new(&stone.facets().unwrap()).unwrap().polytope
    }

    #[test]
    fn the_reference_has_no_spread_and_a_weight_ratio_of_1_in_every_size() {
        for unit_mm in [1.0, 3.7] {
            let found = FaceUpSize::of(&built(&BRILLIANT), unit_mm, Some(2.0));
            assert!(found.spread_percent.abs() < 1e-9, "{found:?}");
            assert!((found.weight_ratio.unwrap() - 1.0).abs() < 1e-12, "{found:?}");
            let per_carat = found.mm2_per_carat.unwrap();
            assert!((per_carat - found.face_mm2 / 2.0).abs() < 1e-12, "{found:?}");
            // A polygon of 96 sides is narrower on average than the circle around it.
            assert!((found.mean_width_mm / (2.0 * unit_mm) - 1.0 + (PI / 96.0).powi(2) / 6.0).abs() < 1e-6);
        }
    }

    #[test]
    fn weight_that_does_not_show_from_above_lowers_the_spread_and_raises_the_weight_ratio() {
        let of = |girdle: f64, pavilion: f64| {
            let stone =
                RoundBrilliant { girdle_thickness: girdle, pavilion: Pavilion::Angle(pavilion), ..BRILLIANT };
            FaceUpSize::of(&built(&stone), 1.0, None)
        };
        let stones = [of(2.5, 39.0), of(2.5, 40.7), of(2.5, 42.0), of(4.5, 42.0), of(8.0, 43.0)];
        for pair in stones.windows(2) {
            assert!(pair[1].spread_percent < pair[0].spread_percent - 0.5, "{pair:?}");
            assert!(pair[1].weight_ratio > pair[0].weight_ratio.map(|ratio| ratio + 0.01), "{pair:?}");
        }
        // Volume at equal outline, and outline at equal volume, say the same: (1 + spread)^(3/2) × ratio = 1.
        for each in stones {
            let product = (1.0 + each.spread_percent / 100.0).powf(1.5) * each.weight_ratio.unwrap();
            assert!((product - 1.0).abs() < 1e-9, "{each:?}");
        }
    }

    #[test]
    fn a_long_stone_has_a_spread_and_no_weight_ratio() {
        // Stretched along x by half, a stone has half more volume and half more face.
        let facets: Vec<(String, Plane)> = BRILLIANT.facets().unwrap();
        let stretched = facets.into_iter().map(|(name, plane)| {
            let normal = plane.normal / DVec3::new(1.5, 1.0, 1.0);
            let length = normal.length();
            (name, Plane { normal: normal / length, offset: plane.offset / length })
        });
        let stone = Stone::new(&stretched.collect::<Vec<_>>()).unwrap().polytope;
        let found = FaceUpSize::of(&stone, 1.0, None);
        let expected = 100.0 * (1.5 / 1.5_f64.powf(2.0 / 3.0) - 1.0);
        assert!((found.spread_percent - expected).abs() < 1e-9, "{found:?}");
        assert!(found.weight_ratio.is_none() && found.mm2_per_carat.is_none(), "{found:?}");
    }
}
