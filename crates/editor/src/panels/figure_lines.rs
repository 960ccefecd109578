//! The figures as lines: every zone and total with its name, its meaning and its share of the stone's outline.

use brillianteer_measure::Figures;
use brillianteer_picture::Scoped;
use brillianteer_scene::{Glare, Scope};
use brillianteer_session::model::{figures::ShownFigures, workspace::Workspace};
use brillianteer_session::studio::Grade;

/// A figure that the panel shows.
#[derive(Debug)]
pub struct Figure {
    pub name: &'static str,
    /// The meaning of the figure, for its explanation.
    pub meaning: &'static str,
    /// True where the figure is drawn in strong letters.
    pub is_strong: bool,
    source: Source,
}

/// The source of a figure.
#[derive(Debug)]
enum Source {
    /// A band of the scope.
    Zone(&'static str),
    /// A function of all the light together.
    Total(fn(&Figures, &Scope) -> f64),
}

/// The zones, in the order of the panel.
pub static ZONES: [Figure; 5] = [
    zone("Red", "red", "Light from 45° to 75° above the horizon, where rooms are brightest."),
    zone("Green", "green", "Light from the horizon to 45°: walls and windows."),
    zone(
        "Blue",
        "blue",
        "Light from straight above, which the observer's head blocks. It makes the contrast.",
    ),
    zone(HEAD, "head", "Light that the observer's head blocks."),
    zone(
        "Leakage",
        "below",
        "Light from behind the stone, through the pavilion. It shows as a dark spot or a window.",
    ),
];

/// The figures of energy that are not zones, in the order of the panel.
pub(super) static TOTALS: [Figure; 6] = [
    Figure {
        is_strong: true,
        ..total("Light return", LIGHT_RETURN, |figures, scope| figures.light_return(scope))
    },
    total(WITH_GLARE, "Light return plus the glare from above the horizon.", |figures, scope| {
        figures.light_return(scope) + figures.glare_return(scope)
    }),
    total("Glare", "Light that the outer surface reflects without having been inside.", |figures, _| {
        figures.surface.iter().sum()
    }),
    total("Absorbed", "Light that the colour of the stone absorbs.", |figures, _| figures.absorbed),
    total("Unresolved", UNRESOLVED, |figures, _| figures.unresolved),
    total(
        ESTIMATED,
        "Light that exact beams have left unresolved. Rays estimate where it goes, and the other figures contain it.",
        |figures, _| figures.unresolved,
    ),
];

/// The one figure of areas that is not a zone.
static UNDECIDED: Figure = total("Undecided", HIDDEN, |figures, _| figures.strongest_exit_undecided);

const LIGHT_RETURN: &str = "Light from above the horizon that has been inside the stone. It makes the stone bright. Glare is not included.";
const UNRESOLVED: &str = "Light that was not followed to its end. Other figures may be too low by as much.";
const HIDDEN: &str =
    "The area where unresolved light may hide a stronger exit, or where no light leaves the stone.";

const fn zone(name: &'static str, band: &'static str, meaning: &'static str) -> Figure {
    Figure { name, meaning, is_strong: false, source: Source::Zone(band) }
}

const fn total(name: &'static str, meaning: &'static str, of: fn(&Figures, &Scope) -> f64) -> Figure {
    Figure { name, meaning, is_strong: false, source: Source::Total(of) }
}

impl Figure {
    /// Returns the band of the scope whose colour the figure has, where it is a zone.
    pub fn band(&self) -> Option<&'static str> {
        match self.source {
            Source::Zone(band) => Some(band),
            Source::Total(_) => None,
        }
    }

    /// Returns the figure, as a part of the stone's outline; 0 for a zone that the scope lacks.
    fn of(&self, ShownFigures { order, figures, .. }: &ShownFigures, counting: Counting) -> f64 {
        let scope = aset(order.head);
        let band = match self.source {
            Source::Total(of) => return of(figures, &scope),
            Source::Zone(name) => scope.bands.iter().position(|band| band.name == name),
        };
        band.map_or(0.0, |band| {
            if counting.by_area {
                figures.strongest_exit_area[band]
            } else {
                energy(figures, band, counting.glare)
            }
        })
    }
}

/// The name of the zone that the panel shows where the observer has a head.
const HEAD: &str = "Head";
/// The name of the total that the panel shows where glare is included.
const WITH_GLARE: &str = "With glare";

/// The name of the total that stands for the unresolved light where it is estimated.
const ESTIMATED: &str = "Estimated";

/// The way in which figures are counted.
#[derive(Debug, Clone, Copy)]
pub struct Counting {
    /// True where zones count the areas of the strongest exits, and not energy.
    pub by_area: bool,
    /// Included where zones contain glare.
    pub glare: Glare,
}

impl Counting {
    /// Returns the way in which a workspace counts figures.
    pub fn of(workspace: &Workspace) -> Self {
        Self { by_area: workspace.by_area, glare: workspace.glare() }
    }
}

/// A figure of the present stone, with that of the other stone of a comparison.
#[derive(Debug, Clone, Copy)]
pub struct FigureLine {
    pub figure: &'static Figure,
    /// The share of the present stone's outline.
    pub share: f64,
    /// The share of the outline of the other stone of a comparison, if any.
    pub other: Option<f64>,
    /// The greatest difference between `share` and `other` that the same stone could have now; 0 once both are final.
    pub error: f64,
}

