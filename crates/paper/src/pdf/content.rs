//! The content of a PDF page: its drawing as operators (8.5, 9.4).

use super::POINTS;
use super::fonts::{PdfFonts, name};
use super::images::{PdfImages, picture_name};
use crate::DrawingError;
use pdf_writer::types::{LineCapStyle, LineJoinStyle, TextRenderingMode};
use pdf_writer::{Content, Name, Str};
use resvg::tiny_skia::{PathSegment, Point, Transform};
use resvg::usvg::layout::{PositionedGlyph, Span};
use resvg::usvg::{
    Color, Fill, FillRule, Group, Image, LineCap, LineJoin, Node, Paint, PaintOrder, Path, Stroke, Text, Tree,
};

/// Glyphs that differ in place from the end of the one before by less than this, in type sizes, are not moved.
const IN_PLACE: f32 = 1e-3;

/// A page that is being written.
pub(super) struct PageContent<'a> {
    content: Content,
    fonts: &'a mut PdfFonts,
    images: &'a mut PdfImages,
    tree: &'a Tree,
    /// The transform from the drawing's pixels, y down, to points, y up.
    base: Transform,
}

impl<'a> PageContent<'a> {
    /// Writes all of a drawing.
    pub fn of(
        tree: &'a Tree,
        fonts: &'a mut PdfFonts,
        images: &'a mut PdfImages,
    ) -> Result<Content, DrawingError> {
        let base = Transform::from_row(POINTS, 0.0, 0.0, -POINTS, 0.0, POINTS * tree.size().height());
        let mut page = Self { content: Content::new(), fonts, images, tree, base };
        page.group(tree.root())?;
        Ok(page.content)
    }

    fn group(&mut self, group: &Group) -> Result<(), DrawingError> {
        let refused = |what: &'static str| Err(DrawingError::NotForPdf { what });
        if group.opacity().get() < 1.0 {
            return refused("transparency");
        }
        if group.clip_path().is_some() || group.mask().is_some() || !group.filters().is_empty() {
            return refused("clips, masks or filters");
        }
        for node in group.children() {
            match node {
                Node::Group(group) => self.group(group)?,
                Node::Path(path) => self.path(path)?,
                Node::Text(text) => self.text(text)?,
                Node::Image(image) => self.image(image)?,
            }
        }
        Ok(())
    }

    /// Shows a picture: PDF paints it into the unit square, its first row on top (8.9.5).
    fn image(&mut self, image: &Image) -> Result<(), DrawingError> {
        let place = self.images.place(image.kind())?;
        let (width, height) = (image.size().width(), image.size().height());
        let unit = Transform::from_row(width, 0.0, 0.0, -height, 0.0, height);
        let at = self.base.pre_concat(image.abs_transform()).pre_concat(unit);
        self.content.save_state();
        self.content.transform([at.sx, at.ky, at.kx, at.sy, at.tx, at.ty]);
        self.content.x_object(Name(picture_name(place).as_bytes()));
        self.content.restore_state();
        Ok(())
    }

    fn path(&mut self, path: &Path) -> Result<(), DrawingError> {
        if !path.is_visible() {
            return Ok(());
        }
        let transform = self.base.pre_concat(path.abs_transform());
        // A line has no inside, but viewers paint a filled path at least a pixel wide.
        let bounds = path.data().bounds();
        let has_inside = bounds.width() > 0.0 && bounds.height() > 0.0;
        let paints = (path.fill().filter(|_| has_inside || path.stroke().is_none()), path.stroke());
        let strokes_first = path.paint_order() == PaintOrder::StrokeAndFill;
        if let (true, (Some(_), Some(_))) = (strokes_first, paints) {
            self.painted(path, transform, (None, paints.1))?;
            return self.painted(path, transform, (paints.0, None));
        }
        self.painted(path, transform, paints)
    }

