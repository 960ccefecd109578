//! Opens a graphics card, and defines the errors of one.

use super::shaders::{Pipelines, ShaderTask};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Duration;

/// The reason why the graphics card cannot do the work; point rays on the processor can do it instead.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum GpuError {
    /// There is no card, or no driver that can compute.
    #[error("no graphics card that can compute was found ({0}); its Vulkan driver may be missing")]
    NoAdapter(String),
    /// The driver refuses a device with the least limits that the program needs.
    #[error("{name} is too old or its driver too limited ({why})")]
    TooLimited {
        /// The card's name.
        name: String,
        /// The driver's message.
        why: String,
    },
    /// The card has too little memory for this piece of work; a smaller one may fit.
    #[error("{name} has too little memory for this ({why})")]
    OutOfMemory {
        /// The card's name.
        name: String,
        /// The driver's message.
        why: String,
    },
    /// The card failed during the work, for example because its driver was reset.
    #[error("{name} failed: {why}")]
    Failed {
        /// The card's name.
        name: String,
        /// The driver's message.
        why: String,
    },
    /// There are more stones than the card has room for.
    #[error("the scene has {count} stones, but the graphics card takes at most {most}")]
    TooManyStones {
        /// The number of stones.
        count: usize,
        /// The most stones that the card takes.
        most: usize,
    },
    /// There are more triangles than the card has room for.
    #[error(
        "stones and metal have {count} triangles (those of metal count twice), but the graphics card takes at most {most}"
    )]
    TooManyTriangles {
        /// The number of triangles.
        count: usize,
        /// The most triangles that the card takes.
        most: usize,
    },
    /// There are more bodies of metal than the card has room for.
    #[error("the scene has {count} bodies of metal, but the graphics card takes at most {most}")]
    TooManyMetals {
        /// The number of bodies of metal.
        count: usize,
        /// The most bodies of metal that the card takes.
        most: usize,
    },
    /// The metal has more kinds of roughness than the card has room for.
    #[error("the metal has {count} kinds of roughness, but the graphics card takes at most {most}")]
    TooManyRoughnesses {
        /// The number of kinds.
        count: usize,
        /// The most kinds that the card takes.
        most: usize,
    },
    /// Smooth solids stand beside others in one picture.
    #[error(
        "the scene has glass shapes beside stones, but the graphics card takes only one of these kinds at a time"
    )]
    MixedKinds,
    /// A software driver would follow too few bounces.
    #[error(
        "{name} follows only {bounces} bounce{} of light in a scene of so many facets (stones: {stones})",
        if *.bounces == 1 { "" } else { "s" }
    )]
    TooFewBounces {
        /// The card's name.
        name: String,
        /// The number of bounces that it would follow.
        bounces: u32,
        /// The number of stones.
        stones: usize,
    },
    /// There is no stone and no metal.
    #[error("the scene has no stone and no metal, but the graphics card needs at least one")]
    NoStones,
    /// A sample pass has no wavelength, or more than the card has room for.
    #[error("a pass has {count} wavelengths, but the graphics card takes 1 to {most}")]
    Wavelengths {
        /// The number of wavelengths.
        count: usize,
        /// The most wavelengths that the card takes.
        most: usize,
    },
    /// The light has more lamps than the card has room for.
    #[error("the light has {count} lamps, but the graphics card takes at most {most}")]
    TooManyLamps {
        /// The number of lamps.
        count: usize,
        /// The most lamps that the card takes.
        most: usize,
    },
    /// The picture behind the stones, or the map of the light, has more pixels each way than the card takes.
    #[error(
        "a picture around the stones has {width} by {height} pixels, but {name} takes at most {most} each way"
    )]
    PictureTooLarge {
        /// The card's name.
        name: String,
        /// The number of pixels across.
        width: u32,
        /// The number of pixels down.
        height: u32,
        /// The most pixels that the card takes each way.
        most: u32,
    },
    /// The scope has more bands than a pixel has room for.
    #[error("the scope has {count} bands, but the graphics card takes at most {most}")]
    TooManyBands {
        /// The number of the scope's bands.
        count: usize,
        /// The most bands that a pixel holds.
        most: usize,
    },
}

