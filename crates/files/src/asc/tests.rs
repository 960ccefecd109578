use super::*;
use crate::cut_file;
use crate::design_file::EncodedDesign;
use brillianteer_cut::{Cut, MaterialRef};
use brillianteer_scene::Specimen;
use proptest::prelude::*;

#[test]
fn a_file_that_ends_within_a_tier_says_so() {
    let says = |text: &str| tiers(text).1.iter().any(|warning| warning.contains("it may be cut off"));
    let place = STONE.find("24 48 72\r\n    ").or(STONE.find("C1 96 24")).unwrap();
    assert!(says(&STONE[..place + 5]) && says(&STONE[..STONE.find("to a point").unwrap() + 4]));
    assert!(!says(STONE) && !says(STONE.trim_end()), "a footer may end a file");
    assert!(!says(&STONE[..STONE.find("F the end").unwrap()]), "so may a whole tier");
}

/// A file with all that the format has: a gear, an outline, names before and after, a wrapped line, instructions, a culet.
const STONE: &str = "GemCad 5.0\r\ng 96 0.0\r\ny 4 y\r\nI 1.76\r\nH A square\r\nH\r\nH  by nobody \r\n\
    a -90.000000 1.00000000 96 n G1 24 48 72 G set the size\r\n\
    a -45.0 0.9 96 24\r\n 48 72 n P1\r\n G to a point\r\n\
    a 35.5 0.8 n C1 96 24 48 72\r\n\
    a 0.0 0.45 0 n T\r\n\
    F the end\r\n";

fn tiers(text: &str) -> (Tiers, Vec<String>) {
    let brought = read(text.as_bytes(), "x.asc").unwrap();
    match brought.design.cut {
        Cut::Tiers(tiers) => (tiers, brought.warnings),
        _ => panic!("tiers are expected"),
    }
}

fn again(specimen: &Specimen) -> (Specimen, Vec<String>) {
    let EncodedDesign { bytes, lost } = write(specimen);
    (Specimen::new(read(&bytes, "x.asc").unwrap().design).unwrap(), lost)
}

#[test]
fn a_file_is_read_as_it_is_meant() {
    assert!(
        looks_like(STONE.as_bytes())
            && !looks_like(b"format = 1\nname = \"a\"\n")
            && !looks_like(&[0xff; 64])
    );
    let brought = read(STONE.as_bytes(), "x.asc").unwrap();
    assert_eq!(brought.warnings, Vec::<String>::new());
    assert_eq!(
        (brought.design.name.as_str(), &brought.design.material),
        ("A square", &MaterialRef::Index(1.76))
    );
    let (tiers, _) = tiers(STONE);
    assert_eq!((tiers.gear, tiers.offset, tiers.symmetry, tiers.mirror), (96, 0.0, 4, true));
    assert_eq!(
        (tiers.headers, tiers.footers),
        (vec!["A square".into(), String::new(), " by nobody ".into()], vec!["the end".to_owned()])
    );
    let found: Vec<_> =
        tiers.tiers.iter().map(|t| (t.angle, t.facets.len(), t.name(), t.instructions.as_str())).collect();
    assert_eq!(
        found,
        [
            (-90.0, 4, "G1", "set the size"),
            (-45.0, 4, "P1", "to a point"),
            (35.5, 4, "C1", ""),
            (0.0, 1, "T", "")
        ]
    );
    assert_eq!(tiers.tiers[1].facets[3].name, "P1");
    assert_eq!(tiers.tiers[2].facets[0].name, "C1");
}

#[test]
fn a_stone_is_scaled_to_its_girdle_whatever_its_unit() {
    let double = STONE
        .replace("1.00000000", "2")
        .replace(" 0.9 ", " 1.8 ")
        .replace(" 0.8 ", " 1.6 ")
        .replace(" 0.45 ", " 0.9 ");
    let [a, b] =
        [STONE, &double].map(|text| Specimen::new(read(text.as_bytes(), "x").unwrap().design).unwrap());
    let outline = brillianteer_cut::Outline::of(&a.stone().unwrap().polytope);
    assert!((outline.width - 2.0).abs() < 1e-12 && outline.girdle_top.abs() < 1e-12, "{outline:?}");
    for (x, y) in a.stone().unwrap().polytope.vertices().iter().zip(b.stone().unwrap().polytope.vertices()) {
        assert!(x.distance(*y) < 1e-12);
    }
}

