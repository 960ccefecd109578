//! Writes animated GIF (GIF89a, CompuServe 1990).

use super::frames::{FrameSink, Frames};
use super::gif_palette::GifPalette;
use brillianteer_files::Sink;
use gif::{AnyExtension, DisposalMethod, Encoder, EncodingError, Frame, Repeat};
use std::borrow::Cow;
use std::io;

/// The number of colours of a frame, one less than a GIF has: the last place is for pixels that keep the colour of
/// the frame before.
const COLOURS: usize = 255;

/// The place of pixels that keep the colour of the frame before.
const CLEAR: u8 = 255;

/// The label of an extension that holds a comment (GIF89a, 24).
const COMMENT: u8 = 0xfe;

/// The least cover of a pixel that is drawn where the background is transparent.
const LEAST_COVER: u8 = 128;

/// The ticks of a GIF, ms.
const TICK_MS: u64 = 10;

/// An animated GIF that is being written.
pub(super) struct Gif<'a> {
    encoder: Encoder<&'a mut dyn Sink>,
    frames: &'a Frames,
    size: [u16; 2],
    /// The number of frames written.
    written: u64,
    /// The colours on the screen before the next frame, so that the file holds only changes.
    shown: Option<Vec<[u8; 3]>>,
}

impl<'a> Gif<'a> {
    /// Begins an animation that repeats for ever. `description` goes into the file as a comment, in ASCII.
    pub fn begin(file: &'a mut dyn Sink, frames: &'a Frames, description: &str) -> io::Result<Self> {
        let (width, height) = frames.size;
        let too_large =
            |_| io::Error::other(format!("{width} x {height} pixels: a GIF has at most 65535 a side"));
        let [across, down] =
            [u16::try_from(width).map_err(too_large)?, u16::try_from(height).map_err(too_large)?];
        let mut encoder = Encoder::new(file, across, down, &[]).map_err(failed)?;
        encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
        let comment = in_ascii(description);
        encoder.write_raw_extension(AnyExtension(COMMENT), &[comment.as_bytes()]).map_err(failed)?;
        Ok(Self { encoder, frames, size: [across, down], written: 0, shown: None })
    }

    /// Returns the number of ticks for which the next frame is shown. Remainders of the rounding are added to later
    /// frames.
    fn ticks(&self) -> u16 {
        let end = |frame: u64| (frame * u64::from(self.frames.delay_ms) + TICK_MS / 2) / TICK_MS;
        u16::try_from(end(self.written + 1) - end(self.written)).unwrap_or(u16::MAX)
    }

    /// Returns the colours of a frame, and the place of each pixel's colour.
    fn indexed(&self, rgba: &[u8]) -> (GifPalette, Vec<u8>) {
        let is_clear = |pixel: &[u8]| self.frames.transparent && pixel[3] < LEAST_COVER;
        let colour = |pixel: &[u8]| [pixel[0], pixel[1], pixel[2]];
        let drawn = rgba.chunks_exact(4).filter(|pixel| !is_clear(pixel));
        let palette = GifPalette::of(drawn.map(colour), &self.frames.exact, COLOURS);
        let place = |pixel: &[u8]| if is_clear(pixel) { CLEAR } else { palette.place(colour(pixel)) };
        let places = rgba.chunks_exact(4).map(place).collect();
        (palette, places)
    }

    /// Replaces unchanged pixels by [`CLEAR`], which makes the file smaller.
    fn without_what_stays(&mut self, palette: &GifPalette, places: &mut [u8]) {
        let now: Vec<[u8; 3]> = places.iter().map(|&place| palette.colours[usize::from(place)]).collect();
        if let Some(before) = &self.shown {
            for (place, (before, now)) in places.iter_mut().zip(before.iter().zip(&now)) {
                *place = if before == now { CLEAR } else { *place };
            }
        }
        self.shown = Some(now);
    }
}

impl FrameSink for Gif<'_> {
    fn push(&mut self, rgba: &[u8]) -> io::Result<()> {
        let (palette, mut places) = self.indexed(rgba);
        // Transparent frames are each wiped off before the next, so all their pixels are written.
        if !self.frames.transparent {
            self.without_what_stays(&palette, &mut places);
        }
        let mut colours: Vec<u8> = palette.colours.concat();
        colours.resize(3 * (COLOURS + 1), 0);
        let [width, height] = self.size;
        let frame = Frame {
            delay: self.ticks(),
            dispose: if self.frames.transparent { DisposalMethod::Background } else { DisposalMethod::Keep },
            transparent: Some(CLEAR),
            width,
            height,
            palette: Some(colours),
            buffer: Cow::Owned(places),
            ..Frame::default()
        };
        self.encoder.write_frame(&frame).map_err(failed)?;
        self.written += 1;
        Ok(())
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        // The encoder writes the end of the file.
        self.encoder.into_inner().map_err(failed)?;
        Ok(())
    }
}

fn failed(error: EncodingError) -> io::Error {
    match error {
        EncodingError::Io(error) => error,
        other => io::Error::other(other),
    }
}

