//! Rows that the tables of several families have in common. `PLACE` is the place of the number in the table.

use super::super::Cut;
use super::super::family::BoundAt::Fixed;
use super::super::family::{Bound, Proportion};
use super::super::family_cut::number;
use brillianteer_base::Unit;

/// Returns the row for the ratio of the stone's length, along y, to its width, along x: 1 for a square or round outline, below
/// 1 for one that is wider than long. What is measured on a stone as its length to width is never below 1.
pub const fn length_to_width<const PLACE: usize>(usual: [f64; 2]) -> Proportion {
    Proportion {
        key: "length_to_width",
        name: "Length to width",
        unit: Unit::Ratio,
        of: "the length as a multiple of the width",
        meaning: "The length of the outline, upward in pictures, as a multiple of its width; below 1 it is wider than long.",
        usual,
        step: 0.01,
        speed: 0.002,
        least: Bound::at(Fixed(0.5), "the shortest outline allowed"),
        most: Bound::at(Fixed(5.0), "the longest outline allowed"),
        ..number::<PLACE>()
    }
}

/// Returns a row for a length in percent of the stone's width.
pub const fn of_width<const PLACE: usize>(
    key: &'static str,
    name: &'static str,
    usual: [f64; 2],
) -> Proportion {
    Proportion { key, name, of: "of the width", usual, ..number::<PLACE>() }
}

/// Returns a row for an angle from the girdle plane, 2 to 88 degrees.
pub const fn slope<const PLACE: usize>(key: &'static str, name: &'static str, usual: [f64; 2]) -> Proportion {
    Proportion {
        key,
        name,
        unit: Unit::Degrees,
        of: "from the girdle plane",
        usual,
        least: Bound::at(Fixed(2.0), "the flattest facet allowed"),
        most: Bound::at(Fixed(88.0), "the steepest facet allowed"),
        ..number::<PLACE>()
    }
}

/// Returns the row for the table's width.
pub const fn table<const PLACE: usize>(usual: [f64; 2]) -> Proportion {
    Proportion {
        meaning: "The width of the flat facet on top, in percent of the width of the stone.",
        least: Bound::at(Fixed(5.0), "the smallest table allowed"),
        most: Bound::at(Fixed(95.0), "the largest table allowed"),
        ..of_width::<PLACE>("table", "Table", usual)
    }
}

/// Returns the row for the depth of the whole stone. The depth follows from the other numbers; setting it changes
/// those of the pavilion.
pub const fn total_depth(usual: [f64; 2], moves: &'static [&'static str]) -> Proportion {
    Proportion {
        key: "total_depth",
        name: "Total depth",
        of: "of the width",
        meaning: "The height of the whole stone. Setting it scales the pavilion: the tangents of its angles change by one \
                  factor; crown and girdle stay.",
        usual,
        moves,
        get: |cut| match cut {
            // Half the diameter is 1.
            Cut::Family(cut) => cut.family.depth.map_or(f64::NAN, |depth| 50.0 * depth(cut)),
            _ => f64::NAN,
        },
        ..Proportion::BLANK
    }
}

/// Returns the row for the depth of a step cut.
pub const fn step_depth(usual: [f64; 2]) -> Proportion {
    Proportion {
        meaning: "The height of the whole stone. Setting it changes the slope of the pavilion as a whole; the steps between \
                  its rows, crown and girdle stay.",
        ..total_depth(usual, &["pavilion_angle"])
    }
}

/// Returns the row for the depth of a cut whose pavilion is given by its depth.
pub const fn chevron_depth(usual: [f64; 2]) -> Proportion {
    Proportion {
        meaning: "The height of the whole stone. Setting it changes the depth of the pavilion; the steps between its rows, \
                  crown and girdle stay.",
        ..total_depth(usual, &["pavilion_depth"])
    }
}

/// Returns the row for the girdle's thickness.
pub const fn girdle_thickness<const PLACE: usize>() -> Proportion {
    Proportion {
        meaning: "The thickness of the girdle where it is greatest, in percent of the width of the stone.",
        least: Bound::at(Fixed(0.0), "a knife edge all round"),
        most: Bound::at(Fixed(50.0), "the thickest girdle allowed"),
        ..of_width::<PLACE>("girdle_thickness", "Girdle thickness", [0.5, 8.0])
    }
}

/// Returns the row for the culet's size.
pub const fn culet<const PLACE: usize>() -> Proportion {
    Proportion {
        meaning: "The size of the culet, the small facet at the bottom, as a part of the stone's size; 0 is a point.",
        least: Bound::at(Fixed(0.0), "a point"),
        most: Bound::at(Fixed(60.0), "the largest culet allowed"),
        nothing: Some("a point"),
        ..of_width::<PLACE>("culet", "Culet", [0.0, 10.0])
    }
}

/// Returns a row for a part of a way, in percent.
pub const fn part<const PLACE: usize>(
    key: &'static str,
    name: &'static str,
    of: &'static str,
    usual: [f64; 2],
) -> Proportion {
    Proportion {
        of,
        least: Bound::before(Fixed(0.0), "where the facets would vanish"),
        most: Bound::before(Fixed(100.0), "where the facets would stand upright"),
        ..of_width::<PLACE>(key, name, usual)
    }
}

/// Returns a row for a count, whose range is fixed. `ends` are the reasons for its least and its greatest value.
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
        least: Bound::at(Fixed(range[0]), ends[0]),
        most: Bound::at(Fixed(range[1]), ends[1]),
        ..number::<PLACE>()
    }
}

/// Returns the row for the number of facets in each row of a cut whose rows alternate by half a step.
pub const fn facets_per_row<const PLACE: usize>(range: [f64; 2]) -> Proportion {
    Proportion {
        meaning: "The number of facets in each row. Each row is turned by half a step against the next.",
        ..count::<PLACE>(
            "facets",
            "Facets a row",
            range,
            ["the fewest facets a row", "the most facets a row"],
        )
    }
}

/// Returns the row for the number of rows on one side of the girdle.
pub const fn row_count<const PLACE: usize>(
    key: &'static str,
    name: &'static str,
    range: [f64; 2],
) -> Proportion {
    Proportion {
        meaning: "The number of rows of equal facets between the girdle and the end of this side.",
        ..count::<PLACE>(key, name, range, ["the fewest rows", "the most rows allowed"])
    }
}

/// Returns the row for the size of the star that the last row forms around the point in which a side ends.
pub const fn rosette<const PLACE: usize>(
    key: &'static str,
    name: &'static str,
    usual: [f64; 2],
) -> Proportion {
    Proportion {
        meaning: "The ring of corners in the last row, around the point in which it ends: a larger one leaves less room for \
                  the other rows, whose slopes then differ more.",
        least: Bound::at(Fixed(2.0), "the smallest rosette allowed"),
        most: Bound::at(Fixed(90.0), "the largest rosette allowed"),
        ..of_width::<PLACE>(key, name, usual)
    }
}
