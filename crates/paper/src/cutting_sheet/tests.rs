use super::super::drawing_png::legible::{overlapping, texts};
use super::super::drawing_png::parse;
use super::*;
use brillianteer_cut::{Cut, Design, Indexed, MaterialRef, SheetFigures, TOLKOWSKY, Tier, Tiers};
use proptest::prelude::*;
use resvg::usvg::{Group, Node, Rect};

/// The least white space on all sides, pixels: 8 mm.
const WHITE: f32 = 30.0;

fn tier(angle: f64, distance: f64, indices: &[f64], (name, instructions): (&str, &str)) -> Tier {
    let facet =
        |(k, &index): (usize, &f64)| Indexed { index, name: if k == 0 { name } else { "" }.to_owned() };
    let facets = indices.iter().enumerate().map(facet).collect();
    Tier {
        angle,
        distance,
        instructions: instructions.to_owned(),
        meet: None,
        is_cut: true,
        frosting: 0.0,
        facets,
    }
}

fn every(step: usize) -> Vec<f64> {
    (0..96).step_by(step).map(|index| index as f64).collect()
}

/// A square step cut with a preform, a tier below the critical angle, one without a name and one that is not cut.
fn step_cut() -> Tiers {
    let mut uncut = tier(30.0, 0.2, &every(24), ("X", "never"));
    uncut.is_cut = false;
    let tiers = vec![
        tier(-45.0, 0.95, &every(24), ("PF1", "Cut to TCP")),
        tier(-90.0, 1.0, &every(24), ("G1", "Set size")),
        tier(-90.0, 1.3, &[12.0, 36.0, 60.0, 84.0], ("", "Level girdle")),
        tier(-55.0, 0.85, &every(24), ("1", "Meet G1 at the girdle,\nthen stop")),
        tier(-38.0, 0.7, &every(24), ("2", "")),
        tier(40.0, 0.75, &[24.0, 0.0, 48.0, 72.0], ("A", "Größe")),
        tier(0.0, 0.3, &[0.0], ("T", "")),
        uncut,
    ];
    Tiers {
        gear: 96,
        symmetry: 4,
        mirror: true,
        headers: vec!["Step".to_owned(), "by M. Müller\u{7}".to_owned()],
        tiers,
        ..Tiers::default()
    }
}

fn specimen(cut: Cut, index: f64) -> Specimen {
    let material = MaterialRef::Index(index);
    let design =
        Design { name: "Step".to_owned(), source: None, notes: None, material, diameter_mm: 6.5, cut };
    Specimen::new(design).unwrap()
}

fn sheet_of(tiers: Tiers, left_handed: bool) -> CuttingSheet {
    cutting_sheet(&specimen(Cut::Tiers(tiers), 1.54), left_handed).unwrap()
}

/// Returns the lines of a sheet: block, name, angle, indices, instruction, and whether it is below the critical angle.
fn lines(sheet: &CuttingSheet) -> Vec<String> {
    let line = |block: &brillianteer_picture::SheetBlock, row: &brillianteer_picture::SheetRow| {
        let (block, mark) = (block.name.name(), if row.below_critical { "*" } else { "" });
        format!("{block}|{}|{:.2}{mark}|{}|{}", row.name, row.angle_deg, row.indices_text(), row.instruction)
    };
    sheet.blocks.iter().flat_map(|block| block.tiers.iter().map(|row| line(block, row))).collect()
}

#[test]
fn tiers_stand_in_cutting_order_with_all_that_a_cutter_sets() {
    let sheet = sheet_of(step_cut(), false);
    assert_eq!(
        lines(&sheet),
        [
            "PREFORM|PF1|45.00|96-24-48-72|Cut to TCP",
            "PAVILION|G1|90.00|96-24-48-72|Set size",
            "PAVILION|G2|90.00|12-36-60-84|Level girdle",
            "PAVILION|1|55.00|96-24-48-72|Meet G1 at the girdle, then stop",
            "PAVILION|2|38.00*|96-24-48-72|Depth 0.3500 W",
            "CROWN|A|40.00|96-24-48-72|Größe",
            "CROWN|T|0.00||Table, depth 0.1500 W",
        ]
    );
    assert_eq!(
        (sheet.title.as_str(), sheet.lines.as_slice()),
        ("Step", ["by M. Müller".to_owned()].as_slice())
    );
    // Depths count from the middle of the design, which lies 0.4442 widths above the culet.
    assert!(
        sheet.notes[0].starts_with("Depth is the distance") && sheet.notes[0].contains(" 0.4442 W above")
    );
    assert_eq!(sheet.notes[1..], ["One tier of the design is not cut and is left out."]);
    assert_eq!(sheet.below_critical, ["2"]);
    assert!((sheet.critical_angle_deg.unwrap() - 40.493).abs() < 1e-3);
    assert_eq!((sheet.figures.facets, sheet.figures.girdle_facets), (13, 8));
}

