//! Packs the stones of a picture, and the metal beside them, into a card's memory.

use super::clusters::clusters;
use super::device::Gpu;
use super::fields::field;
use super::gpu_types::{Body, Cluster, three, with};
use super::limits::{MOST_BODIES, MOST_UNIFORM};
use super::metals::{GpuMetals, meshes};
use super::shaders::ShaderSurface;
use super::triangles::GpuTriangles;
use crate::gpu::GpuError;
use crate::sampling::MOST_WAITING;
use brillianteer_math::{Ball, ImplicitSurface, Plane, Pose, PosedSolid, ShadedMesh, SolidRef};
use brillianteer_scene::MetalInstance;
use bytemuck::Zeroable;
use glam::DVec3;

/// The number of planes in a stone above which clusters are quicker than trying all planes one after the other.
const FEW: usize = 192;

/// The limit of the loop turns of one ray's search on a software driver. Such drivers end a shader's loops after
/// 65,535 turns, even when the work is not complete.
const MOST_TURNS_IN_SOFTWARE: usize = 60_000;

/// The number of loop turns after which, on a card, the light of a ray in one wavelength counts as unresolved, where
/// turns are counted, so that the smallest dispatches are short. Four times as many took up to half a second in a halo ring
/// on an NVIDIA H200; this number leaves 0.02 % of that picture's light unresolved.
const MOST_TURNS: u32 = 1 << 14;

/// The same number on a software driver. Turns that are not counted fit into the difference.
const MOST_COUNTED_IN_SOFTWARE: u32 = 48_000;

/// The cost of a search for the next facet, in plane tests, where the number of planes does not give it.
const SEARCH: usize = 256;

/// Returns the most loop turns that one ray may take in one wavelength, where it counts them.
pub(super) fn most_turns(gpu: &Gpu) -> u32 {
    if gpu.is_software() { MOST_COUNTED_IN_SOFTWARE } else { MOST_TURNS }
}

/// Returns the sixteenths of a turn that one plane counts for, where turns are counted. A software driver counts each
/// plane as a whole turn; a card tries many planes in the time in which one step among boxes waits for memory.
pub(super) fn plane_sixteenths(gpu: &Gpu) -> u32 {
    if gpu.is_software() { 16 } else { 1 }
}

/// The least number of bounces: with fewer, pictures of stones would be dark.
const LEAST_BOUNCES: u32 = 12;

/// The stones of a picture, and the metal beside them, in a card's memory.
pub(super) struct Solids {
    pub surfaces: Surfaces,
    bodies: wgpu::Buffer,
    /// The unit of length in which the shader traces each stone, in units of the stone's body.
    pub units: Vec<f64>,
    /// The metal; `None` where there is none.
    pub metals: Option<GpuMetals>,
}

/// The surfaces of bodies. Each is stored once, however many stones have it.
pub(super) struct Surfaces {
    pub facets: ShaderSurface,
    /// Planes, or glass shapes; `None` for triangles.
    planes: Option<wgpu::Buffer>,
    /// The clusters of planes where there are many.
    clusters: Option<wgpu::Buffer>,
    /// The triangles of stones and of metal, and the boxes around them.
    triangles: Option<[wgpu::Buffer; 2]>,
    /// The places of each body's surface in these buffers, as in [`Body`].
    ranges: Vec<[u32; 4]>,
    /// The places of each mesh of metal, in the same form.
    of_metals: Vec<[u32; 4]>,
    /// The number of planes and clusters of the largest body.
    largest: usize,
}

