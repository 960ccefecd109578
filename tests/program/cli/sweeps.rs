//! `measure --measures` and `sweep`: measures of one view, and over a grid.

use super::desk::*;

/// The rows of a CSV table, and the names of its columns.
fn table(text: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let columns = reader.headers().unwrap().iter().map(String::from).collect();
    let rows = reader.records().map(|row| row.unwrap().iter().map(String::from).collect()).collect();
    (columns, rows)
}

#[test]
fn measures_are_intervals_around_the_figures_of_zones() {
    let desk = Desk::new();
    let found = desk.json("measure tolkowsky --measures --json --dome even --dome even@15");
    let figures = desk.json("measure tolkowsky --json --head 15");
    let within = |key: &str, value: f64| {
        let interval = &found["measures"][key];
        let (least, most) = (at(interval, "least"), at(interval, "most"));
        assert!(least - 1e-4 <= value && value <= most + 1e-4, "{key}: {value} is not in {interval}");
        assert!(most - least < 2e-3, "{key}: {interval}");
    };
    within("return-even@15", at(&figures, "light_return"));
    within("return-even@15+glare", at(&figures, "light_return_with_glare"));
    within("leakage", at(&figures, "transmitted/below"));
    within("obstruction", at(&figures, "transmitted/head"));
    let dark = at(&figures, "strongest_exit_area/below") + at(&figures, "strongest_exit_area/head");
    within("extinction", dark);
    assert!(found["measures"]["return-cos"].is_null(), "{found}");
    let list = desk.done("measure tolkowsky emerald --measures");
    assert_eq!(list.matches("return-cos2+glare").count(), 2, "{list}");
    for (line, code, told) in [
        ("heart --measures", 1, "not convex at its cleft"),
        ("tolkowsky --measures --tracer ray", 2, "no other tracer"),
        ("tolkowsky --measures --dome cos30", 2, "is no dome"),
        ("tolkowsky --dome cos", 2, "--measures"),
    ] {
        let stderr = desk.refused(&format!("measure {line}"), code);
        assert!(stderr.contains(told), "{line}: {stderr}");
    }
}

#[test]
fn patterns_and_scintillation_are_listed_and_swept_as_they_are_measured() {
    let desk = Desk::new();
    let still = desk.json("measure tolkowsky --measures --json --unresolved 0.02");
    assert!(still["wlr"].is_null(), "{still}");
    assert!(still["measures"]["scintillation"].is_null() && still["rock_deg"].is_null(), "{still}");
    let found =
        desk.json("measure tolkowsky --measures --json --unresolved 0.02 --rock 3 --stone 9mm --pupil 4");
    assert_eq!((at(&found, "diameter_mm"), at(&found, "rock_deg")), (9.0, 3.0));
    assert!(at(&found, "measures/crushed-ice/most") < at(&still, "measures/crushed-ice/least"), "{found}");
    assert!(at(&found, "measures/fire-seen/least") < at(&still, "measures/fire-seen/least"), "{found}");
    let names =
        ["eye-contrast", "patch-size", "crushed-ice", "fire-seen", "bow-tie", "fish-eye", "scintillation"];
    let of: String = names.iter().map(|name| format!(" --of {name}")).collect();
    let line = format!("sweep tolkowsky --unresolved 0.02 --stone 9mm --pupil 4{of}");
    let (_, rows) = table(&desk.done(&line));
    for (k, key) in names.iter().enumerate() {
        let [value, error] = [2 + 2 * k, 3 + 2 * k].map(|column| rows[0][column].parse::<f64>().unwrap());
        let interval = &found["measures"][*key];
        near(value - error, at(interval, "least"), 2e-7, key);
        near(value + error, at(interval, "most"), 2e-7, key);
    }
    assert!(desk.refused("measure tolkowsky --measures --rock 90", 2).contains("45 degrees"));
    assert!(desk.refused("sweep tolkowsky --pupil 0", 2).contains("50 mm"));
}

