//! A viewpoint: the direction from which a stone is seen, in degrees, as people write and read it.

use super::{Lean, Projection, Side, View};
use brillianteer_math::rounded;
use glam::DQuat;

/// A [`View`] of a stone that is not turned, with its angles in degrees, as given.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Viewpoint {
    /// The side that faces the eye while nothing is tilted.
    pub side: Side,
    /// The object that the tilt moves.
    pub lean: Lean,
    /// The tilt, degrees, -90 to 90.
    pub tilt_deg: f64,
    /// The azimuth, degrees in the stone's frame, toward which the tilt leans.
    pub azimuth_deg: f64,
    /// Parallel rays or perspective.
    pub projection: Projection,
}

impl Viewpoint {
    /// Returns the same viewpoint from another side, where a picture needs one.
    pub fn facing(self, side: Option<Side>) -> Self {
        Self { side: side.unwrap_or(self.side), ..self }
    }

    /// Returns the view, with angles in radians, in the form that tracers take.
    pub fn view(&self) -> View {
        View {
            side: self.side,
            lean: self.lean,
            tilt: self.tilt_deg.to_radians(),
            azimuth: self.azimuth_deg.rem_euclid(360.0).to_radians(),
            turn: DQuat::IDENTITY,
            projection: self.projection,
        }
    }

    /// Returns the suffix, such as `-tilt-15-azimuth-22.5`, that distinguishes the files of this view from those of the
    /// plain one. It is empty for the plain view, face up by parallel rays.
    pub fn suffix(&self) -> String {
        let mut suffix = String::new();
        let mut add = |what: &str, number: f64| suffix += &format!("-{what}-{}", in_a_name(number));
        if self.tilt_deg != 0.0 {
            add(if self.lean == Lean::Stone { "tilt" } else { "eye-tilt" }, self.tilt_deg);
        }
        if self.tilt_deg != 0.0 && self.azimuth_deg != 0.0 {
            add("azimuth", self.azimuth_deg);
        }
        if let Projection::Perspective { distance } = self.projection {
            add("perspective", distance);
        }
        if self.side == Side::Culet { format!("-culet{suffix}") } else { suffix }
    }

    /// Returns a description in words, which goes into pictures.
    pub fn description(&self) -> String {
        let (side, tilt, azimuth) = (self.side.name(), self.tilt_deg, self.azimuth_deg);
        let tilt = match self.lean {
            _ if tilt == 0.0 => String::new(),
            Lean::Stone => format!(", tilted {} degrees toward {}", in_a_name(tilt), in_a_name(azimuth)),
            Lean::Eye => format!(", eye moved {} degrees toward {}", in_a_name(tilt), in_a_name(azimuth)),
        };
        let near = match self.projection {
            Projection::Orthographic => String::new(),
            Projection::Perspective { distance } => {
                format!(", from {} girdle radii", (distance * 1e3).round() / 1e3)
            }
        };
        format!("{side} side{tilt}{near}")
    }
}

/// Returns a number as names of files have it: with three decimals where it has no more, as people write numbers, and else
/// with two.
fn in_a_name(number: f64) -> String {
    let written = rounded(number, 3);
    let is_whole = written.parse().is_ok_and(|short: f64| (short - number).abs() < 1e-6);
    if is_whole { written } else { rounded(number, 2) }
}

impl From<View> for Viewpoint {
    fn from(view: View) -> Self {
        Self {
            side: view.side,
            lean: view.lean,
            tilt_deg: view.tilt.to_degrees(),
            azimuth_deg: view.azimuth.to_degrees(),
            projection: view.projection,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_viewpoint_is_its_view_in_degrees() {
        let projection = Projection::Perspective { distance: 8.5 };
        let given =
            Viewpoint { side: Side::Culet, lean: Lean::Eye, tilt_deg: -20.0, azimuth_deg: -45.0, projection };
        let view = given.view();
        assert!((view.tilt + 20_f64.to_radians()).abs() < 1e-15);
        assert!((view.azimuth - 315_f64.to_radians()).abs() < 1e-15);
        let back = Viewpoint::from(view);
        assert!((back.tilt_deg + 20.0).abs() < 1e-12 && (back.azimuth_deg - 315.0).abs() < 1e-12);
        assert_eq!(Viewpoint { tilt_deg: -20.0, azimuth_deg: -45.0, ..back }, given);
        assert_eq!(given.facing(Some(Side::Table)).view(), View { side: Side::Table, ..view });
        assert_eq!(given.facing(None), given);
    }

    #[test]
    fn names_of_files_say_what_differs_from_face_up() {
        let up = Viewpoint::default();
        let tilted = Viewpoint { tilt_deg: 7.5, azimuth_deg: -10.0, ..up };
        let eye = Viewpoint { lean: Lean::Eye, tilt_deg: -4.0, ..up };
        let far = Viewpoint { projection: Projection::Perspective { distance: 8.0 }, ..up };
        let names = [
            (up, ""),
            (Viewpoint { azimuth_deg: 30.0, ..up }, ""),
            (tilted, "-tilt-7.5-azimuth--10"),
            (eye, "-eye-tilt--4"),
            (far, "-perspective-8"),
            (Viewpoint { tilt_deg: 61.106_482_3, azimuth_deg: 0.125, ..up }, "-tilt-61.11-azimuth-0.125"),
            (Viewpoint { tilt_deg: 15.0 + 1e-9, ..up }, "-tilt-15"),
            (tilted.facing(Some(Side::Culet)), "-culet-tilt-7.5-azimuth--10"),
        ];
        names.iter().for_each(|(viewpoint, suffix)| assert_eq!(viewpoint.suffix(), *suffix));
    }

    #[test]
    fn words_say_what_differs_from_face_up() {
        let up = Viewpoint::default();
        let far = Projection::Perspective { distance: 8.0 };
        let tilted = Viewpoint { tilt_deg: 7.5, azimuth_deg: -10.0, ..up };
        let words = [
            (up, "table side"),
            (Viewpoint { azimuth_deg: 30.0, ..up }, "table side"),
            (tilted, "table side, tilted 7.5 degrees toward -10"),
            (
                Viewpoint { lean: Lean::Eye, projection: far, ..tilted }.facing(Some(Side::Culet)),
                "culet side, eye moved 7.5 degrees toward -10, from 8 girdle radii",
            ),
        ];
        words.iter().for_each(|(viewpoint, told)| assert_eq!(viewpoint.description(), *told));
    }
}
