//! Beams that several wavelengths share.
//!
//! Light of all wavelengths is reflected by the same facets at the same angles; it differs only by its refraction
//! where it entered. Let N be the normal of the facet of entry and T = ray − (ray·N) N the part of the eye's ray along it. Inside,
//! light of index n runs along D = −N + σ T, with σ = 1 / (n cos t) and cos t = √(1 − T² / n²), to the unit of depth behind that
//! facet: σ is the [`Slant`]. Each facet k mirrors −N, T and the virtual start E(x) of the ray of image point x, none of which
//! depends on n. So all light meets the plane n_k·x = d_k at the depth h_k(x; σ) = (d_k − n_k·E(x)) / (n_k·D(σ)), and facet k
//! lies before facet j where h_j − h_k > 0. Multiplied by both speeds n·D, which are positive, this is affine in x and in σ. Direction
//! and path of light that leaves follow exactly for each wavelength from σ and the mirrored vectors.
//!
//! Weight and polarisation are carried exactly for the first and the last wavelength of a group; a wavelength between them leaves
//! with a weight on the straight line over the index ([`GroupLight`]). What the line misses is of the second order in the group's
//! range. With one weight for the whole group, pictures were too weak in red and too strong in blue.
//!
//! An outline is exact in the middle of the group, and each corner carries its drift dx/dσ. Wherever a line cuts an outline, corners
//! change sides of the line within the group; where the area of the triangles that they cut off, in pixels (at most 1), times the
//! weight, times the group's part of all wavelengths, exceeds 2·10⁻³, the group is halved, and each half goes on from its own
//! middle. Near total reflection a quarter of the change of the reflectance counts. Outlines of neighbours drift together, so that no
//! light is lost or shown twice: parts that are turned inside out are subtracted.
//!
//! A beam of light c that drifts by s pixels is painted √(c s / (8 · 10⁻³)) times, each time where a part of its group sees it: an
//! edge that is blurred over s/m pixels is off by an eighth of that at most.
//!
//! Beams are followed to an energy that a first trace of the middle wavelength finds: where a 32nd of all wavelengths shares a beam to
//! that energy, else to the same energy of the whole group. The ends are taken together with neighbours in the tree until they hold the light
//! that radiance 1 gives in a fifth of a pixel. One ray goes on from there, absorbed as the clearest wavelength; each exit counts for
//! every wavelength by what its absorption leaves on the same path.

mod group_light;
mod handed_on;
mod moving;
mod slanted_light;

use self::group_light::{EndLight, GroupLight};
pub use self::handed_on::{BeamEnd, Inside, SharedBeam, SharedBeams, SharedExit};
pub use self::moving::MovingCorner;
use self::moving::{MovingBeam, MovingCell, MovingSplitter};
use self::slanted_light::SlantedLight;
pub use self::slanted_light::{EntryFacet, Slant};
use super::follow::SLIVER;
use super::grow::{BeamOptions, MOST_BOUNCES, level_for};
use super::split::Facets;
use crate::coherency::{Coherency, s_axis};
use brillianteer_base::{Stopped, Watch};
use brillianteer_math::{Affine, Basis, Polytope, Symmetry, area, clip};
use brillianteer_optics::{fresnel, reflect, refract};
use brillianteer_scene::{Medium, View};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::ops::Range;

/// The number of beams from which the work is divided among all cores. It does not depend on the number of cores,
/// because the result must not.
const SEEDS: usize = 512;

/// The most rounds of splitting to reach that number of beams.
const MOST_ROUNDS: u32 = 12;

/// The number of seeds whose beams are found before they are handed on.
const SEEDS_AT_ONCE: usize = 64;

/// The part of the progress that is reserved for finding the least energy of beams.
const PART_OF_LEVEL: f64 = 0.1;

/// The square of the cosine of refraction above which reflectance changes little with the wavelength.
const STEADY: f64 = 0.25;

/// The options for sharing beams.
#[derive(Debug, Clone, Copy)]
pub struct SharingOptions {
    /// The limits up to which beams are followed.
    pub beams: BeamOptions,
    /// The most by which sharing one beam may change a pixel, as a part of the light of radiance 1 at all
    /// wavelengths; 0 where each wavelength is traced on its own.
    pub most_change: f64,
    /// The area of a pixel in the stone's units.
    pub pixel: f64,
    /// The share of all wavelengths whose common beams are followed exactly as far as `beams` requires. Beams of
    /// larger groups are followed farther, and those of smaller groups less far, each down to the same energy, summed
    /// over its wavelengths.
    pub usual_part: f64,
}

