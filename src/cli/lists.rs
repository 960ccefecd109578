//! `materials`, `cuts`, `scenes`, `scopes`, `lights`: list the items that the program knows by name.

use super::console::{print, print_json};
use brillianteer_base::Failure;
use brillianteer_files::assembly::stone_count;
use brillianteer_files::library::{CUTS, SCENES, cut, scene};
use brillianteer_files::{cut_file, light_file, scene_file, scope_file};
use brillianteer_optics::{Material, line, materials};
use brillianteer_paper::lighting;
use brillianteer_paper::table::{Column, Table};
use brillianteer_picture::PictureName;
use brillianteer_scene::{Band, LIGHTS, light};
use clap::Args;
use serde::Serialize;
use std::path::Path;

#[derive(Debug, Args)]
pub struct List {
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// A material that the program knows.
#[derive(Serialize)]
struct ListedMaterial<'a> {
    name: &'a str,
    description: &'a str,
    /// The index in sodium light.
    #[serde(rename = "n_D")]
    n_d: f64,
    /// The index at Fraunhofer G less that at B.
    #[serde(rename = "dispersion_B_G")]
    dispersion_b_g: f64,
    /// The publication of the dispersion.
    source: &'a str,
    /// The wavelengths for which it holds, nm.
    valid_nm: Option<(f64, f64)>,
    /// The density, g/cm³.
    density: Option<f64>,
    /// True where the colour was chosen for its looks.
    colour_is_illustrative: bool,
}

impl<'a> ListedMaterial<'a> {
    fn of(material: &'a Material) -> Self {
        Self {
            name: &material.name,
            description: &material.description,
            n_d: material.index(line::SODIUM_D),
            dispersion_b_g: material.dispersion.dispersion_b_g(),
            source: &material.source,
            valid_nm: material.valid_nm,
            density: material.density,
            colour_is_illustrative: material.colour_is_illustrative,
        }
    }
}

impl List {
    pub fn materials(&self) -> Result<(), Failure> {
        let all: Vec<ListedMaterial> = materials().iter().map(ListedMaterial::of).collect();
        if self.json {
            return print_json(&all);
        }
        let mut table = Table::headed([
            Column::left("material", 20),
            Column::right("n_D", 8).digits(4),
            Column::right("B-G", 9).digits(4),
            Column::right("g/cm³", 8).digits(2),
            Column::text("source").after(2),
        ]);
        for each in all {
            let ListedMaterial { name, n_d, dispersion_b_g, density, source, .. } = each;
            table.row([name.into(), n_d.into(), dispersion_b_g.into(), density.into(), source.into()]);
        }
        print(&table.to_string())
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

/// A cut that comes with the program.
#[derive(Serialize)]
struct ListedCut {
    name: &'static str,
    title: String,
    /// The publication; empty where there is none.
    source: String,
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
            rows.push(ListedCut { name, title: design.name, source: design.source.unwrap_or_default() });
        }
        if self.json {
            return print_json(&rows);
        }
        let mut table = Table::new([Column::left("", 18), Column::left("", 24), Column::text("")]);
        rows.into_iter().for_each(|row| table.row([row.name.into(), row.title.into(), row.source.into()]));
        print(&table.to_string())
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

/// A scene that comes with the program.
#[derive(Serialize)]
struct ListedScene {
    name: &'static str,
    title: String,
    /// The number of stones.
    stones: usize,
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
            rows.push(ListedScene { name, stones: stone_count(Path::new(name), &scene)?, title: scene.name });
        }
        if self.json {
            return print_json(&rows);
        }
        let mut table = Table::new([Column::left("", 14), Column::left("", 20), Column::text("")]);
        for ListedScene { name, title, stones } in rows {
            let count = format!("{stones} {}", if stones == 1 { "stone" } else { "stones" });
            table.row([name.into(), title.into(), count.into()]);
        }
        print(&table.to_string())
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
        let all = || PictureName::ALL.into_iter().filter_map(PictureName::scoped).map(|scoped| scoped.scope);
        if self.json {
            return print_json(&all().collect::<Vec<_>>());
        }
        let Some(name) = &self.name else {
            let mut table = Table::new([Column::left("", 14), Column::text("")]);
            for scope in all() {
                let band = |band: &Band| format!("{} from {}", band.name, band.from);
                let bands: Vec<String> = scope.bands.iter().map(band).collect();
                table.pair(&scope.name, bands.join(", "));
            }
            return print(&table.to_string());
        };
        let known = || all().map(|scope| scope.name).collect::<Vec<_>>().join(", ");
        let scope = all().find(|scope| scope.name == *name);
        let scope = scope.ok_or_else(|| Failure::Usage(format!("no scope '{name}'; known: {}", known())))?;
        let text = scope_file::text(&scope).map_err(|e| Failure::Output(e.to_string()))?;
        print(text.trim_end())
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
            return print_json(&known.collect::<Vec<_>>());
        }
        let Some(name) = &self.name else {
            let mut table = Table::new([Column::left("", 14), Column::text("")]);
            known.for_each(|light| table.pair(&light.name, light.description));
            return print(&table.to_string());
        };
        let light =
            light(&name.to_ascii_lowercase()).ok_or_else(|| Failure::Usage(lighting::unknown(name)))?;
        let text = light_file::text(&light).map_err(|e| Failure::Output(e.to_string()))?;
        print(text.trim_end())
    }
}
