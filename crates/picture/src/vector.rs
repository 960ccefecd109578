//! Pictures as drawings: the virtual facets themselves, as polygons of an SVG. Only one domain of a picture's
//! symmetry is written out; its copies refer to it, and name the facets that replace those of a path.

use super::contrast::contrast_colour;
use super::drawing::{hex, page};
use brillianteer_math::{Basis, Plane};
use brillianteer_optics::{LinearRgb, encoded_from_linear};
use brillianteer_scene::{Film, Glare, Scope, Stone, elevation_deg};
use brillianteer_trace::beam::Beams;
use glam::{DAffine2, DMat2, DVec2, DVec3};
use std::collections::BTreeMap;
use svg::Document;
use svg::node::element::{Definitions, Description, Group, Path, Polygon, Rectangle, Title, Use};

/// Side of the drawing, in its own units; coordinates have four decimals, in contrast maps two.
pub const SIDE: u32 = 1000;

/// Area, in square units of the drawing, below which polygons are left out, as rounding would lose them.
const SPECK: f64 = 1e-5;

/// Draws the map of strongest exits as polygons that do not overlap, in all copies together. Each has the path of its light
/// (`data-path`), and the elevation and weight of its exit.
pub fn strongest(stone: &Stone, beams: &Beams, scope: &Scope, title: &str) -> Document {
    let page = Page::new(stone, beams);
    // The last list holds the cells that no light has left yet.
    let mut polygons: Vec<Vec<Polygon>> = vec![vec![]; scope.bands.len() + 1];
    let cells = beams.strongest_exits();
    for cell in &cells {
        let Some(polygon) = page.polygon(beams.get(cell.outline).outline) else { continue };
        let Some(exit) = cell.strongest.map(|id| beams.get(id)) else {
            polygons[scope.bands.len()].push(polygon);
            continue;
        };
        let elevation = elevation_deg(exit.exit, beams.zenith);
        let polygon = polygon
            .set("data-path", page.names(&beams.facets(exit.id)))
            .set("data-elevation", format!("{elevation:.3}"))
            .set("data-weight", format!("{:.4}", exit.weight));
        polygons[scope.band(exit.exit, beams.zenith)].push(polygon);
    }
    let bands = scope.bands.iter().map(|band| (band.name.as_str(), hex(band.colour)));
    let bands = bands.chain([("unresolved", "#000000".to_owned())]).zip(polygons);
    let groups = bands.map(|((name, colour), polygons)| {
        page.group(name, polygons).set("fill", colour.as_str()).set("stroke", colour)
    });
    let groups: Vec<Group> = groups.collect();
    let open = format!("strongest exit undecided in {:.2e} of the area", beams.undecided(&cells));
    page.document(title, &open, beams, (&hex(scope.bands[0].colour), groups))
}

/// Draws the energy picture: the finest subdivision of the image that was traced. Each polygon has the colour of all the
/// light seen through it, with or without glare, and the facets that this light has met (`data-path`).
pub fn energy(stone: &Stone, beams: &Beams, (scope, glare): (&Scope, Glare), title: &str) -> Document {
    let page = Page::new(stone, beams);
    let colours = scope.colours();
    let mut seen: Vec<LinearRgb> = Vec::with_capacity(beams.len());
    for beam in beams.iter() {
        let above = beam.parent.map_or(LinearRgb::ZERO, |p| seen[p as usize]);
        let is_shown = beam.weight > 0.0 && glare.shows(beam.is_surface());
        let own = if is_shown { colours[scope.band(beam.exit, beams.zenith)] } else { LinearRgb::ZERO };
        seen.push(above + own * beam.weight);
    }
    let coloured = |id: u32| {
        let encoded = seen[id as usize].to_array().map(|c| (encoded_from_linear(c) * 255.0).round() as u8);
        let (colour, path) = (hex(encoded), page.names(&beams.facets(id)));
        let polygon = page.polygon(beams.get(id).outline)?;
        Some(polygon.set("data-path", path).set("fill", colour.as_str()).set("stroke", colour))
    };
    let group = page.group("energy", beams.leaves().filter_map(coloured).collect());
    let open = format!("unresolved light {:.2e} of the whole", beams.unresolved());
    page.document(title, &open, beams, (&hex(scope.bands[0].colour), vec![group]))
}

