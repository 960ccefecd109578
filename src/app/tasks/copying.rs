//! Pictures for the clipboard at a chosen size.

use crate::app::model::task::{CopyOriginal, CopyRequest};
use crate::app::studio::{FINE, ShotTracer, Which};
use crate::io::Failure;
use crate::io::rasterize;
use crate::picture::profile;
use crate::scene::Specimen;
use egui::ColorImage;
use std::ops::ControlFlow;

/// Makes a picture, until `is_stopped` says that nobody wants it any more.
///
/// # Errors
/// The text says why there is no picture.
pub fn make(request: &CopyRequest, is_stopped: &(dyn Fn() -> bool + Sync)) -> Result<ColorImage, Failure> {
    let CopyRequest { original, side } = request;
    let shot = match original {
        CopyOriginal::Shot(shot) => shot,
        CopyOriginal::Profile(specimen) => return drawn(specimen, *side),
    };
    let watch = |_: f64| match is_stopped() {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    };
    let mut last = None;
    let slot = (0, Which::Present);
    let made = ShotTracer::default().take((slot, shot), &FINE, &watch, &mut |taken| last = Some(taken.image));
    made?;
    last.ok_or_else(|| Failure::Output("no picture was drawn".to_owned()))
}

/// Returns the drawing from the side, as it is exported.
pub fn drawn(specimen: &Specimen, side: u32) -> Result<ColorImage, Failure> {
    let stone = specimen.stone().map_err(|e| Failure::Usage(e.to_string()))?;
    let text = profile(stone, &specimen.design.name, specimen.design.cut.brilliant()).to_string();
    let (width, height, rgb) = rasterize(&text, side).map_err(|e| Failure::Output(e.to_string()))?;
    Ok(ColorImage::from_rgb([width as usize, height as usize], &rgb))
}
