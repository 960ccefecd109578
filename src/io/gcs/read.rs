//! Reading `.gcs`.

use super::{COLOUR, ROOT, VERSION, guard};
use crate::cut::{MAX_PLANES, MaterialRef, Tier, Tiers};
use crate::io::cut_file::CutFileError;
use crate::io::cutters::{self, Gear, Piece, Told};
use crate::io::design_file::Brought;
use crate::io::text::TextError;
use crate::math::Plane;
use glam::DVec3;
use roxmltree::{Document, Node, ParsingOptions};

/// Elements and the blanks between them: ten thousand facets of fifty corners each.
const MOST_NODES: u32 = 1_000_000;

/// How far a tier's depth and angle may differ from its corners and normals, in the stone's unit and in degrees.
const TOLD_APART: f64 = 1e-6;

/// A normal of another length is badly written.
const UNIT_LENGTH: f64 = 1e-6;

/// What is read of `<index>`.
const INDEX: [&str; 4] = ["gear", "base", "symmetry", "mirror"];

/// Lines at the top and at the end, by the attributes of `<info>`; the last of each takes what follows, line by line.
const HEADERS: [&str; 3] = ["title", "author", "header2"];
const FOOTERS: [&str; 2] = ["footer1", "footer2"];

/// Reads a design; `label` is the file's path for errors, and names a design without a title.
///
/// # Errors
/// What keeps it from being a design, with its line.
pub fn read(bytes: &[u8], label: &str) -> Result<Brought, CutFileError> {
    let refused =
        |TextError { line, message }: TextError| CutFileError { path: label.to_owned(), line, message };
    let (text, spoilt) = guard::text(bytes).map_err(refused)?;
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(&text, options).map_err(|error| {
        refused(TextError { line: Some(error.pos().row as usize), message: error.to_string() })
    })?;
    let mut reader = Reader { document: &document, told: Told::default() };
    if spoilt {
        reader.told.warn(|| "characters that are no UTF-8 are read as '\u{fffd}'".to_owned());
    }
    let (tiers, material) = reader.design().map_err(refused)?;
    let name = cutters::title(tiers.headers.first(), label);
    cutters::brought(name, material, tiers, reader.told, label)
}

struct Reader<'d> {
    document: &'d Document<'d>,
    told: Told,
}

impl<'d> Reader<'d> {
    fn line(&self, node: Node<'_, '_>) -> usize {
        self.document.text_pos_at(node.range().start).row as usize
    }

    fn fault(&self, node: Node<'_, '_>, message: impl Into<String>) -> TextError {
        TextError { line: Some(self.line(node)), message: message.into() }
    }

    fn warn(&mut self, node: Node<'_, '_>, text: impl FnOnce() -> String) {
        let document = self.document;
        self.told.warn(|| format!("line {}: {}", document.text_pos_at(node.range().start).row, text()));
    }

    /// An attribute as text, with the line breaks that it has in the file; none where it is empty or missing.
    fn text(&self, node: Node<'_, '_>, key: &str) -> Option<String> {
        let attribute = node.attribute_node(key).filter(|attribute| !attribute.value().is_empty())?;
        let raw = &self.document.input_text()[attribute.range_value()];
        Some(guard::unfolded(raw, attribute.value()))
    }

    /// An attribute as a finite number; none, and a warning, where it is anything else.
    fn number(&mut self, node: Node<'_, '_>, key: &str) -> Option<f64> {
        let text = node.attribute(key)?;
        let number = text.trim().parse().ok().filter(|number: &f64| number.is_finite());
        if number.is_none() {
            self.warn(node, || format!("{key}: '{text:.40}' is no finite number; it is not read"));
        }
        number
    }

    fn is(&self, node: Node<'_, '_>, key: &str, otherwise: bool) -> bool {
        match node.attribute(key).map(|text| text.trim().to_ascii_lowercase()).as_deref() {
            Some("true" | "1") => true,
            Some("false" | "0") => false,
            _ => otherwise,
        }
    }

