//! `optimise`: better designs by a goal.

use super::desk::*;

/// Makes a search quick: few designs, followed roughly.
const QUICK: &str = "--scatter 8 --climbs 1 --unresolved 0.03 --unpolarised";

#[test]
fn a_better_brilliant_is_found_written_and_measured_as_it_was_promised() {
    let desk = Desk::new();
    let goal = "--raise return-cos2 --lower leakage=0.5 --vary crown_angle=30:38 --vary pavilion_angle=39:43";
    let found =
        desk.json(&format!("optimise tolkowsky {goal} {QUICK} --json --out better.toml --plot grew.svg"));
    let middle =
        |value: &serde_json::Value, key: &str| 0.5 * (at(&value[key], "least") + at(&value[key], "most"));
    assert!(middle(&found["total"], "after") > middle(&found["total"], "before") + 0.005, "{found}");
    assert_eq!((&found["stopped"], &found["keeps_limits"]), (&false.into(), &true.into()));
    for number in found["numbers"].as_array().unwrap() {
        let after = at(number, "after");
        assert!((at(number, "least")..=at(number, "most")).contains(&after), "{number}");
    }
    // The audit is part of the result, and finds nothing new.
    let audit = &found["audit"];
    assert!(at(audit, "after") <= at(audit, "before"), "{audit}");
    // The curve rises to the end.
    let curve: Vec<f64> =
        found["curve"].as_array().unwrap().iter().map(|point| point[1].as_f64().unwrap()).collect();
    assert!(curve.len() > 1 && curve.windows(2).all(|pair| pair[0] < pair[1]), "{curve:?}");
    assert!(desk.read("grew.svg").contains("designs appraised"));
    // The notes of the given design do not hold for the design that was found, which has its own name.
    let written = desk.read("better.toml");
    assert!(written.contains(", improved\"") && !written.contains("notes"), "{written}");
    // The design that was written has the promised measures.
    let measured = desk.json("measure better.toml --measures --json --unpolarised --unresolved 0.002");
    for value in found["measures"].as_array().unwrap() {
        let (promised, own) = (&value["after"], &measured["measures"][value["of"].as_str().unwrap()]);
        let (least, most) = (at(promised, "least") - 1e-6, at(promised, "most") + 1e-6);
        assert!(at(own, "most") >= least && at(own, "least") <= most, "{value} {own}");
    }
    let listed = desk.done(&format!("optimise tolkowsky {goal} {QUICK}"));
    for words in ["Won\n", "Numbers\n", "Audit\n", "designs appraised", "Crown angle", "from 39 to 43"] {
        assert!(listed.contains(words), "{words}: {listed}");
    }
    assert_eq!(listed, desk.done(&format!("optimise tolkowsky {goal} {QUICK}")), "two runs differ");
}

#[test]
fn without_a_goal_a_search_says_what_it_raises_and_angles_end_on_the_scale_that_was_given() {
    let desk = Desk::new();
    let line =
        format!("optimise tolkowsky {QUICK} --vary crown_angle=34:38 --vary table=53:60 --angle-step 0.5");
    let (code, printed, stderr) = desk.run(&line);
    assert!(code == 0 && stderr.contains("return-cos2=0.5") && stderr.contains("fire=1"), "{stderr}");
    assert!(printed.starts_with("bright and fiery: "), "{printed}");
    let found: serde_json::Value = serde_json::from_str(&desk.run(&format!("{line} --json")).1).unwrap();
    let after = |key: &str| {
        let numbers = found["numbers"].as_array().unwrap();
        at(numbers.iter().find(|number| number["key"] == key).unwrap(), "after")
    };
    let steps = after("crown_angle") / 0.5;
    assert!((steps - steps.round()).abs() < 1e-6, "{found}");
    // A number at an end of its range may want a wider one.
    let line = "optimise tolkowsky --raise return-cos2 --vary pavilion_angle=40.5:42";
    let ended = desk.done(&format!("{line} {QUICK}"));
    assert!(ended.contains(", ended at the "), "{ended}");
}

#[test]
fn a_goal_file_holds_limits_and_a_goal_that_cannot_be_kept_leaves_the_design() {
    let desk = Desk::new();
    let goal = |limit: &str| {
        format!(
            "name = \"bright and thin\"\n[[measure]]\nof = \"return-cos2\"\nmaterial = [\"quartz\", 1.7]\n[vary]\n\
             pavilion_angle = [39, 43]\n[limit]\nheight_to_width = {{ {limit} }}\n"
        )
    };
    desk.write("goal.toml", goal("at_most = 0.61"));
    let found = desk.json(&format!("optimise tolkowsky --goal goal.toml {QUICK} --json"));
    let limit = &found["limits"][0];
    assert!(at(limit, "before") > 0.61 && at(limit, "after") <= 0.61 + 1e-9, "{limit}");
    assert_eq!(found["measures"].as_array().unwrap().len(), 2, "{found}");
    desk.write("never.toml", goal("at_most = 0.1"));
    let (code, printed, stderr) = desk.run(&format!("optimise tolkowsky --goal never.toml {QUICK} --json"));
    assert!(code == 0 && stderr.contains("keeps all limits; the design stays as it is"), "{code}: {stderr}");
    let found: serde_json::Value = serde_json::from_str(&printed).unwrap();
    let number = &found["numbers"][0];
    assert_eq!((&found["keeps_limits"], &number["before"]), (&false.into(), &number["after"]));
}

#[test]
fn a_search_whose_time_is_over_ends_with_what_it_has() {
    let desk = Desk::new();
    let line = format!("optimise tolkowsky --raise return-even {QUICK} --seconds 0 --json --out kept.toml");
    let (code, printed, stderr) = desk.run(&line);
    assert!(code == 0 && stderr.contains("was stopped early"), "{code}: {stderr}");
    let found: serde_json::Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(found["stopped"], true);
    assert!(desk.at("kept.toml").exists());
}

#[test]
fn what_is_wrong_with_a_goal_is_said() {
    let desk = Desk::new();
    desk.write("typo.toml", "[[measure]]\nof = \"brightness\"\n");
    for (line, told) in [
        ("tolkowsky --angle-step 0", "0.001 to 10"),
        ("tolkowsky --raise brightness", "is no measure"),
        ("tolkowsky --raise fire=-1", "weight above 0"),
        ("tolkowsky --raise fire --vary crown_angle=40:30", "a number and its range"),
        ("tolkowsky --raise fire --vary crow_angle=30:40", "crow_angle"),
        ("tolkowsky --raise fire --out better.stl", ".toml, .asc, .gem or .gcs"),
        ("tolkowsky --raise fire --unresolved 2", "between 0 and 1"),
        ("tolkowsky --goal typo.toml", "typo.toml:2"),
        ("tolkowsky --goal missing.toml", "missing.toml"),
        ("heart --raise fire", "heart"),
    ] {
        let (code, _, stderr) = desk.run(&format!("optimise {line}"));
        assert!(code != 0 && stderr.contains(told), "{line}: {code} {stderr}");
    }
    assert!(!desk.at("better.stl").exists());
}
