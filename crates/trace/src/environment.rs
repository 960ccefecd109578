//! The environment of a picture, prepared for look-ups: broad light as an octahedral map with coarser levels, lamps
//! as discs, the observer's head, and a backplate.
//!
//! A ray represents a band of wavelengths, over which its direction fans out. Look-ups are averaged over that fan, so
//! that a small lamp shows as the piece of a rainbow that it is and not as a chance hit. The average is exact for
//! lamps, and uses the map's levels (L. Williams, *Pyramidal parametrics*, 1983) for all other light. The map's
//! projection is that of Z. H. Cigolle et al., *A Survey of Efficient Representations for Independent Unit Vectors*,
//! JCGT 3(2), 2014. The twin of this module is shaders/environment.wgsl.

mod backplate;
mod drawing;

use super::DispersedRay;
pub(crate) use backplate::{ALONG, Photographed};
pub use backplate::{Backplate, backplate_point};
use brillianteer_base::{Stopped, Watch, unwatched};
use brillianteer_math::Basis;
use brillianteer_scene::{Light, LightError, Panorama, World, toward};
pub use drawing::{BroadLight, channels};
use glam::{DVec2, DVec3, DVec4, IVec2, Vec2Swizzles as _, Vec4Swizzles as _};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_1_PI, PI};
use std::ops::Range;

/// The side in radians, √(4π), of the only texel of a map with side 1, as if it were a square: it covers the whole
/// sphere.
pub const TEXEL_ANGLE: f64 = 3.544_907_701_811_032;

/// Side of the map, in texels, for light without a panorama.
const SIDE: usize = 512;

/// Side of the map, in texels, for light with a panorama or a world.
const SIDE_OF_PICTURE: usize = 1024;

/// Side of the coarse map, in texels, of a light with a world. Drawing it takes some hundredths of a second.
const COARSE_SIDE: usize = 128;

/// The rows of a map that are drawn before other work of the thread pool has its turn.
const PART_ROWS: usize = 32;

/// The least and the greatest number of samples along each side of a texel. Between them, there is one sample for
/// each pixel of the panorama.
const PER_SIDE: (usize, usize) = (2, 8);

/// The greatest radiance that the map holds, so that sums of it are finite in f32.
const BRIGHTEST: f64 = 1e12;

/// Radiance in four channels: of the key illuminant's spectrum, of red, of green and of blue.
pub type Radiance = [f32; 4];

/// A lamp: a small disc that shines evenly.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Disc {
    /// The unit direction to the middle of the disc.
    pub toward: DVec3,
    /// The square of the chord from the middle of the disc to its edge.
    pub chord_squared: f64,
    /// The radiance of the disc by channel.
    pub radiance: DVec4,
}

/// A light, prepared for look-ups in its own frame, whose z axis is the light's axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EnvironmentMap {
    /// Square maps of the broad light, row by row, the finest first; each has half the side of the one before.
    pub levels: Vec<Vec<Radiance>>,
    /// The side of the first map, in texels.
    pub side: usize,
    /// The lamps; the maps do not contain them.
    pub lamps: Vec<Disc>,
}

/// A light, and the map in which it is looked up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "LightingData", into = "LightingData")]
pub struct Lighting {
    /// The description of the light.
    pub light: Light,
    /// The light as a map by direction, with its panorama.
    pub map: EnvironmentMap,
    /// Warnings about unusual properties of the panorama. They name its file.
    pub warnings: Vec<String>,
}

/// Lighting as plain data. The map of a light without a panorama is not sent but drawn again, which is quicker.
#[derive(Serialize, Deserialize)]
struct LightingData {
    light: Light,
    map: Option<EnvironmentMap>,
    warnings: Vec<String>,
}

impl From<Lighting> for LightingData {
    fn from(Lighting { light, map, warnings }: Lighting) -> Self {
        let map = light.panorama.is_some().then_some(map);
        Self { light, map, warnings }
    }
}

impl TryFrom<LightingData> for Lighting {
    type Error = LightingError;

    fn try_from(LightingData { light, map, warnings }: LightingData) -> Result<Self, LightingError> {
        light.validate()?;
        let map = match (map, &light.panorama) {
            (Some(map), _) => map.checked()?,
            (None, None) => EnvironmentMap::new(&light, None),
            (None, Some(panorama)) => {
                return Err(LightingError::NoMap { panorama: panorama.file.display().to_string() });
            }
        };
        Ok(Self { light, map, warnings })
    }
}

