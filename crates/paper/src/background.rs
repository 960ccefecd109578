//! Draws and reads the pictures that hang behind the stones.

use super::png_bytes::png;
use super::rasterize;
use ::png::{BitDepth, ColorType};
use brillianteer_base::Failure;
use brillianteer_base::FileError;
use brillianteer_base::Watch;
use brillianteer_files::panorama::{self, LoadedPanorama};
use brillianteer_files::text::unreadable;
use brillianteer_optics::{encoded_from_linear, linear_from_encoded};
use brillianteer_picture::{PATTERN_SIDE, pattern_drawing, toned};
use brillianteer_scene::{BackgroundRef, PATTERN_SPAN, Panorama, Pattern, Tone, World};

/// The greatest width of a photograph that is kept as it is; larger ones are halved.
const WIDEST: u32 = 4096;

/// Returns the picture that hangs behind, as [`picture_behind`] does for a film of 1024 pixels.
///
/// # Errors
/// Fails where a photograph's file is at fault.
pub fn picture(asked: &BackgroundRef) -> Result<Option<LoadedPanorama>, FileError> {
    picture_behind(asked, PATTERN_SIDE / 2)
}

/// Returns the picture that hangs behind a film, as [`picture_behind`] does. Between the parts of a world, `watch`
/// may stop the work.
///
/// # Errors
/// Fails where a photograph's file is at fault, or where `watch` asks to stop.
pub fn picture_watched(
    asked: &BackgroundRef,
    film: u32,
    watch: Watch,
) -> Result<Option<LoadedPanorama>, Failure> {
    let BackgroundRef::World(world) = asked else { return Ok(picture_behind(asked, film)?) };
    let picture = world.picture_in_parts([side_behind(film); 2], PATTERN_SPAN, watch);
    let panorama = picture.ok_or(Failure::Stopped)?;
    Ok(Some(LoadedPanorama { panorama, warnings: vec![] }))
}

/// Returns the picture that hangs behind a film with this many pixels along its longer side. A world is drawn as fine as
/// the film shows it, with 256 to 4096 pixels a side; a photograph is halved until no side is longer than 4096
/// pixels. `None` for the light and for colours.
///
/// # Errors
/// Fails where a photograph's file is at fault.
pub fn picture_behind(asked: &BackgroundRef, film: u32) -> Result<Option<LoadedPanorama>, FileError> {
    match asked {
        BackgroundRef::Light | BackgroundRef::Plain(_) => Ok(None),
        BackgroundRef::Pattern(pattern) => {
            Ok(Some(LoadedPanorama { panorama: drawn(*pattern)?, warnings: vec![] }))
        }
        BackgroundRef::World(world) => {
            Ok(Some(LoadedPanorama { panorama: hung(*world, side_behind(film)), warnings: vec![] }))
        }
        BackgroundRef::Photo(path) => {
            let mut reading = panorama::read_photo(path)?;
            while reading.panorama.width > WIDEST || reading.panorama.height > WIDEST {
                reading.panorama = reading.panorama.halved();
            }
            Ok(Some(reading))
        }
    }
}

/// Returns a picture of a size in pixels as it is where nothing stands before the background: a pattern, a world or a
/// photograph that fills it, or colours; `None` for the light and for a transparent background.
///
/// # Errors
/// Fails where a photograph's file is at fault.
pub fn filling(
    asked: &BackgroundRef,
    [width, height]: [u32; 2],
) -> Result<Option<LoadedPanorama>, FileError> {
    if let BackgroundRef::Plain(colours) = asked {
        let rows: Option<Vec<_>> = (0..height).map(|y| colours.row(y, height)).collect();
        let row = |colour| std::iter::repeat_n(colour, width as usize);
        let pixels = rows.map(|rows| rows.into_iter().flat_map(row).collect());
        let plain =
            |pixels| LoadedPanorama { panorama: Panorama { width, height, pixels }, warnings: vec![] };
        return Ok(pixels.map(plain));
    }
    if let BackgroundRef::World(world) = asked {
        let panorama = world.picture([width, height], 1.0);
        return Ok(Some(LoadedPanorama { panorama, warnings: vec![] }));
    }
    let filled = |r: LoadedPanorama| LoadedPanorama {
        panorama: brillianteer_picture::filling(&r.panorama, [width, height]),
        ..r
    };
    Ok(picture(asked)?.map(filled))
}

/// Returns the picture that hangs behind as the bytes of a file, a photograph's file unchanged; `None` for the light and
/// for colours.
///
/// # Errors
/// Fails where a photograph's file is at fault.
pub fn bytes(asked: &BackgroundRef) -> Result<Option<Vec<u8>>, FileError> {
    match asked {
        BackgroundRef::Light | BackgroundRef::Plain(_) => Ok(None),
        BackgroundRef::Pattern(pattern) => {
            let (width, height, rgb) = rastered(*pattern)?;
            let file = png([width, height], (ColorType::Rgb, BitDepth::Eight), &rgb, &[]);
            file.map(Some).map_err(|error| FileError::new(pattern.name(), error))
        }
        BackgroundRef::World(world) => {
            let picture = hung(*world, PATTERN_SIDE);
            let shown = |light: &[f32; 3]| toned(Tone::Neutral, *light, 1.0).map(encoded);
            let rgb: Vec<u8> = picture.pixels.iter().flat_map(shown).collect();
            let size = [picture.width, picture.height];
            let file = png(size, (ColorType::Rgb, BitDepth::Eight), &rgb, &[]);
            file.map(Some).map_err(|error| FileError::new(world.name(), error))
        }
        BackgroundRef::Photo(path) => {
            std::fs::read(path).map(Some).map_err(|e| unreadable(e).in_file(path.display()))
        }
    }
}

