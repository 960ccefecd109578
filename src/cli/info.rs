//! `info`: prints a stone's geometry, proportions and weight, or the stones of a scene.

use super::audit_list::{audit_json, audit_list};
use super::batch::each_file;
use super::console::{json, print, say};
use super::meets::KnownMeets;
use super::specimen::{LoadedSpecimen, weight};
use super::specimen_options::SpecimenOptions;
use brillianteer_base::Failure;
use brillianteer_base::Unit;
use brillianteer_cut::from_mesh::FacetError;
use brillianteer_cut::{
    AlongAxes, Audit, Cut, MaterialRef, MeshHeights, ProportionReport, Spread, tier_stem,
};
use brillianteer_files::STANDARD;
use brillianteer_files::assembly::{Assembly, MadeRing};
use brillianteer_files::built_design::is_scene;
use brillianteer_files::mesh::MeshBody;
use brillianteer_math::{Facet, Polytope, fixed, rounded};
use brillianteer_scene::{ALLOYS, Alloy, Body};
use clap::Args;
use glam::DVec2;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::PathBuf;

/// The tilt of a facet's normal, as the sine of its angle to the axis, up to which rounding alone would choose an azimuth.
/// Such a facet counts as level and has the azimuth 0.
const LEVEL: f64 = 1e-12;

/// The distance from 360 degrees, in degrees, below which an azimuth counts as 0: the rest is rounding.
const ROUNDING_DEG: f64 = 1e-9;

#[derive(Debug, Args)]
pub struct Info {
    /// Designs, meshes and scene files, or names of cuts and scenes that come with the program
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Print JSON: one object with everything, or for several files one object a line
    #[arg(long)]
    json: bool,
    /// List every facet as well
    #[arg(long)]
    facets: bool,
    /// List instead where each tier goes: the meet that the file gives, that its instruction states or that the geometry shows,
    /// and the distance that follows from it. A cut by proportions is turned into tiers first
    #[arg(long)]
    meets: bool,
    /// List instead what may not be meant: near misses, split meets, slivers, tiers below the critical angle,
    /// departures from the symmetry. The list holds candidates, and no verdicts
    #[arg(long)]
    audit: bool,
    #[command(flatten)]
    specimen: SpecimenOptions,
}

impl Info {
    pub fn run(&self) -> Result<(), Failure> {
        each_file(&self.files, self.json, |file| {
            if is_scene(file) {
                let assembly = self.specimen.load_assembly(file)?;
                for (name, is_asked) in [("--meets", self.meets), ("--audit", self.audit)] {
                    if is_asked {
                        let file = file.display();
                        say(&format!(
                            "note: {file}: {name} is for single stones and has no effect on a scene"
                        ));
                    }
                }
                return self.print_as(&scene_json(&assembly), || scene_table(&assembly));
            }
            let specimen = self.specimen.load(file)?;
            let mut value = described(&specimen)?;
            let meets = self.meets.then(|| KnownMeets::of(&specimen)).flatten();
            if self.meets && meets.is_none() {
                let why = specimen.why_not_convex().unwrap_or_default();
                specimen
                    .say(&format!("tiers cut convex stones between planes, and {why}, so it has no meets"));
            }
            meets.iter().for_each(|meets| meets.say_turned(&specimen.path));
            if let Some(meets) = &meets {
                value["meets"] = meets.json();
            }
            let audit = self.audited(&specimen);
            if self.audit {
                value["audit"] = audit.as_ref().map_or(Value::Null, audit_json);
            }
            let listed = [meets.as_ref().map(KnownMeets::table), audit.as_ref().map(audit_list)];
            self.print_as(&value, || self.text(&specimen, &value, listed.into_iter().flatten().collect()))
        })
    }

    /// Audits the stone if the option is set; a solid that is no convex stone between planes gets a note instead.
    fn audited(&self, specimen: &LoadedSpecimen) -> Option<Audit> {
        let audit = self.audit.then(|| specimen.audit())?;
        if let Some(why) = specimen.why_not_convex() {
            say(&format!(
                "note: {}: only a convex stone between planes can be audited, and {why}; meets, slivers, critical angles, the girdle \
                 and the symmetry have not been looked at",
                specimen.path
            ));
        }
        audit.ok()
    }

