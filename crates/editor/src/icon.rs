//! The window's icon, which the program draws itself: its first stone from above.

use brillianteer_paper::rasterize_clear;
use brillianteer_session::model::document::Document;
use egui::IconData;

/// The pixels of the icon along each side; systems make smaller icons of it.
const SIDE: u32 = 256;

/// Returns the icon as a drawing in SVG.
fn drawing() -> Option<String> {
    let first = Document::first().ok()?;
    Some(brillianteer_picture::icon(first.specimen().stone().ok()?).to_string())
}

/// Returns the icon as pixels; `None` only where the program itself is broken.
pub fn icon() -> Option<IconData> {
    let (width, height, rgba) = rasterize_clear(&drawing()?, SIDE).ok()?;
    Some(IconData { rgba, width, height })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The file that desktops take the icon from; `UPDATE_ICON=1 cargo test --release --lib app::icon` writes it anew.
    const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/brillianteer.svg");

    #[test]
    fn the_icon_is_a_stone_on_nothing() {
        let IconData { rgba, width, height } = icon().unwrap();
        assert_eq!((width, height, rgba.len()), (SIDE, SIDE, (4 * SIDE * SIDE) as usize));
        let alpha = |x: u32, y: u32| rgba[(4 * (y * SIDE + x) + 3) as usize];
        assert_eq!((alpha(0, 0), alpha(SIDE - 1, 0), alpha(SIDE / 2, SIDE / 2)), (0, 0, 255));
        let shades: std::collections::BTreeSet<&[u8]> = rgba.chunks(4).filter(|p| p[3] == 255).collect();
        assert!(shades.len() > 20, "{} shades", shades.len());
    }

    #[test]
    fn the_file_for_desktops_is_the_icon() {
        if std::env::var_os("UPDATE_ICON").is_some() {
            std::fs::write(FILE, drawing().unwrap()).unwrap();
        }
        assert_eq!(std::fs::read_to_string(FILE).unwrap(), drawing().unwrap());
    }
}
