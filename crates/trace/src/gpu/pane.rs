//! Draws panes of liquid glass on a graphics card. No ray is traced.

use super::device::{Gpu, GpuError};
use super::gpu_types::PaneData;
use super::imports::joined;
use super::shaders::compiled;
use wgpu::BufferUsages;

/// Side of the square of pixels that one workgroup draws.
const TILE: u32 = 8;

/// A background in a card's memory, and a buffer for pictures of panes in front of it. The shader is compiled once
/// for all panes.
pub struct PaneStage<'a> {
    gpu: &'a Gpu,
    size: [u32; 2],
    data: wgpu::Buffer,
    drawn: wgpu::Buffer,
    back: wgpu::Buffer,
    bound: wgpu::BindGroup,
}

/// Returns the text of the shader.
pub(super) fn pane_source() -> String {
    joined(&["liquid_glass"])
}

impl<'a> PaneStage<'a> {
    /// Copies a background of this size to the card; pixels missing from the list count as dark.
    ///
    /// # Errors
    /// Fails with a [`GpuError`] where the picture is too large for the card, or the card has failed.
    pub fn new(gpu: &'a Gpu, size: [u32; 2], background: &[[f32; 3]]) -> Result<Self, GpuError> {
        let [width, height] = size;
        let bytes = 16 * u64::from(width) * u64::from(height);
        let most = gpu.device.limits().max_storage_buffer_binding_size;
        if bytes == 0 || bytes > most {
            let most = ((most / 16) as f64).sqrt() as u32;
            return Err(GpuError::PictureTooLarge { name: gpu.name().to_owned(), width, height, most });
        }
        let mut pixels: Vec<[f32; 4]> = background.iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect();
        pixels.resize(bytes as usize / 16, [0.0; 4]);
        let given = gpu.buffer("background", bytemuck::cast_slice(&pixels), BufferUsages::STORAGE);
        let data = gpu.buffer("pane", &[0; size_of::<PaneData>()], BufferUsages::UNIFORM);
        let buffer = |label, usage| {
            let label = Some(label);
            let size = bytes;
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label,
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let drawn = buffer("drawn pane", BufferUsages::STORAGE | BufferUsages::COPY_SRC);
        let back = buffer("back", BufferUsages::MAP_READ | BufferUsages::COPY_DST);
        let pipeline = gpu.panes.get_or_init(|| compiled(&gpu.device, pane_source()));
        let bound = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: data.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: given.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 2, resource: drawn.as_entire_binding() },
            ],
        });
        gpu.check()?;
        Ok(Self { gpu, size, data, drawn, back, bound })
    }

    /// Draws a pane and waits until the card has finished. The picture stays on the card.
    ///
    /// # Errors
    /// Fails with a [`GpuError`] where the card has failed.
    pub fn draw(&self, pane: &PaneData) -> Result<(), GpuError> {
        let pipeline = self.gpu.panes.get_or_init(|| compiled(&self.gpu.device, pane_source()));
        let [width, height] = self.size;
        let data = PaneData { size: self.size, ..*pane };
        self.gpu.queue.write_buffer(&self.data, 0, bytemuck::bytes_of(&data));
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &self.bound, &[]);
            pass.dispatch_workgroups(width.div_ceil(TILE), height.div_ceil(TILE), 1);
        }
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.wait()
    }

    /// Reads the picture that was drawn last: red, green, blue and cover of each pixel, premultiplied, row by row.
    ///
    /// # Errors
    /// Fails with a [`GpuError`] where the card has failed.
    pub fn read(&self) -> Result<Vec<[f32; 4]>, GpuError> {
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(&self.drawn, 0, &self.back, 0, self.back.size());
        self.gpu.queue.submit([encoder.finish()]);
        self.back.map_async(wgpu::MapMode::Read, .., |_| {});
        self.gpu.wait()?;
        let mapped = self.back.get_mapped_range(..).map_err(|e| self.gpu.failed(e.to_string()))?;
        let pixels = bytemuck::pod_collect_to_vec(&mapped);
        drop(mapped);
        self.back.unmap();
        Ok(pixels)
    }
}
