//! Packs glass shapes (implicit surfaces) for the graphics card.

use super::gpu_types;
use brillianteer_math::{ImplicitSurface, SurfaceParts};

/// Packs a shape's function.
pub(super) fn field(field: &ImplicitSurface) -> gpu_types::ImplicitSurface {
    let SurfaceParts { corner, round, flank, half, edge, body_reach, wave } = field.parts();
    let is = |something: bool| f32::from(u8::from(something));
    let narrow = |v: [f64; 3]| v.map(|x| x as f32);
    let [a, b, c] = narrow([corner.x, corner.y, round]);
    let (normal, length) = flank.unwrap_or_default();
    let [x, y, length] = narrow([normal.x, normal.y, length]);
    let [amplitude, waves, phase] = narrow(wave.unwrap_or_default());
    gpu_types::ImplicitSurface {
        size: [half, edge, body_reach, 0.0].map(|x| x as f32),
        outline: [a, b, c, is(flank.is_some())],
        flank: [x, y, length, is(wave.is_some())],
        wave: [amplitude, waves, phase, 0.0],
    }
}
