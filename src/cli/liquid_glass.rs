//! `liquid-glass`: draws a pane of glass over a background as screens do, and traces the same pane for comparison.

mod timing;

use super::console::{print, say, written};
use super::options::number;
use super::picture_options::film_size;
use super::picture_options::within;
use super::progress::WorkProgress;
use brillianteer_base::Failure;
use brillianteer_files::{STANDARD, is_standard};
use brillianteer_optics::linear_from_encoded;
use brillianteer_paper::table::{Column, Table};
use brillianteer_paper::{background, write_linear_exr, write_rgba_png};
use brillianteer_picture::liquid_glass::{Cost, GlassPane, LightFrom, PaneQuality, Shifts, layer, pane};
use brillianteer_picture::{Develop, Linear, develop};
use brillianteer_render::{Job, PaneProduct, Quality, Renderer};
use brillianteer_scene::{BackgroundRef, Panorama, Tone};
use clap::Args;
use glam::{DVec2, DVec4};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The default width and height of the pane, as parts of the picture's.
const EXTENT: DVec2 = DVec2::new(0.625, 0.5);

/// The default radius of the pane's corners, as a part of its shorter side.
const ROUND: f64 = 0.3;

/// The endings of picture files. A path with one of them is not meant as a folder.
const PICTURES: [&str; 7] = ["png", "jpg", "jpeg", "exr", "gif", "webp", "svg"];

/// The number of wavelengths in each sample pass of the traced pane.
const WAVELENGTHS: u32 = 12;

#[derive(Debug, Args)]
pub struct LiquidGlass {
    /// The background: a colour (white, #20262e), two from top to bottom (#404850-#101215), a world (sunset, room, city),
    /// a pattern (page, grid, checks, stripes, dots, slit), or a photograph's file
    #[arg(long, value_name = "WHAT")]
    background: String,
    /// Folder to write to, or the .png itself; without --compare `-` is standard output
    #[arg(short, long, default_value = "out")]
    out: PathBuf,
    /// Pixels of the picture: a number for a square, or WIDTHxHEIGHT
    #[arg(long, value_name = "PIXELS", default_value = "960x600", value_parser = film_size)]
    size: [u32; 2],
    /// The pane: WIDTHxHEIGHT+X+Y in pixels, X and Y from the upper left corner; without them in the middle [default: 5/8
    /// by half of the picture, in the middle]
    #[arg(long, value_name = "WxH+X+Y", value_parser = geometry)]
    pane: Option<Geometry>,
    /// Radius of the pane's corners in pixels [default: 0.3 of its shorter side]
    #[arg(long, value_name = "PIXELS", value_parser = number)]
    radius: Option<f64>,
    /// Strength of the refraction, 0 to 100
    #[arg(long, value_name = "STRENGTH", default_value_t = 100.0, value_parser = number)]
    refraction: f64,
    /// Strength of the depth, 0 to 100
    #[arg(long, value_name = "STRENGTH", default_value_t = 100.0, value_parser = number)]
    depth: f64,
    /// Strength of the dispersion, 0 to 100
    #[arg(long, value_name = "STRENGTH", default_value_t = 100.0, value_parser = number)]
    dispersion: f64,
    /// Strength of the frost, 0 to 100
    #[arg(long, value_name = "STRENGTH", default_value_t = 0.0, value_parser = number)]
    frost: f64,
    /// Strength of the light, 0 to 100
    #[arg(long, value_name = "STRENGTH", default_value_t = 30.0, value_parser = number)]
    light: f64,
    /// The direction of the light, degrees: its azimuth counter-clockwise from the right, 90 above, and its height
    /// over the pane, 0 to 90
    #[arg(long, allow_hyphen_values = true, value_name = "AZIMUTH,HEIGHT", default_value = "90,53.13", value_parser = light_from)]
    light_from: LightFrom,
    /// The base colour; its alpha says how far it colours the light
    #[arg(long, value_name = "#rrggbbaa", default_value = "#00000000", value_parser = tint)]
    tint: DVec4,
    /// high (all effects), medium (frost by three samples, dispersion 30 at most) or low (refraction alone)
    #[arg(long, default_value = "high")]
    quality: PaneQuality,
    /// Write the pane alone, with alpha, and no background around it
    #[arg(long)]
    alone: bool,
    /// Write an .exr beside the picture: linear light, premultiplied by alpha (a PNG's alpha is straight)
    #[arg(long)]
    exr: bool,
    /// Print how long each part takes in each quality, and how far the qualities are apart
    #[arg(long)]
    timing: bool,
    /// Trace the same pane as well, and print how far the approximation is from it
    #[arg(long)]
    compare: bool,
    /// The height of the traced pane above the background, in parts of the pane's shorter side
    #[arg(long, value_name = "DISTANCE", default_value_t = 0.02, requires = "compare")]
    gap: f64,
    /// Samples of each pixel in the comparison, 1 to 1024
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=1024))]
    samples: u32,
    /// What the options add to the default names of files.
    #[arg(skip)]
    pub told_apart: String,
}