    /// Returns the text about a stone: only the lists whose options are set, or else its figures and tiers.
    fn text(&self, specimen: &LoadedSpecimen, value: &Value, lists: Vec<String>) -> String {
        let heading = heading(&specimen.path, &specimen.design.name);
        let mut parts = if lists.is_empty() { vec![table(specimen, value)] } else { lists };
        parts.extend(self.facets.then(|| facet_table(value)).flatten());
        heading + &parts.join("\n\n")
    }

    fn print_as(&self, value: &Value, table: impl FnOnce() -> String) -> Result<(), Failure> {
        match (self.json, self.files.len()) {
            (true, 1) => print(&json(value)),
            (true, _) => print(&value.to_string()),
            (false, _) => print(&table()),
        }
    }
}

fn scene_json(assembly: &Assembly) -> Value {
    let stones = assembly.scene.instances.iter().zip(&assembly.places).map(|(stone, place)| {
        json!({
            "cut": stone.label,
            "material": stone.material.name,
            "diameter_mm": place.diameter_mm,
            "carats": stone.carats(assembly.scene.unit_mm),
            "at_mm": place.at_mm.to_array(),
        })
    });
    let metals = assembly.scene.metals.iter().map(
        |metal| json!({ "mesh": metal.label, "metal": metal.metal.name(), "roughness": metal.roughness }),
    );
    json!({
        "file": assembly.path,
        "name": assembly.name,
        "light": assembly.look.light,
        "unit_mm": assembly.scene.unit_mm,
        "carats": assembly.carats(),
        "ring": assembly.ring.as_ref().map(ring_json),
        "stones": stones.collect::<Vec<_>>(),
        "metals": metals.collect::<Vec<_>>(),
    })
}

fn scene_table(assembly: &Assembly) -> String {
    let mut text = heading(&assembly.path, &assembly.name);
    let _ = writeln!(text, "  {:<28}{}", "light", assembly.look.light);
    if !assembly.scene.instances.is_empty() {
        let _ = writeln!(text, "  {:<28}{}", "weight", weight_of_all(assembly));
    }
    assembly.ring.iter().for_each(|ring| ring_rows(ring, &mut text));
    if !assembly.scene.instances.is_empty() {
        let _ = write!(text, "\n  {:<20}{:<20}{:>8}{:>12}", "cut", "material", "mm", "weight");
        let _ = write!(text, "{:>9}{:>9}{:>9}", "x mm", "y mm", "z mm");
    }
    for (stone, place) in assembly.scene.instances.iter().zip(&assembly.places) {
        let weight = stone.carats(assembly.scene.unit_mm);
        let weight = weight.map_or("not known".to_owned(), |carats| format!("{carats:.3} ct"));
        let (cut, material, diameter) = (&stone.label, &stone.material.name, place.diameter_mm);
        let _ = write!(text, "\n  {cut:<20}{material:<20}{diameter:>8.3}{weight:>12}");
        // The height is rounded first, so that a tiny negative number does not print as -0.000.
        let at = (1e3 * place.at_mm).round() / 1e3 + 0.0;
        let _ = write!(text, "{:>9}{:>9}{:>9}", fixed(at.x, 3), fixed(at.y, 3), fixed(at.z, 3));
    }
    for metal in &assembly.scene.metals {
        let (mesh, name, roughness) = (&metal.label, metal.metal.name(), metal.roughness);
        let _ = write!(text, "\n  {mesh:<20}{name:<20}roughness {roughness}");
    }
    text
}

fn ring_json(ring: &MadeRing) -> Value {
    let mounting = &ring.mounting;
    let volume_mm3 = mounting.volume_mm3();
    let alloys = alloys(ring).map(|alloy| (alloy.name.to_owned(), json!(alloy.grams(volume_mm3))));
    json!({
        "metal": ring.metal.name(),
        "volume_mm3": volume_mm3,
        "grams": alloys.collect::<serde_json::Map<_, _>>(),
        "culet_height_mm": mounting.culet_height_mm,
        "small_gap_mm": mounting.small_gap_mm,
    })
}

