//! Reads refraction maps.

use super::{ABOUT, About, Coding, MOST_BANDS, MOST_PIXELS, channel, diffuse_of, tiles};
use crate::io::file_error::{Fault, FileError};
use crate::io::text::read_bytes;
use crate::picture::{Linear, MapBand, RefractionMap, SourcePlace};
use exr::meta::MetaData;
use exr::meta::attribute::AttributeValue;
use exr::prelude::{ReadChannels, ReadLayers, read as reader};
use png::{BitDepth, ColorType, Decoder, Limits, Transformations};
use std::io::Cursor;
use std::path::{Path, PathBuf};

/// The size of the largest file that is read, in bytes: more than any map of a page or a film needs.
const MOST_BYTES: u64 = 1 << 30;

/// The number of pixels that any file may promise. Beyond, a byte must not stand for more pixels than deflate can make of
/// it.
const FREE_PIXELS: u64 = 1 << 20;
const PIXELS_A_BYTE: u64 = 1100;

/// The description of a band in a map that has none: all light, at the middle of what is seen.
const ALL_LIGHT: About = About { nm: 555.0, response: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };

/// Reads a map: its places, from one PNG for each band, all in one coding, or from an OpenEXR; and its diffuse layer.
///
/// A single PNG from another program, which does not describe its band, is taken for all light.
///
/// # Errors
/// When a file is no map that can be read; the error names the file and what to do.
pub fn read(places: &[PathBuf], diffuse: &Path) -> Result<RefractionMap, FileError> {
    let layer = read_diffuse(diffuse).map_err(|fault| fault.in_file(diffuse.display()))?;
    let size = [layer.width, layer.height];
    let mut map = RefractionMap { size, bands: Vec::new(), diffuse: layer };
    for path in places {
        let bands = bands(path, &map.diffuse, places.len() > 1);
        map.bands.extend(bands.map_err(|fault| fault.in_file(path.display()))?);
    }
    if map.bands.is_empty() || map.bands.len() > MOST_BANDS as usize {
        let count = map.bands.len();
        let problem = format!("{count} maps beside it; give 1 to {MOST_BANDS}");
        return Err(FileError::new(diffuse.display(), problem));
    }
    Ok(map)
}

fn bands(path: &Path, diffuse: &Layer, must_tell: bool) -> Result<Vec<MapBand>, Fault> {
    let bytes = read_bytes(path, MOST_BYTES)?;
    let found = if bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01]) {
        float(&bytes)?
    } else {
        png_band(&bytes, diffuse, must_tell)?
    };
    match found {
        (size, _) if size != [diffuse.width, diffuse.height] => Err(format!(
            "{} by {} pixels, and its diffuse layer has {} by {}; give files of one map",
            size[0], size[1], diffuse.width, diffuse.height
        )
        .into()),
        (_, bands) => Ok(bands),
    }
}

type Layer = Linear;
type Found = ([u32; 2], Vec<MapBand>);

/// Refuses sides out of bounds, and more pixels than so many bytes can hold.
fn check([width, height]: [u64; 2], bytes: usize) -> Result<[u32; 2], Fault> {
    let most = u64::from(MOST_PIXELS);
    // With weights below its places, a map is twice as high.
    if width == 0 || height == 0 || width > most || height > 2 * most {
        return Err(format!("{width} by {height} pixels; a map has 1 to {MOST_PIXELS} each way").into());
    }
    if width * height > FREE_PIXELS.max((bytes as u64).saturating_mul(PIXELS_A_BYTE)) {
        return Err(format!("{bytes} bytes cannot hold {width} by {height} pixels: get the file anew").into());
    }
    Ok([width as u32, height as u32])
}

fn damaged(error: impl std::fmt::Display) -> Fault {
    Fault::whole(format!("cannot be decoded ({error}); get the file anew"))
}

/// The pixels of a PNG as they stand in the file, and the description of its band.
struct Pixels {
    size: [u32; 2],
    kind: (ColorType, BitDepth),
    data: Vec<u8>,
    about: Option<String>,
}

fn pixels(bytes: &[u8]) -> Result<Pixels, Fault> {
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: 1 << 28 });
    decoder.set_transformations(Transformations::IDENTITY);
    let mut reader = decoder.read_info().map_err(|error| {
        Fault::whole(format!(
            "this is not a PNG or OpenEXR of a refraction map ({error}); write it anew by `refraction-map`"
        ))
    })?;
    let size = check([reader.info().width.into(), reader.info().height.into()], bytes.len())?;
    let length = reader.output_buffer_size().ok_or("too many pixels")?;
    let mut data = vec![0; length];
    reader.next_frame(&mut data).map_err(damaged)?;
    // Texts may follow the pixels.
    reader.finish().map_err(damaged)?;
    let info = reader.info();
    let text = info.utf8_text.iter().find(|text| text.keyword == ABOUT);
    let about = text.map(png::text_metadata::ITXtChunk::get_text).transpose().map_err(damaged)?;
    Ok(Pixels { size, kind: (info.color_type, info.bit_depth), data, about })
}

