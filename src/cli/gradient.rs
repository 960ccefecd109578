//! `gradient`: prints how the measures of a design change with its numbers.

use super::console::{OfFile, print, print_json, say};
use super::measure_taking::MeasureTaking;
use super::progress::WorkProgress;
use super::specimen::note_namesakes;
use brillianteer_base::{ByName, Failure, Unit};
use brillianteer_cut::{Cut, ScaledSide};
use brillianteer_math::signed;
use brillianteer_measure::{Interval, MeasureName};
use brillianteer_paper::table::{Column, Table, TableCell};
use brillianteer_render::{
    GradedStone, LEAST_TIER_DEG, MeasureGradient, MeasureSlopes, RenderError, Sweep, SweepError, SweepKey,
};
use clap::Args;
use serde::Serialize;
use std::path::PathBuf;

/// The measures that are listed where none are chosen.
const USUAL: [&str; 7] =
    ["return-even", "return-cos2", "return-even@15", "leakage", "windowing", "obstruction", "fire"];

#[derive(Debug, Args)]
pub struct GradientArguments {
    /// A design, a mesh, or the name of a cut that comes with the program
    file: PathBuf,
    /// A number to change: the key of a proportion, tier: or distance: and the name of a tier, crown_scale, pavilion_scale, or index; may be
    /// repeated [default: all that the design gives, and the index]
    #[arg(long, value_name = "KEY")]
    by: Vec<String>,
    /// A measure: leakage, windowing, obstruction, fire, absorbed, extinction, contrast, or the return of a dome as in return-even,
    /// return-cos2@15 or return-even+glare; may be repeated [default: seven of them]
    #[arg(long = "of", value_name = "MEASURE")]
    measures: Vec<MeasureName>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    taking: MeasureTaking,
}

impl GradientArguments {
    pub fn run(&self) -> Result<(), Failure> {
        self.taking.check()?;
        let measures = if self.measures.is_empty() {
            USUAL.iter().filter_map(|name| name.parse().ok()).collect()
        } else {
            self.measures.clone()
        };
        let sweep = self.taking.sweep(&self.file, vec![], &measures)?;
        let keys = if self.by.is_empty() {
            all_keys(&sweep.design.cut)
        } else {
            self.by.iter().map(|name| SweepKey::of(name)).collect()
        };
        let file = self.file.display().to_string();
        if !self.by.is_empty() {
            note_namesakes(&file, &sweep.design.cut, &keys);
        }
        let found = {
            let progress = WorkProgress::new(&format!("differentiating {file}"));
            sweep.gradient(&keys, &measures, &progress.watch())
        };
        let found = found.map_err(|error| match error {
            SweepError::Render(RenderError::Stopped(_)) => Failure::Stopped,
            error if error.is_of_design() => Failure::Input(format!("{file}: {error}")),
            error => Failure::Usage(format!("{file}: {error}")),
        })?;
        if let Some(why) = found.stone.measures.cut_short(measures.iter().copied()) {
            say(&format!("warning: {file}: {why}; the derivatives are those of the light that was followed"));
        }
        if self.json {
            let result = FoundSlopes { measures: found.by_name(&keys) };
            return print_json(&OfFile { file: &file, result });
        }
        print(&table(&sweep, &keys, &found))
    }
}

/// Returns the numbers that a design gives, and the index.
fn all_keys(cut: &Cut) -> Vec<SweepKey> {
    let rows = cut.family().into_iter().flat_map(|family| family.editable());
    let given = rows.filter(|row| (row.is_given)(cut) && row.unit != Unit::Count);
    // A culet of 0 is a point, at the end of its range, where it has no derivative.
    let inside = given.filter(|row| (row.get)(cut) > 0.0);
    let mut keys: Vec<SweepKey> = inside.map(|row| SweepKey::Proportion(row.key.to_owned())).collect();
    for setting in cut.settings() {
        // The angle of a table says nothing.
        if setting.angle.abs() > LEAST_TIER_DEG && setting.angle.abs() < 90.0 {
            keys.push(SweepKey::Tier(setting.name));
        }
    }
    if cut.has_scalable_sides() {
        keys.extend(ScaledSide::ALL.map(SweepKey::Scale));
    }
    keys.push(SweepKey::Index);
    keys
}

/// The measures of a design and their changes.
#[derive(Serialize)]
struct FoundSlopes {
    measures: ByName<MeasureSlopes>,
}

/// Formats a gradient as a table: a row for each number, a column for each measure.
fn table(sweep: &Sweep, keys: &[SweepKey], found: &GradedStone) -> String {
    let GradedStone { stone, gradients: found } = found;
    let of_measure = |each: &MeasureGradient| {
        let name = each.name.to_string();
        let width = name.len().max(9) + 2;
        Column::right(name, width).digits(3)
    };
    let columns = std::iter::once(Column::left("", 38)).chain(found.iter().map(of_measure));
    let mut table = Table::headed(columns.collect::<Vec<_>>());
    let mut row = |name: String, cells: Vec<TableCell>| table.row(std::iter::once(name.into()).chain(cells));
    let shown = |of: fn(&Interval) -> f64| -> Vec<TableCell> {
        let value = |each: &MeasureGradient| each.name.of(&stone.measures).map(|value| 100.0 * of(&value));
        found.iter().map(|each| value(each).into()).collect()
    };
    row("value".to_owned(), shown(|value| value.middle()));
    row("±".to_owned(), shown(|value| value.error()));
    let mut kinks = vec![];
    for (k, key) in keys.iter().enumerate() {
        let unit = match key {
            SweepKey::Proportion(name) => sweep.design.cut.proportion(name).map_or("", |row| row.unit.name()),
            SweepKey::Tier(_) => "degrees",
            SweepKey::Scale(_) => "percent",
            _ => "",
        };
        let name = if unit.is_empty() { key.to_string() } else { format!("{key}, {unit}") };
        let mut slopes = |name: String, of: &dyn Fn(&MeasureGradient) -> f64| {
            row(name, found.iter().map(|each| signed(100.0 * of(each), 4).into()).collect());
        };
        if found.iter().all(|each| each.sides[k].is_none()) {
            slopes(name, &|each| each.per[k]);
            continue;
        }
        kinks.push(key.to_string());
        for (side, what) in ["below", "above"].into_iter().enumerate() {
            let of = |each: &MeasureGradient| each.sides[k].map_or(each.per[k], |sides| sides[side]);
            slopes(format!("{name}, {what}"), &of);
        }
    }
    let mut text = format!("{}: percent per unit\n\n{table}\n", sweep.design.name);
    if !kinks.is_empty() {
        let (keys, has) = (kinks.join(", "), if kinks.len() == 1 { "has" } else { "have" });
        text += &format!(
            "\n{keys} {has} a kink at this value: the stone's planes change in another way below it than above it, so that \
             each side has a slope of its own.\n"
        );
    }
    text + "\nSlopes of the light that was followed, at this very design. They can change within hundredths of a degree, and a measure jumps\n\
            where light crosses a border: look at the values beside the design with `sweep` before you follow a slope."
}
