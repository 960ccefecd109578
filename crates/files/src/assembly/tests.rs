//! Tests of how stones and scenes are loaded.

use super::*;
use brillianteer_optics::material;

fn load(file: impl AsRef<Path>) -> Assembly {
    Assembly::load(file.as_ref(), None, None, &MeshOptions::default()).unwrap()
}

/// Returns the error message for a scene file with these stones, its temporary path shortened to `x.toml`.
fn refused(stones: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.toml");
    std::fs::write(&path, format!("format = 1\nname = \"x\"\n{stones}")).unwrap();
    let Err(Failure::Input(message)) = Assembly::load(&path, None, None, &MeshOptions::default()) else {
        panic!("no input error")
    };
    message.replace(&path.display().to_string(), "x.toml").replace(&folder.path().display().to_string(), "")
}

#[test]
fn a_stone_alone_lies_as_its_file_has_it_and_takes_another_material_and_size() {
    let stone = load("modern-ideal");
    let specimen = BuiltDesign::load(Path::new("modern-ideal"), &MeshOptions::default()).unwrap();
    assert_eq!(*stone.scene.instances[0].body.stone().unwrap(), *specimen.stone().unwrap());
    assert_eq!((stone.scene.unit_mm, stone.name.as_str()), (3.25, "Modern ideal"));
    assert_eq!(stone.scene.instances[0].pose, Pose::STILL);
    // In the trade a brilliant of 6.5 mm weighs about one carat; proportions change it a little.
    assert!(stone.carats().is_some_and(|carats| (0.97..1.03).contains(&carats)), "{:?}", stone.carats());
    let ruby = Assembly::load(
        Path::new("modern-ideal"),
        Some(&MaterialRef::Name("Ruby".into())),
        "2ct".parse().ok(),
        &MeshOptions::default(),
    )
    .unwrap();
    assert_eq!(&ruby.scene.instances[0].material, material("ruby").unwrap());
    assert!((ruby.carats().unwrap() - 2.0).abs() < 1e-9);
    let index = Assembly::load(
        Path::new("modern-ideal"),
        Some(&MaterialRef::Index(2.42)),
        "8mm".parse().ok(),
        &MeshOptions::default(),
    )
    .unwrap();
    assert_eq!((index.scene.unit_mm, index.carats()), (4.0, None));
    let heavy = Assembly::load(
        Path::new("modern-ideal"),
        Some(&MaterialRef::Index(2.42)),
        "1ct".parse().ok(),
        &MeshOptions::default(),
    );
    assert!(matches!(heavy, Err(Failure::Input(_))));
}

#[test]
fn every_scene_that_comes_with_the_program_is_apart_and_weighs_what_it_asks_for() {
    let trilogy = load("trilogy");
    let weights: Vec<f64> =
        trilogy.scene.instances.iter().map(|s| s.carats(trilogy.scene.unit_mm).unwrap()).collect();
    assert!(weights.iter().zip([0.5, 1.0, 0.5]).all(|(a, b)| (a - b).abs() < 1e-9), "{weights:?}");
    assert_eq!(trilogy.look.light, "studio");
    for (name, count) in [("trilogy", 3), ("Ring", 8), ("parcel", 12)] {
        let scene = load(name);
        assert_eq!((scene.scene.instances.len(), scene.places.len()), (count, count));
        assert!(
            scene
                .scene
                .instances
                .iter()
                .all(|s| s.body.names().len() == s.body.stone().unwrap().polytope.facets().len())
        );
        let largest = scene.places.iter().map(|p| p.diameter_mm).fold(0.0, f64::max);
        assert_eq!(scene.scene.unit_mm, 0.5 * largest);
        assert_eq!(load(name).scene, scene.scene);
    }
    // The strengths are those of the demonstration that they follow.
    for (name, count, strength) in [
        ("subtle-pill", 4, 0.035),
        ("prism-rainbow", 4, 0.155),
        ("rotating-cube", 4, 0.15),
        ("wavy-plate", 4, 0.2),
        ("free-diamond", 1, 0.2),
    ] {
        let scene = load(name);
        assert_eq!(scene.scene.instances.len(), count, "{name}");
        assert_eq!(scene.look.strength, strength, "{name}");
        assert!(scene.look.background.is_some() && scene.angle_of_view == Some(45.0), "{name}");
        if name == "subtle-pill" {
            // Pills do not lean, and are as wide as in the demonstration.
            let (low, high) = scene.scene.instances[0].solid().bounds();
            let wide = (high - low).x * scene.scene.unit_mm;
            assert!((wide - 40.0).abs() < 0.02, "{wide}");
        }
    }
    let small = Assembly::load(
        Path::new("ring"),
        Some(&MaterialRef::Name("diamond".into())),
        "3mm".parse().ok(),
        &MeshOptions::default(),
    )
    .unwrap();
    assert!(small.places.iter().all(|p| p.diameter_mm == 3.0));
    assert!(small.scene.instances.iter().all(|s| s.material.name == "diamond"));
}