impl FigureLine {
    /// Returns by how much the figure of the present design exceeds that of the other.
    ///
    /// `None` while the difference may be no more than the uncertainty of both.
    pub fn difference(&self) -> Option<f64> {
        let difference = self.share - self.other?;
        (self.error == 0.0 || difference.abs() > self.error).then_some(difference)
    }
}

/// Returns all figures in the order of the panel: those of zones first.
pub fn lines(measured: &ShownFigures, other: Option<&ShownFigures>, counting: Counting) -> Vec<FigureLine> {
    let error = other.map_or(0.0, |other| error(measured, other, counting.by_area));
    let totals = if counting.by_area { std::slice::from_ref(&UNDECIDED) } else { &TOTALS };
    let is_shown = |figure: &&Figure| match figure.name {
        HEAD => measured.order.head > 0.0,
        WITH_GLARE => counting.glare == Glare::Included,
        "Unresolved" => measured.figures.estimate.is_none(),
        ESTIMATED => measured.figures.estimate.is_some(),
        _ => true,
    };
    let line = |figure: &'static Figure| FigureLine {
        figure,
        share: figure.of(measured, counting),
        other: other.map(|other| figure.of(other, counting)),
        error,
    };
    ZONES.iter().chain(totals).filter(is_shown).map(line).collect()
}

/// The number of standard errors within which figures by rays almost always lie.
const SIGMAS: f64 = 4.0;

/// Returns the greatest difference between two figures that the same stone could have while one or both become finer.
///
/// Each figure may be too low by its unresolved light. Final figures are compared as they are: their error is 0.
fn error(present: &ShownFigures, other: &ShownFigures, by_area: bool) -> f64 {
    let both = [present, other];
    if both.iter().all(|measured| measured.grade == Grade::Fine) {
        return 0.0;
    }
    let unresolved = both.map(
        |ShownFigures { figures, .. }| {
            if by_area { figures.strongest_exit_undecided } else { figures.uncertain() }
        },
    );
    let sampled = both.map(
        |ShownFigures { figures, .. }| if by_area { figures.area_error() } else { figures.standard_error },
    );
    unresolved[0].max(unresolved[1]) + SIGMAS * (sampled[0] + sampled[1])
}

/// Returns the common ASET with an observer's head of a half angle in degrees; 0 for none.
fn aset(head: f64) -> Scope {
    Scoped::aset().with_head(head)
}

/// Returns the zones of the common ASET with a head, each with the number of its band.
pub fn zones(head: f64) -> Vec<(&'static Figure, usize)> {
    let scope = aset(head);
    let number = |zone: &Figure| scope.bands.iter().position(|band| zone.band() == Some(band.name.as_str()));
    ZONES.iter().filter_map(|zone| Some((zone, number(zone)?))).collect()
}

/// Returns the light of a band, with or without glare; 0 where the figures lack the band, as they may lack the head.
pub fn energy(figures: &Figures, band: usize, glare: Glare) -> f64 {
    let of = |zones: &[f64]| zones.get(band).copied().unwrap_or(0.0);
    of(&figures.transmitted) + if glare == Glare::Included { of(&figures.surface) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_base::unwatched;
    use brillianteer_measure::by_beams;
    use brillianteer_optics::line;
    use brillianteer_scene::View;
    use brillianteer_session::model::document::Document;
    use brillianteer_session::studio::FiguresOrder;
    use brillianteer_trace::beam;
    use std::sync::Arc;

    /// Returns the figures of the first stone, with a share of the light left unresolved.
    fn measured(unresolved: f64, grade: Grade) -> ShownFigures {
        let specimen = Arc::clone(Document::first().unwrap().specimen());
        let options = beam::BeamOptions { unresolved, ..beam::BeamOptions::default() };
        let (medium, view) = (specimen.medium(line::SODIUM_D), View::default());
        let beams =
            beam::trace(&specimen.stone().unwrap().polytope, medium, &view, &options, &unwatched).unwrap();
        let figures = by_beams(&beams, &Scoped::aset().scope);
        ShownFigures { order: FiguresOrder { document: 0, specimen, view, head: 0.0 }, grade, figures }
    }

    #[test]
    fn two_grades_of_the_same_stone_are_never_different() {
        let fine = measured(1.5e-4, Grade::Fine);
        let mut apart: f64 = 0.0;
        for unresolved in [2e-3, 2e-2, 8e-2] {
            let rough = measured(unresolved, Grade::Rough);
            for by_area in [false, true] {
                let counting = Counting { by_area, glare: Glare::Included };
                for line in
                    lines(&rough, Some(&fine), counting).iter().filter(|line| line.figure.band().is_some())
                {
                    let (name, error) = (line.figure.name, line.error);
                    let difference = (line.share - line.other.unwrap()).abs();
                    assert!(difference <= error, "{name} at {unresolved}: {difference} is above {error}");
                    apart = apart.max(difference);
                }
            }
        }
        assert!(apart > 5e-3, "the grades differ visibly: by {apart}");
        assert_eq!(error(&fine, &fine, false), 0.0);
    }
}
