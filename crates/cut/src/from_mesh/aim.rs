//! Finds which way is up as a person would: by the file's own axes where a facet is square to them, by a girdle, by symmetry
//! about the axis, by a crown that is flatter than the pavilion, and by the size of the table.

use super::cues::{Cues, Slack};
use super::error::FromMeshError;
use super::even::{self, FacetParts, Match};
use super::up::Up;
use brillianteer_math::{Plane, Polytope, Pose, eigen, grouped, outer};
use glam::{DMat3, DQuat, DVec3};
use std::cmp::Ordering;

/// The table is a facet whose normal is at least this near to a direction given as up (cosine, 5 degrees).
const NEAR_UP: f64 = 0.996_194_698;

/// The largest facet that is near to a direction given as up is the table if all others have less than this part of its area.
const LESSER: f64 = 0.5;

/// Directions that differ by less than this (length of the difference of unit vectors) are the same.
const ONE: f64 = 1e-3;

/// A table whose normal is at least this near to an axis of the file (length of the difference of unit vectors, 1.5
/// degrees) was laid along that axis, but not to the last digit, as in scans. The axis itself shows almost as much of
/// a girdle as the table's normal does, and must not be taken in its place.
const PUT_ALONG: f64 = 0.026;

/// The number of largest facets that are tried as the table.
const MOST_TABLES: usize = 120;

/// The least number of parallel edges that make a direction worth trying, such as the edges between the facets of a girdle.
const LEAST_PARALLEL: usize = 4;

/// The number of facets whose edges are searched for parallels.
const MOST_EDGES: usize = 1_500;

/// The number of directions that are examined closely. It is limited because symmetry takes long to find.
const MOST_CLOSE: usize = 24;

/// The most facets of a solid whose symmetry is tested. The test compares all facets with all, for each direction
/// that is examined closely.
const MOST_COMPARED: usize = 400;

/// The weight of each cue, chosen on real cutters' designs, in their own frames and turned.
mod weight {
    /// A girdle all around the outline.
    pub const GIRDLE: f64 = 2.0;
    /// Symmetry of all facets. Where only a part of their area is symmetric, the weight is multiplied by the cube of that
    /// part.
    pub const EVEN: f64 = 0.8;
    /// A table; one smaller than `MEANT` scores less.
    pub const TABLE: f64 = 0.3;
    /// A table as large as the outline, in addition to the score of any table.
    pub const TABLE_AREA: f64 = 0.4;
    /// A base: a facet at the bottom as large as the outline.
    pub const BASE: f64 = 0.1;
    /// A stone that is all pavilion, without a crown.
    pub const FLAT: f64 = 0.5;
    /// A stone that is taller than wide, as one that lies on its side. It counts against the direction, unless rotations of
    /// three or more turns carry the facets onto one another, which they do about no other axis of a stone.
    pub const TALL: f64 = 0.6;
    /// A drop that is all upper part, as if it hung from there.
    pub const DROP: f64 = 0.25;
    /// The direction is an axis of the file and fits the shape.
    pub const OWN_AXIS: f64 = 0.4;
    /// The direction is the axis that is up by the custom of the file's format. The other axis that is often up
    /// scores half.
    pub const CUSTOM: f64 = 0.5;
}

/// A table of this part of the outline's area, or a larger one, is certainly intended.
const MEANT: f64 = 0.01;

/// A facet of this part of the outline's area is a base.
const WHOLE: f64 = 0.97;

/// The heights, in widths, below which a stone is certainly not tall, and above which it certainly is. Stones are 0.3 to 0.85
/// widths deep; one that lies on its side is as many times taller as it is less deep than wide.
const TALL: [f64; 2] = [0.8, 1.25];

/// An axis of the file without a facet square to it fits the shape if the girdle takes more than this part of the outline,
/// or symmetry more than this part of the facets' area.
const FITS: f64 = 0.8;

/// A direction whose shape scores lower than the best by less than this leaves a doubt, unless it lies within
/// [`PUT_ALONG`] of the best. So does one whose shape scores lower by more, where the file's axes make up for that.
const DOUBTFUL: f64 = 0.15;

/// The same for a direction that the file's axes make less likely as well.
const LESS_DOUBTFUL: f64 = 0.05;

