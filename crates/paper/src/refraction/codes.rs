//! Reads the numbers of a picture unchanged, without a conversion to light: PNG and OpenEXR.

use super::{ABOUT, MOST_MAP_PIXELS};
use brillianteer_base::Fault;
use brillianteer_files::Undecoded;
use brillianteer_files::panorama::check_size;
use brillianteer_files::text::unreadable;
use exr::image::{AnyChannel, FlatSamples};
use exr::meta::MetaData;
use exr::meta::attribute::AttributeValue;
use exr::prelude::{ReadChannels, ReadLayers};
use png::{BitDepth, ColorType, Limits, Transformations};
use std::fs::File;
use std::io::{BufReader, Read, Seek};
use std::path::Path;

/// The first bytes of an OpenEXR file.
const EXR: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// The most bytes that the decoder of a PNG may ask for besides its pixels.
const MOST_BYTES: usize = 1 << 26;

/// The most numbers that an OpenEXR may hold, in all its layers and channels, because all are decoded: as many as the
/// largest map has.
const MOST_SAMPLES: u64 = 3 * super::MOST_MAP_BANDS as u64 * (MOST_MAP_PIXELS as u64).pow(2);

/// The numbers of a picture.
pub(super) struct Codes {
    /// The number of pixels across and down.
    pub size: [u32; 2],
    /// The channels of each band: red, green and blue, or u, v and weight; `size[0]` times `size[1]` of them each.
    pub bands: Vec<Vec<[f32; 3]>>,
    /// The alpha, where the file has one.
    pub alpha: Option<Vec<f32>>,
    /// The number of bits of a channel.
    pub bits: u8,
    /// True for OpenEXR, whose colours are linear and premultiplied by the alpha.
    pub is_exr: bool,
    /// The description of the bands in the program's own maps.
    pub about: Option<String>,
}

/// Reads a picture.
///
/// # Errors
/// Fails where the file is no picture that can be read, or too large for a map; the fault says what to do.
pub(super) fn read(path: &Path) -> Result<Codes, Fault> {
    let about = path.metadata().map_err(unreadable)?;
    if !about.is_file() {
        return Err("this is not a file; give a PNG or OpenEXR picture".into());
    }
    let mut file = BufReader::new(File::open(path).map_err(unreadable)?);
    let mut start = Vec::new();
    file.by_ref().take(4).read_to_end(&mut start).and_then(|_| file.rewind()).map_err(unreadable)?;
    match start.as_slice() {
        b"\x89PNG" => of_png(file, about.len()),
        start if start == EXR => of_exr(file, about.len()),
        _ => Err("this is neither PNG nor OpenEXR, the formats that keep numbers as they are; save it as one of these"
            .into()),
    }
}

/// Refuses a picture that is too large for a map, or promises more than its bytes hold. Its height may be doubled by
/// weights below the places.
fn check(width: u64, height: u64, bytes: u64) -> Result<(), Fault> {
    let most = u64::from(MOST_MAP_PIXELS);
    if width > most || height > 2 * most {
        return Err(format!("{width} by {height} pixels: a map has {most} pixels each way at most").into());
    }
    check_size(width, height, bytes)
}

/// Returns how many of the numbers that a file may hold are left after a layer.
fn less_samples(left: u64, pixels: u64, channels: u64) -> Result<u64, Fault> {
    left.checked_sub(pixels.saturating_mul(channels)).ok_or_else(|| {
        format!("{pixels} pixels in {channels} channels are too many numbers; save the map's channels alone")
            .into()
    })
}

fn damaged(error: impl Undecoded) -> Fault {
    Fault::whole(format!(
        "this picture cannot be read: {}; get the file again, or save it again as PNG or OpenEXR",
        error.reason()
    ))
}

fn of_png(file: BufReader<File>, bytes: u64) -> Result<Codes, Fault> {
    let mut decoder = png::Decoder::new_with_limits(file, Limits { bytes: MOST_BYTES });
    decoder.set_transformations(Transformations::EXPAND);
    let info = decoder.read_header_info().map_err(damaged)?;
    let size = [info.width, info.height];
    check(u64::from(size[0]), u64::from(size[1]), bytes)?;
    let mut reader = decoder.read_info().map_err(damaged)?;
    let room = reader.output_buffer_size().ok_or_else(|| damaged("it is too large"))?;
    let mut data = vec![0; room];
    let frame = reader.next_frame(&mut data).map_err(damaged)?;
    // Texts may follow the pixels; a fault behind them does no harm.
    let _ = reader.finish();
    let text = reader.info().utf8_text.iter().find(|text| text.keyword == ABOUT);
    let about = text.and_then(|text| text.get_text().ok());
    let values: Vec<f32> = match frame.bit_depth {
        BitDepth::Sixteen => {
            data.as_chunks().0.iter().map(|&c| f32::from(u16::from_be_bytes(c)) / 65_535.0).collect()
        }
        _ => data.iter().map(|&c| f32::from(c) / 255.0).collect(),
    };
    let colours: fn(&[f32]) -> [f32; 3] = match frame.color_type {
        ColorType::Rgb | ColorType::Rgba => |pixel| [pixel[0], pixel[1], pixel[2]],
        _ => return Err("the picture is grey; a map is in red, green and blue, so save it as RGB".into()),
    };
    let each = frame.color_type.samples();
    let has_alpha = frame.color_type == ColorType::Rgba;
    Ok(Codes {
        size,
        bands: vec![values.chunks_exact(each).map(colours).collect()],
        alpha: has_alpha.then(|| values.chunks_exact(each).map(|pixel| pixel[3]).collect()),
        bits: if frame.bit_depth == BitDepth::Sixteen { 16 } else { 8 },
        is_exr: false,
        about,
    })
}

