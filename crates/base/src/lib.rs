//! What every room shares: work that can be watched and stopped, faults in what people wrote, with their places, values by
//! name, and names that are nearly what was asked for.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

mod at_once;
mod by_name;
mod fault;
mod nearest;
mod watch;

pub use at_once::at_once;
pub use by_name::ByName;
pub use fault::{Failure, Fault, FileError, NameOrFileError};
pub use nearest::{nearest, slips};
pub use watch::{Stopped, Watch, go_on, unwatched};
