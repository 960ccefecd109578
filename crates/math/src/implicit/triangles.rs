//! Cuts a form's surface into triangles.

use super::profile::Profile;
use super::{ImplicitSurface, Surface};
use glam::{DVec2, DVec3};
use std::collections::HashMap;
use std::f64::consts::FRAC_PI_2;

/// A point of the core's outline and the outline's normal there.
type Rim = (DVec2, DVec2);

impl ImplicitSurface {
    /// Returns closed triangles with corners on the surface, counter-clockwise seen from outside and grouped by facet.
    ///
    /// The mesh differs from the surface by no more than [`deviation`](Self::deviation). A quarter turn is cut into
    /// `fineness` steps (0 counts as 1), a plate's wave into four times as many.
    pub fn surface(&self, fineness: usize) -> Surface {
        let fineness = fineness.max(1);
        let cells = self.cells(fineness);
        let rim = self.rim(fineness, cells);
        let mut weld = Weld { field: self, places: HashMap::new(), surface: Surface::default() };
        weld.surface.names = self.facets().iter().map(|name| String::from(*name)).collect();
        let rings = self.rings(&rim, fineness);
        for pair in rings.windows(2) {
            for i in 0..rim.len() {
                let j = (i + 1) % rim.len();
                weld.quad([pair[0][i], pair[0][j], pair[1][j], pair[1][i]]);
            }
        }
        for (upside_down, ring) in [(true, rings.first()), (false, rings.last())] {
            for corners in ring.map(|ring| self.cap(ring, cells)).unwrap_or_default() {
                let [a, b, c, d] = corners;
                weld.quad(if upside_down { [d, c, b, a] } else { corners });
            }
        }
        weld.surface
    }

    /// Returns how far the triangles of [`surface`](Self::surface) are from the form at most; for a plate, along z.
    pub fn deviation(&self, fineness: usize) -> f64 {
        let fineness = fineness.max(1);
        let edge = self.body.edge;
        let round = match self.body.profile {
            Profile::Rectangle { round, .. } => round,
            Profile::Triangle(_) => 0.0,
        };
        // Chords cut off arcs in two directions: around the outline and over the edge.
        let step = FRAC_PI_2 / fineness as f64;
        let sagitta = (round + 2.0 * edge) * (1.0 - (step / 2.0).cos());
        let waves = self.wave.map_or(0.0, |wave| {
            let (cells, size) =
                (self.cells(fineness), self.body.support(DVec3::X).max(self.body.support(DVec3::Y)));
            let cell = DVec2::splat(2.0 * size) / DVec2::new(cells[0] as f64, cells[1] as f64);
            // A curve departs from its chord by m s²/8. A chord lies inside the edge's circle by the sagitta, where the
            // wave's height differs by up to the slope times the sagitta.
            let across = cell.max(DVec2::splat(edge * step));
            let slope = wave.amplitude * wave.number;
            slope * wave.number * across.length_squared() / 8.0 + slope * sagitta
        });
        sagitta + waves
    }

    /// Returns the number of parts that the sides along x and y are cut into.
    fn cells(&self, fineness: usize) -> [usize; 2] {
        let (Some(wave), Profile::Rectangle { half, .. }) = (&self.wave, self.body.profile) else {
            return [1, 1];
        };
        let parts = |half: f64| (2.0 * half * wave.number / FRAC_PI_2 * fineness as f64).ceil().max(1.0);
        [parts(half.x) as usize, parts(half.y) as usize]
    }

    /// Returns the core's outline, counter-clockwise seen from the end of the axis; corners are repeated with each of their
    /// normals.
    fn rim(&self, fineness: usize, cells: [usize; 2]) -> Vec<Rim> {
        let mut rim = vec![];
        match self.body.profile {
            Profile::Rectangle { half, round } => {
                let grid =
                    |i: [usize; 2]| DVec2::new(part(i[0], cells[0], half.x), part(i[1], cells[1], half.y));
                let [last_x, last_y] = cells;
                for quarter in 0..4 {
                    let corner = grid([[last_x, last_y], [0, last_y], [0, 0], [last_x, 0]][quarter]);
                    for step in 0..=fineness {
                        let normal = turned(quarter_turn(step, fineness), quarter);
                        rim.push((corner + normal * round, normal));
                    }
                    let normal = turned(DVec2::Y, quarter);
                    for i in 1..cells[quarter % 2] {
                        let place = [
                            [last_x - i.min(last_x), last_y],
                            [0, last_y - i.min(last_y)],
                            [i, 0],
                            [last_x, i],
                        ];
                        rim.push((grid(place[quarter]) + normal * round, normal));
                    }
                }
            }
            Profile::Triangle(t) => {
                let mirror = DVec2::new(-1.0, 1.0);
                let (down, flank) = (DVec2::NEG_Y, t.normal);
                let corners = [(t.corner, down, flank), (DVec2::new(0.0, t.apex), flank, flank * mirror)];
                for (corner, from, to) in
                    corners.into_iter().chain([(t.corner * mirror, flank * mirror, down)])
                {
                    let angle = from.angle_to(to);
                    let steps = (angle / FRAC_PI_2 * fineness as f64).ceil().max(1.0) as usize;
                    let between = |i| from.rotate(DVec2::from_angle(angle * i as f64 / steps as f64));
                    rim.push((corner, from));
                    rim.extend((1..steps).map(|i| (corner, between(i))));
                    rim.push((corner, to));
                }
            }
        }
        rim
    }

