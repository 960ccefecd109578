//! Tests of the commands for cutters: an audit, another material, and the size of a stone from a piece of rough.

use super::desk::*;

#[test]
fn an_audit_lists_candidates_alone_and_beside_the_stone_as_json() {
    let desk = Desk::new();
    let leaks = desk.done("info tolkowsky --audit --material 1.5");
    assert!(leaks.contains("below the critical angle") && leaks.contains("for you to judge"), "{leaks}");
    assert!(
        !leaks.contains("lower_half") && leaks.starts_with("tolkowsky: "),
        "the list stands alone: {leaks}"
    );
    assert!(desk.done("info tolkowsky --audit --facets --material 1.5").contains("lower_half 16"));
    assert!(desk.done("info tolkowsky --audit").contains("audit: nothing found"));
    assert!(!desk.done("info tolkowsky --material 1.5").contains("audit"));
    let audit = &desk.json("info --json --audit tolkowsky --material 1.5")["audit"];
    assert_eq!((&audit["counts"]["below_critical"], &audit["counts"]["near_miss"]), (&1.into(), &0.into()));
    let leak = &list(&audit["findings"])[0];
    near(at(leak, "threshold"), 41.81, 0.01, "the critical angle of 1.5");
    near(at(leak, "size"), 40.75, 1e-6, "the mains");
    assert_eq!(leak["unit"], "degrees");
    assert!(!list(&desk.json("info --json --audit tolkowsky")["facets"]).is_empty(), "JSON has all");
    let (code, printed, stderr) = desk.run("info --audit pill cube tolkowsky --json");
    assert_eq!((code, printed.lines().count()), (0, 3), "{stderr}");
    assert!(
        stderr.contains("pill: only a convex stone") && stderr.contains("a glass shape is curved"),
        "{stderr}"
    );
    // A heart gets no candidates by its cleft: nothing of it is audited, and that is said.
    let (code, printed, stderr) = desk.run("info --audit --json heart");
    assert_eq!(
        (code, &serde_json::from_str::<serde_json::Value>(&printed).unwrap()["audit"]),
        (0, &().into())
    );
    for said in
        ["a heart is not convex at its cleft", "slivers", "critical angles", "have not been looked at"]
    {
        assert!(stderr.contains(said), "{said}: {stderr}");
    }
}

#[test]
fn a_heart_is_refused_with_code_1_wherever_convex_stones_are_needed_and_the_reason_is_its_cleft() {
    let desk = Desk::new();
    for (line, told) in [
        ("gradient heart", "compare the designs by `measure`"),
        ("optimise heart --raise fire", "compare the designs by `measure`"),
        ("sheet heart", "`convert` writes its shape"),
        ("convert heart heart.asc", "write .toml, .obj"),
        ("convert --meets heart heart.toml", "leave the option out"),
        ("measure --measures heart", "`measure` without this option"),
        ("measure --hearts heart", "round brilliants"),
        ("measure --spread heart", "spread"),
        ("measure --deviations heart", "deviations"),
        ("measure --estimate heart", "classes"),
    ] {
        let stderr = desk.refused(line, 1);
        assert!(stderr.contains("a heart is not convex at its cleft"), "{line}: {stderr}");
        assert!(stderr.contains(told), "{line}: {stderr}");
    }
    // What an option alone excludes is the command line's fault.
    desk.refused("gradient tolkowsky --by crown_angel", 2);
    desk.refused("optimise tolkowsky --raise brightness", 2);
    desk.refused("measure heart --tracer beam", 2);
}

#[test]
fn mains_of_a_heart_are_counted_alike_with_a_culet_and_without() {
    let desk = Desk::new();
    let text = desk.done("cuts heart");
    assert!(text.contains("culet = 0.0"));
    desk.write("culet.toml", text.replace("culet = 0.0", "culet = 5.0"));
    for (file, culets) in [("heart", 0), ("culet.toml", 1)] {
        let tiers = desk.json(&format!("info --json {file}"))["tiers"].clone();
        let count = |name: &str| {
            let tier = list(&tiers).iter().find(|tier| tier["name"] == name);
            tier.map_or(0, |tier| tier["facets"].as_u64().unwrap())
        };
        assert_eq!(["bezel", "main", "lower_half", "culet"].map(count), [9, 9, 16, culets], "{file}");
    }
}

