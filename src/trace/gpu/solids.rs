//! Packs the stones of a picture into a card's memory.

use super::clusters::clusters;
use super::device::Gpu;
use super::fields::field;
use super::gpu_types::{Body, Cluster, with};
use super::limits::{MOST_BODIES, MOST_UNIFORM};
use super::shaders::ShaderSurface;
use super::triangles::GpuTriangles;
use crate::math::{Ball, ImplicitSurface, Plane, PosedSolid, SolidRef};
use crate::trace::gpu::GpuError;
use crate::trace::sampling::MOST_WAITING;

/// The number of planes in a stone above which clusters are quicker than trying all planes one after the other.
const FEW: usize = 192;

/// Loop turns that one ray's search stays below on a software driver: such drivers end a shader's loops after 65,535 turns,
/// whatever they have done by then.
const MOST_TURNS_IN_SOFTWARE: usize = 60_000;

/// Loop turns after which, on a card, the light of a ray in one wavelength is unresolved where they are counted: some 20 ms
/// if each waits for memory, so that even the least dispatch is short.
const MOST_TURNS: u32 = 1 << 16;

/// The same on a software driver; turns that are not counted fit into the rest.
const MOST_COUNTED_IN_SOFTWARE: u32 = 48_000;

/// The cost of looking for the next facet where it is not known by the number of planes, in plane tests.
const SEARCH: usize = 256;

/// Returns the loop turns that one ray may take in one wavelength where it counts them.
pub(super) fn most_turns(gpu: &Gpu) -> u32 {
    if gpu.is_software() { MOST_COUNTED_IN_SOFTWARE } else { MOST_TURNS }
}

/// The least number of bounces: with fewer, pictures of stones would be dark.
const LEAST_BOUNCES: u32 = 12;

/// The stones of a picture in a card's memory.
pub(super) struct Solids {
    pub surfaces: Surfaces,
    bodies: wgpu::Buffer,
    /// The unit of length in which the shader traces each stone, in units of the stone's body.
    pub units: Vec<f64>,
}

/// The surfaces of bodies, each once however many stones are made of it.
pub(super) struct Surfaces {
    pub facets: ShaderSurface,
    /// Planes, or triangles, or glass shapes.
    planes: wgpu::Buffer,
    /// Clusters of planes, or boxes of triangles.
    clusters: wgpu::Buffer,
    /// Where the surface of each body is kept, as in [`Body`].
    ranges: Vec<[u32; 4]>,
    /// The number of planes and clusters of the largest body.
    largest: usize,
}

impl Surfaces {
    fn new(gpu: &Gpu, solids: &[SolidRef]) -> Result<Self, GpuError> {
        let planes = |s: &SolidRef| match s {
            SolidRef::Convex(polytope) => Some(polytope.planes().collect()),
            SolidRef::Triangles(_) | SolidRef::Smooth(_) => None,
        };
        let smooth = solids.iter().map(|s| match s {
            SolidRef::Smooth(smooth) => Some(*smooth.field()),
            SolidRef::Convex(_) | SolidRef::Triangles(_) => None,
        });
        if let Some(fields) = smooth.collect::<Option<Vec<ImplicitSurface>>>().filter(|f| !f.is_empty()) {
            return Ok(Self::of_fields(gpu, &fields));
        }
        match solids.iter().map(planes).collect::<Option<Vec<Vec<Plane>>>>() {
            Some(convex) => Ok(Self::of_planes(gpu, &convex)),
            None => Self::of_triangles(gpu, solids),
        }
    }

    /// Packs all bodies as triangles, convex ones as well.
    fn of_triangles(gpu: &Gpu, solids: &[SolidRef]) -> Result<Self, GpuError> {
        let GpuTriangles { triangles, nodes, ranges } = GpuTriangles::new(solids)?;
        let storage = wgpu::BufferUsages::STORAGE;
        Ok(Self {
            facets: ShaderSurface::Triangles,
            planes: gpu.buffer("triangles", bytemuck::cast_slice(&triangles), storage),
            clusters: gpu.buffer("boxes", bytemuck::cast_slice(&nodes), storage),
            ranges,
            largest: 0,
        })
    }

    fn of_fields(gpu: &Gpu, fields: &[ImplicitSurface]) -> Self {
        let is_convex = fields.iter().all(ImplicitSurface::is_convex);
        let shapes: Vec<_> = fields.iter().map(field).collect();
        let storage = wgpu::BufferUsages::STORAGE;
        Self {
            facets: if is_convex { ShaderSurface::Smooth } else { ShaderSurface::Wavy },
            planes: gpu.buffer("shapes", bytemuck::cast_slice(&shapes), storage),
            clusters: gpu.buffer("none", &[0; 16], storage),
            ranges: (0..fields.len() as u32).map(|k| [k, 0, 0, 0]).collect(),
            largest: 0,
        }
    }

