//! Structured light: which colour shines on the stone from which elevation.
//!
//! ASET, Ideal-Scope and the hearts and arrows viewers are all this: rings of colour around an axis, a backing
//! behind the stone. Borders from `docs/optics.md`; every one of them, and every colour, is a parameter.

use crate::optics::{LinearRgb, linear_from_encoded};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// A ring of light between one elevation and the next band's.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Band {
    /// What reports call it: green, red, blue, head.
    pub name: String,
    /// The elevation at which it begins, degrees above the plane square to the scope's axis, -90 to 90.
    pub from: f64,
    /// Encoded sRGB, 0 to 255.
    pub colour: [u8; 3],
}

/// A scope: bands from the nadir up to the zenith.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scope {
    /// Short name, as `--views` takes it and as files are called.
    pub name: String,
    /// Bands in rising order, the first from -90: light that leaks out below meets that one.
    #[serde(rename = "band")]
    pub bands: Vec<Band>,
}

/// The most bands that a scope may have.
pub const MOST_BANDS: usize = 64;

/// Why a scope makes no sense.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ScopeError {
    /// The first band must take all the light from below.
    #[error(
        "scope '{scope}': the first band must begin at -90, where leaked light goes; it begins at {from}"
    )]
    NotFromNadir {
        /// The scope.
        scope: String,
        /// Where its first band begins.
        from: f64,
    },
    /// Two bands bear one name.
    #[error("scope '{scope}': two bands are called '{band}'; figures could not tell them apart")]
    Twice {
        /// The scope.
        scope: String,
        /// The name.
        band: String,
    },
    /// More bands than an eye can tell apart.
    #[error("scope '{scope}': {count} bands are more than the {MOST_BANDS} that are taken; join some")]
    TooMany {
        /// The scope.
        scope: String,
        /// How many there are.
        count: usize,
    },
    /// Bands must rise.
    #[error("scope '{scope}': band '{band}' begins at {from}, not between {after} and 90; list bands upward")]
    OutOfOrder {
        /// The scope.
        scope: String,
        /// The band at fault.
        band: String,
        /// Where it begins, degrees.
        from: f64,
        /// Where the band before it begins, degrees.
        after: f64,
    },
}

/// What leaked light and the surroundings of the stone show.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Backing {
    /// No light from behind: leakage looks dark.
    #[default]
    Black,
    /// Lit from behind: leakage looks white.
    White,
}

/// Whether what a scope shows holds glare, the light that the stone's outer surface reflects.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Glare {
    /// Light that has been inside the stone alone: the zones have the colours that graders are taught.
    #[default]
    LeftOut,
    /// All light, as a camera in the scope records it: the crown's glare tints what is behind it.
    Included,
}

impl Glare {
    /// Whether light is shown that has been at the outer surface alone (`is_glare`), or inside.
    pub fn shows(self, is_glare: bool) -> bool {
        !is_glare || self == Self::Included
    }

    /// In words.
    pub fn description(self) -> &'static str {
        match self {
            Self::LeftOut => "glare left out",
            Self::Included => "glare included",
        }
    }
}

const BLACK: [u8; 3] = [0, 0, 0];
const WHITE: [u8; 3] = [255, 255, 255];
const GREEN: [u8; 3] = [0, 255, 0];
const RED: [u8; 3] = [255, 0, 0];
const BLUE: [u8; 3] = [0, 0, 255];

impl Scope {
    /// A scope from (name, lowest elevation in degrees, colour), the band below the horizon first.
    fn new(name: &str, below: [u8; 3], bands: &[(&str, f64, [u8; 3])]) -> Self {
        let all = [("below", -90.0, below)].into_iter().chain(bands.iter().copied());
        let band = |(name, from, colour): (&str, f64, [u8; 3])| Band { name: name.into(), from, colour };
        Self { name: name.into(), bands: all.map(band).collect() }
    }

