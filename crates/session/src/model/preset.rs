//! Scenes that the editor can work on: copies of one design with their companions, light and backplate.

use super::render_settings::RenderSettings;
use brillianteer_base::{Failure, FileError};
use brillianteer_cut::{Cut, Design, MaterialRef};
use brillianteer_files::assembly::{Assembly, StonePlace};
use brillianteer_files::library;
use brillianteer_files::scene_file::{self, RingEntry, SceneFile};
use brillianteer_scene::{
    Companion, Companions, Copies, Pose, RingPlan, RingSeat, SceneRing, SeatKind, Specimen,
};
use std::path::Path;
use std::sync::Arc;

/// A scene of glass that comes with the program.
#[derive(Debug)]
pub struct Known {
    /// The name by which [`Preset::of_library`] finds the scene.
    pub name: &'static str,
    /// The title in menus.
    pub title: &'static str,
    /// True where the scene begins to move at once.
    pub moves: bool,
}

/// All scenes of glass that come with the program, in menu order.
pub static PRESETS: [Known; 5] = [
    Known { name: "subtle-pill", title: "Subtle pill", moves: false },
    Known { name: "prism-rainbow", title: "Prism rainbow", moves: false },
    Known { name: "rotating-cube", title: "Rotating cube", moves: true },
    Known { name: "wavy-plate", title: "Wavy plate", moves: true },
    Known { name: "free-diamond", title: "Free diamond", moves: true },
];

impl Known {
    /// Returns whether a scene is this one, whatever file it was read from.
    fn is(&self, scene: &SceneFile) -> bool {
        let text = library::scene(self.name).unwrap_or_default();
        scene_file::parse(text, self.name, None).is_ok_and(|own| own == *scene)
    }
}

/// A scene that the editor can work on.
#[derive(Debug, Clone)]
pub struct Preset {
    /// The design of the first stone, with its material and size.
    pub design: Design,
    /// The stones of that design.
    pub copies: Copies,
    /// All other stones, and the metal, in mm.
    pub companions: Companions,
    /// The scene that comes with the program and that this is, if any.
    pub known: Option<&'static Known>,
    /// Notes and warnings about the files that were read.
    pub remarks: Vec<String>,
    /// The scene file, which holds light, background and all other settings.
    pub scene: SceneFile,
}

impl Preset {
    /// Returns a scene that comes with the program.
    ///
    /// # Errors
    /// Fails where no scene of that name comes with the program.
    pub fn of_library(name: &str) -> Result<Self, Failure> {
        let text = library::scene(name)
            .ok_or_else(|| FileError::new(name, "no scene of this name comes with the program"))?;
        Self::new(Path::new(name), scene_file::parse(text, name, None)?)
    }

    /// Returns the scene that shows a shape of glass at its best; `None` for any other cut.
    pub fn of_glass(cut: &Cut) -> Option<Self> {
        let Cut::Glass(_) = cut else { return None };
        let family = cut.family()?;
        let presets = PRESETS.iter().filter_map(|known| Self::of_library(known.name).ok());
        let is_of_family =
            |preset: &Self| preset.design.cut.family().is_some_and(|own| own.key == family.key);
        presets.into_iter().find(is_of_family)
    }

    /// Returns the settings of pictures of the scene.
    pub fn settings(&self) -> RenderSettings {
        RenderSettings::of_scene(&self.scene)
    }

    /// Returns whether the scene begins to move at once.
    pub fn moves(&self) -> bool {
        self.known.is_some_and(|known| known.moves)
    }

