//! The handles of a round brilliant's profile: which proportion each changes, where it lies, and which value a pull
//! requests.
//!
//! Places are in girdle radii in the profile's plane: x to the right of the axis, y up from the girdle's upper edge.

use super::quantity::{Quantity, ValueGrid};
use crate::cut::{Derived, RoundBrilliant};
use egui::CursorIcon;
use glam::DVec2;

/// A part of the profile that is pulled to change one proportion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Handle {
    /// The table's corner, on the right.
    TableEdge,
    /// The middle of the table's line.
    CrownHeight,
    /// The middle of the right bezel.
    CrownAngle,
    /// The girdle's upper edge, on the left.
    GirdleUpper,
    /// The girdle's lower edge, on the right.
    GirdleLower,
    /// The middle of the right main.
    PavilionAngle,
    /// The culet's right corner, or the tip, pulled up and down.
    PavilionDepth,
    /// The culet's right corner, or the tip, pulled left and right.
    Culet,
}

impl Handle {
    /// All handles, from table to culet.
    pub const ALL: [Self; 8] = [
        Self::TableEdge,
        Self::CrownHeight,
        Self::CrownAngle,
        Self::GirdleUpper,
        Self::GirdleLower,
        Self::PavilionAngle,
        Self::PavilionDepth,
        Self::Culet,
    ];

    /// Returns the proportion that the handle changes.
    pub fn quantity(self) -> Quantity {
        match self {
            Self::TableEdge => Quantity::Table,
            Self::CrownHeight => Quantity::CrownHeight,
            Self::CrownAngle => Quantity::CrownAngle,
            Self::GirdleUpper | Self::GirdleLower => Quantity::Girdle,
            Self::PavilionAngle => Quantity::PavilionAngle,
            Self::PavilionDepth => Quantity::PavilionDepth,
            Self::Culet => Quantity::Culet,
        }
    }