#[test]
fn what_is_written_reads_back_the_same_but_for_the_layout() {
    let specimen = Specimen::new(read(STONE.as_bytes(), "x.asc").unwrap().design).unwrap();
    let (back, lost) = again(&specimen);
    assert_eq!((back.design, lost), (specimen.design.clone(), vec![]));
    // The design survives this program's own format as well.
    let toml = cut_file::write(&specimen.design);
    assert_eq!(cut_file::parse(&toml, "x.toml").unwrap(), specimen.design);
}

#[test]
fn a_brilliant_goes_out_with_its_facets_and_says_what_stays_behind() {
    let design = cut_file::parse(crate::library::cut("tolkowsky").unwrap(), "t").unwrap();
    let specimen = Specimen::new(design).unwrap();
    let (back, lost) = again(&specimen);
    assert!(
        lost.iter().any(|what| what.contains("proportions"))
            && lost.iter().any(|what| what.contains("material")),
        "{lost:?}"
    );
    let Cut::Tiers(tiers) = &back.design.cut else { panic!() };
    assert_eq!((tiers.symmetry, tiers.mirror, tiers.tiers.len()), (8, true, 7));
    assert_eq!(back.stone().unwrap().names(), specimen.stone().unwrap().names());
    // A stone read from tiers is scaled by the width between the girdle's corners, a brilliant by a circle around them.
    let scale = specimen.stone().unwrap().polytope.volume() / back.stone().unwrap().polytope.volume();
    assert!((1.0 - scale).abs() < 2e-3, "{scale}");
}

#[test]
fn what_other_programs_write_is_understood() {
    for (from, to) in [
        ("g 96 0.0", "g96 0.0"),
        ("g 96 0.0", "96 0.0"),
        ("\r\n", "\n"),
        ("\r\n", "\r"),
        ("F the end", "F the end\0\0\u{1a}"),
        ("GemCad 5.0", "GemCad 4.41_MacGem"),
    ] {
        assert_eq!(tiers(&STONE.replace(from, to)), tiers(STONE), "{to:?}");
    }
    let latin = [STONE.as_bytes(), b"F 33.22\xba\r\n"].concat();
    let brought = read(&latin, "x").unwrap();
    let Cut::Tiers(tiers) = &brought.design.cut else { panic!() };
    assert_eq!(tiers.footers[1], "33.22º");
    let bytes = write(&Specimen::new(brought.design).unwrap()).bytes;
    assert!(bytes.windows(2).any(|pair| pair == b"2\xba"));
}

#[test]
fn letters_in_either_case_and_tokens_without_blanks_are_understood() {
    for (from, to) in [
        ("y 4 y", "y4y"),
        ("y 4 y", "Y 4Y"),
        ("y 4 y", "y 4, y"),
        ("g 96 0.0", "G96 0.0"),
        ("I 1.76", "i1.76"),
        ("a -45.0 0.9", "A-45.0 0.9"),
        ("a 35.5", "a35.5°"),
        ("n C1 96 24", "N C1 96 24"),
        ("n C1 96 24", "nC1 96 24"),
        ("0 n T", "0nT"),
        ("C1 96 24 48 72", "C1 96, 24, 48, 72,"),
        ("\r\n 48 72 n P1\r\n G to", "\r\n48 72\r\nn P1\r\nG to"),
        ("G set the", "g set the"),
    ] {
        assert!(STONE.contains(from), "{from}");
        assert_eq!(tiers(&STONE.replace(from, to)), tiers(STONE), "{to:?}");
    }
    assert!(!tiers(&STONE.replace("y 4 y", "y4n")).0.mirror);
    assert!(looks_like(b"A\xa0-45.0 0.9 96 24\r\n"));
}

#[test]
fn signs_of_printed_text_and_wide_digits_are_numbers() {
    for (from, to) in [
        ("a -45.0", "a −45.0"),
        ("a -90", "a –90"),
        ("a -45.0 0.9", "a\u{a0}-45.0\u{202f}0.9"),
        (" 48 72 n P1", "\u{3000}４８\u{2003}７２ n P1"),
        ("I 1.76", "I １．７６"),
    ] {
        assert!(STONE.contains(from), "{from}");
        assert_eq!(tiers(&STONE.replace(from, to)), tiers(STONE), "{to:?}");
    }
    // The dash of Windows-1252.
    let dashed: Vec<u8> =
        STONE.replace("a -45", "a #45").bytes().map(|b| if b == b'#' { 0x96 } else { b }).collect();
    assert_eq!(read(&dashed, "x.asc").unwrap(), read(STONE.as_bytes(), "x.asc").unwrap());
}

