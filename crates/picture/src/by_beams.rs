//! Pictures under light by exact beams. Every virtual facet is painted in the colour of the light that comes through
//! it. So edges are as smooth as the exact area of pixels makes them, and only the wavelengths are sampled.

mod patches;
mod shared_picture;

use self::patches::Patches;
use self::shared_picture::SharedPicture;
use super::raster::Rows;
use brillianteer_base::{Stopped, Watch};
use brillianteer_math::{Basis, Polytope, Symmetry, centroid, span};
use brillianteer_optics::Stratum;
use brillianteer_scene::{Instance, Medium, View};
use brillianteer_trace::beam::{self, Beam, Beams};
use brillianteer_trace::sampling::{LitScene, ProgressiveImage, RadiancePixel, SamplePass, colour};
use glam::{DAffine2, DMat2, DVec3, DVec4};
use rayon::prelude::*;
use std::ops::Range;

/// The number of rows painted as one piece of work.
const PIECE: u32 = 16;

/// The most bytes of colour and cover that are held at once; larger pictures are painted in several ranges of rows.
const MOST_BYTES: usize = 192 << 20;

/// The number of beams whose colours are computed as one piece of work.
const AT_ONCE: usize = 512;

/// The subject of a picture: one stone in its light.
struct Subject<'a> {
    lit_scene: LitScene<'a>,
    instance: &'a Instance,
    stone: &'a Polytope,
    /// The view in the frame of the stone's body. A stone that is turned has the beams of another view.
    view: View,
    /// The image's axes in the world.
    eye: Basis,
    options: beam::BeamOptions,
}

/// A picture of one stone, or some rows of it, by exact beams.
pub struct ByBeams<'a> {
    subject: Subject<'a>,
    /// True where each wavelength is traced on its own.
    is_apart: bool,
    passes: u32,
    rows: Range<u32>,
    /// Colour and cover, piece by piece, not yet summed along the rows (see [`Rows::summed`]).
    pieces: Vec<Rows<DVec4>>,
    unresolved: f64,
    absorbed: f64,
    /// The light that parallel rays see beside the stone where the environment is the backdrop, summed over passes. All
    /// rays have one direction, so it is one colour.
    beside: DVec3,
}

impl Subject<'_> {
    /// Returns the polygons of one band's beams in their colours, in all copies of the symmetry.
    fn patches(&self, beams: &Beams, pass: &SamplePass, band: usize) -> Vec<Patches> {
        let response = &pass.responses[band];
        self.patches_of(beams, band == 0, |beam, fan, copy| {
            colour(response, self.arriving(beams, beam, (beam.exit, fan), copy))
        })
    }

    /// Returns the polygons of all beams, in all copies of the symmetry, in the colour that `coloured` gives each. With
    /// `is_first` they also carry the silhouette's cover.
    fn patches_of(
        &self,
        beams: &Beams,
        is_first: bool,
        coloured: impl Fn(&Beam, DVec3, DMat2) -> DVec3 + Sync,
    ) -> Vec<Patches> {
        let fans = beams.exit_changes(self.stone);
        let copies = self.copies(&beams.symmetry);
        let ids: Vec<u32> = (0..beams.len() as u32).collect();
        let some = |ids: &[u32]| {
            let mut out = Patches::default();
            for beam in
                ids.iter().map(|&id| beams.get(id)).filter(|b| b.weight > 0.0 || (is_first && b.is_surface()))
            {
                let cover = f64::from(u8::from(is_first && beam.is_surface()));
                for (copy, pixels) in &copies {
                    let colour = coloured(&beam, fans[beam.id as usize], *copy);
                    out.add(&beam, &beams.medium, pixels, colour.extend(cover));
                }
            }
            out
        };
        ids.par_chunks(AT_ONCE).map(some).collect()
    }

    /// Returns the light that comes through a copy of a beam, by channel, before absorption.
    fn arriving(&self, beams: &Beams, beam: &Beam, (exit, fan): (DVec3, DVec3), copy: DMat2) -> DVec4 {
        let turned = |v: DVec3| self.in_world(&beams.view, copy, v);
        let weight = beam.weight / beam.transmittance;
        self.lit_scene.environment.radiance(DVec3::ZERO, turned(exit), turned(fan)) * weight
    }

    /// Returns a vector in the world that lies in a copy of the body's frame; `own` are the image's axes in that frame.
    fn in_world(&self, own: &Basis, copy: DMat2, v: DVec3) -> DVec3 {
        // The vector is converted from the frame of the body into the image, and from there into the world.
        self.eye.lift(copy * own.project(v)) + self.eye.toward * own.toward.dot(v)
    }

    /// Returns the copies of a symmetry, each with the map from the body's image to pixels.
    fn copies(&self, symmetry: &Symmetry) -> Vec<(DMat2, DAffine2)> {
        let pose = &self.instance.pose;
        let pixels = self.lit_scene.film.pixels_from_image(DMat2::IDENTITY);
        let middle = pixels.transform_point2(self.eye.project(pose.at));
        let copy = |c: DMat2| (c, DAffine2::from_mat2_translation(pixels.matrix2 * c * pose.scale, middle));
        symmetry.copies().into_iter().map(copy).collect()
    }
}