/// The size of a pane and the place of its upper left corner, in pixels. Without a place the pane is in the middle of the
/// picture.
#[derive(Debug, Clone, Copy)]
struct Geometry {
    size: DVec2,
    corner: Option<DVec2>,
}

fn geometry(text: &str) -> Result<Geometry, String> {
    let wrong = || "give WIDTHxHEIGHT+X+Y such as 400x240+80+60, or WIDTHxHEIGHT".to_owned();
    let both = |text: &str, between: char| {
        let (a, b) = text.split_once(between)?;
        let number = |text: &str| text.trim().parse::<u16>().ok().map(f64::from);
        Some(DVec2::new(number(a)?, number(b)?))
    };
    let (size, corner) = match text.split_once('+') {
        Some((size, corner)) => (size, Some(both(corner, '+').ok_or_else(wrong)?)),
        None => (text, None),
    };
    Ok(Geometry { size: both(size, 'x').ok_or_else(wrong)?, corner })
}

fn light_from(text: &str) -> Result<LightFrom, String> {
    let wrong = || "give azimuth and height in degrees, such as 135,40; the height is 0 to 90".to_owned();
    let (azimuth, height) = text.split_once(',').ok_or_else(wrong)?;
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(wrong);
    let (azimuth, height) = (number(azimuth)?, number(height)?);
    if (0.0..=90.0).contains(&height) { Ok(LightFrom { azimuth, height }) } else { Err(wrong()) }
}

fn tint(text: &str) -> Result<DVec4, String> {
    let digits =
        text.trim().strip_prefix('#').filter(|d| d.len() == 8 && d.bytes().all(|b| b.is_ascii_hexdigit()));
    let code = digits.and_then(|d| u32::from_str_radix(d, 16).ok());
    let code = code.ok_or("give red, green, blue and alpha in hexadecimal, such as #3060ff40")?;
    let [red, green, blue, alpha] = code.to_be_bytes().map(|byte| f64::from(byte) / 255.0);
    let [red, green, blue] = [red, green, blue].map(linear_from_encoded);
    Ok(DVec4::new(red, green, blue, alpha))
}

impl LiquidGlass {
    /// Returns the ending of the path to write to if it is that of a picture, and no folder has this name.
    fn picture_ending(&self) -> Option<&std::ffi::OsStr> {
        let ending = self.out.extension().filter(|_| !self.out.is_dir())?;
        PICTURES.iter().any(|known| ending.eq_ignore_ascii_case(known)).then_some(ending)
    }

    pub fn run(&self) -> Result<(), Failure> {
        let ending = self.picture_ending().map(|ending| ending.display().to_string());
        if let Some(ending) =
            ending.filter(|ending| self.compare || self.exr || !ending.eq_ignore_ascii_case("png"))
        {
            return Err(Failure::Usage(format!(
                "--out: give a .png, or a folder; --compare and --exr write several files, which need a folder, not a .{ending}"
            )));
        }
        if is_standard(&self.out) && (self.compare || self.exr || self.timing) {
            return Err(Failure::Usage(
                "--out -: several files or lines are written; give a folder, or leave out --compare, --exr and --timing"
                    .into(),
            ));
        }
        let (pane_asked, gap) = (self.asked()?, within("gap", self.gap, [1e-3, 100.0])?);
        let background = self.ground()?;
        let description = self.description(&pane_asked);
        let draw = if self.alone { layer } else { pane };
        let drawn = draw(&pane_asked, &background, 1);
        self.write("", &drawn, &description)?;
        if self.exr {
            let path = self.out.join(format!("liquid-glass{}.exr", self.told_apart));
            write_linear_exr(&path, &mut &drawn, &description)?;
            written(&path)?;
        }
        if self.timing {
            print(&timing::table(&pane_asked, &background))?;
        }
        if !self.compare {
            return Ok(());
        }
        let background = Arc::new(background);
        let product = PaneProduct {
            pane: pane_asked,
            background: Arc::clone(&background),
            gap,
            wavelengths: WAVELENGTHS,
            compares: true,
        };
        let job =
            Job::of_pane(product, Quality { samples: Some(self.samples), ..Quality::of_pictures(true) });
        let (traced, cost) = {
            let bar = WorkProgress::new("liquid glass, traced");
            let rendered = Renderer::default().run(&job, &bar.watch(), &mut |_| Ok::<_, Failure>(()))?;
            rendered.pane()?
        };
        let description = format!(
            "{description}; traced by rays, gap {gap}, {WAVELENGTHS} wavelengths in {} samples",
            self.samples
        );
        self.write("-traced", &traced, &description)?;
        let both = beside(&pane(&pane_asked, &background, 1), &traced);
        self.write("-both", &both, &format!("left drawn, right traced; {description}"))?;
        cost.map_or(Ok(()), |cost| print(&figures(&cost)))
    }

