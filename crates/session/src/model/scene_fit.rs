//! The part of space that renders of several bodies take in: of copies the square in which they are laid out, of a
//! scene the ball around all its stones and its metal.

use super::document::Document;
use super::framing_fit::{CENTRED, FramingFit, OUTGROWN, SHRUNK, SLACK};
use brillianteer_math::Ball;
use brillianteer_scene::{Companions, Pose, Projection, Specimen, View};
use glam::DVec3;
use std::sync::Arc;

/// The least part of its distance at which an eye in perspective sees the rim of a scene's ball, squared. An eye
/// nearer to the ball, or inside it, does not take in the whole.
const LEAST_NEAR: f64 = 0.1;

/// The distance of an eye in perspective from the middle of a scene is at least this many radii of its ball: a nearer
/// eye would be among the bodies.
const NEAREST_EYE: f64 = 1.05;

/// The part of space that renders of several bodies take in, about the point that they turn about; in girdle radii of
/// the design.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SceneRoom {
    /// The square, face up, in which copies of one design are laid out.
    Square {
        /// Half its side.
        half: f64,
    },
    /// The ball that holds a scene, however the scene is turned.
    Ball {
        /// Its radius.
        radius: f64,
    },
}

impl SceneRoom {
    /// Returns the part of the image plane that a view takes in. A square keeps its scale unless its corners would
    /// leave the view; a ball always keeps its scale.
    pub fn fit(self, view: &View) -> FramingFit {
        FramingFit::reaching(match self {
            Self::Square { half } => {
                let basis = view.basis();
                let across = |axis: DVec3| half * (axis.x.abs() + axis.y.abs());
                half.max(across(basis.right).max(across(basis.up)) / (1.0 + SLACK))
            }
            Self::Ball { radius } => {
                let sine = match view.projection {
                    Projection::Orthographic => 0.0,
                    Projection::Perspective { distance } => radius / distance,
                };
                radius / (1.0 - sine * sine).max(LEAST_NEAR).sqrt()
            }
        })
    }
}

/// The bodies that renders of a scene show.
#[derive(Debug, Clone)]
struct SceneBodies {
    specimen: Arc<Specimen>,
    copies: Vec<Pose>,
    companions: Companions,
}

impl SceneBodies {
    fn of(document: &Document) -> Self {
        let work = &document.work;
        Self {
            specimen: Arc::clone(document.specimen()),
            copies: work.copies.poses.clone(),
            companions: work.companions.clone(),
        }
    }

    /// Returns whether a document has the same bodies in the same places.
    fn are_those_of(&self, document: &Document) -> bool {
        let work = &document.work;
        Arc::ptr_eq(&self.specimen, document.specimen())
            && self.copies == work.copies.poses
            && self.companions == work.companions
    }

    /// Returns points between which all bodies lie, in mm.
    fn corners(&self) -> Vec<DVec3> {
        let unit_mm = self.specimen.unit_mm();
        let own = self.specimen.solid().vertices();
        let copies = self.copies.iter().flat_map(|pose| own.iter().map(|&at| pose.place(at) * unit_mm));
        copies.chain(self.companions.vertices()).collect()
    }
}

/// The scene that renders are fitted to.
#[derive(Debug, Clone)]
pub struct FittedScene {
    /// The ball around all bodies, in mm. The scene turns about its middle.
    pub ball: Ball,
    /// Half the longer side of the scene face up, measured from the ball's middle, in mm.
    pub across_mm: f64,
    /// The bodies that were last found to fit.
    bodies: SceneBodies,
}

impl FittedScene {
    /// Fits renders to the scene of a document; `None` where no other body stands beside the design and its copies.
    pub fn of(document: &Document) -> Option<Self> {
        (!document.work.companions.is_empty()).then(|| Self::around(SceneBodies::of(document)))
    }