    fn design(&mut self) -> Result<(Tiers, MaterialRef), TextError> {
        let root = self.document.root_element();
        if !root.has_tag_name(ROOT) {
            return Err(self.fault(root, format!("<{ROOT}> is expected; this is another kind of XML")));
        }
        if root.attribute("version") != Some(VERSION) {
            self.warn(root, || format!("version: only {VERSION} is known; it is read as that"));
        }
        let mut tiers = self.gear(root).tiers();
        self.index(root, &mut tiers);
        self.info(root, &mut tiers);
        let material = self.render(root, &mut tiers);
        // So that the same remarks stand in the same order, whatever they went through.
        tiers.remarks.sort();
        self.cut(root, &mut tiers)?;
        Ok((tiers, material))
    }

    fn gear(&mut self, root: Node<'d, 'd>) -> Gear {
        let Some(node) = child(root, "index") else {
            self.warn(root, || "<index> is missing".to_owned());
            return Gear::given(96, 0.0, "", &mut self.told);
        };
        let teeth = self.number(node, "gear").unwrap_or_default();
        let offset = self.number(node, "base").unwrap_or_default();
        // What is not whole becomes 0, which no gear has.
        let teeth = if teeth.fract() == 0.0 { teeth as i32 } else { 0 };
        let place = format!("line {}: ", self.line(node));
        Gear::given(teeth, offset, &place, &mut self.told)
    }

    fn index(&mut self, root: Node<'d, 'd>, tiers: &mut Tiers) {
        let Some(node) = child(root, "index") else { return };
        let symmetry = self.number(node, "symmetry").unwrap_or(1.0) as i32;
        let place = format!("line {}: ", self.line(node));
        tiers.symmetry = cutters::symmetry(symmetry, &place, &mut self.told);
        tiers.mirror = self.is(node, "mirror", false);
        self.remark(node, &INDEX, tiers);
    }

    fn info(&mut self, root: Node<'d, 'd>, tiers: &mut Tiers) {
        let Some(node) = child(root, "info") else { return };
        tiers.headers = self.lines(node, &HEADERS);
        tiers.footers = self.lines(node, &FOOTERS);
        self.remark(node, &[HEADERS.as_slice(), &FOOTERS].concat(), tiers);
    }

    fn lines(&self, node: Node<'_, '_>, keys: &[&str]) -> Vec<String> {
        let mut texts: Vec<String> =
            keys.iter().map(|key| self.text(node, key).unwrap_or_default()).collect();
        let last = texts.pop().unwrap_or_default();
        texts.extend(last.split('\n').map(str::to_owned));
        cutters::up_to_the_last(texts)
    }

    fn render(&mut self, root: Node<'d, 'd>, tiers: &mut Tiers) -> MaterialRef {
        let Some(node) = child(root, "render") else {
            return cutters::material(f64::NAN, "", &mut self.told);
        };
        self.remark(node, &["refractive_index"], tiers);
        if let Some(colour) = child(node, "color") {
            let parts = ["r", "g", "b"].map(|key| colour.attribute(key).unwrap_or("0").trim());
            self.keep(colour, COLOUR.0, parts.join(" "), tiers);
        }
        let index = self.number(node, "refractive_index").unwrap_or(f64::NAN);
        let place = format!("line {}: ", self.line(node));
        cutters::material(index, &place, &mut self.told)
    }

    /// Keeps the attributes that are not in `known` as remarks.
    fn remark(&mut self, node: Node<'_, '_>, known: &[&str], tiers: &mut Tiers) {
        for attribute in node.attributes().filter(|attribute| !known.contains(&attribute.name())) {
            if let Some(text) = self.text(node, attribute.name()) {
                self.keep(node, attribute.name(), text, tiers);
            }
        }
    }

