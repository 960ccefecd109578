//! Draws panes on a graphics card, by `shaders/liquid_glass.wgsl`.

use super::lighting::SurfaceLight;
use super::parts::thickness;
use super::{GlassPane, PaneQuality};
use crate::Linear;
use brillianteer_scene::Panorama;
use brillianteer_trace::gpu::{Gpu, GpuError, PaneData, PaneStage};

/// A background on a graphics card, in front of which panes are drawn. Everything about a pane is data: no pane needs a
/// shader of its own.
pub struct PanesOnCard<'a> {
    stage: PaneStage<'a>,
    size: [u32; 2],
}

impl<'a> PanesOnCard<'a> {
    /// Copies a background to the card.
    ///
    /// # Errors
    /// Fails with [`GpuError`], where the picture is too large for the card, or the card has failed.
    pub fn new(gpu: &'a Gpu, background: &Panorama) -> Result<Self, GpuError> {
        let size = [background.width, background.height];
        Ok(Self { stage: PaneStage::new(gpu, size, &background.pixels)?, size })
    }

    /// Draws a pane and leaves its picture on the card: over the background, or alone and premultiplied by cover.
    ///
    /// # Errors
    /// Fails with [`GpuError`], where the card has failed.
    pub fn draw(&self, pane: &GlassPane, is_over: bool) -> Result<(), GpuError> {
        self.stage.draw(&pane.data(is_over))
    }

    /// Reads the picture of the last pane.
    ///
    /// # Errors
    /// Fails with [`GpuError`], where the card has failed.
    pub fn read(&self) -> Result<Linear, GpuError> {
        let [width, height] = self.size;
        Ok(Linear { width, height, pixels: self.stage.read()? })
    }
}

impl GlassPane {
    /// Packs the pane for the shader; the stage fills in the size of the picture.
    fn data(&self, is_over: bool) -> PaneData {
        let pane = self.effective();
        let taps = match (pane.is_somewhere(), pane.quality) {
            (false, _) => 0,
            (true, PaneQuality::High) => 5,
            (true, PaneQuality::Medium | PaneQuality::Low) => 3,
        };
        let (outline, middle) = (pane.outline(), pane.corner + pane.size / 2.0);
        let light = SurfaceLight::new(&pane);
        PaneData {
            size: [0; 2],
            sample_count: taps,
            is_over: u32::from(is_over),
            middle: middle.as_vec2().to_array(),
            unit: pane.unit() as f32,
            corner: outline.corner as f32,
            half: outline.half.as_vec2().to_array(),
            level: outline.level.as_vec2().to_array(),
            round: outline.round.as_vec2().to_array(),
            refraction: (pane.refraction / 100.0) as f32,
            thickness: thickness(pane.depth) as f32,
            toward: light.toward.to_array(),
            dispersion: (pane.dispersion / 100.0) as f32,
            between: light.between.to_array(),
            frost: (pane.frost / 100.0) as f32,
            colour: light.colour.extend(0.0).to_array(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::liquid_glass::tests::{SIZE, apart, full, none, pattern};
    use crate::liquid_glass::{LightFrom, layer, pane};
    use glam::{DVec2, DVec4};

    /// Half a step of 8 bits.
    const HALF_A_STEP: f32 = 0.5 / 255.0;

    /// Opens the card; `None` where there is none and none is required.
    fn card() -> Option<Gpu> {
        match Gpu::open() {
            Ok(gpu) => Some(gpu),
            Err(error) if std::env::var_os("BRILLIANTEER_REQUIRE_GPU").is_some() => panic!("{error}"),
            Err(_) => None,
        }
    }

    #[test]
    fn the_card_draws_what_the_processor_draws_within_half_a_step_of_eight_bits() {
        let Some(gpu) = card() else { return };
        let background = pattern(false);
        let on_card = PanesOnCard::new(&gpu, &background).unwrap();
        let tint = DVec4::new(0.2, 0.5, 0.9, 0.7);
        let light_from = LightFrom { azimuth: 215.0, height: 25.0 };
        let corner = DVec2::new(-9.5, 21.25);
        for one in [
            full(),
            none(),
            GlassPane { tint, light_from, ..full() },
            GlassPane { quality: PaneQuality::Medium, ..full() },
            GlassPane { quality: PaneQuality::Low, ..full() },
            GlassPane { dispersion: 0.0, radius: 0.0, ..full() },
            GlassPane { radius: 19.0, corner, ..full() },
            GlassPane { radius: 40.0, ..full() },
        ] {
            on_card.draw(&one, true).unwrap();
            let off = apart(&on_card.read().unwrap(), &pane(&one, &background, 1));
            assert!(off < HALF_A_STEP, "{off}: {one:?}");
            on_card.draw(&one, false).unwrap();
            let off = apart(&on_card.read().unwrap(), &layer(&one, &background, 1));
            assert!(off < HALF_A_STEP, "alone, {off}: {one:?}");
        }
        // The comparison sees each part of the effect change by some percent.
        on_card.draw(&full(), true).unwrap();
        let seen = on_card.read().unwrap();
        for mutant in [
            GlassPane { refraction: 95.0, ..full() },
            GlassPane { depth: 97.0, ..full() },
            GlassPane { dispersion: 80.0, ..full() },
            GlassPane { frost: 70.0, ..full() },
            GlassPane { light: 98.0, ..full() },
            GlassPane { tint: DVec4::new(0.0, 1.0, 1.0, 0.02), ..full() },
            GlassPane { light_from: LightFrom { azimuth: 92.0, ..LightFrom::default() }, ..full() },
            GlassPane { radius: 11.5, ..full() },
        ] {
            assert!(apart(&seen, &pane(&mutant, &background, 1)) > HALF_A_STEP, "{mutant:?}");
        }
        assert_eq!([background.width, background.height], SIZE);
        assert!(PanesOnCard::new(&gpu, &Panorama { width: 0, height: 1, pixels: vec![] }).is_err());
    }
}
