//! Hearts and arrows as numbers: the figures of each octant's arrow and heart, and their departure from eightfold
//! symmetry.
//!
//! The regions are unions of exact virtual facets, so that no figure is sampled. The definitions are in docs/optics.md, "Hearts
//! and arrows".

use super::facet_deviations::{Mains, NotEightfold, OCTANTS, median};
use super::interval::Interval;
use super::octant_pattern::{CellKind, OctantFrame, OctantPattern, OctantSide, Region};
use brillianteer_base::{Stopped, Watch};
use brillianteer_cut::Outline;
use brillianteer_math::span;
use brillianteer_scene::{Medium, Side, Stone, View, elevation_deg};
use brillianteer_trace::beam::{BeamOptions, Beams, trace};
use serde::Serialize;
use std::f64::consts::FRAC_PI_4;

/// The layer of arrows that is seen through the table.
const SHAFT: u8 = 0;

/// The layer of arrows that is seen through the facets around the table.
const HEAD: u8 = 1;

/// The one layer of the hearts.
const HEART: u8 = 0;

/// The unit of an [`OctantFigure`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum OctantUnit {
    /// Percent of the stone's diameter.
    #[serde(rename = "percent of the diameter")]
    Diameter,
    /// Percent of the area of the stone seen along its axis.
    #[serde(rename = "percent of the face")]
    Face,
    /// Degrees.
    #[serde(rename = "degrees")]
    Degrees,
}

/// The departure of an octant from the others.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OctantDeparture {
    /// The number of the octant, 1 to 8.
    pub octant: usize,
    /// The departure.
    pub by: f64,
}

/// One figure, with its value in each octant.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OctantFigure {
    /// The figure's name.
    pub name: &'static str,
    /// The unit of all its numbers.
    pub unit: OctantUnit,
    /// The value of each octant; `None` where the octant has nothing of this kind.
    pub octants: [Option<f64>; OCTANTS],
    /// The median of the octants that have a value; `None` where none has.
    pub median: Option<f64>,
    /// The greatest value less the least.
    pub spread: Option<f64>,
    /// The octant that is farthest from the median, and its value less the median.
    pub worst: Option<OctantDeparture>,
}

impl OctantFigure {
    fn new(name: &'static str, unit: OctantUnit, octants: [Option<f64>; OCTANTS]) -> Self {
        let present: Vec<f64> = octants.iter().flatten().copied().collect();
        let middle = (!present.is_empty()).then(|| median(present.clone()));
        let (least, most) = span(present);
        let departures = (1..)
            .zip(&octants)
            .filter_map(|(octant, value)| Some(OctantDeparture { octant, by: (*value)? - middle? }));
        let worst = departures.reduce(|a, b| if b.by.abs() > a.by.abs() { b } else { a });
        Self { name, unit, octants, median: middle, spread: middle.map(|_| most - least), worst }
    }
}

/// The arrows or the hearts of a stone.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EightfoldPattern {
    /// The azimuths of the octants' axes in the stone's frame, degrees, -180 to 180, counter-clockwise seen from above.
    pub azimuths_deg: [f64; OCTANTS],
    /// The main or the two mains at each octant's axis.
    pub mains: [String; OCTANTS],
    /// The figures.
    pub figures: Vec<OctantFigure>,
    /// The area of the whole pattern in each octant, percent of the face: the interval that unresolved light leaves open.
    pub areas: [Interval; OCTANTS],
    /// The area that is only in the pattern or only in the pattern turned by 45°, in percent of the pattern's area: 0 of an
    /// eightfold pattern, 200 of one that is elsewhere after the turn.
    pub departure: f64,
    /// The median, over the seven other octants, of the area that only one of two octants has once they are turned onto one
    /// another, in percent of the median octant's area.
    pub departures: [f64; OCTANTS],
    /// The part of the face whose strongest exit unresolved light may change, percent.
    pub undecided: f64,
}

impl EightfoldPattern {
    /// Returns the octant with the greatest departure.
    pub fn worst(&self) -> OctantDeparture {
        let all = (1..).zip(self.departures).map(|(octant, by)| OctantDeparture { octant, by });
        all.reduce(|a, b| if b.by > a.by { b } else { a }).unwrap_or(OctantDeparture { octant: 1, by: 0.0 })
    }
}

/// The arrows and the hearts of a stone.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HeartsAndArrows {
    /// The half angle of the viewer's camera, degrees from the axis.
    pub camera_deg: f64,
    /// The half angle of the viewer's ring, degrees from the axis.
    pub ring_deg: f64,
    /// The arrows, face up. Octants are centred on the mains.
    pub arrows: EightfoldPattern,
    /// The hearts, seen through the pavilion. Octants are centred between the mains; the first is the one after that of the
    /// first arrow.
    pub hearts: EightfoldPattern,
}