    /// Reads a scene file.
    ///
    /// # Errors
    /// Fails where the file cannot be read, is no scene, or has no stone.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        Self::new(path, scene_file::read(path)?)
    }

    fn new(file: &Path, scene: SceneFile) -> Result<Self, Failure> {
        let Assembly { scene: whole, places, ring, remarks, .. } = Assembly::of(file, scene.clone())?;
        let Some(first) = places.first() else {
            let label = file.display().to_string();
            let problem = format!(
                "the editor needs a stone to work on; draw this scene by `brillianteer render {label}`"
            );
            return Err(FileError::new(&label, problem).into());
        };
        let design = design_of(first);
        let unit_mm = 0.5 * design.diameter_mm;
        let seats: Arc<[RingSeat]> = ring.map_or_else(Arc::default, |ring| ring.mounting.seats.into());
        // The stones of the ring are the last of the scene, in the order of their seats.
        let loose = places.len() - seats.len();
        let seat = |number: usize| number.checked_sub(loose).map(|seat| seats[seat].kind);
        let first_kind = Kind::of(first, seat(0));
        let in_mm = |pose: &Pose| Pose { scale: whole.unit_mm, ..Pose::STILL }.after(pose);
        let (mut poses, mut stones, mut made) = (vec![], vec![], vec![]);
        for (number, (instance, place)) in whole.instances.iter().zip(&places).enumerate() {
            let pose = in_mm(&instance.pose);
            let kind = Kind::of(place, seat(number));
            if kind == first_kind {
                poses.push(Pose { at: pose.at / unit_mm, scale: 1.0, ..pose })
            } else {
                stones.push(Companion { specimen: specimen_of(place, kind, &mut made)?, pose })
            }
        }
        let metals = whole.metals.into_iter();
        let larger = Pose { scale: whole.unit_mm, ..Pose::STILL };
        let metals: Vec<_> = metals.map(|metal| metal.moved(&larger)).collect();
        let mut copies = Copies::at(poses, first.specimen.solid().vertices());
        copies.movement = scene.movement;
        let companions =
            with_ring(Companions { stones, metals, ring: None }, &scene, seats, (&design, &copies))?;
        let known = PRESETS.iter().find(|known| known.is(&scene));
        Ok(Self { copies, companions, design, scene, remarks, known })
    }
}

/// Returns the companions with the ring of a scene, whose metal is the last of theirs.
fn with_ring(
    companions: Companions,
    scene: &SceneFile,
    seats: Arc<[RingSeat]>,
    (design, copies): (&Design, &Copies),
) -> Result<Companions, Failure> {
    let (Some(RingEntry { ring, .. }), Some(metal)) = (&scene.ring, companions.metals.len().checked_sub(1))
    else {
        return Ok(companions);
    };
    let ring = SceneRing { ring: ring.clone(), made_of: RingPlan::default(), seats, metal };
    let mut companions = Companions { ring: Some(ring), ..companions };
    let own = Specimen::new(design.clone()).map_err(|error| Failure::Input(error.to_string()))?;
    let plan = companions.ring_plan(&Arc::new(own), copies.poses[0].at * 0.5 * design.diameter_mm);
    if let (Some(ring), Some(plan)) = (&mut companions.ring, plan) {
        ring.made_of = plan;
    }
    Ok(companions)
}

/// The key of stones of one kind: their cut, material and size, and the kind of their seat if a ring holds them.
#[derive(Clone, Copy, PartialEq)]
struct Kind<'a>(*const Specimen, &'a MaterialRef, f64, Option<SeatKind>);

impl<'a> Kind<'a> {
    fn of(place: &'a StonePlace, seat: Option<SeatKind>) -> Self {
        Self(Arc::as_ptr(&place.specimen), &place.material, place.diameter_mm, seat)
    }
}

/// Returns the design of a stone in the scene, with the material and size that the scene states for it.
fn design_of(place: &StonePlace) -> Design {
    let StonePlace { specimen, material, diameter_mm, .. } = place;
    Design { material: material.clone(), diameter_mm: *diameter_mm, ..specimen.design.clone() }
}

