//! The bodies that a picture under light shows: a single stone, or the stones and the metal of a scene in their places.

use super::built_design::{BuiltDesign, OtherReadings};
use super::mesh::read_shaded;
use super::mesh_options::{MeshOptions, MeshPart};
use super::scene_file::{self, Entry, MetalEntry, SceneFile};
use super::{is_standard, library};
use brillianteer_base::Failure;
use brillianteer_cut::{Design, MaterialRef, Size};
use brillianteer_math::{ShadedMesh, bounds};
use brillianteer_optics::{Material, Metal};
use brillianteer_scene::{
    Instance, Look, MOST_STONES, MetalInstance, Mounting, Movement, Pose, Projection, Scene, Specimen,
    Viewpoint, overlapping,
};
use glam::{DQuat, DVec3};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

mod moment;
mod ring;

#[cfg(test)]
mod tests;

/// A single stone or the stones of a scene, with what its pictures are made with.
#[derive(Debug)]
pub struct Assembly {
    /// The path of the file, or the name of the cut or scene that comes with the program.
    pub path: String,
    /// The name of the design, or of the scene.
    pub name: String,
    /// The design of a stone alone, in its own material; none of a scene.
    pub design: Option<Design>,
    /// The stones in one world. A single stone lies unmoved in its own frame.
    pub scene: Scene,
    /// The kind and the place of each stone, in the order of the instances of `scene`.
    pub places: Vec<StonePlace>,
    /// What pictures of the scene are made with; the usual of a stone alone.
    pub look: Look,
    /// How plates move where time goes on.
    pub movement: Movement,
    /// The angle of view of the scene's perspective, in degrees, if it has one.
    pub angle_of_view: Option<f64>,
    /// The scene's ring.
    pub ring: Option<MadeRing>,
    /// Notes and warnings about the files that were read, each with its path, as they are printed.
    pub remarks: Vec<String>,
    /// Whether other options read the files of the stones in another way, in the order in which they were read.
    pub other_readings: Vec<OtherReadings>,
}

/// A ring that was made for a scene.
#[derive(Debug)]
pub struct MadeRing {
    /// The metal.
    pub metal: Metal,
    /// The metal and the seats of the ring, in its own frame, in mm.
    pub mounting: Mounting,
}

/// The kind of a stone, and its place.
#[derive(Debug, Clone)]
pub struct StonePlace {
    /// The stone in the material and size of its own file; the scene may state others. Stones of one cut share it.
    pub specimen: Arc<Specimen>,
    /// The material.
    pub material: MaterialRef,
    /// The girdle diameter, in mm.
    pub diameter_mm: f64,
    /// The middle of the girdle, in mm.
    pub at_mm: DVec3,
}

/// A material with its name in files.
type NamedMaterial = (MaterialRef, Material);

/// A stone of a scene, in mm: the world's unit is not known yet.
#[derive(Clone)]
struct Member<'a> {
    specimen: &'a Arc<Specimen>,
    material: NamedMaterial,
    diameter_mm: f64,
    turn: DQuat,
    at_mm: DVec3,
    /// The stone's name in error messages.
    description: String,
}

impl Assembly {
    /// Reads a cut file or a scene file, or takes a cut or a scene that comes with the program by its name.
    ///
    /// `material` and `size` replace those of every stone. Every mesh is read with the options `mesh`.
    ///
    /// # Errors
    /// Fails where a file cannot be read or makes no stone, where a material is unknown, or where stones overlap.
    pub fn load(
        file: &Path,
        material: Option<&MaterialRef>,
        size: Option<Size>,
        mesh: &MeshOptions,
    ) -> Result<Self, Failure> {
        match Self::load_scene(file, material, size, mesh)? {
            Some(scene) => Ok(scene),
            None => Self::of_stone(BuiltDesign::load(file, mesh)?, material, size),
        }
    }

    /// Reads a scene file, or takes a scene that comes with the program, as [`load`](Self::load) does; `None` where it is no
    /// scene.
    ///
    /// # Errors
    /// Fails where [`load`](Self::load) does.
    pub fn load_scene(
        file: &Path,
        material: Option<&MaterialRef>,
        size: Option<Size>,
        mesh: &MeshOptions,
    ) -> Result<Option<Self>, Failure> {
        let scene = scene(file)?;
        scene.map(|scene| Self::of_scene(file, scene, material, (size, mesh))).transpose()
    }

    /// Assembles a scene that was read from a file, or that comes with the program; `file` is its path or name.
    ///
    /// # Errors
    /// Fails where [`load`](Self::load) does.
    pub fn of(file: &Path, scene: SceneFile) -> Result<Self, Failure> {
        Self::of_scene(file, scene, None, (None, &MeshOptions::default()))
    }