/// The properties that all shared beams of a picture have in common.
#[derive(Debug, Clone)]
pub struct SharedView {
    /// The image's axes in the stone's frame.
    pub basis: Basis,
    /// The symmetry that stone, view and light share; only one domain of it is traced.
    pub symmetry: Symmetry,
    /// The area of the whole silhouette.
    pub silhouette_area: f64,
}

/// A beam that is still to be followed from its last facet on.
#[derive(Clone)]
struct SharedFront {
    group: (u32, u32),
    /// The place of the front's facet in the chain.
    link: u32,
    bounces: u32,
    entry: EntryFacet,
    light: SlantedLight,
    slant: Slant,
    /// The greatest difference of the group's slants from `slant`, to both sides.
    reach: f64,
    /// The weight and polarisation of the group's light.
    group_light: GroupLight,
    /// The depth of the front's facet behind the facet by which the light entered, at `slant`.
    depth: Affine,
    /// The speed toward the facet, in two parts: that of light that is not slanted, and the part per slant.
    speed: DVec2,
    /// The first of the front's corners, and the one after the last.
    corners: (u32, u32),
}

/// A front with its corners and the facets that it has met, from which a piece of work begins.
struct Seed {
    front: SharedFront,
    corners: Vec<MovingCorner>,
    facets: Vec<u32>,
}

/// The data that stay the same while beams are followed.
struct Common<'a> {
    facets: &'a Facets<'a>,
    polytope: &'a Polytope,
    media: &'a [Medium],
    options: SharingOptions,
    basis: Basis,
    /// The least energy of a beam that is followed, summed over the wavelengths of its group.
    level: f64,
    /// The area below which outlines come from rounding.
    sliver: f64,
}

/// The state of one piece of work that follows shared beams.
struct Sharer<'a> {
    common: &'a Common<'a>,
    splitter: MovingSplitter<'a>,
    stack: Vec<SharedFront>,
    corners: Vec<MovingCorner>,
    /// The facets that beams have met; each entry is the place of the facet before it, and the facet.
    chain: Vec<(u32, u32)>,
}

/// The place that stands for no facet before the first one.
const FIRST_LINK: u32 = u32::MAX;

/// Follows light of several wavelengths from the eye into a stone, down to the energy at which beams of the middle
/// index satisfy `options` if they are absorbed as those of the clearest wavelength. `prepare` makes a container for
/// each piece of work, and `hand_on` receives full containers in order.
///
/// `media` are those of the wavelengths, ordered by index.
///
/// # Errors
/// [`Stopped`] when `watch` asks to stop.
pub fn trace_shared<B: SharedBeams>(
    polytope: &Polytope,
    media: &[Medium],
    view: &View,
    options: &SharingOptions,
    prepare: impl Fn(&SharedView) -> B + Sync,
    mut hand_on: impl FnMut(&SharedView, Vec<B>),
    watch: Watch,
) -> Result<(), Stopped> {
    let Some(middle) = media.get(media.len() / 2) else { return Ok(()) };
    let facets = Facets::new(polytope);
    // Less light is left to follow at the other wavelengths.
    let clearest = Medium { index: middle.index, ..Medium::clearest(media).unwrap_or(*middle) };
    let level = level_for(polytope, clearest, view, &options.beams, &|part| watch(PART_OF_LEVEL * part))?;
    let level = level * (media.len() as f64 * options.usual_part).max(1.0);
    let basis = view.basis();
    let symmetry = if options.beams.symmetry {
        Symmetry::of(polytope.planes(), &basis, view.zenith())
    } else {
        Symmetry::NONE
    };
    let silhouette_area = polytope.silhouette_area(basis.toward);
    let sliver = SLIVER * silhouette_area;
    let shared_view = SharedView { basis, symmetry, silhouette_area };
    let common = Common { facets: &facets, polytope, media, options: *options, basis, level, sliver };
    let mut sharer = Sharer::new(&common);
    let mut first = prepare(&shared_view);
    sharer.enter(&shared_view, &mut first);
    for _ in 0..MOST_ROUNDS {
        if sharer.stack.len() >= SEEDS {
            break;
        }
        for front in std::mem::take(&mut sharer.stack) {
            sharer.step(&front, &mut first);
        }
    }
    first.finish();
    hand_on(&shared_view, vec![first]);
    let seeds = sharer.seeds();
    for (number, some) in seeds.chunks(SEEDS_AT_ONCE).enumerate() {
        let part = (number * SEEDS_AT_ONCE) as f64 / seeds.len() as f64;
        let done = PART_OF_LEVEL + (1.0 - PART_OF_LEVEL) * part;
        let follow = |sharer: &mut Sharer, seed: &Seed| {
            if watch(done).is_break() {
                return Err(Stopped);
            }
            let mut beams = prepare(&shared_view);
            sharer.follow(seed, &mut beams);
            beams.finish();
            Ok(beams)
        };
        let found: Result<_, Stopped> = some.par_iter().map_init(|| Sharer::new(&common), follow).collect();
        hand_on(&shared_view, found?);
    }
    Ok(())
}