#[test]
fn a_left_handed_sheet_counts_backwards_and_cuts_the_same_stone() {
    let (right, left) = (sheet_of(step_cut(), false), sheet_of(step_cut(), true));
    assert!(left.clockwise && !right.clockwise);
    for (a, b) in right.blocks.iter().zip(&left.blocks).flat_map(|(a, b)| a.tiers.iter().zip(&b.tiers)) {
        let mut mirrored: Vec<f64> =
            a.indices.iter().map(|index| if *index == 96.0 { 96.0 } else { 96.0 - index }).collect();
        mirrored.sort_by(|a, b| (a % 96.0).total_cmp(&(b % 96.0)));
        assert_eq!(b.indices, mirrored);
    }
    // A gear that counts clockwise already, and one with an offset.
    let backwards = Tiers { gear: -96, ..step_cut() };
    assert_eq!(lines(&sheet_of(backwards.clone(), true)), lines(&sheet_of(backwards, false)));
    let mut offset = Tiers { offset: 5.0, ..step_cut() };
    offset.tiers[5].facets.truncate(1);
    offset.tiers[5].facets[0].index = 7.0;
    let row = |sheet: CuttingSheet| sheet.blocks[2].tiers[0].indices[0];
    assert_eq!((row(sheet_of(offset.clone(), false)), row(sheet_of(offset, true))), (7.0, 3.0));
}

fn library_cut(name: &str) -> Specimen {
    let text = brillianteer_files::library::cut(name).unwrap();
    Specimen::new(brillianteer_files::cut_file::parse(text, name).unwrap()).unwrap()
}

#[test]
fn a_cut_by_proportions_has_the_sheet_of_the_tiers_that_the_editor_makes_of_it() {
    for name in ["tolkowsky", "oval", "cushion", "princess", "emerald", "barion"] {
        let specimen = library_cut(name);
        let sheet = cutting_sheet(&specimen, false).unwrap();
        let tiers = brillianteer_files::as_tiers(&specimen).unwrap().with_own_meets();
        let rows: Vec<_> = sheet.blocks.iter().flat_map(|block| &block.tiers).collect();
        let named: Vec<(&str, String)> =
            rows.iter().map(|row| (row.name.as_str(), row.instruction.clone())).collect();
        let width = specimen.stone().unwrap().polytope.bounds();
        let width = (width.1 - width.0).truncate().min_element();
        for ((name, said), tier) in named.iter().zip(&tiers.tiers) {
            assert_eq!(*name, tier.name());
            match &tier.meet {
                Some(meet) => assert_eq!(*said, meet.to_string()),
                // A family's own unit is half of its diameter, as that of stones.
                None => assert!(said.ends_with(&format!("epth {:.4} W", tier.distance / width)), "{said}"),
            }
        }
        assert_eq!(named.len(), tiers.tiers.len(), "{name}");
        // In cutting order: pavilion, girdle, crown, and the table last.
        let letters: Vec<char> = rows.iter().filter_map(|row| row.name.chars().next()).collect();
        assert!(letters.is_sorted_by_key(|letter| "PGCT".find(*letter)), "{name}: {letters:?}");
        assert_eq!(rows.last().map(|row| row.name.as_str()), Some("T"), "{name}");
        let names: std::collections::BTreeSet<&str> = rows.iter().map(|row| row.name.as_str()).collect();
        assert_eq!(names.len(), rows.len(), "{name}: a name twice");
        let led = rows.iter().filter(|row| row.instruction.starts_with("Meet ")).count();
        assert!(led > 0, "{name}: no meet among the instructions");
        // The stone of the sheet is the one of the family.
        let (own, stone) = (&specimen.stone().unwrap().polytope, &sheet.figures);
        assert!(
            (stone.volume_to_width_cubed - SheetFigures::of(own, &[]).volume_to_width_cubed).abs() < 1e-7
        );
        assert_eq!(stone.facets + stone.girdle_facets, own.facets().len(), "{name}");
    }
}

