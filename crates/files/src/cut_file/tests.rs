//! Tests of cut files: permitted and refused contents, the messages about faults, and that reading undoes writing.

use std::fs;
use std::sync::Arc;

use glam::{DQuat, DVec3};

use super::*;
use brillianteer_cut::{Cut, DEFAULT_DIAMETER_MM, MAX_PLANES, MaterialRef, MeshShape};
use brillianteer_math::{Plane, Pose, Surface, TriangleMesh};

mod materials;
mod meets;
mod random;

/// The example that every guide shows.
const TOLKOWSKY: &str = include_str!("../../../../cuts/tolkowsky.toml");

const PLANES: &str = "format = 1\nname = \"wedge\"\nmaterial = 1.5\n\
                      [[plane]]\nnormal = [0, 0, 1]\noffset = 0.3\n\
                      [[plane]]\nname = \"star\"\nnormal = [0.0, 3e0, 4]\noffset = 1\n";

/// Returns Tolkowsky's file with one part replaced.
fn with(part: &str, other: &str) -> String {
    assert!(TOLKOWSKY.contains(part), "the file has no {part}");
    TOLKOWSKY.replacen(part, other, 1)
}

/// Returns the file of planes with one part replaced.
fn planes_with(part: &str, other: &str) -> String {
    assert!(PLANES.contains(part), "the file has no {part}");
    PLANES.replace(part, other)
}

#[track_caller]
fn assert_message(text: &str, expected: &str) {
    // Messages list every family.
    let families: Vec<String> = FAMILIES.iter().map(|family| format!("`{}`", family.key)).collect();
    let expected = expected.replace("FAMILIES", &families.join(", "));
    assert_eq!(parse(text, "x.toml").unwrap_err().to_string(), expected);
}

#[test]
fn tolkowskys_file_reads_as_written() {
    let expected = Design {
        name: "Tolkowsky 1919".to_owned(),
        source: Some("M. Tolkowsky, Diamond Design, 1919".to_owned()),
        notes: None,
        material: MaterialRef::Name("diamond".to_owned()),
        diameter_mm: DEFAULT_DIAMETER_MM,
        cut: Cut::RoundBrilliant(brillianteer_cut::TOLKOWSKY),
    };
    assert_eq!(parse(TOLKOWSKY, "x.toml"), Ok(expected));
}

#[test]
fn planes_read_as_written_with_whole_numbers_for_numbers() {
    let expected =
        [("facet", Plane::new(DVec3::Z, 0.3)), ("star", Plane::new(DVec3::new(0.0, 3.0, 4.0), 1.0))]
            .map(|(name, plane)| (name.to_owned(), plane));
    let design = parse(PLANES, "x.toml").unwrap();
    assert_eq!(design.cut, Cut::Planes(expected.to_vec()));
    assert_eq!(design.material, MaterialRef::Index(1.5));
}

