//! Takes one picture.

use super::order::{Shot, Taken};
use super::pace::Effort;
use crate::app::shows::Shows;
use crate::io::background::BackgroundRef;
use crate::io::{Failure, rasterize};
use crate::math::NotConvex;
use crate::optics::{Stratum, line, strata};
use crate::picture::by_rays::{self, Manner};
use crate::picture::{
    Bloom, ByBeams, Develop, Layer, Linear, Overlay, Palette, Rows, by_gpu, develop, diagram, lay, paint,
    spectral,
};
use crate::scene::{Film, Panorama, Placed, Projection, Scope, Setting, Specimen, View};
use crate::trace::beam::{self, Beams};
use crate::trace::gpu::{Around, ByCard, Gpu, GpuError};
use crate::trace::ray::{self, ByRays};
use crate::trace::sitting::{Exposure, Looks, Sitting};
use crate::trace::surround::{Behind, Surround};
use crate::trace::{Stopped, Watch};
use egui::ColorImage;
use std::sync::Arc;

/// Bounces that rays are followed for.
const MOST_BOUNCES: u32 = 64;

/// Below this weight rays are given up.
const LEAST_WEIGHT: f64 = 5e-4;

/// How much coarser rays on the processor see while the hand moves, beyond what the pace says.
const RAYS_COARSER: f64 = 3.0;

