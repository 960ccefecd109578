//! Traces pictures under light on a graphics card.

use super::device::{Gpu, GpuError};
use super::gpu_types::{self, Lamp, Response, three, with};
use super::limits::MOST_WAVELENGTHS;
use super::metals::GpuMetals;
use super::solids::Solids;
use super::stage::{GpuCamera, Stage, StripLayer};
use crate::environment::{Environment, HEAD_EDGE};
use crate::sampling::{LitScene, ProgressiveImage, RadiancePixel, SamplePass};
use brillianteer_base::{Stopped, Watch};
use brillianteer_math::PosedSolid;
use brillianteer_scene::{Film, Instance, MOST_LAMPS, Mipmap, Panorama};
use bytemuck::Zeroable;
use glam::DVec3;
use std::ops::Range;
use wgpu::util::DeviceExt;

/// The most wavelengths of one dispatch.
const AT_ONCE: u32 = 16;

/// Rows of a picture under light, traced by a graphics card.
pub struct ByCard<'a> {
    rows: Range<u32>,
    pub(super) stage: Stage<'a>,
    media: wgpu::Buffer,
    /// The unit of length in which the shader traces each stone, in units of the stone's body.
    units: Vec<f64>,
    metals: Option<GpuMetals>,
    responses: wgpu::Buffer,
    wavelengths: usize,
    passes: u32,
    film: Film,
}

impl<'a> ByCard<'a> {
    /// Returns the most rows that may be prepared at once of a film with this many pixels across.
    pub fn most_rows(across: u32) -> u32 {
        // So many rows fill a buffer of 64 MiB.
        ((1 << 21) / across).max(1)
    }

    /// Prepares some rows of a picture, at most [`most_rows`](Self::most_rows), for sample passes of `wavelengths`
    /// bands. There may be at most [`MOST_WAVELENGTHS`] bands; `around` is the environment of `lit_scene`.
    ///
    /// # Errors
    /// Fails with a [`GpuError`] where the card has failed or the scene exceeds its limits.
    pub fn new(
        gpu: &'a Gpu,
        lit_scene: &LitScene,
        around: &GpuEnvironment,
        rows: Range<u32>,
        wavelengths: usize,
    ) -> Result<Self, GpuError> {
        if !(1..=MOST_WAVELENGTHS).contains(&wavelengths) {
            return Err(GpuError::Wavelengths { count: wavelengths, most: MOST_WAVELENGTHS });
        }
        let stones: Vec<PosedSolid> = lit_scene.scene.instances.iter().map(Instance::solid).collect();
        let solids = Solids::new(gpu, &stones, &lit_scene.scene.metals)?;
        let copied = |label, bytes: usize, usage| {
            let usage = usage | wgpu::BufferUsages::COPY_DST;
            gpu.buffer(label, &vec![0; bytes], usage)
        };
        let finishes = solids.metals.as_ref().map_or(0, GpuMetals::finish_count);
        let bytes = size_of::<gpu_types::Medium>() * wavelengths * (stones.len() + finishes);
        let media = copied("media", bytes, wgpu::BufferUsages::STORAGE);
        // The response of all bands together follows those of the single bands.
        let bytes = size_of::<Response>() * (MOST_WAVELENGTHS + 1);
        let responses = copied("responses", bytes, wgpu::BufferUsages::UNIFORM);
        let mut entries = solids.entries(&media);
        entries.extend(around.entries());
        entries.push(wgpu::BindGroupEntry { binding: 10, resource: responses.as_entire_binding() });
        let eye = GpuCamera {
            view: lit_scene.view,
            film: lit_scene.film,
            reach: lit_scene.scene.reach(),
            options: lit_scene.options,
        };
        let frame = eye.frame(gpu, &solids, wavelengths);
        solids.enough(gpu, frame.most_bounces, lit_scene.options.most_bounces)?;
        let kernel = gpu.lights.kernel(&gpu.device, solids.surfaces.facets, solids.metals.is_some());
        // A software driver counts the loop turns of all wavelengths of a dispatch together.
        let at_once = if gpu.is_software() { 1 } else { AT_ONCE };
        let cost = (solids.cost(frame.most_bounces), at_once);
        let count = rows.len() as u32;
        let stage = Stage::new::<gpu_types::RadiancePixel>(gpu, kernel, (frame, count), cost, entries)?;
        Ok(Self {
            rows,
            stage,
            media,
            units: solids.units,
            metals: solids.metals,
            responses,
            wavelengths,
            passes: 0,
            film: lit_scene.film,
        })
    }

