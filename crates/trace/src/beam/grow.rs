//! Grows the tree of beams, strongest first, until little enough light is unresolved.
//!
//! A beam never has more energy than its parent. So the strongest beams are followed first if all beams above a level
//! of energy are followed and the level is then lowered. Within one level every beam can be followed on its own, in
//! any order and on any core, with the same result.

use super::blocks::Blocks;
use super::effort::BeamEffort;
use super::follow::{Flight, Follower, Front, SLIVER, attenuated};
use super::split::{Facets, Ray};
use super::sums::{BeamAdder, BeamSums, Standing};
use super::tree::{BeamExit, BeamLoss, BeamNode, Beams, ROOT, TreeSize};
use crate::coherency::{Coherency, s_axis};
use brillianteer_base::{Stopped, Watch};
use brillianteer_math::{Affine, Basis, Plane, Polytope, Symmetry, area, clip};
use brillianteer_optics::{fresnel, reflect, refract};
use brillianteer_scene::{Medium, Scope, View};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// The limits up to which beams are followed, and the effects that are included.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BeamOptions {
    /// The share of the light, 0 to 1, that may stay unresolved. Tracing ends when no more than this is unresolved.
    pub unresolved: f64,
    /// True where polarisation is followed; otherwise every surface meets unpolarised light.
    pub polarised: bool,
    /// The number of beams soon after which tracing stops, even if more light is unresolved than requested.
    pub most_beams: usize,
    /// The memory, bytes, soon after which tracing stops as well: that of all beams that are kept, of the light that still
    /// waits to be followed, and of what measures and pictures compute of each beam that is kept. It is counted, not
    /// measured, so that the result is the same on every machine.
    #[serde(default = "usual_memory")]
    pub most_bytes: usize,
    /// True where only one domain of the symmetry that stone, view and light share is traced.
    pub symmetry: bool,
}

impl Default for BeamOptions {
    fn default() -> Self {
        let most_bytes = usual_memory();
        Self { unresolved: 1e-3, polarised: true, most_beams: 6_000_000, most_bytes, symmetry: true }
    }
}

impl BeamOptions {
    /// Returns the same options with a part of the memory: one `parts`-th.
    pub fn with_part_of_memory(self, parts: usize) -> Self {
        Self { most_bytes: self.most_bytes / parts.max(1), ..self }
    }
}

/// Returns the usual limit of the memory of beams, bytes. With it, a program stays below 500 MB.
fn usual_memory() -> usize {
    384 << 20
}

/// The memory that measures and pictures compute of each beam, bytes: the directions of two colours, the strongest exits, and
/// sums.
const OF_READERS: usize = 120;

/// The most reflections of a beam, which is given up after them, because total reflection can keep light inside for
/// ever.
pub(super) const MOST_BOUNCES: u32 = 1000;

/// The number of beams in one piece of work. It does not depend on the number of cores, because the result must not.
const PIECE: usize = 128;

/// The number of pieces between two checks of `watch`, of the number of beams and of their memory.
const AT_ONCE: usize = 64;

/// The number of pieces per thread that are computed before they are added to the tree. With more, threads wait less
/// for each other; with fewer, less memory is needed beside the tree.
const PIECES_A_THREAD: usize = 8;

/// The memory of a tree for each piece that is computed before it is added, bytes. A piece grows to about a quarter of that, so
/// all of them take no more than a quarter of the memory of the tree, however many threads there are.
const BYTES_FOR_A_PIECE: usize = 4 << 20;

/// The number of pieces that are computed together even with little memory.
const FEWEST_PIECES: usize = 4;

/// The least and the greatest factor by which the level of energy falls in a step. With a smaller factor, the last
/// step might overshoot.
const STEPS: std::ops::RangeInclusive<f64> = 0.25..=0.8;

/// Where beams are summed up, beams that were split are dropped as soon as there are more of them than this, and more
/// than half as many as wait to be split.
const SPLIT_KEPT: usize = 1 << 14;

/// The part of the light that is assumed to be left in the end, for the display of progress where another rule ends
/// the work.
const FORESEEN: f64 = 1e-2;

/// The factor by which the level of energy falls in a step where [`BeamEffort`] decides
/// the end.
const EFFORT_STEP: f64 = 0.6;

/// Follows light from the eye into a stone until at most `options.unresolved` of it is left.
///
/// Tracing ends earlier where there are too many beams, or where total reflection keeps all remaining light inside;
/// [`Beams::unresolved`] returns how much is left. Beams consist of parallel rays: a perspective is traced as if its
/// eye were far away.
///
/// # Errors
/// [`Stopped`] when `watch` asks to stop.
pub fn trace(
    polytope: &Polytope,
    medium: Medium,
    view: &View,
    options: &BeamOptions,
    watch: Watch,
) -> Result<Beams, Stopped> {
    let facets = Facets::new(polytope);
    let mut tracer = Tracer::new(polytope, &facets, medium, view, options);
    tracer.run(options, None, watch)?;
    for front in &tracer.fronts {
        tracer.beams.nodes[front.node].open = true;
    }
    Ok(tracer.beams)
}