/// The reason why lighting cannot be looked up.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LightingError {
    /// The light itself is not valid.
    #[error("light: {0}")]
    Light(#[from] LightError),
    /// The light has a panorama, and there is no map that contains it.
    #[error(
        "map is missing: the panorama {panorama} cannot be drawn anew; give the map that was drawn with it"
    )]
    NoMap {
        /// The file of the panorama.
        panorama: String,
    },
    /// The map has no levels.
    #[error("map.levels is empty: give the finest level at least")]
    NoLevel,
    /// The number of texels of a level is not the square of the side that this level must have.
    #[error("map.levels[{level}] has {texels} texels, and a map of side {side} has {wanted} there")]
    Level {
        /// The number of the level; 0 is the finest.
        level: usize,
        /// The number of texels of the level.
        texels: usize,
        /// The side of the finest level, in texels.
        side: usize,
        /// The number of texels that the level should have.
        wanted: usize,
    },
    /// The map or its lamps hold a number that is not finite.
    #[error("map holds a number that is not finite: give finite ones")]
    NotFinite,
}

/// The environment of a picture: the light around the stones, the observer's head, and the backplate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Environment<'a> {
    /// The light, in its own frame.
    pub map: &'a EnvironmentMap,
    /// The light's frame in the world.
    pub basis: Basis,
    /// The image's frame in the world.
    pub eye: Basis,
    /// The half angle of the observer's head around the axis to the eye, in radians; 0 for no head.
    pub head: f64,
    /// The photograph behind the stones, where there is one.
    pub backplate: Option<Backplate<'a>>,
    /// True where rays that miss the stones see the environment; otherwise they see nothing.
    pub backdrop: bool,
}

/// The square of the length of a fan below which the ray counts as having one direction.
pub(super) const STILL: f64 = 1e-14;

/// The least width of the edge of the head's shadow, as a difference of cosines.
pub(crate) const HEAD_EDGE: f64 = 0.004;

impl EnvironmentMap {
    /// Draws a light into maps, with the world that it names. `panorama` is the picture that the light names.
    pub fn new(light: &Light, panorama: Option<&Panorama>) -> Self {
        match Self::watched(light, panorama, &unwatched) {
            Ok(map) => map,
            Err(Stopped) => unreachable!("nothing stops it"),
        }
    }

    /// Draws the same maps as [`new`](Self::new) does, a part after the other, so that other work of the thread pool has its
    /// turn between two parts.
    ///
    /// # Errors
    /// Fails where `watch` asks to stop.
    pub fn watched(light: &Light, panorama: Option<&Panorama>, watch: Watch) -> Result<Self, Stopped> {
        let side = if panorama.is_some() || light.world.is_some() { SIDE_OF_PICTURE } else { SIDE };
        Self::drawn(light, panorama, side, watch)
    }

    /// Draws coarse maps of a light whose whole ones take seconds, as those of worlds do; `None` for any other light.
    pub fn coarse(light: &Light) -> Option<Self> {
        (light.world.is_some() && light.panorama.is_none())
            .then(|| Self::drawn(light, None, COARSE_SIDE, &unwatched).ok())
            .flatten()
    }

    /// Draws a light into maps, of which the finest has this side.
    fn drawn(light: &Light, panorama: Option<&Panorama>, side: usize, watch: Watch) -> Result<Self, Stopped> {
        let pixels = panorama.map_or(0, |p| p.width as usize / (2 * side));
        let per_side = pixels.clamp(PER_SIDE.0, PER_SIDE.1);
        let broad = BroadLight::new(light, panorama);
        let mut finest = Vec::with_capacity(side * side);
        for first in (0..side).step_by(PART_ROWS) {
            if watch(first as f64 / side as f64).is_break() {
                return Err(Stopped);
            }
            let rows = first..(first + PART_ROWS).min(side);
            let world = light.world.map(|world| world_texels(world, side, rows.clone()));
            let row = |y: usize| {
                let from = (y - first) * side;
                let world = world.as_ref().map(|texels| &texels[from..from + side]);
                broad_row(&broad, side, per_side, y, world)
            };
            finest.par_extend(rows.into_par_iter().flat_map_iter(row));
        }
        let mut levels = vec![finest];
        while levels[levels.len() - 1].len() > 16 {
            levels.push(halved(&levels[levels.len() - 1]));
        }
        let disc = |lamp: brillianteer_scene::Lamp| Disc {
            toward: toward(lamp.azimuth, lamp.elevation),
            chord_squared: (2.0 * (lamp.radius.to_radians() / 2.0).sin()).powi(2),
            radiance: channels(lamp.colour) * lamp.radiance,
        };
        Ok(Self { levels, side, lamps: light.lamps().into_iter().map(disc).collect() })
    }