#[test]
fn marks_and_sixteen_bits_a_character_are_read_with_their_title() {
    let text = STONE.replace("A square", "Алмаз");
    let wide = |order: fn(u16) -> [u8; 2], mark: &str| -> Vec<u8> {
        mark.chars().chain(text.chars()).flat_map(|c| order(c as u16)).collect()
    };
    let mut files = vec![format!("\u{feff}{text}").into_bytes()];
    for mark in ["\u{feff}", ""] {
        files.extend([u16::to_le_bytes, u16::to_be_bytes].map(|order| wide(order, mark)));
    }
    let plain = read(text.as_bytes(), "x.asc").unwrap();
    assert_eq!(plain.design.name, "Алмаз");
    for bytes in files {
        assert!(looks_like(&bytes));
        assert_eq!(read(&bytes, "x.asc").unwrap(), plain, "{:?}", &bytes[..4]);
    }
}

#[test]
fn lines_are_written_as_gemcad_ends_them() {
    let bytes = write(&Specimen::new(read(STONE.as_bytes(), "x.asc").unwrap().design).unwrap()).bytes;
    let lone = |byte, before: u8| {
        let pairs = bytes.windows(2).filter(move |pair| pair[1] == byte && pair[0] != before);
        pairs.count()
    };
    assert_eq!(lone(b'\n', b'\r'), 0);
    assert!(bytes.ends_with(b"\r\n") && bytes.iter().filter(|b| **b == b'\r').count() > 8);
}

#[test]
fn what_is_odd_is_told_with_its_line_and_the_stone_opens() {
    let odd = |from: &str, to: &str| tiers(&STONE.replace(from, to)).1.join("; ");
    assert_eq!(odd("H A square", "Z A square"), "line 5: 'Z A square' is not a known record and is left out");
    assert_eq!(
        odd("96 24 48 72\r\na 0.0", "96 x4 48 72\r\na 0.0"),
        "line 12: 'x4' is not an index of a facet, and is left out"
    );
    assert_eq!(odd("a 35.5", "a 3 1\r\na 35.5"), "line 13: the tier before has no indices, and is left out");
    assert_eq!(tiers(&STONE.replace("0.45 0 n T", "0.45")).0.tiers[3].facets.len(), 1);
    assert_eq!(odd("n T", "n T n U"), "line 13: a facet has two names, 'T' and 'U'; the second is used");
    assert_eq!(odd("g 96 0.0\r\n", ""), "the file names no index gear; one of 96 teeth is assumed");
    assert_eq!(odd("I 1.76\r\n", ""), "the file names no index of refraction; 1.54 is assumed");
    assert!(odd("I 1.76", "I 0.5").ends_with("the index 0.5 must be from 1 (air) to 6; 1.54 is assumed"));
    assert_eq!(
        odd("a 35.5 0.8", "a 35.5\r\na 35.5 0.8"),
        "line 12: 'a 35.5' has no angle and distance, and is left out"
    );
}

#[test]
fn an_index_beyond_the_gear_is_told_with_line_and_tier_and_the_number_of_teeth_is_none() {
    let beyond = STONE.replace("0.8 n C1 96 24 48 72", "0.8 n C1 100 24 48 72");
    assert_eq!(
        tiers(&beyond).1,
        [
            "line 12: tier 3 'C1': index 100 is beyond the gear of 96 teeth and is taken as 4; check the gear and the tier"
        ]
    );
    // The gear may follow its tiers, and a tier that is left out does not count.
    let late = STONE.replace("g 96 0.0\r\n", "").replace("a 35.5", "a 12 1\r\na 35.5") + "g 64 0\r\n";
    assert_eq!(
        tiers(&late).1,
        [
            "line 12: the tier before has no indices, and is left out",
            "line 7: tier 1 'G1': indices 96, 72 are beyond the gear of 64 teeth and are taken as 32, 8; check the \
             gear and the tier",
            "line 8: tier 2 'P1': indices 96, 72 are beyond the gear of 64 teeth and are taken as 32, 8; check the \
             gear and the tier",
            "line 12: tier 3 'C1': indices 96, 72 are beyond the gear of 64 teeth and are taken as 32, 8; check the \
             gear and the tier",
        ]
    );
}

