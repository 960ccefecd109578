//! The steps of undo.

/// The greatest number of steps that are kept.
const MOST: usize = 500;

/// The past states of a value, its present state, and the states that were undone.
#[derive(Debug, Clone)]
pub struct History<T> {
    past: Vec<T>,
    present: T,
    future: Vec<T>,
}

impl<T: Clone + PartialEq> History<T> {
    /// Begins a history with this state.
    pub fn new(present: T) -> Self {
        Self { past: vec![], present, future: vec![] }
    }

    /// Takes a state as a new step if it differs from the last one; returns whether it does.
    pub fn settle(&mut self, now: &T) -> bool {
        if *now == self.present {
            return false;
        }
        self.past.push(std::mem::replace(&mut self.present, now.clone()));
        self.future.clear();
        if self.past.len() > MOST {
            self.past.remove(0);
        }
        true
    }

    /// Replaces the last state that was settled, without a new step.
    pub fn amend(&mut self, now: &T) {
        self.present.clone_from(now);
    }

    /// Returns all states, to be written in another way without a new step.
    pub fn each_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.past.iter_mut().chain([&mut self.present]).chain(&mut self.future)
    }

    /// Returns the last state that was settled.
    pub fn present(&self) -> &T {
        &self.present
    }

    /// Returns the state before the last step; `None` where there is none.
    pub fn before(&self) -> Option<&T> {
        self.past.last()
    }

    /// Returns whether there is a step to undo.
    pub fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Returns whether there is a step to redo.
    pub fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }

    /// Goes one step back and returns the state there; `None` where there is no such step.
    pub fn undo(&mut self) -> Option<T> {
        let before = self.past.pop()?;
        self.future.push(std::mem::replace(&mut self.present, before));
        Some(self.present.clone())
    }

    /// Redoes a step that was undone and returns the state there; `None` where there is no such step.
    pub fn redo(&mut self) -> Option<T> {
        let after = self.future.pop()?;
        self.past.push(std::mem::replace(&mut self.present, after));
        Some(self.present.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_undone_and_done_again_in_order() {
        let mut history = History::new(0);
        assert!(!history.settle(&0) && !history.can_undo() && history.undo().is_none());
        assert!([1, 2, 3].into_iter().all(|k| history.settle(&k)));
        assert_eq!([history.undo(), history.undo(), history.redo()], [Some(2), Some(1), Some(2)]);
        assert!(history.settle(&7) && !history.can_redo());
        assert_eq!(
            [history.undo(), history.undo(), history.undo(), history.undo()],
            [Some(2), Some(1), Some(0), None]
        );
    }

    #[test]
    fn an_amended_state_is_no_step_and_keeps_those_that_were_undone() {
        let mut history = History::new(0);
        assert!(history.settle(&1) && history.settle(&2) && history.undo() == Some(1));
        history.amend(&5);
        assert_eq!((history.redo(), history.undo(), history.undo()), (Some(2), Some(5), Some(0)));
    }

    #[test]
    fn the_oldest_steps_are_forgotten() {
        let mut history = History::new(0);
        assert!((1..=2 * MOST).all(|k| history.settle(&k)));
        assert_eq!(std::iter::from_fn(|| history.undo()).count(), MOST);
    }
}
