//! Packs glass shapes (implicit surfaces) for the graphics card.

use super::gpu_types;
use brillianteer_math::{ImplicitSurface, SurfaceParts};

/// Packs a shape's function.
pub(super) fn field(field: &ImplicitSurface) -> gpu_types::ImplicitSurface {
    let SurfaceParts { corner, round, flank, half, edge, body_reach, wave } = field.parts();
    let (normal, length) = flank.unwrap_or_default();
    let [amplitude, waves, phase] = wave.unwrap_or_default().map(|x| x as f32);
    gpu_types::ImplicitSurface {
        half: half as f32,
        edge: edge as f32,
        body_reach: body_reach as f32,
        is_triangle: u32::from(flank.is_some()),
        corner: corner.as_vec2().to_array(),
        round: round as f32,
        has_wave: u32::from(wave.is_some()),
        flank_normal: normal.as_vec2().to_array(),
        flank_length: length as f32,
        amplitude,
        waves,
        phase,
        unused: [0.0; 2],
    }
}
