//! `info`: prints a stone's geometry, proportions and weight, or the stones of a scene.

use super::audit_list::audit_list;
use super::batch::{each_file, print_json_of};
use super::console::{print, say};
use super::meets::MeetList;
use super::specimen::{LoadedSpecimen, weight};
use super::specimen_options::SpecimenOptions;
use brillianteer_base::{Failure, Unit};
use brillianteer_cut::{
    AlongAxes, Audit, CountedAudit, Cut, MaterialRef, ProportionReport, Spread, TierReport,
};
use brillianteer_files::STANDARD;
use brillianteer_files::assembly::Assembly;
use brillianteer_files::built_design::is_scene;
use brillianteer_math::{fixed, rounded};
use brillianteer_paper::info::{FacetInfo, FacetedInfo, MeshInfo, RingInfo, SceneInfo, StoneInfo};
use brillianteer_paper::table::{Column, Table, TableCell};
use clap::Args;
use std::path::{Path, PathBuf};

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
        each_file(
            &self.files,
            self.json,
            |file| if is_scene(file) { self.scene(file) } else { self.stone(file) },
        )
    }

    fn scene(&self, file: &Path) -> Result<(), Failure> {
        let assembly = self.specimen.load_assembly(file)?;
        for (name, is_asked) in [("--meets", self.meets), ("--audit", self.audit)] {
            if is_asked {
                let file = file.display();
                say(&format!("note: {file}: {name} is for single stones and has no effect on a scene"));
            }
        }
        let info = SceneInfo::of(&assembly);
        if self.json {
            return print_json_of(&self.files, &info);
        }
        print(&scene_table(&info, &assembly))
    }

    fn stone(&self, file: &Path) -> Result<(), Failure> {
        let specimen = self.specimen.load(file)?;
        let LoadedSpecimen { path, made, errors, bodies, .. } = &specimen;
        let mut info = StoneInfo::of(path, made, errors, bodies)
            .map_err(|error| Failure::Input(format!("{path}: {error}")))?;
        let meets = self.meets.then(|| MeetList::of(made)).flatten();
        if self.meets && meets.is_none() {
            let why = specimen.why_not_convex().unwrap_or_default();
            specimen.say(&format!("tiers cut convex stones between planes, and {why}, so it has no meets"));
        }
        meets.iter().for_each(|meets| meets.say_turned(path));
        let audit = self.audited(&specimen);
        if !self.json {
            let lists = [meets.as_ref().map(MeetList::table), audit.as_ref().map(audit_list)];
            return print(&self.text(&specimen, &info, lists.into_iter().flatten().collect()));
        }
        info.meets = meets.map(|meets| meets.known.tiers);
        info.audit = self.audit.then(|| audit.map(CountedAudit::from));
        print_json_of(&self.files, &info)
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
    fn text(&self, specimen: &LoadedSpecimen, info: &StoneInfo, lists: Vec<String>) -> String {
        let mut parts = if lists.is_empty() { vec![table(specimen, info)] } else { lists };
        let faceted = info.faceted.as_ref().filter(|_| self.facets);
        parts.extend(faceted.map(|faceted| facet_table(&faceted.facets).to_string()));
        heading(&info.file, &info.name) + &parts.join("\n\n")
    }
}

fn scene_table(info: &SceneInfo, assembly: &Assembly) -> String {
    let mut lines = Table::of_pairs();
    lines.pair("light", info.light.as_str());
    if !info.stones.is_empty() {
        lines.pair("weight", weight_of_all(assembly));
    }
    info.ring.iter().for_each(|ring| ring_rows(ring, &mut lines));
    let bodies = bodies_of_scene(info);
    let mut text = heading(&info.file, &info.name);
    if !lines.is_empty() {
        text += &format!("{lines}\n");
    }
    if !bodies.is_empty() {
        text += &format!("\n{bodies}");
    }
    text
}

/// Returns a table of the stones of a scene, and of its metal.
fn bodies_of_scene(info: &SceneInfo) -> Table {
    let axis = |head: &'static str| Column::right(head, 9).digits(3);
    let columns = [
        Column::left("cut", 20),
        Column::left("material", 20),
        Column::right("mm", 8).digits(3),
        Column::right("weight", 12),
        axis("x mm"),
        axis("y mm"),
        axis("z mm"),
    ];
    let table = if info.stones.is_empty() { Table::new(columns) } else { Table::headed(columns) };
    let mut table = table.indented(2);
    for stone in &info.stones {
        let weight = stone.carats.map_or("not known".to_owned(), |carats| format!("{carats:.3} ct"));
        let kind = [stone.cut.as_str().into(), stone.material.as_str().into(), stone.diameter_mm.into()];
        let at = stone.at_mm.map(|at| TableCell::Number((1e3 * at).round() / 1e3));
        table.row(kind.into_iter().chain([weight.into()]).chain(at));
    }
    for metal in &info.metals {
        let roughness = format!("roughness {}", metal.roughness);
        table.row([metal.mesh.as_str().into(), metal.metal.as_str().into(), roughness.into()]);
    }
    table
}

