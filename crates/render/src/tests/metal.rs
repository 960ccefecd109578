//! Jobs with metal.

use super::*;
use brillianteer_math::{ShadedMesh, ShadedSurface};
use brillianteer_optics::Metal;
use brillianteer_scene::MetalInstance;

#[test]
fn metal_is_planned_to_a_card_where_there_is_one_else_to_rays_and_never_to_beams() {
    let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
    let surface = ShadedSurface { points, corners: vec![[0, 1, 2]], normals: vec![] };
    let plate = Arc::new(ShadedMesh::new(surface).unwrap());
    let plate = MetalInstance::new(&plate, Metal::Gold);
    let scene = Scene { metals: vec![plate.clone()], ..Scene::alone(&specimen("round_brilliant")) };
    let of = |scene: &Scene, tracer: Wanted| {
        let mut job = job(scene.clone(), light(Steps::Strips));
        job.quality.tracer = tracer;
        Renderer::default().plan(&job)
    };
    for wanted in [Wanted::Quickest, Wanted::Rays, Wanted::Card] {
        let plan = of(&scene, wanted).unwrap();
        assert_eq!(plan.backend.name(), "ray");
        let why = plan.no_card.map(|why| why.to_string());
        assert_eq!(why.as_deref(), (wanted == Wanted::Card).then_some("no graphics card is used"));
    }
    assert!(matches!(of(&scene, Wanted::Beams), Err(Unfit::Metal)));
    let rough = MetalInstance { roughness: 2.0, ..plate };
    let error = of(&Scene { metals: vec![rough], ..scene.clone() }, Wanted::Rays).err();
    let error = error.map(|error| error.to_string());
    assert_eq!(error.as_deref(), Some("scene.metals[0]: roughness is 2; give a part from 0 to 1"));
    // The metal of a job goes through JSON and back.
    let job = job(scene, light(Steps::Strips));
    let text = serde_json::to_string(&job).unwrap();
    assert_eq!(serde_json::from_str::<Job>(&text).unwrap().scene.metals, job.scene.metals);
    assert!(text.contains("\"Gold\""));
}
