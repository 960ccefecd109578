//! Measures the peak computing and reading speeds of a graphics card, with which `bench` compares its pictures.

use super::device::{Gpu, GpuError};
use super::shaders::compiled;
use std::time::Instant;

/// The time that a dispatch should take to be measured well, in seconds.
const LONG_ENOUGH_S: f64 = 0.02;

/// The number of dispatches, of which the quickest counts.
const TRIES: usize = 5;

/// The number of invocations in a workgroup.
const GROUP: u32 = 64;

/// The number of turns of the loop that computes; software drivers end loops after 65,535 turns.
const TURNS: f32 = 2048.0;

/// The number of f32 operations in a turn, where a fused multiply-add counts as two.
const FLOPS_PER_TURN: f64 = 128.0;

/// The most workgroups that compute, the number of workgroups that read, and the most turns that read.
const MOST_GROUPS: u32 = 1 << 14;
const MEMORY_GROUPS: u32 = 1 << 12;
const MOST_MEMORY_TURNS: u32 = 1 << 8;

/// The number of reads in a turn of `peak_memory.wgsl`, 16 bytes each. All invocations together read 112 MiB, which
/// is less than the 128 MiB that all cards take.
const READS: u64 = 28;

/// The text of the shader that computes.
pub(super) const ARITHMETIC_WGSL: &str = include_str!("../../../../shaders/peak_arithmetic.wgsl");

/// The text of the shader that reads.
pub(super) const MEMORY_WGSL: &str = include_str!("../../../../shaders/peak_memory.wgsl");

/// The measured peak speeds of a card.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CardPeak {
    /// The number of f32 operations per second, where a fused multiply-add counts as two.
    pub flops: f64,
    /// The number of bytes read from the card's memory per second.
    pub bytes_per_second: f64,
    /// The time of a dispatch with hardly any work, from its submission to its end, in seconds.
    pub launch_s: f64,
}

/// One shader that measures a peak, ready to be dispatched, with the buffer that it reads and writes.
struct Bout<'a> {
    gpu: &'a Gpu,
    pipeline: wgpu::ComputePipeline,
    given: wgpu::Buffer,
    bound: wgpu::BindGroup,
}

impl Gpu {
    /// Measures the card, in less than a second.
    ///
    /// # Errors
    /// Fails with a [`GpuError`] where the card has failed or its memory is too small.
    pub fn peak(&self) -> Result<CardPeak, GpuError> {
        let arithmetic = Bout::new(self, ARITHMETIC_WGSL, MOST_GROUPS, None)?;
        let launch_s = arithmetic.quickest(1, 1.0)?;
        let mut groups = GROUP;
        while groups < MOST_GROUPS && arithmetic.seconds(groups, TURNS)? < LONG_ENOUGH_S {
            groups *= 2;
        }
        let seconds = arithmetic.quickest(groups, TURNS)?;
        let flops = f64::from(groups * GROUP) * f64::from(TURNS) * FLOPS_PER_TURN / seconds;
        drop(arithmetic);
        let invocations = u64::from(MEMORY_GROUPS * GROUP);
        let memory = Bout::new(self, MEMORY_WGSL, MEMORY_GROUPS, Some(invocations * READS * 16))?;
        let mut turns = 1;
        while turns < MOST_MEMORY_TURNS && memory.seconds(MEMORY_GROUPS, turns as f32)? < LONG_ENOUGH_S {
            turns *= 2;
        }
        let seconds = memory.quickest(MEMORY_GROUPS, turns as f32)?;
        let bytes = invocations as f64 * 16.0 * (READS as f64 * f64::from(turns) + 1.0);
        Ok(CardPeak { flops, bytes_per_second: bytes / seconds, launch_s })
    }
}

impl<'a> Bout<'a> {
    /// Compiles a shader for up to `groups` workgroups, which read a buffer of `bytes` bytes where it is given.
    fn new(gpu: &'a Gpu, text: &str, groups: u32, bytes: Option<u64>) -> Result<Self, GpuError> {
        let pipeline = compiled(&gpu.device, text.to_owned());
        let buffer = |size| {
            let usage = wgpu::BufferUsages::STORAGE;
            let label = Some("peak");
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label,
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let given = gpu.buffer("given", &[0; 16], wgpu::BufferUsages::UNIFORM);
        let (found, kept) = (buffer(u64::from(groups * GROUP) * 16), bytes.map(buffer));
        let buffers = [Some(&given), Some(&found), kept.as_ref()];
        let entry = |(k, b): (usize, &wgpu::Buffer)| (k as u32, b.clone());
        let buffers: Vec<(u32, wgpu::Buffer)> =
            buffers.into_iter().flatten().enumerate().map(entry).collect();
        let entries: Vec<_> = buffers
            .iter()
            .map(|(binding, b)| wgpu::BindGroupEntry { binding: *binding, resource: b.as_entire_binding() })
            .collect();
        let bound = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        gpu.check()?;
        let bout = Self { gpu, pipeline, given, bound };
        // The first use of a shader and of its buffers takes longer.
        bout.seconds(1, 1.0).map(|_| bout)
    }

    /// Runs the shader and returns the time from its submission to its end.
    fn seconds(&self, groups: u32, turns: f32) -> Result<f64, GpuError> {
        // The chains stay near a fixed point, far from the numbers that are slow or infinite.
        let given = [0.999_f32, 0.001, turns, (groups * GROUP) as f32];
        self.gpu.queue.write_buffer(&self.given, 0, bytemuck::cast_slice(&given));
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &self.bound, &[]);
            pass.dispatch_workgroups(groups, 1, 1);
        }
        let start = Instant::now();
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.wait()?;
        Ok(start.elapsed().as_secs_f64().max(1e-9))
    }

    /// Runs the shader several times and returns the shortest time.
    fn quickest(&self, groups: u32, turns: f32) -> Result<f64, GpuError> {
        (0..TRIES).try_fold(f64::INFINITY, |least, _| Ok(self.seconds(groups, turns)?.min(least)))
    }
}
