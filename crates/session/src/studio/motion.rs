//! Finds how the points of a view have moved between two renders, for temporal antialiasing.

use super::order::{Shot, Slot};
use brillianteer_cut::{Cut, Glass};
use brillianteer_picture::{Linear, MotionVector, TemporalHistory};
use brillianteer_scene::{BackgroundRef, Body, Companions, Film, Pose, Specimen, View};
use brillianteer_trace::ray;
use brillianteer_trace::sampling::LitScene;
use glam::{DMat2, DVec2, DVec3};
use rayon::prelude::*;
use std::collections::HashMap;
use std::mem::Discriminant;
use std::sync::Arc;

/// The approximate limit of points of a picture whose motion is computed: in larger pictures one point stands for
/// several pixels.
const MOST_POINTS: f64 = 40_000.0;

/// The bodies, the eye, the film and the background at the time when a picture was traced.
pub struct Moment {
    specimen: Arc<Specimen>,
    copies: Vec<Pose>,
    companions: Companions,
    view: View,
    film: Film,
    behind: Option<BackgroundRef>,
}

/// The temporal history of each slot, and the moment of its last picture.
pub type Trails = HashMap<Slot, (TemporalHistory, Moment)>;

impl Moment {
    /// Returns the moment of a shot that is traced on a film.
    pub fn of(shot: &Shot, film: Film) -> Self {
        let (specimen, copies) = (Arc::clone(&shot.specimen), shot.copies.clone());
        let (companions, behind) = (shot.companions.clone(), shot.look.background.clone());
        Self { specimen, copies, companions, view: shot.view, film, behind }
    }