/// The steps of contrast that a drawing tells apart, each 1 % of the face's mean brightness.
const CONTRAST_STEPS: f64 = 100.0;

/// The part of a square of a contrast map by which a seam is wide at most: the lines of lighter squares would hide small dark ones.
const SEAM_OF_SQUARES: f64 = 0.05;

/// Draws a contrast map: the parts of the face, each with its contrast. Parts of about the same contrast are one path, which says it
/// (`data-contrast`). `side` is that of the squares, girdle radii.
pub fn contrast<'a>(
    stone: &Stone,
    beams: &Beams,
    (parts, side): (impl Iterator<Item = (&'a [DVec2], f64)>, f64),
    (title, open): (&str, &str),
) -> Document {
    let page = Page::of_whole(stone, beams);
    let mut paths: BTreeMap<i32, String> = BTreeMap::new();
    for (outline, contrast) in parts {
        let data = paths.entry((CONTRAST_STEPS * contrast.min(1.0)).round() as i32).or_default();
        data.push_str(&page.path(outline));
    }
    let coloured = |(step, data): (i32, String)| {
        let contrast = f64::from(step) / CONTRAST_STEPS;
        let colour = hex(contrast_colour(contrast));
        let path = Path::new().set("d", data).set("data-contrast", contrast);
        path.set("fill", colour.as_str()).set("stroke", colour)
    };
    let seam = SEAM.min(SEAM_OF_SQUARES * side / page.film.pixel);
    let group = Group::new().set("class", "contrast").set("stroke-width", format!("{seam:.4}"));
    let group = group.set("stroke-linejoin", "round");
    let group = paths.into_iter().map(coloured).fold(group, Group::add);
    page.document(title, open, beams, ("#000000", vec![group]))
}

/// Width of a line in each polygon's own colour. It closes the hairlines that viewers leave between polygons that touch.
const SEAM: f64 = 0.8;

/// A drawing's frame, and the copies of the symmetry that make up the whole drawing.
struct Page<'a> {
    stone: &'a Stone,
    film: Film,
    /// The maps of the drawing that carry the first copy to each of the others.
    copies: Vec<DAffine2>,
    /// For each of these, the facet to which each facet is mapped.
    carried: Vec<Vec<u32>>,
}

impl<'a> Page<'a> {
    fn new(stone: &'a Stone, beams: &Beams) -> Self {
        let film = Film::around(&stone.polytope, &beams.view, SIDE);
        let planes: Vec<Plane> = stone.polytope.planes().collect();
        let others: Vec<DMat2> = beams.symmetry.copies().into_iter().skip(1).collect();
        let first = film.pixels_from_image(DMat2::IDENTITY).inverse();
        let copies = others.iter().map(|&copy| film.pixels_from_image(copy) * first).collect();
        let carried = others.iter().map(|&copy| carried(&planes, &beams.view, copy)).collect();
        Self { stone, film, copies, carried }
    }

    /// Returns the page of a drawing that writes out the whole picture.
    fn of_whole(stone: &'a Stone, beams: &Beams) -> Self {
        let film = Film::around(&stone.polytope, &beams.view, SIDE);
        Self { stone, film, copies: vec![], carried: vec![] }
    }

    /// Returns the corners of an outline of the first copy in the drawing's units.
    fn points(&self, outline: &[DVec2]) -> Vec<DVec2> {
        let map = self.film.pixels_from_image(DMat2::IDENTITY);
        outline.iter().map(|&p| map.transform_point2(p)).collect()
    }

    /// Returns an outline as a part of a path's data; empty for a speck.
    fn path(&self, outline: &[DVec2]) -> String {
        let points = self.points(outline);
        if brillianteer_math::area(&points).abs() <= SPECK {
            return String::new();
        }
        let corners: Vec<String> = points.iter().map(|p| format!("{:.2},{:.2}", p.x, p.y)).collect();
        format!("M{}Z", corners.join("L"))
    }

