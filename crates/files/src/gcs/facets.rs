//! Reads the tiers of a `.gcs` file and their facets.

use super::read::Reader;
use crate::cutters::{self, Gear, TierPiece};
use crate::numbers::Token;
use brillianteer_base::Fault;
use brillianteer_cut::{FROSTINGS, FinishNote, MAX_PLANES, Tier, USUAL_FROSTING, is_printable};
use brillianteer_math::{Plane, rounded};
use glam::DVec3;
use roxmltree::Node;

/// The most that a tier's depth and angle may differ from its corners and normals without a warning, in the stone's unit and
/// in degrees.
const TOLD_APART: f64 = 1e-6;

/// A normal whose length differs from 1 by this much or more is badly written.
const UNIT_LENGTH: f64 = 1e-6;

/// A facet that faces along the axis by less than this (cosine) does not cross it.
const ALONG_THE_AXIS: f64 = 1e-9;

/// A facet of the file.
struct Raw<'d> {
    at: Node<'d, 'd>,
    /// The facet's plane; its distance may be below 0.
    plane: Plane,
    name: String,
    instructions: String,
    is_cut: bool,
    frosting: f64,
}

/// The facets of one tier; a tier without facets has its statements as a [`Tier`] instead.
type RawTier<'d> = (Vec<Raw<'d>>, Option<Tier>);

impl<'d> Reader<'d> {
    /// Reads all tiers, with indices of this gear.
    pub fn tiers(&mut self, root: Node<'d, 'd>, gear: Gear) -> Result<Vec<Tier>, Fault> {
        let facets = root.descendants().filter(|node| node.has_tag_name("facet")).count();
        if facets > MAX_PLANES {
            let message = format!("there are more than {MAX_PLANES} facets, the most that a design can have");
            return Err(self.fault(root, message));
        }
        let mut raw: Vec<RawTier<'d>> = Vec::new();
        for node in root.children().filter(Node::is_element) {
            match node.tag_name().name() {
                "tier" => {
                    let facets = self.tier(node)?;
                    let empty = facets.is_empty().then(|| self.empty_tier(node)).flatten();
                    raw.push((facets, empty));
                }
                "index" | "render" | "info" => {}
                other => self.warn(node, || format!("<{other:.40}> is not known here and is not read")),
            }
        }
        let middle = self.middle(&raw)?;
        let mut tiers = Vec::new();
        for (facets, empty) in raw {
            let pieces: Vec<TierPiece> =
                facets.into_iter().map(|facet| self.piece(facet, middle, gear)).collect();
            let mut gathered = cutters::gathered(pieces);
            cutters::named_once(&mut gathered);
            tiers.extend(gathered.into_iter().chain(empty));
        }
        Ok(tiers)
    }

