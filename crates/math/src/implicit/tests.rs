//! Laws of the function and of rays; those of volumes, meshes and shadows are in `measures`.

mod measures;

use super::*;
use crate::{Plane, Polytope};
use std::f64::consts::{PI, TAU};

/// Pseudorandom numbers from -1 to 1 (Marsaglia, Xorshift RNGs, 2003).
struct Chance(u64);

impl Chance {
    fn number(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn point(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }

    fn direction(&mut self) -> DVec3 {
        loop {
            let p = self.point();
            if let Some(unit) = p.try_normalize().filter(|_| p.length() < 1.0 && p.length() > 0.1) {
                return unit;
            }
        }
    }
}

fn chance(seed: u64) -> Chance {
    Chance(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
}

fn plate(size: DVec3, edge: f64, amplitude: f64, wavelength: f64) -> ImplicitForm {
    ImplicitForm::Plate { size, edge, amplitude, wavelength, phase: 0.7 }
}

/// Returns every form: sharp, round, as round as possible, and with the demo's own dimensions.
fn forms() -> Vec<ImplicitSurface> {
    let pixels = |x, y, z| DVec3::new(x, y, z) / 200.0;
    let all = [
        ImplicitForm::Pill { size: pixels(400.0, 115.0, 62.0), edge: 0.155 },
        ImplicitForm::Pill { size: pixels(115.0, 400.0, 162.0), edge: 0.1 },
        ImplicitForm::Pill { size: pixels(300.0, 300.0, 300.0), edge: 0.75 },
        ImplicitForm::Pill { size: pixels(400.0, 100.0, 200.0), edge: 0.25 },
        ImplicitForm::Pill { size: pixels(400.0, 100.0, 200.0), edge: 0.0 },
        ImplicitForm::Block { size: pixels(230.0, 230.0, 230.0), edge: 0.22 },
        ImplicitForm::Block { size: pixels(100.0, 230.0, 330.0), edge: 0.0 },
        ImplicitForm::Block { size: pixels(100.0, 230.0, 330.0), edge: 0.25 },
        ImplicitForm::Pane { size: pixels(400.0, 250.0, 48.0), corner: 0.4, edge: 0.12 },
        ImplicitForm::Pane { size: pixels(250.0, 400.0, 60.0), corner: 0.1, edge: 0.1 },
        ImplicitForm::Pane { size: pixels(300.0, 300.0, 60.0), corner: 0.3, edge: 0.0 },
        ImplicitForm::Prism { size: pixels(393.0, 149.0, 117.0), edge: 0.0 },
        ImplicitForm::Prism { size: pixels(400.0, 80.0, 80.0), edge: 0.05 },
        ImplicitForm::Prism { size: pixels(100.0, 300.0, 80.0), edge: 0.1 },
        ImplicitForm::Prism { size: pixels(400.0, 80.0, 240.0), edge: super::profile::inradius(0.4, 1.2) },
        plate(pixels(346.0, 346.0, 60.0), 0.0525, 0.085, 2.675),
        plate(pixels(400.0, 400.0, 100.0), 0.05, 0.1, 1.5),
        plate(pixels(400.0, 300.0, 100.0), 0.0, 0.3, 0.8),
        plate(pixels(400.0, 400.0, 60.0), 0.0525, 0.3, 0.3),
    ];
    all.into_iter().map(|form| ImplicitSurface::new(form).unwrap()).collect()
}

/// Returns rays from around a form, toward it and past it.
///
/// After each ray that hits follows one that grazes: it is almost square to the normal at the place of the hit.
fn rays(field: &ImplicitSurface, count: usize, seed: u64) -> Vec<(DVec3, DVec3)> {
    let mut chance = chance(seed);
    let reach = field.reach();
    let mut rays: Vec<(DVec3, DVec3)> = vec![];
    while rays.len() < count {
        let aim = chance.point() * reach * 0.8;
        let direction = chance.direction();
        let origin = aim - direction * 2.5 * reach;
        rays.push((origin, direction));
        if let Some(t) = field.entry(origin, direction) {
            let point = origin + direction * t;
            let normal = field.normal(point);
            let lean = chance.number().powi(3) * 0.1;
            let along = (normal.any_orthonormal_vector() + normal * lean).try_normalize().unwrap();
            rays.push((point - along * 2.5 * reach, along));
        }
    }
    rays
}

#[test]
fn derivatives_are_those_of_the_function() {
    let mut chance = chance(1);
    let (mut tried, mut apart) = (0, 0);
    // The differences are of fourth order: the terms that they leave out and rounding are both below 1e-10.
    let h = 1e-4;
    for field in forms() {
        for _ in 0..6000 {
            let p = chance.point() * field.reach() * 1.5;
            let jet = field.jet(p);
            for axis in DVec3::AXES {
                let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|s| field.jet(p + axis * (s * h)));
                let slope = (8.0 * (c.value - b.value) - (d.value - a.value)) / (12.0 * h);
                let bend = ((c.gradient - b.gradient) * 8.0 - (d.gradient - a.gradient)) / (12.0 * h);
                tried += 1;
                let room = 1e-7 * (1.0 + (jet.hessian * axis).length());
                let is_same = (slope - jet.gradient.dot(axis)).abs() < room
                    && bend.distance(jet.hessian * axis) < 10.0 * room * (1.0 + bend.length());
                apart += i32::from(!is_same);
            }
        }
    }
    // The two agree except where a crease or the seam of two pieces lies between the points.
    assert!(tried > 250_000 && f64::from(apart) < 0.01 * f64::from(tried), "{apart} of {tried}");
}

#[test]
fn the_function_of_a_convex_form_is_the_distance_from_its_surface() {
    let mut chance = chance(2);
    for field in forms().into_iter().filter(ImplicitSurface::is_convex) {
        for _ in 0..4000 {
            let p = chance.point() * field.reach() * 1.3;
            let jet = field.jet(p);
            assert!((jet.gradient.length() - 1.0).abs() < 1e-12, "{field:?} {p} {jet:?}");
            // The nearest point of the surface lies down the gradient, and no point is nearer than the value says.
            let foot = p - jet.gradient * jet.value;
            assert!(field.value(foot).abs() < 1e-12, "{field:?} {p}");
            let off = chance.direction();
            assert!(field.value(p + off * jet.value.abs()) * jet.value.signum() > -1e-12, "{field:?} {p}");
        }
    }
}

/// Returns where the function changes its sign along a ray, found in even steps, and the value farthest from 0 in the
/// stretch after each.
fn changes(
    field: &ImplicitSurface,
    origin: DVec3,
    direction: DVec3,
    far: f64,
    steps: usize,
) -> Vec<(f64, f64)> {
    let at = |i: usize| field.value(origin + direction * (far * i as f64 / steps as f64));
    let mut found = vec![(0.0, 0.0_f64)];
    let mut last = at(0);
    for i in 1..=steps {
        let value = at(i);
        if (value < 0.0) != (last < 0.0) {
            found.push((far * i as f64 / steps as f64, 0.0));
        }
        if let Some(stretch) = found.last_mut().filter(|s| s.1.abs() < value.abs()) {
            stretch.1 = value;
        }
        last = value;
    }
    found
}

/// Returns the distances at which a ray enters and leaves in turn, and whether it was given up.
fn walk(field: &ImplicitSurface, origin: DVec3, direction: DVec3) -> (Vec<f64>, bool) {
    let mut found = vec![];
    let mut t = 0.0;
    loop {
        let goes_in = found.len() % 2 == 0;
        let from = origin + direction * t;
        let mut steps = 0;
        let step = if goes_in {
            field.way_in(from, direction, &mut steps)
        } else {
            field.way_out(from, direction, &mut steps)
        };
        let Some(step) = step else { return (found, !goes_in || steps >= roots::MOST_STEPS) };
        let stays = t + step <= t && found.len() > 2;
        t += step;
        found.push(t);
        // The ray only touches the surface, to the last digit.
        if stays {
            return (found, true);
        }
    }
}

#[test]
fn rays_go_in_and_out_where_looking_everywhere_says() {
    let (mut crossings, mut looked, mut lost) = (0, 0, 0);
    for (seed, field) in (3..).zip(forms()) {
        for (i, (origin, direction)) in
            rays(&field, if field.is_convex() { 50_000 } else { 12_500 }, seed).into_iter().enumerate()
        {
            let (found, is_lost) = walk(&field, origin, direction);
            lost += i32::from(is_lost);
            assert!(!is_lost || !field.is_convex(), "{field:?} {origin} {direction} {found:?}");
            for (k, &t) in found.iter().enumerate() {
                let p = origin + direction * t;
                let cos = field.normal(p).dot(direction);
                assert!(field.value(p).abs() < 1e-12, "{field:?} {p} {direction}");
                assert!(
                    if k % 2 == 0 { cos < 1e-12 } else { cos > -1e-7 },
                    "{field:?} {p} {direction} {k} {cos}"
                );
            }
            crossings += found.len();
            // The ray is inside between an entry and its exit, and outside elsewhere.
            for (k, pair) in found.windows(2).enumerate() {
                for part in [0.01, 0.3, 0.5, 0.9] {
                    let value = field.value(origin + direction * (pair[0] + (pair[1] - pair[0]) * part));
                    let wrong = if k % 2 == 0 { value } else { -value };
                    assert!(wrong < 1e-13, "{field:?} {origin} {direction} {found:?} {k} {part} {value}");
                }
            }
            if i % 40 > 1 || is_lost {
                continue;
            }
            looked += 1;
            let (far, steps) = (6.0 * field.reach(), 3000);
            let seen = changes(&field, origin, direction, far, steps);
            // Every stretch that even steps show clearly is found. The converse is checked above.
            for stretch in seen.windows(2).filter(|s| s[0].1.abs() > 1e-12 && s[1].1.abs() > 1e-12) {
                let t = stretch[1].0;
                let near = found.iter().any(|f| (f - t).abs() < 2.0 * far / steps as f64);
                assert!(near, "{field:?} {origin} {direction} {t} {found:?} {seen:?}");
            }
        }
    }
    assert!(crossings > 1_000_000 && looked > 40_000, "{crossings} {looked}");
    // Every other ray is made to graze, and a ray may touch a wave from inside to the last digit.
    assert!(lost < 300, "{lost}");
}

#[test]
fn light_reflected_inside_stays_on_the_surface_and_few_ways_are_lost() {
    let (mut lost, mut ways) = (0, 0);
    for (seed, field) in (30..).zip(forms()) {
        for (origin, mut direction) in rays(&field, 2_000, seed) {
            let Some(t) = field.entry(origin, direction) else { continue };
            let mut p = origin + direction * t;
            // The direction is as refracted there, at an index of 2.
            let normal = field.normal(p);
            direction = (direction * 0.5 - normal * 0.5).try_normalize().unwrap();
            for _ in 0..30 {
                ways += 1;
                let Some(t) = field.exit(p, direction) else {
                    lost += 1;
                    break;
                };
                p += direction * t;
                let normal = field.normal(p);
                assert!(field.value(p).abs() < 1e-13, "{field:?} {p} {direction}");
                assert!(direction.dot(normal) > -1e-7, "{field:?} {p} {direction} {t}");
                // A convex form is not met again.
                let again = field.entry(p, direction);
                let cos = direction.dot(normal);
                let touches = cos < 1e-9 || !field.is_convex();
                assert!(touches || again.is_none(), "{field:?} {p} {direction} {again:?}");
                direction -= normal * (2.0 * direction.dot(normal));
            }
        }
    }
    assert!(ways > 400_000 && lost <= 4, "{lost} of {ways}");
}

#[test]
fn a_pill_as_round_as_can_be_is_a_sphere() {
    let sphere = ImplicitSurface::new(ImplicitForm::Pill { size: DVec3::splat(2.0), edge: 1.0 }).unwrap();
    for (o, d) in rays(&sphere, 20_000, 50) {
        let (middle, off) = (-o.dot(d), (o - d * o.dot(d)).length_squared());
        if (1.0 - off).abs() < 1e-4 {
            continue;
        }
        let expected = (off < 1.0).then(|| middle - (1.0 - off).sqrt());
        let found = sphere.entry(o, d);
        assert_eq!(found.is_some(), expected.is_some());
        if let Some((a, b)) = found.zip(expected) {
            let p = o + d * a;
            assert!((a - b).abs() < 1e-12, "{a} {b}");
            assert!((sphere.exit(p, d).unwrap() - 2.0 * (1.0 - off).sqrt()).abs() < 1e-12);
            assert!(sphere.normal(p).distance(p) < 1e-14 * 100.0);
            let across = d.cross(p).cross(p);
            assert!(
                (sphere.bend(p) * across).distance(across) < 1e-12 && (sphere.bend(p) * p).length() < 1e-12
            );
        }
    }
    assert!((sphere.volume() - 4.0 / 3.0 * PI).abs() < 1e-14);
    assert!((sphere.silhouette_area(DVec3::new(0.6, 0.0, 0.8)).unwrap() - PI).abs() < 1e-14);
}

/// Returns where a ray enters and leaves the solid between planes.
fn between(planes: &[Plane], o: DVec3, d: DVec3) -> Option<(f64, f64)> {
    let (mut near, mut far) = (f64::NEG_INFINITY, f64::INFINITY);
    for plane in planes {
        let (speed, t) = (plane.normal.dot(d), -plane.distance(o) / plane.normal.dot(d));
        if speed < 0.0 { near = near.max(t) } else { far = far.min(t) }
    }
    (near < far).then_some((near, far))
}

#[test]
fn sharp_forms_are_the_solids_between_their_planes_and_hardly_rounded_ones_nearly_so() {
    let size = DVec3::new(1.9, 0.8, 0.7);
    let flank = DVec3::new(0.0, size.z, size.y / 2.0);
    let ends = [DVec3::X, -DVec3::X].map(|n| Plane::new(n, size.x / 2.0));
    let sides = [flank, flank * DVec3::new(1.0, -1.0, 1.0)].map(|n| Plane::new(n, size.y * size.z / 4.0));
    let prism = [ends.to_vec(), sides.to_vec(), vec![Plane::new(-DVec3::Z, size.z / 2.0)]].concat();
    let faces = |axis: usize| [1.0, -1.0].map(|s| Plane::new(DVec3::AXES[axis] * s, size[axis] / 2.0));
    let block: Vec<Plane> = (0..3).flat_map(faces).collect();
    let form = |is_prism, edge| {
        if is_prism { ImplicitForm::Prism { size, edge } } else { ImplicitForm::Block { size, edge } }
    };
    for (is_prism, planes) in [(true, prism), (false, block)] {
        let polytope = Polytope::from_planes(&planes).unwrap();
        let planes: Vec<Plane> = polytope.planes().collect();
        let sharp = ImplicitSurface::new(form(is_prism, 0.0)).unwrap();
        let round = ImplicitSurface::new(form(is_prism, 1e-6)).unwrap();
        assert!((sharp.volume() - polytope.volume()).abs() < 1e-14 && sharp.reach() < 2.0);
        let mut both = 0;
        for (o, d) in rays(&sharp, 20_000, 60) {
            let (expected, found) = (between(&planes, o, d), sharp.entry(o, d));
            if let Some((near, far)) = expected.filter(|(near, far)| far - near > 1e-9) {
                both += 1;
                let (t, p) = (found.unwrap(), o + d * found.unwrap());
                let speed = planes.iter().map(|plane| plane.normal.dot(d).abs()).filter(|s| *s > 0.0);
                let room = 1e-14 / speed.fold(1.0, f64::min);
                assert!((t - near).abs() < room, "{o} {d}");
                assert!((sharp.exit(p, d).unwrap() - (far - near)).abs() < room, "{o} {d}");
                let own = planes.iter().filter(|plane| plane.distance(p).abs() < 1e-12);
                assert!(own.map(|plane| plane.normal.distance(sharp.normal(p))).fold(2.0, f64::min) < 1e-15);
                assert_eq!(sharp.bend(p), DMat3::ZERO);
            }
            // Rounding takes no more than twice the edge off the sharpest corner.
            if let Some((near, far)) = expected {
                assert!(
                    round.value(o + d * near).abs() < 3e-6 && round.value(o + d * (near + far) / 2.0) < 3e-6
                );
                let grazes = round.entry(o, d).is_some_and(|t| round.normal(o + d * t).dot(d) > -1e-3);
                assert!(grazes || round.entry(o, d).is_none_or(|t| t > near - 1e-11));
            }
        }
        assert!(both > 5000);
    }
}

#[test]
fn facets_are_told_by_their_faces() {
    for field in forms() {
        let mut seen = vec![0; field.facets().len()];
        for (o, d) in rays(&field, 4000, 80) {
            let Some(t) = field.entry(o, d) else { continue };
            let p = o + d * t;
            let facet = field.facet(p) as usize;
            seen[facet] += 1;
            // A flat face of a convex form does not bend.
            let flat =
                field.is_convex() && field.facets()[facet] != "edge" && field.facets()[facet] != "side";
            assert!(!flat || field.bend(p) == DMat3::ZERO, "{field:?} {p} {facet}");
        }
        // The rounded part of a pane's outline counts as its edge.
        let sharp = field.body.edge == 0.0 && !matches!(field.form, ImplicitForm::Pane { .. });
        let (edge, faces) = seen.split_last().unwrap();
        assert!(
            (*edge > 0) != sharp && faces.iter().all(|n| *n > 0) | (field.body.half == 0.0 || !sharp),
            "{seen:?}"
        );
    }
}

#[test]
fn what_is_no_shape_is_refused_with_what_is_at_fault() {
    let size = DVec3::new(2.0, 1.0, 0.5);
    let told = |form| ImplicitSurface::new(form).unwrap_err();
    for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0, 1e300] {
        let error = told(ImplicitForm::Block { size: DVec3::new(1.0, bad, 1.0), edge: 0.1 });
        assert!(matches!(error, ImplicitSurfaceError::Dimension { name: "the size along y", .. }), "{error}");
        let error = told(plate(size, 0.1, 0.1, bad));
        let wave = matches!(error, ImplicitSurfaceError::Dimension { name: "the wavelength", .. });
        assert!(wave, "{error}");
        if bad != 0.0 {
            let edge = told(ImplicitForm::Pill { size, edge: bad });
            assert!(matches!(edge, ImplicitSurfaceError::Number { name: "the edge's radius", .. }), "{edge}");
            let amplitude = told(plate(size, 0.1, bad, 1.0));
            assert!(
                matches!(amplitude, ImplicitSurfaceError::Number { name: "the amplitude", .. }),
                "{amplitude}"
            );
        }
    }
    assert_eq!(
        told(ImplicitForm::Pill { size, edge: 0.3 }),
        ImplicitSurfaceError::Edge { edge: 0.3, most: 0.25 }
    );
    let pane = |corner, edge| told(ImplicitForm::Pane { size, corner, edge });
    assert_eq!(pane(0.6, 0.1), ImplicitSurfaceError::Edge { edge: 0.6, most: 0.5 });
    assert_eq!(pane(0.1, 0.2), ImplicitSurfaceError::Edge { edge: 0.2, most: 0.1 });
    assert_eq!(pane(0.4, 0.3), ImplicitSurfaceError::Edge { edge: 0.3, most: 0.25 });
    assert!(matches!(pane(f64::NAN, 0.0), ImplicitSurfaceError::Number { name: "the corners' radius", .. }));
    let most = 1.0 * 0.5 / (1.0 + 2.0_f64.sqrt());
    assert!(
        matches!(told(ImplicitForm::Prism { size, edge: 0.25 }), ImplicitSurfaceError::Edge { most: m, .. } if (m - most).abs() < 1e-15)
    );
    assert!(
        matches!(told(plate(size, 0.1, 1.5, 1.0)), ImplicitSurfaceError::Slope { slope } if (slope - 1.5 * TAU).abs() < 1e-12)
    );
    assert_eq!(
        told(plate(size, 0.1, 0.0, 0.001)),
        ImplicitSurfaceError::Wavelength { wavelength: 0.001, least: 0.01 }
    );
    assert!(ImplicitSurface::new(plate(size, 0.1, 0.0, 1.0)).unwrap().is_convex());
    // No ray and no point causes a panic or an endless loop.
    for field in forms() {
        for bad in [DVec3::ZERO, DVec3::NAN, DVec3::INFINITY, DVec3::splat(1e300), DVec3::X * 1e-300] {
            let _ =
                (field.entry(bad, DVec3::X), field.exit(bad, DVec3::X), field.facet(bad), field.bend(bad));
            let _ = (field.entry(DVec3::ONE, bad), field.exit(DVec3::ZERO, bad), field.silhouette_area(bad));
        }
    }
}

