//! Pictures that hang behind renders. Those that take long are read or drawn on a thread of their own, so that views show
//! a rough picture in the meantime: before a coarse background, or without one.

use crate::urgency;
use brillianteer_base::{Failure, Watch, unwatched};
use brillianteer_paper::background;
use brillianteer_picture::PATTERN_SIDE;
use brillianteer_scene::{BackgroundRef, Mipmap};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError, channel};
use std::time::Duration;

/// The longer side, in pixels, of the film for which a coarse background is drawn; that takes some hundredths of a second.
pub const COARSE_FILM: u32 = 128;

/// The time for which work that waits for a background sleeps before it looks whether it should stop.
const LOOK: Duration = Duration::from_millis(10);

/// A picture that hangs behind, or the reason why there is none; `None` where the background is no picture.
type Made = Result<Option<Arc<Mipmap>>, Failure>;

/// The pictures that hang behind renders.
pub struct Backgrounds {
    /// The longer side, in pixels, of the film behind which fine pictures hang.
    film: u32,
    /// The last picture, as fine as renders show it.
    fine: Option<(BackgroundRef, Arc<Mipmap>)>,
    /// The last coarse picture.
    coarse: Option<(BackgroundRef, Arc<Mipmap>)>,
    making: Option<Making>,
}

impl Default for Backgrounds {
    fn default() -> Self {
        Self { film: PATTERN_SIDE / 2, fine: None, coarse: None, making: None }
    }
}

/// A picture that is being made.
struct Making {
    asked: BackgroundRef,
    made: Receiver<Made>,
    is_stopped: Arc<AtomicBool>,
}

impl Drop for Making {
    fn drop(&mut self) {
        self.is_stopped.store(true, Ordering::Relaxed);
    }
}

impl Making {
    /// Begins to make a picture.
    fn begin(asked: &BackgroundRef, film: u32) -> Self {
        let (sender, made) = channel();
        let is_stopped = Arc::new(AtomicBool::new(false));
        let (wanted, stop) = (asked.clone(), Arc::clone(&is_stopped));
        let make = move || {
            urgency::lower();
            let go_on = |_: f64| {
                if stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            // Nobody listens where another background is wanted meanwhile.
            let _ = sender.send(made_of(&wanted, film, &go_on));
        };
        // Without a thread the channel is closed, and the picture is made by whoever waits for it.
        let _ = std::thread::Builder::new().name("background".into()).spawn(make);
        Self { asked: asked.clone(), made, is_stopped }
    }
}

/// Makes a picture that hangs behind a film.
fn made_of(asked: &BackgroundRef, film: u32, watch: Watch) -> Made {
    Ok(background::picture_watched(asked, film, watch)?
        .map(|reading| Arc::new(Mipmap::new(reading.panorama))))
}

impl Backgrounds {
    /// Returns the picture of a background as it is at hand: the fine one if it is made, else a coarse one; `None` where
    /// the background is no picture, or has none yet. Begins to make the fine one.
    ///
    /// # Errors
    /// Fails where a photograph's file is at fault.
    pub fn at_hand(&mut self, asked: &BackgroundRef) -> Made {
        let is_made = self.fine.as_ref().is_some_and(|(last, _)| last == asked);
        // The coarse picture is drawn first, because the fine one takes all cores.
        let coarse = match asked {
            BackgroundRef::World(_) if !is_made => Some(self.coarse(asked)?),
            _ => None,
        };
        self.known(asked).unwrap_or(Ok(coarse))
    }

    /// Returns the picture of a background as fine as renders show it, and waits until it is made; `None` where the
    /// background is no picture.
    ///
    /// # Errors
    /// Fails where a photograph's file is at fault, or where `watch` asks to stop; the picture is then made further.
    pub fn fine(&mut self, asked: &BackgroundRef, watch: Watch) -> Made {
        loop {
            if let Some(known) = self.known(asked) {
                return known;
            }
            if watch(0.0).is_break() {
                return Err(Failure::Stopped);
            }
            let Some(making) = &self.making else { continue };
            match making.made.recv_timeout(LOOK) {
                Ok(made) => return self.take(asked, made),
                Err(RecvTimeoutError::Timeout) => {}
                // The thread could not be begun, or it has failed.
                Err(RecvTimeoutError::Disconnected) => {
                    let made = made_of(asked, self.film, watch);
                    return self.take(asked, made);
                }
            }
        }
    }

