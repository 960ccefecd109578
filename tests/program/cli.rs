//! The program as a user runs it: real files in, real files out, messages, exit codes.
#![cfg(feature = "cli")]

mod cutting;
mod desk;
mod documents;
mod ends;
mod faults;
mod helps;
mod maps;
mod meshes;
mod newcomers;
mod outputs;
mod panes;
mod pictures;
mod recorder;
mod renders;
mod reports;
mod results;
mod searching;
mod spins;
#[cfg(target_os = "linux")]
mod starts;
mod streams;
mod sweeps;

use brillianteer::io::light_file;
use brillianteer::picture::PictureName;
use brillianteer::scene::{LIGHTS, light};
use desk::*;
use glam::{DVec2, DVec3};
use serde_json::{Value, json};
use std::collections::BTreeMap;
#[cfg(feature = "gpu")]
use std::io::Write;

const ZONES: [&str; 4] = ["green", "red", "blue", "below"];
const PARTS: [&str; 3] = ["surface", "transmitted", "strongest_exit_area"];

/// Returns the share of unpolarised light that a surface of this index reflects at this cosine of the angle of incidence.
fn reflected(index: f64, cos_i: f64) -> f64 {
    let cos_t = (1.0 - (1.0 - cos_i * cos_i) / index.powi(2)).sqrt();
    let share = |a: f64, b: f64| ((a - b) / (a + b)).powi(2);
    (share(cos_i, index * cos_t) + share(index * cos_i, cos_t)) / 2.0
}

/// Runs `measure` and checks the laws that all figures obey.
fn measured(desk: &Desk, options: &str) -> Value {
    let figures = desk.json(&format!("measure --json {options}"));
    let keys = |v: &Value| v.as_object().unwrap().keys().map(String::as_str).collect::<Vec<_>>().join(" ");
    let documented = "file name scope silhouette_area light_return light_return_with_glare surface transmitted \
        strongest_exit_area absorbed unresolved beams material index wavelength_nm head_deg tracer polarised view";
    assert_eq!(keys(&figures).trim_end_matches(" standard_error"), documented);
    for (part, also) in PARTS.into_iter().zip(["", "", " undecided"]) {
        let zones =
            if options.contains("--head") { "green red blue below head" } else { "green red blue below" };
        assert_eq!(keys(&figures[part]), format!("{zones}{also}"));
    }
    near(energy(&figures), 1.0, 1e-9, options);
    let lit = |part: &str| {
        ["green", "red", "blue"].map(|zone| at(&figures, &format!("{part}/{zone}"))).iter().sum()
    };
    let [inner, glare]: [f64; 2] = ["transmitted", "surface"].map(lit);
    near(at(&figures, "light_return"), inner, 1e-12, options);
    near(at(&figures, "light_return_with_glare"), inner + glare, 1e-12, options);
    near(sum(&figures["strongest_exit_area"]), 1.0, 1e-9, options);
    figures
}

