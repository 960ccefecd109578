//! Paints beams that several wavelengths share.
//!
//! A beam is painted as seldom as its drift over the group and the strength of its light allow, each time where a part of the
//! group sees it, in the colour of all light of that part. Light is looked up as seldom as its weight allows, along the fan of
//! all wavelengths that share the look-up; where a lamp may come into that fan, each wavelength is looked up alone.

use super::Subject;
use super::patches::{Patches, UNEVEN};
use crate::strips::strips;
use brillianteer_base::{Stopped, Watch};
use brillianteer_math::random_bits::{GAMMA, mixed, unit};
use brillianteer_math::{Affine, area};
use brillianteer_scene::Medium;
use brillianteer_trace::DispersedRay;
use brillianteer_trace::beam::{
    self, BeamEnd, Inside, SharedBeam, SharedBeams, SharedExit, SharedView, SharingOptions,
};
use brillianteer_trace::sampling::{SamplePass, colour};
use brillianteer_trace::shared_tail::SharedTail;
use glam::{DAffine2, DMat2, DVec2, DVec3, DVec4};
use std::cmp::Ordering;
use std::ops::Range;

/// The most by which sharing one beam may change a pixel, as a part of the light of radiance 1.
const MOST_CHANGE: f64 = 2e-3;

/// The number of pixels on a stone's face above which the sharing of beams and the estimates of tails become no
/// finer. Finer work would grow with the number of pixels, and the errors are areas and mean colours, which are not
/// more visible in larger pictures.
const MOST_PIXELS: f64 = 1e6;

/// The most by which painting a beam for several wavelengths at once may change a pixel at its edge.
const MOST_AT_EDGE: f64 = 1e-3;

/// The greatest weight, times the part of all wavelengths, of light that is looked up together where no lamp is near.
const MOST_AT_ONCE: f64 = 4e-3;

/// The most by which the area of a beam's outline at one wavelength may count as another multiple of the area that is
/// painted. Where the painted area is next to nothing, the multiple means nothing.
const MOST_OF_AREA: f64 = 3.0;

/// The part of all wavelengths for which a shared beam is followed as far as a beam of a single wavelength.
const USUAL_PART: f64 = 1.0 / 32.0;

/// The light whose directions one ray estimates, as a part of the light of radiance 1 in a pixel.
const LEFT_AT_ONCE: f64 = 0.2;

/// The most ends of beams that are estimated together.
const MOST_ENDS: usize = 64;

/// The side, in radians, of the square of directions over which the light of such a ray is averaged. After so many
/// bounces, light comes from all sides.
const SPREAD_OF_TAIL: f64 = 0.3;

/// The part of its length by which a fan of several wavelengths may miss a lamp that the wavelengths see.
const BEND: f64 = 0.1;

/// A picture of wavelengths that share beams.
pub(super) struct SharedPicture<'a> {
    subject: &'a Subject<'a>,
    /// The media, in the order of their indices.
    media: Vec<Medium>,
    /// Sums of responses: of all media before each medium, and of all media.
    responses: Vec<[DVec3; 4]>,
    /// The number of sample passes.
    passes: f64,
    is_clear: bool,
    tail: SharedTail,
    /// The area of a pixel in the body's frame, but at least that which gives the stone's face [`MOST_PIXELS`]
    /// pixels.
    pixel: f64,
    /// The energy, summed over wavelengths, whose directions one ray estimates.
    left_at_once: f64,
}

/// The light that a picture does not show, as parts of the silhouette's light, summed over passes.
#[derive(Clone, Copy, Default)]
pub(super) struct Lost {
    pub unresolved: f64,
    pub absorbed: f64,
}

/// The results of one piece of work.
struct PaintedPiece<'a> {
    picture: &'a SharedPicture<'a>,
    view: SharedView,
    copies: Vec<(DMat2, DAffine2)>,
    patches: Patches,
    /// The light that is not shown, as energies of one domain of the symmetry, summed over wavelengths.
    lost: Lost,
    seen: Vec<SeenLight>,
    /// The area of a beam's outline at each of some wavelengths, as a multiple of the area that is painted.
    sizes: Vec<f64>,
    polygon: Vec<DVec2>,
    /// The ends of beams that are neighbours in the tree; `left` is the energy of all their wavelengths.
    ends: Vec<BeamEnd>,
    left: f64,
}

