//! What is asked of the studio, and what it answers.

use crate::app::liquid::Liquid;
use crate::app::shows::Shows;
use crate::io::background::BackgroundRef;
use crate::io::lighting::Lighting;
use crate::measure::Figures;
use crate::picture::{Inks, Overlay, RefractionMap};
use crate::scene::{Film, Glare, Pose, Specimen, View};
use egui::ColorImage;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Which of two stones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Which {
    /// The one that is worked on.
    Present,
    /// The one that it is compared with.
    Other,
}

/// A place that a picture is for: a pane, and which stone is in it.
pub type Slot = (usize, Which);

/// How the edges of a render are evened out. At rest many looks at each pixel do that, whatever is chosen here.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub enum Smoothing {
    /// Not at all.
    #[default]
    None,
    /// In the finished picture.
    Fxaa,
    /// Over time, while anything moves: what was seen before is brought to where it is now.
    Temporal {
        /// The share of the newest picture, above 0 to 1.
        newest: f64,
    },
}

/// One picture.
#[derive(Debug, Clone)]
pub struct Shot {
    /// The stone, turned as it is seen. Its design may have an older name.
    pub specimen: Arc<Specimen>,
    /// What the design is called, which drawings bear.
    pub title: String,
    /// What is shown of it.
    pub shows: Shows,
    /// Whether a scope shows the strongest exit of each point alone.
    pub strongest: bool,
    /// Whether a scope that shows energy holds glare.
    pub glare: Glare,
    /// From where.
    pub view: View,
    /// The pixels.
    pub film: Film,
    /// The light.
    pub light: Arc<Lighting>,
    /// Stops.
    pub exposure: f64,
    /// Bands of wavelengths of a render, at its finest.
    pub bands: u32,
    /// Whether looks at a render take other wavelengths each.
    pub jitter: bool,
    /// The picture that hangs behind the stone of a render, if any.
    pub behind: Option<BackgroundRef>,
    /// How far behind the middle of a render that hangs, girdle radii.
    pub distance: f64,
    /// The film where nothing is zoomed or moved aside: what hangs behind fills it.
    pub whole: Film,
    /// How much of the way that refraction turns light is followed: 1 is physics.
    pub strength: f64,
    /// Where the copies of the stone are in a render, at least one; all else shows it alone.
    pub company: Vec<Pose>,
    /// How a render's edges are evened out.
    pub smoothing: Smoothing,
    /// Half angle of the observer's head in scopes, degrees; 0 for none.
    pub head: f64,
    /// What is drawn over it.
    pub overlay: Option<Overlay>,
    /// The pane of liquid glass.
    pub liquid: Liquid,
    /// What a drawing is drawn on.
    pub paper: Paper,
}

/// What a drawing is drawn on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paper {
    /// Its colours.
    pub inks: Inks,
    /// Pixels to a point of the screen, by which type is kept legible; none for the whole sheet, as it is exported.
    pub pixels_per_point: Option<f32>,
}

impl Default for Paper {
    /// The sheet, as it is exported.
    fn default() -> Self {
        Self { inks: Inks::PAPER, pixels_per_point: None }
    }
}

impl PartialEq for Shot {
    /// Whether both give the same picture. Stones and lights are the same when they are one and the same: they are only
    /// ever replaced.
    fn eq(&self, other: &Self) -> bool {
        if self.shows.is_pane() {
            let glass = |shot: &Self| (shot.shows, shot.film.size, shot.liquid);
            return glass(self) == glass(other) && self.behind == other.behind;
        }
        let by_light = matches!(self.shows, Shows::Render | Shows::Refraction);
        let seen = self.shows != Shows::Diagram;
        let has_glare = seen && !by_light && !self.strongest;
        Arc::ptr_eq(&self.specimen, &other.specimen)
            && (self.shows, self.strongest, self.overlay, self.film.size)
                == (other.shows, other.strongest, other.overlay, other.film.size)
            && (seen || self.paper == other.paper)
            && (!seen || (self.view, self.film, self.head) == (other.view, other.film, other.head))
            && (!has_glare || self.glare == other.glare)
            && (seen || self.title == other.title)
            && (!by_light || (Arc::ptr_eq(&self.light, &other.light) && self.manner() == other.manner()))
    }
}

impl Shot {
    /// What only renders go by, and of that what maps do.
    fn manner(&self) -> (f64, u32, bool, Option<&BackgroundRef>, [f64; 3], &[Pose], Smoothing) {
        let numbers = [self.distance, self.whole.pixel, self.strength];
        if self.shows == Shows::Refraction {
            let numbers = [numbers[0], numbers[1], 1.0];
            return (self.exposure, 0, false, None, numbers, &self.company, Smoothing::None);
        }
        let Self { exposure, bands, jitter, smoothing, .. } = *self;
        (exposure, bands, jitter, self.behind.as_ref(), numbers, &self.company, smoothing)
    }
}

/// Figures of a view, in the common ASET.
#[derive(Debug, Clone)]
pub struct FiguresOrder {
    /// The stone.
    pub specimen: Arc<Specimen>,
    /// From where.
    pub view: View,
    /// Half angle of the observer's head, degrees; 0 for none.
    pub head: f64,
}

impl PartialEq for FiguresOrder {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.specimen, &other.specimen) && (self.view, self.head) == (other.view, other.head)
    }
}

/// Everything that is to be seen at one moment.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Order {
    /// The pictures.
    pub shots: Vec<(Slot, Shot)>,
    /// The figures.
    pub figures: Vec<(Which, FiguresOrder)>,
    /// Figures against tilt, for a view whose own tilt does not matter.
    pub tilts: Option<FiguresOrder>,
}

/// How far a picture has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Grade {
    /// As good as there was time for.
    Rough,
    /// At full size, light followed some way.
    Fair,
    /// As it is exported.
    Fine,
}

/// A picture that was taken.
#[derive(Debug, Clone)]
pub struct TakenPicture {
    /// The pixels, which a film of fewer may have been used for.
    pub image: ColorImage,
    /// Share of the light not followed to its end; none where that is not known.
    pub unresolved: Option<f64>,
    /// What traced it.
    pub tracer: &'static str,
    /// The map that it shows the codes of, to be looked up.
    pub map: Option<Arc<RefractionMap>>,
}

/// Figures at some tilts, degrees.
pub type Tilts = Vec<(f64, Figures)>;

/// What the studio answers.
#[derive(Debug)]
pub enum Answer {
    /// A picture.
    Picture(Slot, Box<Shot>, Grade, TakenPicture),
    /// Figures.
    Figures(Which, FiguresOrder, Grade, Box<Figures>),
    /// Figures against tilt.
    Tilts(FiguresOrder, Tilts),
    /// What went wrong, in words.
    Trouble(String),
}