/// Returns the energy down to which beams must be followed to satisfy `options`: the last level above which no more
/// than `most_beams` are followed.
///
/// # Errors
/// [`Stopped`] when `watch` asks to stop.
pub(super) fn level_for(
    polytope: &Polytope,
    medium: Medium,
    view: &View,
    options: &BeamOptions,
    watch: Watch,
) -> Result<f64, Stopped> {
    let facets = Facets::new(polytope);
    let mut tracer = Tracer::new(polytope, &facets, medium, view, options);
    tracer.run(options, None, watch)?;
    Ok(tracer.level)
}

/// Follows all light for this many reflections, however weak it is, so that stones that differ slightly have the same
/// beams.
pub fn trace_bounces(
    polytope: &Polytope,
    medium: Medium,
    view: &View,
    options: &BeamOptions,
    most: u32,
) -> Beams {
    let facets = Facets::new(polytope);
    let mut tracer = Tracer::new(polytope, &facets, medium, view, options);
    let all = BeamOptions { most_beams: usize::MAX, most_bytes: usize::MAX, ..*options };
    let is_in = |energy: f64, bounces: u32| energy > 0.0 && bounces < most;
    let _ = tracer.follow_all(is_in, &all, &|| ControlFlow::Continue(()));
    tracer.beams
}

/// The options for sums over beams that are not kept.
#[derive(Debug, Clone, Copy)]
pub struct SumOptions<'a> {
    /// The scope whose bands the light is summed up by.
    pub scope: &'a Scope,
    /// The standard error that rays must reach in their estimate of the light that beams leave; `None` where nothing
    /// is estimated. With it, beams are followed until those rays take less time than more beams would.
    pub standard_error: Option<f64>,
}

/// The sums over all beams, and the beams that were not split further. No others are kept.
pub struct SummedBeams {
    /// The sums over all beams.
    pub sums: BeamSums,
    /// The scope whose bands the beams were summed up by.
    pub scope: Scope,
    /// The beams that were too weak to be followed, as sorted in the tree.
    pub open: Beams,
    /// The fronts of the open beams, from which their light goes on.
    pub(crate) fronts: Vec<Front>,
    /// The strongest exits known so far, one for each open beam.
    pub(crate) standings: Vec<Standing>,
}

/// Follows light as [`trace`] does and sums it up, but keeps no beam that was split.
///
/// # Errors
/// [`Stopped`] when `watch` asks to stop.
pub fn sum_up(
    polytope: &Polytope,
    medium: Medium,
    view: &View,
    options: &BeamOptions,
    of: SumOptions,
    watch: Watch,
) -> Result<SummedBeams, Stopped> {
    let facets = Facets::new(polytope);
    let mut tracer = Tracer::new(polytope, &facets, medium, view, options);
    let mut adder = BeamAdder::new(&tracer.beams, of.scope);
    adder.take_in(&tracer.beams);
    tracer.adder = Some(&mut adder);
    tracer.run(options, of.standard_error.map(BeamEffort::to), watch)?;
    tracer.drop_split(&mut []);
    let Tracer { fronts, beams: open, .. } = tracer;
    Ok(SummedBeams {
        sums: adder.finish(&open),
        scope: of.scope.clone(),
        open,
        fronts,
        standings: adder.into_standings(),
    })
}

struct Tracer<'a> {
    polytope: &'a Polytope,
    facets: &'a Facets<'a>,
    beams: Beams,
    fronts: Vec<Front>,
    /// The number of beams that were made, including those that are no longer kept.
    made: usize,
    /// The energy above which all beams have been followed.
    level: f64,
    /// The adder of the beams, where they need not be kept.
    adder: Option<&'a mut BeamAdder>,
    /// The followers, each of which works on one piece at a time.
    followers: Vec<Follower<'a>>,
    /// The most pieces that are computed before they are added to the tree.
    most_pieces: usize,
}

impl<'a> Tracer<'a> {
    fn new(
        polytope: &'a Polytope,
        facets: &'a Facets<'a>,
        medium: Medium,
        view: &View,
        options: &BeamOptions,
    ) -> Self {
        let (basis, zenith) = (view.basis(), view.zenith());
        let symmetry =
            if options.symmetry { Symmetry::of(polytope.planes(), &basis, zenith) } else { Symmetry::NONE };
        let beams = Beams {
            view: basis,
            zenith,
            symmetry,
            medium,
            polarised: options.polarised,
            silhouette_area: polytope.silhouette_area(basis.toward),
            dropped: 0.0,
            is_cut_short: false,
            nodes: Blocks::default(),
            corners: vec![],
            exits: Blocks::default(),
            losses: Blocks::default(),
        };
        let mut tracer = Self {
            polytope,
            facets,
            beams,
            fronts: vec![],
            made: 0,
            level: f64::INFINITY,
            adder: None,
            followers: vec![],
            most_pieces: (options.most_bytes / BYTES_FOR_A_PIECE).max(FEWEST_PIECES),
        };
        tracer.enter();
        tracer
    }