    /// Returns an outline of the first copy in the drawing's units; `None` for a speck.
    fn polygon(&self, outline: &[DVec2]) -> Option<Polygon> {
        let points = self.points(outline);
        let is_large = brillianteer_math::area(&points).abs() > SPECK;
        is_large.then(|| Polygon::new().set("points", listed(&points)))
    }

    /// Returns a group of this class with polygons of the first copy, and with the other copies of them.
    fn group(&self, class: &str, polygons: Vec<Polygon>) -> Group {
        let group =
            Group::new().set("class", class).set("stroke-width", SEAM).set("stroke-linejoin", "round");
        if self.copies.is_empty() || polygons.is_empty() {
            return polygons.into_iter().fold(group, Group::add);
        }
        let first = polygons.into_iter().fold(Group::new().set("id", class), Group::add);
        let numbered = (2..).zip(&self.copies);
        let copies = numbered.map(|(number, copy)| {
            // Older programs know references only by this name.
            let copied = Use::new().set("xlink:href", format!("#{class}")).set("data-copy", number);
            copied.set("transform", matrix(copy))
        });
        copies.fold(group.add(first), Group::add)
    }

    /// Returns the names of facets in the first copy.
    fn names(&self, facets: &[u32]) -> String {
        facets.iter().map(|&facet| self.stone.name(facet)).collect::<Vec<_>>().join(", ")
    }

    /// Returns the facets' names in every copy, in one order: for each copy a group without a picture.
    fn copies(&self) -> Definitions {
        let all: Vec<u32> = (0..self.stone.polytope.facets().len() as u32).collect();
        let lists = std::iter::once(&all).chain(&self.carried);
        let groups = (1..).zip(lists).map(|(number, list)| {
            let group = Group::new().set("class", "copy").set("data-copy", number);
            group.set("data-facets", self.names(list))
        });
        groups.fold(Definitions::new(), Definitions::add)
    }

    fn document(
        &self,
        title: &str,
        open: &str,
        beams: &Beams,
        (backing, groups): (&str, Vec<Group>),
    ) -> Document {
        let polarised = if beams.polarised { "polarised" } else { "unpolarised" };
        let description =
            format!("Drawn from exact beams, {polarised}, index {}; {open}", beams.medium.index);
        let frame = page(DVec2::splat(f64::from(SIDE)))
            .add(Title::new(title))
            .add(Description::new().add(svg::node::Text::new(description)))
            .add(Rectangle::new().set("width", "100%").set("height", "100%").set("fill", backing));
        let frame = if self.copies.is_empty() {
            frame
        } else {
            frame.set("xmlns:xlink", "http://www.w3.org/1999/xlink").add(self.copies())
        };
        groups.into_iter().fold(frame, Document::add)
    }
}

/// Writes a map as the value of an SVG's `transform`.
fn matrix(map: &DAffine2) -> String {
    // The sum with 0 turns -0 into 0.
    let numbers = map.to_cols_array().map(|number| ((number * 1e12).round() / 1e12 + 0.0).to_string());
    format!("matrix({})", numbers.join(" "))
}

fn listed(points: &[DVec2]) -> String {
    points.iter().map(|p| format!("{:.4},{:.4}", p.x, p.y)).collect::<Vec<_>>().join(" ")
}

/// Returns the facet to which a symmetry of the picture maps each facet.
fn carried(planes: &[Plane], view: &Basis, copy: DMat2) -> Vec<u32> {
    let image = |n: DVec3| view.lift(copy * view.project(n)) + view.toward * view.toward.dot(n);
    let nearest = |plane: &Plane| {
        let normal = image(plane.normal);
        let gap = |p: &Plane| (p.normal - normal).length() + (p.offset - plane.offset).abs();
        let best = (0..planes.len()).min_by(|&a, &b| gap(&planes[a]).total_cmp(&gap(&planes[b])));
        best.unwrap_or(0) as u32
    };
    planes.iter().map(nearest).collect()
}