fn read_diffuse(path: &Path) -> Result<Layer, Fault> {
    let Pixels { size: [width, height], kind, data, .. } = pixels(&read_bytes(path, MOST_BYTES)?)?;
    if kind != (ColorType::Rgba, BitDepth::Eight) {
        return Err(format!("{kind:?}: a diffuse layer is RGBA of 8 bits").into());
    }
    Ok(Linear { width, height, pixels: data.chunks_exact(4).map(diffuse_of).collect() })
}

fn png_band(bytes: &[u8], diffuse: &Layer, must_tell: bool) -> Result<Found, Fault> {
    let Pixels { mut size, kind, data, about } = pixels(bytes)?;
    let coding = match kind {
        (ColorType::Rgb, BitDepth::Eight) => Coding::Tiles,
        (ColorType::Rgb, BitDepth::Sixteen) => Coding::Sixteen,
        _ => return Err(format!("{kind:?}: a map is RGB of 8 or 16 bits").into()),
    };
    let about = match about {
        Some(text) => checked(serde_json::from_str(&text).map_err(|e| unreadable(&e))?)?,
        None if must_tell => {
            return Err(format!("it lacks the text `{ABOUT}`, which holds its wavelength").into());
        }
        None => ALL_LIGHT,
    };
    let places = match coding {
        Coding::Tiles => {
            // Of several bands, each brings its weights, below its places.
            let has_weights = size[1] == 2 * diffuse.height;
            size[1] /= 1 + u32::from(has_weights);
            let (codes, weights) = data.split_at(3 * size[0] as usize * size[1] as usize);
            let own = weights.chunks_exact(3).map(|grey| f32::from(grey[0]) / 255.0);
            let left = diffuse.pixels.iter().filter(|_| !has_weights).map(|light| 1.0 - light[3]);
            let tiled = |(code, weight): (&[u8], f32)| {
                let at = tiles::place([code[0], code[1], code[2]]);
                SourcePlace { u: at.x as f32, v: at.y as f32, weight }
            };
            codes.chunks_exact(3).zip(own.chain(left)).map(tiled).collect()
        }
        _ => {
            let part = |c: &[u8], k: usize| f32::from(u16::from_be_bytes([c[k], c[k + 1]])) / 65_535.0;
            let place = |c: &[u8]| SourcePlace { u: part(c, 0), v: part(c, 2), weight: part(c, 4) };
            data.chunks_exact(6).map(place).collect()
        }
    };
    Ok((size, vec![about.band(places)]))
}

fn unreadable(error: &serde_json::Error) -> Fault {
    Fault::whole(format!(
        "its text `{ABOUT}` cannot be read ({error}); write the map anew by `refraction-map`"
    ))
}

fn checked(about: About) -> Result<About, Fault> {
    let is_sane = |value: &f64| value.abs() <= 1e4;
    if about.response.iter().flatten().chain([&about.nm]).all(is_sane) {
        return Ok(about);
    }
    Err(format!(
        "its text `{ABOUT}` holds numbers that no band can have; write the map anew by `refraction-map`"
    )
    .into())
}

fn float(bytes: &[u8]) -> Result<Found, Fault> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(damaged)?;
    for header in &meta.headers {
        check([header.layer_size.width() as u64, header.layer_size.height() as u64], bytes.len())?;
        if header.channels.list.len() > 3 * MOST_BANDS as usize {
            return Err(format!(
                "{} channels; a map has {} at most",
                header.channels.list.len(),
                3 * MOST_BANDS
            )
            .into());
        }
    }
    let image = reader()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(damaged)?;
    let layer = image.layer_data;
    let text = layer.attributes.other.iter().find(|(name, _)| **name == *ABOUT).map(|(_, value)| value);
    let abouts: Vec<About> = match text {
        Some(AttributeValue::Text(text)) => {
            serde_json::from_str(&text.to_string()).map_err(|e| unreadable(&e))?
        }
        _ => vec![ALL_LIGHT],
    };
    let values = |band: usize, part: &str| -> Result<Vec<f32>, Fault> {
        let name = channel(abouts.len(), band, part);
        let found = layer.channel_data.list.iter().find(|c| c.name.eq(name.as_str()));
        let found = found.ok_or_else(|| format!("it has no channel `{name}`"))?;
        Ok(found.sample_data.values_as_f32().collect())
    };
    let band = |(k, about): (usize, About)| {
        let [u, v, weight] = [values(k, "u")?, values(k, "v")?, values(k, "weight")?];
        // A place that is no number has no weight: nothing comes from behind.
        let place = |((u, v), weight): ((f32, f32), f32)| match u.is_finite() && v.is_finite() {
            true => SourcePlace { u, v, weight: weight.clamp(0.0, 1.0).max(0.0) },
            false => SourcePlace::default(),
        };
        Ok(checked(about)?.band(u.into_iter().zip(v).zip(weight).map(place).collect()))
    };
    let bands = abouts.iter().copied().enumerate().map(band).collect::<Result<Vec<_>, Fault>>()?;
    Ok(([layer.size.width() as u32, layer.size.height() as u32], bands))
}
