//! The shaders, which are put together as text and compiled when first used.
//!
//! `trace.wgsl` follows the chain of bounces. What it calls is in one of several files:
//!
//! - What a ray meets (`entry`, `next_facet`, `facet_normal`): `planes.wgsl` for stones of few planes,
//!   `clusters.wgsl` for more, `triangles.wgsl`, and `implicit.wgsl` for glass shapes.
//! - Where leaving light goes: `convex.wgsl` lets it go, `branching.wgsl` is for solids that it may enter again;
//!   then `leave` takes it, in `scope.wgsl` into bands, in `light.wgsl` to another body or to the environment.
//! - What metal does: nothing in `no_metal.wgsl`; `metal.wgsl` finds it, reflects light and thins out weak light.
//!
//! `light.wgsl` calls `go` at one place only, because compilers copy all that it calls to each place.

use super::gpu_types;
use super::limits::{
    GROUPS_ACROSS, MOST_BODIES, MOST_INBOUND, MOST_LEVELS, MOST_METALS, MOST_ROUGHNESSES, MOST_UNIFORM,
    MOST_WAVELENGTHS,
};
use super::throttle::Throttle;
use crate::environment::TEXEL_ANGLE;
use crate::sampling::MOST_WAITING;
use brillianteer_optics::Roughness;
use brillianteer_scene::MOST_LAMPS;
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

    /// Returns whether rays count the turns of their loops, so that a limit ends them.
    pub fn count_turns(self) -> bool {
        matches!(self, Self::Triangles | Self::Smooth | Self::Wavy)
    }
}

/// The quantity that a shader records for each pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ShaderTask {
    /// Energy by the bands of a scope.
    Scope,
    /// Colour under light.
    Light,
}

/// The pipelines of one task, one for each kind of surface, without metal and with it, each compiled when first used.
pub(super) struct Pipelines {
    reading: ShaderTask,
    by_facets: [[OnceLock<Kernel>; 2]; ShaderSurface::ALL.len()],
}

/// A compiled shader, and its measured speed.
pub(super) struct Kernel {
    pub pipeline: wgpu::ComputePipeline,
    throttle: Mutex<Throttle>,
}

