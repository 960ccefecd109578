//! Scans of cut stones whose facets are known: a stone's facets are divided into small triangles, and noise moves every corner.
#![allow(dead_code, reason = "each test uses its part")]

use brillianteer::math::{Facet, Plane, Polytope, Surface};
use glam::{DQuat, DVec2, DVec3};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use std::collections::{BTreeSet, HashMap};

/// The radius of the girdle of a stone that is scanned, in the scan's unit, mm.
pub const RADIUS_MM: f64 = 3.25;

/// The places of the corners of a scan on the stone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Corners {
    /// Evenly spread over the facets and along the edges of the stone, so that about so many triangles lie between them.
    Meshed(u32),
    /// On the triangles of the facets, whose sides are halved until there are about so many: narrow facets have as many as wide ones.
    Halved(u32),
    /// Evenly spread directions from the middle, about so many: triangles lie across the edges.
    Radial(u32),
}

/// What a scanner makes of a stone. The same numbers give the same scan.
#[derive(Debug, Clone, Copy)]
pub struct Scan {
    pub corners: Corners,
    /// The part of the corners that is kept; the others are taken out where the noiseless surface stays the same.
    pub kept: f64,
    /// Whether triangles may become needles where corners are taken out.
    pub needles: bool,
    /// The standard deviation of the noise along x, y and z, micrometres.
    pub noise_um: DVec3,
    /// The number of times that the noise is averaged over neighbouring corners, so that it is correlated; its standard
    /// deviation stays.
    pub blurs: u32,
    /// The step to which coordinates are rounded, micrometres; 0 for none.
    pub step_um: f64,
    /// The position of the stone in the scan.
    pub turn: DQuat,
    pub seed: u64,
}

impl Scan {
    /// A scan with the same noise in all directions and no other fault.
    pub fn meshed(triangles: u32, noise_um: f64, seed: u64) -> Self {
        Self {
            corners: Corners::Meshed(triangles),
            kept: 1.0,
            needles: false,
            noise_um: DVec3::splat(noise_um),
            blurs: 0,
            step_um: 0.0,
            turn: DQuat::IDENTITY,
            seed,
        }
    }

    /// Returns the planes of the stone in the frame of the scan, mm.
    pub fn planes(&self, stone: &[Plane]) -> Vec<Plane> {
        stone.iter().map(|p| Plane::new(self.turn * p.normal, RADIUS_MM * p.offset)).collect()
    }

    /// Scans the solid between planes, in girdle radii.
    pub fn of(&self, stone: &[Plane]) -> Surface {
        let solid = Polytope::from_planes(&self.planes(stone)).unwrap();
        let mut random = Random::new(self.seed);
        let (mut surface, facets) = match self.corners {
            Corners::Meshed(triangles) => meshed(&solid, triangles),
            Corners::Halved(triangles) => halved(&solid, triangles),
            Corners::Radial(count) => (radial(&solid, count), vec![]),
        };
        if self.kept < 1.0 {
            surface = thinned(&surface, &facets, self, &mut random);
        }
        let noise = self.noise(&surface, &mut random);
        let step = 1e-3 * self.step_um;
        let rounded = |v: DVec3| if step > 0.0 { (v / step).round() * step } else { v };
        // STL holds numbers of 32 bits.
        let single = |v: DVec3| v.as_vec3().as_dvec3();
        surface.vertices.iter_mut().zip(noise).for_each(|(v, noise)| *v = single(rounded(*v + noise)));
        surface
    }

