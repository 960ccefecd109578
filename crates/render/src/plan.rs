//! Plans which tracer makes a picture or figures. No other place of the program decides this.

use super::card::{Backend, Card, NoCard};
use super::check::JobError;
use super::job::{Job, LightProduct, Product, Steps};
use brillianteer_base::Failure;
use brillianteer_math::{NotConvex, SolidRef};
use brillianteer_scene::{Projection, USUAL_BOUNCES, View};
use brillianteer_trace::ray::Camera;
use serde::{Deserialize, Serialize};

/// The tracer of a request.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Wanted {
    /// The quickest: exact beams; a graphics card for renders and where beams do not apply; else rays.
    #[default]
    Quickest,
    /// Exact beams, in f64, for parallel rays.
    Beams,
    /// Point rays on the processor: in f32 for pictures under light without meshes, in f64 for all else.
    Rays,
    /// Point rays on a graphics card, in f32.
    Card,
}

/// The demands of a picture or of figures, which decide the tracers that fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Demands {
    /// The reason why exact beams do not fit, or `None` where they fit.
    pub against_beams: Option<Unfit>,
    /// The gain by a graphics card over exact beams.
    pub card: CardWorth,
    /// The reason why rays on the processor replace a card for this job; `None` where a card can do it, or where a
    /// request for it is refused.
    pub no_card: Option<NoCard>,
}

/// The gain by a graphics card over the processor for a piece of work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CardWorth {
    /// No gain: only the processor can do the work.
    Nothing,
    /// A card is quicker than rays on the processor, but not than exact beams.
    Little,
    /// A card is quicker than exact beams as well, as for pictures under light that have many wavelengths.
    Much,
}

/// The reason why a job cannot be done, or not by exact beams.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Unfit {
    /// The job is impossible for every tracer.
    #[error(transparent)]
    Job(#[from] JobError),
    /// The eye of a perspective is beside or inside the stone, so that no tracer can show it.
    #[error("the eye of the perspective is not in front of the whole stone; move it farther away")]
    Eye,
    /// The scene has no stone.
    #[error("the scene holds no stone")]
    NoStone,
    /// The view has a perspective.
    #[error("exact beams are for parallel rays: trace a perspective by rays")]
    Perspective,
    /// The stone is not convex or has no flat facets.
    #[error(transparent)]
    NotConvex(#[from] NotConvex),
    /// The scene holds metal, which exact beams, scopes, figures and refraction maps know nothing of.
    #[error(
        "only rays in pictures under light reflect metal: trace by rays or by a graphics card, and make no scope, figures, \
         contrast map or refraction map of it"
    )]
    Metal,
    /// A stone has frosted facets, which exact beams, graphics cards and refraction maps know nothing of.
    #[error(
        "the stone has frosted facets, which scatter light: trace by rays, and make no refraction map of it"
    )]
    Frosted,
    /// The scene has several bodies, a body that is not convex, a perspective, or a backplate.
    #[error(
        "exact beams are for one convex stone, parallel rays and no world, pattern or photograph behind: trace by rays"
    )]
    NotAlone,
    /// Refraction is followed only part of the way.
    #[error("exact beams cannot mix refracted and straight rays: trace by rays, or set the strength to 1")]
    Mixture,
    /// Light is followed through fewer bounces than usual.
    #[error("exact beams cannot end after some bounces: trace by rays, or follow 64 bounces")]
    FewBounces,
    /// Measures of light, or a contrast map, are requested for something that exact beams cannot trace, or from another tracer.
    #[error(
        "measures of light and contrast maps are sums over exact beams: they need a convex stone between planes, parallel rays, \
         and no other tracer"
    )]
    OnlyBeams,
    /// Light is followed along many paths at once, as in refraction maps and liquid glass.
    #[error(
        "refraction maps and liquid glass are traced by rays on the processor: choose these, or no tracer"
    )]
    ManyPaths,
}

