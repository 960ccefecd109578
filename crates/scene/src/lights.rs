//! The lights that come with the program. A light from a publication names it; the others were chosen to show stones
//! well.

use super::light::{Dome, Lamp, LampField, Light, PanoramaRef, SoftBox};
use super::worlds::World;
use brillianteer_optics::Illuminant;
use glam::DVec3;
use std::f64::consts::TAU;
use std::path::Path;

/// The names of the lights that come with the program. The first is the default.
pub const LIGHTS: [&str; 12] = [
    "studio", "dome", "cosine", "ring", "lamps", "fire", "office", "daylight", "sunset", "room", "city",
    "white",
];

/// Returns the light of a name among [`LIGHTS`].
pub fn light(name: &str) -> Option<Light> {
    match name {
        "studio" => Some(Light::studio()),
        "dome" => Some(Light::dome()),
        "cosine" => Some(Light::cosine()),
        "ring" => Some(Light::ring()),
        "lamps" => Some(Light::lamps_on_dome()),
        "fire" => Some(Light::fire()),
        "office" => Some(Light::office()),
        "daylight" => Some(Light::daylight()),
        "white" => Some(Light::white()),
        _ => World::named(name).map(Light::of_world),
    }
}

fn belt(from: f64, to: f64, soft: f64, radiance: f64) -> Dome {
    Dome { from, to, soft, radiance, end: None, colour: None }
}

fn rising(from: f64, to: f64, radiance: f64, end: f64) -> Dome {
    Dome { end: Some(end), ..belt(from, to, 0.0, radiance) }
}

fn soft_box((azimuth, elevation): (f64, f64), (width, height): (f64, f64), radiance: f64) -> SoftBox {
    SoftBox { azimuth, elevation, width, height, turn: 0.0, soft: 6.0, radiance, colour: None }
}

fn lamp((azimuth, elevation): (f64, f64), radius: f64, radiance: f64) -> Lamp {
    Lamp { azimuth, elevation, radius, radiance, colour: None }
}

/// Half the width of a bulb, in metres.
const BULB: f64 = 0.02;

/// Rings of bulbs: the middle of each, in metres to the right of the eye, above it and behind it; the radius in metres;
/// the number of bulbs; and the place of the first one, in steps from bulb to bulb.
const RINGS: [([f64; 3], f64, u32, f64); 4] = [
    ([0.0, 1.1, 1.5], 0.45, 10, 0.0),
    ([0.0, 1.3, 1.5], 0.25, 6, 0.5),
    ([-1.5, 1.0, 0.6], 0.3, 7, 0.0),
    ([1.5, 1.0, 0.6], 0.3, 7, 0.0),
];

/// Returns the bulbs of all rings as lamps of this radiance and colour.
fn bulbs(radiance: f64, colour: [u8; 3]) -> Vec<Lamp> {
    let of_ring = |&([right, up, back], radius, count, first): &([f64; 3], f64, u32, f64)| {
        (0..count).map(move |k| {
            let (sin, cos) = (TAU * (f64::from(k) + first) / f64::from(count)).sin_cos();
            let place = DVec3::new(right + radius * cos, up, back + radius * sin);
            let away = place.length();
            let at = (place.y.atan2(place.x).to_degrees(), (place.z / away).asin().to_degrees());
            Lamp { colour: Some(colour), ..lamp(at, (BULB / away).atan().to_degrees(), radiance) }
        })
    };
    RINGS.iter().flat_map(of_ring).collect()
}

impl Light {
    fn named(name: &str, description: &str) -> Self {
        Self {
            name: name.to_owned(),
            description: description.to_owned(),
            spectrum: Illuminant::D65,
            head: 0.0,
            world: None,
            dome: vec![],
            boxes: vec![],
            lamp: vec![],
            field: vec![],
            panorama: None,
        }
    }

