//! Animations as files: animated PNG, GIF, and MP4 in a program that was built with the feature `video`.

mod apng;
mod frames;
#[cfg(feature = "gif")]
mod gif;
#[cfg(feature = "gif")]
mod gif_palette;
#[cfg(feature = "video")]
mod mp4;

pub use frames::Frames;

use super::picture_file::unfit;
use brillianteer_files::{Sink, WriteError, write};
use frames::FrameSink;
use std::io;
use std::path::Path;

/// The format of an animation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AnimationFormat {
    /// Animated PNG: every colour exact, and transparent backgrounds.
    Apng,
    /// GIF: at most 256 colours in each frame.
    Gif,
    /// MP4 with AV1: small, and no colour exact.
    Mp4,
}

impl AnimationFormat {
    /// All formats, in the order of lists.
    pub const ALL: [Self; 3] = [Self::Apng, Self::Gif, Self::Mp4];

    /// Returns the ending of the format's files, without the dot.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Apng => "png",
            Self::Gif => "gif",
            Self::Mp4 => "mp4",
        }
    }

    /// Returns the format that a file's name ends with; `None` for another ending.
    pub fn of_name(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?;
        Self::ALL.into_iter().find(|format| ending.eq_ignore_ascii_case(format.ending()))
    }

    /// Returns whether this program was built with the format's encoder.
    pub fn is_built_in(self) -> bool {
        match self {
            Self::Apng => true,
            Self::Gif => cfg!(feature = "gif"),
            Self::Mp4 => cfg!(feature = "video"),
        }
    }

    /// Returns the shortest and the longest time, in ms, for which a frame of the format can be shown.
    ///
    /// Browsers show frames of animated PNG of less than 10 ms, and of GIF of less than 20 ms, for 100 ms.
    pub fn delays_ms(self) -> [u16; 2] {
        match self {
            Self::Gif => [20, u16::MAX],
            Self::Apng | Self::Mp4 => [1, u16::MAX],
        }
    }
}

/// Takes the frames of an animation one after the other; see [`write_animation`].
pub struct Animation<'a> {
    path: &'a Path,
    frames: &'a Frames,
    sink: Box<dyn FrameSink + 'a>,
    pushed: u32,
}

impl Animation<'_> {
    /// Adds a frame: red, green, blue and cover (alpha) of each pixel, not premultiplied, as
    /// [`develop`](brillianteer_picture::develop()) gives them.
    ///
    /// # Errors
    /// Fails where the file system refuses, the frame has another size, or there is one frame too many.
    pub fn push(&mut self, rgba: &[u8]) -> Result<(), WriteError> {
        let (width, height) = self.frames.size;
        if rgba.len() as u64 != 4 * u64::from(width) * u64::from(height) {
            return Err(WriteError::io(self.path, unfit(rgba.len() / 4, self.frames.size)));
        }
        self.pushed += 1;
        if self.pushed > self.frames.count {
            return Err(self.miscounted());
        }
        self.sink.push(rgba).map_err(|e| WriteError::io(self.path, e))
    }

    fn miscounted(&self) -> WriteError {
        let text = format!("frame {} of an animation of {}", self.pushed, self.frames.count);
        WriteError::io(self.path, io::Error::other(text))
    }

    fn finish(self) -> Result<(), WriteError> {
        if self.pushed != self.frames.count {
            return Err(self.miscounted());
        }
        self.sink.finish().map_err(|e| WriteError::io(self.path, e))
    }
}

/// Writes an animation; `fill` pushes its frames. `description` goes into the file as text.
///
/// # Errors
/// Fails where the file system refuses, a frame is missing or does not fit, the program was built without the format,
/// or `fill` returns an error. No file is left behind then.
pub fn write_animation<E: From<WriteError>>(
    (path, format): (&Path, AnimationFormat),
    frames: &Frames,
    description: &str,
    fill: impl FnOnce(&mut Animation) -> Result<(), E>,
) -> Result<(), E> {
    write(path, |file| -> Result<(), E> {
        let sink = opened((file, format), frames, description).map_err(|e| WriteError::io(path, e))?;
        let mut animation = Animation { path, frames, sink, pushed: 0 };
        fill(&mut animation)?;
        Ok(animation.finish()?)
    })
}

fn opened<'a>(
    (file, format): (&'a mut dyn Sink, AnimationFormat),
    frames: &'a Frames,
    description: &str,
) -> io::Result<Box<dyn FrameSink + 'a>> {
    let (width, height) = frames.size;
    if frames.count == 0 || width == 0 || height == 0 {
        return Err(io::Error::other("an animation needs a frame, and a frame needs a pixel"));
    }
    match format {
        AnimationFormat::Apng => Ok(Box::new(apng::Apng::begin(file, frames, description)?)),
        #[cfg(feature = "gif")]
        AnimationFormat::Gif => Ok(Box::new(gif::Gif::begin(file, frames, description)?)),
        #[cfg(feature = "video")]
        AnimationFormat::Mp4 => Ok(Box::new(mp4::Mp4::begin(file, frames, description)?)),
        #[cfg(not(all(feature = "gif", feature = "video")))]
        other => {
            let text = format!("this program was built without .{}", other.ending());
            Err(io::Error::new(io::ErrorKind::Unsupported, text))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_base::Stopped;

    fn frames() -> Frames {
        Frames { count: 5, size: (20, 16), delay_ms: 40, transparent: true, exact: vec![] }
    }

    /// Returns the formats that this program writes.
    fn built_in() -> impl Iterator<Item = AnimationFormat> {
        AnimationFormat::ALL.into_iter().filter(|format| format.is_built_in())
    }

    #[test]
    fn formats_are_told_by_their_endings() {
        let of = |name: &str| AnimationFormat::of_name(Path::new(name));
        for format in AnimationFormat::ALL {
            assert_eq!(of(&format!("a.b/c.{}", format.ending())), Some(format));
        }
        assert_eq!(of("x.GIF"), Some(AnimationFormat::Gif));
        assert_eq!([of("gif"), of("x.webm"), of("x")], [None; 3]);
    }

    #[test]
    fn half_an_animation_is_none() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("turn");
        for format in built_in() {
            let wrong: [(usize, usize); 4] = [(4, 1280), (6, 1280), (5, 1279), (0, 0)];
            for (count, bytes) in wrong {
                let fill = |a: &mut Animation| (0..count).try_for_each(|_| a.push(&vec![0; bytes]));
                assert!(write_animation::<WriteError>((&path, format), &frames(), "", fill).is_err());
            }
            for (count, size) in [(0, (20, 16)), (1, (0, 16))] {
                let frames = Frames { count, size, ..frames() };
                assert!(write_animation::<WriteError>((&path, format), &frames, "", |_| Ok(())).is_err());
            }
            let stopped = write_animation((&path, format), &frames(), "", |a| {
                a.push(&[0; 1280])?;
                Err(WriteError::Stopped(Stopped))
            });
            assert!(matches!(stopped, Err(WriteError::Stopped(_))));
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_format_that_is_not_built_in_is_an_error_that_names_it() {
        let folder = tempfile::tempdir().unwrap();
        for format in AnimationFormat::ALL.into_iter().filter(|format| !format.is_built_in()) {
            let path = folder.path().join("turn");
            let error =
                write_animation::<WriteError>((&path, format), &frames(), "", |_| Ok(())).unwrap_err();
            assert!(error.to_string().contains(&format!("without .{}", format.ending())), "{error}");
        }
    }
}
