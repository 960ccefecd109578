//! The parts of a graphics card's time, as far as the times and counts of its dispatches show them.

use super::report::CardLine;
use brillianteer_base::Failure;
use brillianteer_render::RenderError;
use brillianteer_trace::gpu::{CardPeak, DispatchTotals, Gpu};
use std::sync::OnceLock;

/// The operations of f32 in one plane test of `nearer` in `leaving.wgsl`: two dot products, a difference, two products and two
/// comparisons.
const FLOPS_PER_TEST: f64 = 15.0;

/// The measured work of one picture.
#[derive(Debug, Clone, Copy)]
struct CardWork {
    /// The time of the whole job, seconds.
    job_s: f64,
    /// The time of its dispatches, seconds.
    dispatches_s: f64,
    /// The time of the longest dispatch, seconds.
    longest_s: f64,
    /// The number of dispatches.
    dispatches: f64,
    /// The bytes of pixels that were read and written.
    pixel_bytes: f64,
    /// The number of planes tested.
    plane_tests: f64,
    /// The mean part of a subgroup's lanes that still follow a ray, above 0.
    busy_lanes: f64,
}

/// Measures the peaks of the card once, and returns them.
pub fn peak(gpu: &Gpu) -> Result<CardPeak, Failure> {
    static PEAK: OnceLock<CardPeak> = OnceLock::new();
    if let Some(peak) = PEAK.get() {
        return Ok(*peak);
    }
    let peak = gpu.peak().map_err(RenderError::from)?;
    Ok(*PEAK.get_or_init(|| peak))
}

/// Describes the time of a picture that the card made `runs` times, in `job_s` seconds each; `totals` are those of
/// all runs.
pub fn line(
    peak: &CardPeak,
    totals: &DispatchTotals,
    (runs, job_s): (usize, f64),
    (plane_tests, busy_lanes): (f64, f64),
) -> CardLine {
    let each = 1.0 / runs as f64;
    let work = CardWork {
        job_s,
        dispatches_s: totals.seconds * each,
        longest_s: totals.longest_s,
        dispatches: f64::from(totals.count) * each,
        pixel_bytes: totals.pixel_bytes as f64 * each,
        plane_tests,
        busy_lanes,
    };
    let found = CardUse::new(&work, peak);
    found.described()
}

/// Describes the peaks of the card in words.
pub fn peak_line(gpu: &Gpu, peak: &CardPeak) -> String {
    let what = if gpu.is_software() { "driver in software, no card" } else { "card" };
    format!(
        "\n{what}: {}; measured: {:.3} TFLOP/s of fused multiply-adds in f32, {:.1} GB/s read, {:.0} µs for an empty \
         dispatch\nparts of its time below are lower bounds: they leave out what is computed beside plane tests, reads of \
         planes and of the map of the light, and waiting",
        gpu.name(),
        peak.flops / 1e12,
        peak.bytes_per_second / 1e9,
        peak.launch_s * 1e6
    )
}

/// The parts of a job's time, 0 to 1. All but the last two are the times that the work would take at the measured
/// peaks, so they are lower bounds.
#[derive(Debug, Clone, PartialEq)]
struct CardUse {
    parts: [(&'static str, f64); 6],
    longest_s: f64,
}

impl CardUse {
    fn new(work: &CardWork, peak: &CardPeak) -> Self {
        let part = |seconds: f64| (seconds / work.job_s).clamp(0.0, 1.0);
        let arithmetic = work.plane_tests * FLOPS_PER_TEST / peak.flops;
        let known = [
            ("arithmetic of plane tests", part(arithmetic)),
            ("lanes idle by divergence", part(arithmetic / work.busy_lanes - arithmetic)),
            ("memory of pixels", part(work.pixel_bytes / peak.bytes_per_second)),
            ("launches", part(work.dispatches * peak.launch_s)),
            ("work outside dispatches", part(work.job_s - work.dispatches_s)),
        ];
        let rest = (1.0 - known.iter().map(|(_, part)| part).sum::<f64>()).max(0.0);
        let [a, b, c, d, e] = known;
        Self { parts: [a, b, c, d, e, ("other arithmetic and waiting", rest)], longest_s: work.longest_s }
    }

    /// Returns the fraction of the measured peak of arithmetic that plane tests alone reach.
    fn of_peak(&self) -> f64 {
        self.parts[0].1
    }

    /// Returns the name of the largest part of the card's time.
    fn bound(&self) -> &'static str {
        self.parts.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map_or("", |largest| largest.0)
    }

    fn line(&self) -> String {
        let parts: Vec<String> =
            self.parts.iter().map(|(name, part)| format!("{name} {:.0} %", part * 100.0)).collect();
        format!(
            "\n{:>13} at least {:.1} % of the peak; bound by {}; longest dispatch {:.1} ms\n{:>13} {}",
            "",
            self.of_peak() * 100.0,
            self.bound(),
            self.longest_s * 1e3,
            "",
            parts.join(", ")
        )
    }

    fn described(&self) -> CardLine {
        CardLine {
            text: self.line(),
            of_peak: self.of_peak(),
            bound: self.bound(),
            longest_dispatch_ms: self.longest_s * 1e3,
            parts: self.parts.into_iter().collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PEAK: CardPeak = CardPeak { flops: 15e12, bytes_per_second: 1e12, launch_s: 1e-5 };

    const WORK: CardWork = CardWork {
        job_s: 0.01,
        dispatches_s: 0.01,
        longest_s: 0.005,
        dispatches: 2.0,
        pixel_bytes: 1e8,
        plane_tests: 1e9,
        busy_lanes: 0.5,
    };

    #[test]
    fn the_parts_of_time_add_up_and_the_largest_is_the_bound() {
        let found = CardUse::new(&WORK, &PEAK);
        assert!((found.parts.iter().map(|(_, part)| part).sum::<f64>() - 1.0).abs() < 1e-12);
        assert!((found.of_peak() - 0.1).abs() < 1e-12 && (found.parts[1].1 - 0.1).abs() < 1e-12, "{found:?}");
        assert_eq!(found.bound(), "other arithmetic and waiting");
        let bounds = [
            (CardWork { plane_tests: 8e9, busy_lanes: 1.0, ..WORK }, "arithmetic of plane tests"),
            (CardWork { plane_tests: 2e9, busy_lanes: 0.25, ..WORK }, "lanes idle by divergence"),
            (CardWork { pixel_bytes: 8e9, ..WORK }, "memory of pixels"),
            (CardWork { dispatches: 900.0, ..WORK }, "launches"),
            (CardWork { dispatches_s: 0.002, ..WORK }, "work outside dispatches"),
        ];
        for (work, bound) in bounds {
            assert_eq!(CardUse::new(&work, &PEAK).bound(), bound, "{work:?}");
        }
    }
}
