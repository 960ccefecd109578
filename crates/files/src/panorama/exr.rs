//! Reads OpenEXR: the colours of a layer, of any type, or its luminance, within the display window; alpha and all other
//! channels are left out.

use super::exr_layer::{ColourLayer, Colours, OfPart};
use super::shared::{Raw, check_size, damaged, warn_of_primaries};
use brillianteer_base::Fault;
use brillianteer_scene::Panorama;
use exr::math::Vec2;
use exr::meta::MetaData;
use exr::meta::header::Header;
use exr::prelude::{ReadChannels, ReadLayers, ReadSpecificChannel, read as reader};
use std::fs::File;
use std::io::{BufReader, Seek};

/// The luminance of red, green and blue of sRGB's primaries, by which luminance and chroma are packed (ITU-R BT.709-6, §3).
const LUMINANCE: [f32; 3] = [0.2126, 0.7152, 0.0722];

pub(super) fn read(mut file: BufReader<File>, bytes: u64) -> Result<Raw, Fault> {
    let meta = MetaData::read_from_buffered(&mut file, false).map_err(damaged)?;
    file.rewind().map_err(damaged)?;
    check_sampling(&meta.headers)?;
    // The decoder makes room for one layer only, but reads the tables of all.
    for header in &meta.headers {
        check_size(header.layer_size.width() as u64, header.layer_size.height() as u64, bytes)?;
    }
    let ColourLayer { header, colours, mut warnings } = ColourLayer::of(&meta.headers)?;
    let window = header.shared_attributes.display_window.size;
    check_size(window.width() as u64, window.height() as u64, bytes)?;
    let chromaticities = header.shared_attributes.chromaticities;
    let places =
        chromaticities.as_ref().map(|of| [of.red, of.green, of.blue, of.white].map(|Vec2(x, y)| [x, y]));
    warnings.extend(places.and_then(warn_of_primaries));
    let (panorama, cut) = in_window(header, pixels(file, header, &colours)?);
    warnings.extend(cut);
    Ok((panorama, warnings))
}

/// Refuses channels with fewer samples than pixels, which the decoder does not read, also where the picture has none of them.
fn check_sampling(headers: &[Header]) -> Result<(), Fault> {
    let channels = || headers.iter().flat_map(|header| &header.channels.list);
    let is_sparse = |Vec2(x, y): Vec2<usize>| x > 1 || y > 1;
    let Some(first) = channels().find(|channel| is_sparse(channel.sampling)) else { return Ok(()) };
    let Vec2(across, down) = first.sampling;
    let others = channels().filter(|channel| is_sparse(channel.sampling)).count() - 1;
    let others = match others {
        0 => String::new(),
        1 => ", and 1 more channel has too few".to_owned(),
        _ => format!(", and {others} more channels have too few"),
    };
    let name = first.name.to_string();
    Err(Fault::whole(format!(
        "its channel '{name:.60}' has one sample for {across} by {down} pixels{others}: such channels are not read; save it as RGB, with all \
         channels of full size"
    )))
}

/// The width of a layer and its pixels, row by row from the top.
type Pixels = (usize, Vec<[f32; 3]>);

/// Decodes the pixels of these channels of a part.
fn pixels(file: BufReader<File>, header: &Header, colours: &Colours) -> Result<Vec<[f32; 3]>, Fault> {
    let channels = reader().no_deep_data().largest_resolution_level().specific_channels();
    let room = |size: Vec2<usize>| (size.width(), vec![[0.0_f32; 3]; size.area()]);
    match colours {
        Colours::Three { names: [a, b, c], are_chroma } => {
            let are_chroma = *are_chroma;
            let three = channels.required(a.clone()).required(b.clone()).required(c.clone());
            let channels = three.collect_pixels(
                move |size, _| room(size),
                move |pixels: &mut Pixels, at, (a, b, c): (f32, f32, f32)| {
                    put(pixels, at, if are_chroma { of_chroma(a, b, c) } else { [a, b, c] });
                },
            );
            let part = OfPart { header: header.clone(), channels };
            let image = part.first_valid_layer().all_attributes().from_buffered(file).map_err(damaged)?;
            Ok(image.layer_data.channel_data.pixels.1)
        }
        Colours::Luminance(name) => {
            let channels = channels.required(name.clone()).collect_pixels(
                move |size, _| room(size),
                |pixels: &mut Pixels, at, (y,): (f32,)| put(pixels, at, [y; 3]),
            );
            let part = OfPart { header: header.clone(), channels };
            let image = part.first_valid_layer().all_attributes().from_buffered(file).map_err(damaged)?;
            Ok(image.layer_data.channel_data.pixels.1)
        }
    }
}

fn put((width, pixels): &mut Pixels, at: Vec2<usize>, pixel: [f32; 3]) {
    if let Some(place) = pixels.get_mut(at.y() * *width + at.x()) {
        *place = pixel;
    }
}

/// Returns red, green and blue of a luminance Y and of (R − Y)/Y and (B − Y)/Y, the chroma of OpenEXR.
fn of_chroma(y: f32, ry: f32, by: f32) -> [f32; 3] {
    let (red, blue) = ((ry + 1.0) * y, (by + 1.0) * y);
    [red, (y - LUMINANCE[0] * red - LUMINANCE[2] * blue) / LUMINANCE[1], blue]
}

/// Puts the pixels of the data window at their place in the display window, which is the picture; warns where some of it
/// holds no data, and is dark.
fn in_window(header: &Header, data: Vec<[f32; 3]>) -> (Panorama, Option<String>) {
    let window = header.shared_attributes.display_window;
    let [width, height] = [window.size.width(), window.size.height()];
    let [across, down] = [header.layer_size.width(), header.layer_size.height()];
    // Positions are of 32 bits, so that their differences fit into 64.
    let at = |layer: i32, window: i32| i64::from(layer) - i64::from(window);
    let left = at(header.own_attributes.layer_position.x(), window.position.x());
    let top = at(header.own_attributes.layer_position.y(), window.position.y());
    let of = |pixels| Panorama { width: width as u32, height: height as u32, pixels };
    if [left, top] == [0, 0] && [across, down] == [width, height] {
        return (of(data), None);
    }
    let mut pixels = vec![[0.0; 3]; width * height];
    let mut held = 0;
    for (y, row) in (top..).zip(data.chunks_exact(across)) {
        let Some(y) = usize::try_from(y).ok().filter(|y| *y < height) else { continue };
        for (x, pixel) in (left..).zip(row) {
            if let Some(x) = usize::try_from(x).ok().filter(|x| *x < width) {
                pixels[y * width + x] = *pixel;
                held += 1;
            }
        }
    }
    let warning = (held < width * height).then(|| {
        format!(
            "its data, {across} by {down} pixels, cover {:.3} % of the picture of {width} by {height} pixels; the rest is dark",
            100.0 * held as f64 / (width * height) as f64
        )
    });
    debug_assert_eq!(data.len(), across * down);
    (of(pixels), warning)
}
