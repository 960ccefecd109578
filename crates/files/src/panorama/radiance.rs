//! Reads Radiance HDR. The crate `image` decodes the pixels; this reads the header, whose lines it leaves aside: the order of
//! the pixels, the kind of colours, and the factors by which the light was multiplied.
//!
//! Source: G. Ward, *Radiance File Formats*, and `color.h` and `resolu.h` of Radiance, for the meaning of the header.

use super::raster::{decoder_limits, light};
use super::shared::{Raw, SAME_PLACE, check_size, damaged, warn_of_primaries};
use brillianteer_base::Fault;
use brillianteer_optics::SRGB_FROM_XYZ;
use brillianteer_scene::Panorama;
use glam::{DMat3, DVec3};
use image::codecs::hdr::HdrDecoder;
use image::{DynamicImage, ImageDecoder};
use std::io::{BufRead, Cursor, Read};

/// The longest header that is read, in bytes; real ones have some hundred.
const LONGEST_HEADER: u64 = 1 << 16;

/// The primaries and the white of a file that states none, as CIE x and y.
const USUAL_PRIMARIES: [[f32; 2]; 4] = [[0.640, 0.330], [0.290, 0.600], [0.150, 0.060], [0.333, 0.333]];

/// The header of a file.
#[derive(Debug, PartialEq)]
struct RadianceHeader {
    /// True where pixels are X, Y, Z instead of red, green, blue.
    is_xyz: bool,
    /// The factors by which red, green and blue were multiplied.
    factors: [f64; 3],
    primaries: Option<[[f32; 2]; 4]>,
    order: PixelOrder,
}

/// The order of the pixels in a file.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PixelOrder {
    /// The number of lines of pixels, and of pixels on a line.
    lines: u32,
    along: u32,
    /// True where a line is a column of the picture.
    is_by_columns: bool,
    /// True where the file begins at the right, and at the bottom.
    from_right: bool,
    from_bottom: bool,
}

/// Reads a picture from a file of so many bytes.
pub(super) fn read(mut file: impl BufRead, bytes: u64) -> Result<Raw, Fault> {
    let RadianceHeader { is_xyz, factors, primaries, order } = RadianceHeader::read(&mut file)?;
    let [width, height] = order.size();
    check_size(u64::from(width), u64::from(height), bytes)?;
    let plain = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", order.lines, order.along);
    let mut decoder =
        HdrDecoder::new_nonstrict(Cursor::new(plain.into_bytes()).chain(file)).map_err(damaged)?;
    decoder.set_limits(decoder_limits()).map_err(damaged)?;
    let pixels = light(DynamicImage::from_decoder(decoder).map_err(damaged)?);
    let mut panorama = Panorama { width, height, pixels: order.upright(pixels) };
    let to_srgb = if is_xyz { SRGB_FROM_XYZ } else { DMat3::IDENTITY };
    let changes = DMat3::from_diagonal(DVec3::from_array(factors.map(f64::recip))) * to_srgb;
    if changes != DMat3::IDENTITY {
        for pixel in &mut panorama.pixels {
            *pixel = (changes * DVec3::from_array(pixel.map(f64::from))).as_vec3().to_array();
        }
    }
    let mut warnings = vec![];
    if factors != [1.0; 3] {
        let [r, g, b] = factors;
        warnings.push(format!(
            "its EXPOSURE and COLORCORR say that red, green and blue were multiplied by {r}, {g} and {b}; this is undone"
        ));
    }
    let is_usual = |given: &[[f32; 2]; 4]| {
        given
            .as_flattened()
            .iter()
            .zip(USUAL_PRIMARIES.as_flattened())
            .all(|(a, b)| (a - b).abs() < SAME_PLACE)
    };
    warnings.extend(primaries.filter(|given| !is_xyz && !is_usual(given)).and_then(warn_of_primaries));
    Ok((panorama, warnings))
}

