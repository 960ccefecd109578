//! Exports, on a thread of their own: thumbnails of what can be exported, then the files.

use super::export_scene::SceneOut;
use super::framing::{Framing, FramingFit};
use super::shows::Shows;
use super::studio::{Effort, FINE_RENDER, SPAN, Shot, ShotTracer, Which, exported, survey};
use crate::io::background::BackgroundRef;
use crate::io::export::{Event, Export, OutputFormat, Outputs, Viewing};
use crate::io::refraction::{self, Coding, MOST_BANDS, MOST_PIXELS, Page, takes, write_page};
use crate::io::{Failure, rasterize, write_rgba_png};
use crate::optics::line;
use crate::picture::{named, profile};
use crate::render::Demands;
use crate::scene::{Glare, Pose, Specimen, View, Viewpoint};
use crate::trace::unwatched;
use egui::ColorImage;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The side of a thumbnail, pixels.
const THUMBNAIL: u32 = 176;

/// The effort of a render, where a picture in a scope takes 1, roughly.
const RENDER: f64 = 4.0;

/// What of a stone is selected for export.
#[derive(Clone)]
pub struct Selection {
    /// The views that are exported.
    pub views: Vec<Shows>,
    /// The formats of the files.
    pub formats: Vec<OutputFormat>,
    /// Whether a refraction map is written, with a page that shows it.
    pub map: bool,
    /// The number of bands of wavelengths of the refraction map.
    pub bands: u32,
    /// The number of places in each pixel of the refraction map, for each band.
    pub places: u32,
    /// Whether what renders show is written as a scene file, with its cut.
    pub scene: bool,
    /// The number of pixels along each side.
    pub size: u32,
    /// Whether pictures in scopes have a caption with a legend under them.
    pub caption: bool,
}

impl Default for Selection {
    fn default() -> Self {
        let views = vec![Shows::Render, Shows::Aset, Shows::Hearts, Shows::Arrows];
        let formats = vec![OutputFormat::Png];
        Self { views, formats, map: false, bands: 1, places: 1, scene: false, size: 1024, caption: false }
    }
}

/// How a picture sees the stone.
#[derive(Clone)]
pub struct PictureAspect {
    /// The view; pictures that are made for one side take that side instead.
    pub view: View,
    /// How far the stone is turned about its axis, radians.
    pub turn: f64,
    /// The stone at rest, turned by `turn`.
    pub turned: Arc<Specimen>,
}

/// All that an export needs to know.
#[derive(Clone)]
pub struct ExportPlan {
    /// What renders show, with light and view; the film is not used.
    pub shot: Shot,
    /// The stone as the cut has it, not turned.
    pub upright: Arc<Specimen>,
    /// How the linked views see the stone; pictures and figures without a view of their own see it the same.
    pub linked: PictureAspect,
    /// How the views that look on their own see the stone, by what they show.
    pub own: Vec<(Shows, PictureAspect)>,
    /// Half the side of the square that renders show.
    pub reach: f64,
    /// What is selected for export.
    pub selection: Selection,
    /// The light, as scene files name it.
    pub light: PathBuf,
    /// The folder of the files.
    pub folder: PathBuf,
    /// The beginning of the files' names.
    pub stem: String,
}

/// How far an export has come.
#[derive(Default)]
pub struct ExportProgress {
    /// The part done, in thousandths.
    done: AtomicU64,
    stop: AtomicBool,
    /// The files written, the notes and the warnings, in words.
    messages: Mutex<Vec<String>>,
    /// The number of files written.
    written: AtomicUsize,
    end: Mutex<Option<Result<(), String>>>,
}

/// An export that is under way or has ended.
pub struct Job {
    progress: Arc<ExportProgress>,
    /// The files, in the order in which they are written.
    files: Vec<PathBuf>,
    begun: Instant,
}

impl ExportPlan {
    /// Returns how a picture sees the stone.
    pub fn aspect(&self, shows: Shows) -> &PictureAspect {
        self.own.iter().find(|(own, _)| *own == shows).map_or(&self.linked, |(_, aspect)| aspect)
    }