    /// Returns the noise of each corner, mm.
    fn noise(&self, surface: &Surface, random: &mut Random) -> Vec<DVec3> {
        let count = surface.vertices.len();
        let mut noise: Vec<DVec3> = (0..count).map(|_| random.normal3()).collect();
        for _ in 0..self.blurs {
            let mut sums: Vec<(DVec3, f64)> = noise.iter().map(|n| (2.0 * *n, 2.0)).collect();
            for t in &surface.triangles {
                for k in 0..3 {
                    let [a, b] = [t[k], t[(k + 1) % 3]].map(|v| v as usize);
                    sums[a] = (sums[a].0 + noise[b], sums[a].1 + 1.0);
                }
            }
            noise = sums.into_iter().map(|(sum, count)| sum / count).collect();
        }
        let square = noise.iter().map(|n| n.length_squared()).sum::<f64>() / (3 * count) as f64;
        let scale = 1e-3 * self.noise_um / square.sqrt();
        noise.into_iter().map(|n| n * scale).collect()
    }
}

/// Returns planes whose slopes and azimuths are off by Gaussian errors with these standard deviations, degrees. The table,
/// level facets and the girdle keep theirs.
pub fn flawed(planes: &[Plane], slope_deg: f64, azimuth_deg: f64, seed: u64) -> Vec<Plane> {
    let mut random = Random::new(seed);
    let flaw = |p: &Plane| {
        let across = p.normal.truncate();
        let (by_slope, by_azimuth) = (slope_deg * random.normal(), azimuth_deg * random.normal());
        if across.length() < 0.05 || p.normal.z.abs() < 0.1 {
            return *p;
        }
        let slope = across.length().atan2(p.normal.z) + by_slope.to_radians();
        let turned = Plane::from_slope(slope, across.to_angle() + by_azimuth.to_radians(), p.offset);
        // The facet is turned about the foot of its middle, which stays nearly in its place.
        let foot = p.offset * p.normal;
        Plane::new(turned.normal, turned.normal.dot(foot))
    };
    planes.iter().map(flaw).collect()
}

/// Divides a solid's facets into triangles of nearly equal sides; returns the facet of each triangle as well.
fn meshed(solid: &Polytope, triangles: u32) -> (Surface, Vec<u32>) {
    // The area of a triangle with sides of length 1 is √3/4.
    let side = (solid.surface_area() / f64::from(triangles) * 4.0 / 3.0_f64.sqrt()).sqrt();
    let mut surface = Surface::new(solid.vertices().to_vec(), vec![]);
    let (mut edges, mut facets) = (HashMap::new(), vec![]);
    for (number, facet) in (0..).zip(solid.facets()) {
        let mut outline: Vec<u32> = vec![];
        for (k, &from) in facet.outline.iter().enumerate() {
            let to = facet.outline[(k + 1) % facet.outline.len()];
            let [low, high] = [from.min(to), from.max(to)];
            let within: &mut Vec<u32> = edges.entry([low, high]).or_insert_with(|| {
                let [a, b] = [low, high].map(|v| surface.vertices[v as usize]);
                let parts = (a.distance(b) / side).round().max(1.0) as u32;
                let first = surface.vertices.len() as u32;
                surface.vertices.extend((1..parts).map(|k| a.lerp(b, f64::from(k) / f64::from(parts))));
                (first..surface.vertices.len() as u32).collect()
            });
            outline.push(from);
            if from == low { outline.extend(within.iter()) } else { outline.extend(within.iter().rev()) }
        }
        filled(&mut surface, &outline, facet.plane.normal, side);
        facets.resize(surface.triangles.len(), number);
    }
    (Surface::new(surface.vertices, surface.triangles), facets)
}

/// Divides a solid's facets into triangles, and these into four each until there are more than half as many as wanted; returns the
/// facet of each triangle as well.
fn halved(solid: &Polytope, wanted: u32) -> (Surface, Vec<u32>) {
    let mut vertices = solid.vertices().to_vec();
    let fan = |(number, facet): (u32, &Facet)| {
        let outline = facet.outline.clone();
        (1..outline.len() - 1)
            .map(move |k| ([outline[0], outline[k], outline[k + 1]], number))
            .collect::<Vec<_>>()
    };
    let mut triangles: Vec<([u32; 3], u32)> = (0..).zip(solid.facets()).flat_map(fan).collect();
    while triangles.len() * 2 <= wanted as usize {
        let mut middles = HashMap::new();
        let mut parts = vec![];
        for ([a, b, c], facet) in triangles {
            let mut middle = |a: u32, b: u32| {
                *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                    vertices.push(vertices[a as usize].midpoint(vertices[b as usize]));
                    vertices.len() as u32 - 1
                })
            };
            let (x, y, z) = (middle(a, b), middle(b, c), middle(c, a));
            parts.extend([[a, x, z], [x, b, y], [z, y, c], [x, y, z]].map(|part| (part, facet)));
        }
        triangles = parts;
    }
    let (triangles, facets) = triangles.into_iter().unzip();
    (Surface::new(vertices, triangles), facets)
}

