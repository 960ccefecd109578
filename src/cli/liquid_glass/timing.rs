//! The times of the parts of a pane's drawing, and the differences between the qualities.

use brillianteer_paper::table::{Column, Table};
use brillianteer_picture::Linear;
#[cfg(feature = "gpu")]
use brillianteer_picture::liquid_glass::PanesOnCard;
use brillianteer_picture::liquid_glass::{GlassPane, PaneQuality, PreparedPane, pane};
use brillianteer_scene::Panorama;
#[cfg(feature = "gpu")]
use brillianteer_trace::gpu::{Gpu, GpuError};
use std::time::Instant;

/// The number of timed runs of each part, after one to warm up. The quickest is the result, since other programs can
/// only delay a run.
const TIMES: usize = 15;

/// The qualities and their names.
const QUALITIES: [(PaneQuality, &str); 3] =
    [(PaneQuality::High, "high"), (PaneQuality::Medium, "medium"), (PaneQuality::Low, "low")];

/// Returns the table of times, in milliseconds: of each part of a frame, and of the shape that is computed once.
pub fn table(asked: &GlassPane, background: &Panorama) -> String {
    let quality = |(_, name): (PaneQuality, &'static str)| Column::right(name, 9).digits(2);
    let columns = std::iter::once(Column::left("time in ms", 27)).chain(QUALITIES.map(quality));
    let mut table = Table::headed(columns.collect::<Vec<_>>());
    let of = |quality| GlassPane { quality, ..*asked };
    let columns = QUALITIES.map(|(quality, _)| times(&of(quality), background));
    for (row, (what, _)) in columns[0].iter().enumerate() {
        let numbers = columns.iter().map(|column| column[row].1.into());
        table.row(std::iter::once((*what).into()).chain(numbers));
    }
    let best = pane(&of(PaneQuality::High), background, 1);
    for (quality, name) in &QUALITIES[1..] {
        let (mean, greatest, share) = apart(&best, &pane(&of(*quality), background, 1));
        let differences = format!(
            "mean {mean:.3}, greatest {greatest:.1} of 255 in linear light; {:.1} % of the pixels differ by half a step \
             and more",
            100.0 * share
        );
        table.pair(&format!("high from {name}"), differences);
    }
    #[cfg(feature = "gpu")]
    table.pair("by shader", on_card(asked, background));
    table.to_string()
}

/// Returns the parts of a frame with the time of each. The time of an effect is the time by which it lengthens the
/// look-up.
fn times(asked: &GlassPane, background: &Panorama) -> Vec<(&'static str, f64)> {
    let size = [background.width, background.height];
    let look_up = |pane: &GlassPane| {
        let prepared = PreparedPane::new(pane, size);
        quickest(|| prepared.through(background))
    };
    let strengths = asked.effective();
    let bare = look_up(&GlassPane { dispersion: 0.0, frost: 0.0, ..strengths });
    let dispersed = look_up(&GlassPane { frost: 0.0, ..strengths });
    let prepared = PreparedPane::new(asked, size);
    let all = quickest(|| prepared.through(background));
    let seen = prepared.through(background);
    let unlit = GlassPane { light: 0.0, ..*asked };
    let composed = quickest(|| prepared.lit(&unlit, &seen, Some(background)));
    let lit = quickest(|| prepared.lit(asked, &seen, Some(background)));
    vec![
        ("shape, once", quickest(|| PreparedPane::new(asked, size))),
        ("refraction and depth", bare),
        ("dispersion", (dispersed - bare).max(0.0)),
        ("frost", (all - dispersed).max(0.0)),
        ("light and tint", (lit - composed).max(0.0)),
        ("laying over", composed),
        ("frame, background moves", all + lit),
        ("frame, only light moves", lit),
    ]
}

/// Returns the time of the quickest of some runs, in milliseconds.
fn quickest<T>(mut run: impl FnMut() -> T) -> f64 {
    std::hint::black_box(run());
    let time = |_| {
        let start = Instant::now();
        std::hint::black_box(run());
        1e3 * start.elapsed().as_secs_f64()
    };
    (0..TIMES).map(time).fold(f64::INFINITY, f64::min)
}

/// Returns the mean and the greatest difference of two pictures in steps of 8 bits, and the share of the pixels that differ by
/// half a step or more.
fn apart(a: &Linear, b: &Linear) -> (f64, f64, f64) {
    let off = |(a, b): (&[f32; 4], &[f32; 4])| {
        let off = |k: usize| 255.0 * f64::from((a[k].clamp(0.0, 1.0) - b[k].clamp(0.0, 1.0)).abs());
        off(0).max(off(1)).max(off(2))
    };
    let all: Vec<f64> = a.pixels.iter().zip(&b.pixels).map(off).collect();
    let count = all.len().max(1) as f64;
    let greatest = all.iter().copied().fold(0.0, f64::max);
    (all.iter().sum::<f64>() / count, greatest, all.iter().filter(|off| **off >= 0.5).count() as f64 / count)
}

/// Returns the time of a frame on the graphics card and the difference of its picture from the processor's, or the
/// reason why there is none.
#[cfg(feature = "gpu")]
fn on_card(asked: &GlassPane, background: &Panorama) -> String {
    let measured = || {
        let gpu = Gpu::open()?;
        let card = PanesOnCard::new(&gpu, background)?;
        card.draw(asked, true)?;
        let (_, greatest, _) = apart(&card.read()?, &pane(asked, background, 1));
        let took = quickest(|| card.draw(asked, true));
        Ok::<_, GpuError>(format!(
            "{took:.2} ms a frame on {}; at most {greatest:.2} of 255 apart",
            gpu.name()
        ))
    };
    measured().unwrap_or_else(|error| error.to_string())
}