fn ring_rows(ring: &MadeRing, text: &mut String) {
    let mounting = &ring.mounting;
    let volume_mm3 = mounting.volume_mm3();
    let _ = writeln!(text, "  {:<28}{volume_mm3:.1} mm³", "metal of the ring");
    for alloy in alloys(ring) {
        let _ = writeln!(text, "  {:<28}{:.2} g", format!("in {}", alloy.name), alloy.grams(volume_mm3));
    }
    if let Some(height) = mounting.culet_height_mm {
        let _ = writeln!(text, "  {:<28}{} mm", "culet above the finger", fixed(height, 2));
    }
    if let Some(gap) = mounting.small_gap_mm {
        let _ = writeln!(text, "  {:<28}{} mm", "gap between small stones", fixed(gap, 2));
    }
}

/// Returns the alloys of which a ring of this metal may be made.
fn alloys(ring: &MadeRing) -> impl Iterator<Item = &'static Alloy> {
    ALLOYS.iter().filter(|alloy| alloy.metal == ring.metal)
}

/// Returns the first line of a table: the file and the name of the stone or scene in it, only once where they are equal.
///
/// Standard input appears as `stdin`, also as the name of a mesh that has no name but its file's.
fn heading(path: &str, name: &str) -> String {
    let called = |text| if text == STANDARD { "stdin" } else { text };
    match (called(path), called(name)) {
        (path, name) if path == name => format!("{path}\n"),
        (path, name) => format!("{path}: {name}\n"),
    }
}

/// Formats the weight of all stones; without it, names the first material whose density is not known.
fn weight_of_all(assembly: &Assembly) -> String {
    let mut materials = assembly.scene.instances.iter().map(|stone| &stone.material);
    let unknown = materials.find(|material| material.density.is_none());
    weight(assembly.carats(), unknown.map_or("a stone", |material| &material.name))
}

fn described(specimen: &LoadedSpecimen) -> Result<Value, Failure> {
    let mut value = json!({
        "file": specimen.path,
        "name": specimen.design.name,
        "source": specimen.design.source,
        "notes": specimen.design.notes,
        "material": specimen.material.name,
        "diameter_mm": specimen.design.diameter_mm,
        "carats": specimen.carats(),
    });
    if specimen.design.cut.family().is_some() {
        let number = |value, unit| if unit == Unit::Count { json!(value as i64) } else { json!(value) };
        let given = specimen.design.cut.given().map(|(row, value)| (row.key, number(value, row.unit)));
        value["given"] = given.collect();
    }
    if let Cut::RoundBrilliant(brilliant) = &specimen.design.cut {
        let derived = brilliant.derived().map_err(|e| Failure::Input(format!("{}: {e}", specimen.path)))?;
        value["derived"] = json!(derived);
    }
    if !specimen.bodies.is_empty() {
        value["bodies"] = specimen.bodies.iter().map(body_json).collect();
    }
    let (low, high) = specimen.solid().bounds();
    value["volume"] = json!(specimen.solid().volume());
    value["size"] = json!((high - low).to_array());
    if let Body::Mesh(mesh) = &*specimen.body {
        value["triangles"] = json!(mesh.surface().triangles.len());
        value["corners"] = json!(mesh.vertices().len());
        if let Some(heights) = MeshHeights::of(mesh) {
            value["heights"] = json!(heights);
        }
        let mut tiers: Vec<(&str, usize)> = vec![];
        for name in mesh.facet_names().into_iter().map(tier_stem) {
            match tiers.iter_mut().find(|(tier, _)| *tier == name) {
                Some((_, count)) => *count += 1,
                None => tiers.push((name, 1)),
            }
        }
        if !tiers.is_empty() {
            let tier = |(name, facets)| json!({ "name": name, "facets": facets });
            value["tiers"] = tiers.into_iter().map(tier).collect();
        }
    }
    let Ok(stone) = specimen.stone() else { return Ok(value) };
    let polytope = &stone.polytope;
    value["measured"] = json!(ProportionReport::of_cut(&specimen.design.cut, polytope, stone.names()));
    value["surface_area"] = json!(polytope.surface_area());
    value["silhouette_area"] = json!(polytope.silhouette_area(glam::DVec3::Z));
    value["edges"] = json!(polytope.edge_count());
    value["vertices"] = json!(polytope.vertices().iter().map(|v| v.to_array()).collect::<Vec<_>>());
    let facets = polytope.facets().iter().zip(stone.names());
    value["facets"] =
        facets.map(|(facet, name)| facet_json(polytope, facet, name, specimen.error(name))).collect();
    Ok(value)
}

