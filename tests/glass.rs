//! Checks that glass shapes refract as textbooks say.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test fails by it; what was found is told")]

use brillianteer::cut::{Cut, FAMILIES, Glass};
use brillianteer::math::{ImplicitForm, ImplicitSurface, Plane, Polytope, Solid, SolidRef};
use brillianteer::measure;
use brillianteer::optics::Dispersion;
use brillianteer::picture::by_rays;
use brillianteer::picture::by_rays::ScopeSampling;
use brillianteer::scene::{ASET_CONE, Backing, Film, Glare, Medium, Projection, Scope, View};
use brillianteer::trace::ray::{Camera, Exit, RayOptions, StoneTracer};
use brillianteer::trace::unwatched;
use glam::{DQuat, DVec2, DVec3};

fn solid(form: ImplicitForm) -> Solid {
    ImplicitSurface::new(form).unwrap().into()
}

fn exits(tracer: &StoneTracer, origin: DVec3, direction: DVec3) -> Vec<Exit> {
    let mut exits = vec![];
    tracer.follow(origin, direction, |exit| exits.push(exit)).unwrap();
    exits
}

/// Returns the light that goes straight through: it leaves at the first facet that it meets inside.
fn through(tracer: &StoneTracer, origin: DVec3, direction: DVec3) -> Option<Exit> {
    exits(tracer, origin, direction).into_iter().find(|exit| exit.bounce == 1)
}

/// Returns every glass shape at its first dimensions, under its key in cut files.
fn glasses() -> impl Iterator<Item = (&'static str, Glass)> {
    FAMILIES.into_iter().filter_map(|family| match family.first {
        Cut::Glass(glass) => Some((family.key, glass)),
        _ => None,
    })
}

fn every_shape() -> Vec<(&'static str, Solid)> {
    let mut shapes: Vec<(&str, Solid)> =
        glasses().map(|(key, glass)| (key, glass.field().unwrap().into())).collect();
    let size = DVec3::new(1.6, 1.2, 1.0);
    shapes.push(("rounded prism", solid(ImplicitForm::Prism { size, edge: 0.12 })));
    shapes.push(("sharp cube", solid(ImplicitForm::Block { size, edge: 0.0 })));
    shapes.push(("ball", solid(ImplicitForm::Pill { size: DVec3::splat(2.0), edge: 1.0 })));
    let waves = ImplicitForm::Plate {
        size: DVec3::new(2.0, 1.6, 0.2),
        edge: 0.04,
        amplitude: 0.12,
        wavelength: 0.7,
        phase: 0.8,
    };
    shapes.push(("waves", solid(waves)));
    shapes
}

/// Returns the origins and directions of rays from all sides toward a solid.
fn rays(solid: &Solid, count: u32) -> Vec<(DVec3, DVec3)> {
    let (low, high) = solid.bounds();
    let view = |k: u32| View { tilt: f64::from(k) * 0.37, azimuth: f64::from(k) * 1.1, ..View::default() };
    let ray = |k: u32| {
        let at = DVec2::new(0.754_877_666_2, 0.569_840_291) * f64::from(k);
        let half = 0.5 * (high - low).length();
        Camera::new(&view(k), solid).ray((at.fract() * 2.0 - 1.0) * half)
    };
    (0..count).map(ray).collect()
}

#[test]
fn a_prism_bends_every_wavelength_by_the_least_deviation_of_the_textbook() {
    // The prism is equilateral, with 60 degrees at every edge.
    let form = ImplicitForm::Prism { size: DVec3::new(2.0, 1.0, 0.75_f64.sqrt()), edge: 0.0 };
    let prism = solid(form);
    let mut worst = 0.0_f64;
    let mut deviations = vec![];
    for law in [Dispersion::Abbe { n_d: 1.728, v_d: 28.4 }, Dispersion::Abbe { n_d: 1.517, v_d: 64.2 }] {
        for nm in [404.7, 486.1, 546.1, 587.6, 656.3, 700.0] {
            let index = law.index(nm);
            let tracer = StoneTracer::new(&prism, Medium::clear(index), RayOptions::default());
            // A ray in the y-z plane toward the middle of the right flank, from every side.
            let deviation = |incidence: f64| {
                let normal = DVec3::new(0.0, 0.75_f64.sqrt(), 0.5);
                let level = DVec3::new(0.0, 0.5, -(0.75_f64.sqrt()));
                let toward = normal * incidence.cos() + level * incidence.sin();
                let at = DVec3::new(0.0, 0.25, 0.0);
                let exit = through(&tracer, at + toward * 3.0, -toward)?;
                Some((-toward).angle_between(exit.direction).to_degrees())
            };
            let all = (1..8900).filter_map(|k| deviation((f64::from(k) * 0.01).to_radians()));
            let least = all.fold(f64::INFINITY, f64::min);
            // Born and Wolf, Principles of Optics, 4.7.2: n = sin((A + d) / 2) / sin(A / 2).
            let expected = 2.0 * (index * 0.5).asin().to_degrees() - 60.0;
            worst = worst.max((least - expected).abs());
            deviations.push(least);
        }
    }
    println!("least deviation is off by {worst:.1e} degrees at most");
    assert!(worst < 1e-4, "{worst}");
    assert!(deviations[0] - deviations[5] > 3.0, "SF10 spreads blue from red");
}