    fn around(bodies: SceneBodies) -> Self {
        let corners = bodies.corners();
        let ball = Ball::around(&corners);
        // Scenes are opened with their middle at the origin, and what is left there is rounding.
        let is_centred = ball.middle.length() < CENTRED * ball.radius;
        let ball = if is_centred { Ball { middle: DVec3::ZERO, ..ball } } else { ball };
        let across = |at: &DVec3| (*at - ball.middle).truncate().abs().max_element();
        let across_mm = corners.iter().map(across).fold(0.0, f64::max);
        Self { ball, across_mm, bodies }
    }

    /// Fits renders to the scene of a document, which has one, if it reaches out of them or is small in them; returns
    /// whether it did.
    pub fn settle(&mut self, document: &Document) -> bool {
        if self.bodies.are_those_of(document) {
            return false;
        }
        let present = Self::around(SceneBodies::of(document));
        let (fitted, now) = (self.ball, present.ball);
        let fits = fitted.middle.distance(now.middle) + now.radius <= OUTGROWN * fitted.radius
            && now.radius >= SHRUNK * fitted.radius;
        if fits {
            self.bodies = present.bodies
        } else {
            *self = present
        }
        !fits
    }

    /// Returns a view whose eye, if it is in perspective, is outside the scene; `unit_mm` is the unit of the view's
    /// lengths.
    pub fn seen_from_outside(&self, view: View, unit_mm: f64) -> View {
        let projection = match view.projection {
            Projection::Orthographic => Projection::Orthographic,
            Projection::Perspective { distance } => {
                let distance = distance.max(NEAREST_EYE * self.ball.radius / unit_mm);
                Projection::Perspective { distance }
            }
        };
        View { projection, ..view }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Model;
    use crate::model::action::{Action, Edit, FileAction, FrameEnd};
    use crate::model::command::Command;
    use crate::model::dialog::Then;
    use crate::model::eye::Eye;
    use crate::model::motion::WaveCache;
    use crate::model::ordering::Orders;
    use crate::model::update;
    use crate::model::workspace::Workspace;
    use crate::studio::{Paper, Shot, Which};
    use brillianteer_trace::ray::Camera;
    use glam::{DMat2, DVec2};

    /// Returns a model that has begun a scene of the program.
    fn begun(scene: &str) -> Model {
        let mut model = Model::new(Workspace::default()).unwrap();
        update(&mut model, FileAction::Ask(Then::Preset(scene.to_owned())).into());
        frame(&mut model);
        model
    }

    /// Ends a frame without a gesture.
    fn frame(model: &mut Model) {
        drop(update(model, Action::Frame(FrameEnd { now: 0.0, is_gesture: false })));
    }

    fn render(model: &Model) -> Shot {
        let pane = model.active();
        let mut waves = WaveCache::default();
        let mut orders = Orders { model, waves: &mut waves, paper: Paper::default() };
        orders.shot(pane, Which::Present, [400, 300]).unwrap()
    }

    /// Returns the extents of all bodies of a shot in its picture: the least and the greatest, as parts of its sides.
    fn extents(shot: &Shot) -> [DVec2; 2] {
        let scene = shot.scene();
        let camera = Camera::reaching(&shot.view, scene.reach());
        let map = shot.film.pixels_from_image(DMat2::IDENTITY);
        let size = DVec2::from(shot.film.size.map(f64::from));
        let seen = scene.vertices().map(|at| {
            let (at, _) = camera.project(at).expect("all bodies are in front of the eye");
            map.transform_point2(at) / size
        });
        seen.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
    }

    /// Returns all ways to look at a scene that a test tries.
    fn eyes() -> impl Iterator<Item = Eye> {
        let leans = [0.0, 0.5, 1.1, std::f64::consts::FRAC_PI_2];
        leans.into_iter().flat_map(|lean| {
            (0..3).map(move |k| {
                let way = f64::from(k);
                Eye { lean: DVec2::from_angle(1.1 * way) * lean, turn: 0.9 * way, ..Eye::default() }
            })
        })
    }

    #[test]
    fn rings_and_scenes_stay_in_their_view_however_they_are_turned_and_turn_about_their_middle() {
        for scene in ["four-prong", "eternity", "trilogy", "parcel"] {
            let mut model = begun(scene);
            let pane = model.active();
            // The middle of all bodies is the origin of renders, about which they turn.
            let (a, b) = render(&model).scene().bounds();
            assert!((a + b).length() < 1e-6, "{scene}: {a} {b}");
            for is_near in [true, false] {
                model.workspace.panes[pane].is_near = is_near;
                let mut pixels = vec![];
                for eye in eyes() {
                    model.workspace.eye = eye;
                    let shot = render(&model);
                    let [low, high] = extents(&shot);
                    assert!(
                        low.min_element() > 0.0 && high.max_element() < 1.0,
                        "{scene} {eye:?}: {low} {high}"
                    );
                    pixels.push(shot.film.pixel);
                }
                assert!(pixels.iter().all(|pixel| *pixel == pixels[0]), "{scene} keeps its scale");
            }
        }
    }

    #[test]
    fn another_stone_of_a_ring_is_edited_and_neither_the_view_nor_the_eye_moves() {
        let mut model = begun("halo-ring");
        model.workspace.eye = Eye { zoom: 3.0, centre: DVec2::new(0.4, 0.2), ..Eye::default() };
        let seen = |model: &Model| {
            let shot = render(model);
            (extents(&shot), shot.view.projection != Projection::Orthographic)
        };
        let before = seen(&model);
        let same = |model: &Model| {
            let (now, is_near) = seen(model);
            let off = now.iter().zip(before.0).map(|(a, b)| a.distance(b)).fold(0.0, f64::max);
            assert!(is_near && off < 1e-6, "{now:?} and before {before:?}");
        };
        update(&mut model, Edit::TakeUp(0).into());
        frame(&mut model);
        assert!(model.document.specimen().unit_mm() < 1.0);
        same(&model);
        // A smaller stone in its place leaves the eye where it is.
        update(&mut model, Edit::Diameter(1.4).into());
        assert!(render(&model).view.projection != Projection::Orthographic);
        update(&mut model, Command::Undo.into());
        update(&mut model, Command::Undo.into());
        frame(&mut model);
        same(&model);
    }

    #[test]
    fn a_scene_that_has_outgrown_its_view_is_fitted_anew_and_fit_to_view_fits_a_ring() {
        let mut model = begun("trilogy");
        let far = model.companions().stones[0].pose.at * model.document.specimen().unit_mm() * 3.0;
        let moved = Pose { at: far, ..model.document.work.companions.stones[0].pose };
        update(&mut model, Edit::Companion(0, moved).into());
        frame(&mut model);
        let [low, high] = extents(&render(&model));
        assert!(low.min_element() > 0.0 && high.max_element() < 1.0, "{low} {high}");
        model.workspace.eye.zoom = 5.0;
        update(&mut model, Command::Fit.into());
        let [low, high] = extents(&render(&model));
        assert!(low.min_element() > 0.0 && high.max_element() < 1.0, "{low} {high}");
        assert!((high - low).max_element() > 0.6, "{low} {high}");
    }

    #[test]
    fn copies_that_are_spun_stay_in_their_view() {
        let mut model = begun("prism-rainbow");
        model.workspace.panes[model.active()].is_near = false;
        let rest = render(&model).film.pixel;
        model.workspace.eye.turn = 0.8;
        let shot = render(&model);
        assert!(shot.film.pixel > 1.2 * rest);
        let [low, high] = extents(&shot);
        assert!(low.min_element() > 0.0 && high.max_element() < 1.0, "{low} {high}");
        assert_eq!(SceneRoom::Square { half: 2.0 }.fit(&View::default()), FramingFit::reaching(2.0));
    }
}
