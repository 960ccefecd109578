//! Compares pictures by packets of rays in single precision with those by single rays in double precision.

use crate::common::shoot::*;
use crate::common::*;
use brillianteer::math::{ImplicitForm, ImplicitSurface, Plane, Polytope, Pose, SmoothSolid};
use brillianteer::optics::{Material, material};
use brillianteer::scene::{Body, Instance, Light, Projection, View, light};
use brillianteer::trace::ray::RayOptions;
use glam::{DQuat, DVec2, DVec3};

/// Returns the largest difference of a block's mean between packets and single rays, as a fraction of the brightest block.
fn differ(shoot: &Shoot, twin: &Shoot) -> f64 {
    apart(&shoot.by_rays().0, &twin.by_packets().0)
}

fn modern() -> Polytope {
    built(&brilliant((56.0, 34.5, 40.8), (50.0, 77.0), 16)).polytope
}

#[test]
fn packets_show_what_single_rays_show_in_every_material_light_and_perspective() {
    for (material, name, distance, polarised) in [
        ("diamond", "lamps", 9.0, true),
        ("ruby", "studio", 7.0, true),
        ("emerald", "ring", 30.0, false),
        ("quartz", "office", 5.0, true),
    ] {
        let shoot = |strength: f64, tint: &str| {
            let mut shoot = Shoot::new(&modern(), tint, light(name).unwrap());
            (shoot.samples, shoot.strength, shoot.light.head) = (8, strength, 12.0);
            (shoot.wavelengths, shoot.options.polarised) = (5, polarised);
            shoot.view.projection = Projection::Perspective { distance };
            shoot
        };
        for strength in [1.0, 0.4] {
            let found = differ(&shoot(strength, material), &shoot(strength, material));
            assert!(found < 0.005, "{material}, {name}, strength {strength}: {found}");
        }
        let mutant = differ(&shoot(1.0, material), &shoot(1.0, "cubic zirconia"));
        assert!(mutant > 0.01, "another material makes only {mutant}");
    }
}

#[test]
fn packets_lose_what_single_rays_lose() {
    let mut shoot = Shoot::new(&modern(), "ruby", light("studio").unwrap());
    let rest = |shoot: &Shoot| [shoot.by_rays().1, shoot.by_packets().1];
    let apart = |[a, b]: [brillianteer::picture::spectral::Remainder; 2]| {
        [(a.absorbed - b.absorbed).abs(), (a.unresolved - b.unresolved).abs()]
    };
    let found = apart(rest(&shoot));
    assert!(found[0] < 2e-4 && found[1] < 1e-5, "{found:?}");
    // A ray that may bounce but thrice leaves light unresolved.
    shoot.options.most_bounces = 3;
    let [single, packets] = rest(&shoot);
    assert!(single.unresolved > 5e-3, "{single:?}");
    let found = apart([single, packets]);
    assert!(found[0] < 2e-4 && found[1] < 1e-3, "{found:?}");
}

/// Two octahedra beside each other, the second one turned and smaller, so that light goes from one to the other.
fn two_stones(index: f64) -> Shoot {
    let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * 2.0 - 1.0;
    let planes: Vec<Plane> = (0..8).map(|k| Plane::new(corner(k) / 3.0_f64.sqrt(), 0.3)).collect();
    let body = Polytope::from_planes(&planes).unwrap();
    let stone = |index, at, turn, scale| {
        let glass = Material::from_index("glass", index).unwrap();
        Instance::new(body.clone(), glass).moved(&Pose { at, turn, scale })
    };
    let mut shoot = Shoot::new(&body, "diamond", light("studio").unwrap());
    shoot.scene.instances = vec![
        stone(1.7, DVec3::new(-0.4, 0.1, 0.2), DQuat::IDENTITY, 1.0),
        stone(index, DVec3::new(0.35, -0.2, 0.0), DQuat::from_rotation_y(0.5), 0.8),
    ];
    shoot.samples = 8;
    shoot
}

#[test]
fn packets_go_from_stone_to_stone() {
    let found = differ(&two_stones(1.6), &two_stones(1.6));
    assert!(found < 0.005, "{found}");
    assert!(differ(&two_stones(1.6), &two_stones(1.65)) > 0.01);
    let mut alone = two_stones(1.6);
    alone.scene.instances.pop();
    assert!(differ(&two_stones(1.6), &alone) > 0.1);
}

#[test]
fn a_stone_looks_the_same_wherever_it_stands() {
    // Under light from infinitely far away and by parallel rays. Single precision does not suffice for the farthest.
    let standing = |at: f64| {
        let mut shoot = Shoot::new(&modern(), "quartz", light("dome").unwrap());
        let pose = Pose { at: DVec3::new(at, 0.0, 0.0), turn: DQuat::IDENTITY, scale: 1.0 };
        shoot.scene.instances[0] = shoot.scene.instances[0].clone().moved(&pose);
        (shoot.view, shoot.centre, shoot.samples) = (View::default(), DVec2::new(at, 0.0), 8);
        shoot.by_packets().0
    };
    let near = standing(0.0);
    for at in [9.0, 900.0, 1e5] {
        let found = apart(&near, &standing(at));
        assert!(found < 0.005, "{at}: {found}");
    }
}

