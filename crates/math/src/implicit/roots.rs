//! Where rays enter and leave a shape, found by Newton's method on bounds of its function, so that it approaches a root from
//! one side and passes none.
//!
//! Along a ray the function of a convex form is convex. The function of a plate is the body's function, which is convex and
//! never steeper than 1, at the point with the shear undone. This point moves along a curve whose second derivative is no
//! more than m.
//!
//! On the way in: after a step s the curve is no more than m s²/2 from its tangent, so the function differs by no more than
//! this from its value on the tangent. The tangent to the body's function less m s²/2 is therefore a lower bound, and a step
//! to its root stays outside.
//!
//! On the way out: the curve bends along z alone, so it is no farther from the middle than its tangent and m s²/2 more. The
//! function at this farther point is convex in s and an upper bound, so a step up to its far root stays inside. Newton's
//! method approaches this root from beyond. Once the bound has come down to a part of the depth of the start, a chord leads
//! to a point before the root.
//!
//! Near the root either step is Newton's. A start on the surface needs no other care: the root that it is on is never the
//! far one.

use super::ImplicitSurface;
use glam::DVec3;

/// The most steps to a root; a ray that needs more is given up.
///
/// Convex forms take two to nine steps on average and 27 at most; the way out of a plate takes some twenty-five. A ray that
/// touches a wave from inside to the last digit may need more, because the bound is far from the function there.
pub(super) const MOST_STEPS: u32 = 1000;

/// A point counts as on the surface where the function is no more than this part of how far coordinates and distances go:
/// some roundings.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The search is near the root of a bound where the bound's value is no more than this part of the start's depth.
const NEAR: f64 = 0.5;

impl ImplicitSurface {
    /// Returns the distance along a line of its point nearest to the origin, and how far from there the shape can reach at
    /// most.
    ///
    /// `None` where the line misses the ball around the shape, or has no direction.
    fn span(&self, o: DVec3, v: DVec3) -> Option<(f64, f64)> {
        let squared = v.length_squared();
        let nearest = -o.dot(v) / squared;
        let reach = self.reach();
        let meets = (o + v * nearest).length_squared() <= reach * reach;
        meets.then(|| (nearest, reach / squared.sqrt()))
    }

    /// Does the work of [`entry`](Self::entry), and adds up the steps.
    pub(super) fn way_in(&self, o: DVec3, v: DVec3, steps: &mut u32) -> Option<f64> {
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
            // The root of value + slope s - bend s²/2; infinite or NaN where a convex form lies behind.
            let value = value.max(0.0);
            let root = (slope * slope + 2.0 * bend * value).sqrt();
            let step = if slope < 0.0 { 2.0 * value / (root - slope) } else { (slope + root) / bend };
            let next = t + step;
            if next.is_nan() || next > nearest + half {
                return None;
            }
            t = next;
        }
        None
    }

    /// Does the work of [`exit`](Self::exit), and adds up the steps.
    pub(super) fn way_out(&self, o: DVec3, v: DVec3, steps: &mut u32) -> Option<f64> {
        let bend = self.wave.map_or(0.0, |wave| wave.most_bend(v));
        let mut t = 0.0;
        while *steps < MOST_STEPS {
            *steps += 1;
            let (p, along) = self.tangent(o + v * t, v);
            let (value, slope) = self.body.along(p, along);
            if value >= -ROUNDING * self.reach() && slope >= 0.0 {
                return Some(t);
            }
            t += self.far_step((p, along), (value, slope), bend, steps)?.max(0.0);
            if bend == 0.0 {
                return Some(t);
            }
        }
        None
    }

    /// Returns a step along a line from `p` that does not pass the far root of the upper bound; `None` where there is no
    /// such root.
    ///
    /// At `p` the body's function has this value and slope. The bound is the function's value at the point that is off the
    /// line by `bend` s²/2 along z, away from the middle. Without bend, the step leads to the root itself.
    fn far_step(
        &self,
        (p, along): (DVec3, DVec3),
        (value, slope): (f64, f64),
        bend: f64,
        steps: &mut u32,
    ) -> Option<f64> {
        // A start that rounding has put outside counts as on the surface: a ray that enters at a grazing angle would miss
        // from there.
        let (level, depth) = (value.max(0.0), -value.min(0.0));
        let squared = along.length_squared();
        let beyond = self.body.reach() / squared.sqrt() - p.dot(along) / squared;
        // The bound is above 0 beyond each of three places: where the line leaves the ball around the body, where the offset
        // along z alone leads out of the body, and where the tangent at the start reaches 0.
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
            if slope.is_nan() || slope <= 0.0 {
                return None;
            }
            s -= value / slope;
        }
        None
    }

    /// Returns a point and a direction of the line with the shear undone: a point of the curve and the tangent there.
    #[inline]
    fn tangent(&self, p: DVec3, v: DVec3) -> (DVec3, DVec3) {
        let Some(wave) = &self.wave else { return (p, v) };
        let (height, rise) = wave.rise(p);
        (p - DVec3::Z * height, v - DVec3::Z * rise.dot(v))
    }
}