#[test]
fn a_key_that_is_unknown_or_missing_is_told_with_those_that_are_known() {
    assert_message(
        &with("table = 53.0", "tabel = 53.0"),
        "x.toml:6: round_brilliant: unknown key `tabel`, known here are `table`, `crown_angle`, `crown_height`, \
         `pavilion_angle`, `pavilion_depth`, `star_length`, `lower_half_length`, `lower_half_length_vertical`, \
         `girdle_thickness`, `girdle_facets`, `culet`, `total_depth`; did you mean `table`?",
    );
    assert_message(
        &with("[round_brilliant]", ""),
        "x.toml:7: unknown key `crown_angle`, known here are `format`, `name`, `source`, `notes`, `diameter_mm`, \
         `material`, `index`, `tier`, `plane`, `mesh`, FAMILIES; it belongs below a line [round_brilliant]",
    );
    assert_message(
        &with("[round_brilliant]", "[round_brillant]"),
        "x.toml:5: unknown key `round_brillant`, known here are `format`, `name`, `source`, `notes`, `diameter_mm`, \
         `material`, `index`, `tier`, `plane`, `mesh`, FAMILIES; did you mean `round_brilliant`?",
    );
    assert_message(
        &with("\"diamond\"", "{ refraction = 2 }"),
        "x.toml:4: material: unknown key `refraction`, known here are `name`, `description`, `source`, `index`, \
         `sellmeier`, `cauchy`, `abbe`, `absorption`, `absorption_e`, `valid_nm`, `density`, `illustrative`, `dispersion`",
    );
    assert_message(
        &planes_with("offset = 1", "distance = 1"),
        "x.toml:10: plane: unknown key `distance`, known here are `name`, `normal`, `offset`",
    );
    assert_message(
        &with("culet = 0.0", ""),
        "x.toml:5: round_brilliant: the key `culet` is missing (percent of the girdle diameter, 0 for a point)",
    );
    assert_message(
        &planes_with("normal = [0, 0, 1]", ""),
        "x.toml:4: plane: the key `normal` is missing (outward, [x, y, z])",
    );
    assert_message(
        &with("name", "source = \"\" #"),
        "x.toml:3: source: column 1: this key is there a second time; leave one of them out",
    );
    assert_message("format = 1\nmaterial = 2", "x.toml:1: the key `name` is missing (what it is called)");
}

#[test]
fn a_wrong_type_is_told_with_what_was_expected() {
    assert_message(
        &with("table = 53.0", "table = \"53\""),
        "x.toml:6: round_brilliant.table: invalid type: string \"53\", expected a number \
         (percent of the girdle diameter)",
    );
    assert_message(
        &with("girdle_facets = 96", "girdle_facets = 96.5"),
        "x.toml:12: round_brilliant.girdle_facets: invalid type: number `96.5`, expected a whole number (16 to 128)",
    );
    assert_message(
        &with("\"Tolkowsky 1919\"", "1919"),
        "x.toml:2: name: invalid type: integer `1919`, expected text (what it is called)",
    );
    assert_message(
        &with("\"diamond\"", "true"),
        "x.toml:4: material: invalid type: boolean `true`, expected another form \
         (a material's name, an index, or a table of its own)",
    );
    assert_message(
        &with("\"diamond\"", "{ index = 2, absorption = \"dark\" }"),
        "x.toml:4: material.absorption: a number per mm or a list of [nm, per mm] is expected, not text",
    );
    assert_message(
        &with("\"diamond\"", "{ index = 2, absorption_e = \"dark\" }"),
        "x.toml:4: material.absorption_e: a number per mm or a list of [nm, per mm] is expected, not text",
    );
    assert_message(
        &with("\"diamond\"", "{ sellmeier = [[1]] }"),
        "x.toml:4: material.sellmeier: invalid length 1, expected a list of 2 numbers ([[B, C], ...], C in µm)",
    );
    for wrong in ["[0, 1]", "[0, 0, 0, 1]"] {
        assert_message(
            &planes_with("[0.0, 3e0, 4]", wrong),
            &format!(
                "x.toml:9: plane.normal: invalid length {}, expected a list of 3 numbers (outward, [x, y, z])",
                wrong.split(',').count()
            ),
        );
    }
}

#[test]
fn an_index_beyond_the_gear_is_told_with_its_line() {
    let text = "format = 1\nname = \"x\"\nmaterial = 1.5\n[index]\ngear = 96\n[[tier]]\nangle = -45\ndistance = 1\n\
                indices = [96, 24, 48, 72]\n[[tier]]\nangle = 45\ndistance = 1\nindices = [\n0, 25, 100, 97.5]\n\
                names = [\"C\"]\n";
    let (_, warnings) = design(text).unwrap();
    assert_eq!(
        warnings,
        [
            "line 13: tier 2 'C': indices 100, 97.5 are beyond the gear of 96 teeth and are taken as 4, 1.5; check the \
          gear and the tier"
        ]
    );
}