    /// Writes the media of the stones, the finishes of metal and the colours of the bands to the card's memory.
    fn write_frame(&self, pass: &SamplePass) {
        let of_stone = |(media, &unit): (&Vec<brillianteer_scene::Medium>, &f64)| -> Vec<[f32; 4]> {
            media.iter().map(|medium| bytemuck::cast(gpu_types::Medium::new(medium, unit))).collect()
        };
        let finishes = self.metals.iter().flat_map(|metals| metals.finishes(&pass.metals));
        let media: Vec<[f32; 4]> =
            pass.media.iter().zip(&self.units).flat_map(of_stone).chain(finishes).collect();
        let wide = |c: DVec3| with(c, 0.0);
        let response = |r: &[DVec3; 4]| {
            let [key, red, green, blue] = r.map(wide);
            Response { key, red, green, blue }
        };
        let bands = pass.responses.iter().chain(std::iter::once(&pass.whole));
        let responses: Vec<Response> = bands.map(response).collect();
        self.stage.gpu.queue.write_buffer(&self.media, 0, bytemuck::cast_slice(&media));
        self.stage.gpu.queue.write_buffer(&self.responses, 0, bytemuck::cast_slice(&responses));
    }
}

impl<E: From<Stopped> + From<GpuError>> ProgressiveImage<E> for ByCard<'_> {
    fn add_pass(&mut self, pass: &SamplePass, watch: Watch) -> Result<(), E> {
        self.write_frame(pass);
        let stretch = pass.footprint_in_image(&self.film).as_vec2();
        // Chance ends weak light where metal sends it back to stones again and again; else all light is followed.
        self.stage.frame.by_chance = if self.metals.is_some() { pass.by_chance as f32 } else { 0.0 };
        self.stage.frame.pass_number = pass.number;
        (self.stage.frame.strength, self.stage.frame.stretch) = (pass.strength as f32, stretch.to_array());
        let origin = self.film.shift();
        let layer =
            StripLayer { shift: pass.shift + origin, origin, cell: [0, 1], bands: self.wavelengths as u32 };
        self.stage.trace::<E>(&self.rows, &layer, watch)?;
        self.passes += 1;
        Ok(())
    }

    fn each_pixel(&self, each: &mut dyn FnMut(&RadiancePixel)) -> Result<(), E> {
        let per_pass = 1.0 / f64::from(self.passes.max(1));
        let share = per_pass / self.wavelengths as f64;
        let mut pixel = |sum: &gpu_types::RadiancePixel| {
            let [cover, unresolved, absorbed] =
                [sum.cover, sum.unresolved, sum.absorbed].map(|x| f64::from(x) * share);
            let colour = DVec3::from(sum.colour.map(f64::from)) * per_pass;
            each(&RadiancePixel { colour, cover, unresolved, absorbed });
        };
        let count = self.rows.len() as u32;
        Ok(self.stage.read(count, |pixels| pixels.iter().for_each(&mut pixel))?)
    }
}

/// The environment of a picture in a card's memory. It is the same for all rows of the picture.
pub struct GpuEnvironment {
    environment: wgpu::Buffer,
    lamps: wgpu::Buffer,
    map: wgpu::TextureView,
    photo: wgpu::TextureView,
}