    fn of_stone(
        stone: BuiltDesign,
        material: Option<&MaterialRef>,
        size: Option<Size>,
    ) -> Result<Self, Failure> {
        let other_readings = vec![stone.other_readings()];
        let BuiltDesign { path, made, remarks, .. } = stone;
        let refused = |message| Failure::Input(format!("{path}: {message}"));
        let named = named_material(&made, material, None).map_err(refused)?;
        let diameter_mm = diameter_mm(&made, &named.1, size).map_err(refused)?;
        let made = Arc::new(made);
        let stone = Instance::of(&made.body, named.1, &made.design.name);
        let place =
            StonePlace { specimen: Arc::clone(&made), material: named.0, diameter_mm, at_mm: DVec3::ZERO };
        Ok(Self {
            path,
            name: made.design.name.clone(),
            design: Some(Design { diameter_mm, ..made.design.clone() }),
            scene: Scene { instances: vec![stone], metals: vec![], unit_mm: 0.5 * diameter_mm },
            places: vec![place],
            look: Look::default(),
            movement: Movement::default(),
            angle_of_view: None,
            ring: None,
            remarks,
            other_readings,
        })
    }

    fn of_scene(
        file: &Path,
        scene: SceneFile,
        material: Option<&MaterialRef>,
        (size, mesh): (Option<Size>, &MeshOptions),
    ) -> Result<Self, Failure> {
        let path = file.display().to_string();
        let ReadCuts { specimens, mut remarks, other_readings } = read_cuts(file, &scene, mesh)?;
        let member = |(number, entry): (usize, &Entry)| {
            let specimen = &specimens[&(entry.cut.clone(), entry.part.clone())];
            let description = format!("stone {} ({})", number + 1, entry.cut);
            member(specimen, entry, material, size.or(entry.size), description)
                .map_err(|message| at_entry(file, number, entry, &message))
        };
        let kinds = scene.stones.iter().enumerate().map(member).collect::<Result<Vec<_>, _>>()?;
        let turned = |(kind, turn): (usize, DQuat)| Member { turn, ..kinds[kind].clone() };
        let mut members: Vec<Member> = scene.turns().into_iter().map(turned).collect();
        let radii: Vec<f64> = members.iter().map(Member::radius_mm).collect();
        members.iter_mut().zip(scene.places_mm(&radii)).for_each(|(member, at)| member.at_mm = at);
        let mut metals = metals(file, &scene, &mut remarks)?;
        let ring = match &scene.ring {
            Some(entry) => {
                let parts = ring::ring(file, entry, &specimens, (material, size))?;
                members.extend(parts.stones);
                metals.push(parts.metal);
                Some(MadeRing { metal: entry.metal, mounting: parts.mounting })
            }
            None => None,
        };
        if members.len() > MOST_STONES {
            let count = members.len();
            return Err(Failure::Input(format!(
                "{path}: {count} stones are too many, at most {MOST_STONES}"
            )));
        }
        let stones = placed(&members, metals);
        if let Some((a, b)) = overlapping(&stones.instances) {
            let (a, b) = (&members[a].description, &members[b].description);
            return Err(Failure::Input(format!("{path}: {a} and {b} overlap; move one of them away")));
        }
        let places = members.iter().map(Member::place).collect();
        Ok(Self {
            path,
            name: scene.name,
            design: None,
            scene: stones,
            places,
            look: scene.look,
            movement: scene.movement,
            angle_of_view: scene.angle_of_view,
            ring,
            remarks,
            other_readings,
        })
    }

    /// Returns the viewpoint of the scene: in its perspective, unless the viewpoint has one of its own.
    pub fn seen_from(&self, viewpoint: Viewpoint) -> Viewpoint {
        let Some(angle) = self.angle_of_view else { return viewpoint };
        if viewpoint.projection != Projection::Orthographic {
            return viewpoint;
        }
        let reach =
            self.scene.vertices().map(|corner| corner.truncate().abs().max_element()).fold(0.0, f64::max);
        let distance = reach / (0.5 * angle).to_radians().tan();
        Viewpoint { projection: Projection::Perspective { distance }, ..viewpoint }
    }

    /// Returns the weight of all stones together, in carats; `None` if one has no density.
    pub fn carats(&self) -> Option<f64> {
        // A sum of no numbers begins at -0.
        let mut stones = self.scene.instances.iter().map(|stone| stone.carats(self.scene.unit_mm));
        stones.try_fold(0.0, |sum, carats| Some(sum + carats?))
    }
}

