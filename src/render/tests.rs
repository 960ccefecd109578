use super::*;
use crate::cut::{Design, Family, MaterialRef};
use crate::math::Pose;
use crate::measure::Bounds;
use crate::picture::Linear;
use crate::scene::{
    ASET_CONE, Backing, Film, Glare, Instance, Light, Projection, Scene, Scope, Specimen, View,
};
use crate::trace::environment::{EnvironmentMap, Lighting};
use crate::trace::unwatched;
use glam::{DQuat, DVec3};
use std::ops::ControlFlow;
use std::sync::Arc;

/// Returns a diamond of the first cut of a family.
fn specimen(family: &str) -> Specimen {
    let design = Design {
        name: family.to_owned(),
        source: None,
        notes: None,
        material: MaterialRef::Name("diamond".to_owned()),
        diameter_mm: 6.5,
        cut: Family::of_key(family).unwrap().first.clone(),
    };
    Specimen::new(design).unwrap()
}

fn light(steps: Steps) -> Product {
    let light = Light::ring();
    let map = EnvironmentMap::new(&light, None);
    let lighting = Arc::new(Lighting { light, map, warnings: vec![] });
    let surroundings = Surroundings::of(lighting);
    Product::Light(LightProduct {
        surroundings,
        wavelengths: 3,
        adapted: true,
        strength: 1.0,
        jitter: true,
        steps,
    })
}

fn job(scene: Scene, product: Product) -> Job {
    let quality = Quality { samples: Some(2), ..Quality::of_pictures(true) };
    Job { scene: Arc::new(scene), view: View::default(), film: Film::square(24, 1.1), product, quality }
}

fn scope(readings: Vec<Reading>) -> Product {
    let scope = Scope::aset(ASET_CONE, Backing::Black);
    let medium = specimen("round_brilliant").medium(589.3);
    Product::Scope(ScopeProduct { scope, medium, glare: Glare::Included, readings })
}

fn figures() -> Product {
    let scope = Scope::aset(ASET_CONE, Backing::Black);
    Product::Figures(FiguresProduct { scope, medium: specimen("round_brilliant").medium(589.3) })
}

fn done(job: &Job) -> Rendered {
    Renderer::default().run(job, &unwatched, &mut |_| Ok::<_, RenderError>(())).unwrap()
}

fn lit(job: &Job) -> Linear {
    done(job).light().unwrap().0
}

/// A stone of each kind, one of them turned and smaller.
fn several() -> Scene {
    let all = [("round_brilliant", -1.2), ("cube", 1.2)].map(|(name, x)| {
        let specimen = specimen(name);
        let pose = Pose { at: DVec3::X * x, turn: DQuat::from_rotation_y(0.4), scale: 0.6 };
        Instance { pose, ..Instance::of(&specimen.body, specimen.material.clone(), name) }
    });
    Scene { instances: all.into(), unit_mm: 3.0 }
}

#[test]
fn a_job_that_was_written_and_read_makes_the_same() {
    let alone = || Scene::alone(&specimen("round_brilliant"));
    let jobs = [
        job(alone(), light(Steps::Strips)),
        job(several(), light(Steps::Strips)),
        job(alone(), scope(vec![Reading::Energy])),
        job(alone(), figures()),
    ];
    for job in jobs {
        let text = serde_json::to_string(&job).unwrap();
        let read: Job = serde_json::from_str(&text).unwrap();
        match job.product {
            Product::Light(_) => {
                let (own, others) = (lit(&job), lit(&read));
                // Planes are brought to unit length again, which may change their last digits.
                let off = own.pixels.iter().flatten().zip(others.pixels.iter().flatten());
                let off = off.map(|(a, b)| (a - b).abs()).sum::<f32>() / own.pixels.len() as f32;
                assert!(off < 1e-5, "{off}");
            }
            Product::Figures(_) => {
                let [own, others] = [&job, &read].map(|job| done(job).figures().unwrap().light_return());
                assert!((own - others).abs() < 1e-12, "{own}, {others}");
            }
            _ => {}
        }
    }
}

#[test]
fn data_that_make_no_body_are_refused_with_the_reason() {
    let job = job(Scene::alone(&specimen("round_brilliant")), figures());
    let mut value = serde_json::to_value(&job).unwrap();
    let planes = value.pointer_mut("/scene/instances/0/body/Stone/planes").unwrap();
    planes.as_array_mut().unwrap().truncate(3);
    let refused = serde_json::from_value::<Job>(value.clone()).unwrap_err().to_string();
    assert!(refused.contains("3 planes have"), "{refused}");
    value["scene"]["instances"][0]["body"]["Stone"]["names"] = serde_json::json!([]);
    let refused = serde_json::from_value::<Job>(value).unwrap_err().to_string();
    assert!(refused.contains("planes enclose no stone"), "{refused}");
}

