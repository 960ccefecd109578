//! The frames of an animation, and the trait of their writers.

use std::io;

/// The number, size and timing of an animation's frames. Animated PNG and GIF repeat for ever; players of MP4 decide.
#[derive(Debug, Clone, PartialEq)]
pub struct Frames {
    /// The number of frames, at least 1.
    pub count: u32,
    /// The width and height of each frame, in pixels.
    pub size: (u32, u32),
    /// The time for which each frame is shown, in ms; see
    /// [`AnimationFormat::delays_ms`](super::AnimationFormat::delays_ms).
    pub delay_ms: u16,
    /// True where the frames keep their cover (alpha channel). A GIF keeps only whether it is at least a half; MP4
    /// has none.
    pub transparent: bool,
    /// Colours that stay exact in a GIF, however few pixels have them: sRGB codes, at most 64.
    pub exact: Vec<[u8; 3]>,
}

/// A writer of the frames of one format. Callers have checked the number and the size of the frames.
pub(super) trait FrameSink {
    /// Adds a frame of red, green, blue and cover.
    fn push(&mut self, rgba: &[u8]) -> io::Result<()>;

    /// Writes the end of the file, after the last frame.
    fn finish(self: Box<Self>) -> io::Result<()>;
}