    /// Angular spectrum evaluation: green to 45 degrees, red to 75, blue above (30 degree cone); or with the
    /// blue border at 90 less half of `cone` degrees, the full angle: 40 for ASET 40.
    pub fn aset(cone: f64, backing: Backing) -> Self {
        let suffix = if backing == Backing::White { "-white" } else { "" };
        let size = if cone == ASET_CONE { String::new() } else { format!("-{cone}") };
        let below = if backing == Backing::White { WHITE } else { BLACK };
        // The cone is named by its full angle.
        let blue = 90.0 - cone / 2.0;
        Self::new(
            &format!("aset{size}{suffix}"),
            below,
            &[("green", 0.0, GREEN), ("red", 45.0, RED), ("blue", blue, BLUE)],
        )
    }

    /// Ideal-Scope: a red reflector with a black hole of this half angle (degrees) for the eye, and a white light behind the
    /// stone, which ends some way below the horizon: between it and the reflector nothing shines.
    pub fn ideal_scope(hole: f64) -> Self {
        let bands =
            [("side", BACKLIGHT_END, BLACK), ("red", 0.0, [228, 0, 43]), ("black", 90.0 - hole, BLACK)];
        Self::new("ideal-scope", WHITE, &bands)
    }

    /// The viewer for arrows (face up) and hearts (face down): the camera's dark cone, a coloured ring around it,
    /// white beyond. Half angles from the axis in degrees.
    pub fn hearts_and_arrows(name: &str, camera: f64, ring: f64, colour: [u8; 3]) -> Self {
        let bands = [("white", 0.0, WHITE), ("ring", 90.0 - ring, colour), ("camera", 90.0 - camera, BLACK)];
        Self::new(name, WHITE, &bands)
    }

    /// This scope with a head of this half angle (degrees) in front of its middle, from which no light comes.
    pub fn with_head(mut self, half_angle: f64) -> Self {
        if half_angle > 0.0 {
            let from = 90.0 - half_angle;
            self.bands.retain(|b| b.from < from);
            self.bands.push(Band { name: "head".into(), from, colour: BLACK });
        }
        self
    }

    /// This scope with a border at the horizon, for figures of the light from above. Where that splits a band in two, the
    /// place of the lower part is told; the upper one comes after it.
    pub fn with_horizon(mut self) -> (Self, Option<usize>) {
        let Some(k) = self.bands.iter().rposition(|b| b.from <= 0.0).filter(|&k| self.bands[k].from < 0.0)
        else {
            return (self, None);
        };
        let upper = Band { from: 0.0, ..self.bands[k].clone() };
        self.bands.insert(k + 1, upper);
        (self, Some(k))
    }

    /// The places of the bands from the horizon up that send light: black ones send none.
    pub fn shining(&self) -> impl Iterator<Item = usize> + '_ {
        let bands = self.bands.iter().enumerate();
        bands.filter(|(_, b)| b.from >= 0.0 && b.colour != BLACK).map(|(k, _)| k)
    }

    /// A band's elevations, the lowest and the highest, degrees.
    ///
    /// # Panics
    /// Where there is no such band.
    pub fn elevations(&self, band: usize) -> [f64; 2] {
        [self.bands[band].from, self.bands.get(band + 1).map_or(90.0, |next| next.from)]
    }

    /// Whether its bands begin at the nadir and rise.
    ///
    /// # Errors
    /// Names the band that does not.
    pub fn validate(&self) -> Result<(), ScopeError> {
        let scope = || self.name.clone();
        let from = self.bands.first().map_or(f64::NAN, |b| b.from);
        if from != -90.0 {
            return Err(ScopeError::NotFromNadir { scope: scope(), from });
        }
        let twice = |(i, b): &(usize, &Band)| self.bands[..*i].iter().any(|a| a.name == b.name);
        if let Some((_, band)) = self.bands.iter().enumerate().find(twice) {
            return Err(ScopeError::Twice { scope: scope(), band: band.name.clone() });
        }
        if self.bands.len() > MOST_BANDS {
            return Err(ScopeError::TooMany { scope: scope(), count: self.bands.len() });
        }
        match self.bands.windows(2).find(|w| !(w[1].from > w[0].from && w[1].from < 90.0)) {
            None => Ok(()),
            Some(w) => Err(ScopeError::OutOfOrder {
                scope: scope(),
                band: w[1].name.clone(),
                from: w[1].from,
                after: w[0].from,
            }),
        }
    }

    /// The band that the unit vector `direction` points at, for a scope around the unit vector `zenith`.
    #[inline]
    pub fn band(&self, direction: DVec3, zenith: DVec3) -> usize {
        let elevation = elevation_deg(direction, zenith);
        self.bands.iter().rposition(|b| elevation >= b.from).unwrap_or(0)
    }

    /// The colours of its bands, linear.
    pub fn colours(&self) -> Vec<LinearRgb> {
        let linear = |c: u8| linear_from_encoded(f64::from(c) / 255.0);
        self.bands.iter().map(|b| LinearRgb::from_array(b.colour.map(linear))).collect()
    }
}

