//! Reads refraction maps back for the tests.
#![cfg(feature = "exr")]
#![allow(clippy::unwrap_used, reason = "a test fails by it")]

use brillianteer_optics::linear_from_encoded;
use brillianteer_picture::{Linear, MapBand, RefractionMap, SourcePlace};
use exr::meta::attribute::AttributeValue;
use exr::prelude::{ReadChannels, ReadLayers};
use glam::{DMat3, DVec2};
use std::path::{Path, PathBuf};

/// The keyword under which a map describes its bands.
const ABOUT: &str = "Refraction";

/// The description of a band in a file.
#[derive(serde::Deserialize)]
struct About {
    nm: f64,
    response: [[f64; 3]; 3],
}

impl About {
    fn band(self, places: Vec<SourcePlace>) -> MapBand {
        MapBand { nm: self.nm, response: DMat3::from_cols_array_2d(&self.response), places }
    }
}

/// The pixels of a PNG as they stand in the file, and the description of its band.
struct Decoded {
    size: [u32; 2],
    kind: (png::ColorType, png::BitDepth),
    data: Vec<u8>,
    about: Option<String>,
}

/// Reads the places of a map, in any coding, and its diffuse layer.
pub fn read(places: &[PathBuf], diffuse: &Path) -> RefractionMap {
    let Decoded { size: [width, height], kind, data, .. } = decoded(diffuse);
    assert_eq!(kind, (png::ColorType::Rgba, png::BitDepth::Eight));
    let diffuse = Linear { width, height, pixels: data.chunks_exact(4).map(light).collect() };
    let bands = places.iter().flat_map(|path| match path.extension().is_some_and(|ending| ending == "exr") {
        true => of_exr(path),
        false => vec![of_png(path, &diffuse)],
    });
    RefractionMap { size: [width, height], bands: bands.collect(), diffuse }
}

/// Returns the place of a code of the tiles, by the formula of docs/formats.md.
pub fn place([red, green, blue]: [u8; 3]) -> DVec2 {
    let part = |fine: u8, tile: u8| (16.0 * f64::from(fine) / 255.0 + 16.0 * f64::from(tile)) / 255.0;
    DVec2::new(part(red, blue >> 4), part(green, blue & 15))
}

fn decoded(path: &Path) -> Decoded {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut decoder = png::Decoder::new(file);
    decoder.set_transformations(png::Transformations::IDENTITY);
    let mut reader = decoder.read_info().unwrap();
    let mut data = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut data).unwrap();
    // Texts may follow the pixels.
    reader.finish().unwrap();
    let info = reader.info();
    let text = info.utf8_text.iter().find(|text| text.keyword == ABOUT);
    let about = text.map(|text| text.get_text().unwrap());
    Decoded { size: [info.width, info.height], kind: (info.color_type, info.bit_depth), data, about }
}

/// Returns the premultiplied linear light of a pixel of the diffuse layer.
fn light(code: &[u8]) -> [f32; 4] {
    let part = |k: usize| f64::from(code[k]) / 255.0;
    let [r, g, b] = [0, 1, 2].map(|k| (linear_from_encoded(part(k)) * part(3)) as f32);
    [r, g, b, part(3) as f32]
}

fn of_png(path: &Path, diffuse: &Linear) -> MapBand {
    let Decoded { size: [width, height], kind, data, about } = decoded(path);
    let about: About = serde_json::from_str(&about.unwrap()).unwrap();
    if kind == (png::ColorType::Rgb, png::BitDepth::Sixteen) {
        let part = |c: &[u8], k: usize| f32::from(u16::from_be_bytes([c[k], c[k + 1]])) / 65_535.0;
        let place = |c: &[u8]| SourcePlace { u: part(c, 0), v: part(c, 2), weight: part(c, 4) };
        return about.band(data.chunks_exact(6).map(place).collect());
    }
    assert_eq!(kind, (png::ColorType::Rgb, png::BitDepth::Eight));
    assert!(width == diffuse.width && (height == diffuse.height || height == 2 * diffuse.height));
    let has_weights = height == 2 * diffuse.height;
    let (codes, weights) = data.split_at(3 * diffuse.pixels.len());
    let own = weights.chunks_exact(3).map(|grey| f32::from(grey[0]) / 255.0);
    let left = diffuse.pixels.iter().filter(|_| !has_weights).map(|light| 1.0 - light[3]);
    let tiled = |(code, weight): (&[u8], f32)| {
        let at = place([code[0], code[1], code[2]]);
        SourcePlace { u: at.x as f32, v: at.y as f32, weight }
    };
    about.band(codes.chunks_exact(3).zip(own.chain(left)).map(tiled).collect())
}

fn of_exr(path: &Path) -> Vec<MapBand> {
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_file(path)
        .unwrap();
    let layer = image.layer_data;
    let text = layer.attributes.other.iter().find(|(name, _)| **name == *ABOUT).map(|(_, value)| value);
    let Some(AttributeValue::Text(text)) = text else { panic!("no description of bands") };
    let abouts: Vec<About> = serde_json::from_str(&text.to_string()).unwrap();
    let count = abouts.len();
    let values = |band: usize, part: &str| -> Vec<f32> {
        let name = if count == 1 { part.to_owned() } else { format!("{:02}.{part}", band + 1) };
        let found = layer.channel_data.list.iter().find(|channel| channel.name.eq(name.as_str()));
        found.unwrap().sample_data.values_as_f32().collect()
    };
    let band = |(k, about): (usize, About)| {
        let [u, v, weight] = ["u", "v", "weight"].map(|part| values(k, part));
        let place = |((u, v), weight): ((f32, f32), f32)| SourcePlace { u, v, weight };
        about.band(u.into_iter().zip(v).zip(weight).map(place).collect())
    };
    abouts.into_iter().enumerate().map(band).collect()
}
