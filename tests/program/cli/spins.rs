//! The animations that `spin` writes of a stone in a scope, with captions and curves, and in each format.

use super::desk::*;
use gif::{ColorOutput, DecodeOptions, DisposalMethod, Repeat};
use std::path::Path;

/// A rocking stone in a scope, in a picture of few pixels.
const ROCKING: &str = "spin tolkowsky --scope aset --motion rock --swing 20 --frames 8 --size 64";

/// Returns the size of the frames of an animated PNG, or of a still one, their colours, and the file's description.
fn apng(path: &Path) -> ([u32; 2], Vec<Vec<u8>>, String) {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let count = reader.info().animation_control().map_or(1, |control| control.num_frames);
    let described = reader.info().utf8_text.iter().find(|t| t.keyword == "Description").unwrap();
    let description = described.get_text().unwrap();
    let (width, height) = reader.info().size();
    let mut all = vec![];
    for _ in 0..count {
        let mut frame = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut frame).unwrap();
        all.push(frame);
    }
    assert!(reader.next_frame(&mut vec![0; all[0].len()]).is_err());
    ([width, height], all, description)
}

/// Returns each frame of an opaque GIF as a viewer shows it, and the time of all frames, in hundredths of a second.
fn gif(path: &Path) -> (Vec<Vec<u8>>, u16) {
    let mut options = DecodeOptions::new();
    options.set_color_output(ColorOutput::RGBA);
    let mut reader = options.read_info(std::fs::File::open(path).unwrap()).unwrap();
    assert_eq!(reader.repeat(), Repeat::Infinite);
    let mut screen = vec![0; 3 * usize::from(reader.width()) * usize::from(reader.height())];
    let (mut all, mut ticks) = (vec![], 0);
    while let Some(frame) = reader.read_next_frame().unwrap() {
        assert_eq!(frame.dispose, DisposalMethod::Keep);
        for (behind, pixel) in screen.chunks_exact_mut(3).zip(frame.buffer.chunks_exact(4)) {
            if pixel[3] > 0 {
                behind.copy_from_slice(&pixel[..3]);
            }
        }
        ticks += frame.delay;
        all.push(screen.clone());
    }
    (all, ticks)
}

#[test]
fn frames_in_a_scope_are_the_pictures_that_export_writes() {
    let desk = Desk::new();
    assert_eq!(desk.done(ROCKING).trim(), "out/tolkowsky-motion-rock-swing-20-aset-spin.png");
    let (size, frames, description) = apng(&desk.at("out/tolkowsky-motion-rock-swing-20-aset-spin.png"));
    assert_eq!((size, frames.len()), ([64, 64], 8));
    let expected = "Tolkowsky 1919: aset, rocking 20 degrees to and fro toward 0, table side, 8 frames; table side; index 2.41";
    assert!(description.starts_with(expected), "{description}");
    // The stone begins face up, and reaches both ends of its swing.
    for (number, tilt, suffix) in [(0, "", ""), (2, "--tilt 20", "-tilt-20"), (6, "--tilt -20", "-tilt--20")]
    {
        desk.done(&format!("export tolkowsky --views aset --size 64 --format png {tilt} --out still"));
        let still = apng(&desk.at(format!("still/tolkowsky{suffix}-aset.png")));
        assert!(still.1[0] == frames[number], "{tilt}");
        let single =
            apng(&desk.at(format!("out/tolkowsky-motion-rock-swing-20-aset-spin/{:04}.png", number + 1)));
        assert!(single == still, "{tilt}");
    }
    assert!(frames[1] != frames[2] && frames[2] != frames[6]);
    assert_eq!(files(&desk.at("out/tolkowsky-motion-rock-swing-20-aset-spin")).len(), 8);
    // Hearts are seen through the pavilion, and a stone that turns comes round as its symmetry says.
    desk.done("spin tolkowsky --scope hearts --frames 16 --size 48 --out hearts.png");
    let (_, frames, description) = apng(&desk.at("hearts.png"));
    assert!(description.contains("; culet side; "), "{description}");
    let apart = |a: &[u8], b: &[u8]| a.iter().zip(b).filter(|(a, b)| a.abs_diff(**b) > 8).count();
    assert!(apart(&frames[0], &frames[2]) < 40, "an eighth of a turn brings the stone onto itself");
    assert!(apart(&frames[0], &frames[1]) > 400);
    assert!(!desk.at("hearts").exists(), "a file alone has no frames beside it");
}

#[test]
fn a_gif_shows_the_frames_with_the_colours_of_the_scope_exact() {
    let desk = Desk::new();
    desk.done(&format!("{ROCKING} --seconds 0.6 --out a.png"));
    assert_eq!(desk.done(&format!("{ROCKING} --seconds 0.6 --out a.gif")).trim(), "a.gif");
    let ((_, frames, _), (shown, ticks)) = (apng(&desk.at("a.png")), gif(&desk.at("a.gif")));
    assert_eq!((shown.len(), ticks), (8, 60));
    const ZONES: [[u8; 3]; 4] = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [0, 0, 0]];
    let (mut sum, mut far) = (0, 0);
    for (frame, shown) in frames.iter().zip(&shown) {
        let colours: Vec<&[u8]> = frame.chunks_exact(3).collect();
        let count = |wanted: &[u8]| colours.iter().filter(|colour| **colour == wanted).count();
        for (colour, shown) in colours.iter().zip(shown.chunks_exact(3)) {
            let error = shown.iter().zip(*colour).map(|(a, b)| u32::from(a.abs_diff(*b))).max().unwrap();
            if error > 0 {
                assert!(ZONES.iter().all(|zone| zone != *colour), "{colour:?} became {shown:?}");
                assert!(191 * count(colour) < colours.len(), "{colour:?} became {shown:?}");
            }
            (sum, far) = (sum + error, far + usize::from(error > 48));
        }
    }
    let all = 8 * 64 * 64;
    assert!(sum < 8 * all && 200 * far < all as usize, "{sum} in all and {far} far off, of {all}");
    let bytes = std::fs::read(desk.at("a.gif")).unwrap();
    assert!(String::from_utf8_lossy(&bytes).contains("Tolkowsky 1919: aset, rocking 20 degrees"));
    assert_eq!(desk.done(&format!("{ROCKING} --seconds 0.6 --out b.gif")).trim(), "b.gif");
    assert_eq!(bytes, std::fs::read(desk.at("b.gif")).unwrap(), "the same command writes the same bytes");
}

