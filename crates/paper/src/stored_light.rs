//! The linear light of a picture between tracing and writing: in memory, or in a temporary file where it is large.

use brillianteer_files::WriteError;
use brillianteer_picture::LightRows;
use std::borrow::Cow;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::ops::Range;

/// The most pixels that are held in memory, as light or as a developed picture: those of 2048 by 2048.
pub(super) const MOST_HELD: u64 = 1 << 22;

/// The bytes of a pixel's light.
const PIXEL: usize = size_of::<[f32; 4]>();

/// The number of bytes that are read at once.
const READ: usize = 1 << 18;

/// The light of a picture: rows are added as they are traced, and read afterwards.
///
/// The light of a large picture lies in a file without a name in the system's folder for temporary files.
pub struct StoredLight {
    size: [u32; 2],
    rows: u32,
    is_covered: bool,
    store: Store,
}

enum Store {
    Memory(Vec<[f32; 4]>),
    File(File),
}

impl StoredLight {
    /// Makes room for a picture of a size, in pixels.
    ///
    /// # Errors
    /// Fails where the file system refuses a temporary file.
    pub fn new(size: [u32; 2]) -> Result<Self, WriteError> {
        let pixels = size.map(u64::from).into_iter().product::<u64>();
        let store = if pixels > MOST_HELD {
            Store::File(tempfile::tempfile().map_err(|e| full(size, e))?)
        } else {
            Store::Memory(Vec::with_capacity(pixels as usize))
        };
        Ok(Self { size, rows: 0, is_covered: true, store })
    }

    /// Adds row `y`. Rows come from top to bottom; row 0 begins the picture anew.
    ///
    /// # Errors
    /// Fails where the file system refuses, or the row is not the next one.
    pub fn push(&mut self, y: u32, row: &[[f32; 4]]) -> Result<(), WriteError> {
        if y == 0 {
            (self.rows, self.is_covered) = (0, true);
        }
        if y != self.rows || y >= self.size[1] || row.len() != self.size[0] as usize {
            return Err(self.fault(format!("row {y} of {} pixels is not the next one", row.len())));
        }
        self.rows += 1;
        self.is_covered &= row.iter().all(|pixel| pixel[3] * 255.0 >= 254.5);
        match &mut self.store {
            Store::Memory(pixels) => {
                pixels.truncate(y as usize * row.len());
                pixels.extend_from_slice(row);
                Ok(())
            }
            Store::File(file) => {
                let start = SeekFrom::Start(u64::from(y) * size_of_val(row) as u64);
                file.seek(start).and_then(|_| file.write_all(&bytes(row))).map_err(|e| full(self.size, e))
            }
        }
    }

    /// Makes the error of a caller that adds rows in a wrong order.
    fn fault(&self, text: String) -> WriteError {
        let [width, height] = self.size;
        let picture = format!("the light of a picture of {width} by {height} pixels");
        WriteError::io(picture.as_ref(), io::Error::other(text))
    }

    /// Returns whether every pixel is fully covered, to the accuracy of eight bits.
    pub(super) fn is_covered(&self) -> bool {
        self.is_covered
    }
}

impl LightRows for StoredLight {
    type Error = WriteError;

    fn size(&self) -> [u32; 2] {
        self.size
    }

    fn rows(&mut self, rows: Range<u32>) -> Result<Cow<'_, [[f32; 4]]>, WriteError> {
        let width = self.size[0] as usize;
        let [start, end] = [rows.start, rows.end].map(|y| y as usize * width);
        if rows.end > self.rows {
            return Err(self.fault(format!("row {} is missing", self.rows)));
        }
        match &mut self.store {
            Store::Memory(pixels) => Ok(Cow::Borrowed(&pixels[start..end])),
            Store::File(file) => {
                read(file, start, end - start).map(Cow::Owned).map_err(|e| full(self.size, e))
            }
        }
    }
}

/// Reads `count` pixels of a file, from a pixel on.
fn read(file: &mut File, start: usize, count: usize) -> io::Result<Vec<[f32; 4]>> {
    file.seek(SeekFrom::Start((start * PIXEL) as u64))?;
    let mut pixels = vec![[0.0; 4]; count];
    let mut bytes = vec![0; READ];
    for part in pixels.as_flattened_mut().chunks_mut(READ / size_of::<f32>()) {
        let bytes = &mut bytes[..size_of_val(part)];
        file.read_exact(bytes)?;
        part.iter_mut().zip(bytes.as_chunks().0).for_each(|(to, from)| *to = f32::from_ne_bytes(*from));
    }
    Ok(pixels)
}

/// Returns the bytes of pixels as this machine holds them.
fn bytes(row: &[[f32; 4]]) -> Vec<u8> {
    let mut bytes = vec![0; row.len() * PIXEL];
    let numbers = bytes.as_chunks_mut().0.iter_mut().zip(row.as_flattened());
    numbers.for_each(|(bytes, number)| *bytes = number.to_ne_bytes());
    bytes
}

/// Makes the error of a temporary file that does not take or give the light of a picture.
fn full([width, height]: [u32; 2], source: io::Error) -> WriteError {
    let text = format!(
        "{source}; the light of a picture of {width} by {height} pixels waits there in a temporary file of {} MiB: make \
         room, or name another folder by TMPDIR (on Windows TMP)",
        (u64::from(width) * u64::from(height) * PIXEL as u64) >> 20
    );
    WriteError::io(&std::env::temp_dir(), io::Error::new(source.kind(), text))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(y: u32, width: u32) -> Vec<[f32; 4]> {
        (0..width).map(|x| [y as f32, x as f32 * 0.1, -1e-30, 1.0]).collect()
    }

    /// Stores a picture in which each row holds its own number.
    fn stored(size: [u32; 2]) -> StoredLight {
        let mut light = StoredLight::new(size).unwrap();
        // The first rows are traced anew, as where a graphics card fails.
        for y in (0..7).chain(0..size[1]) {
            light.push(y, &row(y, size[0])).unwrap();
        }
        light
    }

    #[test]
    fn light_reads_back_to_the_bit_from_memory_and_from_a_file() {
        for size in [[24, 13], [2049, 2049]] {
            let mut light = stored(size);
            assert_eq!(matches!(light.store, Store::File(_)), size[0] > 2048);
            for rows in [3..5, 0..1, 9..13, 12..12] {
                let expected: Vec<_> = rows.clone().flat_map(|y| row(y, size[0])).collect();
                assert_eq!(*light.rows(rows).unwrap(), expected);
            }
            assert!(light.rows(size[1]..size[1] + 1).is_err());
        }
    }

    #[test]
    fn rows_that_are_not_the_next_are_refused() {
        let mut light = StoredLight::new([3, 2]).unwrap();
        for (y, width) in [(1, 3), (0, 2), (0, 4)] {
            assert!(light.push(y, &row(y, width)).is_err(), "{y}, {width}");
        }
        assert!(stored([3, 9]).push(9, &row(9, 3)).unwrap_err().to_string().contains("row 9"));
    }

    #[test]
    fn cover_is_whole_only_where_every_pixel_is_covered() {
        let mut light = stored([5, 9]);
        assert!(light.is_covered());
        light.push(0, &[[0.0, 0.0, 0.0, 0.5]; 5]).unwrap();
        light.push(1, &row(1, 5)).unwrap();
        assert!(!light.is_covered());
    }
}