#[test]
fn a_stone_leans_its_table_toward_the_azimuth_and_lies_where_it_is_put() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.toml");
    let stone = "cut = \"tolkowsky\"\nturn = 30\ntilt = 20\nazimuth = 90\nsize = \"4mm\"\nat = [1, 2, 3]";
    std::fs::write(&path, format!("format = 1\nname = \"x\"\n[[stone]]\n{stone}")).unwrap();
    let scene = load(&path);
    let placed = &scene.scene.instances[0];
    let table = placed.body.names().iter().position(|name| name == "table").unwrap();
    let (sin, cos) = 20_f64.to_radians().sin_cos();
    let plane = placed.body.stone().unwrap().polytope.facets()[table].plane.placed(&placed.pose);
    assert!(plane.normal.distance(DVec3::new(0.0, sin, cos)) < 1e-12);
    // Pictures are centred on the middle of all stones.
    let (low, high) = placed.solid().bounds();
    assert!((low + high).length() < 1e-12);
    assert_eq!((scene.scene.unit_mm, scene.places[0].at_mm), (2.0, DVec3::new(1.0, 2.0, 3.0)));
}

#[test]
fn stones_in_one_anothers_way_and_cuts_that_are_not_there_are_named() {
    let two = |x: f64, cut: &str| {
        refused(&format!(
            "[[stone]]\ncut = \"tolkowsky\"\nat = [0, 0, 0]\n[[stone]]\ncut = \"{cut}\"\nat = [{x}, 0, 0]\n"
        ))
    };
    let message = two(6.4, "shallow");
    assert_eq!(message, "x.toml: stone 1 (tolkowsky) and stone 2 (shallow) overlap; move one of them away");
    assert_eq!(
        two(9.0, "shalow"),
        "x.toml:6: stone 2: cut: /shalow: there is no such file; did you mean the cut 'shallow'?"
    );
    let message = refused("[[stone]]\ncut = \"shallow\"\nmaterial = 2.4\nsize = \"1ct\"");
    assert!(
        message.starts_with("x.toml:3: stone 1: size: a weight in ct needs a density, which index 2.4 lacks"),
        "{message}"
    );
}

#[test]
fn copies_of_one_design_move_and_nothing_else_does() {
    let scene = |tables: &str| {
        let text = format!("format = 1\nname = \"x\"\n{tables}");
        Assembly::of(Path::new("x.toml"), scene_file::parse(&text, "x.toml", None).unwrap()).unwrap()
    };
    let plates = "stone = [{ cut = \"plate\", at = [-30, 0, 0] }, { cut = \"plate\", at = [30, 0, 0] }]";
    let seen = |movement: &str, asked: Option<Movement>| {
        let rest = scene(&format!("{movement}{plates}"));
        let before = rest.scene.clone();
        let moved = rest.at_moment(1.3, asked).unwrap().scene;
        let turned = |k: usize| moved.instances[k].pose.turn.angle_between(before.instances[k].pose.turn);
        assert!(
            (0..2).all(|k| moved.instances[k].pose.at.distance(before.instances[k].pose.at) < 1e-9)
                && moved.instances.iter().zip(&before.instances).all(|(a, b)| a.pose.scale == b.pose.scale)
        );
        let waves = !moved.instances[0].body.solid().is_same(before.instances[0].body.solid());
        (turned(0) > 0.3 && turned(1) > 0.3, waves)
    };
    assert_eq!(seen("", None), (true, true));
    assert_eq!(seen("movement = \"wave\"\n", None), (false, true));
    assert_eq!(seen("movement = \"wave\"\n", Some(Movement::Tumble)), (true, false));
    let two = "stone = [{ cut = \"plate\", at = [-30, 0, 0] }, { cut = \"cube\", at = [30, 0, 0] }]";
    let error = scene(two).at_moment(1.0, None).unwrap_err().to_string();
    assert!(error.starts_with("x.toml: only stones of one design move"), "{error}");
}