/// The least difference between the scores of the file's axes by which they make a direction less likely.
const LESS_LIKELY: f64 = 0.2;

/// Cues that differ by less than this, or by less than so many noises per width, are equal.
const ALIKE: f64 = 1e-3;
const ALIKE_NOISES: f64 = 4.0;

/// Another direction that may be up as well.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Doubt {
    /// The direction in the surface's frame, a unit vector.
    pub other: DVec3,
}

/// The axis that is up, and the facet that is the table.
pub(super) struct Aim {
    /// The axis, a unit vector.
    pub axis: DVec3,
    /// The table's place among the facets, if there is a table.
    pub table: Option<usize>,
    /// Another direction that may be up; `None` where there is no doubt.
    pub doubt: Option<Doubt>,
}

/// Finds the axis, unless it is given. `parts` are the facets of the solid, in the same order, about its middle; `noise` is
/// the distance by which corners of the surface lie off the solid.
pub(super) fn aim(solid: &Polytope, parts: &FacetParts, up: Up, noise: f64) -> Result<Aim, FromMeshError> {
    let custom = match up {
        Up::Found => DVec3::Z,
        Up::FoundBy(custom) => custom,
        Up::Given(given) => return toward(solid, given, noise).ok_or(FromMeshError::Up(given)),
        Up::Known(up) => return Ok(known(solid, up)),
        Up::Posed(pose) => return Ok(known(solid, pose.turn.inverse() * DVec3::Z)),
    };
    let slack = Slack::of_noise(noise);
    let cues = directions(solid).into_iter().filter_map(|up| Cues::of(solid, up, slack));
    let mut seen: Vec<Seen> = cues.filter_map(|cues| Seen::of(cues, custom)).collect();
    let best_first = |a: &Seen, b: &Seen| b.score().total_cmp(&a.score());
    seen.sort_by(best_first);
    seen.truncate(MOST_CLOSE);
    seen.iter_mut().for_each(|seen| seen.look_closely(parts));
    seen.sort_by(best_first);
    let Some(best) = seen.first() else { return Ok(Aim { axis: custom, table: None, doubt: None }) };
    let doubt = seen.iter().skip(1).find(|other| other.may_be(best));
    let Cues { up, table, .. } = best.cues;
    Ok(Aim {
        axis: slack.normal(solid, up).unwrap_or(up),
        table,
        doubt: doubt.map(|other| Doubt { other: other.cues.up }),
    })
}

/// A direction with its scores.
struct Seen {
    cues: Cues,
    /// The score of the shape.
    shape: f64,
    /// The score of the file's axes.
    own: f64,
    custom: DVec3,
}

impl Seen {
    fn of(cues: Cues, custom: DVec3) -> Option<Self> {
        let mut seen = Self { cues, shape: shape(&cues), own: 0.0, custom };
        seen.own = own(&cues, 0.0, custom);
        seen.shape.is_finite().then_some(seen)
    }

    fn score(&self) -> f64 {
        self.shape + self.own
    }

    /// Returns whether this direction may be up as well as the best.
    fn may_be(&self, best: &Self) -> bool {
        let is_less_likely = self.own < best.own - LESS_LIKELY;
        let least = best.shape - if is_less_likely { LESS_DOUBTFUL } else { DOUBTFUL };
        let is_near = self.shape > least || self.score() > best.score() - DOUBTFUL;
        let apart = (self.cues.up - best.cues.up).length();
        is_near && apart >= PUT_ALONG && !is_alike(&self.cues, &best.cues)
    }

    /// Adds the scores of symmetry, which takes longer to compute, and of height.
    fn look_closely(&mut self, parts: &FacetParts) {
        let Evenness { even, many } = evenness(parts, self.cues.up);
        self.shape += weight::EVEN * even.powi(3) - weight::TALL * tall(&self.cues) * (1.0 - many.powi(3));
        self.own = own(&self.cues, even, self.custom);
    }
}