    /// Stops making a background that is wanted no more.
    pub fn retain(&mut self, is_wanted: impl Fn(&BackgroundRef) -> bool) {
        self.making = self.making.take().filter(|making| is_wanted(&making.asked));
    }

    /// Returns a word about the background that is being made; `None` where none is.
    pub fn preparing(&self) -> Option<String> {
        let Making { asked, .. } = self.making.as_ref()?;
        Some(match asked {
            BackgroundRef::World(world) => format!("drawing the {}…", world.name()),
            _ => "reading the background…".to_owned(),
        })
    }

    /// Returns a background whose picture is made or is made at once; `None` where it is being made.
    fn known(&mut self, asked: &BackgroundRef) -> Option<Made> {
        if let Some((_, picture)) = self.fine.as_ref().filter(|(last, _)| last == asked) {
            return Some(Ok(Some(Arc::clone(picture))));
        }
        if !matches!(asked, BackgroundRef::World(_) | BackgroundRef::Photo(_)) {
            let made = made_of(asked, self.film, &unwatched);
            return Some(self.take(asked, made));
        }
        if self.making.as_ref().is_none_or(|making| making.asked != *asked) {
            self.making = Some(Making::begin(asked, self.film));
        }
        match self.making.as_ref()?.made.try_recv() {
            Ok(made) => Some(self.take(asked, made)),
            Err(TryRecvError::Empty | TryRecvError::Disconnected) => None,
        }
    }

    /// Keeps a picture that has been made.
    fn take(&mut self, asked: &BackgroundRef, made: Made) -> Made {
        self.making = None;
        let made = made?;
        self.fine = made.clone().map(|picture| (asked.clone(), picture));
        Ok(made)
    }

    fn coarse(&mut self, asked: &BackgroundRef) -> Result<Arc<Mipmap>, Failure> {
        if let Some((_, picture)) = self.coarse.as_ref().filter(|(last, _)| last == asked) {
            return Ok(Arc::clone(picture));
        }
        let no_picture = || Failure::Input("the background is not a picture".to_owned());
        let reading = background::picture_behind(asked, COARSE_FILM)?.ok_or_else(no_picture)?;
        let picture = Arc::new(Mipmap::new(reading.panorama));
        self.coarse = Some((asked.clone(), Arc::clone(&picture)));
        Ok(picture)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_scene::World;

    /// Returns backgrounds whose fine pictures are drawn quickly.
    fn small() -> Backgrounds {
        Backgrounds { film: 2 * COARSE_FILM, ..Backgrounds::default() }
    }

    #[test]
    fn a_world_is_coarse_at_once_and_fine_once_it_is_drawn() {
        let asked = BackgroundRef::World(World::Sunset);
        let mut backgrounds = small();
        let side = |made: Made| made.unwrap().unwrap().picture().width;
        let coarse = side(backgrounds.at_hand(&asked));
        assert_eq!(coarse, 2 * COARSE_FILM);
        assert_eq!(backgrounds.preparing().as_deref(), Some("drawing the sunset…"));
        // Work that is outdated stops waiting, and the picture is drawn further.
        let stop = |_: f64| ControlFlow::Break(());
        assert!(matches!(backgrounds.fine(&asked, &stop), Err(Failure::Stopped)));
        let fine = backgrounds.fine(&asked, &unwatched).unwrap().unwrap();
        let whole = background::picture_behind(&asked, backgrounds.film).unwrap().unwrap().panorama;
        assert!(*fine.picture() == whole && backgrounds.preparing().is_none());
        assert_eq!(side(backgrounds.at_hand(&asked)), 2 * coarse);
    }

    #[test]
    fn another_background_stops_the_one_that_is_being_drawn() {
        let [sunset, city] = [World::Sunset, World::City].map(BackgroundRef::World);
        let mut backgrounds = small();
        backgrounds.at_hand(&sunset).unwrap();
        let is_stopped = Arc::clone(&backgrounds.making.as_ref().unwrap().is_stopped);
        backgrounds.at_hand(&city).unwrap();
        assert!(is_stopped.load(Ordering::Relaxed));
        assert_eq!(backgrounds.preparing().as_deref(), Some("drawing the city…"));
        // Colours and the light itself need no picture.
        assert!(backgrounds.at_hand(&BackgroundRef::Light).unwrap().is_none());
        backgrounds.retain(|asked| *asked == BackgroundRef::Light);
        assert_eq!(backgrounds.preparing(), None, "it is wanted no more");
    }
}
