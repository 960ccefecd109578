//! Traces one picture.

use super::backgrounds::Backgrounds;
use super::develop::{developed, map_taken, overlaid};
use super::effort::Effort;
use super::jobs::coarser;
use super::motion::Trails;
use super::order::{Shot, Slot, TakenPicture};
use super::undeveloped::{Kept, TracedLight};
use crate::pixels::Pixels;
use crate::shows::ShowsKind;
use brillianteer_base::{Failure, Watch};
use brillianteer_paper::rasterize_within;
use brillianteer_picture::{DiagramStyle, Palette, Picture, Scoped, marked_diagram};
use brillianteer_render::{Card, Partial, RenderError, Renderer};

/// Traces pictures, and keeps the data that later pictures can use.
#[derive(Default)]
pub struct ShotTracer {
    /// The renderer that does the jobs of shots.
    pub(super) renderer: Renderer,
    /// Messages for the user about why the processor does a card's work.
    pub(super) notes: Vec<String>,
    /// The pictures behind renders.
    pub(super) backgrounds: Backgrounds,
    /// The temporal histories of rough renders of moving bodies.
    pub(super) trails: Trails,
    /// The traced light of each view before it is developed.
    pub(super) kept: Kept,
}

impl ShotTracer {
    /// Creates a tracer that may use a card.
    pub fn by(card: Card) -> Self {
        Self { renderer: Renderer::new(card), ..Self::default() }
    }

    /// Traces a picture with an effort, and calls `each` with each stage of a render that grows clearer. Only a rough picture
    /// is traced under a coarse light.
    pub fn take(
        &mut self,
        (slot, shot): (Slot, &Shot),
        effort: &Effort,
        watch: Watch,
        each: &mut dyn FnMut(TakenPicture),
    ) -> Result<(), Failure> {
        let shot = if effort.is_refined() { &*shot.under_whole_light(watch)? } else { shot };
        match shot.shows.kind() {
            ShowsKind::Picture(Picture::Profile) | ShowsKind::LiquidGlass => Ok(()),
            ShowsKind::Picture(Picture::Diagram) => drawing(shot).map(each),
            ShowsKind::Picture(Picture::Scoped(scoped)) => {
                self.scoped(shot, &scoped, effort, watch).map(each)
            }
            ShowsKind::Picture(Picture::Contrast) => self.contrast(shot, effort, watch).map(each),
            ShowsKind::Render => self.render((slot, shot), effort, watch, each),
            ShowsKind::Refraction => self.mapped((slot, shot), effort, watch).map(each),
            ShowsKind::TracedPane => self.glass(shot, effort, watch).map(each),
        }
    }

    /// Makes the picture of a shot from light that was traced for another shot; `None` where no such light is kept.
    ///
    /// # Errors
    /// Returns [`Failure::Stopped`] where `watch` asks to stop; only overlays ask it.
    pub fn develop_again(
        &self,
        slot: Slot,
        shot: &Shot,
        watch: Watch,
    ) -> Option<Result<TakenPicture, Failure>> {
        let (_, light) = self.kept.get(&slot).filter(|(kept, _)| kept.has_light_of(shot))?;
        Some(match light {
            TracedLight::Render { picture, unresolved, tracer } => {
                developed(shot, (picture, true), (*unresolved, tracer), watch).map_err(Failure::from)
            }
            TracedLight::Map(map) => Ok(map_taken(shot, map.clone())),
        })
    }

    fn contrast(&mut self, shot: &Shot, effort: &Effort, watch: Watch) -> Result<TakenPicture, Failure> {
        let job = shot.contrast_job(effort);
        let film = coarser(&shot.film, effort.grain.coarser);
        let rendered = self.renderer.run(&job, watch, &mut |_| Ok::<_, Failure>(()))?;
        let (tracer, taken) = (rendered.backend.kind(), rendered.contrast()?);
        let mut pixels = vec![];
        taken.paint(&film, watch, |rows| {
            pixels.extend_from_slice(rows);
            Ok::<_, Failure>(())
        })?;
        let image = finished(shot, film.size, &pixels, watch)?;
        let unresolved = Some(taken.map.unresolved);
        Ok(TakenPicture { image, unresolved, tracer, coarser: 1.0, map: None })
    }

