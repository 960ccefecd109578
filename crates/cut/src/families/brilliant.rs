//! The brilliant on any convex outline: mains, stars and halves whose corners meet in points.
//!
//! At each main station, a bezel touches the outline: its level lines run along the tangent there. The bezel's corner
//! of the table lies on the way from the station to the axis of the stone, so the table is the outline made smaller,
//! and all bezels rise to it. Mains below run to the culet's point in the same way. Two neighbours meet in a line;
//! the tip of a star, or of two lower halves, is a point of that line. Stars go through a star tip and two corners of
//! the table, halves through a tip and two neighbouring stations. All facets meet in points for every convex outline.
//! The stone is convex, because tangents of a convex curve meet outside it. The construction is this program's own;
//! on a circle it is the round brilliant of docs/optics.md.

use super::super::facet_net::{FacetNet, NoRoom};
use super::super::family_cut::FamilyCut;
use super::girdle::{Girdle, GirdlePlace};
use glam::{DVec2, DVec3};

/// The numbers of a brilliant on an outline. Lengths are in girdle radii, and heights are above the girdle's upper
/// edge.
pub struct Brilliant<'a> {
    pub girdle: &'a Girdle,
    /// The point, seen from above, to which table and culet are centred.
    pub middle: DVec2,
    /// The size of the table as a part of the outline's size.
    pub table: f64,
    /// The height of the table.
    pub crown_height: f64,
    /// The part of the way from the table's edge to the outline that the stars reach, seen from above.
    pub star: f64,
    /// True where that way begins at the place where the stars would lie flat with the table, so that any part of it
    /// makes stars.
    pub is_star_free: bool,
    /// The girdle's thickness at the mains.
    pub thickness: f64,
    /// The depth of the mains' point below the girdle.
    pub pavilion_depth: f64,
    /// The part of the way from the outline to the middle that the lower halves reach, seen from above.
    pub lower_half: f64,
    /// The size of the culet as a part of the outline's size; 0 is a point.
    pub culet: f64,
}

/// The heights of a brilliant, in girdle radii.
struct BrilliantHeights {
    /// The height of the table above the girdle.
    crown: f64,
    /// The depth of the mains' point below the girdle.
    pavilion: f64,
}

impl BrilliantHeights {
    /// Returns the heights of a cut whose first three rows from `place` on are those of
    /// [`brilliant_rows`](super::brilliant_rows). Both angles are those of facets at a distance of `reach` from the
    /// middle.
    fn of(cut: &FamilyCut, place: usize, reach: f64) -> Self {
        let [table, crown, pavilion] = std::array::from_fn(|row| cut[place + row]);
        Self {
            crown: (1.0 - table / 100.0) * reach * crown.to_radians().tan(),
            pavilion: reach * pavilion.to_radians().tan(),
        }
    }
}

impl<'a> Brilliant<'a> {
    /// Returns the numbers of a cut whose seven rows from `place` on are those of
    /// [`brilliant_rows`](super::brilliant_rows). Both angles are those of facets at a distance of `reach` from the
    /// middle.
    pub fn of(cut: &FamilyCut, place: usize, girdle: &'a Girdle, middle: DVec2, reach: f64) -> Self {
        let [table, _, _, star, lower_half, thickness, culet] = std::array::from_fn(|row| cut[place + row]);
        let heights = BrilliantHeights::of(cut, place, reach);
        Self {
            girdle,
            middle,
            table: table / 100.0,
            crown_height: heights.crown,
            star: star / 100.0,
            is_star_free: false,
            thickness: thickness / 50.0,
            pavilion_depth: heights.pavilion,
            lower_half: lower_half / 100.0,
            culet: culet / 100.0,
        }
    }

    /// Returns the height of the whole stone, in girdle radii, of a cut whose seven rows from `place` on are those of
    /// [`brilliant_rows`](super::brilliant_rows).
    pub fn total_depth(cut: &FamilyCut, place: usize, reach: f64) -> f64 {
        let [.., thickness, culet] = std::array::from_fn::<f64, 7, _>(|row| cut[place + row]);
        let heights = BrilliantHeights::of(cut, place, reach);
        heights.crown + thickness / 50.0 + heights.pavilion * (1.0 - culet / 100.0)
    }

    /// Makes all facets.
    ///
    /// # Errors
    /// Fails with the tier whose points give no plane.
    pub fn net(&self) -> Result<FacetNet, NoRoom> {
        let mut net = self.without_pavilion()?;
        self.add_pavilion(&mut net)?;
        Ok(net)
    }

    /// Makes table, crown, girdle and culet, for a pavilion of another kind with the same depth.
    ///
    /// # Errors
    /// Fails with the tier whose points give no plane.
    pub fn without_pavilion(&self) -> Result<FacetNet, NoRoom> {
        let mut net = self.girdle.empty_net();
        net.plane("table", DVec3::Z, DVec3::Z * self.crown_height);
        self.add_crown(&mut net)?;
        if self.thickness > 0.0 {
            self.girdle.add_to(&mut net);
        }
        if self.culet > 0.0 {
            let depth = self.thickness + self.pavilion_depth * (1.0 - self.culet);
            net.plane("culet", DVec3::NEG_Z, DVec3::NEG_Z * depth);
        }
        Ok(net)
    }

    /// Returns a point inside the stone, near which no plane runs.
    pub fn inside(&self) -> DVec3 {
        self.middle.extend(-0.5 * self.thickness)
    }

