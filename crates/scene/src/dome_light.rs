//! Domes of light, under which the light of a cut is weighed.

use super::scope::elevation_deg;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// A dome of light over the scope's axis, with an observer's head in its middle.
///
/// At the angle θ from the zenith its radiance is cosᵖ θ, with p = `power`. It is 0 below the horizon, and within `head_deg` of
/// the zenith. With p = 0 it is even, which cutters' programs call ISO; with p = 1 it is their COS.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DomeLight {
    /// The power of the cosine, 0 to [`MOST_POWER`](Self::MOST_POWER).
    pub power: f64,
    /// The half angle of the head's shadow, degrees, 0 to 90; 0 for none.
    pub head_deg: f64,
}

/// The reason why a text is no dome.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "'{0}' is no dome: give even, cos, cos2 or cos with another power from 0 to 20, and if you like a head's half angle in \
     degrees from 0 to 90, as in cos2@15"
)]
pub struct NoDome(pub String);

impl DomeLight {
    /// The greatest power.
    pub const MOST_POWER: f64 = 20.0;

    /// Makes a dome of this power without a head.
    pub const fn of(power: f64) -> Self {
        Self { power, head_deg: 0.0 }
    }

    /// Returns the radiance in the direction of a unit vector, 0 to 1, of the dome over the unit vector `zenith`.
    #[inline]
    pub fn radiance(&self, direction: DVec3, zenith: DVec3) -> f64 {
        let elevation = elevation_deg(direction, zenith);
        if elevation < 0.0 || self.head_deg > 0.0 && elevation >= 90.0 - self.head_deg {
            return 0.0;
        }
        self.of_cosine(direction.dot(zenith))
    }

    /// Returns the gradient of the [`radiance`](Self::radiance) by the direction, between the borders of head and
    /// horizon.
    pub fn slope(&self, direction: DVec3, zenith: DVec3) -> DVec3 {
        let (cos, radiance) = (direction.dot(zenith), self.radiance(direction, zenith));
        // At the horizon a power below 1 has no finite slope.
        if self.power == 0.0 || radiance == 0.0 || cos <= 0.0 {
            return DVec3::ZERO;
        }
        zenith * (self.power * radiance / cos)
    }

    /// Returns the greatest radiance of the dome: that beside the head.
    pub fn brightest(&self) -> f64 {
        if self.head_deg >= 90.0 { 0.0 } else { self.of_cosine(self.head_deg.to_radians().cos()) }
    }

    /// Returns whether both numbers are in their ranges.
    pub fn is_valid(&self) -> bool {
        (0.0..=Self::MOST_POWER).contains(&self.power) && (0.0..=90.0).contains(&self.head_deg)
    }

    fn of_cosine(&self, cos: f64) -> f64 {
        // Rounding may put a direction along the horizon below 0. Powers of 0 and 1 are computed so that they keep
        // every digit.
        match self.power {
            0.0 => 1.0,
            1.0 => cos.max(0.0),
            power => cos.max(0.0).powf(power),
        }
    }
}

impl fmt::Display for DomeLight {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.power {
            0.0 => f.write_str("even")?,
            1.0 => f.write_str("cos")?,
            power => write!(f, "cos{power}")?,
        }
        if self.head_deg > 0.0 { write!(f, "@{}", self.head_deg) } else { Ok(()) }
    }
}

impl FromStr for DomeLight {
    type Err = NoDome;

    fn from_str(text: &str) -> Result<Self, NoDome> {
        let fault = || NoDome(text.to_owned());
        let (name, head) = text.split_once('@').unwrap_or((text, "0"));
        let power = match name {
            "even" => 0.0,
            "cos" => 1.0,
            _ => name.strip_prefix("cos").and_then(|power| power.parse().ok()).ok_or_else(fault)?,
        };
        let dome = Self { power, head_deg: head.parse().map_err(|_| fault())? };
        if dome.is_valid() { Ok(dome) } else { Err(fault()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dome_is_read_as_it_is_written() {
        for text in ["even", "cos", "cos2", "cos0.5", "even@10", "cos2@16.26", "even@90"] {
            assert_eq!(text.parse::<DomeLight>().unwrap().to_string(), text);
        }
        for text in ["", "iso", "cos-1", "cosNaN", "cos21", "even@", "even@91", "cos@-1", "even@NaN", "@"] {
            assert!(text.parse::<DomeLight>().is_err(), "{text}");
        }
    }

    #[test]
    fn radiance_is_a_power_of_the_cosine_outside_the_head_and_above_the_horizon() {
        let at = |deg: f64| DVec3::new(deg.to_radians().sin(), 0.0, deg.to_radians().cos());
        for (text, deg, radiance) in [
            ("even", 89.0, 1.0),
            ("even", 91.0, 0.0),
            ("cos", 60.0, 0.5),
            ("cos2", 60.0, 0.25),
            ("cos2@20", 19.0, 0.0),
            ("cos2@60", 60.0001, 0.25),
            ("even@90", 45.0, 0.0),
        ] {
            let dome: DomeLight = text.parse().unwrap();
            assert!((dome.radiance(at(deg), DVec3::Z) - radiance).abs() < 1e-5, "{text} at {deg}");
            assert!(dome.radiance(at(deg), DVec3::Z) <= dome.brightest());
        }
        assert_eq!("even@90".parse::<DomeLight>().unwrap().brightest(), 0.0);
        assert!(("cos2@60".parse::<DomeLight>().unwrap().brightest() - 0.25).abs() < 1e-15);
    }
}