    fn scoped(
        &mut self,
        shot: &Shot,
        scoped: &Scoped,
        effort: &Effort,
        watch: Watch,
    ) -> Result<TakenPicture, Failure> {
        let scope = scoped.with_head(shot.look.head_of_scopes());
        let palette = Palette::of(&scope);
        let mut job = shot.scope_job(scope, effort, if effort.is_refined() { 3 } else { 1 });
        let is_slow = self.renderer.plan(&job).map_err(RenderError::from)?.backend.is_slow();
        let times = if is_slow { effort.coarser_by_single_rays() } else { effort.grain.coarser };
        job.film = coarser(&shot.film, times);
        let size = job.film.size;
        let (mut pixels, mut unresolved) =
            (Vec::with_capacity(3 * size[0] as usize * size[1] as usize), None);
        let Self { renderer, notes, .. } = self;
        let rendered = renderer.run(&job, watch, &mut |part| {
            match part {
                Partial::Begun { unresolved: known, .. } => {
                    pixels.clear();
                    unresolved = known;
                }
                Partial::Rows { rows, first_channel, .. } => {
                    for y in rows.first..rows.first + rows.count {
                        palette.encode(rows, first_channel, y, &mut pixels);
                    }
                }
                Partial::Note(why) => notes.push(why.to_owned()),
                Partial::Picture { .. } | Partial::LightRow { .. } => {}
            }
            Ok::<_, Failure>(())
        })?;
        let tracer = rendered.backend.kind();
        // The figure stands for the whole light, and not for the part of the area without a strongest exit.
        let unresolved = rendered.beams().map_or(unresolved, |beams| Some(beams.unresolved()));
        let image = finished(shot, size, &pixels, watch)?;
        Ok(TakenPicture { image, unresolved, tracer, coarser: 1.0, map: None })
    }
}

/// Returns a picture of these red, green and blue pixels, with the shot's overlay.
fn finished(shot: &Shot, size: [u32; 2], pixels: &[u8], watch: Watch) -> Result<Pixels, Failure> {
    let side = size.map(|n| n as usize);
    if shot.overlay.is_none() {
        return Ok(Pixels::opaque(side, pixels));
    }
    let mut rgba: Vec<u8> = pixels.chunks(3).flat_map(|c| [c[0], c[1], c[2], 255]).collect();
    overlaid(shot, &mut rgba, size, watch)?;
    Ok(Pixels { size: side, rgba })
}

fn drawing(shot: &Shot) -> Result<TakenPicture, Failure> {
    let stone = shot.specimen.stone().map_err(|e| Failure::Usage(e.to_string()))?;
    let style = match shot.paper.pixels_per_point.map(f64::from) {
        Some(scale) => {
            let points = shot.film.size.map(|pixels| f64::from(pixels) / scale);
            DiagramStyle::fitting(stone, shot.paper.inks, points)
        }
        None => DiagramStyle::sheet(shot.paper.inks),
    };
    let text = marked_diagram(stone, &shot.title, &style, &shot.marks).to_string();
    let (width, height, rgba) =
        rasterize_within(&text, shot.film.size).map_err(|e| Failure::Input(e.to_string()))?;
    let image = Pixels { size: [width as usize, height as usize], rgba };
    Ok(TakenPicture { image, unresolved: None, tracer: "drawn", coarser: 1.0, map: None })
}

