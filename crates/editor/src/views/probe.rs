//! Finds the facet under the pointer, and the direction that its light comes from.

use brillianteer_cut::tier_stem;
use brillianteer_optics::line;
use brillianteer_scene::{Film, Pose, Scope, Specimen, View, elevation_deg};
use brillianteer_trace::ray::{Camera, Path, RayOptions, StoneTracer};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// A stone, and the tracer that answers questions about it.
pub struct Probe {
    specimen: Arc<Specimen>,
    tracer: StoneTracer,
}

/// Keeps the probes of the stones that were asked about last.
#[derive(Default)]
pub struct ProbeCache(Vec<Probe>);

/// The number of probes that are kept.
const KEPT: usize = 16;

impl ProbeCache {
    /// Returns the probe that answers questions about a stone.
    pub fn of(&mut self, specimen: &Arc<Specimen>) -> &Probe {
        let known = self.0.iter().position(|probe| Arc::ptr_eq(&probe.specimen, specimen));
        let place = known.unwrap_or_else(|| {
            if self.0.len() == KEPT {
                self.0.remove(0);
            }
            self.0.push(Probe::new(Arc::clone(specimen)));
            self.0.len() - 1
        });
        &self.0[place]
    }
}

/// The facet and the light at a point of a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct ProbeHit {
    pub facet: u32,
    pub name: String,
    /// The part of their names that the facets of the tier share, and how many facets there are.
    pub tier: (String, usize),
    /// The slope of the facet from the girdle plane, degrees: 0 is level, 90 upright.
    pub slope: f64,
    /// The azimuth of the facet, degrees, counter-clockwise from above; `None` for a level facet.
    pub azimuth: Option<f64>,
    /// The strongest light that is seen at the point.
    pub light: Option<LightAtPoint>,
}

/// Light that is seen at a point.
#[derive(Debug, Clone, PartialEq)]
pub struct LightAtPoint {
    /// The name of the scope's zone that the light comes from.
    pub zone: String,
    /// The elevation that the light comes from, degrees above the scope's plane.
    pub elevation: f64,
    /// The share of this light in all light at the point.
    pub share: f64,
}

/// A facet is level where the sine of its slope is no more than this.
const LEVEL: f64 = 1e-9;

impl Probe {
    /// Makes a probe of a stone.
    pub fn new(specimen: Arc<Specimen>) -> Self {
        let options = RayOptions { most_bounces: 64, least_weight: 1e-3, polarised: true };
        let tracer = StoneTracer::new(specimen.solid(), specimen.medium(line::SODIUM_D), options);
        Self { specimen, tracer }
    }

    /// Returns the origin and the direction of the ray through a point of the image.
    fn ray(&self, view: &View, at: DVec2) -> (DVec3, DVec3) {
        Camera::new(view, self.specimen.solid()).ray(at)
    }

    /// Returns the path of the ray through a point of the image; `None` beside the stone.
    pub fn path(&self, view: &View, at: DVec2) -> Option<Path> {
        let (origin, direction) = self.ray(view, at);
        self.tracer.path(origin, direction)
    }

    /// Returns whether a point of the image lies on the stone.
    pub fn is_on(&self, view: &View, at: DVec2) -> bool {
        let (origin, direction) = self.ray(view, at);
        self.tracer.meet(origin, direction).is_some()
    }

    /// Returns the facet at a point of the image, and the point of the stone there; `None` beside the stone.
    pub fn meet(&self, view: &View, at: DVec2) -> Option<(usize, DVec3)> {
        let (origin, direction) = self.ray(view, at);
        let (facet, distance) = self.tracer.meet(origin, direction)?;
        Some((facet, origin + direction * distance))
    }

    /// Returns the facet and the light at a point of a film, in its pixels; `None` beside the stone.
    pub fn at(&self, view: &View, film: &Film, at: DVec2, scope: &Scope) -> Option<ProbeHit> {
        let (origin, direction) = self.ray(view, film.image_from_pixels(at));
        let (facet, distance) = self.tracer.meet(origin, direction)?;
        let mut strongest: Option<(f64, DVec3)> = None;
        self.tracer.follow(origin, direction, |exit| {
            if !exit.surface && strongest.is_none_or(|(weight, _)| exit.weight > weight) {
                strongest = Some((exit.weight, exit.direction));
            }
        });
        let zenith = view.zenith();
        let light = strongest.filter(|(weight, _)| *weight > 0.0).map(|(share, toward)| LightAtPoint {
            zone: scope.bands[scope.band(toward, zenith)].name.clone(),
            elevation: elevation_deg(toward, zenith),
            share,
        });
        Some(self.found((facet as u32, origin + direction * distance), light))
    }

    /// Returns the number of the stone that a ray meets first among these poses, its facet, and the distance; `None`
    /// where the ray meets none.
    pub fn among(&self, poses: &[Pose], (origin, direction): (DVec3, DVec3)) -> Option<(usize, u32, f64)> {
        let meet = |(number, pose): (usize, &Pose)| {
            let (facet, distance) =
                self.tracer.meet(pose.unplace(origin), pose.turn.inverse() * direction)?;
            Some((number, facet as u32, distance * pose.scale))
        };
        poses.iter().enumerate().filter_map(meet).min_by(|a, b| a.2.total_cmp(&b.2))
    }

