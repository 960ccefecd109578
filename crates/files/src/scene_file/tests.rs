//! Tests of scene files: permitted and refused contents, and the messages about faults.

use super::*;
use crate::library;
use brillianteer_optics::line::SODIUM_D;
use brillianteer_scene::{LOOK_NUMBERS, POLISHED};

const TRILOGY: &str = "format = 1\nname = \"Three\"\nlight = \"studio\"\nlayout = \"row\"\ngap_mm = 0.6\n\
                       [[stone]]\ncut = \"modern-ideal\"\nmaterial = \"ruby\"\nsize = \"1ct\"\ncount = 2\n\
                       [[stone]]\ncut = \"tolkowsky\"\nturn = 10\ntilt = 15.0\nazimuth = 90\n";

const PLACED: &str = "format = 1\nname = \"Two\"\n[[stone]]\ncut = \"shallow\"\nat = [0, 0, 0]\n\
                      [[stone]]\ncut = \"fisheye\"\nmaterial = { index = 1.5 }\nat = [8, -1.5, 2]\n";

fn with(text: &str, part: &str, other: &str) -> String {
    assert!(text.contains(part), "the file has no {part}");
    text.replacen(part, other, 1)
}

#[track_caller]
fn assert_refused(text: &str, expected: &str) {
    let message = parse(text, "x.toml", None).unwrap_err().to_string();
    assert!(message.starts_with(expected), "{message}\ninstead of\n{expected}");
}

#[test]
fn a_layout_and_places_read_as_written() {
    let scene = parse(TRILOGY, "x.toml", None).unwrap();
    assert_eq!((scene.name.as_str(), scene.layout, scene.gap_mm), ("Three", Some(Layout::Row), 0.6));
    assert_eq!(scene.look.light, "studio");
    let plain = Entry {
        cut: "tolkowsky".to_owned(),
        part: crate::mesh_options::MeshPart::Found,
        material: None,
        size: None,
        count: 1,
        turn: 10.0,
        tilt: 15.0,
        azimuth: 90.0,
        at_mm: DVec3::ZERO,
        line: 11,
    };
    assert_eq!(scene.stones[1], plain);
    let [first, _] = &scene.stones[..] else { panic!("two kinds") };
    assert_eq!((first.size, first.count, first.line), (Some(Size::Carats(1.0)), 2, 6));
    assert_eq!(first.material, Some(MaterialRef::Name("ruby".to_owned())));
    let scene = parse(PLACED, "x.toml", None).unwrap();
    assert_eq!((scene.layout, scene.look.light.as_str(), scene.gap_mm), (None, "studio", DEFAULT_GAP_MM));
    assert_eq!(scene.stones[1].at_mm, DVec3::new(8.0, -1.5, 2.0));
    let glass = scene.stones[1].material.as_ref().unwrap().material().unwrap();
    assert_eq!(glass.index(SODIUM_D), 1.5);
    assert_eq!((&scene.look.background, scene.look.background_mm, scene.look.strength), (&None, None, 1.0));
    let behind = with(
        PLACED,
        "[[stone]]",
        "background = \"Page\"\nbackground_distance_mm = 12\nstrength = 0.5\nlight_turn = 30\nlight_upright = true\nangle_of_view = 45\nexposure = -0.5\n\
            [[stone]]",
    );
    let scene = parse(&behind, "x.toml", None).unwrap();
    assert_eq!(scene.look.background, Some(BackgroundRef::Pattern(brillianteer_scene::Pattern::Page)));
    assert_eq!((scene.look.background_mm, scene.look.strength), (Some(12.0), 0.5));
    assert_eq!((scene.angle_of_view, scene.look.exposure), (Some(45.0), -0.5));
    assert_eq!((scene.look.light_turn, scene.look.light_upright), (30.0, true));
    let scene = parse(&behind.replace("Page", "City"), "x.toml", None).unwrap();
    assert_eq!(scene.look.background, Some(BackgroundRef::World(brillianteer_scene::World::City)));
    let world = with(PLACED, "[[stone]]", "light = \"room\"\n[[stone]]");
    assert_eq!(parse(&world, "x.toml", None).unwrap().look.light, "room");
    let alone = "format = 1\nname = \"One\"\nstone = [{ cut = \"shallow\" }]";
    assert_eq!(parse(alone, "x.toml", None).unwrap().stones.len(), 1);
}

