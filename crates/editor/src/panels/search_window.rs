//! The window that finds a better cut: the form of the goal, the progress, and the report.

use super::goal_rows;
use super::rows::explain;
use super::search_plot;
use super::search_table;
use crate::theme;
use brillianteer_measure::measure_words;
use brillianteer_session::model::{
    Model,
    action::{Actions, FileAction, SearchAction},
    choosing::Purpose,
    command::Command,
    cut_search::{EndedSearch, RunningSearch, SearchEnd, SearchState},
    goal_form::GoalForm,
};
use egui::{
    Button, Context, Pos2, ProgressBar, RichText, ScrollArea, TextStyle, Ui, Vec2, Window, pos2, vec2,
};

/// The size of the window at first, and at least, points.
const SIZES: [Vec2; 2] = [vec2(600.0, 400.0), vec2(440.0, 240.0)];

/// The first place of the window's upper left corner, points: right of the design panel, whose fields it does not
/// cover, and below the upper views, which show the best design so far.
const PLACE: Pos2 = pos2(376.0, 440.0);

/// The room below the scrolled part for a row of buttons, points.
const BELOW: f32 = 40.0;

/// Draws the window where it is open.
pub fn show(model: &Model, actions: &mut Actions, ctx: &Context) {
    if !model.shows_search() {
        return;
    }
    let mut is_open = true;
    let window = Window::new(Command::Search.name())
        .open(&mut is_open)
        .default_size(SIZES[0])
        .min_size(SIZES[1])
        .default_pos(PLACE);
    window.show(ctx, |ui| contents(model, actions, ui));
    actions.push_if(!is_open, Command::Search);
}

fn contents(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let search = &model.session.search;
    match &search.state {
        SearchState::Running(running) => under_way(&search.form, running, actions, ui),
        SearchState::Ended(ended) => over(model, ended, actions, ui),
        SearchState::Choosing => choosing(model, actions, ui),
    }
}

/// Draws the contents in a part that scrolls, and leaves room for the buttons below, and for `more` points.
fn scrolled(ui: &mut Ui, more: f32, contents: impl FnOnce(&mut Ui)) {
    let height = (ui.available_height() - BELOW - more).max(80.0);
    ScrollArea::vertical()
        .max_height(height)
        .min_scrolled_height(height)
        .auto_shrink(false)
        .show(ui, contents);
    ui.separator();
}

/// Returns why the present design has nothing that a search could change; `None` where it has something.
fn nothing_to_change(model: &Model) -> Option<String> {
    let document = &model.document;
    if document.specimen().stone().is_err() {
        return Some(
            "Only a convex stone between planes can be searched: its light is followed exactly.".to_owned(),
        );
    }
    if document.shows_last_possible() || document.fault().is_some() {
        return Some("The design makes no stone now. Mend it first.".to_owned());
    }
    model.session.search.form.numbers.is_empty().then(|| {
        "The design has no numbers that a search can change: it is a mesh or a list of planes. Edit > Turn into tiers lists its \
         facets as tiers, whose angles can change."
            .to_owned()
    })
}

fn choosing(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    if let Some(why) = nothing_to_change(model) {
        ui.label(why);
        return;
    }
    let form = &model.session.search.form;
    let mut now = form.clone();
    let fault = form.wanted().err();
    let line = if fault.is_some() { ui.text_style_height(&TextStyle::Body) + 6.0 } else { 0.0 };
    scrolled(ui, line, |ui| goal_rows::show(&mut now, ui));
    if let Some(fault) = &fault {
        let text = RichText::new(fault.to_string()).color(theme::bad(ui.visuals()));
        ui.add(egui::Label::new(text).truncate());
    }
    ui.horizontal(|ui| {
        let open = ui.button("Open goal…");
        let meaning = "Reads measures, limits and numbers from a goal file, as `brillianteer optimise` does.";
        actions.push_if(explain(ui, open, meaning).clicked(), FileAction::Choose(Purpose::Goal));
        let save = ui.add_enabled(fault.is_none(), Button::new("Save goal…"));
        let meaning = "Writes the measures, limits and numbers to a goal file.";
        actions.push_if(explain(ui, save, meaning).clicked(), FileAction::Choose(Purpose::SaveGoal));
        ui.separator();
        goal_rows::angle_step(&mut now, ui);
        goal_rows::effort(&mut now, ui);
        let start = ui.add_enabled(fault.is_none(), Button::new("Start"));
        let meaning =
            "Searches until it finds nothing better. The best so far is shown in the views; Stop keeps it.";
        actions.push_changed(form, now, |now| SearchAction::Form(Box::new(now)));
        actions.push_if(explain(ui, start, meaning).clicked(), SearchAction::Start);
    });
}