/// The mean light that rays from the ends of beams find, per unit of the light that absorption has left there.
#[derive(Debug, Clone, Copy, Default)]
struct MeanLight {
    /// The light of the clearest wavelength, by channel.
    light: DVec4,
    /// The colour of the light of all wavelengths of a group, divided by their number.
    colour: DVec3,
}

/// Light that was looked up together for some wavelengths of a beam, by channel.
struct SeenLight {
    waves: Range<usize>,
    light: DVec4,
}

/// How the area of a beam's outline changes with the index.
///
/// Several wavelengths are painted as one polygon, whose area is that of none of them. So the light of each counts by its own
/// area; otherwise outlines that grow toward blue would lose blue light.
struct MovingSize {
    /// The area as a polynomial of the change of the slant.
    areas: [f64; 3],
    /// The area of the painted polygon.
    painted: f64,
}

impl MovingSize {
    /// Returns the size of a beam that is painted after a change of its slant.
    fn new(beam: &SharedBeam, change: f64) -> Self {
        let areas = beam.areas();
        Self { areas, painted: polynomial(areas, change) }
    }

    /// Returns the area at an index as a multiple of the painted area.
    fn at(&self, beam: &SharedBeam, index: f64) -> f64 {
        if beam.group.len() == 1 {
            return 1.0;
        }
        let area = polynomial(self.areas, beam.entry.slant(index).slant - beam.slant.slant);
        let part = area / self.painted;
        if part.is_finite() { part.clamp(-MOST_OF_AREA, MOST_OF_AREA) } else { 1.0 }
    }
}

fn polynomial([a, b, c]: [f64; 3], x: f64) -> f64 {
    a + x * (b + x * c)
}

impl<'a> SharedPicture<'a> {
    pub fn new(subject: &'a Subject<'a>, passes: &[SamplePass]) -> Self {
        let bands = passes.iter().flat_map(|pass| pass.media[0].iter().zip(&pass.responses));
        let mut waves: Vec<(Medium, [DVec3; 4])> = bands.map(|(m, r)| (*m, *r)).collect();
        // Media are sorted from short wavelengths to long, so that successive fans adjoin. Media with the same index
        // are sorted by their other numbers, so that equal media are neighbours.
        let rest = |m: &Medium| [m.absorption[0], m.absorption[1], m.spread];
        waves.sort_by(|(a, _), (b, _)| {
            let others = rest(a).into_iter().zip(rest(b)).map(|(a, b)| a.total_cmp(&b));
            std::iter::once(b.index.total_cmp(&a.index)).chain(others).fold(Ordering::Equal, Ordering::then)
        });
        waves.dedup_by(|next, kept| {
            let is_same = next.0 == kept.0;
            if is_same {
                kept.1 = std::array::from_fn(|k| kept.1[k] + next.1[k]);
            }
            is_same
        });
        let mut responses = vec![[DVec3::ZERO; 4]];
        for (_, response) in &waves {
            let before = responses[responses.len() - 1];
            responses.push(std::array::from_fn(|k| before[k] + response[k]));
        }
        let media: Vec<Medium> = waves.iter().map(|wave| wave.0).collect();
        let is_clear = media.iter().all(Medium::is_clear);
        let film_pixel = (subject.lit_scene.film.pixel / subject.instance.pose.scale).powi(2);
        let face = subject.stone.silhouette_area(subject.view.basis().toward);
        let pixel = film_pixel.max(face / MOST_PIXELS);
        let left_at_once = LEFT_AT_ONCE * pixel * media.len() as f64;
        let tail = SharedTail::new(subject.stone, subject.options.polarised);
        Self { subject, media, responses, passes: passes.len() as f64, is_clear, tail, pixel, left_at_once }
    }