/// How high the unit vector `direction` stands, for the unit vector `zenith`: -90 to 90 degrees.
#[inline]
pub fn elevation_deg(direction: DVec3, zenith: DVec3) -> f64 {
    // atan2 keeps its digits near the zenith, where asin would lose half of them.
    direction.dot(zenith).atan2(direction.cross(zenith).length()).to_degrees()
}

/// The elevation up to which Ideal-Scope's light behind the stone reaches, degrees: above what ideal cuts leak (40 degrees
/// below the horizon and lower), below the 21 degrees from which an eighth of the light of their arrows' shafts comes, which
/// graders see dark (docs/optics.md, "Ideal-Scope's hole").
const BACKLIGHT_END: f64 = -30.0;

/// Full angle in degrees of the observer's cone, blue, of the common ASET.
pub const ASET_CONE: f64 = 30.0;

#[cfg(test)]
mod tests {
    use super::*;

    fn at(elevation: f64) -> DVec3 {
        let (sin, cos) = elevation.to_radians().sin_cos();
        DVec3::new(0.6 * cos, 0.8 * cos, sin)
    }

    #[test]
    fn aset_borders_stand_at_0_45_and_75_degrees() {
        let scope = Scope::aset(ASET_CONE, Backing::Black);
        let name = |e: f64| scope.bands[scope.band(at(e), DVec3::Z)].name.as_str();
        let seen = [-90.0, -0.01, 0.01, 44.99, 45.01, 74.99, 75.01, 90.0].map(name);
        assert_eq!(seen, ["below", "below", "green", "green", "red", "red", "blue", "blue"]);
        let wide = Scope::aset(40.0, Backing::White);
        assert_eq!(wide.name, "aset-40-white");
        assert_eq!(wide.bands[wide.band(at(71.0), DVec3::Z)].name, "blue");
    }

    #[test]
    fn a_head_covers_what_is_behind_it() {
        let scope = Scope::aset(ASET_CONE, Backing::Black).with_head(20.0);
        let names: Vec<&str> = scope.bands.iter().map(|b| b.name.as_str()).collect();
        assert_eq!(names, ["below", "green", "red", "head"]);
        assert_eq!(scope.validate(), Ok(()));
    }

    #[test]
    fn a_horizon_splits_the_band_that_lies_on_it_and_black_bands_do_not_shine() {
        let aset = Scope::aset(ASET_CONE, Backing::Black).with_head(20.0);
        assert_eq!(aset.clone().with_horizon(), (aset.clone(), None));
        assert_eq!(aset.shining().collect::<Vec<_>>(), [1, 2]);
        assert_eq!(Scope::ideal_scope(15.0).shining().collect::<Vec<_>>(), [2]);
        let wide = Scope::new("wide", WHITE, &[("red", -20.0, RED), ("blue", 60.0, BLUE)]);
        let (split, lower) = wide.clone().with_horizon();
        assert_eq!((lower, split.bands.len(), split.elevations(2)), (Some(1), 4, [0.0, 60.0]));
        assert_eq!(split.shining().collect::<Vec<_>>(), [2, 3]);
        assert_eq!(wide.elevations(2), [60.0, 90.0]);
    }

    #[test]
    fn bands_out_of_order_are_named() {
        let mut scope = Scope::ideal_scope(12.0);
        scope.bands.swap(2, 3);
        assert!(matches!(scope.validate(), Err(ScopeError::OutOfOrder { band, .. }) if band == "red"));
        scope.bands.swap(2, 3);
        scope.bands[3].name = "red".into();
        assert!(matches!(scope.validate(), Err(ScopeError::Twice { band, .. }) if band == "red"));
        scope.bands[0].from = 0.0;
        assert!(scope.validate().is_err());
        scope.bands.clear();
        assert!(scope.validate().is_err());
    }
}