#[test]
fn packets_go_through_glass_shapes() {
    let shoot = |form: ImplicitForm| {
        let body = Body::Glass(SmoothSolid::new(ImplicitSurface::new(form).unwrap()));
        let mut shoot = Shoot::of(body, "quartz", light("dome").unwrap());
        // On longer ways between curved walls, rounding in single precision grows to other ways.
        (shoot.samples, shoot.wavelengths, shoot.options.most_bounces) = (24, 3, 6);
        shoot
    };
    let pill = |edge| ImplicitForm::Pill { size: DVec3::new(1.6, 0.8, 0.6), edge };
    let prism = ImplicitForm::Prism { size: DVec3::new(1.6, 0.9, 0.8), edge: 0.08 };
    // Light that leaves between two of its waves enters again.
    let plate = ImplicitForm::Plate {
        size: DVec3::new(1.6, 1.2, 0.3),
        edge: 0.05,
        amplitude: 0.05,
        wavelength: 0.8,
        phase: 0.0,
    };
    for form in [pill(0.2), prism, plate] {
        let found = differ(&shoot(form), &shoot(form));
        assert!(found < 0.005, "{form:?}: {found}");
    }
    assert!(differ(&shoot(pill(0.2)), &shoot(pill(0.23))) > 0.01);
}

/// A pill and a plate of glass, between which light goes.
fn two_shapes() -> Shoot {
    let pill = ImplicitForm::Pill { size: DVec3::new(1.0, 0.7, 0.6), edge: 0.2 };
    let plate = ImplicitForm::Plate {
        size: DVec3::new(1.2, 1.0, 0.3),
        edge: 0.05,
        amplitude: 0.05,
        wavelength: 0.8,
        phase: 0.0,
    };
    let body = |form| Body::Glass(SmoothSolid::new(ImplicitSurface::new(form).unwrap()));
    let mut shoot = Shoot::of(body(pill), "diamond", light("studio").unwrap());
    let moved = |x: f64| Pose { at: DVec3::X * x, turn: DQuat::from_rotation_y(0.5), scale: 0.6 };
    let diamond = material("diamond").unwrap();
    shoot.scene.instances = [(pill, -0.5), (plate, 0.5)]
        .map(|(form, x)| Instance::new(body(form), diamond.clone()).moved(&moved(x)))
        .into();
    (shoot.samples, shoot.wavelengths, shoot.size) = (64, 3, 32);
    shoot
}

#[test]
fn light_that_goes_on_by_chance_is_all_light_in_the_mean() {
    let all = two_shapes();
    let chance = || Shoot { by_chance: 0.1, ..two_shapes() };
    let [followed, drawn] = [&all, &chance()].map(|shoot| shoot.by_packets());
    assert_ne!(followed.0, drawn.0, "chance decides nothing");
    let found = apart(&followed.0, &drawn.0);
    assert!(found < 0.01, "{found}");
    assert!(drawn.1.unresolved <= followed.1.unresolved, "{:?}, {:?}", drawn.1, followed.1);
    // Without its weak light the picture is plainly another.
    let cut = Shoot { options: RayOptions { least_weight: 0.1, ..all.options }, ..two_shapes() };
    assert!(apart(&followed.0, &cut.by_packets().0) > 0.02);
    // In a white world nothing is lost, also where colour absorbs a part.
    for name in ["diamond", "ruby"] {
        let [followed, drawn] = [0.0, 0.1].map(|by_chance| {
            let mut white = two_shapes();
            (white.by_chance, white.light) = (by_chance, Light { head: 0.0, ..light("white").unwrap() });
            let own = material(name).unwrap();
            white.scene.instances.iter_mut().for_each(|stone| stone.material = own.clone());
            let (picture, rest) = white.by_packets();
            let mean = picture.pixels.iter().map(colour).sum::<DVec3>() / picture.pixels.len() as f64;
            (mean, rest.absorbed)
        });
        let (off, absorbed) = ((followed.0 - drawn.0).abs().max_element(), (followed.1 - drawn.1).abs());
        assert!(off < 3e-3 && absorbed < 3e-3, "{name}: {followed:?}, {drawn:?}");
        assert!(name == "ruby" || (drawn.0.y - 1.0).abs() < 3e-3, "{name}: {drawn:?}");
    }
}

#[test]
fn packets_are_equal_to_the_bit_on_any_number_of_cores() {
    let shoot = Shoot { samples: 2, by_chance: 0.1, ..two_shapes() };
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| shoot.by_packets().0)
    };
    assert!(on(1) == on(3));
}

#[test]
fn a_stone_of_colour_absorbs_on_every_way() {
    let mut shoot = Shoot::new(&modern(), "diamond", Light { head: 0.0, ..light("white").unwrap() });
    shoot.scene.instances[0].material = material("ruby").unwrap().clone();
    (shoot.backdrop, shoot.wavelengths) = (false, 1);
    let [(rays, lost), (packets, packets_lost)] = [shoot.by_rays(), shoot.by_packets()];
    let mean = |picture: &brillianteer::picture::Linear| {
        picture.pixels.iter().map(colour).sum::<DVec3>() / picture.pixels.len() as f64
    };
    assert!((mean(&rays) - mean(&packets)).abs().max_element() < 1e-5);
    assert!((lost.absorbed - packets_lost.absorbed).abs() < 1e-5, "{lost:?} {packets_lost:?}");
}