#[test]
fn a_stone_may_be_one_of_several_bodies_of_a_mesh() {
    for (given, part) in [
        ("2", MeshPart::Number(2)),
        ("\"2\"", MeshPart::Number(2)),
        ("\"left\"", MeshPart::Named("left".into())),
        ("\"all\"", MeshPart::All),
    ] {
        let text = with(PLACED, "at = [0, 0, 0]", &format!("part = {given}\nat = [0, 0, 0]"));
        let scene = parse(&text, "x.toml", None).unwrap();
        assert_eq!((&scene.stones[0].part, &scene.stones[1].part), (&part, &MeshPart::Found));
        let again = parse(&write(&scene), "again.toml", None).unwrap();
        assert_eq!((&again.stones[0].part, &again.stones[1].part), (&part, &MeshPart::Found));
    }
    for given in ["0", "\"\"", "[1]"] {
        let text = with(PLACED, "at = [0, 0, 0]", &format!("part = {given}\nat = [0, 0, 0]"));
        assert_refused(
            &text,
            "x.toml:5: stone.part: the number of a body, from 1, its name, or \"all\" is expected",
        );
    }
}

#[test]
fn what_is_wrong_with_a_scene_is_told_with_line_and_key() {
    for (part, other, message) in [
        ("format = 1", "", "x.toml:1: format: the key is missing"),
        ("\"Three\"", "\"\"", "x.toml:2: name: a name of 1 to 200 printable characters"),
        (
            "\"studio\"",
            "\"stduio\"",
            "x.toml:3: light: 'stduio' is neither a light of the program nor a file",
        ),
        ("\"row\"", "\"rig\"", "x.toml:4: layout: 'rig' is unknown; did you mean 'ring'? known: row, ring"),
        ("\"row\"", "4", "x.toml:4: layout: invalid type: integer `4`, expected text (row, ring or parcel)"),
        ("0.6", "-1", "x.toml:5: gap_mm: -1 must be from 0 to 1000 mm"),
        ("layout = \"row\"\n", "", "x.toml:4: gap_mm: only a layout has gaps"),
        (
            "gap_mm",
            "gap",
            "x.toml:5: unknown key `gap`, known here are `format`, `name`, `light`, `light_upright`",
        ),
        (
            "\"ruby\"",
            "\"rubby\"",
            "x.toml:8: stone 1: material: unknown material 'rubby'; did you mean 'ruby'?",
        ),
        ("\"ruby\"", "{ index = 9 }", "x.toml:8: stone 1: index: the index 9 must be from 1"),
        ("\"ruby\"", "{ }", "x.toml:8: stone 1: material: one of index, sellmeier"),
        ("\"1ct\"", "1", "x.toml:9: stone.size: '1' has no unit; write 1mm for the girdle's diameter or 1ct"),
        ("\"1ct\"", "\"1 inch\"", "x.toml:9: stone.size: '1 inch' is not a size"),
        ("\"1ct\"", "[[1, 2]]", "x.toml:9: stone.size: a list is not a size"),
        ("count = 2", "count = 0", "x.toml:10: stone 1: count: 0 must be at least 1"),
        (
            "count = 2",
            "count = 256",
            "x.toml:11: stone 2: count: 1 must be at least 1, and all together at most",
        ),
        ("count = 2", "at = [0, 0, 0]", "x.toml:10: stone 1: at: the layout says where the stones are"),
        (
            "cut = \"tolkowsky\"\n",
            "",
            "x.toml:11: stone: the key `cut` is missing (a cut's name, or a cut file)",
        ),
        ("turn = 10", "turn = nan", "x.toml:13: stone 2: turn: NaN must be from"),
        ("15.0", "181", "x.toml:14: stone 2: tilt: 181 must be from -180 to 180 degrees"),
        ("azimuth", "azimut", "x.toml:15: stone: unknown key `azimut`"),
    ] {
        assert_refused(&with(TRILOGY, part, other), message);
    }
    for (lines, message) in [
        ("background = \"pages\"", "x.toml:3: background: background 'pages' (did you mean 'page'?): give"),
        ("background = \"none.png\"", "x.toml:3: background: none.png: there is no such file"),
        (
            "background = 3",
            "x.toml:3: background: invalid type: integer `3`, expected text (a colour, light,",
        ),
        (
            "background_distance_mm = 3",
            "x.toml:3: background_distance_mm: only a pattern, a world or a photograph",
        ),
        (
            "background = \"black\"\nbackground_distance_mm = 3",
            "x.toml:4: background_distance_mm: only a pattern",
        ),
        (
            "background = \"page\"\nbackground_distance_mm = -3",
            "x.toml:4: background_distance_mm: -3 must be from 0",
        ),
        ("strength = 1.5", "x.toml:3: strength: 1.5 must be from 0 to 1"),
        ("strength = nan", "x.toml:3: strength: NaN must be"),
        (
            "movement = \"waves\"",
            "x.toml:3: movement: 'waves' is unknown; did you mean 'wave'? known: both, tumble, wave",
        ),
        ("angle_of_view = 0.5", "x.toml:3: angle_of_view: 0.5 must be from 1 to 120 degrees"),
        ("exposure = 50", "x.toml:3: exposure: 50 must be from -40 to 40 stops"),
        (
            "exposure = \"dark\"",
            "x.toml:3: exposure: invalid type: string \"dark\", expected a number (-40 to 40 stops)",
        ),
        ("wavelengths = 2.5", "x.toml:3: wavelengths: 2.5 must be a whole number from 1 to 64"),
        ("head = 90", "x.toml:3: head: 90 must be from 0 to 89 degrees"),
        ("tone = \"vivid\"", "x.toml:3: tone: tone 'vivid': give neutral, filmic or linear"),
        ("exposrue = 1", "x.toml:3: unknown key `exposrue`"),
    ] {
        assert_refused(&with(PLACED, "[[stone]]", &format!("{lines}\n[[stone]]")), message);
    }
    for (part, other, message) in [
        ("at = [8, -1.5, 2]", "", "x.toml:6: stone 2: at is missing: give [x, y, z] in mm, or a layout"),
        ("at = [8, -1.5, 2]", "at = [8, 1]", "x.toml:9: stone.at: invalid length 2"),
        ("-1.5", "-1e9", "x.toml:9: stone 2: at: -1000000000 must be from -10000 to 10000 mm"),
        ("at = [0, 0, 0]", "count = 3", "x.toml:5: stone 1: count: several stones cannot be in one place"),
    ] {
        assert_refused(&with(PLACED, part, other), message);
    }
    assert_refused("format = 1\nname = \"none\"\nstone = []", "x.toml:3: stone: the list is empty");
    assert_refused("format = 1\nname = \"none\"", "x.toml:1: the key `stone` is missing");
}