    /// Returns the name of the handle.
    pub fn name(self) -> &'static str {
        match self {
            Self::TableEdge => "Table edge",
            Self::GirdleUpper => "Girdle, upper edge",
            Self::GirdleLower => "Girdle, lower edge",
            other => other.quantity().name(),
        }
    }

    /// Returns a hint on how to pull the handle.
    pub fn hint(self) -> &'static str {
        match self {
            Self::TableEdge | Self::Culet => "drag left or right",
            Self::CrownAngle => "drag to tilt bezels",
            Self::PavilionAngle => "drag to tilt mains",
            Self::PavilionDepth => "drag up or down · sideways: culet",
            Self::CrownHeight | Self::GirdleUpper | Self::GirdleLower => "drag up or down",
        }
    }

    /// Returns the shape of the pointer over the handle.
    pub fn cursor(self) -> CursorIcon {
        match self {
            Self::TableEdge | Self::Culet => CursorIcon::ResizeHorizontal,
            Self::CrownAngle => CursorIcon::ResizeNeSw,
            Self::PavilionAngle => CursorIcon::ResizeNwSe,
            _ => CursorIcon::ResizeVertical,
        }
    }

    /// Whether the handle's value grows when the handle is moved down.
    pub fn grows_downward(self) -> bool {
        matches!(self, Self::GirdleLower | Self::PavilionAngle | Self::PavilionDepth)
    }

    /// Returns the place of the handle, in girdle radii.
    pub fn at(self, given: &RoundBrilliant, derived: &Derived) -> DVec2 {
        let (table, culet) = (given.table / 100.0, given.culet / 100.0);
        let (crown, girdle) = (derived.crown_height / 50.0, given.girdle_thickness / 50.0);
        let lowest = crown - derived.total_depth / 50.0;
        match self {
            Self::TableEdge => DVec2::new(table, crown),
            Self::CrownHeight => DVec2::new(0.0, crown),
            Self::CrownAngle => DVec2::new((1.0 + table) / 2.0, crown / 2.0),
            Self::GirdleUpper => DVec2::new(-1.0, 0.0),
            Self::GirdleLower => DVec2::new(1.0, -girdle),
            Self::PavilionAngle => DVec2::new((1.0 + culet) / 2.0, (lowest - girdle) / 2.0),
            Self::PavilionDepth | Self::Culet => DVec2::new(culet, lowest),
        }
    }

    /// Returns the proportions after the handle has been pulled by `travel` (girdle radii) from its place on `start`. The
    /// held one of each pair stays held; a value that would cross a limit stays just inside it.
    pub fn dragged(self, start: &RoundBrilliant, travel: DVec2, grid: ValueGrid) -> RoundBrilliant {
        let Ok(derived) = start.derived() else { return *start };
        let (from, wanted) = (self.quantity().of(start, &derived), self.wanted(start, &derived, travel));
        // Merely touching a handle does not move a value that lies between two steps.
        let moved = (wanted - from).abs() >= 0.5 * grid.step();
        if moved { self.quantity().toward(start, wanted, grid) } else { *start }
    }

    /// Returns the value that puts the handle where it has been pulled to, without regard to limits.
    fn wanted(self, start: &RoundBrilliant, derived: &Derived, travel: DVec2) -> f64 {
        let from = self.quantity().of(start, derived);
        let at = self.at(start, derived) + travel;
        match self {
            Self::TableEdge => 100.0 * at.x,
            Self::CrownHeight => from + 50.0 * travel.y,
            Self::GirdleUpper => from + 50.0 * travel.y,
            Self::GirdleLower | Self::PavilionDepth => from - 50.0 * travel.y,
            Self::CrownAngle => at.y.atan2(1.0 - at.x).to_degrees(),
            Self::PavilionAngle => (-at.y - start.girdle_thickness / 50.0).atan2(1.0 - at.x).to_degrees(),
            // A pointed culet can be pulled open to either side.
            Self::Culet if start.culet == 0.0 => 100.0 * travel.x.abs(),
            Self::Culet => 100.0 * at.x,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::sight::{ProfileBox, ProfileProjection};
    use super::*;
    use crate::cut::TOLKOWSKY;
    use crate::cut::{Crown, Pavilion, strategy};
    use egui::{Pos2, Rect, Vec2, vec2};
    use proptest::prelude::*;

    /// Returns a projection of 200 points to a girdle radius.
    fn sight() -> ProfileProjection {
        let extent = ProfileBox { low: DVec2::splat(-1.0), high: DVec2::splat(1.0) };
        ProfileProjection::fitting(extent, Rect::from_min_size(Pos2::ZERO, Vec2::splat(400.0)))
    }

    fn value(handle: Handle, given: &RoundBrilliant) -> f64 {
        handle.quantity().of(given, &given.derived().unwrap())
    }

    #[test]
    fn pulled_by_so_many_points_each_handle_gives_what_they_are_worth() {
        let derived = TOLKOWSKY.derived().unwrap();
        let (crown, pavilion) =
            (Crown::Height(derived.crown_height), Pavilion::Depth(derived.pavilion_depth));
        let by_lengths = RoundBrilliant { crown, pavilion, ..TOLKOWSKY };
        for (handle, pull, expected) in [
            (Handle::TableEdge, vec2(20.0, 7.0), 63.0),
            (Handle::CrownHeight, vec2(5.0, -10.0), 18.7),
            (Handle::CrownAngle, vec2(0.0, -10.0), 42.0),
            (Handle::GirdleUpper, vec2(3.0, -2.0), 3.5),
            (Handle::GirdleLower, vec2(3.0, 2.0), 3.5),
            (Handle::PavilionAngle, vec2(0.0, 10.0), 43.9),
            (Handle::PavilionDepth, vec2(0.0, 10.0), 45.6),
            (Handle::Culet, vec2(10.0, 0.0), 5.0),
            (Handle::Culet, vec2(-10.0, 0.0), 5.0),
        ] {
            for given in [TOLKOWSKY, by_lengths] {
                let new = handle.dragged(&given, sight().travel(pull), ValueGrid::COARSE);
                assert!((value(handle, &new) - expected).abs() < 1e-9, "{handle:?}: {new:?}");
            }
        }
    }

    #[test]
    fn a_culet_is_closed_by_pulling_it_to_the_axis_and_no_further() {
        let open = RoundBrilliant { culet: 4.0, ..TOLKOWSKY };
        for (pull, expected) in [(-3.0, 2.5), (-8.0, 0.0), (-50.0, 0.0)] {
            let new = Handle::Culet.dragged(&open, sight().travel(vec2(pull, 0.0)), ValueGrid::COARSE);
            assert_eq!(new.culet, expected);
        }
    }

    #[test]
    fn a_handle_that_is_only_touched_changes_nothing() {
        let odd = RoundBrilliant { table: 53.037, crown: Crown::Angle(34.512), ..TOLKOWSKY };
        for handle in Handle::ALL {
            let trembling = DVec2::new(2e-5, -2e-5);
            assert_eq!(handle.dragged(&odd, trembling, ValueGrid::COARSE), odd, "{handle:?}");
        }
    }

    /// Returns how far a stone's value is from the one that a pull requests, in percent or degrees.
    fn off(handle: Handle, new: &RoundBrilliant, start: &RoundBrilliant, travel: DVec2) -> f64 {
        let wanted = handle.wanted(start, &start.derived().unwrap(), travel);
        (value(handle, new) - wanted).abs()
    }

    fn pull() -> impl Strategy<Value = DVec2> {
        (-0.5..0.5, -0.5..0.5).prop_map(|(x, y)| DVec2::new(x, y))
    }

    proptest! {
        #[test]
        fn however_it_is_pulled_a_stone_stays_possible_and_what_is_held_stays_held(
            given in strategy::proportions(), travel in pull(), k in 0..Handle::ALL.len(),
        ) {
            let handle = Handle::ALL[k];
            let new = handle.dragged(&given, travel, ValueGrid::COARSE);
            prop_assert!(new.derived().is_ok());
            for other in Handle::ALL {
                prop_assert_eq!(other.quantity().follows(&new), other.quantity().follows(&given));
            }
            let step = 10.0 * value(handle, &new);
            prop_assert!(new == given || (step - step.round()).abs() < 1e-6, "{} {}", handle.name(), step / 10.0);
        }

        #[test]
        fn a_handle_stays_under_the_hand_or_at_its_limit(
            given in strategy::proportions(), travel in pull(), k in 0..Handle::ALL.len(),
        ) {
            let handle = Handle::ALL[k];
            let new = handle.dragged(&given, travel, ValueGrid::COARSE);
            let further = |grid| {
                let derived = given.derived().unwrap();
                let way = (handle.wanted(&given, &derived, travel) - value(handle, &new)).signum();
                handle.quantity().stepped(&new, way as i32, grid)
            };
            prop_assert!(off(handle, &new, &given, travel) <= 0.05 + 1e-6 || further(ValueGrid::COARSE) == new);
        }

        #[test]
        fn pulled_there_and_back_a_stone_is_what_it_was(
            given in strategy::proportions(), travel in pull(), k in 0..Handle::ALL.len(),
        ) {
            let handle = Handle::ALL[k];
            let there = handle.dragged(&given, travel, ValueGrid::COARSE);
            let back = handle.dragged(&given, travel - travel, ValueGrid::COARSE);
            prop_assert!(there.derived().is_ok());
            prop_assert_eq!(back, given);
        }
    }
}
