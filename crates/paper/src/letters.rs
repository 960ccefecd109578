//! The fonts of drawings: the program's own, and those of the system for letters that its own lack.
//!
//! Drawings whose letters the program's own fonts have look the same everywhere. Others depend on the system's fonts, of which
//! the choice is the same each time.

use resvg::usvg::fontdb::{Database, FaceInfo, ID, Style, Weight};
use resvg::usvg::{FontResolver, Group, Node, Tree};
use skrifa::{FontRef, MetadataProvider};
use std::collections::BTreeSet;
use std::sync::{Arc, OnceLock};

/// The family of Ubuntu Light; the second font stands in for letters it lacks.
pub(super) const FAMILY: &str = "Ubuntu";

/// Returns the program's own fonts.
pub(super) fn own_fonts() -> Arc<Database> {
    static OWN: OnceLock<Arc<Database>> = OnceLock::new();
    let load = || {
        let mut fonts = Database::new();
        for font in [epaint_default_fonts::UBUNTU_LIGHT, epaint_default_fonts::HACK_REGULAR] {
            fonts.load_font_data(font.to_vec());
        }
        fonts.set_sans_serif_family(FAMILY);
        Arc::new(fonts)
    };
    OWN.get_or_init(load).clone()
}

/// Returns the program's own fonts and all fonts of the system, which are looked for once. The program's own have the same
/// numbers as in [`own_fonts`].
pub(super) fn all_fonts() -> Arc<Database> {
    static ALL: OnceLock<Arc<Database>> = OnceLock::new();
    let load = || {
        let mut fonts = (*own_fonts()).clone();
        fonts.load_system_fonts();
        Arc::new(fonts)
    };
    ALL.get_or_init(load).clone()
}

/// Returns a choice of fonts that takes letters which a font lacks from the plainest other font: upright, of regular weight,
/// the first by name.
pub(super) fn resolver() -> FontResolver<'static> {
    let select_fallback = |letter, used: &[ID], fonts: &mut Arc<Database>| plainest(fonts, letter, used);
    FontResolver { select_fallback: Box::new(select_fallback), ..FontResolver::default() }
}

/// A font of the system.
pub struct SystemFont {
    /// The name of the font.
    pub name: String,
    /// The bytes of its file.
    pub data: Vec<u8>,
    /// The place of the font in the file, from 0.
    pub index: u32,
}

impl SystemFont {
    /// Returns the plainest font of the system that has a letter; `None` where none has it.
    pub fn with(letter: char) -> Option<Self> {
        let fonts = all_fonts();
        let own: Vec<ID> = own_fonts().faces().map(|face| face.id).collect();
        let id = plainest(&fonts, letter, &own)?;
        let name = fonts.face(id)?.post_script_name.clone();
        fonts.with_face_data(id, |data, index| Self { name, data: data.to_vec(), index })
    }
}

/// Returns the plainest font with a letter that is not among the used ones.
fn plainest(fonts: &Database, letter: char, used: &[ID]) -> Option<ID> {
    let mut faces: Vec<&FaceInfo> = fonts.faces().filter(|face| !used.contains(&face.id)).collect();
    faces.sort_by(|a, b| strangeness(a).cmp(&strangeness(b)));
    faces.into_iter().find(|face| has(fonts, face.id, letter)).map(|face| face.id)
}

fn has(fonts: &Database, face: ID, letter: char) -> bool {
    let found = fonts.with_face_data(face, |data, index| {
        let font = FontRef::from_index(data, index).ok()?;
        font.charmap().map(letter)
    });
    found.flatten().is_some()
}

/// Returns how strange a font looks beside the program's own; equals are ordered by their names.
fn strangeness(face: &FaceInfo) -> (bool, bool, bool, u16, u16, &str) {
    let name = face.post_script_name.as_str();
    let is_from_elsewhere = !own_fonts().faces().any(|own| own.post_script_name == name);
    let is_serif = name.contains("Serif");
    let weight = face.weight.0.abs_diff(Weight::NORMAL.0);
    (is_from_elsewhere, face.style != Style::Normal, is_serif, weight, face.stretch.to_number(), name)
}

/// Returns the letters of a drawing that none of its fonts has, each once, in their order by number.
pub(super) fn lacking(tree: &Tree) -> String {
    let mut letters = BTreeSet::new();
    add_lacking(tree.root(), &mut letters);
    letters.into_iter().collect()
}

fn add_lacking(group: &Group, letters: &mut BTreeSet<char>) {
    for node in group.children() {
        match node {
            Node::Group(inner) => add_lacking(inner, letters),
            Node::Text(text) => {
                let glyphs = text.layouted().iter().flat_map(|span| &span.positioned_glyphs);
                let missing = glyphs.filter(|glyph| glyph.id.0 == 0).flat_map(|glyph| glyph.text.chars());
                letters.extend(missing.filter(|letter| is_seen(*letter)));
            }
            Node::Path(_) | Node::Image(_) => {}
        }
    }
}

/// Returns whether a character is seen by itself; joiners, marks of direction and selectors of a variant are not.
fn is_seen(letter: char) -> bool {
    !letter.is_whitespace()
        && !letter.is_control()
        && !matches!(letter, '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{fe00}'..='\u{fe0f}' | '\u{feff}')
}