#[test]
fn a_slab_shifts_light_and_does_not_bend_it() {
    for edge in [0.0, 0.05] {
        let slab = solid(ImplicitForm::Block { size: DVec3::new(3.0, 3.0, 0.4), edge });
        for index in [1.333, 1.517, 2.418] {
            let tracer = StoneTracer::new(&slab, Medium::clear(index), RayOptions::default());
            for degrees in [0.0, 10.0, 40.0, 70.0_f64] {
                let (sin, cos) = degrees.to_radians().sin_cos();
                let direction = DVec3::new(sin, 0.0, -cos);
                let exit = through(&tracer, -direction * 2.0, direction).unwrap();
                assert!((exit.direction - direction).length() < 1e-12);
                let shift = exit.point.reject_from_normalized(direction).length();
                // Hecht, Optics, problem 4.10: t sin(i) (1 - cos i / (n cos t)); here by half, as the ray aims at the middle.
                let cos_t = (1.0 - (sin / index).powi(2)).sqrt();
                let all = 0.4 * sin * (1.0 - cos / (index * cos_t));
                let entry = 0.2 * degrees.to_radians().tan();
                let beside = (exit.point.x - (-entry + 0.4 * sin / (index * cos_t))).abs();
                assert!(beside < 1e-12 && (shift - all).abs() < 1e-12, "{edge} {index} {degrees}");
            }
        }
    }
}

#[test]
fn a_pill_with_ends_of_balls_images_as_its_lens_formula_says() {
    for (length, radius) in [(2.0, 1.0), (3.0, 0.5), (4.0, 0.8)] {
        let size = DVec3::new(length, 2.0 * radius, 2.0 * radius);
        let pill = solid(ImplicitForm::Pill { size, edge: radius });
        for index in [1.333, 1.517, 1.728] {
            let tracer = StoneTracer::new(&pill, Medium::clear(index), RayOptions::default());
            let height = 1e-4 * radius;
            let origin = DVec3::new(-5.0, 0.6 * height, 0.8 * height);
            let exit = through(&tracer, origin, DVec3::X).unwrap();
            let along =
                -exit.point.dot(DVec3::new(0.0, 0.6, 0.8)) / exit.direction.dot(DVec3::new(0.0, 0.6, 0.8));
            let focus = exit.point.x + exit.direction.x * along - 0.5 * length;
            // Back focal distance of a thick lens (Hecht, Optics, 6.2), both radii the same:
            let power = (index - 1.0) * (2.0 / radius - (index - 1.0) * length / (index * radius * radius));
            let expected = (1.0 - (index - 1.0) * length / (index * radius)) / power;
            assert!(
                (focus - expected).abs() < 1e-6 * expected.abs().max(1.0),
                "{length} {index}: {focus} {expected}"
            );
        }
    }
}

#[test]
fn all_light_is_accounted_for_in_every_shape() {
    for (name, solid) in every_shape() {
        for medium in [Medium::clear(1.517), Medium::grey(2.418, 0.3), Medium::clear(1.0)] {
            for polarised in [true, false] {
                let options = RayOptions { polarised, most_bounces: 64, least_weight: 1e-5 };
                let tracer = StoneTracer::new(&solid, medium, options);
                let (mut met, mut lost) = (0, 0.0_f64);
                for (origin, direction) in rays(&solid, 4000) {
                    let mut sum = 0.0;
                    let Some(rest) = tracer.follow(origin, direction, |exit| {
                        sum += exit.weight;
                        assert!((exit.direction.length() - 1.0).abs() < 1e-9);
                    }) else {
                        continue;
                    };
                    met += 1;
                    lost += rest.unresolved;
                    let all = sum + rest.absorbed + rest.unresolved;
                    assert!((all - 1.0).abs() < 1e-9, "{name}: {all}");
                    assert!(medium.index > 1.0 || sum > 1.0 - 1e-9 - rest.unresolved, "air bends nothing");
                }
                assert!(met > 400, "{name}: {met}");
                let lost = lost / f64::from(met);
                assert!(lost < 0.12, "{name} of {}: {lost} unresolved", medium.index);
            }
        }
    }
}

