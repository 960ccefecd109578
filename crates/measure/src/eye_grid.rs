//! The face at the resolution of an eye: cells as large as the eye resolves, each with the mean brightness of the
//! exact beams in it.
//!
//! The mean over a square is a blur that can be computed exactly for polygons, without samples: each polygon is
//! clipped to the cells that it meets.

use super::interval::Interval;
use brillianteer_base::{Stopped, Watch, go_on};
use brillianteer_math::{Affine, area, clip};
use brillianteer_trace::beam::{Beam, Beams};
use glam::{DMat2, DVec2, IVec2};

/// The least side of a cell, girdle radii, which bounds the number of cells. In stones of more than 72 mm, cells are
/// larger than the eye resolves.
const LEAST_SIDE: f64 = 0.002;

/// A cell that holds less than this part of its own area of the face counts as empty: rounding can leave a corner in it.
const EMPTY: f64 = 1e-9;

/// The number of polygons that are clipped between two looks at whether to stop: some milliseconds.
const LEAVES: usize = 4096;

/// The brightness that an eye sees in one cell.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct EyeCell {
    /// The part of the silhouette's area that lies in the cell.
    pub area: f64,
    /// The mean of the resolved brightness over that part.
    pub light: f64,
    /// The mean of the light that is still inside, over that part: the mean brightness is at most `light + rest`.
    pub rest: f64,
}

impl EyeCell {
    /// Returns the interval in which the mean brightness lies.
    pub fn brightness(&self) -> Interval {
        Interval::from(self.light, self.rest)
    }
}

/// Square cells over the face, with a corner at the image's origin, row by row.
#[derive(Debug, Clone)]
pub(super) struct EyeGrid {
    /// The side of a cell, girdle radii.
    pub side: f64,
    /// The place of the first cell, counted in cells from the origin.
    first: IVec2,
    columns: usize,
    /// The cells; their `light` and `rest` are means once the grid is full.
    pub cells: Vec<EyeCell>,
}

impl EyeGrid {
    /// Averages the brightness of beams over cells of this side, girdle radii. `bright` is the brightness through each beam.
    /// Fails where `watch` asks to stop.
    pub fn of(beams: &Beams, bright: &[f64], side: f64, watch: Watch) -> Result<Self, Stopped> {
        let copies = beams.symmetry.copies();
        let mut grid = Self::over(beams, &copies, side.max(LEAST_SIDE));
        let mut clipper = Clipper::default();
        let mut corners = vec![];
        for (number, id) in beams.leaves().enumerate() {
            if number % LEAVES == 0 {
                go_on(watch, f64::from(id) / beams.len() as f64)?;
            }
            let beam = beams.get(id);
            for copy in &copies {
                copy_outline(beam.outline, copy, &mut corners);
                clipper.spread(&corners, grid.side, |place, part| {
                    let area = area(part);
                    grid.add(place, [area, area * bright[id as usize], area * beam.onward]);
                });
            }
        }
        let least = EMPTY * grid.side * grid.side;
        for cell in &mut grid.cells {
            *cell = if cell.area > least {
                EyeCell {
                    area: cell.area / beams.silhouette_area,
                    light: cell.light / cell.area,
                    rest: cell.rest / cell.area,
                }
            } else {
                EyeCell::default()
            };
        }
        Ok(grid)
    }

    /// Hands out the face in parts, each of one facet and in one cell, with its cell. Fails where `watch` asks to stop.
    pub fn parts_of_face(
        &self,
        beams: &Beams,
        watch: Watch,
        mut each: impl FnMut(&EyeCell, &[DVec2]),
    ) -> Result<(), Stopped> {
        let (copies, mut clipper, mut corners) = (beams.symmetry.copies(), Clipper::default(), vec![]);
        for beam in beams.iter().filter(Beam::is_surface) {
            go_on(watch, 1.0)?;
            for copy in &copies {
                copy_outline(beam.outline, copy, &mut corners);
                clipper.spread(&corners, self.side, |place, part| {
                    if let Some(cell) = self.index(place).and_then(|k| self.cells.get(k)) {
                        each(cell, part);
                    }
                });
            }
        }
        Ok(())
    }

    /// Makes empty cells over all outlines.
    fn over(beams: &Beams, copies: &[DMat2], side: f64) -> Self {
        let surface = beams.iter().filter(|beam| beam.is_surface());
        let corners = surface.flat_map(|beam| beam.outline.iter().copied());
        let (mut low, mut high) = (DVec2::ZERO, DVec2::ZERO);
        for corner in corners.flat_map(|p| copies.iter().map(move |copy| *copy * p)) {
            (low, high) = (low.min(corner), high.max(corner));
        }
        let [first, last] = [low, high].map(|p| (p / side).floor().as_ivec2());
        // Rounding may carry a corner on a border across it.
        let (first, last) = (first - IVec2::ONE, last + IVec2::ONE);
        let size = (last - first + IVec2::ONE).as_u64vec2();
        let cells = vec![EyeCell::default(); (size.x * size.y) as usize];
        Self { side, first, columns: size.x as usize, cells }
    }

