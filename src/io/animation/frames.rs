//! The frames of an animation, and what takes them.

use std::io;

/// The number, size and timing of an animation's frames. Animated PNG and GIF repeat for ever; players of MP4 decide.
#[derive(Debug, Clone, PartialEq)]
pub struct Frames {
    /// The number of frames, at least 1.
    pub count: u32,
    /// The width and height of each frame, in pixels.
    pub size: (u32, u32),
    /// How long each frame is shown, in ms; see [`AnimationFormat::delays_ms`](super::AnimationFormat::delays_ms).
    pub delay_ms: u16,
    /// Whether the frames keep their cover (alpha channel). A GIF keeps whether it is at least a half; MP4 has none.
    pub transparent: bool,
    /// Colours that stay exact in a GIF, however few pixels have them: sRGB codes, at most 64.
    pub exact: Vec<[u8; 3]>,
}

/// What takes the frames of one format. The number and the size of the frames are checked before.
pub(super) trait FrameSink {
    /// Adds a frame of red, green, blue and cover.
    fn push(&mut self, rgba: &[u8]) -> io::Result<()>;

    /// Writes what comes after the last frame.
    fn finish(self: Box<Self>) -> io::Result<()>;
}