fn rastered(pattern: Pattern) -> Result<(u32, u32, Vec<u8>), FileError> {
    let raster = rasterize(&pattern_drawing(pattern).to_string(), PATTERN_SIDE);
    raster.map_err(|error| FileError::new(pattern.name(), error))
}

/// Returns the side of a world's picture behind a film, in pixels. The film shows the middle half.
fn side_behind(film: u32) -> u32 {
    film.clamp(128, WIDEST / 2).next_power_of_two() * 2
}

/// Draws a world as a hanging picture: its middle half is the part that a photograph 60 degrees across shows.
fn hung(world: World, side: u32) -> Panorama {
    world.picture([side; 2], PATTERN_SPAN)
}

/// Returns a channel of linear light from 0 to 1 as a byte of sRGB.
fn encoded(channel: f32) -> u8 {
    (encoded_from_linear(f64::from(channel)) * 255.0).round() as u8
}

/// Draws a pattern in linear light.
fn drawn(pattern: Pattern) -> Result<Panorama, FileError> {
    let (width, height, rgb) = rastered(pattern)?;
    let linear: Vec<f32> = (0..=255_u8).map(|c| linear_from_encoded(f64::from(c) / 255.0) as f32).collect();
    let pixels = rgb.as_chunks::<3>().0.iter().map(|p| p.map(|c| linear[usize::from(c)])).collect();
    Ok(Panorama { width, height, pixels })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// Returns the mean of a picture's green light.
    fn mean(picture: &Panorama) -> f64 {
        let sum: f64 = picture.pixels.iter().map(|p| f64::from(p[1])).sum();
        sum / picture.pixels.len() as f64
    }

    #[test]
    fn patterns_are_crisp_and_hold_as_much_ink_as_they_are_drawn_with() {
        // The mean of each: the share of paper. A dot whose radius is a quarter of the step covers pi / 16 of its square.
        let lines = 1.0 - (1.0 - 6.0 / 64.0_f64).powi(2);
        for (name, least, most) in [
            ("page", 0.7, 0.95),
            ("grid", 1.0 - lines, 1.0 - lines * 0.95),
            ("checks", 0.4999, 0.5001),
            ("stripes", 0.4999, 0.5001),
            // The dots' rims are evened out in sRGB, which is darker in linear light.
            ("dots", 1.0 - 0.1964 - 0.004, 1.0 - 0.1964),
            ("slit", 0.004_88, 0.004_89),
        ] {
            let asked = BackgroundRef::read(name, Path::new("")).unwrap();
            let picture = super::picture(&asked).unwrap().unwrap().panorama;
            assert_eq!((picture.width, picture.height), (PATTERN_SIDE, PATTERN_SIDE), "{name}");
            let mean = mean(&picture);
            assert!((least..=most).contains(&mean), "{name}: {mean}");
            if ["checks", "stripes", "slit"].contains(&name) {
                assert!(picture.pixels.iter().all(|p| *p == [0.0; 3] || *p == [1.0; 3]), "{name}");
            }
        }
    }

    #[test]
    fn a_picture_is_filled_by_patterns_and_colours() {
        let filled =
            |name: &str| filling(&BackgroundRef::read(name, Path::new("")).unwrap(), [6, 4]).unwrap();
        let picture = filled("white-black").unwrap().panorama;
        assert_eq!((picture.width, picture.height, picture.pixels.len()), (6, 4, 24));
        assert_eq!((picture.pixels[5], picture.pixels[23]), ([0.875; 3], [0.125; 3]));
        let checks = filled("checks").unwrap().panorama;
        assert_eq!((checks.width, checks.height, checks.pixels.len()), (6, 4, 24));
        assert!((mean(&checks) - 0.5).abs() < 0.1);
        assert!(filled("light").is_none() && filled("transparent").is_none());
    }

    #[test]
    fn a_world_hangs_behind_in_full_range_and_goes_into_a_file_as_a_screen_shows_it() {
        let room = BackgroundRef::World(World::Room);
        let hung = picture(&room).unwrap().unwrap().panorama;
        assert_eq!((hung.width, hung.height), (PATTERN_SIDE, PATTERN_SIDE));
        assert!(hung.pixels.iter().flatten().any(|&c| c > 4.0));
        // A picture that the world fills is its photograph, and not a part of what hangs behind.
        let filled = filling(&room, [60, 40]).unwrap().unwrap().panorama;
        assert_eq!(filled, World::Room.picture([60, 40], 1.0));
        let bytes = bytes(&room).unwrap().unwrap();
        let mut reader = ::png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
        assert_eq!(reader.next_frame(&mut rgb).unwrap().width, PATTERN_SIDE);
        let wrong = |(light, code): (&[f32; 3], &[u8; 3])| {
            let shown = toned(Tone::Neutral, *light, 1.0).map(|c| encoded_from_linear(f64::from(c)) * 255.0);
            (0..3).any(|c| (shown[c] - f64::from(code[c])).abs() > 0.51)
        };
        assert!(!hung.pixels.iter().zip(rgb.as_chunks::<3>().0).any(wrong));
    }

    #[test]
    fn a_photograph_that_is_none_is_named() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("photo.png"), "").unwrap();
        let photo = BackgroundRef::read("photo.png", folder.path()).unwrap();
        assert!(picture(&photo).unwrap_err().to_string().contains("photo.png"));
    }
}
