//! The search for a better cut, as its window shows it: the goal, the progress and the report.
//!
//! While a search runs, the document shows the best design so far. The document's history ignores these changes until
//! the search ends, so the whole search is one step of undo.

use super::goal_form::{GoalForm, GoalFormFault};
use brillianteer_base::Failure;
use brillianteer_cut::{Cut, CutClass, Design};
use brillianteer_search::{
    Appraisal, Goal, OtherMeasure, ProgressPoint, SearchOptions, SearchOutcome, SearchProgress, VariedNumber,
};

/// Numbers that differ by less than this are equal: the search rounds its values.
const SAME: f64 = 1e-9;

/// The request for a search, which a task carries out.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchRequest {
    /// The number of the search, which its answers carry.
    pub number: u64,
    /// The design that is to become better.
    pub design: Design,
    /// The goal by which designs are appraised.
    pub goal: Goal,
    /// The number of trials, their accuracy and the steps of angles.
    pub options: SearchOptions,
}

/// A message of a running search.
#[derive(Debug)]
pub enum SearchEvent {
    /// The progress so far, with the best design.
    Progress(SearchProgress),
    /// The result at the end or after a stop, or the reason why the search failed.
    Ended(Result<Box<SearchReport>, Failure>),
}

/// The result of a search.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchReport {
    /// The best design and its appraisal.
    pub outcome: SearchOutcome,
    /// The appraisal of the design from before the search.
    pub start: Appraisal,
    /// The numbers that changed.
    pub numbers: Vec<VariedNumber>,
    /// The numbers that were held, because a change of them alone breaks a meet.
    pub held: Vec<VariedNumber>,
    /// The classes before and after, estimated after what GIA publishes; `None` where the design is no round brilliant of diamond.
    pub classes: Option<[CutClass; 2]>,
    /// The usual measures that the goal does not weigh.
    pub others: Vec<OtherMeasure>,
}

impl SearchReport {
    /// Returns whether the search found a better design than the one from before.
    pub fn is_better(&self) -> bool {
        let is_moved = |(number, value): (&VariedNumber, &f64)| (number.start - value).abs() > SAME;
        self.numbers.iter().zip(&self.outcome.values).any(is_moved)
    }
}

/// A search that is under way.
#[derive(Debug, Clone)]
pub struct RunningSearch {
    number: u64,
    before: Design,
    shown: Design,
    /// The number of designs that were tried.
    pub tried: usize,
    /// The part of the work that is certainly done, 0 to 1.
    pub part: f64,
    /// The totals of the best designs in the order in which they were found.
    pub curve: Vec<ProgressPoint>,
    /// True from the stop request on, while the search measures the best design to its end.
    pub is_stopping: bool,
}

impl RunningSearch {
    /// Returns the design as it was when the search began.
    pub fn before(&self) -> &Design {
        &self.before
    }

    /// Returns the design that the search put into the document last.
    pub fn shown(&self) -> &Design {
        &self.shown
    }

    /// Records progress; returns the new best cut, if there is one.
    fn take(&mut self, progress: SearchProgress) -> Option<Cut> {
        let SearchProgress { appraised, part, best_total, new_best } = progress;
        self.tried = self.tried.max(appraised);
        self.part = self.part.max(part);
        let total = best_total?;
        let best = new_best?;
        // Threads report in any order, so a better design may have been reported before.
        if self.curve.last().is_some_and(|last| last.total >= total) {
            return None;
        }
        let is_first = self.curve.is_empty();
        self.curve.push(ProgressPoint { appraised, total });
        // The first report is of the design from before the search; its cut differs only where meets were found in
        // it.
        (!is_first || appraised > 0).then_some(best.cut)
    }
}

/// The way in which a search has ended.
#[derive(Debug, Clone)]
pub enum SearchEnd {
    /// The search was completed, or the user stopped it.
    Found(Box<SearchReport>),
    /// The search could not be carried out, for this reason.
    Failed(String),
    /// The user changed the design meanwhile.
    Interrupted,
}

/// A search that has ended.
#[derive(Debug, Clone)]
pub struct EndedSearch {
    /// The design from before the search.
    pub before: Design,
    /// The design that the search has left in the document.
    pub after: Design,
    /// The totals of the best designs in the order in which they were found.
    pub curve: Vec<ProgressPoint>,
    /// The number of designs that were tried.
    pub tried: usize,
    /// The way in which the search has ended.
    pub end: SearchEnd,
}

impl EndedSearch {
    /// Returns whether the search has changed the design.
    pub fn has_changed(&self) -> bool {
        self.before != self.after
    }
}

/// The state of the search window.
#[derive(Debug, Clone, Default)]
pub enum SearchState {
    /// A goal is being chosen.
    #[default]
    Choosing,
    /// A search is under way.
    Running(Box<RunningSearch>),
    /// A search has ended, and its outcome is in sight.
    Ended(Box<EndedSearch>),
}

/// The search for a better cut.
#[derive(Debug, Clone, Default)]
pub struct CutSearch {
    /// True while the window of the search is open.
    pub is_open: bool,
    /// The form with goal, ranges and effort.
    pub form: GoalForm,
    /// The state of the search: choosing, running or ended.
    pub state: SearchState,
    /// The cut whose numbers the form has.
    looked: Option<Cut>,
    /// The number of searches begun so far; each takes the next as its own number.
    begun: u64,
}