/// Returns the number of stones of a scene, without assembling it: the metal of a ring is not made. `file` is the path or the
/// name of the scene.
///
/// # Errors
/// Fails where a cut of a ring cannot be read, or where its numbers leave no place for its stones.
pub fn stone_count(file: &Path, scene: &SceneFile) -> Result<usize, Failure> {
    let listed: usize = scene.stones.iter().map(|entry| entry.count).sum();
    let Some(entry) = &scene.ring else { return Ok(listed) };
    let cuts = read_cuts(file, scene, &MeshOptions::default())?;
    Ok(listed + ring::stone_count(file, entry, &cuts.specimens)?)
}

/// Returns the scene in a file, or the scene of that name that comes with the program; `None` where it is not a scene.
fn scene(file: &Path) -> Result<Option<SceneFile>, Failure> {
    if file.is_file() || is_standard(file) {
        return Ok(scene_file::read_if_scene(file)?);
    }
    let name = file.display().to_string();
    let known = library::scene(&name).map(|text| scene_file::parse(text, &name, None));
    Ok(known.transpose()?)
}

/// The name by which a scene calls a cut, and the body of it where it is a mesh of several.
type CutKey = (String, MeshPart);

/// The cuts of a scene, and the remarks about their files.
#[derive(Default)]
struct ReadCuts {
    specimens: BTreeMap<CutKey, Arc<Specimen>>,
    remarks: Vec<String>,
    other_readings: Vec<OtherReadings>,
}

impl ReadCuts {
    /// Takes a cut. Where its file has several bodies, the key may name the one that is meant.
    fn take(&mut self, key: CutKey, read: BuiltDesign) {
        let readings = read.other_readings();
        let of_bodies = readings.of_bodies && key.1 == MeshPart::Found;
        self.other_readings.push(OtherReadings { of_bodies, ..readings });
        self.remarks.extend(read.remarks);
        self.specimens.insert(key, Arc::new(read.made));
    }
}

/// Reads each cut of a scene once, and each of its bodies that the scene takes.
fn read_cuts(file: &Path, scene: &SceneFile, mesh: &MeshOptions) -> Result<ReadCuts, Failure> {
    let mut cuts = ReadCuts::default();
    let failed = |failure: Failure, place: &dyn Fn(&str) -> Failure| match failure {
        Failure::Input(message) => place(&message),
        other => other,
    };
    for (number, entry) in scene.stones.iter().enumerate() {
        let key = (entry.cut.clone(), entry.part.clone());
        if !cuts.specimens.contains_key(&key) {
            // A scene that names no body leaves it to the options.
            let part = if entry.part == MeshPart::Found { &mesh.part } else { &entry.part };
            let mesh = MeshOptions { part: part.clone(), ..mesh.clone() };
            let at = |message: &str| at_entry(file, number, entry, &format!("cut: {message}"));
            let mut same = scene.stones.iter().filter(|other| other.cut == entry.cut);
            let mesh = if same.all(|other| other.size.is_some()) { mesh.sized(entry.size) } else { mesh };
            let read = built(file, &entry.cut, &mesh).map_err(|failure| failed(failure, &at))?;
            cuts.take(key, read);
        }
    }
    for (key, cut, line, is_sized) in scene.ring.iter().flat_map(ring::cuts) {
        let own = (cut.to_owned(), MeshPart::Found);
        if !cuts.specimens.contains_key(&own) {
            let at = |message: &str| ring::at_ring(file, line, &format!("{key}: {message}"));
            let mesh = if is_sized { mesh.clone().of_any_size() } else { mesh.clone() };
            let read = built(file, cut, &mesh).map_err(|failure| failed(failure, &at))?;
            cuts.take(own, read);
        }
    }
    Ok(cuts)
}

/// Reads one cut of a scene: a cut that comes with the program, or a file relative to the scene's folder. Where both exist,
/// a scene read from a file takes the file, and any other scene takes the program's cut.
fn built(scene: &Path, cut: &str, mesh: &MeshOptions) -> Result<BuiltDesign, Failure> {
    let beside = scene.parent().unwrap_or(Path::new("")).join(cut);
    match library::cut(cut).filter(|_| !scene.is_file() || !beside.is_file()) {
        Some(text) => BuiltDesign::parse(cut, text),
        None => BuiltDesign::read(&beside, mesh),
    }
}

fn at_entry(file: &Path, number: usize, entry: &Entry, message: &str) -> Failure {
    Failure::Input(format!("{}:{}: stone {}: {message}", file.display(), entry.line, number + 1))
}

/// Returns the material that `asked` replaces it by, else the scene's own, else that of the stone's file.
fn named_material(
    specimen: &Specimen,
    asked: Option<&MaterialRef>,
    own: Option<&MaterialRef>,
) -> Result<NamedMaterial, String> {
    match asked.or(own) {
        Some(named) => Ok((named.clone(), named.material().map_err(|error| error.to_string())?)),
        None => Ok((specimen.design.material.clone(), specimen.material.clone())),
    }
}

