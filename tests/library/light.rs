//! Checks pictures under light: laws that hold for any stone, and the graphics card compared with rays in f64.

use crate::common::shoot::*;
use crate::common::*;
use brillianteer::math::Polytope;
use brillianteer::optics::{Illuminant, materials};
#[cfg(feature = "gpu")]
use brillianteer::scene::Projection;
use brillianteer::scene::{Instance, Light, Panorama, View, light};
use glam::{DVec2, DVec3};

/// A modern ideal cut, with a coarse girdle that is quick to trace.
fn modern() -> Polytope {
    built(&brilliant((56.0, 34.5, 40.8), (50.0, 77.0), 16)).polytope
}

#[test]
fn a_white_furnace_is_white_in_every_clear_material() {
    let stone = modern();
    for m in materials().iter().filter(|m| m.absorption.iter().all(|a| a.is_clear())) {
        for key in [Illuminant::D65, Illuminant::A] {
            let mut shoot = Shoot::new(&stone, &m.name, Light { spectrum: key, ..Light::white() });
            shoot.options.most_bounces = 1000;
            for (picture, remainder) in [shoot.by_rays(), shoot.by_packets()] {
                let unresolved = remainder.unresolved + 1e-9;
                assert!(unresolved < 2e-3, "{}: {unresolved} unresolved", m.name);
                let mean = picture.pixels.iter().map(colour).sum::<DVec3>() / picture.pixels.len() as f64;
                // Only unresolved light is missing; its share differs between wavelengths.
                assert!((mean - 1.0).abs().max_element() < 3.0 * unresolved + 1e-6, "{}: {mean}", m.name);
            }
        }
    }
}

#[test]
fn a_furnace_loses_just_what_a_stone_of_colour_absorbs() {
    for m in materials().iter().filter(|m| m.absorption.iter().any(|a| !a.is_clear())) {
        let mut shoot = Shoot::new(&modern(), &m.name, Light { spectrum: Illuminant::E, ..Light::white() });
        // In one single band light is white.
        (shoot.backdrop, shoot.samples, shoot.wavelengths) = (false, 2, 1);
        for (picture, remainder) in [shoot.by_rays(), shoot.by_packets(), shoot.glanced()] {
            let cover: f64 = picture.pixels.iter().map(|p| f64::from(p[3])).sum();
            let mean = picture.pixels.iter().map(colour).sum::<DVec3>() / cover;
            let left = 1.0 - remainder.absorbed - remainder.unresolved;
            assert!(remainder.absorbed > 0.005, "{}: {remainder:?}", m.name);
            assert!((mean - left).abs().max_element() < 1e-6, "{}: {mean}, not {left}", m.name);
        }
    }
}

#[test]
fn many_wavelengths_of_a_neutral_scene_are_neutral() {
    // A stone of one index in neutral light: whatever it shows is grey, for any number of wavelengths.
    let mut shoot =
        Shoot::new(&modern(), "diamond", Light { spectrum: Illuminant::A, ..light("lamps").unwrap() });
    shoot.scene.instances[0].material = brillianteer::optics::Material::from_index("glass", 2.4175).unwrap();
    for wavelengths in [1, 3, 64] {
        shoot.wavelengths = wavelengths;
        let (picture, _) = shoot.by_rays();
        let scale = picture.pixels.iter().map(|p| colour(p).max_element()).fold(0.0, f64::max);
        for pixel in &picture.pixels {
            let colour = colour(pixel);
            assert!(colour.max_element() - colour.min_element() < 1e-5 * scale, "{wavelengths}: {colour}");
        }
    }
    // Diamond's fire is coloured, but all of it together is not.
    let mut shoot = Shoot::new(&modern(), "diamond", light("dome").unwrap());
    (shoot.wavelengths, shoot.samples, shoot.backdrop) = (64, 4, false);
    let (picture, _) = shoot.by_rays();
    let mean = picture.pixels.iter().map(colour).sum::<DVec3>();
    let mean = mean / mean.element_sum() * 3.0;
    assert!((mean - 1.0).abs().max_element() < 0.01, "{mean}");
}

