use super::*;
use crate::cutters::sample::{design, others, specimen, tiers};
use crate::design_file::EncodedDesign;
use brillianteer_cut::{Design, MaterialRef};
use proptest::prelude::*;

fn back(bytes: &[u8]) -> ImportedDesign {
    read(bytes, "box.gem").unwrap()
}

fn refused(bytes: &[u8]) -> String {
    read(bytes, "box.gem").unwrap_err().in_file("box.gem").to_string()
}

#[test]
fn a_design_reads_as_it_is_written() {
    let design = design();
    let EncodedDesign { bytes, lost } = write(&specimen(design.clone()));
    assert_eq!(lost, Vec::<String>::new());
    assert!(looks_like(&bytes));
    assert_eq!(back(&bytes), ImportedDesign::of(design));
}

#[test]
fn the_frame_is_left_handed_and_a_girdle_is_told_by_a_trace_of_z() {
    let mut design = design();
    tiers(&mut design).gear = 96;
    tiers(&mut design).offset = 0.0;
    tiers(&mut design).tiers[0].facets[0].index = 93.0;
    let bytes = write(&specimen(design)).bytes;
    let p = [0, 8, 16].map(|at| f64::from_le_bytes(bytes[at..at + 8].try_into().unwrap()));
    assert!((p[0] + 0.195).abs() < 1e-3 && (p[1] - 0.981).abs() < 1e-3, "{p:?}");
    assert!(p[2] < 0.0 && p[2] > -1e-15);
}

#[test]
fn corners_lie_on_their_facets_and_turn_about_them() {
    let bytes = write(&specimen(design())).bytes;
    let number = |at: usize| f64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
    let point = |at: usize| DVec3::new(number(at), number(at + 8), number(at + 16));
    let (p, mut at, mut corners) = (point(0), 29 + usize::from(bytes[28]), Vec::new());
    while bytes[at] == 1 {
        corners.push(point(at + 4));
        at += 28;
    }
    assert!(corners.len() >= 3);
    assert!(corners.iter().all(|corner| (corner.dot(p) - 1.0).abs() < 1e-12));
    assert!((corners[1] - corners[0]).cross(corners[2] - corners[1]).dot(p) > 0.0);
}

#[test]
fn what_the_format_cannot_hold_is_told() {
    let mut full = Design {
        name: "other".to_owned(),
        source: Some("a book".to_owned()),
        notes: Some("a note".to_owned()),
        material: MaterialRef::Name("diamond".to_owned()),
        diameter_mm: 9.0,
        ..design()
    };
    let cut = tiers(&mut full);
    cut.headers.push("fifth".to_owned());
    cut.footers = vec!["x".repeat(300), "Ω\t".to_owned(), String::new(), String::new(), "fifth".to_owned()];
    cut.remarks = [("date".to_owned(), "today".to_owned())].into();
    cut.tiers[3].is_cut = false;
    let EncodedDesign { bytes, lost } = write(&specimen(full.clone()));
    let expected = [
        "the name 'other' is not among the lines at the top",
        "the format cannot hold where the design is published",
        "the format cannot hold the design's notes",
        "the format cannot hold the diameter, 9 mm",
        "1 tiers that are not cut are left out",
        "1 lines at the top are left out; there is room for 4",
        "1 lines at the end are left out; there is room for 4",
        "1 remarks are left out",
        "of the material 'diamond' only its index in sodium light is kept, 2.4173",
        "1 texts are cut off at 255 characters",
        "1 characters are written as '?': the format lacks them",
    ];
    assert_eq!(lost, expected);
    let mut design = back(&bytes).design;
    assert_eq!(tiers(&mut design).footers, ["x".repeat(255), "?\t".to_owned()]);
    assert_eq!(tiers(&mut design).tiers.len(), 5);
}

#[test]
fn stones_that_are_not_cut_by_tiers_are_written_by_a_gear_that_fits() {
    for stone in others() {
        let EncodedDesign { bytes, lost } = write(&stone);
        let ImportedDesign { mut design, warnings, .. } = back(&bytes);
        assert_eq!(warnings, Vec::<String>::new());
        let volumes = [&stone, &specimen(design.clone())].map(|s| s.stone().unwrap().polytope.volume());
        assert!((volumes[0] - volumes[1]).abs() < 1e-10, "{volumes:?}");
        let moved = matches!(stone.design.cut, brillianteer_cut::Cut::Planes(_));
        assert_eq!(lost.iter().any(|text| text.contains("is moved by (-5.0")), moved, "{lost:?}");
        let tiers = tiers(&mut design);
        assert_eq!(tiers.gear, 96);
        assert_eq!(tiers.headers[0], stone.design.name);
        assert!(
            tiers.tiers.iter().flat_map(|tier| &tier.facets).all(|facet| (facet.index * 4.0).fract() == 0.0)
        );
    }
}