/// Returns the axis where up is given: the normal of the table near to the given direction, or else that direction. `None`
/// where it is zero or not finite.
fn toward(solid: &Polytope, given: DVec3, noise: f64) -> Option<Aim> {
    let unit = Plane::new(given, 0.0).normalized()?.normal;
    let slack = Slack::of_noise(noise);
    let normal = |f: usize| solid.facets()[f].plane.normal;
    let near: Vec<usize> = (0..solid.facets().len()).filter(|&f| normal(f).dot(unit) >= NEAR_UP).collect();
    let largest = near.iter().copied().max_by(|&a, &b| compare(solid, a, b));
    let area = |f: usize| solid.facet_area(&solid.facets()[f]);
    let is_less =
        |f: usize, table: usize| slack.is_square(normal(f), normal(table)) || area(f) < LESSER * area(table);
    // Several of about one size are a crown without a table, which a tilt toward one of them would lay askew.
    let table = largest.filter(|&table| near.iter().all(|&f| is_less(f, table)));
    let about = table.map_or(unit, normal);
    let axis = slack.normal(solid, about).unwrap_or(unit);
    Some(Aim { axis, table: Cues::of(solid, about, slack).and_then(|cues| cues.table), doubt: None })
}

/// Returns the axis where up is known exactly. A facet square to the axis is the table.
fn known(solid: &Polytope, axis: DVec3) -> Aim {
    Aim { axis, table: Cues::of(solid, axis, Slack::LEAST).and_then(|cues| cues.table), doubt: None }
}

/// Compares facets by area; of equals the earlier counts as the larger.
fn compare(solid: &Polytope, a: usize, b: usize) -> Ordering {
    let size = |f: usize| solid.facet_area(&solid.facets()[f]);
    size(a).total_cmp(&size(b)).then(b.cmp(&a))
}

/// Returns whether two directions show the same stone, as those of a cube do.
fn is_alike(a: &Cues, b: &Cues) -> bool {
    let within = ALIKE + ALIKE_NOISES * a.noise.max(b.noise);
    let near = |x: f64, y: f64| (x - y).abs() < within;
    near(a.girdle, b.girdle)
        && near(a.table_area, b.table_area)
        && near(a.culet_area, b.culet_area)
        && near(a.crown, b.crown)
        && near(a.height, b.height)
        && near(a.length, b.length)
}

/// Returns the score of the shape for a direction, without symmetry and height, which symmetry excuses.
fn shape(cues: &Cues) -> f64 {
    let worth = |area: f64| weight::TABLE * (area / MEANT).min(1.0) + weight::TABLE_AREA * area.min(1.0);
    let (table, flat) = match (cues.table_area > WHOLE, cues.culet_area > WHOLE) {
        (true, false) => (-weight::BASE, 0.5),
        (false, true) => (weight::BASE, 0.5),
        // A prism stands on one of its ends.
        (true, true) => (weight::TABLE, 0.5),
        // A drop hangs from its tip, which is the longer part.
        (false, false) if cues.is_drop() => (0.0, weight::DROP / weight::FLAT * cues.crown),
        (false, false) => (worth(cues.table_area) - worth(cues.culet_area), 1.0 - cues.crown),
    };
    weight::GIRDLE * cues.girdle.min(1.0) + table + weight::FLAT * flat
}

/// Returns 0 for a stone that is not tall, 1 for one that certainly is.
fn tall(cues: &Cues) -> f64 {
    ((cues.height - TALL[0]) / (TALL[1] - TALL[0])).clamp(0.0, 1.0)
}

/// Returns the score of the file's own axes; `even` is the part of the facets' area that is symmetric.
fn own(cues: &Cues, even: f64, custom: DVec3) -> f64 {
    let near = if cues.table_area > 0.0 { PUT_ALONG } else { ONE };
    let is = |axis: DVec3| (cues.up - axis).length() < near;
    let fits = cues.table_area > 0.0 || cues.culet_area > 0.0 || cues.girdle > FITS || even > FITS;
    let along = fits && axes().into_iter().any(is);
    let second = if custom == DVec3::Y { DVec3::Z } else { DVec3::Y };
    let usual = if is(custom) {
        1.0
    } else if is(second) {
        0.5
    } else {
        0.0
    };
    weight::CUSTOM * usual + if along { weight::OWN_AXIS } else { 0.0 }
}

/// Returns the axes of the file, each in both directions.
fn axes() -> [DVec3; 6] {
    [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z]
}

