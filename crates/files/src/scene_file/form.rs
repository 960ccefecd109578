//! The keys of a scene file, in the order in which they are written, and their ranges.

use super::super::cut_file::material_form::MaterialForm;
use super::super::cut_file::values::{Numbers, OneOf, TomlTable};
use super::super::mesh_options::MeshPart;
use super::super::toml_format::FORMAT;
use super::super::toml_text::line_at;
use super::metal_form::{MetalForm, metals};
use super::numbers::{StatedNumbers, taken};
use super::ring_form::{self, RingForm, ring};
use super::shared::{SizeForm, likely, material, place_mm, shown, within};
use super::{DEFAULT_GAP_MM, Entry, MOST_STONES, SceneFile, behind, found};
use brillianteer_base::Fault;
use brillianteer_cut::is_printable;
use brillianteer_scene::{
    BACKGROUND_DISTANCE, BackgroundRef, LOOK_NUMBERS, Layout, Look, Movement, Tone, USUAL_LIGHT, UnknownTone,
};
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, Error};

/// A whole scene file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneForm {
    format: i64,
    name: String,
    light: Option<String>,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    light_upright: bool,
    background: Option<String>,
    tone: Option<String>,
    layout: Option<String>,
    gap_mm: Option<f64>,
    movement: Option<String>,
    angle_of_view: Option<f64>,
    /// The numbers of the look, which are read by their rows before the rest.
    #[serde(flatten, skip_deserializing)]
    numbers: StatedNumbers,
    #[serde(skip_serializing_if = "Option::is_none")]
    stone: Option<Vec<Spanned<TomlTable<StoneForm>>>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    metal: Vec<Spanned<TomlTable<MetalForm>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ring: Option<Spanned<TomlTable<RingForm>>>,
}

/// The numbers of a scene file that are read by their rows.
pub(super) struct SceneNumbers {
    look: BTreeMap<String, f64>,
    ring: BTreeMap<String, f64>,
}

impl SceneNumbers {
    /// Takes the numbers out of the table of a whole file.
    pub fn take(file: &mut DeTable<'_>) -> Result<Self, Error> {
        Ok(Self {
            look: taken(file, None, LOOK_NUMBERS.into_iter())?,
            ring: taken(file, Some("ring"), ring_form::rows())?,
        })
    }

    /// Returns the keys of the numbers, each with the name of its table, which is empty at the top.
    pub fn keys() -> Vec<(&'static str, &'static str)> {
        let of_ring = ring_form::rows().map(|row| ("ring", row.key));
        LOOK_NUMBERS.into_iter().map(|row| ("", row.key)).chain(of_ring).collect()
    }
}

/// A table `[[stone]]`.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StoneForm {
    cut: String,
    part: Option<PartForm>,
    material: Option<MaterialForm>,
    size: Option<SizeForm>,
    #[serde(default = "one", skip_serializing_if = "is_alone")]
    count: i64,
    #[serde(default)]
    turn: f64,
    #[serde(default)]
    tilt: f64,
    #[serde(default)]
    azimuth: f64,
    at: Option<Numbers<3>>,
}

/// The body of a mesh that a stone is: its number, its name, or `all`.
#[derive(Clone, Serialize, Deserialize)]
#[serde(try_from = "OneOf<IgnoredAny>", into = "String")]
struct PartForm(MeshPart);

impl TryFrom<OneOf<IgnoredAny>> for PartForm {
    type Error = Fault;

    fn try_from(form: OneOf<IgnoredAny>) -> Result<Self, Fault> {
        let part = match form {
            OneOf::Text(text) => MeshPart::from(text.as_str()),
            OneOf::Number(number) => MeshPart::from(number.to_string().as_str()),
            OneOf::Rest(_) => MeshPart::Found,
        };
        match part {
            MeshPart::Found | MeshPart::Number(0) => {
                Err("the number of a body, from 1, its name, or \"all\" is expected".into())
            }
            part => Ok(Self(part)),
        }
    }
}

impl From<PartForm> for String {
    fn from(PartForm(part): PartForm) -> Self {
        part.to_string()
    }
}

fn one() -> i64 {
    1
}

fn is_alone(count: &i64) -> bool {
    *count <= 1
}

const GAPS_MM: RangeInclusive<f64> = 0.0..=1000.0;
const ANGLES_OF_VIEW: RangeInclusive<f64> = 1.0..=120.0;