impl<'a> Sharer<'a> {
    fn new(common: &'a Common<'a>) -> Self {
        let splitter = MovingSplitter::new(common.facets);
        Self { common, splitter, stack: vec![], corners: vec![], chain: vec![] }
    }

    /// Starts a beam on every facet that the eye sees in one domain of the symmetry.
    fn enter(&mut self, view: &SharedView, beams: &mut impl SharedBeams) {
        let (common, domain) = (self.common, view.symmetry.domain());
        let mut spare = vec![];
        for (i, facet) in common.polytope.facets().iter().enumerate() {
            let cos_i = facet.plane.normal.dot(view.basis.toward);
            if cos_i <= 0.0 {
                continue;
            }
            let mut outline: Vec<DVec2> =
                common.polytope.corners(facet).map(|c| view.basis.project(c)).collect();
            for &half in &domain {
                clip(&outline, half, &mut spare);
                std::mem::swap(&mut outline, &mut spare);
            }
            let area = area(&outline);
            if area <= common.sliver {
                continue;
            }
            let (entry, light) = EntryFacet::new(i as u32, &facet.plane, &view.basis, cos_i);
            let corners: Vec<_> = outline.iter().map(|&at| MovingCorner { at, drift: DVec2::ZERO }).collect();
            let group = 0..common.media.len();
            let slant = entry.slant(common.middle_index(&group));
            beams.take(&SharedBeam {
                group: group.clone(),
                entry: &entry,
                outline: &corners,
                slant,
                area,
                weight: 1.0,
                inside: None,
            });
            let start = self.corners.len() as u32;
            self.corners.extend_from_slice(&corners);
            let link = self.chain.len() as u32;
            self.chain.push((FIRST_LINK, i as u32));
            let front = SharedFront {
                group: (0, 0),
                link,
                bounces: 0,
                entry,
                light,
                slant,
                reach: 0.0,
                group_light: GroupLight::none(slant),
                depth: Affine::default(),
                speed: DVec2::ZERO,
                corners: (start, self.corners.len() as u32),
            };
            self.regroup(&front, group);
        }
    }

    /// Returns the fronts that wait, with all data that are needed to follow them.
    fn seeds(&mut self) -> Vec<Seed> {
        let fronts = std::mem::take(&mut self.stack);
        let seed = |front: SharedFront| Seed {
            corners: self.outline(&front).to_vec(),
            facets: self.facets_to(front.link),
            front,
        };
        fronts.into_iter().map(seed).collect()
    }

    fn outline(&self, front: &SharedFront) -> &[MovingCorner] {
        &self.corners[front.corners.0 as usize..front.corners.1 as usize]
    }

    /// Returns the facets of the chain up to one of its places, beginning with the facet of entry.
    fn facets_to(&self, link: u32) -> Vec<u32> {
        let up = |&link: &u32| Some(self.chain[link as usize].0).filter(|&l| l != FIRST_LINK);
        let mut met: Vec<u32> =
            std::iter::successors(Some(link), up).map(|l| self.chain[l as usize].1).collect();
        met.reverse();
        met
    }

    /// Follows a seed, and every beam into which it splits, while these are strong.
    fn follow(&mut self, seed: &Seed, beams: &mut impl SharedBeams) {
        self.corners.clear();
        self.corners.extend_from_slice(&seed.corners);
        self.chain.clear();
        let links =
            (0..).zip(&seed.facets).map(|(k, &facet)| (if k == 0 { FIRST_LINK } else { k - 1 }, facet));
        self.chain.extend(links);
        let (link, corners) = (self.chain.len() as u32 - 1, (0, self.corners.len() as u32));
        self.stack.push(SharedFront { link, corners, ..seed.front.clone() });
        while let Some(front) = self.stack.pop() {
            // The corners and links of the fronts that still wait were stored before its own.
            self.corners.truncate(front.corners.1 as usize);
            self.chain.truncate(front.link as usize + 1);
            self.step(&front, beams);
        }
    }

