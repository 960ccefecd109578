//! Work in the background, where the newest job of a key wins.
//!
//! Every job has a key. A new job stops the one before it that has the same key, whose answers are then outdated and
//! dropped unread. A job may wait its turn instead, as all that write do, so that it never runs beside the one before it; of
//! those that wait, only the newest is kept.

use crate::studio::Wake;
use std::collections::HashMap;
use std::hash::Hash;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};

/// The order in which jobs with the same key run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Turn {
    /// The new job begins at once, and the other is outdated.
    AtOnce,
    /// The new job begins once the other has ended.
    After,
    /// The new job writes: it begins once the other has ended, and [`finish`](TaskRunner::finish) waits for it.
    Write,
}

impl Turn {
    /// Returns whether a job waits until the one before it has ended.
    fn waits(self) -> bool {
        self != Self::AtOnce
    }
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

    /// Returns whether the job was stopped or its answers are outdated.
    pub fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Stops the work of a job that was stopped, wherever a [`Watch`](brillianteer_base::Watch) is called.
    pub fn watch(&self, _done: f64) -> ControlFlow<()> {
        if self.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

type Work<A> = Box<dyn FnOnce(&JobHandle<A>) + Send>;

/// A job that has not begun.
struct Job<A> {
    number: u64,
    stop: Arc<AtomicBool>,
    work: Work<A>,
}

/// A message of a job: an answer, or `None` for its end.
struct Message<K, A> {
    key: K,
    number: u64,
    answer: Option<A>,
}

/// The jobs with one key.
struct Lane<A> {
    turn: Turn,
    /// The number of the newest job.
    number: u64,
    stop: Arc<AtomicBool>,
    /// The number of jobs that have not ended, as far as their messages have been read.
    pending: usize,
    queue: Arc<Mutex<Queue<A>>>,
}

/// The state that a lane's thread and the runner share.
struct Queue<A> {
    is_running: bool,
    waiting: Option<Job<A>>,
}

impl<A> Default for Lane<A> {
    fn default() -> Self {
        let queue = Arc::new(Mutex::new(Queue { is_running: false, waiting: None }));
        Self { turn: Turn::AtOnce, number: 0, stop: Arc::default(), pending: 0, queue }
    }
}

/// Runs jobs in the background.
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
        failed: Option<A>,
        job: impl FnOnce(&JobHandle<A>) + Send + 'static,
    ) {
        let work: Work<A> = Box::new(move |handle| {
            if catch_unwind(AssertUnwindSafe(|| job(handle))).is_err() {
                failed.into_iter().for_each(|answer| handle.send(answer));
            }
        });
        let lane = self.lanes.entry(key).or_default();
        lane.turn = turn;
        lane.number += 1;
        lane.pending += 1;
        if turn == Turn::AtOnce {
            lane.stop.store(true, Ordering::Relaxed);
        }
        lane.stop = Arc::default();
        let job = Job { number: lane.number, stop: Arc::clone(&lane.stop), work };
        if turn.waits() {
            let mut queue = lane.queue.lock().unwrap_or_else(PoisonError::into_inner);
            if queue.is_running {
                // The job that waited until now is dropped, so it sends no message of its end.
                lane.pending -= usize::from(queue.waiting.replace(job).is_some());
                return;
            }
            queue.is_running = true;
        }
        let queue = turn.waits().then(|| Arc::clone(&lane.queue));
        let (sender, wake) = (self.sender.clone(), Arc::clone(&self.wake));
        std::thread::spawn(move || work_off(key, job, queue.as_deref(), &sender, &wake));
    }

    /// Asks the job with this key to stop; it still answers.
    pub fn stop(&self, key: K) {
        if let Some(lane) = self.lanes.get(&key) {
            lane.stop.store(true, Ordering::Relaxed);
        }
    }

    /// Returns the answers that have arrived since the last call.
    pub fn answers(&mut self) -> Vec<A> {
        let messages: Vec<_> = self.messages.try_iter().collect();
        messages.into_iter().filter_map(|message| self.take(message)).collect()
    }

    /// Takes a message; returns its answer unless it is outdated.
    fn take(&mut self, message: Message<K, A>) -> Option<A> {
        let lane = self.lanes.get_mut(&message.key)?;
        lane.pending -= usize::from(message.answer.is_none());
        message.answer.filter(|_| lane.turn.waits() || lane.number == message.number)
    }