#[test]
fn more_passes_and_more_wavelengths_come_to_the_same_picture() {
    let mut shoot = Shoot::new(&modern(), "diamond", light("lamps").unwrap());
    let blocks = |wavelengths, samples, shoot: &mut Shoot| {
        (shoot.wavelengths, shoot.samples) = (wavelengths, samples);
        blocks(&shoot.by_rays().0)
    };
    let fine = blocks(32, 12, &mut shoot);
    let coarse = blocks(16, 12, &mut shoot);
    let rough = blocks(4, 1, &mut shoot);
    let scale = fine.iter().map(|b| b.max_element()).fold(0.0, f64::max);
    let worst =
        |a: &[DVec3]| a.iter().zip(&fine).map(|(a, b)| (*a - *b).abs().max_element()).fold(0.0, f64::max);
    assert!(worst(&coarse) < 0.04 * scale, "{} of {scale}", worst(&coarse));
    assert!(worst(&rough) > worst(&coarse), "{} of {scale}", worst(&rough));
}

#[test]
fn a_picture_by_beams_is_the_same_to_the_bit_whole_and_some_rows_at_a_time() {
    let mut shoot = Shoot::new(&modern(), "ruby", light("studio").unwrap());
    shoot.view = View { tilt: 0.2, azimuth: 0.3, ..View::default() };
    (shoot.wavelengths, shoot.samples) = (2, 2);
    let (whole, rest) = shoot.by_beams();
    for rows in [16, 48] {
        assert!(rows < shoot.size);
        let (parts, rest_of_parts) = shoot.by_beams_in(rows);
        assert!(parts == whole && rest_of_parts == rest, "{rows} rows at a time");
    }
}

#[test]
fn a_stone_behind_another_is_seen_through_it_and_hidden_beside_it() {
    // A clear cube of index 1 in front changes nothing; a dark one hides what is behind.
    let cube = |middle: DVec3, half: f64| {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let planes: Vec<_> = axes
            .into_iter()
            .flat_map(|a| [(a, 1.0), (-a, 1.0)])
            .map(|(n, _)| brillianteer::math::Plane::new(n, half + n.dot(middle)))
            .collect();
        Polytope::from_planes(&planes).unwrap()
    };
    let glass = |index| brillianteer::optics::Material::from_index("glass", index).unwrap();
    let placed = Instance::new;
    let behind = || placed(cube(DVec3::new(0.1, 0.05, -0.6), 0.4), glass(1.6));
    let mut shoot = Shoot::new(&modern(), "diamond", light("studio").unwrap());
    shoot.view = View { tilt: 0.1, azimuth: 0.4, ..View::default() };
    shoot.scene.instances = vec![behind()];
    let alone = shoot.by_rays().0;
    shoot.scene.instances = vec![placed(cube(DVec3::new(0.1, 0.0, 0.6), 0.5), glass(1.0)), behind()];
    let through = shoot.by_rays().0;
    // The faintest light is not followed into another stone, and rounding moves an edge by a little.
    let differ =
        alone.pixels.iter().zip(&through.pixels).filter(|(a, b)| (colour(a) - colour(b)).length() > 1e-4);
    assert!(differ.count() <= 4);
    let mut dark = glass(1.0);
    dark.absorption = [(); 2].map(|()| brillianteer::optics::Absorption::new(vec![(550.0, 1e3)]).unwrap());
    shoot.scene.instances[0].material = dark;
    shoot.backdrop = false;
    let hidden = shoot.by_rays().0;
    let middle = hidden.pixels[(SIZE / 2 * SIZE + SIZE / 2) as usize];
    assert!(colour(&middle).length() < 1e-6 && middle[3] == 1.0, "{middle:?}");
}

