//! Where rays go in and out: Newton's method on bounds that are convex, so that it comes to the root from one side and passes
//! none.
//!
//! Along a ray a convex form's function is convex. A plate's is the body's, convex and never steeper than 1, of a point that
//! moves on a curve whose second derivative is no more than m. So after a step s it differs by no more than m s²/2 from its
//! value on the curve's tangent: less this, and with a tangent to the body's function, it is bounded from below, for a step
//! that stays outside. A curve that is bent along z alone is no farther from the middle than its tangent and m s²/2 more: of
//! that the function is convex, and a step up to its far root stays inside: Newton's method comes to this root from beyond, and
//! where it is near, so much depth as the start has left, a chord leads to a point before it. Either step is Newton's near the
//! root. Nothing else is needed of a start on the surface: the root it is on is never the far one.

use super::ImplicitSurface;
use glam::DVec3;

/// Steps to a root: two to nine on the mean for convex forms, 27 at most, and some twenty-five out of a plate. A ray that touches
/// a wave from inside to the last digit may need more, as there the bound is far from the function: it is given up.
pub(super) const MOST_STEPS: u32 = 1000;

/// A point this near is on the surface, as a part of how far coordinates and distances go: some roundings.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A bound's root is near where the bound is no more than this part of the start's depth.
const NEAR: f64 = 0.5;

impl ImplicitSurface {
    /// As [`entry`](Self::entry), with the steps taken.
    pub(super) fn entry_counted(&self, origin: DVec3, direction: DVec3) -> (Option<f64>, u32) {
        let (o, v) = (self.own(origin), self.turn.inverse() * direction);
        let mut steps = 0;
        let way = self.way_in(o, v, &mut steps);
        (way.map(|t| t * self.scale), steps)
    }

    /// As [`exit`](Self::exit), with the steps taken.
    pub(super) fn exit_counted(&self, point: DVec3, direction: DVec3) -> (Option<f64>, u32) {
        let (o, v) = (self.own(point), self.turn.inverse() * direction);
        let mut steps = 0;
        let way = self.way_out(o, v, &mut steps);
        (way.map(|t| t * self.scale), steps)
    }

    /// Where a line comes nearest to the origin, as a distance on it, and how far beyond this the shape is at most; `None`
    /// where the line misses a ball around it, or is none.
    fn span(&self, o: DVec3, v: DVec3) -> Option<(f64, f64)> {
        let squared = v.length_squared();
        let nearest = -o.dot(v) / squared;
        let reach = self.own_reach();
        let meets = (o + v * nearest).length_squared() <= reach * reach;
        meets.then(|| (nearest, reach / squared.sqrt()))
    }

    fn way_in(&self, o: DVec3, v: DVec3, steps: &mut u32) -> Option<f64> {
        let (nearest, half) = self.span(o, v)?;
        let bend = self.wave.map_or(0.0, |wave| wave.most_bend(v));
        let mut t = (nearest - half).max(0.0);
        while *steps < MOST_STEPS {
            *steps += 1;
            let (p, along) = self.tangent(o + v * t, v);
            let (value, slope) = self.body.along(p, along);
            if value <= ROUNDING * half.max(t) && slope < 0.0 {
                return Some(t);
            }
            // The root of value + slope s - bend s²/2; endless or no number where a convex form is left behind.
            let value = value.max(0.0);
            let root = (slope * slope + 2.0 * bend * value).sqrt();
            let step = if slope < 0.0 { 2.0 * value / (root - slope) } else { (slope + root) / bend };
            let next = t + step;
            // Also where it is no number.
            if next.is_nan() || next > nearest + half {
                return None;
            }
            t = next;
        }
        None
    }

    fn way_out(&self, o: DVec3, v: DVec3, steps: &mut u32) -> Option<f64> {
        let bend = self.wave.map_or(0.0, |wave| wave.most_bend(v));
        let mut t = 0.0;
        while *steps < MOST_STEPS {
            *steps += 1;
            let (p, along) = self.tangent(o + v * t, v);
            let (value, slope) = self.body.along(p, along);
            if value >= -ROUNDING * self.own_reach() && slope >= 0.0 {
                return Some(t);
            }
            t += self.far_step((p, along), (value, slope), bend, steps)?.max(0.0);
            if bend == 0.0 {
                return Some(t);
            }
        }
        None
    }

    /// A distance along a line from `p`, where the body's function has this value and slope, no greater than the greatest at
    /// which it has its value on the surface where the point is off the line by `bend` s²/2 up or down, whichever is farther
    /// from the middle; `None` where there is none. Straight lines are followed to the end.
    fn far_step(
        &self,
        (p, along): (DVec3, DVec3),
        (value, slope): (f64, f64),
        bend: f64,
        steps: &mut u32,
    ) -> Option<f64> {
        // What rounding has put outside is on the surface: a ray that enters at a glance would miss from there.
        let (level, depth) = (value.max(0.0), -value.min(0.0));
        let squared = along.length_squared();
        let beyond = self.body.reach() / squared.sqrt() - p.dot(along) / squared;
        // Farther off, any point is above the body; and so it is above the tangent's.
        let mut s = beyond.min((2.0 * (self.body.half + self.body.edge) / bend).sqrt());
        if slope > 0.0 {
            s = s.min(depth / slope);
        }
        while *steps < MOST_STEPS {
            *steps += 1;
            let on = p + along * s;
            let off = DVec3::Z * bend.copysign(on.z) * s;
            let (value, slope) = self.body.along(on + off * s / 2.0, along + off);
            let value = value - level;
            if value <= ROUNDING * self.body.reach() {
                return Some(s);
            }
            if bend > 0.0 && value < NEAR * depth {
                return Some(s * depth / (depth + value));
            }
            // Also where it is no number.
            if slope.is_nan() || slope <= 0.0 {
                return None;
            }
            s -= value / slope;
        }
        None
    }

    /// A point and a direction with the shear taken back: of the line, its curve's tangent.
    #[inline]
    fn tangent(&self, p: DVec3, v: DVec3) -> (DVec3, DVec3) {
        let Some(wave) = &self.wave else { return (p, v) };
        let (height, rise) = wave.rise(p);
        (p - DVec3::Z * height, v - DVec3::Z * rise.dot(v))
    }
}