    /// Splits one beam among the facets that it lands on, or its group into two.
    fn step(&mut self, front: &SharedFront, beams: &mut impl SharedBeams) {
        let group = front.group.0 as usize..front.group.1 as usize;
        let outline = &self.corners[front.corners.0 as usize..front.corners.1 as usize];
        let astray = self.splitter.split(&MovingBeam {
            light: &front.light,
            slant: front.slant.slant,
            reach: front.reach,
            depth: front.depth,
            outline,
        });
        if group.len() > 1 && self.common.is_changed(front, &group, astray, &self.splitter.cells) {
            let middle = group.start + group.len() / 2;
            self.regroup(front, middle..group.end);
            self.regroup(front, group.start..middle);
            return;
        }
        let cells = std::mem::take(&mut self.splitter.cells);
        for cell in &cells {
            if cell.twice_area > 2.0 * self.common.sliver {
                self.land(front, cell, beams);
            }
        }
        self.splitter.cells = cells;
    }

    /// Processes the landing of a part of a beam on its facet.
    fn land(&mut self, front: &SharedFront, cell: &MovingCell, beams: &mut impl SharedBeams) {
        let (common, normal) = (self.common, cell.normal);
        let (arriving, group_light) =
            front.group_light.landed(&front.light, normal, common.options.beams.polarised);
        let (area, speed) =
            (cell.twice_area / 2.0, DVec2::new(front.light.down.dot(normal), front.light.along.dot(normal)));
        let outline = &self.splitter.corners[cell.corners.0..cell.corners.1];
        let group = front.group.0 as usize..front.group.1 as usize;
        beams.take(&SharedBeam {
            group: group.clone(),
            entry: &front.entry,
            outline,
            slant: front.slant,
            area,
            weight: front.group_light.weight(),
            inside: Some(Inside {
                normal,
                light: front.light,
                arriving,
                depths: [front.depth, cell.depth],
                speed,
            }),
        });
        let weight = group_light.weight();
        let energy = weight * area * common.most_left(&group, front.slant, cell, outline);
        if energy <= 0.0 {
            return;
        }
        let light = front.light.mirrored(&common.polytope.facets()[cell.facet as usize].plane);
        let (bounces, depth, slant) = (front.bounces + 1, cell.depth, front.slant);
        if energy * group.len() as f64 >= common.level && bounces < MOST_BOUNCES {
            self.go_on(SharedFront { bounces, light, group_light, depth, speed, ..front.clone() }, cell);
        } else {
            let outline = outline.iter().map(|corner| corner.at).collect();
            let (coherency, s) = group_light.middle(light.direction(&slant));
            beams.leave(BeamEnd { group, outline, area, slant, weight, energy, coherency, s, light, depth });
        }
    }

    /// Puts a part of the beam that was split last on the stack. `front` still has that beam's link and corners.
    fn go_on(&mut self, mut front: SharedFront, cell: &MovingCell) {
        if !cell.is_whole {
            let start = self.corners.len() as u32;
            self.corners.extend_from_slice(&self.splitter.corners[cell.corners.0..cell.corners.1]);
            front.corners = (start, self.corners.len() as u32);
        }
        self.chain.push((front.link, cell.facet));
        front.link = self.chain.len() as u32 - 1;
        self.stack.push(front);
    }

    /// Puts a beam on the stack for a smaller group of wavelengths, at the middle of that group.
    fn regroup(&mut self, front: &SharedFront, group: Range<usize>) {
        let common = self.common;
        let slant = front.entry.slant(common.middle_index(&group));
        let end = |k: usize| (front.entry.slant(common.media[k].index).slant - slant.slant).abs();
        let reach = if group.len() > 1 { end(group.start).max(end(group.end - 1)) } else { 0.0 };
        let change = slant.slant - front.slant.slant;
        let start = self.corners.len() as u32;
        for k in front.corners.0..front.corners.1 {
            let corner = self.corners[k as usize];
            self.corners.push(MovingCorner { at: corner.after(change), ..corner });
        }
        let speed = |slant: f64| front.speed.x + front.speed.y * slant;
        let depth = match front.bounces {
            0 => front.depth,
            _ => front.depth * (speed(front.slant.slant) / speed(slant.slant)),
        };
        let group_light = self.group_light(front, &group);
        let group = (group.start as u32, group.end as u32);
        let corners = (start, self.corners.len() as u32);
        self.stack.push(SharedFront { group, slant, reach, group_light, depth, corners, ..front.clone() });
    }