impl SceneForm {
    /// Returns the form in which a scene is written.
    pub fn of(scene: &SceneFile) -> Self {
        let (look, usual) = (&scene.look, Look::default());
        let is = |layout: &Layout| Layout::NAMES.into_iter().find(|(_, other)| other == layout);
        let is_placed = scene.layout.is_none();
        let stone = |entry| Spanned::new(0..0, TomlTable(StoneForm::of(entry, is_placed)));
        Self {
            format: FORMAT,
            name: scene.name.clone(),
            light: (look.light != USUAL_LIGHT).then(|| look.light.clone()),
            light_upright: look.light_upright,
            background: look.background.as_ref().map(ToString::to_string),
            tone: (look.tone != Tone::default()).then(|| look.tone.name().to_owned()),
            layout: scene.layout.as_ref().and_then(is).map(|(name, _)| name.to_owned()),
            gap_mm: scene.layout.map(|_| scene.gap_mm),
            movement: (scene.movement != Movement::default()).then(|| scene.movement.name().to_owned()),
            angle_of_view: scene.angle_of_view,
            numbers: StatedNumbers::of(LOOK_NUMBERS.into_iter(), look, |row| {
                (row.get)(look) != (row.get)(&usual)
            }),
            stone: (!scene.stones.is_empty()).then(|| scene.stones.iter().map(stone).collect()),
            metal: scene.metals.iter().map(|m| Spanned::new(0..0, TomlTable(MetalForm::of(m)))).collect(),
            ring: scene.ring.as_ref().map(|ring| Spanned::new(0..0, TomlTable(RingForm::of(ring)))),
        }
    }

    /// Returns the scene that the form of a text describes, with the numbers of its look, checked; files that it names are
    /// sought from `folder`.
    pub fn scene(
        self,
        numbers: &SceneNumbers,
        text: &str,
        folder: Option<&Path>,
    ) -> Result<SceneFile, Fault> {
        if !is_printable(&self.name) {
            return Err(Fault::key("name", "name: a name of 1 to 200 printable characters is expected"));
        }
        let look = self.look(&numbers.look, folder)?;
        let layout = self.layout.as_deref().map(layout).transpose()?;
        if self.gap_mm.is_some() && layout.is_none() {
            return Err(Fault::key("gap_mm", "gap_mm: only a layout has gaps; give layout, or leave it out"));
        }
        let gap_mm = self.gap_mm.unwrap_or(DEFAULT_GAP_MM);
        within("gap_mm", "gap_mm", gap_mm, GAPS_MM, "mm")?;
        if let Some(angle) = self.angle_of_view {
            within("angle_of_view", "angle_of_view", angle, ANGLES_OF_VIEW, "degrees")?;
        }
        let movement = self.movement.as_deref().map(movement).transpose()?.unwrap_or_default();
        let stones = stones(self.stone, !self.metal.is_empty() || self.ring.is_some())?;
        let alone = stones.len() == 1;
        let entry = |(index, stone): (usize, Spanned<TomlTable<StoneForm>>)| {
            let line = line_at(text, stone.span().start);
            let TomlTable(form) = stone.into_inner();
            let of_stone =
                |fault: Fault| fault.within(&format!("stone/{index}/"), &format!("stone {}: ", index + 1));
            form.check_place(layout, alone).and_then(|()| form.entry(line)).map_err(of_stone)
        };
        let stones = stones.into_iter().enumerate().map(entry).collect::<Result<_, _>>()?;
        let metals = metals(self.metal, text)?;
        let ring = self.ring.map(|form| ring(form, &numbers.ring, text)).transpose()?;
        let Self { name, angle_of_view, .. } = self;
        Ok(SceneFile { name, look, layout, gap_mm, movement, angle_of_view, stones, metals, ring })
    }

    /// Returns what pictures of the scene are made with.
    fn look(&self, numbers: &BTreeMap<String, f64>, folder: Option<&Path>) -> Result<Look, Fault> {
        let usual = Look::default();
        let light = self.light.as_deref().map(|given| found(given, folder)).transpose()?;
        let tone = self.tone.as_deref().map(str::parse).transpose();
        let tone = tone.map_err(|error: UnknownTone| Fault::key("tone", format!("tone: {error}")))?;
        let mut look = Look {
            light: light.unwrap_or(usual.light),
            light_upright: self.light_upright,
            background: self.background.as_deref().map(|given| behind(given, folder)).transpose()?,
            tone: tone.unwrap_or_default(),
            ..usual
        };
        for row in LOOK_NUMBERS {
            let Some(value) = numbers.get(row.key) else { continue };
            row.check(*value).map_err(|error| Fault::key(row.key, error.to_string()))?;
            (row.set)(&mut look, *value);
        }
        if look.background_mm.is_some() && !look.background.as_ref().is_some_and(BackgroundRef::is_picture) {
            let key = BACKGROUND_DISTANCE.key;
            let message =
                "only a pattern, a world or a photograph has a distance; give background, or leave it out";
            return Err(Fault::key(key, format!("{key}: {message}")));
        }
        Ok(look)
    }
}

