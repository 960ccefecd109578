//! Decides when the next image is painted.

use std::time::{Duration, Instant};

/// The shortest time from the start of one image to that of the next; screens show 60 a second.
const SHORTEST: Duration = Duration::from_micros(16_600);

/// The shortest time between images while the window is minimised.
const HIDDEN: Duration = Duration::from_millis(100);

/// The time when the next image is due, and the duration of the last one.
#[derive(Debug)]
pub struct FramePacer {
    /// The number of the processor's cores, at least 1.
    cores: u32,
    due: Option<Instant>,
    begun: Option<Instant>,
    took: Duration,
    /// True while the window is minimised.
    pub is_hidden: bool,
}

impl FramePacer {
    /// Makes the pacer of a window on a processor with so many cores.
    pub fn new(cores: usize) -> Self {
        let cores = u32::try_from(cores).unwrap_or(u32::MAX).max(1);
        Self { cores, due: None, begun: None, took: Duration::ZERO, is_hidden: false }
    }

    /// Requests an image at the time `when`; an earlier request stays in force.
    pub fn request(&mut self, when: Instant) {
        self.due = Some(self.due.map_or(when, |due| due.min(when)));
    }

    /// Returns when the next image is to be painted, or `None` if none was requested. Painting takes one core, and on a
    /// processor with few cores those have to trace light as well: the time that is left to that after each image is the
    /// time that the image took, divided by the number of the other cores.
    pub fn next(&self) -> Option<Instant> {
        let left = self.took / (self.cores - 1).max(1);
        let shortest = if self.is_hidden { HIDDEN } else { SHORTEST.max(self.took + left) };
        self.due.map(|due| self.begun.map_or(due, |begun| due.max(begun + shortest)))
    }

    /// Returns whether the next image is due.
    pub fn is_due(&self, now: Instant) -> bool {
        self.next().is_some_and(|next| next <= now)
    }

    /// Records that painting begins; later requests are for the next image.
    pub fn begin(&mut self, now: Instant) {
        (self.due, self.begun) = (None, Some(now));
    }

    /// Records that painting has ended.
    pub fn end(&mut self, now: Instant) {
        self.took = self.begun.map_or(Duration::ZERO, |begun| now.saturating_duration_since(begun));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_image_comes_at_once_and_the_next_leaves_time_for_other_work() {
        let start = Instant::now();
        let after = |millis: u64| start + Duration::from_millis(millis);
        let mut frames = FramePacer::new(2);
        assert_eq!(frames.next(), None);
        frames.request(after(9));
        frames.request(after(5));
        frames.request(after(7));
        assert_eq!(frames.next(), Some(after(5)));
        assert!(frames.is_due(after(5)) && !frames.is_due(after(4)));
        frames.begin(after(5));
        assert_eq!(frames.next(), None);
        frames.end(after(6));
        frames.request(after(6));
        assert_eq!(frames.next(), Some(after(5) + SHORTEST));
        frames.end(after(25));
        assert_eq!(frames.next(), Some(after(45)));
        frames.is_hidden = true;
        assert_eq!(frames.next(), Some(after(105)));
        frames.is_hidden = false;
        frames.begin(after(45));
        frames.request(after(500));
        assert_eq!(frames.next(), Some(after(500)));
    }

    #[test]
    fn the_more_cores_there_are_the_less_time_an_image_leaves_to_them() {
        let (start, took) = (Instant::now(), Duration::from_millis(60));
        let next = |cores: usize| {
            let mut frames = FramePacer::new(cores);
            frames.begin(start);
            frames.end(start + took);
            frames.request(start);
            frames.next().unwrap() - start
        };
        assert_eq!([0, 1, 2, 3, 5].map(|cores| next(cores).as_millis()), [120, 120, 120, 90, 75]);
        assert!(next(64) < Duration::from_millis(61));
    }
}
