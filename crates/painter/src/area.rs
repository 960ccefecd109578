//! Rectangles of whole pixels.

/// A rectangle of pixels. It includes the column `left` and the row `top`, but not the column `right` and the row `bottom`.
/// It is empty where `right` is not beyond `left`, or `bottom` not beyond `top`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Area {
    /// The first column.
    pub left: i32,
    /// The first row.
    pub top: i32,
    /// The column after the last.
    pub right: i32,
    /// The row after the last.
    pub bottom: i32,
}

impl Area {
    /// Returns the area of a whole image, given its columns and rows.
    pub fn of(size: [usize; 2]) -> Self {
        Self { left: 0, top: 0, right: size[0] as i32, bottom: size[1] as i32 }
    }

    /// Returns the area of the pixels whose centres lie between two corners.
    pub fn between(least: [f32; 2], most: [f32; 2]) -> Self {
        Self { left: first(least[0]), top: first(least[1]), right: first(most[0]), bottom: first(most[1]) }
    }

    /// Returns the intersection of two areas.
    pub fn cut(self, other: Self) -> Self {
        Self {
            left: self.left.max(other.left),
            top: self.top.max(other.top),
            right: self.right.min(other.right),
            bottom: self.bottom.min(other.bottom),
        }
    }

    /// Returns whether the area holds no pixel.
    pub fn is_empty(self) -> bool {
        self.left >= self.right || self.top >= self.bottom
    }

    /// Returns the numbers of columns and rows, at least 0.
    pub fn size(self) -> [u32; 2] {
        [(self.right - self.left).max(0) as u32, (self.bottom - self.top).max(0) as u32]
    }
}

/// Returns the first pixel whose centre is not before `edge`.
#[inline(always)]
pub fn first(edge: f32) -> i32 {
    // `ceil` would call a library function where the processor may be an old one. Casts saturate, so that far coordinates
    // stay far outside.
    let edge = edge - 0.5;
    let whole = edge as i32;
    whole.saturating_add(i32::from(edge > whole as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_belong_to_the_side_that_their_middle_is_on() {
        for edge in
            [-3.0_f32, -2.51, -2.5, -2.49, -0.5, 0.0, 0.49, 0.5, 0.51, 1.0, 7.5, 7.500_001, 1e12, -1e12]
        {
            let middle = |pixel: i32| f64::from(pixel) + 0.5;
            let pixel = first(edge);
            if edge.abs() < 1e9 {
                assert!(
                    middle(pixel) >= f64::from(edge) && middle(pixel - 1) < f64::from(edge),
                    "{edge}: {pixel}"
                );
            } else {
                assert_eq!(pixel, if edge > 0.0 { i32::MAX } else { i32::MIN });
            }
        }
    }

    #[test]
    fn areas_without_pixels_are_empty() {
        let area = Area::of([8, 6]);
        assert!(!area.is_empty() && Area { right: 0, ..area }.is_empty());
        let cut = area.cut(Area { left: 5, top: 2, right: 20, bottom: 3 });
        assert_eq!((cut.size(), cut.is_empty()), ([3, 1], false));
        assert_eq!(area.cut(Area { left: 9, top: 0, right: 20, bottom: 3 }).size(), [0, 3]);
    }
}