/// Fills an outline with corners in rows and Delaunay's triangles between them.
fn filled(surface: &mut Surface, outline: &[u32], normal: DVec3, side: f64) {
    let (x, y) = normal.any_orthonormal_pair();
    // The rows lie along no axis, so that rounding does not treat whole rows alike.
    let (sin, cos) = (0.7 + 2.4 * f64::from(outline[0])).sin_cos();
    let (x, y) = (cos * x + sin * y, cos * y - sin * x);
    let flat = |v: DVec3| DVec2::new(v.dot(x), v.dot(y));
    let mut points: Vec<(u32, DVec2)> =
        outline.iter().map(|&v| (v, flat(surface.vertices[v as usize]))).collect();
    let count = points.len();
    let height = surface.vertices[outline[0] as usize].dot(normal);
    let (low, high) = points.iter().fold((DVec2::MAX, DVec2::MIN), |(l, h), p| (l.min(p.1), h.max(p.1)));
    let rise = side * 0.75_f64.sqrt();
    for row in 0..=((high.y - low.y) / rise) as u32 {
        for column in 0..=((high.x - low.x) / side) as u32 + 1 {
            let at = low
                + DVec2::new(side * (f64::from(column) + 0.5 * f64::from(row % 2)), rise * f64::from(row));
            let inside = (0..count).all(|k| {
                let (a, b) = (points[k].1, points[(k + 1) % count].1);
                (b - a).try_normalize().is_none_or(|along| along.perp_dot(at - a) > 0.5 * side)
            });
            if inside {
                points.push((surface.vertices.len() as u32, at));
                surface.vertices.push(at.x * x + at.y * y + height * normal);
            }
        }
    }
    let places = points.iter().map(|p| Point2::new(p.1.x, p.1.y)).collect();
    let borders = (0..count).map(|k| [k, (k + 1) % count]).collect();
    let found = ConstrainedDelaunayTriangulation::<Point2<f64>>::bulk_load_cdt(places, borders).unwrap();
    for face in found.inner_faces() {
        let corners = face.vertices().map(|v| v.index());
        let [a, b, c] = corners.map(|k| points[k].1);
        // Rounding leaves triangles of no height along the outline.
        if (b - a).perp_dot(c - a) > 1e-9 * side * side {
            surface.triangles.push(corners.map(|k| points[k].0));
        }
    }
}

/// Spreads corners over a solid around the origin by directions of a spiral.
fn radial(solid: &Polytope, count: u32) -> Surface {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let directions: Vec<DVec3> = (0..count)
        .map(|k| {
            let z = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(count);
            let (sin, cos) = (golden * f64::from(k)).sin_cos();
            DVec3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z)
        })
        .collect();
    let triangles = brillianteer::math::convex_hull(&directions).unwrap();
    let middle = solid.vertices().iter().sum::<DVec3>() / solid.vertices().len() as f64;
    let planes: Vec<Plane> = solid.planes().collect();
    let reach = |d: DVec3| {
        let far = planes.iter().map(|p| -p.distance(middle) / p.normal.dot(d)).filter(|far| *far > 0.0);
        far.fold(f64::INFINITY, f64::min)
    };
    let vertices = directions.iter().map(|&d| middle + reach(d) * d).collect();
    Surface::new(vertices, triangles)
}

