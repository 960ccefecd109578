//! How bodies move in time: copies tumble, and plates wave.

use brillianteer_cut::{Cut, Glass};
use serde::{Deserialize, Serialize};

/// How fast a wave runs, radians a second.
const WAVING: f64 = 2.0;

/// How plates of glass with a wave move. All other bodies tumble.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Movement {
    /// Plates tumble as other bodies do, and their waves run.
    #[default]
    Both,
    /// Plates tumble, and their waves stand still.
    Tumble,
    /// The waves run, and the plates stay in their pose.
    Wave,
}

impl Movement {
    /// All movements, each with its name in files and on the command line.
    pub const NAMES: [(&str, Self); 3] =
        [("both", Self::Both), ("tumble", Self::Tumble), ("wave", Self::Wave)];

    /// Returns the movement's name.
    pub fn name(self) -> &'static str {
        Self::NAMES.into_iter().find(|(_, movement)| *movement == self).map_or("both", |(name, _)| name)
    }

    /// Returns the movement of this name; `None` where there is none.
    pub fn named(name: &str) -> Option<Self> {
        Self::NAMES.into_iter().find(|(known, _)| *known == name).map(|(_, movement)| movement)
    }

    /// Whether a body of this cut tumbles.
    pub fn tumbles(self, cut: &Cut) -> bool {
        self != Self::Wave || !has_wave(cut)
    }

    /// Whether a body of this cut waves.
    pub fn waves(self, cut: &Cut) -> bool {
        self != Self::Tumble && has_wave(cut)
    }

    /// Returns a cut as its wave is some seconds after rest; `None` where it does not wave.
    pub fn waved(self, cut: &Cut, seconds: f64) -> Option<Cut> {
        match cut {
            Cut::Glass(Glass::Plate(plate)) if self.waves(cut) => {
                let mut plate = *plate;
                plate.phase = (plate.phase + (WAVING * seconds).to_degrees()).rem_euclid(360.0);
                Some(Cut::Glass(Glass::Plate(plate)))
            }
            _ => None,
        }
    }
}

impl From<Movement> for String {
    fn from(movement: Movement) -> Self {
        movement.name().to_owned()
    }
}

/// A name that no movement has.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the movement '{name}' is unknown; give one of {known}", known = Movement::NAMES.map(|(name, _)| name).join(", "))]
pub struct UnknownMovement {
    /// The name.
    pub name: String,
}

impl TryFrom<String> for Movement {
    type Error = UnknownMovement;

    fn try_from(name: String) -> Result<Self, UnknownMovement> {
        Self::named(&name).ok_or(UnknownMovement { name })
    }
}

/// Whether a cut is a plate with a wave.
pub fn has_wave(cut: &Cut) -> bool {
    matches!(cut, Cut::Glass(Glass::Plate(plate)) if plate.amplitude > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_cut::Family;

    #[test]
    fn each_movement_has_one_name_in_files() {
        for (name, movement) in Movement::NAMES {
            assert_eq!(serde_json::to_value(movement).unwrap(), name);
            assert_eq!(serde_json::from_value::<Movement>(name.into()).unwrap(), movement);
        }
        let unknown = serde_json::from_value::<Movement>("waves".into()).unwrap_err().to_string();
        assert!(unknown.contains("'waves'") && unknown.contains("both, tumble, wave"), "{unknown}");
    }

    #[test]
    fn plates_move_as_they_are_told_to_and_all_else_tumbles() {
        let [plate, cube] = ["plate", "cube"].map(|key| Family::of_key(key).unwrap().first.clone());
        let moves = |cut: &Cut| Movement::NAMES.map(|(_, m)| (m.tumbles(cut), m.waves(cut)));
        assert_eq!(moves(&plate), [(true, true), (true, false), (false, true)]);
        assert_eq!(moves(&cube), [(true, false); 3]);
        let phase = |cut: &Cut| match cut {
            Cut::Glass(Glass::Plate(plate)) => plate.phase,
            _ => f64::NAN,
        };
        let later = Movement::Wave.waved(&plate, 0.7).unwrap();
        let turned = (phase(&later) - phase(&plate)).rem_euclid(360.0);
        assert!((turned - 1.4_f64.to_degrees()).abs() < 1e-9, "{turned}");
        assert!(Movement::Tumble.waved(&plate, 0.7).is_none() && Movement::Both.waved(&cube, 0.7).is_none());
    }
}