fn ring_rows(ring: &RingInfo, lines: &mut Table) {
    lines.pair("metal of the ring", format!("{:.1} mm³", ring.volume_mm3));
    for (alloy, grams) in ring.grams.iter() {
        lines.pair(&format!("in {alloy}"), format!("{grams:.2} g"));
    }
    if let Some(height) = ring.culet_height_mm {
        lines.pair("culet above the finger", format!("{} mm", fixed(height, 2)));
    }
    if let Some(gap) = ring.small_gap_mm {
        lines.pair("gap between small stones", format!("{} mm", fixed(gap, 2)));
    }
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

/// Formats an azimuth in degrees. An azimuth that rounds to 360 is printed as 0.
fn shown_azimuth(azimuth_deg: f64) -> String {
    let text = fixed(azimuth_deg, 4);
    if text == "360.0000" { fixed(0.0, 4) } else { text }
}

/// Returns the lines below the heading: the numbers of the design, the measured proportions, and the tiers.
fn table(specimen: &LoadedSpecimen, info: &StoneInfo) -> String {
    let mut lines = Table::of_pairs();
    if let Some(source) = &info.source {
        lines.pair("source", source.as_str());
    }
    let material = match &specimen.design.material {
        MaterialRef::Index(index) => format!("index {}", rounded(*index, 4)),
        _ => info.material.clone(),
    };
    lines.pair("material", material);
    lines.pair("diameter", format!("{} mm", rounded(info.diameter_mm, 4)));
    lines.pair("weight", weight(info.carats, &info.material));
    proportions_of_cut(&specimen.design.cut, info, &mut lines);
    match &info.faceted {
        Some(faceted) => {
            numbers_of_facets(&specimen.design.cut, info, faceted, &mut lines);
            format!("{lines}\n\n{}", tiers(&faceted.measured.tiers))
        }
        None => {
            size_of_solid(info, &mut lines);
            format!("{lines}\n\n  {}", why_unfaceted(info.mesh.as_ref()))
        }
    }
}

/// Adds a line for each proportion that the cut's file gives, and for each that follows from them.
fn proportions_of_cut(cut: &Cut, info: &StoneInfo, lines: &mut Table) {
    let unit = |key: &str| match cut.proportion(key).map(|row| row.unit) {
        Some(Unit::Degrees) => " deg".to_owned(),
        unit => unit.map(|unit| unit.to_string()).unwrap_or_default(),
    };
    for (key, number) in info.given.iter().flat_map(|given| given.iter()) {
        lines.pair(&key.replace('_', " "), format!("{}{}", rounded(number.value(), 4), unit(key)));
    }
    for (key, number) in info.derived.iter().flat_map(|derived| derived.by_key()) {
        lines.pair(&key.replace('_', " "), format!("{}{}   (derived)", fixed(number, 4), unit(key)));
    }
}

/// Adds the lines of a convex stone between planes.
fn numbers_of_facets(cut: &Cut, info: &StoneInfo, faceted: &FacetedInfo, lines: &mut Table) {
    let report = &faceted.measured;
    if cut.brilliant().is_none() {
        let is_given = |key: &str| info.given.as_ref().is_some_and(|given| given.get(key).is_some());
        proportions(report, is_given, lines);
        match cut {
            Cut::Tiers(_) => ratios(&report.along_axes, lines),
            _ => depths(report, is_given, lines),
        }
    }
    let (facets, vertices) = (faceted.facets.len(), faceted.vertices.len());
    lines.pair("facets, edges, vertices", format!("{facets}, {}, {vertices}", faceted.edges));
    lines.pair("volume", format!("{:.6} girdle radii³", info.volume));
    lines.pair("surface area", format!("{:.6} girdle radii²", faceted.surface_area));
}

/// Adds the lines of a solid that is no convex stone.
fn size_of_solid(info: &StoneInfo, lines: &mut Table) {
    let [x, y, z] = info.size;
    lines.pair("size", format!("{x:.4} by {y:.4} by {z:.4} girdle radii"));
    if let Some(mesh) = &info.mesh {
        lines.pair("triangles, vertices", format!("{}, {}", mesh.triangles, mesh.corners));
    }
    if let Some(heights) = info.mesh.as_ref().and_then(|mesh| mesh.heights) {
        for (name, percent) in [
            ("crown height", heights.crown_height),
            ("girdle height", heights.girdle_height),
            ("pavilion depth", heights.pavilion_depth),
            ("total depth", heights.total_depth),
        ] {
            lines.pair(name, format!("{percent:.2} %"));
        }
    }
    lines.pair("volume", format!("{:.6} girdle radii³", info.volume));
    for tier in info.mesh.iter().flat_map(|mesh| &mesh.tiers) {
        let facets = if tier.facets == 1 { "facet" } else { "facets" };
        lines.pair(&tier.name, format!("{} {facets}", tier.facets));
    }
}

/// Says why a solid is traced without facets.
fn why_unfaceted(mesh: Option<&MeshInfo>) -> &'static str {
    match mesh {
        Some(mesh) if !mesh.tiers.is_empty() => "not convex: traced as triangles",
        Some(_) => "traced as triangles: it has no facets to list",
        None => "curved: it has no facets to list",
    }
}