const SET: &str = "format = 1\nname = \"Set\"\n[[stone]]\ncut = \"shallow\"\n[[metal]]\nmesh = \"ring.obj\"\nmetal = \"gold\"\n\
                   roughness = 0.25\ntilt = 90\nazimuth = 180\nat = [0, 0, -3]\n[[metal]]\nmesh = \"b.stl\"\nmetal = \"rhodium\"\nscale = 1000\n";

#[test]
fn metal_is_read_as_written_and_told_with_line_and_key_where_it_is_at_fault() {
    let scene = parse(SET, "x.toml", None).unwrap();
    let [ring, other] = &scene.metals[..] else { panic!("two bodies") };
    assert_eq!(
        (ring.mesh.as_str(), ring.metal, ring.roughness, ring.line),
        ("ring.obj", Metal::Gold, 0.25, 5)
    );
    assert_eq!((ring.tilt, ring.azimuth, ring.at_mm, ring.scale), (90.0, 180.0, DVec3::NEG_Z * 3.0, 1.0));
    assert!((ring.turned() * DVec3::Z).distance(DVec3::NEG_X) < 1e-12);
    assert_eq!((other.metal, other.roughness, other.scale), (Metal::Rhodium, POLISHED, 1000.0));
    // Metal may stand alone.
    let alone = SET.replace("[[stone]]\ncut = \"shallow\"\n", "");
    assert_eq!(parse(&alone, "x.toml", None).unwrap().stones, []);
    assert!(is_meant_as_scene(&alone));
    for (part, other, message) in [
        (
            "\"gold\"",
            "\"glod\"",
            "x.toml:7: metal 1: metal: 'glod' is unknown; did you mean 'gold'? known: gold, platinum",
        ),
        ("0.25", "1.5", "x.toml:8: metal 1: roughness: 1.5 must be from 0, a mirror, to 1"),
        ("0.25", "nan", "x.toml:8: metal 1: roughness: NaN must be"),
        ("= 90", "= 900", "x.toml:9: metal 1: tilt: 900 must be from -180 to 180 degrees"),
        ("-3]", "-3e9]", "x.toml:11: metal 1: at: -3000000000 must be"),
        ("= 1000", "= 0", "x.toml:15: metal 2: scale: 0 must be from 0.000001 to 1000000 mm"),
        ("mesh = \"b.stl\"\n", "", "x.toml:12: metal: the key `mesh` is missing"),
        ("scale", "scael", "x.toml:15: metal: unknown key `scael`"),
    ] {
        assert_refused(&with(SET, part, other), message);
    }
}

