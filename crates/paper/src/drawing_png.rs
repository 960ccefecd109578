//! Rasterises drawings: SVG text to pixels, with fonts that the program carries, so that it looks the same everywhere, and with
//! those of the system for other letters.

use super::{MOST_PIXELS, letters};
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{self, ImageHrefResolver, ImageKind, Options, Tree, fontdb};
use std::collections::BTreeSet;
use std::sync::Arc;

#[cfg(test)]
pub(super) mod legible;

/// The reason why a drawing could not be rasterised.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum DrawingError {
    /// The text is no SVG.
    #[error("the drawing is not an SVG: {reason}")]
    NotSvg {
        /// The parser's message.
        reason: String,
    },
    /// The drawing has an element that PDF files of this program cannot hold.
    #[error("the drawing has {what}, which is not written as PDF; write it as SVG or PNG")]
    NotForPdf {
        /// The name of that element.
        what: &'static str,
    },
    /// The picture would be empty or too large.
    #[error(
        "a drawing of {width} by {height} pixels: each side must be from 1 to {MOST_PIXELS}; change the width"
    )]
    Size {
        /// Pixels from left to right.
        width: u32,
        /// Pixels from top to bottom; the height follows from the width.
        height: u32,
    },
}

/// Rasterises an SVG at a width in pixels, on white. Returns the width, the height, and RGB with a byte each, rows from the
/// top.
///
/// Nothing outside the text is read, except for fonts with letters that the program's own fonts lack. Pictures in the drawing
/// are left out.
///
/// # Errors
/// Fails where the text is no SVG, or the picture would have a side of no pixels or more than 16,384.
pub fn rasterize(svg: &str, width: u32) -> Result<(u32, u32, Vec<u8>), DrawingError> {
    let tree = parse(svg)?;
    let pixmap = drawn(&tree, width, Color::WHITE)?;
    let mut rgb = Vec::with_capacity(pixmap.data().len() / 4 * 3);
    pixmap.data().chunks_exact(4).for_each(|pixel| rgb.extend_from_slice(&pixel[..3]));
    Ok((pixmap.width(), pixmap.height(), rgb))
}

/// Rasterises an SVG as large as fits into a number of pixels across and down, otherwise like [`rasterize_clear`].
///
/// # Errors
/// Fails where [`rasterize`] does.
pub fn rasterize_within(svg: &str, [across, down]: [u32; 2]) -> Result<(u32, u32, Vec<u8>), DrawingError> {
    let size = parse(svg)?.size();
    let width = f64::from(down) * f64::from(size.width()) / f64::from(size.height());
    rasterize_clear(svg, across.min(width.floor() as u32).max(1))
}

/// Rasterises an SVG at a width in pixels, on a transparent ground. Returns the width, the height, and straight RGBA with a
/// byte each, rows from the top.
///
/// # Errors
/// Fails where [`rasterize`] does.
pub fn rasterize_clear(svg: &str, width: u32) -> Result<(u32, u32, Vec<u8>), DrawingError> {
    let pixmap = drawn(&parse(svg)?, width, Color::TRANSPARENT)?;
    let straight = |pixel: &resvg::tiny_skia::PremultipliedColorU8| {
        let colour = pixel.demultiply();
        [colour.red(), colour.green(), colour.blue(), colour.alpha()]
    };
    let rgba = pixmap.pixels().iter().flat_map(straight).collect();
    Ok((pixmap.width(), pixmap.height(), rgba))
}

fn drawn(tree: &Tree, width: u32, paper: Color) -> Result<Pixmap, DrawingError> {
    let scale = width as f32 / tree.size().width();
    let height = (tree.size().height() * scale).round() as u32;
    let allowed = 1..=MOST_PIXELS;
    let fits = allowed.contains(&width) && allowed.contains(&height);
    let pixmap = if fits { Pixmap::new(width, height) } else { None };
    let mut pixmap = pixmap.ok_or(DrawingError::Size { width, height })?;
    pixmap.fill(paper);
    resvg::render(tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    Ok(pixmap)
}

/// Parses a drawing. Letters that the program's own fonts lack come from fonts of the system.
pub(super) fn parse(svg: &str) -> Result<Tree, DrawingError> {
    let tree = parsed(svg, letters::own_fonts())?;
    if letters::lacking(&tree).is_empty() { Ok(tree) } else { parsed(svg, letters::all_fonts()) }
}

fn parsed(svg: &str, fonts: Arc<fontdb::Database>) -> Result<Tree, DrawingError> {
    let within = ImageHrefResolver {
        resolve_data: Box::new(|mime, data, _| (mime == "image/png").then_some(ImageKind::PNG(data))),
        resolve_string: Box::new(|_, _| None),
    };
    let options = Options {
        font_family: letters::FAMILY.to_owned(),
        fontdb: fonts,
        font_resolver: letters::resolver(),
        image_href_resolver: within,
        ..Options::default()
    };
    usvg::Tree::from_str(svg, &options).map_err(|e| DrawingError::NotSvg { reason: e.to_string() })
}

/// Returns a note about letters of texts that no font of the program or of the system has, so that drawings and PDF files show
/// boxes in their place; `None` where there are none.
pub fn note_of_letters<'t>(texts: impl IntoIterator<Item = &'t str>) -> Option<String> {
    let beyond: BTreeSet<char> = texts
        .into_iter()
        .flat_map(str::chars)
        .filter(|letter| !letter.is_ascii() && !letter.is_control())
        .collect();
    if beyond.is_empty() {
        return None;
    }
    let text: String = beyond.into_iter().collect();
    let svg = format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 9 9'><text>{text}</text></svg>");
    let lacking = letters::lacking(&parse(&svg).ok()?);
    (!lacking.is_empty()).then(|| {
        format!("no font has the letters {lacking}, which drawings show as boxes; install a font that has them, such as Noto")
    })
}

