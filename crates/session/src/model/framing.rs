//! The scale and the place at which views show stones.
//!
//! Views are fitted to one stone, which stays the same while a number is changed, so that the change is visible on
//! the screen and the scale stays. Views are fitted to another stone when a file is opened, when the user asks for
//! it, or when the stone has outgrown its views.

use super::document::Document;
use super::framing_fit::{FramingFit, OUTGROWN, SHRUNK};
use super::scene_fit::FittedScene;
use brillianteer_scene::{Specimen, View};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// The greatest number of corners that a fit uses. Of a solid with more, it uses those that lie outermost in some
/// directions.
const MOST_POINTS: usize = 2000;
/// The number of directions in which outermost corners are sought.
const DIRECTIONS: u32 = 200;

/// The stone that views are fitted to, and the scene that renders are fitted to.
#[derive(Debug, Clone)]
pub struct Framing {
    fitted: Arc<Specimen>,
    points: Arc<[DVec3]>,
    scene: Option<FittedScene>,
    /// The number of times that views were fitted anew.
    fits: u64,
}

impl Framing {
    /// Fits views to a stone.
    pub fn new(specimen: &Arc<Specimen>) -> Self {
        let points = outermost(specimen.solid().vertices()).into();
        Self { fitted: Arc::clone(specimen), points, scene: None, fits: 0 }
    }

    /// Fits views to the stone and the scene of a document.
    pub fn of(document: &Document) -> Self {
        Self { scene: FittedScene::of(document), ..Self::new(document.specimen()) }
    }

    /// Returns a number that is another after views have been fitted anew.
    pub fn fits(&self) -> u64 {
        self.fits
    }

    /// Returns the scene that renders are fitted to; `None` where no other body stands beside a design and its copies.
    pub fn scene(&self) -> Option<&FittedScene> {
        self.scene.as_ref()
    }

    /// Fits views to the stone and the scene of a document.
    pub fn renew(&mut self, document: &Document) {
        self.fit_stone(document.specimen());
        self.scene = FittedScene::of(document);
        self.fits += 1;
    }

    /// Fits views to the stone of a document, where it is another one. Renders stay fitted to the scene unless it reaches
    /// out of them.
    pub fn follow(&mut self, document: &Document) {
        self.fit_stone(document.specimen());
        self.settle_scene(document);
        self.fits += 1;
    }

    /// Fits views to the stone of a document, and renders to its scene, where it reaches out of them or is small in
    /// them; returns whether one did.
    pub fn settle(&mut self, document: &Document) -> bool {
        let is_outgrown = self.has_outgrown(document.specimen());
        if is_outgrown {
            self.fit_stone(document.specimen());
        }
        let is_anew = self.settle_scene(document) || is_outgrown;
        self.fits += u64::from(is_anew);
        is_anew
    }

    fn fit_stone(&mut self, specimen: &Arc<Specimen>) {
        if !Arc::ptr_eq(&self.fitted, specimen) {
            self.points = outermost(specimen.solid().vertices()).into();
            self.fitted = Arc::clone(specimen);
        }
    }

    fn settle_scene(&mut self, document: &Document) -> bool {
        match &mut self.scene {
            Some(scene) if !document.work.companions.is_empty() => scene.settle(document),
            scene => {
                let had_one = scene.is_some();
                *scene = FittedScene::of(document);
                scene.is_some() || had_one
            }
        }
    }

    /// Returns whether a stone reaches out of the views or is small in them.
    fn has_outgrown(&self, specimen: &Arc<Specimen>) -> bool {
        let (fitted, present) = (self.fitted.reach, specimen.reach);
        let fits = present <= OUTGROWN * fitted && present >= SHRUNK * fitted;
        !Arc::ptr_eq(&self.fitted, specimen) && !fits
    }

    /// Returns the part of the image plane that a view of the fitted stone takes in.
    pub fn fit(&self, view: &View) -> FramingFit {
        FramingFit::of(&self.points, view)
    }
}

/// Returns all corners of a solid, or of very many those that lie outermost.
fn outermost(points: &[DVec3]) -> Vec<DVec3> {
    if points.len() <= MOST_POINTS {
        return points.to_vec();
    }
    let farthest =
        |toward: DVec3| points.iter().copied().max_by(|a, b| a.dot(toward).total_cmp(&b.dot(toward)));
    (0..DIRECTIONS).map(direction).filter_map(farthest).collect()
}

