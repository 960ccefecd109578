//! The glass shapes that packets of rays meet: the twin of `math/implicit/roots.rs` in f32, in the same frame and
//! unit.
//!
//! Along a line, the function of a convex shape is convex. Where the surface is a plane, a cylinder or a sphere, the
//! square of the function's value plus its radius is a quadratic function of the distance. The root of that function
//! is tried first. Where it leads past the surface, into another piece of it, a step along the tangent is taken
//! instead, which comes nearer without passing the surface. A ray leaves where the opposite ray enters, so no ray
//! meets its own start.
//!
//! A plate with waves is entered as in `roots.rs`. The exit is first sought as if the plate's edges were sharp: its
//! sides are planes, and the distance of its upper and lower face is a function of one variable with a bounded second
//! derivative. Where that exit lies outside the rounded plate, the opposite ray enters from there. So where a ray
//! leaves through the rounded edge and enters again before it reaches the sharp plate's surface, both points are
//! missed. This concerns one ray in thousands, where waves are steep.

mod body;
mod wave;

#[cfg(test)]
mod tests;

use self::body::{PacketBody, PacketJet};
use self::wave::PacketWave;
use super::lanes::{Lanes, Mask, Vectors};
use super::{PacketHit, PacketSurface};
use brillianteer_math::ImplicitSurface;
use pulp::Simd;

/// The greatest number of steps to a root of a convex shape; most rays take two.
const MOST_STEPS: usize = 32;

/// The greatest number of steps to a root of a plate with waves.
const MOST_WAVE_STEPS: usize = 200;

/// A point counts as on the surface if the function is at most this part of the reach, which is some roundings.
const ROUNDING: f32 = 5e-7;

/// Where a ray meets a surface at least this steeply, a step along the tangent improves a point that is almost on the
/// surface.
const STEEP: f32 = 0.02;

/// The least step along a wave, as a part of the reach; rounding would lose a smaller one.
const LEAST_STEP: f32 = 1e-7;

/// The least divisor.
const LEAST: f32 = 1e-30;

/// A glass shape for packets of rays, in girdle radii.
#[derive(Debug, Clone, Copy)]
pub(super) struct PacketShape {
    body: PacketBody,
    wave: Option<PacketWave>,
    reach: f32,
}

/// A line, with distances counted from its point nearest to the origin.
struct Line<S: Simd> {
    from: Vectors<S>,
    direction: Vectors<S>,
    /// The distance of the ray's origin along the line.
    start: Lanes<S>,
}

/// The part of a line where the search takes place, and the lanes that take part in it.
struct Stretch<S: Simd> {
    first: Lanes<S>,
    last: Lanes<S>,
    open: Mask<S>,
}

impl PacketShape {
    /// Converts a shape to single precision.
    pub fn new(surface: &ImplicitSurface) -> Self {
        Self { body: PacketBody::new(surface), wave: PacketWave::new(surface), reach: surface.reach() as f32 }
    }

    #[inline(always)]
    fn line<S: Simd>(&self, origin: Vectors<S>, direction: Vectors<S>) -> Line<S> {
        let o = self.body.own_axes(origin);
        let direction = self.body.own_axes(direction);
        let nearest = -o.dot(direction);
        Line { from: o + direction * nearest, direction, start: -nearest }
    }

    /// Returns the hits of the rays at this place on their lines; an infinite distance where a ray has met nothing.
    #[inline(always)]
    fn met<S: Simd>(&self, line: &Line<S>, at: Lanes<S>) -> PacketHit<S> {
        let normal = self.normal(line.from + line.direction * at);
        let distance = (at - line.start).max(at.all(0.0));
        PacketHit { distance, normal: self.body.shape_axes(normal) }
    }

    #[inline(always)]
    fn normal<S: Simd>(&self, p: Vectors<S>) -> Vectors<S> {
        let Some(wave) = &self.wave else { return self.body.jet(p, p).gradient };
        let wave = wave.at(p);
        let Vectors([x, y, z]) = self.body.jet(Vectors([p[0], p[1], p[2] - wave.height]), p).gradient;
        let sheared = Vectors([x - wave.rise[0] * z, y - wave.rise[1] * z, z]);
        sheared * (x.all(1.0) / sheared.length_squared().sqrt())
    }

