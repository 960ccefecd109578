//! What a pane that only looks like glass costs.

/// Lengths over the pane, in pixels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Shifts {
    /// Their mean.
    pub mean: f64,
    /// The greatest.
    pub greatest: f64,
}

/// What the approximation costs: over pixels whose middle the pane covers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Cost {
    /// Mean difference of the two pictures in linear light, over red, green and blue, of what a screen shows: 0 to 1.
    pub mean_difference: f64,
    /// Peak signal to noise of the same, dB; infinite where they are equal.
    pub psnr_db: f64,
    /// How far the pane moves what is seen; green light.
    pub pane: Shifts,
    /// How far the traced pane does.
    pub traced: Shifts,
    /// How far apart the two places are that they show: the approximation's error.
    pub apart: Shifts,
    /// How far apart red and blue are in the pane and, between the middles of the visible range's outer thirds, in the
    /// traced one: means.
    pub fringe: [f64; 2],
    /// The share of the traced pane's light that comes from the background.
    pub behind: f64,
    /// The share of pixels through which the traced pane shows none of the background.
    pub blind: f64,
}

/// What is added up over the pane.
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

/// Lengths added up.
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

    fn told(&self) -> Shifts {
        Shifts { mean: self.sum / self.count.max(1.0), greatest: self.greatest }
    }
}

impl Sums {
    pub fn cost(&self) -> Cost {
        let pixels = self.pixels.max(1.0);
        Cost {
            mean_difference: self.off / pixels,
            psnr_db: -10.0 * (self.squares / pixels).log10(),
            pane: self.pane.told(),
            traced: self.traced.told(),
            apart: self.apart.told(),
            fringe: self.fringe.each_ref().map(|lengths| lengths.told().mean),
            behind: 0.0,
            blind: self.blind / pixels,
        }
    }
}
