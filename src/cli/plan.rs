//! Chooses the tracer for a picture from the option `--tracer`.

use super::options::TracerName;
use super::say;
use crate::render::{CardUse, Demands, Unfit, Wanted, plan};
use crate::trace::{RayTracer, Tracer};

impl From<TracerName> for Wanted {
    fn from(name: TracerName) -> Self {
        match name {
            TracerName::Auto => Self::Quickest,
            TracerName::Beam => Self::Beams,
            TracerName::Ray => Self::Rays,
            TracerName::Gpu => Self::Card,
        }
    }
}

/// Chooses the tracer, on this machine's card where one may be used. Prints a note where the processor does a card's work.
pub fn planned(demands: &Demands, wanted: TracerName) -> Result<Tracer<'static>, Unfit> {
    let plan = plan(demands, wanted.into(), CardUse::Machine)?;
    plan.no_card.iter().for_each(|why| say_no_card(why));
    Ok(plan.tracer)
}

/// Returns this machine's card, even a slow one. Where there is none, it returns the processor and prints a note.
pub fn on_card() -> RayTracer<'static> {
    let (tracer, no_card) = CardUse::Machine.any();
    no_card.iter().for_each(|why| say_no_card(why));
    tracer
}

fn say_no_card(why: &str) {
    say(&format!("note: {why}: tracing by rays on the processor"));
}
