//! Pictures under light by exact beams: every virtual facet is painted in the colour of the light that comes through it, so
//! that edges are as smooth as a pixel's area and nothing is left to chance but the wavelengths.

use super::raster::Rows;
use super::strips::strips;
use crate::math::Polytope;
use crate::scene::Medium;
use crate::trace::beam::{self, Beam, Beams};
use crate::trace::sitting::{Exposure, Lit, Look, Sitting};
use crate::trace::{Stopped, Watch};
use glam::{DAffine2, DMat2, DVec2, DVec3, DVec4};
use rayon::prelude::*;

/// Where absorption changes a beam's light by more than this part across its outline, it is painted in strips. A beam is a
/// part of a part of what a pixel shows, and the strip's mean is exact.
const UNEVEN: f64 = 1.0 / 16.0;

/// Rows painted as one piece of work.
const PIECE: u32 = 16;

/// Beams whose colours are found as one piece of work.
const AT_ONCE: usize = 512;

/// A whole picture of one stone, by exact beams.
pub struct ByBeams<'a> {
    sitting: Sitting<'a>,
    stone: &'a Polytope,
    options: beam::Options,
    looks: u32,
    /// Colour and cover, as the changes that edges leave.
    pieces: Vec<Rows<DVec4>>,
    unresolved: f64,
    absorbed: f64,
    /// What parallel rays see beside the stone where the surround is the backdrop: one direction's light.
    beside: DVec3,
}

/// Polygons in pixels, each of one colour.
#[derive(Default)]
struct Patches {
    corners: Vec<DVec2>,
    /// First corner and the one after the last, and the colour.
    patches: Vec<(u32, u32, DVec4)>,
}

impl<'a> ByBeams<'a> {
    /// Prepares a picture; `None` where exact beams do not apply: for several stones, in perspective, with a photograph
    /// behind.
    pub fn new(sitting: Sitting<'a>, options: beam::Options) -> Option<Self> {
        let [stone] = sitting.setting.stones.as_slice() else { return None };
        let surround = &sitting.surround;
        if sitting.view.projection != crate::scene::Projection::Orthographic || surround.behind.is_some() {
            return None;
        }
        let [across, down] = sitting.film.size;
        let piece = |first: u32| Rows::new(first, PIECE.min(down - first), across, 1);
        let pieces = (0..down).step_by(PIECE as usize).map(piece).collect();
        let stone = &stone.polytope;
        Some(Self {
            sitting,
            stone,
            options,
            looks: 0,
            pieces,
            unresolved: 0.0,
            absorbed: 0.0,
            beside: DVec3::ZERO,
        })
    }

    /// The colours of one band's beams, in all copies.
    fn patches(&self, beams: &Beams, look: &Look, band: usize) -> Vec<Patches> {
        let (response, is_first) = (&look.responses[band], band == 0);
        let sweeps = beams.sweeps(self.stone);
        let copies: Vec<(DMat2, DAffine2)> = beams
            .symmetry
            .copies()
            .into_iter()
            .map(|c| (c, self.sitting.film.pixels_from_image(c)))
            .collect();
        let ids: Vec<u32> = (0..beams.len() as u32).collect();
        let some = |ids: &[u32]| {
            let mut out = Patches::default();
            for beam in
                ids.iter().map(|&id| beams.get(id)).filter(|b| b.weight > 0.0 || (is_first && b.is_surface()))
            {
                let cover = f64::from(u8::from(is_first && beam.is_surface()));
                for (copy, pixels) in &copies {
                    let sweep = sweeps[beam.id as usize];
                    let light = self.arriving(beams, &beam, (look.middle(beam.exit, sweep), sweep), *copy);
                    let colour: DVec3 = response.iter().zip(light.to_array()).map(|(&c, l)| c * l).sum();
                    out.add(&beam, &beams.medium, pixels, colour.extend(cover));
                }
            }
            out
        };
        ids.par_chunks(AT_ONCE).map(some).collect()
    }

