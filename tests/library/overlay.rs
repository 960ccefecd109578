//! Compares each overlay with a plain computation of its own.

use crate::common::*;
use brillianteer::base::{Stopped, unwatched};
use brillianteer::math::{Plane, Polytope};
use brillianteer::optics::{cos_transmitted, line, material, reflectance, refract};
use brillianteer::picture::{Code, Overlay, lay};
use brillianteer::scene::{Film, Instance, Projection, Scene, View};
use brillianteer::trace::{
    environment::{Environment, EnvironmentMap},
    ray::{RayOptions, SceneProbe, facet_at},
    sampling::LitScene,
};
use glam::{DVec2, DVec3};
use std::ops::ControlFlow;

const SIZE: u32 = 160;
const PIXEL: f64 = 2.4 / SIZE as f64;

/// The scene and the view that overlays are drawn for.
struct Shot {
    scene: Scene,
    view: View,
    options: RayOptions,
}

impl Shot {
    fn new(polytope: Polytope, material_name: &str, view: View) -> Self {
        let stone = Instance::new(polytope, material(material_name).unwrap().clone());
        let options = RayOptions { polarised: false, most_bounces: 64, least_weight: 1e-4 };
        Self { scene: Scene { instances: vec![stone], metals: vec![], unit_mm: 3.25 }, view, options }
    }

    fn with<T>(&self, work: impl FnOnce(&LitScene) -> T) -> T {
        let sky = EnvironmentMap { levels: vec![vec![[0.0; 4]]], side: 1, lamps: vec![] };
        let (basis, eye) = (self.view.light_basis(), self.view.basis());
        let environment = Environment { map: &sky, basis, eye, head: 0.0, backplate: None, backdrop: false };
        let (scene, view, options) = (&self.scene, &self.view, self.options);
        work(&LitScene { scene, environment, view, film: Film::new([SIZE; 2], PIXEL), options })
    }

    /// Draws an overlay over an empty picture, and returns the colour and cover of each pixel.
    fn laid(&self, overlay: Overlay) -> Vec<[u8; 4]> {
        let mut rgba = vec![0; (4 * SIZE * SIZE) as usize];
        self.with(|lit_scene| lay(overlay, lit_scene, &mut rgba, &unwatched)).unwrap();
        rgba.as_chunks().0.to_vec()
    }

    /// Returns the place of a point of the world in the picture, in pixels from the upper left, computed without the
    /// program's camera.
    fn seen(&self, v: DVec3) -> DVec2 {
        let eye = self.view.basis();
        let nearness = match self.view.projection {
            Projection::Orthographic => 1.0,
            Projection::Perspective { distance } => 1.0 - eye.toward.dot(v) / distance,
        };
        let p = DVec2::new(eye.right.dot(v), -eye.up.dot(v)) / nearness / PIXEL;
        p + f64::from(SIZE) / 2.0
    }

    /// Returns the outlines, in the picture, of a stone's facets that face the eye, in counter-clockwise order.
    fn outlines(&self, stone: usize) -> Vec<(u32, Vec<DVec2>)> {
        let polytope = &self.scene.instances[stone].body.stone().unwrap().polytope;
        let outline = |k: usize| -> Vec<DVec2> {
            let corners = polytope.corners(&polytope.facets()[k]).map(|v| self.seen(v));
            corners.map(|p| DVec2::new(p.x, -p.y)).collect()
        };
        let all = (0..polytope.facets().len()).map(|k| (k as u32, outline(k)));
        let area = |o: &[DVec2]| o.windows(2).map(|w| left(o[0], w[0], w[1])).sum::<f64>();
        all.filter(|(_, outline)| area(outline) > 1e-9).collect()
    }

    /// Counts the pixels for which `given` gives a facet other than the one whose outline surrounds the pixel's middle, and
    /// the pixels that were compared. Middles within rounding of an edge are left out.
    fn wrong(&self, given: impl Fn(f64, f64) -> Option<(usize, u32)>) -> (usize, usize) {
        let outlines = self.outlines(0);
        let (mut wrong, mut compared) = (0, 0);
        for k in 0..SIZE * SIZE {
            let (x, y) = (f64::from(k % SIZE) + 0.5, f64::from(k / SIZE) + 0.5);
            let at = DVec2::new(x, -y);
            let around = |margin| outlines.iter().filter(move |(_, o)| contains(o, at, margin));
            let (inside, near) = (around(1e-6).next(), around(-1e-6).count());
            if near > usize::from(inside.is_some()) {
                continue;
            }
            compared += 1;
            wrong += usize::from(given(x, y) != inside.map(|(facet, _)| (0, *facet)));
        }
        (wrong, compared)
    }
}