impl RadianceHeader {
    /// Reads the lines down to that of the resolution, behind which the pixels begin. Lines may end in CRLF.
    fn read(file: &mut impl BufRead) -> Result<Self, Fault> {
        let mut left = LONGEST_HEADER;
        let mut header = Self {
            is_xyz: false,
            factors: [1.0; 3],
            primaries: None,
            order: PixelOrder {
                lines: 0,
                along: 0,
                is_by_columns: false,
                from_right: false,
                from_bottom: false,
            },
        };
        loop {
            let line = next_line(file, &mut left)?;
            if line.is_empty() {
                break;
            }
            header.state(&line)?;
        }
        // Some programs leave further empty lines.
        let mut resolution = String::new();
        while resolution.is_empty() {
            resolution = next_line(file, &mut left)?;
        }
        header.order = PixelOrder::of(&resolution)?;
        Ok(header)
    }

    /// Takes in a line such as `EXPOSURE=0.5`. Factors of several lines multiply.
    fn state(&mut self, line: &str) -> Result<(), Fault> {
        let Some((key, value)) = line.split_once('=').filter(|_| !line.starts_with('#')) else {
            return Ok(());
        };
        let value = value.trim();
        match key.trim().to_ascii_uppercase().as_str() {
            "FORMAT" => match value.to_ascii_lowercase().as_str() {
                "32-bit_rle_rgbe" => self.is_xyz = false,
                "32-bit_rle_xyze" => self.is_xyz = true,
                _ => {
                    return Err(fault(
                        format!("FORMAT={value:.40}"),
                        "32-bit_rle_rgbe or 32-bit_rle_xyze is expected",
                    ));
                }
            },
            "EXPOSURE" => {
                let [factor] = numbers(line, value)?;
                self.multiply([factor; 3], line)?;
            }
            "COLORCORR" => self.multiply(numbers(line, value)?, line)?,
            "PRIMARIES" => {
                let [rx, ry, gx, gy, bx, by, wx, wy] = numbers::<8>(line, value)?.map(|number| number as f32);
                let stated = [[rx, ry], [gx, gy], [bx, by], [wx, wy]];
                // Photoshop writes zeros where it states none.
                self.primaries = Some(stated).filter(|stated| *stated != [[0.0; 2]; 4]);
            }
            _ => {}
        }
        Ok(())
    }

    fn multiply(&mut self, by: [f64; 3], line: &str) -> Result<(), Fault> {
        if by.iter().any(|factor| !(1e-12..=1e12).contains(factor)) {
            return Err(fault(format!("{line:.60}"), "factors above 0 are expected"));
        }
        self.factors = [0, 1, 2].map(|k| self.factors[k] * by[k]);
        Ok(())
    }
}

impl PixelOrder {
    /// Reads a line such as `-Y 512 +X 1024`, in any of the eight orders.
    fn of(line: &str) -> Result<Self, Fault> {
        let unclear = || fault(format!("'{line:.60}'"), "the size is expected here, such as -Y 512 +X 1024");
        let words: Vec<&str> = line.split_whitespace().collect();
        let &[first, lines, second, along] = words.as_slice() else { return Err(unclear()) };
        let (lines, along) = lines.parse().ok().zip(along.parse().ok()).ok_or_else(unclear)?;
        let (is_by_columns, x, y) =
            match (first.to_ascii_uppercase().as_str(), second.to_ascii_uppercase().as_str()) {
                (y @ ("-Y" | "+Y"), x @ ("-X" | "+X")) => (false, x == "-X", y == "+Y"),
                (x @ ("-X" | "+X"), y @ ("-Y" | "+Y")) => (true, x == "-X", y == "+Y"),
                _ => return Err(unclear()),
            };
        Ok(Self { lines, along, is_by_columns, from_right: x, from_bottom: y })
    }

    /// Returns the width and the height of the picture.
    fn size(self) -> [u32; 2] {
        if self.is_by_columns { [self.lines, self.along] } else { [self.along, self.lines] }
    }

