//! Overlays on a developed picture: edges, facets, and the paths of the rays through the pixels' middles.
//!
//! Rays are those of sodium's D line, in the stone that they meet first. Light that goes on into another stone is not
//! followed.

mod scale;
mod wireframe;

use self::scale::viridis;
use self::wireframe::Wires;
use super::NameError;
use brillianteer_base::{Stopped, Watch};
use brillianteer_trace::DispersedRay;
use brillianteer_trace::ray::{Exit, MeetingRay, ProbeRay, SceneProbe};
use brillianteer_trace::sampling::LitScene;
use rayon::prelude::*;
use std::str::FromStr;

/// An overlay to draw over a picture of stones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Overlay {
    /// The stones' edges: bright where the eye sees them, fainter behind.
    Wireframe,
    /// A colour for each facet.
    Facets,
    /// The number of reflections inside, until no more than the least weight is left of a ray.
    Bounces,
    /// The share of a ray that is not followed to its end.
    Unresolved,
    /// The number of total reflections before the first facet that lets light out.
    Total,
}

/// The overlays with their names.
const NAMES: [(&str, Overlay); 5] = [
    ("wireframe", Overlay::Wireframe),
    ("facets", Overlay::Facets),
    ("bounces", Overlay::Bounces),
    ("unresolved", Overlay::Unresolved),
    ("total", Overlay::Total),
];

/// The number of rows drawn between two calls of the watch.
const PIECE: usize = 16;

/// The part of the picture that a facet's colour hides.
const TINT: f32 = 0.5;

/// The number of bounces at the upper end of the scale.
const MOST_BOUNCES: u32 = 48;

/// The unresolved shares at both ends of the scale, as powers of ten.
const UNRESOLVED: (f64, f64) = (-6.0, -1.0);

/// The number of total reflections at the upper end of the scale.
const MOST_TOTAL: u32 = 8;

/// An eight-bit sRGB colour.
pub type Code = [u8; 3];

impl Overlay {
    /// Returns the names that [`from_str`](FromStr) takes.
    pub fn names() -> [&'static str; 5] {
        NAMES.map(|(name, _)| name)
    }

    /// Returns the meanings of the colours of the scale, from the lowest. It is empty for wireframe and facets, which
    /// have no scale.
    pub fn legend(self) -> Vec<(String, Code)> {
        match self {
            Self::Wireframe | Self::Facets => vec![],
            Self::Bounces => [1, 8, 16, 24, 32, 40, MOST_BOUNCES]
                .map(|n| (at_the_end(n, MOST_BOUNCES), bounces_colour(n)))
                .to_vec(),
            Self::Unresolved => ["0.0001 %", "0.001 %", "0.01 %", "0.1 %", "1 %", "10 % or more"]
                .iter()
                .zip(-6..)
                .map(|(text, power)| ((*text).to_owned(), unresolved_colour(10_f64.powi(power))))
                .collect(),
            Self::Total => (0..=MOST_TOTAL).map(|n| (at_the_end(n, MOST_TOTAL), total_colour(n))).collect(),
        }
    }

    /// Returns the colour over the place that a ray meets, and the part of that place that it hides.
    fn colour(self, sight: &SceneProbe, glance: &ProbeRay) -> Option<(Code, f32)> {
        match self {
            Self::Wireframe => None,
            Self::Facets => Some((scale::distinct(glance.stone, glance.facet), TINT)),
            Self::Bounces => Some((bounces_colour(Fate::of(sight, glance)?.bounces), 1.0)),
            Self::Unresolved => Some((unresolved_colour(Fate::of(sight, glance)?.unresolved), 1.0)),
            Self::Total => Some((total_colour(Fate::of(sight, glance)?.total), 1.0)),
        }
    }
}

impl FromStr for Overlay {
    type Err = NameError;

    fn from_str(text: &str) -> Result<Self, NameError> {
        let asked = text.trim();
        let found = NAMES.iter().find(|(name, _)| name.eq_ignore_ascii_case(asked));
        found
            .map(|(_, overlay)| *overlay)
            .ok_or_else(|| NameError::Overlay { asked: asked.to_owned(), known: Self::names().join(", ") })
    }
}

fn at_the_end(number: u32, most: u32) -> String {
    if number < most { number.to_string() } else { format!("{most} or more") }
}

fn bounces_colour(bounces: u32) -> Code {
    viridis((f64::from(bounces) - 1.0) / f64::from(MOST_BOUNCES - 1))
}

/// Returns the colour of an unresolved share, on a logarithmic scale.
fn unresolved_colour(share: f64) -> Code {
    let (low, high) = UNRESOLVED;
    viridis((share.max(f64::MIN_POSITIVE).log10() - low) / (high - low))
}

fn total_colour(count: u32) -> Code {
    viridis(f64::from(count) / f64::from(MOST_TOTAL))
}

/// The path of a ray inside the stone that it meets first, in numbers.
struct Fate {
    bounces: u32,
    unresolved: f64,
    total: u32,
}

