//! The background behind the stones, as files and options name it: the light itself, a colour, a pattern or a world that the
//! program draws, a photograph.

use crate::background::Background;
use crate::pattern::{PATTERN_SPAN, Pattern};
use crate::worlds::World;
use brillianteer_base::{FileError, NameOrFileError, nearest};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::path::{Path, PathBuf};

/// A background by its name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(from = "String", into = "String")]
pub enum BackgroundRef {
    /// `light`: the light itself.
    Light,
    /// Colours, or a transparent background.
    Plain(Background),
    /// A drawing that comes with the program.
    Pattern(Pattern),
    /// A world that the program draws.
    World(World),
    /// The path of a photograph's file.
    Photo(PathBuf),
}

impl fmt::Display for BackgroundRef {
    /// Writes a text that [`Self::read`] reads as the same background from any folder.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Light => f.write_str("light"),
            Self::Plain(background) => background.fmt(f),
            Self::Pattern(pattern) => f.write_str(pattern.name()),
            Self::World(world) => f.write_str(world.name()),
            Self::Photo(path) => std::path::absolute(path).as_deref().unwrap_or(path).display().fmt(f),
        }
    }
}

impl From<&str> for BackgroundRef {
    /// Reads a name as [`Self::read`] does. A text that names nothing else is the path of a photograph, which need not exist.
    fn from(text: &str) -> Self {
        Self::read(text, Path::new("")).unwrap_or_else(|_| Self::Photo(text.into()))
    }
}

impl From<String> for BackgroundRef {
    fn from(text: String) -> Self {
        text.as_str().into()
    }
}

impl From<BackgroundRef> for String {
    fn from(background: BackgroundRef) -> Self {
        background.to_string()
    }
}

impl BackgroundRef {
    /// Returns the names of all pictures that the program draws itself: worlds, then patterns.
    pub fn names() -> impl Iterator<Item = &'static str> {
        World::NAMES.map(|(name, _)| name).into_iter().chain(Pattern::NAMES.map(|(name, _)| name))
    }

    /// Returns whether it is a picture that hangs at a distance behind the stones.
    pub fn is_picture(&self) -> bool {
        matches!(self, Self::Pattern(_) | Self::World(_) | Self::Photo(_))
    }

    /// Returns whether it is a photograph whose file does not exist.
    pub fn is_missing(&self) -> bool {
        matches!(self, Self::Photo(path) if !path.is_file())
    }

    /// Returns the width of the hanging picture as a multiple of the width of the film: patterns and worlds continue
    /// beside the picture.
    pub fn span(&self) -> f64 {
        if matches!(self, Self::Pattern(_) | Self::World(_)) { PATTERN_SPAN } else { 1.0 }
    }

    /// Returns a word for the kind of background, such as `Photograph`.
    pub fn title(&self) -> String {
        let mut title = match self {
            Self::Light => "light",
            Self::Plain(_) => "colours",
            Self::Pattern(pattern) => pattern.name(),
            Self::World(world) => world.name(),
            Self::Photo(_) => "photograph",
        }
        .to_owned();
        title[..1].make_ascii_uppercase();
        title
    }

    /// Reads the name of a background. Names are tried before files, which are sought from `folder`.
    ///
    /// # Errors
    /// Fails where the text is no name, no colour and no file, or names a file that does not exist.
    pub fn read(text: &str, folder: &Path) -> Result<Self, NameOrFileError> {
        if text.eq_ignore_ascii_case("light") {
            return Ok(Self::Light);
        }
        if let Some(pattern) = Pattern::named(text) {
            return Ok(Self::Pattern(pattern));
        }
        if let Some(world) = World::named(text) {
            return Ok(Self::World(world));
        }
        let path = folder.join(text);
        match text.parse::<Background>() {
            Ok(background) => Ok(Self::Plain(background)),
            Err(_) if path.is_file() => Ok(Self::Photo(path)),
            Err(_) if path.extension().is_some() => {
                Err(FileError::new(path.display(), "there is no such file").into())
            }
            Err(why) => {
                let patterns = Pattern::NAMES.map(|(name, _)| name).join(", ");
                let worlds = World::NAMES.map(|(name, _)| name).join(", ");
                let known: Vec<&str> = Self::names().collect();
                let meant =
                    nearest(text, &known).map_or(String::new(), |name| format!(" (did you mean '{name}'?)"));
                let why = why.to_string().replacen(": give", &format!("{meant}: give"), 1);
                let message = format!(
                    "{why}, `light`, a world ({worlds}), a pattern ({patterns}), or a photograph's file"
                );
                Err(NameOrFileError::Unknown(message))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stand_before_files_and_what_is_neither_is_told() {
        let folder = tempfile::tempdir().unwrap();
        for file in ["page", "white", "photo.png", "odd"] {
            std::fs::write(folder.path().join(file), "").unwrap();
        }
        let read = |text: &str| BackgroundRef::read(text, folder.path());
        assert_eq!(read("Light"), Ok(BackgroundRef::Light));
        assert_eq!(read("page"), Ok(BackgroundRef::Pattern(Pattern::Page)));
        assert_eq!(read("Sunset"), Ok(BackgroundRef::World(World::Sunset)));
        let refused = read("cityy").unwrap_err().to_string();
        assert!(
            refused.starts_with("background 'cityy' (did you mean 'city'?): give transparent"),
            "{refused}"
        );
        for name in BackgroundRef::names() {
            let known = read(name).unwrap();
            assert_eq!((known.to_string().as_str(), read(&known.to_string())), (name, Ok(known.clone())));
            assert!(known.is_picture() && known.span() > 1.0, "{name}");
        }
        assert_eq!(read("white"), Ok(BackgroundRef::Plain(Background::Plain([1.0; 3]))));
        assert_eq!(read("odd"), Ok(BackgroundRef::Photo(folder.path().join("odd"))));
        assert!(
            matches!(read("none.png"), Err(NameOrFileError::File(error)) if error.path.ends_with("none.png"))
        );
        let Err(NameOrFileError::Unknown(message)) = read("pages") else { panic!("no error") };
        assert!(
            message.contains("'pages'")
                && message.contains("page, grid, checks")
                && message.contains("sunset, room, city")
                && message.contains("photograph")
        );
    }
}
