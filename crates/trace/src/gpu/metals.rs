//! Packs bodies of metal for the graphics card: their places, their roughness, and their reflectance at each
//! wavelength.

use super::device::{Gpu, GpuError};
use super::gpu_types::{self, Body};
use super::limits::{MOST_METALS, MOST_ROUGHNESSES};
use super::solids::body;
use brillianteer_math::{Ball, ShadedMesh};
use brillianteer_optics::{Metal, Roughness};
use brillianteer_scene::MetalInstance;
use bytemuck::Zeroable;
use num_complex::Complex64;
use std::sync::Arc;

/// The metal of a picture in a card's memory, without its triangles.
pub(super) struct GpuMetals {
    /// The bodies: the places of their triangles and finishes in the buffers, and their poses.
    bodies: wgpu::Buffer,
    /// The tables of all kinds of roughness.
    roughnesses: wgpu::Buffer,
    count: usize,
    finishes: Vec<Finish>,
}

/// A metal with one roughness.
struct Finish {
    metal: Metal,
    surface: Arc<Roughness>,
    /// The number of the table for its roughness.
    table: usize,
    /// The number of one of the bodies that have this finish.
    body: usize,
}

/// Returns each mesh of some bodies of metal once, and the place of each body's mesh among them.
pub(super) fn meshes(metals: &[MetalInstance]) -> (Vec<&ShadedMesh>, Vec<usize>) {
    let mut meshes: Vec<&Arc<ShadedMesh>> = vec![];
    let places = metals.iter().map(|MetalInstance { mesh, .. }| {
        meshes.iter().position(|other| Arc::ptr_eq(other, mesh)).unwrap_or_else(|| {
            meshes.push(mesh);
            meshes.len() - 1
        })
    });
    let places = places.collect();
    (meshes.into_iter().map(|mesh| &**mesh).collect(), places)
}

impl GpuMetals {
    /// Packs bodies of metal. `ranges` are the places of each body's triangles in the buffers, as in [`Body`].
    pub fn new(gpu: &Gpu, metals: &[MetalInstance], ranges: &[[u32; 4]]) -> Result<Self, GpuError> {
        if metals.len() > MOST_METALS {
            return Err(GpuError::TooManyMetals { count: metals.len(), most: MOST_METALS });
        }
        let (finishes, of_body) = finishes(metals);
        let tables = finishes.iter().map(|finish| finish.table + 1).max().unwrap_or(0);
        if tables > MOST_ROUGHNESSES {
            return Err(GpuError::TooManyRoughnesses { count: tables, most: MOST_ROUGHNESSES });
        }
        let packed = |(k, metal): (usize, &MetalInstance)| {
            let Ball { middle, radius } = metal.ball();
            let [root, reach, normals, _] = ranges[k];
            body((middle, radius), [root, reach, normals, of_body[k] as u32], &metal.pose, 1.0)
        };
        let mut bodies: Vec<Body> = metals.iter().enumerate().map(packed).collect();
        bodies.resize(MOST_METALS, Body::zeroed());
        let mut rows: Vec<[f32; 4]> = vec![[0.0; 4]; MOST_ROUGHNESSES * Roughness::ROWS];
        for Finish { surface, table, .. } in &finishes {
            let own = rows.iter_mut().skip(table * Roughness::ROWS);
            own.zip(surface.rows()).for_each(|(row, numbers)| *row = numbers.map(|x| x as f32));
        }
        let uniform = wgpu::BufferUsages::UNIFORM;
        Ok(Self {
            bodies: gpu.buffer("metals", bytemuck::cast_slice(&bodies), uniform),
            roughnesses: gpu.buffer("roughnesses", bytemuck::cast_slice(&rows), uniform),
            count: metals.len(),
            finishes,
        })
    }

    /// Returns the number of bodies.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Returns the number of finishes.
    pub fn finish_count(&self) -> usize {
        self.finishes.len()
    }

    /// Returns the numbers of each finish at each wavelength, one finish after the other, in the form that
    /// `sample_metal` in shaders/microfacets.wgsl takes. `indices` are the complex indices of the bodies, band by
    /// band.
    pub fn finishes(&self, indices: &[Vec<Complex64>]) -> impl Iterator<Item = [f32; 4]> {
        self.finishes.iter().flat_map(|Finish { surface, table, body, .. }| {
            let of_band = |&index: &Complex64| {
                let again = surface.of_metal(index).again() as f32;
                let index = [index.re as f32, index.im as f32];
                bytemuck::cast(gpu_types::Finish { index, again, surface: *table as f32 })
            };
            indices[*body].iter().map(of_band)
        })
    }

    /// Returns the bind group entries of the metal.
    pub fn entries(&self) -> [wgpu::BindGroupEntry<'_>; 2] {
        [(13, &self.bodies), (14, &self.roughnesses)]
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
    }
}

/// Returns each finish once, and the place of each body's finish among them.
fn finishes(metals: &[MetalInstance]) -> (Vec<Finish>, Vec<usize>) {
    let mut finishes: Vec<Finish> = vec![];
    let mut tables: Vec<u64> = vec![];
    let place = |(body, &MetalInstance { metal, roughness, .. }): (usize, &MetalInstance)| {
        let bits = roughness.to_bits();
        let table = tables.iter().position(|&other| other == bits).unwrap_or(tables.len());
        if table == tables.len() {
            tables.push(bits);
        }
        let same = |finish: &Finish| finish.table == table && finish.metal == metal;
        finishes.iter().position(same).unwrap_or_else(|| {
            finishes.push(Finish { metal, surface: Roughness::shared(roughness), table, body });
            finishes.len() - 1
        })
    };
    let places = metals.iter().enumerate().map(place).collect();
    (finishes, places)
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_math::ShadedSurface;
    use glam::DVec3;

    #[test]
    fn bodies_of_one_mesh_and_of_one_finish_share_them() {
        let mesh = || {
            let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
            let surface = ShadedSurface { points, corners: vec![[0, 1, 2]], normals: vec![] };
            Arc::new(ShadedMesh::new(surface).unwrap())
        };
        let (a, b) = (mesh(), mesh());
        let of = |mesh, metal, roughness| MetalInstance { roughness, ..MetalInstance::new(mesh, metal) };
        let metals = [
            of(&a, Metal::Gold, 0.1),
            of(&b, Metal::Silver, 0.1),
            of(&a, Metal::Gold, 0.4),
            of(&b, Metal::Gold, 0.1),
        ];
        let (found, places) = meshes(&metals);
        assert_eq!((found.len(), places), (2, vec![0, 1, 0, 1]));
        let (found, places) = finishes(&metals);
        let numbers: Vec<_> = found.iter().map(|f| (f.metal, f.table, f.body)).collect();
        assert_eq!(numbers, [(Metal::Gold, 0, 0), (Metal::Silver, 0, 1), (Metal::Gold, 1, 2)]);
        assert_eq!(places, [0, 1, 2, 0]);
    }
}
