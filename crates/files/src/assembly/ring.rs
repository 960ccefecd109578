//! The stones and the metal of a scene's ring.

use super::{CutKey, Member, NamedMaterial, diameter_mm, named_material};
use crate::mesh_options::MeshPart;
use crate::scene_file::RingEntry;
use brillianteer_base::Failure;
use brillianteer_cut::{MaterialRef, Size};
use brillianteer_math::{NotConvex, ShadedMesh};
use brillianteer_scene::{MetalInstance, Mounting, Pose, RingSeat, SeatKind, SetStone, Specimen};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// The stones and the metal of a scene's ring, placed in the scene, in mm.
pub(super) struct RingParts<'a> {
    /// The stones in their seats.
    pub stones: Vec<Member<'a>>,
    /// The band, the head and all prongs and seats as one body of metal.
    pub metal: MetalInstance,
    /// The metal and the seats of the ring, in its own frame.
    pub mounting: Mounting,
}

/// A stone that a ring holds: its specimen, material and diameter in mm.
struct Gem<'a> {
    specimen: &'a Arc<Specimen>,
    material: NamedMaterial,
    diameter_mm: f64,
}

/// Returns the cuts of a ring's stones, each with its key, the line of the ring, and whether the ring gives its size.
pub(super) fn cuts(entry: &RingEntry) -> impl Iterator<Item = (&'static str, &str, usize, bool)> {
    let cuts = [("stone", &entry.stone, entry.size.is_some()), ("small_stone", &entry.small_stone, true)];
    cuts.into_iter().filter_map(|(key, cut, is_sized)| Some((key, cut.as_deref()?, entry.line, is_sized)))
}

/// Makes the ring of a scene. `material` replaces that of every stone, and `size` that of the main stone.
pub(super) fn ring<'a>(
    file: &Path,
    entry: &RingEntry,
    specimens: &'a BTreeMap<CutKey, Arc<Specimen>>,
    (material, size): (Option<&MaterialRef>, Option<Size>),
) -> Result<RingParts<'a>, Failure> {
    let refused = |message: String| at_ring(file, entry.line, &message);
    let RingGems { main, small } = RingGems::of(entry, specimens, material, size).map_err(refused)?;
    let (stone, small_stone) = (set("stone", &main), set("small_stone", &small));
    let (stone, small_stone) = (stone.map_err(refused)?, small_stone.map_err(refused)?);
    let mounting = entry.ring.mounting(stone.as_ref(), small_stone.as_ref());
    let mounting = mounting.map_err(|error| refused(error.to_string()))?;
    let pose = Pose { at: entry.at_mm, turn: entry.turned(), scale: 1.0 };
    let member = |seat: &RingSeat| {
        let (gem, kind) = match seat.kind {
            SeatKind::Main => (&main, "stone"),
            SeatKind::Small => (&small, "small_stone"),
        };
        let Gem { specimen, material, diameter_mm } = gem.as_ref()?;
        let Pose { at, turn, .. } = pose.after(&seat.pose);
        let description = format!("{kind} of the ring");
        let (material, diameter_mm) = (material.clone(), *diameter_mm);
        Some(Member { specimen, material, diameter_mm, turn, at_mm: at, description })
    };
    let stones = mounting.seats.iter().filter_map(member).collect();
    let mesh = ShadedMesh::new(mounting.surface()).map_err(|error| refused(error.to_string()))?;
    let label = entry.ring.label();
    let (metal, roughness) = (entry.metal, entry.roughness);
    let metal = MetalInstance { mesh: Arc::new(mesh), pose, metal, roughness, label };
    Ok(RingParts { stones, metal, mounting })
}

/// Returns the number of stones that the ring of a scene holds, without making its metal.
pub(super) fn stone_count(
    file: &Path,
    entry: &RingEntry,
    specimens: &BTreeMap<CutKey, Arc<Specimen>>,
) -> Result<usize, Failure> {
    let count = || {
        let RingGems { main, small } = RingGems::of(entry, specimens, None, None)?;
        let (stone, small_stone) = (set("stone", &main)?, set("small_stone", &small)?);
        entry.ring.stone_count(stone.as_ref(), small_stone.as_ref()).map_err(|error| error.to_string())
    };
    count().map_err(|message| at_ring(file, entry.line, &message))
}

/// Returns a stone in the form in which rings take it; the error names its key in the ring's table.
fn set<'a>(key: &str, gem: &Option<Gem<'a>>) -> Result<Option<SetStone<'a>>, String> {
    gem.as_ref().map(Gem::set).transpose().map_err(|error| format!("{key}: {error}"))
}

/// The stones of a ring, of which its style may have none.
struct RingGems<'a> {
    main: Option<Gem<'a>>,
    small: Option<Gem<'a>>,
}

