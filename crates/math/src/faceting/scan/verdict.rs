//! Whether a solid reproduces a scan, and what is left is noise.

use super::Fitted;
use super::bend::{Bend, bend};
use super::patches::ScanCorners;
use crate::{Plane, Polytope, Surface};
use glam::DVec3;
use rayon::prelude::*;

/// A scan has at least this many corners for each facet, besides the three that fix its plane, so that its noise is known.
pub(super) const FREEDOM: usize = 4;

/// The greatest distance of a corner from the solid, as a part of the size: noise hides a culet that is narrower.
const FARTHEST: f64 = 6e-3;

/// The greatest part of the corners that lie farther from the solid than noise explains: inclusions, dust, worn edges.
const UNEXPLAINED: f64 = 0.02;

/// The fewest corners of a facet that tell what a curved one explains.
const MANY: usize = 12;

/// The greatest part of the squared distances that curved facets explain. Noise leaves nothing, a curved facet nearly all.
const CURVED: f64 = 0.3;

/// The greatest difference between the volumes of solid and surface, as a part of the volume, besides what the distance
/// between the two explains.
const VOLUME: f64 = 4e-4;

/// The greatest part of the volume that triangles across the edges of the solid may cut off, where the scan has no corners on
/// the edges.
const CUT_OFF: f64 = 0.02;

/// Returns whether a solid reproduces a scan except for noise.
pub(super) fn is_reproduced(surface: &Surface, corners: &ScanCorners, fitted: &Fitted) -> bool {
    let Fitted { polytope, members, fits } = fitted;
    let freedom: usize = fits.iter().map(|fit| fit.freedom()).sum();
    let unexplained = members.explained.iter().filter(|known| !**known).count();
    freedom >= FREEDOM * fits.len()
        && members.deviation <= FARTHEST * surface.size()
        && unexplained as f64 <= UNEXPLAINED * corners.at.len() as f64
        && curved_part(corners, fitted) <= CURVED
        && has_volume(surface, polytope, members.are_shared)
}

/// Returns the part of the squared distances of all corners from their facets that facets of second order explain, less what
/// they explain of noise.
fn curved_part(corners: &ScanCorners, fitted: &Fitted) -> f64 {
    let (mut explained, mut whole) = (0.0, 0.0);
    for (fit, of) in fitted.fits.iter().zip(&fitted.members.of) {
        let bend = Some(of).filter(|of| of.len() >= MANY).and_then(|of| bend(corners, of, fit));
        if let Some(Bend { fall, forms, .. }) = bend {
            explained += fall - fit.squares / fit.freedom() as f64 * forms;
            whole += fit.squares;
        }
    }
    if whole > 0.0 { explained / whole } else { 0.0 }
}

/// Returns whether the volume of a solid is that of the surface, besides what triangles across its edges cut off.
fn has_volume(surface: &Surface, polytope: &Polytope, are_shared: bool) -> bool {
    let planes: Vec<Plane> = polytope.planes().collect();
    let cut_off = |t: usize| {
        let [a, b, c] = surface.corners(t);
        let depth = |at: DVec3| planes.iter().map(|p| -p.distance(at)).fold(f64::INFINITY, f64::min);
        // Simpson's rule for triangles: the depth is nearly linear on each side of an edge.
        let depths = [(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0].map(depth);
        surface.area_vector(t).length() * depths.iter().sum::<f64>() / 3.0
    };
    let each: Vec<f64> = (0..surface.triangles.len()).into_par_iter().map(cut_off).collect();
    let cut_off: f64 = each.into_iter().sum();
    let volume = polytope.volume();
    let excess = volume - surface.volume();
    let most = if are_shared { VOLUME } else { CUT_OFF };
    cut_off <= most * volume && (excess - cut_off).abs() <= VOLUME * volume
}
