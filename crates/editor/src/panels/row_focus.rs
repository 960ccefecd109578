//! The focus of the keyboard in rows: Tab goes from number to number, and a number that is typed while its slider has the
//! focus goes to its field.
//!
//! Sliders and padlocks can be focused, so that screen readers and arrow keys reach them, but Tab passes over them.

use egui::{Context, Event, FocusDirection, Id, Key, Modifiers, Response, Sense, Ui};

/// The direction of Tab in the present frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TabStep {
    Forward,
    Backward,
}

impl TabStep {
    fn direction(self) -> FocusDirection {
        match self {
            Self::Forward => FocusDirection::Next,
            Self::Backward => FocusDirection::Previous,
        }
    }
}

/// The state of Tab in a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct TabState {
    /// The direction in which the focus moves in this frame.
    step: Option<TabStep>,
    /// The direction in which it moves in the next one.
    waits: Option<TabStep>,
}

/// The input that was typed while a slider had the focus; its field takes it in the next frame.
#[derive(Debug, Clone, Default)]
struct TypedAhead(Vec<Event>);

/// Where the present [`TabState`] is kept.
fn step_id() -> Id {
    Id::unique("tab step of rows")
}

/// Where the [`TypedAhead`] is kept.
fn typed_id() -> Id {
    Id::unique("typed ahead in rows")
}

/// Where the number that was last ended with Return is kept.
fn ended_id() -> Id {
    Id::unique("row ended last")
}

/// The kinds of a row's parts that can have the focus.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum RowPart {
    /// Passed over by Tab.
    Slider,
    Other,
}

fn part_id(id: Id) -> Id {
    id.with("part of a row")
}

fn mark(widget: &Response, part: RowPart) {
    widget.ctx.data_mut(|data| data.insert_temp(part_id(widget.id), part));
}

fn focused_part(ctx: &Context) -> Option<RowPart> {
    let id = ctx.memory(|memory| memory.focused())?;
    ctx.data(|data| data.get_temp(part_id(id)))
}

/// Prepares the focus of rows for a frame; to be called before anything is drawn in it.
pub fn begin(ctx: &Context) {
    let TypedAhead(typed) = ctx.data_mut(|data| data.remove_temp(typed_id())).unwrap_or_default();
    ctx.input_mut(|input| drop(input.events.splice(0..0, typed)));
    let pressed = ctx.input(|input| {
        let is_pressed = |modifiers: Modifiers| {
            let mut keys = input.events.iter();
            keys.any(|e| matches!(e, Event::Key { key: Key::Tab, pressed: true, modifiers: m, .. } if *m == modifiers))
        };
        let backward = is_pressed(Modifiers::SHIFT).then_some(TabStep::Backward);
        is_pressed(Modifiers::NONE).then_some(TabStep::Forward).or(backward)
    });
    let TabState { step: before, waits } = ctx.data(|data| data.get_temp(step_id())).unwrap_or_default();
    // egui gives the focus to the widget before in the frame after Shift+Tab.
    let is_on_slider = focused_part(ctx) == Some(RowPart::Slider);
    let goes_on = pressed.is_none() && before == Some(TabStep::Backward) && is_on_slider;
    let again = waits.or(goes_on.then_some(TabStep::Backward));
    if let Some(step) = again {
        ctx.memory_mut(|memory| memory.move_focus(step.direction()));
    }
    let mut state = TabState { step: pressed.or(again), waits: None };
    // Tab goes on from a number that Return has ended: that gets the focus again, and passes it on in the next frame.
    let ended =
        pressed.and_then(|_| ctx.data_mut(|data| data.remove_temp::<Option<Id>>(ended_id())).flatten());
    if let Some(ended) = ended.filter(|_| ctx.memory(|memory| memory.focused().is_none())) {
        ctx.memory_mut(|memory| {
            memory.request_focus(ended);
            memory.move_focus(FocusDirection::None);
        });
        state = TabState { step: None, waits: pressed };
    }
    if state != TabState::default() {
        ctx.request_repaint();
    }
    ctx.data_mut(|data| data.insert_temp(step_id(), state));
}

fn step(ui: &Ui) -> Option<TabStep> {
    ui.data(|data| data.get_temp::<TabState>(step_id())).unwrap_or_default().step
}

/// Returns the sense of a button that can be focused, but that Tab passes over.
pub fn passed_over(ui: &Ui) -> Sense {
    if step(ui).is_some() { Sense::CLICK } else { Sense::click() }
}

/// Notes that a widget is a part of a row: while it has the focus, keys that are typed belong to it.
pub fn part(widget: &Response) {
    mark(widget, RowPart::Other);
}

/// Passes the focus from the slider of a row on to the number, which is drawn next, where Tab gave it to the slider or where a
/// number is typed.
pub fn slider(ui: &Ui, slider: &Response) {
    mark(slider, RowPart::Slider);
    if !slider.has_focus() {
        return;
    }
    let is_by_tab = slider.gained_focus() && step(ui) == Some(TabStep::Forward);
    let begins = |event: &Event| match event {
        Event::Text(text) => text.starts_with(|c: char| c.is_ascii_digit() || "+-−.,".contains(c)),
        Event::Key { key: Key::Enter, pressed: true, .. } => true,
        _ => false,
    };
    let first = ui.input(|input| input.events.iter().position(begins));
    if let Some(first) = first.filter(|_| !is_by_tab) {
        let mut typed = ui.input_mut(|input| input.events.split_off(first));
        // Return opens the field, and is no input for it.
        if matches!(typed[0], Event::Key { .. }) {
            typed.remove(0);
        }
        ui.data_mut(|data| data.insert_temp(typed_id(), TypedAhead(typed)));
        ui.ctx().request_repaint();
    }
    if is_by_tab || first.is_some() {
        ui.memory_mut(|memory| {
            memory.surrender_focus(slider.id);
            memory.move_focus(FocusDirection::Next);
        });
    }
}

/// Scrolls a number into sight when it gets the focus, and notes which one Return ends. Returns whether Escape has ended it, so that
/// what was typed must not be taken: egui would take it one frame later.
pub fn number(ui: &Ui, number: &Response) -> bool {
    mark(number, RowPart::Other);
    let escaped_id = number.id.with("escaped");
    let was_escaped = ui.data_mut(|data| data.remove_temp::<bool>(escaped_id)).unwrap_or_default();
    if number.lost_focus() && ui.input(|input| input.key_pressed(Key::Escape)) {
        ui.data_mut(|data| data.insert_temp(escaped_id, true));
        ui.ctx().request_repaint();
    }
    if number.gained_focus() {
        number.scroll_to_me(None);
    }
    if number.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
        ui.data_mut(|data| data.insert_temp(ended_id(), Some(number.id)));
    }
    was_escaped
}

/// Returns whether Space is pressed in the number whose identity is kept under `known`, and keeps the space out of its text.
pub fn takes_space(ui: &Ui, known: Id) -> bool {
    let number = ui.data(|data| data.get_temp::<Id>(known));
    let is_focused = number.is_some_and(|number| ui.memory(|memory| memory.has_focus(number)));
    is_focused
        && ui.input_mut(|input| {
            let count = input.events.len();
            input.events.retain(|event| !matches!(event, Event::Text(text) if text == " "));
            input.events.len() < count
        })
}

/// Returns whether keys without a command modifier belong to the widget that has the focus: a text, or a part of a row.
pub fn holds_keys(ctx: &Context) -> bool {
    ctx.text_edit_focused() || focused_part(ctx).is_some()
}
