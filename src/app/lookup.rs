//! Makes pictures that need no tracing: backgrounds seen through a refraction map, and liquid glass as screens draw it.
//!
//! A thread of its own makes the last picture that was requested of each view, so that pictures follow the hand while the
//! studio traces.

use super::studio::{Grade, SPAN, Shot, Slot, TakenPicture, Wake};
use crate::io::background::BackgroundRef;
use crate::picture::liquid_glass::pane;
use crate::picture::{Develop, Linear, Pattern, RefractionMap, Tone, develop, filling, refract};
use crate::scene::Panorama;
use egui::ColorImage;
use glam::DVec2;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::JoinHandle;

/// The backplate where a picture needs one and none is chosen.
const FIRST: Pattern = Pattern::Page;

/// Returns the backplate of a picture that needs one: the chosen one where it is a picture, else a pattern.
pub fn backdrop(asked: Option<&BackgroundRef>) -> BackgroundRef {
    let is_picture = |a: &&BackgroundRef| matches!(a, BackgroundRef::Pattern(_) | BackgroundRef::Photo(_));
    asked.filter(is_picture).cloned().unwrap_or(BackgroundRef::Pattern(FIRST))
}

/// A request for a picture.
#[derive(Debug, Clone)]
pub struct LookupRequest {
    /// What the picture shows.
    pub shot: Shot,
    /// The grade of the map.
    pub grade: Grade,
    /// The map, and how far the background has been moved to the right and down, in parts of the map's plane; `None` for
    /// liquid glass.
    pub map: Option<(Arc<RefractionMap>, DVec2)>,
    /// The backplate.
    pub behind: BackgroundRef,
}

impl PartialEq for LookupRequest {
    /// Whether both requests give the same picture.
    fn eq(&self, other: &Self) -> bool {
        let same = match (&self.map, &other.map) {
            (Some((a, by)), Some((b, other))) => Arc::ptr_eq(a, b) && by == other,
            (None, None) => {
                (self.shot.liquid, self.shot.film.size) == (other.shot.liquid, other.shot.film.size)
            }
            _ => false,
        };
        same && self.behind == other.behind
    }
}

/// An answer: the slot, the request, and the picture or the text that says why there is none.
pub type Looked = (Slot, Box<LookupRequest>, Result<TakenPicture, String>);

/// What the window's thread and the worker's thread share.
#[derive(Default)]
struct Mailbox {
    /// The pending requests, one for each slot; the first is served first.
    asked: Mutex<Vec<(Slot, LookupRequest)>>,
    changed: Condvar,
    busy: AtomicBool,
    quit: AtomicBool,
}

/// The window's side of the thread that looks pictures up.
pub struct LookupWorker {
    desk: Arc<Mailbox>,
    answers: Receiver<Looked>,
    last: Vec<(Slot, LookupRequest)>,
    thread: Option<JoinHandle<()>>,
}

impl LookupWorker {
    /// Starts the thread; `wake` is called whenever there is an answer.
    pub fn open(wake: Wake) -> Self {
        let desk = Arc::new(Mailbox::default());
        let (sender, answers) = channel();
        let worker = Worker { desk: Arc::clone(&desk), answers: sender, wake, behind: None, filled: None };
        let thread = std::thread::Builder::new().name("look-up".into()).spawn(|| worker.work()).ok();
        Self { desk, answers, last: vec![], thread }
    }

    /// Requests a picture; nothing happens where the same picture was requested last.
    pub fn ask(&mut self, slot: Slot, ask: LookupRequest) {
        if self.last.iter().any(|(at, last)| *at == slot && *last == ask) {
            return;
        }
        put(&mut self.last, slot, ask.clone());
        let mut asked = self.desk.asked.lock().unwrap_or_else(PoisonError::into_inner);
        self.desk.busy.store(true, Ordering::SeqCst);
        put(&mut asked, slot, ask);
        drop(asked);
        self.desk.changed.notify_one();
    }

    /// Returns the answers that have arrived since the last call.
    pub fn answers(&self) -> impl Iterator<Item = Looked> + '_ {
        self.answers.try_iter()
    }

    /// Whether all requests have been answered.
    pub fn is_idle(&self) -> bool {
        !self.desk.busy.load(Ordering::SeqCst)
    }
}

impl Drop for LookupWorker {
    fn drop(&mut self) {
        {
            // The lock is held, so that the worker is not between looking for a request and waiting for one.
            let _asked = self.desk.asked.lock().unwrap_or_else(PoisonError::into_inner);
            self.desk.quit.store(true, Ordering::SeqCst);
            self.desk.changed.notify_one();
        }
        if let Some(thread) = self.thread.take() {
            // A worker that panicked has reported that already.
            let _ = thread.join();
        }
    }
}

/// Replaces the pending request of a slot; an older one is dropped unread.
fn put(asked: &mut Vec<(Slot, LookupRequest)>, slot: Slot, ask: LookupRequest) {
    match asked.iter_mut().find(|(at, _)| *at == slot) {
        Some((_, last)) => *last = ask,
        None => asked.push((slot, ask)),
    }
}

