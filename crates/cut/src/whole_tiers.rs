//! A cutter's design as serde writes and reads it: the header as `index`, and the tiers as `tier`.

use super::tiers::{Tier, Tiers};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

#[derive(Serialize)]
struct Written<'a> {
    index: &'a Tiers,
    tier: &'a [Tier],
}

#[derive(Deserialize)]
struct Read {
    index: Tiers,
    tier: Vec<Tier>,
}

pub fn serialize<S: Serializer>(tiers: &Tiers, serializer: S) -> Result<S::Ok, S::Error> {
    Written { index: tiers, tier: &tiers.tiers }.serialize(serializer)
}

pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Tiers, D::Error> {
    let Read { index, tier } = Read::deserialize(deserializer)?;
    Ok(Tiers { tiers: tier, ..index })
}
