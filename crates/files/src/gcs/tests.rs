use super::*;
use crate::cutters::sample::{design, others, specimen, tiers};
use crate::design_file::{EncodedDesign, ImportedDesign};
use brillianteer_cut::{Cut, Design, MaterialRef, Tier, TierZone};
use brillianteer_math::{Plane, Polytope};
use proptest::prelude::*;

/// Two pyramids on one base, a quarter of their facets given by normals, the rest by angle and index.
const PYRAMIDS: &str = r#"<GemCutStudio version="1000">
<index gear="96" base="24" symmetry="4" mirror="1" phase="2"/>
<tier angle="45" depth="0.7" name="C" instructions="Two
lines &amp; a	tab" visible="true" guide="false">
<facet nx="0.7071067811865476" ny="0" nz="0.7071067811865476" index_angle="90"/>
<facet nx="-0.7071067811865476" ny="0" nz="0.7071067811865476" index_angle="270"/>
<facet index_angle="180"/><facet index_angle="0"/>
</tier>
<tier angle="135" depth="0.7" name="P"><facet index_angle="0"/><facet index_angle="90"/><facet index_angle="180"/>
<facet index_angle="270"/></tier>
<tier angle="180" depth="0.1" name="K" visible="false"><facet nx="0" ny="0" nz="-1"/></tier>
<render material="Glas" refractive_index="1.5" dispersion="0.02" clarity="100"><color r="1" g="0" b="0.5"/></render>
<info title="Pyramids" author="" date="1 May" header2="more
and more" footer1="" footer2="end" shape="Square"/>
</GemCutStudio>
"#;

fn back(text: &[u8]) -> ImportedDesign {
    read(text, "box.gcs").unwrap()
}

fn refused(text: &str) -> String {
    read(text.as_bytes(), "box.gcs").unwrap_err().in_file("box.gcs").to_string()
}

#[test]
fn a_design_reads_as_it_is_written() {
    let mut design = design();
    tiers(&mut design).remarks =
        [("date", "1.\n2."), ("density", "3.5"), ("size_min", "8")].map(|(a, b)| (a.into(), b.into())).into();
    tiers(&mut design).tiers[3].is_cut = false;
    let EncodedDesign { bytes, lost } = write(&specimen(design.clone()));
    assert_eq!(lost, Vec::<String>::new());
    assert!(looks_like(&bytes));
    assert_eq!(back(&bytes), ImportedDesign::of(design));
}

#[test]
fn all_that_a_file_says_is_kept() {
    let ImportedDesign { mut design, warnings, .. } = back(PYRAMIDS.as_bytes());
    assert!(warnings.iter().all(|warning| warning.contains("angle and index_angle are used instead")));
    assert_eq!(warnings.len(), 6);
    assert!(warnings[0].starts_with("line 7: "), "{}", warnings[0]);
    assert_eq!((design.name.as_str(), &design.material), ("Pyramids", &MaterialRef::Index(1.5)));
    // Planes are in the file's own unit; a stone of them is scaled to its girdle.
    let planes: Vec<Plane> = design.facets().unwrap().into_iter().map(|(_, plane)| plane).collect();
    let solid = Polytope::from_planes(&planes).unwrap();
    assert!((solid.volume() - 8.0 / 3.0 * 0.98f64.powf(1.5)).abs() < 1e-9);
    let tiers = tiers(&mut design);
    assert_eq!(tiers.headers, ["Pyramids", "", "more", "and more"]);
    assert_eq!(tiers.footers, ["", "end"]);
    let remarks: Vec<String> = tiers.remarks.iter().map(|(key, text)| format!("{key}={text}")).collect();
    assert_eq!(
        remarks,
        ["color=1 0 0.5", "date=1 May", "dispersion=0.02", "material=Glas", "phase=2", "shape=Square"]
    );
    assert_eq!(tiers.tiers[0].instructions, "Two\nlines & a\ttab");
    let indices = |tier: &Tier| tier.facets.iter().map(|facet| facet.index).collect::<Vec<_>>();
    assert_eq!(indices(&tiers.tiers[0]), [48.0, 96.0, 72.0, 24.0]);
    assert_eq!(indices(&tiers.tiers[1]), [24.0, 96.0, 72.0, 48.0]);
    assert_eq!((tiers.tiers[2].zone(), tiers.tiers[2].is_cut), (TierZone::Culet, false));
    // The file is not scaled as the format wants; once it is, it reads back as written.
    let scaled = back(&write(&specimen(design.clone())).bytes);
    assert_eq!(scaled.warnings, Vec::<String>::new());
    assert_eq!(back(&write(&specimen(scaled.design.clone())).bytes).design, scaled.design);
}