#[test]
fn the_light_of_a_cube_is_that_of_closed_forms_under_every_option() {
    let desk = Desk::new();
    let term = |b: f64, c: f64, l: f64| b * l * l / (l * l - c * c);
    let diamond = |l: f64| (1.0 + term(4.3356, 0.1060, l) + term(0.3306, 0.1750, l)).sqrt();
    let d = diamond(0.5893);
    for (options, index) in [
        ("", d),
        ("--index 1.5", 1.5),
        ("--wavelength 486.1", diamond(0.4861)),
        ("--unpolarised", d),
        ("--head 20", d),
        ("--tracer ray", d),
    ] {
        // Light goes up and down between two faces: a geometric series.
        let figures = measured(&desk, &format!("cube.toml --unresolved 1e-7 {options}"));
        let above = if options.contains("head") { "head" } else { "blue" };
        let r = reflected(index, 1.0);
        near(at(&figures, "index"), index, 1e-12, options);
        near(at(&figures, &format!("surface/{above}")), r, 1e-9, options);
        near(at(&figures, &format!("transmitted/{above}")), (1.0 - r) * r / (1.0 + r), 1e-7, options);
        near(at(&figures, "transmitted/below"), (1.0 - r) / (1.0 + r), 1e-7, options);
        assert!(at(&figures, "unresolved") <= 1e-7, "{options}");
        assert_eq!(figures["tracer"], if options.contains("ray") { "ray" } else { "beam" });
        assert_eq!(figures["polarised"], !options.contains("unpolarised"));
    }
    // The tilt of a stone turns its glare by twice the tilt, the tilt of the eye only once.
    let (sin, cos) = 10_f64.to_radians().sin_cos();
    for (lean, azimuth, above) in [("tilt", 180, "red"), ("eye_tilt", 0, "blue"), ("eye_tilt", 45, "blue")] {
        let option = lean.replace('_', "-");
        let figures =
            measured(&desk, &format!("cube.toml --exact --index 2 --{option} 10 --azimuth {azimuth}"));
        let (faces, across) = if azimuth == 45 { (2.0, sin * 0.5_f64.sqrt()) } else { (1.0, sin) };
        let (top, sides) = (cos / (cos + faces * across), faces * across / (cos + faces * across));
        near(at(&figures, "silhouette_area"), 4.0 * (cos + faces * across), 1e-9, lean);
        near(at(&figures, &format!("surface/{above}")), reflected(2.0, cos) * top, 1e-9, lean);
        near(at(&figures, "surface/below"), reflected(2.0, across) * sides, 1e-9, lean);
        let mut view = json!({ "side": "table", "tilt": 0.0, "eye_tilt": 0.0, "projection": "orthographic" });
        (view[lean], view["azimuth"]) = (json!(10.0), json!(f64::from(azimuth)));
        assert_eq!(figures["view"], view);
    }
    // The table leans toward the azimuth, so that the eye sees the flank on the other side.
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    for (view, width) in [("--eye-tilt 30", 2.5 * cos + 2.0 * sin), ("--tilt 30", 1.5 * cos + 2.0 * sin)] {
        for same in [view.to_string(), view.replace("30", "-30 --azimuth 180")] {
            let figures = measured(&desk, &format!("slanted.toml --unresolved 0.05 {same}"));
            near(at(&figures, "silhouette_area"), 2.0 * width, 1e-9, &same);
        }
    }
}

#[test]
fn figures_say_what_is_estimated_and_how_far_off_it_may_be() {
    let desk = Desk::new();
    let view = "modern-ideal --tilt 12 --azimuth 25";
    let [usual, bound] =
        ["", " --unresolved 0.002"].map(|more| desk.json(&format!("measure --json {view}{more}")));
    assert!(
        bound["estimated"].is_null() && desk.json("measure --json tolkowsky --exact")["estimated"].is_null()
    );
    let error = |zone: &str| at(&usual, &format!("estimated/standard_error/transmitted/{zone}"));
    for zone in ZONES {
        let [found, estimated] =
            ["", "estimated/"].map(|part| at(&usual, &format!("{part}transmitted/{zone}")));
        let (certain, slack) = (at(&bound, &format!("transmitted/{zone}")), 5.0 * error(zone));
        assert!((1e-7..=1e-4).contains(&error(zone)), "{zone}: {}", error(zone));
        assert!(found - estimated <= certain + at(&bound, "unresolved"), "{zone}");
        assert!(
            (certain - slack..=certain + at(&bound, "unresolved") + slack).contains(&found),
            "{zone}: {found}"
        );
    }
    let placed = sum(&usual["estimated"]["transmitted"]) + at(&usual, "estimated/absorbed");
    near(placed + at(&usual, "estimated/unresolved"), at(&usual, "unresolved"), 5e-4, "all that was left");
    let all = sum(&usual["surface"]) + sum(&usual["transmitted"]) + at(&usual, "absorbed");
    near(all + at(&usual, "estimated/unresolved"), 1.0, 5e-4, "all light");
    near(sum(&usual["strongest_exit_area"]), 1.0, 1e-9, "all areas");
    assert!((1e-6..=2e-4).contains(&at(&usual, "estimated/standard_error/light_return")));
    let [table, without] = ["", " --exact"].map(|more| desk.done(&format!("measure tolkowsky{more}")));
    let (_, _, note) = desk.run("measure tolkowsky --exact --tracer ray --unresolved 0.05");
    assert!(note.contains("--exact is about exact beams"), "{note}");
    for text in ["± error", "(standard error)", "rays for what they left"] {
        assert!(table.contains(text) && !without.contains(text), "{table}\n{without}");
    }
}