    /// Starts a beam on every facet that the eye sees in one domain of the symmetry.
    fn enter(&mut self) {
        let domain = self.beams.symmetry.domain();
        let mut spare = vec![];
        for (i, facet) in self.polytope.facets().iter().enumerate() {
            let cos_i = facet.plane.normal.dot(self.beams.view.toward);
            if cos_i <= 0.0 {
                continue;
            }
            let mut outline: Vec<DVec2> =
                self.polytope.corners(facet).map(|c| self.beams.view.project(c)).collect();
            for &half in &domain {
                clip(&outline, half, &mut spare);
                std::mem::swap(&mut outline, &mut spare);
            }
            let area = area(&outline);
            if area > SLIVER * self.beams.silhouette_area {
                self.enter_facet(i as u32, cos_i, &outline, area);
            }
        }
        self.made = self.beams.len();
    }

    fn enter_facet(&mut self, facet: u32, cos_i: f64, outline: &[DVec2], area: f64) {
        let view = self.beams.view;
        let plane = self.polytope.facets()[facet as usize].plane;
        let eta = 1.0 / self.beams.medium.index;
        let surface = fresnel(cos_i, eta);
        let (light, glare) = Coherency::entered(&surface);
        let light = if self.beams.polarised { light } else { light.unpolarised() };
        let cosines = (cos_i, surface.cos_t_or_zero());
        let direction = refract(-view.toward, plane.normal, eta, cosines);
        let TreeSize { nodes: id, corners, exits: exit } = self.beams.size();
        let node = BeamNode {
            parent: ROOT,
            facet,
            corners: (corners, outline.len() as u32),
            area,
            onward: light.weight(),
            path: Affine::default(),
            exit,
            open: false,
        };
        self.beams.nodes.extend(&[node]);
        self.beams.corners.extend_from_slice(outline);
        let reflected = reflect(-view.toward, plane.normal, cos_i);
        self.beams.exits.extend(&[BeamExit { direction: reflected, weight: glare }]);
        if !self.beams.medium.is_clear() {
            self.beams.losses.extend(&[BeamLoss::NONE]);
        }
        let ray = Ray { origin: entry_points(&view, &plane), direction };
        let s = s_axis(direction, plane.normal, view.right);
        let flight =
            Flight { ray, light, s, left: attenuated(outline, Affine::default(), &self.beams.medium) };
        let energy = light.weight() * area;
        self.fronts.push(Front { node: id, bounces: 0, energy, flight: Box::new(flight) });
    }

    fn run(
        &mut self,
        options: &BeamOptions,
        mut effort: Option<BeamEffort>,
        watch: Watch,
    ) -> Result<(), Stopped> {
        let whole = self.beams.silhouette_area / f64::from(self.beams.symmetry.order());
        let goal = options.unresolved.max(0.0) * whole;
        let mut level = whole / 64.0;
        let mut before = (level, whole);
        loop {
            let left = self.fronts.iter().map(|f| f.energy).sum::<f64>() + self.beams.dropped;
            // The light left falls about as a power of the level, so its logarithm falls evenly.
            let done = ((left / whole).ln() / options.unresolved.clamp(1e-12, FORESEEN).ln()).clamp(0.0, 1.0);
            if watch(done).is_break() {
                return Err(Stopped);
            }
            let movable = self.fronts.iter().any(|f| f.bounces < MOST_BOUNCES && f.energy > 0.0);
            let is_enough = effort.as_mut().is_none_or(|e| e.suffices(self.made, left / whole));
            if left <= goal && is_enough || !movable || self.is_full(options, 0) {
                self.beams.is_cut_short = left > goal && movable;
                break;
            }
            level =
                if left <= goal { level * EFFORT_STEP } else { next_level(level, left, &mut before, goal) };
            let strong = |energy: f64, bounces: u32| energy >= level && bounces < MOST_BOUNCES;
            self.follow_all(strong, options, &|| watch(done))?;
            if !self.is_full(options, 0) {
                self.level = level;
            }
        }
        Ok(())
    }

    /// Returns whether there are too many beams, or they take too much memory. `others` is the number of fronts that wait
    /// besides those of the tracer.
    fn is_full(&self, options: &BeamOptions, others: usize) -> bool {
        let fronts = (self.fronts.len() + others) * (size_of::<Front>() + size_of::<Flight>());
        let readers = if self.adder.is_some() { 0 } else { self.beams.len() * OF_READERS };
        self.made > options.most_beams || self.beams.bytes() + fronts + readers > options.most_bytes
    }