/// Takes corners out of a surface, each together with the two triangles along an edge to a neighbour, in random order, where
/// all triangles stay on their facets.
fn thinned(surface: &Surface, facets: &[u32], scan: &Scan, random: &mut Random) -> Surface {
    let count = surface.vertices.len();
    let mut triangles: Vec<Option<([u32; 3], u32)>> =
        surface.triangles.iter().copied().zip(facets.iter().copied()).map(Some).collect();
    let mut around: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); count];
    surface.triangles.iter().enumerate().for_each(|(t, c)| {
        c.iter().for_each(|&v| {
            around[v as usize].insert(t);
        });
    });
    let mut order: Vec<(f64, u32)> = (0..count as u32).map(|v| (random.normal(), v)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut left = count;
    for (_, v) in order {
        if (left as f64) <= scan.kept * count as f64 {
            break;
        }
        if let Some(into) = collapsible(surface, &triangles, &around, v, scan.needles) {
            for t in std::mem::take(&mut around[v as usize]) {
                let Some((mut corners, facet)) = triangles[t] else { continue };
                if corners.contains(&into) {
                    corners.iter().for_each(|&c| {
                        around[c as usize].remove(&t);
                    });
                    triangles[t] = None;
                } else {
                    corners.iter_mut().filter(|c| **c == v).for_each(|c| *c = into);
                    triangles[t] = Some((corners, facet));
                    around[into as usize].insert(t);
                }
            }
            left -= 1;
        }
    }
    let mut number = HashMap::new();
    let mut vertices = vec![];
    let triangles = triangles.into_iter().flatten().map(|(corners, _)| {
        corners.map(|c| {
            *number.entry(c).or_insert_with(|| {
                vertices.push(surface.vertices[c as usize]);
                vertices.len() as u32 - 1
            })
        })
    });
    let triangles = triangles.collect();
    Surface::new(vertices, triangles)
}

/// Returns the neighbour that a corner can be moved to, so that all triangles stay on their facets and none folds.
fn collapsible(
    surface: &Surface,
    triangles: &[Option<([u32; 3], u32)>],
    around: &[BTreeSet<usize>],
    v: u32,
    needles: bool,
) -> Option<u32> {
    let at = |v: u32| surface.vertices[v as usize];
    let own: Vec<([u32; 3], u32)> = around[v as usize].iter().filter_map(|&t| triangles[t]).collect();
    let others = |of: u32| -> BTreeSet<u32> {
        around[of as usize]
            .iter()
            .filter_map(|&t| triangles[t])
            .flat_map(|(c, _)| c)
            .filter(|&c| c != of)
            .collect()
    };
    let beside = others(v);
    beside.iter().copied().find(|&into| {
        let area = |c: [u32; 3]| (at(c[1]) - at(c[0])).cross(at(c[2]) - at(c[0]));
        let moved = own.iter().filter(|(c, _)| !c.contains(&into)).all(|(c, _)| {
            let (before, after) = (area(*c), area(c.map(|c| if c == v { into } else { c })));
            after.length() > 0.0 && before.dot(after) > (1.0 - 1e-9) * before.length() * after.length() && {
                let longest = (0..3).map(|k| at(c[k]).distance(at(into))).fold(0.0, f64::max);
                needles || after.length() > 0.15 * longest * longest
            }
        });
        moved && beside.intersection(&others(into)).count() == 2
    })
}

/// Random numbers that are the same every time.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next number from 0 to 1 (SplitMix64; G. Steele, D. Lea and C. Flood, 2014).
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// The next number of a Gaussian distribution (G. Box and M. Muller, 1958).
    pub fn normal(&mut self) -> f64 {
        let (a, b) = (self.next(), self.next());
        (-2.0 * (1.0 - a).ln()).sqrt() * (std::f64::consts::TAU * b).cos()
    }

    fn normal3(&mut self) -> DVec3 {
        DVec3::new(self.normal(), self.normal(), self.normal())
    }
}