#[test]
fn lists_of_values_do_not_pass_for_tables() {
    assert_message(
        "format = 1\nname = \"x\"\nmaterial = 2\nround_brilliant = [53.0]",
        "x.toml:4: round_brilliant: invalid type: list, expected a table of keys",
    );
    assert_message(
        "format = 1\nname = \"x\"\nmaterial = 2\nplane = [[\"x\", [0, 0, 1], 1]]",
        "x.toml:4: plane: invalid type: list, expected a table of keys",
    );
}

#[test]
fn glass_shapes_read_as_written_and_their_keys_mean_what_their_tables_say() {
    const PLATE: &str = "format = 1\nname = \"x\"\nmaterial = 1.5\n[plate]\nlength = 100\nwidth = 50\ndepth = 10\n\
                         edge = 1\namplitude = 2\nwavelength = 60\n";
    let design = parse(PLATE, "x.toml").unwrap();
    let values: Vec<_> = design.cut.given().map(|(_, value)| value).collect();
    assert_eq!(values, [100.0, 50.0, 10.0, 1.0, 2.0, 60.0, 0.0]);
    assert_eq!(parse(&write(&design), "x.toml").unwrap(), design);
    // A box of a light file has a width too, in degrees.
    assert_message(
        &PLATE.replace("width = 50\n", ""),
        "x.toml:4: plate: the key `width` is missing (percent of the diameter)",
    );
    assert_message(
        &PLATE.replace("[plate]", "[pill]"),
        "x.toml:9: pill: unknown key `amplitude`, known here are `length`, `width`, `depth`, `edge`",
    );
    let both = format!("{PLATE}[cube]\nlength = 1\nwidth = 1\ndepth = 1\nedge = 0\n");
    assert!(parse(&both, "x").unwrap_err().fault.problem.ends_with("give [cube] or [plate], not both"));
}

/// The table of an oval that gives its depth in the place of the pavilion's angle.
const DEEP_OVAL: &str = "format = 1\nname = \"x\"\nmaterial = \"diamond\"\n[oval]\nlength_to_width = 1.4\nfullness = 2.0\n\
    table = 57\ncrown_angle = 34.5\ntotal_depth = 62\nstar_length = 50\nlower_half_length = 75\n\
    girdle_thickness = 3\nculet = 0\n";

#[test]
fn a_depth_stands_in_the_place_of_the_angle_that_it_moves() {
    let of = |text: &str| parse(text, "x").map(|design| design.cut);
    let cut = of(DEEP_OVAL).unwrap();
    let row = |key: &str| cut.proportion(key).unwrap();
    let value = |key: &str| (row(key).get)(&cut);
    assert!((value("total_depth") - 62.0).abs() < 1e-9);
    // Crown and girdle stay: (62 - 3) % of the width less the crown's height is the depth of the pavilion.
    let crown = 50.0 * 0.43 * 34.5_f64.to_radians().tan();
    let pavilion = ((62.0 - 3.0 - crown) / 50.0).atan().to_degrees();
    assert!((value("pavilion_angle") - pavilion).abs() < 1e-9, "{}", value("pavilion_angle"));
    assert_message(
        &format!("{DEEP_OVAL}pavilion_angle = 41\n"),
        "x.toml:9: total_depth: give pavilion_angle or total_depth, not both",
    );
    assert_message(
        &DEEP_OVAL.replace("total_depth = 62\n", ""),
        "x.toml:4: oval: the key `pavilion_angle` is missing (degrees from the girdle plane)",
    );
    let shallow = parse(&DEEP_OVAL.replace("= 62", "= 18"), "x").unwrap_err().to_string();
    assert!(
        shallow.contains("total_depth: 18 % must be at least 19.53 %, below which no stone has it"),
        "{shallow}"
    );
    assert!(shallow.ends_with("raise it by at least 1.54"), "{shallow}");
}

#[test]
fn a_brilliant_can_give_its_depth_as_well() {
    let text = with("pavilion_angle", "total_depth = 61.5\n#");
    let cut = parse(&text, "x").unwrap().cut;
    assert!(((cut.proportion("total_depth").unwrap().get)(&cut) - 61.5).abs() < 1e-9);
    assert_message(
        &(TOLKOWSKY.to_owned() + "total_depth = 61.5"),
        "x.toml:14: total_depth: give pavilion_angle or total_depth, not both",
    );
}