#[test]
fn exact_beams_show_what_rays_show() {
    // In a pixel of few rays it is chance whether one meets a small lamp; beams have no such chance.
    for (material, name, tilt, chance) in
        [("diamond", "lamps", 0.0, 0.02), ("ruby", "dome", 0.2, 0.002), ("quartz", "ring", 0.1, 0.002)]
    {
        let mut shoot = Shoot::new(&modern(), material, Light { head: 10.0, ..light(name).unwrap() });
        // Under the ring the environment is seen beside the stone as well.
        (shoot.backdrop, shoot.view.tilt) = (name == "ring", tilt);
        (shoot.wavelengths, shoot.samples, shoot.light.head) = (4, 64, 10.0);
        let (rays, rest) = shoot.by_rays();
        // A beam stands for all the rays of a pixel; the wavelengths are the same.
        let (beams, beams_rest) = shoot.by_beams();
        let (rays, beams) = (blocks(&rays), blocks(&beams));
        let scale = rays.iter().map(|b| b.max_element()).fold(0.0, f64::max);
        let worst = rays.iter().zip(&beams).map(|(a, b)| (*a - *b).abs().max_element()).fold(0.0, f64::max);
        assert!(worst < 0.04 * scale, "{material}, {name}: {worst} of {scale}");
        assert!((rest.absorbed - beams_rest.absorbed).abs() < 0.005, "{rest:?} {beams_rest:?}");
        let mean = |b: &[DVec3]| b.iter().sum::<DVec3>() / b.len() as f64;
        let off = (mean(&rays) - mean(&beams)).abs().max_element() / mean(&rays).max_element();
        assert!(off < chance, "{material}, {name}: means are off by {off}");
    }
}

#[test]
fn a_film_that_is_shifted_sees_the_same_elsewhere() {
    let mut shoot = Shoot::new(&modern(), "diamond", light("studio").unwrap());
    (shoot.backdrop, shoot.wavelengths) = (false, 2);
    let (across, up) = (9_u32, 5_u32);
    let taken = |shoot: &Shoot| {
        let all = vec![shoot.by_rays().0, shoot.by_packets().0, shoot.by_beams().0];
        #[cfg(feature = "gpu")]
        let all = {
            let by_card =
                card("a_film_that_is_shifted_sees_the_same_elsewhere").map(|gpu| shoot.by_card(&gpu).0);
            all.into_iter().chain(by_card).collect::<Vec<_>>()
        };
        all
    };
    let before = taken(&shoot);
    shoot.centre = DVec2::new(f64::from(across), f64::from(up)) * (2.2 / f64::from(SIZE));
    let place = |x: u32, y: u32| (y * SIZE + x) as usize;
    for (before, after) in before.iter().zip(&taken(&shoot)) {
        let pixels = (up..SIZE).flat_map(|y| (0..SIZE - across).map(move |x| (x, y)));
        let off = |(x, y)| {
            colour(&after.pixels[place(x, y)]).distance(colour(&before.pixels[place(x + across, y - up)]))
        };
        let (count, apart) = pixels.fold((0, 0), |(n, k), at| (n + 1, k + u32::from(off(at) > 1e-3)));
        // Rounding decides which way rays go that run along an edge.
        assert!(apart * 500 < count, "{apart} of {count}");
        assert_ne!(before.pixels, after.pixels);
    }
}

#[test]
fn more_passes_bring_no_light_of_other_wavelengths() {
    // Under small lamps each piece of a rainbow belongs to one band. Few bands and many passes then differ from many bands
    // about as much as few bands and one pass do, and not half as much again, as with light of neighbouring bands.
    let mut shoot = Shoot::new(&modern(), "diamond", light("fire").unwrap());
    (shoot.backdrop, shoot.view.tilt) = (false, 0.0);
    let picture = |wavelengths, samples, shoot: &mut Shoot| {
        (shoot.wavelengths, shoot.samples) = (wavelengths, samples);
        blocks(&shoot.by_beams().0)
    };
    let fine = picture(64, 1, &mut shoot);
    let off = |a: &[DVec3]| a.iter().zip(&fine).map(|(a, b)| (*a - *b).abs().element_sum()).sum::<f64>();
    let (once, often) = (off(&picture(16, 1, &mut shoot)), off(&picture(16, 4, &mut shoot)));
    assert!(often < 1.1 * once, "{often} after four passes, {once} after one");
}

/// A picture of coloured stripes, 40 by 20 pixels.
fn stripes() -> Panorama {
    let pixel = |k: u32| [f32::from(u8::from(k % 40 < 20)), (k % 7) as f32 / 7.0, (k / 40) as f32 / 20.0];
    Panorama { width: 40, height: 20, pixels: (0..800).map(pixel).collect() }
}

