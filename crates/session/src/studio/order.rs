//! The orders that the studio receives, and its answers.

use super::shot_light::ShotLight;
use crate::liquid::Liquid;
use crate::pixels::Pixels;
use crate::shows::Shows;
use brillianteer_base::{Failure, Watch};
use brillianteer_measure::Figures;
use brillianteer_picture::DrawnMarks;
pub use brillianteer_picture::Smoothing;
use brillianteer_picture::{Inks, Overlay, RefractionMap};
use brillianteer_render::{Sweep, SweepError, SweptStone};
use brillianteer_scene::{BackgroundRef, Companions, Film, Glare, Pose, Specimen, View};
use std::borrow::Cow;
use std::sync::Arc;

/// A stone of the comparison: the present one or the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Which {
    /// The stone that is edited.
    Present,
    /// The stone that it is compared with.
    Other,
}

/// The place that a picture is for: the index of a view, and the stone of the comparison.
pub type Slot = (usize, Which);

/// An order of one picture.
#[derive(Debug, Clone)]
pub struct Shot {
    /// The number of the document that was open when the picture was ordered; it changes no pixel.
    pub document: u64,
    /// The stone. The design in it may have an older name.
    pub specimen: Arc<Specimen>,
    /// The name of the design, which drawings show.
    pub title: String,
    /// The picture or drawing that is ordered.
    pub shows: Shows,
    /// True where a scope shows only the strongest exit of each point.
    pub strongest: bool,
    /// Included where a scope that shows energy contains glare.
    pub glare: Glare,
    /// The view.
    pub view: View,
    /// The film.
    pub film: Film,
    /// The light.
    pub light: ShotLight,
    /// The exposure of a render, in stops.
    pub exposure: f64,
    /// The number of bands of wavelengths of a render, at its finest.
    pub bands: u32,
    /// True where each pass of a render takes different wavelengths.
    pub jitter: bool,
    /// The background behind the stone, if any.
    pub behind: Option<BackgroundRef>,
    /// The distance of the backplate behind the middle of a render, in girdle radii.
    pub distance: f64,
    /// The film without zoom and displacement, which the backplate fills.
    pub whole: Film,
    /// The strength of refraction, 0 to 1: the part of the turn by refraction that light follows; 1 is physics.
    pub strength: f64,
    /// The part of the light of sparkles that spreads around them in a render, 0 to 1.
    pub glow: f64,
    /// The greatest number of bounces of light in a render.
    pub bounces: u32,
    /// The angle by which the light is turned about its axis, degrees.
    pub light_turn: f64,
    /// True where the light's axis points up in the picture, false where it points to the eye.
    pub light_upright: bool,
    /// The poses of the copies of the stone in a render, at least one. Other pictures show a single stone.
    pub copies: Vec<Pose>,
    /// The companions of the copies in a render, in girdle radii.
    pub companions: Companions,
    /// The method that smooths a render's edges.
    pub smoothing: Smoothing,
    /// The half angle of the observer's head in scopes, in degrees; 0 for no head.
    pub head: f64,
    /// The overlay that is drawn over the picture.
    pub overlay: Option<Overlay>,
    /// The pane of liquid glass.
    pub liquid: Liquid,
    /// The colours and the scale of a drawing.
    pub paper: Paper,
    /// The facets and corners of the stone that a drawing marks.
    pub marks: DrawnMarks,
}

/// The colours and the scale of a drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paper {
    /// The colours.
    pub inks: Inks,
    /// The pixels per point of the screen, by which type is kept legible; `None` for the whole sheet, as it is exported.
    pub pixels_per_point: Option<f32>,
}

impl Default for Paper {
    /// Returns the colours and scale of the whole sheet, as it is exported.
    fn default() -> Self {
        Self { inks: Inks::PAPER, pixels_per_point: None }
    }
}

impl PartialEq for Shot {
    /// Returns whether both shots give the same picture. Stones are compared by pointer, because they are replaced and never
    /// changed.
    fn eq(&self, other: &Self) -> bool {
        if self.shows.is_pane() {
            let glass = |shot: &Self| (shot.shows, shot.film.size, shot.liquid);
            return glass(self) == glass(other) && self.behind == other.behind;
        }
        let by_light = self.is_under_light();
        let seen = self.shows != Shows::Diagram;
        let scoped = self.shows.scoped();
        let takes_head = scoped.as_ref().is_some_and(|scoped| scoped.takes_head);
        let has_glare = scoped.is_some() && !self.strongest;
        Arc::ptr_eq(&self.specimen, &other.specimen)
            && (self.shows, self.overlay, self.film.size) == (other.shows, other.overlay, other.film.size)
            && (seen || (self.paper == other.paper && self.marks == other.marks))
            && (!seen || (self.view, self.film) == (other.view, other.film))
            && (scoped.is_none() || self.strongest == other.strongest)
            && (!takes_head || self.head == other.head)
            && (!has_glare || self.glare == other.glare)
            && (seen || self.title == other.title)
            && (!by_light || (self.light == other.light && self.manner() == other.manner()))
            && (!by_light || (&self.copies, &self.companions) == (&other.copies, &other.companions))
    }
}