impl Unfit {
    /// Returns this as the failure of a request about a file; it names the file where the file is at fault.
    pub fn failure(&self, file: &str) -> Failure {
        match self {
            Self::Eye => Failure::Input(format!("{file}: {self}")),
            Self::NotConvex(_) => Failure::Usage(format!("{file}: {self}")),
            _ => Failure::Usage(self.to_string()),
        }
    }
}

/// The planned tracer.
#[derive(Clone)]
pub struct Plan {
    /// The tracer, with the card that it runs on.
    pub backend: Backend,
    /// The reason why no graphics card is used though the job requests one.
    pub no_card: Option<NoCard>,
}

impl Demands {
    /// Returns the demands of a job.
    ///
    /// # Errors
    /// Fails with [`Unfit::NoStone`] and [`Unfit::Eye`] where a scope or figures have no stone, or an eye that cannot
    /// see it; [`Unfit::Metal`] where the scene has metal and the product is no picture under light;
    /// [`Unfit::OnlyBeams`] where measures of light are requested of something that beams do not trace;
    /// [`Unfit::Frosted`] for a refraction map of frosted facets.
    pub fn of(job: &Job) -> Result<Self, Unfit> {
        match &job.product {
            Product::Light(light) => Ok(Self::of_light(job, light)),
            Product::Scope(_)
            | Product::Figures(_)
            | Product::Measures(_)
            | Product::Contrast(_)
            | Product::RefractionMap(_)
                if !job.scene.metals.is_empty() =>
            {
                Err(Unfit::Metal)
            }
            Product::Scope(_) | Product::Figures(_) => Self::of_scope(job.stone()?, &job.view),
            Product::RefractionMap(_) if job.scene.is_frosted() => Err(Unfit::Frosted),
            Product::Measures(_) | Product::Contrast(_) => Self::of_measures(job),
            Product::RefractionMap(_) | Product::LiquidGlass(_) => {
                Ok(Self { against_beams: Some(Unfit::ManyPaths), card: CardWorth::Nothing, no_card: None })
            }
        }
    }

    /// Returns the demands of stones with frosted facets: only rays on the processor follow their scattered light, or
    /// count the part of it that they do not follow.
    fn frosted() -> Self {
        let (against_beams, no_card) = (Some(Unfit::Frosted), Some(NoCard::frosted()));
        Self { against_beams, card: CardWorth::Nothing, no_card }
    }

    fn of_scope(solid: SolidRef, view: &View) -> Result<Self, Unfit> {
        if Camera::new(view, solid).reach(solid).is_none() {
            return Err(Unfit::Eye);
        }
        // Rays count the light that meets frosted facets as unresolved.
        if matches!(solid, SolidRef::Convex(polytope) if polytope.is_frosted()) {
            return Ok(Self::frosted());
        }
        Ok(Self::of_polished(solid, view))
    }

    /// Returns the demands of a scope or of figures of a solid whose facets count as polished.
    fn of_polished(solid: SolidRef, view: &View) -> Self {
        let against_beams = match solid {
            _ if view.projection != Projection::Orthographic => Some(Unfit::Perspective),
            SolidRef::Convex(_) => None,
            SolidRef::Triangles(_) | SolidRef::Smooth(_) => Some(NotConvex.into()),
        };
        Self { against_beams, card: CardWorth::Little, no_card: None }
    }

    /// Returns the demands of measures of light. They are those of the stone as if all its facets were polished, which is
    /// said where a stone with frosted facets is built.
    fn of_measures(job: &Job) -> Result<Self, Unfit> {
        let solid = job.stone()?;
        Self::of_scope(solid, &job.view)?;
        let demands = Self::of_polished(solid, &job.view);
        let is_asked = matches!(job.quality.tracer, Wanted::Beams | Wanted::Quickest);
        if is_asked && demands.against_beams.is_none() { Ok(demands) } else { Err(Unfit::OnlyBeams) }
    }