#[test]
fn captions_and_curves_are_under_the_pictures_and_change_with_the_tilt() {
    let desk = Desk::new();
    let line = "spin tolkowsky --scope ideal-scope --motion rock --swing 20 --frames 4 --size 320";
    desk.done(&format!("{line} --out bare.png"));
    desk.done(&format!("{line} --caption --of leakage --of return-cos2 --out more.png"));
    let ([_, height], bare, _) = apng(&desk.at("bare.png"));
    let ([width, with], more, _) = apng(&desk.at("more.png"));
    assert_eq!((width, height), (320, 320));
    assert!(with > 320 + 144 + 40, "{with} rows");
    for (bare, more) in bare.iter().zip(&more) {
        assert!(more.starts_with(bare), "the picture itself is the same");
    }
    // Frames 1 and 3 show the stone at rest; at both ends caption and mark differ from there and from each other.
    let below = |number: usize| &more[number][bare[0].len()..];
    assert!(below(0) == below(2) && below(0) != below(1) && below(1) != below(3));
    let plot = |number: usize| &below(number)[below(0).len() - 3 * 320 * 144..];
    assert!(plot(1) != plot(3) && plot(0) != plot(1));
    // Under light the same panel, and over the azimuth.
    let lit = "spin tolkowsky --motion wobble --frames 4 --size 320x200 --samples 1 --wavelengths 2";
    desk.done(&format!("{lit} --of leakage --caption --out lit.gif"));
    let (frames, _) = gif(&desk.at("lit.gif"));
    assert!(frames.len() == 4 && frames[0].len() > 3 * 320 * (200 + 144));
}

#[test]
fn an_animation_at_fault_is_refused_and_says_why() {
    let desk = Desk::new();
    let mut lines = vec![
        ("spin tolkowsky --out a.webm", 2, ".webm is not written; give a .png, a .gif, an .mp4 or a folder"),
        ("spin tolkowsky --out -", 2, "give a file or a folder"),
        ("spin tolkowsky --scope asett", 2, "did you mean 'aset'"),
        ("spin tolkowsky --scope none.toml", 1, "none.toml"),
        ("spin tolkowsky --scope aset --light dome", 2, "cannot be used with"),
        ("spin tolkowsky --scope aset --head=-5", 2, "--head -5: give 0 to 89 degrees"),
        ("spin tolkowsky --out a.apng", 2, ".apng is not written"),
        (
            "spin tolkowsky --motion rock --perspective 5 --of leakage --size 320",
            2,
            "leave out --perspective",
        ),
        ("spin tolkowsky --scope aset --overlay facets", 2, "cannot be used with"),
        ("spin trilogy --scope aset", 1, "trilogy"),
        ("spin trilogy --motion rock --of leakage --size 320", 2, "this is a scene"),
        ("spin tolkowsky --of leakage", 2, "--motion rock or the azimuth of --motion wobble"),
        ("spin tolkowsky --motion rock --of leek", 2, "leek"),
        ("spin tolkowsky --motion rock --of leakage --size 64", 2, "64 pixels across: --of needs 320"),
        ("spin tolkowsky --caption --size 64", 2, "64 pixels across: --caption needs 96"),
        ("spin tolkowsky --motion rock --swing 0 --of leakage", 2, "give more --frames or a --swing"),
        ("spin tolkowsky --seconds 0.5 --out a.gif", 2, "each may take 20 to 65535 ms"),
        ("spin heart --scope aset --motion rock --of leakage --size 320", 1, "nothing can be measured"),
    ];
    match cfg!(feature = "video") {
        true => lines.push(("spin tolkowsky --background transparent --out a.mp4", 2, "MP4 has no cover")),
        false => lines.push(("spin tolkowsky --out a.mp4", 2, "build it with `--features video`")),
    }
    let before = files(&desk.at("")).len();
    for (line, code, expected) in lines {
        let stderr = desk.refused(line, code);
        assert!(stderr.contains(expected), "{line}: {stderr}");
    }
    assert!(!desk.at("out").exists() && files(&desk.at("")).len() == before);
}

#[test]
#[cfg(feature = "video")]
fn a_video_is_a_small_file_with_its_description() {
    let desk = Desk::new();
    assert_eq!(desk.done(&format!("{ROCKING} --out a.mp4")).trim(), "a.mp4");
    let bytes = std::fs::read(desk.at("a.mp4")).unwrap();
    let text = String::from_utf8_lossy(&bytes);
    assert!(
        &bytes[4..8] == b"ftyp" && text.contains("av01") && text.contains("Tolkowsky 1919: aset, rocking")
    );
    assert!(bytes.len() < 64 * 64 * 3 * 8 / 4, "{} bytes", bytes.len());
}