    /// Returns what is written of the stone as it is turned in the linked views, as it is turned in each view of its own,
    /// and as the cut has it: drawings and figures know of no turn.
    fn parts(&self) -> Vec<(Outputs, Viewing<'_>)> {
        let is_drawing = |shows: &Shows| !shows.is_seen();
        let is_own = |shows: &Shows| self.own.iter().any(|(own, _)| own == shows);
        let json = self.selection.formats.contains(&OutputFormat::Json);
        let formats = |json: bool| {
            let pixels = self.selection.formats.iter().copied().filter(|f| *f != OutputFormat::Json);
            pixels.chain(json.then_some(OutputFormat::Json)).collect()
        };
        let seen = self.outputs(|s| !is_drawing(s) && !is_own(s), formats(false));
        let linked = Viewpoint::from(self.linked.view);
        let turned = |aspect: &PictureAspect| aspect.turn.to_degrees();
        let mut parts = vec![(seen, self.viewing(&self.linked.turned, linked, turned(&self.linked)))];
        for (shows, aspect) in self.own.iter().filter(|(shows, _)| shows.is_seen()) {
            let alone = self.outputs(|s| s == shows, formats(false));
            if !alone.pictures.is_empty() {
                let viewpoint = Viewpoint::from(aspect.view);
                parts.push((alone, self.viewing(&aspect.turned, viewpoint, turned(aspect))));
            }
        }
        let azimuth_deg = (linked.azimuth_deg - self.linked.turn.to_degrees()).rem_euclid(360.0);
        let azimuth_deg = if linked.tilt_deg == 0.0 { 0.0 } else { azimuth_deg };
        let upright = self.outputs(is_drawing, formats(json));
        parts.push((upright, self.viewing(&self.upright, Viewpoint { azimuth_deg, ..linked }, 0.0)));
        parts
    }

    fn outputs(&self, is_part: impl Fn(&Shows) -> bool, formats: Vec<OutputFormat>) -> Outputs {
        let picture = |shows: &Shows| Some((shows.key().to_owned(), named(shows.key())?));
        Outputs {
            folder: self.folder.clone(),
            stem: self.stem.clone(),
            pictures: self.selection.views.iter().filter(|s| is_part(s)).filter_map(picture).collect(),
            size: self.selection.size,
            formats,
            caption: self.selection.caption,
            strongest: true,
            timing: false,
        }
    }

    fn viewing<'a>(&'a self, specimen: &'a Specimen, viewpoint: Viewpoint, turned_deg: f64) -> Viewing<'a> {
        Viewing {
            specimen,
            file: &self.stem,
            viewpoint,
            turned_deg,
            medium: specimen.medium(line::SODIUM_D),
            wavelength_nm: Some(line::SODIUM_D),
            head_deg: self.shot.head,
            unresolved: None,
            polarised: true,
            // `None` leaves glare out of pictures; figures list it in any case.
            glare: Some(self.shot.glare).filter(|glare| *glare == Glare::Included),
            tracer: Demands::of_scope(specimen, &viewpoint.view()).by_processor(),
        }
    }

    /// Returns the paths of the maps, then those of the diffuse layer and the page; `None` where no map is selected.
    fn map_paths(&self) -> Option<(Vec<PathBuf>, [PathBuf; 2])> {
        let count = (self.selection.bands * self.selection.places) as usize;
        let maps = refraction::paths(&self.folder, &self.stem, count, Coding::Tiles);
        let page = self.folder.join(format!("{}-refraction.html", self.stem));
        let others = [refraction::diffuse_path(&self.folder, &self.stem), page];
        self.selection.map.then_some((maps, others))
    }

    /// Returns a note that a render is not physics; it is empty where the render is.
    fn mixture(&self) -> String {
        match self.shot.strength {
            s if s < 1.0 => format!("strength {s}: a mixture for its looks, not physics; "),
            _ => String::new(),
        }
    }

    fn render_path(&self) -> Option<PathBuf> {
        let wanted = self.selection.views.contains(&Shows::Render)
            && self.selection.formats.contains(&OutputFormat::Png);
        wanted.then(|| self.folder.join(format!("{}-render.png", self.stem)))
    }