fn layout(given: &str) -> Result<Layout, Fault> {
    let names = Layout::NAMES.map(|(name, _)| name);
    let found = Layout::NAMES.iter().find(|(name, _)| *name == given).map(|(_, layout)| *layout);
    let unknown = || format!("layout: '{}' is unknown{}", shown(given), likely(given, &names));
    found.ok_or_else(|| Fault::key("layout", unknown()))
}

fn movement(given: &str) -> Result<Movement, Fault> {
    let names = Movement::NAMES.map(|(name, _)| name);
    let unknown = || format!("movement: '{}' is unknown{}", shown(given), likely(given, &names));
    Movement::named(given).ok_or_else(|| Fault::key("movement", unknown()))
}

/// Returns the tables of stones, which may be missing where there is metal.
fn stones(
    given: Option<Vec<Spanned<TomlTable<StoneForm>>>>,
    has_metal: bool,
) -> Result<Vec<Spanned<TomlTable<StoneForm>>>, Fault> {
    match given {
        None if !has_metal => Err(Fault::line(1, "the key `stone` is missing: give at least one [[stone]]")),
        Some(list) if list.is_empty() && !has_metal => {
            Err(Fault::key("stone", "stone: the list is empty; give at least one [[stone]]"))
        }
        given => {
            let stones = given.unwrap_or_default();
            check_counts(&stones)?;
            Ok(stones)
        }
    }
}

fn check_counts(stones: &[Spanned<TomlTable<StoneForm>>]) -> Result<(), Fault> {
    let mut left = MOST_STONES as i64;
    for (index, stone) in stones.iter().enumerate() {
        let TomlTable(StoneForm { count, .. }) = stone.get_ref();
        if !(1..=left).contains(count) {
            let number = index + 1;
            let message = format!(
                "stone {number}: count: {count} must be at least 1, and all together at most {MOST_STONES}"
            );
            return Err(Fault::key(format!("stone/{index}/count"), message));
        }
        left -= count;
    }
    Ok(())
}

impl StoneForm {
    fn of(entry: &Entry, is_placed: bool) -> Self {
        Self {
            cut: entry.cut.clone(),
            part: Some(entry.part.clone()).filter(|part| *part != MeshPart::Found).map(PartForm),
            material: entry.material.as_ref().map(MaterialForm::of),
            size: entry.size.map(SizeForm),
            count: entry.count as i64,
            turn: entry.turn,
            tilt: entry.tilt,
            azimuth: entry.azimuth,
            at: is_placed.then(|| Numbers(entry.at_mm.to_array())),
        }
    }

    /// Checks that a stone states its place where there is no layout, and only there; a single stone needs none.
    fn check_place(&self, layout: Option<Layout>, alone: bool) -> Result<(), Fault> {
        match (layout, self.at) {
            (Some(_), Some(_)) => {
                Err(Fault::key("at", "at: the layout says where the stones are; leave out one or the other"))
            }
            (None, _) if self.count > 1 => {
                let message = "count: several stones cannot be in one place; give a layout";
                Err(Fault::key("count", message))
            }
            (None, None) if !alone => {
                Err(Fault::key("", "at is missing: give [x, y, z] in mm, or a layout for all"))
            }
            _ => Ok(()),
        }
    }

    fn entry(self, line: usize) -> Result<Entry, Fault> {
        let at_mm = place_mm([self.turn, self.tilt, self.azimuth], self.at)?;
        let material = self.material.map(material).transpose()?;
        Ok(Entry {
            part: self.part.map_or(MeshPart::Found, |PartForm(part)| part),
            cut: self.cut,
            material,
            size: self.size.map(|SizeForm(size)| size),
            count: self.count as usize,
            turn: self.turn,
            tilt: self.tilt,
            azimuth: self.azimuth,
            at_mm,
            line,
        })
    }
}
