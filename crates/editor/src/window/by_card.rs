//! Opens a window that a graphics card paints, by eframe and wgpu.

use super::{ID, WindowError, viewport, without_place};
use crate::editor::Editor;
use crate::setup::Setup;
use brillianteer_trace::gpu::Gpu;
use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Returns whether there is a graphics card with a driver; drivers that compute on the processor do not count.
pub fn is_there() -> bool {
    // OpenGL comes last: its driver need not be loaded where Vulkan, Metal or Direct3D find a card.
    [wgpu::Backends::PRIMARY, wgpu::Backends::SECONDARY].into_iter().any(|backends| {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
        descriptor.backends &= backends;
        if descriptor.backends.is_empty() {
            return false;
        }
        let instance = wgpu::Instance::new(descriptor);
        let adapters = pollster::block_on(instance.enumerate_adapters(backends));
        adapters.iter().any(|adapter| adapter.get_info().device_type != wgpu::DeviceType::Cpu)
    })
}

/// Opens the window and waits until it is closed.
pub fn run(setup: Setup) -> Result<(), WindowError> {
    let mut device = WgpuSetupCreateNew::without_display_handle();
    // The tracer shares the device, which therefore needs the tracer's features and limits.
    device.device_descriptor = Arc::new(Gpu::wanted);
    let options = eframe::NativeOptions {
        viewport: viewport(),
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: WgpuConfiguration { wgpu_setup: WgpuSetup::CreateNew(device), ..Default::default() },
        ..Default::default()
    };
    let has_shown = Arc::new(AtomicBool::new(false));
    let shown = Arc::clone(&has_shown);
    let create = move |context: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App>, _> {
        Ok(Box::new(Watched { editor: Editor::new(context, setup)?, has_shown: shown }))
    };
    let ended = eframe::run_native(ID, options, Box::new(create));
    let has_shown = has_shown.load(Ordering::Relaxed);
    ended.map_err(|error| match error {
        eframe::Error::WinitEventLoop(why) if !has_shown => {
            WindowError::NoDisplay(without_place(&why.to_string()))
        }
        error => WindowError::of_ended(&error.to_string(), has_shown),
    })
}

/// The editor, and whether its window has shown its first image.
struct Watched {
    editor: Editor,
    has_shown: Arc<AtomicBool>,
}

impl eframe::App for Watched {
    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        // A second frame begins only after the first was shown.
        if ui.ctx().cumulative_frame_nr() > 0 {
            self.has_shown.store(true, Ordering::Relaxed);
        }
        eframe::App::ui(&mut self.editor, ui, frame);
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        eframe::App::save(&mut self.editor, storage);
    }

    fn on_exit(&mut self) {
        eframe::App::on_exit(&mut self.editor);
    }
}