#[test]
fn metal_lies_where_it_is_put_beside_stones_or_alone_and_may_cut_into_them() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("plate.obj"), "v 0 0 0\nv 4 0 0\nv 0 8 0\nf 1 2 3\n").unwrap();
    let path = folder.path().join("x.toml");
    let scene = |tables: &str| {
        std::fs::write(&path, format!("format = 1\nname = \"x\"\n{tables}")).unwrap();
        Assembly::load(&path, None, None, &MeshOptions::default())
    };
    let metal = "[[metal]]\nmesh = \"plate.obj\"\nmetal = \"gold\"\nturn = 90\nat = [1, 2, 3]\n";
    let both = scene(&format!("[[stone]]\ncut = \"tolkowsky\"\nsize = \"6mm\"\n{metal}")).unwrap().scene;
    assert_eq!((both.unit_mm, both.metals[0].metal), (3.0, brillianteer_optics::Metal::Gold));
    // Seen from the stone, the corners are in the places of the file.
    let at =
        |k: usize| (both.metals[0].vertices().nth(k).unwrap() - both.instances[0].pose.at) * both.unit_mm;
    assert!(at(0).distance(DVec3::new(1.0, 2.0, 3.0)) < 1e-12);
    assert!(
        at(1).distance(DVec3::new(1.0, 6.0, 3.0)) < 1e-12
            && at(2).distance(DVec3::new(-7.0, 2.0, 3.0)) < 1e-12
    );
    let alone = scene(metal).unwrap().scene;
    assert_eq!((alone.instances.len(), alone.unit_mm), (0, 4.0));
    let (low, high) = bounds(alone.vertices());
    assert!((low + high).length() < 1e-12);
    let error = scene("[[metal]]\nmesh = \"none.obj\"\nmetal = \"gold\"").unwrap_err().to_string();
    assert!(error.contains("x.toml:3: metal 1: mesh: ") && error.contains("none.obj"), "{error}");
    // Glass that is open is refused, with the place of its hole.
    let error = scene("[[stone]]\ncut = \"plate.obj\"").unwrap_err().to_string();
    assert!(error.contains("the surface is open: 3 edges") && error.contains("(4, 0, 0)"), "{error}");
}

#[test]
fn a_scene_takes_the_bodies_of_one_mesh_one_by_one() {
    let folder = tempfile::tempdir().unwrap();
    let mut text = String::new();
    // Two pyramids, one of them twice as high.
    for (body, height) in [1.0, 2.0].into_iter().enumerate() {
        let x = 10.0 * body as f64;
        text += &format!("o pyramid {height}\nv {x} -1 0\nv {} 0 0\nv {x} 1 0\nv {} 0 0\n", x + 1.0, x - 1.0);
        text += &format!("v {x} 0 {height}\n");
        for face in ["-2 -3 -4 -5", "-5 -4 -1", "-4 -3 -1", "-3 -2 -1", "-2 -5 -1"] {
            text += &format!("f {face}\n");
        }
    }
    std::fs::write(folder.path().join("two.obj"), text).unwrap();
    let stone =
        |part: &str, x: f64| format!("[[stone]]\ncut = \"two.obj\"\npart = {part}\nat = [{x}, 0, 0]\n");
    let scene = format!("format = 1\nname = \"x\"\n{}{}", stone("1", 0.0), stone("\"Pyramid 2\"", 20.0));
    let path = folder.path().join("x.toml");
    std::fs::write(&path, scene).unwrap();
    let bodies = load(&path);
    let [low, high] = [0, 1].map(|k| bodies.scene.instances[k].body.solid().volume());
    assert!(high > 1.5 * low, "{low} {high}");
    // The scene chooses the bodies, so that nothing is left to choose.
    assert!(bodies.other_readings.iter().all(|other| !other.of_bodies), "{:?}", bodies.other_readings);
    let alone = load(folder.path().join("two.obj"));
    assert!(alone.other_readings[0].of_bodies && alone.other_readings[0].path.ends_with("two.obj"));
    std::fs::write(&path, "format = 1\nname = \"x\"\n[[stone]]\ncut = \"two.obj\"\n").unwrap();
    assert!(load(&path).other_readings[0].of_bodies);
}
