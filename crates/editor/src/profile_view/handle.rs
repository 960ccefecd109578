//! The handles of a profile: which proportion each changes, where it lies, and which value a pull requests.
//!
//! Places are in girdle radii in the profile's plane: x to the right of the axis, y up from the girdle's upper edge.

use brillianteer_cut::ProfileHandle::{
    self, CrownSlope, CuletEdge, GirdleLower, GirdleUpper, PavilionSlope, PavilionTip, TableEdge, TableLine,
};
use brillianteer_cut::{Cut, Proportion};
use brillianteer_picture::profile::{Dimensions, Span};
use brillianteer_session::value_grid::ValueGrid;
use egui::CursorIcon;
use glam::DVec2;

/// A part of the profile, and the proportion that it is pulled to change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Handle {
    pub part: ProfileHandle,
    pub row: &'static Proportion,
}

impl Handle {
    /// Returns the handle at a part of a cut's profile; `None` where the cut's family has none there.
    pub fn of(cut: &Cut, part: ProfileHandle) -> Option<Self> {
        Some(Self { part, row: cut.handled_by(part)? })
    }

    /// Returns the name of the handle.
    pub fn name(self) -> &'static str {
        match self.part {
            TableEdge => "Table edge",
            GirdleUpper => "Girdle, upper edge",
            GirdleLower => "Girdle, lower edge",
            _ => self.row.name,
        }
    }

    /// Returns a hint on how to pull the handle.
    pub fn hint(self) -> &'static str {
        match self.part {
            TableEdge | CuletEdge => "drag left or right",
            CrownSlope => "drag to tilt bezels",
            PavilionSlope => "drag to tilt mains",
            PavilionTip => "drag up or down, sideways for the culet",
            TableLine | GirdleUpper | GirdleLower => "drag up or down",
        }
    }

    /// Returns the shape of the pointer over the handle.
    pub fn cursor(self) -> CursorIcon {
        match self.part {
            TableEdge | CuletEdge => CursorIcon::ResizeHorizontal,
            CrownSlope => CursorIcon::ResizeNeSw,
            PavilionSlope => CursorIcon::ResizeNwSe,
            _ => CursorIcon::ResizeVertical,
        }
    }

    /// Returns whether the handle lies on the crown, so that there is room for a hint below it.
    pub fn is_on_crown(self) -> bool {
        matches!(self.part, TableEdge | TableLine | CrownSlope)
    }

    /// Returns whether the handle's value grows when the handle is moved down.
    pub fn grows_downward(self) -> bool {
        matches!(self.part, GirdleLower | PavilionSlope | PavilionTip)
    }

    /// Returns the place of the handle, in girdle radii; `None` where the stone has no such part.
    pub fn at(self, dimensions: &Dimensions) -> Option<DVec2> {
        let Dimensions { width, total, culet, table, girdle, .. } = dimensions;
        Some(match self.part {
            TableEdge => DVec2::new((*table)?.to, total.from),
            TableLine => DVec2::new(0.0, total.from),
            CrownSlope => DVec2::new((width.to + (*table)?.to) / 2.0, (total.from + (*girdle)?.from) / 2.0),
            GirdleUpper => DVec2::new(width.from, (*girdle)?.from),
            GirdleLower => DVec2::new(width.to, (*girdle)?.to),
            PavilionSlope => DVec2::new((width.to + culet.to) / 2.0, (total.to + (*girdle)?.to) / 2.0),
            PavilionTip | CuletEdge => DVec2::new(culet.to, total.to),
        })
    }

    /// Returns a cut after the handle has been pulled by `travel` (girdle radii) from its place on `start`, whose
    /// profile has these dimensions. Of each pair, the value that is held stays; a value that would cross a limit
    /// stops just inside it.
    pub fn dragged(self, start: &Cut, dimensions: &Dimensions, travel: DVec2, grid: ValueGrid) -> Cut {
        let from = (self.row.get)(start);
        match self.wanted(from, dimensions, travel) {
            // Merely touching a handle does not move a value that lies between two steps.
            Some(wanted) if (wanted - from).abs() >= 0.5 * grid.step() => {
                grid.toward(self.row, start, wanted)
            }
            _ => start.clone(),
        }
    }

    /// Returns the value that puts the handle where it has been pulled to, without regard to limits; `from` is the value
    /// at the start.
    fn wanted(self, from: f64, dimensions: &Dimensions, travel: DVec2) -> Option<f64> {
        let Dimensions { width, girdle, .. } = dimensions;
        let Span { from: upper, to: lower, .. } = (*girdle)?;
        let at = self.at(dimensions)? + travel;
        let percent = percent_of_radius(dimensions);
        Some(match self.part {
            TableLine | GirdleUpper => from + percent * travel.y,
            GirdleLower | PavilionTip => from - percent * travel.y,
            CrownSlope => (at.y - upper).atan2(width.to - at.x).to_degrees(),
            PavilionSlope => (lower - at.y).atan2(width.to - at.x).to_degrees(),
            // A pointed culet can be pulled open to either side.
            CuletEdge if from == 0.0 => 2.0 * percent * travel.x.abs(),
            TableEdge | CuletEdge => 2.0 * percent * at.x,
        })
    }
}

/// Returns the percentage that a length of one girdle radius is of the diameter.
pub fn percent_of_radius(dimensions: &Dimensions) -> f64 {
    dimensions.width.percent / dimensions.width.length()
}

#[cfg(test)]
mod tests {
    use super::super::sight::{ProfileBox, ProfileProjection};
    use super::*;
    use crate::random;
    use brillianteer_cut::{Crown, Pavilion, RoundBrilliant, TOLKOWSKY};
    use egui::{Pos2, Rect, Vec2, vec2};
    use proptest::prelude::*;