impl Surfaces {
    /// Packs the bodies of stones, and meshes of metal.
    fn new(gpu: &Gpu, solids: &[SolidRef], metals: &[&ShadedMesh]) -> Result<Self, GpuError> {
        let planes = |s: &SolidRef| match s {
            SolidRef::Convex(polytope) => Some(polytope.planes().collect()),
            SolidRef::Triangles(_) | SolidRef::Smooth(_) => None,
        };
        let smooth = solids.iter().map(|s| match s {
            SolidRef::Smooth(smooth) => Some(*smooth.field()),
            SolidRef::Convex(_) | SolidRef::Triangles(_) => None,
        });
        let surfaces = if let Some(fields) = smooth.collect::<Option<Vec<_>>>().filter(|f| !f.is_empty()) {
            Some(Self::of_fields(gpu, &fields))
        } else {
            // Clusters and the triangles of metal together would need more storage buffers than every card has.
            let convex = solids.iter().map(planes).collect::<Option<Vec<Vec<Plane>>>>();
            convex.filter(|stones| metals.is_empty() || are_few(stones)).map(|s| Self::of_planes(gpu, &s))
        };
        match surfaces {
            Some(surfaces) if metals.is_empty() => Ok(surfaces),
            Some(surfaces) => surfaces.with_triangles(gpu, GpuTriangles::new(&[], metals)?),
            // All bodies are packed as triangles, including convex ones.
            None => {
                Self::bare(ShaderSurface::Triangles).with_triangles(gpu, GpuTriangles::new(solids, metals)?)
            }
        }
    }

    /// Returns surfaces of a kind, with empty buffers.
    fn bare(facets: ShaderSurface) -> Self {
        let (ranges, of_metals) = (vec![], vec![]);
        Self { facets, planes: None, clusters: None, triangles: None, ranges, of_metals, largest: 0 }
    }

    /// Copies triangles to the card.
    fn with_triangles(self, gpu: &Gpu, all: GpuTriangles) -> Result<Self, GpuError> {
        let GpuTriangles { triangles, nodes, of_solids, of_metals } = all;
        let storage = wgpu::BufferUsages::STORAGE;
        let triangles = gpu.buffer("triangles", bytemuck::cast_slice(&triangles), storage);
        let boxes = gpu.buffer("boxes", bytemuck::cast_slice(&nodes), storage);
        let ranges = if of_solids.is_empty() { self.ranges } else { of_solids };
        Ok(Self { triangles: Some([triangles, boxes]), ranges, of_metals, ..self })
    }

    fn of_fields(gpu: &Gpu, fields: &[ImplicitSurface]) -> Self {
        let is_convex = fields.iter().all(ImplicitSurface::is_convex);
        let mut shapes: Vec<_> = fields.iter().map(field).collect();
        shapes.resize(MOST_BODIES, Zeroable::zeroed());
        Self {
            planes: Some(gpu.buffer("shapes", bytemuck::cast_slice(&shapes), wgpu::BufferUsages::UNIFORM)),
            ranges: (0..fields.len() as u32).map(|k| [k, 0, 0, 0]).collect(),
            ..Self::bare(if is_convex { ShaderSurface::Smooth } else { ShaderSurface::Wavy })
        }
    }

    fn of_planes(gpu: &Gpu, stones: &[Vec<Plane>]) -> Self {
        let is_few = are_few(stones);
        let (mut planes, mut clustered, mut ranges, mut largest) = (vec![], vec![], vec![], 0);
        for stone in stones {
            let (order, own) = clusters(stone);
            let (first, first_cluster) = (planes.len(), clustered.len());
            planes.extend(order.iter().map(|&k| with(stone[k as usize].normal, stone[k as usize].offset)));
            let moved = |cluster: &Cluster| Cluster { first: cluster.first + first as u32, ..*cluster };
            clustered.extend(own.iter().map(moved));
            ranges.push([first, planes.len(), first_cluster, clustered.len()].map(|k| k as u32));
            largest = largest.max(stone.len() + own.len());
        }
        let storage = wgpu::BufferUsages::STORAGE;
        let (facets, kind, clusters) = if is_few {
            planes.resize(MOST_UNIFORM, [0.0; 4]);
            (ShaderSurface::Few, wgpu::BufferUsages::UNIFORM, None)
        } else {
            let clusters = gpu.buffer("clusters", bytemuck::cast_slice(&clustered), storage);
            (ShaderSurface::Many, storage, Some(clusters))
        };
        let planes = Some(gpu.buffer("planes", bytemuck::cast_slice(&planes), kind));
        Self { planes, clusters, ranges, largest, ..Self::bare(facets) }
    }
}

/// Returns whether there are so few planes that they fit into the uniform array and clusters would be slower.
fn are_few(stones: &[Vec<Plane>]) -> bool {
    stones.iter().map(Vec::len).sum::<usize>() <= MOST_UNIFORM && stones.iter().all(|s| s.len() <= FEW)
}