impl<'a> ByBeams<'a> {
    /// Prepares a whole picture. Returns `None` where exact beams do not apply: for several stones, a stone of
    /// triangles, a perspective view, or a photograph as backplate.
    pub fn new(lit_scene: LitScene<'a>, options: beam::BeamOptions) -> Option<Self> {
        Self::of_rows(lit_scene, options, 0..lit_scene.film.size[1])
    }

    /// Returns how many rows of a picture of this width may be prepared at once, so that they take no more than 192 MiB.
    pub fn most_rows(width: u32) -> u32 {
        let piece = PIECE as usize * (width as usize + 1) * size_of::<DVec4>();
        ((MOST_BYTES / piece).max(1) as u32).saturating_mul(PIECE)
    }

    /// Prepares some rows of a picture, as [`new`](Self::new) does for all rows. Each range of rows traces the beams
    /// of the whole picture again.
    ///
    /// Where the ranges begin at multiples of [`most_rows`](Self::most_rows), the rows equal those of the whole picture
    /// to the bit.
    pub fn of_rows(lit_scene: LitScene<'a>, options: beam::BeamOptions, rows: Range<u32>) -> Option<Self> {
        let [instance] = lit_scene.scene.instances.as_slice() else { return None };
        let environment = &lit_scene.environment;
        if lit_scene.view.projection != brillianteer_scene::Projection::Orthographic
            || environment.backplate.is_some()
        {
            return None;
        }
        let across = lit_scene.film.size[0];
        let piece = |first: u32| Rows::new(first, PIECE.min(rows.end - first), across, 1);
        let pieces = rows.clone().step_by(PIECE as usize).map(piece).collect();
        let stone = &instance.body.stone().ok()?.polytope;
        let view = lit_scene.view.of_turned(instance.pose.turn);
        let subject = Subject { lit_scene, instance, stone, view, eye: lit_scene.view.basis(), options };
        Some(Self {
            subject,
            is_apart: false,
            passes: 0,
            rows,
            pieces,
            unresolved: 0.0,
            absorbed: 0.0,
            beside: DVec3::ZERO,
        })
    }

    /// Returns the same picture without sharing of beams between wavelengths. It has no error from sharing, and takes
    /// many times as long.
    pub fn apart(self) -> Self {
        Self { is_apart: true, ..self }
    }

