//! Compares this painter with egui's own for graphics cards, which Mesa's driver computes on the processor.
#![allow(clippy::print_stdout, reason = "tests print what they measure")]

use crate::editor::Editor;
use crate::setup::Setup;
use brillianteer_painter::Painter;
use brillianteer_session::model::workspace::Workspace;
use brillianteer_session::shows::Shows;
use egui::{Context, FullOutput, TexturesDelta, Theme};
use egui_kittest::wgpu::WgpuTestRenderer;
use egui_kittest::{Harness, TestRenderer};
use image::RgbaImage;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Paints everything twice: by egui's painter and by this one.
struct Twice {
    other: WgpuTestRenderer,
    painter: Painter,
    image: Arc<Mutex<RgbaImage>>,
}

impl TestRenderer for Twice {
    fn handle_delta(&mut self, delta: &mut TexturesDelta) {
        let mut ours = delta.clone();
        // Nothing is painted yet: only the textures are taken over.
        self.painter.take_textures(&mut ours);
        self.other.handle_delta(delta);
    }

    fn render(&mut self, context: &Context, output: &FullOutput) -> Result<RgbaImage, String> {
        let theirs = self.other.render(context, output)?;
        let (width, height) = theirs.dimensions();
        let primitives = context.tessellate(output.shapes.clone(), output.pixels_per_point);
        let size = [width as usize, height as usize];
        let areas =
            self.painter.paint(size, output.pixels_per_point, &primitives, &mut TexturesDelta::default());
        let count: u32 = areas.iter().map(|area| area.size()[0] * area.size()[1]).sum();
        assert!(count <= width * height, "areas overlap");
        let bytes = self.painter.canvas().pixels().iter().flat_map(|p| p.to_le_bytes()).collect();
        *self.image.lock().unwrap() = RgbaImage::from_raw(width, height, bytes).unwrap();
        Ok(theirs)
    }
}

/// Returns the mean difference between the red, green and blue of two images, 0 to 255, and the share of these values that
/// differ by more than 4.
fn apart(a: &RgbaImage, b: &RgbaImage) -> (f64, f64) {
    assert_eq!(a.dimensions(), b.dimensions());
    let colours = |image: &RgbaImage| image.pixels().flat_map(|p| [p[0], p[1], p[2]]).collect::<Vec<u8>>();
    let each: Vec<u8> = colours(a).into_iter().zip(colours(b)).map(|(a, b)| a.abs_diff(b)).collect();
    let part = |sum: f64| sum / each.len() as f64;
    (part(each.iter().copied().map(f64::from).sum()), part(each.iter().filter(|d| **d > 4).count() as f64))
}

/// Paints the window in a theme and at a scale, and returns the image of this painter and that of egui's.
fn painted(theme: Theme, scale: f32) -> (RgbaImage, RgbaImage) {
    let image = Arc::new(Mutex::new(RgbaImage::new(1, 1)));
    let twice =
        Twice { other: WgpuTestRenderer::new(), painter: Painter::default(), image: Arc::clone(&image) };
    let [_, aset, hearts, profile] = Workspace::default().panes;
    let mut diagram = aset;
    diagram.shows = Shows::Diagram;
    let setup = Setup {
        workspace: Workspace { panes: [aset, diagram, hearts, profile], ..Workspace::default() },
        ..Setup::default()
    };
    let mut harness = Harness::builder()
        .with_size(egui::vec2(1280.0, 800.0))
        .with_pixels_per_point(scale)
        .with_theme(theme)
        .renderer(twice)
        .build_eframe(|context| Editor::new(context, setup).unwrap());
    let begun = Instant::now();
    harness.run_steps(3);
    while !harness.state().is_idle() {
        assert!(begun.elapsed() < Duration::from_secs(600), "the editor does not come to rest");
        std::thread::sleep(Duration::from_millis(5));
        harness.step();
    }
    // A menu lies over the rest, with a shadow.
    use egui_kittest::kittest::Queryable;
    harness.get_by_label("View").click();
    harness.run_steps(12);
    let theirs = harness.render().unwrap();
    let ours = image.lock().unwrap().clone();
    (ours, theirs)
}

#[test]
fn the_window_looks_as_a_card_paints_it() {
    for theme in [Theme::Dark, Theme::Light] {
        for scale in [1.0, 1.5] {
            let (ours, theirs) = painted(theme, scale);
            let name = format!("{theme:?}-{scale}");
            let folder =
                std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("target/tmp");
            std::fs::create_dir_all(&folder).unwrap();
            ours.save(folder.join(format!("painted-{name}-processor.png"))).unwrap();
            theirs.save(folder.join(format!("painted-{name}-card.png"))).unwrap();
            let (mean, far) = apart(&ours, &theirs);
            println!(
                "{name}: mean difference {mean:.4} of 255, {:.4} % of colours differ by more than 4",
                100.0 * far
            );
            assert!(mean < 0.05 && far < 1e-4, "{name}: mean {mean}, far {far}");
        }
    }
}
