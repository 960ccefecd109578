//! Where the points of a cutter's design lie in the frame of its stone.

use crate::cut::{Cut, Tiers};
use crate::scene::Specimen;
use glam::{DMat3, DVec3};

/// The way from the design's own unit and origin to the frame of the stone: scaled, then moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TierFrame {
    /// The design's unit, in the unit of the frame.
    pub unit: f64,
    /// The place of the design's origin in the frame.
    pub origin: DVec3,
}

impl TierFrame {
    /// Returns the frame of a stone that is cut by tiers; `None` for other stones.
    ///
    /// The planes of the stone n·x = d' are those of the design n·x = d, scaled and moved: d' = unit d + n·origin. Of all planes
    /// together the origin follows by least squares.
    pub fn of(specimen: &Specimen) -> Option<Self> {
        let Cut::Tiers(tiers) = &specimen.design.cut else { return None };
        let (stone, unit) = (specimen.stone().ok()?, specimen.unit);
        let given = offsets(tiers);
        let (mut squares, mut sums) = (DMat3::ZERO, DVec3::ZERO);
        for (facet, plane) in stone.polytope.facets().iter().zip(stone.polytope.planes()) {
            // Planes of the block that closes a stone are none of the design's.
            let Some(own) = given.get(facet.source) else { continue };
            let n = plane.normal;
            squares += DMat3::from_cols(n * n.x, n * n.y, n * n.z);
            sums += n * (plane.offset - unit * own);
        }
        let origin = squares.inverse() * sums;
        origin.is_finite().then_some(Self { unit, origin })
    }

    /// Returns where a point of the design lies in the frame of the stone.
    pub fn place(&self, point: DVec3) -> DVec3 {
        self.origin + self.unit * point
    }
}

/// Returns the distances of all facets that are cut, in the order in which a design lists them.
fn offsets(tiers: &Tiers) -> Vec<f64> {
    let cut = tiers.tiers.iter().filter(|tier| tier.is_cut);
    cut.flat_map(|tier| std::iter::repeat_n(tier.distance.abs(), tier.facets.len())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::document::Document;
    use crate::io::as_tiers;

    #[test]
    fn corners_that_tiers_can_be_cut_to_lie_on_the_stone() {
        let mut document = Document::first().unwrap();
        assert_eq!(TierFrame::of(document.specimen()), None, "a brilliant is not cut by tiers");
        let mut tiers = as_tiers(document.specimen()).unwrap().with_own_meets();
        // Another unit, and facets that lie beside the axis.
        tiers.tiers.iter_mut().for_each(|tier| tier.distance *= 3.5);
        let table = tiers.tiers.iter().position(|tier| tier.angle == 0.0).unwrap();
        let corners = tiers.tier_corners(table);
        document.work.design.cut = Cut::Tiers(tiers);
        assert!(document.update());
        let frame = TierFrame::of(document.specimen()).unwrap();
        let solid = document.specimen().solid();
        let now = corners.iter().filter(|corner| {
            let at = frame.place(corner.at);
            solid.vertices().iter().any(|vertex| vertex.distance(at) < 1e-9)
        });
        assert!(now.count() >= 8, "the corners of the table are corners of the stone");
        assert!((frame.unit * 3.5 - 1.0).abs() < 0.05, "{frame:?}");
    }
}
