//! The keys of the table `[ring]` of a scene file.

use super::super::cut_file::material_form::MaterialForm;
use super::super::cut_file::values::{Numbers, TomlTable};
use super::super::toml_text::line_at;
use super::numbers::StatedNumbers;
use super::ring_entry::RingEntry;
use super::shared::{SizeForm, likely, material, metal, place_mm, roughness, shown};
use brillianteer_base::{Fault, NumberRow};
use brillianteer_scene::{OuterShape, RING_NUMBERS, Ring, RingStyle};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use toml::Spanned;

/// The table `[ring]`.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RingForm {
    style: String,
    metal: String,
    roughness: Option<f64>,
    stone: Option<String>,
    material: Option<MaterialForm>,
    size: Option<SizeForm>,
    small_stone: Option<String>,
    small_material: Option<MaterialForm>,
    outside: Option<String>,
    /// The numbers, which are read by their rows before the rest.
    #[serde(flatten, skip_deserializing)]
    numbers: StatedNumbers,
    #[serde(default)]
    turn: f64,
    #[serde(default)]
    tilt: f64,
    #[serde(default)]
    azimuth: f64,
    at: Option<Numbers<3>>,
}

impl RingForm {
    /// Returns the form in which a ring is written.
    pub fn of(entry: &RingEntry) -> Self {
        let ring = &entry.ring;
        let material = |given: &Option<_>| given.as_ref().map(MaterialForm::of);
        Self {
            style: ring.style.name().to_owned(),
            metal: entry.metal.name().to_owned(),
            roughness: Some(entry.roughness),
            stone: entry.stone.clone(),
            material: material(&entry.material),
            size: entry.size.map(SizeForm),
            small_stone: entry.small_stone.clone(),
            small_material: material(&entry.small_material),
            outside: Some(ring.outside.name().to_owned()),
            numbers: StatedNumbers::of(rows(), ring, |_| true),
            turn: entry.turn,
            tilt: entry.tilt,
            azimuth: entry.azimuth,
            at: Some(Numbers(entry.at_mm.to_array())),
        }
    }

    /// Returns the ring; numbers that are not given are the usual ones.
    fn ring(&self, numbers: &BTreeMap<String, f64>) -> Result<Ring, Fault> {
        let outside = self.outside.as_deref().map(|name| named("outside", name, &OuterShape::NAMES));
        let usual = Ring::default();
        let style = named("style", &self.style, &RingStyle::NAMES)?;
        let mut ring = Ring { style, outside: outside.transpose()?.unwrap_or(usual.outside), ..usual };
        // `Ring::check` finds what is out of its range.
        rows()
            .for_each(|row| numbers.get(row.key).into_iter().for_each(|value| (row.set)(&mut ring, *value)));
        Ok(ring)
    }

    fn entry(self, numbers: &BTreeMap<String, f64>, line: usize) -> Result<RingEntry, Fault> {
        let ring = self.ring(numbers)?;
        ring.check(self.stone.is_some(), self.small_stone.is_some())
            .map_err(|error| Fault::key(error.key(), error))?;
        let idle = [
            ("material", self.material.is_some() && self.stone.is_none()),
            ("size", self.size.is_some() && self.stone.is_none()),
            ("small_material", self.small_material.is_some() && self.small_stone.is_none()),
        ];
        if let Some((key, _)) = idle.into_iter().find(|(_, is_idle)| *is_idle) {
            return Err(Fault::key(key, format!("{key}: there is no stone for it; leave it out")));
        }
        let at_mm = place_mm([self.turn, self.tilt, self.azimuth], self.at)?;
        let small = |fault: Fault| Fault { key: Some("small_material".to_owned()), ..fault };
        Ok(RingEntry {
            ring,
            metal: metal(&self.metal)?,
            roughness: roughness(self.roughness)?,
            stone: self.stone,
            material: self.material.map(material).transpose()?,
            size: self.size.map(|SizeForm(size)| size),
            small_stone: self.small_stone,
            small_material: self.small_material.map(material).transpose().map_err(small)?,
            turn: self.turn,
            tilt: self.tilt,
            azimuth: self.azimuth,
            at_mm,
            line,
        })
    }
}

/// Returns the rows of a ring's numbers.
pub(super) fn rows() -> impl Iterator<Item = &'static NumberRow<Ring>> {
    RING_NUMBERS.iter().map(|number| &number.row)
}

/// Returns the ring that the table of a text describes, with these numbers.
pub(super) fn ring(
    form: Spanned<TomlTable<RingForm>>,
    numbers: &BTreeMap<String, f64>,
    text: &str,
) -> Result<RingEntry, Fault> {
    let line = line_at(text, form.span().start);
    let TomlTable(form) = form.into_inner();
    form.entry(numbers, line).map_err(|fault| fault.within("ring/", "ring: "))
}

