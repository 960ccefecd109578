use super::*;

/// The least and the greatest mean radiance of the whole sphere and of the photograph of span 1, by world.
const MEANS: [(World, [f64; 2], [f64; 2]); 3] = [
    (World::Sunset, [0.05, 0.3], [0.3, 1.5]),
    (World::Room, [0.05, 0.4], [0.1, 0.5]),
    (World::City, [0.02, 0.2], [0.05, 0.4]),
];

fn mean(picture: &Panorama) -> f64 {
    let rows = picture.pixels.chunks(picture.width as usize).enumerate();
    let sphere = picture.is_whole_sphere();
    let (mut sum, mut all) = (0.0, 0.0);
    for (y, row) in rows {
        let weight = if sphere { (PI * (y as f64 + 0.5) / f64::from(picture.height)).sin() } else { 1.0 };
        sum += weight * row.iter().flatten().map(|&c| f64::from(c)).sum::<f64>() / 3.0;
        all += weight * row.len() as f64;
    }
    sum / all
}

#[test]
fn worlds_are_found_by_their_names() {
    for (name, world) in World::NAMES {
        assert_eq!((World::named(&name.to_uppercase()), world.name()), (Some(world), name));
        assert_eq!(serde_json::to_string(&world).unwrap(), format!("\"{name}\""));
        assert_eq!(serde_json::from_str::<World>(&format!("\"{name}\"")).unwrap(), world);
    }
    assert_eq!(World::named("moon"), None);
}

#[test]
fn light_is_finite_and_positive_in_every_direction_and_at_every_footprint() {
    for (_, world) in World::NAMES {
        for k in 0..4000 {
            let z = 1.0 - 2.0 * (f64::from(k) + 0.5) / 4000.0;
            let (sin, cos) = (2.399_963 * f64::from(k)).sin_cos();
            let d = DVec3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z);
            for footprint in [0.0, 1e-9, 1e-4, 0.01, 1.0] {
                let light = world.radiance(d, footprint);
                assert!(
                    light.is_finite() && light.min_element() >= 0.0,
                    "{world:?} {d} {footprint}: {light}"
                );
            }
        }
        for d in [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z] {
            assert!(world.radiance(d, 0.001).is_finite(), "{world:?} {d}");
        }
    }
}

#[test]
fn worlds_are_as_bright_as_they_say_and_hold_light_far_above_white() {
    for (world, sphere, photograph) in MEANS {
        let (whole, picture) = (world.panorama(512), world.picture([256, 256], 1.0));
        for (picture, [least, most]) in [(&whole, sphere), (&picture, photograph)] {
            let mean = mean(picture);
            assert!((least..=most).contains(&mean), "{world:?}: {mean} is not {least} to {most}");
        }
        let sharp = world.picture([512, 512], 1.0);
        assert!(sharp.pixels.iter().flatten().any(|&c| c > 4.0), "{world:?}");
    }
}

#[test]
fn the_same_is_drawn_again_at_any_size() {
    for (_, world) in World::NAMES {
        for size in [[1, 1], [7, 3], [64, 48]] {
            let picture = world.picture(size, 2.0);
            assert_eq!(picture.check(), Ok(()));
            assert_eq!(picture, world.picture(size, 2.0), "{world:?}");
        }
        assert_eq!(world.panorama(33).check(), Ok(()));
        assert_eq!((world.panorama(0).width, world.picture([0, 0], 1.0).height), (2, 1));
    }
}

/// Returns the share of places, seen in one picture and another, whose light agrees to a tenth or a hundredth of white.
fn agreement(places: usize, pair: impl Fn(usize) -> (DVec3, DVec3)) -> f64 {
    let agree = |k: &usize| {
        let (a, b) = pair(*k);
        (a - b).abs().max_element() < 0.01 + 0.1 * a.max(b).max_element()
    };
    (0..places).filter(agree).count() as f64 / places as f64
}

#[test]
fn photograph_and_panorama_show_the_same_in_the_same_direction() {
    for (_, world) in World::NAMES {
        let (size, whole) = ([256, 160], world.panorama(2048));
        let picture = world.picture(size, 1.0);
        let at = |k: usize| DVec2::new((k % 256) as f64, (k / 256) as f64);
        let colour = |p: [f32; 3]| DVec3::from_array(p.map(f64::from));
        let pair = |turn: f64| {
            let (picture, whole) = (&picture, &whole);
            move |k: usize| {
                let (d, _) = world.seen_at(at(k) + 0.5, size, 1.0);
                (colour(picture.pixels[k]), whole.toward(glam::DQuat::from_rotation_z(turn) * d))
            }
        };
        let [same, turned] = [0.0, 0.1].map(|turn| agreement(256 * 160, pair(turn)));
        assert!(same > 0.6 && same > turned + 0.1, "{world:?}: {same}, turned {turned}");
    }
}

#[test]
fn the_middle_half_of_a_wide_photograph_is_the_narrow_one() {
    for (_, world) in World::NAMES {
        let (wide, narrow) = (world.picture([128, 128], 2.0), world.picture([64, 64], 1.0));
        let middle = |k: usize| (k / 64 + 32) * 128 + k % 64 + 32;
        // Pixels at the narrow one's border have fewer neighbours.
        let inner = |k: &usize| (1..63).contains(&(k % 64)) && (1..63).contains(&(k / 64));
        let is_off = |k: &usize| {
            let (a, b) = (wide.pixels[middle(*k)], narrow.pixels[*k]);
            (0..3).any(|c| (a[c] - b[c]).abs() > 1e-3 * (1e-3 + a[c]))
        };
        let off = (0..64 * 64).filter(inner).filter(is_off).count();
        assert!(off <= 4, "{world:?}: {off} pixels differ");
    }
}

#[test]
fn the_viewer_of_a_light_sees_the_middle_of_the_photograph_behind_the_stones() {
    assert_eq!(World::from_light(-DVec3::Z), DVec3::X);
    assert_eq!(World::from_light(DVec3::Y), DVec3::Z);
    // Places to the right in the image have azimuths below 0.
    assert_eq!(World::from_light(DVec3::X), -DVec3::Y);
}

#[test]
fn a_photograph_taken_in_parts_is_the_one_taken_at_once_and_can_be_stopped() {
    for (_, world) in World::NAMES {
        let size = [24, 2 * PART_ROWS as u32 + 9];
        let mut parts = 0;
        let whole = world.picture_in_parts(size, 2.0, |_| {
            parts += 1;
            ControlFlow::Continue(())
        });
        assert!(whole == Some(world.picture(size, 2.0)) && parts == 3, "{world:?}");
        let stopped = world.picture_in_parts(size, 2.0, |done| {
            if done > 0.3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert!(stopped.is_none());
    }
}
