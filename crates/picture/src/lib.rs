//! Pictures. A picture combines a view, a scope and a reading of the light; `trace` does the tracing itself.

// A test may list as many cases as it has.
#![cfg_attr(test, allow(clippy::too_many_lines))]

mod bloom;
mod by_beams;
#[cfg(feature = "gpu")]
pub mod by_gpu;
pub mod by_rays;
mod caption;
mod contrast;
mod develop;
mod diagram;
mod drawing;
mod enlarged;
mod filling;
mod fxaa;
mod icon;
mod layer;
mod light_picture;
mod linear;
pub mod liquid_glass;
mod motion;
mod name_error;
mod overlay;
mod paint;
mod palette;
mod patterns;
pub mod profile;
mod raster;
mod refraction;
mod report;
mod sheet;
pub mod spectral;
mod strips;
mod temporal;
mod tone;
pub mod vector;
mod views;

pub use bloom::Bloom;
pub use brillianteer_optics::LUMINANCE;
pub use by_beams::ByBeams;
pub use caption::Caption;
pub use contrast::{contrast_legend, encode_contrast};
pub use develop::{Develop, develop, develop_rows};
pub use diagram::{DiagramStyle, DrawnMarks, diagram, marked_diagram};
pub use drawing::Inks;
pub use enlarged::enlarged;
pub use filling::filling;
pub use fxaa::fxaa;
pub use icon::icon;
pub use layer::Layer;
pub use light_picture::light_picture;
pub use linear::{LightRows, Linear, luminance};
pub use motion::motion_of_view;
pub use name_error::NameError;
pub use overlay::{Code, Overlay, OverlayDrawing, lay};
pub use paint::paint;
pub use palette::Palette;
pub use patterns::{PATTERN_SIDE, pattern_drawing};
pub use profile::profile;
pub use raster::Rows;
pub use refraction::{Backdrop, Carried, MapBand, RefractionMap, SourcePlace, Survey, refract};
pub use report::{
    EmbeddedDrawing, FigureRow, Report, ReportCell, ReportColumn, ReportFigure, ReportPart, ReportTable,
    TextFlow, report_pages,
};
pub use sheet::{BlockKind, CuttingSheet, PaperSize, SheetBlock, SheetRow, sheet_pages};
pub use temporal::{MotionVector, TemporalHistory};
pub use tone::{reachable, toned};
pub use views::{Picture, PictureName, Scoped};