/// Returns the axis of the file along which a stone with this direction up was put; `None` where it lies along none.
pub(super) fn put_along(up: DVec3) -> Option<DVec3> {
    axes().into_iter().find(|axis| axis.distance(up) < PUT_ALONG)
}

/// Returns all directions that may be up, each once: normals of facets, directions that many edges are parallel to,
/// principal axes and axes of the file, and the opposites of all of these.
pub fn directions(solid: &Polytope) -> Vec<DVec3> {
    let mut places: Vec<usize> = (0..solid.facets().len()).collect();
    places.sort_by(|&a, &b| compare(solid, b, a));
    let normals = places.iter().take(MOST_TABLES).map(|&f| solid.facets()[f].plane.normal);
    let mut found: Vec<DVec3> = vec![];
    for axis in normals.chain(parallels(solid)).chain(principal(solid)).chain(axes()) {
        for direction in [axis, -axis] {
            if found.iter().all(|other| (*other - direction).length() >= ONE) {
                found.push(direction);
            }
        }
    }
    found
}

/// Returns directions that many edges are parallel to.
fn parallels(solid: &Polytope) -> Vec<DVec3> {
    let vertices = solid.vertices();
    let size = vertices.iter().map(|v| v.length()).fold(0.0, f64::max);
    let mut lines: Vec<DVec3> = vec![];
    for (place, facet) in solid.facets().iter().enumerate().take(MOST_EDGES) {
        for (k, &other) in facet.neighbours.iter().enumerate().filter(|(_, other)| **other as usize > place) {
            let [a, b] = [k, (k + 1) % facet.outline.len()].map(|at| vertices[facet.outline[at] as usize]);
            // The line in which two planes meet gives the direction more exactly than the edge's two ends, where these are
            // near to one another.
            let line = facet.plane.normal.cross(solid.facets()[other as usize].plane.normal);
            let Some(line) = line.try_normalize().filter(|_| a.distance(b) > 1e-4 * size) else { continue };
            lines.push(line);
        }
    }
    let mut groups = grouped(lines, |of, line| of.cross(*line).length() < ONE);
    groups.sort_by_key(|group| std::cmp::Reverse(group.len()));
    groups.retain(|group| group.len() >= LEAST_PARALLEL);
    groups.iter().take(12).map(|group| group[0]).collect()
}

/// Returns the principal axes of the surface.
fn principal(solid: &Polytope) -> Vec<DVec3> {
    let middle = even::centroid(solid);
    let mut spread = DMat3::ZERO;
    for facet in solid.facets() {
        let area = solid.facet_area(facet);
        let centre = solid.corners(facet).sum::<DVec3>() / facet.outline.len() as f64 - middle;
        spread += outer(centre, centre) * area;
    }
    eigen(spread).1.to_vec()
}

/// The largest parts of the area that turns about an axis carry onto other facets.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Evenness {
    /// The part that some turn carries.
    pub even: f64,
    /// The part that some turn by a third of a full one or less carries.
    pub many: f64,
}

/// The numbers of turns that are tried.
const FOLDS: [u32; 10] = [2, 3, 4, 5, 6, 7, 8, 9, 10, 12];

/// Returns the largest parts of the area that turns about an axis carry onto other facets.
pub(super) fn evenness(parts: &FacetParts, axis: DVec3) -> Evenness {
    let areas = &parts.areas;
    if areas.len() > MOST_COMPARED {
        return Evenness::default();
    }
    // Facets of the girdle are compared less closely, for which the axis must be upright here.
    let planes = even::upright(&parts.planes, axis).planes;
    let loose = Match::loose(&planes);
    let carried = |fold: u32| {
        let turn = DQuat::from_rotation_z(std::f64::consts::TAU / f64::from(fold));
        let met = (0..planes.len()).filter(|&i| loose.find(&planes[i].placed(&Pose::turned(turn))).is_some());
        met.map(|i| areas[i]).sum::<f64>() / areas.iter().sum::<f64>()
    };
    let parts = FOLDS.map(|fold| (fold, carried(fold)));
    let most =
        |least: u32| parts.iter().filter(|part| part.0 >= least).map(|part| part.1).fold(0.0, f64::max);
    Evenness { even: most(2), many: most(3) }
}
