//! Writes MP4 (ISO/IEC 14496-12) with AV1 (AV1 Codec ISO Media File Format Binding 1.2).
//!
//! The encoder is rav1e, which is kept up in Rust and without its assembly needs no nasm. It takes longer to build
//! than all readers and writers of files together, so the feature `video` is no default.

use super::frames::{FrameSink, Frames};
use brillianteer_files::Sink;
use rav1e::prelude::*;
use shiguredo_mp4::boxes::{Av01Box, Av1cBox, SampleEntry, VisualSampleEntryFields};
use shiguredo_mp4::mux::{
    Mp4FileMuxer, Mp4FileMuxerOptions, Sample, TrackMetadata, estimate_maximum_moov_box_size,
};
use shiguredo_mp4::{TrackKind, Uint, Utf8String};
use std::io::{self, SeekFrom};
use std::num::NonZeroU32;

/// The coarseness of the encoder's rounding, of 255: finer than its default of 100, as borders of facets are sharp.
const QUANTIZER: usize = 60;

/// The speed of the encoder, 0 to 10: its highest, as the many borders of facets slow it down.
const SPEED: u8 = 10;

/// The most frames from one key frame to the next; a player can begin only at a key frame.
const MOST_BETWEEN: u64 = 48;

/// The time scale of the file: a frame's duration is in 1/1000 s.
const MILLISECONDS: NonZeroU32 = NonZeroU32::new(1000).unwrap();

/// The mark that begins each packet, and that files leave out (section 2.4 of the binding).
const TEMPORAL_DELIMITER: [u8; 2] = [0x12, 0];

/// A video that is being written.
pub(super) struct Mp4<'a> {
    file: &'a mut dyn Sink,
    frames: &'a Frames,
    encoder: Context<u8>,
    muxer: Mp4FileMuxer,
    /// The description of the encoding in the file, which is known after the first frame.
    entry: Option<SampleEntry>,
    /// The byte offset of the next frame in the file.
    at: u64,
}

impl<'a> Mp4<'a> {
    /// Begins a video. `description` becomes the name of its track.
    pub fn begin(file: &'a mut dyn Sink, frames: &'a Frames, description: &str) -> io::Result<Self> {
        let [width, height] = [frames.size.0, frames.size.1].map(|side| side as usize);
        let mut settings = EncoderConfig::with_speed_preset(SPEED);
        (settings.width, settings.height) = (width, height);
        settings.time_base = Rational::new(u64::from(frames.delay_ms), 1000);
        settings.quantizer = QUANTIZER;
        settings.max_key_frame_interval = MOST_BETWEEN;
        settings.color_description = Some(ColorDescription {
            color_primaries: ColorPrimaries::BT709,
            transfer_characteristics: TransferCharacteristics::SRGB,
            matrix_coefficients: MatrixCoefficients::BT709,
        });
        let encoder: Context<u8> =
            Config::new().with_encoder_config(settings).new_context().map_err(io::Error::other)?;
        let entry = entry(&encoder, frames.size)?;
        let name = Utf8String::new(&description.replace('\0', " ")).unwrap_or_default();
        let options = Mp4FileMuxerOptions {
            // The index goes before the frames, so that a page can show the video while it loads.
            reserved_moov_box_size: estimate_maximum_moov_box_size(&[frames.count as usize])
                .saturating_add(description.len()),
            video_track: TrackMetadata { name, ..TrackMetadata::default() },
            ..Mp4FileMuxerOptions::default()
        };
        let muxer = Mp4FileMuxer::with_options(options).map_err(io::Error::other)?;
        file.write_all(muxer.initial_boxes_bytes())?;
        let at = muxer.initial_boxes_bytes().len() as u64;
        Ok(Self { file, frames, encoder, muxer, entry: Some(entry), at })
    }

    /// Writes the frames that the encoder has finished.
    fn drain(&mut self) -> io::Result<()> {
        loop {
            match self.encoder.receive_packet() {
                Ok(packet) => self.write(&packet)?,
                Err(EncoderStatus::Encoded) => {}
                Err(EncoderStatus::NeedMoreData | EncoderStatus::LimitReached) => return Ok(()),
                Err(other) => return Err(io::Error::other(other)),
            }
        }
    }

