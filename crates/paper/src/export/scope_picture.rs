//! Takes a picture in a scope and returns its pixels, for callers that write no file of its own.

use super::event::Reporter;
use super::sheet::{ScopeSheet, UNRESOLVED, remark, traced};
use super::viewing::{Viewing, note};
use brillianteer_base::{Failure, Watch};
use brillianteer_picture::{Caption, Palette, Scoped};
use brillianteer_render::{Partial, Product, Reading, Renderer, ScopeProduct};
use brillianteer_scene::Film;
use brillianteer_trace::ray::Camera;
use glam::DVec2;

/// The request for a picture of energy in a scope.
#[derive(Clone, Copy)]
pub struct ScopeStill<'a> {
    /// The stone with its view and tracer. A scope that is made for one side of the stone sees that side.
    pub viewing: Viewing<'a>,
    /// The scope.
    pub scoped: &'a Scoped,
    /// The pixels.
    pub film: Film,
    /// The part of the light that may stay unresolved where the viewing has no bound.
    pub unresolved: f64,
    /// The rays along each side of a pixel where rays trace the picture; `None` for the usual number.
    pub rays_per_side: Option<u32>,
}

/// The pixels of a stone in a scope, with the description that goes into their file.
#[derive(Debug, Clone, PartialEq)]
pub struct ScopePicture {
    /// Red, green and blue of each pixel, sRGB, row by row.
    pub rgb: Vec<u8>,
    /// The content and the tracer of the picture, in the words that the files of pictures hold.
    pub description: String,
}

impl<'a> ScopeStill<'a> {
    /// Returns stills of several viewings of one stone, with `size` pixels of the same side: that with which the stone
    /// fits into each, as into a picture that [`Export`](super::Export) writes. The pictures are as good as such ones.
    ///
    /// # Errors
    /// Fails with [`Failure::Input`] where the eye is not in front of the whole stone, [`Failure::Usage`] where exact
    /// beams do not fit.
    pub fn alike(
        viewings: &[Viewing<'a>],
        scoped: &'a Scoped,
        size: [u32; 2],
        renderer: &Renderer,
    ) -> Result<Vec<Self>, Failure> {
        let mut reach = 0.0_f64;
        for viewing in viewings.iter().map(|viewing| viewing.facing(scoped.side)) {
            viewing.check(renderer)?;
            let solid = viewing.specimen.solid();
            reach = reach.max(Camera::new(&viewing.view(), solid).reach(solid).unwrap_or(1.0));
        }
        let film = Film::holding(DVec2::splat(reach), size);
        let still = |&viewing| Self { viewing, scoped, film, unresolved: UNRESOLVED, rays_per_side: None };
        Ok(viewings.iter().map(still).collect())
    }

    /// Traces the stone and returns its pixels.
    ///
    /// # Errors
    /// Fails with [`Failure::Input`] where the eye is not in front of the whole stone, [`Failure::Usage`] where exact
    /// beams do not fit, an error of `tell`, or [`Failure::Stopped`] when `watch` asks to stop.
    pub fn take(
        &self,
        renderer: &mut Renderer,
        watch: Watch,
        tell: Reporter,
    ) -> Result<ScopePicture, Failure> {
        let sheet = self.sheet();
        let by_beams = sheet.viewing.check(renderer)?;
        let (scope, medium, glare) = (sheet.scope.clone(), sheet.viewing.medium, sheet.glare);
        let product = Product::Scope(ScopeProduct { scope, medium, glare, readings: vec![Reading::Energy] });
        let mut job = sheet.viewing.job(self.film, product, self.unresolved);
        job.quality.samples = self.rays_per_side.filter(|_| !by_beams);
        let palette = Palette::of(&sheet.scope);
        let (mut rgb, mut how): (Vec<u8>, String) = (vec![], String::new());
        renderer.run(&job, watch, &mut |part| match part {
            Partial::Begun { backend, unresolved, .. } => {
                rgb.clear();
                how = traced(Reading::Energy, (backend, unresolved), &job);
                Ok(())
            }
            Partial::Rows { rows, first_channel, .. } => {
                for y in rows.first..rows.first + rows.count {
                    palette.encode(rows, first_channel, y, &mut rgb);
                }
                Ok(())
            }
            other => note(&other, tell),
        })?;
        let description = sheet.description(&remark(Reading::Energy, sheet.glare), &how);
        Ok(ScopePicture { rgb, description })
    }

    /// Returns a caption with the legend of the scope's zones, in which `seen` describes the viewpoint.
    pub fn caption(&self, seen: &str) -> Caption {
        self.sheet().moving_caption(seen)
    }

    fn sheet(&self) -> ScopeSheet<'a> {
        let viewing = self.viewing.facing(self.scoped.side);
        ScopeSheet {
            name: &self.scoped.scope.name,
            suffix: String::new(),
            scope: self.scoped.with_head(viewing.head_deg),
            viewing,
            glare: viewing.glare.unwrap_or_default(),
        }
    }
}
