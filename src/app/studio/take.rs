//! Traces one picture.

use super::motion::Trails;
use super::order::{Shot, Slot, TakenPicture};
use super::pace::Effort;
use super::refracted::glass;
use super::render::{Growing, demands, lit_scene, name, planned, scene_of};
use super::undeveloped::Kept;
use crate::app::shows::Shows;
use crate::io::background::BackgroundRef;
use crate::io::{Failure, rasterize_within};
use crate::math::NotConvex;
use crate::optics::line;
use crate::picture::by_rays::{self, ScopeSampling};
use crate::picture::{DiagramStyle, Layer, Overlay, Palette, Rows, by_gpu, diagram, lay, paint};
use crate::render::RenderError;
use crate::scene::{Film, Panorama, Scope, Specimen, View};
use crate::trace::beam::{self, Beams};
use crate::trace::gpu::{Gpu, GpuError};
use crate::trace::ray;
use crate::trace::{RayTracer, Stopped, Tracer, Watch};
use egui::ColorImage;
use std::sync::Arc;

/// The largest number of bounces that rays are followed for.
pub(super) const MOST_BOUNCES: u32 = 64;

/// The weight below which rays are given up.
pub(super) const LEAST_WEIGHT: f64 = 5e-4;

/// How many times larger pixels are for rays on the processor while the hand moves, beyond what the pace says.
pub(super) const RAYS_COARSER: f64 = 3.0;