    fn of_light(job: &Job, light: &LightProduct) -> Self {
        if job.scene.is_frosted() {
            return Self::frosted();
        }
        let is_alone = matches!(&*job.scene.instances, [only] if only.body.stone().is_ok());
        let has_backplate = light.surroundings.backplate.is_some();
        let fits = is_alone && !has_backplate && job.view.projection == Projection::Orthographic;
        let against_beams = match fits {
            _ if !job.scene.metals.is_empty() => Some(Unfit::Metal),
            _ if light.strength < 1.0 => Some(Unfit::Mixture),
            _ if job.quality.rays.most_bounces < USUAL_BOUNCES => Some(Unfit::FewBounces),
            false => Some(Unfit::NotAlone),
            true => None,
        };
        // A card is set up anew for each picture, which takes longer than a glance by beams.
        let card =
            if matches!(light.steps, Steps::Glance { .. }) { CardWorth::Little } else { CardWorth::Much };
        Self { against_beams, card, no_card: None }
    }
}

/// Decides which tracer does the work. The card is opened only where it may be used.
///
/// # Errors
/// Fails with [`Unfit`] where exact beams are requested and do not fit, or a card for work that no card does.
pub fn plan(demands: &Demands, wanted: Wanted, card: &Card) -> Result<Plan, Unfit> {
    if let (Wanted::Card, Some(why)) = (wanted, &demands.no_card) {
        return Ok(Plan { backend: Backend::Rays, no_card: Some(why.clone()) });
    }
    let mut no_card = None;
    let by_processor = || if demands.against_beams.is_none() { Backend::Beams } else { Backend::Rays };
    let backend = match (wanted, &demands.against_beams, demands.card) {
        (Wanted::Beams, Some(why), _) | (Wanted::Card, Some(why), CardWorth::Nothing) => {
            return Err(why.clone());
        }
        (Wanted::Beams, None, _) => Backend::Beams,
        (Wanted::Rays, ..) | (_, _, CardWorth::Nothing) => Backend::Rays,
        (Wanted::Card, ..) => card.any().unwrap_or_else(|why| {
            no_card = Some(why);
            Backend::Rays
        }),
        (Wanted::Quickest, None, CardWorth::Little) => Backend::Beams,
        (Wanted::Quickest, ..) => card.quick().unwrap_or_else(by_processor),
    };
    Ok(Plan { backend, no_card })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tracer(demands: &Demands, wanted: Wanted) -> Result<&'static str, Unfit> {
        plan(demands, wanted, &Card::None).map(|plan| plan.backend.name())
    }

    #[test]
    fn a_card_is_refused_where_it_is_never_used() {
        let against_beams = Some(Unfit::ManyPaths);
        let paths = Demands { against_beams: against_beams.clone(), card: CardWorth::Nothing, no_card: None };
        assert_eq!([Wanted::Quickest, Wanted::Rays].map(|w| tracer(&paths, w)), [Ok("ray"), Ok("ray")]);
        assert_eq!(tracer(&paths, Wanted::Card), Err(Unfit::ManyPaths));
        let little = Demands { against_beams, card: CardWorth::Little, no_card: None };
        assert_eq!(tracer(&little, Wanted::Card), Ok("ray"));
    }

    #[test]
    fn beams_are_taken_where_they_fit_and_refused_with_the_reason_where_not() {
        let fit = Demands { against_beams: None, card: CardWorth::Much, no_card: None };
        let found = [Wanted::Quickest, Wanted::Beams, Wanted::Rays, Wanted::Card].map(|w| tracer(&fit, w));
        assert_eq!(found, [Ok("beam"), Ok("beam"), Ok("ray"), Ok("ray")]);
        for why in [
            Unfit::Perspective,
            Unfit::NotConvex(NotConvex),
            Unfit::NotAlone,
            Unfit::Mixture,
            Unfit::FewBounces,
        ] {
            let unfit = Demands { against_beams: Some(why.clone()), card: CardWorth::Little, no_card: None };
            assert_eq!(tracer(&unfit, Wanted::Quickest), Ok("ray"));
            assert_eq!(tracer(&unfit, Wanted::Beams), Err(why));
        }
    }
}