    /// Returns the distance at which a line enters a convex shape; infinity where it misses.
    #[inline(always)]
    fn crossing<S: Simd>(&self, from: Vectors<S>, direction: Vectors<S>) -> Lanes<S> {
        let [first, last] = self.body.between(from, direction, 0.0);
        let none = first.all(f32::INFINITY);
        let (tolerance, steep) = (first.all(ROUNDING * self.reach), first.all(-STEEP));
        let (mut t, mut sure, mut found) = (first, first, none);
        let mut open = first.at_most(last);
        let mut is_tried = first.less(first);
        for _ in 0..MOST_STEPS {
            if !open.any() {
                break;
            }
            let PacketJet { value, gradient, change, radius } =
                self.body.jet(from + direction * t, direction);
            let slope = gradient.dot(direction);
            let tangent = t - value / slope;
            let falls = slope.is_negative();
            let is_near = value.at_most(tolerance);
            let is_met = open & falls & is_near & (!is_tried | (-tolerance).at_most(value));
            found = is_met.select(slope.less(steep).select(tangent, t), found);
            open = open & !is_met;

            // (value + radius)² is a quadratic function of the distance within each piece of the surface,
            // approximately so near a torus.
            let is_before = falls & !is_near;
            let (away, sum) = (value + radius, value + radius + radius);
            let turn = slope * radius;
            let square = turn * turn - away * change.dot(direction) * value * sum;
            let root = square.max(value.all(0.0)).sqrt();
            let trial = t + value * sum / (root - away * slope);
            let is_trial = is_before & (-square).at_most(value.all(0.0)) & trial.at_most(last);
            // A trial that has led too far is taken back, and a step along the tangent is taken instead.
            open = open & (is_before | is_tried);
            t = is_trial.select(trial, is_before.select(tangent, sure));
            sure = is_before.select(tangent, sure);
            is_tried = is_trial;
            open = open & t.at_most(last);
        }
        found
    }

    /// Returns the value of the plate's function, and its slope along a line.
    #[inline(always)]
    fn sheared<S: Simd>(&self, wave: &PacketWave, p: Vectors<S>, v: Vectors<S>) -> [Lanes<S>; 2] {
        let wave = wave.at(p);
        let v = Vectors([v[0], v[1], v[2] - (wave.rise[0] * v[0] + wave.rise[1] * v[1])]);
        let jet = self.body.jet(Vectors([p[0], p[1], p[2] - wave.height]), v);
        [jet.value, jet.gradient.dot(v)]
    }

    /// Returns the distances at which lines enter a plate with waves from outside; infinity where they do not.
    #[inline(always)]
    fn way_in<S: Simd>(
        &self,
        wave: &PacketWave,
        from: Vectors<S>,
        v: Vectors<S>,
        stretch: Stretch<S>,
    ) -> Lanes<S> {
        let Stretch { first: mut t, last, mut open } = stretch;
        let zero = t.all(0.0);
        let least = t.all(LEAST_STEP * self.reach);
        let tolerance = t.all(ROUNDING * self.reach);
        let bend = wave.most_bend(v).max(t.all(LEAST));
        let mut found = t.all(f32::INFINITY);
        for _ in 0..MOST_WAVE_STEPS {
            if !open.any() {
                break;
            }
            let [value, slope] = self.sheared(wave, from + v * t, v);
            let falls = slope.is_negative();
            let is_met = open & falls & value.at_most(tolerance);
            // The step is the root of value + slope s - bend s²/2.
            let value = value.max(zero);
            let root = (slope * slope + bend * value * 2.0).sqrt();
            let step = falls.select(value * 2.0, slope + root) / falls.select(root - slope, bend);
            found = is_met.select(t + step, found);
            t = t + step.max(least);
            open = open & !is_met & t.at_most(last);
        }
        found
    }

    /// Returns the distances at which lines would leave the plate if its edges were sharp.
    #[inline(always)]
    fn way_out<S: Simd>(
        &self,
        wave: &PacketWave,
        from: Vectors<S>,
        v: Vectors<S>,
        stretch: Stretch<S>,
    ) -> Lanes<S> {
        let Stretch { first: mut t, last, mut open } = stretch;
        let (zero, half) = (t.all(0.0), self.body.half + self.body.edge);
        let least = t.all(LEAST_STEP * self.reach);
        let near = t.all(-ROUNDING * self.reach);
        let bend = wave.most_bend(v).max(t.all(LEAST));
        for _ in 0..MOST_WAVE_STEPS {
            if !open.any() {
                break;
            }
            let p = from + v * t;
            let wave = wave.at(p);
            let height = p[2] - wave.height;
            let slope = v[2] - (wave.rise[0] * v[0] + wave.rise[1] * v[1]);
            let (up, down) = ((height - half).min(zero), (-height - half).min(zero));
            let step = far_root(up, slope, bend).min(far_root(down, -slope, bend));
            let rises = zero.at_most(slope);
            let is_there = (rises & near.at_most(up)) | (!rises & near.at_most(down));
            let next = (t + is_there.select(step, step.max(least))).min(last);
            t = open.select(next, t);
            open = open & !is_there & next.less(last);
        }
        t
    }