#[test]
fn of_each_pair_one_is_given() {
    for (given, other) in [
        ("crown_angle", "crown_height"),
        ("pavilion_angle", "pavilion_depth"),
        ("lower_half_length", "lower_half_length_vertical"),
    ] {
        let both = TOLKOWSKY.to_owned() + &format!("{other} = 16");
        assert_message(&both, &format!("x.toml:14: {other}: give {given} or {other}, not both"));
        let neither = with(given, "#");
        assert_message(
            &neither,
            &format!("x.toml:5: round_brilliant: {given} or {other} is missing; give one"),
        );
    }
    assert_message(
        &with("\"diamond\"", "{ abbe = [2, 50], index = 2 }"),
        "x.toml:4: material.abbe: give index or abbe, not both",
    );
    assert_message(
        &with("\"diamond\"", "{ name = \"x\" }"),
        "x.toml:4: material: one of index, sellmeier, cauchy, abbe or dispersion is missing",
    );
    let plane = "[[plane]]\nnormal = [0, 0, 1]\noffset = 1";
    assert_message(
        &format!("{TOLKOWSKY}{plane}"),
        "x.toml:14: plane: give [round_brilliant] or [[plane]], not both",
    );
    assert_message(
        "format = 1\nname = \"x\"\nmaterial = 2",
        "x.toml: the cut is missing; give [round_brilliant], [[tier]], [[plane]], [mesh] or a glass shape such as [pill]",
    );
}

#[test]
fn a_mesh_is_written_and_read_to_the_last_bit_and_what_encloses_nothing_is_told() {
    let (vertices, triangles) = crate::solids::heart();
    let mesh = TriangleMesh::new(Surface::new(vertices, triangles)).unwrap();
    let turned = mesh.reframed(&Pose::turned(DQuat::from_rotation_x(0.3)));
    let cut = Cut::Mesh(MeshShape::framed(&turned, DQuat::IDENTITY).unwrap().0);
    let design = Design { cut, ..parse(TOLKOWSKY, "x").unwrap() };
    let text = write(&design);
    assert_eq!(parse(&text, "x").unwrap(), design);
    let line = 1 + text.lines().position(|line| line == "[mesh]").unwrap();
    let open = text.replacen("triangles = [[", "triangles = [[0, 0, 0], [", 1);
    let error = parse(&open, "x.toml").unwrap_err().to_string();
    assert!(
        error.starts_with(&format!("x.toml:{line}: mesh: the surface is open at the edge between ")),
        "{error}"
    );
    let unused = text.replacen("vertices = [", "vertices = [[0.0, 0.0, 0.0], ", 1).replace("[0, ", "[1, ");
    assert!(parse(&unused, "x").unwrap_err().fault.problem.starts_with("mesh: "));
    let line_of = |key: &str| text.lines().find(|line| line.starts_with(key)).unwrap().to_owned();
    let triangles = line_of("triangles");
    let first = &triangles[triangles.find("[[").unwrap() + 1..=triangles.find(']').unwrap()];
    let twice = text.replacen("triangles = [", &format!("triangles = [{first}, "), 1);
    assert!(parse(&twice, "x").unwrap_err().fault.problem.contains("is listed twice"), "{twice}");
    // A mesh that is written in another frame is moved into the stone's.
    let Cut::Mesh(shape) = &design.cut else { panic!() };
    let pose = Pose { at: DVec3::new(3.0, 0.0, -1.0), scale: 7.0, ..Pose::STILL };
    let aside = Design { cut: Cut::Mesh(MeshShape(Arc::new(shape.reframed(&pose)))), ..design.clone() };
    let Cut::Mesh(back) = parse(&write(&aside), "x").unwrap().cut else { panic!() };
    let farthest =
        shape.vertices().iter().zip(back.vertices()).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    assert!(farthest < 1e-12, "{farthest}");
    let both = format!("{text}\n[[plane]]\nnormal = [0, 0, 1]\noffset = 1");
    assert!(parse(&both, "x").unwrap_err().fault.problem.ends_with("give [[plane]] or [mesh], not both"));
}