#[test]
fn a_facet_through_the_origin_stays_there() {
    let mut through = design();
    tiers(&mut through).tiers[4].distance = 0.0;
    let ImportedDesign { design, warnings, .. } = back(&write(&specimen(through.clone())).bytes);
    assert_eq!(design, through);
    assert_eq!(warnings.len(), 1);
    assert!(
        warnings[0].starts_with("offset 0x") && warnings[0].contains("facet 'T' runs through the origin")
    );
}

#[test]
fn a_stone_that_ends_at_the_block_it_is_cut_from_is_told() {
    let mut wide = design();
    tiers(&mut wide).tiers.iter_mut().for_each(|tier| tier.distance *= BLANK);
    tiers(&mut wide).tiers[5].distance = BLANK;
    let warnings = back(&write(&specimen(wide)).bytes).warnings;
    assert_eq!(warnings.len(), 1);
    assert!(
        warnings[0].starts_with("offset 0x") && warnings[0].contains("block that GemCad cuts from, 1.1333 "),
        "{warnings:?}"
    );
}

#[test]
fn faults_are_told_with_their_offset() {
    let good = write(&specimen(design())).bytes;
    let spoilt = |at: usize, with: &[u8]| {
        let mut bytes = good.clone();
        bytes[at..at + with.len()].copy_from_slice(with);
        bytes
    };
    let flag = 29 + usize::from(good[28]);
    let cases = [
        (
            vec![],
            "box.gem: offset 0x0: the file ends in the middle of a facet; it is truncated or not a .gem file",
        ),
        (good[..100].to_vec(), "box.gem: offset 0x64: the file ends in the middle of a facet's outline"),
        (spoilt(0, &f64::NAN.to_le_bytes()), "box.gem: offset 0x0: [NaN, "),
        (spoilt(flag, &[7]), "7 stands where 1 (a corner follows) or 0 (the facet ends) is expected"),
        (END.to_le_bytes().to_vec(), "the file ends in the middle of the symmetry, gear and index"),
        (spoilt(0, &[0; 24]), "three finite numbers that are not all 0 are expected"),
    ];
    for (bytes, expected) in cases {
        assert!(refused(&bytes).contains(expected), "{}", refused(&bytes));
        assert!(!looks_like(&bytes) || bytes.len() == 8);
    }
    assert!(refused(&vec![0; MAX_BYTES + 1]).contains("larger than 64 MiB"));
    let facet = &good[..28];
    let many: Vec<u8> = [facet, &[0; 5]].concat().repeat(MAX_PLANES + 1);
    assert!(refused(&many).contains("more than 10000 facets"));
}

#[test]
fn odd_numbers_behind_the_facets_are_told_and_the_stone_is_read() {
    let mut bytes = write(&specimen(design())).bytes;
    let end = bytes.windows(8).position(|window| window == END.to_le_bytes()).unwrap() + 8;
    bytes[end..end + 12].fill(0);
    bytes[end + 12..end + 20].copy_from_slice(&9f64.to_le_bytes());
    bytes[end + 20] = 1;
    bytes.extend(b"\x07preform and more");
    let ImportedDesign { mut design, warnings, .. } = back(&bytes);
    let text = warnings.join("\n");
    for part in
        ["0x7f01 stands where", "gear: 0 must be", "symmetry: 0 must be", "index 9 must be", "the preform"]
    {
        assert!(text.contains(part), "{part} in {text}");
    }
    assert!(warnings.iter().all(|warning| warning.starts_with("offset 0x")));
    assert_eq!(design.material, MaterialRef::Index(1.54));
    assert_eq!(tiers(&mut design).gear, 96);
    let cut_off = back(&bytes[..end + 36]);
    assert_eq!(cut_off.design.name, "box");
    assert!(cut_off.warnings.iter().any(|warning| warning.contains("in the middle of the headers")));
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
        spoilt in prop::collection::vec((0.0..1.0f64, any::<u8>()), 0..12),
    ) {
        let mut bytes = write(&specimen(design())).bytes;
        let length = bytes.len() as f64;
        for (at, byte) in spoilt {
            bytes[(at * length) as usize] = byte;
        }
        let _ = looks_like(&bytes);
        for bytes in [&bytes[..], &bytes[..(cut * length) as usize]] {
            if let Ok(ImportedDesign { design, .. }) = read(bytes, "x") && let Ok(specimen) = brillianteer_scene::Specimen::new(design) {
                prop_assert!(read(&write(&specimen).bytes, "x").is_ok());
            }
        }
    }
}
