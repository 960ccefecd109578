//! What the readers of all formats of pictures share: limits, faults and warnings.

use crate::undecoded::Undecoded;
use brillianteer_base::Fault;
use brillianteer_scene::Panorama;

/// The width and the height of the largest picture that is read, in pixels.
pub const LARGEST: (u32, u32) = (16_384, 8192);

/// The most pixels that a byte of a file can stand for: deflate packs 1032 bytes into one, run lengths and JPEG fewer.
const PIXELS_A_BYTE: u64 = 1100;

/// The number of pixels, 48 MiB of light, that any header may promise, however small the file.
const FREE_PIXELS: u64 = 1 << 22;

/// The primaries and the white of sRGB, as CIE x and y (ITU-R BT.709-6, §1).
const SRGB_PLACES: [[f32; 2]; 4] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06], [0.3127, 0.3290]];

/// Primaries whose coordinates differ by less than this count as the same.
pub const SAME_PLACE: f32 = 0.002;

/// The light of a file, and warnings about the file.
pub type Raw = (Panorama, Vec<String>);

/// Refuses sides out of bounds, and more pixels than `bytes` bytes can hold.
pub fn check_size(width: u64, height: u64, bytes: u64) -> Result<(), Fault> {
    if width == 0 || height == 0 {
        return Err(format!("{width} by {height} pixels: there is no picture in it").into());
    }
    if width > u64::from(LARGEST.0) || height > u64::from(LARGEST.1) {
        let (most_wide, most_high) = LARGEST;
        return Err(format!(
            "{width} by {height} pixels are too many; scale it down to {most_wide} by {most_high} at most"
        )
        .into());
    }
    if width * height > FREE_PIXELS.max(bytes.saturating_mul(PIXELS_A_BYTE)) {
        return Err(format!(
            "{bytes} bytes cannot hold {width} by {height} pixels: the file is damaged; get it again"
        )
        .into());
    }
    Ok(())
}

/// Makes a fault of a file that a decoder gave up on.
pub fn damaged(error: impl Undecoded) -> Fault {
    Fault::whole(format!(
        "this picture cannot be read: {}; get the file again, or save it again as OpenEXR, Radiance HDR, PNG or JPEG",
        error.reason()
    ))
}

/// Returns a warning where primaries and white, as CIE x and y of red, green, blue and white, are not those of sRGB.
pub fn warn_of_primaries(given: [[f32; 2]; 4]) -> Option<String> {
    let pairs = given.as_flattened().iter().zip(SRGB_PLACES.as_flattened());
    let is_srgb = pairs.into_iter().all(|(a, b)| (a - b).abs() < SAME_PLACE);
    (!is_srgb).then(|| {
        "its primaries are not those of sRGB, but are read as such, so colours will be wrong".to_owned()
    })
}
