//! Pictures that are looked up in the background: each view has its newest request answered, so that pictures follow
//! the user's hand while the studio traces.

use super::lookup::{Lookup, LookupRequest};
use super::runner::Turn;
use super::{Key, Outside, TaskAnswer, fault};
use crate::app::studio::Slot;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// The state that all look-ups share.
#[derive(Default)]
pub struct LookUps {
    /// The last request of each slot.
    last: HashMap<Slot, Arc<LookupRequest>>,
    lookup: Arc<Mutex<Lookup>>,
}

impl Outside {
    /// Looks a picture up; nothing happens where the same picture was requested last.
    pub fn look_up(&mut self, slot: Slot, request: LookupRequest) {
        let LookUps { last, lookup } = &mut self.look_ups;
        if last.get(&slot).is_some_and(|last| **last == request) {
            return;
        }
        let request = Arc::new(request);
        last.insert(slot, Arc::clone(&request));
        let lookup = Arc::clone(lookup);
        let failed =
            TaskAnswer::Looked(slot, Arc::clone(&request), Err(fault("looking up the background failed")));
        self.runner.start(Key::LookUp(slot), Turn::After, Some(failed), move |job| {
            let taken = lookup.lock().unwrap_or_else(PoisonError::into_inner).picture(&request);
            job.send(TaskAnswer::Looked(slot, request, taken));
        });
    }

    /// Returns whether pictures are being looked up.
    pub fn is_looking_up(&self) -> bool {
        self.runner.is_running(|key| matches!(key, Key::LookUp(_)))
    }
}
