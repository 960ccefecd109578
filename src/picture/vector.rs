//! Pictures as drawings: the virtual facets themselves, as polygons of an SVG.

use super::drawing::{hex, page};
use crate::math::{Basis, Plane};
use crate::optics::{LinearRgb, encoded_from_linear};
use crate::scene::{Film, Glare, Scope, Stone, elevation_deg};
use crate::trace::beam::Beams;
use glam::{DMat2, DVec2, DVec3};
use svg::node::element::{Description, Group, Polygon, Rectangle, Title};
use svg::{Document, Node};

/// Side of the drawing, in its own units; coordinates have four decimals.
pub const SIDE: u32 = 1000;

/// Area, in square units of the drawing, below which polygons are left out, as rounding would lose them.
const SPECK: f64 = 1e-5;

/// Draws the map of strongest exits as polygons that do not overlap. Each has the path of its light (`data-path`), and
/// the elevation and weight of its exit.
pub fn strongest(stone: &Stone, beams: &Beams, scope: &Scope, title: &str) -> Document {
    let page = Page::new(stone, beams);
    let mut groups: Vec<Group> = scope.bands.iter().map(|b| band_group(&b.name, &hex(b.colour))).collect();
    let mut dark = band_group("unresolved", "#000000");
    let cells = beams.strongest_exits();
    for cell in &cells {
        let Some(exit) = cell.strongest.map(|id| beams.get(id)) else {
            let polygons = page.polygons(beams.get(cell.outline).outline);
            polygons.into_iter().for_each(|(_, polygon)| dark.append(polygon));
            continue;
        };
        let band = scope.band(exit.exit, beams.zenith);
        let elevation = elevation_deg(exit.exit, beams.zenith);
        let met = beams.facets(exit.id);
        for (copy, polygon) in page.polygons(beams.get(cell.outline).outline) {
            let polygon = polygon
                .set("data-path", page.names(&met, copy))
                .set("data-elevation", format!("{elevation:.3}"))
                .set("data-weight", format!("{:.4}", exit.weight));
            groups[band].append(polygon);
        }
    }
    groups.push(dark);
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
    let mut group = Group::new().set("class", "energy");
    for id in beams.leaves() {
        let encoded = seen[id as usize].to_array().map(|c| (encoded_from_linear(c) * 255.0).round() as u8);
        let colour = hex(encoded);
        let met = beams.facets(id);
        for (copy, polygon) in page.polygons(beams.get(id).outline) {
            let path = page.names(&met, copy);
            let colour = colour.as_str();
            group.append(polygon.set("data-path", path).set("fill", colour).set("stroke", colour));
        }
    }
    let open = format!("unresolved light {:.2e} of the whole", beams.unresolved());
    let groups = vec![group.set("stroke-width", SEAM)];
    page.document(title, &open, beams, (&hex(scope.bands[0].colour), groups))
}

/// Width of a line in each polygon's own colour. It closes the hairlines that viewers leave between polygons that touch.
const SEAM: f64 = 0.8;

fn band_group(name: &str, colour: &str) -> Group {
    Group::new().set("class", name).set("fill", colour).set("stroke", colour).set("stroke-width", SEAM)
}

/// A drawing's frame, and the copies of the symmetry that make up the whole drawing.
struct Page<'a> {
    stone: &'a Stone,
    film: Film,
    copies: Vec<DMat2>,
    /// For each copy, the facet that each facet is mapped to.
    carried: Vec<Vec<u32>>,
}

impl<'a> Page<'a> {
    fn new(stone: &'a Stone, beams: &Beams) -> Self {
        let copies = beams.symmetry.copies();
        let planes: Vec<Plane> = stone.polytope.planes().collect();
        let carried = copies.iter().map(|&c| carried(&planes, &beams.view, c)).collect();
        Self { stone, film: Film::around(&stone.polytope, &beams.view, SIDE), copies, carried }
    }

    /// Returns an outline in every copy, in the drawing's units.
    fn polygons(&self, outline: &[DVec2]) -> Vec<(usize, Polygon)> {
        let map = |copy| self.film.pixels_from_image(copy);
        let points = |copy| outline.iter().map(|&p| map(copy).transform_point2(p)).collect::<Vec<_>>();
        let drawn = self.copies.iter().map(|&c| points(c)).enumerate();
        let large = drawn.filter(|(_, p)| crate::math::area(p).abs() > SPECK);
        large.map(|(k, p)| (k, Polygon::new().set("points", listed(&p)))).collect()
    }

    fn names(&self, facets: &[u32], copy: usize) -> String {
        let name = |&f: &u32| self.stone.name(self.carried[copy][f as usize]);
        facets.iter().map(name).collect::<Vec<_>>().join(", ")
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
            format!("Virtual facets of exact beams, {polarised}, index {}; {open}", beams.medium.index,);
        let frame = page(DVec2::splat(f64::from(SIDE)))
            .add(Title::new(title))
            .add(Description::new().add(svg::node::Text::new(description)))
            .add(Rectangle::new().set("width", "100%").set("height", "100%").set("fill", backing));
        groups.into_iter().fold(frame, |document, group| document.add(group.set("stroke-linejoin", "round")))
    }
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
