//! A stone's facet diagram, as cutters print it: the crown from above and the pavilion from below, a label for each
//! tier, an index of azimuths around each view, and a list of the tiers underneath.
//!
//! A tier is all facets of one slope and one distance from the stone's origin. Seen from below, the stone is turned over
//! about its y axis, so azimuths run clockwise from the left there.

mod labels;
mod marks;
mod style;

pub use marks::DrawnMarks;
pub use style::DiagramStyle;

use super::drawing::{Align, DrawnAspect, Ink, REMARK, Sheet, Type, degrees, shortened, text_width};
use brillianteer_cut::tier_stem;
use brillianteer_math::{Basis, Facet, grouped};
use brillianteer_scene::Stone;
use glam::DVec2;
use std::borrow::Cow;
use svg::Document;

/// Distance from the circle that holds the stone to the beginning of the index's ticks.
const TICKS: f64 = 8.0;
/// Distance from that circle to the ends of the longest ticks.
const TICKS_END: f64 = TICKS + 11.0;

/// Type of the tiers' names.
const NAME: Type = Type { size: 12.5, colour: Ink::Main };
/// Type of the tiers' slopes.
const SLOPE: Type = Type { size: 12.5, colour: Ink::Accent };
/// Type of the index's numbers.
const INDEX: Type = Type { size: 11.0, colour: Ink::Quiet };
/// Distance from one line of the list to the next.
const LIST_LINE: f64 = 20.0;

/// The legend of marks.
const MARKED: &str = "Marked are candidates of the audit: places that may not be what the designer meant.";

/// Two facets belong to one tier if their slopes (as cosines) and their distances (in radii) agree to this. It is a
/// hundred times finer than machines cut and far above rounding.
const SAME_TIER: f64 = 1e-6;

/// Draws the facet diagram in a style, which decides on its colours and on its parts.
///
/// Every facet is a polygon with its name in `data-name` and as its title. Upright facets, which are seen edge on, are
/// drawn with the crown.
pub fn diagram(stone: &Stone, title: &str, style: &DiagramStyle) -> Document {
    marked_diagram(stone, title, style, &DrawnMarks::default())
}

/// Draws the facet diagram as [`diagram`] does, and marks facets and corners in it.
pub fn marked_diagram(stone: &Stone, title: &str, style: &DiagramStyle, marks: &DrawnMarks) -> Document {
    let tiers = tiers(stone);
    let mut sheet = Sheet::new(style.inks);
    for view in [Basis::FACE_UP, Basis::FACE_DOWN].map(|basis| View::new(stone, basis, style)) {
        view.draw(&mut sheet, stone);
        let shown: Vec<&Tier> =
            tiers.iter().filter(|tier| view.holds(&stone.polytope.facets()[tier.first()])).collect();
        if style.most_lines > 0 {
            view.list(&mut sheet, &shown);
        }
        labels::Labels::new(&view, stone).write(&mut sheet, &shown);
        marks.draw(&mut sheet, stone, &view.aspect, |facet| view.holds(facet));
    }
    if !style.is_sheet {
        return sheet.bare(title, style::SMALL_MARGIN);
    }
    let facets = stone.polytope.facets().len();
    let subtitle = format!(
        "facet diagram · {} in {} · slopes from the girdle plane",
        counted(facets, "facet"),
        counted(tiers.len(), "tier"),
    );
    let legend = (!marks.is_empty()).then(|| MARKED.to_owned());
    sheet.document(title, &subtitle, legend.as_slice())
}

fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// The facets of one slope and one distance from the origin.
#[derive(Debug, Clone, PartialEq)]
struct Tier {
    /// The tier's number, from 1, in the order in which tiers first occur.
    number: usize,
    name: String,
    /// Slope from the girdle plane, in degrees: 0 is level, 90 upright.
    slope_degrees: f64,
    /// Azimuth of the first facet, from 0 to below 360 degrees; `None` for level facets.
    azimuth_degrees: Option<f64>,
    facets: Vec<u32>,
}

impl Tier {
    fn first(&self) -> usize {
        self.facets[0] as usize
    }
}