#[cfg(test)]
pub(crate) use tests::shot;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::liquid::Liquid;
    use crate::model::document::Document;
    use crate::model::eye::Eye;
    use crate::model::framing_fit::FramingFit;
    use crate::shows::Shows;
    use crate::studio::effort::{FINE, Grain, Refinement};
    use crate::studio::order::{Paper, Which};
    use crate::studio::{ShotLight, survey};
    use brillianteer_base::unwatched;
    use brillianteer_measure::MEASURES_HEAD_DEG;
    use brillianteer_paper::lighting;
    use brillianteer_picture::{Bloom, Develop, develop, fxaa};
    use brillianteer_render::{Quality, Steps};
    use brillianteer_scene::{
        Background, BackgroundRef, Companions, Glare, Look, Pose, Projection, Smoothing, View,
    };
    use brillianteer_trace::environment::Lighting;
    use brillianteer_trace::gpu::Gpu;
    use glam::DVec2;
    use std::ops::ControlFlow;
    use std::path::Path;
    use std::sync::Arc;

    pub(crate) fn shot(shows: Shows, distance: Option<f64>) -> Shot {
        let eye = Eye { lean: DVec2::new(0.1, 0.05), ..Eye::default() };
        let projection =
            distance.map_or(Projection::Orthographic, |distance| Projection::Perspective { distance });
        Shot {
            document: 0,
            specimen: Arc::clone(Document::first().unwrap().specimen()),
            title: String::new(),
            marks: brillianteer_picture::DrawnMarks::default(),
            shows,
            strongest: false,
            glare: Glare::Included,
            view: View { projection, ..eye.view(None) },
            film: eye.film([56, 40], &FramingFit::reaching(1.0)),
            whole: FramingFit::reaching(1.0).film([56, 40]),
            light: ShotLight::whole(lighting::load("dome").unwrap()),
            look: Look { wavelengths: 16, ..Look::default() },
            jitter: true,
            copies: vec![Pose::STILL],
            companions: Companions::default(),
            overlay: None,
            liquid: Liquid::default(),
            paper: Paper::default(),
        }
    }

    /// Returns a shot whose look is changed.
    fn looking(shot: Shot, change: impl FnOnce(&mut Look)) -> Shot {
        let mut look = shot.look.clone();
        change(&mut look);
        Shot { look, ..shot }
    }

    #[test]
    fn a_contrast_map_depends_on_the_head_and_on_no_light() {
        let pixels = |shot: &Shot| {
            let mut taken = None;
            let slot = (0, Which::Present);
            let take = &mut |picture: TakenPicture| taken = Some(picture);
            ShotTracer::default().take((slot, shot), &FINE, &unwatched, take).unwrap();
            let taken = taken.unwrap();
            assert!(taken.unresolved.is_some_and(|part| part < 2e-3), "{:?}", taken.unresolved);
            taken.image.rgba
        };
        let usual = shot(Shows::Contrast, None);
        let seen = pixels(&usual);
        // With no head of its own a shot has that of the measures.
        for (head, is_same) in [(0.0, true), (MEASURES_HEAD_DEG, true), (25.0, false)] {
            let other = looking(usual.clone(), |look| look.head = Some(head));
            assert_eq!((other == usual, pixels(&other) == seen), (is_same, is_same), "{head}");
        }
        let lit = looking(usual.clone(), |look| look.exposure = 1.5);
        assert!(lit == usual && Shot { strongest: true, ..usual.clone() } == usual);
        // Exact beams trace no eye that is near.
        let near = shot(Shows::Contrast, Some(8.0));
        let refused =
            ShotTracer::default().take(((0, Which::Present), &near), &FINE, &unwatched, &mut |_| ());
        assert!(matches!(refused, Err(Failure::Usage(_))), "{refused:?}");
    }

    #[test]
    fn exports_are_planned_as_on_the_command_line() {
        let planned = |shot: &Shot| if ShotTracer::default().is_slow_render(shot) { "rays" } else { "beams" };
        assert_eq!(planned(&shot(Shows::Render, None)), "beams");
        assert_eq!(planned(&shot(Shows::Render, Some(8.0))), "rays", "a perspective");
        let before = |name: &str| {
            let behind = BackgroundRef::read(name, Path::new("")).unwrap();
            planned(&looking(shot(Shows::Render, None), |look| look.background = Some(behind)))
        };
        assert_eq!(before("page"), "rays", "something hangs behind");
        assert_eq!(["light", "white"].map(before), ["beams"; 2], "nothing hangs behind");
    }

    #[test]
    fn an_exported_render_is_developed_as_on_the_command_line() {
        let shot = looking(shot(Shows::Render, Some(8.0)), |look| look.exposure = -2.0);
        let mut exported = ShotTracer::default().export(&shot, &unwatched).unwrap();
        let exported = exported.image(&shot, &unwatched).unwrap();
        let steps = Steps::Passes { first: 0, hidden: 0 };
        let job = shot.light_job(None, shot.look.wavelengths, steps, Quality::of_pictures(true));
        let rendered = Renderer::default().run(&job, &unwatched, &mut |_| Ok::<_, RenderError>(())).unwrap();
        let background = Background::Transparent;
        let manner =
            Develop { exposure: -2.0, bloom: Some(Bloom::default()), background, ..Develop::default() };
        let rgba = develop(&rendered.light().unwrap().0, &manner);
        assert!(rgba.chunks(4).any(|pixel| (1..255).contains(&pixel[3])), "edges are soft");
        assert_eq!(exported, Pixels { size: exported.size, rgba });
    }

    /// Takes a picture; without `refinement` a rough one.
    fn taken(
        camera: &mut ShotTracer,
        shot: &Shot,
        bands: u32,
        refinement: Option<Refinement>,
    ) -> TakenPicture {
        let mut last = None;
        let effort = Effort { refinement, ..Effort::rough(5e-3, Grain { coarser: 1.0, bands }) };
        let each = &mut |taken| last = Some(taken);
        camera.take(((0, Which::Present), shot), &effort, &unwatched, each).unwrap();
        last.unwrap()
    }

    /// The mean difference of two pictures' channels as they are seen, as a fraction of full scale: where nothing is covered, no
    /// colour is seen.
    fn apart(a: &TakenPicture, b: &TakenPicture) -> f64 {
        assert_eq!(a.image.size, b.image.size);
        let seen = |taken: &TakenPicture| -> Vec<f64> {
            let pixels =
                taken.image.rgba.as_chunks::<4>().0.iter().map(|pixel| pixel.map(|c| f64::from(c) / 255.0));
            pixels.flat_map(|[r, g, b, cover]| [r * cover, g * cover, b * cover, cover]).collect()
        };
        let (a, b) = (seen(a), seen(b));
        a.iter().zip(&b).map(|(a, b)| (a - b).abs()).sum::<f64>() / a.len() as f64
    }

    #[test]
    fn only_a_rough_picture_is_taken_under_a_coarse_light() {
        let [whole, map] = ["dome", "ring"].map(|name| lighting::load(name).unwrap());
        let coarse = ShotLight::coarse(Lighting { map: map.map, ..whole.clone() });
        let small = shot(Shows::Render, None);
        let small = Shot { film: coarser(&small.film, 2.0), ..small };
        let small = looking(small, |look| look.wavelengths = 3);
        let [whole, coarse] = [ShotLight::whole(whole), coarse].map(|light| Shot { light, ..small.clone() });
        let image = |shot: &Shot, refinement| taken(&mut ShotTracer::default(), shot, 3, refinement).image;
        assert_ne!(image(&coarse, None), image(&whole, None), "a rough picture takes what is at hand");
        let refinement = Some(Refinement { samples: 2, after: 0, unresolved: 2e-2 });
        assert_eq!(image(&coarse, refinement), image(&whole, refinement), "a refined one waits");
        let exported = |shot: &Shot| {
            let mut exported = ShotTracer::default().export(shot, &unwatched).unwrap();
            exported.image(shot, &unwatched).unwrap()
        };
        assert_eq!(exported(&coarse), exported(&whole), "an export waits");
        let [a, b] = [&coarse, &whole].map(|shot| {
            let shot = Shot { shows: Shows::Refraction, ..shot.clone() };
            survey(&shot, [1, 1], &unwatched).unwrap().0
        });
        assert!(a == b, "a map in files waits");
        let stop = |_: f64| ControlFlow::Break(());
        assert!(matches!(coarse.under_whole_light(&stop), Err(Failure::Stopped)));
    }

    #[test]
    #[expect(clippy::print_stdout, reason = "tests print what they skip")]
    fn a_card_shows_what_the_processor_shows() {
        let gpu = match Gpu::open() {
            Ok(gpu) => Arc::new(gpu),
            Err(error) => {
                assert!(std::env::var_os("BRILLIANTEER_REQUIRE_GPU").is_none(), "{error}");
                println!("SKIPPED a_card_shows_what_the_processor_shows: {error}");
                return;
            }
        };
        let mut card = ShotTracer::by(Card::Open(gpu));
        let refinement = Some(Refinement { samples: 16, after: 0, unresolved: 5e-3 });
        let checks = BackgroundRef::read("checks", Path::new("")).unwrap();
        let mixed =
            looking(shot(Shows::Render, None), |look| (look.background, look.strength) = (Some(checks), 0.2));
        for (shot, most) in [
            (shot(Shows::Aset, Some(8.0)), 2e-3),
            (shot(Shows::Render, Some(8.0)), 4e-3),
            (shot(Shows::Render, None), 7e-3),
            (mixed, 4e-3),
        ] {
            let (shows, projection) = (shot.shows, shot.view.projection);
            let [a, b] = [&mut card, &mut ShotTracer::default()].map(|c| taken(c, &shot, 4, refinement));
            assert_ne!(a.tracer, b.tracer);
            let other = Shot { view: Eye::default().view(None), ..shot.clone() };
            let (off, wrong) = (apart(&a, &b), apart(&taken(&mut card, &other, 4, refinement), &b));
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
    fn strongest_exits_make_another_picture_only_in_scopes_and_the_head_where_it_blocks_light() {
        for (shows, is_same) in [
            (Shows::Render, [true, false]),
            (Shows::Refraction, [true, false]),
            (Shows::Diagram, [true; 2]),
            (Shows::Hearts, [false, true]),
            (Shows::Aset, [false; 2]),
        ] {
            let shot = shot(shows, None);
            let strongest = Shot { strongest: true, ..shot.clone() };
            let head = looking(shot.clone(), |look| look.head = Some(10.0));
            assert_eq!([shot == strongest, shot == head], is_same, "{shows:?}");
            let is_light = matches!(shows, Shows::Render | Shows::Refraction);
            assert_eq!(
                [shot.has_light_of(&strongest), shot.has_light_of(&head)],
                [is_light, false],
                "{shows:?}"
            );
        }
    }

    #[test]
    fn fxaa_smooths_rough_renders_and_leaves_refined_ones_as_they_are() {
        let plain = shot(Shows::Render, None);
        let smooth = looking(plain.clone(), |look| look.smoothing = Smoothing::Fxaa);
        let mut camera = ShotTracer::default();
        let mut image = |shot: &Shot, refinement| taken(&mut camera, shot, 4, refinement).image;
        assert_ne!(image(&plain, None), image(&smooth, None), "a rough picture");
        let refinement = Some(Refinement { samples: 4, after: 0, unresolved: 2e-3 });
        let refined = image(&plain, refinement);
        assert_eq!(refined, image(&smooth, refinement), "a refined picture");
        let mut blurred = refined.rgba.clone();
        fxaa(&mut blurred, refined.size[0] as u32);
        assert_ne!(refined.rgba, blurred, "FXAA would change it");
        // Light that is developed again is that of a refined picture.
        let slot = (0, Which::Present);
        let brighter = looking(smooth, |look| look.exposure = 1.0);
        let again = camera.develop_again(slot, &brighter, &unwatched);
        let light = camera.kept.get(&slot).map(|(_, light)| light);
        let (Some(Ok(again)), Some(TracedLight::Render { picture, .. })) = (again, light) else { panic!() };
        let unsmoothed = looking(brighter.clone(), |look| look.smoothing = Smoothing::None);
        let expected = developed(&unsmoothed, (picture, true), (0.0, ""), &unwatched).unwrap();
        assert_eq!(again.image, expected.image, "developed again");
    }

    #[test]
    fn a_rough_render_looks_like_the_fine_one() {
        let shot = shot(Shows::Render, None);
        let refinement = Some(Refinement { samples: 4, after: 0, unresolved: 2e-3 });
        let mut camera = ShotTracer::default();
        let rough = taken(&mut camera, &shot, 4, None);
        let fine = taken(&mut camera, &shot, 16, refinement);
        let off = apart(&rough, &fine);
        assert!(off < 0.03, "{off}");
    }
}