/// The reason why there are no figures of hearts and arrows.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum HeartsError {
    /// The stone is no eightfold brilliant.
    #[error(transparent)]
    NotEightfold(#[from] NotEightfold),
    /// The watch stopped the work.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// Measures the arrows and hearts of a stone in a viewer whose camera and ring have these half angles, degrees from the axis
/// (the program's own are [`VIEWER_CONES_DEG`](brillianteer_scene::VIEWER_CONES_DEG)).
///
/// The symmetry of the stone is not used, whatever the options say, so that each octant is traced by itself.
///
/// # Errors
/// Fails with [`HeartsError`] where the stone is no round brilliant of eight mains, or `watch` asks to stop.
pub fn hearts_and_arrows(
    stone: &Stone,
    medium: Medium,
    (camera_deg, ring_deg): (f64, f64),
    options: &BeamOptions,
    watch: Watch,
) -> Result<HeartsAndArrows, HeartsError> {
    let mains = Mains::of(stone)?;
    let options = BeamOptions { symmetry: false, ..*options };
    let traced = |side, from: f64| {
        let view = View { side, ..View::default() };
        trace(&stone.polytope, medium, &view, &options, &|done| watch(from + done / 2.0))
    };
    let outline = Outline::of(&stone.polytope);
    let (middle, radius) = (outline.middle, outline.diameter / 2.0);
    let arrows = {
        let beams = traced(Side::Table, 0.0)?;
        arrows(&beams, &OctantFrame { middle, radius, azimuth: mains.azimuth }, (&mains, ring_deg))
    };
    let beams = traced(Side::Culet, 0.5)?;
    let frame = OctantFrame { middle, radius, azimuth: mains.azimuth + FRAC_PI_4 / 2.0 };
    let hearts = hearts(&beams, &frame, &mains, [camera_deg, ring_deg]);
    Ok(HeartsAndArrows { camera_deg, ring_deg, arrows, hearts })
}

/// Returns the arrows: all cells that show the viewer's camera or ring.
fn arrows(beams: &Beams, frame: &OctantFrame, (mains, ring_deg): (&Mains, f64)) -> EightfoldPattern {
    let is_table = |facet: u32| mains.table.contains(&(facet as usize));
    let octants = OctantPattern::of(beams, frame, |outline, exit| {
        let is_lit = elevation_deg(beams.get(exit).exit, beams.zenith) >= 90.0 - ring_deg;
        let seen_through = beams.facets(outline).first().copied();
        let layer = if seen_through.is_some_and(is_table) { SHAFT } else { HEAD };
        if is_lit { CellKind::Lit { layer } } else { CellKind::Dark }
    });
    let regions =
        octants.each_ref().map(|octant| [SHAFT, HEAD].map(|layer| octant.regions(layer).into_iter().next()));
    let of_both = |of: &dyn Fn(&Region, &Region) -> f64| {
        regions.each_ref().map(|[shaft, head]| Some(of(shaft.as_ref()?, head.as_ref()?)))
    };
    let of_one =
        |at: usize, of: &dyn Fn(&Region) -> f64| regions.each_ref().map(|both| both[at].as_ref().map(of));
    let face = face(beams, frame);
    let [shaft, head] = [0, 1];
    let mut figures =
        vec![lengths("arrow length", of_both(&|shaft, head| head.outer(OctantSide::Both) - shaft.inner()))];
    for (at, [area, length, width, azimuth]) in [
        (shaft, ["shaft area", "shaft length", "shaft width", "shaft azimuth"]),
        (head, ["head area", "head length", "head width", "head azimuth"]),
    ] {
        figures.push(areas(area, of_one(at, &|region| region.area()), face));
        figures.push(lengths(length, of_one(at, &extent)));
        figures.push(lengths(width, of_one(at, &|region| region.width())));
        figures.push(azimuths(azimuth, of_one(at, &|region| region.azimuth())));
    }
    pattern(&octants, figures, (beams, frame), mains.names.clone())
}

/// Returns the hearts: all cells that show the viewer's ring.
fn hearts(
    beams: &Beams,
    frame: &OctantFrame,
    mains: &Mains,
    [camera_deg, ring_deg]: [f64; 2],
) -> EightfoldPattern {
    let octants = OctantPattern::of(beams, frame, |_, exit| {
        let elevation = elevation_deg(beams.get(exit).exit, beams.zenith);
        let is_lit = (90.0 - ring_deg..90.0 - camera_deg).contains(&elevation);
        if is_lit { CellKind::Lit { layer: HEART } } else { CellKind::Dark }
    });
    let regions = octants.each_ref().map(|octant| octant.regions(HEART));
    let of_heart = |of: &dyn Fn(&Region) -> Option<f64>| regions.each_ref().map(|all| of(all.first()?));
    let lobe = |side| of_heart(&|heart| Some(heart.outer(side)));
    let cleft = |heart: &Region| {
        let [left, right] = [OctantSide::Left, OctantSide::Right].map(|side| heart.outer(side));
        Some(f64::midpoint(left, right) - heart.outer_on_axis()?)
    };
    let gap = regions.each_ref().map(|all| {
        let (heart, others) = all.split_first()?;
        let below = others.iter().find(|region| region.is_below(heart))?;
        Some(heart.inner() - below.outer_on_axis()?)
    });
    let figures = vec![
        areas("heart area", of_heart(&|heart| Some(heart.area())), face(beams, frame)),
        lengths("heart length", of_heart(&|heart| Some(extent(heart)))),
        lengths("heart width", of_heart(&|heart| Some(heart.width()))),
        azimuths("heart azimuth", of_heart(&|heart| Some(heart.azimuth()))),
        lengths("left lobe", lobe(OctantSide::Left)),
        lengths("right lobe", lobe(OctantSide::Right)),
        lengths("cleft", of_heart(&cleft)),
        lengths("gap to the V", gap),
    ];
    let next = |octant: usize| &mains.names[(octant + 1) % OCTANTS];
    let between = std::array::from_fn(|octant| format!("{} and {}", mains.names[octant], next(octant)));
    pattern(&octants, figures, (beams, frame), between)
}

/// Returns the distance along the radius from a region's nearest to its farthest point, seen from the stone's axis.
fn extent(region: &Region) -> f64 {
    region.outer(OctantSide::Both) - region.inner()
}

/// Returns the area of the stone seen along its axis, squared girdle radii.
fn face(beams: &Beams, frame: &OctantFrame) -> f64 {
    beams.silhouette_area / frame.radius.powi(2)
}

fn areas(name: &'static str, octants: [Option<f64>; OCTANTS], face: f64) -> OctantFigure {
    OctantFigure::new(name, OctantUnit::Face, octants.map(|area| area.map(|area| 100.0 * area / face)))
}

fn lengths(name: &'static str, octants: [Option<f64>; OCTANTS]) -> OctantFigure {
    OctantFigure::new(name, OctantUnit::Diameter, octants.map(|radii| radii.map(|radii| 50.0 * radii)))
}

fn azimuths(name: &'static str, octants: [Option<f64>; OCTANTS]) -> OctantFigure {
    OctantFigure::new(name, OctantUnit::Degrees, octants.map(|azimuth| azimuth.map(f64::to_degrees)))
}

/// Puts a pattern together from its octants and their figures.
fn pattern(
    octants: &[OctantPattern; OCTANTS],
    figures: Vec<OctantFigure>,
    (beams, frame): (&Beams, &OctantFrame),
    mains: [String; OCTANTS],
) -> EightfoldPattern {
    let percent = |area: f64| 100.0 * area / face(beams, frame);
    let whole: f64 = octants.iter().map(OctantPattern::area).sum();
    let of_octant = median(octants.iter().map(OctantPattern::area).collect());
    // Departures are in percent of an area; a stone without the pattern has the departure 0.
    let part = |difference: f64, area: f64| if area > 0.0 { 100.0 * difference / area } else { 0.0 };
    let mut differences = [[0.0; OCTANTS]; OCTANTS];
    for a in 0..OCTANTS {
        for b in 0..a {
            let difference = octants[a].difference(&octants[b]);
            (differences[a][b], differences[b][a]) = (difference, difference);
        }
    }
    let others = |a: usize| (0..OCTANTS).filter(move |&b| b != a);
    let turned: f64 = (0..OCTANTS).map(|a| differences[a][(a + 1) % OCTANTS]).sum();
    EightfoldPattern {
        azimuths_deg: std::array::from_fn(|k| {
            let azimuth = frame.azimuth + FRAC_PI_4 * k as f64;
            glam::DVec2::from_angle(azimuth).to_angle().to_degrees()
        }),
        mains,
        figures,
        areas: octants
            .each_ref()
            .map(|octant| Interval::from(percent(octant.certain), percent(octant.undecided))),
        departure: part(turned, whole),
        departures: std::array::from_fn(|a| {
            part(median(others(a).map(|b| differences[a][b]).collect()), of_octant)
        }),
        undecided: percent(octants.iter().map(|octant| octant.undecided).sum()),
    }
}

#[cfg(test)]
mod tests;