    /// Adds a sample pass over all wavelengths from the beams of the middle wavelength alone. It is quick, and meant
    /// for a picture that will soon change.
    /// Directions at the other wavelengths are correct to first order, and absorption is that along the path through
    /// the middle of each beam.
    ///
    /// # Errors
    /// Fails with [`Stopped`] when `watch` stops the work.
    pub fn glance(&mut self, strata: &[Stratum], watch: Watch) -> Result<(), Stopped> {
        let (Some(first), Some(last)) = (strata.first(), strata.last()) else { return Ok(()) };
        let middle = strata[strata.len() / 2].at(0.5);
        let subject = &self.subject;
        let medium = |nm| subject.lit_scene.scene.medium(subject.instance, nm);
        let whole = medium((first.from_nm, middle, last.to_nm));
        let clear = Medium { absorption: [0.0; 2], ..whole };
        let beams = beam::trace(subject.stone, clear, &subject.view, &subject.options, watch)?;
        let band = |s: &Stratum| {
            let own = medium((s.from_nm, s.at(0.5), s.to_nm));
            Band::new(s, own, subject.instance.material.index(middle), whole.spread)
        };
        let bands: Vec<Band> = strata.iter().map(band).collect();
        let whole = [0, 1, 2, 3].map(|channel| strata.iter().map(|s| s.response[channel]).sum());
        let found = subject.patches_of(&beams, true, |beam, fan, copy| {
            let path = beam.path.at(centroid(beam.outline));
            bands
                .iter()
                .map(|band| {
                    let toward = (beam.exit + fan * band.off, fan * band.part);
                    let light = subject.arriving(&beams, beam, toward, copy) * band.left(path);
                    colour(&band.response, light)
                })
                .sum()
        });
        self.see_beside(&whole);
        self.paint(&found);
        let absorbed = |beam: &Beam| {
            let path = beam.path.at(centroid(beam.outline));
            let lost = bands.iter().map(|band| 1.0 - band.left(path)).sum::<f64>();
            if beam.is_surface() { 0.0 } else { beam.weight * beam.area * lost / bands.len() as f64 }
        };
        self.absorbed += beams.iter().map(|beam| absorbed(&beam)).sum::<f64>() * share_of_area(&beams);
        self.unresolved += beams.unresolved();
        self.passes += 1;
        Ok(())
    }

    /// Adds the light that parallel rays see beside the stone, where the environment is the backdrop; `whole` is the response
    /// of all strata.
    fn see_beside(&mut self, whole: &[DVec3; 4]) {
        let Subject { lit_scene, eye, .. } = &self.subject;
        if lit_scene.environment.backdrop {
            let light = lit_scene.environment.radiance(DVec3::ZERO, -eye.toward, DVec3::ZERO);
            self.beside += colour(whole, light);
        }
    }

    fn paint(&mut self, found: &[Patches]) {
        paint(&mut self.pieces, &self.rows, found);
    }
}

/// Paints lists of patches, one after the other, onto the pieces of some rows.
fn paint(pieces: &mut [Rows<DVec4>], rows: &Range<u32>, found: &[Patches]) {
    let count = pieces.len();
    let (top, bottom) = (f64::from(rows.start), f64::from(rows.end));
    // For each piece of rows, the patches that touch it, as (list, place).
    let mut touching: Vec<Vec<(u32, u32)>> = vec![vec![]; count];
    for (list, patches) in found.iter().enumerate() {
        for (place, &(start, end, _)) in patches.patches.iter().enumerate() {
            let heights = patches.corners[start as usize..end as usize].iter().map(|c| c.y);
            let (low, high) = span(heights);
            if high <= top || low >= bottom {
                continue;
            }
            let piece = |y: f64| (((y - top) / f64::from(PIECE)) as usize).min(count - 1);
            touching[piece(low)..=piece(high)].iter_mut().for_each(|t| t.push((list as u32, place as u32)));
        }
    }
    pieces.par_iter_mut().zip(&touching).for_each(|(rows, touching)| {
        for &(list, place) in touching {
            let Patches { corners, patches } = &found[list as usize];
            let (start, end, colour) = patches[place as usize];
            rows.add(&corners[start as usize..end as usize], 0, colour);
        }
    });
}

/// Returns the share of the silhouette's light that a unit of area represents, over all copies of the symmetry.
fn share_of_area(beams: &Beams) -> f64 {
    f64::from(beams.symmetry.order()) / beams.silhouette_area
}

/// A band of wavelengths whose light follows the beams of another wavelength.
struct Band {
    /// The offset of the band's middle, and the band's width, as parts of the spread of all bands.
    off: f64,
    part: f64,
    response: [DVec3; 4],
    medium: Medium,
}

