//! The light that the pane's surface adds: many normals at a time, in single precision.

use super::GlassPane;
use glam::{DVec3, Vec3};
use pulp::{Simd, WithSimd};

/// The weights of the diffuse light, the shine and the rim.
const WEIGHTS: [f32; 3] = [0.3, 0.5, 0.3];

/// The light on a pane's surface, which follows from its strength, direction and tint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SurfaceLight {
    /// Unit direction toward the light.
    pub toward: Vec3,
    /// Unit direction between those toward the light and the eye.
    pub between: Vec3,
    /// The colour of the light: white, or as far as the tint covers it the tint's colour; 0 without light.
    pub colour: Vec3,
}

impl SurfaceLight {
    /// Returns the light of a pane whose numbers are within their ranges.
    pub fn new(pane: &GlassPane) -> Self {
        let toward = pane.toward_light();
        let between = (toward + DVec3::Z).try_normalize().unwrap_or(DVec3::Z);
        let colour = pane.light_colour() * (pane.light / 100.0);
        Self { toward: toward.as_vec3(), between: between.as_vec3(), colour: colour.as_vec3() }
    }
}

/// Normals of a row of pixels: their x, y and z.
#[derive(Debug, Clone, Default)]
pub(super) struct Normals(pub [Vec<f32>; 3]);

/// Computes the brightness of a row of normals under the light of strength 100: the diffuse light of J. H. Lambert,
/// the shine of J. F. Blinn (1977), and a rim in place of Fresnel's reflection.
pub(super) struct Brightness<'a> {
    pub light: SurfaceLight,
    pub normals: &'a Normals,
    /// The brightness of each normal is written here, in the order of the normals; longer slices keep their rest.
    pub to: &'a mut [f32],
}

impl WithSimd for Brightness<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let SurfaceLight { toward, between, .. } = self.light;
        let [x, y, z] = &self.normals.0;
        let normals = x.iter().zip(y).zip(z);
        for (to, ((&x, &y), &z)) in self.to.iter_mut().zip(normals) {
            let diffuse = (x * toward.x + y * toward.y + z * toward.z).max(0.0);
            let cosine = (x * between.x + y * between.y + z * between.z).max(0.0);
            // Blinn's cosine to the 32nd power.
            let mut shine = cosine;
            for _ in 0..5 {
                shine *= shine;
            }
            let rim = 1.0 - z;
            *to = WEIGHTS[0] * diffuse + WEIGHTS[1] * shine + WEIGHTS[2] * (rim * rim * rim);
        }
    }
}