    /// Returns the light that goes on from a front for a part of its group. It is new only at wavelengths that were not first
    /// or last in the whole group.
    fn group_light(&self, front: &SharedFront, group: &Range<usize>) -> GroupLight {
        let whole = front.group.0 as usize..front.group.1 as usize;
        let known = &front.group_light;
        let at = |k: usize| match k {
            first if !whole.is_empty() && first == whole.start => known.first,
            last if !whole.is_empty() && last + 1 == whole.end => known.last.unwrap_or(known.first),
            other => self.light_at(front, &front.entry.slant(self.common.media[other].index)),
        };
        GroupLight { first: at(group.start), last: (group.len() > 1).then(|| at(group.end - 1)) }
    }

    /// Returns the light that goes on from a front at a slant.
    fn light_at(&self, front: &SharedFront, slant: &Slant) -> EndLight {
        let (common, entry) = (self.common, &front.entry);
        let polarised =
            |light: Coherency| if common.options.beams.polarised { light } else { light.unpolarised() };
        let eta = 1.0 / slant.index;
        let (entered, _) = Coherency::entered(&fresnel(entry.cos_i, eta));
        let mut light = polarised(entered);
        let mut direction = refract(-common.basis.toward, entry.normal, eta, (entry.cos_i, slant.cos_t));
        let mut s = s_axis(direction, entry.normal, common.basis.right);
        for facet in self.facets_to(front.link).into_iter().skip(1) {
            let normal = common.polytope.facets()[facet as usize].plane.normal;
            let cos_i = direction.dot(normal);
            let own = s_axis(direction, normal, s);
            let arriving = light.turned(s.dot(own), direction.cross(s).dot(own));
            light = polarised(arriving.split(&fresnel(cos_i, slant.index)).0);
            (direction, s) = (reflect(direction, -normal, cos_i), own);
        }
        EndLight { slant: *slant, coherency: light, s }
    }
}

impl Common<'_> {
    /// Returns the refractive index in the middle of a group.
    fn middle_index(&self, group: &Range<usize>) -> f64 {
        0.5 * (self.media[group.start].index + self.media[group.end - 1].index)
    }

    /// Returns the largest share that absorption leaves of the light of any wavelength of a group.
    fn most_left(
        &self,
        group: &Range<usize>,
        slant: Slant,
        cell: &MovingCell,
        outline: &[MovingCorner],
    ) -> f64 {
        let media = &self.media[group.clone()];
        if media.iter().all(Medium::is_clear) {
            return 1.0;
        }
        let centre = outline.iter().map(|c| c.at).sum::<DVec2>() / outline.len() as f64;
        let path = (cell.depth.at(centre) / slant.cos_t).max(0.0);
        media.iter().map(|m| m.transmittance(path)).fold(0.0, f64::max)
    }

    /// Returns whether a beam would change too much if its group shared it. The measures are the area that goes
    /// astray, and the change of reflectance at the facets that it lands on.
    fn is_changed(
        &self,
        front: &SharedFront,
        group: &Range<usize>,
        astray: f64,
        cells: &[MovingCell],
    ) -> bool {
        let SharingOptions { most_change, pixel, .. } = self.options;
        let light = front.group_light.weight() * group.len() as f64 / self.media.len() as f64;
        let most = most_change / light;
        if most >= 1.0 {
            return false;
        }
        if astray / pixel > most || most <= 0.0 {
            return true;
        }
        cells.iter().any(|cell| {
            let part = (0.5 * cell.twice_area / pixel).min(1.0);
            0.25 * part > most && 0.25 * part * self.reflectance_change(front, group, cell.normal) > most
        })
    }

    /// Returns the difference between the reflectances of a facet at the ends of a group. It is computed only near
    /// the angle of total reflection, where it may be large.
    fn reflectance_change(&self, front: &SharedFront, group: &Range<usize>, normal: DVec3) -> f64 {
        let (down, along) = (front.light.down.dot(normal), front.light.along.dot(normal));
        let ends = [group.start, group.end - 1].map(|k| {
            let slant = front.entry.slant(self.media[k].index);
            let cos_i = (down + along * slant.slant) * slant.cos_t;
            (cos_i, slant.index, 1.0 - slant.index * slant.index * (1.0 - cos_i * cos_i))
        });
        let [low, high] = ends.map(|end| end.2);
        if low > STEADY && high > STEADY || low < 0.0 && high < 0.0 {
            return 0.0;
        }
        let [a, b] = ends.map(|(cos_i, index, _)| fresnel(cos_i, index).reflectance());
        (a - b).abs()
    }
}
