//! Writes OpenEXR: the values of every pixel in floating point, with a channel for each part of the light.

use brillianteer_base::Watch;
use brillianteer_files::{WriteError, write};
use brillianteer_picture::{Layer, paint};
use brillianteer_scene::Film;
use exr::block::writer::{ChunksWriter, ParallelBlocksCompressor};
use exr::block::{BlockIndex, UncompressedBlock};
use exr::error::{Error, UnitResult};
use exr::math::{RoundingMode, Vec2};
use exr::meta::BlockDescription;
use exr::meta::attribute::{
    AttributeValue, ChannelDescription, Chromaticities, LevelMode, SampleType, TileDescription,
};
use exr::meta::header::Header;
use exr::prelude::{Compression, LineOrder, Text};
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use smallvec::smallvec;
use std::path::Path;

/// The side of the file's tiles, in pixels. Rows are held until they make a row of tiles.
pub(super) const TILE: usize = 64;

/// The most threads that compress tiles. Each holds a tile of all channels and its compressed copy, so that memory does
/// not grow with the number of cores; the painter that fills the tiles keeps no more than this many threads busy.
const COMPRESSING: usize = 8;

/// Starts the threads that compress tiles.
fn compressing_threads() -> Result<ThreadPool, ThreadPoolBuildError> {
    let threads = rayon::current_num_threads().min(COMPRESSING);
    ThreadPoolBuilder::new().num_threads(threads).thread_name(|k| format!("compressing {k}")).build()
}

/// Paints a layer and writes its channels, as 32-bit numbers that are linear in energy.
///
/// # Errors
/// Fails where the file system refuses, or `watch` asks to stop.
pub fn write_exr(
    path: &Path,
    layer: &Layer,
    film: &Film,
    description: &str,
    watch: Watch,
) -> Result<(), WriteError> {
    let size = (film.size[0] as usize, film.size[1] as usize);
    ExrImage { size, channels: &layer.channels, description, more: None, chromaticities: None }.write(
        path,
        |file| {
            paint(layer, film, watch, |rows| -> Result<(), WriteError> {
                (rows.first..rows.first + rows.count)
                    .try_for_each(|y| file.push(|channel, x| rows.row(y, channel)[x] as f32))
            })
        },
    )
}

/// The header of an image of one layer, `light`.
pub(super) struct ExrImage<'a> {
    /// The number of pixels across and down.
    pub size: (usize, usize),
    /// The names of the channels.
    pub channels: &'a [String],
    /// A description of the image's content.
    pub description: &'a str,
    /// Another text, with its own keyword.
    pub more: Option<(&'a str, &'a str)>,
    /// The primaries and the white of its colours.
    pub chromaticities: Option<Chromaticities>,
}

/// An OpenEXR file that takes its rows one after the other.
pub(super) struct ExrFile<'a> {
    path: &'a Path,
    size: (usize, usize),
    /// The place of each channel of the file, which has them sorted by name, among those that are pushed.
    order: Vec<usize>,
    /// The rows that do not make a row of tiles yet: row by row, within a row channel by channel.
    pending: Vec<f32>,
    rows: usize,
    blocks: usize,
    /// Writes the block of a number.
    write: &'a mut dyn FnMut(usize, UncompressedBlock) -> UnitResult,
}

