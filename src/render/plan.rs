//! Plans which tracer makes a picture or figures. No other place decides this.

use super::CardUse;
use crate::math::NotConvex;
use crate::scene::{Projection, Scene, Specimen, View};
use crate::trace::{RayTracer, Tracer};

/// The tracer that a person or a program wants.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Wanted {
    /// The quickest that fits.
    #[default]
    Quickest,
    /// Exact beams.
    Beams,
    /// Point rays on the processor.
    Rays,
    /// Point rays on a graphics card.
    Card,
}

/// What decides which tracers fit a picture or figures.
#[derive(Debug, Clone, PartialEq)]
pub struct Demands {
    /// Why exact beams do not fit, or `None` where they fit.
    pub against_beams: Option<Unfit>,
    /// Whether a graphics card is quicker than exact beams, as for pictures under light that have many wavelengths.
    pub favours_card: bool,
}

/// Why exact beams do not fit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Unfit {
    /// The view has a perspective.
    #[error("exact beams are for parallel rays: trace a perspective by rays")]
    Perspective,
    /// The stone is not convex or has no flat facets.
    #[error(transparent)]
    NotConvex(#[from] NotConvex),
    /// There are several bodies, a body that is not convex, a perspective, or a backplate.
    #[error(
        "exact beams are for one convex stone, parallel rays and no pattern or photograph behind: trace by rays"
    )]
    NotAlone,
    /// Refraction is followed only part of the way.
    #[error(
        "exact beams know no mixture of refracted and straight rays: trace by rays, or set the strength to 1"
    )]
    Mixture,
}

/// The planned tracer.
#[derive(Clone)]
pub struct Plan<'a> {
    /// The tracer.
    pub tracer: Tracer<'a>,
    /// Why no graphics card is used though one was wanted.
    pub no_card: Option<String>,
}

impl Demands {
    /// Returns the demands of pictures and figures of one stone in a scope.
    pub fn of_scope(specimen: &Specimen, view: &View) -> Self {
        let against_beams = match specimen.stone() {
            _ if view.projection != Projection::Orthographic => Some(Unfit::Perspective),
            Err(why) => Some(why.into()),
            Ok(_) => None,
        };
        Self { against_beams, favours_card: false }
    }

    /// Returns the demands of a picture under light. `strength` is how much of the way refraction is followed: 1 is physics.
    pub fn of_light(scene: &Scene, view: &View, has_backplate: bool, strength: f64) -> Self {
        let is_alone = matches!(&*scene.instances, [only] if only.body.stone().is_ok());
        let fits = is_alone && !has_backplate && view.projection == Projection::Orthographic;
        let against_beams = match fits {
            _ if strength < 1.0 => Some(Unfit::Mixture),
            false => Some(Unfit::NotAlone),
            true => None,
        };
        Self { against_beams, favours_card: true }
    }

    /// Whether exact beams fit.
    pub fn fit_beams(&self) -> bool {
        self.against_beams.is_none()
    }

    /// Returns the quickest tracer that fits and needs no graphics card.
    pub fn by_processor(&self) -> Tracer<'static> {
        if self.fit_beams() { Tracer::Beams } else { Tracer::Rays(RayTracer::Rays) }
    }
}

/// Decides which tracer does the work. The card is opened only where it may be used.
///
/// # Errors
/// [`Unfit`] where exact beams are wanted and do not fit.
pub fn plan<'a>(demands: &Demands, wanted: Wanted, card: CardUse<'a>) -> Result<Plan<'a>, Unfit> {
    let mut no_card = None;
    let tracer = match (wanted, &demands.against_beams) {
        (Wanted::Beams, Some(why)) => return Err(why.clone()),
        (Wanted::Beams, None) => Tracer::Beams,
        (Wanted::Rays, _) => Tracer::Rays(RayTracer::Rays),
        (Wanted::Card, _) => {
            let (tracer, why) = card.any();
            no_card = why;
            Tracer::Rays(tracer)
        }
        (Wanted::Quickest, None) if !demands.favours_card => Tracer::Beams,
        (Wanted::Quickest, against) => match (card.quickest(), against) {
            (RayTracer::Rays, None) => Tracer::Beams,
            (quickest, _) => Tracer::Rays(quickest),
        },
    };
    Ok(Plan { tracer, no_card })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tracer(demands: &Demands, wanted: Wanted) -> Result<&'static str, Unfit> {
        plan(demands, wanted, CardUse::Open(RayTracer::Rays)).map(|plan| plan.tracer.name())
    }

    #[test]
    fn beams_are_taken_where_they_fit_and_refused_with_the_reason_where_not() {
        let fit = Demands { against_beams: None, favours_card: true };
        let found = [Wanted::Quickest, Wanted::Beams, Wanted::Rays, Wanted::Card].map(|w| tracer(&fit, w));
        assert_eq!(found, [Ok("beam"), Ok("beam"), Ok("ray"), Ok("ray")]);
        for why in [Unfit::Perspective, Unfit::NotConvex(NotConvex), Unfit::NotAlone, Unfit::Mixture] {
            let unfit = Demands { against_beams: Some(why.clone()), favours_card: false };
            assert_eq!(tracer(&unfit, Wanted::Quickest), Ok("ray"));
            assert_eq!(tracer(&unfit, Wanted::Beams), Err(why));
        }
    }
}
