//! The stones and the metal of a scene.

use brillianteer_base::ByName;
use brillianteer_files::assembly::{Assembly, MadeRing};
use brillianteer_scene::{ALLOYS, Alloy};
use serde::{Deserialize, Serialize};

/// A scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneInfo {
    /// The path of the file, or the name of a scene that comes with the program.
    pub file: String,
    /// The name of the scene.
    pub name: String,
    /// The light: the name of one that comes with the program, or a file.
    pub light: String,
    /// The unit of length, mm: half the largest diameter.
    pub unit_mm: f64,
    /// The weight of all stones together, carats; `None` where one has none.
    pub carats: Option<f64>,
    /// The ring that is made for the scene.
    pub ring: Option<RingInfo>,
    /// The stones.
    pub stones: Vec<PlacedStone>,
    /// The metal.
    pub metals: Vec<MetalInfo>,
}

/// A stone of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlacedStone {
    /// The name of the cut.
    pub cut: String,
    /// The name of the material.
    pub material: String,
    /// The girdle diameter, mm.
    pub diameter_mm: f64,
    /// The weight, carats; `None` where the material's density is not known.
    pub carats: Option<f64>,
    /// The middle of the girdle, mm.
    pub at_mm: [f64; 3],
}

/// A piece of metal of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MetalInfo {
    /// The file of its mesh; the style of a ring.
    pub mesh: String,
    /// The name of the metal.
    pub metal: String,
    /// The roughness of its surface, from 0 to 1.
    pub roughness: f64,
}

/// A ring that is made for a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RingInfo {
    /// The name of the metal.
    pub metal: String,
    /// The volume of the metal, mm³.
    pub volume_mm3: f64,
    /// The weight of the metal, g, by the name of each alloy of which it may be made.
    pub grams: ByName<f64>,
    /// The height of the culet above the finger, mm; `None` where there is none.
    pub culet_height_mm: Option<f64>,
    /// The gap between small stones, mm; `None` where there are none.
    pub small_gap_mm: Option<f64>,
}

impl SceneInfo {
    /// Describes a scene.
    pub fn of(assembly: &Assembly) -> Self {
        let unit_mm = assembly.scene.unit_mm;
        let stones =
            assembly.scene.instances.iter().zip(&assembly.places).map(|(stone, place)| PlacedStone {
                cut: stone.label.clone(),
                material: stone.material.name.clone(),
                diameter_mm: place.diameter_mm,
                carats: stone.carats(unit_mm),
                at_mm: place.at_mm.to_array(),
            });
        let metals = assembly.scene.metals.iter().map(|metal| MetalInfo {
            mesh: metal.label.clone(),
            metal: metal.metal.name().to_owned(),
            roughness: metal.roughness,
        });
        Self {
            file: assembly.path.clone(),
            name: assembly.name.clone(),
            light: assembly.look.light.clone(),
            unit_mm,
            carats: assembly.carats(),
            ring: assembly.ring.as_ref().map(RingInfo::of),
            stones: stones.collect(),
            metals: metals.collect(),
        }
    }
}

impl RingInfo {
    /// Describes a ring.
    fn of(ring: &MadeRing) -> Self {
        let mounting = &ring.mounting;
        let volume_mm3 = mounting.volume_mm3();
        let alloys = ALLOYS.iter().filter(|alloy| alloy.metal == ring.metal);
        let grams = |alloy: &Alloy| (alloy.name, alloy.grams(volume_mm3));
        Self {
            metal: ring.metal.name().to_owned(),
            volume_mm3,
            grams: alloys.map(grams).collect(),
            culet_height_mm: mounting.culet_height_mm,
            small_gap_mm: mounting.small_gap_mm,
        }
    }
}
