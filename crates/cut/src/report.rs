//! A report of a stone's facets: its tiers with the spread of their slopes.

use super::Cut;
use super::facet_zones::{EXACT, FacetZones};
use super::outline::{AlongAxes, Outline};
use super::{TierZone, tier_stem};
use brillianteer_math::{Facet, Plane, Polytope, TriangleMesh, grouped, span};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// The least, mean and greatest value among the facets of a tier.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// The least value.
    pub least: f64,
    /// The mean; every facet counts alike.
    pub mean: f64,
    /// The greatest value.
    pub most: f64,
}

impl Spread {
    fn of(values: impl ExactSizeIterator<Item = f64> + Clone) -> Self {
        let (least, most) = span(values.clone());
        let mean = values.clone().sum::<f64>() / values.len() as f64;
        Self { least, mean: mean.clamp(least, most), most }
    }
}

/// The facets of one tier in one zone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TierReport {
    /// The name of the tier: where several tiers have one name of their own, the second has `#2` behind it, and so on.
    pub name: String,
    /// The zone where they lie.
    pub zone: TierZone,
    /// The number of facets.
    pub facets: usize,
    /// The slopes of the facets from the girdle plane, degrees.
    pub slope_deg: Spread,
    /// The distances from the origin to the facets' planes along their normals, girdle radii.
    pub distance: Spread,
}

/// A stone's proportions, measured on the solid: percent of its diameter (see [`Outline::diameter`]), and tiers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ProportionReport {
    /// The length divided by the width.
    pub length_to_width: f64,
    /// Width and length of the table, whichever way it lies.
    pub table: [f64; 2],
    /// The greatest distance between two corners of the table.
    pub table_corners: f64,
    /// The height from the girdle's upper edge at the mains to the highest point, as a design gives it.
    pub crown_height: f64,
    /// The distance between the girdle's edges at the mains, as a design gives it.
    pub girdle_thickness: f64,
    /// The lengths of the edges between two facets of the girdle; `None` where it has none.
    pub girdle_edges: Option<Spread>,
    /// The depth from the girdle's lower edge at the mains to the lowest point, as a design gives it.
    pub pavilion_depth: f64,
    /// The height from the lowest point to the highest.
    pub total_depth: f64,
    /// The tiers, in the order of their first facets.
    pub tiers: Vec<TierReport>,
    /// The ratios that cutters' diagrams print of the stone.
    pub along_axes: AlongAxes,
}

impl ProportionReport {
    /// Measures a solid whose facets have these names, in the same order. Facets whose names differ only by a number are one
    /// tier.
    pub fn of(stone: &Polytope, names: &[String]) -> Self {
        Self::with_tiers(stone, &names.iter().map(|name| tier_stem(name)).collect::<Vec<_>>())
    }

    /// Measures the solid of a cut, whose facets have these names, in the same order. Its tiers are those of
    /// [`Cut::settings`], by their names there, where the cut has such.
    pub fn of_cut(cut: &Cut, stone: &Polytope, names: &[String]) -> Self {
        let tiers = cut.tiers_of_facets();
        let tier =
            |name: &'_ String| tiers.get(name).map_or_else(|| tier_stem(name).to_owned(), String::clone);
        let named: Vec<String> = names.iter().map(tier).collect();
        Self::with_tiers(stone, &named.iter().map(String::as_str).collect::<Vec<_>>())
    }

    /// Measures a solid whose facets lie in tiers of these names.
    fn with_tiers(stone: &Polytope, names: &[&str]) -> Self {
        let outline = Outline::of(stone);
        let percent = |length: f64| 100.0 * length / outline.diameter;
        Self {
            length_to_width: outline.length / outline.width,
            table: outline.table.map(percent),
            table_corners: percent(outline.table_corners),
            crown_height: percent(outline.crown_height()),
            girdle_thickness: percent(outline.girdle_thickness()),
            girdle_edges: girdle_edges(stone, percent),
            pavilion_depth: percent(outline.pavilion_depth()),
            total_depth: percent(outline.top - outline.bottom),
            tiers: tiers(stone, names),
            along_axes: AlongAxes::of(stone, &outline),
        }
    }
}

/// The heights of a solid of triangles whose girdle stands upright, in percent of its diameter, which is 2 in its frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MeshHeights {
    /// The height from the girdle's highest point to the highest point.
    pub crown_height: f64,
    /// The height from the girdle's lowest point to its highest.
    pub girdle_height: f64,
    /// The depth from the girdle's lowest point to the lowest point.
    pub pavilion_depth: f64,
    /// The height from the lowest point to the highest.
    pub total_depth: f64,
}

impl MeshHeights {
    /// Measures a solid; `None` where it has no upright facets.
    pub fn of(mesh: &TriangleMesh) -> Option<Self> {
        let surface = mesh.surface();
        let upright = surface.triangles.iter().zip(mesh.facets()).filter(|(_, facet)| {
            let normal = mesh.planes()[**facet as usize].normal;
            normal.z.abs() < EXACT
        });
        let height = |corner: &u32| surface.vertices[*corner as usize].z;
        let (low, high) = span(upright.flat_map(|(corners, _)| corners).map(height));
        let (bottom, top) = span(surface.vertices.iter().map(|corner| corner.z));
        let percent = |length: f64| 50.0 * length;
        (high > low).then(|| Self {
            crown_height: percent(top - high),
            girdle_height: percent(high - low),
            pavilion_depth: percent(low - bottom),
            total_depth: percent(top - bottom),
        })
    }
}

