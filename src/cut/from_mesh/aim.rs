//! Which facet is the table, and so where up is.

use super::even::{self, Match};
use super::{FromMeshError, Up};
use crate::math::Plane;
use glam::{DQuat, DVec3};

/// A facet whose normal is this near (cosine, 5 degrees) to a direction given as up is the table.
const NEAR_UP: f64 = 0.996_194_698;

/// Facets smaller than this part of the largest are not taken for the table.
const LEAST_TABLE: f64 = 0.25;

/// A facet around which nothing lies evenly counts this part of one around which all does.
const UNEVEN: f64 = 0.2;

/// Facets whose scores differ by less than this part are equals, and the one that faces up is taken.
const EQUAL: f64 = 0.02;

/// The most facets of which all are compared with all, for each facet that may be the table.
const MOST_COMPARED: usize = 400;

/// The axis up, a unit vector, and the facet that is the table, where there is one. Planes are about the middle.
pub(super) fn axis(planes: &[Plane], areas: &[f64], up: Up) -> Result<(DVec3, Option<usize>), FromMeshError> {
    let largest = |of: &dyn Fn(usize) -> bool| {
        (0..planes.len()).filter(|&i| of(i)).max_by(|&a, &b| areas[a].total_cmp(&areas[b]).then(b.cmp(&a)))
    };
    if let Up::Given(given) = up {
        let Some(unit) = Plane::new(given, 0.0).normalized().map(|p| p.normal) else {
            return Err(FromMeshError::Up(given));
        };
        let table = largest(&|i| planes[i].normal.dot(unit) >= NEAR_UP);
        return Ok((table.map_or(unit, |t| planes[t].normal), table));
    }
    let most = areas.iter().copied().fold(0.0, f64::max);
    let scores: Vec<(f64, usize)> = (0..planes.len())
        .filter(|&i| areas[i] >= LEAST_TABLE * most)
        .map(|i| (areas[i] * (UNEVEN + (1.0 - UNEVEN) * evenness(planes, areas, planes[i].normal)), i))
        .collect();
    let best = scores.iter().map(|s| s.0).fold(0.0, f64::max);
    // Whether it faces +z, then +y, decides among equals.
    let faces_up = |i: usize| planes[i].normal.z.max(0.9 * planes[i].normal.y);
    let equals = scores.into_iter().filter(|s| s.0 >= (1.0 - EQUAL) * best).map(|s| s.1);
    let table = equals.max_by(|&a, &b| faces_up(a).total_cmp(&faces_up(b)).then(b.cmp(&a)));
    Ok((table.map_or(DVec3::Z, |t| planes[t].normal), table))
}

/// The largest part of the area that some turn about an axis carries onto other facets.
fn evenness(planes: &[Plane], areas: &[f64], axis: DVec3) -> f64 {
    if planes.len() > MOST_COMPARED {
        return 0.0;
    }
    let loose = Match::loose(planes);
    let carried = |&fold: &u32| {
        let turn = DQuat::from_axis_angle(axis, std::f64::consts::TAU / f64::from(fold));
        let met = (0..planes.len()).filter(|&i| loose.find(&even::turned(&planes[i], turn)).is_some());
        met.map(|i| areas[i]).sum::<f64>() / areas.iter().sum::<f64>()
    };
    [2, 3, 4, 5, 6, 7, 8, 9, 10, 12].iter().map(carried).fold(0.0, f64::max)
}