#[test]
fn a_brilliant_and_its_planes_have_one_sheet_and_other_shapes_are_refused() {
    let round = cutting_sheet(&specimen(Cut::RoundBrilliant(TOLKOWSKY), 2.417), false).unwrap();
    assert_eq!((round.gear, round.symmetry, round.mirror), (96, 8, true));
    let rows: Vec<String> = lines(&round);
    assert!(rows.iter().any(|row| row.starts_with("PAVILION|P2|40.75|96-12-24-36-48-60-72-84")), "{rows:#?}");
    let planes = Cut::Planes(TOLKOWSKY.facets().unwrap());
    assert_eq!(lines(&cutting_sheet(&specimen(planes, 2.417), false).unwrap()), rows);
    for (name, why) in
        [("pill", "is curved; `convert`"), ("heart", "a heart is not convex at its cleft; `convert`")]
    {
        let error = cutting_sheet(&library_cut(name), false).unwrap_err();
        assert!(matches!(&error, Failure::Input(text) if text.contains(why)), "{error}");
    }
}

#[test]
fn indices_between_teeth_are_said() {
    let oval = cutting_sheet(&library_cut("oval"), false).unwrap();
    // Along the axes of an oval some facets lie on whole teeth of any gear of an even number.
    assert!(!oval.between_teeth.is_empty() && !oval.between_teeth.contains(&"T".to_owned()));
    let said = assert_printable(&oval).join(" ");
    assert!(said.contains("between teeth of the gear of 96"), "{said}");
    let mut tiers = step_cut();
    assert!(sheet_of(tiers.clone(), false).between_teeth.is_empty());
    assert!(!assert_printable(&sheet_of(tiers.clone(), false)).join(" ").contains("between teeth"));
    // A fifth of a thousandth of a tooth is not printed, half a tooth is.
    tiers.tiers[3].facets[1].index += 2e-4;
    assert!(sheet_of(tiers.clone(), false).between_teeth.is_empty());
    tiers.tiers[3].facets[1].index += 0.5;
    assert_eq!(sheet_of(tiers, true).between_teeth, ["1"]);
}

fn paths(group: &Group) -> Vec<Rect> {
    let of_node = |node: &Node| match node {
        Node::Group(inner) => paths(inner),
        Node::Path(path) => vec![path.abs_stroke_bounding_box()],
        Node::Text(_) | Node::Image(_) => vec![],
    };
    group.children().iter().flat_map(of_node).collect()
}

/// Draws a sheet and checks every page: no two texts overlap, and nothing comes near the edge of the paper. Returns the
/// texts of all pages.
fn assert_printable(sheet: &CuttingSheet) -> Vec<String> {
    let mut said = vec![];
    for paper in [PaperSize::A4, PaperSize::Letter] {
        for page in sheet_pages(sheet, paper) {
            let svg = page.to_string();
            let tree = parse(&svg).unwrap();
            let written = texts(tree.root());
            if let Some((a, b)) = overlapping(&written) {
                panic!("{}: {a:?} overlaps {b:?}", sheet.title);
            }
            let size = tree.size();
            // The first path is the paper.
            let drawn = paths(tree.root()).into_iter().skip(1).map(|path| (path, String::new()));
            for (place, text) in written.iter().cloned().chain(drawn) {
                let inside = place.left() > WHITE
                    && place.top() > WHITE
                    && place.right() < size.width() - WHITE
                    && place.bottom() < size.height() - WHITE;
                assert!(inside, "{}: '{text}' at {place:?} leaves the page of {size:?}", sheet.title);
            }
            said.extend(written.into_iter().map(|(_, text)| text));
        }
    }
    said
}

#[test]
fn sheets_are_printable_and_every_tier_stands_on_them() {
    let mut long = step_cut();
    long.headers.extend((0..12).map(|k| format!("Line {k} {}", "of many words ".repeat(12))));
    long.footers = vec!["a note ".repeat(80), "面Ω<&\"".to_owned()];
    long.tiers[3].instructions = "Meet everything that was cut before ".repeat(9);
    long.tiers[3].facets[0].name = "a name that is longer than any column could be".to_owned();
    for (cut, index) in [
        (Cut::Tiers(step_cut()), 1.54),
        (Cut::Tiers(long), 1.0),
        (Cut::RoundBrilliant(TOLKOWSKY), 2.417),
        (Cut::Planes(TOLKOWSKY.facets().unwrap()), 1.76),
    ] {
        for left_handed in [false, true] {
            let specimen = specimen(cut.clone(), index);
            let sheet = cutting_sheet(&specimen, left_handed).unwrap();
            let said = assert_printable(&sheet);
            for row in sheet.blocks.iter().flat_map(|block| &block.tiers) {
                let angle = format!("{:.2}", row.angle_deg);
                assert!(said.contains(&angle), "{angle} is missing");
            }
        }
    }
}