    /// Blends the picture of this moment with the history of its slot, and returns the blend. `newest` is the share of the
    /// new picture.
    pub fn lay<'a>(
        self,
        trails: &'a mut Trails,
        (slot, picture): (Slot, &Linear),
        lit_scene: &LitScene,
        newest: f64,
    ) -> &'a Linear {
        let before = trails.remove(&slot).filter(|(_, moment)| moment.goes_on_in(&self));
        let moved = self.moved(before.as_ref().map_or(&self, |(_, moment)| moment), lit_scene);
        let trail = match before {
            Some((mut trail, _)) => {
                trail.lay(picture.clone(), &moved, newest);
                trail
            }
            None => TemporalHistory::begin(picture.clone(), &moved),
        };
        &trails.entry(slot).insert_entry((trail, self)).into_mut().0.picture
    }

    /// Returns whether another moment shows the same bodies before the same background, perhaps moved or with other
    /// dimensions.
    fn goes_on_in(&self, other: &Self) -> bool {
        let kind = |moment: &Self| (std::mem::discriminant(&moment.specimen.design.cut), moment.form());
        let count = |moment: &Self| (moment.copies.len(), moment.companions.stones.len());
        kind(self) == kind(other) && count(self) == count(other) && self.behind == other.behind
    }

    /// Finds the body in each pixel, and the place of the same point at the moment `before`.
    fn moved(&self, before: &Self, lit_scene: &LitScene) -> Vec<MotionVector> {
        let sight = ray::SceneProbe::new(lit_scene);
        let eye = ray::Camera::reaching(&before.view, 1.0);
        let pixels = before.film.pixels_from_image(DMat2::IDENTITY);
        let [width, height] = self.film.size.map(|n| n as usize);
        let step = ((width * height) as f64 / MOST_POINTS).sqrt().ceil().max(1.0) as usize;
        let middle = |k: usize| (k / step * step) as f64 + 0.5 * step as f64;
        let at = |x: usize, y: usize| {
            let at = DVec2::new(middle(x), middle(y));
            let Some(glance) = sight.through(at.x, at.y) else {
                // The backplate moves with the eye.
                return (None, pixels.transform_point2(self.film.image_from_pixels(at)) - at);
            };
            let was = self.was(before, glance.stone, glance.origin + glance.direction * glance.distance);
            let from = was.and_then(|point| Some(pixels.transform_point2(eye.project(point)?.0) - at));
            (Some(glance.stone as u32), from.unwrap_or(DVec2::NAN))
        };
        let columns: Vec<usize> = (0..width).step_by(step).collect();
        let points: Vec<Vec<_>> = (0..height)
            .into_par_iter()
            .step_by(step)
            .map(|y| columns.iter().map(|x| at(*x, y)).collect())
            .collect();
        let pixel = |k: usize| {
            let (x, y) = (k % width, k / width);
            let (body, by) = points[y / step][x / step];
            MotionVector { body, from: DVec2::new(x as f64, y as f64) + 0.5 + by }
        };
        (0..width * height).map(pixel).collect()
    }

    /// Returns the form of the glass; `None` where the body is no glass.
    fn form(&self) -> Option<Discriminant<Glass>> {
        match &self.specimen.design.cut {
            Cut::Glass(glass) => Some(std::mem::discriminant(glass)),
            _ => None,
        }
    }

    /// Returns the former place of a point of a body; `None` where the body is a different one or has a different
    /// form.
    fn was(&self, before: &Self, number: usize, point: DVec3) -> Option<DVec3> {
        let Some(pose) = self.copies.get(number) else {
            let [now, then] = [self, before].map(|at| at.companions.stones.get(number - self.copies.len()));
            return Some(then?.pose.place(now?.pose.unplace(point)));
        };
        let own = pose.unplace(point);
        let was = match (&*self.specimen.body, &*before.specimen.body) {
            (Body::Glass(now), Body::Glass(then)) if self.form() == before.form() => {
                now.field().carried(own, then.field())
            }
            _ if Arc::ptr_eq(&self.specimen, &before.specimen) => own,
            _ => return None,
        };
        Some(before.copies.get(number)?.place(was))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::liquid::Liquid;
    use crate::model::document::Document;
    use crate::model::eye::Eye;
    use crate::model::framing_fit::FramingFit;
    use crate::model::motion::{Motion, WaveCache};
    use crate::shows::Shows;
    use crate::studio::order::{Paper, Which};
    use brillianteer_paper::lighting;
    use brillianteer_scene::{Copies, Glare, Look, Projection};
    use brillianteer_trace::environment::backplate_point;

    const SLOT: Slot = (0, Which::Present);

    /// A shot of moving copies of a cut at a given time, seen by an eye.
    fn shot(cut: &str, seconds: f64, (eye, projection): &(Eye, Projection)) -> Shot {
        let design = Arc::clone(Document::of_library(cut).unwrap().specimen());
        let copies = Copies::scattered(3, design.solid().vertices(), 4);
        let moving = Motion::at(seconds);
        let (specimen, copies) = moving.now(&mut WaveCache::default(), &design, &copies);
        Shot {
            document: 0,
            specimen,
            title: String::new(),
            marks: brillianteer_picture::DrawnMarks::default(),
            shows: Shows::Render,
            strongest: false,
            glare: Glare::LeftOut,
            view: View { projection: *projection, ..eye.view(None) },
            film: eye.film([48, 40], &FramingFit::reaching(3.0)),
            whole: FramingFit::reaching(3.0).film([48, 40]),
            light: crate::studio::ShotLight::whole(lighting::load("dome").unwrap()),
            look: Look { wavelengths: 3, ..Look::default() },
            jitter: true,
            copies,
            companions: Companions::default(),
            overlay: None,
            liquid: Liquid::default(),
            paper: Paper::default(),
        }
    }

    fn eye(distance: Option<f64>, zoom: f64) -> (Eye, Projection) {
        let eye = Eye { lean: DVec2::new(0.2, 0.1), centre: DVec2::new(0.1, 0.0), zoom, ..Eye::default() };
        let near = |distance| Projection::Perspective { distance };
        (eye, distance.map_or(Projection::Orthographic, near))
    }

    #[test]
    fn the_same_point_of_a_body_was_seen_where_its_motion_says() {
        for (cut, distance) in [("cube", None), ("cube", Some(12.0)), ("plate", None), ("plate", Some(9.0))] {
            let [before, now] = [(1.0, 1.0), (1.06, 1.1)].map(|(t, zoom)| shot(cut, t, &eye(distance, zoom)));
            let jobs = [&before, &now].map(|shot| shot.overlay_job(shot.film));
            let [was, is] = [0, 1].map(|k| jobs[k].lit().unwrap());
            let moments = [Moment::of(&before, before.film), Moment::of(&now, now.film)];
            let moved = moments[1].moved(&moments[0], &is);
            let (eyes, [width, _]) = ([ray::SceneProbe::new(&was), ray::SceneProbe::new(&is)], now.film.size);
            let (mut same, mut hidden, mut beside, mut farthest) = (0, 0, 0, 0.0_f64);
            for (k, moved) in moved.iter().enumerate() {
                let at = DVec2::new((k as u32 % width).into(), (k as u32 / width).into()) + 0.5;
                let Some(seen) = eyes[1].through(at.x, at.y) else {
                    // A point of the backplate does not move on the backplate.
                    let hangs = |shot: &Shot, at: DVec2| {
                        let (from, way) =
                            ray::Camera::reaching(&shot.view, 3.0).ray(shot.film.image_from_pixels(at));
                        backplate_point(&shot.view.basis(), shot.distance(), from, way).unwrap()
                            / shot.whole.pixel
                    };
                    assert!(hangs(&now, at).distance(hangs(&before, moved.from)) < 1e-9);
                    beside += 1;
                    continue;
                };
                assert_eq!(moved.body, Some(seen.stone as u32));
                farthest = farthest.max(moved.from.distance(at));
                let place = |g: &ray::ProbeRay| g.origin + g.direction * g.distance;
                let expected = moments[1].was(&moments[0], seen.stone, place(&seen)).unwrap();
                match eyes[0].through(moved.from.x, moved.from.y) {
                    Some(g) if g.stone == seen.stone && place(&g).distance(expected) < 1e-6 => same += 1,
                    // The point was turned away, or another body was in front of it.
                    _ => hidden += 1,
                }
            }
            assert!(same > 300 && hidden * 20 < same, "{cut}: {same} of {}", same + hidden);
            assert!(farthest > 1.0 && beside > 100, "{cut}: {farthest} pixels, {beside} beside");
        }
    }

    #[test]
    fn a_wave_carries_points_along_and_another_body_is_not_followed() {
        let eye = eye(None, 1.0);
        let [before, now] = [1.0, 1.2].map(|t| shot("plate", t, &eye));
        let moments = [Moment::of(&before, before.film), Moment::of(&now, now.film)];
        let Body::Glass(plate) = &*now.specimen.body else { panic!() };
        for vertex in plate.surface().vertices.iter().step_by(7) {
            let was = moments[1].was(&moments[0], 0, now.copies[0].place(*vertex)).unwrap();
            let Body::Glass(then) = &*before.specimen.body else { panic!() };
            assert!(then.field().value(before.copies[0].unplace(was)).abs() < 1e-9, "on the surface then");
        }
        let stone = shot("tolkowsky", 1.0, &eye);
        let other = Moment::of(&stone, stone.film);
        assert_eq!(other.was(&Moment::of(&shot("tolkowsky", 1.0, &eye), stone.film), 0, DVec3::ZERO), None);
    }

    #[test]
    fn each_picture_of_a_moving_body_is_laid_over_the_ones_before() {
        let eye = eye(None, 1.0);
        let mut trails = Trails::new();
        let mut counts = vec![];
        for k in 0..4 {
            let shot = shot("cube", 1.0 + 0.01 * f64::from(k), &eye);
            let (job, film) = (shot.overlay_job(shot.film), shot.film);
            let picture = Linear::new(film.size[0], film.size[1]);
            Moment::of(&shot, film).lay(&mut trails, (SLOT, &picture), &job.lit().unwrap(), 0.5);
            counts.push(trails[&SLOT].0.count);
        }
        assert_eq!(counts, [1, 2, 3, 4]);
    }
}