#[test]
fn stones_are_scaled_and_centred() {
    for stone in others() {
        let EncodedDesign { bytes, .. } = write(&stone);
        let ImportedDesign { design, warnings, .. } = back(&bytes);
        assert_eq!(warnings, Vec::<String>::new());
        let scaled = specimen(design);
        let planes: Vec<_> = scaled.design.facets().unwrap().into_iter().map(|(_, plane)| plane).collect();
        let (low, high) = brillianteer_math::Polytope::from_planes(&planes).unwrap().bounds();
        assert!((high.z + low.z).abs() < 1e-9);
        assert!((low.abs().max(high.abs()).truncate().max_element() - 1.0).abs() < 1e-9);
    }
}

#[test]
fn a_stone_beside_the_origin_is_moved_along_its_axis() {
    // Lifted by 1: depths change by the normal's z.
    let z = 0.5f64.sqrt();
    let lifted = PYRAMIDS
        .replacen("depth=\"0.7\"", &format!("depth=\"{}\"", 0.7 + z), 1)
        .replacen("depth=\"0.7\"", &format!("depth=\"{}\"", 0.7 - z), 1)
        .replacen("depth=\"0.1\"", "depth=\"-0.9\"", 1);
    let [flat, lifted] = [PYRAMIDS, &lifted].map(|text| back(text.as_bytes()));
    assert!(
        lifted.warnings.iter().any(|text| text.ends_with("beside the origin; it is moved by -1.000000 in z"))
    );
    let [flat, lifted] = [flat, lifted].map(|brought| specimen(brought.design));
    let facets = [&flat, &lifted].map(|specimen| specimen.design.facets().unwrap());
    for ((_, a), (_, b)) in facets[0].iter().zip(&facets[1]) {
        assert!((a.normal - b.normal).length() < 1e-12 && (a.offset - b.offset).abs() < 1e-12);
    }
}

#[test]
fn a_stone_whose_middle_lies_outside_stays_where_it_is() {
    let mut leaning = design();
    let cut = tiers(&mut leaning);
    // Two facets that leave the axis only its upper end.
    cut.tiers[3].angle = -60.0;
    cut.tiers[3].distance = 0.0;
    cut.tiers[3].facets.truncate(1);
    cut.tiers[4].distance = 0.1;
    let EncodedDesign { bytes, lost } = write(&specimen(leaning));
    assert!(lost.iter().any(|text| text.contains("not centred in height")), "{lost:?}");
    let scaled = back(&bytes);
    assert_eq!(scaled.warnings, Vec::<String>::new());
    assert_eq!(back(&write(&specimen(scaled.design.clone())).bytes).design, scaled.design);
}

#[test]
fn a_long_name_is_not_multiplied() {
    let facets: String = (0..9000)
        .map(|k| format!("<facet nx='0' ny='{}' nz='{}'/>", f64::from(k).sin(), f64::from(k).cos()))
        .collect();
    let long = "n".repeat(1 << 20);
    let text = format!(
        "<GemCutStudio><tier name='{long}' instructions='{long}' depth='1'>{facets}</tier></GemCutStudio>"
    );
    let mut design = back(text.as_bytes()).design;
    let held: usize =
        tiers(&mut design).tiers.iter().map(|tier| tier.name().len() + tier.instructions.len()).sum();
    assert_eq!(held, 2 * long.len());
}