    fn painted(
        &mut self,
        path: &Path,
        transform: Transform,
        (fill, stroke): (Option<&Fill>, Option<&Stroke>),
    ) -> Result<(), DrawingError> {
        self.fill_colour(fill)?;
        self.stroke(stroke, scale_of(transform))?;
        let at = |mut p: Point| {
            transform.map_point(&mut p);
            (p.x, p.y)
        };
        let mut last = Point::zero();
        for segment in path.data().segments() {
            match segment {
                PathSegment::MoveTo(p) => {
                    let (x, y) = at(p);
                    self.content.move_to(x, y);
                    last = p;
                }
                PathSegment::LineTo(p) => {
                    let (x, y) = at(p);
                    self.content.line_to(x, y);
                    last = p;
                }
                PathSegment::QuadTo(c, p) => {
                    // A quadratic curve is a cubic one whose controls lie two thirds of the way to its own.
                    let toward = |from: Point| {
                        Point::from_xy(
                            from.x + (c.x - from.x) * 2.0 / 3.0,
                            from.y + (c.y - from.y) * 2.0 / 3.0,
                        )
                    };
                    self.cubic(at(toward(last)), at(toward(p)), at(p));
                    last = p;
                }
                PathSegment::CubicTo(a, b, p) => {
                    self.cubic(at(a), at(b), at(p));
                    last = p;
                }
                PathSegment::Close => {
                    self.content.close_path();
                }
            }
        }
        let even_odd = fill.is_some_and(|fill| fill.rule() == FillRule::EvenOdd);
        match (fill.is_some(), stroke.is_some(), even_odd) {
            (true, true, false) => self.content.fill_nonzero_and_stroke(),
            (true, true, true) => self.content.fill_even_odd_and_stroke(),
            (true, false, false) => self.content.fill_nonzero(),
            (true, false, true) => self.content.fill_even_odd(),
            (false, true, _) => self.content.stroke(),
            (false, false, _) => self.content.end_path(),
        };
        Ok(())
    }

    fn cubic(&mut self, a: (f32, f32), b: (f32, f32), p: (f32, f32)) {
        self.content.cubic_to(a.0, a.1, b.0, b.1, p.0, p.1);
    }

    fn fill_colour(&mut self, fill: Option<&Fill>) -> Result<(), DrawingError> {
        if let Some(fill) = fill {
            let [r, g, b] = colour(fill.paint(), fill.opacity().get())?;
            self.content.set_fill_rgb(r, g, b);
        }
        Ok(())
    }

    /// Sets the style of lines; `scale` is that of the drawing.
    fn stroke(&mut self, stroke: Option<&Stroke>, scale: f32) -> Result<(), DrawingError> {
        let Some(stroke) = stroke else { return Ok(()) };
        let [r, g, b] = colour(stroke.paint(), stroke.opacity().get())?;
        self.content.set_stroke_rgb(r, g, b).set_line_width(scale * stroke.width().get());
        self.content.set_line_cap(match stroke.linecap() {
            LineCap::Butt => LineCapStyle::ButtCap,
            LineCap::Round => LineCapStyle::RoundCap,
            LineCap::Square => LineCapStyle::ProjectingSquareCap,
        });
        self.content.set_line_join(match stroke.linejoin() {
            LineJoin::Miter | LineJoin::MiterClip => LineJoinStyle::MiterJoin,
            LineJoin::Round => LineJoinStyle::RoundJoin,
            LineJoin::Bevel => LineJoinStyle::BevelJoin,
        });
        let dashes = stroke.dasharray().unwrap_or_default().iter().map(|dash| scale * dash);
        self.content.set_dash_pattern(dashes, scale * stroke.dashoffset());
        Ok(())
    }