    /// Returns the distance at which a ray leaves a plate with waves.
    #[inline(always)]
    fn leave<S: Simd>(&self, wave: &PacketWave, line: &Line<S>) -> Lanes<S> {
        let Line { from, direction, start } = *line;
        let [_, last] = self.body.between(from, direction, wave.amplitude);
        let (open, none) = (start.less(last), start.all(f32::INFINITY));
        let sharp = self.way_out(wave, from, direction, Stretch { first: start, last, open });
        let [value, _] = self.sheared(wave, from + direction * sharp, direction);
        let is_beyond = open & start.all(ROUNDING * self.reach).less(value);
        let mut at = open.select(sharp, none);
        if is_beyond.any() {
            let back = -direction;
            let there = Stretch { first: -sharp, last: -start, open: is_beyond };
            let edge = -self.way_in(wave, from, back, there);
            at = is_beyond.select((-none).less(edge).select(edge, none), at);
        }
        at
    }
}

/// Returns the positive root of value + slope s + bend s²/2, where the value is 0 or negative.
#[inline(always)]
fn far_root<S: Simd>(value: Lanes<S>, slope: Lanes<S>, bend: Lanes<S>) -> Lanes<S> {
    let root = (slope * slope - bend * value * 2.0).sqrt();
    let falls = slope.is_negative();
    falls.select(root - slope, -(value * 2.0)) / falls.select(bend, (slope + root).max(slope.all(LEAST)))
}

impl PacketSurface for PacketShape {
    #[inline(always)]
    fn entry<S: Simd>(&self, _simd: S, origin: Vectors<S>, direction: Vectors<S>) -> PacketHit<S> {
        let line = self.line(origin, direction);
        let behind = line.start - ROUNDING * self.reach;
        let at = match &self.wave {
            None => self.crossing(line.from, line.direction),
            Some(wave) => {
                let [first, last] = self.body.between(line.from, line.direction, wave.amplitude);
                let first = first.max(line.start);
                let open = first.at_most(last);
                self.way_in(wave, line.from, line.direction, Stretch { first, last, open })
            }
        };
        self.met(&line, behind.at_most(at).select(at, at.all(f32::INFINITY)))
    }

    #[inline(always)]
    fn exit<S: Simd>(&self, _simd: S, origin: Vectors<S>, direction: Vectors<S>) -> PacketHit<S> {
        let line = self.line(origin, direction);
        let at = match &self.wave {
            None => {
                let back = -line.direction;
                let at = self.crossing(line.from, back);
                at.less(at.all(f32::INFINITY)).select(-at, at)
            }
            Some(wave) => self.leave(wave, &line),
        };
        self.met(&line, at)
    }

    #[inline(always)]
    fn turned<S: Simd>(&self, _simd: S, point: Vectors<S>, by: Vectors<S>) -> Option<Vectors<S>> {
        let p = self.body.own_axes(point);
        let by = self.body.own_axes(by);
        let normal = self.normal(p);
        let by = by + normal * -normal.dot(by);
        let Some(wave) = &self.wave else {
            return Some(self.body.shape_axes(self.body.jet(p, by).change));
        };
        let wave = wave.at(p);
        let [x, y] = wave.rise;
        let sheared_by = Vectors([by[0], by[1], by[2] - (x * by[0] + y * by[1])]);
        let PacketJet { gradient, change, .. } =
            self.body.jet(Vectors([p[0], p[1], p[2] - wave.height]), sheared_by);
        let fall = gradient[2];
        let bent = Vectors([
            change[0] - x * change[2] - (wave.bend[0] * by[0] + wave.bend[1] * by[1]) * fall,
            change[1] - y * change[2] - (wave.bend[1] * by[0] + wave.bend[0] * by[1]) * fall,
            change[2],
        ]);
        let sheared = Vectors([gradient[0] - x * fall, gradient[1] - y * fall, fall]);
        let within = bent + normal * -normal.dot(bent);
        Some(within * (x.all(1.0) / sheared.length_squared().sqrt()))
    }
}
