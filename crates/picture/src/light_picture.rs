//! A small picture of a light, which shows in lists where its sources are.

use brillianteer_optics::SrgbEncoder;
use brillianteer_scene::{Light, toward};
use brillianteer_trace::environment::{BroadLight, channels};
use glam::{DVec3, DVec4, Vec4Swizzles as _};
use std::f64::consts::PI;

/// The least radius of a lamp in the picture, in pixels, so that it can be seen.
const LEAST_LAMP: f64 = 0.8;

/// Draws a light without a panorama of its own in a picture of `width` and `height` pixels, and returns the picture's sRGB codes
/// row by row.
///
/// Azimuths run through all 360 degrees from the left to the right, elevations from the zenith at the top to the nadir. Light of
/// the key illuminant is drawn white. Light rolls off toward full scale, so that lamps do not hide the rest.
pub fn light_picture(light: &Light, [width, height]: [u32; 2]) -> Vec<u8> {
    let (encoder, pixel) = (SrgbEncoder::new(), PI / f64::from(height));
    let lamps: Vec<(DVec3, f64, DVec3)> = light
        .lamps()
        .into_iter()
        .map(|lamp| {
            let radius = lamp.radius.to_radians().max(LEAST_LAMP * pixel);
            (toward(lamp.azimuth, lamp.elevation), radius, lamp.radiance * under_white(channels(lamp.colour)))
        })
        .collect();
    let broad_light = BroadLight::new(light, None);
    let radiance = |x: u32, y: u32| {
        let azimuth = 360.0 * (0.5 - (f64::from(x) + 0.5) / f64::from(width));
        let direction = toward(azimuth, 90.0 - 180.0 * (f64::from(y) + 0.5) / f64::from(height));
        let broad = under_white(broad_light.radiance(direction));
        let world = light.world.map_or(DVec3::ZERO, |world| world.radiance(direction, pixel));
        let lamps = lamps.iter().filter(|(at, radius, _)| at.angle_between(direction) <= *radius);
        broad + world + lamps.map(|(_, _, colour)| *colour).sum::<DVec3>()
    };
    let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    all.flat_map(|(x, y)| {
        let colour = radiance(x, y);
        (colour / (DVec3::ONE + colour)).to_array().map(|part| encoder.encode(part))
    })
    .collect()
}

/// Returns the colour of a radiance by channel where the key illuminant counts as white.
fn under_white(channels: DVec4) -> DVec3 {
    channels.yzw() + DVec3::splat(channels.x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_scene::{LIGHTS, light};

    fn mean(codes: &[u8]) -> f64 {
        codes.iter().map(|code| f64::from(*code)).sum::<f64>() / codes.len() as f64
    }

    #[test]
    fn every_light_of_the_program_has_a_picture_of_its_own() {
        let pictures: Vec<_> =
            LIGHTS.iter().map(|name| light_picture(&light(name).unwrap(), [48, 24])).collect();
        for (k, picture) in pictures.iter().enumerate() {
            assert!(picture.len() == 3 * 48 * 24 && mean(picture) > 2.0, "{}", LIGHTS[k]);
            assert!(pictures[..k].iter().all(|other| other != picture), "{}", LIGHTS[k]);
        }
    }

    #[test]
    fn a_dome_lights_the_upper_half_and_a_world_stands_upright() {
        let halves = |name: &str| {
            let picture = light_picture(&light(name).unwrap(), [48, 24]);
            [mean(&picture[..picture.len() / 2]), mean(&picture[picture.len() / 2..])]
        };
        let [above, below] = halves("dome");
        assert!(above > 100.0 && below < 0.2 * above, "{above} {below}");
        let [sky, water] = halves("sunset");
        assert!(sky > 1.2 * water, "{sky} {water}");
    }
}