    /// Traces the beams and hands on their patches, in order. Returns the light that is not shown.
    pub fn trace(&self, mut hand_on: impl FnMut(&[Patches]), watch: Watch) -> Result<Lost, Stopped> {
        let subject = self.subject;
        let options = SharingOptions {
            beams: subject.options,
            most_change: MOST_CHANGE,
            pixel: self.pixel,
            usual_part: USUAL_PART,
        };
        let prepare = |view: &SharedView| PaintedPiece {
            picture: self,
            view: view.clone(),
            copies: subject.copies(&view.symmetry),
            patches: Patches::default(),
            lost: Lost::default(),
            seen: vec![],
            sizes: vec![],
            polygon: vec![],
            ends: vec![],
            left: 0.0,
        };
        let mut lost = Lost::default();
        let take = |view: &SharedView, pieces: Vec<PaintedPiece>| {
            let share = f64::from(view.symmetry.order()) / view.silhouette_area;
            let per = share * self.passes / self.media.len() as f64;
            for piece in &pieces {
                lost.unresolved += piece.lost.unresolved * per;
                lost.absorbed += piece.lost.absorbed * per;
            }
            let patches: Vec<Patches> = pieces.into_iter().map(|piece| piece.patches).collect();
            hand_on(&patches);
        };
        beam::trace_shared(subject.stone, &self.media, &subject.view, &options, prepare, take, watch)?;
        Ok(lost)
    }

    /// Returns the mean response of some wavelengths after a path of this length through the stone, and the mean
    /// share of their light that is left. Both are relative to the share that is left in the clearest medium.
    fn response_after(&self, waves: &Range<usize>, clearest: &Medium, path: f64) -> ([DVec3; 4], f64) {
        let part = 1.0 / waves.len() as f64;
        if self.is_clear {
            return (self.response(waves).map(|response| response * part), 1.0);
        }
        let kept = clearest.transmittance(path).max(f64::MIN_POSITIVE);
        let (mut sum, mut left) = ([DVec3::ZERO; 4], 0.0);
        for wave in waves.clone() {
            let share = self.media[wave].transmittance(path) / kept * part;
            let response = self.response(&(wave..wave + 1));
            sum = std::array::from_fn(|k| sum[k] + response[k] * share);
            left += share;
        }
        (sum, left)
    }

    /// Returns the refractive index in the middle of some wavelengths.
    fn middle_index(&self, waves: &Range<usize>) -> f64 {
        0.5 * (self.media[waves.start].index + self.media[waves.end - 1].index)
    }

    /// Returns the response of some wavelengths together.
    fn response(&self, waves: &Range<usize>) -> [DVec3; 4] {
        let (before, all) = (&self.responses[waves.start], &self.responses[waves.end]);
        std::array::from_fn(|k| all[k] - before[k])
    }
}

impl SharedBeams for PaintedPiece<'_> {
    fn take(&mut self, beam: &SharedBeam) {
        match &beam.inside {
            None => self.paint_glare(beam),
            Some(inside) => {
                if !self.picture.is_clear {
                    self.lost.absorbed += beam.absorbed(&self.picture.media[beam.group.clone()]);
                }
                for copy in 0..self.copies.len() {
                    self.look_up(beam, inside, copy);
                    self.paint(beam, inside, copy);
                }
            }
        }
    }

    fn leave(&mut self, end: BeamEnd) {
        self.left += end.energy * end.group.len() as f64;
        self.ends.push(end);
        if self.left >= self.picture.left_at_once || self.ends.len() >= MOST_ENDS {
            self.estimate();
        }
    }

    fn finish(&mut self) {
        self.estimate();
    }
}

