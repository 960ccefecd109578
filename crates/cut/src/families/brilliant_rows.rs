//! Rows that the tables of all brilliants on an outline have after their table: crown angle, pavilion angle, star
//! length and lower halves. Girdle thickness and culet follow. `PLACE` is the place of the number in the table.

use super::super::family::BoundAt::Fixed;
use super::super::family::{Bound, Proportion};
use super::super::family_cut::number;
use super::rows;
use brillianteer_base::Unit;

/// Returns the row for the angle of the bezels at the sides.
pub const fn crown_angle<const PLACE: usize>(usual: [f64; 2]) -> Proportion {
    Proportion {
        meaning: "The angle between the bezels at the sides and the girdle plane. Bezels farther from the middle are flatter.",
        ..rows::slope::<PLACE>("crown_angle", "Crown angle", usual)
    }
}

/// Returns the row for the angle of the mains at the sides.
pub const fn pavilion_angle<const PLACE: usize>(usual: [f64; 2]) -> Proportion {
    Proportion {
        meaning: "The angle between the mains at the sides and the girdle plane. Mains farther from the middle are flatter.",
        ..rows::slope::<PLACE>("pavilion_angle", "Pavilion angle", usual)
    }
}

/// Returns the row for the reach of the stars.
pub const fn star_length<const PLACE: usize>() -> Proportion {
    Proportion {
        meaning: "The reach of the stars from the table's edge to the girdle, seen from above.",
        ..rows::part::<PLACE>(
            "star_length",
            "Star length",
            "of the way from the table's edge to the girdle",
            [35.0, 65.0],
        )
    }
}

/// Returns the row for the reach of the lower halves.
pub const fn lower_half_length<const PLACE: usize>() -> Proportion {
    Proportion {
        meaning: "The reach of the lower halves from the girdle to the middle, seen from below.",
        ..rows::part::<PLACE>(
            "lower_half_length",
            "Lower halves",
            "of the way from the girdle to the middle",
            [50.0, 90.0],
        )
    }
}

/// Returns the row for the number of mains in a quarter of the outline, so that the stone is symmetric about both
/// axes.
pub const fn mains_per_quarter<const PLACE: usize>() -> Proportion {
    Proportion {
        key: "mains_per_quarter",
        name: "Mains per quarter",
        unit: Unit::Count,
        of: "in a quarter of the outline",
        meaning: "The number of mains, and of bezels, in a quarter of the outline: 2 make eight mains.",
        usual: [2.0, 4.0],
        step: 1.0,
        speed: 0.02,
        least: Bound::at(Fixed(2.0), "the fewest mains that leave the girdle whole"),
        most: Bound::at(Fixed(4.0), "the most mains allowed"),
        default: Some(2.0),
        ..number::<PLACE>()
    }
}

/// Returns the row for the fullness of the curves that run to a point.
pub const fn fullness<const PLACE: usize>() -> Proportion {
    Proportion {
        key: "fullness",
        name: "Fullness",
        of: "of the fullness of arcs of a circle",
        meaning: "The fullness of the sides between the widest place and the point: 100 makes arcs of a circle, and less is slimmer.",
        usual: [85.0, 115.0],
        least: Bound::at(Fixed(40.0), "where the sides are nearly straight"),
        most: Bound::at(Fixed(180.0), "where the point is nearly flat"),
        ..number::<PLACE>()
    }
}
