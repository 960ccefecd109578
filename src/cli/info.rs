//! `info`: a stone's geometry and proportions.

use super::specimen::Specimen;
use super::{Failure, each_file, json, print};
use crate::cut::Cut;
use crate::math::Facet;
use clap::Args;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::PathBuf;

/// A facet whose normal leans less than this (sine of the angle) has no azimuth: rounding would choose it.
const LEVEL: f64 = 1e-12;

#[derive(Debug, Args)]
pub struct Info {
    /// Cut files, or names of cuts that come with the program
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Print JSON: one object, or for several files one a line
    #[arg(long)]
    json: bool,
}

impl Info {
    pub fn run(&self) -> Result<(), Failure> {
        each_file(&self.files, |file| {
            let specimen = Specimen::load(file)?;
            let value = described(&specimen)?;
            match (self.json, self.files.len()) {
                (true, 1) => print(&json(&value)),
                (true, _) => print(&value.to_string()),
                (false, _) => print(&table(&specimen, &value)),
            }
        })
    }
}

fn described(specimen: &Specimen) -> Result<Value, Failure> {
    let polytope = &specimen.stone.polytope;
    let mut value = json!({
        "file": specimen.path,
        "name": specimen.design.name,
        "source": specimen.design.source,
        "notes": specimen.design.notes,
        "material": specimen.material.name,
        "diameter_mm": specimen.design.diameter_mm,
    });
    if let Cut::RoundBrilliant(brilliant) = &specimen.design.cut {
        let derived = brilliant.derived().map_err(|e| Failure::Input(format!("{}: {e}", specimen.path)))?;
        value["given"] = json!(brilliant);
        value["derived"] = json!(derived);
    }
    let (low, high) = polytope.bounds();
    value["volume"] = json!(polytope.volume());
    value["surface_area"] = json!(polytope.surface_area());
    value["silhouette_area"] = json!(polytope.silhouette_area(glam::DVec3::Z));
    value["size"] = json!((high - low).to_array());
    value["edges"] = json!(polytope.edge_count());
    value["vertices"] = json!(polytope.vertices().iter().map(|v| v.to_array()).collect::<Vec<_>>());
    let facets = polytope.facets().iter().zip(specimen.stone.names());
    value["facets"] = facets.map(|(facet, name)| facet_json(specimen, facet, name)).collect();
    Ok(value)
}

fn facet_json(specimen: &Specimen, facet: &Facet, name: &str) -> Value {
    let n = facet.plane.normal;
    let across = n.truncate();
    json!({
        "name": name,
        "normal": n.to_array(),
        "offset": facet.plane.offset,
        "slope_deg": across.length().atan2(n.z.abs()).to_degrees(),
        "azimuth_deg": if across.length() > LEVEL { across.to_angle().to_degrees().rem_euclid(360.0) } else { 0.0 },
        "area": specimen.stone.polytope.facet_area(facet),
        "corners": facet.outline,
    })
}

fn table(specimen: &Specimen, value: &Value) -> String {
    let polytope = &specimen.stone.polytope;
    let mut text = format!("{}: {}\n", specimen.path, specimen.design.name);
    let mut line = |key: &str, what: String| {
        let _ = writeln!(text, "  {key:<28}{what}");
    };
    if let Some(source) = &specimen.design.source {
        line("source", source.clone());
    }
    line("material", specimen.material.name.clone());
    line("diameter", format!("{} mm", specimen.design.diameter_mm));
    for group in ["given", "derived"] {
        for (key, number) in value[group].as_object().into_iter().flatten() {
            let unit = match key.as_str() {
                "girdle_facets" => "",
                k if k.ends_with("angle") => " deg",
                _ => " %",
            };
            let number = number.as_f64().unwrap_or(f64::NAN);
            let digits = if group == "given" { format!("{number}") } else { format!("{number:.4}") };
            let mark = if group == "given" { "" } else { "   (derived)" };
            line(&key.replace('_', " "), format!("{digits}{unit}{mark}"));
        }
    }
    let (facets, vertices) = (polytope.facets().len(), polytope.vertices().len());
    line("facets, edges, vertices", format!("{facets}, {}, {vertices}", polytope.edge_count()));
    line("volume", format!("{:.6} girdle radii³", polytope.volume()));
    line("surface area", format!("{:.6} girdle radii²", polytope.surface_area()));
    let _ = write!(text, "\n  {:<18}{:>10}{:>11}{:>12}", "facet", "slope deg", "azimuth", "area");
    for facet in value["facets"].as_array().into_iter().flatten() {
        let number = |key: &str| facet[key].as_f64().unwrap_or(f64::NAN);
        let name = facet["name"].as_str().unwrap_or_default();
        let (slope, azimuth, area) = (number("slope_deg"), number("azimuth_deg"), number("area"));
        let _ = write!(text, "\n  {name:<18}{slope:>10.4}{azimuth:>11.4}{area:>12.6}");
    }
    text
}