fn diameter_mm(specimen: &Specimen, material: &Material, size: Option<Size>) -> Result<f64, String> {
    let diameter = |size: Size| size.diameter_mm(specimen.solid().volume(), material);
    size.map_or(Ok(specimen.design.diameter_mm), diameter).map_err(|error| format!("size: {error}"))
}

fn member<'a>(
    specimen: &'a Arc<Specimen>,
    entry: &Entry,
    material: Option<&MaterialRef>,
    size: Option<Size>,
    description: String,
) -> Result<Member<'a>, String> {
    let material = named_material(specimen, material, entry.material.as_ref())?;
    let diameter_mm = diameter_mm(specimen, &material.1, size)?;
    Ok(Member { specimen, material, diameter_mm, turn: DQuat::IDENTITY, at_mm: entry.at_mm, description })
}

impl Member<'_> {
    fn place(&self) -> StonePlace {
        StonePlace {
            specimen: Arc::clone(self.specimen),
            material: self.material.0.clone(),
            diameter_mm: self.diameter_mm,
            at_mm: self.at_mm,
        }
    }

    /// Returns the radius, in mm, of the circle around the axis that holds the turned stone, seen from above.
    fn radius_mm(&self) -> f64 {
        let across = |v: &DVec3| (self.turn * *v).truncate().length();
        let radii = self.specimen.solid().vertices().iter().map(across);
        0.5 * self.diameter_mm * radii.fold(0.0, f64::max)
    }
}

/// Reads the metal of a scene, each file once, and places it in mm.
fn metals(file: &Path, scene: &SceneFile, remarks: &mut Vec<String>) -> Result<Vec<MetalInstance>, Failure> {
    let mut meshes: BTreeMap<String, Arc<ShadedMesh>> = BTreeMap::new();
    let mut metal = |(number, entry): (usize, &MetalEntry)| {
        let mesh = match meshes.get(&entry.mesh) {
            Some(mesh) => Arc::clone(mesh),
            None => {
                let path = file.parent().unwrap_or(Path::new("")).join(&entry.mesh);
                let (mesh, warnings) = read_shaded(&path).map_err(|error| {
                    let place = format!("{}:{}: metal {}", file.display(), entry.line, number + 1);
                    Failure::Input(format!("{place}: mesh: {error}"))
                })?;
                remarks.extend(warnings.iter().map(|w| format!("warning: {}: {w}", path.display())));
                let mesh = Arc::new(mesh);
                meshes.insert(entry.mesh.clone(), Arc::clone(&mesh));
                mesh
            }
        };
        let pose = Pose { at: entry.at_mm, turn: entry.turned(), scale: entry.scale };
        let label = entry.mesh.clone();
        Ok(MetalInstance { mesh, pose, metal: entry.metal, roughness: entry.roughness, label })
    };
    scene.metals.iter().enumerate().map(&mut metal).collect()
}

/// Builds the world's scene of stones and of metal, whose poses are in mm. The largest girdle has the radius 1; without stones,
/// so has the metal. Several bodies, or a stone that is not at the origin, are centred on the origin together.
fn placed(members: &[Member], metals: Vec<MetalInstance>) -> Scene {
    let across = |metal: &MetalInstance| {
        let (low, high) = bounds(metal.vertices());
        (high - low).max_element()
    };
    let diameters = members.iter().map(|m| m.diameter_mm);
    let unit_mm = if members.is_empty() {
        0.5 * metals.iter().map(across).fold(0.0, f64::max)
    } else {
        0.5 * diameters.fold(0.0, f64::max)
    };
    let place = |m: &Member| {
        let stone = Instance::of(&m.specimen.body, m.material.1.clone(), &m.specimen.design.name);
        let scale = 0.5 * m.diameter_mm / unit_mm;
        stone.moved(&Pose { at: m.at_mm / unit_mm, turn: m.turn, scale })
    };
    let to_world = Pose { scale: 1.0 / unit_mm, ..Pose::STILL };
    let stones: Vec<Instance> = members.iter().map(place).collect();
    let scene = Scene {
        instances: stones,
        metals: metals.into_iter().map(|metal| metal.moved(&to_world)).collect(),
        unit_mm,
    };
    // Pictures are centred on the origin.
    let (low, high) = scene.bounds();
    let stays = scene.metals.is_empty() && members.len() == 1 && members[0].at_mm == DVec3::ZERO;
    let shift = if stays { DVec3::ZERO } else { -(low + high) / 2.0 };
    scene.moved(&Pose { at: shift, ..Pose::STILL })
}
