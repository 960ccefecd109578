//! Pictures for the clipboard at a chosen size, made on a thread of their own.

use crate::app::editor::Editor;
use crate::app::shows::Shows;
use crate::app::studio::{Effort, FINE_RENDER, Paper, Shot, ShotTracer, Which};
use crate::io::rasterize;
use crate::picture::profile;
use crate::scene::{Film, Specimen};
use egui::{ColorImage, Context};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// The sizes that are offered: pixels along the longer side.
pub const SIZES: [u32; 4] = [512, 1024, 2048, 4096];

/// The share of the light that may stay unresolved in a scope, as in exported pictures.
const UNRESOLVED: f64 = 1e-3;

/// A picture for the clipboard that is being made.
pub struct Copying {
    name: &'static str,
    answer: Receiver<Result<ColorImage, String>>,
    stop: Arc<AtomicBool>,
}

impl Drop for Copying {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

/// What the picture is made from.
enum Original {
    Shot(Box<Shot>),
    Profile(Arc<Specimen>),
}

/// Whether a view can be copied at a chosen size; a picture that is looked up is only as large as its view.
pub fn can_copy(editor: &Editor, pane: usize) -> bool {
    let shows = editor.desk.panes[pane].shows;
    let needs_facets = matches!(shows, Shows::Profile | Shows::Diagram);
    Shows::EXPORTED.contains(&shows) && (!needs_facets || editor.document.specimen().stone().is_ok())
}

impl Editor {
    /// Makes the picture of a view with `side` pixels along its longer side; it goes to the clipboard once it is made.
    pub(crate) fn copy_at(&mut self, pane: usize, side: u32) {
        let shows = self.desk.panes[pane].shows;
        let own = (pane, Which::Present);
        let shot = self.asked.shots.iter().find(|(slot, _)| *slot == own).map(|(_, shot)| shot.clone());
        let original = match (shows, shot) {
            (Shows::Profile, _) => Original::Profile(self.document.named(self.document.specimen())),
            (_, Some(shot)) => Original::Shot(Box::new(scaled(shot, side))),
            (_, None) => return self.notes.say("This view holds no picture to copy."),
        };
        let (sender, answer) = channel();
        let stop = Arc::new(AtomicBool::new(false));
        let (stopped, wake) = (Arc::clone(&stop), self.studio.wake());
        std::thread::spawn(move || {
            // Nobody waits for the answer any more where another picture was requested.
            let _ = sender.send(taken(&original, side, &stopped));
            wake();
        });
        self.copying = Some(Copying { name: shows.name(), answer, stop });
        self.notes.say(&format!("Making a picture of {side} pixels…"));
    }

    /// Copies the picture that is being made to the clipboard, once it is done.
    pub(crate) fn take_in_copy(&mut self, ctx: &Context) {
        let Some(copying) = self.copying.take() else { return };
        let made = match copying.answer.try_recv() {
            Ok(made) => made,
            Err(TryRecvError::Empty) => {
                self.copying = Some(copying);
                return;
            }
            // The thread has ended without an answer.
            Err(TryRecvError::Disconnected) => Err("making the picture failed; try another size".to_owned()),
        };
        match made {
            Ok(image) => {
                let [width, height] = image.size;
                ctx.copy_image(image);
                self.notes.say(&format!("{} copied, {width} × {height} pixels", copying.name));
            }
            Err(why) => self.notes.trouble(format!("{} was not copied: {why}", copying.name)),
        }
    }
}

/// Returns the same shot with `side` pixels along its longer side.
fn scaled(shot: Shot, side: u32) -> Shot {
    let factor = f64::from(side) / f64::from(shot.film.size[0].max(shot.film.size[1]).max(1));
    let film = |film: Film| {
        let size = film.size.map(|n| ((f64::from(n) * factor).round() as u32).max(1));
        Film { size, pixel: film.pixel / factor, ..film }
    };
    Shot { film: film(shot.film), whole: film(shot.whole), paper: Paper::default(), ..shot }
}

fn taken(original: &Original, side: u32, stop: &AtomicBool) -> Result<ColorImage, String> {
    let shot = match original {
        Original::Shot(shot) => shot,
        Original::Profile(specimen) => return drawn(specimen, side),
    };
    let watch = |_: f64| match stop.load(Ordering::Relaxed) {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    };
    let effort = Effort { unresolved: UNRESOLVED, coarser: 1.0, bands: FINE_RENDER.bands };
    let mut last = None;
    let slot = (0, Which::Present);
    let made = ShotTracer::default()
        .take((slot, shot), &effort, Some(&FINE_RENDER), &watch, &mut |taken| last = Some(taken.image));
    made.map_err(|e| e.to_string())?;
    last.ok_or_else(|| "nothing was drawn".to_owned())
}

/// Returns the drawing from the side, as it is exported.
fn drawn(specimen: &Specimen, side: u32) -> Result<ColorImage, String> {
    let stone = specimen.stone().map_err(|e| e.to_string())?;
    let text = profile(stone, &specimen.design.name, specimen.design.cut.brilliant()).to_string();
    let (width, height, rgb) = rasterize(&text, side).map_err(|e| e.to_string())?;
    Ok(ColorImage::from_rgb([width as usize, height as usize], &rgb))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::tests::Bench;

    #[test]
    fn a_copy_whose_thread_has_ended_is_reported_and_given_up() {
        let mut bench = Bench::new();
        let (sender, answer) = channel();
        bench.harness.state_mut().copying = Some(Copying { name: "ASET", answer, stop: Arc::default() });
        bench.harness.run_steps(1);
        assert!(bench.editor().copying.is_some() && bench.editor().notes.troubles().is_empty());
        drop(sender);
        bench.harness.run_steps(1);
        assert!(bench.editor().copying.is_none());
        assert!(bench.editor().notes.troubles()[0].text.starts_with("ASET was not copied: "));
    }
}