    /// Follows every beam that `strong` accepts by its energy and its number of bounces, and all beams into which it
    /// splits, until there are too many beams.
    fn follow_all(
        &mut self,
        strong: impl Fn(f64, u32) -> bool + Copy + Sync,
        options: &BeamOptions,
        watch: &impl Fn() -> ControlFlow<()>,
    ) -> Result<(), Stopped> {
        // Pieces that grew too large leave strong fronts behind, which come in the next round.
        loop {
            let go: Vec<Front> = self.fronts.extract_if(.., |f| strong(f.energy, f.bounces)).collect();
            let mut go = go.into_iter();
            if go.as_slice().is_empty() {
                return Ok(());
            }
            while !go.as_slice().is_empty() && !self.is_full(options, go.len()) {
                if watch().is_break() {
                    return Err(Stopped);
                }
                let batch: Vec<Front> = go.by_ref().take(AT_ONCE * PIECE).collect();
                self.follow(&batch, strong);
                let waiting = self.fronts.len() + go.len();
                if self.beams.len() > waiting + waiting / 2 + SPLIT_KEPT {
                    self.drop_split(go.as_mut_slice());
                }
            }
            self.fronts.extend(go);
            if self.is_full(options, 0) {
                return Ok(());
            }
        }
    }

    /// Follows these beams, and the beams into which they split, while `strong` accepts the energy and the number of
    /// bounces and no piece of work becomes too large.
    fn follow(&mut self, fronts: &[Front], strong: impl Fn(f64, u32) -> bool + Copy + Sync) {
        let pieces = (rayon::current_num_threads() * PIECES_A_THREAD).min(self.most_pieces);
        for part in fronts.chunks(pieces * PIECE) {
            let pieces = part.len().div_ceil(PIECE);
            while self.followers.len() < pieces {
                self.followers.push(Follower::new(self.facets));
            }
            let (before, followers) = (&self.beams, self.followers.par_iter_mut());
            let work = |(piece, follower): (&[Front], &mut Follower)| follower.follow(before, piece, strong);
            part.par_chunks(PIECE).zip(followers).for_each(work);
            self.take_in(pieces);
        }
    }

    /// Adds the beams that the last pieces of work have found to the tree. Each piece has numbered its nodes from the
    /// end of the former tree; they are moved behind the nodes of the pieces that were added before it.
    fn take_in(&mut self, pieces: usize) {
        let base = self.beams.size();
        for follower in &mut self.followers[..pieces] {
            let growth = &mut follower.growth;
            let shift = self.beams.extend(&mut growth.beams, base);
            growth.left.iter_mut().filter(|f| f.node >= base.nodes).for_each(|f| f.node += shift);
            self.beams.dropped += growth.dropped;
            self.fronts.append(&mut growth.left);
        }
        self.made += self.beams.len() - base.nodes as usize;
        if let Some(adder) = &mut self.adder {
            adder.take_in(&self.beams);
        }
    }

    /// Drops all beams except those of the fronts, which include `others`, and numbers them anew. It does so only
    /// where the beams are added up.
    fn drop_split(&mut self, others: &mut [Front]) {
        let Some(adder) = &mut self.adder else { return };
        let mut fronts: Vec<&mut Front> = self.fronts.iter_mut().chain(others).collect();
        // Both parts are sorted already, which this sort exploits.
        fronts.sort_by_key(|front| front.node);
        let ids: Vec<u32> = fronts.iter().map(|front| front.node).collect();
        adder.keep(&ids, &self.beams);
        self.beams.keep(&ids);
        (0..).zip(fronts).for_each(|(id, front)| front.node = id);
    }
}

/// Returns the next level of energy. The light left falls about as a power of the level. The power is taken from the
/// last step, and the level is chosen slightly below the goal.
fn next_level(level: f64, left: f64, before: &mut (f64, f64), goal: f64) -> f64 {
    let (old_level, old_left) = std::mem::replace(before, (level, left));
    let power = ((old_left / left).ln() / (old_level / level).ln()).clamp(0.3, 2.0);
    let power = if power.is_finite() { power } else { 0.5 };
    level * (0.98 * goal / left).powf(1.0 / power).clamp(*STEPS.start(), *STEPS.end())
}

/// Returns the points of a plane that lie behind the points of the image: the point behind the image's origin, and
/// its changes along the image's axes.
pub(super) fn entry_points(view: &Basis, plane: &Plane) -> [DVec3; 3] {
    let per = view.toward / plane.normal.dot(view.toward);
    let behind = |axis: DVec3| axis - per * plane.normal.dot(axis);
    [per * plane.offset, behind(view.right), behind(view.up)]
}
