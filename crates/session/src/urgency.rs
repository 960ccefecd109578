//! Lowers the priority of the threads that trace light, so that the thread that draws the window comes first.

use thread_priority::{ThreadPriority, ThreadPriorityValue, set_current_thread_priority};

/// The priority of work that the user does not wait for directly, 0 to 99; on Linux this becomes niceness 2.
///
/// The thread that paints the window sleeps in between and so comes first anyway; a much lower priority would let
/// other busy programs stop the tracing.
const BEHIND: u8 = 42;

/// The priority of work that takes minutes, 0 to 99. It is below that of pictures, which show the results of that
/// work; on Linux it becomes niceness 7.
const LAST: u8 = 30;

/// Lowers the priority of this thread. If the system refuses, the window follows the hand less quickly; nothing else
/// changes.
pub fn lower() {
    lower_to(BEHIND);
}

/// Lowers the priority of this thread below that of the threads that trace pictures.
pub fn lower_most() {
    lower_to(LAST);
}

fn lower_to(priority: u8) {
    if let Ok(priority) = ThreadPriorityValue::try_from(priority) {
        let _ = set_current_thread_priority(ThreadPriority::Crossplatform(priority));
    }
}

/// Lowers the priority of rayon's threads; this must be called before the first of them has work.
pub fn lower_the_pool() {
    let pool =
        rayon::ThreadPoolBuilder::new().thread_name(|k| format!("tracing {k}")).start_handler(|_| lower());
    // This fails if the threads run already; then they keep their priority.
    let _ = pool.build_global();
}
