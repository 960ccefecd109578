//! Scopes on the graphics card: what each pixel sees, band by band.

use super::bunches::bunches;
use super::door::{BUNCH_WGSL, FRAME_WGSL, Frame, SEEN_WGSL, Seen};
use super::{Gpu, GpuError};
use crate::math::{Plane, Polytope};
use crate::scene::{Medium, Projection, Scope, View};
use crate::trace::ray::Options;
use crate::trace::{Stopped, Watch};
use glam::{DVec2, DVec3};
use wgpu::util::DeviceExt;

/// The most bands that a scope may have here.
pub const MOST_BANDS: usize = 8;

/// Planes that fit into the uniform array, 16 KiB.
const MOST_UNIFORM: usize = 1024;

/// With more planes than this, bunches are quicker than all planes one after the other.
const FEW: usize = 192;

/// Pixels of one dispatch, a ray each: far less than a second's work, lest a driver think the card hung, and a buffer
/// of less than 128 MiB, which all cards take.
const PIXELS_AT_ONCE: u32 = 1 << 20;

/// The same where the processor does it.
const PIXELS_AT_ONCE_IN_SOFTWARE: u32 = 1 << 17;

/// Rays are followed no further: chains of very different lengths side by side would leave most of a card idle.
pub const MOST_BOUNCES: u32 = 64;

/// Software drivers end a shader's loops, whatever they have done by then, after 65,535 turns: bounces of one ray times
/// what it tries at each stay below this.
const MOST_TURNS_IN_SOFTWARE: usize = 60_000;

/// Side of a workgroup, pixels.
const WORKGROUP: u32 = 8;

/// One picture to take: a square film, its rays on a regular grid in each pixel.
pub struct Shot<'a> {
    /// The stone.
    pub polytope: &'a Polytope,
    /// What it is made of.
    pub medium: Medium,
    /// From where it is seen.
    pub view: &'a View,
    /// Under which light, of at most [`MOST_BANDS`] bands.
    pub scope: &'a Scope,
    /// Half the film's side in girdle radii, around the image's origin.
    pub half: f64,
    /// Pixels along each side.
    pub size: u32,
    /// Rays along each side of a pixel, at least 1.
    pub per_side: u32,
    /// Where in its cell of that grid each ray stands, 0 to 1; (0.5, 0.5) is the middle.
    pub shift: DVec2,
    /// How far rays are followed, at most [`MOST_BOUNCES`] bounces.
    pub options: Options,
}

pub(super) struct Pipelines {
    few: wgpu::ComputePipeline,
    many: wgpu::ComputePipeline,
}

/// Every shader's text, its structs in front.
pub(super) fn source(facets: &str) -> String {
    let constants = format!("const MOST_PLANES: u32 = {MOST_UNIFORM}u;\nconst NONE: u32 = 0xffffffffu;\n");
    let frame = "@group(0) @binding(0) var<uniform> frame: Frame;\n";
    let parts = [
        FRAME_WGSL,
        SEEN_WGSL,
        BUNCH_WGSL,
        &constants,
        frame,
        include_str!("../../../shaders/optics.wgsl"),
        facets,
        include_str!("../../../shaders/trace.wgsl"),
        include_str!("../../../shaders/scope.wgsl"),
    ];
    parts.concat()
}

pub(super) const FEW_WGSL: &str = include_str!("../../../shaders/planes.wgsl");
pub(super) const MANY_WGSL: &str = include_str!("../../../shaders/polytope.wgsl");

impl Pipelines {
    pub fn new(device: &wgpu::Device) -> Self {
        let pipeline = |label, facets| {
            let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Wgsl(source(facets).into()),
            });
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(label),
                layout: None,
                module: &module,
                entry_point: Some("scope"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        };
        Self { few: pipeline("few planes", FEW_WGSL), many: pipeline("many planes", MANY_WGSL) }
    }
}

impl Gpu {
    /// Takes a picture, some rows at a time, from the top: calls `each` with the first row's number and the pixels
    /// of whole rows.
    ///
    /// # Errors
    /// What `each` answers, [`Stopped`], or what is wrong with the card, both turned into its kind of error.
    pub fn scope<E: From<Stopped> + From<GpuError>>(
        &self,
        shot: &Shot,
        watch: Watch,
        mut each: impl FnMut(u32, &[Seen]) -> Result<(), E>,
    ) -> Result<(), E> {
        let pixels = if self.is_software() { PIXELS_AT_ONCE_IN_SOFTWARE } else { PIXELS_AT_ONCE };
        let rows = (pixels / shot.size).clamp(1, shot.size);
        let stage = Stage::new(self, shot, rows)?;
        for first in (0..shot.size).step_by(rows as usize) {
            if watch(f64::from(first) / f64::from(shot.size)).is_break() {
                return Err(Stopped.into());
            }
            let count = rows.min(shot.size - first);
            for turn in 0..shot.per_side * shot.per_side {
                stage.look(self, (first, count), turn)?;
                let part = f64::from(turn) / f64::from(shot.per_side * shot.per_side);
                if watch((f64::from(first) + part * f64::from(count)) / f64::from(shot.size)).is_break() {
                    return Err(Stopped.into());
                }
            }
            each(first, &stage.read(self, count)?)?;
        }
        Ok(())
    }
}

/// What one picture needs on the card.
struct Stage<'a> {
    pipeline: &'a wgpu::ComputePipeline,
    told: Frame,
    frame: wgpu::Buffer,
    seen: wgpu::Buffer,
    back: wgpu::Buffer,
    bound: wgpu::BindGroup,
}