    /// Returns the height at which the origin belongs: 0, or half way through the stone where 0 lies outside it.
    fn middle(&mut self, raw: &[RawTier<'d>]) -> Result<f64, Fault> {
        let cut = || raw.iter().flat_map(|(facets, _)| facets).filter(|facet| facet.is_cut);
        let Some(outer) = cut().find(|facet| facet.plane.offset < 0.0) else { return Ok(0.0) };
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for Plane { normal, offset } in cut().map(|facet| facet.plane) {
            match normal.z {
                z if z > ALONG_THE_AXIS => high = high.min(offset / z),
                z if z < -ALONG_THE_AXIS => low = low.max(offset / z),
                _ if offset < 0.0 => high = f64::NEG_INFINITY,
                _ => {}
            }
        }
        let middle = (low + high) / 2.0;
        if !(low <= high && middle.is_finite()) {
            let depth = outer.plane.offset;
            let message = format!("depth: {depth:.6} must be 0 or more; the facets must lie around the axis");
            return Err(self.fault(outer.at, message));
        }
        self.warn(outer.at, || {
            format!("the stone lies beside the origin; it is moved by {:.6} in z", -middle)
        });
        Ok(middle)
    }

    fn piece(&mut self, raw: Raw<'d>, middle: f64, gear: Gear) -> TierPiece {
        let Raw { at, plane, name, instructions, is_cut, frosting } = raw;
        let distance = plane.offset - plane.normal.z * middle;
        // The distance of a facet that is cut can be below 0 by rounding alone.
        if distance < 0.0 && !is_cut {
            self.warn(at, || format!("depth: {distance} of a facet that is not cut is read as 0"));
        }
        let mut setting = gear.setting(plane.normal, distance.max(0.0));
        setting.angle = girdle_below(setting.angle);
        TierPiece { tier: 0, setting, name, instructions, is_cut, frosting }
    }

    /// Reads a tier without facets, which is kept for its statements.
    fn empty_tier(&mut self, node: Node<'_, '_>) -> Option<Tier> {
        let (polar, depth) = (self.number(node, "angle")?, self.number(node, "depth")?);
        let setting = Gear { teeth: 96, offset: 0.0 }.setting(slope_normal(polar, 0.0), depth.max(0.0));
        self.warn(node, || "this tier has no facets".to_owned());
        let instructions = self.text(node, "instructions").unwrap_or_default();
        let is_cut = self.is(node, "visible", true);
        let frosting = self.frosting(node, &instructions);
        Some(Tier {
            angle: girdle_below(setting.angle),
            distance: setting.distance,
            instructions,
            meet: None,
            is_cut,
            frosting,
            facets: vec![],
        })
    }

    /// Reads the facets of a tier. The first carries the tier's instructions, and each the tier's name, since any of them
    /// may begin a tier of its own.
    fn tier(&mut self, node: Node<'d, 'd>) -> Result<Vec<Raw<'d>>, Fault> {
        let (polar, depth) = (self.number(node, "angle"), self.number(node, "depth"));
        let name = self.text(node, "name").unwrap_or_default();
        let mut instructions = self.text(node, "instructions").unwrap_or_default();
        let is_cut = self.is(node, "visible", true);
        if self.is(node, "guide", false) {
            self.warn(node, || "guide: the mark of a guide tier is not kept".to_owned());
        }
        let of_tier = self.frosting(node, &instructions);
        let mut apart = Apart::default();
        let mut facets: Vec<Raw<'d>> = Vec::new();
        for at in node.children().filter(|child| child.has_tag_name("facet")) {
            let plane = self.plane(at, polar, depth)?;
            apart.look(at, polar, &plane);
            // A very long name is not copied to every facet.
            let name = if facets.is_empty() || is_printable(&name) { name.clone() } else { String::new() };
            let frosting = self.stated_frosting(at).unwrap_or(of_tier);
            let instructions = std::mem::take(&mut instructions);
            facets.push(Raw { at, plane, name, instructions, is_cut, frosting });
        }
        if let Some(text) = apart.attribute(&name) {
            self.warn(node, || text);
        }
        Ok(facets)
    }

    /// Returns the frosting of facets that state none of their own: the tier's attribute, else that of its
    /// instructions.
    fn frosting(&mut self, tier: Node<'_, '_>, instructions: &str) -> f64 {
        if let Some(stated) = self.stated_frosting(tier) {
            return stated;
        }
        match FinishNote::of(instructions) {
            FinishNote::Frosting(frosting) => frosting,
            FinishNote::Unsaid => 0.0,
            FinishNote::Unclear => {
                let is_stated = |facet: Node<'_, '_>| facet.has_attribute("frosting");
                if !tier.children().any(is_stated) {
                    self.warn(tier, || {
                        format!(
                            "instructions: '{instructions:.60}' frosts facets, but not plainly those of this tier; they are \
                             taken as polished"
                        )
                    });
                }
                0.0
            }
        }
    }