fn body_json(body: &MeshBody) -> Value {
    json!({
        "number": body.number,
        "name": body.name,
        "triangles": body.triangles,
        "is_closed": body.number.is_some(),
        "extent": body.extent.to_array(),
        "inside": body.within,
        "is_read": body.is_read,
    })
}

fn facet_json(polytope: &Polytope, facet: &Facet, name: &str, error: Option<&FacetError>) -> Value {
    let n = facet.plane.normal;
    let across = n.truncate();
    let mut value = json!({
        "name": name,
        "normal": n.to_array(),
        // Adding 0.0 turns -0.0 into 0.0, for planes through the origin.
        "offset": facet.plane.offset + 0.0,
        "slope_deg": across.length().atan2(n.z.abs()).to_degrees(),
        "azimuth_deg": azimuth_deg(across),
        "area": polytope.facet_area(facet),
        "corners": facet.outline,
    });
    if let Some(error) = error {
        value["slope_error_deg"] = json!(error.slope_deg);
        value["azimuth_error_deg"] = json!(error.azimuth_deg);
        value["may_be_several"] = json!(error.is_bent);
    }
    if facet.frosting > 0.0 {
        value["frosting"] = json!(facet.frosting);
    }
    value
}

/// Returns the azimuth of a normal's part in the girdle plane, in degrees from 0 to below 360; 0 for a level facet.
fn azimuth_deg(across: DVec2) -> f64 {
    if across.length() <= LEVEL {
        return 0.0;
    }
    let azimuth = across.to_angle().to_degrees().rem_euclid(360.0);
    // An angle that rounding has put just below 0 becomes 360, or just less.
    if 360.0 - azimuth < ROUNDING_DEG { 0.0 } else { azimuth }
}

/// Formats an azimuth in degrees. An azimuth that rounds to 360 is printed as 0.
fn shown_azimuth(azimuth_deg: f64) -> String {
    let text = fixed(azimuth_deg, 4);
    if text == "360.0000" { fixed(0.0, 4) } else { text }
}

/// Returns the lines below the heading: the numbers of the design, the measured proportions, and the tiers.
fn table(specimen: &LoadedSpecimen, value: &Value) -> String {
    let mut text = String::new();
    let mut line = |key: &str, what: String| {
        let _ = writeln!(text, "  {key:<28}{what}");
    };
    if let Some(source) = &specimen.design.source {
        line("source", source.clone());
    }
    line(
        "material",
        match &specimen.design.material {
            MaterialRef::Index(index) => format!("index {}", rounded(*index, 4)),
            _ => specimen.material.name.clone(),
        },
    );
    line("diameter", format!("{} mm", rounded(specimen.design.diameter_mm, 4)));
    line("weight", weight(specimen.carats(), &specimen.material.name));
    proportions_of_cut(&specimen.design.cut, value, &mut line);
    let Ok(stone) = specimen.stone() else {
        let why = size_of_solid(specimen, value, &mut line);
        let _ = write!(text, "\n  {why}");
        return text;
    };
    let polytope = &stone.polytope;
    let report = ProportionReport::of_cut(&specimen.design.cut, polytope, stone.names());
    if specimen.design.cut.brilliant().is_none() {
        let is_given = |key: &str| value["given"].get(key).is_some();
        proportions(&report, is_given, &mut line);
        match specimen.design.cut {
            Cut::Tiers(_) => ratios(&report.along_axes, &mut line),
            _ => depths(&report, is_given, &mut line),
        }
    }
    let (facets, vertices) = (polytope.facets().len(), polytope.vertices().len());
    line("facets, edges, vertices", format!("{facets}, {}, {vertices}", polytope.edge_count()));
    line("volume", format!("{:.6} girdle radii³", polytope.volume()));
    line("surface area", format!("{:.6} girdle radii²", polytope.surface_area()));
    tiers(&report, &mut text);
    text
}