impl PaintedPiece<'_> {
    /// Paints the light that the outer surface reflects, and the silhouette's cover.
    fn paint_glare(&mut self, beam: &SharedBeam) {
        let picture = self.picture;
        self.polygon.clear();
        self.polygon.extend(beam.outline.iter().map(|corner| corner.at));
        for (copy, pixels) in &self.copies {
            let direction = picture.subject.in_world(&self.view.basis, *copy, beam.entry.glare);
            let environment = &picture.subject.lit_scene.environment;
            let light = environment.radiance(DVec3::ZERO, direction, DVec3::ZERO);
            let of_wave =
                |k: usize| colour(&picture.response(&(k..k + 1)), light * beam.glare(&picture.media[k]));
            let seen: DVec3 = beam.group.clone().map(of_wave).sum();
            self.patches.put(&self.polygon, pixels, seen.extend(picture.passes));
        }
    }

    /// Estimates by rays the directions of the light at the ends, and paints every end in the mean of this light.
    fn estimate(&mut self) {
        let (picture, ends) = (self.picture, std::mem::take(&mut self.ends));
        let left = std::mem::take(&mut self.left);
        let Some(first) = ends.first() else { return };
        let rays = (left / picture.left_at_once).ceil().max(1.0) as u32;
        // The energy is rounded, so that the last digits of a stone's planes do not change the random numbers.
        let mut state = (first.energy.ln() * 1e6).round() as i64 as u64;
        let mut draw = || {
            state = state.wrapping_add(GAMMA);
            unit(mixed(state))
        };
        let mut means = vec![MeanLight::default(); self.copies.len()];
        let (mut absorbed, mut unresolved) = (0.0, 0.0);
        for number in 0..rays {
            let mut place = (f64::from(number) + draw()) / f64::from(rays) * left;
            let is_there = |end: &&BeamEnd| {
                place -= end.energy * end.group.len() as f64;
                place <= 0.0
            };
            let end = ends.iter().find(is_there).unwrap_or(first);
            let luck = (DVec2::new(draw(), draw()), draw());
            let lost = self.follow(end, luck, f64::from(rays), &mut means);
            (absorbed, unresolved) = (absorbed + lost.absorbed, unresolved + lost.unresolved);
        }
        for end in &ends {
            let energy = end.energy * end.group.len() as f64;
            self.lost.absorbed += absorbed * energy;
            self.lost.unresolved += unresolved * energy;
            let response = picture.response(&end.group);
            for (mean, (_, pixels)) in means.iter().zip(&self.copies) {
                let seen = if picture.is_clear {
                    colour(&response, mean.light) * (end.energy / end.area)
                } else {
                    mean.colour * (energy / end.area)
                };
                self.patches.put(&end.outline, pixels, seen.extend(0.0));
            }
        }
    }

    /// Follows one of `rays` rays from the end of a beam, and adds the light that it finds to the mean of each copy.
    /// Returns its part of the light that is lost, per unit of the light that absorption has left at the end.
    fn follow(&self, end: &BeamEnd, luck: (DVec2, f64), rays: f64, means: &mut [MeanLight]) -> Lost {
        let picture = self.picture;
        let environment = &picture.subject.lit_scene.environment;
        let clearest = Medium::clearest(&picture.media[end.group.clone()]).unwrap_or(Medium::clear(1.0));
        // Ends are drawn in proportion to the light that absorption has left; shares are parts of the light without
        // absorption.
        let scale = end.weight * end.area / (end.energy * rays);
        let mut seen = 0.0;
        let (loss, path) = picture.tail.follow(end, &clearest, luck, |exit| {
            let (response, left) = picture.response_after(&end.group, &clearest, exit.path);
            seen += exit.share * left;
            for (mean, (copy, _)) in means.iter_mut().zip(&self.copies) {
                let direction = picture.subject.in_world(&self.view.basis, *copy, exit.direction);
                let ray = DispersedRay::new(DVec3::ZERO, direction);
                let light = environment.radiance_around(&ray, SPREAD_OF_TAIL) * (exit.share * scale);
                mean.light += light;
                mean.colour += colour(&response, light);
            }
        });
        let (_, left) = picture.response_after(&end.group, &clearest, path);
        let absorbed =
            if picture.is_clear { 0.0 } else { left * clearest.transmittance(path) - seen - loss.unresolved };
        Lost { absorbed: absorbed * scale, unresolved: loss.unresolved * scale }
    }

    /// Looks up the light that comes through a copy of a beam, as if nothing were absorbed, into `seen`.
    fn look_up(&mut self, beam: &SharedBeam, inside: &Inside, copy: usize) {
        self.seen.clear();
        let all = self.picture.media.len() as f64;
        let at_once = ((MOST_AT_ONCE * all / beam.weight) as usize).clamp(1, beam.group.len());
        let mut start = beam.group.start;
        while start < beam.group.end {
            let waves = start..(start + at_once).min(beam.group.end);
            start = waves.end;
            if waves.len() < 2 || !self.look_up_together(beam, inside, copy, &waves) {
                for wave in waves {
                    self.look_up_alone(beam, inside, copy, wave);
                }
            }
        }
    }

    fn look_up_alone(&mut self, beam: &SharedBeam, inside: &Inside, copy: usize, wave: usize) {
        let Some(exit) = inside.exit(beam.entry, &self.picture.media[wave]) else { return };
        let light = self.radiance(copy, exit.direction, exit.change) * exit.weight;
        if light != DVec4::ZERO {
            self.seen.push(SeenLight { waves: wave..wave + 1, light });
        }
    }

    /// Looks up the light of several wavelengths along the fan of all. Returns false where they have to be looked up one by
    /// one, because a lamp is near or some are totally reflected.
    fn look_up_together(
        &mut self,
        beam: &SharedBeam,
        inside: &Inside,
        copy: usize,
        waves: &Range<usize>,
    ) -> bool {
        let places = [waves.start, waves.start + waves.len() / 2, waves.end - 1];
        let exits = places.map(|k| inside.exit(beam.entry, &self.picture.media[k]));
        let [Some(first), Some(middle), Some(last)] = exits else {
            return exits.iter().all(Option::is_none);
        };
        let fan = last.direction + 0.5 * last.change - (first.direction - 0.5 * first.change);
        let subject = self.picture.subject;
        let turned = |v| subject.in_world(&self.view.basis, self.copies[copy].0, v);
        let (direction, fan) = (turned(middle.direction), turned(fan));
        let environment = &subject.lit_scene.environment;
        if environment.may_see_lamp(direction, fan, BEND) {
            return false;
        }
        let weight = |exit: SharedExit| exit.weight;
        let weight = (weight(first) + 4.0 * weight(middle) + weight(last)) / 6.0;
        let light = environment.radiance(DVec3::ZERO, direction, fan) * weight;
        if light != DVec4::ZERO {
            self.seen.push(SeenLight { waves: waves.clone(), light });
        }
        true
    }

    /// Returns the light from a direction in a copy of the body's frame.
    fn radiance(&self, copy: usize, direction: DVec3, fan: DVec3) -> DVec4 {
        let subject = self.picture.subject;
        let turned = |v| subject.in_world(&self.view.basis, self.copies[copy].0, v);
        subject.lit_scene.environment.radiance(DVec3::ZERO, turned(direction), turned(fan))
    }

    /// Paints the light in `seen`, in as many parts as the drift of the beam requires.
    fn paint(&mut self, beam: &SharedBeam, inside: &Inside, copy: usize) {
        let (picture, group) = (self.picture, &beam.group);
        let of = |seen: &SeenLight| colour(&picture.response(&seen.waves), seen.light);
        let whole: DVec3 = self.seen.iter().map(of).sum();
        if whole == DVec3::ZERO {
            return;
        }
        let slant = |k: usize| beam.entry.slant(picture.media[k].index);
        let reach = (slant(group.start).slant - slant(group.end - 1).slant).abs();
        let drift = beam.outline.iter().map(|c| c.drift.length_squared()).fold(0.0, f64::max).sqrt();
        let pixels = self.copies[copy].1.matrix2.x_axis.length();
        let change = whole.abs().max_element() / picture.passes * drift * reach * pixels;
        let times = ((change / (8.0 * MOST_AT_EDGE)).sqrt().ceil() as usize).clamp(1, group.len());
        let mut first = 0;
        for time in 0..times {
            let border = |time: usize| group.start + group.len() * time / times;
            let waves = border(time)..border(time + 1);
            while first < self.seen.len() && self.seen[first].waves.end <= waves.start {
                first += 1;
            }
            self.paint_some(beam, inside, copy, (first, &waves));
        }
    }

    /// Paints the light of some wavelengths, which begins in `seen` at the index `first`.
    fn paint_some(
        &mut self,
        beam: &SharedBeam,
        inside: &Inside,
        copy: usize,
        (first, waves): (usize, &Range<usize>),
    ) {
        let picture = self.picture;
        let (mut moment, mut sum) = (0.0, 0.0);
        for (common, seen) in self.common(first, waves) {
            let strength = colour(&picture.response(&common), seen.light).abs().element_sum();
            (sum, moment) = (sum + strength, moment + strength * picture.middle_index(&common));
        }
        if sum <= 0.0 {
            return;
        }
        let slant = beam.entry.slant(moment / sum);
        let change = slant.slant - beam.slant.slant;
        let size = MovingSize::new(beam, change);
        self.polygon.clear();
        self.polygon.extend(beam.outline.iter().map(|corner| corner.after(change)));
        // Where corners have passed one another, the polygon is painted negatively, because other beams are too large
        // by its area.
        let sign = if area(&self.polygon) < 0.0 { -1.0 } else { 1.0 };
        if sign < 0.0 {
            self.polygon.reverse();
        }
        if picture.is_clear {
            let whole: DVec3 = self
                .common(first, waves)
                .map(|(common, seen)| {
                    let size = size.at(beam, picture.middle_index(&common));
                    colour(&picture.response(&common), seen.light) * size
                })
                .sum();
            self.patches.put(&self.polygon, &self.copies[copy].1, (whole * sign).extend(0.0));
            return;
        }
        let path = inside.path(&beam.slant, &slant);
        self.sizes.clear();
        self.sizes.extend(waves.clone().map(|k| size.at(beam, picture.media[k].index)));
        self.paint_absorbed(copy, path, sign, (first, waves));
    }

    /// Returns the parts of some wavelengths whose light was looked up together, with that light. It begins in `seen` at the
    /// index `first`.
    fn common(&self, first: usize, waves: &Range<usize>) -> impl Iterator<Item = (Range<usize>, &SeenLight)> {
        let (start, end) = (waves.start, waves.end);
        let some = self.seen[first..].iter().take_while(move |seen| seen.waves.start < end);
        some.map(move |seen| (seen.waves.start.max(start)..seen.waves.end.min(end), seen))
    }

    /// Paints the polygon in the colour of light that is absorbed along the paths to its points.
    fn paint_absorbed(
        &mut self,
        copy: usize,
        path: Affine,
        sign: f64,
        (first, waves): (usize, &Range<usize>),
    ) {
        let Self { picture, seen, polygon, patches, copies, sizes, .. } = self;
        let media = &picture.media;
        let middle = media[waves.start + waves.len() / 2];
        let is_even = media[waves.clone()].iter().all(|m| m.absorption[0] == m.absorption[1]);
        let polarisations: &[usize] = if is_even { &[0] } else { &[0, 1] };
        for &which in polarisations {
            let half = sign / polarisations.len() as f64;
            let own = Medium { absorption: [middle.absorption[which]; 2], ..middle };
            strips(polygon, path, &own, UNEVEN, |part, left| {
                let centre = part.iter().sum::<DVec2>() / part.len().max(1) as f64;
                let length = path.at(centre).max(0.0);
                let mut whole = DVec3::ZERO;
                for seen in seen[first..].iter().take_while(|seen| seen.waves.start < waves.end) {
                    let common = seen.waves.start.max(waves.start)..seen.waves.end.min(waves.end);
                    for (k, medium) in common.clone().zip(&media[common]) {
                        let more = medium.absorption[which] - own.absorption[0];
                        let share = sizes[k - waves.start] * (-more * length).exp();
                        whole += colour(&picture.response(&(k..k + 1)), seen.light) * share;
                    }
                }
                patches.put(part, &copies[copy].1, (whole * left * half).extend(0.0));
            });
        }
    }
}