    /// Returns soft boxes around a dim room, dark between them, as jewellery photographers use them.
    pub fn studio() -> Self {
        Self {
            head: 9.0,
            dome: vec![rising(-90.0, 0.0, 0.16, 0.06), rising(0.0, 90.0, 0.04, 0.10)],
            boxes: vec![
                soft_box((50.0, 62.0), (46.0, 30.0), 1.9),
                soft_box((170.0, 52.0), (34.0, 46.0), 1.2),
                soft_box((285.0, 58.0), (52.0, 26.0), 1.5),
                soft_box((110.0, 24.0), (70.0, 20.0), 0.8),
                soft_box((230.0, 20.0), (60.0, 22.0), 0.65),
                soft_box((350.0, 22.0), (50.0, 24.0), 0.9),
            ],
            lamp: vec![
                lamp((25.0, 38.0), 2.2, 40.0),
                lamp((140.0, 72.0), 1.8, 45.0),
                lamp((205.0, 44.0), 2.2, 35.0),
                lamp((320.0, 40.0), 2.0, 40.0),
            ],
            ..Self::named("studio", "soft boxes and four small lamps around a dim room; the default")
        }
    }

    /// Returns the same radiance from every direction above the horizon.
    pub fn dome() -> Self {
        Self {
            head: 10.0,
            dome: vec![belt(0.0, 90.0, 0.0, 1.0)],
            ..Self::named(
                "dome",
                "even light from above the horizon, except where the observer's head is (ISO)",
            )
        }
    }

    /// Returns radiance in proportion to the sine of the elevation, above the horizon.
    pub fn cosine() -> Self {
        Self {
            head: 10.0,
            dome: vec![rising(0.0, 90.0, 0.0, 1.0)],
            ..Self::named(
                "cosine",
                "light that decreases with the cosine of the angle from the axis, except where the observer's head is \
                    (COS)",
            )
        }
    }

    /// Returns a ring light around the lens.
    pub fn ring() -> Self {
        Self {
            head: 12.0,
            dome: vec![belt(-90.0, 90.0, 0.0, 0.05), belt(58.0, 72.0, 3.0, 4.0)],
            ..Self::named("ring", "a ring light around the lens, 18 to 32 degrees from the axis")
        }
    }

    /// Returns eight small lamps over a dim dome.
    pub fn lamps_on_dome() -> Self {
        let places = [(10.0, 70.0), (100.0, 62.0), (190.0, 74.0), (280.0, 66.0)];
        let lower = [(55.0, 48.0), (145.0, 40.0), (235.0, 52.0), (325.0, 36.0)];
        Self {
            head: 9.0,
            dome: vec![belt(0.0, 90.0, 0.0, 0.25)],
            lamp: places.into_iter().chain(lower).map(|at| lamp(at, 1.5, 120.0)).collect(),
            ..Self::named("lamps", "eight small lamps over a dim dome: some fire")
        }
    }

    /// Returns a dark room full of small lamps.
    pub fn fire() -> Self {
        Self {
            head: 8.0,
            dome: vec![belt(-90.0, 90.0, 0.0, 0.025)],
            field: vec![LampField {
                count: 90,
                from: 15.0,
                to: 84.0,
                radius: 0.9,
                radiance: 120.0,
                colour: None,
            }],
            ..Self::named("fire", "ninety small lamps in a dark room: as much fire as a stone can show")
        }
    }

    /// Returns an office: panels in a ceiling, a window, pale walls.
    pub fn office() -> Self {
        let mut boxes = vec![];
        for (row, elevation) in [78.0, 58.0, 42.0].into_iter().enumerate() {
            let count = [3, 6, 8][row];
            for k in 0..count {
                let azimuth = 360.0 * (f64::from(k) + 0.5 * (row % 2) as f64) / f64::from(count);
                let width = [26.0, 15.0, 11.0][row];
                boxes.push(SoftBox { soft: 2.5, ..soft_box((azimuth, elevation), (width, 8.0), 3.0) });
            }
        }
        let window = SoftBox { soft: 1.0, ..soft_box((200.0, 16.0), (44.0, 24.0), 2.2) };
        boxes.push(SoftBox { colour: Some([214, 232, 255]), ..window });
        Self {
            head: 10.0,
            dome: vec![
                Dome { colour: Some([150, 128, 108]), ..belt(-90.0, 0.0, 4.0, 0.35) },
                Dome { colour: Some([232, 226, 214]), ..belt(0.0, 90.0, 4.0, 0.17) },
            ],
            boxes,
            ..Self::named("office", "panels in a ceiling, one window, pale walls, a wooden desk")
        }
    }