#[test]
fn a_brilliant_looks_the_same_from_like_azimuths_and_other_from_behind_and_the_table_says_so() {
    let desk = Desk::new();
    let view =
        |azimuth| measured(&desk, &format!("tolkowsky --unresolved 0.02 --tilt 8 --azimuth {azimuth}"));
    let first = view(13);
    for same in [-13, 13 + 45, 347, 13 - 5 * 45].map(view) {
        let allowed = 1e-9 + (at(&first, "unresolved") - at(&same, "unresolved")).abs();
        for path in PARTS.iter().flat_map(|part| ZONES.map(|zone| format!("{part}/{zone}"))) {
            near(at(&same, &path), at(&first, &path), allowed, &path);
        }
    }
    let [table, culet] =
        ["table", "culet"].map(|s| measured(&desk, &format!("tolkowsky --unresolved 0.01 --side {s}")));
    near(at(&culet, "silhouette_area"), at(&table, "silhouette_area"), 1e-12, "a silhouette from behind");
    assert!(
        at(&culet, "transmitted/blue") > 2.0 * at(&table, "transmitted/blue")
            && culet["view"]["side"] == "culet"
    );
    let printed = desk.done("measure tolkowsky --unresolved 0.01");
    for zone in ZONES {
        let line = printed.lines().find(|l| l.starts_with(zone)).unwrap();
        let percents = PARTS.map(|part| format!("{:.3}", 100.0 * at(&table, &format!("{part}/{zone}"))));
        assert_eq!(line.split_whitespace().skip(1).collect::<Vec<_>>(), percents);
    }
}

#[test]
fn info_tells_tolkowskys_proportions_and_a_geometry_that_is_consistent() {
    let info = Desk::new().json("info tolkowsky --json");
    let given = "table 53, crown_angle 34.5, pavilion_angle 40.75, star_length 50, lower_half_length 75, \
        girdle_thickness 3, girdle_facets 96, culet 0";
    pairs(given).for_each(|(key, value)| near(at(&info["given"], key), value, 0.0, key));
    let derived = "crown_height 16.1511025271, pavilion_depth 43.0827563257, total_depth 62.2338588528, \
        star_angle 23.0697227837, upper_half_angle 40.5782132333, lower_half_angle 42.0133954137";
    pairs(derived).for_each(|(key, value)| near(at(&info["derived"], key), value, 1e-9, key));
    let vertices = list(&info["vertices"]);
    let (mut volume, mut surface, mut kinds) = (0.0, 0.0, BTreeMap::<&str, f64>::new());
    for facet in list(&info["facets"]) {
        let name = facet["name"].as_str().unwrap();
        *kinds.entry(name.split(' ').next().unwrap()).or_default() += 1.0;
        let (n, offset, area) = (point(&facet["normal"]), at(facet, "offset"), at(facet, "area"));
        let (slope, azimuth) = (at(facet, "slope_deg").to_radians(), at(facet, "azimuth_deg").to_radians());
        let level = DVec2::from_angle(azimuth) * slope.sin();
        assert!(level.extend(n.z.signum() * slope.cos()).distance(n) < 1e-12, "{name}: unit, slope, azimuth");
        assert!(vertices.iter().all(|v| n.dot(point(v)) <= offset + 1e-9), "{name} cuts a corner off");
        let outline = corners(&info, facet);
        let turns: DVec3 = outline.windows(2).map(|w| (w[0] - outline[0]).cross(w[1] - outline[0])).sum();
        near(turns.dot(n) / 2.0, area, 1e-12, name);
        (volume, surface) = (volume + area * offset / 3.0, surface + area);
    }
    near(at(&info, "volume"), volume, 1e-12, "volume");
    near(at(&info, "surface_area"), surface, 1e-12, "surface");
    assert_eq!(vertices.len() + list(&info["facets"]).len(), at(&info, "edges") as usize + 2);
    let kinds_expected = "bezel 8, girdle 96, lower_half 16, main 8, star 8, table 1, upper_half 16";
    assert_eq!(kinds, pairs(kinds_expected).collect());
}

