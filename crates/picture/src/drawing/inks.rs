//! The colours of drawings, on paper and on a dark screen.

/// The colours of a drawing, as sRGB codes of red, green and blue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Inks {
    /// The paper behind everything.
    pub paper: [u8; 3],
    /// Outlines and names.
    pub ink: [u8; 3],
    /// Edges between facets.
    pub edge: [u8; 3],
    /// Remarks, and lines that only serve for reading, such as those of a scale.
    pub quiet: [u8; 3],
    /// Dimensions and slopes.
    pub accent: [u8; 3],
    /// Extension lines, which lead from a dimension to the measured points.
    pub extension: [u8; 3],
    /// Facets seen edge on, and facets that face the eye; the others are mixtures of the two.
    pub faces: [[u8; 3]; 2],
}

impl Inks {
    /// Dark on white, for exported drawings.
    pub const PAPER: Self = Self {
        paper: [255; 3],
        ink: [0x2a, 0x2e, 0x34],
        edge: [0x86, 0x8c, 0x95],
        quiet: [0x70, 0x76, 0x7f],
        accent: [0x1c, 0x5a, 0x94],
        extension: [0xa9, 0xc2, 0xda],
        faces: [[232, 232, 235], [255; 3]],
    };

    /// Black on white with one grey, for sheets that are printed.
    pub const PRINT: Self = Self {
        paper: [255; 3],
        ink: [0; 3],
        edge: [0x55; 3],
        quiet: [0x55; 3],
        accent: [0x33; 3],
        extension: [0xaa; 3],
        faces: [[0xe6; 3], [255; 3]],
    };

    /// Light on dark, for dark windows.
    pub const DARK: Self = Self {
        paper: [0x1b, 0x1c, 0x1f],
        ink: [0xe4, 0xe6, 0xea],
        edge: [0x84, 0x8a, 0x94],
        quiet: [0xa4, 0xa9, 0xb2],
        accent: [0x7d, 0xbc, 0xf2],
        extension: [0x3f, 0x5a, 0x74],
        faces: [[0x22, 0x24, 0x28], [0x33, 0x36, 0x3c]],
    };

    /// Returns one of the colours, as SVG writes it.
    pub(crate) fn of(&self, ink: Ink) -> String {
        hex(match ink {
            Ink::Paper => self.paper,
            Ink::Main => self.ink,
            Ink::Edge => self.edge,
            Ink::Quiet => self.quiet,
            Ink::Accent => self.accent,
            Ink::Extension => self.extension,
        })
    }
}

/// Returns a colour as SVG writes it.
pub(crate) fn hex([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Returns the colour that lies this part of the way between two, as SVG writes it.
pub(crate) fn between([from, to]: [[u8; 3]; 2], part: f64) -> String {
    let mixed = |k: usize| {
        let [from, to] = [from, to].map(|colour| f64::from(colour[k]));
        (from + (to - from) * part).round() as u8
    };
    hex([0, 1, 2].map(mixed))
}

/// The name of one of the colours of [`Inks`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ink {
    Paper,
    Main,
    Edge,
    Quiet,
    Accent,
    Extension,
}
