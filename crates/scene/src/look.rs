//! What pictures under light are made with beside the bodies and the view: light, background, exposure and finish, each
//! once. Scene files, options, panels, exports and presets read the same record, and its numbers as rows.
//!
//! To add a number, add a field with its usual value and a row of [`LOOK_NUMBERS`]: scene files and panels read the row.
//! Its option is in `src/cli/picture_options.rs`, its row of the panel in `crates/editor/src/panels/light_rows.rs`.

use super::background_ref::BackgroundRef;
use super::light::HEADS_DEG;
use super::smoothing::Smoothing;
use super::tone::Tone;
use brillianteer_base::{NumberRow, Unit};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The light of pictures that name none.
pub const USUAL_LIGHT: &str = "studio";

/// The part of the light of sparkles that usually spreads around them, tuned by eye.
pub const USUAL_GLOW: f64 = 0.16;

/// The usual and greatest number of bounces inside a stone after which rays end.
pub const USUAL_BOUNCES: u32 = 64;

/// The usual distance of a hanging background behind the middle, in girdle radii.
pub const USUAL_DISTANCE: f64 = 3.0;

/// What pictures under light are made with, beside the bodies and the view.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Look {
    /// The light: its name, or its file.
    pub light: String,
    /// The angle by which the light is turned about its axis, counter-clockwise seen from the axis's end, in degrees.
    pub light_turn: f64,
    /// True where the light's axis points up in pictures, with its azimuth 0 behind the middle; false where it points to the
    /// eye.
    pub light_upright: bool,
    /// The half angle of the observer's head, which blocks light, in degrees; `None` for the light's own in pictures under
    /// light, and for none in scopes and figures.
    // Earlier versions of the editor kept a `head`, which was 0 for none.
    #[serde(rename = "head_deg")]
    pub head: Option<f64>,
    /// The exposure, in stops.
    pub exposure: f64,
    /// The curve that brings bright light below 1.
    pub tone: Tone,
    /// The number of bands of wavelengths.
    pub wavelengths: u32,
    /// The part of the light of sparkles that spreads around them, 0 to 1.
    pub glow: f64,
    /// The greatest number of bounces inside a stone through which light is followed.
    pub bounces: u32,
    /// The background; `None` for that of the program that makes the picture.
    pub background: Option<BackgroundRef>,
    /// The distance of a world, pattern or photograph behind the middle, in mm; `None` for a distance that grows with the
    /// stone.
    pub background_mm: Option<f64>,
    /// The strength of refraction: the part of its turn that refracted light takes, 0 (straight on) to 1 (physics).
    pub strength: f64,
    /// The method that smooths edges beyond what samples do. Scene files do not hold it: it is a matter of speed.
    pub smoothing: Smoothing,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            light: USUAL_LIGHT.to_owned(),
            light_turn: 0.0,
            light_upright: false,
            head: None,
            exposure: 0.0,
            tone: Tone::default(),
            wavelengths: 16,
            glow: USUAL_GLOW,
            bounces: USUAL_BOUNCES,
            background: None,
            background_mm: None,
            strength: 1.0,
            smoothing: Smoothing::None,
        }
    }
}

/// The angle by which the light is turned.
pub const LIGHT_TURN: NumberRow<Look> = NumberRow {
    span: [-180.0, 180.0],
    step: 1.0,
    decimals: 1,
    ..NumberRow::new(
        "light_turn",
        "Light turn",
        Unit::Degrees,
        [-1e6, 1e6],
        "The angle by which the light of renders is turned about its axis.",
        |look| Some(look.light_turn),
        |look, degrees| look.light_turn = degrees,
    )
};

/// The half angle of the observer's head.
pub const HEAD: NumberRow<Look> = NumberRow {
    span: [0.0, 30.0],
    step: 0.1,
    decimals: 1,
    ..NumberRow::new(
        "head",
        "Head",
        Unit::Degrees,
        HEADS_DEG,
        "Half angle of the observer's head, which blocks light in the ASET, in figures and in renders. At 0 the ASET has none, \
              renders have that of the light, and contrast maps and measures 15°.",
        |look| look.head,
        |look, degrees| look.head = Some(degrees),
    )
};

/// The exposure.
pub const EXPOSURE: NumberRow<Look> = NumberRow {
    span: [-4.0, 4.0],
    step: 0.1,
    decimals: 1,
    ..NumberRow::new(
        "exposure",
        "Exposure",
        Unit::Stops,
        [-40.0, 40.0],
        "The brightness of renders, in stops. One stop more is twice the light.",
        |look| Some(look.exposure),
        |look, stops| look.exposure = stops,
    )
};

/// The number of bands of wavelengths.
pub const WAVELENGTHS: NumberRow<Look> = NumberRow::new(
    "wavelengths",
    "Wavelengths",
    Unit::Count,
    [1.0, 64.0],
    "The number of bands of wavelengths into which renders split light. With few, a rainbow breaks into steps of \
              colour; hold Z to see three.",
    |look| Some(f64::from(look.wavelengths)),
    |look, count| look.wavelengths = count.round() as u32,
);

/// The strength of the glow.
pub const GLOW: NumberRow<Look> = NumberRow::new(
    "glow",
    "Glow",
    Unit::Ratio,
    [0.0, 1.0],
    "How much of the light of sparkles spreads around them in renders, as in an eye or a lens; 0 for none. A rough \
              picture has none.",
    |look| Some(look.glow),
    |look, part| look.glow = part,
);

