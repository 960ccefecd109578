//! Measures the light of stones that are compared.

use crate::model::fitting::{LightRequest, StoneLight};
use brillianteer_base::Failure;
use brillianteer_render::{MeasureError, MeasureOptions, measure};
use brillianteer_scene::Specimen;

/// Measures the stones one after the other.
///
/// # Errors
/// Fails where a stone cannot be built or traced; the text begins with its label. Returns [`Failure::Stopped`] where
/// the answer is no longer wanted.
pub fn measured(request: &LightRequest, is_stopped: &dyn Fn() -> bool) -> Result<Vec<StoneLight>, Failure> {
    let measured = request.stones.iter().map(|(label, design)| {
        if is_stopped() {
            return Err(Failure::Stopped);
        }
        let of_stone = |error: &dyn std::fmt::Display| Failure::Input(format!("{label}: {error}"));
        let found = measure(design, &MeasureOptions::default()).map_err(|error| match error {
            MeasureError::Render(error) => error.into(),
            error => of_stone(&error),
        })?;
        let carats = Specimen::new(design.clone()).map_err(|error| of_stone(&error))?.carats();
        Ok(StoneLight {
            light_return: found.light_return(),
            leakage: found.leakage(),
            error: found.error(),
            carats,
        })
    });
    measured.collect()
}
