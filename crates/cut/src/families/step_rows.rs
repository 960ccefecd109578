//! Rows that the tables of step cuts and of chevron cuts have in common. `PLACE` is the place of the number in the table.

use super::super::family::BoundAt::Fixed;
use super::super::family::{Bound, Proportion};
use super::super::family_cut::number;
use super::rows;
use brillianteer_base::Unit;

/// Returns a row for a number of rows, chevrons or styles, whose whole possible range is usual.
pub const fn count<const PLACE: usize>(
    key: &'static str,
    name: &'static str,
    range: [f64; 2],
    ends: [&'static str; 2],
) -> Proportion {
    Proportion {
        key,
        name,
        unit: Unit::Count,
        usual: range,
        step: 1.0,
        speed: 0.02,
        least: Bound::at(Fixed(range[0]), ends[0]),
        most: Bound::at(Fixed(range[1]), ends[1]),
        ..number::<PLACE>()
    }
}

/// Returns the row for the length that a corner cuts off each side of the outline.
pub const fn corner<const PLACE: usize>(usual: [f64; 2]) -> Proportion {
    Proportion {
        meaning: "The length that a corner cuts off each side, in percent of the width of the stone.",
        least: Bound::before(Fixed(0.0), "where the corner would be sharp"),
        most: Bound::before(Fixed(50.0), "where no side would be left between two corners"),
        ..rows::of_width::<PLACE>("corner", "Corner", usual)
    }
}

/// Returns the row for the number of rows of the crown.
pub const fn crown_rows<const PLACE: usize>() -> Proportion {
    Proportion {
        meaning: "The number of rows of facets around the crown, from the girdle to the table.",
        ..count::<PLACE>("crown_rows", "Crown rows", [1.0, 5.0], ROWS)
    }
}

/// Returns the row for the slope of the crown as a whole.
pub const fn crown<const PLACE: usize>(usual: [f64; 2]) -> Proportion {
    Proportion {
        meaning: "The slope of the crown as a whole, from the girdle's to the table's edge in the middle of a side.",
        ..rows::slope::<PLACE>("crown_angle", "Crown angle", usual)
    }
}

/// Returns the row for the angle between neighbouring rows of the crown.
pub const fn crown_step<const PLACE: usize>() -> Proportion {
    Proportion {
        meaning: "The angle by which each row of the crown is steeper than the next row above it.",
        ..step::<PLACE>("crown_step", "Crown step", [3.0, 15.0])
    }
}

/// Returns the row for the number of rows of the pavilion.
pub const fn pavilion_rows<const PLACE: usize>() -> Proportion {
    Proportion {
        meaning: "The number of rows of facets around the pavilion, from the girdle to its lowest line or point.",
        ..count::<PLACE>("pavilion_rows", "Pavilion rows", [1.0, 5.0], ROWS)
    }
}

/// Returns the row for the slope of the pavilion as a whole.
pub const fn pavilion<const PLACE: usize>(usual: [f64; 2]) -> Proportion {
    Proportion {
        meaning: "The slope of the pavilion as a whole, from the girdle to its lowest line or point, in the middle of a side.",
        ..rows::slope::<PLACE>("pavilion_angle", "Pavilion angle", usual)
    }
}

/// Returns the row for the angle between neighbouring rows of the pavilion.
pub const fn pavilion_step<const PLACE: usize>() -> Proportion {
    Proportion {
        meaning: "The angle by which each row of the pavilion is steeper than the next row below it.",
        ..step::<PLACE>("pavilion_step", "Pavilion step", [3.0, 12.0])
    }
}

/// Returns the row for the length of the keel, the pavilion's lowest line.
pub const fn keel<const PLACE: usize>() -> Proportion {
    Proportion {
        of: "of the length of a keel between ends as steep as the sides",
        meaning: "The length of the keel, the pavilion's lowest line. At 100 % the ends are as steep as the sides; a \
                  shorter keel makes them flatter, a longer one steeper, and at 0 % the pavilion ends in a point.",
        least: Bound::at(Fixed(0.0), "a point"),
        most: Bound::at(Fixed(150.0), "the longest keel allowed"),
        nothing: Some("a point"),
        ..rows::of_width::<PLACE>("keel", "Keel", [70.0, 120.0])
    }
}

/// Returns a row for the angle between neighbouring rows, in degrees.
pub const fn step<const PLACE: usize>(key: &'static str, name: &'static str, usual: [f64; 2]) -> Proportion {
    Proportion {
        key,
        name,
        unit: Unit::Degrees,
        of: "between neighbouring rows",
        usual,
        least: Bound::before(Fixed(0.0), "where neighbouring rows would lie in one plane"),
        most: Bound::at(Fixed(40.0), "the greatest step allowed"),
        ..number::<PLACE>()
    }
}

const ROWS: [&str; 2] = ["a single row", "the most rows of any step cut"];