/// The interface that is not used. OpenGL draws windows where nothing better exists, but its compute shaders are not
/// relied on.
const UNTRUSTED: wgpu::Backends = wgpu::Backends::GL;

/// An open graphics card and its shaders, each compiled when first used.
pub struct Gpu {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    pub(super) scopes: Pipelines,
    pub(super) lights: Pipelines,
    pub(super) panes: OnceLock<wgpu::ComputePipeline>,
    name: String,
    is_software: bool,
    lanes: u32,
    dispatches: Mutex<DispatchTotals>,
    fault: Arc<Mutex<Option<Fault>>>,
}

/// The work that a card has done since these totals were last taken.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DispatchTotals {
    /// The number of dispatches.
    pub count: u32,
    /// The sum of the times of all dispatches, each from its submission to its end, in seconds.
    pub seconds: f64,
    /// The time of the longest dispatch, in seconds.
    pub longest_s: f64,
    /// The number of bytes of pixels that were read and written.
    pub pixel_bytes: u64,
}

/// A reason why a graphics card could not finish its work.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Fault {
    /// The card's memory ran out; the text is the driver's message.
    OutOfMemory(String),
    /// The card was lost, or its driver refused the work; the text is the driver's message.
    Failed(String),
}

impl From<wgpu::Error> for Fault {
    fn from(error: wgpu::Error) -> Self {
        let why = in_one_line(&error.to_string());
        match error {
            wgpu::Error::OutOfMemory { .. } => Self::OutOfMemory(why),
            wgpu::Error::Validation { .. } | wgpu::Error::Internal { .. } => Self::Failed(why),
        }
    }
}

impl GpuError {
    /// Returns whether the card is lost for all further work, and not only too small for one piece of work.
    pub fn is_lost(&self) -> bool {
        matches!(self, Self::NoAdapter(_) | Self::TooLimited { .. } | Self::Failed { .. })
    }
}

impl Gpu {
    /// Opens the strongest card, or a driver that computes in software where there is no card.
    ///
    /// # Errors
    /// Fails where neither is found, or where its limits are too low.
    pub fn open() -> Result<Self, GpuError> {
        pollster::block_on(Self::opened())
    }

