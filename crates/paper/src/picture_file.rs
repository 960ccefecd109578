//! Writes finished pictures: developed as PNG, in linear light as OpenEXR.

#[cfg(feature = "exr")]
use super::exr;
use super::png::{PngFile, encoder};
use super::stored_light::{MOST_HELD, StoredLight};
#[cfg(feature = "exr")]
use ::exr::{math::Vec2, meta::attribute::Chromaticities};
use brillianteer_base::{Stopped, Watch};
use brillianteer_files::{WriteError, write};
use brillianteer_picture::{Develop, LightRows, Overlay, OverlayDrawing, develop_rows, fxaa};
use brillianteer_scene::Background;
use brillianteer_trace::sampling::LitScene;
use std::path::Path;

/// The primaries and the white of sRGB, as CIE x and y (ITU-R BT.709-6, §1).
#[cfg(feature = "exr")]
pub(super) const SRGB: Chromaticities = Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.30, 0.60),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.3290),
};

/// Writes a developed picture as PNG: red, green, blue and cover (alpha) of each pixel, not premultiplied. Where cover is
/// 255 everywhere, the file holds none. `description` goes into the file as text.
///
/// # Errors
/// Fails where the file system refuses, or the number of pixels does not fit the size.
pub fn write_rgba_png(
    path: &Path,
    rgba: &[u8],
    size: (u32, u32),
    description: &str,
) -> Result<(), WriteError> {
    let failed = |e: png::EncodingError| WriteError::io(path, e);
    let opaque = rgba.chunks_exact(4).all(|pixel| pixel[3] == 255);
    let colour = if opaque { png::ColorType::Rgb } else { png::ColorType::Rgba };
    write(path, |file| {
        let mut writer =
            encoder(file, size, colour, description).and_then(png::Encoder::write_header).map_err(failed)?;
        if opaque {
            writer.write_image_data(&without_cover(rgba)).map_err(failed)?;
        } else {
            writer.write_image_data(rgba).map_err(failed)?;
        }
        writer.finish().map_err(failed)
    })
}

/// Returns pixels with the colours of `rgb` that cover all behind them: red, green, blue and cover (alpha) of each.
pub fn with_cover(rgb: &[u8]) -> Vec<u8> {
    rgb.chunks_exact(3).flat_map(|pixel| [pixel[0], pixel[1], pixel[2], u8::MAX]).collect()
}

/// Returns the colours of pixels without their cover.
pub(super) fn without_cover(rgba: &[u8]) -> Vec<u8> {
    rgba.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
}

/// The settings by which the light of a picture becomes the picture on a screen.
pub struct Finish<'a> {
    /// The settings by which the light is developed.
    pub develop: Develop,
    /// True where [`fxaa`](brillianteer_picture::fxaa()) smooths the developed picture, which is then held as a whole.
    pub fxaa: bool,
    /// The overlays that are drawn over it.
    pub overlays: &'a [Overlay],
    /// The scene that overlays are drawn from; without it no overlay is drawn.
    pub lit_scene: Option<LitScene<'a>>,
}

