//! The shaders: put together as text, and each compiled when first used.

use super::gpu_types;
use super::limits::{GROUPS_ACROSS, MOST_BODIES, MOST_INBOUND, MOST_LEVELS, MOST_UNIFORM, MOST_WAVELENGTHS};
use super::throttle::Throttle;
use crate::scene::MOST_LAMPS;
use crate::trace::environment::TEXEL_ANGLE;
use crate::trace::sampling::MOST_WAITING;
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

/// The kinds of surface that shaders trace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ShaderSurface {
    /// Convex stones of at most 192 planes each and 1024 in all.
    Few,
    /// Convex stones of more planes, in clusters.
    Many,
    /// Triangles of stones that are not all convex.
    Triangles,
    /// Glass shapes that are convex.
    Smooth,
    /// Glass shapes, not all of them convex.
    Wavy,
}

impl ShaderSurface {
    /// All variants.
    pub const ALL: [Self; 5] = [Self::Few, Self::Many, Self::Triangles, Self::Smooth, Self::Wavy];

    /// Whether rays count the turns of their loops, so that a limit ends them.
    pub fn count_turns(self) -> bool {
        matches!(self, Self::Triangles | Self::Smooth | Self::Wavy)
    }
}

/// What a shader records of each pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ShaderTask {
    /// Energy by the bands of a scope.
    Scope,
    /// Colour under light.
    Light,
}

/// The pipelines of one task, one for each kind of surface, each compiled when first used.
pub(super) struct Pipelines {
    reading: ShaderTask,
    by_facets: [OnceLock<Kernel>; ShaderSurface::ALL.len()],
}

/// A compiled shader, and what was learnt of how much work it does in a time.
pub(super) struct Kernel {
    pub pipeline: wgpu::ComputePipeline,
    throttle: Mutex<Throttle>,
}

impl Kernel {
    pub fn throttle(&self) -> MutexGuard<'_, Throttle> {
        self.throttle.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Returns a shader's text, with its structs and constants in front.
pub(super) fn source(facets: ShaderSurface, reading: ShaderTask) -> String {
    let constants = format!(
        "const MOST_PLANES: u32 = {MOST_UNIFORM}u;\nconst MOST_BODIES: u32 = {MOST_BODIES}u;\n\
         const MOST_WAITING: u32 = {MOST_WAITING}u;\nconst MOST_LAMPS: u32 = {MOST_LAMPS}u;\n\
         const MOST_WAVELENGTHS: u32 = {MOST_WAVELENGTHS}u;\nconst TEXEL_ANGLE: f32 = {TEXEL_ANGLE};\n\
         const NONE: u32 = 0xffffffffu;\nconst MOST_INBOUND: u32 = {MOST_INBOUND}u;\n\
         const MOST_LEVELS: u32 = {MOST_LEVELS}u;\nconst GROUPS_ACROSS: u32 = {GROUPS_ACROSS}u;\n"
    );
    let stones = "@group(0) @binding(0) var<uniform> frame: Frame;\n\
        @group(0) @binding(4) var<uniform> bodies: array<Body, MOST_BODIES>;\n\
        @group(0) @binding(5) var<storage, read> media: array<Medium>;\n";
    let leaving = include_str!("../../../shaders/leaving.wgsl");
    let flat = include_str!("../../../shaders/flat.wgsl");
    let fields = include_str!("../../../shaders/implicit.wgsl");
    let jets = include_str!("../../../shaders/jets.wgsl");
    let convex = include_str!("../../../shaders/convex.wgsl");
    let branching = include_str!("../../../shaders/branching.wgsl");
    let facets: &[&str] = match facets {
        ShaderSurface::Few => &[leaving, include_str!("../../../shaders/planes.wgsl"), flat, convex],
        ShaderSurface::Many => {
            &[gpu_types::CLUSTER_WGSL, leaving, include_str!("../../../shaders/clusters.wgsl"), flat, convex]
        }
        ShaderSurface::Triangles => &[
            gpu_types::TRIANGLE_WGSL,
            gpu_types::BVH_NODE_WGSL,
            include_str!("../../../shaders/triangles.wgsl"),
            flat,
            branching,
        ],
        ShaderSurface::Smooth => &[gpu_types::IMPLICIT_SURFACE_WGSL, jets, fields, convex],
        ShaderSurface::Wavy => &[gpu_types::IMPLICIT_SURFACE_WGSL, jets, fields, branching],
    };
    let reading: &[&str] = match reading {
        ShaderTask::Scope => {
            &[gpu_types::BANDS_WGSL, gpu_types::SCOPE_PIXEL_WGSL, include_str!("../../../shaders/scope.wgsl")]
        }
        ShaderTask::Light => &[
            gpu_types::ENVIRONMENT_WGSL,
            gpu_types::LAMP_WGSL,
            gpu_types::RESPONSE_WGSL,
            gpu_types::RADIANCE_PIXEL_WGSL,
            include_str!("../../../shaders/environment.wgsl"),
            include_str!("../../../shaders/light.wgsl"),
        ],
    };
    let common = [
        gpu_types::FRAME_WGSL,
        gpu_types::BODY_WGSL,
        gpu_types::MEDIUM_WGSL,
        &constants,
        stones,
        include_str!("../../../shaders/optics.wgsl"),
        include_str!("../../../shaders/trace.wgsl"),
        include_str!("../../../shaders/pose.wgsl"),
        include_str!("../../../shaders/camera.wgsl"),
        include_str!("../../../shaders/tiles.wgsl"),
    ];
    common.iter().chain(facets).chain(reading).copied().collect()
}

impl Pipelines {
    pub fn new(reading: ShaderTask) -> Self {
        Self { reading, by_facets: Default::default() }
    }

    pub fn kernel(&self, device: &wgpu::Device, facets: ShaderSurface) -> &Kernel {
        self.by_facets[facets as usize].get_or_init(|| Kernel {
            pipeline: compiled(device, source(facets, self.reading)),
            throttle: Mutex::default(),
        })
    }
}

/// Compiles a shader's text, which has one entry point, into a pipeline.
pub(super) fn compiled(device: &wgpu::Device, text: String) -> wgpu::ComputePipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: None,
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    })
}