    /// Checks that every level is a square of half the side of the one before.
    ///
    /// # Errors
    /// Fails with [`LightingError::NoLevel`], or with [`LightingError::Level`] for the first level at fault.
    pub fn check(&self) -> Result<(), LightingError> {
        if self.levels.is_empty() {
            return Err(LightingError::NoLevel);
        }
        for (level, texels) in self.levels.iter().map(Vec::len).enumerate() {
            let side = u32::try_from(level).ok().and_then(|by| self.side.checked_shr(by)).unwrap_or(0);
            let wanted = side.saturating_mul(side);
            if texels != wanted || texels == 0 {
                return Err(LightingError::Level { level, texels, side: self.side, wanted });
            }
        }
        Ok(())
    }

    /// Returns the map itself, if it is valid for look-ups.
    fn checked(self) -> Result<Self, LightingError> {
        self.check()?;
        let is_finite = self.levels.iter().flatten().flatten().all(|x| x.is_finite())
            && self.lamps.iter().all(|lamp| lamp.toward.is_finite() && lamp.radiance.is_finite())
            && self.lamps.iter().all(|lamp| lamp.chord_squared.is_finite());
        if is_finite { Ok(self) } else { Err(LightingError::NotFinite) }
    }

    /// Returns the map's light from a direction, averaged over an angle in radians.
    fn at(&self, direction: DVec3, angle: f64) -> DVec4 {
        let texels = angle * self.side as f64 / TEXEL_ANGLE;
        let level = texels.max(1.0).log2().min((self.levels.len() - 1) as f64);
        let (at, fine) = (octahedral(direction), level.floor() as usize);
        let whole = self.level(at, fine);
        if level - fine as f64 <= 0.0 {
            return whole;
        }
        whole.lerp(self.level(at, fine + 1), level - fine as f64)
    }

    /// Interpolates one level of the map.
    fn level(&self, at: DVec2, level: usize) -> DVec4 {
        let size = (self.side >> level) as i32;
        let p = at * f64::from(size) - 0.5;
        let (base, part) = (p.floor().as_ivec2(), p - p.floor());
        let texel = |dx, dy| {
            let p = wrapped(base + IVec2::new(dx, dy), size);
            DVec4::from_array(self.levels[level][(p.y * size + p.x) as usize].map(f64::from))
        };
        let (low, high) = (texel(0, 0).lerp(texel(1, 0), part.x), texel(0, 1).lerp(texel(1, 1), part.x));
        low.lerp(high, part.y)
    }
}