/// Returns twice the signed area of the triangle `a`, `b`, `p`: positive where `p` is left of the line from `a` to `b`.
fn left(a: DVec2, b: DVec2, p: DVec2) -> f64 {
    (b - a).perp_dot(p - a)
}

/// Returns whether a point lies inside a convex outline by more than a margin.
fn contains(outline: &[DVec2], p: DVec2, margin: f64) -> bool {
    let mut edges = outline.iter().zip(outline.iter().cycle().skip(1));
    edges.all(|(&a, &b)| left(a, b, p) >= margin * a.distance(b))
}

fn tilted(perspective: bool) -> View {
    let projection =
        if perspective { Projection::Perspective { distance: 4.0 } } else { Projection::Orthographic };
    View { tilt: 0.5, azimuth: 0.3, projection, ..View::default() }
}

fn cube(middle: DVec3, half: f64) -> Polytope {
    let sides = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|a| [a, -a]);
    let planes: Vec<_> = sides.map(|n| Plane::new(n, half + n.dot(middle))).collect();
    Polytope::from_planes(&planes).unwrap()
}

#[test]
fn the_facet_at_a_point_is_the_one_whose_outline_lies_around_it() {
    for (name, file) in cut_files() {
        for perspective in [false, true] {
            let shot = Shot::new(stone(&file).polytope, "diamond", tilted(perspective));
            shot.with(|lit_scene| {
                let sight = SceneProbe::new(lit_scene);
                let given = |x, y| sight.through(x, y).map(|g| (g.stone, g.facet));
                let (wrong, compared) = shot.wrong(given);
                assert!(wrong == 0 && compared > 25_000, "{name}, {perspective}: {wrong} of {compared}");
                // `facet_at`, which keeps nothing, agrees; at NaN there is no facet.
                assert_eq!(facet_at(lit_scene, 70.3, 85.6), given(70.3, 85.6));
                assert_eq!(facet_at(lit_scene, f64::NAN, 80.0), None);
            });
            let mut other = Shot::new(stone(&file).polytope, "diamond", tilted(perspective));
            other.view.tilt += 0.02;
            let (wrong, _) = shot.with(|lit_scene| {
                let sight = SceneProbe::new(lit_scene);
                other.wrong(|x, y| sight.through(x, y).map(|g| (g.stone, g.facet)))
            });
            assert!(wrong > 50, "{name}: a tilt of a degree more goes unseen: {wrong}");
        }
    }
}

/// Returns the least cover of a pixel in which a corner of a facet that faces the eye lies; `None` where the picture shows no
/// corner.
fn faintest_corner(shot: &Shot, drawn: &Shot) -> Option<u8> {
    let picture = drawn.laid(Overlay::Wireframe);
    let polytope = &shot.scene.instances[0].body.stone().unwrap().polytope;
    let corners =
        shot.outlines(0).into_iter().flat_map(|(k, _)| polytope.corners(&polytope.facets()[k as usize]));
    let pixel = |p: DVec2| picture[(p.y as u32 * SIZE + p.x as u32) as usize];
    // Long stones reach beyond the picture.
    let is_shown = |p: &DVec2| p.min_element() >= 0.0 && p.max_element() < f64::from(SIZE);
    corners.map(|v| shot.seen(v)).filter(is_shown).map(|p| pixel(p)[3]).min()
}

#[test]
fn the_wireframe_touches_every_corner_that_is_seen() {
    let mut shown = 0;
    for (name, file) in cut_files() {
        for perspective in [false, true] {
            let shot = Shot::new(stone(&file).polytope, "diamond", tilted(perspective));
            let mut other = Shot::new(stone(&file).polytope, "diamond", tilted(perspective));
            other.view.azimuth += 0.2;
            let [own, others] = [&shot, &other].map(|drawn| faintest_corner(&shot, drawn));
            let (Some(own), Some(others)) = (own, others) else { continue };
            shown += 1;
            // A facet's corner may lie in a corner of its pixel, 0.7 from the middle, where a line is drawn with a cover
            // of 0.4.
            assert!(own > 90 && others < 60, "{name}, {perspective}: {own}, {others}");
        }
    }
    assert!(shown > 50, "only {shown} pictures show a corner");
}

