//! Meets that a search keeps: the corners of a stone where four or more facets meet.

use brillianteer_scene::Stone;
use glam::{DMat3, DVec3};
use std::collections::{BTreeMap, HashMap};

/// The greatest distance of a point from planes that still meet in it, girdle radii.
pub const MEETS_WITHIN: f64 = 1e-9;

/// Vertices nearer to one another than this, girdle radii, are one corner that a file's rounding has split; no loupe
/// shows it.
const SPLIT: f64 = 1e-3;

/// Three planes whose normals span a smaller volume than this have no accurate common point.
const FLAT: f64 = 1e-3;

/// The facets of a stone, and its corners where four or more of them meet.
pub(super) struct KeptCorners {
    /// The number of facets, none of which may vanish.
    facets: usize,
    corners: Vec<KeptCorner>,
}

struct KeptCorner {
    /// The names of the facets that meet.
    facets: Vec<String>,
    /// The greatest distance by which they may miss one point: [`MEETS_WITHIN`], or as much as in the stone before
    /// the search.
    may_miss: f64,
}

impl KeptCorners {
    /// Finds the corners of a stone.
    pub fn of(stone: &Stone) -> Self {
        let points = stone.polytope.vertices();
        let near = |k: usize| (0..k).find(|&j| points[j].distance(points[k]) < SPLIT).unwrap_or(k);
        let first: Vec<usize> = (0..points.len()).map(near).collect();
        let mut at: BTreeMap<usize, Vec<u32>> = BTreeMap::new();
        for (place, facet) in (0..).zip(stone.polytope.facets()) {
            for &vertex in &facet.outline {
                let facets = at.entry(first[vertex as usize]).or_default();
                if facets.last() != Some(&place) {
                    facets.push(place);
                }
            }
        }
        let planes = planes(stone);
        let many = at.into_values().filter(|facets| facets.len() > 3);
        let corner = |places: Vec<u32>| {
            let facets: Vec<String> = places.into_iter().map(|k| stone.name(k).into_owned()).collect();
            let may_miss = miss(&facets, &planes)?.max(MEETS_WITHIN);
            (may_miss < SPLIT).then_some(KeptCorner { facets, may_miss })
        };
        Self { facets: stone.polytope.facets().len(), corners: many.filter_map(corner).collect() }
    }

    /// Returns whether `stone` has as many facets as the stone of these corners.
    pub fn has_all_facets(&self, stone: &Stone) -> bool {
        stone.polytope.facets().len() == self.facets
    }

    /// Returns the names of the facets of a corner that `stone` does not keep; `None` where it keeps all.
    pub fn broken(&self, stone: &Stone) -> Option<&[String]> {
        let planes = planes(stone);
        let is_kept = |corner: &KeptCorner| {
            // Rounding alone may move a corner that was only nearly met.
            miss(&corner.facets, &planes).is_some_and(|miss| miss <= 1.1 * corner.may_miss)
        };
        self.corners.iter().find(|corner| !is_kept(corner)).map(|corner| &corner.facets[..])
    }

    /// Returns the greatest distance by which planes miss the corner that they belong to, girdle radii; infinite
    /// where a facet is gone.
    pub fn miss(&self, stone: &Stone) -> f64 {
        let planes = planes(stone);
        let each = self.corners.iter().map(|corner| miss(&corner.facets, &planes).unwrap_or(f64::INFINITY));
        each.fold(0.0, f64::max)
    }

    /// Returns the number of corners.
    pub fn count(&self) -> usize {
        self.corners.len()
    }
}

fn planes(stone: &Stone) -> HashMap<String, (DVec3, f64)> {
    let facets = (0..).zip(stone.polytope.facets());
    facets.map(|(k, facet)| (stone.name(k).into_owned(), (facet.plane.normal, facet.plane.offset))).collect()
}

/// Returns the greatest distance of a plane from the point that three of them make; `None` where a facet is missing,
/// or no three planes make a point.
fn miss(facets: &[String], planes: &HashMap<String, (DVec3, f64)>) -> Option<f64> {
    let found: Vec<(DVec3, f64)> =
        facets.iter().map(|name| planes.get(name).copied()).collect::<Option<_>>()?;
    let mut best: Option<(f64, DVec3)> = None;
    for (i, a) in found.iter().enumerate() {
        for (j, b) in found.iter().enumerate().skip(i + 1) {
            for c in &found[j + 1..] {
                let rows = DMat3::from_cols(a.0, b.0, c.0).transpose();
                let volume = rows.determinant().abs();
                if volume > best.map_or(FLAT, |(volume, _)| volume) {
                    best = Some((volume, rows.inverse() * DVec3::new(a.1, b.1, c.1)));
                }
            }
        }
    }
    let (_, point) = best?;
    Some(found.iter().map(|(normal, offset)| (normal.dot(point) - offset).abs()).fold(0.0, f64::max))
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_cut::TOLKOWSKY;
    use brillianteer_math::Plane;

    fn stone(change: impl Fn(&str, &mut Plane)) -> Stone {
        let mut facets = TOLKOWSKY.facets().unwrap();
        facets.iter_mut().for_each(|(name, plane)| change(name, plane));
        Stone::new(&facets).unwrap()
    }

    #[test]
    fn a_facet_that_moves_alone_breaks_its_corners_and_no_others() {
        let corners = KeptCorners::of(&stone(|_, _| ()));
        // The table's 8, those of bezels, stars and upper halves 8, and of the pavilion 8; the culet; and those of the girdle.
        assert!(corners.count() >= 25, "{}", corners.count());
        assert_eq!(corners.broken(&stone(|_, _| ())), None);
        let bezel = |by: f64| {
            move |name: &str, plane: &mut Plane| {
                if name == "bezel1" || name == "bezel 1" || name == "bezel_1" {
                    plane.offset += by;
                }
            }
        };
        let broken = stone(bezel(-1e-6));
        let named = corners.broken(&broken).expect("a corner is broken");
        assert!(named.iter().any(|name| name.starts_with("bezel")), "{named:?}");
        assert_eq!(corners.broken(&stone(bezel(-1e-10))), None);
        // All facets alike grow the stone, which keeps every corner.
        assert_eq!(corners.broken(&stone(|_, plane| plane.offset *= 1.1)), None);
        // A facet that is gone keeps none.
        let gone = stone(|name, plane| {
            if name.starts_with("star") {
                plane.offset += 1.0;
            }
        });
        assert!(corners.broken(&gone).is_some() && !corners.has_all_facets(&gone));
        assert!(corners.has_all_facets(&broken));
    }
}