    /// Returns the views that can be exported: drawings need facets.
    pub fn can_be_shown(&self) -> impl Iterator<Item = Shows> {
        let has_facets = self.upright.stone().is_ok();
        Shows::EXPORTED.iter().copied().filter(move |shows| has_facets || shows.is_seen())
    }

    /// Returns the files that will be written, in that order.
    ///
    /// # Errors
    /// The text says what keeps them from being written.
    pub fn files(&self) -> Result<Vec<PathBuf>, String> {
        if self.selection.map && self.selection.size > MOST_PIXELS {
            return Err(format!(
                "A refraction map has {MOST_PIXELS} pixels each way at most: take a smaller size."
            ));
        }
        if self.selection.map && self.selection.bands * self.selection.places > MOST_BANDS {
            return Err(format!("Bands times places are {MOST_BANDS} at most: take fewer."));
        }
        let mut files = vec![];
        for (outputs, viewing) in &self.parts() {
            files.extend(Export { viewing: *viewing, outputs }.files().map_err(|e| e.to_string())?);
        }
        files.extend(self.render_path());
        files.extend(self.map_paths().into_iter().flat_map(|(maps, others)| maps.into_iter().chain(others)));
        files.extend(self.selection.scene.then(|| SceneOut::paths(self)).into_iter().flatten());
        Ok(files)
    }

    /// Returns the shot of a view at a size, framed as in the views of the window.
    fn shot(&self, shows: Shows, size: u32) -> Shot {
        let seen = self.aspect(shows).view;
        let view = View { side: shows.side().unwrap_or(seen.side), ..seen };
        let shot = Shot { shows, view, ..self.shot.clone() };
        let size = [size; 2];
        if shows.has_company() && self.shot.company.as_slice() != [Pose::STILL] {
            let fit = FramingFit::reaching(self.reach);
            return Shot { film: fit.film(size), whole: fit.whole(size), ..shot };
        }
        let specimen = Arc::clone(if shows.is_seen() { &self.aspect(shows).turned } else { &self.upright });
        let fit = Framing::new(&specimen).fit(0.0, &shot.view);
        let (film, whole) = (fit.film(size), fit.whole(size));
        Shot { film, whole, specimen, company: vec![Pose::STILL], ..shot }
    }

    /// Writes all files, one after the other.
    fn write(&self, progress: &ExportProgress) -> Result<(), Failure> {
        let render = self.render_path();
        let parts = self.parts();
        let effort =
            |o: &Outputs| (o.pictures.len() + usize::from(o.formats.contains(&OutputFormat::Json))) as f64;
        let more =
            [render.is_some(), self.selection.map].map(|is_wanted| if is_wanted { RENDER } else { 0.0 });
        let all = parts.iter().map(|(o, _)| effort(o)).sum::<f64>() + more[0] + more[1];
        let mut begun = 0.0;
        for (outputs, viewing) in &parts {
            let share = effort(outputs);
            let watch = |done: f64| progress.at((begun + done * share) / all);
            Export { viewing: *viewing, outputs }.write(&watch, &|told| {
                progress.hear(&told);
                Ok(())
            })?;
            begun += share;
        }
        if let Some(path) = render {
            self.render(&path, &|done| progress.at((begun + done * RENDER) / all))?;
            progress.hear(&Event::Written(&path));
            begun += RENDER;
        }
        if let Some((maps, others)) = self.map_paths() {
            self.write_map(&maps, &others, &|done| progress.at((begun + done * RENDER) / all))?;
            maps.iter().chain(&others).for_each(|path| progress.hear(&Event::Written(path)));
        }
        if self.selection.scene {
            SceneOut::of(self).write()?;
            SceneOut::paths(self).iter().for_each(|path| progress.hear(&Event::Written(path)));
        }
        Ok(())
    }