    /// Returns rings of points from the lower to the upper face; the first and the last ring run around these faces.
    fn rings(&self, rim: &[Rim], fineness: usize) -> Vec<Vec<DVec3>> {
        let latitudes = (0..=fineness).map(|i| quarter_turn(i, fineness));
        let below = latitudes.clone().rev().map(|l| (l.x, -self.body.half - self.body.edge * l.y));
        let above = latitudes.map(|l| (l.x, self.body.half + self.body.edge * l.y));
        let ring = |(cos, height): (f64, f64)| {
            let place = |&(point, normal): &Rim| self.placed(point + normal * (self.body.edge * cos), height);
            rim.iter().map(place).collect()
        };
        below.chain(above).map(ring).collect()
    }

    fn placed(&self, p: DVec2, height: f64) -> DVec3 {
        match self.body.profile {
            Profile::Rectangle { .. } => p.extend(height),
            Profile::Triangle(_) => DVec3::new(height, p.x, p.y),
        }
    }

    /// Returns the flat face within a ring, in pieces of four corners, two of which may coincide.
    fn cap(&self, ring: &[DVec3], cells: [usize; 2]) -> Vec<[DVec3; 4]> {
        match self.body.profile {
            Profile::Rectangle { half, round: 0.0 } => {
                let height = ring[0].z;
                let at = |i, j| DVec3::new(part(i, cells[0], half.x), part(j, cells[1], half.y), height);
                let cell = |i, j| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                (0..cells[0]).flat_map(|i| (0..cells[1]).map(move |j| cell(i, j))).collect()
            }
            _ => ring[1..].windows(2).map(|w| [ring[0], w[0], w[1], w[1]]).collect(),
        }
    }
}

/// Collects triangles, and makes one corner of those at the same place.
struct Weld<'a> {
    field: &'a ImplicitSurface,
    places: HashMap<[u64; 3], u32>,
    surface: Surface,
}

impl Weld<'_> {
    /// Adds triangles between corners on the body; a triangle that has shrunk to a line is left out.
    fn quad(&mut self, [a, b, c, d]: [DVec3; 4]) {
        for corners in [[a, b, c], [a, c, d]] {
            let [i, j, k] = corners.map(|p| self.corner(p));
            if i != j && j != k && k != i {
                self.surface.triangles.push([i, j, k]);
                let middle = corners.iter().sum::<DVec3>() / 3.0;
                self.surface.groups.push(self.field.own_facet(middle));
            }
        }
    }

    fn corner(&mut self, p: DVec3) -> u32 {
        let Self { field, places, surface } = self;
        // Adding 0 turns -0 into 0, so that both are one place.
        *places.entry((p + 0.0).to_array().map(f64::to_bits)).or_insert_with(|| {
            let lift = field.wave.map_or(0.0, |wave| wave.height(p));
            surface.vertices.push(p + DVec3::Z * lift);
            surface.vertices.len() as u32 - 1
        })
    }
}

/// Returns the coordinate at place `i` of `count` on the way from -half to half.
fn part(i: usize, count: usize, half: f64) -> f64 {
    if 2 * i == count { 0.0 } else { half * (2.0 * i as f64 / count as f64 - 1.0) }
}

/// Returns the cosine and sine of `i` of `count` parts of a quarter turn, exact at its ends.
fn quarter_turn(i: usize, count: usize) -> DVec2 {
    if i == count { DVec2::Y } else { DVec2::from_angle(FRAC_PI_2 * i as f64 / count as f64) }
}

fn turned(v: DVec2, quarters: usize) -> DVec2 {
    (0..quarters).fold(v, |v, _| v.perp())
}