#[cfg(test)]
#[allow(clippy::print_stdout, reason = "a test that is left out says so")]
mod tests {
    use super::legible::assert_legible;
    use super::*;
    use brillianteer_cut::{Crown, LowerHalf, Pavilion, RoundBrilliant, TOLKOWSKY};
    use brillianteer_math::Plane;
    use brillianteer_picture::{DiagramStyle, Inks, diagram, profile};
    use brillianteer_scene::Stone;
    use glam::DVec3;

    /// Returns brilliants far beyond what is cut: every possible combination of small, usual and large proportions.
    fn brilliants() -> Vec<RoundBrilliant> {
        let mut all = vec![];
        for (table, star_length) in [(6.0, 30.0), (53.0, 50.0), (53.0, 98.0), (80.0, 90.0)] {
            for (crown, pavilion) in
                [(3.0, 3.0), (3.0, 64.0), (15.0, 12.0), (34.5, 40.75), (64.0, 3.0), (64.0, 60.0)]
            {
                for (girdle_thickness, lower_half) in [(0.0, 75.0), (3.0, 3.0), (8.0, 98.0)] {
                    all.extend([0.0, 0.3, 8.0, 40.0, 88.0].map(|culet| RoundBrilliant {
                        table,
                        star_length,
                        crown: Crown::Angle(crown),
                        pavilion: Pavilion::Angle(pavilion),
                        girdle_thickness,
                        lower_half: LowerHalf::Radial(lower_half),
                        girdle_facets: 24,
                        culet,
                    }));
                }
            }
        }
        all.retain(|given| given.derived().is_ok());
        assert!(all.len() > 200, "{} brilliants", all.len());
        all
    }

    fn built(given: &RoundBrilliant) -> Stone {
        Stone::new(&given.facets().unwrap()).unwrap()
    }

    /// Builds a stone from planes n·x = 1, named as given.
    fn planes(normals: &[(&str, [f64; 3])]) -> Stone {
        let plane = |&(name, n): &(&str, [f64; 3])| {
            let plane = Plane::new(DVec3::from_array(n), 1.0).normalized().unwrap();
            (name.to_owned(), plane)
        };
        Stone::new(&normals.iter().map(plane).collect::<Vec<_>>()).unwrap()
    }

    fn odd_stones() -> Vec<Stone> {
        let tetrahedron = [
            ("a", [1.0, 1.0, 1.0]),
            ("b", [1.0, -1.0, -1.0]),
            ("c", [-1.0, 1.0, -1.0]),
            ("d", [-1.0, -1.0, 1.0]),
        ];
        let long = "a name much longer than any facet, or any list of facets, could ever have room for";
        let slab = [
            (long, [0.0, 0.0, 9.0]),
            ("<&\"'>", [0.0, 0.0, -9.0]),
            ("tab\there", [1.0, 0.1, 0.0]),
            (long, [-1.0, 0.1, 0.1]),
            ("面", [0.0, 1.0, 0.0]),
            ("Ω", [0.0, -1.0, 0.0]),
        ];
        let needle = slab.map(|(name, [x, y, z])| (name, [3.0 * x, 3.0 * y, z / 90.0]));
        vec![planes(&tetrahedron), planes(&slab), planes(&needle)]
    }

    #[test]
    fn no_text_of_a_profile_leaves_it_or_overlaps_another_whatever_the_proportions() {
        for given in brilliants() {
            assert_legible(&profile(&built(&given), "A title", Some(&given)).to_string());
        }
    }

    #[test]
    fn no_text_of_a_facet_diagram_leaves_it_or_overlaps_another() {
        for given in brilliants().iter().step_by(7) {
            assert_legible(
                &diagram(&built(given), &"A long title ".repeat(20), &DiagramStyle::SHEET).to_string(),
            );
        }
    }