#[test]
fn meets_are_listed_alone_below_what_became_of_them() {
    let desk = Desk::new();
    let (code, _, stderr) = desk.run("convert tolkowsky tolkowsky.asc");
    assert_eq!(code, 0, "{stderr}");
    let table = desk.done("info --meets tolkowsky.asc");
    let lines: Vec<&str> = table.lines().collect();
    assert!(lines[1].starts_with("  meets of ") && lines[1].contains("found in the geometry"), "{table}");
    assert!(lines[2].contains("no tier moves by more than"), "{table}");
    assert!(table.contains("Meet ") && !table.contains("volume"), "{table}");
    assert!(desk.json("info --meets --json tolkowsky.asc")["volume"].is_number());
}

#[test]
fn a_family_becomes_tiers_with_meets_in_one_step() {
    let desk = Desk::new();
    let (code, _, stderr) = desk.run("convert --meets oval oval.toml");
    assert!(code == 0 && stderr.contains("turned into ") && stderr.contains("between the teeth"), "{stderr}");
    let text = desk.read("oval.toml");
    for said in ["[index]", "[\"P1\"]", "[\"G1\"]", "[\"C1\"]", "[\"T\"]", "meet = "] {
        assert!(text.contains(said), "{said} is missing: {text}");
    }
    assert!(!text.contains("bezel"));
    // It is the same stone, and following it again moves nothing.
    let [before, after] = ["oval", "oval.toml"].map(|file| desk.json(&format!("info --json {file}")));
    near(at(&after, "volume"), at(&before, "volume"), 1e-4 * at(&before, "volume"), "volume");
    let (code, _, stderr) = desk.run("convert --meets oval.toml again.toml");
    assert!(code == 0 && !stderr.contains("becomes") && !stderr.contains("warning"), "{stderr}");
    // Cutters' files contain its meets as instructions, which are read as the same meets.
    assert_eq!(desk.run("convert --meets emerald emerald.asc").0, 0);
    assert!(desk.read("emerald.asc").contains(" G Meet "), "{}", desk.read("emerald.asc"));
    let (code, table, stderr) = desk.run("info --meets emerald");
    assert!(code == 0 && stderr.contains("turned into ") && table.contains("found   Meet "), "{table}");
    assert!(!table.contains("ambiguous"), "{table}");
    for body in ["heart", "pill"] {
        assert!(
            desk.refused(&format!("convert --meets {body} out.toml"), 1).contains("leave the option out")
        );
    }
}

#[test]
fn a_design_is_fitted_to_another_material_written_and_measured_beside_the_old_one() {
    let desk = Desk::new();
    let line = "retarget tolkowsky --material sapphire --rule tangent-ratio --factor 1.02";
    let value = desk.json(&format!("{line} --json --out fitted.toml"));
    let light = list(&value["light"]);
    let measured = desk.json("measure tolkowsky --json");
    near(at(&light[0], "light_return"), at(&measured, "light_return"), 1e-9, "the old stone");
    let fitted = desk.json("measure fitted.toml --json");
    near(at(&light[2], "light_return"), at(&fitted, "light_return"), 1e-9, "the new stone");
    let info = desk.json("info fitted.toml --json");
    near(at(&info, "derived/pavilion_angle"), -at(&list(&value["tiers"])[1], "after_deg"), 1e-9, "its mains");
    assert_eq!(info["material"], "sapphire");
    assert!(info["notes"].as_str().unwrap().contains("tangent ratio of 1.0200"), "{info}");
    let table = desk.done(&format!("{line} --no-light"));
    assert!(table.contains("diamond to sapphire") && !table.contains("light return"), "{table}");
    let red = desk.json(&format!("{line} --json --wavelength 650"));
    assert_eq!((at(&value, "wavelength_nm"), at(&red, "wavelength_nm")), (589.3, 650.0));
    let measured = desk.json("measure tolkowsky --json --wavelength 650");
    near(
        at(&list(&red["light"])[0], "light_return"),
        at(&measured, "light_return"),
        1e-9,
        "the old stone in red",
    );
    assert!(at(&list(&red["light"])[0], "index") < at(&light[0], "index"), "{red}");
}