    fn of_planes(gpu: &Gpu, stones: &[Vec<Plane>]) -> Self {
        let all: usize = stones.iter().map(Vec::len).sum();
        let is_few = all <= MOST_UNIFORM && stones.iter().all(|s| s.len() <= FEW);
        let (mut planes, mut bunched, mut ranges, mut largest) = (vec![], vec![], vec![], 0);
        for stone in stones {
            let (order, own) = clusters(stone);
            let (first, first_bunch) = (planes.len(), bunched.len());
            planes.extend(order.iter().map(|&k| with(stone[k as usize].normal, stone[k as usize].offset)));
            let moved = |b: &Cluster| {
                let [spread, depth, start, count] = b.spread;
                Cluster { spread: [spread, depth, start + first as f32, count], ..*b }
            };
            bunched.extend(own.iter().map(moved));
            ranges.push([first, planes.len(), first_bunch, bunched.len()].map(|k| k as u32));
            largest = largest.max(stone.len() + own.len());
        }
        if is_few {
            planes.resize(MOST_UNIFORM, [0.0; 4]);
        }
        let kind = if is_few { wgpu::BufferUsages::UNIFORM } else { wgpu::BufferUsages::STORAGE };
        Self {
            facets: if is_few { ShaderSurface::Few } else { ShaderSurface::Many },
            planes: gpu.buffer("planes", bytemuck::cast_slice(&planes), kind),
            clusters: gpu.buffer("clusters", bytemuck::cast_slice(&bunched), wgpu::BufferUsages::STORAGE),
            ranges,
            largest,
        }
    }
}

impl Solids {
    pub fn new(gpu: &Gpu, stones: &[PosedSolid]) -> Result<Self, GpuError> {
        if stones.is_empty() {
            return Err(GpuError::NoStones);
        }
        if stones.len() > MOST_BODIES {
            return Err(GpuError::TooManyStones { count: stones.len(), most: MOST_BODIES });
        }
        let mut solids: Vec<SolidRef> = vec![];
        let mut place_of = Vec::with_capacity(stones.len());
        for stone in stones {
            let place = solids.iter().position(|solid| solid.is_same(stone.solid));
            place_of.push(place.unwrap_or(solids.len()));
            if place.is_none() {
                solids.push(stone.solid);
            }
        }
        let surfaces = Surfaces::new(gpu, &solids)?;
        let units: Vec<f64> = stones.iter().map(|stone| unit(stone.solid)).collect();
        let body = |(k, stone): (usize, &PosedSolid)| {
            let (Ball { middle, radius }, pose) = (stone.ball(), &stone.pose);
            Body {
                middle: with(middle, radius),
                range: surfaces.ranges[place_of[k]],
                turn: pose.turn.to_array().map(|x| x as f32),
                place: with(pose.at, pose.scale * units[k]),
            }
        };
        let mut bodies: Vec<Body> = stones.iter().enumerate().map(body).collect();
        bodies.resize(MOST_BODIES, Body { middle: [0.0; 4], range: [0; 4], turn: [0.0; 4], place: [0.0; 4] });
        let bodies = gpu.buffer("stones", bytemuck::cast_slice(&bodies), wgpu::BufferUsages::UNIFORM);
        Ok(Self { surfaces, bodies, units })
    }

    /// Returns the number of stones.
    pub fn count(&self) -> usize {
        self.units.len()
    }

    /// Returns an estimate of the most that a ray through the stones costs in one wavelength, in plane tests.
    pub fn cost(&self, bounces: u32) -> f64 {
        let search = if self.surfaces.largest > 0 { self.surfaces.largest } else { SEARCH };
        (1.0 + f64::from(bounces)) * search as f64 * self.count() as f64
    }

    /// Returns how many of the wanted bounces the card can follow.
    pub fn bounces(&self, gpu: &Gpu, wanted: u32) -> u32 {
        if !gpu.is_software() || self.surfaces.facets.count_turns() {
            return wanted;
        }
        if self.count() == 1 {
            return wanted.min((MOST_TURNS_IN_SOFTWARE / self.surfaces.largest) as u32);
        }
        // Every ray that waits is followed like the first, and each exit is looked for in all stones.
        let turns = MOST_TURNS_IN_SOFTWARE / (1 + MOST_WAITING);
        wanted.min((turns / (self.surfaces.largest * (1 + self.count()))) as u32)
    }

    /// Checks that so many bounces are enough for a picture that wants `wanted` of them.
    pub fn enough(&self, gpu: &Gpu, bounces: u32, wanted: u32) -> Result<(), GpuError> {
        if bounces >= LEAST_BOUNCES.min(wanted) || !gpu.is_software() {
            return Ok(());
        }
        Err(GpuError::TooFewBounces { name: gpu.name().to_owned(), bounces, stones: self.count() })
    }

    /// Returns the bind group entries of the stones.
    pub fn entries<'a>(&'a self, media: &'a wgpu::Buffer) -> Vec<wgpu::BindGroupEntry<'a>> {
        let entry = |binding, buffer: &'a wgpu::Buffer| wgpu::BindGroupEntry {
            binding,
            resource: buffer.as_entire_binding(),
        };
        let mut entries = vec![entry(1, &self.surfaces.planes), entry(4, &self.bodies), entry(5, media)];
        if matches!(self.surfaces.facets, ShaderSurface::Many | ShaderSurface::Triangles) {
            entries.push(entry(3, &self.surfaces.clusters));
        }
        entries
    }
}

/// Returns the unit of length in which the shader traces a solid, in units of the solid's frame: glass shapes reach 1.
fn unit(solid: SolidRef) -> f64 {
    match solid {
        SolidRef::Smooth(smooth) => smooth.field().reach(),
        SolidRef::Convex(_) | SolidRef::Triangles(_) => 1.0,
    }
}
