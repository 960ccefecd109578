//! The shaders, which `imports` joins from the files that each of them names, and which are compiled when first used.
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

use super::imports::joined;
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

/// Returns a shader's text, with its structs and constants. `has_metal` is true where metal stands beside the stones,
/// which only pictures under light allow.
pub(super) fn source(facets: ShaderSurface, reading: ShaderTask, has_metal: bool) -> String {
    let mut parts = surface(facets).to_vec();
    match reading {
        ShaderTask::Scope => parts.push("scope"),
        ShaderTask::Light => parts.extend(["light", if has_metal { "metal" } else { "no_metal" }]),
    }
    constants(has_metal || facets.count_turns()) + &joined(&parts)
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

/// Returns the files for a kind of surface, and for the light that leaves it.
fn surface(facets: ShaderSurface) -> &'static [&'static str] {
    match facets {
        ShaderSurface::Few => &["planes"],
        ShaderSurface::Many => &["clusters"],
        ShaderSurface::Triangles => &["triangles"],
        ShaderSurface::Smooth => &["implicit", "convex"],
        ShaderSurface::Wavy => &["implicit", "branching"],
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