/// Beams of one wavelength of a render: without symmetry the bound would take many times as long.
const MOST_BEAMS: usize = 100_000;

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum Trouble {
    /// It was asked for no longer.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// The card failed; rays on the processor do its work from now on.
    #[error(transparent)]
    Card(#[from] GpuError),
    /// Beams and drawings are for other stones.
    #[error(transparent)]
    NotConvex(#[from] NotConvex),
    /// What else.
    #[error("{0}")]
    Other(String),
}

impl From<Trouble> for Failure {
    fn from(trouble: Trouble) -> Self {
        match trouble {
            Trouble::Stopped(stopped) => stopped.into(),
            Trouble::Card(error) => error.into(),
            Trouble::NotConvex(why) => Self::Usage(why.to_string()),
            Trouble::Other(why) => Self::Input(why),
        }
    }
}

/// Beams that several pictures share.
#[derive(Default)]
pub struct Shelf(Vec<(Arc<Specimen>, View, f64, Arc<Beams>)>);

/// Sets of beams kept.
const MOST_KEPT: usize = 6;

impl Shelf {
    /// The beams of a stone in sodium's light, to a bound.
    pub fn beams(
        &mut self,
        specimen: &Arc<Specimen>,
        view: &View,
        effort: &Effort,
        watch: Watch,
    ) -> Result<Arc<Beams>, Trouble> {
        let unresolved = effort.unresolved;
        let same = |(s, v, u, _): &&(Arc<Specimen>, View, f64, Arc<Beams>)| {
            Arc::ptr_eq(s, specimen) && v == view && *u == unresolved
        };
        if let Some((.., beams)) = self.0.iter().find(same) {
            return Ok(Arc::clone(beams));
        }
        let most_beams = effort.most_beams();
        let options = beam::Options { unresolved, most_beams, ..beam::Options::default() };
        let medium = specimen.medium(line::SODIUM_D);
        let beams = Arc::new(beam::trace(&specimen.stone()?.polytope, medium, view, &options, watch)?);
        if self.0.len() == MOST_KEPT {
            self.0.remove(0);
        }
        self.0.push((Arc::clone(specimen), *view, unresolved, Arc::clone(&beams)));
        Ok(beams)
    }

    /// Lets go of the beams of stones and views that are no longer asked for.
    pub fn keep(&mut self, wanted: impl Fn(&Arc<Specimen>, &View) -> bool) {
        self.0.retain(|(specimen, view, ..)| wanted(specimen, view));
    }
}

/// What takes pictures.
#[derive(Default)]
pub struct Camera {
    /// The card that the window is drawn by, if it computes quicker than the processor.
    pub gpu: Option<Arc<Gpu>>,
    /// Beams taken.
    pub shelf: Shelf,
    /// The picture that hung behind last.
    behind: Option<(BackgroundRef, Arc<Panorama>)>,
}

/// A render that grows clearer.
pub struct Growing {
    /// Bands of wavelengths of each look, at most.
    pub bands: u32,
    /// Looks.
    pub looks: u32,
    /// Share of the light that may stay unresolved.
    pub unresolved: f64,
}

impl Camera {
    /// One that has a card, or none.
    pub fn by(gpu: Option<Arc<Gpu>>) -> Self {
        Self { gpu, ..Self::default() }
    }

    /// Takes a picture with an effort; `Effort::coarser` of 1 is at full size. `growing` says that a render is to be taken
    /// as it will be exported, and `each` is called with what there is of it so far.
    pub fn take(
        &mut self,
        shot: &Shot,
        effort: &Effort,
        growing: Option<&Growing>,
        watch: Watch,
        each: &mut dyn FnMut(Taken),
    ) -> Result<(), Trouble> {
        match shot.shows {
            Shows::Profile => Ok(()),
            Shows::Diagram => drawing(shot).map(each),
            Shows::Render => self.render(shot, effort, growing, watch, each),
            _ => {
                let taken = self.scoped(shot, effort, growing.is_some(), watch)?;
                each(self.overlaid(shot, taken, watch)?);
                Ok(())
            }
        }
    }

    fn scoped(&mut self, shot: &Shot, effort: &Effort, fine: bool, watch: Watch) -> Result<Taken, Trouble> {
        let Some(scoped) = shot.shows.scoped() else { return Err(Trouble::Other("no scope".into())) };
        let head = if scoped.takes_head { shot.head } else { 0.0 };
        let scope = scoped.scope.with_head(head);
        if is_for_beams(shot) {
            return self.by_beams(shot, effort, &scope, watch);
        }
        self.by_rays(shot, effort, (&scope, if fine { 3 } else { 1 }), watch)
    }

    fn by_beams(
        &mut self,
        shot: &Shot,
        effort: &Effort,
        scope: &Scope,
        watch: Watch,
    ) -> Result<Taken, Trouble> {
        let film = coarser(&shot.film, effort.coarser);
        let beams = self.shelf.beams(&shot.specimen, &shot.view, effort, watch)?;
        let layer =
            if shot.strongest { Layer::strongest(&beams, scope) } else { Layer::energy(&beams, scope) };
        let mut canvas = Canvas::new(&film, scope, 0);
        paint(&layer, &film, watch, |rows| -> Result<(), Trouble> { canvas.take(rows) })?;
        Ok(canvas.finish(Some(beams.unresolved()), "exact beams"))
    }

    fn by_rays(
        &mut self,
        shot: &Shot,
        effort: &Effort,
        (scope, per_side): (&Scope, u32),
        watch: Watch,
    ) -> Result<Taken, Trouble> {
        let slower = if self.gpu.is_none() && per_side == 1 { RAYS_COARSER } else { 1.0 };
        let film = coarser(&shot.film, effort.coarser * slower);
        let options =
            ray::Options { most_bounces: MOST_BOUNCES, least_weight: LEAST_WEIGHT, polarised: true };
        let manner = Manner { options, per_side };
        let (solid, medium) = (shot.specimen.solid(), shot.specimen.medium(line::SODIUM_D));
        let first = if shot.strongest { scope.bands.len() } else { 0 };
        let mut canvas = Canvas::new(&film, scope, first);
        let each = |rows: &Rows| canvas.take(rows);
        let view = &shot.view;
        let tracer = match &self.gpu {
            Some(gpu) => {
                by_gpu::trace(gpu, solid, medium, view, scope, &film, &manner, watch, each)?;
                "rays on the graphics card"
            }
            None => {
                by_rays::trace(solid, medium, view, scope, &film, &manner, watch, each)?;
                "point rays"
            }
        };
        Ok(canvas.finish(None, tracer))
    }

    fn render(
        &mut self,
        shot: &Shot,
        effort: &Effort,
        growing: Option<&Growing>,
        watch: Watch,
        each: &mut dyn FnMut(Taken),
    ) -> Result<(), Trouble> {
        let setting = setting(shot);
        let flat = is_for_beams(shot);
        let behind = self.picture_behind(shot)?;
        let by_card = self.gpu.clone().filter(|_| growing.is_some() || !flat);
        let slower = if by_card.is_none() && !flat && growing.is_none() { RAYS_COARSER } else { 1.0 };
        let mut film = coarser(&shot.film, effort.coarser * slower);
        if by_card.is_some() && film.size[1] > ByCard::most_rows(film.size[0]) {
            film = coarser(&film, 2.0);
        }
        let sitting = sitting(shot, &setting, film, behind.as_deref());
        let bands = growing.map_or(effort.bands, |g| g.bands).min(shot.bands);
        let strata = strata(bands, &shot.light.light.spectrum, true);
        let develop = |picture: &Linear, unresolved, tracer| {
            developed(shot, (picture, growing.is_some()), (unresolved, tracer), &sitting, watch)
        };
        let manner = Looks { count: 1, jitter: shot.jitter, strength: shot.strength };
        let work = Work { sitting: &sitting, strata: &strata, manner, growing, watch };
        match by_card {
            Some(gpu) => {
                let around = Around::new(&gpu, &sitting.surround);
                let rows = 0..film.size[1];
                let exposure = ByCard::new(&gpu, &sitting, &around, rows, strata.len())?;
                work.grow(exposure, |p, u| develop(p, u, "rays on the graphics card").map(&mut *each))
            }
            None if flat => {
                let unresolved = growing.map_or(effort.unresolved, |g| g.unresolved);
                let options =
                    beam::Options { unresolved, most_beams: MOST_BEAMS, ..beam::Options::default() };
                let Some(mut exposure) = ByBeams::new(sitting, options) else {
                    return Err(Trouble::Other("exact beams do not apply here".into()));
                };
                if growing.is_some() {
                    return work.grow(exposure, |p, u| develop(p, u, "exact beams").map(&mut *each));
                }
                exposure.glance(&strata, watch)?;
                let (picture, rest) = spectral::seen::<Trouble, _>(&sitting, &exposure)?;
                develop(&picture, rest.unresolved, "exact beams").map(each)
            }
            None => {
                let exposure = ByRays::new(sitting, 0..film.size[1]);
                work.grow(exposure, |p, u| develop(p, u, "point rays").map(&mut *each))
            }
        }
    }

    /// The picture behind a render, read or drawn once.
    fn picture_behind(&mut self, shot: &Shot) -> Result<Option<Arc<Panorama>>, Trouble> {
        let Some(asked) = &shot.behind else { return Ok(None) };
        if let Some((_, picture)) = self.behind.as_ref().filter(|(last, _)| last == asked) {
            return Ok(Some(Arc::clone(picture)));
        }
        let read = asked.picture().map_err(Trouble::Other)?;
        let picture = read.map(|reading| Arc::new(reading.panorama));
        self.behind = picture.clone().map(|picture| (asked.clone(), picture));
        Ok(picture)
    }

    fn overlaid(&self, shot: &Shot, mut taken: Taken, watch: Watch) -> Result<Taken, Trouble> {
        let Some(overlay) = shot.overlay else { return Ok(taken) };
        let setting = setting(shot);
        let [across, down] = taken.image.size.map(|n| n as u32);
        let pixel = shot.film.pixel * f64::from(shot.film.size[0]) / f64::from(across);
        let film = Film { size: [across, down], pixel, ..shot.film };
        over(overlay, &sitting(shot, &setting, film, None), &mut taken.image, watch)?;
        Ok(taken)
    }
}

/// Whether exact beams show it: a convex stone by parallel rays, and no picture behind it.
fn is_for_beams(shot: &Shot) -> bool {
    let is_behind = shot.shows == Shows::Render && shot.behind.is_some();
    !is_behind && shot.view.projection == Projection::Orthographic && shot.specimen.stone().is_ok()
}

/// Looks to be added up.
struct Work<'a> {
    sitting: &'a Sitting<'a>,
    strata: &'a [Stratum],
    manner: Looks,
    growing: Option<&'a Growing>,
    watch: Watch<'a>,
}

impl Work<'_> {
    /// Adds look to look, and hands on what there is after the first, the second, the fourth and so on.
    fn grow<X: Exposure<Trouble>>(
        &self,
        mut exposure: X,
        mut each: impl FnMut(&Linear, f64) -> Result<(), Trouble>,
    ) -> Result<(), Trouble> {
        let looks = self.growing.map_or(1, |g| g.looks);
        for number in 0..looks {
            let done = |part: f64| (self.watch)((f64::from(number) + part) / f64::from(looks));
            exposure.look(&self.manner.look(self.sitting.setting, self.strata, number), &done)?;
            if (number + 1).is_power_of_two() || number + 1 == looks {
                let (picture, rest) = spectral::seen(self.sitting, &exposure)?;
                each(&picture, rest.unresolved)?;
            }
        }
        Ok(())
    }
}

