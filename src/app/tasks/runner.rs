//! Work in the background, where the newest want wins.
//!
//! Every job has a key. A job that is started stops the one before it that has the same key, and answers of that one are
//! dropped unread: nobody wants them any more. A job that writes waits its turn instead, so that it never meets the one
//! before it half way; of those that wait, the newest alone is kept.

use crate::app::studio::Wake;
use std::collections::HashMap;
use std::hash::Hash;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};

/// How a job follows another with the same key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Turn {
    /// It begins at once, and the other is outdated.
    AtOnce,
    /// It begins once the other has ended. The runner waits for such jobs before it is dropped.
    After,
}

/// A job's side of its runner.
pub struct JobHandle<A> {
    answers: Box<dyn Fn(A) + Send + Sync>,
    stop: Arc<AtomicBool>,
}

impl<A> JobHandle<A> {
    /// Sends an answer; a job may send several.
    pub fn send(&self, answer: A) {
        (self.answers)(answer);
    }

    /// Whether the job was stopped, or nobody wants its answers any more.
    pub fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

type Job<A> = Box<dyn FnOnce(&JobHandle<A>) + Send>;

/// A message of a job: an answer, or `None` for its end.
struct Message<K, A> {
    key: K,
    number: u64,
    answer: Option<A>,
}

/// The jobs with one key.
struct Lane<A> {
    /// The number of the last job that was begun.
    number: u64,
    stop: Arc<AtomicBool>,
    is_running: bool,
    turn: Turn,
    waiting: Option<Job<A>>,
}

/// Runs jobs in the background, each on a thread of its own.
pub struct TaskRunner<K, A> {
    lanes: HashMap<K, Lane<A>>,
    sender: Sender<Message<K, A>>,
    messages: Receiver<Message<K, A>>,
    wake: Wake,
}

impl<K: Copy + Eq + Hash + Send + Sync + 'static, A: Send + 'static> TaskRunner<K, A> {
    /// Makes a runner; `wake` is called whenever there is an answer.
    pub fn new(wake: Wake) -> Self {
        let (sender, messages) = channel();
        Self { lanes: HashMap::new(), sender, messages, wake }
    }

    /// Starts a job. `failed` is its answer where it panics.
    pub fn start(
        &mut self,
        key: K,
        turn: Turn,
        failed: impl FnOnce() -> Option<A> + Send + 'static,
        job: impl FnOnce(&JobHandle<A>) + Send + 'static,
    ) {
        let job: Job<A> = Box::new(move |handle| {
            if catch_unwind(AssertUnwindSafe(|| job(handle))).is_err() {
                failed().into_iter().for_each(|answer| handle.send(answer));
            }
        });
        let lane = self.lanes.entry(key).or_insert_with(|| Lane {
            number: 0,
            stop: Arc::default(),
            is_running: false,
            turn,
            waiting: None,
        });
        lane.turn = turn;
        if lane.is_running && turn == Turn::After {
            lane.waiting = Some(job);
        } else {
            self.begin(key, job);
        }
    }

    fn begin(&mut self, key: K, job: Job<A>) {
        let Some(lane) = self.lanes.get_mut(&key) else { return };
        lane.stop.store(true, Ordering::Relaxed);
        lane.stop = Arc::default();
        lane.number += 1;
        lane.is_running = true;
        let (number, stop) = (lane.number, Arc::clone(&lane.stop));
        let (sender, wake) = (self.sender.clone(), Arc::clone(&self.wake));
        std::thread::spawn(move || {
            // Nobody listens once the window is closed.
            let send = move |answer| {
                let _ = sender.send(Message { key, number, answer });
                wake();
            };
            let send = Arc::new(send);
            let told = Arc::clone(&send);
            job(&JobHandle { answers: Box::new(move |answer| told(Some(answer))), stop });
            send(None);
        });
    }

    /// Asks the job with this key to stop; it still answers.
    pub fn stop(&self, key: K) {
        if let Some(lane) = self.lanes.get(&key) {
            lane.stop.store(true, Ordering::Relaxed);
        }
    }

    /// Returns the answers that have arrived since the last call.
    pub fn answers(&mut self) -> Vec<A> {
        let mut answers = vec![];
        while let Ok(message) = self.messages.try_recv() {
            answers.extend(self.take(message));
        }
        answers
    }