#[test]
fn the_weighted_light_return_has_a_standard_error_and_no_view() {
    let desk = Desk::new();
    let line = "measure tolkowsky --measures --wlr --unresolved 0.05";
    let found = desk.json(&format!("{line} --json"))["wlr"].clone();
    assert!((0.0..2e-3).contains(&at(&found, "standard_error")), "{found}");
    assert!((0.5..1.0).contains(&at(&found, "value")), "{found}");
    // A tilted view has the same, in percent.
    let table = desk.done(&format!("{line} --tilt 20"));
    let shown = format!("{:.3}", 100.0 * at(&found, "value"));
    let row = table.lines().find(|row| row.starts_with("wlr ")).unwrap();
    assert!(row.contains(&shown) && row.contains("(standard error)"), "{row} is not {shown}");
    assert!(desk.refused("measure tolkowsky --wlr", 2).contains("--measures"));
    assert!(desk.refused("sweep tolkowsky --of wlr", 2).contains("wlr is sampled and has no bound"));
}

#[test]
fn a_sweep_measures_what_single_designs_measure_in_the_order_of_its_axes() {
    let desk = Desk::new();
    let line = "sweep tolkowsky --over crown_angle=33:34:1 --over pavilion_angle=40.5,41.5 --of fire --of return-even";
    let (columns, rows) = table(&desk.done(line));
    assert_eq!(columns[..5], ["file", "crown_angle", "pavilion_angle", "carats", "fire"].map(String::from));
    let points: Vec<String> = rows.iter().map(|row| row[1..3].join(" ")).collect();
    assert_eq!(points, ["33 40.5", "33 41.5", "34 40.5", "34 41.5"]);
    let cut = desk.done("cuts tolkowsky").replace("crown_angle = 34.5", "crown_angle = 33.0");
    desk.write("other.toml", cut.replace("pavilion_angle = 40.75", "pavilion_angle = 41.5"));
    let single = desk.json("measure other.toml --measures --json --unresolved 0.002");
    for (column, key) in [(4, "fire"), (6, "return-even")] {
        let [value, error] = [column, column + 1].map(|k| rows[1][k].parse::<f64>().unwrap());
        let interval = &single["measures"][key];
        near(value - error, at(interval, "least"), 2e-7, key);
        near(value + error, at(interval, "most"), 2e-7, key);
    }
    let lines = desk.done(&format!("{line} --json"));
    let second: serde_json::Value = serde_json::from_str(lines.lines().nth(1).unwrap()).unwrap();
    near(at(&second, "fire"), rows[1][4].parse().unwrap(), 1e-7, "the same as JSON");
}

#[test]
fn angles_of_tiers_materials_and_tilts_vary_as_well() {
    let desk = Desk::new();
    let (code, _, stderr) = desk.run("convert tolkowsky tolkowsky.asc");
    assert_eq!(code, 0, "{stderr}");
    let info = desk.json("info tolkowsky.asc --json");
    let tier =
        list(&info["measured"]["tiers"]).iter().find(|tier| at(tier, "slope_deg/mean").abs() < 42.0).unwrap();
    let name = tier["name"].as_str().unwrap();
    // The table, tilted so, cuts facets away.
    let (code, varied, stderr) =
        desk.run(&format!("sweep tolkowsky.asc --over tier:{name}=40:42:1 --of leakage"));
    assert!(code == 0 && stderr.contains("do not reach the stone"), "{stderr}");
    let (_, rows) = table(&varied);
    assert!(rows.len() == 3 && rows.iter().all(|row| row.last().unwrap().is_empty()), "{varied}");
    let leaks: Vec<f64> = rows.iter().map(|row| row[3].parse().unwrap()).collect();
    assert!((leaks[0] - leaks[2]).abs() > 1e-2, "{leaks:?}");
    let (_, rows) =
        table(&desk.done("sweep tolkowsky --over material=diamond,quartz,1.9 --over tilt=0,10 --of fire"));
    let fire: Vec<f64> = rows.iter().map(|row| row[4].parse().unwrap()).collect();
    assert!(fire[0] > 2.0 * fire[2] && fire[4] < 2e-3 && fire[0] != fire[1], "{fire:?}");
    let at_ten = desk.json("measure tolkowsky --measures --json --unresolved 0.002 --tilt 10");
    let interval = &at_ten["measures"]["fire"];
    near(fire[1], (at(interval, "least") + at(interval, "most")) / 2.0, 2e-7, "the tilted stone");
}

