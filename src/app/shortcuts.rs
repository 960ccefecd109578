//! The keys of commands and menus.

use super::model::command::{Command, Menu};
use egui::{Key, KeyboardShortcut, Modifiers};

impl Menu {
    /// Returns the letter that opens the menu together with Alt: the first of its title.
    pub fn key(&self) -> Option<Key> {
        Key::from_name(self.title.get(..1)?)
    }
}

use Command::*;

impl Command {
    /// Returns the key of the command, with the modifiers that are held down, if it has one.
    pub fn shortcut(self) -> Option<KeyboardShortcut> {
        let bare = |key| Some(KeyboardShortcut::new(Modifiers::NONE, key));
        let command = |key| Some(KeyboardShortcut::new(Modifiers::COMMAND, key));
        let shifted = |key| Some(KeyboardShortcut::new(Modifiers::COMMAND | Modifiers::SHIFT, key));
        match self {
            Open => command(Key::O),
            Save => command(Key::S),
            SaveAs => shifted(Key::S),
            Export => command(Key::E),
            CopyPicture => shifted(Key::C),
            Quit => command(Key::Q),
            Undo => command(Key::Z),
            Redo => shifted(Key::Z),
            ViewBack => bare(Key::Backspace),
            ViewOn => Some(KeyboardShortcut::new(Modifiers::SHIFT, Key::Backspace)),
            Top => bare(Key::T),
            Side => bare(Key::S),
            Bottom => bare(Key::B),
            Free => bare(Key::F),
            Fit => bare(Key::Num0),
            Perspective => bare(Key::P),
            EyeLeans => bare(Key::E),
            One => bare(Key::Num1),
            Two => bare(Key::Num2),
            Four => bare(Key::Num4),
            Wireframe => bare(Key::W),
            Facets => bare(Key::A),
            Bounces => bare(Key::N),
            Unresolved => bare(Key::U),
            Total => bare(Key::I),
            Strongest => bare(Key::X),
            Glare => bare(Key::V),
            Split => bare(Key::D),
            LightPath => bare(Key::L),
            Play => bare(Key::M),
            LayOut => bare(Key::Space),
            NextBehind => bare(Key::G),
            Panels => bare(Key::H),
            FullScreen => bare(Key::F11),
            Keys => bare(Key::F1),
            CompareSaved => bare(Key::R),
            CompareFile | NoCompare | ResetView | ResetLayout | About => None,
        }
    }

    /// Returns all keys of the command: the one that menus show, and one that other programs use.
    pub fn shortcuts(self) -> impl Iterator<Item = KeyboardShortcut> {
        let other = (self == Redo).then(|| KeyboardShortcut::new(Modifiers::COMMAND, Key::Y));
        self.shortcut().into_iter().chain(other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model::command::MENUS;

    #[test]
    fn every_menu_opens_by_a_letter_of_its_own() {
        let keys: Vec<Key> = MENUS.iter().filter_map(Menu::key).collect();
        assert_eq!(keys, [Key::F, Key::E, Key::V, Key::C, Key::H]);
    }

    #[test]
    fn no_key_does_two_things() {
        let keys: Vec<_> = Command::all().flat_map(|c| c.shortcuts().map(move |key| (c, key))).collect();
        for (i, (a, key)) in keys.iter().enumerate() {
            let twin = keys[..i].iter().find(|(_, other)| other == key);
            assert!(twin.is_none(), "{a:?} and {twin:?}");
            assert!(key.logical_key != Key::C || key.modifiers != Modifiers::NONE, "C compares");
        }
        assert!(keys.len() > 20);
    }
}
