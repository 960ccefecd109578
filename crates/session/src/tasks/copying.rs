//! Pictures for the clipboard at a chosen size.

use crate::model::task::{CopyOriginal, CopyRequest};
use crate::pixels::Pixels;
use crate::shows::Shows;
use crate::studio::{FINE, ShotTracer, Which};
use brillianteer_base::Failure;
use brillianteer_paper::rasterize;
use brillianteer_picture::profile;
use brillianteer_scene::Specimen;
use std::ops::ControlFlow;

/// Makes a picture, unless `is_stopped` says that it is no longer wanted.
///
/// # Errors
/// Fails where the picture cannot be made; the text says why.
pub fn make(request: &CopyRequest, is_stopped: &(dyn Fn() -> bool + Sync)) -> Result<Pixels, Failure> {
    let CopyRequest { original, side } = request;
    let shot = match original {
        CopyOriginal::Shot(shot) => shot,
        CopyOriginal::Profile(specimen) => return drawn(specimen, *side),
    };
    let watch = |_: f64| if is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    // A copied render has as many passes as an exported one.
    if shot.shows == Shows::Render {
        return ShotTracer::default().export(shot, &watch)?.image(shot, &watch);
    }
    let mut last = None;
    let slot = (0, Which::Present);
    let made = ShotTracer::default().take((slot, shot), &FINE, &watch, &mut |taken| last = Some(taken.image));
    made?;
    last.ok_or_else(|| Failure::Output("no picture was drawn".to_owned()))
}

/// Returns the drawing from the side, as it is exported.
pub fn drawn(specimen: &Specimen, side: u32) -> Result<Pixels, Failure> {
    let stone = specimen.stone().map_err(|e| Failure::Usage(e.to_string()))?;
    let text = profile(stone, &specimen.design.name, specimen.design.cut.brilliant()).to_string();
    let (width, height, rgb) = rasterize(&text, side).map_err(|e| Failure::Output(e.to_string()))?;
    Ok(Pixels::opaque([width as usize, height as usize], &rgb))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Model;
    use crate::model::motion::WaveCache;
    use crate::model::ordering::Orders;
    use crate::model::workspace::Workspace;
    use crate::studio::{Paper, Shot};
    use brillianteer_base::unwatched;
    use brillianteer_scene::{Projection, View};

    #[test]
    fn a_copied_render_by_rays_has_the_pixels_of_an_exported_one() {
        let model = Model::new(Workspace::default()).unwrap();
        let projection = Projection::Perspective { distance: 8.0 };
        let view = View { projection, ..model.workspace.eye.view(None) };
        let mut orders = Orders { model: &model, waves: &mut WaveCache::default(), paper: Paper::default() };
        let film = model.fit(Shows::Render, &view).film([24; 2]);
        let mut shot = Shot { film, ..orders.render(view) };
        shot.look.wavelengths = 3;
        assert!(ShotTracer::default().is_slow_render(&shot));
        let mut exported = ShotTracer::default().export(&shot, &unwatched).unwrap();
        let exported = exported.image(&shot, &unwatched).unwrap();
        let request = CopyRequest { original: CopyOriginal::Shot(Box::new(shot)), side: 24 };
        let copied = make(&request, &|| false).unwrap();
        assert!(copied == exported);
    }
}