    /// Returns whether a job is running whose key `is_meant` accepts.
    pub fn is_running(&self, is_meant: impl Fn(&K) -> bool) -> bool {
        self.lanes.iter().any(|(key, lane)| lane.pending > 0 && is_meant(key))
    }

    /// Waits until all jobs that write have ended.
    pub fn finish(&mut self) {
        let is_writing = |lane: &Lane<A>| lane.pending > 0 && lane.turn == Turn::Write;
        while self.lanes.values().any(is_writing)
            && let Ok(message) = self.messages.recv()
        {
            self.take(message);
        }
    }
}

impl<K, A> Drop for TaskRunner<K, A> {
    fn drop(&mut self) {
        self.lanes.values().for_each(|lane| lane.stop.store(true, Ordering::Relaxed));
    }
}

/// Does a job, and those that wait for it in a queue.
fn work_off<K: Copy + Send + Sync + 'static, A: Send + 'static>(
    key: K,
    first: Job<A>,
    queue: Option<&Mutex<Queue<A>>>,
    sender: &Sender<Message<K, A>>,
    wake: &Wake,
) {
    let mut next = Some(first);
    while let Some(Job { number, stop, work }) = next {
        let (sender, wake) = (sender.clone(), Arc::clone(wake));
        let send = Arc::new(move |answer| {
            // Nobody listens once the window is closed.
            let _ = sender.send(Message { key, number, answer });
            wake();
        });
        let answers = Arc::clone(&send);
        work(&JobHandle { answers: Box::new(move |answer| answers(Some(answer))), stop });
        next = queue.and_then(|queue| {
            let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
            queue.is_running = queue.waiting.is_some();
            queue.waiting.take()
        });
        send(None);
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

    /// Waits until `count` answers have come, and returns them.
    fn some(runner: &mut Runner, woken: &Receiver<()>, count: usize) -> Vec<i32> {
        let mut answers = runner.answers();
        while answers.len() < count {
            woken.recv().unwrap();
            answers.extend(runner.answers());
        }
        answers
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
        let older = move |job: &JobHandle<i32>| {
            begun.recv().unwrap();
            assert!(job.is_stopped());
            job.send(1);
        };
        runner.start("a", Turn::AtOnce, None, older);
        runner.start("a", Turn::AtOnce, None, |job| job.send(2));
        runner.start("b", Turn::AtOnce, None, |job| job.send(3));
        let mut answers = some(&mut runner, &woken, 2);
        answers.sort_unstable();
        assert_eq!(answers, [2, 3]);
        first.send(()).unwrap();
        assert!(all(&mut runner, &woken).is_empty());
    }

    #[test]
    fn a_job_that_panics_answers_and_is_over() {
        let (mut runner, woken) = runner();
        runner.start("a", Turn::AtOnce, Some(-1), |_| panic!("as it is meant to"));
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
            runner.start("a", Turn::Write, None, job);
        }
        free.send(()).unwrap();
        runner.finish();
        assert_eq!(done.try_iter().collect::<Vec<_>>(), [0, 3]);
    }

    #[test]
    fn a_job_that_is_stopped_still_answers() {
        let (mut runner, woken) = runner();
        runner.start("a", Turn::AtOnce, None, |job| {
            while !job.is_stopped() {
                std::thread::yield_now();
            }
            job.send(7);
        });
        runner.stop("a");
        assert_eq!(all(&mut runner, &woken), [7]);
    }

    #[test]
    fn a_job_that_writes_nothing_is_not_waited_for_and_stops_with_the_runner() {
        let (mut runner, _woken) = runner();
        let (sender, ended) = channel();
        for turn in [Turn::AtOnce, Turn::After] {
            let sender = sender.clone();
            let job = move |job: &JobHandle<i32>| {
                while !job.is_stopped() {
                    std::thread::yield_now();
                }
                sender.send(()).unwrap();
            };
            runner.start(if turn == Turn::After { "a" } else { "b" }, turn, None, job);
        }
        let waits = std::thread::spawn(move || runner.finish());
        // A runner that waits for these jobs never stops them.
        let [first, second] = [(); 2].map(|()| ended.recv_timeout(std::time::Duration::from_secs(60)));
        assert!(first.is_ok() && second.is_ok() && waits.join().is_ok());
    }
}
