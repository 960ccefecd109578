//! `materials`, `cuts`, `scenes`, `scopes`, `lights`: list the items that the program knows by name.

use super::console::{json, print};
use brillianteer_base::Failure;
use brillianteer_files::assembly::stone_count;
use brillianteer_files::library::{CUTS, SCENES, cut, scene};
use brillianteer_files::{cut_file, light_file, scene_file, scope_file};
use brillianteer_optics::{line, materials};
use brillianteer_paper::lighting;
use brillianteer_picture::{Picture, named, names};
use brillianteer_scene::{LIGHTS, Scope, light};
use clap::Args;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;

#[derive(Debug, Args)]
pub struct List {
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl List {
    pub fn materials(&self) -> Result<(), Failure> {
        if self.json {
            let entry = |m: &brillianteer_optics::Material| {
                json!({
                    "name": m.name,
                    "description": m.description,
                    "n_D": m.index(line::SODIUM_D),
                    "dispersion_B_G": m.dispersion.dispersion_b_g(),
                    "source": m.source,
                    "valid_nm": m.valid_nm,
                    "density": m.density,
                    "colour_is_illustrative": m.colour_is_illustrative,
                })
            };
            return print(&json(&Value::Array(materials().iter().map(entry).collect())));
        }
        let mut text = format!("{:<20}{:>8}{:>9}{:>8}  {}", "material", "n_D", "B-G", "g/cm³", "source");
        for m in materials() {
            let (n, b_g) = (m.index(line::SODIUM_D), m.dispersion.dispersion_b_g());
            let density = m.density.map_or("-".into(), |d| format!("{d:.2}"));
            let _ = write!(text, "\n{:<20}{n:>8.4}{b_g:>9.4}{density:>8}  {}", m.name, m.source);
        }
        print(&text)
    }
}

#[derive(Debug, Args)]
pub struct Cuts {
    /// Print the file of this cut
    name: Option<String>,
    /// Print the list as JSON
    #[arg(long, conflicts_with = "name")]
    json: bool,
}

impl Cuts {
    pub fn run(&self) -> Result<(), Failure> {
        if let Some(name) = &self.name {
            let known = CUTS.map(|(n, _)| n).join(", ");
            let text = cut(name).ok_or_else(|| Failure::Usage(format!("no cut '{name}'; known: {known}")))?;
            return print(text.trim_end());
        }
        let mut rows = vec![];
        for (name, text) in CUTS {
            let design = cut_file::parse(text, name)?;
            rows.push((name, design.name, design.source.unwrap_or_default()));
        }
        if self.json {
            let entry = |(name, title, source)| json!({ "name": name, "title": title, "source": source });
            return print(&json(&Value::Array(rows.into_iter().map(entry).collect())));
        }
        let line = |(name, title, source)| format!("{name:<18}{title:<24}{source}");
        print(&rows.into_iter().map(line).collect::<Vec<_>>().join("\n"))
    }
}

#[derive(Debug, Args)]
pub struct Scenes {
    /// Print the file of this scene
    name: Option<String>,
    /// Print the list as JSON
    #[arg(long, conflicts_with = "name")]
    json: bool,
}

impl Scenes {
    pub fn run(&self) -> Result<(), Failure> {
        if let Some(name) = &self.name {
            let known = SCENES.map(|(n, _)| n).join(", ");
            let unknown = || Failure::Usage(format!("no scene '{name}'; known: {known}"));
            return print(scene(name).ok_or_else(unknown)?.trim_end());
        }
        let mut rows = vec![];
        for (name, text) in SCENES {
            let scene = scene_file::parse(text, name, None)?;
            rows.push((name, stone_count(Path::new(name), &scene)?, scene.name));
        }
        if self.json {
            let entry = |(name, stones, title)| json!({ "name": name, "title": title, "stones": stones });
            return print(&json(&Value::Array(rows.into_iter().map(entry).collect())));
        }
        let line = |(name, stones, title)| {
            format!("{name:<14}{title:<20}{stones} {}", if stones == 1 { "stone" } else { "stones" })
        };
        print(&rows.into_iter().map(line).collect::<Vec<_>>().join("\n"))
    }
}

#[derive(Debug, Args)]
pub struct Scopes {
    /// Print this scope as a file, which `export --scope` takes
    name: Option<String>,
    /// Print the list as JSON, each scope with the keys of its file
    #[arg(long, conflicts_with = "name")]
    json: bool,
}

impl Scopes {
    pub fn run(&self) -> Result<(), Failure> {
        let all = || names().into_iter().filter_map(scope);
        if self.json {
            return print(&json(&json!(all().collect::<Vec<_>>())));
        }
        let Some(name) = &self.name else {
            let line = |scope: Scope| {
                let band = |b: &brillianteer_scene::Band| format!("{} from {}", b.name, b.from);
                format!("{:<14}{}", scope.name, scope.bands.iter().map(band).collect::<Vec<_>>().join(", "))
            };
            return print(&all().map(line).collect::<Vec<_>>().join("\n"));
        };
        let known = || names().into_iter().filter(|n| scope(n).is_some()).collect::<Vec<_>>().join(", ");
        let scope =
            scope(name).ok_or_else(|| Failure::Usage(format!("no scope '{name}'; known: {}", known())))?;
        let text = scope_file::text(&scope).map_err(|e| Failure::Output(e.to_string()))?;
        print(text.trim_end())
    }
}

fn scope(name: &str) -> Option<Scope> {
    match named(name)? {
        Picture::Scoped(scoped) => Some(scoped.scope),
        Picture::Profile | Picture::Diagram => None,
    }
}

#[derive(Debug, Args)]
pub struct Lights {
    /// Print this light as a file to start from
    name: Option<String>,
    /// Print the list as JSON, each light with the keys of its file
    #[arg(long, conflicts_with = "name")]
    json: bool,
}

impl Lights {
    pub fn run(&self) -> Result<(), Failure> {
        let known = LIGHTS.into_iter().filter_map(light);
        if self.json {
            return print(&json(&json!(known.collect::<Vec<_>>())));
        }
        let Some(name) = &self.name else {
            let line = |light: brillianteer_scene::Light| format!("{:<14}{}", light.name, light.description);
            return print(&known.map(line).collect::<Vec<_>>().join("\n"));
        };
        let light =
            light(&name.to_ascii_lowercase()).ok_or_else(|| Failure::Usage(lighting::unknown(name)))?;
        let text = light_file::text(&light).map_err(|e| Failure::Output(e.to_string()))?;
        print(text.trim_end())
    }
}
