//! Writes drawings as PDF: lines and faces as paths, and text as text, which can be searched and copied. The fonts
//! are the program's own, and the system's for letters that those lack; the file holds only the letters of each font that are
//! used.
//!
//! Source: ISO 32000-1, PDF 1.7; sections are named where they are used.
//!
//! pdf-writer writes the objects. svg2pdf 0.13 and krilla-svg 0.8 would bring a second, older usvg.

mod content;
mod deflate;
mod fonts;
mod images;

use super::drawing_png::{DrawingError, parse};
use content::PageContent;
use deflate::deflated;
use fonts::PdfFonts;
use images::PdfImages;
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, TextStr};

/// Points per pixel of SVG, which has 96 pixels an inch.
const POINTS: f32 = 0.75;

/// Writes drawings as the pages of a PDF, each as large as its SVG says. The same drawings give the same bytes.
///
/// # Errors
/// A text that is no SVG, or a drawing with gradients, patterns, transparency or pictures other than opaque PNG, which the
/// program's technical drawings do not have.
pub fn pdf(pages: &[String], title: &str) -> Result<Vec<u8>, DrawingError> {
    let trees: Vec<_> = pages.iter().map(|svg| parse(svg)).collect::<Result<_, _>>()?;
    let (mut fonts, mut images) = (PdfFonts::default(), PdfImages::default());
    let mut contents = vec![];
    for tree in &trees {
        contents.push((tree.size(), PageContent::of(tree, &mut fonts, &mut images)?));
    }
    let mut ids = (1..).map(Ref::new);
    let mut next = || ids.next().unwrap_or(Ref::new(i32::MAX));
    let (catalog, page_tree, info) = (next(), next(), next());
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(page_tree);
    pdf.document_info(info)
        .title(TextStr(title))
        .creator(TextStr(concat!("Brillianteer ", env!("CARGO_PKG_VERSION"))));
    let kids: Vec<(Ref, Ref)> = contents.iter().map(|_| (next(), next())).collect();
    pdf.pages(page_tree).kids(kids.iter().map(|(page, _)| *page)).count(kids.len() as i32);
    let named = fonts.write(&mut pdf, &mut next);
    let pictures = images.write(&mut pdf, &mut next);
    for ((size, content), (page_id, content_id)) in contents.into_iter().zip(kids) {
        let mut page = pdf.page(page_id);
        page.media_box(Rect::new(0.0, 0.0, POINTS * size.width(), POINTS * size.height()));
        page.parent(page_tree).contents(content_id);
        let mut resources = page.resources();
        let mut dictionary = resources.fonts();
        for (name, font) in &named {
            dictionary.pair(Name(name.as_bytes()), *font);
        }
        dictionary.finish();
        if !pictures.is_empty() {
            let mut dictionary = resources.x_objects();
            for (name, picture) in &pictures {
                dictionary.pair(Name(name.as_bytes()), *picture);
            }
            dictionary.finish();
        }
        resources.finish();
        page.finish();
        let bytes = deflated(&content.finish());
        pdf.stream(content_id, &bytes).filter(Filter::FlateDecode);
    }
    Ok(pdf.finish())
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::read::ZlibDecoder;
    use std::io::Read;

    const DRAWING: &str = "<svg xmlns='http://www.w3.org/2000/svg' width='210mm' height='297mm' viewBox='0 0 210 297'>\
        <rect width='100' height='50' fill='#ffffff' stroke='#000000'/><path d='M1,1L9,9' stroke='#ff0000'/>\
        <text x='10' y='20' font-size='8'>Größe 96-12</text></svg>";

    /// Returns the contents of all compressed streams of a PDF, one after the other.
    fn streams(pdf: &[u8]) -> Vec<String> {
        let find = |from: usize, what: &[u8]| {
            pdf[from..].windows(what.len()).position(|window| window == what).map(|at| from + at)
        };
        let (mut from, mut found) = (0, vec![]);
        while let Some(at) = find(from, b"stream\n").map(|at| at + 7) {
            let mut text = vec![];
            if ZlibDecoder::new(&pdf[at..]).read_to_end(&mut text).is_ok() {
                found.push(String::from_utf8_lossy(&text).into_owned());
            }
            from = find(at, b"endstream").unwrap() + 9;
        }
        found
    }

    #[test]
    fn a_page_is_as_large_as_its_drawing_and_its_text_can_be_found() {
        let bytes = pdf(&[DRAWING.to_owned(), DRAWING.to_owned()], "Ä").unwrap();
        let text = String::from_utf8_lossy(&bytes);
        assert!(text.starts_with("%PDF-1.7") && text.ends_with("%%EOF"));
        let box_at = text.find("/MediaBox [0 0 ").unwrap() + 15;
        let size: Vec<f64> =
            text[box_at..].split(']').next().unwrap().split(' ').map(|n| n.parse().unwrap()).collect();
        assert!((size[0] - 595.276).abs() < 1e-2 && (size[1] - 841.89).abs() < 1e-2, "{size:?}");
        assert!(text.contains("/Count 2") && text.contains("/FontFile2"));
        let unicode = streams(&bytes).into_iter().find(|stream| stream.contains("beginbfchar")).unwrap();
        // Every letter of the text stands in the table that leads from glyphs to characters.
        for letter in "Größe 96-12".chars() {
            assert!(unicode.contains(&format!("<{:04X}>", letter as u32)), "{letter}: {unicode}");
        }
        assert!(bytes.len() < 20_000, "{} bytes: the font is not whole in it", bytes.len());
        assert_eq!(bytes, pdf(&[DRAWING.to_owned(), DRAWING.to_owned()], "Ä").unwrap());
    }

    #[test]
    fn what_a_pdf_cannot_show_is_refused() {
        for (inside, what) in [
            (
                "<defs><linearGradient id='g'><stop stop-color='red'/><stop offset='1'/></linearGradient></defs><rect width='9' height='9' fill='url(#g)'/>",
                "gradients",
            ),
            ("<rect width='9' height='9' opacity='0.5'/>", "transparency"),
            ("<rect width='9' height='9' fill-opacity='0.5'/>", "transparency"),
        ] {
            let svg = format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 9 9'>{inside}</svg>");
            let error = pdf(&[svg], "").unwrap_err().to_string();
            assert!(error.contains(what), "{error}");
        }
        assert!(matches!(pdf(&["no".to_owned()], ""), Err(DrawingError::NotSvg { .. })));
    }
}