impl Band {
    /// Returns a band with this medium for beams of the index `middle`. `spread` is the difference of the indices
    /// over all bands.
    fn new(stratum: &Stratum, medium: Medium, middle: f64, spread: f64) -> Self {
        let share = |change: f64| if spread == 0.0 { 0.0 } else { change / spread };
        Self {
            off: share(medium.index - middle),
            part: share(medium.spread),
            response: stratum.response,
            medium,
        }
    }

    /// Returns the share of the band's light that absorption leaves after a path of this length.
    fn left(&self, path: f64) -> f64 {
        if self.medium.is_clear() { 1.0 } else { self.medium.transmittance(path.max(0.0)) }
    }
}

impl ByBeams<'_> {
    /// Adds sample passes whose wavelengths share beams.
    fn add_shared(&mut self, passes: &[SamplePass], watch: Watch) -> Result<(), Stopped> {
        passes.iter().for_each(|pass| self.see_beside(&pass.whole));
        let Self { subject, rows, pieces, .. } = self;
        let picture = SharedPicture::new(subject, passes);
        let lost = picture.trace(|patches| paint(pieces, rows, patches), watch)?;
        self.unresolved += lost.unresolved;
        self.absorbed += lost.absorbed;
        self.passes += passes.len() as u32;
        Ok(())
    }

    /// Adds a sample pass, wavelength by wavelength.
    fn add_apart(&mut self, pass: &SamplePass, watch: Watch) -> Result<(), Stopped> {
        let bands = pass.responses.len();
        self.see_beside(&pass.whole);
        for (band, &medium) in pass.media[0].iter().enumerate() {
            let done = |part: f64| watch((band as f64 + part) / bands as f64);
            let subject = &self.subject;
            let beams = beam::trace(subject.stone, medium, &subject.view, &subject.options, &done)?;
            let found = subject.patches(&beams, pass, band);
            self.paint(&found);
            self.unresolved += beams.unresolved() / bands as f64;
            let whole = share_of_area(&beams) / bands as f64;
            self.absorbed += beams.iter().map(|b| b.absorbed).sum::<f64>() * whole;
        }
        self.passes += 1;
        Ok(())
    }
}

impl<E: From<Stopped>> ProgressiveImage<E> for ByBeams<'_> {
    fn add_pass(&mut self, pass: &SamplePass, watch: Watch) -> Result<(), E> {
        if self.is_apart {
            Ok(self.add_apart(pass, watch)?)
        } else {
            Ok(self.add_shared(std::slice::from_ref(pass), watch)?)
        }
    }

    fn add_passes(
        &mut self,
        numbers: Range<u32>,
        pass: &dyn Fn(u32) -> SamplePass,
        watch: Watch,
    ) -> Result<(), E> {
        if !self.is_apart {
            let passes: Vec<SamplePass> = numbers.map(pass).collect();
            return Ok(self.add_shared(&passes, watch)?);
        }
        let all = numbers.len() as f64;
        for (done, number) in numbers.enumerate() {
            self.add_apart(&pass(number), &|part| watch((done as f64 + part) / all))?;
        }
        Ok(())
    }

    /// Unresolved and absorbed light is known only for the picture as a whole, so every covered pixel gets the mean.
    fn each_pixel(&self, each: &mut dyn FnMut(&RadiancePixel)) -> Result<(), E> {
        let share = 1.0 / f64::from(self.passes.max(1));
        for piece in &self.pieces {
            let rows = piece.clone().summed();
            for v in (rows.first..rows.first + rows.count).flat_map(|y| rows.row(y, 0)) {
                let cover = v.w * share;
                let is_whole = self.subject.lit_scene.environment.backdrop;
                each(&RadiancePixel {
                    colour: (v.truncate() + self.beside * (1.0 - cover)) * share,
                    cover: if is_whole { 1.0 } else { cover },
                    unresolved: self.unresolved * share * cover,
                    absorbed: self.absorbed * share * cover,
                });
            }
        }
        Ok(())
    }
}
