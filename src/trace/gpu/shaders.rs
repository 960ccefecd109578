//! The shaders: put together as text, compiled once.

use super::door;
use super::light::{MOST_LAMPS, MOST_WAVELENGTHS};
use super::solids::{MOST_BODIES, MOST_INBOUND, MOST_LEVELS, MOST_UNIFORM};
use crate::trace::sitting::MOST_WAITING;
use crate::trace::surround::TEXEL_ANGLE;
use std::sync::OnceLock;

/// What stones are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Facets {
    /// At most 1024 planes in all, at most 192 in a stone.
    Few,
    /// More, in bunches.
    Many,
    /// Triangles, not all of them of a convex stone.
    Triangles,
    /// Glass shapes that are convex.
    Smooth,
    /// Glass shapes, not all of them convex.
    Wavy,
}

impl Facets {
    /// All kinds.
    pub const ALL: [Self; 5] = [Self::Few, Self::Many, Self::Triangles, Self::Smooth, Self::Wavy];

    /// Whether rays count the turns of their loops.
    pub fn count_turns(self) -> bool {
        matches!(self, Self::Triangles | Self::Smooth | Self::Wavy)
    }
}

/// What is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reading {
    /// Energy by the bands of a scope.
    Scope,
    /// Colour under light.
    Light,
}

/// One reading's pipelines, each compiled when first used.
pub(super) struct Pipelines {
    reading: Reading,
    by_facets: [OnceLock<wgpu::ComputePipeline>; Facets::ALL.len()],
}

/// A shader's text, its structs and constants in front.
pub(super) fn source(facets: Facets, reading: Reading) -> String {
    let constants = format!(
        "const MOST_PLANES: u32 = {MOST_UNIFORM}u;\nconst MOST_BODIES: u32 = {MOST_BODIES}u;\n\
         const MOST_WAITING: u32 = {MOST_WAITING}u;\nconst MOST_LAMPS: u32 = {MOST_LAMPS}u;\n\
         const MOST_WAVELENGTHS: u32 = {MOST_WAVELENGTHS}u;\nconst TEXEL_ANGLE: f32 = {TEXEL_ANGLE};\n\
         const NONE: u32 = 0xffffffffu;\nconst MOST_INBOUND: u32 = {MOST_INBOUND}u;\n\
         const MOST_LEVELS: u32 = {MOST_LEVELS}u;\n"
    );
    let stones = "@group(0) @binding(0) var<uniform> frame: Frame;\n\
        @group(0) @binding(4) var<uniform> bodies: array<Body, MOST_BODIES>;\n\
        @group(0) @binding(5) var<storage, read> media: array<Medium>;\n";
    let flat = include_str!("../../../shaders/flat.wgsl");
    let fields = include_str!("../../../shaders/fields.wgsl");
    let jets = include_str!("../../../shaders/jets.wgsl");
    let convex = include_str!("../../../shaders/convex.wgsl");
    let branching = include_str!("../../../shaders/branching.wgsl");
    let facets: &[&str] = match facets {
        Facets::Few => &[include_str!("../../../shaders/planes.wgsl"), flat, convex],
        Facets::Many => &[door::BUNCH_WGSL, include_str!("../../../shaders/polytope.wgsl"), flat, convex],
        Facets::Triangles => &[
            door::TRIANGLE_WGSL,
            door::NODE_WGSL,
            include_str!("../../../shaders/triangles.wgsl"),
            flat,
            branching,
        ],
        Facets::Smooth => &[door::FIELD_WGSL, jets, fields, convex],
        Facets::Wavy => &[door::FIELD_WGSL, jets, fields, branching],
    };
    let reading: &[&str] = match reading {
        Reading::Scope => &[door::BANDS_WGSL, door::SEEN_WGSL, include_str!("../../../shaders/scope.wgsl")],
        Reading::Light => &[
            door::SURROUND_WGSL,
            door::LAMP_WGSL,
            door::RESPONSE_WGSL,
            door::LIT_WGSL,
            include_str!("../../../shaders/surround.wgsl"),
            include_str!("../../../shaders/light.wgsl"),
        ],
    };
    let common = [
        door::FRAME_WGSL,
        door::BODY_WGSL,
        door::MEDIUM_WGSL,
        &constants,
        stones,
        include_str!("../../../shaders/optics.wgsl"),
        include_str!("../../../shaders/trace.wgsl"),
        include_str!("../../../shaders/camera.wgsl"),
    ];
    common.iter().chain(facets).chain(reading).copied().collect()
}

impl Pipelines {
    pub fn new(reading: Reading) -> Self {
        Self { reading, by_facets: Default::default() }
    }

    pub fn pipeline(&self, device: &wgpu::Device, facets: Facets) -> &wgpu::ComputePipeline {
        self.by_facets[facets as usize].get_or_init(|| compiled(device, source(facets, self.reading)))
    }
}

/// The pipeline of a text's one entry.
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