/// Prints steps and times: `cargo test --release field_times -- --ignored --nocapture`.
#[test]
#[ignore = "prints steps and times for a person to read"]
#[allow(clippy::print_stdout, reason = "what it measures is read by a person")]
fn field_times() {
    for (seed, field) in (90..).zip(forms()) {
        let rays = rays(&field, 100_000, seed);
        let (mut steps, mut most, mut lost) = ([0_u64; 2], [0; 2], 0);
        let mut met = vec![];
        for &(o, d) in &rays {
            let mut count = 0;
            let t = field.way_in(o, d, &mut count);
            (steps[0], most[0]) = (steps[0] + u64::from(count), most[0].max(count));
            lost += i32::from(t.is_none() && count >= roots::MOST_STEPS);
            if let Some(t) = t {
                let mut count = 0;
                let exit = field.way_out(o + d * t, d, &mut count);
                (steps[1], most[1]) = (steps[1] + u64::from(count), most[1].max(count));
                lost += i32::from(exit.is_none());
                met.push((o + d * t, d));
            }
        }
        let start = std::time::Instant::now();
        let a: f64 = rays.iter().filter_map(|&(o, d)| field.entry(o, d)).sum();
        let entry = start.elapsed().as_secs_f64() / rays.len() as f64 * 1e9;
        let start = std::time::Instant::now();
        let b: f64 = met.iter().filter_map(|&(o, d)| field.exit(o, d)).sum();
        let exit = start.elapsed().as_secs_f64() / met.len() as f64 * 1e9;
        let mean = [steps[0] as f64 / rays.len() as f64, steps[1] as f64 / met.len() as f64];
        println!(
            "{:?}\n  entry {entry:.0} ns, exit {exit:.0} ns, steps {mean:.2?} at most {most:?}, lost {lost} of {} ({:.0})",
            field.form,
            met.len(),
            a + b
        );
    }
}