struct Worker {
    desk: Arc<Mailbox>,
    answers: Sender<Looked>,
    wake: Wake,
    /// The background that was read last, in several sizes.
    behind: Option<(BackgroundRef, Levels)>,
    /// The background that filled a picture last, in the size of that picture.
    filled: Option<(BackgroundRef, Panorama)>,
}

impl Worker {
    fn work(mut self) {
        // The worker has threads of its own: those that the studio keeps busy would come to it last.
        let pool = rayon::ThreadPoolBuilder::new().thread_name(|k| format!("look-up {k}")).build().ok();
        while let Some((slot, ask)) = self.next() {
            let seen = std::panic::AssertUnwindSafe(|| match &pool {
                Some(pool) => pool.install(|| self.seen(&ask)),
                None => self.seen(&ask),
            });
            let taken = std::panic::catch_unwind(seen)
                .unwrap_or_else(|_| Err("a fault of the program; please report the design".to_owned()));
            // Nobody listens once the window is closed.
            let _ = self.answers.send((slot, Box::new(ask), taken));
            let asked = self.desk.asked.lock().unwrap_or_else(PoisonError::into_inner);
            self.desk.busy.store(!asked.is_empty(), Ordering::SeqCst);
            drop(asked);
            (self.wake)();
        }
    }

    /// Waits for a request; `None` when the window is closed.
    fn next(&self) -> Option<(Slot, LookupRequest)> {
        let mut asked = self.desk.asked.lock().unwrap_or_else(PoisonError::into_inner);
        loop {
            if self.desk.quit.load(Ordering::SeqCst) {
                return None;
            }
            if !asked.is_empty() {
                return Some(asked.remove(0));
            }
            asked = self.desk.changed.wait(asked).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn seen(&mut self, ask: &LookupRequest) -> Result<TakenPicture, String> {
        let (picture, tracer) = match &ask.map {
            Some((map, moved)) => {
                let behind = self.levels(&ask.behind)?.for_map(map.size);
                (refracted(map, &behind, *moved), "look-up in the map")
            }
            None => {
                let size = ask.shot.film.size;
                let glass = ask.shot.liquid.pane(size);
                (pane(&glass, self.filled(&ask.behind, size)?, 1), "arithmetic")
            }
        };
        Ok(TakenPicture { image: as_screens(&picture), unresolved: None, tracer, map: None })
    }

    /// Returns a background in its own size, with the halved sizes that have been of use so far.
    fn levels(&mut self, asked: &BackgroundRef) -> Result<&mut Levels, String> {
        let levels = match self.behind.take().filter(|(last, _)| last == asked) {
            Some((_, levels)) => levels,
            None => {
                let reading = asked.picture()?.ok_or("what hangs behind is no picture")?;
                Levels { whole: Arc::new(reading.panorama), halved: vec![] }
            }
        };
        Ok(&mut self.behind.insert((asked.clone(), levels)).1)
    }

    /// Returns a background that is as large as a picture of `size` pixels.
    fn filled(&mut self, asked: &BackgroundRef, size: [u32; 2]) -> Result<&Panorama, String> {
        let is = |(last, p): &(BackgroundRef, Panorama)| last == asked && [p.width, p.height] == size;
        let picture = match self.filled.take().filter(is) {
            Some((_, picture)) => picture,
            None => filling(&self.levels(asked)?.whole, size),
        };
        Ok(&self.filled.insert((asked.clone(), picture)).1)
    }
}

/// A background in several sizes.
struct Levels {
    whole: Arc<Panorama>,
    /// The smaller sizes, each half as large as the one before.
    halved: Vec<Arc<Panorama>>,
}

impl Levels {
    /// Returns the background in the size that is less than twice as fine as the plane of a map of `size` pixels.
    fn for_map(&mut self, size: [u32; 2]) -> Arc<Panorama> {
        let plane = size.map(|side| SPAN * f64::from(side));
        let finer = |p: &Panorama| (f64::from(p.width) / plane[0]).min(f64::from(p.height) / plane[1]);
        let (mut level, mut rest) = (Arc::clone(&self.whole), 0);
        while finer(&level) >= 2.0 {
            if rest == self.halved.len() {
                self.halved.push(Arc::new(level.halved()));
            }
            level = Arc::clone(&self.halved[rest]);
            rest += 1;
        }
        level
    }
}

/// Returns a background seen through a map, moved by parts of the map's plane.
fn refracted(map: &RefractionMap, behind: &Panorama, moved: DVec2) -> Linear {
    let [width, height] = map.size.map(f64::from);
    let shape = width / height;
    let whole = DVec2::new(f64::from(behind.width), f64::from(behind.height));
    // The part of the background that the plane holds: the background fills the plane and is cut where it is longer.
    let held = whole.y.min(whole.x / shape) * DVec2::new(shape, 1.0);
    refract(map, behind, -moved * held / whole)
}

/// Returns a picture for the screen whose light is shown as it is, without exposure or tone.
pub fn as_screens(picture: &Linear) -> ColorImage {
    let manner = Develop { bloom: None, tone: Tone::Linear, ..Develop::default() };
    let size = [picture.width as usize, picture.height as usize];
    ColorImage::from_rgba_unmultiplied(size, &develop(picture, &manner))
}