/// Returns a table of the facets.
fn facet_table(facets: &[FacetInfo]) -> Table {
    let is_scan = facets.iter().any(|facet| facet.uncertainty.is_some());
    let mut columns = vec![
        Column::left("facet", 18),
        Column::right("slope deg", 10).digits(4),
        Column::right("azimuth", 11),
        Column::right("area", 12).digits(6),
    ];
    if is_scan {
        columns.push(Column::right("slope error", 14).digits(4));
        columns.push(Column::right("azimuth error", 14).digits(4));
    }
    let mut table = Table::headed(columns).indented(2);
    for facet in facets {
        let error = facet.uncertainty;
        table.row([
            facet.name.as_str().into(),
            facet.slope_deg.into(),
            shown_azimuth(facet.azimuth_deg).into(),
            facet.area.into(),
            error.map(|error| error.slope_error_deg).into(),
            error.and_then(|error| error.azimuth_error_deg).into(),
        ]);
    }
    table
}

/// Returns the name of a measured proportion, which is marked as measured where the design gives one of this name.
fn measured(key: &str, is_given: impl Fn(&str) -> bool) -> String {
    if is_given(&key.replace(' ', "_")) { format!("{key}, measured") } else { key.to_owned() }
}

/// Adds length and table of a stone.
fn proportions(report: &ProportionReport, is_given: impl Fn(&str) -> bool, lines: &mut Table) {
    // Its name differs from that of the design's own number, which may be below 1, or along the axis.
    lines.pair("outline length to width", format!("{:.4}", report.length_to_width));
    let [width, length] = report.table;
    let table = if report.table_corners > 0.0 {
        format!("{width:.2} by {length:.2} %, {:.2} % from corner to corner", report.table_corners)
    } else {
        "none".to_owned()
    };
    lines.pair(&measured("table", is_given), table);
}

/// Adds the depths of a stone, as designs give them.
fn depths(report: &ProportionReport, is_given: impl Fn(&str) -> bool, lines: &mut Table) {
    let mut line = |key: &str, what: String| lines.pair(&measured(key, &is_given), what);
    line("crown height", format!("{:.2} %", report.crown_height));
    let along = report.girdle_edges.map(|edges| spread(edges, 2));
    // Where the girdle is as thick all round, its edges are level.
    let along = along.filter(|text| text.contains('('));
    let along = along.map(|text| format!(" at the mains; along it {text} %"));
    line("girdle thickness", format!("{:.2} %{}", report.girdle_thickness, along.unwrap_or_default()));
    line("pavilion depth", format!("{:.2} %", report.pavilion_depth));
    line("total depth", format!("{:.2} %", report.total_depth));
}

/// Adds the ratios that cutters' diagrams print, which count all depths in W.
fn ratios(along: &AlongAxes, lines: &mut Table) {
    let [t, u] = along.table.map(|percent| percent / 100.0);
    let mut list = |names: &str, of: &[f64]| {
        let texts: Vec<String> = of.iter().map(|ratio| fixed(*ratio, 3)).collect();
        lines.pair(names, texts.join(", "));
    };
    list("L/W, T/W, U/W", &[along.length_to_width, t, u]);
    let AlongAxes { pavilion_to_width, girdle_to_width, crown_to_width, height_to_width, .. } = *along;
    list("P/W, G/W, C/W, H/W", &[pavilion_to_width, girdle_to_width, crown_to_width, height_to_width]);
}

fn tiers(tiers: &[TierReport]) -> Table {
    let columns = [
        Column::left("tier", 18),
        Column::left("zone", 10),
        Column::right("facets", 7),
        Column::right("slope deg", 24),
        Column::right("distance", 28),
    ];
    let mut table = Table::headed(columns).indented(2);
    for tier in tiers {
        let (slope, distance) = (spread(tier.slope_deg, 2), spread(tier.distance, 4));
        let name = tier.name.as_str().into();
        table.row([name, tier.zone.name().into(), tier.facets.into(), slope.into(), distance.into()]);
    }
    table
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
        assert_eq!([359.999_99, 359.99, 0.0].map(shown_azimuth), ["0.0000", "359.9900", "0.0000"]);
        let flat = Spread { least: -1e-17, mean: -1e-18, most: 1e-17 };
        assert_eq!(spread(flat, 4), "0.0000");
    }
}
