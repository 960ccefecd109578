//! What every room shares: work that can be watched and stopped, faults in what people wrote, with their places, values by
//! name, names that are nearly what was asked for, and numbers that people set.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

mod at_once;
mod by_name;
mod fault;
mod nearest;
mod number_row;
mod unit;
mod watch;

pub use at_once::at_once;
pub use by_name::ByName;
pub use fault::{Failure, Fault, FileError, NameOrFileError};
pub use nearest::{nearest, slips};
pub use number_row::{NumberError, NumberRow};
pub use unit::Unit;
pub use watch::{Stopped, Watch, go_on, unwatched};
