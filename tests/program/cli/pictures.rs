//! The files that `export` writes: all of them, the light in them, the polygons of the drawn map.

use super::desk::*;
use super::{PARTS, ZONES};
use brillianteer::picture::{Picture, PictureName};
use glam::{DAffine2, DVec2, DVec3};
use resvg::usvg::roxmltree::{Document, Node};
use serde_json::Value;
use std::collections::BTreeMap;

#[test]
fn export_makes_every_picture_in_every_format_and_the_same_bytes_on_any_number_of_threads() {
    let desk = Desk::new();
    let export = "export tolkowsky --size 96 --unresolved 0.02 --format png,svg,exr,json --out";
    let made = ["2", "2", "1"].into_iter().enumerate().map(|(k, threads)| {
        let run = desk.command(&format!("{export} {k}")).env("RAYON_NUM_THREADS", threads).output().unwrap();
        let (code, printed, stderr) = outcome(export, &run);
        assert!(code == 0 && stderr.is_empty(), "{stderr}");
        let made = files(&desk.at(k.to_string()));
        let mut printed: Vec<String> = printed.lines().map(|l| l.replace(&format!("{k}/"), "")).collect();
        printed.sort_unstable();
        assert!(made.keys().eq(&printed), "printed is not made: {printed:?}");
        made
    });
    let made: Vec<_> = made.collect();
    let mut expected = vec!["tolkowsky-figures.json".to_string()];
    for name in PictureName::ALL {
        let endings: &[&str] = match name.picture() {
            Picture::Scoped(_) => &[".png", ".svg", ".exr", "-strongest.svg", "-strongest.png"],
            Picture::Contrast => &[".png", ".svg", ".exr"],
            Picture::Profile | Picture::Diagram => &[".png", ".svg"],
        };
        expected.extend(endings.iter().map(|ending| format!("tolkowsky-{}{ending}", name.key())));
    }
    for file in expected.iter().filter(|f| f.ends_with(".png")) {
        let ((width, height), _, description) = png(&desk.at("0").join(file));
        let drawing = !description.contains(';');
        assert!(width == 96 && (height == 96 || drawing), "{file}: {width} by {height}");
        assert!(description.starts_with("Tolkowsky 1919: "), "{description}");
        let open = if file.contains("-strongest") { "undecided" } else { "unresolved" };
        let part: Option<f64> =
            description.split(&format!("; exact beams, {open} ")).nth(1).map(|n| n.parse().unwrap());
        assert!(part.map_or(drawing, |part| !drawing && 0.0 < part && part <= 0.02), "{description}");
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
    let views = [
        ("tolkowsky", "", "tolkowsky"),
        ("tolkowsky", "--tilt 12 --azimuth 22.5", "tolkowsky-tilt-12-azimuth-22.5"),
        ("dark.toml", "--side culet", "dark-culet"),
    ];
    for (k, (file, view, stem)) in views.into_iter().enumerate() {
        let options = format!("{file} --unresolved 0.002 {view}");
        let figures = desk.json(&format!("measure --json {options}"));
        desk.done(&format!("export {options} --views aset --size 200 --format png,exr --out {k}"));
        let path = |ending: &str| desk.at(format!("{k}/{stem}-aset{ending}"));
        let light = exr(&path(".exr"));
        let cover: f64 = light["cover"].iter().sum();
        if k == 0 {
            let expected =
                at(&figures, "silhouette_area") * scale(&desk.json("info tolkowsky --json"), 200.0).powi(2);
            near(cover, expected, 1e-3, "pixels that the stone covers");
        }
        let allowed = if file == "dark.toml" { 2e-2 } else { 1e-5 };
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
        let printed =
            desk.done(&format!("export {options} --views aset --size 200 --format png --glare --out {k}"));
        let lit = printed.lines().find(|file| file.ends_with("-aset.png")).unwrap();
        let with_glare = png(&desk.at(lit)).1.into_iter().sum::<DVec3>() / cover;
        for (i, zone) in ["red", "green", "blue"].into_iter().enumerate() {
            let [glare, inner, area] = PARTS.map(|part| at(&figures, &format!("{part}/{zone}")));
            for (found, expected) in [(energy[i], inner), (with_glare[i], glare + inner)] {
                near(found, expected, 0.01 * expected, &format!("{options}: {zone} in the picture"));
            }
            let allowed = 0.01 * area + at(&figures, "strongest_exit_area/undecided");
            near(strongest[i], area, allowed, &format!("{options}: {zone} in the map"));
        }
    }
}

/// A polygon of a drawing in a scope, in one of its copies.
struct Drawn<'a> {
    node: Node<'a, 'a>,
    zone: &'a str,
    corners: Vec<DVec2>,
    /// The facets that its light meets; empty where none are given.
    path: Vec<&'a str>,
}