    fn write(&mut self, packet: &Packet<u8>) -> io::Result<()> {
        let data = packet.data.strip_prefix(&TEMPORAL_DELIMITER).unwrap_or(&packet.data);
        self.file.write_all(data)?;
        let sample = Sample {
            track_kind: TrackKind::Video,
            sample_entry: self.entry.take(),
            keyframe: packet.frame_type == FrameType::KEY,
            timescale: MILLISECONDS,
            duration: u32::from(self.frames.delay_ms),
            composition_time_offset: None,
            data_offset: self.at,
            data_size: data.len(),
        };
        self.at += data.len() as u64;
        self.muxer.append_sample(&sample).map_err(io::Error::other)
    }
}

impl FrameSink for Mp4<'_> {
    fn push(&mut self, rgba: &[u8]) -> io::Result<()> {
        let mut frame = self.encoder.new_frame();
        let width = self.frames.size.0 as usize;
        let planes = planes(rgba, width);
        for (plane, (values, across)) in
            frame.planes.iter_mut().zip(planes.iter().zip([width, width.div_ceil(2), width.div_ceil(2)]))
        {
            plane.copy_from_raw_u8(values, across, 1);
        }
        self.encoder.send_frame(frame).map_err(io::Error::other)?;
        self.drain()
    }

    fn finish(mut self: Box<Self>) -> io::Result<()> {
        self.encoder.flush();
        self.drain()?;
        let boxes = self.muxer.finalize().map_err(io::Error::other)?;
        for (offset, bytes) in boxes.offset_and_bytes_pairs() {
            self.file.seek(SeekFrom::Start(offset))?;
            self.file.write_all(bytes)?;
        }
        self.file.seek(SeekFrom::End(0)).map(drop)
    }
}

/// Returns the description of the encoding for the file.
fn entry(encoder: &Context<u8>, (width, height): (u32, u32)) -> io::Result<SampleEntry> {
    let header = encoder.container_sequence_header();
    let [_, profile, more, ..] = *header.as_slice() else {
        return Err(io::Error::other("the encoder describes its video in too few bytes"));
    };
    let too_large =
        |_| io::Error::other(format!("{width} x {height} pixels: a video has at most 65535 a side"));
    let visual = VisualSampleEntryFields {
        data_reference_index: VisualSampleEntryFields::DEFAULT_DATA_REFERENCE_INDEX,
        width: u16::try_from(width).map_err(too_large)?,
        height: u16::try_from(height).map_err(too_large)?,
        horizresolution: VisualSampleEntryFields::DEFAULT_HORIZRESOLUTION,
        vertresolution: VisualSampleEntryFields::DEFAULT_VERTRESOLUTION,
        frame_count: VisualSampleEntryFields::DEFAULT_FRAME_COUNT,
        compressorname: VisualSampleEntryFields::NULL_COMPRESSORNAME,
        depth: VisualSampleEntryFields::DEFAULT_DEPTH,
    };
    let av1c_box = Av1cBox {
        seq_profile: Uint::from_bits(profile),
        seq_level_idx_0: Uint::from_bits(profile),
        seq_tier_0: Uint::from_bits(more),
        high_bitdepth: Uint::from_bits(more),
        twelve_bit: Uint::from_bits(more),
        monochrome: Uint::from_bits(more),
        chroma_subsampling_x: Uint::from_bits(more),
        chroma_subsampling_y: Uint::from_bits(more),
        chroma_sample_position: Uint::from_bits(more),
        initial_presentation_delay_minus_one: None,
        config_obus: vec![],
    };
    Ok(SampleEntry::Av01(Av01Box { visual, av1c_box, unknown_boxes: vec![] }))
}