impl Environment<'_> {
    /// Returns the light of the photograph behind the stones along a ray; `None` where the ray does not meet the
    /// photograph at any of its wavelengths.
    fn photograph(&self, ray: &DispersedRay) -> Option<Photographed> {
        self.backplate?.at(&self.eye, ray)
    }

    /// Returns the radiance, by channel, that arrives along a ray from outside the stones. The ray begins at `from`;
    /// `fan` is the change of its direction over its wavelengths.
    pub fn radiance(&self, from: DVec3, direction: DVec3, fan: DVec3) -> DVec4 {
        self.radiance_around(&DispersedRay { origin: from, direction, fan, shift: DVec3::ZERO }, 0.0)
    }

    /// Returns whether light along a fan of directions may come from a lamp, if the fan is bent by this part of its length.
    pub fn may_see_lamp(&self, direction: DVec3, fan: DVec3, bend: f64) -> bool {
        let own =
            |v: DVec3| DVec3::new(self.basis.right.dot(v), self.basis.up.dot(v), self.basis.toward.dot(v));
        let (d, s, margin) = (own(direction), own(fan), bend * fan.length());
        let near = |l: &Disc| {
            let wider = (l.chord_squared.sqrt() + margin).powi(2);
            let from = d - l.toward;
            let along = if s == DVec3::ZERO { 0.0 } else { from.dot(s) / s.length_squared() };
            (from - s * along.clamp(-0.5, 0.5)).length_squared() < wider
        };
        self.map.lamps.iter().any(near)
    }

    /// Returns the radiance as [`radiance`](Self::radiance) does, for a ray that may also represent a square of
    /// directions, with the side `spread` in radians. The light is averaged over the fan or the square, whichever is
    /// wider; a photograph is averaged only along the fan and the shift.
    pub fn radiance_around(&self, ray: &DispersedRay, spread: f64) -> DVec4 {
        let beyond = || self.beyond(ray.direction, ray.fan, spread);
        match self.photograph(ray) {
            Some(seen) if seen.share >= 1.0 => seen.light,
            Some(seen) => seen.light + beyond() * (1.0 - seen.share),
            None => beyond(),
        }
    }

    /// Returns the radiance, by channel, of the light alone, in the shadow of the observer's head.
    fn beyond(&self, direction: DVec3, fan: DVec3, spread: f64) -> DVec4 {
        let own =
            |v: DVec3| DVec3::new(self.basis.right.dot(v), self.basis.up.dot(v), self.basis.toward.dot(v));
        let (d, s, fanned) = (own(direction), own(fan), fan.length());
        let lamps = self.map.lamps.iter();
        let share = |l: &Disc| {
            if spread > fanned {
                share_of_disc(d - l.toward, spread, l.chord_squared)
            } else {
                share_inside(d - l.toward, s, l.chord_squared)
            }
        };
        let lit = lamps.map(|l| l.radiance * share(l)).sum::<DVec4>();
        let sum = self.map.at(d, fanned.max(spread)) + lit;
        if self.head <= 0.0 {
            return sum;
        }
        let beside = (self.head.cos() - direction.dot(self.eye.toward)) / fanned.max(HEAD_EDGE) + 0.5;
        sum * beside.clamp(0.0, 1.0)
    }
}

/// Returns the share of a fan of directions that lies inside a disc. The fan reaches from half its length before the
/// ray's direction to half after it.
pub(super) fn share_inside(from_middle: DVec3, fan: DVec3, chord_squared: f64) -> f64 {
    let (a, b) = (fan.length_squared(), from_middle.dot(fan));
    let c = from_middle.length_squared() - chord_squared;
    if a < STILL {
        return if c < 0.0 { 1.0 } else { 0.0 };
    }
    let under_root = b * b - a * c;
    if under_root <= 0.0 {
        return 0.0;
    }
    let root = under_root.sqrt();
    (((root - b) / a).min(0.5) - ((-root - b) / a).max(-0.5)).max(0.0)
}

/// Returns the share of a disc of directions that lies inside a lamp. The disc has the area of a square with this
/// side.
fn share_of_disc(from_middle: DVec3, side: f64, chord_squared: f64) -> f64 {
    let (own, lamp) = (side * FRAC_1_PI.sqrt(), chord_squared.sqrt());
    let apart = from_middle.length();
    if apart >= own + lamp {
        return 0.0;
    }
    let (small, large) = (own.min(lamp), own.max(lamp));
    let common = if apart <= large - small {
        PI * small * small
    } else {
        // The two segments: the part of each circle beyond the line through both crossings.
        let segment = |r: f64, other: f64| {
            let along = ((apart * apart + r * r - other * other) / (2.0 * apart)).clamp(-r, r);
            r * r * (along / r).acos() - along * (r * r - along * along).max(0.0).sqrt()
        };
        segment(own, lamp) + segment(lamp, own)
    };
    (common / (side * side)).min(1.0)
}

/// Returns the place of a direction in the map, 0 to 1.
fn octahedral(d: DVec3) -> DVec2 {
    let flat = d.truncate() / (d.x.abs() + d.y.abs() + d.z.abs());
    let sign = |x: f64| if x >= 0.0 { 1.0 } else { -1.0 };
    let folded = (1.0 - flat.yx().abs()) * DVec2::new(sign(flat.x), sign(flat.y));
    0.5 + 0.5 * if d.z >= 0.0 { flat } else { folded }
}