    fn keep(&mut self, node: Node<'_, '_>, key: &str, text: String, tiers: &mut Tiers) {
        if super::RENDER.contains(&(key, Some(&text))) || (key, text.as_str()) == COLOUR {
            return;
        }
        if tiers.remarks.iter().any(|(other, _)| other == key) {
            self.warn(node, || format!("{key}: it is said twice; '{text:.40}' is not kept"));
        } else {
            tiers.remarks.push((key.to_owned(), text));
        }
    }

    fn cut(&mut self, root: Node<'d, 'd>, tiers: &mut Tiers) -> Result<(), TextError> {
        let gear = Gear { teeth: tiers.gear, offset: tiers.offset };
        let mut facets = 0;
        for node in root.children().filter(Node::is_element) {
            match node.tag_name().name() {
                "tier" => {
                    let pieces = self.tier(node, gear)?;
                    facets += pieces.len();
                    if facets > MAX_PLANES {
                        let message =
                            format!("there are more facets than {MAX_PLANES}, which are the most taken");
                        return Err(self.fault(node, message));
                    }
                    let empty = pieces.is_empty().then(|| self.empty_tier(node)).flatten();
                    let mut gathered = cutters::gathered(pieces);
                    cutters::named_once(&mut gathered);
                    tiers.tiers.extend(gathered.into_iter().chain(empty));
                }
                "index" | "render" | "info" => {}
                other => self.warn(node, || format!("<{other:.40}> is not known here and is not read")),
            }
        }
        Ok(())
    }

    /// A tier without facets, which is kept for what it says.
    fn empty_tier(&mut self, node: Node<'_, '_>) -> Option<Tier> {
        let (polar, depth) = (self.number(node, "angle")?, self.number(node, "depth")?);
        let setting = Gear { teeth: 96, offset: 0.0 }.setting(slope_normal(polar, 0.0), depth.max(0.0));
        self.warn(node, || "this tier has no facets".to_owned());
        let instructions = self.text(node, "instructions").unwrap_or_default();
        let is_cut = self.is(node, "visible", true);
        Some(Tier {
            angle: girdle_below(setting.angle),
            distance: setting.distance,
            instructions,
            is_cut,
            facets: vec![],
        })
    }

    /// The facets of a tier; each has its name and instructions, for whichever begins one of its own.
    fn tier(&mut self, node: Node<'d, 'd>, gear: Gear) -> Result<Vec<Piece>, TextError> {
        let (polar, depth) = (self.number(node, "angle"), self.number(node, "depth"));
        let name = self.text(node, "name").unwrap_or_default();
        let instructions = self.text(node, "instructions").unwrap_or_default();
        let is_cut = self.is(node, "visible", true);
        self.ornaments(node);
        let mut apart = Apart::default();
        let mut pieces = Vec::new();
        for facet in node.children().filter(|child| child.has_tag_name("facet")) {
            let plane = self.plane(facet, polar, depth)?;
            apart.look(facet, polar, &plane);
            let mut setting = gear.setting(plane.normal, plane.offset);
            setting.angle = girdle_below(setting.angle);
            let (name, instructions) = (name.clone(), instructions.clone());
            pieces.push(Piece { tier: 0, setting, name, instructions, is_cut });
        }
        if let Some(text) = apart.told(&name) {
            self.warn(node, || text);
        }
        Ok(pieces)
    }

    /// What a tier says that a design has no place for.
    fn ornaments(&mut self, node: Node<'_, '_>) {
        if self.is(node, "guide", false) {
            self.warn(node, || "guide: that the tier is a guide is not kept".to_owned());
        }
        let frosted = |node: &Node<'_, '_>| {
            node.attribute("frosting").is_some_and(|text| {
                !matches!(text.trim().to_ascii_lowercase().as_str(), "" | "0" | "false" | "none")
            })
        };
        if frosted(&node) || node.children().any(|facet| frosted(&facet)) {
            self.warn(node, || "frosting: it is not kept; all facets are polished here".to_owned());
        }
    }