impl ExrImage<'_> {
    /// Writes the image, whole or not at all; `fill` pushes its rows from top to bottom.
    ///
    /// # Errors
    /// Fails where the file system refuses, when the image has no pixels or other rows than it says, and the errors
    /// of `fill`.
    pub fn write(
        &self,
        path: &Path,
        fill: impl FnOnce(&mut ExrFile) -> Result<(), WriteError>,
    ) -> Result<(), WriteError> {
        if self.size.0 * self.size.1 * self.channels.len() == 0 {
            return Err(failed(path, Error::Invalid("an image without pixels".into())));
        }
        let mut order: Vec<usize> = (0..self.channels.len()).collect();
        order.sort_unstable_by_key(|&k| Text::from(self.channels[k].as_str()));
        write(path, |file| {
            let mut filled = Ok(());
            let written = exr::block::write(file, smallvec![self.header(&order)], true, |meta, chunks| {
                let fill = |write: &mut dyn FnMut(usize, UncompressedBlock) -> UnitResult| {
                    let size = self.size;
                    filled =
                        fill(&mut ExrFile { path, size, order, pending: vec![], rows: 0, blocks: 0, write });
                    if filled.is_ok() { Ok(()) } else { Err(Error::Aborted) }
                };
                let threads =
                    ParallelBlocksCompressor::new_with_thread_pool(&meta, chunks, compressing_threads);
                if let Some(mut threads) = threads {
                    return fill(&mut |number, block| threads.add_block_to_compression_queue(number, block));
                }
                let mut alone = chunks.sequential_blocks_compressor(&meta);
                fill(&mut |number, block| alone.compress_block(number, block))
            });
            filled.and(written.map_err(|e| failed(path, e)))
        })
    }

    fn header(&self, order: &[usize]) -> Header {
        let named = |&k: &usize| ChannelDescription::named(self.channels[k].as_str(), SampleType::F32);
        let mut header = Header::new("light".into(), self.size, order.iter().map(named).collect());
        let attributes = &mut header.own_attributes;
        attributes.comments = Text::new_or_none(self.description);
        attributes.software_name = Text::new_or_none("Brillianteer");
        let more = self.more.and_then(|(name, text)| {
            Some((Text::new_or_none(name)?, AttributeValue::Text(Text::new_or_none(text)?)))
        });
        attributes.other.extend(more);
        header.shared_attributes.chromaticities = self.chromaticities;
        let tiles = TileDescription {
            tile_size: Vec2(TILE, TILE),
            level_mode: LevelMode::Singular,
            rounding_mode: RoundingMode::Down,
        };
        // In any other order the threads' race would decide where in the file a tile lies.
        header.with_encoding(Compression::RLE, BlockDescription::Tiles(tiles), LineOrder::Increasing)
    }
}

impl ExrFile<'_> {
    /// Adds a row: `value` gives the number of each channel in each column.
    ///
    /// # Errors
    /// Fails where the file system refuses, or the image has all its rows already.
    pub fn push(&mut self, value: impl Fn(usize, usize) -> f32) -> Result<(), WriteError> {
        let (width, height) = self.size;
        self.rows += 1;
        if self.rows > height {
            return Err(failed(self.path, Error::Invalid("more rows than the image has".into())));
        }
        for &channel in &self.order {
            self.pending.extend((0..width).map(|x| value(channel, x)));
        }
        if self.rows.is_multiple_of(TILE) || self.rows == height {
            self.write_tiles().map_err(|e| failed(self.path, e))?;
            self.pending.clear();
        }
        Ok(())
    }

    /// Writes the pending rows as a row of tiles.
    fn write_tiles(&mut self) -> UnitResult {
        let (width, lines) = (self.size.0, self.pending.len() / self.size.0);
        let count = lines / self.order.len();
        for left in (0..width).step_by(TILE) {
            let across = TILE.min(width - left);
            let mut data = vec![0; size_of::<f32>() * across * lines];
            let values = self.pending.chunks_exact(width).flat_map(|line| &line[left..left + across]);
            let bytes = data.as_chunks_mut().0.iter_mut().zip(values);
            bytes.for_each(|(bytes, value)| *bytes = value.to_ne_bytes());
            let index = BlockIndex {
                layer: 0,
                pixel_position: Vec2(left, self.rows - count),
                pixel_size: Vec2(across, count),
                level: Vec2(0, 0),
            };
            (self.write)(self.blocks, UncompressedBlock { index, data })?;
            self.blocks += 1;
        }
        Ok(())
    }
}

fn failed(path: &Path, error: Error) -> WriteError {
    match error {
        Error::Io(e) => WriteError::io(path, e),
        other => WriteError::io(path, std::io::Error::other(other)),
    }
}