#[test]
fn what_retarget_cannot_do_is_refused_with_what_to_give() {
    let desk = Desk::new();
    for (line, code, told) in [
        ("tolkowsky --material ruby --rule critical-angle --factor 1.1", 2, "for --rule tangent-ratio"),
        ("tolkowsky --material ruby --rule tangent-ratio --side crown", 2, "give it by --factor"),
        ("tolkowsky --material ruby --rule tangent-ratio --factor 100", 2, "must be from 0.1 to 10"),
        ("tolkowsky --material ruby --rule critical-angle --out a.stl", 2, ".toml, .asc, .gem or .gcs"),
        ("tolkowsky --material rubby --rule critical-angle", 2, "did you mean 'ruby'"),
        ("tolkowsky --material ruby --rule critical-angle --wavelength 5", 2, "is not light"),
        ("pill --material ruby --rule critical-angle", 1, "a glass shape is curved"),
        ("heart --material ruby --rule critical-angle", 1, "a heart is a mesh that is not convex"),
    ] {
        let stderr = desk.refused(&format!("retarget {line}"), code);
        assert!(stderr.contains(told), "{line}: {stderr}");
    }
}

#[test]
fn rough_gives_size_weight_and_yield() {
    let desk = Desk::new();
    let value = desk.json("yield tolkowsky --rough 6.5x8x6 --rough-weight 6 --json");
    near(at(&value, "finished/diameter_mm"), 6.5, 0.01, "as wide as the rough");
    near(at(&value, "carats"), at(&desk.json("info tolkowsky --json"), "carats"), 0.01, "weight");
    near(at(&value, "yield_of_weight_percent"), 100.0 * at(&value, "carats") / 6.0, 1e-9, "by weight");
    let [depth, left] = [at(&value, "finished/size_mm/2"), at(&value, "finished/depth_left_mm")];
    near(depth + left, 6.0, 1e-9, "depth");
    let weight = desk.json("yield tolkowsky --weight 1.5 --girdle-mm 0.2 --json");
    near(at(&weight, "carats"), 1.5, 1e-5, "weight");
    near(at(&weight, "finished/girdle_mm"), 0.2, 1e-9, "girdle");
    let size = desk.json("yield tolkowsky --stone 6.5mm --rough-weight 6 --json");
    near(at(&size, "finished/diameter_mm"), 6.5, 1e-9, "size");
    let carats = at(&desk.json("info tolkowsky --stone 6.5mm --json"), "carats");
    near(at(&size, "carats"), carats, 1e-9, "weight of a size");
    near(at(&size, "yield_of_weight_percent"), 100.0 * carats / 6.0, 1e-9, "yield of a size");
    assert!(desk.refused("yield tolkowsky --stone 6.5mm --weight 1", 2).contains("cannot be used with"));
    assert!(desk.done("yield tolkowsky --rough 9x9x3").contains("the rough's depth"));
    assert!(desk.refused("yield tolkowsky --rough 9x9", 2).contains("as in 12x9x7"));
    assert!(desk.refused("yield tolkowsky --weight -1", 2).contains("is not a weight"));
    assert!(desk.refused("yield tolkowsky --rough 9x9x3 --girdle-mm 4", 2).contains("does not fit"));
    assert!(desk.refused("yield tolkowsky", 2).contains("--rough"));
    // A stone of one index has no density, and the line says what gives one.
    let unknown = desk.done("yield tolkowsky --rough 9x9x6 --material 1.5");
    assert!(unknown.contains("no density is known of index 1.5; name a material by --material"), "{unknown}");
    assert!(desk.done("info tolkowsky --material 1.5").contains("name a material by --material"));
    assert!(desk.done("info tolkowsky").contains(" ct\n"));
    let heart = desk.json("yield heart --weight 1 --json");
    near(at(&heart, "carats"), 1.0, 1e-9, "a heart is weighed by its volume");
    assert!(heart["finished"]["girdle_mm"].is_null());
    assert!(desk.refused("yield heart --weight 1 --girdle-mm 0.1", 1).contains("leave out --girdle-mm"));
    assert!(desk.refused("yield pill --weight 1", 1).contains("a glass shape is curved"));
    let light = desk.refused("yield tolkowsky --rough 9x9x7 --rough-weight 1", 2);
    assert!(light.contains("would weigh 2.737 ct, and --rough-weight gives the rough 1 ct"), "{light}");
}

