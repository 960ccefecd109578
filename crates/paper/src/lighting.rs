//! Loads the light of a scene: one that comes with the program, a light file, or a panorama.

use brillianteer_base::{Failure, NameOrFileError, Watch, nearest};
use brillianteer_files::{light_file, panorama};
use brillianteer_scene::{LIGHTS, Light, Panorama, light};
use brillianteer_trace::environment::{EnvironmentMap, Lighting};
use std::path::PathBuf;

/// Loads a light by its name, from a light file, or from a panorama alone.
///
/// # Errors
/// Fails where no light has the name, or the file is at fault.
pub fn load(name_or_file: &str) -> Result<Lighting, NameOrFileError> {
    let source = LightSource::read(name_or_file)?;
    let map = EnvironmentMap::new(&source.light, source.panorama.as_ref());
    Ok(source.with_map(map))
}

/// Loads the same light as [`load`]. Where its map takes seconds to draw, as that of a world does, `at_hand` gets the light with a
/// coarse map first, in which pictures can be shown but not written.
///
/// # Errors
/// Fails where [`load`] does, or where `watch` asks to stop.
pub fn load_watched(
    name_or_file: &str,
    watch: Watch,
    at_hand: impl FnOnce(Lighting),
) -> Result<Lighting, Failure> {
    let source = LightSource::read(name_or_file)?;
    if let Some(map) = EnvironmentMap::coarse(&source.light) {
        at_hand(Lighting { light: source.light.clone(), map, warnings: vec![] });
    }
    let map = EnvironmentMap::watched(&source.light, source.panorama.as_ref(), watch)?;
    Ok(source.with_map(map))
}

/// A light that has been read, with all that its map is drawn from.
struct LightSource {
    light: Light,
    panorama: Option<Panorama>,
    warnings: Vec<String>,
}

impl LightSource {
    fn read(name_or_file: &str) -> Result<Self, NameOrFileError> {
        let file = PathBuf::from(name_or_file);
        let (light, folder) = match light(&name_or_file.to_ascii_lowercase()) {
            Some(light) => (light, None),
            None if panorama::is_picture(&file) => (Light::of_panorama(&file), None),
            None if !file.exists() && file.extension().is_none() => {
                return Err(NameOrFileError::Unknown(unknown(name_or_file)));
            }
            None => (light_file::read(&file)?, file.parent()),
        };
        let Some(picture) = &light.panorama else {
            return Ok(Self { light, panorama: None, warnings: vec![] });
        };
        // The path of a panorama begins at the folder of the light file.
        let path = folder.map_or_else(|| picture.file.clone(), |folder| folder.join(&picture.file));
        let reading = panorama::read(&path)?;
        Ok(Self { light, panorama: Some(reading.panorama), warnings: reading.warnings })
    }

    fn with_map(self, map: EnvironmentMap) -> Lighting {
        Lighting { light: self.light, map, warnings: self.warnings }
    }
}