#[test]
fn a_picture_in_strips_is_the_last_of_those_that_grow_clearer() {
    for scene in [Scene::alone(&specimen("round_brilliant")), several()] {
        let mut count = 0;
        let growing = job(scene.clone(), light(Steps::Passes { first: 0, hidden: 0 }));
        let mut last = None;
        let grown = Renderer::default().run(&growing, &unwatched, &mut |part| {
            if let Partial::Picture { picture, .. } = part {
                count += 1;
                last = Some(picture.clone());
            }
            Ok::<_, RenderError>(())
        });
        assert_eq!(count, 2);
        let grown = grown.unwrap().light().unwrap().0;
        assert_eq!(last.as_ref(), Some(&grown));
        assert_eq!(grown, lit(&job(scene, light(Steps::Strips))));
    }
}

#[test]
fn both_readings_come_whole_and_from_one_trace() {
    for tracer in [Wanted::Beams, Wanted::Rays] {
        let mut job =
            job(Scene::alone(&specimen("round_brilliant")), scope(vec![Reading::Energy, Reading::Strongest]));
        job.quality.tracer = tracer;
        let (mut begun, mut rows) = (vec![], [0, 0]);
        let rendered = Renderer::default().run(&job, &unwatched, &mut |part| {
            match part {
                Partial::Begun { reading, unresolved, .. } => begun.push((reading, unresolved.is_some())),
                Partial::Rows { reading, rows: some, .. } => {
                    rows[usize::from(reading == Reading::Strongest)] += some.count;
                }
                _ => {}
            }
            Ok::<_, RenderError>(())
        });
        let by_beams = tracer == Wanted::Beams;
        assert_eq!(begun, [(Reading::Energy, by_beams), (Reading::Strongest, by_beams)]);
        assert_eq!(rows, [24, 24]);
        assert_eq!(rendered.unwrap().beams().is_some(), by_beams);
    }
}

#[test]
fn beams_are_traced_once_for_pictures_and_figures_of_one_round() {
    let scene = Arc::new(Scene::alone(&specimen("round_brilliant")));
    let mut renderer = Renderer::default();
    let beams = |renderer: &mut Renderer| {
        let job =
            Job { scene: Arc::clone(&scene), ..job(Scene::clone(&scene), scope(vec![Reading::Energy])) };
        renderer.run(&job, &unwatched, &mut |_| Ok::<_, RenderError>(())).unwrap().beams().unwrap()
    };
    let first = beams(&mut renderer);
    renderer.begin_round();
    assert!(Arc::ptr_eq(&first, &beams(&mut renderer)));
    renderer.begin_round();
    renderer.begin_round();
    assert!(!Arc::ptr_eq(&first, &beams(&mut renderer)), "beams that a round did not use are dropped");
}

#[test]
fn what_cannot_be_traced_is_said_before_anything_is() {
    let near = |distance| View { projection: Projection::Perspective { distance }, ..View::default() };
    let renderer = Renderer::default();
    let alone = || job(Scene::alone(&specimen("round_brilliant")), figures());
    let planned = |job: &Job| renderer.plan(job).map(|plan| plan.backend.name());
    let wanting = |job: Job, tracer| Job { quality: Quality { tracer, ..job.quality }, ..job };
    assert_eq!(planned(&alone()), Ok("beam"));
    assert_eq!(planned(&Job { view: near(8.0), ..alone() }), Ok("ray"));
    let beams = wanting(Job { view: near(8.0), ..alone() }, Wanted::Beams);
    assert_eq!(planned(&beams), Err(Unfit::Perspective));
    assert_eq!(planned(&Job { view: near(0.2), ..alone() }), Err(Unfit::Eye));
    let nothing = Scene { instances: vec![], unit_mm: 1.0 };
    assert_eq!(planned(&job(nothing, figures())), Err(Unfit::NoStone));
    let many = wanting(job(several(), light(Steps::Strips)), Wanted::Beams);
    assert_eq!(planned(&many), Err(Unfit::NotAlone));
}

#[test]
fn work_that_is_stopped_says_so_and_an_error_of_the_caller_comes_back() {
    let picture = job(several(), light(Steps::Passes { first: 0, hidden: 0 }));
    let stop = |_: f64| ControlFlow::Break(());
    let stopped = Renderer::default().run(&picture, &stop, &mut |_| Ok::<_, RenderError>(()));
    assert!(matches!(stopped, Err(RenderError::Stopped(_))));
    #[derive(Debug, PartialEq)]
    struct Own(bool);
    impl From<RenderError> for Own {
        fn from(_: RenderError) -> Self {
            Self(false)
        }
    }
    let ended = Renderer::default().run(&picture, &unwatched, &mut |_| Err(Own(true)));
    assert_eq!(ended.err(), Some(Own(true)));
}

#[test]
fn figures_of_bounds_are_followed_to_them() {
    let bounds = Bounds { unresolved: 1e-2, ..Bounds::default() };
    let quality = Quality::of_figures(&bounds, Wanted::Quickest);
    let rough = Job { quality, ..job(Scene::alone(&specimen("round_brilliant")), figures()) };
    let measured = done(&rough).figures().unwrap();
    assert!(measured.figures.unresolved <= 1e-2 && measured.figures.unresolved > 1e-4);
}
