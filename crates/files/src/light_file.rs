//! Reads and writes light files: TOML with a name and the sources of light.

use super::text;
use super::toml_text::TomlText;
use brillianteer_base::{Fault, FileError};
use brillianteer_scene::{Light, LightError};
use std::path::Path;

/// The size of the largest file that is read, in bytes.
const MAX_BYTES: u64 = 1 << 20;

/// The longest name of a light, in characters.
const LONGEST_NAME: usize = 60;

/// Reads a light file. A panorama that the light names is not opened; its path begins at the light's own folder.
///
/// # Errors
/// Fails where the file cannot be read or is no light; the error names path, line and key.
pub fn read(path: &Path) -> Result<Light, FileError> {
    let light = text::read(path, MAX_BYTES).and_then(|text| light(&text));
    light.map_err(|fault| fault.in_file(path.display()))
}

fn light(text: &str) -> Result<Light, Fault> {
    TomlText::parse(text)?.read(|light: Light| {
        check_name(&light.name)?;
        light.validate().map_err(|error| Fault::key(path_of(&error, &light), error))?;
        Ok(light)
    })
}

/// Returns the text of a light file that [`read`] reads as the same light.
///
/// # Errors
/// Fails where the path of its panorama is not Unicode.
pub fn text(light: &Light) -> Result<String, toml::ser::Error> {
    toml::to_string(light)
}

/// Checks that a name fits beside a picture, on one line.
fn check_name(name: &str) -> Result<(), Fault> {
    let is_plain = !name.trim().is_empty() && !name.chars().any(char::is_control);
    if is_plain && name.chars().count() <= LONGEST_NAME {
        return Ok(());
    }
    let wanted = format!("name: give 1 to {LONGEST_NAME} characters, all printable and not all blank");
    Err(Fault::key("name", wanted))
}

/// Returns the path of the key at fault in the file.
fn path_of(error: &LightError, light: &Light) -> String {
    match *error {
        LightError::Value { part: "light", key, .. } => key.to_owned(),
        LightError::Value { part: "panorama", key, .. } => format!("panorama/{key}"),
        LightError::Value { part, number, key, .. } => format!("{part}/{}/{key}", number - 1),
        LightError::TooManyLamps { .. } if light.field.is_empty() => "lamp".to_owned(),
        LightError::TooManyLamps { .. } => "field".to_owned(),
        LightError::Dark => "name".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_scene::{LIGHTS, PanoramaRef};
    use proptest::prelude::*;

    fn message(text: &str) -> String {
        let fault = light(text).unwrap_err();
        format!("{}: {fault}", fault.line.unwrap_or(0))
    }

    #[test]
    fn every_light_of_the_program_reads_as_it_was_written() {
        for name in LIGHTS {
            let known = brillianteer_scene::light(name).unwrap();
            assert_eq!(light(&text(&known).unwrap()).unwrap(), known, "{name}");
        }
        let panorama = PanoramaRef { file: "skies/noon \"1\".exr".into(), exposure: -0.1, turn: 1.0 / 3.0 };
        let odd = Light { panorama: Some(panorama), name: "é\"'\\".into(), ..Light::studio() };
        assert_eq!(light(&text(&odd).unwrap()).unwrap(), odd);
    }

    #[test]
    fn what_is_left_out_is_what_is_usual() {
        let short = light("name = \"x\"\n[[dome]]\nradiance = 1\n").unwrap();
        assert_eq!(short, Light { name: "x".into(), description: String::new(), ..Light::white() });
    }

    #[test]
    fn numbers_at_fault_are_told_with_their_line() {
        let start = "name = \"x\"\nhead = 10\n[[box]]\nazimuth = 0\nelevation = 45\nwidth = 30\nheight = 20\nradiance = 1\n";
        assert!(light(start).is_ok());
        let second = "[[box]]\nazimuth = 0\nelevation = 45\nheight = 20\nwidth = 0\nradiance = 1\n";
        let cases = [
            (start.replace("head = 10", "head = 90"), "2: light 1: head is 90; give 0 to 89 degrees"),
            (format!("{start}{second}"), "13: box 2: width is 0; give 0.5 to 180"),
            (
                format!("{start}[[dome]]\nfrom = 50\nto = 40\nradiance = 1\n"),
                "11: dome 1: to is 40; it must not",
            ),
            (format!("{start}[[dome]]\nradiance = nan\n"), "10: dome 1: radiance is NaN; give 0 to 1e6"),
            (
                format!("{start}[panorama]\nfile = \"x.exr\"\nexposure = 50\n"),
                "11: panorama 1: exposure is 50;",
            ),
            (
                format!("{start}[[field]]\ncount = 300\nfrom = 0\nto = 9\nradius = 1\nradiance = 1\n"),
                "9: 300 lamps in all",
            ),
            ("# dark\nname = \"x\"\n".into(), "2: nothing shines: give a dome"),
            (start.replace("\"x\"", "\" \""), "1: name: give 1 to 60 characters"),
        ];
        for (text, expected) in cases {
            let error = message(&text);
            assert!(error.starts_with(expected), "{error}\nfor\n{text}");
        }
    }

    #[test]
    fn keys_at_fault_are_told_with_what_was_meant() {
        let dome = "name = \"x\"\n[[dome]]\nradiance = 1\n";
        let cases = [
            (format!("{dome}sofd = 1\n"), "4: dome: unknown key `sofd`", "did you mean `soft`?"),
            (format!("{dome}[[boxes]]\nwidth = 1\n"), "4: unknown key `boxes`", "did you mean `box`?"),
            (dome.replace("radiance = 1", "to = 9"), "2: dome: the key `radiance` is missing", "white sheet"),
            (dome.replace('1', "\"1\""), "3: dome.radiance: invalid type: string", "expected a number"),
            (format!("{dome}colour = [0, 0, 256]\n"), "4: dome.colour", "0 to 255"),
            (
                dome.replacen('\n', "\nspectrum = \"D66\"\n", 1),
                "2: spectrum: no illuminant is called 'D66'",
                "5000 K",
            ),
            ("name = \"x\"\n[[field]]\ncount = -1".into(), "3: field.count: invalid value", "whole number"),
            (format!("world = \"moon\"\n{dome}"), "1: world", "sunset"),
            (dome.replace("= 1", "= 1,5"), "3: radiance: column 13", "decimal point"),
        ];
        for (text, start, within) in cases {
            let error = message(&text);
            assert!(error.starts_with(start) && error.contains(within), "{error}\nfor\n{text}");
        }
    }

    proptest! {
        #[test]
        fn no_text_makes_it_panic(text in "(?s).{0,200}") {
            let _ = light(&text);
        }

        #[test]
        fn no_spoilt_light_makes_it_panic(
            name in proptest::sample::select(&LIGHTS[..]),
            at in 0.0..1.0_f64,
            length in 0..20_usize,
            put in "[-\\[\\]{}\"=.,0-9a-z\n]{0,12}",
        ) {
            let mut text: Vec<char> = text(&brillianteer_scene::light(name).unwrap()).unwrap().chars().collect();
            let from = (at * text.len() as f64) as usize;
            text.splice(from..(from + length).min(text.len()), put.chars());
            let text: String = text.into_iter().collect();
            let _ = light(&text);
        }
    }
}
