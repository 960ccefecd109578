//! The file of a plot.

use brillianteer_base::Failure;
use brillianteer_files::{WriteError, write};
use brillianteer_paper::plot::PlotError;
use brillianteer_paper::{pdf, rasterize, write_png};
use std::path::{Path, PathBuf};

/// The width of a plot as PNG, in pixels.
const WIDTH: u32 = 1500;

/// The format of a plot's file.
#[derive(Debug, Clone, Copy)]
enum PlotFormat {
    Svg,
    Png,
    Pdf,
}

/// The file that `--plot` names.
pub struct PlotFile {
    path: PathBuf,
    format: PlotFormat,
}

impl PlotFile {
    /// Takes the name of a file.
    ///
    /// # Errors
    /// Fails with [`Failure::Usage`] for another ending than svg, png or pdf.
    pub fn new(path: &Path) -> Result<Self, Failure> {
        let format = match path.extension().and_then(|ending| ending.to_str()) {
            Some("svg") => PlotFormat::Svg,
            Some("png") => PlotFormat::Png,
            Some("pdf") => PlotFormat::Pdf,
            _ => {
                let what = "give a name that ends in .svg, .png or .pdf";
                return Err(Failure::Usage(format!("--plot {}: {what}", path.display())));
            }
        };
        Ok(Self { path: path.to_owned(), format })
    }

    /// Makes the failure of a plot that cannot be drawn.
    pub fn failed(&self, error: &PlotError) -> Failure {
        Failure::Output(format!("{}: {error}", self.path.display()))
    }

    /// Returns the path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes a plot that was drawn as SVG.
    pub fn write(&self, svg: &str, title: &str) -> Result<(), Failure> {
        match self.format {
            PlotFormat::Svg => self.write_bytes(svg.as_bytes())?,
            PlotFormat::Pdf => {
                let pages = [svg.to_owned()];
                let bytes = pdf(&pages, title).map_err(|error| Failure::Output(error.to_string()))?;
                self.write_bytes(&bytes)?;
            }
            PlotFormat::Png => {
                let picture = rasterize(svg, WIDTH).map_err(|error| Failure::Output(error.to_string()))?;
                let (width, height, pixels) = picture;
                write_png(&self.path, (width, height), title, |rows| rows.push(&pixels))?;
            }
        }
        Ok(())
    }

    fn write_bytes(&self, bytes: &[u8]) -> Result<(), WriteError> {
        write(&self.path, |file| file.write_all(bytes).map_err(|error| WriteError::io(&self.path, error)))
    }
}
