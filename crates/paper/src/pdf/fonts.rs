//! The fonts of a PDF: the used glyphs of each font of the drawings, with their widths and characters.

use super::deflate::deflated;
use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, Str};
use resvg::usvg::fontdb::{Database, ID};
use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, GlyphId, MetadataProvider, Tag};
use std::collections::BTreeMap;
use subsetter::{GlyphRemapper, subset};

/// The character set of glyphs that are named by their numbers.
const IDENTITY: SystemInfo =
    SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

/// The fonts of a file, in the order in which they were first used.
#[derive(Default)]
pub(super) struct PdfFonts {
    fonts: Vec<PdfFont>,
}

/// The table of a font with outlines by cubic curves, which PDF holds without the rest of the font (9.9).
const CFF: Tag = Tag::new(b"CFF ");

/// A font and its used glyphs.
struct PdfFont {
    /// The font's number in the database of the drawings.
    id: ID,
    /// The bytes of its file, and the font's place in that file.
    data: Vec<u8>,
    index: u32,
    /// True where the outlines are in the table [`CFF`], false where they are those of TrueType.
    is_cff: bool,
    glyphs: GlyphRemapper,
    /// The characters that a glyph of the file stands for.
    text: BTreeMap<u16, String>,
    /// The widths of the glyphs, thousandths of the type size.
    widths: BTreeMap<u16, f32>,
}

impl PdfFonts {
    /// Returns the place of a font among those of the file; `None` where the database does not have it, or where the font has
    /// pictures instead of outlines. Fonts have the same number in all drawings, as those of the system come last.
    pub fn place(&mut self, fonts: &Database, id: ID) -> Option<usize> {
        let known = self.fonts.iter().position(|font| font.id == id);
        known.or_else(|| {
            let (data, index) = fonts.with_face_data(id, |data, index| (data.to_vec(), index))?;
            let face = FontRef::from_index(&data, index).ok()?;
            let is_cff = face.table_data(CFF).is_some();
            if !is_cff && face.table_data(Tag::new(b"glyf")).is_none() {
                return None;
            }
            let (glyphs, text, widths) = (GlyphRemapper::new(), BTreeMap::new(), BTreeMap::new());
            self.fonts.push(PdfFont { id, data, index, is_cff, glyphs, text, widths });
            Some(self.fonts.len() - 1)
        })
    }

    /// Returns the number of a glyph in the file, and its width in type sizes.
    pub fn glyph(&mut self, place: usize, glyph: u16, text: &str) -> (u16, f32) {
        let font = &mut self.fonts[place];
        let number = font.glyphs.remap(glyph);
        font.text.entry(number).or_insert_with(|| text.to_owned());
        let (data, index) = (&font.data, font.index);
        let width = *font.widths.entry(number).or_insert_with(|| {
            let Ok(face) = FontRef::from_index(data, index) else { return 0.0 };
            let units = f32::from(face.metrics(Size::unscaled(), LocationRef::default()).units_per_em);
            let metrics = face.glyph_metrics(Size::unscaled(), LocationRef::default());
            1000.0 * metrics.advance_width(GlyphId::new(u32::from(glyph))).unwrap_or(0.0) / units
        });
        (number, width / 1000.0)
    }

    /// Writes all fonts. Returns the names by which pages call them.
    pub fn write(self, pdf: &mut Pdf, next: &mut impl FnMut() -> Ref) -> Vec<(String, Ref)> {
        let numbered = self.fonts.into_iter().enumerate();
        numbered.map(|(k, font)| (name(k), font.write(pdf, &format!("AAAAA{}", letter(k)), next))).collect()
    }
}

/// Returns the name by which pages call a font.
pub(super) fn name(place: usize) -> String {
    format!("F{place}")
}

/// Returns a letter that distinguishes the subsets of fonts by their names (9.6.4).
fn letter(k: usize) -> char {
    char::from(b'A' + (k % 26) as u8)
}

