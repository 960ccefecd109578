//! What `export` makes: every file, the light in it, the polygons of the drawn map.

use super::desk::*;
use super::{PARTS, ZONES};
use brillianteer::picture::names;
use glam::{DVec2, DVec3};
use resvg::usvg::roxmltree::{Document, Node};
use serde_json::{Value, json};
use std::collections::BTreeMap;

#[test]
fn export_makes_every_picture_in_every_format_and_the_same_bytes_on_any_number_of_threads() {
    let desk = Desk::new();
    let export = "export tolkowsky --size 96 --unresolved 0.02 --format png,svg,exr,json --out";
    let made = ["2", "2", "1"].into_iter().enumerate().map(|(k, threads)| {
        let run = desk.command(&format!("{export} {k}")).env("RAYON_NUM_THREADS", threads).output().unwrap();
        let (code, printed, said) = came_of(export, &run);
        assert!(code == 0 && said.is_empty(), "{said}");
        let mut made = files(&desk.at(k.to_string()));
        let mut printed: Vec<String> = printed.lines().map(|l| l.replace(&format!("{k}/"), "")).collect();
        printed.sort_unstable();
        assert!(made.keys().eq(&printed), "printed is not made: {printed:?}");
        let mut figures: Value = serde_json::from_slice(&made["tolkowsky-figures.json"]).unwrap();
        figures["seconds"] = json!(0);
        made.insert("tolkowsky-figures.json".into(), figures.to_string().into_bytes());
        made
    });
    let made: Vec<_> = made.collect();
    let mut expected = vec!["tolkowsky-figures.json".to_string()];
    for name in names() {
        let drawing = name == "profile" || name == "diagram";
        let endings = [".png", ".svg", ".exr", "-strongest.svg", "-strongest.png"];
        expected
            .extend(endings[..if drawing { 2 } else { 5 }].iter().map(|e| format!("tolkowsky-{name}{e}")));
    }
    for file in expected.iter().filter(|f| f.ends_with(".png")) {
        let ((width, height), _, told) = png(&desk.at("0").join(file));
        let drawing = !told.contains(';');
        assert!(width == 96 && (height == 96 || drawing), "{file}: {width} by {height}");
        assert!(told.starts_with("Tolkowsky 1919: "), "{told}");
        let open = if file.contains("-strongest") { "undecided" } else { "unresolved" };
        let part: Option<f64> =
            told.split(&format!("; exact beams, {open} ")).nth(1).map(|n| n.parse().unwrap());
        assert!(part.map_or(drawing, |part| !drawing && 0.0 < part && part <= 0.02), "{told}");
    }
    expected.sort();
    assert!(made[0].keys().eq(&expected), "{:?}", made[0].keys());
    for (file, text) in made[0].iter().filter(|(f, _)| f.ends_with(".svg")) {
        assert!(Document::parse(std::str::from_utf8(text).unwrap()).is_ok(), "{file}");
    }
    for later in &made[1..] {
        let differing: Vec<&String> = later.keys().filter(|k| made[0].get(*k) != later.get(*k)).collect();
        assert!(differing.is_empty() && later.len() == made[0].len(), "other bytes in {differing:?}");
    }
}

#[test]
fn pictures_hold_the_light_that_is_measured() {
    let desk = Desk::new();
    let dark = desk.done("cuts tolkowsky").replace("\"diamond\"", "{ index = 1.8, absorption = 0.1 }");
    desk.write("dark.toml", dark);
    let views = [("tolkowsky", ""), ("tolkowsky", "--tilt 12 --azimuth 22.5"), ("dark.toml", "--side culet")];
    for (k, (file, view)) in views.into_iter().enumerate() {
        let options = format!("{file} --unresolved 0.002 {view}");
        let figures = desk.json(&format!("measure --json {options}"));
        desk.done(&format!("export {options} --views aset --size 200 --format png,exr --out {k}"));
        let stem = file.trim_end_matches(".toml");
        let path = |ending: &str| desk.at(format!("{k}/{stem}-aset{ending}"));
        let light = exr(&path(".exr"));
        let cover: f64 = light["cover"].iter().sum();
        if k == 0 {
            let expected =
                at(&figures, "silhouette_area") * scale(&desk.json("info tolkowsky --json"), 200.0).powi(2);
            near(cover, expected, 1e-3, "pixels that the stone covers");
        }
        let allowed = if stem == "dark" { 2e-2 } else { 1e-5 };
        for i in 0..200 * 200 {
            let parts: f64 = light.iter().map(|(name, v)| if name == "cover" { -v[i] } else { v[i] }).sum();
            assert!(parts.abs() < allowed, "{options}: the parts of pixel {i} are {parts} off its cover");
        }
        for (channel, values) in light.iter().filter(|(c, _)| *c != "cover") {
            let measured = at(&figures, &channel.replace('.', "/"));
            near(values.iter().sum::<f64>() / cover, measured, 1e-6, &format!("{options}: {channel}"));
        }
        let mean = |ending| png(&path(ending)).1.into_iter().sum::<DVec3>() / cover;
        let (energy, strongest) = (mean(".png"), mean("-strongest.png"));
        for (i, zone) in ["red", "green", "blue"].into_iter().enumerate() {
            let [glare, inner, area] = PARTS.map(|part| at(&figures, &format!("{part}/{zone}")));
            near(
                energy[i],
                glare + inner,
                0.01 * (glare + inner),
                &format!("{options}: {zone} in the picture"),
            );
            let allowed = 0.01 * area + at(&figures, "strongest_exit_area/undecided");
            near(strongest[i], area, allowed, &format!("{options}: {zone} in the map"));
        }
    }
}