impl Kernel {
    pub fn throttle(&self) -> MutexGuard<'_, Throttle> {
        self.throttle.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The search of triangles.
const BVH: [&str; 3] =
    [gpu_types::TRIANGLE_WGSL, gpu_types::BVH_NODE_WGSL, include_str!("../../../../shaders/bvh.wgsl")];

/// The parts that metal under light needs in addition to [`BVH`].
const METAL: [&str; 4] = [
    gpu_types::FINISH_WGSL,
    include_str!("../../../../shaders/random.wgsl"),
    include_str!("../../../../shaders/microfacets.wgsl"),
    include_str!("../../../../shaders/metal.wgsl"),
];

/// Returns a shader's text, with its structs and constants in front. `has_metal` is true where metal stands beside
/// the stones, which only pictures under light allow.
pub(super) fn source(facets: ShaderSurface, reading: ShaderTask, has_metal: bool) -> String {
    let constants = constants(has_metal || facets.count_turns());
    let mut parts = vec![
        gpu_types::FRAME_WGSL,
        gpu_types::BODY_WGSL,
        gpu_types::MEDIUM_WGSL,
        &constants,
        "@group(0) @binding(0) var<uniform> frame: Frame;\n\
         @group(0) @binding(4) var<uniform> bodies: array<Body, MOST_BODIES>;\n\
         @group(0) @binding(5) var<storage, read> media: array<vec4f>;\n",
        include_str!("../../../../shaders/optics.wgsl"),
        include_str!("../../../../shaders/trace.wgsl"),
        include_str!("../../../../shaders/pose.wgsl"),
        include_str!("../../../../shaders/camera.wgsl"),
        include_str!("../../../../shaders/tiles.wgsl"),
    ];
    parts.extend(surface(facets));
    if has_metal || facets == ShaderSurface::Triangles {
        parts.extend(BVH);
    }
    match reading {
        ShaderTask::Scope => parts.extend([
            gpu_types::BANDS_WGSL,
            gpu_types::SCOPE_PIXEL_WGSL,
            include_str!("../../../../shaders/scope.wgsl"),
        ]),
        ShaderTask::Light => {
            parts.extend([
                gpu_types::ENVIRONMENT_WGSL,
                gpu_types::LAMP_WGSL,
                gpu_types::RESPONSE_WGSL,
                gpu_types::RADIANCE_PIXEL_WGSL,
                include_str!("../../../../shaders/environment.wgsl"),
                include_str!("../../../../shaders/light.wgsl"),
            ]);
            let beside: &[&str] =
                if has_metal { &METAL } else { &[include_str!("../../../../shaders/no_metal.wgsl")] };
            parts.extend(beside);
        }
    }
    parts.concat()
}

/// Returns the constants of the shaders. `counts_turns` is true where rays count the turns of all their loops.
fn constants(counts_turns: bool) -> String {
    format!(
        "const MOST_PLANES: u32 = {MOST_UNIFORM}u;\nconst MOST_BODIES: u32 = {MOST_BODIES}u;\n\
         const MOST_WAITING: u32 = {MOST_WAITING}u;\nconst MOST_LAMPS: u32 = {MOST_LAMPS}u;\n\
         const MOST_WAVELENGTHS: u32 = {MOST_WAVELENGTHS}u;\nconst TEXEL_ANGLE: f32 = {TEXEL_ANGLE};\n\
         const NONE: u32 = 0xffffffffu;\nconst MOST_INBOUND: u32 = {MOST_INBOUND}u;\n\
         const MOST_LEVELS: u32 = {MOST_LEVELS}u;\nconst GROUPS_ACROSS: u32 = {GROUPS_ACROSS}u;\n\
         const MOST_METALS: u32 = {MOST_METALS}u;\nconst ROUGHNESS_ROWS: u32 = {}u;\n\
         const MOST_ROUGHNESS_ROWS: u32 = {}u;\nconst COUNTS_TURNS: bool = {counts_turns};\n",
        Roughness::ROWS,
        MOST_ROUGHNESSES * Roughness::ROWS,
    )
}

/// Returns the texts for a kind of surface, and for the light that leaves it.
fn surface(facets: ShaderSurface) -> Vec<&'static str> {
    let leaving = include_str!("../../../../shaders/leaving.wgsl");
    let flat = include_str!("../../../../shaders/flat.wgsl");
    let fields = include_str!("../../../../shaders/implicit.wgsl");
    let jets = include_str!("../../../../shaders/jets.wgsl");
    let convex = include_str!("../../../../shaders/convex.wgsl");
    let branching = include_str!("../../../../shaders/branching.wgsl");
    match facets {
        ShaderSurface::Few => vec![leaving, include_str!("../../../../shaders/planes.wgsl"), flat, convex],
        ShaderSurface::Many => {
            let clusters = include_str!("../../../../shaders/clusters.wgsl");
            vec![gpu_types::CLUSTER_WGSL, leaving, clusters, flat, convex]
        }
        ShaderSurface::Triangles => vec![include_str!("../../../../shaders/triangles.wgsl"), flat, branching],
        ShaderSurface::Smooth => vec![gpu_types::IMPLICIT_SURFACE_WGSL, jets, fields, convex],
        ShaderSurface::Wavy => vec![gpu_types::IMPLICIT_SURFACE_WGSL, jets, fields, branching],
    }
}

impl Pipelines {
    pub fn new(reading: ShaderTask) -> Self {
        Self { reading, by_facets: Default::default() }
    }

    pub fn kernel(&self, device: &wgpu::Device, facets: ShaderSurface, has_metal: bool) -> &Kernel {
        self.by_facets[facets as usize][usize::from(has_metal)].get_or_init(|| Kernel {
            pipeline: compiled(device, source(facets, self.reading, has_metal)),
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
