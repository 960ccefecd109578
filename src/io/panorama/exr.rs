//! Reads OpenEXR: the first layer with channels R, G and B, of any type; its alpha and all other channels are left
//! out.

use super::{Raw, check_size, damaged};
use crate::io::file_error::Fault;
use crate::io::picture_file::SRGB;
use crate::scene::Panorama;
use exr::meta::MetaData;
use exr::meta::attribute::Chromaticities;
use exr::prelude::{ReadChannels, ReadLayers, Vec2, read as reader};
use std::fs::File;
use std::io::{BufReader, Seek};

/// Primaries whose coordinates differ from those of sRGB by less than this count as sRGB's.
const SAME: f32 = 0.002;

pub(super) fn read(mut file: BufReader<File>, bytes: u64) -> Result<Raw, Fault> {
    let meta = MetaData::read_from_buffered(&mut file, false).map_err(damaged)?;
    file.rewind().map_err(damaged)?;
    // The decoder makes room for one layer only, but reads the tables of all.
    for header in &meta.headers {
        check_size(header.layer_size.width() as u64, header.layer_size.height() as u64, bytes)?;
    }
    let with_colours = |names: &[&str]| {
        meta.headers
            .iter()
            .any(|h| names.iter().all(|name| h.channels.list.iter().any(|c| c.name.eq(name) && !h.deep)))
    };
    if !with_colours(&["R", "G", "B"]) {
        return Err("no layer has channels R, G and B; save it as RGB".into());
    }
    let image = reader()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size: Vec2<usize>, _| (size.width(), vec![[0.0_f32; 3]; size.area()]),
            |(width, pixels), at, (r, g, b): (f32, f32, f32)| {
                if let Some(pixel) = pixels.get_mut(at.y() * *width + at.x()) {
                    *pixel = [r, g, b];
                }
            },
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(file)
        .map_err(damaged)?;
    let warnings = image.attributes.chromaticities.filter(|c| !is_srgb(c)).map(|_| {
        "its primaries are not those of sRGB, but are read as such, so colours will be wrong".to_owned()
    });
    let size = image.layer_data.size;
    let (_, pixels) = image.layer_data.channel_data.pixels;
    let panorama = Panorama { width: size.width() as u32, height: size.height() as u32, pixels };
    Ok((panorama, warnings.into_iter().collect()))
}

fn is_srgb(given: &Chromaticities) -> bool {
    let all = |c: &Chromaticities| [c.red, c.green, c.blue, c.white].map(|Vec2(x, y)| [x, y]);
    let pairs = all(given).into_iter().flatten().zip(all(&SRGB).into_iter().flatten());
    pairs.into_iter().all(|(a, b)| (a - b).abs() < SAME)
}