#[test]
fn a_prism_is_the_same_between_planes_and_as_a_distance() {
    for (key, mut glass) in glasses() {
        let (Glass::Prism(sides) | Glass::Cube(sides)) = &mut glass else { continue };
        sides.edge = 0.0;
        let planes: Vec<Plane> = glass.planes().unwrap().into_iter().map(|(_, plane)| plane).collect();
        let polytope = Polytope::from_planes(&planes).unwrap();
        let field: Solid = glass.field().unwrap().into();
        let scope = Scope::aset(ASET_CONE, Backing::Black);
        let medium = Medium::grey(1.6, 0.2);
        let options = RayOptions { most_bounces: 64, ..RayOptions::default() };
        for projection in [Projection::Orthographic, Projection::Perspective { distance: 5.0 }] {
            let view = View { tilt: 0.5, azimuth: 0.3, projection, ..View::default() };
            let film = Film::square(48, 1.3);
            let rows = |solid: SolidRef| {
                let mut pixels = vec![];
                by_rays::trace::<brillianteer::trace::Stopped>(
                    solid,
                    medium,
                    &view,
                    &scope,
                    &film,
                    &ScopeSampling { options, per_side: 1, glare: Glare::Included },
                    &unwatched,
                    |rows| {
                        (rows.first..rows.first + rows.count).for_each(|y| {
                            (0..scope.bands.len()).for_each(|c| pixels.extend_from_slice(rows.row(y, c)))
                        });
                        Ok(())
                    },
                )
                .unwrap();
                pixels
            };
            let (a, b) = (rows(SolidRef::from(&polytope)), rows(field.by_ref()));
            let off = a.iter().zip(&b).filter(|(a, b)| (*a - *b).abs() > 1e-9).count();
            let lit = a.iter().filter(|v| **v > 0.01).count();
            // Rounding decides on which side of an edge a ray through it passes.
            assert!(lit > 500 && off * 500 < lit, "{key}: {off} of {lit}");
        }
        let figures = [SolidRef::from(&polytope), field.by_ref()].map(|solid| {
            measure::by_rays(solid, medium, &View::default(), &scope, (options, 48), &unwatched).unwrap()
        });
        assert!((figures[0].silhouette_area - figures[1].silhouette_area).abs() < 1e-12);
        for (a, b) in figures[0].transmitted.iter().zip(&figures[1].transmitted) {
            assert!((a - b).abs() < 1e-3);
        }
    }
}

#[test]
fn a_sweep_over_wavelengths_is_what_two_of_them_differ_by() {
    let spread = 1e-6;
    for (name, solid) in every_shape() {
        let options = RayOptions { most_bounces: 5, least_weight: 1e-4, polarised: true };
        let at = |index: f64, spread: f64| {
            StoneTracer::new(&solid, Medium { spread, ..Medium::clear(index) }, options)
        };
        let (middle, low, high) = (at(1.6, spread), at(1.6 - spread / 2.0, 0.0), at(1.6 + spread / 2.0, 0.0));
        let (mut all, mut off) = (0, 0);
        for (origin, direction) in rays(&solid, 600) {
            if middle.meet(origin, direction).is_none() {
                continue;
            }
            let [a, b, c] = [&low, &middle, &high].map(|tracer| exits(tracer, origin, direction));
            for exit in &b {
                let same = |e: &&Exit| e.bounce == exit.bounce && (e.point - exit.point).length() < 1e-3;
                let (Some(from), Some(to)) = (a.iter().find(same), c.iter().find(same)) else { continue };
                all += 1;
                let expected = (to.direction - from.direction) / spread;
                let error = (exit.sweep / spread - expected).length();
                off += u32::from(error > 1e-3 * expected.length().max(1.0));
            }
        }
        // Where a path passes close to an edge, its ends differ more.
        assert!(all > 300 && off * 50 < all, "{name}: {off} of {all}");
    }
}

#[test]
fn turning_and_scaling_a_shape_changes_nothing() {
    for (name, solid) in every_shape() {
        let (scale, turn, shift) = (2.5, DQuat::from_rotation_x(0.7), DVec3::new(0.3, -4.0, 1.0));
        let moved = solid.moved(scale, turn, shift);
        let tracer = |solid: &Solid| {
            StoneTracer::new(
                solid,
                Medium::clear(1.5),
                RayOptions { most_bounces: 4, ..RayOptions::default() },
            )
        };
        let (own, other) = (tracer(&solid), tracer(&moved));
        let (mut all, mut off) = (0, 0);
        for (origin, direction) in rays(&solid, 500) {
            if own.meet(origin, direction).is_none() {
                continue;
            }
            let there = (turn * origin * scale + shift, turn * direction);
            let (a, b) = (exits(&own, origin, direction), exits(&other, there.0, there.1));
            all += 1;
            let apart = |(a, b): (&Exit, &Exit)| {
                (turn * a.direction - b.direction).length() > 1e-6 || (a.weight - b.weight).abs() > 1e-6
            };
            off += u32::from(a.len() != b.len() || a.iter().zip(&b).any(apart));
        }
        assert!(all > 50 && off * 50 < all, "{name}: {off} of {all}");
    }
}