    /// Returns pixels in the order of the file as rows from the left, beginning at the top.
    fn upright(self, pixels: Vec<[f32; 3]>) -> Vec<[f32; 3]> {
        if !(self.is_by_columns || self.from_right || self.from_bottom) {
            return pixels;
        }
        let [width, height] = self.size().map(|side| side as usize);
        let along = self.along as usize;
        let mut upright = Vec::with_capacity(pixels.len());
        for y in 0..height {
            let y = if self.from_bottom { height - 1 - y } else { y };
            for x in 0..width {
                let x = if self.from_right { width - 1 - x } else { x };
                upright.push(pixels[if self.is_by_columns { x * along + y } else { y * along + x }]);
            }
        }
        upright
    }
}

/// Makes a fault of a part of the header.
fn fault(part: impl std::fmt::Display, expected: &str) -> Fault {
    Fault::whole(format!(
        "its header is not that of a Radiance HDR picture: {part}: {expected}; save it again as Radiance HDR, OpenEXR or PNG"
    ))
}

/// Reads the next line of the header, without its end.
fn next_line(file: &mut impl BufRead, left: &mut u64) -> Result<String, Fault> {
    let mut line = vec![];
    let read = file.by_ref().take(*left).read_until(b'\n', &mut line).map_err(damaged)?;
    *left -= read as u64;
    if line.pop() != Some(b'\n') {
        return Err(damaged("its header has no end"));
    }
    Ok(String::from_utf8_lossy(&line).trim_end().to_owned())
}

/// Reads exactly so many numbers of a line.
fn numbers<const N: usize>(line: &str, value: &str) -> Result<[f64; N], Fault> {
    let found: Result<Vec<f64>, _> = value.split_whitespace().map(str::parse).collect();
    let expected =
        if N == 1 { "a number is expected".to_owned() } else { format!("{N} numbers are expected") };
    let found = found.ok().and_then(|found| <[f64; N]>::try_from(found).ok());
    found.ok_or_else(|| fault(format!("{line:.60}"), &expected))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(text: &str) -> Result<RadianceHeader, String> {
        RadianceHeader::read(&mut text.as_bytes()).map_err(|fault| fault.to_string())
    }

    #[test]
    fn factors_of_all_lines_multiply_and_lines_may_end_in_crlf() {
        let text = "#?RADIANCE\n# made by hand\nFORMAT=32-bit_rle_xyze\nEXPOSURE=2\nVIEW= -vta\nEXPOSURE= 0.25\n\
                    COLORCORR= 1 2 4\nPRIMARIES=0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329\n\n-Y 3 +X 6\n";
        let read = header(text).unwrap();
        assert_eq!((read.is_xyz, read.factors), (true, [0.5, 1.0, 2.0]));
        assert_eq!(read.primaries.unwrap()[1], [0.3, 0.6]);
        assert_eq!(header(&text.replace('\n', "\r\n")), Ok(read));
    }

    #[test]
    fn a_header_that_is_none_says_what_is_expected() {
        let with = |lines: &str| header(&format!("#?RADIANCE\n{lines}\n")).unwrap_err();
        for (lines, part) in [
            ("FORMAT=16-bit\n\n-Y 1 +X 2", "FORMAT=16-bit: 32-bit_rle_rgbe or"),
            ("EXPOSURE=x\n\n-Y 1 +X 2", "EXPOSURE=x: a number is expected"),
            ("EXPOSURE=0\n\n-Y 1 +X 2", "EXPOSURE=0: factors above 0"),
            ("COLORCORR=1 2\n\n-Y 1 +X 2", "COLORCORR=1 2: 3 numbers are expected"),
            ("\n-Y 1 +Y 2", "'-Y 1 +Y 2': the size is expected here"),
            ("\n-Y 1 +X -2", "the size is expected here"),
            ("\n1 2", "the size is expected here"),
            ("", "has no end"),
        ] {
            assert!(with(lines).contains(part), "{lines}: {}", with(lines));
        }
        assert!(header(&"#?RADIANCE\nA=1\n".repeat(10_000)).unwrap_err().contains("has no end"));
    }
}
