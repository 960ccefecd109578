//! Traces refraction maps and panes of liquid glass, which show their background through glass.

use super::job::{Job, MapProduct, PaneProduct};
use super::renderer::{Output, RenderError};
use brillianteer_base::Watch;
use brillianteer_optics::{Illuminant, Strata};
use brillianteer_picture::RefractionMap;
use brillianteer_picture::liquid_glass::{PaneLighting, compare, surroundings, traced};
use brillianteer_trace::environment::EnvironmentMap;

impl MapProduct {
    pub(super) fn render(&self, job: &Job, passes: u32, watch: Watch) -> Result<Output, RenderError> {
        let lit_scene = job.lit_scene(&self.surroundings);
        let (map, carried) =
            self.surveyed(passes, |survey| RefractionMap::trace(&lit_scene, &self.plane, survey, watch))?;
        Ok(Output::RefractionMap(map, carried))
    }
}

impl PaneProduct {
    pub(super) fn render(&self, passes: u32, watch: Watch) -> Result<Output, RenderError> {
        let around = PaneLighting {
            map: &EnvironmentMap::new(&surroundings(&self.pane), None),
            gap: self.gap,
            strata: &Strata::new(self.wavelengths, passes, &Illuminant::D65, true),
            passes,
        };
        if self.compares {
            let comparison = compare(&self.pane, &self.background, &around, watch)?;
            return Ok(Output::LiquidGlass(comparison.traced, Some(comparison.cost)));
        }
        Ok(Output::LiquidGlass(traced(&self.pane, &self.background, &around, watch)?, None))
    }
}
