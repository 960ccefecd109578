//! Reads refraction maps: the program's own, and pictures that another renderer made of the template.

use super::codes::{self, Codes};
use super::{About, MOST_MAP_BANDS, Template, foreign, tiles};
use brillianteer_base::{Fault, FileError};
use brillianteer_optics::linear_from_encoded;
use brillianteer_picture::{LUMINANCE, Linear, MapBand, RefractionMap, SourcePlace};
use glam::{DMat3, DVec3};
use std::path::{Path, PathBuf};

/// The wavelengths that stand for red, green and blue where a picture was made for each, in nm.
const COLOURS: [f64; 3] = [610.0, 550.0, 465.0];

/// The wavelength that stands for all light, in nm.
const ALL: f64 = 555.0;

/// A map that was read from files, and remarks about them.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedMap {
    /// The map. Places and weights are numbers of 0 to 1.
    pub map: RefractionMap,
    /// Notes, with the name of the file, on pixels that were counted as empty or mended.
    pub notes: Vec<String>,
    /// Warnings, with the name of the file, about faults that make the map wrong or doubtful.
    pub warnings: Vec<String>,
}

/// Reads a map from its pictures, PNG or OpenEXR.
///
/// The program's own files carry a text about their bands; the caller gives all files of a map, in their order. A
/// picture without this text is foreign: another renderer made it of the `template`, which by default is the tiled
/// one where channels have 8 bits and the gradient otherwise. One foreign picture is for all light; three are for
/// red, green and blue. The diffuse layer is a picture with alpha, of the same size; without it, light that does not
/// come from the background is dark.
///
/// # Errors
/// Fails where a file cannot be read or is no map, or where the files do not fit together; the error names the file
/// and what to do.
pub fn read(
    pictures: &[PathBuf],
    diffuse: Option<&Path>,
    template: Option<Template>,
) -> Result<LoadedMap, FileError> {
    let fault = |path: &Path, fault: Fault| fault.in_file(path.display());
    let Some(first) = pictures.first() else {
        return Err(FileError::new("refraction map", "there is no picture; give at least one"));
    };
    let all = all_codes(pictures)?;
    let is_own = all[0].about.is_some();
    let [width, height] = all[0].size;
    let has_weights = is_own && has_weights_below(pictures, &all)?;
    if has_weights && !height.is_multiple_of(2) {
        let problem =
            format!("{height} rows of pixels are no places with as many weights below; get it again");
        return Err(fault(first, problem.into()));
    }
    let size = [width, if has_weights { height / 2 } else { height }];
    let layer = diffuse.map(|path| diffuse_layer(path, size).map_err(|f| fault(path, f))).transpose()?;
    if is_own {
        let bands = own_bands(&all, size, layer.as_ref()).map_err(|f| fault(first, f))?;
        let diffuse =
            layer.unwrap_or_else(|| Linear { pixels: covers(&bands), width: size[0], height: size[1] });
        return Ok(LoadedMap {
            map: RefractionMap { size, bands, diffuse },
            notes: vec![],
            warnings: vec![],
        });
    }
    foreign_map(pictures, &all, layer, template)
}

/// Reads the pictures of a map. A file that cannot be a map is refused before the next is read.
fn all_codes(pictures: &[PathBuf]) -> Result<Vec<Codes>, FileError> {
    let mut all: Vec<Codes> = vec![];
    for path in pictures {
        let refused = |problem: String| Fault::whole(problem).in_file(path.display());
        if pictures.len() > MOST_MAP_BANDS as usize {
            let problem = format!("{} files: a map has {MOST_MAP_BANDS} at most", pictures.len());
            return Err(refused(problem));
        }
        let codes = codes::read(path).map_err(|fault| fault.in_file(path.display()))?;
        if codes.about.is_none() && ![1, 3].contains(&pictures.len()) {
            let problem = "another renderer's map is one picture, or three for red, green and blue";
            return Err(refused(problem.to_owned()));
        }
        if codes.is_exr && codes.about.is_some() && pictures.len() > 1 {
            return Err(refused("this file holds all bands of its map; give it alone".to_owned()));
        }
        let is_alike = |first: &Codes| {
            codes.size == first.size
                && codes.bits == first.bits
                && codes.about.is_some() == first.about.is_some()
        };
        if !all.first().is_none_or(is_alike) {
            let first = pictures[0].display();
            return Err(refused(format!("it is no map of the same kind and size as {first}")));
        }
        all.push(codes);
    }
    Ok(all)
}

