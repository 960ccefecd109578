//! The work of the studio's thread.

use super::effort::{Effort, FAIR, FINE, FINE_BY_CARD, HALFWAY, SHARP};
use super::mailbox::{Mailbox, Wake};
use super::order::{Answer, FiguresOrder, Grade, Order, Shot, Slot, TakenPicture, Which};
use super::pace::Pace;
use super::sweeping::SweptSoFar;
use super::take::ShotTracer;
use crate::shows::Shows;
use brillianteer_base::{Failure, Stopped, Watch};
use brillianteer_measure::{Bounds, Figures, LATTICE};
use brillianteer_render::{Card, Job, RenderError, Rendered};
use brillianteer_scene::{Smoothing, View};
use brillianteer_trace::gpu::Gpu;
use std::collections::HashMap;
use std::ops::ControlFlow;
use std::sync::atomic::Ordering;
use std::sync::mpsc::Sender;
use std::sync::{Arc, PoisonError};
use std::time::Instant;

/// The tilts that figures are plotted against, in degrees.
const TILTS: [f64; 13] = [-30.0, -25.0, -20.0, -15.0, -10.0, -5.0, 0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0];

/// The standard error of fair figures and of figures against tilt.
const FAIR_FIGURES: f64 = 5e-4;
const TILTED: f64 = 1e-3;

/// Carries out orders, one after the other.
pub(super) struct Worker {
    mailbox: Arc<Mailbox>,
    answers: Sender<Answer>,
    wake: Wake,
    camera: ShotTracer,
    pace: Pace,
    /// The pictures that have been answered, with their grades.
    pictures: HashMap<Slot, (Shot, Grade)>,
    figures: HashMap<Which, (FiguresOrder, Grade)>,
    tilts: Option<FiguresOrder>,
    /// The progress of sweeps.
    pub(super) swept: SweptSoFar,
    /// The renders that have been sharpened.
    sharp: HashMap<Slot, Shot>,
}

/// An order with its number, which shows when a newer order outdates it.
struct Turn {
    number: u64,
    order: Order,
}

impl Worker {
    pub fn new(mailbox: Arc<Mailbox>, answers: Sender<Answer>, gpu: Option<Arc<Gpu>>, wake: Wake) -> Self {
        Self {
            mailbox,
            answers,
            wake,
            camera: ShotTracer::by(gpu.map_or(Card::None, Card::Open)),
            pace: Pace::default(),
            pictures: HashMap::new(),
            figures: HashMap::new(),
            tilts: None,
            swept: SweptSoFar::default(),
            sharp: HashMap::new(),
        }
    }

    /// Works until the studio is closed.
    pub fn work(mut self) {
        while let Some(turn) = self.next() {
            let work = || {
                self.rough(&turn)?;
                self.refine(&turn)?;
                self.rest(&turn);
                self.sharpen(&turn)
            };
            let end = std::panic::catch_unwind(std::panic::AssertUnwindSafe(work));
            self.mailbox.sharpens.store(false, Ordering::SeqCst);
            if end.is_err() {
                let why =
                    "a picture failed because of a fault in the program; please report it, with the design";
                self.answer(Answer::Trouble(why.to_owned()));
                self.rest(&turn);
            }
        }
    }

