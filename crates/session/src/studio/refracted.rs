//! Traces pictures of backgrounds behind glass: refraction maps, in which backgrounds are then looked up, and panes
//! of liquid glass.

use super::develop::map_taken;
use super::effort::{Effort, FINE_RENDER};
use super::jobs::{MapDetail, coarser};
use super::order::{Shot, Slot, TakenPicture};
use super::take::ShotTracer;
use super::undeveloped::TracedLight;
use crate::pixels::Pixels;
use brillianteer_base::{Failure, Watch};
use brillianteer_picture::{Carried, Develop, RefractionMap};
use brillianteer_render::{Job, Rendered, Renderer};

/// The resolution of maps by grade. The time of a look-up grows with the number of bands.
const ROUGH: MapDetail = MapDetail { bands: 1, places: 1, shades: 3, samples: 1 };
const FAIR: MapDetail = MapDetail { bands: 1, places: 1, shades: 4, samples: 1 };
const FINE: MapDetail = MapDetail { bands: 3, places: 1, shades: 6, samples: 4 };

impl ShotTracer {
    /// Traces the map of a shot; the picture shows the codes of the map's places.
    pub(super) fn mapped(
        &mut self,
        (slot, shot): (Slot, &Shot),
        effort: &Effort,
        watch: Watch,
    ) -> Result<TakenPicture, Failure> {
        let (detail, factor) = match effort.refinement {
            None => (ROUGH, effort.coarser_by_single_rays()),
            Some(refinement) if refinement.samples == 1 => (FAIR, 1.0),
            Some(_) => (FINE, 1.0),
        };
        let job = Job { film: coarser(&shot.film, factor), ..shot.map_job(&detail) };
        let (map, _) = run(&mut self.renderer, &job, watch)?.map()?;
        if effort.is_refined() {
            self.kept.insert(slot, (shot.clone(), TracedLight::Map(map.clone())));
        }
        Ok(map_taken(shot, map))
    }

    /// Traces the pane of liquid glass of a shot.
    pub(super) fn glass(
        &mut self,
        shot: &Shot,
        effort: &Effort,
        watch: Watch,
    ) -> Result<TakenPicture, Failure> {
        let asked = shot.pane_background();
        let at_hand = self.picture_behind(Some(&asked), effort, watch)?;
        let made =
            at_hand.map_or_else(|| self.backgrounds.fine(&asked, watch), |picture| Ok(Some(picture)))?;
        let Some(behind) = made else { return Err(Failure::Input("the pane has no background".into())) };
        // The processor always traces panes, so they take no more passes than fine renders on it.
        let samples = effort.refinement.map_or(1, |r| r.samples.min(FINE_RENDER.samples));
        let size = coarser(&shot.film, effort.coarser_by_single_rays()).size;
        let job = shot.pane_job(behind.picture(), size, samples > 1, samples);
        let rendered = run(&mut self.renderer, &job, watch)?;
        let tracer = rendered.backend.kind();
        Ok(TakenPicture {
            image: Pixels::encoded(&rendered.pane()?.0),
            unresolved: None,
            tracer,
            coarser: 1.0,
            map: None,
        })
    }
}

fn run(renderer: &mut Renderer, job: &Job, watch: Watch) -> Result<Rendered, Failure> {
    renderer.run(job, watch, &mut |_| Ok(()))
}

/// Traces the map of a shot as it is exported, with the given numbers of bands and of places of a pixel in each.
///
/// # Errors
/// Fails where the renderer refuses the job, where the backplate cannot be read, or where `watch` asks to stop.
pub fn survey(
    shot: &Shot,
    [bands, places]: [u32; 2],
    watch: Watch,
) -> Result<(RefractionMap, Carried), Failure> {
    let shot = &*shot.under_whole_light(watch)?;
    let job = shot.map_job(&MapDetail { bands, places, shades: 16, samples: 4 });
    let (map, carried) = run(&mut Renderer::default(), &job, watch)?.map()?;
    Ok((
        map.developed(&Develop {
            exposure: shot.look.exposure,
            tone: shot.look.tone,
            bloom: None,
            ..Develop::default()
        }),
        carried,
    ))
}
