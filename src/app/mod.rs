//! Floor 6: the editor, a window in which a stone is cut and its light is watched.

mod document;
mod eye;
mod history;
mod shows;
mod studio;
