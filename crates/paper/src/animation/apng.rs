//! Writes animated PNG (third edition of the PNG specification, W3C 2025), which browsers play as they show PNG.

use super::frames::{FrameSink, Frames};
use crate::picture_file::without_cover;
use crate::png::encoder;
use brillianteer_files::Sink;
use std::io;

/// An animated PNG that is being written.
pub(super) struct Apng<'a> {
    transparent: bool,
    writer: png::Writer<&'a mut dyn Sink>,
}

impl<'a> Apng<'a> {
    /// Begins an animation. `description` goes into the file as text.
    pub fn begin(file: &'a mut dyn Sink, frames: &Frames, description: &str) -> io::Result<Self> {
        let colour = if frames.transparent { png::ColorType::Rgba } else { png::ColorType::Rgb };
        let mut encoder = encoder(file, frames.size, colour, description)?;
        encoder.set_compression(png::Compression::Balanced);
        encoder.set_animated(frames.count, 0)?;
        encoder.set_frame_delay(frames.delay_ms, 1000)?;
        Ok(Self { transparent: frames.transparent, writer: encoder.write_header()? })
    }
}

impl FrameSink for Apng<'_> {
    fn push(&mut self, rgba: &[u8]) -> io::Result<()> {
        if self.transparent {
            self.writer.write_image_data(rgba)?
        } else {
            self.writer.write_image_data(&without_cover(rgba))?
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        Ok(self.writer.finish()?)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Animation, AnimationFormat, write_animation};
    use super::*;
    use brillianteer_files::WriteError;

    fn frame(k: u8) -> Vec<u8> {
        (0..24).flat_map(|p| [k * 20, p * 10, k ^ p, 255 - p]).collect()
    }

    #[test]
    fn an_animation_holds_its_frames() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("turn.png");
        for transparent in [false, true] {
            let frames = Frames { count: 5, size: (6, 4), delay_ms: 40, transparent, exact: vec![] };
            let fill = |animation: &mut Animation| (0..5).try_for_each(|k| animation.push(&frame(k)));
            write_animation::<WriteError>((&path, AnimationFormat::Apng), &frames, "turning", fill).unwrap();
            let file = io::BufReader::new(std::fs::File::open(&path).unwrap());
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
}
