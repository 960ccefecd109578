//! The state that the editor's thread and the studio's thread share.

use super::order::Order;
use std::sync::atomic::{AtomicBool, AtomicU64};
use std::sync::{Arc, Condvar, Mutex};

/// A callback that asks the editor to look at the studio's answers.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// The state that the editor's thread and the studio's thread share.
#[derive(Default)]
pub(super) struct Mailbox {
    /// The last order and its number; `None` once the studio's thread has taken it.
    pub order: Mutex<Option<(u64, Order)>>,
    /// Wakes the studio's thread when there is an order, or when the studio is closed.
    pub changed: Condvar,
    /// The number of the last order: work for all others is outdated.
    pub newest: AtomicU64,
    /// True while the studio works.
    pub busy: AtomicBool,
    /// A word about what pictures wait for, such as a world that is being drawn.
    pub preparing: Mutex<Option<String>>,
    /// True while passes are added to renders that are already good enough.
    pub sharpens: AtomicBool,
    /// The number of traces of pictures, figures and figures against tilt that have begun.
    pub traced: AtomicU64,
    /// True once the studio is closed.
    pub quit: AtomicBool,
}