    fn add(&mut self, place: IVec2, [area, light, rest]: [f64; 3]) {
        if let Some(cell) = self.index(place).and_then(|k| self.cells.get_mut(k)) {
            cell.area += area;
            cell.light += light;
            cell.rest += rest;
        }
    }

    fn index(&self, place: IVec2) -> Option<usize> {
        let from = place - self.first;
        let is_in = from.min_element() >= 0 && (from.x as usize) < self.columns;
        is_in.then(|| from.y as usize * self.columns + from.x as usize)
    }

    /// Returns the place of a cell, counted in cells from the origin.
    fn place(&self, index: usize) -> IVec2 {
        self.first + IVec2::new((index % self.columns) as i32, (index / self.columns) as i32)
    }

    /// Returns the cell at the same place of another grid with cells of the same side; an empty one beyond its border.
    pub fn same_place(&self, index: usize, other: &Self) -> EyeCell {
        other.index(self.place(index)).and_then(|k| other.cells.get(k)).copied().unwrap_or_default()
    }

    /// Returns the interval of the mean brightness of the face.
    pub fn mean(&self) -> Interval {
        let sum =
            |pick: fn(&EyeCell) -> f64| self.cells.iter().map(|cell| cell.area * pick(cell)).sum::<f64>();
        Interval::from(sum(|cell| cell.light), sum(|cell| cell.rest))
    }

    /// Returns Σ a^(3/2) over the patches of these cells, where a is the area of a patch as a part of the
    /// silhouette's. Cells that share a side belong to one patch.
    ///
    /// √a is the diameter of a patch as a part of the face's, each that of a circle of the same area. So for all cells the sum is the mean
    /// diameter of the patches, weighted by area. Two patches that join never have a smaller sum, so it grows with the cells.
    pub fn sizes(&self, is_in: impl Fn(usize) -> bool) -> f64 {
        let mut waits: Vec<bool> =
            (0..self.cells.len()).map(|k| self.cells[k].area > 0.0 && is_in(k)).collect();
        let (mut sum, mut open) = (0.0, vec![]);
        for start in 0..waits.len() {
            if !std::mem::take(&mut waits[start]) {
                continue;
            }
            open.push(start);
            let mut area = 0.0;
            while let Some(cell) = open.pop() {
                area += self.cells[cell].area;
                for step in [IVec2::X, IVec2::Y, IVec2::NEG_X, IVec2::NEG_Y] {
                    let next = self.index(self.place(cell) + step).filter(|&k| k < waits.len());
                    open.extend(next.filter(|&k| std::mem::take(&mut waits[k])));
                }
            }
            sum += area.powf(1.5);
        }
        sum
    }

    /// Returns the mean diameter of the patches that are brighter or darker than the mean of the face, weighted by
    /// area, as a part of the face's diameter. Cells that may be on either side of the mean are left out for the one
    /// bound and counted as both for the other.
    pub fn patch_size(&self) -> Interval {
        let mean = self.mean();
        let brightness = |k: usize| self.cells[k].brightness();
        let certain =
            self.sizes(|k| brightness(k).least > mean.most) + self.sizes(|k| brightness(k).most < mean.least);
        let possible = self.sizes(|k| brightness(k).most >= mean.least)
            + self.sizes(|k| brightness(k).least <= mean.most);
        // The sum of both kinds of patches is never larger than the face.
        Interval { least: certain.min(1.0), most: possible.min(1.0) }
    }
}

/// Writes an outline of one copy of a symmetry's domain, counterclockwise, in place of the old corners.
fn copy_outline(outline: &[DVec2], copy: &DMat2, corners: &mut Vec<DVec2>) {
    corners.clear();
    corners.extend(outline.iter().map(|&p| *copy * p));
    if copy.determinant() < 0.0 {
        corners.reverse();
    }
}

/// Clips polygons to cells, in memory that is used again.
#[derive(Default)]
struct Clipper {
    row: Vec<DVec2>,
    cell: Vec<DVec2>,
    half: Vec<DVec2>,
}