impl CutSearch {
    /// Returns the search that is under way.
    pub fn running(&self) -> Option<&RunningSearch> {
        match &self.state {
            SearchState::Running(running) => Some(running),
            _ => None,
        }
    }

    /// Lets the form follow the numbers of a cut.
    pub fn follow(&mut self, cut: &Cut) {
        if self.looked.as_ref() != Some(cut) {
            self.form.follow(cut);
            self.looked = Some(cut.clone());
        }
    }

    /// Forgets the search and the numbers of the design, because another document begins; the measures stay chosen.
    pub fn begin(&mut self) {
        self.state = SearchState::Choosing;
        self.form.numbers.clear();
        self.looked = None;
    }

    /// Begins a search, and returns the request for the task that carries it out.
    ///
    /// # Errors
    /// Fails where the form lacks a measure or a number, or holds a wrong range.
    pub fn start(&mut self, design: &Design) -> Result<SearchRequest, GoalFormFault> {
        let goal = self.form.wanted()?;
        self.begun += 1;
        let number = self.begun;
        self.state = SearchState::Running(Box::new(RunningSearch {
            number,
            before: design.clone(),
            shown: design.clone(),
            tried: 0,
            part: 0.0,
            curve: vec![],
            is_stopping: false,
        }));
        let angle_step_deg = self.form.angle_step_deg;
        let options = SearchOptions { angle_step_deg, ..self.form.effort.options(goal.vary.len()) };
        Ok(SearchRequest { number, design: design.clone(), goal, options })
    }

    /// Marks the running search as stopping.
    pub fn stop(&mut self) {
        if let SearchState::Running(running) = &mut self.state {
            running.is_stopping = true;
        }
    }

    /// Ends the search that is under way, and returns the design as it was before.
    pub fn discard(&mut self) -> Option<Design> {
        match std::mem::take(&mut self.state) {
            SearchState::Running(running) => Some(running.before),
            other => {
                self.state = other;
                None
            }
        }
    }

    /// Ends the search that is under way, because the design was changed; returns the design that it had put into the document.
    pub fn interrupt(&mut self) -> Option<Design> {
        let SearchState::Running(running) = &self.state else { return None };
        let shown = running.shown.clone();
        self.end(shown.clone(), SearchEnd::Interrupted);
        Some(shown)
    }

    /// Takes a message of the search of this number, and returns the design that replaces the document's; `None`
    /// where the document keeps its design.
    pub fn take(&mut self, number: u64, event: SearchEvent) -> Option<Design> {
        let SearchState::Running(running) = &mut self.state else { return None };
        if running.number != number {
            return None;
        }
        match event {
            SearchEvent::Progress(progress) => {
                let cut = running.take(progress)?;
                running.shown.cut = cut;
                Some(running.shown.clone())
            }
            SearchEvent::Ended(ended) => {
                let mut after = running.before.clone();
                let end = match ended {
                    Ok(report) => {
                        if report.is_better() {
                            after.cut = report.outcome.design.cut.clone();
                        }
                        SearchEnd::Found(report)
                    }
                    Err(Failure::Stopped) => SearchEnd::Failed(
                        "The search was stopped before it had measured the design as it is.".to_owned(),
                    ),
                    Err(why) => SearchEnd::Failed(why.to_string()),
                };
                self.end(after.clone(), end);
                Some(after)
            }
        }
    }

    fn end(&mut self, after: Design, end: SearchEnd) {
        if let SearchState::Running(running) = std::mem::take(&mut self.state) {
            let RunningSearch { before, tried, curve, .. } = *running;
            let (tried, curve) = match &end {
                SearchEnd::Found(report) => (report.outcome.appraised, report.outcome.curve.clone()),
                _ => (tried, curve),
            };
            self.state = SearchState::Ended(Box::new(EndedSearch { before, after, curve, tried, end }));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::document::Document;

    /// Returns the message of a best design with this crown angle.
    fn best(design: &Design, appraised: usize, total: f64, crown: f64) -> SearchEvent {
        let mut best = design.clone();
        let row = best.cut.proportion("crown_angle").and_then(|row| row.give).unwrap();
        row(&mut best.cut, crown);
        let new_best = Some(Box::new(best));
        SearchEvent::Progress(SearchProgress { appraised, part: 0.1, best_total: Some(total), new_best })
    }

    #[test]
    fn what_an_older_search_says_and_what_comes_too_late_is_dropped() {
        let design = Document::first().unwrap().work.design;
        let mut search = CutSearch::default();
        search.follow(&design.cut);
        let older = search.start(&design).unwrap().number;
        assert_eq!(search.discard(), Some(design.clone()));
        assert!(search.take(older, best(&design, 3, 0.9, 30.0)).is_none());
        let number = search.start(&design).unwrap().number;
        assert!(search.take(older, best(&design, 3, 0.9, 30.0)).is_none());
        assert!(search.take(number, best(&design, 0, 0.5, 34.5)).is_none(), "the design as it was given");
        let shown = search.take(number, best(&design, 7, 0.7, 31.0)).unwrap();
        assert_ne!(shown.cut, design.cut);
        assert!(search.take(number, best(&design, 6, 0.6, 32.0)).is_none(), "a worse one that comes later");
        let running = search.running().unwrap();
        assert_eq!((running.shown(), running.tried, running.curve.len()), (&shown, 7, 2));
        let failed = SearchEvent::Ended(Err(Failure::Stopped));
        assert_eq!(search.take(number, failed), Some(design), "nothing is kept that was not measured");
    }
}
