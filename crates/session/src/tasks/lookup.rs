//! Makes pictures that need no tracing: backgrounds seen through a refraction map, and liquid glass as screens draw it.

use crate::pixels::Pixels;
use crate::studio::{COARSE_FILM, Grade, SPAN, Shot, TakenPicture};
use brillianteer_base::{Failure, Watch, unwatched};
use brillianteer_paper::background;
use brillianteer_picture::liquid_glass::{GlassPane, PreparedPane, SeenThrough};
use brillianteer_picture::{Linear, PATTERN_SIDE, RefractionMap, filling, refract};
use brillianteer_scene::{BackgroundRef, Panorama};
use glam::DVec2;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::{Arc, OnceLock};

/// A request for a picture.
#[derive(Debug, Clone)]
pub struct LookupRequest {
    /// The shot that the picture answers.
    pub shot: Shot,
    /// The grade of the map.
    pub grade: Grade,
    /// The map, and the distance by which the background has been moved to the right and down, in parts of the map's
    /// plane; `None` for liquid glass.
    pub map: Option<(Arc<RefractionMap>, DVec2)>,
    /// The backplate.
    pub behind: BackgroundRef,
}

impl PartialEq for LookupRequest {
    /// Returns whether both requests give the same picture.
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

/// Makes pictures by looking up, one at a time.
#[derive(Default)]
pub struct Lookup {
    /// Threads of its own, which start with the first picture: in the studio's busy pool, look-ups would be done
    /// last.
    threads: OnceLock<Option<ThreadPool>>,
    backgrounds: Backgrounds,
}

impl Lookup {
    /// Makes a picture.
    ///
    /// # Errors
    /// Fails where the backplate cannot be read, where the text says why, or where `watch` asks to stop while it is drawn.
    pub fn picture(&mut self, request: &LookupRequest, watch: Watch) -> Result<TakenPicture, Failure> {
        let Self { threads, backgrounds } = self;
        let begin = || ThreadPoolBuilder::new().thread_name(|k| format!("look-up {k}")).build().ok();
        match threads.get_or_init(begin) {
            Some(threads) => threads.install(|| backgrounds.picture(request, watch)),
            None => backgrounds.picture(request, watch),
        }
    }
}

/// Makes a picture before a coarse background, where the background is a world, which takes seconds to draw; `None` where it
/// is not.
pub fn coarse_picture(request: &LookupRequest) -> Option<Result<TakenPicture, Failure>> {
    let BackgroundRef::World(_) = request.behind else { return None };
    let reading = background::picture_behind(&request.behind, COARSE_FILM).ok()??;
    let levels = Levels { whole: Arc::new(reading.panorama), halved: vec![] };
    let behind = Some((request.behind.clone(), levels));
    Some(Backgrounds { behind, ..Backgrounds::default() }.picture(request, &unwatched))
}

/// The backgrounds that pictures were made of last.
#[derive(Default)]
struct Backgrounds {
    /// The background that was read last, in several sizes.
    behind: Option<(BackgroundRef, Levels)>,
    /// The background that filled a picture last, in the size of that picture.
    filled: Option<(BackgroundRef, Panorama)>,
    /// The pane of liquid glass that was drawn last.
    pane: Option<PreparedPane>,
    /// The background as seen through that pane: its name, the place of the pane's corner, and the result of the
    /// look-up.
    seen: Option<(BackgroundRef, DVec2, SeenThrough)>,
}

impl Backgrounds {
    fn picture(&mut self, request: &LookupRequest, watch: Watch) -> Result<TakenPicture, Failure> {
        let (picture, tracer) = match &request.map {
            Some((map, moved)) => {
                let behind = self.levels(&request.behind, watch)?.for_map(map.size);
                (refracted(map, &behind, *moved), "look-up in the map")
            }
            None => {
                let size = request.shot.film.size;
                let glass = request.shot.liquid.pane(size);
                (self.liquid_glass(&glass, &request.behind, size, watch)?, "arithmetic")
            }
        };
        Ok(TakenPicture {
            image: Pixels::encoded(&picture),
            unresolved: None,
            tracer,
            coarser: 1.0,
            map: None,
        })
    }

    /// Draws a pane of liquid glass. Unaffected parts are not computed again: where only the light moves, nothing is
    /// looked up, and where the pane is dragged, its shape is kept.
    fn liquid_glass(
        &mut self,
        glass: &GlassPane,
        behind: &BackgroundRef,
        size: [u32; 2],
        watch: Watch,
    ) -> Result<Linear, Failure> {
        let kept = self.pane.take().filter(|pane| pane.suits(glass, size));
        let is_seen =
            |(last, corner, _): &(BackgroundRef, DVec2, _)| last == behind && *corner == glass.corner;
        let seen = self.seen.take().filter(|seen| kept.is_some() && is_seen(seen));
        let mut pane = kept.unwrap_or_else(|| PreparedPane::new(glass, size));
        pane.moved_to(glass);
        let background = self.filled(behind, size, watch)?;
        let seen = seen.map_or_else(|| pane.through(background), |(.., seen)| seen);
        let picture = pane.lit(glass, &seen, Some(background));
        self.pane = Some(pane);
        self.seen = Some((behind.clone(), glass.corner, seen));
        Ok(picture)
    }

    /// Returns a background in its own size, with the halved sizes that have been needed so far.
    fn levels(&mut self, background: &BackgroundRef, watch: Watch) -> Result<&mut Levels, Failure> {
        let levels = match self.behind.take().filter(|(last, _)| last == background) {
            Some((_, levels)) => levels,
            None => {
                let no_picture = || Failure::Input("the background is not a picture".to_owned());
                let reading = background::picture_watched(background, PATTERN_SIDE / 2, watch)?
                    .ok_or_else(no_picture)?;
                Levels { whole: Arc::new(reading.panorama), halved: vec![] }
            }
        };
        Ok(&mut self.behind.insert((background.clone(), levels)).1)
    }

    /// Returns a background that is as large as a picture of `size` pixels.
    fn filled(
        &mut self,
        background: &BackgroundRef,
        size: [u32; 2],
        watch: Watch,
    ) -> Result<&Panorama, Failure> {
        let is = |(last, p): &(BackgroundRef, Panorama)| last == background && [p.width, p.height] == size;
        let picture = match self.filled.take().filter(is) {
            Some((_, picture)) => picture,
            None => filling(&self.levels(background, watch)?.whole, size),
        };
        Ok(&self.filled.insert((background.clone(), picture)).1)
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