#[test]
fn what_is_out_of_range_is_told_with_its_line() {
    assert_message(
        &with("table = 53.0", "table = 0.53"),
        "x.toml:6: table: 0.53 % must be at least 5 %, the smallest table allowed; raise it by at least 4.47 (the \
            unit is percent, so 53.0 if a fraction was meant)",
    );
    assert_message(
        &with("pavilion_angle = 40.75", "pavilion_angle = 0.7112"),
        "x.toml:8: pavilion_angle: 0.7112° must be at least 2°, the flattest facet allowed; raise it by at least \
            1.29 (the unit is degrees, so 40.7488 if radians were meant)",
    );
    for (value, limit) in [
        (-5, "must be at least 16, one for each half facet; raise it by at least 21"),
        (129, "must be at most 128, the most facets of any girdle; lower it by at least 1"),
    ] {
        assert_message(
            &with("girdle_facets = 96", &format!("girdle_facets = {value}")),
            &format!("x.toml:12: girdle_facets: {value} {limit}"),
        );
    }
    assert_message(
        &with("crown_angle = 34.5", "crown_angle = 89.9"),
        "x.toml:7: crown_angle: 89.9° must be at most 84.71°, above which the total depth is more than 300 %, that of a \
         needle and not of a brilliant; lower it by at least 5.2",
    );
    assert_message(
        &with("pavilion_angle = 40.75", "pavilion_angle = 85"),
        "x.toml:8: pavilion_angle: 85° must be at most 79.9°, above which the total depth is more than 300 %, that of a \
         needle and not of a brilliant; lower it by at least 5.1",
    );
    assert_message(
        &with("star_length = 50.0", "star_length = nan"),
        "x.toml:9: star_length: NaN is not a finite number; write what was measured",
    );
    assert_message(
        &with("\"diamond\"", "inf"),
        "x.toml:4: material: the index inf must be from 1 (air) to 6",
    );
    assert_message(
        &with("\"diamond\"", "{ index = 0.5 }"),
        "x.toml:4: index: the index 0.5 must be from 1 (air) to 6",
    );
    assert_message(
        &with("name", "diameter_mm = 0\nname"),
        "x.toml:2: diameter_mm: 0 must be from 0.1 to 1000 mm",
    );
    assert_message(
        &with("Tolkowsky 1919", ""),
        "x.toml:2: name: a name of 1 to 200 printable characters is expected",
    );
}

#[test]
fn planes_that_bound_nothing_are_told_with_their_line() {
    assert_message(
        &planes_with("[0.0, 3e0, 4]", "[0, 0, 0]"),
        "x.toml:9: plane 2: normal: [0, 0, 0] is not a direction; three finite numbers that are not all 0 are \
            expected",
    );
    assert_message(
        &planes_with("offset = 1", "offset = inf"),
        "x.toml:10: plane 2: offset: inf is not a finite number; give it in lengths of the normal",
    );
    assert_message(
        &planes_with("\"star\"", "\" \""),
        "x.toml:8: plane 2: name: a name of 1 to 200 printable characters is expected",
    );
    assert_message(
        "format = 1\nname = \"x\"\nmaterial = 2\nplane = []",
        "x.toml:4: plane: 0 planes are given; from 1 to 10000 are expected",
    );
    let plane = "[[plane]]\nnormal = [0, 0, 1]\noffset = 1\n";
    let many = "format = 1\nname = \"x\"\nmaterial = 2\n".to_owned() + &plane.repeat(MAX_PLANES + 1);
    assert_message(&many, "x.toml:30004: plane: 10001 planes are given; from 1 to 10000 are expected");
}

