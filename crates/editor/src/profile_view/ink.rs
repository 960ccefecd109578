//! The colours of the drawing, made from those of the window.

use egui::{Color32, Visuals};

/// The colours of the parts of the drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfileInks {
    /// The stone's outline.
    pub outline: Color32,
    /// Edges between facets.
    pub edge: Color32,
    /// Edges between girdle facets, which are many.
    pub girdle: Color32,
    /// Facets that face the eye, and those seen nearly edge on.
    pub faces: [Color32; 2],
    pub dimension: Color32,
    /// Extension lines, which lead to dimension lines.
    pub extension: Color32,
    pub number: Color32,
    /// Numbers that follow from others.
    pub quiet: Color32,
    /// Handles, and the lines and numbers of the active one.
    pub accent: Color32,
    /// The background of the drawing.
    pub paper: Color32,
}

impl ProfileInks {
    /// Returns the colours for a light or dark window.
    pub fn of(visuals: &Visuals) -> Self {
        let text = visuals.text_color();
        let paper = visuals.panel_fill;
        let mixed = |part: f32| paper.lerp_to_gamma(text, part);
        let faces = if visuals.dark_mode {
            [paper.lerp_to_gamma(Color32::WHITE, 0.14), paper.lerp_to_gamma(Color32::WHITE, 0.02)]
        } else {
            [visuals.extreme_bg_color, paper.lerp_to_gamma(Color32::BLACK, 0.09)]
        };
        Self {
            outline: visuals.strong_text_color(),
            edge: mixed(0.55),
            girdle: mixed(0.3),
            faces,
            dimension: mixed(0.6),
            extension: mixed(0.3),
            number: text,
            quiet: mixed(0.75),
            accent: visuals.selection.stroke.color,
            paper,
        }
    }
}