#[test]
fn a_main_that_is_turned_is_found_in_a_design_and_in_its_mesh_and_other_shapes_are_refused() {
    let desk = Desk::new();
    assert_eq!(desk.run("convert tolkowsky whole.asc").0, 0);
    let text = desk.read("whole.asc");
    // The index before the name is that of main 1. 0.08 of 96 teeth are 0.3 degrees.
    let turned = text.replace("n main 36 48", "n main 36.08 48");
    assert_ne!(text, turned);
    desk.write("turned.asc", &turned);
    assert_eq!(desk.run("convert turned.asc turned.stl").0, 0);
    let classes_of = |file: &str| {
        let (code, printed, stderr) = desk.run(&format!("measure --deviations --json {file}"));
        assert_eq!(code, 0, "{stderr}");
        list(&serde_json::from_str::<serde_json::Value>(&printed).unwrap()["deviations"]).to_vec()
    };
    for (file, amount, tolerance) in
        [("whole.asc", 0.0, 1e-9), ("turned.asc", 0.3, 1e-9), ("turned.stl", 0.3, 1e-4)]
    {
        for class in classes_of(file) {
            let expected = if class["class"] == "main" { amount } else { 0.0 };
            near(at(&class, "azimuth_spread_deg"), expected, tolerance, &format!("{file}: {class}"));
            near(at(&class, "slope_spread_deg"), 0.0, tolerance, &format!("{file}: {class}"));
        }
    }
    let main = &classes_of("turned.asc")[4];
    assert_eq!(main["worst_azimuth"]["facet"], "main 2", "{main}");
    assert!(desk.done("measure --deviations tolkowsky").contains("upper half"));
    for (shape, why) in [("heart", "convex"), ("oval", "eight octants"), ("pill", "convex")] {
        let (code, printed, stderr) = desk.run(&format!("measure --deviations {shape}"));
        assert!(code != 0 && printed.is_empty() && stderr.contains(why), "{stderr}");
    }
}