/// Returns the stone of a place; stones of one kind share it.
fn specimen_of<'a>(
    place: &'a StonePlace,
    kind: Kind<'a>,
    made: &mut Vec<(Kind<'a>, Arc<Specimen>)>,
) -> Result<Arc<Specimen>, Failure> {
    if let Some((_, specimen)) = made.iter().find(|(other, _)| *other == kind) {
        return Ok(Arc::clone(specimen));
    }
    let specimen = place.specimen.remade(design_of(place));
    let specimen = Arc::new(specimen.map_err(|error| Failure::Input(error.to_string()))?);
    made.push((kind, Arc::clone(&specimen)));
    Ok(specimen)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn the_presets_are_as_their_files_say_and_no_copy_is_put_behind_another() {
        for Known { name, moves, .. } in &PRESETS {
            let preset = Preset::of_library(name).unwrap();
            let specimen = Specimen::new(preset.design.clone()).unwrap();
            let corners = specimen.solid().vertices();
            assert_eq!(preset.copies.poses(corners, None), preset.copies.poses, "{name}");
            for seconds in [0.0, 0.4, 1.1, 2.3] {
                let cut = preset.copies.movement.waved(&preset.design.cut, seconds);
                let cut = cut.unwrap_or_else(|| preset.design.cut.clone());
                let specimen = Specimen::new(Design { cut, ..preset.design.clone() }).unwrap();
                let moving = preset.copies.poses(specimen.solid().vertices(), Some(seconds));
                let stay = moving.iter().zip(&preset.copies.poses).all(|(now, rest)| now.at == rest.at);
                assert!(stay || !moves, "{name} has no room to move");
            }
            assert_eq!(preset.copies.poses.len(), if *name == "free-diamond" { 1 } else { 4 });
        }
        let pill = Preset::of_library("subtle-pill").unwrap();
        assert_eq!((pill.design.diameter_mm, pill.scene.look.strength), (40.0, 0.035));
        // Twenty millimetres are a radius.
        assert!((pill.copies.poses[0].at - DVec3::new(-0.25, 1.005, 0.0)).length() < 1e-9);
    }

    #[test]
    fn of_a_scene_of_several_designs_the_first_is_edited_and_all_stands_where_the_file_says() {
        for (name, copies, stones, metals) in [
            ("trilogy", 1, 2, 0),
            ("ring", 1, 7, 0),
            ("parcel", 3, 9, 0),
            ("halo-ring", 1, 16, 1),
            ("eternity", 27, 0, 1),
        ] {
            let preset = Preset::of_library(name).unwrap();
            let Companions { stones: beside, metals: metal, .. } = &preset.companions;
            assert_eq!(
                (preset.copies.poses.len(), beside.len(), metal.len()),
                (copies, stones, metals),
                "{name}"
            );
            let unit_mm = 0.5 * preset.design.diameter_mm;
            let assembly = Assembly::of(Path::new(name), preset.scene.clone()).unwrap();
            let (mut own, mut others) = (preset.copies.poses.iter(), beside.iter());
            for (instance, place) in assembly.scene.instances.iter().zip(&assembly.places) {
                let corner = instance.pose.place(DVec3::new(0.3, -0.2, 0.1)) * assembly.scene.unit_mm;
                let is_first = Kind::of(place, None) == Kind::of(&assembly.places[0], None);
                let at = if is_first {
                    own.next().unwrap().place(DVec3::new(0.3, -0.2, 0.1)) * unit_mm
                } else {
                    others.next().unwrap().pose.place(DVec3::new(0.3, -0.2, 0.1))
                };
                assert!(at.distance(corner) < 1e-9, "{name}: {at} instead of {corner}");
            }
            assert!(own.next().is_none() && others.next().is_none());
            let highest = |scene: f64, metals: &[brillianteer_scene::MetalInstance]| {
                metals.iter().flat_map(|m| m.vertices().map(|v| v.z * scene)).fold(0.0, f64::max)
            };
            let was = highest(assembly.scene.unit_mm, &assembly.scene.metals);
            assert!((highest(1.0, metal) - was).abs() < 1e-9, "{name}");
        }
        let trilogy = Preset::of_library("trilogy").unwrap();
        let names: Vec<&str> =
            trilogy.companions.stones.iter().map(|s| s.specimen.material.name.as_str()).collect();
        assert_eq!(names, ["diamond", "emerald"]);
    }

    #[test]
    fn a_scene_of_metal_alone_is_refused_with_what_draws_it() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("plate.obj"), "v 0 0 0\nv 4 0 0\nv 0 8 0\nf 1 2 3\n").unwrap();
        let path = folder.path().join("x.toml");
        std::fs::write(
            &path,
            "format = 1\nname = \"x\"\n[[metal]]\nmesh = \"plate.obj\"\nmetal = \"gold\"\n",
        )
        .unwrap();
        let why = Preset::read(&path).err().unwrap();
        assert!(why.to_string().contains("brillianteer render"), "{why}");
    }
}
