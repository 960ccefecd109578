//! The studio: traces pictures and figures on a thread of its own.
//!
//! A newer order outdates an older one, whose work is dropped. Only the first rough pictures are always finished, so
//! that some picture always follows the user's hand.
//!
//! The studio answers an order in grades: rough, as quickly as `pace` has found to keep up with the hand; then fair
//! and fine, with figures; then figures against tilt; then what is left of sweeps, whose coarse points came before
//! the fine pictures; last, renders by rays get more passes. What was answered is not traced again: a new name
//! traces nothing, and another exposure or overlay is made of the light that is kept (`undeveloped`).

mod backgrounds;
mod develop;
mod effort;
mod jobs;
mod mailbox;
mod motion;
mod order;
mod pace;
mod refracted;
mod render;
mod shot_light;
mod sweeping;
pub(crate) mod take;
mod undeveloped;
mod worker;

pub use order::{
    Answer, FiguresOrder, Grade, Order, Paper, Shot, Slot, SweepOrder, SweptPoint, TakenPicture, Tilts, Which,
};

pub use backgrounds::COARSE_FILM;
pub use effort::{Effort, FINE, Grain};
pub use jobs::{SPAN, backdrop, hung};
pub use mailbox::Wake;
pub use refracted::survey;
pub use render::ExportedRender;
pub use shot_light::ShotLight;
pub use take::ShotTracer;

use crate::urgency;
use brillianteer_trace::gpu::Gpu;
use mailbox::Mailbox;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, PoisonError};
use std::thread::JoinHandle;

/// A handle on the thread that traces pictures and figures.
pub struct Studio {
    mailbox: Arc<Mailbox>,
    answers: Receiver<Answer>,
    last: Order,
    thread: Option<JoinHandle<()>>,
    device_name: String,
}

impl Studio {
    /// Opens a studio, which uses the card where it is quicker than the processor. `wake` is called whenever there is an
    /// answer.
    pub fn open(gpu: Option<Arc<Gpu>>, wake: Wake) -> Self {
        let mailbox = Arc::new(Mailbox::default());
        let gpu = gpu.filter(|gpu| !gpu.is_software());
        let device_name = gpu.as_ref().map_or("processor".into(), |gpu| gpu.name().to_owned());
        let (sender, answers) = channel();
        let worker = worker::Worker::new(Arc::clone(&mailbox), sender, gpu, wake);
        let work = || {
            urgency::lower();
            worker.work();
        };
        let thread = std::thread::Builder::new().name("studio".into()).spawn(work).ok();
        Self { mailbox, answers, last: Order::default(), thread, device_name }
    }

    /// Returns the name of the card, or "processor".
    pub fn device_name(&self) -> &str {
        &self.device_name
    }

    /// Replaces the name of the device, so that pictures of the window are the same on every machine.
    pub fn rename_device(&mut self, name: &str) {
        self.device_name = name.to_owned();
    }

    /// Replaces the current order; does nothing if the last order was equal.
    pub fn order(&mut self, order: Order) {
        if order == self.last {
            return;
        }
        self.last = order.clone();
        let mut next = self.mailbox.order.lock().unwrap_or_else(PoisonError::into_inner);
        let number = self.mailbox.newest.fetch_add(1, Ordering::SeqCst) + 1;
        self.mailbox.busy.store(true, Ordering::SeqCst);
        *next = Some((number, order));
        drop(next);
        self.mailbox.changed.notify_one();
    }

    /// Takes the answers that have come since the last call.
    pub fn answers(&self) -> impl Iterator<Item = Answer> + '_ {
        self.answers.try_iter()
    }

    /// Returns a word about what the order's pictures wait for; `None` where they wait for nothing.
    pub fn preparing(&self) -> Option<String> {
        self.mailbox.preparing.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Returns whether passes are added to renders of the order although all of it is already good enough.
    pub fn sharpens(&self) -> bool {
        self.mailbox.sharpens.load(Ordering::SeqCst)
    }

    /// Returns the number of traces of pictures, figures and figures against tilt that have begun since the studio
    /// was opened. Unchanged pictures and figures are not traced again, so they are not counted again.
    pub fn traced(&self) -> u64 {
        self.mailbox.traced.load(Ordering::SeqCst)
    }

    /// Returns whether everything in the order has its final quality.
    pub fn is_idle(&self) -> bool {
        !self.mailbox.busy.load(Ordering::SeqCst)
    }
}

impl Drop for Studio {
    fn drop(&mut self) {
        {
            // Holds the lock, so that the worker is not between its check of `quit` and its wait.
            let _order = self.mailbox.order.lock().unwrap_or_else(PoisonError::into_inner);
            self.mailbox.quit.store(true, Ordering::SeqCst);
            self.mailbox.newest.fetch_add(1, Ordering::SeqCst);
            self.mailbox.changed.notify_one();
        }
        if let Some(thread) = self.thread.take() {
            // A worker that panicked has already reported it.
            let _ = thread.join();
        }
    }
}