#[test]
fn hearts_and_arrows_say_which_main_is_turned_in_a_design_and_in_its_mesh() {
    let desk = Desk::new();
    assert_eq!(desk.run("convert modern-ideal whole.asc").0, 0);
    let text = desk.read("whole.asc");
    let turned = text.replace("n main 36 48", "n main 36.08 48");
    assert_ne!(text, turned);
    desk.write("turned.asc", &turned);
    assert_eq!(desk.run("convert turned.asc turned.stl").0, 0);
    let of = |file: &str| {
        let (code, printed, stderr) = desk.run(&format!("measure --hearts --unresolved 0.02 --json {file}"));
        assert_eq!(code, 0, "{stderr}");
        serde_json::from_str::<serde_json::Value>(&printed).unwrap()
    };
    let whole = of("whole.asc");
    for pattern in ["arrows", "hearts"] {
        let pattern = &whole["hearts_and_arrows"][pattern];
        near(at(pattern, "departure"), 0.0, 1e-9, "an ideal cut");
        for figure in list(&pattern["figures"]) {
            near(at(figure, "spread"), 0.0, 1e-9, &format!("{figure}"));
        }
    }
    for (file, tolerance) in [("turned.asc", 1e-9), ("turned.stl", 1e-4)] {
        let found = of(file);
        let arrows = &found["hearts_and_arrows"]["arrows"];
        let departures: Vec<f64> =
            list(&arrows["departures"]).iter().map(|each| each.as_f64().unwrap()).collect();
        let mut octants: Vec<usize> = (0..8).collect();
        octants.sort_by(|a, b| departures[*b].total_cmp(&departures[*a]));
        assert_eq!(octants[0] % 4, octants[1] % 4, "{file}: {departures:?}");
        assert!(departures[octants[1]] > 20.0 * departures[octants[2]], "{file}: {departures:?}");
        let main = &list(&found["deviations"])[4];
        near(at(main, "azimuth_spread_deg"), 0.3, tolerance, file);
        let named = main["worst_azimuth"]["facet"].as_str().unwrap();
        let shown = [0, 1].map(|k| list(&arrows["mains"])[octants[k]].as_str().unwrap());
        assert!(shown.contains(&named), "{file}: {named} {shown:?}");
    }
    let table = desk.done("measure --hearts --unresolved 0.05 turned.asc");
    assert!(table.contains("gap to the V") && table.contains("main 2: azimuth +0.300°"), "{table}");
    for (shape, why) in [("heart", "convex"), ("oval", "eight octants"), ("pill", "convex")] {
        let (code, printed, stderr) = desk.run(&format!("measure --hearts {shape}"));
        assert!(code != 0 && printed.is_empty() && stderr.contains(why), "{stderr}");
    }
    assert!(desk.refused("measure --hearts tolkowsky --tilt 3", 2).contains("--tilt"));
}

#[test]
fn spread_is_the_same_in_every_size_and_follows_the_girdle() {
    let desk = Desk::new();
    let of = |line: &str| desk.json(&format!("measure --spread --json {line}"))["spread"].clone();
    let (small, large) = (of("modern-ideal --stone 1ct"), of("modern-ideal --stone 10mm"));
    near(at(&small, "spread_percent"), at(&large, "spread_percent"), 1e-9, "any size");
    near(at(&small, "weight_ratio"), at(&large, "weight_ratio"), 1e-9, "any size");
    near(at(&small, "carats"), 1.0, 1e-9, "its weight");
    near(at(&small, "face_mm2"), at(&small, "mm2_per_carat"), 1e-9, "of one carat");
    assert!(of("oval")["weight_ratio"].is_null());
    assert!(desk.done("measure --spread tolkowsky").contains("mm²/ct"));
    assert!(desk.refused("measure --spread heart", 1).contains("convex"));
}

#[test]
fn a_class_is_an_estimate_of_brilliants_of_diamond_and_never_called_a_grade() {
    let desk = Desk::new();
    let of = |line: &str| desk.json(&format!("measure --estimate --json {line}"));
    let ideal = of("modern-ideal");
    let estimate = &ideal["estimate_after_gia"];
    assert_eq!(estimate["class"], "EX", "{ideal}");
    assert_eq!(list(&estimate["limits"]).len(), 8, "{ideal}");
    assert!(ideal["note"].as_str().unwrap().contains("not a grade"));
    assert_ne!(of("steep-deep")["estimate_after_gia"]["class"], "EX");
    // A cutter's file has no proportions, so they are measured on the stone.
    assert_eq!(desk.run("convert modern-ideal ideal.asc").0, 0);
    assert_eq!(of("ideal.asc --material diamond")["estimate_after_gia"]["class"], "EX");
    let table = desk.done("measure --estimate modern-ideal tolkowsky");
    assert!(table.contains("not a grade") && table.contains("Pavilion angle, °"), "{table}");
    for (line, code, why) in [
        ("modern-ideal --material ruby", 2, "diamond"),
        ("heart", 1, "convex"),
        ("princess --material diamond", 1, "round brilliant"),
    ] {
        let stderr = desk.refused(&format!("measure --estimate {line}"), code);
        assert!(stderr.contains(why), "{line}: {stderr}");
    }
    assert!(desk.refused("measure --estimate tolkowsky --tilt 3", 2).contains("--tilt"));
}