impl PdfFont {
    /// Writes the font as a composite one, whose glyphs are named by their numbers (9.7).
    fn write(self, pdf: &mut Pdf, tag: &str, next: &mut impl FnMut() -> Ref) -> Ref {
        let [font, descendant, descriptor, file, unicode] = [(); 5].map(|()| next());
        let full = format!("{tag}+{}", self.postscript_name());
        let base = Name(full.as_bytes());
        pdf.type0_font(font)
            .base_font(base)
            .encoding_predefined(Name(b"Identity-H"))
            .descendant_font(descendant)
            .to_unicode(unicode);
        let mut cid = pdf.cid_font(descendant);
        cid.base_font(base).system_info(IDENTITY).font_descriptor(descriptor).default_width(0.0);
        if self.is_cff {
            cid.subtype(CidFontType::Type0);
        } else {
            cid.subtype(CidFontType::Type2).cid_to_gid_map_predefined(Name(b"Identity"));
        }
        let mut widths = cid.widths();
        for (&glyph, &width) in &self.widths {
            widths.consecutive(glyph, [width]);
        }
        widths.finish();
        cid.finish();
        self.describe(pdf, descriptor, base, file);
        let mut characters = UnicodeCmap::new(Name(b"Custom"), IDENTITY);
        self.text.iter().for_each(|(&glyph, text)| characters.pair_with_multiple(glyph, text.chars()));
        pdf.stream(unicode, &deflated(&characters.finish())).filter(Filter::FlateDecode);
        // The program's own fonts can be subset, as a test shows; for a font that cannot, a viewer uses letters of
        // its own.
        let mut part = subset(&self.data, self.index, &self.glyphs).unwrap_or_default();
        if self.is_cff {
            let table =
                FontRef::new(&part).ok().and_then(|face| Some(face.table_data(CFF)?.as_bytes().to_vec()));
            part = table.unwrap_or_default();
        }
        let bytes = deflated(&part);
        let mut stream = pdf.stream(file, &bytes);
        stream.filter(Filter::FlateDecode);
        if self.is_cff {
            stream.pair(Name(b"Subtype"), Name(b"CIDFontType0C"));
        } else {
            stream.pair(Name(b"Length1"), part.len() as i32);
        }
        font
    }

    fn describe(&self, pdf: &mut Pdf, id: Ref, base: Name, file: Ref) {
        let mut descriptor = pdf.font_descriptor(id);
        descriptor.name(base).flags(FontFlags::SYMBOLIC).italic_angle(0.0).stem_v(60.0);
        if self.is_cff {
            descriptor.font_file3(file);
        } else {
            descriptor.font_file2(file);
        }
        let Ok(face) = FontRef::from_index(&self.data, self.index) else { return };
        let metrics = face.metrics(Size::unscaled(), LocationRef::default());
        let scaled = |value: f32| 1000.0 * value / f32::from(metrics.units_per_em);
        let bounds = metrics.bounds.unwrap_or_default();
        descriptor
            .bbox(Rect::new(
                scaled(bounds.x_min),
                scaled(bounds.y_min),
                scaled(bounds.x_max),
                scaled(bounds.y_max),
            ))
            .ascent(scaled(metrics.ascent))
            .descent(scaled(metrics.descent))
            .cap_height(scaled(metrics.cap_height.unwrap_or(metrics.ascent)));
    }

    /// Returns the name of the font, in letters and digits.
    fn postscript_name(&self) -> String {
        let face = FontRef::from_index(&self.data, self.index).ok();
        let name = face.and_then(|face| {
            face.localized_strings(skrifa::string::StringId::POSTSCRIPT_NAME)
                .english_or_first()
                .map(|s| s.to_string())
        });
        let plain = name
            .unwrap_or_default()
            .chars()
            .filter(|c| c.is_ascii_alphanumeric() || *c == '-')
            .collect::<String>();
        if plain.is_empty() { "Font".to_owned() } else { plain }
    }
}