/// Returns in one line the measures and numbers of a search.
fn asked(form: &GoalForm) -> String {
    let measures = form.goal.measure.iter().map(|measure| {
        let wanted = match measure.weight {
            weight if weight > 0.0 => "more ",
            weight if weight < 0.0 => "less ",
            _ => "within limits: ",
        };
        let name = measure_words::name(measure.of);
        format!("{wanted}{}{}", name[..1].to_lowercase(), &name[1..])
    });
    let measures: Vec<String> = measures.collect();
    let varied: Vec<&str> =
        form.numbers.iter().filter(|number| number.is_varied).map(|number| number.name.as_str()).collect();
    format!("{}; by {}", measures.join(", "), varied.join(", "))
}

fn under_way(form: &GoalForm, running: &RunningSearch, actions: &mut Actions, ui: &mut Ui) {
    scrolled(ui, 0.0, |ui| {
        ui.label(asked(form));
        ui.add(ProgressBar::new(running.part as f32).desired_height(6.0));
        ui.label(RichText::new(state(running)).weak().small());
        search_plot::show(&running.curve, running.tried, ui);
    });
    ui.horizontal(|ui| {
        let stop = ui.add_enabled(!running.is_stopping, Button::new("Stop"));
        let meaning = "Stops the search and keeps the best so far.";
        actions.push_if(explain(ui, stop, meaning).clicked(), SearchAction::Stop);
        let discard = ui.button("Discard");
        let meaning = "Stops the search and brings the design back as it was before.";
        actions.push_if(explain(ui, discard, meaning).clicked(), SearchAction::Discard);
    });
}

/// Describes how far a search is.
fn state(running: &RunningSearch) -> String {
    let tried = match running.tried {
        1 => "1 design tried".to_owned(),
        tried => format!("{tried} designs tried"),
    };
    match (running.is_stopping, running.curve.as_slice()) {
        (true, _) => format!("{tried}; the best is being measured…"),
        (false, []) => "the design is being measured as it is…".to_owned(),
        (false, [_]) => format!("{tried}; nothing better yet"),
        (false, [first, .., last]) => {
            format!("{tried}; the goal has grown from {:.4} to {:.4}", first.total, last.total)
        }
    }
}

fn over(model: &Model, ended: &EndedSearch, actions: &mut Actions, ui: &mut Ui) {
    scrolled(ui, 0.0, |ui| {
        ui.label(RichText::new(summary(ended)).strong());
        if let SearchEnd::Found(report) = &ended.end {
            if ended.has_changed() {
                search_table::show(model, report, ui);
                ui.add_space(6.0);
            }
            search_plot::show(&ended.curve, ended.tried, ui);
        }
    });
    let is_present = model.document.work.design == ended.after;
    ui.horizontal(|ui| {
        let is_undone = ended.has_changed() && matches!(ended.end, SearchEnd::Found(_));
        let (name, meaning) = if is_undone {
            ("Keep", "Keeps the design that was found. Edit > Undo still takes it back.")
        } else {
            ("Back", "Goes back to the goal.")
        };
        let keep = ui.button(name);
        actions.push_if(explain(ui, keep, meaning).clicked(), SearchAction::Keep);
        if is_undone {
            let undo = ui.add_enabled(is_present, Button::new("Undo search"));
            let meaning = "Brings the design back as it was before the search.";
            actions.push_if(explain(ui, undo, meaning).clicked(), SearchAction::Undo);
            if !is_present {
                ui.label(RichText::new("the design was changed since").weak());
            }
        }
    });
}

/// Describes in one line how a search has ended.
fn summary(ended: &EndedSearch) -> String {
    let tried = ended.tried;
    match &ended.end {
        SearchEnd::Failed(why) => why.clone(),
        SearchEnd::Interrupted => {
            "The search was stopped because the design was changed. What it had found until then is a step of undo.".to_owned()
        }
        SearchEnd::Found(report) => {
            let stopped = if report.outcome.was_stopped { ", stopped by hand" } else { "" };
            match (ended.has_changed(), report.outcome.keeps_limits) {
                (true, _) if !report.start.keeps_limits() => format!(
                    "A cut that keeps all limits: the goal went from {:.4} to {:.4} ({tried} designs tried{stopped}).",
                    report.start.total.middle(),
                    report.outcome.best.total.middle()
                ),
                (true, _) => format!(
                    "A better cut: the goal has grown from {:.4} to {:.4} ({tried} designs tried{stopped}).",
                    report.start.total.middle(),
                    report.outcome.best.total.middle()
                ),
                (false, true) => {
                    format!("No better cut was found; the design stays as it was ({tried} designs tried{stopped}).")
                }
                (false, false) => format!(
                    "No cut was found that keeps all limits; the design stays as it was ({tried} designs tried{stopped})."
                ),
            }
        }
    }
}