/// Writes a line for each proportion that the cut's file gives, and for each that follows from them.
fn proportions_of_cut(cut: &Cut, value: &Value, line: &mut impl FnMut(&str, String)) {
    for group in ["given", "derived"] {
        for (key, number) in value[group].as_object().into_iter().flatten() {
            let unit = match cut.proportion(key).map(|row| row.unit) {
                Some(Unit::Degrees) => " deg".to_owned(),
                unit => unit.map(|unit| unit.to_string()).unwrap_or_default(),
            };
            let number = number.as_f64().unwrap_or(f64::NAN);
            let digits = if group == "given" { rounded(number, 4) } else { fixed(number, 4) };
            let mark = if group == "given" { "" } else { "   (derived)" };
            line(&key.replace('_', " "), format!("{digits}{unit}{mark}"));
        }
    }
}

/// Writes the lines of a solid that is no convex stone, and returns why it is traced without facets.
fn size_of_solid(
    specimen: &LoadedSpecimen,
    value: &Value,
    line: &mut impl FnMut(&str, String),
) -> &'static str {
    let (low, high) = specimen.solid().bounds();
    let [x, y, z] = (high - low).to_array();
    line("size", format!("{x:.4} by {y:.4} by {z:.4} girdle radii"));
    let is_mesh = matches!(&*specimen.body, Body::Mesh(_));
    if is_mesh {
        line("triangles, vertices", format!("{}, {}", value["triangles"], value["corners"]));
        for (key, height) in value["heights"].as_object().into_iter().flatten() {
            line(&key.replace('_', " "), format!("{:.2} %", height.as_f64().unwrap_or(f64::NAN)));
        }
    }
    line("volume", format!("{:.6} girdle radii³", specimen.solid().volume()));
    for tier in value["tiers"].as_array().into_iter().flatten() {
        let facets = if tier["facets"] == 1 { "facet" } else { "facets" };
        line(tier["name"].as_str().unwrap_or_default(), format!("{} {facets}", tier["facets"]));
    }
    match (is_mesh, value.get("tiers")) {
        (true, Some(_)) => "not convex: traced as triangles",
        (true, None) => "traced as triangles: it has no facets to list",
        (false, _) => "curved: it has no facets to list",
    }
}

/// Returns a line for each facet, below a line of headings; `None` of a body without facets to list.
fn facet_table(value: &Value) -> Option<String> {
    let facets = value["facets"].as_array()?;
    let is_scan = facets.iter().any(|facet| facet["slope_error_deg"].is_number());
    let mut text = format!("  {:<18}{:>10}{:>11}{:>12}", "facet", "slope deg", "azimuth", "area");
    if is_scan {
        let _ = write!(text, "{:>14}{:>14}", "slope error", "azimuth error");
    }
    for facet in facets {
        let number = |key: &str| facet[key].as_f64().unwrap_or(f64::NAN);
        let name = facet["name"].as_str().unwrap_or_default();
        let (slope, azimuth) = (number("slope_deg"), shown_azimuth(number("azimuth_deg")));
        let area = number("area");
        let _ = write!(text, "\n  {name:<18}{slope:>10.4}{azimuth:>11}{area:>12.6}");
        if is_scan {
            let error =
                |key: &str| facet[key].as_f64().map_or_else(|| "-".to_owned(), |error| fixed(error, 4));
            let _ = write!(text, "{:>14}{:>14}", error("slope_error_deg"), error("azimuth_error_deg"));
        }
    }
    Some(text)
}

