//! The pixels of a picture in a card's memory, and the dispatches that add to them.

use super::device::{Gpu, GpuError};
use super::gpu_types::{Frame, three};
use super::limits::{GROUPS_ACROSS, MOST_BOUNCES};
use super::pieces::{Piece, Pieces, stride};
use super::shaders::Kernel;
use super::solids::{Solids, most_turns, plane_sixteenths};
use crate::ray::RayOptions;
use brillianteer_base::{Stopped, Watch};
use brillianteer_scene::{Film, Projection, View};
use bytemuck::Pod;
use glam::DVec2;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// The side of a tile, which one workgroup traces, in pixels.
const TILE: u32 = 8;

/// The cost of a ray that misses all stones, in plane tests.
const BESIDE: f64 = 8.0;

/// The view and the film of a picture, and the limits up to which its rays are followed.
pub(super) struct GpuCamera<'a> {
    pub view: &'a View,
    pub film: Film,
    /// The reach of the stones from the origin.
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
        Frame {
            most_turns: most_turns(gpu),
            pass_number: 0,
            metal_count: solids.metal_count() as u32,
            plane_sixteenths: plane_sixteenths(gpu),
            right: three(basis.right),
            reach: self.reach as f32,
            up: three(basis.up),
            pixel: self.film.pixel as f32,
            toward: three(basis.toward),
            eye_distance: distance as f32,
            least_weight: self.options.least_weight as f32,
            by_chance: 0.0,
            place: [0.5; 2],
            stone_count: solids.count() as u32,
            wavelength_count: wavelengths as u32,
            most_bounces: bounces,
            is_polarised: u32::from(self.options.polarised),
            size: self.film.size,
            first_row: 0,
            row_count: 0,
            cell: 0,
            grid: 1,
            first_wavelength: 0,
            end_wavelength: wavelengths as u32,
            first_tile: 0,
            tile_count: 0,
            tile_stride: 1,
            all_tiles: 1,
            stretch: [0.0; 2],
            strength: 1.0,
            unused: 0.0,
        }
    }
}

/// One ray of each pixel of a strip, in all bands.
pub(super) struct StripLayer {
    /// The ray's place in its pixel, or in its cell of the pixel's grid.
    pub shift: DVec2,
    /// The shift, in pixels, of the picture's film from a film around the origin.
    pub origin: DVec2,
    /// The number of the cell in the pixel's grid, and the cells along each side of a pixel.
    pub cell: [u32; 2],
    /// The number of bands.
    pub bands: u32,
}

/// The pixels of some rows in a card's memory, and the kernel that adds to them.
pub(super) struct Stage<'a> {
    pub gpu: &'a Gpu,
    kernel: &'a Kernel,
    pub frame: Frame,
    /// The greatest cost of a ray through the stones in one band, in plane tests.
    cost: f64,
    /// The most bands of one dispatch.
    pub bands_at_once: u32,
    frame_buffer: wgpu::Buffer,
    seen: wgpu::Buffer,
    back: wgpu::Buffer,
    bound: wgpu::BindGroup,
    /// The number of bytes per pixel.
    width: u64,
    /// The number of this stage, for the throttle.
    number: u64,
}