#[test]
fn edges_behind_are_fainter_whichever_stone_they_are_behind() {
    let face_up = View::default();
    let mut shot = Shot::new(cube(DVec3::new(0.0, 0.0, -0.6), 0.5), "diamond", face_up);
    let corner = |shot: &Shot| {
        let at = shot.seen(DVec3::new(0.5, 0.0, -0.1));
        shot.laid(Overlay::Wireframe)[(at.y as u32 * SIZE + at.x as u32) as usize][3]
    };
    let alone = corner(&shot);
    let glass = material("quartz").unwrap().clone();
    for (z, hidden) in [(0.6, true), (-1.7, false)] {
        let other = Instance::new(cube(DVec3::new(0.3, 0.0, z), 0.45), glass.clone());
        shot.scene.instances.truncate(1);
        shot.scene.instances.push(other);
        let beside = corner(&shot);
        assert_eq!(beside < alone / 2 + 20, hidden, "{z}: {beside}, alone {alone}");
    }
}

/// Finds the first plane that a ray meets inside the stone by trying every plane: returns the share of light that went in
/// and the cosine at that plane; `None` beside the stone and where another plane is nearly as close.
fn first_inside(shot: &Shot, lit_scene: &LitScene, index: f64, at: DVec2) -> Option<(f64, f64)> {
    let planes: Vec<Plane> = shot.scene.instances[0].body.stone().unwrap().polytope.planes().collect();
    let eye = shot.view.basis();
    let (d, from) = (-eye.toward, eye.lift(lit_scene.film.image_from_pixels(at)) + eye.toward * 10.0);
    let way = |p: &Plane, from: DVec3, d: DVec3| -p.distance(from) / p.normal.dot(d);
    let facing = planes.iter().filter(|p| p.normal.dot(d) < 0.0);
    let (entry, into) = facing.map(|p| (p, way(p, from, d))).max_by(|a, b| a.1.total_cmp(&b.1))?;
    let point = from + d * into;
    if planes.iter().any(|p| p != entry && p.distance(point) > -1e-9) {
        return None;
    }
    let cos_i = -d.dot(entry.normal);
    let inward = refract(d, entry.normal, 1.0 / index, (cos_i, cos_transmitted(cos_i, 1.0 / index)?));
    let ahead = planes.iter().filter(|p| p.normal.dot(inward) > 1e-12);
    let mut ways: Vec<(f64, &Plane)> = ahead.map(|p| (way(p, point, inward), p)).collect();
    ways.sort_by(|a, b| a.0.total_cmp(&b.0));
    let is_clear = ways[1].0 - ways[0].0 > 1e-9;
    is_clear.then(|| (1.0 - reflectance(cos_i, 1.0 / index).unwrap(), ways[0].1.normal.dot(inward)))
}

/// Counts the pixels where an overlay and the plain computation disagree about a colour, the pixels that have the colour,
/// and those that do not.
fn differing(
    shot: &Shot,
    overlay: Overlay,
    colour: Code,
    index: f64,
    law: impl Fn(f64, f64) -> bool,
) -> [usize; 3] {
    let picture = shot.laid(overlay);
    let mut found = [0; 3];
    shot.with(|lit_scene| {
        for k in 0..SIZE * SIZE {
            let at = DVec2::new(f64::from(k % SIZE), f64::from(k / SIZE)) + 0.5;
            let Some((entered, cos_i)) = first_inside(shot, lit_scene, index, at) else { continue };
            let [r, g, b, a] = picture[k as usize];
            assert_eq!(a, 255, "{at}");
            let shown = [r, g, b] == colour;
            found[0] += usize::from(shown != law(entered, cos_i));
            found[1 + usize::from(shown)] += 1;
        }
    });
    found
}

fn lowest(overlay: Overlay) -> Code {
    overlay.legend()[0].1
}

