//! The key `meet` of a tier.

use super::super::*;
use brillianteer_cut::{GivenSize, Meet, MeetPoint};

/// Returns a file of a tier with a meet, which is at fault or not.
fn with_meet(meet: &str) -> String {
    format!(
        "format = 1\nname = \"x\"\nmaterial = 1.5\n[index]\ngear = 96\n[[tier]]\nangle = -45\ndistance = 1\n\
         indices = [96, 24, 48, 72]\nmeet = {meet}\n"
    )
}

fn read(meet: &str) -> Result<Meet, String> {
    let design = parse(&with_meet(meet), "x.toml").map_err(|error| error.to_string())?;
    // A design that was read is written and reads back.
    assert_eq!(parse(&write(&design), "again").unwrap(), design);
    let Cut::Tiers(mut tiers) = design.cut else { panic!("tiers are expected") };
    Ok(tiers.tiers.remove(0).meet.unwrap())
}

#[test]
fn a_meet_reads_as_written() {
    let corner = |names: &[&str]| MeetPoint::Corner(names.iter().map(|&name| name.to_owned()).collect());
    let centre = MeetPoint::Centre { temporary: false };
    let second = MeetPoint::LaterCorner { names: ["1", "G"].map(str::to_owned).to_vec(), reached: 2 };
    for (text, meet) in [
        ("\"level girdle\"", Meet::Points(vec![MeetPoint::LevelGirdle])),
        ("\"girdle point\"", Meet::Points(vec![MeetPoint::GirdlePoint])),
        ("\"temporary centre point\"", Meet::Points(vec![MeetPoint::Centre { temporary: true }])),
        ("\"girdle thickness\"", Meet::Given(GivenSize::GirdleThickness)),
        ("\"new centre point\"", Meet::Given(GivenSize::CentrePoint)),
        ("[{ corner = [\"1\", \"G\"], reached = 2 }]", Meet::Points(vec![second])),
        ("[{ corner = [\"1\", \"G\"], reached = 1 }]", Meet::Points(vec![corner(&["1", "G"])])),
        ("\"centre angle 41.7\"", Meet::CentreAngle(41.7)),
        ("[\"1\", \"girdle-2\", \"1\"]", Meet::Points(vec![corner(&["1", "girdle-2", "1"])])),
        ("[[\"1\", \"G\"], \"centre point\"]", Meet::Points(vec![corner(&["1", "G"]), centre])),
    ] {
        assert_eq!(read(text), Ok(meet), "{text}");
    }
}

#[test]
fn a_meet_at_fault_is_named_with_its_line() {
    for (text, expected) in [
        (
            "\"level\"",
            "x.toml:10: meet: 'level' is no meet; give centre point, temporary centre point, level girdle, girdle \
             point, size, girdle thickness, new centre point, centre angle 41.7, or a list of names of tiers",
        ),
        (
            "\"centre angle 90\"",
            "x.toml:10: meet: 'centre angle 90' has no angle above 0 and below 90 degrees, as in \"centre angle \
             41.7\"",
        ),
        (
            "[{ corner = [\"1\"], reached = 0 }]",
            "x.toml:10: meet: reached is 0; the corner that a facet reaches first is 1",
        ),
        ("[]", "x.toml:10: meet: 0 points are given; from 1 to 3 are expected"),
        (
            "[[], \"level girdle\"]",
            "x.toml:10: meet: a corner has no names; list those of the tiers that meet there",
        ),
    ] {
        assert_eq!(read(text), Err(expected.to_owned()), "{text}");
    }
    let error = read("7").unwrap_err();
    assert!(error.starts_with("x.toml:10:") && error.contains("a meet is words"), "{error}");
}
