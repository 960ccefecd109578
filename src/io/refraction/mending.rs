//! Mends tiled maps that were antialiased. On a border of two tiles a mixture of codes is the code of a place elsewhere;
//! the neighbours on both sides show which place was meant.

use super::tiles;
use glam::DVec2;

/// A step of the tiles' coding.
const STEP: f64 = 16.0 / 255.0 / 255.0;

/// Places of neighbours nearer to one another than this lie on one surface: three quarters of a tile.
const NEAR: f64 = 12.0 / 255.0;

/// The part of the way between its neighbours, besides three steps, by which an intact place is off their middle at most.
const BENT: f64 = 0.15;

/// The part of the borders that is damaged in every antialiased picture. Below it, what looks damaged is the map's own.
const DAMAGED: f64 = 0.02;

/// How far, in codes, a mixture of two places is off the straight line between their codes at most.
const OFF: f64 = 3.0;

/// The number of pixels that were mended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Mended {
    /// Pixels on borders of tiles, which lie between their neighbours again.
    pub borders: usize,
    /// Pixels on edges of the picture's surfaces, which took the place of the nearer neighbour.
    pub edges: usize,
}

/// The codes and places of a picture.
struct Picture<'a> {
    codes: &'a [Option<[u8; 3]>],
    places: &'a [DVec2],
    width: usize,
}

/// Mends an antialiased map in tiles; leaves a map alone that is not antialiased.
pub(super) fn mend(codes: &mut [Option<[u8; 3]>], places: &mut [DVec2], width: usize) -> Mended {
    let picture = Picture { codes, places, width };
    let borders: Vec<(usize, DVec2)> =
        (0..codes.len()).filter_map(|k| Some((k, picture.on_border(k)?))).collect();
    if borders.is_empty() || (borders.len() as f64) < DAMAGED * picture.crossings() as f64 {
        return Mended::default();
    }
    let is_mended: std::collections::HashSet<usize> = borders.iter().map(|(k, _)| *k).collect();
    let edges: Vec<(usize, DVec2)> = (0..codes.len())
        .filter(|k| !is_mended.contains(k))
        .filter_map(|k| Some((k, picture.on_edge(k)?)))
        .collect();
    let count = Mended { borders: borders.len(), edges: edges.len() };
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
    /// Returns the pixel that lies `count` steps of (x, y) beside another, where something is seen.
    fn beside(&self, k: usize, (x, y): (isize, isize), count: isize) -> Option<usize> {
        let column = (k % self.width).checked_add_signed(x * count).filter(|&x| x < self.width)?;
        let row = (k / self.width).checked_add_signed(y * count)?;
        let found = row * self.width + column;
        self.codes.get(found).copied().flatten().map(|_| found)
    }

    /// Returns where a pixel should be that mixes the tiles of its neighbours; `None` for an intact one.
    fn on_border(&self, k: usize) -> Option<DVec2> {
        let own = self.codes[k]?;
        let mut best: Option<(f64, DVec2)> = None;
        for direction in [(1, 0), (0, 1), (1, 1), (1, -1)] {
            for (back, on) in [(1, 1), (1, 2), (2, 1), (2, 2)] {
                let ends = (self.beside(k, direction, -back), self.beside(k, direction, on));
                let (Some(a), Some(b)) = ends else { continue };
                let (Some(first), Some(last)) = (self.codes[a], self.codes[b]) else { continue };
                let way = distance(self.places[a], self.places[b]);
                let is_between = (0..3).all(|c| {
                    let (low, high) = (first[c].min(last[c]), first[c].max(last[c]));
                    (low.saturating_sub(2)..=high.saturating_add(2)).contains(&own[c])
                });
                if first[2] == last[2] || way > NEAR || !is_between {
                    continue;
                }
                let middle = self.places[a].lerp(self.places[b], back as f64 / (back + on) as f64);
                // Farther neighbours decide only where nearer ones do not.
                let worth = way + NEAR * (back + on) as f64;
                if distance(self.places[k], middle) <= 3.0 * STEP + BENT * way {
                    return None;
                }
                if best.is_none_or(|(least, _)| worth < least) {
                    best = Some((worth, middle));
                }
            }
        }
        best.map(|(_, middle)| middle)
    }

    /// Returns the place of the nearer of two neighbours whose codes a lonely pixel mixes; `None` for other pixels.
    fn on_edge(&self, k: usize) -> Option<DVec2> {
        let own = self.codes[k]?.map(f64::from);
        let around = [(1, 0), (0, 1), (1, 1), (1, -1)];
        let is_near =
            |at: Option<usize>| at.is_some_and(|at| distance(self.places[at], self.places[k]) < NEAR);
        if around.iter().any(|&d| is_near(self.beside(k, d, 1)) || is_near(self.beside(k, d, -1))) {
            return None;
        }
        around.into_iter().find_map(|direction| {
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