#[test]
fn what_the_format_cannot_hold_is_told() {
    let mut full = Design { notes: Some("a note".to_owned()), ..design() };
    let cut = tiers(&mut full);
    cut.tiers[0].angle = 90.0;
    cut.tiers[0].facets[2].name = "H".to_owned();
    cut.tiers[1].instructions = "bell\u{7}".to_owned();
    cut.remarks = [("line 3".to_owned(), "what?".to_owned())].into();
    cut.tiers.push(Tier { facets: vec![], ..cut.tiers[1].clone() });
    let expected = [
        "the format cannot hold the design's notes",
        "1 tier has facets of other names, which are left out",
        "1 tier of girdle facets is cut at +90°, for which the format has -90°",
        "1 tier has no facets and will be read without a name",
        "1 remark has a key that XML cannot hold",
        "2 characters that XML cannot hold are left out",
    ];
    let EncodedDesign { bytes, lost } = write(&specimen(full));
    assert_eq!(lost, expected);
    assert!(back(&bytes).warnings[0].ends_with("this tier has no facets"));
}

#[test]
fn faults_are_told_with_their_line() {
    let with = |from: &str, to: &str| {
        assert!(PYRAMIDS.contains(from), "{from}");
        PYRAMIDS.replacen(from, to, 1)
    };
    let cases = [
        (with("</tier>", ""), "box.gcs:15: "),
        ("<x/>".to_owned(), "box.gcs:1: <GemCutStudio> is expected; this is another kind of XML"),
        ("gear 96\na 41 0.65".to_owned(), "box.gcs: this is not a Gem Cut Studio file"),
        (
            "<!DOCTYPE x [<!ENTITY a 'b'>]><GemCutStudio/>".to_owned(),
            "box.gcs:1: this XML cannot be read: it has a DOCTYPE",
        ),
        (
            with("depth=\"0.7\" name=\"P\"", ""),
            "box.gcs:9: depth: the tier has none and the facet has no corners",
        ),
        (with("depth=\"0.7\"", "depth=\"-1\""), "box.gcs:5: depth: -1.000000 must be 0 or more; the facets"),
        (with("depth=\"0.7\"", "depth=\"1e300\""), "tier 1: distance: 1"),
        (with("angle=\"135\"", "angle=\"x\""), "box.gcs:9: nx, ny, nz: a normal of length 1 is expected"),
        ("<GemCutStudio/>".to_owned(), "tier: 0 facets are cut; from 1 to 10000 are expected"),
        ("<GemCutStudio>&a;</GemCutStudio>".to_owned(), "box.gcs:1: "),
    ];
    for (text, expected) in cases {
        let message = refused(&text);
        assert!(message.contains(expected), "{message} is not {expected}");
    }
}

#[test]
fn what_is_odd_is_told_with_its_line() {
    let cases = [
        ("version=\"1000\"", "version=\"7\"", "line 1: version: only 1000 is known"),
        ("gear=\"96\"", "gear=\"1.5\"", "line 2: gear: 0 must be"),
        ("1.5\"", "x\"", "line 12: refractive_index: 'x' is not a finite number"),
        ("guide=\"false\"", "guide=\"true\"", "line 3: guide: "),
        (
            "angle=\"45\"",
            "angle=\"45.1\"",
            "line 3: tier 'C': its normals differ from its angle by up to 0.1°; the normals are used",
        ),
        (
            "index_angle=\"90\"/>",
            "><vertex x=\"1\" y=\"0\" z=\"0\"/></facet>",
            "its corners differ from its depth by up to 0.0071",
        ),
        ("<render", "<gift/><render", "line 12: <gift> is not known here"),
        (
            "nz=\"-1\"",
            "nz=\"-1\" frosting=\"matt\"",
            "line 11: frosting: 'matt' is not a number from 0 to 1; 0.5",
        ),
        ("Two\nlines", "Alternate facets unpolished\n", "line 3: instructions: 'Alternate facets unpolished"),
        ("shape=", "material=", "line 12: material: it is given twice"),
    ];
    for (from, to, expected) in cases {
        assert!(PYRAMIDS.contains(from), "{from}");
        let warnings = back(PYRAMIDS.replacen(from, to, 1).as_bytes()).warnings.join("\n");
        assert!(warnings.contains(expected), "{expected} in {warnings}");
    }
}

#[test]
fn sixteen_bits_a_character_are_read_too() {
    let wide: Vec<u8> =
        "\u{feff}".chars().chain(PYRAMIDS.chars()).flat_map(|c| (c as u16).to_le_bytes()).collect();
    assert!(looks_like(&wide));
    assert_eq!(back(&wide), back(PYRAMIDS.as_bytes()));
}