/// Returns the value of a name; the fault names the key and the known names.
fn named<T: Copy>(key: &str, given: &str, known: &[(&'static str, T)]) -> Result<T, Fault> {
    let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
    let unknown = || format!("{key}: '{}' is unknown{}", shown(given), likely(given, &names));
    let found = known.iter().find(|(name, _)| *name == given).map(|(_, meant)| *meant);
    found.ok_or_else(|| Fault::key(key, unknown()))
}

#[cfg(test)]
mod tests {
    use super::super::{is_meant_as_scene, parse, write};
    use super::*;
    use brillianteer_cut::Size;
    use brillianteer_optics::Metal;
    use glam::{DQuat, DVec3};

    const HALO: &str = "format = 1\nname = \"Ring\"\n[ring]\nstyle = \"halo\"\nmetal = \"gold\"\n\
                        stone = \"tolkowsky\"\nsize = \"6.5mm\"\nsmall_stone = \"modern-ideal\"\n\
                        small_material = \"ruby\"\nwidth_mm = 2\noutside = \"flat\"\ntilt = 50\nazimuth = 90\n";

    #[test]
    fn a_ring_is_read_as_written_and_numbers_left_out_are_the_usual_ones() {
        let scene = parse(HALO, "x.toml", None).unwrap();
        assert!(scene.stones.is_empty() && scene.metals.is_empty() && is_meant_as_scene(HALO));
        let ring = scene.ring.as_ref().unwrap();
        let usual = Ring::default();
        let numbers = Ring { style: RingStyle::Halo, outside: OuterShape::Flat, width_mm: 2.0, ..usual };
        assert_eq!((&ring.ring, ring.metal, ring.roughness), (&numbers, Metal::Gold, 0.1));
        assert_eq!((ring.stone.as_deref(), ring.size), (Some("tolkowsky"), Some(Size::Millimetres(6.5))));
        assert_eq!((ring.material.is_none(), ring.small_material.is_some(), ring.line), (true, true, 3));
        // The head leans toward +y.
        let head = ring.turned() * DVec3::Z;
        assert!(head.distance(DQuat::from_rotation_x(-50_f64.to_radians()) * DVec3::Z) < 1e-12, "{head}");
        let again = parse(&write(&scene), "again.toml", None).unwrap().ring.unwrap();
        assert_eq!(RingEntry { line: 3, ..again }, *ring);
    }

    #[test]
    fn what_is_wrong_with_a_ring_is_said_with_line_and_key() {
        for (part, other, message) in [
            (
                "\"halo\"",
                "\"hallo\"",
                "x.toml:4: ring: style: 'hallo' is unknown; did you mean 'halo'? known: band",
            ),
            (
                "style = \"halo\"\n",
                "",
                "x.toml:3: ring: the key `style` is missing (band, four-prong, six-prong",
            ),
            ("\"gold\"", "\"golf\"", "x.toml:5: ring: metal: 'golf' is unknown; did you mean 'gold'?"),
            ("\"flat\"", "\"round\"", "x.toml:11: ring: outside: 'round' is unknown"),
            ("width_mm = 2", "width_mm = 20", "x.toml:10: ring: width_mm: 20 must be from 1 to 12 mm"),
            ("width_mm = 2", "taper = nan", "x.toml:10: ring: taper: NaN must be from 0.4 to 1"),
            ("width_mm = 2", "comfort_mm = 1.5", "x.toml:10: ring: comfort_mm: the inside rises"),
            ("width_mm = 2", "widht_mm = 2", "x.toml:10: ring: unknown key `widht_mm`"),
            ("width_mm = 2", "roughness = 2", "x.toml:10: ring: roughness: 2 must be from 0"),
            ("width_mm = 2", "at = [0, 1e9, 0]", "x.toml:10: ring: at: 1000000000 must be from"),
            ("\"ruby\"", "\"rubby\"", "x.toml:9: ring: material: unknown material 'rubby'"),
            (
                "\"halo\"",
                "\"six-prong\"",
                "x.toml:8: ring: small_stone: a ring of style 'six-prong' has no place",
            ),
            ("stone = \"tolkowsky\"\n", "", "x.toml:3: ring: stone: a ring of style 'halo' holds a stone"),
            ("tilt = 50", "tilt = 181", "x.toml:12: ring: tilt: 181 must be from -180 to 180 degrees"),
        ] {
            assert!(HALO.contains(part), "{part}");
            let text = HALO.replacen(part, other, 1);
            let error = parse(&text, "x.toml", None).unwrap_err().to_string();
            assert!(error.starts_with(message), "{error}\ninstead of\n{message}");
        }
        let idle = HALO.replace("\"halo\"", "\"eternity\"").replace("stone = \"tolkowsky\"\nsize", "size");
        let idle = idle.replacen("small_small_", "small_", 1);
        let error = parse(&idle, "x.toml", None).unwrap_err().to_string();
        assert!(error.starts_with("x.toml:6: ring: size: there is no stone for it"), "{error}");
    }
}
