//! The proportions of a round brilliant, measured on the stone, whether it is a design, a cutter's file or a scan.

use super::facet_deviations::{FacetClasses, LeaningFacet, NotEightfold, OCTANTS, facet_deviations};
use brillianteer_cut::{BrilliantProportions, Outline};
use brillianteer_math::Facet;
use brillianteer_scene::Stone;
use std::f64::consts::FRAC_PI_8;

/// Measures the proportions of a round brilliant of eight mains, as docs/optics.md defines them. Each is the mean over its facets,
/// around the middle of the outline; lengths are in percent of the diameter.
///
/// # Errors
/// Fails with [`NotEightfold`] where the stone is no round brilliant of eight mains.
pub fn brilliant_proportions(stone: &Stone) -> Result<BrilliantProportions, NotEightfold> {
    facet_deviations(stone)?;
    let FacetClasses { table, crown, pavilion } = FacetClasses::of(stone)?;
    let (star, bezel) = (&crown[..OCTANTS], &crown[OCTANTS..2 * OCTANTS]);
    let (main, lower) = pavilion.split_at(OCTANTS);
    let outline = Outline::of(&stone.polytope);
    let radius = 0.5 * outline.diameter;
    let on = FacetsOnStone { stone, outline };
    let table = on.table_radius(&table) / radius;
    let tip = on.mean(star, |facet| on.radii(facet).fold(0.0, f64::max)) / radius;
    let inner = on.mean(lower, |facet| on.radii(facet).fold(f64::INFINITY, f64::min)) / radius;
    let slope =
        |class: &[LeaningFacet]| class.iter().map(|facet| facet.slope_deg).sum::<f64>() / class.len() as f64;
    let percent = |length: f64| 50.0 * length / radius;
    let edge = table * FRAC_PI_8.cos();
    Ok(BrilliantProportions {
        table: 100.0 * table,
        crown_angle: slope(bezel),
        pavilion_angle: slope(main),
        star_length: 100.0 * (tip - edge) / (1.0 - edge),
        lower_half_length: 100.0 * (1.0 - inner),
        girdle_thickness: percent(on.outline.girdle_thickness()),
        crown_height: percent(on.outline.crown_height()),
    })
}

/// A stone with its outline.
struct FacetsOnStone<'a> {
    stone: &'a Stone,
    outline: Outline,
}

impl FacetsOnStone<'_> {
    /// Returns the mean of a number over the facets of a class.
    fn mean(&self, class: &[LeaningFacet], of: impl Fn(&Facet) -> f64) -> f64 {
        let facets = self.stone.polytope.facets();
        class.iter().map(|facet| of(&facets[facet.number])).sum::<f64>() / class.len() as f64
    }

    /// Returns the distances of a facet's corners from the middle of the outline, seen from above.
    fn radii(&self, facet: &Facet) -> impl Iterator<Item = f64> {
        let middle = self.outline.middle;
        self.stone.polytope.corners(facet).map(move |corner| corner.truncate().distance(middle))
    }

    /// Returns the mean distance of the table's corners from the middle. Of several facets, the largest is the table.
    fn table_radius(&self, table: &[usize]) -> f64 {
        let (polytope, facets) = (&self.stone.polytope, self.stone.polytope.facets());
        let all = table.iter().map(|number| &facets[*number]);
        let largest = all.max_by(|a, b| polytope.facet_area(a).total_cmp(&polytope.facet_area(b)));
        let radii: Vec<f64> = largest.into_iter().flat_map(|facet| self.radii(facet)).collect();
        radii.iter().sum::<f64>() / radii.len().max(1) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_cut::{Crown, LowerHalf, Pavilion, RoundBrilliant, TOLKOWSKY};
    use brillianteer_math::Plane;
    use glam::DVec2;

    fn fields(of: &BrilliantProportions) -> [f64; 7] {
        let BrilliantProportions { table, crown_angle, pavilion_angle, star_length, .. } = *of;
        let BrilliantProportions { lower_half_length, girdle_thickness, crown_height, .. } = *of;
        [table, crown_angle, pavilion_angle, star_length, lower_half_length, girdle_thickness, crown_height]
    }

    #[test]
    fn a_stone_measures_what_its_design_gives_however_it_is_turned() {
        let flat = RoundBrilliant {
            table: 61.5,
            crown: Crown::Height(11.0),
            pavilion: Pavilion::Angle(42.3),
            star_length: 57.0,
            lower_half: LowerHalf::Vertical(83.0),
            girdle_thickness: 4.2,
            girdle_facets: 64,
            culet: 1.5,
        };
        for design in [TOLKOWSKY, flat] {
            for turn in [0.0, 11.0_f64, 200.3] {
                let facets = design.facets().unwrap().into_iter().map(|(name, plane)| {
                    let across = DVec2::from_angle(turn.to_radians()).rotate(plane.normal.truncate());
                    (name, Plane { normal: across.extend(plane.normal.z), ..plane })
                });
                let stone = Stone::new(&facets.collect::<Vec<_>>()).unwrap();
                let [found, given] =
                    [brilliant_proportions(&stone).unwrap(), BrilliantProportions::of(&design)];
                for (a, b) in fields(&found).into_iter().zip(fields(&given)) {
                    assert!((a - b).abs() < 1e-6, "{turn}: {found:?} is not {given:?}");
                }
            }
        }
    }
}