impl Solids {
    /// Packs stones, and metal beside them.
    pub fn new(gpu: &Gpu, stones: &[PosedSolid], metals: &[MetalInstance]) -> Result<Self, GpuError> {
        if stones.is_empty() && metals.is_empty() {
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
        let (meshes, mesh_of) = meshes(metals);
        let surfaces = Surfaces::new(gpu, &solids, &meshes)?;
        let units: Vec<f64> = stones.iter().map(|stone| unit(stone.solid)).collect();
        let packed = |(k, stone): (usize, &PosedSolid)| {
            let Ball { middle, radius } = stone.ball();
            body((middle, radius), surfaces.ranges[place_of[k]], &stone.pose, units[k])
        };
        let mut bodies: Vec<Body> = stones.iter().enumerate().map(packed).collect();
        bodies.resize(MOST_BODIES, Body::zeroed());
        let bodies = gpu.buffer("stones", bytemuck::cast_slice(&bodies), wgpu::BufferUsages::UNIFORM);
        let ranges: Vec<[u32; 4]> = mesh_of.iter().map(|&mesh| surfaces.of_metals[mesh]).collect();
        let is_any = !metals.is_empty();
        let metals = is_any.then(|| GpuMetals::new(gpu, metals, &ranges)).transpose()?;
        Ok(Self { surfaces, bodies, units, metals })
    }

    /// Returns the number of stones.
    pub fn count(&self) -> usize {
        self.units.len()
    }

    /// Returns the number of bodies of metal.
    pub fn metal_count(&self) -> usize {
        self.metals.as_ref().map_or(0, GpuMetals::count)
    }

    /// Returns whether rays count the turns of their loops, so that a limit ends them.
    pub fn count_turns(&self) -> bool {
        self.surfaces.facets.count_turns() || self.metals.is_some()
    }

    /// Returns an estimate of the greatest cost of a ray through the stones in one wavelength, in plane tests.
    pub fn cost(&self, bounces: u32) -> f64 {
        let search = if self.surfaces.largest > 0 { self.surfaces.largest } else { SEARCH };
        let of_metal = if self.metals.is_some() { SEARCH } else { 0 };
        (1.0 + f64::from(bounces)) * (search * self.count() + of_metal) as f64
    }

    /// Returns the number of bounces that the card can follow, at most `wanted`.
    pub fn bounces(&self, gpu: &Gpu, wanted: u32) -> u32 {
        if !gpu.is_software() || self.count_turns() {
            return wanted;
        }
        if self.count() == 1 {
            return wanted.min((MOST_TURNS_IN_SOFTWARE / self.surfaces.largest) as u32);
        }
        // Every ray that waits is followed like the first, and each exit is searched for in all stones.
        let turns = MOST_TURNS_IN_SOFTWARE / (1 + MOST_WAITING);
        wanted.min((turns / (self.surfaces.largest * (1 + self.count()))) as u32)
    }

    /// Checks that this many bounces are enough for a picture that wants `wanted` of them.
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
        let mut entries = vec![entry(4, &self.bodies), entry(5, media)];
        entries.extend(self.surfaces.planes.iter().map(|planes| entry(1, planes)));
        entries.extend(self.surfaces.clusters.iter().map(|clusters| entry(3, clusters)));
        if let Some([triangles, boxes]) = &self.surfaces.triangles {
            entries.extend([entry(11, triangles), entry(12, boxes)]);
        }
        entries.extend(self.metals.iter().flat_map(GpuMetals::entries));
        entries
    }
}

/// Packs the data of a body for the shader: the ball around it, the place of its surface in the buffers, and its
/// pose. The body is traced in a unit of `unit` units of its frame.
pub(super) fn body((middle, radius): (DVec3, f64), range: [u32; 4], pose: &Pose, unit: f64) -> Body {
    Body {
        middle: three(middle),
        radius: radius as f32,
        range,
        turn: pose.turn.to_array().map(|x| x as f32),
        place: three(pose.at),
        unit: (pose.scale * unit) as f32,
    }
}

/// Returns the unit of length in which the shader traces a solid, in units of the solid's frame: glass shapes reach 1.
fn unit(solid: SolidRef) -> f64 {
    match solid {
        SolidRef::Smooth(smooth) => smooth.field().reach(),
        SolidRef::Convex(_) | SolidRef::Triangles(_) => 1.0,
    }
}
