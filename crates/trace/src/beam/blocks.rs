//! A list whose items never move in memory as it grows.

use std::ops::{Index, IndexMut};

/// The number of items in a block.
const BLOCK: usize = 1024;

/// A list in blocks of one size, the last of which may not be full. It grows without copying the items that it has.
#[derive(Debug, Clone)]
pub(super) struct Blocks<T> {
    blocks: Vec<Vec<T>>,
}

impl<T> Default for Blocks<T> {
    fn default() -> Self {
        Self { blocks: vec![] }
    }
}

impl<T: Copy> Blocks<T> {
    pub fn len(&self) -> usize {
        self.blocks.last().map_or(0, |last| (self.blocks.len() - 1) * BLOCK + last.len())
    }

    pub fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.blocks.iter().flatten()
    }

    /// Adds items to the end. The items before them stay at their places in memory.
    pub fn extend(&mut self, mut items: &[T]) {
        while !items.is_empty() {
            let room = self.blocks.len() * BLOCK - self.len();
            if room == 0 {
                self.blocks.push(Vec::with_capacity(BLOCK));
            } else if let Some(last) = self.blocks.last_mut() {
                let (now, later) = items.split_at(room.min(items.len()));
                last.extend_from_slice(now);
                items = later;
            }
        }
    }

    /// Drops all items except those at these places, which must ascend.
    pub fn keep(&mut self, places: &[u32]) {
        for (to, &from) in (0..).zip(places) {
            self[to] = self[from];
        }
        self.blocks.truncate(places.len().div_ceil(BLOCK));
        let before_last = self.blocks.len().saturating_sub(1) * BLOCK;
        if let Some(last) = self.blocks.last_mut() {
            last.truncate(places.len() - before_last);
        }
    }
}

impl<T> Index<u32> for Blocks<T> {
    type Output = T;

    fn index(&self, index: u32) -> &T {
        &self.blocks[index as usize / BLOCK][index as usize % BLOCK]
    }
}

impl<T> IndexMut<u32> for Blocks<T> {
    fn index_mut(&mut self, index: u32) -> &mut T {
        &mut self.blocks[index as usize / BLOCK][index as usize % BLOCK]
    }
}
