//! An emerald cut is built from a block in the table of tiers, as a cutter would, and saved in the formats of cutters.

use super::tiers::{reach, tiers, type_text};
use super::*;
use brillianteer_cut::{FindingKind, Outline};
use brillianteer_files::design_file;
use brillianteer_math::Plane;
use brillianteer_scene::Specimen;
use egui::Role;

/// The place of a tier: a distance in half widths of the stone, or a meet in words.
#[derive(Clone, Copy)]
enum Place {
    At(f64),
    Meet(&'static str),
}
use Place::{At, Meet};

/// The largest difference of planes and of the length to width after a file was read back.
const SAME: f64 = 1e-9;

/// The indices of the facets along the sides, at the ends and over the corners.
const SIDES: &str = "48-96";
const ENDS: &str = "24-72";
const CORNERS: &str = "12-36-60-84";

/// Types the distance of a tier in mm, given in half widths of the stone, which gets 6.5 mm wide.
fn set_distance(bench: &mut Bench, name: &str, radii: f64) {
    let name = format!("Distance of {name}");
    reach(bench, &name);
    bench.type_number(&name, &format!("{}", radii * 3.25));
}

/// Chooses the zone of a tier.
fn set_zone(bench: &mut Bench, name: &str, zone: &str) {
    let field = format!("Zone of {name}");
    reach(bench, &field);
    bench.field(Role::ComboBox, &field).click();
    bench.harness.run_steps(6);
    bench.click(zone);
    bench.harness.run_steps(4);
}

/// Adds a tier after the one of this name: its name, zone, angle, indices and place are typed.
fn add(bench: &mut Bench, after: &str, (name, zone, angle): (&str, &str, &str), indices: &str, place: Place) {
    reach(bench, &format!("Select {after}"));
    bench.click(&format!("Select {after}"));
    bench.click("Add tier");
    let row = bench.editor().model.session.tier.unwrap();
    let first = tiers(bench).tiers[row].name().to_owned();
    type_text(bench, &format!("Name of {first}"), name);
    if tiers(bench).tiers[row].zone().name() != zone {
        set_zone(bench, name, zone);
    }
    type_text(bench, &format!("Indices of {name}"), indices);
    if zone != "girdle" {
        reach(bench, &format!("Angle of {name}"));
        bench.type_number(&format!("Angle of {name}"), angle);
    }
    match place {
        At(radii) => set_distance(bench, name, radii),
        Meet(words) => type_text(bench, &format!("Meet of {name}"), words),
    }
}

/// Opens the block and cuts the stone: outline, three rows of the pavilion, two of the crown, and the table.
pub fn build(it: &mut Bench) {
    it.choose("File", "New from a cut…");
    it.click("Block");
    it.settle();
    it.type_number("Symmetry", "2");
    // The keel goes to the bottom of the block, which is then taken away.
    add(it, "B", ("P1", "pavilion", "42"), SIDES, Meet("Cut to centre point"));
    reach(it, "Select B");
    it.click("Select B");
    it.click("Delete tier");
    add(it, "G1", ("G2", "girdle", ""), ENDS, At(1.4));
    add(it, "G2", ("G3", "girdle", ""), CORNERS, At(1.4));
    type_text(it, "Indices of G1", SIDES);
    set_distance(it, "G1", 1.0);
    ["G1", "G2", "G3"].into_iter().for_each(|name| type_text(it, &format!("Meet of {name}"), "Set size"));
    add(it, "G3", ("P2", "pavilion", "58"), SIDES, At(0.848));
    add(it, "P2", ("P3", "pavilion", "58"), ENDS, Meet("Level girdle"));
    add(it, "P3", ("P4", "pavilion", "58"), CORNERS, Meet("Level girdle"));
    add(it, "P4", ("P5", "pavilion", "50"), SIDES, At(0.8185));
    add(it, "P5", ("P6", "pavilion", "50"), CORNERS, Meet("Meet P2-P4-P5"));
    add(it, "P6", ("P7", "pavilion", "50"), ENDS, Meet("Meet P3-P4-P6"));
    add(it, "P7", ("P8", "pavilion", "42"), CORNERS, Meet("Meet P1-P5-P6"));
    add(it, "P8", ("P9", "pavilion", "42"), ENDS, Meet("Meet P6-P7-P8"));
    add(it, "P9", ("C1", "crown", "45"), SIDES, At(0.7495));
    type_text(it, "Meet of C1", "Set girdle thickness");
    add(it, "C1", ("C2", "crown", "45"), ENDS, Meet("Level girdle"));
    add(it, "C2", ("C3", "crown", "45"), CORNERS, Meet("Level girdle"));
    add(it, "C3", ("C4", "crown", "32"), SIDES, At(0.6444));
    add(it, "C4", ("C5", "crown", "32"), CORNERS, Meet("Meet C1-C3-C4"));
    add(it, "C5", ("C6", "crown", "32"), ENDS, Meet("Meet C2-C3-C5"));
    set_distance(it, "T", 0.4);
    it.settle();
}

fn outline(specimen: &Specimen) -> Outline {
    Outline::of(&specimen.stone().unwrap().polytope)
}

/// Returns the names of the tiers whose distances differ.
fn moved(before: &brillianteer_cut::Tiers, now: &brillianteer_cut::Tiers) -> Vec<String> {
    let pairs = before.tiers.iter().zip(&now.tiers).filter(|(a, b)| (a.distance - b.distance).abs() > 1e-6);
    pairs.map(|(tier, _)| tier.name().to_owned()).collect()
}

/// Returns how far the planes of two stones are apart: the largest distance of a plane to the nearest of the other stone.
fn apart(a: &Specimen, b: &Specimen) -> f64 {
    let planes = |specimen: &Specimen| specimen.stone().unwrap().polytope.planes().collect::<Vec<Plane>>();
    let (a, b) = (planes(a), planes(b));
    assert_eq!(a.len(), b.len());
    let off = |a: &Plane, b: &Plane| (a.normal - b.normal).length().max((a.offset - b.offset).abs());
    let nearest = |plane: &Plane| b.iter().map(|other| off(plane, other)).fold(f64::MAX, f64::min);
    a.iter().map(nearest).fold(0.0, f64::max)
}

#[test]
fn an_emerald_cut_is_built_from_a_block_by_tiers_and_meets_and_saved_in_three_formats() {
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1500.0, 900.0));
    build(&mut bench);
    let made = tiers(&bench);
    let model = &bench.editor().model;
    assert!(model.document.fault().is_none());
    assert!(model.session.meet_faults.iter().all(Option::is_none), "{:?}", model.session.meet_faults);
    let specimen = Arc::clone(model.document.specimen());
    // A closed stone of 24 + 8 + 17 facets, as long as it was set.
    let solid = &specimen.stone().unwrap().polytope;
    assert_eq!((made.count(), solid.facets().len()), (49, 49));
    let seen = outline(&specimen);
    assert!((seen.length / seen.width - 1.4).abs() < 1e-9, "{seen:?}");
    // No corner nearly meets another, the girdle runs level, every plane is used, and the stated symmetry holds.
    let found = specimen.audit().unwrap().findings;
    assert!(found.iter().all(|finding| finding.kind == FindingKind::SmallFacet), "{found:#?}");
    let meets = made.tiers.iter().filter(|tier| tier.meet.is_some()).count();
    assert_eq!(meets, 15);
    // They are written with the names as the tiers have them.
    let words =
        made.tiers.iter().filter(|tier| tier.name() == "P6").map(|tier| tier.instruction().into_owned());
    assert_eq!(words.collect::<Vec<_>>(), ["Meet P2-P4-P5"]);
    // The meets that were typed are kept, and followed once more nothing moves.
    assert!(moved(&made, &made.solved().tiers).is_empty());

    // A flatter second row carries with it what meets it, and nothing else.
    reach(&mut bench, "Angle of P5");
    bench.type_number("Angle of P5", "49");
    let turned = tiers(&bench);
    assert_eq!(moved(&made, &turned), ["P6", "P7", "P8", "P9"]);
    assert!(bench.editor().model.session.meet_faults.iter().all(Option::is_none));
    bench.choose("Edit", "Undo");
    bench.settle();
    assert_eq!(tiers(&bench), made);

    let folder = tempfile::tempdir().unwrap();
    // All three formats hold the digits of a distance and of an angle; what is lost is rounding.
    for ending in ["asc", "gem", "gcs"] {
        let path = folder.path().join("emerald").with_extension(ending);
        bench.choices.lock().unwrap().push(path.clone());
        bench.choose("File", "Save as…");
        bench.settle();
        assert_eq!(bench.editor().model.document.path(), Some(path.as_path()));
        let read = Specimen::new(design_file::read(&path).unwrap().design).unwrap();
        let off = apart(&specimen, &read);
        println!("{ending}: planes are read {off:e} from where they were");
        assert!(off < SAME, "{ending}: {off:e}");
        let seen = outline(&read);
        assert!((seen.length / seen.width - 1.4).abs() < SAME, "{ending}: {seen:?}");
    }
}