impl<'a> Stage<'a> {
    fn new(gpu: &'a Gpu, shot: &Shot, rows: u32) -> Result<Self, GpuError> {
        let count = shot.scope.bands.len();
        if count > MOST_BANDS {
            return Err(GpuError::TooManyBands { count, most: MOST_BANDS });
        }
        let planes: Vec<Plane> = shot.polytope.planes().collect();
        let is_few = planes.len() <= FEW;
        let pipeline = if is_few { &gpu.pipelines.few } else { &gpu.pipelines.many };
        let (order, bunches) = bunches(&planes);
        let mut narrowed: Vec<[f32; 4]> = order.iter().map(|&k| narrow(&planes[k as usize])).collect();
        if is_few {
            narrowed.resize(MOST_UNIFORM, [0.0; 4]);
        }
        let device = &gpu.device;
        let buffer = |label, bytes: &[u8], usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some(label),
                contents: bytes,
                usage,
            })
        };
        let facets = if is_few { wgpu::BufferUsages::UNIFORM } else { wgpu::BufferUsages::STORAGE };
        let mut told = frame(shot, planes.len(), bunches.len());
        if gpu.is_software() {
            let most = MOST_TURNS_IN_SOFTWARE / (planes.len() + bunches.len());
            told.counts[2] = told.counts[2].min(most as u32);
        }
        let uniform = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let frame = buffer("frame", bytemuck::bytes_of(&told), uniform);
        let planes = buffer("planes", bytemuck::cast_slice(&narrowed), facets);
        let bunches = buffer("bunches", bytemuck::cast_slice(&bunches), wgpu::BufferUsages::STORAGE);
        let size = u64::from(rows) * u64::from(shot.size) * size_of::<Seen>() as u64;
        let empty = |label, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let seen = empty("seen", wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let back = empty("back", wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let mut entries = vec![
            wgpu::BindGroupEntry { binding: 0, resource: frame.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: planes.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 2, resource: seen.as_entire_binding() },
        ];
        if !is_few {
            entries.push(wgpu::BindGroupEntry { binding: 3, resource: bunches.as_entire_binding() });
        }
        let bound = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("stone"),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        gpu.check()?;
        Ok(Self { pipeline, told, frame, seen, back, bound })
    }

    /// Adds one ray of each pixel of some rows to what is seen through it.
    fn look(&self, gpu: &Gpu, (first, count): (u32, u32), turn: u32) -> Result<(), GpuError> {
        let mut told = self.told;
        (told.film[1], told.film[2], told.turn[0]) = (first, count, turn);
        gpu.queue.write_buffer(&self.frame, 0, bytemuck::bytes_of(&told));
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(self.pipeline);
            pass.set_bind_group(0, &self.bound, &[]);
            pass.dispatch_workgroups(told.film[0].div_ceil(WORKGROUP), count.div_ceil(WORKGROUP), 1);
        }
        gpu.queue.submit([encoder.finish()]);
        // One after the other: queued up, they would outlive the wish to stop.
        gpu.wait()
    }

    /// What has been seen through some rows of pixels.
    fn read(&self, gpu: &Gpu, count: u32) -> Result<Vec<Seen>, GpuError> {
        let bytes = u64::from(count) * u64::from(self.told.film[0]) * size_of::<Seen>() as u64;
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(&self.seen, 0, &self.back, 0, bytes);
        gpu.queue.submit([encoder.finish()]);
        self.back.map_async(wgpu::MapMode::Read, 0..bytes, |_| {});
        gpu.wait()?;
        let mapped = self.back.get_mapped_range(0..bytes).map_err(|e| gpu.failed(e.to_string()))?;
        let seen = bytemuck::pod_collect_to_vec(&mapped);
        drop(mapped);
        self.back.unmap();
        Ok(seen)
    }
}

fn narrow(plane: &Plane) -> [f32; 4] {
    with(plane.normal, plane.offset)
}

fn with(v: DVec3, w: f64) -> [f32; 4] {
    [v.x as f32, v.y as f32, v.z as f32, w as f32]
}

fn frame(shot: &Shot, planes: usize, bunches: usize) -> Frame {
    let basis = shot.view.basis();
    let reach = shot.polytope.vertices().iter().map(|v| v.length()).fold(0.0, f64::max);
    let distance = match shot.view.projection {
        Projection::Orthographic => 0.0,
        Projection::Perspective { distance } => distance,
    };
    let mut borders = [2.0_f32; MOST_BANDS];
    for (border, band) in borders.iter_mut().zip(&shot.scope.bands[1..]) {
        *border = band.from.to_radians().sin() as f32;
    }
    let [a, b, c, d, e, f, g, h] = borders;
    Frame {
        right: with(basis.right, reach),
        up: with(basis.up, shot.medium.absorption),
        toward: with(basis.toward, distance),
        zenith: with(shot.view.zenith(), shot.medium.index),
        borders_low: [a, b, c, d],
        borders_high: [e, f, g, h],
        limits: [
            shot.options.least_weight as f32,
            shot.half as f32,
            shot.shift.x as f32,
            shot.shift.y as f32,
        ],
        counts: [
            planes as u32,
            bunches as u32,
            shot.options.most_bounces.min(MOST_BOUNCES),
            u32::from(shot.options.polarised),
        ],
        film: [shot.size, 0, 0, shot.per_side],
        turn: [0; 4],
    }
}
