mod enlarged;
mod frosted;
mod metal;
mod results;

use super::*;
use brillianteer_base::unwatched;
use brillianteer_cut::{Design, Family, MaterialRef};
use brillianteer_math::Pose;
use brillianteer_measure::Bounds;
use brillianteer_picture::liquid_glass::GlassPane;
use brillianteer_picture::{Backdrop, Linear};
use brillianteer_scene::{
    ASET_CONE, Backing, Film, Glare, Instance, Light, Mipmap, Panorama, PanoramaRef, Projection, Scene,
    Scope, Specimen, View,
};
use brillianteer_trace::environment::{EnvironmentMap, Lighting};
use glam::{DQuat, DVec2, DVec3};
use serde_json::{Value, json};
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

/// Returns a picture under light, whether it is made in strips or as a whole.
fn lit(job: &Job) -> Linear {
    let ([width, height], mut pixels) = (job.film.size, vec![]);
    let rendered = Renderer::default().run(job, &unwatched, &mut |part| {
        if let Partial::LightRow { y, pixels: row } = part {
            assert_eq!(pixels.len(), (y * width) as usize, "rows come in order, and whole");
            pixels.extend_from_slice(row);
        }
        Ok::<_, RenderError>(())
    });
    rendered.unwrap().light().map_or(Linear { width, height, pixels }, |(picture, _)| picture)
}

/// A stone of each kind, one of them turned and smaller.
fn several() -> Scene {
    let all = [("round_brilliant", -1.2), ("cube", 1.2)].map(|(name, x)| {
        let specimen = specimen(name);
        let pose = Pose { at: DVec3::X * x, turn: DQuat::from_rotation_y(0.4), scale: 0.6 };
        Instance { pose, ..Instance::of(&specimen.body, specimen.material.clone(), name) }
    });
    Scene { instances: all.into(), metals: vec![], unit_mm: 3.0 }
}

fn several_lit() -> Job {
    job(several(), light(Steps::Strips))
}

