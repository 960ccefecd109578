//! `yield`: prints the size, weight and yield of the stone that a piece of rough gives, or that has a weight or a size.

use super::console::{json, print};
use super::options::number;
use super::specimen::{LoadedSpecimen, weight};
use super::specimen_options::SpecimenOptions;
use brillianteer_base::Failure;
use brillianteer_cut::{Finished, FitLimit, Rough, RoughError, Size};
use clap::{ArgGroup, Args};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(group = ArgGroup::new("wanted").required(true).args(["rough", "weight", "stone"]))]
pub struct RoughYield {
    /// A design, or the name of a cut that comes with the program
    file: PathBuf,
    /// The rough's length, width and depth in mm, such as 12x9x7; the stone's axis lies along the depth
    #[arg(long, value_name = "LxWxD", allow_hyphen_values = true)]
    rough: Option<Rough>,
    /// The weight of the finished stone, carats
    #[arg(long, value_name = "CARATS", value_parser = number)]
    weight: Option<f64>,
    /// The thickness of the finished girdle in mm, whatever the size [default: as the design has it]
    #[arg(long, value_name = "MM", value_parser = number)]
    girdle_mm: Option<f64>,
    /// The weight of the rough in carats, of which the yield is a part as well
    #[arg(long, value_name = "CARATS", value_parser = number)]
    rough_weight: Option<f64>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    specimen: SpecimenOptions,
}

impl RoughYield {
    pub fn run(&self) -> Result<(), Failure> {
        if let Some(carats) = self.rough_weight.filter(|carats| !(*carats > 0.0 && carats.is_finite())) {
            return Err(Failure::Usage(format!("--rough-weight {carats}: give more than 0 carats")));
        }
        let specimen = self.specimen.load_shape(&self.file)?;
        let (path, body) = (&specimen.path, specimen.solid());
        let wanted = self.weight.map(Size::Carats).or(self.specimen.sized.size);
        let found = match (&self.rough, wanted) {
            (None, Some(size)) => Finished::of_size(body, size, &specimen.material, self.girdle_mm),
            (rough, _) => {
                let rough =
                    rough.ok_or_else(|| Failure::Usage("give --rough, --weight or --stone".into()))?;
                Finished::from_rough(body, &rough, self.girdle_mm)
            }
        };
        let found = found.map_err(|error| match error {
            RoughError::GirdleOfMesh => Failure::Input(format!("{path}: {error} (leave out --girdle-mm)")),
            RoughError::Thin { .. } | RoughError::Smooth => Failure::Input(format!("{path}: {error}")),
            error => Failure::Usage(format!("{path}: {error}")),
        })?;
        let carats = specimen.material.carats(found.volume_mm3);
        if let Some((carats, rough)) = carats.zip(self.rough_weight).filter(|(carats, rough)| carats > rough)
        {
            return Err(Failure::Usage(format!(
                "{path}: the stone would weigh {carats:.3} ct, and --rough-weight gives the rough {rough} ct; give the weight of \
                 rough that the stone fits into"
            )));
        }
        let value = self.value(&specimen, &found);
        print(&if self.json { json(&value) } else { self.table(&value, &found) })
    }

    fn value(&self, specimen: &LoadedSpecimen, found: &Finished) -> Value {
        let carats = specimen.material.carats(found.volume_mm3);
        let percent = |part: f64| 100.0 * part;
        json!({
            "file": specimen.path,
            "name": specimen.design.name,
            "material": specimen.material.name,
            "density": specimen.material.density,
            "rough_mm": self.rough.map(|rough| rough.sides_mm),
            "rough_carats": self.rough_weight,
            "finished": found,
            "carats": carats,
            "yield_of_box_percent": self.rough.map(|rough| percent(found.yield_of(rough.volume_mm3()))),
            "yield_of_weight_percent": carats.zip(self.rough_weight).map(|(carats, rough)| percent(carats / rough)),
        })
    }

    fn table(&self, value: &Value, found: &Finished) -> String {
        let text = |key: &str| value[key].as_str().unwrap_or_default();
        let mut table = format!("{}: {}, {}\n", text("file"), text("name"), text("material"));
        let mut line = |key: &str, what: String| {
            let _ = writeln!(table, "  {key:<28}{what}");
        };
        let size = |[x, y, depth]: [f64; 3]| format!("{x:.3} by {y:.3} by {depth:.3} mm");
        line("finished size", size(found.own_size_mm));
        line("diameter", format!("{:.3} mm", found.diameter_mm));
        if let Some(mm) = found.girdle_mm {
            line("girdle", format!("{mm:.3} mm"));
        }
        let carats = value["carats"].as_f64();
        line("weight", weight(carats, text("material")));
        if let Some(rough) = self.rough {
            let limit = match found.limit {
                FitLimit::Footprint => "the rough's length and width",
                FitLimit::Depth => "the rough's depth",
                FitLimit::Weight => "the weight",
                FitLimit::Diameter => "the diameter",
            };
            line("limited by", limit.to_owned());
            line("turned in the rough", format!("{:.2} deg", found.turn_deg));
            line("place it takes there", size(found.size_mm));
            line("depth left", format!("{:.3} mm", found.depth_left_mm));
            line("yield of the box", format!("{:.2} %", 100.0 * found.yield_of(rough.volume_mm3())));
        }
        if let Some(percent) = value["yield_of_weight_percent"].as_f64() {
            line("yield of the weight", format!("{percent:.2} %"));
        }
        table.trim_end().to_owned()
    }
}