fn numbers(text: &str) -> Vec<f64> {
    text.split([',', ' ']).map(|number| number.parse().unwrap()).collect()
}

/// Returns the polygons of a drawing in all copies, found as docs/formats.md describes.
fn drawn<'a>(document: &'a Document<'a>) -> Vec<Drawn<'a>> {
    let copies: BTreeMap<&str, Vec<&str>> = document
        .descendants()
        .filter(|node| node.attribute("class") == Some("copy"))
        .map(|node| {
            let facets = node.attribute("data-facets").unwrap().split(", ").collect();
            (node.attribute("data-copy").unwrap(), facets)
        })
        .collect();
    let mut all = vec![];
    for node in document.descendants().filter(|node| node.has_tag_name("polygon")) {
        let group = node.parent().unwrap();
        let points: Vec<DVec2> =
            numbers(node.attribute("points").unwrap()).chunks(2).map(DVec2::from_slice).collect();
        let path: Vec<&str> =
            node.attribute("data-path").map(|path| path.split(", ").collect()).unwrap_or_default();
        let zone = group.attribute("class").or_else(|| group.parent()?.attribute("class")).unwrap();
        all.push(Drawn { node, zone, corners: points.clone(), path: path.clone() });
        let uses = group.next_siblings().filter(|next| next.has_tag_name("use"));
        for copy in uses.filter(|_| group.attribute("id").is_some()) {
            let reference = copy.attribute(("http://www.w3.org/1999/xlink", "href")).unwrap();
            assert_eq!(reference.strip_prefix('#'), group.attribute("id"));
            let matrix = copy.attribute("transform").unwrap();
            let matrix = numbers(matrix.strip_prefix("matrix(").unwrap().strip_suffix(')').unwrap());
            let map = DAffine2::from_cols_array(&matrix.try_into().unwrap());
            let corners = points.iter().map(|&point| map.transform_point2(point)).collect();
            let (first, own) = (&copies["1"], &copies[copy.attribute("data-copy").unwrap()]);
            let carried = |name: &&str| own[first.iter().position(|facet| facet == name).unwrap()];
            all.push(Drawn { node, zone, corners, path: path.iter().map(carried).collect() });
        }
    }
    all
}

/// Returns the pixels per girdle radius in a picture of `size` pixels, face up, with 4 % of air around the stone's reach.
fn scale(info: &Value, size: f64) -> f64 {
    let reach = list(&info["vertices"]).iter().map(|v| point(v).truncate().abs().max_element());
    size / 2.0 / 1.04 / reach.fold(0.0, f64::max)
}