/// Returns a text in ASCII, as comments of a GIF are.
fn in_ascii(text: &str) -> String {
    text.replace('°', " degrees")
        .replace('×', "x")
        .replace('²', "2")
        .chars()
        .map(|c| if c.is_ascii() { c } else { '?' })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::{Animation, AnimationFormat, write_animation};
    use super::*;
    use brillianteer_files::WriteError;
    use gif::{ColorOutput, DecodeOptions};

    /// Writes frames as a GIF and returns its bytes.
    fn written(frames: &Frames, all: &[Vec<u8>], description: &str) -> Vec<u8> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.gif");
        let fill = |animation: &mut Animation| all.iter().try_for_each(|frame| animation.push(frame));
        write_animation::<WriteError>((&path, AnimationFormat::Gif), frames, description, fill).unwrap();
        std::fs::read(path).unwrap()
    }

    /// Returns each frame as a viewer shows it, drawn over the one before, with its delay.
    fn shown(bytes: &[u8]) -> Vec<(Vec<u8>, u16)> {
        let mut options = DecodeOptions::new();
        options.set_color_output(ColorOutput::RGBA);
        let mut reader = options.read_info(bytes).unwrap();
        assert_eq!(reader.repeat(), Repeat::Infinite);
        let mut screen = vec![0; 4 * usize::from(reader.width()) * usize::from(reader.height())];
        let mut all = vec![];
        while let Some(frame) = reader.read_next_frame().unwrap() {
            assert_eq!((frame.left, frame.top), (0, 0));
            for (behind, pixel) in screen.chunks_exact_mut(4).zip(frame.buffer.chunks_exact(4)) {
                if pixel[3] > 0 {
                    behind.copy_from_slice(pixel);
                }
            }
            all.push((screen.clone(), frame.delay));
            if frame.dispose == DisposalMethod::Background {
                screen.fill(0);
            }
        }
        all
    }

    fn frames(count: u32, transparent: bool) -> Frames {
        Frames { count, size: (16, 9), delay_ms: 25, transparent, exact: vec![] }
    }

    /// Returns a frame in which some pixels change and others stay.
    fn frame(k: u8) -> Vec<u8> {
        (0..144).flat_map(|p| if p < 40 { [9, p, 200, 255] } else { [k * 20, p, k ^ p, 255] }).collect()
    }

    #[test]
    fn frames_of_few_colours_come_back_as_they_were_and_last_as_long() {
        let all: Vec<Vec<u8>> = (0..8).map(frame).collect();
        let found = shown(&written(&frames(8, false), &all, ""));
        assert!(found.iter().map(|(pixels, _)| pixels).eq(&all));
        let delays: Vec<u16> = found.iter().map(|(_, delay)| *delay).collect();
        assert_eq!(delays.iter().sum::<u16>(), 20, "8 frames of 25 ms are 20 ticks: {delays:?}");
        assert!(delays.iter().all(|delay| (2..=3).contains(delay)));
    }

    #[test]
    fn a_transparent_frame_is_wiped_off_before_the_next() {
        let covers = |k: u8| (0..144).flat_map(move |p| [p, k, 0, if p % 3 == k % 3 { 255 } else { 100 }]);
        let all: Vec<Vec<u8>> = (0..3).map(|k| covers(k).collect()).collect();
        let found = shown(&written(&frames(3, true), &all, ""));
        for ((pixels, _), expected) in found.iter().zip(&all) {
            for (pixel, expected) in pixels.chunks_exact(4).zip(expected.chunks_exact(4)) {
                assert_eq!(pixel, if expected[3] == 255 { expected } else { &[0; 4] });
            }
        }
    }

    #[test]
    fn the_description_is_a_comment() {
        let bytes = written(&frames(1, false), &[frame(1)], "tilted 12.5° × 2, ü");
        let comment = b"\x21\xfe\x1dtilted 12.5 degrees x 2, ?\0";
        let found = bytes.windows(24).any(|part| part == &comment[3..27]);
        assert!(found && bytes.ends_with(b";"), "{:?}", String::from_utf8_lossy(&bytes[..80]));
    }

    #[test]
    fn colours_that_must_stay_exact_do_so_in_frames_of_too_many() {
        let exact = vec![[255, 0, 0], [0, 255, 0]];
        let frames = Frames { count: 1, size: (64, 64), exact: exact.clone(), ..frames(1, false) };
        let mut pixels: Vec<u8> = (0..4096_u32)
            .flat_map(|p| [(p % 61) as u8 * 4, (p / 61) as u8 * 3, (p % 7) as u8, 255])
            .collect();
        pixels[..4].copy_from_slice(&[255, 0, 0, 255]);
        pixels[4..8].copy_from_slice(&[0, 255, 0, 255]);
        let found = shown(&written(&frames, &[pixels], ""));
        assert_eq!(&found[0].0[..8], [255, 0, 0, 255, 0, 255, 0, 255]);
    }
}