    fn found(&self, (facet, point): (u32, DVec3), light: Option<LightAtPoint>) -> ProbeHit {
        let normal = self.specimen.solid().normal(facet, point);
        let (body, radial) = (&self.specimen.body, normal.truncate());
        let tier = body.stone().map_or((String::new(), 1), |stone| {
            let own = stone.name(facet);
            let stem = tier_stem(&own);
            let count = stone.names().iter().filter(|n| tier_stem(n) == stem).count();
            (stem.replace('_', " "), count)
        });
        let name = body.name(facet);
        ProbeHit {
            facet,
            name,
            tier,
            slope: radial.length().atan2(normal.z.abs()).to_degrees(),
            azimuth: (radial.length() > LEVEL).then(|| radial.to_angle().to_degrees().rem_euclid(360.0)),
            light,
        }
    }
}

impl ProbeHit {
    /// Describes the hit in one line.
    pub fn message(&self) -> String {
        let azimuth = self.azimuth.map_or(String::new(), |a| format!(", azimuth {a:.1}°"));
        let (tier, count) = &self.tier;
        let tier = if *count > 1 { format!(" of {count} {tier} facets") } else { String::new() };
        let light = self.light.as_ref().map_or_else(
            || "no light leaves here".to_owned(),
            |l| {
                format!(
                    "{} light from {:.1}°, {:.0} % of the light seen",
                    l.zone,
                    l.elevation,
                    100.0 * l.share
                )
            },
        );
        format!("{}{tier} · slope {:.2}°{azimuth} · {light}", self.name, self.slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_scene::{ASET_CONE, Backing};
    use brillianteer_session::model::document::Document;

    #[test]
    fn the_table_is_found_in_the_middle_and_a_bezel_beside_it() {
        let probe = Probe::new(Arc::clone(Document::first().unwrap().specimen()));
        let (view, film) = (View::default(), Film::square(200, 1.1));
        let scope = Scope::aset(ASET_CONE, Backing::Black);
        let at = |x: f64, y: f64| {
            probe.at(
                &view,
                &film,
                film.pixels_from_image(glam::DMat2::IDENTITY).transform_point2(DVec2::new(x, y)),
                &scope,
            )
        };
        let table = at(0.01, 0.02).unwrap();
        assert_eq!((table.name.as_str(), table.slope, table.azimuth), ("table", 0.0, None));
        let bezel = at(0.75, 0.01).unwrap();
        assert_eq!(bezel.tier, ("bezel".to_owned(), 8));
        assert!(
            (bezel.slope - 34.5).abs() < 0.1
                && bezel.azimuth.is_some_and(|a| (a + 0.1).rem_euclid(360.0) < 0.2)
        );
        let light = bezel.light.as_ref().unwrap();
        assert!(light.share > 0.3 && bezel.message().contains("of 8 bezel facets"), "{}", bezel.message());
        assert_eq!(at(1.05, 0.0), None);
    }

    #[test]
    fn of_copies_the_one_before_the_others_is_found_however_it_is_turned() {
        let probe = Probe::new(Arc::clone(Document::first().unwrap().specimen()));
        let turned = Pose {
            at: DVec3::new(1.5, 0.2, -4.0),
            ..Pose::turned(glam::DQuat::from_rotation_x(std::f64::consts::PI))
        };
        let copies = [turned, Pose { at: DVec3::new(-1.5, 0.0, 0.0), ..Pose::STILL }, Pose::STILL];
        let film = Film::square(200, 3.0);
        let perspective = View {
            projection: brillianteer_scene::Projection::Perspective { distance: 9.0 },
            ..View::default()
        };
        for view in [View::default(), perspective] {
            let found = |place: DVec3| {
                let at = Camera::reaching(&view, 1.0).project(place).unwrap().0;
                let pixels = film.pixels_from_image(glam::DMat2::IDENTITY).transform_point2(at);
                let ray = Camera::reaching(&view, 6.0).ray(film.image_from_pixels(pixels));
                let (copy, facet, _) = probe.among(&copies, ray)?;
                Some((copy, probe.specimen.body.name(facet)))
            };
            // Of the copy that lies face down the culet is nearest to the eye, and beside the culet a pavilion main.
            let main = found(turned.place(DVec3::new(0.1, 0.01, -0.8))).unwrap();
            assert!(main.0 == 0 && main.1.starts_with("main "), "{main:?}");
            assert_eq!(found(DVec3::new(-1.9, 0.0, 0.3)), Some((1, "table".to_owned())));
            assert_eq!(found(DVec3::new(0.1, 0.0, 0.3)), Some((2, "table".to_owned())));
            // Where two copies overlap in sight, the nearer one is found.
            assert_eq!(found(DVec3::new(-0.7, 0.0, 0.0)).map(|f| f.0), Some(2));
            assert_eq!(found(DVec3::new(0.0, 2.5, 0.0)), None);
        }
    }
}