#[test]
fn a_stone_of_planes_is_taken_with_its_own_names_in_every_command() {
    let desk = Desk::new();
    let info = desk.json("info cube.toml --json");
    let figures = ["volume", "surface_area", "silhouette_area", "edges"].map(|key| at(&info, key));
    assert_eq!(figures, [8.0, 24.0, 4.0, 12.0]);
    assert!(
        list(&info["vertices"]).len() == 8 && info.get("given").is_none() && info.get("derived").is_none()
    );
    let names: Vec<&Value> = list(&info["facets"]).iter().map(|f| &f["name"]).collect();
    assert_eq!(names, ["side 1", "side 2", "side 3", "side 4", "side 5", "side 6"]);
    assert!(desk.done("info cube.toml").contains("8.000000"));
    assert_eq!(desk.done("export cube.toml --size 32 --out deep/er").lines().count(), 7 * 4 + 2 + 2 * 2 + 1);
}

#[test]
fn a_design_goes_through_every_format_and_keeps_its_facets() {
    let desk = Desk::new();
    let tiers = |file: &str| {
        let (code, printed, _) = desk.run(&format!("info --json {file}"));
        assert_eq!(code, 0, "{file}");
        list(&serde_json::from_str::<Value>(&printed).unwrap()["measured"]["tiers"]).to_vec()
    };
    let first = tiers("tolkowsky");
    for ending in ["toml", "asc", "gem", "gcs", "obj", "stl", "glb"] {
        let file = format!("t.{ending}");
        let (code, _, stderr) = desk.run(&format!("convert tolkowsky {file}"));
        assert_eq!((code, stderr.is_empty()), (0, ending == "toml"), "{stderr}");
        for (a, b) in tiers(&file).iter().zip(&first) {
            assert_eq!((&a["name"], &a["facets"]), (&b["name"], &b["facets"]), "{file}");
            near(at(a, "slope_deg/mean"), at(b, "slope_deg/mean"), 1e-4, &file);
        }
    }
    assert!(
        desk.refused("convert tolkowsky t.doc", 2)
            .contains(".toml, .asc, .gem, .gcs, .obj, .stl, .ply, .glb")
    );
}

#[test]
fn a_solid_that_is_not_convex_is_shown_measured_and_converted_by_its_triangles() {
    let desk = Desk::new();
    // A prism over an L: its volume is 3 and its width 2.
    let outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)];
    let mut text = String::new();
    for z in 0..2 {
        outline.iter().for_each(|(x, y)| text += &format!("v {x} {y} {z}\n"));
    }
    text += "f 7 8 9 10\nf 7 10 11 12\nf 4 3 2 1\nf 6 5 4 1\n";
    (1..7).for_each(|k| text += &format!("f {k} {} {} {}\n", k % 6 + 1, k % 6 + 7, k + 6));
    desk.write("l.obj", text);
    let info = |file: &str| {
        let (code, printed, _) = desk.run(&format!("info --json {file}"));
        assert_eq!(code, 0, "{file}");
        serde_json::from_str::<Value>(&printed).unwrap()
    };
    assert_eq!((info("l.obj")["triangles"].as_u64(), at(&info("l.obj"), "volume")), (Some(20), 3.0));
    for format in ["toml", "obj", "stl", "glb"] {
        let (code, _, _) = desk.run(&format!("convert l.obj again.{format}"));
        let again = info(&format!("again.{format}"));
        assert_eq!((code, again["triangles"].as_u64()), (0, Some(20)), "{format}");
        near(at(&again, "volume"), 3.0, 1e-5, format);
    }
    for format in ["asc", "gem", "gcs"] {
        assert!(desk.refused(&format!("convert l.obj again.{format}"), 1).contains("takes convex stones"));
        assert!(!desk.at(format!("again.{format}")).exists());
    }
    let (code, _, stderr) = desk.run("render l.obj --out out --size 24 --samples 1");
    assert!(code == 0 && stderr.contains("traced as 20 triangles"), "{stderr}");
    assert_eq!(files(&desk.at("out")).len(), 1);
    assert!(desk.refused("render l.obj --tracer beam", 2).contains("convex"));
    assert!(desk.refused("measure l.obj --tracer beam", 2).contains("convex"));
    let (code, printed, _) = desk.run("measure l.obj --json --unresolved 0.01");
    let figures: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!((code, figures["tracer"].as_str()), (0, Some("ray")));
    let zones = ["surface", "transmitted"]
        .map(|k| figures[k].as_object().unwrap().values().map(|v| v.as_f64().unwrap()).sum::<f64>());
    let sum = zones[0] + zones[1] + at(&figures, "absorbed") + at(&figures, "unresolved");
    near(sum, 1.0, 1e-9, "all light");
    near(at(&figures, "silhouette_area"), 3.0, 0.02, "the L from above");
    let (code, _, stderr) = desk.run("export l.obj --out e --size 24 --views aset,profile --unresolved 0.01");
    assert!(code == 0 && stderr.contains("profile: left out"), "{stderr}");
    assert_eq!(files(&desk.at("e")).len(), 3, "energy, strongest exits, figures");
    assert!(
        desk.refused("export l.obj --out n --views profile --format png", 2).contains("none of the pictures")
    );
    assert!(desk.refused("edit nosuch.stl", 1).contains("no such file"));
    assert!(desk.refused("nosuch.stl", 1).contains("no such file"));
    desk.write("short.stl", [vec![7_u8; 80], 9_u32.to_le_bytes().to_vec(), vec![0; 100]].concat());
    assert!(desk.refused("info short.stl", 1).contains("9 triangles are announced, and the file holds 2"));
}