    /// Returns sky, clouds and the sun.
    pub fn daylight() -> Self {
        let sky = Dome { colour: Some([206, 221, 255]), ..rising(0.0, 90.0, 0.8, 0.22) };
        let ground = Dome { colour: Some([150, 146, 118]), ..belt(-90.0, 0.0, 3.0, 0.35) };
        Self {
            // The sun has a small part of its true radiance, over a disc wider than its true quarter of a degree: the same
            // power on the stone as a hazy sun.
            lamp: vec![Lamp { colour: Some([255, 244, 226]), ..lamp((60.0, 52.0), 1.0, 500.0) }],
            head: 11.0,
            dome: vec![sky, ground],
            boxes: vec![
                SoftBox { soft: 16.0, turn: 8.0, ..soft_box((160.0, 50.0), (54.0, 22.0), 1.3) },
                SoftBox { soft: 14.0, turn: -5.0, ..soft_box((265.0, 68.0), (46.0, 20.0), 1.2) },
                SoftBox { soft: 14.0, ..soft_box((330.0, 35.0), (60.0, 16.0), 1.1) },
            ],
            ..Self::named("daylight", "a sky with the sun and some clouds, and the ground")
        }
    }

    /// Returns a light that is a panorama alone, named after its file.
    pub fn of_panorama(file: &Path) -> Self {
        let stem = file.file_stem().map_or_else(|| "panorama".into(), |stem| stem.to_string_lossy());
        let panorama = PanoramaRef { file: file.to_owned(), exposure: 0.0, turn: 0.0 };
        Self { panorama: Some(panorama), ..Self::named(&stem, "") }
    }

    /// Returns the light of a world that the program draws, whose best side lies behind the stones. Bulbs hang above and
    /// behind the eye in the room and before the city, so that stones have lamps to split; they are too small for the
    /// world's map, and the world's picture does not reach so far back.
    pub fn of_world(world: World) -> Self {
        let description = match world {
            World::Sunset => {
                "a sunset over water, seen behind the stones; the dusk lights them from the front"
            }
            World::Room => "a living room at dusk: lamps, candles, a window, bulbs over the eye",
            World::City => {
                "a city at night around a bay: windows, signs, lamps along the shore, bulbs over the eye"
            }
        };
        let lamp = match world {
            World::Sunset => vec![],
            World::Room => bulbs(200.0, [255, 226, 186]),
            World::City => bulbs(250.0, [255, 240, 220]),
        };
        Self { world: Some(world), lamp, ..Self::named(world.name(), description) }
    }

    /// Returns the same radiance from everywhere: a stone that absorbs no light is invisible in it.
    pub fn white() -> Self {
        Self {
            dome: vec![belt(-90.0, 90.0, 0.0, 1.0)],
            ..Self::named("white", "the same light from everywhere, in which a clear stone vanishes (a test)")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_light_is_found_by_its_name_and_valid() {
        for name in LIGHTS {
            let light = light(name).unwrap();
            assert_eq!(light.name, name);
            assert_eq!(light.validate(), Ok(()), "{name}");
        }
        assert_eq!(light("moon"), None);
    }

    #[test]
    fn lights_at_fault_are_named() {
        let lamp = Lamp { radius: 0.0, ..lamp((0.0, 45.0), 1.0, 1.0) };
        let light = Light { lamp: vec![lamp], ..Light::studio() };
        let told = light.validate().unwrap_err().to_string();
        assert!(told.starts_with("lamp 1: radius is 0; give 0.001 to 90"), "{told}");
        let dark = Light::named("dark", "");
        assert_eq!(dark.validate(), Err(super::super::light::LightError::Dark));
        let crowd = LampField { count: 4_000_000_000, ..Light::fire().field[0].clone() };
        assert!(Light { field: vec![crowd; 2], ..dark }.validate().is_err());
    }
}
