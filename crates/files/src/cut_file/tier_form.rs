//! The keys of the tables `[[tier]]` of a cutter's design.

use super::meet_form::MeetForm;
use brillianteer_base::Fault;
use brillianteer_cut::{Indexed, Tier};
use serde::{Deserialize, Serialize};

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
    #[serde(skip_serializing_if = "Option::is_none")]
    meet: Option<MeetForm>,
    #[serde(default = "yes", skip_serializing_if = "Clone::clone")]
    cut: bool,
    #[serde(default, skip_serializing_if = "is_polished")]
    frosting: f64,
}

fn is_polished(frosting: &f64) -> bool {
    *frosting == 0.0
}

fn yes() -> bool {
    true
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
            meet: tier.meet.as_ref().map(MeetForm::of),
            cut: tier.is_cut,
            frosting: tier.frosting,
        }
    }

    /// Returns the tier at this place in the file, from 0.
    pub fn tier(self, place: usize) -> Result<Tier, Fault> {
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
            meet: self.meet.map(|form| form.meet(place)).transpose()?,
            is_cut: self.cut,
            frosting: self.frosting,
            facets: self
                .indices
                .into_iter()
                .zip(names)
                .map(|(index, name)| Indexed { index, name })
                .collect(),
        })
    }
}