    /// The plane of a facet: its own normal, else that of angle and index; its tier's depth, else that of its corners.
    fn plane(
        &mut self,
        facet: Node<'_, '_>,
        polar: Option<f64>,
        depth: Option<f64>,
    ) -> Result<Plane, TextError> {
        let own = ["nx", "ny", "nz"].map(|key| self.number(facet, key));
        let own = own.iter().copied().collect::<Option<Vec<f64>>>().map(|n| DVec3::from_slice(&n));
        let normal = match own.filter(|n| (n.length() - 1.0).abs() < UNIT_LENGTH) {
            Some(normal) => normal,
            None => self.told_normal(facet, polar)?,
        };
        let depth = match depth.or_else(|| Some(normal.dot(corners(facet).next()?))) {
            Some(depth) => depth,
            None => return Err(self.fault(facet, "depth: the tier has none and the facet has no corners")),
        };
        cutters::unit(normal, depth).ok_or_else(|| {
            self.fault(
                facet,
                format!("depth: {depth} must be 0 or more; the facets must lie around the origin"),
            )
        })
    }

    fn told_normal(&mut self, facet: Node<'_, '_>, polar: Option<f64>) -> Result<DVec3, TextError> {
        let Some((polar, index)) = polar.zip(self.number(facet, "index_angle")) else {
            let message =
                "nx, ny, nz: a normal of length 1 is expected, or the tier's angle and an index_angle";
            return Err(self.fault(facet, message));
        };
        self.warn(facet, || {
            "nx, ny, nz: no normal of length 1; that of angle and index_angle is taken".to_owned()
        });
        let azimuth = if polar < 90.0 - TOLD_APART { index - 90.0 } else { 270.0 - index };
        Ok(slope_normal(polar, azimuth))
    }
}

/// A child by its name.
fn child<'d>(node: Node<'d, 'd>, name: &str) -> Option<Node<'d, 'd>> {
    node.children().find(|child| child.has_tag_name(name))
}

fn slope_normal(polar: f64, azimuth: f64) -> DVec3 {
    Plane::from_slope(polar.to_radians(), azimuth.to_radians(), 1.0).normal
}

/// The format counts girdle facets as the pavilion's.
fn girdle_below(angle: f64) -> f64 {
    if angle == 90.0 { -90.0 } else { angle }
}

/// The corners of a facet that are numbers.
fn corners<'a>(facet: Node<'a, 'a>) -> impl Iterator<Item = DVec3> + use<'a> {
    let vertices = facet.children().filter(|child| child.has_tag_name("vertex"));
    vertices.filter_map(|vertex| {
        let [x, y, z] = ["x", "y", "z"]
            .map(|key| vertex.attribute(key)?.trim().parse().ok().filter(|v: &f64| v.is_finite()));
        Some(DVec3::new(x?, y?, z?))
    })
}

/// How far a tier's numbers differ from those of its facets.
#[derive(Default)]
struct Apart {
    corners: f64,
    angle: f64,
}

impl Apart {
    fn look(&mut self, facet: Node<'_, '_>, polar: Option<f64>, plane: &Plane) {
        let off = corners(facet).map(|corner| plane.distance(corner).abs());
        self.corners = off.fold(self.corners, f64::max);
        let slope = plane.normal.truncate().length().atan2(plane.normal.z).to_degrees();
        self.angle = polar.map_or(self.angle, |polar| self.angle.max((polar - slope).abs()));
    }

    fn told(&self, name: &str) -> Option<String> {
        let mut told = Vec::new();
        if self.corners > TOLD_APART {
            told.push(format!("corners lie up to {:.1e} off its depth, which is taken", self.corners));
        }
        if self.angle > TOLD_APART {
            told.push(format!("normals lie up to {:.1e}° off its angle; they are taken", self.angle));
        }
        (!told.is_empty()).then(|| format!("tier '{name:.40}': {}", told.join("; ")))
    }
}