/// Returns the message about a name that no light has.
pub fn unknown(name: &str) -> String {
    let hint = match nearest(&name.to_lowercase(), &LIGHTS) {
        Some(near) => format!("; did you mean '{near}'?"),
        None => format!("; known: {}, or give a light file or a panorama", LIGHTS.join(", ")),
    };
    format!("no light '{name}'{hint}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::write_rgba_png;
    use brillianteer_base::unwatched;
    use brillianteer_scene::World;
    use std::ops::ControlFlow;
    use std::sync::atomic::{AtomicUsize, Ordering};

    fn refused(name: &str) -> NameOrFileError {
        load(name).err().unwrap()
    }

    #[test]
    fn a_light_is_taken_by_its_name_from_a_file_or_as_a_panorama() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let ring = load("Ring").unwrap();
        assert_eq!(
            (ring.light.name.as_str(), &ring.map),
            ("ring", &EnvironmentMap::new(&Light::ring(), None))
        );
        // The upper half is white and the lower half black: what lies above shows that the picture was read.
        let half: Vec<u8> = (0..32_u8).flat_map(|k| [[255; 3], [0; 3]][usize::from(k / 16)]).collect();
        let rgba: Vec<u8> = half.chunks(3).flat_map(|c| [c[0], c[1], c[2], 255]).collect();
        std::fs::create_dir(at("skies")).unwrap();
        write_rgba_png(&at("skies/half.png"), &rgba, (8, 4), "half").unwrap();
        let bare = load(at("skies/half.png").to_str().unwrap()).unwrap();
        assert_eq!(bare.light.name, "half");
        std::fs::copy(at("skies/half.png"), at("skies/odd.toml")).unwrap();
        assert_eq!(load(at("skies/odd.toml").to_str().unwrap()).unwrap().map, bare.map);
        let named = "name = \"named\"\n[panorama]\nfile = \"half.png\"\n";
        std::fs::write(at("skies/named.light"), named).unwrap();
        let named = load(at("skies/named.light").to_str().unwrap()).unwrap();
        assert_eq!((named.light.name.as_str(), &named.map), ("named", &bare.map));
        let brightest = |sky: &EnvironmentMap| sky.levels[0].iter().map(|t| t[1]).fold(0.0, f32::max);
        assert!((brightest(&bare.map) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_world_is_drawn_anew_from_its_name() {
        let sunset = load("Sunset").unwrap();
        assert_eq!(sunset.light.world, Some(World::Sunset));
        let data = serde_json::to_string(&sunset).unwrap();
        assert!(data.len() < 1000, "the map is in the data: {} bytes", data.len());
        assert!(serde_json::from_str::<Lighting>(&data).unwrap() == sunset);
        let other = data.replace("\"world\":\"sunset\"", "\"world\":\"city\"");
        assert!(serde_json::from_str::<Lighting>(&other).unwrap() != sunset);
        // A world adds to the other parts of its light.
        let lit = Light { dome: Light::dome().dome, ..sunset.light };
        let sum = |map: &EnvironmentMap| map.levels[0].iter().flatten().map(|&c| f64::from(c)).sum::<f64>();
        assert!(sum(&EnvironmentMap::new(&lit, None)) > 1.2 * sum(&sunset.map));
    }

    #[test]
    fn a_world_is_at_hand_coarsely_before_it_is_drawn_and_its_drawing_can_be_stopped() {
        let mut coarse = None;
        let stop = |_: f64| ControlFlow::Break(());
        let stopped = load_watched("city", &stop, |light| coarse = Some(light));
        assert!(matches!(stopped, Err(Failure::Stopped)));
        let coarse = coarse.unwrap();
        let calls = AtomicUsize::new(0);
        let count = |_: f64| {
            calls.fetch_add(1, Ordering::Relaxed);
            ControlFlow::Continue(())
        };
        let whole = load_watched("city", &count, |_| {}).unwrap();
        assert!(calls.into_inner() >= 16, "other work has its turn in between");
        assert!(coarse.light == whole.light && 4 * coarse.map.side < whole.map.side);
        // Both maps hold the same light.
        let mean = |map: &EnvironmentMap| map.levels.last().unwrap().iter().flatten().sum::<f32>();
        let [few, all] = [&coarse, &whole].map(|light| mean(&light.map));
        assert!((few / all - 1.0).abs() < 0.1, "{few} {all}");
        // A light that is drawn quickly is whole at once.
        let mut coarse = None;
        let dome = load_watched("dome", &unwatched, |light| coarse = Some(light)).unwrap();
        assert!(coarse.is_none() && dome == load("dome").unwrap());
    }

    #[test]
    fn what_is_no_light_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let message = |name: &str| refused(folder.path().join(name).to_str().unwrap()).to_string();
        assert_eq!(refused("stuido").to_string(), "no light 'stuido'; did you mean 'studio'?");
        assert!(matches!(refused("stuido"), NameOrFileError::Unknown(_)));
        assert!(refused("moonlight").to_string().contains("studio, dome, "));
        assert!(message("none.toml").ends_with("none.toml: there is no such file"));
        assert!(message("none.exr").ends_with("none.exr: there is no such file"));
        std::fs::write(folder.path().join("bad.toml"), "name = \"x\"\nhead = 95\n").unwrap();
        assert!(message("bad.toml").contains("bad.toml:2: light 1: head is 95"));
        std::fs::write(folder.path().join("lost.toml"), "name = \"x\"\npanorama.file = \"y.hdr\"\n").unwrap();
        assert!(message("lost.toml").ends_with("y.hdr: there is no such file"));
        std::fs::write(folder.path().join("bytes.hdr"), [0xff; 99]).unwrap();
        assert!(message("bytes.hdr").contains("not a picture of a known format"));
    }
}