    /// Waits for an order; returns `None` when the studio is closed.
    fn next(&self) -> Option<Turn> {
        let mut order = self.mailbox.order.lock().unwrap_or_else(PoisonError::into_inner);
        loop {
            if self.mailbox.quit.load(Ordering::SeqCst) {
                return None;
            }
            if let Some((number, order)) = order.take() {
                return Some(Turn { number, order });
            }
            order = self.mailbox.changed.wait(order).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Marks the studio as idle, unless there is a newer order.
    fn rest(&self, turn: &Turn) {
        {
            // Holds the lock, so that no order comes in between.
            let _order = self.mailbox.order.lock().unwrap_or_else(PoisonError::into_inner);
            if self.mailbox.newest.load(Ordering::SeqCst) == turn.number {
                self.mailbox.busy.store(false, Ordering::SeqCst);
            }
        }
        (self.wake)();
    }

    /// Counts a trace that begins.
    pub(super) fn count(&self) {
        self.mailbox.traced.fetch_add(1, Ordering::SeqCst);
    }

    pub(super) fn answer(&self, answer: Answer) {
        // Nobody listens once the window is closed.
        let _ = self.answers.send(answer);
        (self.wake)();
    }

    /// Traces all pictures and figures that have changed, as well as there is time for while the user moves
    /// something.
    ///
    /// A newer order does not interrupt this, or no picture would be finished during a drag; only closing the studio
    /// does.
    fn rough(&mut self, turn: &Turn) -> Result<(), Stopped> {
        let mailbox = Arc::clone(&self.mailbox);
        let watch = move |_: f64| stop_if(mailbox.quit.load(Ordering::SeqCst));
        let effort = self.pace.effort();
        let begun = Instant::now();
        let order = &turn.order;
        self.camera.renderer.begin_round();
        self.camera.kept.retain(|slot, _| order.shots.iter().any(|(wanted, _)| wanted == slot));
        self.camera.backgrounds.retain(|asked| order.shots.iter().any(|(_, shot)| shot.hangs(asked)));
        self.say_what_is_prepared();
        let mut any = false;
        for (slot, shot) in &order.shots {
            if self.is_wanted(slot, shot, Grade::Rough) && !self.develop_again((*slot, shot), &watch)? {
                any |= shot.shows != Shows::Diagram;
                self.picture((*slot, shot), Grade::Rough, &effort, &watch)?;
            }
        }
        self.all_figures(order, Grade::Rough, |ask| ask.rough_job(&effort, LATTICE / 16), &watch)?;
        if any {
            self.pace.learn(begun.elapsed());
        }
        Ok(())
    }

    /// Answers a shot from light that was traced before, where it differs from the last shot only in exposure,
    /// overlay and glow.
    ///
    /// Returns whether it answered. The picture then has the grade of the one before.
    fn develop_again(&mut self, (slot, shot): (Slot, &Shot), watch: Watch) -> Result<bool, Stopped> {
        let before = self.pictures.get(&slot).filter(|(done, _)| done.has_light_of(shot));
        let Some((done, grade)) = before.cloned() else { return Ok(false) };
        match self.camera.develop_again(slot, shot, watch) {
            Some(Ok(taken)) => self.answer(Answer::Picture(slot, Box::new(shot.clone()), grade, taken)),
            Some(Err(Failure::Stopped)) => return Err(Stopped),
            Some(Err(_)) | None => return Ok(false),
        }
        if self.sharp.get(&slot) == Some(&done) {
            self.sharp.insert(slot, shot.clone());
        }
        self.pictures.insert(slot, (shot.clone(), grade));
        Ok(true)
    }

    /// Traces all pictures and figures in better and better grades, until there is a newer order.
    fn refine(&mut self, turn: &Turn) -> Result<(), Stopped> {
        let (mailbox, number) = (Arc::clone(&self.mailbox), turn.number);
        let watch = move |_: f64| stop_if(mailbox.newest.load(Ordering::SeqCst) != number);
        let has_card = self.camera.renderer.card().quick().is_some();
        let fine = if has_card { FINE_BY_CARD } else { FINE };
        for (slot, shot) in &turn.order.shots {
            // Pictures of a temporal history all have one size.
            let is_laid = matches!(shot.look.smoothing, Smoothing::Temporal { .. });
            if !is_laid && self.camera.is_slow_render(shot) && self.is_wanted(slot, shot, Grade::Fair) {
                self.picture((*slot, shot), Grade::Rough, &HALFWAY, &watch)?;
            }
        }
        let [fair_figures, fine_figures] = [bounds(FAIR_FIGURES, LATTICE / 4), Bounds::default()];
        self.pictures(&turn.order, Grade::Fair, &FAIR, &watch)?;
        self.all_figures(&turn.order, Grade::Fair, |ask| ask.job(ask.view, &fair_figures), &watch)?;
        self.sweeps(&turn.order, |ask| ask.coarse, &watch)?;
        self.pictures(&turn.order, Grade::Fine, &fine, &watch)?;
        self.all_figures(&turn.order, Grade::Fine, |ask| ask.job(ask.view, &fine_figures), &watch)?;
        self.against_tilt(&turn.order, &watch)?;
        self.sweeps(&turn.order, |ask| ask.points.len(), &watch)
    }

    /// Returns whether a shot still needs a picture of this grade. Under a coarse light only rough pictures are taken; a newer
    /// order brings the whole light.
    fn is_wanted(&self, slot: &Slot, shot: &Shot, grade: Grade) -> bool {
        if grade > Grade::Rough && shot.waits_for_light() {
            return false;
        }
        self.pictures.get(slot).is_none_or(|(done, known)| done != shot || *known < grade)
    }

    fn pictures(
        &mut self,
        order: &Order,
        grade: Grade,
        effort: &Effort,
        watch: Watch,
    ) -> Result<(), Stopped> {
        for (slot, shot) in &order.shots {
            if self.is_wanted(slot, shot, grade) {
                self.picture((*slot, shot), grade, effort, watch)?;
            }
        }
        Ok(())
    }

    /// Adds passes to renders by rays on the processor, until there is a newer order.
    fn sharpen(&mut self, turn: &Turn) -> Result<(), Stopped> {
        let (mailbox, number) = (Arc::clone(&self.mailbox), turn.number);
        let watch = move |_: f64| stop_if(mailbox.newest.load(Ordering::SeqCst) != number);
        for (slot, shot) in &turn.order.shots {
            let is_sharp = self.sharp.get(slot) == Some(shot);
            if is_sharp || shot.waits_for_light() || !self.camera.is_slow_render(shot) {
                continue;
            }
            self.mailbox.sharpens.store(true, Ordering::SeqCst);
            self.picture((*slot, shot), Grade::Fine, &SHARP, &watch)?;
            self.mailbox.sharpens.store(false, Ordering::SeqCst);
            self.sharp.insert(*slot, shot.clone());
            (self.wake)();
        }
        Ok(())
    }

    fn picture(
        &mut self,
        (slot, shot): (Slot, &Shot),
        grade: Grade,
        effort: &Effort,
        watch: Watch,
    ) -> Result<(), Stopped> {
        // A render that is traced again must be sharpened again.
        self.sharp.remove(&slot);
        self.count();
        let (answers, wake) = (self.answers.clone(), Arc::clone(&self.wake));
        let mut each = |taken: TakenPicture| {
            let _ = answers.send(Answer::Picture(slot, Box::new(shot.clone()), grade, taken));
            wake();
        };
        let taken = self.camera.take((slot, shot), effort, watch, &mut each);
        self.say_what_is_prepared();
        let notes: Vec<String> = self.camera.notes.drain(..).collect();
        notes.into_iter().for_each(|note| self.answer(Answer::Trouble(note)));
        match taken {
            Ok(()) => {}
            Err(Failure::Stopped) => return Err(Stopped),
            Err(why) => self.answer(Answer::Trouble(why.to_string())),
        }
        self.pictures.insert(slot, (shot.clone(), grade));
        Ok(())
    }

    /// Tells the window what pictures wait for.
    fn say_what_is_prepared(&self) {
        let preparing = self.camera.backgrounds.preparing();
        let mut said = self.mailbox.preparing.lock().unwrap_or_else(PoisonError::into_inner);
        if *said != preparing {
            *said = preparing;
            drop(said);
            (self.wake)();
        }
    }

    fn all_figures(
        &mut self,
        order: &Order,
        grade: Grade,
        job: impl Fn(&FiguresOrder) -> Job,
        watch: Watch,
    ) -> Result<(), Stopped> {
        for (which, ask) in &order.figures {
            if self.figures.get(which).is_none_or(|(done, g)| done != ask || *g < grade) {
                self.count();
                let figures = Box::new(self.measured(&job(ask), watch)?);
                self.figures.insert(*which, (ask.clone(), grade));
                self.answer(Answer::Figures(*which, ask.clone(), grade, figures));
            }
        }
        Ok(())
    }

    fn measured(&mut self, job: &Job, watch: Watch) -> Result<Figures, Stopped> {
        let rendered = self.camera.renderer.run(job, watch, &mut |_| Ok::<_, RenderError>(()));
        match rendered.and_then(Rendered::figures) {
            Ok(measured) => Ok(measured.figures),
            Err(RenderError::Stopped(stopped)) => Err(stopped),
            // The editor orders figures only along parallel rays, and a tracer for them is always found.
            Err(other) => unreachable!("{other}"),
        }
    }

    fn against_tilt(&mut self, order: &Order, watch: Watch) -> Result<(), Stopped> {
        let Some(ask) = order.tilts.as_ref().filter(|ask| self.tilts.as_ref() != Some(*ask)) else {
            return Ok(());
        };
        self.count();
        let mut at = |degrees: f64| -> Result<(f64, Figures), Stopped> {
            let view = View { tilt: degrees.to_radians(), ..ask.view };
            Ok((degrees, self.measured(&ask.job(view, &bounds(TILTED, LATTICE / 4)), watch)?))
        };
        let tilts = TILTS.into_iter().map(&mut at).collect::<Result<_, _>>()?;
        self.tilts = Some(ask.clone());
        self.answer(Answer::Tilts(ask.clone(), tilts));
        Ok(())
    }
}

fn stop_if(outdated: bool) -> ControlFlow<()> {
    if outdated { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

/// The bounds of figures by their standard error where beams trace them, and by the number of points along each side of the
/// lattices on which rays sample them.
fn bounds(standard_error: f64, lattice: u32) -> Bounds {
    Bounds { standard_error: Some(standard_error), lattice, ..Bounds::default() }
}