/// Returns the lengths of the edges between two facets of the girdle, each converted by `percent`.
fn girdle_edges(stone: &Polytope, percent: impl Fn(f64) -> f64) -> Option<Spread> {
    let (facets, zones) = (stone.facets(), FacetZones::of(stone));
    let upright = (0..).zip(facets).filter(|(_, facet)| zones.is_girdle(facet));
    let edges = upright.flat_map(|(k, facet): (u32, &Facet)| {
        let corners: Vec<DVec3> = stone.corners(facet).collect();
        let across = facet.neighbours.clone().into_iter().enumerate();
        across
            .filter(move |&(_, other)| other > k && zones.is_girdle(&facets[other as usize]))
            .map(move |(i, _)| corners[i].distance(corners[(i + 1) % corners.len()]))
    });
    let lengths: Vec<f64> = edges.map(percent).collect();
    (!lengths.is_empty()).then(|| Spread::of(lengths.iter().copied()))
}

fn tiers(stone: &Polytope, names: &[&str]) -> Vec<TierReport> {
    let zones = FacetZones::of(stone);
    let named = stone.facets().iter().zip(names);
    let facets = named.map(|(facet, name)| ((*name, zones.zone(facet)), facet.plane));
    let report = |tier: Vec<((&str, TierZone), Plane)>| {
        let (name, zone) = tier[0].0;
        let slope = |normal: DVec3| normal.truncate().length().atan2(normal.z.abs()).to_degrees();
        TierReport {
            name: name.to_owned(),
            zone,
            facets: tier.len(),
            slope_deg: Spread::of(tier.iter().map(|(_, plane)| slope(plane.normal))),
            // The sum with 0 turns the -0 of a plane through the origin into 0.
            distance: Spread::of(tier.iter().map(|(_, plane)| plane.offset + 0.0)),
        }
    };
    grouped(facets, |a, b| a.0 == b.0).into_iter().map(report).collect()
}

#[cfg(test)]
mod tests {
    use super::super::round_brilliant::MODERN;
    use super::*;
    use brillianteer_math::Plane;

    #[test]
    fn a_brilliant_is_reported_by_its_tiers() {
        let facets = MODERN.facets().unwrap();
        let (names, planes): (Vec<String>, Vec<Plane>) = facets.into_iter().unzip();
        let report = ProportionReport::of(&Polytope::from_planes(&planes).unwrap(), &names);
        let told: Vec<_> = report.tiers.iter().map(|t| (t.name.as_str(), t.zone.name(), t.facets)).collect();
        assert_eq!(
            told,
            [
                ("table", "table", 1),
                ("bezel", "crown", 8),
                ("star", "crown", 8),
                ("upper_half", "crown", 16),
                ("girdle", "girdle", 96),
                ("lower_half", "pavilion", 16),
                ("main", "pavilion", 8)
            ]
        );
        let bezel = report.tiers[1].slope_deg;
        assert!((bezel.mean - 34.5).abs() < 1e-12 && bezel.most - bezel.least < 1e-12, "{bezel:?}");
        assert!((report.table_corners - MODERN.table).abs() < 1e-9, "{report:?}");
        let edges = report.girdle_edges.unwrap();
        // The given thickness is that at the mains, where the girdle is thickest.
        assert!((edges.most - MODERN.girdle_thickness).abs() < 1e-9 && edges.least < edges.most, "{edges:?}");
        assert!(
            (report.crown_height + report.girdle_thickness + report.pavilion_depth - report.total_depth)
                .abs()
                < 1e-9
        );
    }

    #[test]
    fn a_solid_of_triangles_has_the_heights_of_the_stone_that_it_was() {
        let facets = MODERN.facets().unwrap();
        let (names, planes): (Vec<String>, Vec<Plane>) = facets.into_iter().unzip();
        let stone = Polytope::from_planes(&planes).unwrap();
        let (report, mesh) =
            (ProportionReport::of(&stone, &names), MeshHeights::of(&TriangleMesh::of_polytope(&stone)));
        let MeshHeights { crown_height, girdle_height, pavilion_depth, total_depth } = mesh.unwrap();
        assert!((total_depth - report.total_depth).abs() < 1e-9);
        assert!((crown_height + girdle_height + pavilion_depth - total_depth).abs() < 1e-9);
        assert!((girdle_height - MODERN.girdle_thickness).abs() < 1e-9, "{girdle_height}");
    }

    #[test]
    fn a_facet_that_leans_widens_the_spread_of_its_tier_alone() {
        let (names, mut planes): (Vec<String>, Vec<Plane>) = MODERN.facets().unwrap().into_iter().unzip();
        planes[1] = Plane::from_slope(35f64.to_radians(), 0.0, planes[1].offset);
        let report = ProportionReport::of(&Polytope::from_planes(&planes).unwrap(), &names);
        let width = |k: usize| report.tiers[k].slope_deg.most - report.tiers[k].slope_deg.least;
        assert!((width(1) - 0.5).abs() < 1e-9 && width(2) < 1e-9);
        assert!((report.tiers[1].slope_deg.mean - (7.0 * 34.5 + 35.0) / 8.0).abs() < 1e-9);
    }
}