    /// Returns the frosting that a tier or a facet states by its own attribute; `None` where it has none.
    fn stated_frosting(&mut self, node: Node<'_, '_>) -> Option<f64> {
        let text = node.attribute("frosting")?.trim().to_ascii_lowercase();
        match text.as_str() {
            "" | "false" | "none" => Some(0.0),
            "true" => Some(USUAL_FROSTING),
            _ => {
                let number = Token::of(&text).number().filter(|number| FROSTINGS.contains(number));
                if number.is_none() {
                    self.warn(node, || {
                        format!(
                            "frosting: '{text:.40}' is not a number from 0 to 1; {USUAL_FROSTING} is assumed"
                        )
                    });
                }
                number.or(Some(USUAL_FROSTING))
            }
        }
    }

    /// Returns the plane of a facet: with its own normal, else that of angle and index; at its tier's depth, else that of
    /// its corners.
    fn plane(&mut self, facet: Node<'_, '_>, polar: Option<f64>, depth: Option<f64>) -> Result<Plane, Fault> {
        let own = ["nx", "ny", "nz"].map(|key| self.number(facet, key));
        let own = own.iter().copied().collect::<Option<Vec<f64>>>().map(|n| DVec3::from_slice(&n));
        let normal = match own.filter(|n| (n.length() - 1.0).abs() < UNIT_LENGTH) {
            Some(normal) => normal,
            None => self.stated_normal(facet, polar)?,
        };
        let depth = match depth.or_else(|| Some(normal.dot(corners(facet).next()?))) {
            Some(depth) => depth,
            None => return Err(self.fault(facet, "depth: the tier has none and the facet has no corners")),
        };
        // The normal has length 1, so only the depth can be at fault.
        Plane::new(normal, depth).normalized().ok_or_else(|| self.fault(facet, "depth: this is not a length"))
    }

    fn stated_normal(&mut self, facet: Node<'_, '_>, polar: Option<f64>) -> Result<DVec3, Fault> {
        let Some((polar, index)) = polar.zip(self.number(facet, "index_angle")) else {
            let message =
                "nx, ny, nz: a normal of length 1 is expected, or the tier's angle and an index_angle";
            return Err(self.fault(facet, message));
        };
        self.warn(facet, || {
            "nx, ny, nz: this is not a normal of length 1; angle and index_angle are used instead".to_owned()
        });
        let azimuth = if polar < 90.0 - TOLD_APART { index - 90.0 } else { 270.0 - index };
        Ok(slope_normal(polar, azimuth))
    }
}

fn slope_normal(polar: f64, azimuth: f64) -> DVec3 {
    Plane::from_slope(polar.to_radians(), azimuth.to_radians(), 1.0).normal
}

/// Returns an angle, but -90 for 90, since the format counts girdle facets as the pavilion's.
fn girdle_below(angle: f64) -> f64 {
    if angle == 90.0 { -90.0 } else { angle }
}

/// Returns the corners of a facet whose coordinates are finite numbers.
fn corners<'a>(facet: Node<'a, 'a>) -> impl Iterator<Item = DVec3> + use<'a> {
    let vertices = facet.children().filter(|child| child.has_tag_name("vertex"));
    vertices.filter_map(|vertex| {
        let [x, y, z] = ["x", "y", "z"]
            .map(|key| Token::of(vertex.attribute(key)?.trim()).number().filter(|v| v.is_finite()));
        Some(DVec3::new(x?, y?, z?))
    })
}

/// The largest differences between a tier's numbers and those of its facets.
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

    fn attribute(&self, name: &str) -> Option<String> {
        let mut differences = Vec::new();
        if self.corners > TOLD_APART {
            differences.push(format!(
                "its corners differ from its depth by up to {}; the depth is used",
                rounded(self.corners, 6)
            ));
        }
        if self.angle > TOLD_APART {
            differences.push(format!(
                "its normals differ from its angle by up to {}°; the normals are used",
                rounded(self.angle, 6)
            ));
        }
        (!differences.is_empty()).then(|| format!("tier '{name:.40}': {}", differences.join("; ")))
    }
}