impl<'a> Stage<'a> {
    /// Creates a stage for up to `rows` rows of the frame's film. `cost` is the greatest cost of a ray through the
    /// stones in one band, in plane tests, and the most bands of a dispatch. `entries` are the bind group entries of
    /// the shader besides frame and pixels.
    pub fn new<T: Pod>(
        gpu: &'a Gpu,
        kernel: &'a Kernel,
        (frame, rows): (Frame, u32),
        (cost, bands_at_once): (f64, u32),
        entries: Vec<wgpu::BindGroupEntry>,
    ) -> Result<Self, GpuError> {
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let frame_buffer = gpu.buffer("frame", bytemuck::bytes_of(&frame), usage);
        let width = size_of::<T>() as u64;
        let empty = |label, usage| {
            let size = u64::from(rows) * u64::from(frame.size[0]) * width;
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
            layout: &kernel.pipeline.get_bind_group_layout(0),
            entries: &all,
        });
        static STAGES: AtomicU64 = AtomicU64::new(1);
        let number = STAGES.fetch_add(1, Ordering::Relaxed);
        let stage =
            Self { gpu, kernel, frame, cost, bands_at_once, frame_buffer, seen, back, bound, width, number };
        // A dispatch without tiles runs first, so that copied data arrive, and drivers that compile late do so,
        // before times are measured.
        stage.submit(&Frame { first_tile: 0, tile_count: 0, tile_stride: 1, all_tiles: 1, ..frame }, 1)?;
        Ok(stage)
    }

    /// Traces one ray of each pixel in a strip of the film's rows and adds it to the pixels. Each dispatch takes as
    /// much work as the card was measured to do in a short time. The bits of the sums do not depend on how the work
    /// is divided.
    pub fn trace<E>(&self, strip: &Range<u32>, layer: &StripLayer, watch: Watch) -> Result<(), E>
    where
        E: From<Stopped> + From<GpuError>,
    {
        let mut frame = self.frame;
        let tiles = frame.size[0].div_ceil(TILE) * (strip.len() as u32).div_ceil(TILE);
        (frame.first_row, frame.row_count) = (strip.start, strip.len() as u32);
        frame.place = layer.shift.as_vec2().to_array();
        [frame.cell, frame.grid] = layer.cell;
        (frame.tile_stride, frame.all_tiles) = (stride(tiles), tiles);
        let share = covered(&frame, strip, layer.origin);
        let cost = f64::from(TILE * TILE) * (BESIDE + share * self.cost);
        let all = f64::from(tiles) * f64::from(layer.bands);
        let (mut pieces, mut done) = (Pieces::new(tiles, layer.bands, self.bands_at_once), 0);
        self.kernel.throttle().open(self.number);
        loop {
            let most = self.kernel.throttle().most() / cost;
            let Some(piece) = pieces.next(most) else { return Ok(()) };
            if watch(done as f64 / all).is_break() {
                return Err(Stopped.into());
            }
            done += piece.size();
            (frame.first_wavelength, frame.end_wavelength) = (piece.bands.start, piece.bands.end);
            (frame.first_tile, frame.tile_count) = (piece.tiles.start, piece.tiles.len() as u32);
            self.dispatch(&frame, &piece, cost)?;
        }
    }

    /// Dispatches one piece of work with this cost per tile and band.
    fn dispatch(&self, frame: &Frame, piece: &Piece, cost: f64) -> Result<(), GpuError> {
        let took = self.submit(frame, piece.tiles.len() as u32)?;
        self.kernel.throttle().note(cost * piece.size() as f64, took);
        let pixels = piece.tiles.len() as u64 * u64::from(TILE * TILE);
        self.gpu.count(took, 2 * pixels * self.width);
        Ok(())
    }

    /// Dispatches this many workgroups, waits for them and returns their time. It waits because queued dispatches
    /// would run on after the watch has asked to stop.
    fn submit(&self, frame: &Frame, count: u32) -> Result<Duration, GpuError> {
        self.gpu.queue.write_buffer(&self.frame_buffer, 0, bytemuck::bytes_of(frame));
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.kernel.pipeline);
            pass.set_bind_group(0, &self.bound, &[]);
            pass.dispatch_workgroups(count.min(GROUPS_ACROSS), count.div_ceil(GROUPS_ACROSS), 1);
        }
        let start = Instant::now();
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.wait()?;
        Ok(start.elapsed())
    }

    /// Reads the pixels of the first `count` rows back, and calls `each` with them.
    pub fn read<T: Pod, R>(&self, count: u32, each: impl FnOnce(&[T]) -> R) -> Result<R, GpuError> {
        let bytes = u64::from(count) * u64::from(self.frame.size[0]) * self.width;
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(&self.seen, 0, &self.back, 0, bytes);
        self.gpu.queue.submit([encoder.finish()]);
        self.back.map_async(wgpu::MapMode::Read, 0..bytes, |_| {});
        self.gpu.wait()?;
        let mapped = self.back.get_mapped_range(0..bytes).map_err(|e| self.gpu.failed(e.to_string()))?;
        // The pixels are handed out where the card's driver put them, because a copy takes longer than their way here.
        let done = each(bytemuck::cast_slice(&mapped));
        drop(mapped);
        self.back.unmap();
        Ok(done)
    }
}

/// Returns the approximate part of a strip's pixels that the ball around all stones covers. `origin` is the shift of
/// the film, in pixels.
fn covered(frame: &Frame, strip: &Range<u32>, origin: DVec2) -> f64 {
    const LINES: u32 = 64;
    let [across, down] = frame.size.map(f64::from);
    let middle = DVec2::new(across, down) / 2.0 - origin;
    let (reach, distance) = (f64::from(frame.reach), f64::from(frame.eye_distance));
    let nearness = if distance > 0.0 { (1.0 - (reach / distance).powi(2)).sqrt() } else { 1.0 };
    // For an eye inside the ball, the ball is everywhere; the root is then NaN.
    let radius = reach / f64::from(frame.pixel) / nearness;
    if !radius.is_finite() {
        return 1.0;
    }
    let line = |k: u32| {
        let part = (f64::from(k) + 0.5) / f64::from(LINES);
        let y = f64::from(strip.start) + strip.len() as f64 * part - middle.y;
        let half = (radius * radius - y * y).max(0.0).sqrt();
        ((middle.x + half).min(across) - (middle.x - half).max(0.0)).max(0.0) / across
    };
    (0..LINES).map(line).sum::<f64>() / f64::from(LINES)
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable;

    /// A film of 100 x 200 pixels around a ball of this many pixels, seen from `distance` pixels away.
    fn frame(radius: f32, distance: f32) -> Frame {
        let mut frame = Frame::zeroed();
        frame.size = [100, 200];
        (frame.reach, frame.pixel, frame.eye_distance) = (radius * 0.1, 0.1, distance * 0.1);
        frame
    }

    #[test]
    fn the_part_that_stones_cover_is_that_of_a_disc() {
        let disc = std::f64::consts::PI * 1600.0 / 20_000.0;
        assert!((covered(&frame(40.0, 0.0), &(0..200), DVec2::ZERO) / disc - 1.0).abs() < 0.01);
        let [top, middle] = [0..50, 50..150].map(|strip| covered(&frame(40.0, 0.0), &strip, DVec2::ZERO));
        assert!(top == 0.0 && (middle / (2.0 * disc) - 1.0).abs() < 0.01, "{top}, {middle}");
        let beside = covered(&frame(40.0, 0.0), &(0..200), DVec2::new(50.0, 0.0));
        assert!((beside / (0.5 * disc) - 1.0).abs() < 0.01, "{beside}");
        let near = covered(&frame(40.0, 50.0), &(0..200), DVec2::ZERO);
        assert!(near > 1.5 * disc && near < 1.0, "{near}");
        assert_eq!(covered(&frame(40.0, 30.0), &(0..200), DVec2::ZERO), 1.0);
    }
}