/// Returns the name of a measured proportion, which is marked as measured where the design gives one of this name.
fn measured(key: &str, is_given: impl Fn(&str) -> bool) -> String {
    if is_given(&key.replace(' ', "_")) { format!("{key}, measured") } else { key.to_owned() }
}

/// Writes length and table of a stone.
fn proportions(
    report: &ProportionReport,
    is_given: impl Fn(&str) -> bool,
    line: &mut impl FnMut(&str, String),
) {
    // Its name differs from that of the design's own number, which may be below 1, or along the axis.
    line("outline length to width", format!("{:.4}", report.length_to_width));
    let [width, length] = report.table;
    let table = match report.table_corners > 0.0 {
        true => format!("{width:.2} by {length:.2} %, {:.2} % from corner to corner", report.table_corners),
        false => "none".to_owned(),
    };
    line(&measured("table", is_given), table);
}

/// Writes the depths of a stone, as designs give them.
fn depths(report: &ProportionReport, is_given: impl Fn(&str) -> bool, line: &mut impl FnMut(&str, String)) {
    let mut line = |key: &str, what: String| line(&measured(key, &is_given), what);
    line("crown height", format!("{:.2} %", report.crown_height));
    let along = report.girdle_edges.map(|edges| spread(edges, 2));
    // Where the girdle is as thick all round, its edges are level.
    let along = along.filter(|text| text.contains('('));
    let along = along.map(|text| format!(" at the mains; along it {text} %"));
    line("girdle thickness", format!("{:.2} %{}", report.girdle_thickness, along.unwrap_or_default()));
    line("pavilion depth", format!("{:.2} %", report.pavilion_depth));
    line("total depth", format!("{:.2} %", report.total_depth));
}

/// Writes the ratios that cutters' diagrams print, which count all depths in W.
fn ratios(along: &AlongAxes, line: &mut impl FnMut(&str, String)) {
    let [t, u] = along.table.map(|percent| percent / 100.0);
    let mut list = |names: &str, of: &[f64]| {
        let texts: Vec<String> = of.iter().map(|ratio| fixed(*ratio, 3)).collect();
        line(names, texts.join(", "));
    };
    list("L/W, T/W, U/W", &[along.length_to_width, t, u]);
    let AlongAxes { pavilion_to_width, girdle_to_width, crown_to_width, height_to_width, .. } = *along;
    list("P/W, G/W, C/W, H/W", &[pavilion_to_width, girdle_to_width, crown_to_width, height_to_width]);
}

fn tiers(report: &ProportionReport, text: &mut String) {
    let _ =
        write!(text, "\n  {:<18}{:<10}{:>7}{:>24}{:>28}", "tier", "zone", "facets", "slope deg", "distance");
    for tier in &report.tiers {
        let (slope, distance) = (spread(tier.slope_deg, 2), spread(tier.distance, 4));
        let _ =
            write!(text, "\n  {:<18}{:<10}{:>7}{slope:>24}{distance:>28}", tier.name, tier.zone, tier.facets);
    }
}

/// Formats a mean with this many decimal places, followed by its range unless both ends look the same at that precision.
fn spread(spread: Spread, digits: usize) -> String {
    let Spread { least, mean, most } = spread;
    let [low, mean, high] = [least, mean, most].map(|value| fixed(value, digits));
    if low == high { mean } else { format!("{mean} ({low} to {high})") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_shows_neither_a_full_turn_nor_a_minus_before_nought() {
        for angle in [-1e-17, -1e-12, 0.0, 1e-17] {
            assert!(azimuth_deg(DVec2::from_angle(angle)) < 1e-9, "{angle}");
        }
        assert!((azimuth_deg(DVec2::from_angle(-1e-6)) - 359.999_942_7).abs() < 1e-6);
        assert_eq!([359.999_99, 359.99, 0.0].map(shown_azimuth), ["0.0000", "359.9900", "0.0000"]);
        let flat = Spread { least: -1e-17, mean: -1e-18, most: 1e-17 };
        assert_eq!(spread(flat, 4), "0.0000");
    }
}