    /// Takes a message: returns its answer where it is still wanted, and begins the job that waited for its end.
    fn take(&mut self, message: Message<K, A>) -> Option<A> {
        let lane = self.lanes.get_mut(&message.key).filter(|lane| lane.number == message.number)?;
        if message.answer.is_none() {
            lane.is_running = false;
            if let Some(job) = lane.waiting.take() {
                self.begin(message.key, job);
            }
        }
        message.answer
    }

    /// Whether a job is running whose key `has_key` accepts.
    pub fn is_running(&self, has_key: impl Fn(&K) -> bool) -> bool {
        self.lanes.iter().any(|(key, lane)| lane.is_running && has_key(key))
    }

    fn is_writing(&self) -> bool {
        self.lanes.values().any(|lane| lane.is_running && lane.turn == Turn::After)
    }
}

impl<K, A> Drop for TaskRunner<K, A> {
    fn drop(&mut self) {
        self.lanes.values().for_each(|lane| lane.stop.store(true, Ordering::Relaxed));
    }
}

impl<K: Copy + Eq + Hash + Send + Sync + 'static, A: Send + 'static> TaskRunner<K, A> {
    /// Waits until everything that was to be written is written.
    pub fn finish(&mut self) {
        while self.is_writing()
            && let Ok(message) = self.messages.recv()
        {
            self.take(message);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::Receiver;

    type Runner = TaskRunner<&'static str, i32>;

    fn runner() -> (Runner, Receiver<()>) {
        let (sender, woken) = channel();
        let sender = std::sync::Mutex::new(sender);
        (TaskRunner::new(Arc::new(move || sender.lock().unwrap().send(()).unwrap_or_default())), woken)
    }

    /// Waits until nothing runs, and returns all answers.
    fn all(runner: &mut Runner, woken: &Receiver<()>) -> Vec<i32> {
        let mut answers = runner.answers();
        while runner.is_running(|_| true) {
            woken.recv().unwrap();
            answers.extend(runner.answers());
        }
        answers
    }

    #[test]
    fn of_two_jobs_the_answer_of_the_newer_is_taken_though_the_older_ends_last() {
        let (mut runner, woken) = runner();
        let (first, begun) = channel::<()>();
        runner.start(
            "a",
            Turn::AtOnce,
            || None,
            move |job| {
                begun.recv().unwrap();
                assert!(job.is_stopped());
                job.send(1);
            },
        );
        runner.start("a", Turn::AtOnce, || None, |job| job.send(2));
        runner.start("b", Turn::AtOnce, || None, |job| job.send(3));
        let mut answers = all(&mut runner, &woken);
        answers.sort_unstable();
        assert_eq!(answers, [2, 3]);
        first.send(()).unwrap();
        (0..2).for_each(|_| woken.recv().unwrap());
        assert!(runner.answers().is_empty());
    }

    #[test]
    fn a_job_that_panics_answers_and_is_over() {
        let (mut runner, woken) = runner();
        runner.start("a", Turn::AtOnce, || Some(-1), |_| panic!("as it is meant to"));
        assert_eq!(all(&mut runner, &woken), [-1]);
    }

    #[test]
    fn of_jobs_that_wait_their_turn_the_newest_follows_and_all_are_finished() {
        let (mut runner, _woken) = runner();
        let (free, held) = channel::<()>();
        let (sender, done) = channel();
        let mut held = Some(held);
        for number in 0..4 {
            let (sender, held) = (sender.clone(), held.take());
            let job = move |_: &JobHandle<i32>| {
                // The first is held until all are started.
                held.into_iter().for_each(|held| held.recv().unwrap());
                sender.send(number).unwrap();
            };
            runner.start("a", Turn::After, || None, job);
        }
        free.send(()).unwrap();
        runner.finish();
        assert_eq!(done.try_iter().collect::<Vec<_>>(), [0, 3]);
    }

    #[test]
    fn a_job_that_is_stopped_still_answers() {
        let (mut runner, woken) = runner();
        runner.start(
            "a",
            Turn::AtOnce,
            || None,
            |job| {
                while !job.is_stopped() {
                    std::thread::yield_now();
                }
                job.send(7);
            },
        );
        runner.stop("a");
        assert_eq!(all(&mut runner, &woken), [7]);
    }
}
