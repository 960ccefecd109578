//! Encodes pixels as a PNG file in memory, as small as the format makes them.

use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, SrgbRenderingIntent};

/// Encodes rows of `data` as PNG with these texts, each a keyword and a text; RGBA is marked as sRGB.
pub(super) fn png(
    [width, height]: [u32; 2],
    (colour, depth): (ColorType, BitDepth),
    data: &[u8],
    texts: &[(&str, &str)],
) -> Result<Vec<u8>, EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    encoder.set_compression(Compression::High);
    if colour == ColorType::Rgba {
        encoder.set_source_srgb(SrgbRenderingIntent::RelativeColorimetric);
    }
    encoder.add_text_chunk("Software".into(), "Brillianteer".into())?;
    for (keyword, text) in texts {
        encoder.add_itxt_chunk((*keyword).into(), (*text).into())?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(data)?;
    writer.finish()?;
    Ok(bytes)
}