#[test]
fn no_total_reflection_is_shown_where_the_first_facet_inside_is_met_below_the_critical_angle() {
    for (name, material_name) in [("tolkowsky", "quartz"), ("shallow", "ruby"), ("fisheye", "emerald")] {
        let file = cut_files().into_iter().find(|(n, _)| n == name).unwrap().1;
        let shot = Shot::new(stone(&file).polytope, material_name, tilted(false));
        let index = material(material_name).unwrap().index(line::SODIUM_D);
        let differ = |index: f64| {
            let leaks = |_, cos_i: f64| cos_i > (1.0 - 1.0 / (index * index)).sqrt();
            differing(&shot, Overlay::Total, lowest(Overlay::Total), index, leaks)
        };
        let [differing, total, leaks] = differ(index);
        assert!(differing == 0 && total > 500 && leaks > 500, "{name}: {differing}, {total}, {leaks}");
        let [differing, ..] = differ(index * 1.02);
        assert!(differing > 10, "{name}: another index goes unseen: {differing}");
    }
}

#[test]
fn one_bounce_is_shown_where_the_first_facet_reflects_no_more_than_the_least_weight() {
    let file = &round_brilliants()[0].1;
    let mut shot = Shot::new(stone(file).polytope, "quartz", tilted(false));
    let index = material("quartz").unwrap().index(line::SODIUM_D);
    shot.options.least_weight = 0.05;
    let differ = |least: f64| {
        let fades = |entered: f64, cos_i: f64| entered * reflectance(cos_i, index).unwrap_or(1.0) <= least;
        differing(&shot, Overlay::Bounces, lowest(Overlay::Bounces), index, fades)
    };
    let [differing, more, one] = differ(0.05);
    assert!(differing == 0 && more > 500 && one > 500, "{differing}, {more}, {one}");
    assert!(differ(0.06)[0] > 10);
}

#[test]
fn what_is_unresolved_is_all_that_went_in_where_nothing_is_followed() {
    let mut shot = Shot::new(cube(DVec3::ZERO, 0.8), "diamond", View::default());
    shot.options.most_bounces = 0;
    let highest = Overlay::Unresolved.legend().pop().unwrap().1;
    let shown = |shot: &Shot| {
        let picture = shot.laid(Overlay::Unresolved);
        picture.iter().filter(|[r, g, b, a]| [*r, *g, *b] == highest && *a == 255).count()
    };
    let across = (1.6 / PIXEL).round() as usize;
    assert!(shown(&shot).abs_diff(across * across) <= 2 * across);
    shot.options.most_bounces = 64;
    assert_eq!(shown(&shot), 0);
}

#[test]
fn beside_the_stones_nothing_is_laid_and_facets_are_tinted_one_by_one() {
    let shot = Shot::new(cube(DVec3::ZERO, 0.4), "diamond", tilted(true));
    let picture = shot.laid(Overlay::Facets);
    let mut colours: Vec<_> = picture.into_iter().collect();
    colours.sort_unstable();
    colours.dedup();
    // The colours are those of no facet and of the three sides of the cube that face the eye.
    assert_eq!((colours.len(), colours[0]), (4, [0; 4]), "{colours:?}");
    assert!(colours[1..].iter().all(|c| c[3] == 128));
}

#[test]
fn a_drawing_that_is_stopped_says_so_and_an_odd_picture_is_no_panic() {
    let shot = Shot::new(cube(DVec3::ZERO, 0.4), "diamond", tilted(true));
    let never = |_: f64| ControlFlow::Break(());
    for overlay in Overlay::names().map(|name| name.parse().unwrap()) {
        shot.with(|lit_scene| {
            assert_eq!(
                lay(overlay, lit_scene, &mut vec![0; (4 * SIZE * SIZE) as usize], &never),
                Err(Stopped)
            );
            for length in [0, 3, 4 * SIZE as usize + 1] {
                assert_eq!(lay(overlay, lit_scene, &mut vec![0; length], &unwatched), Ok(()));
            }
            let none = LitScene { film: Film::new([0; 2], PIXEL), ..*lit_scene };
            assert_eq!(lay(overlay, &none, &mut [0; 8], &unwatched), Ok(()));
        });
    }
}