impl<'a> RingGems<'a> {
    /// Takes the stones of a ring from its cuts. `material` replaces that of every stone, and `size` that of the main
    /// stone.
    fn of(
        entry: &RingEntry,
        specimens: &'a BTreeMap<CutKey, Arc<Specimen>>,
        material: Option<&MaterialRef>,
        size: Option<Size>,
    ) -> Result<Self, String> {
        let gem = |cut: &Option<String>, own: &Option<MaterialRef>, size: Option<Size>| {
            let specimen = cut.as_ref().and_then(|cut| specimens.get(&(cut.clone(), MeshPart::Found)));
            specimen.map(|specimen| Gem::new(specimen, material, own.as_ref(), size)).transpose()
        };
        let across = Some(Size::Millimetres(entry.ring.small_diameter_mm));
        let main = gem(&entry.stone, &entry.material, size.or(entry.size))?;
        let small = gem(&entry.small_stone, &entry.small_material, across)?;
        Ok(Self { main, small })
    }
}

impl<'a> Gem<'a> {
    /// Makes the stone of the material `asked`, else of the ring's own, else of the cut file's.
    fn new(
        specimen: &'a Arc<Specimen>,
        asked: Option<&MaterialRef>,
        own: Option<&MaterialRef>,
        size: Option<Size>,
    ) -> Result<Self, String> {
        let material = named_material(specimen, asked, own)?;
        let diameter_mm = diameter_mm(specimen, &material.1, size)?;
        Ok(Self { specimen, material, diameter_mm })
    }

    /// Returns the stone in the form in which rings take it.
    fn set(&self) -> Result<SetStone<'a>, NotConvex> {
        let shape = &self.specimen.stone()?.polytope;
        Ok(SetStone { shape, diameter_mm: self.diameter_mm })
    }
}

/// Returns the failure of a scene's ring.
pub(super) fn at_ring(file: &Path, line: usize, message: &str) -> Failure {
    Failure::Input(format!("{}:{line}: ring: {message}", file.display()))
}

#[cfg(test)]
mod tests {
    use super::super::Assembly;
    use super::*;
    use crate::mesh_options::MeshOptions;
    use crate::scene_file;
    use glam::DVec3;

    #[test]
    fn rings_that_come_with_the_program_hold_their_stones_and_are_centred() {
        for (name, stones, across) in
            [("solitaire", 1, 16.5), ("four-prong", 1, 17.3), ("halo-ring", 17, 16.5), ("eternity", 27, 17.3)]
        {
            let ring = Assembly::load(Path::new(name), None, None, &MeshOptions::default()).unwrap();
            assert_eq!((ring.scene.instances.len(), ring.scene.metals.len()), (stones, 1), "{name}");
            assert_eq!(ring.places.len(), stones, "{name}");
            let file = scene_file::parse(crate::library::scene(name).unwrap(), name, None).unwrap();
            assert_eq!(super::super::stone_count(Path::new(name), &file).unwrap(), stones, "{name}");
            let metal = &ring.scene.metals[0];
            // The finger's hole keeps its size in the world's unit.
            let pose = metal.pose;
            let from_axis = |point: &DVec3| {
                let own = (pose.turn.inverse() * (*point - pose.at)) * ring.scene.unit_mm;
                own.x.hypot(own.z)
            };
            let hole = metal.vertices().map(|point| from_axis(&point)).fold(f64::INFINITY, f64::min);
            assert!((2.0 * hole - across).abs() < 0.01, "{name}: {hole}");
            // Seats in the world are the mounting's, carried there.
            let mounting = &ring.ring.as_ref().unwrap().mounting;
            for (seat, stone) in mounting.seats.iter().zip(&ring.scene.instances) {
                let carried = pose.after(&seat.pose);
                assert!(carried.at.distance(stone.pose.at) < 1e-9, "{name}");
                assert!((carried.scale - stone.pose.scale).abs() < 1e-9, "{name}");
            }
            let corners = metal
                .vertices()
                .chain(ring.scene.instances.iter().flat_map(|s| s.solid().vertices().collect::<Vec<_>>()));
            let (low, high) = brillianteer_math::bounds(corners);
            assert!((low + high).length() < 1e-9, "{name}");
        }
    }

    #[test]
    fn a_ring_takes_another_material_and_size_and_says_what_does_not_fit() {
        let ruby = MaterialRef::Name("ruby".to_owned());
        let ruby =
            Assembly::load(Path::new("halo-ring"), Some(&ruby), "7mm".parse().ok(), &MeshOptions::default());
        let ruby = ruby.unwrap();
        assert!(ruby.scene.instances.iter().all(|stone| stone.material.name == "ruby"));
        assert_eq!((ruby.places[0].diameter_mm, ruby.places[1].diameter_mm), (7.0, 1.5));
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.toml");
        for (stone, message) in [
            ("stone = \"pill\"", "x.toml:3: ring: stone: "),
            ("stone = \"tolkowskj\"", "x.toml:3: ring: stone: "),
            (
                "stone = \"tolkowsky\"\nsize = \"2mm\"",
                "x.toml:3: ring: prong_diameter_mm: neighbouring prongs come too near",
            ),
        ] {
            let ring = format!("[ring]\nstyle = \"six-prong\"\nmetal = \"gold\"\n{stone}\n");
            std::fs::write(&path, format!("format = 1\nname = \"x\"\n{ring}")).unwrap();
            let Err(Failure::Input(text)) = Assembly::load(&path, None, None, &MeshOptions::default()) else {
                panic!("no input error")
            };
            let text = text.replace(&path.display().to_string(), "x.toml");
            assert!(text.starts_with(message), "{text}\ninstead of\n{message}");
        }
    }
}