#[test]
fn a_declared_encoding_is_read_and_an_unknown_one_is_named() {
    let declared = |label: &str| format!("<?xml version=\"1.0\" encoding='{label}'?>");
    let titled = |head: &str, title: &[u8]| {
        let (before, after) = PYRAMIDS.split_once("title=\"").unwrap();
        let after = &after[after.find('"').unwrap()..];
        [head.as_bytes(), before.as_bytes(), b"title=\"", title, after.as_bytes()].concat()
    };
    for (label, title, name) in [
        ("windows-1252", b"Br\xfccke".as_slice(), "Brücke"),
        ("ISO-8859-1", b"Br\xfccke".as_slice(), "Brücke"),
        ("windows-1251", b"\xc0\xeb\xec\xe0\xe7".as_slice(), "Алмаз"),
        ("Shift_JIS", b"\x95\xf3\x90\xce".as_slice(), "宝石"),
        ("UTF-16", "Brücke".as_bytes(), "Brücke"),
    ] {
        let brought = back(&titled(&declared(label), title));
        let usual = back(PYRAMIDS.as_bytes()).warnings;
        assert_eq!((brought.design.name.as_str(), brought.warnings), (name, usual), "{label}");
    }
    let odd = |head: &str, title: &[u8]| {
        let brought = back(&titled(head, title));
        (brought.design.name, brought.warnings.join("; "))
    };
    let bare = odd("", b"Br\xfccke");
    assert_eq!(bare.0, "Brücke");
    assert!(bare.1.contains("read as Windows-1252"), "{}", bare.1);
    let torn = odd(&declared("utf-8"), b"\xc3\xbcber Br\xfccke");
    assert_eq!(torn.0, "über Br\u{fffd}cke");
    assert!(torn.1.contains("not UTF-8 are read as '\u{fffd}'"), "{}", torn.1);
    let unknown = odd(&declared("klingon"), "Brücke".as_bytes());
    assert_eq!(unknown.0, "Brücke");
    assert!(unknown.1.contains("encoding: 'klingon' is not known"), "{}", unknown.1);
}

#[test]
fn decimal_commas_are_read_with_one_warning_for_all_of_them() {
    let commas = PYRAMIDS.replace("depth=\"0.7\"", "depth=\"0,7\"").replace("1.5\"", "1,5\"");
    let (read, plain) = (back(commas.as_bytes()), back(PYRAMIDS.as_bytes()));
    assert_eq!(read.design, plain.design);
    let [warnings @ .., last] = &read.warnings[..] else { panic!("a warning is expected") };
    assert_eq!(warnings, plain.warnings);
    assert!(last.contains("has a decimal comma and is read as 1.5, and so are "), "{last}");
    // A comma that may part two numbers is no number.
    let two = back(PYRAMIDS.replace("1.5\"", "1,5,2\"").as_bytes()).warnings.join("; ");
    assert!(two.contains("refractive_index: '1,5,2' is not a finite number"), "{two}");
}

#[test]
fn no_build_of_xml_takes_long() {
    let begin = std::time::Instant::now();
    let deep = "<a>".repeat(2_000_000);
    let wide = format!("<GemCutStudio>{}", "<a b=''/>".repeat(1_500_000));
    let spaces: String = (0..15).map(|k| format!(" xmlns:a{k}='{k}'")).collect();
    let spaced = format!("<GemCutStudio{spaces}>{}", "<a x='' y=''>".repeat(200_000));
    let attributes: String = (0..250).map(|k| format!(" a{k}=''")).collect();
    let many = format!("<GemCutStudio>{}", format!("<a{attributes}/>").repeat(6000));
    for text in [deep, wide, spaced, many] {
        assert!(read(text.as_bytes(), "x").is_err());
    }
    assert!(begin.elapsed().as_secs() < 120, "{:?}", begin.elapsed());
    assert!(refused(&" ".repeat(MAX_BYTES + 1)).contains("larger than 16 MiB"));
    let facets = "<facet nx='0' ny='0' nz='1'/>".repeat(brillianteer_cut::MAX_PLANES + 1);
    let many = format!("<GemCutStudio><tier angle='0' depth='1'>{facets}</tier></GemCutStudio>");
    assert!(refused(&many).contains("more than 10000 facets"));
}

