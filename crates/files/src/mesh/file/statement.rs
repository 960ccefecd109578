//! The statement that this program writes into a mesh about its stone: the direction up, the size, the material, and
//! some measures by which a reader checks that these still hold.
//!
//! A statement is a line of the word `brillianteer` and pairs of a key and its value: `up`, an axis of the file; `d`, the
//! diameter in mm (2 in the stone's frame); `u`, mm per unit of the file, 1 if left out; `v`, the volume; `s`, the lowest
//! and the highest point; `m`, the middle of the volume; and `n`, the material's name or index, which ends the line. Volume,
//! points and middle are in the stone's frame, whose +x is that of the file and whose origin is the file's.

use brillianteer_base::Fault;
use brillianteer_cut::MaterialRef;
use brillianteer_math::{Surface, rounded};
use glam::{DQuat, DVec3};
use std::fmt::Write as _;

/// The word that begins a statement.
const WORD: &str = "brillianteer";

/// The number of decimals of measures: the most where there is room, and the fewest.
const DECIMALS: std::ops::RangeInclusive<usize> = 3..=6;

/// The most characters of a statement that are read.
const LONGEST: usize = 1_000;

/// The greatest error of measures, in girdle radii: more than the rounding to the fewest decimals.
const NEAR: f64 = 1.5e-3;

/// The statement of a mesh file about its stone.
#[derive(Debug, Clone, PartialEq)]
pub struct Statement {
    /// The axis of the file, y or z, that the table faces.
    pub up: DVec3,
    /// Millimetres in one unit of the file.
    pub mm_per_unit: f64,
    /// The girdle diameter in mm: 2 in the stone's frame.
    pub diameter_mm: f64,
    /// The stone's material: a name of the library or an index; `None` where it is neither.
    pub material: Option<MaterialRef>,
    /// The measures of the stone, in its own frame.
    pub measures: Measures,
}

/// The measures of a solid of triangles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measures {
    /// The volume.
    pub volume: f64,
    /// The lowest and the highest point along an axis.
    pub span: [f64; 2],
    /// The middle of the volume.
    pub middle: DVec3,
}

impl Measures {
    /// Measures a closed surface, with heights along the unit vector `up`. The middle is NaN where the surface encloses
    /// nothing.
    pub fn of(surface: &Surface, up: DVec3) -> Self {
        let (low, high) = surface.bounds();
        let apex = (low + high) / 2.0;
        let (mut volume, mut moment) = (0.0, DVec3::ZERO);
        for t in 0..surface.triangles.len() {
            let [a, b, c] = surface.corners(t).map(|v| v - apex);
            let cone = a.dot(b.cross(c)) / 6.0;
            volume += cone;
            moment += cone * (a + b + c) / 4.0;
        }
        Self { volume, span: span(surface, up), middle: apex + moment / volume }
    }
}

/// Returns the lowest and the highest point of a surface along a unit vector.
pub fn span(surface: &Surface, up: DVec3) -> [f64; 2] {
    let heights = surface.triangles.iter().flatten().map(|&v| surface.vertices[v as usize].dot(up));
    brillianteer_math::span(heights).into()
}

/// The place of a solid in its file, compared with the statement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stands {
    /// The solid lies just as stated.
    AsStated,
    /// The solid has been turned, moved or scaled since.
    Moved {
        /// The direction that was up, in the file's frame.
        up: DVec3,
        /// Girdle radii per unit of the file.
        scale: f64,
    },
    /// The solid has another shape than the statement's measures describe.
    Otherwise,
}

impl Statement {
    /// States a solid in its own frame (`stone`), for a file whose `up` axis is up and whose unit is so many mm.
    pub fn of(
        stone: &Surface,
        up: DVec3,
        mm_per_unit: f64,
        radius_mm: f64,
        material: Option<&MaterialRef>,
    ) -> Self {
        let material = material.filter(|material| !matches!(material, MaterialRef::Custom(_))).cloned();
        let measures = Measures::of(stone, DVec3::Z);
        // The size is rounded, so that the rounding of the unit adds no digits to it.
        let diameter_mm = (2e12 * radius_mm).round() / 1e12;
        Self { up, mm_per_unit, diameter_mm, material, measures }
    }

