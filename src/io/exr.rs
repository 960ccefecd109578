//! Writes OpenEXR: what every pixel holds, in floating point, with a channel for each part of the light.

use super::atomic::{WriteError, write};
use crate::picture::{Layer, paint};
use crate::scene::Film;
use crate::trace::Watch;
use exr::image::write::layers::WritableLayers;
use exr::meta::attribute::{AttributeValue, Chromaticities};
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, ImageAttributes, Layer as ExrLayer,
    LayerAttributes, LineOrder, Text, WritableImage,
};
use smallvec::SmallVec;
use std::path::Path;

/// Paints a layer and writes its channels, as 32-bit numbers that are linear in energy.
///
/// # Errors
/// When the file system refuses, or `watch` asks to stop.
pub fn write_exr(
    path: &Path,
    layer: &Layer,
    film: &Film,
    description: &str,
    watch: Watch,
) -> Result<(), WriteError> {
    let size = (film.size[0] as usize, film.size[1] as usize);
    let pixels = size.0 * size.1;
    let mut channels: Vec<Vec<f32>> = layer.channels.iter().map(|_| Vec::with_capacity(pixels)).collect();
    paint(layer, film, watch, |rows| -> Result<(), WriteError> {
        for y in rows.first..rows.first + rows.count {
            for (c, channel) in channels.iter_mut().enumerate() {
                channel.extend(rows.row(y, c).iter().map(|&v| v as f32));
            }
        }
        Ok(())
    })?;
    let named = layer.channels.iter().zip(channels);
    let list: SmallVec<[AnyChannel<FlatSamples>; 4]> =
        named.map(|(name, values)| AnyChannel::new(name.as_str(), FlatSamples::F32(values))).collect();
    write_channels(path, size, list, (description, None))
}

/// Writes an image as of [`image()`] from channels that are held one by one.
pub(super) fn write_channels(
    path: &Path,
    size: (usize, usize),
    channels: SmallVec<[AnyChannel<FlatSamples>; 4]>,
    texts: (&str, Option<(&str, &str)>),
) -> Result<(), WriteError> {
    write_image(path, &image(size, AnyChannels::sort(channels), texts, None))
}

/// Makes an image of one layer, `light`, with these channels, a description, and another text under a name of its own.
pub(super) fn image<C>(
    size: (usize, usize),
    channels: C,
    (description, more): (&str, Option<(&str, &str)>),
    chromaticities: Option<Chromaticities>,
) -> Image<ExrLayer<C>> {
    let mut attributes = LayerAttributes::named("light");
    attributes.comments = Text::new_or_none(description);
    attributes.software_name = Text::new_or_none("Brillianteer");
    let more = more.and_then(|(name, text)| {
        Some((Text::new_or_none(name)?, AttributeValue::Text(Text::new_or_none(text)?)))
    });
    attributes.other.extend(more);
    // In any other order the threads' race would decide where in the file a tile lies.
    let encoding = Encoding { line_order: LineOrder::Increasing, ..Encoding::FAST_LOSSLESS };
    let layer_data = ExrLayer { channel_data: channels, attributes, size: size.into(), encoding };
    let mut attributes = ImageAttributes::with_size(size);
    attributes.chromaticities = chromaticities;
    Image { attributes, layer_data }
}

/// Writes an image, whole or not at all.
pub(super) fn write_image<'i, C>(path: &Path, image: &'i Image<ExrLayer<C>>) -> Result<(), WriteError>
where
    ExrLayer<C>: WritableLayers<'i>,
{
    write(path, |file| {
        image.write().to_buffered(file).map_err(|e| match e {
            exr::error::Error::Io(e) => WriteError::io(path, e),
            other => WriteError::io(path, std::io::Error::other(other)),
        })
    })
}
