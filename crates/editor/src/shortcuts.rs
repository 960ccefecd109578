//! The keys of commands and menus.

use brillianteer_session::model::command::{Command, Menu};
use egui::{Key, KeyboardShortcut, Modifiers};

/// Returns the letter that opens a menu together with Alt: the first of its title.
pub fn letter(menu: &Menu) -> Option<Key> {
    Key::from_name(menu.title.get(..1)?)
}

/// Returns all keys of a command; menus show the first.
pub fn shortcuts(command: Command) -> impl Iterator<Item = KeyboardShortcut> {
    command.keys().split(", ").filter_map(shortcut)
}

/// Returns a key by its text, such as `Ctrl+O`.
fn shortcut(text: &str) -> Option<KeyboardShortcut> {
    let (modifiers, key) = match text.rsplit_once('+') {
        None => (Modifiers::NONE, text),
        Some(("Shift", key)) => (Modifiers::SHIFT, key),
        Some(("Ctrl", key)) => (Modifiers::COMMAND, key),
        Some(("Ctrl+Shift", key)) => (Modifiers::COMMAND | Modifiers::SHIFT, key),
        Some(_) => return None,
    };
    Some(KeyboardShortcut::new(modifiers, Key::from_name(key)?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_session::model::command::MENUS;

    #[test]
    fn every_menu_opens_by_a_letter_of_its_own() {
        let keys: Vec<Key> = MENUS.iter().filter_map(letter).collect();
        assert_eq!(keys, [Key::F, Key::E, Key::D, Key::V, Key::C, Key::H]);
    }

    #[test]
    fn the_menus_hold_every_command_once_in_the_order_of_the_table() {
        let all: Vec<Command> = MENUS.iter().flat_map(|menu| menu.groups.concat()).collect();
        assert_eq!(all, Command::ALL);
    }

    #[test]
    fn no_key_does_two_things() {
        let keys: Vec<_> = Command::ALL.iter().flat_map(|c| shortcuts(*c).map(move |key| (c, key))).collect();
        let texts = Command::ALL.iter().flat_map(|c| c.keys().split(", ")).filter(|text| !text.is_empty());
        assert_eq!(keys.len(), texts.count(), "a text in the table of commands is no key");
        for (i, (a, key)) in keys.iter().enumerate() {
            let twin = keys[..i].iter().find(|(_, other)| other == key);
            assert!(twin.is_none(), "{a:?} and {twin:?}");
            assert!(key.logical_key != Key::C || key.modifiers != Modifiers::NONE, "C compares");
        }
        assert!(keys.len() > 20);
    }
}