#[test]
fn a_scene_is_told_from_a_cut_even_where_it_is_at_fault() {
    assert!(is_meant_as_scene(TRILOGY) && is_meant_as_scene(PLACED));
    assert!(is_meant_as_scene("format = 1\nlayout = \"ring\"\n[[stones]]\n"));
    assert!(is_meant_as_scene("name = \"open\n[[stone]]\n"));
    assert!(
        !is_meant_as_scene(include_str!("../../../../cuts/tolkowsky.toml")) && !is_meant_as_scene("stone")
    );
}

#[test]
fn a_light_may_be_a_file_beside_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("lamp.toml"), "").unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, with(TRILOGY, "\"studio\"", "\"lamp.toml\"")).unwrap();
    assert!(is_scene(&path));
    assert_eq!(read(&path).unwrap().look.light, folder.path().join("lamp.toml").to_string_lossy());
}

proptest::proptest! {
    #[test]
    fn no_text_makes_it_panic(
        text in proptest::prelude::any::<String>(),
        at in 0_usize..300,
        patch in "[-0-9a-z\\[\\]{}=.,\"'\n ]{0,6}",
    ) {
        let _ = parse(&text, "x.toml", None);
        for whole in [TRILOGY, PLACED] {
            let (start, end) = whole.split_at(at.min(whole.len()));
            let _ = parse(&format!("{start}{patch}{end}"), "x.toml", None);
        }
    }
}

#[test]
fn what_is_written_reads_back_as_the_same_scene() {
    let all = "glow = 0.5\ntone = \"filmic\"\nwavelengths = 3\nbounces = 7\nhead = 12.5\nlight = \"dome\"\nlight_turn = -7.5\n\
               light_upright = true\nexposure = 2";
    let behind = |text: &str| {
        with(
            PLACED,
            "[[stone]]",
            &format!("{text}\n{all}\nstrength = 0.25\nmovement = \"tumble\"\n[[stone]]"),
        )
    };
    let alone = "format = 1\nname = \"One\"\nstone = [{ cut = \"shallow\", turn = 1e5, size = \"0.37ct\" }]";
    let own = "material = { name = \"mine\", index = 1.7, density = 3.1 }";
    let [own, pattern, colours] = [
        with(PLACED, "material = { index = 1.5 }", own),
        behind("background = \"Dots\"\nbackground_distance_mm = 12.5\nangle_of_view = 45"),
        behind("background = \"#404850-#101215\""),
    ];
    let library = library::SCENES.into_iter().map(|(_, text)| text);
    let ours = [TRILOGY, PLACED, SET, alone, &own, &pattern, &colours];
    for text in ours.into_iter().chain(library) {
        let lineless = |mut scene: SceneFile| {
            scene.stones.iter_mut().for_each(|entry| entry.line = 0);
            scene.metals.iter_mut().for_each(|entry| entry.line = 0);
            scene.ring.iter_mut().for_each(|entry| entry.line = 0);
            scene
        };
        let scene = lineless(parse(text, "x.toml", None).unwrap());
        let again = lineless(parse(&write(&scene), "again.toml", None).unwrap());
        assert_eq!(scene, again);
    }
    // Numbers stand in the order of their rows, and not of their keys.
    let text = write(&parse(&pattern, "x.toml", None).unwrap());
    let places: Vec<usize> =
        LOOK_NUMBERS.iter().filter_map(|row| text.find(&format!("\n{} = ", row.key))).collect();
    assert!(places.len() > 6 && places.is_sorted(), "{text}");
}

#[test]
fn any_turn_is_told_in_three_angles() {
    let mut turns = vec![DQuat::IDENTITY, DQuat::from_rotation_x(std::f64::consts::PI)];
    for k in 0..200 {
        let [a, b, c] = [1.7, 0.9, 2.3].map(|step| f64::from(k) * step);
        turns.push(DQuat::from_euler(glam::EulerRot::ZYX, a, b, c));
    }
    for turned in turns {
        let entry = Entry::placed("cube", turned, DVec3::ONE);
        assert!((0.0..=180.0).contains(&entry.tilt), "{entry:?}");
        assert!(
            entry.turned(0.0).dot(turned).abs() > 1.0 - 1e-12,
            "{turned} came back as {}",
            entry.turned(0.0)
        );
    }
}