/// The same film with larger pixels.
fn coarser(film: &Film, factor: f64) -> Film {
    let size = film.size.map(|n| ((f64::from(n) / factor).ceil() as u32).max(1));
    Film { size, pixel: film.pixel * f64::from(film.size[0]) / f64::from(size[0]), ..*film }
}

/// How far behind the stone a picture hangs, girdle radii.
pub const BEHIND: f64 = 3.0;

/// How much larger than in the image's plane a picture must be to fill it from there.
pub fn nearness(view: &View) -> f64 {
    match view.projection {
        Projection::Orthographic => 1.0,
        Projection::Perspective { distance } => (distance + BEHIND) / distance,
    }
}

/// What a shot is taken of.
pub fn setting(shot: &Shot) -> Setting {
    let stone = Placed::named(&shot.specimen.body, shot.specimen.material.clone(), "");
    Setting { stones: vec![stone], unit_mm: shot.specimen.unit_mm() }
}

/// A stone under its light, and the camera.
pub fn sitting<'a>(
    shot: &'a Shot,
    setting: &'a Setting,
    film: Film,
    picture: Option<&'a Panorama>,
) -> Sitting<'a> {
    let behind = picture.map(|picture| {
        let [across, down] = film.size.map(f64::from);
        let shape = f64::from(picture.width) / f64::from(picture.height);
        // Wide enough to fill the view, whatever its shape.
        let width = film.pixel * across.max(down * shape) * nearness(&shot.view);
        Behind { picture, distance: BEHIND, width }
    });
    Sitting {
        setting,
        surround: Surround {
            sky: &shot.light.sky,
            basis: shot.view.light_basis(),
            eye: shot.view.basis(),
            head: shot.light.light.head.to_radians(),
            behind,
            backdrop: behind.is_some(),
        },
        view: &shot.view,
        film,
        options: ray::Options { polarised: true, most_bounces: MOST_BOUNCES, least_weight: LEAST_WEIGHT },
    }
}