#[test]
fn the_scale_of_a_side_is_the_tangent_ratio_by_which_a_design_is_fitted() {
    let desk = Desk::new();
    let (code, _, stderr) = desk.run("convert tolkowsky tolkowsky.asc");
    assert_eq!(code, 0, "{stderr}");
    let measured = |line: &str| -> Vec<f64> {
        let (columns, rows) = table(&desk.done(&format!("sweep {line} --of return-cos2 --unresolved 0.001")));
        let column = columns.iter().position(|column| column == "return-cos2").unwrap();
        rows.iter().map(|row| row[column].parse().unwrap()).collect()
    };
    for (side, key) in [("crown", "crown_scale"), ("pavilion", "pavilion_scale")] {
        let rule = format!("--rule tangent-ratio --side {side} --factor 1.025 --material diamond --no-light");
        let (code, _, stderr) = desk.run(&format!("retarget tolkowsky.asc {rule} --out {side}.asc"));
        assert_eq!(code, 0, "{stderr}");
        let swept = measured(&format!("tolkowsky.asc --over {key}=100,102.5,95"));
        let single = [measured("tolkowsky.asc")[0], measured(&format!("{side}.asc"))[0]];
        for (swept, single) in swept.iter().zip(single) {
            assert!((swept - single).abs() < 1e-5, "{key}: {swept} {single}");
        }
        assert!(swept.iter().all(|value| (value - swept[0]).abs() > 1e-3 || *value == swept[0]), "{swept:?}");
        let found = desk.json(&format!("gradient tolkowsky.asc --by {key} --of return-cos2 --json"));
        assert!(at(&found["measures"]["return-cos2"]["per"], key).abs() > 1e-5, "{found}");
    }
    for (line, told) in [
        ("tolkowsky --over crown_scale=90", "vary the proportions of another"),
        ("tolkowsky.asc --over crown_scale=5", "percentage from 10 to 1000"),
        ("tolkowsky.asc --over crown_scale=high", "percentage from 10 to 1000"),
        ("tolkowsky.asc --over crown_scale=90 --over crown_scale=95", "crown_scale is given twice"),
    ] {
        let stderr = desk.refused(&format!("sweep {line}"), 2);
        assert!(stderr.contains(told), "{line}: {stderr}");
    }
}

#[test]
fn a_sweep_that_was_stopped_goes_on_and_gives_the_same_file() {
    let desk = Desk::new();
    for ending in ["csv", "jsonl"] {
        let line =
            format!("sweep tolkowsky single-cut --over table=50:90:20 --of extinction --out all.{ending}");
        let (code, _, stderr) = desk.run(&line);
        assert_eq!(code, 0, "{stderr}");
        assert!(stderr.contains("of 6 points have no measures"), "{stderr}");
        let whole = desk.read(&format!("all.{ending}"));
        for part in [0, 1, whole.len() / 3, whole.len() / 2, whole.len() - 1] {
            desk.write(&format!("all.{ending}"), &whole[..part]);
            desk.run(&format!("{line} --resume"));
            assert_eq!(desk.read(&format!("all.{ending}")), whole, "resumed after {part} bytes");
        }
        let cut = whole.match_indices('\n').nth(2).unwrap().0 + 1;
        desk.write(&format!("all.{ending}"), &whole[..cut]);
        let other = line.replace("50:90:20", "52:92:20");
        for other in [other, format!("{line} --material ruby"), format!("{line} --unresolved 0.03")] {
            assert!(desk.refused(&format!("{other} --resume"), 2).contains("another sweep"), "{other}");
        }
        assert_eq!(desk.read(&format!("all.{ending}")), whole[..cut], "a refused file is left as it was");
    }
}

#[test]
fn what_is_odd_at_some_points_and_files_that_cannot_be_read_are_said() {
    let desk = Desk::new();
    assert_eq!(desk.run("convert tolkowsky tolkowsky.asc").0, 0);
    let line = "sweep tolkowsky.asc --over tier:star=22,40,45 --of leakage --unresolved 0.05";
    let (code, _, stderr) = desk.run(line);
    assert!(code == 0 && stderr.contains("points the stone is odd; the first, "), "{stderr}");
    desk.write("spoilt.asc", "GemCad 5.0\ng x\n");
    let (code, printed, stderr) = desk.run("sweep tolkowsky spoilt.asc --of leakage --unresolved 0.05");
    assert!(code == 1 && printed.lines().count() == 3, "{code}: {printed}");
    assert!(stderr.contains("1 of 2 designs could not be measured"), "{stderr}");
    let (code, _, stderr) = desk.run("sweep tolkowsky --over crown_angle=89,90 --of leakage --plot none.png");
    assert!(code == 1 && stderr.contains("the first: ") && !desk.at("none.png").exists(), "{stderr}");
    let (_, _, stderr) = desk.run("sweep tolkowsky --material 2.4 --of fire --unresolved 0.05");
    assert!(stderr.contains("has no fire"), "{stderr}");
}