    /// The light that comes through a copy of a beam, by channel, as if nothing were absorbed.
    fn arriving(&self, beams: &Beams, beam: &Beam, (exit, sweep): (DVec3, DVec3), copy: DMat2) -> DVec4 {
        let eye = &beams.view;
        let turned = |v: DVec3| eye.lift(copy * eye.project(v)) + eye.toward * eye.toward.dot(v);
        let weight = beam.weight / beam.transmittance;
        self.sitting.surround.radiance(DVec3::ZERO, turned(exit), turned(sweep)) * weight
    }

    fn paint(&mut self, found: &[Patches]) {
        let count = self.pieces.len();
        // The patches that touch each piece, by (list, place).
        let mut touching: Vec<Vec<(u32, u32)>> = vec![vec![]; count];
        for (list, patches) in found.iter().enumerate() {
            for (place, &(start, end, _)) in patches.patches.iter().enumerate() {
                let heights = patches.corners[start as usize..end as usize].iter().map(|c| c.y);
                let (low, high) =
                    heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), y| (l.min(y), h.max(y)));
                let piece = |y: f64| ((y / f64::from(PIECE)) as usize).min(count - 1);
                touching[piece(low)..=piece(high)]
                    .iter_mut()
                    .for_each(|t| t.push((list as u32, place as u32)));
            }
        }
        self.pieces.par_iter_mut().zip(&touching).for_each(|(rows, touching)| {
            for &(list, place) in touching {
                let Patches { corners, patches } = &found[list as usize];
                let (start, end, colour) = patches[place as usize];
                rows.add(&corners[start as usize..end as usize], 0, colour);
            }
        });
    }
}

impl Patches {
    fn add(&mut self, beam: &Beam, medium: &Medium, pixels: &DAffine2, colour: DVec4) {
        if colour == DVec4::ZERO {
            return;
        }
        let mut put = |part: &[DVec2], left: f64| {
            let start = self.corners.len() as u32;
            self.corners.extend(part.iter().map(|&p| pixels.transform_point2(p)));
            let left = DVec4::new(left, left, left, 1.0);
            self.patches.push((start, self.corners.len() as u32, colour * left));
        };
        if beam.is_surface() {
            return put(beam.outline, 1.0);
        }
        strips(beam.outline, beam.path, medium, UNEVEN, put);
    }
}

impl<E: From<Stopped>> Exposure<E> for ByBeams<'_> {
    fn look(&mut self, look: &Look, watch: Watch) -> Result<(), E> {
        let bands = look.responses.len();
        for (band, &medium) in look.media[0].iter().enumerate() {
            let done = |part: f64| watch((band as f64 + part) / bands as f64);
            let beams = beam::trace(self.stone, medium, self.sitting.view, &self.options, &done)?;
            if self.sitting.surround.backdrop {
                let light = self.sitting.surround.radiance(DVec3::ZERO, -beams.view.toward, DVec3::ZERO);
                let response = look.responses[band].iter().zip(light.to_array());
                self.beside += response.map(|(&c, l)| c * l).sum::<DVec3>();
            }
            let found = self.patches(&beams, look, band);
            self.paint(&found);
            let whole = f64::from(beams.symmetry.order()) / beams.silhouette_area / bands as f64;
            self.unresolved += beams.unresolved() / bands as f64;
            self.absorbed += beams.iter().map(|b| b.absorbed).sum::<f64>() * whole;
        }
        self.looks += 1;
        Ok(())
    }

    /// What is unresolved and absorbed is known of the whole picture alone: every covered pixel bears the mean.
    fn lit(&self, each: &mut dyn FnMut(&Lit)) -> Result<(), E> {
        let share = 1.0 / f64::from(self.looks.max(1));
        for piece in &self.pieces {
            let rows = piece.clone().summed();
            for v in (rows.first..rows.first + rows.count).flat_map(|y| rows.row(y, 0)) {
                let cover = v.w * share;
                let is_whole = self.sitting.surround.backdrop;
                each(&Lit {
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