    fn text(&mut self, text: &Text) -> Result<(), DrawingError> {
        let transform = self.base.pre_concat(text.abs_transform());
        for span in text.layouted().iter().filter(|span| span.visible) {
            let alike = match (&span.fill, &span.stroke) {
                (Some(fill), Some(stroke)) => fill.paint() == stroke.paint(),
                _ => true,
            };
            let passes = match (alike, span.paint_order) {
                (true, _) => vec![(true, true)],
                (false, PaintOrder::StrokeAndFill) => vec![(false, true), (true, false)],
                (false, PaintOrder::FillAndStroke) => vec![(true, false), (false, true)],
            };
            for (filled, stroked) in passes {
                let fill = span.fill.as_ref().filter(|_| filled);
                let stroke = span.stroke.as_ref().filter(|_| stroked);
                let mode = match (fill.is_some(), stroke.is_some()) {
                    (true, true) => TextRenderingMode::FillStroke,
                    (true, false) => TextRenderingMode::Fill,
                    (false, true) => TextRenderingMode::Stroke,
                    (false, false) => continue,
                };
                self.fill_colour(fill)?;
                self.stroke(stroke, scale_of(transform))?;
                self.content.begin_text().set_text_rendering_mode(mode);
                self.span(span, transform);
                self.content.end_text();
            }
        }
        Ok(())
    }

    /// Shows the glyphs of a span. Glyphs that follow one another in line are shown in one piece.
    fn span(&mut self, span: &Span, transform: Transform) {
        let mut rest = span.positioned_glyphs.as_slice();
        while let Some(first) = rest.first() {
            let Some(font) = self.fonts.place(self.tree.fontdb(), first.font) else {
                rest = &rest[1..];
                continue;
            };
            let size = first.font_size() * scale_of(transform);
            let start = placed(first, transform);
            self.content.set_font(Name(name(font).as_bytes()), size);
            self.content.set_text_matrix([start.sx, start.ky, start.kx, start.sy, start.tx, start.ty]);
            let run = rest.iter().take_while(|glyph| {
                let place = placed(glyph, transform);
                glyph.font == first.font
                    && along(start, place, size).is_some_and(|(_, aside)| aside < IN_PLACE)
            });
            let count = run.count().max(1);
            let (run, others) = rest.split_at(count);
            let mut reached = 0.0;
            let mut shown = self.content.show_positioned();
            let mut items = shown.items();
            for glyph in run {
                let (number, width) = self.fonts.glyph(font, glyph.id.0 as u16, &glyph.text);
                let at = along(start, placed(glyph, transform), size).map_or(reached, |(at, _)| at);
                if (at - reached).abs() > IN_PLACE {
                    // A number moves the next glyph to the left, in thousandths of the type size (9.4.3).
                    items.adjust(1000.0 * (reached - at));
                    reached = at;
                }
                items.show(Str(&number.to_be_bytes()));
                reached += width;
            }
            rest = others;
        }
    }
}

/// Returns the place and the rotation of a glyph on the page, without its scale.
fn placed(glyph: &PositionedGlyph, transform: Transform) -> Transform {
    let outline = transform.pre_concat(glyph.outline_transform());
    let scale = outline.sx.hypot(outline.ky).max(f32::MIN_POSITIVE);
    Transform::from_row(
        outline.sx / scale,
        outline.ky / scale,
        outline.kx / scale,
        outline.sy / scale,
        outline.tx,
        outline.ty,
    )
}

/// Returns the distances of a glyph along the line that another begins, and beside it, in type sizes; `None` where
/// the one is turned against the other.
fn along(start: Transform, place: Transform, size: f32) -> Option<(f32, f32)> {
    let turned = (start.sx - place.sx).abs().max((start.ky - place.ky).abs());
    let (x, y) = (place.tx - start.tx, place.ty - start.ty);
    let forward = (x * start.sx + y * start.ky) / size;
    let aside = (y * start.sx - x * start.ky).abs() / size;
    (turned < IN_PLACE).then_some((forward, aside))
}

/// Returns the factor by which a transform lengthens lengths.
fn scale_of(transform: Transform) -> f32 {
    (transform.sx * transform.sy - transform.kx * transform.ky).abs().sqrt()
}

/// Returns red, green and blue, from 0 to 1.
fn colour(paint: &Paint, opacity: f32) -> Result<[f32; 3], DrawingError> {
    match paint {
        _ if opacity < 1.0 => Err(DrawingError::NotForPdf { what: "transparency" }),
        Paint::Color(Color { red, green, blue }) => {
            Ok([red, green, blue].map(|part| f32::from(*part) / 255.0))
        }
        _ => Err(DrawingError::NotForPdf { what: "gradients or patterns" }),
    }
}