/// Returns the direction of a place in the map; the inverse of [`octahedral`].
fn direction(at: DVec2) -> DVec3 {
    let p = at * 2.0 - 1.0;
    let z = 1.0 - p.x.abs() - p.y.abs();
    let sign = |x: f64| if x >= 0.0 { 1.0 } else { -1.0 };
    let flat = if z >= 0.0 { p } else { (1.0 - p.yx().abs()) * DVec2::new(sign(p.x), sign(p.y)) };
    let d = flat.extend(z);
    d / d.length()
}

/// Returns the coordinates of a texel. Beyond the map's edge, they are those of the texel that lies next to that edge
/// on the sphere.
pub(super) fn wrapped(mut p: IVec2, size: i32) -> IVec2 {
    if p.x < 0 || p.x >= size {
        p = IVec2::new(if p.x < 0 { -1 - p.x } else { 2 * size - 1 - p.x }, size - 1 - p.y);
    }
    if p.y < 0 || p.y >= size {
        p = IVec2::new(size - 1 - p.x, if p.y < 0 { -1 - p.y } else { 2 * size - 1 - p.y });
    }
    p
}

/// Returns a row of a map with this side, from a broad light and the row of a world. Each texel is the mean of `per_side` by
/// `per_side` samples of the broad light.
fn broad_row(
    broad: &BroadLight,
    side: usize,
    per_side: usize,
    y: usize,
    world: Option<&[DVec3]>,
) -> Vec<Radiance> {
    let cells = side * per_side;
    let texel = |x: usize| {
        let sample = |k: usize| {
            let (i, j) = (x * per_side + k % per_side, y * per_side + k / per_side);
            let at = (DVec2::new(i as f64, j as f64) + 0.5) / cells as f64;
            broad.radiance(direction(at))
        };
        let all: DVec4 = (0..per_side * per_side).map(sample).sum();
        let world = world.map_or(DVec3::ZERO, |row| row[x]);
        let all = all / (per_side * per_side) as f64 + world.extend(0.0).wxyz();
        all.min(DVec4::splat(BRIGHTEST)).as_vec4().to_array()
    };
    (0..side).map(texel).collect()
}

/// Draws some rows of the map of a world with this side.
fn world_texels(world: World, side: usize, rows: Range<usize>) -> Vec<DVec3> {
    let texel = TEXEL_ANGLE / side as f64;
    world.drawn([side; 2], rows, |at| (World::from_light(direction(at / side as f64)), texel))
}