#[test]
fn only_format_one_is_read_whatever_else_the_file_says() {
    assert_message(
        "format = 2\nfacets = 3",
        "x.toml:1: format: 2 is not known here, only 1; update the program",
    );
    assert_message("format = 1.0", "x.toml:1: format: a whole number is expected, `format = 1`");
    assert_message("", "x.toml:1: format: the key is missing; begin the file with `format = 1`");
}

#[test]
fn what_is_not_toml_is_told_with_line_and_column() {
    assert_message(&with("53.0", "53.0.1"), "x.toml:6: table: column 13: this is not a number");
    let comma = "x.toml:6: table: column 11: unexpected key or value, expected newline, `#`; numbers have a decimal point, as in 34.5";
    assert_message(&with("53.0", "53,0"), comma);
    let percent = "x.toml:6: table: column 9: text must stand between quotation marks, as in \"diamond\"; leave the unit out: percent and degrees are understood";
    assert_message(&with("53.0", "53%"), percent);
    assert_message(
        "format = 1\nname = \"x",
        "x.toml:2: name: column 10: the text has no end; a quotation mark is expected behind it",
    );
    let deep = format!("format = 1\nname = {}", "[".repeat(100_000));
    assert_message(&deep, "x.toml:2: name: column 88: lists or tables lie too deep within one another");
    let dotted = format!("format = 1\na{} = 1", ".a".repeat(100_000));
    assert_message(&dotted, "x.toml: this TOML cannot be read: recursion limit");
    assert_message(
        &" ".repeat(MAX_BYTES as usize + 1),
        "x.toml: this is larger than 4 MiB, too large for a file of this kind",
    );
}

#[test]
fn a_file_that_cannot_be_read_is_told_as_such() {
    let folder = tempfile::tempdir().unwrap();
    let message = |name: &str| {
        let text = read(folder.path().join(name)).unwrap_err().to_string();
        text.replace(&folder.path().display().to_string(), "")
    };
    assert_eq!(message("none.toml"), "/none.toml: there is no such file");
    assert_eq!(message(""), "/: this is a directory; a file is expected");
    fs::write(folder.path().join("latin.toml"), b"format = 1\nname = \"taill\xe9\"").unwrap();
    assert_eq!(message("latin.toml"), "/latin.toml:2: this is not UTF-8 text; save the file as UTF-8");
    fs::write(folder.path().join("large.toml"), vec![b' '; MAX_BYTES as usize + 1]).unwrap();
    assert_eq!(
        message("large.toml"),
        "/large.toml: this is larger than 4 MiB, too large for a file of this kind"
    );
    fs::write(folder.path().join("wrong.toml"), with("culet = 0.0", "culet = -1")).unwrap();
    assert!(message("wrong.toml").starts_with("/wrong.toml:13: culet: -1 % must be at least 0 %"));
    assert!(message("wrong.toml/x").starts_with("/wrong.toml/x: cannot be read: "));
}

/// Reads the files of the folder cuts/.
fn shipped() -> Vec<Design> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("cuts");
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    files.map(|path| read(path).unwrap_or_else(|error| panic!("{error}"))).collect()
}

#[test]
fn every_shipped_cut_reads_and_cites_its_source() {
    let designs = shipped();
    assert!(designs.len() >= 6, "only {} files in cuts", designs.len());
    for design in designs {
        assert!(design.source.is_some_and(|source| !source.is_empty()), "{} cites no source", design.name);
    }
}

#[test]
fn the_shipped_brilliants_are_what_their_names_say() {
    let depth = |name: &str| {
        let design = shipped().into_iter().find(|design| design.name == name).unwrap();
        assert_eq!(design.warnings(), Ok(vec![]));
        let Cut::RoundBrilliant(given) = design.cut else { panic!("{name} is no brilliant") };
        given.derived().unwrap().total_depth
    };
    assert!((depth("Sixty sixty") - 60.0).abs() < 1e-12);
    assert!(depth("Steep and deep") > depth("Modern ideal") && depth("Modern ideal") > depth("Shallow"));
    assert!(depth("Fisheye") < depth("Shallow") && depth("Tolkowsky 1919") > 62.0);
}