#[test]
fn what_a_sweep_cannot_do_is_refused_before_a_file_is_replaced() {
    let desk = Desk::new();
    desk.write("kept.csv", "mine");
    for (line, code, told) in [
        ("tolkowsky --over slope=1:2:1", 2, "it has table, crown_angle"),
        ("tolkowsky --over tier:P=1:2:1", 2, "vary its proportions"),
        ("tolkowsky --over table=a,b", 2, "'a' is no number"),
        ("tolkowsky --over table=1:2", 2, "is no range"),
        ("tolkowsky --over material=diamant", 2, "did you mean 'diamond'?"),
        ("tolkowsky --over tilt=100", 2, "from -90 to 90"),
        ("tolkowsky --of brightness", 2, "is no measure"),
        ("tolkowsky --unresolved 2", 2, "between 0 and 1"),
        ("missing.toml", 1, "missing.toml"),
    ] {
        let stderr = desk.refused(&format!("sweep {line} --out kept.csv"), code);
        assert!(stderr.contains(told), "{line}: {stderr}");
        assert_eq!(desk.read("kept.csv"), "mine", "{line}");
    }
    assert!(desk.refused("sweep tolkowsky --out kept.txt", 2).contains(".csv, .jsonl or .parquet"));
}

#[test]
fn folders_and_several_designs_are_measured_at_once() {
    let desk = Desk::new();
    for name in ["tolkowsky", "emerald"] {
        let text = desk.done(&format!("cuts {name}"));
        std::fs::create_dir_all(desk.at("designs")).unwrap();
        desk.write(&format!("designs/{name}.toml"), text);
    }
    desk.write("designs/broken.toml", "format = 1");
    desk.write("designs/readme.txt", "no design");
    // A folder does not hide the program's cut of the same name.
    std::fs::create_dir_all(desk.at("princess")).unwrap();
    let (code, printed, stderr) = desk.run("sweep designs princess --of fire");
    let (_, rows) = table(&printed);
    let files: Vec<&str> = rows.iter().map(|row| row[0].rsplit('/').next().unwrap()).collect();
    assert_eq!(
        (code, files),
        (1, vec!["broken.toml", "emerald.toml", "tolkowsky.toml", "princess"]),
        "{stderr}"
    );
    assert!(rows[0][2].is_empty() && !rows[0].last().unwrap().is_empty(), "{printed}");
    assert!(stderr.contains("1 of 4 points"), "{stderr}");
}