#[test]
fn a_photograph_behind_is_seen_beside_the_stone_and_through_a_slab_as_it_lies() {
    // A slab that is square to the eye shifts nothing: the photograph is where it would be without the slab, less the
    // light that the surfaces reflect. A reflection shows the light in front, and here there is none.
    let planes = [DVec3::Z, -DVec3::Z].map(|n| brillianteer::math::Plane::new(n, 0.2));
    let sides = [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y].map(|n| brillianteer::math::Plane::new(n, 0.6));
    let slab = Polytope::from_planes(&[&planes[..], &sides[..]].concat()).unwrap();
    let mut shoot = Shoot::new(&slab, "diamond", Light { head: 0.0, ..light("white").unwrap() });
    shoot.light.dome[0].radiance = 0.0;
    shoot.scene.instances[0].material = brillianteer::optics::Material::from_index("glass", 1.5).unwrap();
    (shoot.view, shoot.photo, shoot.wavelengths) = (View::default(), Some((stripes(), 1.0)), 3);
    let picture = shoot.by_rays().0;
    let through = (1.0 - 0.04) / (1.0 + 0.04);
    let (mut beside, mut inside) = (0, 0);
    for (k, pixel) in picture.pixels.iter().enumerate() {
        let at = DVec2::new((k as u32 % SIZE) as f64, (k as u32 / SIZE) as f64) + 0.5 - 0.5 * f64::from(SIZE);
        let at = DVec2::new(at.x, -at.y) * 2.2 / f64::from(SIZE);
        let on = DVec2::new(at.x, -at.y) / 3.0 + 0.5;
        let expected =
            stripes().between(DVec2::new(on.x, (on.y - 0.5) * 2.0 + 0.5) * DVec2::new(40.0, 20.0) - 0.5);
        let is_inside = at.abs().max_element() < 0.58;
        if !is_inside && at.abs().max_element() < 0.62 || (at.y / 1.5).abs() > 0.49 {
            continue;
        }
        let expected = expected * if is_inside { through } else { 1.0 };
        assert!((colour(pixel) - expected).length() < 1e-3, "{at}: {pixel:?}, not {expected}");
        if is_inside { inside += 1 } else { beside += 1 }
    }
    assert!(inside > 500 && beside > 500, "{inside} {beside}");
}

#[test]
fn a_stone_as_thin_as_air_still_covers_what_is_behind() {
    let mut shoot = Shoot::new(&modern(), "diamond", light("dome").unwrap());
    shoot.scene.instances[0].material = brillianteer::optics::Material::from_index("air", 1.0).unwrap();
    shoot.backdrop = false;
    let middle = (SIZE / 2 * SIZE + SIZE / 2) as usize;
    let (rays, beams) = (shoot.by_rays().0, shoot.by_beams().0);
    assert!((rays.pixels[middle][3] - 1.0).abs() < 1e-6 && (beams.pixels[middle][3] - 1.0).abs() < 1e-6);
}

#[cfg(feature = "gpu")]
mod card {
    use super::*;
    use brillianteer::optics::material;

    #[test]
    fn the_card_shows_what_rays_show() {
        let Some(gpu) = crate::common::card("the_card_shows_what_rays_show") else { return };
        let fine = built(&brilliant((56.0, 34.5, 40.8), (50.0, 77.0), 96)).polytope;
        let shoot = |wavelengths, samples| {
            let mut shoot = Shoot::new(&fine, "diamond", light("lamps").unwrap());
            (shoot.wavelengths, shoot.samples) = (wavelengths, samples);
            shoot
        };
        let found = differ(&shoot(16, 12), &shoot(16, 12), &gpu);
        assert!(found < 0.005, "eight lamps on a dome: {found}");
        for (material, name, distance) in
            [("ruby", "studio", 7.0), ("emerald", "ring", 30.0), ("quartz", "office", 5.0)]
        {
            let shoot = || {
                let mut shoot = Shoot::new(&modern(), material, Light { head: 12.0, ..light(name).unwrap() });
                shoot.view.projection = Projection::Perspective { distance };
                shoot.samples = 8;
                shoot.light.head = 12.0;
                shoot
            };
            let found = differ(&shoot(), &shoot(), &gpu);
            assert!(found < 0.005, "{material}, {name}: {found}");
        }
        let photo = || {
            let mut shoot = Shoot::new(&modern(), "quartz", light("studio").unwrap());
            (shoot.photo, shoot.samples) = (Some((stripes(), 1.5)), 8);
            shoot.view.lean = brillianteer::scene::Lean::Eye;
            shoot
        };
        let found = differ(&photo(), &photo(), &gpu);
        assert!(found < 0.005, "a photograph: {found}");
        let mut mutant = shoot(4, 4);
        mutant.scene.instances[0].material = material("cubic zirconia").unwrap().clone();
        assert!(differ(&shoot(4, 4), &mutant, &gpu) > 0.02);
        let mut mutant = shoot(4, 4);
        mutant.light.lamp[0].azimuth += 4.0;
        assert!(differ(&shoot(4, 4), &mutant, &gpu) > 0.01);
    }

