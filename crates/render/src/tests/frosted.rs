//! Jobs of stones with frosted facets.

use super::*;
use brillianteer_scene::{Body, Stone};

/// Returns a scene of one stone whose table is frosted.
fn frosted() -> Scene {
    let mut scene = alone();
    let stone = scene.instances[0].body.stone().unwrap().clone();
    let table = stone.polytope.facets().iter().find(|facet| facet.plane.normal.z == 1.0).unwrap().source;
    let stone: Stone = stone.frosted(|plane| if plane == table { 0.5 } else { 0.0 });
    scene.instances[0].body = Arc::new(Body::Stone(stone));
    scene
}

#[test]
fn frosted_facets_are_planned_to_rays_or_refused_with_the_reason() {
    let of = |product: Product, tracer: Wanted| {
        let mut job = job(frosted(), product);
        job.quality.tracer = tracer;
        Renderer::default().plan(&job)
    };
    for product in [light(Steps::Strips), figures(), scope(vec![Reading::Energy])] {
        for wanted in [Wanted::Quickest, Wanted::Rays, Wanted::Card] {
            let plan = of(product.clone(), wanted).unwrap();
            assert_eq!(plan.backend.name(), "ray");
            let why = plan.no_card.map(|why| why.to_string());
            let card = (wanted == Wanted::Card)
                .then_some("graphics cards do not scatter light at frosted facets yet");
            assert_eq!(why.as_deref(), card);
        }
        assert!(matches!(of(product, Wanted::Beams), Err(Unfit::Frosted)));
    }
}

#[test]
fn figures_of_frosted_facets_count_their_light_as_unresolved() {
    let measured = |scene: Scene| {
        let mut job = job(scene, figures());
        (job.quality.tracer, job.quality.samples) = (Wanted::Rays, Some(48));
        done(&job).figures().unwrap()
    };
    let [polished, frosted] = [alone(), frosted()].map(measured);
    // The table takes about a third of the outline, and most light from elsewhere meets it.
    assert!(polished.figures.unresolved < 1e-2 && frosted.figures.unresolved > 0.3);
    assert!((frosted.figures.sum() - 1.0).abs() < 1e-9, "{}", frosted.figures.sum());
    let shares = |m: &brillianteer_measure::Measured| (m.light_return(), m.light_return() + m.error());
    let (low, high) = shares(&frosted);
    assert!(low < polished.light_return() && high > polished.light_return(), "{low} {high}");
}

#[test]
fn a_job_keeps_its_frosted_facets_when_it_is_written() {
    let job = job(frosted(), light(Steps::Strips));
    let text = serde_json::to_string(&job).unwrap();
    let read: Job = serde_json::from_str(&text).unwrap();
    assert!(read.scene.is_frosted() && !alone().is_frosted());
    assert!(!serde_json::to_string(&alone()).unwrap().contains("frosting"));
    let wrong = text.replacen("0.5]", "1.5]", 1).replacen("\"frosting\":[0.5", "\"frosting\":[1.5", 1);
    assert_ne!(wrong, text);
    let error = serde_json::from_str::<Job>(&wrong).unwrap_err().to_string();
    assert!(error.contains("frosting: give a number from 0 to 1"), "{error}");
}