impl Shot {
    /// Returns whether the picture depends on the light.
    fn is_under_light(&self) -> bool {
        matches!(self.shows, Shows::Render | Shows::Refraction)
    }

    /// Returns whether only a rough picture can be taken, because the map of the light is still being drawn.
    pub fn waits_for_light(&self) -> bool {
        self.is_under_light() && self.light.is_coarse()
    }

    /// Returns the same shot under its whole light, whose map is drawn where only a coarse one is at hand.
    ///
    /// # Errors
    /// Fails where `watch` asks to stop.
    pub fn under_whole_light(&self, watch: Watch) -> Result<Cow<'_, Self>, Failure> {
        if !self.waits_for_light() {
            return Ok(Cow::Borrowed(self));
        }
        Ok(Cow::Owned(Self { light: self.light.finished(watch)?, ..self.clone() }))
    }

    /// Returns the settings that only renders and refraction maps depend on, with fixed values for those that maps
    /// ignore.
    fn manner(&self) -> (f64, u32, bool, Option<&BackgroundRef>, [f64; 7], Smoothing) {
        let bounces = f64::from(self.bounces);
        let upright = f64::from(u8::from(self.light_upright));
        let numbers =
            [self.distance, self.whole.pixel, self.light_turn, upright, self.strength, bounces, self.glow];
        if self.shows == Shows::Refraction {
            let numbers = [numbers[0], numbers[1], numbers[2], upright, self.strength, 0.0, 0.0];
            return (self.exposure, 0, false, None, numbers, Smoothing::None);
        }
        let Self { exposure, bands, jitter, smoothing, .. } = *self;
        (exposure, bands, jitter, self.behind.as_ref(), numbers, smoothing)
    }
}

/// An order of the figures of a view, in the common ASET.
#[derive(Debug, Clone)]
pub struct FiguresOrder {
    /// The number of the document that was open when the figures were ordered; it changes no figure.
    pub document: u64,
    /// The stone.
    pub specimen: Arc<Specimen>,
    /// The view.
    pub view: View,
    /// The half angle of the observer's head, in degrees; 0 for no head.
    pub head: f64,
}

impl PartialEq for FiguresOrder {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.specimen, &other.specimen) && (self.view, self.head) == (other.view, other.head)
    }
}

/// An order of measures over a grid, coarse points first.
#[derive(Debug, Clone)]
pub struct SweepOrder {
    /// The number of the sweep: no other sweep of the session has it, so that equal numbers mean the same sweep.
    pub number: u64,
    /// The design and its grid.
    pub sweep: Arc<Sweep>,
    /// The points in the order in which they are measured.
    pub points: Arc<[usize]>,
    /// The number of first points that make the coarse picture, which is measured before fine pictures.
    pub coarse: usize,
}

impl PartialEq for SweepOrder {
    fn eq(&self, other: &Self) -> bool {
        self.number == other.number
    }
}

/// A point of a sweep by its number, with its result.
pub type SweptPoint = (usize, Arc<Result<SweptStone, SweepError>>);

/// Everything that the editor shows at one moment.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Order {
    /// The pictures in sight, each with its place.
    pub shots: Vec<(Slot, Shot)>,
    /// The figures that are wanted.
    pub figures: Vec<(Which, FiguresOrder)>,
    /// Figures against tilt, for a view whose own tilt does not matter.
    pub tilts: Option<FiguresOrder>,
    /// Measures over grids.
    pub sweeps: Vec<SweepOrder>,
}

/// The quality that a picture has reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Grade {
    /// The best quality that there is time for while the user moves something.
    Rough,
    /// Full size, with the light followed part of the way.
    Fair,
    /// Full size, with the light followed as far as in an export.
    Fine,
}

/// A traced picture.
#[derive(Debug, Clone)]
pub struct TakenPicture {
    /// The pixels; a rough picture may have fewer than the shot's film.
    pub image: Pixels,
    /// The share of the light that was not followed to its end; `None` where that is not known.
    pub unresolved: Option<f64>,
    /// The name of the tracer.
    pub tracer: &'static str,
    /// The factor, from 1, by which the pixels in which the light was traced are larger than the picture's own.
    pub coarser: f64,
    /// The refraction map whose codes the picture shows; backgrounds are looked up in it.
    pub map: Option<Arc<RefractionMap>>,
}

/// Figures at several tilts, in degrees.
pub type Tilts = Vec<(f64, Figures)>;

/// An answer of the studio.
#[derive(Debug)]
pub enum Answer {
    /// A picture of a view.
    Picture(Slot, Box<Shot>, Grade, TakenPicture),
    /// Figures of the light.
    Figures(Which, FiguresOrder, Grade, Box<Figures>),
    /// Figures against tilt.
    Tilts(FiguresOrder, Tilts),
    /// Points of the sweep of this number; others follow.
    Swept(u64, Vec<SweptPoint>),
    /// A message about an error.
    Trouble(String),
}