    /// Returns a projection of 200 points to a girdle radius.
    fn sight() -> ProfileProjection {
        let extent = ProfileBox { low: DVec2::splat(-1.0), high: DVec2::splat(1.0) };
        ProfileProjection::fitting(extent, Rect::from_min_size(Pos2::ZERO, Vec2::splat(400.0)))
    }

    fn handle(part: ProfileHandle) -> Handle {
        Handle::of(&Cut::RoundBrilliant(TOLKOWSKY), part).unwrap()
    }

    fn value(handle: Handle, given: &RoundBrilliant) -> f64 {
        (handle.row.get)(&Cut::RoundBrilliant(*given))
    }

    fn dimensions(given: &RoundBrilliant) -> Dimensions {
        Dimensions::of_brilliant(given, &given.derived().unwrap())
    }

    fn dragged(handle: Handle, given: &RoundBrilliant, travel: DVec2) -> RoundBrilliant {
        let cut = Cut::RoundBrilliant(*given);
        *handle.dragged(&cut, &dimensions(given), travel, ValueGrid::COARSE).brilliant().unwrap()
    }

    #[test]
    fn pulled_by_so_many_points_each_handle_gives_what_they_are_worth() {
        let derived = TOLKOWSKY.derived().unwrap();
        let (crown, pavilion) =
            (Crown::Height(derived.crown_height), Pavilion::Depth(derived.pavilion_depth));
        let by_lengths = RoundBrilliant { crown, pavilion, ..TOLKOWSKY };
        for (part, pull, expected) in [
            (TableEdge, vec2(20.0, 7.0), 63.0),
            (TableLine, vec2(5.0, -10.0), 18.7),
            (CrownSlope, vec2(0.0, -10.0), 42.0),
            (GirdleUpper, vec2(3.0, -2.0), 3.5),
            (GirdleLower, vec2(3.0, 2.0), 3.5),
            (PavilionSlope, vec2(0.0, 10.0), 43.9),
            (PavilionTip, vec2(0.0, 10.0), 45.6),
            (CuletEdge, vec2(10.0, 0.0), 5.0),
            (CuletEdge, vec2(-10.0, 0.0), 5.0),
        ] {
            for given in [TOLKOWSKY, by_lengths] {
                let new = dragged(handle(part), &given, sight().travel(pull));
                assert!((value(handle(part), &new) - expected).abs() < 1e-9, "{part:?}: {new:?}");
            }
        }
    }

    #[test]
    fn a_culet_is_closed_by_pulling_it_to_the_axis_and_no_further() {
        let open = RoundBrilliant { culet: 4.0, ..TOLKOWSKY };
        for (pull, expected) in [(-3.0, 2.5), (-8.0, 0.0), (-50.0, 0.0)] {
            let new = dragged(handle(CuletEdge), &open, sight().travel(vec2(pull, 0.0)));
            assert_eq!(new.culet, expected);
        }
    }

    #[test]
    fn a_handle_that_is_only_touched_changes_nothing() {
        let odd = RoundBrilliant { table: 53.037, crown: Crown::Angle(34.512), ..TOLKOWSKY };
        for part in ProfileHandle::ALL {
            let trembling = DVec2::new(2e-5, -2e-5);
            assert_eq!(dragged(handle(part), &odd, trembling), odd, "{part:?}");
        }
    }

    /// Returns the difference of a stone's value from the value that a pull requests, in percent or degrees.
    fn off(handle: Handle, new: &RoundBrilliant, start: &RoundBrilliant, travel: DVec2) -> f64 {
        let wanted = handle.wanted(value(handle, start), &dimensions(start), travel).unwrap();
        (value(handle, new) - wanted).abs()
    }

    fn pull() -> impl Strategy<Value = DVec2> {
        (-0.5..0.5, -0.5..0.5).prop_map(|(x, y)| DVec2::new(x, y))
    }

    proptest! {
        #[test]
        fn however_it_is_pulled_a_stone_stays_possible_and_what_is_held_stays_held(
            given in random::proportions(), travel in pull(), k in 0..ProfileHandle::ALL.len(),
        ) {
            let handle = handle(ProfileHandle::ALL[k]);
            let new = dragged(handle, &given, travel);
            prop_assert!(new.derived().is_ok());
            let [now, before] = [new, given].map(Cut::RoundBrilliant);
            for row in now.proportions() {
                prop_assert_eq!((row.is_given)(&now), (row.is_given)(&before));
            }
            let step = 10.0 * value(handle, &new);
            prop_assert!(new == given || (step - step.round()).abs() < 1e-6, "{} {}", handle.name(), step / 10.0);
        }

        #[test]
        fn a_handle_stays_under_the_hand_or_at_its_limit(
            given in random::proportions(), travel in pull(), k in 0..ProfileHandle::ALL.len(),
        ) {
            let handle = handle(ProfileHandle::ALL[k]);
            let new = dragged(handle, &given, travel);
            let cut = Cut::RoundBrilliant(new);
            let wanted = handle.wanted(value(handle, &given), &dimensions(&given), travel).unwrap();
            let way = (wanted - value(handle, &new)).signum();
            let further = ValueGrid::COARSE.stepped(handle.row, &cut, way as i32);
            prop_assert!(off(handle, &new, &given, travel) <= 0.05 + 1e-6 || further == cut);
        }

        #[test]
        fn pulled_there_and_back_a_stone_is_what_it_was(
            given in random::proportions(), travel in pull(), k in 0..ProfileHandle::ALL.len(),
        ) {
            let handle = handle(ProfileHandle::ALL[k]);
            let there = dragged(handle, &given, travel);
            let back = dragged(handle, &given, travel - travel);
            prop_assert!(there.derived().is_ok());
            prop_assert_eq!(back, given);
        }
    }
}
