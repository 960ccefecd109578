//! Copies the painted image to the window.

use brillianteer_painter::{Area, Canvas, Pixel};
use egui_winit::winit::window::Window;
use softbuffer::{Context, Rect, SoftBufferError, Surface};
use std::collections::VecDeque;
use std::num::NonZeroU32;
use std::sync::Arc;

/// The number of images whose changes are remembered. A window system may hand out a buffer that still holds one of
/// the last few images; only the areas that have changed since are then copied.
const MOST_REMEMBERED: usize = 4;

/// The buffers of a window.
pub struct WindowSurface {
    surface: Surface<Arc<Window>, Arc<Window>>,
    size: [usize; 2],
    /// The changed areas of the last images, the newest first.
    changes: VecDeque<Vec<Area>>,
}

impl WindowSurface {
    /// Opens the buffers of a window.
    pub fn of(window: &Arc<Window>) -> Result<Self, SoftBufferError> {
        let surface = Surface::new(&Context::new(Arc::clone(window))?, Arc::clone(window))?;
        Ok(Self { surface, size: [0, 0], changes: VecDeque::new() })
    }

    /// Shows an image, of which only `areas` have changed since the last one. Without any area nothing is presented.
    /// `before` is called just before the image is presented, and only then: winit's Wayland backend waits for the window
    /// system's answer to a presented image once it is notified, and asks for no redraw until that answer comes.
    pub fn show(
        &mut self,
        canvas: &Canvas,
        areas: Vec<Area>,
        before: impl FnOnce(),
    ) -> Result<(), SoftBufferError> {
        let [Some(width), Some(height)] = canvas.size().map(|n| NonZeroU32::new(n as u32)) else {
            return Ok(());
        };
        if self.size != canvas.size() {
            self.surface.resize(width, height)?;
            self.size = canvas.size();
            self.changes.clear();
        }
        let shown: Vec<Rect> = areas.iter().filter_map(|&area| rectangle(area)).collect();
        if shown.is_empty() {
            return Ok(());
        }
        self.changes.push_front(areas);
        self.changes.truncate(MOST_REMEMBERED);
        let mut buffer = self.surface.buffer_mut()?;
        let age = usize::from(buffer.age());
        let outdated = outdated(&self.changes, age, self.size);
        for area in outdated {
            for (row, y) in canvas.rows(area).zip(area.top as usize..) {
                let start = y * self.size[0] + area.left as usize;
                let into = &mut buffer[start..start + row.len()];
                into.iter_mut().zip(row).for_each(|(into, &from)| *into = swapped(from));
            }
        }
        before();
        buffer.present_with_damage(&shown)
    }

    /// Shows the whole image again, after the window system has lost a part of it.
    pub fn show_again(&mut self, canvas: &Canvas) -> Result<(), SoftBufferError> {
        self.show(canvas, vec![Area::of(canvas.size())], || {})
    }
}

/// Returns the areas in which a buffer differs from the newest image, if it holds the one of `age` images ago; with an age
/// of 0 its content is unknown.
fn outdated(changes: &VecDeque<Vec<Area>>, age: usize, size: [usize; 2]) -> Vec<Area> {
    if age == 0 || age > changes.len() {
        return vec![Area::of(size)];
    }
    changes.iter().take(age).flatten().copied().collect()
}

fn rectangle(area: Area) -> Option<Rect> {
    let [width, height] = area.size().map(NonZeroU32::new);
    Some(Rect { x: area.left as u32, y: area.top as u32, width: width?, height: height? })
}

/// Swaps red and blue: windows have blue in the lowest byte.
#[inline(always)]
fn swapped(of: Pixel) -> u32 {
    ((of & 0xff) << 16) | (of & 0xff00) | ((of >> 16) & 0xff)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_older_buffer_is_brought_up_to_date_by_more_changes() {
        let area = |left: i32| Area { left, top: 0, right: left + 1, bottom: 1 };
        let changes = VecDeque::from([vec![area(1)], vec![area(2), area(3)]]);
        let size = [9, 7];
        assert_eq!(outdated(&changes, 1, size), [area(1)]);
        assert_eq!(outdated(&changes, 2, size), [area(1), area(2), area(3)]);
        assert_eq!(outdated(&changes, 0, size), [Area::of(size)]);
        assert_eq!(outdated(&changes, 3, size), [Area::of(size)]);
    }

    #[test]
    fn red_and_blue_change_places() {
        assert_eq!(swapped(0xff11_2233), 0x0033_2211);
    }
}
