//! The editor without its window: its state and what can be done to it, the tasks that take time, and the thread that takes
//! pictures and figures.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

mod described;
pub mod liquid;
pub mod model;
pub mod pixels;
pub mod shows;
pub mod studio;
pub mod tasks;
pub mod urgency;
pub mod value_grid;

// Files that tests of several crates share.
#[cfg(test)]
#[path = "../../../tests/common/solids.rs"]
mod solids;
