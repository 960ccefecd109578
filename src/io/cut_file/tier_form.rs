//! The keys of a cutter's design: the table `[index]` and the tables `[[tier]]`.

use super::values::TomlTable;
use crate::cut::{Indexed, Tier, Tiers};
use crate::io::file_error::Fault;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The table `[index]`.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct IndexForm {
    gear: i32,
    #[serde(default)]
    offset: f64,
    #[serde(default = "once")]
    symmetry: u32,
    #[serde(default)]
    mirror: bool,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    headers: Vec<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    footers: Vec<String>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    remarks: BTreeMap<String, String>,
}

/// A table `[[tier]]`.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TierForm {
    angle: f64,
    distance: f64,
    indices: Vec<f64>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    names: Vec<String>,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    instructions: String,
    #[serde(default = "yes", skip_serializing_if = "Clone::clone")]
    cut: bool,
}

fn once() -> u32 {
    1
}

fn yes() -> bool {
    true
}

impl IndexForm {
    pub fn of(tiers: &Tiers) -> Self {
        Self {
            gear: tiers.gear,
            offset: tiers.offset,
            symmetry: tiers.symmetry,
            mirror: tiers.mirror,
            headers: tiers.headers.clone(),
            footers: tiers.footers.clone(),
            remarks: tiers.remarks.iter().cloned().collect(),
        }
    }

    /// Returns the design of this gear with these tiers.
    pub fn tiers(self, tiers: Vec<TomlTable<TierForm>>) -> Result<Tiers, Fault> {
        let numbered = tiers.into_iter().enumerate();
        let tiers = numbered.map(|(k, TomlTable(form))| form.tier(k)).collect::<Result<_, _>>()?;
        let Self { gear, offset, symmetry, mirror, headers, footers, remarks } = self;
        let remarks = remarks.into_iter().collect();
        Ok(Tiers { gear, offset, symmetry, mirror, headers, footers, remarks, tiers })
    }
}

impl TierForm {
    pub fn of(tier: &Tier) -> Self {
        let named = tier.facets.iter().rposition(|facet| !facet.name.is_empty()).map_or(0, |last| last + 1);
        Self {
            angle: tier.angle,
            distance: tier.distance,
            indices: tier.facets.iter().map(|facet| facet.index).collect(),
            names: tier.facets[..named].iter().map(|facet| facet.name.clone()).collect(),
            instructions: tier.instructions.clone(),
            cut: tier.is_cut,
        }
    }

    fn tier(self, place: usize) -> Result<Tier, Fault> {
        let (names, indices) = (self.names.len(), self.indices.len());
        if names > indices {
            let message = format!("names: {names} names are given for {indices} indices; give no more names");
            return Err(Fault::key(format!("tier/{place}/names"), message));
        }
        let names = self.names.into_iter().chain(std::iter::repeat_with(String::new));
        Ok(Tier {
            angle: self.angle,
            distance: self.distance,
            instructions: self.instructions,
            is_cut: self.cut,
            facets: self
                .indices
                .into_iter()
                .zip(names)
                .map(|(index, name)| Indexed { index, name })
                .collect(),
        })
    }
}