impl GpuEnvironment {
    /// Copies an environment to the card's memory.
    ///
    /// # Errors
    /// Fails with a [`GpuError`] where there are more lamps, or a larger picture, than the card takes.
    pub fn new(gpu: &Gpu, environment: &Environment) -> Result<Self, GpuError> {
        let count = environment.map.lamps.len();
        if count > MOST_LAMPS {
            return Err(GpuError::TooManyLamps { count, most: MOST_LAMPS });
        }
        let mut lamps: Vec<Lamp> = environment
            .map
            .lamps
            .iter()
            .map(|l| Lamp {
                toward: three(l.toward),
                chord_squared: l.chord_squared as f32,
                radiance: l.radiance.as_vec4().to_array(),
            })
            .collect();
        let uniform = environment_uniform(environment, lamps.len());
        lamps.resize(MOST_LAMPS, Lamp::zeroed());
        let side = environment.map.side as u32;
        let levels: Vec<&[[f32; 4]]> = environment.map.levels.iter().map(Vec::as_slice).collect();
        let none = Mipmap::new(Panorama { width: 1, height: 1, pixels: vec![[0.0; 3]] });
        let photo = environment.backplate.map_or(&none, |backplate| backplate.picture);
        let texel = |&[r, g, b]: &[f32; 3]| [r, g, b, 0.0];
        let texels: Vec<Vec<[f32; 4]>> =
            photo.levels().iter().map(|level| level.pixels.iter().map(texel).collect()).collect();
        let finest = photo.picture();
        let map = texture(gpu, (side, side), &levels)?;
        let photo = texture(
            gpu,
            (finest.width, finest.height),
            &texels.iter().map(Vec::as_slice).collect::<Vec<_>>(),
        )?;
        Ok(Self {
            environment: gpu.buffer("environment", bytemuck::bytes_of(&uniform), wgpu::BufferUsages::UNIFORM),
            lamps: gpu.buffer("lamps", bytemuck::cast_slice(&lamps), wgpu::BufferUsages::UNIFORM),
            map,
            photo,
        })
    }

    fn entries(&self) -> [wgpu::BindGroupEntry<'_>; 4] {
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        [
            entry(6, self.environment.as_entire_binding()),
            entry(7, self.lamps.as_entire_binding()),
            entry(8, wgpu::BindingResource::TextureView(&self.map)),
            entry(9, wgpu::BindingResource::TextureView(&self.photo)),
        ]
    }
}

fn environment_uniform(environment: &Environment, lamps: usize) -> gpu_types::Environment {
    let Environment { map: sky, basis, head, backplate: behind, backdrop, .. } = environment;
    // A cosine of 3 stands for no head, because no direction has so large a cosine.
    let cos_head = if *head > 0.0 { head.cos() } else { 3.0 };
    let (distance, width) = behind.map_or((0.0, 0.0), |b| (b.distance, b.width));
    gpu_types::Environment {
        right: three(basis.right),
        map_side: sky.side as f32,
        up: three(basis.up),
        lamp_count: lamps as u32,
        zenith: three(basis.toward),
        last_level: (sky.levels.len() - 1) as f32,
        backplate_distance: distance as f32,
        backplate_width: width as f32,
        cos_head: cos_head as f32,
        head_edge: HEAD_EDGE as f32,
        backdrop: [f32::from(u8::from(*backdrop)), 0.0, 0.0, 0.0],
    }
}

/// Creates a texture with four numbers per pixel, with its coarser levels.
fn texture(
    gpu: &Gpu,
    (width, height): (u32, u32),
    levels: &[&[[f32; 4]]],
) -> Result<wgpu::TextureView, GpuError> {
    let most = gpu.device.limits().max_texture_dimension_2d;
    if width.max(height) > most {
        return Err(GpuError::PictureTooLarge { name: gpu.name().to_owned(), width, height, most });
    }
    let texture = gpu.device.create_texture_with_data(
        &gpu.queue,
        &wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: levels.len() as u32,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::LayerMajor,
        bytemuck::cast_slice(&levels.concat()),
    );
    Ok(texture.create_view(&wgpu::TextureViewDescriptor::default()))
}