/// Returns whether the weights of the program's own pictures lie below their places. Where their texts do not say so, they do
/// in tiles of several bands.
fn has_weights_below(pictures: &[PathBuf], all: &[Codes]) -> Result<bool, FileError> {
    let is_tiled = all[0].bits == 8;
    let usual = is_tiled && all.len() > 1;
    for (path, codes) in pictures.iter().zip(all).filter(|(_, codes)| !codes.is_exr) {
        // A text that cannot be read is refused with the bands.
        let Some(about) = codes.about.as_deref().and_then(|text| serde_json::from_str::<About>(text).ok())
        else {
            continue;
        };
        let files = about.files.unwrap_or(all.len());
        if files != all.len() || about.weights_below.unwrap_or(usual) != (is_tiled && files > 1) {
            let problem = format!(
                "it is one of {files} files of a map, and {} are given; give all files of one map",
                all.len()
            );
            return Err(Fault::whole(problem).in_file(path.display()));
        }
    }
    Ok(usual)
}

/// Makes the map of foreign pictures.
fn foreign_map(
    pictures: &[PathBuf],
    all: &[Codes],
    layer: Option<Linear>,
    template: Option<Template>,
) -> Result<LoadedMap, FileError> {
    let size = all[0].size;
    let (mut bands, mut notes, mut warnings) = (vec![], vec![], vec![]);
    for (k, (path, codes)) in pictures.iter().zip(all).enumerate() {
        let label = path.display();
        let mut found = foreign::places(codes, template).map_err(|fault| fault.in_file(&label))?;
        if let Some(layer) = layer.as_ref().filter(|_| !found.has_weights) {
            // Light from behind the cover of the layer does not come from the background.
            found
                .places
                .iter_mut()
                .zip(&layer.pixels)
                .for_each(|(place, light)| place.weight *= 1.0 - light[3]);
        }
        notes.extend(found.notes.into_iter().map(|note| format!("{label}: {note}")));
        warnings.extend(found.warnings.into_iter().map(|warning| format!("{label}: {warning}")));
        let one = DMat3::from_diagonal(DVec3::AXES[k]);
        let (nm, response) = if all.len() == 1 { (ALL, DMat3::IDENTITY) } else { (COLOURS[k], one) };
        bands.push(MapBand { nm, response, places: found.places });
    }
    let mut pixels = covers(&bands);
    let light = layer.into_iter().flat_map(|layer| layer.pixels);
    pixels
        .iter_mut()
        .zip(light)
        .for_each(|(pixel, [red, green, blue, _])| *pixel = [red, green, blue, pixel[3]]);
    let diffuse = Linear { width: size[0], height: size[1], pixels };
    Ok(LoadedMap { map: RefractionMap { size, bands, diffuse }, notes, warnings })
}

/// Returns a diffuse layer without light, whose cover is the part of white light that the bands leave.
fn covers(bands: &[MapBand]) -> Vec<[f32; 4]> {
    let luminance = DVec3::from_array(LUMINANCE.map(f64::from));
    let shares: Vec<f64> = bands.iter().map(|band| (band.response * DVec3::ONE).dot(luminance)).collect();
    let pixels = bands.first().map_or(0, |band| band.places.len());
    let seen = |k: usize| -> f64 {
        bands.iter().zip(&shares).map(|(band, share)| f64::from(band.places[k].weight) * share).sum()
    };
    (0..pixels).map(|k| [0.0, 0.0, 0.0, (1.0 - seen(k)).clamp(0.0, 1.0) as f32]).collect()
}

