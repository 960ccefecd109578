//! Tests of the outline, and that the dome's normals have no crease.

use super::*;
use crate::liquid_glass::outline::DomePoint;

/// Panes of all kinds: half sides and the radius of the corners.
const KINDS: [((f64, f64), f64); 8] = [
    ((0.83, 0.5), 0.3),
    ((1.7, 0.5), 0.2),
    ((0.5, 0.9), 0.5),
    ((0.5, 0.5), 0.5),
    ((0.5, 0.5), 0.3),
    ((0.5, 0.53), 0.45),
    ((0.8, 0.5), 0.01),
    ((0.7, 0.5), 0.0),
];

/// Returns the distance of a place from a rectangle whose corners are arcs.
fn from_arcs(half: DVec2, radius: f64, at: DVec2) -> f64 {
    let beyond = at.abs() - (half - radius);
    beyond.max(DVec2::ZERO).length() + beyond.max_element().min(0.0) - radius
}

/// Returns the place of the outline in a direction.
fn border(outline: &PaneOutline, way: DVec2) -> DVec2 {
    let (mut inside, mut outside) = (0.0, outline.half.length());
    for _ in 0..60 {
        let middle = 0.5 * (inside + outside);
        let is_outside = outline.distance(way * middle) > 0.0;
        if is_outside { outside = middle } else { inside = middle }
    }
    way * inside
}

/// Returns the greatest jump of the slope of normals along lines through the inside of a pane: the change of slope from one
/// step to the next, which shrinks with the step where the slope is continuous.
fn jump(half: DVec2, normal: &dyn Fn(DVec2) -> DVec3, step: f64) -> f64 {
    let mut greatest = 0.0_f64;
    // Lines across the diagonals and the axes, and through the middle itself.
    for k in 0..40 {
        let line = DVec2::from_angle(0.161 * f64::from(k));
        let past = line.perp() * (0.011 * f64::from(k % 10));
        let count = (0.8 / step) as i32;
        let inside = (-count / 2..count / 2).map(|t| past + line * (step * f64::from(t)));
        let points: Vec<DVec2> =
            inside.filter(|at| from_arcs(half, 0.5 * half.min_element(), *at) < -0.06).collect();
        for three in points.windows(3).filter(|w| (w[2] - w[0]).length() < 2.5 * step) {
            let [a, b, c] = [normal(three[0]), normal(three[1]), normal(three[2])];
            greatest = greatest.max(((c - b) - (b - a)).length() / step);
        }
    }
    greatest
}

/// The normals of the dome on M. Minkowski's functional of a rectangle with arcs for corners, which has creases.
fn creased(half: DVec2, radius: f64, at: DVec2) -> DVec3 {
    let (sign, at) = (at.signum(), at.abs());
    let inner = half - radius;
    let (distance, outward) = if at.y * half.x <= inner.y * at.x {
        (at.x / half.x, DVec2::X)
    } else if at.x * half.y <= inner.x * at.y {
        (at.y / half.y, DVec2::Y)
    } else {
        let (a, b) = (at.length_squared(), at.dot(inner));
        let k = (b + (b * b - a * (inner.length_squared() - radius * radius)).max(0.0).sqrt()) / a;
        (k.recip(), (at * k - inner).try_normalize().unwrap_or(DVec2::ZERO))
    };
    (outward * sign * distance).extend((1.0 - distance * distance).max(0.0).sqrt())
}

#[test]
fn normals_and_their_slopes_are_continuous_from_the_rim_to_the_middle() {
    for (half, radius) in KINDS {
        let half = DVec2::from(half);
        let outline = PaneOutline::new(half, radius);
        let smooth = |at: DVec2| outline.dome(at).normal;
        let [coarse, fine] = [4e-3, 5e-4].map(|step| jump(half, &smooth, step));
        // The jump is the second derivative times the step, so an eighth of the step has an eighth of it.
        assert!(fine < 0.2 * coarse && fine < 0.05, "{half} {radius}: {coarse} {fine}");
    }
    // The same test finds the creases of a dome over scaled copies of the outline: from the corners, and in the middle.
    for radius in [0.3, 0.1] {
        let half = DVec2::new(0.83, 0.5);
        let old = |at: DVec2| creased(half, radius, at);
        let [coarse, fine] = [4e-3, 5e-4].map(|step| jump(half, &old, step));
        assert!(fine > 0.6 * coarse && fine > 0.5, "{radius}: {coarse} {fine}");
    }
}

#[test]
fn the_dome_is_upright_in_the_middle_and_level_and_square_on_the_outline() {
    for (half, radius) in KINDS {
        let outline = PaneOutline::new(DVec2::from(half), radius);
        assert_eq!(
            outline.dome(DVec2::ZERO),
            DomePoint { distance: 0.0, radial: DVec2::ZERO, normal: DVec3::Z }
        );
        for k in 0..720 {
            let way = DVec2::from_angle((f64::from(k) / 2.0 + 0.1).to_radians());
            let border = border(&outline, way);
            let dome = outline.dome(border);
            assert!((dome.distance - 1.0).abs() < 1e-9, "{k}: the outline is at distance 1");
            assert!(dome.normal.z < 1e-4, "{half:?} {radius} {k}: {}", dome.normal);
            let mut last = 0.0;
            for part in 1..=20 {
                let dome = outline.dome(border * (f64::from(part) / 20.0));
                near(dome.normal.length(), 1.0);
                assert!(dome.distance > last, "the distance grows outward");
                last = dome.distance;
            }
            // A small step along the outline stays on it.
            let along = dome.normal.truncate().perp() * 1e-5;
            if radius > 0.05 {
                assert!(outline.distance(border + along).abs() < 1e-8, "{half:?} {radius} {k}");
            }
        }
        assert_eq!(outline.dome(DVec2::new(9.0, 9.0)).distance, 1.0);
    }
}

#[test]
fn the_outline_has_the_corners_that_are_asked_for() {
    for (half, radius) in KINDS {
        let half = DVec2::from(half);
        let outline = PaneOutline::new(half, radius);
        let away = |k: i32| {
            let border = border(&outline, DVec2::from_angle((f64::from(k) + 0.3).to_radians()));
            from_arcs(half, radius, border)
        };
        let most = (0..360).map(away).fold(0.0_f64, |most, d| most.max(d.abs()));
        assert!(most < 0.025, "{half} {radius}: {most} from arcs");
        let corner = half - (1.0 - std::f64::consts::FRAC_1_SQRT_2) * radius;
        assert!(outline.distance(corner).abs() < 1e-9, "it meets the arc on the corner's diagonal");
        // The law can fail: another radius lies elsewhere.
        assert!(
            outline.distance(half - (1.0 - std::f64::consts::FRAC_1_SQRT_2) * (radius + 0.05)).abs() > 0.01
        );
    }
    let circle = PaneOutline::new(DVec2::splat(0.5), 0.5);
    for k in 0..90 {
        let at = DVec2::from_angle(0.07 * f64::from(k)) * 0.37;
        let ball = (at / 0.5).extend((1.0 - 0.74_f64 * 0.74).sqrt());
        assert!(circle.dome(at).normal.abs_diff_eq(ball, 1e-12), "over a circle the dome is half a ball");
    }
}
