//! The tracer that an option asks for, planned.

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

/// Plans who traces, on the machine's card where one may be used, and says so where the processor does its work.
pub fn planned(demands: &Demands, wanted: TracerName) -> Result<Tracer<'static>, Unfit> {
    let plan = plan(demands, wanted.into(), CardUse::Machine)?;
    plan.no_card.iter().for_each(|why| say_no_card(why));
    Ok(plan.tracer)
}

/// The machine's card, be it slow, or the processor and a note on why.
pub fn on_card() -> RayTracer<'static> {
    let (tracer, no_card) = CardUse::Machine.any();
    no_card.iter().for_each(|why| say_no_card(why));
    tracer
}

fn say_no_card(why: &str) {
    say(&format!("note: {why}: tracing by rays on the processor"));
}