fn edges(corners: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> {
    corners.iter().copied().zip(corners.iter().copied().cycle().skip(1))
}

/// Returns twice the area of a polygon; negative where the corners run clockwise.
fn turns(corners: &[DVec2]) -> f64 {
    edges(corners).map(|(a, b)| a.perp_dot(b)).sum()
}

/// Returns whether a point lies inside a convex polygon, farther than `margin` from its border.
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
    let views = [
        ("", ""),
        ("--tilt 9 --azimuth 10", "-tilt-9-azimuth-10"),
        ("--side culet --index 1.77", "-index-1.77-culet"),
    ];
    for (k, (view, suffix)) in views.into_iter().enumerate() {
        let options = format!("tolkowsky --unresolved 0.01 {view}");
        let figures = desk.json(&format!("measure --json {options}"));
        desk.done(&format!("export {options} --views aset --size 100 --format svg,exr --out {k}"));
        let text = desk.read(&format!("{k}/tolkowsky{suffix}-aset-strongest.svg"));
        let document = Document::parse(&text).unwrap();
        let drawn = drawn(&document);
        let shapes: Vec<Vec<DVec2>> = drawn.iter().map(|drawn| drawn.corners.clone()).collect();
        let cover: f64 = exr(&desk.at(format!("{k}/tolkowsky{suffix}-aset.exr")))["cover"].iter().sum();
        let part = |shape: &Vec<DVec2>| turns(shape).abs() / 2.0 / (100.0 * cover);
        near(shapes.iter().map(part).sum(), 1.0, 1e-4, &format!("{options}: area of all polygons"));

        let mut areas = BTreeMap::<&str, f64>::new();
        for Drawn { node, zone, corners: shape, path } in &drawn {
            let zone = *zone;
            *areas.entry(zone).or_default() += part(shape);
            if zone == "unresolved" {
                continue;
            }
            let elevation: f64 = node.attribute("data-elevation").unwrap().parse().unwrap();
            let above = [0.0, 45.0, 75.0].into_iter().filter(|from| elevation >= *from).count();
            assert_eq!(["below", "green", "red", "blue"][above], zone, "at {elevation} degrees");
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

#[test]
fn a_contrast_map_holds_the_contrast_that_is_measured_and_dark_squares_are_blue() {
    let desk = Desk::new();
    let measured = desk.json("measure tolkowsky --measures --json");
    let [least, most] = ["least", "most"].map(|end| at(&measured, &format!("measures/eye-contrast/{end}")));
    for (k, view) in ["", "--stone 100mm"].into_iter().enumerate() {
        let export =
            format!("export tolkowsky --views contrast --size 200 --format png,exr,svg --out {k} {view}");
        let made = desk.done(&export);
        let path = |ending: &str| {
            let made = made.lines().find(|line| line.ends_with(ending));
            desk.at(made.unwrap_or_else(|| panic!("no {ending}")))
        };
        let light = exr(&path(".exr"));
        let sum = |name: &str| light[name].iter().sum::<f64>();
        assert!(sum("contrast").abs() < 1e-4 * sum("cover"), "{view}: {}", sum("contrast"));
        let is_between = |i: usize| {
            let [low, known, high] = ["least", "contrast", "most"].map(|name| light[name][i]);
            low <= known + 1e-6 && known <= high + 1e-6
        };
        assert!((0..200 * 200).all(is_between), "{view}");
        let (_, pixels, description) = png(&path(".png"));
        for (i, colour) in pixels.iter().enumerate().filter(|(i, _)| light["cover"][*i] > 0.999) {
            let contrast = light["contrast"][i];
            assert!(
                contrast.abs() < 0.1 || (colour.x > colour.z) == (contrast > 0.0),
                "{contrast}: {colour}"
            );
        }
        let document = std::fs::read_to_string(path(".svg")).unwrap();
        let document = Document::parse(&document).unwrap();
        let (mut area, mut square) = (0.0, 0.0);
        for path in document.descendants().filter(|n| n.has_tag_name("path")) {
            let contrast: f64 = path.attribute("data-contrast").unwrap().parse().unwrap();
            for outline in path.attribute("d").unwrap().split('Z').filter(|part| !part.is_empty()) {
                let corners: Vec<DVec2> = outline[1..]
                    .split('L')
                    .map(numbers)
                    .map(|corner| DVec2::new(corner[0], corner[1]))
                    .collect();
                area += turns(&corners).abs();
                square += turns(&corners).abs() * contrast * contrast;
            }
        }
        let drawn = (square / area).sqrt();
        assert!(k == 1 || (least - 0.01..most + 0.01).contains(&drawn), "{drawn}: {least} to {most}");
        let told: Vec<f64> = description
            .split("contrast of the face ")
            .nth(1)
            .unwrap()
            .split("; ")
            .next()
            .unwrap()
            .split(" ± ")
            .map(|number| number.parse().unwrap())
            .collect();
        assert!((drawn - told[0]).abs() < told[1] + 0.01, "{drawn}: {description}");
    }
    assert!(desk.refused("export heart --views contrast --out -", 2).contains("none of the pictures"));
}

#[test]
fn an_aset_is_red_where_graders_are_taught_red_and_says_what_it_leaves_out() {
    let desk = Desk::new();
    let export = "export modern-ideal --views aset --size 160 --unresolved 0.005 --format png,svg --out";
    desk.done(&format!("{export} bare"));
    desk.done(&format!("{export} same --no-glare"));
    desk.done(&format!("{export} glare --glare"));
    let same =
        files(&desk.at("same")).into_iter().map(|(name, bytes)| (name.replace("-no-glare", ""), bytes));
    assert_eq!(files(&desk.at("bare")), same.collect());
    let strongest = png(&desk.at("bare/modern-ideal-aset-strongest.png")).1;
    let named = |folder: &str, ending: &str| match folder {
        "glare" => format!("modern-ideal-glare-aset.{ending}"),
        _ => format!("modern-ideal-aset.{ending}"),
    };
    let off_red = |folder: &str| {
        let (_, pixels, description) = png(&desk.at(folder).join(named(folder, "png")));
        // Where the strongest light is red, any other colour comes from the light that is mixed in.
        let red: Vec<&DVec3> =
            pixels.iter().zip(&strongest).filter(|(_, s)| s.x > 0.99).map(|(p, _)| p).collect();
        let is_off = |p: &&&DVec3| p.y.max(p.z) > 0.2 * p.x;
        (red.iter().filter(is_off).count() as f64 / red.len() as f64, description)
    };
    let ((bare, bare_told), (glare, glare_told)) = (off_red("bare"), off_red("glare"));
    assert!(bare < 0.1 && glare > 0.5, "{bare} of the red is orange or pink without glare, {glare} with it");
    assert!(bare_told.contains("energy, glare left out") && glare_told.contains("energy, glare included"));
    let title = |folder: &str| desk.read(&format!("{folder}/{}", named(folder, "svg")));
    assert!(
        title("bare").contains("energy, glare left out") && title("glare").contains("energy, glare included")
    );
    assert_ne!(title("bare").replace("left out", "included"), title("glare"));
    // Rays leave glare out as well.
    let rays = "export modern-ideal --views aset --size 48 --unresolved 0.01 --format png --tracer ray";
    let mean = |options: &str| {
        let printed = desk.done(&format!("{rays} {options} --out rays"));
        png(&desk.at(printed.lines().next().unwrap())).1.iter().sum::<DVec3>().y
    };
    let (bare, glare) = (mean(""), mean("--glare"));
    assert!(glare > 1.5 * bare, "{bare} and {glare} of green");
    assert!(desk.refused("export modern-ideal --glare --no-glare", 2).contains("--no-glare"));
}

#[test]
fn drawings_of_the_virtual_facets_are_small_files() {
    let desk = Desk::new();
    desk.done("export modern-ideal --views aset,hearts --format svg");
    for (file, most) in [("hearts-strongest", 700_000), ("hearts", 600_000), ("aset", 300_000)] {
        let bytes = desk.read(&format!("out/modern-ideal-{file}.svg")).len();
        assert!((10_000..most).contains(&bytes), "{file}: {bytes} bytes");
    }
}

#[test]
fn a_caption_stands_under_pictures_of_scopes_alone() {
    let desk = Desk::new();
    let export =
        "export modern-ideal --views aset,profile --size 256 --unresolved 0.02 --format png,svg --tilt 5";
    desk.done(&format!("{export} --out plain"));
    desk.done(&format!("{export} --out captioned --caption"));
    let size = |folder: &str, name: &str| png(&desk.at(folder).join(format!("modern-ideal{name}.png"))).0;
    for name in ["-tilt-5-aset", "-tilt-5-aset-strongest"] {
        let ((width, height), plain) = (size("captioned", name), size("plain", name));
        assert!(width == 256 && plain == (256, 256) && (300..600).contains(&height), "{name}: {height}");
        let picture = |folder: &str| png(&desk.at(folder).join(format!("modern-ideal{name}.png"))).1;
        assert_eq!(picture("captioned")[..256 * 256], picture("plain")[..], "{name}: the picture itself");
        let text = desk.read(&format!("captioned/modern-ideal{name}.svg"));
        let document = Document::parse(&text).unwrap();
        let words: Vec<&str> =
            document.descendants().filter(|n| n.has_tag_name("text")).filter_map(|n| n.text()).collect();
        let words = words.join(" ");
        let reading = if name == "-tilt-5-aset" { "energy, glare left out" } else { "strongest exits" };
        for phrase in [
            "Modern ideal",
            reading,
            "tilted 5 degrees toward 0",
            "diamond, index 2.4173 at 589.3 nm",
            "exact beams, ",
            concat!("Brillianteer ", env!("CARGO_PKG_VERSION")),
            "blue, 75° to 90°",
            "green, 0° to 45°",
            "below the horizon",
        ] {
            assert!(words.contains(phrase), "{name}: no '{phrase}' in {words}");
        }
        assert!(!desk.read(&format!("plain/modern-ideal{name}.svg")).contains("caption"));
    }
    assert_eq!(size("captioned", "-profile"), size("plain", "-profile"));
    assert!(desk.refused("export modern-ideal --size 95 --caption", 2).contains("a caption needs 96"));
    desk.done(
        "export modern-ideal --views aset --size 96 --unresolved 0.02 --format png --caption --out small",
    );
    let ((width, height), _, _) = png(&desk.at("small/modern-ideal-aset.png"));
    assert!(width == 96 && height > 250, "{height}");
}

#[test]
fn measure_takes_a_scope_a_material_a_size_and_its_files_are_the_same_every_time() {
    let desk = Desk::new();
    let measure = "measure tolkowsky --json --unresolved 0.01";
    assert_eq!(desk.done(measure), desk.done(measure), "figures differ from run to run");
    let timed = desk.json(&format!("{measure} --timing"));
    assert!(at(&timed, "seconds") > 0.0 && desk.json(measure).get("seconds").is_none());
    assert!(desk.done("measure tolkowsky --unresolved 0.01 --timing").trim_end().ends_with(" s"));
    desk.done("export tolkowsky --format json --timing --out timed");
    desk.done("export tolkowsky --format json --out untimed");
    let has = |folder: &str| desk.read(&format!("{folder}/tolkowsky-figures.json")).contains("\"seconds\"");
    assert!(has("timed") && !has("untimed"));

    let scoped = desk.json(&format!("{measure} --scope ideal-scope"));
    let zones: Vec<&str> = scoped["transmitted"].as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(
        (scoped["scope"].as_str().unwrap(), zones),
        ("ideal-scope", vec!["side", "red", "black", "below"])
    );
    near(at(&scoped, "light_return"), at(&scoped, "transmitted/red"), 1e-12, "what is red");
    assert_eq!(desk.json(&format!("{measure} --scope hearts"))["view"]["side"], "culet");
    desk.write("mine.toml", desk.done("scopes aset").replace("45.0", "40.0").replace("\"aset\"", "\"mine\""));
    let mine = desk.json(&format!("{measure} --scope mine.toml"));
    assert!(
        at(&mine, "transmitted/red") > at(&desk.json(measure), "transmitted/red") && mine["scope"] == "mine"
    );
    let unknown = desk.refused("measure tolkowsky --scope asset", 2);
    assert!(
        unknown.contains("one of aset, aset-white") && unknown.contains("did you mean 'aset'?"),
        "{unknown}"
    );
    let dark = desk.refused("measure tolkowsky --wavelength 100", 2);
    assert!(dark.contains("--wavelength 100: diamond was measured from 226 to 760 nm"), "{dark}");
    let beside = desk.refused("render tolkowsky --size 64 --probe 64,3", 2);
    assert!(beside.contains("--probe 64,3: the picture has 64 by 64 pixels"), "{beside}");

    let ruby = |stone: &str| {
        let (code, printed, stderr) = desk.run(&format!("{measure} --material ruby --stone {stone}"));
        assert!(code == 0 && stderr.matches("the colour of ruby is illustrative").count() == 1, "{stderr}");
        serde_json::from_str::<Value>(&printed).unwrap()
    };
    let (small, large) = (ruby("3mm"), ruby("12mm"));
    assert!(
        at(&small, "absorbed") < at(&large, "absorbed") && small["material"] == "ruby",
        "a larger ruby is darker"
    );
    near(at(&desk.json(&format!("{measure} --material 1.9")), "index"), 1.9, 0.0, "an index as material");
    assert!(desk.refused(&format!("{measure} --material rubby"), 2).contains("did you mean 'ruby'"));
    let made = "export tolkowsky --views aset --size 40 --unresolved 0.05 --format png --material spinel --stone 2ct";
    desk.done(&format!("{made} --out spinel"));
    assert!(png(&desk.at("spinel/tolkowsky-spinel-2ct-aset.png")).2.contains("index 1.716"));
}

#[test]
fn figures_without_glare_say_how_much_of_it_is_left_out() {
    let desk = Desk::new();
    let [with, without] = ["", " --no-glare"]
        .map(|glare| desk.json(&format!("measure tolkowsky --json --unresolved 0.01{glare}")));
    assert!(without.get("surface").is_none() && without.get("light_return_with_glare").is_none());
    near(at(&without, "glare_left_out"), sum(&with["surface"]), 1e-12, "what is left out");
    near(at(&without, "light_return"), at(&with, "light_return"), 0.0, "light from inside");
    let all = at(&without, "glare_left_out")
        + sum(&without["transmitted"])
        + at(&without, "absorbed")
        + at(&without, "unresolved");
    near(all, 1.0, 1e-9, "all light");
    let printed = desk.done("measure tolkowsky --unresolved 0.01 --no-glare");
    let line = format!("glare of {:.3} % is left out", 100.0 * at(&without, "glare_left_out"));
    assert!(printed.contains(&line) && printed.contains("% of face    transmitted   strongest"), "{printed}");
    let usual = desk.done("measure tolkowsky --unresolved 0.01");
    assert!(usual.contains(&format!("light return {:.3} %", 100.0 * at(&with, "light_return"))), "{usual}");
}

#[test]
fn ideal_scope_shows_dark_arrows_from_centre_to_girdle_in_the_picture_that_comes_first() {
    let desk = Desk::new();
    for cut in ["modern-ideal", "tolkowsky"] {
        desk.done(&format!("export {cut} --views ideal-scope --size 240 --unresolved 0.002 --format png"));
        let radius = scale(&desk.json(&format!("info {cut} --json")), 240.0);
        for kind in ["", "-strongest"] {
            let (_, pixels, _) = png(&desk.at(format!("out/{cut}-ideal-scope{kind}.png")));
            let along = |degrees: f64, part: f64| {
                let at = DVec2::from_angle(degrees.to_radians()) * (part * radius) + 120.0;
                pixels[at.y as usize * 240 + at.x as usize]
            };
            for arrow in 0..8 {
                for part in [0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.65, 0.7, 0.75, 0.8] {
                    let light = along(45.0 * f64::from(arrow), part).max_element();
                    assert!(
                        light < 0.15,
                        "{cut}{kind}: arrow {arrow} is {light} bright at {part} of the radius"
                    );
                }
                let beside = along(45.0 * f64::from(arrow) + 22.5, 0.3);
                assert!(beside.x > 0.3, "{cut}{kind}: {beside} beside arrow {arrow}");
            }
        }
    }
}
