//! Pictures that are looked up in the background: each view has its newest request answered, so that pictures follow
//! the user's hand while the studio traces.

use super::lookup::{Lookup, LookupRequest, coarse_picture};
use super::runner::Turn;
use super::{Key, Outside, TaskAnswer, fault};
use crate::studio::Slot;
use brillianteer_scene::BackgroundRef;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The state that all look-ups share.
#[derive(Default)]
pub struct LookUps {
    /// The last request of each slot.
    last: HashMap<Slot, Arc<LookupRequest>>,
    lookup: Arc<Mutex<Lookup>>,
    /// The background of the last picture, which is quickly at hand for the next.
    at_hand: Arc<Mutex<Option<BackgroundRef>>>,
}

/// Returns the content of a lock.
fn held<T>(lock: &Mutex<T>) -> MutexGuard<'_, T> {
    lock.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Outside {
    /// Looks a picture up; nothing happens where the same picture was requested last.
    pub fn look_up(&mut self, slot: Slot, request: LookupRequest) {
        let LookUps { last, lookup, at_hand } = &mut self.look_ups;
        if last.get(&slot).is_some_and(|last| **last == request) {
            return;
        }
        let request = Arc::new(request);
        last.insert(slot, Arc::clone(&request));
        let (lookup, at_hand) = (Arc::clone(lookup), Arc::clone(at_hand));
        let failed =
            TaskAnswer::Looked(slot, Arc::clone(&request), Err(fault("looking up the background failed")));
        self.runner.start(Key::LookUp(slot), Turn::After, Some(failed), move |job| {
            let is_at_hand = held(&at_hand).as_ref() == Some(&request.behind);
            if !is_at_hand && let Some(Ok(coarse)) = coarse_picture(&request) {
                job.send(TaskAnswer::Looked(slot, Arc::clone(&request), Ok(coarse)));
            }
            let taken = held(&lookup).picture(&request, &|done| job.watch(done));
            *held(&at_hand) = Some(request.behind.clone());
            job.send(TaskAnswer::Looked(slot, request, taken));
        });
    }

    /// Returns whether pictures are being looked up.
    pub fn is_looking_up(&self) -> bool {
        self.runner.is_running(|key| matches!(key, Key::LookUp(_)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shows::Shows;
    use crate::studio::take::shot;
    use crate::studio::{Grade, Which};
    use crate::tasks::files::by_dialog;
    use std::time::Duration;

    #[test]
    fn the_window_closes_while_a_picture_is_being_looked_up() {
        let mut outside = Outside::new(Arc::new(by_dialog), Arc::new(|_| Ok(())), None, Arc::new(|| {}));
        let slot = (1, Which::Present);
        let shot = shot(Shows::Render, None);
        let behind = BackgroundRef::read("page", std::path::Path::new("")).unwrap();
        // The look-up cannot end while this is held.
        let lookup = Arc::clone(&outside.look_ups.lookup);
        let lock = held(&lookup);
        outside.look_up(slot, LookupRequest { shot, grade: Grade::Fine, map: None, behind });
        let (sender, closed) = std::sync::mpsc::channel();
        let closing = std::thread::spawn(move || {
            outside.finish();
            sender.send(outside.is_looking_up()).unwrap();
        });
        let is_looking_up = closed.recv_timeout(Duration::from_secs(60));
        drop(lock);
        closing.join().unwrap();
        assert_eq!(is_looking_up, Ok(true), "closing waits for the look-up");
    }
}
