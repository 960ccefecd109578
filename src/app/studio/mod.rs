//! The studio: takes pictures and figures on a thread of its own. What is asked for last counts; what is outdated is
//! dropped, but for a first rough picture, so that there is always something that follows the hand.

mod motion;
mod order;
mod pace;
mod refracted;
mod render;
mod survey;
mod take;
mod undeveloped;
mod worker;

pub use order::{
    Answer, FiguresOrder, Grade, Order, Paper, Shot, Slot, Smoothing, TakenPicture, Tilts, Which,
};

pub use pace::Effort;
pub use render::{BEHIND, hung};
#[cfg(test)]
pub use render::{lit_scene, scene_of};
pub use survey::{SPAN, survey};
pub use take::ShotTracer;
pub use worker::{FINE_RENDER, exported};

use crate::app::urgency;
use crate::trace::gpu::Gpu;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::JoinHandle;

/// Asks for nothing but to look at the answers.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// What both threads see.
struct Mailbox {
    /// The last order, and its number; none once it is taken.
    order: Mutex<Option<(u64, Order)>>,
    changed: Condvar,
    /// The number of the last order: work for others is outdated.
    newest: AtomicU64,
    /// Whether work is going on.
    busy: AtomicBool,
    /// Whether more looks are taken at what is as good as it needs to be.
    sharpens: AtomicBool,
    /// How many pictures, figures and figures against tilt were begun to be traced.
    traced: AtomicU64,
    quit: AtomicBool,
}

/// A thread that takes pictures.
pub struct Studio {
    desk: Arc<Mailbox>,
    answers: Receiver<Answer>,
    last: Order,
    wake: Wake,
    thread: Option<JoinHandle<()>>,
    device_name: String,
}

impl Studio {
    /// Opens a studio, which uses a card where there is one that is quicker than the processor; `wake` is called whenever
    /// there is an answer.
    pub fn open(gpu: Option<Arc<Gpu>>, wake: Wake) -> Self {
        let desk = Arc::new(Mailbox {
            order: Mutex::new(None),
            changed: Condvar::new(),
            newest: AtomicU64::new(0),
            busy: AtomicBool::new(false),
            sharpens: AtomicBool::new(false),
            traced: AtomicU64::new(0),
            quit: AtomicBool::new(false),
        });
        let gpu = gpu.filter(|gpu| !gpu.is_software());
        let told = gpu.as_ref().map_or("processor".into(), |gpu| gpu.name().to_owned());
        let (sender, answers) = channel();
        let worker = worker::Worker::new(Arc::clone(&desk), sender, gpu, Arc::clone(&wake));
        let work = || {
            urgency::lower();
            worker.work();
        };
        let thread = std::thread::Builder::new().name("studio".into()).spawn(work).ok();
        Self { desk, answers, last: Order::default(), wake, thread, device_name: told }
    }

    /// What is called whenever there is an answer.
    pub fn wake(&self) -> Wake {
        Arc::clone(&self.wake)
    }

    /// What computes, in words.
    pub fn device_name(&self) -> &str {
        &self.device_name
    }

    /// Asks for pictures and figures; nothing happens if they were asked for already.
    pub fn order(&mut self, order: Order) {
        if order == self.last {
            return;
        }
        self.last = order.clone();
        let mut next = self.desk.order.lock().unwrap_or_else(PoisonError::into_inner);
        let number = self.desk.newest.fetch_add(1, Ordering::SeqCst) + 1;
        self.desk.busy.store(true, Ordering::SeqCst);
        *next = Some((number, order));
        drop(next);
        self.desk.changed.notify_one();
    }

    /// What has been answered since.
    pub fn answers(&self) -> impl Iterator<Item = Answer> + '_ {
        self.answers.try_iter()
    }

    /// Whether more looks are taken at what is asked for, though all of it is as good as it needs to be.
    pub fn sharpens(&self) -> bool {
        self.desk.sharpens.load(Ordering::SeqCst)
    }

    /// How many pictures, figures and figures against tilt were begun to be traced since the studio was opened: what has
    /// not changed is not counted again.
    #[cfg(test)]
    pub fn traced(&self) -> u64 {
        self.desk.traced.load(Ordering::SeqCst)
    }

    /// Whether everything asked for is as good as it needs to be.
    pub fn is_idle(&self) -> bool {
        !self.desk.busy.load(Ordering::SeqCst)
    }
}

impl Drop for Studio {
    fn drop(&mut self) {
        {
            // Held, so that the worker is not between looking and waiting.
            let _order = self.desk.order.lock().unwrap_or_else(PoisonError::into_inner);
            self.desk.quit.store(true, Ordering::SeqCst);
            self.desk.newest.fetch_add(1, Ordering::SeqCst);
            self.desk.changed.notify_one();
        }
        if let Some(thread) = self.thread.take() {
            // A worker that panicked has said so already.
            let _ = thread.join();
        }
    }
}