/// Pixels per girdle radius on a picture face up of `size`: 4 % of air around the stone's reach.
fn scale(info: &Value, size: f64) -> f64 {
    let reach = list(&info["vertices"]).iter().map(|v| point(v).truncate().abs().max_element());
    size / 2.0 / 1.04 / reach.fold(0.0, f64::max)
}

fn edges(corners: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> {
    corners.iter().copied().zip(corners.iter().copied().cycle().skip(1))
}

/// Twice the area; negative where the corners go clockwise.
fn turns(corners: &[DVec2]) -> f64 {
    edges(corners).map(|(a, b)| a.perp_dot(b)).sum()
}

/// Whether a point lies in a convex polygon, this far from its border.
fn inside(corners: &[DVec2], p: DVec2, margin: f64) -> bool {
    let sign = turns(corners).signum();
    edges(corners).all(|(a, b)| sign * (b - a).perp_dot(p - a) > margin * (b - a).length())
}

#[test]
fn the_drawn_map_of_strongest_exits_has_no_overlaps_and_the_areas_measured_and_names_the_facets() {
    let desk = Desk::new();
    let info = desk.json("info tolkowsky --json");
    let flat = |facet| corners(&info, facet).iter().map(|c| c.truncate()).collect();
    let facets: BTreeMap<&str, Vec<DVec2>> =
        list(&info["facets"]).iter().map(|f| (f["name"].as_str().unwrap(), flat(f))).collect();
    let numbers =
        |pair: &str| DVec2::from_slice(&pair.split(',').map(|n| n.parse().unwrap()).collect::<Vec<f64>>());
    for (k, view) in ["", "--tilt 9 --azimuth 10", "--side culet --index 1.77"].into_iter().enumerate() {
        let options = format!("tolkowsky --unresolved 0.01 {view}");
        let figures = desk.json(&format!("measure --json {options}"));
        desk.done(&format!("export {options} --views aset --size 100 --format svg,exr --out {k}"));
        let text = desk.read(&format!("{k}/tolkowsky-aset-strongest.svg"));
        let document = Document::parse(&text).unwrap();
        let drawn: Vec<Node> = document.descendants().filter(|n| n.has_tag_name("polygon")).collect();
        let shape = |n: &Node| n.attribute("points").unwrap().split_whitespace().map(numbers).collect();
        let shapes: Vec<Vec<DVec2>> = drawn.iter().map(shape).collect();
        let cover: f64 = exr(&desk.at(format!("{k}/tolkowsky-aset.exr")))["cover"].iter().sum();
        let part = |shape: &Vec<DVec2>| turns(shape).abs() / 2.0 / (100.0 * cover);
        near(shapes.iter().map(part).sum(), 1.0, 1e-4, &format!("{options}: area of all polygons"));

        let mut areas = BTreeMap::<&str, f64>::new();
        for (node, shape) in drawn.iter().zip(&shapes) {
            let zone = node.parent().and_then(|g| g.attribute("class")).unwrap();
            *areas.entry(zone).or_default() += part(shape);
            if zone == "unresolved" {
                continue;
            }
            let elevation: f64 = node.attribute("data-elevation").unwrap().parse().unwrap();
            let above = [0.0, 45.0, 75.0].into_iter().filter(|from| elevation >= *from).count();
            assert_eq!(["below", "green", "red", "blue"][above], zone, "at {elevation} degrees");
            let path: Vec<&str> = node.attribute("data-path").unwrap().split(", ").collect();
            assert!(path.len() > 1 && path.iter().all(|f| facets.contains_key(f)), "{path:?}");
            let middle = (shape.iter().sum::<DVec2>() / shape.len() as f64 - 500.0) / scale(&info, 1000.0);
            let entered = inside(&facets[path[0]], DVec2::new(middle.x, -middle.y), -1e-6);
            assert!(k > 0 || entered, "{middle} is not on {}", path[0]);
        }
        let open = at(&figures, "strongest_exit_area/undecided");
        for zone in ZONES {
            let middle = at(&figures, &format!("strongest_exit_area/{zone}")) + open / 2.0;
            near(areas[zone], middle, open / 2.0 + 1e-4, &format!("{options}: area of {zone}"));
        }
        for i in 0..2000 {
            let p = (DVec2::new(0.754_877_666, 0.569_840_29) * f64::from(i)).fract() * 1000.0;
            let over = shapes.iter().filter(|s| inside(s, p, 1e-3)).count();
            assert!(over <= 1, "{options}: {over} polygons lie over {p}");
        }
    }
}