impl Finish<'_> {
    /// Develops a picture and draws the overlays over it, some rows at a time; calls `each` with their pixels as
    /// [`develop`](brillianteer_picture::develop()) makes them, from top to bottom.
    ///
    /// # Errors
    /// The errors of `each`, those of reading the light, and [`Stopped`] when `watch` stops the work.
    fn rows(
        &self,
        light: &mut StoredLight,
        watch: Watch,
        each: &mut dyn FnMut(&[u8]) -> Result<(), WriteError>,
    ) -> Result<(), WriteError> {
        let drawing =
            |lit_scene| self.overlays.iter().map(move |&overlay| OverlayDrawing::new(overlay, lit_scene));
        let drawings: Vec<_> = self.lit_scene.as_ref().into_iter().flat_map(drawing).collect();
        let [width, height] = light.size();
        let mut whole = vec![];
        let mut finish = |first, rgba: &mut Vec<u8>| {
            drawings.iter().try_for_each(|drawing| drawing.lay(first, rgba, watch))?;
            each(rgba)
        };
        develop_rows(light, &self.develop, |first, rgba| {
            if watch(f64::from(first) / f64::from(height)).is_break() {
                return Err(WriteError::from(Stopped));
            }
            if self.fxaa {
                whole.append(rgba);
                return Ok(());
            }
            finish(first, rgba)
        })?;
        if self.fxaa {
            fxaa(&mut whole, width);
            finish(0, &mut whole)?;
        }
        Ok(())
    }

    /// Returns the pixels of a finished picture.
    ///
    /// # Errors
    /// Those of reading the light, and [`Stopped`] when `watch` stops the work.
    pub fn pixels(&self, light: &mut StoredLight, watch: Watch) -> Result<Vec<u8>, WriteError> {
        let [width, height] = light.size();
        let mut out = Vec::with_capacity(4 * width as usize * height as usize);
        self.rows(light, watch, &mut |rgba| {
            out.extend_from_slice(rgba);
            Ok(())
        })?;
        Ok(out)
    }

    /// Writes a finished picture as PNG, as [`write_rgba_png`] does. A large one is never held as a whole: its file then
    /// holds no cover where the background is opaque, or where every pixel is covered.
    ///
    /// # Errors
    /// Fails where the file system refuses, or `watch` stops the work.
    pub fn write_png(
        &self,
        path: &Path,
        light: &mut StoredLight,
        description: &str,
        watch: Watch,
    ) -> Result<(), WriteError> {
        let [width, height] = light.size();
        if u64::from(width) * u64::from(height) <= MOST_HELD {
            return write_rgba_png(path, &self.pixels(light, watch)?, (width, height), description);
        }
        let opaque = light.is_covered() || self.develop.background != Background::Transparent;
        let colour = if opaque { png::ColorType::Rgb } else { png::ColorType::Rgba };
        let mut png = PngFile::of_colour(path, (width, height), colour, description)?;
        self.rows(light, watch, &mut |rgba| {
            if opaque { png.push(&without_cover(rgba)) } else { png.push(rgba) }
        })?;
        png.finish()
    }
}

/// Writes a picture as OpenEXR, as it is: premultiplied linear sRGB, in the channels R, G, B and A of 32 bits.
///
/// # Errors
/// Fails where the file system refuses, the light cannot be read, or the picture has no pixels.
#[cfg(feature = "exr")]
pub fn write_linear_exr<L: LightRows>(path: &Path, light: &mut L, description: &str) -> Result<(), WriteError>
where
    WriteError: From<L::Error>,
{
    let [width, height] = light.size();
    let channels = ["R", "G", "B", "A"].map(str::to_owned);
    let size = (width as usize, height as usize);
    let image =
        exr::ExrImage { size, channels: &channels, description, more: None, chromaticities: Some(SRGB) };
    image.write(path, |file| {
        for first in (0..height).step_by(exr::TILE) {
            let rows = light.rows(first..(first + exr::TILE as u32).min(height))?;
            for row in rows.chunks(size.0) {
                file.push(|channel, x| row[x][channel])?;
            }
        }
        Ok(())
    })
}