    fn write_map(
        &self,
        maps: &[PathBuf],
        [diffuse, page]: &[PathBuf; 2],
        watch: crate::trace::Watch,
    ) -> Result<(), Failure> {
        let (map, carried) = survey(
            &self.shot(Shows::Render, self.selection.size),
            [self.selection.bands, self.selection.places],
            watch,
        )?;
        let title = self.shot.title.as_str();
        let told = format!(
            "{title}; refraction map, bands {}, places {}; light {}; {:.1} % of the light comes from the background, {:.1} % of that from the \
             map's places",
            self.selection.bands,
            self.selection.places,
            self.shot.light.light.name,
            100.0 * carried.behind,
            100.0 * carried.single
        );
        refraction::write_places(maps, &map, Coding::Tiles, &told)?;
        refraction::write_diffuse(diffuse, &map, &told)?;
        let behind =
            self.shot.behind.as_ref().map(BackgroundRef::bytes).transpose().map_err(Failure::Input)?;
        let background = behind.flatten().filter(|bytes| takes(bytes));
        let ground = self.shot.behind.as_ref().map_or_else(String::new, BackgroundRef::title);
        let background = background.as_deref().map(|bytes| (ground.as_str(), bytes));
        Ok(write_page(page, &map, &Page { title, description: &told, span: SPAN, background })?)
    }

    fn render(&self, path: &Path, watch: crate::trace::Watch) -> Result<(), Failure> {
        let mut last = None;
        let effort = Effort { unresolved: FINE_RENDER.unresolved, coarser: 1.0, bands: FINE_RENDER.bands };
        let shot = self.shot(Shows::Render, self.selection.size);
        ShotTracer::default().take(
            ((0, Which::Present), &shot),
            &effort,
            Some(&exported(&shot)),
            watch,
            &mut |taken| last = Some(taken),
        )?;
        let Some(taken) = last else { return Err(Failure::Stopped) };
        let rgba: Vec<u8> = taken.image.pixels.iter().flat_map(|p| p.to_srgba_unmultiplied()).collect();
        let [width, height] = taken.image.size.map(|n| n as u32);
        let told = format!(
            "{}: render; light {}; {}{}",
            self.shot.title,
            self.shot.light.light.name,
            self.mixture() + taken.tracer,
            taken.unresolved.map_or(String::new(), |u| format!(", unresolved {u:.2e}"))
        );
        Ok(write_rgba_png(path, &rgba, (width, height), &told)?)
    }
}

impl ExportProgress {
    fn at(&self, done: f64) -> ControlFlow<()> {
        self.done.store((1000.0 * done) as u64, Ordering::Relaxed);
        if self.stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn hear(&self, told: &Event) {
        let text = match told {
            Event::Begun(_) => return,
            Event::Written(path) => {
                self.written.fetch_add(1, Ordering::Relaxed);
                format!("wrote {}", path.display())
            }
            Event::Note(text) | Event::Warning(text) => (*text).to_owned(),
        };
        self.messages.lock().unwrap_or_else(PoisonError::into_inner).push(text);
    }
}

impl Job {
    /// Begins an export on a thread of its own; `wake` is called when it ends.
    pub fn begin(plan: ExportPlan, wake: impl Fn() + Send + 'static) -> Self {
        let progress = Arc::new(ExportProgress::default());
        let seen = Arc::clone(&progress);
        // Where the files cannot be known, writing says why.
        let files = plan.files().unwrap_or_default();
        std::thread::spawn(move || {
            let write = || plan.write(&seen).map_err(|e| e.to_string());
            let end = std::panic::catch_unwind(std::panic::AssertUnwindSafe(write))
                .unwrap_or_else(|_| Err("a fault of the program: please report the design".to_owned()));
            *seen.end.lock().unwrap_or_else(PoisonError::into_inner) = Some(end);
            wake();
        });
        Self { progress, files, begun: Instant::now() }
    }

    /// Returns the part done, 0 to 1; for stopped work, the part that it reached.
    pub fn done(&self) -> f32 {
        if self.end() == Some(Ok(())) {
            return 1.0;
        }
        self.progress.done.load(Ordering::Relaxed) as f32 / 1000.0
    }

    /// Says which file is being written and about how long the rest takes; once the export has ended, how far it came.
    pub fn standing(&self) -> String {
        let (written, all) = (self.written(), self.files.len());
        match (self.end(), self.files.get(written)) {
            (Some(Ok(())), _) => format!("{written} of {all} files written"),
            (Some(Err(_)), _) => {
                let how = if self.is_stopped() { "Stopped" } else { "Ended" };
                format!("{how} at {:.0} %, {written} of {all} files written", 100.0 * self.done())
            }
            (None, _) if self.is_stopped() => "stopping…".to_owned(),
            (None, file) => {
                let name =
                    file.and_then(|f| f.file_name()).unwrap_or_default().to_string_lossy().into_owned();
                let left = left(self.begun.elapsed(), f64::from(self.done()));
                let left = left.map_or(String::new(), |left| format!(", about {} left", spoken(left)));
                format!("{name}, file {} of {all}{left}", (written + 1).min(all))
            }
        }
    }

