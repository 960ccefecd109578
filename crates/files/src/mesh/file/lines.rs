//! Hands text to a crate's parser line by line, so that errors can name the line in which they arose.

use std::cell::Cell;
use std::io::{BufRead, Read};
use std::rc::Rc;

/// The longest line that is handed on, in bytes: a face of tens of thousands of corners.
const LONGEST: usize = 1 << 20;

/// A reader of lines, each of which `change` may change or drop.
pub(super) struct Lines<'a, F> {
    rest: &'a [u8],
    current: Vec<u8>,
    used: usize,
    line: Rc<Cell<usize>>,
    change: F,
}

impl<'a, F: FnMut(&[u8], &mut Vec<u8>)> Lines<'a, F> {
    /// Makes the reader. `line` is set to the number, from 1, of the line that was handed on last.
    pub fn new(text: &'a [u8], line: Rc<Cell<usize>>, change: F) -> Self {
        line.set(0);
        Self { rest: text, current: vec![], used: 0, line, change }
    }

    fn next_line(&mut self) {
        while self.used == self.current.len() && !self.rest.is_empty() {
            let end = self.rest.iter().position(|b| *b == b'\n').map_or(self.rest.len(), |at| at + 1);
            let (line, rest) = self.rest.split_at(end);
            (self.rest, self.used) = (rest, 0);
            self.line.set(self.line.get() + 1);
            self.current.clear();
            (self.change)(&line[..line.len().min(LONGEST)], &mut self.current);
        }
    }
}

impl<F: FnMut(&[u8], &mut Vec<u8>)> Read for Lines<'_, F> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let count = self.fill_buf()?.read(buffer)?;
        self.consume(count);
        Ok(count)
    }
}

impl<F: FnMut(&[u8], &mut Vec<u8>)> BufRead for Lines<'_, F> {
    fn fill_buf(&mut self) -> std::io::Result<&[u8]> {
        self.next_line();
        Ok(&self.current[self.used..])
    }

    fn consume(&mut self, count: usize) {
        self.used += count;
    }
}
