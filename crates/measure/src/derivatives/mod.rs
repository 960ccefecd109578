//! The derivatives of measures of light by the planes of the stone and by its index.
//!
//! Absorption makes the area of a beam ∫ exp(-a L) over its outline, with the path L affine in the image: it changes by -∫ a exp(-a L) dL
//! inside and by the movement of each edge weighed by exp(-a L) along it. These integrals and their first moments are divided
//! differences of exp (Hermite-Genocchi). Fire weighs exits by 1 - blur / fan, so it changes with the fan too: the directions of
//! both colours are followed back along the facets by the differentials of Snell's law (`Beams::fan_derivatives`), and by the index the
//! indices of all colours change by the same amount. Extinction is a sum of areas of cells, contrast a function of the areas and
//! brightnesses of the finest parts of the face. Derivatives of the planes by proportions, angles and distances are differences of fourth
//! order, with errors of about 1e-11; those by the scale of a side are exact (`cut::SideSlope`).

mod exits;
mod face;

use super::{MeasureName, MeasureSettings};
use brillianteer_base::{Stopped, Watch, go_on};
use brillianteer_math::Polytope;
use brillianteer_trace::beam::{Beam, BeamPartials, Beams, PlaneDerivatives};
use exits::CountedExits;

/// A measure with its derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasureDerivatives {
    /// The measure of the traced light: its least value, except for contrast, whose bounds lie on both sides of it.
    pub value: f64,
    /// The derivatives of `value` by each plane and by the index. Absorption per length and dispersion are held.
    pub derivatives: PlaneDerivatives,
}

/// A number that is a function of the beams, with its derivatives by each of them.
struct BeamSum {
    value: f64,
    partials: BeamPartials,
    /// The derivative per radian of each beam's fan; empty where the number does not depend on fans.
    per_fan: Vec<f64>,
}

impl MeasureName {
    /// Returns whether this measure is a sum of light: a return, leakage, windowing, obstruction, fire, or absorbed
    /// light. Such a measure jumps only where a whole exit crosses a border of the light.
    pub fn is_energy(&self) -> bool {
        matches!(self, Self::Absorbed) || CountedExits::of(self, 0.0, 0.0).is_some()
    }

    /// Returns whether this measure has derivatives: a sum of light, extinction or contrast.
    pub fn has_derivatives(&self) -> bool {
        self.is_energy() || matches!(self, Self::Extinction | Self::Contrast)
    }

    /// Returns the derivatives of this measure by the planes of `polytope`, which must be the one that was traced,
    /// and by the index; `None` for measures without derivatives ([`has_derivatives`](Self::has_derivatives)).
    ///
    /// They are the derivatives of the light that was followed, between the borders of domes, heads and horizon: light that
    /// crosses a border makes a measure jump, and a facet through which light ceases to leave makes a kink. Extinction jumps
    /// also where another exit becomes the strongest of a cell. Neither is in the derivative. Their formulas are in
    /// docs/optics.md, "Derivatives", and at the top of this file.
    ///
    /// # Errors
    /// Fails where `watch` asks to stop.
    pub fn derivatives(
        &self,
        beams: &Beams,
        polytope: &Polytope,
        settings: &MeasureSettings,
        watch: Watch,
    ) -> Result<Option<MeasureDerivatives>, Stopped> {
        go_on(watch, 0.0)?;
        let Some(BeamSum { value, partials, per_fan }) = self.sum(beams, polytope, settings) else {
            return Ok(None);
        };
        // The fans take their own pass over the beams, beside two of the planes.
        let share = if per_fan.is_empty() { 1.0 } else { 2.0 / 3.0 };
        let mut derivatives = beams.derivatives(polytope, &partials, &|done| watch(share * done))?;
        if !per_fan.is_empty() {
            let rest = |done: f64| watch(share + (1.0 - share) * done);
            derivatives.add(&beams.fan_derivatives(polytope, settings.indices, &per_fan, &rest)?);
        }
        Ok(Some(MeasureDerivatives { value, derivatives: beams.over_copies(polytope, derivatives) }))
    }