#[test]
fn plots_are_curves_over_one_axis_and_a_map_or_a_family_of_curves_over_two() {
    let desk = Desk::new();
    let line = "sweep tolkowsky --over tilt=0:8:4 --unresolved 0.05 --of fire --of extinction --plot";
    assert_eq!(desk.done(&format!("{line} tilt.svg")).trim(), "tilt.svg");
    let drawn = desk.read("tilt.svg");
    assert!(["tilt, degrees", "fire", "extinction"].iter().all(|text| drawn.contains(text)), "{drawn}");
    let (_, _, stderr) = desk.run(&format!("{line} tilt.pdf --out tilt.csv"));
    assert!(std::fs::read(desk.at("tilt.pdf")).unwrap().starts_with(b"%PDF"), "{stderr}");
    assert_eq!(table(&desk.read("tilt.csv")).1.len(), 3);
    let map = "sweep tolkowsky --over table=52:92:20 --over pavilion_angle=40:42:1 --of fire --plot map.png";
    let (code, _, stderr) = desk.run(map);
    assert!(code == 0 && stderr.contains("3 of 9 points"), "{stderr}");
    let ((width, height), pixels, _) = png(&desk.at("map.png"));
    let at = |x: f64, y: f64| {
        pixels[(y * f64::from(height)) as usize * width as usize + (x * f64::from(width)) as usize]
    };
    // The places with a table of 92 %, on the right, have no stone and are grey.
    let (grey, filled) = (at(0.7, 0.5), at(0.3, 0.5));
    assert!(
        (grey.max_element() - grey.min_element()) < 1e-9
            && filled.max_element() > filled.min_element() + 0.05
    );
    // Azimuths of a tilt and materials are families of curves: one key, and a panel for each measure.
    let family = "sweep tolkowsky --over azimuth=0,22.5 --over tilt=0:8:4 --unresolved 0.05 --of fire";
    desk.done(&format!("{family} --plot one.svg"));
    let one = desk.read("one.svg");
    assert!(["22.5°", "azimuth", "tilt, degrees", "fire"].iter().all(|text| one.contains(text)), "{one}");
    desk.done(&format!("{family} --of extinction --of leakage --plot three.svg"));
    let three = desk.read("three.svg");
    assert_eq!((three.matches("22.5°").count(), three.matches("tilt, degrees").count()), (1, 3));
    // The order of the axes changes no curve.
    let turned = "sweep tolkowsky --over tilt=0:8:4 --over azimuth=0,22.5 --unresolved 0.05 --of fire";
    desk.done(&format!("{turned} --plot turned.svg"));
    assert_eq!(desk.read("turned.svg"), one);
    let materials =
        "sweep tolkowsky --over material=diamond,quartz --over tilt=0,5 --unresolved 0.05 --of fire";
    desk.done(&format!("{materials} --plot materials.svg"));
    assert!(desk.read("materials.svg").contains("quartz"));
    for (line, told) in [
        ("tolkowsky --plot a.svg", "one --over or two"),
        ("tolkowsky --over table=50:60:5 --plot a.txt", ".svg, .png or .pdf"),
        ("tolkowsky --over table=50:60:5 --over tilt=0,5 --plot a.svg", "shows one measure"),
        ("tolkowsky --over material=diamond,quartz --plot a.svg", "are numbers"),
        ("tolkowsky --over table=50,60,55 --plot a.svg", "rise or fall"),
        ("tolkowsky emerald --over tilt=0,5 --plot a.svg", "one design"),
    ] {
        let stderr = desk.refused(&format!("sweep {line}"), 2);
        assert!(stderr.contains(told), "{line}: {stderr}");
    }
}

#[test]
fn a_gradient_is_the_slope_of_the_measures_beside_the_design() {
    let desk = Desk::new();
    // Beside each angle at which light ceases to leave through a facet, slopes change within hundredths of a degree.
    for (cut, numbers) in
        [("emerald", &[("table", 62.0, 0.05)][..]), ("single-cut", &[("table", 60.0, 0.05)][..])]
    {
        let common =
            format!("{cut} --material 2.4 --unresolved 1e-4 --of return-cos2 --of return-cos2+glare");
        let found = desk.json(&format!("gradient {common} --json"));
        for &(key, value, step) in numbers {
            let line = format!("sweep {common} --over {key}={},{}", value - step, value + step);
            let (columns, rows) = table(&desk.done(&line));
            for name in ["return-cos2", "return-cos2+glare"] {
                let column = columns.iter().position(|column| column == name).unwrap();
                let [below, above] = [0, 1].map(|row: usize| rows[row][column].parse::<f64>().unwrap());
                let slope = (above - below) / (2.0 * step);
                let own = at(&found["measures"][name]["per"], key);
                // Beams end at other places in the two stones, which moves the middle of the interval.
                assert!(
                    (own - slope).abs() < 0.08 * slope.abs() + 5e-4,
                    "{cut}, {name} by {key}: {own} is not {slope}"
                );
                assert!(slope.abs() > 1e-3, "{cut}, {name} by {key}: {slope}");
            }
        }
    }
    assert!(desk.done("gradient tolkowsky").contains("lower_half_length"), "numbers that are given");
    // The value is the measure's, with its bound.
    let value =
        desk.json("gradient tolkowsky --by table --of leakage --json")["measures"]["leakage"]["value"]
            .clone();
    let (_, rows) = table(&desk.done("sweep tolkowsky --of leakage"));
    let [middle, error] = [2, 3].map(|column: usize| rows[0][column].parse::<f64>().unwrap());
    near(at(&value, "least"), middle - error, 2e-7, "least");
    near(at(&value, "most"), middle + error, 2e-7, "most");
    // The table of a mesh is level but for rounding, and is left out.
    assert_eq!(desk.run("convert oval oval.stl").0, 0);
    let (code, listed, stderr) = desk.run("gradient oval.stl --of leakage");
    assert!(code == 0 && listed.contains("index"), "{stderr}");
    let tiers = desk.run("convert oval oval.asc");
    assert_eq!(tiers.0, 0);
    let listed = desk.done("gradient oval.asc --of leakage");
    assert!(listed.contains("tier:main, degrees") && listed.contains("crown_scale, percent"), "{listed}");
    let ruby = desk.json("gradient emerald --material ruby --by table --of absorbed --of fire --json");
    for name in ["absorbed", "fire"] {
        assert!(at(&ruby["measures"][name]["per"], "table").abs() > 1e-5, "{ruby}");
    }
    for (line, why) in [
        ("tolkowsky --of bow-tie", "give a return"),
        ("tolkowsky --by tilt", "give a proportion"),
        ("tolkowsky --by crown_angel", "no such proportion"),
        ("tolkowsky --by culet", "culet"),
        ("tolkowsky --by tier:P1", "no tiers"),
        ("heart", "convex"),
    ] {
        let (code, printed, stderr) = desk.run(&format!("gradient {line}"));
        assert!(code != 0 && printed.is_empty() && stderr.contains(why), "{line}: {stderr}");
    }
}