/// Returns the bands of the program's own files, which hold places and weights as they are.
fn own_bands(all: &[Codes], size: [u32; 2], layer: Option<&Linear>) -> Result<Vec<MapBand>, Fault> {
    let part = |value: f32| if value.is_finite() { value.clamp(0.0, 1.0) } else { 0.0 };
    let mut bands = vec![];
    for codes in all {
        let text = codes.about.as_deref().unwrap_or_default();
        let one = || serde_json::from_str::<About>(text).map(|about| vec![about]);
        let abouts = serde_json::from_str::<Vec<About>>(text).or_else(|_| one());
        let abouts =
            abouts.map_err(|e| format!("the text of its bands cannot be read ({e}); get the file again"))?;
        if abouts.len() != codes.bands.len() || !abouts.iter().all(is_sane) {
            return Err("the text of its bands is not that of a map; get the file again".into());
        }
        for (about, values) in abouts.iter().zip(&codes.bands) {
            let places = if codes.bits == 8 {
                own_tiles(values.split_at(size[0] as usize * size[1] as usize), layer)
            } else {
                let place =
                    |&[u, v, weight]: &[f32; 3]| SourcePlace { u: part(u), v: part(v), weight: part(weight) };
                values.iter().map(place).collect()
            };
            bands.push(about.band(places));
        }
    }
    if bands.len() > MOST_MAP_BANDS as usize {
        return Err(format!("{} bands: a map has {MOST_MAP_BANDS} at most", bands.len()).into());
    }
    Ok(bands)
}

fn is_sane(about: &About) -> bool {
    about.nm.is_finite() && about.response.iter().flatten().all(|part| part.is_finite() && part.abs() < 1e3)
}

/// Returns the places of one of the program's own maps in tiles. The weights are those below the places, else the
/// part that the diffuse layer leaves, else 0 for black and 1 for all other pixels.
fn own_tiles((codes, weights): (&[[f32; 3]], &[[f32; 3]]), layer: Option<&Linear>) -> Vec<SourcePlace> {
    let place = |(k, value): (usize, &[f32; 3])| {
        let code = foreign::bytes(value);
        let weight = match (weights.get(k), layer) {
            (Some([grey, ..]), _) => *grey,
            (None, Some(layer)) => 1.0 - layer.pixels[k][3],
            (None, None) => f32::from(u8::from(code != [0; 3])),
        };
        let at = tiles::place(code).as_vec2();
        SourcePlace { u: at.x, v: at.y, weight }
    };
    codes.iter().enumerate().map(place).collect()
}

/// Reads a diffuse layer: PNG in sRGB, not premultiplied; OpenEXR in linear light, premultiplied.
fn diffuse_layer(path: &Path, size: [u32; 2]) -> Result<Linear, Fault> {
    let codes = codes::read(path)?;
    if codes.size != size {
        let ([width, height], [across, down]) = (codes.size, size);
        let problem = format!(
            "the diffuse layer has {width} by {height} pixels, and the map {across} by {down}; render both alike"
        );
        return Err(problem.into());
    }
    let Some(alpha) = &codes.alpha else {
        return Err("the diffuse layer has no alpha, which says what it hides; save it as RGBA".into());
    };
    let light = |(value, &alpha): (&[f32; 3], &f32)| {
        let alpha = if alpha.is_finite() { alpha.clamp(0.0, 1.0) } else { 0.0 };
        let linear = |c: f32| if codes.is_exr { c } else { linear_from_encoded(f64::from(c)) as f32 * alpha };
        let [red, green, blue] = value.map(|c| if c.is_finite() { linear(c).max(0.0) } else { 0.0 });
        [red, green, blue, alpha]
    };
    let pixels = codes.bands.first().into_iter().flatten().zip(alpha).map(light).collect();
    Ok(Linear { width: size[0], height: size[1], pixels })
}