#[test]
fn what_the_program_knows_by_name_it_lists_and_takes_back_from_a_file() {
    let desk = Desk::new();
    let listed = |list: &str, name: &str| desk.done(list).lines().any(|line| line.starts_with(name));
    let cube = desk.read("cube.toml");
    for material in list(&desk.json("materials --json")) {
        let name = material["name"].as_str().unwrap();
        desk.write("known.toml", cube.replace("diamond", name));
        let (code, printed, stderr) = desk.run("measure known.toml --unresolved 0.5 --json");
        let figures: Value = serde_json::from_str(&printed).unwrap();
        let index = at(&figures, "index");
        assert!(code == 0 && listed("materials", name) && index == at(material, "n_D"), "{name}: {index}");
        // A colour that was not measured is called illustrative wherever it is chosen.
        let is_illustrative = material["colour_is_illustrative"] == true;
        assert_eq!(
            is_illustrative,
            stderr.contains(&format!("the colour of {name} is illustrative")),
            "{stderr}"
        );
        assert_eq!(is_illustrative, figures["colour_is_illustrative"] == true, "{name}");
        assert!(is_illustrative || stderr.is_empty(), "{stderr}");
        let source = material["source"].as_str().unwrap();
        assert_eq!(is_illustrative, source.contains("colour: illustrative"), "{source}");
    }
    for cut in list(&desk.json("cuts --json")) {
        let name = cut["name"].as_str().unwrap();
        desk.write("cut.toml", desk.done(&format!("cuts {name}")));
        let [mut known, read] = [name, "cut.toml"].map(|file| desk.json(&format!("info --json {file}")));
        known["file"] = json!("cut.toml");
        assert!(listed("cuts", name) && known == read && known["name"] == cut["title"], "{name}");
    }
    for scene in list(&desk.json("scenes --json")) {
        let name = scene["name"].as_str().unwrap();
        desk.write("scene.toml", desk.done(&format!("scenes {name}")));
        let [mut known, read] = [name, "scene.toml"].map(|file| desk.json(&format!("info --json {file}")));
        known["file"] = json!("scene.toml");
        assert!(listed("scenes", name) && known == read && known["name"] == scene["title"], "{name}");
        assert_eq!(list(&read["stones"]).len() as u64, scene["stones"].as_u64().unwrap());
    }
    for name in PictureName::ALL.into_iter().filter(|name| name.scoped().is_some()).map(PictureName::key) {
        desk.write("scope.toml", desk.done(&format!("scopes {name}")));
        let side = if name == "hearts" { "culet" } else { "table" };
        let export = "export tolkowsky --size 32 --unresolved 0.1 --format png,svg --out";
        desk.done(&format!("{export} known/{name} --views {name}"));
        desk.done(&format!("{export} read/{name} --scope scope.toml --side {side}"));
        let [known, read] = ["known", "read"].map(|at| files(&desk.at(at).join(name)));
        // The requested side is in the names of files.
        let plain = |(file, bytes): (String, Vec<u8>)| (file.replace("-culet", ""), bytes);
        let read = read.into_iter().map(plain).collect();
        assert!(listed("scopes", name) && known == read && known.len() == 4, "{name}");
    }
    for name in LIGHTS {
        desk.write("light.toml", desk.done(&format!("lights {name}")));
        let read = light_file::read(&desk.at("light.toml")).unwrap();
        assert!(listed("lights", name) && Some(read) == light(name), "{name}");
    }
    assert!(desk.refused("lights stuido", 2).contains("did you mean 'studio'"));
}