    /// Returns the number of files written.
    pub fn written(&self) -> usize {
        self.progress.written.load(Ordering::Relaxed)
    }

    /// Asks the export to stop: the file that is being written is left out.
    pub fn stop(&self) {
        self.progress.stop.store(true, Ordering::Relaxed);
    }

    /// Whether the export was asked to stop.
    pub fn is_stopped(&self) -> bool {
        self.progress.stop.load(Ordering::Relaxed)
    }

    /// Returns the messages so far.
    pub fn messages(&self) -> Vec<String> {
        self.progress.messages.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Returns how the export ended, once it has.
    pub fn end(&self) -> Option<Result<(), String>> {
        self.progress.end.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// The time that must have passed before the time left is shown.
const FIRST_SECOND: Duration = Duration::from_secs(1);
/// The part that must be done before the time left is shown.
const FIRST_PART: f64 = 0.02;

/// Returns how long the rest takes if work goes on as it did until its part `done`, 0 to 1; `None` where it is too early to
/// say.
fn left(passed: Duration, done: f64) -> Option<Duration> {
    (passed >= FIRST_SECOND && done >= FIRST_PART).then(|| passed.mul_f64((1.0 - done).max(0.0) / done))
}

/// Returns a time in words: in minutes from two minutes on.
fn spoken(time: Duration) -> String {
    match time.as_secs() {
        seconds @ 0..120 => format!("{} s", seconds + 1),
        seconds => format!("{} min", seconds.div_ceil(60)),
    }
}

/// Takes thumbnails of all views, one after the other, on a thread of its own; `wake` is called after each.
pub fn thumbnails(plan: ExportPlan, wake: impl Fn() + Send + 'static) -> Receiver<(Shows, ColorImage)> {
    let (sender, pictures) = channel();
    std::thread::spawn(move || {
        let mut camera = ShotTracer::default();
        for shows in plan.can_be_shown() {
            if !send(&plan, shows, &mut camera, &sender) {
                return;
            }
            wake();
        }
    });
    pictures
}

/// Returns the drawing from the side, small.
fn side(plan: &ExportPlan) -> Option<ColorImage> {
    let Specimen { design, .. } = &*plan.upright;
    let text = profile(plan.upright.stone().ok()?, &design.name, design.cut.brilliant()).to_string();
    let (width, height, rgb) = rasterize(&text, 2 * THUMBNAIL).ok()?;
    Some(ColorImage::from_rgb([width as usize, height as usize], &rgb))
}

/// Takes the thumbnail of a view and sends it; returns whether anyone still wants thumbnails.
fn send(
    plan: &ExportPlan,
    shows: Shows,
    camera: &mut ShotTracer,
    sender: &Sender<(Shows, ColorImage)>,
) -> bool {
    let effort = Effort { unresolved: 2e-2, coarser: 1.0, bands: 6 };
    let mut is_wanted = true;
    if shows == Shows::Profile {
        return side(plan).is_none_or(|image| sender.send((shows, image)).is_ok());
    }
    // A thumbnail that cannot be taken stays empty; exporting says why.
    let _ = camera.take(
        ((0, Which::Present), &plan.shot(shows, THUMBNAIL)),
        &effort,
        None,
        &unwatched,
        &mut |taken| {
            is_wanted &= sender.send((shows, taken.image)).is_ok();
        },
    );
    is_wanted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_is_told_once_enough_is_done() {
        let seconds = Duration::from_secs;
        assert_eq!(left(seconds(30), 0.01), None);
        assert_eq!(left(Duration::from_millis(300), 0.5), None);
        assert_eq!(left(seconds(30), 0.25), Some(seconds(90)));
        assert_eq!([seconds(0), seconds(90), seconds(150)].map(spoken), ["1 s", "91 s", "3 min"]);
    }
}
