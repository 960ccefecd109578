//! Writes a design as `.gcs`.

use super::{COLOUR, RENDER, ROOT, VERSION};
use crate::cutters::{self, FacetOutline};
use crate::design_file::EncodedDesign;
use brillianteer_cut::{FinishNote, Indexed, Tier, Tiers};
use brillianteer_math::{Plane, span};
use brillianteer_scene::Specimen;
use glam::DVec3;

/// A stone whose reach and height differ from those of the format by less than this is not scaled, so that it keeps
/// its digits.
const IN_FORM: f64 = 1e-9;

/// Coordinates of a stone that reaches 1 are rounding, and are written as 0, if they are no larger than this.
const ROUNDING: f64 = 1e-15;

/// The scale and the shift of a stone for the format.
struct Form {
    scale: f64,
    /// The height that lies at z = 0 in the file, in the design's unit.
    middle: f64,
}

/// XML that is being written, and how many characters its texts have lost.
#[derive(Default)]
struct Page {
    text: String,
    dropped: usize,
}

impl Page {
    fn line(&mut self, indent: usize, line: &str) {
        self.text.extend(std::iter::repeat_n("    ", indent));
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// Returns an attribute with a blank before it.
    fn attribute(&mut self, key: &str, value: &str) -> String {
        format!(" {key}=\"{}\"", self.escaped(value))
    }

    fn escaped(&mut self, value: &str) -> String {
        let mut escaped = String::with_capacity(value.len());
        for character in value.chars() {
            match character {
                '&' => escaped.push_str("&amp;"),
                '<' => escaped.push_str("&lt;"),
                '>' => escaped.push_str("&gt;"),
                '"' => escaped.push_str("&quot;"),
                '\t' | '\n' | '\r' => escaped.push_str(&format!("&#{};", u32::from(character))),
                // XML cannot hold these in any form.
                '\0'..' ' | '\u{fffe}' | '\u{ffff}' => self.dropped += 1,
                _ => escaped.push(character),
            }
        }
        escaped
    }
}

/// Encodes the design of a specimen as `.gcs`, with messages about the properties that the format cannot hold.
pub fn write(specimen: &Specimen) -> EncodedDesign {
    let mut lost = Vec::new();
    let tiers = cutters::tiers_of(specimen, &mut lost);
    cutters::untold(&specimen.design, tiers.headers.first(), &mut lost);
    left_out(&tiers, &mut lost);
    let index = cutters::refractive_index(specimen, &mut lost);
    let mut page = Page::default();
    page.line(0, &format!("<{ROOT} version=\"{VERSION}\">"));
    let Tiers { gear, offset, symmetry, mirror, .. } = &*tiers;
    let mirror = i32::from(*mirror);
    page.line(
        1,
        &format!(r#"<index gear="{gear}" base="{offset}" symmetry="{symmetry}" mirror="{mirror}"/>"#),
    );
    put_tiers(&tiers, &mut page, &mut lost);
    put_render(&tiers, index, &mut page);
    put_info(&tiers, &mut page);
    page.line(0, &format!("</{ROOT}>"));
    if page.dropped > 0 {
        lost.push(format!("{} characters that XML cannot hold are left out", page.dropped));
    }
    EncodedDesign { bytes: page.text.into_bytes(), lost }
}

/// Adds messages about the properties that the format cannot hold.
fn left_out(tiers: &Tiers, lost: &mut Vec<String>) {
    let named_apart = |tier: &&Tier| tier.facets.iter().any(|f| !f.name.is_empty() && f.name != tier.name());
    let mut tell = |count: usize, [one, several]: [&str; 2], rest: &str| match count {
        0 => {}
        1 => lost.push(format!("1 {one} {rest}")),
        _ => lost.push(format!("{count} {several} {rest}")),
    };
    let apart = tiers.tiers.iter().filter(named_apart).count();
    tell(apart, ["tier has", "tiers have"], "facets of other names, which are left out");
    let above = tiers.tiers.iter().filter(|tier| tier.angle == 90.0).count();
    let girdles = ["tier of girdle facets is", "tiers of girdle facets are"];
    tell(above, girdles, "cut at +90°, for which the format has -90°");
    let nameless = tiers.tiers.iter().filter(|tier| tier.facets.is_empty()).count();
    tell(nameless, ["tier has", "tiers have"], "no facets and will be read without a name");
    let odd = tiers.remarks.keys().filter(|key| !is_key(key)).count();
    tell(odd, ["remark has a key", "remarks have keys"], "that XML cannot hold");
}

fn is_key(key: &str) -> bool {
    let begins = key.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    let taken = ["title", "author", "header2", "footer1", "footer2", "refractive_index", "xmlns"];
    begins
        && key.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.'))
        && !taken.contains(&key)
}

impl Form {
    /// Returns the scale and shift by which a stone reaches 1 across, and as far below z = 0 as above.
    fn of(outlines: &[FacetOutline]) -> Self {
        let corners = || outlines.iter().flat_map(|(_, corners)| corners);
        let reach = corners().map(|corner| corner.truncate().abs().max_element()).fold(0.0, f64::max);
        let (low, high) = span(corners().map(|corner| corner.z));
        let middle = (low + high) / 2.0;
        let scale = if reach > 0.0 && (reach - 1.0).abs() > IN_FORM { 1.0 / reach } else { 1.0 };
        let middle = if middle.is_finite() && middle.abs() > IN_FORM { middle } else { 0.0 };
        Self { scale, middle }
    }

    fn depth(&self, plane: &Plane) -> f64 {
        (plane.offset - plane.normal.z * self.middle) * self.scale
    }

    fn corner(&self, corner: DVec3) -> DVec3 {
        (corner - DVec3::Z * self.middle) * self.scale
    }
}

fn put_tiers(tiers: &Tiers, page: &mut Page, lost: &mut Vec<String>) {
    let outlines = cutters::outlines(tiers);
    let mut form = Form::of(&outlines);
    let all = tiers.tiers.iter().map(|tier| (tier, tier.facets.first().map_or(0.0, |facet| facet.index)));
    if all.into_iter().any(|(tier, index)| form.depth(&tiers.plane(tier, index)) < 0.0) {
        // Around the origin, where the stone lay before, no distance is below 0.
        form.middle = 0.0;
        lost.push(
            "the stone is not centred in height as the format requires, because a facet would then pass the origin"
                .to_owned(),
        );
    }
    let mut outlines = outlines.into_iter();
    for tier in &tiers.tiers {
        let uncut = |facet: &Indexed| (tiers.plane(tier, facet.index), Vec::new());
        let facets: Vec<FacetOutline> = if tier.is_cut {
            outlines.by_ref().take(tier.facets.len()).collect()
        } else {
            tier.facets.iter().map(uncut).collect()
        };
        put_tier(tiers, tier, &facets, &form, page);
    }
}

fn put_tier(tiers: &Tiers, tier: &Tier, facets: &[FacetOutline], form: &Form, page: &mut Page) {
    let angle = if tier.angle.is_sign_negative() || is_culet(tiers, tier) {
        180.0 - tier.angle.abs()
    } else {
        tier.angle
    };
    let depth = form.depth(&tiers.plane(tier, 0.0));
    let name = page.attribute("name", tier.name());
    let instructions = page.attribute("instructions", &tier.instruction());
    let visible = tier.is_cut;
    page.line(
        1,
        &format!(
            r#"<tier angle="{angle}" depth="{depth}"{name}{instructions} visible="{visible}" guide="false">"#
        ),
    );
    // Polished facets have no attribute, as in Gem Cut Studio's files, unless the instructions would be read
    // otherwise.
    let is_plain = tier.frosting == 0.0
        && !matches!(FinishNote::of(&tier.instruction()), FinishNote::Frosting(said) if said > 0.0);
    let frosting = if is_plain { String::new() } else { format!(r#" frosting="{}""#, tier.frosting) };
    facets.iter().for_each(|facet| put_facet(facet, form, &frosting, page));
    page.line(1, "</tier>");
}

fn is_culet(tiers: &Tiers, tier: &Tier) -> bool {
    tier.angle == 0.0 && tiers.plane(tier, 0.0).normal.z < 0.0
}

fn clean(number: f64) -> f64 {
    if number.abs() <= ROUNDING { 0.0 } else { number }
}

fn put_facet((plane, corners): &FacetOutline, form: &Form, frosting: &str, page: &mut Page) {
    let [x, y, z] = plane.normal.to_array().map(clean);
    let azimuth = y.atan2(x).to_degrees();
    let index = if z > 0.0 { 90.0 + azimuth } else { 270.0 - azimuth }.rem_euclid(360.0);
    page.line(2, &format!(r#"<facet nx="{x}" ny="{y}" nz="{z}" index_angle="{index}"{frosting}>"#));
    for corner in corners {
        let [x, y, z] = form.corner(*corner).to_array().map(clean);
        page.line(3, &format!(r#"<vertex x="{x}" y="{y}" z="{z}"/>"#));
    }
    page.line(2, "</facet>");
}

fn remark<'a>(tiers: &'a Tiers, key: &str) -> Option<&'a str> {
    tiers.remarks.get(key).map(String::as_str)
}

fn put_render(tiers: &Tiers, index: f64, page: &mut Page) {
    let mut render = String::new();
    for (key, usual) in RENDER {
        if let Some(text) = remark(tiers, key).or(usual) {
            render += &page.attribute(key, text);
        }
        if key == RENDER[0].0 {
            render += &format!(" refractive_index=\"{index}\"");
        }
    }
    page.line(1, &format!("<render{render}>"));
    let colour = remark(tiers, COLOUR.0).unwrap_or(COLOUR.1);
    let parts = ["r", "g", "b"].iter().zip(colour.split_whitespace());
    let colour: String = parts.map(|(key, part)| page.attribute(key, part)).collect();
    page.line(2, &format!("<color{colour}/>"));
    page.line(1, "</render>");
}

fn put_info(tiers: &Tiers, page: &mut Page) {
    let line = |lines: &[String], place: usize| lines.get(place).cloned().unwrap_or_default();
    let rest = |lines: &[String], from: usize| lines.get(from..).unwrap_or_default().join("\n");
    let said = [
        ("title", line(&tiers.headers, 0)),
        ("author", line(&tiers.headers, 1)),
        ("date", remark(tiers, "date").unwrap_or_default().to_owned()),
        ("header2", rest(&tiers.headers, 2)),
        ("footer1", line(&tiers.footers, 0)),
        ("footer2", rest(&tiers.footers, 1)),
    ];
    // The first three attributes are written even if they are empty, as Gem Cut Studio does.
    let kept = said.iter().enumerate().filter(|(place, (_, text))| *place < 3 || !text.is_empty());
    let mut info: String = kept.map(|(_, (key, text))| page.attribute(key, text)).collect();
    let render = |key: &str| key == COLOUR.0 || RENDER.iter().any(|(known, _)| *known == key);
    for (key, text) in tiers.remarks.iter().filter(|(key, _)| is_key(key) && *key != "date" && !render(key)) {
        info += &page.attribute(key, text);
    }
    page.line(1, &format!("<info{info}/>"));
}