/// Makes the error of a number of pixels that does not fit the size.
pub(super) fn unfit(pixels: usize, (width, height): (u32, u32)) -> std::io::Error {
    std::io::Error::other(format!("{pixels} pixels are not a picture of {width} by {height}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ::exr::prelude::{MetaData, read_first_rgba_layer_from_file};
    use brillianteer_base::unwatched;
    use brillianteer_picture::{Linear, develop};

    /// A picture that is not made of whole tiles.
    fn picture() -> Linear {
        let pixel = |k: u32| [k as f32 * 0.37 - 1.0, 1e4 / (k + 1) as f32, 1e-7 * k as f32, (k % 2) as f32];
        Linear { width: 137, height: 75, pixels: (0..137 * 75).map(pixel).collect() }
    }

    /// Stores the light of a picture.
    fn stored(picture: &Linear) -> StoredLight {
        let mut light = StoredLight::new([picture.width, picture.height]).unwrap();
        for (y, row) in (0..).zip(picture.pixels.chunks(picture.width as usize)) {
            light.push(y, row).unwrap();
        }
        light
    }

    #[test]
    fn a_picture_too_large_to_be_held_has_the_pixels_of_one_that_is() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let pixel = |k: u32| [1.7, 0.4, 0.1].map(|c| c * (k % 97) as f32 * 0.02);
        for cover in [0.5, 1.0] {
            let pixels = (0..4201 * 1000).map(|k| {
                let [r, g, b] = pixel(k);
                [r, g, b, cover]
            });
            let picture = Linear { width: 4201, height: 1000, pixels: pixels.collect() };
            let finish = Finish { develop: Develop::default(), fxaa: false, overlays: &[], lit_scene: None };
            finish.write_png(&path, &mut stored(&picture), "", &unwatched).unwrap();
            let file = std::io::BufReader::new(std::fs::File::open(&path).unwrap());
            let mut reader = png::Decoder::new(file).read_info().unwrap();
            let mut out = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut out).unwrap();
            let whole = develop(&picture, &finish.develop);
            assert!(out == if cover == 1.0 { without_cover(&whole) } else { whole }, "cover {cover}");
        }
    }

    #[test]
    fn a_linear_picture_reads_back_to_the_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        write_linear_exr(&path, &mut &picture(), "a test").unwrap();
        let image = read_first_rgba_layer_from_file(
            &path,
            |size, _| vec![[0.0_f32; 4]; size.area()],
            |pixels, at, (r, g, b, a): (f32, f32, f32, f32)| pixels[at.y() * 137 + at.x()] = [r, g, b, a],
        );
        assert_eq!(image.unwrap().layer_data.channel_data.pixels, picture().pixels);
        let header = MetaData::read_from_file(&path, true).unwrap().headers.remove(0);
        assert_eq!(header.shared_attributes.chromaticities, Some(SRGB));
        assert_eq!(header.own_attributes.comments.unwrap().to_string(), "a test");
    }

    #[test]
    fn cover_is_written_where_there_is_some() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        for (cover, colour) in [(255, png::ColorType::Rgb), (254, png::ColorType::Rgba)] {
            let rgba: Vec<u8> = (0..6).flat_map(|k| [k, 2 * k, 3 * k, cover.max(250 + k)]).collect();
            write_rgba_png(&path, &rgba, (3, 2), "Zirkon, geschliffen – α").unwrap();
            let mut reader = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(&path).unwrap()))
                .read_info()
                .unwrap();
            let mut out = vec![0; reader.output_buffer_size().unwrap()];
            assert_eq!(reader.next_frame(&mut out).unwrap().color_type, colour);
            let expected = if cover == 255 { without_cover(&rgba) } else { rgba };
            assert_eq!(out, expected);
            assert_eq!(reader.info().utf8_text[0].get_text().unwrap(), "Zirkon, geschliffen – α");
        }
    }

    #[test]
    fn pixels_that_do_not_fit_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        assert!(write_rgba_png(&path, &[0; 12], (2, 2), "").is_err());
        assert!(write_linear_exr(&path, &mut &Linear::new(0, 4), "").is_err());
        let mut missing = StoredLight::new([3, 2]).unwrap();
        missing.push(0, &[[0.0; 4]; 3]).unwrap();
        assert!(write_linear_exr(&path, &mut missing, "").is_err());
        let finish = Finish { develop: Develop::default(), fxaa: false, overlays: &[], lit_scene: None };
        assert!(finish.write_png(&path, &mut missing, "", &unwatched).is_err());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