    /// Returns the pane that the options describe.
    ///
    /// # Errors
    /// Fails where the pane does not lie within the picture, or where an option is out of its range.
    fn asked(&self) -> Result<GlassPane, Failure> {
        let whole = DVec2::from(self.size.map(f64::from));
        let usual = Geometry { size: (whole * EXTENT).round(), corner: None };
        let Geometry { size, corner } = self.pane.unwrap_or(usual);
        let corner = corner.unwrap_or(((whole - size) / 2.0).floor());
        let inside =
            size.min_element() >= 8.0 && corner.min_element() >= 0.0 && (corner + size).cmple(whole).all();
        if !inside {
            let [width, height] = self.size;
            return Err(Failure::Usage(format!(
                "--pane: give a pane of 8 pixels and more each way within the picture of {width} by {height}"
            )));
        }
        let most = size.min_element() / 2.0;
        let strength = |key, value| within(key, value, [0.0, 100.0]);
        Ok(GlassPane {
            refraction: strength("refraction", self.refraction)?,
            depth: strength("depth", self.depth)?,
            dispersion: strength("dispersion", self.dispersion)?,
            frost: strength("frost", self.frost)?,
            light: strength("light", self.light)?,
            light_from: self.light_from,
            tint: self.tint,
            quality: self.quality,
            ..GlassPane::clear(
                corner,
                size,
                within("radius", self.radius.unwrap_or(2.0 * ROUND * most), [0.0, most])?,
            )
        })
    }

    /// Reads the background as a picture of the size `self.size`, and prints its warnings.
    fn ground(&self) -> Result<Panorama, Failure> {
        let asked = BackgroundRef::read(&self.background, Path::new(""))?;
        let Some(reading) = background::filling(&asked, self.size)? else {
            let problem = format!("--background {}: a pane needs something behind it", self.background);
            return Err(Failure::Usage(problem));
        };
        reading.warnings.iter().for_each(|w| say(&format!("warning: {w}")));
        Ok(reading.panorama)
    }

    fn description(&self, pane: &GlassPane) -> String {
        let GlassPane {
            size, corner, radius, refraction, depth, dispersion, frost, light, light_from, ..
        } = pane.effective();
        let quality = format!("{:?}", self.quality).to_lowercase();
        let tint = pane.effective().tint.to_array().map(|part| format!("{part:.3}")).join(" ");
        format!(
            "liquid glass, quality {quality}; pane {}x{}+{}+{}, corners {radius:.1}; refraction {refraction}, depth {depth}, \
             dispersion {dispersion}, frost {frost}, light {light} from {:.1},{:.1}; tint {tint}, linear with alpha",
            size.x, size.y, corner.x, corner.y, light_from.azimuth, light_from.height
        )
    }

    fn write(&self, kind: &str, picture: &Linear, description: &str) -> Result<(), Failure> {
        let path = if is_standard(&self.out) {
            STANDARD.into()
        } else if self.picture_ending().is_some() {
            self.out.clone()
        } else {
            self.out.join(format!("liquid-glass{}{kind}.png", self.told_apart))
        };
        // Screens composite without exposure and tone curve.
        let manner = Develop { bloom: None, tone: Tone::Linear, ..Develop::default() };
        write_rgba_png(&path, &develop(picture, &manner), (picture.width, picture.height), description)?;
        written(&path)
    }
}

/// Puts two pictures of the same size side by side, with a white line between them.
fn beside(left: &Linear, right: &Linear) -> Linear {
    let line = (left.width / 100).max(1);
    let row = left.width.max(1) as usize;
    let pairs = left.pixels.chunks(row).zip(right.pixels.chunks(row));
    let pixels = pairs.flat_map(|(a, b)| [a, &vec![[1.0; 4]; line as usize], b].concat()).collect();
    Linear { width: 2 * left.width + line, height: left.height, pixels }
}

fn figures(cost: &Cost) -> String {
    let Cost { mean_difference, psnr_db, pane, traced, apart, fringe, behind, blind } = cost;
    let shifts =
        |Shifts { mean, greatest }: &Shifts| format!("mean {mean:7.2} px   greatest {greatest:7.2} px");
    let fringes = format!("drawn {:6.2} px   traced {:9.2} px", fringe[0], fringe[1]);
    let mut table = Table::new([Column::left("", 36), Column::text("")]);
    table.pair("drawn: background is shifted by", shifts(pane));
    table.pair("traced: background is shifted by", shifts(traced));
    table.pair("distance of the places shown", shifts(apart));
    table.pair("distance of red and blue, mean", fringes);
    table.pair("mean difference in linear light", format!("{mean_difference:.4} of white, {psnr_db:.1} dB"));
    table.pair("traced light from the background", format!("{:.1} %", 100.0 * behind));
    table.pair("traced, shows no background", format!("{:.1} % of the pane", 100.0 * blind));
    table.to_string()
}