    #[test]
    fn no_text_of_a_small_diagram_leaves_it_or_overlaps_another() {
        for given in brilliants().iter().step_by(23) {
            for points in [[400.0, 380.0], [230.0, 240.0], [700.0, 300.0]] {
                let stone = built(given);
                let style = DiagramStyle::fitting(&stone, Inks::DARK, points);
                assert_legible(&diagram(&stone, "small", &style).to_string());
            }
        }
    }

    #[test]
    fn stones_without_a_table_or_with_strange_names_are_drawn_legibly() {
        for stone in odd_stones() {
            assert_legible(&diagram(&stone, "A <title> & more", &DiagramStyle::SHEET).to_string());
            assert_legible(&profile(&stone, "\u{1}", None).to_string());
        }
    }

    #[test]
    fn a_drawing_keeps_its_shape_and_is_drawn_in_colour_on_white() {
        let svg = profile(&built(&TOLKOWSKY), "Tolkowsky", Some(&TOLKOWSKY)).to_string();
        let (width, height, rgb) = rasterize(&svg, 1000).unwrap();
        let size = parse(&svg).unwrap().size();
        assert_eq!(width, 1000);
        assert_eq!(height, (size.height() / size.width() * 1000.0).round() as u32);
        assert_eq!(rgb.len(), (width * height * 3) as usize);
        assert_eq!(rgb[..3], [255; 3]);
        let blue = rgb.chunks_exact(3).filter(|p| p[2] > p[0].saturating_add(40)).count();
        assert!(blue > 1000, "{blue} pixels of dimensions");
    }

    #[test]
    fn every_letter_that_drawings_use_is_in_the_fonts() {
        let picture = |text: &str| {
            let svg = format!(
                "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 40 40'><text y='30'>{text}</text></svg>"
            );
            rasterize(&svg, 40).unwrap().2
        };
        let (blank, unknown) = (picture(""), picture("\u{10ffff}"));
        for letter in ('!'..='~').filter(|c| !"<&".contains(*c)).chain("°·–…éΩя".chars()) {
            let drawn = picture(&letter.to_string());
            assert!(drawn != blank && drawn != unknown, "{letter}");
        }
    }

    #[test]
    fn letters_that_no_font_has_are_named_and_others_are_not() {
        assert_eq!(note_of_letters(["Größe 96–12", "Алмаз α", "a\u{200d}\u{fe0f}"]), None);
        let note = note_of_letters(["a \u{10fffd}", "\u{10fffd}\u{10fff0}"]).unwrap();
        assert!(note.contains("the letters \u{10fff0}\u{10fffd},"), "{note}");
    }

    #[test]
    fn letters_beyond_the_programs_own_fonts_are_drawn_from_the_systems() {
        let svg = |text: &str| {
            format!(
                "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 40 40'><text y='30'>{text}</text></svg>"
            )
        };
        let has = |letter: char| {
            let tree = parsed(&svg(&letter.to_string()), letters::all_fonts()).unwrap();
            letters::lacking(&tree).is_empty()
        };
        let lacks = |letter: char| {
            !letters::lacking(&parsed(&svg(&letter.to_string()), letters::own_fonts()).unwrap()).is_empty()
        };
        let Some(letter) = "שا石ก✈♞".chars().find(|letter| lacks(*letter) && has(*letter)) else {
            println!("SKIPPED: the system has no fonts with letters that the program's own lack");
            return;
        };
        let picture = |text: &str| rasterize(&svg(text), 40).unwrap().2;
        let drawn = picture(&letter.to_string());
        assert!(drawn != picture("") && drawn != picture("\u{10fffd}"), "{letter}");
        assert_eq!(drawn, picture(&letter.to_string()));
        // Letters of the program's own fonts stay theirs.
        let ids = |fonts: &fontdb::Database| fonts.faces().map(|face| face.id).collect::<Vec<_>>();
        assert!(ids(&letters::all_fonts()).starts_with(&ids(&letters::own_fonts())));
    }

    #[test]
    fn what_is_no_svg_is_an_error() {
        for text in
            ["", "no", "<svg", "<html/>", "<svg xmlns='http://www.w3.org/2000/svg' width='0' height='0'/>"]
        {
            assert!(matches!(rasterize(text, 100), Err(DrawingError::NotSvg { .. })), "{text}");
        }
    }

    #[test]
    fn empty_and_giant_pictures_are_errors_that_name_the_size() {
        let svg = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 10 20'/>";
        for width in [0, 10_000, u32::MAX] {
            let error = rasterize(svg, width).unwrap_err();
            assert!(error.to_string().starts_with(&format!("a drawing of {width} by ")), "{error}");
        }
        assert_eq!(rasterize(svg, 8192).map(|(_, height, _)| height), Ok(16_384));
    }
}
