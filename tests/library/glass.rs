//! Checks that glass shapes refract as textbooks say.

use brillianteer::base::unwatched;
use brillianteer::cut::{Cut, FAMILIES, Glass};
use brillianteer::math::{ImplicitForm, ImplicitSurface, Plane, Polytope, Pose, SolidRef, TriangleMesh};
use brillianteer::measure;
use brillianteer::optics::{Dispersion, Material, material};
use brillianteer::picture::by_rays;
use brillianteer::scene::{
    ASET_CONE, Backing, Body, Film, Glare, Instance, Medium, Projection, Scene, Scope, Specimen, View,
};
use brillianteer::trace::{
    DispersedRay, ScopeShot,
    ray::{Camera, Exit, InstanceTracer, MeetingRay, RayOptions, StoneTracer},
};
use glam::{DQuat, DVec2, DVec3};
use std::sync::Arc;

fn solid(form: ImplicitForm) -> Body {
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

fn every_shape() -> Vec<(&'static str, Body)> {
    let mut shapes: Vec<(&str, Body)> =
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
fn rays(solid: &Body, count: u32) -> Vec<(DVec3, DVec3)> {
    let (low, high) = solid.solid().bounds();
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
        let field: Body = glass.field().unwrap().into();
        let scope = Scope::aset(ASET_CONE, Backing::Black);
        let medium = Medium::grey(1.6, 0.2);
        let options = RayOptions { most_bounces: 64, ..RayOptions::default() };
        for projection in [Projection::Orthographic, Projection::Perspective { distance: 5.0 }] {
            let view = View { tilt: 0.5, azimuth: 0.3, projection, ..View::default() };
            let film = Film::square(48, 1.3);
            let rows = |solid: SolidRef| {
                let mut pixels = vec![];
                let (view, scope, shift) = (&view, &scope, DVec2::splat(0.5));
                let shot = ScopeShot { solid, medium, view, scope, film, per_side: 1, shift, options };
                by_rays::trace::<brillianteer::base::Stopped>(&shot, Glare::Included, &unwatched, |rows| {
                    (rows.first..rows.first + rows.count).for_each(|y| {
                        (0..scope.bands.len()).for_each(|c| pixels.extend_from_slice(rows.row(y, c)))
                    });
                    Ok(())
                })
                .unwrap();
                pixels
            };
            let (a, b) = (rows(SolidRef::from(&polytope)), rows(field.solid()));
            let off = a.iter().zip(&b).filter(|(a, b)| (*a - *b).abs() > 1e-9).count();
            let lit = a.iter().filter(|v| **v > 0.01).count();
            // Rounding decides on which side of an edge a ray through it passes.
            assert!(lit > 500 && off * 500 < lit, "{key}: {off} of {lit}");
        }
        let figures = [SolidRef::from(&polytope), field.solid()].map(|solid| {
            measure::by_rays(solid, medium, &View::default(), &scope, (options, 48), &unwatched).unwrap()
        });
        assert!((figures[0].silhouette_area - figures[1].silhouette_area).abs() < 1e-12);
        for (a, b) in figures[0].transmitted.iter().zip(&figures[1].transmitted) {
            assert!((a - b).abs() < 1e-3);
        }
    }
}

#[test]
fn a_fan_over_wavelengths_is_what_two_of_them_differ_by() {
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
                let error = (exit.fan / spread - expected).length();
                off += u32::from(error > 1e-3 * expected.length().max(1.0));
            }
        }
        // Where a path passes close to an edge, its ends differ more.
        assert!(all > 300 && off * 50 < all, "{name}: {off} of {all}");
    }
}

#[test]
fn turning_and_scaling_a_body_changes_nothing() {
    let cut = Specimen::new(
        brillianteer::io::cut_file::parse(include_str!("../../cuts/tolkowsky.toml"), "").unwrap(),
    );
    let stone = (*cut.unwrap().body).clone();
    let mesh = Body::from(Arc::new(TriangleMesh::of_polytope(&stone.stone().unwrap().polytope)));
    let pose = Pose { at: DVec3::new(0.3, -4.0, 1.0), turn: DQuat::from_rotation_x(0.7), scale: 2.5 };
    for (name, body) in every_shape().into_iter().chain([("stone", stone), ("mesh", mesh)]) {
        let still = Instance::new(body, Material::from_index("glass", 1.5).unwrap());
        let options = RayOptions { most_bounces: 4, ..RayOptions::default() };
        let stones = [still.clone(), still.clone().moved(&pose)];
        let [own, other] =
            InstanceTracer::of_all(&stones, options, |_| Medium::grey(1.5, 0.2)).try_into().unwrap();
        let exits = |tracer: &InstanceTracer, (origin, direction): (DVec3, DVec3)| {
            let mut exits = vec![];
            let met = tracer.meet(origin, direction)?;
            let ray = MeetingRay::from_eye(met, DispersedRay::new(origin, direction));
            tracer.follow_from(&ray, |_, _| false, |exit| exits.push(exit));
            Some((met.1, exits))
        };
        let (mut all, mut off) = (0, 0);
        for (origin, direction) in rays(&still.body, 500) {
            let Some((distance, a)) = exits(&own, (origin, direction)) else { continue };
            let there = exits(&other, (pose.place(origin), pose.turn * direction));
            let Some((farther, b)) = there else { panic!("{name}: missed") };
            all += 1;
            let apart = |(a, b): (&Exit, &Exit)| {
                (pose.turn * a.direction - b.direction).length() > 1e-6
                    || (a.weight - b.weight).abs() > 1e-6
                    || pose.place(a.point).distance(b.point) > 1e-6
                    || (pose.scale * a.path - b.path).abs() > 1e-6
            };
            let is_off = a.len() != b.len() || a.iter().zip(&b).any(apart);
            off += u32::from(is_off || (pose.scale * distance - farther).abs() > 1e-6);
        }
        assert!(all > 50 && off * 50 < all, "{name}: {off} of {all}");
        let (low, high) = stones[1].solid().bounds();
        let points = match &*still.body {
            Body::Glass(smooth) => &smooth.surface().vertices,
            body => body.solid().vertices(),
        };
        let placed = points.iter().map(|v| pose.place(*v));
        let (least, most) = placed.fold((high, low), |(l, h), v| (l.min(v), h.max(v)));
        let is_wavy = name == "waves" || name == "plate";
        let slack = if is_wavy { 0.7 } else { 0.05 };
        assert!((low - least).max_element() < 1e-9 && (most - high).max_element() < 1e-9, "{name}");
        assert!((least - low).max_element() < slack && (high - most).max_element() < slack, "{name}");
        let ball = stones[1].solid().ball();
        assert!(stones[1].solid().vertices().all(|v| v.distance(ball.middle) <= ball.radius));
    }
}

#[test]
fn a_stone_that_is_scaled_absorbs_as_one_of_that_size() {
    let ruby = material("ruby").unwrap().clone();
    let stone = Instance::new(solid(ImplicitForm::Block { size: DVec3::ONE, edge: 0.1 }), ruby);
    let larger = stone.clone().moved(&Pose { scale: 2.5, ..Pose::STILL });
    let medium = |stone, unit_mm| {
        Scene { instances: vec![], metals: vec![], unit_mm }.medium(stone, (500.0, 550.0, 600.0))
    };
    assert_eq!(medium(&larger, 2.0), medium(&stone, 5.0));
    assert_ne!(medium(&larger, 2.0), medium(&stone, 2.0));
    assert!((larger.carats(2.0).unwrap() / stone.carats(5.0).unwrap() - 1.0).abs() < 1e-12);
}