#[test]
fn a_perspective_is_traced_by_rays_which_say_so() {
    let desk = Desk::new();
    let figures = measured(&desk, "cube.toml --perspective 8");
    assert_eq!((&figures["tracer"], at(&figures, "view/projection/perspective")), (&json!("ray"), 8.0));
    assert!(desk.done("measure cube.toml --perspective 8").contains(" point rays"));
    desk.done("export cube.toml --perspective 8 --size 32 --views aset --format png");
    for ending in ["", "-strongest"] {
        let description = png(&desk.at(format!("out/cube-perspective-8-aset{ending}.png"))).2;
        assert!(description.contains("point rays") && !description.contains("beams"), "{description}");
    }
    desk.done("export cube.toml --perspective 8 --format json --out figures");
    assert_eq!(files(&desk.at("figures")).len(), 1);
    let (_, _, stderr) = desk.run("export cube.toml --perspective 8 --views aset --format svg,exr");
    assert!(stderr.contains("aset: rays make PNG pictures only"), "{stderr}");
    let (code, _, stderr) = desk.run("measure cube.toml --perspective 8 --tracer beam");
    assert!(code != 0 && stderr.contains("--perspective"), "{stderr}");
}

#[test]
#[cfg(feature = "gpu")]
fn where_no_card_is_found_rays_do_the_work_and_say_so() {
    let desk = Desk::new();
    let run = |line: &str| {
        let mut command = desk.command(line);
        let output =
            command.env("VK_DRIVER_FILES", "/none").env("VK_ICD_FILENAMES", "/none").output().unwrap();
        outcome(line, &output)
    };
    let (code, printed, stderr) = run("measure cube.toml --tracer gpu --json");
    let figures: Value = serde_json::from_str(&printed).unwrap();
    assert!(code == 0 && figures["tracer"] == "ray", "{figures}");
    assert!(stderr.contains("no graphics card") && stderr.contains("tracing by rays"), "{stderr}");
    let (code, _, stderr) = run("export cube.toml --views aset --tracer gpu --format png --size 32");
    assert!(code == 0 && stderr.contains("tracing by rays"), "{stderr}");
    assert!(png(&desk.at("out/cube-aset.png")).2.contains("point rays,"));
    let (code, _, stderr) =
        run("render cube.toml --tracer gpu --size 32 --samples 1 --wavelengths 2 --out lit.png");
    assert!(code == 0 && stderr.contains("tracing by rays"), "{stderr}");
    assert!(png(&desk.at("lit.png")).2.contains("point rays,"));
}

#[test]
#[cfg(feature = "gpu")]
fn a_card_measures_and_draws_as_rays_do_and_is_named() {
    let desk = Desk::new();
    let line = "measure tolkowsky --tilt 7 --azimuth 20 --json --tracer";
    let (code, printed, stderr) = desk.run(&format!("{line} gpu"));
    let by_card: Value = serde_json::from_str(&printed).unwrap();
    if by_card["tracer"] == "ray" {
        assert!(std::env::var_os("BRILLIANTEER_REQUIRE_GPU").is_none(), "{stderr}");
        let _ = writeln!(
            std::io::stderr(),
            "SKIPPED a_card_measures_and_draws_as_rays_do_and_is_named: {stderr}"
        );
        return;
    }
    assert_eq!((code, &by_card["tracer"]), (0, &json!("gpu")));
    near(energy(&by_card), 1.0, 1e-4, "energy by the card");
    let by_rays = desk.json(&format!("{line} ray"));
    // A card's chains of bounces are shorter; the share that they leave open is in the figures.
    let allowed = 2e-4 + at(&by_card, "unresolved");
    assert!(allowed < 3e-3, "{by_card}");
    for part in PARTS {
        for (zone, value) in by_rays[part].as_object().unwrap() {
            near(at(&by_card[part], zone), value.as_f64().unwrap(), allowed, &format!("{part} {zone}"));
        }
    }
    let render = "render cube.toml --tilt 7 --azimuth 20 --light ring --perspective 9 --size 32 --samples 2 --wavelengths 3 --tracer";
    let lit = ["gpu", "ray"].map(|tracer| {
        desk.done(&format!("{render} {tracer} --out {tracer}.png"));
        png(&desk.at(format!("{tracer}.png")))
    });
    assert!(lit[0].2.contains("point rays in f32 on ") && lit[1].2.contains("point rays,"));
    let off = lit[0].1.iter().zip(&lit[1].1).filter(|(a, b)| (*a - *b).abs().max_element() > 0.02).count();
    assert!(off * 100 <= lit[0].1.len(), "{off} pixels of renders differ");
    // The tilt keeps rays of a symmetric picture from meeting edges exactly; the low index keeps no light inside for long.
    let view = "--tilt 7 --azimuth 20 --index 1.5 --views aset --size 48 --format png";
    let export = format!("export tolkowsky {view} --tracer");
    for tracer in ["gpu", "ray"] {
        desk.run(&format!("{export} {tracer} --out {tracer}"));
    }
    for file in
        ["aset.png", "aset-strongest.png"].map(|end| format!("tolkowsky-index-1.5-tilt-7-azimuth-20-{end}"))
    {
        let [(_, card, description), (_, rays, _)] =
            ["gpu", "ray"].map(|folder| png(&desk.at(folder).join(&file)));
        assert!(description.contains("point rays in f32 on "), "{description}");
        let off = card.iter().zip(&rays).filter(|(a, b)| (*a - *b).abs().max_element() > 0.01).count();
        assert!(off * 500 <= card.len(), "{file}: {off} pixels of {} differ", card.len());
    }
}

