//! The contrast map of a stone as files.

use super::event::{Event, WorkShares};
use super::pictures::Pictures;
use super::sheet::{PROGRAM, UNRESOLVED, caption_pixels};
use super::viewing::{Viewing, note};
use super::{OutputFormat, write_text};
use crate::{PngFile, write_exr};
use brillianteer_base::{Failure, Watch};
use brillianteer_measure::{PatternSettings, head_of_measures};
use brillianteer_picture::{Caption, contrast_legend, vector};
use brillianteer_render::{ContrastProduct, Job, Product, Renderer, TakenContrast, Unfit};
use brillianteer_scene::Film;
use std::path::Path;

impl Viewing<'_> {
    /// Returns the job of the contrast map of this stone.
    fn contrast_job(&self) -> Job {
        let product = ContrastProduct {
            head_deg: head_of_measures(self.head_deg),
            pattern: PatternSettings::usual(self.specimen.unit_mm()),
            medium: self.medium,
        };
        self.job(Film::NONE, Product::Contrast(product), UNRESOLVED)
    }

    /// Returns the reason why the stone has no contrast map in this view; `None` where it has one.
    pub fn why_no_contrast(&self, renderer: &Renderer) -> Option<Unfit> {
        renderer.plan(&self.contrast_job()).err()
    }
}

/// A contrast map that is written.
struct ContrastSheet<'a> {
    name: &'a str,
    viewing: Viewing<'a>,
    taken: &'a TakenContrast,
}

impl ContrastSheet<'_> {
    /// Returns the contrast of the whole face, in words.
    fn whole(&self) -> String {
        let whole = self.taken.map.whole;
        if whole.most.is_finite() {
            format!("contrast of the face {:.3} ± {:.3}", whole.middle(), whole.error())
        } else {
            "contrast of the face unknown: all of it may be dark".to_owned()
        }
    }

    /// Returns the eye, the head and the stone's size, in words.
    fn eye(&self) -> String {
        let (unit_mm, head) = (self.viewing.specimen.unit_mm(), head_of_measures(self.viewing.head_deg));
        let (side, diameter) = (self.taken.map.side * unit_mm, 2.0 * unit_mm);
        format!("squares of {side:.3} mm on {diameter:.2} mm, even dome, head {head}°")
    }

    fn description(&self) -> String {
        let unresolved = self.taken.map.unresolved;
        let seen = self.viewing.seen_in_words(self.name);
        format!("{seen}; {}; {}; exact beams, unresolved {unresolved:.2e}", self.eye(), self.whole())
    }

    fn caption(&self) -> Caption {
        let percent = 100.0 * self.taken.map.unresolved;
        let remarks = vec![
            format!(
                "brightness beside that of the whole face: {}; {}",
                self.eye(),
                self.viewing.described().description()
            ),
            self.whole(),
            format!(
                "{}; exact beams, {percent:.2} % of the light unresolved; {PROGRAM}",
                self.viewing.light_in_words()
            ),
        ];
        Caption::with_legend(&self.viewing.specimen.design.name, remarks, contrast_legend())
    }
}

impl Pictures<'_> {
    /// Writes the files of the contrast map.
    pub(super) fn contrast(&mut self, name: &str, watch: Watch) -> Result<(), Failure> {
        let (viewing, outputs, tell) = (self.viewing, self.outputs, self.tell);
        if let Some(why) = viewing.why_no_contrast(self.renderer) {
            return tell(Event::Note(&format!("{name}: left out: {why}")));
        }
        let wanted = [OutputFormat::Png, OutputFormat::Exr, OutputFormat::Svg];
        let wanted = wanted.into_iter().filter(|format| outputs.wants(*format));
        let mut pace = WorkShares::new(watch, 3.0 + wanted.clone().count() as f64);
        let job = viewing.contrast_job();
        let taken = pace.step(3.0, |watch| {
            Ok(self.renderer.run(&job, watch, &mut |part| note(&part, tell))?.contrast()?)
        })?;
        self.warn_of_open(&viewing, &job, &taken.beams)?;
        let sheet = ContrastSheet { name, viewing, taken: &taken };
        for format in wanted {
            let path = outputs.path(&viewing.suffix(None), name, format);
            pace.step(1.0, |watch| self.write_contrast(&sheet, format, &path, watch))?;
        }
        Ok(())
    }

    fn write_contrast(
        &self,
        sheet: &ContrastSheet,
        format: OutputFormat,
        path: &Path,
        watch: Watch,
    ) -> Result<(), Failure> {
        let ContrastSheet { viewing, taken, .. } = sheet;
        match format {
            OutputFormat::Png => self.contrast_pixels(sheet, path, watch)?,
            OutputFormat::Exr => {
                let film = viewing.film(self.outputs.size);
                write_exr(path, &taken.values(), &film, &sheet.description(), watch)?;
            }
            OutputFormat::Svg => {
                let parts = taken.map.parts().map(|(outline, contrast)| (outline, contrast.known));
                let parts = (parts, taken.map.side);
                let words = (sheet.description(), sheet.whole());
                let drawn = vector::contrast(viewing.stone()?, &taken.beams, parts, (&words.0, &words.1));
                let drawn = if self.outputs.caption {
                    sheet.caption().under(drawn, f64::from(vector::SIDE))
                } else {
                    drawn
                };
                return write_text(path, &drawn.to_string(), self.tell);
            }
            OutputFormat::Json => return Ok(()),
        }
        (self.tell)(Event::Written(path))
    }

    fn contrast_pixels(&self, sheet: &ContrastSheet, path: &Path, watch: Watch) -> Result<(), Failure> {
        let film = sheet.viewing.film(self.outputs.size);
        let [width, height] = film.size;
        let (below, caption) =
            if self.outputs.caption { caption_pixels(&sheet.caption(), width)? } else { (0, vec![]) };
        let mut file = PngFile::begin(path, (width, height + below), &sheet.description())?;
        sheet.taken.paint(&film, watch, |pixels| file.push(pixels).map_err(Failure::from))?;
        file.push(&caption)?;
        Ok(file.finish()?)
    }
}