fn developed(
    shot: &Shot,
    (picture, fine): (&Linear, bool),
    (unresolved, tracer): (f64, &'static str),
    sitting: &Sitting,
    watch: Watch,
) -> Result<Taken, Trouble> {
    // Glow would stand out around what is drawn over the stone, and it takes longer than the rest of a rough picture.
    let bloom = (fine && shot.overlay.is_none()).then(Bloom::default);
    let manner = Develop { exposure: shot.exposure, bloom, ..Develop::default() };
    let rgba = develop(picture, &manner);
    let size = [picture.width as usize, picture.height as usize];
    let mut image = ColorImage::from_rgba_unmultiplied(size, &rgba);
    if let Some(overlay) = shot.overlay {
        over(overlay, sitting, &mut image, watch)?;
    }
    Ok(Taken { image, unresolved: Some(unresolved), tracer })
}

fn over(overlay: Overlay, sitting: &Sitting, image: &mut ColorImage, watch: Watch) -> Result<(), Stopped> {
    let mut rgba: Vec<u8> = image.pixels.iter().flat_map(|p| p.to_srgba_unmultiplied()).collect();
    lay(overlay, sitting, &mut rgba, watch)?;
    *image = ColorImage::from_rgba_unmultiplied(image.size, &rgba);
    Ok(())
}

fn drawing(shot: &Shot) -> Result<Taken, Trouble> {
    let text = diagram(shot.specimen.stone()?, &shot.specimen.design.name).to_string();
    let (width, height, rgb) =
        rasterize(&text, shot.film.size[0]).map_err(|e| Trouble::Other(e.to_string()))?;
    let image = ColorImage::from_rgb([width as usize, height as usize], &rgb);
    Ok(Taken { image, unresolved: None, tracer: "drawn" })
}

/// Rows of a scope, as they come in.
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

    fn take(&mut self, rows: &Rows) -> Result<(), Trouble> {
        let Self { palette, first, pixels, .. } = self;
        (rows.first..rows.first + rows.count).for_each(|y| palette.encode(rows, *first, y, pixels));
        Ok(())
    }

    fn finish(self, unresolved: Option<f64>, tracer: &'static str) -> Taken {
        Taken { image: ColorImage::from_rgb(self.size, &self.pixels), unresolved, tracer }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::document::Document;
    use crate::app::eye::Eye;
    use crate::io::lighting::Lighting;
    use crate::trace::unwatched;
    use glam::DVec2;
    use std::path::Path;

    fn shot(shows: Shows, distance: Option<f64>) -> Shot {
        let eye = Eye { lean: DVec2::new(0.1, 0.05), distance, ..Eye::default() };
        Shot {
            specimen: Arc::clone(Document::first().unwrap().specimen()),
            shows,
            strongest: false,
            view: eye.view(None),
            film: eye.film([56, 40], 1.0),
            light: Arc::new(Lighting::load("dome").unwrap()),
            bands: 16,
            jitter: true,
            behind: None,
            strength: 1.0,
            exposure: 0.0,
            head: 0.0,
            overlay: None,
        }
    }

    fn taken(camera: &mut Camera, shot: &Shot, growing: Option<&Growing>) -> Taken {
        let mut last = None;
        let effort = Effort { unresolved: 5e-3, coarser: 1.0, bands: 4 };
        camera.take(shot, &effort, growing, &unwatched, &mut |taken| last = Some(taken)).unwrap();
        last.unwrap()
    }

    /// The mean difference of two pictures' channels, in parts of full scale.
    fn apart(a: &Taken, b: &Taken) -> f64 {
        assert_eq!(a.image.size, b.image.size);
        let codes = |t: &Taken| t.image.pixels.iter().flat_map(|p| p.to_array()).collect::<Vec<u8>>();
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
        let mut card = Camera::by(Some(gpu));
        let growing = Growing { bands: 4, looks: 16, unresolved: 5e-3 };
        let checks = BackgroundRef::read("checks", Path::new("")).unwrap();
        let mixed = Shot { behind: Some(checks), strength: 0.2, ..shot(Shows::Render, None) };
        for (shot, most) in [
            (shot(Shows::Aset, Some(8.0)), 2e-3),
            (shot(Shows::Render, Some(8.0)), 4e-3),
            (shot(Shows::Render, None), 7e-3),
            (mixed, 4e-3),
        ] {
            let (shows, projection) = (shot.shows, shot.view.projection);
            let [a, b] = [&mut card, &mut Camera::default()].map(|c| taken(c, &shot, Some(&growing)));
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
    fn a_rough_render_looks_like_the_fine_one() {
        let shot = shot(Shows::Render, None);
        let growing = Growing { bands: 16, looks: 4, unresolved: 2e-3 };
        let mut camera = Camera::default();
        let (rough, fine) = (taken(&mut camera, &shot, None), taken(&mut camera, &shot, Some(&growing)));
        let off = apart(&rough, &fine);
        assert!(off < 0.03, "{off}");
    }
}