#[test]
fn a_stone_weighs_its_density_times_its_volume_and_a_scene_is_told_stone_by_stone() {
    let desk = Desk::new();
    let info = desk.json("info --json modern-ideal");
    let carats = 3.52 * at(&info, "volume") * 3.25_f64.powi(3) / 200.0;
    near(at(&info, "carats"), carats, 1e-12, "density times volume");
    near(carats, 1.0, 0.03, "a brilliant of 6.5 mm is the trade's carat");
    assert!(desk.done("info modern-ideal").contains(&format!("{carats:.3} ct")));
    let cube = desk.read("cube.toml").replace("\"diamond\"", "2.42");
    desk.write("index.toml", &cube);
    assert!(desk.json("info --json index.toml")["carats"].is_null());
    assert!(desk.done("info index.toml").contains("not known"));
    desk.write("heavy.toml", cube.replace("2.42", "{ index = 2.42, density = 10 }"));
    near(at(&desk.json("info --json heavy.toml"), "carats"), 10.0 * 6.5_f64.powi(3) / 200.0, 1e-9, "a cube");
    let stones =
        "[[stone]]\ncut = \"cube.toml\"\nsize = \"4mm\"\n[[stone]]\ncut = \"index.toml\"\nsize = \"2mm\"";
    let scene = format!("format = 1\nname = \"Cubes\"\nlayout = \"row\"\ngap_mm = 1\n{stones}");
    desk.write("scene.toml", &scene);
    let info = desk.json("info --json scene.toml");
    let keys = |v: &Value| v.as_object().unwrap().keys().map(String::as_str).collect::<Vec<_>>().join(" ");
    assert_eq!(keys(&info), "file name light unit_mm carats ring stones metals");
    assert_eq!(keys(&info["stones"][0]), "cut material diameter_mm carats at_mm");
    assert!(info["carats"].is_null() && info["light"] == "studio" && info["unit_mm"] == 2.0);
    near(at(&info, "stones/0/carats"), 3.52 * 64.0 / 200.0, 1e-12, "a cube of 4 mm");
    // The circles around the cubes, through their corners, have radii of 2 √2 and √2 mm.
    let apart = point(&info["stones"][1]["at_mm"]) - point(&info["stones"][0]["at_mm"]);
    assert!((apart - DVec3::X * (3.0 * 2_f64.sqrt() + 1.0)).length() < 1e-9, "{apart}");
    assert!(desk.done("info scene.toml").contains("index 2.42"));
    desk.write("scene.toml", scene.replace("\"row\"", "\"raw\""));
    let stderr = desk.refused("info scene.toml", 1);
    assert!(
        stderr.starts_with("error: scene.toml:3: layout: 'raw' is unknown; did you mean 'row'?"),
        "{stderr}"
    );
    for (line, named) in [("measure scene.toml", "scene.toml"), ("export parcel", "parcel")] {
        let stderr = desk.refused(line, 1);
        assert!(
            stderr.starts_with(&format!("error: {named}")) && stderr.contains("this is a scene, where"),
            "{stderr}"
        );
    }
}