    /// Returns the rotation from the file's frame to the stone's.
    pub fn turn(&self) -> DQuat {
        DQuat::from_rotation_arc(self.up, DVec3::Z)
    }

    /// Returns the girdle radii per unit of the file.
    pub fn scale(&self) -> f64 {
        2.0 * self.mm_per_unit / self.diameter_mm
    }

    /// Returns the statement as text of at most so many bytes; `None` where even the shortest form is too long.
    ///
    /// Where there is no more room, the measures get fewer decimals, then the diameter does, and at last the material is
    /// left out.
    pub fn text(&self, most: usize) -> Option<String> {
        let least = *DECIMALS.start();
        let forms = DECIMALS.rev().map(|decimals| (decimals, self.diameter_mm, true));
        let (mm, short_mm) = (self.diameter_mm, self.short_diameter_mm());
        let shorter = [(least, short_mm, true), (least, mm, false), (least, short_mm, false)];
        let mut texts =
            forms.chain(shorter).map(|(decimals, mm, material)| self.form(decimals, mm, material));
        texts.find(|text| text.len() <= most)
    }

    /// Returns the diameter to six decimals, or to six digits where that would be 0.
    fn short_diameter_mm(&self) -> f64 {
        let short = (1e6 * self.diameter_mm).round() / 1e6;
        if short > 0.0 {
            short
        } else {
            format!("{:.5e}", self.diameter_mm).parse().unwrap_or(self.diameter_mm)
        }
    }

    fn form(&self, decimals: usize, diameter_mm: f64, material: bool) -> String {
        let short = |x: f64| rounded(x, decimals);
        let axis = if self.up == DVec3::Y { "y" } else { "z" };
        let Measures { volume, span: [low, high], middle } = self.measures;
        // Formatting into a String cannot fail.
        let mut text = format!("{WORD} up={axis} d={diameter_mm}");
        if self.mm_per_unit != 1.0 {
            let _ = write!(text, " u={}", self.mm_per_unit);
        }
        let [x, y, z] = middle.to_array().map(short);
        let _ = write!(text, " v={} s={},{} m={x},{y},{z}", short(volume), short(low), short(high));
        match &self.material {
            Some(MaterialRef::Name(name)) if material => drop(write!(text, " n={name}")),
            Some(MaterialRef::Index(index)) if material => drop(write!(text, " n={index}")),
            _ => {}
        }
        text
    }

    /// Returns whether a text begins like a statement.
    pub fn is_meant(text: &str) -> bool {
        text.trim_start().strip_prefix(WORD).is_some_and(|rest| rest.starts_with(" up="))
    }

    /// Reads a statement.
    ///
    /// # Errors
    /// Fails where the text has an unknown form; the fault says what is wrong.
    pub fn parse(text: &str) -> Result<Self, Fault> {
        let end = text.char_indices().nth(LONGEST).map_or(text.len(), |(end, _)| end);
        let text = text[..end].trim();
        let (pairs, material) =
            text.split_once(" n=").map_or((text, None), |(pairs, name)| (pairs, Some(name)));
        let mut found = Found::default();
        for pair in pairs.split_whitespace().skip(1) {
            found.take(pair)?;
        }
        found.material = material.map(|name| material_of(name.trim())).transpose()?;
        found.whole()
    }