/// Returns one of [`DIRECTIONS`] directions that are spread evenly, on a spiral that turns by the golden angle.
fn direction(k: u32) -> DVec3 {
    let z = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(DIRECTIONS);
    let turn = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt()) * f64::from(k);
    (DVec2::from_angle(turn) * (1.0 - z * z).sqrt()).extend(z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::document::Document;
    use crate::model::eye::Eye;
    use crate::model::framing_fit::bounds;
    use brillianteer_cut::{Cut, Design};
    use brillianteer_math::Plane;
    use brillianteer_scene::{Film, Projection};
    use brillianteer_trace::ray::Camera;

    /// Returns a stone of planes: half a prism, which lies beside the origin.
    fn half_round(reach: f64) -> Arc<Specimen> {
        let side = |k: u32| Plane::from_slope(std::f64::consts::FRAC_PI_2, f64::from(k) * 0.3, reach);
        let mut planes: Vec<Plane> = (0..=10).map(side).collect();
        planes.push(Plane::new(DVec3::NEG_Y, 0.0));
        planes.extend([DVec3::Z, DVec3::NEG_Z].map(|z| Plane::new(z, 0.3)));
        let named = planes.into_iter().enumerate().map(|(k, plane)| (format!("side {k}"), plane)).collect();
        let design = Document::first().unwrap().work.design;
        Arc::new(Specimen::new(Design { cut: Cut::Planes(named), ..design }).unwrap())
    }

    /// Returns the parts of a pane that a stone leaves free to the left, the right, above and below.
    fn air(specimen: &Specimen, film: &Film, view: &View) -> [f64; 4] {
        let camera = Camera::reaching(view, 1.0);
        let map = film.pixels_from_image(glam::DMat2::IDENTITY);
        let seen = specimen.solid().vertices().iter().filter_map(|&p| camera.project(p));
        let (low, high) = bounds(seen.map(|(at, _)| map.transform_point2(at).extend(0.0)));
        let [w, h] = film.size.map(f64::from);
        [low.x / w, 1.0 - high.x / w, low.y / h, 1.0 - high.y / h]
    }

    #[test]
    fn stones_fill_their_panes_whatever_their_outline_and_are_centred() {
        let pill = Arc::clone(Document::of_library("pill").unwrap().specimen());
        let first = Arc::clone(Document::first().unwrap().specimen());
        for (name, specimen) in [("half", half_round(1.0)), ("pill", pill), ("first", first)] {
            for size in [[400, 300], [300, 400]] {
                for (lean, distance) in [(0.0, None), (0.7, None), (1.57, None), (0.4, Some(6.0))] {
                    let eye = Eye { lean: DVec2::new(0.0, lean), ..Eye::default() };
                    let near = |distance| Projection::Perspective { distance };
                    let projection = distance.map_or(Projection::Orthographic, near);
                    let view = View { projection, ..eye.view(None) };
                    let fit = Framing::new(&specimen).fit(&view);
                    let [left, right, above, below] = air(&specimen, &eye.film(size, &fit), &view);
                    let off = (left - right).abs().max((above - below).abs());
                    assert!(off < 1e-6, "{name} {size:?} {lean}: off by {off}");
                    let least = left.min(above);
                    assert!(least > 0.0, "{name} {size:?} {lean}: reaches out by {least}");
                    assert!(lean > 0.0 || least < 0.03, "{name} {size:?}: leaves {left} and {above}");
                }
            }
        }
    }

    #[test]
    fn a_stone_that_is_tilted_or_turned_keeps_its_scale() {
        let framing = Framing::new(Document::first().unwrap().specimen());
        let half = |eye: Eye| framing.fit(&eye.view(None)).half;
        let rest = half(Eye::default());
        for step in 0..16 {
            let lean = DVec2::from_angle(f64::from(step)) * 0.1 * f64::from(step);
            assert_eq!(half(Eye { lean, turn: 0.2 * f64::from(step), ..Eye::default() }), rest, "{lean}");
        }
    }

    #[test]
    fn views_stay_as_they_are_until_the_stone_has_outgrown_them() {
        let mut framing = Framing::new(&half_round(1.0));
        let fit = framing.fit(&Eye::default().view(None));
        for (reach, is_anew) in [(1.02, false), (0.7, false), (1.3, true), (0.6, true)] {
            let document = Document::new(half_round(reach).design.clone(), None).unwrap();
            assert_eq!(framing.settle(&document), is_anew, "{reach}");
            let is_same = framing.fit(&Eye::default().view(None)) == fit;
            assert_eq!(is_same, !is_anew, "{reach}");
        }
    }
}