/// The greatest number of bounces.
pub const BOUNCES: NumberRow<Look> = NumberRow::new(
    "bounces",
    "Most bounces",
    Unit::Count,
    [1.0, USUAL_BOUNCES as f64],
    "The number of bounces inside the stone after which renders follow light no farther. Raise it from 1 to see \
              what each bounce adds; light that is left is dark.",
    |look| Some(f64::from(look.bounces)),
    |look, count| look.bounces = count.round() as u32,
);

/// The distance of the background.
pub const BACKGROUND_DISTANCE: NumberRow<Look> = NumberRow {
    span: [0.0, 100.0],
    step: 0.1,
    decimals: 1,
    ..NumberRow::new(
        "background_distance_mm",
        "Distance",
        Unit::Millimetres,
        [0.0, 10_000.0],
        "Distance of the background behind the middle of the scene. It is never nearer than the stones reach.",
        |look| look.background_mm,
        |look, mm| look.background_mm = Some(mm),
    )
};

/// The strength of refraction.
pub const STRENGTH: NumberRow<Look> = NumberRow {
    step: 0.005,
    decimals: 3,
    ..NumberRow::new(
        "strength",
        "Strength",
        Unit::Ratio,
        [0.0, 1.0],
        "The strength of refraction. 1 is physics. A smaller number mixes the refracted ray with the straight ray, which \
              designers use for its looks.",
        |look| Some(look.strength),
        |look, part| look.strength = part,
    )
};

/// The numbers of a look, in the order in which scene files state them.
pub const LOOK_NUMBERS: [&NumberRow<Look>; 8] =
    [&LIGHT_TURN, &HEAD, &EXPOSURE, &WAVELENGTHS, &GLOW, &BOUNCES, &BACKGROUND_DISTANCE, &STRENGTH];

impl Look {
    /// Returns the half angle of the observer's head in scopes and figures, in degrees; 0 for no head.
    pub fn head_of_scopes(&self) -> f64 {
        self.head.unwrap_or(0.0)
    }

    /// Returns the distance of a hanging background behind the middle, in girdle radii of `unit_mm`.
    pub fn distance(&self, unit_mm: f64) -> f64 {
        self.background_mm.map_or(USUAL_DISTANCE, |mm| mm / unit_mm)
    }

    /// Returns the background; `None` for none, and for a photograph whose file no longer exists.
    pub fn background_at_hand(&self) -> Option<&BackgroundRef> {
        self.background.as_ref().filter(|background| !background.is_missing())
    }

    /// Returns the file of a background that cannot be shown because it is gone.
    pub fn missing_background(&self) -> Option<&Path> {
        match &self.background {
            Some(missing @ BackgroundRef::Photo(path)) if missing.is_missing() => Some(path),
            _ => None,
        }
    }

    /// Chooses the next world or pattern as the background, in the order of their names; after the last one, none.
    pub fn next_background(&mut self) {
        let now = self.background.as_ref().map(ToString::to_string);
        let place = now.and_then(|now| BackgroundRef::names().position(|name| name == now));
        let next = place.map_or(0, |now| now + 1);
        self.background = BackgroundRef::names().nth(next).map(BackgroundRef::from);
    }

    /// Takes over everything but the smoothing from another look.
    pub fn reset_light(&mut self, first: &Self) {
        *self = Self { smoothing: self.smoothing, ..first.clone() };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_usual_look_lies_within_its_rows_and_each_row_sets_its_own_number() {
        let usual = Look::default();
        for row in LOOK_NUMBERS {
            assert!((row.get)(&usual).is_none_or(|value| row.allows(value)), "{row:?}");
            assert!(row.allows(row.span[0]) && row.allows(row.span[1]), "{row:?}");
            let mut look = usual.clone();
            (row.set)(&mut look, row.range[1]);
            assert_eq!((row.get)(&look), Some(row.range[1]), "{row:?}");
            let others = LOOK_NUMBERS.into_iter().filter(|other| other.key != row.key);
            others.for_each(|other| assert_eq!((other.get)(&look), (other.get)(&usual), "{row:?} {other:?}"));
        }
    }

    #[test]
    fn a_look_is_kept_as_text_and_older_ones_are_completed() {
        let look = Look { glow: 0.7, background: Some("page".into()), head: Some(9.0), ..Look::default() };
        let text = serde_json::to_string(&look).unwrap();
        assert_eq!(serde_json::from_str::<Look>(&text).unwrap(), look);
        assert_eq!(serde_json::from_str::<Look>("{}").unwrap(), Look::default());
        let none = Look { head: Some(0.0), ..Look::default() };
        assert_eq!(serde_json::from_str::<Look>(&serde_json::to_string(&none).unwrap()).unwrap(), none);
    }

    #[test]
    fn backgrounds_come_one_after_the_other_and_around() {
        let mut look = Look { background: Some("/a/photo.png".into()), ..Look::default() };
        assert_eq!(look.missing_background(), Some(Path::new("/a/photo.png")));
        assert_eq!(look.background_at_hand(), None);
        let mut seen = vec![];
        for _ in 0..BackgroundRef::names().count() + 1 {
            look.next_background();
            seen.push(look.background.as_ref().map(ToString::to_string));
        }
        assert_eq!(seen.iter().flatten().count(), BackgroundRef::names().count());
        assert_eq!((seen[0].as_deref(), seen.last()), (Some("sunset"), Some(&None)));
        assert_eq!(look.missing_background(), None);
    }
}