fn of_exr(mut file: BufReader<File>, bytes: u64) -> Result<Codes, Fault> {
    let meta = MetaData::read_from_buffered(&mut file, false).map_err(damaged)?;
    file.rewind().map_err(damaged)?;
    let mut left = MOST_SAMPLES;
    for header in &meta.headers {
        let [width, height] = [header.layer_size.width(), header.layer_size.height()].map(|side| side as u64);
        check(width, height, bytes)?;
        left = less_samples(left, width * height, header.channels.list.len() as u64)?;
    }
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_buffered(file)
        .map_err(damaged)?;
    let is_map = |layer: &&ReadLayer| has_colours(layer) || layer.channel_data.list.iter().any(is_own);
    let Some(layer) = image.layer_data.iter().find(is_map) else {
        return Err("no layer has channels R, G and B; save it as RGB".into());
    };
    let count = layer.size.area();
    let about = layer.attributes.other.iter().find(|(name, _)| **name == *ABOUT).map(|(_, value)| value);
    let about = about.and_then(|value| match value {
        AttributeValue::Text(text) => Some(text.to_string()),
        _ => None,
    });
    let all = ["u", "v", "weight"].map(str::to_owned);
    let colours = ["R", "G", "B"].map(str::to_owned);
    let numbered = |band: u32| ["u", "v", "weight"].map(|part| format!("{band:02}.{part}"));
    let mut bands: Vec<_> =
        [colours, all].into_iter().find_map(|names| channels(layer, names, count)).into_iter().collect();
    if bands.is_empty() {
        bands.extend((1..=super::MOST_MAP_BANDS).map_while(|band| channels(layer, numbered(band), count)));
    }
    if bands.is_empty() {
        return Err(
            "a channel of the map is missing or has other pixels than the picture; get it again".into()
        );
    }
    let alpha = named(layer, "A").map(|channel| channel.sample_data.values_as_f32().collect::<Vec<_>>());
    let size = [layer.size.width() as u32, layer.size.height() as u32];
    Ok(Codes { size, bands, alpha: alpha.filter(|a| a.len() == count), bits: 32, is_exr: true, about })
}

/// A layer of OpenEXR as it was read.
type ReadLayer = exr::image::Layer<exr::image::AnyChannels<FlatSamples>>;

fn has_colours(layer: &ReadLayer) -> bool {
    ["R", "G", "B"].iter().all(|name| named(layer, name).is_some())
}

/// Returns whether a channel is one of the program's own maps.
fn is_own(channel: &AnyChannel<FlatSamples>) -> bool {
    let name = channel.name.to_string();
    name == "weight" || name.ends_with(".weight")
}

/// Returns the channel of a name. That of a colour may follow the name of a layer: renderers write `ViewLayer.Combined.R`.
fn named<'a>(layer: &'a ReadLayer, name: &str) -> Option<&'a AnyChannel<FlatSamples>> {
    let is_colour = name.len() == 1 && name != "u" && name != "v";
    layer.channel_data.list.iter().find(|channel| {
        let full = channel.name.to_string();
        full == name || (is_colour && full.strip_suffix(name).is_some_and(|before| before.ends_with('.')))
    })
}

/// Returns three channels, pixel by pixel; `None` where one is missing or has not `count` pixels.
fn channels(layer: &ReadLayer, names: [String; 3], count: usize) -> Option<Vec<[f32; 3]>> {
    let values = |name: &String| -> Option<Vec<f32>> {
        let found: Vec<f32> = named(layer, name)?.sample_data.values_as_f32().collect();
        (found.len() == count).then_some(found)
    };
    let (a, b, c) = (values(&names[0])?, values(&names[1])?, values(&names[2])?);
    Some(a.into_iter().zip(b).zip(c).map(|((a, b), c)| [a, b, c]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_and_channels_count_together_against_the_most_numbers_of_a_file() {
        let pixels = u64::from(MOST_MAP_PIXELS).pow(2);
        let left = less_samples(MOST_SAMPLES, pixels, 47).unwrap();
        assert_eq!(less_samples(left, pixels, 1).unwrap(), 0);
        assert!(less_samples(left, pixels, 2).is_err());
        assert!(less_samples(MOST_SAMPLES, u64::MAX, 1000).is_err());
    }
}