/// Returns the next coarser level, in which each texel is the mean of two by two texels.
fn halved(fine: &[Radiance]) -> Vec<Radiance> {
    let size = fine.len().isqrt();
    let at = |x: usize, y: usize| DVec4::from_array(fine[y * size + x].map(f64::from));
    let mean = |x: usize, y: usize| {
        let sum = at(2 * x, 2 * y) + at(2 * x + 1, 2 * y) + at(2 * x, 2 * y + 1) + at(2 * x + 1, 2 * y + 1);
        (sum / 4.0).as_vec4().to_array()
    };
    (0..size / 2).flat_map(|y| (0..size / 2).map(move |x| (x, y))).map(|(x, y)| mean(x, y)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_map_folds_the_whole_sphere_and_unfolds_it_again() {
        for k in 0..2000 {
            let z = 1.0 - 2.0 * (f64::from(k) + 0.5) / 2000.0;
            let (sin, cos) = (2.399_963 * f64::from(k)).sin_cos();
            let d = DVec3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z);
            assert!((direction(octahedral(d)) - d).length() < 1e-12);
        }
    }

    #[test]
    fn a_texel_beyond_the_edge_is_the_one_that_is_next_on_the_sphere() {
        let size = 64;
        let middle = |p: IVec2| direction((p.as_dvec2() + 0.5) / f64::from(size));
        for k in 0..size {
            for p in [IVec2::new(-1, k), IVec2::new(size, k), IVec2::new(k, -1), IVec2::new(k, size)] {
                let beside = p.clamp(IVec2::ZERO, IVec2::splat(size - 1));
                assert!((middle(wrapped(p, size)) - middle(beside)).length() < 0.12, "{p}");
            }
        }
    }

    #[test]
    fn a_fan_across_a_lamp_gathers_what_lies_inside_it() {
        let (lamp, radius) = (DVec3::Z, 0.02_f64);
        let chord = (2.0 * (radius / 2.0).sin()).powi(2);
        for (offset, fan) in [(0.0, 0.1), (0.01, 0.03), (0.03, 0.1), (0.015, 0.0), (0.05, 0.01)] {
            let (from, way) = (DVec3::new(offset, 0.004, 1.0), DVec3::new(fan, 0.3 * fan, 0.0));
            let inside = |k: i32| {
                let p = from + way * ((f64::from(k) + 0.5) / 100_000.0 - 0.5) - lamp;
                f64::from(u8::from(p.length_squared() < chord))
            };
            let counted = (0..100_000).map(inside).sum::<f64>() / 1e5;
            assert!((share_inside(from - lamp, way, chord) - counted).abs() < 2e-4);
        }
    }

    #[test]
    fn a_disc_of_directions_gathers_the_part_of_it_that_a_lamp_fills() {
        for (offset, side, radius) in
            [(0.0, 0.03, 0.02), (0.01, 0.03, 0.02), (0.03, 0.03, 0.02), (0.0, 0.2, 0.02), (0.01, 0.004, 0.02)]
        {
            let own = side * FRAC_1_PI.sqrt();
            let inside = |k: u32| {
                let (x, y) = (f64::from(k % 1000), f64::from(k / 1000));
                let p = (DVec2::new(x, y) + 0.5) / 500.0 - 1.0;
                let at = p * own + DVec2::X * offset;
                (p.length() < 1.0).then(|| f64::from(u8::from(at.length() < radius)))
            };
            let all: Vec<f64> = (0..1_000_000).filter_map(inside).collect();
            let counted = all.iter().sum::<f64>() / all.len() as f64;
            let found = share_of_disc(DVec3::X * offset, side, radius * radius);
            assert!((found - counted).abs() < 2e-3, "{offset} {side}: {found} {counted}");
        }
        assert_eq!(share_of_disc(DVec3::X * 0.05, 0.03, 4e-4), 0.0);
    }

    #[test]
    fn the_map_of_a_world_shows_the_world_with_its_middle_behind_the_stones() {
        let sky = EnvironmentMap::new(&Light::of_world(World::Room), None);
        let (texel, count) = (TEXEL_ANGLE / sky.side as f64, 4000);
        let shares = [World::from_light, |d: DVec3| d].map(|turned| {
            let agrees = |k: &i32| {
                let z = 1.0 - 2.0 * (f64::from(*k) + 0.5) / f64::from(count);
                let (sin, cos) = (2.399_963 * f64::from(*k)).sin_cos();
                let d = DVec3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z);
                let (seen, drawn) = (World::Room.radiance(turned(d), texel), sky.at(d, 0.0).yzw());
                (seen - drawn).abs().max_element() < 0.01 + 0.1 * seen.max_element()
            };
            (0..count).filter(agrees).count() as f64 / f64::from(count)
        });
        assert!(shares[0] > 0.85 && shares[1] < 0.6, "{shares:?}");
    }

    #[test]
    fn the_sky_keeps_its_light_at_every_level() {
        let dome = |from, to| brillianteer_scene::Dome {
            from,
            to,
            soft: 5.0,
            radiance: 1.0,
            end: None,
            colour: None,
        };
        let light = Light { dome: vec![dome(20.0, 90.0)], ..brillianteer_scene::Light::white() };
        let sky = EnvironmentMap::new(&light, None);
        // The share of the sphere above 20 degrees, weighted as the map weighs it: alike at all levels.
        let mean =
            |level: &Vec<Radiance>| level.iter().map(|t| f64::from(t[0])).sum::<f64>() / level.len() as f64;
        let first = mean(&sky.levels[0]);
        sky.levels.iter().for_each(|level| assert!((mean(level) - first).abs() < 1e-6));
        let up = sky.at(DVec3::Z, 0.0).x;
        assert!((up - 1.0).abs() < 1e-6 && sky.at(-DVec3::Z, 0.01).x == 0.0);
    }
}
