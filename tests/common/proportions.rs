//! Random valid proportions of round brilliants, over wider ranges than real stones have.
#![allow(dead_code, reason = "each test uses its part")]

use brillianteer_cut::{Crown, LowerHalf, Pavilion, RoundBrilliant, least_star_length};
use proptest::prelude::*;

fn crown() -> impl Strategy<Value = Crown> {
    prop_oneof![(2.5..65.0).prop_map(Crown::Angle), (4.0..100.0).prop_map(Crown::Height)]
}

fn pavilion() -> impl Strategy<Value = Pavilion> {
    prop_oneof![(2.5..65.0).prop_map(Pavilion::Angle), (4.0..75.0).prop_map(Pavilion::Depth)]
}

fn lower_half() -> impl Strategy<Value = LowerHalf> {
    prop_oneof![(3.0..99.0).prop_map(LowerHalf::Radial), (10.5..99.0).prop_map(LowerHalf::Vertical)]
}

/// Proportions with a table of up to 85 %. Larger tables need stars that reach more than 90 % of the way to the girdle.
pub fn proportions() -> impl Strategy<Value = RoundBrilliant> {
    let shape = (5.0..85.0, crown(), pavilion(), 0.01..0.99, lower_half());
    (shape, 0.0..8.0, 16_u32..=128, prop_oneof![Just(0.0), 0.1..90.0]).prop_map(
        |((table, crown, pavilion, star, lower_half), girdle_thickness, girdle_facets, culet)| {
            let least = least_star_length(table);
            let star_length = least + (100.0 - least) * star;
            RoundBrilliant {
                table,
                crown,
                pavilion,
                star_length,
                lower_half,
                girdle_thickness,
                girdle_facets,
                culet,
            }
        },
    )
}
