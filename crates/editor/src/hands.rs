//! Sorts the user's input before the window handles it, so that no quick drag is lost where frames are slow, and
//! letters pressed together with Alt are not typed.

use egui::{Context, Event, Key, Modifiers, Plugin, RawInput};

/// A queue that holds events back for the frames to come.
#[derive(Default)]
pub struct Hands {
    later: Vec<Event>,
    /// True while Alt is down without Ctrl; letters then open menus.
    is_alt: bool,
    /// The number of frames to come that get no events.
    pause: u8,
}

/// The frames that egui and rows take to pass the focus on after the frame with Tab, and those after the frame with Shift+Tab.
const PASSING: [u8; 2] = [1, 3];

impl Plugin for Hands {
    fn debug_name(&self) -> &'static str {
        "hands"
    }

    fn input_hook(&mut self, ctx: &Context, input: &mut RawInput) {
        let mut events = std::mem::take(&mut self.later);
        events.extend(input.events.drain(..).filter(|event| self.is_meant(event)));
        let end = if self.pause > 0 { 0 } else { first_part(&events) };
        self.pause = self.pause.saturating_sub(1);
        self.later = events.split_off(end);
        if let Some(modifiers) = events.iter().find_map(tab) {
            self.pause = PASSING[usize::from(modifiers.shift)];
        }
        input.events = events;
        if !self.later.is_empty() {
            ctx.request_repaint();
        }
    }
}

impl Hands {
    /// Returns whether the window handles an event: it ignores the text of a letter while Alt is down.
    fn is_meant(&mut self, event: &Event) -> bool {
        match event {
            Event::Key { modifiers, .. } | Event::ModifiersChanged(modifiers) => {
                self.is_alt = opens_menus(modifiers);
                true
            }
            Event::WindowFocused(false) => {
                self.is_alt = false;
                true
            }
            Event::Text(_) => !self.is_alt,
            _ => true,
        }
    }
}

/// Returns whether a letter pressed with these modifiers opens a menu.
///
/// On a Mac such a letter types another one, as it does with AltGr, which some systems report as Ctrl and Alt.
fn opens_menus(modifiers: &Modifiers) -> bool {
    modifiers.alt && !modifiers.ctrl && !cfg!(target_os = "macos")
}

/// Returns the modifiers of an event that presses Tab.
fn tab(event: &Event) -> Option<&Modifiers> {
    match event {
        Event::Key { key: Key::Tab, pressed: true, modifiers, .. } => Some(modifiers),
        _ => None,
    }
}

/// Returns how many of the events one frame handles.
///
/// egui moves the focus by Tab when a frame begins, and then gives all text of the frame to what has the focus. So Tab has a frame
/// of its own, and text goes to the field in which it was typed, where frames are slow. egui looks for what is under a press where the pointer is at the end of the frame, and a drag is over with its release.
/// So a frame ends with a press that the pointer moves on from, and before a release that the pointer has moved to.
fn first_part(events: &[Event]) -> usize {
    let is_moved = |event: &Event| matches!(event, Event::PointerMoved(_));
    let mut has_moved = false;
    for (place, event) in events.iter().enumerate() {
        if tab(event).is_some() {
            return place.max(1);
        }
        match event {
            Event::PointerMoved(_) => has_moved = true,
            Event::PointerButton { pressed: true, .. } => {
                let next = events[place + 1..].iter().find(|e| is_moved(e) || is_release(e));
                if next.is_some_and(is_moved) {
                    return place + 1;
                }
                has_moved = false;
            }
            Event::PointerButton { pressed: false, .. } if has_moved => return place,
            _ => {}
        }
    }
    events.len()
}

fn is_release(event: &Event) -> bool {
    matches!(event, Event::PointerButton { pressed: false, .. })
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{PointerButton, pos2};

    fn moved(x: f32) -> Event {
        Event::PointerMoved(pos2(x, 0.0))
    }

    fn button(x: f32, pressed: bool) -> Event {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        Event::PointerButton { pos: pos2(x, 0.0), button, pressed, modifiers }
    }

    /// Returns the events of each frame, where all events arrive at once.
    fn frames(events: Vec<Event>) -> Vec<Vec<Event>> {
        let (ctx, mut hands) = (Context::default(), Hands::default());
        let mut input = RawInput { events, ..RawInput::default() };
        let mut frames = vec![];
        while frames.is_empty() || !hands.later.is_empty() {
            hands.input_hook(&ctx, &mut input);
            frames.push(std::mem::take(&mut input.events));
        }
        frames
    }

    #[test]
    fn a_drag_that_comes_all_at_once_is_a_press_a_way_and_a_release() {
        let drag = [moved(1.0), button(1.0, true), moved(9.0), moved(20.0), button(20.0, false)];
        let parts = frames(drag.to_vec());
        assert_eq!(parts, [&drag[..2], &drag[2..4], &drag[4..]]);
    }

    #[test]
    fn a_click_and_what_is_typed_come_in_one_frame() {
        let click =
            vec![moved(1.0), button(1.0, true), button(1.0, false), button(1.0, true), button(1.0, false)];
        assert_eq!(frames(click.clone()), [click]);
        let typed = vec![Event::Text("a".into()), moved(3.0), Event::Text("b".into())];
        assert_eq!(frames(typed.clone()), [typed]);
    }

    #[test]
    fn tab_has_a_frame_of_its_own_and_the_focus_moves_before_more_is_typed() {
        let press = |modifiers| Event::Key {
            key: Key::Tab,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers,
        };
        let (tab, back) = (press(Modifiers::NONE), press(Modifiers::SHIFT));
        let text = |text: &str| Event::Text(text.into());
        let parts = frames(vec![text("1"), text("2"), tab.clone(), text("3"), back.clone(), text("4")]);
        let none = Vec::new;
        let typed = vec![text("1"), text("2")];
        let expected = vec![
            typed,
            vec![tab],
            none(),
            vec![text("3")],
            vec![back],
            none(),
            none(),
            none(),
            vec![text("4")],
        ];
        assert_eq!(parts, expected);
    }

    #[test]
    fn a_letter_with_alt_is_no_text() {
        let key = |modifiers| Event::Key {
            key: Key::F,
            physical_key: None,
            pressed: true,
            repeat: false,
            modifiers,
        };
        let text = || Event::Text("f".into());
        let alt_gr = Modifiers { alt: true, ctrl: true, ..Modifiers::NONE };
        let events = vec![key(Modifiers::ALT), text(), key(Modifiers::NONE), text(), key(alt_gr), text()];
        let kept = frames(events)[0].iter().filter(|event| matches!(event, Event::Text(_))).count();
        assert_eq!(kept, if cfg!(target_os = "macos") { 3 } else { 2 });
    }
}