#[test]
fn a_job_that_was_written_and_read_makes_the_same() {
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

fn alone() -> Scene {
    Scene::alone(&specimen("round_brilliant"))
}

fn grey(width: u32, height: u32) -> Arc<Panorama> {
    Arc::new(Panorama { width, height, pixels: vec![[0.5; 3]; (width * height) as usize] })
}

/// Returns a picture with a panorama around the stone and a photograph behind it.
fn hung() -> Job {
    let mut job = job(alone(), light(Steps::Strips));
    if let Product::Light(product) = &mut job.product {
        let panorama = PanoramaRef { file: "sky.exr".into(), exposure: 0.0, turn: 0.0 };
        let light = Light { panorama: Some(panorama), ..Light::ring() };
        let map = EnvironmentMap { levels: vec![vec![[0.5; 4]; 4], vec![[0.5; 4]]], side: 2, lamps: vec![] };
        product.surroundings.lighting = Arc::new(Lighting { light, map, warnings: vec![] });
        let picture = grey(3, 2);
        let hung = HungPicture {
            picture: Arc::new(Mipmap::new((*picture).clone())),
            span: 1.0,
            distance: 3.0,
            frame: Film::square(24, 1.1),
        };
        product.surroundings.backplate = Some(hung);
    }
    job
}

fn map() -> Job {
    let surroundings = match hung().product {
        Product::Light(light) => light.surroundings,
        _ => unreachable!("the job is of a picture under light"),
    };
    let plane = Backdrop { distance: 3.0, size: DVec2::splat(4.0), both_sides: false };
    let map =
        MapProduct { surroundings, plane, bands: 1, places: 1, shades: 0, adapted: true, strength: 1.0 };
    job(alone(), Product::RefractionMap(map))
}

fn pane() -> Job {
    let pane = GlassPane::clear(DVec2::splat(2.0), DVec2::splat(8.0), 1.0);
    let product = PaneProduct { pane, background: grey(12, 12), gap: 0.1, wavelengths: 3, compares: false };
    Job::of_pane(product, Quality::of_pictures(true))
}

/// Returns the reason why a job is refused, when it is read or planned, if its JSON has `value` at `pointer`.
fn refused(job: &Job, pointer: &str, value: &Value) -> String {
    let mut written = serde_json::to_value(job).unwrap();
    written.pointer_mut(pointer).unwrap_or_else(|| panic!("{pointer}")).clone_from(value);
    match serde_json::from_value::<Job>(written) {
        Err(error) => error.to_string(),
        Ok(read) => match Renderer::default().plan(&read) {
            Err(unfit) => unfit.to_string(),
            Ok(_) => panic!("{pointer}: {value} is planned"),
        },
    }
}

#[test]
fn jobs_that_make_no_sense_are_refused_with_key_value_and_range() {
    let lit = || job(alone(), light(Steps::Strips));
    let glance = || job(alone(), light(Steps::Glance { first: 0 }));
    let in_scope = || job(alone(), scope(vec![Reading::Energy]));
    let measured = || job(alone(), figures());
    for job in [lit(), glance(), several_lit(), in_scope(), measured(), hung(), map(), pane()] {
        assert_eq!(job.check(), Ok(()));
    }
    let no_film = Job { film: Film::NONE, ..measured() };
    assert_eq!(no_film.check(), Ok(()), "figures need no film");
    let (film, pose) = ("/film/size", "/scene/instances/1/pose");
    let (map_of, hung_at) =
        ("/product/Light/surroundings/lighting/map", "/product/Light/surroundings/backplate");
    let at = |folder: &str, key: &str| format!("{folder}/{key}");
    let bands = json!([]);
    let level = json!([[0.5, 0.5, 0.5, 0.5]]);
    let near = json!({ "Perspective": { "distance": -8.0 } });
    let cases = [
        (lit(), film.into(), json!([0, 8]), "film.size is 0; give 1 to 65,536 pixels"),
        (glance(), film.into(), json!([8, 0]), "film.size is 0;"),
        (in_scope(), film.into(), json!([8, 0]), "film.size is 0;"),
        (map(), film.into(), json!([4_000_000_000_u32, 8]), "film.size is 4000000000;"),
        (lit(), "/film/pixel".into(), json!(0.0), "film.pixel is 0; give a finite number above 0"),
        (lit(), "/view/projection".into(), near.clone(), "view.projection.distance is -8;"),
        (measured(), "/view/projection".into(), near, "view.projection.distance is -8;"),
        (lit(), "/view/turn".into(), json!([0.0, 0.0, 0.0, 0.0]), "view.turn is 0;"),
        (lit(), "/quality/samples".into(), json!(0), "quality.samples is 0; give 1 to 65,536 passes"),
        (in_scope(), "/quality/samples".into(), json!(0), "quality.samples is 0; give 1 to 1024 rays"),
        (measured(), "/quality/samples".into(), json!(0), "quality.samples is 0; give 1 to 16,384"),
        (measured(), "/quality/beams/unresolved".into(), json!(-1.0), "quality.beams.unresolved is -1;"),
        (measured(), "/quality/standard_error".into(), json!(0.0), "quality.standard_error is 0;"),
        (lit(), "/product/Light/wavelengths".into(), json!(0), "wavelengths is 0; give 1 to 1024 bands"),
        (lit(), "/product/Light/strength".into(), json!(2.0), "strength is 2; give a part from 0 to 1"),
        (lit(), "/product/Light/surroundings/head".into(), json!(9.0), "surroundings.head is 9;"),
        (lit(), "/scene/unit_mm".into(), json!(0.0), "scene.unit_mm is 0;"),
        (several_lit(), at(pose, "scale"), json!(0.0), "scene.instances[1]: pose.scale is 0;"),
        (several_lit(), at(pose, "turn"), json!([2.0, 0.0, 0.0, 0.0]), "scene.instances[1]: pose.turn is 2;"),
        (in_scope(), "/product/Scope/scope/band".into(), bands.clone(), "the first band must begin at -90"),
        (measured(), "/product/Figures/scope/band".into(), bands, "the first band must begin at -90"),
        (in_scope(), "/product/Scope/medium/index".into(), json!(0.5), "medium.index is 0.5;"),
        (
            measured(),
            "/product/Figures/medium/absorption".into(),
            json!([0.0, -1.0]),
            "medium.absorption is -1;",
        ),
        (hung(), at(hung_at, "span"), json!(0.0), "surroundings.backplate.span is 0;"),
        (hung(), at(hung_at, "frame/size"), json!([0, 0]), "surroundings.backplate.frame.size is 0;"),
        (hung(), at(hung_at, "picture/width"), json!(4), "4 by 2 pixels have 6 colours"),
        (hung(), at(hung_at, "picture/pixels/1"), json!([0.5, -1.0, 0.5]), "pixels[1] is [0.5, -1.0, 0.5]"),
        (hung(), map_of.into(), Value::Null, "the panorama sky.exr cannot be drawn anew"),
        (hung(), at(map_of, "levels"), json!([]), "map.levels is empty"),
        (hung(), at(map_of, "levels/1"), json!([]), "map.levels[1] has 0 texels"),
        (
            hung(),
            at(map_of, "levels/0"),
            level,
            "map.levels[0] has 1 texels, and a map of side 2 has 4 there",
        ),
        (hung(), "/product/Light/surroundings/lighting/light/head".into(), json!(99.0), "head is 99;"),
        (map(), "/product/RefractionMap/bands".into(), json!(0), "bands is 0;"),
        (map(), "/product/RefractionMap/places".into(), json!(0), "places is 0;"),
        (map(), "/product/RefractionMap/plane/size".into(), json!([0.0, 1.0]), "plane.size is 0;"),
        (pane(), "/product/LiquidGlass/gap".into(), json!(-1.0), "gap is -1;"),
        (pane(), "/product/LiquidGlass/wavelengths".into(), json!(0), "wavelengths is 0;"),
        (
            pane(),
            "/product/LiquidGlass/background/height".into(),
            json!(0),
            "12 by 0 pixels have 144 colours",
        ),
    ];
    for (job, pointer, value, says) in cases {
        let pointer: String = pointer;
        let error = refused(&job, &pointer, &value);
        assert!(error.contains(says), "{pointer}: {error}");
    }
}

#[test]
fn jobs_that_were_never_written_are_checked_as_well() {
    let empty = |mut job: Job| {
        if let Product::Light(light) = &mut job.product {
            let hung = light.surroundings.backplate.as_mut().unwrap();
            let empty = Panorama { width: 3, height: 2, pixels: vec![] };
            hung.picture = Arc::new(Mipmap::new(empty));
        }
        job
    };
    let refused = Renderer::default().plan(&empty(hung())).err().unwrap().to_string();
    assert!(refused.starts_with("surroundings.backplate.picture: 3 by 2 pixels have 0 colours"), "{refused}");
    let mut dark = alone();
    dark.instances[0].material.dispersion = brillianteer_optics::Dispersion::Constant(0.5);
    let refused = Renderer::default().plan(&job(dark, light(Steps::Strips))).err().unwrap().to_string();
    assert!(
        refused.starts_with("scene.instances[0]: material.dispersion: the dispersion gives no"),
        "{refused}"
    );
}

#[test]
fn a_picture_in_strips_is_the_last_of_those_that_grow_clearer() {
    // Whole strata are shown after each pass, shares of them only when all were seen.
    for (scene, jitter, shown) in
        [(Scene::alone(&specimen("round_brilliant")), false, 2), (several(), false, 2), (several(), true, 1)]
    {
        let taken = |steps| {
            let mut job = job(scene.clone(), light(steps));
            let Product::Light(light) = &mut job.product else { panic!("no picture under light") };
            light.jitter = jitter;
            job
        };
        let (mut count, mut last) = (0, None);
        let growing = taken(Steps::Passes { first: 0, hidden: 0 });
        let grown = Renderer::default().run(&growing, &unwatched, &mut |part| {
            if let Partial::Picture { picture, .. } = part {
                count += 1;
                last = Some(picture.clone());
            }
            Ok::<_, RenderError>(())
        });
        assert_eq!(count, shown);
        let grown = grown.unwrap().light().unwrap().0;
        assert_eq!(last.as_ref(), Some(&grown));
        assert_alike(&grown, &lit(&taken(Steps::Strips)));
    }
}

/// Passes that share beams are taken together in other groups where a picture grows.
fn assert_alike(a: &Linear, b: &Linear) {
    assert_eq!((a.width, a.height), (b.width, b.height));
    let apart =
        |(a, b): (&[f32; 4], &[f32; 4])| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    let most = a.pixels.iter().zip(&b.pixels).map(apart).fold(0.0, f32::max);
    assert!(most < 2e-3, "pixels differ by {most}");
}

#[test]
fn the_last_pass_is_shown_even_where_all_are_hidden() {
    let hidden = job(alone(), light(Steps::Passes { first: 0, hidden: 9 }));
    assert_alike(&lit(&hidden), &lit(&job(alone(), light(Steps::Strips))));
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
    let nothing = Scene { instances: vec![], metals: vec![], unit_mm: 1.0 };
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
    let bounds = Bounds::exact(1e-2);
    let quality = Quality::of_figures(&bounds, Wanted::Quickest);
    let rough = Job { quality, ..job(Scene::alone(&specimen("round_brilliant")), figures()) };
    let measured = done(&rough).figures().unwrap();
    assert!(measured.figures.unresolved <= 1e-2 && measured.figures.unresolved > 1e-4);
}

#[test]
fn scopes_figures_and_maps_refuse_metal_instead_of_leaving_it_out() {
    let surface =
        brillianteer_math::ShadedSurface::creased(&[DVec3::ZERO, DVec3::X, DVec3::Y], &[[0, 1, 2]], 0.5);
    let mesh = Arc::new(brillianteer_math::ShadedMesh::new(surface).unwrap());
    let plate = brillianteer_scene::MetalInstance::new(&mesh, brillianteer_optics::Metal::Gold);
    let alone = Scene::alone(&specimen("round_brilliant"));
    for product in [scope(vec![Reading::Energy]), figures()] {
        let free = job(alone.clone(), product);
        assert!(Renderer::default().plan(&free).is_ok());
        let held = Job { scene: Arc::new(Scene { metals: vec![plate.clone()], ..alone.clone() }), ..free };
        assert_eq!(Renderer::default().plan(&held).err(), Some(Unfit::Metal));
    }
}

#[test]
fn an_upright_light_has_its_horizon_level_behind_the_stones() {
    let light = Light::ring();
    let map = EnvironmentMap::new(&light, None);
    let lighting = Arc::new(Lighting { light, map, warnings: vec![] });
    let view = View { tilt: 0.3, azimuth: 1.0, ..View::default() };
    let eye = view.basis();
    let overhead = Surroundings::of(lighting);
    assert_eq!(overhead.around(&view).basis.toward, eye.toward);
    let upright = Surroundings { is_upright: true, ..overhead };
    let basis = upright.around(&view).basis;
    assert_eq!((basis.toward, basis.right), (eye.up, -eye.toward));
    assert!((basis.right.cross(basis.up) - basis.toward).length() < 1e-12, "right-handed");
    let light = brillianteer_scene::light("city").unwrap();
    let map = EnvironmentMap::new(&Light::ring(), None);
    let world = Arc::new(Lighting { light, map, warnings: vec![] });
    let city = Surroundings { is_upright: true, turn: 0.7, ..Surroundings::of(world) };
    let basis = city.around(&view).basis;
    assert_eq!(basis.up, eye.up, "a world turns about its vertical, and stands upright in any case");
    assert!((basis.toward.dot(eye.toward) - 0.7_f64.cos()).abs() < 1e-12);
    // A quarter turn brings the light from the right of the picture behind it.
    let turned = Surroundings { turn: std::f64::consts::FRAC_PI_2, ..upright }.around(&view).basis;
    assert!((turned.right + eye.right).length() < 1e-12 && turned.toward == eye.up);
}

#[test]
fn with_few_bounces_rays_leave_the_rest_dark() {
    let of = |bounces: u32| {
        let mut job = job(alone(), light(Steps::Strips));
        job.quality.rays.most_bounces = bounces;
        let plan = Renderer::default().plan(&job).unwrap();
        let rendered = Renderer::default().run(&job, &unwatched, &mut |_| Ok::<_, RenderError>(())).unwrap();
        (plan.backend.is_beams(), rendered.remainder().unwrap().unresolved)
    };
    let [one, three, eight, all] = [1, 3, 8, 64].map(of);
    assert!(!one.0 && !eight.0 && all.0, "exact beams follow all bounces");
    assert!(
        one.1 > three.1 && three.1 > eight.1 && eight.1 > all.1 && one.1 > 0.5,
        "{one:?} {three:?} {eight:?}"
    );
    let mut wants_beams = job(alone(), light(Steps::Strips));
    (wants_beams.quality.rays.most_bounces, wants_beams.quality.tracer) = (6, Wanted::Beams);
    assert_eq!(Renderer::default().plan(&wants_beams).err(), Some(Unfit::FewBounces));
}