    /// Compares a solid of a file with the statement. The directions in which its table may face, in the file's frame, are
    /// needed where it has been turned.
    pub fn of_solid(&self, surface: &Surface, directions: impl IntoIterator<Item = DVec3>) -> Stands {
        let Measures { volume, span: [low, high], middle } = self.measures;
        let stated = self.scale();
        let there = Measures::of(surface, self.up);
        let near = |a: f64, b: f64| (a - b).abs() <= NEAR;
        let place = self.turn() * there.middle * stated;
        let is_as_stated = near(there.volume * stated.powi(3) / volume, 1.0)
            && near(there.span[0] * stated, low)
            && near(there.span[1] * stated, high)
            && place.distance(middle) <= NEAR;
        if is_as_stated {
            return Stands::AsStated;
        }
        // The stated size has more digits than the volume.
        let scale =
            Some((volume / there.volume).cbrt()).filter(|scale| !near(scale / stated, 1.0)).unwrap_or(stated);
        let off = |up: DVec3| {
            let [below, above] = span(surface, up).map(|z| scale * (z - there.middle.dot(up)));
            (below - (low - middle.z)).abs().max((above - (high - middle.z)).abs())
        };
        if !scale.is_finite() {
            return Stands::Otherwise;
        }
        if off(self.up) <= NEAR {
            return Stands::Moved { up: self.up, scale };
        }
        let nearest = directions.into_iter().map(|up| (off(up), up)).min_by(|a, b| a.0.total_cmp(&b.0));
        match nearest.filter(|(off, _)| *off <= NEAR) {
            Some((_, up)) => Stands::Moved { up, scale },
            None => Stands::Otherwise,
        }
    }
}

/// The parts of a statement that have been read.
#[derive(Default)]
struct Found {
    up: Option<DVec3>,
    numbers: [Option<Vec<f64>>; 5],
    material: Option<MaterialRef>,
}

/// The keys that have numbers, and how many each has.
const NUMBERS: [(&str, usize); 5] = [("d", 1), ("u", 1), ("v", 1), ("s", 2), ("m", 3)];

impl Found {
    fn take(&mut self, pair: &str) -> Result<(), Fault> {
        let (key, value) =
            pair.split_once('=').ok_or_else(|| format!("'{pair}' is not a key with a value"))?;
        if key == "up" {
            self.up = Some(match value {
                "y" => DVec3::Y,
                "z" => DVec3::Z,
                _ => return Err(format!("up={value}: y or z is expected").into()),
            });
            return Ok(());
        }
        // A key that a later version may add does not change the meaning of the known ones.
        let Some(place) = NUMBERS.iter().position(|(known, _)| *known == key) else { return Ok(()) };
        let numbers: Vec<f64> = value.split(',').filter_map(|number| number.parse().ok()).collect();
        if numbers.len() != NUMBERS[place].1 || !numbers.iter().all(|x| x.is_finite()) {
            let count = NUMBERS[place].1;
            return Err(format!("{key}={value}: {count} finite numbers are expected").into());
        }
        self.numbers[place] = Some(numbers);
        Ok(())
    }

    fn whole(self) -> Result<Statement, Fault> {
        let Self { up, numbers: [d, u, v, s, m], material } = self;
        let lacks = |key: &str| Fault::whole(format!("it lacks {key}"));
        let up = up.ok_or_else(|| lacks("up"))?;
        let one = |numbers: Vec<f64>| numbers[0];
        let diameter_mm = d.map(one).ok_or_else(|| lacks("d"))?;
        let mm_per_unit = u.map_or(1.0, one);
        let volume = v.map(one).ok_or_else(|| lacks("v"))?;
        let span = s.ok_or_else(|| lacks("s"))?;
        let middle = DVec3::from_slice(&m.ok_or_else(|| lacks("m"))?);
        let positive = [("d", diameter_mm), ("u", mm_per_unit), ("v", volume), ("s", span[1] - span[0])];
        if let Some((key, value)) = positive.into_iter().find(|(_, value)| *value <= 0.0) {
            return Err(format!("{key}: {value} must be above 0").into());
        }
        let measures = Measures { volume, span: [span[0], span[1]], middle };
        Ok(Statement { up, mm_per_unit, diameter_mm, material, measures })
    }
}

fn material_of(name: &str) -> Result<MaterialRef, Fault> {
    let material = name.parse().map_or_else(|_| MaterialRef::Name(name.to_owned()), MaterialRef::Index);
    material.check().map(|()| material).map_err(Fault::whole)
}
