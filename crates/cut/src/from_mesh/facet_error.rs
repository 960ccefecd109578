//! The standard errors of the slopes and azimuths of facets that were found in a scan.

use brillianteer_math::Plane;
use brillianteer_math::faceting::PlaneError;
use glam::DVec3;

/// The standard errors of a facet that was found in a scan, as it was found and before any evening.
#[derive(Debug, Clone, PartialEq)]
pub struct FacetError {
    /// The name of the facet.
    pub facet: String,
    /// The standard error of the slope from the girdle plane, degrees. It includes the error of the axis where that is the
    /// normal of the table.
    pub slope_deg: f64,
    /// The standard error of the azimuth about the axis, degrees; `None` for the table and for level facets.
    pub azimuth_deg: Option<f64>,
    /// Whether the corners on the facet bend by more than noise, so that it may be several facets that the noise hides. Its standard
    /// errors are then those of the one plane only.
    pub is_bent: bool,
}

impl FacetError {
    /// Returns the errors of a facet in the stone's frame, whose axis is +z. `table` is the error of the table's plane where its
    /// normal is the axis.
    pub(super) fn of(facet: &str, plane: &Plane, error: &PlaneError, table: Option<&PlaneError>) -> Self {
        /// A facet that leans less than this from level (sine) has no azimuth.
        const LEVEL: f64 = 1e-3;
        let leans = plane.normal.truncate().length() > LEVEL;
        let across = DVec3::new(plane.normal.x, plane.normal.y, 0.0).try_normalize();
        let axis = table.filter(|_| leans).zip(across).map_or(0.0, |(table, across)| table.tilt(across));
        Self {
            facet: facet.to_owned(),
            slope_deg: error.slope(plane, DVec3::Z).hypot(axis).to_degrees(),
            is_bent: false,
            azimuth_deg: error.azimuth(plane, DVec3::Z).filter(|_| leans).map(f64::to_degrees),
        }
    }
}
