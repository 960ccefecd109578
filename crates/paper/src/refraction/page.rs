//! Writes a web page that refracts a moving background by a map: one file, without network or library.

use super::packing::packed;
use super::{diffuse_png, write_bytes};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use brillianteer_files::WriteError;
use brillianteer_picture::RefractionMap;
use serde_json::json;
use std::path::Path;

/// The page without its maps.
const TEMPLATE: &str = include_str!("page.html");

/// The texts and the background of a page, besides its map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Page<'a> {
    /// The stone's name.
    pub title: &'a str,
    /// A description of how the map was made.
    pub description: &'a str,
    /// The width of the background as a multiple of the map's, at least 1.
    pub span: f64,
    /// A picture to begin with: its name, and the bytes of its PNG or JPEG. Without one the page draws its own.
    pub background: Option<(&'a str, &'a [u8])>,
}

/// The largest picture that is put into a page, in MiB.
pub const MOST_MEGABYTES: usize = 32;

/// Returns whether a picture can be put into a page: it is a PNG or JPEG, which browsers show, and not too large.
pub fn takes(picture: &[u8]) -> bool {
    let shows = picture.starts_with(b"\x89PNG") || picture.starts_with(b"\xff\xd8");
    shows && picture.len() <= MOST_MEGABYTES << 20
}

/// Writes the web page of a map.
///
/// # Errors
/// Fails where the file system refuses, or the map is empty or lacks pixels.
pub fn write_page(path: &Path, map: &RefractionMap, page: &Page) -> Result<(), WriteError> {
    let html = html(map, page).map_err(|e| WriteError::io(path, e))?;
    write_bytes(path, html.as_bytes())
}

fn html(map: &RefractionMap, page: &Page) -> Result<String, png::EncodingError> {
    let bands = map.bands.iter().map(|band| json!({ "response": band.response.to_cols_array() }));
    let packed = packed(map)?.into_iter();
    let packed = packed.map(|band| json!({ "step": band.step, "remainders": uri("image/png", &band.png) }));
    let data = json!({
        "size": map.size,
        "span": page.span,
        "bands": bands.collect::<Vec<_>>(),
        "packed": packed.collect::<Vec<_>>(),
        "diffuse": uri("image/png", &diffuse_png(&map.diffuse, page.title)?),
        "background": page.background.map(|(name, bytes)| json!({ "name": name, "picture": uri(mime(bytes), bytes) })),
    });
    // Without a `<`, nothing in the data can end the script element or begin another.
    let data = data.to_string().replace('<', "\\u003c");
    // The data are inserted last, so that no part of them is taken for a placeholder of the template.
    let html = TEMPLATE
        .replace("{{description}}", &escaped(page.description))
        .replace("{{title}}", &escaped(page.title));
    Ok(html.replace("{{data}}", &data))
}

fn uri(mime: &str, bytes: &[u8]) -> String {
    format!("data:{mime};base64,{}", STANDARD.encode(bytes))
}

fn mime(bytes: &[u8]) -> &'static str {
    if bytes.starts_with(b"\xff\xd8") { "image/jpeg" } else { "image/png" }
}

/// Escapes text for HTML, and braces as well, so that none of it is a placeholder of the template.
fn escaped(text: &str) -> String {
    let pairs = [("&", "&amp;"), ("<", "&lt;"), (">", "&gt;"), ("\"", "&quot;"), ("{", "&#123;")];
    pairs.iter().fold(text.to_owned(), |text, (character, entity)| text.replace(character, entity))
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_picture::{Linear, MapBand, SourcePlace};
    use glam::DMat3;

    #[test]
    fn names_cannot_break_out_of_the_page_and_nothing_is_fetched() {
        let band = MapBand { nm: 555.0, response: DMat3::IDENTITY, places: vec![SourcePlace::default(); 4] };
        let map = RefractionMap { size: [2, 2], bands: vec![band], diffuse: Linear::new(2, 2) };
        let title = "</script><script>alert(1)</script>{{data}}\"&";
        let page =
            Page { title, description: title, span: 2.0, background: Some(("Photograph", b"\xff\xd8x")) };
        let html = html(&map, &page).unwrap();
        assert!(!html.contains("alert(1)</script>") && !html.contains("{{"));
        assert_eq!(html.matches("<script").count(), 2);
        assert!(html.contains("data:image/jpeg;base64,/9h4") && !html.contains("http:"));
        assert!(!html.contains("https:"), "the page is to fetch nothing");
        let broken = RefractionMap { size: [3, 2], ..map };
        let folder = tempfile::tempdir().unwrap();
        assert!(write_page(&folder.path().join("a.html"), &broken, &page).is_err());
    }
}
