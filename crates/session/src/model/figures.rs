//! Figures that have been measured.

use crate::studio::{FiguresOrder, Grade, Tilts, Which};
use brillianteer_measure::Figures;
use std::collections::HashMap;

/// Figures on the screen, with the order that they answer and their grade.
#[derive(Debug, Clone)]
pub struct ShownFigures {
    /// The order that the figures answer.
    pub order: FiguresOrder,
    /// How fine the figures are.
    pub grade: Grade,
    /// The figures.
    pub figures: Figures,
}

/// All figures of the session.
#[derive(Debug, Clone, Default)]
pub struct SessionFigures {
    /// The figures of the present stone, and of the one compared with.
    pub figures: HashMap<Which, ShownFigures>,
    /// The figures against tilt, with the order that they answer.
    pub tilts: Option<(FiguresOrder, Tilts)>,
}
