//! `yield`: prints the size, weight and yield of the stone that a piece of rough gives, or that has a weight or a size.

use super::console::{OfFile, print, print_json};
use super::options::number;
use super::specimen::weight;
use super::specimen_options::SpecimenOptions;
use brillianteer_base::Failure;
use brillianteer_cut::{Finished, FitLimit, Rough, RoughError, Size, YieldReport};
use brillianteer_paper::table::Table;
use clap::{ArgGroup, Args};
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
        let (name, material) = (&specimen.design.name, &specimen.material);
        let report = YieldReport::of(name, material, found, self.rough, self.rough_weight);
        if self.json {
            print_json(&OfFile { file: path, result: report })
        } else {
            print(&format!("{path}: {name}, {}\n{}", material.name, table(&report)))
        }
    }
}

fn table(report: &YieldReport) -> Table {
    let found = &report.finished;
    let mut table = Table::of_pairs();
    let size = |[x, y, depth]: [f64; 3]| format!("{x:.3} by {y:.3} by {depth:.3} mm");
    table.pair("finished size", size(found.own_size_mm));
    table.pair("diameter", format!("{:.3} mm", found.diameter_mm));
    if let Some(mm) = found.girdle_mm {
        table.pair("girdle", format!("{mm:.3} mm"));
    }
    table.pair("weight", weight(report.carats, &report.material));
    if let Some(percent) = report.yield_of_box_percent {
        let limit = match found.limit {
            FitLimit::Footprint => "the rough's length and width",
            FitLimit::Depth => "the rough's depth",
            FitLimit::Weight => "the weight",
            FitLimit::Diameter => "the diameter",
        };
        table.pair("limited by", limit);
        table.pair("turned in the rough", format!("{:.2} deg", found.turn_deg));
        table.pair("place it takes there", size(found.size_mm));
        table.pair("depth left", format!("{:.3} mm", found.depth_left_mm));
        table.pair("yield of the box", format!("{percent:.2} %"));
    }
    if let Some(percent) = report.yield_of_weight_percent {
        table.pair("yield of the weight", format!("{percent:.2} %"));
    }
    table
}