    async fn opened() -> Result<Self, GpuError> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
        descriptor.backends.remove(UNTRUSTED);
        let instance = wgpu::Instance::new(descriptor);
        let strongest = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter =
            instance.request_adapter(&strongest).await.map_err(|e| GpuError::NoAdapter(e.to_string()))?;
        let info = adapter.get_info();
        let limited = |why: String| GpuError::TooLimited { name: info.name.clone(), why };
        let wanted = Self::wanted(&adapter);
        let (device, queue) = adapter.request_device(&wanted).await.map_err(|e| limited(e.to_string()))?;
        Self::of(device, queue, &info)
    }

    /// Returns the description with which a device on this adapter must be requested, so that [`of`](Self::of) can
    /// use it.
    pub fn wanted(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
        wgpu::DeviceDescriptor {
            label: Some("brillianteer"),
            // Backplates may be as large as the card allows.
            required_limits: wgpu::Limits::downlevel_defaults().using_resolution(adapter.limits()),
            ..Default::default()
        }
    }

    /// Shares a device that is already open and was requested with the description of [`wanted`](Self::wanted).
    ///
    /// # Errors
    /// Fails where the interface that drives the device does not compute, or where the device has already failed.
    pub fn of(device: wgpu::Device, queue: wgpu::Queue, info: &wgpu::AdapterInfo) -> Result<Self, GpuError> {
        if UNTRUSTED.contains(wgpu::Backends::from(info.backend)) {
            let why = format!("{} does not compute", info.backend);
            return Err(GpuError::TooLimited { name: info.name.clone(), why });
        }
        let fault = Arc::new(Mutex::new(None));
        let (lost, other) = (Arc::clone(&fault), Arc::clone(&fault));
        device.set_device_lost_callback(move |_, why| note(&lost, Fault::Failed(in_one_line(&why))));
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| note(&other, error.into())));
        let name = format!("{} ({})", info.name, info.backend);
        let lanes = info.subgroup_max_size.max(1);
        let is_software = info.device_type == wgpu::DeviceType::Cpu;
        let [scopes, lights] = [ShaderTask::Scope, ShaderTask::Light].map(Pipelines::new);
        let gpu = Self {
            device,
            queue,
            scopes,
            lights,
            panes: OnceLock::new(),
            name,
            is_software,
            lanes,
            dispatches: Mutex::default(),
            fault,
        };
        gpu.check().map(|()| gpu)
    }

    /// Returns the card's name and the interface that drives it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns whether this is a driver that computes on the processor and not a card. Point rays in f64 are quicker
    /// than such a driver.
    pub fn is_software(&self) -> bool {
        self.is_software
    }

    /// Creates a buffer with these contents, whose length is a multiple of four bytes.
    pub(super) fn buffer(&self, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        // `create_buffer_init` of wgpu would panic where the card has no memory left.
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: contents.len() as u64,
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        self.queue.write_buffer(&buffer, 0, contents);
        buffer
    }

    /// Returns the greatest number of invocations that run in step.
    pub fn lanes(&self) -> u32 {
        self.lanes
    }

    /// Returns the totals of the card's work since the last call, and resets them.
    pub fn take_totals(&self) -> DispatchTotals {
        std::mem::take(&mut *self.dispatches.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Adds a dispatch to the totals.
    pub(super) fn count(&self, took: Duration, pixel_bytes: u64) {
        let mut totals = self.dispatches.lock().unwrap_or_else(PoisonError::into_inner);
        totals.count = totals.count.saturating_add(1);
        totals.seconds += took.as_secs_f64();
        totals.longest_s = totals.longest_s.max(took.as_secs_f64());
        totals.pixel_bytes = totals.pixel_bytes.saturating_add(pixel_bytes);
    }

    /// Waits until all submitted work is done.
    pub(super) fn wait(&self) -> Result<(), GpuError> {
        self.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| self.failed(e.to_string()))?;
        self.check()
    }

    /// Returns an error where something has gone wrong with the card. A lack of memory is reported once, because the
    /// next piece of work may fit; any other fault stays.
    pub(super) fn check(&self) -> Result<(), GpuError> {
        let mut fault = self.fault.lock().unwrap_or_else(PoisonError::into_inner);
        match fault.clone() {
            None => Ok(()),
            Some(Fault::Failed(why)) => Err(self.failed(why)),
            Some(Fault::OutOfMemory(why)) => {
                *fault = None;
                Err(GpuError::OutOfMemory { name: self.name.clone(), why })
            }
        }
    }

    pub(super) fn failed(&self, why: String) -> GpuError {
        GpuError::Failed { name: self.name.clone(), why }
    }
}

/// Records the first fault only, because later ones follow from it.
fn note(noted: &Mutex<Option<Fault>>, fault: Fault) {
    noted.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(fault);
}

/// Returns a driver's message, which may have several lines, in one line.
fn in_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a card that runs out of memory at its next piece of work, or whose driver fails there.
    fn faulty(error: impl Fn(wgpu::ErrorSource) -> wgpu::Error) -> Option<Gpu> {
        let gpu = match Gpu::open() {
            Ok(gpu) => gpu,
            Err(error) if std::env::var_os("BRILLIANTEER_REQUIRE_GPU").is_some() => panic!("{error}"),
            Err(_) => return None,
        };
        note(&gpu.fault, error("no room".into()).into());
        Some(gpu)
    }

    #[test]
    fn a_lack_of_memory_loses_the_card_for_one_piece_of_work_and_other_faults_for_good() {
        let Some(gpu) = faulty(|source| wgpu::Error::OutOfMemory { source }) else { return };
        let error = gpu.check().unwrap_err();
        assert!(matches!(error, GpuError::OutOfMemory { .. }) && !error.is_lost(), "{error}");
        assert_eq!(gpu.check(), Ok(()));
        let internal = |source| wgpu::Error::Internal { source, description: "a reset".into() };
        let Some(gpu) = faulty(internal) else { return };
        assert!(gpu.check().unwrap_err().is_lost() && gpu.check().unwrap_err().is_lost());
    }
}
