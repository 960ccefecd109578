//! The pixels of a picture in a card's memory, and the dispatches that add to them.

use super::device::{Gpu, GpuError};
use super::gpu_types::{Frame, with};
use super::limits::MOST_BOUNCES;
use super::solids::{Solids, most_turns};
use crate::scene::{Film, Projection, View};
use crate::trace::ray::RayOptions;
use bytemuck::Pod;
use glam::DVec2;

/// Pixels of one dispatch, one ray each: far less than a second's work, so that no driver thinks the card hangs, and a
/// buffer of less than 128 MiB, which all cards take.
const PIXELS_AT_ONCE: u32 = 1 << 20;

/// The same on a software driver.
const PIXELS_AT_ONCE_IN_SOFTWARE: u32 = 1 << 17;

/// Side of a workgroup, pixels.
const WORKGROUP: u32 = 8;

/// The view and the film of a picture, and how far its rays are followed.
pub(super) struct GpuCamera<'a> {
    pub view: &'a View,
    pub film: Film,
    /// How far the stones reach from the origin.
    pub reach: f64,
    pub options: RayOptions,
}

impl GpuCamera<'_> {
    /// Returns the uniform that every dispatch of the picture reads.
    pub fn frame(&self, gpu: &Gpu, solids: &Solids, wavelengths: usize) -> Frame {
        let basis = self.view.basis();
        let distance = match self.view.projection {
            Projection::Orthographic => 0.0,
            Projection::Perspective { distance } => distance,
        };
        let bounces = solids.bounces(gpu, self.options.most_bounces.min(MOST_BOUNCES));
        let [across, down] = self.film.size;
        Frame {
            right: with(basis.right, self.reach),
            up: with(basis.up, self.film.pixel),
            toward: with(basis.toward, distance),
            limits: [self.options.least_weight as f32, 0.0, 0.5, 0.5],
            counts: [solids.count() as u32, wavelengths as u32, bounces, u32::from(self.options.polarised)],
            film: [across, down, 0, 0],
            turn: [0, 1, 0, wavelengths as u32],
            most: [most_turns(gpu), 0, 0, 0],
            strength: [1.0, 0.0, 0.0, 0.0],
        }
    }
}

/// The pixels of some rows in a card's memory, and the pipeline that adds to them.
pub(super) struct Stage<'a> {
    pub gpu: &'a Gpu,
    pipeline: &'a wgpu::ComputePipeline,
    pub frame: Frame,
    frame_buffer: wgpu::Buffer,
    seen: wgpu::Buffer,
    back: wgpu::Buffer,
    bound: wgpu::BindGroup,
    /// Bytes per pixel.
    width: u64,
}

impl<'a> Stage<'a> {
    /// Creates a stage for `rows` rows of the frame's film; `entries` are what its shader needs besides frame and pixels.
    pub fn new<T: Pod>(
        gpu: &'a Gpu,
        pipeline: &'a wgpu::ComputePipeline,
        frame: Frame,
        rows: u32,
        entries: Vec<wgpu::BindGroupEntry>,
    ) -> Result<Self, GpuError> {
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let frame_buffer = gpu.buffer("frame", bytemuck::bytes_of(&frame), usage);
        let width = size_of::<T>() as u64;
        let empty = |label, usage| {
            let size = u64::from(rows) * u64::from(frame.film[0]) * width;
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let seen = empty("seen", wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let back = empty("back", wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let mut all = vec![
            wgpu::BindGroupEntry { binding: 0, resource: frame_buffer.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 2, resource: seen.as_entire_binding() },
        ];
        all.extend(entries);
        let bound = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &all,
        });
        gpu.check()?;
        Ok(Self { gpu, pipeline, frame, frame_buffer, seen, back, bound, width })
    }

    /// Returns the rows that one dispatch takes of a film of this size.
    pub fn rows(gpu: &Gpu, [across, down]: [u32; 2]) -> u32 {
        let pixels = if gpu.is_software() { PIXELS_AT_ONCE_IN_SOFTWARE } else { PIXELS_AT_ONCE };
        (pixels / across).clamp(1, down)
    }

    /// Traces one ray of each pixel in `count` rows from `first` and adds it to the pixels.
    ///
    /// `shift` is the ray's place in its pixel, or in its cell of the pixel's grid; `to_middle` is the distance from its
    /// wavelength to its band's middle, as a part of the band; `turn` becomes the field of that name in [`Frame`].
    pub fn look(
        &self,
        (first, count): (u32, u32),
        (shift, to_middle): (DVec2, f64),
        turn: [u32; 4],
    ) -> Result<(), GpuError> {
        let mut frame = self.frame;
        (frame.film[2], frame.film[3], frame.turn) = (first, count, turn);
        frame.limits[1..].copy_from_slice(&[to_middle as f32, shift.x as f32, shift.y as f32]);
        self.gpu.queue.write_buffer(&self.frame_buffer, 0, bytemuck::bytes_of(&frame));
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(self.pipeline);
            pass.set_bind_group(0, &self.bound, &[]);
            pass.dispatch_workgroups(frame.film[0].div_ceil(WORKGROUP), count.div_ceil(WORKGROUP), 1);
        }
        self.gpu.queue.submit([encoder.finish()]);
        // Dispatches run one after the other: queued up, they would go on after the watch has asked to stop.
        self.gpu.wait()
    }

    /// Reads the pixels of the first `count` rows back.
    pub fn read<T: Pod>(&self, count: u32) -> Result<Vec<T>, GpuError> {
        let bytes = u64::from(count) * u64::from(self.frame.film[0]) * self.width;
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(&self.seen, 0, &self.back, 0, bytes);
        self.gpu.queue.submit([encoder.finish()]);
        self.back.map_async(wgpu::MapMode::Read, 0..bytes, |_| {});
        self.gpu.wait()?;
        let mapped = self.back.get_mapped_range(0..bytes).map_err(|e| self.gpu.failed(e.to_string()))?;
        let seen = bytemuck::pod_collect_to_vec(&mapped);
        drop(mapped);
        self.back.unmap();
        Ok(seen)
    }
}
