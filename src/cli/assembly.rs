use super::Failure;
use super::specimen::Specimen;
use crate::scene::{Placed, Setting};
use std::path::Path;
pub struct Assembly {
    pub path: String,
    pub name: String,
    pub setting: Setting,
    pub light: Option<String>,
}
impl Assembly {
    pub fn load(
        file: &Path,
        material: Option<&str>,
        _size: Option<crate::cut::Size>,
    ) -> Result<Self, Failure> {
        let s = Specimen::load(file)?;
        let material = match material {
            Some(m) => crate::optics::material(m).map_err(|e| Failure::Usage(e.to_string()))?.clone(),
            None => s.material.clone(),
        };
        let unit_mm = s.design.diameter_mm / 2.0;
        Ok(Self {
            path: s.path.clone(),
            name: s.design.name.clone(),
            setting: Setting {
                stones: vec![Placed { polytope: s.stone.polytope.clone(), material }],
                unit_mm,
            },
            light: None,
        })
    }
}