impl Clipper {
    /// Hands out the part of a polygon in each cell of a grid; it may be empty.
    fn spread(&mut self, corners: &[DVec2], side: f64, mut each: impl FnMut(IVec2, &[DVec2])) {
        let (low, high) = cells_of(corners, side);
        if low == high {
            return each(low, corners);
        }
        for y in low.y..=high.y {
            let [from, to] = [y, y + 1].map(|y| f64::from(y) * side);
            clip(corners, Affine::new(-from, DVec2::Y), &mut self.half);
            clip(&self.half, Affine::new(to, DVec2::NEG_Y), &mut self.row);
            if self.row.is_empty() {
                continue;
            }
            let (left, right) = cells_of(&self.row, side);
            for x in left.x..=right.x {
                let [from, to] = [x, x + 1].map(|x| f64::from(x) * side);
                clip(&self.row, Affine::new(-from, DVec2::X), &mut self.half);
                clip(&self.half, Affine::new(to, DVec2::NEG_X), &mut self.cell);
                each(IVec2::new(x, y), &self.cell);
            }
        }
    }
}

/// Returns the least and the greatest place of the cells that a polygon's box meets.
fn cells_of(corners: &[DVec2], side: f64) -> (IVec2, IVec2) {
    let mut range = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for &corner in corners {
        range = (range.0.min(corner), range.1.max(corner));
    }
    ((range.0 / side).floor().as_ivec2(), (range.1 / side).floor().as_ivec2())
}

/// Returns the standard deviation of a brightness over the face, divided by its mean. The parts of the face have an
/// area, a resolved brightness, and light that is still inside.
///
/// The unresolved brightness of a part lies between 0 and the light r that is still inside. So the mean b is at most
/// b + Σ a r, and the deviation differs from that of the resolved light by at most √(Σ a r²), by the triangle
/// inequality.
pub(super) fn rms_contrast(parts: impl Iterator<Item = EyeCell>) -> Interval {
    let [mut mean, mut square, mut rest, mut rest_square] = [0.0; 4];
    for EyeCell { area, light: b, rest: r } in parts {
        mean += area * b;
        square += area * b * b;
        rest += area * r;
        rest_square += area * r * r;
    }
    let (deviation, error) = ((square - mean * mean).max(0.0).sqrt(), rest_square.sqrt());
    let least = ((deviation - error) / (mean + rest)).max(0.0);
    let most = if mean > 0.0 { (deviation + error) / mean } else { f64::INFINITY };
    Interval { least: if least.is_nan() { 0.0 } else { least }, most }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a grid whose cells have these areas and brightnesses, with three columns.
    fn grid(light: [f64; 9]) -> EyeGrid {
        let cells = light.map(|light| EyeCell { area: 1.0 / 9.0, light, rest: 0.0 }).to_vec();
        EyeGrid { side: 0.1, first: IVec2::ZERO, columns: 3, cells }
    }

    #[test]
    fn a_polygon_is_spread_over_cells_without_loss() {
        let corners =
            [(-0.31, -0.22), (0.44, -0.4), (0.61, 0.37), (-0.1, 0.5)].map(|(x, y)| DVec2::new(x, y));
        for side in [0.05, 0.21, 3.0] {
            let (mut sum, mut middle) = (0.0, DVec2::ZERO);
            Clipper::default().spread(&corners, side, |place, part| {
                let area = area(part);
                sum += area;
                middle += area * (place.as_dvec2() + 0.5) * side;
                assert!((-1e-15..=side * side * (1.0 + 1e-12)).contains(&area));
            });
            assert!((sum - area(&corners)).abs() < 1e-14, "{sum}");
            let middle = middle / sum;
            assert!(middle.distance(brillianteer_math::centroid(&corners)) < side, "{middle}");
        }
    }

    #[test]
    fn patches_are_cells_that_share_a_side() {
        let [o, x] = [0.0, 1.0];
        let ninth = |n: f64| (n / 9.0_f64).powf(1.5);
        for (light, expected) in [
            ([x, x, x, o, o, o, o, o, o], ninth(3.0) + ninth(6.0)),
            ([x, o, x, o, x, o, x, o, x], 9.0 * ninth(1.0)),
            ([x, x, x, x, o, x, x, x, x], ninth(8.0) + ninth(1.0)),
        ] {
            let found = grid(light).patch_size();
            assert!((found.least - expected).abs() < 1e-12 && found.error() < 1e-12, "{found:?}");
        }
        // Light that is not known widens the interval to both sides.
        let mut unsure = grid([x, x, x, o, o, o, o, o, o]);
        unsure.cells[4].rest = 1.0;
        let found = unsure.patch_size();
        assert!(found.least < ninth(3.0) + ninth(6.0) && found.most > ninth(3.0) + ninth(6.0), "{found:?}");
    }

    #[test]
    fn contrast_is_that_of_the_parts() {
        let even = rms_contrast(grid([0.5; 9]).cells.into_iter());
        assert!(even.most < 1e-7, "{even:?}");
        let halves = [0.0, 1.0].map(|light| EyeCell { area: 0.5, light, rest: 0.0 });
        assert_eq!(rms_contrast(halves.into_iter()), Interval { least: 1.0, most: 1.0 });
        assert_eq!(rms_contrast([].into_iter()), Interval { least: 0.0, most: f64::INFINITY });
    }
}
