//! Structured light: the colours that shine on the stone from each elevation.
//!
//! ASET, Ideal-Scope and the hearts and arrows viewers are all of this kind: rings of colour around an axis, and a backing
//! behind the stone. Borders are from `docs/optics.md`; every border and every colour is a parameter.

use brillianteer_optics::{LinearRgb, linear_from_encoded};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// A ring of light from one elevation up to that of the next band.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Band {
    /// The band's name in reports: green, red, blue, head.
    pub name: String,
    /// The elevation where the band begins, degrees above the plane square to the scope's axis, -90 to 90.
    pub from: f64,
    /// The band's colour, encoded sRGB, 0 to 255.
    pub colour: [u8; 3],
}

/// A scope: bands of colour from the nadir up to the zenith.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scope {
    /// A short name, which `--views` takes and which files have in their names.
    pub name: String,
    /// The bands in rising order. The first begins at -90: light that leaks out below meets it.
    #[serde(rename = "band")]
    pub bands: Vec<Band>,
}

/// The most bands that a scope may have.
pub const MOST_BANDS: usize = 64;

/// The reason why a scope is not valid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ScopeError {
    /// The first band does not begin at -90 degrees, so that no band takes the light from below.
    #[error(
        "scope '{scope}': the first band must begin at -90, where leaked light goes; it begins at {from}"
    )]
    NotFromNadir {
        /// The scope's name.
        scope: String,
        /// The elevation where the first band begins, degrees.
        from: f64,
    },
    /// Two bands have the same name.
    #[error("scope '{scope}': two bands are called '{band}'; figures could not tell them apart")]
    Twice {
        /// The scope's name.
        scope: String,
        /// The name of both bands.
        band: String,
    },
    /// More bands than [`MOST_BANDS`].
    #[error(
        "scope '{scope}': {count} bands are more than {MOST_BANDS}, the most that a scope can have; join some"
    )]
    TooMany {
        /// The scope's name.
        scope: String,
        /// The number of bands.
        count: usize,
    },
    /// A band does not begin above the one before it, or not below 90 degrees.
    #[error("scope '{scope}': band '{band}' begins at {from}, not between {after} and 90; list bands upward")]
    OutOfOrder {
        /// The scope's name.
        scope: String,
        /// The name of the band at fault.
        band: String,
        /// The elevation where it begins, degrees.
        from: f64,
        /// The elevation where the band before it begins, degrees.
        after: f64,
    },
}

/// The light behind the stone, which colours leaked light and the surroundings of the stone.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Backing {
    /// No light from behind: leakage is dark.
    #[default]
    Black,
    /// Lit from behind: leakage is white.
    White,
}

/// The choice whether a scope's picture holds glare, the light that the stone's outer surface reflects.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Glare {
    /// Only light that has been inside the stone: the zones have the colours that graders learn.
    #[default]
    LeftOut,
    /// All light, as a camera in the scope records it: the crown's glare tints the colours behind it.
    Included,
}

impl Glare {
    /// Returns whether light is included; `is_glare` says that the outer surface reflected it and it has not been
    /// inside.
    pub fn shows(self, is_glare: bool) -> bool {
        !is_glare || self == Self::Included
    }

    /// Returns a description in words.
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
    /// Makes a scope from a colour below the horizon, and the bands above it as (name, lowest elevation in degrees, colour).
    fn new(name: &str, below: [u8; 3], bands: &[(&str, f64, [u8; 3])]) -> Self {
        let all = [("below", -90.0, below)].into_iter().chain(bands.iter().copied());
        let band = |(name, from, colour): (&str, f64, [u8; 3])| Band { name: name.into(), from, colour };
        Self { name: name.into(), bands: all.map(band).collect() }
    }

    /// ASET, the angular spectrum evaluation tool: green up to 45 degrees, red up to 75, blue above (a cone of 30 degrees).
    ///
    /// `cone` is the full angle of the blue cone in degrees, whose border lies at 90 less half of it: 40 for ASET 40.
    pub fn aset(cone: f64, backing: Backing) -> Self {
        let suffix = if backing == Backing::White { "-white" } else { "" };
        let size = if cone == ASET_CONE { String::new() } else { format!("-{cone}") };
        let below = if backing == Backing::White { WHITE } else { BLACK };
        // `cone` is a full angle.
        let blue = 90.0 - cone / 2.0;
        Self::new(
            &format!("aset{size}{suffix}"),
            below,
            &[("green", 0.0, GREEN), ("red", 45.0, RED), ("blue", blue, BLUE)],
        )
    }