    fn add_crown(&self, net: &mut FacetNet) -> Result<(), NoRoom> {
        let top = |main| self.toward_middle(main, self.table).extend(self.crown_height);
        for main in self.girdle.mains() {
            let GirdlePlace { at, normal, .. } = self.girdle.main(main);
            let level = normal.perp().extend(0.0);
            net.through("bezel", [at.extend(0.0), at.extend(0.0) + level, top(main)], self.inside())?;
        }
        let tips = self.girdle.gaps().map(|main| self.star_tip(main)).collect::<Option<Vec<_>>>();
        let tips = tips.ok_or(NoRoom { tier: "star" })?;
        for (main, tip) in tips.iter().enumerate() {
            net.through("star", [top(main), top(main + 1), *tip], self.inside())?;
        }
        for (main, tip) in tips.iter().enumerate() {
            self.add_halves(net, "upper_half", main, *tip, 0.0)?;
        }
        Ok(())
    }

    fn add_pavilion(&self, net: &mut FacetNet) -> Result<(), NoRoom> {
        let point = self.middle.extend(-self.thickness - self.pavilion_depth);
        let tips = self.girdle.gaps().map(|main| {
            // This is the end of the line that begins at the culet's point; the tangents of both mains meet there.
            let outer = self.tangents_meet(main, 1.0)?.extend(-self.thickness);
            let reach = self.reach_of_halves(main, outer.truncate())?;
            Some(point + (outer - point) * reach)
        });
        let tips = tips.collect::<Option<Vec<_>>>().ok_or(NoRoom { tier: "lower_half" })?;
        for (main, tip) in tips.iter().enumerate() {
            self.add_halves(net, "lower_half", main, *tip, -self.thickness)?;
        }
        for main in self.girdle.mains() {
            let GirdlePlace { at, normal, .. } = self.girdle.main(main);
            let (edge, level) = (at.extend(-self.thickness), normal.perp().extend(0.0));
            net.through("main", [edge, edge + level, point], self.inside())?;
        }
        Ok(())
    }

    /// Adds the two halves between a main and the next, which share a tip and a point of the girdle.
    fn add_halves(
        &self,
        net: &mut FacetNet,
        tier: &'static str,
        main: usize,
        tip: DVec3,
        z: f64,
    ) -> Result<(), NoRoom> {
        let middle = self.girdle.between(main).extend(z);
        for side in [main, main + 1] {
            net.through(tier, [tip, self.girdle.main(side).at.extend(z), middle], self.inside())?;
        }
        Ok(())
    }

    /// Returns the tip of the star between a main and the next. It is a point of the line in which both bezels meet,
    /// and lies at the part `star` of the way from the table's edge to the outline. `None` where the bezels have no
    /// such line.
    fn star_tip(&self, main: usize) -> Option<DVec3> {
        let (outer, inner) = (self.tangents_meet(main, 1.0)?, self.tangents_meet(main, self.table)?);
        let edge = [main, main + 1].map(|main| self.toward_middle(main, self.table));
        // Both ends of the way lie on the line from the middle to the point where the tangents meet.
        let near = if self.is_star_free { self.table } else { self.crossing(outer, edge) };
        let reached = near + self.star * (self.to_girdle(main, outer) - near);
        let rise = (1.0 - reached) / (1.0 - self.table);
        let at = outer + (inner - outer) * rise;
        Some(at.extend(self.crown_height * rise))
    }

    /// Returns the distance of the lower halves' tip from the culet's point, as a part of the way to the point where
    /// the tangents meet.
    fn reach_of_halves(&self, main: usize, outer: DVec2) -> Option<f64> {
        Some((1.0 - self.lower_half) * self.to_girdle(main, outer)).filter(|reach| *reach > 0.0)
    }

    /// Returns the place where the way from the middle to a point beyond the outline crosses the line through two
    /// points, as a part of that way.
    fn crossing(&self, outer: DVec2, [a, b]: [DVec2; 2]) -> f64 {
        let across = b - a;
        across.perp_dot(a - self.middle) / across.perp_dot(outer - self.middle)
    }

    /// Returns the place where the way from the middle to the meeting point of the tangents of a main and the next
    /// crosses the outline, as a part of that way. The outline is here the nearer of the lines from the two stations
    /// to the point between them.
    fn to_girdle(&self, main: usize, outer: DVec2) -> f64 {
        let between = self.girdle.between(main);
        let side = |main| self.crossing(outer, [self.girdle.main(main).at, between]);
        side(main).min(side(main + 1))
    }

    /// Returns the point on the way from the middle to a main's station, at the part `size` of that way.
    fn toward_middle(&self, main: usize, size: f64) -> DVec2 {
        self.middle + (self.girdle.main(main).at - self.middle) * size
    }

    /// Returns the point where the tangents of a main and of the next meet, in the outline scaled by `size`.
    pub fn tangents_meet(&self, main: usize, size: f64) -> Option<DVec2> {
        let [a, b] = [main, main + 1].map(|main| self.girdle.main(main));
        let [da, db] = [a, b].map(|station| station.normal.dot(station.at - self.middle) * size);
        let across = a.normal.perp_dot(b.normal);
        let meet = (b.normal.perp() * -da + a.normal.perp() * db) / across;
        (across > 0.0).then_some(self.middle + meet)
    }
}