impl Fate {
    /// Follows a ray from the facet that it meets; `None` where the ray runs along the facet.
    fn of(sight: &SceneProbe, glance: &ProbeRay) -> Option<Self> {
        let &ProbeRay { origin, direction, stone, facet, distance } = glance;
        let mut first = None;
        let ray = MeetingRay::from_eye((facet as usize, distance), DispersedRay::new(origin, direction));
        let leave = |exit: Exit| {
            if exit.bounce > 0 {
                first.get_or_insert(exit.bounce - 1);
            }
        };
        let rest = sight.tracers[stone].follow_from(&ray, |_, _| false, leave)?;
        let total = first.unwrap_or(rest.bounces);
        Some(Self { bounces: rest.bounces, unresolved: rest.unresolved, total })
    }
}

/// An overlay of a lit scene, ready to be drawn.
pub struct OverlayDrawing<'a> {
    overlay: Overlay,
    size: [u32; 2],
    sight: SceneProbe<'a>,
    /// The lines of a wireframe.
    wires: Option<Wires>,
}

impl<'a> OverlayDrawing<'a> {
    /// Prepares an overlay of a scene, on the pixels of its film.
    pub fn new(overlay: Overlay, lit_scene: &LitScene<'a>) -> Self {
        let sight = SceneProbe::new(lit_scene);
        let wires = (overlay == Overlay::Wireframe).then(|| Wires::new(lit_scene, &sight));
        Self { overlay, size: lit_scene.film.size, sight, wires }
    }

    /// Draws the overlay over the rows of a picture from row `first` on, some at a time, so that `watch` can stop it. Rows
    /// beyond the height of the film stay as they are. See [`lay`].
    ///
    /// # Errors
    /// Fails with [`Stopped`] when `watch` stops the work; the rows are then drawn over in part.
    pub fn lay(&self, first: u32, rgba: &mut [u8], watch: Watch) -> Result<(), Stopped> {
        let [width, height] = self.size;
        let rows = rgba.chunks_exact_mut(4 * (width as usize).max(1));
        let mut rows: Vec<_> = (first..height).zip(rows).collect();
        for piece in rows.chunks_mut(PIECE) {
            if watch(f64::from(piece[0].0) / f64::from(height)).is_break() {
                return Err(Stopped);
            }
            piece.par_iter_mut().for_each(|(y, row)| self.lay_row(*y, row));
        }
        Ok(())
    }

    fn lay_row(&self, y: u32, row: &mut [u8]) {
        if let Some(wires) = &self.wires {
            return wires.draw(&self.sight, y as usize, row);
        }
        for (x, pixel) in row.as_chunks_mut().0.iter_mut().enumerate() {
            let glance = self.sight.through(x as f64 + 0.5, f64::from(y) + 0.5);
            if let Some((colour, share)) = glance.and_then(|g| self.overlay.colour(&self.sight, &g)) {
                lay_over(pixel, colour, share);
            }
        }
    }
}

/// Draws an overlay over a picture of a lit scene: eight-bit sRGB and cover, not premultiplied, row by row from the top,
/// as [`develop`](super::develop()) makes it. Rows beyond the height of the scene's film stay as they are.
///
/// # Errors
/// Fails with [`Stopped`] when `watch` stops the work; the picture is then drawn over in part.
pub fn lay(overlay: Overlay, lit_scene: &LitScene, rgba: &mut [u8], watch: Watch) -> Result<(), Stopped> {
    OverlayDrawing::new(overlay, lit_scene).lay(0, rgba, watch)
}

/// Lays a share of a colour over a pixel that is not premultiplied.
fn lay_over(pixel: &mut [u8; 4], colour: Code, share: f32) {
    let below = f32::from(pixel[3]) / 255.0 * (1.0 - share);
    let cover = share + below;
    if cover <= 0.0 {
        return;
    }
    for (old, new) in pixel.iter_mut().zip(colour) {
        *old = ((f32::from(new) * share + f32::from(*old) * below) / cover).round() as u8;
    }
    pixel[3] = (255.0 * cover).round() as u8;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_overlay_is_found_by_its_name() {
        for (name, overlay) in NAMES {
            assert_eq!(name.to_uppercase().parse(), Ok(overlay));
        }
        assert!("edges".parse::<Overlay>().unwrap_err().to_string().ends_with("bounces, unresolved, total"));
    }

    #[test]
    fn colours_are_laid_over_what_is_there() {
        let mut pixel = [0, 100, 200, 255];
        lay_over(&mut pixel, [100, 100, 100], 0.5);
        assert_eq!(pixel, [50, 100, 150, 255]);
        let mut clear = [9, 9, 9, 0];
        lay_over(&mut clear, [1, 2, 3], 0.0);
        assert_eq!(clear, [9, 9, 9, 0]);
        lay_over(&mut clear, [1, 2, 3], 0.2);
        assert_eq!(clear, [1, 2, 3, 51]);
    }

    #[test]
    fn no_two_entries_of_a_legend_are_alike() {
        for (_, overlay) in NAMES {
            let legend = overlay.legend();
            let alike = legend.windows(2).filter(|w| w[0].1 == w[1].1 || w[0].0 == w[1].0);
            assert_eq!(alike.count(), 0, "{legend:?}");
        }
    }
}