    #[test]
    fn the_card_mixes_refracted_and_straight_rays_as_rays_do() {
        let Some(gpu) = crate::common::card("the_card_mixes_refracted_and_straight_rays_as_rays_do") else {
            return;
        };
        let shoot = |strength, projection| {
            let mut shoot = Shoot::new(&modern(), "quartz", light("lamps").unwrap());
            (shoot.strength, shoot.samples, shoot.view.projection) = (strength, 8, projection);
            shoot
        };
        let before_stripes = |strength| {
            let mut shoot = shoot(strength, Projection::Perspective { distance: 6.0 });
            shoot.photo = Some((stripes(), 1.5));
            shoot
        };
        for (strength, shares) in [(0.0, 1), (0.1, 8), (0.6, 8)] {
            let divided = || Shoot { shares, ..before_stripes(strength) };
            let found = differ(&divided(), &divided(), &gpu);
            assert!(found < 0.001, "strength {strength} before a photograph: {found}");
            let alone = || shoot(strength, Projection::Orthographic);
            let found = differ(&alone(), &alone(), &gpu);
            assert!(found < 0.005, "strength {strength} under lamps: {found}");
        }
        for mutant in [0.2, 1.0] {
            let found = differ(&before_stripes(0.1), &before_stripes(mutant), &gpu);
            assert!(found > 0.003, "strength {mutant} for 0.1 makes only {found}");
        }
    }

    #[test]
    fn the_card_shows_stones_beside_one_another_as_rays_do() {
        let Some(gpu) = crate::common::card("the_card_shows_stones_beside_one_another_as_rays_do") else {
            return;
        };
        let shoot = |index: f64| {
            let planes = |middle: DVec3| {
                let corner = |k: u32| {
                    DVec3::new(
                        [-1.0, 1.0][(k & 1) as usize],
                        [-1.0, 1.0][(k >> 1 & 1) as usize],
                        [-1.0, 1.0][(k >> 2) as usize],
                    )
                };
                let plane = |k| {
                    let n = corner(k) / 3.0_f64.sqrt();
                    brillianteer::math::Plane::new(n, 0.28 + n.dot(middle))
                };
                Polytope::from_planes(&(0..8).map(plane).collect::<Vec<_>>()).unwrap()
            };
            let mut shoot =
                Shoot::new(&planes(DVec3::new(-0.4, 0.1, 0.2)), "diamond", light("studio").unwrap());
            let glass = brillianteer::optics::Material::from_index("glass", index).unwrap();
            shoot.scene.instances.push(Instance::new(planes(DVec3::new(0.45, -0.2, 0.0)), glass));
            shoot.samples = 8;
            shoot
        };
        let found = differ(&shoot(1.6), &shoot(1.6), &gpu);
        assert!(found < 0.005, "{found}");
        assert!(differ(&shoot(1.6), &shoot(1.65), &gpu) > 0.01);
    }

    #[test]
    fn a_stone_of_many_planes_is_lit_by_bunches_as_well() {
        let Some(gpu) = crate::common::card("a_stone_of_many_planes_is_lit_by_bunches_as_well") else {
            return;
        };
        let planes: Vec<_> = (0..600)
            .map(|i| {
                let z: f64 = 1.0 - 2.0 * (f64::from(i) + 0.5) / 600.0;
                brillianteer::math::Plane::from_slope(z.acos(), 2.399_963 * f64::from(i), 1.0)
            })
            .collect();
        let shoot = || {
            let mut shoot =
                Shoot::new(&Polytope::from_planes(&planes).unwrap(), "quartz", light("dome").unwrap());
            (shoot.samples, shoot.options.most_bounces) = (8, 12);
            shoot
        };
        let found = differ(&shoot(), &shoot(), &gpu);
        assert!(found < 0.01, "{found}");
    }
}