#[test]
fn decimal_commas_make_the_same_stone_with_one_warning_for_all_of_them() {
    let commas = STONE
        .replace("g 96 0.0", "g 96 0,0")
        .replace("I 1.76", "I 1,76")
        .replace("a -45.0 0.9", "a -45,0 0,9")
        .replace("a 35.5 0.8", "a 35,5 0.8");
    assert!(looks_like(commas.replace("GemCad 5.0\r\n", "").as_bytes()));
    let (read, warnings) = tiers(&commas);
    assert_eq!(read, tiers(STONE).0);
    assert_eq!(
        warnings,
        [
            "line 2: '0,0' has a decimal comma and is read as 0.0, and so are 4 more numbers; write decimal points"
        ]
    );
    let one = tiers(&STONE.replace("a 35.5", "a 35,5")).1;
    assert_eq!(one, ["line 12: '35,5' has a decimal comma and is read as 35.5; write decimal points"]);
}

#[test]
fn a_comma_that_can_be_read_in_two_ways_is_an_error_with_its_line() {
    let message = |from: &str, to: &str| {
        assert!(STONE.contains(from), "{from}");
        let bytes = STONE.replace(from, to).into_bytes();
        read(&bytes, "x.asc").unwrap_err().in_file("x.asc").to_string()
    };
    let index = "may be one index or several; write a decimal point, and blanks between indices";
    assert_eq!(message("n C1 96 24 48", "n C1 96 24,48"), format!("x.asc:12: '24,48' {index}"));
    assert_eq!(message(" 48 72 n P1", " 48,72 n P1"), format!("x.asc:10: '48,72' {index}"));
    assert_eq!(message("96 24\r\n 48 72", "96,24,48,72"), format!("x.asc:9: '96,24,48,72' {index}"));
    let number = "is not a number; write a decimal point, and blanks between numbers";
    assert_eq!(message("a 35.5 0.8", "a 35.5,0.8"), format!("x.asc:12: '35.5,0.8' {number}"));
    assert_eq!(message("I 1.76", "I 1,7,6"), format!("x.asc:4: '1,7,6' {number}"));
    // Names and texts may hold commas.
    assert_eq!(tiers(&STONE.replace("n P1", "n 3,5").replace("A square", "1,5 A")).1, Vec::<String>::new());
}

#[test]
fn a_gear_and_a_symmetry_that_make_no_sense_are_mended_with_a_warning_as_in_gem_files() {
    let gear = "must be from 1 to 100000 teeth, or below 0 where they are counted clockwise";
    let mended = "the facets are given by a gear of 96 teeth";
    for (from, to, warning) in [
        ("y 4 y", "y 0 y", "line 3: symmetry: 0 must be 1 or more; 1 is assumed".to_owned()),
        ("y 4 y", "y -2 y", "line 3: symmetry: -2 must be 1 or more; 1 is assumed".to_owned()),
        ("g 96 0.0", "g 0 12", format!("line 2: gear: 0 {gear}; {mended}")),
        ("g 96 0.0", "g 200000 12", format!("line 2: gear: 200000 {gear}; {mended}")),
        ("g 96 0.0", "g 96 nan", format!("line 2: offset: NaN must be a number of teeth; {mended}")),
    ] {
        let (tiers, warnings) = tiers(&STONE.replace(from, to));
        assert_eq!(warnings, [warning]);
        assert_eq!((tiers.gear, tiers.offset, tiers.mirror), (96, 0.0, true), "{to}");
        assert_eq!(tiers.symmetry, if from == "y 4 y" { 1 } else { 4 }, "{to}");
    }
}

#[test]
fn what_is_no_stone_is_refused_with_its_place() {
    let message = |bytes: &[u8]| read(bytes, "x.asc").unwrap_err().in_file("x.asc").to_string();
    assert!(message(b"GemCad 5.0\ng 96 0.0\n").starts_with("x.asc: no facet is listed; a line such as"));
    assert!(message(b"").starts_with("x.asc: no facet"));
    assert!(
        message(b"g 0 0\na 1 1e300 5\n").contains("tier 1: distance: "),
        "{}",
        message(b"g 0 0\na 1 1e300 5\n")
    );
    let many = format!("a 41 0.5{}", " 1".repeat(MAX_PLANES + 1));
    assert_eq!(message(many.as_bytes()), "x.asc:1: more than 10000 facets are listed; no stone has so many");
}