    /// Ideal-Scope: a red reflector with a black hole for the eye, and a white light behind the stone.
    ///
    /// `hole` is the half angle of the hole in degrees. The white light ends some way below the horizon; between it and the
    /// reflector nothing shines.
    pub fn ideal_scope(hole: f64) -> Self {
        let bands =
            [("side", BACKLIGHT_END, BLACK), ("red", 0.0, [228, 0, 43]), ("black", 90.0 - hole, BLACK)];
        Self::new("ideal-scope", WHITE, &bands)
    }

    /// The viewer for arrows (face up) and hearts (face down): the camera's dark cone, a coloured ring around it, and white
    /// beyond. `camera` and `ring` are half angles from the axis in degrees.
    pub fn hearts_and_arrows(name: &str, camera: f64, ring: f64, colour: [u8; 3]) -> Self {
        let bands = [("white", 0.0, WHITE), ("ring", 90.0 - ring, colour), ("camera", 90.0 - camera, BLACK)];
        Self::new(name, WHITE, &bands)
    }

    /// Returns this scope with a head of this half angle (degrees) in its middle, from which no light comes.
    pub fn with_head(mut self, half_angle: f64) -> Self {
        if half_angle > 0.0 {
            let from = 90.0 - half_angle;
            self.bands.retain(|b| b.from < from);
            self.bands.push(Band { name: "head".into(), from, colour: BLACK });
        }
        self
    }

    /// Returns this scope with a border at the horizon, for figures of the light from above.
    ///
    /// Where the border splits a band in two, the place of the lower part is returned too; the upper part comes after it.
    pub fn with_horizon(mut self) -> (Self, Option<usize>) {
        let Some(k) = self.bands.iter().rposition(|b| b.from <= 0.0).filter(|&k| self.bands[k].from < 0.0)
        else {
            return (self, None);
        };
        let upper = Band { from: 0.0, ..self.bands[k].clone() };
        self.bands.insert(k + 1, upper);
        (self, Some(k))
    }

    /// Returns the places of the bands from the horizon up that send light; black bands send none.
    pub fn shining(&self) -> impl Iterator<Item = usize> + Clone + '_ {
        let bands = self.bands.iter().enumerate();
        bands.filter(|(_, b)| b.from >= 0.0 && b.colour != BLACK).map(|(k, _)| k)
    }

    /// Returns a band's lowest and highest elevation, degrees.
    ///
    /// # Panics
    /// Panics where there is no such band.
    pub fn elevations(&self, band: usize) -> [f64; 2] {
        [self.bands[band].from, self.bands.get(band + 1).map_or(90.0, |next| next.from)]
    }

    /// Checks that the bands begin at the nadir and rise, that their names differ, and that there are at most
    /// [`MOST_BANDS`].
    ///
    /// # Errors
    /// The error names the first of these conditions that does not hold, and the band at fault.
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

    /// Returns the place of the band that the unit vector `direction` points at, for a scope around the unit vector
    /// `zenith`.
    #[inline]
    pub fn band(&self, direction: DVec3, zenith: DVec3) -> usize {
        let elevation = elevation_deg(direction, zenith);
        self.bands.iter().rposition(|b| elevation >= b.from).unwrap_or(0)
    }

    /// Returns the colours of the bands, in linear light.
    pub fn colours(&self) -> Vec<LinearRgb> {
        let linear = |c: u8| linear_from_encoded(f64::from(c) / 255.0);
        self.bands.iter().map(|b| LinearRgb::from_array(b.colour.map(linear))).collect()
    }
}

/// Returns the elevation of the unit vector `direction` for the unit vector `zenith`, -90 to 90 degrees.
#[inline]
pub fn elevation_deg(direction: DVec3, zenith: DVec3) -> f64 {
    // atan2 keeps its digits near the zenith, where asin would lose half of them.
    direction.dot(zenith).atan2(direction.cross(zenith).length()).to_degrees()
}

/// The elevation, degrees, up to which Ideal-Scope's light behind the stone reaches.
///
/// It lies above the light that ideal cuts leak (40 degrees below the horizon and lower), and below the 21 degrees
/// from which an eighth of the light of their arrows' shafts comes, which graders see dark (docs/optics.md,
/// "Ideal-Scope's hole").
const BACKLIGHT_END: f64 = -30.0;

/// Half angles, degrees, of the camera's and the ring's cones in a hearts and arrows viewer. No standard fixes them;
/// these are those of one implementation, and show the patterns well.
pub const VIEWER_CONES_DEG: (f64, f64) = (5.3, 16.3);

/// The full angle, degrees, of the observer's blue cone in the common ASET.
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
