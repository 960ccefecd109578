use super::Failure;
use crate::scene::{Light, light};
use crate::trace::surround::Sky;
use std::path::Path;
pub struct Lighting {
    pub light: Light,
    pub sky: Sky,
}
impl Lighting {
    pub fn load(name: &str, _beside: Option<&Path>) -> Result<Self, Failure> {
        let light = light(name).ok_or_else(|| Failure::Usage(format!("no light {name}")))?;
        let sky = Sky::new(&light, None);
        Ok(Self { light, sky })
    }
}