/// Returns all tiers of a stone, in the order of their first facets.
fn tiers(stone: &Stone) -> Vec<Tier> {
    let facets = stone.polytope.facets();
    let alike = |&a: &u32, &b: &u32| {
        let [a, b] = [a, b].map(|id| facets[id as usize].plane);
        (a.normal.z - b.normal.z).abs() < SAME_TIER && (a.offset - b.offset).abs() < SAME_TIER
    };
    let tier = |(index, group): (usize, Vec<u32>)| {
        let normal = facets[group[0] as usize].plane.normal;
        let radial = normal.truncate();
        Tier {
            number: index + 1,
            name: tier_name(group.iter().map(|&id| stone.name(id))),
            slope_degrees: radial.length().atan2(normal.z.abs()).to_degrees(),
            azimuth_degrees: (radial.length() > SAME_TIER).then(|| azimuth(radial)),
            facets: group,
        }
    };
    grouped(0..facets.len() as u32, alike).into_iter().enumerate().map(tier).collect()
}

/// Returns the azimuth of a direction, from 0 to below 360 degrees. An angle that two decimals would show as 360 is 0.
/// Others are rounded to 1e-9 degrees, so that rounding errors do not reach the second decimal.
fn azimuth(radial: DVec2) -> f64 {
    let degrees = radial.to_angle().to_degrees().rem_euclid(360.0);
    if degrees > 359.995 { 0.0 } else { (degrees * 1e9).round() / 1e9 }
}

/// Returns the common part of the names of a tier's facets without their numbers, or all different names where they
/// have nothing in common.
fn tier_name<'a>(names: impl Iterator<Item = Cow<'a, str>>) -> String {
    let mut different: Vec<String> = vec![];
    for name in names {
        let stem = tier_stem(&name).replace('_', " ");
        if !different.contains(&stem) {
            different.push(stem);
        }
    }
    different.join(", ")
}

/// A view of the diagram: the crown from above on the left, or the pavilion from below on the right.
struct View {
    aspect: DrawnAspect,
    style: DiagramStyle,
}

impl View {
    fn new(stone: &Stone, basis: Basis, style: &DiagramStyle) -> Self {
        let (low, high) = stone.polytope.bounds();
        let centre = basis.project((low + high) / 2.0);
        let corners = stone.polytope.vertices().iter().map(|&v| basis.project(v).distance(centre));
        let scale = style.radius / corners.fold(0.0, f64::max);
        let place = style.place(basis == Basis::FACE_UP);
        Self { aspect: DrawnAspect { basis, centre, scale, place }, style: *style }
    }

