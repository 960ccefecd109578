//! The cost of the approximation: figures of the difference between the drawn pane and the traced one.

/// Statistics of lengths over the pane, in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Shifts {
    /// The mean length.
    pub mean: f64,
    /// The greatest length.
    pub greatest: f64,
}

/// The cost of the approximation, over the pixels whose middle the pane covers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Cost {
    /// Mean difference of the two pictures, 0 to 1: in linear light as far as a screen shows it, over red, green and
    /// blue.
    pub mean_difference: f64,
    /// Peak signal-to-noise ratio of that difference, in dB; infinite where the pictures are equal.
    pub psnr_db: f64,
    /// The distance by which the drawn pane moves the background, in green light.
    pub pane: Shifts,
    /// The distance by which the traced pane moves the background.
    pub traced: Shifts,
    /// Distance between the two places that the drawn and the traced pane show: the approximation's error.
    pub apart: Shifts,
    /// Mean distance between red and blue, in the drawn pane and in the traced one. The traced one is measured between
    /// the middles of the outer thirds of the visible range.
    pub fringe: [f64; 2],
    /// The share of the traced pane's light that comes from the background.
    pub behind: f64,
    /// The share of pixels through which the traced pane shows none of the background.
    pub blind: f64,
}

/// Sums over the pixels of the pane.
#[derive(Default)]
pub(super) struct Sums {
    pub pixels: f64,
    pub off: f64,
    pub squares: f64,
    pub blind: f64,
    pub pane: Lengths,
    pub traced: Lengths,
    pub apart: Lengths,
    pub fringe: [Lengths; 2],
}

/// The sum, number and greatest of some lengths.
#[derive(Default)]
pub(super) struct Lengths {
    sum: f64,
    count: f64,
    greatest: f64,
}

impl Lengths {
    pub fn add(&mut self, length: f64) {
        self.sum += length;
        self.count += 1.0;
        self.greatest = self.greatest.max(length);
    }

    fn shifts(&self) -> Shifts {
        Shifts { mean: self.sum / self.count.max(1.0), greatest: self.greatest }
    }
}

impl Sums {
    pub fn cost(&self) -> Cost {
        let pixels = self.pixels.max(1.0);
        Cost {
            mean_difference: self.off / pixels,
            psnr_db: -10.0 * (self.squares / pixels).log10(),
            pane: self.pane.shifts(),
            traced: self.traced.shifts(),
            apart: self.apart.shifts(),
            fringe: self.fringe.each_ref().map(|lengths| lengths.shifts().mean),
            behind: 0.0,
            blind: self.blind / pixels,
        }
    }
}
