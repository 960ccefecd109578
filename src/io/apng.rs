//! Writes animated PNG (third edition of the PNG specification, W3C 2025), which browsers play as they show PNG.

use super::atomic::{WriteError, write};
use super::picture_file::{unfit, without_cover};
use super::png::encoder;
use std::io::Write;
use std::path::Path;

/// The number, size and timing of an animation's frames. The animation repeats for ever.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Frames {
    /// The number of frames, at least 1.
    pub count: u32,
    /// The width and height of each frame, in pixels.
    pub size: (u32, u32),
    /// How long each frame is shown, in ms; browsers replace less than 10 by 100.
    pub delay_ms: u16,
    /// Whether the frames keep their cover (alpha channel); without it the file is a quarter smaller.
    pub transparent: bool,
}

/// Writes the frames of an animation one after the other; see [`write_apng`].
pub struct Animation<'a> {
    path: &'a Path,
    frames: Frames,
    writer: png::Writer<&'a mut dyn Write>,
    pushed: u32,
}

impl Animation<'_> {
    /// Adds a frame: red, green, blue and cover (alpha) of each pixel, not premultiplied, as
    /// [`develop`](crate::picture::develop()) gives them.
    ///
    /// # Errors
    /// When the file system refuses, the frame has another size, or there is one frame too many.
    pub fn push(&mut self, rgba: &[u8]) -> Result<(), WriteError> {
        let (width, height) = self.frames.size;
        if rgba.len() as u64 != 4 * u64::from(width) * u64::from(height) {
            return Err(WriteError::io(self.path, unfit(rgba.len() / 4, self.frames.size)));
        }
        self.pushed += 1;
        if self.pushed > self.frames.count {
            return Err(self.miscounted());
        }
        let written = if self.frames.transparent {
            self.writer.write_image_data(rgba)
        } else {
            self.writer.write_image_data(&without_cover(rgba))
        };
        written.map_err(|e| WriteError::io(self.path, e))
    }

    fn miscounted(&self) -> WriteError {
        let text = format!("frame {} of an animation of {}", self.pushed, self.frames.count);
        WriteError::io(self.path, std::io::Error::other(text))
    }

    fn finish(self) -> Result<(), WriteError> {
        if self.pushed != self.frames.count {
            return Err(self.miscounted());
        }
        self.writer.finish().map_err(|e| WriteError::io(self.path, e))
    }
}

/// Writes an animation; `fill` pushes its frames. `description` goes into the file as text.
///
/// # Errors
/// When the file system refuses, a frame is missing or does not fit, or `fill` returns an error. No file is left behind
/// then.
pub fn write_apng<E: From<WriteError>>(
    path: &Path,
    frames: Frames,
    description: &str,
    fill: impl FnOnce(&mut Animation) -> Result<(), E>,
) -> Result<(), E> {
    write(path, |file| -> Result<(), E> {
        let writer = opened(file, frames, description).map_err(|e| WriteError::io(path, e))?;
        let mut animation = Animation { path, frames, writer, pushed: 0 };
        fill(&mut animation)?;
        Ok(animation.finish()?)
    })
}

fn opened<'a>(
    file: &'a mut dyn Write,
    frames: Frames,
    description: &str,
) -> Result<png::Writer<&'a mut dyn Write>, png::EncodingError> {
    let colour = if frames.transparent { png::ColorType::Rgba } else { png::ColorType::Rgb };
    let mut encoder = encoder(file, frames.size, colour, description)?;
    encoder.set_compression(png::Compression::Balanced);
    encoder.set_animated(frames.count, 0)?;
    encoder.set_frame_delay(frames.delay_ms, 1000)?;
    encoder.write_header()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::Stopped;

    fn frames(transparent: bool) -> Frames {
        Frames { count: 5, size: (6, 4), delay_ms: 40, transparent }
    }

    fn frame(k: u8) -> Vec<u8> {
        (0..24).flat_map(|p| [k * 20, p * 10, k ^ p, 255 - p]).collect()
    }

    #[test]
    fn an_animation_holds_its_frames() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("turn.png");
        for transparent in [false, true] {
            let fill = |animation: &mut Animation| (0..5).try_for_each(|k| animation.push(&frame(k)));
            write_apng::<WriteError>(&path, frames(transparent), "turning", fill).unwrap();
            let file = std::io::BufReader::new(std::fs::File::open(&path).unwrap());
            let mut reader = png::Decoder::new(file).read_info().unwrap();
            let control = reader.info().animation_control.unwrap();
            assert_eq!((control.num_frames, control.num_plays), (5, 0));
            let mut out = vec![0; reader.output_buffer_size().unwrap()];
            for k in 0..5 {
                reader.next_frame(&mut out).unwrap();
                assert_eq!(out, if transparent { frame(k) } else { without_cover(&frame(k)) });
                let shown = reader.info().frame_control.unwrap();
                assert_eq!((shown.delay_num, shown.delay_den), (40, 1000));
            }
            assert!(reader.next_frame(&mut out).is_err());
        }
    }

    #[test]
    fn half_an_animation_is_none() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("turn.png");
        let wrong: [(usize, usize); 4] = [(4, 96), (6, 96), (5, 95), (0, 0)];
        for (count, bytes) in wrong {
            let fill = |a: &mut Animation| (0..count).try_for_each(|_| a.push(&vec![0; bytes]));
            assert!(write_apng::<WriteError>(&path, frames(true), "", fill).is_err());
        }
        for (count, size) in [(0, (6, 4)), (1, (0, 4))] {
            let frames = Frames { count, size, ..frames(true) };
            assert!(write_apng::<WriteError>(&path, frames, "", |_| Ok(())).is_err());
        }
        let stopped = write_apng(&path, frames(true), "", |a| {
            a.push(&frame(0))?;
            Err(WriteError::Stopped(Stopped))
        });
        assert!(matches!(stopped, Err(WriteError::Stopped(_))));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