    fn name(&self) -> &'static str {
        match (self.is_crown(), self.style.is_sheet) {
            (true, true) => "crown, from above",
            (true, false) => "crown",
            (false, true) => "pavilion, from below",
            (false, false) => "pavilion",
        }
    }

    /// Returns whether a facet is drawn in this view.
    fn holds(&self, facet: &Facet) -> bool {
        self.aspect.shows(facet) || (self.is_crown() && !self.shows_below(facet))
    }

    fn is_crown(&self) -> bool {
        self.aspect.basis == Basis::FACE_UP
    }

    fn shows_below(&self, facet: &Facet) -> bool {
        DrawnAspect { basis: Basis::FACE_DOWN, ..self.aspect }.shows(facet)
    }

    /// Returns a point of the sheet at this distance and angle from the view's middle. The angle is as on paper, in
    /// degrees counter-clockwise from the right.
    fn polar(&self, radius: f64, angle_degrees: f64) -> DVec2 {
        let (sin, cos) = angle_degrees.to_radians().sin_cos();
        self.aspect.place + DVec2::new(radius * cos, -radius * sin)
    }

    /// Returns the angle on paper, in degrees, at which an azimuth lies.
    fn on_paper(&self, azimuth_degrees: f64) -> f64 {
        if self.is_crown() { azimuth_degrees } else { 180.0 - azimuth_degrees }
    }

    fn draw(&self, sheet: &mut Sheet, stone: &Stone) {
        if self.style.is_sheet {
            self.ticks(sheet);
        }
        sheet.stone(stone, &self.aspect, |facet| self.holds(facet));
        for (at, number) in self.index() {
            sheet.plain_text(INDEX, Align::Middle, at, &number);
        }
        let above = self.polar(self.style.name_above(), 90.0);
        sheet.text(Type { size: 14.0, colour: Ink::Main }, Align::Middle, above, self.name());
    }

    /// Draws the marks of the index around the stone.
    fn ticks(&self, sheet: &mut Sheet) {
        let begin = self.style.radius + TICKS;
        let (mut fine, mut coarse) = (vec![], vec![]);
        for k in 0..72 {
            let angle = f64::from(5 * k);
            let length = match k {
                _ if k % 9 == 0 => 11.0,
                _ if k % 3 == 0 => 7.0,
                _ => 4.0,
            };
            let lines = if k % 9 == 0 { &mut coarse } else { &mut fine };
            lines.push((self.polar(begin, angle), self.polar(begin + length, angle)));
        }
        sheet.quiet_lines(&fine, "index", 0.7);
        sheet.quiet_lines(&coarse, "index", 1.3);
    }

    /// Returns the index's numbers and their places; a small diagram has none.
    fn index(&self) -> Vec<(DVec2, String)> {
        let number = |k: i32| {
            let (text, angle) = (degrees(45.0 * f64::from(k)), self.on_paper(45.0 * f64::from(k)));
            // The box of the text decides its distance from the ring in this direction.
            let half = DVec2::new(text_width(&text, INDEX.size), INDEX.size) / 2.0;
            let toward = DVec2::from_angle(angle.to_radians()).abs();
            (self.polar(self.style.radius + TICKS_END + 5.0 + half.dot(toward), angle), text)
        };
        (0..if self.style.is_sheet { 8 } else { 0 }).map(number).collect()
    }

    /// Writes the list of the tiers seen in this view, line by line.
    fn list(&self, sheet: &mut Sheet, tiers: &[&Tier]) {
        let (top, half_room) = (self.style.list_below(), self.style.half_room());
        let x = self.aspect.place.x;
        let head = ["", "tier", "facets", "slope", "first azimuth"].map(str::to_owned);
        self.line(sheet, top, [INDEX; 5], &head);
        let rule = [-half_room, half_room].map(|side| DVec2::new(x + side, top + 11.0));
        sheet.quiet_lines(&[(rule[0], rule[1])], "rule", 0.8);
        let (name, slope) = (Type { size: REMARK.size, ..NAME }, Type { size: REMARK.size, ..SLOPE });
        let height = |k: usize| top + 9.0 + LIST_LINE * (k as f64 + 0.8);
        for (k, tier) in tiers.iter().take(self.style.most_lines).enumerate() {
            let cells = [
                tier.number.to_string(),
                shortened(&tier.name, REMARK.size, self.room_for_names()),
                tier.facets.len().to_string(),
                degrees(tier.slope_degrees),
                tier.azimuth_degrees.map_or("–".to_owned(), degrees),
            ];
            self.line(sheet, height(k), [INDEX, name, REMARK, slope, REMARK], &cells);
        }
        if let Some(more) = tiers.len().checked_sub(self.style.most_lines).filter(|&more| more > 0) {
            let rest = ["", &format!("and {} more", counted(more, "tier"))].map(str::to_owned);
            self.line(sheet, height(self.style.most_lines), [REMARK; 5], &rest);
        }
    }

    /// Returns the width that a tier's name may take in the list.
    fn room_for_names(&self) -> f64 {
        if self.style.is_sheet { 210.0 } else { 2.0 * self.style.half_room() - 26.0 - 90.0 }
    }

    /// Writes one line of the list: number and name aligned at the left, the rest at the right. A small diagram leaves
    /// out the last column.
    fn line(&self, sheet: &mut Sheet, y: f64, kinds: [Type; 5], cells: &[String]) {
        let half_room = self.style.half_room();
        let columns = if self.style.is_sheet {
            vec![-half_room, -half_room + 26.0, 64.0, 134.0, half_room]
        } else {
            vec![-half_room, -half_room + 22.0, half_room - 50.0, half_room]
        };
        let shown = cells.iter().take(columns.len()).enumerate();
        for (k, cell) in shown.filter(|(_, cell)| !cell.is_empty()) {
            let align = if k < 2 { Align::Start } else { Align::End };
            sheet.plain_text(kinds[k], align, DVec2::new(self.aspect.place.x + columns[k], y), cell);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_cut::{Crown, LowerHalf, Pavilion, RoundBrilliant};
    use brillianteer_math::Plane;
    use glam::DVec3;
    use resvg::usvg::roxmltree;
    use std::collections::BTreeMap;

    fn brilliant() -> Stone {
        let given = RoundBrilliant {
            table: 53.0,
            crown: Crown::Angle(34.5),
            pavilion: Pavilion::Angle(40.75),
            star_length: 50.0,
            lower_half: LowerHalf::Radial(75.0),
            girdle_thickness: 3.0,
            girdle_facets: 96,
            culet: 1.0,
        };
        Stone::new(&given.facets().unwrap()).unwrap()
    }

    fn cube() -> Stone {
        let sides =
            [("right", DVec3::X), ("left", DVec3::NEG_X), ("back", DVec3::Y), ("front", DVec3::NEG_Y)];
        let ends = [("a < b & \"c\"", DVec3::Z), ("bottom", DVec3::NEG_Z)];
        let plane = |(name, n): (&str, DVec3)| (name.to_owned(), Plane::new(n, 1.0));
        Stone::new(&sides.into_iter().chain(ends).map(plane).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn every_facet_is_one_polygon_that_bears_its_name() {
        for stone in [brilliant(), cube()] {
            let svg = diagram(&stone, "Test", &DiagramStyle::SHEET).to_string();
            let document = roxmltree::Document::parse(&svg).unwrap();
            let mut found: BTreeMap<&str, usize> = BTreeMap::new();
            for polygon in document.descendants().filter(|node| node.has_tag_name("polygon")) {
                let name = polygon.attribute("data-name").unwrap();
                let title = polygon.children().find(|node| node.has_tag_name("title")).unwrap();
                assert_eq!(title.text().map(str::trim), Some(name));
                *found.entry(name).or_default() += 1;
            }
            assert!(stone.names().iter().all(|name| found.get(name.as_str()) == Some(&1)));
            assert_eq!(found.len(), stone.names().len());
        }
    }

    #[test]
    fn marked_facets_and_corners_are_marked_where_they_are_seen() {
        let stone = brilliant();
        let of = |names: &[&str]| {
            let place = |name: &&str| stone.names().iter().position(|own| own == name).unwrap();
            names.iter().map(place).collect::<Vec<_>>()
        };
        let table = of(&["table"])[0];
        let corner = stone.polytope.corners(&stone.polytope.facets()[table]).next().unwrap();
        let marks = DrawnMarks { facets: of(&["table", "bezel 1", "main 3"]), corners: vec![corner] };
        let svg = marked_diagram(&stone, "Test", &DiagramStyle::SHEET, &marks).to_string();
        let count = |class: &str| svg.matches(&format!("class=\"{class}\"")).count();
        assert_eq!((count("marked-facet"), count("marked-corner")), (3, 1));
        assert!(svg.contains(MARKED));
        let plain = diagram(&stone, "Test", &DiagramStyle::SHEET).to_string();
        assert!(!plain.contains("marked-") && !plain.contains(MARKED));
    }

    #[test]
    fn frosted_facets_are_hatched_and_the_legend_says_so() {
        let svg = |stone: &Stone| diagram(stone, "Test", &DiagramStyle::SHEET).to_string();
        let frosted = cube().frosted(|plane| if plane == 4 { 0.5 } else { 0.0 });
        let legend = "Hatched facets are frosted.";
        assert!(svg(&frosted).contains("class=\"frosted\"") && svg(&frosted).contains(legend));
        assert!(!svg(&cube()).contains("class=\"frosted\"") && !svg(&cube()).contains(legend));
    }

    #[test]
    fn the_tiers_of_a_brilliant_are_its_kinds_of_facet() {
        let tiers = tiers(&brilliant());
        let found: Vec<_> =
            tiers.iter().map(|t| (t.name.as_str(), t.facets.len(), degrees(t.slope_degrees))).collect();
        let expected = [
            ("table", 1, "0°"),
            ("bezel", 8, "34.5°"),
            ("star", 8, "23.07°"),
            ("upper half", 16, "40.58°"),
            ("girdle", 96, "90°"),
            ("lower half", 16, "42.01°"),
            ("main", 8, "40.75°"),
            ("culet", 1, "0°"),
        ];
        assert_eq!(found, expected.map(|(name, count, slope)| (name, count, slope.to_owned())));
        let azimuths: Vec<_> = tiers.iter().map(|tier| tier.azimuth_degrees.map(degrees)).collect();
        let expected = [
            None,
            Some("0°"),
            Some("22.5°"),
            Some("11.25°"),
            Some("1.88°"),
            Some("11.25°"),
            Some("0°"),
            None,
        ];
        assert_eq!(azimuths, expected.map(|text| text.map(str::to_owned)));
    }

    #[test]
    fn every_tier_of_a_brilliant_is_labelled_and_listed_with_its_slope() {
        let svg = diagram(&brilliant(), "Test", &DiagramStyle::SHEET).to_string();
        let lines = |text: &str| svg.lines().filter(|line| line.trim() == text).count();
        for (name, slope) in
            [("star", "23.07°"), ("upper half", "40.58°"), ("lower half", "42.01°"), ("main", "40.75°")]
        {
            assert_eq!((lines(name), lines(slope)), (2, 2), "{name}");
        }
    }

    #[test]
    fn a_tier_takes_the_name_that_its_facets_share() {
        let name = |names: &[&str]| tier_name(names.iter().map(|&name| name.into()));
        assert_eq!(name(&["upper_half 1", "upper_half 16"]), "upper half");
        assert_eq!(name(&["P1", "P2"]), "P1, P2");
        assert_eq!(name(&["table"]), "table");
        assert_eq!(name(&["crown a", "crown a 2"]), "crown a");
    }

    #[test]
    fn azimuths_run_from_0_to_below_360_degrees() {
        assert_eq!(azimuth(DVec2::X), 0.0);
        assert_eq!(azimuth(DVec2::NEG_Y), 270.0);
        assert_eq!(azimuth(DVec2::new(1.0, -1e-12)), 0.0);
    }

    #[test]
    fn from_below_azimuths_run_clockwise_from_the_left() {
        let stone = cube();
        let below = View::new(&stone, Basis::FACE_DOWN, &DiagramStyle::SHEET);
        let right_on_paper = below.aspect.at(DVec3::X);
        assert!(right_on_paper.x < below.aspect.place.x);
        for azimuth in [0.0, 45.0, 130.0] {
            let toward = DVec2::from_angle(f64::to_radians(azimuth)).extend(0.0);
            let middle = below.aspect.place;
            let (stone, index) = (below.aspect.at(toward), below.polar(1.0, below.on_paper(azimuth)));
            assert!((stone - middle).normalize_or_zero().distance(index - middle) < 1e-12);
        }
    }

    #[test]
    fn a_stone_of_very_many_tiers_is_drawn_and_its_list_cut_short() {
        let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
        let plane = |k: u32| {
            let z = 1.0 - f64::from(2 * k + 1) / 400.0;
            (format!("{k}"), Plane::from_slope(z.acos(), golden * f64::from(k), 1.0))
        };
        let ball = Stone::new(&(0..400).map(plane).collect::<Vec<_>>()).unwrap();
        let svg = diagram(&ball, "Ball", &DiagramStyle::SHEET).to_string();
        assert!(svg.contains("and 160 tiers more"));
        assert_eq!(svg.matches("<polygon").count(), 400);
    }

    #[test]
    fn the_same_stone_gives_the_same_bytes() {
        let drawn = || diagram(&brilliant(), "Test", &DiagramStyle::SHEET).to_string();
        assert_eq!(drawn(), drawn());
    }

    /// Returns the least height of type in points, the colour of the paper and the SVG, for a diagram shown at this size
    /// in points.
    fn shown(stone: &Stone, points: [f64; 2]) -> (f64, String, String) {
        let style = DiagramStyle::fitting(stone, super::super::Inks::DARK, points);
        let svg = diagram(stone, "Test", &style).to_string();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let size = |name| document.root_element().attribute(name).unwrap().parse::<f64>().unwrap();
        let scale = (points[0] / size("width")).min(points[1] / size("height"));
        let types = document.descendants().filter_map(|node| node.attribute("font-size"));
        let least = types.map(|text| text.parse::<f64>().unwrap()).fold(f64::INFINITY, f64::min);
        let paper = document.descendants().find(|node| node.has_tag_name("rect")).unwrap();
        (least * scale, paper.attribute("fill").unwrap().to_owned(), svg)
    }

    #[test]
    fn a_diagram_in_a_quarter_of_a_window_is_read_without_a_glass() {
        let [across, down] = [shown(&brilliant(), [400.0, 200.0]).0, shown(&brilliant(), [200.0, 400.0]).0];
        assert!(across > 7.5 && down > 7.5, "{across}, {down}: it goes by the shape of its place");
        for points in [[400.0, 380.0], [360.0, 330.0], [900.0, 760.0]] {
            let (height, paper, svg) = shown(&brilliant(), points);
            assert!(height > 8.0, "{points:?}: type of {height} points");
            assert_eq!(paper, "#1b1c1f");
            // Every tier stands in the list with its slope.
            for slope in ["34.5°", "23.07°", "40.58°", "42.01°", "40.75°"] {
                assert!(svg.contains(slope), "{points:?}: {slope} is missing");
            }
        }
        let sheet = diagram(&brilliant(), "Test", &DiagramStyle::SHEET).to_string();
        assert!(sheet.contains("fill=\"#ffffff\"") && !sheet.contains("#1b1c1f"), "exports stay light");
    }
}