proptest! {
    #[test]
    fn no_bytes_make_it_panic(bytes in prop::collection::vec(any::<u8>(), 0..600)) {
        let _ = read(&bytes, "x");
        let _ = looks_like(&bytes);
    }

    #[test]
    fn no_spoilt_design_makes_it_panic(
        cut in 0.0..1.0f64,
        spoilt in prop::collection::vec((0.0..1.0f64, prop::sample::select(&b"0159-.e\"'<>&; \n=/\xc3n"[..])), 0..8),
    ) {
        let mut bytes = PYRAMIDS.as_bytes().to_vec();
        let length = bytes.len() as f64;
        for (at, byte) in spoilt {
            bytes[(at * length) as usize] = byte;
        }
        for bytes in [&bytes[..], &bytes[..(cut * length) as usize]] {
            if let Ok(ImportedDesign { design, .. }) = read(bytes, "x") && let Ok(specimen) = brillianteer_scene::Specimen::new(design) {
                let _ = write(&specimen);
            }
        }
    }
}

#[test]
fn frosting_is_read_from_facets_tiers_and_instructions_and_written_back() {
    let frostings = |text: &str| {
        let brought = back(text.as_bytes());
        let Cut::Tiers(tiers) = brought.design.cut else { panic!() };
        tiers.tiers.iter().map(|tier| (tier.facets.len(), tier.frosting)).collect::<Vec<_>>()
    };
    let with = |from: &str, to: &str| {
        assert!(PYRAMIDS.contains(from), "{from}");
        PYRAMIDS.replacen(from, to, 1)
    };
    assert_eq!(frostings(PYRAMIDS), [(4, 0.0), (4, 0.0), (1, 0.0)]);
    // A facet that is frosted by itself becomes a tier by itself.
    let facet = with("index_angle=\"90\"/>", "index_angle=\"90\" frosting=\"0.25\"/>");
    assert_eq!(frostings(&facet), [(1, 0.25), (3, 0.0), (4, 0.0), (1, 0.0)]);
    assert_eq!(
        frostings(&with("name=\"P\"", "name=\"P\" frosting=\"true\"")),
        [(4, 0.0), (4, 0.5), (1, 0.0)]
    );
    let said = with("Two\nlines", "Leave frosted.");
    assert_eq!(frostings(&said)[0], (4, 0.5));
    // The attribute of a facet takes precedence over the words of its tier.
    let polished = said.replacen("index_angle=\"90\"/>", "index_angle=\"90\" frosting=\"0\"/>", 1);
    assert_eq!(frostings(&polished)[..2], [(1, 0.0), (3, 0.5)]);
    for text in [&facet, &said, &polished] {
        let first = specimen(back(text.as_bytes()).design);
        let again = specimen(back(&write(&first).bytes).design);
        let of = |specimen: &brillianteer_scene::Specimen| {
            let facets = specimen.stone().unwrap().polytope.facets().iter();
            facets.map(|facet| facet.frosting).collect::<Vec<_>>()
        };
        assert_eq!(of(&first), of(&again));
        assert!(of(&first).iter().any(|&frosting| frosting > 0.0));
    }
    assert!(!String::from_utf8(write(&specimen(design())).bytes).unwrap().contains("frosting"));
}

#[test]
fn what_is_no_xml_is_told_in_plain_words() {
    for (text, words) in [
        (
            "<GemCutStudio>\n<tier>\n</teir>",
            "box.gcs:3: this XML cannot be read: `</tier>` is expected, and `</teir>`",
        ),
        ("<GemCutStudio>\n<tier>", "it has been cut off"),
        (
            "<GemCutStudio>\n<info title=\"A & B\"/></GemCutStudio>",
            "box.gcs:2: this XML cannot be read: a character `&`",
        ),
        ("<GemCutStudio a=\"1\" a=\"2\"/>", "the attribute `a` is there twice"),
        ("<!DOCTYPE x><GemCutStudio/>", "it has a DOCTYPE"),
        ("<GemCutStudio a=1/>", "is expected, and `1` is there"),
    ] {
        let told = refused(text);
        assert!(
            told.contains(words) && told.ends_with("save the design again from Gem Cut Studio"),
            "{told}"
        );
    }
}
