//! The orders that the studio receives, and its answers.

use super::shot_light::ShotLight;
use crate::liquid::Liquid;
use crate::pixels::Pixels;
use crate::shows::Shows;
use brillianteer_base::{Failure, Watch};
use brillianteer_measure::{Figures, head_of_measures};
use brillianteer_picture::DrawnMarks;
use brillianteer_picture::{Inks, Overlay, RefractionMap};
use brillianteer_render::{Sweep, SweepError, SweptStone};
use brillianteer_scene::{BackgroundRef, Companions, Film, Glare, Look, Pose, Specimen, View};
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
    /// What it is made with; renders show its background, and scopes have its head.
    pub look: Look,
    /// True where each pass of a render takes different wavelengths.
    pub jitter: bool,
    /// The film without zoom and displacement, which the backplate fills.
    pub whole: Film,
    /// The poses of the copies of the stone in a render, at least one. Other pictures show a single stone.
    pub copies: Vec<Pose>,
    /// The companions of the copies in a render, in girdle radii.
    pub companions: Companions,
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

/// All that the picture of a shot depends on: equal subjects give the same picture.
#[derive(PartialEq)]
enum Subject<'a> {
    /// The stone under light.
    Lit { stone: Same<'a>, shows: Shows, overlay: Option<Overlay>, sight: (View, Film, f64), lit: Lit<'a> },
    /// The stone in a scope.
    Scope { stone: Same<'a>, shows: Shows, overlay: Option<Overlay>, sight: (View, Film), read: ScopeReading },
    /// A drawing of its facets.
    Drawing { stone: Same<'a>, size: [u32; 2], title: &'a str, paper: Paper, marks: &'a DrawnMarks },
    /// A drawing that the window makes itself.
    Profile { stone: Same<'a>, size: [u32; 2] },
    /// A pane before its background.
    Pane { shows: Shows, size: [u32; 2], liquid: Liquid, background: Option<&'a BackgroundRef> },
}

/// A stone, which is compared by pointer, because stones are replaced and never changed.
struct Same<'a>(&'a Arc<Specimen>);

impl PartialEq for Same<'_> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(self.0, other.0)
    }
}

/// What a picture under light depends on, beside the stone and the view.
#[derive(PartialEq)]
struct Lit<'a> {
    light: &'a ShotLight,
    look: Cow<'a, Look>,
    jitter: bool,
    copies: &'a [Pose],
    companions: &'a Companions,
}

/// What is read of the light in a scope; `None` where the picture does not depend on it.
#[derive(PartialEq)]
struct ScopeReading {
    strongest: bool,
    glare: Option<Glare>,
    head: Option<f64>,
}

impl PartialEq for Shot {
    /// Returns whether both shots give the same picture.
    fn eq(&self, other: &Self) -> bool {
        self.subject() == other.subject()
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

    /// Returns all that the picture of the shot depends on.
    fn subject(&self) -> Subject<'_> {
        let Self { shows, overlay, film, view, .. } = *self;
        let (stone, size) = (Same(&self.specimen), film.size);
        match shows {
            Shows::Render => {
                let look = Cow::Borrowed(&self.look);
                Subject::Lit {
                    stone,
                    shows,
                    overlay,
                    sight: (view, film, self.whole.pixel),
                    lit: self.lit(look, self.jitter),
                }
            }
            Shows::Refraction => {
                let look = Cow::Owned(self.look_of_maps());
                Subject::Lit {
                    stone,
                    shows,
                    overlay,
                    sight: (view, film, self.whole.pixel),
                    lit: self.lit(look, false),
                }
            }
            Shows::Aset
            | Shows::AsetWhite
            | Shows::Aset40
            | Shows::IdealScope
            | Shows::Hearts
            | Shows::Arrows => {
                let takes_head = shows.scoped().is_some_and(|scoped| scoped.takes_head);
                let read = ScopeReading {
                    strongest: self.strongest,
                    glare: (!self.strongest).then_some(self.glare),
                    head: self.look.head.filter(|_| takes_head),
                };
                Subject::Scope { stone, shows, overlay, sight: (view, film), read }
            }
            Shows::Contrast => {
                let head = Some(head_of_measures(self.look.head_of_scopes()));
                let read = ScopeReading { strongest: false, glare: None, head };
                Subject::Scope { stone, shows, overlay, sight: (view, film), read }
            }
            Shows::Diagram => {
                Subject::Drawing { stone, size, title: &self.title, paper: self.paper, marks: &self.marks }
            }
            Shows::Profile => Subject::Profile { stone, size },
            Shows::LiquidGlass | Shows::TracedPane => {
                let background = self.look.background.as_ref();
                Subject::Pane { shows, size, liquid: self.liquid, background }
            }
        }
    }

    fn lit<'a>(&'a self, look: Cow<'a, Look>, jitter: bool) -> Lit<'a> {
        Lit { light: &self.light, look, jitter, copies: &self.copies, companions: &self.companions }
    }

    /// Returns the look of a refraction map, with the usual values for all that maps ignore.
    fn look_of_maps(&self) -> Look {
        let Look { exposure, tone, light_turn, light_upright, head, background_mm, strength, .. } = self.look;
        Look { exposure, tone, light_turn, light_upright, head, background_mm, strength, ..Look::default() }
    }

    /// Returns the distance of the backplate behind the middle of a render, in girdle radii.
    pub fn distance(&self) -> f64 {
        self.look.distance(self.specimen.unit_mm())
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