/// Why a picture was not traced.
#[derive(Debug, thiserror::Error)]
pub enum TakeError {
    /// The picture is no longer wanted.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// The card failed; rays on the processor do its work from now on.
    #[error(transparent)]
    Card(#[from] GpuError),
    /// Beams and drawings are for convex stones alone.
    #[error(transparent)]
    NotConvex(#[from] NotConvex),
    /// Any other reason, in words.
    #[error("{0}")]
    Other(String),
}

impl From<TakeError> for Failure {
    fn from(trouble: TakeError) -> Self {
        match trouble {
            TakeError::Stopped(stopped) => stopped.into(),
            TakeError::Card(error) => error.into(),
            TakeError::NotConvex(why) => Self::Usage(why.to_string()),
            TakeError::Other(why) => Self::Input(why),
        }
    }
}

impl From<RenderError> for TakeError {
    fn from(error: RenderError) -> Self {
        match error {
            RenderError::Stopped(stopped) => stopped.into(),
            RenderError::Card(error) => error.into(),
            RenderError::NotForBeams => Self::Other(error.to_string()),
        }
    }
}

/// Beams that several pictures share.
#[derive(Default)]
pub struct BeamCache(Vec<(Arc<Specimen>, View, f64, Arc<Beams>)>);

/// How many sets of beams are kept.
const MOST_KEPT: usize = 6;

impl BeamCache {
    /// Returns the beams of a stone in the light of sodium, to the bound of an effort; traces them unless they are kept.
    pub fn beams(
        &mut self,
        specimen: &Arc<Specimen>,
        view: &View,
        effort: &Effort,
        watch: Watch,
    ) -> Result<Arc<Beams>, TakeError> {
        let unresolved = effort.unresolved;
        let same = |(s, v, u, _): &&(Arc<Specimen>, View, f64, Arc<Beams>)| {
            Arc::ptr_eq(s, specimen) && v == view && *u == unresolved
        };
        if let Some((.., beams)) = self.0.iter().find(same) {
            return Ok(Arc::clone(beams));
        }
        let most_beams = effort.most_beams();
        let options = beam::BeamOptions { unresolved, most_beams, ..beam::BeamOptions::default() };
        let medium = specimen.medium(line::SODIUM_D);
        let beams = Arc::new(beam::trace(&specimen.stone()?.polytope, medium, view, &options, watch)?);
        if self.0.len() == MOST_KEPT {
            self.0.remove(0);
        }
        self.0.push((Arc::clone(specimen), *view, unresolved, Arc::clone(&beams)));
        Ok(beams)
    }

    /// Drops the beams of stones and views that are no longer wanted.
    pub fn keep(&mut self, wanted: impl Fn(&Arc<Specimen>, &View) -> bool) {
        self.0.retain(|(specimen, view, ..)| wanted(specimen, view));
    }
}

/// Traces pictures, and keeps what later pictures can use.
#[derive(Default)]
pub struct ShotTracer {
    /// The card that the window is drawn by, if it computes quicker than the processor.
    pub gpu: Option<Arc<Gpu>>,
    /// The beams that were traced.
    pub shelf: BeamCache,
    /// The last picture behind a render.
    pub(super) behind: Option<(BackgroundRef, Arc<Panorama>)>,
    /// The temporal histories of rough renders of what moves.
    pub(super) trails: Trails,
    /// The light of what each view shows, as it was traced.
    pub(super) kept: Kept,
}

impl ShotTracer {
    /// Creates a tracer with or without a card.
    pub fn by(gpu: Option<Arc<Gpu>>) -> Self {
        Self { gpu, ..Self::default() }
    }

    /// Traces a picture with an effort; an [`Effort::coarser`] of 1 is full size.
    ///
    /// With `growing` the picture is traced finely, and `each` is called with each stage of a render that grows clearer;
    /// without it the picture is a rough one.
    pub fn take(
        &mut self,
        (slot, shot): (Slot, &Shot),
        effort: &Effort,
        growing: Option<&Growing>,
        watch: Watch,
        each: &mut dyn FnMut(TakenPicture),
    ) -> Result<(), TakeError> {
        match shot.shows {
            Shows::Profile | Shows::LiquidGlass => Ok(()),
            Shows::Diagram => drawing(shot).map(each),
            Shows::Render => self.render((slot, shot), effort, growing, watch, each),
            Shows::Refraction => self.mapped((slot, shot), effort, growing, watch).map(each),
            Shows::TracedPane => glass(self, shot, effort, growing, watch).map(each),
            _ => {
                let mut taken = self.scoped(shot, effort, growing.is_some(), watch)?;
                if let Some(overlay) = shot.overlay {
                    overlaid(shot, overlay, &mut taken.image, watch)?;
                }
                each(taken);
                Ok(())
            }
        }
    }

    fn scoped(
        &mut self,
        shot: &Shot,
        effort: &Effort,
        fine: bool,
        watch: Watch,
    ) -> Result<TakenPicture, TakeError> {
        let Some(scoped) = shot.shows.scoped() else { return Err(TakeError::Other("no scope".into())) };
        let head = if scoped.takes_head { shot.head } else { 0.0 };
        let scope = scoped.scope.with_head(head);
        let card = self.gpu.clone();
        match planned(&demands(shot), card.as_deref())? {
            Tracer::Beams => self.by_beams(shot, effort, &scope, watch),
            Tracer::Rays(rays) => {
                Self::by_rays(rays, shot, effort, (&scope, if fine { 3 } else { 1 }), watch)
            }
        }
    }

    fn by_beams(
        &mut self,
        shot: &Shot,
        effort: &Effort,
        scope: &Scope,
        watch: Watch,
    ) -> Result<TakenPicture, TakeError> {
        let film = coarser(&shot.film, effort.coarser);
        let beams = self.shelf.beams(&shot.specimen, &shot.view, effort, watch)?;
        let layer = if shot.strongest {
            Layer::strongest(&beams, scope)
        } else {
            Layer::energy(&beams, scope, shot.glare)
        };
        let mut canvas = Canvas::new(&film, scope, 0);
        paint(&layer, &film, watch, |rows| -> Result<(), TakeError> { canvas.take(rows) })?;
        Ok(canvas.finish(Some(beams.unresolved()), "exact beams"))
    }

    fn by_rays(
        rays: RayTracer,
        shot: &Shot,
        effort: &Effort,
        (scope, per_side): (&Scope, u32),
        watch: Watch,
    ) -> Result<TakenPicture, TakeError> {
        let slower = if matches!(rays, RayTracer::Rays) && per_side == 1 { RAYS_COARSER } else { 1.0 };
        let film = coarser(&shot.film, effort.coarser * slower);
        let options =
            ray::RayOptions { most_bounces: MOST_BOUNCES, least_weight: LEAST_WEIGHT, polarised: true };
        let manner = ScopeSampling { options, per_side, glare: shot.glare };
        let (solid, medium) = (shot.specimen.solid(), shot.specimen.medium(line::SODIUM_D));
        let first = if shot.strongest { scope.bands.len() } else { 0 };
        let mut canvas = Canvas::new(&film, scope, first);
        let each = |rows: &Rows| canvas.take(rows);
        let view = &shot.view;
        match rays {
            RayTracer::Card(gpu) => {
                by_gpu::trace(gpu, solid, medium, view, scope, &film, &manner, watch, each)?;
            }
            RayTracer::Rays => {
                by_rays::trace(solid, medium, view, scope, &film, &manner, watch, each)?;
            }
        }
        Ok(canvas.finish(None, name(Tracer::Rays(rays))))
    }
}

/// Returns the same film with larger pixels.
pub(super) fn coarser(film: &Film, factor: f64) -> Film {
    let size = film.size.map(|n| ((f64::from(n) / factor).ceil() as u32).max(1));
    Film { size, pixel: film.pixel * f64::from(film.size[0]) / f64::from(size[0]), ..*film }
}

/// Draws an overlay over the picture of a shot.
pub(super) fn overlaid(
    shot: &Shot,
    overlay: Overlay,
    image: &mut ColorImage,
    watch: Watch,
) -> Result<(), Stopped> {
    let scene = scene_of(shot);
    let [across, down] = image.size.map(|n| n as u32);
    let pixel = shot.film.pixel * f64::from(shot.film.size[0]) / f64::from(across);
    let film = Film { size: [across, down], pixel, ..shot.film };
    let mut rgba: Vec<u8> = image.pixels.iter().flat_map(|p| p.to_srgba_unmultiplied()).collect();
    lay(overlay, &lit_scene(shot, &scene, film, None), &mut rgba, watch)?;
    *image = ColorImage::from_rgba_unmultiplied(image.size, &rgba);
    Ok(())
}

fn drawing(shot: &Shot) -> Result<TakenPicture, TakeError> {
    let stone = shot.specimen.stone()?;
    let style = match shot.paper.pixels_per_point.map(f64::from) {
        Some(scale) => {
            let points = shot.film.size.map(|pixels| f64::from(pixels) / scale);
            DiagramStyle::fitting(stone, shot.paper.inks, points)
        }
        None => DiagramStyle::sheet(shot.paper.inks),
    };
    let text = diagram(stone, &shot.title, &style).to_string();
    let (width, height, rgba) =
        rasterize_within(&text, shot.film.size).map_err(|e| TakeError::Other(e.to_string()))?;
    let image = ColorImage::from_rgba_unmultiplied([width as usize, height as usize], &rgba);
    Ok(TakenPicture { image, unresolved: None, tracer: "drawn", map: None })
}

/// Collects the rows of a picture in a scope as they are traced.
struct Canvas {
    palette: Palette,
    first: usize,
    size: [usize; 2],
    pixels: Vec<u8>,
}

impl Canvas {
    fn new(film: &Film, scope: &Scope, first: usize) -> Self {
        let size = film.size.map(|n| n as usize);
        Self { palette: Palette::of(scope), first, size, pixels: Vec::with_capacity(3 * size[0] * size[1]) }
    }

    fn take(&mut self, rows: &Rows) -> Result<(), TakeError> {
        let Self { palette, first, pixels, .. } = self;
        (rows.first..rows.first + rows.count).for_each(|y| palette.encode(rows, *first, y, pixels));
        Ok(())
    }

    fn finish(self, unresolved: Option<f64>, tracer: &'static str) -> TakenPicture {
        TakenPicture { image: ColorImage::from_rgb(self.size, &self.pixels), unresolved, tracer, map: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::liquid::Liquid;
    use crate::app::model::document::Document;
    use crate::app::model::eye::Eye;
    use crate::app::model::framing::FramingFit;
    use crate::app::studio::order::{Paper, Smoothing, Which};
    use crate::app::studio::render::BEHIND;
    use crate::io::lighting::Lighting;
    use crate::scene::{Glare, Pose, Projection};
    use crate::trace::unwatched;
    use glam::DVec2;
    use std::path::Path;

    fn shot(shows: Shows, distance: Option<f64>) -> Shot {
        let eye = Eye { lean: DVec2::new(0.1, 0.05), ..Eye::default() };
        let projection =
            distance.map_or(Projection::Orthographic, |distance| Projection::Perspective { distance });
        Shot {
            specimen: Arc::clone(Document::first().unwrap().specimen()),
            title: String::new(),
            shows,
            strongest: false,
            glare: Glare::Included,
            view: View { projection, ..eye.view(None) },
            film: eye.film([56, 40], &FramingFit::reaching(1.0)),
            whole: FramingFit::reaching(1.0).film([56, 40]),
            light: Arc::new(Lighting::load("dome").unwrap()),
            bands: 16,
            jitter: true,
            behind: None,
            strength: 1.0,
            company: vec![Pose::STILL],
            distance: BEHIND,
            smoothing: Smoothing::None,
            exposure: 0.0,
            head: 0.0,
            overlay: None,
            liquid: Liquid::default(),
            paper: Paper::default(),
        }
    }

    #[test]
    fn exports_take_as_many_passes_as_the_command_line() {
        let passes = |shot: &Shot| crate::app::studio::exported(shot).looks;
        assert_eq!(passes(&shot(Shows::Render, None)), 4, "exact beams");
        assert_eq!(passes(&shot(Shows::Render, Some(8.0))), 64, "rays, for a perspective");
        let before = |name: &str| {
            let behind = BackgroundRef::read(name, Path::new("")).unwrap();
            passes(&Shot { behind: Some(behind), ..shot(Shows::Render, None) })
        };
        assert_eq!(before("page"), 64, "rays, for what hangs behind");
        assert_eq!(["light", "white"].map(before), [4, 4], "exact beams, as nothing hangs behind");
    }

    fn taken(camera: &mut ShotTracer, shot: &Shot, growing: Option<&Growing>) -> TakenPicture {
        let mut last = None;
        let effort = Effort { unresolved: 5e-3, coarser: 1.0, bands: 4 };
        camera
            .take(((0, Which::Present), shot), &effort, growing, &unwatched, &mut |taken| last = Some(taken))
            .unwrap();
        last.unwrap()
    }

    /// The mean difference of two pictures' channels, as a fraction of full scale.
    fn apart(a: &TakenPicture, b: &TakenPicture) -> f64 {
        assert_eq!(a.image.size, b.image.size);
        let codes = |t: &TakenPicture| t.image.pixels.iter().flat_map(|p| p.to_array()).collect::<Vec<u8>>();
        let (a, b) = (codes(a), codes(b));
        let sum: f64 = a.iter().zip(&b).map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
        sum / (255.0 * a.len() as f64)
    }

    #[test]
    #[expect(clippy::print_stdout, reason = "what is skipped is told")]
    fn a_card_shows_what_the_processor_shows() {
        let gpu = match Gpu::open() {
            Ok(gpu) => Arc::new(gpu),
            Err(error) => {
                assert!(std::env::var_os("BRILLIANTEER_REQUIRE_GPU").is_none(), "{error}");
                println!("SKIPPED a_card_shows_what_the_processor_shows: {error}");
                return;
            }
        };
        let mut card = ShotTracer::by(Some(gpu));
        let growing = Growing { bands: 4, looks: 16, after: 0, unresolved: 5e-3 };
        let checks = BackgroundRef::read("checks", Path::new("")).unwrap();
        let mixed = Shot { behind: Some(checks), strength: 0.2, ..shot(Shows::Render, None) };
        for (shot, most) in [
            (shot(Shows::Aset, Some(8.0)), 2e-3),
            (shot(Shows::Render, Some(8.0)), 4e-3),
            (shot(Shows::Render, None), 7e-3),
            (mixed, 4e-3),
        ] {
            let (shows, projection) = (shot.shows, shot.view.projection);
            let [a, b] = [&mut card, &mut ShotTracer::default()].map(|c| taken(c, &shot, Some(&growing)));
            assert_ne!(a.tracer, b.tracer);
            let other = Shot { view: Eye::default().view(None), ..shot.clone() };
            let (off, wrong) = (apart(&a, &b), apart(&taken(&mut card, &other, Some(&growing)), &b));
            assert!(
                off < most && wrong > 3.0 * most,
                "{shows:?} {projection:?}: {off}, and {wrong} of another view"
            );
        }
    }

    #[test]
    fn under_a_new_name_it_is_another_drawing_and_the_same_light() {
        for (shows, is_same) in [(Shows::Diagram, false), (Shows::Aset, true), (Shows::Render, true)] {
            let shot = shot(shows, None);
            let renamed = Shot { title: "another".to_owned(), ..shot.clone() };
            assert_eq!(shot == renamed, is_same, "{shows:?}");
        }
    }

    #[test]
    fn a_rough_render_looks_like_the_fine_one() {
        let shot = shot(Shows::Render, None);
        let growing = Growing { bands: 16, looks: 4, after: 0, unresolved: 2e-3 };
        let mut camera = ShotTracer::default();
        let (rough, fine) = (taken(&mut camera, &shot, None), taken(&mut camera, &shot, Some(&growing)));
        let off = apart(&rough, &fine);
        assert!(off < 0.03, "{off}");
    }
}