#[test]
fn a_gradient_of_a_symmetric_stone_is_that_of_its_neighbours_without_the_symmetry() {
    let desk = Desk::new();
    let text = desk.done("cuts princess");
    assert!(text.contains("length_to_width = 1.0"));
    // A square princess is traced in one wedge of eight, its neighbours in one of four.
    let slopes = |length: &str| {
        desk.write(
            "princess.toml",
            text.replace("length_to_width = 1.0", &format!("length_to_width = {length}")),
        );
        let line = "gradient princess.toml --by length_to_width --of return-cos2 --of leakage --json";
        let (code, printed, stderr) = desk.run(line);
        assert_eq!(code, 0, "{stderr}");
        let found: serde_json::Value = serde_json::from_str(&printed).unwrap();
        ["return-cos2", "leakage"].map(|name| at(&found["measures"][name]["per"], "length_to_width"))
    };
    let [below, square, above] = ["0.999999", "1.0", "1.000001"].map(slopes);
    for k in 0..2 {
        near(square[k], 0.5 * (below[k] + above[k]), 0.05, &format!("{below:?} {square:?} {above:?}"));
    }
    assert!(square[0].abs() > 0.5, "{square:?}");
}

#[test]
fn a_gradient_lists_both_slopes_where_the_planes_have_a_kink() {
    let desk = Desk::new();
    let text = desk.done("cuts asscher");
    assert!(text.contains("length_to_width = 1.0"));
    let slopes = |length: &str| {
        desk.write(
            "asscher.toml",
            text.replace("length_to_width = 1.0", &format!("length_to_width = {length}")),
        );
        let line =
            "gradient asscher.toml --by length_to_width --by table --of return-cos2 --unresolved 0.01 --json";
        let (code, printed, stderr) = desk.run(line);
        assert_eq!(code, 0, "{stderr}");
        let found: serde_json::Value = serde_json::from_str(&printed).unwrap();
        found["measures"]["return-cos2"]["per"].clone()
    };
    let square = slopes("1.0");
    let [below, above] = ["below", "above"].map(|side| at(&square["length_to_width"], side));
    assert!(square["table"].is_number(), "{square}");
    assert!((below - above).abs() > 0.1, "{square}");
    // Beside the kink there is one slope, that of its side.
    for (length, own, other) in [("0.9995", below, above), ("1.001", above, below)] {
        let slope = at(&slopes(length), "length_to_width");
        assert!((slope - own).abs() < (slope - other).abs(), "{length}: {slope}, {square}");
    }
    let listed = desk.done("gradient asscher --of leakage --by length_to_width --unresolved 0.05");
    for said in
        ["length_to_width, below ", "length_to_width, above ", "length_to_width has a kink at this value"]
    {
        assert!(listed.contains(said), "{said}: {listed}");
    }
    // At a length to width of 1 the keel is a point, so that its share changes nothing, which is no kink.
    let listed = desk.done("gradient emerald --of leakage --by length_to_width --by keel --unresolved 0.05");
    assert!(!listed.contains("kink"), "{listed}");
}