    /// Returns this measure as a function of the beams; `None` where it has no derivatives.
    fn sum(&self, beams: &Beams, polytope: &Polytope, settings: &MeasureSettings) -> Option<BeamSum> {
        Some(match self {
            Self::Absorbed => exits::absorbed(beams),
            Self::Extinction => face::extinction(beams, settings.head_deg),
            Self::Contrast => face::contrast(beams, settings.head_deg),
            other => {
                CountedExits::of(other, settings.head_deg, settings.blur_deg)?.sum(beams, polytope, settings)
            }
        })
    }
}

/// Returns the part of the whole silhouette's area that a unit of a beam's area stands for, with the copies of the
/// symmetry.
fn share(beams: &Beams) -> f64 {
    f64::from(beams.symmetry.order()) / beams.silhouette_area
}

/// Adds the derivatives that come from dividing a sum by the silhouette's area, to which the beams that enter add up.
/// `parts` is the sum of all parts, each times its derivative.
fn divide_by_silhouette(partials: &mut BeamPartials, beams: &Beams, parts: f64) {
    for beam in beams.iter().filter(Beam::is_surface) {
        partials.area[beam.id as usize] -= parts * share(beams);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LightMeasures;
    use brillianteer_base::unwatched;
    use brillianteer_cut::{Crown, LowerHalf, Pavilion, RoundBrilliant, TOLKOWSKY};
    use brillianteer_math::Plane;
    use brillianteer_scene::{Medium, View};
    use brillianteer_trace::beam::{BeamOptions, trace_bounces};
    use glam::DVec3;

    const BOUNCES: u32 = 4;

    fn planes(cut: &RoundBrilliant) -> Vec<Plane> {
        cut.facets().unwrap().into_iter().map(|(_, plane)| plane).collect()
    }

    /// Returns a brilliant whose table, crown, pavilion and lower halves differ from Tolkowsky's by these amounts.
    fn brilliant([table, crown, pavilion, lower]: [f64; 4]) -> RoundBrilliant {
        RoundBrilliant {
            table: 56.0 + table,
            crown: Crown::Angle(34.0 + crown),
            pavilion: Pavilion::Angle(40.8 + pavilion),
            lower_half: LowerHalf::Radial(77.0 + lower),
            girdle_facets: 32,
            ..TOLKOWSKY
        }
    }

    fn traced(cut: &RoundBrilliant, medium: Medium, tilt: f64) -> (Polytope, Beams) {
        let stone = Polytope::from_planes(&planes(cut)).unwrap();
        let view = View { tilt, ..View::default() };
        let beams = trace_bounces(&stone, medium, &view, &BeamOptions::default(), BOUNCES);
        (stone, beams)
    }

    /// Returns the central difference of fourth order of some numbers.
    fn difference<const N: usize>(step: f64, of: impl Fn(f64) -> [f64; N]) -> [f64; N] {
        let [far_below, below, above, far_above] = [-2.0, -1.0, 1.0, 2.0].map(|k| of(k * step));
        std::array::from_fn(|k| (8.0 * (above[k] - below[k]) - (far_above[k] - far_below[k])) / (12.0 * step))
    }

    const COUNT: usize = 9;

    fn names() -> [MeasureName; COUNT] {
        [
            "return-cos2",
            "return-cos3+glare",
            "leakage",
            "windowing",
            "obstruction",
            "fire",
            "absorbed",
            "extinction",
            "contrast",
        ]
        .map(|name| name.parse().unwrap())
    }

    fn values(beams: &Beams, stone: &Polytope, settings: &MeasureSettings) -> [f64; COUNT] {
        names().map(|name| name.derivatives(beams, stone, settings, &unwatched).unwrap().unwrap().value)
    }

    /// Returns the largest difference of two lists of derivatives by planes; of those by normals, only the component
    /// perpendicular to the normal counts.
    fn apart(stone: &Polytope, a: &PlaneDerivatives, b: &PlaneDerivatives) -> f64 {
        let by_normal = stone.planes().zip(a.normals.iter().zip(&b.normals)).map(|(plane, (a, b))| {
            let change = *a - *b;
            (change - plane.normal * plane.normal.dot(change)).length()
        });
        let by_offset = a.offsets.iter().zip(&b.offsets).map(|(a, b)| (a - b).abs());
        by_normal.chain(by_offset).fold((a.index - b.index).abs(), f64::max)
    }

    #[test]
    fn derivatives_by_single_planes_are_those_without_symmetry() {
        let stone = Polytope::from_planes(&planes(&brilliant([0.0; 4]))).unwrap();
        let mut settings = MeasureSettings::usual([2.4, 2.45]);
        settings.domes = vec!["cos2".parse().unwrap(), "cos3".parse().unwrap()];
        for tilt in [0.0, 0.2] {
            let view = View { tilt, ..View::default() };
            let [whole, parts] = [false, true].map(|symmetry| {
                let options = BeamOptions { symmetry, ..BeamOptions::default() };
                trace_bounces(&stone, Medium::clear(2.42), &view, &options, BOUNCES)
            });
            assert!(parts.symmetry.order() > 1 && whole.symmetry.order() == 1);
            for name in names() {
                let [whole, parts] = [&whole, &parts].map(|beams| {
                    name.derivatives(beams, &stone, &settings, &unwatched).unwrap().unwrap().derivatives
                });
                let none = PlaneDerivatives {
                    normals: vec![DVec3::ZERO; stone.facets().len()],
                    offsets: vec![0.0; stone.facets().len()],
                    index: 0.0,
                };
                let (error, size) = (apart(&stone, &whole, &parts), apart(&stone, &whole, &none));
                assert!(error <= 1e-7 * size, "{name} at {tilt}: off by {error} of {size}");
                let mut turned = parts.clone();
                turned.offsets.rotate_left(1);
                let off = apart(&stone, &whole, &turned);
                assert!(size == 0.0 || off > 1e-4 * size, "{name}: the comparison cannot fail");
            }
        }
    }

    #[test]
    fn the_derivatives_of_one_measure_stop_where_their_watch_asks_to() {
        let (stone, beams) = traced(&brilliant([0.0; 4]), Medium::clear(2.42), 0.0);
        let settings = MeasureSettings::usual([2.4, 2.45]);
        for name in names() {
            let calls = std::sync::atomic::AtomicUsize::new(0);
            let counted = |done: f64| {
                assert!((0.0..=1.0).contains(&done), "{name}: {done}");
                calls.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                std::ops::ControlFlow::Continue(())
            };
            name.derivatives(&beams, &stone, &settings, &counted).unwrap().unwrap();
            let calls = calls.into_inner();
            assert!(calls > 2 * beams.len() / 2048, "{name}: {calls} calls");
            for last in [0.0, 0.3, 0.9] {
                let until = |done: f64| {
                    if done < last {
                        std::ops::ControlFlow::Continue(())
                    } else {
                        std::ops::ControlFlow::Break(())
                    }
                };
                assert_eq!(name.derivatives(&beams, &stone, &settings, &until), Err(Stopped), "{name}");
            }
        }
    }

    #[test]
    fn derivatives_by_proportions_and_index_are_those_of_differences_on_random_brilliants() {
        let mut usual = MeasureSettings::usual([2.4, 2.45]);
        usual.domes = vec!["cos2".parse().unwrap(), "cos3".parse().unwrap()];
        let mut state = 0.5;
        let mut some = |by: f64| {
            state = f64::fract(state + 0.618_033_988_749_895);
            by * (2.0 * state - 1.0)
        };
        let (mut compared, mut at_borders) = (0, 0);
        for number in 0..50 {
            let at: [f64; 4] = [some(3.0), some(4.0), some(1.5), some(5.0)];
            let tilt = if number % 3 == 0 { 0.2 } else { 0.0 };
            let index = 2.2 + some(0.4);
            // Clear stones, grey ones, and some that absorb each polarisation differently.
            let absorption = [[0.0; 2], [0.25; 2], [0.0; 2], [0.6, 0.1]][number % 4];
            let medium = |index: f64| Medium { absorption, ..Medium::clear(index) };
            let at_index =
                |index: f64| MeasureSettings { indices: [index - 0.02, index + 0.03], ..usual.clone() };
            let settings = at_index(index);
            let (stone, beams) = traced(&brilliant(at), medium(index), tilt);
            let own =
                names().map(|name| name.derivatives(&beams, &stone, &settings, &unwatched).unwrap().unwrap());
            let measures = LightMeasures::of(&beams, &stone, &settings, &unwatched).unwrap();
            assert_eq!(own[2].value.to_bits(), measures.leakage.least.to_bits());
            assert!((own[0].value - measures.domes[0].inside.least).abs() < 1e-14);
            assert!((own[1].value - measures.domes[1].with_glare().least).abs() < 1e-14);
            for (own, interval) in
                own[5..8].iter().zip([measures.fire, measures.absorbed, measures.extinction])
            {
                assert!((own.value - interval.least).abs() < 1e-14);
            }
            let contrast = measures.contrast;
            assert!(contrast.least <= own[8].value && own[8].value <= contrast.most);
            for by in 0..5 {
                let moved = |h: f64| {
                    let mut at = at;
                    if by < 4 {
                        at[by] += h;
                    }
                    (brilliant(at), if by == 4 { index + h } else { index })
                };
                let found: Vec<f64> = if by == 4 {
                    own.iter().map(|own| own.derivatives.index).collect()
                } else {
                    let start = planes(&brilliant(at));
                    let change = difference(1e-4, |h| {
                        let planes = planes(&moved(h).0);
                        let numbers = |p: &Plane| [p.normal.x, p.normal.y, p.normal.z, p.offset];
                        let all: Vec<f64> = planes.iter().flat_map(numbers).collect();
                        <[f64; 4 * 89]>::try_from(all).unwrap()
                    });
                    let of_facet = |plane: &Plane| {
                        let at = start.iter().position(|p| p.normal.distance(plane.normal) < 1e-9).unwrap();
                        let [x, y, z, offset] = [0, 1, 2, 3].map(|k| change[4 * at + k]);
                        (DVec3::new(x, y, z), offset)
                    };
                    let changes: Vec<(DVec3, f64)> =
                        stone.facets().iter().map(|f| of_facet(&f.plane)).collect();
                    own.iter().map(|own| own.derivatives.along(changes.iter().copied())).collect()
                };
                let differences = |step: f64| {
                    difference(step, |h| {
                        let (cut, index) = moved(h);
                        let (stone, beams) = traced(&cut, medium(index), tilt);
                        values(&beams, &stone, &at_index(index))
                    })
                };
                let unit = if by == 4 { 0.1 } else { 1.0 };
                let (coarse, fine) = (differences(2e-5 * unit), differences(1e-5 * unit));
                for k in 0..COUNT {
                    // Where two steps disagree, a border lies between them.
                    if (coarse[k] - fine[k]).abs() > 1e-7 * fine[k].abs().max(0.01) {
                        at_borders += 1;
                        continue;
                    }
                    compared += 1;
                    let error = (found[k] - fine[k]).abs();
                    assert!(
                        error < 1e-6 * fine[k].abs().max(0.01),
                        "{number} {by} {k}: {} {}",
                        found[k],
                        fine[k]
                    );
                }
            }
        }
        assert!(
            compared > 20 * at_borders && compared > 1000,
            "{compared} compared, {at_borders} at borders"
        );
    }
}