fn random_tiers() -> impl Strategy<Value = Tiers> {
    let name = "[A-Za-z0-9 äß]{0,12}";
    let leaning =
        (20.0..80.0_f64, 0.5..1.0_f64, 1..24_usize, 0.0..96.0_f64, name, "[a-z0-9 -]{0,60}", any::<bool>());
    let tiers = prop::collection::vec(leaning, 1..40);
    (tiers, prop_oneof![Just(96), Just(-80), Just(77), Just(1), Just(100_000)], 0.0..10.0_f64).prop_map(
        |(tiers, gear, offset)| {
            let teeth = f64::from(i32::abs(gear));
            let spread = |count: usize, first: f64| -> Vec<f64> {
                (0..count).map(|k| (first + k as f64 * 96.0 / count as f64) * teeth / 96.0).collect()
            };
            let mut all =
                vec![tier(-90.0, 1.0, &spread(8, 0.0), ("G", "")), tier(0.0, 0.4, &[0.0], ("T", ""))];
            all.extend(tiers.into_iter().map(|(angle, distance, count, first, name, said, is_down)| {
                let first = if first > 48.0 { first.round() } else { first };
                let angle = if is_down { -angle } else { angle };
                tier(angle, distance, &spread(count, first), (&name, &said))
            }));
            Tiers { gear, offset, symmetry: 1, tiers: all, ..Tiers::default() }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]
    #[test]
    fn random_settings_make_printable_sheets(tiers in random_tiers(), left_handed: bool) {
        let cut = Cut::Tiers(tiers);
        let design = Design { name: "Random".to_owned(), cut, ..specimen(Cut::RoundBrilliant(TOLKOWSKY), 1.6).design };
        if let Ok(specimen) = Specimen::new(design) {
            let sheet = cutting_sheet(&specimen, left_handed).unwrap();
            assert_printable(&sheet);
            // The tiers of the other hand make the same stone.
            let pages = sheet_pages(&sheet, PaperSize::A4);
            prop_assert!(!pages.is_empty());
        }
    }
}

#[test]
fn sheets_are_written_in_every_format_and_a_page_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let mut many = step_cut();
    many.footers = vec!["a note ".repeat(80); 20];
    for (tiers, is_long) in [(step_cut(), false), (many, true)] {
        let specimen = specimen(Cut::Tiers(tiers), 1.54);
        let sheet = cutting_sheet(&specimen, false).unwrap();
        for format in [SheetFormat::Pdf, SheetFormat::Svg] {
            let path = folder.path().join(format!("step.{}", format.ending()));
            let files = write(&sheet, PaperSize::A4, (format, &path)).unwrap();
            assert_eq!(files.len() > 1, is_long && format == SheetFormat::Svg, "{files:?}");
            assert!(files.iter().all(|file| file.is_file()), "{files:?}");
            assert_eq!(files.first(), Some(&path));
        }
    }
    assert!(folder.path().join("step-2.svg").is_file());
    let error = write(
        &sheet_of(Tiers { footers: vec!["a note ".repeat(900)], ..step_cut() }, false),
        PaperSize::A4,
        (SheetFormat::Svg, Path::new("-")),
    );
    assert!(matches!(error, Err(Failure::Usage(_))));
}

#[test]
fn every_cut_that_comes_with_the_program_has_a_sheet_or_says_why_not() {
    for (name, text) in brillianteer_files::library::CUTS {
        let specimen = Specimen::new(brillianteer_files::cut_file::parse(text, name).unwrap()).unwrap();
        match cutting_sheet(&specimen, false) {
            Ok(sheet) => drop(assert_printable(&sheet)),
            Err(error) => {
                let said = error.to_string();
                assert!(said.contains("is curved") || said.contains("not convex"), "{said}");
            }
        }
    }
}
