//! Tests of the library from outside: laws of light, tracers against each other, files that others made, the order of the
//! source. They are one program, because each further program would link the library and its dependencies again:
//! `cargo test --release --test library laws` runs those of one file.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::print_stderr,
    clippy::too_many_lines,
    reason = "a test fails by it, says what it skips, or lists many cases"
)]

mod card_limits;
mod class_estimates;
#[path = "../common/mod.rs"]
mod common;
mod corpus;
mod corpus_gem;
mod corpus_meets;
mod cutting;
mod estimates;
mod fields;
mod floors;
mod footprint;
mod foreign_maps;
mod fuzz;
mod glass;
mod hues;
mod laws;
mod licences;
mod light;
mod measures;
mod mesh_noise;
mod mirror;
mod overlapping;
mod overlay;
mod packets;
mod patterns;
mod polytope;
mod reference;
mod refraction;
mod scans;
mod searching;
mod sharing;
mod sheet;
mod slopes_of_tiers;
mod stones;
mod tracers;
mod triangles;
