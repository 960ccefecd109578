//! Writes the files of an export, one after the other, and makes thumbnails of what can be exported.

use super::copying::drawn;
use super::export_scene::SceneOut;
use crate::model::export::ExportPlan;
use crate::model::exporting::ExportEvent;
use crate::pixels::Pixels;
use crate::shows::Shows;
use crate::studio::{Effort, ExportedRender, Grain, SPAN, ShotTracer, Which, survey};
use brillianteer_base::{Failure, Watch};
use brillianteer_paper::export::{Event, Export, OutputFormat, Outputs};
use brillianteer_paper::refraction::{self, Coding, Page, takes, write_page};
use brillianteer_render::{Renderer, mixture_note};
use brillianteer_scene::BackgroundRef;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

/// The side of a thumbnail, pixels.
const THUMBNAIL: u32 = 176;

/// The effort of a render relative to that of a picture in a scope, roughly.
const RENDER: f64 = 4.0;

/// Reports the progress of an export.
struct Progress<'a> {
    report: &'a (dyn Fn(ExportEvent) + Sync),
    is_stopped: &'a (dyn Fn() -> bool + Sync),
    begun: Instant,
    /// The part that was reported last, in thousandths.
    reported: AtomicU64,
}

impl Progress<'_> {
    /// Reports the part done, 0 to 1, if it has grown enough.
    fn at(&self, done: f64) -> ControlFlow<()> {
        let thousandths = (1000.0 * done) as u64;
        if self.reported.swap(thousandths, Ordering::Relaxed) != thousandths {
            (self.report)(ExportEvent::Done(done, self.begun.elapsed()));
        }
        if (self.is_stopped)() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn hear(&self, event: &Event) {
        match event {
            Event::Begun(_) => {}
            Event::Written(path) => (self.report)(ExportEvent::Written(path.to_path_buf())),
            Event::Note(text) | Event::Warning(text) => (self.report)(ExportEvent::Said((*text).to_owned())),
        }
    }
}

impl ExportPlan {
    /// Writes all files, one after the other.
    fn write(&self, progress: &Progress) -> Result<(), Failure> {
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
            let export = Export { viewing: *viewing, outputs };
            export.write(&mut Renderer::default(), &watch, &|event| {
                progress.hear(&event);
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
        if self.writes_sheet() {
            self.write_sheet()?.iter().for_each(|path| progress.hear(&Event::Written(path)));
        }
        if self.selection.scene {
            SceneOut::of(self).write()?;
            self.scene_paths().iter().for_each(|path| progress.hear(&Event::Written(path)));
        }
        Ok(())
    }

    fn write_map(
        &self,
        maps: &[PathBuf],
        [diffuse, page]: &[PathBuf; 2],
        watch: Watch,
    ) -> Result<(), Failure> {
        let (map, carried) = survey(
            &self.shot(Shows::Refraction, self.selection.size),
            [self.selection.bands, self.selection.places],
            watch,
        )?;
        let title = self.shot.title.as_str();
        let description = format!(
            "{title}; refraction map, bands {}, places {}; light {}; {:.1} % of the light comes from the background, {:.1} % of that from the \
             map's places",
            self.selection.bands,
            self.selection.places,
            self.shot.light.name(),
            100.0 * carried.behind,
            100.0 * carried.single
        );
        refraction::write_places(maps, &map, Coding::Tiles, &description)?;
        refraction::write_diffuse(diffuse, &map, &description)?;
        let behind =
            self.shot.look.background.as_ref().map(brillianteer_paper::background::bytes).transpose()?;
        let background = behind.flatten().filter(|bytes| takes(bytes));
        let ground = self.shot.look.background.as_ref().map_or_else(String::new, BackgroundRef::title);
        let background = background.as_deref().map(|bytes| (ground.as_str(), bytes));
        Ok(write_page(page, &map, &Page { title, description: &description, span: SPAN, background })?)
    }

    fn render(&self, path: &Path, watch: Watch) -> Result<(), Failure> {
        let shot = self.shot(Shows::Render, self.selection.size);
        let mut render = ShotTracer::default().export(&shot, watch)?;
        let ExportedRender { tracer, unresolved, .. } = render;
        let description = format!(
            "{}: render; light {}{}; {tracer}, unresolved {unresolved:.2e}",
            self.shot.title,
            self.shot.light.name(),
            mixture_note(self.shot.look.strength)
        );
        render.write(&shot, path, &description, watch)
    }
}

/// Writes the files of a plan; `report` gets the progress, and `is_stopped` says whether to stop.
pub fn run(plan: &ExportPlan, report: &(dyn Fn(ExportEvent) + Sync), is_stopped: &(dyn Fn() -> bool + Sync)) {
    let progress = Progress { report, is_stopped, begun: Instant::now(), reported: AtomicU64::new(0) };
    let end = plan.write(&progress);
    report(ExportEvent::Ended(end));
}

/// Makes thumbnails of all views, one after the other, until it is stopped.
pub fn thumbnails(plan: &ExportPlan, hang: &dyn Fn(Shows, Pixels), is_stopped: &(dyn Fn() -> bool + Sync)) {
    let mut tracer = ShotTracer::default();
    let effort = Effort::rough(2e-2, Grain { coarser: 1.0, bands: 6 });
    let watch = |_: f64| if is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    for shows in plan.can_be_shown().take_while(|_| !is_stopped()) {
        if shows == Shows::Profile {
            drawn(&plan.upright, 2 * THUMBNAIL).into_iter().for_each(|image| hang(shows, image));
            continue;
        }
        let shot = plan.shot(shows, THUMBNAIL);
        // A thumbnail that cannot be made stays empty; the export reports the reason.
        let _ = tracer.take(((0, Which::Present), &shot), &effort, &watch, &mut |taken| {
            hang(shows, taken.image);
        });
    }
}
