//! Searches for a better cut, on threads of their own.

use crate::model::cut_search::{SearchEvent, SearchReport, SearchRequest};
use crate::urgency;
use brillianteer_base::Failure;
use brillianteer_search::{DesignSearch, OtherMeasure, SearchError, SearchProgress, estimated_classes};
use rayon::ThreadPoolBuilder;
use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The least time between two reports of progress without a better design.
const EVERY: Duration = Duration::from_millis(60);

/// Carries out a search; `say` gets its progress.
///
/// # Errors
/// Fails where the goal or the design has a fault. Returns [`Failure::Stopped`] where the search was stopped before
/// it began.
pub fn search(
    request: &SearchRequest,
    say: &(dyn Fn(SearchEvent) + Sync),
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> Result<Box<SearchReport>, Failure> {
    // In the pool of the tracers, pictures of the best design would wait for the search. These threads have a lower
    // priority.
    let threads = ThreadPoolBuilder::new()
        .thread_name(|k| format!("search {k}"))
        .start_handler(|_| urgency::lower_most())
        .build();
    let found = match threads {
        Ok(threads) => threads.install(|| found(request, say, is_stopped)),
        Err(_) => found(request, say, is_stopped),
    };
    found.map_err(|error| match error {
        SearchError::Stopped => Failure::Stopped,
        error => Failure::Input(error.to_string()),
    })
}

fn found(
    request: &SearchRequest,
    say: &(dyn Fn(SearchEvent) + Sync),
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> Result<Box<SearchReport>, SearchError> {
    let watch = |_: f64| if is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    let search = DesignSearch::new(&request.design, &request.goal, request.options, &watch)?;
    let said: Mutex<Option<Instant>> = Mutex::default();
    let outcome = search.run(&watch, &|progress: &SearchProgress| {
        // Every report redraws the window.
        let mut said = said.lock().unwrap_or_else(PoisonError::into_inner);
        if progress.new_best.is_some() || said.is_none_or(|last| last.elapsed() >= EVERY) {
            *said = Some(Instant::now());
            say(SearchEvent::Progress(progress.clone()));
        }
    })?;
    let others = OtherMeasure::all(&search, &outcome, &brillianteer_base::unwatched)?;
    let objective = search.objective();
    Ok(Box::new(SearchReport {
        start: objective.start().clone(),
        numbers: objective.numbers().to_vec(),
        held: objective.held().to_vec(),
        classes: estimated_classes(&search, &outcome),
        others,
        outcome,
    }))
}
