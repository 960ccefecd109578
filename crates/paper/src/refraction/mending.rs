//! Mends tiled maps that were antialiased. On a border of two tiles, a mixture of codes is the code of a wrong place;
//! the neighbours on both sides show the right one.

use super::tiles;
use glam::DVec2;

/// The distance of two places whose codes differ by one step, as a part of the background's side.
const STEP: f64 = 16.0 / 255.0 / 255.0;

/// Places of neighbours nearer to one another than this lie on one surface: three quarters of a tile.
const NEAR: f64 = 12.0 / 255.0;

/// The part of the way between its neighbours, besides three steps, by which an intact place is off their middle at most.
const BENT: f64 = 0.08;

/// The number of damaged pixels for each intact border from which on a picture counts as antialiased. In such a
/// picture nearly every border is damaged; in a map of many small facets up to a tenth seem to be.
const DAMAGED: f64 = 0.25;

/// The greatest distance, in codes, of a mixture of two places from the straight line between their codes.
const OFF: f64 = 6.0;

/// The directions to neighbours; the opposite ones follow.
const AROUND: [(isize, isize); 4] = [(1, 0), (0, 1), (1, 1), (1, -1)];

/// The number of pixels that were mended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct MendedPixels {
    /// Pixels on borders of tiles, which lie between their neighbours again.
    pub borders: usize,
    /// Pixels on edges of the picture's surfaces, which took the place of the nearer neighbour.
    pub edges: usize,
}

/// The conclusion from two pixels about one between them.
struct Between {
    /// The distance between their places.
    way: f64,
    /// The place that the one between should have.
    middle: DVec2,
    /// True where it has this place.
    is_intact: bool,
}

/// The codes and places of a picture.
struct Picture<'a> {
    codes: &'a [Option<[u8; 3]>],
    places: &'a [DVec2],
    width: usize,
}

/// Mends an antialiased map in tiles; leaves a map alone that is not antialiased.
pub(super) fn mend(codes: &mut [Option<[u8; 3]>], places: &mut [DVec2], width: usize) -> MendedPixels {
    let picture = Picture { codes, places, width };
    let borders: Vec<(usize, DVec2)> =
        (0..codes.len()).filter_map(|k| Some((k, picture.on_border(k)?))).collect();
    if borders.is_empty() || (borders.len() as f64) < DAMAGED * picture.crossings() as f64 {
        return MendedPixels::default();
    }
    let is_mended: std::collections::HashSet<usize> = borders.iter().map(|(k, _)| *k).collect();
    let edges: Vec<(usize, DVec2)> = (0..codes.len())
        .filter(|k| !is_mended.contains(k))
        .filter_map(|k| Some((k, picture.on_edge(k)?)))
        .collect();
    let count = MendedPixels { borders: borders.len(), edges: edges.len() };
    for (k, at) in borders.into_iter().chain(edges) {
        places[k] = at;
        codes[k] = Some(tiles::code(at));
    }
    count
}

fn distance(a: DVec2, b: DVec2) -> f64 {
    (a - b).abs().max_element()
}

impl Picture<'_> {
    /// Returns the pixel that lies `count` steps of (x, y) beside another, if it shows the template.
    fn beside(&self, k: usize, (x, y): (isize, isize), count: isize) -> Option<usize> {
        let column = (k % self.width).checked_add_signed(x * count).filter(|&x| x < self.width)?;
        let row = (k / self.width).checked_add_signed(y * count)?;
        let found = row * self.width + column;
        self.codes.get(found).copied().flatten().map(|_| found)
    }

    /// Returns the right place of a pixel that mixes the tiles of its neighbours; `None` for an intact one. The
    /// nearest neighbours on both sides that allow a conclusion decide, because the surface bends more toward farther
    /// ones.
    fn on_border(&self, k: usize) -> Option<DVec2> {
        for (back, on) in [(1, 1), (1, 2), (2, 1), (2, 2)] {
            let told = AROUND.into_iter().filter_map(|direction| {
                let (a, b) = (self.beside(k, direction, -back)?, self.beside(k, direction, on)?);
                self.between(k, a, b, back as f64 / (back + on) as f64)
            });
            let told: Vec<Between> = told.collect();
            if told.iter().any(|between| between.is_intact) {
                return None;
            }
            if let Some(nearest) = told.into_iter().min_by(|a, b| a.way.total_cmp(&b.way)) {
                return Some(nearest.middle);
            }
        }
        None
    }

    /// Returns the conclusion from two pixels on both sides about the one between; `None` where they are of one tile,
    /// or not of one surface, or where the pixel's code is no mixture of theirs.
    fn between(&self, k: usize, a: usize, b: usize, part: f64) -> Option<Between> {
        let (own, first, last) = (self.codes[k]?, self.codes[a]?, self.codes[b]?);
        let way = distance(self.places[a], self.places[b]);
        let is_mixture = (0..3).all(|c| {
            let (low, high) = (first[c].min(last[c]), first[c].max(last[c]));
            (low.saturating_sub(2)..=high.saturating_add(2)).contains(&own[c])
        });
        let middle = self.places[a].lerp(self.places[b], part);
        let is_intact = distance(self.places[k], middle) <= 3.0 * STEP + BENT * way;
        let tells = first[2] != last[2] && way <= NEAR && (is_mixture || is_intact);
        tells.then_some(Between { way, middle, is_intact })
    }

    /// Returns the place of the nearer of two neighbours whose codes an isolated pixel mixes; `None` for other
    /// pixels.
    fn on_edge(&self, k: usize) -> Option<DVec2> {
        let own = self.codes[k]?.map(f64::from);
        let is_near =
            |at: Option<usize>| at.is_some_and(|at| distance(self.places[at], self.places[k]) < NEAR);
        if AROUND.iter().any(|&d| is_near(self.beside(k, d, 1)) || is_near(self.beside(k, d, -1))) {
            return None;
        }
        AROUND.into_iter().find_map(|direction| {
            let (a, b) = (self.beside(k, direction, -1)?, self.beside(k, direction, 1)?);
            let (first, last) = (self.codes[a]?.map(f64::from), self.codes[b]?.map(f64::from));
            let ways = [0, 1, 2].map(|c| last[c] - first[c]);
            let along = (0..3).max_by(|&i, &j| ways[i].abs().total_cmp(&ways[j].abs()))?;
            let part = (own[along] - first[along]) / ways[along];
            let is_mixed = (0..3).all(|c| (first[c] + part * ways[c] - own[c]).abs() <= OFF);
            let nearer = if part < 0.5 { a } else { b };
            (is_mixed && part > 0.02 && part < 0.98).then_some(self.places[nearer])
        })
    }

    /// Returns how many pixels lie beside one of another tile and a near place: the borders of tiles.
    fn crossings(&self) -> usize {
        let crosses = |k: usize, other: Option<usize>| {
            other.is_some_and(|other| {
                let tile = |k: usize| self.codes[k].map(|code| code[2]);
                tile(k) != tile(other) && distance(self.places[k], self.places[other]) < NEAR
            })
        };
        let seen = (0..self.codes.len()).filter(|&k| self.codes[k].is_some());
        seen.filter(|&k| crosses(k, self.beside(k, (1, 0), 1)) || crosses(k, self.beside(k, (0, 1), 1)))
            .count()
    }
}