/// Returns luma, and both differences of colour at half the resolution, of pixels in rows of this width (ITU-R BT.709-6,
/// sections 3.2 to 3.4, of encoded values and in 8 bits).
fn planes(rgba: &[u8], width: usize) -> [Vec<u8>; 3] {
    let rows: Vec<&[u8]> = rgba.chunks_exact(4 * width).collect();
    let luma = rgba.chunks_exact(4).map(|pixel| rounded(16.0 + 219.0 * luma_of(colour(pixel)))).collect();
    let (mut blue, mut red) = (vec![], vec![]);
    for pair in rows.chunks(2) {
        for x in (0..width).step_by(2) {
            let block = pair.iter().flat_map(|row| row[4 * x..].chunks_exact(4).take(2.min(width - x)));
            let (sum, count) = block.fold(([0.0; 3], 0.0), |(sum, count), pixel| {
                let [r, g, b] = colour(pixel);
                ([sum[0] + r, sum[1] + g, sum[2] + b], count + 1.0)
            });
            let mean = sum.map(|part| part / count);
            blue.push(rounded(128.0 + 224.0 * (mean[2] - luma_of(mean)) / 1.8556));
            red.push(rounded(128.0 + 224.0 * (mean[0] - luma_of(mean)) / 1.5748));
        }
    }
    [luma, blue, red]
}

/// Returns the encoded red, green and blue of a pixel, 0 to 1.
fn colour(pixel: &[u8]) -> [f64; 3] {
    [pixel[0], pixel[1], pixel[2]].map(|code| f64::from(code) / 255.0)
}

fn luma_of([r, g, b]: [f64; 3]) -> f64 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

fn rounded(value: f64) -> u8 {
    value.round().clamp(0.0, 255.0) as u8
}

#[cfg(test)]
mod tests {
    use super::super::{Animation, AnimationFormat, write_animation};
    use super::*;
    use brillianteer_files::WriteError;
    use shiguredo_mp4::demux::{Input, Mp4FileDemuxer};

    #[test]
    fn greys_have_no_colour_and_colours_have_the_codes_of_the_standard() {
        let of = |[r, g, b]: [u8; 3]| planes(&[r, g, b, 255].repeat(4), 2).map(|plane| plane[0]);
        for (grey, expected) in [(0, 16), (255, 235), (128, 126)] {
            assert_eq!(of([grey; 3]), [expected, 128, 128]);
        }
        assert_eq!(of([255, 0, 0]), [63, 102, 240]);
        assert_eq!(of([0, 255, 0]), [173, 42, 26]);
        assert_eq!(of([0, 0, 255]), [32, 240, 118]);
    }

    #[test]
    fn odd_sizes_have_colours_up_to_their_borders() {
        let mut pixels = [0, 0, 255, 255].repeat(15);
        pixels[56..].copy_from_slice(&[255, 0, 0, 255]);
        let [luma, blue, red] = planes(&pixels, 5);
        assert_eq!((luma.len(), blue.len(), red.len()), (15, 6, 6));
        assert_eq!((blue[4], red[5], luma[14]), (240, 240, 63));
    }

    #[test]
    fn a_video_holds_each_frame_once_and_for_its_time() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.mp4");
        let frames = Frames { count: 7, size: (33, 18), delay_ms: 40, transparent: false, exact: vec![] };
        let frame = |k: u8| [k * 30, 200, 255 - k * 30, 255].repeat(33 * 18);
        let fill = |animation: &mut Animation| (0..7).try_for_each(|k| animation.push(&frame(k)));
        write_animation::<WriteError>((&path, AnimationFormat::Mp4), &frames, "a stone, 12°", fill).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let mut demuxer = Mp4FileDemuxer::new();
        while let Some(needed) = demuxer.required_input() {
            let from = needed.position as usize;
            let to = needed.size.map_or(bytes.len(), |size| (from + size).min(bytes.len()));
            demuxer.handle_input(Input { position: needed.position, data: &bytes[from..to] });
        }
        let mut samples = vec![];
        while let Some(sample) = demuxer.next_sample().unwrap() {
            samples.push((sample.timestamp, sample.duration, sample.keyframe));
            assert!(sample.data_size > 0 && sample.data_offset as usize + sample.data_size <= bytes.len());
        }
        let times: Vec<_> = samples.iter().map(|(at, lasts, _)| (*at, *lasts)).collect();
        assert_eq!(times, (0..7).map(|k| (40 * k, 40)).collect::<Vec<_>>());
        assert!(samples[0].2 && !samples.iter().all(|(.., is_key)| *is_key));
        let text = String::from_utf8_lossy(&bytes);
        assert!(text.contains("a stone, 12°") && text.find("moov") < text.find("mdat"));
    }
}