proptest! {
    #[test]
    fn no_bytes_are_too_much(bytes in prop::collection::vec(any::<u8>(), 0..400), cut in 0..STONE.len(), at in 0..STONE.len()) {
        let _ = (looks_like(&bytes), read(&bytes, "x"));
        let mut torn = STONE.as_bytes()[cut..].to_vec();
        torn.splice(at.min(torn.len())..at.min(torn.len()), bytes);
        if let Ok(brought) = read(&torn, "x") && let Ok(specimen) = Specimen::new(brought.design) {
            let EncodedDesign { bytes, lost } = write(&specimen);
            let design = read(&bytes, "x").unwrap().design;
            if lost.is_empty() {
                prop_assert_eq!(design.cut, specimen.design.cut);
            }
        }
    }

    #[test]
    fn lines_of_records_are_never_too_much(lines in prop::collection::vec("[agyIHFnG ][-0-9.eE nGa]{0,30}", 0..30)) {
        let _ = read(lines.join("\n").as_bytes(), "x");
    }
}

#[test]
fn a_stone_is_frosted_alike_in_every_format() {
    let said = STONE.replace("to a point", "to a point. Leave frosted").replace(
        "24 48 72\r\n\
    a 0.0",
        "24 48 72 G Frosted 0.2\r\n\
    a 0.0",
    );
    let brought = read(said.as_bytes(), "x.asc").unwrap();
    assert_eq!(brought.warnings, Vec::<String>::new());
    let frosting = |design: &brillianteer_cut::Design| match &design.cut {
        Cut::Tiers(tiers) => tiers.tiers.iter().map(|tier| tier.frosting).collect::<Vec<_>>(),
        _ => panic!("tiers are expected"),
    };
    assert_eq!(frosting(&brought.design), [0.0, 0.5, 0.2, 0.0]);
    // Frosted otherwise than the instructions say, as in an editor.
    let mut design = brought.design;
    let Cut::Tiers(tiers) = &mut design.cut else { panic!() };
    for (tier, frosting) in tiers.tiers.iter_mut().zip([0.5, 0.0, 0.75, 1.0]) {
        tier.frosting = frosting;
    }
    let specimen = Specimen::new(design.clone()).unwrap();
    assert!(specimen.warnings.iter().any(|text| text.contains("frosted facets scatter light")));
    let written = [
        read(&write(&specimen).bytes, "x.asc").unwrap(),
        crate::gem::read(&crate::gem::write(&specimen).bytes, "x.gem").unwrap(),
        crate::gcs::read(&crate::gcs::write(&specimen).bytes, "x.gcs").unwrap(),
        ImportedDesign::of(cut_file::parse(&cut_file::write(&design), "x.toml").unwrap()),
    ];
    for (number, brought) in written.iter().enumerate() {
        assert_eq!(frosting(&brought.design), [0.5, 0.0, 0.75, 1.0], "format {number}");
        assert_eq!(brought.warnings, Vec::<String>::new(), "format {number}");
    }
}

#[test]
fn frosting_that_is_not_plainly_a_tiers_own_gives_a_warning() {
    let warned = |from: &str, to: &str| tiers(&STONE.replace(from, to)).1.join("\n");
    let unclear = warned("to a point", "Leave remaining facets frosted");
    assert!(
        unclear.starts_with("tier 2: 'Leave remaining facets frosted' frosts facets, but not plainly"),
        "{unclear}"
    );
    let header = warned("by nobody", "P1 unpolished.");
    assert!(header.starts_with("'P1 unpolished.' names frosted facets"), "{header}");
}

#[test]
fn concave_facets_that_a_file_names_are_read_flat_with_a_warning_in_every_format() {
    let said = STONE.replace("to a point", "concave, 17mm mandrel");
    let brought = read(said.as_bytes(), "x.asc").unwrap();
    let specimen = Specimen::new(brought.design).unwrap();
    let written = [
        read(&write(&specimen).bytes, "x.asc").unwrap(),
        crate::gem::read(&crate::gem::write(&specimen).bytes, "x.gem").unwrap(),
        crate::gcs::read(&crate::gcs::write(&specimen).bytes, "x.gcs").unwrap(),
        ImportedDesign::of(cut_file::parse(&cut_file::write(&specimen.design), "x.toml").unwrap()),
    ];
    for (number, brought) in written.into_iter().enumerate() {
        let warnings = Specimen::new(brought.design).unwrap().warnings.join("; ");
        assert!(warnings.contains("'concave, 17mm mandrel'"), "format {number}: {warnings}");
    }
    let plain = Specimen::new(read(STONE.as_bytes(), "x.asc").unwrap().design).unwrap();
    assert!(!plain.warnings.join("; ").contains("concave"));
}