#[test]
fn a_table_in_parquet_holds_the_rows_of_one_in_csv() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;
    let desk = Desk::new();
    // The last crown makes no stone, so its row holds an error and no numbers.
    let line = "sweep tolkowsky --over material=diamond,quartz --over crown_angle=34,89 --of leakage --unresolved 0.05";
    desk.run(&format!("{line} --out rows.csv"));
    desk.run(&format!("{line} --out rows.parquet"));
    let (columns, rows) = table(&desk.read("rows.csv"));
    let reader = SerializedFileReader::new(std::fs::File::open(desk.at("rows.parquet")).unwrap()).unwrap();
    let found: Vec<_> = reader.get_row_iter(None).unwrap().map(Result::unwrap).collect();
    assert_eq!((found.len(), rows.len()), (4, 4));
    for (found, row) in found.iter().zip(&rows) {
        let fields: Vec<_> = found.get_column_iter().collect();
        let names: Vec<&String> = fields.iter().map(|(name, _)| *name).collect();
        assert_eq!(names, columns.iter().collect::<Vec<_>>());
        for ((name, field), text) in fields.into_iter().zip(row) {
            let is_same = match field {
                Field::Str(field) => field == text,
                Field::Double(number) => (number - text.parse::<f64>().unwrap()).abs() < 1e-6,
                Field::Null => text.is_empty(),
                _ => false,
            };
            assert!(is_same, "{name}: {field} {text}");
        }
    }
    assert!(found.iter().any(|row| row.get_column_iter().any(|(_, field)| *field == Field::Null)));
    let stderr = desk.refused(&format!("{line} --out rows.parquet --resume"), 2);
    assert!(stderr.contains("only .csv and .jsonl can be resumed"), "{stderr}");
}

#[test]
fn a_sweep_over_the_total_depth_moves_the_pavilion() {
    let desk = Desk::new();
    let (code, printed, note) =
        desk.run("sweep oval --over total_depth=15,60,62 --of leakage --unresolved 0.1");
    assert!(code == 0 && note.contains("1 of 3 points have no measures"), "{code}: {note}");
    let (columns, rows) = table(&printed);
    assert_eq!(columns[1], "total_depth", "{columns:?}");
    let text = rows[0].join(" ");
    assert!(
        text.contains("total_depth: 15 % must be at least 19.53 %, below which no stone has it"),
        "{text}"
    );
    assert!(rows[1..].iter().all(|row| row[3].parse::<f64>().is_ok()), "{rows:?}");
    let both = "sweep oval --over total_depth=60,62 --over pavilion_angle=40,41 --of leakage";
    let stderr = desk.refused(both, 2);
    assert!(stderr.contains("total_depth is reached by changing pavilion_angle"), "{stderr}");
    // The depth is kept whichever number comes first.
    for line in ["--over total_depth=62 --over crown_angle=33", "--over crown_angle=33 --over total_depth=62"]
    {
        let (columns, rows) = table(&desk.done(&format!("sweep oval {line} --of leakage --unresolved 0.1")));
        let last = columns.iter().position(|name| name == "leakage").unwrap();
        assert!((rows[0][last].parse::<f64>().unwrap() - leakage(&desk)).abs() < 1e-9, "{rows:?}");
    }
}

/// Returns the leakage of an oval of these numbers by another way.
fn leakage(desk: &Desk) -> f64 {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/cuts/oval.toml")).unwrap();
    let text = text.lines().map(|line| match line.split(" =").next() {
        Some("pavilion_angle") => "total_depth = 62.0".to_owned(),
        Some("crown_angle") => "crown_angle = 33.0".to_owned(),
        _ => line.to_owned(),
    });
    desk.write("deep.toml", text.collect::<Vec<_>>().join("\n"));
    let (columns, rows) = table(&desk.done("sweep deep.toml --of leakage --unresolved 0.1"));
    rows[0][columns.iter().position(|name| name == "leakage").unwrap()].parse().unwrap()
}
